// SPDX-License-Identifier: MIT
// Collected fragments (collect.h) become groups: 8 of one triangle, wherever in the tile they lie. Every number is made
// by the operations that make it for rows.
#ifndef RHW_SCATTERED_GROUPS_H
#define RHW_SCATTERED_GROUPS_H

#include "kernels/integer.h"
#include "collect.h"
#include "pack.h"
#include "row_groups.h"

RHW_INLINE struct anchor_offset texel_offsets(const struct tile_work *work, const struct planes *planes,
                                              const int32_t texel[8])
{
    const i32x8 at = i32x8_load(texel);
    const i32x8 x = at & i32x8_splat(RHW_TILE - 1), y = at >> RHW_TILE_LOG2;
    return (struct anchor_offset){f64x8_from_i32x8(x - i32x8_splat(planes->anchor_x - work->x)),
                                  f64x8_from_i32x8(y - i32x8_splat(planes->anchor_y - work->y))};
}

// Return the depth at 8 pixel centres. A pixel's centre may lie beyond its triangle although a sample does not; the
// plane of depth is followed there, as rows follow it.
RHW_INLINE f32x8 scattered_depth(const struct tile_work *work, const struct triangle_work *triangle,
                                 const struct anchor_offset *at)
{
    const f32x8 z =
        f32x8_from_f64x8(plane_value8(plane_of(&triangle->planes.quantities, QUANTITY_Z), at->dx, at->dy));
    return work->samples == 1 || triangle->clamps_depth ? viewport_clamp(&work->scratch->depth, z) : z;
}

// Fill the queue's next `count` groups with the fragments at `texel`, 8 each.
RHW_INLINE void fill_scattered(const struct tile_work *work, const struct triangle_work *triangle,
                               const int32_t *texel, int count, enum derivatives derivatives)
{
    const struct planes *const planes = &triangle->planes;
    struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const int first = queue->count;
    struct group_weights weights;
    for (int n = 0; n < count; n++) {
        const struct anchor_offset at = texel_offsets(work, planes, &texel[8 * n]);
        const struct weights w = weights_of_pixels(&planes->quantities, &at);
        weights.b[n] = w.b;
        weights.c[n] = w.c;
        if (derivatives == DERIVATIVES) {
            const f64x8 squared = f64x8_mul(w.inverse_s, w.inverse_s);
            smooth_derivatives(queue, first + n, pipeline, triangle->derivatives, &at, squared);
        }
        if (work->plan.keeps_depth) {
            queue->groups[first + n].depth = scattered_depth(work, triangle, &at);
        }
    }
    f32x8 *const varyings = queue->varyings + first * pipeline->varying_components;
    for (int run = 0; run < pipeline->smooth_runs; run++) {
        interpolate_groups(varyings, pipeline->varying_components, pipeline->smooth_run[run], triangle,
                           &weights, count);
    }
    set_flat_groups(varyings, pipeline, triangle, count);
}

// Set what the queue's next `count` groups have beside smooth and flat varyings. Where no component wants weights in
// space, set depth and flat varyings too, which fill_scattered sets else.
static __attribute__((noinline)) void fill_more_scattered(const struct tile_work *work,
                                                          const struct triangle_work *triangle,
                                                          const int32_t *texel, int count)
{
    const struct planes *const planes = &triangle->planes;
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    struct fragment_queue *const queue = &work->scratch->queue;
    const float center = (float)sample_offset();
    const bool alone = !wants_weights(pipeline);
    struct group_weights screen;
    for (int n = 0; n < count; n++) {
        const struct anchor_offset at = texel_offsets(work, planes, &texel[8 * n]);
        if (pipeline->any_noperspective) {
            screen.b[n] = f32x8_from_f64x8(plane_value8(planes->n1, at.dx, at.dy));
            screen.c[n] = f32x8_from_f64x8(plane_value8(planes->n2, at.dx, at.dy));
        }
        if (alone && work->plan.keeps_depth) {
            queue->groups[queue->count + n].depth = scattered_depth(work, triangle, &at);
        }
        if (pipeline->def.program.uses & RHW_USE_COORD) {
            fill_coordinates(work, &queue->groups[queue->count + n], i32x8_load(&texel[8 * n]),
                             (const float[]){center, center},
                             plane_value8(plane_of(&planes->quantities, QUANTITY_S), at.dx, at.dy));
        }
    }
    f32x8 *const varyings = queue->varyings + queue->count * pipeline->varying_components;
    for (int run = 0; run < pipeline->screen_runs; run++) {
        interpolate_groups(varyings, pipeline->varying_components, pipeline->screen_run[run], triangle,
                           &screen, count);
    }
    if (alone) {
        set_flat_groups(varyings, pipeline, triangle, count);
    }
    if (pipeline->any_constant_derivatives) {
        constant_derivatives(queue, queue->count, count, pipeline, triangle);
    }
}

