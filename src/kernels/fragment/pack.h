// SPDX-License-Identifier: MIT
// The partial group has single fragments of several triangles: the few of each triangle that its own groups leave over.
// They wait until 8 make a group, which is then packed: a fragment is evaluated as one vector over quantities and one
// over components, then 8 of them are turned into lanes. Only fragments that wait here can be overtaken by later ones
// of the same pixel. Fragments that replace what is there may share a group with waiting ones, as the last lane is
// stored last. Other fragments close the group first, unless they have no sample in common with those that wait.
#ifndef RHW_PACK_H
#define RHW_PACK_H

#include "kernels/depth/depth_test.h"
#include "builtin.h"
#include "derivative.h"
#include "interpolate.h"
#include "partial_group.h"

// Turn 8 vectors over four quantities into four over the lanes.
RHW_INLINE void quantity_lanes(const f64x4 value[8], f64x8 out[4])
{
    f64x4 low[4] = {value[0], value[1], value[2], value[3]},
          high[4] = {value[4], value[5], value[6], value[7]};
    f64x4_transpose(low);
    f64x4_transpose(high);
    for (int q = 0; q < 4; q++) {
        out[q] = (f64x8){low[q], high[q]};
    }
}

static void pack_identity(struct rhw_fragment *group, uint32_t uses,
                          const struct packed_triangle *const triangle[8])
{
    for (int lane = 0; lane < 8 && uses & RHW_USE_FACING; lane++) {
        group->front_facing[lane] = triangle[lane]->front_facing;
    }
    for (int lane = 0; lane < 8 && uses & RHW_USE_IDS; lane++) {
        group->primitive[lane] = triangle[lane]->primitive;
        group->instance[lane] = triangle[lane]->instance;
        group->draw[lane] = triangle[lane]->draw;
    }
}

// Weights of the 8 fragments, lane by lane: in space, and on the screen where they are wanted.
struct packed_weights {
    const float *b, *c, *s, *t;
};

// Set components i .. i + 7 of the 8 fragments, a vector for each. A vertex record is padded to whole vectors.
RHW_INLINE void pack_smooth(const struct packed_triangle *const triangle[8], int i,
                            const struct packed_weights *w, f32x8 out[8])
{
    for (int lane = 0; lane < 8; lane++) {
        const float *const *const v = triangle[lane]->varyings;
        const f32x8 i0 = f32x8_load(v[0] + i), d1 = i0 - f32x8_load(v[1] + i), d2 = i0 - f32x8_load(v[2] + i);
        out[lane] = interpolate(i0, d1, d2, f32x8_splat(w->b[lane]), f32x8_splat(w->c[lane]));
    }
    f32x8_transpose(out);
}

// Set components i .. i + 7 of the 8 fragments, whatever their qualifiers are.
RHW_INLINE void pack_qualified(const struct packed_triangle *const triangle[8], int i,
                               const struct packed_weights *w, const struct rhw_pipeline_data *pipeline,
                               f32x8 out[8])
{
    const i32x8 flat = i32x8_load(pipeline->flat_mask + i),
                screen = i32x8_load(pipeline->noperspective_mask + i);
    for (int lane = 0; lane < 8; lane++) {
        const float *const *const v = triangle[lane]->varyings;
        const f32x8 i0 = f32x8_load(v[0] + i), d1 = i0 - f32x8_load(v[1] + i), d2 = i0 - f32x8_load(v[2] + i);
        const f32x8 b = f32x8_select(screen, f32x8_splat(w->s[lane]), f32x8_splat(w->b[lane]));
        const f32x8 c = f32x8_select(screen, f32x8_splat(w->t[lane]), f32x8_splat(w->c[lane]));
        out[lane] =
            f32x8_select(flat, f32x8_load(triangle[lane]->provoking + i), interpolate(i0, d1, d2, b, c));
    }
    f32x8_transpose(out);
}

