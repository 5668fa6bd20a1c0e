// SPDX-License-Identifier: MIT
// Groups of 8 fragments in a row of one triangle: what large triangles are shaded in. A block of 8 rows is filled at
// once, step by step, so that what a step needs of the triangle is loaded once for all rows.
// Template: compiled once per instruction set.

#include "state_tmpl.h"

static void prepare_values(const struct tile_work *work, struct triangle_work *triangle)
{
    const int components = work->pipeline->varying_components;
    const float *const a = triangle->v[0]->varyings, *const b = triangle->v[1]->varyings,
                       *const c = triangle->v[2]->varyings;
    triangle->provoking = work->pipeline->def.provoking == RHW_PROVOKING_FIRST ? a : c;
    for (int i = 0; i < components; i++) {
        triangle->i0[i] = a[i];
        triangle->d1[i] = a[i] - b[i];
        triangle->d2[i] = a[i] - c[i];
    }
    if (work->pipeline->any_derivatives ||
        work->pipeline->def.program.uses & RHW_USE_BARYCENTRIC_DERIVATIVES) {
        prepare_slopes(work, triangle, triangle->slopes);
    }
    triangle->ready = true;
}

RHW_INLINE f8 interpolate(const struct triangle_work *triangle, int i, f8 b, f8 c)
{
    return f8_splat(triangle->i0[i]) - (b * f8_splat(triangle->d1[i]) + c * f8_splat(triangle->d2[i]));
}

static void fill_varyings(const struct tile_work *work, f8 *out, const struct triangle_work *triangle, f8 b,
                          f8 c, f8 s, f8 t)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    for (int i = 0; i < pipeline->varying_components; i++) {
        switch (pipeline->component_qualifier[i]) {
        case RHW_SMOOTH: out[i] = interpolate(triangle, i, b, c); break;
        case RHW_NOPERSPECTIVE: out[i] = interpolate(triangle, i, s, t); break;
        default: out[i] = f8_splat(triangle->provoking[i]); break;
        }
    }
}

// Noperspective varyings of a triangle with a vertex that is not snapped. Weights on the screen may have any size and
// either sign there, and what float loses while they cancel would pass the bound: in double, rounded once. The added 0
// keeps a constant −0, whose differences times negative weights are −0.
static __attribute__((noinline)) void fill_homogeneous(const struct tile_work *work, f8 *out,
                                                       const struct triangle_work *triangle, d8 s, d8 t)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    for (int i = 0; i < pipeline->varying_components; i++) {
        if (pipeline->component_qualifier[i] == RHW_NOPERSPECTIVE) {
            const double i0 = (double)triangle->v[0]->varyings[i],
                         d1 = i0 - (double)triangle->v[1]->varyings[i],
                         d2 = i0 - (double)triangle->v[2]->varyings[i];
            const d8 change = d8_add(d8_mul(s, d8_splat(d1)), d8_mul(t, d8_splat(d2)));
            out[i] = f8_from_d8(d8_sub(d8_splat(i0), d8_add(change, d8_splat(0))));
        }
    }
}

// Of smooth components of group g; `dx`, `dy`: of its lanes.
RHW_INLINE void fill_slopes(const struct tile_work *work, int g, const struct rhw_slopes *slopes, d8 dx,
                            d8 dy, d8 inverse_s)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    f8 *const ddx = work->scratch->ddx + g * pipeline->varying_components;
    f8 *const ddy = work->scratch->ddy + g * pipeline->varying_components;
    const d8 squared = d8_mul(inverse_s, inverse_s);
    for (int pair = 0; pair < pipeline->slope_pairs; pair++) {
        for (int which = 0; which < 2; which++) {
            const int i = pipeline->slope_component[pair][which];
            slope_lanes(&slopes[pair], which, dx, dy, squared, &ddx[i], &ddy[i]);
        }
    }
}

