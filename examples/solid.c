// SPDX-License-Identifier: MIT
// See solid.h.
#include "solid.h"

#include <stddef.h>
#include <string.h>

#include <rhw/shader.h>

#include "picture.h"

enum {
    RINGS = 48,
    SECTORS = 96,
    BALL_VERTICES = RINGS * SECTORS * 6,
    BOX_VERTICES = 36,
    SQUARE_VERTICES = 6
};

struct solid_vertex {
    float position[3], normal[3];
};

static const int corners[6][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 0}, {0, 1}, {1, 1}};

static void make_ball(struct solid_vertex vertices[BALL_VERTICES])
{
    for (int i = 0; i < BALL_VERTICES; i++) {
        const int field = i / 6, ring = field / SECTORS, sector = field % SECTORS;
        const float polar = (float)(ring + corners[i % 6][1]) * 3.14159265f / RINGS;
        const float turn = (float)(sector + corners[i % 6][0]) * 6.28318531f / SECTORS;
        const float p[3] = {rhw_sin1(polar) * rhw_sin1(turn), rhw_cos1(polar),
                            rhw_sin1(polar) * rhw_cos1(turn)};
        memcpy(vertices[i].position, p, sizeof p);
        memcpy(vertices[i].normal, p, sizeof p);
    }
}

static void make_box(struct solid_vertex vertices[BOX_VERTICES])
{
    for (int i = 0; i < BOX_VERTICES; i++) {
        const int axis = i / 12, side = i / 6 % 2 == 0 ? 1 : -1, *corner = corners[i % 6];
        struct solid_vertex *v = &vertices[i];
        memset(v, 0, sizeof *v);
        v->normal[axis] = v->position[axis] = (float)side;
        v->position[(axis + 1) % 3] = (float)(2 * corner[1] - 1);
        v->position[(axis + 2) % 3] = (float)(side * (2 * corner[0] - 1));
    }
}

static void make_square(struct solid_vertex vertices[SQUARE_VERTICES])
{
    for (int i = 0; i < SQUARE_VERTICES; i++) {
        const int *const corner = corners[i];
        vertices[i] =
            (struct solid_vertex){{(float)(2 * corner[0] - 1), 0, (float)(2 * corner[1] - 1)}, {0, 1, 0}};
    }
}

rhw_buffer solid_buffer(rhw_context *context)
{
    static struct solid_vertex vertices[BALL_VERTICES + BOX_VERTICES + SQUARE_VERTICES];
    make_ball(vertices);
    make_box(vertices + BALL_VERTICES);
    make_square(vertices + BALL_VERTICES + BOX_VERTICES);
    return picture_vertices(context, vertices, sizeof vertices);
}

struct rhw_pipeline_def solid_pipeline_def(void)
{
    return (struct rhw_pipeline_def){
        .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct solid_vertex, position)},
                       {RHW_VERTEX_FLOAT3, 0, offsetof(struct solid_vertex, normal)}},
        .attribute_count = 2,
        .buffer_count = 1,
        .depth_test = true,
    };
}

void solid_draw(rhw_context *context, rhw_pass pass, enum solid solid, int instances)
{
    static const uint32_t counts[] = {BALL_VERTICES, BOX_VERTICES, SQUARE_VERTICES},
                          firsts[] = {0, BALL_VERTICES, BALL_VERTICES + BOX_VERTICES};
    rhw_pass_draw(context, pass, firsts[solid], counts[solid], 0, (uint32_t)instances);
}

void solid_camera(const float eye[3], const float target[3], float zoom, float matrix[16])
{
    float ahead[3], right[3] = {0}, up[3];
    for (int k = 0; k < 3; k++) {
        ahead[k] = target[k] - eye[k];
    }
    rhw_normalize3_1(ahead, ahead);
    right[0] = -ahead[2], right[2] = ahead[0]; // ahead × y
    rhw_normalize3_1(right, right);
    up[0] = right[1] * ahead[2] - right[2] * ahead[1];
    up[1] = right[2] * ahead[0] - right[0] * ahead[2];
    up[2] = right[0] * ahead[1] - right[1] * ahead[0];
    for (int k = 0; k < 3; k++) {
        matrix[4 * k] = zoom * right[k];
        matrix[4 * k + 1] = zoom * up[k];
        matrix[4 * k + 2] = matrix[4 * k + 3] = ahead[k];
    }
    const float near = 0.5f;
    matrix[12] = -zoom * rhw_dot3_1(right, eye);
    matrix[13] = -zoom * rhw_dot3_1(up, eye);
    matrix[15] = -rhw_dot3_1(ahead, eye);
    matrix[14] = matrix[15] - near;
}

void solid_face_camera(int face, const float center[3], float near, float matrix[16])
{
    static const float axes[6][3][3] = {
        // s, t and ahead
        {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
        {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
    const float *s = axes[face][0], *t = axes[face][1], *ahead = axes[face][2];
    for (int k = 0; k < 3; k++) {
        matrix[4 * k] = s[k];
        matrix[4 * k + 1] = -t[k];
        matrix[4 * k + 2] = matrix[4 * k + 3] = ahead[k];
    }
    matrix[12] = -rhw_dot3_1(s, center);
    matrix[13] = rhw_dot3_1(t, center);
    matrix[15] = -rhw_dot3_1(ahead, center);
    matrix[14] = matrix[15] - near;
}
