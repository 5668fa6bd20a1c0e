// SPDX-License-Identifier: MIT
// Queries are created, read and destroyed between passes, recorded in a pass, and answered when it has run.
#include "query.h"

#include <string.h>

#include "draw/assembly.h"
#include "context/context.h"
#include "draw/draw_list.h"
#include "draw/used_query.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "encoder.h"
#include "rhw/rhw.h"
#include "base/thread.h"

static const char *const kind_names[RHW_QUERY_KIND_COUNT] = {"OCCLUSION", "ANY_PASSED", "STATISTICS",
                                                             "TIMESTAMP", "TRANSFORM_FEEDBACK"};

// Between passes ---------------------------------------------------------------------------------------

static enum rhw_result create(rhw_context *context, const struct rhw_query_def *def, rhw_query *query)
{
    static const char *const where = "rhw_query_create";
    if (!rhw_check(context, def != NULL && query != NULL, "%s: def and query must not be NULL", where) ||
        !rhw_check(context, (unsigned)def->kind < RHW_QUERY_KIND_COUNT, "%s: kind is %d; it must be 0..%d",
                   where, (int)def->kind, RHW_QUERY_KIND_COUNT - 1)) {
        return RHW_ERROR_MISUSE;
    }
    rhw_query id = {.context = context->number};
    struct rhw_query_data *const data =
        rhw_pool_add(&context->memory, &context->queries, def->label, &id.index, &id.generation);
    if (data == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    data->kind = def->kind;
    *query = id;
    return RHW_OK;
}

enum rhw_result rhw_query_create(rhw_context *context, const struct rhw_query_def *def, rhw_query *query)
{
    if (query != NULL) {
        *query = (rhw_query){0};
    }
    if (!rhw_context_enter(context, "rhw_query_create")) {
        return RHW_ERROR_MISUSE;
    }
    context->definition = def != NULL ? def->label : NULL;
    const enum rhw_result result = create(context, def, query);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}

// A pass under way that uses the query goes on counting for it, and finds at its end that the query is gone.
void rhw_query_destroy(rhw_context *context, rhw_query query)
{
    static const char *const where = "rhw_query_destroy";
    if (query.index == 0 || !rhw_context_enter(context, where)) {
        return;
    }
    if (rhw_context_query(context, query, where) != NULL) {
        rhw_pool_remove(&context->memory, &context->queries, query.index);
    }
    rhw_context_leave(context);
}

static enum rhw_result read(const rhw_context *context, rhw_query query, struct rhw_query_counts *counts)
{
    static const char *const where = "rhw_query_read";
    const struct rhw_query_data *const data = rhw_context_query(context, query, where);
    if (!data || !rhw_check(context, counts != NULL, "%s: counts is NULL", where)) {
        return RHW_ERROR_MISUSE;
    }
    const bool is_recorded = context->recording.active && data->pass == context->recording.generation;
    if (!rhw_check(context, data->is_answered,
                   is_recorded ? "%s: %s is used by the pass being recorded; end it first"
                               : "%s: %s has no answer; no pass that used it has ended with success",
                   where, rhw_name_of(&context->queries, query.index).text)) {
        return RHW_ERROR_MISUSE;
    }
    *counts = data->counts;
    return RHW_OK;
}

enum rhw_result rhw_query_read(rhw_context *context, rhw_query query, struct rhw_query_counts *counts)
{
    if (counts != NULL) {
        *counts = (struct rhw_query_counts){0};
    }
    if (!rhw_context_enter(context, "rhw_query_read")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = read(context, query, counts);
    rhw_context_leave(context);
    return result;
}

// Recording --------------------------------------------------------------------------------------------

static struct rhw_used_query *active(const struct rhw_encoder *encoder, enum rhw_query_kind kind)
{
    return encoder->pending.queries ? encoder->pending.queries->of[kind] : NULL;
}

// Make `query` the query of `kind` that is under way. NULL means that none is.
static void set_active(struct rhw_encoder *encoder, enum rhw_query_kind kind, struct rhw_used_query *query)
{
    struct rhw_active_queries *const queries =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *queries, _Alignof(struct rhw_active_queries));
    if (!queries) {
        encoder->out_of_memory = true;
        return;
    }
    *queries = encoder->pending.queries ? *encoder->pending.queries : (struct rhw_active_queries){0};
    queries->of[kind] = query;
    bool any = false;
    for (int i = 0; i < RHW_QUERY_KIND_COUNT; i++) {
        any |= queries->of[i] != NULL;
    }
    encoder->pending.queries = any ? queries : NULL;
    encoder->pending.depth_setting.counts = queries->of[RHW_QUERY_OCCLUSION] ||
                                            queries->of[RHW_QUERY_ANY_PASSED] ||
                                            queries->of[RHW_QUERY_STATISTICS];
    encoder->pending.depth_setting.many_samples = encoder->pass->target.pattern->count > 1;
    encoder->pending_changed = true;
}

static bool same_query(rhw_query a, rhw_query b)
{
    return a.index == b.index && a.generation == b.generation;
}

// Return true if the pass being recorded has used a query. A recording does not note it in the query.
static bool is_used(const struct rhw_encoder *encoder, rhw_query id, const struct rhw_query_data *data)
{
    const struct rhw_used_query *query = encoder->pass->queries;
    while (encoder->context->uses && query && !same_query(query->id, id)) {
        query = query->next;
    }
    return encoder->context->uses ? query != NULL : data->pass == encoder->context->recording.generation;
}

// Return the record of a query that the pass uses for the first time. Return NULL where the pass has used it before,
// which is misuse, or when out of memory.
static struct rhw_used_query *use(struct rhw_encoder *encoder, rhw_query id, struct rhw_query_data *data,
                                  const char *where)
{
    struct rhw_context *const context = encoder->context;
    if (!rhw_check(context, !is_used(encoder, id, data),
                   "%s: %s was used in this pass; a query is used once in a pass", where,
                   rhw_name_of(&context->queries, id.index).text)) {
        return NULL;
    }
    struct rhw_used_query *const query =
        rhw_arena_alloc(&encoder->pass->arena, sizeof *query, RHW_CACHE_LINE);
    if (!query) {
        encoder->out_of_memory = true;
        return NULL;
    }
    memset(query, 0, sizeof *query);
    query->id = id;
    query->kind = data->kind;
    query->next = encoder->pass->queries;
    encoder->pass->queries = query;
    if (!context->uses) {
        data->pass = context->recording.generation;
        data->is_answered = false;
    }
    return query;
}

static void begin(struct rhw_encoder *encoder, rhw_query id)
{
    static const char *const where = "rhw_pass_begin_query";
    struct rhw_context *const context = encoder->context;
    struct rhw_query_data *const data = rhw_context_query(context, id, where);
    if (!data ||
        !rhw_check(context, data->kind != RHW_QUERY_TIMESTAMP,
                   "%s: %s is of kind TIMESTAMP; it is for rhw_pass_write_timestamp", where,
                   rhw_name_of(&context->queries, id.index).text) ||
        !rhw_check(context, !active(encoder, data->kind),
                   "%s: %s is of kind %s; one of that kind is under way", where,
                   rhw_name_of(&context->queries, id.index).text, kind_names[data->kind])) {
        return;
    }
    struct rhw_used_query *const query = use(encoder, id, data, where);
    if (query) {
        set_active(encoder, data->kind, query);
    }
}

void rhw_pass_begin_query(rhw_context *context, rhw_pass id, rhw_query query)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_begin_query");
    if (encoder) {
        begin(encoder, query);
        rhw_context_leave(context);
    }
}

