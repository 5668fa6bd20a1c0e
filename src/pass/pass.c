// SPDX-License-Identifier: MIT
// Draws are recorded here. The files beside this one set what draws use. pass/begin.c begins a pass, and run/run.c runs
// it.
#include "pass.h"

#include <string.h>

#include "draw/assembly.h"
#include "context/context.h"
#include "base/cpu.h"
#include "pipeline/depth_stencil.h"
#include "draw_range.h"
#include "run/effect_vertices.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "pass_draw_state.h"
#include "encoder.h"
#include "pipeline/pipeline.h"
#include "query.h"
#include "rhw/rhw.h"
#include "draw/shared_vertices.h"
#include "run/strip_stipple.h"
#include "transform_feedback.h"
#include "binding/validation/validation.h"

// Return true if nothing of a first draw can be seen: it asks for greater depth, as reversed depth does, and depth was
// cleared to 1 because a zeroed definition gives no value. It is legal, so a context that validates alone is asked.
static bool faces_unset_depth(const struct rhw_encoder *encoder)
{
    const struct rhw_pipeline_def *const def = &encoder->pending.pipeline->def;
    return encoder->context->validation && encoder->depth_by_default && encoder->pass->draws.count == 0 &&
           def->depth_test &&
           (def->depth_compare == RHW_COMPARE_GREATER || def->depth_compare == RHW_COMPARE_GREATER_EQUAL);
}

// Return true if the next draw writes stencil that the pass has read-only. The pass may have set its write masks.
static bool writes_read_only_stencil(const struct rhw_encoder *encoder)
{
    return encoder->pass->target.stencil.is_read_only &&
           rhw_writes_stencil(&encoder->pending.pipeline->def, &encoder->pending.depth_setting);
}

static bool check_draw(const struct rhw_encoder *encoder, bool indexed, const char *where)
{
    struct rhw_context *const context = encoder->context;
    const struct rhw_pipeline_data *const pipeline = encoder->pending.pipeline;
    if (!rhw_check(context, pipeline != NULL, "%s: no pipeline is set%s", where,
                   encoder->refused_pipeline ? ", as the one that was to be was refused" : "") ||
        !rhw_check(context, !indexed || rhw_bound_is_set(&encoder->bound.indices),
                   "%s: no index buffer is set", where) ||
        !rhw_check(context, encoder->uniform_size >= pipeline->def.program.uniform_size,
                   "%s: %u bytes of uniforms are set; the program of %s reads %u", where,
                   encoder->uniform_size,
                   rhw_name_of(&context->pipelines, encoder->bound.pipeline.index).text,
                   pipeline->def.program.uniform_size) ||
        !rhw_check(
            context, !faces_unset_depth(encoder),
            "%s: the first draw asks for greater depth, which RHW_LOAD_DEFAULT cleared to 1; clear to 0 by "
            "RHW_LOAD_CLEAR",
            where) ||
        !rhw_check(
            context, !writes_read_only_stencil(encoder),
            "%s: %s writes stencil, and the pass has it read_only; its operations must keep it, or its "
            "write masks have no bits",
            where, rhw_name_of(&context->pipelines, encoder->bound.pipeline.index).text)) {
        return false;
    }
    for (int i = 0; i < pipeline->def.attribute_count; i++) {
        const int slot = pipeline->def.attributes[i].buffer;
        if (!rhw_check(context, rhw_bound_is_set(&encoder->bound.vertices[slot]),
                       "%s: no vertex buffer is set in slot %d, which attribute %d of %s reads", where, slot,
                       i, rhw_name_of(&context->pipelines, encoder->bound.pipeline.index).text)) {
            return false;
        }
    }
    return true;
}

// Return the uniforms of the next draw, as the functions of its pipeline or their validator want them.
static const void *uniforms_of(struct rhw_encoder *encoder)
{
    const struct rhw_pipeline_data *const pipeline = encoder->pending.pipeline;
    if (!pipeline->validator) {
        return encoder->uniforms;
    }
    const void *const validated =
        rhw_validated_uniforms(&encoder->pass->arena, encoder->uniforms, pipeline->def.program.uniform_size,
                               encoder->pass->draws.count);
    encoder->out_of_memory |= !validated;
    return validated;
}

