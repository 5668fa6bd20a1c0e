// SPDX-License-Identifier: MIT
// Kernel checks of src/kernels/geometry; compiled with RHW_ISA_SUFFIX = baseline, avx2, ...
#include "kernels/geometry/cull.h"
#include "kernels/geometry/triangle_setup.h"
#include "kernels/geometry/vertex_fetch.h"
#include "kernels/geometry/vertex_shading.h"

#include "kernel_folders.h"

enum { GUARD_24_8 = RHW_GUARD_BAND * RHW_SUBPIXEL };

// Vertex fetch ---------------------------------------------------------------------------------------

enum { STREAM_BYTES = 1024, READ_BEHIND = 16 }; // what lies behind a buffer may be read too: buffer.h

// An attribute of 8 vertices, in a buffer.
struct fetch_input {
    unsigned char bytes[STREAM_BYTES + READ_BEHIND];
    uint32_t size, format, offset, stride, element[8];
};

static void make_fetch(struct kernel_random *random, void *input)
{
    struct fetch_input *const in = input;
    for (int i = 0; i < STREAM_BYTES; i += 8) {
        const uint64_t bits = random_bits(random);
        memcpy(&in->bytes[i], &bits, sizeof bits);
    }
    for (int i = 0; i < STREAM_BYTES; i += 64) { // floats that are special among the bits that are not
        const float value = random_float(random);
        memcpy(&in->bytes[i], &value, sizeof value);
    }
    in->size = (uint32_t)random_int(random, 0, STREAM_BYTES);
    in->format = (uint32_t)random_int(random, 0, RHW_VERTEX_FORMAT_COUNT - 1);
    in->offset = (uint32_t)random_int(random, 0, 8) * 4;
    in->stride = (uint32_t)random_int(random, 0, 16) * 4;
    for (int lane = 0; lane < 8; lane++) { // seldom beyond the buffer
        in->element[lane] =
            (uint32_t)random_int(random, 0, random_one_in(random, 64) ? UINT32_MAX : STREAM_BYTES / 64);
    }
}

// As the front end fetches, and by the general path.
static void run_fetch(const void *input, void *result)
{
    const struct fetch_input *const in = input;
    const struct rhw_vertex_stream stream = {in->bytes, in->size, RHW_FETCH_BYTES};
    const struct rhw_fetch fetch = rhw_fetch_of((enum rhw_vertex_format)in->format, in->offset);
    f32x8 out[2][4];
    fetch_checked(&stream, &fetch, in->stride, in->element, out[0]);
    if (lies_inside(&stream, &fetch, in->stride, in->element)) {
        fetch_inside(&stream, &fetch, in->stride, in->element, out[1]);
    } else {
        memcpy(out[1], out[0], sizeof out[0]);
    }
    memcpy(result, out, sizeof out);
}

// Projection -----------------------------------------------------------------------------------------

struct project_input {
    float positions[4][8]; // by component
    double half_width, half_height, center_x, center_y, depth_low, depth_span;
    int32_t symmetric;
};

static void make_project(struct kernel_random *random, void *input)
{
    struct project_input *const in = input;
    for (int lane = 0; lane < 8; lane++) {
        float position[4];
        random_clip_position(random, position);
        for (int i = 0; i < 4; i++) {
            in->positions[i][lane] = position[i];
        }
    }
    in->half_width = (double)random_float_in(random, 0.5f, 8192.0f);
    in->half_height = (double)random_float_in(random, 0.5f, 8192.0f);
    in->center_x = (double)random_float_in(random, -8192.0f, 16384.0f);
    in->center_y = (double)random_float_in(random, -8192.0f, 16384.0f);
    in->depth_low = (double)random_float_in(random, 0.0f, 1.0f);
    in->depth_span = (double)random_float_in(random, -1.0f, 1.0f);
    in->symmetric = random_one_in(random, 2);
}

// Header of the records. A NaN among the numbers of a vertex, its depth and position, is any.
static void run_project(const void *input, void *result)
{
    const struct project_input *const in = input;
    struct rhw_pipeline_data pipeline;
    struct rhw_draw_state state;
    f32x8 position[4], header[8];
    pipeline.def.depth_clip_disabled = false;
    pipeline.def.depth_range = in->symmetric ? RHW_DEPTH_MINUS_ONE_TO_ONE : RHW_DEPTH_ZERO_TO_ONE;
    state.pipeline = &pipeline;
    state.half_width = in->half_width;
    state.half_height = in->half_height;
    state.center_x = in->center_x;
    state.center_y = in->center_y;
    state.depth_low = in->depth_low;
    state.depth_span = in->depth_span;
    memcpy(position, in->positions, sizeof position);
    project(&state, position, header);
    unify_nans(&header[2], 8);
    unify_nans(&header[4], 4 * 8);
    memcpy(result, header, sizeof header);
}

