// SPDX-License-Identifier: MIT
// A pass: the draws recorded between begin and end, and how they become chunks for the front end and tiles
// for the back end.
//
// The triangles of all draws stand in one line, in submission order, cut into chunks of at most
// RHW_CHUNK_TRIANGLES. Chunks go through the front end in any order on any thread; a tile then reads the
// chunks in line order, so the picture does not depend on who did what. A chunk may span many small draws
// (10,000 draws of 12 triangles are 15 chunks) and a large draw many chunks.
#ifndef RHW_PASS_H
#define RHW_PASS_H

#include "arena.h"
#include "clean_tiles.h"
#include "constants.h"
#include "draw_plan.h"
#include "output.h"
#include "pipeline.h"
#include "rhw/rhw.h"
#include "rhw/shader.h"
#include "texture.h"
#include "triangle.h"

struct rhw_vertex_stream {
    const unsigned char *bytes; // buffer start plus binding offset
    size_t size;                // bytes from there to the buffer's end
};

// Everything a draw needs that a set_ function changes, but for uniforms. Draws point at an immutable copy, one and the
// same as long as nothing of it changes: that keeps ten thousand draws with uniforms of their own in the cache.
struct rhw_draw_state {
    const struct rhw_pipeline_data *pipeline;
    struct rhw_vertex_stream streams[RHW_MAX_VERTEX_BUFFERS];
    const unsigned char *indices;
    size_t index_bytes;
    enum rhw_index_type index_type;
    const struct rhw_binding *textures; // RHW_MAX_TEXTURES of them
    struct rhw_viewport viewport;
    struct rhw_rect scissor; // already within target and viewport
    float blend_constant[4];
    struct output_state outputs[RHW_MAX_COLOR_ATTACHMENTS];
    enum rhw_compare deferral;                   // see deferral.h
    struct rhw_draw_plan plans[RHW_PHASE_COUNT]; // what tiles do for its fragments
    // Depth after the viewport's range: depth_low + depth_span·Z/W, whatever range of Z the pipeline has.
    double depth_low, depth_span;
    float depth_least, depth_most; // the viewport's depth range in order
    // Screen position of clip coordinates: x = X/W·half_width + center_x, y = center_y − Y/W·half_height.
    double half_width, half_height, center_x, center_y;
};

struct rhw_draw {
    const struct rhw_draw_state *state;
    const void *uniforms;
    const uint32_t (*expanded)[3];            // vertex indices of strips and fans with restart; else NULL
    const struct rhw_shared_vertices *shared; // by instance, of the wave under way; mostly NULL
    uint32_t first, base_vertex, first_instance, instances;
    uint32_t index; // of the draw in its pass
    uint32_t triangles_per_instance;
    uint64_t first_triangle; // in the line of all triangles of the pass
    bool indexed;
};

// The part of a chunk that belongs to one instance of one draw.
struct rhw_segment {
    const struct rhw_draw *draw;
    uint32_t instance;
    int vertex_stride; // floats
    float *vertices;   // rhw_vertex_record by slot
};

// What the front end counts in a chunk: a chunk that is not drawn in its wave is run again in the next.
struct rhw_front_counters {
    uint64_t vertices_shaded, dropped, clipped, culled, rasterized, entries;
};

struct rhw_chunk {
    // In the line of all triangles; the front end lowers a count whose bins are too large.
    uint64_t first, count;
    uint32_t first_draw; // the draw that triangle `first` belongs to
    // Written by the front end:
    enum rhw_compare deferral; // of all its draws; RHW_COMPARE_NEVER where they differ
    struct rhw_segment *segments;
    struct rhw_triangle *triangles;
    struct rhw_polygon *polygons;
    // Bins: tile (x, y) of the rectangle lists entries[offsets[i]] .. entries[offsets[i + 1] − 1], where
    // i = (y − tile_y0)·(tile_x1 − tile_x0) + x − tile_x0; entries are numbers of triangles, rising.
    int tile_x0, tile_y0, tile_x1, tile_y1;
    uint32_t *offsets;
    uint16_t *entries;
    struct rhw_front_counters counters;
};

struct rhw_attachment {
    enum rhw_format format;
    enum rhw_load load;
    enum rhw_store store;
    const struct rhw_mip *target;  // NULL: exists in the tile alone
    struct rhw_clean_tiles *clean; // of a texture; NULL where there is none
    // What a tile starts from where nothing is loaded, texels side by side: the clear value, or 0, which is undefined
    // to the user and still the same bytes on every run.
    unsigned char clear[RHW_CLEAR_BYTES];
    size_t texel_size;
};

struct rhw_counters {
    uint64_t fragments, groups;
    uint64_t vertex_ns, setup_ns, bin_ns; // parts of the front end, as rhw_stats names them
};

struct rhw_front_scratch;
struct rhw_tile_scratch;

// One per thread; padded so that no two share a cache line.
struct rhw_worker {
    _Alignas(RHW_CACHE_LINE) struct rhw_arena arena; // what the front end made; reset when it was drawn
    struct rhw_counters counters;
    struct rhw_front_scratch *front;
    struct rhw_tile_scratch *tile;
    // The tiles this worker begins with. Written by it, and by others that have none left of their own.
    _Alignas(RHW_CACHE_LINE) _Atomic int next_tile;
    int end_tile; // exclusive
};

struct rhw_pass_state {
    struct rhw_context *context;
    uint64_t begun_ns;
    int width, height, tiles_x, tiles_y;
    int color_count;
    struct rhw_attachment colors[RHW_MAX_COLOR_ATTACHMENTS];
    bool has_depth;
    struct rhw_attachment depth;
    bool shades_hidden; // nothing is put off, see deferral.h
    rhw_texture color_ids[RHW_MAX_COLOR_ATTACHMENTS], depth_id;

    struct rhw_arena arena;        // states, uniforms, draws
    struct rhw_draw_state pending; // what the next draw would use
    bool pending_changed;
    const void *uniforms; // of the next draw
    uint32_t uniform_size;
    struct rhw_binding pending_textures[RHW_MAX_TEXTURES];
    bool textures_changed;
    const struct rhw_draw_state *current; // last copy of `pending`
    bool out_of_memory;

    struct rhw_draw **draws; // grows; blocks of RHW_DRAW_BLOCK draws
    uint32_t draw_blocks, draw_block_capacity, draw_count;
    uint64_t triangle_count;
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
    bool first_wave, last_wave;     // of this pass: load and store operations belong to these
    struct rhw_mip transient_depth; // keeps depth between waves when the pass has no depth texture
};

enum { RHW_DRAW_BLOCK = 256 };

static inline struct rhw_draw *rhw_pass_draw_at(const struct rhw_pass_state *pass, uint32_t i)
{
    return &pass->draws[i / RHW_DRAW_BLOCK][i % RHW_DRAW_BLOCK];
}

enum rhw_result rhw_pass_state_create(struct rhw_context *context, struct rhw_pass_state **pass);
void rhw_pass_state_destroy(struct rhw_context *context, struct rhw_pass_state *pass);

#endif
