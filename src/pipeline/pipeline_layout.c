// SPDX-License-Identifier: MIT
// What follows from the definition of a pipeline is worked out here, once, so that no draw works it out again.
#include <string.h>

#include "blend_state.h"
#include "pipeline.h"

static void resolve_blend(struct rhw_blend_component *blend)
{
    blend->src = blend->src == RHW_BLEND_DEFAULT ? RHW_BLEND_ONE : blend->src;
    blend->dst = blend->dst == RHW_BLEND_DEFAULT ? RHW_BLEND_ZERO : blend->dst;
}

// Write out what zero stands for in a definition, so that what reads it later knows no defaults. After this a mask of 0
// writes nothing, and a stride of 0 is that of a constant buffer.
static void resolve_defaults(struct rhw_pipeline_def *def)
{
    const uint8_t all = RHW_WRITE_RED | RHW_WRITE_GREEN | RHW_WRITE_BLUE | RHW_WRITE_ALPHA;
    for (int i = 0; i < def->target_count; i++) {
        struct rhw_color_target *const target = &def->targets[i];
        target->write_mask = target->write_mask == 0 ? all : target->write_mask & all;
        if (target->format == RHW_FORMAT_NONE) {
            *target = (struct rhw_color_target){.format = rhw_left_out_format};
        }
        resolve_blend(&target->color);
        resolve_blend(&target->alpha);
    }
    def->sample_mask = def->sample_mask == 0 ? UINT32_MAX : def->sample_mask;
    def->line_width = def->line_width == 0 ? 1 : def->line_width;
    uint32_t ends[RHW_MAX_VERTEX_BUFFERS] = {0};
    for (int i = 0; i < def->attribute_count; i++) {
        const struct rhw_attribute *const attribute = &def->attributes[i];
        const uint32_t end = attribute->offset + (uint32_t)rhw_vertex_format_size(attribute->format);
        ends[attribute->buffer] = end > ends[attribute->buffer] ? end : ends[attribute->buffer];
    }
    for (int i = 0; i < def->buffer_count; i++) {
        struct rhw_vertex_layout *const layout = &def->buffers[i];
        // There are fewer instances than this step, so all of them read the element of the first.
        const uint32_t step = layout->constant ? UINT32_MAX : 1;
        layout->constant = layout->constant && !layout->per_instance;
        layout->stride = layout->stride == 0 && !layout->constant ? ends[i] : layout->stride;
        layout->instance_step = layout->instance_step == 0 ? step : layout->instance_step;
    }
}

// Leave out what alpha decides where target 0 has integers (Vulkan 1.3 §28.9).
static void resolve_alpha(struct rhw_pipeline_def *def)
{
    if (def->target_count > 0 && rhw_format_is_integer(rhw_format_info(def->targets[0].format))) {
        def->alpha_to_coverage = def->alpha_to_one = false;
    }
}

// Return the number of colours that the fragment function writes. Alpha may decide about coverage where no target has
// it.
static int count_outputs(const struct rhw_pipeline_def *def)
{
    if (def->target_count == 0) {
        return def->alpha_to_coverage;
    }
    return def->target_count + (def->target_count == 1 && rhw_blend_reads_second(&def->targets[0]));
}

// Ask for facing where the two-sided stencil test follows the fragment function, so that groups say which way their
// fragments face.
static void resolve_uses(struct rhw_pipeline_def *def)
{
    const uint32_t late =
        RHW_USE_DISCARD | RHW_USE_DEPTH | RHW_USE_SAMPLE_MASK | RHW_USE_EFFECTS | RHW_USE_TEST_INPUT;
    if (def->stencil_test && (def->program.uses & late || def->alpha_to_coverage)) {
        def->program.uses |= RHW_USE_FACING;
    }
}

static void resolve_attributes(struct rhw_pipeline_data *data)
{
    for (int i = 0; i < data->def.attribute_count; i++) {
        const struct rhw_attribute *const attribute = &data->def.attributes[i];
        data->fetches[i] = rhw_fetch_of(attribute->format, attribute->offset);
    }
}

static void resolve_functions(struct rhw_pipeline_data *data, enum rhw_isa isa)
{
    for (int i = RHW_ISA_BASELINE; i <= (int)isa; i++) {
        if (data->def.program.vertex[i] != NULL) {
            data->vertex = data->def.program.vertex[i];
        }
        if (data->def.program.fragment[i] != NULL) {
            data->fragment = data->def.program.fragment[i];
        }
    }
}

static void add_to_runs(struct rhw_component_run *runs, int *count, int component)
{
    if (*count == 0 || runs[*count - 1].end != component) {
        runs[(*count)++].first = component;
    }
    runs[*count - 1].end = component + 1;
}

