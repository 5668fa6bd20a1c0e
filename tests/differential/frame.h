// SPDX-License-Identifier: MIT
// A picture to be drawn twice: targets, textures, vertices and draws, in the words of the library's own definitions, which
// renderer_here.c hands over and renderer_peer.c translates. Rows stand in memory from the top in both: the peer's
// vertex shader turns y, so that pixels, scissors, texels and sample positions have the same coordinates.
#ifndef DIFFERENTIAL_FRAME_H
#define DIFFERENTIAL_FRAME_H

#include <rhw/rhw.h>
#include <rhw/shader.h>

enum {
    FRAME_SIDE = 256, // pixels of the largest target, each way
    FRAME_TARGETS = 4,
    FRAME_DRAWS = 300,
    FRAME_VERTICES = 8192,
    FRAME_INDICES = 1024,
    FRAME_INSTANCES = 16,
    FRAME_IMAGE_SIDE = 32,
    FRAME_NUMBERS = FRAME_IMAGE_SIDE * FRAME_IMAGE_SIDE, // what queries, feedback and storage give
    FRAME_UNIFORMS = 4,
    FRAME_TEXTURES = 2,
    FRAME_SNAP = 256 // positions are whole parts of a pixel, as both renderers round them
};

struct frame_vertex {
    float position[4]; // clip coordinates, y up
    float value[4];    // arrives as a smooth and as a flat varying; [3] is also the size of a point
};

// The same fragment function in both languages. It receives value smooth in varying 0..3, flat in 4..7, and the
// instance's attribute flat in 8..11; `values`, `flat_values`, `instance_values` in GLSL, and vec4 uniforms[4].
struct shader_pair {
    const char *fragment; // GLSL: declarations and main
    rhw_fragment1_function *fragment1;
    const char *vertex;            // GLSL statements at the end of the vertex shader's main; may be NULL
    rhw_vertex1_function *vertex1; // NULL: that of every pair
    uint32_t uses;
    enum rhw_sampling sampling;
    bool writes_point_size, derivatives, vertex_effects, early_tests;
};

struct frame_texture {
    struct rhw_texture_def def;
    struct rhw_sampler_def sampler;
    bool plain; // each level is of one colour, by which it is seen; false: random texels
};

struct frame_draw {
    const struct shader_pair *shaders;
    struct rhw_pipeline_def state; // but for its program, attributes and buffers
    int instance_step;
    struct rhw_viewport viewport; // of width 0: the whole target
    struct rhw_rect scissor;      // of width 0: the same
    uint8_t reference_front, reference_back;
    float blend_constant[4];
    float uniforms[FRAME_UNIFORMS][4];
    int first, count, instances;
    bool indexed;
};

// What is done besides drawing.
enum frame_extra {
    FRAME_NOTHING,
    FRAME_OCCLUSION, // numbers[i]: whether draw i had samples that passed
    FRAME_FEEDBACK,  // numbers: positions and values of the first draw, captured
    FRAME_STORAGE,   // numbers: a storage buffer of words in slot 0
    FRAME_IMAGE,     // numbers: texels of a storage image in slot 0, R32_UINT, FRAME_IMAGE_SIDE each way
    FRAME_BLIT       // a region of the first target is blitted into the second
};

struct frame {
    int width, height, samples;
    int target_count;
    unsigned left_out; // a bit for each target that is cleared before, and no attachment while the draws run
    enum rhw_format formats[FRAME_TARGETS];
    float clear[FRAME_TARGETS][4];
    int32_t clear_integer[FRAME_TARGETS][4];
    enum rhw_format depth_format; // NONE: no depth or stencil
    float depth_clear;
    uint8_t stencil_clear;
    struct frame_texture textures[FRAME_TEXTURES];
    int texture_count;
    struct frame_vertex vertices[FRAME_VERTICES];
    int vertex_count;
    uint16_t indices[FRAME_INDICES];
    int index_count;
    float instances[FRAME_INSTANCES][4]; // x, y move a vertex; [0] is zero
    struct frame_draw draws[FRAME_DRAWS];
    int draw_count;
    enum frame_extra extra;
    int blit_from[4], blit_to[4]; // corners x0, y0, x1, y1
    enum rhw_filter blit_filter;
    int number_count;
    uint32_t random;
};

// What a renderer made of a frame: texels decoded to codes (UNORM, integers) or values (floats).
struct drawn {
    double targets[FRAME_TARGETS][FRAME_SIDE * FRAME_SIDE][4];
    double numbers[FRAME_NUMBERS];
};

// One RGBA8 target, no depth, black.
void frame_begin(struct frame *frame, int width, int height);
// 0..limit − 1, and 0..1 in steps of 1/256.
int frame_random(struct frame *frame, int limit);
float frame_random_part(struct frame *frame);
// The state of a draw that fills triangles, with every target replaced.
struct frame_draw frame_draw_default(const struct frame *frame, const struct shader_pair *shaders);
// A vertex at a place in pixels from the top left, rounded to 1/256; w is 1.
struct frame_vertex frame_vertex_at(const struct frame *frame, double x, double y, double z,
                                    const float value[4]);
void frame_add_vertex(struct frame *frame, struct frame_vertex vertex);
// Two triangles over a rectangle of pixels. Values go from `low` at the left top to `high` at the right bottom, x in the
// first and third, y in the second; the fourth from left to right as well.
void frame_add_quad(struct frame *frame, double x, double y, double width, double height, double z,
                    const float low[4], const float high[4]);
// `count` triangles on the target, of at most `reach` pixels each way, on odd 1/256 of a pixel: no centre of a pixel lies on
// an upright or level edge.
void frame_add_triangles(struct frame *frame, int count, int reach);
// The same, which may leave the target.
void frame_add_wide_triangles(struct frame *frame, int count, int reach);
// Draws the vertices that were added since the last such call.
struct frame_draw *frame_add_draw(struct frame *frame, struct frame_draw draw);
// The texels of a level and layer of a texture, at most FRAME_SIDE²·16 bytes.
void frame_texels(const struct frame_texture *texture, int level, int layer, unsigned char *texels);

#endif
