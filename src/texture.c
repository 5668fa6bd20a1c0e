// SPDX-License-Identifier: MIT
// Textures: creation, upload and readback. Levels are linear rows in one allocation.
#include "texture.h"

#include <string.h>

#include "clean_tiles.h"
#include "constants.h"
#include "context.h"
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
    texture->info = rhw_format_info(format);
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

void rhw_texture_data_release(struct rhw_memory *memory, struct rhw_texture_data *texture)
{
    rhw_memory_release(memory, texture->memory, texture->memory_size);
    rhw_memory_release(memory, texture->linear_memory, texture->linear_size);
    rhw_clean_tiles_destroy(memory, texture->clean);
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
    if (!rhw_check(context, context != NULL, "%s: context is NULL", where) ||
        !rhw_check(context, def != NULL, "%s: def is NULL", where) ||
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

enum rhw_result rhw_texture_create(rhw_context *context, const struct rhw_texture_def *def,
                                   rhw_texture *texture)
{
    if (texture) {
        *texture = (rhw_texture){0, 0};
    }
    if (!check_create(context, def, texture)) {
        return RHW_ERROR_MISUSE;
    }
    rhw_texture id;
    struct rhw_texture_data *const data =
        rhw_pool_add(&context->memory, &context->textures, &id.index, &id.generation);
    if (!data) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    rhw_texture_data_init(data, def->format, def->width, def->height, level_count(def));
    if (!allocate_levels(&context->memory, data)) {
        rhw_pool_remove(&context->textures, id.index);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *texture = id;
    return RHW_OK;
}

void rhw_texture_destroy(rhw_context *context, rhw_texture texture)
{
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, "rhw_texture_destroy");
    if (data && rhw_context_check_idle(context, &context->textures, texture.index, "rhw_texture_destroy")) {
        rhw_texture_data_release(&context->memory, data);
        rhw_pool_remove(&context->textures, texture.index);
    }
}

static bool check_level(const struct rhw_context *context, const struct rhw_texture_data *data, int level,
                        const char *where)
{
    return rhw_check(context, level >= 0 && level < data->levels,
                     "%s: level is %d; the texture has levels 0..%d", where, level, data->levels - 1);
}

int rhw_texture_width(const rhw_context *context, rhw_texture texture, int level)
{
    static const char *const where = "rhw_texture_width";
    const struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    return data && check_level(context, data, level, where) ? data->mip[level].width : 0;
}

int rhw_texture_height(const rhw_context *context, rhw_texture texture, int level)
{
    static const char *const where = "rhw_texture_height";
    const struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    return data && check_level(context, data, level, where) ? data->mip[level].height : 0;
}

int rhw_texture_mip_levels(const rhw_context *context, rhw_texture texture)
{
    const struct rhw_texture_data *const data =
        rhw_context_texture(context, texture, "rhw_texture_mip_levels");
    return data ? data->levels : 0;
}

enum rhw_format rhw_texture_format(const rhw_context *context, rhw_texture texture)
{
    const struct rhw_texture_data *const data = rhw_context_texture(context, texture, "rhw_texture_format");
    return data ? data->format : RHW_FORMAT_NONE;
}

// Checks what write and read have in common; NULL when the call must not go on.
// *row is the bytes of a row, *pitch the distance of rows outside.
static const struct rhw_mip *begin_copy(struct rhw_context *context, rhw_texture texture, int level,
                                        const void *outside, size_t *row, size_t *pitch, const char *where)
{
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    if (!data || !rhw_context_check_idle(context, &context->textures, texture.index, where) ||
        !check_level(context, data, level, where) ||
        !rhw_check(context, outside != NULL, "%s: data is NULL", where)) {
        return NULL;
    }
    const struct rhw_mip *const mip = &data->mip[level];
    *row = (size_t)mip->width * data->info->size;
    if (*pitch == 0) {
        *pitch = *row;
    }
    if (!rhw_check(context, *pitch >= *row, "%s: row_pitch is %zu; a row of level %d has %zu bytes", where,
                   *pitch, level, *row)) {
        return NULL;
    }
    return mip;
}

void rhw_texture_write(rhw_context *context, rhw_texture texture, int level, const void *data,
                       size_t row_pitch)
{
    static const char *const where = "rhw_texture_write";
    size_t row;
    const struct rhw_mip *const mip = begin_copy(context, texture, level, data, &row, &row_pitch, where);
    if (!mip) {
        return;
    }
    struct rhw_texture_data *const written = rhw_context_texture(context, texture, where);
    written->linear_is_current = false;
    rhw_clean_tiles_forget(written->clean);
    for (int y = 0; y < mip->height; y++) {
        memcpy(mip->texels + (size_t)y * mip->row_pitch, (const unsigned char *)data + (size_t)y * row_pitch,
               row);
    }
}

void rhw_texture_read(rhw_context *context, rhw_texture texture, int level, void *data, size_t row_pitch)
{
    size_t row;
    const struct rhw_mip *const mip =
        begin_copy(context, texture, level, data, &row, &row_pitch, "rhw_texture_read");
    for (int y = 0; mip && y < mip->height; y++) {
        memcpy((unsigned char *)data + (size_t)y * row_pitch, mip->texels + (size_t)y * mip->row_pitch, row);
    }
}

enum rhw_result rhw_texture_generate_mips(rhw_context *context, rhw_texture texture)
{
    static const char *const where = "rhw_texture_generate_mips";
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    if (!data || !rhw_context_check_idle(context, &context->textures, texture.index, where) ||
        !rhw_check(context, rhw_format_has_role(data->info, RHW_ROLE_SAMPLED),
                   "%s: the texture is %s; that format is not filtered", where, data->info->name)) {
        return RHW_ERROR_MISUSE;
    }
    const bool done = rhw_texture_data_generate_mips(context, data);
    data->linear_is_current = false;
    return done ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
}
