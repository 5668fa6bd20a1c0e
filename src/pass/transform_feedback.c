// SPDX-License-Identifier: MIT
// Transform feedback begins and ends here, and gives each draw between its place in the buffers.
#include "transform_feedback.h"

#include "resource/buffer.h"
#include "resource/buffer_access.h"
#include "context/context.h"
#include "draw/draw_list.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "encoder.h"
#include "memory_overlap.h"
#include "pipeline/pipeline.h"
#include "query.h"
#include "rhw/rhw.h"

static const char *const begin_name = "rhw_pass_begin_transform_feedback";

// Find the bytes of the program's memory that a target writes. Return false where it is misuse.
static bool find_memory(const struct rhw_encoder *encoder, const struct rhw_feedback_target *target, int i,
                        struct rhw_feedback_place *place)
{
    const struct rhw_context *const context = encoder->context;
    *place = (struct rhw_feedback_place){
        .bytes = target->memory, .first = target->offset, .end = target->offset + target->size};
    return rhw_check(context, target->buffer.index == 0,
                     "%s: targets[%d] has a buffer and memory; one of them must be null", begin_name, i) &&
           rhw_check(context, (uintptr_t)target->memory % 4 == 0 && target->offset % 4 == 0,
                     "%s: targets[%d] has memory %p and offset %zu; both must be multiples of 4", begin_name,
                     i, target->memory, target->offset) &&
           rhw_check(context, target->size != 0 && target->size <= SIZE_MAX - target->offset,
                     "%s: targets[%d] has size %zu; it must be the bytes that memory has from offset %zu on",
                     begin_name, i, target->size, target->offset);
}

// Find the bytes of a buffer that a target writes. Return false where it is misuse.
static bool find_part(const struct rhw_encoder *encoder, const struct rhw_feedback_target *target, int i,
                      struct rhw_buffer_part *part)
{
    const struct rhw_context *const context = encoder->context;
    struct rhw_buffer_data *const buffer = rhw_context_buffer(context, target->buffer, begin_name);
    if (!buffer ||
        !rhw_check(context,
                   target->offset % 4 == 0 && target->offset <= buffer->size &&
                       target->size <= buffer->size - target->offset,
                   "%s: targets[%d] has offset %zu and size %zu; the offset must be a multiple of 4, and "
                   "together they must stay within the %zu bytes of %s",
                   begin_name, i, target->offset, target->size, buffer->size,
                   rhw_name_of(&context->buffers, target->buffer.index).text)) {
        return false;
    }
    const size_t end = target->size == 0 ? buffer->size : target->offset + target->size;
    *part = (struct rhw_buffer_part){target->buffer, buffer, RHW_BUFFER_CAPTURED, target->offset, end};
    return rhw_buffer_check_unmapped(context, part, begin_name) &&
           rhw_buffer_check_use(context, part, begin_name);
}

// Check that the last part shares no bytes with the parts before it. Parts without data are of no target.
static bool check_apart(const struct rhw_encoder *encoder, const struct rhw_buffer_part *parts, int last)
{
    for (int i = 0; i < last; i++) {
        if (parts[i].data == parts[last].data &&
            !rhw_buffer_check_apart(encoder->context, &parts[last], RHW_BUFFER_CAPTURED, parts[i].first,
                                    parts[i].end, begin_name)) {
            return false;
        }
    }
    return true;
}

// Find what target i writes, and the part of its buffer where it is one. Return false where it is misuse.
static bool find_place(struct rhw_encoder *encoder, const struct rhw_feedback_target *targets, int i,
                       struct rhw_buffer_part *parts, struct rhw_feedback_place *place)
{
    if (targets[i].memory) {
        return find_memory(encoder, &targets[i], i, place);
    }
    if (!find_part(encoder, &targets[i], i, &parts[i]) || !check_apart(encoder, parts, i)) {
        return false;
    }
    *place = (struct rhw_feedback_place){
        .bytes = parts[i].data->bytes, .first = parts[i].first, .end = parts[i].end, .data = parts[i].data};
    return true;
}

