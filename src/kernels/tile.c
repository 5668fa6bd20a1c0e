// SPDX-License-Identifier: MIT
// One tile: load or clear, draw the triangles binned for it, store. Compiled once per instruction set, with
// RHW_ISA_SUFFIX naming it. In which order the triangles of a run are drawn, hidden_surface.h says; the order of runs
// is that of submission.
#include "kernel_entries.h"

#include "integer.h"
#include "kernels/raster/conservative.h"
#include "kernels/raster/line_pixels.h"
#include "kernels/raster/smooth_coverage.h"
#include "kernels/tile/draw_state.h"
#include "kernels/tile/explained_triangle.h"
#include "kernels/tile/resolve.h"
#include "kernels/tile/stippled_line.h"
#include "kernels/tile/triangle_large.h"
#include "kernels/tile/triangle_multisample.h"
#include "kernels/tile/triangle_small_samples.h"
#include "kernels/tile/triangle_small.h"
#include "kernels/tile/triangle_specks.h"
#include "kernels/tile/triangle_tiny_samples.h"

// Lists the bins of the tile that are not empty, in the order of their chunks; returns how many there are.
static int list_bins(const struct tile_work *work)
{
    const int x = work->x / RHW_TILE, y = work->y / RHW_TILE;
    int count = 0;
    for (int n = 0; n < work->wave->chunk_count; n++) {
        const struct rhw_chunk *const chunk = &work->wave->chunks[n];
        if (x < chunk->tile_x0 || x >= chunk->tile_x1 || y < chunk->tile_y0 || y >= chunk->tile_y1) {
            continue;
        }
        const int layer = work->layer - chunk->layer0;
        if (layer < 0 || layer >= chunk->layer_count) {
            continue;
        }
        const int row = layer * (chunk->tile_y1 - chunk->tile_y0) + y - chunk->tile_y0;
        const int i = row * (chunk->tile_x1 - chunk->tile_x0) + x - chunk->tile_x0;
        if (chunk->offsets[i] != chunk->offsets[i + 1]) {
            work->scratch->bins[count++] = (struct bin){chunk, chunk->offsets[i], chunk->offsets[i + 1]};
        }
    }
    return count;
}

// What is no matter of samples: the pixels of a Bresenham line, of a smooth one, and conservative ones.
struct pixel_shape {
    bool is_line, is_smooth;
    struct line_pixels line;
    struct smooth_line smooth;
    struct stippled_rectangle stipple; // of the smooth line
    struct conservative_edges edges;
    bool tells_contained; // edges of pixels that are contained follow
    struct conservative_edges contained;
};

// False where the tile has nothing of it.
static bool set_shape(const struct tile_work *work, const struct rhw_triangle *t,
                      const struct rhw_chunk *chunk, struct pixel_shape *shape)
{
    const struct rhw_pipeline_data *const pipeline = work->pipeline;
    shape->is_line = t->flags & RHW_TRIANGLE_LINE;
    shape->is_smooth = t->flags & RHW_TRIANGLE_SMOOTH;
    shape->tells_contained = false;
    if (shape->is_line) {
        shape->line = line_pixels_of(t, work->state->line_pixels);
        return true;
    }
    if (shape->is_smooth) {
        smooth_line_set(&shape->smooth, t, work->x, work->y);
        shape->stipple = stippled_rectangle_of(t, &work->state->stipple);
        return true;
    }
    const struct sample_origin origin = center_of_pixel(work->x, work->y);
    shape->tells_contained = pipeline->def.program.uses & RHW_USE_FULLY_COVERED &&
                             conservative_setup(&shape->contained, chunk, t, true, origin);
    return conservative_setup(&shape->edges, chunk, t,
                              pipeline->def.conservative == RHW_CONSERVATIVE_UNDERESTIMATE, origin);
}

