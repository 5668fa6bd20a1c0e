// SPDX-License-Identifier: MIT
// Structure around barriers, which all groups go through together, and the runs between. Masks of wide structure are
// arrays, lanes1, lanes2, …, with an element for each group, and alive is alive_in[].
#include "c_emit.h"

// Runs -----------------------------------------------------------------------------------------------

static void declare_mask(struct shader_emitter *emitter, uint32_t mask)
{
    shader_text_line(&emitter->arrays, "rhw_int lanes%u[GROUPS];", (unsigned)mask);
}

// Homes of a run begin with it.
static void begin_homes(struct shader_emitter *emitter)
{
    const struct shader_plan *const plan = &emitter->plan;
    for (uint32_t home = plan->first_home[emitter->run]; home != 0; home = plan->next_home[home - 1]) {
        const bool is_float = emitter->is_float[home - 1];
        shader_text_line(emitter->out, "%s h%u = %s;", is_float ? "rhw_float" : "rhw_int", (unsigned)home - 1,
                         shader_c_number(emitter, emitter->form->nodes[home - 1].immediate, is_float));
    }
}

static void open_run(void *user, uint32_t place)
{
    struct shader_emitter *const emitter = user;
    emitter->run = emitter->plan.run[place];
    shader_c_open_groups(emitter);
    emitter->wide_mask = emitter->mask;
    if (emitter->plan.has_cuts) {
        shader_c_line_of_mask(emitter, emitter->mask,
                              shader_format(emitter->memory, "lanes%u[g]", (unsigned)emitter->mask));
        shader_text_line(emitter->out, "rhw_int alive = alive_in[g];");
    }
    begin_homes(emitter);
}

static void close_run(void *user)
{
    struct shader_emitter *const emitter = user;
    if (emitter->plan.has_cuts && emitter->mask != emitter->wide_mask) {
        declare_mask(emitter, emitter->mask);
        shader_text_line(emitter->out, "lanes%u[g] = m%u;", (unsigned)emitter->mask, (unsigned)emitter->mask);
    }
    if (emitter->plan.has_cuts) {
        shader_text_line(emitter->out, "alive_in[g] = alive;");
    }
    if (!emitter->plan.has_cuts && emitter->kind == RHW_SHADER_FRAGMENT && emitter->plan.loses_lanes) {
        shader_text_line(emitter->out, "f->mask &= alive;");
    }
    shader_text_line(emitter->out, "}");
}

// Structure ------------------------------------------------------------------------------------------

// Write a statement for every group.
static void for_groups(struct shader_emitter *emitter, const char *statement)
{
    shader_text_line(emitter->out, "for (int g = 0; g < groups_here; g++) {");
    shader_text_line(emitter->out, "%s", statement);
    shader_text_line(emitter->out, "}");
}

static void set_mask(struct shader_emitter *emitter, uint32_t mask, const char *expression)
{
    declare_mask(emitter, mask);
    for_groups(emitter, shader_format(emitter->memory, "lanes%u[g] = %s;", (unsigned)mask, expression));
}

static void go_on_alive_in_all(struct shader_emitter *emitter, uint32_t came_in)
{
    emitter->mask = shader_c_new_mask(emitter);
    set_mask(emitter, emitter->mask,
             shader_format(emitter->memory, "lanes%u[g] & alive_in[g]", (unsigned)came_in));
}

static void write_wide_branch(struct shader_emitter *emitter, uint32_t begin, uint32_t end, uint32_t mask)
{
    emitter->mask = mask;
    emitter->is_dead = false;
    shader_walk_wide(&emitter->walk, begin, end);
    emitter->is_dead = false;
}

static void write_wide_if(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_structure *const structure = &emitter->plan.structures[place];
    const uint32_t condition = emitter->form->nodes[emitter->form->code[place]].operands[0];
    const uint32_t before = emitter->mask;
    const bool has_else = structure->otherwise != SHADER_NONE;
    const uint32_t middle = has_else ? structure->otherwise : structure->end;
    const unsigned number = place;
    if (structure->is_uniform) { // groups without a lane may not have computed the condition
        shader_text_line(emitter->out, "const int first%u = rhw_spirv_first(lanes%u, groups_here);", number,
                         (unsigned)before);
    }
    emitter->group = structure->is_uniform ? shader_format(emitter->memory, "first%u", number) : "g";
    const char *const truth = shader_c_argument(emitter, condition, false);
    emitter->group = "g";
    uint32_t inside = before, outside = before;
    if (structure->is_uniform) {
        shader_text_line(emitter->out,
                         "const bool is_so%u = first%u < groups_here && (%s)[0] != 0; // all groups agree",
                         number, number, truth);
    } else {
        inside = shader_c_new_mask(emitter);
        set_mask(emitter, inside, shader_format(emitter->memory, "lanes%u[g] & %s", (unsigned)before, truth));
        outside = shader_c_new_mask(emitter);
        set_mask(
            emitter, outside,
            shader_format(emitter->memory, "lanes%u[g] & ~lanes%u[g]", (unsigned)before, (unsigned)inside));
        emitter->divergence++;
    }
    const char *const test =
        structure->is_uniform
            ? shader_format(emitter->memory, "is_so%u", number)
            : shader_format(emitter->memory, "rhw_spirv_any(lanes%u, groups_here)", (unsigned)inside);
    const char *const other =
        structure->is_uniform
            ? shader_format(emitter->memory, "first%u < groups_here && !is_so%u", number, number)
            : shader_format(emitter->memory, "rhw_spirv_any(lanes%u, groups_here)", (unsigned)outside);
    shader_text_line(emitter->out, "if (%s) {", test);
    write_wide_branch(emitter, place + 1, middle, inside);
    shader_text_line(emitter->out, "}");
    if (has_else) {
        shader_text_line(emitter->out, "if (%s) {", other);
        write_wide_branch(emitter, middle + 1, structure->end, outside);
        shader_text_line(emitter->out, "}");
    }
    emitter->divergence -= structure->is_uniform ? 0 : 1;
    emitter->mask = before;
    if (structure->loses) {
        go_on_alive_in_all(emitter, before);
    }
}

