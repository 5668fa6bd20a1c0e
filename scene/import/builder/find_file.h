// SPDX-License-Identifier: MIT
// The files that a model names.
#ifndef SCENE_FIND_FILE_H
#define SCENE_FIND_FILE_H

#include "import.h"

/// Find the file that a model means by `name`, which may be relative, percent-encoded, with backslashes or in other
/// case. Return NULL if there is none that may be read; import->missing then says why. It says the same of a file that
/// is not there and of one that import->confine keeps out.
const char *scene_import_find_file(struct scene_import *import, const char *name);
/// Return true if import->confine lets the file be read. Return false if not.
bool scene_import_within(const struct scene_import *import, const char *path);

#endif
