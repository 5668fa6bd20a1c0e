// SPDX-License-Identifier: MIT
// A special path of the sampler serves shadow maps as most are: one level of floats in a plain 2D texture, compared and
// then filtered, without a border. It gives the bytes of filter_float.h in a fifth of the instructions, as it asks once
// what filter_float.h asks for each texel. sampler.h and binding.c decide what comes here. Windows of footprints a
// texel apart, as percentage-closer filters take them, share texels, outcomes and what is mixed along rows: 36 % fewer
// instructions in shadow_map.
#ifndef RHW_FILTER_COMPARE_H
#define RHW_FILTER_COMPARE_H

#include "binding/binding.h"
#include "base/compare.h"
#include "resource/sampler.h"
#include "depth_reference.h"
#include "texel_fetch.h"
#include "wrap.h"

// Load the four texels of 8 lanes: left and right above, then below.
RHW_INLINE void load_footprint(const struct rhw_sampler_def *def, const struct rhw_mip *mip, i32x8 x, i32x8 y,
                               f32x8 texel[4])
{
    // The bits are negative where the footprint lies partly outside.
    const i32x8 beyond = x | y | (mip->width - 2 - x) | (mip->height - 2 - y);
    if (__builtin_expect(!rhw_any(beyond >> 31), 1)) {
        uint32_t at[RHW_LANES];
        i32x8 words[4];
        spill_lanes(texel_number((x << 16) | y, mip), at);
        i32x8_load_pairs(mip->texels, at, &words[0], &words[1]);
        i32x8_load_pairs(mip->texels + mip->row_pitch, at, &words[2], &words[3]);
        for (int i = 0; i < 4; i++) {
            texel[i] = (f32x8)words[i];
        }
        return;
    }
    for (int i = 0; i < 4; i++) {
        const i32x8 column = wrap_coordinate(def->address_u, x + (i & 1), mip->width),
                    row = wrap_coordinate(def->address_v, y + (i >> 1), mip->height);
        texel[i] = (f32x8)i32x8_gather(mip->texels, texel_number((column << 16) | row, mip));
    }
}

RHW_INLINE void compare_footprint(enum rhw_compare compare, f32x8 reference, f32x8 texel[4])
{
    for (int i = 0; i < 4; i++) {
        texel[i] = (f32x8)(compare_lanes(compare, reference, texel[i]) & (i32x8)rhw_splat(1.0f));
    }
}

static inline void sample_compared(const struct rhw_binding_data *binding,
                                   const struct rhw_sample_request *request, f32x8 texel[4])
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const struct rhw_mip *const mip = &binding->texture->mip[0];
    const f32x8 reference = reference_of(binding->texture->info, request);
    const f32x8 x = fold_coordinate(def->address_u, request->coordinates[0]) * (float)mip->width - 0.5f,
                y = fold_coordinate(def->address_v, request->coordinates[1]) * (float)mip->height - 0.5f;
    const f32x8 left = rhw_floor(x), top = rhw_floor(y);
    f32x8 held[4];
    load_footprint(def, mip, rhw_int_from_float_unchecked(left), rhw_int_from_float_unchecked(top), held);
    // The comparison is named, so that no texel asks for it again.
    if (__builtin_expect(def->compare == RHW_COMPARE_LESS_EQUAL, 1)) {
        compare_footprint(RHW_COMPARE_LESS_EQUAL, reference, held);
    } else {
        compare_footprint(def->compare, reference, held);
    }
    const f32x8 above = rhw_mix(held[0], held[1], x - left), below = rhw_mix(held[2], held[3], x - left);
    texel[0] = rhw_mix(above, below, y - top);
    texel[1] = texel[2] = rhw_splat(0.0f);
    texel[3] = rhw_splat(1.0f);
}

// Windows -------------------------------------------------------------------------------------------

// A part of a window: `columns` (up to RHW_WINDOW_COLUMNS) of its columns of footprints, from number `column` on.
struct compared_window {
    int column, columns, rows;
    int stride; // footprints from row to row of the whole window
};

// Where a window's first texel lies in each lane, and the weights of right and lower texels, by the formulas of
// filter_general.h, which offsets ask for.
struct window_place {
    i32x8 x, y;
    f32x8 weight_x, weight_y;
};

RHW_INLINE void place_along(enum rhw_address address, f32x8 coordinate, int size, i32x8 *low, f32x8 *weight)
{
    const f32x8 at = unfolded_texels(fold_period(address, coordinate), rhw_splat((float)size)) - 0.5f;
    const f32x8 floor = rhw_floor(at);
    *low = rhw_int_from_float_unchecked(floor);
    *weight = at - floor;
}

