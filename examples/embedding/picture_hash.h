// SPDX-License-Identifier: MIT
// A number made of the bytes of a picture, FNV-1a of 64 bits, and the call that makes it of a texture.
#ifndef PICTURE_HASH_H
#define PICTURE_HASH_H

#include <stdlib.h>

#include <rhw/rhw.h>

static inline uint64_t hash_bytes(const unsigned char *bytes, size_t size)
{
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * 1099511628211u;
    }
    return hash;
}

// Of level 0 of a texture of 4 bytes a texel; 0 where there is no memory for a copy.
static inline uint64_t hash_picture(rhw_context *context, rhw_texture picture)
{
    const size_t size =
        (size_t)rhw_texture_width(context, picture, 0) * (size_t)rhw_texture_height(context, picture, 0) * 4;
    unsigned char *const pixels = (unsigned char *)malloc(size);
    uint64_t hash = 0;
    if (pixels) {
        rhw_texture_read(context, picture, 0, pixels, 0);
        hash = hash_bytes(pixels, size);
        free(pixels);
    }
    return hash;
}

#endif
