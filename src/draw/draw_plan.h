// SPDX-License-Identifier: MIT
// What a tile does for the fragments of a draw: which inputs its fragment function gets and how, and how depth is
// tested. Everything that follows from the draw's state is decided here, once when the state is recorded, for each
// phase in which a tile may draw it.
#ifndef RHW_DRAW_PLAN_H
#define RHW_DRAW_PLAN_H

#include <stdbool.h>

#include "rhw/types.h"

struct rhw_pipeline_data;
struct rhw_depth_stencil_state;

// In which order a tile draws a run of triangles (hidden_surface.h has the reasons).
enum rhw_phase {
    RHW_PHASE_ONLY,      // depth and shading, as submitted
    RHW_PHASE_DEPTH,     // the first of two: depth alone, of draws that do not discard
    RHW_PHASE_SHADE,     // the second: the fragments that the first left in front
    RHW_PHASE_BACKWARDS, // the last triangle first, where no depth is tested: pixels that are open
    RHW_PHASE_COUNT
};

// How fragments get their colour.
enum rhw_shading {
    RHW_SHADING_NONE,     // they get none: depth is all that is drawn
    RHW_SHADING_CONSTANT, // the fragment function receives nothing, so one call tells the colour of all
    // Any 8 fragments make a group. It receives
    RHW_SHADING_SMOOTH, // varyings, coordinates, facing and ids, which several groups are filled with together, or
    RHW_SHADING_ANY, // anything
    RHW_SHADING_ROWS // A group is a row of 8 pixels with anything. The general path
};

enum rhw_depth_mode {
    RHW_DEPTH_NONE,
    RHW_DEPTH_EARLY,       // tested and written before shading
    RHW_DEPTH_LATE,        // tested and written after it: the fragment function computes depth
    RHW_DEPTH_EARLY_REJECT // tested before, tested again and written after: the fragment function may discard
};

// What a depth test has to do with open pixels (kernels/depth/open_pixels.h).
enum rhw_open_rule {
    RHW_OPEN_IGNORED,
    RHW_OPEN_MARK,  // what passes opens its pixel
    RHW_OPEN_CLAIM, // only open pixels pass; they are not open any more
    RHW_OPEN_TRY,   // equal depth passes too where the pixel is open
    RHW_OPEN_CLOSE  // as TRY; what passes closes its pixel
};

// How fragments are tested. Each test is a special case of RHW_TEST_STENCIL.
enum rhw_fragment_test {
    RHW_TEST_DEPTH, // depth alone, which is a float (kernels/depth/depth_test.h), or nothing
    RHW_TEST_STENCIL, // the general stencil test: depth bounds, stencil and depth (kernels/depth/stencil_test.h)
    RHW_TEST_MASKS, // stencil and depth by masks of a block, before shading (kernels/depth/stencil_block.h)
    RHW_TEST_WHOLE_BLOCKS // depth stays, and stencil follows the depth test alone (kernels/depth/depth_range.h)
};

// Return true if what a test does can be done by masks of a block.
static inline bool rhw_test_has_masks(enum rhw_fragment_test test)
{
    return test == RHW_TEST_MASKS || test == RHW_TEST_WHOLE_BLOCKS;
}

struct rhw_depth_rule {
    enum rhw_compare compare;
    bool write;
    enum rhw_open_rule open;
};

// The rules of opaque draws with LESS and GREATER, in one phase and in two. The loops that test depth have a copy for
// each of them, in which the rule is a constant, and one for any other: 6 to 23 % fewer instructions on every scene
// with a depth test.
enum rhw_rule_name {
    RHW_RULE_LESS,
    RHW_RULE_GREATER,
    RHW_RULE_MARK_LESS,
    RHW_RULE_MARK_GREATER,
    RHW_RULE_CLAIM,
    RHW_RULE_ANY
};

// The plan of a draw in one phase.
struct rhw_draw_plan {
    enum rhw_shading shading;
    enum rhw_depth_mode depth_mode;
    struct rhw_depth_rule early, late; // before and after the fragment function
    enum rhw_rule_name early_name;
    bool collects;              // fragments of rows that are not full may share groups, wherever they lie
    enum rhw_sampling sampling; // CENTER where pixels have one sample
    bool reads_targets;         // before the fragment function (kernels/fragment/target_input.h)
    bool weighs_alpha;          // after the fragment function: by the area that a smooth line covers
    bool masks_samples;         // after the fragment function: by alpha, or the function itself
    bool drops;                 // after the fragment function: fragments are discarded, masked or tested
    enum rhw_fragment_test test;
    bool is_biased;      // depth is
    bool tests_early;    // with `early`
    bool needs_depth;    // depth is tested, or given to the fragment function
    bool keeps_depth;    // groups carry it
    bool keeps_identity; // groups of RHW_SHADING_SMOOTH carry facing or ids
    bool fills_more; // groups of RHW_SHADING_SMOOTH have more than smooth and flat varyings and their derivatives
    bool needs_screen;   // weights on the screen are wanted
    bool needs_distance; // derivatives that change from pixel to pixel are wanted
    bool is_skipped;     // nothing is drawn in this phase
    // Which special paths the draw has (kernels/tile/triangle_path.h chooses among them).
    bool draws_tiny;  // the path of tiny triangles
    bool draws_small; // the path of small triangles
    bool draws_spans; // the path of the other small triangles, where a pixel has one sample
    // Which way the test lets depth move, for hierarchical depth: 1 where it only falls (LESS), −1 where it only rises,
    // 0 where neither is sure or hierarchical depth is not used.
    int depth_direction;
    bool moves_depth; // writes it
    bool ends_bounds; // moves it both ways
};

// The plans of a pipeline's draws, by phase, in a pass with that many samples.
void rhw_draw_plans_make(struct rhw_draw_plan plans[RHW_PHASE_COUNT],
                         const struct rhw_pipeline_data *pipeline,
                         const struct rhw_depth_stencil_state *depth_stencil, int samples,
                         enum rhw_paths paths);

// What a name stands for.
static const struct rhw_depth_rule rhw_named_rules[RHW_RULE_ANY] = {
    [RHW_RULE_LESS] = {RHW_COMPARE_LESS, true, RHW_OPEN_IGNORED},
    [RHW_RULE_GREATER] = {RHW_COMPARE_GREATER, true, RHW_OPEN_IGNORED},
    [RHW_RULE_MARK_LESS] = {RHW_COMPARE_LESS, true, RHW_OPEN_MARK},
    [RHW_RULE_MARK_GREATER] = {RHW_COMPARE_GREATER, true, RHW_OPEN_MARK},
    [RHW_RULE_CLAIM] = {RHW_COMPARE_EQUAL, false, RHW_OPEN_CLAIM},
};

#endif
