// SPDX-License-Identifier: MIT
// What is seen of a triangle becomes groups. A block that is seen all over is 8 groups as it stands (row_groups.h). The
// fragments of other blocks are collected: they are listed, and once the triangle is done, or the list full, every 8 of
// them make a group, wherever in the tile they lie. The last 6 or 7 are a group with lanes that are not live; fewer are
// packed with fragments of other triangles (pack.h). If groups must be rows (RHW_SHADING_ROWS, slivers, blocks that
// leave their triangle), a block has a group for every row. Every number is made by the same operations on each path.
#ifndef RHW_COLLECT_H
#define RHW_COLLECT_H

#include "kernels/integer.h"
#include "block.h"
#include "partial_group.h"

// A group is a row, rather than 8 collected fragments, from this number of pixels on: in the row, or in the mean of a
// block's rows.
enum { ROW_PIXELS = 4 };

// Return the least number of a triangle's fragments that become a group rather than being packed with fragments of
// other triangles. Packing one costs as much as a third of a cheap group, and less of a textured group. With this,
// particles take 3 % fewer instructions.
RHW_INLINE int least_of_group(const struct tile_work *work)
{
    enum { CHEAP = 6, TEXTURED = 7 };
    return work->pipeline->any_derivatives ? TEXTURED : CHEAP;
}

// Make groups of all collected fragments of a triangle, which is done. Many triangles have none: they are spared the
// call.
RHW_INLINE void finish_collected(struct tile_work *work, struct triangle_work *triangle)
{
    if (work->scratch->collected.count != 0) {
        RHW_ISA_NAME(rhw_release_collected)(work, triangle);
    }
}

// Return true if collected fragments lie where others wait.
static bool collected_wait(const struct tile_work *work)
{
    const struct collected_fragments *const collected = &work->scratch->collected;
    uint64_t waiting = 0;
    for (int i = 0; i < collected->count; i++) {
        const int texel = collected->texel[i];
        waiting |= work->scratch->partial.pixels[texel_row(texel)] >> texel_column(texel);
    }
    return waiting & 1;
}

// Fragments are collected where others wait. Let the waiting ones go first, unless all may share a group.
RHW_INLINE void overtake(struct tile_work *work)
{
    if (work->orders_lanes) {
        work->scratch->collected.overtakes = true;
    } else {
        RHW_ISA_NAME(rhw_release_partial)(work);
    }
}

// Collect the fragments of the first `rows` rows at (x, y) whose bits are set in `mask`.
RHW_INLINE void collect_fragments(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                                  int rows, uint64_t mask)
{
    struct collected_fragments *const collected = &work->scratch->collected;
    if (fragments_wait(work, x, y, mask)) {
        overtake(work);
    }
    if (collected->count > RHW_COLLECTED_FRAGMENTS - RHW_BLOCK * RHW_BLOCK) {
        RHW_ISA_NAME(rhw_make_room)(work, triangle);
    }
    int count = collected->count;
    i32x8 first = i32x8_splat(y * RHW_TILE + x); // first texel of the row
    // Empty rows are looked at too: a processor cannot predict which rows are empty, and a wrong guess costs more than
    // a row.
    for (int row = 0; row < rows; row++) {
        const unsigned bits = (unsigned)(mask >> (8 * row)) & 0xff;
        i32x8_store(&collected->texel[count], first + i32x8_load_bytes(collected->set_lanes[bits]));
        first += i32x8_splat(RHW_TILE);
        count += __builtin_popcount(bits);
    }
    collected->count = count;
}

// Collect the fragments of the block at (x, y) that cover a sample. `mask` has a mask for each sample, and `any` is the
// union of them.
static void collect_samples(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                            const uint64_t mask[RHW_MAX_SAMPLES], uint64_t any)
{
    struct collected_fragments *const collected = &work->scratch->collected;
    if (fragments_wait(work, x, y, any)) {
        // Groups of the collected fragments would overtake those that wait, unless the collected ones come to wait too.
        collected->overtakes = true;
    }
    if (collected->count > RHW_COLLECTED_FRAGMENTS - RHW_BLOCK * RHW_BLOCK) {
        RHW_ISA_NAME(rhw_make_room)(work, triangle);
    }
    int count = collected->count;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const unsigned bits = (unsigned)(any >> (8 * row)) & 0xff;
        if (bits == 0) {
            continue;
        }
        i32x8 samples = i32x8_splat(0);
        for (int s = 0; s < work->samples; s++) {
            samples |= i32x8_from_bits((unsigned)(mask[s] >> (8 * row)) & 0xff) & i32x8_splat(1 << s);
        }
        const i32x8 lanes = i32x8_load_bytes(collected->set_lanes[bits]);
        i32x8_store(&collected->texel[count], lanes + i32x8_splat((y + row) * RHW_TILE + x));
        i32x8_store(&collected->samples[count], i32x8_permute(samples, lanes));
        count += __builtin_popcount(bits);
    }
    collected->count = count;
}

// Return true if the fragments of a block that are set in `mask`, with inputs of any kind, are collected rather than
// shaded row by row. A group of such fragments from anywhere costs as much as a row and a half, and more the more
// targets it is blended into.
static inline bool scatters_any(const struct tile_work *work, uint64_t mask)
{
    uint64_t rows = mask | mask >> 4; // at bit 8·row: some pixel of the row
    rows |= rows >> 2;
    rows = (rows | rows >> 1) & 0x0101010101010101u;
    return work->plan.shading == RHW_SHADING_ANY &&
           __builtin_popcountll(mask) < ROW_PIXELS * __builtin_popcountll(rows);
}

// Return true if the fragments of a block that are set in `mask` can be collected.
RHW_INLINE bool can_scatter(const struct tile_work *work, const struct triangle_work *triangle,
                            const struct block *block, uint64_t mask)
{
    return work->plan.collects && !block->leaves_triangle && triangle->planes.kind != PLANES_EXACT &&
           !interpolates_in_double(work->pipeline, triangle) &&
           (work->plan.shading == RHW_SHADING_SMOOTH || scatters_any(work, mask));
}

// Collect the fragments of a block whose bits are set in `mask`, or queue them as rows.
RHW_INLINE void collect_block(struct tile_work *work, struct triangle_work *triangle,
                              const struct block *block, uint64_t mask)
{
    const bool is_whole = mask == ~(uint64_t)0;
    if (!is_whole && can_scatter(work, triangle, block, mask)) {
        collect_fragments(work, triangle, block->x, block->y, RHW_BLOCK, mask);
        return;
    }
    release_overtaken(work, block->x, block->y, mask);
    if (is_whole) {
        RHW_ISA_NAME(rhw_queue_block)(work, triangle, block);
    } else {
        RHW_ISA_NAME(rhw_queue_some_rows)(work, triangle, block, mask);
    }
}

#endif
