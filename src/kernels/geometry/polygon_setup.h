// SPDX-License-Identifier: MIT
// Triangles drawn as their edges or their corners (polygon modes). Whether a triangle is drawn, and which way it faces,
// is decided for the triangle; then each edge is set up as a line and each corner as a point (Vulkan 1.3 §28.10.2).
// Edges are those of the triangle before clipping: a plane cuts them, and adds no edge of its own.
//
// Edges go around the triangle, so that each corner begins an edge: Bresenham's lines leave out the pixel at their end.
//
// Flat values are those of the triangle's provoking vertex. A line takes them from its first or last vertex. So edges
// that have another vertex there, and corners beside it, are drawn between copies that have its flat values.
#ifndef RHW_POLYGON_SETUP_H
#define RHW_POLYGON_SETUP_H

#include "clipped_line.h"
#include "clipped_setup.h"
#include "cull.h"
#include "line_rectangle.h"
#include "point_setup.h"

// Lines and points on their way, in order. 8 of them are set up together. A point has one end alone.
struct part_batch {
    struct lines8 lines;
    f32x8 depth[2];
    int count;
};

// A triangle of a run.
struct polygon {
    uint32_t run, primitive;
    int32_t flags;    // flags of the triangles of its parts
    uint32_t slot[3]; // slots in the run's segment
    const struct rhw_vertex_record *v[3];
};

static void flush_parts(struct rhw_geometry_scratch *scratch, const struct rhw_draw_state *state,
                        struct part_batch *batch, struct rhw_triangle_list *list)
{
    struct lines8 *const l = &batch->lines;
    const unsigned live = 0xffu >> (8 - batch->count);
    if (batch->count == 0) {
        return;
    }
    batch->count = 0;
    l->flags |= clamp_flags8(state, f32x8_min(batch->depth[0], batch->depth[1]),
                             f32x8_max(batch->depth[0], batch->depth[1]));
    if (state->pipeline->primitive == RHW_PRIMITIVE_POLYGON_LINES) {
        l->flags |= i32x8_splat(state->stipple.factor != 0 ? RHW_TRIANGLE_STIPPLE : 0);
        add_lines8(scratch, state, l, live, list);
        return;
    }
    const struct points8 points = {.x = l->x[0],
                                   .y = l->y[0],
                                   .flags = l->flags,
                                   .vertex = l->vertex[0],
                                   .primitive = l->primitive,
                                   .segment = l->segment};
    add_points8(scratch, state, &points, live, list);
}

// Put copies of `count` corners, 1 or 2, with the flat values of the provoking one, in lane `lane`. Return false when
// out of memory.
static bool copy_corners(struct rhw_geometry_scratch *scratch, const struct polygon *p, const int corner[2],
                         uint32_t count, struct lines8 *l, int lane)
{
    const struct rhw_segment *const segment = &scratch->segments[p->run];
    const struct rhw_pipeline_data *const pipeline = segment->draw->state->pipeline;
    const struct rhw_vertex_record *const provoking =
        p->v[pipeline->def.provoking == RHW_PROVOKING_FIRST ? 0 : 2];
    const size_t stride = (size_t)segment->vertex_stride;
    uint32_t number, slot;
    float *const made = (float *)(void *)make_vertices(scratch, p->run, count, &number, &slot);
    if (!made) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        struct rhw_vertex_record *const out = (struct rhw_vertex_record *)(void *)(made + i * stride);
        memcpy(out, p->v[corner[i]], stride * sizeof(float));
        for (int f = 0; f < pipeline->flat_count; f++) {
            const int component = pipeline->flat_component[f];
            out->varyings[component] = provoking->varyings[component];
        }
        l->vertex[i][lane] = (int32_t)(slot + i);
    }
    l->segment[lane] = (int32_t)number;
    return true;
}