// The pixels of a Bresenham line in the block at (x, y) of the tile.
static uint64_t line_shape_mask(const struct tile_work *work, const struct rhw_triangle *t,
                                const struct line_pixels *line, int x, int y)
{
    const uint64_t mask = line_mask(line, work->x + x, work->y + y);
    return t->flags & RHW_TRIANGLE_STIPPLE && mask != 0
               ? mask & stippled_columns(t, &work->state->stipple, line->is_y_major, work->x + x, work->y + y)
               : mask;
}

// The same of any shape; of a smooth line it gives how much of them is covered, too.
static uint64_t shape_mask(const struct tile_work *work, const struct rhw_triangle *t,
                           const struct pixel_shape *shape, int x, int y, f32x8 coverage[RHW_BLOCK])
{
    if (shape->is_line) {
        return line_shape_mask(work, t, &shape->line, x, y);
    }
    if (!shape->is_smooth) {
        return conservative_mask(&shape->edges, x, y);
    }
    const uint64_t mask = smooth_mask(&shape->smooth, x, y, coverage);
    const struct sample_origin center = center_of_pixel(work->x + x, work->y + y);
    return t->flags & RHW_TRIANGLE_STIPPLE && mask != 0
               ? mask & stippled_samples(&shape->stipple, center.x, center.y)
               : mask;
}

// All samples of the pixels are covered.
static void draw_shape_block(struct tile_work *work, struct triangle_work *triangle, int x, int y,
                             uint64_t mask)
{
    if (work->samples == 1) {
        draw_block(work, triangle, x, y, mask);
        return;
    }
    struct sampled_block block = {.x = x, .y = y};
    for (int s = 0; s < work->samples; s++) {
        block.mask[s] = work->pipeline->def.sample_mask >> s & 1 ? mask : 0;
    }
    draw_sampled_block(work, triangle, &block);
}

// Whether a triangle was seen is kept by sample, and then told of all.
static void unmark_samples(struct tile_work *work)
{
    for (int s = 1; s < work->samples; s++) {
        depth_plane(work->scratch, s)->marked = false;
    }
}

static void unite_marks(struct tile_work *work)
{
    for (int s = 1; s < work->samples; s++) {
        work->scratch->depth.marked |= depth_plane(work->scratch, s)->marked;
    }
}

static __attribute__((noinline)) void draw_shape(struct tile_work *work, struct triangle_work *triangle,
                                                 const struct rhw_chunk *chunk)
{
    const struct tile_rect rect = rect_of(work, triangle->t);
    struct pixel_shape shape;
    if (!set_shape(work, triangle->t, chunk, &shape)) {
        return;
    }
    unmark_samples(work);
    for (int y = rect.y0 & -RHW_BLOCK; y < rect.y1; y += RHW_BLOCK) {
        for (int x = rect.x0 & -RHW_BLOCK; x < rect.x1; x += RHW_BLOCK) {
            f32x8 coverage[RHW_BLOCK];
            const uint64_t mask = shape_mask(work, triangle->t, &shape, x, y, coverage) &
                                  rect_mask(x, y, rect.x0, rect.y0, rect.x1, rect.y1);
            if (mask != 0) {
                triangle->coverage = coverage;
                triangle->contained = shape.tells_contained ? conservative_mask(&shape.contained, x, y) : 0;
                draw_shape_block(work, triangle, x, y, mask);
            }
        }
    }
    finish_gathered(work, triangle);
    unite_marks(work);
}

