// SPDX-License-Identifier: MIT
// What deferred.c draws: balls on a floor, lights between them, and the camera.
#ifndef DEFERRED_SCENE_H
#define DEFERRED_SCENE_H

#include "deferred.h"
#include "matrix.h"

enum { WIDTH = 640, HEIGHT = 400, RINGS = 16, SEGMENTS = 32, ROW = 5, LAMPS = 10 };
enum { BALLS = ROW * ROW, LIGHTS = LAMPS * LAMPS + 1 };
enum { BALL_VERTICES = (RINGS + 1) * (SEGMENTS + 1), BALL_INDICES = RINGS * SEGMENTS * 6 };

struct corner {
    float position[3], normal[3];
};

struct thing {
    float center[3], scale, albedo[3];
};

struct light {
    float center[3], radius, color[3];
};

// Corners and indices of all meshes, one behind the other: the ball, then the floor, then the cube.
struct meshes {
    struct corner corners[BALL_VERTICES + 4 + 8];
    uint16_t indices[BALL_INDICES + 6 + 36];
};

// 0 ≤ result < 1, a multiple of 1/65536.
static inline float any(uint32_t *state)
{
    *state = *state * 1664525 + 1013904223;
    return (float)(*state >> 16) / 65536;
}

static inline void make_meshes(struct meshes *m)
{
    static const uint16_t flat[6] = {0, 1, 2, 0, 2, 3};
    // Faces of a cube whose corner i has x, y, z by the bits 1, 2, 4 of i; counter-clockwise seen from outside.
    static const uint16_t cube[36] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                      2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    const float pi = 3.14159265f;
    struct corner *corner = m->corners;
    uint16_t *index = m->indices;
    for (int ring = 0; ring <= RINGS; ring++) {
        for (int segment = 0; segment <= SEGMENTS; segment++, corner++) {
            float sine, height, x, z;
            rhw_sincos1(pi * (float)ring / RINGS, &sine, &height);
            rhw_sincos1(2 * pi * (float)segment / SEGMENTS, &x, &z);
            *corner = (struct corner){{sine * x, height, sine * z}, {sine * x, height, sine * z}};
            if (ring < RINGS && segment < SEGMENTS) {
                const uint16_t quad[4] = {
                    (uint16_t)(corner - m->corners), (uint16_t)(corner - m->corners + SEGMENTS + 1),
                    (uint16_t)(corner - m->corners + SEGMENTS + 2), (uint16_t)(corner - m->corners + 1)};
                for (int i = 0; i < 6; i++) {
                    *index++ = quad[flat[i]];
                }
            }
        }
    }
    for (int i = 0; i < 4; i++) {
        *corner++ = (struct corner){{i == 1 || i == 2 ? 1 : -1, 0, i < 2 ? 1 : -1}, {0, 1, 0}};
    }
    for (int i = 0; i < 8; i++) {
        *corner++ = (struct corner){{i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1}, {0}};
    }
    memcpy(index, flat, sizeof flat);
    memcpy(index + 6, cube, sizeof cube);
}

// The floor and balls that stand on it; lights between them, and one by itself at (6, 1, 0).
static inline void make_scene(struct thing things[1 + BALLS], struct light lights[LIGHTS])
{
    uint32_t state = 7;
    things[0] = (struct thing){{0, 0, 0}, 9, {0.5f, 0.5f, 0.5f}};
    for (int i = 0; i < BALLS; i++) {
        const float x = 1.6f * (float)(i % ROW - ROW / 2), z = 1.6f * (float)(i / ROW - ROW / 2);
        things[1 + i] = (struct thing){{x, 0.5f, z}, 0.5f, {0}};
        for (int c = 0; c < 3; c++) {
            things[1 + i].albedo[c] = 0.3f + 0.7f * any(&state);
        }
    }
    for (int i = 0; i < LIGHTS - 1; i++) {
        lights[i].center[0] = 0.9f * ((float)(i % LAMPS) - 4.5f) + 0.3f * any(&state);
        lights[i].center[1] = 0.2f + any(&state);
        lights[i].center[2] = 0.9f * ((float)(i / LAMPS) - 4.5f) + 0.3f * any(&state);
        lights[i].radius = 1 + 0.5f * any(&state);
        for (int c = 0; c < 3; c++) {
            lights[i].color[c] = c == i % 3 ? 1.2f : any(&state);
        }
    }
    lights[LIGHTS - 1] = (struct light){{6, 1, 0}, 2, {1, 0.5f, 0.25f}};
}

static inline void make_view(struct view *view)
{
    static const float up[3] = {0, 1, 0}, middle[3] = {0.7f, 0, 0.5f}, eye[3] = {2, 6, 9};
    const float angle = 0.8f, tangent = rhw_tan1(angle / 2);
    float look[16], projection[16];
    *view = (struct view){.near = 1, .far = 40, .size = {WIDTH, HEIGHT}, .ambient = 0.0625f};
    matrix_look_at(eye, middle, up, look);
    matrix_perspective(angle, (float)WIDTH / HEIGHT, view->near, view->far, projection);
    matrix_mul(projection, look, view->camera);
    for (int i = 0; i < 3; i++) { // rows of `look` are the axes of the camera
        view->eye[i] = eye[i];
        view->right[i] = 2 * tangent / HEIGHT * look[4 * i];
        view->down[i] = -2 * tangent / HEIGHT * look[4 * i + 1];
        view->corner[i] = -look[4 * i + 2] - view->right[i] * WIDTH / 2 - view->down[i] * HEIGHT / 2;
    }
}

#endif
