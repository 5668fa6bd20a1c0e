// SPDX-License-Identifier: MIT
// Regions are scaled into others. Texel i of an axis of n texels lies at the fraction (2i + 1)·m / 2n of the m texels
// that it is made from (Vulkan 1.3, "Image Copies With Scaling"), so neighbours and weights come from integers: they
// are equal on every machine, and right to half a unit of a float. The kernel looks them up.
#include <string.h>

#include "format/block_format.h"
#include "base/constants.h"
#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "kernels/kernels.h"
#include "kernels/transfer_work.h"
#include "context/lookup.h"
#include "base/memory.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "base/scheduler.h"
#include "texture_region.h"

static const char *const where = "rhw_texture_blit";

enum { BAND_TEXELS = 1 << 14 }; // texels of a task: some 50 µs

// The corners of a region along an axis. Where the region is mirrored the second is less.
struct corners {
    int first, last;
};

struct blit_region {
    struct rhw_region region;
    struct corners corners[3];
};

// Checking ------------------------------------------------------------------------------------------

// Check the corners along an axis. Two zeros stand for the whole axis. Return false where the region has no texel, or
// too many.
static bool check_corners(const struct rhw_context *context, const char *name, char axis, int most,
                          struct corners *corners)
{
    if (corners->first == 0 && corners->last == 0) {
        corners->last = most;
    }
    const int a = corners->first, b = corners->last;
    return rhw_check(context, a != b && a >= 0 && b >= 0 && a <= most && b <= most,
                     "%s: %s.%c0 is %d and %s.%c1 is %d; they differ and are in 0..%d", where, name, axis, a,
                     name, axis, b, most);
}

static void set_box(const struct corners *corners, int *first, int *size)
{
    const bool is_mirrored = corners->last < corners->first;
    *first = is_mirrored ? corners->last : corners->first;
    *size = is_mirrored ? corners->first - corners->last : corners->last - corners->first;
}

// Check a region. Its texture is NULL where the call was misuse.
static struct blit_region check_region(struct rhw_context *context, rhw_texture id,
                                       const struct rhw_blit_region *given, const char *name)
{
    static const struct rhw_blit_region whole = {0};
    const struct rhw_blit_region *const box = given ? given : &whole;
    const struct rhw_texture_region level = {.level = box->level, .aspect = box->aspect};
    struct blit_region checked = {.region = rhw_region_check(context, id, &level, name, where),
                                  .corners = {{box->x0, box->x1}, {box->y0, box->y1}, {box->z0, box->z1}}};
    struct rhw_region *const region = &checked.region;
    if (!region->texture || !rhw_region_check_single(context, region, where) ||
        !check_corners(context, name, 'x', region->width, &checked.corners[0]) ||
        !check_corners(context, name, 'y', region->height, &checked.corners[1]) ||
        !check_corners(context, name, 'z', region->depth, &checked.corners[2])) {
        region->texture = NULL;
        return checked;
    }
    set_box(&checked.corners[0], &region->x, &region->width);
    set_box(&checked.corners[1], &region->y, &region->height);
    set_box(&checked.corners[2], &region->z, &region->depth);
    return checked;
}

static bool have_depth(const struct rhw_region *region)
{
    return rhw_format_has_role(region->texture->info, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET);
}

// Return true if values of one format can become values of the other.
static bool converts(const struct rhw_region *from, const struct rhw_region *to)
{
    const struct rhw_format_info *const a = from->texture->info, *const b = to->texture->info;
    if (have_depth(from) || have_depth(to)) {
        return from->texture->format == to->texture->format && from->is_stencil == to->is_stencil;
    }
    return rhw_format_is_integer(a) || rhw_format_is_integer(b) ? a->type == b->type : true;
}

static bool check_pair(const struct rhw_context *context, const struct blit_region *from_region,
                       const struct blit_region *to_region, enum rhw_filter filter)
{
    const struct rhw_region *const from = &from_region->region, *const to = &to_region->region;
    const bool is_filtered = !have_depth(from) && !rhw_format_is_integer(from->texture->info);
    const bool has_slices = from->texture->shape.kind == RHW_TEXTURE_3D;
    return rhw_region_check_writable(context, to, where) &&
           rhw_check(context, converts(from, to), "%s: %s is %s and %s is %s; neither becomes the other",
                     where, rhw_name_of(&context->textures, from->id.index).text, from->texture->info->name,
                     rhw_name_of(&context->textures, to->id.index).text, to->texture->info->name) &&
           rhw_check(context, (unsigned)filter <= RHW_FILTER_NEAREST, "%s: filter is %d; not a filter", where,
                     (int)filter) &&
           rhw_check(context, is_filtered || filter == RHW_FILTER_NEAREST,
                     "%s: %s is %s; that takes RHW_FILTER_NEAREST", where,
                     rhw_name_of(&context->textures, from->id.index).text, from->texture->info->name) &&
           rhw_check(context,
                     has_slices || (from->depth == to->depth &&
                                    from_region->corners[2].first < from_region->corners[2].last &&
                                    to_region->corners[2].first < to_region->corners[2].last),
                     "%s: layers %d to %d become %d to %d; they are as many, and not mirrored", where,
                     from_region->corners[2].first, from_region->corners[2].last, to_region->corners[2].first,
                     to_region->corners[2].last) &&
           rhw_region_check_apart(context, from, to, where);
}

