// SPDX-License-Identifier: MIT
// A triangle in a tile, block by block of 8×8 pixels: coverage, depth, and what survives is collected for shading.
// Template: compiled once per instruction set.

#include "collect_tmpl.h"
#include "coverage_tmpl.h"

// Tests depth of the block's pixels in `mask`, early; returns those that pass. `rule` is a constant where a call
// names it.
RHW_INLINE uint64_t test_block(struct tile_work *work, const struct planes *planes,
                               const struct block_planes *block, int x, int y, uint64_t mask,
                               const struct depth_rule rule)
{
    uint64_t passed = 0;
    while (mask != 0) {
        const int shift = __builtin_ctzll(mask) & 56, row = shift / 8;
        const f8 z = depth_row(planes, block, row);
        passed |= (uint64_t)test_row(work, x, y + row, z, (unsigned)(mask >> shift) & 0xff, rule) << shift;
        mask &= ~((uint64_t)0xff << shift);
    }
    return passed;
}

// The same by the rule of the draw.
static uint64_t test_block_early(struct tile_work *work, const struct planes *planes,
                                 const struct block_planes *block, int x, int y, uint64_t mask)
{
    switch (work->common) {
    case RULE_LESS: return test_block(work, planes, block, x, y, mask, common_rules[RULE_LESS]);
    case RULE_GREATER: return test_block(work, planes, block, x, y, mask, common_rules[RULE_GREATER]);
    case RULE_MARK_LESS: return test_block(work, planes, block, x, y, mask, common_rules[RULE_MARK_LESS]);
    case RULE_MARK_GREATER:
        return test_block(work, planes, block, x, y, mask, common_rules[RULE_MARK_GREATER]);
    case RULE_TAKE: return test_block(work, planes, block, x, y, mask, common_rules[RULE_TAKE]);
    default: return test_block(work, planes, block, x, y, mask, work->early);
    }
}

// The same where fragments keep their depth or it is clamped; test_block is the common road.
static uint64_t depth_block(struct tile_work *work, const struct triangle_work *triangle,
                            const struct block_planes *block, const struct block_place *at, int x, int y,
                            uint64_t mask, bool is_cut, f8 z[RHW_BLOCK])
{
    uint64_t passed = 0;
    for (int row = 0; row < RHW_BLOCK; row++) {
        unsigned bits = (unsigned)(mask >> (8 * row)) & 0xff;
        z[row] = depth_row(&triangle->planes, block, row);
        if (is_cut && bits != 0) {
            struct cut_row cut;
            cut_row(&triangle->planes, at, row, &cut);
            z[row] = f8_select(cut.lanes, cut.z, z[row]);
        }
        if (triangle->t->flags & RHW_TRIANGLE_CLAMP) {
            z[row] = viewport_clamp(work->state, z[row]);
        }
        if (tests_early(work)) {
            bits = test_row(work, x, y + row, z[row], bits, work->early);
        }
        passed |= (uint64_t)bits << (8 * row);
    }
    return passed;
}

RHW_INLINE struct block_place block_place(const struct tile_work *work, const struct planes *planes, int x,
                                          int y)
{
    return (struct block_place){d8_from_i8(i8_splat(work->x + x - planes->anchor_x) + rhw_lane_index),
                                d8_from_i8(i8_splat(work->y + y - planes->anchor_y) + rhw_lane_index)};
}

static void load_vertices(struct triangle_work *triangle)
{
    for (int i = 0; i < 3; i++) {
        triangle->v[i] = record_at(triangle->segment, triangle->t->vertex[i]);
    }
}

static void setup_planes(const struct tile_work *work, struct triangle_work *triangle)
{
    load_vertices(triangle);
    triangle->planes_ready = true;
    if (triangle->t->flags & RHW_TRIANGLE_UNSNAPPED) {
        planes_homogeneous(&triangle->planes, work->state, triangle->v);
    } else {
        planes_snapped(&triangle->planes, work->state, triangle->t, triangle->v);
    }
}

// A block, which may start at any pixel: depth first, then what survives is collected for shading.
static void draw_block(struct tile_work *work, struct triangle_work *triangle, int x, int y, uint64_t mask)
{
    if (work->phase == PHASE_BACKWARDS) {
        mask = take_block(work, x, y, mask);
    } else if (work->common == RULE_TAKE) {
        mask &= block_bits(&work->scratch->open[y], x);
    }
    if (mask == 0) {
        return;
    }
    if (work->constant && !work->needs_depth) { // no number of the triangle is wanted
        work->counters->fragments += (uint64_t)__builtin_popcountll(mask);
        constant_block(work, x, y, mask);
        return;
    }
    if (!triangle->planes_ready) {
        setup_planes(work, triangle);
    }
    const struct planes *const planes = &triangle->planes;
    const struct block_place at = block_place(work, planes, x, y);
    const bool is_cut = triangle->t->flags & RHW_TRIANGLE_POLYGON && block_is_cut(planes, &at);
    struct block_planes block;
    f8 z[RHW_BLOCK];
    if (work->needs_depth) {
        block_depth(&block, planes, &at);
        if (work->keeps_depth || triangle->t->flags & RHW_TRIANGLE_CLAMP) {
            mask = depth_block(work, triangle, &block, &at, x, y, mask, is_cut, z);
        } else {
            mask = test_block_early(work, planes, &block, x, y, mask);
        }
    }
    work->counters->fragments += work->shades ? (uint64_t)__builtin_popcountll(mask) : 0;
    if (mask == 0 || !work->shades) {
        return;
    }
    if (work->constant) {
        constant_block(work, x, y, mask);
        return;
    }
    collect_block(work, triangle, &block, &at, x, y, mask, z, is_cut);
}

// Pixels of the tile; x1 and y1 exclusive.
struct tile_rect {
    int x0, y0, x1, y1;
};

// What a triangle may cover of the tile.
RHW_INLINE struct tile_rect rect_of(const struct tile_work *work, const struct rhw_triangle *t)
{
    return (struct tile_rect){max_int(t->x0 - work->x, 0), max_int(t->y0 - work->y, 0),
                              min_int(t->x1 - work->x, RHW_TILE), min_int(t->y1 - work->y, RHW_TILE)};
}

// Draws any triangle: as much of it as is covered in the tile, which is in `rect`.
static void draw_blocks(struct tile_work *work, const struct rhw_chunk *chunk, struct triangle_work *triangle,
                        struct tile_rect rect)
{
    struct coverage coverage;
    coverage_setup(&coverage, chunk, triangle->t, work->x, work->y);
    if (coverage.count == 0) {
        return;
    }
    for (int y = rect.y0 & -RHW_BLOCK; y < rect.y1; y += RHW_BLOCK) {
        const int row0 = max_int(rect.y0 - y, 0), row1 = min_int(rect.y1 - y, RHW_BLOCK);
        for (int x = rect.x0 & -RHW_BLOCK; x < rect.x1; x += RHW_BLOCK) {
            uint64_t mask = coverage_mask(&coverage, x, y, row0, row1);
            if (work->scissored) {
                mask &= rect_mask(x, y, rect.x0, rect.y0, rect.x1, rect.y1);
            }
            if (mask != 0) {
                draw_block(work, triangle, x, y, mask);
            }
        }
    }
    finish_loose(work, triangle);
}
