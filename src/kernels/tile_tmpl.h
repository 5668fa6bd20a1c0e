// SPDX-License-Identifier: MIT
// One tile: load or clear, draw the triangles binned for it in submission order, store.
// Template: compiled once per instruction set.

#include "coverage_tmpl.h"
#include "shade_tmpl.h"

// Tests depth of the block's pixels in `mask`, early; returns those that pass. `compare` and `write` are
// constants where a call names them.
RHW_INLINE uint64_t test_block(const struct tile_work *work, const struct planes *planes,
                               const struct block_planes *block, int x, int y, uint64_t mask,
                               enum rhw_compare compare, bool write)
{
    float *const stored = stored_depth(work, x, y);
    uint64_t passed = 0;
    while (mask != 0) {
        const int shift = __builtin_ctzll(mask) & 56, row = shift / 8;
        float *const texels = stored + row * RHW_TILE;
        const f8 z = depth_row(planes, block, row), old = f8_load(texels);
        const i8 pass = i8_from_bits((unsigned)(mask >> shift) & 0xff) & depth_passes(compare, z, old);
        if (write) {
            f8_store(texels, f8_select(pass, z, old));
        }
        passed |= (uint64_t)i8_sign_bits(pass) << shift;
        mask &= ~((uint64_t)0xff << shift);
    }
    return passed;
}

// The same on any road but the commonest, which is in draw_block: keeps depth for the fragments, clamps it.
static uint64_t depth_block(const struct tile_work *work, const struct triangle_work *triangle,
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
        if (work->depth_mode == DEPTH_EARLY) {
            bits = i8_sign_bits(depth_test_and_write(work, x, y + row, z[row], i8_from_bits(bits)));
        } else if (work->depth_mode == DEPTH_EARLY_REJECT) {
            bits &= i8_sign_bits(depth_passes(work->pipeline->def.depth_compare, z[row],
                                              f8_load(stored_depth(work, x, y + row))));
        }
        passed |= (uint64_t)bits << (8 * row);
    }
    return passed;
}

// A block: depth first, then what survives is collected for shading.
static void draw_block(struct tile_work *work, struct triangle_work *triangle, int x, int y, uint64_t mask)
{
    const struct planes *const planes = &triangle->planes;
    const struct rhw_pipeline_def *const def = &work->pipeline->def;
    const struct block_place at = {d8_from_i8(i8_splat(work->x + x - planes->anchor_x) + rhw_lane_index),
                                   d8_from_i8(i8_splat(work->y + y - planes->anchor_y) + rhw_lane_index)};
    const bool is_cut = triangle->t->flags & RHW_TRIANGLE_POLYGON && block_is_cut(planes, &at);
    struct block_planes block;
    f8 z[RHW_BLOCK];
    if (work->needs_depth) {
        block_depth(&block, planes, &at);
        if (work->keeps_depth || triangle->t->flags & RHW_TRIANGLE_CLAMP) {
            mask = depth_block(work, triangle, &block, &at, x, y, mask, is_cut, z);
        } else if (def->depth_compare == RHW_COMPARE_LESS && def->depth_write) {
            mask = test_block(work, planes, &block, x, y, mask, RHW_COMPARE_LESS, true);
        } else {
            mask = test_block(work, planes, &block, x, y, mask, def->depth_compare, def->depth_write);
        }
    }
    if (mask == 0 || !work->shades) {
        return;
    }
    if (!triangle->ready) {
        prepare_values(work, triangle);
    }
    block_weights(&block, planes, &at);
    if (work->plain && !is_cut) {
        add_rows(work, triangle, &block, &at, x, y, mask, z, true, false);
    } else {
        block_screen_weights(&block, planes, &at);
        add_rows(work, triangle, &block, &at, x, y, mask, z, false, is_cut);
    }
}

static void setup_planes(const struct tile_work *work, struct triangle_work *triangle)
{
    for (int i = 0; i < 3; i++) {
        triangle->v[i] = record_at(triangle->segment, triangle->t->vertex[i]);
    }
    if (triangle->t->flags & RHW_TRIANGLE_UNSNAPPED) {
        planes_homogeneous(&triangle->planes, work->state, triangle->v);
    } else {
        planes_snapped(&triangle->planes, work->state, triangle->t, triangle->v);
    }
}

static void draw_triangle(struct tile_work *work, const struct rhw_chunk *chunk, const struct rhw_triangle *t)
{
    struct triangle_work triangle;
    triangle.segment = &chunk->segments[t->segment];
    triangle.t = t;
    triangle.ready = false;
    triangle.provoking = NULL;
    if (triangle.segment->draw != work->draw) {
        set_draw(work, triangle.segment->draw);
    }
    // In the tile, and within what was covered.
    const int x0 = max_int(t->x0 - work->x, 0), x1 = min_int(t->x1 - work->x, RHW_TILE);
    const int y0 = max_int(t->y0 - work->y, 0), y1 = min_int(t->y1 - work->y, RHW_TILE);
    struct coverage coverage;
    coverage_setup(&coverage, chunk, t, work->x, work->y);
    if (coverage.count == 0) {
        return;
    }
    bool planes_ready = false;
    for (int y = y0 & -RHW_BLOCK; y < y1; y += RHW_BLOCK) {
        const int row0 = max_int(y0 - y, 0), row1 = min_int(y1 - y, RHW_BLOCK);
        for (int x = x0 & -RHW_BLOCK; x < x1; x += RHW_BLOCK) {
            const uint64_t mask =
                coverage_mask(&coverage, x, y, row0, row1) & rect_mask(x, y, x0, y0, x1, y1);
            if (mask == 0) {
                continue;
            }
            if (!planes_ready) {
                setup_planes(work, &triangle);
                planes_ready = true;
            }
            draw_block(work, &triangle, x, y, mask);
        }
    }
}

