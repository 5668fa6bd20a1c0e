// SPDX-License-Identifier: MIT
// A level of a compressed texture on its way in.
#ifndef RHW_BLOCK_LEVEL_H
#define RHW_BLOCK_LEVEL_H

#include <stddef.h>

#include "rhw/types.h"

struct rhw_mip;

// Decodes rows of blocks, `row_pitch` bytes apart, into rows of texels of a level's size and pitch, on all threads of the
// context. `format` is a compressed one.
void rhw_decode_level(struct rhw_context *context, enum rhw_format format, const unsigned char *blocks,
                      size_t row_pitch, const struct rhw_mip *mip, unsigned char *texels);

#endif
