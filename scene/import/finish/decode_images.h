// SPDX-License-Identifier: MIT
// The images of a model.
#ifndef SCENE_DECODE_IMAGES_H
#define SCENE_DECODE_IMAGES_H

#include "import/builder/import.h"

/// Decode all images. An image that cannot be decoded becomes the stand-in, with a warning.
void scene_import_decode_images(struct scene_import *import);

#endif