// Of the other components of group g, whose derivatives are the same everywhere.
static void fill_constant_slopes(const struct tile_work *work, int g, const struct triangle_work *triangle)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const struct plane *const n1 = &triangle->planes.n1, *const n2 = &triangle->planes.n2;
    f8 *const ddx = work->scratch->ddx + g * pipeline->varying_components;
    f8 *const ddy = work->scratch->ddy + g * pipeline->varying_components;
    for (int i = 0; i < pipeline->varying_components; i++) {
        if (!pipeline->component_derivatives[i] || pipeline->component_qualifier[i] == RHW_SMOOTH) {
            continue;
        }
        ddx[i] = ddy[i] = f8_splat(0);
        if (pipeline->component_qualifier[i] == RHW_NOPERSPECTIVE) {
            const double i0 = (double)triangle->v[0]->varyings[i],
                         d1 = (double)triangle->v[1]->varyings[i] - i0,
                         d2 = (double)triangle->v[2]->varyings[i] - i0;
            ddx[i] = f8_splat((float)(n1->dx * d1 + n2->dx * d2));
            ddy[i] = f8_splat((float)(n1->dy * d1 + n2->dy * d2));
        }
    }
}

// Weights of three vertices, of which two are known; `sum` is 1, and 0 for their derivatives.
static void fill_barycentrics(f8 out[3], float sum, f8 b, f8 c)
{
    out[0] = (f8_splat(sum) - b) - c;
    out[1] = b;
    out[2] = c;
}

// What all fragments of a triangle share.
RHW_INLINE void fill_identity(const struct tile_work *work, struct rhw_fragment *group,
                              const struct triangle_work *triangle)
{
    const uint32_t uses = work->pipeline->def.program.uses;
    if (uses & RHW_USE_FACING) {
        group->front_facing = i8_splat(triangle->t->flags & RHW_TRIANGLE_BACK ? 0 : -1);
    }
    if (uses & RHW_USE_IDS) {
        const struct rhw_draw *const draw = triangle->segment->draw;
        group->primitive = i8_splat((int32_t)triangle->t->primitive);
        group->instance = i8_splat((int32_t)(draw->first_instance + triangle->segment->instance));
        group->draw = i8_splat((int32_t)draw->index);
    }
}

static void fill_builtins(const struct tile_work *work, struct rhw_fragment *group,
                          const struct triangle_work *triangle, int at, const struct weights *w, f8 s, f8 t)
{
    const uint32_t uses = work->pipeline->def.program.uses;
    if (uses & RHW_USE_COORD) {
        const f8 half = f8_splat(0.5f);
        group->coord[0] = rhw_to_float(i8_splat(work->x + at % RHW_TILE) + rhw_lane_index) + half;
        group->coord[1] = f8_splat((float)(work->y + at / RHW_TILE)) + half;
        group->coord[2] = group->depth;
        group->coord[3] = f8_from_d8(w->s);
    }
    if (uses & RHW_USE_BARYCENTRIC) {
        fill_barycentrics(group->barycentric, 1, w->b, w->c);
        fill_barycentrics(group->barycentric_noperspective, 1, s, t);
    }
    fill_identity(work, group, triangle);
}

// One group with everything that a fragment function may ask for.
static void fill_group(const struct tile_work *work, int g, const struct triangle_work *triangle,
                       const struct block_planes *block, const struct block_place *at, int row,
                       enum weighing how, bool is_cut)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const struct planes *const planes = &triangle->planes;
    const uint32_t uses = pipeline->def.program.uses;
    struct rhw_fragment *const group = &work->scratch->groups[g];
    struct weights w = weights_row(planes, block, row, how);
    d8 wide_s, wide_t;
    screen_weights_row(planes, block, row, &wide_s, &wide_t);
    if (is_cut) {
        struct cut_row cut;
        cut_row(planes, at, row, &cut);
        w = cut_weights(&cut, w);
        wide_s = d8_select(cut.lanes, cut.n1, wide_s);
        wide_t = d8_select(cut.lanes, cut.n2, wide_t);
    }
    const f8 s = f8_from_d8(wide_s), t = f8_from_d8(wide_t);
    f8 *const varyings = work->scratch->varyings + g * pipeline->varying_components;
    fill_varyings(work, varyings, triangle, w.b, w.c, s, t);
    if (planes->homogeneous && pipeline->any_noperspective) {
        fill_homogeneous(work, varyings, triangle, wide_s, wide_t);
    }
    double dy[RHW_BLOCK];
    memcpy(dy, &at->dy, sizeof dy);
    const d8 row_dy = d8_splat(dy[row]);
    if (pipeline->any_derivatives) {
        fill_slopes(work, g, triangle->slopes, at->dx, row_dy, w.inverse_s);
        fill_constant_slopes(work, g, triangle);
    }
    if (uses & RHW_USE_BARYCENTRIC_DERIVATIVES) {
        const d8 squared = d8_mul(w.inverse_s, w.inverse_s);
        f8 b_dx, b_dy, c_dx, c_dy;
        slope_lanes(&planes->slopes, 0, at->dx, row_dy, squared, &b_dx, &b_dy);
        slope_lanes(&planes->slopes, 1, at->dx, row_dy, squared, &c_dx, &c_dy);
        fill_barycentrics(group->barycentric_ddx, 0, b_dx, c_dx);
        fill_barycentrics(group->barycentric_ddy, 0, b_dy, c_dy);
    }
    fill_builtins(work, group, triangle, work->scratch->places.at[g], &w, s, t);
}

