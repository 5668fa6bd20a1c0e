// SPDX-License-Identifier: MIT
// Sums of integers are exact, and sums of floats have one order, so the means are equal everywhere.
#include "reduce.h"

#include <stdlib.h>
#include <string.h>

#include "draw/shading/color.h"

enum { LIGHT_ONE = 1 << 20 }; // light of 1 in sums

bool scene_reduce_needed(uint32_t width, uint32_t height, uint32_t side)
{
    return side > 0 && (width > side || height > side);
}

static void reduced_size(uint32_t *width, uint32_t *height, uint32_t side)
{
    while (*width > side || *height > side) {
        *width = *width > 1 ? *width / 2 : 1;
        *height = *height > 1 ? *height / 2 : 1;
    }
}

bool scene_reducer_open(struct scene_reducer *reducer, uint32_t width, uint32_t height, uint32_t side,
                        bool is_color, struct scene_image *image)
{
    uint32_t across = width, down = height;
    reduced_size(&across, &down, side);
    *reducer = (struct scene_reducer){.width = width, .height = height, .image = image, .is_color = is_color};
    reducer->columns = malloc(width * sizeof *reducer->columns);
    reducer->counts = calloc(across, sizeof *reducer->counts);
    reducer->sums = calloc((size_t)across * 4, sizeof *reducer->sums);
    uint8_t *const texels = malloc((size_t)across * down * 4);
    if (!reducer->columns || !reducer->counts || !reducer->sums || !texels) {
        scene_reducer_close(reducer);
        free(texels);
        return false;
    }
    for (uint32_t x = 0; x < width; x++) {
        reducer->columns[x] = (uint32_t)((uint64_t)x * across / width);
        reducer->counts[reducer->columns[x]]++;
    }
    for (int code = 0; code < 256; code++) {
        reducer->light[code] = (uint32_t)(scene_color_decode((uint8_t)code) * (float)LIGHT_ONE + 0.5f);
    }
    image->type = SCENE_IMAGE_RGBA8;
    image->width = across;
    image->height = down;
    image->size = (size_t)across * down * 4;
    image->texels = texels;
    return true;
}

void scene_reducer_close(struct scene_reducer *reducer)
{
    free(reducer->columns);
    free(reducer->counts);
    free(reducer->sums);
}

// Return the code whose light is nearest.
static uint8_t encode(const uint32_t light[256], uint64_t mean)
{
    int low = 0, high = 255; // light[low] <= mean, or low is 0; mean < light[high + 1]
    while (low < high) {
        const int middle = (low + high + 1) / 2;
        if (light[middle] <= mean) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return (uint8_t)(low < 255 && light[low + 1] - mean < mean - light[low] ? low + 1 : low);
}

static void write_row(struct scene_reducer *reducer, uint8_t *row)
{
    const struct scene_image *const image = reducer->image;
    for (uint32_t x = 0; x < image->width; x++) {
        const uint64_t count = (uint64_t)reducer->counts[x] * reducer->rows_summed;
        for (uint32_t c = 0; c < 4; c++) {
            const uint64_t mean = (reducer->sums[4 * x + c] + count / 2) / count;
            row[4 * x + c] = reducer->is_color && c < 3 ? encode(reducer->light, mean) : (uint8_t)mean;
        }
    }
    memset(reducer->sums, 0, (size_t)image->width * 4 * sizeof *reducer->sums);
    reducer->rows_summed = 0;
}

void scene_reducer_add(struct scene_reducer *reducer, const uint8_t *row)
{
    const struct scene_image *const image = reducer->image;
    const uint32_t *const columns = reducer->columns;
    uint64_t *const sums = reducer->sums;
    const uint32_t *const light = reducer->light;
    for (uint32_t x = 0; x < reducer->width; x++) {
        uint64_t *const sum = &sums[(size_t)columns[x] * 4];
        for (uint32_t c = 0; c < 3; c++) {
            sum[c] += reducer->is_color ? light[row[4 * x + c]] : row[4 * x + c];
        }
        sum[3] += row[4 * x + 3];
    }
    reducer->rows_summed++;
    const uint32_t at = (uint32_t)((uint64_t)reducer->row * image->height / reducer->height);
    reducer->row++;
    const uint32_t next = (uint32_t)((uint64_t)reducer->row * image->height / reducer->height);
    if (next != at) {
        write_row(reducer, (uint8_t *)image->texels + (size_t)at * image->width * 4);
    }
}

// Reduce an image of floats, in the order of rows and columns.
static bool reduce_floats(struct scene_image *image, uint32_t side)
{
    uint32_t across = image->width, down = image->height;
    reduced_size(&across, &down, side);
    float *const texels = malloc((size_t)across * down * 4 * sizeof *texels);
    double *const sums = calloc((size_t)across * 4, sizeof *sums);
    uint32_t *const counts = calloc(across, sizeof *counts);
    if (!texels || !sums || !counts) {
        free(texels);
        free(sums);
        free(counts);
        return false;
    }
    const float *in = image->texels;
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++, in += 4) {
            const uint32_t column = (uint32_t)((uint64_t)x * across / image->width);
            counts[column]++;
            for (uint32_t c = 0; c < 4; c++) {
                sums[4 * column + c] += (double)in[c];
            }
        }
        const uint32_t at = (uint32_t)((uint64_t)y * down / image->height);
        const uint32_t next = (uint32_t)(((uint64_t)y + 1) * down / image->height);
        if (next != at) {
            for (uint32_t i = 0; i < across * 4; i++) {
                texels[(size_t)at * across * 4 + i] = (float)(sums[i] / counts[i / 4]);
            }
            memset(sums, 0, (size_t)across * 4 * sizeof *sums);
            memset(counts, 0, across * sizeof *counts);
        }
    }
    free(sums);
    free(counts);
    free(image->texels);
    image->texels = texels;
    image->width = across;
    image->height = down;
    image->size = (size_t)across * down * 4 * sizeof *texels;
    return true;
}

bool scene_reduce_image(struct scene_image *image, uint32_t side, bool is_color)
{
    if (image->type == SCENE_IMAGE_RGBA32F) {
        return reduce_floats(image, side);
    }
    struct scene_image reduced = *image;
    struct scene_reducer reducer;
    uint8_t *const row = malloc((size_t)image->width * 4);
    if (!row || !scene_reducer_open(&reducer, image->width, image->height, side, is_color, &reduced)) {
        free(row);
        return false;
    }
    const size_t values = (size_t)image->width * 4;
    for (uint32_t y = 0; y < image->height; y++) {
        if (image->type == SCENE_IMAGE_RGBA8) {
            scene_reducer_add(&reducer, (const uint8_t *)image->texels + y * values);
            continue;
        }
        const uint16_t *const in = (const uint16_t *)image->texels + y * values;
        for (size_t i = 0; i < values; i++) {
            row[i] = (uint8_t)((in[i] * 255u + 32767u) / 65535u);
        }
        scene_reducer_add(&reducer, row);
    }
    scene_reducer_close(&reducer);
    free(row);
    free(image->texels);
    *image = reduced;
    return true;
}
