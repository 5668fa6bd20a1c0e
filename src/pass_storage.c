// SPDX-License-Identifier: MIT
// Recording: what a pass sets of storage.
#include "pass_storage.h"

#include "buffer.h"
#include "context.h"
#include "entry.h"
#include "lookup.h"
#include "misuse.h"
#include "pass_enter.h"
#include "pass_state.h"
#include "rhw/rhw.h"

static bool check_storage(const struct rhw_context *context, rhw_buffer id,
                          const struct rhw_buffer_data *data, size_t offset, size_t size, const char *where)
{
    return rhw_check(context, offset % 4 == 0, "%s: offset is %zu; it must be a multiple of 4", where,
                     offset) &&
           rhw_check(context, offset <= data->size && size <= data->size - offset,
                     "%s: offset is %zu and size is %zu; together they must stay within the %zu bytes of %s",
                     where, offset, size, data->size, rhw_name_of(&context->buffers, id.index).text) &&
           rhw_check(context, data->captured_pass != context->recording.generation,
                     "%s: %s is written by the transform feedback of this pass", where,
                     rhw_name_of(&context->buffers, id.index).text) &&
           rhw_check(context, data->fetched_pass != context->recording.generation,
                     "%s: %s is a vertex or index buffer of this pass, which may not write it", where,
                     rhw_name_of(&context->buffers, id.index).text);
}

static void set_storage_buffer(struct rhw_pass_state *pass, int slot, rhw_buffer id, size_t offset,
                               size_t size)
{
    static const char *const where = "rhw_pass_set_storage_buffer";
    struct rhw_context *const context = pass->context;
    struct rhw_bound_range bound = {NULL, 0, 0};
    if (!rhw_check(context, slot >= 0 && slot < RHW_MAX_STORAGE_BUFFERS, "%s: slot is %d; it is in 0..%d",
                   where, slot, RHW_MAX_STORAGE_BUFFERS - 1)) {
        return;
    }
    if (id.index != 0) {
        struct rhw_buffer_data *const data = rhw_context_buffer(context, id, where);
        if (!data || !check_storage(context, id, data, offset, size, where) ||
            !rhw_buffer_check_unmapped(context, id, data, where)) {
            return;
        }
        data->stored_pass = context->recording.generation;
        rhw_pool_use(&context->buffers, id.index, context->recording.generation);
        bound = (struct rhw_bound_range){data, offset, size == 0 ? data->size - offset : size};
    }
    pass->bound.storage[slot] = bound;
    pass->textures_changed = true;
}

void rhw_pass_set_storage_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer,
                                 size_t offset, size_t size)
{
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, "rhw_pass_set_storage_buffer");
    if (pass) {
        set_storage_buffer(pass, slot, buffer, offset, size);
        rhw_context_leave(context);
    }
}

static bool has_storage(const struct rhw_bound *bound)
{
    for (int i = 0; i < RHW_MAX_STORAGE_BUFFERS; i++) {
        if (bound->storage[i].data) {
            return true;
        }
    }
    return false;
}

static struct rhw_storage_words words_of(const struct rhw_bound_range *range)
{
    const size_t count = range->size / 4;
    return range->data ? (struct rhw_storage_words){(uint32_t *)(void *)(range->data->bytes + range->offset),
                                                    count < UINT32_MAX ? (uint32_t)count : UINT32_MAX}
                       : (struct rhw_storage_words){NULL, 0};
}

const struct rhw_storage *rhw_pass_storage_of(struct rhw_pass_state *pass)
{
    if (!has_storage(&pass->bound)) {
        return &rhw_no_storage;
    }
    struct rhw_storage *const storage = rhw_arena_alloc(&pass->arena, sizeof *storage, RHW_CACHE_LINE);
    for (int i = 0; storage && i < RHW_MAX_STORAGE_BUFFERS; i++) {
        storage->buffers[i] = words_of(&pass->bound.storage[i]);
    }
    return storage;
}
