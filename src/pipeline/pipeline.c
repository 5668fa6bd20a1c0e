// SPDX-License-Identifier: MIT
// Pipelines: every rule about a definition is checked here, once, so that a draw need not look again.
#include "pipeline.h"

#include <stdio.h>
#include <string.h>

#include "blend_state.h"
#include "base/constants.h"
#include "context/context.h"
#include "depth_stencil.h"
#include "context/entry.h"
#include "format/format.h"
#include "line_stipple.h"
#include "context/lookup.h"
#include "context/misuse.h"
#include "rhw/rhw.h"

static const char *const create_name = "rhw_pipeline_create";

static const uint32_t known_uses =
    RHW_USE_COORD | RHW_USE_FACING | RHW_USE_IDS | RHW_USE_BARYCENTRIC | RHW_USE_DISCARD | RHW_USE_DEPTH |
    RHW_USE_BARYCENTRIC_DERIVATIVES | RHW_USE_SAMPLE | RHW_USE_SAMPLE_MASK | RHW_USE_POINT_COORD |
    RHW_USE_FULLY_COVERED | RHW_USE_LAYER | RHW_USE_EFFECTS | RHW_USE_TARGET_INPUT;

static bool check_range(const struct rhw_context *context, const char *field, long long value, long long low,
                        long long high)
{
    return rhw_check(context, value >= low && value <= high, "%s: %s is %lld; it must be %lld..%lld",
                     create_name, field, value, low, high);
}

// `type` is the enum that the value is of, without the word.
static bool check_enum(const struct rhw_context *context, const char *field, const char *type, int value,
                       int last)
{
    return rhw_check(context, value >= 0 && value <= last, "%s: %s is %d; it must be 0..%d (enum %s)",
                     create_name, field, value, last, type);
}

static bool check_element(const struct rhw_context *context, const char *array, int index, const char *field,
                          long long value, long long low, long long high)
{
    return rhw_check(context, value >= low && value <= high, "%s: %s[%d].%s is %lld; it must be %lld..%lld",
                     create_name, array, index, field, value, low, high);
}

// Program ----------------------------------------------------------------------------------------------

static bool check_functions(const struct rhw_context *context, const struct rhw_program *program)
{
    bool any_vertex = false;
    bool any_fragment = false;
    for (int i = 0; i < RHW_ISA_COUNT; i++) {
        any_vertex |= program->vertex[i] != NULL;
        any_fragment |= program->fragment[i] != NULL;
    }
    return rhw_check(context, any_vertex || program->vertex1 != NULL,
                     "%s: program.vertex and program.vertex1 are NULL; one of them must be set",
                     create_name) &&
           rhw_check(context, !any_vertex || program->vertex[RHW_ISA_BASELINE] != NULL,
                     "%s: program.vertex[RHW_ISA_BASELINE] is NULL; it must be set where another entry is",
                     create_name) &&
           rhw_check(context, !any_fragment || program->fragment[RHW_ISA_BASELINE] != NULL,
                     "%s: program.fragment[RHW_ISA_BASELINE] is NULL; it must be set where another entry is",
                     create_name);
}

// Varyings that a struct names are all of its members, in order.
static bool check_member(const struct rhw_context *context, const struct rhw_program *program, int index,
                         int components)
{
    const struct rhw_varying *const varying = &program->varyings[index];
    if (varying->name == NULL) {
        return rhw_check(
            context, index == 0 || program->varyings[0].name == NULL,
            "%s: program.varyings[%d] has no name where those before it are of a struct; it must be made "
            "by RHW_VARYING too",
            create_name, index);
    }
    return rhw_check(context, index == 0 || program->varyings[0].name != NULL,
                     "%s: program.varyings[%d] is %s of a struct and those before it have no name; all of "
                     "them must be "
                     "made by RHW_VARYING",
                     create_name, index, varying->name) &&
           rhw_check(context, varying->components >= 1 && varying->components <= 4,
                     "%s: program.varyings[%d], %s, has %d components; it must be 1..4, of rhw_float where "
                     "RHW_VARYING "
                     "makes it and of float where RHW_VARYING1 does",
                     create_name, index, varying->name, varying->components) &&
           rhw_check(context, varying->offset == components,
                     "%s: program.varyings[%d], %s, begins at component %d of its struct, after %d that are "
                     "listed; every "
                     "member must be listed, in the struct's order",
                     create_name, index, varying->name, varying->offset, components) &&
           rhw_check(context,
                     index + 1 < program->varying_count ||
                         varying->struct_components == components + varying->components,
                     "%s: program.varyings[%d], %s, is the last and ends at component %d of its struct, "
                     "which has %d; "
                     "every member must be listed",
                     create_name, index, varying->name, components + varying->components,
                     varying->struct_components);
}

