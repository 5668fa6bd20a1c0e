// SPDX-License-Identifier: MIT
// The queue and its thread. That thread alone calls librhw with the queue's context, and functions that take a VkQueue
// in order to make an id of librhw are called by it alone. Ids of objects that the program destroys are retired: the
// thread destroys them before it replays what is submitted next.
#ifndef VULKAN_QUEUE_H
#define VULKAN_QUEUE_H

#include "rhw/rhw.h"
#include <pthread.h>
#include <stdbool.h>
#include <vulkan/vk_icd.h>

struct vulkan_submission;
struct vulkan_replay;

enum vulkan_retired_kind {
    VULKAN_RETIRED_TEXTURE,
    VULKAN_RETIRED_SAMPLER,
    VULKAN_RETIRED_PIPELINE,
    VULKAN_RETIRED_QUERY
};

// An id of librhw whose object is gone, and what is released after it.
struct vulkan_retired {
    enum vulkan_retired_kind kind;
    uint32_t index, generation, context;
    void (*release)(void *user);
    void *user;
};

struct VkQueue_T {
    VK_LOADER_DATA loader;
    VkDevice device;
    rhw_context *context;
    pthread_t thread;
    pthread_mutex_t lock;             ///< guards what stands behind it
    pthread_cond_t changed;           ///< something was submitted, has run, or was signalled
    pthread_mutex_t in_use;           ///< held by the thread that calls librhw with the context
    pthread_mutex_t twins_lock;       ///< guards `twinned`
    VkImage twinned;                  ///< images with twins (resource/image_twin.h)
    uint64_t timeout;                 ///< nanoseconds after which a submission is given up; 0: never
    uint64_t begun;                   ///< time at which the submission under way began, of vulkan_now
    struct vulkan_arena_block *arena; ///< memory that replay keeps from one submission to the next
    bool ends;                        ///< the thread ends when nothing is left
    bool is_lost;                     ///< a shader was given up or memory ran out
    const void *asked_for;            ///< what the last answer of vulkan_queue_ask was about, if it was no
    uint64_t asked;                   ///< time of that answer
    uint32_t refusals;                ///< how many answers about it were no without a pause between them
    struct vulkan_submission *first, *last; ///< what waits or runs, in order
    struct vulkan_retired *retired;
    size_t retired_count, retired_capacity;
};

// Create the context and the thread of a device's queue.
VkResult vulkan_queue_init(VkQueue queue, VkDevice device);

// Wait until the queue has run everything, and end its thread.
void vulkan_queue_end(VkQueue queue);

// Return nanoseconds of a clock that only counts up.
uint64_t vulkan_now(void);

// Wait until `is_true` holds, for at most `timeout` nanoseconds, UINT64_MAX for ever. `is_true` is called with the lock
// held. Return VK_SUCCESS, VK_TIMEOUT or VK_ERROR_DEVICE_LOST.
VkResult vulkan_queue_wait(VkQueue queue, bool (*is_true)(void *user), void *user, uint64_t timeout);

// Return what vulkan_queue_wait returns for a timeout of 0. A program that asks for an object again and again, without
// a pause, takes a core from the threads that do what it asks for: while the queue has work, it gets its answer later,
// by a millisecond at most, or as soon as it is yes.
VkResult vulkan_queue_ask(VkQueue queue, const void *object, bool (*is_true)(void *user), void *user);

// Let the queue's thread destroy an id, which may be the null id. Any thread may call these.
void vulkan_retire_texture(VkQueue queue, rhw_texture texture);
void vulkan_retire_sampler(VkQueue queue, rhw_sampler sampler);
void vulkan_retire_query(VkQueue queue, rhw_query query);
// What a pipeline stands on (rhw_program.user) must live until the pipeline is gone: `release`, which may be NULL, is
// called with `user` then, by any thread.
void vulkan_retire_pipeline(VkQueue queue, rhw_pipeline pipeline, void (*release)(void *user), void *user);

#endif
