// SPDX-License-Identifier: MIT
// Kinds of textures and what is asked of them.
#include <string.h>

#include "scenes.h"

// Coordinates as value.x, y over the target, and what lies behind, from `low` to `high`.
static void add_textured(struct frame *f, const struct shader_pair *shaders, const float low[4],
                         const float high[4])
{
    frame_add_quad(f, 0, 0, f->width, f->height, 0, low, high);
    frame_add_draw(f, frame_draw_default(f, shaders));
}

static struct frame_texture *add_texture(struct frame *f, enum rhw_format format, enum rhw_texture_kind kind,
                                         int size)
{
    struct frame_texture *const t = &f->textures[f->texture_count++];
    t->def = (struct rhw_texture_def){
        .format = format, .kind = kind, .width = size, .height = size, .mip_levels = 1};
    t->sampler = (struct rhw_sampler_def){.min_filter = RHW_FILTER_NEAREST,
                                          .mag_filter = RHW_FILTER_NEAREST,
                                          .mip_filter = RHW_MIP_FILTER_NONE,
                                          .address_u = RHW_ADDRESS_CLAMP,
                                          .address_v = RHW_ADDRESS_CLAMP,
                                          .address_w = RHW_ADDRESS_CLAMP};
    return t;
}

static void paint_plain(struct rhw_fragment1 *f)
{
    rhw_sample_lod1(f->bindings, 0, f->varying, 0, f->color[0]);
}

static const struct shader_pair plain = {.fragment =
                                             "uniform sampler2D texture0; out vec4 color; void main() { "
                                             "color = textureLod(texture0, values.xy, 0.0); }",
                                         .fragment1 = paint_plain};

static const float zero[4], one[4] = {1, 1, 1, 1};
// Off the borders of texels, where rounding decides for one or the other.
static const float wide_low[4] = {-1.501f, -1.251f, 0, 0}, wide_high[4] = {2.251f, 2.501f, 1, 1};

static void add_wrap(struct frame *f, enum rhw_address u, enum rhw_address v, enum rhw_filter filter)
{
    frame_begin(f, 256, 256);
    struct frame_texture *const t = add_texture(f, RHW_FORMAT_RGBA8_UNORM, RHW_TEXTURE_2D, 16);
    const float border[4] = {0.25f, 0.5f, 0.75f, 0.5f};
    t->sampler.address_u = u;
    t->sampler.address_v = v;
    t->sampler.min_filter = t->sampler.mag_filter = filter;
    memcpy(t->sampler.border, border, sizeof border);
    add_textured(f, &plain, wide_low, wide_high);
}

static void wrap_repeat(struct frame *f)
{
    add_wrap(f, RHW_ADDRESS_REPEAT, RHW_ADDRESS_MIRROR, RHW_FILTER_NEAREST);
}

static void wrap_clamp(struct frame *f)
{
    add_wrap(f, RHW_ADDRESS_CLAMP, RHW_ADDRESS_BORDER, RHW_FILTER_NEAREST);
}

static void wrap_linear(struct frame *f)
{
    add_wrap(f, RHW_ADDRESS_REPEAT, RHW_ADDRESS_MIRROR, RHW_FILTER_LINEAR);
}

static void wrap_border_linear(struct frame *f)
{
    add_wrap(f, RHW_ADDRESS_BORDER, RHW_ADDRESS_CLAMP, RHW_FILTER_LINEAR);
}

static void add_format(struct frame *f, enum rhw_format format, enum rhw_format target, int size)
{
    frame_begin(f, 128, 128);
    f->formats[0] = target;
    add_texture(f, format, RHW_TEXTURE_2D, size);
    add_textured(f, &plain, zero, one);
}

static void format_srgb(struct frame *f)
{
    add_format(f, RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_RGBA16_FLOAT, 64);
}

static void format_packed(struct frame *f)
{
    add_format(f, RHW_FORMAT_RGB10A2_UNORM, RHW_FORMAT_RGBA16_FLOAT, 64);
}

static void format_small_float(struct frame *f)
{
    add_format(f, RHW_FORMAT_RGB9E5_FLOAT, RHW_FORMAT_RGBA16_FLOAT, 64);
}

