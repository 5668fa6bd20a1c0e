// SPDX-License-Identifier: MIT
// Regions that a call names are checked here before texels move.
#include "texture_region.h"

#include "format/block_format.h"
#include "context/context.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "texture_access.h"
#include "texture_shape.h"

static struct rhw_name name_of(const struct rhw_context *context, rhw_texture id)
{
    return rhw_name_of(&context->textures, id.index);
}

// Check one axis and write into *size what 0 stands for. `axis` is 0..2.
static bool check_axis(const struct rhw_context *context, const struct rhw_region *region, const char *name,
                       int axis, int first, int *size, int most, const char *where)
{
    static const char *const firsts[] = {"x", "y", "z"}, *const sizes[] = {"width", "height", "depth"};
    if (!rhw_check(context, first >= 0 && first < most, "%s: %s.%s is %d; level %d of %s has 0..%d", where,
                   name, firsts[axis], first, region->level, name_of(context, region->id).text, most - 1)) {
        return false;
    }
    *size = *size == 0 ? most - first : *size;
    return rhw_check(context, *size >= 1 && *size <= most - first,
                     "%s: %s.%s is %d and %s.%s is %d; from there level %d of %s has 1..%d", where, name,
                     firsts[axis], first, name, sizes[axis], *size, region->level,
                     name_of(context, region->id).text, most - first);
}

static bool check_box(const struct rhw_context *context, struct rhw_region *region, const char *name,
                      const char *where)
{
    const struct rhw_mip *const mip = &region->texture->mip[region->level];
    return check_axis(context, region, name, 0, region->x, &region->width, mip->width, where) &&
           check_axis(context, region, name, 1, region->y, &region->height, mip->height, where) &&
           check_axis(context, region, name, 2, region->z, &region->depth, mip->slices, where);
}

static bool check_aspect(const struct rhw_context *context, struct rhw_region *region, enum rhw_aspect aspect,
                         const char *name, const char *where)
{
    const struct rhw_format_info *const info = region->texture->info;
    const bool has_stencil = rhw_format_has_role(info, RHW_ROLE_STENCIL_TARGET);
    region->is_stencil =
        has_stencil && (aspect == RHW_ASPECT_STENCIL || !rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET));
    region->texel = region->is_stencil ? 1 : info->size;
    return rhw_check(context, (unsigned)aspect <= RHW_ASPECT_STENCIL, "%s: %s.aspect is %d; not an aspect",
                     where, name, (int)aspect) &&
           rhw_check(context, aspect == RHW_ASPECT_DEFAULT || has_stencil,
                     "%s: %s is %s; that has no stencil", where, name_of(context, region->id).text,
                     info->name);
}

struct rhw_region rhw_region_check(struct rhw_context *context, rhw_texture id,
                                   const struct rhw_texture_region *region, const char *name,
                                   const char *where)
{
    static const struct rhw_texture_region whole = {0};
    const struct rhw_region misuse = {.texture = NULL};
    const struct rhw_texture_region *const box = region ? region : &whole;
    struct rhw_region checked = {.texture = rhw_context_texture(context, id, where),
                                 .id = id,
                                 .level = box->level,
                                 .x = box->x,
                                 .y = box->y,
                                 .z = box->z,
                                 .width = box->width,
                                 .height = box->height,
                                 .depth = box->depth,
                                 .sample = box->sample};
    return checked.texture && rhw_texture_check_unattached(context, id, checked.texture, where) &&
                   rhw_texture_check_level(context, id, checked.texture, box->level, where) &&
                   check_aspect(context, &checked, box->aspect, name, where) &&
                   check_box(context, &checked, name, where) &&
                   rhw_check(context, box->sample >= 0 && box->sample < checked.texture->samples,
                             "%s: %s.sample is %d; %s has samples 0..%d", where, name, box->sample,
                             name_of(context, id).text, checked.texture->samples - 1)
               ? checked
               : misuse;
}

bool rhw_region_check_single(const struct rhw_context *context, const struct rhw_region *region,
                             const char *where)
{
    return rhw_check(context, region->texture->samples == 1, "%s: %s has %d samples; it must have one", where,
                     name_of(context, region->id).text, region->texture->samples);
}

