// SPDX-License-Identifier: MIT
// The files that a model names.
#ifndef SCENE_FIND_FILE_H
#define SCENE_FIND_FILE_H

#include "import.h"

/// Find the file that a model means by `name`, in the bytes of the model's file. It may be relative, quoted,
/// percent-encoded, with backslashes, in other case or in another code page. Return NULL if there is none that may be
/// read; import->missing then says why. It says the same of a file that is not there and of one that import->confine
/// keeps out.
const char *scene_import_find_file(struct scene_import *import, const char *name);
/// Set where the image comes from that a model means by `name`. A data URI gives the bytes themselves. An entry of the
/// archive that the model is in comes first. A file is found as scene_import_find_file does, and otherwise one that is
/// called as it is up to the ending. `folder` has the file that names it, as import->directory has the model, and is
/// where it is looked for first; NULL is the model's own.
void scene_import_find_image(struct scene_import *import, const char *folder, const char *name,
                             struct scene_import_source *source);

#endif
