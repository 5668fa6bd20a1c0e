// SPDX-License-Identifier: MIT
// Bins: which of a chunk's triangles each tile draws. Every chunk has bins of its own, so that threads share no list.
#ifndef RHW_BINNING_H
#define RHW_BINNING_H

#include "base/arena.h"
#include "geometry_scratch.h"
#include "tile_spans.h"

// Unite the tiles of all triangles in the list, which is not empty. Bytes are compared 32 at a time; the array has room
// for this.
static struct rhw_tile_range unite_ranges(const struct rhw_triangle_list *list)
{
    enum { STEP = 8 };
    unsigned char least[4 * STEP], most[4 * STEP];
    memset(least, 0xff, sizeof least);
    memset(most, 0, sizeof most);
    for (int i = list->count; i < ((list->count + STEP - 1) & -STEP); i++) {
        list->ranges[i] = list->ranges[list->count - 1];
    }
    for (int t = 0; t < list->count; t += STEP) {
        const unsigned char *const bytes = (const unsigned char *)(list->ranges + t);
        for (int i = 0; i < 4 * STEP; i++) {
            least[i] = bytes[i] < least[i] ? bytes[i] : least[i];
            most[i] = bytes[i] > most[i] ? bytes[i] : most[i];
        }
    }
    struct rhw_tile_range all = {least[0], least[1], most[2], most[3]};
    for (int i = 4; i < 4 * STEP; i += 4) {
        all.x0 = least[i] < all.x0 ? least[i] : all.x0;
        all.y0 = least[i + 1] < all.y0 ? least[i + 1] : all.y0;
        all.x1 = most[i + 2] > all.x1 ? most[i + 2] : all.x1;
        all.y1 = most[i + 3] > all.y1 ? most[i + 3] : all.y1;
    }
    return all;
}

// Set the layers that the chunk's bins cover.
static void bound_layers(struct rhw_chunk *chunk, const struct rhw_triangle_list *list, int layers)
{
    int low = list->count != 0 ? layers - 1 : 0, high = 0;
    for (int t = 0; t < list->count && layers > 1; t++) {
        const int layer = list->triangles[t].layer;
        low = layer < low ? layer : low;
        high = layer > high ? layer : high;
    }
    chunk->layer0 = low;
    chunk->layer_count = high - low + 1;
}

// Set the rectangle of tiles that the chunk's bins cover, and their layers. `layers` is how many the pass has.
static void bound_bins(struct rhw_chunk *chunk, const struct rhw_triangle_list *list, int layers)
{
    chunk->tile_x0 = chunk->tile_y0 = chunk->tile_x1 = chunk->tile_y1 = 0;
    if (list->count != 0) {
        const struct rhw_tile_range all = unite_ranges(list);
        chunk->tile_x0 = all.x0;
        chunk->tile_y0 = all.y0;
        chunk->tile_x1 = all.x1 + 1;
        chunk->tile_y1 = all.y1 + 1;
    }
    bound_layers(chunk, list, layers);
}

static size_t tiles_of(const struct rhw_chunk *chunk)
{
    return (size_t)(chunk->tile_x1 - chunk->tile_x0) * (size_t)(chunk->tile_y1 - chunk->tile_y0) *
           (size_t)chunk->layer_count;
}

// Return how many triangles, from the first on, have at most `most` entries in the bins. A single triangle always has.
static int triangles_that_fit(const struct rhw_chunk *chunk, const struct rhw_triangle_list *list,
                              uint32_t most)
{
    if ((size_t)list->count * tiles_of(chunk) <= most) {
        return list->count;
    }
    uint32_t entries = 0; // below 2^16 triangles · 2^16 tiles
    for (int t = 0; t < list->count; t++) {
        struct tile_spans spans;
        entries += set_tile_spans(&spans, list, t);
        if (entries > most) {
            return t;
        }
    }
    return list->count;
}

// Tile (x, y) has the bin y·width + x − origin. The tile of layer l has the bin (l − layer0)·layer_size behind it.
struct bin_grid {
    int width, origin, layer_size, layer0;
};

// Return the bin of the first tile of triangle `t`. is_layered: the bins are those of several layers.
RHW_INLINE ptrdiff_t first_bin(struct bin_grid grid, const struct rhw_triangle_list *list, int t,
                               bool is_layered)
{
    const struct rhw_tile_range *const range = &list->ranges[t];
    const ptrdiff_t in_layer = range->y0 * grid.width + range->x0 - grid.origin;
    return is_layered ? in_layer + (ptrdiff_t)(list->triangles[t].layer - grid.layer0) * grid.layer_size
                      : in_layer;
}

