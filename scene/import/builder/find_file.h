// SPDX-License-Identifier: MIT
// The files that a model names.
#ifndef SCENE_FIND_FILE_H
#define SCENE_FIND_FILE_H

#include "import.h"

/// Finds the file a model means by `name` (relative, percent-encoded, with backslashes, in other case);
/// NULL when there is none that may be read, and import->missing says why.
const char *scene_import_find_file(struct scene_import *import, const char *name);
/// Whether import->confine lets the file be read.
bool scene_import_within(const struct scene_import *import, const char *path);

#endif
