// SPDX-License-Identifier: MIT Light from a picture of all that surrounds the model: a panorama in equirectangular
// projection, as .hdr and .exr files of skies and studios are.
#ifndef SCENE_PANORAMA_H
#define SCENE_PANORAMA_H

#include "model.h"
#include "rhw/rhw.h"
#include "draw/shading/scene_shaders.h"
#include "scene_view.h"

/// Linear light, rows from straight up to straight down; the middle column looks along +X, the one a quarter further
/// along +Z, with the axes turned as `up` and a rotation say.
struct scene_panorama {
    int width, height; ///< 1..RHW_MAX_TARGET_SIZE
    float (*texels)[4];
};

/// A panorama in the context's memory. Zeroed: none.
struct scene_surroundings {
    rhw_texture picture, cube;
    rhw_sampler picture_sampler, cube_sampler;
    struct scene_environment environment; ///< for shaders, without exposure
    struct scene_shader_light sun; ///< the light of a small spot that outshines the rest; black: there is none
    const struct scene_panorama *panorama;
    enum scene_axis up;
    double rotation;
};

/// Makes the surroundings from the panorama of a view, which outlives them, unless they are made of it already. They
/// are scaled so that the mean of their light is 0.75: a file's numbers are rarely in a unit. Degrees of rotation turn
/// them about the up direction, against the clock as seen from above. The view is asked whether to go on.
enum rhw_result scene_surroundings_make(struct scene_surroundings *surroundings, rhw_context *context,
                                        const struct scene_view *view);
void scene_surroundings_destroy(rhw_context *context, struct scene_surroundings *surroundings);

/// Uniforms of the background that shows them in a view.
struct scene_panorama_pass scene_surroundings_background(const struct scene_surroundings *surroundings,
                                                         const struct scene_view *view);

#endif
