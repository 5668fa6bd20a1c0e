// SPDX-License-Identifier: MIT
// A pass is kept, run and released here.
#include "recording.h"

#include <assert.h>
#include <string.h>

#include "base/thread.h"
#include "binding/validation/validation.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "pass/attached_texture.h"
#include "pass/encoder.h"
#include "pass/pass_end.h"
#include "pass/query.h"
#include "resource/buffer.h"
#include "resource/buffer_access.h"
#include "resource/shared_texels.h"
#include "resource/srgb_texture.h"
#include "resource/texture.h"
#include "run/kept_triangles.h"

struct rhw_recording *rhw_recording_create(struct rhw_allocator allocator, uint32_t number)
{
    struct rhw_memory memory = {.allocator = allocator};
    struct rhw_recording *const created =
        rhw_memory_allocate(&memory, sizeof *created, _Alignof(struct rhw_recording));
    if (!created) {
        return NULL;
    }
    memset(created, 0, sizeof *created);
    created->memory.allocator = allocator;
    created->memory.used = memory.used;
    created->number = number;
    created->pass = rhw_recorded_pass_create(&created->memory);
    if (!created->pass) {
        rhw_recording_destroy(created);
        return NULL;
    }
    return created;
}

void rhw_recording_destroy(rhw_recording *recording)
{
    if (!recording) {
        return;
    }
    rhw_kept_triangles_destroy(recording->kept);
    rhw_recorded_pass_destroy(&recording->memory, recording->pass);
    struct rhw_memory memory = {.allocator = recording->memory.allocator, .used = recording->memory.used};
    rhw_memory_release(&memory, recording, sizeof *recording);
    assert(memory.used == 0);
}

// Keeping -----------------------------------------------------------------------------------------------

// Return true if the triangles of a pass may be those of an earlier run.
static bool may_keep_triangles(const struct rhw_context *recorder, const struct rhw_recorded_pass *pass)
{
    return !recorder->validation && !pass->shades_first && !pass->has_feedback;
}

// Take what the recorder has recorded, and give it another recording to record into. Return NULL when out of memory.
static struct rhw_recording *take(struct rhw_encoder *encoder, const struct rhw_recording_def *def)
{
    struct rhw_context *const recorder = encoder->context;
    struct rhw_recording *const kept = recorder->next_recording;
    struct rhw_recording *const next = rhw_recording_create(recorder->memory.allocator, recorder->number);
    if (!next) {
        return NULL;
    }
    if (def && def->keeps_triangles && may_keep_triangles(recorder, kept->pass)) {
        kept->kept = kept->pass->kept = rhw_kept_triangles_create(&kept->memory, recorder->threads);
        if (!kept->kept) {
            rhw_recording_destroy(next);
            return NULL;
        }
    }
    recorder->next_recording = next;
    recorder->pass = encoder->pass = next->pass;
    kept->uses = encoder->uses;
    kept->clean_parts = encoder->clean_parts;
    encoder->uses = (struct rhw_use_table){0};
    encoder->clean_parts = NULL;
    rhw_label_copy(kept->label, def && def->label ? def->label : recorder->recording.label);
    rhw_queries_keep(kept->pass);
    return kept;
}

static enum rhw_result keep(struct rhw_encoder *encoder, const struct rhw_recording_def *def,
                            rhw_recording **recording, const char *where)
{
    struct rhw_context *const recorder = encoder->context;
    if (!rhw_check(
            recorder, recorder->owner,
            "%s: the context is no recorder; record in one of rhw_recorder_create, or call rhw_pass_end",
            where)) {
        return RHW_ERROR_MISUSE;
    }
    const bool is_good = rhw_check(recorder, recording != NULL, "%s: recording is NULL", where);
    if (!rhw_encoder_end(encoder, where) || !is_good || recorder->recording.misused ||
        atomic_load_explicit(&recorder->refused, memory_order_relaxed)) {
        return RHW_ERROR_MISUSE;
    }
    *recording = encoder->out_of_memory ? NULL : take(encoder, def);
    return *recording ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
}

