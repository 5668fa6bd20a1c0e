// SPDX-License-Identifier: MIT
// Depth bias is added to the depth of a triangle: slope · m + constant · r (struct rhw_depth_bias; Vulkan 1.3
// §26.11.4). It moves the triangle's plane of depth, so that no path has to know of it.
#ifndef RHW_DEPTH_BIAS_H
#define RHW_DEPTH_BIAS_H

#include "kernels/raster/plane_clipped.h"
#include "kernels/tile_work.h"
#include "kernels/triangle_work.h"
#include "triangle_setup8.h"

// Return the step of a depth of 0..1: the format's step, or the step of floats of this size.
static double depth_step(const struct rhw_depth_stencil_state *state, float depth)
{
    if (state->depth_steps != 0) {
        return 1 / (state->depth_steps + 1);
    }
    uint32_t bits;
    memcpy(&bits, &depth, sizeof bits);
    const uint64_t exponent = (bits >> 23 & 0xff) + (1023 - 127) - 23;
    const uint64_t step = exponent << 52;
    double result;
    memcpy(&result, &step, sizeof result);
    return result;
}

// Return the bias of a triangle whose depth has the plane `z` and is `largest` at most, within 0..1.
static double depth_bias(const struct rhw_depth_stencil_state *state, struct plane z, float largest)
{
    const struct rhw_depth_bias *const bias = &state->bias;
    const double by_x = z.dx < 0 ? -z.dx : z.dx, by_y = z.dy < 0 ? -z.dy : z.dy;
    const double slope = by_x > by_y ? by_x : by_y, limit = (double)bias->clamp;
    const double sum = (double)bias->slope * slope + (double)bias->constant * depth_step(state, largest);
    if (limit > 0) {
        return sum < limit ? sum : limit;
    }
    return limit < 0 && !(sum > limit) ? limit : sum;
}

static float within_unit(float depth)
{
    return depth > 0 ? depth < 1 ? depth : 1 : 0;
}

// Return the largest depth of the part of a triangle that lies between the planes in front and behind: the depth of a
// vertex, or of a plane that the triangle crosses. If nothing is cut off there, W may be 0 and depth anything.
static float largest_depth(const struct rhw_draw_state *state, const struct rhw_vertex_record *const v[3])
{
    const bool symmetric = state->pipeline->def.depth_range == RHW_DEPTH_MINUS_ONE_TO_ONE;
    const float near = (float)(state->depth_low - (symmetric ? state->depth_span : 0));
    const float far = (float)(state->depth_low + state->depth_span);
    float most = 0;
    for (int i = 0; i < 3; i++) {
        const bool is_near = v[i]->flags & RHW_VERTEX_NEAR, is_far = v[i]->flags & RHW_VERTEX_FAR;
        const float inside = v[i]->position[3] > 0 ? v[i]->depth : state->depth_most;
        const float depth = is_far && (!is_near || far > near) ? far : is_near ? near : inside;
        most = depth > most ? depth : most;
    }
    return within_unit(most);
}

// Bias the planes of triangle i, whose vertices are snapped, in its setup.
static inline void bias_snapped(struct triangle_setup8 *setup, int i, const struct rhw_draw_state *state)
{
    struct quantity_planes *const planes = &setup->quantities[i];
    const struct rhw_vertex_record *const *const v = setup->read->vertex[i];
    float least = v[0]->depth, most = v[0]->depth;
    for (int k = 1; k < 3; k++) {
        least = v[k]->depth < least ? v[k]->depth : least;
        most = v[k]->depth > most ? v[k]->depth : most;
    }
    const double bias =
        depth_bias(&state->depth_stencil, plane_of(planes, QUANTITY_Z), largest_depth(state, v));
    setup->depth_bias[i] = bias;
    planes->at[QUANTITY_Z] += bias;
    const double margin = 0x1p-20; // bound of the roundings
    const bool clamps = (double)least + bias < (double)state->depth_least + margin ||
                        (double)most + bias > (double)state->depth_most - margin;
    setup->clamps |= (unsigned)clamps << i;
}

// Bias the triangles of a batch whose draw asks for it. The planes of the others, and of triangles whose vertices are
// not snapped, stay as they are.
static __attribute__((noinline)) void bias_triangles8(struct triangle_setup8 *setup,
                                                      const struct rhw_chunk *chunk)
{
    for (int i = 0; i < setup->read->count; i++) {
        const struct rhw_triangle *const t = setup->read->triangle[i];
        const struct rhw_draw_state *const state = chunk->segments[t->segment].draw->state;
        setup->depth_bias[i] = 0;
        if (state->depth_stencil.is_biased && !(t->flags & RHW_TRIANGLE_UNSNAPPED)) {
            bias_snapped(setup, i, state);
        }
    }
    setup->small &= ~setup->clamps;
}

// Bias a batch if any of its draws may ask for it.
RHW_INLINE void bias_setup8(struct triangle_setup8 *setup, const struct rhw_chunk *chunk)
{
    const struct rhw_segment *const first = &chunk->segments[setup->read->triangle[0]->segment];
    if (!setup->is_one_segment || first->draw->state->depth_stencil.is_biased) {
        bias_triangles8(setup, chunk);
    }
}

// Bias planes that planes_homogeneous has made.
static __attribute__((noinline)) void bias_homogeneous(const struct tile_work *work,
                                                       struct triangle_work *triangle)
{
    struct planes *const planes = &triangle->planes;
    triangle->depth_bias = depth_bias(&work->state->depth_stencil, plane_of(&planes->quantities, QUANTITY_Z),
                                      largest_depth(work->state, triangle->v));
    planes->quantities.at[QUANTITY_Z] += triangle->depth_bias;
}

// Bias what clipping adds to the planes.
static __attribute__((noinline)) void bias_clipped(struct triangle_work *triangle)
{
    struct clipped_planes *const clipped = triangle->clipped;
    for (int i = 0; i < 3; i++) {
        clipped->zw[i] += triangle->depth_bias * clipped->w[i];
    }
}

#endif
