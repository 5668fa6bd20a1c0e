// SPDX-License-Identifier: MIT
// A triangle of any size is drawn here in a tile whose pixels have several samples, as triangle_large.h draws it where
// pixels have one: coverage and depth are found by sample. A fragment is what a triangle covers of a pixel, one sample
// or more. It is shaded once, where its varyings say (enum rhw_sampling), and goes into every sample that it covers and
// that passes the tests.
#ifndef RHW_TRIANGLE_LARGE_SAMPLES_H
#define RHW_TRIANGLE_LARGE_SAMPLES_H

#include "kernels/fragment/explained_fragment.h"
#include "kernels/fragment/collect.h"
#include "kernels/fragment/constant_color.h"
#include "kernels/depth/stencil_block.h"
#include "sampled_block.h"
#include "triangle_planes.h"
#include "triangle_whole.h"

// Set all but depths and samples of the block, as its pixels are at sample s. If s is −1, they are at their centres.
// The block is set in place: a copy would wait for what was just written; it took msaa4_sponza 1 % of its time.
RHW_INLINE void block_set(struct block *block, const struct tile_work *work,
                          const struct triangle_work *triangle, const struct sampled_block *from, int s)
{
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    block->x = from->x;
    block->y = from->y;
    block->at = block_offset(work, &triangle->planes, from->x, from->y);
    if (s >= 0) {
        block->at.dx = f64x8_add(block->at.dx, f64x8_splat(from_center(pattern->x_0_8[s])));
        block->at.dy = f64x8_add(block->at.dy, f64x8_splat(from_center(pattern->y_0_8[s])));
    }
    block->leaves_triangle = leaves_triangle(triangle, &block->at);
}

static uint64_t any_sample(const struct tile_work *work, const struct sampled_block *block)
{
    uint64_t any = 0;
    for (int s = 0; s < work->samples; s++) {
        any |= block->mask[s];
    }
    return any;
}

static uint64_t all_samples(const struct tile_work *work, const uint64_t *mask)
{
    uint64_t all = ~(uint64_t)0;
    for (int s = 0; s < work->samples; s++) {
        all &= mask[s];
    }
    return all;
}

// Leave in the block only samples that are open, if the phase asks for open ones.
static void leave_open(struct tile_work *work, struct sampled_block *block)
{
    for (int s = 0; s < work->samples; s++) {
        struct tile_depth *const depth = depth_of_sample(work->scratch, s);
        if (work->phase == RHW_PHASE_BACKWARDS) {
            block->mask[s] = claim_backwards(depth, block->x, block->y, block->mask[s]);
        } else if (work->plan.early_name == RHW_RULE_CLAIM) {
            block->mask[s] &= block_bits(&depth->open[block->y], block->x);
        }
    }
}

// Return true if depth in the block at (x, y) is not the plane's at some sample.
static bool samples_leave(const struct tile_work *work, const struct triangle_work *triangle, int x, int y)
{
    struct anchor_offset at = block_offset(work, &triangle->planes, x, y);
    at.dx.lo[0] -= SAMPLE_REACH;
    at.dx.hi[3] += SAMPLE_REACH;
    at.dy.lo[0] -= SAMPLE_REACH;
    at.dy.hi[3] += SAMPLE_REACH;
    return leaves_triangle(triangle, &at);
}

// Test the samples of a block before shading.
static void test_samples(struct tile_work *work, const struct triangle_work *triangle,
                         struct sampled_block *block)
{
    const struct planes *const planes = &triangle->planes;
    const int face = triangle->t->flags & RHW_TRIANGLE_BACK ? 1 : 0;
    // Samples that fail other tests leave depth as it is.
    const bool covers = work->tests_bounds && work->plan.test == RHW_TEST_DEPTH && work->plan.early.write &&
                        planes->kind == PLANES_LINEAR && all_samples(work, block->mask) == ~(uint64_t)0 &&
                        !samples_leave(work, triangle, block->x, block->y);
    for (int s = 0; s < work->samples; s++) {
        if (block->mask[s] == 0) {
            continue;
        }
        struct tile_depth *const depth = depth_of_sample(work->scratch, s);
        const struct block_pixels pixels = {depth, block->z[s], block->x, block->y, block->mask[s]};
        block->mask[s] = work->plan.test != RHW_TEST_DEPTH
                             ? test_block_early_stencil(&pixels, &work->plan, face)
                             : test_early(&work->plan, test_block, &pixels);
    }
    if (covers) {
        hiz_cover(depth_of_sample(work->scratch, 0), plane_of(&planes->quantities, QUANTITY_Z),
                  planes->anchor_x - work->x, planes->anchor_y - work->y, block->x, block->y, SAMPLE_REACH);
    }
}