// Add the part between two corners. For a point both are one corner. Where `copies` is true it is drawn between copies,
// with the flat values of a third corner.
static void add_part(struct rhw_geometry_scratch *scratch, const struct polygon *p, const int corner[2],
                     bool copies, struct part_batch *batch)
{
    struct lines8 *const l = &batch->lines;
    const int lane = batch->count;
    const bool is_point = corner[0] == corner[1];
    for (int i = 0; i < 2; i++) {
        const struct rhw_vertex_record *const v = p->v[corner[i]];
        l->x[i][lane] = v->x_24_8;
        l->y[i][lane] = v->y_24_8;
        batch->depth[i][lane] = v->depth;
        l->vertex[i][lane] = (int32_t)p->slot[corner[i]];
    }
    l->segment[lane] = (int32_t)p->run;
    l->primitive[lane] = (int32_t)p->primitive;
    l->flags[lane] = p->flags;
    if (copies && !copy_corners(scratch, p, corner, is_point ? 1 : 2, l, lane)) {
        return;
    }
    const uint32_t any = p->v[corner[0]]->flags | p->v[corner[1]]->flags;
    if (!is_point && any & RHW_VERTEX_CLIP) {
        batch->depth[0][lane] = batch->depth[1][lane] = 0;
        batch->count += clip_line_lane(scratch, p->run, l, lane);
        return;
    }
    batch->count++;
}

// Add the edges or the corners of a triangle.
static void add_parts(struct rhw_geometry_scratch *scratch, const struct rhw_draw_state *state,
                      const struct polygon *p, struct part_batch *batch, struct rhw_triangle_list *list)
{
    static const int edges[3][2] = {{0, 1}, {1, 2}, {2, 0}}, corners[3][2] = {{0, 0}, {1, 1}, {2, 2}};
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const bool is_lines = pipeline->primitive == RHW_PRIMITIVE_POLYGON_LINES;
    const bool is_first = pipeline->def.provoking == RHW_PROVOKING_FIRST;
    for (int i = 0; i < 3; i++) {
        const int *const corner = is_lines ? edges[i] : corners[i];
        const uint32_t all = p->v[corner[0]]->flags & p->v[corner[1]]->flags;
        const bool copies = pipeline->flat_count != 0 && corner[is_first ? 0 : 1] != (is_first ? 0 : 2);
        if (all & (is_lines ? RHW_VERTEX_OUTSIDE : RHW_VERTEX_OUTSIDE | RHW_VERTEX_UNSNAPPED)) {
            continue;
        }
        add_part(scratch, p, corner, copies, batch);
        if (batch->count == 8) {
            flush_parts(scratch, state, batch, list);
        }
    }
}

// Set up 8 triangles of a run.
static __attribute__((noinline)) void setup_polygons8(struct rhw_geometry_scratch *scratch,
                                                      const struct run_slice *slice,
                                                      struct rhw_triangle_list *list)
{
    const struct rhw_run *const run = &scratch->runs[slice->run];
    const struct rhw_segment *const segment = &scratch->segments[slice->run];
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const struct triangle8 t = load_triangle8(run->vertices, run->first_slot, slice->indices);
    const unsigned lost = slice->live & flagged8(t.flags_any, RHW_VERTEX_NOT_FINITE);
    const unsigned unsnapped = flagged8(t.flags_any, RHW_VERTEX_UNSNAPPED);
    unsigned negative, nonzero, seen = slice->live & ~lost & ~flagged8(t.flags_all, RHW_VERTEX_OUTSIDE);
    area_signs8(&t, &negative, &nonzero);
    struct part_batch batch = {.count = 0};
    for (unsigned left = seen; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        struct polygon p = {.run = slice->run, .primitive = slice->first_primitive + (uint32_t)lane};
        for (int i = 0; i < 3; i++) {
            p.slot[i] = slice->indices[lane][i] - run->first_slot;
            p.v[i] = record_at(segment, p.slot[i]);
        }
        const unsigned turns =
            unsnapped >> lane & 1 ? (unsigned)homogeneous_turns_negative(state, p.v) : negative >> lane & 1;
        const unsigned back = facing_back(def, turns) & 1;
        if (culled_facing(def, back) & 1) {
            seen &= ~(1u << lane);
            continue;
        }
        p.flags = back ? RHW_TRIANGLE_BACK : 0;
        add_parts(scratch, state, &p, &batch, list);
    }
    flush_parts(scratch, state, &batch, list);
    const unsigned clipped = seen & flagged8(t.flags_any, RHW_VERTEX_CLIP);
    scratch->counters.dropped += (unsigned)__builtin_popcount(lost);
    scratch->counters.culled += (unsigned)__builtin_popcount(slice->live & ~lost & ~seen);
    scratch->counters.clipped += (unsigned)__builtin_popcount(clipped);
    scratch->counters.rasterized += (unsigned)__builtin_popcount(seen);
}

#endif