// Rows of a block that become groups: their numbers, and their bits.
struct block_rows {
    int count;
    uint8_t row[RHW_BLOCK], bits[RHW_BLOCK];
};

// Of a block that is covered all over.
static const struct block_rows all_rows = {
    RHW_BLOCK, {0, 1, 2, 3, 4, 5, 6, 7}, {255, 255, 255, 255, 255, 255, 255, 255}};

// The perspective weights of some groups.
struct group_weights {
    f8 b[RHW_BLOCK], c[RHW_BLOCK];
};

// Fills `count` groups from `first` on with smooth varyings.
RHW_INLINE void fill_smooth(const struct tile_work *work, const struct triangle_work *triangle,
                            const struct group_weights *weights, int count, int first)
{
    const ptrdiff_t components = work->pipeline->varying_components;
    f8 *const varyings = work->scratch->varyings + first * components;
    for (int i = 0; i < components; i++) {
        const f8 i0 = f8_splat(triangle->i0[i]), d1 = f8_splat(triangle->d1[i]),
                 d2 = f8_splat(triangle->d2[i]);
        f8 *to = varyings + i;
        for (int n = 0; n < count; n++, to += components) {
            *to = i0 - (weights->b[n] * d1 + weights->c[n] * d2);
        }
    }
}

// Fills the rows of a block, groups `first` on, with derivatives of smooth components: as fill_slopes does, with what
// the rows share worked out once. `squared`: by row.
RHW_INLINE void fill_row_slopes(const struct tile_work *work, const struct triangle_work *triangle,
                                const struct block_place *at, const struct block_rows *rows, int first,
                                const d8 squared[RHW_BLOCK])
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const ptrdiff_t components = pipeline->varying_components;
    for (int n = 0; n < 2 * pipeline->slope_pairs; n++) {
        const struct rhw_slopes *const slopes = &triangle->slopes[n / 2];
        const int x = n % 2 * 2, y = x + 1, i = pipeline->slope_component[n / 2][n % 2];
        const d8 along_x = d8_add(d8_splat(slopes->at[x]), d8_mul(d8_splat(slopes->step[x]), at->dy));
        const d8 along_y = d8_add(d8_splat(slopes->at[y]), d8_mul(d8_splat(slopes->step[y]), at->dx));
        double by_row[RHW_BLOCK];
        memcpy(by_row, &along_x, sizeof by_row);
        f8 *ddx = work->scratch->ddx + first * components + i,
           *ddy = work->scratch->ddy + first * components + i;
        for (int k = 0; k < rows->count; k++, ddx += components, ddy += components) {
            const int row = rows == &all_rows ? k : rows->row[k];
            *ddx = f8_from_d8(d8_mul(d8_splat(by_row[row]), squared[k]));
            *ddy = f8_from_d8(d8_mul(along_y, squared[k]));
        }
    }
}

// The rows as groups from `first` on, some at a time: while the weights of these wait for their divisions, the varyings
// of those before are worked out.
RHW_INLINE void fill_steps(const struct tile_work *work, const struct triangle_work *triangle,
                           const struct block_planes *block, const struct block_place *at,
                           const struct block_rows *rows, int first, bool derivatives, enum weighing how)
{
    enum { STEP = 4 };
    d8 squared[RHW_BLOCK];
    for (int n = 0; n < rows->count; n += STEP) {
        const int count = rows == &all_rows ? STEP : min_int(rows->count - n, STEP);
        struct group_weights weights;
        for (int k = 0; k < count; k++) {
            const int row = rows == &all_rows ? n + k : rows->row[n + k];
            const struct weights w = weights_row(&triangle->planes, block, row, how);
            weights.b[k] = w.b;
            weights.c[k] = w.c;
            if (derivatives) {
                squared[n + k] = d8_mul(w.inverse_s, w.inverse_s);
            }
        }
        fill_smooth(work, triangle, &weights, count, first + n);
    }
    if (derivatives) {
        fill_row_slopes(work, triangle, at, rows, first, squared);
    }
}

