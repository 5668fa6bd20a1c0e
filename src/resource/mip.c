// SPDX-License-Identifier: MIT
// Mip generation. Each level is the box-filtered level above, in linear light, in floats: levels are rounded to the
// texture's format when stored, never in between, so that errors do not add up from level to level. Odd sizes take the
// polyphase box of three texels, whose weights make every texel of the level above count the same (W. Donnelly,
// "Non-power-of-two mipmapping", NVIDIA 2005).
//
// All threads make bands of rows, a few levels at a time (kernels/mip_band.c). A band's rows stay in the cache from the
// texels to the last of these levels. This level alone is kept, as floats, for the next ones.
#include "base/constants.h"
#include "context/context.h"
#include "context/given_up.h"
#include "format/format.h"
#include "kernels/kernels.h"
#include "kernels/mip_work.h"
#include "base/memory.h"
#include "base/scheduler.h"
#include "texture.h"

enum {
    // Texels of the level that a band is made from. It takes some 50 µs, beside which waking a thread and the rows that
    // bands of odd sizes have in common are little.
    BAND_TEXELS = 1 << 17,
    // Rows of the last level. Where sizes are odd, two bands make seven rows of the first level twice.
    BAND_LEAST = 8
};

struct made_mips {
    struct rhw_context *context;
    struct rhw_mip_job job;
};

static void make_band(void *user, int index, int worker)
{
    const struct made_mips *const mips = user;
    if (!rhw_context_is_given_up(mips->context, worker)) {
        mips->context->kernels->mip_band(&mips->job, index, worker);
    }
}

struct made_volume {
    struct rhw_context *context;
    struct rhw_mip_volume_job job;
};

static void make_slice(void *user, int index, int worker)
{
    const struct made_volume *const volume = user;
    if (!rhw_context_is_given_up(volume->context, worker)) {
        volume->context->kernels->mip_slice(&volume->job, index, worker);
    }
}

// Return the floats of a whole level, or 0 where no level is made from it.
static size_t level_size(const struct rhw_texture_data *texture, int level)
{
    if (level >= texture->levels - 1) {
        return 0;
    }
    const struct rhw_mip *const mip = &texture->mip[level];
    const int slices = texture->shape.kind == RHW_TEXTURE_3D ? mip->slices : 1; // layers are made one by one
    return (size_t)slices * (size_t)mip->height * rhw_mip_row(mip->width, texture->info->channels);
}

// Return the floats that a worker needs: a row of level 0, and a row and three rows reduced along x of each level that
// is made.
static size_t scratch_size(const struct rhw_texture_data *texture)
{
    size_t size = rhw_mip_row(texture->mip[0].width, texture->info->channels);
    for (int i = 1; i <= RHW_MIP_STEPS && i < texture->levels; i++) {
        size += 4 * rhw_mip_row(texture->mip[i].width, texture->info->channels);
    }
    return size;
}

static int rows_of_band(const struct rhw_texture_data *texture, int base, int last)
{
    const int rows = BAND_TEXELS / (texture->mip[base].width << (last - base));
    return rows < BAND_LEAST ? BAND_LEAST : rows;
}

// Make the levels of a layer.
static void make_layer(struct made_mips *mips, float *odd, float *even)
{
    struct rhw_mip_job *const job = &mips->job;
    const struct rhw_texture_data *const texture = job->texture;
    job->base = 0;
    job->from = NULL;
    for (int step = 0; job->base < texture->levels - 1; step++) {
        const int most = job->base + RHW_MIP_STEPS;
        job->last = most < texture->levels - 1 ? most : texture->levels - 1;
        job->to = job->last == texture->levels - 1 ? NULL : step % 2 == 0 ? odd : even;
        job->band = rows_of_band(texture, job->base, job->last);
        const int rows = texture->mip[job->last].height;
        rhw_scheduler_run(mips->context->scheduler, make_band, mips, (rows + job->band - 1) / job->band);
        job->base = job->last;
        job->from = job->to;
    }
}

static bool make_layers(struct rhw_context *context, const struct rhw_texture_data *texture)
{
    // Levels 3, 9, .. and levels 6, 12, .. take turns in two buffers.
    const size_t scratch = scratch_size(texture);
    const size_t odd = level_size(texture, RHW_MIP_STEPS), even = level_size(texture, 2 * RHW_MIP_STEPS);
    const size_t size = ((size_t)context->threads * scratch + odd + even) * sizeof(float);
    // The block is zeroed because lanes behind the end of a row are computed too.
    float *const block = rhw_memory_allocate_zeroed(&context->memory, size, RHW_CACHE_LINE);
    if (!block) {
        return false;
    }
    float *const buffers = block + (size_t)context->threads * scratch;
    struct made_mips mips = {context, {.texture = texture, .scratch = block, .scratch_size = scratch}};
    for (mips.job.slice = 0; mips.job.slice < texture->shape.layers; mips.job.slice++) {
        make_layer(&mips, buffers, buffers + odd);
    }
    rhw_memory_release(&context->memory, block, size);
    return true;
}

// Make one level of a volume after the other, slice by slice: two or three slices of the level above are mixed and then
// reduced as a layer is.
static bool make_volume(struct rhw_context *context, const struct rhw_texture_data *texture)
{
    const struct rhw_mip *const first = &texture->mip[0];
    const size_t slice = (size_t)first->height * rhw_mip_row(first->width, texture->info->channels);
    const size_t scratch = slice + rhw_mip_row(first->width, texture->info->channels) + scratch_size(texture);
    const size_t odd = level_size(texture, 1), even = level_size(texture, 2);
    const size_t size = ((size_t)context->threads * scratch + odd + even) * sizeof(float);
    float *const block = rhw_memory_allocate_zeroed(&context->memory, size, RHW_CACHE_LINE);
    if (!block) {
        return false;
    }
    float *const buffers = block + (size_t)context->threads * scratch;
    struct made_volume volume = {context, {.texture = texture, .scratch = block, .scratch_size = scratch}};
    struct rhw_mip_volume_job *const job = &volume.job;
    for (; job->base < texture->levels - 1; job->base++) {
        job->to = job->base + 1 == texture->levels - 1 ? NULL : job->base % 2 == 0 ? buffers : buffers + odd;
        rhw_scheduler_run(context->scheduler, make_slice, &volume, texture->mip[job->base + 1].slices);
        job->from = job->to;
    }
    rhw_memory_release(&context->memory, block, size);
    return true;
}

enum rhw_result rhw_texture_data_generate_mips(struct rhw_context *context,
                                               const struct rhw_texture_data *texture)
{
    rhw_context_begin_work(context);
    if (texture->levels > 1 &&
        !(texture->shape.kind == RHW_TEXTURE_3D ? make_volume : make_layers)(context, texture)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    return atomic_load(&context->given_up) ? RHW_ERROR_GIVEN_UP : RHW_OK;
}
