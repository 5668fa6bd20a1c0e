// SPDX-License-Identifier: MIT
// The pass under way: its attachments, the state that recording changes, its draws, and the workers that run it. All of
// it is data; the other pass_ files record into it, run/run.c and the kernels draw from it.
#ifndef RHW_PASS_STATE_H
#define RHW_PASS_STATE_H

#include "base/arena.h"
#include "binding/binding.h"
#include "resource/clean_tiles.h"
#include "base/constants.h"
#include "draw/draw_list.h"
#include "draw/explained.h"
#include "rhw/shader.h"
#include "rhw/tiles.h"
#include "pipeline/sample_pattern.h"
#include "resource/texture.h"
#include "transform_feedback.h"

struct rhw_attachment {
    enum rhw_format format;
    enum rhw_load load;
    enum rhw_store store;
    const struct rhw_mip *target;  // NULL: exists in the tile alone
    int layer, level;              // of its texture that is drawn into; the first layer
    struct rhw_clean_tiles *clean; // of a texture; NULL where there is none
    size_t sample_stride;          // bytes from one sample of the target to the next; 0 where it has one
    // Where the samples of the tile are resolved into, if they are; NULL: nowhere.
    const struct rhw_mip *resolve;
    bool resolves;
    struct rhw_clean_tiles *resolve_clean;
    enum rhw_resolve resolve_mode;
    bool is_left_out;    // of colour; tiles have texels for it that nobody writes or wants
    bool is_read_only;   // loaded, and never stored: it is sampled meanwhile
    bool loads_resolved; // what is loaded are the texels of `resolve`, for all samples
    // What a tile starts from where nothing is loaded, texels side by side: the clear value, or 0, which is undefined
    // to the user and still the same bytes on every run.
    unsigned char clear[RHW_CLEAR_BYTES];
    size_t texel_size;
};

// Keeps an attachment between waves when it has no texture.
struct rhw_transient {
    struct rhw_mip plane;
    size_t size; // bytes that plane.texels has
};

struct rhw_counters {
    uint64_t fragments, groups;
    uint64_t vertex_ns, setup_ns, bin_ns; // parts of the front end, as rhw_stats names them
};

struct rhw_context;
struct rhw_geometry_scratch;
struct rhw_tile_scratch;
struct rhw_sample_tile;
struct rhw_used_query;
struct rhw_read_texture;
struct rhw_stored_level;

// One per thread; padded so that no two share a cache line.
struct rhw_worker {
    _Alignas(RHW_CACHE_LINE) struct rhw_arena arena; // what the front end made; reset when it was drawn
    struct rhw_counters counters;
    struct rhw_geometry_scratch *geometry;
    struct rhw_tile_scratch *tile;
    struct rhw_sample_tile *sample_tiles; // of the samples but the first, as many as passes had yet
    int sample_tile_count;
    // The tiles this worker begins with. Written by it, and by others that have none left of their own.
    _Alignas(RHW_CACHE_LINE) _Atomic int next_tile;
    int end_tile; // exclusive
};

// What is set for the next draw, by reference: the bytes of a buffer, and the texels of a texture, are looked up when
// something is drawn.
struct rhw_bound_buffer {
    const struct rhw_buffer_data *data; // NULL: nothing is set
    size_t offset, size;                // bytes
    uint32_t index;                     // of the buffer, for messages
};
struct rhw_bound_texture {
    struct rhw_texture_data *const *texture; // in the context's pool; NULL: nothing is set
    const struct rhw_sampler_data *sampler;
};
struct rhw_bound_range {
    const struct rhw_buffer_data *data; // NULL: nothing is set
    size_t offset, size;                // bytes
    bool is_read_only;
};
// A level of a texture, or a range of a buffer as texels.
struct rhw_bound_image {
    struct rhw_texture_data *const *texture; // in the context's pool; NULL: none
    int level;
    struct rhw_bound_range range;
    enum rhw_format format; // of the range
    bool is_read_only;
};
struct rhw_bound {
    struct rhw_bound_buffer vertices[RHW_MAX_VERTEX_BUFFERS], indices;
    struct rhw_bound_texture textures[RHW_MAX_TEXTURES];
    rhw_pipeline pipeline; // for messages
    struct rhw_bound_range storage[RHW_MAX_STORAGE_BUFFERS];
    struct rhw_bound_image images[RHW_MAX_STORAGE_IMAGES];
};

