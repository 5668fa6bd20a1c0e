// SPDX-License-Identifier: MIT
// Structure that each group goes through by itself, and which lanes are active. The mask of active lanes at a place is
// a value of its own, so that it needs nothing to come back to an outer one. `alive` has the lanes that have not left:
// what is active behind structure that loses lanes is what came in and is alive. Structure whose lanes all go one way
// is jumps alone.
#include "generator.h"

#include <stdio.h>

// Masks ----------------------------------------------------------------------------------------------

uint32_t shader_and_mask(struct shader_generator *g, uint32_t mask, uint32_t other, bool is_not)
{
    const uint32_t result = shader_new_value(g);
    const int a = shader_in_register(g, is_not ? other : mask);
    const struct x86_operand b = shader_anywhere(g, is_not ? mask : other);
    const int reg = shader_temporary(g);
    shader_put(g, is_not ? X86_VANDNPS : X86_VANDPS, reg, a, b);
    shader_assign(g, result, reg);
    shader_unlock(g);
    return result;
}

static uint32_t copy_mask(struct shader_generator *g, uint32_t mask)
{
    const uint32_t result = shader_new_value(g);
    const struct x86_operand from = shader_anywhere(g, mask);
    const int reg = shader_temporary(g);
    shader_put(g, X86_VMOVUPS, reg, 0, from);
    shader_assign(g, result, reg);
    shader_unlock(g);
    return result;
}

// Change a mask by another.
static void change_mask(struct shader_generator *g, unsigned instruction, uint32_t mask, uint32_t by)
{
    const int other = shader_in_register(g, by), reg = shader_in_register(g, mask);
    if (instruction == X86_VANDNPS) {
        shader_put(g, instruction, reg, other, x86_reg(reg));
    } else if (instruction == X86_VMOVUPS) {
        shader_put(g, instruction, reg, 0, x86_reg(other));
    } else {
        shader_put(g, instruction, reg, reg, x86_reg(other));
    }
    g->values[mask].is_stored = false;
    shader_unlock(g);
}

void shader_test_mask(struct shader_generator *g, uint32_t mask)
{
    const int reg = shader_in_register(g, mask);
    shader_put(g, X86_VTESTPS, reg, 0, x86_reg(reg));
    shader_unlock(g);
}

void shader_test_alike(struct shader_generator *g, uint32_t truth)
{
    if (g->values[truth].reg >= 0 || g->form->nodes[truth].op == SHADER_CONSTANT) {
        shader_test_mask(g, truth);
    } else {
        shader_encode(&g->code, X86_CMP_I, 0, 0, shader_home_of(g, truth), 0);
    }
}

// The block goes on with another mask. Its own it gives back, but not the one that it began with.
static void take_mask(struct shader_generator *g, uint32_t mask)
{
    if (g->mask != g->block_mask && g->mask != mask) {
        shader_drop_value(g, g->mask);
    }
    g->mask = mask;
}

// Behind structure that loses lanes, those are active that came in and are alive.
static void go_on_alive(struct shader_generator *g)
{
    take_mask(g, shader_and_mask(g, g->mask, g->alive, false));
}

// Nodes of flow --------------------------------------------------------------------------------------

static void generate_set(struct shader_generator *g, const struct shader_node *node)
{
    const uint32_t home = node->operands[0], value = node->operands[1];
    if (shader_resource_of(&g->plan, home) != home) {
        return; // a binding that is named once serves everywhere
    }
    // Where lanes go one way, those that are not active never read the home again.
    const bool is_whole = g->divergence == 0 || shader_is_shared(g->form, home);
    if (is_whole) {
        const struct x86_operand from = shader_anywhere(g, value);
        int reg = g->values[home].reg;
        if (reg < 0) {
            reg = shader_temporary(g);
            shader_assign(g, home, reg);
        }
        if (from.reg != reg) {
            shader_put(g, X86_VMOVUPS, reg, 0, from);
        }
        g->values[home].is_stored = false;
        return;
    }
    const int mask = shader_in_register(g, g->mask), reg = shader_in_register(g, home);
    const struct x86_operand from = shader_anywhere(g, value);
    shader_encode(&g->code, X86_VBLENDVPS, reg, reg, from, mask);
    g->values[home].is_stored = false;
}

