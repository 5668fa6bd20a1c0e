// SPDX-License-Identifier: MIT
// The names in a folder, for files that are called in other letters or end otherwise than a model says.
#ifndef SCENE_IMPORT_FOLDER_H
#define SCENE_IMPORT_FOLDER_H

#include "import.h"

/// Return true if `path` is a file, or becomes one by other letters of its components (capital, small). Its first
/// `known` bytes stay. With `any_ending` the file may be an image that ends otherwise. `path` has room for
/// SCENE_FOLDER_ENDING bytes more and becomes the path of the file.
bool scene_folder_find(struct scene_import *import, char *path, size_t known, bool any_ending);

/// Return the path of the image that is called `stem`, in any letters, or of the only one, in the folder at `path`,
/// which ends with a slash. Return NULL if there is none, or more. Images of formats that rhw writes (PNG, JPEG, WebP,
/// EXR and PPM) count `if_written` alone, as one may be a picture of the model: two runs would draw two pictures.
const char *scene_folder_own_image(struct scene_import *import, const char *path, const char *stem,
                                   bool if_written);
const char *scene_folder_only_image(struct scene_import *import, const char *path);

enum { SCENE_FOLDER_ENDING = 8 };

#endif
