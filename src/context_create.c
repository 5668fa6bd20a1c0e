// SPDX-License-Identifier: MIT
// Creation and destruction of a context. This file alone knows everything that hangs from a context, which is why it
// stands apart from context.h: the parts include context.h, and this file includes the parts.
#include <assert.h>

#include "resource/buffer.h"
#include "context/context.h"
#include "base/cpu.h"
#include "context/entry.h"
#include "context/given_up.h"
#include "binding/validation/validation.h"
#include "kernels/kernels.h"
#include "context/misuse.h"
#include "draw/recorded_pass.h"
#include "pass/encoder.h"
#include "pass/kept_reads.h"
#include "pass/pass_end.h"
#include "pipeline/pipeline.h"
#include "pass/query.h"
#include "recording/recorder.h"
#include "rhw/rhw.h"
#include "resource/sampler.h"
#include "run/run.h"
#include "base/scheduler.h"
#include "resource/texture.h"
#include "base/thread.h"

static void destroy_resources(struct rhw_context *context)
{
    uint32_t index = 0;
    struct rhw_buffer_data *buffer;
    while ((buffer = rhw_pool_next(&context->buffers, &index)) != NULL) {
        rhw_buffer_data_release(&context->memory, buffer);
    }
    index = 0;
    struct rhw_texture_data **texture;
    while ((texture = rhw_pool_next(&context->textures, &index)) != NULL) {
        rhw_texture_data_destroy(&context->memory, *texture);
    }

    index = 0;
    struct rhw_pipeline_data *pipeline;
    while ((pipeline = rhw_pool_next(&context->pipelines, &index)) != NULL) {
        rhw_pipeline_data_release(&context->memory, pipeline);
    }

    rhw_pool_destroy(&context->memory, &context->buffers);
    rhw_pool_destroy(&context->memory, &context->textures);
    rhw_pool_destroy(&context->memory, &context->samplers);
    rhw_pool_destroy(&context->memory, &context->pipelines);
    rhw_pool_destroy(&context->memory, &context->queries);
}

bool rhw_isa_supported(enum rhw_isa isa)
{
    return (unsigned)isa < RHW_ISA_COUNT && rhw_cpu_supports(isa) && rhw_kernels_for(isa) != NULL;
}

// What RHW_ISA_BEST stands for. AVX-512 draws equal bytes in 0.97 of the time on a Zen 5, some scenes slower, and in
// 0.92 to 1.05 on a Zen 4; other processors lower their clock for it.
static const enum rhw_isa_limit measured_best = RHW_ISA_UP_TO_AVX2;

