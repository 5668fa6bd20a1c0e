// SPDX-License-Identifier: MIT
// A triangle in a tile, block by block of 8×8 pixels: coverage, depth, and what survives is collected for shading.
// Template: compiled once per instruction set.

#include "collect_tmpl.h"
#include "raster/coverage.h"

// Tests the pixels of a block set in `mask`, whose depths are `z`; returns those that pass. `rule` is a constant where
// a call names it, as is `whole`: all pixels are set.
RHW_INLINE uint64_t test_rows(struct tile_work *work, const f8 z[RHW_BLOCK], int x, int y, uint64_t mask,
                              const struct depth_rule rule, bool whole)
{
    float *texels = stored_depth(work, x, y);
    uint64_t passed = 0;
    for (int row = 0; row < RHW_BLOCK; row++) {
        const i8 live = whole ? i8_splat(-1) : i8_from_bits((unsigned)(mask >> (8 * row)) & 0xff);
        const i8 pass = test_lanes(texels, z[row], live, open_row(work, x, y + row, rule), rule);
        passed |= (uint64_t)i8_sign_bits(pass) << (8 * row);
        texels += RHW_TILE;
    }
    return settle_block(work, x, y, passed, rule);
}

RHW_INLINE uint64_t test_block(struct tile_work *work, const f8 z[RHW_BLOCK], int x, int y, uint64_t mask,
                               const struct depth_rule rule)
{
    return mask == ~(uint64_t)0 ? test_rows(work, z, x, y, mask, rule, true)
                                : test_rows(work, z, x, y, mask, rule, false);
}

// The same by the rule of the draw, before shading.
static uint64_t test_block_early(struct tile_work *work, const f8 z[RHW_BLOCK], int x, int y, uint64_t mask)
{
    switch (work->common) {
    case RULE_LESS: return test_block(work, z, x, y, mask, common_rules[RULE_LESS]);
    case RULE_GREATER: return test_block(work, z, x, y, mask, common_rules[RULE_GREATER]);
    case RULE_MARK_LESS: return test_block(work, z, x, y, mask, common_rules[RULE_MARK_LESS]);
    case RULE_MARK_GREATER: return test_block(work, z, x, y, mask, common_rules[RULE_MARK_GREATER]);
    case RULE_TAKE: return test_block(work, z, x, y, mask, common_rules[RULE_TAKE]);
    default: return test_block(work, z, x, y, mask, work->early);
    }
}

// The depths of a block; those of pixels outside `mask` are rubbish.
RHW_INLINE void depth_rows(const struct tile_work *work, const struct triangle_work *triangle,
                           const struct block_planes *block, const struct block_place *at, uint64_t mask,
                           bool is_cut, f8 z[RHW_BLOCK])
{
    for (int row = 0; row < RHW_BLOCK; row++) {
        z[row] = depth_row(&triangle->planes, block, row);
    }
    for (int row = 0; row < RHW_BLOCK && is_cut; row++) {
        struct cut_row cut;
        if (mask >> (8 * row) & 0xff) {
            cut_row(&triangle->planes, at, row, &cut);
            z[row] = f8_select(cut.lanes, cut.z, z[row]);
        }
    }
    for (int row = 0; row < RHW_BLOCK && triangle->t->flags & RHW_TRIANGLE_CLAMP; row++) {
        z[row] = viewport_clamp(work->state, z[row]);
    }
}

// Drawn backwards: the pixels of a block that nothing after it covers.
static uint64_t take_backwards(struct tile_work *work, int x, int y, uint64_t mask)
{
    const uint64_t taken = take_block(work, x, y, mask);
    work->open_count -= __builtin_popcountll(taken);
    return taken;
}

RHW_INLINE struct block_place block_place(const struct tile_work *work, const struct planes *planes, int x,
                                          int y)
{
    return (struct block_place){d8_from_i8(i8_splat(work->x + x - planes->anchor_x) + rhw_lane_index),
                                d8_from_i8(i8_splat(work->y + y - planes->anchor_y) + rhw_lane_index)};
}

