// SPDX-License-Identifier: MIT
// What Vulkan 1.0 wants of formats (chapter "Required Format Support"), beside what rhw has. The table is written down by
// hand from there; --show prints it.
#include "harness.h"

#include <stdio.h>
#include <string.h>

enum {
    S = RHW_FEATURE_SAMPLED,
    F = RHW_FEATURE_FILTERED,
    C = RHW_FEATURE_COLOR_ATTACHMENT,
    B = RHW_FEATURE_BLENDED,
    D = RHW_FEATURE_DEPTH_ATTACHMENT,
    T = RHW_FEATURE_STENCIL_ATTACHMENT,
    I = RHW_FEATURE_STORAGE_IMAGE,
    A = RHW_FEATURE_STORAGE_IMAGE | RHW_FEATURE_STORAGE_ATOMIC,
    U = RHW_FEATURE_TEXEL_BUFFER, // uniform; rhw's are for storage too
    NO_VERTEX = -1
};

static const struct {
    const char *vulkan; // VK_FORMAT_
    enum rhw_format format;
    int vertex; // enum rhw_vertex_format, or NO_VERTEX where none is asked for
    uint32_t features;
} required[] = {
    {"B4G4R4A4_UNORM_PACK16", RHW_FORMAT_BGRA4_UNORM, NO_VERTEX, S | F},
    {"R5G6B5_UNORM_PACK16", RHW_FORMAT_RGB565_UNORM, NO_VERTEX, S | F | C | B},
    {"A1R5G5B5_UNORM_PACK16", RHW_FORMAT_A1RGB5_UNORM, NO_VERTEX, S | F | C | B},
    {"R8_UNORM", RHW_FORMAT_R8_UNORM, RHW_VERTEX_UNORM8X1, S | F | C | B | U},
    {"R8_SNORM", RHW_FORMAT_R8_SNORM, RHW_VERTEX_SNORM8X1, S | F | U},
    {"R8_UINT", RHW_FORMAT_R8_UINT, RHW_VERTEX_UINT8X1, S | C | U},
    {"R8_SINT", RHW_FORMAT_R8_SINT, RHW_VERTEX_SINT8X1, S | C | U},
    {"R8G8_UNORM", RHW_FORMAT_RG8_UNORM, RHW_VERTEX_UNORM8X2, S | F | C | B | U},
    {"R8G8_SNORM", RHW_FORMAT_RG8_SNORM, RHW_VERTEX_SNORM8X2, S | F | U},
    {"R8G8_UINT", RHW_FORMAT_RG8_UINT, RHW_VERTEX_UINT8X2, S | C | U},
    {"R8G8_SINT", RHW_FORMAT_RG8_SINT, RHW_VERTEX_SINT8X2, S | C | U},
    {"R8G8B8A8_UNORM", RHW_FORMAT_RGBA8_UNORM, RHW_VERTEX_UNORM8X4, S | F | C | B | I | U},
    {"R8G8B8A8_SNORM", RHW_FORMAT_RGBA8_SNORM, RHW_VERTEX_SNORM8X4, S | F | I | U},
    {"R8G8B8A8_UINT", RHW_FORMAT_RGBA8_UINT, RHW_VERTEX_UINT8X4, S | C | I | U},
    {"R8G8B8A8_SINT", RHW_FORMAT_RGBA8_SINT, RHW_VERTEX_SINT8X4, S | C | I | U},
    {"R8G8B8A8_SRGB", RHW_FORMAT_RGBA8_SRGB, NO_VERTEX, S | F | C | B},
    {"B8G8R8A8_UNORM", RHW_FORMAT_BGRA8_UNORM, RHW_VERTEX_UNORM8X4_BGRA, S | F | C | B | U},
    {"B8G8R8A8_SRGB", RHW_FORMAT_BGRA8_SRGB, NO_VERTEX, S | F | C | B},
    {"A8B8G8R8_UNORM_PACK32", RHW_FORMAT_RGBA8_UNORM, RHW_VERTEX_UNORM8X4, S | F | C | B | U},
    {"A8B8G8R8_SNORM_PACK32", RHW_FORMAT_RGBA8_SNORM, RHW_VERTEX_SNORM8X4, S | F | U},
    {"A8B8G8R8_UINT_PACK32", RHW_FORMAT_RGBA8_UINT, RHW_VERTEX_UINT8X4, S | C | U},
    {"A8B8G8R8_SINT_PACK32", RHW_FORMAT_RGBA8_SINT, RHW_VERTEX_SINT8X4, S | C | U},
    {"A8B8G8R8_SRGB_PACK32", RHW_FORMAT_RGBA8_SRGB, NO_VERTEX, S | F | C | B},
    {"A2B10G10R10_UNORM_PACK32", RHW_FORMAT_RGB10A2_UNORM, RHW_VERTEX_UNORM10_10_10_2, S | F | C | B | U},
    {"A2B10G10R10_UINT_PACK32", RHW_FORMAT_RGB10A2_UINT, NO_VERTEX, S | C | U},
    {"R16_UNORM", RHW_FORMAT_R16_UNORM, RHW_VERTEX_UNORM16X1, 0},
    {"R16_SNORM", RHW_FORMAT_R16_SNORM, RHW_VERTEX_SNORM16X1, 0},
    {"R16_UINT", RHW_FORMAT_R16_UINT, RHW_VERTEX_UINT16X1, S | C | U},
    {"R16_SINT", RHW_FORMAT_R16_SINT, RHW_VERTEX_SINT16X1, S | C | U},
    {"R16_SFLOAT", RHW_FORMAT_R16_FLOAT, RHW_VERTEX_HALF1, S | F | C | B | U},
    {"R16G16_UNORM", RHW_FORMAT_RG16_UNORM, RHW_VERTEX_UNORM16X2, 0},
    {"R16G16_SNORM", RHW_FORMAT_RG16_SNORM, RHW_VERTEX_SNORM16X2, 0},
    {"R16G16_UINT", RHW_FORMAT_RG16_UINT, RHW_VERTEX_UINT16X2, S | C | U},
    {"R16G16_SINT", RHW_FORMAT_RG16_SINT, RHW_VERTEX_SINT16X2, S | C | U},
    {"R16G16_SFLOAT", RHW_FORMAT_RG16_FLOAT, RHW_VERTEX_HALF2, S | F | C | B | U},
    {"R16G16B16A16_UNORM", RHW_FORMAT_RGBA16_UNORM, RHW_VERTEX_UNORM16X4, 0},
    {"R16G16B16A16_SNORM", RHW_FORMAT_RGBA16_SNORM, RHW_VERTEX_SNORM16X4, 0},
    {"R16G16B16A16_UINT", RHW_FORMAT_RGBA16_UINT, RHW_VERTEX_UINT16X4, S | C | I | U},
    {"R16G16B16A16_SINT", RHW_FORMAT_RGBA16_SINT, RHW_VERTEX_SINT16X4, S | C | I | U},
    {"R16G16B16A16_SFLOAT", RHW_FORMAT_RGBA16_FLOAT, RHW_VERTEX_HALF4, S | F | C | B | I | U},
    {"R32_UINT", RHW_FORMAT_R32_UINT, RHW_VERTEX_UINT32X1, S | C | A | U},
    {"R32_SINT", RHW_FORMAT_R32_SINT, RHW_VERTEX_SINT32X1, S | C | A | U},
    {"R32_SFLOAT", RHW_FORMAT_R32_FLOAT, RHW_VERTEX_FLOAT1, S | C | I | U},
    {"R32G32_UINT", RHW_FORMAT_RG32_UINT, RHW_VERTEX_UINT32X2, S | C | I | U},
    {"R32G32_SINT", RHW_FORMAT_RG32_SINT, RHW_VERTEX_SINT32X2, S | C | I | U},
    {"R32G32_SFLOAT", RHW_FORMAT_RG32_FLOAT, RHW_VERTEX_FLOAT2, S | C | I | U},
    {"R32G32B32_UINT", RHW_FORMAT_NONE, RHW_VERTEX_UINT32X3, 0},
    {"R32G32B32_SINT", RHW_FORMAT_NONE, RHW_VERTEX_SINT32X3, 0},
    {"R32G32B32_SFLOAT", RHW_FORMAT_NONE, RHW_VERTEX_FLOAT3, 0},
    {"R32G32B32A32_UINT", RHW_FORMAT_RGBA32_UINT, RHW_VERTEX_UINT32X4, S | C | I | U},
    {"R32G32B32A32_SINT", RHW_FORMAT_RGBA32_SINT, RHW_VERTEX_SINT32X4, S | C | I | U},
    {"R32G32B32A32_SFLOAT", RHW_FORMAT_RGBA32_FLOAT, RHW_VERTEX_FLOAT4, S | C | I | U},
    {"B10G11R11_UFLOAT_PACK32", RHW_FORMAT_RG11B10_FLOAT, NO_VERTEX, S | F | U},
    {"E5B9G9R9_UFLOAT_PACK32", RHW_FORMAT_RGB9E5_FLOAT, NO_VERTEX, S | F},
    {"D16_UNORM", RHW_FORMAT_D16_UNORM, NO_VERTEX, S | D},
    {"X8_D24_UNORM_PACK32", RHW_FORMAT_D24_UNORM, NO_VERTEX, D},
    {"D32_SFLOAT", RHW_FORMAT_D32_FLOAT, NO_VERTEX, S | D},
    {"D24_UNORM_S8_UINT", RHW_FORMAT_D24_UNORM_S8_UINT, NO_VERTEX, D | T},
    {"D32_SFLOAT_S8_UINT", RHW_FORMAT_D32_FLOAT_S8_UINT, NO_VERTEX, D | T},
    // One of the three families of compressed formats; all are here.
    {"BC1_RGB_UNORM_BLOCK", RHW_FORMAT_BC1_RGB_UNORM, NO_VERTEX, S | F},
    {"BC7_SRGB_BLOCK", RHW_FORMAT_BC7_SRGB, NO_VERTEX, S | F},
    {"ETC2_R8G8B8_UNORM_BLOCK", RHW_FORMAT_ETC2_RGB8_UNORM, NO_VERTEX, S | F},
    {"EAC_R11G11_SNORM_BLOCK", RHW_FORMAT_EAC_RG11_SNORM, NO_VERTEX, S | F},
    {"ASTC_12x12_SRGB_BLOCK", RHW_FORMAT_ASTC_12X12_SRGB, NO_VERTEX, S | F},
};
enum { FORMATS = sizeof required / sizeof *required };

