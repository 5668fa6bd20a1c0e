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
#include "texture_shape.h"

static int level_size(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

// `first`: bytes from the texture's memory to the level.
static void set_table(struct rhw_texture_data *texture, int level, uint64_t first)
{
    const struct rhw_mip *const mip = &texture->mip[level];
    struct rhw_level_table *const table = &texture->table;
    const size_t size = texture->info->size;
    table->width[level] = mip->width;
    table->height[level] = mip->height;
    table->slices[level] = mip->slices;
    table->first[level] = (int32_t)(first / size);
    table->row[level] = (int32_t)(mip->row_pitch / size);
    table->slice[level] = (int32_t)(mip->slice_pitch / size);
}

void rhw_texture_data_init(struct rhw_texture_data *texture, enum rhw_format format,
                           const struct rhw_texture_shape *shape)
{
    memset(texture, 0, sizeof *texture);
    texture->format = format;
    texture->info = rhw_format_info(format);
    texture->shape = *shape;
    texture->is_plain = shape->kind == RHW_TEXTURE_2D && !shape->is_array;
    texture->levels = shape->levels;
    for (int lane = 0; lane < RHW_LANES; lane++) {
        texture->last_level[lane] = (float)(texture->levels - 1);
    }
    uint64_t size = RHW_TEXEL_PADDING;
    for (int i = 0; i < texture->levels; i++) {
        struct rhw_mip *const mip = &texture->mip[i];
        mip->width = level_size(shape->width, i);
        mip->height = level_size(shape->height, i);
        mip->slices = shape->kind == RHW_TEXTURE_3D ? level_size(shape->depth, i) : shape->layers;
        const size_t row = (size_t)mip->width * texture->info->size;
        mip->row_pitch = (row + RHW_ROW_ALIGNMENT - 1) & ~(size_t)(RHW_ROW_ALIGNMENT - 1);
        mip->slice_pitch = mip->row_pitch * (size_t)mip->height;
        for (int lane = 0; lane < RHW_LANES; lane++) {
            mip->scale_x[lane] = (float)mip->width * 65536.0f;
            mip->scale_y[lane] = (float)mip->height * 65536.0f;
            mip->interior[lane] =
                mip->width > 1 && mip->height > 1 ? (mip->width - 2) << 16 | (mip->height - 2) : -1;
            mip->step[lane] = 1 << 16 | (int32_t)(mip->row_pitch / 4);
        }
        set_table(texture, i, size - RHW_TEXEL_PADDING);
        size += (uint64_t)mip->slice_pitch * (uint64_t)mip->slices;
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
        next += texture->mip[i].slice_pitch * (size_t)texture->mip[i].slices;
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
static struct rhw_texture_data *create_data(struct rhw_memory *memory, enum rhw_format format,
                                            const struct rhw_texture_shape *shape)
{
    struct rhw_texture_data *const data =
        rhw_memory_allocate(memory, sizeof *data, _Alignof(struct rhw_texture_data));
    if (!data) {
        return NULL;
    }
    rhw_texture_data_init(data, format, shape);
    if (!allocate_levels(memory, data)) {
        rhw_memory_release(memory, data, sizeof *data);
        return NULL;
    }
    return data;
}

// Public functions ----------------------------------------------------------------------------------

static bool check_create(const struct rhw_context *context, const struct rhw_texture_def *def,
                         const rhw_texture *texture)
{
    static const char *const where = "rhw_texture_create";
    return rhw_check(context, def != NULL, "%s: def is NULL", where) &&
           rhw_check(context, texture != NULL, "%s: texture is NULL", where) &&
           rhw_check(context, rhw_format_valid(def->format), "%s: format is %d; not a texel format", where,
                     (int)def->format) &&
           rhw_texture_shape_check(context, def, where);
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
    const struct rhw_texture_shape shape = rhw_texture_shape_of(def);
    *item = create_data(&context->memory, def->format, &shape);
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

int rhw_texture_depth(const rhw_context *context, rhw_texture texture, int level)
{
    static const char *const where = "rhw_texture_depth";
    const struct rhw_texture_data *const data = look_at(context, texture, where);
    return !data || !check_level(context, texture, data, level, where) ? 0
           : data->shape.kind == RHW_TEXTURE_3D                        ? data->mip[level].slices
                                                                       : 1;
}

int rhw_texture_layers(const rhw_context *context, rhw_texture texture)
{
    const struct rhw_texture_data *const data = look_at(context, texture, "rhw_texture_layers");
    return data ? data->shape.layers : 0;
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

static struct copy check_copy(const struct rhw_context *context, rhw_texture id, int level, int layer,
                              const void *outside, size_t row_pitch, const char *where)
{
    const struct copy misuse = {.texture = NULL};
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    if (!texture || !check_unattached(context, id, texture, where) ||
        !check_level(context, id, texture, level, where) ||
        !rhw_texture_check_layer(context, id, texture, level, layer, where) ||
        !rhw_check(context, outside != NULL, "%s: data is NULL", where)) {
        return misuse;
    }
    const size_t row = (size_t)texture->mip[level].width * texture->info->size;
    const size_t pitch = row_pitch == 0 ? row : row_pitch;
    if (!rhw_check(context, pitch >= row, "%s: row_pitch is %zu; a row of level %d of %s has %zu bytes",
                   where, pitch, level, rhw_name_of(&context->textures, id.index).text, row)) {
        return misuse;
    }
    return (struct copy){texture, level, row, pitch};
}

// Gives the texture new memory with the same texels; draws that were recorded keep the old one. NULL when out of memory.
static struct rhw_texture_data *renew(struct rhw_context *context, rhw_texture id)
{
    struct rhw_texture_data **const item = rhw_pool_get(&context->textures, id.index, id.generation);
    const struct rhw_texture_data *const old = *item;
    struct rhw_texture_data *const data = create_data(&context->memory, old->format, &old->shape);
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

static enum rhw_result write_level(struct rhw_context *context, rhw_texture texture, int level, int layer,
                                   const void *data, size_t row_pitch, const char *where)
{
    const struct copy copy = check_copy(context, texture, level, layer, data, row_pitch, where);
    if (!copy.texture) {
        return RHW_ERROR_MISUSE;
    }
    const struct rhw_texture_data *const written = to_write(context, texture, copy.texture);
    if (!written) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    const struct rhw_mip *const mip = &written->mip[level];
    for (size_t y = 0; y < (size_t)mip->height; y++) {
        memcpy(rhw_mip_slice(mip, layer) + y * mip->row_pitch,
               (const unsigned char *)data + y * copy.row_pitch, copy.row);
    }
    return RHW_OK;
}

static enum rhw_result write_checked(rhw_context *context, rhw_texture texture, int level, int layer,
                                     const void *data, size_t row_pitch, const char *where)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = write_level(context, texture, level, layer, data, row_pitch, where);
    rhw_context_leave(context);
    return result;
}

enum rhw_result rhw_texture_write(rhw_context *context, rhw_texture texture, int level, const void *data,
                                  size_t row_pitch)
{
    return write_checked(context, texture, level, 0, data, row_pitch, "rhw_texture_write");
}

enum rhw_result rhw_texture_write_layer(rhw_context *context, rhw_texture texture, int level, int layer,
                                        const void *data, size_t row_pitch)
{
    return write_checked(context, texture, level, layer, data, row_pitch, "rhw_texture_write_layer");
}

static enum rhw_result read_checked(rhw_context *context, rhw_texture texture, int level, int layer,
                                    void *data, size_t row_pitch, const char *where)
{
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const struct copy copy = check_copy(context, texture, level, layer, data, row_pitch, where);
    const struct rhw_mip *const mip = copy.texture ? &copy.texture->mip[level] : NULL;
    for (size_t y = 0; mip && y < (size_t)mip->height; y++) {
        memcpy((unsigned char *)data + y * copy.row_pitch, rhw_mip_slice(mip, layer) + y * mip->row_pitch,
               copy.row);
    }
    rhw_context_leave(context);
    return mip ? RHW_OK : RHW_ERROR_MISUSE;
}

enum rhw_result rhw_texture_read(rhw_context *context, rhw_texture texture, int level, void *data,
                                 size_t row_pitch)
{
    return read_checked(context, texture, level, 0, data, row_pitch, "rhw_texture_read");
}

enum rhw_result rhw_texture_read_layer(rhw_context *context, rhw_texture texture, int level, int layer,
                                       void *data, size_t row_pitch)
{
    return read_checked(context, texture, level, layer, data, row_pitch, "rhw_texture_read_layer");
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