static void format_etc2(struct frame *f)
{
    add_format(f, RHW_FORMAT_ETC2_RGB8_UNORM, RHW_FORMAT_RGBA8_UNORM, 128);
}

static void format_etc2_alpha(struct frame *f)
{
    add_format(f, RHW_FORMAT_ETC2_RGBA8_SRGB, RHW_FORMAT_RGBA8_SRGB, 128);
}

static void format_etc2_punched(struct frame *f)
{
    add_format(f, RHW_FORMAT_ETC2_RGB8A1_UNORM, RHW_FORMAT_RGBA8_UNORM, 128);
}

static void format_eac(struct frame *f)
{
    add_format(f, RHW_FORMAT_EAC_RG11_SNORM, RHW_FORMAT_RGBA16_FLOAT, 128);
}

static void paint_volume(struct rhw_fragment1 *f)
{
    const float at[3] = {f->varying[0], f->varying[1], f->varying[2]};
    rhw_sample_lod1(f->bindings, 0, at, 0, f->color[0]);
}

static const struct shader_pair volume = {.fragment =
                                              "uniform sampler3D texture0; out vec4 color; void main() { "
                                              "color = textureLod(texture0, values.xyz, 0.0); }",
                                          .fragment1 = paint_volume};
static const struct shader_pair layered = {
    .fragment = "uniform sampler2DArray texture0; out vec4 color;\n"
                "void main() { color = textureLod(texture0, values.xyz, 0.0); }",
    .fragment1 = paint_volume};

static void add_volume(struct frame *f, enum rhw_filter filter)
{
    static const float low[4] = {-0.251f, -0.126f, 0.01f, 0}, high[4] = {1.251f, 1.126f, 0.99f, 1};
    frame_begin(f, 256, 256);
    struct frame_texture *const t = add_texture(f, RHW_FORMAT_RGBA8_UNORM, RHW_TEXTURE_3D, 16);
    t->def.depth = 16;
    t->sampler.address_u = t->sampler.address_v = t->sampler.address_w = RHW_ADDRESS_REPEAT;
    t->sampler.min_filter = t->sampler.mag_filter = filter;
    add_textured(f, &volume, low, high);
}

static void volume_nearest(struct frame *f)
{
    add_volume(f, RHW_FILTER_NEAREST);
}

static void volume_linear(struct frame *f)
{
    add_volume(f, RHW_FILTER_LINEAR);
}

static void volume_halves(struct frame *f)
{
    add_volume(f, RHW_FILTER_LINEAR);
    f->textures[0].def.format = RHW_FORMAT_RGBA16_FLOAT;
}

static void layers(struct frame *f)
{
    static const float low[4] = {0, 0, -1, 0}, high[4] = {1, 1, 9, 1};
    frame_begin(f, 256, 256);
    add_texture(f, RHW_FORMAT_RGBA8_UNORM, RHW_TEXTURE_2D, 32)->def.layers = 8;
    add_textured(f, &layered, low, high);
}

// Directions to all six faces.
static void around(const float *value, float direction[3])
{
    direction[0] = 3.7f * value[0] - 1.9f;
    direction[1] = 3.1f * value[1] - 1.6f;
    direction[2] = 1 - 4 * value[0] * value[1];
}

#define AROUND                                                                                        \
    "vec3 around() { return vec3(3.7 * values.x - 1.9, 3.1 * values.y - 1.6, 1.0 - 4.0 * values.x * " \
    "values.y); }\n"

static void paint_cube(struct rhw_fragment1 *f)
{
    float at[3];
    around(f->varying, at);
    rhw_sample_lod1(f->bindings, 0, at, 0, f->color[0]);
}

static const struct shader_pair cube = {.fragment =
                                            "uniform samplerCube texture0; out vec4 color;\n" AROUND
                                            "void main() { color = textureLod(texture0, around(), 0.0); }",
                                        .fragment1 = paint_cube};

static void paint_cubes(struct rhw_fragment1 *f)
{
    float at[4];
    around(f->varying, at);
    at[3] = f->varying[2];
    rhw_sample_lod1(f->bindings, 0, at, 0, f->color[0]);
}

