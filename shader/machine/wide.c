// SPDX-License-Identifier: MIT
// The code of a stage: runs, through which one group goes after the other, and wide structure, around barriers, atomics
// and steps, which all groups go through together. Masks of wide structure have an element for each group, in its
// record.
#include "generator.h"

// Runs -----------------------------------------------------------------------------------------------

// Homes of a run begin with it.
static void begin_homes(struct shader_generator *g, uint32_t run)
{
    for (uint32_t home = g->plan.first_home[run]; home != 0; home = g->plan.next_home[home - 1]) {
        const int reg = shader_result(g, home - 1);
        shader_put(g, X86_VBROADCASTSS, reg, 0,
                   shader_pool_scalar(&g->code, g->form->nodes[home - 1].immediate));
        shader_unlock(g);
    }
}

// Return true for a value that is the same for all groups, and at home.
static bool is_alike(const struct shader_generator *g, uint32_t value)
{
    const uint16_t op = g->form->nodes[value].op;
    return op == SHADER_CONSTANT || g->plan.is_joint[value] ||
           (g->plan.is_hoisted[value] && op != SHADER_BUFFER && op != SHADER_PUSH && op != SHADER_WORKGROUP);
}

// Find what the loop over groups of a run has to provide. Return the place behind the run.
static uint32_t ask_run(struct shader_generator *g, uint32_t place, struct shader_groups *groups)
{
    uint32_t i = place;
    groups->is_plain = groups->is_bare = g->plan.has_cuts;
    for (; i < g->form->code_count && g->plan.run[i] == g->plan.run[place]; i++) {
        const uint32_t value = g->form->code[i];
        const bool is_written = g->plan.is_hoisted[value] || g->plan.is_joint[value];
        uint32_t count;
        const uint32_t *const operands = shader_operands(g->form, &g->form->nodes[value], &count);
        groups->is_plain = groups->is_plain && (is_written || shader_is_bare(g, value));
        for (uint32_t o = 0; o < count && !is_written; o++) {
            const uint16_t op = g->form->nodes[operands[o]].op;
            groups->is_bare = groups->is_bare && (op < SHADER_INPUT || op > SHADER_BUILT_IN);
        }
    }
    groups->is_bare = groups->is_bare && groups->is_plain;
    groups->lists = shader_is_decided(&g->plan, i) ? shader_next_list(g) : 0;
    return i;
}

// Load what the code of every group reads, as far as registers are to spare.
static void hold_alike(struct shader_generator *g, uint32_t begin, uint32_t end)
{
    int spare = (__builtin_popcount(g->allowed) - 4) / 2;
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t value = g->form->code[i];
        uint32_t count;
        const uint32_t *const operands = shader_operands(g->form, &g->form->nodes[value], &count);
        for (uint32_t o = 0; o < count && !g->plan.is_hoisted[value] && !g->plan.is_joint[value]; o++) {
            if (spare > 0 && is_alike(g, operands[o]) && g->values[operands[o]].reg < 0) {
                (void)shader_in_register(g, operands[o]);
                spare--;
            }
        }
        shader_unlock(g);
    }
}

static void open_run(void *user, uint32_t place)
{
    struct shader_generator *const g = user;
    struct shader_groups groups = {.is_plain = false};
    const uint32_t end = ask_run(g, place, &groups);
    g->place = place;
    g->group_begin = shader_new_edge(g);
    shader_forget_registers(g);
    if (groups.is_plain) {
        hold_alike(g, place, end);
    }
    for (int r = 0; r < REGISTERS; r++) {
        g->group_begin->holds[r] = g->holds[r];
    }
    shader_open_groups(g, &groups);
    if (!g->plan.has_cuts) {
        shader_clear_own(g);
    }
    g->run_mask = g->block_mask = g->mask;
    begin_homes(g, g->plan.run[place]);
    if (!g->plan.has_cuts && g->plan.loses_lanes) {
        const int reg = shader_in_register(g, g->mask);
        const int copy = shader_temporary(g);
        shader_put(g, X86_VMOVAPS, copy, 0, x86_reg(reg));
        shader_assign(g, g->alive, copy);
        shader_unlock(g);
    }
}

// Where the code of a group ends, fragments that have left are none any more.
static void end_group(struct shader_generator *g)
{
    shader_edge_place(g, g->group_end, g->form->code_count, false);
    if (g->kind == RHW_SHADER_FRAGMENT && g->plan.loses_lanes) {
        const int reg = shader_in_register(g, g->alive);
        const struct x86_operand mask = x86_at(X86_RBX, shader_layout_of(g)->mask);
        shader_put(g, X86_VANDPS, reg, reg, mask);
        shader_put(g, X86_VMOVUPS_STORE, reg, 0, mask);
        g->values[g->alive].is_stored = true;
        shader_unlock(g);
    }
}

static uint32_t new_kept(struct shader_generator *g)
{
    const uint32_t value = shader_new_value(g);
    g->values[value].is_kept = true;
    return value;
}