// Fill the queue's next `count` groups with everything that a fragment function may ask for.
static __attribute__((noinline)) void fill_any_scattered(const struct tile_work *work,
                                                         const struct triangle_work *triangle,
                                                         const int32_t *texel, int count)
{
    const struct planes *const planes = &triangle->planes;
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    struct fragment_queue *const queue = &work->scratch->queue;
    struct group_weights weights, screen;
    for (int n = 0; n < count; n++) {
        const int g = queue->count + n;
        const struct anchor_offset at = texel_offsets(work, planes, &texel[8 * n]);
        const float center = (float)sample_offset();
        struct group_place place = {.texels = i32x8_load(&texel[8 * n]),
                                    .position = {center, center},
                                    .at = at,
                                    .weights = weights_of_pixels(&planes->quantities, &at)};
        weights.b[n] = place.weights.b;
        weights.c[n] = place.weights.c;
        if (work->plan.needs_screen) {
            place.screen.s = plane_value8(planes->n1, at.dx, at.dy);
            place.screen.t = plane_value8(planes->n2, at.dx, at.dy);
            screen.b[n] = f32x8_from_f64x8(place.screen.s);
            screen.c[n] = f32x8_from_f64x8(place.screen.t);
        }
        if (work->plan.keeps_depth) {
            queue->groups[g].depth = scattered_depth(work, triangle, &at);
        }
        fill_builtins(work, g, triangle, &place);
    }
    interpolate_any_groups(queue->varyings + queue->count * pipeline->varying_components, pipeline, triangle,
                           &weights, &screen, count);
}

// Keep the depths of the samples of group g, which is scattered.
static void keep_sample_depths(const struct tile_work *work, const struct planes *planes, int g)
{
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    struct fragment_queue *const queue = &work->scratch->queue;
    const struct anchor_offset at = texel_offsets(work, planes, queue->texels[g]);
    for (int s = 0; s < work->samples; s++) {
        const f64x8 z = plane_value8(plane_of(&planes->quantities, QUANTITY_Z),
                                     f64x8_add(at.dx, f64x8_splat(from_center(pattern->x_0_8[s]))),
                                     f64x8_add(at.dy, f64x8_splat(from_center(pattern->y_0_8[s]))));
        queue->sample_depth[g][s] = viewport_clamp(&work->scratch->depth, f32x8_from_f64x8(z));
    }
}

// Leave only the lanes `live` of group g live.
static __attribute__((noinline)) void mask_group(const struct tile_work *work, int g, unsigned live)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    queue->live[g] = (uint8_t)live;
    queue->groups[g].mask = i32x8_from_bits(live);
    if (work->samples > 1) {
        queue->samples[g] &= i32x8_from_bits(live);
    }
}

