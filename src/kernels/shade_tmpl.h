// SPDX-License-Identifier: MIT
// Fragments: groups of 8 are collected from any triangles of one draw, shaded with one call, then tested and
// merged in the order they came. Template: compiled once per instruction set.

#include "../shader_adapter.h"
#include "output_tmpl.h"
#include "planes_tmpl.h"
#include "scratch.h"

// How depth is tested for a draw.
enum depth_mode {
    DEPTH_NONE,
    DEPTH_EARLY,       // tested and written before shading
    DEPTH_LATE,        // after: the fragment function writes depth
    DEPTH_EARLY_REJECT // tested before, tested again and written after: the fragment function may discard
};

// One worker's work on one tile.
struct tile_work {
    struct rhw_pass_state *pass;
    struct rhw_tile_scratch *scratch;
    struct rhw_counters *counters;
    int x, y; // pixels of the tile's first pixel in the target

    // Of the draw whose fragments are collected:
    const struct rhw_draw *draw;
    const struct rhw_draw_state *state;
    const struct rhw_pipeline_data *pipeline;
    enum depth_mode depth_mode;
    bool shades;      // there is a fragment function
    bool plain;       // smooth varyings are all the fragment function reads
    bool needs_depth; // depth is tested or given to the fragment function
    bool keeps_depth; // and the collected groups carry it
    int count;        // groups collected
};

// The triangle that is being drawn, and what is made when its first fragments survive.
struct triangle_work {
    const struct rhw_segment *segment;
    const struct rhw_triangle *t;
    struct planes planes;
    bool ready;
    const struct rhw_vertex_record *v[3];
    const float *provoking;
    float i0[RHW_MAX_VARYING_COMPONENTS], d1[RHW_MAX_VARYING_COMPONENTS], d2[RHW_MAX_VARYING_COMPONENTS];
};

// Lanes for which `z compare old` holds.
static i8 depth_passes(enum rhw_compare compare, f8 z, f8 old)
{
    switch (compare) {
    case RHW_COMPARE_NEVER: return i8_splat(0);
    case RHW_COMPARE_LESS: return z < old;
    case RHW_COMPARE_EQUAL: return z == old;
    case RHW_COMPARE_LESS_EQUAL: return z <= old;
    case RHW_COMPARE_GREATER: return z > old;
    case RHW_COMPARE_NOT_EQUAL: return z != old;
    case RHW_COMPARE_GREATER_EQUAL: return z >= old;
    default: return i8_splat(-1);
    }
}

static float *stored_depth(const struct tile_work *work, int x, int y)
{
    return &work->scratch->depth[y * RHW_TILE + x];
}

static f8 viewport_clamp(const struct rhw_draw_state *state, f8 z)
{
    return f8_min(f8_max(z, f8_splat(state->depth_least)), f8_splat(state->depth_most));
}

// Tests 8 fragments and writes those that pass, if the pipeline writes.
static i8 depth_test_and_write(const struct tile_work *work, int x, int y, f8 z, i8 mask)
{
    const struct rhw_pipeline_def *const def = &work->pipeline->def;
    float *const row = stored_depth(work, x, y);
    const f8 old = f8_load(row);
    const i8 pass = mask & depth_passes(def->depth_compare, z, old);
    if (def->depth_write) {
        f8_store(row, f8_select(pass, z, old));
    }
    return pass;
}

// Lanes of group g that are still live after discarding and the late depth test.
static unsigned finish_depth(const struct tile_work *work, int g)
{
    const struct rhw_group_place place = work->scratch->places[g];
    const struct rhw_fragment *const group = &work->scratch->groups[g];
    const uint32_t uses = work->pipeline->def.program.uses;
    i8 mask = i8_from_bits(place.bits);
    if (uses & RHW_USE_DISCARD) {
        mask &= group->mask < i8_splat(0);
    }
    if (work->depth_mode >= DEPTH_LATE) {
        const f8 z = uses & RHW_USE_DEPTH ? viewport_clamp(work->state, group->depth) : group->depth;
        mask = depth_test_and_write(work, place.x, place.y, z, mask);
    }
    return i8_sign_bits(mask);
}

// Merges what was shaded into target t. `kind` is the target's, a constant where a call names one.
RHW_INLINE void merge_target(const struct tile_work *work, int t, enum output_kind kind)
{
    struct output_state state = work->state->outputs[t];
    state.kind = kind;
    const size_t texel =
        kind == OUTPUT_RGBA8_REPLACE || kind == OUTPUT_RGBA8_OVER ? 4 : work->pass->colors[t].texel_size;
    unsigned char *const texels = work->scratch->color[t];
    const struct rhw_group_place *const places = work->scratch->places;
    for (int g = 0, count = work->count; g < count; g++) {
        const struct rhw_group_place place = places[g];
        unsigned char *const to = texels + (size_t)(place.y * RHW_TILE + place.x) * texel;
        const f8 *const color = work->scratch->outputs[g][t];
        if (kind == OUTPUT_RGBA8_REPLACE && place.bits == 0xff) {
            output_group(&state, color, i8_splat(-1), to);
        } else {
            output_group(&state, color, i8_from_bits(place.bits), to);
        }
    }
}

