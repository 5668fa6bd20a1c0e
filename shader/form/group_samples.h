// SPDX-License-Identifier: MIT
// Samples at coordinates that are inputs, as those of a material mostly are. Outside of structure they need nothing
// that the code computes, so they are done for all groups before the code of the first begins: the library samples
// textures of one size together, and the texels of one are on their way while it filters another.
#ifndef SHADER_GROUP_SAMPLES_H
#define SHADER_GROUP_SAMPLES_H

#include "linked_stage.h"
#include "plan.h"

enum { SHADER_MAX_GROUP_SAMPLES = 16 };

// A SAMPLE that is done for all groups.
struct shader_group_sample {
    uint32_t value;
    uint32_t at;               // number of its first coordinate among the varyings
    uint32_t texture, sampler; // BUFFER nodes; SHADER_NONE: the texture has its sampler
};

// Find the samples of a fragment shader, and take their reads of inputs out of the plan. Return how many there are.
uint32_t shader_find_group_samples(const struct shader_linked_stage *stage, struct shader_plan *plan,
                                   struct shader_group_sample samples[SHADER_MAX_GROUP_SAMPLES]);

// Return bits of the samples that have the same coordinates as the first of `left`, which are taken out of it.
uint32_t shader_samples_alike(const struct shader_group_sample *samples, uint32_t count, uint32_t *left);

#endif
