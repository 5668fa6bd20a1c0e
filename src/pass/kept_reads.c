// SPDX-License-Identifier: MIT
// A write between draws costs what the draws before it read of the bytes, however large the buffer is: the buffer stays
// where it is, and those draws get copies. Draws that share a state share a copy.
#include "kept_reads.h"

#include <string.h>

#include "context/context.h"
#include "draw/assembly.h"
#include "encoder.h"
#include "format/format.h"
#include "pipeline/pipeline.h"
#include "resource/buffer_use.h"

// Draws with one state, one behind the other, and what they read at most.
struct state_run {
    uint32_t first, end;  // numbers of the draws
    uint64_t indices_end; // one behind the last index that is read
};

// The largest primitives, triangles with adjacency, have 6 corners.
enum { CORNERS_MOST = 6 };

// Return one behind the last element that an instance of a draw reads, of indices or of vertices without indices.
static uint64_t elements_end(const struct rhw_draw *draw)
{
    return draw->first + CORNERS_MOST * ((uint64_t)draw->triangles_per_instance + 1);
}

static struct state_run run_from(const struct rhw_draw_list *draws, uint32_t first)
{
    const struct rhw_draw_state *const state = rhw_draw_list_at(draws, first)->state;
    struct state_run run = {.first = first, .end = first};
    for (; run.end < draws->count && rhw_draw_list_at(draws, run.end)->state == state; run.end++) {
        const struct rhw_draw *const draw = rhw_draw_list_at(draws, run.end);
        const uint64_t end = draw->indexed ? elements_end(draw) : 0;
        run.indices_end = end > run.indices_end ? end : run.indices_end;
    }
    return run;
}

// Return one behind the largest index of a draw, with the base vertex, at most UINT32_MAX.
static uint32_t find_vertex_end(const struct rhw_draw *draw)
{
    enum { SOME = 256 };
    uint32_t room[SOME][3], most = 0;
    for (uint32_t first = 0; first < draw->triangles_per_instance; first += SOME) {
        const uint32_t left = draw->triangles_per_instance - first;
        const uint32_t count = left < SOME ? left : SOME;
        const uint32_t(*const indices)[3] = rhw_assembly_fetch(draw, first, count, room);
        for (uint32_t i = 0; i < 3 * count; i++) {
            const uint32_t vertex = draw->base_vertex + indices[i / 3][i % 3];
            most = vertex > most ? vertex : most;
        }
    }
    return most < UINT32_MAX ? most + 1 : most;
}

// Return one behind the last vertex that draws of the run read, at most UINT32_MAX.
static uint64_t vertices_end(const struct rhw_draw_list *draws, const struct state_run *run)
{
    uint64_t most = 0;
    for (uint32_t i = run->first; i < run->end; i++) {
        struct rhw_draw *const draw = rhw_draw_list_at(draws, i);
        if (draw->is_shaded_first) {
            return UINT32_MAX; // its primitives do not name vertices
        }
        if (draw->indexed && draw->vertex_end == 0) {
            draw->vertex_end = find_vertex_end(draw);
        }
        const uint64_t end = draw->indexed ? draw->vertex_end : elements_end(draw);
        most = end > most ? end : most;
    }
    return most < UINT32_MAX ? most : UINT32_MAX;
}

// Return how many bytes from its beginning draws read of a stream, at most.
static size_t stream_extent(const struct rhw_draw_list *draws, const struct rhw_draw_state *state,
                            const struct state_run *run, int slot)
{
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const struct rhw_vertex_layout *const layout = &def->buffers[slot];
    const size_t size = state->streams[slot].size;
    uint64_t reach = 0; // end of the attributes in an element
    for (int a = 0; a < def->attribute_count; a++) {
        const struct rhw_attribute *const attribute = &def->attributes[a];
        const uint64_t end = attribute->offset + (uint64_t)rhw_vertex_format_size(attribute->format);
        reach = attribute->buffer == slot && end > reach ? end : reach;
    }
    if (reach == 0 || layout->per_instance) {
        return reach == 0 ? 0 : size;
    }
    const uint64_t extent = vertices_end(draws, run) * layout->stride + reach;
    return extent < size ? (size_t)extent : size;
}

// The part that will be written, as draws see it.
struct written_part {
    const struct rhw_draw_list *draws;
    struct rhw_arena *arena;
    const struct rhw_buffer_data *buffer;
    size_t first, end;
    bool is_read_elsewhere; // some draw reads other bytes of the buffer, where they are
};

// Return true if `bytes` are bytes of the buffer.
static bool is_in_buffer(const struct written_part *part, const unsigned char *bytes)
{
    const uintptr_t begin = (uintptr_t)part->buffer->bytes;
    return (uintptr_t)bytes >= begin && (uintptr_t)bytes < begin + part->buffer->size;
}

// Return what `bytes` of the buffer are to be, of which `extent` are read: a copy if it has some of the part. Return
// NULL when out of memory.
static const unsigned char *kept(struct written_part *part, const unsigned char *bytes, size_t extent)
{
    const size_t offset = (size_t)(bytes - part->buffer->bytes);
    if (extent == 0 || offset >= part->end || offset + extent <= part->first) {
        part->is_read_elsewhere |= extent != 0;
        return bytes;
    }
    unsigned char *const copy = rhw_arena_alloc(part->arena, extent + RHW_BUFFER_PADDING, RHW_CACHE_LINE);
    if (copy) {
        memcpy(copy, bytes, extent);
        memset(copy + extent, 0, RHW_BUFFER_PADDING);
    }
    return copy;
}

static bool keep_stream(struct rhw_draw_state *state, const struct state_run *run, int slot,
                        struct written_part *part)
{
    struct rhw_vertex_stream *const stream = &state->streams[slot];
    if (!is_in_buffer(part, stream->bytes)) {
        return true;
    }
    const size_t extent = stream_extent(part->draws, state, run, slot);
    const unsigned char *const bytes = kept(part, stream->bytes, extent);
    stream->size = bytes == stream->bytes ? stream->size : extent;
    stream->bytes = bytes ? bytes : stream->bytes;
    return bytes != NULL;
}

static bool keep_indices(struct rhw_draw_state *state, const struct state_run *run, struct written_part *part)
{
    if (!is_in_buffer(part, state->indices)) {
        return true;
    }
    static const size_t sizes[] = {[RHW_INDEX_UINT8] = 1, [RHW_INDEX_UINT16] = 2, [RHW_INDEX_UINT32] = 4};
    const size_t size = sizes[state->index_type];
    const size_t extent =
        run->indices_end < state->index_bytes / size ? (size_t)run->indices_end * size : state->index_bytes;
    const unsigned char *const indices = kept(part, state->indices, run->indices_end == 0 ? 0 : extent);
    state->index_bytes = indices == state->indices ? state->index_bytes : extent;
    state->indices = indices ? indices : state->indices;
    return indices != NULL;
}

// Let a state read copies. Return false when out of memory.
static bool keep_state(struct rhw_draw_state *state, const struct state_run *run, struct written_part *part)
{
    bool is_kept = true;
    // Vertices are found by the indices, which are looked at first.
    for (int i = 0; is_kept && i < RHW_MAX_VERTEX_BUFFERS; i++) {
        is_kept = keep_stream(state, run, i, part);
    }
    return is_kept && keep_indices(state, run, part);
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
    struct written_part written = {.draws = draws,
                                   .arena = &encoder->pass->arena,
                                   .buffer = data,
                                   .first = part->first,
                                   .end = part->end};
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
    encoder->pending_changed = true; // the next draw has a state of its own
    return true;
}
