// SPDX-License-Identifier: MIT
// Vertices that no vertex function made: the ends of clipped lines, and the corners of polygons drawn as lines or
// points with the flat values of the polygon. They stand in segments of their own.
#ifndef RHW_MADE_VERTICES_H
#define RHW_MADE_VERTICES_H

#include "base/arena.h"
#include "kernels/raster/vertex_record.h"
#include "geometry_scratch.h"

// Make room for `count` more vertices in one segment of the run's draw and instance. Give the slot of the first vertex,
// and the segment's number. Return NULL when out of memory, which the scratch remembers.
static struct rhw_vertex_record *make_vertices(struct rhw_geometry_scratch *scratch, uint32_t run,
                                               uint32_t count, uint32_t *segment, uint32_t *slot)
{
    const struct rhw_segment *const own = &scratch->segments[run];
    if (scratch->made_run != run || scratch->made_count + count > RHW_MADE_VERTICES) {
        const size_t size = (size_t)RHW_MADE_VERTICES * (size_t)own->vertex_stride * sizeof(float);
        float *const vertices = rhw_arena_alloc(scratch->arena, size, RHW_CACHE_LINE);
        if (!vertices) {
            scratch->out_of_memory = true;
            return NULL;
        }
        struct rhw_segment *const made = &scratch->segments[scratch->segment_count++];
        *made = *own;
        made->vertices = vertices;
        scratch->made_run = run;
        scratch->made_count = 0;
    }
    *segment = (uint32_t)scratch->segment_count - 1;
    *slot = scratch->made_count;
    scratch->made_count += count;
    return (struct rhw_vertex_record *)(void *)(scratch->segments[*segment].vertices +
                                                (size_t)*slot * (size_t)own->vertex_stride);
}

#endif