// Culling --------------------------------------------------------------------------------------------

enum { VERTICES = 24 };

// 8 triangles of a run, and one more that may be read.
struct cull_input {
    struct rhw_snapped_vertex vertices[VERTICES];
    uint32_t indices[9][3];
    struct rhw_rect scissor;
    uint32_t live;
    int32_t front, cull, samples; // 0: the general path
};

// Triangles of a pixel or of any size; some share vertices, and some have flags.
static void make_cull(struct kernel_random *random, void *input)
{
    struct cull_input *const in = input;
    const int32_t x = (int32_t)random_int(random, 0, GUARD_24_8 / 2),
                  y = (int32_t)random_int(random, 0, GUARD_24_8 / 2);
    for (int i = 0; i < VERTICES; i += 3) {
        int32_t xs[3], ys[3];
        random_triangle(random, x, y, xs, ys);
        for (int k = 0; k < 3; k++) {
            struct rhw_snapped_vertex *const vertex = &in->vertices[i + k];
            vertex->x_24_8 = xs[k];
            vertex->y_24_8 = ys[k];
            vertex->depth =
                random_one_in(random, 4) ? random_finite(random) : random_float_in(random, 0.0f, 1.0f);
            vertex->flags = random_one_in(random, 16) ? (uint32_t)random_int(random, 0, 255) : 0;
        }
    }
    for (int i = 0; i < 9; i++) {
        for (int k = 0; k < 3; k++) {
            in->indices[i][k] = (uint32_t)(random_one_in(random, 8) ? random_int(random, 0, VERTICES - 1)
                                                                    : (3 * i + k) % VERTICES);
        }
    }
    in->scissor.x = (int)random_int(random, 0, x / RHW_SUBPIXEL);
    in->scissor.y = (int)random_int(random, 0, y / RHW_SUBPIXEL);
    in->scissor.width = (int)random_int(random, 1, RHW_GUARD_BAND / 2 - in->scissor.x);
    in->scissor.height = (int)random_int(random, 1, RHW_GUARD_BAND / 2 - in->scissor.y);
    in->live = random_one_in(random, 2) ? 0xff : (uint32_t)random_int(random, 1, 0xff);
    in->front = (int32_t)random_int(random, 0, 1);
    in->cull = (int32_t)random_int(random, RHW_CULL_NONE, RHW_CULL_BACK);
    in->samples = random_one_in(random, 2) ? 0 : 1 << random_int(random, 0, 2);
}

struct cull_result {
    uint32_t drawn, clipped, culled, zero[5]; // up to a whole vector
    i32x8 flags;
    struct triangle_words words;
};

// What setup8 writes of triangles that are not clipped; lanes that are not drawn may be anything.
static void run_cull(const void *input, void *result)
{
    const struct cull_input *const in = input;
    struct rhw_pipeline_data pipeline;
    struct rhw_draw_state state;
    pipeline.def.front = (enum rhw_winding)in->front;
    pipeline.def.cull = (enum rhw_cull)in->cull;
    pipeline.is_conservative = false;
    state.pipeline = &pipeline;
    state.scissor = in->scissor;
    state.first_step = 127;
    state.past_step = 128;
    state.depth_least = 0.0f;
    state.depth_most = 1.0f;
    const struct triangle8 t = load_triangle8(in->vertices, 0, in->indices);
    const struct cull8 cull =
        cull8(&t, &state, in->live, in->samples == 0 ? NULL : rhw_sample_pattern_of(in->samples));
    struct cull_result *const out = result;
    memset(out, 0, sizeof *out);
    out->drawn = cull.drawn;
    out->clipped = cull.clipped;
    out->culled = cull.culled;
    if (cull.drawn == 0) {
        return;
    }
    const struct run_slice slice = {.indices = in->indices, .live = in->live};
    struct triangle_words words;
    out->flags = triangle_flags8(&t, &cull, &state) & i32x8_from_bits(cull.drawn);
    const struct triangle_names8 names = names_of_slice(&slice, 0);
    fill_words(&words, &t, &cull.pixels, out->flags, &names);
    for (unsigned left = cull.drawn; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        out->words.low[lane] = words.low[lane];
        out->words.high[lane] = words.high[lane];
    }
}

static const struct kernel_check checks[] = {
    {"fetch", sizeof(struct fetch_input), 8 * sizeof(f32x8), KERNEL_FLOATS, make_fetch, run_fetch},
    {"project", sizeof(struct project_input), 8 * sizeof(f32x8), KERNEL_BITS, make_project, run_project},
    {"cull8", sizeof(struct cull_input), sizeof(struct cull_result), KERNEL_BITS, make_cull, run_cull},
};

const struct kernel_folder RHW_ISA_NAME(check_geometry) = {"geometry", checks,
                                                           sizeof checks / sizeof *checks};
