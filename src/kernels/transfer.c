// SPDX-License-Identifier: MIT
// Regions of textures are made from others: scaled with a filter and converted, or resolved from samples. 8 texels of a
// row are made at a time. What they read along the row was worked out before, once for all rows.
#include "transfer_work.h"

#include "kernel_entries.h"
#include "kernels/texture/texel_fetch.h"
#include "kernels/texel/resolve_texels.h"

// A task's rows, of all slices one after the other.
struct band {
    int begin, end;
};

static struct band band_of(int index, int rows, int height, int depth)
{
    const int64_t all = (int64_t)height * depth, begin = (int64_t)index * rows;
    return (struct band){(int)begin, (int)(begin + rows < all ? begin + rows : all)};
}

// Store the first `count` of 8 texels, and touch nothing behind them: the next row may be another thread's.
RHW_INLINE void store_group(size_t size, const struct raw_texels *raw, int count, unsigned char *to)
{
    if (count >= RHW_LANES) {
        store_texel_row(size, raw, i32x8_splat(-1), to);
        return;
    }
    unsigned char group[RHW_LANES * RHW_TEXEL_BYTES] = {0};
    store_texel_row(size, raw, i32x8_splat(-1), group);
    memcpy(to, group, (size_t)count * size);
}

// Scaling ---------------------------------------------------------------------------------------------

static const unsigned char *source_row(const struct rhw_blit_job *job, int y, int z)
{
    return rhw_mip_slice(&job->from, z) + (size_t)y * job->from.row_pitch;
}

// Mix texels of a row at both neighbours along x.
RHW_INLINE void filter_row(const struct rhw_blit_job *job, const unsigned char *row, int x, f32x8 value[4])
{
    const struct rhw_blit_axis *const axis = &job->axis[0];
    const size_t size = job->from_info->size;
    struct raw_texels raw;
    fetch_numbered_texels(size, row, i32x8_load(axis->low + x), &raw);
    decode_texels(job->from_info, &raw, value);
    if (job->is_linear) {
        f32x8 next[4];
        fetch_numbered_texels(size, row, i32x8_load(axis->high + x), &raw);
        decode_texels(job->from_info, &raw, next);
        const f32x8 weight = f32x8_load(axis->weight + x);
        for (int c = 0; c < 4; c++) {
            value[c] = rhw_mix(value[c], next[c], weight);
        }
    }
}

// Mix texels of two rows at both neighbours along x and along y.
RHW_INLINE void filter_slice(const struct rhw_blit_job *job, int x, int y, int z, f32x8 value[4])
{
    const struct rhw_blit_axis *const axis = &job->axis[1];
    filter_row(job, source_row(job, axis->low[y], z), x, value);
    if (job->is_linear) {
        f32x8 next[4];
        filter_row(job, source_row(job, axis->high[y], z), x, next);
        for (int c = 0; c < 4; c++) {
            value[c] = rhw_mix(value[c], next[c], rhw_splat(axis->weight[y]));
        }
    }
}

// Return integers that a channel of a format can hold: those that it cannot become the nearest one.
static f32x8 clamp_integers(const struct rhw_format_info *format, int channel, f32x8 value)
{
    const int bits = format->bits[channel];
    const i32x8 given = (i32x8)value;
    if (bits == 0 || bits == 32) {
        return value;
    }
    if (format->type == RHW_CHANNEL_UINT) {
        const i32x8 most = i32x8_splat((int32_t)(UINT32_C(0xffffffff) >> (32 - bits)));
        const i32x8 above = (i32x8)((u32x8)given > (u32x8)most);
        return (f32x8)((given & ~above) | (most & above));
    }
    const i32x8 most = i32x8_splat((1 << (bits - 1)) - 1);
    return (f32x8)i32x8_max(i32x8_min(given, most), ~most);
}

