// SPDX-License-Identifier: MIT
// Lesson 18: six faces of a cube in one pass, and the shadows of a lamp.
//
// A lamp shines in all directions, so its shadow map is a cube. Lesson 13 drew the faces of one in six passes; here they
// are the layers of one pass: everything is drawn as six instances, and the vertex function gives each its face's camera
// and `layer`. A face sees depth 1 − near/m, m being the longest component of what leads from the lamp to the point; so
// that is also what a point is compared with, whatever face it falls on.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "solid.h"

enum { SIZE = 480, SCALE = 4, SCALE_LEVELS = 3, FACE = 1024, FACES = 6, POSTS = 6, THINGS = POSTS + 10 };

static const float eye[3] = {1.6f, 3.4f, 6.4f}, target_point[3] = {0, 0.75f, 0}, zoom = 2.2f;
static const float lamp[3] = {0, 1.05f, 0}, lamp_size = 0.09f, near_plane = 0.1f;
static const float lamp_color[3] = {5.2f, 4.0f, 2.6f}, night[3] = {0.05f, 0.07f, 0.12f};

struct thing {
    bool is_ball;
    float center[3], size[3], color[3];
};

// The room, the lantern's roof and foot, and what stands around; the lantern's posts come after them.
static const struct thing room[THINGS - POSTS] = {
    {false, {0, -0.1f, 0}, {4, 0.1f, 4}, {0.50f, 0.47f, 0.42f}},
    {false, {0, 1.9f, -3.1f}, {4, 2.1f, 0.1f}, {0.55f, 0.50f, 0.45f}},
    {false, {-3.1f, 1.9f, 0}, {0.1f, 2.1f, 4}, {0.42f, 0.50f, 0.55f}},
    {false, {0, 1.58f, 0}, {0.38f, 0.06f, 0.38f}, {0.12f, 0.12f, 0.13f}},
    {false, {0, 0.3f, 0}, {0.30f, 0.3f, 0.30f}, {0.14f, 0.13f, 0.12f}},
    {true, {-1.5f, 0.5f, -1.2f}, {0.5f, 0.5f, 0.5f}, {0.75f, 0.10f, 0.06f}},
    {true, {1.3f, 0.35f, 0.9f}, {0.35f, 0.35f, 0.35f}, {0.85f, 0.55f, 0.06f}},
    {true, {-1.1f, 0.25f, 1.3f}, {0.25f, 0.25f, 0.25f}, {0.10f, 0.45f, 0.20f}},
    {false, {1.5f, 0.55f, -1.5f}, {0.35f, 0.55f, 0.35f}, {0.10f, 0.28f, 0.60f}},
    {true, {0.5f, 0.20f, -1.9f}, {0.20f, 0.20f, 0.20f}, {0.80f, 0.80f, 0.75f}},
};

static struct thing find_thing(int i)
{
    if (i < THINGS - POSTS) {
        return room[i];
    }
    const float turn = 6.28318531f * ((float)(i - (THINGS - POSTS)) + 0.5f) / POSTS;
    return (struct thing){false,
                          {0.32f * rhw_sin1(turn), 1.06f, 0.32f * rhw_cos1(turn)},
                          {0.028f, 0.46f, 0.028f},
                          {0.12f, 0.12f, 0.13f}};
}

struct uniforms {
    float cameras[FACES][16]; // world to clip coordinates: the first of the picture, or one for each face
    float center[3], size[3], color[3];
    float is_lamp; // 1: it shines
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
        rhw_mat4_mul_point(u->cameras[0], out->world, groups[i].position);
    }
}

// An instance for each face. The lanes of a group may be of two instances, so a camera is gathered, not pointed at.
static void place_in_layers(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        const rhw_int face = groups[i].instance_index;
        rhw_float world[3];
        for (int k = 0; k < 3; k++) {
            world[k] = groups[i].attribute[0][k] * u->size[k] + u->center[k];
        }
        for (int r = 0; r < 4; r++) {
            rhw_float sum = rhw_gather(u->cameras[0], FACES * 16, 16 * face + 12 + r);
            for (int k = 0; k < 3; k++) {
                sum += rhw_gather(u->cameras[0], FACES * 16, 16 * face + 4 * k + r) * world[k];
            }
            groups[i].position[r] = sum;
        }
        groups[i].layer = face;
    }
}

