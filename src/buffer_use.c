// SPDX-License-Identifier: MIT
// See buffer_use.h. A buffer has a list of ranges for each use. Those that touch become one, so that a thousand draws with
// the same bytes, or with one piece after the other, make one.
#include "buffer_use.h"

#include "arena.h"
#include "buffer.h"
#include "context.h"
#include "lookup.h"
#include "misuse.h"

// The ranges of a use in the pass being recorded; NULL: none.
static struct rhw_used_range *ranges_of(const struct rhw_context *context, const struct rhw_buffer_data *data,
                                        enum rhw_buffer_use use)
{
    const uint32_t passes[] = {data->read_pass, data->stored_pass, data->captured_pass};
    struct rhw_used_range *const ranges[] = {data->read, data->stored, data->captured};
    return context->recording.active && passes[use] == context->recording.generation ? ranges[use] : NULL;
}

static void set_ranges(const struct rhw_context *context, struct rhw_buffer_data *data,
                       enum rhw_buffer_use use, struct rhw_used_range *ranges)
{
    uint32_t *const passes[] = {&data->read_pass, &data->stored_pass, &data->captured_pass};
    struct rhw_used_range **const lists[] = {&data->read, &data->stored, &data->captured};
    *passes[use] = context->recording.generation;
    *lists[use] = ranges;
}

bool rhw_buffer_check_apart(const struct rhw_context *context, const struct rhw_buffer_part *part,
                            enum rhw_buffer_use use, size_t first, size_t end, const char *where)
{
    static const char *const verbs[] = {"reads", "may write", "writes", "writes"};
    static const char *const others[] = {"a vertex, index or read-only buffer of this pass reads",
                                         "storage of this pass may write",
                                         "the transform feedback of this pass writes"};
    return rhw_check(context, end <= part->first || part->end <= first || first == end,
                     "%s: it %s bytes %zu to %zu of %s; %s bytes %zu to %zu", where, verbs[part->use],
                     part->first, part->end, rhw_name_of(&context->buffers, part->id.index).text, others[use],
                     first, end);
}

// Readings go together, and so do writings of shader functions.
static bool goes_with_itself(enum rhw_buffer_use use)
{
    return use != RHW_BUFFER_CAPTURED;
}

bool rhw_buffer_check_unused(const struct rhw_context *context, const struct rhw_buffer_part *part,
                             enum rhw_buffer_use use, const char *where)
{
    const struct rhw_used_range *range = ranges_of(context, part->data, use);
    while (range && rhw_buffer_check_apart(context, part, use, range->first, range->end, where)) {
        range = range->next;
    }
    return !range;
}

bool rhw_buffer_is_read(const struct rhw_context *context, const struct rhw_buffer_part *part)
{
    const struct rhw_used_range *range = ranges_of(context, part->data, RHW_BUFFER_READ);
    while (range && (part->end <= range->first || range->end <= part->first)) {
        range = range->next;
    }
    return range;
}

bool rhw_buffer_is_written(const struct rhw_context *context, const struct rhw_buffer_data *data)
{
    return ranges_of(context, data, RHW_BUFFER_STORED) || ranges_of(context, data, RHW_BUFFER_CAPTURED);
}

bool rhw_buffer_check_use(const struct rhw_context *context, const struct rhw_buffer_part *part,
                          const char *where)
{
    for (int i = 0; i < RHW_BUFFER_USES; i++) {
        const enum rhw_buffer_use use = (enum rhw_buffer_use)i;
        const bool is_asked = use != part->use || !goes_with_itself(use);
        if (is_asked && !rhw_buffer_check_unused(context, part, use, where)) {
            return false;
        }
    }
    return true;
}

// Whether the range takes the part up, which it touches.
static bool takes_up(struct rhw_used_range *range, const struct rhw_buffer_part *part)
{
    if (!range || part->end < range->first || range->end < part->first) {
        return false;
    }
    range->first = part->first < range->first ? part->first : range->first;
    range->end = part->end > range->end ? part->end : range->end;
    return true;
}

struct rhw_used_range *rhw_buffer_note_use(struct rhw_context *context, struct rhw_arena *arena,
                                           const struct rhw_buffer_part *part)
{
    struct rhw_used_range *const ranges = ranges_of(context, part->data, part->use);
    rhw_pool_use(&context->buffers, part->id.index, context->recording.generation);
    if (goes_with_itself(part->use) && takes_up(ranges, part)) {
        return ranges;
    }
    struct rhw_used_range *const range =
        rhw_arena_alloc(arena, sizeof *range, _Alignof(struct rhw_used_range));
    if (range) {
        *range = (struct rhw_used_range){ranges, part->first, part->end};
        set_ranges(context, part->data, part->use, range);
    }
    return range;
}
