// SPDX-License-Identifier: MIT
// How much of a picture a model covers, without drawing it.
#ifndef SCENE_COVERAGE_H
#define SCENE_COVERAGE_H

#include "camera.h"

/// The grid has SCENE_COVERAGE_SIDE cells along the longer side of a picture.
enum { SCENE_COVERAGE_SIDE = 256 };

/// Return the number of cells of a grid over the picture whose middle the model covers. Counting ends when `enough` are
/// found.
uint32_t scene_coverage_count(const struct scene_model *model, const struct scene_camera *camera,
                              double aspect, uint32_t enough);
/// Return the number of cells of the grid.
uint32_t scene_coverage_cells(double aspect);

#endif