static bool check_varyings(const struct rhw_context *context, const struct rhw_program *program)
{
    static const char *const array = "program.varyings";
    if (!check_range(context, "program.varying_count", program->varying_count, 0, RHW_MAX_VARYINGS)) {
        return false;
    }
    int components = 0;
    for (int i = 0; i < program->varying_count; i++) {
        const struct rhw_varying *const varying = &program->varyings[i];
        if (!check_member(context, program, i, components) ||
            !check_element(context, array, i, "components", varying->components, 1, 4) ||
            !check_element(context, array, i, "qualifier", varying->qualifier, RHW_SMOOTH, RHW_FLAT) ||
            !check_element(context, array, i, "sampling", varying->sampling, RHW_SAMPLING_CENTER,
                           RHW_SAMPLING_SAMPLE)) {
            return false;
        }
        components += varying->components;
    }
    return rhw_check(context, components <= RHW_MAX_VARYING_COMPONENTS,
                     "%s: program.varyings have %d components together; they must have at most %d",
                     create_name, components, RHW_MAX_VARYING_COMPONENTS);
}

static bool check_program(const struct rhw_context *context, const struct rhw_program *program)
{
    return check_functions(context, program) && check_varyings(context, program) &&
           rhw_check(context, (program->uses & ~known_uses) == 0,
                     "%s: program.uses is 0x%x; it must be or-ed from enum rhw_fragment_use (0x%x)",
                     create_name, (unsigned)program->uses, (unsigned)known_uses) &&
           check_range(context, "program.uniform_size", program->uniform_size, 0, RHW_MAX_UNIFORM_SIZE) &&
           check_range(context, "program.clip_distance_count", program->clip_distance_count, 0,
                       RHW_MAX_CLIP_DISTANCES) &&
           check_range(context, "program.cull_distance_count", program->cull_distance_count, 0,
                       RHW_MAX_CULL_DISTANCES);
}

// Vertex input -----------------------------------------------------------------------------------------

// As WebGPU has it, an attribute ends within its element, so that a wrong offset or stride is found here.
static bool check_attribute(const struct rhw_context *context, const struct rhw_pipeline_def *def, int index)
{
    const struct rhw_attribute *const attribute = &def->attributes[index];
    if (!check_element(context, "attributes", index, "format", attribute->format, 0,
                       RHW_VERTEX_FORMAT_COUNT - 1) ||
        !rhw_check(context, attribute->buffer >= 0 && attribute->buffer < def->buffer_count,
                   "%s: attributes[%d].buffer is %d; it must be below buffer_count, which is %d", create_name,
                   index, attribute->buffer, def->buffer_count)) {
        return false;
    }
    const uint32_t stride = def->buffers[attribute->buffer].stride;
    const size_t size = rhw_vertex_format_size(attribute->format);
    const size_t most = stride == 0 ? UINT32_MAX : stride; // which is as much as a computed one can be
    return rhw_check(
        context, attribute->offset <= most && size <= most - attribute->offset,
        "%s: attributes[%d].offset is %u and its format takes %zu bytes; together they must stay "
        "within buffers[%d].stride, which is %u",
        create_name, index, (unsigned)attribute->offset, size, attribute->buffer, (unsigned)most);
}

static bool check_layout(const struct rhw_context *context, int index, const struct rhw_vertex_layout *layout)
{
    return rhw_check(context, !layout->constant || !layout->per_instance,
                     "%s: buffers[%d] is constant and per_instance; it must be one of them at most",
                     create_name, index) &&
           rhw_check(context, layout->per_instance || layout->instance_step == 0,
                     "%s: buffers[%d].instance_step is %u; it must be 0 in a buffer that is not per_instance",
                     create_name, index, (unsigned)layout->instance_step) &&
           rhw_check(context, !layout->constant || layout->stride == 0,
                     "%s: buffers[%d].stride is %u; it must be 0 in a buffer that is constant", create_name,
                     index, (unsigned)layout->stride);
}

