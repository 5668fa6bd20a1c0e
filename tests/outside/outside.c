// SPDX-License-Identifier: MIT
// See outside.h. It is also the picture.h of the lessons, which end here without libspng and without files: a picture is
// a line with its name and FNV-1a of its RGBA8 pixels.
#include "outside.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures;

static void print_hash(const char *name, const unsigned char *bytes, size_t size)
{
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * 1099511628211u;
    }
    printf("%s %016" PRIx64 "\n", name, hash);
}

static void *read_texels(rhw_context *context, rhw_texture texture, int level, size_t *size)
{
    *size = rhw_format_size(rhw_texture_format(context, texture)) *
            (size_t)rhw_texture_width(context, texture, level) *
            (size_t)rhw_texture_height(context, texture, level);
    void *const texels = malloc(*size);
    must(texels ? rhw_texture_read(context, texture, level, texels, 0) : RHW_ERROR_OUT_OF_MEMORY, "read");
    return texels;
}

struct rhw_context_def outside_context_def(void)
{
    struct rhw_context_def def = rhw_context_def_default();
    const char *const threads = getenv("OUTSIDE_THREADS"), *const isa = getenv("OUTSIDE_ISA"),
                      *const validate = getenv("OUTSIDE_VALIDATE");
    if (threads) {
        def.threads = atoi(threads);
    }
    if (isa) {
        int number = 0;
        while (number < RHW_ISA_COUNT && strcmp(isa, rhw_isa_name((enum rhw_isa)number)) != 0) {
            number++;
        }
        must(number < RHW_ISA_COUNT ? RHW_OK : RHW_ERROR_MISUSE, isa);
        def.isa_limit = rhw_isa_up_to((enum rhw_isa)number);
    }
    if (validate) {
        def.validate = strcmp(validate, "on") == 0 ? RHW_VALIDATE_ON : RHW_VALIDATE_OFF;
    }
    return def;
}

void check(bool holds, const char *sentence)
{
    if (!holds) {
        fprintf(stderr, "does not hold: %s\n", sentence);
        failures++;
    }
}

int outside_status(void)
{
    return failures != 0;
}

void *outside_show(rhw_context *context, const char *name, rhw_texture texture)
{
    size_t size;
    void *const texels = read_texels(context, texture, 0, &size);
    print_hash(name, texels, size);
    return texels;
}

void must(enum rhw_result result, const char *what)
{
    if (result != RHW_OK) {
        fprintf(stderr, "%s: %s\n", what, rhw_result_string(result));
        exit(1);
    }
}

rhw_context *picture_context(void)
{
    const struct rhw_context_def def = outside_context_def();
    rhw_context *context = NULL;
    must(rhw_context_create(&def, &context), "context");
    return context;
}

rhw_texture picture_target(rhw_context *context, enum rhw_format format, int width, int height, int levels)
{
    const struct rhw_texture_def def = {
        .format = format, .width = width, .height = height, .mip_levels = levels};
    rhw_texture texture;
    must(rhw_texture_create(context, &def, &texture), "texture");
    return texture;
}

rhw_buffer picture_vertices(rhw_context *context, const void *data, size_t size)
{
    const struct rhw_buffer_def def = {.size = size, .data = data};
    rhw_buffer buffer;
    must(rhw_buffer_create(context, &def, &buffer), "vertex buffer");
    return buffer;
}

void picture_write_png(const char *directory, const char *name, int width, int height, const uint8_t *rgba)
{
    (void)directory;
    print_hash(name, rgba, (size_t)width * (size_t)height * 4);
}

void picture_write_ppm(const char *directory, const char *name, int width, int height, const uint8_t *rgba)
{
    picture_write_png(directory, name, width, height, rgba);
}

uint8_t *picture_read(rhw_context *context, rhw_texture texture, int level)
{
    size_t size;
    return read_texels(context, texture, level, &size);
}

void picture_save(rhw_context *context, rhw_texture texture, int level, const char *directory,
                  const char *name)
{
    (void)directory;
    size_t size;
    void *const texels = read_texels(context, texture, level, &size);
    print_hash(name, texels, size);
    free(texels);
}
