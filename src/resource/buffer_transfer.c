// SPDX-License-Identifier: MIT
// Buffers are filled, copied and mapped here.
#include <string.h>

#include "buffer.h"
#include "buffer_access.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "rhw/rhw.h"

static enum rhw_result fill(struct rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                            uint32_t word)
{
    static const char *const where = "rhw_buffer_fill";
    struct rhw_buffer_data *const data = rhw_context_buffer(context, buffer, where);
    if (!data || !rhw_buffer_check_range(context, buffer, data, offset, size, where) ||
        !rhw_check(context, offset % sizeof word == 0 && size % sizeof word == 0,
                   "%s: offset is %zu and size is %zu; they are multiples of 4", where, offset, size)) {
        return RHW_ERROR_MISUSE;
    }
    const size_t words = (size == 0 ? data->size - offset : size) / sizeof word;
    const struct rhw_buffer_part part = {buffer, data, RHW_BUFFER_WRITTEN, offset,
                                         offset + words * sizeof word};
    if (!rhw_buffer_check_writable(context, &part, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (words == 0) {
        return RHW_OK;
    }
    if (!rhw_buffer_to_write(context, &part, words * sizeof word)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    const unsigned char bytes[] = {(unsigned char)word, (unsigned char)(word >> 8),
                                   (unsigned char)(word >> 16), (unsigned char)(word >> 24)};
    unsigned char *const first = data->bytes + offset;
    for (size_t i = 0; i < words; i++) {
        memcpy(first + i * sizeof word, bytes, sizeof word);
    }
    return RHW_OK;
}

enum rhw_result rhw_buffer_fill(rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                                uint32_t word)
{
    if (!rhw_context_enter(context, "rhw_buffer_fill")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = fill(context, buffer, offset, size, word);
    rhw_context_leave(context);
    return result;
}

static enum rhw_result copy(struct rhw_context *context, rhw_buffer from, size_t from_offset, rhw_buffer to,
                            size_t to_offset, size_t size)
{
    static const char *const where = "rhw_buffer_copy";
    struct rhw_buffer_data *const source = rhw_context_buffer(context, from, where);
    struct rhw_buffer_data *const target = source ? rhw_context_buffer(context, to, where) : NULL;
    const struct rhw_buffer_part read = {from, source, RHW_BUFFER_READ, from_offset, from_offset + size};
    const struct rhw_buffer_part written = {to, target, RHW_BUFFER_WRITTEN, to_offset, to_offset + size};
    if (!target || !rhw_buffer_check_range(context, from, source, from_offset, size, where) ||
        !rhw_buffer_check_range(context, to, target, to_offset, size, where) ||
        !rhw_buffer_check_readable(context, &read, where) ||
        !rhw_check(context,
                   source != target || from_offset + size <= to_offset || to_offset + size <= from_offset,
                   "%s: bytes %zu and %zu of %s are copied to each other, %zu of them; they must not overlap",
                   where, from_offset, to_offset, rhw_name_of(&context->buffers, to.index).text, size) ||
        !rhw_buffer_check_writable(context, &written, where)) {
        return RHW_ERROR_MISUSE;
    }
    if (size == 0) {
        return RHW_OK;
    }
    if (!rhw_buffer_to_write(context, &written, size)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    memcpy(target->bytes + to_offset, source->bytes + from_offset, size);
    return RHW_OK;
}

enum rhw_result rhw_buffer_copy(rhw_context *context, rhw_buffer from, size_t from_offset, rhw_buffer to,
                                size_t to_offset, size_t size)
{
    if (!rhw_context_enter(context, "rhw_buffer_copy")) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = copy(context, from, from_offset, to, to_offset, size);
    rhw_context_leave(context);
    return result;
}

static void *map(struct rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                 enum rhw_map_access access)
{
    static const char *const where = "rhw_buffer_map";
    struct rhw_buffer_data *const buffer_data = rhw_context_buffer(context, buffer, where);
    if (!buffer_data || !rhw_buffer_check_range(context, buffer, buffer_data, offset, size, where) ||
        !rhw_check(context, (unsigned)access <= RHW_MAP_READ, "%s: access is %d; not an access", where,
                   (int)access) ||
        !rhw_check(context, !buffer_data->is_mapped, "%s: %s is mapped already", where,
                   rhw_name_of(&context->buffers, buffer.index).text)) {
        return NULL;
    }
    const enum rhw_buffer_use use = access == RHW_MAP_READ ? RHW_BUFFER_READ : RHW_BUFFER_WRITTEN;
    const struct rhw_buffer_part part = {buffer, buffer_data, use, offset,
                                         size == 0 ? buffer_data->size : offset + size};
    if (!rhw_buffer_check_use(context, &part, where)) {
        return NULL;
    }
    buffer_data->is_mapped = true;
    buffer_data->is_map_written = access != RHW_MAP_READ;
    buffer_data->map_first = part.first;
    buffer_data->map_end = part.end;
    return buffer_data->bytes + offset;
}

enum rhw_result rhw_buffer_map(rhw_context *context, rhw_buffer buffer, size_t offset, size_t size,
                               enum rhw_map_access access, void **data)
{
    static const char *const where = "rhw_buffer_map";
    if (data) {
        *data = NULL;
    }
    if (!rhw_context_enter(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    void *const bytes = rhw_check(context, data != NULL, "%s: data is NULL", where)
                            ? map(context, buffer, offset, size, access)
                            : NULL;
    if (bytes) {
        *data = bytes;
    }
    rhw_context_leave(context);
    return bytes ? RHW_OK : RHW_ERROR_MISUSE;
}

void rhw_buffer_unmap(rhw_context *context, rhw_buffer buffer)
{
    static const char *const where = "rhw_buffer_unmap";
    if (!rhw_context_enter(context, where)) {
        return;
    }
    struct rhw_buffer_data *const data = rhw_context_buffer(context, buffer, where);
    if (data && rhw_check(context, data->is_mapped, "%s: %s is not mapped", where,
                          rhw_name_of(&context->buffers, buffer.index).text)) {
        data->writes += data->is_map_written;
        data->is_mapped = data->is_map_written = false;
    }
    rhw_context_leave(context);
}