// Arrays that were filled and not counted.
static bool check_counts(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    const struct rhw_attribute *const first = &def->attributes[0];
    return rhw_check(context, def->attribute_count > 0 || (first->format == 0 && first->offset == 0),
                     "%s: attributes[0] is set and attribute_count is 0", create_name) &&
           rhw_check(context, def->program.varying_count > 0 || def->program.varyings[0].components == 0,
                     "%s: program.varyings[0] is set and program.varying_count is 0", create_name);
}

static bool check_vertex_input(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    if (!check_range(context, "buffer_count", def->buffer_count, 0, RHW_MAX_VERTEX_BUFFERS) ||
        !check_range(context, "attribute_count", def->attribute_count, 0, RHW_MAX_ATTRIBUTES) ||
        !check_counts(context, def)) {
        return false;
    }
    for (int i = 0; i < def->buffer_count; i++) {
        if (!check_layout(context, i, &def->buffers[i])) {
            return false;
        }
    }
    for (int i = 0; i < def->attribute_count; i++) {
        if (!check_attribute(context, def, i)) {
            return false;
        }
    }
    return true;
}

// Fixed functions --------------------------------------------------------------------------------------

static bool check_stencil_face(const struct rhw_context *context, const char *name,
                               const struct rhw_stencil_face *face)
{
    const unsigned last = RHW_STENCIL_DECREMENT_WRAP;
    return rhw_check(context, (unsigned)face->compare <= RHW_COMPARE_ALWAYS,
                     "%s: %s.compare is %d; it must be 0..%d (enum rhw_compare)", create_name, name,
                     (int)face->compare, RHW_COMPARE_ALWAYS) &&
           rhw_check(context, face->compares || face->compare == 0,
                     "%s: %s.compare is %d and compares is false; it must be true for a face that compares",
                     create_name, name, (int)face->compare) &&
           rhw_check(context,
                     (unsigned)face->fail <= last && (unsigned)face->depth_fail <= last &&
                         (unsigned)face->pass <= last,
                     "%s: %s has operations %d, %d, %d; not all are stencil operations, 0..%d (enum "
                     "rhw_stencil_operation)",
                     create_name, name, (int)face->fail, (int)face->depth_fail, (int)face->pass, (int)last) &&
           rhw_check(context,
                     face->read_mask <= RHW_STENCIL_NO_BITS && face->write_mask <= RHW_STENCIL_NO_BITS,
                     "%s: %s has masks 0x%x and 0x%x; each is 0..0xff, or RHW_STENCIL_NO_BITS alone",
                     create_name, name, (unsigned)face->read_mask, (unsigned)face->write_mask);
}

static bool check_depth_stencil(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    return rhw_check_depth_bias(context, &def->depth_bias, create_name) &&
           check_stencil_face(context, "stencil_front", &def->stencil_front) &&
           check_stencil_face(context, "stencil_back", &def->stencil_back);
}

static bool check_line_width(const struct rhw_context *context, float width)
{
    return rhw_check(context, width == 0 || (width >= 1 && width <= RHW_MAX_LINE_WIDTH),
                     "%s: line_width is %g; it must be 1..%d, or 0 for 1", create_name, (double)width,
                     RHW_MAX_LINE_WIDTH);
}

static bool check_states(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    return check_enum(context, "topology", "rhw_topology", (int)def->topology, RHW_LINE_LOOP) &&
           check_enum(context, "polygon_mode", "rhw_polygon_mode", (int)def->polygon_mode,
                      RHW_POLYGON_POINT) &&
           check_line_width(context, def->line_width) &&
           check_enum(context, "line_mode", "rhw_line_mode", (int)def->line_mode,
                      RHW_LINE_RECTANGULAR_SMOOTH) &&
           check_enum(context, "conservative", "rhw_conservative", (int)def->conservative,
                      RHW_CONSERVATIVE_UNDERESTIMATE) &&
           rhw_check_line_stipple(context, &def->line_stipple, create_name) &&
           check_enum(context, "provoking", "rhw_provoking", (int)def->provoking, RHW_PROVOKING_LAST) &&
           check_enum(context, "cull", "rhw_cull", (int)def->cull, RHW_CULL_BOTH) &&
           check_enum(context, "front", "rhw_winding", (int)def->front, RHW_CLOCKWISE) &&
           check_enum(context, "depth_range", "rhw_depth_range", (int)def->depth_range,
                      RHW_DEPTH_MINUS_ONE_TO_ONE) &&
           check_enum(context, "depth_compare", "rhw_compare", (int)def->depth_compare, RHW_COMPARE_ALWAYS) &&
           check_enum(context, "logic", "rhw_logic", (int)def->logic, RHW_LOGIC_SET) &&
           check_depth_stencil(context, def);
}

