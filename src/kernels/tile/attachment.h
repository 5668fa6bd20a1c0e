// SPDX-License-Identifier: MIT
// A tile's part of an attachment is loaded or cleared before the tile is drawn, and stored when it is done. Each sample
// of a pixel has a tile of its own in the scratch, and texels of its own in memory. What samples are resolved into is
// written by resolve.h.
#ifndef RHW_ATTACHMENT_H
#define RHW_ATTACHMENT_H

#include "kernels/texel/texel_codec.h"
#include "kernels/tile_work.h"

static enum rhw_load load_of(const struct rhw_wave *wave, const struct rhw_attachment *attachment)
{
    return wave->is_first || attachment->is_left_out ? attachment->load : RHW_LOAD_LOAD;
}

static bool is_stored(const struct rhw_wave *wave, const struct rhw_attachment *attachment)
{
    const bool ends = attachment->store == RHW_STORE_DISCARD || attachment->loads_resolved;
    return attachment->target && !attachment->is_read_only && !(wave->is_last && ends);
}

static void fill_bytes(unsigned char *to, const unsigned char pattern[RHW_CLEAR_BYTES], size_t bytes)
{
    const i32x8 vector = i32x8_load(pattern);
    size_t i = 0;
    for (; i + sizeof vector <= bytes; i += sizeof vector) {
        i32x8_store(to + i, vector);
    }
    for (; i < bytes; i++) {
        to[i] = pattern[i % RHW_CLEAR_BYTES];
    }
}

// Copy a row. Rows are short: a call of memcpy for each would cost as much as the copy.
static void copy_row(unsigned char *to, const unsigned char *from, size_t bytes)
{
    size_t i = 0;
    for (; i + 32 <= bytes; i += 32) {
        i32x8_store(to + i, i32x8_load(from + i));
    }
    for (; i < bytes; i++) {
        to[i] = from[i];
    }
}

// The tile's rows in memory.
struct memory_rows {
    unsigned char *first;
    size_t pitch;
};

// Return the tile's rows of a level. `layer` is the slice of the level that is the pass's first layer.
static struct memory_rows rows_of_level(const struct tile_work *work, const struct rhw_attachment *attachment,
                                        const struct rhw_mip *mip, int layer)
{
    return (struct memory_rows){rhw_mip_slice(mip, layer + work->layer) + (size_t)work->y * mip->row_pitch +
                                    (size_t)work->x * attachment->texel_size,
                                mip->row_pitch};
}

static struct memory_rows rows_of_resolve(const struct tile_work *work,
                                          const struct rhw_attachment *attachment)
{
    return rows_of_level(work, attachment, attachment->resolve, attachment->layer);
}

// Return the rows of a sample of the attachment's target. A texture that keeps samples between waves has only the
// layers of the pass.
static struct memory_rows rows_of_target(const struct tile_work *work,
                                         const struct rhw_attachment *attachment, int sample)
{
    const int layer = attachment->loads_resolved ? 0 : attachment->layer;
    struct memory_rows rows = rows_of_level(work, attachment, attachment->target, layer);
    rows.first += (size_t)sample * attachment->sample_stride;
    return rows;
}

// Return the rows that are loaded for a sample.
static struct memory_rows loaded_rows(const struct tile_work *work, const struct rhw_attachment *attachment,
                                      int sample)
{
    return attachment->loads_resolved && (work->wave->is_first || attachment->is_read_only)
               ? rows_of_resolve(work, attachment)
               : rows_of_target(work, attachment, sample);
}

// Load an attachment into `tile`, which has the attachment's texels of the sample in the scratch, RHW_TILE texels per
// row.
static void load_attachment(const struct tile_work *work, const struct rhw_attachment *attachment, int sample,
                            unsigned char *tile)
{
    const size_t size = attachment->texel_size;
    if (load_of(work->wave, attachment) != RHW_LOAD_LOAD) {
        fill_bytes(tile, attachment->clear, RHW_TILE * RHW_TILE * size);
        return;
    }
    const struct memory_rows rows = loaded_rows(work, attachment, sample);
    const struct tile_rect *const area = &work->area;
    const size_t first = (size_t)area->x0 * size, bytes = (size_t)(area->x1 - area->x0) * size;
    for (int y = area->y0; y < area->y1; y++) {
        copy_row(tile + (size_t)y * RHW_TILE * size + first, rows.first + (size_t)y * rows.pitch + first,
                 bytes);
    }
}

static void soil(const struct tile_work *work, struct rhw_clean_tiles *clean)
{
    if (clean) {
        clean->is_clean[work->tile] = false;
    }
}

// Write one sample of the tile.
static void write_rows(const struct tile_work *work, struct memory_rows rows, const unsigned char *tile,
                       size_t size)
{
    const struct tile_rect *const area = &work->area;
    const size_t first = (size_t)area->x0 * size, bytes = (size_t)(area->x1 - area->x0) * size;
    for (int y = area->y0; y < area->y1; y++) {
        copy_row(rows.first + (size_t)y * rows.pitch + first, tile + (size_t)y * RHW_TILE * size + first,
                 bytes);
    }
}

static void store_attachment(const struct tile_work *work, const struct rhw_attachment *attachment,
                             int sample, const unsigned char *tile)
{
    const size_t size = attachment->texel_size;
    if (!is_stored(work->wave, attachment)) {
        return;
    }
    soil(work, attachment->clean);
    write_rows(work, rows_of_target(work, attachment, sample), tile, size);
}

// Depth and stencil ------------------------------------------------------------------------------------

