// SPDX-License-Identifier: MIT
// A tile's part of an attachment: loaded or cleared before the tile is drawn, stored when it is done.
#ifndef RHW_ATTACHMENT_H
#define RHW_ATTACHMENT_H

#include "../tile_work.h"

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
    return rhw_mip_slice(mip, attachment->layer) + (size_t)(work->y + y) * mip->row_pitch +
           (size_t)work->x * attachment->texel_size;
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

#endif
