// SPDX-License-Identifier: MIT
// What a binding that is not sampled plainly is asked for: windows, footprints, single texels, and sizes.
#include "sample_access.h"

#include "format/format.h"
#include "resource/texture.h"
#include "swizzle.h"

void rhw_no_texels(int count, uint32_t which, rhw_float (*texels)[4], int stride)
{
    for (; which != 0; which &= which - 1) {
        for (int g = 0; g < count; g++) {
            rhw_no_texel(texels[g * stride + __builtin_ctz(which)]);
        }
    }
}

void rhw_compare_columns(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                         int column, int columns, int rows, int stride, rhw_float *parts)
{
    struct rhw_sample_request shifted = *request;
    rhw_int offset[3] = {rhw_splat_int(0), rhw_splat_int(0), rhw_splat_int(0)}, first[3];
    const int axes = rhw_texture_components(binding->texture->shape.kind);
    for (int i = 0; request->offset && i < axes; i++) {
        offset[i] = request->offset[i];
    }
    memcpy(first, offset, sizeof first);
    shifted.offset = offset;
    for (int row = 0; row < rows; row++) {
        offset[1] = first[1] + row;
        for (int i = 0; i < columns; i++) {
            rhw_float texel[4];
            offset[0] = first[0] + (column + i);
            rhw_sample_bound(binding, &shifted, texel);
            parts[row * stride + i] = texel[0];
        }
    }
}

void rhw_bound_gather(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                      int channel, rhw_float texel[4])
{
    const bool is_asked = binding && binding->texture && channel >= 0 && channel < 4;
    if (!is_asked) {
        texel[0] = texel[1] = texel[2] = texel[3] = rhw_splat(channel == 3 ? 1.0f : 0.0f);
        return;
    }
    const enum rhw_swizzle swizzle = binding->texture->swizzle[channel];
    if (rhw_swizzle_is_constant(swizzle)) {
        texel[0] = rhw_constant_channel(binding->texture, swizzle);
        texel[1] = texel[2] = texel[3] = texel[0];
    } else {
        binding->kernels->gather(binding, request, rhw_swizzled_channel(binding->texture, channel), texel);
    }
}

void rhw_bound_fetch_sample(const struct rhw_binding_data *binding, const rhw_int *at, const rhw_int *sample,
                            rhw_float texel[4])
{
    if (binding && binding->kind == RHW_BINDING_MULTISAMPLED) {
        binding->kernels->fetch_sample(binding->multisampled, at, sample, texel);
        rhw_swizzle_texel(binding->multisampled, texel);
    } else {
        rhw_no_texel(texel);
    }
}

void rhw_bound_query_lod(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                         rhw_float lod[2])
{
    lod[0] = lod[1] = rhw_splat(0);
    if (binding && binding->texture) {
        binding->kernels->query_level(binding, request, lod);
    }
}

void rhw_bound_size(const struct rhw_binding_data *binding, const rhw_int *level, rhw_int size[3])
{
    const struct rhw_binding_data any = {.texture = rhw_bound_texture(binding)};
    size[0] = size[1] = size[2] = rhw_splat_int(0);
    if (any.texture) {
        binding->kernels->query_size(&any, level, size);
    }
}