// Queue groups of the fragments at `texel`, 8 each. last_live has the lanes of the last group that are no repetitions.
static void queue_scattered(struct tile_work *work, struct triangle_work *triangle, const int32_t *texel,
                            int count, unsigned last_live)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    if (!triangle->has_values) {
        set_inputs(work, triangle);
    }
    while (count != 0) {
        const int first = queue->count, n = min_int(min_int(count, RHW_FRAGMENT_GROUPS - first), RHW_BLOCK);
        for (int g = first; g < first + n; g++) {
            queue->live[g] = 0xff;
            queue->is_scattered[g] = true;
            memcpy(queue->texels[g], &texel[8 * (g - first)], sizeof queue->texels[g]);
            queue->groups[g].mask = i32x8_splat(-1);
            if (work->samples > 1) {
                const ptrdiff_t at = texel - work->scratch->collected.texel + 8 * (g - first);
                queue->samples[g] = i32x8_load(&work->scratch->collected.samples[at]);
            }
            if (work->samples > 1 && work->plan.depth_mode >= RHW_DEPTH_LATE) {
                keep_sample_depths(work, &triangle->planes, g);
            }
            if (work->plan.keeps_identity) {
                fill_identity(&queue->groups[g], work->pipeline->def.program.uses, triangle);
            }
        }
        if (work->plan.shading != RHW_SHADING_SMOOTH) {
            fill_any_scattered(work, triangle, texel, n);
        } else if (work->pipeline->derivative_pairs != 0) {
            fill_scattered(work, triangle, texel, n, DERIVATIVES);
        } else if (!work->plan.fills_more || wants_weights(work->pipeline)) {
            fill_scattered(work, triangle, texel, n, NO_DERIVATIVES);
        }
        if (work->plan.fills_more) { // never with RHW_SHADING_ANY
            fill_more_scattered(work, triangle, texel, n);
        }
        queue->only_full_rows = false;
        queue->count = first + n;
        count -= n;
        texel += 8 * n;
        if (count == 0 && last_live != 0xff) {
            mask_group(work, first + n - 1, last_live);
        }
        shade_if_full(work);
    }
}

// Put the first of 8 texels into the lanes that have none. Whatever samples they have is masked.
RHW_INLINE void repeat_first(int32_t texel[RHW_LANES], unsigned live)
{
    i32x8_store(texel, rhw_select_int(i32x8_from_bits(live), i32x8_load(texel), i32x8_splat(texel[0])));
}

// Make groups of the collected fragments. The last group has no fewer than `least` of them; the others stay.
static __attribute__((noinline)) void queue_collected(struct tile_work *work, struct triangle_work *triangle,
                                                      int least)
{
    struct collected_fragments *const collected = &work->scratch->collected;
    const int groups = (collected->count + RHW_LANES - least) / RHW_LANES, end = RHW_LANES * groups;
    const int missing = max_int(end - collected->count, 0);
    if (collected->overtakes && work->scratch->partial.count != 0) {
        release_partial(work);
    }
    collected->overtakes = false;
    const unsigned live = 0xffu >> missing; // lanes of the last group
    if (missing != 0) {
        repeat_first(&collected->texel[end - RHW_LANES], live);
    }
    queue_scattered(work, triangle, collected->texel, groups, live);
    collected->first = end;
}

// Make room for the fragments of one more block.
static __attribute__((noinline)) void make_room(struct tile_work *work, struct triangle_work *triangle)
{
    struct collected_fragments *const collected = &work->scratch->collected;
    queue_collected(work, triangle, RHW_LANES);
    memcpy(collected->texel, &collected->texel[collected->first], RHW_LANES * sizeof *collected->texel);
    memcpy(collected->samples, &collected->samples[collected->first], RHW_LANES * sizeof *collected->samples);
    collected->count -= collected->first;
    collected->first = 0;
}

static __attribute__((noinline)) void release_collected(struct tile_work *work,
                                                        struct triangle_work *triangle)
{
    // Fragments that wait where some collected ones lie would have to go first, before their group is full.
    struct collected_fragments *const collected = &work->scratch->collected;
    const int least = collected->overtakes ? RHW_LANES : least_of_group(work);
    if (collected->count >= least) {
        queue_collected(work, triangle, least);
    }
    if (collected->first < collected->count) {
        if (collected->overtakes && !work->orders_lanes && samples_meet(work)) {
            release_partial(work);
        }
        pack_collected(work, triangle);
    }
    collected->first = collected->count = 0;
    collected->overtakes = false;
}

#endif
