// SPDX-License-Identifier: MIT
// Mip generation. Each level is the box-filtered level above, in linear light, in floats: levels are
// rounded to the texture's format when stored, never in between, so that errors do not add up from level
// to level. Odd sizes take the polyphase box of three texels, whose weights make every texel of the level
// above count the same (W. Donnelly, "Non-power-of-two mipmapping", NVIDIA 2005).
#include <string.h>

#include "constants.h"
#include "memory.h"
#include "texel.h"
#include "texture.h"

// The four channels of a texel as texel.h has them.
typedef float texel4 __attribute__((vector_size(16)));

static texel4 load_texel(const struct rhw_format_info *format, const unsigned char *from)
{
    float channels[4];
    texel4 value;
    rhw_texel_load(format, from, channels);
    memcpy(&value, channels, sizeof value);
    return value;
}

static void store_texel(const struct rhw_format_info *format, texel4 value, unsigned char *to)
{
    float channels[4];
    memcpy(channels, &value, sizeof channels);
    rhw_texel_store(format, channels, to);
}

// What one texel of the smaller level takes along one axis: texels first, first + 1, .. of the larger.
struct taps {
    int first, count;
    float weight[3];
};

static struct taps taps_of(int larger, int smaller, int i)
{
    if (larger == 1) {
        return (struct taps){0, 1, {1.0f, 0.0f, 0.0f}};
    }
    if (larger % 2 == 0) {
        return (struct taps){2 * i, 2, {0.5f, 0.5f, 0.0f}};
    }
    // The box is larger/smaller = 2 + 1/smaller texels wide and starts i/smaller into texel 2i.
    const float width = (float)larger;
    return (struct taps){
        2 * i, 3, {(float)(smaller - i) / width, (float)smaller / width, (float)(i + 1) / width}};
}

static texel4 filter(const texel4 *from, int pitch, const struct taps *x, const struct taps *y)
{
    texel4 sum = {0, 0, 0, 0};
    for (int j = 0; j < y->count; j++) {
        const texel4 *const row = from + (size_t)(y->first + j) * (size_t)pitch + x->first;
        texel4 line = row[0] * x->weight[0];
        for (int i = 1; i < x->count; i++) {
            line += row[i] * x->weight[i];
        }
        sum += line * y->weight[j];
    }
    return sum;
}

// Row y of a level, in `to` and, rounded, in the texture. `from` holds rows of the level above, which
// `rows` counts from its start.
static void reduce_row(const struct rhw_texture_data *texture, int level, int y, const texel4 *from,
                       const struct taps *rows, texel4 *to)
{
    const struct rhw_mip *const above = &texture->mip[level - 1], *const mip = &texture->mip[level];
    const size_t size = texture->info->size;
    unsigned char *const stored = mip->texels + (size_t)y * mip->row_pitch;
    texel4 *const row = to + (size_t)y * (size_t)mip->width;
    for (int x = 0; x < mip->width; x++) {
        const struct taps columns = taps_of(above->width, mip->width, x);
        row[x] = filter(from, above->width, &columns, rows);
        store_texel(texture->info, row[x], stored + (size_t)x * size);
    }
}

static void reduce(const struct rhw_texture_data *texture, int level, const texel4 *from, texel4 *to)
{
    for (int y = 0; y < texture->mip[level].height; y++) {
        const struct taps rows = taps_of(texture->mip[level - 1].height, texture->mip[level].height, y);
        reduce_row(texture, level, y, from, &rows, to);
    }
}

// Level 0 is widened to floats a few rows at a time: whole, it would take four times the memory of level 1.
static void reduce_first(const struct rhw_texture_data *texture, texel4 *widened, texel4 *to)
{
    const struct rhw_mip *const above = &texture->mip[0];
    const size_t size = texture->info->size, width = (size_t)above->width;
    for (int y = 0; y < texture->mip[1].height; y++) {
        struct taps rows = taps_of(above->height, texture->mip[1].height, y);
        for (int j = 0; j < rows.count; j++) {
            const unsigned char *const from = above->texels + (size_t)(rows.first + j) * above->row_pitch;
            for (size_t x = 0; x < width; x++) {
                widened[(size_t)j * width + x] = load_texel(texture->info, from + x * size);
            }
        }
        rows.first = 0;
        reduce_row(texture, 1, y, widened, &rows, to);
    }
}

static size_t texels_of(const struct rhw_texture_data *texture, int level)
{
    return level < texture->levels ? (size_t)texture->mip[level].width * (size_t)texture->mip[level].height
                                   : 0;
}

bool rhw_texture_data_generate_mips(struct rhw_memory *memory, const struct rhw_texture_data *texture)
{
    if (texture->levels == 1) {
        return true;
    }
    // Levels 1, 3, .. and 2, 4, .. take turns in two buffers.
    const size_t rows = 3 * (size_t)texture->mip[0].width;
    const size_t odd = texels_of(texture, 1), even = texels_of(texture, 2);
    const size_t size = (rows + odd + even) * sizeof(texel4);
    texel4 *const block = rhw_memory_allocate(memory, size, RHW_CACHE_LINE);
    if (!block) {
        return false;
    }
    texel4 *const buffer[2] = {block + rows + odd, block + rows};
    reduce_first(texture, block, buffer[1]);
    for (int level = 2; level < texture->levels; level++) {
        reduce(texture, level, buffer[(level - 1) & 1], buffer[level & 1]);
    }
    rhw_memory_release(memory, block, size);
    return true;
}