static __attribute__((noinline)) void draw_stippled_line(struct tile_work *work,
                                                         struct triangle_work *triangle,
                                                         const struct rhw_chunk *chunk)
{
    const struct tile_rect rect = rect_of(work, triangle->t);
    struct stippled_line line;
    set_stippled_line(&line, work, chunk, triangle->t);
    unmark_samples(work);
    for (int y = rect.y0 & -RHW_BLOCK; y < rect.y1; y += RHW_BLOCK) {
        for (int x = rect.x0 & -RHW_BLOCK; x < rect.x1; x += RHW_BLOCK) {
            const uint64_t inside = rect_mask(x, y, rect.x0, rect.y0, rect.x1, rect.y1);
            struct sampled_block block = {.x = x, .y = y};
            for (int s = 0; s < work->samples; s++) {
                block.mask[s] = inside & stippled_line_mask(&line, work, x, y, s);
            }
            if (work->samples == 1) {
                draw_block(work, triangle, x, y, block.mask[0]);
            } else {
                draw_sampled_block(work, triangle, &block);
            }
        }
    }
    finish_gathered(work, triangle);
    unite_marks(work);
}

// Draws any triangle, small ones too.
static void draw_any(struct tile_work *work, struct triangle_work *triangle, const struct rhw_chunk *chunk)
{
    struct clipped_planes clipped;
    triangle->clipped = triangle->t->flags & RHW_TRIANGLE_POLYGON ? &clipped : NULL;
    if (!work->plan.is_biased) {
        triangle->clamps_depth = triangle->t->flags & RHW_TRIANGLE_CLAMP;
        triangle->depth_bias = 0;
    }
    if (triangle->t->flags & (RHW_TRIANGLE_LINE | RHW_TRIANGLE_SMOOTH | RHW_TRIANGLE_CONSERVATIVE)) {
        draw_shape(work, triangle, chunk);
    } else if (triangle->t->flags & RHW_TRIANGLE_STIPPLE) {
        draw_stippled_line(work, triangle, chunk);
    } else if (work->samples == 1) {
        draw_large(work, triangle, chunk);
    } else if (takes_small_samples(work, triangle)) {
        draw_small_samples(work, triangle);
    } else {
        draw_multisampled(work, triangle, chunk);
    }
}

// Begins triangle `lane` of the setup; gives its draw's flag of small triangles, 0 where it is to take no path of theirs.
RHW_INLINE uint16_t begin_triangle(struct tile_work *work, struct triangle_work *triangle,
                                   const struct rhw_chunk *chunk, struct triangle_setup8 *setup, int lane)
{
    const struct rhw_triangle *const t = setup->read->triangle[lane];
    const struct rhw_segment *const segment = &chunk->segments[t->segment];
    if (segment->draw != work->draw) {
        set_draw(work, segment->draw);
    }
    triangle->segment = segment;
    triangle->t = t;
    triangle->setup = setup;
    triangle->lane = lane;
    triangle->has_planes = triangle->has_values = false;
    const uint16_t small_flag = work->plan.small_flag; // 0 for what is biased
    return !(t->flags & small_flag) && work->plan.is_biased ? bias_triangle(work, triangle, setup)
                                                            : small_flag;
}

static void draw_triangle(struct tile_work *work, const struct rhw_chunk *chunk,
                          struct triangle_setup8 *setup, int lane)
{
    struct triangle_work triangle;
    const uint16_t small_flag = begin_triangle(work, &triangle, chunk, setup, lane);
    if (triangle.t->flags & small_flag && !(setup->exact >> lane & 1)) {
        draw_small(work, &triangle);
    } else if (work->samples > 1 && is_plain_small(setup, lane, plain_flags(&work->plan))) {
        triangle.clipped = NULL;
        triangle.clamps_depth = false;
        triangle.depth_bias = 0;
        draw_small_samples(work, &triangle);
    } else if (!work->plan.is_skipped) {
        draw_any(work, &triangle, chunk);
    }
}

// Draws the triangles of a batch by the general path, and tells of those that cover a sample.
static __attribute__((noinline)) void explain_batch(struct tile_work *work, const struct rhw_chunk *chunk,
                                                    struct triangle_setup8 *setup)
{
    for (int i = 0; i < setup->read->count; i++) {
        struct sample_content before;
        struct triangle_work triangle;
        explain_begin(work, &before);
        begin_triangle(work, &triangle, chunk, setup, i);
        draw_any(work, &triangle, chunk);
        explain_end(work, &before, &triangle);
    }
}

