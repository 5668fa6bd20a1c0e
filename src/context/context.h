// SPDX-License-Identifier: MIT
// The context: everything a user of the library owns hangs from it. It keeps copies of the hooks, the pools of
// resources, the kernels that were picked, the worker threads and the pass under way. There is no global state, so that
// contexts on different threads never meet.
//
// This is its data alone: context_create.c knows all parts, and every part may know the context.
#ifndef RHW_CONTEXT_H
#define RHW_CONTEXT_H

#include <stdatomic.h>

#include "base/memory.h"
#include "pool.h"
#include "rhw/types.h"

struct rhw_validation_messages;
struct rhw_encoder;
struct rhw_executor;
struct rhw_kernels;
struct rhw_pipeline_data;
struct rhw_recorded_pass;
struct rhw_scheduler;

// A debug group of the pass being recorded.
struct rhw_debug_group {
    const struct rhw_debug_group *outer; // NULL: the outermost one
    char label[RHW_LABEL_SIZE];
};

// Where recording is, for messages.
struct rhw_recording {
    bool active;                         // between the beginning of a pass and its end
    bool misused;                        // misuse was reported since the beginning
    uint32_t generation;                 // of the pass under way or, when there is none, of the last one
    uint32_t draw;                       // the next one's number
    uint32_t rewrites;                   // times that something was written which the pass uses
    const struct rhw_debug_group *group; // the innermost one, or NULL
    char label[RHW_LABEL_SIZE];          // of the pass
};

struct rhw_context {
    struct rhw_memory memory;
    rhw_log_function *log;        // may be NULL
    rhw_assert_function *assert_; // NULL: see rhw_misuse
    void *user;
    char label[RHW_LABEL_SIZE];

    uint32_t number; // ids carry it; see context_create.c
    // The public function that is at work, NULL when there is none. Written by every thread that calls one.
    _Atomic(const char *) entered;
    // The label of the definition that it was given, the caller's; NULL where there is none. Set by the thread that is
    // inside.
    const char *definition;
    _Atomic bool refused; // another thread, or a shader function, was refused since the pass began

    int cores;   // see rhw_cpu_cores; 1, without asking, with one thread
    int threads; // the caller's included
    enum rhw_isa isa;
    enum rhw_paths paths;
    size_t bin_memory; // as the definition gave it; 0: the pass chooses
    const struct rhw_kernels *kernels;
    struct rhw_scheduler *scheduler;

    struct rhw_pool buffers;   // struct rhw_buffer_data
    struct rhw_pool textures;  // struct rhw_texture_data *
    struct rhw_pool samplers;  // struct rhw_sampler_data
    struct rhw_pool pipelines; // struct rhw_pipeline_data
    struct rhw_pool queries;   // struct rhw_query_data

    // Created with the context, and used by every pass: what records it, what it is then, and what runs it.
    struct rhw_encoder *encoder;
    struct rhw_recorded_pass *pass;
    struct rhw_executor *executor;
    struct rhw_recording recording;
    struct rhw_validation_messages *validation; // what validation found in the pass; NULL: nothing is validated
    // Puts a validator before the functions of a new pipeline; NULL: nothing is validated. False when out of memory.
    bool (*validate_pipeline)(struct rhw_context *context, struct rhw_pipeline_data *pipeline,
                              const char *name);

    bool (*goes_on)(void *user); // asked while a pass runs; NULL: nobody is
    void *goes_on_user;
    _Atomic bool given_up; // the pass that runs. Written by the thread that ends it
};

#endif
