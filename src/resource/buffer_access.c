// SPDX-License-Identifier: MIT
// What recorded draws read is kept: a buffer that is written between them gets new memory.
#include "buffer_access.h"

#include <string.h>

#include "buffer.h"
#include "context/context.h"
#include "context/lookup.h"
#include "base/memory.h"
#include "context/misuse.h"

bool rhw_buffer_check_readable(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where)
{
    return rhw_buffer_check_unused(context, part, RHW_BUFFER_STORED, where) &&
           rhw_buffer_check_unused(context, part, RHW_BUFFER_CAPTURED, where);
}

bool rhw_buffer_check_unmapped(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where)
{
    const struct rhw_buffer_data *const data = part->data;
    const bool is_read = part->use == RHW_BUFFER_READ;
    const bool is_asked = is_read ? data->is_map_written : data->is_mapped;
    const bool is_apart =
        part->first == part->end || part->end <= data->map_first || data->map_end <= part->first;
    return rhw_check(context, !is_asked || is_apart,
                     "%s: bytes %zu to %zu of %s are mapped%s; call rhw_buffer_unmap first", where,
                     data->map_first, data->map_end, rhw_name_of(&context->buffers, part->id.index).text,
                     is_read ? " for writing" : "");
}

bool rhw_buffer_check_writable(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where)
{
    const struct rhw_name name = rhw_name_of(&context->buffers, part->id.index);
    struct rhw_buffer_data *const data = part->data;
    if (!rhw_check(context, !data->is_mapped, "%s: %s is mapped; call rhw_buffer_unmap first", where,
                   name.text) ||
        !rhw_buffer_check_readable(context, part, where)) {
        return false;
    }
    // A buffer whose bytes the pass reads would get new memory. A buffer that the pass also writes cannot: the pass
    // would have to write the new memory too.
    return !rhw_buffer_is_read(context, part) ||
           (rhw_check(context, !data->is_bound || data->is_callers,
                      "%s: %s has a binding and the pass being recorded reads some of bytes %zu to %zu; end "
                      "that first",
                      where, name.text, part->first, part->end) &&
            rhw_check(context, !data->is_callers,
                      "%s: %s stands on memory of the program and the pass being recorded reads some of "
                      "bytes %zu to %zu; end that first",
                      where, name.text, part->first, part->end) &&
            rhw_check(context, !rhw_buffer_is_written(context, data),
                      "%s: it writes bytes %zu to %zu of %s; this pass reads some of them and may write "
                      "others; end the pass first",
                      where, part->first, part->end, name.text));
}

// Give the buffer new memory. Draws that were recorded keep the old memory. The bytes that will not be written are
// copied. Return false when out of memory.
static bool renew(struct rhw_context *context, uint32_t index, struct rhw_buffer_data *data, size_t written)
{
    unsigned char *const bytes = rhw_buffer_allocate(&context->memory, data->size, false);
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
    data->moves++;
    data->renewed_pass = context->recording.generation;
    data->renewed_draws = context->recording.draw;
    context->recording.rewrites++;
    return true;
}

bool rhw_buffer_to_write(struct rhw_context *context, const struct rhw_buffer_part *part, size_t written)
{
    struct rhw_buffer_data *const data = part->data;
    data->writes++;
    return !rhw_buffer_is_read(context, part) ||
           !rhw_context_draws_read(context, &context->buffers, part->id.index, data->renewed_pass,
                                   data->renewed_draws) ||
           (data->bound_pass != context->recording.generation && context->keep_reads(context, part)) ||
           renew(context, part->id.index, part->data, written);
}
