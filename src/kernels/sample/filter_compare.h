// SPDX-License-Identifier: MIT
// A special path of the sampler: shadow maps as most are, one level of floats in a plain 2D texture, compared and then
// filtered, without a border. It gives the bytes of filter_float.h in a fifth of the instructions, as it asks
// once what that asks for each texel. sampler.h and binding.c say what comes here.
#ifndef RHW_FILTER_COMPARE_H
#define RHW_FILTER_COMPARE_H

#include "../../binding.h"
#include "../../compare.h"
#include "../../sampler.h"
#include "reference.h"
#include "texel_fetch.h"

// The four texels of 8 lanes: left and right above, then below.
RHW_INLINE void load_footprint(const struct rhw_sampler_def *def, const struct rhw_mip *mip, i8 x, i8 y,
                               f8 texel[4])
{
    const i8 beyond =
        x | y | (mip->width - 2 - x) | (mip->height - 2 - y); // negative: it lies partly outside
    if (__builtin_expect(!rhw_any(beyond >> 31), 1)) {
        uint32_t at[RHW_LANES];
        i8 words[4];
        spill_lanes(texel_number((x << 16) | y, mip), at);
        i8_load_pairs(mip->texels, at, &words[0], &words[1]);
        i8_load_pairs(mip->texels + mip->row_pitch, at, &words[2], &words[3]);
        for (int i = 0; i < 4; i++) {
            texel[i] = (f8)words[i];
        }
        return;
    }
    for (int i = 0; i < 4; i++) {
        const i8 column = wrap_coordinate(def->address_u, x + (i & 1), mip->width),
                 row = wrap_coordinate(def->address_v, y + (i >> 1), mip->height);
        texel[i] = (f8)i8_gather(mip->texels, texel_number((column << 16) | row, mip));
    }
}

RHW_INLINE void compare_footprint(enum rhw_compare compare, f8 reference, f8 texel[4])
{
    for (int i = 0; i < 4; i++) {
        texel[i] = (f8)(compare_lanes(compare, reference, texel[i]) & (i8)rhw_splat(1.0f));
    }
}

static inline void sample_compared(const struct rhw_binding *binding,
                                   const struct rhw_sample_request *request, f8 texel[4])
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const struct rhw_mip *const mip = &binding->texture->mip[0];
    const f8 reference = reference_of(binding->texture->info, request);
    const f8 x = fold_coordinate(def->address_u, request->coordinates[0]) * (float)mip->width - 0.5f,
             y = fold_coordinate(def->address_v, request->coordinates[1]) * (float)mip->height - 0.5f;
    const f8 left = rhw_floor(x), top = rhw_floor(y);
    f8 held[4];
    load_footprint(def, mip, rhw_int_from_float_unchecked(left), rhw_int_from_float_unchecked(top), held);
    if (__builtin_expect(def->compare == RHW_COMPARE_LESS_EQUAL, 1)) { // named, so that no texel asks again
        compare_footprint(RHW_COMPARE_LESS_EQUAL, reference, held);
    } else {
        compare_footprint(def->compare, reference, held);
    }
    const f8 above = rhw_mix(held[0], held[1], x - left), below = rhw_mix(held[2], held[3], x - left);
    texel[0] = rhw_mix(above, below, y - top);
    texel[1] = texel[2] = rhw_splat(0.0f);
    texel[3] = rhw_splat(1.0f);
}

#endif
