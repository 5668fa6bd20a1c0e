// SPDX-License-Identifier: MIT
// Texel storage of a texture: what the tiles draw into and what rhw_sample reads.
#ifndef RHW_TEXTURE_H
#define RHW_TEXTURE_H

#include "rhw/shader_lanes.h"
#include "rhw/types.h"
#include "rhw/view.h"

enum {
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
    int slices;         // of a 3D texture; layers of others
    size_t row_pitch;   // bytes, a multiple of RHW_ROW_ALIGNMENT
    size_t slice_pitch; // bytes: slices stand one after the other, in the linear copy too
    // The plane of stencil, a byte per texel, of formats that have one; the texels themselves where there is no depth.
    unsigned char *stencil;
    size_t stencil_pitch;
};

// Makes a level with a plane of stencil one of that plane alone.
static inline void rhw_mip_take_stencil(struct rhw_mip *mip)
{
    mip->texels = mip->stencil;
    mip->row_pitch = mip->stencil_pitch;
    mip->slice_pitch = mip->stencil_pitch * (size_t)mip->height;
}

// What lanes that read different levels look up, in texels; `first` counts from the texture's memory.
struct rhw_level_table {
    int32_t width[RHW_MAX_MIP_LEVELS + 1], height[RHW_MAX_MIP_LEVELS + 1], slices[RHW_MAX_MIP_LEVELS + 1];
    int32_t first[RHW_MAX_MIP_LEVELS + 1], row[RHW_MAX_MIP_LEVELS + 1], slice[RHW_MAX_MIP_LEVELS + 1];
};

// Sizes are at least 1. `layers`: of the whole texture, six for each cube.
struct rhw_texture_shape {
    enum rhw_texture_kind kind;
    bool is_array;
    int width, height, depth, layers;
    int levels;
    int samples;
    size_t row_pitch; // of level 0, of a texture that has one level; 0: rounded up from the texels
};

// The pool of a context has pointers to these: a texture that is written while draws wait gets new data (texture.c).
struct rhw_texture_data {
    enum rhw_format format;
    const struct rhw_format_info
        *info; // of the texels: the format's, or what that is decoded to (block_format.h)
    struct rhw_texture_shape shape;
    bool is_plain; // 2D and no array: what the sampler has special paths for
    int levels;
    int samples;
    size_t sample_stride; // bytes from a sample's planes of texels and stencil to those of the next
    _Alignas(32) float last_level[RHW_LANES]; // levels − 1
    struct rhw_mip mip[RHW_MAX_MIP_LEVELS];
    struct rhw_level_table table;
    void *memory; // one allocation for all levels
    size_t memory_size;
    void *linear_memory; // of all mip[].linear; NULL until a pass samples the texture
    size_t linear_size;
    bool linear_is_current;        // no texel has changed since
    struct rhw_clean_tiles *clean; // of the layers that passes have drawn into, a list
    uint32_t attached;             // generation of the last pass that draws into the texture
    uint32_t
        written; // levels that somebody has filled, a bit each; level 0 counts as filled from the beginning
    // The pass in which it last got other memory, and the draws that were recorded before and read the old one.
    uint32_t renewed_pass, renewed_draws;
    struct rhw_shared_texels *shared; // with views, or of the caller; NULL: the texels are its own
    uint32_t version;                 // of these, up to which `clean` and `linear_is_current` hold
    bool swizzles;                    // a view's channels are other ones
    enum rhw_swizzle swizzle[4];
    uint32_t stored_pass; // generation of the last pass that has it as a storage image, hence as attached too
    uint32_t stored_levels; // in that pass, a bit each
    uint32_t read_pass;     // generation of the last pass that it was set in to be sampled, or loaded alone
    uint32_t read_levels;   // in that pass, a bit each
};

struct rhw_context;
struct rhw_memory;

// Components of coordinates, without an array's layer: a cube has a direction.
static inline int rhw_texture_components(enum rhw_texture_kind kind)
{
    return kind == RHW_TEXTURE_1D ? 1 : kind == RHW_TEXTURE_2D ? 2 : 3;
}

// A plain 2D texture's.
static inline struct rhw_texture_shape rhw_texture_shape_2d(int width, int height, int levels)
{
    return (struct rhw_texture_shape){RHW_TEXTURE_2D, false, width, height, 1, 1, levels, 1, 0};
}

// Sets format, levels, sizes and pitches; no memory yet. All arguments are valid.
void rhw_texture_data_init(struct rhw_texture_data *texture, enum rhw_format format,
                           const struct rhw_texture_shape *shape);

// A texture with zeroed texels; NULL when out of memory.
struct rhw_texture_data *rhw_texture_data_create(struct rhw_memory *memory, enum rhw_format format,
                                                 const struct rhw_texture_shape *shape);

// The same on memory of the caller, which stays as it is and is large enough.
struct rhw_texture_data *rhw_texture_data_create_on(struct rhw_memory *memory, enum rhw_format format,
                                                    const struct rhw_texture_shape *shape, void *bytes);

// Releases the texture and what it owns.
void rhw_texture_data_destroy(struct rhw_memory *memory, struct rhw_texture_data *texture);

// Box-filters levels 1.. from level 0 in linear light, on all threads of the context. The memory must be there, and the
// format one that is sampled. False when out of memory; the levels are unchanged then.
bool rhw_texture_data_generate_mips(struct rhw_context *context, const struct rhw_texture_data *texture);

// Levels of the chain from width × height × depth down to a single texel.
int rhw_mip_chain_length(int width, int height, int depth);

// First texel of a layer or slice.
static inline unsigned char *rhw_mip_slice(const struct rhw_mip *mip, int slice)
{
    return mip->texels + (size_t)slice * mip->slice_pitch;
}

#endif
