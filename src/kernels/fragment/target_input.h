// SPDX-License-Identifier: MIT
// Programs may read what the tile holds at the fragments of a queue (RHW_USE_TARGET_INPUT). Groups of these programs
// are rows, and the groups of one call are rows of one triangle, so that no sample is among them twice: what came
// before has been blended, and each fragment finds what is there in its turn.
#ifndef RHW_TARGET_INPUT_H
#define RHW_TARGET_INPUT_H

#include "kernels/texel/texel_codec.h"
#include "kernels/tile_work.h"
#include "expand.h"
#include "woven.h"

// Return true if texels of a format are 4 channels of 8 bits in some order. Most pictures have such.
RHW_INLINE bool is_four_bytes(const struct rhw_format_info *format)
{
    return format->codec == RHW_CODEC_UNORM8 && format->channels == 4 &&
           (format->order == RHW_ORDER_RGBA || format->order == RHW_ORDER_BGRA);
}

// Decode 8 texels of 4 channels of 8 bits.
RHW_INLINE void read_four_bytes(const unsigned char *texels, bool is_bgra, f32x8 value[4])
{
    const i32x8 word = i32x8_load(texels);
    value[0] = unorm8_to_float(channel_byte(word, is_bgra ? 2 : 0));
    value[1] = unorm8_to_float(channel_byte(word, 1));
    value[2] = unorm8_to_float(channel_byte(word, is_bgra ? 0 : 2));
    value[3] = unorm8_to_float(channel_byte(word, 3));
}

// Decode what target t holds in a sample into the colours of the groups from `first` on, which are rows of a block.
RHW_INLINE void read_rows(const struct tile_work *work, int t, int sample, int first, int end)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    const struct rhw_format_info *const format = work->state->blend[t].format;
    const unsigned char *const texels = color_of_sample(work->scratch, t, sample);
    const bool is_bgra = format->order == RHW_ORDER_BGRA;
    if (is_four_bytes(format) && is_bgra) {
        for (int g = first; g < end; g++) {
            read_four_bytes(texels + (size_t)queue->row_at[g] * 4, true, queue->colors[g][t]);
        }
        return;
    }
    if (is_four_bytes(format)) {
        for (int g = first; g < end; g++) {
            read_four_bytes(texels + (size_t)queue->row_at[g] * 4, false, queue->colors[g][t]);
        }
        return;
    }
    for (int g = first; g < end; g++) {
        struct raw_texels raw = {{{0}}};
        load_texel_row(format->size, texels + (size_t)queue->row_at[g] * format->size, &raw);
        decode_texels(format, &raw, queue->colors[g][t]);
    }
}

// Do what read_rows does, of a sample of texels that are woven.
static __attribute__((noinline)) void read_woven_rows(const struct tile_work *work, int t, int sample,
                                                      int first, int end)
{
    struct fragment_queue *const queue = &work->scratch->queue;
    for (int g = first; g < end; g++) {
        f32x8 texels[WOVEN_SAMPLES];
        load_woven_row(work->scratch, t, queue->row_at[g], texels);
        const struct raw_texels raw = {{(i32x8)texels[sample]}};
        decode_texels(work->state->blend[t].format, &raw, queue->colors[g][t]);
    }
}

// Decode what the tile holds into the colours, depth and stencil inputs of `added` groups from `first` on. They are
// rows of a block, in one sample, and the groups before them are of the same triangle.
static __attribute__((noinline)) void read_targets(const struct tile_work *work, int first, int added)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    struct fragment_queue *const queue = &scratch->queue;
    const uint32_t uses = work->pipeline->def.program.uses;
    const int count = uses & RHW_USE_COLOR_INPUT ? work->target->color_count : 0, end = first + added;
    const int sample = work->samples > 1 ? queue->sample[first] : 0;
    const bool is_expanded =
        work->samples > 1 && scratch->expanded >> block_of_texel(queue->row_at[first]) & 1;
    for (int t = 0; t < count; t++) {
        if (is_expanded && scratch->is_woven) {
            read_woven_rows(work, t, sample, first, end);
        } else {
            read_rows(work, t, is_expanded ? sample : 0, first, end);
        }
    }
    const struct tile_depth *const depth = depth_of_sample(scratch, sample);
    for (int g = first; g < end && uses & RHW_USE_DEPTH_INPUT; g++) {
        queue->groups[g].depth_input = f32x8_load(depth->texels + queue->row_at[g]);
    }
    for (int g = first; g < end && uses & RHW_USE_STENCIL_INPUT; g++) {
        queue->groups[g].stencil_input = i32x8_load_bytes(depth->stencil + queue->row_at[g]);
    }
}

#endif
