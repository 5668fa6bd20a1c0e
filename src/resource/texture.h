// SPDX-License-Identifier: MIT
// Texel storage of a texture: what the tiles draw into and what rhw_sample reads.
#ifndef RHW_TEXTURE_H
#define RHW_TEXTURE_H

#include "rhw/shader_lanes.h"
#include "rhw/types.h"
#include "rhw/view.h"

enum {
    // Bytes. Rows start on a cache line, so that tiles of different threads share none. Memory goes on this far behind
    // the last texel, so that the sampler may read 17 texels from any but the last of a row.
    RHW_ROW_ALIGNMENT = 64,
    RHW_TEXEL_PADDING = 64
};

struct rhw_format_info;

struct rhw_mip {
    // Factors for the sampler's fixed-point path (4-byte formats), which would spend a tenth of its time making them.
    // They stand in all lanes, so that an instruction takes them from memory as an operand.
    _Alignas(32) float scale_x[RHW_LANES]; // width · 2^16
    float scale_y[RHW_LANES];              // height · 2^16
    // (width − 2) << 16 | (height − 2): the last texel with both neighbours. It is negative where a side is 1.
    int32_t interior[RHW_LANES];
    int32_t step[RHW_LANES]; // 1 << 16 | texels per row

    unsigned char *texels; // linear rows, top to bottom; 64-byte aligned
    // The decoded copy of an RGBA8_SRGB texture that has been bound: see srgb_texture.h. Its rows are twice as long.
    unsigned char *linear;
    int width, height;
    int slices;         // slices of a 3D texture; layers of others
    size_t row_pitch;   // bytes, a multiple of RHW_ROW_ALIGNMENT
    size_t slice_pitch; // bytes; slices stand one after the other, in the linear copy too
    // The stencil aspect, with a byte per texel, of formats that have one. It is the texels themselves where there is
    // no depth.
    unsigned char *stencil;
    size_t stencil_pitch;
};

// Make a level with a stencil aspect one of this aspect alone.
static inline void rhw_mip_take_stencil(struct rhw_mip *mip)
{
    mip->texels = mip->stencil;
    mip->row_pitch = mip->stencil_pitch;
    mip->slice_pitch = mip->stencil_pitch * (size_t)mip->height;
}

// What lanes that read different levels look up, in texels. `first` counts from the texture's memory.
struct rhw_level_table {
    int32_t width[RHW_MAX_MIP_LEVELS + 1], height[RHW_MAX_MIP_LEVELS + 1], slices[RHW_MAX_MIP_LEVELS + 1];
    int32_t first[RHW_MAX_MIP_LEVELS + 1], row[RHW_MAX_MIP_LEVELS + 1], slice[RHW_MAX_MIP_LEVELS + 1];
};

// Sizes are at least 1. `layers` counts those of the whole texture, six for each cube.
struct rhw_texture_shape {
    enum rhw_texture_kind kind;
    bool is_array;
    int width, height, depth, layers;
    int levels;
    int samples;
    // Bytes of level 0, where the texture has one level. 0: it is rounded up from the texels.
    size_t row_pitch;
};