bool rhw_region_check_writable(const struct rhw_context *context, const struct rhw_region *region,
                               const char *where)
{
    return rhw_check(context, !rhw_block_format(region->texture->format),
                     "%s: %s is %s; blocks are written by rhw_texture_write and rhw_texture_write_region",
                     where, name_of(context, region->id).text,
                     rhw_format_info(region->texture->format)->name) &&
           rhw_texture_check_unread(context, region->id, region->texture, where);
}

struct rhw_mip rhw_region_aspect(const struct rhw_region *region, int sample)
{
    struct rhw_mip aspect = region->texture->mip[region->level];
    if (region->is_stencil) {
        rhw_mip_take_stencil(&aspect);
    }
    aspect.texels += (size_t)sample * region->texture->sample_stride;
    return aspect;
}

static bool spans_overlap(int a, int b, int a_size, int b_size)
{
    return a < b + b_size && b < a + a_size;
}

// Return true if both regions lie in texels that one texture, or its views, have. Levels differ in a pitch; slices of
// one pitch that lie that far apart have no texel in common.
static bool regions_overlap(const struct rhw_region *from, const struct rhw_region *to)
{
    const struct rhw_mip a = rhw_region_aspect(from, 0), b = rhw_region_aspect(to, 0);
    const bool are_one = from->texture == to->texture ||
                         (from->texture->shared && from->texture->shared == to->texture->shared);
    if (!are_one || a.row_pitch != b.row_pitch || a.slice_pitch != b.slice_pitch) {
        return false;
    }
    const ptrdiff_t slices = (b.texels - a.texels) / (ptrdiff_t)a.slice_pitch;
    return (b.texels - a.texels) % (ptrdiff_t)a.slice_pitch == 0 &&
           spans_overlap(from->x, to->x, from->width, to->width) &&
           spans_overlap(from->y, to->y, from->height, to->height) &&
           spans_overlap(from->z, to->z + (int)slices, from->depth, to->depth);
}

bool rhw_region_check_apart(const struct rhw_context *context, const struct rhw_region *from,
                            const struct rhw_region *to, const char *where)
{
    return rhw_check(context, !regions_overlap(from, to),
                     "%s: the regions overlap in %s; copy by way of another texture", where,
                     rhw_name_of(&context->textures, to->id.index).text);
}

bool rhw_region_check_no_sample(const struct rhw_context *context, const struct rhw_texture_region *region,
                                const char *name, const char *where)
{
    return rhw_check(context, !region || region->sample == 0,
                     "%s: %s.sample is %d; all samples are meant, it must be 0", where, name,
                     region ? region->sample : 0);
}

struct rhw_region rhw_region_check_place(struct rhw_context *context, rhw_texture id,
                                         const struct rhw_texture_region *to, const struct rhw_region *from,
                                         const char *where)
{
    struct rhw_texture_region place = {.level = 0};
    if (to) {
        place = *to;
    }
    const struct rhw_region misuse = {.texture = NULL};
    if (!rhw_check(context,
                   (place.width == 0 || place.width == from->width) &&
                       (place.height == 0 || place.height == from->height) &&
                       (place.depth == 0 || place.depth == from->depth),
                   "%s: from is %dx%dx%d texels and to is %dx%dx%d; sizes are equal, or 0", where,
                   from->width, from->height, from->depth, place.width, place.height, place.depth)) {
        return misuse;
    }
    place.width = from->width;
    place.height = from->height;
    place.depth = from->depth;
    return rhw_region_check(context, id, &place, "to", where);
}

bool rhw_region_to_write(struct rhw_context *context, struct rhw_region *region)
{
    region->texture = rhw_texture_to_write(context, region->id, region->texture);
    if (region->texture) {
        region->texture->written |= 1u << region->level;
    }
    return region->texture != NULL;
}

unsigned char *rhw_region_row(const struct rhw_region *region, int y, int z)
{
    const struct rhw_mip aspect = rhw_region_aspect(region, region->sample);
    return rhw_mip_slice(&aspect, region->z + z) + (size_t)(region->y + y) * aspect.row_pitch +
           (size_t)region->x * region->texel;
}
