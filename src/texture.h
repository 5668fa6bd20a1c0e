// SPDX-License-Identifier: MIT
// Texel storage of a texture: what the tiles draw into and what rhw_sample reads.
#ifndef RHW_TEXTURE_H
#define RHW_TEXTURE_H

#include "rhw/shader_lanes.h"
#include "rhw/types.h"

enum {
    RHW_MAX_MIP_LEVELS = 15, // 16384 down to 1

    // Bytes. Rows start on a cache line, so that tiles of different threads share none; memory goes on this
    // far behind the last texel, so that the sampler may read texels in pairs.
    RHW_ROW_ALIGNMENT = 64,
    RHW_TEXEL_PADDING = 64
};

struct rhw_format_info;

struct rhw_mip {
    // For the sampler's fixed-point path (4-byte formats), which would spend a tenth of its time making them; in all
    // lanes, so that an instruction takes them from memory as an operand.
    _Alignas(32) float scale_x[RHW_LANES]; // width · 2^16
    float scale_y[RHW_LANES];              // height · 2^16
    int32_t interior[RHW_LANES]; // (width − 2) << 16 | (height − 2): the last texel with both neighbours;
                                 // negative where a side is 1
    int32_t step[RHW_LANES];     // 1 << 16 | texels per row

    unsigned char *texels; // linear rows, top to bottom; 64-byte aligned
    unsigned char *linear; // RGBA8_SRGB that has been bound: see srgb_texture.h; rows twice as long
    int width, height;
    size_t row_pitch; // bytes, a multiple of RHW_ROW_ALIGNMENT
    // The plane of stencil, a byte per texel, of formats that have one; the texels themselves where there is no depth.
    unsigned char *stencil;
    size_t stencil_pitch;
};

// The pool of a context has pointers to these: a texture that is written while draws wait gets new data (texture.c).
struct rhw_texture_data {
    enum rhw_format format;
    const struct rhw_format_info *info; // the format's
    int levels;
    _Alignas(32) float last_level[RHW_LANES]; // levels − 1
    struct rhw_mip mip[RHW_MAX_MIP_LEVELS];
    void *memory; // one allocation for all levels
    size_t memory_size;
    void *linear_memory; // of all mip[].linear; NULL until a pass samples the texture
    size_t linear_size;
    bool linear_is_current;        // no texel has changed since
    struct rhw_clean_tiles *clean; // NULL until a pass draws into the texture
    uint32_t attached;             // generation of the last pass that draws into the texture
    uint32_t
        written; // levels that somebody has filled, a bit each; level 0 counts as filled from the beginning
    // The pass in which it last got other memory, and the draws that were recorded before and read the old one.
    uint32_t renewed_pass, renewed_draws;
};

struct rhw_context;
struct rhw_memory;

// Sets format, levels, sizes and pitches; no memory yet. `levels` is at least 1. All arguments are valid.
void rhw_texture_data_init(struct rhw_texture_data *texture, enum rhw_format format, int width, int height,
                           int levels);

// Releases the texture and what it owns.
void rhw_texture_data_destroy(struct rhw_memory *memory, struct rhw_texture_data *texture);

// Box-filters levels 1.. from level 0 in linear light, on all threads of the context. The memory must be there, and the
// format one that is sampled. False when out of memory; the levels are unchanged then.
bool rhw_texture_data_generate_mips(struct rhw_context *context, const struct rhw_texture_data *texture);

// Levels of the chain from width × height down to 1 × 1.
int rhw_mip_chain_length(int width, int height);

#endif