static void jump_to_end(struct shader_generator *g, uint32_t structure)
{
    shader_edge_jump(g, g->ends[structure], g->plan.structures[structure].end);
    g->is_gone = true;
}

// Active lanes leave structure, or are discarded.
static void generate_leave(struct shader_generator *g, const struct shader_node *node)
{
    const bool discards = node->op == SHADER_DISCARD;
    const uint32_t target = discards ? SHADER_NONE : g->plan.place[node->operands[0]];
    g->is_dead = true;
    if (!discards && g->plan.structures[target].is_uniform) {
        jump_to_end(g, target);
        return;
    }
    if (!discards && g->plan.structures[target].loses) {
        change_mask(g, X86_VORPS, g->left[target], g->mask);
    }
    change_mask(g, X86_VANDNPS, g->alive, g->mask);
}

void shader_generate_node(struct shader_generator *g, uint32_t place)
{
    const uint32_t value = g->form->code[place];
    const struct shader_node *const node = &g->form->nodes[value];
    g->place = place;
    shader_encode_mark(&g->code, value);
    if (node->op == SHADER_SET) {
        generate_set(g, node);
    } else if (node->op == SHADER_LEAVE || node->op == SHADER_DISCARD) {
        generate_leave(g, node);
    } else if (!shader_select_input(g, value) && !shader_select_memory(g, value) &&
               !shader_select_image(g, value) && !shader_select_arithmetic(g, value)) {
        snprintf(g->memory->message, sizeof g->memory->message, "machine code does not have the operation %s",
                 shader_op_name((enum shader_op)node->op));
        shader_memory_end(g->memory);
    }
    shader_end_place(g);
}

// Structure ------------------------------------------------------------------------------------------

static void come_together(struct shader_generator *g, struct shader_edge *edge, uint32_t place)
{
    shader_edge_place(g, edge, place, g->is_gone);
    g->is_gone = false;
}

static void generate_branch(struct shader_generator *g, uint32_t begin, uint32_t end, uint32_t mask)
{
    const uint32_t outer = g->block_mask;
    g->mask = g->block_mask = mask;
    g->is_dead = false;
    shader_walk_narrow(&g->walk, begin, end, SHADER_NONE);
    take_mask(g, mask);
    g->block_mask = outer;
    g->is_dead = false;
}

// Return true for an IF that is as fast without a jump: a few instructions under its mask.
static bool is_short_if(const struct shader_generator *g, uint32_t place)
{
    enum { SHORT = 6 };
    const struct shader_structure *const structure = &g->plan.structures[place];
    bool is_short =
        !structure->is_uniform && structure->otherwise == SHADER_NONE && structure->end - place <= SHORT + 1;
    for (uint32_t i = place + 1; is_short && i < structure->end; i++) {
        const enum shader_op op = shader_op_at(&g->plan, i);
        const uint32_t value = g->form->code[i];
        is_short = op == SHADER_SET || op == SHADER_DISCARD || shader_is_instruction(g, value) ||
                   (op == SHADER_LEAVE &&
                    !g->plan.structures[g->plan.place[g->form->nodes[value].operands[0]]].is_uniform);
    }
    return is_short;
}