// Give up what was noted of places. None of their bytes was written.
static void forget(struct rhw_encoder *encoder, const struct rhw_feedback_place *places)
{
    for (int i = 0; i < RHW_MAX_FEEDBACK_TARGETS; i++) {
        if (places[i].memory_range) {
            rhw_range_set_shorten(&encoder->memory.captured, places[i].memory_range,
                                  places[i].memory_range->first);
        }
    }
}

// Find the places of all targets that are written. Return false where one of them is misuse.
static bool find_places(struct rhw_encoder *encoder, const struct rhw_feedback_target *targets,
                        struct rhw_buffer_part *parts, struct rhw_feedback_place *places)
{
    const unsigned written = encoder->pending.pipeline->feedback_targets;
    for (int i = 0; i < RHW_MAX_FEEDBACK_TARGETS; i++) {
        struct rhw_feedback_place *const place = &places[i];
        if (written >> i & 1 &&
            (!find_place(encoder, targets, i, parts, place) ||
             !rhw_memory_note_captured(&encoder->memory, place->bytes + place->first,
                                       place->end - place->first, begin_name, &place->memory_range))) {
            forget(encoder, places);
            return false;
        }
    }
    return true;
}

static void begin_target(struct rhw_encoder *encoder, const struct rhw_buffer_part *part,
                         struct rhw_feedback_place *place)
{
    if (part->data) {
        place->range = rhw_buffer_note_use(encoder->context, &encoder->pass->arena, part);
        encoder->out_of_memory |= !place->range;
    }
    place->at = place->first;
}

static int vertices_of(const struct rhw_pipeline_def *def)
{
    switch (def->topology) {
    case RHW_POINT_LIST: return 1;
    case RHW_LINE_LIST:
    case RHW_LINE_STRIP:
    case RHW_LINE_LIST_ADJACENCY:
    case RHW_LINE_STRIP_ADJACENCY:
    case RHW_LINE_LOOP: return 2;
    default: return 3;
    }
}

static bool check_begin(const struct rhw_encoder *encoder, const struct rhw_feedback_target *targets,
                        int count)
{
    const struct rhw_context *const context = encoder->context;
    const struct rhw_pipeline_data *const pipeline = encoder->pending.pipeline;
    if (!rhw_check(context, !encoder->feedback.is_active, "%s: it is under way; end it first", begin_name) ||
        !rhw_check(context, pipeline && pipeline->feedback_targets != 0,
                   "%s: %s; one with feedback_outputs must be", begin_name,
                   pipeline ? "the pipeline that is set has no outputs" : "no pipeline is set") ||
        !rhw_check(context, targets != NULL && count >= 1 && count <= RHW_MAX_FEEDBACK_TARGETS,
                   "%s: count is %d and targets is %s; 1..%d are asked for", begin_name, count,
                   targets ? "set" : "NULL", RHW_MAX_FEEDBACK_TARGETS)) {
        return false;
    }
    for (int i = 0; i < RHW_MAX_FEEDBACK_TARGETS; i++) {
        const bool is_written = pipeline->feedback_targets >> i & 1;
        if (!rhw_check(context, !is_written || i < count,
                       "%s: count is %d; the pipeline that is set writes target %d", begin_name, count, i)) {
            return false;
        }
    }
    return true;
}

static void begin(struct rhw_encoder *encoder, const struct rhw_feedback_target *targets, int count)
{
    struct rhw_feedback_state *const feedback = &encoder->feedback;
    if (encoder->out_of_memory || !check_begin(encoder, targets, count)) {
        return;
    }
    struct rhw_buffer_part parts[RHW_MAX_FEEDBACK_TARGETS] = {{.data = NULL}};
    struct rhw_feedback_place places[RHW_MAX_FEEDBACK_TARGETS] = {{.bytes = NULL}};
    if (!find_places(encoder, targets, parts, places)) {
        return;
    }
    for (int i = 0; i < RHW_MAX_FEEDBACK_TARGETS; i++) {
        begin_target(encoder, &parts[i], &places[i]);
        feedback->targets[i] = places[i];
    }
    if (encoder->out_of_memory) {
        return;
    }
    feedback->vertices = vertices_of(&encoder->pending.pipeline->def);
    feedback->is_active = true;
}

