// SPDX-License-Identifier: MIT
// Regions of textures are copied bit for bit, from and to the caller's memory, buffers and other textures.
#include <string.h>

#include "format/block_format.h"
#include "block_level.h"
#include "buffer.h"
#include "buffer_access.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/given_up.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "texture_access.h"
#include "texture_region.h"

// Rows outside of a texture, at their distances in bytes.
struct rows {
    unsigned char *first;
    size_t row_pitch, slice_pitch;
};

enum direction { INTO_TEXTURE, OUT_OF_TEXTURE };

// A unit is what stands together in the rows outside: a texel, or a block on its way in.
struct unit {
    int width, height; // texels of a unit
    size_t bytes;
};

static struct unit unit_of(const struct rhw_region *region, enum direction direction)
{
    const struct rhw_block_format *const block = rhw_block_format(region->texture->format);
    return block && direction == INTO_TEXTURE ? (struct unit){block->width, block->height, block->bytes}
                                              : (struct unit){1, 1, region->texel};
}

static int units(int texels, int unit)
{
    return texels / unit + (texels % unit != 0);
}

static size_t row_size(const struct rhw_region *region, struct unit unit)
{
    return (size_t)units(region->width, unit.width) * unit.bytes;
}

static unsigned char *outside_row(const struct rows *rows, int y, int z)
{
    return rows->first + (size_t)z * rows->slice_pitch + (size_t)y * rows->row_pitch;
}

static void read_rows(const struct rhw_region *region, const struct rows *rows)
{
    for (int z = 0; z < region->depth; z++) {
        for (int y = 0; y < region->height; y++) {
            memcpy(outside_row(rows, y, z), rhw_region_row(region, y, z), rhw_region_row_size(region));
        }
    }
}

static enum rhw_result write_texels(struct rhw_context *context, const struct rhw_region *region,
                                    const struct rows *rows)
{
    const size_t size = rhw_region_row_size(region), asked = 1 + RHW_ASKED_BYTES / size;
    size_t done = 0;
    rhw_context_begin_work(context);
    for (int z = 0; z < region->depth; z++) {
        for (int y = 0; y < region->height; y++) {
            if (done++ % asked == 0 && rhw_context_is_given_up(context, 0)) {
                return RHW_ERROR_GIVEN_UP;
            }
            memcpy(rhw_region_row(region, y, z), outside_row(rows, y, z), size);
        }
    }
    return RHW_OK;
}

// Decode blocks into texels. The rows outside have blocks.
static enum rhw_result decode_rows(struct rhw_context *context, const struct rhw_region *region,
                                   const struct rows *rows)
{
    struct rhw_mip part = rhw_region_aspect(region, 0);
    part.width = region->width;
    part.height = region->height;
    enum rhw_result result = RHW_OK;
    for (int z = 0; z < region->depth && result == RHW_OK; z++) {
        result =
            rhw_decode_level(context, region->texture->format, rows->first + (size_t)z * rows->slice_pitch,
                             rows->row_pitch, &part, rhw_region_row(region, 0, z));
    }
    return result;
}

static enum rhw_result write_rows(struct rhw_context *context, const struct rhw_region *region,
                                  const struct rows *rows)
{
    return rhw_block_format(region->texture->format) ? decode_rows(context, region, rows)
                                                     : write_texels(context, region, rows);
}

static bool check_block_axis(const struct rhw_context *context, const struct rhw_region *region,
                             const char *first_name, int first, const char *size_name, int size, int whole,
                             int block, const char *where)
{
    return rhw_check(context, first % block == 0,
                     "%s: region.%s is %d; blocks of %s are %d texels apart, it must be a multiple", where,
                     first_name, first, rhw_format_info(region->texture->format)->name, block) &&
           rhw_check(context, size % block == 0 || first + size == whole,
                     "%s: region.%s is %d; it must be a multiple of the %d texels of a block of %s, or end "
                     "with the level",
                     where, size_name, size, block, rhw_format_info(region->texture->format)->name);
}

