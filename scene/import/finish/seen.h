// SPDX-License-Identifier: MIT
// What of a model can be seen at all. A shell whose alpha is 0, a body that a mask cuts away and a node of scale 0 draw
// nothing, wherever they are looked at from.
#ifndef SCENE_SEEN_H
#define SCENE_SEEN_H

#include "import/builder/import.h"

/// What of a mesh is seen.
struct scene_seen_mesh {
    bool shows;     ///< at least one triangle, line or point is seen
    bool *vertices; ///< whether each vertex is a corner of something that is seen; NULL if all are
};

/// Find what is seen of each mesh, by its areas and by the alphas of its material, vertices and images, which are
/// decoded. The caller frees the result with scene_seen_free.
struct scene_seen_mesh *scene_seen_find(struct scene_import *import);
void scene_seen_free(struct scene_seen_mesh *seen, const struct scene_model *model);

/// Set `unseen` of all instances. If none is seen, set it of none, so that a picture is about all of them. Return true
/// if at least one is seen.
bool scene_seen_mark(struct scene_model *model, const struct scene_seen_mesh *seen);

#endif
