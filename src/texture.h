// SPDX-License-Identifier: MIT
// Texel storage of a texture: what the tiles draw into and what rhw_sample reads.
#ifndef RHW_TEXTURE_H
#define RHW_TEXTURE_H

#include "rhw/types.h"

enum { RHW_MAX_MIP_LEVELS = 15 };

struct rhw_mip {
    unsigned char *texels; // linear rows, top to bottom; 64-byte aligned
    int width, height;
    size_t row_pitch; // bytes
};

struct rhw_texture_data {
    enum rhw_format format;
    int levels;
    struct rhw_mip mip[RHW_MAX_MIP_LEVELS];
    void *memory; // one allocation for all levels, made when it is first needed
    size_t memory_size;
};

// Box-filters levels 1.. from level 0 in linear light.
void rhw_texture_data_generate_mips(const struct rhw_texture_data *texture);

#endif