// Return true if fragments that take varyings at centroids have something that is taken at their pixels' centres.
static bool takes_centers(const struct rhw_pipeline_data *pipeline)
{
    const uint32_t placed =
        RHW_USE_COORD | RHW_USE_BARYCENTRIC | RHW_USE_BARYCENTRIC_DERIVATIVES | RHW_USE_POINT_COORD;
    return pipeline->any_at_center || pipeline->def.program.uses & placed;
}

// Queue the fragments of `pixels`, which take their values at sample `at`. If it is −1, they take them at the centre.
static void queue_samples(struct tile_work *work, struct triangle_work *triangle,
                          const struct sampled_block *from, uint64_t pixels, int at)
{
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    const bool per_sample = work->plan.sampling == RHW_SAMPLING_SAMPLE;
    f32x8 z[RHW_BLOCK];
    struct block block, center;
    block_set(&block, work, triangle, from, at);
    struct block_samples samples = {.mask = from->mask, .only = per_sample ? at : -1};
    if (pixels == 0) {
        return;
    }
    if (at >= 0) {
        samples.position[0] = (float)pattern->x_0_8[at] / RHW_SUBPIXEL;
        samples.position[1] = (float)pattern->y_0_8[at] / RHW_SUBPIXEL;
    }
    const bool at_centroids = at >= 0 && !per_sample;
    if (at_centroids) {
        block_set(&center, work, triangle, from, -1);
        samples.center = takes_centers(work->pipeline) ? &center : NULL;
    }
    samples.depth = work->plan.depth_mode >= RHW_DEPTH_LATE ? from->z : NULL;
    block.samples = &samples;
    block.z = z;
    if (work->plan.keeps_depth) {
        depth_rows(work, triangle, at_centroids ? &center : &block, pixels, z);
    }
    const bool is_whole = pixels == ~(uint64_t)0;
    if (at < 0 && (!is_whole || all_samples(work, from->mask) != pixels) &&
        can_scatter(work, triangle, &block, pixels)) {
        collect_samples(work, triangle, block.x, block.y, from->mask, pixels);
        return;
    }
    release_overtaken(work, block.x, block.y, pixels);
    if (is_whole) {
        RHW_ISA_NAME(rhw_queue_block)(work, triangle, &block);
    } else {
        RHW_ISA_NAME(rhw_queue_some_rows)(work, triangle, &block, pixels);
    }
}

// Expand the block at (x, y), whose samples are about to be shaded one by one.
static void separate_samples(const struct tile_work *work, int x, int y)
{
    const int number = block_of_texel(y * RHW_TILE + x);
    if (!(work->scratch->expanded >> number & 1)) {
        expand_block(work, number);
    }
}

static void queue_sampled_block(struct tile_work *work, struct triangle_work *triangle,
                                const struct sampled_block *block, uint64_t any)
{
    uint64_t left = any;
    switch (work->plan.sampling) {
    case RHW_SAMPLING_CENTER: queue_samples(work, triangle, block, any, -1); break;
    case RHW_SAMPLING_CENTROID:
        // A pixel that is not covered all over is shaded at its first covered sample, seen or not.
        left &= ~all_samples(work, block->covered);
        queue_samples(work, triangle, block, any & ~left, -1);
        for (int s = 0; s < work->samples && left != 0; s++) {
            queue_samples(work, triangle, block, left & block->covered[s], s);
            left &= ~block->covered[s];
        }
        break;
    case RHW_SAMPLING_SAMPLE:
        if (!work->scratch->is_woven) {
            separate_samples(work, block->x, block->y);
        }
        for (int s = 0; s < work->samples; s++) {
            queue_samples(work, triangle, block, block->mask[s], s);
        }
        break;
    }
}

