// SPDX-License-Identifier: MIT
// Sampling of one binding, whether it lies in a slot or in memory of the program. A NULL binding stands for one that
// has nothing to sample.
#ifndef RHW_SAMPLE_ACCESS_H
#define RHW_SAMPLE_ACCESS_H

#include "binding.h"

static inline void rhw_no_texel(rhw_float texel[4])
{
    texel[0] = texel[1] = texel[2] = rhw_splat(0);
    texel[3] = rhw_splat(1);
}

// Sample a binding that is sampled, or that has no texture.
static inline void rhw_sample_bound(const struct rhw_binding_data *binding,
                                    const struct rhw_sample_request *request, rhw_float texel[4])
{
    if (((uintptr_t)request->bias | (uintptr_t)request->offset) == 0) {
        binding->sample(binding, request, texel);
    } else if (request->bias && binding->texture) {
        binding->kernels->sample_biased(binding, request, texel);
    } else if (request->offset) {
        binding->sample_offset(binding, request, texel);
    } else {
        binding->sample(binding, request, texel);
    }
}

// Do what the functions of shader_sample.h do that have these names.
void rhw_bound_compare_window(const struct rhw_binding_data *binding,
                              const struct rhw_sample_request *request, int columns, int rows,
                              rhw_float *parts);
void rhw_bound_gather(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                      int channel, rhw_float texel[4]);
void rhw_bound_fetch(const struct rhw_binding_data *binding, const rhw_int *at, const rhw_int *level,
                     rhw_float texel[4]);
void rhw_bound_fetch_sample(const struct rhw_binding_data *binding, const rhw_int *at, const rhw_int *sample,
                            rhw_float texel[4]);
void rhw_bound_query_lod(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                         rhw_float lod[2]);
void rhw_bound_size(const struct rhw_binding_data *binding, const rhw_int *level, rhw_int size[3]);

// Return the texture, of one sample or more. Return NULL where there is none.
static inline const struct rhw_texture_data *rhw_bound_texture(const struct rhw_binding_data *binding)
{
    return !binding                                      ? NULL
           : binding->kind == RHW_BINDING_MULTISAMPLED ? binding->multisampled
                                                         : binding->texture;
}

#endif