// Whether what is left of a run is hidden.
static bool is_hidden(const struct tile_work *work)
{
    return work->phase == RHW_PHASE_BACKWARDS && work->scratch->depth.open_count == 0 &&
           others_are_closed(work);
}

static void draw_batch(struct tile_work *work, const struct rhw_chunk *chunk, const struct bin_batch *read)
{
    struct triangle_setup8 setup;
    struct rhw_tile_scratch *const scratch = work->scratch;
    const bool backwards = work->phase == RHW_PHASE_BACKWARDS;
    setup_triangles8(&setup, work, chunk, read);
    if (work->explained) {
        explain_batch(work, chunk, &setup);
        return;
    }
    const unsigned specks = work->samples == 1 ? set_specks(work, chunk, &setup) : 0;
    for (int i = 0; i < read->count; i++) {
        if (backwards && is_hidden(work)) {
            break;
        }
        scratch->depth.marked = false;
        if (work->samples == CELL_SAMPLES) {
            i = draw_tiny_run(work, chunk, &setup, i);
        } else if (specks >> i & 1) {
            i = draw_specks(work, chunk, &setup, i);
        }
        if (i == read->count) {
            break;
        }
        draw_triangle(work, chunk, &setup, i);
        if (work->phase == RHW_PHASE_DEPTH && (scratch->depth.marked || work->plan.is_skipped)) {
            see_triangle(work, read->number[i]);
        }
    }
}

// `number`: of the bin's first triangle among those that are drawn in two phases.
static void draw_bin(struct tile_work *work, const struct bin *bin, uint32_t number)
{
    struct bin_batch batches[BATCHES_AHEAD + 1];
    struct bin_reader reader = read_bin(work, bin, number);
    for (int i = 0; i < BATCHES_AHEAD; i++) {
        read_batch(&reader, &batches[i]);
    }
    for (int i = 0; batches[i].count != 0 && !is_hidden(work); i = i == BATCHES_AHEAD ? 0 : i + 1) {
        read_batch(&reader, &batches[i == 0 ? BATCHES_AHEAD : i - 1]);
        draw_batch(work, bin->chunk, &batches[i]);
    }
}

// Some of the tile's bins, one after the other.
struct bin_run {
    const struct bin *first, *end;
};

static void draw_run(struct tile_work *work, struct bin_run run, enum rhw_phase phase)
{
    // Triangles, at least, between two looks at the tile's depth in a sample, which are taken between bins.
    enum { REFRESH = 16 };
    uint32_t number = 0, looked = 0;
    start_phase(work, phase);
    for (const struct bin *bin = run.first; bin < run.end; bin++) {
        if (phase == RHW_PHASE_DEPTH && number - looked >= REFRESH && work->scratch->depth.direction != 0) {
            refresh_bounds(work);
            looked = number;
        }
        draw_bin(work, bin, number);
        number += bin->end - bin->first;
    }
}

// Estimates the pixels that a triangle covers in the tile.
static double area_in_tile(const struct tile_work *work, const struct rhw_triangle *t)
{
    const struct tile_rect rect = rect_of(work, t);
    const double rectangle = (rect.x1 - rect.x0) * (rect.y1 - rect.y0);
    if (t->flags & RHW_TRIANGLE_POLYGON) {
        return rectangle / 2;
    }
    const double x1 = t->x_24_8[1] - t->x_24_8[0], y1 = t->y_24_8[1] - t->y_24_8[0];
    const double x2 = t->x_24_8[2] - t->x_24_8[0], y2 = t->y_24_8[2] - t->y_24_8[0];
    const double turn = x1 * y2 - x2 * y1,
                 area = (turn < 0 ? -turn : turn) / (2 * RHW_SUBPIXEL * RHW_SUBPIXEL);
    return area < rectangle ? area : rectangle;
}

