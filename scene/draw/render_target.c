// SPDX-License-Identifier: MIT
#include "render_target.h"

static enum rhw_result get(rhw_context *context, struct scene_target *target, enum rhw_format format,
                           int width, int height, int levels, int samples)
{
    if (target->texture.generation && target->format == format && target->width == width &&
        target->height == height && target->samples == samples) {
        return RHW_OK;
    }
    scene_target_destroy(context, target);
    *target = (struct scene_target){.format = format, .width = width, .height = height, .samples = samples};
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = width;
    def.height = height;
    def.mip_levels = levels;
    def.samples = samples;
    return rhw_texture_create(context, &def, &target->texture);
}

enum rhw_result scene_target_get(rhw_context *context, struct scene_target *target, enum rhw_format format,
                                 int width, int height)
{
    return get(context, target, format, width, height, 1, 1);
}

enum rhw_result scene_target_get_levels(rhw_context *context, struct scene_target *target,
                                        enum rhw_format format, int width, int height)
{
    return get(context, target, format, width, height, RHW_MIP_LEVELS_ALL, 1);
}

enum rhw_result scene_target_get_samples(rhw_context *context, struct scene_target *target,
                                         enum rhw_format format, int width, int height, int samples)
{
    return get(context, target, format, width, height, 1, samples);
}

void scene_target_destroy(rhw_context *context, struct scene_target *target)
{
    if (target->texture.generation) {
        rhw_texture_destroy(context, target->texture);
    }
    *target = (struct scene_target){0};
}

void scene_plane_destroy(rhw_context *context, struct scene_plane *plane)
{
    if (plane->texture.generation) {
        rhw_texture_destroy(context, plane->texture);
    }
    if (plane->buffer.generation) {
        rhw_buffer_destroy(context, plane->buffer);
    }
    *plane = (struct scene_plane){0};
}

enum rhw_result scene_plane_create(rhw_context *context, enum rhw_format format, int width, int height,
                                   struct scene_plane *plane)
{
    enum { ALIGNED = RHW_MEMORY_ALIGNMENT / (int)sizeof(float) };
    plane->pitch = (width + ALIGNED - 1) / ALIGNED * ALIGNED;
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = width;
    def.height = height;
    def.row_pitch = (size_t)plane->pitch * sizeof *plane->texels;
    struct rhw_texture_layout layout;
    enum rhw_result result = rhw_texture_query_layout(context, &def, &layout);
    if (result != RHW_OK) {
        return result;
    }
    struct rhw_buffer_def memory = rhw_buffer_def_default();
    memory.size = layout.size;
    result = rhw_buffer_create(context, &memory, &plane->buffer);
    if (result != RHW_OK) {
        return result;
    }
    void *bytes;
    result = rhw_buffer_map(context, plane->buffer, 0, 0, RHW_MAP_READ_WRITE, &bytes);
    if (result != RHW_OK) {
        return result;
    }
    plane->texels = bytes;
    def.memory = plane->texels;
    def.memory_size = layout.size;
    return rhw_texture_create(context, &def, &plane->texture);
}
