// SPDX-License-Identifier: MIT
// What a pass tells about its work in numbers: its stats, the answers of queries, and a report for each tile.
#ifndef RHW_STATS_H
#define RHW_STATS_H

#include "types.h"

/// What a pass did. "Triangles" are primitives: points and lines count as one each. Times of stages are wall
/// milliseconds. Busy times are milliseconds of threads, added up over all of them: front_busy_ms / (threads × front_ms)
/// is the part of its threads that the front end used. A thread that waits for a core counts as busy.
struct rhw_stats {
    double record_ms; ///< from rhw_pass_begin to rhw_pass_end, whatever the program did meanwhile
    double front_ms;  ///< vertex fetch and shading, clip, cull, setup, binning
    double back_ms;   ///< tiles: load, raster, shading, blending, store
    double front_busy_ms, back_busy_ms;
    double vertex_busy_ms; ///< of front_busy_ms: assembly, fetch, the vertex function, projection
    double setup_busy_ms;  ///< of front_busy_ms: clip, cull, setup
    double bin_busy_ms;    ///< of front_busy_ms: binning
    uint64_t draws;
    /// Calls of the vertex function, in lanes: a vertex counts again where chunks or waves of a pass shade it again.
    /// This, fragments_shaded, fragment_groups and flushes may vary with the threads.
    uint64_t vertices_shaded;
    uint64_t triangles_in, triangles_dropped; ///< dropped: a position was not finite
    uint64_t triangles_clipped;               ///< cut by a plane
    uint64_t triangles_culled; ///< outside the view, facing away, of no area, or covering no sample
    uint64_t triangles_rasterized;
    uint64_t bin_entries;      ///< tiles that triangles were drawn in, added up over the triangles
    uint64_t fragments_shaded; ///< samples that got a result of the fragment function; one call may serve many
    uint64_t fragment_groups;  ///< groups of 8 lanes that it was called with
    uint64_t flushes;          ///< times the bins were full before the pass ended
    uint64_t memory_peak;      ///< bytes allocated by the context, highest so far; varies with the threads
    uint64_t geometry_peak;    ///< of these, vertices, triangles and bins of this pass: the most at one time
    int threads, tiles;
    enum rhw_isa isa;
};

/// What a query asks of the draws between its beginning and its end (Vulkan 1.3 §18, "Queries"). The answers are the same
/// for any threads, paths and instruction set.
enum rhw_query_kind {
    RHW_QUERY_OCCLUSION, ///< how many samples passed all tests, in their draws' turn: also those hidden later
    RHW_QUERY_ANY_PASSED,         ///< whether any did
    RHW_QUERY_STATISTICS,         ///< struct rhw_pipeline_statistics
    RHW_QUERY_TIMESTAMP,          ///< when everything recorded before rhw_pass_write_timestamp was drawn
    RHW_QUERY_TRANSFORM_FEEDBACK, ///< primitives that it wrote, and that it would have with more room
    RHW_QUERY_KIND_COUNT
};

struct rhw_query_def {
    enum rhw_query_kind kind; ///< OCCLUSION
    const char *label;        ///< for messages
};

/// VkQueryPipelineStatisticFlagBits. What is counted is what the draws ask for, whatever the library saves or repeats:
/// how often functions are called is in struct rhw_stats.
struct rhw_pipeline_statistics {
    uint64_t input_assembly_vertices;   ///< for every instance; restart indices are none
    uint64_t input_assembly_primitives; ///< complete ones
    uint64_t vertex_shader_invocations; ///< one for each of the vertices
    uint64_t clipping_invocations;      ///< one for each of the primitives
    /// Of them, those that have finite positions and do not lie outside one side of the view volume, clip or cull
    /// distance as a whole.
    uint64_t clipping_primitives;
    /// Fragments that passed the tests before the fragment function or, where it or alpha_to_coverage decides about
    /// their samples or depth, were covered; one for each sample where it runs per sample.
    uint64_t fragment_shader_invocations;
};

/// What a query's kind asks for is set, the rest 0.
struct rhw_query_counts {
    uint64_t samples_passed; ///< OCCLUSION
    bool any_passed;         ///< ANY_PASSED
    struct rhw_pipeline_statistics statistics;
    uint64_t timestamp_ns;                          ///< TIMESTAMP: of a clock that only counts up
    uint64_t primitives_written, primitives_needed; ///< TRANSFORM_FEEDBACK
};

/// How triangles of a tile were drawn, a bit each. All ways draw the same bytes.
enum rhw_tile_plan {
    RHW_TILE_IN_ORDER = 1,    ///< as they were submitted
    RHW_TILE_DEPTH_FIRST = 2, ///< their depth, then what of them is seen
    RHW_TILE_BACKWARDS = 4    ///< from the last one on, until no pixel is open
};

/// A tile is a square of pixels that one thread draws from load to store. Tiles are cut off at the target's end.
struct rhw_tile_report {
    int x, y, width, height; ///< pixels of the target, from its top left
    int layer;
    uint32_t plans; ///< or-ed rhw_tile_plan; 0: nothing was drawn. Where a pass has flushes, of all of them
    uint64_t triangles; ///< that were to be drawn here; a clipped one may count as two and more
    uint64_t fragments_shaded, fragment_groups; ///< as in struct rhw_stats, of which these are parts
    double busy_ms;                             ///< of its threads
};

/// How many tiles the pass has, those of layers after each other.
RHW_API int rhw_pass_tile_count(rhw_context *context, rhw_pass pass);
/// Asks for the reports of all tiles, row by row: `count` is rhw_pass_tile_count. They are filled in when the pass ends with
/// success, and must live until it has ended. Once a pass. What is drawn, and how, does not depend on it.
RHW_API void rhw_pass_report_tiles(rhw_context *context, rhw_pass pass, struct rhw_tile_report *reports,
                                   int count);

#endif
