// SPDX-License-Identifier: MIT
// A tile is loaded or cleared, the triangles binned for it are drawn, and the tile is stored. The order in which the
// triangles of a run are drawn is that of hidden_surface.h; the order of runs is that of submission. This file is
// compiled once per instruction set, and RHW_ISA_SUFFIX names the set.
#include "kernel_entries.h"

#include "context/given_up.h"
#include "integer.h"
#include "kernels/tile/depth_bias.h"
#include "kernels/tile/draw_state.h"
#include "kernels/tile/explained_triangle.h"
#include "kernels/tile/resolve.h"
#include "kernels/tile/tile_order.h"
#include "kernels/tile/triangle_path.h"

// Set where the samples of a cell's pixels lie, for all triangles of a tile.
static void set_cell_pixels(struct cell_pixel pixels[CELL * CELL], const struct rhw_sample_pattern *pattern)
{
    for (int n = 0; n < CELL * CELL; n++) {
        for (int s = 0; s < CELL_SAMPLES; s++) {
            pixels[n].dx[s] = n % CELL + from_center(pattern->x_0_8[s]);
            pixels[n].dy[s] = n / CELL + from_center(pattern->y_0_8[s]);
        }
    }
}

// List the bins of the tile that are not empty, in the order of their chunks. Return how many there are.
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

// Keep for the second of two phases the triangles of a run that the first does not draw.
static void skip_run(const struct triangle_run *run)
{
    for (int i = run->first; i < run->end; i++) {
        see_triangle(run->work, run->setup->read->number[i]);
    }
}

// Draw a run on its path.
static void draw_triangles(const struct triangle_run *run, enum triangle_path path)
{
    switch (path) {
    case TRIANGLE_SKIPPED: skip_run(run); break;
    case TRIANGLE_TINY: RHW_ISA_NAME(rhw_draw_tiny)(run); break;
    case TRIANGLE_SMALL: RHW_ISA_NAME(rhw_draw_small)(run); break;
    case TRIANGLE_SPANS: RHW_ISA_NAME(rhw_draw_spans)(run); break;
    case TRIANGLE_LARGE: RHW_ISA_NAME(rhw_draw_large)(run); break;
    case TRIANGLE_TINY_SAMPLES: RHW_ISA_NAME(rhw_draw_tiny_samples)(run); break;
    case TRIANGLE_SMALL_SAMPLES: RHW_ISA_NAME(rhw_draw_small_samples)(run); break;
    case TRIANGLE_LARGE_SAMPLES: RHW_ISA_NAME(rhw_draw_large_samples)(run); break;
    case TRIANGLE_SHAPE: RHW_ISA_NAME(rhw_draw_shape)(run); break;
    case TRIANGLE_STIPPLED_LINE: RHW_ISA_NAME(rhw_draw_stippled_line)(run); break;
    }
}

// Find the tiny triangles of a batch if the draw of its first one has a path for them.
RHW_INLINE void find_tiny(const struct tile_work *work, struct triangle_setup8 *setup)
{
    if (setup->small == 0 || !work->plan.draws_tiny) {
        return;
    }
    if (work->samples == 1) {
        RHW_ISA_NAME(rhw_find_tiny)(setup);
    } else {
        RHW_ISA_NAME(rhw_find_tiny_samples)(setup, work->target->pattern);
    }
}

static void draw_batch(struct tile_work *work, const struct rhw_chunk *chunk, const struct bin_batch *read)
{
    struct triangle_setup8 setup;
    setup_triangles8(&setup, work, chunk, read);
    bias_setup8(&setup, chunk);
    begin_draw(work, draw_of(chunk, &setup, 0));
    find_tiny(work, &setup);
    struct triangle_run run = {work, chunk, &setup, 0, 0};
    while (run.end < read->count && !is_hidden(work)) {
        run.first = run.end;
        begin_draw(work, draw_of(chunk, &setup, run.first));
        const struct path_choice choice = path_of(work, &setup, run.first);
        run.end = end_of_run(chunk, &setup, run.first, choice.alike);
        draw_triangles(&run, choice.path);
    }
}

// Draw a bin. `number` is the number of the bin's first triangle among the triangles that are drawn in two phases.
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

// Return true if the program gives up the pass. A bin has many triangles, so it counts as a call of a shader function.
static bool is_given_up(const struct tile_work *work)
{
    return work->wave->asked && rhw_context_is_given_up_amid(work->wave->asked, work->worker, 1);
}

static void draw_run(struct tile_work *work, struct bin_run run, enum rhw_phase phase)
{
    // The tile's depth in a sample is looked at between bins. At least this number of triangles lies between two looks.
    enum { REFRESH = 16 };
    uint32_t number = 0, looked = 0;
    start_phase(work, phase);
    for (const struct bin *bin = run.first; bin < run.end && !is_given_up(work); bin++) {
        if (phase == RHW_PHASE_DEPTH && number - looked >= REFRESH && work->scratch->depth.direction != 0) {
            refresh_bounds(work);
            looked = number;
        }
        draw_bin(work, bin, number);
        number += bin->end - bin->first;
    }
}

static void draw_depth_first(struct tile_work *work, struct bin_run run)
{
    memset(work->scratch->seen, 0, sizeof work->scratch->seen);
    draw_run(work, run, RHW_PHASE_DEPTH);
    draw_run(work, run, RHW_PHASE_SHADE);
}

// Draw the last triangle first, until nothing of the tile is open.
static void draw_backwards(struct tile_work *work, struct bin_run run)
{
    start_phase(work, RHW_PHASE_BACKWARDS);
    const struct bin *bin = run.end;
    while (bin > run.first && !is_hidden(work) && !is_given_up(work)) {
        draw_bin(work, --bin, 0);
    }
}

static void draw_bins(struct tile_work *work, const struct bin *first, const struct bin *end)
{
    while (first < end) {
        const struct bin_run run = run_from(first, end);
        const enum rhw_tile_order order = choose_order(work, run);
        work->orders |= order;
        switch (order) {
        case RHW_TILE_BACKWARDS: draw_backwards(work, run); break;
        case RHW_TILE_DEPTH_FIRST: draw_depth_first(work, run); break;
        case RHW_TILE_IN_ORDER: draw_run(work, run, RHW_PHASE_ONLY); break;
        }
        first = run.end;
    }
    RHW_ISA_NAME(rhw_flush)(work);
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

// Pass the attachments of a tile without triangles through.
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

// Add the work on a tile to a report. `before` is what the worker had counted before this tile.
static __attribute__((noinline)) void report(const struct tile_work *work, struct rhw_tile_report *to,
                                             int bins, const struct rhw_counters *before)
{
    to->orders |= work->orders;
    to->fragments_shaded += work->counters->fragments - before->fragments;
    to->fragment_groups += work->counters->groups - before->groups;
    for (int i = 0; i < bins; i++) {
        to->triangles += work->scratch->bins[i].end - work->scratch->bins[i].first;
    }
}

// Return the pixels of a tile at (x, y) that lie within the render area.
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
                             .worker = worker,
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
