// SPDX-License-Identifier: MIT
// The life of a pipeline: it is created from a definition, and destroyed.
#include "pipeline.h"

#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "pipeline_check.h"
#include "rhw/rhw.h"

void rhw_pipeline_data_release(struct rhw_memory *memory, struct rhw_pipeline_data *data)
{
    rhw_memory_release(memory, data->validator, data->validator_size);
}

static enum rhw_result create(struct rhw_context *context, const struct rhw_pipeline_def *def, uint32_t flaws,
                              rhw_pipeline *pipeline)
{
    if (!rhw_pipeline_check(context, def, flaws, pipeline)) {
        return RHW_ERROR_MISUSE;
    }
    if (context->validation) {
        rhw_pipeline_warn(context, def);
    }
    rhw_pipeline id = {.context = context->number};
    struct rhw_pipeline_data *const data =
        rhw_pool_add(&context->memory, &context->pipelines, def->label, &id.index, &id.generation);
    if (data == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    rhw_pipeline_data_init(data, def, context->isa);
    rhw_pipeline_tell_copies(context, context->isa, &def->program);
    if (context->validate_pipeline &&
        !context->validate_pipeline(context, data, rhw_name_of(&context->pipelines, id.index).text)) {
        rhw_pool_remove(&context->memory, &context->pipelines, id.index);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *pipeline = id;
    return RHW_OK;
}

enum rhw_result rhw_pipeline_create_probed(rhw_context *context, const struct rhw_pipeline_def *def,
                                           uint32_t flaws, rhw_pipeline *pipeline)
{
    if (pipeline != NULL) {
        *pipeline = (rhw_pipeline){0};
    }
    if (!rhw_context_enter(context, "rhw_pipeline_create")) {
        return RHW_ERROR_MISUSE;
    }
    context->definition = def != NULL ? def->label : NULL;
    const enum rhw_result result = create(context, def, flaws, pipeline);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}

void rhw_pipeline_destroy(rhw_context *context, rhw_pipeline pipeline)
{
    static const char *const where = "rhw_pipeline_destroy";
    if (pipeline.index == 0 || !rhw_context_enter(context, where)) {
        return;
    }
    struct rhw_pipeline_data *const data = rhw_context_pipeline(context, pipeline, where);
    if (data != NULL && rhw_context_records(context, &context->pipelines, pipeline.index)) {
        rhw_pool_retire(&context->memory, &context->pipelines, pipeline.index);
    } else if (data != NULL) {
        rhw_pipeline_data_release(&context->memory, data);
        rhw_pool_remove(&context->memory, &context->pipelines, pipeline.index);
    }
    rhw_context_leave(context);
}