// REGION or LOOP.
static void write_wide_region(struct shader_emitter *emitter, uint32_t place)
{
    struct shader_memory *const memory = emitter->memory;
    const struct shader_structure *const structure = &emitter->plan.structures[place];
    const bool is_loop = shader_op_at(&emitter->plan, place) == SHADER_LOOP;
    const unsigned number = place;
    const uint32_t before = emitter->mask, round = shader_c_new_mask(emitter);
    emitter->divergence += structure->is_uniform ? 0 : 1;
    if (!structure->is_uniform) {
        shader_text_line(&emitter->arrays, "rhw_int left%u[GROUPS];", number);
        for_groups(emitter, shader_format(memory, "left%u[g] = rhw_splat_int(0);", number));
    }
    set_mask(emitter, round, shader_format(memory, "lanes%u[g]", (unsigned)before));
    shader_text_line(emitter->out, is_loop ? "for (;;) {" : "{");
    if (is_loop) {
        emitter->loops[emitter->loop_depth++] = place;
    }
    emitter->mask = round;
    shader_walk_wide(&emitter->walk, place + 1, structure->end);
    emitter->loop_depth -= is_loop ? 1 : 0;
    if (is_loop && emitter->is_dead) {
        shader_text_line(emitter->out, "break;");
    } else if (is_loop) {
        for_groups(emitter, shader_format(memory, "lanes%u[g] = lanes%u[g];", (unsigned)round,
                                          (unsigned)emitter->mask));
        shader_c_write_giving_up(emitter);
        shader_text_line(emitter->out, "if (!rhw_spirv_any(lanes%u, groups_here)) {", (unsigned)round);
        shader_text_line(emitter->out, "break;");
        shader_text_line(emitter->out, "}");
    }
    shader_text_line(emitter->out, "}");
    shader_c_write_label(emitter, place);
    emitter->divergence -= structure->is_uniform ? 0 : 1;
    if (!structure->is_uniform) {
        for_groups(emitter, shader_format(memory, "alive_in[g] |= left%u[g];", number));
    }
    emitter->is_dead = false;
    emitter->mask = before;
    if (structure->loses) {
        go_on_alive_in_all(emitter, before);
    }
}

static void write_wide_leave(void *user, uint32_t place)
{
    struct shader_emitter *const emitter = user;
    const uint32_t node = emitter->form->code[place];
    const uint32_t target = emitter->plan.place[emitter->form->nodes[node].operands[0]];
    emitter->is_dead = true;
    if (emitter->plan.structures[target].is_uniform) {
        shader_c_jump_to_end(emitter, target);
        return;
    }
    for_groups(emitter, shader_format(emitter->memory, "left%u[g] |= lanes%u[g];", (unsigned)target,
                                      (unsigned)emitter->mask));
    for_groups(emitter,
               shader_format(emitter->memory, "alive_in[g] &= ~lanes%u[g];", (unsigned)emitter->mask));
}

static void write_wide_structure(void *user, uint32_t place)
{
    struct shader_emitter *const emitter = user;
    if (shader_op_at(&emitter->plan, place) == SHADER_IF) {
        write_wide_if(emitter, place);
    } else {
        write_wide_region(emitter, place);
    }
}

static void write_barrier(void *user)
{
    struct shader_emitter *const emitter = user;
    shader_text_line(emitter->out, "// A barrier: every invocation has come here.");
}

void shader_c_write_code(struct shader_emitter *emitter)
{
    const struct shader_plan *const plan = &emitter->plan;
    emitter->walk =
        (struct shader_walk){.plan = plan,
                             .user = emitter,
                             .mask = &emitter->mask,
                             .divergence = &emitter->divergence,
                             .loop_depth = &emitter->loop_depth,
                             .is_dead = &emitter->is_dead,
                             .skips_group = emitter->kind == RHW_SHADER_FRAGMENT && !plan->has_cuts,
                             .node = shader_c_write_node,
                             .barrier = write_barrier,
                             .narrow = shader_c_write_structure,
                             .wide = write_wide_structure,
                             .leave_wide = write_wide_leave,
                             .open_run = open_run,
                             .close_run = close_run,
                             .skip = shader_c_skip_rest};
    shader_walk_wide(&emitter->walk, 0, emitter->form->code_count);
}
