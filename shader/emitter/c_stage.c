// SPDX-License-Identifier: MIT
// A stage as a function: what is computed once a call, and the loops over groups around the code.
#include "c_emit.h"

// What the function of a stage is called and receives, how a group is declared, and where frame and mask are.
struct groups_of {
    const char *function, *parameters, *group, *frame, *mask;
};

static const struct groups_of groups_of[RHW_SHADER_STAGE_COUNT] = {
    [RHW_SHADER_VERTEX] = {"vertex", "struct rhw_vertex *groups, int count",
                           "struct rhw_vertex *const v = &groups", "groups[0].uniforms", "v->mask"},
    [RHW_SHADER_FRAGMENT] = {"fragment", "struct rhw_fragment *groups, int count",
                             "struct rhw_fragment *const f = &groups", "groups[0].uniforms", "f->mask"},
    [RHW_SHADER_COMPUTE] = {"workgroup", "struct rhw_workgroup *w",
                            "const struct rhw_invocations *const i = &w->groups", "w->uniforms", "i->mask"},
};

void shader_c_open_groups(struct shader_emitter *emitter)
{
    const struct groups_of *const groups = &groups_of[emitter->kind];
    const bool has_cuts = emitter->plan.has_cuts, has_batches = emitter->has_batches;
    shader_text_line(emitter->out, "for (int g = 0; g < %s; g++) {", has_batches ? "groups_here" : "count");
    shader_text_line(emitter->out, "%s[%s];", groups->group, has_batches ? "first + g" : "g");
    const unsigned own = emitter->form->private_count;
    if (own > 0 && has_cuts) {
        shader_text_line(emitter->out, "rhw_int *const own = own_of[g];");
    } else if (own > 0) {
        shader_text_line(emitter->out, "rhw_int own[%u];", own);
        shader_text_line(emitter->out, "memset(own, 0, sizeof own);");
    }
    if (!has_cuts) {
        shader_text_line(emitter->out, "const rhw_int m%u = %s;", (unsigned)emitter->mask, groups->mask);
        shader_text_line(emitter->out, "rhw_int alive = m%u;", (unsigned)emitter->mask);
    }
}

// Begin what goes from run to run: masks, and homes that are kept.
static void begin_all(struct shader_emitter *emitter)
{
    const struct shader_program *const form = emitter->form;
    if (form->private_count > 0) {
        shader_text_line(&emitter->arrays, "rhw_int own_of[GROUPS][%u];", (unsigned)form->private_count);
        shader_text_line(emitter->out, "memset(own_of, 0, sizeof own_of);");
    }
    shader_text_line(&emitter->arrays, "rhw_int alive_in[GROUPS];");
    shader_text_line(&emitter->arrays, "rhw_int lanes%u[GROUPS];", (unsigned)emitter->mask);
    shader_c_open_groups(emitter);
    shader_text_line(emitter->out, "lanes%u[g] = alive_in[g] = %s;", (unsigned)emitter->mask,
                     groups_of[emitter->kind].mask);
    for (uint32_t value = 0; value < form->node_count; value++) {
        if (form->nodes[value].op == SHADER_HOME && emitter->plan.is_kept[value]) {
            const bool is_float = emitter->is_float[value];
            shader_text_line(&emitter->arrays, "%s h%u[GROUPS];", is_float ? "rhw_float" : "rhw_int",
                             (unsigned)value);
            shader_text_line(emitter->out, "h%u[g] = %s;", (unsigned)value,
                             shader_c_number(emitter, form->nodes[value].immediate, is_float));
        }
    }
    shader_text_line(emitter->out, "}");
}

static void end_all(struct shader_emitter *emitter)
{
    if (emitter->kind == RHW_SHADER_FRAGMENT && emitter->plan.loses_lanes) {
        shader_c_open_groups(emitter);
        shader_text_line(emitter->out, "f->mask &= alive_in[g];");
        shader_text_line(emitter->out, "}");
    }
}

static void write_body(struct shader_emitter *emitter)
{
    emitter->out = &emitter->body;
    emitter->mask = shader_c_new_mask(emitter);
    emitter->body.depth = emitter->has_batches ? 2 : 1;
    emitter->once.depth = emitter->arrays.depth = 1;
    if (emitter->plan.has_cuts) {
        begin_all(emitter);
    }
    shader_c_write_code(emitter);
    if (emitter->plan.has_cuts) {
        end_all(emitter);
    }
    shader_c_list_group_samples(emitter);
}

static void add_text(struct shader_text *file, const struct shader_text *text)
{
    shader_text_add(file, "%s", shader_text_bytes(text));
}

// Constants that indices pick from.
static void write_table(const struct shader_emitter *emitter, struct shader_text *file)
{
    const struct shader_program *const form = emitter->form;
    if (form->table_count > 0) {
        shader_text_line(file, "static const int32_t table[%u] = {", (unsigned)form->table_count);
        for (uint32_t i = 0; i < form->table_count; i++) {
            shader_text_line(file, "(int32_t)0x%xu,", (unsigned)form->table[i]);
        }
        shader_text_line(file, "};");
    }
}

static void write_function(const struct shader_emitter *emitter, struct shader_text *file)
{
    const struct groups_of *const groups = &groups_of[emitter->kind];
    shader_text_line(file, "void RHW_ISA_NAME(%s_%s)(%s)", emitter->program->name, groups->function,
                     groups->parameters);
    shader_text_line(file, "{");
    shader_text_line(file, "const struct rhw_shader_frame *const frame = %s;", groups->frame);
    if (emitter->kind == RHW_SHADER_COMPUTE) {
        shader_text_line(file, "const int count = w->count;");
    }
    write_table(emitter, file);
    add_text(file, &emitter->once);
    if (emitter->has_batches) {
        shader_text_line(file, "enum { GROUPS = %u };", (unsigned)emitter->stage->batch);
        add_text(file, &emitter->arrays);
        shader_text_line(file, "for (int first = 0; first < count; first += GROUPS) {");
        shader_text_line(file, "const int groups_here = count - first < GROUPS ? count - first : GROUPS;");
        shader_c_sample_groups(emitter, file);
    }
    add_text(file, &emitter->body);
    if (emitter->has_batches) {
        shader_text_line(file, "}");
    }
    shader_text_line(file, "}");
    shader_text_line(file, "%s", "");
}

void shader_c_write_stage(struct shader_memory *memory, const struct shader_c_program *program,
                          enum rhw_shader_stage kind, struct shader_text *file)
{
    const struct shader_program *const form = program->stages[kind].form;
    struct shader_emitter emitter = {.memory = memory,
                                     .program = program,
                                     .stage = &program->stages[kind],
                                     .kind = kind,
                                     .form = form,
                                     .group = "g",
                                     .arrays = {.memory = memory},
                                     .once = {.memory = memory},
                                     .body = {.memory = memory},
                                     .inlined = shader_take(memory, form->node_count, sizeof(char *)),
                                     .loops = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof(uint32_t)),
                                     .is_label_used =
                                         shader_take(memory, form->code_count + 1, sizeof(bool))};
    shader_make_plan(memory, form, false, &emitter.plan);
    shader_c_find_types(&emitter);
    shader_c_find_group_samples(&emitter);
    emitter.has_batches = emitter.plan.has_cuts || emitter.sample_count > 0;
    write_body(&emitter);
    write_function(&emitter, file);
}
