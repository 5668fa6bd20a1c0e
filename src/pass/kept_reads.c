// SPDX-License-Identifier: MIT
// A write between draws costs what the draws before it read of the bytes, however large the buffer is: the buffer stays
// where it is, and those draws get copies. Draws that share a state share a copy.
#include "kept_reads.h"

#include <string.h>

#include "context/context.h"
#include "encoder.h"
#include "format/format.h"
#include "pipeline/pipeline.h"
#include "resource/buffer_use.h"

// Draws with one state, one behind the other, and what they read at most.
struct state_run {
    uint32_t first, end; // numbers of the draws
    bool is_indexed;     // some draw is
    uint64_t corners;    // vertices of an instance of a draw that is not indexed, counted from element 0
    uint64_t indices;    // indices of a draw that is, counted from index 0
};

// The largest primitives, triangles with adjacency, have 6 corners.
enum { CORNERS_MOST = 6 };

static struct state_run run_from(const struct rhw_draw_list *draws, uint32_t first)
{
    const struct rhw_draw_state *const state = rhw_draw_list_at(draws, first)->state;
    struct state_run run = {.first = first, .end = first};
    for (; run.end < draws->count && rhw_draw_list_at(draws, run.end)->state == state; run.end++) {
        const struct rhw_draw *const draw = rhw_draw_list_at(draws, run.end);
        const uint64_t end = draw->first + CORNERS_MOST * ((uint64_t)draw->triangles_per_instance + 1);
        uint64_t *const most = draw->indexed ? &run.indices : &run.corners;
        *most = end > *most ? end : *most;
        run.is_indexed |= draw->indexed;
    }
    return run;
}

// Return how many bytes from its beginning draws read of a stream, at most.
static size_t stream_extent(const struct rhw_draw_state *state, const struct state_run *run, int slot)
{
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const struct rhw_vertex_layout *const layout = &def->buffers[slot];
    const size_t size = state->streams[slot].size;
    uint64_t reach = 0; // of the attributes of an element
    for (int a = 0; a < def->attribute_count; a++) {
        const struct rhw_attribute *const attribute = &def->attributes[a];
        const uint64_t end = attribute->offset + (uint64_t)rhw_vertex_format_size(attribute->format);
        reach = attribute->buffer == slot && end > reach ? end : reach;
    }
    if (run->is_indexed || layout->per_instance) {
        return reach == 0 ? 0 : size;
    }
    const uint64_t extent = reach == 0 ? 0 : run->corners * layout->stride + reach;
    return extent < size ? (size_t)extent : size;
}

// The part that will be written, as draws see it.
struct written_part {
    struct rhw_arena *arena;
    const struct rhw_buffer_data *buffer;
    size_t first, end;
    bool is_read_elsewhere; // some draw reads other bytes of the buffer, where they are
};

// Return what `bytes` is to be, of which `extent` bytes are read and `size` were set: a copy if it has some of the
// part. Return NULL when out of memory.
static const unsigned char *kept(struct written_part *part, const unsigned char *bytes, size_t extent)
{
    const uintptr_t at = (uintptr_t)bytes, begin = (uintptr_t)part->buffer->bytes;
    if (extent == 0 || at < begin || at >= begin + part->buffer->size) {
        return bytes;
    }
    const size_t offset = (size_t)(at - begin);
    if (offset >= part->end || offset + extent <= part->first) {
        part->is_read_elsewhere = true;
        return bytes;
    }
    unsigned char *const copy = rhw_arena_alloc(part->arena, extent + RHW_BUFFER_PADDING, RHW_CACHE_LINE);
    if (copy) {
        memcpy(copy, bytes, extent);
        memset(copy + extent, 0, RHW_BUFFER_PADDING);
    }
    return copy;
}

// Let a state read copies. Return false when out of memory.
static bool keep_state(struct rhw_draw_state *state, const struct state_run *run, struct written_part *part)
{
    for (int i = 0; i < RHW_MAX_VERTEX_BUFFERS; i++) {
        struct rhw_vertex_stream *const stream = &state->streams[i];
        const size_t extent = stream->bytes ? stream_extent(state, run, i) : 0;
        const unsigned char *const bytes = kept(part, stream->bytes, extent);
        if (stream->bytes && !bytes) {
            return false;
        }
        stream->size = bytes == stream->bytes ? stream->size : extent;
        stream->bytes = bytes;
    }
    const uint64_t read = run->indices * (state->index_type == RHW_INDEX_UINT32 ? 4 : 2);
    const size_t extent = !state->indices ? 0 : read < state->index_bytes ? (size_t)read : state->index_bytes;
    const unsigned char *const indices = kept(part, state->indices, extent);
    if (state->indices && !indices) {
        return false;
    }
    state->index_bytes = indices == state->indices ? state->index_bytes : extent;
    state->indices = indices;
    return true;
}

// Let the states of a draw in its other viewports read what its first one does.
static void keep_routed(const struct rhw_draw *draw)
{
    for (int i = 0; draw->viewports && i < RHW_MAX_VIEWPORTS; i++) {
        struct rhw_draw_state *const routed = (struct rhw_draw_state *)draw->viewports[i].state;
        memcpy(routed->streams, draw->state->streams, sizeof routed->streams);
        routed->indices = draw->state->indices;
        routed->index_bytes = draw->state->index_bytes;
    }
}

bool rhw_encoder_keep_reads(struct rhw_context *context, const struct rhw_buffer_part *part)
{
    struct rhw_encoder *const encoder = context->encoder;
    const struct rhw_draw_list *const draws = &encoder->pass->draws;
    struct rhw_buffer_data *const data = part->data;
    const uint32_t generation = context->recording.generation;
    struct written_part written = {
        .arena = &encoder->pass->arena, .buffer = data, .first = part->first, .end = part->end};
    uint32_t next = data->renewed_pass == generation ? data->renewed_draws : 0;
    while (next < draws->count) {
        const struct state_run run = run_from(draws, next);
        // Recorded states are the pass's own.
        if (!keep_state((struct rhw_draw_state *)rhw_draw_list_at(draws, next)->state, &run, &written)) {
            return false;
        }
        for (; next < run.end; next++) {
            keep_routed(rhw_draw_list_at(draws, next));
        }
    }
    if (!written.is_read_elsewhere) {
        data->renewed_pass = generation;
        data->renewed_draws = context->recording.draw;
    }
    context->recording.rewrites++; // the next draw has a state of its own
    return true;
}
