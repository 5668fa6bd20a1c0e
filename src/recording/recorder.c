// SPDX-License-Identifier: MIT
// A recorder has of its owner what recording looks at: hooks, kernels and views of the pools. It never runs anything.
#include "recorder.h"

#include <assert.h>

#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "pass/encoder.h"
#include "recording.h"

// It stands in `entered` of a recorder that no function is in.
static const char idle[] = "a recorder";

// Return a number for the passes of a new recorder. Those of one owner differ, as an odd step makes them.
static uint32_t pass_number_of(struct rhw_context *owner)
{
    static const uint32_t step = 0x9e3779b9;
    return owner->number + step * (atomic_fetch_add(&owner->recorders_made, 1) + 1);
}

static struct rhw_context recorder_of(struct rhw_context *owner)
{
    const struct rhw_allocator allocator = owner->memory.allocator;
    struct rhw_context recorder = {.memory = {.allocator = allocator},
                                   .log = owner->log,
                                   .assert_ = owner->assert_,
                                   .user = owner->user,
                                   .number = owner->number,
                                   .pass_number = pass_number_of(owner),
                                   .entered = idle,
                                   .idle = idle,
                                   .owner = owner,
                                   .cores = owner->cores,
                                   .threads = owner->threads,
                                   .isa = owner->isa,
                                   .paths = owner->paths,
                                   .kernels = owner->kernels,
                                   .scheduler = owner->scheduler,
                                   .validation = owner->validation};
    rhw_label_copy(recorder.label, owner->label);
    return recorder;
}

static enum rhw_result create(struct rhw_context *owner, struct rhw_context **recorder)
{
    struct rhw_memory memory = {.allocator = owner->memory.allocator};
    struct rhw_context *const created =
        rhw_memory_allocate(&memory, sizeof *created, _Alignof(struct rhw_context));
    if (!created) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *created = recorder_of(owner);
    created->memory.used = memory.used;
    atomic_fetch_add(&owner->recorders, 1);
    rhw_recorder_look_at_pools(created);
    created->next_recording = rhw_recording_create(memory.allocator, owner->number);
    created->pass = created->next_recording ? created->next_recording->pass : NULL;
    created->encoder = created->pass ? rhw_encoder_create(created, created->pass) : NULL;
    if (!created->encoder) {
        rhw_recorder_destroy(created);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    created->uses = &created->encoder->uses;
    *recorder = created;
    return RHW_OK;
}

enum rhw_result rhw_recorder_create(rhw_context *context, rhw_context **recorder)
{
    static const char *const where = "rhw_recorder_create";
    if (recorder) {
        *recorder = NULL;
    }
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = rhw_check(context, recorder != NULL, "%s: recorder is NULL", where)
                                       ? create(context, recorder)
                                       : RHW_ERROR_MISUSE;
    rhw_context_leave(context);
    return result;
}

void rhw_recorder_destroy(struct rhw_context *recorder)
{
    rhw_encoder_destroy(recorder->encoder);
    rhw_recording_destroy(recorder->next_recording);
    atomic_fetch_sub(&recorder->owner->recorders, 1);
    struct rhw_memory memory = {.allocator = recorder->memory.allocator, .used = recorder->memory.used};
    rhw_memory_release(&memory, recorder, sizeof *recorder);
    assert(memory.used == 0);
}
