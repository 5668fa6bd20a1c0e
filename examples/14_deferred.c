// SPDX-License-Identifier: MIT
// Lesson 14: deferred shading. What light needs to know of a pixel is drawn first, into four targets at once; then one
// triangle over the picture fetches it and adds up the lights, once for every pixel, however much lay behind it.
//
//     target 0   the surface's colour        RGBA8_UNORM
//     target 1   its normal                  RGBA16_FLOAT
//     target 2   its place in the world      RGBA32_FLOAT
//     target 3   what it belongs to          R32_UINT; 0 where there is nothing
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "solid.h"

enum { SIZE = 480, THUMB = 120, SCALE = 4, SCALE_LEVELS = 3, TARGETS = 4, ROWS = 5, LIGHTS = 24 };

static const float eye[3] = {3.4f, 4.2f, 6.4f}, target_point[3] = {0, 0.1f, 0}, zoom = 2.2f;
static const enum rhw_format formats[TARGETS] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA16_FLOAT,
                                                 RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_R32_UINT};

struct uniforms {
    float camera[16];
    float center[3], size[3], color[3];
    uint32_t id;
};

struct surface {
    rhw_float normal[3], world[3];
};

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        struct surface *out = RHW_VARYINGS_OUT(struct surface, groups[i].varying);
        for (int k = 0; k < 3; k++) {
            out->world[k] = groups[i].attribute[0][k] * u->size[k] + u->center[k];
            out->normal[k] = groups[i].attribute[1][k] / u->size[k];
        }
        rhw_mat4_mul_point(u->camera, out->world, groups[i].position);
    }
}

// A triangle over everything, made of nothing.
static void cover(struct rhw_vertex *groups, int count)
{
    static const float corners[6] = {-1, -1, 3, -1, -1, 3};
    for (int i = 0; i < count; i++) {
        groups[i].position[0] = rhw_gather(corners, 6, 2 * groups[i].vertex_index);
        groups[i].position[1] = rhw_gather(corners, 6, 2 * groups[i].vertex_index + 1);
        groups[i].position[2] = rhw_splat(0);
        groups[i].position[3] = rhw_splat(1);
    }
}

// Lights stand in rings over the ground, of all colours.
static void find_light(int i, float at[3], float color[3])
{
    const float angle = 2.39996323f * (float)i,
                radius = 0.75f * rhw_sqrt1((float)i + 0.5f); // as seeds of a sunflower
    at[0] = radius * rhw_sin1(angle);
    at[1] = 0.45f;
    at[2] = radius * rhw_cos1(angle);
    for (int k = 0; k < 3; k++) {
        color[k] = 0.35f + 0.35f * rhw_cos1(angle - 2.0943951f * (float)k);
    }
}

// What arrives from all lights at a point, by the square of its distance, in the colours of the surface.
static void shade(const rhw_float color[3], const rhw_float normal[3], const rhw_float world[3],
                  rhw_float light[3])
{
    for (int k = 0; k < 3; k++) {
        light[k] = color[k] * 0.03f;
    }
    for (int i = 0; i < LIGHTS; i++) {
        float at[3], shines[3];
        find_light(i, at, shines);
        rhw_float to[3];
        for (int k = 0; k < 3; k++) {
            to[k] = at[k] - world[k];
        }
        const rhw_float square = rhw_dot3(to, to), cosine = rhw_dot3(to, normal) / rhw_sqrt(square);
        const rhw_float arrives = rhw_max(cosine, 0.0f) / (square * 4.0f + 0.15f);
        for (int k = 0; k < 3; k++) {
            light[k] += color[k] * arrives * shines[k];
        }
    }
}

static void keep(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        const struct surface *in = RHW_VARYINGS(struct surface, groups[i].varying);
        rhw_float(*color)[4] = groups[i].color;
        rhw_normalize3(in->normal, color[1]);
        for (int k = 0; k < 3; k++) {
            color[0][k] = rhw_splat(u->color[k]);
            color[2][k] = in->world[k];
        }
        color[0][3] = color[1][3] = color[2][3] = rhw_splat(1);
        color[3][0] = rhw_float_from_bits(rhw_splat_int((int32_t)u->id)); // integers travel as bits
    }
}

