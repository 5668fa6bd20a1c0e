// SPDX-License-Identifier: MIT
// What stands behind the sampling functions of shaders: the textures and samplers of a draw, each with the kernel that
// samples it.
#ifndef RHW_BINDING_H
#define RHW_BINDING_H

#include <string.h>

#include "base/constants.h"
#include "kernels/kernels.h"
#include "rhw/bind.h"
#include "rhw/shader.h"
#include "storage.h"

struct rhw_context;
struct rhw_texture_data;
struct rhw_sampler_data;

// What a binding is of.
enum rhw_binding_kind {
    RHW_BINDING_EMPTY,
    RHW_BINDING_SAMPLED,      // a texture with a sampler, or neither
    RHW_BINDING_TEXTURE,      // a texture alone
    RHW_BINDING_SAMPLER,      // a sampler alone
    RHW_BINDING_MULTISAMPLED, // a texture with several samples
    RHW_BINDING_WORDS,
    RHW_BINDING_IMAGE
};

// What a struct rhw_binding holds, and what one slot has.
struct rhw_binding_data {
    union {
        struct {
            rhw_sample_function *sample;
            rhw_sample_function *sample_offset;     // for a request with offsets in texels
            rhw_sample_function *isotropic;         // for an anisotropic sampler's single samples
            rhw_sample_function *own;               // for a view with a swizzle: gives the texels before it
            const struct rhw_texture_data *texture; // NULL: there is nothing to sample
            union {
                const struct rhw_sampler_data *sampler;
                const struct rhw_texture_data *multisampled; // texture of the kind RHW_BINDING_MULTISAMPLED
            };
        };
        struct rhw_storage_words words;
        struct rhw_storage_image image;
        uint64_t room[6]; // as much as the largest takes where pointers have 8 bytes
    };
    union {
        const struct rhw_kernels *kernels;
        uint64_t kernels_room;
    };
    uint8_t kind;  // enum rhw_binding_kind
    uint8_t paths; // enum rhw_paths
    // The texture is filtered in fixed point and special paths are taken: rhw_sample_groups may sample it together with
    // others.
    bool shares_footprints;
    bool compares_windows; // the kernels' compare_window takes the texture and the sampler
    uint32_t unused; // what 64 bits leave behind where they begin at multiples of 8, and is there everywhere
};

// A table of one is a table of the other.
_Static_assert(sizeof(struct rhw_binding_data) == sizeof(struct rhw_binding),
               "a struct rhw_binding holds it");
_Static_assert(_Alignof(struct rhw_binding_data) == _Alignof(struct rhw_binding),
               "a struct rhw_binding holds it");

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
    const struct rhw_storage *storage;
    struct rhw_context *asked; // its program decides whether functions go on; NULL: nobody is asked
    // True for a function under validation whose program does not declare its effects.
    bool drops_effects;
    int slot_count; // slots from here on have nothing, and there may be no memory for them
    _Alignas(RHW_CACHE_LINE) struct rhw_binding_data slot[RHW_MAX_TEXTURES];
};

// Return what a public binding holds.
static inline const struct rhw_binding_data *rhw_binding_look(const struct rhw_binding *binding)
{
    return (const struct rhw_binding_data *)(const void *)binding;
}

// Return what a public binding holds, if it is of this kind. Return NULL if it is not, or NULL itself.
static inline const struct rhw_binding_data *rhw_binding_of_kind(const struct rhw_binding *binding,
                                                                 enum rhw_binding_kind kind)
{
    const struct rhw_binding_data *const data = rhw_binding_look(binding);
    return data && data->kind == kind ? data : NULL;
}

// Return the bytes of bindings with so many slots.
static inline size_t rhw_bindings_size(int slot_count)
{
    return offsetof(struct rhw_bindings, slot) + (size_t)slot_count * sizeof(struct rhw_binding_data);
}

// Copy bindings with the slots that they have.
static inline void rhw_bindings_copy(const struct rhw_bindings *from, struct rhw_bindings *to)
{
    memcpy(to, from, rhw_bindings_size(from->slot_count));
}

// Set bindings with no texture in any slot, and no storage.
void rhw_bindings_init(struct rhw_bindings *bindings, const struct rhw_kernels *kernels);

// Return a binding of this texture and sampler, or of neither if both are NULL. All that is chosen among the kernels'
// functions is chosen here: `paths` decides between functions that give equal bytes. An RGBA8_SRGB texture must be
// linearized.
struct rhw_binding_data rhw_binding_of(const struct rhw_kernels *kernels, enum rhw_paths paths,
                                       const struct rhw_texture_data *texture,
                                       const struct rhw_sampler_data *sampler);

#endif
