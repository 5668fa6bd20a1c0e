// SPDX-License-Identifier: MIT
// What the unit tests draw with. A rig is one context, its attachments, and the definition of the next
// pipeline and pass; a test changes the fields it is about and draws. Everything it creates on the way
// is destroyed by rig_end and rig_close. Targets are 32-bit float unless a test is about formats, so that
// what the pipeline computed can be compared without a rounding in between.
#ifndef TEST_HARNESS_H
#define TEST_HARNESS_H

#include "unit.h"

#include <rhw/rhw.h>
#include <rhw/shader.h>

/// The vertex of the default pipeline: attribute 0 is the clip position, attribute 1 a smooth varying that
/// the default fragment function writes to target 0.
struct rig_vertex {
    float position[4];
    float value[4];
};

struct rig_objects {
    rhw_buffer *buffers;
    rhw_pipeline *pipelines;
    int buffer_count, pipeline_count;
};

struct rig {
    rhw_context *context;
    int width, height;
    struct rhw_pass_def pass;         ///< attachments; what rig_begin begins
    struct rhw_pipeline_def pipeline; ///< what the next rig_use_pipeline creates
    rhw_pass recording;
    struct rhw_stats stats; ///< of the last rig_end
    int misuses;        ///< calls of the assert hook; rig_close wants 0: a test that expects some resets it
    bool misused;       ///< since rig_begin
    char message[1024]; ///< of the last one
    struct rig_objects objects;
    void *pixels; ///< of the last rig_read
};

/// A context with 2 threads and one RGBA32_FLOAT target of that size, cleared to 0 by every pass.
void rig_open(struct rig *rig, int width, int height);
void rig_open_with(struct rig *rig, int width, int height, const struct rhw_context_def *def);
void rig_close(struct rig *rig);

/// Gives attachment `index` (up to one beyond those there are) a new texture of that format, cleared by every
/// pass, and makes the pipeline write it.
void rig_set_target(struct rig *rig, int index, enum rhw_format format);
/// Attaches a D32_FLOAT texture, cleared to 1 and stored, and enables the depth test.
void rig_set_depth(struct rig *rig);
/// Replaces the program by these 8-lane functions; varyings stay as they are.
void rig_set_program(struct rig *rig, rhw_vertex_function *vertex, rhw_fragment_function *fragment);

void rig_begin(struct rig *rig);
/// Wants rig->pass to be refused by a message with this part.
void rig_expect_refused_pass(struct rig *rig, const char *part);
void rig_use_pipeline(struct rig *rig);
void rig_use_vertices(struct rig *rig, int slot, const void *data, size_t size);
void rig_use_indices(struct rig *rig, enum rhw_index_type type, const void *data, size_t size);
/// Creates and sets the pipeline and the vertex buffer, and draws.
void rig_draw(struct rig *rig, const struct rig_vertex *vertices, int count);
/// Ends the pass, which must succeed, or be an error when there was misuse in it, and keeps the stats.
void rig_end(struct rig *rig);
/// begin, draw, end.
void rig_draw_once(struct rig *rig, const struct rig_vertex *vertices, int count);

/// The texels of a texture's level 0 in its own format, tightly packed; valid until the next read.
const void *rig_read(struct rig *rig, rhw_texture texture);
/// Return 4 floats a pixel of target 0, which must be RGBA32_FLOAT. They are valid until the next read.
const float (*rig_read_float4(struct rig *rig))[4];
/// Return the floats of the depth attachment. They are valid until the next read.
const float *rig_read_depth(struct rig *rig);
/// FNV-1a of target `index`.
uint64_t rig_hash(struct rig *rig, int index);
uint64_t rig_hash_bytes(uint64_t hash, const void *data, size_t size);

/// The clip position that lands on pixel coordinates x, y (from the top left of the target, viewport the
/// whole target) with that depth and W.
void rig_place(const struct rig *rig, float x, float y, float depth, float w, float position[4]);
/// Two triangles, four corners given by pixel coordinates, at one depth and W = 1, one value everywhere.
void rig_rectangle(const struct rig *rig, float x0, float y0, float x1, float y1, float depth,
                   const float value[4], struct rig_vertex vertices[6]);
/// Make a rectangle of two triangles that covers the whole target.
void rig_cover(const struct rig *rig, float depth, const float value[4], struct rig_vertex vertices[6]);

/// The default program: position = attribute 0, varyings 0..3 = attribute 1, colour 0 = varyings 0..3.
void rig_vertex_pass(struct rhw_vertex *groups, int count);
void rig_fragment_pass(struct rhw_fragment *groups, int count);

/// A deterministic generator (splitmix64).
uint64_t rig_random(uint64_t *state);
/// Uniform in low..high.
float rig_random_float(uint64_t *state, float low, float high);
/// Uniform in 0..count − 1.
int rig_random_int(uint64_t *state, int count);

/// Distance from |value| to the next larger float.
double rig_ulp(double value);

/// The assert hook of a rig, for tests that make contexts of their own: `user` is the rig.
void rig_misuse(void *user, const char *message);
/// Wants exactly one misuse since the last look, and a message that contains `part`.
void rig_expect_misuse(struct rig *rig, const char *part);

#endif
