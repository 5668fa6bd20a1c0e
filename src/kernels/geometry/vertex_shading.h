// SPDX-License-Identifier: MIT
// Vertices are fetched from the buffers, run through the vertex function, projected and snapped, and written as the
// records that triangles read.
#ifndef RHW_VERTEX_SHADING_H
#define RHW_VERTEX_SHADING_H

#include "binding/shader_adapter.h"
#include "context/given_up.h"
#include "geometry_scratch.h"
#include "projection.h"
#include "vertex_fetch.h"

// Write 8 vectors of 8 vertices as 8 floats of each vertex.
static void scatter(f32x8 vectors[8], float *records, int stride)
{
    f32x8_transpose(vectors);
    for (int lane = 0; lane < 8; lane++) {
        f32x8_store(records + lane * stride, vectors[lane]);
    }
}

// Return the flags of distances. A distance that is no number is below 0 for clipping, and not below 0 for culling:
// what is unknown is not drawn, but is no reason to leave out what is known.
static __attribute__((noinline)) i32x8 distance_flags(const struct rhw_program *program,
                                                      const struct rhw_vertex *group)
{
    const f32x8 zero = f32x8_splat(0);
    i32x8 flags = i32x8_splat(0);
    for (int i = 0; i < program->clip_distance_count; i++) {
        flags |= ~rhw_less_equal(zero, group->clip_distance[i]) &
                 i32x8_splat((int32_t)RHW_VERTEX_CLIP_DISTANCE << i);
    }
    for (int i = 0; i < program->cull_distance_count; i++) {
        flags |=
            rhw_less(group->cull_distance[i], zero) & i32x8_splat((int32_t)RHW_VERTEX_CULL_DISTANCE << i);
    }
    return flags;
}

// Write what stands behind the varyings.
static __attribute__((noinline)) void store_extras(const struct rhw_pipeline_data *pipeline,
                                                   const struct rhw_vertex *group, int stride, float *records)
{
    const struct rhw_program *const program = &pipeline->def.program;
    for (int lane = 0; lane < 8; lane++) {
        float *out = records + lane * stride + 8 + pipeline->varying_components;
        for (int i = 0; i < program->clip_distance_count; i++) {
            *out++ = group->clip_distance[i][lane];
        }
        for (int i = 0; i < program->cull_distance_count; i++) {
            *out++ = group->cull_distance[i][lane];
        }
        if (program->writes_point_size) {
            *out++ = group->point_size[lane];
        }
        if (pipeline->is_routed) {
            const int32_t route[2] = {program->writes_viewport_index ? group->viewport_index[lane] : 0,
                                      program->writes_layer ? group->layer[lane] : 0};
            memcpy(out, route, sizeof route);
        }
    }
}

// Write the records of 8 vertices, and a copy of what culling reads of them into `vertices`.
static void store_records(const struct rhw_draw_state *state, const struct rhw_vertex *group, int stride,
                          float *records, struct rhw_snapped_vertex *vertices)
{
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const int components = pipeline->varying_components;
    f32x8 vectors[8];
    project(state, group->position, vectors);
    if (pipeline->extra_components != 0) {
        vectors[3] = (f32x8)((i32x8)vectors[3] | distance_flags(&pipeline->def.program, group));
    }
    scatter(vectors, records, stride);
    for (int lane = 0; lane < 8; lane++) {
        memcpy(&vertices[lane], &vectors[lane], sizeof *vertices);
    }
    for (int c = 0; c < components; c += 8) {
        const int n = components - c < 8 ? components - c : 8;
        for (int i = 0; i < 8; i++) {
            vectors[i] = i < n ? group->varying[c + i] : f32x8_splat(0);
        }
        scatter(vectors, records + 8 + c, stride);
    }
    if (pipeline->extra_components != 0) {
        store_extras(pipeline, group, stride, records);
    }
}

// Set the instances, first_instance not included, of 8 vertices from `slot` on, where each instance has `each`. What
// fills up the last group may count as the next instance's.
static __attribute__((noinline)) void several_instances(const struct rhw_segment *segment, uint32_t slot,
                                                        uint32_t each, uint32_t instances[8])
{
    const uint32_t last = segment->draw->instances - 1;
    uint32_t instance = segment->instance + slot / each;
    uint32_t left = each - slot % each;
    for (int lane = 0; lane < 8; lane++) {
        instances[lane] = instance < last ? instance : last;
        left--;
        instance += left == 0;
        left = left == 0 ? each : left;
    }
}

