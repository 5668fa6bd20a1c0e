// SPDX-License-Identifier: MIT
// A pass tells about its work in numbers: stats of the whole pass, answers of queries, and a report of each tile.
#ifndef RHW_STATS_H
#define RHW_STATS_H

#include "types.h"

// Stats ---------------------------------------------------------------------------------------------

/// rhw_pass_end fills these stats of a pass. A "triangle" here is a primitive: a point counts as one, and so does a
/// line. Times of stages are milliseconds of wall time. Busy times are milliseconds of threads, added up over all
/// threads of the context, so front_busy_ms / (threads × front_ms) is the part of its threads that the front end used.
/// A thread that waits for a core counts as busy. The numbers vertices_shaded, fragments_shaded, fragment_groups,
/// flushes and memory_peak may vary with the number of threads.
struct rhw_stats {
    double record_ms; ///< time from rhw_pass_begin to rhw_pass_end, with all that the program did in between
    double front_ms;  ///< time of vertex fetch and shading, clipping, culling, setup and binning
    double back_ms;   ///< time of the tiles: load, rasterization, shading, blending and store
    double front_busy_ms, back_busy_ms;
    double vertex_busy_ms; ///< part of front_busy_ms: assembly, fetch, vertex function and projection
    double setup_busy_ms;  ///< part of front_busy_ms: clipping, culling and setup
    double bin_busy_ms;    ///< part of front_busy_ms: binning
    uint64_t draws;
    /// Calls of the vertex function, counted in lanes. A vertex counts again for every chunk or wave of the pass that
    /// shades it again.
    uint64_t vertices_shaded;
    uint64_t triangles_in;
    uint64_t triangles_dropped; ///< triangles with a position that was not finite
    uint64_t triangles_clipped; ///< triangles that a plane cut
    uint64_t triangles_culled; ///< triangles outside the view, facing away, without area, or covering no sample
    uint64_t triangles_rasterized;
    uint64_t bin_entries; ///< numbers of tiles that each triangle was drawn in, added up over the triangles
    uint64_t
        fragments_shaded; ///< samples that got a result of the fragment function; one call may serve many samples
    uint64_t fragment_groups; ///< groups of 8 lanes that the fragment function was called with
    uint64_t flushes;         ///< times that the bins were full before the pass ended
    uint64_t memory_peak; ///< the most bytes that the context has had allocated at one time since its creation
    uint64_t geometry_peak; ///< the most bytes that vertices, triangles and bins of this pass took at one time
    int threads, tiles;
    enum rhw_isa isa;
};

// Queries -------------------------------------------------------------------------------------------

/// A query asks about the draws between its beginning and its end (Vulkan 1.3 §18, "Queries"). The answer does not
/// depend on the threads, the paths or the instruction set; the answer of a TIMESTAMP is a time.
enum rhw_query_kind {
    /// Count the samples that passed all tests when their draw came in turn. Samples that a later draw hides count too.
    RHW_QUERY_OCCLUSION,
    RHW_QUERY_ANY_PASSED, ///< tell whether any sample passed all tests
    RHW_QUERY_STATISTICS, ///< fill struct rhw_pipeline_statistics
    RHW_QUERY_TIMESTAMP,  ///< tell when all that was recorded before rhw_pass_write_timestamp had been drawn
    RHW_QUERY_TRANSFORM_FEEDBACK, ///< count primitives that were written, and those that unlimited room would have held
    RHW_QUERY_KIND_COUNT
};

struct rhw_query_def {
    enum rhw_query_kind kind; ///< default OCCLUSION
    const char *label;        ///< name in messages, or NULL
};

/// The members count what VkQueryPipelineStatisticFlagBits of the same names count. They count what the draws ask for,
/// not what the library saves or repeats; struct rhw_stats tells how often functions were really called.
struct rhw_pipeline_statistics {
    uint64_t input_assembly_vertices;   ///< vertices of every instance; a restart index is no vertex
    uint64_t input_assembly_primitives; ///< complete primitives
    uint64_t vertex_shader_invocations; ///< one for each of input_assembly_vertices
    uint64_t clipping_invocations;      ///< one for each of input_assembly_primitives
    /// Primitives whose positions are finite and which do not lie as a whole outside one side of the view volume, one
    /// clip distance or one cull distance.
    uint64_t clipping_primitives;
    /// Fragments that passed the tests before the fragment function. If the fragment function or alpha_to_coverage
    /// decides about samples or depth, all covered fragments count. If the function runs for every sample, each sample
    /// counts.
    uint64_t fragment_shader_invocations;
};

/// rhw_query_read sets the members that the query's kind asks for, and sets the others to 0.
struct rhw_query_counts {
    uint64_t samples_passed; ///< answer of OCCLUSION
    bool any_passed;         ///< answer of ANY_PASSED
    struct rhw_pipeline_statistics statistics;
    uint64_t timestamp_ns;       ///< answer of TIMESTAMP, in nanoseconds of a clock that only counts up
    uint64_t primitives_written; ///< answer of TRANSFORM_FEEDBACK: primitives that were written
    uint64_t primitives_needed; ///< answer of TRANSFORM_FEEDBACK: primitives that enough room would have held
};

// Tiles ---------------------------------------------------------------------------------------------

/// A tile draws its triangles in one of these ways. All ways give the same bytes.
enum rhw_tile_order {
    RHW_TILE_IN_ORDER = 1,    ///< draw the triangles as they were submitted
    RHW_TILE_DEPTH_FIRST = 2, ///< draw the depth of all triangles, then shade what is seen
    RHW_TILE_BACKWARDS = 4    ///< draw from the last triangle to the first, until no pixel is open
};

/// A tile is a square of pixels that one thread draws from load to store. The target's right and bottom ends cut tiles
/// off. The report tells where a pass is dense, and how the tile avoided shading hidden surfaces.
struct rhw_tile_report {
    int x, y, width, height; ///< pixels of the target, from its top left
    int layer;
    uint32_t orders;    ///< or-ed rhw_tile_order of all flushes of the pass; 0 if the tile drew nothing
    uint64_t triangles; ///< triangles in the tile's bins; a clipped triangle may count as two or more
    uint64_t fragments_shaded; ///< this tile's part of rhw_stats.fragments_shaded
    uint64_t fragment_groups;  ///< this tile's part of rhw_stats.fragment_groups
    double busy_ms;            ///< milliseconds that threads worked on the tile
};

/// Return how many tiles the pass has. If the pass has layers, the tiles of all layers count, one layer after the
/// other.
RHW_API int rhw_pass_tile_count(rhw_context *context, rhw_pass pass);

/// Ask for the reports of all tiles, row by row. `count` must be rhw_pass_tile_count. The caller owns `reports`, which
/// must live until the pass has ended. rhw_pass_end fills the reports if it succeeds. A pass accepts this call once.
/// The call changes neither what is drawn nor how.
RHW_API void rhw_pass_report_tiles(rhw_context *context, rhw_pass pass, struct rhw_tile_report *reports,
                                   int count);

#endif