static void close_run(void *user)
{
    struct shader_generator *const g = user;
    if (!g->plan.has_cuts) {
        end_group(g);
    } else if (g->mask != g->run_mask) {
        const uint32_t kept = new_kept(g);
        const int reg = shader_in_register(g, g->mask);
        shader_drop_value(g, g->mask);
        shader_assign(g, kept, reg);
        g->mask = kept;
        shader_unlock(g);
    }
    shader_flush(g, UINT32_MAX);
    shader_loop_again(g, g->group_begin);
    shader_forget_registers(g);
    shader_close_groups(g);
}

static void call_for_groups(void *user, uint32_t place)
{
    struct shader_generator *const g = user;
    g->place = place;
    shader_encode_mark(&g->code, g->form->code[place]);
    shader_call_for_groups(g, g->form->code[place]);
    shader_end_place(g);
}

static void settle(void *user)
{
    struct shader_generator *const g = user;
    shader_flush(g, UINT32_MAX);
    shader_forget_registers(g);
}

// The run that ends computes which of its lanes go into the IF behind it, and lists the groups that have one.
static void decide(void *user, uint32_t place)
{
    struct shader_generator *const g = user;
    g->place = place;
    g->inside = shader_and_mask(g, g->mask, g->form->nodes[g->form->code[place]].operands[0], false);
    g->values[g->inside].is_kept = true;
    shader_list_group(g, shader_in_register(g, g->inside));
    shader_unlock(g);
}

// Masks of all groups --------------------------------------------------------------------------------

// Set a mask of every group to a & b, or a & ~b. List the groups that have a lane in it, where that is asked for.
static uint32_t and_in_all(struct shader_generator *g, uint32_t a, uint32_t b, bool is_not, bool lists)
{
    const uint32_t result = new_kept(g);
    shader_open_groups(g,
                       &(struct shader_groups){.is_plain = true, .lists = lists ? shader_next_list(g) : 0});
    shader_put(g, X86_VMOVUPS, 0, 0, shader_home_of(g, is_not ? b : a));
    shader_put(g, is_not ? X86_VANDNPS : X86_VANDPS, 0, 0, shader_home_of(g, is_not ? a : b));
    shader_put(g, X86_VMOVUPS_STORE, 0, 0, shader_home_of(g, result));
    if (lists) {
        shader_list_group(g, 0);
    }
    shader_close_groups(g);
    return result;
}

// Copy a mask of every group, or change it by another.
static void change_in_all(struct shader_generator *g, unsigned instruction, uint32_t mask, uint32_t by)
{
    shader_open_groups(g, &(struct shader_groups){.is_plain = true, .is_bare = true});
    shader_put(g, X86_VMOVUPS, 0, 0, shader_home_of(g, by));
    if (instruction != X86_VMOVUPS) {
        shader_put(g, instruction, 0, 0, shader_home_of(g, mask));
    }
    shader_put(g, X86_VMOVUPS_STORE, 0, 0, shader_home_of(g, mask));
    shader_close_groups(g);
}

static uint32_t copy_in_all(struct shader_generator *g, uint32_t mask)
{
    const uint32_t copy = new_kept(g);
    change_in_all(g, X86_VMOVUPS, copy, mask);
    return copy;
}

// List the groups that have a lane in a mask, and set the flag of zero where none has.
static void list_active(struct shader_generator *g, uint32_t mask)
{
    shader_open_groups(
        g, &(struct shader_groups){.is_plain = true, .is_bare = true, .lists = shader_next_list(g)});
    shader_put(g, X86_VMOVUPS, 0, 0, shader_home_of(g, mask));
    shader_list_group(g, 0);
    shader_close_groups(g);
    shader_test_list(g);
}

static void go_on_alive_in_all(struct shader_generator *g)
{
    g->mask = and_in_all(g, g->mask, g->alive, false, false);
}

// Structure ------------------------------------------------------------------------------------------

// Code for lanes that may be some only goes through the groups that are listed.
static void generate_branch(struct shader_generator *g, uint32_t begin, uint32_t end, uint32_t mask,
                            bool parts)
{
    if (parts) {
        shader_enter_list(g);
        g->divergence++;
    }
    g->mask = mask;
    g->is_dead = false;
    shader_walk_wide(&g->walk, begin, end);
    g->is_dead = false;
    if (parts) {
        shader_leave_list(g);
        g->divergence--;
    }
}

