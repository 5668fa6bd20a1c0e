// SPDX-License-Identifier: MIT
// When a pass ends, it runs, items and memory that were kept for it are released, and what validation found
// is reported.
#include "resource/buffer.h"
#include "context/context.h"
#include "context/entry.h"
#include "binding/validation/validation.h"
#include "context/misuse.h"
#include "run/run.h"
#include "encoder.h"
#include "pipeline/pipeline.h"
#include "query.h"
#include "rhw/rhw.h"
#include "resource/texture.h"

// Release items that were destroyed, and memory that was replaced, while the pass needed them.
static void release_retired(rhw_context *context)
{
    struct rhw_buffer_data *buffer;
    while ((buffer = rhw_pool_unretire(&context->buffers)) != NULL) {
        rhw_buffer_data_release(&context->memory, buffer);
    }
    struct rhw_texture_data **texture;
    while ((texture = rhw_pool_unretire(&context->textures)) != NULL) {
        rhw_texture_data_destroy(&context->memory, *texture);
    }
    struct rhw_pipeline_data *pipeline;
    while ((pipeline = rhw_pool_unretire(&context->pipelines)) != NULL) {
        rhw_pipeline_data_release(&context->memory, pipeline);
    }
    while (rhw_pool_unretire(&context->samplers) != NULL) {
    }
}

// Return where recording was when it came to a draw.
static struct rhw_recording place_of(const struct rhw_encoder *encoder, uint32_t draw)
{
    struct rhw_recording place = encoder->context->recording;
    place.active = true;
    place.draw = draw;
    place.group = rhw_draw_list_at(&encoder->pass->draws, draw)->group;
    return place;
}

// Report what validation found while the pass ran.
static void report_validation(struct rhw_encoder *encoder)
{
    rhw_context *const context = encoder->context;
    const struct rhw_validation_message *const warning = &context->validation->kinds[RHW_VALIDATION_WARNING];
    const struct rhw_validation_message *const misuse = &context->validation->kinds[RHW_VALIDATION_MISUSE];
    if (warning->found) {
        const struct rhw_recording place = place_of(encoder, warning->draw);
        rhw_context_warn_at(context, &place, warning->text);
    }
    if (misuse->found) {
        const struct rhw_recording place = place_of(encoder, misuse->draw);
        rhw_misuse_at(context, &place, "%s", misuse->text);
    }
}

static enum rhw_result end(struct rhw_encoder *encoder, struct rhw_stats *stats)
{
    rhw_context *const context = encoder->context;
    const uint32_t generation = context->recording.generation;
    (void)rhw_check(context, context->recording.group == NULL,
                    "rhw_pass_end: a debug group was pushed and not popped");
    if (context->recording.active && context->recording.generation == generation) {
        rhw_queries_check_ended(encoder);
    }
    if (context->recording.active && context->recording.generation == generation) {
        rhw_feedback_check_ended(encoder);
    }
    if (!context->recording.active || context->recording.generation != generation) {
        // A hook of the program ended the pass itself.
        return RHW_ERROR_MISUSE;
    }
    if (context->validation) {
        rhw_validation_messages_clear(context->validation);
    }
    context->recording.active = false;
    bool misused = context->recording.misused;
    const enum rhw_result result = encoder->given_up ? RHW_ERROR_GIVEN_UP
                                   : encoder->out_of_memory
                                       ? RHW_ERROR_OUT_OF_MEMORY
                                       : rhw_executor_run(context->executor, encoder->pass, stats);
    if (result == RHW_OK) {
        rhw_queries_answer(encoder);
    }
    release_retired(context);
    misused |= atomic_load_explicit(&context->refused, memory_order_relaxed);
    if (context->validation && result == RHW_OK) {
        misused |= context->validation->kinds[RHW_VALIDATION_MISUSE].found;
        report_validation(encoder);
    }
    return result == RHW_OK && misused ? RHW_ERROR_MISUSE : result;
}

void rhw_pass_cancel(rhw_context *context, rhw_pass id)
{
    if (rhw_pass_enter(context, id, "rhw_pass_cancel")) {
        context->recording.active = false;
        release_retired(context);
        rhw_context_leave(context);
    }
}

enum rhw_result rhw_pass_end(rhw_context *context, rhw_pass id, struct rhw_stats *stats)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_end");
    if (!encoder) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = end(encoder, stats);
    rhw_context_leave(context);
    return result;
}
