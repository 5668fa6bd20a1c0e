// SPDX-License-Identifier: MIT
// Opaque draws: of all their fragments at a pixel one alone is seen, the nearest or, without depth, the last. A tile
// may draw them depth first, or backwards, and shade only what is seen (kernels/depth/open_pixels.h has the rules).
#ifndef RHW_HIDDEN_SURFACE_H
#define RHW_HIDDEN_SURFACE_H

#include "rhw/types.h"

struct rhw_draw_state;

enum rhw_hidden_surface {
    RHW_HIDDEN_IN_ORDER, // fragments are shaded in the turn of their draw, also those that later ones hide
    RHW_HIDDEN_DEPTH_FIRST, // the nearest alone is seen: depth may be drawn first, then what has that depth is shaded
    RHW_HIDDEN_BACKWARDS // the last alone is seen: triangles may be drawn from the last to the first
};

// How draws may be drawn together: those that follow each other and have the same rule.
struct rhw_hidden_rule {
    enum rhw_hidden_surface kind;
    enum rhw_compare
        compare; // the depth test's where depth is drawn first; RHW_COMPARE_NEVER for the other kinds
};

static inline bool rhw_hidden_rule_equal(struct rhw_hidden_rule a, struct rhw_hidden_rule b)
{
    return a.kind == b.kind && a.compare == b.compare;
}

// The rule of draws with that state, which has its pipeline, blending, and depth and stencil. In order go draws that
// blend, keep a part of a texel, test depth without writing it, compute it, test stencil or depth bounds, are counted
// by a query, discard without a depth test, have effects, read their targets, or ask for early
// tests.
struct rhw_hidden_rule rhw_hidden_rule_of(const struct rhw_draw_state *state, int color_count);

#endif
