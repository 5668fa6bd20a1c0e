// SPDX-License-Identifier: MIT
// A buffer has a set of ranges for each use. A thousand draws with one range of bytes, or with one piece after the
// other, are one range of the set.
#include "buffer_use.h"

#include "base/arena.h"
#include "context/context.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "context/use_table.h"

_Static_assert((int)RHW_USED_RANGES == (int)RHW_BUFFER_USES,
               "a table of uses has a set for each use of a buffer");

struct rhw_range_set *rhw_buffer_ranges(const struct rhw_context *context, struct rhw_buffer_data *data,
                                        enum rhw_buffer_use use)
{
    if (context->uses) {
        struct rhw_use *const noted = rhw_use_table_find(context->uses, data);
        return noted ? &noted->used[use] : NULL;
    }
    struct rhw_used_bytes *const used = &data->used[use];
    const struct rhw_recording_place *const recording = &context->recording;
    return rhw_recording_is_open(recording) && used->pass == recording->generation ? &used->ranges : NULL;
}

// Return a range of the use that has some of the part's bytes. Return NULL if none has.
static const struct rhw_range *find(const struct rhw_context *context, const struct rhw_buffer_part *part,
                                    enum rhw_buffer_use use)
{
    const struct rhw_range_set *const ranges = rhw_buffer_ranges(context, part->data, use);
    return ranges ? rhw_range_set_find(ranges, part->first, part->end) : NULL;
}

bool rhw_buffer_check_apart(const struct rhw_context *context, const struct rhw_buffer_part *part,
                            enum rhw_buffer_use use, size_t first, size_t end, const char *where)
{
    static const char *const verbs[] = {[RHW_BUFFER_READ] = "reads",
                                        [RHW_BUFFER_STORED] = "may write",
                                        [RHW_BUFFER_CAPTURED] = "writes",
                                        [RHW_BUFFER_WRITTEN] = "writes"};
    static const char *const users[] = {[RHW_BUFFER_READ] = "a vertex, index or read-only buffer",
                                        [RHW_BUFFER_STORED] = "storage",
                                        [RHW_BUFFER_CAPTURED] = "the transform feedback"};
    const char *const noun = rhw_recording_noun(&context->recording);
    return rhw_check(
        context, end <= part->first || part->end <= first || first == end || part->first == part->end,
        "%s: it %s bytes %zu to %zu of %s; %s of this %s %s bytes %zu to %zu; they must lie apart until the "
        "%s ends",
        where, verbs[part->use], part->first, part->end, rhw_name_of(&context->buffers, part->id.index).text,
        users[use], noun, verbs[use], first, end, noun);
}

// Return true if two parts of a buffer may have bytes in common in this use: readings may, and writings of shader
// functions may.
static bool goes_with_itself(enum rhw_buffer_use use)
{
    return use != RHW_BUFFER_CAPTURED;
}

bool rhw_buffer_check_unused(const struct rhw_context *context, const struct rhw_buffer_part *part,
                             enum rhw_buffer_use use, const char *where)
{
    const struct rhw_range *const range = find(context, part, use);
    return !range || rhw_buffer_check_apart(context, part, use, range->first, range->end, where);
}

bool rhw_buffer_is_read(const struct rhw_context *context, const struct rhw_buffer_part *part)
{
    return find(context, part, RHW_BUFFER_READ);
}

bool rhw_buffer_is_written(const struct rhw_context *context, struct rhw_buffer_data *data)
{
    const struct rhw_range_set *const stored = rhw_buffer_ranges(context, data, RHW_BUFFER_STORED),
                                      *const captured = rhw_buffer_ranges(context, data, RHW_BUFFER_CAPTURED);
    return (stored && stored->root) || (captured && captured->root);
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

struct rhw_range *rhw_buffer_note_use(struct rhw_context *context, struct rhw_arena *arena,
                                      const struct rhw_buffer_part *part)
{
    struct rhw_buffer_data *const data = part->data;
    struct rhw_used_bytes *const used = &data->used[part->use];
    struct rhw_range_set *ranges = &used->ranges;
    const uint32_t generation = context->recording.generation;
    if (context->uses) {
        struct rhw_use *const noted =
            rhw_use_table_note(context->uses, arena, &context->buffers, part->id.index, data->moves);
        if (!noted) {
            return NULL;
        }
        ranges = &noted->used[part->use];
    } else {
        if (used->pass != generation) {
            *used = (struct rhw_used_bytes){.pass = generation};
        }
        rhw_pool_use(&context->buffers, part->id.index, generation);
        data->writes += part->use != RHW_BUFFER_READ;
    }
    return goes_with_itself(part->use) ? rhw_range_set_unite(ranges, arena, part->first, part->end)
                                       : rhw_range_set_add(ranges, arena, part->first, part->end);
}
