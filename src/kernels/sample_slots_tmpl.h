// SPDX-License-Identifier: MIT
// Sampling several textures at one place, as a material does: base colour, normals, roughness, ... usually share
// coordinates, size and sampler. Then the level of detail, the places in two levels and the weights are worked
// out once, and the texels of one texture are on their way while another is filtered, for one group or several:
// those of a whole material are too many for the caches. And one texture by itself for several groups.
#ifndef RHW_SAMPLE_SLOTS_TMPL_H
#define RHW_SAMPLE_SLOTS_TMPL_H

#include "sample_tmpl.h"

#include <string.h>

// Where 8 lanes meet the two levels of every texture of a size.
struct sample_spots {
    int level;                     // the finer one
    struct sample_place near, far; // in it, in the next
    i8 weight;                     // of the next
};

// False where lanes need more than the straight road of sample_codes.
RHW_INLINE bool sample_find_spots(const struct rhw_binding *binding, const f8 uv[2], const f8 *grad,
                                  struct sample_spots *spots)
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_sampler_data *const sampler = binding->sampler;
    const f8 s = sample_fold(sampler->def.address_u, uv[0]), t = sample_fold(sampler->def.address_v, uv[1]);
    const i8 detail = sample_detail_codes(texture, sampler, grad, NULL);
    spots->weight = i8_halve_lower(detail);
    spots->level = detail[0] >> 16;
    return sample_same_levels(detail, spots->weight) &&
           sample_places(sample_mip(texture, spots->level), s, t, &spots->near, &spots->far);
}

// Whether what was found for one binding holds for another.
RHW_INLINE bool sample_shares(const struct rhw_binding *found, const struct rhw_binding *binding)
{
    const struct rhw_texture_data *const a = found->texture, *const b = binding->texture;
    const struct rhw_sampler_data *const as = found->sampler, *const bs = binding->sampler;
    return sample_takes_codes(binding) && a->levels == b->levels && a->mip[0].width == b->mip[0].width &&
           a->mip[0].height == b->mip[0].height && memcmp(&as->def, &bs->def, sizeof as->def) == 0;
}

RHW_INLINE uint32_t sample_sharing(const struct rhw_binding *bindings, uint32_t slots,
                                   const struct rhw_binding *found)
{
    uint32_t sharing = 0;
    for (uint32_t todo = slots; todo != 0; todo &= todo - 1) {
        const int slot = __builtin_ctz(todo);
        sharing |= sample_shares(found, &bindings[slot]) ? 1u << slot : 0;
    }
    return sharing;
}

// Asks for the finer level's texels. Every second lane: neighbours mostly share cache lines.
RHW_INLINE void sample_prefetch(const struct rhw_binding *binding, const struct sample_spots *spots)
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_mip *const mip = &texture->mip[spots->level];
    const bool srgb = binding->sample == sample_rgba8_srgb;
    const unsigned char *const texels = srgb ? mip->linear : mip->texels;
    const size_t texel = srgb ? RHW_LINEAR_TEXEL : 4, row = texel / 4 * mip->row_pitch;
    uint32_t at[RHW_LANES];
    sample_spill(sample_index(spots->near.xy, mip), at);
    for (int i = 0; i < RHW_LANES; i += 2) {
        __builtin_prefetch(texels + texel * at[i]);
        __builtin_prefetch(texels + texel * at[i] + row);
    }
}

RHW_INLINE void sample_spots_texel(const struct rhw_texture_data *texture, const struct sample_spots *spots,
                                   bool srgb, f8 texel[4])
{
    const struct rhw_mip *const fine = sample_mip(texture, spots->level);
    const struct sample_codes a = sample_interior_codes(fine, &spots->near, srgb);
    const struct sample_codes b = sample_interior_codes(fine + 1, &spots->far, srgb);
    sample_mix_levels(a, b, spots->weight, srgb, texel);
}

RHW_INLINE void group_gradient(const struct rhw_fragment *group, int at, f8 grad[4])
{
    grad[0] = group->ddx[at];
    grad[1] = group->ddx[at + 1];
    grad[2] = group->ddy[at];
    grad[3] = group->ddy[at + 1];
}

// Several groups at a time: few enough that their spots and texels stay in the first cache level.
enum { SPOTS = 8 };

// One texture at the spots of the groups whose bits are set in `found`. Meanwhile asks for texels of the next one.
RHW_INLINE void sample_spots_groups(const struct rhw_texture_data *texture, const struct rhw_binding *next,
                                    const struct sample_spots spots[SPOTS], unsigned found, bool srgb,
                                    f8 (*texels)[4], int stride)
{
    for (; found != 0; found &= found - 1) {
        const int g = __builtin_ctz(found);
        if (next) {
            sample_prefetch(next, &spots[g]);
        }
        sample_spots_texel(texture, &spots[g], srgb, texels[g * stride]);
    }
}