static bool check_blend(const struct rhw_context *context, int index, const char *src, const char *dst,
                        const char *operation, const struct rhw_blend_component *blend)
{
    return check_element(context, "targets", index, src, blend->src, 0, RHW_BLEND_ONE_MINUS_SRC1_ALPHA) &&
           check_element(context, "targets", index, dst, blend->dst, 0, RHW_BLEND_ONE_MINUS_SRC1_ALPHA) &&
           check_element(context, "targets", index, operation, blend->operation, 0, RHW_BLEND_MAX);
}

static bool check_target(const struct rhw_context *context, int index, const struct rhw_color_target *target)
{
    if (target->format == RHW_FORMAT_NONE) {
        return rhw_check(context, !target->blend,
                         "%s: targets[%d].blend is true and its format is not set (RHW_FORMAT_NONE), which "
                         "leaves the target out",
                         create_name, index);
    }
    char field[32];
    snprintf(field, sizeof field, "targets[%d].format", index);
    if (!rhw_check_format(context, create_name, field, target->format)) {
        return false;
    }
    const struct rhw_format_info *const format = rhw_format_info(target->format);
    return rhw_check(context, rhw_format_has_role(format, RHW_ROLE_COLOR_TARGET),
                     "%s: targets[%d].format is %s; it must be a format that can be drawn into as colour",
                     create_name, index, format->name) &&
           rhw_check(context, !target->blend || rhw_format_has_role(format, RHW_ROLE_BLENDED_TARGET),
                     "%s: targets[%d].blend is true; it must be false for %s", create_name, index,
                     format->name) &&
           check_blend(context, index, "color.src", "color.dst", "color.operation", &target->color) &&
           check_blend(context, index, "alpha.src", "alpha.dst", "alpha.operation", &target->alpha) &&
           rhw_check(context, target->write_mask <= RHW_WRITE_NONE,
                     "%s: targets[%d].write_mask is %d; it must be or-ed from the channels of enum "
                     "rhw_write_mask, or RHW_WRITE_NONE (%d) alone",
                     create_name, index, target->write_mask, RHW_WRITE_NONE);
}

static bool has_fragment(const struct rhw_program *program)
{
    return program->fragment[RHW_ISA_BASELINE] != NULL || program->fragment1 != NULL;
}

// Targets that were counted and not filled; some may be left out.
static bool check_any_format(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    bool any = def->target_count == 0;
    for (int i = 0; i < def->target_count; i++) {
        any |= def->targets[i].format != RHW_FORMAT_NONE;
    }
    return rhw_check(
        context, any,
        "%s: targets[0].format is not set (RHW_FORMAT_NONE), nor is that of another target; give one "
        "of them a format, or set target_count = 0",
        create_name);
}

static bool check_targets(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    if (!check_range(context, "target_count", def->target_count, 0, RHW_MAX_COLOR_ATTACHMENTS) ||
        !rhw_check(context, !def->alpha_to_coverage || has_fragment(&def->program),
                   "%s: alpha_to_coverage is true and the program has no fragment function, which would give "
                   "alpha",
                   create_name) ||
        !check_any_format(context, def)) {
        return false;
    }
    for (int i = 0; i < def->target_count; i++) {
        if (!check_target(context, i, &def->targets[i]) ||
            !rhw_check(context, def->target_count == 1 || !rhw_blend_reads_second(&def->targets[i]),
                       "%s: targets[%d] blends with the second source, color[1], and target_count is %d; it "
                       "must be 1",
                       create_name, i, def->target_count) ||
            !rhw_check(context,
                       has_fragment(&def->program) || def->targets[i].format == RHW_FORMAT_NONE ||
                           def->targets[i].write_mask == RHW_WRITE_NONE,
                       "%s: the program has no fragment function and targets[%d] is written; give it one, or "
                       "the target the write_mask RHW_WRITE_NONE",
                       create_name, i)) {
            return false;
        }
    }
    return true;
}

