// SPDX-License-Identifier: MIT
// The pipeline of the next draw is set here. It must fit the attachments of the pass.
#include "context/context.h"
#include "context/entry.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "encoder.h"
#include "pipeline/pipeline.h"
#include "rhw/rhw.h"

static const char *format_of(enum rhw_format format, bool is_left_out)
{
    return is_left_out ? "left out" : rhw_format_info(format)->name;
}

// Return true if a definition has a target and a target_count of 0. It is valid, for depth alone, but likely a mistake.
static bool forgets_count(const struct rhw_pipeline_def *def)
{
    return def->target_count == 0 && def->targets[0].format != RHW_FORMAT_NONE;
}

// Check that a pipeline has the targets that the pass has. A pipeline draws only into formats that it was made for.
static bool targets_match(const struct rhw_encoder *encoder, rhw_pipeline id,
                          const struct rhw_pipeline_data *pipeline, const char *where)
{
    const struct rhw_target *const target = &encoder->pass->target;
    struct rhw_context *const context = encoder->context;
    if (!rhw_check(context, pipeline->def.target_count == target->color_count,
                   "%s: %s has %d targets%s; the pass has %d colour attachments", where,
                   rhw_name_of(&context->pipelines, id.index).text, pipeline->def.target_count,
                   forgets_count(&pipeline->def) ? " (targets[0] is set and target_count is 0)" : "",
                   target->color_count)) {
        return false;
    }
    for (int i = 0; i < target->color_count; i++) {
        const struct rhw_attachment *const color = &target->colors[i];
        const enum rhw_format format = pipeline->def.targets[i].format;
        const bool is_left_out = pipeline->left_out >> i & 1;
        if (!rhw_check(context, format == color->format && is_left_out == color->is_left_out,
                       "%s: target %d of %s is %s; the attachment is %s", where, i,
                       rhw_name_of(&context->pipelines, id.index).text, format_of(format, is_left_out),
                       format_of(color->format, color->is_left_out))) {
            return false;
        }
    }
    return rhw_check(context,
                     target->has_depth || !(pipeline->def.depth_test || pipeline->def.depth_bounds_test),
                     "%s: %s tests depth; the pass has no depth attachment", where,
                     rhw_name_of(&context->pipelines, id.index).text) &&
           rhw_check(context,
                     !target->depth.is_read_only || !pipeline->def.depth_test ||
                         pipeline->def.depth_read_only,
                     "%s: %s writes depth, and the pass has it read_only; depth_read_only must be true",
                     where, rhw_name_of(&context->pipelines, id.index).text) &&
           rhw_check(context, target->has_depth || !(pipeline->def.program.uses & RHW_USE_DEPTH_INPUT),
                     "%s: %s reads depth_input; the pass has no depth attachment", where,
                     rhw_name_of(&context->pipelines, id.index).text) &&
           rhw_check(context, target->has_stencil || !(pipeline->def.program.uses & RHW_USE_STENCIL_INPUT),
                     "%s: %s reads stencil_input; the pass has no stencil attachment", where,
                     rhw_name_of(&context->pipelines, id.index).text) &&
           rhw_check(context, target->has_stencil || !pipeline->def.stencil_test,
                     "%s: %s tests stencil; the pass has no stencil attachment", where,
                     rhw_name_of(&context->pipelines, id.index).text);
}

void rhw_pass_set_pipeline(rhw_context *context, rhw_pass id, rhw_pipeline pipeline_id)
{
    static const char *const where = "rhw_pass_set_pipeline";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    const struct rhw_pipeline_data *const pipeline = rhw_context_pipeline(context, pipeline_id, where);
    if (pipeline &&
        rhw_check(context, !encoder->feedback.is_active, "%s: transform feedback is under way; end it first",
                  where) &&
        targets_match(encoder, pipeline_id, pipeline, where)) {
        rhw_encoder_note_use(encoder, &context->pipelines, pipeline_id.index, 0);
        encoder->pending_changed |= encoder->pending.pipeline != pipeline;
        encoder->pending.pipeline = pipeline;
        encoder->bound.pipeline = pipeline_id;
    } else {
        encoder->refused_pipeline = true;
    }
    rhw_context_leave(context);
}
