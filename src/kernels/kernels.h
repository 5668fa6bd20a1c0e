// SPDX-License-Identifier: MIT
// The one table of functions that exist once per instruction set. Everything else of the library is compiled
// once, for the baseline.
#ifndef RHW_KERNELS_H
#define RHW_KERNELS_H

#include "rhw/isa.h"
#include "rhw/shader.h"

struct rhw_pass_state;
struct rhw_chunk;
struct rhw_shared_part;

typedef void rhw_sample_function(const struct rhw_binding *binding, const rhw_float uv[2],
                                 const rhw_float grad[4], const rhw_float *lod, rhw_float texel[4]);

struct rhw_kernels {
    // Shades some of the vertices that chunks share.
    void (*shared_part)(struct rhw_pass_state *pass, const struct rhw_shared_part *part, int worker);
    // The front end over one chunk: fetch, vertex function, clip, cull, snap, bin. False when out of memory.
    bool (*chunk)(struct rhw_pass_state *pass, struct rhw_chunk *chunk, int worker);
    // One tile of the back end, from load to store.
    void (*tile)(struct rhw_pass_state *pass, int tile, int worker);
    // Behind rhw_sample_grad and rhw_sample_lod: of RGBA8 textures in either encoding with samplers that take the
    // fixed-point road (sampler.h), and of all others or none.
    rhw_sample_function *sample_other, *sample_rgba8, *sample_rgba8_srgb;
    // Behind rhw_sample_slots.
    void (*sample_slots)(const struct rhw_binding *bindings, uint32_t slots, const rhw_float uv[2],
                         const rhw_float grad[4], rhw_float (*texels)[4]);
    // Behind rhw_sample_groups.
    void (*sample_groups)(const struct rhw_binding *bindings, uint32_t slots,
                          const struct rhw_fragment *groups, int count, int at, rhw_float (*texels)[4],
                          int stride);
};

RHW_ISA_DECLARE(const struct rhw_kernels, rhw_kernels);

// NULL where this build has no kernels for `isa`; RHW_ISA_BASELINE is always there.
const struct rhw_kernels *rhw_kernels_for(enum rhw_isa isa);

#endif
