// SPDX-License-Identifier: MIT
// Buffers or memory of vertices and indices, and uniforms, are what vertices are made from. This file sets them for the
// next draws.
#include <string.h>

#include "resource/buffer.h"
#include "resource/buffer_access.h"
#include "context/context.h"
#include "context/entry.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "encoder.h"
#include "memory_overlap.h"
#include "rhw/rhw.h"

// Note that draws read bytes of a buffer. Return false where it is misuse.
static __attribute__((noinline)) bool note_read(struct rhw_encoder *encoder,
                                                const struct rhw_buffer_part *part, const char *where)
{
    if (!rhw_buffer_check_use(encoder->context, part, where)) {
        return false;
    }
    encoder->out_of_memory |= !rhw_buffer_note_use(encoder->context, &encoder->pass->arena, part);
    return rhw_memory_note_read(&encoder->memory, part->data->bytes + part->first, part->end - part->first,
                                where);
}

// Bind the bytes offset .. offset + size of a buffer, which draws will read. Size 0 binds all bytes up to the buffer's
// end. Return NULL data where the call is misuse.
static inline struct rhw_bound_buffer bind_buffer(struct rhw_encoder *encoder, rhw_buffer id, size_t offset,
                                                  size_t size, const char *where)
{
    rhw_context *const context = encoder->context;
    struct rhw_buffer_data *const buffer = rhw_context_buffer(context, id, where);
    if (!buffer ||
        !rhw_check(context, offset <= buffer->size, "%s: offset is %zu; %s has %zu bytes", where, offset,
                   rhw_name_of(&context->buffers, id.index).text, buffer->size) ||
        !rhw_check(context, size <= buffer->size - offset,
                   "%s: offset is %zu and size is %zu; together they must stay within the %zu bytes of %s",
                   where, offset, size, buffer->size, rhw_name_of(&context->buffers, id.index).text)) {
        return (struct rhw_bound_buffer){.data = NULL};
    }
    const uint32_t generation = context->recording.generation;
    const size_t length = size == 0 ? buffer->size - offset : size, end = offset + length;
    const struct rhw_used_bytes *const used = &buffer->used[RHW_BUFFER_READ];
    const bool is_noted = !context->uses && used->pass == generation && used->ranges.last &&
                          used->ranges.last->first <= offset && end <= used->ranges.last->end;
    const struct rhw_buffer_part part = {id, buffer, RHW_BUFFER_READ, offset, end};
    if ((buffer->is_map_written && !rhw_buffer_check_unmapped(context, &part, where)) ||
        (!is_noted && !note_read(encoder, &part, where))) {
        return (struct rhw_bound_buffer){.data = NULL};
    }
    rhw_encoder_note_use(encoder, &context->buffers, id.index, buffer->moves);
    return (struct rhw_bound_buffer){buffer, NULL, offset, length, id.index};
}

// Check memory of the program that draws are to read.
static bool check_memory(struct rhw_encoder *encoder, const void *memory, size_t size, const char *where)
{
    return rhw_check(encoder->context, memory || size == 0, "%s: memory is NULL and size is %zu", where,
                     size) &&
           rhw_memory_note_read(&encoder->memory, memory, size, where);
}

// Bind memory of the program, which draws will read. Return NULL memory where the call is misuse.
static struct rhw_bound_buffer bind_memory(struct rhw_encoder *encoder, const void *memory, size_t size,
                                           const char *where)
{
    static const unsigned char nothing = 0;
    if (!check_memory(encoder, memory, size, where)) {
        return (struct rhw_bound_buffer){.memory = NULL};
    }
    return (struct rhw_bound_buffer){.memory = memory ? memory : &nothing, .size = size};
}

static bool same_buffer(struct rhw_bound_buffer a, struct rhw_bound_buffer b)
{
    return a.data == b.data && a.memory == b.memory && a.offset == b.offset && a.size == b.size;
}

static bool check_slot(const struct rhw_context *context, int slot, const char *where)
{
    return rhw_check(context, slot >= 0 && slot < RHW_MAX_VERTEX_BUFFERS, "%s: slot is %d; it is in 0..%d",
                     where, slot, RHW_MAX_VERTEX_BUFFERS - 1);
}

static inline void take_vertices(struct rhw_encoder *encoder, int slot, struct rhw_bound_buffer bound)
{
    if (rhw_bound_is_set(&bound)) {
        encoder->pending_changed |= !same_buffer(encoder->bound.vertices[slot], bound);
        encoder->bound.vertices[slot] = bound;
    }
}