// Return the elements that vertices of these instances read.
static const uint32_t *instance_elements(const struct rhw_draw *draw, const struct rhw_vertex_layout *layout,
                                         const uint32_t instances[8], uint32_t elements[8])
{
    const uint32_t step = layout->instance_step;
    for (int lane = 0; lane < 8; lane++) {
        elements[lane] = draw->first_instance + (step == 1 ? instances[lane] : instances[lane] / step);
    }
    return elements;
}

// Make group `g` ready for the vertex function. Its vertices are those from `slot` on, `each` of an instance.
static void fetch_group(struct rhw_geometry_scratch *scratch, const struct rhw_segment *segment, int g,
                        uint32_t slot, uint32_t each)
{
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    struct rhw_vertex *const group = &scratch->groups[g];
    uint32_t instances[8], element[8];
    i32x8_store(instances, i32x8_splat((int32_t)segment->instance));
    if (slot + 8 > each) {
        several_instances(segment, slot, each, instances);
    }
    memcpy(element, &scratch->unique[slot], sizeof element);
    for (int a = 0; a < def->attribute_count; a++) {
        const struct rhw_attribute *const attribute = &def->attributes[a];
        const struct rhw_vertex_layout *const layout = &def->buffers[attribute->buffer];
        const struct rhw_fetch *const fetch = &state->pipeline->fetches[a];
        const struct rhw_vertex_stream *const stream = &state->streams[attribute->buffer];
        uint32_t stepped[8];
        const uint32_t *const elements =
            layout->per_instance ? instance_elements(segment->draw, layout, instances, stepped) : element;
        f32x8 *const out = scratch->attributes[g][a];
        if (scratch->special_paths && lies_inside(stream, fetch, layout->stride, elements)) {
            fetch_inside(stream, fetch, layout->stride, elements, out);
        } else {
            fetch_checked(stream, fetch, layout->stride, elements, out);
        }
    }
    group->attribute = (const f32x8(*)[4])scratch->attributes[g];
    group->vertex_index = i32x8_load(element);
    // Instances are counted modulo 2^32, as they are in Vulkan.
    group->instance_index =
        (i32x8)((u32x8)i32x8_load(instances) + (u32x8)i32x8_splat((int32_t)segment->draw->first_instance));
    group->uniforms = segment->draw->uniforms;
    group->user = def->program.user;
    group->bindings = segment->draw->bindings;
    group->varying = scratch->varyings + g * state->pipeline->varying_components;
}

// Set the lanes that are vertices, of groups whose function has effects.
static __attribute__((noinline)) void mask_vertices(struct rhw_geometry_scratch *scratch, int groups,
                                                    uint32_t vertices)
{
    for (int g = 0; g < groups; g++) {
        const int32_t left = (int32_t)vertices - 8 * g;
        scratch->groups[g].mask = rhw_less_int(rhw_lane_numbers(), i32x8_splat(left));
    }
}

// Shade `count` vertices, `each` of an instance, whose indices are scratch->unique, into the segment. `count` is
// rounded up to 8: the last group repeats its last vertex, and there is room for it. Return false if the program gives
// up the pass.
static bool shade_vertices(struct rhw_geometry_scratch *scratch, const struct rhw_segment *segment,
                           struct rhw_snapped_vertex *vertices, uint32_t count, uint32_t each)
{
    const struct rhw_draw_state *const state = segment->draw->state;
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const uint32_t total = (count + 7) / 8;
    for (uint32_t i = count; i < 8 * total; i++) {
        scratch->unique[i] = scratch->unique[count - 1];
    }
    for (uint32_t first = 0; first < total; first += RHW_VERTEX_GROUPS) {
        const int groups = (int)(total - first < RHW_VERTEX_GROUPS ? total - first : RHW_VERTEX_GROUPS);
        if (scratch->asked && rhw_context_is_given_up_amid(scratch->asked, scratch->worker, groups)) {
            return false;
        }
        for (int g = 0; g < groups; g++) {
            fetch_group(scratch, segment, g, 8 * (first + (uint32_t)g), each);
        }
        const bool has_effects = pipeline->def.program.vertex_effects;
        if (has_effects) {
            mask_vertices(scratch, groups, count - 8 * first);
        }
        if (pipeline->vertex) {
            pipeline->vertex(scratch->groups, groups);
        } else {
            rhw_vertex1_run(pipeline, scratch->groups, groups);
        }
        if (has_effects) {
            mask_vertices(scratch, groups, 8 * RHW_VERTEX_GROUPS);
        }
        for (int g = 0; g < groups; g++) {
            const size_t slot = 8 * (first + (uint32_t)g);
            store_records(state, &scratch->groups[g], segment->vertex_stride,
                          segment->vertices + slot * (size_t)segment->vertex_stride, vertices + slot);
        }
    }
    return true;
}

#endif
