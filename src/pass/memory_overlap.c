// SPDX-License-Identifier: MIT
// Attachments are looked at row by row, because the rows of two textures on memory of the program may take turns.
#include "memory_overlap.h"

#include <stdint.h>

#include "context/context.h"
#include "context/misuse.h"
#include "draw/recorded_pass.h"

// Bytes by address.
struct memory_part {
    uintptr_t first, end;
};

static struct memory_part part_of(const void *bytes, size_t size)
{
    const uintptr_t first = (uintptr_t)bytes;
    return (struct memory_part){first, size < UINTPTR_MAX - first ? first + size : UINTPTR_MAX};
}

// Return true if some row of `size` bytes has some of the part's bytes. There are `count` rows, `pitch` bytes apart.
static bool is_in_rows(struct memory_part part, const unsigned char *rows, size_t size, size_t pitch,
                       int count)
{
    const uintptr_t begin = (uintptr_t)rows;
    const size_t row =
        part.first <= begin ? 0 : (part.first - begin) / pitch; // the last that begins before the part
    const uintptr_t at = begin + row * pitch;
    const bool is_in_row = row < (size_t)count && at < part.end && part.first < at + size;
    const bool is_in_next = row + 1 < (size_t)count && at + pitch < part.end;
    return is_in_row || is_in_next;
}

static bool is_in_level(const struct rhw_used_memory *used, const struct rhw_attachment *attachment,
                        const struct rhw_mip *mip, size_t sample_stride, struct memory_part part)
{
    const struct rhw_target *const target = &used->pass->target;
    const size_t row = (size_t)target->width * attachment->texel_size;
    const int samples = sample_stride != 0 ? target->pattern->count : 1;
    for (int i = 0; mip && i < samples * target->layers; i++) {
        const unsigned char *const texels = rhw_mip_slice(mip, attachment->layer + i % target->layers) +
                                            (size_t)(i / target->layers) * sample_stride;
        if (is_in_rows(part, texels, row, mip->row_pitch, target->height)) {
            return true;
        }
    }
    return false;
}

static bool is_in_attachment(const struct rhw_used_memory *used, const struct rhw_attachment *attachment,
                             struct memory_part part)
{
    return (!attachment->is_read_only &&
            is_in_level(used, attachment, attachment->target, attachment->sample_stride, part)) ||
           (attachment->resolves && is_in_level(used, attachment, attachment->resolve, 0, part));
}

// Return what the pass draws into the part, for messages. Return NULL if it draws into none of it.
static const char *attachment_of(const struct rhw_used_memory *used, struct memory_part part)
{
    const struct rhw_target *const target = &used->pass->target;
    for (int i = 0; i < target->color_count; i++) {
        if (is_in_attachment(used, &target->colors[i], part)) {
            return "a colour attachment";
        }
    }
    const bool is_depth = (target->has_depth && is_in_attachment(used, &target->depth, part)) ||
                          (target->has_stencil && is_in_attachment(used, &target->stencil, part));
    return is_depth ? "the depth attachment" : NULL;
}

static bool is_in_set(const struct rhw_range_set *set, struct memory_part part)
{
    return rhw_range_set_find(set, part.first, part.end) != NULL;
}

// Return what the pass does with the part, for messages, except what `own` has: a set that may share bytes with the
// part. Return NULL if there is nothing.
static const char *user_of(const struct rhw_used_memory *used, struct memory_part part,
                           const struct rhw_range_set *own)
{
    const char *const attachment = attachment_of(used, part);
    return attachment                                               ? attachment
           : is_in_set(&used->captured, part)                       ? "transform feedback"
           : own != &used->stored && is_in_set(&used->stored, part) ? "storage that shader functions write"
           : own != &used->read && is_in_set(&used->read, part)     ? "what its draws read"
                                                                    : NULL;
}

// Report a part that the pass has another use for. Return false then.
static bool check(const struct rhw_used_memory *used, struct memory_part part, const char *user,
                  const char *where)
{
    return rhw_check(used->context, user == NULL,
                     "%s: %zu bytes at %p share some with %s of this %s; they must lie apart until the %s "
                     "ends",
                     where, (size_t)(part.end - part.first), (const void *)part.first, user,
                     rhw_recording_noun(&used->context->recording),
                     rhw_recording_noun(&used->context->recording));
}

static bool is_noted(const struct rhw_used_memory *used, size_t size)
{
    return used->context->validation && size != 0;
}

// Note a part in a set that unites ranges. Report a part that the pass has another use for, and return false then.
static bool note(struct rhw_used_memory *used, struct rhw_range_set *set, const void *bytes, size_t size,
                 const char *where)
{
    if (!is_noted(used, size)) {
        return true;
    }
    const struct memory_part part = part_of(bytes, size);
    if (!check(used, part, user_of(used, part, set), where)) {
        return false;
    }
    *used->out_of_memory |= !rhw_range_set_unite(set, &used->pass->arena, part.first, part.end);
    return true;
}

bool rhw_memory_note_read(struct rhw_used_memory *used, const void *bytes, size_t size, const char *where)
{
    return note(used, &used->read, bytes, size, where);
}

bool rhw_memory_note_stored(struct rhw_used_memory *used, const void *bytes, size_t size, const char *where)
{
    return note(used, &used->stored, bytes, size, where);
}

bool rhw_memory_note_stored_level(struct rhw_used_memory *used, const struct rhw_mip *mip, size_t texel_size,
                                  const char *where)
{
    const size_t row = (size_t)mip->width * texel_size;
    // Where rows are not as far apart as the program asked for, a slice is noted as one.
    const bool is_dense = mip->row_pitch - row < RHW_ROW_ALIGNMENT;
    const int parts = is_dense ? 1 : mip->height;
    bool is_apart = true;
    for (int i = 0; is_apart && i < mip->slices * parts; i++) {
        const unsigned char *const bytes =
            rhw_mip_slice(mip, i / parts) + (size_t)(i % parts) * mip->row_pitch;
        const size_t size = is_dense ? (size_t)(mip->height - 1) * mip->row_pitch + row : row;
        is_apart = rhw_memory_note_stored(used, bytes, size, where);
    }
    return is_apart;
}

bool rhw_memory_note_captured(struct rhw_used_memory *used, const void *bytes, size_t size, const char *where,
                              struct rhw_range **range)
{
    *range = NULL;
    if (!is_noted(used, size)) {
        return true;
    }
    const struct memory_part part = part_of(bytes, size);
    if (!check(used, part, user_of(used, part, &used->captured), where)) {
        return false;
    }
    *range = rhw_range_set_add(&used->captured, &used->pass->arena, part.first, part.end);
    *used->out_of_memory |= *range == NULL;
    return true;
}
