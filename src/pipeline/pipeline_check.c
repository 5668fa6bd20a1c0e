// SPDX-License-Identifier: MIT
// Every rule about the definition of a pipeline is checked here, once, so that no draw checks it again.
#include "pipeline_check.h"

#include <stdio.h>

#include "base/constants.h"
#include "blend_state.h"
#include "context/misuse.h"
#include "depth_stencil.h"
#include "line_stipple.h"
#include "pipeline.h"
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

// Check a value of an enum. `type` is the name of the enum without the word "enum".
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

// Check that varyings which a struct names are all of its members, in order.
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

// An attribute may end behind its element, as in Vulkan. rhw_pipeline_warn tells it, because few programs mean it.
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
    const bool is_computed = def->buffers[attribute->buffer].stride == 0;
    const size_t size = rhw_vertex_format_size(attribute->format);
    return rhw_check(
        context, !is_computed || size <= UINT32_MAX - attribute->offset,
        "%s: attributes[%d].offset is %u and its format takes %zu bytes; buffers[%d].stride is 0 "
        "and together they must stay within the greatest stride, which is %u",
        create_name, index, (unsigned)attribute->offset, size, attribute->buffer, UINT32_MAX);
}

static bool check_layout(const struct rhw_context *context, int index, const struct rhw_vertex_layout *layout)
{
    return rhw_check(context, layout->per_instance || layout->instance_step == 0,
                     "%s: buffers[%d].instance_step is %u; it must be 0 in a buffer that is not per_instance",
                     create_name, index, (unsigned)layout->instance_step) &&
           rhw_check(context, !layout->constant || layout->instance_step == 0,
                     "%s: buffers[%d].instance_step is %u; it must be 0 in a buffer that is constant",
                     create_name, index, (unsigned)layout->instance_step) &&
           rhw_check(context, !layout->constant || layout->per_instance || layout->stride == 0,
                     "%s: buffers[%d].stride is %u; it must be 0 in a buffer that is constant and not "
                     "per_instance",
                     create_name, index, (unsigned)layout->stride);
}

// Report arrays that were filled and not counted.
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

// Report targets that were counted and not filled. Some targets may be left out.
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

// Return true if target 0 alone is written, so that color[1] is free for its second source.
static bool leaves_second(const struct rhw_pipeline_def *def)
{
    bool leaves = true;
    for (int i = 1; i < def->target_count; i++) {
        leaves &= def->targets[i].format == RHW_FORMAT_NONE || def->targets[i].write_mask == RHW_WRITE_NONE;
    }
    return leaves;
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
            !rhw_check(context, !rhw_blend_reads_second(&def->targets[i]) || (i == 0 && leaves_second(def)),
                       "%s: targets[%d] blends with the second source, color[1], and target_count is %d; it "
                       "must be targets[0], and the others must have the write_mask RHW_WRITE_NONE",
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

bool rhw_check_flaws(const struct rhw_context *context, uint32_t flaws, const char *where)
{
    return rhw_check(context, (flaws & RHW_ARITHMETIC_FUSED) == 0,
                     "%s: multiplications and additions are fused in the file that calls it, so its shaders "
                     "would draw other bytes on other machines; compile it with -ffp-contract=off",
                     where) &&
           rhw_check(
               context, (flaws & RHW_ARITHMETIC_REORDERED) == 0,
               "%s: sums are reordered or not rounded to float in the file that calls it, so its shaders "
               "would draw other bytes on other machines; compile it without -fassociative-math, "
               "-funsafe-math-optimizations and -ffast-math",
               where) &&
           rhw_check(context, flaws == 0, "%s: flaws is 0x%x; it must be what rhw_arithmetic_flaws gives",
                     where, (unsigned)flaws);
}

// Return true if blending with these factors gives what no blending gives.
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

bool rhw_pipeline_check(const struct rhw_context *context, const struct rhw_pipeline_def *def, uint32_t flaws,
                        const rhw_pipeline *pipeline)
{
    return rhw_check(context, def != NULL, "%s: def is NULL", create_name) &&
           rhw_check(context, pipeline != NULL, "%s: pipeline is NULL", create_name) &&
           rhw_check_flaws(context, flaws, create_name) && check_program(context, &def->program) &&
           check_vertex_input(context, def) && check_states(context, def) && check_targets(context, def) &&
           rhw_feedback_check(context, def, create_name);
}

void rhw_pipeline_tell_copies(const struct rhw_context *context, enum rhw_isa isa,
                              const struct rhw_program *program)
{
    bool has_vertex = false, has_fragment = false;
    for (int i = RHW_ISA_BASELINE; i <= (int)isa; i++) {
        has_vertex |= program->vertex[i] != NULL;
        has_fragment |= program->fragment[i] != NULL;
    }
    const bool lacks_vertex = has_vertex && program->vertex[isa] == NULL,
               lacks_fragment = has_fragment && program->fragment[isa] == NULL;
    if (lacks_vertex || lacks_fragment) {
        const char *const what = !lacks_fragment ? "program.vertex has"
                                 : !lacks_vertex ? "program.fragment has"
                                                 : "program.vertex and program.fragment have";
        rhw_context_log(context, RHW_LOG_INFO,
                        "%s: %s no copy for %s; draws call that of a lower instruction set, which is slower",
                        create_name, what, rhw_isa_name(isa));
    }
}

// Warn about attributes that end behind their element, where a wrong offset or stride would put them, too.
static void warn_of_strides(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    for (int i = 0; i < def->attribute_count; i++) {
        const struct rhw_attribute *const attribute = &def->attributes[i];
        const uint32_t stride = def->buffers[attribute->buffer].stride;
        const uint64_t end = attribute->offset + (uint64_t)rhw_vertex_format_size(attribute->format);
        if (stride != 0 && end > stride) {
            rhw_context_log(
                context, RHW_LOG_WARNING,
                "%s: attributes[%d] ends at byte %llu of its element and buffers[%d].stride is %u",
                create_name, i, (unsigned long long)end, attribute->buffer, (unsigned)stride);
        }
    }
}

void rhw_pipeline_warn(const struct rhw_context *context, const struct rhw_pipeline_def *def)
{
    warn_of_strides(context, def);
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
