// SPDX-License-Identifier: MIT
// Bounds of points.
#ifndef SCENE_BOUNDS_H
#define SCENE_BOUNDS_H

#include <stdbool.h>
#include <stddef.h>

/// Find the least and the greatest number along each axis. What is not a number is passed over. Without any number they
/// are the greatest float and its negative. Return false if something is not a number.
bool scene_import_bound(const float (*points)[3], size_t count, float low[3], float high[3]);

#endif
