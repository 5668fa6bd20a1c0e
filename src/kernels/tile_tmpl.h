// SPDX-License-Identifier: MIT
// One tile: load or clear, draw the triangles binned for it in submission order, store.
// Template: compiled once per instruction set.

#include "small_tmpl.h"

// What a clear leaves, or the lack of a load: that is undefined to the user and still the same bytes on every run.
static const unsigned char *clear_texel(const struct rhw_attachment *attachment)
{
    static const unsigned char zero[16] = {0};
    return attachment->load == RHW_LOAD_CLEAR ? attachment->clear : zero;
}

static enum rhw_load load_of(const struct rhw_pass_state *pass, const struct rhw_attachment *attachment)
{
    return pass->first_wave ? attachment->load : RHW_LOAD_LOAD;
}

static bool is_stored(const struct rhw_pass_state *pass, const struct rhw_attachment *attachment)
{
    return attachment->target && !(pass->last_wave && attachment->store == RHW_STORE_DISCARD);
}

static void fill_texels(unsigned char *texels, const unsigned char *texel, size_t size, size_t count)
{
    unsigned char pattern[32]; // every texel size is a power of two up to 16
    for (size_t i = 0; i < sizeof pattern; i += size) {
        memcpy(pattern + i, texel, size);
    }
    const i8 vector = i8_load(pattern);
    size_t bytes = count * size;
    for (; bytes >= sizeof pattern; bytes -= sizeof pattern, texels += sizeof pattern) {
        i8_store(texels, vector);
    }
    memcpy(texels, pattern, bytes);
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
                            unsigned char *tile, int width, int height)
{
    const size_t size = attachment->texel_size;
    if (load_of(work->pass, attachment) != RHW_LOAD_LOAD) {
        fill_texels(tile, clear_texel(attachment), size, RHW_TILE * RHW_TILE);
        return;
    }
    for (int y = 0; y < height; y++) {
        copy_row(tile + (size_t)y * RHW_TILE * size, target_row(work, attachment, y), (size_t)width * size);
    }
}

static void store_attachment(const struct tile_work *work, const struct rhw_attachment *attachment,
                             const unsigned char *tile, int width, int height)
{
    const size_t size = attachment->texel_size;
    if (!is_stored(work->pass, attachment)) {
        return;
    }
    for (int y = 0; y < height; y++) {
        copy_row(target_row(work, attachment, y), tile + (size_t)y * RHW_TILE * size, (size_t)width * size);
    }
}

// A tile without triangles: what would be loaded and stored unchanged is left alone, what is cleared goes straight to
// its target.
static void pass_through(const struct tile_work *work, const struct rhw_attachment *attachment, int width,
                         int height)
{
    if (!is_stored(work->pass, attachment) || load_of(work->pass, attachment) == RHW_LOAD_LOAD) {
        return;
    }
    for (int y = 0; y < height; y++) {
        fill_texels(target_row(work, attachment, y), clear_texel(attachment), attachment->texel_size,
                    (size_t)width);
    }
}

// The triangles that a chunk has for a tile: entries[first] .. entries[end − 1].
struct bin {
    uint32_t first, end;
};

static struct bin bin_of(const struct rhw_chunk *chunk, int tile_x, int tile_y)
{
    if (tile_x < chunk->tile_x0 || tile_x >= chunk->tile_x1 || tile_y < chunk->tile_y0 ||
        tile_y >= chunk->tile_y1) {
        return (struct bin){0, 0};
    }
    const int i = (tile_y - chunk->tile_y0) * (chunk->tile_x1 - chunk->tile_x0) + tile_x - chunk->tile_x0;
    return (struct bin){chunk->offsets[i], chunk->offsets[i + 1]};
}

// The triangles of a bin lie anywhere in their chunk: ask for what is drawn some triangles later. Without
// this, a mesh in random order spends two thirds of its time waiting here.
enum { RECORDS_AHEAD = 8, VERTICES_AHEAD = 4 };

static void prefetch_record(const struct rhw_chunk *chunk, uint32_t e, uint32_t end)
{
    if (e < end) {
        __builtin_prefetch(&chunk->triangles[chunk->entries[e]]);
    }
}

static void prefetch_vertices(const struct rhw_chunk *chunk, uint32_t e, uint32_t end)
{
    if (e < end) {
        const struct rhw_triangle *const t = &chunk->triangles[chunk->entries[e]];
        for (int i = 0; i < 3; i++) {
            __builtin_prefetch(record_at(&chunk->segments[t->segment], t->vertex[i]));
        }
    }
}

static void draw_bin(struct tile_work *work, const struct rhw_chunk *chunk, struct bin bin)
{
    for (uint32_t e = bin.first; e < bin.first + RECORDS_AHEAD; e++) {
        prefetch_record(chunk, e, bin.end);
    }
    for (uint32_t e = bin.first; e < bin.first + VERTICES_AHEAD; e++) {
        prefetch_vertices(chunk, e, bin.end);
    }
    for (uint32_t e = bin.first; e < bin.end; e++) {
        prefetch_record(chunk, e + RECORDS_AHEAD, bin.end);
        prefetch_vertices(chunk, e + VERTICES_AHEAD, bin.end);
        draw_triangle(work, chunk, &chunk->triangles[chunk->entries[e]]);
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
    bool loaded = false;
    for (int i = 0; i < pass->chunk_count; i++) {
        const struct bin bin = bin_of(&pass->chunks[i], tile_x, tile_y);
        if (bin.first == bin.end) {
            continue;
        }
        for (int t = 0; t < pass->color_count && !loaded; t++) {
            load_attachment(&work, &pass->colors[t], scratch->color[t], width, height);
        }
        if (pass->has_depth && !loaded) {
            load_attachment(&work, &pass->depth, (unsigned char *)scratch->depth, width, height);
        }
        loaded = true;
        draw_bin(&work, &pass->chunks[i], bin);
    }
    flush(&work);
    for (int t = 0; t < pass->color_count; t++) {
        if (loaded) {
            store_attachment(&work, &pass->colors[t], scratch->color[t], width, height);
        } else {
            pass_through(&work, &pass->colors[t], width, height);
        }
    }
    if (pass->has_depth && loaded) {
        store_attachment(&work, &pass->depth, (const unsigned char *)scratch->depth, width, height);
    } else if (pass->has_depth) {
        pass_through(&work, &pass->depth, width, height);
    }
}