void rhw_pass_begin_transform_feedback(rhw_context *context, rhw_pass id,
                                       const struct rhw_feedback_target *targets, int count)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, begin_name);
    if (encoder) {
        begin(encoder, targets, count);
        rhw_context_leave(context);
    }
}

// Give back the bytes of a target that no draw writes. Return how many were written.
static size_t end_target(struct rhw_encoder *encoder, const struct rhw_feedback_place *place)
{
    if (place->range) {
        rhw_range_set_shorten(rhw_buffer_ranges(encoder->context, place->data, RHW_BUFFER_CAPTURED),
                              place->range, place->at);
    }
    if (place->memory_range) {
        rhw_range_set_shorten(&encoder->memory.captured, place->memory_range,
                              (size_t)(uintptr_t)(place->bytes + place->at));
    }
    return place->at - place->first;
}

void rhw_pass_end_transform_feedback(rhw_context *context, rhw_pass id, size_t *written)
{
    static const char *const where = "rhw_pass_end_transform_feedback";
    for (int i = 0; written && i < RHW_MAX_FEEDBACK_TARGETS; i++) {
        written[i] = 0;
    }
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    struct rhw_feedback_state *const feedback = &encoder->feedback;
    if (encoder->out_of_memory ||
        rhw_check(context, feedback->is_active, "%s: it is not under way; begin it first", where)) {
        for (int i = 0; feedback->is_active && i < RHW_MAX_FEEDBACK_TARGETS; i++) {
            const size_t size = feedback->targets[i].bytes ? end_target(encoder, &feedback->targets[i]) : 0;
            if (written) {
                written[i] = size;
            }
        }
        feedback->is_active = false;
    }
    rhw_context_leave(context);
}

// Return how many whole primitives fit into what is left of every target.
static uint64_t room_of(const struct rhw_feedback_state *feedback, const struct rhw_pipeline_data *pipeline)
{
    uint64_t most = UINT64_MAX;
    for (int i = 0; i < RHW_MAX_FEEDBACK_TARGETS; i++) {
        const struct rhw_feedback_place *const place = &feedback->targets[i];
        if (place->bytes) {
            const uint64_t size = (uint64_t)pipeline->def.feedback_strides[i] * (uint64_t)feedback->vertices;
            const uint64_t room = (place->end - place->at) / size;
            most = room < most ? room : most;
        }
    }
    return most;
}

bool rhw_feedback_add_draw(struct rhw_encoder *encoder, struct rhw_draw *draw)
{
    struct rhw_feedback_state *const feedback = &encoder->feedback;
    const struct rhw_pipeline_data *const pipeline = draw->state->pipeline;
    struct rhw_draw_feedback *const made =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *made, _Alignof(struct rhw_draw_feedback));
    if (!made) {
        return false;
    }
    const uint64_t needed = (uint64_t)draw->triangles_per_instance * draw->instances;
    const uint64_t room = room_of(feedback, pipeline);
    *made = (struct rhw_draw_feedback){.primitives = needed < room ? needed : room,
                                       .vertices = feedback->vertices};
    for (int i = 0; i < RHW_MAX_FEEDBACK_TARGETS; i++) {
        struct rhw_feedback_place *const place = &feedback->targets[i];
        if (place->bytes) {
            const uint64_t size = (uint64_t)pipeline->def.feedback_strides[i] * (uint64_t)feedback->vertices;
            made->to[i] = place->bytes + place->at;
            place->at += (size_t)(made->primitives * size);
        }
    }
    draw->feedback = made;
    encoder->pass->has_feedback = true;
    rhw_queries_count_feedback(draw, made->primitives, needed);
    return true;
}

void rhw_feedback_check_ended(const struct rhw_encoder *encoder, const char *where)
{
    (void)rhw_check(encoder->context, encoder->out_of_memory || !encoder->feedback.is_active,
                    "%s: transform feedback was begun and not ended", where);
}