// At most SPOTS groups of slots that share what is found for the first, two at least.
static void sample_shared_groups(const struct rhw_binding *bindings, uint32_t slots,
                                 const struct rhw_fragment *groups, int count, int at, f8 (*texels)[4],
                                 int stride)
{
    const struct rhw_binding *const first = &bindings[__builtin_ctz(slots)];
    struct sample_spots spots[SPOTS];
    f8 grad[4];
    unsigned found = 0;
    for (int g = 0; g < count; g++) {
        group_gradient(&groups[g], at, grad);
        if (sample_find_spots(first, &groups[g].varying[at], grad, &spots[g])) {
            found |= 1u << g;
            sample_prefetch(first, &spots[g]);
        }
    }
    for (uint32_t todo = slots; todo != 0; todo &= todo - 1) {
        const int slot = __builtin_ctz(todo);
        const struct rhw_texture_data *const texture = bindings[slot].texture;
        const uint32_t later = todo & (todo - 1);
        const struct rhw_binding *const next = later ? &bindings[__builtin_ctz(later)] : NULL;
        if (bindings[slot].sample == sample_rgba8_srgb) {
            sample_spots_groups(texture, next, spots, found, true, texels + slot, stride);
        } else {
            sample_spots_groups(texture, next, spots, found, false, texels + slot, stride);
        }
        for (unsigned rest = ~found & ((1u << count) - 1); rest != 0; rest &= rest - 1) {
            const int g = __builtin_ctz(rest);
            group_gradient(&groups[g], at, grad);
            bindings[slot].sample(&bindings[slot], &groups[g].varying[at], grad, NULL,
                                  texels[g * stride + slot]);
        }
    }
}

// One texture of 8 bits by itself. What its level of detail is takes a chain of operations, of which each waits for the
// one before: those of all groups come first, so that they wait together.
RHW_INLINE void sample_codes_groups(const struct rhw_binding *binding, const struct rhw_fragment *groups,
                                    int count, int at, bool srgb, f8 (*texels)[4], int stride)
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_sampler_data *const sampler = binding->sampler;
    i8 detail[RHW_MAX_GROUPS];
    f8 grad[4];
    for (int g = 0; g < count; g++) {
        group_gradient(&groups[g], at, grad);
        detail[g] = sample_detail_codes(texture, sampler, grad, NULL);
    }
    for (int g = 0; g < count; g++) {
        sample_codes(texture, sampler, &groups[g].varying[at], detail[g], srgb, texels[g * stride]);
    }
}

// One texture, or none, by itself.
static void sample_alone(const struct rhw_binding *binding, const struct rhw_fragment *groups, int count,
                         int at, f8 (*texels)[4], int stride)
{
    f8 grad[4];
    if (binding->sample == sample_rgba8) {
        sample_codes_groups(binding, groups, count, at, false, texels, stride);
        return;
    }
    if (binding->sample == sample_rgba8_srgb) {
        sample_codes_groups(binding, groups, count, at, true, texels, stride);
        return;
    }
    for (int g = 0; g < count; g++) {
        group_gradient(&groups[g], at, grad);
        binding->sample(binding, &groups[g].varying[at], grad, NULL, texels[g * stride]);
    }
}

// See rhw_sample_groups.
static void sample_groups(const struct rhw_binding *bindings, uint32_t slots,
                          const struct rhw_fragment *groups, int count, int at, rhw_float (*texels)[4],
                          int stride)
{
    const struct rhw_binding *const first = &bindings[__builtin_ctz(slots)];
    uint32_t sharing = sample_takes_codes(first) ? sample_sharing(bindings, slots, first) : 0;
    sharing = sharing & (sharing - 1) ? sharing : 0; // not with itself alone
    for (uint32_t todo = slots & ~sharing; todo != 0; todo &= todo - 1) {
        const int slot = __builtin_ctz(todo);
        sample_alone(&bindings[slot], groups, count, at, texels + slot, stride);
    }
    for (int g = 0; g < count && sharing; g += SPOTS) {
        const int n = count - g < SPOTS ? count - g : SPOTS;
        sample_shared_groups(bindings, sharing, groups + g, n, at, texels + g * stride, stride);
    }
}

// See rhw_sample_slots: one group, whose coordinates need not be varyings.
static void sample_slots(const struct rhw_binding *bindings, uint32_t slots, const rhw_float uv[2],
                         const rhw_float grad[4], rhw_float (*texels)[4])
{
    const struct rhw_fragment group = {.varying = uv, .ddx = grad, .ddy = grad + 2};
    sample_groups(bindings, slots, &group, 1, 0, texels, 0);
}

#endif
