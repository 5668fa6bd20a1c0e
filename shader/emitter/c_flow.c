// SPDX-License-Identifier: MIT
// Structure, and which lanes are active. The mask at a place has a name of its own, m1, m2, …, so that it needs
// nothing to come back to an outer one. `alive` has the lanes that have not left: what is active behind structure that
// loses lanes is what came in and is alive. Structure whose lanes all go one way is that of C.
//
// Masks of wide structure are arrays, lanes1, lanes2, …, with an element for each group, and alive is alive_in[].
#include "c_emit.h"

#include <string.h>

enum { WORTH_A_JUMP = 8 }; // places that are left out

static void write_narrow(struct shader_emitter *emitter, uint32_t begin, uint32_t end, uint32_t parent);
static void write_wide(struct shader_emitter *emitter, uint32_t begin, uint32_t end);

static enum shader_op op_at(const struct shader_emitter *emitter, uint32_t place)
{
    return (enum shader_op)emitter->form->nodes[emitter->form->code[place]].op;
}

static bool opens(enum shader_op op)
{
    return op == SHADER_IF || op == SHADER_REGION || op == SHADER_LOOP;
}

uint32_t shader_c_new_mask(struct shader_emitter *emitter)
{
    return ++emitter->masks;
}

static void line_of_mask(struct shader_emitter *emitter, uint32_t mask, const char *expression)
{
    shader_text_line(emitter->out, "const rhw_int m%u = %s;", (unsigned)mask, expression);
}

// Behind structure that loses lanes, those are active that came in and are alive.
static void go_on_alive(struct shader_emitter *emitter, uint32_t came_in)
{
    emitter->mask = shader_c_new_mask(emitter);
    line_of_mask(emitter, emitter->mask, shader_format(emitter->memory, "m%u & alive", (unsigned)came_in));
}

// Statements of structure ----------------------------------------------------------------------------

static void write_set(struct shader_emitter *emitter, const struct shader_node *node)
{
    const uint32_t home = node->operands[0];
    const bool is_float = emitter->plan.is_float[home];
    const char *const name = shader_c_name(emitter, home);
    if (shader_c_resource(emitter, home) != home) {
        return; // a binding that is named once serves everywhere
    }
    const char *const value = shader_c_argument(emitter, node->operands[1], is_float);
    if (strcmp(name, value) == 0) {
        return; // it is in the home already
    }
    // Where lanes go one way, those that are not active never read the home again.
    if (emitter->divergence == 0 || (emitter->form->nodes[home].flags & SHADER_UNIFORM)) {
        shader_text_line(emitter->out, "%s = %s;", name, value);
        return;
    }
    shader_text_line(emitter->out, "%s = %s(m%u, %s, %s);", name, is_float ? "rhw_select" : "rhw_select_int",
                     (unsigned)emitter->mask, value, name);
}

// Jump to the end of structure: out of the innermost loop of C, or to a label.
static void jump_to_end(struct shader_emitter *emitter, uint32_t structure)
{
    if (emitter->loop_depth > 0 && emitter->loops[emitter->loop_depth - 1] == structure) {
        shader_text_line(emitter->out, "break;");
        return;
    }
    emitter->is_label_used[structure] = true;
    shader_text_line(emitter->out, "goto end%u;", (unsigned)structure);
}

static void write_label(struct shader_emitter *emitter, uint32_t structure)
{
    if (emitter->is_label_used[structure]) {
        shader_text_line(emitter->out, "end%u:;", (unsigned)structure);
    }
}

// Active lanes leave structure, or are discarded.
static void write_leave(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_node *const node = &emitter->form->nodes[emitter->form->code[place]];
    const bool discards = node->op == SHADER_DISCARD;
    const uint32_t target = discards ? SHADER_C_NONE : emitter->plan.place[node->operands[0]];
    const struct shader_c_structure *const structure = discards ? NULL : &emitter->plan.structures[target];
    emitter->is_dead = true;
    if (structure && structure->is_uniform) {
        jump_to_end(emitter, target);
        return;
    }
    if (structure && structure->loses) {
        shader_text_line(emitter->out, "left%u |= m%u;", (unsigned)target, (unsigned)emitter->mask);
    }
    shader_text_line(emitter->out, "alive &= ~m%u;", (unsigned)emitter->mask);
}

// Write what stands in a branch, with a mask. Return true if control flow of C comes to its end.
static void write_branch(struct shader_emitter *emitter, uint32_t begin, uint32_t end, uint32_t mask)
{
    emitter->mask = mask;
    emitter->is_dead = false;
    write_narrow(emitter, begin, end, SHADER_C_NONE);
    emitter->is_dead = false;
}

