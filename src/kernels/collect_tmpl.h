// SPDX-License-Identifier: MIT
// What of a triangle is seen becomes groups. Blocks that are seen all over are 8 groups as they stand. The fragments of
// others are loose: they are listed, and once the triangle is done, or the list full, every 8 of them make a group,
// wherever in the tile they lie; the last few are packed with those of other triangles. Triangles that cannot be packed
// (state_tmpl.h; slivers, and blocks that are cut) have a group for every row. Every number is made by the same
// operations as in a row, so the road a fragment takes changes no bit. Template: compiled once per instruction set.

#include "constant_tmpl.h"

RHW_INLINE struct block_place loose_place(const struct tile_work *work, const struct planes *planes,
                                          const int32_t at[8])
{
    const i8 texel = i8_load(at);
    const i8 x = texel & i8_splat(RHW_TILE - 1), y = texel >> RHW_TILE_LOG2;
    return (struct block_place){d8_from_i8(x - i8_splat(planes->anchor_x - work->x)),
                                d8_from_i8(y - i8_splat(planes->anchor_y - work->y))};
}

// Groups `first` on of the fragments at `at`.
RHW_INLINE void fill_loose(const struct tile_work *work, const struct triangle_work *triangle,
                           const int32_t *at, int count, int first, bool derivatives)
{
    const struct planes *const planes = &triangle->planes;
    struct group_weights weights;
    for (int n = 0; n < count; n++) {
        const struct block_place place = loose_place(work, planes, &at[8 * n]);
        const struct weights w = weights_lanes(&planes->linear, &place);
        weights.b[n] = w.b;
        weights.c[n] = w.c;
        if (derivatives) {
            fill_slopes(work, first + n, triangle->slopes, place.dx, place.dy, w.inverse_s);
        }
        if (work->keeps_depth) {
            const f8 z = f8_from_d8(plane_lanes(&planes->linear, QUANTITY_Z, &place));
            work->scratch->groups[first + n].depth = viewport_clamp(work->state, z);
        }
    }
    fill_smooth(work, triangle, &weights, count, first);
}

// Adds groups of the fragments at `at`, 8 each, to the window.
static void add_loose_groups(struct tile_work *work, struct triangle_work *triangle, const int32_t *at,
                             int count)
{
    struct rhw_group_places *const places = &work->scratch->places;
    if (!triangle->ready) {
        prepare_values(work, triangle);
    }
    while (count != 0) {
        const int first = work->count, n = min_int(min_int(count, RHW_FRAGMENT_GROUPS - first), RHW_BLOCK);
        for (int g = first; g < first + n; g++) {
            struct rhw_fragment *const group = &work->scratch->groups[g];
            places->bits[g] = 0xff;
            places->packed[g] = true;
            memcpy(work->scratch->lanes_at[g], &at[8 * (g - first)], sizeof work->scratch->lanes_at[g]);
            group->mask = i8_splat(-1);
            if (work->wants) {
                fill_identity(work, group, triangle);
            }
        }
        if (work->pipeline->any_derivatives) {
            fill_loose(work, triangle, at, n, first, true);
        } else {
            fill_loose(work, triangle, at, n, first, false);
        }
        work->all_full = false;
        work->count = first + n;
        if (work->count == RHW_FRAGMENT_GROUPS) {
            shade_window(work);
        }
        count -= n;
        at += 8 * n;
    }
}

// Makes groups of the loose fragments that fill them; the others stay.
static __attribute__((noinline)) void group_loose(struct tile_work *work, struct triangle_work *triangle)
{
    int32_t *const loose = work->scratch->loose_at;
    const int groups = work->loose_count / 8, rest = work->loose_count % 8;
    add_loose_groups(work, triangle, loose, groups);
    memcpy(loose, &loose[8 * groups], 8 * sizeof *loose);
    work->loose_count = rest;
}