// Check that a region is written by whole blocks. Blocks at the end of a level may stand out of it (Vulkan 1.3,
// vkCmdCopyBufferToImage, imageOffset and imageExtent).
static bool check_whole_blocks(const struct rhw_context *context, const struct rhw_region *region,
                               const char *where)
{
    const struct unit unit = unit_of(region, INTO_TEXTURE);
    const struct rhw_mip *const mip = &region->texture->mip[region->level];
    return check_block_axis(context, region, "x", region->x, "width", region->width, mip->width, unit.width,
                            where) &&
           check_block_axis(context, region, "y", region->y, "height", region->height, mip->height,
                            unit.height, where) &&
           rhw_texture_check_unread(context, region->id, region->texture, where);
}

// The caller's memory -------------------------------------------------------------------------------

static bool check_pitches(const struct rhw_context *context, const struct rhw_region *region,
                          enum direction direction, struct rows *rows, const char *where)
{
    const struct unit unit = unit_of(region, direction);
    const size_t row = row_size(region, unit);
    const int height = units(region->height, unit.height);
    rows->row_pitch = rows->row_pitch == 0 ? row : rows->row_pitch;
    if (!rhw_check(context, rows->first != NULL, "%s: data is NULL", where) ||
        !rhw_check(context, rows->row_pitch >= row, "%s: row_pitch is %zu; a row of the region has %zu bytes",
                   where, rows->row_pitch, row) ||
        !rhw_check(context, rows->row_pitch <= SIZE_MAX / (size_t)height,
                   "%s: row_pitch is %zu; %d such rows have no place in memory", where, rows->row_pitch,
                   height)) {
        return false;
    }
    const size_t slice = rows->row_pitch * (size_t)height;
    rows->slice_pitch = rows->slice_pitch == 0 ? slice : rows->slice_pitch;
    return rhw_check(context, rows->slice_pitch >= slice - rows->row_pitch + row,
                     "%s: slice_pitch is %zu; a slice of the region has %zu bytes", where, rows->slice_pitch,
                     slice - rows->row_pitch + row);
}

