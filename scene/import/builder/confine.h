// SPDX-License-Identifier: MIT
// What a model may read beside itself, and ask about: import->confine.
#ifndef SCENE_IMPORT_CONFINE_H
#define SCENE_IMPORT_CONFINE_H

#include "import.h"

/// Return true if import->confine lets the file be read. Return false if not.
bool scene_import_within(const struct scene_import *import, const char *path);
/// Return true if there is a regular file that may be read. A file that may not counts as none, so that a model cannot
/// be used to ask what else there is. Of a pipe, a device or a socket import->missing says what it is.
bool scene_import_is_file(struct scene_import *import, const char *path);
/// Take "name/.." out of a path: whether there is a folder of that name is nothing a confined model may ask.
void scene_import_drop_detours(char *path);

#endif
