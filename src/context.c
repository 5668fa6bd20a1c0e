// SPDX-License-Identifier: MIT
// Creation and destruction of a context, its hooks and its memory accounting.
#include "context.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#if defined(__linux__)
#include <sys/mman.h>
#endif

#include "buffer.h"
#include "clean_tiles.h"
#include "constants.h"
#include "cpu.h"
#include "kernels/kernels.h"
#include "pass.h"
#include "pipeline.h"
#include "sampler.h"
#include "scheduler.h"

enum {
    MESSAGE_SIZE = 512,      // bytes of a log or misuse line; a longer one is cut
    HUGE_PAGE = 2 << 20,     // bytes
    LARGEST_ALIGNMENT = 4096 // bytes; what base.h promises to allocation hooks
};

// The default hooks ------------------------------------------------------------------------------------

// Targets, arenas and large buffers are walked from end to end by every frame: on huge pages they cost a
// 512th of the page faults and TLB misses.
static void *allocate_default(void *user, size_t size, size_t alignment)
{
    (void)user;
    const bool large = size >= HUGE_PAGE;
    size_t align = alignment < sizeof(void *) ? sizeof(void *) : alignment;
    if (large) {
        align = HUGE_PAGE;
    }
    void *memory = NULL;
    if (posix_memalign(&memory, align, size) != 0) {
        return NULL;
    }
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (large) {
        (void)madvise(memory, size & ~(size_t)(HUGE_PAGE - 1), MADV_HUGEPAGE); // advice; may be refused
    }
#endif
    return memory;
}

static void release_default(void *user, void *memory, size_t size)
{
    (void)user;
    (void)size;
    free(memory);
}

static void assert_default(void *user, const char *message)
{
    (void)user;
    fprintf(stderr, "rhw: %s\n", message);
    abort();
}

// Hooks and memory -------------------------------------------------------------------------------------