void RHW_ISA_NAME(rhw_draw_sampled_block)(struct tile_work *work, struct triangle_work *triangle,
                                          struct sampled_block *block)
{
    const struct rhw_draw_plan *const plan = &work->plan;
    for (int s = 0; s < work->samples && plan->sampling == RHW_SAMPLING_CENTROID; s++) {
        block->covered[s] = block->mask[s];
    }
    leave_open(work, block);
    uint64_t any = any_sample(work, block);
    if (any == 0) {
        return;
    }
    if (plan->shading != RHW_SHADING_CONSTANT || plan->needs_depth) {
        if (!triangle->has_planes) {
            set_planes(work, triangle);
        }
        for (int s = 0; s < work->samples && (plan->needs_depth || work->explained); s++) {
            if (block->mask[s] != 0) {
                struct block at;
                block_set(&at, work, triangle, block, s);
                depth_rows(work, triangle, &at, block->mask[s], block->z[s]);
            }
        }
    }
    for (int s = 0; s < work->samples && work->explained; s++) {
        explain_covered(work, block->x, block->y, s, block->mask[s], block->z[s]);
    }
    if (plan->tests_early) {
        test_samples(work, triangle, block);
        any = any_sample(work, block);
    }
    for (int s = 0; s < work->samples && work->explained; s++) {
        explain_passed(work, block->x, block->y, s, block->mask[s]);
    }
    if (any == 0 || plan->shading == RHW_SHADING_NONE) {
        return;
    }
    for (int s = 0; s < work->samples && plan->sampling == RHW_SAMPLING_SAMPLE; s++) {
        work->counters->fragments += (uint64_t)__builtin_popcountll(block->mask[s]);
    }
    if (plan->sampling != RHW_SAMPLING_SAMPLE) {
        work->counters->fragments += (uint64_t)__builtin_popcountll(any);
    }
    if (plan->shading == RHW_SHADING_CONSTANT) {
        blend_constant_samples(work, block->x, block->y, block->mask);
    } else {
        queue_sampled_block(work, triangle, block, any);
    }
}

// Return the pixels of the block at (x, y) within a rectangle, which may lie elsewhere.
static uint64_t overlap_mask(int x, int y, const struct tile_rect *rect)
{
    const bool overlaps = rect->x0 < rect->x1 && rect->y0 < rect->y1 && rect->x0 < x + RHW_BLOCK &&
                          rect->x1 > x && rect->y0 < y + RHW_BLOCK && rect->y1 > y;
    return overlaps ? rect_mask(x, y, rect->x0, rect->y0, rect->x1, rect->y1) : 0;
}

// Return the pixels in the rectangle of a point whose sample s lies in the point's square. Its sides are half of its
// triangle's legs.
static struct tile_rect point_rect(const struct tile_work *work, const struct rhw_triangle *t,
                                   const struct tile_rect *rect, int s)
{
    const int32_t x = work->target->pattern->x_0_8[s], y = work->target->pattern->y_0_8[s];
    const int32_t size = (t->x_24_8[1] - t->x_24_8[0]) / 2;
    const int x0 = pixel_of_step(t->x_24_8[0], RHW_SUBPIXEL - x - 1) - work->x,
              y0 = pixel_of_step(t->y_24_8[0], RHW_SUBPIXEL - y - 1) - work->y,
              x1 = pixel_of_step(t->x_24_8[0] + size - 1, RHW_SUBPIXEL - x) - work->x,
              y1 = pixel_of_step(t->y_24_8[0] + size - 1, RHW_SUBPIXEL - y) - work->y;
    return (struct tile_rect){max_int(x0, rect->x0), max_int(y0, rect->y0), min_int(x1, rect->x1),
                              min_int(y1, rect->y1)};
}

// Set the samples of a block that the triangle covers, within its rectangle and the scissor.
static void cover_samples(const struct tile_work *work, const struct rhw_triangle *t,
                          const struct coverage *coverage, const struct tile_rect *rect,
                          struct sampled_block *block)
{
    const int x = block->x, y = block->y;
    const bool is_point = t->flags & RHW_TRIANGLE_RECTANGLE;
    for (int s = 0; s < work->samples; s++) {
        const bool is_drawn = work->pipeline->def.sample_mask >> s & 1;
        block->mask[s] = is_drawn ? coverage_mask(&coverage[s], x, y) : 0;
        if (block->mask[s] != 0 && (work->is_scissored || is_point)) {
            const struct tile_rect inside = is_point ? point_rect(work, t, rect, s) : *rect;
            block->mask[s] &= overlap_mask(x, y, &inside);
        }
    }
}

// Set all samples of a block that are drawn.
static void fill_samples(const struct tile_work *work, struct sampled_block *block)
{
    for (int s = 0; s < work->samples; s++) {
        block->mask[s] = work->pipeline->def.sample_mask >> s & 1 ? ~(uint64_t)0 : 0;
    }
}

