// SPDX-License-Identifier: MIT
// Textures are created and destroyed here. Levels are linear rows in one allocation; texture_copy.c reads and writes
// them.
#include "texture.h"

#include <string.h>

#include "clean_tiles.h"
#include "base/constants.h"
#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "context/lookup.h"
#include "base/memory.h"
#include "context/misuse.h"
#include "rhw/rhw.h"
#include "shared_texels.h"
#include "texture_shape.h"

static int level_size(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

// Set the table of a level. `first` is the number of bytes from the texture's memory to the level.
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

static size_t aligned_pitch(size_t row)
{
    return (row + RHW_ROW_ALIGNMENT - 1) & ~(size_t)(RHW_ROW_ALIGNMENT - 1);
}

// Return the bytes of a level's stencil aspect, all slices, where it lies behind another aspect.
static uint64_t stencil_size(const struct rhw_format_info *info, const struct rhw_mip *mip)
{
    const bool apart = rhw_format_has_role(info, RHW_ROLE_STENCIL_TARGET) &&
                       rhw_format_has_role(info, RHW_ROLE_DEPTH_TARGET);
    return apart ? (uint64_t)mip->stencil_pitch * (uint64_t)mip->height * (uint64_t)mip->slices : 0;
}

void rhw_texture_data_init(struct rhw_texture_data *texture, enum rhw_format format,
                           const struct rhw_texture_shape *shape)
{
    memset(texture, 0, sizeof *texture);
    texture->format = format;
    texture->info = rhw_format_info(rhw_format_decoded(format));
    texture->shape = *shape;
    texture->is_plain = shape->kind == RHW_TEXTURE_2D && !shape->is_array;
    texture->levels = shape->levels;
    texture->samples = shape->samples;
    texture->written = 1;
    for (int lane = 0; lane < RHW_LANES; lane++) {
        texture->last_level[lane] = (float)(texture->levels - 1);
    }
    uint64_t size = 0;
    for (int i = 0; i < texture->levels; i++) {
        struct rhw_mip *const mip = &texture->mip[i];
        mip->width = level_size(shape->width, i);
        mip->height = level_size(shape->height, i);
        mip->slices = shape->kind == RHW_TEXTURE_3D ? level_size(shape->depth, i) : shape->layers;
        mip->row_pitch = shape->row_pitch != 0 ? shape->row_pitch
                                               : aligned_pitch((size_t)mip->width * texture->info->size);
        mip->stencil_pitch = aligned_pitch((size_t)mip->width);
        const uint64_t slice = (uint64_t)mip->row_pitch * (uint64_t)mip->height;
        mip->slice_pitch = (size_t)slice;
        for (int lane = 0; lane < RHW_LANES; lane++) {
            mip->scale_x[lane] = (float)mip->width * 65536.0f;
            mip->scale_y[lane] = (float)mip->height * 65536.0f;
            mip->interior[lane] =
                mip->width > 1 && mip->height > 1 ? (mip->width - 2) << 16 | (mip->height - 2) : -1;
            mip->step[lane] = 1 << 16 | (int32_t)(mip->row_pitch / 4);
        }
        set_table(texture, i, size);
        size += slice * (uint64_t)mip->slices + stencil_size(texture->info, mip);
    }
    // 4 GiB and more do not fit where addresses have 32 bits: allocate_levels refuses SIZE_MAX.
    const uint64_t all = size * (uint64_t)shape->samples + RHW_TEXEL_PADDING;
    texture->memory_size = all > SIZE_MAX ? SIZE_MAX : (size_t)all;
    texture->sample_stride = (size_t)size;
}

static void place_levels(struct rhw_texture_data *texture, void *memory)
{
    unsigned char *next = memory;
    texture->memory = memory;
    for (int i = 0; i < texture->levels; i++) {
        struct rhw_mip *const mip = &texture->mip[i];
        const size_t stencil = (size_t)stencil_size(texture->info, mip);
        mip->texels = next;
        next += mip->slice_pitch * (size_t)mip->slices;
        if (rhw_format_has_role(texture->info, RHW_ROLE_STENCIL_TARGET)) {
            mip->stencil = stencil != 0 ? next : mip->texels;
        }
        next += stencil;
    }
}

// Allocate zeroed memory for all levels. Return false when out of memory.
static bool allocate_levels(struct rhw_memory *memory, struct rhw_texture_data *texture)
{
    void *const bytes = texture->memory_size != SIZE_MAX
                            ? rhw_memory_allocate_zeroed(memory, texture->memory_size, RHW_CACHE_LINE)
                            : NULL;
    if (bytes) {
        place_levels(texture, bytes);
    }
    return bytes != NULL;
}

void rhw_texture_data_destroy(struct rhw_memory *memory, struct rhw_texture_data *texture)
{
    if (texture->shared) {
        rhw_shared_texels_unbind(texture);
        rhw_shared_texels_release(memory, texture->shared);
    } else {
        rhw_memory_release(memory, texture->memory, texture->memory_size);
    }
    rhw_memory_release(memory, texture->linear_memory, texture->linear_size);
    rhw_clean_tiles_destroy(memory, texture->clean);
    rhw_memory_release(memory, texture, sizeof *texture);
}

struct rhw_texture_data *rhw_texture_data_create(struct rhw_memory *memory, enum rhw_format format,
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

struct rhw_texture_data *rhw_texture_data_create_on(struct rhw_memory *memory, enum rhw_format format,
                                                    const struct rhw_texture_shape *shape, void *bytes)
{
    struct rhw_texture_data *const data =
        rhw_memory_allocate(memory, sizeof *data, _Alignof(struct rhw_texture_data));
    if (!data) {
        return NULL;
    }
    rhw_texture_data_init(data, format, shape);
    place_levels(data, bytes);
    if (!rhw_texture_share(memory, data)) {
        rhw_memory_release(memory, data, sizeof *data);
        return NULL;
    }
    data->shared->is_callers = true;
    data->written = (1u << data->levels) - 1;
    return data;
}

// Public functions ----------------------------------------------------------------------------------

static bool check_create(const struct rhw_context *context, const struct rhw_texture_def *def,
                         const rhw_texture *texture)
{
    static const char *const where = "rhw_texture_create";
    return rhw_check(context, def != NULL, "%s: def is NULL", where) &&
           rhw_check(context, texture != NULL, "%s: texture is NULL", where) &&
           rhw_check_format(context, where, "format", def->format) &&
           rhw_texture_shape_check(context, def, where) && rhw_texture_memory_check(context, def, where);
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
    *item = def->memory ? rhw_texture_data_create_on(&context->memory, def->format, &shape, def->memory)
                        : rhw_texture_data_create(&context->memory, def->format, &shape);
    if (!*item) {
        rhw_pool_remove(&context->memory, &context->textures, id.index);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    if (def->memory) {
        (*item)->shared->is_told = def->memory_is_told;
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

// Return what rhw_context_texture gives, for a function that only looks.
static const struct rhw_texture_data *look_at(const struct rhw_context *context, rhw_texture texture,
                                              const char *where)
{
    return rhw_context_peek(context, where) ? rhw_context_texture(context, texture, where) : NULL;
}

int rhw_texture_width(const rhw_context *context, rhw_texture texture, int level)
{
    static const char *const where = "rhw_texture_width";
    const struct rhw_texture_data *const data = look_at(context, texture, where);
    return data && rhw_texture_check_level(context, texture, data, level, where) ? data->mip[level].width : 0;
}

int rhw_texture_height(const rhw_context *context, rhw_texture texture, int level)
{
    static const char *const where = "rhw_texture_height";
    const struct rhw_texture_data *const data = look_at(context, texture, where);
    return data && rhw_texture_check_level(context, texture, data, level, where) ? data->mip[level].height
                                                                                 : 0;
}

int rhw_texture_depth(const rhw_context *context, rhw_texture texture, int level)
{
    static const char *const where = "rhw_texture_depth";
    const struct rhw_texture_data *const data = look_at(context, texture, where);
    return !data || !rhw_texture_check_level(context, texture, data, level, where) ? 0
           : data->shape.kind == RHW_TEXTURE_3D                                    ? data->mip[level].slices
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

int rhw_texture_samples(const rhw_context *context, rhw_texture texture)
{
    const struct rhw_texture_data *const data = look_at(context, texture, "rhw_texture_samples");
    return data ? data->samples : 0;
}

enum rhw_format rhw_texture_format(const rhw_context *context, rhw_texture texture)
{
    const struct rhw_texture_data *const data = look_at(context, texture, "rhw_texture_format");
    return data ? data->format : RHW_FORMAT_NONE;
}

// Tell the program where rhw_texture_data_init put the texels.
static void tell_layout(const struct rhw_texture_data *texture, struct rhw_texture_layout *layout)
{
    *layout = (struct rhw_texture_layout){.size = texture->memory_size,
                                          .alignment = RHW_MEMORY_ALIGNMENT,
                                          .levels = texture->levels,
                                          .sample_stride = texture->sample_stride};
    const bool has_stencil = rhw_format_has_role(texture->info, RHW_ROLE_STENCIL_TARGET) &&
                             rhw_format_has_role(texture->info, RHW_ROLE_DEPTH_TARGET);
    size_t next = 0;
    for (int i = 0; i < texture->levels; i++) {
        const struct rhw_mip *const mip = &texture->mip[i];
        struct rhw_level_layout *const level = &layout->level[i];
        level->offset = next;
        level->row_pitch = mip->row_pitch;
        level->slice_pitch = mip->slice_pitch;
        next += mip->slice_pitch * (size_t)mip->slices;
        if (has_stencil) {
            level->stencil_offset = next;
            level->stencil_row_pitch = mip->stencil_pitch;
            level->stencil_slice_pitch = mip->stencil_pitch * (size_t)mip->height;
            next += level->stencil_slice_pitch * (size_t)mip->slices;
        }
    }
}

void rhw_texture_layout_of(const struct rhw_texture_def *def, struct rhw_texture_layout *layout)
{
    const struct rhw_texture_shape shape = rhw_texture_shape_of(def);
    struct rhw_texture_data texture;
    rhw_texture_data_init(&texture, def->format, &shape);
    tell_layout(&texture, layout);
}

enum rhw_result rhw_texture_query_layout(rhw_context *context, const struct rhw_texture_def *def,
                                         struct rhw_texture_layout *layout)
{
    static const char *const where = "rhw_texture_query_layout";
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const bool is_valid = rhw_check(context, def != NULL, "%s: def is NULL", where) &&
                          rhw_check(context, layout != NULL, "%s: layout is NULL", where) &&
                          rhw_check_format(context, where, "format", def->format) &&
                          rhw_texture_shape_check(context, def, where);
    if (is_valid) {
        rhw_texture_layout_of(def, layout);
    }
    rhw_context_leave(context);
    return is_valid ? RHW_OK : RHW_ERROR_MISUSE;
}
