// SPDX-License-Identifier: MIT
// A draw list says what a pass draws, as data: draws with their states, and the chunks that the front end makes of
// them.
//
// The triangles of all draws stand in one line, in submission order, cut into chunks of at most RHW_CHUNK_TRIANGLES.
// Chunks go through the front end in any order on any thread. A tile then reads the chunks in line order, so the
// picture does not depend on who did what. A chunk may span many small draws (10,000 draws of 12 triangles are 15
// chunks), and a large draw may span many chunks.
#ifndef RHW_DRAW_LIST_H
#define RHW_DRAW_LIST_H

#include "pipeline/blend_state.h"
#include "pipeline/depth_stencil.h"
#include "draw_plan.h"
#include "hidden_surface.h"
#include "pipeline/line_stipple.h"
#include "rhw/pass_def.h"
#include "rhw/shader.h"
#include "triangle.h"

struct rhw_memory;
struct rhw_pipeline_data;
struct rhw_active_queries;
struct rhw_shared_vertices;

enum { RHW_FETCH_BYTES = 16 }; // bytes that are loaded where an attribute begins, at most

struct rhw_vertex_stream {
    const unsigned char *bytes; // buffer start plus binding offset, or memory of the program
    size_t size;                // bytes from there to the end of what was set
    // An attribute is loaded at once only where this many bytes from its beginning lie within `size`: RHW_FETCH_BYTES
    // on memory of the program, and 0 where the library's buffer has padding behind its bytes.
    uint32_t loaded;
};

// A draw state holds everything that a set_ function changes for a draw, except for its uniforms and bindings. Draws
// point at an immutable copy, and share it as long as nothing of it changes. Sharing keeps ten thousand draws with
// uniforms and textures of their own in the cache.
struct rhw_draw_state {
    const struct rhw_pipeline_data *pipeline;
    struct rhw_vertex_stream streams[RHW_MAX_VERTEX_BUFFERS];
    const unsigned char *indices;
    size_t index_bytes;
    enum rhw_index_type index_type;
    struct rhw_viewport viewport;
    struct rhw_rect scissor; // already within target and viewport
    float blend_constant[4];
    struct rhw_blend_state blend[RHW_MAX_COLOR_ATTACHMENTS];
    struct rhw_hidden_rule hidden;               // how the draw may be drawn together with others
    struct rhw_draw_plan plans[RHW_PHASE_COUNT]; // what tiles do for the draw's fragments
    // Depth after the viewport's range is depth_low + depth_span·Z/W, whatever range of Z the pipeline has.
    double depth_low, depth_span;
    // Depth is clamped to these: the viewport's range in order, or 0 and 1.
    float depth_least, depth_most;
    struct rhw_depth_stencil_setting depth_setting;
    struct rhw_depth_stencil_state depth_stencil;
    // The screen position of clip coordinates is x = X/W·half_width + center_x, y = center_y − Y/W·half_height.
    // half_height is negative where the viewport's height is, and y points down in clip coordinates too.
    double half_width, half_height, center_x, center_y;
    // Added to a position, in 1/256 pixel, these lead to the first pixel with a sample behind it, and past the last
    // pixel with a sample before it (kernels/raster/sample_position.h).
    int32_t first_step, past_step;
    const struct rhw_active_queries *queries; // NULL: no queries
    int viewport_index;                       // number of `viewport`
    struct rhw_line_stipple_setting stipple_setting;
    struct rhw_line_stipple stipple; // stipple of the lines; factor 0: none
    float line_width_setting;        // line width that the pass sets; 0: the pipeline's
    int line_pixels;                 // width of Bresenham lines
    double half_width_24_8;          // half the width of all other lines
};

// Transform feedback writes a draw's vertices here.
struct rhw_draw_feedback {
    unsigned char *to[RHW_MAX_FEEDBACK_TARGETS]; // place of its first vertex
    // This many primitives are written. The primitives of all instances stand in one line.
    uint64_t primitives;
    int vertices; // vertices of a primitive
};

// These are the places in their pattern where the lines of a draw of strips begin. run/strip_stipple.h measures them.
struct rhw_strip_stipple {
    uint8_t *begins; // for each line: 1 if it is the first of its strip
    // For each line of each instance, this is the place in the pattern where it begins (kernels/raster/stipple_mask.h).
    int32_t *phases;
};

