// SPDX-License-Identifier: MIT
// Textures that are drawn into, kept from draw to draw.
#ifndef SCENE_RENDER_TARGET_H
#define SCENE_RENDER_TARGET_H

#include "rhw/rhw.h"

/// Zeroed: no texture.
struct scene_target {
    rhw_texture texture;
    enum rhw_format format;
    int width, height, samples;
};

/// Makes the texture anew unless it is of that format and size already.
enum rhw_result scene_target_get(rhw_context *context, struct scene_target *target, enum rhw_format format,
                                 int width, int height);
/// Gets a target as scene_target_get does, with a whole chain of levels.
enum rhw_result scene_target_get_levels(rhw_context *context, struct scene_target *target,
                                        enum rhw_format format, int width, int height);
/// Gets a target as scene_target_get does, with several samples of each texel; 1 is allowed.
enum rhw_result scene_target_get_samples(rhw_context *context, struct scene_target *target,
                                         enum rhw_format format, int width, int height, int samples);
void scene_target_destroy(rhw_context *context, struct scene_target *target);

/// A texture of one float per texel in memory that shaders can gather from. Zeroed: none.
struct scene_plane {
    rhw_texture texture;
    float *texels; ///< rows of `pitch`; the texture stands on them
    int pitch;
    rhw_buffer buffer; ///< what they lie in, mapped: the library's memory is on huge pages
};

/// `format`: R32_FLOAT or D32_FLOAT.
enum rhw_result scene_plane_create(rhw_context *context, enum rhw_format format, int width, int height,
                                   struct scene_plane *plane);
void scene_plane_destroy(rhw_context *context, struct scene_plane *plane);

#endif
