// SPDX-License-Identifier: MIT
// A worker's work on a tile: where the tile is, the draw whose fragments are collected, and the memory it needs. The
// memory is allocated once per thread. Colours are there for as many attachments as any pass has had, varyings for as
// many components, and bins for the chunks of the wave; the rest is sized by the limits of the API, and a draw touches
// only what it uses of it.
#ifndef RHW_TILE_WORK_H
#define RHW_TILE_WORK_H

#include "draw/draw_plan.h"
#include "draw/wave.h"
#include "pipeline/pipeline.h"
#include "base/simd_layout.h"
#include "kernels/raster/plane.h"
#include "kernels/depth/tile_depth.h"

enum {
    // Groups of 8 fragments per call of the fragment function. They are two whole blocks: enough to hide the call, few
    // enough that their varyings stay in the first cache level.
    RHW_FRAGMENT_GROUPS = RHW_MAX_GROUPS,
    // Triangles of a tile whose visibility is remembered from the first phase to the second: 4 KiB of bits. A longer
    // run is drawn as submitted.
    RHW_DEPTH_FIRST_TRIANGLES = 32768,
    // Triangles whose fragments may wait in the partial group at once: 7 that wait, and the one that adds.
    RHW_PACKED_TRIANGLES = 8,
    // Fragments of one triangle that are collected before groups are made of them: those of two blocks.
    RHW_COLLECTED_FRAGMENTS = 128
};

// The fragment queue: groups of 8 fragments of one draw that wait to be shaded with one call (fragment/queue.h). A
// texel of the tile has the number y·RHW_TILE + x. A block's rows are always written as 8 entries, so there is room for
// 8 from the last group on.
struct fragment_queue {
    struct rhw_fragment groups[RHW_FRAGMENT_GROUPS];
    // The first texel of a group that is 8 in a row.
    int32_t row_at[RHW_FRAGMENT_GROUPS + RHW_BLOCK];
    // The group's lanes lie anywhere: `texels` tells where.
    bool is_scattered[RHW_FRAGMENT_GROUPS + RHW_BLOCK];
    uint8_t live[RHW_FRAGMENT_GROUPS + RHW_BLOCK]; // a bit per lane
    // The sample of a group that stands for one sample of each of its pixels. Draws have it that shade each sample.
    uint8_t sample[RHW_FRAGMENT_GROUPS + RHW_BLOCK];
    int32_t texels[RHW_FRAGMENT_GROUPS][8];
    int count;           // number of groups
    bool only_full_rows; // every group is 8 live pixels in a row
    // Varyings of the groups, one group behind the other, and their derivatives. The worker has room for as many
    // components as a draw of any pass has had.
    f32x8 *varyings, *ddx, *ddy;
    f32x8 colors[RHW_FRAGMENT_GROUPS][RHW_MAX_COLOR_ATTACHMENTS][4];
    // The samples of each fragment, a bit each, and their depths where they are tested late. Multisampled passes have
    // them.
    i32x8 samples[RHW_FRAGMENT_GROUPS];
    f32x8 sample_depth[RHW_FRAGMENT_GROUPS][RHW_MAX_SAMPLES];
    // How much of each pixel is covered by smooth lines.
    f32x8 coverage[RHW_FRAGMENT_GROUPS];
};

// Texels of the fragments of the triangle under way that are in no group yet (fragment/collect.h).
struct collected_fragments {
    // There is room for a vector that begins at the last texel. Vectors of a group lie in one cache line each.
    _Alignas(32) int32_t texel[RHW_COLLECTED_FRAGMENTS + 8];
    // The samples of each fragment. Multisampled passes have them.
    int32_t samples[RHW_COLLECTED_FRAGMENTS + 8];
    // For each number of 8 bits, the bits that are set, in order. Lanes of any number stand behind them.
    uint8_t set_lanes[256][8];
    // The fragments from `first` on, below `count`, are left.
    int first, count;
    // Some lie where fragments of other triangles wait in the partial group: groups must not go first.
    bool overtakes;
};

// This is kept of a triangle until its last fragment has found a group.
struct packed_triangle {
    struct derivative_pair derivatives[RHW_MAX_VARYING_COMPONENTS / 2]; // see component_derivatives
    struct derivative_pair weights;                                     // derivatives of the weights b and c
    const float *varyings[3], *provoking;
    struct plane n1, n2;    // weights on the screen
    int anchor_x, anchor_y; // pixels in the tile
    // Depth is held to its range for multisampled passes. Other passes hold depth to its range anyway.
    bool clamps_depth;
    int32_t front_facing, primitive, instance, draw;
};

// Fragments of several triangles that wait until 8 make a group (fragment/pack.h).
struct partial_group {
    int count;
    int32_t samples[8]; // the samples of each fragment, in multisampled passes
    // The depths of samples, in multisampled passes where they are tested late.
    float sample_depth[RHW_MAX_SAMPLES][8];
    // Number of triangles packed so far. The last RHW_PACKED_TRIANGLES of them stand in `triangles`.
    unsigned triangle_count;
    int32_t texel[8];
    const struct packed_triangle *triangle[8];
    f64x4 quantities[8];
    f64x4 screen[8]; // weights on the screen of vertices 1 and 2, where they are wanted
    // Pixels from the anchor, as struct derivative_pair has them: down, to the right, down, to the right.
    f64x4 distance[8];
    uint64_t pixels[RHW_TILE]; // pixels that wait: a bit per pixel, by row
    struct packed_triangle triangles[RHW_PACKED_TRIANGLES];
};