static void generate_if(struct shader_generator *g, uint32_t place)
{
    const struct shader_structure *const structure = &g->plan.structures[place];
    const uint32_t condition = g->form->nodes[g->form->code[place]].operands[0];
    const uint32_t before = g->mask;
    const bool has_else = structure->otherwise != SHADER_NONE;
    const uint32_t middle = has_else ? structure->otherwise : structure->end;
    struct shader_edge *const otherwise = shader_new_edge(g);
    struct shader_edge *const end = has_else ? shader_new_edge(g) : otherwise;
    uint32_t inside = before;
    const bool is_short = is_short_if(g, place);
    if (structure->is_uniform) {
        shader_test_alike(g, condition);
    } else {
        inside = shader_and_mask(g, before, condition, false);
        g->values[inside].end = has_else ? UINT32_MAX : middle - 1;
        g->divergence++;
    }
    if (!structure->is_uniform && !is_short) {
        shader_test_mask(g, inside);
    }
    if (!is_short) {
        shader_edge_jump_if(g, X86_EQUAL, otherwise, middle);
    }
    shader_end_place(g);
    generate_branch(g, place + 1, middle, inside);
    g->place = middle;
    if (has_else && structure->is_uniform) {
        if (!g->is_gone) {
            shader_edge_jump(g, end, structure->end);
        }
        g->is_gone = true;
        come_together(g, otherwise, middle);
        generate_branch(g, middle + 1, structure->end, before);
    } else if (has_else) {
        come_together(g, otherwise, middle);
        const uint32_t outside = shader_and_mask(g, before, inside, true);
        shader_test_mask(g, outside);
        shader_edge_jump_if(g, X86_EQUAL, end, structure->end);
        generate_branch(g, middle + 1, structure->end, outside);
        shader_drop_value(g, outside);
    }
    g->place = structure->end;
    if (!is_short) {
        come_together(g, end, structure->end);
    }
    if (!structure->is_uniform) {
        g->divergence--;
        shader_drop_value(g, inside);
    }
    g->mask = before;
    if (structure->loses) {
        go_on_alive(g);
    }
}

// Lanes that leave structure come back at its end. Where none is lost further out, all that were alive are again.
static void begin_leaving(struct shader_generator *g, uint32_t place)
{
    const struct shader_structure *const structure = &g->plan.structures[place];
    g->ends[place] = shader_new_edge(g);
    if (structure->is_uniform) {
        return;
    }
    if (structure->loses) {
        const uint32_t left = shader_new_value(g);
        const int reg = shader_temporary(g);
        shader_put(g, X86_VXORPS, reg, reg, x86_reg(reg));
        shader_assign(g, left, reg);
        shader_unlock(g);
        g->left[place] = left;
    } else if (g->plan.loses_lanes) {
        g->left[place] = copy_mask(g, g->alive);
    }
    g->divergence++;
}

static void end_leaving(struct shader_generator *g, uint32_t place, uint32_t before)
{
    const struct shader_structure *const structure = &g->plan.structures[place];
    g->divergence -= structure->is_uniform ? 0 : 1;
    if (!structure->is_uniform && g->plan.loses_lanes) {
        change_mask(g, structure->loses ? X86_VORPS : X86_VMOVUPS, g->alive, g->left[place]);
        shader_drop_value(g, g->left[place]);
    }
    g->is_dead = false;
    g->mask = before;
    if (structure->loses) {
        go_on_alive(g);
    }
}

static void generate_region(struct shader_generator *g, uint32_t place)
{
    const uint32_t before = g->mask, outer = g->block_mask;
    const uint32_t end = g->plan.structures[place].end;
    begin_leaving(g, place);
    shader_end_place(g);
    g->block_mask = before;
    shader_walk_narrow(&g->walk, place + 1, end, place);
    take_mask(g, before);
    g->block_mask = outer;
    g->place = end;
    come_together(g, g->ends[place], end);
    end_leaving(g, place, before);
}