static void end(struct rhw_encoder *encoder, rhw_query id)
{
    static const char *const where = "rhw_pass_end_query";
    struct rhw_context *const context = encoder->context;
    const struct rhw_query_data *const data = rhw_context_query(context, id, where);
    if (!data || encoder->out_of_memory) {
        return;
    }
    const struct rhw_used_query *const query = active(encoder, data->kind);
    if (rhw_check(context, query && same_query(query->id, id), "%s: %s is not under way; begin it first",
                  where, rhw_name_of(&context->queries, id.index).text)) {
        set_active(encoder, data->kind, NULL);
    }
}

void rhw_pass_end_query(rhw_context *context, rhw_pass id, rhw_query query)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_end_query");
    if (encoder) {
        end(encoder, query);
        rhw_context_leave(context);
    }
}

static void write_timestamp(struct rhw_encoder *encoder, rhw_query id)
{
    static const char *const where = "rhw_pass_write_timestamp";
    struct rhw_context *const context = encoder->context;
    struct rhw_query_data *const data = rhw_context_query(context, id, where);
    if (!data ||
        !rhw_check(context, data->kind == RHW_QUERY_TIMESTAMP, "%s: %s is of kind %s; it must be TIMESTAMP",
                   where, rhw_name_of(&context->queries, id.index).text, kind_names[data->kind])) {
        return;
    }
    struct rhw_used_query *const query = use(encoder, id, data, where);
    if (query) {
        query->place = encoder->pass->triangle_count;
    }
}

