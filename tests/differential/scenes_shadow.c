// SPDX-License-Identifier: MIT
// Depth compared in textures of more than one layer: cubes, arrays, arrays of cubes.
#include "scenes.h"

static void paint(struct rhw_fragment1 *f, const float *at)
{
    const float lit = rhw_sample_compare_lod1(f->bindings, 0, at, f->varying[2], 0);
    f->color[0][0] = f->color[0][1] = lit;
    f->color[0][2] = f->varying[2];
    f->color[0][3] = 1;
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
#define PAINT "color = vec4(lit, lit, values.z, 1); }"

static void paint_cube(struct rhw_fragment1 *f)
{
    float at[3];
    around(f->varying, at);
    paint(f, at);
}

static void paint_array(struct rhw_fragment1 *f)
{
    const float at[3] = {f->varying[0], f->varying[1], f->varying[2] * 5};
    paint(f, at);
}

static void paint_cubes(struct rhw_fragment1 *f)
{
    float at[4];
    around(f->varying, at);
    at[3] = f->varying[0] * 2;
    paint(f, at);
}

static const struct shader_pair cube = {
    .fragment = "uniform samplerCubeShadow texture0; out vec4 color;\n" AROUND
                "void main() { float lit = texture(texture0, vec4(around(), values.z)); " PAINT,
    .fragment1 = paint_cube};
static const struct shader_pair array = {
    .fragment = "uniform sampler2DArrayShadow texture0; out vec4 color; void main() {\n"
                "float lit = texture(texture0, vec4(values.xy, values.z * 5.0, values.z)); " PAINT,
    .fragment1 = paint_array};
static const struct shader_pair cubes = {
    .fragment =
        "uniform samplerCubeArrayShadow texture0; out vec4 color;\n" AROUND
        "void main() { float lit = texture(texture0, vec4(around(), values.x * 2.0), values.z); " PAINT,
    .fragment1 = paint_cubes};

static void add(struct frame *f, const struct shader_pair *shaders, enum rhw_texture_kind kind, int layers,
                enum rhw_filter filter, enum rhw_compare compare)
{
    static const float low[4], high[4] = {1, 1, 0.9f, 1};
    frame_begin(f, 256, 256);
    struct frame_texture *const t = &f->textures[f->texture_count++];
    t->def = (struct rhw_texture_def){.format = RHW_FORMAT_D32_FLOAT,
                                      .kind = kind,
                                      .width = 8,
                                      .height = 8,
                                      .layers = layers,
                                      .mip_levels = 1};
    t->sampler = (struct rhw_sampler_def){.min_filter = filter,
                                          .mag_filter = filter,
                                          .mip_filter = RHW_MIP_FILTER_NONE,
                                          .address_u = RHW_ADDRESS_CLAMP,
                                          .address_v = RHW_ADDRESS_CLAMP,
                                          .compares = true,
                                          .compare = compare};
    frame_add_quad(f, 0, 0, 256, 256, 0, low, high);
    frame_add_draw(f, frame_draw_default(f, shaders));
}

static void cube_nearest(struct frame *f)
{
    add(f, &cube, RHW_TEXTURE_CUBE, 0, RHW_FILTER_NEAREST, RHW_COMPARE_LESS_EQUAL);
}

static void cube_linear(struct frame *f)
{
    add(f, &cube, RHW_TEXTURE_CUBE, 0, RHW_FILTER_LINEAR, RHW_COMPARE_GREATER);
}

static void array_nearest(struct frame *f)
{
    add(f, &array, RHW_TEXTURE_2D, 5, RHW_FILTER_NEAREST, RHW_COMPARE_GREATER_EQUAL);
}

static void array_linear(struct frame *f)
{
    add(f, &array, RHW_TEXTURE_2D, 5, RHW_FILTER_LINEAR, RHW_COMPARE_LESS);
}

static void cubes_nearest(struct frame *f)
{
    add(f, &cubes, RHW_TEXTURE_CUBE, 3, RHW_FILTER_NEAREST, RHW_COMPARE_LESS);
}

struct scene_list shadow_scenes(void)
{
    static const struct scene scenes[] = {
        {"depth compared, cube", cube_nearest, NULL, 0, 0},
        {"depth compared, cube, linear", cube_linear, NULL, 0, 0},
        {"depth compared, array", array_nearest, NULL, 0, 0},
        {"depth compared, array, linear", array_linear, NULL, 0, 0},
        {"depth compared, array of cubes", cubes_nearest, NULL, 0, 0},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
