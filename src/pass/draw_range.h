// SPDX-License-Identifier: MIT
// Under validation a draw must stay within its buffers. Without validation, what lies outside reads as zeros (rhw.h),
// which is safe and rarely meant.
#ifndef RHW_DRAW_RANGE_H
#define RHW_DRAW_RANGE_H

#include "encoder.h"

// Return true if a draw of `count` vertices or indices stays within its index and vertex buffers. Report misuse of
// `where` and return false if not.
bool rhw_draw_range_check(const struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count,
                          const char *where);

#endif
