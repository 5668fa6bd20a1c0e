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

// rhw_explain_begin and rhw_explain_end stand before and behind a triangle in the history of a sample
// (tile/explained_triangle.h). tile.c compiles them.
void RHW_ISA_NAME(rhw_explain_begin)(struct tile_work *work, struct sample_content *before);
void RHW_ISA_NAME(rhw_explain_end)(struct tile_work *work, const struct sample_content *before,
                                   const struct triangle_work *triangle);

// tile_small.c compiles the paths of tiny and small triangles. A path draws a run of triangles (tile/triangle_path.h).
void RHW_ISA_NAME(rhw_draw_tiny)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_small)(const struct triangle_run *run);
// tile_large.c compiles the paths of spans, large triangles, shapes and stippled lines.
void RHW_ISA_NAME(rhw_draw_spans)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_large)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_shape)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_stippled_line)(const struct triangle_run *run);
// tile_samples.c compiles the paths where pixels have several samples.
void RHW_ISA_NAME(rhw_draw_tiny_samples)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_small_samples)(const struct triangle_run *run);
void RHW_ISA_NAME(rhw_draw_large_samples)(const struct triangle_run *run);

// tile_small.c compiles rhw_find_tiny. It finds the tiny triangles of a batch, and what they cover where pixels have
// one sample.
void RHW_ISA_NAME(rhw_find_tiny)(struct triangle_setup8 *setup);
// tile_samples.c compiles rhw_find_tiny_samples. It finds the tiny triangles of a batch, and what they cover where
// pixels have 4 samples.
void RHW_ISA_NAME(rhw_find_tiny_samples)(struct triangle_setup8 *setup,
                                         const struct rhw_sample_pattern *pattern);
// tile_samples.c compiles rhw_draw_sampled_block. It draws a block of 8×8 pixels with several samples.
void RHW_ISA_NAME(rhw_draw_sampled_block)(struct tile_work *work, struct triangle_work *triangle,
                                          struct sampled_block *block);

// tile_shading.c compiles rhw_shade_queue. It shades the queue's groups.
void RHW_ISA_NAME(rhw_shade_queue)(struct tile_work *work);
// tile_shading.c compiles the constant colour of a draw (fragment/constant_color.h). rhw_prepare_constant shades it.
// rhw_blend_constant_block blends it into texels of a target, in the pixels of a block that are set in `mask`, and
// rhw_blend_constant_woven into samples that are woven.
void RHW_ISA_NAME(rhw_prepare_constant)(struct tile_work *work);
void RHW_ISA_NAME(rhw_blend_constant_block)(const struct tile_work *work, int t, unsigned char *texels,
                                            uint64_t mask);
void RHW_ISA_NAME(rhw_blend_constant_woven)(struct tile_work *work, int x, int y,
                                            const uint64_t mask[RHW_MAX_SAMPLES]);

// tile_fragments.c compiles rhw_flush and all functions below it. rhw_flush shades all fragments of the partial group
// and of the queue.
void RHW_ISA_NAME(rhw_flush)(struct tile_work *work);
// Queue the partial group, which is full.
void RHW_ISA_NAME(rhw_pack_group)(struct tile_work *work);
// Queue the partial group, however few fragments it has.
void RHW_ISA_NAME(rhw_release_partial)(struct tile_work *work);
// Make room for the collected fragments of one more block.
void RHW_ISA_NAME(rhw_make_room)(struct tile_work *work, struct triangle_work *triangle);
// Make groups of the collected fragments of a triangle, which is done, and pack the rest of them.
void RHW_ISA_NAME(rhw_release_collected)(struct tile_work *work, struct triangle_work *triangle);
// Queue the rows of a block: of a block that is covered all over, or of its pixels that are set in `mask`.
void RHW_ISA_NAME(rhw_queue_block)(struct tile_work *work, struct triangle_work *triangle,
                                   const struct block *block);
void RHW_ISA_NAME(rhw_queue_some_rows)(struct tile_work *work, struct triangle_work *triangle,
                                       const struct block *block, uint64_t mask);
// Queue and shade all blocks of a tile that a triangle covers.
void RHW_ISA_NAME(rhw_queue_tile)(struct tile_work *work, struct triangle_work *triangle);

#endif
