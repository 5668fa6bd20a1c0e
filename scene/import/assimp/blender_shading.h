// SPDX-License-Identifier: MIT
// How the objects of a Blender file are shaded.
#ifndef SCENE_IMPORT_BLENDER_SHADING_H
#define SCENE_IMPORT_BLENDER_SHADING_H

#include "import/builder/hash_table.h"

struct scene_blender_file;

enum scene_blender_shading {
    SCENE_BLENDER_SMOOTH, ///< by the normals that assimp gives
    SCENE_BLENDER_FLAT,   ///< no face is smooth
    SCENE_BLENDER_CREASED ///< some faces are smooth, or all where they meet at small angles
};

struct scene_blender_shaded {
    char *name;
    enum scene_blender_shading shading;
};

/// The objects that are not smooth. Zeroed: none.
struct scene_blender_shadings {
    struct scene_blender_shaded *list;
    size_t count, capacity;
    struct scene_hash_table names;
};

/// Add the objects of a file that are not smooth.
void scene_blender_find_shadings(struct scene_import *import, const struct scene_blender_file *file,
                                 struct scene_blender_shadings *shadings);
/// Return how the object of a name is shaded.
enum scene_blender_shading scene_blender_shading(const struct scene_blender_shadings *shadings,
                                                 const char *name);
void scene_blender_free_shadings(struct scene_blender_shadings *shadings);

#endif
