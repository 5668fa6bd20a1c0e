// SPDX-License-Identifier: MIT
// Models that no file has, for the physically based scenes: written to a folder that is gone afterwards, and read as any
// other.
#ifndef BENCH_SCENE_PBR_MADE_H
#define BENCH_SCENE_PBR_MADE_H

#include "model.h"

#include <stddef.h>

// 10,000 strands of 16 transparent triangles that hang from a ball. NULL, with a line in `why`, on failure; both.
struct scene_model *bench_make_hair(char *why, size_t why_size);
// 12 spheres that light passes through, of three roughnesses, before a wall with a texture.
struct scene_model *bench_make_glass(char *why, size_t why_size);

#endif
