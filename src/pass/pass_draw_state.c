// SPDX-License-Identifier: MIT
// A draw uses all that was set before it. set_ functions change `bound` and `pending`. A draw copies what it needs of
// them when they have changed.
#include "pass_draw_state.h"

#include <string.h>

#include "resource/buffer.h"
#include "context/context.h"
#include "base/cpu.h"
#include "draw/hidden_surface.h"
#include "dynamic_state.h"
#include "encoder.h"
#include "pass_binding.h"
#include "pipeline/pipeline.h"

static struct rhw_vertex_stream stream_of(struct rhw_bound_buffer bound)
{
    const bool is_padded = bound.data && !bound.data->is_callers;
    return rhw_bound_is_set(&bound) ? (struct rhw_vertex_stream){rhw_bound_bytes(&bound), bound.size,
                                                                 is_padded ? 0 : RHW_FETCH_BYTES}
                                    : (struct rhw_vertex_stream){NULL, 0, 0};
}

// Take the bytes that buffers have now. A buffer that was written after a draw of this pass has new bytes.
static void resolve_buffers(struct rhw_encoder *encoder)
{
    struct rhw_draw_state *const pending = &encoder->pending;
    for (int i = 0; i < RHW_MAX_VERTEX_BUFFERS; i++) {
        pending->streams[i] = stream_of(encoder->bound.vertices[i]);
    }
    const struct rhw_vertex_stream indices = stream_of(encoder->bound.indices);
    pending->indices = indices.bytes;
    pending->index_bytes = indices.size;
}

// Bring `pending` up to date with what is bound. Return false when out of memory.
static bool resolve(struct rhw_encoder *encoder)
{
    const uint32_t rewrites = encoder->context->recording.rewrites;
    const bool rewritten = rewrites != encoder->rewrites_seen;
    if ((rewritten && !rhw_pass_renew_bindings(encoder)) ||
        (encoder->bindings_changed && !rhw_pass_resolve_bindings(encoder))) {
        return false;
    }
    if (rewritten || encoder->pending_changed) {
        resolve_buffers(encoder);
        encoder->pending_changed = true;
    }
    encoder->rewrites_seen = rewrites;
    return true;
}

const struct rhw_draw_state *rhw_pass_draw_state(struct rhw_encoder *encoder)
{
    struct rhw_target *const target = &encoder->pass->target;
    if (!resolve(encoder)) {
        return NULL;
    }
    if (encoder->current && !encoder->pending_changed) {
        return encoder->current;
    }
    struct rhw_draw_state *const state =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *state, RHW_CACHE_LINE);
    if (!state) {
        return NULL;
    }
    *state = encoder->pending;
    rhw_pass_clip_scissor(encoder, state);
    for (int i = 0; i < target->color_count; i++) {
        rhw_blend_state_init(&state->blend[i], &state->pipeline->def.targets[i], state->pipeline->def.logic,
                             state->blend_constant);
        if (encoder->pass->paths == RHW_PATHS_GENERAL) {
            rhw_blend_state_generalize(&state->blend[i]);
        }
    }
    rhw_depth_stencil_init(&state->depth_stencil, &state->pipeline->def, &state->depth_setting,
                           target->depth_steps);
    rhw_draw_state_map_viewport(state);
    rhw_draw_state_set_lines(state);
    state->first_step = RHW_SUBPIXEL - target->pattern->most_0_8 - 1;
    state->past_step = RHW_SUBPIXEL - target->pattern->least_0_8;
    // Conservative coverage asks for the borders of pixels instead of samples.
    if (state->pipeline->is_conservative) {
        state->first_step = -1;
        state->past_step = RHW_SUBPIXEL;
    }
    rhw_draw_plans_make(state->plans, state->pipeline, &state->depth_stencil, target->pattern->count,
                        encoder->pass->paths);
    if (encoder->pass->paths == RHW_PATHS_ALL) {
        state->hidden = rhw_hidden_rule_of(state, target->color_count);
    }
    encoder->current = state;
    memset(encoder->routed, 0, sizeof encoder->routed);
    encoder->pending_changed = false;
    return state;
}

// Return the state of the draw in viewport `i`, or NULL when out of memory.
static const struct rhw_draw_state *routed_state(struct rhw_encoder *encoder, int i)
{
    if (i == 0 || encoder->routed[i]) {
        return i == 0 ? encoder->current : encoder->routed[i];
    }
    struct rhw_draw_state *const state =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *state, RHW_CACHE_LINE);
    if (!state) {
        return NULL;
    }
    *state = *encoder->current;
    state->viewport = encoder->viewports[i];
    state->scissor = encoder->scissors[i];
    state->viewport_index = i;
    rhw_pass_clip_scissor(encoder, state);
    rhw_draw_state_map_viewport(state);
    encoder->routed[i] = state;
    return state;
}

bool rhw_pass_route_draw(struct rhw_encoder *encoder, struct rhw_draw *draw)
{
    if (!draw->state->pipeline->def.program.writes_viewport_index) {
        return true;
    }
    struct rhw_draw *const draws =
        rhw_arena_alloc(&encoder->pass->arena, RHW_MAX_VIEWPORTS * sizeof *draws, RHW_CACHE_LINE);
    if (!draws) {
        return false;
    }
    const uint64_t environment = rhw_cpu_float_enter();
    bool made = true;
    for (int i = 0; i < RHW_MAX_VIEWPORTS && made; i++) {
        draws[i] = *draw;
        draws[i].state = routed_state(encoder, i);
        made = draws[i].state != NULL;
    }
    rhw_cpu_float_leave(environment);
    draw->viewports = draws;
    return made;
}
