// SPDX-License-Identifier: MIT
// Numbers instead of pixels: transform feedback, storage buffers and images.
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
    rhw_storage_atomic1(f->bindings, 0, RHW_STORAGE_ADD, cell, value);
    rhw_storage_atomic1(f->bindings, 0, RHW_STORAGE_MAX_UNSIGNED, cell + 1, value);
    rhw_storage_atomic1(f->bindings, 0, RHW_STORAGE_OR, cell + 2, value);
    rhw_storage_atomic1(f->bindings, 0, RHW_STORAGE_XOR, cell + 3, (int32_t)f->coord[0] * 31 + value);
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

// The same in an image of 32 × 32 texels, of 8×8 pixels each; the operation goes by the quarter of the target.
static void count_in_image(struct rhw_fragment1 *f)
{
    static const enum rhw_storage_operation operations[] = {RHW_STORAGE_ADD, RHW_STORAGE_MAX_UNSIGNED,
                                                            RHW_STORAGE_OR, RHW_STORAGE_XOR};
    const int32_t at[2] = {(int32_t)f->coord[0] / 8, (int32_t)f->coord[1] / 8};
    const int32_t value = (int32_t)(f->varying[4] * 256) + (int32_t)f->coord[0] * 31;
    rhw_image_atomic1(f->bindings, 0, operations[at[1] / 16 * 2 + at[0] / 16], at, value, 0);
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
}

#define IMAGE "layout(r32ui, binding = 0) uniform highp uimage2D image; out vec4 color;\n"

static const struct shader_pair counting_in_image = {
    .fragment = IMAGE "void main() { ivec2 at = ivec2(gl_FragCoord.xy) / 8;\n"
                      "uint value = uint(flat_values.x * 256.0) + uint(int(gl_FragCoord.x) * 31);\n"
                      "if (at.y < 16) { if (at.x < 16) imageAtomicAdd(image, at, value);\n"
                      "else imageAtomicMax(image, at, value); }\n"
                      "else { if (at.x < 16) imageAtomicOr(image, at, value);\n"
                      "else imageAtomicXor(image, at, value); } color = flat_values; }",
    .fragment1 = count_in_image,
    .uses = RHW_USE_COORD | RHW_USE_EFFECTS};

static void image_atomics(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->extra = FRAME_IMAGE;
    f->number_count = FRAME_NUMBERS;
    frame_add_triangles(f, 100, 100);
    frame_add_draw(f, frame_draw_default(f, &counting_in_image));
}

static void store_in_image(struct rhw_fragment1 *f)
{
    const int32_t at[2] = {(int32_t)f->coord[0], (int32_t)f->coord[1]};
    const int32_t word = at[0] * 7 + at[1] * 3;
    float texel[4] = {0};
    memcpy(texel, &word, sizeof word);
    rhw_image_store1(f->bindings, 0, at, texel);
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
}

static const struct shader_pair storing = {
    .fragment = IMAGE "void main() { ivec2 at = ivec2(gl_FragCoord.xy); color = flat_values;\n"
                      "imageStore(image, at, uvec4(at.x * 7 + at.y * 3, 0, 0, 0)); }",
    .fragment1 = store_in_image,
    .uses = RHW_USE_COORD | RHW_USE_EFFECTS};

static void load_from_image(struct rhw_fragment1 *f)
{
    const int32_t at[2] = {(int32_t)f->coord[0], (int32_t)f->coord[1]};
    float texel[4];
    int32_t word;
    rhw_image_load1(f->bindings, 0, at, texel);
    memcpy(&word, texel, sizeof word);
    f->color[0][0] = (float)(word & 255) / 255;
    f->color[0][1] = f->color[0][2] = 0;
    f->color[0][3] = 1;
}

static const struct shader_pair loading = {
    .fragment = IMAGE "void main() { uint word = imageLoad(image, ivec2(gl_FragCoord.xy)).x;\n"
                      "color = vec4(float(word & 255u) / 255.0, 0, 0, 1); }",
    .fragment1 = load_from_image,
    .uses = RHW_USE_COORD | RHW_USE_EFFECTS};

// A texel for each pixel: what the first draw stores the second shows, and beyond the image there is nothing.
static void image_stores(struct frame *f)
{
    static const float low[4] = {0.25f, 0.5f, 0, 1}, high[4] = {0.25f, 0.5f, 1, 1};
    frame_begin(f, 48, 48);
    f->extra = FRAME_IMAGE;
    f->number_count = FRAME_NUMBERS;
    frame_add_quad(f, 3, 5, 42, 39, 0, low, high);
    frame_add_draw(f, frame_draw_default(f, &storing));
    frame_add_quad(f, 0, 0, 48, 24, 0, low, high);
    frame_add_draw(f, frame_draw_default(f, &loading));
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
        {"storage image, atomics", image_atomics, NULL, 0, 0},
        {"storage image, stores and loads", image_stores, NULL, 0, 0},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
