// SPDX-License-Identifier: MIT
// What the faces of a mesh bring to the normals at their corners.
#ifndef SCENE_FACE_WEIGHTS_H
#define SCENE_FACE_WEIGHTS_H

#include "import.h"

enum { SCENE_FACE_BATCH = 32 };

/// Some faces of a mesh, and what is found of them.
struct scene_face_batch {
    uint32_t count, faces[SCENE_FACE_BATCH];
    double normals[3][SCENE_FACE_BATCH]; ///< unit vectors by axis; 0 where a face has no area
    /// The weight of each corner: the face's angle there times its area. With weights of angles alone it would not
    /// matter at all how a polygon was cut into triangles, and with these it matters a little. But scans have triangles
    /// whose edges are a thousandth of their neighbours' and whose direction is noise, and by angles alone these would
    /// count as much as the others.
    double weights[3][SCENE_FACE_BATCH];
};

/// Find normals and weights of the faces of a batch.
void scene_face_batch_weigh(const struct scene_mesh *mesh, struct scene_face_batch *batch);

#endif