// Shades and merges what was collected.
static void flush(struct tile_work *work)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    if (work->count == 0) {
        return;
    }
    if (work->pipeline->fragment) {
        work->pipeline->fragment(scratch->groups, work->count);
    } else {
        rhw_fragment1_run(work->pipeline, scratch->groups, work->count);
    }
    if (work->depth_mode >= DEPTH_LATE || work->pipeline->def.program.uses & RHW_USE_DISCARD) {
        for (int g = 0; g < work->count; g++) {
            scratch->places[g].bits = finish_depth(work, g);
        }
    }
    for (int t = 0; t < work->pass->color_count; t++) {
        const enum output_kind kind = work->state->outputs[t].kind;
        if (kind == OUTPUT_RGBA8_REPLACE) {
            merge_target(work, t, OUTPUT_RGBA8_REPLACE);
        } else if (kind == OUTPUT_RGBA8_OVER) {
            merge_target(work, t, OUTPUT_RGBA8_OVER);
        } else {
            merge_target(work, t, kind);
        }
    }
    work->counters->groups += (uint64_t)work->count;
    work->count = 0;
}

static void set_draw(struct tile_work *work, const struct rhw_draw *draw)
{
    flush(work);
    const struct rhw_draw_state *const state = draw->state;
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const struct rhw_pipeline_def *const def = &pipeline->def;
    const uint32_t uses = def->program.uses;
    const bool monotonic =
        def->depth_compare == RHW_COMPARE_LESS || def->depth_compare == RHW_COMPARE_LESS_EQUAL ||
        def->depth_compare == RHW_COMPARE_GREATER || def->depth_compare == RHW_COMPARE_GREATER_EQUAL;
    work->draw = draw;
    work->state = state;
    work->pipeline = pipeline;
    work->shades = pipeline->fragment || def->program.fragment1;
    work->plain = !(uses & ~(uint32_t)(RHW_USE_DISCARD | RHW_USE_DEPTH)) && !pipeline->any_noperspective &&
                  !pipeline->any_flat && !pipeline->any_derivatives;
    // A fragment that fails an ordering test now fails it later too, as depth only moves that way meanwhile.
    work->depth_mode = !def->depth_test                                               ? DEPTH_NONE
                       : !work->shades || !(uses & (RHW_USE_DISCARD | RHW_USE_DEPTH)) ? DEPTH_EARLY
                       : uses & RHW_USE_DEPTH || !monotonic                           ? DEPTH_LATE
                                                                                      : DEPTH_EARLY_REJECT;
    work->keeps_depth = work->depth_mode >= DEPTH_LATE || uses & (RHW_USE_COORD | RHW_USE_DEPTH);
    work->needs_depth = work->depth_mode != DEPTH_NONE || work->keeps_depth;
    for (int g = 0; g < RHW_FRAGMENT_GROUPS; g++) {
        struct rhw_fragment *const group = &work->scratch->groups[g];
        const int offset = g * pipeline->varying_components;
        group->varying = work->scratch->varyings + offset;
        group->ddx = work->scratch->ddx + offset;
        group->ddy = work->scratch->ddy + offset;
        group->uniforms = state->uniforms;
        group->textures = state->textures;
        group->color = work->scratch->outputs[g];
    }
}

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
        planes_slopes(&triangle->planes, triangle->t, triangle->v);
    }
    triangle->ready = true;
}

struct weight_slopes {
    f8 b_dx, b_dy, c_dx, c_dy;
};

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

