// SPDX-License-Identifier: MIT
// Clear values as texels.
#ifndef RHW_CLEAR_TEXEL_H
#define RHW_CLEAR_TEXEL_H

#include "format/format.h"

// Write the texel, of format->size bytes, that drawing the value gives. The values of integer formats are the bits of
// integers.
void rhw_clear_texel(const struct rhw_format_info *format, const float value[4], unsigned char *texel);

#endif