RHW_INLINE void fill_block(const struct tile_work *work, const struct triangle_work *triangle,
                           const struct block_place *at, const struct block_rows *rows, int first,
                           bool derivatives, enum weighing how)
{
    struct block_planes block;
    block_weights(&block, &triangle->planes, at, how);
    fill_steps(work, triangle, &block, at, rows, first, derivatives, how);
}

RHW_INLINE void fill_rows(const struct tile_work *work, const struct triangle_work *triangle,
                          const struct block_place *at, const struct block_rows *rows, int first,
                          bool derivatives)
{
    switch (weighing_of(&triangle->planes)) {
    case WEIGH_EXACTLY: fill_block(work, triangle, at, rows, first, derivatives, WEIGH_EXACTLY); break;
    case WEIGH_LEVEL: fill_block(work, triangle, at, rows, first, derivatives, WEIGH_LEVEL); break;
    case WEIGH_LANES: fill_block(work, triangle, at, rows, first, derivatives, WEIGH_LANES); break;
    }
}

// Depth, facing and ids of groups `first` on, for programs and tests that want them.
static void fill_wanted(const struct tile_work *work, const struct triangle_work *triangle,
                        const struct block_rows *rows, int first, const f8 z[RHW_BLOCK])
{
    for (int n = 0; n < rows->count; n++) {
        struct rhw_fragment *const group = &work->scratch->groups[first + n];
        if (work->keeps_depth) {
            group->depth = z[rows->row[n]];
        }
        fill_identity(work, group, triangle);
    }
}

// The rows of a block in groups `first` on with everything that a fragment function may ask for.
static __attribute__((noinline)) void fill_groups(const struct tile_work *work,
                                                  const struct triangle_work *triangle,
                                                  const struct block_place *at, const struct block_rows *rows,
                                                  int first, bool is_cut)
{
    const enum weighing how = weighing_of(&triangle->planes);
    struct block_planes block;
    block_weights(&block, &triangle->planes, at, how);
    block_screen_weights(&block, &triangle->planes, at);
    for (int n = 0; n < rows->count; n++) {
        fill_group(work, first + n, triangle, &block, at, rows->row[n], how, is_cut);
    }
}

// Tells where groups `first` on stand: the rows of a block at (x, y).
RHW_INLINE void place_rows(struct tile_work *work, const struct block_rows *rows, int first, int x, int y)
{
    struct rhw_group_places *const places = &work->scratch->places;
    struct rhw_fragment *const groups = &work->scratch->groups[first];
    memcpy(&places->bits[first], rows->bits, sizeof rows->bits);
    memset(&places->packed[first], 0, sizeof rows->bits);
    i8_store(&places->at[first], (i8_load_bytes(rows->row) << RHW_TILE_LOG2) + i8_splat(y * RHW_TILE + x));
    for (int n = 0; n < rows->count; n++) {
        groups[n].mask = rows == &all_rows ? i8_splat(-1) : i8_from_bits(rows->bits[n]);
    }
    for (int n = 0; n < rows->count && rows != &all_rows; n++) {
        work->all_full = work->all_full && rows->bits[n] == 0xff;
    }
}

// The rows of a block as groups, which fit into the window. z: their depths, where depth is kept.
RHW_INLINE void add_rows(struct tile_work *work, const struct triangle_work *triangle,
                         const struct block_place *at, int x, int y, const struct block_rows *rows,
                         const f8 z[RHW_BLOCK], bool is_cut)
{
    const int first = work->count;
    place_rows(work, rows, first, x, y);
    if (work->wants) {
        fill_wanted(work, triangle, rows, first, z);
    }
    if (!work->smooth || is_cut) {
        fill_groups(work, triangle, at, rows, first, is_cut);
    } else if (work->pipeline->any_derivatives) {
        fill_rows(work, triangle, at, rows, first, true);
    } else if (work->pipeline->varying_components != 0) {
        fill_rows(work, triangle, at, rows, first, false);
    }
    work->count = first + rows->count;
    if (work->count == RHW_FRAGMENT_GROUPS) {
        shade_window(work);
    }
}