static inline void set_vertex_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer,
                                     size_t offset, size_t size, const char *where)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_slot(context, slot, where)) {
        take_vertices(encoder, slot, bind_buffer(encoder, buffer, offset, size, where));
    }
    rhw_context_leave(context);
}

void rhw_pass_set_vertex_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer, size_t offset)
{
    set_vertex_buffer(context, id, slot, buffer, offset, 0, "rhw_pass_set_vertex_buffer");
}

void rhw_pass_set_vertex_buffer_range(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer,
                                      size_t offset, size_t size)
{
    set_vertex_buffer(context, id, slot, buffer, offset, size, "rhw_pass_set_vertex_buffer_range");
}

void rhw_pass_set_vertex_memory(rhw_context *context, rhw_pass id, int slot, const void *memory, size_t size)
{
    static const char *const where = "rhw_pass_set_vertex_memory";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_slot(context, slot, where)) {
        take_vertices(encoder, slot, bind_memory(encoder, memory, size, where));
    }
    rhw_context_leave(context);
}

static bool check_index_type(const struct rhw_context *context, enum rhw_index_type type, const char *where)
{
    return rhw_check(context, (unsigned)type <= RHW_INDEX_UINT32, "%s: type is %d; not an index type", where,
                     (int)type);
}

static inline void take_indices(struct rhw_encoder *encoder, enum rhw_index_type type,
                                struct rhw_bound_buffer bound)
{
    if (rhw_bound_is_set(&bound)) {
        encoder->pending_changed |=
            !same_buffer(encoder->bound.indices, bound) || encoder->pending.index_type != type;
        encoder->bound.indices = bound;
        encoder->pending.index_type = type;
    }
}

static inline void set_index_buffer(rhw_context *context, rhw_pass id, rhw_buffer buffer,
                                    enum rhw_index_type type, size_t offset, size_t size, const char *where)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_index_type(context, type, where)) {
        take_indices(encoder, type, bind_buffer(encoder, buffer, offset, size, where));
    }
    rhw_context_leave(context);
}

void rhw_pass_set_index_buffer(rhw_context *context, rhw_pass id, rhw_buffer buffer, enum rhw_index_type type,
                               size_t offset)
{
    set_index_buffer(context, id, buffer, type, offset, 0, "rhw_pass_set_index_buffer");
}

void rhw_pass_set_index_buffer_range(rhw_context *context, rhw_pass id, rhw_buffer buffer,
                                     enum rhw_index_type type, size_t offset, size_t size)
{
    set_index_buffer(context, id, buffer, type, offset, size, "rhw_pass_set_index_buffer_range");
}

void rhw_pass_set_index_memory(rhw_context *context, rhw_pass id, const void *memory,
                               enum rhw_index_type type, size_t size)
{
    static const char *const where = "rhw_pass_set_index_memory";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_index_type(context, type, where)) {
        take_indices(encoder, type, bind_memory(encoder, memory, size, where));
    }
    rhw_context_leave(context);
}

static void set_uniforms(struct rhw_encoder *encoder, const void *data, size_t size)
{
    static const char *const where = "rhw_pass_set_uniforms";
    rhw_context *const context = encoder->context;
    if (!rhw_check(context, data || size == 0, "%s: data is NULL and size is %zu", where, size) ||
        !rhw_check(context, size <= RHW_MAX_UNIFORM_SIZE, "%s: size is %zu; at most %d", where, size,
                   RHW_MAX_UNIFORM_SIZE)) {
        return;
    }
    void *const copy = rhw_arena_alloc(&encoder->pass->arena, size, RHW_CACHE_LINE);
    if (!copy) {
        encoder->out_of_memory = true;
        return;
    }
    if (size != 0) {
        memcpy(copy, data, size);
    }
    encoder->uniforms = copy;
    encoder->uniform_size = (uint32_t)size;
}

void rhw_pass_set_uniforms(rhw_context *context, rhw_pass id, const void *data, size_t size)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_set_uniforms");
    if (encoder) {
        set_uniforms(encoder, data, size);
        rhw_context_leave(context);
    }
}

void rhw_pass_set_uniform_memory(rhw_context *context, rhw_pass id, const void *memory, size_t size)
{
    static const char *const where = "rhw_pass_set_uniform_memory";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_memory(encoder, memory, size, where)) {
        encoder->uniforms = memory;
        encoder->uniform_size = size < UINT32_MAX ? (uint32_t)size : UINT32_MAX;
    }
    rhw_context_leave(context);
}
