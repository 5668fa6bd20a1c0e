// SPDX-License-Identifier: MIT
// The WebP decoder behind image_load.h.
#ifndef CLI_IMAGE_LOAD_WEBP_H
#define CLI_IMAGE_LOAD_WEBP_H

#include "image_load.h"

#include <stdio.h>

/// Reads width, height and `memory`, R, G, B and A of 8 bits, which the caller frees also on failure. Reports failure
/// in one line.
bool cli_image_load_webp(struct cli_loaded_image *image, const char *path, FILE *stream);

#endif
