// SPDX-License-Identifier: MIT
// Draws whose order among themselves does not show: of all their fragments at a pixel the nearest one alone is seen. A
// tile may draw them depth first and shade only what is seen (kernels/depth_tmpl.h has the rules).
#ifndef RHW_DEFERRAL_H
#define RHW_DEFERRAL_H

#include "pass.h"

// The depth comparison that such draws share, or RHW_COMPARE_NEVER for a draw that must be drawn in its turn: it blends,
// keeps a part of a texel, does not test and write depth, or computes its depth. `state` is complete but for this.
enum rhw_compare rhw_deferral(const struct rhw_draw_state *state, int color_count);

#endif
