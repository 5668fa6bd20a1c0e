// SPDX-License-Identifier: MIT
// Programs may read what the tile holds at the fragments of a queue (RHW_USE_TARGET_INPUT). Groups of these programs
// are rows, and the groups of one call are rows of one triangle, so that no sample is among them twice: what came
// before has been blended, and each fragment finds what is there in its turn.
#ifndef RHW_TARGET_INPUT_H
#define RHW_TARGET_INPUT_H

#include "kernels/texel/texel_codec.h"
#include "kernels/tile_work.h"
#include "expand.h"
#include "row_sample.h"
#include "woven.h"

// Return true if texels of a format are 4 channels of 8 bits in some order. Most pictures have such.
RHW_INLINE bool is_four_bytes(const struct rhw_format_info *format)
{
    return format->codec == RHW_CODEC_UNORM8 && format->channels == 4 &&
           (format->order == RHW_ORDER_RGBA || format->order == RHW_ORDER_BGRA);
}

// Decode a row of a target whose texels are 4 channels of 8 bits.
RHW_INLINE void read_four_bytes(const struct rhw_format_info *format, const unsigned char *texels,
                                f32x8 value[4])
{
    const i32x8 word = i32x8_load(texels);
    const bool is_bgra = format->order == RHW_ORDER_BGRA;
    value[is_bgra ? 2 : 0] = unorm8_to_float(channel_byte(word, 0));
    value[1] = unorm8_to_float(channel_byte(word, 1));
    value[is_bgra ? 0 : 2] = unorm8_to_float(channel_byte(word, 2));
    value[3] = unorm8_to_float(channel_byte(word, 3));
}

// Decode what the tile holds into the colours, depth and stencil inputs of `added` groups from `first` on. The groups
// before them are of the same triangle.
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
            if (is_four_bytes(format) && !scratch->is_woven) {
                read_four_bytes(format,
                                color_of_sample(scratch, t, is_expanded ? sample : 0) + (size_t)at * 4,
                                queue->colors[g][t]);
                continue;
            }
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
