// SPDX-License-Identifier: MIT
// Radiance HDR files: whether their runs can be read. stb_image, which reads the files, waits for ever on a run of
// nothing.
#ifndef SCENE_IMAGE_RADIANCE_H
#define SCENE_IMAGE_RADIANCE_H

#include <stddef.h>

/// Return a reason (static storage) if a run is empty, too long, or beyond the end. Return NULL if not. A file with
/// another fault may pass, and stb_image finds that fault.
const char *scene_radiance_problem(const unsigned char *bytes, size_t size);

#endif
