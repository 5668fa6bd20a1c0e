// SPDX-License-Identifier: MIT
// The back end is compiled as six files, which takes less time than one: tile.c has the tile's loop, tile_small.c,
// tile_large.c and tile_samples.c the paths of triangles, tile_fragments.c makes groups of fragments, and
// tile_shading.c shades and blends them. The functions that one of these files compiles for the others are declared
// here, by their names in this instruction set.
#ifndef RHW_TILE_UNITS_H
#define RHW_TILE_UNITS_H

#include "rhw/isa.h"
#include "tile_work.h"
#include "triangle_work.h"

struct block;
struct rhw_sample_pattern;
struct sampled_block;
struct triangle_run;
struct triangle_setup8;

// What a sample holds.
struct sample_content {
    float depth, color[RHW_MAX_COLOR_ATTACHMENTS][4];
    uint8_t stencil;
};

// tile.c: what stands before and behind a triangle in the history of a sample (tile/explained_triangle.h).
void RHW_ISA_NAME(rhw_explain_begin)(struct tile_work *work, struct sample_content *before);
void RHW_ISA_NAME(rhw_explain_end)(struct tile_work *work, const struct sample_content *before,
                                   const struct triangle_work *triangle);

// The paths, each of which draws a run of triangles (tile/triangle_path.h).
// tile_small.c
void RHW_ISA_NAME(rhw_draw_tiny)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_small)(const struct triangle_run *run);
// tile_large.c
void RHW_ISA_NAME(rhw_draw_spans)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_large)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_shape)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_stippled_line)(const struct triangle_run *run);
// tile_samples.c
void RHW_ISA_NAME(rhw_draw_tiny_samples)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_small_samples)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_large_samples)(const struct triangle_run *run);

// They find the tiny triangles of a batch, and what these cover: where pixels have one sample, and 4.
// tile_small.c
void RHW_ISA_NAME(rhw_find_tiny)(struct triangle_setup8 *setup);
// tile_samples.c
void RHW_ISA_NAME(rhw_find_tiny_samples)(struct triangle_setup8 *setup,
                                         const struct rhw_sample_pattern *pattern);
// It draws a block of 8×8 pixels with several samples.
void RHW_ISA_NAME(rhw_draw_sampled_block)(struct tile_work *work, struct triangle_work *triangle,
                                          struct sampled_block *block);

// tile_shading.c
// Shades the queue's groups.
void RHW_ISA_NAME(rhw_shade_queue)(struct tile_work *work);
// They shade the constant colour of a draw (fragment/constant_color.h), and blend the pixels of a block that are set in
// `mask` by it: into texels of a target, and by samples where these are woven.
void RHW_ISA_NAME(rhw_prepare_constant)(struct tile_work *work);
void RHW_ISA_NAME(rhw_blend_constant_block)(const struct tile_work *work, int t, unsigned char *texels,
                                            uint64_t mask);
void RHW_ISA_NAME(rhw_blend_constant_woven)(struct tile_work *work, int x, int y,
                                            const uint64_t mask[RHW_MAX_SAMPLES]);

// tile_fragments.c
// Shades all there is, also the partial group.
void RHW_ISA_NAME(rhw_flush)(struct tile_work *work);
// Queues the partial group, which is full.
void RHW_ISA_NAME(rhw_pack_group)(struct tile_work *work);
// Queues the partial group, however few fragments it has.
void RHW_ISA_NAME(rhw_release_partial)(struct tile_work *work);
// Makes room for the collected fragments of one more block.
void RHW_ISA_NAME(rhw_make_room)(struct tile_work *work, struct triangle_work *triangle);
// Makes groups of the collected fragments of a triangle, which is done, and packs the rest of them.
void RHW_ISA_NAME(rhw_release_collected)(struct tile_work *work, struct triangle_work *triangle);
// Queues the rows of a block that is covered all over, or those of its pixels that are set in `mask`.
void RHW_ISA_NAME(rhw_queue_block)(struct tile_work *work, struct triangle_work *triangle,
                                   const struct block *block);
void RHW_ISA_NAME(rhw_queue_some_rows)(struct tile_work *work, struct triangle_work *triangle,
                                       const struct block *block, uint64_t mask);
// Queues and shades all blocks of a tile that a triangle covers.
void RHW_ISA_NAME(rhw_queue_tile)(struct tile_work *work, struct triangle_work *triangle);
#endif