static void write_if(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_c_structure *const structure = &emitter->plan.structures[place];
    const uint32_t condition = emitter->form->nodes[emitter->form->code[place]].operands[0];
    const uint32_t before = emitter->mask;
    const bool has_else = structure->otherwise != SHADER_C_NONE;
    const uint32_t middle = has_else ? structure->otherwise : structure->end;
    const char *const truth = shader_c_operand(emitter, condition, false);
    uint32_t bits, inside = before;
    if (structure->is_uniform) {
        const bool is_number = shader_c_is_number(emitter, condition, &bits);
        shader_text_line(emitter->out, is_number ? "if (%s) {" : "if (%s[0]) {", truth);
    } else {
        inside = shader_c_new_mask(emitter);
        line_of_mask(emitter, inside, shader_format(emitter->memory, "m%u & %s", (unsigned)before, truth));
        shader_text_line(emitter->out, "if (rhw_any(m%u)) {", (unsigned)inside);
        emitter->divergence++;
    }
    write_branch(emitter, place + 1, middle, inside);
    if (has_else && structure->is_uniform) {
        shader_text_line(emitter->out, "} else {");
        write_branch(emitter, middle + 1, structure->end, before);
    } else if (has_else) {
        const uint32_t outside = shader_c_new_mask(emitter);
        shader_text_line(emitter->out, "}");
        line_of_mask(emitter, outside,
                     shader_format(emitter->memory, "m%u & ~m%u", (unsigned)before, (unsigned)inside));
        shader_text_line(emitter->out, "if (rhw_any(m%u)) {", (unsigned)outside);
        write_branch(emitter, middle + 1, structure->end, outside);
    }
    shader_text_line(emitter->out, "}");
    emitter->divergence -= structure->is_uniform ? 0 : 1;
    emitter->mask = before;
    if (structure->loses) {
        go_on_alive(emitter, before);
    }
}

// Lanes that leave structure come back at its end. Where none is lost further out, all that were alive are again.
static void begin_leaving(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_c_structure *const structure = &emitter->plan.structures[place];
    if (!structure->is_uniform && structure->loses) {
        shader_text_line(emitter->out, "rhw_int left%u = rhw_splat_int(0);", (unsigned)place);
    } else if (!structure->is_uniform) {
        shader_text_line(emitter->out, "const rhw_int alive%u = alive;", (unsigned)place);
    }
    emitter->divergence += structure->is_uniform ? 0 : 1;
}

static void end_leaving(struct shader_emitter *emitter, uint32_t place, uint32_t before)
{
    const struct shader_c_structure *const structure = &emitter->plan.structures[place];
    emitter->divergence -= structure->is_uniform ? 0 : 1;
    if (!structure->is_uniform) {
        shader_text_line(emitter->out, structure->loses ? "alive |= left%u;" : "alive = alive%u;",
                         (unsigned)place);
    }
    emitter->is_dead = false;
    emitter->mask = before;
    if (structure->loses) {
        go_on_alive(emitter, before);
    }
}

static void write_region(struct shader_emitter *emitter, uint32_t place)
{
    const uint32_t before = emitter->mask;
    begin_leaving(emitter, place);
    shader_text_line(emitter->out, "{");
    write_narrow(emitter, place + 1, emitter->plan.structures[place].end, place);
    shader_text_line(emitter->out, "}");
    write_label(emitter, place);
    end_leaving(emitter, place, before);
}

// A loop may have no end, so the program is asked now and then whether somebody waits for it.
static void write_giving_up(struct shader_emitter *emitter)
{
    if (!emitter->counts_rounds) {
        shader_text_line(&emitter->once, "uint32_t rounds = 0;");
        emitter->counts_rounds = true;
    }
    shader_text_line(emitter->out, "if (rhw_spirv_is_given_up(&rounds, %s)) {",
                     emitter->kind == RHW_SHADER_COMPUTE ? "w->bindings" : "groups[0].bindings");
    shader_text_line(emitter->out, "return;");
    shader_text_line(emitter->out, "}");
}

