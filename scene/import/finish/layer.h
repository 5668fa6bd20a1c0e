// SPDX-License-Identifier: MIT
// Images over images.
#ifndef SCENE_LAYER_H
#define SCENE_LAYER_H

#include "import/builder/import.h"

/// Lay an image over what its source says lies below. The image is opaque afterwards.
void scene_import_lay_image(struct scene_import *import, struct scene_image *image,
                            const struct scene_import_layer *layer);

#endif
