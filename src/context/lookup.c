// SPDX-License-Identifier: MIT
// Pools find items. This file reports an id that names none.
#include "lookup.h"

#include <stdio.h>

#include "context.h"
#include "misuse.h"

// The members that all kinds of ids have.
struct id {
    uint32_t index, generation, context;
};

// Return the name of an item in messages. `label` may be NULL.
static struct rhw_name write_name(const char *noun, uint32_t index, const char *label)
{
    struct rhw_name name;
    if (label != NULL) {
        snprintf(name.text, sizeof name.text, "%s %u \"%s\"", noun, (unsigned)index, label);
    } else {
        snprintf(name.text, sizeof name.text, "%s %u", noun, (unsigned)index);
    }
    return name;
}

static __attribute__((cold)) void report(const struct rhw_context *context, const struct rhw_pool *pool,
                                         struct id id, const char *where)
{
    const char *const noun = pool->noun;
    if (id.index == 0) {
        rhw_misuse(context, "%s: the %s id is null", where, noun);
    } else if (id.context != context->number) {
        rhw_misuse(context, "%s: %s %u belongs to another context", where, noun, (unsigned)id.index);
    } else if (id.index > pool->slots) {
        rhw_misuse(context, "%s: %s %u (generation %u) was never created", where, noun, (unsigned)id.index,
                   (unsigned)id.generation);
    } else {
        const char *const label = rhw_pool_stale_label(pool, id.index, id.generation);
        const struct rhw_name name = write_name(noun, id.index, label);
        rhw_misuse(context, "%s: %s (generation %u) is stale: it was destroyed", where, name.text,
                   (unsigned)id.generation);
    }
}

static void *find(const struct rhw_context *context, const struct rhw_pool *pool, struct id id,
                  const char *where)
{
    void *item = id.context == context->number ? rhw_pool_get(pool, id.index, id.generation) : NULL;
    if (item == NULL && context->owner != NULL) {
        rhw_recorder_look_at_pools((struct rhw_context *)context);
        item = id.context == context->number ? rhw_pool_get(pool, id.index, id.generation) : NULL;
    }
    if (item == NULL) {
        report(context, pool, id, where);
    }
    return item;
}

void *rhw_context_item(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index,
                       uint32_t generation, const char *where)
{
    return find(context, pool, (struct id){index, generation, context->number}, where);
}

void rhw_recorder_look_at_pools(struct rhw_context *recorder)
{
    rhw_pool_view(&recorder->buffers, &recorder->owner->buffers);
    rhw_pool_view(&recorder->textures, &recorder->owner->textures);
    rhw_pool_view(&recorder->samplers, &recorder->owner->samplers);
    rhw_pool_view(&recorder->pipelines, &recorder->owner->pipelines);
    rhw_pool_view(&recorder->queries, &recorder->owner->queries);
}

struct rhw_buffer_data *rhw_context_buffer(const struct rhw_context *context, rhw_buffer id,
                                           const char *where)
{
    return find(context, &context->buffers, (struct id){id.index, id.generation, id.context}, where);
}

struct rhw_texture_data *rhw_context_texture(const struct rhw_context *context, rhw_texture id,
                                             const char *where)
{
    struct rhw_texture_data *const *const item =
        find(context, &context->textures, (struct id){id.index, id.generation, id.context}, where);
    return item != NULL ? *item : NULL;
}

struct rhw_sampler_data *rhw_context_sampler(const struct rhw_context *context, rhw_sampler id,
                                             const char *where)
{
    return find(context, &context->samplers, (struct id){id.index, id.generation, id.context}, where);
}

struct rhw_pipeline_data *rhw_context_pipeline(const struct rhw_context *context, rhw_pipeline id,
                                               const char *where)
{
    return find(context, &context->pipelines, (struct id){id.index, id.generation, id.context}, where);
}

struct rhw_query_data *rhw_context_query(const struct rhw_context *context, rhw_query id, const char *where)
{
    return find(context, &context->queries, (struct id){id.index, id.generation, id.context}, where);
}

struct rhw_name rhw_name_of(const struct rhw_pool *pool, uint32_t index)
{
    return write_name(pool->noun, index, rhw_pool_label(pool, index));
}

bool rhw_context_records(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index)
{
    return context->recording.active && rhw_pool_last_use(pool, index) == context->recording.generation;
}

bool rhw_context_draws_read(const struct rhw_context *context, const struct rhw_pool *pool, uint32_t index,
                            uint32_t renewed_pass, uint32_t renewed_draws)
{
    const struct rhw_recording_place *const recording = &context->recording;
    const uint32_t before = renewed_pass == recording->generation ? renewed_draws : 0;
    return rhw_context_records(context, pool, index) && recording->draw > before;
}