// The part of the lamp's light that arrives. The point is moved a little off its surface: else the surface would shade
// itself.
static rhw_float lightness(const struct rhw_fragment *fragment, const rhw_float normal[3])
{
    const rhw_float *world = RHW_VARYINGS(struct surface, fragment->varying)->world;
    rhw_float from[3], longest = rhw_splat(0);
    for (int k = 0; k < 3; k++) {
        from[k] = world[k] - lamp[k];
        longest = rhw_max(longest, rhw_abs(from[k]));
    }
    const rhw_float off = longest * (6.0f / FACE);
    longest = rhw_splat(0);
    for (int k = 0; k < 3; k++) {
        from[k] = from[k] + off * normal[k];
        longest = rhw_max(longest, rhw_abs(from[k]));
    }
    return rhw_sample_compare_lod(fragment->textures, 0, from, 1.0f - near_plane / longest, rhw_splat(0));
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        const struct surface *in = RHW_VARYINGS(struct surface, groups[i].varying);
        rhw_float normal[3], to[3];
        rhw_normalize3(in->normal, normal);
        for (int k = 0; k < 3; k++) {
            to[k] = lamp[k] - in->world[k];
        }
        const rhw_float square = rhw_dot3(to, to);
        const rhw_float cosine = rhw_dot3(to, normal) * rhw_rsqrt(square);
        const rhw_float light = rhw_max(cosine, 0.0f) * lightness(&groups[i], normal) / (0.3f + square);
        for (int k = 0; k < 3; k++) {
            const rhw_float lit =
                u->color[k] * (light * lamp_color[k] + night[k] * (1.2f + 0.6f * normal[1]));
            groups[i].color[0][k] = rhw_mix(lit, lamp_color[k], u->is_lamp);
        }
        groups[i].color[0][3] = rhw_splat(1);
    }
}

// For numbers: what arrives, and the point.
static void show_light(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct surface *in = RHW_VARYINGS(struct surface, groups[i].varying);
        rhw_float normal[3];
        rhw_normalize3(in->normal, normal);
        groups[i].color[0][0] = lightness(&groups[i], normal);
        memcpy(groups[i].color[0] + 1, in->world, sizeof in->world);
    }
}

static rhw_pipeline make_pipeline(rhw_context *context, const struct rhw_program *program,
                                  enum rhw_format format)
{
    struct rhw_pipeline_def def = solid_pipeline_def();
    def.label = "lesson 18";
    def.program = *program;
    def.program.uniform_size = sizeof(struct uniforms);
    def.target_count = format != RHW_FORMAT_NONE;
    def.targets[0].format = format;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

static void draw_thing(rhw_context *context, rhw_pass pass, struct uniforms *uniforms,
                       const struct thing *thing, int faces)
{
    memcpy(uniforms->center, thing->center, sizeof uniforms->center);
    memcpy(uniforms->size, thing->size, sizeof uniforms->size);
    memcpy(uniforms->color, thing->color, sizeof uniforms->color);
    rhw_pass_set_uniforms(context, pass, uniforms, sizeof *uniforms);
    solid_draw(context, pass, thing->is_ball ? SOLID_BALL : SOLID_BOX, faces);
}

// Faces from `first` on, all in one pass.
static void draw_faces(rhw_context *context, rhw_texture cube, rhw_buffer vertices, int first, int count)
{
    const struct rhw_program program = {.vertex = {place_in_layers}, .writes_layer = true};
    const rhw_pipeline pipeline = make_pipeline(context, &program, RHW_FORMAT_NONE);
    const struct rhw_pass_def attachments = {
        .depth = {.enabled = true, .texture = cube, .layer = first, .layer_count = count},
        .label = "what the lamp sees"};
    struct uniforms uniforms = {0};
    for (int layer = 0; layer < count; layer++) { // layers count from the first of the pass
        solid_face_camera(first + layer, lamp, near_plane, uniforms.cameras[layer]);
    }
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    for (int i = 0; i < THINGS; i++) {
        const struct thing thing = find_thing(i);
        draw_thing(context, pass, &uniforms, &thing, count);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_pipeline_destroy(context, pipeline);
}

static rhw_texture make_cube(rhw_context *context)
{
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_D32_FLOAT, .kind = RHW_TEXTURE_CUBE, .width = FACE, .height = FACE};
    rhw_texture cube;
    must(rhw_texture_create(context, &def, &cube), "cube");
    return cube;
}

static void draw(rhw_context *context, rhw_fragment_function *fragment, rhw_texture target)
{
    const struct rhw_program program = {.vertex = {place},
                                        .fragment = {fragment},
                                        .varyings = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
                                                     RHW_VARYING(struct surface, world, RHW_SMOOTH, false)},
                                        .varying_count = 2};
    const rhw_buffer vertices = solid_buffer(context);
    const rhw_texture cube = make_cube(context);
    draw_faces(context, cube, vertices, 0, FACES);
    const rhw_pipeline pipeline = make_pipeline(context, &program, rhw_texture_format(context, target));
    const struct rhw_sampler_def compares = {.compares = true, .compare = RHW_COMPARE_LESS_EQUAL};
    rhw_sampler sampler;
    must(rhw_sampler_create(context, &compares, &sampler), "sampler");
    struct rhw_pass_def attachments = {.colors = {{.texture = target}},
                                       .color_count = 1,
                                       .depth = {.enabled = true, .store = RHW_STORE_DISCARD},
                                       .label = "the room"};
    if (fragment == paint) {
        memcpy(attachments.colors[0].clear, night, sizeof night);
    }
    struct uniforms uniforms = {0};
    solid_camera(eye, target_point, zoom, uniforms.cameras[0]);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    rhw_pass_set_texture(context, pass, 0, cube, sampler);
    for (int i = 0; i < THINGS; i++) {
        const struct thing thing = find_thing(i);
        draw_thing(context, pass, &uniforms, &thing, 1);
    }
    struct thing bulb = {.is_ball = true, .size = {lamp_size, lamp_size, lamp_size}};
    memcpy(bulb.center, lamp, sizeof bulb.center);
    uniforms.is_lamp = 1;
    draw_thing(context, pass, &uniforms, &bulb, 1);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_sampler_destroy(context, sampler);
    rhw_texture_destroy(context, cube);
    rhw_buffer_destroy(context, vertices);
    rhw_pipeline_destroy(context, pipeline);
}

