// SPDX-License-Identifier: MIT
// Random triangles by family. A scene is named by (family, seed, index) and nothing else, so every finding
// can be replayed from one line.
#ifndef EXACT_SCENE_H
#define EXACT_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "oracle.h"
#include "rhw/types.h"

// What the three values of an interpolated component look like.
enum value_kind {
    VALUE_UNIT,     // 0..1, as colours and texture coordinates are
    VALUE_SIGNED,   // −1..1
    VALUE_OFFSET,   // 10^6 + small
    VALUE_OPPOSITE, // ± almost the same power of two: rounding hurts most
    // What other renderers may refuse; measured by kind alone.
    VALUE_DENORMAL, // below the normal range of a float
    VALUE_HUGE,     // up to 10^38
    VALUE_WIDE,     // magnitudes that have nothing to do with each other
    VALUE_CONSTANT, // equal at the three vertices
    VALUE_KINDS
};

enum family {
    FAMILY_ORDINARY,
    FAMILY_SLIVER,      // a few 1/256 pixel wide
    FAMILY_MICRO,       // smaller than a pixel
    FAMILY_LARGE,       // up to 16384 pixels, seen through a window
    FAMILY_PERSPECTIVE, // ratio of W from 1 to 10^6
    FAMILY_NEAR_FAR,    // crosses near, far or both; W > 0
    FAMILY_GUARD_BAND,  // crosses sides of the guard band
    FAMILY_BEHIND,      // vertices at and behind W = 0
    FAMILY_EVERYTHING,  // all of it at once
    FAMILY_CUT_SLIVER,  // slivers that are cut
    FAMILY_HORIZON,     // floors from behind the eye to the horizon, which lies on a row of pixel centres
    FAMILY_FAN,
    FAMILY_STRIP,
    FAMILY_GRID,
    FAMILY_CUT_GRID, // a grid that the near plane and the guard band cut
    FAMILY_COUNT
};

enum { SCENE_VALUES = 4, SCENE_VERTICES = 2048, SCENE_TRIANGLES = 1024 };

struct scene_vertex {
    float position[4];
    float value[SCENE_VALUES];
    float flat[2];
};

struct scene {
    enum family family;
    uint64_t seed, index;
    struct oracle_view view;
    enum rhw_topology topology;
    enum value_kind kind[SCENE_VALUES];
    bool mesh; // the triangles share edges and do not overlap: no sample belongs to two
    int vertex_count, triangle_count;
    struct scene_vertex vertex[SCENE_VERTICES];
    int triangle[SCENE_TRIANGLES][3]; // vertices in the order the pipeline receives them, provoking first
};

const char *scene_family_name(enum family family);
const char *scene_kind_name(enum value_kind kind);
// FAMILY_COUNT when there is none of that name.
enum family scene_family_named(const char *name);

void scene_make(struct scene *scene, enum family family, uint64_t seed, uint64_t index);

// Whether a peer that snaps to fewer or other bits than we do, or not at all, sees the same triangle: every
// vertex lies exactly on a 1/256 pixel.
bool scene_on_grid(const struct scene *scene, int triangle);

#endif