// The data of a texture. The pool of a context has pointers to these, because a texture that is written while draws
// wait gets new data (texture_access.c).
struct rhw_texture_data {
    enum rhw_format format;
    // What the texels are: the format's row, or the row of what blocks are decoded to (block_format.h).
    const struct rhw_format_info *info;
    struct rhw_texture_shape shape;
    bool is_plain; // 2D and no array: the sampler has special paths for it
    int levels;
    int samples;
    // Bytes from a sample's aspects of texels and stencil to those of the next sample.
    size_t sample_stride;
    _Alignas(32) float last_level[RHW_LANES]; // levels − 1
    struct rhw_mip mip[RHW_MAX_MIP_LEVELS];
    struct rhw_level_table table;
    void *memory; // one allocation for all levels
    size_t memory_size;
    void *linear_memory; // memory of all mip[].linear; NULL until a pass samples the texture
    size_t linear_size;
    uint32_t linear_levels;        // levels of which no texel has changed since the copy was made, a bit each
    struct rhw_clean_tiles *clean; // list of records of the layers that passes have drawn into
    uint32_t attached;             // generation of the last pass that draws into the texture
    // Levels that somebody has filled, a bit each. Level 0 counts as filled from the beginning.
    uint32_t written;
    // The pass in which the texture last got other memory, and the number of draws that were recorded before and read
    // the old memory.
    uint32_t renewed_pass, renewed_draws;
    uint32_t moves; // times that the texture got other memory
    // The record of texels with views, or of texels of the caller. NULL: the texels are the texture's own.
    struct rhw_shared_texels *shared;
    // The version of the shared texels up to which `clean` and `linear_levels` hold.
    uint32_t version;
    bool is_bound; // the texture is in the list of shared->bound
    struct rhw_texture_data *next_bound;
    bool swizzles; // the view's channels are other ones than the texels'
    enum rhw_swizzle swizzle[4];
    // Generation of the last pass that has the texture as a storage image, hence as attached too.
    uint32_t stored_pass;
    uint32_t stored_levels; // levels that are storage images in that pass, a bit each
    // Generation of the last pass in which the texture was set to be sampled, or to be loaded alone.
    uint32_t read_pass;
    uint32_t read_levels; // levels that are read in that pass, a bit each
};

struct rhw_context;
struct rhw_memory;

// Return the number of components of coordinates, without an array's layer. A cube has a direction.
static inline int rhw_texture_components(enum rhw_texture_kind kind)
{
    return kind == RHW_TEXTURE_1D ? 1 : kind == RHW_TEXTURE_2D ? 2 : 3;
}

// Return the shape of a plain 2D texture.
static inline struct rhw_texture_shape rhw_texture_shape_2d(int width, int height, int levels)
{
    return (struct rhw_texture_shape){RHW_TEXTURE_2D, false, width, height, 1, 1, levels, 1, 0};
}

// Set format, levels, sizes and pitches, without memory. All arguments are valid.
void rhw_texture_data_init(struct rhw_texture_data *texture, enum rhw_format format,
                           const struct rhw_texture_shape *shape);

// Tell the layout of a texture with a valid definition.
void rhw_texture_layout_of(const struct rhw_texture_def *def, struct rhw_texture_layout *layout);

// Return a texture with zeroed texels. Return NULL when out of memory.
struct rhw_texture_data *rhw_texture_data_create(struct rhw_memory *memory, enum rhw_format format,
                                                 const struct rhw_texture_shape *shape);

// Return a texture on memory of the caller, which stays as it is and is large enough. Return NULL when out of memory.
struct rhw_texture_data *rhw_texture_data_create_on(struct rhw_memory *memory, enum rhw_format format,
                                                    const struct rhw_texture_shape *shape, void *bytes);

// Release the texture and what it owns.
void rhw_texture_data_destroy(struct rhw_memory *memory, struct rhw_texture_data *texture);

// Box-filter levels 1.. from level 0 in linear light, on all threads of the context. The texture has its memory, and a
// format that is sampled. Return RHW_ERROR_OUT_OF_MEMORY, and the levels are unchanged then; or RHW_ERROR_GIVEN_UP, and
// the levels hold unspecified values.
enum rhw_result rhw_texture_data_generate_mips(struct rhw_context *context,
                                               const struct rhw_texture_data *texture);

// Return the number of levels of the chain from width × height × depth down to a single texel.
int rhw_mip_chain_length(int width, int height, int depth);

// Return the first texel of a layer or slice.
static inline unsigned char *rhw_mip_slice(const struct rhw_mip *mip, int slice)
{
    return mip->texels + (size_t)slice * mip->slice_pitch;
}

#endif