RHW_INLINE void pack_flat(const struct packed_triangle *const triangle[8], int i, f32x8 out[8])
{
    for (int lane = 0; lane < 8; lane++) {
        out[lane] = f32x8_load(triangle[lane]->provoking + i);
    }
    f32x8_transpose(out);
}

// Set all components of group g.
static void pack_varyings(struct tile_work *work, int g, const struct packed_weights *weights)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const struct packed_triangle *const *const triangle = work->scratch->partial.triangle;
    const int components = pipeline->varying_components;
    for (int i = 0; i < components; i += 8) {
        f32x8 lanes[8];
        if (pipeline->vector_qualifier[i / 8] == RHW_VECTOR_SMOOTH) {
            pack_smooth(triangle, i, weights, lanes);
        } else if (pipeline->vector_qualifier[i / 8] == RHW_VECTOR_FLAT) {
            pack_flat(triangle, i, lanes);
        } else {
            pack_qualified(triangle, i, weights, pipeline, lanes);
        }
        f32x8 *const out = work->scratch->queue.varyings + g * components + i;
        if (i + 8 <= components) {
            memcpy(out, lanes, sizeof lanes);
        } else {
            for (int k = 0; k < components - i; k++) {
                out[k] = lanes[k];
            }
        }
    }
}

static void pack_derivatives(struct tile_work *work, int g, f64x8 inverse_s)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const struct partial_group *const partial = &work->scratch->partial;
    f32x8 *const ddx = work->scratch->queue.ddx + g * pipeline->varying_components;
    f32x8 *const ddy = work->scratch->queue.ddy + g * pipeline->varying_components;
    const f64x8 squared = f64x8_mul(inverse_s, inverse_s);
    for (int pair = 0; pair < pipeline->derivative_pairs; pair++) {
        const uint8_t *const component = pipeline->derivative_component[pair];
        f64x4 value[8];
        for (int lane = 0; lane < 8; lane++) {
            value[lane] = numerators(&partial->triangle[lane]->derivatives[pair], partial->distance[lane]);
        }
        f64x8 lanes[4];
        quantity_lanes(value, lanes);
        for (int which = 0; which < 2; which++) {
            ddx[component[which]] = derivative_of(lanes[2 * which], squared);
            ddy[component[which]] = derivative_of(lanes[2 * which + 1], squared);
        }
    }
}

// Set derivatives of components that are not smooth: they are constant over a triangle.
static void pack_constant_derivatives(struct tile_work *work, int g)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const struct packed_triangle *const *const triangle = work->scratch->partial.triangle;
    f32x8 *const ddx = work->scratch->queue.ddx + g * pipeline->varying_components;
    f32x8 *const ddy = work->scratch->queue.ddy + g * pipeline->varying_components;
    for (int i = 0; i < pipeline->varying_components; i++) {
        if (!pipeline->component_derivatives[i] || pipeline->component_qualifier[i] == RHW_SMOOTH) {
            continue;
        }
        ddx[i] = ddy[i] = f32x8_splat(0);
        for (int lane = 0; lane < 8 && pipeline->component_qualifier[i] == RHW_NOPERSPECTIVE; lane++) {
            const struct packed_triangle *const t = triangle[lane];
            const struct screen_derivative d = screen_derivative(&t->n1, &t->n2, t->varyings, i);
            ddx[i][lane] = d.by_x;
            ddy[i][lane] = d.by_y;
        }
    }
}

static void pack_barycentric_derivatives(struct tile_work *work, struct rhw_fragment *group, f64x8 squared)
{
    const struct partial_group *const partial = &work->scratch->partial;
    f64x4 value[8];
    for (int lane = 0; lane < 8; lane++) {
        value[lane] = numerators(&partial->triangle[lane]->weights, partial->distance[lane]);
    }
    f64x8 lanes[4]; // lanes of b by x and by y, c by x and by y
    quantity_lanes(value, lanes);
    fill_barycentrics(group->barycentric_ddx, 0, derivative_of(lanes[0], squared),
                      derivative_of(lanes[2], squared));
    fill_barycentrics(group->barycentric_ddy, 0, derivative_of(lanes[1], squared),
                      derivative_of(lanes[3], squared));
}

