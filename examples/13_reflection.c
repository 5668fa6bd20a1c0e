// SPDX-License-Identifier: MIT
// Lesson 13: a ball that reflects what is around it, by a cube map.
//
// Six passes look out of the ball's middle, each into a face of a cube texture; their views fit together at the edges.
// The seventh draws the world and, where the ball is, the texel in the direction
//
//     r = i − 2·(n·i)·n      i: from the eye to the point, n: the normal
//
// Which face a direction belongs to, and where on it, is said by a table (Vulkan 1.3, "Cube Map Face Selection"): the
// same one that says how the six views are turned. Filters cross from face to face without a seam.
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "solid.h"

enum { SIZE = 480, SCALE = 4, SCALE_LEVELS = 3, FACE = 512, BALLS = 8, FACES = 6 };

static const float eye[3] = {0, 2.3f, 6.2f}, target_point[3] = {0, 0.85f, 0}, zoom = 2.3f;
static const float mirror_center[3] = {0, 1, 0}, mirror_radius = 1;
static const float sky[3] = {0.45f, 0.62f, 0.90f}, sun[3] = {0.48f, 0.80f, 0.36f};
static const float ring_radius = 2.6f, ball_radius = 0.55f;

struct uniforms {
    float camera[16];
    float eye[3];
    float center[3], radius, color[3];
    float is_ground;
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
            out->world[k] = groups[i].attribute[0][k] * u->radius + u->center[k];
            out->normal[k] = groups[i].attribute[1][k];
        }
        rhw_mat4_mul_point(u->camera, out->world, groups[i].position);
    }
}

// Light from the sun and the sky; the ground has fields of two colours.
static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        const struct surface *in = RHW_VARYINGS(struct surface, groups[i].varying);
        rhw_float normal[3];
        rhw_normalize3(in->normal, normal);
        const rhw_float direct = rhw_max(normal[0] * sun[0] + normal[1] * sun[1] + normal[2] * sun[2], 0.0f);
        const rhw_float field = rhw_fract((rhw_floor(in->world[0]) + rhw_floor(in->world[2])) * 0.5f);
        const rhw_float shade = 1.0f - field * (1.2f * u->is_ground);
        for (int k = 0; k < 3; k++) {
            groups[i].color[0][k] =
                u->color[k] * shade * (0.8f * direct + sky[k] * (0.3f + 0.2f * normal[1]));
        }
        groups[i].color[0][3] = rhw_splat(1);
    }
}

// What the direction of reflection sees; metal takes a little of it.
static void reflect(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const struct uniforms *u = groups[i].uniforms;
        const struct surface *in = RHW_VARYINGS(struct surface, groups[i].varying);
        rhw_float normal[3], incident[3], direction[3];
        rhw_normalize3(in->normal, normal);
        for (int k = 0; k < 3; k++) {
            incident[k] = in->world[k] - u->eye[k];
        }
        rhw_reflect3(incident, normal, direction);
        rhw_sample_lod(groups[i].textures, 0, direction, rhw_splat(0), groups[i].color[0]);
        for (int k = 0; k < 3; k++) {
            groups[i].color[0][k] = groups[i].color[0][k] * u->color[k];
        }
    }
}

// A ring of balls in the colours of the rainbow.
static void find_ball(int i, float center[3], float color[3])
{
    const float angle = 6.28318531f * ((float)i + 0.5f) / BALLS;
    center[0] = ring_radius * rhw_sin1(angle);
    center[1] = ball_radius;
    center[2] = ring_radius * rhw_cos1(angle);
    for (int k = 0; k < 3; k++) {
        const float wave = 0.5f + 0.5f * rhw_cos1(angle - 2.0943951f * (float)k);
        color[k] = 0.06f + 0.8f * wave * wave;
    }
}

