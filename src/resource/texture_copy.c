// SPDX-License-Identifier: MIT
// Programs write into textures and read from them here, and have mip levels made from the first one.
#include "texture.h"

#include <limits.h>
#include <string.h>

#include "format/block_format.h"
#include "block_level.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/given_up.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "texture_access.h"
#include "texture_shape.h"

// A level and the caller's rows: what writing and reading have in common.
struct copy {
    struct rhw_texture_data *texture; // NULL: the call was misuse
    int level, layer, sample;
    bool stencil;          // the stencil aspect
    size_t row, row_pitch; // bytes of a row; distance of the caller's rows
};

enum { NO_SAMPLE = INT_MIN }; // the caller names no sample

// What the caller named, apart from the texture.
struct copy_request {
    int level, layer;
    int sample; // NO_SAMPLE: the texture has one
    bool stencil;
    // The caller's rows are of texels, also where the texture's format has blocks.
    bool is_decoded;
    const void *outside;
    size_t row_pitch;
};

static bool check_sample(const struct rhw_context *context, rhw_texture id,
                         const struct rhw_texture_data *texture, int sample, const char *where)
{
    return rhw_check(context, sample != NO_SAMPLE || texture->samples == 1,
                     "%s: %s has %d samples; they are drawn into, and read by rhw_texture_read_sample", where,
                     rhw_name_of(&context->textures, id.index).text, texture->samples) &&
           rhw_check(context, sample == NO_SAMPLE || (sample >= 0 && sample < texture->samples),
                     "%s: sample is %d; %s has samples 0..%d", where, sample,
                     rhw_name_of(&context->textures, id.index).text, texture->samples - 1);
}

static struct copy check_copy(const struct rhw_context *context, rhw_texture id,
                              const struct copy_request *request, const char *where)
{
    const struct copy misuse = {.texture = NULL};
    const int level = request->level;
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    if (!texture || !rhw_texture_check_unattached(context, id, texture, where) ||
        !rhw_check(context, !request->stencil || rhw_format_has_role(texture->info, RHW_ROLE_STENCIL_TARGET),
                   "%s: %s is %s; that has no stencil", where, rhw_name_of(&context->textures, id.index).text,
                   texture->info->name) ||
        !check_sample(context, id, texture, request->sample, where) ||
        !rhw_texture_check_level(context, id, texture, level, where) ||
        !rhw_texture_check_layer(context, id, texture, level, request->layer, where) ||
        !rhw_check(context, request->outside != NULL, "%s: data is NULL", where)) {
        return misuse;
    }
    const enum rhw_format format =
        request->is_decoded ? rhw_format_decoded(texture->format) : texture->format;
    const int width = texture->mip[level].width;
    const size_t row = request->stencil ? (size_t)width : rhw_format_row_size(format, width);
    const size_t pitch = request->row_pitch == 0 ? row : request->row_pitch;
    if (!rhw_check(context, pitch >= row, "%s: row_pitch is %zu; a row of %slevel %d of %s has %zu bytes",
                   where, pitch, rhw_block_format(format) ? "blocks of " : "", level,
                   rhw_name_of(&context->textures, id.index).text, row)) {
        return misuse;
    }
    const int sample = request->sample == NO_SAMPLE ? 0 : request->sample;
    return (struct copy){texture, level, request->layer, sample, request->stencil, row, pitch};
}

// Return the first byte of a row inside of the texture.
static unsigned char *row_of(const struct copy *copy, size_t y)
{
    const struct rhw_mip *const mip = &copy->texture->mip[copy->level];
    const size_t sample = (size_t)copy->sample * copy->texture->sample_stride;
    const size_t stencil = mip->stencil_pitch * ((size_t)copy->layer * (size_t)mip->height + y);
    return sample +
           (copy->stencil ? mip->stencil + stencil : rhw_mip_slice(mip, copy->layer) + y * mip->row_pitch);
}

// Write rows that are texels, or blocks that become texels.
static enum rhw_result write_rows(struct rhw_context *context, const struct copy *copy, const void *outside)
{
    struct rhw_mip *const mip = &copy->texture->mip[copy->level];
    if (rhw_block_format(copy->texture->format)) {
        return rhw_decode_level(context, copy->texture->format, outside, copy->row_pitch, mip,
                                rhw_mip_slice(mip, copy->layer));
    }
    rhw_context_begin_work(context);
    const size_t rows = 1 + RHW_ASKED_BYTES / copy->row;
    for (size_t y = 0; y < (size_t)mip->height; y++) {
        if (y % rows == 0 && rhw_context_is_given_up(context, 0)) {
            return RHW_ERROR_GIVEN_UP;
        }
        memcpy(row_of(copy, y), (const unsigned char *)outside + y * copy->row_pitch, copy->row);
    }
    return RHW_OK;
}