// The second pass: what was kept at this pixel becomes light.
static void add_lights(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const rhw_int at[2] = {rhw_int_from_float(groups[i].coord[0]),
                               rhw_int_from_float(groups[i].coord[1])};
        rhw_float kept[TARGETS][4], light[3];
        for (int t = 0; t < TARGETS; t++) {
            rhw_sample_fetch(groups[i].textures, t, at, NULL, kept[t]);
        }
        shade(kept[0], kept[1], kept[2], light);
        const rhw_int nothing = rhw_equal_int(rhw_bits_from_float(kept[3][0]), rhw_splat_int(0));
        for (int k = 0; k < 3; k++) {
            groups[i].color[0][k] = rhw_select(nothing, 0.01f, light[k]);
        }
        groups[i].color[0][3] = rhw_splat(1);
    }
}

// For comparison: the same light where the surface is drawn.
static void shade_at_once(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        const struct surface *in = RHW_VARYINGS(struct surface, groups[i].varying);
        rhw_float normal[3], color[3], light[3];
        rhw_normalize3(in->normal, normal);
        for (int k = 0; k < 3; k++) {
            color[k] = rhw_splat(u->color[k]);
        }
        shade(color, normal, in->world, light);
        memcpy(groups[i].color[0], light, sizeof light);
        groups[i].color[0][3] = rhw_splat(1);
    }
}

static rhw_pipeline make_world_pipeline(rhw_context *context, rhw_fragment_function *fragment,
                                        const enum rhw_format *target_formats, int count)
{
    struct rhw_pipeline_def def = solid_pipeline_def();
    def.program = (struct rhw_program){.vertex = {place},
                                       .fragment = {fragment},
                                       .varyings = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
                                                    RHW_VARYING(struct surface, world, RHW_SMOOTH, false)},
                                       .varying_count = 2,
                                       .uniform_size = sizeof(struct uniforms)};
    def.cull = RHW_CULL_BACK;
    def.target_count = count;
    def.label = "world";
    for (int t = 0; t < count; t++) {
        def.targets[t].format = target_formats[t];
    }
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

// Draws the ground, and balls and boxes in rows, into `count` targets.
static void draw_world(rhw_context *context, rhw_fragment_function *fragment, const rhw_texture *targets,
                       int count)
{
    const rhw_buffer buffer = solid_buffer(context);
    enum rhw_format target_formats[TARGETS];
    struct rhw_pass_def attachments = {
        .color_count = count, .depth = {.enabled = true, .store = RHW_STORE_DISCARD}, .label = "world"};
    for (int t = 0; t < count; t++) {
        attachments.colors[t].texture = targets[t];
        target_formats[t] = rhw_texture_format(context, targets[t]);
    }
    const rhw_pipeline pipeline = make_world_pipeline(context, fragment, target_formats, count);
    struct uniforms uniforms = {
        .center = {0, -0.1f, 0}, .size = {4, 0.1f, 4}, .color = {0.8f, 0.8f, 0.8f}, .id = 1};
    solid_camera(eye, target_point, zoom, uniforms.camera);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, buffer, 0);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    solid_draw(context, pass, SOLID_BOX, 1);
    for (int i = 0; i < ROWS * ROWS; i++) {
        const bool is_ball = i % 2 == 0;
        for (int k = 0; k < 3; k++) {
            uniforms.size[k] = is_ball ? 0.36f : 0.26f;
            uniforms.color[k] = 0.45f + 0.4f * (float)((i * (k + 2)) % 5 - 2) / 4;
        }
        uniforms.center[0] = 1.35f * (float)(i % ROWS - ROWS / 2);
        uniforms.center[1] = uniforms.size[1];
        uniforms.center[2] = 1.35f * (float)(i / ROWS - ROWS / 2);
        uniforms.id = (uint32_t)i + 2;
        rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
        solid_draw(context, pass, is_ball ? SOLID_BALL : SOLID_BOX, 1);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_buffer_destroy(context, buffer);
    rhw_pipeline_destroy(context, pipeline);
}

// The lights, from what four textures have kept.
static void draw_light(rhw_context *context, const rhw_texture kept[TARGETS], rhw_texture target)
{
    const struct rhw_pipeline_def def = {
        .program = {.vertex = {cover}, .fragment = {add_lights}, .uses = RHW_USE_COORD},
        .targets = {{.format = rhw_texture_format(context, target)}},
        .target_count = 1,
        .label = "light"};
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    rhw_sampler sampler; // fetching needs none of it; integers are not filtered
    must(rhw_sampler_create(
             context,
             &(struct rhw_sampler_def){.min_filter = RHW_FILTER_NEAREST, .mag_filter = RHW_FILTER_NEAREST},
             &sampler),
         "sampler");
    const struct rhw_pass_def attachments = {
        .colors = {{.texture = target}}, .color_count = 1, .label = "light"};
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    for (int t = 0; t < TARGETS; t++) {
        rhw_pass_set_texture(context, pass, t, kept[t], sampler);
    }
    rhw_pass_draw(context, pass, 0, 3, 0, 1);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_sampler_destroy(context, sampler);
    rhw_pipeline_destroy(context, pipeline);
}

