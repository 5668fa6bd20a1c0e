// SPDX-License-Identifier: MIT
// What Vulkan 1.0 wants of formats (chapter "Required Format Support"), beside what rhw has: what rhw_format_features
// says, and of blits and texel buffers what comes of them. The table is written down by hand from there, and
// printed.
#include "harness.h"

#include "format/format.h"

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
    U = RHW_FEATURE_TEXEL_BUFFER, // uniform
    BLIT_SOURCE = 512,            // of all that are sampled
    BLIT_DESTINATION = 1024,      // of all that are drawn into as colour
    W = 2048,                     // storage texel buffers
    M = 4096,                     // with atomics
    FEATURES = 13,
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
    {"R8G8B8A8_UNORM", RHW_FORMAT_RGBA8_UNORM, RHW_VERTEX_UNORM8X4, S | F | C | B | I | U | W},
    {"R8G8B8A8_SNORM", RHW_FORMAT_RGBA8_SNORM, RHW_VERTEX_SNORM8X4, S | F | I | U | W},
    {"R8G8B8A8_UINT", RHW_FORMAT_RGBA8_UINT, RHW_VERTEX_UINT8X4, S | C | I | U | W},
    {"R8G8B8A8_SINT", RHW_FORMAT_RGBA8_SINT, RHW_VERTEX_SINT8X4, S | C | I | U | W},
    {"R8G8B8A8_SRGB", RHW_FORMAT_RGBA8_SRGB, NO_VERTEX, S | F | C | B},
    {"B8G8R8A8_UNORM", RHW_FORMAT_BGRA8_UNORM, RHW_VERTEX_UNORM8X4_BGRA, S | F | C | B | U},
    {"B8G8R8A8_SRGB", RHW_FORMAT_BGRA8_SRGB, NO_VERTEX, S | F | C | B},
    {"A8B8G8R8_UNORM_PACK32", RHW_FORMAT_RGBA8_UNORM, RHW_VERTEX_UNORM8X4, S | F | C | B | U | W},
    {"A8B8G8R8_SNORM_PACK32", RHW_FORMAT_RGBA8_SNORM, RHW_VERTEX_SNORM8X4, S | F | U | W},
    {"A8B8G8R8_UINT_PACK32", RHW_FORMAT_RGBA8_UINT, RHW_VERTEX_UINT8X4, S | C | U | W},
    {"A8B8G8R8_SINT_PACK32", RHW_FORMAT_RGBA8_SINT, RHW_VERTEX_SINT8X4, S | C | U | W},
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
    {"R16G16B16A16_UINT", RHW_FORMAT_RGBA16_UINT, RHW_VERTEX_UINT16X4, S | C | I | U | W},
    {"R16G16B16A16_SINT", RHW_FORMAT_RGBA16_SINT, RHW_VERTEX_SINT16X4, S | C | I | U | W},
    {"R16G16B16A16_SFLOAT", RHW_FORMAT_RGBA16_FLOAT, RHW_VERTEX_HALF4, S | F | C | B | I | U | W},
    {"R32_UINT", RHW_FORMAT_R32_UINT, RHW_VERTEX_UINT32X1, S | C | A | U | W | M},
    {"R32_SINT", RHW_FORMAT_R32_SINT, RHW_VERTEX_SINT32X1, S | C | A | U | W | M},
    {"R32_SFLOAT", RHW_FORMAT_R32_FLOAT, RHW_VERTEX_FLOAT1, S | C | I | U | W},
    {"R32G32_UINT", RHW_FORMAT_RG32_UINT, RHW_VERTEX_UINT32X2, S | C | I | U | W},
    {"R32G32_SINT", RHW_FORMAT_RG32_SINT, RHW_VERTEX_SINT32X2, S | C | I | U | W},
    {"R32G32_SFLOAT", RHW_FORMAT_RG32_FLOAT, RHW_VERTEX_FLOAT2, S | C | I | U | W},
    {"R32G32B32_UINT", RHW_FORMAT_NONE, RHW_VERTEX_UINT32X3, 0},
    {"R32G32B32_SINT", RHW_FORMAT_NONE, RHW_VERTEX_SINT32X3, 0},
    {"R32G32B32_SFLOAT", RHW_FORMAT_NONE, RHW_VERTEX_FLOAT3, 0},
    {"R32G32B32A32_UINT", RHW_FORMAT_RGBA32_UINT, RHW_VERTEX_UINT32X4, S | C | I | U | W},
    {"R32G32B32A32_SINT", RHW_FORMAT_RGBA32_SINT, RHW_VERTEX_SINT32X4, S | C | I | U | W},
    {"R32G32B32A32_SFLOAT", RHW_FORMAT_RGBA32_FLOAT, RHW_VERTEX_FLOAT4, S | C | I | U | W},
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

