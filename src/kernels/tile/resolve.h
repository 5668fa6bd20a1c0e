// SPDX-License-Identifier: MIT
// The samples of a tile become one texel a pixel. In blocks that are not expanded (tile_work.h) the first sample has
// the colour of all.
#ifndef RHW_RESOLVE_H
#define RHW_RESOLVE_H

#include "kernels/fragment/blend.h"
#include "kernels/fragment/expand.h"
#include "kernels/fragment/woven.h"
#include "kernels/texel/resolve_texels.h"
#include "kernels/integer.h"
#include "attachment.h"

static enum rhw_resolve color_mode(const struct rhw_attachment *attachment,
                                   const struct rhw_format_info *info)
{
    const enum rhw_resolve mode =
        attachment->resolve_mode == RHW_RESOLVE_DEFAULT ? RHW_RESOLVE_AVERAGE : attachment->resolve_mode;
    return rhw_format_is_integer(info) ? RHW_RESOLVE_SAMPLE_ZERO : mode;
}

// How the samples of a target are resolved.
struct color_resolve {
    const struct rhw_format_info *info;
    enum rhw_resolve mode;
    bool is_common; // true for the mean of 4 samples of RGBA8
};

// Resolve 8 texels in a row, from `texel` on, in the pixels of `lanes`. Their samples have colours of their own.
static inline void resolve_expanded(const struct tile_work *work, int t, const struct color_resolve *how,
                                    int texel, unsigned lanes, unsigned char *to)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    struct sample_row row;
    i32x8 sample[WOVEN_SAMPLES];
    if (scratch->is_woven) {
        f32x8 woven[WOVEN_SAMPLES];
        load_woven_row(scratch, t, texel, woven);
        memcpy(sample, woven, sizeof sample);
    }
    row.count = work->samples;
    for (int s = 0; s < work->samples && !(scratch->is_woven && how->is_common); s++) {
        row.texels[s] = scratch->is_woven ? (const unsigned char *)&sample[s]
                                          : color_of_sample(scratch, t, s) + (size_t)texel * how->info->size;
        if (how->is_common) {
            sample[s] = i32x8_load(row.texels[s]);
        }
    }
    if (how->is_common) {
        resolve_unorm8(sample, lanes, to);
    } else {
        resolve_row(how->info, how->mode, &row, lanes, to);
    }
}

// Resolve target t.
static void resolve_color(const struct tile_work *work, int t)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    const struct rhw_attachment *const attachment = &work->target->colors[t];
    const struct rhw_format_info *const info = rhw_format_info(attachment->format);
    const enum rhw_resolve mode = color_mode(attachment, info);
    const struct memory_rows rows = rows_of_resolve(work, attachment);
    const struct color_resolve how = {info, mode,
                                      info->codec == RHW_CODEC_UNORM8 && info->size == 4 &&
                                          mode == RHW_RESOLVE_AVERAGE && work->samples == 4};
    soil(work, attachment->resolve_clean);
    const struct tile_rect *const area = &work->area;
    for (int y = area->y0; y < area->y1; y++) {
        for (int x = area->x0 & -RHW_BLOCK; x < area->x1; x += RHW_BLOCK) {
            const int block = y / RHW_BLOCK * HIZ_BLOCKS + x / RHW_BLOCK;
            unsigned char *const row = rows.first + (size_t)y * rows.pitch;
            if (scratch->expanded >> block & 1) {
                resolve_expanded(work, t, &how, y * RHW_TILE + x, area_lanes(area, x),
                                 row + (size_t)x * info->size);
            } else {
                const int first = max_int(x, area->x0), end = min_int(x + RHW_BLOCK, area->x1);
                copy_row(row + (size_t)first * info->size,
                         scratch->color[t] + (size_t)(y * RHW_TILE + first) * info->size,
                         (size_t)(end - first) * info->size);
            }
        }
    }
}

// Make sample 0 of depth what the samples of each pixel are resolved into.
static void resolve_depth_samples(const struct tile_work *work, enum rhw_resolve mode)
{
    struct tile_depth *const first = depth_of_sample(work->scratch, 0);
    for (int i = 0; i < RHW_TILE * RHW_TILE; i += 8) {
        f32x8 value[RHW_MAX_SAMPLES];
        for (int s = 0; s < work->samples; s++) {
            value[s] = f32x8_load(&depth_of_sample(work->scratch, s)->texels[i]);
        }
        // A mean of equal floats may round to another one.
        i32x8 agree = i32x8_splat(-1);
        for (int s = 1; s < work->samples; s++) {
            agree &= rhw_equal(value[s], value[0]);
        }
        f32x8_store(&first->texels[i],
                    f32x8_select(agree, value[0], resolved_value(mode, value, work->samples)));
    }
}

// Make sample 0 of stencil what the samples of each pixel are resolved into, by RHW_RESOLVE_MIN or MAX.
static void resolve_stencil_samples(const struct tile_work *work, enum rhw_resolve mode)
{
    struct tile_depth *const first = depth_of_sample(work->scratch, 0);
    for (int i = 0; i < RHW_TILE * RHW_TILE; i += 8) {
        i32x8 stencil = i32x8_load_bytes(&first->stencil[i]);
        for (int s = 1; s < work->samples; s++) {
            const i32x8 other = i32x8_load_bytes(&depth_of_sample(work->scratch, s)->stencil[i]);
            stencil = mode == RHW_RESOLVE_MIN ? i32x8_min(stencil, other) : i32x8_max(stencil, other);
        }
        const uint64_t bytes = i32x8_to_bytes(stencil);
        memcpy(&first->stencil[i], &bytes, sizeof bytes);
    }
}

