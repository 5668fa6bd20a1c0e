// SPDX-License-Identifier: MIT
// Mip generation, one of the translation units of an instruction set: it makes a band of rows of a few levels. Rows of
// the level above stream through all of them while they are in the cache. Each row is reduced along x once, to a line.
// Two or three lines make a row of the next level, which is stored and goes on to the level after it. mip.c has the
// formula's source and the jobs.
#include "kernel_entries.h"

#include "resource/texture.h"
#include "integer.h"
#include "mip_work.h"
#include "kernels/texel/mip_codec.h"

enum { TAPS = 3 };

// What a row takes of the level above: lines first, first + 1, ..
struct row_taps {
    int first, count;
    float weight[TAPS];
};

// A level that is made.
struct made_level {
    const struct rhw_mip *mip;
    int above_width, above_height;
    // This task makes rows from `first` on, and stores the rows first .. own_end − 1.
    int first, own_end;
    size_t stride;     // floats of a channel
    float *line[TAPS]; // lines of row y of the level above stand at y % 3
    float *row;
};

struct band {
    const struct rhw_mip_job *job;
    int channels;
    // The levels from job->base on. Of the first one the row alone is used.
    struct made_level level[RHW_MIP_STEPS + 1];
};

static struct row_taps row_taps_of(int larger, int smaller, int y)
{
    if (larger == 1) {
        return (struct row_taps){0, 1, {1.0f}};
    }
    if (larger % 2 == 0) {
        return (struct row_taps){2 * y, 2, {0.5f, 0.5f}};
    }
    const float width = (float)larger;
    return (struct row_taps){
        2 * y, 3, {(float)(smaller - y) / width, (float)smaller / width, (float)(y + 1) / width}};
}

// Load every second of 16 floats, from the first or the second one.
RHW_INLINE void load_pairs(const float *from, f32x8 *even, f32x8 *odd)
{
    const f32x8 a = f32x8_load(from), b = f32x8_load(from + RHW_LANES);
    *even = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
    *odd = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
}

// Reduce a row of the level above to a line of this level.
static void reduce_columns(const struct made_level *level, int channels, const float *row, size_t stride,
                           float *line)
{
    const int larger = level->above_width, smaller = level->mip->width;
    const float width = (float)larger;
    for (int x = 0; x < smaller; x += RHW_LANES) {
        const i32x8 i = i32x8_splat(x) + rhw_lane_index;
        const f32x8 left = rhw_float_from_int(i32x8_splat(smaller) - i) / width,
                    right = rhw_float_from_int(i + 1) / width;
        const float middle = (float)smaller / width;
        for (int c = 0; c < channels; c++) {
            const float *const from = row + (size_t)c * stride + 2 * (size_t)x;
            f32x8 even, odd, next, unused, sum;
            if (larger == 1) {
                sum = f32x8_load(from);
            } else if (larger % 2 == 0) {
                load_pairs(from, &even, &odd);
                sum = even * 0.5f + odd * 0.5f;
            } else {
                load_pairs(from, &even, &odd);
                load_pairs(from + 2, &next, &unused);
                sum = even * left + odd * middle;
                sum += next * right;
            }
            f32x8_store(line + (size_t)c * level->stride + x, sum);
        }
    }
}

// Reduce lines of the level above to row y.
static void reduce_rows(const struct made_level *level, int channels, const struct row_taps *taps, float *row)
{
    const float *const first = level->line[taps->first % TAPS];
    for (int c = 0; c < channels; c++) {
        for (int x = 0; x < level->mip->width; x += RHW_LANES) {
            const size_t at = (size_t)c * level->stride + (size_t)x;
            f32x8 sum = f32x8_splat(0.0f) + f32x8_load(first + at) * taps->weight[0]; // −0 becomes 0
            for (int j = 1; j < taps->count; j++) {
                sum += f32x8_load(level->line[(taps->first + j) % TAPS] + at) * taps->weight[j];
            }
            f32x8_store(row + at, sum);
        }
    }
}

// Return the row that is complete with row y of the level above, or −1 if none is.
static int completed_row(const struct made_level *level, int y)
{
    if (level->above_height == 1) {
        return 0;
    }
    return level->above_height % 2 == 0 ? (y & 1 ? y / 2 : -1) : (y & 1 ? -1 : y / 2 - 1);
}

// Push row y of the first level, which is in its `row` or in the job's, through as many levels as it completes a row
// of.
static void push_row(const struct band *band, int y, const float *row)
{
    const struct rhw_mip_job *const job = band->job;
    for (int i = 1; i <= job->last - job->base; i++) {
        const struct made_level *const level = &band->level[i];
        reduce_columns(level, band->channels, row, level[-1].stride, level->line[y % TAPS]);
        y = completed_row(level, y);
        // A band of three taps a row begins with the last of the row before.
        if (y < level->first) {
            return;
        }
        const struct row_taps taps = row_taps_of(level->above_height, level->mip->height, y);
        float *to = level->row;
        if (job->base + i == job->last && job->to) {
            to = job->to + (size_t)y * rhw_mip_row(level->mip->width, band->channels);
        }
        reduce_rows(level, band->channels, &taps, to);
        if (y < level->own_end) {
            narrow_row(job->texture->info, to, level->stride, level->mip->width,
                       rhw_mip_slice(level->mip, job->slice) + (size_t)y * level->mip->row_pitch);
        }
        row = to;
    }
}

