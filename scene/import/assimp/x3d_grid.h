// SPDX-License-Identifier: MIT
// A grid of heights in an X3D as faces.
#ifndef SCENE_IMPORT_X3D_GRID_H
#define SCENE_IMPORT_X3D_GRID_H

#include "x3d_lists.h"

struct scene_x3d_grid {
    char *points, *places;          ///< lists of its points, and of their texture coordinates, 0 to 1
    struct scene_x3d_indices index; ///< the quads, from row to row
};

/// Read the ElevationGrid whose tag ends at `close`. Return false, with nothing in `grid`, if it has no quads, or fewer
/// heights than points, or heights that are no numbers. Free what it has.
bool scene_x3d_read_grid(struct scene_import *import, char *tag, char *close, struct scene_x3d_grid *grid);

#endif