// Set varyings, and what groups have beside them and the derivatives of smooth ones.
static __attribute__((noinline)) void pack_any(struct tile_work *work, int g, const struct weights *weights,
                                               const struct packed_weights *in_space)
{
    const uint32_t uses = work->pipeline->def.program.uses;
    struct rhw_fragment *const group = &work->scratch->queue.groups[g];
    f64x8 screen[4] = {{{0}, {0}}}; // lanes of s and t
    if (work->plan.needs_screen) {
        quantity_lanes(work->scratch->partial.screen, screen);
    }
    const f32x8 s = f32x8_from_f64x8(screen[0]), t = f32x8_from_f64x8(screen[1]);
    float s_lanes[8], t_lanes[8];
    f32x8_store(s_lanes, s);
    f32x8_store(t_lanes, t);
    const struct packed_weights lanes = {in_space->b, in_space->c, s_lanes, t_lanes};
    pack_varyings(work, g, &lanes);
    if (work->pipeline->any_derivatives) {
        pack_constant_derivatives(work, g);
    }
    if (uses & RHW_USE_BARYCENTRIC_DERIVATIVES) {
        pack_barycentric_derivatives(work, group, f64x8_mul(weights->inverse_s, weights->inverse_s));
    }
    if (uses & (RHW_USE_SAMPLE | RHW_USE_SAMPLE_MASK)) { // with several samples groups are rows
        fill_one_sample(group);
    }
    if (uses & RHW_USE_COORD) {
        const float center = (float)sample_offset();
        fill_coordinates(work, group, i32x8_load(work->scratch->partial.texel),
                         (const float[]){center, center}, weights->s);
    }
    if (uses & RHW_USE_BARYCENTRIC) {
        fill_barycentrics(group->barycentric, 1, weights->b, weights->c);
        fill_barycentrics(group->barycentric_noperspective, 1, s, t);
    }
    if (uses & RHW_USE_POINT_COORD) {
        fill_point_coord(group, s, t);
    }
}

// Take a place in the queue for the partial group. `bits` are the lanes that are not repetitions.
static int place_partial(struct tile_work *work, unsigned bits)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    struct partial_group *const partial = &work->scratch->partial;
    const int g = queue->count++;
    memcpy(queue->texels[g], partial->texel, sizeof queue->texels[g]);
    queue->live[g] = (uint8_t)bits;
    queue->is_scattered[g] = true;
    queue->only_full_rows = false;
    queue->groups[g].mask = i32x8_from_bits(bits);
    if (work->samples > 1) {
        queue->samples[g] = i32x8_load(partial->samples) & i32x8_from_bits(bits);
    }
    for (int i = 0; i < 8; i++) {
        partial->pixels[texel_row(partial->texel[i])] = 0;
    }
    partial->count = 0;
    return g;
}

// Queue the partial group. `bits` are the lanes that are not repetitions.
static void pack_group(struct tile_work *work, unsigned bits)
{
    const struct partial_group *const partial = &work->scratch->partial;
    const int g = place_partial(work, bits);
    struct rhw_fragment *const group = &work->scratch->queue.groups[g];
    f64x8 quantity[4];
    quantity_lanes(partial->quantities, quantity);
    const struct weights weights =
        weights_of(quantity[QUANTITY_S], f64x8_div(f64x8_splat(1), quantity[QUANTITY_S]),
                   quantity[QUANTITY_B], quantity[QUANTITY_C]);
    float b[8], c[8];
    f32x8_store(b, weights.b);
    f32x8_store(c, weights.c);
    // If weights on the screen are not wanted, nothing asks for them.
    const struct packed_weights lanes = {b, c, b, c};
    if (work->plan.keeps_depth) {
        group->depth = f32x8_from_f64x8(quantity[QUANTITY_Z]);
        if (work->samples == 1) {
            group->depth = viewport_clamp(&work->scratch->depth, group->depth);
        }
    }
    if (work->samples > 1 && work->plan.depth_mode >= RHW_DEPTH_LATE) {
        for (int s = 0; s < work->samples; s++) {
            work->scratch->queue.sample_depth[g][s] =
                viewport_clamp(&work->scratch->depth, f32x8_load(partial->sample_depth[s]));
        }
    }
    if (work->plan.shading == RHW_SHADING_ANY || work->plan.fills_more) {
        pack_any(work, g, &weights, &lanes);
    } else {
        pack_varyings(work, g, &lanes);
    }
    if (work->pipeline->any_derivatives) {
        pack_derivatives(work, g, weights.inverse_s);
    }
    pack_identity(group, work->pipeline->def.program.uses, partial->triangle);
    shade_if_full(work);
}