static const struct shader_pair cubes = {
    .fragment = "uniform samplerCubeArray texture0; out vec4 color;\n" AROUND
                "void main() { color = textureLod(texture0, vec4(around(), values.z), 0.0); }",
    .fragment1 = paint_cubes};

static void add_cube(struct frame *f, enum rhw_filter filter)
{
    frame_begin(f, 256, 256);
    struct frame_texture *const t = add_texture(f, RHW_FORMAT_RGBA8_UNORM, RHW_TEXTURE_CUBE, 8);
    t->sampler.min_filter = t->sampler.mag_filter = filter;
    add_textured(f, &cube, zero, one);
}

static void cube_nearest(struct frame *f)
{
    add_cube(f, RHW_FILTER_NEAREST);
}

static void cube_seamless(struct frame *f)
{
    add_cube(f, RHW_FILTER_LINEAR);
}

static void cube_array(struct frame *f)
{
    static const float high[4] = {1, 1, 2.99f, 1};
    frame_begin(f, 256, 256);
    add_texture(f, RHW_FORMAT_RGBA8_UNORM, RHW_TEXTURE_CUBE, 8)->def.layers = 3;
    add_textured(f, &cubes, zero, high);
}

static void paint_fetch(struct rhw_fragment1 *f)
{
    const int32_t at[2] = {(int32_t)(f->varying[0] * 32), (int32_t)(f->varying[1] * 32)};
    rhw_sample_fetch1(f->bindings, 0, at, (int32_t)(f->varying[2] * 3), f->color[0]);
}

static const struct shader_pair fetch = {
    .fragment = "uniform sampler2D texture0; out vec4 color;\n"
                "void main() { color = texelFetch(texture0, ivec2(values.xy * 32.0), int(values.z * 3.0)); }",
    .fragment1 = paint_fetch};
static const struct shader_pair fetch_unsigned = {
    .fragment = "uniform usampler2D texture0; out uvec4 color;\n"
                "void main() { color = texelFetch(texture0, ivec2(values.xy * 32.0), int(values.z * 3.0)); }",
    .fragment1 = paint_fetch};

static void fetches(struct frame *f)
{
    static const float low[4] = {0, 0, 0, 0}, high[4] = {0.249f, 0.249f, 0.999f, 1};
    frame_begin(f, 256, 256);
    add_texture(f, RHW_FORMAT_RGBA8_UNORM, RHW_TEXTURE_2D, 32)->def.mip_levels = 3;
    add_textured(f, &fetch, low, high);
}

static void fetches_unsigned(struct frame *f)
{
    static const float high[4] = {0.249f, 0.249f, 0.999f, 1};
    frame_begin(f, 256, 256);
    f->formats[0] = RHW_FORMAT_RGBA32_UINT;
    add_texture(f, RHW_FORMAT_RGBA16_UINT, RHW_TEXTURE_2D, 32)->def.mip_levels = 3;
    add_textured(f, &fetch_unsigned, zero, high);
}

static void paint_gather(struct rhw_fragment1 *f)
{
    const struct rhw_sample_request1 request = {.coordinates = f->varying};
    rhw_sample_gather1(f->bindings, 0, &request, 2, f->color[0]);
}

static const struct shader_pair gather = {.fragment =
                                              "uniform sampler2D texture0; out vec4 color; void main() { "
                                              "color = textureGather(texture0, values.xy, 2); }",
                                          .fragment1 = paint_gather};

static void gathers(struct frame *f)
{
    frame_begin(f, 256, 256);
    struct frame_texture *const t = add_texture(f, RHW_FORMAT_RGBA8_UNORM, RHW_TEXTURE_2D, 16);
    t->sampler.address_u = RHW_ADDRESS_REPEAT;
    add_textured(f, &gather, wide_low, wide_high);
}

static void paint_offset(struct rhw_fragment1 *f)
{
    static const int32_t offset[2] = {3, -5};
    const struct rhw_sample_request1 request = {.coordinates = f->varying, .offset = offset};
    rhw_sample1(f->bindings, 0, &request, f->color[0]);
}

