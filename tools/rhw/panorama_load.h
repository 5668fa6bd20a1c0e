// SPDX-License-Identifier: MIT
// Panoramas that light a model: Radiance HDR and OpenEXR files.
#ifndef CLI_PANORAMA_LOAD_H
#define CLI_PANORAMA_LOAD_H

#include <stdbool.h>

#include "draw/panorama.h"

/// What no light can be (negative, infinite, not a number) becomes black or the most that half floats hold; alpha 1.
void cli_panorama_clean(struct scene_panorama *panorama);
/// Reads one, and cleans it. Reports failure in one line. The texels are the caller's to free.
bool cli_panorama_load(struct scene_panorama *panorama, const char *path);

#endif
