// SPDX-License-Identifier: MIT
// Opaque draws: of all their fragments at a pixel one alone is seen, the nearest or, without depth, the last. A tile
// may draw them depth first, or backwards, and shade only what is seen (kernels/depth_tmpl.h has the rules).
#ifndef RHW_DEFERRAL_H
#define RHW_DEFERRAL_H

#include "draw_list.h"

// The depth comparison that such draws share; RHW_COMPARE_ALWAYS where there is no depth test and none of them
// discards. RHW_COMPARE_NEVER for a draw that must be drawn in its turn: it blends, keeps a part of a texel, tests
// depth without writing it, or computes it. `state` is complete but for this.
enum rhw_compare rhw_deferral(const struct rhw_draw_state *state, int color_count);

#endif
