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

// One slot.
struct rhw_binding {
    rhw_sample_function *sample;
    rhw_sample_function *sample_offset;          // a request with offsets in texels
    rhw_sample_function *isotropic;              // an anisotropic sampler's single samples
    rhw_sample_function *general;                // the same with offsets
    rhw_sample_function *own, *own_offset;       // of a view with a swizzle: the texels before it
    rhw_compare_window_function *compare_window; // NULL: footprints are compared one by one
    const struct rhw_texture_data *texture;      // NULL: nothing is bound
    const struct rhw_sampler_data *sampler;
    // The texture is filtered in fixed point and special paths are taken: rhw_sample_groups may sample it together with
    // others.
    bool shares_footprints;
    const struct rhw_texture_data *multisampled; // in the place of `texture`; NULL: none
};

struct rhw_validation_messages;

// Where a shader function under validation stands: what is wrong with its sampling is told there. NULL: none.
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
    bool drops_effects; // of a function under validation whose program does not declare them
};

// No texture in any slot, and no storage.
void rhw_bindings_init(struct rhw_bindings *bindings, const struct rhw_kernels *kernels);

// A slot with this texture and sampler, or both NULL. All that is chosen among the kernels' functions is chosen here:
// `paths` decides between functions that give the same bytes. An RGBA8_SRGB texture must be linearized.
struct rhw_binding rhw_binding_of(const struct rhw_kernels *kernels, enum rhw_paths paths,
                                  const struct rhw_texture_data *texture,
                                  const struct rhw_sampler_data *sampler);

#endif
