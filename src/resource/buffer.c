// SPDX-License-Identifier: MIT
// Buffers are created, written, read and destroyed here.
#include "buffer.h"

#include <string.h>

#include "buffer_access.h"
#include "base/constants.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "base/memory.h"
#include "context/misuse.h"
#include "rhw/rhw.h"

void rhw_buffer_data_release(struct rhw_memory *memory, struct rhw_buffer_data *data)
{
    if (data->bytes != NULL && !data->is_callers) {
        rhw_memory_release(memory, data->bytes, data->size + RHW_BUFFER_PADDING);
    }
}

static bool check_create(const struct rhw_context *context, const struct rhw_buffer_def *def,
                         const rhw_buffer *buffer, const char *where)
{
    return rhw_check(context, def != NULL, "%s: def is NULL", where) &&
           rhw_check(context, buffer != NULL, "%s: buffer is NULL", where) &&
           rhw_check(context, def->size >= 1, "%s: size is 0; it must be at least 1 byte", where) &&
           rhw_check(context, (uintptr_t)def->memory % RHW_MEMORY_ALIGNMENT == 0,
                     "%s: memory is %p; its address must be a multiple of %d", where, def->memory,
                     RHW_MEMORY_ALIGNMENT) &&
           rhw_check(context, def->memory == NULL || def->size <= def->memory_size,
                     "%s: memory_size is %zu; it must be at least size, which is %zu", where,
                     def->memory_size, def->size);
}

unsigned char *rhw_buffer_allocate(struct rhw_memory *memory, size_t size, bool zeroed)
{
    if (size > SIZE_MAX - RHW_BUFFER_PADDING) {
        return NULL;
    }
    return zeroed ? rhw_memory_allocate_zeroed(memory, size + RHW_BUFFER_PADDING, RHW_CACHE_LINE)
                  : rhw_memory_allocate(memory, size + RHW_BUFFER_PADDING, RHW_CACHE_LINE);
}

// Fill a new item. Return false when out of memory.
static bool fill(struct rhw_memory *memory, struct rhw_buffer_data *data, const struct rhw_buffer_def *def)
{
    data->is_callers = def->memory != NULL;
    data->bytes = data->is_callers ? def->memory : rhw_buffer_allocate(memory, def->size, def->data == NULL);
    if (data->bytes == NULL) {
        return false;
    }
    data->size = def->size;
    if (def->data != NULL) {
        memcpy(data->bytes, def->data, def->size);
    }
    if (def->data != NULL && !data->is_callers) {
        memset(data->bytes + def->size, 0, RHW_BUFFER_PADDING);
    }
    return true;
}

static enum rhw_result create(struct rhw_context *context, const struct rhw_buffer_def *def,
                              rhw_buffer *buffer)
{
    if (!check_create(context, def, buffer, "rhw_buffer_create")) {
        return RHW_ERROR_MISUSE;
    }
    rhw_buffer id = {.context = context->number};
    struct rhw_buffer_data *const data =
        rhw_pool_add(&context->memory, &context->buffers, def->label, &id.index, &id.generation);
    if (data == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    if (!fill(&context->memory, data, def)) {
        rhw_pool_remove(&context->memory, &context->buffers, id.index);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *buffer = id;
    return RHW_OK;
}

enum rhw_result rhw_buffer_create(rhw_context *context, const struct rhw_buffer_def *def, rhw_buffer *buffer)
{
    if (buffer != NULL) {
        *buffer = (rhw_buffer){0};
    }
    if (!rhw_context_enter(context, "rhw_buffer_create")) {
        return RHW_ERROR_MISUSE;
    }
    context->definition = def != NULL ? def->label : NULL;
    const enum rhw_result result = create(context, def, buffer);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}

void rhw_buffer_destroy(rhw_context *context, rhw_buffer buffer)
{
    static const char *const where = "rhw_buffer_destroy";
    if (buffer.index == 0 || !rhw_context_enter(context, where)) {
        return;
    }
    struct rhw_buffer_data *const data = rhw_context_buffer(context, buffer, where);
    if (data != NULL && rhw_context_records(context, &context->buffers, buffer.index)) {
        rhw_pool_retire(&context->memory, &context->buffers, buffer.index);
    } else if (data != NULL) {
        rhw_buffer_data_release(&context->memory, data);
        rhw_pool_remove(&context->memory, &context->buffers, buffer.index);
    }
    rhw_context_leave(context);
}

bool rhw_buffer_check_range(const struct rhw_context *context, rhw_buffer buffer,
                            const struct rhw_buffer_data *data, size_t offset, size_t size, const char *where)
{
    return rhw_check(context, offset <= data->size && size <= data->size - offset,
                     "%s: offset is %zu and size is %zu; together they must stay within the %zu bytes of %s",
                     where, offset, size, data->size, rhw_name_of(&context->buffers, buffer.index).text);
}

static enum rhw_result write_bytes(struct rhw_context *context, rhw_buffer buffer, size_t offset,
                                   const void *data, size_t size)
{
    static const char *const where = "rhw_buffer_write";
    struct rhw_buffer_data *const target = rhw_context_buffer(context, buffer, where);
    if (target == NULL || !rhw_buffer_check_range(context, buffer, target, offset, size, where) ||
        !rhw_check(context, data != NULL || size == 0, "%s: data is NULL; it must point to %zu bytes", where,
                   size)) {
        return RHW_ERROR_MISUSE;
    }
    const struct rhw_buffer_part part = {buffer, target, RHW_BUFFER_WRITTEN, offset, offset + size};
    if (!rhw_buffer_check_writable(context, &part, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (size == 0) {
        return RHW_OK;
    }
    if (!rhw_buffer_to_write(context, &part, size)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    memcpy(target->bytes + offset, data, size);
    return RHW_OK;
}

enum rhw_result rhw_buffer_write(rhw_context *context, rhw_buffer buffer, size_t offset, const void *data,
                                 size_t size)
{
    if (!rhw_context_enter(context, "rhw_buffer_write")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = write_bytes(context, buffer, offset, data, size);
    rhw_context_leave(context);
    return result;
}

enum rhw_result rhw_buffer_read(rhw_context *context, rhw_buffer buffer, size_t offset, void *data,
                                size_t size)
{
    static const char *const where = "rhw_buffer_read";
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    struct rhw_buffer_data *const source = rhw_context_buffer(context, buffer, where);
    const struct rhw_buffer_part part = {buffer, source, RHW_BUFFER_READ, offset, offset + size};
    const bool valid = source != NULL &&
                       rhw_buffer_check_range(context, buffer, source, offset, size, where) &&
                       rhw_buffer_check_readable(context, &part, where) &&
                       rhw_check(context, data != NULL || size == 0,
                                 "%s: data is NULL; it must point to %zu bytes", where, size);
    if (valid && size != 0) {
        memcpy(data, source->bytes + offset, size);
    }
    rhw_context_leave(context);
    return valid ? RHW_OK : RHW_ERROR_MISUSE;
}
