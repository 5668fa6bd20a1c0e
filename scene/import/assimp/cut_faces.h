// SPDX-License-Identifier: MIT
// Faces of more than four corners. assimp 5.2.5 fills a concave face wrongly where corners lie in one line, leaves out
// what remains of a face that touches itself, and takes seconds for one of 25,000 corners.
#ifndef SCENE_CUT_FACES_H
#define SCENE_CUT_FACES_H

#include <stdbool.h>
#include <stdint.h>

struct aiScene;

#ifdef __cplusplus
extern "C" {
#endif

/// Cut a polygon into count − 2 triangles of places in `corners`.
typedef void scene_cutter(void *user, const float (*positions)[3], const uint32_t *corners, uint32_t count,
                          uint32_t *triangles);

/// Replace the faces of more than four corners of a scene that assimp has read and not processed by triangles. Return
/// false if there is no memory; the scene is of no use then.
bool scene_assimp_cut_faces(const struct aiScene *scene, scene_cutter *cut, void *user);

#ifdef __cplusplus
}
#endif

#endif
