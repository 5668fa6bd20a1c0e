// SPDX-License-Identifier: MIT
// What textures must hold and samples must be: written from the formulas of OpenGL ES 3.0 §3.8.10, one texel at a time
// in double, and sharing no formula with the library.
#ifndef TEST_TEXTURE_MODEL_H
#define TEST_TEXTURE_MODEL_H

#include "harness.h"
#include "resource/texture.h"

enum { SAMPLED_FORMATS = 9 };
extern const enum rhw_format sampled_formats[SAMPLED_FORMATS];

/// One texel as it stands in memory, in linear doubles.
void model_decode(enum rhw_format format, const unsigned char *texel, double value[4]);
/// `lod`: before the sampler's bias and limits.
void model_sample(const struct rhw_texture_data *texture, const struct rhw_sampler_def *sampler, double u,
                  double v, double lod, double value[4]);

/// A texture with random texels in every level: numbers within ±4 where the format is a float.
rhw_texture model_random_texture(rhw_context *context, enum rhw_format format, int width, int height,
                                 int levels, uint64_t *random);

#endif