static uint32_t required_of(int i)
{
    const uint32_t features = required[i].features;
    return features | (features & S ? BLIT_SOURCE : 0) | (features & C ? BLIT_DESTINATION : 0);
}

static const char *marks(uint32_t features)
{
    static char text[2][FEATURES + 1];
    static int which;
    char *const out = text[which = !which];
    for (int i = 0; i < FEATURES; i++) {
        out[i] = features >> i & 1 ? "sfcbdtiau><wm"[i] : '.';
    }
    out[FEATURES] = 0;
    return out;
}

// What comes of it -------------------------------------------------------------------------------------

enum { SIDE = 24, TEXELS = SIDE * SIDE }; // whole blocks

static bool is_integer(enum rhw_format format)
{
    return rhw_format_is_integer(rhw_format_info(format));
}

// What every value of a format can become.
static enum rhw_format widest_of(enum rhw_format format)
{
    const bool is_unsigned = rhw_format_info(format)->type == rhw_format_info(RHW_FORMAT_RGBA32_UINT)->type;
    return rhw_format_features(format) & (D | T) ? format
           : !is_integer(format)                 ? RHW_FORMAT_RGBA32_FLOAT
           : is_unsigned                         ? RHW_FORMAT_RGBA32_UINT
                                                 : RHW_FORMAT_RGBA32_SINT;
}

// The first `channels` of all texels are 1, and alpha; of compressed formats, which are not cleared, 0.
static rhw_texture make_ones(const struct rig *rig, enum rhw_format format, int channels)
{
    static const unsigned char blocks[16 * TEXELS];
    const struct rhw_texture_def def = {.format = format, .width = SIDE, .height = SIDE};
    struct rhw_clear_value ones = {.depth = 1, .stencil = 1};
    for (int c = 0; c < 4; c++) {
        const bool is_one = c < channels || c == 3;
        ones.color[c] = is_one && !is_integer(format);
        ones.color_integer[c] = is_one && is_integer(format);
    }
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    if (rhw_format_decoded(format) == format) {
        rhw_texture_clear(rig->context, texture, NULL, &ones);
    } else {
        rhw_texture_write(rig->context, texture, 0, blocks, 0);
    }
    return texture;
}

// Whether a blit gives what a clear gives of the same value; of compressed formats, whose texels test_block_decoders
// checks, whether it is done.
static bool blits(struct rig *rig, enum rhw_format from, enum rhw_format to, enum rhw_filter filter)
{
    static unsigned char read[2][16 * TEXELS];
    const rhw_texture source = make_ones(rig, from, 4),
                      ones = make_ones(rig, to, rhw_format_info(from)->channels);
    const struct rhw_texture_def def = {.format = to, .width = SIDE, .height = SIDE};
    rhw_texture target;
    memset(read, 0, sizeof read);
    assert_int_equal(rhw_texture_create(rig->context, &def, &target), RHW_OK);
    const bool is_done = rhw_texture_blit(rig->context, source, NULL, target, NULL, filter) == RHW_OK;
    if (is_done && rhw_format_decoded(from) == from) {
        rhw_texture_read(rig->context, target, 0, read[0], 0);
        rhw_texture_read(rig->context, ones, 0, read[1], 0);
    }
    rhw_texture_destroy(rig->context, source);
    rhw_texture_destroy(rig->context, ones);
    rhw_texture_destroy(rig->context, target);
    return is_done && memcmp(read[0], read[1], sizeof read[0]) == 0;
}

// Reads texel 1 of slot 0, and stores it as texel 1 of slot 1, whose texel 2 it adds 1 to.
static void move_texel(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_int one[1] = {rhw_splat_int(1)}, two[1] = {rhw_splat_int(2)};
        const struct rhw_storage_request add = {
            .operation = RHW_STORAGE_ADD, .mask = &f->mask, .index = two, .value = one};
        rhw_image_load(f->textures, 0, one, f->color[0]);
        rhw_image_store(f->textures, 1, one, &f->mask, f->color[0]);
        rhw_image_atomic(f->textures, 1, &add, NULL);
    }
}

