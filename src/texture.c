// SPDX-License-Identifier: MIT
// Textures: creation, upload and readback. Levels are linear rows in one allocation, of decoded texels where the format
// is a compressed one.
#include "texture.h"

#include <string.h>

#include "block_format.h"
#include "block_level.h"
#include "clean_tiles.h"
#include "constants.h"
#include "context.h"
#include "entry.h"
#include "format.h"
#include "lookup.h"
#include "memory.h"
#include "misuse.h"
#include "rhw/rhw.h"

int rhw_mip_chain_length(int width, int height)
{
    int levels = 1;
    for (int size = width > height ? width : height; size > 1; size >>= 1) {
        levels++;
    }
    return levels;
}

void rhw_texture_data_init(struct rhw_texture_data *texture, enum rhw_format format, int width, int height,
                           int levels)
{
    memset(texture, 0, sizeof *texture);
    texture->format = format;
    texture->info = rhw_format_info(rhw_format_decoded(format));
    texture->levels = levels;
    for (int lane = 0; lane < RHW_LANES; lane++) {
        texture->last_level[lane] = (float)(texture->levels - 1);
    }
    uint64_t size = RHW_TEXEL_PADDING;
    for (int i = 0; i < texture->levels; i++) {
        struct rhw_mip *const mip = &texture->mip[i];
        mip->width = width >> i > 1 ? width >> i : 1;
        mip->height = height >> i > 1 ? height >> i : 1;
        const size_t row = (size_t)mip->width * texture->info->size;
        mip->row_pitch = (row + RHW_ROW_ALIGNMENT - 1) & ~(size_t)(RHW_ROW_ALIGNMENT - 1);
        for (int lane = 0; lane < RHW_LANES; lane++) {
            mip->scale_x[lane] = (float)mip->width * 65536.0f;
            mip->scale_y[lane] = (float)mip->height * 65536.0f;
            mip->interior[lane] =
                mip->width > 1 && mip->height > 1 ? (mip->width - 2) << 16 | (mip->height - 2) : -1;
            mip->step[lane] = 1 << 16 | (int32_t)(mip->row_pitch / 4);
        }
        size += (uint64_t)mip->row_pitch * (uint64_t)mip->height;
    }
    // 4 GiB and more do not fit where addresses have 32 bits: allocate_levels refuses SIZE_MAX.
    texture->memory_size = size > SIZE_MAX ? SIZE_MAX : (size_t)size;
}

// Zeroed memory of all levels. False when out of memory.
static bool allocate_levels(struct rhw_memory *memory, struct rhw_texture_data *texture)
{
    if (texture->memory_size == SIZE_MAX) {
        return false;
    }
    unsigned char *next = rhw_memory_allocate_zeroed(memory, texture->memory_size, RHW_CACHE_LINE);
    if (!next) {
        return false;
    }
    texture->memory = next;
    for (int i = 0; i < texture->levels; i++) {
        texture->mip[i].texels = next;
        next += texture->mip[i].row_pitch * (size_t)texture->mip[i].height;
    }
    return true;
}

void rhw_texture_data_destroy(struct rhw_memory *memory, struct rhw_texture_data *texture)
{
    rhw_memory_release(memory, texture->memory, texture->memory_size);
    rhw_memory_release(memory, texture->linear_memory, texture->linear_size);
    rhw_clean_tiles_destroy(memory, texture->clean);
    rhw_memory_release(memory, texture, sizeof *texture);
}

// With zeroed texels; NULL when out of memory.
static struct rhw_texture_data *create_data(struct rhw_memory *memory, enum rhw_format format, int width,
                                            int height, int levels)
{
    struct rhw_texture_data *const data =
        rhw_memory_allocate(memory, sizeof *data, _Alignof(struct rhw_texture_data));
    if (!data) {
        return NULL;
    }
    rhw_texture_data_init(data, format, width, height, levels);
    if (!allocate_levels(memory, data)) {
        rhw_memory_release(memory, data, sizeof *data);
        return NULL;
    }
    return data;
}

// Public functions ----------------------------------------------------------------------------------

static bool check_size(const struct rhw_context *context, const char *field, int value)
{
    return rhw_check(context, value >= 1 && value <= RHW_MAX_TARGET_SIZE,
                     "rhw_texture_create: %s is %d; it must be 1..%d", field, value, RHW_MAX_TARGET_SIZE);
}

static bool check_create(const struct rhw_context *context, const struct rhw_texture_def *def,
                         const rhw_texture *texture)
{
    static const char *const where = "rhw_texture_create";
    if (!rhw_check(context, def != NULL, "%s: def is NULL", where) ||
        !rhw_check(context, texture != NULL, "%s: texture is NULL", where) ||
        !rhw_check(context, rhw_format_valid(def->format), "%s: format is %d; not a texel format", where,
                   (int)def->format) ||
        !check_size(context, "width", def->width) || !check_size(context, "height", def->height)) {
        return false;
    }
    const int chain = rhw_mip_chain_length(def->width, def->height);
    return rhw_check(context, def->mip_levels >= RHW_MIP_LEVELS_ALL && def->mip_levels <= chain,
                     "%s: mip_levels is %d; a %dx%d texture has 1..%d (RHW_MIP_LEVELS_ALL is -1)", where,
                     def->mip_levels, def->width, def->height, chain);
}

