// SPDX-License-Identifier: MIT
// Groups packed from single fragments of several triangles: the few of each that its own groups leave over. A
// fragment is evaluated as one vector over quantities and one over components, then 8 of them are turned into lanes.
// Every number is made by the same operations as in a row (shade_tmpl.h), so the road a fragment takes changes no bit.
// Template: compiled once per instruction set.

#include "planes_tmpl.h"
#include "window_tmpl.h"

// The triangle that is being drawn, and what is made when its first fragments survive.
struct triangle_work {
    const struct rhw_segment *segment;
    const struct rhw_triangle *t;
    bool planes_ready, ready; // `planes` are set; what stands below `v` is
    struct planes planes;
    const struct rhw_vertex_record *v[3];
    const float *provoking;
    float i0[RHW_MAX_VARYING_COMPONENTS], d1[RHW_MAX_VARYING_COMPONENTS], d2[RHW_MAX_VARYING_COMPONENTS];
    struct rhw_slopes slopes[RHW_MAX_VARYING_COMPONENTS / 2]; // where derivatives are wanted
};

RHW_INLINE void pack_identity(const struct tile_work *work, struct rhw_fragment *group,
                              const struct rhw_packed_triangle *const triangle[8])
{
    const uint32_t uses = work->pipeline->def.program.uses;
    for (int lane = 0; lane < 8 && uses & RHW_USE_FACING; lane++) {
        group->front_facing[lane] = triangle[lane]->front_facing;
    }
    for (int lane = 0; lane < 8 && uses & RHW_USE_IDS; lane++) {
        group->primitive[lane] = triangle[lane]->primitive;
        group->instance[lane] = triangle[lane]->instance;
        group->draw[lane] = triangle[lane]->draw;
    }
}

// Turns 8 vectors over four quantities into four over the lanes.
RHW_INLINE void quantity_lanes(const d4 value[8], d8 out[4])
{
    d4 low[4] = {value[0], value[1], value[2], value[3]}, high[4] = {value[4], value[5], value[6], value[7]};
    d4_transpose(low);
    d4_transpose(high);
    for (int q = 0; q < 4; q++) {
        out[q] = (d8){low[q], high[q]};
    }
}

// Components i .. i + 7 of the 8 fragments, as one vector per component. A vertex record is padded to whole vectors.
RHW_INLINE void pack_components(const struct rhw_packed_triangle *const triangle[8], int i, const float b[8],
                                const float c[8], f8 out[8])
{
    for (int lane = 0; lane < 8; lane++) {
        const float *const *const v = triangle[lane]->varyings;
        const f8 i0 = f8_load(v[0] + i), d1 = i0 - f8_load(v[1] + i), d2 = i0 - f8_load(v[2] + i);
        out[lane] = i0 - (f8_splat(b[lane]) * d1 + f8_splat(c[lane]) * d2);
    }
    f8_transpose(out);
}

static void pack_derivatives(const struct tile_work *work, int g,
                             const struct rhw_packed_triangle *const triangle[8], d8 inverse_s)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    struct rhw_tile_scratch *const scratch = work->scratch;
    f8 *const ddx = scratch->ddx + g * pipeline->varying_components;
    f8 *const ddy = scratch->ddy + g * pipeline->varying_components;
    const d8 squared = d8_mul(inverse_s, inverse_s);
    for (int pair = 0; pair < pipeline->slope_pairs; pair++) {
        const uint8_t *const component = pipeline->slope_component[pair];
        d4 numerator[8]; // as struct rhw_slopes has them
        for (int lane = 0; lane < 8; lane++) {
            const struct rhw_slopes *const slopes = &triangle[lane]->slopes[pair];
            numerator[lane] = slopes->at + slopes->step * scratch->waiting_step[lane];
        }
        d8 lanes[4];
        quantity_lanes(numerator, lanes);
        for (int which = 0; which < 2; which++) {
            ddx[component[which]] = f8_from_d8(d8_mul(lanes[2 * which], squared));
            ddy[component[which]] = f8_from_d8(d8_mul(lanes[2 * which + 1], squared));
        }
    }
}