// Resolve depth, after its samples were stored.
static void resolve_depth(const struct tile_work *work)
{
    const struct rhw_attachment *const depth = &work->target->depth;
    const struct tile_depth *const first = depth_of_sample(work->scratch, 0);
    const struct memory_rows rows = rows_of_resolve(work, depth);
    if (depth->resolve_mode != RHW_RESOLVE_DEFAULT && depth->resolve_mode != RHW_RESOLVE_SAMPLE_ZERO) {
        resolve_depth_samples(work, depth->resolve_mode);
    }
    soil(work, depth->resolve_clean);
    if (work->target->depth_steps != 0) {
        write_depth_steps(work, rows, first->texels);
    } else {
        write_rows(work, rows, (const unsigned char *)first->texels, sizeof(float));
    }
}

// Resolve stencil, after its samples were stored.
static void resolve_stencil(const struct tile_work *work)
{
    const struct rhw_attachment *const stencil = &work->target->stencil;
    if (stencil->resolve_mode == RHW_RESOLVE_MIN || stencil->resolve_mode == RHW_RESOLVE_MAX) {
        resolve_stencil_samples(work, stencil->resolve_mode);
    }
    write_rows(work, rows_of_resolve(work, stencil), depth_of_sample(work->scratch, 0)->stencil, 1);
}

// Loading and storing with several samples ---------------------------------------------------------------

// Return true if samples are stored, now or for the waves that follow.
static bool stores_samples(const struct rhw_wave *wave)
{
    bool stores = false;
    for (int t = 0; t < wave->target.color_count; t++) {
        stores |= is_stored(wave, &wave->target.colors[t]);
    }
    return stores;
}

// Return true if the tile can be kept woven. It cannot if a sample is explained: an explanation looks into single
// samples, and the general path draws them. It does not pay if fragments are single samples.
static bool can_weave(const struct tile_work *work)
{
    const struct rhw_target *const target = work->target;
    bool has_size = work->samples == WOVEN_SAMPLES;
    for (int t = 0; t < target->color_count; t++) {
        has_size = has_size && target->colors[t].texel_size == WOVEN_SIZE;
    }
    return has_size && !stores_samples(work->wave) && !work->explained && !work->wave->pass->shades_samples &&
           rhw_pass_takes_special_paths(work->wave->pass);
}

static void load_samples(const struct tile_work *work)
{
    const struct rhw_target *const target = work->target;
    bool differ = false; // true if the samples of some colour may differ
    for (int t = 0; t < target->color_count; t++) {
        const struct rhw_attachment *const color = &target->colors[t];
        differ |=
            load_of(work->wave, color) == RHW_LOAD_LOAD && !(color->loads_resolved && work->wave->is_first);
    }
    work->scratch->expanded = differ ? ~(uint64_t)0 : 0;
    work->scratch->is_woven = !differ && can_weave(work);
    for (int t = 0; t < target->color_count; t++) {
        for (int s = 0; s < (differ ? work->samples : 1); s++) {
            load_attachment(work, &target->colors[t], s, color_of_sample(work->scratch, t, s));
        }
    }
    for (int s = 0; s < work->samples; s++) {
        depth_of_sample(work->scratch, s)->direction = 0;
        load_depth_stencil(work, s);
    }
}

static void store_samples(const struct tile_work *work)
{
    const struct rhw_target *const target = work->target;
    const bool stores = stores_samples(work->wave);
    for (int block = 0; block < HIZ_BLOCKS * HIZ_BLOCKS && stores; block++) {
        if (!(work->scratch->expanded >> block & 1)) {
            expand_block(work, block);
        }
    }
    for (int t = 0; t < target->color_count; t++) {
        for (int s = 0; s < work->samples; s++) {
            store_attachment(work, &target->colors[t], s, color_of_sample(work->scratch, t, s));
        }
        if (target->colors[t].resolves && work->wave->is_last) {
            resolve_color(work, t);
        }
    }
    for (int s = 0; s < work->samples; s++) {
        store_depth_stencil(work, s);
    }
    if (target->depth.resolves && work->wave->is_last) {
        resolve_depth(work);
    }
    if (target->stencil.resolves && work->wave->is_last) {
        resolve_stencil(work);
    }
}

// Return true if an attachment wants a tile without triangles to be loaded and stored: to be resolved, or to be there
// for the waves that follow.
static bool wants_tile(const struct tile_work *work, const struct rhw_attachment *attachment)
{
    const struct rhw_wave *const wave = work->wave;
    if (load_of(wave, attachment) != RHW_LOAD_LOAD) {
        return false;
    }
    if (wave->is_first && attachment->loads_resolved) {
        return !wave->is_last && !attachment->is_read_only;
    }
    return attachment->resolves && wave->is_last;
}

// Return true if a tile without triangles has to be loaded and stored, and cannot pass through.
static bool resolves_loaded(const struct tile_work *work)
{
    const struct rhw_target *const target = work->target;
    bool wanted = (target->has_depth && wants_tile(work, &target->depth)) ||
                  (target->has_stencil && wants_tile(work, &target->stencil));
    for (int t = 0; t < target->color_count; t++) {
        wanted |= wants_tile(work, &target->colors[t]);
    }
    return wanted;
}

#endif
