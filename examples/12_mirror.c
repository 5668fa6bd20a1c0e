// SPDX-License-Identifier: MIT
// Lesson 12: a mirror in the ground, by the stencil test.
//
// What is seen in a mirror is the world on its other side, upside down. It must not be drawn beside the mirror, and
// depth cannot tell where that is: the stencil does. One pass, in this order:
//
//     1  the world
//     2  the mirror's surface into the stencil alone: 1 where it is seen
//     3  the world with y turned over, where the stencil is 1; it faces the other way on the screen
//     4  the surface again, a thin layer of colour
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "solid.h"

enum { SIZE = 480, SCALE = 4, SCALE_LEVELS = 3, THINGS = 5, QUADS = 5 };

static const float eye[3] = {1.2f, 2.6f, 6.0f}, target_point[3] = {0, 0.3f, 0}, zoom = 2.6f;
static const float sky[4] = {0.62f, 0.74f, 0.88f, 1}, sun[3] = {0.5f, 0.75f, 0.4330127f};

static const struct thing {
    bool is_ball;
    float center[3], size[3], color[3];
} things[THINGS] = {
    {true, {-0.9f, 0.75f, -0.3f}, {0.55f, 0.55f, 0.55f}, {0.80f, 0.10f, 0.05f}},
    {true, {0.35f, 0.35f, 0.7f}, {0.30f, 0.30f, 0.30f}, {0.90f, 0.60f, 0.08f}},
    {false, {0.9f, 0.62f, -0.7f}, {0.35f, 0.60f, 0.35f}, {0.08f, 0.25f, 0.55f}},
    {false, {-0.35f, 0.22f, -1.3f}, {0.20f, 0.20f, 0.20f}, {0.20f, 0.45f, 0.15f}},
    {true, {-0.35f, 0.62f, -1.3f}, {0.20f, 0.20f, 0.20f}, {0.85f, 0.85f, 0.80f}},
};

// The mirror and the ground around it: x0, z0, x1, z1.
static const float quads[QUADS][4] = {{-1.8f, -2, 1.8f, 1.6f},
                                      {-300, -150, 300, -2},
                                      {-300, 1.6f, 300, 6},
                                      {-300, -2, -1.8f, 1.6f},
                                      {1.8f, -2, 300, 1.6f}};

struct uniforms {
    float camera[16];
    float center[3], size[3], color[3];
    float side; // 1; −1 turns the world over
    float id;   // for numbers
};

struct surface {
    rhw_float normal[3], world[3];
};

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        struct surface *out = RHW_VARYINGS_OUT(struct surface, groups[i].varying);
        rhw_float seen[3];
        for (int k = 0; k < 3; k++) {
            out->world[k] = seen[k] = groups[i].attribute[0][k] * u->size[k] + u->center[k];
            out->normal[k] = groups[i].attribute[1][k] / u->size[k];
        }
        seen[1] = seen[1] * u->side;
        rhw_mat4_mul_point(u->camera, seen, groups[i].position);
    }
}

// Light from the sun and the sky. The mirrored world has its own: it is the same world.
static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        const struct surface *in = RHW_VARYINGS(struct surface, groups[i].varying);
        rhw_float normal[3];
        rhw_normalize3(in->normal, normal);
        const rhw_float direct = rhw_max(normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2], 0.0f);
        for (int k = 0; k < 3; k++) {
            groups[i].color[0][k] = u->color[k] * (0.85f * direct + sky[k] * (0.25f + 0.15f * normal[1]));
        }
        groups[i].color[0][3] = rhw_splat(0.25f); // of the mirror's surface; else nothing is blended
    }
}

// For numbers: the point of the world, and what it belongs to; the mirror's own surface is left out.
static void show_point(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        memcpy(groups[i].color[0], RHW_VARYINGS(struct surface, groups[i].varying)->world,
               3 * sizeof(rhw_float));
        groups[i].color[0][3] = rhw_splat(u->id * u->side);
    }
}

enum stage { WORLD, MARK, MIRRORED, SURFACE, STAGES };

static void make_pipelines(rhw_context *context, rhw_fragment_function *fragment, enum rhw_format format,
                           rhw_pipeline pipelines[STAGES])
{
    for (int stage = 0; stage < STAGES; stage++) {
        struct rhw_pipeline_def def = solid_pipeline_def();
        def.program =
            (struct rhw_program){.vertex = {place},
                                 .fragment = {fragment},
                                 .varyings = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
                                              RHW_VARYING(struct surface, world, RHW_SMOOTH, false)},
                                 .varying_count = 2,
                                 .uniform_size = sizeof(struct uniforms)};
        def.cull = RHW_CULL_BACK;
        def.targets[0].format = format;
        def.target_count = 1;
        def.label = "lesson 12";
        const struct rhw_stencil_face where_marked = {.compares = true, .compare = RHW_COMPARE_EQUAL};
        struct rhw_color_target *const target = &def.targets[0];
        switch ((enum stage)stage) {
        case MARK: // where the surface is not hidden the stencil becomes the reference, 1; no colour, no depth
            def.stencil_test = def.depth_read_only = true;
            def.stencil_front = (struct rhw_stencil_face){.pass = RHW_STENCIL_REPLACE};
            target->write_mask = RHW_WRITE_NONE;
            break;
        case MIRRORED:
            def.stencil_test = true;
            def.stencil_front = where_marked;
            def.front = RHW_CLOCKWISE;
            break;
        case SURFACE:
            def.stencil_test = def.depth_read_only = true;
            def.stencil_front = where_marked;
            target->blend = true;
            target->color =
                (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, 0};
            break;
        default: break;
        }
        must(rhw_pipeline_create(context, &def, &pipelines[stage]), "pipeline");
    }
}

