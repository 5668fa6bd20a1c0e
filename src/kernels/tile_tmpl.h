// SPDX-License-Identifier: MIT
// One tile: load or clear, draw the triangles binned for it in submission order, store.
// Template: compiled once per instruction set.

#include "small_tmpl.h"

static enum rhw_load load_of(const struct rhw_pass_state *pass, const struct rhw_attachment *attachment)
{
    return pass->first_wave ? attachment->load : RHW_LOAD_LOAD;
}

static bool is_stored(const struct rhw_pass_state *pass, const struct rhw_attachment *attachment)
{
    return attachment->target && !(pass->last_wave && attachment->store == RHW_STORE_DISCARD);
}

static void fill_bytes(unsigned char *to, const unsigned char pattern[RHW_CLEAR_BYTES], size_t bytes)
{
    const i8 vector = i8_load(pattern);
    size_t i = 0;
    for (; i + sizeof vector <= bytes; i += sizeof vector) {
        i8_store(to + i, vector);
    }
    for (; i < bytes; i++) {
        to[i] = pattern[i % RHW_CLEAR_BYTES];
    }
}

// Rows are short: a call of memcpy for each would cost as much as the copy.
static void copy_row(unsigned char *to, const unsigned char *from, size_t bytes)
{
    size_t i = 0;
    for (; i + 32 <= bytes; i += 32) {
        i8_store(to + i, i8_load(from + i));
    }
    for (; i < bytes; i++) {
        to[i] = from[i];
    }
}

static unsigned char *target_row(const struct tile_work *work, const struct rhw_attachment *attachment, int y)
{
    const struct rhw_mip *const mip = attachment->target;
    return mip->texels + (size_t)(work->y + y) * mip->row_pitch + (size_t)work->x * attachment->texel_size;
}

// `tile`: the attachment's storage in the scratch, RHW_TILE texels per row.
static void load_attachment(const struct tile_work *work, const struct rhw_attachment *attachment,
                            unsigned char *tile)
{
    const size_t size = attachment->texel_size;
    if (load_of(work->pass, attachment) != RHW_LOAD_LOAD) {
        fill_bytes(tile, attachment->clear, RHW_TILE * RHW_TILE * size);
        return;
    }
    for (int y = 0; y < work->height; y++) {
        copy_row(tile + (size_t)y * RHW_TILE * size, target_row(work, attachment, y),
                 (size_t)work->width * size);
    }
}

static void store_attachment(const struct tile_work *work, const struct rhw_attachment *attachment,
                             const unsigned char *tile)
{
    const size_t size = attachment->texel_size;
    if (!is_stored(work->pass, attachment)) {
        return;
    }
    if (attachment->clean) {
        attachment->clean->is_clean[work->tile] = false;
    }
    for (int y = 0; y < work->height; y++) {
        copy_row(target_row(work, attachment, y), tile + (size_t)y * RHW_TILE * size,
                 (size_t)work->width * size);
    }
}

// A tile without triangles: what would be loaded and stored unchanged is left alone, and so is what is clean; what else
// is cleared goes straight to its target.
static void pass_through(const struct tile_work *work, const struct rhw_attachment *attachment)
{
    if (!is_stored(work->pass, attachment) || load_of(work->pass, attachment) == RHW_LOAD_LOAD) {
        return;
    }
    if (attachment->clean) {
        bool *const is_clean = &attachment->clean->is_clean[work->tile];
        if (*is_clean) {
            return;
        }
        *is_clean = true;
    }
    for (int y = 0; y < work->height; y++) {
        fill_bytes(target_row(work, attachment, y), attachment->clear,
                   (size_t)work->width * attachment->texel_size);
    }
}

// Lists the bins of the tile that are not empty, in the order of their chunks; returns how many there are.
static int list_bins(const struct tile_work *work)
{
    const int x = work->x / RHW_TILE, y = work->y / RHW_TILE;
    int count = 0;
    for (int n = 0; n < work->pass->chunk_count; n++) {
        const struct rhw_chunk *const chunk = &work->pass->chunks[n];
        if (x < chunk->tile_x0 || x >= chunk->tile_x1 || y < chunk->tile_y0 || y >= chunk->tile_y1) {
            continue;
        }
        const int i = (y - chunk->tile_y0) * (chunk->tile_x1 - chunk->tile_x0) + x - chunk->tile_x0;
        if (chunk->offsets[i] != chunk->offsets[i + 1]) {
            work->scratch->bins[count++] = (struct rhw_bin){chunk, chunk->offsets[i], chunk->offsets[i + 1]};
        }
    }
    return count;
}