void rhw_pass_write_timestamp(rhw_context *context, rhw_pass id, rhw_query query)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_write_timestamp");
    if (encoder) {
        write_timestamp(encoder, query);
        rhw_context_leave(context);
    }
}

void rhw_queries_count_draw(const struct rhw_draw *draw, uint32_t count)
{
    struct rhw_used_query *const query = draw->state->queries->of[RHW_QUERY_STATISTICS];
    if (query) {
        struct rhw_pipeline_statistics *const statistics = &query->counts.statistics;
        const uint64_t primitives = (uint64_t)draw->triangles_per_instance * draw->instances;
        const uint64_t vertices = rhw_assembly_vertices(draw, count) * draw->instances;
        statistics->input_assembly_vertices += vertices;
        statistics->vertex_shader_invocations += vertices;
        statistics->input_assembly_primitives += primitives;
        statistics->clipping_invocations += primitives;
    }
}

void rhw_queries_count_feedback(const struct rhw_draw *draw, uint64_t written, uint64_t needed)
{
    const struct rhw_active_queries *const queries = draw->state->queries;
    struct rhw_used_query *const query = queries ? queries->of[RHW_QUERY_TRANSFORM_FEEDBACK] : NULL;
    if (query) {
        query->counts.primitives_written += written;
        query->counts.primitives_needed += needed;
    }
}

void rhw_queries_check_ended(const struct rhw_encoder *encoder, const char *where)
{
    const struct rhw_context *const context = encoder->context;
    for (int kind = 0; kind < RHW_QUERY_KIND_COUNT && !encoder->out_of_memory; kind++) {
        const struct rhw_used_query *const query = active(encoder, (enum rhw_query_kind)kind);
        if (query && rhw_pool_get(&context->queries, query->id.index, query->id.generation)) {
            rhw_misuse(context, "%s: %s was begun and not ended", where,
                       rhw_name_of(&context->queries, query->id.index).text);
            return;
        }
    }
}

// After running ----------------------------------------------------------------------------------------

void rhw_queries_begin(struct rhw_context *context, struct rhw_recorded_pass *pass)
{
    for (struct rhw_used_query *query = pass->queries; query; query = query->next) {
        struct rhw_query_data *const data =
            rhw_pool_get(&context->queries, query->id.index, query->id.generation);
        if (data) {
            data->pass = context->recording.generation;
            data->is_answered = false;
        }
        query->counts = query->recorded;
        atomic_store_explicit(&query->samples, 0, memory_order_relaxed);
        atomic_store_explicit(&query->fragments, 0, memory_order_relaxed);
    }
}

void rhw_queries_keep(struct rhw_recorded_pass *pass)
{
    for (struct rhw_used_query *query = pass->queries; query; query = query->next) {
        query->recorded = query->counts;
    }
}

void rhw_queries_answer(struct rhw_context *context, const struct rhw_recorded_pass *pass)
{
    for (struct rhw_used_query *query = pass->queries; query; query = query->next) {
        struct rhw_query_data *const data =
            rhw_pool_get(&context->queries, query->id.index, query->id.generation);
        if (!data) {
            continue;
        }
        const uint64_t samples = atomic_load_explicit(&query->samples, memory_order_relaxed);
        data->counts = query->counts;
        data->is_answered = true;
        switch (query->kind) {
        case RHW_QUERY_OCCLUSION: data->counts.samples_passed = samples; break;
        case RHW_QUERY_ANY_PASSED: data->counts.any_passed = samples != 0; break;
        case RHW_QUERY_STATISTICS:
            data->counts.statistics.fragment_shader_invocations =
                atomic_load_explicit(&query->fragments, memory_order_relaxed);
            break;
        default: break;
        }
    }
}
