// SPDX-License-Identifier: MIT
// See texture_model.h.
#include "texture_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "format/format.h"
#include "reference.h"

const enum rhw_format sampled_formats[SAMPLED_FORMATS] = {
    RHW_FORMAT_R8_UNORM,     RHW_FORMAT_RG8_UNORM,    RHW_FORMAT_RGBA8_UNORM,
    RHW_FORMAT_RGBA8_SRGB,   RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_R32_FLOAT,
    RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_D32_FLOAT,    RHW_FORMAT_RG16_FLOAT};

void model_decode(enum rhw_format format, const unsigned char *texel, double value[4])
{
    uint16_t half[4];
    float word[4];
    value[0] = value[1] = value[2] = 0;
    value[3] = 1;
    switch (format) {
    case RHW_FORMAT_R8_UNORM:
    case RHW_FORMAT_RG8_UNORM:
    case RHW_FORMAT_RGBA8_UNORM:
    case RHW_FORMAT_RGBA8_SRGB:
        for (size_t c = 0; c < rhw_format_size(format); c++) {
            value[c] = texel[c] / 255.0;
            if (format == RHW_FORMAT_RGBA8_SRGB && c < 3) {
                value[c] = ref_srgb_decode(value[c]);
            }
        }
        break;
    case RHW_FORMAT_RG16_FLOAT:
    case RHW_FORMAT_RGBA16_FLOAT:
        memcpy(half, texel, rhw_format_size(format));
        for (size_t c = 0; c < rhw_format_size(format) / sizeof half[0]; c++) {
            value[c] = ref_half(half[c]);
        }
        break;
    case RHW_FORMAT_RGBA32_FLOAT:
        memcpy(word, texel, sizeof word);
        for (int c = 0; c < 4; c++) {
            value[c] = (double)word[c];
        }
        break;
    default:
        memcpy(word, texel, sizeof word[0]);
        value[0] = (double)word[0];
        break;
    }
}

// A texel by its number on an endless plane.
static void model_texel(const struct rhw_texture_data *texture, const struct rhw_sampler_def *sampler,
                        int level, long x, long y, double value[4])
{
    const struct rhw_mip *const mip = &texture->mip[level];
    const enum rhw_address mode[2] = {sampler->address_u, sampler->address_v};
    const long size[2] = {mip->width, mip->height};
    long at[2] = {x, y};
    for (int i = 0; i < 2; i++) {
        const long n = size[i];
        long period;
        switch (mode[i]) {
        case RHW_ADDRESS_REPEAT: at[i] = (at[i] % n + n) % n; break;
        case RHW_ADDRESS_MIRROR:
            period = (at[i] % (2 * n) + 2 * n) % (2 * n);
            at[i] = period < n ? period : 2 * n - 1 - period;
            break;
        case RHW_ADDRESS_MIRROR_ONCE:
            at[i] = at[i] < 0 ? -1 - at[i] : at[i];
            at[i] = at[i] >= n ? n - 1 : at[i];
            break;
        case RHW_ADDRESS_CLAMP: at[i] = at[i] < 0 ? 0 : at[i] >= n ? n - 1 : at[i]; break;
        case RHW_ADDRESS_BORDER:
            if (at[i] < 0 || at[i] >= n) {
                for (int c = 0; c < 4; c++) {
                    const float lacking = c < 3 ? 0.0f : 1.0f;
                    value[c] = (double)(c < texture->info->channels ? sampler->border[c] : lacking);
                }
                return;
            }
            break;
        }
    }
    model_decode(texture->format,
                 mip->texels + (size_t)at[1] * mip->row_pitch +
                     (size_t)at[0] * rhw_format_size(texture->format),
                 value);
}

static void model_level(const struct rhw_texture_data *texture, const struct rhw_sampler_def *sampler,
                        int level, enum rhw_filter filter, double u, double v, double value[4])
{
    const double x = u * texture->mip[level].width, y = v * texture->mip[level].height;
    if (filter == RHW_FILTER_NEAREST) {
        model_texel(texture, sampler, level, (long)floor(x), (long)floor(y), value);
        return;
    }
    const double left = floor(x - 0.5), top = floor(y - 0.5);
    const double fx = x - 0.5 - left, fy = y - 0.5 - top;
    for (int c = 0; c < 4; c++) {
        value[c] = 0;
    }
    for (int corner = 0; corner < 4; corner++) {
        double texel[4];
        model_texel(texture, sampler, level, (long)left + (corner & 1), (long)top + (corner >> 1), texel);
        const double weight = (corner & 1 ? fx : 1 - fx) * (corner >> 1 ? fy : 1 - fy);
        for (int c = 0; c < 4; c++) {
            value[c] += weight * texel[c];
        }
    }
}

void model_sample(const struct rhw_texture_data *texture, const struct rhw_sampler_def *sampler, double u,
                  double v, double lod, double value[4])
{
    const double lambda =
        fmin(fmax(lod + (double)sampler->lod_bias, (double)sampler->lod_min), (double)sampler->lod_max);
    const int last = texture->levels - 1;
    if (lambda <= 0 && sampler->mag_filter != sampler->min_filter) {
        model_level(texture, sampler, 0, sampler->mag_filter, u, v, value);
        return;
    }
    const double within = fmin(fmax(lambda, 0), last);
    if (sampler->mip_filter == RHW_MIP_FILTER_NONE) {
        model_level(texture, sampler, 0, sampler->min_filter, u, v, value);
    } else if (sampler->mip_filter == RHW_MIP_FILTER_NEAREST) {
        model_level(texture, sampler, (int)ceil(within + 0.5) - 1, sampler->min_filter, u, v, value);
    } else {
        const int level = (int)within;
        double coarse[4];
        model_level(texture, sampler, level, sampler->min_filter, u, v, value);
        model_level(texture, sampler, level < last ? level + 1 : last, sampler->min_filter, u, v, coarse);
        for (int c = 0; c < 4; c++) {
            value[c] += (within - level) * (coarse[c] - value[c]);
        }
    }
}

rhw_texture model_random_texture(rhw_context *context, enum rhw_format format, int width, int height,
                                 int levels, uint64_t *random)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = width;
    def.height = height;
    def.mip_levels = levels;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(context, &def, &texture), RHW_OK);
    const size_t size = rhw_format_size(format);
    const bool has_halves = format == RHW_FORMAT_RG16_FLOAT || format == RHW_FORMAT_RGBA16_FLOAT;
    for (int level = 0; level < rhw_texture_mip_levels(context, texture); level++) {
        const size_t count = (size_t)rhw_texture_width(context, texture, level) *
                             (size_t)rhw_texture_height(context, texture, level) * size;
        unsigned char *const texels = malloc(count);
        for (size_t i = 0; i < count; i += size) {
            for (size_t c = 0; c < size; c++) {
                texels[i + c] = (unsigned char)rig_random(random);
            }
            for (size_t c = 0; has_halves && c < size / 2; c++) {
                const int sign = rig_random_int(random, 2) << 7;
                texels[i + 2 * c + 1] = (unsigned char)(rig_random_int(random, 0x44) | sign);
            }
            for (size_t c = 0; format >= RHW_FORMAT_R32_FLOAT && c < size / 4; c++) {
                const float value = rig_random_float(random, -4.0f, 4.0f);
                memcpy(texels + i + 4 * c, &value, sizeof value);
            }
        }
        rhw_texture_write(context, texture, level, texels, 0);
        free(texels);
    }
    return texture;
}