// Set the band's levels for rows begin .. end − 1 of the last level. *end becomes the end in the first level.
static int begin_band(struct band *band, int begin, int *end, float *scratch)
{
    const struct rhw_mip_job *const job = band->job;
    const struct rhw_mip *const mips = job->texture->mip;
    const bool is_last = *end == mips[job->last].height;
    int own_end = *end;
    for (int i = job->last; i >= job->base; i--) {
        struct made_level *const level = &band->level[i - job->base];
        const size_t row = rhw_mip_row(mips[i].width, band->channels);
        level->mip = &mips[i];
        level->stride = rhw_mip_stride(mips[i].width);
        level->row = scratch;
        scratch += row;
        if (i == job->base) {
            break;
        }
        for (int j = 0; j < TAPS; j++, scratch += row) {
            level->line[j] = scratch;
        }
        level->above_width = mips[i - 1].width;
        level->above_height = mips[i - 1].height;
        level->first = begin;
        level->own_end = is_last ? mips[i].height : own_end;
        const struct row_taps taps = row_taps_of(level->above_height, mips[i].height, *end - 1);
        begin = 2 * begin;
        own_end = 2 * own_end;
        *end = taps.first + taps.count;
    }
    return begin;
}

void RHW_ISA_NAME(rhw_make_mip_band)(const struct rhw_mip_job *job, int index, int worker)
{
    const struct rhw_mip *const base = &job->texture->mip[job->base];
    struct band band = {.job = job, .channels = job->texture->info->channels};
    const int rows = job->texture->mip[job->last].height;
    int end = min_int((index + 1) * job->band, rows);
    const int begin =
        begin_band(&band, index * job->band, &end, job->scratch + (size_t)worker * job->scratch_size);
    for (int y = begin; y < end; y++) {
        const float *row = band.level[0].row;
        if (job->from) {
            row = job->from + (size_t)y * rhw_mip_row(base->width, band.channels);
        } else {
            widen_row(job->texture->info, rhw_mip_slice(base, job->slice) + (size_t)y * base->row_pitch,
                      base->width, band.level[0].row, band.level[0].stride);
        }
        push_row(&band, y, row);
    }
}

// Add a slice of the level above, times its weight, to a slice of floats.
static void add_slice(const struct rhw_mip_volume_job *job, int slice, float weight, float *row, float *sum)
{
    const struct rhw_mip *const mip = &job->texture->mip[job->base];
    const int channels = job->texture->info->channels;
    const size_t floats = rhw_mip_row(mip->width, channels);
    for (size_t y = 0; y < (size_t)mip->height; y++) {
        const float *from = row;
        if (job->from) {
            from = job->from + ((size_t)slice * (size_t)mip->height + y) * floats;
        } else {
            widen_row(job->texture->info, rhw_mip_slice(mip, slice) + y * mip->row_pitch, mip->width, row,
                      rhw_mip_stride(mip->width));
        }
        for (size_t i = 0; i < floats; i += RHW_LANES) {
            f32x8_store(sum + y * floats + i,
                        f32x8_load(sum + y * floats + i) + f32x8_load(from + i) * weight);
        }
    }
}

void RHW_ISA_NAME(rhw_make_mip_slice)(const struct rhw_mip_volume_job *job, int index, int worker)
{
    const struct rhw_mip *const base = &job->texture->mip[job->base], *const made = base + 1;
    const int channels = job->texture->info->channels;
    const size_t row = rhw_mip_row(base->width, channels), slice = row * (size_t)base->height;
    const size_t made_slice = rhw_mip_row(made->width, channels) * (size_t)made->height;
    float *const sum = job->scratch + (size_t)worker * job->scratch_size;
    memset(sum, 0, slice * sizeof *sum);
    const struct row_taps taps = row_taps_of(base->slices, made->slices, index);
    for (int i = 0; i < taps.count; i++) {
        add_slice(job, taps.first + i, taps.weight[i], sum + slice, sum);
    }
    const struct rhw_mip_job flat = {.texture = job->texture,
                                     .slice = index,
                                     .base = job->base,
                                     .last = job->base + 1,
                                     .from = sum,
                                     .to = job->to ? job->to + (size_t)index * made_slice : NULL,
                                     .band = made->height,
                                     .scratch = sum + slice + row};
    RHW_ISA_NAME(rhw_make_mip_band)(&flat, 0, 0);
}
