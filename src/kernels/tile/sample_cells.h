// SPDX-License-Identifier: MIT
// Coverage of the smallest triangles, where pixels have 4 samples, is found in cells of 4×4 pixels, 8 cells at a time,
// one in each lane. It is exact. In meshes as fine as the picture a triangle is one cell, and a batch of 8 triangles
// one vector. Cells of larger triangles, beside and below each other, stand in the list too, so that lanes stay full.
#ifndef RHW_SAMPLE_CELLS_H
#define RHW_SAMPLE_CELLS_H

#include "resource/sample_pattern.h"
#include "kernels/tile_units.h"
#include "triangle_setup8.h"

// A cell. Its mask has 4 bits for each pixel, row by row: the pixel's samples.
struct sample_cell {
    int x, y; // first pixel of the cell, in the tile
    uint64_t covered;
};

// The edges at the first pixel of 8 cells, top left, and what they change by to its samples, and to the pixels beside
// and below it. They are unsigned: see edge_lanes.
struct cell_edges8 {
    u32x8 e[3], to_sample[3][CELL_SAMPLES], right[3], down[3];
};

// The pixels of 8 cells that their triangles may cover: columns first .. end − 1 and the first `rows` rows.
struct cell_parts8 {
    i32x8 first, end, rows;
};

_Static_assert(CELLS_X == 2, "list_cells lists one or two side by side");

// Bit i says that triangle i of the batch fits: into the cells that are listed, or into one cell.
struct cell_fits {
    unsigned cells, one_cell;
};

RHW_INLINE struct cell_fits fit_cells(const struct triangle_setup8 *setup)
{
    const i32x8 width = i32x8_load(setup->x1) - i32x8_load(setup->x0),
                height = i32x8_load(setup->y1) - i32x8_load(setup->y0);
    const i32x8 beyond =
        rhw_less_int(i32x8_splat(CELLS_X * CELL), width) | rhw_less_int(i32x8_splat(CELLS_Y * CELL), height);
    const i32x8 beyond_one = rhw_less_int(i32x8_splat(CELL), i32x8_max(width, height));
    return (struct cell_fits){~i32x8_sign_bits(beyond) & 0xff, ~i32x8_sign_bits(beyond_one) & 0xff};
}

// Find the tiny triangles of the batch and list their cells. Return the number of cells. An entry has the triangle, at
// bit 8 how far to the right of the triangle's first pixel the cell begins, and at bit 16 how far below it.
static inline int list_cells(struct triangle_setup8 *setup)
{
    struct sample_cells *const cells = &setup->cells;
    const struct cell_fits fits = fit_cells(setup);
    int count = 0;
    setup->tiny = setup->small & fits.cells;
    if (fits.one_cell == 0xff) {
        i32x8_store(cells->entry, rhw_lane_index);
        i32x8_store(cells->first, rhw_lane_index);
        cells->first[BATCH] = BATCH;
        return BATCH;
    }
    for (int i = 0; i < setup->read->count; i++) {
        cells->first[i] = count;
        const int height = setup->tiny >> i & 1 ? setup->y1[i] - setup->y0[i] : 0;
        // A second cell stands beside the first.
        const int second = setup->x1[i] - setup->x0[i] > CELL;
        for (int y = 0; y < height; y += CELL) {
            cells->entry[count] = i | y << 16;
            cells->entry[count + second] = i | y << 16 | (CELL * second) << 8;
            count += 1 + second;
        }
        cells->first[i + 1] = count;
    }
    // The other lanes of the last vector are read too.
    i32x8_store(&cells->entry[count], i32x8_splat(0));
    return count;
}

// Return a number of 8 triangles, which are those of 8 cells. `number` has the number of each triangle of the batch.
RHW_INLINE i32x8 of_cells(const int32_t number[BATCH], i32x8 triangle)
{
    return i32x8_permute(i32x8_load(number), triangle);
}

// Return the samples of two pixels side by side in 8 cells, as a byte of their masks. `e` has the edges at the first
// pixel.
RHW_INLINE u32x8 cover_pair8(const struct cell_edges8 *edges, const u32x8 e[3])
{
    const u32x8 beside[3] = {e[0] + edges->right[0], e[1] + edges->right[1], e[2] + edges->right[2]};
    u32x8 first = (u32x8)i32x8_splat(0), second = (u32x8)i32x8_splat(0);
    for (int s = CELL_SAMPLES - 1; s >= 0; s--) {
        const u32x8 a = edges->to_sample[0][s], b = edges->to_sample[1][s], c = edges->to_sample[2][s];
        first = first << 1 | ((e[0] + a) | (e[1] + b) | (e[2] + c)) >> 31;
        second = second << 1 | ((beside[0] + a) | (beside[1] + b) | (beside[2] + c)) >> 31;
    }
    return (first | second << CELL_SAMPLES) ^ (u32x8)i32x8_splat(0xff);
}