// A round begins with the lanes that came to the end of the one before.
static void write_loop(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_c_structure *const structure = &emitter->plan.structures[place];
    const uint32_t before = emitter->mask, round = shader_c_new_mask(emitter);
    begin_leaving(emitter, place);
    shader_text_line(emitter->out, "rhw_int m%u = m%u;", (unsigned)round, (unsigned)before);
    shader_text_line(emitter->out, structure->is_uniform ? "for (;;) {" : "do {");
    emitter->loops[emitter->loop_depth++] = place;
    emitter->mask = round;
    write_narrow(emitter, place + 1, structure->end, place);
    emitter->loop_depth--;
    if (emitter->is_dead && !structure->is_uniform) {
        shader_text_line(emitter->out, "m%u = rhw_splat_int(0);", (unsigned)round);
    } else if (!emitter->is_dead && emitter->mask != round) {
        shader_text_line(emitter->out, "m%u = m%u;", (unsigned)round, (unsigned)emitter->mask);
        if (structure->is_uniform) {
            shader_text_line(emitter->out, "if (!rhw_any(m%u)) {", (unsigned)round);
            shader_text_line(emitter->out, "break;");
            shader_text_line(emitter->out, "}");
        }
    }
    if (!emitter->is_dead) {
        write_giving_up(emitter);
    }
    if (structure->is_uniform) {
        shader_text_line(emitter->out, "}");
    } else {
        shader_text_line(emitter->out, "} while (rhw_any(m%u));", (unsigned)round);
    }
    write_label(emitter, place);
    end_leaving(emitter, place, before);
}

// Runs and narrow structure --------------------------------------------------------------------------

static void write_node(struct shader_emitter *emitter, uint32_t place)
{
    const uint32_t value = emitter->form->code[place];
    const struct shader_node *const node = &emitter->form->nodes[value];
    struct shader_text *const out = emitter->out;
    if (emitter->plan.is_hoisted[value]) {
        emitter->out = &emitter->once;
    }
    switch ((enum shader_op)node->op) {
    case SHADER_SET: write_set(emitter, node); break;
    case SHADER_LEAVE:
    case SHADER_DISCARD: write_leave(emitter, place); break;
    default:
        if (!shader_c_write_access(emitter, place) && !shader_c_write_image(emitter, place)) {
            shader_c_write_value(emitter, place);
        }
    }
    emitter->out = out;
}

// Where lanes were lost and none is left, go to the end of what is around, if that is worth it.
static void skip_rest(struct shader_emitter *emitter, uint32_t places, uint32_t parent)
{
    const bool is_outermost = parent == SHADER_C_NONE && emitter->divergence == 0 &&
                              emitter->kind == RHW_SHADER_FRAGMENT && !emitter->plan.has_cuts &&
                              emitter->loop_depth == 0;
    if (places < WORTH_A_JUMP || (parent == SHADER_C_NONE && !is_outermost)) {
        return;
    }
    shader_text_line(emitter->out, "if (!rhw_any(m%u)) {", (unsigned)emitter->mask);
    if (is_outermost) {
        shader_text_line(emitter->out, "f->mask = m%u;", (unsigned)emitter->mask);
        shader_text_line(emitter->out, "continue;");
    } else {
        jump_to_end(emitter, parent);
    }
    shader_text_line(emitter->out, "}");
}

// Write one item, a node or narrow structure. Return the place behind it.
static uint32_t write_item(struct shader_emitter *emitter, uint32_t place)
{
    const enum shader_op op = op_at(emitter, place);
    if (!opens(op)) {
        write_node(emitter, place);
        return place + 1;
    }
    if (op == SHADER_IF) {
        write_if(emitter, place);
    } else if (op == SHADER_REGION) {
        write_region(emitter, place);
    } else {
        write_loop(emitter, place);
    }
    return emitter->plan.structures[place].end + 1;
}

// Write places that no lane comes to: values that are computed once may stand among them.
static void write_hoisted(struct shader_emitter *emitter, uint32_t begin, uint32_t end)
{
    for (uint32_t i = begin; i < end; i++) {
        if (emitter->plan.is_hoisted[emitter->form->code[i]]) {
            write_node(emitter, i);
        }
    }
}

static void write_narrow(struct shader_emitter *emitter, uint32_t begin, uint32_t end, uint32_t parent)
{
    uint32_t i = begin;
    while (i < end && !emitter->is_dead) {
        const uint32_t mask = emitter->mask;
        const bool is_structure = opens(op_at(emitter, i));
        i = write_item(emitter, i);
        if (is_structure && emitter->mask != mask) {
            skip_rest(emitter, end - i, parent);
        }
    }
    write_hoisted(emitter, i, end);
}

// Wide structure -------------------------------------------------------------------------------------

static void declare_mask(struct shader_emitter *emitter, uint32_t mask)
{
    shader_text_line(&emitter->arrays, "rhw_int lanes%u[GROUPS];", (unsigned)mask);
}

// Homes of a run begin with it.
static void begin_homes(struct shader_emitter *emitter)
{
    const struct shader_c_plan *const plan = &emitter->plan;
    for (uint32_t home = plan->first_home[emitter->run]; home != 0; home = plan->next_home[home - 1]) {
        const bool is_float = plan->is_float[home - 1];
        shader_text_line(emitter->out, "%s h%u = %s;", is_float ? "rhw_float" : "rhw_int", (unsigned)home - 1,
                         shader_c_number(emitter, emitter->form->nodes[home - 1].immediate, is_float));
    }
}

