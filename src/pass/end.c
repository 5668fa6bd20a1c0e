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
#include "pass_end.h"
#include "pipeline/pipeline.h"
#include "query.h"
#include "rhw/rhw.h"
#include "resource/texture.h"

void rhw_pass_release_retired(struct rhw_context *context)
{
    if (atomic_load(&context->open_recordings) > 0) {
        return;
    }
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

// Return where recording was when it came to a draw of the pass. The context has the label of the pass.
static struct rhw_recording_place place_of(const struct rhw_context *context,
                                           const struct rhw_recorded_pass *pass, uint32_t draw)
{
    struct rhw_recording_place place = context->recording;
    place.active = true;
    place.draw = draw;
    place.group = rhw_draw_list_at(&pass->draws, draw)->group;
    return place;
}

// Report what validation found while the pass ran.
static void report_validation(struct rhw_context *context, const struct rhw_recorded_pass *pass)
{
    const struct rhw_validation_message *const warning = &context->validation->kinds[RHW_VALIDATION_WARNING];
    const struct rhw_validation_message *const misuse = &context->validation->kinds[RHW_VALIDATION_MISUSE];
    if (warning->found) {
        const struct rhw_recording_place place = place_of(context, pass, warning->draw);
        rhw_context_warn_at(context, &place, warning->text);
    }
    if (misuse->found) {
        const struct rhw_recording_place place = place_of(context, pass, misuse->draw);
        rhw_misuse_at(context, &place, "%s", misuse->text);
    }
}

static void close_recording(struct rhw_context *context)
{
    context->recording.active = false;
    if (context->owner) {
        atomic_fetch_sub(&context->owner->open_recordings, 1);
    }
}

bool rhw_encoder_end(struct rhw_encoder *encoder, const char *where)
{
    rhw_context *const context = encoder->context;
    const uint32_t generation = context->recording.generation;
    (void)rhw_check(context, context->recording.group == NULL, "%s: a debug group was pushed and not popped",
                    where);
    if (context->recording.active && context->recording.generation == generation) {
        rhw_queries_check_ended(encoder, where);
    }
    if (context->recording.active && context->recording.generation == generation) {
        rhw_feedback_check_ended(encoder, where);
    }
    if (!context->recording.active || context->recording.generation != generation) {
        return false; // A hook of the program ended the pass itself, and may have begun another one.
    }
    close_recording(context);
    return true;
}

enum rhw_result rhw_recorded_pass_run(struct rhw_context *context, struct rhw_recorded_pass *pass,
                                      struct rhw_stats *stats)
{
    if (context->validation) {
        rhw_validation_messages_clear(context->validation);
    }
    const enum rhw_result result = rhw_executor_run(context->executor, pass, stats);
    if (result == RHW_OK) {
        rhw_queries_answer(context, pass);
    }
    return result;
}

enum rhw_result rhw_recorded_pass_tell(struct rhw_context *context, const struct rhw_recorded_pass *pass,
                                       enum rhw_result result)
{
    bool misused =
        context->recording.misused || atomic_load_explicit(&context->refused, memory_order_relaxed);
    if (context->validation && result == RHW_OK) {
        misused |= context->validation->kinds[RHW_VALIDATION_MISUSE].found;
        report_validation(context, pass);
    }
    return result == RHW_OK && misused ? RHW_ERROR_MISUSE : result;
}

static enum rhw_result end(struct rhw_encoder *encoder, struct rhw_stats *stats)
{
    static const char *const where = "rhw_pass_end";
    rhw_context *const context = encoder->context;
    if (!rhw_check(context, !context->owner,
                   "%s: the pass is of a recorder, which keeps what it records; call rhw_pass_keep", where) ||
        !rhw_encoder_end(encoder, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = encoder->given_up ? RHW_ERROR_GIVEN_UP
                                   : encoder->out_of_memory
                                       ? RHW_ERROR_OUT_OF_MEMORY
                                       : rhw_recorded_pass_run(context, encoder->pass, stats);
    // A hook of the program that is told something may not return.
    rhw_pass_release_retired(context);
    return rhw_recorded_pass_tell(context, encoder->pass, result);
}

void rhw_pass_cancel(rhw_context *context, rhw_pass id)
{
    if (rhw_pass_enter(context, id, "rhw_pass_cancel")) {
        close_recording(context);
        rhw_pass_release_retired(context);
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
