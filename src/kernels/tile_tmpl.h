// SPDX-License-Identifier: MIT
// One tile: load or clear, draw the triangles binned for it in submission order, store.
// Template: compiled once per instruction set.

#include "coverage_tmpl.h"
#include "shade_tmpl.h"

// A block: depth of 8 rows, then what survives is collected for shading.
static void draw_block(struct tile_work *work, struct triangle_work *triangle, int x, int y, uint64_t mask)
{
    const struct planes *const planes = &triangle->planes;
    const bool clamp = triangle->t->flags & RHW_TRIANGLE_CLAMP, shades = work->shades;
    const bool needs_depth =
        work->depth_mode != DEPTH_NONE || work->pipeline->def.program.uses & (RHW_USE_COORD | RHW_USE_DEPTH);
    const struct block_place at = {d8_from_i8(i8_splat(work->x + x - planes->anchor_x) + rhw_lane_index),
                                   d8_from_i8(i8_splat(work->y + y - planes->anchor_y) + rhw_lane_index)};
    struct block_planes block;
    bool weights_ready = false;
    block.z.column = d8_splat(0);
    if (needs_depth) {
        block_depth(&block, planes, &at);
    }
    for (; mask != 0; mask &= ~((uint64_t)0xff << (__builtin_ctzll(mask) & 56))) {
        const int row = __builtin_ctzll(mask) / 8;
        unsigned bits = (unsigned)(mask >> (8 * row)) & 0xff;
        f8 z = f8_splat(0);
        if (needs_depth) {
            z = depth_row(planes, &block, row);
            if (clamp) {
                z = viewport_clamp(work->state, z);
            }
        }
        if (work->depth_mode == DEPTH_EARLY) {
            bits = i8_sign_bits(depth_test_and_write(work, x, y + row, z, i8_from_bits(bits)));
        } else if (work->depth_mode == DEPTH_EARLY_REJECT) {
            bits &= i8_sign_bits(
                depth_passes(work->pipeline->def.depth_compare, z, f8_load(stored_depth(work, x, y + row))));
        }
        if (bits == 0 || !shades) {
            continue;
        }
        if (!weights_ready) {
            weights_ready = true;
            block_weights(&block, planes, &at);
            if (!work->plain) {
                block_screen_weights(&block, planes, &at);
            }
            if (!triangle->ready) {
                prepare_values(work, triangle);
            }
        }
        add_group(work, triangle, &block, &at, row, (struct rhw_group_place){x, y + row, bits}, z);
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
        planes_snapped(&triangle->planes, triangle->t, triangle->v);
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
            const uint64_t mask = coverage_mask(&coverage, x, y, row0, row1) & rect_mask(x, y, x0, y0, x1, y1);
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
static void load_attachment(const struct tile_work *work, const struct rhw_attachment *attachment, unsigned char *tile,
                            int width, int height)
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
        unsigned char *const to = mip->texels + (size_t)(work->y + y) * mip->row_pitch + (size_t)work->x * size;
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
    const int width = min_int(pass->width - work.x, RHW_TILE), height = min_int(pass->height - work.y, RHW_TILE);
    for (int i = 0; i < pass->color_count; i++) {
        load_attachment(&work, &pass->colors[i], scratch->color[i], width, height);
    }
    if (pass->has_depth) {
        load_attachment(&work, &pass->depth, (unsigned char *)scratch->depth, width, height);
    }
    for (int i = 0; i < pass->chunk_count; i++) {
        const struct rhw_chunk *const chunk = &pass->chunks[i];
        if (tile_x < chunk->tile_x0 || tile_x >= chunk->tile_x1 || tile_y < chunk->tile_y0 || tile_y >= chunk->tile_y1) {
            continue;
        }
        const int bin = (tile_y - chunk->tile_y0) * (chunk->tile_x1 - chunk->tile_x0) + tile_x - chunk->tile_x0;
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