static void generate_wide_if(struct shader_generator *g, uint32_t place)
{
    const struct shader_structure *const structure = &g->plan.structures[place];
    const uint32_t condition = g->form->nodes[g->form->code[place]].operands[0];
    const uint32_t before = g->mask;
    const bool has_else = structure->otherwise != SHADER_NONE;
    const uint32_t middle = has_else ? structure->otherwise : structure->end;
    const uint32_t otherwise = shader_label_new(&g->code), end = shader_label_new(&g->code);
    const bool parts = !structure->is_uniform;
    uint32_t inside = before, outside = before;
    if (parts) {
        inside = g->inside != SHADER_NONE ? g->inside : and_in_all(g, before, condition, false, true);
        g->inside = SHADER_NONE;
        shader_test_list(g);
    } else {
        if (!is_alike(g, condition)) { // groups without a lane may not have computed it
            list_active(g, before);
            shader_encode_jump_if(&g->code, X86_EQUAL, end);
            shader_put_first_listed(g);
        }
        shader_test_alike(g, condition);
        shader_forget_registers(g);
    }
    shader_encode_jump_if(&g->code, X86_EQUAL, otherwise);
    generate_branch(g, place + 1, middle, inside, parts);
    if (has_else && !parts) {
        shader_encode_jump(&g->code, end);
    }
    shader_label_place(&g->code, otherwise);
    shader_forget_registers(g);
    if (has_else) {
        if (parts) {
            outside = and_in_all(g, before, inside, true, true);
            shader_test_list(g);
            shader_encode_jump_if(&g->code, X86_EQUAL, end);
        }
        generate_branch(g, middle + 1, structure->end, outside, parts);
    }
    shader_label_place(&g->code, end);
    shader_forget_registers(g);
    g->mask = before;
    if (structure->loses) {
        go_on_alive_in_all(g);
    }
}

// REGION or LOOP.
static void generate_wide_region(struct shader_generator *g, uint32_t place)
{
    const struct shader_structure *const structure = &g->plan.structures[place];
    const bool is_loop = shader_op_at(&g->plan, place) == SHADER_LOOP;
    const uint32_t before = g->mask, again = shader_label_new(&g->code);
    g->ends[place] = shader_new_edge(g);
    if (!structure->is_uniform) {
        g->divergence++;
        g->left[place] = new_kept(g);
        shader_open_groups(g, &(struct shader_groups){.is_plain = true, .is_bare = true});
        shader_put(g, X86_VXORPS, 0, 0, x86_reg(0));
        shader_put(g, X86_VMOVUPS_STORE, 0, 0, shader_home_of(g, g->left[place]));
        shader_close_groups(g);
    }
    // Lanes that come to a round of such structure come to its end.
    const bool is_steady = structure->is_uniform && !structure->loses;
    const uint32_t round = is_steady ? before : copy_in_all(g, before);
    if (is_loop &&
        is_steady) { // no lane may be active, and then memory that lanes would write does not change
        list_active(g, before);
        shader_encode_jump_if(&g->code, X86_EQUAL, g->ends[place]->label);
    }
    shader_label_place(&g->code, again);
    g->mask = round;
    shader_walk_wide(&g->walk, place + 1, structure->end);
    if (is_loop && !g->is_dead) {
        shader_put(g, X86_MOV | X86_WIDE, X86_RBX, 0, SHADER_FRAME(together.groups));
        shader_generate_giving_up(g, NULL);
        if (is_steady) {
            shader_encode_jump(&g->code, again);
        } else {
            change_in_all(g, X86_VMOVUPS, round, g->mask);
            list_active(g, round);
            shader_encode_jump_if(&g->code, X86_NOT_EQUAL, again);
        }
    }
    shader_label_place(&g->code, g->ends[place]->label);
    shader_forget_registers(g);
    if (!structure->is_uniform) {
        g->divergence--;
        change_in_all(g, X86_VORPS, g->alive, g->left[place]);
    }
    g->is_dead = false;
    g->mask = before;
    if (structure->loses) {
        go_on_alive_in_all(g);
    }
}

static void generate_wide_leave(void *user, uint32_t place)
{
    struct shader_generator *const g = user;
    const uint32_t node = g->form->code[place];
    const uint32_t target = g->plan.place[g->form->nodes[node].operands[0]];
    g->is_dead = true;
    if (g->plan.structures[target].is_uniform) {
        shader_encode_jump(&g->code, g->ends[target]->label);
        return;
    }
    change_in_all(g, X86_VORPS, g->left[target], g->mask);
    change_in_all(g, X86_VANDNPS, g->alive, g->mask); // ~mask & alive
}

static void generate_wide_structure(void *user, uint32_t place)
{
    struct shader_generator *const g = user;
    g->place = place;
    if (shader_op_at(&g->plan, place) == SHADER_IF) {
        generate_wide_if(g, place);
    } else {
        generate_wide_region(g, place);
    }
}

static void generate_node(void *user, uint32_t place)
{
    shader_generate_node(user, place);
}

void shader_generate_code(struct shader_generator *g)
{
    g->inside = SHADER_NONE;
    g->walk = (struct shader_walk){.plan = &g->plan,
                                   .user = g,
                                   .mask = &g->mask,
                                   .divergence = &g->divergence,
                                   .loop_depth = &g->loop_depth,
                                   .is_dead = &g->is_dead,
                                   .has_once = true,
                                   .skips_group = g->kind == RHW_SHADER_FRAGMENT && !g->plan.has_cuts,
                                   .node = generate_node,
                                   .narrow = shader_generate_structure,
                                   .wide = generate_wide_structure,
                                   .leave_wide = generate_wide_leave,
                                   .open_run = open_run,
                                   .close_run = close_run,
                                   .settle = settle,
                                   .decide = decide,
                                   .for_groups = call_for_groups,
                                   .skip = shader_skip_rest};
    shader_walk_wide(&g->walk, 0, g->form->code_count);
}
