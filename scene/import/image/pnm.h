// SPDX-License-Identifier: MIT
// Grey and coloured images of Netpbm (.pgm, .ppm) whose samples are bytes, one or two for each.
#ifndef SCENE_IMAGE_PNM_H
#define SCENE_IMAGE_PNM_H

#include "model.h"

/// Set the width and height that the header says. Return false if it is damaged, or the file ends before.
bool scene_pnm_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
/// Decode a PNM as scene_image_decode does, but leave has_alpha alone.
const char *scene_image_decode_pnm(const unsigned char *bytes, size_t size, struct scene_image *image);

#endif