// Whether the triangles of a run lie above each other so much that shading what is hidden, half of which the depth
// test would have stopped, costs more than drawing depth first: judged by the areas of some of them. Measured: depth
// costs 3 ns a pixel and 60 ns a triangle more; shading 9 ns a pixel, with textures 18.
static bool overdraws(const struct tile_work *work, struct bin_run run)
{
    enum { SAMPLES = 64 };
    const struct tile_rect *const area = &work->area;
    const double tile_pixels = (area->x1 - area->x0) * (area->y1 - area->y0);
    const double shading_ns = 9, textured_ns = 18, depth_ns = 3, triangle_ns = 60;
    uint32_t count = 0;
    for (const struct bin *bin = run.first; bin < run.end; bin++) {
        count += bin->end - bin->first;
    }
    if (count > RHW_DEPTH_FIRST_TRIANGLES) {
        return false;
    }
    const uint32_t step = count / SAMPLES + 1;
    uint32_t next = 0; // of the bin under way
    double covered = 0;
    for (const struct bin *bin = run.first; bin < run.end; bin++) {
        for (; next < bin->end - bin->first; next += step) {
            covered +=
                step * area_in_tile(work, &bin->chunk->triangles[bin->chunk->entries[bin->first + next]]);
        }
        next -= bin->end - bin->first;
    }
    const struct rhw_draw *const draw = run.first->chunk->segments[0].draw;
    const double pixel_ns = draw->state->pipeline->any_derivatives ? textured_ns : shading_ns;
    return (covered - tile_pixels) / 2 * pixel_ns > covered * depth_ns + count * triangle_ns;
}

static void draw_depth_first(struct tile_work *work, struct bin_run run)
{
    memset(work->scratch->seen, 0, sizeof work->scratch->seen);
    draw_run(work, run, RHW_PHASE_DEPTH);
    draw_run(work, run, RHW_PHASE_SHADE);
}

// Draws the last triangle first, until nothing of the tile is open.
static void draw_backwards(struct tile_work *work, struct bin_run run)
{
    start_phase(work, RHW_PHASE_BACKWARDS);
    const struct bin *bin = run.end;
    while (bin > run.first && !is_hidden(work)) {
        draw_bin(work, --bin, 0);
    }
}

// Unites, from `first` on, bins that can be drawn depth first or backwards, or that cannot; at least one.
static struct bin_run run_from(const struct bin *first, const struct bin *end)
{
    struct bin_run run = {first, first + 1};
    while (run.end < end && rhw_hidden_rule_equal(run.end->chunk->hidden, first->chunk->hidden)) {
        run.end++;
    }
    return run;
}

// How a run is drawn.
static enum rhw_tile_plan choose_plan(const struct tile_work *work, struct bin_run run)
{
    const enum rhw_hidden_surface hidden = run.first->chunk->hidden.kind;
    return hidden == RHW_HIDDEN_BACKWARDS                             ? RHW_TILE_BACKWARDS
           : hidden == RHW_HIDDEN_DEPTH_FIRST && overdraws(work, run) ? RHW_TILE_DEPTH_FIRST
                                                                      : RHW_TILE_IN_ORDER;
}

static void draw_bins(struct tile_work *work, const struct bin *first, const struct bin *end)
{
    while (first < end) {
        const struct bin_run run = run_from(first, end);
        const enum rhw_tile_plan plan = choose_plan(work, run);
        work->plans |= plan;
        switch (plan) {
        case RHW_TILE_BACKWARDS: draw_backwards(work, run); break;
        case RHW_TILE_DEPTH_FIRST: draw_depth_first(work, run); break;
        case RHW_TILE_IN_ORDER: draw_run(work, run, RHW_PHASE_ONLY); break;
        }
        first = run.end;
    }
    flush(work);
    end_counts(work);
}

