// SPDX-License-Identifier: MIT
// Buffers: bytes that draws read as vertices and indices.
#include "buffer.h"

#include <string.h>

#include "constants.h"
#include "context.h"
#include "entry.h"
#include "lookup.h"
#include "memory.h"
#include "misuse.h"
#include "rhw/rhw.h"

void rhw_buffer_data_release(struct rhw_memory *memory, struct rhw_buffer_data *data)
{
    if (data->bytes != NULL && !data->is_callers) {
        rhw_memory_release(memory, data->bytes, data->size + RHW_BUFFER_PADDING);
    }
}

_Static_assert((int)RHW_BUFFER_PADDING == (int)RHW_MEMORY_PADDING, "what rhw_buffer_def says");

static bool check_create(const struct rhw_context *context, const struct rhw_buffer_def *def,
                         const rhw_buffer *buffer, const char *where)
{
    return rhw_check(context, def != NULL, "%s: def is NULL", where) &&
           rhw_check(context, buffer != NULL, "%s: buffer is NULL", where) &&
           rhw_check(context, def->size >= 1, "%s: size is 0; it must be at least 1 byte", where) &&
           rhw_check(context, (uintptr_t)def->memory % RHW_MEMORY_ALIGNMENT == 0,
                     "%s: memory is %p; its address must be a multiple of %d", where, def->memory,
                     RHW_MEMORY_ALIGNMENT) &&
           rhw_check(context,
                     def->memory == NULL || (def->memory_size >= RHW_BUFFER_PADDING &&
                                             def->size <= def->memory_size - RHW_BUFFER_PADDING),
                     "%s: memory_size is %zu; %zu bytes need %d more", where, def->memory_size, def->size,
                     RHW_BUFFER_PADDING);
}

// Zeroed, or undefined when something will be copied there; NULL when out of memory.
static unsigned char *allocate_bytes(struct rhw_memory *memory, size_t size, bool zeroed)
{
    if (size > SIZE_MAX - RHW_BUFFER_PADDING) {
        return NULL;
    }
    return zeroed ? rhw_memory_allocate_zeroed(memory, size + RHW_BUFFER_PADDING, RHW_CACHE_LINE)
                  : rhw_memory_allocate(memory, size + RHW_BUFFER_PADDING, RHW_CACHE_LINE);
}

// Fills a new item; false when out of memory.
static bool fill(struct rhw_memory *memory, struct rhw_buffer_data *data, const struct rhw_buffer_def *def)
{
    data->is_callers = def->memory != NULL;
    data->bytes = data->is_callers ? def->memory : allocate_bytes(memory, def->size, def->data == NULL);
    if (data->bytes == NULL) {
        return false;
    }
    data->size = def->size;
    if (def->data != NULL) {
        memcpy(data->bytes, def->data, def->size);
    }
    if (def->data != NULL || data->is_callers) {
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

bool rhw_buffer_check_readable(const struct rhw_context *context, rhw_buffer buffer,
                               const struct rhw_buffer_data *data, const char *where)
{
    return rhw_check(context,
                     !context->recording.active || data->stored_pass != context->recording.generation,
                     "%s: %s is a storage buffer of this pass; end the pass first", where,
                     rhw_name_of(&context->buffers, buffer.index).text) &&
           rhw_check(context,
                     !context->recording.active || data->captured_pass != context->recording.generation,
                     "%s: %s is written by the transform feedback of this pass; end the pass first", where,
                     rhw_name_of(&context->buffers, buffer.index).text);
}

bool rhw_buffer_check_unmapped(const struct rhw_context *context, rhw_buffer buffer,
                               const struct rhw_buffer_data *data, const char *where)
{
    return rhw_check(context, !data->is_mapped, "%s: %s is mapped; call rhw_buffer_unmap first", where,
                     rhw_name_of(&context->buffers, buffer.index).text);
}

bool rhw_buffer_check_writable(const struct rhw_context *context, rhw_buffer buffer,
                               const struct rhw_buffer_data *data, const char *where)
{
    return rhw_buffer_check_readable(context, buffer, data, where) &&
           rhw_buffer_check_unmapped(context, buffer, data, where) &&
           rhw_check(context,
                     !data->is_callers || !rhw_context_records(context, &context->buffers, buffer.index),
                     "%s: %s stands on memory of the program and the pass being recorded uses it; end that "
                     "first",
                     where, rhw_name_of(&context->buffers, buffer.index).text);
}

bool rhw_buffer_check_drawable(const struct rhw_context *context, rhw_buffer buffer,
                               const struct rhw_buffer_data *data, const char *where)
{
    return rhw_check(context, !data->is_map_written,
                     "%s: %s is mapped for writing; call rhw_buffer_unmap first", where,
                     rhw_name_of(&context->buffers, buffer.index).text);
}

// Gives the buffer new memory; draws that were recorded keep the old one. The bytes that will not be written are copied.
// False when out of memory.
static bool renew(struct rhw_context *context, uint32_t index, struct rhw_buffer_data *data, size_t written)
{
    unsigned char *const bytes = allocate_bytes(&context->memory, data->size, false);
    if (bytes == NULL) {
        return false;
    }
    if (!rhw_pool_retire_copy(&context->memory, &context->buffers, index)) {
        rhw_memory_release(&context->memory, bytes, data->size + RHW_BUFFER_PADDING);
        return false;
    }
    if (written < data->size) {
        memcpy(bytes, data->bytes, data->size);
    }
    memset(bytes + data->size, 0, RHW_BUFFER_PADDING);
    data->bytes = bytes;
    data->renewed_pass = context->recording.generation;
    data->renewed_draws = context->recording.draw;
    context->recording.rewrites++;
    return true;
}

bool rhw_buffer_to_write(struct rhw_context *context, uint32_t index, struct rhw_buffer_data *data,
                         size_t written)
{
    return !rhw_context_draws_read(context, &context->buffers, index, data->renewed_pass,
                                   data->renewed_draws) ||
           renew(context, index, data, written);
}

static enum rhw_result write_bytes(struct rhw_context *context, rhw_buffer buffer, size_t offset,
                                   const void *data, size_t size)
{
    static const char *const where = "rhw_buffer_write";
    struct rhw_buffer_data *const target = rhw_context_buffer(context, buffer, where);
    if (target == NULL || !rhw_buffer_check_range(context, buffer, target, offset, size, where) ||
        !rhw_buffer_check_writable(context, buffer, target, where) ||
        !rhw_check(context, data != NULL || size == 0, "%s: data is NULL; it must point to %zu bytes", where,
                   size)) {
        return RHW_ERROR_MISUSE;
    }
    if (size == 0) {
        return RHW_OK;
    }
    if (!rhw_buffer_to_write(context, buffer.index, target, size)) {
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
    const struct rhw_buffer_data *const source = rhw_context_buffer(context, buffer, where);
    const bool valid = source != NULL &&
                       rhw_buffer_check_range(context, buffer, source, offset, size, where) &&
                       rhw_buffer_check_readable(context, buffer, source, where) &&
                       rhw_check(context, data != NULL || size == 0,
                                 "%s: data is NULL; it must point to %zu bytes", where, size);
    if (valid && size != 0) {
        memcpy(data, source->bytes + offset, size);
    }
    rhw_context_leave(context);
    return valid ? RHW_OK : RHW_ERROR_MISUSE;
}