static int level_count(const struct rhw_texture_def *def)
{
    return def->mip_levels == RHW_MIP_LEVELS_ALL ? rhw_mip_chain_length(def->width, def->height)
           : def->mip_levels == 0                ? 1
                                                 : def->mip_levels;
}

static enum rhw_result create(struct rhw_context *context, const struct rhw_texture_def *def,
                              rhw_texture *texture)
{
    if (!check_create(context, def, texture)) {
        return RHW_ERROR_MISUSE;
    }
    rhw_texture id = {.context = context->number};
    struct rhw_texture_data **const item =
        rhw_pool_add(&context->memory, &context->textures, def->label, &id.index, &id.generation);
    if (!item) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *item = create_data(&context->memory, def->format, def->width, def->height, level_count(def));
    if (!*item) {
        rhw_pool_remove(&context->memory, &context->textures, id.index);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *texture = id;
    return RHW_OK;
}

enum rhw_result rhw_texture_create(rhw_context *context, const struct rhw_texture_def *def,
                                   rhw_texture *texture)
{
    if (texture) {
        *texture = (rhw_texture){0};
    }
    if (!rhw_context_enter(context, "rhw_texture_create")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = create(context, def, texture);
    rhw_context_leave(context);
    return result;
}

void rhw_texture_destroy(rhw_context *context, rhw_texture texture)
{
    static const char *const where = "rhw_texture_destroy";
    if (texture.index == 0 || !rhw_context_enter(context, where)) {
        return;
    }
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    if (data && rhw_context_records(context, &context->textures, texture.index)) {
        rhw_pool_retire(&context->memory, &context->textures, texture.index);
    } else if (data) {
        rhw_texture_data_destroy(&context->memory, data);
        rhw_pool_remove(&context->memory, &context->textures, texture.index);
    }
    rhw_context_leave(context);
}

// What rhw_context_texture gives to a function that only looks.
static const struct rhw_texture_data *look_at(const struct rhw_context *context, rhw_texture texture,
                                              const char *where)
{
    return rhw_context_peek(context, where) ? rhw_context_texture(context, texture, where) : NULL;
}

static bool check_level(const struct rhw_context *context, rhw_texture texture,
                        const struct rhw_texture_data *data, int level, const char *where)
{
    return rhw_check(context, level >= 0 && level < data->levels, "%s: level is %d; %s has levels 0..%d",
                     where, level, rhw_name_of(&context->textures, texture.index).text, data->levels - 1);
}

int rhw_texture_width(const rhw_context *context, rhw_texture texture, int level)
{
    static const char *const where = "rhw_texture_width";
    const struct rhw_texture_data *const data = look_at(context, texture, where);
    return data && check_level(context, texture, data, level, where) ? data->mip[level].width : 0;
}

int rhw_texture_height(const rhw_context *context, rhw_texture texture, int level)
{
    static const char *const where = "rhw_texture_height";
    const struct rhw_texture_data *const data = look_at(context, texture, where);
    return data && check_level(context, texture, data, level, where) ? data->mip[level].height : 0;
}

int rhw_texture_mip_levels(const rhw_context *context, rhw_texture texture)
{
    const struct rhw_texture_data *const data = look_at(context, texture, "rhw_texture_mip_levels");
    return data ? data->levels : 0;
}

enum rhw_format rhw_texture_format(const rhw_context *context, rhw_texture texture)
{
    const struct rhw_texture_data *const data = look_at(context, texture, "rhw_texture_format");
    return data ? data->format : RHW_FORMAT_NONE;
}

// Reading and writing -------------------------------------------------------------------------------

// A level and the caller's rows, as write and read have them in common.
struct copy {
    struct rhw_texture_data *texture; // NULL: the call was misuse
    int level;
    size_t row, row_pitch; // bytes of a row; distance of the caller's rows
};

// What an attachment holds is known when its pass has ended.
static bool check_unattached(const struct rhw_context *context, rhw_texture id,
                             const struct rhw_texture_data *texture, const char *where)
{
    const struct rhw_recording *const recording = &context->recording;
    return rhw_check(context, !recording->active || texture->attached != recording->generation,
                     "%s: %s is an attachment of the pass being recorded; end that first", where,
                     rhw_name_of(&context->textures, id.index).text);
}

// `is_decoded`: the caller's rows are of texels, also where the texture's format has blocks.
static struct copy check_copy(const struct rhw_context *context, rhw_texture id, int level, bool is_decoded,
                              const void *outside, size_t row_pitch, const char *where)
{
    const struct copy misuse = {.texture = NULL};
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    if (!texture || !check_unattached(context, id, texture, where) ||
        !check_level(context, id, texture, level, where) ||
        !rhw_check(context, outside != NULL, "%s: data is NULL", where)) {
        return misuse;
    }
    const enum rhw_format format = is_decoded ? rhw_format_decoded(texture->format) : texture->format;
    const size_t row = rhw_format_row_size(format, texture->mip[level].width);
    const size_t pitch = row_pitch == 0 ? row : row_pitch;
    if (!rhw_check(context, pitch >= row, "%s: row_pitch is %zu; a row of %slevel %d of %s has %zu bytes",
                   where, pitch, rhw_block_format(format) ? "blocks of " : "", level,
                   rhw_name_of(&context->textures, id.index).text, row)) {
        return misuse;
    }
    return (struct copy){texture, level, row, pitch};
}

// Gives the texture new memory with the same texels; draws that were recorded keep the old one. NULL when out of memory.
static struct rhw_texture_data *renew(struct rhw_context *context, rhw_texture id)
{
    struct rhw_texture_data **const item = rhw_pool_get(&context->textures, id.index, id.generation);
    const struct rhw_texture_data *const old = *item;
    struct rhw_texture_data *const data =
        create_data(&context->memory, old->format, old->mip[0].width, old->mip[0].height, old->levels);
    if (!data) {
        return NULL;
    }
    if (!rhw_pool_retire_copy(&context->memory, &context->textures, id.index)) {
        rhw_texture_data_destroy(&context->memory, data);
        return NULL;
    }
    memcpy(data->memory, old->memory, old->memory_size);
    data->renewed_pass = context->recording.generation;
    data->renewed_draws = context->recording.draw;
    *item = data;
    return data;
}

// The texture as it may be written now; NULL when out of memory.
static struct rhw_texture_data *to_write(struct rhw_context *context, rhw_texture id,
                                         struct rhw_texture_data *texture)
{
    const bool read = rhw_context_draws_read(context, &context->textures, id.index, texture->renewed_pass,
                                             texture->renewed_draws);
    struct rhw_texture_data *const written = read ? renew(context, id) : texture;
    if (written) {
        context->recording.rewrites += rhw_context_records(context, &context->textures, id.index);
        written->linear_is_current = false;
        rhw_clean_tiles_forget(written->clean);
    }
    return written;
}

static enum rhw_result write_level(struct rhw_context *context, rhw_texture texture, int level,
                                   const void *data, size_t row_pitch)
{
    const struct copy copy = check_copy(context, texture, level, false, data, row_pitch, "rhw_texture_write");
    if (!copy.texture) {
        return RHW_ERROR_MISUSE;
    }
    const struct rhw_texture_data *const written = to_write(context, texture, copy.texture);
    if (!written) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    const struct rhw_mip *const mip = &written->mip[level];
    if (rhw_block_format(written->format)) {
        rhw_decode_level(context, written->format, data, copy.row_pitch, mip, mip->texels);
        return RHW_OK;
    }
    for (size_t y = 0; y < (size_t)mip->height; y++) {
        memcpy(mip->texels + y * mip->row_pitch, (const unsigned char *)data + y * copy.row_pitch, copy.row);
    }
    return RHW_OK;
}

enum rhw_result rhw_texture_write(rhw_context *context, rhw_texture texture, int level, const void *data,
                                  size_t row_pitch)
{
    if (!rhw_context_enter(context, "rhw_texture_write")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = write_level(context, texture, level, data, row_pitch);
    rhw_context_leave(context);
    return result;
}

enum rhw_result rhw_texture_read(rhw_context *context, rhw_texture texture, int level, void *data,
                                 size_t row_pitch)
{
    static const char *const where = "rhw_texture_read";
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const struct copy copy = check_copy(context, texture, level, true, data, row_pitch, where);
    const struct rhw_mip *const mip = copy.texture ? &copy.texture->mip[level] : NULL;
    for (size_t y = 0; mip && y < (size_t)mip->height; y++) {
        memcpy((unsigned char *)data + y * copy.row_pitch, mip->texels + y * mip->row_pitch, copy.row);
    }
    rhw_context_leave(context);
    return mip ? RHW_OK : RHW_ERROR_MISUSE;
}

static enum rhw_result generate_mips(struct rhw_context *context, rhw_texture texture)
{
    static const char *const where = "rhw_texture_generate_mips";
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    if (!data || !check_unattached(context, texture, data, where) ||
        !rhw_check(context, !rhw_block_format(data->format),
                   "%s: %s is %s; levels of compressed formats are written", where,
                   rhw_name_of(&context->textures, texture.index).text,
                   rhw_format_info(data->format)->name) ||
        !rhw_check(context, rhw_format_has_role(data->info, RHW_ROLE_SAMPLED),
                   "%s: %s is %s; that format is not filtered", where,
                   rhw_name_of(&context->textures, texture.index).text, data->info->name)) {
        return RHW_ERROR_MISUSE;
    }
    const struct rhw_texture_data *const written = to_write(context, texture, data);
    return written && rhw_texture_data_generate_mips(context, written) ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
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
