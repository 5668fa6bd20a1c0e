// SPDX-License-Identifier: MIT
// The file of a program: its functions, compiled once per instruction set, and what they need, once.
#include "emitter.h"

#include <stdio.h>
#include <string.h>

#include "c_emit.h"

static const char *const uses[] = {
    "RHW_USE_COORD",
    "RHW_USE_FACING",
    "RHW_USE_IDS",
    "RHW_USE_LAYER",
    "RHW_USE_POINT_COORD",
    "RHW_USE_BARYCENTRIC",
    "RHW_USE_BARYCENTRIC_DERIVATIVES",
    "RHW_USE_FULLY_COVERED",
    "RHW_USE_SAMPLE",
    "RHW_USE_COLOR_INPUT",
    "RHW_USE_DEPTH_INPUT",
    "RHW_USE_STENCIL_INPUT",
    "RHW_USE_SAMPLE_MASK",
    "RHW_USE_DISCARD",
    "RHW_USE_DEPTH",
    "RHW_USE_EFFECTS",
};

static const char *const qualifiers[] = {
    [RHW_SMOOTH] = "RHW_SMOOTH", [RHW_NOPERSPECTIVE] = "RHW_NOPERSPECTIVE", [RHW_FLAT] = "RHW_FLAT"};

static const char *const samplings[] = {[RHW_SAMPLING_CENTER] = "RHW_SAMPLING_CENTER",
                                        [RHW_SAMPLING_CENTROID] = "RHW_SAMPLING_CENTROID",
                                        [RHW_SAMPLING_SAMPLE] = "RHW_SAMPLING_SAMPLE"};

static void write_top(struct shader_text *file, const struct shader_c_program *program)
{
    const char *const source = shader_c_clean(file->memory, program->source);
    shader_text_line(file, "// %s%s%s, written by rhw as C. Changes are lost when it is written again.",
                     program->name, source[0] ? " of " : "", source);
    shader_text_line(file, "//");
    shader_text_line(
        file, "// rhw_add_shaders compiles it once per instruction set. A program declares what it uses:");
    shader_text_line(file, "//");
    shader_text_line(file, "//     extern const struct %s %s_program;",
                     program->compute ? "rhw_compute_program" : "rhw_program", program->name);
    if (program->layout_count > 0) {
        shader_text_line(file, "//     extern const struct rhw_shader_layout %s_layout[%u];", program->name,
                         (unsigned)program->layout_count);
    }
    shader_text_line(file, "//");
    shader_text_line(file,
                     "// The uniforms of a draw or dispatch are a struct rhw_shader_frame of rhw/spirv.h.");
    uint32_t place = 0;
    for (uint32_t i = 0; i < program->layout_count; i++) {
        const struct rhw_shader_layout *const layout = &program->layout[i];
        const char *const name = shader_c_clean(file->memory, program->layout_names[i]);
        place = i > 0 && program->layout[i - 1].set == layout->set ? place : 0;
        shader_text_line(file, "// sets[%u][%u]: binding %u%s%s", (unsigned)layout->set, (unsigned)place,
                         (unsigned)layout->binding, name[0] ? ", " : "", name);
        place += layout->count;
    }
    shader_text_line(file, "#include <rhw/isa.h>");
    shader_text_line(file, "#include <rhw/shader_spirv.h>");
    shader_text_line(file, "%s", "");
    shader_text_line(file, "#pragma GCC diagnostic ignored \"-Wunused-variable\"");
    shader_text_line(file, "#pragma GCC diagnostic ignored \"-Wunused-but-set-variable\"");
    shader_text_line(file, "%s", "");
}

static void write_layout(struct shader_text *file, const struct shader_c_program *program)
{
    if (program->layout_count == 0) {
        return;
    }
    shader_text_line(file, "extern const struct rhw_shader_layout %s_layout[%u];", program->name,
                     (unsigned)program->layout_count);
    shader_text_line(file, "const struct rhw_shader_layout %s_layout[%u] = {", program->name,
                     (unsigned)program->layout_count);
    for (uint32_t i = 0; i < program->layout_count; i++) {
        shader_text_line(file, "{.set = %u, .binding = %u, .count = %u},", (unsigned)program->layout[i].set,
                         (unsigned)program->layout[i].binding, (unsigned)program->layout[i].count);
    }
    shader_text_line(file, "};");
}

