// SPDX-License-Identifier: MIT
// Clusters of what stands so far apart that no one place serves all as an origin of floats.
#ifndef SCENE_CLUSTERS_H
#define SCENE_CLUSTERS_H

#include "draw/camera/box.h"
#include "import.h"

enum { SCENE_IMPORT_CLUSTERS = 64 }; // what would be one more joins the last

struct scene_import_clusters {
    struct scene_box boxes[SCENE_IMPORT_CLUSTERS];
    uint32_t count;
    uint32_t last;                          // number of the cluster that was added to last
    uint32_t joined[SCENE_IMPORT_CLUSTERS]; // number after they were joined of each that was there before
};

/// Add a box to the first cluster that it is near, by the sizes of both. If there is none, it begins a new one. Return
/// the number of the cluster.
uint32_t scene_import_clusters_add(struct scene_import_clusters *clusters, const struct scene_box *box);
/// Join clusters that have grown near each other. What is added in any order then gives the same clusters, mostly.
void scene_import_clusters_join(struct scene_import_clusters *clusters);

#endif
