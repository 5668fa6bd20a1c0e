// SPDX-License-Identifier: MIT
// Storage images and texel buffers from shader functions: texels read, written and changed by atomics, at whole
// coordinates. Included by shader.h. Writing and atomics are effects, as shader_storage.h says.
#ifndef RHW_SHADER_IMAGE_H
#define RHW_SHADER_IMAGE_H

#include "shader_storage.h"

/// A lane of rhw_image_load, rhw_image_store, rhw_image_atomic and rhw_image_size.
RHW_API void rhw_image_load1(const struct rhw_bindings *textures, int slot, const int32_t *at,
                             float texel[4]);
RHW_API void rhw_image_store1(const struct rhw_bindings *textures, int slot, const int32_t *at,
                              const float texel[4]);
RHW_API int32_t rhw_image_atomic1(const struct rhw_bindings *textures, int slot,
                                  enum rhw_storage_operation operation, const int32_t *at, int32_t value,
                                  int32_t comparand);
RHW_API void rhw_image_size1(const struct rhw_bindings *textures, int slot, int32_t size[3]);

#if RHW_HAS_LANES

/// The texel at `at` of image slot `slot`, 0..RHW_MAX_STORAGE_IMAGES − 1, that a group's `textures` stand for: `at` has x,
/// y and z as the texture has them, and the layer of an array; of a cube x, y and 6 × cube + face; of a texel buffer x. It
/// is decoded as by rhw_sample_fetch; integer formats give their bits. Outside it is 0 in the channels that the format
/// has; those that it lacks are 0, 0, 0, 1, of integers the whole number, as all are in a slot without an image (robustImageAccess2).
RHW_API void rhw_image_load(const struct rhw_bindings *textures, int slot, const rhw_int *at,
                            rhw_float texel[4]);

/// Writes the texels of lanes of `mask` (NULL: all), encoded as a colour target's; nothing outside, lane after lane from the
/// first. A texel of several words is not written in one step.
RHW_API void rhw_image_store(const struct rhw_bindings *textures, int slot, const rhw_int *at,
                             const rhw_int *mask, const rhw_float texel[4]);

/// Does what the request says to texels of R32_UINT and R32_SINT: request->index is what `at` is elsewhere. `before` gets the texels as
/// they were, 0 outside and with other formats, which stay as they are; it may be NULL.
RHW_API void rhw_image_atomic(const struct rhw_bindings *textures, int slot,
                              const struct rhw_storage_request *request, rhw_int *before);

/// Width, height and, of a 3D texture, slices of the level that is set, else layers, six for each cube; 1 for what the kind
/// lacks. Zeros in a slot without an image.
RHW_API void rhw_image_size(const struct rhw_bindings *textures, int slot, rhw_int size[3]);

#endif

#endif