// Return rows `row` and `row` + 1 of the masks of 8 cells, as far as `parts` reach.
RHW_INLINE i32x8 cover_rows8(const struct cell_edges8 *edges, const struct cell_parts8 *parts, int row)
{
    u32x8 e[3], covered = (u32x8)i32x8_splat(0);
    for (int i = 0; i < 3; i++) {
        e[i] = edges->e[i] + edges->down[i] * (u32x8)i32x8_splat(row);
    }
    const bool is_wide = rhw_any(rhw_less_int(i32x8_splat(2), parts->end));
    for (int k = 0; k < 2 && rhw_any(rhw_less_int(i32x8_splat(row + k), parts->rows)); k++) {
        u32x8 pixels = cover_pair8(edges, e);
        if (is_wide) {
            const u32x8 next[3] = {e[0] + edges->right[0] * 2, e[1] + edges->right[1] * 2,
                                   e[2] + edges->right[2] * 2};
            pixels |= cover_pair8(edges, next) << 8;
        }
        covered |= k == 0 ? pixels : pixels << 16;
        for (int i = 0; i < 3; i++) {
            e[i] += edges->down[i];
        }
    }
    return (i32x8)covered;
}

// Set the masks of cells n .. n + 7.
static inline void cover_cells8(struct sample_cells *cells, const struct triangle_setup8 *setup,
                                const struct rhw_sample_pattern *pattern, int n)
{
    const i32x8 entry = i32x8_load(&cells->entry[n]), triangle = entry & i32x8_splat(BATCH - 1);
    const i32x8 begin = of_cells(setup->x0, triangle) + (entry >> 8 & i32x8_splat(0xff)), below = entry >> 16,
                y = of_cells(setup->y0, triangle) + below,
                // All of the cell lies in the tile.
        x = i32x8_min(begin, i32x8_splat(RHW_TILE - CELL));
    const u32x8 dx = (u32x8)(x - of_cells(setup->x, triangle)) << RHW_SUBPIXEL_BITS,
                dy = (u32x8)below << RHW_SUBPIXEL_BITS;
    struct cell_edges8 edges;
    for (int i = 0; i < 3; i++) {
        const u32x8 a = (u32x8)of_cells(setup->a[i], triangle), b = (u32x8)of_cells(setup->b[i], triangle);
        edges.e[i] = (u32x8)of_cells(setup->q[i], triangle) + a * dx + b * dy;
        edges.right[i] = a << RHW_SUBPIXEL_BITS;
        edges.down[i] = b << RHW_SUBPIXEL_BITS;
        for (int s = 0; s < CELL_SAMPLES; s++) {
            edges.to_sample[i][s] =
                a * (u32x8)i32x8_splat(pattern->x_0_8[s]) + b * (u32x8)i32x8_splat(pattern->y_0_8[s]);
        }
    }
    const struct cell_parts8 parts = {begin - x,
                                      i32x8_min(of_cells(setup->x1, triangle) - x, i32x8_splat(CELL)),
                                      i32x8_min(of_cells(setup->y1, triangle) - y, i32x8_splat(CELL))};
    // Masks of two rows of a cell: before[n] has the columns before column n. upper[n] and lower[n] have what the first
    // n rows of a cell leave of its upper two rows and of its lower two.
    const i32x8 before = {0, 0x000f000f, 0x00ff00ff, 0x0fff0fff, -1};
    const i32x8 upper = {0, 0xffff, -1, -1, -1}, lower = {0, 0, 0, 0xffff, -1};
    const i32x8 columns = i32x8_permute(before, parts.end) & ~i32x8_permute(before, parts.first);
    i32x8_store(&cells->low[n], cover_rows8(&edges, &parts, 0) & columns & i32x8_permute(upper, parts.rows));
    i32x8_store(&cells->high[n], cover_rows8(&edges, &parts, 2) & columns & i32x8_permute(lower, parts.rows));
    i32x8_store(&cells->x[n], x);
    i32x8_store(&cells->y[n], y);
}

// Find the tiny triangles of a batch that fit into the list, and cover them.
void RHW_ISA_NAME(rhw_find_tiny_samples)(struct triangle_setup8 *setup,
                                         const struct rhw_sample_pattern *pattern)
{
    struct sample_cells *const cells = &setup->cells;
    const int count = list_cells(setup);
    for (int n = 0; n < count; n += BATCH) {
        cover_cells8(cells, setup, pattern, n);
    }
    unsigned covers = 0;
    for (int n = 0; n < count; n++) {
        covers |= (unsigned)((cells->low[n] | cells->high[n]) != 0) << cells->entry[n] % BATCH;
    }
    cells->covers = covers;
}

RHW_INLINE struct sample_cell cell_at(const struct sample_cells *cells, int n)
{
    return (struct sample_cell){cells->x[n], cells->y[n], cells->low[n] | (uint64_t)cells->high[n] << 32};
}

#endif
