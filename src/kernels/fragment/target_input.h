// SPDX-License-Identifier: MIT
// Programs may read what the tile holds at the fragments of a queue (RHW_USE_TARGET_INPUT). Groups of these programs
// are rows, and the groups of one call are rows of one block and one triangle, so that no pixel is among them twice:
// what came before has been blended, and each fragment finds what is there in its turn.
#ifndef RHW_TARGET_INPUT_H
#define RHW_TARGET_INPUT_H

#include "kernels/texel/texel_codec.h"
#include "kernels/tile_work.h"
#include "expand.h"
#include "woven.h"

// Return the sample whose texels a group reads: programs that read targets run for every sample.
static int sample_of_group(const struct fragment_queue *queue, int g)
{
    int32_t samples = 1;
    for (int lane = 0; lane < 8; lane++) {
        samples = queue->live[g] >> lane & 1 ? queue->samples[g][lane] : samples;
    }
    return __builtin_ctz((unsigned)samples);
}

// Decode what the tile holds into the colours, depth and stencil inputs of `added` groups from `first` on. Before them
// the queue is empty.
static __attribute__((noinline)) void read_targets(const struct tile_work *work, int first, int added)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    struct fragment_queue *const queue = &scratch->queue;
    const uint32_t uses = work->pipeline->def.program.uses;
    const int count = uses & RHW_USE_COLOR_INPUT ? work->target->color_count : 0;
    for (int g = first; g < first + added; g++) {
        const int at = queue->row_at[g];
        const int sample = work->samples > 1 ? sample_of_group(queue, g) : 0;
        const bool is_expanded = scratch->expanded >> block_of_texel(at) & 1;
        for (int t = 0; t < count; t++) {
            const struct rhw_format_info *const format = work->state->blend[t].format;
            struct raw_texels raw = {{{0}}};
            if (work->samples > 1 && is_expanded && scratch->is_woven) {
                f32x8 texels[WOVEN_SAMPLES];
                load_woven_row(scratch, t, at, texels);
                raw.word[0] = (i32x8)texels[sample];
            } else {
                load_texel_row(
                    format->size,
                    color_of_sample(scratch, t, is_expanded ? sample : 0) + (size_t)at * format->size, &raw);
            }
            decode_texels(format, &raw, queue->colors[g][t]);
        }
        if (uses & RHW_USE_DEPTH_INPUT) {
            queue->groups[g].depth_input = f32x8_load(depth_of_sample(scratch, sample)->texels + at);
        }
        if (uses & RHW_USE_STENCIL_INPUT) {
            queue->groups[g].stencil_input = i32x8_load_bytes(depth_of_sample(scratch, sample)->stencil + at);
        }
    }
}

#endif
