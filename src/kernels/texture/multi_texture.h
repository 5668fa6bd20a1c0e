// SPDX-License-Identifier: MIT
// Several textures are sampled at one place, as a material does: base colour, normals, roughness, ... usually share
// coordinates, size and sampler. Then the level of detail, the footprints in two levels and the weights are worked out
// once, and the texels of one texture are on their way while another is filtered, for one group or several: the texels
// of a whole material are too many for the caches. This saves 1 % of the instructions of DamagedHelmet and a fifth of
// its time.
//
// One texture by itself is sampled here for several groups, too.
#ifndef RHW_MULTI_TEXTURE_H
#define RHW_MULTI_TEXTURE_H

#include <string.h>

#include "format/format.h"
#include "filter_fixed.h"

// What 8 lanes filter in two levels of every texture of a size.
struct footprint_pair {
    int level;                  // the finer level
    struct footprint near, far; // footprints in the finer level and in the next
    i32x8 weight;               // weight of the next level
};

RHW_INLINE enum rhw_texel_codec codec_of(const struct rhw_binding_data *binding)
{
    return binding->texture->info->codec;
}

// Find the footprints. Return false where lanes need more than the fast path of sample_fixed.
RHW_INLINE bool find_footprints(const struct rhw_binding_data *binding, const f32x8 uv[2],
                                const f32x8 gradient[4], struct footprint_pair *pair)
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const f32x8 s = fold_coordinate(def->address_u, uv[0]);
    const f32x8 t = fold_coordinate(def->address_v, uv[1]);
    const i32x8 lod = fixed_level_of_detail(binding, gradient, NULL);
    pair->weight = i32x8_halve_lower(lod);
    pair->level = lod[0] >> 16;
    return same_two_levels(lod, pair->weight) &&
           interior_footprints(mip_at(binding->texture, pair->level), s, t, &pair->near, &pair->far);
}

// Return true if what was found for one binding holds for another.
RHW_INLINE bool has_same_footprints(const struct rhw_binding_data *found,
                                    const struct rhw_binding_data *binding)
{
    const struct rhw_texture_data *const a = found->texture, *const b = binding->texture;
    const struct rhw_sampler_data *const as = found->sampler, *const bs = binding->sampler;
    return binding->shares_footprints && a->levels == b->levels && a->mip[0].width == b->mip[0].width &&
           a->mip[0].height == b->mip[0].height && memcmp(&as->def, &bs->def, sizeof as->def) == 0;
}

RHW_INLINE uint32_t sharing_slots(const struct rhw_binding_data *bindings, uint32_t slots,
                                  const struct rhw_binding_data *found)
{
    uint32_t sharing = 0;
    for (uint32_t todo = slots; todo != 0; todo &= todo - 1) {
        const int slot = __builtin_ctz(todo);
        sharing |= has_same_footprints(found, &bindings[slot]) ? 1u << slot : 0;
    }
    return sharing;
}

// Prefetch the finer level's texels, of every second lane: neighbours mostly share cache lines.
RHW_INLINE void prefetch_footprint(const struct rhw_binding_data *binding, const struct footprint_pair *pair)
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_mip *const mip = &texture->mip[pair->level];
    const bool linear = codec_of(binding) == RHW_CODEC_SRGB8;
    const unsigned char *const texels = linear ? mip->linear : mip->texels;
    const size_t texel = linear ? RHW_LINEAR_TEXEL : 4, row = texel / 4 * mip->row_pitch;
    uint32_t at[RHW_LANES];
    spill_lanes(texel_number(pair->near.xy, mip), at);
    for (int i = 0; i < RHW_LANES; i += 2) {
        __builtin_prefetch(texels + texel * at[i]);
        __builtin_prefetch(texels + texel * at[i] + row);
    }
}

RHW_INLINE void filter_footprints(const struct rhw_texture_data *texture, const struct footprint_pair *pair,
                                  enum rhw_texel_codec codec, f32x8 texel[4])
{
    const struct rhw_mip *const fine = mip_at(texture, pair->level);
    const struct fixed_texels a = filter_interior(fine, &pair->near, codec);
    const struct fixed_texels b = filter_interior(fine + 1, &pair->far, codec);
    mix_levels(a, b, pair->weight, codec, texel);
}

// Return the gradient of coordinates that are the varyings from `at` on.
RHW_INLINE void group_gradient(const struct rhw_fragment *group, int at, f32x8 gradient[4])
{
    gradient[0] = group->ddx[at];
    gradient[1] = group->ddx[at + 1];
    gradient[2] = group->ddy[at];
    gradient[3] = group->ddy[at + 1];
}

// Sample one group by itself, as rhw_sample does.
RHW_INLINE void sample_group(const struct rhw_binding_data *binding, const struct rhw_fragment *group, int at,
                             f32x8 texel[4])
{
    f32x8 gradient[6];
    const struct rhw_texture_data *const texture = binding->texture;
    const int components = texture ? rhw_texture_components(texture->shape.kind) : 0;
    for (int i = 0; i < components; i++) {
        gradient[i] = group->ddx[at + i];
        gradient[components + i] = group->ddy[at + i];
    }
    const struct rhw_sample_request request = {.coordinates = &group->varying[at], .gradient = gradient};
    binding->sample(binding, &request, texel);
}