static void blit_group(const struct rhw_blit_job *job, int x, int y, int z, struct raw_texels *raw)
{
    const struct rhw_blit_axis *const axis = &job->axis[2];
    if (job->is_copied) {
        fetch_numbered_texels(job->from_info->size, source_row(job, job->axis[1].low[y], axis->low[z]),
                              i32x8_load(job->axis[0].low + x), raw);
        return;
    }
    f32x8 value[4];
    filter_slice(job, x, y, axis->low[z], value);
    if (job->has_slice_filter) {
        f32x8 next[4];
        filter_slice(job, x, y, axis->high[z], next);
        for (int c = 0; c < 4; c++) {
            value[c] = rhw_mix(value[c], next[c], rhw_splat(axis->weight[z]));
        }
    }
    const bool is_integer = rhw_format_is_integer(job->to_info);
    for (int c = 0; c < 4; c++) {
        value[c] = is_integer ? clamp_integers(job->to_info, c, value[c]) : canonical_nan(value[c]);
    }
    encode_texels(job->to_info, value, raw);
}

void RHW_ISA_NAME(rhw_blit_band)(const struct rhw_blit_job *job, int index)
{
    const size_t size = job->to_info->size;
    const struct band band = band_of(index, job->band, job->height, job->depth);
    for (int row = band.begin; row < band.end; row++) {
        const int y = row % job->height, z = row / job->height;
        unsigned char *const to = rhw_mip_slice(&job->to, job->z + z) +
                                  (size_t)(job->y + y) * job->to.row_pitch + (size_t)job->x * size;
        for (int x = 0; x < job->width; x += RHW_LANES) {
            struct raw_texels raw = {{{0}, {0}, {0}, {0}}};
            blit_group(job, x, y, z, &raw);
            store_group(size, &raw, job->width - x, to + (size_t)x * size);
        }
    }
}

// Samples ---------------------------------------------------------------------------------------------

// Resolve stencil, which has no codec: its bytes are compared as they are.
static void resolve_stencil(enum rhw_resolve mode, const struct sample_row *row, unsigned char *to)
{
    struct raw_texels raw, other;
    load_texel_row(1, row->texels[0], &raw);
    for (int s = 1; s < row->count && mode >= RHW_RESOLVE_MIN && mode <= RHW_RESOLVE_MAX; s++) {
        load_texel_row(1, row->texels[s], &other);
        raw.word[0] = mode == RHW_RESOLVE_MIN ? i32x8_min(raw.word[0], other.word[0])
                                              : i32x8_max(raw.word[0], other.word[0]);
    }
    store_texel_row(1, &raw, i32x8_splat(-1), to);
}

static void resolve_group(const struct rhw_resolve_job *job, const struct sample_row *row, unsigned char *to)
{
    if (rhw_format_has_role(job->info, RHW_ROLE_STENCIL_TARGET) && job->info->size == 1) {
        resolve_stencil(job->mode, row, to);
    } else {
        resolve_row(job->info, job->mode, row, 0xff, to);
    }
}

// Resolve the last texels of a row by way of a whole group.
static void resolve_rest(const struct rhw_resolve_job *job, const struct sample_row *row, int count,
                         unsigned char *to)
{
    const size_t size = job->info->size;
    unsigned char samples[RHW_MAX_SAMPLES][RHW_LANES * RHW_TEXEL_BYTES],
        resolved[RHW_LANES * RHW_TEXEL_BYTES];
    struct sample_row rest = {.count = row->count};
    memset(samples, 0, sizeof samples);
    memset(resolved, 0, sizeof resolved);
    for (int s = 0; s < row->count; s++) {
        memcpy(samples[s], row->texels[s], (size_t)count * size);
        rest.texels[s] = samples[s];
    }
    resolve_group(job, &rest, resolved);
    memcpy(to, resolved, (size_t)count * size);
}

void RHW_ISA_NAME(rhw_resolve_band)(const struct rhw_resolve_job *job, int index)
{
    const size_t size = job->info->size;
    const struct band band = band_of(index, job->band, job->height, job->depth);
    for (int i = band.begin; i < band.end; i++) {
        const size_t y = (size_t)(i % job->height), z = (size_t)(i / job->height);
        const unsigned char *const from = job->from + z * job->from_slice + y * job->from_row;
        unsigned char *const to = job->to + z * job->to_slice + y * job->to_row;
        for (int x = 0; x < job->width; x += RHW_LANES) {
            struct sample_row row = {.count = job->samples};
            for (int s = 0; s < job->samples; s++) {
                row.texels[s] = from + (size_t)s * job->sample_stride + (size_t)x * size;
            }
            if (job->width - x >= RHW_LANES) {
                resolve_group(job, &row, to + (size_t)x * size);
            } else {
                resolve_rest(job, &row, job->width - x, to + (size_t)x * size);
            }
        }
    }
}