RHW_INLINE void pack_loose(struct tile_work *work, const struct linear *linear,
                           const struct rhw_packed_triangle *packed, bool derivatives)
{
    for (int i = 0; i < work->loose_count; i++) {
        pack_fragment(work, linear, packed, work->scratch->loose_at[i], derivatives);
    }
}

static __attribute__((noinline)) void release_loose(struct tile_work *work, struct triangle_work *triangle)
{
    if (work->loose_count >= 8) {
        group_loose(work, triangle);
    }
    if (work->loose_count != 0) {
        const struct rhw_packed_triangle *const packed = pack_triangle(work, triangle);
        if (work->pipeline->any_derivatives) {
            pack_loose(work, &triangle->planes.linear, packed, true);
        } else {
            pack_loose(work, &triangle->planes.linear, packed, false);
        }
        work->loose_count = 0;
    }
}

// Lets go of all loose fragments of a triangle, which is done. Many have none: those are spared the call.
RHW_INLINE void finish_loose(struct tile_work *work, struct triangle_work *triangle)
{
    if (work->loose_count != 0) {
        release_loose(work, triangle);
    }
}

// Adds the fragments of a block's first `rows` rows whose bits are set in `mask`.
RHW_INLINE void collect_loose(struct tile_work *work, struct triangle_work *triangle, int x, int y, int rows,
                              uint64_t mask)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    pass_waiting(work, x, y, mask);
    if (work->loose_count > RHW_LOOSE_FRAGMENTS - RHW_BLOCK * RHW_BLOCK) {
        group_loose(work, triangle);
    }
    int count = work->loose_count;
    // Empty rows too: which are, a processor cannot predict, and a wrong guess costs more than a row.
    for (int row = 0; row < rows; row++) {
        const unsigned bits = (unsigned)(mask >> (8 * row)) & 0xff;
        const i8 texels = i8_load_bytes(scratch->set_lanes[bits]) + i8_splat((y + row) * RHW_TILE + x);
        i8_store(&scratch->loose_at[count], texels);
        count += __builtin_popcount(bits);
    }
    work->loose_count = count;
}

// Adds a group for every row of a block of which some bits are set in `mask`.
static __attribute__((noinline)) void collect_rows(struct tile_work *work,
                                                   const struct triangle_work *triangle,
                                                   const struct block_place *at, int x, int y, uint64_t mask,
                                                   const f8 z[RHW_BLOCK], bool is_cut)
{
    struct block_rows rows = {0};
    while (mask != 0) {
        const int shift = __builtin_ctzll(mask) & 56;
        rows.row[rows.count] = (uint8_t)(shift / 8);
        rows.bits[rows.count++] = (uint8_t)(mask >> shift & 0xff);
        mask &= ~((uint64_t)0xff << shift);
    }
    if (work->count + rows.count > RHW_FRAGMENT_GROUPS) {
        shade_window(work);
    }
    add_rows(work, triangle, at, x, y, &rows, z, is_cut);
}

// Collects the fragments of a block whose bits are set in `mask`.
RHW_INLINE void collect_block(struct tile_work *work, struct triangle_work *triangle,
                              const struct block_place *at, int x, int y, uint64_t mask,
                              const f8 z[RHW_BLOCK], bool is_cut)
{
    const bool is_whole = mask == ~(uint64_t)0;
    if (!is_whole && work->packs && !is_cut && !triangle->planes.exact) {
        collect_loose(work, triangle, x, y, RHW_BLOCK, mask);
        return;
    }
    pass_waiting(work, x, y, mask);
    if (!triangle->ready) {
        prepare_values(work, triangle);
    }
    if (!is_whole) {
        collect_rows(work, triangle, at, x, y, mask, z, is_cut);
        return;
    }
    if (work->count + RHW_BLOCK > RHW_FRAGMENT_GROUPS) {
        shade_window(work);
    }
    add_rows(work, triangle, at, x, y, &all_rows, z, is_cut);
}