static void draw_triangle(struct tile_work *work, const struct rhw_chunk *chunk, const struct batch *batch,
                          int i)
{
    struct triangle_work triangle;
    triangle.t = batch->read->triangle[i];
    triangle.segment = &chunk->segments[triangle.t->segment];
    triangle.planes_ready = triangle.ready = false;
    triangle.provoking = NULL;
    if (triangle.segment->draw != work->draw) {
        set_draw(work, triangle.segment->draw);
    }
    if (work->skips) {
        return;
    }
    if (triangle.t->flags & RHW_TRIANGLE_SMALL) {
        draw_small(work, &triangle, batch, i);
    } else {
        draw_blocks(work, chunk, &triangle, rect_of(work, triangle.t));
    }
}

// Whether what is left of a run is hidden.
static bool is_hidden(const struct tile_work *work)
{
    return work->phase == PHASE_BACKWARDS && work->open_count == 0;
}

static void draw_batch(struct tile_work *work, const struct rhw_chunk *chunk, const struct bin_batch *read)
{
    struct batch batch;
    batch.read = read;
    batch_setup(work, chunk, &batch);
    for (int i = 0; i < read->count && !is_hidden(work); i++) {
        work->hit = false;
        draw_triangle(work, chunk, &batch, i);
        if (work->phase == PHASE_DEPTH && (work->hit || work->skips)) {
            work->scratch->seen[read->number[i] / 8] |= (uint8_t)(1u << read->number[i] % 8);
        }
    }
}

// `number`: of the bin's first triangle among those that are drawn in two phases.
static void draw_bin(struct tile_work *work, const struct rhw_bin *bin, uint32_t number)
{
    struct bin_batch batches[BATCHES_AHEAD + 1];
    struct bin_reader reader = bin_reader(work, bin, number);
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
    const struct rhw_bin *first, *end;
};

// Opens all pixels of the tile.
static void open_all(struct tile_work *work)
{
    for (int y = 0; y < RHW_TILE; y++) {
        work->scratch->open[y] = y < work->height ? ~(uint64_t)0 >> (RHW_TILE - work->width) : 0;
    }
    work->open_count = work->width * work->height;
}

// What waits is tested against the open pixels of its own phase: it is flushed before they change.
static void start_phase(struct tile_work *work, enum phase phase)
{
    flush(work);
    if (phase == PHASE_DEPTH) {
        memset(work->scratch->open, 0, sizeof work->scratch->open);
    } else if (phase == PHASE_BACKWARDS) {
        open_all(work);
    }
    work->draw = NULL;
    work->phase = phase;
    if (phase == PHASE_SHADE && work->hiz_direction != 0) {
        hiz_refresh(work);
    }
}

static void draw_run(struct tile_work *work, struct bin_run run, enum phase phase)
{
    // Triangles, at least, between two looks at the tile's depth, which are taken between bins.
    enum { REFRESH = 16 };
    uint32_t number = 0, looked = 0;
    start_phase(work, phase);
    for (const struct rhw_bin *bin = run.first; bin < run.end; bin++) {
        if (phase == PHASE_DEPTH && number - looked >= REFRESH && work->hiz_direction != 0) {
            hiz_refresh(work);
            looked = number;
        }
        draw_bin(work, bin, number);
        number += bin->end - bin->first;
    }
}

// Pixels that a triangle covers in the tile, at most and about.
static double area_in_tile(const struct tile_work *work, const struct rhw_triangle *t)
{
    const struct tile_rect rect = rect_of(work, t);
    const double rectangle = (rect.x1 - rect.x0) * (rect.y1 - rect.y0);
    if (t->flags & RHW_TRIANGLE_POLYGON) {
        return rectangle / 2;
    }
    const double x1 = t->x_24_8[1] - t->x_24_8[0], y1 = t->y_24_8[1] - t->y_24_8[0];
    const double x2 = t->x_24_8[2] - t->x_24_8[0], y2 = t->y_24_8[2] - t->y_24_8[0];
    return least(absolute(x1 * y2 - x2 * y1) / (2 * RHW_SUBPIXEL * RHW_SUBPIXEL), rectangle);
}

