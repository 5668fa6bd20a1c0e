// SPDX-License-Identifier: MIT
// See picture.h. What depends on where a lesson runs: threads, and files. tests/outside has one of its own. PNG through
// libspng: 8 bits, with a palette where 256 colours are enough, because flat drawings become several times smaller that
// way.
#include "picture.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <spng.h>

static _Noreturn void fail(const char *what, const char *why)
{
    fprintf(stderr, "%s: %s\n", what, why);
    exit(1);
}

static void *allocate(size_t size)
{
    void *memory = malloc(size);
    if (!memory) {
        fail("picture", "out of memory");
    }
    return memory;
}

static void write_file(const char *directory, const char *name, const void *head, size_t head_size,
                       const void *data, size_t size)
{
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s", directory, name) >= (int)sizeof path) {
        fail(directory, "path too long");
    }
    FILE *file = fopen(path, "wb");
    if (!file) {
        fail(path, strerror(errno));
    }
    const bool written = fwrite(head, 1, head_size, file) == head_size && fwrite(data, 1, size, file) == size;
    if (fclose(file) != 0 || !written) {
        const int error = errno;
        remove(path);
        fail(path, strerror(error));
    }
    printf("wrote %s\n", path);
}

static uint8_t *drop_alpha(size_t pixels, const uint8_t *rgba)
{
    uint8_t *rgb = allocate(pixels * 3);
    for (size_t i = 0; i < pixels; i++) {
        memcpy(rgb + i * 3, rgba + i * 4, 3);
    }
    return rgb;
}

// The pixels as numbers into a palette in order of first use, or NULL where 256 entries do not suffice.
static uint8_t *find_palette(size_t pixels, const uint8_t *rgb, struct spng_plte *palette)
{
    uint8_t *indices = allocate(pixels);
    palette->n_entries = 0;
    for (size_t i = 0; i < pixels; i++) {
        const uint8_t *color = rgb + i * 3;
        uint32_t entry = 0;
        while (entry < palette->n_entries &&
               (palette->entries[entry].red != color[0] || palette->entries[entry].green != color[1] ||
                palette->entries[entry].blue != color[2])) {
            entry++;
        }
        if (entry == 256) {
            free(indices);
            return NULL;
        }
        if (entry == palette->n_entries) {
            palette->entries[palette->n_entries++] =
                (struct spng_plte_entry){.red = color[0], .green = color[1], .blue = color[2]};
        }
        indices[i] = (uint8_t)entry;
    }
    return indices;
}

rhw_context *picture_context(void)
{
    rhw_context *context = NULL;
    const struct rhw_context_def def = rhw_context_def_default();
    must(rhw_context_create(&def, &context), "context");
    return context;
}

void picture_write_png(const char *directory, const char *name, int width, int height, const uint8_t *rgba)
{
    const size_t pixels = (size_t)width * (size_t)height;
    uint8_t *rgb = drop_alpha(pixels, rgba);
    struct spng_plte palette;
    uint8_t *indices = find_palette(pixels, rgb, &palette);
    struct spng_ihdr header = {.width = (uint32_t)width, .height = (uint32_t)height, .bit_depth = 8};
    header.color_type = indices ? SPNG_COLOR_TYPE_INDEXED : SPNG_COLOR_TYPE_TRUECOLOR;

    spng_ctx *png = spng_ctx_new(SPNG_CTX_ENCODER);
    int error = png ? 0 : SPNG_EMEM;
    if (!error) {
        spng_set_option(png, SPNG_ENCODE_TO_BUFFER, 1);
        spng_set_option(png, SPNG_IMG_COMPRESSION_LEVEL, 9);
        error = spng_set_ihdr(png, &header);
    }
    if (!error && indices) {
        error = spng_set_plte(png, &palette);
    }
    if (!error) {
        error = spng_encode_image(png, indices ? indices : rgb, indices ? pixels : pixels * 3, SPNG_FMT_PNG,
                                  SPNG_ENCODE_FINALIZE);
    }
    size_t size = 0;
    void *file = error ? NULL : spng_get_png_buffer(png, &size, &error);
    if (error) {
        fail(name, spng_strerror(error));
    }
    write_file(directory, name, "", 0, file, size);
    spng_ctx_free(png);
    free(file);
    free(indices);
    free(rgb);
}

void picture_write_ppm(const char *directory, const char *name, int width, int height, const uint8_t *rgba)
{
    char head[64];
    const int head_size = snprintf(head, sizeof head, "P6\n%d %d\n255\n", width, height);
    const size_t pixels = (size_t)width * (size_t)height;
    uint8_t *rgb = drop_alpha(pixels, rgba);
    write_file(directory, name, head, (size_t)head_size, rgb, pixels * 3);
    free(rgb);
}
