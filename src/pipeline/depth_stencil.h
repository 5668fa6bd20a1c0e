// SPDX-License-Identifier: MIT
// What a draw does with depth and stencil beyond a comparison of depth as a float: the tests are a kernel
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
    // The draw needs the stencil test of kernels/depth/stencil_test.h: it tests stencil or depth bounds, its depth has other steps than a float's, or what
    // passes is counted by it.
    bool needs_stencil_test;
    bool tests_stencil, tests_bounds;
    bool rejects_early;              // fragments that fail the depth test change nothing
    struct rhw_stencil_rule face[2]; // front and back
    float bounds_least, bounds_most;
    double depth_steps;      // between 0 and 1, which depth is rounded to; 0: it stays a float
    float depth_margin;      // two steps: more than rounding moves a depth, in double and to a float
    float kept_above;        // depths above this, up to 1, are what rounding makes of them
    bool rejects_by_stencil; // fragments that fail the stencil test, which some do, change nothing
    bool is_biased;
    struct rhw_depth_bias bias;
    bool counts;         // samples that pass: for queries
    bool counts_by_test; // each is counted where it is tested; else they are the fragments that are shaded
};

// What pass state adds to a pipeline's.
struct rhw_depth_stencil_setting {
    uint8_t reference[2];     // front and back
    bool has_masks, has_bias; // instead of the pipeline's
    struct rhw_stencil_masks masks;
    struct rhw_depth_bias bias;
    float bounds_least, bounds_most;
    bool counts;       // a query counts what passes
    bool many_samples; // a pixel has several
};

// `def` is valid; depth_steps: of the pass's depth attachment, 0 for a float or none.
void rhw_depth_stencil_init(struct rhw_depth_stencil_state *state, const struct rhw_pipeline_def *def,
                            const struct rhw_depth_stencil_setting *setting, double depth_steps);

// Whether a draw may change stencil, by its operations and the masks that hold for it.
bool rhw_writes_stencil(const struct rhw_pipeline_def *def, const struct rhw_depth_stencil_setting *setting);

// False, and misuse, where a bias is not finite. `where`: the function called.
bool rhw_check_depth_bias(const struct rhw_context *context, const struct rhw_depth_bias *bias,
                          const char *where);

#endif
