// SPDX-License-Identifier: MIT
// A pass can tell the history of one sample of a pixel: it reports every fragment that came to the sample, in order,
// with the fragment's fate and the numbers that the pipeline itself worked with.
#ifndef RHW_EXPLAIN_H
#define RHW_EXPLAIN_H

#include "types.h"

struct rhw_bindings;

/// The fate of a fragment.
enum rhw_fragment_fate {
    RHW_FRAGMENT_FAILED_EARLY, ///< failed the depth bounds, stencil or depth test before the fragment function
    RHW_FRAGMENT_DISCARDED, ///< removed by the fragment function, by its sample mask, or by alpha to coverage
    RHW_FRAGMENT_FAILED_LATE, ///< failed the depth bounds, stencil or depth test after the fragment function
    RHW_FRAGMENT_WRITTEN      ///< written to the depth and colour attachments, as masks and blending say
};

/// A fragment is what one triangle brings to the sample. A line or a point is drawn as triangles. Pointers are valid
/// until the function that gets the struct returns. Notation: the vertices 0, 1, 2 of the triangle have the clip
/// coordinates (X, Y, Z, W); r, s, t are the sample's barycentric coordinates on the screen; a, b, c are its
/// barycentric coordinates in space (docs/exactness.md).
struct rhw_explained_fragment {
    uint32_t draw;      ///< number of the draw in the pass
    uint32_t instance;  ///< instance of the draw
    uint32_t primitive; ///< number of the primitive in its draw and instance
    const char *label;  ///< label of the pipeline, or "" if the pipeline has none
    bool front_facing;
    enum rhw_fragment_fate fate;
    uint32_t covered; ///< the samples of the pixel that the triangle covers, one bit for each sample

    // The triangle
    float position[3][4]; ///< clip coordinates [vertex][X, Y, Z, W]
    bool is_clipped;      ///< clipping left a polygon that decides the coverage; `edge` is not set then
    bool is_snapped;      ///< every W is above 0 and every vertex is near enough; `x` and `y` are set then
    int32_t x[3],
        y[3]; ///< place of each vertex on the screen, in 1/256 pixel from the top left of the target

    // The sample
    int32_t sample_x, sample_y; ///< place of the sample, in 1/256 pixel from the top left of the target
    /// Edge functions of the sample P. Edge i lies opposite to vertex i: edge[i] = a·(Px − x) + b·(Py − y), in 1/65536
    /// pixel². It is above 0 inside the triangle; 0 counts as inside on a top or left edge. r : s : t = edge[0] :
    /// edge[1] : edge[2].
    int64_t edge[3];
    float depth; ///< depth of the fragment

    // The attachments before the fragment and after it
    float depth_before, depth_after; ///< 0 without a depth attachment
    uint8_t stencil_before, stencil_after;
    float color_before[RHW_MAX_COLOR_ATTACHMENTS][4]; ///< linear values
    float color_after[RHW_MAX_COLOR_ATTACHMENTS][4];  ///< linear values

    // Shading. The members behind is_shaded are set if is_shaded is true.
    bool is_shaded;      ///< false if the fragment failed early or the program has no fragment function
    float place[2];      ///< place in the pixel where values are taken, 0..1; mostly the pixel's centre
    double screen[3];    ///< r, s, t at `place`
    double inverse_w;    ///< 1/W at `place`
    float weights[3];    ///< a, b, c at `place`
    int component_count; ///< number of components of all varyings
    const float *vertex_varyings[3]; ///< [component_count] at each vertex
    const float *varyings;           ///< [component_count] that the fragment function got
    const uint8_t *qualifiers;       ///< [component_count] of enum rhw_qualifier
    const bool *has_derivatives;     ///< [component_count]
    const float *ddx, *ddy; ///< [component_count], change per pixel of components that have derivatives
    float output[RHW_MAX_COLOR_ATTACHMENTS][4]; ///< colours that the fragment function returned
    /// What the fragment function may sample. rhw_sample of these bindings gives what it gave in the function.
    const struct rhw_bindings *textures;
};

/// A thread of the context calls the function while the pass ends, with one call at a time. The function must not call
/// the library with the context of the pass, which is misuse. rhw_sample of fragment->textures is allowed.
typedef void rhw_explain_function(void *user, const struct rhw_explained_fragment *fragment);

struct rhw_explain {
    int x, y;   ///< pixel, from the top left of the target, within the render area
    int layer;  ///< layer of the pass
    int sample; ///< sample of the pixel
    rhw_explain_function *fragment;
    void *user; ///< first argument of `fragment`
};

/// Ask for the history of a sample, before the first draw of a pass. The pass draws the same bytes, but takes the
/// general path everywhere, as with RHW_PATHS_GENERAL. A pass explains one sample.
RHW_API void rhw_pass_explain(rhw_context *context, rhw_pass pass, const struct rhw_explain *explain);

#endif
