// SPDX-License-Identifier: MIT
// What stands behind the sampling functions of shaders: the textures and samplers of a draw, each with the kernel that
// samples it.
#ifndef RHW_BINDING_H
#define RHW_BINDING_H

#include "kernels/kernels.h"
#include "rhw/shader.h"
#include "storage.h"

struct rhw_texture_data;
struct rhw_sampler_data;

// What one slot has.
struct rhw_binding {
    rhw_sample_function *sample;
    rhw_sample_function *sample_offset; // for a request with offsets in texels
    rhw_sample_function *isotropic;     // for an anisotropic sampler's single samples
    rhw_sample_function *general;       // for an anisotropic sampler's single samples with offsets
    // For a view with a swizzle: the functions that give the texels before it.
    rhw_sample_function *own, *own_offset;
    rhw_compare_window_function *compare_window; // NULL: footprints are compared one by one
    const struct rhw_texture_data *texture;      // NULL: nothing is bound
    const struct rhw_sampler_data *sampler;
    // The texture is filtered in fixed point and special paths are taken: rhw_sample_groups may sample it together with
    // others.
    bool shares_footprints;
    const struct rhw_texture_data *multisampled; // takes the place of `texture`; NULL: none
};

struct rhw_validation_messages;

// The place where a shader function under validation samples: what is wrong with its sampling is told with this place.
// A NULL `validation` means that nothing is told.
struct rhw_sample_site {
    struct rhw_validation_messages *validation;
    uint32_t draw;
    const char *pipeline;
    const rhw_int *mask; // lanes that count; NULL: all
};

struct rhw_bindings {
    const struct rhw_kernels *kernels;
    struct rhw_sample_site site;
    struct rhw_binding slot[RHW_MAX_TEXTURES];
    const struct rhw_storage *storage;
    // True for a function under validation whose program does not declare its effects.
    bool drops_effects;
};

// Set bindings with no texture in any slot, and no storage.
void rhw_bindings_init(struct rhw_bindings *bindings, const struct rhw_kernels *kernels);

// Return a slot with this texture and sampler, or with neither if both are NULL. All that is chosen among the kernels'
// functions is chosen here: `paths` decides between functions that give equal bytes. An RGBA8_SRGB texture must be
// linearized.
struct rhw_binding rhw_binding_of(const struct rhw_kernels *kernels, enum rhw_paths paths,
                                  const struct rhw_texture_data *texture,
                                  const struct rhw_sampler_data *sampler);

#endif
