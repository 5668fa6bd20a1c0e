// SPDX-License-Identifier: MIT
// How clouds of points look.
#ifndef SCENE_POINTS_H
#define SCENE_POINTS_H

#include "import/builder/import.h"

/// Give clouds of points a size and, where they have none, colours by height. Call it last, when it is known what is
/// up.
void scene_import_dress_points(struct scene_import *import);

#endif