static void lay_out_varyings(struct rhw_pipeline_data *data)
{
    int next = 0;
    for (int i = 0; i < data->def.program.varying_count; i++) {
        const struct rhw_varying *const varying = &data->def.program.varyings[i];
        data->any_noperspective |= varying->qualifier == RHW_NOPERSPECTIVE;
        data->any_derivatives |= varying->derivatives;
        data->sampling = varying->sampling > data->sampling ? varying->sampling : data->sampling;
        data->any_at_center |= varying->sampling == RHW_SAMPLING_CENTER && varying->qualifier != RHW_FLAT;
        for (int component = 0; component < varying->components; component++) {
            if (varying->sampling == RHW_SAMPLING_CENTROID) {
                data->centroid_component[data->centroid_count++] = (uint8_t)next;
            }
            data->component_qualifier[next] = (uint8_t)varying->qualifier;
            data->component_derivatives[next] = varying->derivatives;
            if (varying->qualifier == RHW_FLAT) {
                data->flat_component[data->flat_count++] = (uint8_t)next;
            } else if (varying->qualifier == RHW_SMOOTH) {
                add_to_runs(data->smooth_run, &data->smooth_runs, next);
            } else {
                add_to_runs(data->screen_run, &data->screen_runs, next);
            }
            data->any_constant_derivatives |= varying->derivatives && varying->qualifier != RHW_SMOOTH;
            data->noperspective_mask[next] = varying->qualifier == RHW_NOPERSPECTIVE ? -1 : 0;
            data->flat_mask[next] = varying->qualifier == RHW_FLAT ? -1 : 0;
            next++;
        }
    }
    data->varying_components = next;
}

// Tell how packing treats components by eights (pipeline.h).
static void qualify_vectors(struct rhw_pipeline_data *data)
{
    for (int first = 0; first < data->varying_components; first += 8) {
        bool all_smooth = true, all_flat = true;
        for (int i = first; i < first + 8 && i < data->varying_components; i++) {
            all_smooth &= data->component_qualifier[i] == RHW_SMOOTH;
            all_flat &= data->component_qualifier[i] == RHW_FLAT;
        }
        data->vector_qualifier[first / 8] = all_smooth ? RHW_VECTOR_SMOOTH
                                            : all_flat ? RHW_VECTOR_FLAT
                                                       : RHW_VECTOR_MIXED;
    }
}

// List the smooth components with derivatives by twos (pipeline.h).
static void pair_derivatives(struct rhw_pipeline_data *data)
{
    int count = 0;
    for (int i = 0; i < data->varying_components; i++) {
        if (data->component_derivatives[i] && data->component_qualifier[i] == RHW_SMOOTH) {
            data->derivative_component[count / 2][count % 2] = data->derivative_component[count / 2][1] =
                (uint8_t)i;
            count++;
        }
    }
    data->derivative_pairs = (count + 1) / 2;
}

// Tell what is drawn, and what of a vertex the front end needs for it beside its varyings.
static void lay_out_primitives(struct rhw_pipeline_data *data)
{
    const struct rhw_pipeline_def *const def = &data->def;
    switch (def->topology) {
    case RHW_POINT_LIST: data->primitive = RHW_PRIMITIVE_POINTS; break;
    case RHW_LINE_LIST:
    case RHW_LINE_STRIP:
    case RHW_LINE_LIST_ADJACENCY:
    case RHW_LINE_STRIP_ADJACENCY:
    case RHW_LINE_LOOP: data->primitive = RHW_PRIMITIVE_LINES; break;
    default:
        data->primitive = def->polygon_mode == RHW_POLYGON_LINE    ? RHW_PRIMITIVE_POLYGON_LINES
                          : def->polygon_mode == RHW_POLYGON_POINT ? RHW_PRIMITIVE_POLYGON_POINTS
                                                                   : RHW_PRIMITIVE_TRIANGLES;
        break;
    }
    static const int most[] = {
        [RHW_PRIMITIVE_TRIANGLES] = 1,     [RHW_PRIMITIVE_LINES] = 2,          [RHW_PRIMITIVE_POINTS] = 1,
        [RHW_PRIMITIVE_POLYGON_LINES] = 6, [RHW_PRIMITIVE_POLYGON_POINTS] = 3, [RHW_PRIMITIVE_NOTHING] = 1};
    data->primitive = def->rasterizer_discard ? RHW_PRIMITIVE_NOTHING : data->primitive;
    data->triangles_most = most[data->primitive];
    data->is_conservative =
        def->conservative != RHW_CONSERVATIVE_OFF && data->primitive == RHW_PRIMITIVE_TRIANGLES;
    data->is_smooth =
        def->line_mode == RHW_LINE_RECTANGULAR_SMOOTH &&
        (data->primitive == RHW_PRIMITIVE_LINES || data->primitive == RHW_PRIMITIVE_POLYGON_LINES);
    const int distances = def->program.clip_distance_count + def->program.cull_distance_count;
    data->point_size_component = data->varying_components + distances;
    data->extra_components = distances + (def->program.writes_point_size ? 1 : 0);
    data->is_routed = def->program.writes_viewport_index || def->program.writes_layer;
    data->route_component = data->varying_components + data->extra_components;
    data->extra_components += data->is_routed ? 2 : 0;
}

void rhw_pipeline_data_init(struct rhw_pipeline_data *data, const struct rhw_pipeline_def *def,
                            enum rhw_isa isa)
{
    memset(data, 0, sizeof *data);
    data->def = *def;
    data->def.label = NULL; // the label is the caller's memory
    for (int i = 0; i < def->target_count; i++) {
        data->left_out |= def->targets[i].format == RHW_FORMAT_NONE ? 1u << i : 0;
    }
    resolve_defaults(&data->def);
    resolve_alpha(&data->def);
    resolve_uses(&data->def);
    data->output_count = count_outputs(&data->def);
    resolve_attributes(data);
    resolve_functions(data, isa);
    lay_out_varyings(data);
    lay_out_primitives(data);
    qualify_vectors(data);
    pair_derivatives(data);
    data->feedback_targets = rhw_feedback_lay_out(&data->def, data->feedback);
}
