// SPDX-License-Identifier: MIT
// The thread takes one submission after the other. It holds `in_use` while it works, so another thread may destroy ids
// of librhw as long as nothing runs.
#include "queue.h"

#include "command/replay.h"
#include "submission.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    NANOSECONDS = 1000000000,
    // Dawn in node asks every 10 to 30 microseconds until a buffer is there. A program that asks once a frame pauses
    // for longer, one that looks a few times and then waits asks less often in a row, and one that looks at many
    // objects asks for another one each time: none of them is held up.
    ASK_PAUSE = 100000,
    ASK_REFUSALS = 8,
    ASK_WAIT = 1000000
};

uint64_t vulkan_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * NANOSECONDS + (uint64_t)now.tv_nsec;
}

static struct timespec timespec_of(uint64_t time)
{
    return (struct timespec){(time_t)(time / NANOSECONDS), (long)(time % NANOSECONDS)};
}

VkResult vulkan_queue_wait(VkQueue queue, bool (*is_true)(void *user), void *user, uint64_t timeout)
{
    const uint64_t now = timeout == 0 || timeout == UINT64_MAX ? 0 : vulkan_now();
    const uint64_t end = timeout > UINT64_MAX / 2 - now ? UINT64_MAX / 2 : now + timeout;
    const struct timespec until = timespec_of(end);
    pthread_mutex_lock(&queue->lock);
    bool is_late = timeout == 0, holds;
    while (!(holds = is_true(user)) && !is_late && !queue->is_lost) {
        is_late = pthread_cond_timedwait(&queue->changed, &queue->lock, &until) == ETIMEDOUT;
    }
    const bool is_lost = queue->is_lost;
    pthread_mutex_unlock(&queue->lock);
    return is_lost ? VK_ERROR_DEVICE_LOST : holds ? VK_SUCCESS : VK_TIMEOUT;
}

// Count an answer that is no. Return true if the thread that asks is to wait. The lock is held.
static bool is_insistent(VkQueue queue, const void *object, uint64_t now)
{
    const bool is_again = object == queue->asked_for && now - queue->asked < ASK_PAUSE;
    queue->refusals = is_again ? queue->refusals + 1 : 0;
    queue->asked_for = object;
    queue->asked = now;
    return queue->refusals >= ASK_REFUSALS && queue->first;
}

VkResult vulkan_queue_ask(VkQueue queue, const void *object, bool (*is_true)(void *user), void *user)
{
    pthread_mutex_lock(&queue->lock);
    bool holds = is_true(user);
    if (!holds && !queue->is_lost) {
        const uint64_t now = vulkan_now();
        if (is_insistent(queue, object, now)) {
            const struct timespec until = timespec_of(now + ASK_WAIT);
            while (!holds && queue->first && !queue->is_lost &&
                   pthread_cond_timedwait(&queue->changed, &queue->lock, &until) != ETIMEDOUT) {
                holds = is_true(user);
            }
            queue->asked = vulkan_now();
        }
    }
    const bool is_lost = queue->is_lost;
    pthread_mutex_unlock(&queue->lock);
    return is_lost ? VK_ERROR_DEVICE_LOST : holds ? VK_SUCCESS : VK_TIMEOUT;
}

// Retired ids -----------------------------------------------------------------------------------------

// Destroy what is retired. `in_use` is held.
static void destroy(VkQueue queue, const struct vulkan_retired *retired)
{
    switch (retired->kind) {
    case VULKAN_RETIRED_TEXTURE:
        rhw_texture_destroy(queue->context,
                            (rhw_texture){retired->index, retired->generation, retired->context});
        break;
    case VULKAN_RETIRED_SAMPLER:
        rhw_sampler_destroy(queue->context,
                            (rhw_sampler){retired->index, retired->generation, retired->context});
        break;
    case VULKAN_RETIRED_PIPELINE:
        rhw_pipeline_destroy(queue->context,
                             (rhw_pipeline){retired->index, retired->generation, retired->context});
        break;
    case VULKAN_RETIRED_QUERY:
        rhw_query_destroy(queue->context, (rhw_query){retired->index, retired->generation, retired->context});
        break;
    }
    if (retired->release) {
        retired->release(retired->user);
    }
}

