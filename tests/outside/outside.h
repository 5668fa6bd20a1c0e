// SPDX-License-Identifier: MIT
// What the programs of this folder share: options of the context, a number made of a picture, and checks.
// usage: PROGRAM [--threads N] [--isa NAME] [--validate on|off] [--pictures FOLDER]
#ifndef OUTSIDE_H
#define OUTSIDE_H

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/rhw.h>

struct outside {
    struct rhw_context_def context_def; ///< as the options say
    const char *pictures;               ///< folder for NAME.ppm, or NULL
    int failures;
};

static inline void outside_usage(const char *program)
{
    fprintf(stderr, "usage: %s [--threads N] [--isa NAME] [--validate on|off] [--pictures FOLDER]\n",
            program);
    exit(2);
}

static inline enum rhw_isa_limit outside_isa(const char *program, const char *name)
{
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (strcmp(name, rhw_isa_name((enum rhw_isa)isa)) == 0) {
            return rhw_isa_up_to((enum rhw_isa)isa);
        }
    }
    outside_usage(program);
    return RHW_ISA_BEST;
}

static inline struct outside outside_options(int argc, char **argv)
{
    struct outside outside = {.context_def = rhw_context_def_default()};
    for (int i = 1; i < argc; i += 2) {
        const char *const value = i + 1 < argc ? argv[i + 1] : "";
        if (strcmp(argv[i], "--threads") == 0) {
            outside.context_def.threads = atoi(value);
        } else if (strcmp(argv[i], "--isa") == 0) {
            outside.context_def.isa_limit = outside_isa(argv[0], value);
        } else if (strcmp(argv[i], "--validate") == 0) {
            outside.context_def.validate = strcmp(value, "on") == 0 ? RHW_VALIDATE_ON : RHW_VALIDATE_OFF;
        } else if (strcmp(argv[i], "--pictures") == 0) {
            outside.pictures = value;
        } else {
            outside_usage(argv[0]);
        }
    }
    return outside;
}

static inline void must(enum rhw_result result, const char *what)
{
    if (result != RHW_OK) {
        fprintf(stderr, "%s: %s\n", what, rhw_result_string(result));
        exit(1);
    }
}

// What was worked out by hand: a sentence that is said where it does not hold.
static inline void check(struct outside *outside, bool holds, const char *sentence)
{
    if (!holds) {
        fprintf(stderr, "does not hold: %s\n", sentence);
        outside->failures++;
    }
}

static inline void outside_write_ppm(const char *folder, const char *name, int width, int height,
                                     const unsigned char *pixels)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.ppm", folder, name);
    FILE *const file = fopen(path, "wb");
    if (!file) {
        perror(path);
        exit(1);
    }
    fprintf(file, "P6 %d %d 255\n", width, height);
    for (size_t i = 0; i < (size_t)width * (size_t)height; i++) {
        fwrite(&pixels[4 * i], 1, 3, file);
    }
    fclose(file);
}

// Prints `name` and FNV-1a of the texels of level 0; a picture of RGBA8 is written where the options say.
// Returns the texels, for the caller to free.
static inline void *outside_show(const struct outside *outside, rhw_context *context, const char *name,
                                 rhw_texture texture)
{
    const int width = rhw_texture_width(context, texture, 0),
              height = rhw_texture_height(context, texture, 0);
    const enum rhw_format format = rhw_texture_format(context, texture);
    const size_t size = rhw_format_size(format) * (size_t)width * (size_t)height;
    unsigned char *const texels = malloc(size);
    must(texels ? rhw_texture_read(context, texture, 0, texels, 0) : RHW_ERROR_OUT_OF_MEMORY, name);
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ texels[i]) * 1099511628211u;
    }
    printf("%s %016" PRIx64 "\n", name, hash);
    if (outside->pictures && (format == RHW_FORMAT_RGBA8_UNORM || format == RHW_FORMAT_RGBA8_SRGB)) {
        outside_write_ppm(outside->pictures, name, width, height, texels);
    }
    return texels;
}

#endif
