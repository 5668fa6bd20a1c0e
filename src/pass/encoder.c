// SPDX-License-Identifier: MIT
// An encoder is created and destroyed here, with its context. Other files of this room change it.
#include "encoder.h"

#include <string.h>

#include "context/context.h"
#include "context/misuse.h"

struct rhw_encoder *rhw_encoder_create(struct rhw_context *context, struct rhw_recorded_pass *pass)
{
    struct rhw_encoder *const encoder =
        rhw_memory_allocate(&context->memory, sizeof *encoder, RHW_CACHE_LINE);
    if (encoder) {
        memset(encoder, 0, sizeof *encoder);
        encoder->context = context;
        encoder->pass = pass;
    }
    return encoder;
}

void rhw_encoder_destroy(struct rhw_encoder *encoder)
{
    if (encoder) {
        rhw_memory_release(&encoder->context->memory, encoder, sizeof *encoder);
    }
}

void rhw_encoder_renew(struct rhw_encoder *encoder)
{
    struct rhw_recording_place *const recording = &encoder->context->recording;
    struct rhw_target *const target = &encoder->pass->target;
    rhw_recorded_pass_clear(encoder->pass);
    encoder->pass->paths = encoder->context->paths;
    target->color_count = 0;
    target->has_depth = target->has_stencil = false;
    target->depth = target->stencil = (struct rhw_attachment){.target = NULL};
    encoder->read = NULL;
    encoder->stored = NULL;
    encoder->uses = (struct rhw_use_table){0};
    encoder->clean_parts = NULL;
    encoder->out_of_memory = false;
    encoder->given_up = false;
    encoder->memory = (struct rhw_used_memory){
        .context = encoder->context, .pass = encoder->pass, .out_of_memory = &encoder->out_of_memory};
    memset(&encoder->bound, 0, sizeof encoder->bound);
    encoder->slots.kernels = encoder->context->kernels;
    encoder->slots.asked = encoder->context->owner ? encoder->context->owner : encoder->context;
    encoder->slots.slot_count = 0;
    encoder->bindings_changed = encoder->storage_changed = true;
    rhw_recording_next(recording);
}

void rhw_pass_report(const rhw_context *context, rhw_pass id, const char *where)
{
    const bool foreign = id.index != 0 && id.context != context->pass_number;
    rhw_misuse(context, "%s: %s", where,
               foreign ? "the pass belongs to another context" : "the pass id is null or its pass has ended");
}