// Return a bit for each of the pixels x .. x + 7 that lies in the area. At least one does.
static unsigned area_lanes(const struct tile_rect *area, int x)
{
    const int first = area->x0 > x ? area->x0 - x : 0, end = area->x1 - x < 8 ? area->x1 - x : 8;
    return (1u << end) - (1u << first);
}

// Load depth. In the tile depth is float; if memory has steps of a UNORM format, it is converted on the way.
static void load_depth_steps(const struct tile_work *work, int sample, float *tile)
{
    const struct rhw_attachment *const depth = &work->target->depth;
    const struct rhw_format_info *const info = rhw_format_info(depth->format);
    if (load_of(work->wave, depth) != RHW_LOAD_LOAD) {
        struct raw_texels raw = {{i32x8_splat(0)}};
        load_texel_row(info->size, depth->clear, &raw);
        f32x8 value[4];
        decode_texels(info, &raw, value);
        for (int i = 0; i < RHW_TILE * RHW_TILE; i += 8) {
            f32x8_store(tile + i, value[0]);
        }
        return;
    }
    const struct memory_rows rows = loaded_rows(work, depth, sample);
    for (int y = work->area.y0; y < work->area.y1; y++) {
        // Rows are padded to whole vectors.
        for (int x = work->area.x0 & -8; x < work->area.x1; x += 8) {
            struct raw_texels raw;
            f32x8 value[4];
            load_texel_row(info->size, rows.first + (size_t)y * rows.pitch + (size_t)x * info->size, &raw);
            decode_texels(info, &raw, value);
            f32x8_store(tile + y * RHW_TILE + x, value[0]);
        }
    }
}

// Write depth as texels that have steps of a UNORM format.
static void write_depth_steps(const struct tile_work *work, struct memory_rows rows, const float *tile)
{
    const struct rhw_format_info *const info = rhw_format_info(work->target->depth.format);
    for (int y = work->area.y0; y < work->area.y1; y++) {
        for (int x = work->area.x0 & -8; x < work->area.x1; x += 8) {
            const i32x8 mask = i32x8_from_bits(area_lanes(&work->area, x));
            const f32x8 value[4] = {f32x8_load(tile + y * RHW_TILE + x)};
            struct raw_texels raw;
            encode_texels(info, value, &raw);
            store_texel_row(info->size, &raw, mask,
                            rows.first + (size_t)y * rows.pitch + (size_t)x * info->size);
        }
    }
}

static void store_depth_steps(const struct tile_work *work, int sample, const float *tile)
{
    const struct rhw_attachment *const depth = &work->target->depth;
    if (is_stored(work->wave, depth)) {
        soil(work, depth->clean);
        write_depth_steps(work, rows_of_target(work, depth, sample), tile);
    }
}

static void load_depth_stencil(const struct tile_work *work, int sample)
{
    struct tile_depth *const tile = depth_of_sample(work->scratch, sample);
    if (work->target->depth_steps != 0) {
        load_depth_steps(work, sample, tile->texels);
    } else if (work->target->has_depth) {
        load_attachment(work, &work->target->depth, sample, (unsigned char *)tile->texels);
    }
    if (work->target->has_stencil) {
        load_attachment(work, &work->target->stencil, sample, tile->stencil);
    }
}

static void store_depth_stencil(const struct tile_work *work, int sample)
{
    const struct tile_depth *const tile = depth_of_sample(work->scratch, sample);
    if (work->target->depth_steps != 0) {
        store_depth_steps(work, sample, tile->texels);
    } else if (work->target->has_depth) {
        store_attachment(work, &work->target->depth, sample, (const unsigned char *)tile->texels);
    }
    if (work->target->has_stencil) {
        store_attachment(work, &work->target->stencil, sample, tile->stencil);
    }
}

// Tiles without triangles ------------------------------------------------------------------------------

// Write the clear value into the tile's rows of a texture.
static void clear_rows(const struct tile_work *work, struct memory_rows rows, size_t size,
                       const unsigned char clear[RHW_CLEAR_BYTES])
{
    const struct tile_rect *const area = &work->area;
    for (int y = area->y0; y < area->y1; y++) {
        fill_bytes(rows.first + (size_t)y * rows.pitch + (size_t)area->x0 * size, clear,
                   (size_t)(area->x1 - area->x0) * size);
    }
}

// Return true if the record says that the tile in the texture holds the clear value already. From now on the record
// says so, unless the render area leaves out some of the tile.
static bool is_clean(const struct tile_work *work, struct rhw_clean_tiles *clean)
{
    bool *const state = clean ? &clean->is_clean[work->tile] : NULL;
    const bool was = state && *state;
    if (state) {
        *state = was || (work->area.x1 - work->area.x0 == work->width &&
                         work->area.y1 - work->area.y0 == work->height);
    }
    return was;
}

// Pass an attachment of a tile without triangles through. Contents that would be loaded and stored unchanged are left
// alone, and so are clean ones; a tile that has to be cleared is cleared in its target.
static void pass_through(const struct tile_work *work, const struct rhw_attachment *attachment)
{
    if (load_of(work->wave, attachment) == RHW_LOAD_LOAD) {
        return;
    }
    if (is_stored(work->wave, attachment) && !is_clean(work, attachment->clean)) {
        for (int sample = 0; sample < work->samples; sample++) {
            clear_rows(work, rows_of_target(work, attachment, sample), attachment->texel_size,
                       attachment->clear);
        }
    }
    if (attachment->resolves && work->wave->is_last && !is_clean(work, attachment->resolve_clean)) {
        clear_rows(work, rows_of_resolve(work, attachment), attachment->texel_size, attachment->clear);
    }
}

#endif
