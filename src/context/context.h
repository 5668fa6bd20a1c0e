// SPDX-License-Identifier: MIT
// The context: everything that a user of the library owns hangs from it. It keeps copies of the hooks, the pools of
// resources, the kernels that were picked, the worker threads and the pass under way. There is no global state, so that
// contexts on different threads never meet.
//
// This file has its data alone: context_create.c knows all parts, and every part may know the context.
#ifndef RHW_CONTEXT_H
#define RHW_CONTEXT_H

#include <stdatomic.h>

#include "base/memory.h"
#include "pool.h"
#include "rhw/types.h"

struct rhw_buffer_part;
struct rhw_validation_messages;
struct rhw_encoder;
struct rhw_executor;
struct rhw_kernels;
struct rhw_pipeline_data;
struct rhw_recording;
struct rhw_use_table;
struct rhw_recorded_pass;
struct rhw_scheduler;
struct rhw_shared_texels;

// A debug group of the pass being recorded.
struct rhw_debug_group {
    const struct rhw_debug_group *outer; // NULL: this group is the outermost one
    char label[RHW_LABEL_SIZE];
};

// The place where recording is, for messages.
struct rhw_recording_place {
    bool active;         // between the beginning of a pass and its end
    bool misused;        // misuse was reported since the beginning
    bool dispatches;     // a dispatch sets what it uses, as a pass of its own
    uint32_t generation; // number of the pass or dispatch under way or, when there is none, of the last one
    uint32_t draw;       // number of the next draw
    uint32_t rewrites;   // times that the program rewrote what the pass uses
    const struct rhw_debug_group *group; // the innermost one, or NULL
    char label[RHW_LABEL_SIZE];          // label of the pass
};

// Return true while a pass is recorded, or while a dispatch sets what it uses.
static inline bool rhw_recording_is_open(const struct rhw_recording_place *recording)
{
    return recording->active || recording->dispatches;
}

// Begin a pass, a dispatch, or a run of a recording.
static inline void rhw_recording_next(struct rhw_recording_place *recording)
{
    if (++recording->generation == 0) {
        recording->generation = 1; // 0: no pass has used an item yet
    }
}

// Return what messages call that which uses things: "pass" or "dispatch".
static inline const char *rhw_recording_noun(const struct rhw_recording_place *recording)
{
    return recording->dispatches ? "dispatch" : "pass";
}

// Shared texels that bindings sample and that were written: see resource/bound_texels.h.
struct rhw_bound_texels {
    struct rhw_shared_texels *stale; // a list by next_stale
};

struct rhw_context {
    struct rhw_memory memory;
    rhw_log_function *log;        // may be NULL
    rhw_assert_function *assert_; // NULL: misuse takes the default hook
    void *user;
    char label[RHW_LABEL_SIZE];

    uint32_t number; // every id carries it, but those of passes; see context_create.c
    // Ids of passes carry this number. A recorder has another one than its owner and than its other recorders.
    uint32_t pass_number;
    _Atomic uint32_t recorders_made; // how many recorders this context has had
    // The public function that is at work, or `idle` when there is none. Every thread that calls one writes it.
    _Atomic(const char *) entered;
    // NULL; or the mark of a recorder, which functions other than those of passes do not enter.
    const char *idle;
    // A recorder records passes for this context, and has the parts of it that recording looks at. NULL: the context is
    // no recorder.
    struct rhw_context *owner;
    _Atomic int recorders; // number of recorders of this context
    // Number of passes that recorders of this context record. As long as there is one, memory that was replaced stays,
    // because the pass may look at it.
    _Atomic int open_recordings;
    // What the pass being recorded uses, where the context is a recorder. NULL: things note it themselves.
    struct rhw_use_table *uses;
    struct rhw_recording *next_recording; // what a recorder records into
    // The label of the definition that the public function was given, or NULL where there is none. It is the caller's
    // memory. The thread that is inside sets it.
    const char *definition;
    // Another thread, or a shader function, was refused since the pass began.
    _Atomic bool refused;

    // What rhw_cpu_cores gives. A context with one thread does not ask, and has 1.
    int cores;
    int threads; // number of threads, the caller's included
    enum rhw_isa isa;
    enum rhw_paths paths;
    size_t bin_memory; // what the definition gave; 0: the pass chooses
    const struct rhw_kernels *kernels;
    struct rhw_scheduler *scheduler;

    struct rhw_pool buffers;   // struct rhw_buffer_data
    struct rhw_pool textures;  // struct rhw_texture_data *
    struct rhw_pool samplers;  // struct rhw_sampler_data
    struct rhw_pool pipelines; // struct rhw_pipeline_data
    struct rhw_pool queries;   // struct rhw_query_data

    // These are made with the context and serve every pass: what records it, what was recorded, and what runs it.
    struct rhw_encoder *encoder;
    struct rhw_recorded_pass *pass;
    struct rhw_executor *executor;
    struct rhw_recording_place recording;
    struct rhw_bound_texels bound_texels;
    // What validation found in the pass. NULL: nothing is validated.
    struct rhw_validation_messages *validation;
    // Put a validator before the functions of a new pipeline. Return false when out of memory. NULL where nothing is
    // validated.
    bool (*validate_pipeline)(struct rhw_context *context, struct rhw_pipeline_data *pipeline,
                              const char *name);

    // Copy what recorded draws read of a part of a live buffer as vertices and indices, and let them read the copies,
    // so that the part can be written. Return false when out of memory.
    bool (*keep_reads)(struct rhw_context *context, const struct rhw_buffer_part *part);

    // It is asked while a pass runs or mip levels are made. NULL: nobody is asked.
    bool (*goes_on)(void *user);
    void *goes_on_user;
    // Worker 0 writes these within tasks (given_up.h): when the program was last asked, when the clock was last looked
    // at, how many groups lie between two looks, and how many are left until the next.
    uint64_t asked_ns, looked_ns;
    int look_groups, groups_to_look;
    // The pass that runs, or the making of mip levels, was given up. The thread that called the library writes it.
    _Atomic bool given_up;
};

#endif
