// SPDX-License-Identifier: MIT
// The EXR decoder behind image_load.h.
#ifndef RHW_IMAGE_LOAD_EXR_H
#define RHW_IMAGE_LOAD_EXR_H

#include "image_load.h"

/// Fills `image`, whose memory the caller frees also on failure. Reports failure in one line.
bool rhw_image_load_exr(struct rhw_loaded_image *image, const char *path);

#endif
