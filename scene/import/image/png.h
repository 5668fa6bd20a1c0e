// SPDX-License-Identifier: MIT
// What the header of a PNG file says, and large files, which are read row by row and reduced on the way, so that the
// whole image is never in memory.
#ifndef SCENE_IMAGE_PNG_H
#define SCENE_IMAGE_PNG_H

#include "model.h"

/// Set the width and height that the header says. Return false if there is no header.
bool scene_png_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
/// Return a reason (static storage) if stb_image cannot take the samples of a file because they are too many. Return
/// NULL if not.
const char *scene_png_problem(const unsigned char *bytes, size_t size);
/// Return true if the bytes are a PNG file whose rows follow one another, which is a file without interlacing.
bool scene_image_is_png_of_rows(const unsigned char *bytes, size_t size);
/// Decode a PNG file as scene_image_decode does, but no longer than `side` each way.
const char *scene_image_decode_png_reduced(const unsigned char *bytes, size_t size, uint32_t side,
                                           bool is_color, struct scene_image *image);

#endif
