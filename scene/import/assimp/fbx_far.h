// SPDX-License-Identifier: MIT
// The parts of an FBX that have places in them. A file is a tree of named records, in bytes or in text.
#ifndef SCENE_IMPORT_FBX_FAR_H
#define SCENE_IMPORT_FBX_FAR_H

#include "assimp_exact.h"
#include "fbx_transform.h"

enum scene_fbx_kind {
    SCENE_FBX_FILE,
    SCENE_FBX_OBJECTS,
    SCENE_FBX_GEOMETRY,
    SCENE_FBX_POSITIONS,
    SCENE_FBX_MODEL,
    SCENE_FBX_PROPERTIES,
    SCENE_FBX_PROPERTY,
    SCENE_FBX_DEFORMER,
    SCENE_FBX_BIND,
    SCENE_FBX_OTHER,
};

/// The marks of a model: one for each of its matrices, or where an animation moves it, which knows the vectors one by
/// one, one for each of its ways.
struct scene_fbx_marks {
    bool is_moved;
    bool is_set[SCENE_FBX_MATRICES];
    double marks[SCENE_FBX_MATRICES][3];
};

/// Return what a record is, by its name and by the record that it is in.
enum scene_fbx_kind scene_fbx_kind_of(enum scene_fbx_kind parent, const char *name, size_t length);
/// Return true for the type of a property that assimp reads as three numbers.
bool scene_fbx_is_vector(const char *type, size_t length);
/// Return true if an animation moves a model.
bool scene_fbx_is_moved(const struct scene_assimp_exact *exact, const char *name, size_t length);
/// Find the marks that the properties of a model need.
struct scene_fbx_marks scene_fbx_mark_model(struct scene_import *import, struct scene_assimp_exact *exact,
                                            const struct scene_fbx_transform *transform, bool is_moved);
/// Put a mark into the 16 numbers of a bone's bind.
void scene_fbx_mark_bind(struct scene_import *import, struct scene_assimp_exact *exact, double matrix[16]);
/// Find the numbers that a vector of the model gets. Return false if it stays as it is.
bool scene_fbx_marked_vector(struct scene_import *import, struct scene_assimp_exact *exact,
                             const struct scene_fbx_marks *marks, enum scene_fbx_vector vector,
                             const double given[3], double numbers[3]);
/// Return true for a class of geometries whose positions are places, not ways.
bool scene_fbx_has_places(const char *class, size_t length);
/// Return the name that a geometry with an offset gets.
char *scene_fbx_mark_name(struct scene_import *import, size_t offset, const char *name, size_t *length);

#endif
