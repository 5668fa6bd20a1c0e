// SPDX-License-Identifier: MIT
// Textures: creation, upload and readback. Levels are linear rows in one allocation.
#include "texture.h"

#include <string.h>

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

static size_t aligned_pitch(size_t row)
{
    return (row + RHW_ROW_ALIGNMENT - 1) & ~(size_t)(RHW_ROW_ALIGNMENT - 1);
}

// Bytes of a level's plane of stencil where it lies behind another one.
static uint64_t stencil_size(const struct rhw_format_info *info, const struct rhw_mip *mip)
{
    const bool apart = rhw_format_has_role(info, RHW_ROLE_STENCIL_TARGET) &&
                       rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET);
    return apart ? (uint64_t)mip->stencil_pitch * (uint64_t)mip->height : 0;
}

void rhw_texture_data_init(struct rhw_texture_data *texture, enum rhw_format format, int width, int height,
                           int levels)
{
    memset(texture, 0, sizeof *texture);
    texture->format = format;
    texture->info = rhw_format_info(format);
    texture->levels = levels;
    texture->written = 1;
    for (int lane = 0; lane < RHW_LANES; lane++) {
        texture->last_level[lane] = (float)(texture->levels - 1);
    }
    uint64_t size = RHW_TEXEL_PADDING;
    for (int i = 0; i < texture->levels; i++) {
        struct rhw_mip *const mip = &texture->mip[i];
        mip->width = width >> i > 1 ? width >> i : 1;
        mip->height = height >> i > 1 ? height >> i : 1;
        mip->row_pitch = aligned_pitch((size_t)mip->width * texture->info->size);
        mip->stencil_pitch = aligned_pitch((size_t)mip->width);
        for (int lane = 0; lane < RHW_LANES; lane++) {
            mip->scale_x[lane] = (float)mip->width * 65536.0f;
            mip->scale_y[lane] = (float)mip->height * 65536.0f;
            mip->interior[lane] =
                mip->width > 1 && mip->height > 1 ? (mip->width - 2) << 16 | (mip->height - 2) : -1;
            mip->step[lane] = 1 << 16 | (int32_t)(mip->row_pitch / 4);
        }
        size += (uint64_t)mip->row_pitch * (uint64_t)mip->height + stencil_size(texture->info, mip);
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
        struct rhw_mip *const mip = &texture->mip[i];
        const size_t stencil = (size_t)stencil_size(texture->info, mip);
        mip->texels = next;
        next += mip->row_pitch * (size_t)mip->height;
        if (rhw_format_has_role(texture->info, RHW_ROLE_STENCIL_TARGET)) {
            mip->stencil = stencil != 0 ? next : mip->texels;
        }
        next += stencil;
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
        !rhw_check_format(context, where, "format", def->format) ||
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
    context->definition = def ? def->label : NULL;
    const enum rhw_result result = create(context, def, texture);
    context->definition = NULL;
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
    bool stencil;          // the plane of stencil
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

// What the caller named, apart from the texture.
struct copy_request {
    int level;
    bool stencil;
    const void *outside;
    size_t row_pitch;
};

static struct copy check_copy(const struct rhw_context *context, rhw_texture id,
                              const struct copy_request *request, const char *where)
{
    const struct copy misuse = {.texture = NULL};
    const int level = request->level;
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    if (!texture || !check_unattached(context, id, texture, where) ||
        !rhw_check(context, !request->stencil || rhw_format_has_role(texture->info, RHW_ROLE_STENCIL_TARGET),
                   "%s: %s is %s; that has no stencil", where, rhw_name_of(&context->textures, id.index).text,
                   texture->info->name) ||
        !check_level(context, id, texture, level, where) ||
        !rhw_check(context, request->outside != NULL, "%s: data is NULL", where)) {
        return misuse;
    }
    const size_t row = (size_t)texture->mip[level].width * (request->stencil ? 1 : texture->info->size);
    const size_t pitch = request->row_pitch == 0 ? row : request->row_pitch;
    if (!rhw_check(context, pitch >= row, "%s: row_pitch is %zu; a row of level %d of %s has %zu bytes",
                   where, pitch, level, rhw_name_of(&context->textures, id.index).text, row)) {
        return misuse;
    }
    return (struct copy){texture, level, request->stencil, row, pitch};
}

// The first byte of a row, inside.
static unsigned char *row_of(const struct copy *copy, size_t y)
{
    const struct rhw_mip *const mip = &copy->texture->mip[copy->level];
    return copy->stencil ? mip->stencil + y * mip->stencil_pitch : mip->texels + y * mip->row_pitch;
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
    data->written = old->written;
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

static enum rhw_result write_level(struct rhw_context *context, rhw_texture texture,
                                   const struct copy_request *request, const char *where)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    struct copy copy = check_copy(context, texture, request, where);
    const bool is_valid = copy.texture != NULL;
    copy.texture = is_valid ? to_write(context, texture, copy.texture) : NULL;
    if (copy.texture) {
        copy.texture->written |= 1u << copy.level;
    }
    for (size_t y = 0; copy.texture && y < (size_t)copy.texture->mip[copy.level].height; y++) {
        memcpy(row_of(&copy, y), (const unsigned char *)request->outside + y * copy.row_pitch, copy.row);
    }
    rhw_context_leave(context);
    return !is_valid ? RHW_ERROR_MISUSE : copy.texture ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
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
    const struct copy_request request = {level, false, data, row_pitch};
    return write_level(context, texture, &request, "rhw_texture_write");
}

enum rhw_result rhw_texture_read(rhw_context *context, rhw_texture texture, int level, void *data,
                                 size_t row_pitch)
{
    const struct copy_request request = {level, false, data, row_pitch};
    return read_level(context, texture, &request, data, "rhw_texture_read");
}

enum rhw_result rhw_texture_write_stencil(rhw_context *context, rhw_texture texture, int level,
                                          const uint8_t *data, size_t row_pitch)
{
    const struct copy_request request = {level, true, data, row_pitch};
    return write_level(context, texture, &request, "rhw_texture_write_stencil");
}

enum rhw_result rhw_texture_read_stencil(rhw_context *context, rhw_texture texture, int level, uint8_t *data,
                                         size_t row_pitch)
{
    const struct copy_request request = {level, true, data, row_pitch};
    return read_level(context, texture, &request, data, "rhw_texture_read_stencil");
}

static enum rhw_result generate_mips(struct rhw_context *context, rhw_texture texture)
{
    static const char *const where = "rhw_texture_generate_mips";
    struct rhw_texture_data *const data = rhw_context_texture(context, texture, where);
    if (!data || !check_unattached(context, texture, data, where) ||
        !rhw_check(context, rhw_format_has_role(data->info, RHW_ROLE_SAMPLED),
                   "%s: %s is %s; that format is not filtered", where,
                   rhw_name_of(&context->textures, texture.index).text, data->info->name)) {
        return RHW_ERROR_MISUSE;
    }
    struct rhw_texture_data *const target = to_write(context, texture, data);
    if (!target || !rhw_texture_data_generate_mips(context, target)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    target->written = (1u << target->levels) - 1;
    return RHW_OK;
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
