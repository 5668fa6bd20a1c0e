// SPDX-License-Identifier: MIT
// What stands far from the origin. Floats have 24 bits, and a position spends those that its distance from the origin
// takes. Surveys stand millions of times their size away, and nothing would be left to tell their vertices apart.
// Positions that are far are therefore double until a place among them is subtracted. Positions that are near become
// floats as they are, so that a model near the origin has the numbers of its file.
#ifndef SCENE_ORIGIN_H
#define SCENE_ORIGIN_H

#include "import.h"

/// Where points lie, for the most part. A few that lie elsewhere do not count.
struct scene_import_spread {
    double middle[3]; ///< the median, rounded to a multiple of about `size`
    double size;      ///< the longest side of what half of the points take up
    double distance;  ///< how far the median is from the origin, along the axis where that is furthest
    bool is_far;      ///< the distance is above SCENE_IMPORT_FAR sizes
};

/// At 256 sizes from the origin floats have 16 bits left for a model: steps of a tenth of a pixel in a picture of 4096.
enum { SCENE_IMPORT_FAR = 256 };

/// Find where the `count` points lie. A sample of them is looked at. Points that are not finite are left out.
struct scene_import_spread scene_import_spread_find(struct scene_import *import, const double (*points)[3],
                                                    size_t count);

/// Return true if points that are floats are far from the origin.
bool scene_import_are_far(struct scene_import *import, const float (*points)[3], size_t count);

/// Make floats of an array from scene_import_allocate or scene_import_reserve, in its own memory. If the points are
/// far, subtract their middle and write it to `origin`, which is 0 otherwise.
float (*scene_import_settle(struct scene_import *import, double (*points)[3], size_t count,
                            double origin[3]))[3];

#endif