// The triangles that a chunk has for a tile: chunk->entries[first] .. chunk->entries[end − 1].
struct bin {
    const struct rhw_chunk *chunk;
    uint32_t first, end;
};

struct rhw_tile_scratch {
    _Alignas(64) struct tile_depth depth;
    rhw_tile_colors *color; // an array of the attachments
    // Bit i says that triangle i of the run is drawn in the second phase.
    uint8_t seen[RHW_DEPTH_FIRST_TRIANGLES / 8];
    struct bin *bins; // bins of the tile that are not empty; there is room for all chunks of the wave
    struct fragment_queue queue;
    struct collected_fragments collected;
    struct partial_group partial;
    // 8 texels of each target whose texels are replaced; see constant_color.h.
    _Alignas(32) unsigned char constant[RHW_MAX_COLOR_ATTACHMENTS][RHW_LANES * RHW_TEXEL_BYTES];
    // Multisampled passes have a bit for each block of 8×8 pixels: its samples have colours of their own. All samples
    // of other blocks have the first one's colour.
    uint64_t expanded;
    // The expanded samples of a pixel stand side by side (fragment/woven.h).
    bool is_woven;
    struct rhw_sample_tile *sample_tiles; // tiles of the samples after the first
};

// The tile in one sample of each pixel.
struct rhw_sample_tile {
    _Alignas(64) struct tile_depth depth;
    rhw_tile_colors *color;
};

static inline unsigned char *color_of_sample(struct rhw_tile_scratch *scratch, int target, int sample)
{
    return sample == 0 ? scratch->color[target] : scratch->sample_tiles[sample - 1].color[target];
}

enum { WOVEN_SAMPLES = 4, WOVEN_SIZE = 4 }; // samples of a pixel, and bytes of each

// Return the samples of a texel where they are woven. They take the room of the second sample's colours.
static inline unsigned char *woven_pixel(struct rhw_tile_scratch *scratch, int target, int texel)
{
    return scratch->sample_tiles->color[target] + (size_t)texel * (WOVEN_SAMPLES * WOVEN_SIZE);
}

static inline struct tile_depth *depth_of_sample(struct rhw_tile_scratch *scratch, int sample)
{
    return sample == 0 ? &scratch->depth : &scratch->sample_tiles[sample - 1].depth;
}

// The samples of a pixel of a cell (tile/sample_cells.h). Pixels are counted from the centre of the cell's first pixel,
// in whole 256ths, so that sums with whole pixels are exact.
struct cell_pixel {
    f64x4 dx, dy;
};

// These are pixels of the tile; x1 and y1 are exclusive.
struct tile_rect {
    int x0, y0, x1, y1;
};

// This is one worker's work on one tile.
struct tile_work {
    const struct rhw_wave *wave;
    const struct rhw_target *target; // the wave's target
    struct rhw_tile_scratch *scratch;
    struct rhw_counters *counters;
    int worker;        // number of the worker
    int tile;          // number of the tile, row by row
    int layer;         // layer of the pass
    int x, y;          // the tile's first pixel in the target
    int width, height; // pixels of the tile: fewer at the target's end
    // Pixels within the render area. The others are neither loaded nor stored.
    struct tile_rect area;
    int samples;                       // samples of a pixel
    struct cell_pixel cell_pixels[16]; // used where a pixel has 4 samples
    enum rhw_phase phase;

    // The draw whose fragments are collected, and what follows from it.
    const struct rhw_draw *draw;
    const struct rhw_draw_state *state;
    const struct rhw_pipeline_data *pipeline;
    struct rhw_draw_plan plan; // plan of the state, in the phase
    bool tests_bounds;         // fragments behind the tile's bounds fail the depth test
    bool tests_small_bounds;   // small triangles are asked whether they lie behind the tile's bounds
    bool is_scissored;         // the scissor, or the target's end, leaves out pixels of the tile
    bool constant_is_ready;    // the draw's constant colour was made
    // The samples that are drawn, by pixels of a cell, where a pixel has 4 samples.
    uint64_t drawn_cell;
    // A group may cover a pixel or sample twice, and the last fragment is seen.
    bool orders_lanes;
    // orders_lanes is true, and fragments need smooth varyings alone to be packed.
    bool packs_plainly;
    uint64_t fragments_before; // what `counters` had when the state was set
    // NULL: another tile is explained, or none.
    struct rhw_explained *explained;
    uint32_t orders; // rhw_tile_order of the runs that were drawn
};

// These tell where a texel of the tile lies. They shift, as texels are never negative, which a compiler cannot know.
RHW_INLINE int texel_column(int texel)
{
    return texel & (RHW_TILE - 1);
}

RHW_INLINE int texel_row(int texel)
{
    return texel >> RHW_TILE_LOG2;
}

// Return where a block at (x, y) of the tile lies from the anchor.
RHW_INLINE struct anchor_offset block_offset(const struct tile_work *work, const struct planes *planes, int x,
                                             int y)
{
    return (
        struct anchor_offset){f64x8_from_i32x8(i32x8_splat(work->x + x - planes->anchor_x) + rhw_lane_index),
                              f64x8_from_i32x8(i32x8_splat(work->y + y - planes->anchor_y) + rhw_lane_index)};
}

#endif