static void fill_texels(unsigned char *texels, const unsigned char *texel, size_t size)
{
    memcpy(texels, texel, size);
    for (size_t done = size; done < RHW_TILE * RHW_TILE * size; done *= 2) {
        const size_t all = RHW_TILE * RHW_TILE * size;
        memcpy(texels + done, texels, done < all - done ? done : all - done);
    }
}

// `tile`: the attachment's storage in the scratch, RHW_TILE texels per row.
static void load_attachment(const struct tile_work *work, const struct rhw_attachment *attachment,
                            unsigned char *tile, int width, int height)
{
    static const unsigned char zero[16] = {0};
    const size_t size = attachment->texel_size;
    const enum rhw_load load = work->pass->first_wave ? attachment->load : RHW_LOAD_LOAD;
    if (load != RHW_LOAD_LOAD) {
        // What DISCARD leaves is undefined to the user and still the same bytes on every run.
        fill_texels(tile, load == RHW_LOAD_CLEAR ? attachment->clear : zero, size);
        return;
    }
    const struct rhw_mip *const mip = attachment->target;
    for (int y = 0; y < height; y++) {
        const unsigned char *const from =
            mip->texels + (size_t)(work->y + y) * mip->row_pitch + (size_t)work->x * size;
        memcpy(tile + (size_t)y * RHW_TILE * size, from, (size_t)width * size);
    }
}

static void store_attachment(const struct tile_work *work, const struct rhw_attachment *attachment,
                             const unsigned char *tile, int width, int height)
{
    const struct rhw_mip *const mip = attachment->target;
    const size_t size = attachment->texel_size;
    if (!mip || (work->pass->last_wave && attachment->store == RHW_STORE_DISCARD)) {
        return;
    }
    for (int y = 0; y < height; y++) {
        unsigned char *const to =
            mip->texels + (size_t)(work->y + y) * mip->row_pitch + (size_t)work->x * size;
        memcpy(to, tile + (size_t)y * RHW_TILE * size, (size_t)width * size);
    }
}

// The triangles of a bin lie anywhere in their chunk: ask for what is drawn some triangles later. Without
// this, a mesh in random order spends two thirds of its time waiting here.
static void prefetch(const struct rhw_chunk *chunk, uint32_t e, uint32_t end)
{
    enum { RECORDS_AHEAD = 8, VERTICES_AHEAD = 3 };
    if (e + RECORDS_AHEAD < end) {
        __builtin_prefetch(&chunk->triangles[chunk->entries[e + RECORDS_AHEAD]]);
    }
    if (e + VERTICES_AHEAD < end) {
        const struct rhw_triangle *const t = &chunk->triangles[chunk->entries[e + VERTICES_AHEAD]];
        for (int i = 0; i < 3; i++) {
            __builtin_prefetch(record_at(&chunk->segments[t->segment], t->vertex[i]));
        }
    }
}

static void run_tile(struct rhw_pass_state *pass, int tile, int worker)
{
    const int tile_x = tile % pass->tiles_x, tile_y = tile / pass->tiles_x;
    struct rhw_tile_scratch *const scratch = pass->workers[worker].tile;
    struct tile_work work = {.pass = pass,
                             .scratch = scratch,
                             .counters = &pass->workers[worker].counters,
                             .x = tile_x * RHW_TILE,
                             .y = tile_y * RHW_TILE};
    const int width = min_int(pass->width - work.x, RHW_TILE),
              height = min_int(pass->height - work.y, RHW_TILE);
    for (int i = 0; i < pass->color_count; i++) {
        load_attachment(&work, &pass->colors[i], scratch->color[i], width, height);
    }
    if (pass->has_depth) {
        load_attachment(&work, &pass->depth, (unsigned char *)scratch->depth, width, height);
    }
    for (int i = 0; i < pass->chunk_count; i++) {
        const struct rhw_chunk *const chunk = &pass->chunks[i];
        if (tile_x < chunk->tile_x0 || tile_x >= chunk->tile_x1 || tile_y < chunk->tile_y0 ||
            tile_y >= chunk->tile_y1) {
            continue;
        }
        const int bin =
            (tile_y - chunk->tile_y0) * (chunk->tile_x1 - chunk->tile_x0) + tile_x - chunk->tile_x0;
        const uint32_t end = chunk->offsets[bin + 1];
        for (uint32_t e = chunk->offsets[bin]; e < end; e++) {
            prefetch(chunk, e, end);
            draw_triangle(&work, chunk, &chunk->triangles[chunk->entries[e]]);
        }
    }
    flush(&work);
    for (int i = 0; i < pass->color_count; i++) {
        store_attachment(&work, &pass->colors[i], scratch->color[i], width, height);
    }
    if (pass->has_depth) {
        store_attachment(&work, &pass->depth, (const unsigned char *)scratch->depth, width, height);
    }
}