static float *read_faces(rhw_context *context, rhw_texture cube)
{
    float *texels = malloc(sizeof(float) * FACES * FACE * FACE);
    must(texels ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY, "memory");
    for (int face = 0; face < FACES; face++) {
        must(rhw_texture_read_layer(context, cube, 0, face, texels + face * FACE * FACE, 0), "read");
    }
    return texels;
}

// The faces as the cube unfolds, as distances: near dark, far light.
static void write_unfolded(const float *texels, const char *directory)
{
    enum { STEP = 8, SIDE = FACE / STEP, WIDTH = 4 * SIDE, HEIGHT = 3 * SIDE };
    static const int columns[FACES] = {2, 0, 1, 1, 1, 3}, rows[FACES] = {1, 1, 0, 2, 1, 1};
    static uint8_t pixels[HEIGHT][WIDTH][4];
    memset(pixels, 255, sizeof pixels);
    for (int i = 0; i < FACES * SIDE * SIDE; i++) {
        const int face = i / (SIDE * SIDE), y = i / SIDE % SIDE, x = i % SIDE;
        float sum = 0; // of a square of texels
        for (int k = 0; k < STEP * STEP; k++) {
            const float depth = texels[(face * FACE + STEP * y + k / STEP) * FACE + STEP * x + k % STEP];
            const float m = depth < 1 ? near_plane / (1 - depth) : 4;
            sum += m < 4 ? m : 4;
        }
        uint8_t *pixel = pixels[rows[face] * SIDE + y][columns[face] * SIDE + x];
        pixel[0] = pixel[1] = pixel[2] = (uint8_t)(sum * (235.0f / (4 * STEP * STEP)));
    }
    picture_write_png(directory, "18_layers_unfolded.png", WIDTH, HEIGHT, pixels[0][0]);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE * SCALE, SIZE * SCALE, SCALE_LEVELS);
    draw(context, paint, picture);
    must(rhw_texture_generate_mips(context, picture), "mips");
    picture_save(context, picture, SCALE_LEVELS - 1, directory, "18_layers.png");

    const rhw_buffer vertices = solid_buffer(context);
    const rhw_texture together = make_cube(context), apart = make_cube(context);
    draw_faces(context, together, vertices, 0, FACES);
    for (int face = 0; face < FACES; face++) {
        draw_faces(context, apart, vertices, face, 1);
    }
    float *one_pass = read_faces(context, together), *six_passes = read_faces(context, apart);
    write_unfolded(one_pass, directory);
    int equal = 0;
    for (int i = 0; i < FACES * FACE * FACE; i++) {
        equal += memcmp(one_pass + i, six_passes + i, sizeof(float)) == 0;
    }
    printf("%d of %d texels of one pass are those of six\n", equal, FACES * FACE * FACE);
    free(one_pass);
    free(six_passes);

    static float light[SIZE][SIZE][4];
    const rhw_texture plain = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, SIZE, SIZE, 1);
    draw(context, show_light, plain);
    must(rhw_texture_read(context, plain, 0, light, 0), "read");
    int levels[3] = {0, 0, 0}; // none of the lamp's light, some, all of it
    for (int p = 0; p < SIZE * SIZE; p++) {
        const float part = light[p / SIZE][p % SIZE][0];
        levels[part == 0 ? 0 : part < 1 ? 1 : 2]++;
    }
    printf("pixels in shadow: %d, partly: %d, in the light: %d\n", levels[0], levels[1], levels[2]);
    rhw_context_destroy(context);
    return 0;
}