// Whether numbers in a block may differ from the triangle's planes.
RHW_INLINE bool cuts_block(const struct triangle_work *triangle, const struct block_place *at)
{
    return triangle->t->flags & RHW_TRIANGLE_POLYGON && block_is_cut(&triangle->planes, at);
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
        mask = take_backwards(work, x, y, mask);
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
    const bool is_cut = cuts_block(triangle, &at);
    struct block_planes block;
    f8 z[RHW_BLOCK];
    if (work->needs_depth) {
        block_depth(&block, planes, &at);
        depth_rows(work, triangle, &block, &at, mask, is_cut, z);
        if (tests_early(work)) {
            const bool is_whole = mask == ~(uint64_t)0 && ((x | y) & (RHW_BLOCK - 1)) == 0;
            mask = test_block_early(work, z, x, y, mask);
            if (is_whole && work->hiz_tests && work->early.write && !is_cut && !planes->exact) {
                hiz_cover(work, planes, x, y);
            }
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
    collect_block(work, triangle, &at, x, y, mask, z, is_cut);
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

// Whether a triangle of the draw that covers the tile all over takes the road below.
RHW_INLINE bool takes_whole_tile(const struct tile_work *work)
{
    const bool all_open = work->phase == PHASE_BACKWARDS && work->open_count == RHW_TILE * RHW_TILE;
    return work->smooth && work->shades && !work->constant && !work->needs_depth && !work->wants &&
           !work->scissored && (work->phase == PHASE_ONLY || all_open);
}

RHW_INLINE void fill_whole_tile(struct tile_work *work, const struct triangle_work *triangle,
                                bool derivatives, enum weighing how)
{
    const struct planes *const planes = &triangle->planes;
    for (int y = 0; y < RHW_TILE; y += RHW_BLOCK) {
        struct block_planes block;
        const d8 dy = block_place(work, planes, 0, y).dy;
        weight_rows(&block, planes, dy, how);
        for (int x = 0; x < RHW_TILE; x += RHW_BLOCK) {
            const struct block_place at = {block_place(work, planes, x, y).dx, dy};
            weight_columns(&block, planes, at.dx);
            place_rows(work, &all_rows, work->count, x, y);
            fill_steps(work, triangle, &block, &at, &all_rows, work->count, derivatives, how);
            work->count += RHW_BLOCK;
            if (work->count == RHW_FRAGMENT_GROUPS) {
                shade_window(work);
            }
        }
    }
}

// A triangle that covers the tile all over where no depth is tested, as in full-screen passes: what its blocks share is
// done once. False where it takes the road of any other.
static __attribute__((noinline)) bool draw_whole_tile(struct tile_work *work, struct triangle_work *triangle)
{
    setup_planes(work, triangle);
    if (triangle->planes.exact || triangle->t->flags & RHW_TRIANGLE_POLYGON) {
        return false;
    }
    flush(work); // its own groups fill windows without a rest
    prepare_values(work, triangle);
    const bool derivatives = work->pipeline->any_derivatives;
    const bool level = weighing_of(&triangle->planes) == WEIGH_LEVEL;
    if (derivatives && level) {
        fill_whole_tile(work, triangle, true, WEIGH_LEVEL);
    } else if (derivatives) {
        fill_whole_tile(work, triangle, true, WEIGH_LANES);
    } else if (level) {
        fill_whole_tile(work, triangle, false, WEIGH_LEVEL);
    } else {
        fill_whole_tile(work, triangle, false, WEIGH_LANES);
    }
    work->counters->fragments += RHW_TILE * RHW_TILE;
    if (work->phase == PHASE_BACKWARDS) {
        memset(work->scratch->open, 0, sizeof work->scratch->open);
        work->open_count = 0;
    }
    return true;
}

// Bit n: the triangle's plane lies behind all that block n of the row of blocks at y shows.
static unsigned hidden_blocks(struct tile_work *work, struct triangle_work *triangle, int y)
{
    const struct planes *const planes = &triangle->planes;
    if (!work->hiz_tests || !hiz_bounds(work, y)) {
        return 0;
    }
    if (!triangle->planes_ready) {
        setup_planes(work, triangle);
    }
    if (planes->exact || planes->wide) {
        return 0;
    }
    return hiz_hidden(work, planes, y);
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
    if (takes_whole_tile(work) && covers_tile(&coverage) && draw_whole_tile(work, triangle)) {
        return;
    }
    for (int y = rect.y0 & -RHW_BLOCK; y < rect.y1; y += RHW_BLOCK) {
        const int row0 = max_int(rect.y0 - y, 0), row1 = min_int(rect.y1 - y, RHW_BLOCK);
        const unsigned hidden = hidden_blocks(work, triangle, y);
        for (int x = rect.x0 & -RHW_BLOCK; x < rect.x1; x += RHW_BLOCK) {
            if (hidden >> (x / RHW_BLOCK) & 1) {
                const struct block_place at = block_place(work, &triangle->planes, x, y);
                if (!cuts_block(triangle, &at)) {
                    continue;
                }
            }
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
