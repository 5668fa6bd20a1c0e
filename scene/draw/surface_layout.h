// SPDX-License-Identifier: MIT
// The uniforms of an instance in a pass, and what its pipeline is made from.
#ifndef SCENE_SURFACE_LAYOUT_H
#define SCENE_SURFACE_LAYOUT_H

#include "surface_pass.h"

void scene_surface_lay_out(const struct scene_upload *upload, const struct scene_surface_pass *def,
                           uint32_t instance_index, struct scene_surface *s, struct scene_surface_key *key);

#endif
