// SPDX-License-Identifier: MIT
// The parameters of an indirect draw stand in buffers. They are read when the draw is recorded, as everything is that a
// draw sees.
#include <string.h>

#include "resource/buffer.h"
#include "resource/buffer_access.h"
#include "context/context.h"
#include "draw/draw_list.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "indirect.h"
#include "pass.h"
#include "encoder.h"
#include "rhw/rhw.h"

// These are commands that were found in a buffer.
struct command_list {
    const unsigned char *bytes; // bytes of the first command; NULL: the call was misuse
    size_t stride;
    uint32_t count;
};

// Return how many bytes `count` things of `size` take, from the first byte of the first to the last byte of the last.
static uint64_t extent(uint32_t count, uint64_t stride, uint64_t size)
{
    return count == 0 ? 0 : (count - 1) * stride + size;
}

const unsigned char *rhw_indirect_bytes(const rhw_context *context, rhw_buffer id, size_t offset,
                                        uint64_t size, const char *name, const char *where)
{
    struct rhw_buffer_data *const buffer = rhw_context_buffer(context, id, where);
    const struct rhw_buffer_part part = {id, buffer, RHW_BUFFER_READ, offset, offset + (size_t)size};
    return buffer != NULL &&
                   rhw_check(context, offset % 4 == 0, "%s: %soffset is %zu; it must be a multiple of 4",
                             where, name, offset) &&
                   rhw_check(context, offset <= buffer->size && size <= buffer->size - offset,
                             "%s: %soffset is %zu and %llu bytes are read there; together they must stay "
                             "within the "
                             "%zu bytes of %s",
                             where, name, offset, (unsigned long long)size, buffer->size,
                             rhw_name_of(&context->buffers, id.index).text) &&
                   rhw_buffer_check_use(context, &part, where) &&
                   rhw_buffer_check_unmapped(context, &part, where)
               ? buffer->bytes + offset
               : NULL;
}

// Find the commands in their buffer. One command has `size` bytes.
static struct command_list find_commands(const rhw_context *context, const struct rhw_draw_commands *commands,
                                         size_t size, const char *where)
{
    const struct command_list misuse = {.bytes = NULL};
    if (!rhw_check(context, commands != NULL, "%s: commands is NULL", where)) {
        return misuse;
    }
    struct command_list list = {.stride = commands->stride == 0 ? size : commands->stride,
                                .count = commands->count};
    if (!rhw_check(context, list.stride >= size && list.stride % 4 == 0,
                   "%s: stride is %zu; it must be 0, or a multiple of 4 of at least %zu", where, list.stride,
                   size)) {
        return misuse;
    }
    if (commands->count_buffer.index != 0) {
        const unsigned char *const bytes = rhw_indirect_bytes(
            context, commands->count_buffer, commands->count_offset, sizeof list.count, "count_", where);
        if (bytes == NULL) {
            return misuse;
        }
        uint32_t count;
        memcpy(&count, bytes, sizeof count);
        list.count = count < list.count ? count : list.count;
    }
    list.bytes = rhw_indirect_bytes(context, commands->buffer, commands->offset,
                                    extent(list.count, list.stride, size), "", where);
    return list;
}

static void draw_all(struct rhw_encoder *encoder, const struct rhw_draw_commands *commands, const char *where)
{
    struct rhw_draw_command command;
    const struct command_list list = find_commands(encoder->context, commands, sizeof command, where);
    for (uint32_t i = 0; list.bytes != NULL && i < list.count; i++) {
        memcpy(&command, list.bytes + i * list.stride, sizeof command);
        const struct rhw_draw draw = {
            .first = command.first, .first_instance = command.first_instance, .instances = command.instances};
        rhw_pass_record(encoder, &draw, command.count, where);
    }
}

static void draw_all_indexed(struct rhw_encoder *encoder, const struct rhw_draw_commands *commands,
                             const char *where)
{
    struct rhw_draw_indexed_command command;
    const struct command_list list = find_commands(encoder->context, commands, sizeof command, where);
    for (uint32_t i = 0; list.bytes != NULL && i < list.count; i++) {
        memcpy(&command, list.bytes + i * list.stride, sizeof command);
        const struct rhw_draw draw = {.first = command.first,
                                      .base_vertex = (uint32_t)command.base_vertex,
                                      .first_instance = command.first_instance,
                                      .instances = command.instances,
                                      .indexed = true};
        rhw_pass_record(encoder, &draw, command.count, where);
    }
}

static void draw_byte_count(struct rhw_encoder *encoder, const struct rhw_draw_byte_count *draw,
                            const char *where)
{
    const rhw_context *const context = encoder->context;
    uint32_t counter;
    if (!rhw_check(context, draw != NULL, "%s: draw is NULL", where) ||
        !rhw_check(context, draw->stride != 0, "%s: stride is 0; it must be at least 1 byte", where)) {
        return;
    }
    const unsigned char *const bytes =
        rhw_indirect_bytes(context, draw->buffer, draw->offset, sizeof counter, "", where);
    if (bytes != NULL) {
        memcpy(&counter, bytes, sizeof counter);
        const uint32_t size = counter > draw->counter_offset ? counter - draw->counter_offset : 0;
        const struct rhw_draw all = {.first_instance = draw->first_instance, .instances = draw->instances};
        rhw_pass_record(encoder, &all, size / draw->stride, where);
    }
}

void rhw_pass_draw_indirect(rhw_context *context, rhw_pass id, const struct rhw_draw_commands *commands)
{
    static const char *const where = "rhw_pass_draw_indirect";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder != NULL) {
        draw_all(encoder, commands, where);
        rhw_context_leave(context);
    }
}

void rhw_pass_draw_indexed_indirect(rhw_context *context, rhw_pass id,
                                    const struct rhw_draw_commands *commands)
{
    static const char *const where = "rhw_pass_draw_indexed_indirect";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder != NULL) {
        draw_all_indexed(encoder, commands, where);
        rhw_context_leave(context);
    }
}

void rhw_pass_draw_indirect_byte_count(rhw_context *context, rhw_pass id,
                                       const struct rhw_draw_byte_count *draw)
{
    static const char *const where = "rhw_pass_draw_indirect_byte_count";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder != NULL) {
        draw_byte_count(encoder, draw, where);
        rhw_context_leave(context);
    }
}