static const struct shader_pair offset = {
    .fragment = "uniform sampler2D texture0; out vec4 color;\n"
                "void main() { color = textureLodOffset(texture0, values.xy, 0.0, ivec2(3, -5)); }",
    .fragment1 = paint_offset};

static void offsets(struct frame *f)
{
    frame_begin(f, 256, 256);
    add_texture(f, RHW_FORMAT_RGBA8_UNORM, RHW_TEXTURE_2D, 16)->sampler.address_u = RHW_ADDRESS_REPEAT;
    add_textured(f, &offset, wide_low, wide_high);
}

static void paint_shadow(struct rhw_fragment1 *f)
{
    const float lit = rhw_sample_compare_lod1(f->bindings, 0, f->varying, f->varying[2], 0);
    f->color[0][0] = f->color[0][1] = lit;
    f->color[0][2] = f->varying[2];
    f->color[0][3] = 1;
}

static const struct shader_pair shadow = {.fragment =
                                              "uniform sampler2DShadow texture0; out vec4 color;\n"
                                              "void main() { float lit = textureLod(texture0, values.xyz, "
                                              "0.0); color = vec4(lit, lit, values.z, 1); }",
                                          .fragment1 = paint_shadow};

static void add_shadow(struct frame *f, enum rhw_filter filter, enum rhw_compare compare)
{
    frame_begin(f, 256, 256);
    struct frame_texture *const t = add_texture(f, RHW_FORMAT_D32_FLOAT, RHW_TEXTURE_2D, 32);
    t->sampler.compares = true;
    t->sampler.compare = compare;
    t->sampler.min_filter = t->sampler.mag_filter = filter;
    add_textured(f, &shadow, zero, one);
}

static void shadow_nearest(struct frame *f)
{
    add_shadow(f, RHW_FILTER_NEAREST, RHW_COMPARE_LESS_EQUAL);
}

static void shadow_linear(struct frame *f)
{
    add_shadow(f, RHW_FILTER_LINEAR, RHW_COMPARE_GREATER);
}

// With GALLIVM_PERF=no_aos_sampling, by which the peer mixes in floats, it differs by one unit at most.
static const char coarse_weights[] =
    "the peer mixes 8-bit texels by weights of 8 bits and rounds after every axis";

struct scene_list texture_scenes(void)
{
    static const struct scene scenes[] = {
        {"repeat and mirror", wrap_repeat, NULL, 0, 0},
        {"clamp and border", wrap_clamp, NULL, 0, 0},
        {"repeat and mirror, linear", wrap_linear, NULL, 0, 0},
        {"border and clamp, linear", wrap_border_linear, NULL, 0, 0},
        {"sRGB texels", format_srgb,
         "the peer decodes sRGB by a polynomial, up to 0.1 % of white off; here tables are exact", 16384, 4},
        {"RGB10A2 texels", format_packed, NULL, 0, 0},
        {"RGB9E5 texels", format_small_float, NULL, 0, 0},
        {"ETC2", format_etc2, NULL, 0, 0},
        {"ETC2 with alpha, sRGB", format_etc2_alpha, NULL, 0, 0},
        {"ETC2 with one bit of alpha", format_etc2_punched, NULL, 0, 0},
        {"EAC with signs", format_eac, NULL, 0, 0},
        {"3D texture", volume_nearest, NULL, 0, 0},
        {"3D texture, linear", volume_linear, coarse_weights, 30, 2},
        {"3D texture of half floats, linear", volume_halves, NULL, 0, 0},
        {"array", layers, NULL, 0, 0},
        {"cube", cube_nearest, NULL, 0, 0},
        {"cube, linear across edges", cube_seamless, NULL, 0, 0},
        {"array of cubes", cube_array, NULL, 0, 0},
        {"texels fetched from levels", fetches, NULL, 0, 0},
        {"integers fetched from levels", fetches_unsigned, NULL, 0, 0},
        {"gather", gathers, NULL, 0, 0},
        {"offsets", offsets, NULL, 0, 0},
        {"depth compared", shadow_nearest, NULL, 0, 0},
        {"depth compared, linear", shadow_linear, NULL, 0, 0},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
