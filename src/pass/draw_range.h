// SPDX-License-Identifier: MIT
// Under validation: whether a draw stays within its buffers. Without, what lies outside reads as zeros (rhw.h), which is
// safe and rarely meant.
#ifndef RHW_DRAW_RANGE_H
#define RHW_DRAW_RANGE_H

#include "encoder.h"

// False, and misuse of `where`, when a draw of `count` vertices or indices reaches outside an index or vertex buffer.
bool rhw_draw_range_check(const struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count,
                          const char *where);

#endif
