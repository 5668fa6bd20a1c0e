// SPDX-License-Identifier: MIT
// The one table of functions that exist once per instruction set. Everything else of the library is compiled once, for
// the baseline.
#ifndef RHW_KERNELS_H
#define RHW_KERNELS_H

#include "rhw/isa.h"
#include "rhw/shader.h"

struct rhw_wave;
struct rhw_chunk;
struct rhw_shared_part;
struct rhw_mip_job;
struct rhw_mip_volume_job;
struct rhw_blit_job;
struct rhw_resolve_job;

struct rhw_binding_data;
struct rhw_storage_image;
struct rhw_texture_data;

// Do what rhw_sample does, for one binding.
typedef void rhw_sample_function(const struct rhw_binding_data *binding,
                                 const struct rhw_sample_request *request, rhw_float texel[4]);
// Columns of footprints that a kernel takes at once: a row of their texels is 16 bytes.
enum { RHW_WINDOW_COLUMNS = 3 };

// Do what rhw_sample_compare_window does in `columns` columns of footprints, RHW_WINDOW_COLUMNS at most, from number
// `column` on, of a window that has `stride` columns. Return false, with nothing done, where the function takes no such
// request.
typedef bool rhw_compare_window_function(const struct rhw_binding_data *binding,
                                         const struct rhw_sample_request *request, int column, int columns,
                                         int rows, int stride, rhw_float *parts);
// Do what rhw_sample_groups does, for the bindings whose bits `slots` has.
typedef void rhw_sample_groups_function(const struct rhw_binding_data *bindings,
                                        const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                                        rhw_float (*texels)[4], int stride);

// Do what rhw_sample_groups does, for one binding.
typedef void rhw_sample_axis_groups_function(const struct rhw_binding_data *binding,
                                             const struct rhw_fragment *groups, int count, int at,
                                             rhw_float (*texels)[4], int stride);

// Give the texels of rhw_sample_gather or of rhw_sample_fetch, or the answers of rhw_sample_query_lod or
// rhw_sample_size, of a binding that has a texture.
typedef void rhw_gather_function(const struct rhw_binding_data *binding,
                                 const struct rhw_sample_request *request, int channel, rhw_float texel[4]);
typedef void rhw_fetch_function(const struct rhw_binding_data *binding, const rhw_int *at,
                                const rhw_int *level, rhw_float texel[4]);
typedef void rhw_query_level_function(const struct rhw_binding_data *binding,
                                      const struct rhw_sample_request *request, rhw_float lod[2]);
typedef void rhw_query_size_function(const struct rhw_binding_data *binding, const rhw_int *level,
                                     rhw_int size[3]);

typedef void rhw_fetch_sample_function(const struct rhw_texture_data *texture, const rhw_int *at,
                                       const rhw_int *sample, rhw_float texel[4]);
typedef void rhw_image_load_function(const struct rhw_storage_image *image, const rhw_int *at,
                                     rhw_float texel[4]);
typedef void rhw_image_store_function(const struct rhw_storage_image *image, const rhw_int *at,
                                      const rhw_int *mask, const rhw_float texel[4]);

struct rhw_kernels {
    // Shade some of the vertices that chunks share.
    void (*shared_part)(const struct rhw_wave *wave, const struct rhw_shared_part *part, int worker);
    // Run the front end over one chunk: fetch, vertex function, snap, cull, clip, bin. Return false when out of memory.
    bool (*chunk)(const struct rhw_wave *wave, struct rhw_chunk *chunk, int worker);
    // Draw one tile, from load to store: the back end.
    void (*tile)(const struct rhw_wave *wave, int tile, int worker);
    // Sample plain 2D textures of every format with every sampler that asks for no more, in floats, and a slot without
    // a texture.
    rhw_sample_function *sample_float;
    // Sample plain 2D textures of two or four halves by linear filters without a border or a comparison. It gives the
    // bytes of sample_float sooner.
    rhw_sample_function *sample_halves;
    // Sample one level of plain 2D textures of one float by samplers that take it (sampler.h). It gives the bytes of
    // sample_float sooner.
    rhw_sample_function *sample_compared;
    // Compare windows of the textures and samplers that sample_compared takes.
    rhw_compare_window_function *compare_window;
    // Sample RGBA8 textures of either encoding, with samplers that allow it (sampler.h), in fixed point. The first two
    // take the special paths of filter_fixed.h; the others always take the general path, which gives equal bytes.
    rhw_sample_function *sample_unorm8, *sample_srgb8, *sample_unorm8_general, *sample_srgb8_general;
    rhw_sample_groups_function *sample_groups;
    // Sample textures of every kind by every sampler, without anisotropy. Requests may have offsets.
    rhw_sample_function *sample_general;
    // Take several samples of the binding's isotropic function.
    rhw_sample_function *sample_anisotropic;
    // Take several samples of an RGBA8 texture, in fixed point as sample_unorm8 and sample_unorm8_general do.
    rhw_sample_function *sample_fixed_anisotropic, *sample_fixed_anisotropic_general;
    // Sample groups of a binding that samples by sample_fixed_anisotropic.
    rhw_sample_axis_groups_function *sample_axis_groups;
    // Sample a bound texture at the level of a request with a bias, by the function that the binding has.
    rhw_sample_function *sample_biased;
    rhw_gather_function *gather;
    rhw_fetch_function *fetch;
    rhw_query_level_function *query_level;
    rhw_query_size_function *query_size;
    // Do what rhw_sample_fetch_sample does, of a multisampled texture.
    rhw_fetch_sample_function *fetch_sample;
    // Do what rhw_image_load does, for one image.
    rhw_image_load_function *image_load;
    // Do what rhw_image_store does, for one image whose format can be encoded.
    rhw_image_store_function *image_store;
    // Make a band of rows of a few levels of a texture: see mip_work.h.
    void (*mip_band)(const struct rhw_mip_job *job, int index, int worker);
    // Make a slice of a level of a 3D texture.
    void (*mip_slice)(const struct rhw_mip_volume_job *job, int index, int worker);
    // Make a band of rows of a region that is scaled, or resolved: see transfer_work.h.
    void (*blit_band)(const struct rhw_blit_job *job, int index);
    void (*resolve_band)(const struct rhw_resolve_job *job, int index);
};

RHW_ISA_DECLARE(const struct rhw_kernels, rhw_kernels);

// Return the kernels for `isa`. Return NULL where this build has none; RHW_ISA_BASELINE is always there.
const struct rhw_kernels *rhw_kernels_for(enum rhw_isa isa);

#endif
