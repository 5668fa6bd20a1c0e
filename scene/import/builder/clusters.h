// SPDX-License-Identifier: MIT
// Clusters of points that stand so far apart, in sizes of each, that no one place serves all as an origin of floats.
#ifndef SCENE_CLUSTERS_H
#define SCENE_CLUSTERS_H

#include "import.h"

enum { SCENE_IMPORT_CLUSTERS = 256 };

/// Points as doubles or as floats. The other pointer is NULL.
struct scene_import_points {
    const double (*exact)[3];
    const float (*floats)[3];
    size_t count;
};

/// What holds points together: lists of triangles, lines and other elements of some corners each, which are indices of
/// points. Corners may stand in structs, and the elements too.
struct scene_import_elements {
    const void *corners; ///< the first index
    size_t count;        ///< number of elements
    size_t stride;       ///< bytes from a corner to the next of its element
    size_t step;         ///< bytes from an element to the next; 0 if the next begins where one ends
    uint32_t each;       ///< corners of each element, where `sizes` is NULL
    const uint32_t *sizes;
};

struct scene_import_clusters {
    /// 1 if nothing is far from the rest. The clusters are numbered in the order of their first elements.
    uint32_t count;
    uint8_t *of_point; ///< number of each point's cluster, to be freed; NULL if there is one cluster
};

/// Return the elements of a mesh.
struct scene_import_elements scene_import_elements_of(const struct scene_mesh *mesh);
/// Return false if points stand in no clusters, whatever holds them together.
bool scene_import_clusters_may_be(const struct scene_import_points *points);
/// Find clusters that are over a thousand times their size away from each other. An element is in one cluster with all
/// of its corners. Points without an element do not count. The usual case takes a look at each point and at few
/// elements. More clusters than SCENE_IMPORT_CLUSTERS stay together.
struct scene_import_clusters scene_import_clusters_find(struct scene_import *import,
                                                        const struct scene_import_points *points,
                                                        const struct scene_import_elements *lists,
                                                        size_t list_count);

#endif
