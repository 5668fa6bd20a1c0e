// SPDX-License-Identifier: MIT
// What the faces of a mesh bring to the normals at their corners.
#ifndef SCENE_FACE_WEIGHTS_H
#define SCENE_FACE_WEIGHTS_H

#include "import.h"
#include "rhw/isa.h"

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
    uint32_t points[SCENE_FACE_BATCH][3]; ///< the point at each corner
};

/// What is known of a point: of the first vertex at a place, in which all vertices there are one.
struct scene_face_point {
    /// The sum of the weighted normals of the faces around it, and then its direction. The fourth number is that of the
    /// corners at the point, and later the new vertex of an even point.
    double sum[4];
};

/// Functions that each instruction set has a copy of.
struct scene_face_functions {
    /// Find the normals of the faces of a batch.
    void (*find_normals)(const struct scene_mesh *mesh, struct scene_face_batch *batch);
    /// Find normals and weights.
    void (*weigh)(const struct scene_mesh *mesh, struct scene_face_batch *batch);
    /// Add the corners of a batch that is weighed to their points.
    void (*add)(const struct scene_face_batch *batch, struct scene_face_point *points);
    /// Make directions of the sums of points.
    void (*make_directions)(struct scene_face_point *points, uint32_t count);
};

RHW_ISA_DECLARE(const struct scene_face_functions, scene_face_functions);

#endif
