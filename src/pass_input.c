// SPDX-License-Identifier: MIT
// Recording: what vertices are made from, which is buffers of vertices and indices, and uniforms.
#include <string.h>

#include "buffer.h"
#include "context.h"
#include "entry.h"
#include "lookup.h"
#include "misuse.h"
#include "pass_enter.h"
#include "pass_state.h"
#include "rhw/rhw.h"

// Nothing says what would come first, reading or writing.
static __attribute__((cold)) void report_written(const rhw_context *context, rhw_buffer id,
                                                 const struct rhw_buffer_data *buffer, const char *where)
{
    const bool is_stored = buffer->stored_pass == context->recording.generation;
    rhw_misuse(context, "%s: %s is %s", where, rhw_name_of(&context->buffers, id.index).text,
               is_stored ? "a storage buffer of this pass, which may write it"
                         : "written by the transform feedback of this pass");
}

// A buffer that draws will read from `offset` on; its data is NULL when the call was misuse.
static inline struct rhw_bound_buffer bind_buffer(rhw_context *context, rhw_buffer id, size_t offset,
                                                  const char *where)
{
    const uint32_t generation = context->recording.generation;
    struct rhw_buffer_data *const buffer = rhw_context_buffer(context, id, where);
    if (!buffer || !rhw_check(context, offset <= buffer->size, "%s: offset is %zu; %s has %zu bytes", where,
                              offset, rhw_name_of(&context->buffers, id.index).text, buffer->size)) {
        return (struct rhw_bound_buffer){.data = NULL};
    }
    if (buffer->stored_pass == generation || buffer->captured_pass == generation) {
        report_written(context, id, buffer, where);
        return (struct rhw_bound_buffer){.data = NULL};
    }
    if (buffer->is_map_written && !rhw_buffer_check_drawable(context, id, buffer, where)) {
        return (struct rhw_bound_buffer){.data = NULL};
    }
    buffer->fetched_pass = generation;
    rhw_pool_use(&context->buffers, id.index, generation);
    return (struct rhw_bound_buffer){buffer, offset, id.index};
}

static bool same_buffer(struct rhw_bound_buffer a, struct rhw_bound_buffer b)
{
    return a.data == b.data && a.offset == b.offset;
}

void rhw_pass_set_vertex_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer, size_t offset)
{
    static const char *const where = "rhw_pass_set_vertex_buffer";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (rhw_check(context, slot >= 0 && slot < RHW_MAX_VERTEX_BUFFERS, "%s: slot is %d; it is in 0..%d",
                  where, slot, RHW_MAX_VERTEX_BUFFERS - 1)) {
        const struct rhw_bound_buffer bound = bind_buffer(context, buffer, offset, where);
        if (bound.data) {
            pass->pending_changed |= !same_buffer(pass->bound.vertices[slot], bound);
            pass->bound.vertices[slot] = bound;
        }
    }
    rhw_context_leave(context);
}

void rhw_pass_set_index_buffer(rhw_context *context, rhw_pass id, rhw_buffer buffer, enum rhw_index_type type,
                               size_t offset)
{
    static const char *const where = "rhw_pass_set_index_buffer";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (rhw_check(context, (unsigned)type <= RHW_INDEX_UINT32, "%s: type is %d; not an index type", where,
                  (int)type)) {
        const struct rhw_bound_buffer bound = bind_buffer(context, buffer, offset, where);
        if (bound.data) {
            pass->pending_changed |=
                !same_buffer(pass->bound.indices, bound) || pass->pending.index_type != type;
            pass->bound.indices = bound;
            pass->pending.index_type = type;
        }
    }
    rhw_context_leave(context);
}

static void set_uniforms(struct rhw_pass_state *pass, const void *data, size_t size)
{
    static const char *const where = "rhw_pass_set_uniforms";
    rhw_context *const context = pass->context;
    if (!rhw_check(context, data || size == 0, "%s: data is NULL and size is %zu", where, size) ||
        !rhw_check(context, size <= RHW_MAX_UNIFORM_SIZE, "%s: size is %zu; at most %d", where, size,
                   RHW_MAX_UNIFORM_SIZE)) {
        return;
    }
    void *const copy = rhw_arena_alloc(&pass->arena, size, RHW_CACHE_LINE);
    if (!copy) {
        pass->out_of_memory = true;
        return;
    }
    if (size != 0) {
        memcpy(copy, data, size);
    }
    pass->uniforms = copy;
    pass->uniform_size = (uint32_t)size;
}

void rhw_pass_set_uniforms(rhw_context *context, rhw_pass id, const void *data, size_t size)
{
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, "rhw_pass_set_uniforms");
    if (pass) {
        set_uniforms(pass, data, size);
        rhw_context_leave(context);
    }
}
