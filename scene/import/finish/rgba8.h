// SPDX-License-Identifier: MIT
// Images of 8 bits.
#ifndef SCENE_RGBA8_H
#define SCENE_RGBA8_H

#include "import/builder/import.h"

/// Make 8 bits of 16. Return false for images of floats.
bool scene_import_make_rgba8(struct scene_import *import, struct scene_image *image);

#endif
