// SPDX-License-Identifier: MIT
// See clean_tiles.h.
#include "clean_tiles.h"

#include <string.h>

#include "constants.h"
#include "context.h"
#include "texture.h"

static size_t tiles_along(int pixels)
{
    return ((size_t)pixels + RHW_TILE - 1) / RHW_TILE;
}

static size_t size_of(size_t count)
{
    return sizeof(struct rhw_clean_tiles) + count * sizeof(bool);
}

bool rhw_clean_tiles_make(struct rhw_context *context, struct rhw_texture_data *texture)
{
    if (texture->clean) {
        return true;
    }
    const size_t count = tiles_along(texture->mip[0].width) * tiles_along(texture->mip[0].height);
    texture->clean = rhw_context_allocate(context, size_of(count), RHW_CACHE_LINE);
    if (!texture->clean) {
        return false;
    }
    memset(texture->clean, 0, size_of(count));
    texture->clean->count = count;
    return true;
}

void rhw_clean_tiles_release(struct rhw_context *context, struct rhw_texture_data *texture)
{
    if (texture->clean) {
        rhw_context_release(context, texture->clean, size_of(texture->clean->count));
    }
}

void rhw_clean_tiles_expect(struct rhw_clean_tiles *clean, const unsigned char texels[RHW_CLEAR_BYTES])
{
    if (clean && memcmp(clean->texels, texels, RHW_CLEAR_BYTES) != 0) {
        rhw_clean_tiles_forget(clean);
        memcpy(clean->texels, texels, RHW_CLEAR_BYTES);
    }
}

void rhw_clean_tiles_forget(struct rhw_clean_tiles *clean)
{
    if (clean) {
        memset(clean->is_clean, 0, clean->count * sizeof *clean->is_clean);
    }
}