struct rhw_draw {
    const struct rhw_draw_state *state;
    const struct rhw_bindings *bindings; // what the slots have
    const void *uniforms;
    // The vertex indices of strips and fans with restart, or the slots of effect_vertices.h stand here. NULL: neither.
    const uint32_t (*expanded)[3];
    // There is an element for each instance, of the wave under way or of the pass (effect_vertices.h). NULL: the draw
    // shares no vertices, as most draws.
    const struct rhw_shared_vertices *shared;
    uint32_t first, base_vertex, first_instance, instances;
    // One behind the last vertex that the draw reads, as pass/kept_reads.c finds it. 0: nobody asked.
    uint32_t vertex_end;
    uint32_t index;                           // number of the draw in its pass
    const struct rhw_draw_feedback *feedback; // what the draw writes to buffers; NULL: nothing
    const struct rhw_debug_group *group;      // innermost group that holds the draw; NULL: none
    uint32_t triangles_per_instance;
    uint64_t first_triangle; // place in the line of all triangles of the pass
    bool indexed;
    bool is_shaded_first; // its vertices are shaded before the first wave (run/effect_vertices.h)
    const struct rhw_strip_stipple *strip_stipple; // NULL: each line begins its pattern anew
    // There are RHW_MAX_VIEWPORTS copies of the draw, one for each viewport. NULL: it uses the first viewport alone.
    const struct rhw_draw *viewports;
};

// Return where the draw ends in the line of all triangles of its pass.
static inline uint64_t rhw_draw_end(const struct rhw_draw *draw)
{
    return draw->first_triangle + (uint64_t)draw->triangles_per_instance * draw->instances;
}

// A segment is the part of a chunk that belongs to one instance of one draw, or to several instances that are in the
// chunk as a whole.
struct rhw_segment {
    const struct rhw_draw *draw;
    uint32_t instance; // the first instance
    int vertex_stride; // floats
    float *vertices;   // an rhw_vertex_record for each slot
};

struct rhw_primitive_id {
    uint32_t instance, primitive;
};

// Return which instance of the draw a triangle of the segment belongs to, without first_instance, and the triangle's
// number in the instance.
static inline struct rhw_primitive_id rhw_primitive_id_of(const struct rhw_segment *segment,
                                                          uint32_t primitive)
{
    const uint32_t each = segment->draw->triangles_per_instance;
    if (primitive < each) { // the common case
        return (struct rhw_primitive_id){segment->instance, primitive};
    }
    return (struct rhw_primitive_id){segment->instance + primitive / each, primitive % each};
}

// The front end counts these in each chunk, because a chunk that is not drawn in its wave is run again in the next.
struct rhw_front_counters {
    uint64_t vertices_shaded, dropped, clipped, culled, rasterized, entries;
};

// Queries count this much of a segment.
struct rhw_counted_run {
    const struct rhw_active_queries *queries;
    uint64_t clipping_primitives;
};

struct rhw_chunk {
    // These count in the line of all triangles. The front end lowers a count whose bins are too large.
    uint64_t first, count;
    uint32_t first_draw; // the draw that triangle `first` belongs to
    // The front end writes the members from here on.
    struct rhw_hidden_rule hidden; // rule of all the chunk's draws; in order where they differ
    struct rhw_segment *segments;
    struct rhw_triangle *triangles;
    struct rhw_polygon *polygons;
    // Tile (x, y) of the rectangle has the bin entries[offsets[i]] .. entries[offsets[i + 1] − 1], where
    // i = (y − tile_y0)·(tile_x1 − tile_x0) + x − tile_x0. Entries are numbers of triangles, and rise. The bins of
    // layer l begin behind the bins of l − layer0 whole rectangles.
    int tile_x0, tile_y0, tile_x1, tile_y1;
    int layer0, layer_count;
    uint32_t *offsets;
    uint16_t *entries;
    struct rhw_front_counters counters;
    const struct rhw_counted_run *counted; // runs of which queries ask something
    int counted_count;
};

// The draws of a pass stand in blocks, so that a draw never moves and growth copies none.
struct rhw_draw_list {
    struct rhw_draw **blocks; // blocks of RHW_DRAW_BLOCK draws each
    uint32_t block_count, block_capacity;
    uint32_t count; // draws
};

enum { RHW_DRAW_BLOCK = 256 };

static inline struct rhw_draw *rhw_draw_list_at(const struct rhw_draw_list *list, uint32_t i)
{
    return &list->blocks[i / RHW_DRAW_BLOCK][i % RHW_DRAW_BLOCK];
}

// Take one more block: the slow path of rhw_draw_list_next.
struct rhw_draw *rhw_draw_list_grow(struct rhw_memory *memory, struct rhw_draw_list *list);

// Return room for one more draw, behind the last, or NULL when out of memory. `count` does not change yet.
static inline struct rhw_draw *rhw_draw_list_next(struct rhw_memory *memory, struct rhw_draw_list *list)
{
    const bool has_room = list->count < list->block_count * RHW_DRAW_BLOCK;
    return has_room ? rhw_draw_list_at(list, list->count) : rhw_draw_list_grow(memory, list);
}

void rhw_draw_list_destroy(struct rhw_memory *memory, struct rhw_draw_list *list);

#endif