// Makes a group of the 8 fragments that wait; `bits`: those that are not repetitions.
static void pack_group(struct tile_work *work, unsigned bits)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const struct rhw_packed_triangle *const *const triangle = scratch->waiting_triangle;
    const int g = work->count++, components = pipeline->varying_components;
    struct rhw_fragment *const group = &scratch->groups[g];
    memcpy(scratch->lanes_at[g], scratch->waiting_at, sizeof scratch->lanes_at[g]);
    scratch->places.bits[g] = (uint8_t)bits;
    scratch->places.packed[g] = true;
    for (int i = 0; i < 8; i++) {
        scratch->waiting[scratch->waiting_at[i] / RHW_TILE] = 0;
    }
    work->waiting_count = 0;
    work->all_full = false;
    group->mask = i8_from_bits(bits);
    d8 quantity[4];
    quantity_lanes(scratch->waiting_value, quantity);
    const d8 inverse_s = d8_div(d8_splat(1), quantity[QUANTITY_S]);
    float b[8], c[8];
    f8_store(b, f8_from_d8(d8_mul(quantity[QUANTITY_B], inverse_s)));
    f8_store(c, f8_from_d8(d8_mul(quantity[QUANTITY_C], inverse_s)));
    for (int i = 0; i < components; i += 8) {
        f8 lanes[8];
        pack_components(triangle, i, b, c, lanes);
        f8 *const out = scratch->varyings + g * components + i;
        if (i + 8 <= components) {
            memcpy(out, lanes, sizeof lanes);
        } else {
            for (int k = 0; k < components - i; k++) {
                out[k] = lanes[k];
            }
        }
    }
    if (pipeline->any_derivatives) {
        pack_derivatives(work, g, triangle, inverse_s);
    }
    if (work->keeps_depth) {
        group->depth = viewport_clamp(work->state, f8_from_d8(quantity[QUANTITY_Z]));
    }
    pack_identity(work, group, triangle);
}

// Makes a group of the fragments that wait, however few.
static __attribute__((noinline)) void pack_waiting(struct tile_work *work)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    const int live = work->waiting_count;
    for (int i = live; i < 8; i++) {
        scratch->waiting_at[i] = scratch->waiting_at[0];
        scratch->waiting_triangle[i] = scratch->waiting_triangle[0];
        scratch->waiting_value[i] = scratch->waiting_value[0];
        scratch->waiting_step[i] = scratch->waiting_step[0];
    }
    pack_group(work, 0xffu >> (8 - live));
    if (work->count == RHW_FRAGMENT_GROUPS) {
        shade_window(work);
    }
}

// Fragments that wait would be overtaken by later ones of the same pixels: those of a block that are set in `mask`.
RHW_INLINE void pass_waiting(struct tile_work *work, int x, int y, uint64_t mask)
{
    if (work->waiting_count != 0 && block_bits(&work->scratch->waiting[y], x) & mask) {
        pack_waiting(work);
    }
}

// Shades all there is.
static void flush(struct tile_work *work)
{
    if (work->waiting_count != 0) {
        pack_waiting(work);
    }
    if (work->count != 0) {
        shade_window(work);
    }
}

static void prepare_slopes(const struct tile_work *work, struct triangle_work *triangle,
                           struct rhw_slopes *slopes)
{
    planes_slopes(&triangle->planes, triangle->t, triangle->v);
    component_slopes(work->pipeline, &triangle->planes.slopes, triangle->v, slopes);
}

// Copies what packing needs of a triangle.
static const struct rhw_packed_triangle *pack_triangle(struct tile_work *work, struct triangle_work *triangle)
{
    struct planes *const planes = &triangle->planes;
    struct rhw_packed_triangle *const to =
        &work->scratch->packed[work->packed_count++ % RHW_PACKED_TRIANGLES];
    to->anchor_x = planes->anchor_x - work->x;
    to->anchor_y = planes->anchor_y - work->y;
    for (int i = 0; i < 3; i++) {
        to->varyings[i] = triangle->v[i]->varyings;
    }
    if (work->pipeline->any_derivatives) {
        if (triangle->ready) {
            memcpy(to->slopes, triangle->slopes, (size_t)work->pipeline->slope_pairs * sizeof to->slopes[0]);
        } else {
            prepare_slopes(work, triangle, to->slopes);
        }
    }
    if (work->pipeline->def.program.uses & (RHW_USE_FACING | RHW_USE_IDS)) {
        const struct rhw_draw *const draw = triangle->segment->draw;
        to->front_facing = triangle->t->flags & RHW_TRIANGLE_BACK ? 0 : -1;
        to->primitive = (int32_t)triangle->t->primitive;
        to->instance = (int32_t)(draw->first_instance + triangle->segment->instance);
        to->draw = (int32_t)draw->index;
    }
    return to;
}

// Adds a fragment of a triangle whose planes are `linear`; `at`: its texel.
RHW_INLINE void pack_fragment(struct tile_work *work, const struct linear *linear,
                              const struct rhw_packed_triangle *packed, int at, bool derivatives)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    const double dx = at % RHW_TILE - packed->anchor_x, dy = at / RHW_TILE - packed->anchor_y;
    const int n = work->waiting_count;
    scratch->waiting_at[n] = at;
    scratch->waiting[at / RHW_TILE] |= (uint64_t)1 << at % RHW_TILE;
    scratch->waiting_triangle[n] = packed;
    scratch->waiting_value[n] = linear->dx * d4_splat(dx) + (linear->at + linear->dy * d4_splat(dy));
    if (derivatives) {
        scratch->waiting_step[n] = (d4){dy, dx, dy, dx};
    }
    work->waiting_count = n + 1;
    if (n + 1 == 8) {
        pack_group(work, 0xff);
        if (work->count == RHW_FRAGMENT_GROUPS) {
            shade_window(work);
        }
    }
}