// Put an item into the list. Return false without memory.
static bool push(VkQueue queue, const struct vulkan_retired *retired)
{
    pthread_mutex_lock(&queue->lock);
    if (queue->retired_count == queue->retired_capacity) {
        const size_t capacity = 2 * queue->retired_capacity + 64;
        struct vulkan_retired *const larger = realloc(queue->retired, capacity * sizeof *larger);
        if (larger) {
            queue->retired = larger;
            queue->retired_capacity = capacity;
        }
    }
    const bool has_room = queue->retired_count < queue->retired_capacity;
    if (has_room) {
        queue->retired[queue->retired_count++] = *retired;
    }
    pthread_mutex_unlock(&queue->lock);
    return has_room;
}

static void retire(VkQueue queue, const struct vulkan_retired *retired)
{
    if (pthread_mutex_trylock(&queue->in_use) != 0) {
        if (push(queue, retired)) {
            return;
        }
        pthread_mutex_lock(&queue->in_use); // without memory, wait for the submission that runs
    }
    destroy(queue, retired);
    pthread_mutex_unlock(&queue->in_use);
}

void vulkan_retire_texture(VkQueue queue, rhw_texture id)
{
    if (id.context != 0) {
        retire(queue, &(struct vulkan_retired){VULKAN_RETIRED_TEXTURE, id.index, id.generation, id.context,
                                               NULL, NULL});
    }
}

void vulkan_retire_sampler(VkQueue queue, rhw_sampler id)
{
    if (id.context != 0) {
        retire(queue, &(struct vulkan_retired){VULKAN_RETIRED_SAMPLER, id.index, id.generation, id.context,
                                               NULL, NULL});
    }
}

void vulkan_retire_query(VkQueue queue, rhw_query id)
{
    if (id.context != 0) {
        retire(queue, &(struct vulkan_retired){VULKAN_RETIRED_QUERY, id.index, id.generation, id.context,
                                               NULL, NULL});
    }
}

void vulkan_retire_pipeline(VkQueue queue, rhw_pipeline id, void (*release)(void *user), void *user)
{
    if (id.context != 0) {
        retire(queue, &(struct vulkan_retired){VULKAN_RETIRED_PIPELINE, id.index, id.generation, id.context,
                                               release, user});
    } else if (release) {
        release(user);
    }
}

// Destroy all that is retired. `in_use` is held.
static void destroy_retired(VkQueue queue)
{
    for (;;) {
        pthread_mutex_lock(&queue->lock);
        const bool has_one = queue->retired_count > 0;
        const struct vulkan_retired one =
            has_one ? queue->retired[--queue->retired_count] : (struct vulkan_retired){0};
        pthread_mutex_unlock(&queue->lock);
        if (!has_one) {
            return;
        }
        destroy(queue, &one);
    }
}

// The thread ------------------------------------------------------------------------------------------

static bool has_semaphores(const struct vulkan_submission *submission)
{
    for (uint32_t i = 0; i < submission->wait_count; i++) {
        const struct vulkan_point *const wait = &submission->waits[i];
        if (wait->semaphore->is_timeline && wait->semaphore->value < wait->value) {
            return false;
        }
    }
    return true;
}

static void signal_all(VkQueue queue, const struct vulkan_submission *submission)
{
    for (uint32_t i = 0; i < submission->signal_count; i++) {
        vulkan_semaphore_signal(queue, submission->signals[i].semaphore, submission->signals[i].value);
    }
    vulkan_fence_signal(queue, submission->fence);
}

// Replay a submission. Return false if the device is lost.
static bool run(VkQueue queue, const struct vulkan_submission *submission)
{
    pthread_mutex_lock(&queue->in_use);
    queue->begun = vulkan_now();
    destroy_retired(queue);
    const VkResult result = vulkan_replay_buffers(queue, submission->buffers, submission->buffer_count);
    destroy_retired(queue);
    pthread_mutex_unlock(&queue->in_use);
    return result == VK_SUCCESS;
}

// Take the first submission out of the queue. The lock is held.
static void drop(VkQueue queue)
{
    struct vulkan_submission *const submission = queue->first;
    queue->first = submission->next;
    queue->last = queue->first ? queue->last : NULL;
    pthread_cond_broadcast(&queue->changed);
    free(submission);
}