// Find where a window lies. Return false where an offset is beyond its limits.
RHW_INLINE bool find_window(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                            const struct compared_window *window, struct window_place *place)
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const struct rhw_mip *const mip = &binding->texture->mip[0];
    place_along(def->address_u, request->coordinates[0], mip->width, &place->x, &place->weight_x);
    place_along(def->address_v, request->coordinates[1], mip->height, &place->y, &place->weight_y);
    place->x = place->x + window->column;
    if (!request->offset) {
        return true;
    }
    const i32x8 right = request->offset[0], down = request->offset[1];
    place->x = place->x + right;
    place->y = place->y + down;
    const i32x8 beyond = (right + 0x8000) | (0x7000 - right) | (down + 0x8000) | (0x7000 - down);
    return !rhw_any(beyond >> 31);
}

RHW_INLINE bool is_inside(const struct rhw_mip *mip, const struct compared_window *window,
                          const struct window_place *place)
{
    // The bits are negative where some texel lies outside.
    const i32x8 beyond = place->x | (mip->width - 1 - RHW_WINDOW_COLUMNS - place->x) | place->y |
                         (mip->height - 1 - window->rows - place->y);
    return !rhw_any(beyond >> 31);
}

// Load a row of a window's texels, from the words `at` of its first row on.
RHW_INLINE void load_inner_row(const unsigned char *texels, const uint32_t at[RHW_LANES], f32x8 held[4])
{
    const void *place[RHW_LANES];
    for (int i = 0; i < RHW_LANES; i++) {
        place[i] = texels + at[i] * sizeof(float);
    }
    f32x8_load_columns(place, held);
}

RHW_INLINE void load_wrapped_row(const struct rhw_sampler_def *def, const struct rhw_mip *mip,
                                 const struct window_place *place, int row, f32x8 held[4])
{
    const i32x8 y = wrap_texel(def->address_v, place->y + row, i32x8_splat(mip->height));
    for (int i = 0; i < 4; i++) {
        const i32x8 x = wrap_texel(def->address_u, place->x + i, i32x8_splat(mip->width));
        held[i] = (f32x8)i32x8_gather(mip->texels, texel_number((x << 16) | y, mip));
    }
}

RHW_INLINE void compare_rows(const struct rhw_sampler_def *def, const struct rhw_mip *mip,
                             const struct compared_window *window, const struct window_place *place,
                             bool inside, enum rhw_compare compare, f32x8 reference, f32x8 *parts)
{
    uint32_t at[RHW_LANES];
    f32x8 above[RHW_WINDOW_COLUMNS] = {reference, reference, reference};
    if (inside) {
        spill_lanes(texel_number((place->x << 16) | place->y, mip), at);
    }
    for (int row = 0; row <= window->rows; row++) {
        f32x8 held[4], below[RHW_WINDOW_COLUMNS];
        if (inside) {
            load_inner_row(mip->texels + (size_t)row * mip->row_pitch, at, held);
        } else {
            load_wrapped_row(def, mip, place, row, held);
        }
        compare_footprint(compare, reference, held);
        for (int i = 0; i < RHW_WINDOW_COLUMNS; i++) {
            below[i] = rhw_mix(held[i], held[i + 1], place->weight_x);
        }
        for (int i = 0; row > 0 && i < window->columns; i++) {
            parts[(row - 1) * window->stride + i] = rhw_mix(above[i], below[i], place->weight_y);
        }
        memcpy(above, below, sizeof above);
    }
}

static inline bool compare_window(const struct rhw_binding_data *binding,
                                  const struct rhw_sample_request *request,
                                  const struct compared_window *window, f32x8 *parts)
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const struct rhw_mip *const mip = &binding->texture->mip[0];
    const f32x8 reference = reference_of(binding->texture->info, request);
    struct window_place place;
    if (!find_window(binding, request, window, &place)) {
        return false;
    }
    if (!is_inside(mip, window, &place)) {
        compare_rows(def, mip, window, &place, false, def->compare, reference, parts);
    } else if (__builtin_expect(def->compare == RHW_COMPARE_LESS_EQUAL, 1)) {
        compare_rows(def, mip, window, &place, true, RHW_COMPARE_LESS_EQUAL, reference, parts);
    } else {
        compare_rows(def, mip, window, &place, true, def->compare, reference, parts);
    }
    return true;
}

#endif