static enum rhw_result write_region(struct rhw_context *context, rhw_texture texture,
                                    const struct rhw_texture_region *region, struct rows *rows,
                                    const char *where)
{
    struct rhw_region checked = rhw_region_check(context, texture, region, "region", where);
    if (!checked.texture || !check_whole_blocks(context, &checked, where) ||
        !check_pitches(context, &checked, INTO_TEXTURE, rows, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_region_to_write(context, &checked)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    return write_rows(context, &checked, rows);
}

enum rhw_result rhw_texture_write_region(rhw_context *context, rhw_texture texture,
                                         const struct rhw_texture_region *region, const void *data,
                                         size_t row_pitch, size_t slice_pitch)
{
    static const char *const where = "rhw_texture_write_region";
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    // The rows are only read.
    struct rows rows = {(unsigned char *)data, row_pitch, slice_pitch};
    const enum rhw_result result = write_region(context, texture, region, &rows, where);
    rhw_context_leave(context);
    return result;
}

enum rhw_result rhw_texture_read_region(rhw_context *context, rhw_texture texture,
                                        const struct rhw_texture_region *region, void *data, size_t row_pitch,
                                        size_t slice_pitch)
{
    static const char *const where = "rhw_texture_read_region";
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    struct rows rows = {data, row_pitch, slice_pitch};
    const struct rhw_region checked = rhw_region_check(context, texture, region, "region", where);
    const bool is_valid = checked.texture && check_pitches(context, &checked, OUT_OF_TEXTURE, &rows, where);
    if (is_valid) {
        read_rows(&checked, &rows);
    }
    rhw_context_leave(context);
    return is_valid ? RHW_OK : RHW_ERROR_MISUSE;
}

// Buffers -------------------------------------------------------------------------------------------

static bool check_layout_blocks(const struct rhw_context *context, const struct rhw_texel_layout *layout,
                                struct unit unit, const char *where)
{
    return rhw_check(context, layout->row_length % unit.width == 0,
                     "%s: layout.row_length is %d; it must be a multiple of the %d texels of a block", where,
                     layout->row_length, unit.width) &&
           rhw_check(context, layout->image_height % unit.height == 0,
                     "%s: layout.image_height is %d; it must be a multiple of the %d texels of a block",
                     where, layout->image_height, unit.height);
}

// Find the bytes of a buffer from the layout's offset to the end of the last row. Sizes are at most 2^14 texels and
// 2^31 rows.
static bool check_layout(const struct rhw_context *context, const struct rhw_region *region,
                         enum direction direction, const struct rhw_texel_layout *layout,
                         struct rhw_buffer_part *part, struct rows *rows, const char *where)
{
    const struct unit unit = unit_of(region, direction);
    const int length = layout->row_length == 0 ? region->width : layout->row_length;
    const int height = layout->image_height == 0 ? region->height : layout->image_height;
    if (!rhw_check(context, length >= region->width, "%s: layout.row_length is %d; the region is %d wide",
                   where, length, region->width) ||
        !rhw_check(context, height >= region->height, "%s: layout.image_height is %d; the region is %d high",
                   where, height, region->height) ||
        !check_layout_blocks(context, layout, unit, where)) {
        return false;
    }
    // The numbers are exact. They exceed 64 bits only where the rows before the last one do.
    const uint64_t row = (uint64_t)units(length, unit.width) * unit.bytes;
    const uint64_t rows_of_slice = (uint64_t)units(height, unit.height);
    const uint64_t before =
        (uint64_t)(region->depth - 1) * rows_of_slice + (uint64_t)(units(region->height, unit.height) - 1);
    const uint64_t last = row_size(region, unit);
    const size_t size = part->data->size;
    const bool fits = layout->offset <= size && last <= size - layout->offset &&
                      (before == 0 || row <= (size - layout->offset - last) / before);
    part->first = layout->offset;
    part->end = fits ? layout->offset + (size_t)(before * row + last) : size;
    rows->row_pitch = (size_t)row;
    rows->slice_pitch = (size_t)(row * rows_of_slice);
    return rhw_check(context, fits,
                     "%s: layout.offset is %zu and %dx%dx%d texels follow in rows of %d; %s has %zu bytes",
                     where, layout->offset, region->width, region->height, region->depth, length,
                     rhw_name_of(&context->buffers, part->id.index).text, size);
}

static enum rhw_result copy_from_buffer(struct rhw_context *context, rhw_texture texture,
                                        const struct rhw_texture_region *region, rhw_buffer buffer,
                                        const struct rhw_texel_layout *layout)
{
    static const char *const where = "rhw_texture_copy_from_buffer";
    struct rhw_region checked = rhw_region_check(context, texture, region, "region", where);
    struct rhw_buffer_part part = {.id = buffer, .use = RHW_BUFFER_READ};
    part.data = checked.texture ? rhw_context_buffer(context, buffer, where) : NULL;
    struct rows rows;
    if (!part.data || !check_whole_blocks(context, &checked, where) ||
        !check_layout(context, &checked, INTO_TEXTURE, layout, &part, &rows, where) ||
        !rhw_buffer_check_readable(context, &part, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_region_to_write(context, &checked)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    rows.first = part.data->bytes + layout->offset;
    return write_rows(context, &checked, &rows);
}

static enum rhw_result copy_to_buffer(struct rhw_context *context, rhw_texture texture,
                                      const struct rhw_texture_region *region, rhw_buffer buffer,
                                      const struct rhw_texel_layout *layout)
{
    static const char *const where = "rhw_texture_copy_to_buffer";
    const struct rhw_region checked = rhw_region_check(context, texture, region, "region", where);
    struct rhw_buffer_part part = {.id = buffer, .use = RHW_BUFFER_WRITTEN};
    part.data = checked.texture ? rhw_context_buffer(context, buffer, where) : NULL;
    struct rows rows;
    if (!part.data || !check_layout(context, &checked, OUT_OF_TEXTURE, layout, &part, &rows, where) ||
        !rhw_buffer_check_writable(context, &part, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_buffer_to_write(context, &part, 0)) { // bytes behind the rows may stay
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    rows.first = part.data->bytes + layout->offset;
    read_rows(&checked, &rows);
    return RHW_OK;
}

static const struct rhw_texel_layout packed = {0};

enum rhw_result rhw_texture_copy_from_buffer(rhw_context *context, rhw_texture texture,
                                             const struct rhw_texture_region *region, rhw_buffer buffer,
                                             const struct rhw_texel_layout *layout)
{
    if (!rhw_context_enter(context, "rhw_texture_copy_from_buffer")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result =
        copy_from_buffer(context, texture, region, buffer, layout ? layout : &packed);
    rhw_context_leave(context);
    return result;
}

enum rhw_result rhw_texture_copy_to_buffer(rhw_context *context, rhw_texture texture,
                                           const struct rhw_texture_region *region, rhw_buffer buffer,
                                           const struct rhw_texel_layout *layout)
{
    if (!rhw_context_enter(context, "rhw_texture_copy_to_buffer")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result =
        copy_to_buffer(context, texture, region, buffer, layout ? layout : &packed);
    rhw_context_leave(context);
    return result;
}

// Textures ------------------------------------------------------------------------------------------

static bool have_color(const struct rhw_region *region)
{
    return !rhw_format_has_role(region->texture->info, RHW_ROLE_DEPTH_TARGET | RHW_ROLE_STENCIL_TARGET);
}

static bool check_formats(const struct rhw_context *context, const struct rhw_region *from,
                          const struct rhw_region *to, const char *where)
{
    const enum rhw_format a = from->texture->format, b = to->texture->format;
    const bool compatible = a == b || (have_color(from) && have_color(to) && from->texel == to->texel &&
                                       !rhw_block_format(a) && !rhw_block_format(b));
    return rhw_check(context, compatible,
                     "%s: %s is %s and %s is %s; formats are equal, or colour with texels of one size, not "
                     "compressed",
                     where, rhw_name_of(&context->textures, from->id.index).text, rhw_format_info(a)->name,
                     rhw_name_of(&context->textures, to->id.index).text, rhw_format_info(b)->name) &&
           rhw_check(context, from->is_stencil == to->is_stencil,
                     "%s: from.aspect and to.aspect differ; stencil is copied to stencil", where) &&
           rhw_check(context, from->texture->samples == to->texture->samples,
                     "%s: %s has %d samples and %s has %d; they must be equal", where,
                     rhw_name_of(&context->textures, from->id.index).text, from->texture->samples,
                     rhw_name_of(&context->textures, to->id.index).text, to->texture->samples);
}

static enum rhw_result copy_texture(struct rhw_context *context, rhw_texture from_texture,
                                    const struct rhw_texture_region *from_region, rhw_texture to_texture,
                                    const struct rhw_texture_region *to_region)
{
    static const char *const where = "rhw_texture_copy";
    struct rhw_region from = rhw_region_check(context, from_texture, from_region, "from", where);
    struct rhw_region to = {.texture = NULL};
    if (from.texture) {
        to = rhw_region_check_place(context, to_texture, to_region, &from, where);
    }
    if (!to.texture || !rhw_region_check_no_sample(context, from_region, "from", where) ||
        !rhw_region_check_no_sample(context, to_region, "to", where) ||
        !check_formats(context, &from, &to, where) || !rhw_region_check_apart(context, &from, &to, where) ||
        !rhw_texture_check_unread(context, to.id, to.texture, where)) {
        return RHW_ERROR_MISUSE;
    }
    // Where both regions are of one texture, it keeps its old texels until the pass ends, and `from` reads them.
    if (!rhw_region_to_write(context, &to)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    enum rhw_result result = RHW_OK;
    for (int sample = 0; sample < to.texture->samples && result == RHW_OK; sample++) {
        from.sample = to.sample = sample;
        const struct rhw_mip aspect = rhw_region_aspect(&from, sample);
        const struct rows rows = {rhw_region_row(&from, 0, 0), aspect.row_pitch, aspect.slice_pitch};
        result = write_texels(context, &to, &rows);
    }
    return result;
}

enum rhw_result rhw_texture_copy(rhw_context *context, rhw_texture from_texture,
                                 const struct rhw_texture_region *from, rhw_texture to_texture,
                                 const struct rhw_texture_region *to)
{
    if (!rhw_context_enter(context, "rhw_texture_copy")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = copy_texture(context, from_texture, from, to_texture, to);
    rhw_context_leave(context);
    return result;
}
