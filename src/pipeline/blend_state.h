// SPDX-License-Identifier: MIT
// What a draw does to the texels of one colour target. The blending itself is a kernel (kernels/fragment/blend.h); the
// decisions that hold for a whole draw are made here, once.
#ifndef RHW_BLEND_STATE_H
#define RHW_BLEND_STATE_H

#include "format/format.h"

// The path that a draw takes through the kernel.
enum rhw_blend_path {
    BLEND_NOTHING,       // write mask 0
    BLEND_RGBA8_REPLACE, // all channels
    BLEND_RGBA8_MASKED,  // some channels
    BLEND_RGBA8_OVER,    // SRC_ALPHA or ONE, and ONE_MINUS_SRC_ALPHA, added
    BLEND_SRGB8_REPLACE, // any channels
    BLEND_SRGB8_OVER,    // the factors of BLEND_RGBA8_OVER
    BLEND_RGBA8_SUM,     // ONE and ONE, added
    BLEND_BITS_REPLACE,  // one channel of 32 bits
    BLEND_REPLACE,       // all channels of a format that has no path of its own
    BLEND_OVER,          // the factors of BLEND_RGBA8_OVER, all channels of such a format
    BLEND_GENERAL
};

// What tiles have in the place of a target that is left out: texels of 4 bytes, beside which other targets stay woven.
static const enum rhw_format rhw_left_out_format = RHW_FORMAT_RGBA8_UNORM;

struct rhw_blend_state {
    enum rhw_blend_path path;
    const struct rhw_format_info *format;
    enum rhw_format known;     // the format, for code of its own; RHW_FORMAT_NONE: none
    bool blend;                // false too where blending is replacement spelled out
    bool color_one, alpha_one; // the source factor is ONE
    bool is_sum;               // ONE and ONE, added
    // A factor is of the second source, color[1] of the fragment.
    bool reads_second;
    bool writes_all;        // all channels of the format
    bool replaces;          // replaces the whole texel, whatever it was
    uint8_t write_mask;     // only channels that the format has
    uint32_t texel_mask[4]; // the bits that are written
    // RHW_LOGIC_OFF too where the format takes the source as it is.
    enum rhw_logic logic;
    struct rhw_blend_component color, alpha;
    // Normalized formats clamp the source to this, 0 or −1, and 1.
    float least;
    float constant[4]; // clamped as the source is
};

// Set the state from a target that is valid for its format, the pipeline's `logic` and the pass's blend constant.
void rhw_blend_state_init(struct rhw_blend_state *state, const struct rhw_color_target *target,
                          enum rhw_logic logic, const float constant[4]);

// Take the general path instead of a special one. BLEND_RGBA8_OVER stays: it rounds once where the general path rounds
// twice, so that three channels in a million differ by 1/255. It defines what draws of its factors look like. Paths of
// integers stay too.
void rhw_blend_state_generalize(struct rhw_blend_state *state);

// Return true if a target's blending reads color[1] of the fragment function.
bool rhw_blend_reads_second(const struct rhw_color_target *target);

#endif
