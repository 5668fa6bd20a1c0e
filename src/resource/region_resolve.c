// SPDX-License-Identifier: MIT
// Samples of a region are resolved by all threads.
#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "kernels/kernels.h"
#include "kernels/transfer_work.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "base/scheduler.h"
#include "texture_region.h"

static const char *const where = "rhw_texture_resolve";

enum { BAND_TEXELS = 1 << 14 }; // texels of a task, with all samples: some 50 µs

struct resolved {
    const struct rhw_kernels *kernels;
    struct rhw_resolve_job job;
};

static void resolve_band(void *user, int index, int worker)
{
    (void)worker;
    const struct resolved *const resolved = user;
    resolved->kernels->resolve_band(&resolved->job, index);
}

static enum rhw_resolve mode_of(const struct rhw_region *region, enum rhw_resolve mode)
{
    const struct rhw_format_info *const info = region->texture->info;
    const bool has_depth = rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET);
    return rhw_format_is_integer(info)   ? RHW_RESOLVE_SAMPLE_ZERO
           : mode != RHW_RESOLVE_DEFAULT ? mode
           : has_depth                   ? RHW_RESOLVE_SAMPLE_ZERO
                                         : RHW_RESOLVE_AVERAGE;
}

static void run(struct rhw_context *context, const struct rhw_region *from, const struct rhw_region *to,
                enum rhw_resolve mode)
{
    const struct rhw_mip source = rhw_region_aspect(from, 0), target = rhw_region_aspect(to, 0);
    const enum rhw_format format = from->is_stencil ? RHW_FORMAT_S8_UINT : from->texture->format;
    struct resolved resolved = {context->kernels,
                                {.info = rhw_format_info(format),
                                 .mode = mode_of(from, mode),
                                 .from = rhw_region_row(from, 0, 0),
                                 .from_row = source.row_pitch,
                                 .from_slice = source.slice_pitch,
                                 .sample_stride = from->texture->sample_stride,
                                 .samples = from->texture->samples,
                                 .to = rhw_region_row(to, 0, 0),
                                 .to_row = target.row_pitch,
                                 .to_slice = target.slice_pitch,
                                 .width = to->width,
                                 .height = to->height,
                                 .depth = to->depth}};
    const int band = 1 + BAND_TEXELS / (to->width * from->texture->samples);
    resolved.job.band = band;
    rhw_scheduler_run(context->scheduler, resolve_band, &resolved,
                      (to->height * to->depth + band - 1) / band);
}

static bool check_pair(const struct rhw_context *context, const struct rhw_region *from,
                       const struct rhw_region *to)
{
    return rhw_check(context, from->texture->samples > 1,
                     "%s: %s has one sample; copy it by rhw_texture_copy", where,
                     rhw_name_of(&context->textures, from->id.index).text) &&
           rhw_region_check_single(context, to, where) && rhw_region_check_writable(context, to, where) &&
           rhw_check(context, from->texture->format == to->texture->format,
                     "%s: %s is %s and %s is %s; formats are equal", where,
                     rhw_name_of(&context->textures, from->id.index).text, from->texture->info->name,
                     rhw_name_of(&context->textures, to->id.index).text, to->texture->info->name) &&
           rhw_check(context, from->is_stencil == to->is_stencil,
                     "%s: from.aspect and to.aspect differ; stencil is resolved to stencil", where);
}

static enum rhw_result resolve(struct rhw_context *context, rhw_texture from_texture,
                               const struct rhw_texture_region *from_region, rhw_texture to_texture,
                               const struct rhw_texture_region *to_region, enum rhw_resolve mode)
{
    const struct rhw_region from = rhw_region_check(context, from_texture, from_region, "from", where);
    struct rhw_region to = {.texture = NULL};
    if (from.texture) {
        to = rhw_region_check_place(context, to_texture, to_region, &from, where);
    }
    if (!to.texture || !rhw_region_check_no_sample(context, from_region, "from", where) ||
        !check_pair(context, &from, &to) ||
        !rhw_check(context, (unsigned)mode <= RHW_RESOLVE_SAMPLE_ZERO, "%s: mode is %d; not a resolve mode",
                   where, (int)mode)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_region_to_write(context, &to)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    run(context, &from, &to, mode);
    return RHW_OK;
}

enum rhw_result rhw_texture_resolve(rhw_context *context, rhw_texture from_texture,
                                    const struct rhw_texture_region *from, rhw_texture to_texture,
                                    const struct rhw_texture_region *to, enum rhw_resolve mode)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = resolve(context, from_texture, from, to_texture, to, mode);
    rhw_context_leave(context);
    return result;
}