enum rhw_result rhw_pass_keep(rhw_context *recorder, rhw_pass pass, const struct rhw_recording_def *def,
                              rhw_recording **recording)
{
    static const char *const where = "rhw_pass_keep";
    if (recording) {
        *recording = NULL;
    }
    struct rhw_encoder *const encoder = rhw_pass_enter(recorder, pass, where);
    if (!encoder) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = keep(encoder, def, recording, where);
    rhw_context_leave(recorder);
    return result;
}

// Running -----------------------------------------------------------------------------------------------

static const char *const run_name = "rhw_recording_run";

static bool check_buffer(const struct rhw_context *context, const struct rhw_use *use,
                         struct rhw_buffer_data *data)
{
    const rhw_buffer id = {use->index, use->generation, context->number};
    for (int i = 0; data->is_mapped && i < RHW_BUFFER_USES; i++) {
        const struct rhw_range *const range =
            rhw_range_set_find(&use->used[i], data->map_first, data->map_end);
        const enum rhw_buffer_use kind = (enum rhw_buffer_use)i;
        if (range &&
            !rhw_buffer_check_unmapped(
                context, &(struct rhw_buffer_part){id, data, kind, range->first, range->end}, run_name)) {
            return false;
        }
    }
    return true;
}

// Check that an item that the recording uses lives, and is where it was.
static bool check_use(const struct rhw_context *context, const struct rhw_use *use)
{
    void *const item = rhw_context_item(context, use->pool, use->index, use->generation, run_name);
    if (!item) {
        return false;
    }
    struct rhw_buffer_data *const buffer = use->pool == &context->buffers ? item : NULL;
    const struct rhw_texture_data *const texture =
        use->pool == &context->textures ? *(struct rhw_texture_data **)item : NULL;
    const uint32_t moves = buffer ? buffer->moves : texture ? texture->moves : 0;
    return rhw_check(
               context, moves == use->moves,
               "%s: %s was written between draws of a pass that read it, and has other memory since it was "
               "recorded; record the pass again",
               run_name, rhw_name_of(use->pool, use->index).text) &&
           (!buffer || check_buffer(context, use, buffer));
}

static bool check_uses(const struct rhw_context *context, const struct rhw_use_table *uses)
{
    for (uint32_t i = 0; i < uses->places; i++) {
        if (uses->uses[i].item && !check_use(context, &uses->uses[i])) {
            return false;
        }
    }
    return true;
}

// Note in a texture what the pass does with it, as recording does where a pass is not kept. Return
// RHW_ERROR_OUT_OF_MEMORY, or RHW_ERROR_GIVEN_UP, where what it is sampled by could not be made.
static enum rhw_result note_texture(struct rhw_context *context, const struct rhw_use *use,
                                    struct rhw_texture_data *texture)
{
    const uint32_t generation = context->recording.generation;
    if (use->stored_levels != 0) {
        rhw_texture_note_attached(texture, generation);
        rhw_texture_note_written(texture);
        texture->written |= use->stored_levels;
    }
    if (!use->is_sampled) {
        return RHW_OK;
    }
    rhw_texture_note_sampled(texture, generation);
    return texture->samples > 1 ? RHW_OK : rhw_texture_linearize(context, texture);
}

// Note in all textures what the pass does with them.
static enum rhw_result note_uses(struct rhw_context *context, const struct rhw_recording *recording)
{
    const struct rhw_use_table *const uses = &recording->uses;
    enum rhw_result result = RHW_OK;
    for (const struct rhw_clean_part *part = recording->clean_parts; part; part = part->next) {
        if (!rhw_attached_part_take(context, &recording->pass->target, *part->texture, part->part,
                                    part->clean)) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
    }
    for (uint32_t i = 0; result == RHW_OK && i < uses->places; i++) {
        const struct rhw_use *const use = &uses->uses[i];
        if (use->item && use->pool == &context->textures) {
            result = note_texture(context, use, *(struct rhw_texture_data *const *)use->item);
        }
    }
    return result;
}

