// SPDX-License-Identifier: MIT
// Decoding sRGB texels before they are filtered takes 24 table look-ups for one trilinear sample, four times the cost
// of everything else. So a texture that is sampled keeps its texels decoded, as 16-bit fixed point, and the sampler
// filters them like those of RGBA8_UNORM. The price is memory: 12 bytes a texel instead of 4. The copy is made when a
// pass first binds the texture. Targets that nobody samples have no copy. Textures of other kinds than plain 2D have
// none either: they take the general path, which decodes.
//
// Rounding moves a value by at most half of 1/32640. This is less than 1/20 of the distance between two sRGB codes,
// which are closest at the dark end, where neighbours are 9.9/32640 apart.
//
// Red stands beside blue and green beside alpha because the sampler mixes two channels in 32 bits.
#include "srgb_texture.h"

#include <string.h>

#include "base/constants.h"
#include "context/context.h"
#include "context/given_up.h"
#include "format/format.h"
#include "base/memory.h"
#include "base/scheduler.h"
#include "format/srgb.h"
#include "texture.h"

// Bytes of the copy for one byte of the texture, rows and padding included.
static const size_t linear_scale = RHW_LINEAR_TEXEL / 4;

static bool allocate_levels(struct rhw_memory *memory, struct rhw_texture_data *texture)
{
    if (texture->memory_size > SIZE_MAX / linear_scale) {
        return false;
    }
    texture->linear_size = linear_scale * texture->memory_size;
    texture->linear_memory = rhw_memory_allocate(memory, texture->linear_size, RHW_CACHE_LINE);
    if (!texture->linear_memory) {
        return false;
    }
    unsigned char *next = texture->linear_memory;
    for (int i = 0; i < texture->levels; i++) {
        texture->mip[i].linear = next;
        next += linear_scale * texture->mip[i].slice_pitch * (size_t)texture->mip[i].slices;
    }
    return true;
}

static void decode_row(const uint16_t table[256], const unsigned char *from, unsigned char *to, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const unsigned char *const code = from + 4 * i;
        const uint16_t texel[4] = {table[code[0]], table[code[2]], table[code[1]], (uint16_t)(code[3] << 7)};
        memcpy(to + RHW_LINEAR_TEXEL * i, texel, sizeof texel);
    }
}

enum { BAND_TEXELS = 1 << 16 }; // texels of a task: some 50 µs

// One level while it is decoded.
struct decoded_level {
    struct rhw_context *context;
    const struct rhw_mip *mip;
    int band; // rows of a task
    uint16_t table[256];
};

static void decode_band(void *user, int index, int worker)
{
    const struct decoded_level *const level = user;
    const struct rhw_mip *const mip = level->mip;
    if (rhw_context_is_given_up(level->context, worker)) {
        return;
    }
    const int begin = index * level->band;
    const int end = mip->height - begin < level->band ? mip->height : begin + level->band;
    for (size_t y = (size_t)begin; y < (size_t)end; y++) {
        decode_row(level->table, mip->texels + y * mip->row_pitch,
                   mip->linear + linear_scale * y * mip->row_pitch, (size_t)mip->width);
    }
}

enum rhw_result rhw_texture_linearize(struct rhw_context *context, struct rhw_texture_data *texture)
{
    const uint32_t all = (1u << texture->levels) - 1;
    if (texture->info->path != RHW_TEXELS_RGBA8_SRGB || !texture->is_plain || texture->linear_levels == all) {
        return RHW_OK;
    }
    if (!texture->linear_memory && !allocate_levels(&context->memory, texture)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    struct decoded_level level = {.context = context};
    rhw_context_begin_work(context);
    for (int i = 0; i < 256; i++) {
        level.table[i] = (uint16_t)(rhw_srgb_decode_table[i] * (float)RHW_LINEAR_ONE + 0.5f);
    }
    for (uint32_t left = all & ~texture->linear_levels; left != 0; left &= left - 1) {
        level.mip = &texture->mip[__builtin_ctz(left)];
        level.band = 1 + BAND_TEXELS / level.mip->width;
        rhw_scheduler_run(context->scheduler, decode_band, &level,
                          (level.mip->height + level.band - 1) / level.band);
    }
    if (atomic_load(&context->given_up)) {
        return RHW_ERROR_GIVEN_UP;
    }
    texture->linear_levels = all;
    return RHW_OK;
}
