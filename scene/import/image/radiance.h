// SPDX-License-Identifier: MIT
// Radiance HDR files: whether their runs can be read. stb_image, which reads them, waits for ever on a run of nothing.
#ifndef SCENE_IMAGE_RADIANCE_H
#define SCENE_IMAGE_RADIANCE_H

#include <stddef.h>

/// A reason (static storage) where a run is empty, too long, or beyond the end, else NULL. What has another fault may pass;
/// stb_image finds it.
const char *scene_radiance_problem(const unsigned char *bytes, size_t size);

#endif
