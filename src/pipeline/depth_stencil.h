// SPDX-License-Identifier: MIT
// What a draw does with depth and stencil beyond a comparison of depth as a float. The tests are a kernel
// (kernels/depth/stencil_test.h); what holds for a whole draw is decided here, once.
#ifndef RHW_DEPTH_STENCIL_H
#define RHW_DEPTH_STENCIL_H

#include <stdbool.h>

#include "rhw/types.h"

struct rhw_context;

// The stencil test of one facing.
struct rhw_stencil_rule {
    enum rhw_compare compare;
    enum rhw_stencil_operation fail, depth_fail, pass;
    int32_t read_mask, write_mask, reference; // 0..255
};

struct rhw_depth_stencil_state {
    // The draw needs the stencil test of kernels/depth/stencil_test.h: it tests stencil or depth bounds, its depth
    // has other steps than a float's, or what passes is counted by it.
    bool needs_stencil_test;
    bool tests_stencil, tests_bounds;
    bool rejects_early;              // fragments that fail the depth test change nothing
    struct rhw_stencil_rule face[2]; // front and back
    float bounds_least, bounds_most;
    // Number of steps between 0 and 1 that depth is rounded to. 0: depth stays a float.
    double depth_steps;
    // Two steps: more than rounding moves a depth, in double and to a float.
    float depth_margin;
    // Depths above this, up to 1, are what rounding makes of them.
    float kept_above;
    bool is_biased;
    struct rhw_depth_bias bias;
    bool counts; // samples that pass are counted, for queries
    // Each sample is counted where it is tested. Otherwise the fragments that are shaded are counted.
    bool counts_by_test;
};

// What the state of a pass adds to a pipeline's.
struct rhw_depth_stencil_setting {
    uint8_t reference[2];     // front and back
    bool has_masks, has_bias; // the pass's take the place of the pipeline's
    struct rhw_stencil_masks masks;
    struct rhw_depth_bias bias;
    float bounds_least, bounds_most;
    bool counts;       // a query counts what passes
    bool many_samples; // a pixel has several samples
};

// Set the state for a valid definition. `depth_steps` are those of the pass's depth attachment, 0 for a float or none.
void rhw_depth_stencil_init(struct rhw_depth_stencil_state *state, const struct rhw_pipeline_def *def,
                            const struct rhw_depth_stencil_setting *setting, double depth_steps);

// Return true if a draw may change stencil, by its operations and the masks that hold for it.
bool rhw_writes_stencil(const struct rhw_pipeline_def *def, const struct rhw_depth_stencil_setting *setting);

// Report misuse of the public function `where` and return false if a bias is not finite.
bool rhw_check_depth_bias(const struct rhw_context *context, const struct rhw_depth_bias *bias,
                          const char *where);

#endif