// Queue the partial group, however few fragments it has.
static __attribute__((noinline)) void release_partial(struct tile_work *work)
{
    struct partial_group *const partial = &work->scratch->partial;
    const int live = partial->count;
    for (int i = live; i < 8; i++) {
        partial->texel[i] = partial->texel[0];
        partial->triangle[i] = partial->triangle[0];
        partial->quantities[i] = partial->quantities[0];
        partial->screen[i] = partial->screen[0];
        partial->distance[i] = partial->distance[0];
    }
    pack_group(work, 0xffu >> (8 - live));
}

// Shade all fragments of the partial group and of the queue.
static void flush(struct tile_work *work)
{
    if (work->scratch->partial.count != 0) {
        release_partial(work);
    }
    if (work->scratch->queue.count != 0) {
        RHW_ISA_NAME(rhw_shade_queue)(work);
    }
}

// Return true if a fragment that waits and a collected one have a sample in common.
static bool samples_meet(const struct tile_work *work)
{
    const struct partial_group *const partial = &work->scratch->partial;
    const struct collected_fragments *const collected = &work->scratch->collected;
    const i32x8 texels = i32x8_load(partial->texel), samples = i32x8_load(partial->samples);
    i32x8 meet = i32x8_splat(0);
    for (int i = collected->first; i < collected->count; i++) {
        meet |= rhw_equal_int(texels, i32x8_splat(collected->texel[i])) & samples &
                i32x8_splat(collected->samples[i]);
    }
    const unsigned free = i32x8_sign_bits(rhw_equal_int(meet, i32x8_splat(0)));
    return (~free & ((1u << partial->count) - 1)) != 0;
}

// Copy what packing needs of a triangle.
static const struct packed_triangle *pack_triangle(struct tile_work *work, struct triangle_work *triangle)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    struct packed_triangle *const to =
        next_packed(work, triangle->v, triangle->planes.anchor_x, triangle->planes.anchor_y);
    to->clamps_depth = work->samples > 1 && triangle->clamps_depth;
    if (work->plan.needs_distance && triangle->has_values) {
        memcpy(to->derivatives, triangle->derivatives,
               (size_t)pipeline->derivative_pairs * sizeof to->derivatives[0]);
    } else if (work->plan.needs_distance) {
        component_derivatives(to->derivatives, triangle, pipeline);
    }
    if (work->plan.shading == RHW_SHADING_ANY) {
        to->weights = triangle->planes.weights;
    }
    if (work->plan.needs_screen) {
        to->n1 = triangle->planes.n1;
        to->n2 = triangle->planes.n2;
    }
    if (pipeline->def.program.uses & (RHW_USE_FACING | RHW_USE_IDS)) {
        const struct identity identity = identity_of(triangle);
        to->front_facing = identity.front_facing;
        to->primitive = identity.primitive;
        to->instance = identity.instance;
        to->draw = identity.draw;
    }
    return to;
}