// Add the entries of triangle `t` to the counts. `counts` begins at the triangle's first tile.
static __attribute__((noinline)) void count_tiles(uint32_t *counts, int width,
                                                  const struct rhw_triangle_list *list, int t)
{
    const int height = list->ranges[t].y1 - list->ranges[t].y0 + 1;
    struct tile_spans spans;
    set_tile_spans(&spans, list, t);
    for (int y = 0; y < height; y++) {
        for (int x = spans.first[y]; x <= spans.last[y]; x++) {
            counts[y * width + x]++;
        }
    }
}

// Write the entries of triangle `t`, and move their ends.
static __attribute__((noinline)) void place_tiles(uint16_t *entries, uint32_t *ends, int width,
                                                  const struct rhw_triangle_list *list, int t)
{
    const int height = list->ranges[t].y1 - list->ranges[t].y0 + 1;
    struct tile_spans spans;
    set_tile_spans(&spans, list, t);
    for (int y = 0; y < height; y++) {
        for (int x = spans.first[y]; x <= spans.last[y]; x++) {
            entries[ends[y * width + x]++] = (uint16_t)t;
        }
    }
}

// Add the number of entries of each bin to counts[bin]. Most triangles lie in one tile. The others are counted out of
// line, so that the loop keeps its registers.
RHW_INLINE void count_entries(uint32_t *counts, struct bin_grid grid, const struct rhw_triangle_list *list,
                              bool is_layered)
{
    for (int t = 0; t < list->count; t++) {
        uint32_t *const count = counts + first_bin(grid, list, t, is_layered);
        if (is_one_tile(&list->ranges[t])) {
            ++*count;
        } else {
            count_tiles(count, grid.width, list, t);
        }
    }
}

// Write the entries of each bin from ends[bin] on, and move ends[bin] behind them.
RHW_INLINE void place_entries(uint16_t *entries, uint32_t *ends, struct bin_grid grid,
                              const struct rhw_triangle_list *list, bool is_layered)
{
    for (int t = 0; t < list->count; t++) {
        uint32_t *const end = ends + first_bin(grid, list, t, is_layered);
        if (is_one_tile(&list->ranges[t])) {
            entries[(*end)++] = (uint16_t)t;
        } else {
            place_tiles(entries, end, grid.width, list, t);
        }
    }
}

// Sort triangles by tile, by counting: first counts, then sums, then entries. While entries are placed, offsets[i + 1]
// runs from the start of bin i to its end, which is where bin i + 1 starts; so counts stand one further still. Return
// false when out of memory.
RHW_INLINE bool bin_by(struct rhw_chunk *chunk, const struct rhw_triangle_list *list, struct rhw_arena *arena,
                       bool is_layered)
{
    const size_t tiles = tiles_of(chunk);
    const int width = chunk->tile_x1 - chunk->tile_x0;
    const int layer_size = width * (chunk->tile_y1 - chunk->tile_y0);
    const struct bin_grid grid = {width, chunk->tile_y0 * width + chunk->tile_x0, layer_size, chunk->layer0};
    uint32_t *const offsets = rhw_arena_alloc(arena, (tiles + 2) * sizeof *offsets, RHW_CACHE_LINE);
    if (!offsets) {
        return false;
    }
    memset(offsets, 0, (tiles + 2) * sizeof *offsets);
    count_entries(offsets + 2, grid, list, is_layered);
    for (size_t i = 2; i < tiles + 2; i++) {
        offsets[i] += offsets[i - 1];
    }
    chunk->counters.entries = offsets[tiles + 1];
    uint16_t *const entries =
        rhw_arena_alloc(arena, (size_t)chunk->counters.entries * sizeof *chunk->entries, RHW_CACHE_LINE);
    if (!entries) {
        return false;
    }
    place_entries(entries, offsets + 1, grid, list, is_layered);
    chunk->offsets = offsets;
    chunk->entries = entries;
    return true;
}

static __attribute__((noinline)) bool bin_layers(struct rhw_chunk *chunk,
                                                 const struct rhw_triangle_list *list,
                                                 struct rhw_arena *arena)
{
    return bin_by(chunk, list, arena, true);
}

static bool bin(struct rhw_chunk *chunk, const struct rhw_triangle_list *list, struct rhw_arena *arena)
{
    return chunk->layer_count > 1 ? bin_layers(chunk, list, arena) : bin_by(chunk, list, arena, false);
}

#endif
