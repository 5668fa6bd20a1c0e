// SPDX-License-Identifier: MIT
// Levels of compressed textures are decoded on their way in. Blocks become texels one at a time in a small buffer, from
// which the part within the level is copied.
#include "block_level.h"

#include <string.h>

#include "format/block_format.h"
#include "context/context.h"
#include "context/given_up.h"
#include "base/scheduler.h"
#include "texture.h"

// Texels of a task, which takes some 50 to 200 µs, by format.
enum { BAND_TEXELS = 1 << 13 };

struct decoded_level {
    struct rhw_context *context;
    const struct rhw_block_format *format;
    const unsigned char *blocks;
    size_t row_pitch;
    const struct rhw_mip *mip;
    unsigned char *texels;
    int band; // rows of blocks of a task
};

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

static void decode_row(const struct decoded_level *level, int row)
{
    const struct rhw_block_format *const format = level->format;
    const struct rhw_mip *const mip = level->mip;
    const size_t size = rhw_format_info(format->decoded)->size;
    const unsigned char *block = level->blocks + (size_t)row * level->row_pitch;
    const int top = row * format->height;
    const int rows = smaller(format->height, mip->height - top);
    unsigned char texels[RHW_DECODED_BYTES];
    for (int left = 0; left < mip->width; left += format->width) {
        format->decode(format, block, texels);
        const size_t bytes = size * (size_t)smaller(format->width, mip->width - left);
        for (int y = 0; y < rows; y++) {
            memcpy(level->texels + (size_t)(top + y) * mip->row_pitch + size * (size_t)left,
                   texels + size * (size_t)(y * format->width), bytes);
        }
        block += format->bytes;
    }
}

static int rows_of_blocks(const struct decoded_level *level)
{
    return (level->mip->height + level->format->height - 1) / level->format->height;
}

static void decode_band(void *user, int index, int worker)
{
    const struct decoded_level *const level = user;
    if (rhw_context_is_given_up(level->context, worker)) {
        return;
    }
    const int end = smaller((index + 1) * level->band, rows_of_blocks(level));
    for (int row = index * level->band; row < end; row++) {
        decode_row(level, row);
    }
}

enum rhw_result rhw_decode_level(struct rhw_context *context, enum rhw_format format,
                                 const unsigned char *blocks, size_t row_pitch, const struct rhw_mip *mip,
                                 unsigned char *texels)
{
    struct decoded_level level = {context, rhw_block_format(format), blocks, row_pitch, mip, texels, 0};
    rhw_context_begin_work(context);
    level.band = 1 + BAND_TEXELS / (mip->width * level.format->height);
    rhw_scheduler_run(context->scheduler, decode_band, &level,
                      (rows_of_blocks(&level) + level.band - 1) / level.band);
    return atomic_load(&context->given_up) ? RHW_ERROR_GIVEN_UP : RHW_OK;
}
