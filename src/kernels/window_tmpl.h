// SPDX-License-Identifier: MIT
// The window: groups of 8 fragments of one draw that wait to be shaded with one call. They are merged in the order in
// which they came, so several of them may have fragments of the same pixel. Template: compiled once per instruction
// set.

#include "../shader_adapter.h"
#include "depth_tmpl.h"
#include "output_tmpl.h"

// Lanes of group g that are still live after discarding and the late depth test.
static unsigned finish_depth(struct tile_work *work, int g)
{
    const struct rhw_group_places *const places = &work->scratch->places;
    const struct rhw_fragment *const group = &work->scratch->groups[g];
    const uint32_t uses = work->pipeline->def.program.uses;
    i8 mask = i8_from_bits(places->bits[g]);
    if (uses & RHW_USE_DISCARD) {
        mask &= rhw_less_int(group->mask, i8_splat(0));
    }
    if (work->depth_mode < DEPTH_LATE) {
        return i8_sign_bits(mask);
    }
    const f8 z = uses & RHW_USE_DEPTH ? viewport_clamp(work->state, group->depth) : group->depth;
    if (!places->packed[g]) {
        const int at = places->at[g];
        return test_row(work, at % RHW_TILE, at / RHW_TILE, z, i8_sign_bits(mask), work->late);
    }
    return test_texels(work, work->scratch->lanes_at[g], z, i8_sign_bits(mask), work->late);
}

// Texels of a packed group, side by side for the merger, and back.
RHW_INLINE void gather_texels(const int32_t at[8], const unsigned char *texels, size_t size,
                              unsigned char *out)
{
    for (int i = 0; i < 8; i++) {
        memcpy(out + (size_t)i * size, texels + (size_t)at[i] * size, size);
    }
}

RHW_INLINE void scatter_texels(const int32_t at[8], unsigned bits, unsigned char *texels, size_t size,
                               const unsigned char *from)
{
    if (bits == 0xff) {
        for (int i = 0; i < 8; i++) {
            memcpy(texels + (size_t)at[i] * size, from + (size_t)i * size, size);
        }
        return;
    }
    for (; bits != 0; bits &= bits - 1) {
        const int lane = __builtin_ctz(bits);
        memcpy(texels + (size_t)at[lane] * size, from + (size_t)lane * size, size);
    }
}

// Merges what was shaded into target t. `kind` and `size` (bytes of a texel) are the target's, constants where a
// call names them.
RHW_INLINE void merge_target(const struct tile_work *work, int t, enum output_kind kind, size_t size)
{
    struct output_state state = work->state->outputs[t];
    state.kind = kind;
    struct rhw_tile_scratch *const scratch = work->scratch;
    unsigned char *const texels = scratch->color[t];
    const struct rhw_group_places *const places = &scratch->places;
    const int count = work->count;
    const bool has_short_road = kind == OUTPUT_RGBA8_REPLACE || kind == OUTPUT_RGBA8_OVER;
    if (has_short_road && work->all_full && state.texel_mask == UINT32_MAX) {
        state.texel_mask = UINT32_MAX; // known from here on
        for (int g = 0; g < count; g++) {
            output_group(&state, scratch->outputs[g][t], i8_splat(-1), texels + (size_t)places->at[g] * size);
        }
        return;
    }
    for (int g = 0; g < count; g++) {
        const f8 *const color = scratch->outputs[g][t];
        if (!places->packed[g]) {
            output_group(&state, color, i8_from_bits(places->bits[g]), texels + (size_t)places->at[g] * size);
            continue;
        }
        _Alignas(32) unsigned char lanes[8 * 16];
        const int32_t *const at = scratch->lanes_at[g];
        if (kind != OUTPUT_RGBA8_REPLACE) {
            gather_texels(at, texels, size, lanes);
        }
        output_group(&state, color, i8_splat(-1), lanes);
        scatter_texels(at, places->bits[g], texels, size, lanes);
    }
}

static void run_fragment_function(const struct tile_work *work, int count)
{
    if (work->pipeline->fragment) {
        work->pipeline->fragment(work->scratch->groups, count);
    } else {
        rhw_fragment1_run(work->pipeline, work->scratch->groups, count);
    }
}

// Shades and merges the groups of the window. Fragments without a group go on waiting.
static void shade_window(struct tile_work *work)
{
    struct rhw_tile_scratch *const scratch = work->scratch;
    run_fragment_function(work, work->count);
    if (work->depth_mode >= DEPTH_LATE || work->pipeline->def.program.uses & RHW_USE_DISCARD) {
        for (int g = 0; g < work->count; g++) {
            scratch->places.bits[g] = (uint8_t)finish_depth(work, g);
            work->all_full = work->all_full && scratch->places.bits[g] == 0xff;
        }
    }
    for (int t = 0; t < work->pass->color_count; t++) {
        const enum output_kind kind = work->state->outputs[t].kind;
        if (kind == OUTPUT_RGBA8_REPLACE) {
            merge_target(work, t, OUTPUT_RGBA8_REPLACE, 4);
        } else if (kind == OUTPUT_RGBA8_OVER) {
            merge_target(work, t, OUTPUT_RGBA8_OVER, 4);
        } else {
            merge_target(work, t, kind, work->pass->colors[t].texel_size);
        }
    }
    work->counters->groups += (uint64_t)work->count;
    work->count = 0;
    work->all_full = true;
}