// The texel buffers that a format can be: a fragment moves a texel of ones.
static uint32_t texel_buffers(struct rig *rig, enum rhw_format format)
{
    const size_t size = rhw_format_size(format);
    static unsigned char ones[16 * TEXELS], moved[4 * 16];
    struct rig_vertex vertices[6];
    rhw_buffer buffers[2];
    const rhw_texture texture = make_ones(rig, format, 4);
    rhw_texture_read(rig->context, texture, 0, ones, 0);
    const struct rhw_buffer_def source = {.size = 4 * size, .data = ones}, target = {.size = 4 * size};
    assert_int_equal(rhw_buffer_create(rig->context, &source, &buffers[0]), RHW_OK);
    assert_int_equal(rhw_buffer_create(rig->context, &target, &buffers[1]), RHW_OK);
    rig_cover(rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(rig);
    rhw_pass_set_read_only_texel_buffer(rig->context, rig->recording, 0, buffers[0], format, 0, 0);
    rhw_pass_set_texel_buffer(rig->context, rig->recording, 1, buffers[1], format, 0, 0);
    rig_draw(rig, vertices, 6);
    rig_end(rig);
    const float *const pixel = rig_read_float4(rig)[0];
    int32_t bits;
    memcpy(&bits, pixel, sizeof bits);
    rhw_buffer_read(rig->context, buffers[1], 0, moved, 4 * size);
    uint32_t features = (is_integer(format) ? bits == 1 : pixel[0] == 1) ? U : 0;
    features |= memcmp(moved + size, ones, size) == 0 ? W : 0;
    features |= size == 4 && memcmp(moved + 2 * size, "\1\0\0", 4) == 0 ? M : 0;
    rhw_buffer_destroy(rig->context, buffers[0]);
    rhw_buffer_destroy(rig->context, buffers[1]);
    rhw_texture_destroy(rig->context, texture);
    return features;
}

// Those that the library says, without texel buffers of which nothing comes, and what comes of blits.
static uint32_t features_of(struct rig *rig, enum rhw_format format)
{
    const uint32_t said = rhw_format_features(format);
    uint32_t features = said & ~(uint32_t)U;
    if (format == RHW_FORMAT_NONE) {
        return 0;
    }
    const enum rhw_filter filter = said & F && !(said & (D | T)) ? RHW_FILTER_LINEAR : RHW_FILTER_NEAREST;
    features |= blits(rig, format, widest_of(format), filter) ? BLIT_SOURCE : 0;
    if (rhw_format_decoded(format) == format) {
        features |= blits(rig, widest_of(format), format, RHW_FILTER_NEAREST) ? BLIT_DESTINATION : 0;
    }
    return features | (said & U ? texel_buffers(rig, format) : 0);
}

static void open_rig(struct rig *rig)
{
    rig_open(rig, 1, 1);
    rig_set_program(rig, rig_vertex_pass, move_texel);
    rig->pipeline.program.uses = RHW_USE_EFFECTS;
}

static void test_what_vulkan_requires(void **state)
{
    (void)state;
    const size_t bytes[] = {1, 2, 4, 8, 12, 16};
    struct rig rig;
    open_rig(&rig);
    print_message(
        "s sampled, f filtered, c colour attachment, b blended, d depth, t stencil, i storage image,\n"
        "a with atomics, u uniform texel buffer, > blit source, < blit destination, w storage texel "
        "buffer,\n"
        "m with atomics, v vertex\n"
        "Vulkan 1.0                 requires         rhw has\n");
    for (int i = 0; i < FORMATS; i++) {
        const uint32_t features = features_of(&rig, required[i].format), wanted = required_of(i);
        const char vertex = required[i].vertex == NO_VERTEX ? '.' : 'v';
        print_message("%-26s %s%c   %s%c\n", required[i].vulkan, marks(wanted), vertex, marks(features),
                      vertex);
        if ((features & wanted) != wanted) {
            fail_msg("%s: Vulkan wants %s, rhw has %s", required[i].vulkan, marks(wanted), marks(features));
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
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_what_vulkan_requires)};

const struct unit_tests test_required_formats = UNIT_TESTS(tests, NULL, NULL);