// Groups that are sampled at a time: few enough that their footprints and texels stay in the first cache level.
enum { SHARING_GROUPS = 8 };

// Sample one texture at the footprints of the groups whose bits are set in `found`. Meanwhile prefetch texels of the
// next texture.
RHW_INLINE void filter_found_groups(const struct rhw_texture_data *texture,
                                    const struct rhw_binding_data *next,
                                    const struct footprint_pair pair[SHARING_GROUPS], unsigned found,
                                    enum rhw_texel_codec codec, f32x8 (*texels)[4], int stride)
{
    for (; found != 0; found &= found - 1) {
        const int g = __builtin_ctz(found);
        if (next) {
            prefetch_footprint(next, &pair[g]);
        }
        filter_footprints(texture, &pair[g], codec, texels[g * stride]);
    }
}

// Sample at most SHARING_GROUPS groups of slots that share what is found for the first slot. There are two slots at
// least.
static void sample_sharing_slots(const struct rhw_binding_data *bindings, const struct rhw_fragment *groups,
                                 int count, uint32_t slots, int at, f32x8 (*texels)[4], int stride)
{
    const struct rhw_binding_data *const first = &bindings[__builtin_ctz(slots)];
    struct footprint_pair pair[SHARING_GROUPS];
    f32x8 gradient[4];
    unsigned found = 0;
    for (int g = 0; g < count; g++) {
        group_gradient(&groups[g], at, gradient);
        if (find_footprints(first, &groups[g].varying[at], gradient, &pair[g])) {
            found |= 1u << g;
            prefetch_footprint(first, &pair[g]);
        }
    }
    for (uint32_t todo = slots; todo != 0; todo &= todo - 1) {
        const int slot = __builtin_ctz(todo);
        const struct rhw_texture_data *const texture = bindings[slot].texture;
        const uint32_t later = todo & (todo - 1);
        const struct rhw_binding_data *const next = later ? &bindings[__builtin_ctz(later)] : NULL;
        if (codec_of(&bindings[slot]) == RHW_CODEC_SRGB8) {
            filter_found_groups(texture, next, pair, found, RHW_CODEC_SRGB8, texels + slot, stride);
        } else {
            filter_found_groups(texture, next, pair, found, RHW_CODEC_UNORM8, texels + slot, stride);
        }
        for (unsigned rest = ~found & ((1u << count) - 1); rest != 0; rest &= rest - 1) {
            const int g = __builtin_ctz(rest);
            sample_group(&bindings[slot], &groups[g], at, texels[g * stride + slot]);
        }
    }
}

// Sample one texture on the fixed-point path by itself. The level of detail takes a chain of operations, each of which
// waits for the one before: the chains of all groups come first, so that they wait together.
RHW_INLINE void sample_fixed_groups(const struct rhw_binding_data *binding, const struct rhw_fragment *groups,
                                    int count, int at, enum rhw_texel_codec codec, f32x8 (*texels)[4],
                                    int stride)
{
    i32x8 lod[RHW_MAX_GROUPS];
    f32x8 gradient[4];
    for (int g = 0; g < count; g++) {
        group_gradient(&groups[g], at, gradient);
        lod[g] = fixed_level_of_detail(binding, gradient, NULL);
    }
    for (int g = 0; g < count; g++) {
        sample_fixed(binding, &groups[g].varying[at], lod[g], codec, texels[g * stride]);
    }
}

// Sample one slot by itself, with a texture or without.
static void sample_slot(const struct rhw_binding_data *binding, const struct rhw_fragment *groups, int count,
                        int at, f32x8 (*texels)[4], int stride)
{
    if (binding->shares_footprints && codec_of(binding) == RHW_CODEC_UNORM8) {
        sample_fixed_groups(binding, groups, count, at, RHW_CODEC_UNORM8, texels, stride);
        return;
    }
    if (binding->shares_footprints) {
        sample_fixed_groups(binding, groups, count, at, RHW_CODEC_SRGB8, texels, stride);
        return;
    }
    if (binding->sample == binding->kernels->sample_fixed_anisotropic) {
        binding->kernels->sample_axis_groups(binding, groups, count, at, texels, stride);
        return;
    }
    for (int g = 0; g < count; g++) {
        sample_group(binding, &groups[g], at, texels[g * stride]);
    }
}

// Sample groups for rhw_sample_groups.
static void sample_groups(const struct rhw_binding_data *bindings, const struct rhw_fragment *groups,
                          int count, uint32_t slots, int at, rhw_float (*texels)[4], int stride)
{
    const struct rhw_binding_data *const first = &bindings[__builtin_ctz(slots)];
    uint32_t sharing = first->shares_footprints ? sharing_slots(bindings, slots, first) : 0;
    sharing = sharing & (sharing - 1) ? sharing : 0; // a slot does not share with itself alone
    for (uint32_t todo = slots & ~sharing; todo != 0; todo &= todo - 1) {
        const int slot = __builtin_ctz(todo);
        sample_slot(&bindings[slot], groups, count, at, texels + slot, stride);
    }
    for (int g = 0; g < count && sharing; g += SHARING_GROUPS) {
        const int n = count - g < SHARING_GROUPS ? count - g : SHARING_GROUPS;
        sample_sharing_slots(bindings, groups + g, n, sharing, at, texels + g * stride, stride);
    }
}

#endif