static void open_run(struct shader_emitter *emitter, uint32_t place)
{
    if (emitter->is_run_open) {
        return;
    }
    emitter->is_run_open = true;
    emitter->run = emitter->plan.run[place];
    shader_c_open_groups(emitter);
    emitter->wide_mask = emitter->mask;
    if (emitter->plan.has_cuts) {
        line_of_mask(emitter, emitter->mask,
                     shader_format(emitter->memory, "lanes%u[g]", (unsigned)emitter->mask));
        shader_text_line(emitter->out, "rhw_int alive = alive_in[g];");
    }
    begin_homes(emitter);
}

static void close_run(struct shader_emitter *emitter)
{
    if (!emitter->is_run_open) {
        return;
    }
    emitter->is_run_open = false;
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
    write_wide(emitter, begin, end);
    emitter->is_dead = false;
}

static void write_wide_if(struct shader_emitter *emitter, uint32_t place)
{
    const struct shader_c_structure *const structure = &emitter->plan.structures[place];
    const uint32_t condition = emitter->form->nodes[emitter->form->code[place]].operands[0];
    const uint32_t before = emitter->mask;
    const bool has_else = structure->otherwise != SHADER_C_NONE;
    const uint32_t middle = has_else ? structure->otherwise : structure->end;
    const unsigned number = place;
    emitter->group = structure->is_uniform ? "0" : "g";
    const char *const truth = shader_c_argument(emitter, condition, false);
    emitter->group = "g";
    uint32_t inside = before, outside = before;
    if (structure->is_uniform) {
        shader_text_line(emitter->out, "const bool is_so%u = (%s)[0] != 0; // all groups agree", number,
                         truth);
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
            ? shader_format(emitter->memory, "!is_so%u", number)
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
    const struct shader_c_structure *const structure = &emitter->plan.structures[place];
    const bool is_loop = op_at(emitter, place) == SHADER_LOOP;
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
    write_wide(emitter, place + 1, structure->end);
    emitter->loop_depth -= is_loop ? 1 : 0;
    if (is_loop && emitter->is_dead) {
        shader_text_line(emitter->out, "break;");
    } else if (is_loop) {
        for_groups(emitter, shader_format(memory, "lanes%u[g] = lanes%u[g];", (unsigned)round,
                                          (unsigned)emitter->mask));
        write_giving_up(emitter);
        shader_text_line(emitter->out, "if (!rhw_spirv_any(lanes%u, groups_here)) {", (unsigned)round);
        shader_text_line(emitter->out, "break;");
        shader_text_line(emitter->out, "}");
    }
    shader_text_line(emitter->out, "}");
    write_label(emitter, place);
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

static void write_wide_leave(struct shader_emitter *emitter, uint32_t place)
{
    const uint32_t node = emitter->form->code[place];
    const uint32_t target = emitter->plan.place[emitter->form->nodes[node].operands[0]];
    emitter->is_dead = true;
    if (emitter->plan.structures[target].is_uniform) {
        jump_to_end(emitter, target);
        return;
    }
    for_groups(emitter, shader_format(emitter->memory, "left%u[g] |= lanes%u[g];", (unsigned)target,
                                      (unsigned)emitter->mask));
    for_groups(emitter,
               shader_format(emitter->memory, "alive_in[g] &= ~lanes%u[g];", (unsigned)emitter->mask));
}

static void write_wide(struct shader_emitter *emitter, uint32_t begin, uint32_t end)
{
    uint32_t i = begin;
    while (i < end && !emitter->is_dead) {
        const enum shader_op op = op_at(emitter, i);
        if (shader_c_is_cut(&emitter->plan, i)) {
            close_run(emitter);
            if (op == SHADER_BARRIER) {
                shader_text_line(emitter->out, "// A barrier: every invocation has come here.");
            } else {
                open_run(emitter, i);
                write_node(emitter, i);
                close_run(emitter);
            }
            i++;
        } else if (shader_c_is_wide(&emitter->plan, i)) {
            close_run(emitter);
            if (op == SHADER_LEAVE) {
                write_wide_leave(emitter, i++);
                break;
            }
            if (op == SHADER_IF) {
                write_wide_if(emitter, i);
            } else {
                write_wide_region(emitter, i);
            }
            i = emitter->plan.structures[i].end + 1;
        } else {
            open_run(emitter, i);
            i = write_item(emitter, i);
        }
    }
    close_run(emitter);
    write_hoisted(emitter, i, end);
}

void shader_c_write_code(struct shader_emitter *emitter)
{
    write_wide(emitter, 0, emitter->form->code_count);
}
