// SPDX-License-Identifier: MIT
// Images of Silicon Graphics (.sgi, .rgb, .rgba, .bw), which models of AC3D and of simulators have.
#ifndef SCENE_IMAGE_SGI_H
#define SCENE_IMAGE_SGI_H

#include "model.h"

/// Set the width and height that the header says. Return false if the file ends before it says them.
bool scene_sgi_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
/// Decode an SGI file as scene_image_decode does, but leave has_alpha alone.
const char *scene_image_decode_sgi(const unsigned char *bytes, size_t size, struct scene_image *image);

#endif