// What packing has to know of a fragment. It is a constant where a call names it.
enum packed_parts {
    PACKED_QUANTITIES, // the four quantities that every fragment needs
    PACKED_DISTANCE,   // quantities, and where the fragment is, for derivatives
    PACKED_SAMPLES,    // quantities, place, and the samples of multisampled passes
    PACKED_ANY         // whatever the plan wants
};

// Keep the depths of the samples of fragment n.
static void pack_sample_depths(const struct tile_work *work, struct plane z, int n, double dx, double dy)
{
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    for (int s = 0; s < work->samples; s++) {
        const double value =
            plane_value(z, dx + from_center(pattern->x_0_8[s]), dy + from_center(pattern->y_0_8[s]));
        work->scratch->partial.sample_depth[s][n] = (float)value;
    }
}

// Return depth kept within the viewport's range, by the operations of viewport_clamp.
static double clamp_depth(const struct tile_depth *depth, double z)
{
    const float value = (float)z, above = value > depth->least ? value : depth->least;
    return (double)(above < depth->most ? above : depth->most);
}

// Add collected fragment i of a triangle whose planes are `planes`.
RHW_INLINE void pack_fragment(struct tile_work *work, const struct quantity_planes *planes,
                              const struct packed_triangle *packed, int i, enum packed_parts parts)
{
    struct partial_group *const partial = &work->scratch->partial;
    const int texel = work->scratch->collected.texel[i];
    const int x = texel_column(texel), y = texel_row(texel);
    const double dx = x - packed->anchor_x, dy = y - packed->anchor_y;
    const int n = pack_values(partial, packed, texel, quantity_values(planes, dx, dy));
    if (parts >= PACKED_DISTANCE) {
        partial->distance[n] = (f64x4){dy, dx, dy, dx};
    }
    if (parts >= PACKED_SAMPLES) {
        partial->samples[n] = work->scratch->collected.samples[i];
    }
    if (parts == PACKED_ANY && packed->clamps_depth) {
        partial->quantities[n][QUANTITY_Z] =
            clamp_depth(&work->scratch->depth, partial->quantities[n][QUANTITY_Z]);
    }
    if (parts == PACKED_ANY && work->samples > 1 && work->plan.depth_mode >= RHW_DEPTH_LATE) {
        pack_sample_depths(work, plane_of(planes, QUANTITY_Z), n, dx, dy);
    }
    if (parts == PACKED_ANY && work->plan.needs_screen) {
        partial->screen[n] = (f64x4){plane_value(packed->n1, dx, dy), plane_value(packed->n2, dx, dy), 0, 0};
    }
    if (n + 1 == 8) {
        pack_group(work, 0xff);
    }
}

RHW_INLINE void pack_fragments(struct tile_work *work, const struct quantity_planes *planes,
                               const struct packed_triangle *packed, enum packed_parts parts)
{
    const struct collected_fragments *const collected = &work->scratch->collected;
    for (int i = collected->first; i < collected->count; i++) {
        pack_fragment(work, planes, packed, i, parts);
    }
}

// Add what is left of the collected fragments of a triangle, fewer than 8.
static void pack_collected(struct tile_work *work, struct triangle_work *triangle)
{
    const struct packed_triangle *const packed = pack_triangle(work, triangle);
    const bool late = work->plan.depth_mode >= RHW_DEPTH_LATE;
    const bool plain = work->plan.shading == RHW_SHADING_SMOOTH && !work->plan.needs_screen;
    if (work->samples > 1 && plain && !late && !packed->clamps_depth) {
        pack_fragments(work, &triangle->planes.quantities, packed, PACKED_SAMPLES);
    } else if (!plain || work->samples > 1) {
        pack_fragments(work, &triangle->planes.quantities, packed, PACKED_ANY);
    } else if (work->pipeline->any_derivatives) {
        pack_fragments(work, &triangle->planes.quantities, packed, PACKED_DISTANCE);
    } else {
        pack_fragments(work, &triangle->planes.quantities, packed, PACKED_QUANTITIES);
    }
}

#endif
