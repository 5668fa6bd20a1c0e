// SPDX-License-Identifier: MIT
// See picture.h. What depends on where a lesson runs stands in picture_host.c.
#include "picture.h"

#include <stdio.h>
#include <stdlib.h>

void must(enum rhw_result result, const char *what)
{
    if (result != RHW_OK) {
        fprintf(stderr, "%s: %s\n", what, rhw_result_string(result));
        exit(1);
    }
}

rhw_texture picture_target(rhw_context *context, enum rhw_format format, int width, int height, int levels)
{
    rhw_texture texture;
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = width;
    def.height = height;
    def.mip_levels = levels;
    must(rhw_texture_create(context, &def, &texture), "texture");
    return texture;
}

rhw_buffer picture_vertices(rhw_context *context, const void *data, size_t size)
{
    rhw_buffer buffer;
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = size;
    def.data = data;
    must(rhw_buffer_create(context, &def, &buffer), "vertex buffer");
    return buffer;
}

uint8_t *picture_read(rhw_context *context, rhw_texture texture, int level)
{
    const size_t width = (size_t)rhw_texture_width(context, texture, level);
    const size_t height = (size_t)rhw_texture_height(context, texture, level);
    uint8_t *rgba = malloc(width * height * 4);
    must(rgba ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY, "picture");
    rhw_texture_read(context, texture, level, rgba, 0);
    return rgba;
}

void picture_save(rhw_context *context, rhw_texture texture, int level, const char *directory,
                  const char *name)
{
    uint8_t *rgba = picture_read(context, texture, level);
    picture_write_png(directory, name, rhw_texture_width(context, texture, level),
                      rhw_texture_height(context, texture, level), rgba);
    free(rgba);
}
