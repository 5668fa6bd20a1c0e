// SPDX-License-Identifier: MIT
// The history of one sample of a pixel: every fragment that came to it, in order, and what became of it, with the numbers
// that the pipeline itself worked with.
#ifndef RHW_EXPLAIN_H
#define RHW_EXPLAIN_H

#include "types.h"

struct rhw_bindings;

/// What became of a fragment.
enum rhw_fragment_fate {
    RHW_FRAGMENT_FAILED_EARLY, ///< depth bounds, stencil or depth test, before the fragment function
    RHW_FRAGMENT_DISCARDED,    ///< by the fragment function, by its sample mask, or by alpha to coverage
    RHW_FRAGMENT_FAILED_LATE,  ///< one of those tests after the fragment function
    RHW_FRAGMENT_WRITTEN       ///< into the depth and colour attachments, as masks and blending say
};

/// A fragment: what one triangle brings to the sample. A line or a point is drawn as triangles. Arrays are valid while the
/// function that gets this runs. Notation: the triangle's vertices 0, 1, 2 have clip coordinates (X, Y, Z, W); r, s, t are
/// the sample's barycentric coordinates on the screen, a, b, c those in space (docs/exactness.md).
struct rhw_explained_fragment {
    uint32_t draw;      ///< number in the pass
    uint32_t instance;  ///< of the draw
    uint32_t primitive; ///< number in its draw and instance
    const char *label;  ///< of the pipeline; "" where it has none
    bool front_facing;
    enum rhw_fragment_fate fate;
    uint32_t covered; ///< the samples of the pixel that the triangle covers, a bit each
    // The triangle:
    float position[3][4]; ///< clip coordinates
    bool is_clipped;      ///< coverage is that of a polygon that clipping left: `edge` is not set
    bool is_snapped;      ///< every W is above 0 and every vertex near enough: `x` and `y` are set
    int32_t x[3], y[3];   ///< on the screen, 1/256 pixel, from the top left of the target
    // The sample:
    int32_t sample_x, sample_y; ///< its place, 1/256 pixel, from the top left of the target
    /// Edge i is that opposite to vertex i: e = a·(Px − x) + b·(Py − y), in 1/65536 pixel², above 0 inside; 0 counts as
    /// inside on a top or left edge. r : s : t = edge[0] : edge[1] : edge[2].
    int64_t edge[3];
    float depth; ///< of the fragment
    // What was there, and what is there now:
    float depth_before, depth_after; ///< 0 without a depth attachment
    uint8_t stencil_before, stencil_after;
    float color_before[RHW_MAX_COLOR_ATTACHMENTS][4], color_after[RHW_MAX_COLOR_ATTACHMENTS][4]; ///< linear
    // What was shaded; not set where it failed early, or where the program has no fragment function:
    bool is_shaded;
    float place[2];      ///< in the pixel, 0..1: where values are taken; mostly its centre
    double screen[3];    ///< r, s, t there
    double inverse_w;    ///< 1/W there
    float weights[3];    ///< a, b, c there
    int component_count; ///< of all varyings
    const float *vertex_varyings[3],
        *varyings;               ///< [component_count]: at the vertices, and what the function got
    const uint8_t *qualifiers;   ///< enum rhw_qualifier of each component
    const bool *has_derivatives; ///< of each component
    const float *ddx, *ddy;      ///< per pixel, where the component has them
    float output[RHW_MAX_COLOR_ATTACHMENTS][4]; ///< what the function returned
    const struct rhw_bindings *textures; ///< what it may sample: rhw_sample of these gives what it gave there
};

/// Is called by a thread of the context while the pass ends, one call after the other. Calls of the library are misuse.
typedef void rhw_explain_function(void *user, const struct rhw_explained_fragment *fragment);

struct rhw_explain {
    int x, y; ///< pixels from the top left of the target, within the render area
    int layer;
    int sample; ///< of the pixel
    rhw_explain_function *fragment;
    void *user;
};

/// Before the first draw of a pass: asks for the history of a sample. The pass draws the same bytes, but takes the general
/// path everywhere, as RHW_PATHS_GENERAL does. One sample a pass.
RHW_API void rhw_pass_explain(rhw_context *context, rhw_pass pass, const struct rhw_explain *explain);

#endif
