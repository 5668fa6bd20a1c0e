// SPDX-License-Identifier: MIT
// Textures and samplers that tests of bindings bind.
#ifndef BOUND_THINGS_H
#define BOUND_THINGS_H

#include "context/context.h"
#include "context/lookup.h"
#include "format/format.h"
#include "harness.h"
#include "resource/texture.h"

#include <stdlib.h>
#include <string.h>

static inline rhw_texture make_texture(const struct rig *rig, const struct rhw_texture_def *def)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, def, &texture), RHW_OK);
    return texture;
}

static inline rhw_sampler make_sampler(const struct rig *rig, const struct rhw_sampler_def *def)
{
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, def, &sampler), RHW_OK);
    return sampler;
}

static inline void write_noise(const struct rig *rig, rhw_texture texture, uint64_t seed)
{
    for (int level = 0; level < rhw_texture_mip_levels(rig->context, texture); level++) {
        const struct rhw_texture_data *const data = rhw_context_texture(rig->context, texture, "test");
        const struct rhw_mip *const mip = &data->mip[level];
        const size_t row = (size_t)mip->width * data->info->size;
        unsigned char *const texels = malloc(row * (size_t)mip->height);
        for (int slice = 0; slice < mip->slices; slice++) {
            for (size_t i = 0; i < row * (size_t)mip->height; i++) {
                texels[i] = (unsigned char)(rig_random(&seed) & 0x3b); // no NaN as a float or a half
            }
            const struct rhw_texture_region region = {
                .level = level, .z = slice, .width = mip->width, .height = mip->height, .depth = 1};
            assert_int_equal(rhw_texture_write_region(rig->context, texture, &region, texels, 0, 0), RHW_OK);
        }
        free(texels);
    }
}

#endif