struct rhw_pass_state {
    struct rhw_context *context;
    uint64_t begun_ns;
    int width, height, tiles_x, tiles_y;
    bool names_size;                          // the definition does, so that attachments may be larger
    struct rhw_rect area;                     // of rendering: pixels outside of it are not touched
    int layers;                               // of every attachment
    const struct rhw_sample_pattern *pattern; // samples of a pixel
    int color_count;
    struct rhw_attachment colors[RHW_MAX_COLOR_ATTACHMENTS];
    bool has_depth;
    bool depth_by_default; // cleared to 1 by RHW_LOAD_DEFAULT, as no other value was given
    struct rhw_attachment depth;
    double
        depth_steps; // of a UNORM format, which memory has and the tile has not: there depth is a float; else 0
    bool has_stencil;
    struct rhw_attachment stencil;
    struct rhw_mip stencil_plane, stencil_resolve; // of textures, as a target and to resolve into
    enum rhw_paths paths;                          // of the context, or the general one
    struct rhw_explained explained;
    struct rhw_tile_report *tile_reports; // of all tiles; NULL: nobody asks

    struct rhw_arena arena; // states, uniforms, draws
    struct rhw_bound bound;
    struct rhw_draw_state pending; // what the next draw would use
    bool pending_changed, textures_changed;
    uint32_t rewrites_seen; // of the context's recording
    const void *uniforms;   // of the next draw
    uint32_t uniform_size;
    const struct rhw_draw_state *current; // last copy of `pending`
    bool out_of_memory;
    bool refused_pipeline;                            // rhw_pass_set_pipeline was misuse
    struct rhw_viewport viewports[RHW_MAX_VIEWPORTS]; // of the next draw; `pending` has the first as well
    struct rhw_rect scissors[RHW_MAX_VIEWPORTS];
    const struct rhw_draw_state *routed[RHW_MAX_VIEWPORTS]; // `current` by viewport; NULL: not made yet

    struct rhw_used_query *queries;      // a list, the last one first
    const struct rhw_read_texture *read; // lists of what was set (pass/feedback_loop.h)
    const struct rhw_stored_level *stored;
    struct rhw_feedback_state feedback;
    bool has_feedback; // of some draw

    struct rhw_draw_list draws;
    uint64_t triangle_count;
    int triangles_most;   // that tiles draw of a primitive of any draw
    bool shades_first;    // vertices of some draw, before the first wave
    bool has_large_draws; // indexed, of RHW_SHARING_TRIANGLES at least

    struct rhw_chunk *chunks; // of the wave under way
    int chunk_count, chunk_capacity;
    uint64_t chunk_size;   // triangles of a chunk, at most
    uint32_t entries_most; // of a chunk; at least one for every tile

    // Written by workers for every chunk, read when they look for the next:
    _Alignas(RHW_CACHE_LINE) _Atomic size_t geometry; // bytes that the wave's chunks took
    _Atomic int wave_end;                             // the chunks from here on wait for the next wave
    _Atomic bool failed;                              // a worker ran out of memory

    _Alignas(RHW_CACHE_LINE) struct rhw_worker *workers;
    bool first_wave, last_wave; // of this pass: load and store operations belong to these
    struct rhw_transient transient_colors[RHW_MAX_COLOR_ATTACHMENTS], transient_depth, transient_stencil;
};

// Special paths are faster for some triangles or vertices; the general path takes all of them. Both draw the same bytes.
static inline bool rhw_pass_takes_special_paths(const struct rhw_pass_state *pass)
{
    return pass->paths != RHW_PATHS_GENERAL;
}

static inline struct rhw_draw *rhw_pass_draw_at(const struct rhw_pass_state *pass, uint32_t i)
{
    return rhw_draw_list_at(&pass->draws, i);
}

#endif
