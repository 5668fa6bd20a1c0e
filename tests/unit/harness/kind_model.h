// SPDX-License-Identifier: MIT
// What samples of textures of every kind must be: written from the words of Vulkan's chapter "Image Operations", one
// texel at a time in double, and sharing no formula with the library. What lies across a cube's edge is found by looking
// for it among all texels of the cube.
#ifndef TEST_KIND_MODEL_H
#define TEST_KIND_MODEL_H

#include "texture_model.h"

/// One sample. `lod`: before the sampler's bias and limits.
struct kind_request {
    double coordinates[4]; ///< as the texture's kind has them, the layer behind
    double lod;
    int offset[3];
};

void kind_model_sample(const struct rhw_texture_data *texture, const struct rhw_sampler_def *sampler,
                       const struct kind_request *request, double value[4]);

/// Face 0..5 that a direction goes through and the coordinates there.
int kind_model_face(const double direction[3], double st[2]);

/// A texture of random texels in every level, layer and slice: numbers within ±4 where the format is a float.
rhw_texture kind_model_texture(rhw_context *context, const struct rhw_texture_def *def, uint64_t *random);

#endif