// Whether the triangles of a run lie above each other so much that shading what is hidden, half of which the depth
// test would have stopped, costs more than drawing depth first: judged by the areas of some of them. Measured: depth
// costs 3 ns a pixel and 60 ns a triangle more; shading 9 ns a pixel, with textures 18.
static bool overdraws(const struct tile_work *work, struct bin_run run)
{
    enum { SAMPLES = 64 };
    const double tile_pixels = work->width * work->height;
    const double shading_ns = 9, textured_ns = 18, depth_ns = 3, triangle_ns = 60;
    uint32_t count = 0;
    for (const struct rhw_bin *bin = run.first; bin < run.end; bin++) {
        count += bin->end - bin->first;
    }
    if (count > RHW_DEFERRED_TRIANGLES) {
        return false;
    }
    const uint32_t step = count / SAMPLES + 1;
    uint32_t next = 0; // of the bin under way
    double area = 0;
    for (const struct rhw_bin *bin = run.first; bin < run.end; bin++) {
        for (; next < bin->end - bin->first; next += step) {
            area += step * area_in_tile(work, &bin->chunk->triangles[bin->chunk->entries[bin->first + next]]);
        }
        next -= bin->end - bin->first;
    }
    const struct rhw_draw *const draw = run.first->chunk->segments[0].draw;
    const double pixel_ns = draw->state->pipeline->any_derivatives ? textured_ns : shading_ns;
    return (area - tile_pixels) / 2 * pixel_ns > area * depth_ns + count * triangle_ns;
}

static void draw_deferred(struct tile_work *work, struct bin_run run)
{
    memset(work->scratch->seen, 0, sizeof work->scratch->seen);
    draw_run(work, run, PHASE_DEPTH);
    draw_run(work, run, PHASE_SHADE);
}

// The last triangle first, until nothing of the tile is open.
static void draw_backwards(struct tile_work *work, struct bin_run run)
{
    start_phase(work, PHASE_BACKWARDS);
    const struct rhw_bin *bin = run.end;
    while (bin > run.first && !is_hidden(work)) {
        draw_bin(work, --bin, 0);
    }
}

// From `first` on, those that can be drawn together depth first or backwards, or that cannot; at least one.
static struct bin_run run_from(const struct rhw_bin *first, const struct rhw_bin *end)
{
    struct bin_run run = {first, first + 1};
    while (run.end < end && rhw_hidden_rule_equal(run.end->chunk->hidden, first->chunk->hidden)) {
        run.end++;
    }
    return run;
}

static void draw_bins(struct tile_work *work, const struct rhw_bin *first, const struct rhw_bin *end)
{
    while (first < end) {
        const struct bin_run run = run_from(first, end);
        const enum rhw_hidden_surface hidden = first->chunk->hidden.kind;
        if (hidden == RHW_HIDDEN_BACKWARDS) {
            draw_backwards(work, run);
        } else if (hidden == RHW_HIDDEN_DEPTH_FIRST && overdraws(work, run)) {
            draw_deferred(work, run);
        } else {
            draw_run(work, run, PHASE_ONLY);
        }
        first = run.end;
    }
    flush(work);
}

static void draw_tile(struct rhw_pass_state *pass, int tile, int worker)
{
    const int tile_x = tile % pass->tiles_x, tile_y = tile / pass->tiles_x;
    struct rhw_tile_scratch *const scratch = pass->workers[worker].tile;
    struct tile_work work = {.pass = pass,
                             .scratch = scratch,
                             .counters = &pass->workers[worker].counters,
                             .tile = tile,
                             .x = tile_x * RHW_TILE,
                             .y = tile_y * RHW_TILE,
                             .width = min_int(pass->width - tile_x * RHW_TILE, RHW_TILE),
                             .height = min_int(pass->height - tile_y * RHW_TILE, RHW_TILE),
                             .all_full = true};
    struct rhw_attachment *const depth = pass->has_depth ? &pass->depth : NULL;
    unsigned char *const depth_texels = (unsigned char *)scratch->depth;
    const int bins = list_bins(&work);
    if (bins == 0) {
        for (int i = 0; i < pass->color_count; i++) {
            pass_through(&work, &pass->colors[i]);
        }
        if (depth) {
            pass_through(&work, depth);
        }
        return;
    }
    for (int i = 0; i < pass->color_count; i++) {
        load_attachment(&work, &pass->colors[i], scratch->color[i]);
    }
    if (depth) {
        load_attachment(&work, depth, depth_texels);
    }
    draw_bins(&work, scratch->bins, scratch->bins + bins);
    for (int i = 0; i < pass->color_count; i++) {
        store_attachment(&work, &pass->colors[i], scratch->color[i]);
    }
    if (depth) {
        store_attachment(&work, depth, depth_texels);
    }
}