// Set the edges of a triangle that cross the tile at some sample. They are the edges at pixel centres, and reach over a
// block as far as its samples do: half a pixel more, so that block_row_of tells of all samples at once. With the half,
// |q| in the tile is at most 63.5·(|a| + |b|) + 2 < 2^31. Return false if the triangle lies beside the tile.
static bool wide_edges_set(struct triangle_edges *wide, const struct tile_work *work,
                           const struct rhw_triangle *t)
{
    const int32_t sign = t->flags & RHW_TRIANGLE_NEGATIVE ? -1 : 1;
    const int blocks = (RHW_TILE - 1) / (RHW_BLOCK - 1); // 63 pixels are 9 times 7
    wide->count = 0;
    for (int i = 0; i < 3; i++) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        struct edge edge = make_edge(t->x_24_8[j], t->y_24_8[j], t->x_24_8[k], t->y_24_8[k], sign,
                                     center_of_pixel(work->x, work->y));
        const int64_t reach = ((int64_t)max_int(edge.a, -edge.a) + max_int(edge.b, -edge.b)) / 2 + 1;
        if (edge.q + edge.high * blocks + reach < 0) {
            return false;
        }
        if (edge.q + edge.low * blocks - reach < 0) {
            edge.low -= reach;
            edge.high += reach;
            wide->edges[wide->count++] = edge;
        }
    }
    return true;
}

// Draw the blocks of a triangle at row y of the tile.
static void draw_sampled_row(struct tile_work *work, struct triangle_work *triangle,
                             const struct coverage *coverage, const struct tile_rect *rect,
                             const struct triangle_edges *wide, int y)
{
    const unsigned columns = 0xffu << (rect->x0 / RHW_BLOCK) & 0xffu >> ((RHW_TILE - rect->x1) / RHW_BLOCK);
    const unsigned hidden = hidden_blocks(work, triangle, y);
    const struct block_row sides = wide ? block_row_of(wide, y) : (struct block_row){0, 0xff};
    for (unsigned left = columns & ~sides.outside; left != 0; left &= left - 1) {
        const int column = __builtin_ctz(left), x = column * RHW_BLOCK;
        if (hidden >> column & 1 && !samples_leave(work, triangle, x, y)) {
            continue;
        }
        struct sampled_block block;
        block.x = x;
        block.y = y;
        if (sides.crossed >> column & 1 || work->is_scissored) {
            cover_samples(work, triangle->t, coverage, rect, &block);
        } else {
            fill_samples(work, &block);
        }
        RHW_ISA_NAME(rhw_draw_sampled_block)(work, triangle, &block);
    }
}

static void draw_any_samples(struct tile_work *work, struct triangle_work *triangle)
{
    struct clipped_planes clipped;
    begin_any(work, triangle, &clipped);
    const struct rhw_sample_pattern *const pattern = work->target->pattern;
    const struct tile_rect rect = rect_of(work, triangle->t);
    // Polygons and points are more than the three edges that tell of whole blocks.
    const bool is_whole = !(triangle->t->flags & (RHW_TRIANGLE_POLYGON | RHW_TRIANGLE_RECTANGLE));
    struct triangle_edges wide;
    if (is_whole && !wide_edges_set(&wide, work, triangle->t)) {
        return;
    }
    if (is_whole && wide.count == 0 && takes_whole_tile(work)) {
        set_planes(work, triangle);
        if (draw_whole_tile(work, triangle)) {
            return;
        }
    }
    struct coverage coverage[RHW_MAX_SAMPLES];
    bool reaches = false;
    for (int s = 0; s < work->samples; s++) {
        const struct sample_origin origin = {(int64_t)work->x * RHW_SUBPIXEL + pattern->x_0_8[s],
                                             (int64_t)work->y * RHW_SUBPIXEL + pattern->y_0_8[s]};
        coverage_setup(&coverage[s], triangle->chunk, triangle->t, origin);
        reaches |= coverage[s].count != 0;
        depth_of_sample(work->scratch, s)->marked = false;
    }
    if (!reaches) {
        return;
    }
    for (int y = rect.y0 & -RHW_BLOCK; y < rect.y1; y += RHW_BLOCK) {
        draw_sampled_row(work, triangle, coverage, &rect, is_whole ? &wide : NULL, y);
    }
    finish_collected(work, triangle);
    for (int s = 1; s < work->samples; s++) {
        work->scratch->depth.marked |= depth_of_sample(work->scratch, s)->marked;
    }
}

#endif
