// SPDX-License-Identifier: MIT
// Primitives whose vertices name a viewport or a layer. A primitive takes the viewport and layer that its provoking
// vertex says, and its vertices are projected in this viewport.
//
// A viewport other than the first has a run of its own, with copies of the vertices that are projected anew. It also
// has a draw of its own, which has the viewport's scissor and range of depth; tiles take it for one of several draws. A
// layer only means other bins.
#ifndef RHW_ROUTING_H
#define RHW_ROUTING_H

#include "base/arena.h"
#include "base/simd_layout.h"
#include "kernels/raster/vertex_record.h"
#include "geometry_scratch.h"
#include "projection.h"
#include "vertex_reuse.h"

struct route {
    int32_t viewport, layer;
};

// Numbers of the runs that were made of a run, by viewport. 0: none was made yet.
struct viewport_runs {
    uint32_t number[RHW_MAX_VIEWPORTS];
};

static struct route route_of(const struct rhw_geometry_scratch *scratch, uint32_t run_index, uint32_t i)
{
    const struct rhw_run *const run = &scratch->runs[run_index];
    const struct rhw_segment *const segment = &scratch->segments[run_index];
    const struct rhw_pipeline_data *const pipeline = segment->draw->state->pipeline;
    const int last = pipeline->primitive == RHW_PRIMITIVE_POINTS  ? 0
                     : pipeline->primitive == RHW_PRIMITIVE_LINES ? 1
                                                                  : 2;
    const int corner = pipeline->def.provoking == RHW_PROVOKING_FIRST ? 0 : last;
    const struct rhw_vertex_record *const v = record_at(segment, run->indices[i][corner] - run->first_slot);
    struct route route;
    memcpy(&route, v->varyings + pipeline->route_component, sizeof route);
    return route;
}

static bool same_route(struct route a, struct route b)
{
    return a.viewport == b.viewport && a.layer == b.layer;
}

static bool is_drawn(const struct rhw_geometry_scratch *scratch, struct route route)
{
    return route.viewport >= 0 && route.viewport < RHW_MAX_VIEWPORTS && route.layer >= 0 &&
           route.layer < scratch->layers;
}

// Project 8 records as the state has it. What the vertex function said of distances stays.
static void project_again(const struct rhw_draw_state *state, int stride, float *records,
                          struct rhw_snapped_vertex *vertices)
{
    f32x8 header[8];
    for (int lane = 0; lane < 8; lane++) {
        header[lane] = f32x8_load(records + lane * stride);
    }
    f32x8_transpose(header);
    const i32x8 kept = (i32x8)header[3] & i32x8_splat(RHW_VERTEX_CUT | 0xff0000);
    const f32x8 position[4] = {header[4], header[5], header[6], header[7]};
    project(state, position, header);
    header[3] = (f32x8)((i32x8)header[3] | kept);
    f32x8_transpose(header);
    for (int lane = 0; lane < 8; lane++) {
        f32x8_store(records + lane * stride, header[lane]);
        memcpy(&vertices[lane], &header[lane], sizeof *vertices);
    }
}

// Copy the run's vertices into a run for the draw of a viewport. Return false when out of memory.
static bool copy_run(struct rhw_geometry_scratch *scratch, uint32_t from, const struct rhw_draw *draw,
                     uint32_t to)
{
    const struct rhw_run *const old = &scratch->runs[from];
    const struct rhw_segment *const segment = &scratch->segments[from];
    uint32_t low, high;
    index_range(old, &low, &high);
    const size_t count = high - low + 1, room = (count + 7) & ~(size_t)7;
    const size_t record = (size_t)segment->vertex_stride * sizeof(float);
    float *const records = rhw_arena_alloc(scratch->arena, room * record, RHW_CACHE_LINE);
    struct rhw_snapped_vertex *const snapped =
        rhw_arena_alloc(scratch->arena, room * sizeof *snapped, RHW_CACHE_LINE);
    if (!records || !snapped) {
        return false;
    }
    memcpy(records, record_at(segment, low - old->first_slot), count * record);
    memset((unsigned char *)records + count * record, 0, (room - count) * record);
    for (size_t i = 0; i < room; i += 8) {
        project_again(draw->state, segment->vertex_stride, records + i * (size_t)segment->vertex_stride,
                      snapped + i);
    }
    scratch->segments[to] = *segment;
    scratch->segments[to].draw = draw;
    scratch->segments[to].vertices = records;
    scratch->runs[to] = *old;
    scratch->runs[to].first_slot = low;
    scratch->runs[to].vertices = snapped;
    return true;
}

// Return the number of the run whose vertices are in the viewport.
static uint32_t run_of_viewport(struct rhw_geometry_scratch *scratch, uint32_t run, int viewport,
                                struct viewport_runs *runs)
{
    const struct rhw_draw *const draw = scratch->segments[run].draw;
    if (viewport == 0) {
        return run;
    }
    if (runs->number[viewport] == 0) {
        const uint32_t number = (uint32_t)scratch->segment_count;
        if (!copy_run(scratch, run, &draw->viewports[viewport], number)) {
            scratch->out_of_memory = true;
            return run;
        }
        scratch->segment_count++;
        scratch->made_run = UINT32_MAX; // no run has its vertices in the last segment
        runs->number[viewport] = number;
    }
    return runs->number[viewport];
}

#endif