// What a lost device was to signal may be gone already, so nothing is signalled any more. The lock is held.
static void lose(VkQueue queue)
{
    queue->is_lost = true;
    while (queue->first) {
        drop(queue);
    }
}

static void *work(void *user)
{
    const VkQueue queue = user;
    pthread_mutex_lock(&queue->lock);
    for (;;) {
        struct vulkan_submission *const submission = queue->first;
        if (!submission && queue->ends) {
            break;
        }
        if (!submission || !(has_semaphores(submission) || queue->ends)) {
            pthread_cond_wait(&queue->changed, &queue->lock);
            continue;
        }
        pthread_mutex_unlock(&queue->lock);
        const bool is_done = run(queue, submission);
        pthread_mutex_lock(&queue->lock);
        if (is_done) {
            signal_all(queue, submission);
            drop(queue);
        } else {
            lose(queue);
        }
    }
    pthread_mutex_unlock(&queue->lock);
    return NULL;
}

// Beginning and end -----------------------------------------------------------------------------------

static bool goes_on(void *user)
{
    const struct VkQueue_T *const queue = user;
    return queue->timeout == 0 || vulkan_now() - queue->begun < queue->timeout;
}

static void tell_misuse(void *user, const char *message)
{
    (void)user;
    vulkan_log("%s", message);
}

// Return a number that a variable of the environment has, at least 0 and at most `most`, or 0 if it has none.
static double number_of(const char *variable, double most)
{
    const char *const text = getenv(variable);
    const double number = text ? strtod(text, NULL) : 0;
    return number > 0 ? number < most ? number : most : 0;
}

static VkResult init_context(VkQueue queue)
{
    struct rhw_context_def def = rhw_context_def_default();
    const char *const isa = getenv("RHW_VULKAN_ISA");
    def.threads = (int)number_of("RHW_VULKAN_THREADS", RHW_MAX_THREADS);
    for (int i = 0; isa && i < RHW_ISA_COUNT; i++) {
        if (strcmp(isa, rhw_isa_name((enum rhw_isa)i)) == 0) {
            def.isa_limit = rhw_isa_up_to((enum rhw_isa)i);
        }
    }
    def.validate = RHW_VALIDATE_OFF;
    def.assert_ = tell_misuse;
    def.label = "vulkan";
    if (rhw_context_create(&def, &queue->context) != RHW_OK) {
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    queue->timeout = (uint64_t)(number_of("RHW_VULKAN_TIMEOUT", 1e6) * NANOSECONDS);
    rhw_context_set_goes_on(queue->context, goes_on, queue);
    return VK_SUCCESS;
}

static void init_locks(VkQueue queue)
{
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_cond_init(&queue->changed, &monotonic);
    pthread_condattr_destroy(&monotonic);
    pthread_mutex_init(&queue->lock, NULL);
    pthread_mutex_init(&queue->in_use, NULL);
    pthread_mutex_init(&queue->twins_lock, NULL);
}

static void end_locks(VkQueue queue)
{
    pthread_cond_destroy(&queue->changed);
    pthread_mutex_destroy(&queue->lock);
    pthread_mutex_destroy(&queue->in_use);
    pthread_mutex_destroy(&queue->twins_lock);
}

VkResult vulkan_queue_init(VkQueue queue, VkDevice device)
{
    queue->device = device;
    set_loader_magic_value(queue);
    const VkResult result = init_context(queue);
    if (result != VK_SUCCESS) {
        return result;
    }
    init_locks(queue);
    if (pthread_create(&queue->thread, NULL, work, queue) != 0) {
        end_locks(queue);
        rhw_context_destroy(queue->context);
        return VK_ERROR_INITIALIZATION_FAILED;
    }
    return VK_SUCCESS;
}

void vulkan_queue_end(VkQueue queue)
{
    pthread_mutex_lock(&queue->lock);
    queue->ends = true;
    pthread_cond_broadcast(&queue->changed);
    pthread_mutex_unlock(&queue->lock);
    pthread_join(queue->thread, NULL);
    destroy_retired(queue);
    free(queue->retired);
    vulkan_arena_free(queue);
    rhw_context_destroy(queue->context);
    end_locks(queue);
}
