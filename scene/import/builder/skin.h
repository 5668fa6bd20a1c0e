// SPDX-License-Identifier: MIT
// Vertices of a skin on their way into the world. Each is moved by the sum of matrices of joints, each times a weight.
// Joints may bring them far away, or bring back what is far. Where floats would lose what can be seen of it, the places
// of the vertices are summed in double.
#ifndef SCENE_SKIN_H
#define SCENE_SKIN_H

#include "place.h"

struct scene_import_skin {
    struct scene_import *import;
    struct scene_mesh *mesh; ///< positions, normals and tangents of it are moved
    float (*matrices)[16];   ///< the sum for each vertex
    float *weights;          ///< the sum of each vertex's weights
    // Of each vertex the sum of its places, and that of its weights. NULL where floats are enough.
    double (*points)[3], *sums;
};

/// Begin to move the vertices of a mesh by joints, which are all that scene_import_skin_add will get.
struct scene_import_skin scene_import_skin_open(struct scene_import *import, struct scene_mesh *mesh,
                                                const struct scene_import_place *joints, size_t count);
/// Add what a joint has of a vertex.
void scene_import_skin_add(struct scene_import_skin *skin, uint32_t vertex,
                           const struct scene_import_place *joint, float weight);
/// Write the vertices to the mesh, less `origin`, which is not 0 if they are far away. With `divides` the weights of a
/// vertex count by their shares in its sum. They always do where the places are summed in double. A vertex without
/// weights is brought to 0.
void scene_import_skin_close(struct scene_import_skin *skin, bool divides, double origin[3]);

#endif
