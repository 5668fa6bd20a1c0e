// SPDX-License-Identifier: MIT
// A mesh with parts far from each other becomes pieces: meshes that are each counted from a place among their own
// vertices. The first piece takes the place of the mesh. The others wait until the reader has placed the mesh, and then
// stand where it stands.
#ifndef SCENE_PIECES_H
#define SCENE_PIECES_H

#include "clusters.h"
#include "import.h"

struct scene_import_piece {
    struct scene_mesh mesh;
    uint32_t of;      ///< index of the mesh that it was cut from
    double origin[3]; ///< what was subtracted from its positions
};

/// What is done to a piece. `polygons` has the number of each triangle's polygon, or is NULL.
typedef void scene_import_piece_work(struct scene_import *import, struct scene_mesh *mesh, uint32_t *polygons,
                                     const void *context);

/// Make floats of a mesh's positions, as scene_import_settle does, and keep the doubles beside them if the mesh has
/// parts far from each other. Its indices are there.
void scene_import_settle_mesh(struct scene_import *import, struct scene_mesh *mesh, double (*points)[3],
                              double origin[3]);
/// Return true if points that are floats in their file can stay so: they are not far from the origin, nor from each
/// other.
bool scene_import_stay_floats(struct scene_import *import, const float (*points)[3], size_t count);
/// Make doubles of points, which are freed.
double (*scene_import_widen(struct scene_import *import, float (*points)[3], size_t count))[3];
/// Make floats of points, which are freed. Those of each cluster count from an origin of their own.
float (*scene_import_settle_clusters(struct scene_import *import, double (*points)[3], size_t count,
                                     const struct scene_import_clusters *clusters, double (*origins)[3]))[3];
/// Keep a copy of `points` in mesh->exact if they may stand in parts far from each other.
void scene_import_keep_exact(struct scene_import *import, struct scene_mesh *mesh, const double (*points)[3]);
/// Forget what was kept if no parts are far from each other, by the elements of all meshes that the vertices are for.
void scene_import_check_exact(struct scene_import *import, struct scene_mesh *mesh,
                              const struct scene_import_elements *lists, size_t list_count);
/// Cut a mesh of the model that has mesh->exact, and work on each piece.
void scene_import_cut_exact(struct scene_import *import, uint32_t index, const uint32_t *polygons,
                            scene_import_piece_work *work, const void *context);
/// Cut a mesh of the model that is complete and has floats alone.
void scene_import_cut_floats(struct scene_import *import, uint32_t index);
/// Add the pieces that wait to the model, with an instance for each of their mesh's.
void scene_import_place_pieces(struct scene_import *import);

#endif
