// SPDX-License-Identifier: MIT
// Regions of textures are cleared to one value, with all their samples.
#include <string.h>

#include "clear_texel.h"
#include "context/context.h"
#include "base/cpu.h"
#include "context/entry.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "texture_region.h"

static const char *const where = "rhw_texture_clear";

static bool check_color(const struct rhw_context *context, const struct rhw_format_info *info,
                        const struct rhw_clear_value *value)
{
    const bool is_integer = rhw_format_is_integer(info);
    for (int c = 0; c < 4; c++) {
        if (!rhw_check(context, !is_integer || value->color[c] == 0,
                       "%s: color[%d] is set and %s holds integers; set color_integer", where, c,
                       info->name) ||
            !rhw_check(context, is_integer || value->color_integer[c] == 0,
                       "%s: color_integer[%d] is set and %s holds no integers; set color", where, c,
                       info->name) ||
            !rhw_check(context, !context->validation || value->color[c] == value->color[c],
                       "%s: color[%d] is NaN", where, c)) {
            return false;
        }
    }
    return true;
}

static bool check_value(const struct rhw_context *context, const struct rhw_format_info *info,
                        const struct rhw_clear_value *value)
{
    if (!rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET)) {
        return check_color(context, info, value);
    }
    return rhw_check(context, value->depth >= 0 && value->depth <= 1, "%s: depth is %g; it is in 0..1", where,
                     (double)value->depth);
}

// Set the texel that a region is filled with.
static void set_texel(const struct rhw_region *region, const struct rhw_clear_value *value,
                      unsigned char *texel)
{
    const struct rhw_format_info *const info = region->texture->info;
    if (region->is_stencil) {
        texel[0] = value->stencil;
        return;
    }
    float color[4] = {value->depth};
    if (rhw_format_is_integer(info)) {
        memcpy(color, value->color_integer, sizeof color);
    } else if (!rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET)) {
        memcpy(color, value->color, sizeof color);
    }
    const uint64_t environment = rhw_cpu_float_enter();
    rhw_clear_texel(info, color, texel);
    rhw_cpu_float_leave(environment);
}

// Fill a row with texels: what is there is doubled until the row is full.
static void fill_row(unsigned char *row, size_t size, const unsigned char *texel, size_t texel_size)
{
    memcpy(row, texel, texel_size);
    for (size_t done = texel_size; done < size; done *= 2) {
        memcpy(row + done, row, done < size - done ? done : size - done);
    }
}

static void clear_region(struct rhw_region region, const struct rhw_clear_value *value)
{
    unsigned char texel[RHW_TEXEL_BYTES] = {0};
    set_texel(&region, value, texel);
    const size_t size = rhw_region_row_size(&region);
    for (region.sample = 0; region.sample < region.texture->samples; region.sample++) {
        const unsigned char *const first = rhw_region_row(&region, 0, 0);
        fill_row(rhw_region_row(&region, 0, 0), size, texel, region.texel);
        for (int z = 0; z < region.depth; z++) {
            for (int y = z == 0 ? 1 : 0; y < region.height; y++) {
                memcpy(rhw_region_row(&region, y, z), first, size);
            }
        }
    }
}

// Clear all levels and both aspects. The region is level 0, whole.
static void clear_levels(struct rhw_region region, const struct rhw_clear_value *value)
{
    struct rhw_texture_data *const texture = region.texture;
    for (region.level = 0; region.level < texture->levels; region.level++) {
        const struct rhw_mip *const mip = &texture->mip[region.level];
        region.width = mip->width;
        region.height = mip->height;
        region.depth = mip->slices;
        clear_region(region, value);
        if (mip->stencil && !region.is_stencil) {
            struct rhw_region stencil = region;
            stencil.is_stencil = true;
            stencil.texel = 1;
            clear_region(stencil, value);
        }
    }
    texture->written = (1u << texture->levels) - 1;
}

static enum rhw_result clear(struct rhw_context *context, rhw_texture texture,
                             const struct rhw_texture_region *region, const struct rhw_clear_value *value)
{
    struct rhw_region checked = rhw_region_check(context, texture, region, "region", where);
    if (!checked.texture || !rhw_region_check_writable(context, &checked, where) ||
        !rhw_region_check_no_sample(context, region, "region", where) ||
        !rhw_check(context, value != NULL, "%s: value is NULL", where) ||
        !check_value(context, checked.texture->info, value)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_region_to_write(context, &checked)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    if (region) {
        clear_region(checked, value);
    } else {
        clear_levels(checked, value);
    }
    return RHW_OK;
}

enum rhw_result rhw_texture_clear(rhw_context *context, rhw_texture texture,
                                  const struct rhw_texture_region *region,
                                  const struct rhw_clear_value *value)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = clear(context, texture, region, value);
    rhw_context_leave(context);
    return result;
}
