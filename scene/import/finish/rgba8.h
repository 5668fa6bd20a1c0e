// SPDX-License-Identifier: MIT
// Images as 8 bits, which other images are computed from, and the alpha of images of every type.
#ifndef SCENE_RGBA8_H
#define SCENE_RGBA8_H

#include "import/builder/import.h"

/// Return the value at a place in the texels, rounded to 8 bits. What floats count is from 0 to 1, as they are.
uint8_t scene_import_value8(const struct scene_image *image, size_t place);
/// Set the value at a place in the texels.
void scene_import_set_value8(struct scene_image *image, size_t place, uint8_t value);
/// Make 8 bits of any other type.
void scene_import_make_rgba8(struct scene_import *import, struct scene_image *image);

#endif
