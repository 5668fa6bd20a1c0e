// SPDX-License-Identifier: MIT
// The decoding of a level of a compressed texture when it is written.
#ifndef RHW_BLOCK_LEVEL_H
#define RHW_BLOCK_LEVEL_H

#include <stddef.h>

#include "rhw/types.h"

struct rhw_mip;

// Decode rows of blocks, `row_pitch` bytes apart, into rows of texels of a level's size and pitch, on all threads of
// the context. `format` is a compressed one. Return RHW_OK or RHW_ERROR_GIVEN_UP.
enum rhw_result rhw_decode_level(struct rhw_context *context, enum rhw_format format,
                                 const unsigned char *blocks, size_t row_pitch, const struct rhw_mip *mip,
                                 unsigned char *texels);

#endif