// Flags of the program that its shaders would draw other bytes with.
static bool check_flaws(const struct rhw_context *context, uint32_t flaws)
{
    return rhw_check(context, (flaws & RHW_ARITHMETIC_FUSED) == 0,
                     "%s: multiplications and additions are fused in the file that calls it, so its shaders "
                     "would draw other bytes on other machines; compile it with -ffp-contract=off",
                     create_name) &&
           rhw_check(
               context, (flaws & RHW_ARITHMETIC_REORDERED) == 0,
               "%s: sums are reordered or not rounded to float in the file that calls it, so its shaders "
               "would draw other bytes on other machines; compile it without -fassociative-math, "
               "-funsafe-math-optimizations and -ffast-math",
               create_name) &&
           rhw_check(context, flaws == 0, "%s: flaws is 0x%x; it must be what rhw_arithmetic_flaws gives",
                     create_name, (unsigned)flaws);
}

// Whether it does without blending what it does with it.
static bool replaces(const struct rhw_blend_component *blend)
{
    return (blend->src == RHW_BLEND_DEFAULT || blend->src == RHW_BLEND_ONE) &&
           (blend->dst == RHW_BLEND_DEFAULT || blend->dst == RHW_BLEND_ZERO) &&
           blend->operation == RHW_BLEND_ADD;
}

static bool is_set(const struct rhw_stencil_face *face)
{
    return face->compares || face->fail != RHW_STENCIL_KEEP || face->depth_fail != RHW_STENCIL_KEEP ||
           face->pass != RHW_STENCIL_KEEP || face->read_mask != 0 || face->write_mask != 0;
}

// Under validation: what is set and switched off. Programs that switch on and off leave it so, hence no misuse.
static void warn_of_contradictions(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    for (int i = 0; i < def->target_count; i++) {
        const struct rhw_color_target *const target = &def->targets[i];
        if (!target->blend && !(replaces(&target->color) && replaces(&target->alpha))) {
            rhw_context_log(context, RHW_LOG_WARNING,
                            "%s: targets[%d].color or .alpha is set and targets[%d].blend is false",
                            create_name, i, i);
        }
    }
    if (!def->stencil_test && (is_set(&def->stencil_front) || is_set(&def->stencil_back))) {
        rhw_context_log(context, RHW_LOG_WARNING,
                        "%s: stencil_front or stencil_back is set and stencil_test is false", create_name);
    }
    if (def->depth_read_only && !def->depth_test) {
        rhw_context_log(context, RHW_LOG_WARNING, "%s: depth_read_only is true and depth_test is false",
                        create_name);
    }
}

static bool check_create(const struct rhw_context *context, const struct rhw_pipeline_def *def,
                         uint32_t flaws, const rhw_pipeline *pipeline)
{
    return rhw_check(context, def != NULL, "%s: def is NULL", create_name) &&
           rhw_check(context, pipeline != NULL, "%s: pipeline is NULL", create_name) &&
           check_flaws(context, flaws) && check_program(context, &def->program) &&
           check_vertex_input(context, def) && check_states(context, def) && check_targets(context, def) &&
           rhw_feedback_check(context, def, create_name);
}

// What draws need --------------------------------------------------------------------------------------

static void resolve_blend(struct rhw_blend_component *blend)
{
    blend->src = blend->src == RHW_BLEND_DEFAULT ? RHW_BLEND_ONE : blend->src;
    blend->dst = blend->dst == RHW_BLEND_DEFAULT ? RHW_BLEND_ZERO : blend->dst;
}

// What zero stands for in a definition, so that what reads it later knows no defaults: a mask of 0 then writes nothing,
// and a stride of 0 is that of a constant buffer.
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
        layout->stride = layout->stride == 0 && !layout->constant ? ends[i] : layout->stride;
        layout->instance_step = layout->instance_step == 0 ? 1 : layout->instance_step;
    }
}

// What alpha decides is left out where target 0 has integers (Vulkan 1.3 §28.9).
static void resolve_alpha(struct rhw_pipeline_def *def)
{
    if (def->target_count > 0 && rhw_format_is_integer(rhw_format_info(def->targets[0].format))) {
        def->alpha_to_coverage = def->alpha_to_one = false;
    }
}

// Of the fragment function: alpha may decide about coverage where no target has it.
static int count_outputs(const struct rhw_pipeline_def *def)
{
    if (def->target_count == 0) {
        return def->alpha_to_coverage;
    }
    return def->target_count + (def->target_count == 1 && rhw_blend_reads_second(&def->targets[0]));
}