static void load_tile(const struct tile_work *work)
{
    const struct rhw_target *const target = work->target;
    if (work->samples > 1) {
        load_samples(work);
        return;
    }
    work->scratch->depth.direction = 0;
    work->scratch->depth.has_ranges = false;
    work->scratch->depth.unranged = 0;
    for (int i = 0; i < target->color_count; i++) {
        load_attachment(work, &target->colors[i], 0, work->scratch->color[i]);
    }
    load_depth_stencil(work, 0);
}

static void store_tile(const struct tile_work *work)
{
    const struct rhw_target *const target = work->target;
    if (work->samples > 1) {
        store_samples(work);
        return;
    }
    for (int i = 0; i < target->color_count; i++) {
        store_attachment(work, &target->colors[i], 0, work->scratch->color[i]);
    }
    store_depth_stencil(work, 0);
}

// A tile without triangles.
static void pass_tile_through(const struct tile_work *work)
{
    const struct rhw_target *const target = work->target;
    for (int i = 0; i < target->color_count; i++) {
        pass_through(work, &target->colors[i]);
    }
    if (target->has_depth) {
        pass_through(work, &target->depth);
    }
    if (target->has_stencil) {
        pass_through(work, &target->stencil);
    }
}

// `before`: what the worker had counted before this tile.
static __attribute__((noinline)) void report(const struct tile_work *work, struct rhw_tile_report *to,
                                             int bins, const struct rhw_counters *before)
{
    to->plans |= work->plans;
    to->fragments_shaded += work->counters->fragments - before->fragments;
    to->fragment_groups += work->counters->groups - before->groups;
    for (int i = 0; i < bins; i++) {
        to->triangles += work->scratch->bins[i].end - work->scratch->bins[i].first;
    }
}

// What lies within the render area of a tile at (x, y).
static struct tile_rect area_of_tile(const struct rhw_target *target, int x, int y)
{
    const struct rhw_rect *const area = &target->area;
    return (struct tile_rect){max_int(area->x - x, 0), max_int(area->y - y, 0),
                              min_int(area->x + area->width - x, RHW_TILE),
                              min_int(area->y + area->height - y, RHW_TILE)};
}

void RHW_ISA_NAME(rhw_draw_tile)(const struct rhw_wave *wave, int number, int worker)
{
    struct rhw_recorded_pass *const pass = wave->pass;
    const struct rhw_target *const target = &wave->target;
    const int tiles = target->tiles_x * target->tiles_y, tile = number % tiles;
    const int tile_x = tile % target->tiles_x, tile_y = tile / target->tiles_x;
    struct rhw_tile_scratch *const scratch = wave->workers[worker].tile;
    struct tile_work work = {.wave = wave,
                             .target = target,
                             .scratch = scratch,
                             .counters = &wave->workers[worker].counters,
                             .tile = tile,
                             .layer = number / tiles,
                             .x = tile_x * RHW_TILE,
                             .y = tile_y * RHW_TILE,
                             .width = min_int(target->width - tile_x * RHW_TILE, RHW_TILE),
                             .height = min_int(target->height - tile_y * RHW_TILE, RHW_TILE),
                             .area = area_of_tile(target, tile_x * RHW_TILE, tile_y * RHW_TILE),
                             .samples = target->pattern->count,
                             .explained = pass->explained.ask.fragment && pass->explained.tile == number
                                              ? &pass->explained
                                              : NULL};
    if (work.area.x0 >= work.area.x1 || work.area.y0 >= work.area.y1) {
        return;
    }
    const int bins = list_bins(&work);
    if (bins == 0 && !resolves_loaded(&work)) {
        pass_tile_through(&work);
        return;
    }
    if (work.samples == CELL_SAMPLES) {
        set_cell_pixels(work.cell_pixels, target->pattern);
    }
    const struct rhw_counters before = *work.counters;
    load_tile(&work);
    draw_bins(&work, scratch->bins, scratch->bins + bins);
    store_tile(&work);
    if (pass->tile_reports) {
        report(&work, &pass->tile_reports[number], bins, &before);
    }
}