void rhw_context_log(const struct rhw_context *context, enum rhw_log_level level, const char *format, ...)
{
    if (context->log == NULL) {
        return;
    }
    char message[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    context->log(context->user, level, message);
}

void rhw_misuse(const struct rhw_context *context, const char *format, ...)
{
    char message[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    if (context == NULL) {
        assert_default(NULL, message);
    } else {
        context->assert_(context->user, message);
    }
}

// Hooks never see a size of 0, whose meaning differs between allocators.
static size_t hook_size(size_t size)
{
    return size == 0 ? 1 : size;
}

static void count_allocation(struct rhw_context *context, size_t size)
{
    const size_t used = atomic_fetch_add_explicit(&context->memory_used, size, memory_order_relaxed) + size;
    size_t peak = atomic_load_explicit(&context->memory_peak, memory_order_relaxed);
    while (peak < used &&
           !atomic_compare_exchange_weak_explicit(&context->memory_peak, &peak, used, memory_order_relaxed,
                                                  memory_order_relaxed)) {
        continue;
    }
}

void *rhw_context_allocate(struct rhw_context *context, size_t size, size_t alignment)
{
    assert(alignment != 0 && (alignment & (alignment - 1)) == 0 && alignment <= LARGEST_ALIGNMENT);
    const struct rhw_allocator *const allocator = &context->allocator;
    void *const memory = allocator->allocate(allocator->user, hook_size(size), alignment);
    if (memory != NULL) {
        count_allocation(context, hook_size(size));
    }
    return memory;
}

void rhw_context_release(struct rhw_context *context, void *memory, size_t size)
{
    if (memory == NULL) {
        return;
    }
    atomic_fetch_sub_explicit(&context->memory_used, hook_size(size), memory_order_relaxed);
    context->allocator.release(context->allocator.user, memory, hook_size(size));
}

// Resources --------------------------------------------------------------------------------------------

static bool check_context(const struct rhw_context *context, const char *where)
{
    return rhw_check(context, context != NULL, "%s: context is NULL", where);
}

struct rhw_buffer_data *rhw_context_buffer(const struct rhw_context *context, rhw_buffer id,
                                           const char *where)
{
    if (!check_context(context, where)) {
        return NULL;
    }
    return rhw_pool_get(context, &context->buffers, id.index, id.generation, where);
}

struct rhw_texture_data *rhw_context_texture(const struct rhw_context *context, rhw_texture id,
                                             const char *where)
{
    if (!check_context(context, where)) {
        return NULL;
    }
    return rhw_pool_get(context, &context->textures, id.index, id.generation, where);
}

struct rhw_sampler_data *rhw_context_sampler(const struct rhw_context *context, rhw_sampler id,
                                             const char *where)
{
    if (!check_context(context, where)) {
        return NULL;
    }
    return rhw_pool_get(context, &context->samplers, id.index, id.generation, where);
}

struct rhw_pipeline_data *rhw_context_pipeline(const struct rhw_context *context, rhw_pipeline id,
                                               const char *where)
{
    if (!check_context(context, where)) {
        return NULL;
    }
    return rhw_pool_get(context, &context->pipelines, id.index, id.generation, where);
}

struct rhw_texture_data *rhw_context_texture_add(struct rhw_context *context, rhw_texture *id)
{
    return rhw_pool_add(context, &context->textures, &id->index, &id->generation);
}

static void release_texture(struct rhw_context *context, struct rhw_texture_data *texture)
{
    rhw_context_release(context, texture->memory, texture->memory_size);
    rhw_context_release(context, texture->linear_memory, texture->linear_size);
    rhw_clean_tiles_release(context, texture);
}

void rhw_context_texture_remove(struct rhw_context *context, rhw_texture id)
{
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, "rhw_context_texture_remove");
    if (texture == NULL) {
        return;
    }
    release_texture(context, texture);
    rhw_pool_remove(&context->textures, id.index);
}

static void destroy_resources(struct rhw_context *context)
{
    uint32_t index = 0;
    struct rhw_buffer_data *buffer;
    while ((buffer = rhw_pool_next(&context->buffers, &index)) != NULL) {
        rhw_buffer_data_release(context, buffer);
    }
    index = 0;
    struct rhw_texture_data *texture;
    while ((texture = rhw_pool_next(&context->textures, &index)) != NULL) {
        release_texture(context, texture);
    }

    rhw_pool_destroy(context, &context->buffers);
    rhw_pool_destroy(context, &context->textures);
    rhw_pool_destroy(context, &context->samplers);
    rhw_pool_destroy(context, &context->pipelines);
}

// Creation ---------------------------------------------------------------------------------------------

bool rhw_isa_supported(enum rhw_isa isa)
{
    return (unsigned)isa < RHW_ISA_COUNT && rhw_cpu_supports(isa) && rhw_kernels_for(isa) != NULL;
}

static enum rhw_isa best_isa(enum rhw_isa highest)
{
    int isa = highest >= RHW_ISA_COUNT ? RHW_ISA_COUNT - 1 : (int)highest;
    while (isa > RHW_ISA_BASELINE && !rhw_isa_supported((enum rhw_isa)isa)) {
        isa--;
    }
    return (enum rhw_isa)isa;
}

static int thread_count(int wanted, int cores)
{
    const int count = wanted == 0 ? cores : wanted;
    return count > RHW_MAX_THREADS ? RHW_MAX_THREADS : count;
}

// Only its hooks matter: it reports misuse before there is a context.
static struct rhw_context reporter(const struct rhw_context_def *def)
{
    return (struct rhw_context){.assert_ = def->assert_ != NULL ? def->assert_ : assert_default,
                                .user = def->user};
}

static bool check_def(const struct rhw_context_def *def, rhw_context **context)
{
    static const char *const where = "rhw_context_create";
    if (!rhw_check(NULL, def != NULL, "%s: def is NULL", where)) {
        return false;
    }
    const struct rhw_context report = reporter(def);
    const struct rhw_allocator *const allocator = &def->allocator;
    return rhw_check(&report, context != NULL, "%s: context is NULL", where) &&
           rhw_check(&report, def->threads >= 0 && def->threads <= RHW_MAX_THREADS,
                     "%s: threads is %d; it must be 0 (all cores) to %d", where, def->threads,
                     RHW_MAX_THREADS) &&
           rhw_check(&report, (unsigned)def->isa <= RHW_ISA_COUNT,
                     "%s: isa is %d; it must be an instruction set or RHW_ISA_COUNT (%d)", where,
                     (int)def->isa, RHW_ISA_COUNT) &&
           rhw_check(&report, (allocator->allocate == NULL) == (allocator->release == NULL),
                     "%s: allocator has only one of allocate and release; it must have both or neither",
                     where);
}

// Everything a context needs beyond itself. What a failure leaves behind is for rhw_context_destroy.
static enum rhw_result create_parts(struct rhw_context *context)
{
    const enum rhw_result result = rhw_scheduler_create(context, context->threads, &context->scheduler);
    if (result != RHW_OK) {
        return result;
    }
    return rhw_pass_state_create(context, &context->pass);
}

enum rhw_result rhw_context_create(const struct rhw_context_def *def, rhw_context **context)
{
    if (context != NULL) {
        *context = NULL;
    }
    if (!check_def(def, context)) {
        return RHW_ERROR_MISUSE;
    }

    struct rhw_allocator allocator = def->allocator;
    if (allocator.allocate == NULL) {
        allocator = (struct rhw_allocator){allocate_default, release_default, NULL};
    }
    struct rhw_context *const created =
        allocator.allocate(allocator.user, sizeof *created, _Alignof(struct rhw_context));
    if (created == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }

    const enum rhw_isa isa = best_isa(def->isa);
    const int cores = def->threads == 1 ? 1 : rhw_cpu_cores(); // which reads files
    *created = (struct rhw_context){
        .allocator = allocator,
        .log = def->log,
        .assert_ = def->assert_ != NULL ? def->assert_ : assert_default,
        .user = def->user,
        .memory_used = sizeof *created,
        .memory_peak = sizeof *created,
        .cores = cores,
        .threads = thread_count(def->threads, cores),
        .isa = isa,
        .bin_memory = def->bin_memory,
        .kernels = rhw_kernels_for(isa),
    };
    rhw_pool_init(&created->buffers, "buffer", sizeof(struct rhw_buffer_data));
    rhw_pool_init(&created->textures, "texture", sizeof(struct rhw_texture_data));
    rhw_pool_init(&created->samplers, "sampler", sizeof(struct rhw_sampler_data));
    rhw_pool_init(&created->pipelines, "pipeline", sizeof(struct rhw_pipeline_data));

    const enum rhw_result result = create_parts(created);
    if (result != RHW_OK) {
        rhw_context_destroy(created);
        return result;
    }
    rhw_context_log(created, RHW_LOG_INFO, "rhw %s: %d thread%s, %s kernels", rhw_version(), created->threads,
                    created->threads == 1 ? "" : "s", rhw_isa_name(isa));
    *context = created;
    return RHW_OK;
}

void rhw_context_destroy(rhw_context *context)
{
    if (context == NULL) {
        return;
    }
    if (context->pass != NULL) {
        rhw_pass_state_destroy(context, context->pass);
    }
    destroy_resources(context);
    rhw_scheduler_destroy(context, context->scheduler);
    assert(atomic_load(&context->memory_used) == sizeof *context); // else one of our parts leaks
    context->allocator.release(context->allocator.user, context, sizeof *context);
}

int rhw_context_threads(const rhw_context *context)
{
    return check_context(context, "rhw_context_threads") ? context->threads : 0;
}

enum rhw_isa rhw_context_isa(const rhw_context *context)
{
    return check_context(context, "rhw_context_isa") ? context->isa : RHW_ISA_BASELINE;
}
