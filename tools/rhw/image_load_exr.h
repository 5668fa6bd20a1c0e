// SPDX-License-Identifier: MIT
// The EXR decoder behind image_load.h.
#ifndef CLI_IMAGE_LOAD_EXR_H
#define CLI_IMAGE_LOAD_EXR_H

#include "image_load.h"

/// Fills `image`, whose memory the caller frees also on failure. Reports failure in one line.
bool cli_image_load_exr(struct cli_loaded_image *image, const char *path);

#endif