static void write_varyings(struct shader_text *file, const struct rhw_program *program)
{
    if (program->varying_count == 0) {
        return;
    }
    shader_text_line(file, ".varyings = {");
    for (int i = 0; i < program->varying_count; i++) {
        const struct rhw_varying *const varying = &program->varyings[i];
        shader_text_line(file, "{.components = %d, .qualifier = %s, .derivatives = %s, .sampling = %s},",
                         varying->components, qualifiers[varying->qualifier],
                         varying->derivatives ? "true" : "false", samplings[varying->sampling]);
    }
    shader_text_line(file, "},");
    shader_text_line(file, ".varying_count = %d,", program->varying_count);
}

static void write_flag(struct shader_text *file, const char *name, bool value)
{
    if (value) {
        shader_text_line(file, ".%s = true,", name);
    }
}

static void write_uses(struct shader_text *file, uint32_t all)
{
    const char *text = "";
    for (uint32_t bit = 0; bit < sizeof uses / sizeof *uses; bit++) {
        if (all >> bit & 1) {
            text = shader_format(file->memory, "%s%s%s", text, text[0] ? " | " : "", uses[bit]);
        }
    }
    if (text[0]) {
        shader_text_line(file, ".uses = %s,", text);
    }
}

static void write_program(struct shader_text *file, const struct shader_c_program *all)
{
    const struct rhw_program *const program = all->program;
    const char *const name = all->name;
    shader_text_line(file, "extern const struct rhw_program %s_program;", name);
    shader_text_line(file, "const struct rhw_program %s_program = {", name);
    shader_text_line(file, ".vertex = RHW_ISA_TABLE(%s_vertex),", name);
    if (all->stages[RHW_SHADER_FRAGMENT].form) {
        shader_text_line(file, ".fragment = RHW_ISA_TABLE(%s_fragment),", name);
    }
    write_varyings(file, program);
    shader_text_line(file, ".uniform_size = sizeof(struct rhw_shader_frame),");
    write_flag(file, "writes_point_size", program->writes_point_size);
    write_flag(file, "writes_viewport_index", program->writes_viewport_index);
    write_flag(file, "writes_layer", program->writes_layer);
    if (program->clip_distance_count > 0) {
        shader_text_line(file, ".clip_distance_count = %d,", program->clip_distance_count);
    }
    if (program->cull_distance_count > 0) {
        shader_text_line(file, ".cull_distance_count = %d,", program->cull_distance_count);
    }
    write_flag(file, "vertex_effects", program->vertex_effects);
    write_flag(file, "uses_atomic_results", program->uses_atomic_results);
    write_uses(file, program->uses);
    write_flag(file, "early_fragment_tests", program->early_fragment_tests);
    shader_text_line(file, "};");
}

static void write_compute_program(struct shader_text *file, const struct shader_c_program *all)
{
    const struct rhw_compute_program *const program = all->compute;
    shader_text_line(file, "extern const struct rhw_compute_program %s_program;", all->name);
    shader_text_line(file, "const struct rhw_compute_program %s_program = {", all->name);
    shader_text_line(file, ".workgroup = RHW_ISA_TABLE(%s_workgroup),", all->name);
    shader_text_line(file, ".size = {%d, %d, %d},", program->size[0], program->size[1], program->size[2]);
    if (program->shared_size > 0) {
        shader_text_line(file, ".shared_size = %u,", (unsigned)program->shared_size);
    }
    shader_text_line(file, ".uniform_size = sizeof(struct rhw_shader_frame),");
    write_flag(file, "uses_atomic_results", program->uses_atomic_results);
    shader_text_line(file, "};");
}

const char *shader_c_write(struct shader_memory *memory, const struct shader_c_program *program)
{
    static const char *const types[RHW_SHADER_STAGE_COUNT] = {"rhw_vertex_function", "rhw_fragment_function",
                                                              "rhw_workgroup_function"};
    static const char *const names[RHW_SHADER_STAGE_COUNT] = {"vertex", "fragment", "workgroup"};
    struct shader_text file = {.memory = memory};
    write_top(&file, program);
    for (int s = 0; s < RHW_SHADER_STAGE_COUNT; s++) {
        if (program->stages[s].form) {
            shader_text_line(&file, "RHW_ISA_DECLARE(%s, %s_%s);", types[s], program->name, names[s]);
        }
    }
    shader_text_line(&file, "%s", "");
    for (int s = 0; s < RHW_SHADER_STAGE_COUNT; s++) {
        if (program->stages[s].form) {
            shader_c_write_stage(memory, program, (enum rhw_shader_stage)s, &file);
        }
    }
    shader_text_line(&file, "#if RHW_ISA_IS_FIRST");
    write_layout(&file, program);
    if (program->compute) {
        write_compute_program(&file, program);
    } else {
        write_program(&file, program);
    }
    shader_text_line(&file, "#endif");
    return shader_text_bytes(&file);
}
