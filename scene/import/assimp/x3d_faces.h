// SPDX-License-Identifier: MIT
// Faces of an X3D as assimp reads them.
#ifndef SCENE_IMPORT_X3D_FACES_H
#define SCENE_IMPORT_X3D_FACES_H

#include "collada_markup.h"
#include "edits.h"
#include "x3d_names.h"

struct aiMesh;

/// What the sets of a model have, with those of all files that it shows.
struct scene_x3d_sets_room {
    size_t written, largest; ///< bytes of all sets that were written, and how many they may be
    size_t read, most_read;  ///< bytes of their lists, as often as one was read, and how many they may be
    unsigned full; ///< the bits of kinds of which one was made and became too large: no more are made
};

/// What is kept between the tags of a document. At its beginning all but `room` is zero.
struct scene_x3d_faces {
    struct scene_x3d_sets_room *room;
    size_t end;           ///< where the set ends that was written last
    size_t open;          ///< the sets that are open; within another one none is written
    bool is_textured;     ///< the shape that began last has a texture
    const char *end_name; ///< what the outermost is called at its end; NULL where it keeps its name
    struct scene_x3d_names
        lists; ///< points, normals, colours and texture coordinates: where their numbers stand
    struct scene_x3d_names sets; ///< their size is 1 where the set was written, and 0 where it was left out
};

/// What a set says of its normals.
enum scene_x3d_normals {
    SCENE_X3D_OPEN,    ///< nothing: they are made as for other formats
    SCENE_X3D_GIVEN,   ///< it has them
    SCENE_X3D_CREASED, ///< they are made, up to an angle
    SCENE_X3D_SHARED   ///< they are made, and smooth where faces share points
};

/// Write a tag of a set of faces, from `tag` to `close`, or of what belongs to its corners. The document begins at
/// `text`. Return false if it is another tag. Tell of sets that cannot be written.
bool scene_assimp_write_faces(struct scene_import *import, struct scene_edits *edits,
                              struct scene_x3d_faces *faces, const char *text, char *tag, char *close,
                              const char *end);
/// Find what a set that was written says of the normals of the mesh that it has become. Set the cosine of its crease
/// angle where these are made, 1 where all faces are flat. Return false for another mesh.
bool scene_x3d_normals_of(const struct aiMesh *mesh, enum scene_x3d_normals *normals, double *cosine);
void scene_x3d_free_faces(struct scene_x3d_faces *faces);

#endif
