// SPDX-License-Identifier: MIT
// The golden scenes by subject; golden.c lists them with their names. Each draws into a fresh context; `number`
// tells variants of one scene apart.
#ifndef RHW_TEST_GOLDEN_SCENES_H
#define RHW_TEST_GOLDEN_SCENES_H

#include "golden_board.h"

typedef void golden_draw_function(rhw_context *context, int number, struct golden_images *images);

/// Solids, floors, shards. The name is NULL beyond the last.
const char *golden_shape_name(int number);
golden_draw_function golden_shape_draw;

// golden_output.c
golden_draw_function golden_blend_draw;      ///< all factors with all operations, on all formats that blend
golden_draw_function golden_write_mask_draw; ///< all masks, replacing and blending
golden_draw_function golden_formats_draw; ///< eight targets at once; infinities, NaN, denormals, what overflows
golden_draw_function golden_passes_draw; ///< load and store operations over four passes

// golden_raster.c
golden_draw_function golden_depth_draw; ///< comparisons, writing or not, both depth ranges, reversed viewports
golden_draw_function golden_culling_draw;  ///< culling, windings, orientations, the facing builtin
golden_draw_function golden_topology_draw; ///< lists, strips, fans, restart, provoking vertex, index types
golden_draw_function golden_viewport_draw; ///< viewports off the grid and off the target, scissors
golden_draw_function golden_clipping_draw; ///< each plane, behind the eye, far outside; by qualifier

#endif