static enum rhw_result write_level(struct rhw_context *context, rhw_texture texture,
                                   const struct copy_request *request, const char *where)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    struct copy copy = check_copy(context, texture, request, where);
    const bool is_valid = copy.texture && rhw_texture_check_unread(context, texture, copy.texture, where);
    copy.texture = is_valid ? rhw_texture_to_write(context, texture, copy.texture) : NULL;
    enum rhw_result result = is_valid ? RHW_ERROR_OUT_OF_MEMORY : RHW_ERROR_MISUSE;
    if (copy.texture) {
        copy.texture->written |= 1u << copy.level;
        result = write_rows(context, &copy, request->outside);
    }
    rhw_context_leave(context);
    return result;
}

static enum rhw_result read_level(struct rhw_context *context, rhw_texture texture,
                                  const struct copy_request *request, void *data, const char *where)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const struct copy copy = check_copy(context, texture, request, where);
    for (size_t y = 0; copy.texture && y < (size_t)copy.texture->mip[copy.level].height; y++) {
        memcpy((unsigned char *)data + y * copy.row_pitch, row_of(&copy, y), copy.row);
    }
    rhw_context_leave(context);
    return copy.texture ? RHW_OK : RHW_ERROR_MISUSE;
}

enum rhw_result rhw_texture_write(rhw_context *context, rhw_texture texture, int level, const void *data,
                                  size_t row_pitch)
{
    const struct copy_request request = {level, 0, NO_SAMPLE, false, false, data, row_pitch};
    return write_level(context, texture, &request, "rhw_texture_write");
}

enum rhw_result rhw_texture_read(rhw_context *context, rhw_texture texture, int level, void *data,
                                 size_t row_pitch)
{
    const struct copy_request request = {level, 0, NO_SAMPLE, false, true, data, row_pitch};
    return read_level(context, texture, &request, data, "rhw_texture_read");
}

enum rhw_result rhw_texture_write_layer(rhw_context *context, rhw_texture texture, int level, int layer,
                                        const void *data, size_t row_pitch)
{
    const struct copy_request request = {level, layer, NO_SAMPLE, false, false, data, row_pitch};
    return write_level(context, texture, &request, "rhw_texture_write_layer");
}

enum rhw_result rhw_texture_read_layer(rhw_context *context, rhw_texture texture, int level, int layer,
                                       void *data, size_t row_pitch)
{
    const struct copy_request request = {level, layer, NO_SAMPLE, false, true, data, row_pitch};
    return read_level(context, texture, &request, data, "rhw_texture_read_layer");
}

enum rhw_result rhw_texture_read_sample(rhw_context *context, rhw_texture texture, int sample, void *data,
                                        size_t row_pitch)
{
    const int named = sample == NO_SAMPLE ? -1 : sample;
    const struct copy_request request = {0, 0, named, false, true, data, row_pitch};
    return read_level(context, texture, &request, data, "rhw_texture_read_sample");
}

enum rhw_result rhw_texture_write_stencil(rhw_context *context, rhw_texture texture, int level,
                                          const uint8_t *data, size_t row_pitch)
{
    const struct copy_request request = {level, 0, NO_SAMPLE, true, true, data, row_pitch};
    return write_level(context, texture, &request, "rhw_texture_write_stencil");
}

enum rhw_result rhw_texture_read_stencil(rhw_context *context, rhw_texture texture, int level, uint8_t *data,
                                         size_t row_pitch)
{
    const struct copy_request request = {level, 0, NO_SAMPLE, true, true, data, row_pitch};
    return read_level(context, texture, &request, data, "rhw_texture_read_stencil");
}

static enum rhw_result generate_mips(struct rhw_context *context, rhw_texture texture)
{
    static const char *const where = "rhw_texture_generate_mips";
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    if (!data || !rhw_texture_check_unattached(context, texture, data, where) ||
        !rhw_check(context, !rhw_block_format(data->format),
                   "%s: %s is %s; levels of compressed formats are written", where,
                   rhw_name_of(&context->textures, texture.index).text,
                   rhw_format_info(data->format)->name) ||
        !rhw_check(context, rhw_format_has_role(data->info, RHW_ROLE_FILTERED),
                   "%s: %s is %s; that format is not filtered", where,
                   rhw_name_of(&context->textures, texture.index).text, data->info->name) ||
        !check_sample(context, texture, data, NO_SAMPLE, where) ||
        !rhw_texture_check_unread(context, texture, data, where)) {
        return RHW_ERROR_MISUSE;
    }
    struct rhw_texture_data *const target = rhw_texture_to_write(context, texture, data);
    const enum rhw_result result =
        target ? rhw_texture_data_generate_mips(context, target) : RHW_ERROR_OUT_OF_MEMORY;
    if (result == RHW_OK) {
        target->written = (1u << target->levels) - 1;
    }
    return result;
}

enum rhw_result rhw_texture_generate_mips(rhw_context *context, rhw_texture texture)
{
    if (!rhw_context_enter(context, "rhw_texture_generate_mips")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = generate_mips(context, texture);
    rhw_context_leave(context);
    return result;
}