static void append_draw(struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count)
{
    struct rhw_recorded_pass *const pass = encoder->pass;
    // Viewport and blend constant are converted in the renderer's floating-point environment.
    const uint64_t environment = rhw_cpu_float_enter();
    const struct rhw_draw_state *const state = rhw_pass_draw_state(encoder);
    rhw_cpu_float_leave(environment);
    struct rhw_draw *const slot = state ? rhw_draw_list_next(pass->arena.memory, &pass->draws) : NULL;
    if (!slot) {
        encoder->out_of_memory = true;
        return;
    }
    *slot = *draw;
    slot->state = state;
    slot->bindings = encoder->bindings;
    slot->uniforms = uniforms_of(encoder);
    slot->index = pass->draws.count;
    slot->group = encoder->context->recording.group;
    slot->first_triangle = pass->triangle_count;
    const bool stipples = rhw_strip_stipple_needed(slot);
    slot->is_shaded_first = stipples || state->pipeline->def.program.vertex_effects;
    if (encoder->out_of_memory || !rhw_assembly_prepare(slot, count, &pass->arena) ||
        (stipples && !rhw_strip_stipple_prepare(slot, count, &pass->arena)) ||
        (slot->is_shaded_first && !rhw_effect_vertices_prepare(slot, &pass->arena)) ||
        (encoder->feedback.is_active && !rhw_feedback_add_draw(encoder, slot)) ||
        !rhw_pass_route_draw(encoder, slot)) {
        encoder->out_of_memory = true;
        return;
    }
    pass->shades_first |= slot->is_shaded_first;
    pass->shades_samples |= state->plans[RHW_PHASE_ONLY].sampling == RHW_SAMPLING_SAMPLE;
    pass->shows_order |= state->pipeline->def.program.uses_atomic_results;
    pass->draws.count++;
    encoder->context->recording.draw = pass->draws.count;
    pass->has_large_draws |= slot->indexed && slot->triangles_per_instance >= RHW_SHARING_TRIANGLES;
    const int triangles_most = state->pipeline->triangles_most;
    pass->triangles_most = triangles_most > pass->triangles_most ? triangles_most : pass->triangles_most;
    const int components = state->pipeline->varying_components;
    pass->components_most = components > pass->components_most ? components : pass->components_most;
    pass->triangle_count += (uint64_t)slot->triangles_per_instance * slot->instances;
    if (state->queries) {
        rhw_queries_count_draw(slot, count);
    }
}

// Check that the index buffer lives. Recording looks at indices, and what a recorder has set may be destroyed.
static __attribute__((noinline)) bool check_indices_live(const struct rhw_encoder *encoder, const char *where)
{
    const struct rhw_context *const context = encoder->context;
    const struct rhw_use *const use = rhw_use_table_find(context->uses, encoder->bound.indices.data);
    return !use || rhw_context_item(context, &context->buffers, use->index, use->generation, where);
}

void rhw_pass_record(struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count,
                     const char *where)
{
    if (!encoder->out_of_memory && check_draw(encoder, draw->indexed, where) &&
        (!encoder->context->uses || !draw->indexed || check_indices_live(encoder, where)) &&
        (!encoder->context->validation || rhw_draw_range_check(encoder, draw, count, where))) {
        append_draw(encoder, draw, count);
    }
}

static void record(rhw_context *context, rhw_pass id, const struct rhw_draw *draw, uint32_t count,
                   const char *where)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder) {
        rhw_pass_record(encoder, draw, count, where);
        rhw_context_leave(context);
    }
}

void rhw_pass_draw(rhw_context *context, rhw_pass id, uint32_t first, uint32_t count, uint32_t first_instance,
                   uint32_t instances)
{
    const struct rhw_draw draw = {.first = first, .first_instance = first_instance, .instances = instances};
    record(context, id, &draw, count, "rhw_pass_draw");
}

void rhw_pass_draw_indexed(rhw_context *context, rhw_pass id, uint32_t first, uint32_t count,
                           int32_t base_vertex, uint32_t first_instance, uint32_t instances)
{
    const struct rhw_draw draw = {.first = first,
                                  .base_vertex = (uint32_t)base_vertex,
                                  .first_instance = first_instance,
                                  .instances = instances,
                                  .indexed = true};
    record(context, id, &draw, count, "rhw_pass_draw_indexed");
}
