// SPDX-License-Identifier: MIT
// Files that a model names inside the archive that it is in itself.
#ifndef SCENE_ARCHIVE_H
#define SCENE_ARCHIVE_H

#include "hash_table.h"
#include "zip.h"

/// An entry that was read.
struct scene_import_entry {
    const char *name; ///< in small letters
    void *bytes;
    size_t size;
};

/// What a model is in, for those that are in archives with others. A zeroed struct is no archive.
struct scene_import_archive {
    struct scene_zip *zip;
    const char *folder; ///< the folder of the archive that the model is in, with a slash at its end, or ""
    struct scene_import_entry *entries;
    size_t count, capacity;
    struct scene_hash_table names; ///< finds entries by their names
};

/// Say that the model is the entry of this name. Names of files count from its folder.
void scene_import_enter_archive(struct scene_import *import, struct scene_zip *zip, const char *entry);
/// Return the entry that the model means by `name`, in one of the forms of name_forms.h, from its own folder or with
/// its path changed. Return NULL if there is none, or if the model is in no archive. An entry is read once: its bytes
/// are shared, and stay.
void *scene_import_find_entry(struct scene_import *import, const char *name, size_t *size);

#endif