static void draw_quad(rhw_context *context, rhw_pass pass, struct uniforms *uniforms, const float quad[4])
{
    for (int k = 0; k < 2; k++) {
        uniforms->center[2 * k] = 0.5f * (quad[k] + quad[2 + k]);
        uniforms->size[2 * k] = 0.5f * (quad[2 + k] - quad[k]);
    }
    uniforms->center[1] = 0;
    uniforms->size[1] = 1;
    rhw_pass_set_uniforms(context, pass, uniforms, sizeof *uniforms);
    solid_draw(context, pass, SOLID_SQUARE, 1);
}

static void draw_things(rhw_context *context, rhw_pass pass, struct uniforms *uniforms)
{
    for (int i = 0; i < THINGS; i++) {
        memcpy(uniforms->center, things[i].center, sizeof uniforms->center);
        memcpy(uniforms->size, things[i].size, sizeof uniforms->size);
        memcpy(uniforms->color, things[i].color, sizeof uniforms->color);
        uniforms->id = (float)(i + 1);
        rhw_pass_set_uniforms(context, pass, uniforms, sizeof *uniforms);
        solid_draw(context, pass, things[i].is_ball ? SOLID_BALL : SOLID_BOX, 1);
    }
}

static void draw(rhw_context *context, rhw_fragment_function *fragment, rhw_texture target)
{
    static const float stone[3] = {0.50f, 0.47f, 0.42f}, glass[3] = {0.10f, 0.22f, 0.25f};
    rhw_pipeline pipelines[STAGES];
    make_pipelines(context, fragment, rhw_texture_format(context, target), pipelines);
    const rhw_buffer vertices = solid_buffer(context);
    struct rhw_pass_def attachments = {.colors = {{.texture = target}},
                                       .color_count = 1,
                                       .depth = {.enabled = true,
                                                 .format = RHW_FORMAT_D32_FLOAT_S8_UINT,
                                                 .store = RHW_STORE_DISCARD,
                                                 .stencil_store = RHW_STORE_DISCARD},
                                       .label = "mirror"};
    if (fragment == paint) {
        memcpy(attachments.colors[0].clear, sky, sizeof sky);
    }
    struct uniforms uniforms = {.side = 1};
    solid_camera(eye, target_point, zoom, uniforms.camera);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    rhw_pass_set_stencil_reference(context, pass, 1, 1);

    rhw_pass_set_pipeline(context, pass, pipelines[WORLD]);
    draw_things(context, pass, &uniforms);
    memcpy(uniforms.color, stone, sizeof stone);
    uniforms.id = THINGS + 1;
    for (int i = 1; i < QUADS; i++) {
        draw_quad(context, pass, &uniforms, quads[i]);
    }
    rhw_pass_set_pipeline(context, pass, pipelines[MARK]);
    draw_quad(context, pass, &uniforms, quads[0]);

    rhw_pass_set_pipeline(context, pass, pipelines[MIRRORED]);
    uniforms.side = -1;
    draw_things(context, pass, &uniforms);
    uniforms.side = 1;
    if (fragment == paint) {
        rhw_pass_set_pipeline(context, pass, pipelines[SURFACE]);
        memcpy(uniforms.color, glass, sizeof glass);
        draw_quad(context, pass, &uniforms, quads[0]);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_buffer_destroy(context, vertices);
    for (int i = 0; i < STAGES; i++) {
        rhw_pipeline_destroy(context, pipelines[i]);
    }
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE * SCALE, SIZE * SCALE, SCALE_LEVELS);
    draw(context, paint, picture);
    must(rhw_texture_generate_mips(context, picture), "mips");
    picture_save(context, picture, SCALE_LEVELS - 1, directory, "12_mirror.png");

    static float points[SIZE * SIZE][4];
    int seen[THINGS] = {0}, mirrored[THINGS] = {0};
    const rhw_texture plain = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, SIZE, SIZE, 1);
    draw(context, show_point, plain);
    must(rhw_texture_read(context, plain, 0, points, 0), "read");
    for (int p = 0; p < SIZE * SIZE; p++) {
        const int id = (int)points[p][3];
        if (id > 0 && id <= THINGS) {
            seen[id - 1]++;
        } else if (id < 0) {
            mirrored[-id - 1]++;
        }
    }
    for (int i = 0; i < THINGS; i++) {
        printf("%s %d: %5d pixels, %5d in the mirror\n", things[i].is_ball ? "ball" : "box ", i + 1, seen[i],
               mirrored[i]);
    }
    rhw_context_destroy(context);
    return 0;
}
