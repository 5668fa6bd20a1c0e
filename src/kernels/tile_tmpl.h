// SPDX-License-Identifier: MIT
// One tile: load or clear, draw the triangles binned for it in submission order, store.
// Template: compiled once per instruction set.

#include "small_tmpl.h"

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
                             .y = tile_y * RHW_TILE,
                             .all_full = true};
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
