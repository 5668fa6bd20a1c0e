// SPDX-License-Identifier: MIT
// Numbers instead of pixels: transform feedback and storage buffers.
#include <string.h>

#include "scenes.h"

enum { FLOATS = 8 }; // of a vertex that is captured

static void add_feedback(struct frame *f, enum rhw_topology topology, int vertices, int triangles)
{
    frame_begin(f, 256, 256);
    f->extra = FRAME_FEEDBACK;
    f->number_count = 3 * FLOATS * triangles;
    for (int i = 0; i < vertices; i++) {
        const float value[4] = {frame_random_part(f), frame_random_part(f), frame_random_part(f), (float)i};
        frame_add_vertex(f, frame_vertex_at(f, 12 + frame_random(f, 232) + 1.0 / 256,
                                            12 + frame_random(f, 232) + 3.0 / 256, 0, value));
    }
    struct frame_draw draw = frame_draw_default(f, &flat_color);
    draw.state.topology = topology;
    frame_add_draw(f, draw);
}

static void feedback_list(struct frame *f)
{
    add_feedback(f, RHW_TRIANGLE_LIST, 41, 13);
}

static void feedback_strip(struct frame *f)
{
    add_feedback(f, RHW_TRIANGLE_STRIP, 30, 28);
}

static void feedback_fan(struct frame *f)
{
    add_feedback(f, RHW_TRIANGLE_FAN, 30, 28);
}

// Four words for every 16×16 pixels.
static void count(struct rhw_fragment1 *f)
{
    const uint32_t cell =
        4 * ((uint32_t)((int32_t)f->coord[1] / 16) * 16 + (uint32_t)((int32_t)f->coord[0] / 16));
    const int32_t value = (int32_t)(f->varying[4] * 256);
    rhw_storage_atomic1(f->textures, 0, RHW_STORAGE_ADD, cell, value);
    rhw_storage_atomic1(f->textures, 0, RHW_STORAGE_MAX_UNSIGNED, cell + 1, value);
    rhw_storage_atomic1(f->textures, 0, RHW_STORAGE_OR, cell + 2, value);
    rhw_storage_atomic1(f->textures, 0, RHW_STORAGE_XOR, cell + 3, (int32_t)f->coord[0] * 31 + value);
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
}

#define COUNT                                                                                    \
    "layout(std430, binding = 0) buffer Numbers { uint words[]; }; out vec4 color;\n"            \
    "void main() { int cell = 4 * (int(gl_FragCoord.y) / 16 * 16 + int(gl_FragCoord.x) / 16);\n" \
    "uint value = uint(flat_values.x * 256.0);\n"                                                \
    "atomicAdd(words[cell], value); atomicMax(words[cell + 1], value);\n"                        \
    "atomicOr(words[cell + 2], value);\n"                                                        \
    "atomicXor(words[cell + 3], uint(int(gl_FragCoord.x) * 31) + value); color = flat_values; }"

static const struct shader_pair counting = {
    .fragment = COUNT, .fragment1 = count, .uses = RHW_USE_COORD | RHW_USE_EFFECTS};
static const struct shader_pair early_counting = {
    .fragment = COUNT, .fragment1 = count, .uses = RHW_USE_COORD | RHW_USE_EFFECTS, .early_tests = true};

static void atomics(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->extra = FRAME_STORAGE;
    f->number_count = FRAME_NUMBERS;
    frame_add_triangles(f, 100, 100);
    frame_add_draw(f, frame_draw_default(f, &counting));
}

// What fails the depth test is counted, or not, as the tests come after the function, or before it.
static void add_tested(struct frame *f, const struct shader_pair *shaders)
{
    frame_begin(f, 256, 256);
    f->extra = FRAME_STORAGE;
    f->number_count = FRAME_NUMBERS;
    f->depth_format = RHW_FORMAT_D32_FLOAT;
    frame_add_triangles(f, 100, 100);
    struct frame_draw draw = frame_draw_default(f, shaders);
    draw.state.depth_test = true;
    frame_add_draw(f, draw);
}

static void atomics_late(struct frame *f)
{
    add_tested(f, &counting);
}

static void atomics_early(struct frame *f)
{
    add_tested(f, &early_counting);
}

struct scene_list storage_scenes(void)
{
    static const struct scene scenes[] = {
        {"transform feedback of a list", feedback_list, NULL, 0, 0},
        {"transform feedback of a strip", feedback_strip, NULL, 0, 0},
        {"transform feedback of a fan", feedback_fan, NULL, 0, 0},
        {"atomics", atomics, NULL, 0, 0},
        {"atomics, tests after them", atomics_late, NULL, 0, 0},
        {"atomics, early tests", atomics_early, NULL, 0, 0},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