// Note that a run writes the buffers that the recording writes. Return how often those that it reads may have been
// written.
static uint64_t note_and_count_writes(const struct rhw_context *context,
                                      const struct rhw_recording *recording)
{
    uint64_t writes = 0;
    for (uint32_t i = 0; i < recording->uses.places; i++) {
        const struct rhw_use *const use = &recording->uses.uses[i];
        if (!use->item || use->pool != &context->buffers) {
            continue;
        }
        struct rhw_buffer_data *const buffer = rhw_pool_item(&context->buffers, use->index);
        buffer->writes +=
            buffer->has_stores || use->used[RHW_BUFFER_STORED].root || use->used[RHW_BUFFER_CAPTURED].root;
        writes += use->used[RHW_BUFFER_READ].root ? buffer->writes : 0;
    }
    return writes;
}

// Have the triangles made anew where buffers have been written since they were made.
static void look_for_writes(const struct rhw_context *context, struct rhw_recording *recording)
{
    const uint64_t writes = note_and_count_writes(context, recording);
    if (recording->kept) {
        recording->kept->is_made &= writes == recording->writes;
    }
    recording->writes = writes;
}

// Under validation uniforms are copied when they are recorded. Copy those of the program's memory anew.
static void renew_uniforms(const struct rhw_recorded_pass *pass)
{
    for (uint32_t i = 0; i < pass->draws.count; i++) {
        const struct rhw_draw *const draw = rhw_draw_list_at(&pass->draws, i);
        if (draw->state->pipeline->validator) {
            rhw_validated_uniforms_renew(draw->uniforms);
        }
    }
}

// Run a recording whose uses were checked.
static enum rhw_result run_checked(struct rhw_context *context, struct rhw_recording *recording,
                                   struct rhw_stats *stats)
{
    struct rhw_recorded_pass *const pass = recording->pass;
    rhw_recording_next(&context->recording);
    rhw_label_copy(context->recording.label, recording->label);
    context->recording.misused = false;
    atomic_store_explicit(&context->refused, false, memory_order_relaxed);
    pass->begun_ns = rhw_time_ns();
    const enum rhw_result noted = note_uses(context, recording);
    if (noted != RHW_OK) {
        return noted;
    }
    look_for_writes(context, recording);
    if (context->validation) {
        renew_uniforms(pass);
    }
    rhw_queries_begin(context, pass);
    rhw_pass_empty_reports(pass);
    return rhw_recorded_pass_tell(context, pass, rhw_recorded_pass_run(context, pass, stats));
}

static enum rhw_result run(struct rhw_context *context, struct rhw_recording *recording,
                           struct rhw_stats *stats)
{
    if (!rhw_check(context, recording != NULL, "%s: recording is NULL", run_name) ||
        !rhw_check(context, recording->number == context->number,
                   "%s: the recording belongs to another context", run_name) ||
        !rhw_check(context, !context->recording.active, "%s: a pass is being recorded; end it first",
                   run_name) ||
        !check_uses(context, &recording->uses)) {
        return RHW_ERROR_MISUSE;
    }
    return run_checked(context, recording, stats);
}

void rhw_recording_changed(rhw_recording *recording)
{
    if (rhw_check(NULL, recording != NULL, "rhw_recording_changed: recording is NULL") && recording->kept) {
        recording->kept->is_made = false;
    }
}

enum rhw_result rhw_recording_run(rhw_context *context, rhw_recording *recording, struct rhw_stats *stats)
{
    if (!rhw_context_enter(context, run_name)) {
        return RHW_ERROR_MISUSE;
    }
    context->definition = recording ? recording->label : NULL;
    const enum rhw_result result = run(context, recording, stats);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}
