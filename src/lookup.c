// SPDX-License-Identifier: MIT
// Pools find items; here a wrong id gets its message.
#include "lookup.h"

#include "context.h"
#include "misuse.h"

static bool check_context(const struct rhw_context *context, const char *where)
{
    return rhw_check(context, context != NULL, "%s: context is NULL", where);
}

static __attribute__((cold)) void report(const struct rhw_context *context, const struct rhw_pool *pool,
                                         uint32_t index, uint32_t generation, const char *where)
{
    const char *const noun = pool->noun;
    if (index == 0) {
        rhw_misuse(context, "%s: the %s id is null", where, noun);
    } else if (index > pool->slots) {
        rhw_misuse(context, "%s: %s id %u (generation %u) was never created in this context", where, noun,
                   (unsigned)index, (unsigned)generation);
    } else {
        rhw_misuse(context, "%s: %s id %u (generation %u) is stale: that %s was destroyed", where, noun,
                   (unsigned)index, (unsigned)generation, noun);
    }
}

static void *find(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index,
                  uint32_t generation, const char *where)
{
    void *const item = rhw_pool_get(pool, index, generation);
    if (item == NULL) {
        report(context, pool, index, generation, where);
    }
    return item;
}

struct rhw_buffer_data *rhw_context_buffer(const struct rhw_context *context, rhw_buffer id,
                                           const char *where)
{
    if (!check_context(context, where)) {
        return NULL;
    }
    return find(context, &context->buffers, id.index, id.generation, where);
}

struct rhw_texture_data *rhw_context_texture(const struct rhw_context *context, rhw_texture id,
                                             const char *where)
{
    if (!check_context(context, where)) {
        return NULL;
    }
    return find(context, &context->textures, id.index, id.generation, where);
}

struct rhw_sampler_data *rhw_context_sampler(const struct rhw_context *context, rhw_sampler id,
                                             const char *where)
{
    if (!check_context(context, where)) {
        return NULL;
    }
    return find(context, &context->samplers, id.index, id.generation, where);
}

struct rhw_pipeline_data *rhw_context_pipeline(const struct rhw_context *context, rhw_pipeline id,
                                               const char *where)
{
    if (!check_context(context, where)) {
        return NULL;
    }
    return find(context, &context->pipelines, id.index, id.generation, where);
}

bool rhw_context_check_idle(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index,
                            const char *where)
{
    const bool busy = context->pass_active && rhw_pool_last_use(pool, index) == context->pass_generation;
    return rhw_check(context, !busy, "%s: %s %u is used by the pass being recorded; end that first", where,
                     pool->noun, (unsigned)index);
}
