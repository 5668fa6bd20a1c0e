// SPDX-License-Identifier: MIT
// What the work on each tile of a pass was: where it is dense, and how hidden surfaces were kept from being shaded.
#ifndef RHW_TILES_H
#define RHW_TILES_H

#include "types.h"

/// How triangles of a tile were drawn, a bit each. All ways draw the same bytes.
enum rhw_tile_plan {
    RHW_TILE_IN_ORDER = 1,    ///< as they were submitted
    RHW_TILE_DEPTH_FIRST = 2, ///< their depth, then what of them is seen
    RHW_TILE_BACKWARDS = 4    ///< from the last one on, until no pixel is open
};

/// A tile is a square of pixels that one thread draws from load to store. Tiles are cut off at the target's end.
struct rhw_tile_report {
    int x, y, width, height; ///< pixels of the target, from its top left
    int layer;
    uint32_t plans; ///< or-ed rhw_tile_plan; 0: nothing was drawn. Where a pass has flushes, of all of them
    uint64_t triangles; ///< that were to be drawn here; a clipped one may count as two and more
    uint64_t fragments_shaded, fragment_groups; ///< as in struct rhw_stats, of which these are parts
    double busy_ms;                             ///< of its threads
};

/// How many tiles the pass has, those of layers after each other.
RHW_API int rhw_pass_tile_count(rhw_context *context, rhw_pass pass);
/// Asks for the reports of all tiles, row by row: `count` is rhw_pass_tile_count. They are filled in when the pass ends with
/// success, and must live until it has ended. Once a pass. What is drawn, and how, does not depend on it.
RHW_API void rhw_pass_report_tiles(rhw_context *context, rhw_pass pass, struct rhw_tile_report *reports,
                                   int count);

#endif
