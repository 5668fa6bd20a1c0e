// SPDX-License-Identifier: MIT
// What shader functions get of a texture slot: struct rhw_binding, filled.
#ifndef RHW_BINDING_H
#define RHW_BINDING_H

#include "rhw/shader.h"

struct rhw_kernels;
struct rhw_texture_data;
struct rhw_sampler_data;

// `kernels`' functions for this texture and sampler; both NULL for a slot without one. An RGBA8_SRGB texture must be
// linearized.
struct rhw_binding rhw_binding_of(const struct rhw_kernels *kernels, const struct rhw_texture_data *texture,
                                  const struct rhw_sampler_data *sampler);

#endif