static enum rhw_isa best_isa(enum rhw_isa_limit limit)
{
    int isa = (int)(limit == RHW_ISA_BEST ? measured_best : limit) - 1;
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

// Return a number that tells the ids of this context from those of others. A counter would be state that contexts
// share. Of two contexts the time or the place differs, and one in 2^32 pairs has equal numbers all the same. 0 is the
// number of null ids.
static uint32_t number_of(const struct rhw_context *context)
{
    uint64_t mixed = rhw_time_ns() ^ (uint64_t)(uintptr_t)context << 16;
    mixed = (mixed ^ mixed >> 31) * 0x9e3779b97f4a7c15u;
    const uint32_t number = (uint32_t)(mixed >> 32);
    return number != 0 ? number : 1;
}

// Return a context of which only the hooks matter: it reports misuse before there is a context.
static struct rhw_context reporter(const struct rhw_context_def *def)
{
    return (struct rhw_context){.assert_ = def->assert_, .user = def->user, .definition = def->label};
}

static bool check_def(const struct rhw_context_def *def, rhw_context **context)
{
    static const char *const where = "rhw_context_create";
    if (!rhw_check(NULL, def != NULL, "%s: def is NULL", where)) {
        return false;
    }
    struct rhw_context report = reporter(def);
    const struct rhw_allocator *const allocator = &def->allocator;
    return rhw_check(&report, context != NULL, "%s: context is NULL", where) &&
           rhw_check(&report, def->threads >= 0 && def->threads <= RHW_MAX_THREADS,
                     "%s: threads is %d; it must be 0 (all cores) to %d", where, def->threads,
                     RHW_MAX_THREADS) &&
           rhw_check(&report, (unsigned)def->isa_limit <= RHW_ISA_COUNT,
                     "%s: isa_limit is %d; it must be RHW_ISA_BEST (0) or one of those up to %d", where,
                     (int)def->isa_limit, RHW_ISA_COUNT) &&
           rhw_check(&report, (unsigned)def->paths <= RHW_PATHS_GENERAL,
                     "%s: paths is %d; it must be RHW_PATHS_ALL (0), RHW_PATHS_IN_ORDER (1) or "
                     "RHW_PATHS_GENERAL (2)",
                     where, (int)def->paths) &&
           rhw_check(&report, (unsigned)def->validate <= RHW_VALIDATE_OFF,
                     "%s: validate is %d; it must be RHW_VALIDATE_DEFAULT (0), RHW_VALIDATE_ON (1) or "
                     "RHW_VALIDATE_OFF (2)",
                     where, (int)def->validate) &&
           rhw_check(&report, (allocator->allocate == NULL) == (allocator->release == NULL),
                     "%s: allocator has only one of allocate and release; it must have both or neither",
                     where);
}

static enum rhw_result create_validation(struct rhw_context *context)
{
    struct rhw_validation_messages *const validation =
        rhw_memory_allocate(&context->memory, sizeof *validation, _Alignof(struct rhw_validation_messages));
    if (validation == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    if (!rhw_validation_messages_init(validation)) {
        rhw_memory_release(&context->memory, validation, sizeof *validation);
        return RHW_ERROR_THREAD;
    }
    context->validation = validation;
    context->validate_pipeline = rhw_validate_pipeline;
    return RHW_OK;
}

static void destroy_validation(struct rhw_context *context)
{
    if (context->validation != NULL) {
        rhw_validation_messages_destroy(context->validation);
        rhw_memory_release(&context->memory, context->validation, sizeof *context->validation);
    }
}

// Create everything that a context needs beyond itself. rhw_context_destroy releases what a failure leaves behind.
static enum rhw_result create_parts(struct rhw_context *context, bool validates)
{
    enum rhw_result result =
        rhw_scheduler_create(&context->memory, context->threads, context->cores, &context->scheduler);
    if (result == RHW_OK) {
        context->pass = rhw_recorded_pass_create(&context->memory);
        context->executor = rhw_executor_create(context);
        context->encoder = rhw_encoder_create(context, context->pass);
        const bool is_complete = context->pass && context->executor && context->encoder;
        result = is_complete ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
    }
    return result == RHW_OK && validates ? create_validation(context) : result;
}

enum rhw_result rhw_context_create_probed(const struct rhw_context_def *def, bool debug,
                                          rhw_context **context)
{
    if (context != NULL) {
        *context = NULL;
    }
    if (!check_def(def, context)) {
        return RHW_ERROR_MISUSE;
    }

    struct rhw_memory memory = {.allocator = rhw_allocator_or_default(def->allocator)};
    struct rhw_context *const created =
        rhw_memory_allocate(&memory, sizeof *created, _Alignof(struct rhw_context));
    if (created == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }

    const enum rhw_isa isa = best_isa(def->isa_limit);
    const int cores = def->threads == 1 ? 1 : rhw_cpu_cores(); // rhw_cpu_cores reads files
    *created = (struct rhw_context){
        .memory = memory,
        .log = def->log,
        .assert_ = def->assert_,
        .user = def->user,
        .number = number_of(created),
        .pass_number = number_of(created),
        .cores = cores,
        .threads = thread_count(def->threads, cores),
        .isa = isa,
        .paths = def->paths,
        .bin_memory = def->bin_memory,
        .kernels = rhw_kernels_for(isa),
        .keep_reads = rhw_encoder_keep_reads,
    };
    rhw_label_copy(created->label, def->label);
    rhw_pool_init(&created->buffers, "buffer", sizeof(struct rhw_buffer_data));
    rhw_pool_init(&created->textures, "texture", sizeof(struct rhw_texture_data *));
    rhw_pool_init(&created->samplers, "sampler", sizeof(struct rhw_sampler_data));
    rhw_pool_init(&created->pipelines, "pipeline", sizeof(struct rhw_pipeline_data));
    rhw_pool_init(&created->queries, "query", sizeof(struct rhw_query_data));

    const bool validates = def->validate == RHW_VALIDATE_DEFAULT ? debug : def->validate == RHW_VALIDATE_ON;
    const enum rhw_result result = create_parts(created, validates);
    if (result != RHW_OK) {
        rhw_context_destroy(created);
        return result;
    }
    rhw_context_log(created, RHW_LOG_INFO, "rhw %s: %d thread%s, %s kernels%s", rhw_version(),
                    created->threads, created->threads == 1 ? "" : "s", rhw_isa_name(isa),
                    validates ? ", validation" : "");
    *context = created;
    return RHW_OK;
}

void rhw_context_destroy(rhw_context *context)
{
    static const char *const where = "rhw_context_destroy";
    if (context == NULL || !rhw_context_enter_any(context, where)) {
        return;
    }
    if (!rhw_check(context, !context->recording.active, "%s: a pass is being recorded; end it first",
                   where) ||
        !rhw_check(context, context->recorders == 0, "%s: a recorder of the context lives; destroy it first",
                   where)) {
        rhw_context_leave(context);
        return;
    }
    if (context->owner) {
        rhw_recorder_destroy(context);
        return;
    }
    rhw_pass_release_retired(context);
    rhw_encoder_destroy(context->encoder);
    rhw_executor_destroy(context->executor);
    rhw_recorded_pass_destroy(&context->memory, context->pass);
    destroy_resources(context);
    destroy_validation(context);
    rhw_scheduler_destroy(&context->memory, context->scheduler);
    struct rhw_memory memory = context->memory;
    rhw_memory_release(&memory, context, sizeof *context);
    assert(memory.used == 0); // if not, one of our parts leaks
}

int rhw_context_threads(const rhw_context *context)
{
    return rhw_check(context, context != NULL, "rhw_context_threads: context is NULL") ? context->threads : 0;
}

static void ask(void *user)
{
    (void)rhw_context_is_given_up(user, 0);
}

void rhw_context_set_goes_on(rhw_context *context, bool (*goes_on)(void *user), void *user)
{
    if (rhw_context_enter(context, "rhw_context_set_goes_on")) {
        context->goes_on = goes_on;
        context->goes_on_user = user;
        rhw_scheduler_set_idle(context->scheduler, goes_on ? ask : NULL, context);
        rhw_context_leave(context);
    }
}

enum rhw_isa rhw_context_isa(const rhw_context *context)
{
    return rhw_check(context, context != NULL, "rhw_context_isa: context is NULL") ? context->isa
                                                                                   : RHW_ISA_BASELINE;
}