// Both passes; `kept` gets the four targets, which have the size of the picture.
static void draw(rhw_context *context, const enum rhw_format target_formats[TARGETS], rhw_texture target,
                 rhw_texture kept[TARGETS])
{
    for (int t = 0; t < TARGETS; t++) {
        kept[t] = picture_target(context, target_formats[t], rhw_texture_width(context, target, 0),
                                 rhw_texture_height(context, target, 0), 1);
    }
    draw_world(context, keep, kept, TARGETS);
    draw_light(context, kept, target);
}

static uint8_t to_byte(float value)
{
    return (uint8_t)(255 * (value < 0 ? 0 : value > 1 ? 1 : value) + 0.5f);
}

// The picture, and beside it every fourth pixel of the four targets, made visible.
static void save(rhw_context *context, const char *directory, rhw_texture picture,
                 const rhw_texture kept[TARGETS])
{
    enum { STEP = SIZE * SCALE / THUMB, WIDE = SIZE + THUMB };
    static uint8_t colors[SIZE * SCALE][SIZE * SCALE][4], out[SIZE][WIDE][4];
    static uint16_t normals[SIZE * SCALE][SIZE * SCALE][4];
    static float places[SIZE * SCALE][SIZE * SCALE][4];
    static uint32_t ids[SIZE * SCALE][SIZE * SCALE];
    uint8_t *pixels = picture_read(context, picture, SCALE_LEVELS - 1);
    must(rhw_texture_read(context, kept[0], 0, colors, 0), "read");
    must(rhw_texture_read(context, kept[1], 0, normals, 0), "read");
    must(rhw_texture_read(context, kept[2], 0, places, 0), "read");
    must(rhw_texture_read(context, kept[3], 0, ids, 0), "read");
    for (int y = 0; y < SIZE; y++) {
        memcpy(out[y], pixels + (size_t)y * SIZE * 4, SIZE * 4);
        for (int x = 0; x < THUMB; x++) {
            const int row = y % THUMB * STEP + STEP / 2, column = x * STEP + STEP / 2;
            for (int k = 0; k < 3; k++) {
                const uint16_t half = normals[row][column][k]; // of −1..1: its sign and size as a grey
                const int grey =
                    half >> 15 ? 128 - (half & 0x7fff) * 128 / 0x3c00 : 128 + half * 127 / 0x3c00;
                const uint8_t shown[TARGETS] = {
                    colors[row][column][k], (uint8_t)(grey < 0 ? 0 : grey),
                    to_byte(0.5f + places[row][column][k] / 7),
                    (uint8_t)((ids[row][column] * 2654435761u) >> (8 * k + 8))}; // a colour for each number
                out[y][SIZE + x][k] = shown[y / THUMB];
            }
        }
    }
    free(pixels);
    picture_write_png(directory, "14_deferred.png", WIDE, SIZE, out[0][0]);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    rhw_texture kept[TARGETS];
    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE * SCALE, SIZE * SCALE, SCALE_LEVELS);
    draw(context, formats, picture, kept);
    must(rhw_texture_generate_mips(context, picture), "mips");
    save(context, directory, picture, kept);

    static float deferred[SIZE * SIZE][4], forward[SIZE * SIZE][4];
    const rhw_texture plain = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, SIZE, SIZE, 1);
    draw(context, formats, plain, kept);
    must(rhw_texture_read(context, plain, 0, deferred, 0), "read");
    draw_world(context, shade_at_once, &plain, 1);
    must(rhw_texture_read(context, plain, 0, forward, 0), "read");
    float most = 0;
    for (int p = 0; p < SIZE * SIZE; p++) {
        for (int k = 0; k < 3 && forward[p][3] == 1; k++) {
            most = rhw_max1(most, rhw_abs1(deferred[p][k] - forward[p][k]));
        }
    }
    printf("light in two passes and at once differ by %.4f at most: what colours and normals lose in their "
           "targets\n",
           (double)most);
    rhw_context_destroy(context);
    return 0;
}