static const char *marks(uint32_t features)
{
    static char text[2][12];
    static int which;
    char *const out = text[which = !which];
    for (int i = 0; i < 9; i++) {
        out[i] = features >> i & 1 ? "sfcbdtiau"[i] : '.';
    }
    out[9] = 0;
    return out;
}

static void test_what_vulkan_requires(void **state)
{
    (void)state;
    const size_t bytes[] = {1, 2, 4, 8, 12, 16};
    for (int i = 0; i < FORMATS; i++) {
        const uint32_t features = rhw_format_features(required[i].format);
        if ((features & required[i].features) != required[i].features) {
            fail_msg("%s: Vulkan wants %s, rhw has %s", required[i].vulkan, marks(required[i].features),
                     marks(features));
        }
        if (required[i].vertex != NO_VERTEX) {
            const size_t size = rhw_vertex_format_size((enum rhw_vertex_format)required[i].vertex);
            size_t found = 0;
            for (size_t b = 0; b < sizeof bytes / sizeof *bytes; b++) {
                found += bytes[b] == size;
            }
            assert_int_equal(found, 1);
            const size_t texel = rhw_format_size(required[i].format);
            assert_true(required[i].format == RHW_FORMAT_NONE || size == texel);
        }
    }
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--show") == 0) {
        puts("s sampled, f filtered, c colour attachment, b blended, d depth, t stencil, i storage image,\n"
             "a with atomics, u texel buffer, v vertex\n"
             "Vulkan 1.0                 requires     rhw has");
        for (int i = 0; i < FORMATS; i++) {
            const char v = required[i].vertex == NO_VERTEX ? '.' : 'v';
            printf("%-26s %s%c   %s%c\n", required[i].vulkan, marks(required[i].features), v,
                   marks(rhw_format_features(required[i].format)), v);
        }
        return 0;
    }
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_what_vulkan_requires)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