static rhw_pipeline make_pipeline(rhw_context *context, rhw_fragment_function *fragment,
                                  enum rhw_format format)
{
    struct rhw_pipeline_def def = solid_pipeline_def();
    def.program = (struct rhw_program){.vertex = {place},
                                       .fragment = {fragment},
                                       .varyings = {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
                                                    RHW_VARYING(struct surface, world, RHW_SMOOTH, false)},
                                       .varying_count = 2,
                                       .uniform_size = sizeof(struct uniforms)};
    def.targets[0].format = format;
    def.target_count = 1;
    def.label = "lesson 13";
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

static void draw_part(rhw_context *context, rhw_pass pass, const struct uniforms *uniforms, enum solid solid)
{
    rhw_pass_set_uniforms(context, pass, uniforms, sizeof *uniforms);
    solid_draw(context, pass, solid, 1);
}

// Everything but the ball in the middle, into a level and layer of a texture.
static rhw_pass begin_world(rhw_context *context, const struct rhw_color_attachment *target,
                            rhw_pipeline pipeline, rhw_buffer vertices, const float camera[16])
{
    struct rhw_pass_def attachments = {.colors = {*target},
                                       .color_count = 1,
                                       .depth = {.enabled = true, .store = RHW_STORE_DISCARD},
                                       .label = "world"};
    memcpy(attachments.colors[0].clear, (const float[]){sky[0], sky[1], sky[2], 1}, 4 * sizeof(float));
    struct uniforms uniforms = {.radius = 300, .color = {0.75f, 0.72f, 0.66f}, .is_ground = 1};
    memcpy(uniforms.camera, camera, sizeof uniforms.camera);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    draw_part(context, pass, &uniforms, SOLID_SQUARE);
    uniforms.is_ground = 0;
    uniforms.radius = ball_radius;
    for (int i = 0; i < BALLS; i++) {
        find_ball(i, uniforms.center, uniforms.color);
        draw_part(context, pass, &uniforms, SOLID_BALL);
    }
    return pass;
}

static rhw_texture draw_cube(rhw_context *context, rhw_buffer vertices)
{
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA16_FLOAT, .kind = RHW_TEXTURE_CUBE, .width = FACE, .height = FACE};
    rhw_texture cube;
    must(rhw_texture_create(context, &def, &cube), "cube");
    const rhw_pipeline pipeline = make_pipeline(context, paint, def.format);
    for (int face = 0; face < FACES; face++) {
        float camera[16];
        solid_face_camera(face, mirror_center, 0.1f, camera);
        const struct rhw_color_attachment target = {.texture = cube, .layer = face};
        must(rhw_pass_end(context, begin_world(context, &target, pipeline, vertices, camera), NULL), "pass");
    }
    rhw_pipeline_destroy(context, pipeline);
    return cube;
}

static void draw(rhw_context *context, rhw_texture target)
{
    const enum rhw_format format = rhw_texture_format(context, target);
    const rhw_buffer vertices = solid_buffer(context);
    const rhw_texture cube = draw_cube(context, vertices);
    const rhw_pipeline world = make_pipeline(context, paint, format),
                       mirror = make_pipeline(context, reflect, format);
    rhw_sampler sampler;
    must(rhw_sampler_create(context, &(struct rhw_sampler_def){0}, &sampler), "sampler");
    struct uniforms uniforms = {.radius = mirror_radius, .color = {0.92f, 0.94f, 0.96f}};
    memcpy(uniforms.eye, eye, sizeof eye);
    memcpy(uniforms.center, mirror_center, sizeof mirror_center);
    solid_camera(eye, target_point, zoom, uniforms.camera);
    const rhw_pass pass = begin_world(context, &(struct rhw_color_attachment){.texture = target}, world,
                                      vertices, uniforms.camera);
    rhw_pass_set_pipeline(context, pass, mirror);
    rhw_pass_set_texture(context, pass, 0, cube, sampler);
    draw_part(context, pass, &uniforms, SOLID_BALL);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_sampler_destroy(context, sampler);
    rhw_texture_destroy(context, cube);
    rhw_buffer_destroy(context, vertices);
    rhw_pipeline_destroy(context, world);
    rhw_pipeline_destroy(context, mirror);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, SIZE * SCALE, SIZE * SCALE, SCALE_LEVELS);
    draw(context, picture);
    must(rhw_texture_generate_mips(context, picture), "mips");
    picture_save(context, picture, SCALE_LEVELS - 1, directory, "13_reflection.png");

    // Neighbouring texels across an edge of the cube see the same world: +x's first column, +z's last.
    const rhw_buffer vertices = solid_buffer(context);
    const rhw_texture cube = draw_cube(context, vertices);
    static uint16_t faces[2][FACE][FACE][4];
    must(rhw_texture_read_layer(context, cube, 0, 0, faces[0], 0), "read");
    must(rhw_texture_read_layer(context, cube, 0, 4, faces[1], 0), "read");
    int equal = 0;
    for (int y = 0; y < FACE; y++) {
        equal += memcmp(faces[0][y][0], faces[1][y][FACE - 1], 8) == 0;
    }
    printf("%d of %d texels along an edge of the cube are those of the face beside it\n", equal, FACE);
    rhw_texture_destroy(context, cube);
    rhw_buffer_destroy(context, vertices);
    rhw_context_destroy(context);
    return 0;
}
