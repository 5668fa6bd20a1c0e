// SPDX-License-Identifier: MIT
// Which draws have a mesh.
#include "mesh.h"

#include "assembly.h"
#include "context.h"
#include "format.h"
#include "kernels/scratch.h"
#include "pass.h"
#include "pipeline.h"

// Elements that lie wholly inside the buffers of a draw, at most UINT32_MAX.
static uint32_t elements_of(const struct rhw_draw_state *state)
{
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    uint64_t count = UINT32_MAX;
    for (int i = 0; i < def->attribute_count; i++) {
        const struct rhw_attribute *const attribute = &def->attributes[i];
        const struct rhw_vertex_layout *const layout = &def->buffers[attribute->buffer];
        const uint64_t size = state->streams[attribute->buffer].size;
        const uint64_t end = attribute->offset + (uint64_t)rhw_vertex_format_size(attribute->format);
        if (layout->per_instance || layout->stride == 0) {
            continue;
        }
        const uint64_t inside = size < end ? 0 : (size - end) / layout->stride + 1;
        count = inside < count ? inside : count;
    }
    return (uint32_t)count;
}

// Whether triangles in the middle of the draw, a few of a chunk, name vertices further apart than a chunk of a mesh has.
static bool is_scattered(const struct rhw_draw *draw, uint64_t chunk)
{
    enum { SAMPLES = 256 };
    uint32_t room[SAMPLES][3];
    const uint32_t(*const corners)[3] =
        rhw_assembly_fetch(draw, draw->triangles_per_instance / 2, SAMPLES, room);
    uint32_t least = UINT32_MAX, most = 0;
    for (int i = 0; i < 3 * SAMPLES; i++) {
        const uint32_t index = corners[i / 3][i % 3];
        least = index < least ? index : least;
        most = index > most ? index : most;
    }
    return most - least >= 3 * chunk / 4;
}

// Vertices of the draw's mesh; 0 where it has none. `chunk`: triangles of one. The draw has several, and more triangles
// than vertices, of which a closed mesh has half as many.
static uint32_t vertices_of(const struct rhw_draw *draw, uint64_t chunk)
{
    const uint32_t triangles = draw->triangles_per_instance;
    if (!draw->indexed || draw->instances != 1 || triangles < RHW_MESH_TRIANGLES || triangles < 2 * chunk) {
        return 0;
    }
    const uint32_t elements = elements_of(draw->state);
    const uint32_t count = draw->base_vertex < elements ? elements - draw->base_vertex : 0;
    return count / 3 <= triangles / 4 && is_scattered(draw, chunk) ? count : 0;
}

bool rhw_meshes_find(struct rhw_pass_state *pass, size_t most, struct rhw_mesh **first, size_t *bytes)
{
    struct rhw_arena *const arena = &pass->workers[0].arena;
    *first = NULL;
    *bytes = 0;
    if (!pass->has_large_draws || pass->chunk_count == 0) {
        return true;
    }
    const struct rhw_chunk *const last = &pass->chunks[pass->chunk_count - 1];
    for (uint32_t d = pass->chunks[0].first_draw; d < pass->draw_count; d++) {
        struct rhw_draw *const draw = rhw_pass_draw_at(pass, d);
        if (draw->first_triangle >= last->first + last->count) {
            break;
        }
        draw->mesh = NULL;
        const size_t count = vertices_of(draw, pass->chunk_size), room = (count + 7) & ~(size_t)7;
        const int stride = rhw_vertex_stride(draw->state->pipeline->varying_components);
        const size_t vertex = (size_t)stride * sizeof(float) + sizeof(struct rhw_corner);
        if (count == 0 || room > (most - *bytes) / vertex) {
            continue;
        }
        struct rhw_mesh *const mesh = rhw_arena_alloc(arena, sizeof *mesh, RHW_CACHE_LINE);
        float *const records =
            rhw_arena_alloc(arena, room * (size_t)stride * sizeof *records, RHW_CACHE_LINE);
        struct rhw_corner *const corners = rhw_arena_alloc(arena, room * sizeof *corners, RHW_CACHE_LINE);
        if (!mesh || !records || !corners) {
            return false;
        }
        *mesh = (struct rhw_mesh){draw, (uint32_t)count, stride, records, corners, *first};
        *first = mesh;
        *bytes += room * vertex;
        draw->mesh = mesh;
    }
    return true;
}
