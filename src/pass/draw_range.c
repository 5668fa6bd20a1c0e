// SPDX-License-Identifier: MIT
// Each index and each attribute of a draw is looked up in its buffer, so this is for validation alone.
#include "draw_range.h"

#include <string.h>

#include "resource/buffer.h"
#include "context/context.h"
#include "format/format.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "pipeline/pipeline.h"

static const uint32_t index_sizes[] = {[RHW_INDEX_UINT8] = 1, [RHW_INDEX_UINT16] = 2, [RHW_INDEX_UINT32] = 4};

// Return what messages call the bytes that a slot has.
static struct rhw_name name_of(const struct rhw_encoder *encoder, int slot)
{
    const struct rhw_bound_buffer *const bound = &encoder->bound.vertices[slot];
    return bound->data ? rhw_name_of(&encoder->context->buffers, bound->index)
                       : (struct rhw_name){.text = "memory of the program"};
}

// Return how many elements attribute i finds in its buffer. A constant attribute finds at most one.
static uint64_t elements_of(const struct rhw_encoder *encoder, int i)
{
    const struct rhw_pipeline_def *const def = &encoder->pending.pipeline->def;
    const struct rhw_attribute *const attribute = &def->attributes[i];
    const struct rhw_bound_buffer *const bound = &encoder->bound.vertices[attribute->buffer];
    const uint64_t size = bound->size;
    const uint64_t end = (uint64_t)attribute->offset + rhw_vertex_format_size(attribute->format);
    const struct rhw_vertex_layout *const layout = &def->buffers[attribute->buffer];
    return size < end ? 0 : layout->constant ? 1 : (size - end) / layout->stride + 1;
}

// Check that a draw's vertices or instances, first .. last, lie within the buffers that are read for each of them.
static bool check_elements(const struct rhw_encoder *encoder, bool per_instance, int64_t first, int64_t last,
                           const char *where)
{
    const struct rhw_pipeline_def *const def = &encoder->pending.pipeline->def;
    for (int i = 0; i < def->attribute_count; i++) {
        const int slot = def->attributes[i].buffer;
        const struct rhw_vertex_layout *const layout = &def->buffers[slot];
        if (layout->constant || layout->per_instance != per_instance) {
            continue;
        }
        const int64_t count = (int64_t)elements_of(encoder, i);
        const int64_t end = per_instance ? first + (last - first) / layout->instance_step : last;
        if (!rhw_check(encoder->context, first >= 0 && end < count,
                       "%s: it reads %s %lld to %lld; attribute %d has %lld in %s, slot %d", where,
                       per_instance ? "instances" : "vertices", (long long)first, (long long)end, i,
                       (long long)count, name_of(encoder, slot).text, slot)) {
            return false;
        }
    }
    return true;
}

// Check that each constant attribute finds its one element.
static bool check_constants(const struct rhw_encoder *encoder, const char *where)
{
    const struct rhw_pipeline_def *const def = &encoder->pending.pipeline->def;
    for (int i = 0; i < def->attribute_count; i++) {
        const int slot = def->attributes[i].buffer;
        if (!rhw_check(encoder->context, !def->buffers[slot].constant || elements_of(encoder, i) != 0,
                       "%s: attribute %d, which is constant, ends behind %s, slot %d", where, i,
                       name_of(encoder, slot).text, slot)) {
            return false;
        }
    }
    return true;
}

static uint32_t index_at(const struct rhw_encoder *encoder, uint64_t i)
{
    const uint32_t size = index_sizes[encoder->pending.index_type];
    uint32_t value = 0;
    // Indices are little endian.
    memcpy(&value, rhw_bound_bytes(&encoder->bound.indices) + i * size, size);
    return value;
}

// Find the least and the greatest index, without restart indices. Return false when there is no index.
static bool find_indices(const struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count,
                         uint32_t *least, uint32_t *most)
{
    const uint32_t restart = UINT32_MAX >> (32 - 8 * index_sizes[encoder->pending.index_type]);
    const bool restarts = encoder->pending.pipeline->def.primitive_restart;
    bool any = false;
    for (uint64_t i = draw->first; i < (uint64_t)draw->first + count; i++) {
        const uint32_t index = index_at(encoder, i);
        if (restarts && index == restart) {
            continue;
        }
        *least = !any || index < *least ? index : *least;
        *most = !any || index > *most ? index : *most;
        any = true;
    }
    return any;
}

static bool check_indices(const struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count,
                          const char *where)
{
    const uint32_t size = index_sizes[encoder->pending.index_type];
    const struct rhw_bound_buffer *const bound = &encoder->bound.indices;
    const uint64_t there = bound->size / size;
    uint32_t least = 0, most = 0;
    if (!rhw_check(
            encoder->context, bound->offset % size == 0,
            "%s: the index buffer was set with offset %zu; it must be a multiple of the %u bytes of an index",
            where, bound->offset, (unsigned)size) ||
        !rhw_check(encoder->context, bound->data || (uintptr_t)bound->memory % size == 0,
                   "%s: the index memory is %p; its address must be a multiple of the %u bytes of an index",
                   where, (const void *)bound->memory, (unsigned)size) ||
        !rhw_check(encoder->context, (uint64_t)draw->first + count <= there,
                   "%s: first is %u and count is %u; the index buffer has %llu indices", where,
                   (unsigned)draw->first, (unsigned)count, (unsigned long long)there)) {
        return false;
    }
    if (!find_indices(encoder, draw, count, &least, &most)) {
        return true;
    }
    const int64_t base = (int32_t)draw->base_vertex;
    return check_elements(encoder, false, base + least, base + most, where);
}

bool rhw_draw_range_check(const struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count,
                          const char *where)
{
    if (count == 0 || draw->instances == 0) {
        return true;
    }
    const bool vertices =
        draw->indexed ? check_indices(encoder, draw, count, where)
                      : check_elements(encoder, false, draw->first, (int64_t)draw->first + count - 1, where);
    return vertices && check_constants(encoder, where) &&
           check_elements(encoder, true, draw->first_instance,
                          (int64_t)draw->first_instance + draw->instances - 1, where);
}