// A loop may have no end, so the program is asked now and then whether somebody waits for it.
void shader_generate_giving_up(struct shader_generator *g, const struct shader_edge *edge)
{
    shader_call_function *const function = shader_machine_function(SHADER_CALL_GIVEN_UP);
    const bool is_compute = g->kind == RHW_SHADER_COMPUTE;
    const size_t bindings = is_compute                       ? offsetof(struct rhw_workgroup, bindings)
                            : g->kind == RHW_SHADER_FRAGMENT ? offsetof(struct rhw_fragment, bindings)
                                                             : offsetof(struct rhw_vertex, bindings);
    const uint32_t go_on = edge ? edge->label : shader_label_new(&g->code);
    shader_encode(&g->code, X86_SUB_I, 0, 0, SHADER_FRAME(rounds), 1);
    shader_encode_jump_if(&g->code, X86_NOT_EQUAL, go_on);
    shader_encode(&g->code, X86_MOV_I, 0, 0, SHADER_FRAME(rounds), SHADER_ROUNDS_A_QUESTION);
    shader_put(g, X86_MOV | X86_WIDE, X86_RDI, 0, x86_at(is_compute ? X86_R14 : X86_RBX, (int32_t)bindings));
    shader_put(g, X86_CALL, 0, 0, shader_pool_bytes(&g->code, &function, sizeof function));
    shader_put(g, X86_TEST, X86_RAX, 0, x86_reg(X86_RAX));
    shader_encode_jump_if(&g->code, X86_NOT_EQUAL, g->exit);
    for (int r = 0; edge && r < REGISTERS; r++) {
        if (edge->holds[r] != SHADER_NONE) {
            shader_put(g, X86_VMOVUPS, r, 0, shader_home_of(g, edge->holds[r]));
        }
    }
    if (edge) {
        shader_encode_jump(&g->code, go_on);
    } else {
        shader_label_place(&g->code, go_on);
    }
}

// A round begins with the lanes that came to the end of the one before.
static void generate_loop(struct shader_generator *g, uint32_t place)
{
    const struct shader_structure *const structure = &g->plan.structures[place];
    const uint32_t before = g->mask, outer = g->block_mask, end = structure->end;
    begin_leaving(g, place);
    if (structure
            ->is_uniform) { // no lane may be active, and then memory that lanes would write does not change
        shader_test_mask(g, before);
        shader_edge_jump_if(g, X86_EQUAL, g->ends[place], end);
    }
    const uint32_t round = copy_mask(g, before);
    struct shader_edge *const again = shader_new_edge(g);
    shader_loop_begin(g, again, end);
    shader_end_place(g);
    struct shader_edge *const outer_loop = g->loop;
    g->loop = again;
    g->loop_depth++;
    g->mask = g->block_mask = round;
    shader_walk_narrow(&g->walk, place + 1, end, place);
    g->loop_depth--;
    g->place = end;
    if (!g->is_dead) {
        const bool is_changed = g->mask != round;
        if (is_changed) {
            change_mask(g, X86_VMOVUPS, round, g->mask);
        }
        take_mask(g, round);
        if (is_changed || !structure->is_uniform) {
            shader_test_mask(g, round);
            shader_edge_jump_if(g, X86_EQUAL, g->ends[place], end);
        }
        shader_flush(g, end);
        shader_loop_again(g, again);
        shader_generate_giving_up(g, again);
        g->is_gone = true;
    }
    take_mask(g, round);
    g->block_mask = outer;
    g->loop = outer_loop;
    come_together(g, g->ends[place], end);
    shader_drop_value(g, round);
    end_leaving(g, place, before);
}

// The whole ------------------------------------------------------------------------------------------

void shader_skip_rest(void *user, uint32_t structure)
{
    struct shader_generator *const g = user;
    shader_test_mask(g, g->mask);
    if (structure == SHADER_NONE) {
        shader_edge_jump_if(g, X86_EQUAL, g->group_end, g->form->code_count);
    } else {
        shader_edge_jump_if(g, X86_EQUAL, g->ends[structure], g->plan.structures[structure].end);
    }
}

void shader_generate_structure(void *user, uint32_t place)
{
    struct shader_generator *const g = user;
    const enum shader_op op = shader_op_at(&g->plan, place);
    g->place = place;
    shader_encode_mark(&g->code, g->form->code[place]);
    if (op == SHADER_IF) {
        generate_if(g, place);
    } else if (op == SHADER_REGION) {
        generate_region(g, place);
    } else {
        generate_loop(g, place);
    }
    g->place = g->plan.structures[place].end;
    shader_end_place(g);
}
