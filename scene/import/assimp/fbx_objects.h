// SPDX-License-Identifier: MIT
// The objects of an FBX that have a say in what is seen, and what connects them. A file is a tree of named records, in
// bytes or in text, and both are read alike.
#ifndef SCENE_IMPORT_FBX_OBJECTS_H
#define SCENE_IMPORT_FBX_OBJECTS_H

#include "import/builder/import.h"

enum scene_fbx_class {
    SCENE_FBX_OTHER_CLASS,
    SCENE_FBX_CLASS_MODEL,
    SCENE_FBX_CLASS_SHAPE,      ///< a geometry that is drawn
    SCENE_FBX_CLASS_LAYER,      ///< models that are shown and hidden together
    SCENE_FBX_CLASS_CURVE_NODE, ///< a property that is animated
    SCENE_FBX_CLASS_CURVE,
};

struct scene_fbx_object {
    int64_t id;
    enum scene_fbx_class class;
    bool is_hidden; ///< a property of its own says so
    bool is_apart;  ///< what is above it does not hide it
    size_t keys;    ///< place of the values of a curve in the file. 0 if it has none
};

struct scene_fbx_link {
    int64_t child, parent;
    bool is_visibility; ///< the child is what the parent's visibility follows
};

struct scene_fbx_objects {
    struct scene_fbx_object *objects;
    size_t count, capacity;
    struct scene_fbx_link *links;
    size_t link_count, link_capacity;
};

/// Read the objects of a file, of which there are none if it is no FBX. A 0 follows the bytes, which stay as they are.
struct scene_fbx_objects scene_fbx_read_objects(struct scene_import *import, char *bytes, size_t size);
/// Return true if one of the values of a curve is 0 or less. A 0 follows the bytes of the file.
bool scene_fbx_reaches_zero(const char *bytes, size_t size, size_t keys);

#endif