static void fill_derivatives(const struct tile_work *work, int g, const struct triangle_work *triangle,
                             const struct weight_slopes *slopes)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const struct planes *const planes = &triangle->planes;
    const int components = pipeline->varying_components;
    for (int i = 0; i < components; i++) {
        if (!pipeline->component_derivatives[i]) {
            continue;
        }
        const int at = g * components + i;
        const f8 d1 = f8_splat(-triangle->d1[i]), d2 = f8_splat(-triangle->d2[i]);
        switch (pipeline->component_qualifier[i]) {
        case RHW_SMOOTH:
            work->scratch->ddx[at] = slopes->b_dx * d1 + slopes->c_dx * d2;
            work->scratch->ddy[at] = slopes->b_dy * d1 + slopes->c_dy * d2;
            break;
        case RHW_NOPERSPECTIVE:
            work->scratch->ddx[at] =
                f8_splat((float)planes->n1.dx) * d1 + f8_splat((float)planes->n2.dx) * d2;
            work->scratch->ddy[at] =
                f8_splat((float)planes->n1.dy) * d1 + f8_splat((float)planes->n2.dy) * d2;
            break;
        default: work->scratch->ddx[at] = work->scratch->ddy[at] = f8_splat(0); break;
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

static void fill_builtins(const struct tile_work *work, struct rhw_fragment *group,
                          const struct triangle_work *triangle, struct rhw_group_place place,
                          const struct weights *w, f8 s, f8 t)
{
    const uint32_t uses = work->pipeline->def.program.uses;
    if (uses & RHW_USE_COORD) {
        const f8 half = f8_splat(0.5f);
        group->coord[0] = __builtin_convertvector(i8_splat(work->x + place.x) + rhw_lane_index, f8) + half;
        group->coord[1] = f8_splat((float)(work->y + place.y)) + half;
        group->coord[2] = group->depth;
        group->coord[3] = f8_from_d8(w->s);
    }
    if (uses & RHW_USE_FACING) {
        group->front_facing = i8_splat(triangle->t->flags & RHW_TRIANGLE_BACK ? 0 : -1);
    }
    if (uses & RHW_USE_IDS) {
        const struct rhw_draw *const draw = triangle->segment->draw;
        group->primitive = i8_splat((int32_t)triangle->t->primitive);
        group->instance = i8_splat((int32_t)(draw->first_instance + triangle->segment->instance));
        group->draw = i8_splat((int32_t)draw->index);
    }
    if (uses & RHW_USE_BARYCENTRIC) {
        fill_barycentrics(group->barycentric, 1, w->b, w->c);
        fill_barycentrics(group->barycentric_noperspective, 1, s, t);
    }
}

// Everything beyond smooth varyings: other qualifiers, derivatives, builtins.
static void fill_group(const struct tile_work *work, int g, const struct triangle_work *triangle,
                       const struct block_planes *block, const struct block_place *at, int row, bool is_cut)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    const struct planes *const planes = &triangle->planes;
    const uint32_t uses = pipeline->def.program.uses;
    struct rhw_fragment *const group = &work->scratch->groups[g];
    struct weights w = weights_row(planes, block, row);
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
    if (pipeline->any_derivatives || uses & RHW_USE_BARYCENTRIC_DERIVATIVES) {
        double dy[RHW_BLOCK];
        memcpy(dy, &at->dy, sizeof dy);
        struct weight_slopes slopes;
        weight_derivatives(planes->b_slope, at->dx, dy[row], w.inverse_s, &slopes.b_dx, &slopes.b_dy);
        weight_derivatives(planes->c_slope, at->dx, dy[row], w.inverse_s, &slopes.c_dx, &slopes.c_dy);
        fill_derivatives(work, g, triangle, &slopes);
        if (uses & RHW_USE_BARYCENTRIC_DERIVATIVES) {
            fill_barycentrics(group->barycentric_ddx, 0, slopes.b_dx, slopes.c_dx);
            fill_barycentrics(group->barycentric_ddy, 0, slopes.b_dy, slopes.c_dy);
        }
    }
    fill_builtins(work, group, triangle, work->scratch->places[g], &w, s, t);
}

// Collects the rows of a block whose bits are set in `mask`; z: their depths, where depth is kept. `plain`: work->plain
// and not `is_cut`, which is block_is_cut; constants where a call names them.
RHW_INLINE void add_rows(struct tile_work *work, const struct triangle_work *triangle,
                         const struct block_planes *block, const struct block_place *at, int x, int y,
                         uint64_t mask, const f8 z[RHW_BLOCK], bool plain, bool is_cut)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    const int components = work->pipeline->varying_components;
    const bool keeps_depth = work->keeps_depth;
    work->counters->fragments += (uint64_t)__builtin_popcountll(mask);
    while (mask != 0) {
        const int shift = __builtin_ctzll(mask) & 56, row = shift / 8;
        const unsigned bits = (unsigned)(mask >> shift) & 0xff;
        const int g = work->count;
        struct rhw_fragment *const group = &scratch->groups[g];
        mask &= ~((uint64_t)0xff << shift);
        scratch->places[g] = (struct rhw_group_place){x, y + row, bits};
        group->mask = i8_from_bits(bits);
        if (keeps_depth) {
            group->depth = z[row];
        }
        if (!plain) {
            fill_group(work, g, triangle, block, at, row, is_cut);
        } else if (components != 0) {
            const struct weights w = weights_row(&triangle->planes, block, row);
            f8 *const out = scratch->varyings + g * components;
            for (int i = 0; i < components; i++) {
                out[i] = interpolate(triangle, i, w.b, w.c);
            }
        }
        work->count = g + 1;
        if (g + 1 == RHW_FRAGMENT_GROUPS) {
            flush(work);
        }
    }
}