// Neighbours and weights ------------------------------------------------------------------------------

static int clamp(int64_t i, int first, int size)
{
    return (int)(i < first ? first : i > first + size - 1 ? first + size - 1 : i);
}

// Set what `size` texels of the target, from the lowest on, are made from. The tables have room for `room` texels.
// Texels behind `size` are made from what the last one is made from.
static void set_axis(int32_t *low, int32_t *high, float *weight, int room, const struct corners *source,
                     const struct corners *target, bool is_linear)
{
    // Texels are counted from the target's lower corner on, mirrored or not.
    const bool swaps = target->last < target->first;
    const int begin = swaps ? source->last : source->first, end = swaps ? source->first : source->last;
    const int size = swaps ? target->first - target->last : target->last - target->first;
    const int first = begin < end ? begin : end, count = begin < end ? end - begin : begin - end;
    const int64_t unit = 2 * (int64_t)size; // units in a texel
    for (int i = 0; i < room; i++) {
        const int j = i < size ? i : size - 1;
        const int64_t at = begin * unit + (2 * (int64_t)j + 1) * (end - begin) - (is_linear ? size : 0);
        const int64_t lower = at >= 0 ? at / unit : -((unit - 1 - at) / unit);
        low[i] = clamp(lower, first, count);
        high[i] = clamp(lower + 1, first, count);
        weight[i] = (float)((double)(at - lower * unit) / (double)unit);
    }
}

// Return the number of texels in whole groups of 8.
static int room_of(int size)
{
    return (size + RHW_LANES - 1) / RHW_LANES * RHW_LANES;
}

struct blit {
    const struct rhw_kernels *kernels;
    struct rhw_blit_job job;
};

static void blit_band(void *user, int index, int worker)
{
    (void)worker;
    const struct blit *const blit = user;
    blit->kernels->blit_band(&blit->job, index);
}

static enum rhw_result run(struct rhw_context *context, const struct blit_region *from,
                           const struct blit_region *to, enum rhw_filter filter)
{
    const struct rhw_region *const source = &from->region, *const target = &to->region;
    const bool is_linear = filter == RHW_FILTER_LINEAR;
    const bool is_copied = !is_linear && source->texture->info == target->texture->info;
    const int sizes[3] = {target->width, target->height, target->depth};
    const size_t room = (size_t)(room_of(sizes[0]) + room_of(sizes[1]) + room_of(sizes[2]));
    const size_t size = room * 3 * sizeof(int32_t);
    int32_t *const block = rhw_memory_allocate(&context->memory, size, RHW_CACHE_LINE);
    if (!block) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    const struct rhw_format_info *const stencil = rhw_format_info(RHW_FORMAT_S8_UINT);
    struct blit blit = {context->kernels,
                        {.from_info = source->is_stencil ? stencil : source->texture->info,
                         .to_info = target->is_stencil ? stencil : target->texture->info,
                         .from = rhw_region_aspect(source, 0),
                         .to = rhw_region_aspect(target, 0),
                         .is_linear = is_linear,
                         .has_slice_filter = is_linear && source->texture->shape.kind == RHW_TEXTURE_3D,
                         .is_copied = is_copied,
                         .x = target->x,
                         .y = target->y,
                         .z = target->z,
                         .width = target->width,
                         .height = target->height,
                         .depth = target->depth,
                         .band = 1 + BAND_TEXELS / target->width}};
    int32_t *next = block;
    for (int axis = 0; axis < 3; axis++) {
        const int count = room_of(sizes[axis]);
        int32_t *const low = next, *const high = next + count;
        float *const weight = (float *)(high + count);
        next = high + 2 * count;
        set_axis(low, high, weight, count, &from->corners[axis], &to->corners[axis],
                 axis == 2 ? blit.job.has_slice_filter : is_linear);
        blit.job.axis[axis] = (struct rhw_blit_axis){low, high, weight};
    }
    rhw_scheduler_run(context->scheduler, blit_band, &blit,
                      (sizes[1] * sizes[2] + blit.job.band - 1) / blit.job.band);
    rhw_memory_release(&context->memory, block, size);
    return RHW_OK;
}

static enum rhw_result blit_texture(struct rhw_context *context, rhw_texture from_texture,
                                    const struct rhw_blit_region *from_region, rhw_texture to_texture,
                                    const struct rhw_blit_region *to_region, enum rhw_filter filter)
{
    const struct blit_region from = check_region(context, from_texture, from_region, "from");
    struct blit_region to = {.region = {.texture = NULL}};
    if (from.region.texture) {
        to = check_region(context, to_texture, to_region, "to");
    }
    if (!to.region.texture || !check_pair(context, &from, &to, filter)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_region_to_write(context, &to.region)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    return run(context, &from, &to, filter);
}

enum rhw_result rhw_texture_blit(rhw_context *context, rhw_texture from_texture,
                                 const struct rhw_blit_region *from, rhw_texture to_texture,
                                 const struct rhw_blit_region *to, enum rhw_filter filter)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = blit_texture(context, from_texture, from, to_texture, to, filter);
    rhw_context_leave(context);
    return result;
}
