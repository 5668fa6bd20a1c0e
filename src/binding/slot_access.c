// SPDX-License-Identifier: MIT
// Sampling of what slots have, by the functions of shader_sample.h. A slot is a binding that a draw has by number, and
// validation tells what is wrong with it.
#include "sample_access.h"

#include "binding/validation/validation.h"
#include "resource/texture.h"

// Return what a slot has. Return NULL where there is no such slot.
static const struct rhw_binding_data *slot_of(const struct rhw_bindings *bindings, int slot)
{
    return (unsigned)slot < (unsigned)bindings->slot_count ? &bindings->slot[slot] : NULL;
}

void rhw_sample(const struct rhw_bindings *bindings, int slot, const struct rhw_sample_request *request,
                rhw_float texel[4])
{
    if (bindings->site.validation) {
        rhw_validate_sample(bindings, slot, request);
    }
    if ((unsigned)slot >= (unsigned)bindings->slot_count) {
        rhw_no_texel(texel);
        return;
    }
    rhw_sample_bound(&bindings->slot[slot], request, texel);
}

void rhw_sample_compare_window(const struct rhw_bindings *bindings, int slot,
                               const struct rhw_sample_request *request, int columns, int rows,
                               rhw_float *parts)
{
    if (bindings->site.validation) {
        rhw_validate_sample(bindings, slot, request);
    }
    rhw_bound_compare_window(slot_of(bindings, slot), request, columns, rows, parts);
}

void rhw_sample_gather(const struct rhw_bindings *bindings, int slot,
                       const struct rhw_sample_request *request, int channel, rhw_float texel[4])
{
    if (bindings->site.validation && rhw_validate_slot(bindings, slot)) {
        rhw_validate_reference(bindings, slot, request);
    }
    rhw_bound_gather(slot_of(bindings, slot), request, channel, texel);
}

void rhw_sample_fetch(const struct rhw_bindings *bindings, int slot, const rhw_int *at, const rhw_int *level,
                      rhw_float texel[4])
{
    if (bindings->site.validation) {
        (void)rhw_validate_slot(bindings, slot);
    }
    rhw_bound_fetch(slot_of(bindings, slot), at, level, texel);
}

void rhw_sample_fetch_sample(const struct rhw_bindings *bindings, int slot, const rhw_int *at,
                             const rhw_int *sample, rhw_float texel[4])
{
    if (bindings->site.validation) {
        rhw_validate_samples(bindings, slot);
    }
    rhw_bound_fetch_sample(slot_of(bindings, slot), at, sample, texel);
}

void rhw_sample_query_lod(const struct rhw_bindings *bindings, int slot,
                          const struct rhw_sample_request *request, rhw_float lod[2])
{
    if (bindings->site.validation) {
        (void)rhw_validate_slot(bindings, slot);
    }
    rhw_bound_query_lod(slot_of(bindings, slot), request, lod);
}

// Return the slot, whose texture has one sample or more. Return NULL where there is no such slot.
static const struct rhw_binding_data *any_slot(const struct rhw_bindings *bindings, int slot)
{
    const struct rhw_binding_data *const binding = slot_of(bindings, slot);
    if (bindings->site.validation && !(binding && binding->kind == RHW_BINDING_MULTISAMPLED)) {
        (void)rhw_validate_slot(bindings, slot);
    }
    return binding;
}

void rhw_sample_size(const struct rhw_bindings *bindings, int slot, const rhw_int *level, rhw_int size[3])
{
    rhw_bound_size(any_slot(bindings, slot), level, size);
}

int rhw_sample_levels(const struct rhw_bindings *bindings, int slot)
{
    const struct rhw_texture_data *const texture = rhw_bound_texture(any_slot(bindings, slot));
    return texture ? texture->levels : 0;
}

int rhw_sample_samples(const struct rhw_bindings *bindings, int slot)
{
    const struct rhw_texture_data *const texture = rhw_bound_texture(any_slot(bindings, slot));
    return texture ? texture->samples : 0;
}

_Static_assert(RHW_MAX_TEXTURES == 32, "a bit of `slots` for each");

void rhw_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                       rhw_float (*texels)[4], int stride)
{
    const struct rhw_bindings *const bindings = groups->bindings;
    if (bindings->site.validation && !rhw_validate_sample_groups(groups, count, slots, at, stride)) {
        return;
    }
    const uint32_t present = (uint32_t)(((uint64_t)1 << bindings->slot_count) - 1) & slots;
    rhw_no_texels(count, slots & ~present, texels, stride);
    if (present != 0) {
        bindings->kernels->sample_groups(bindings->slot, groups, count, present, at, texels, stride);
    }
}
