// SPDX-License-Identifier: MIT
// Changes to a text, which are collected in any order and then made at once.
#ifndef SCENE_IMPORT_EDITS_H
#define SCENE_IMPORT_EDITS_H

#include "import/builder/import.h"

/// Bytes that replace others.
struct scene_edit {
    size_t at, length; ///< the bytes that are replaced
    char *text;
    size_t size;
};

/// A zeroed struct is without changes.
struct scene_edits {
    struct scene_edit *list;
    size_t count, capacity;
};

/// Add a change. The text is from scene_import_allocate or scene_import_reserve.
void scene_edits_add(struct scene_import *import, struct scene_edits *edits, struct scene_edit edit);
/// Add a change to a text that ends with a 0.
void scene_edits_add_string(struct scene_import *import, struct scene_edits *edits, size_t at, size_t length,
                            const char *text);
/// Return a copy of a text with all changes, a 0 behind it. Return NULL if two are in each other's way. Free the
/// changes.
char *scene_edits_apply(struct scene_import *import, struct scene_edits *edits, const char *bytes,
                        size_t *size);
/// Return a text with all changes, a 0 behind it, and free the old one. Return the old one if two are in each other's
/// way, or if there are none. Free the changes.
char *scene_edits_replace(struct scene_import *import, struct scene_edits *edits, char *text, size_t *size);

#endif
