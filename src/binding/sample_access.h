// SPDX-License-Identifier: MIT
// Sampling of one binding, whether it lies in a slot or in memory of the program. A NULL binding stands for one that
// has nothing to sample.
#ifndef RHW_SAMPLE_ACCESS_H
#define RHW_SAMPLE_ACCESS_H

#include "binding.h"
#include "resource/texture.h"
#include "swizzle.h"

static inline void rhw_no_texel(rhw_float texel[4])
{
    texel[0] = texel[1] = texel[2] = rhw_splat(0);
    texel[3] = rhw_splat(1);
}

// Give groups the texels of bindings that have nothing to sample, whose bits `which` has.
void rhw_no_texels(int count, uint32_t which, rhw_float (*texels)[4], int stride);

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

// Compare the columns of a window's footprints one by one.
void rhw_compare_columns(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                         int column, int columns, int rows, int stride, rhw_float *parts);

// These functions do what those of shader_sample.h do that are named likewise.
static inline void rhw_bound_compare_window(const struct rhw_binding_data *binding,
                                            const struct rhw_sample_request *request, int columns, int rows,
                                            rhw_float *parts)
{
    const bool is_bound = binding && binding->texture;
    for (int i = 0; !is_bound && i < columns * rows; i++) {
        parts[i] = rhw_splat(0);
    }
    for (int column = 0; is_bound && column < columns; column += RHW_WINDOW_COLUMNS) {
        const int count = columns - column < RHW_WINDOW_COLUMNS ? columns - column : RHW_WINDOW_COLUMNS;
        if (request->bias || !binding->compares_windows ||
            !binding->kernels->compare_window(binding, request, column, count, rows, columns,
                                              parts + column)) {
            rhw_compare_columns(binding, request, column, count, rows, columns, parts + column);
        }
    }
}

static inline void rhw_bound_fetch(const struct rhw_binding_data *binding, const rhw_int *at,
                                   const rhw_int *level, rhw_float texel[4])
{
    if (binding && binding->texture) {
        binding->kernels->fetch(binding, at, level, texel);
        rhw_swizzle_texel(binding->texture, texel);
    } else {
        rhw_no_texel(texel);
    }
}

void rhw_bound_gather(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                      int channel, rhw_float texel[4]);
void rhw_bound_fetch_sample(const struct rhw_binding_data *binding, const rhw_int *at, const rhw_int *sample,
                            rhw_float texel[4]);
void rhw_bound_query_lod(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                         rhw_float lod[2]);
void rhw_bound_size(const struct rhw_binding_data *binding, const rhw_int *level, rhw_int size[3]);

// Return the texture, of one sample or more. Return NULL where there is none.
static inline const struct rhw_texture_data *rhw_bound_texture(const struct rhw_binding_data *binding)
{
    return !binding                                    ? NULL
           : binding->kind == RHW_BINDING_MULTISAMPLED ? binding->multisampled
                                                       : binding->texture;
}

// Return a binding of a texture, of one sample or more. Return NULL for others.
static inline const struct rhw_binding_data *rhw_binding_textured(const struct rhw_binding *binding)
{
    const struct rhw_binding_data *const data = rhw_binding_look(binding);
    const bool has_texture =
        data && (data->kind == RHW_BINDING_SAMPLED || data->kind == RHW_BINDING_TEXTURE ||
                 data->kind == RHW_BINDING_MULTISAMPLED);
    return has_texture ? data : NULL;
}

#endif
