// SPDX-License-Identifier: MIT
// The context: everything a user of the library owns hangs from it. It keeps copies of the hooks, counts
// memory, picks the kernels, and holds the pools of resources, the worker threads and the pass under way.
// There is no global state, so that contexts on different threads never meet.
#ifndef RHW_CONTEXT_H
#define RHW_CONTEXT_H

#include <stdatomic.h>

#include "resource.h"
#include "rhw/rhw.h"
#include "texture.h"

struct rhw_kernels;
struct rhw_pass_state;
struct rhw_scheduler;
struct rhw_buffer_data;
struct rhw_sampler_data;
struct rhw_pipeline_data;

struct rhw_context {
    struct rhw_allocator allocator; // never NULL inside
    rhw_log_function *log;          // may be NULL
    rhw_assert_function *assert_;   // never NULL
    void *user;

    // Bytes; written by every thread that allocates, which happens when an arena grows, not per draw.
    _Atomic size_t memory_used, memory_peak;

    int cores;   // see rhw_cpu_cores; 1, without asking, with one thread
    int threads; // the caller's included
    enum rhw_isa isa;
    size_t bin_memory; // as the definition gave it; 0: the pass chooses
    const struct rhw_kernels *kernels;
    struct rhw_scheduler *scheduler;

    struct rhw_pool buffers;   // struct rhw_buffer_data
    struct rhw_pool textures;  // struct rhw_texture_data
    struct rhw_pool samplers;  // struct rhw_sampler_data
    struct rhw_pool pipelines; // struct rhw_pipeline_data

    struct rhw_pass_state *pass; // created with the context, reused by every pass
    uint32_t pass_generation;    // of the pass under way or, when there is none, of the last one
    bool pass_active;
};

// Memory through the allocation hook, counted. Safe from every thread. `alignment` is a power of two of at
// most 4096. Contents are undefined; NULL when the hook has none. `size` 0 gives a valid block.
void *rhw_context_allocate(struct rhw_context *context, size_t size, size_t alignment);
// `size` as it was given to allocate. NULL is allowed.
void rhw_context_release(struct rhw_context *context, void *memory, size_t size);

__attribute__((format(printf, 3, 4))) void rhw_context_log(const struct rhw_context *context,
                                                           enum rhw_log_level level, const char *format, ...);

// Reports misuse: formats the message and calls the assert hook (the default one when `context` is NULL).
// Messages read "rhw_function: what has which value; the rule".
__attribute__((format(printf, 2, 3), cold)) void rhw_misuse(const struct rhw_context *context,
                                                            const char *format, ...);
// Reports misuse when `condition` is false; is `condition`. A macro, because a draw passes a dozen of these: a call
// with arguments for a message that nobody needs took a fifth of the time of recording.
#define rhw_check(context, condition, ...) ((condition) || (rhw_misuse((context), __VA_ARGS__), false))

// Lookup by id. `where` is the public function that was called; a null or stale id is reported as its
// misuse and gives NULL. Items do not move while they live.
struct rhw_buffer_data *rhw_context_buffer(const struct rhw_context *context, rhw_buffer id,
                                           const char *where);
struct rhw_texture_data *rhw_context_texture(const struct rhw_context *context, rhw_texture id,
                                             const char *where);
struct rhw_sampler_data *rhw_context_sampler(const struct rhw_context *context, rhw_sampler id,
                                             const char *where);
struct rhw_pipeline_data *rhw_context_pipeline(const struct rhw_context *context, rhw_pipeline id,
                                               const char *where);

// A new zeroed texture item and its id; NULL when out of memory.
struct rhw_texture_data *rhw_context_texture_add(struct rhw_context *context, rhw_texture *id);
// Makes the id, which must be live, stale and releases `memory` (from rhw_context_allocate, or NULL), as
// destroying the context does for every texture that is left.
void rhw_context_texture_remove(struct rhw_context *context, rhw_texture id);

#endif
