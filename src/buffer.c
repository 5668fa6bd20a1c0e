// SPDX-License-Identifier: MIT
// Buffers: bytes that draws read as vertices and indices.
#include "buffer.h"

#include <string.h>

#include "constants.h"
#include "context.h"
#include "lookup.h"
#include "memory.h"
#include "misuse.h"
#include "rhw/rhw.h"

void rhw_buffer_data_release(struct rhw_memory *memory, struct rhw_buffer_data *data)
{
    if (data->bytes != NULL) {
        rhw_memory_release(memory, data->bytes, data->size + RHW_BUFFER_PADDING);
    }
}

static bool check_create(const struct rhw_context *context, const struct rhw_buffer_def *def,
                         const rhw_buffer *buffer)
{
    static const char *const where = "rhw_buffer_create";
    return rhw_check(context, context != NULL, "%s: context is NULL", where) &&
           rhw_check(context, def != NULL, "%s: def is NULL", where) &&
           rhw_check(context, buffer != NULL, "%s: buffer is NULL", where) &&
           rhw_check(context, def->size >= 1, "%s: size is 0; it must be at least 1 byte", where);
}

// Fills a new item; false when out of memory.
static bool fill(struct rhw_memory *memory, struct rhw_buffer_data *data, const struct rhw_buffer_def *def)
{
    if (def->size > SIZE_MAX - RHW_BUFFER_PADDING) {
        return false;
    }
    const size_t size = def->size + RHW_BUFFER_PADDING;
    data->bytes = def->data != NULL ? rhw_memory_allocate(memory, size, RHW_CACHE_LINE)
                                    : rhw_memory_allocate_zeroed(memory, size, RHW_CACHE_LINE);
    if (data->bytes == NULL) {
        return false;
    }
    data->size = def->size;
    if (def->data != NULL) {
        memcpy(data->bytes, def->data, def->size);
        memset(data->bytes + def->size, 0, RHW_BUFFER_PADDING);
    }
    return true;
}

enum rhw_result rhw_buffer_create(rhw_context *context, const struct rhw_buffer_def *def, rhw_buffer *buffer)
{
    if (buffer != NULL) {
        *buffer = (rhw_buffer){0, 0};
    }
    if (!check_create(context, def, buffer)) {
        return RHW_ERROR_MISUSE;
    }
    rhw_buffer id;
    struct rhw_buffer_data *const data =
        rhw_pool_add(&context->memory, &context->buffers, &id.index, &id.generation);
    if (data == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    if (!fill(&context->memory, data, def)) {
        rhw_pool_remove(&context->buffers, id.index);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *buffer = id;
    return RHW_OK;
}

void rhw_buffer_destroy(rhw_context *context, rhw_buffer buffer)
{
    struct rhw_buffer_data *const data = rhw_context_buffer(context, buffer, "rhw_buffer_destroy");
    if (data == NULL ||
        !rhw_context_check_idle(context, &context->buffers, buffer.index, "rhw_buffer_destroy")) {
        return;
    }
    rhw_buffer_data_release(&context->memory, data);
    rhw_pool_remove(&context->buffers, buffer.index);
}

void rhw_buffer_write(rhw_context *context, rhw_buffer buffer, size_t offset, const void *data, size_t size)
{
    static const char *const where = "rhw_buffer_write";
    struct rhw_buffer_data *const target = rhw_context_buffer(context, buffer, where);
    if (target == NULL || !rhw_context_check_idle(context, &context->buffers, buffer.index, where)) {
        return;
    }
    if (!rhw_check(context, offset <= target->size && size <= target->size - offset,
                   "%s: offset is %zu and size is %zu; together they must stay within the buffer's %zu bytes",
                   where, offset, size, target->size) ||
        !rhw_check(context, data != NULL || size == 0, "%s: data is NULL; it must point to %zu bytes", where,
                   size)) {
        return;
    }
    if (size != 0) {
        memcpy(target->bytes + offset, data, size);
    }
}
