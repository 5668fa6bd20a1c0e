// SPDX-License-Identifier: MIT
// Names by which nodes of an X3D are used again (DEF and USE).
#ifndef SCENE_IMPORT_X3D_NAMES_H
#define SCENE_IMPORT_X3D_NAMES_H

#include "collada_markup.h"
#include "import/builder/hash_table.h"

/// A name, and what is kept of its node.
struct scene_x3d_name {
    struct scene_collada_value name;
    size_t at, size;
};

/// All names. At its beginning all is zero.
struct scene_x3d_names {
    struct scene_x3d_name *names;
    size_t count, capacity;
    struct scene_hash_table places;
};

/// Return what has a name, or NULL where nothing has it.
const struct scene_x3d_name *scene_x3d_find_name(const struct scene_x3d_names *names,
                                                 struct scene_collada_value name);
/// Keep a node, if it has a name and is the first one that has it.
void scene_x3d_add_name(struct scene_import *import, struct scene_x3d_names *names,
                        struct scene_x3d_name node);
void scene_x3d_free_names(struct scene_x3d_names *names);

#endif