// With two-sided stencil after the fragment function, groups say which way their fragments face.
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

static void add_smooth(struct rhw_pipeline_data *data, int component)
{
    if (data->smooth_runs == 0 || data->smooth_run[data->smooth_runs - 1].end != component) {
        data->smooth_run[data->smooth_runs++].first = component;
    }
    data->smooth_run[data->smooth_runs - 1].end = component + 1;
}

static void lay_out_varyings(struct rhw_pipeline_data *data)
{
    int next = 0;
    for (int i = 0; i < data->def.program.varying_count; i++) {
        const struct rhw_varying *const varying = &data->def.program.varyings[i];
        data->any_noperspective |= varying->qualifier == RHW_NOPERSPECTIVE;
        data->any_derivatives |= varying->derivatives;
        data->sampling = varying->sampling > data->sampling ? varying->sampling : data->sampling;
        for (int component = 0; component < varying->components; component++) {
            data->component_qualifier[next] = (uint8_t)varying->qualifier;
            data->component_derivatives[next] = varying->derivatives;
            if (varying->qualifier == RHW_FLAT) {
                data->flat_component[data->flat_count++] = (uint8_t)next;
            } else if (varying->qualifier == RHW_SMOOTH) {
                add_smooth(data, next);
            }
            data->any_constant_derivatives |= varying->derivatives && varying->qualifier != RHW_SMOOTH;
            data->noperspective_mask[next] = varying->qualifier == RHW_NOPERSPECTIVE ? -1 : 0;
            data->flat_mask[next] = varying->qualifier == RHW_FLAT ? -1 : 0;
            next++;
        }
    }
    data->varying_components = next;
}

// Tells how packing treats components by eights (pipeline.h).
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

// Lists the smooth components with derivatives by twos (pipeline.h).
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

// Tells what is drawn, and what of a vertex the front end needs for it beside its varyings.
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
    data->def.label = NULL; // which is the caller's
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

void rhw_pipeline_data_release(struct rhw_memory *memory, struct rhw_pipeline_data *data)
{
    rhw_memory_release(memory, data->validator, data->validator_size);
}

static enum rhw_result create(struct rhw_context *context, const struct rhw_pipeline_def *def, uint32_t flaws,
                              rhw_pipeline *pipeline)
{
    if (!check_create(context, def, flaws, pipeline)) {
        return RHW_ERROR_MISUSE;
    }
    if (context->validation) {
        warn_of_contradictions(context, def);
    }
    rhw_pipeline id = {.context = context->number};
    struct rhw_pipeline_data *const data =
        rhw_pool_add(&context->memory, &context->pipelines, def->label, &id.index, &id.generation);
    if (data == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    rhw_pipeline_data_init(data, def, context->isa);
    if (context->validate_pipeline &&
        !context->validate_pipeline(context, data, rhw_name_of(&context->pipelines, id.index).text)) {
        rhw_pool_remove(&context->memory, &context->pipelines, id.index);
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *pipeline = id;
    return RHW_OK;
}

enum rhw_result rhw_pipeline_create_probed(rhw_context *context, const struct rhw_pipeline_def *def,
                                           uint32_t flaws, rhw_pipeline *pipeline)
{
    if (pipeline != NULL) {
        *pipeline = (rhw_pipeline){0};
    }
    if (!rhw_context_enter(context, create_name)) {
        return RHW_ERROR_MISUSE;
    }
    context->definition = def != NULL ? def->label : NULL;
    const enum rhw_result result = create(context, def, flaws, pipeline);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}

void rhw_pipeline_destroy(rhw_context *context, rhw_pipeline pipeline)
{
    static const char *const where = "rhw_pipeline_destroy";
    if (pipeline.index == 0 || !rhw_context_enter(context, where)) {
        return;
    }
    struct rhw_pipeline_data *const data = rhw_context_pipeline(context, pipeline, where);
    if (data != NULL && rhw_context_records(context, &context->pipelines, pipeline.index)) {
        rhw_pool_retire(&context->memory, &context->pipelines, pipeline.index);
    } else if (data != NULL) {
        rhw_pipeline_data_release(&context->memory, data);
        rhw_pool_remove(&context->memory, &context->pipelines, pipeline.index);
    }
    rhw_context_leave(context);
}
