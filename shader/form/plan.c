// SPDX-License-Identifier: MIT
// See plan.h.
#include "plan.h"

enum { WORTH_A_STEP = 60, WORTH_A_CALL = 40 };

static bool is_uniform(const struct shader_plan *plan, uint32_t value)
{
    return (plan->form->nodes[value].flags & SHADER_UNIFORM) != 0;
}

static uint32_t *operands_at(const struct shader_plan *plan, uint32_t place, uint32_t *count)
{
    return shader_operands(plan->form, &plan->form->nodes[plan->form->code[place]], count);
}

// Structure ------------------------------------------------------------------------------------------

static void find_structures(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    uint32_t *const stack = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *stack);
    uint32_t depth = 0, blocks = 0;
    uint32_t *const block_stack = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *block_stack);
    for (uint32_t i = 0; i < form->code_count; i++) {
        const enum shader_op op = shader_op_at(plan, i);
        const struct shader_node *const node = &form->nodes[form->code[i]];
        plan->place[form->code[i]] = i;
        if (shader_closes(op)) {
            plan->structures[stack[--depth]].end = i;
        } else if (op == SHADER_ELSE) {
            plan->structures[stack[depth - 1]].otherwise = i;
            block_stack[depth] = ++blocks;
        }
        plan->block[i] = block_stack[depth];
        if (shader_opens(op)) {
            const uint32_t decider = op == SHADER_IF ? node->operands[0] : form->code[i];
            plan->structures[i] =
                (struct shader_structure){.otherwise = SHADER_NONE, .is_uniform = is_uniform(plan, decider)};
            stack[depth++] = i;
            block_stack[depth] = ++blocks;
        }
    }
}

// Structure is wide around a cut, and around a LEAVE of structure that is wide.
static void find_wide(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    uint32_t *const stack = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *stack);
    for (bool changed = true; changed;) {
        uint32_t depth = 0;
        changed = false;
        for (uint32_t i = 0; i < form->code_count; i++) {
            const enum shader_op op = shader_op_at(plan, i);
            const bool leaves_wide =
                op == SHADER_LEAVE &&
                plan->structures[plan->place[form->nodes[form->code[i]].operands[0]]].is_wide;
            const bool is_cut = shader_is_cut(plan, i) || plan->is_step[i];
            for (uint32_t d = 0; (leaves_wide || is_cut) && d < depth; d++) {
                changed = changed || !plan->structures[stack[d]].is_wide;
                plan->structures[stack[d]].is_wide = true;
            }
            if (shader_opens(op)) {
                stack[depth++] = i;
            } else if (shader_closes(op)) {
                depth--;
            }
        }
    }
}

// The lanes of a group that are active may go one way where those of the call do not. They leave narrow structure
// together where they go one way from its begin to every LEAVE of it.
static void find_together(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    uint32_t *const stack = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *stack);
    for (uint32_t i = 0; i < form->code_count; i++) {
        if (shader_opens(shader_op_at(plan, i)) && !plan->structures[i].is_wide) {
            plan->structures[i].is_uniform = shader_op_at(plan, i) != SHADER_IF ||
                                             shader_is_shared(form, form->nodes[form->code[i]].operands[0]);
        }
    }
    for (bool changed = true; changed;) {
        uint32_t depth = 0;
        changed = false;
        for (uint32_t i = 0; i < form->code_count; i++) {
            const enum shader_op op = shader_op_at(plan, i);
            const uint32_t target =
                op == SHADER_LEAVE ? plan->place[form->nodes[form->code[i]].operands[0]] : SHADER_NONE;
            bool part = false;
            for (uint32_t d = depth; target != SHADER_NONE && stack[d - 1] != target; d--) {
                part = part || !plan->structures[stack[d - 1]].is_uniform;
            }
            if (part && plan->structures[target].is_uniform && !plan->structures[target].is_wide) {
                plan->structures[target].is_uniform = false;
                changed = true;
            }
            if (shader_opens(op)) {
                stack[depth++] = i;
            } else if (shader_closes(op)) {
                depth--;
            }
        }
    }
}

// Lanes that leave structure by themselves, or are discarded, do not come out of what is around them.
static void find_losses(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    uint32_t *const stack = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *stack);
    uint32_t depth = 0;
    for (uint32_t i = 0; i < form->code_count; i++) {
        const enum shader_op op = shader_op_at(plan, i);
        const uint32_t target =
            op == SHADER_LEAVE ? plan->place[form->nodes[form->code[i]].operands[0]] : SHADER_NONE;
        const bool loses =
            op == SHADER_DISCARD || (target != SHADER_NONE && !plan->structures[target].is_uniform);
        plan->loses_lanes = plan->loses_lanes || loses;
        for (uint32_t d = depth; loses && d > 0 && stack[d - 1] != target; d--) {
            plan->structures[stack[d - 1]].loses = true;
        }
        if (shader_opens(op)) {
            stack[depth++] = i;
        } else if (shader_closes(op)) {
            depth--;
        }
    }
}

// A LEAVE of wide structure stands in wide structure, and counts as such.
bool shader_is_wide(const struct shader_plan *plan, uint32_t place)
{
    const enum shader_op op = shader_op_at(plan, place);
    if (op == SHADER_LEAVE) {
        const uint32_t target = plan->form->nodes[plan->form->code[place]].operands[0];
        return plan->structures[plan->place[target]].is_wide;
    }
    return shader_opens(op) && plan->structures[place].is_wide;
}

bool shader_is_cut(const struct shader_plan *plan, uint32_t place)
{
    const enum shader_op op = shader_op_at(plan, place);
    if (op == SHADER_ATOMIC || op == SHADER_IMAGE_ATOMIC) {
        const struct shader_node *const node = &plan->form->nodes[plan->form->code[place]];
        return plan->uses[plan->form->code[place]] > 0 || node->immediate == SHADER_ATOMIC_STORE ||
               node->immediate == SHADER_ATOMIC_EXCHANGE || node->immediate == SHADER_ATOMIC_COMPARE_EXCHANGE;
    }
    return op == SHADER_BARRIER;
}

static void count_uses(struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    for (uint32_t i = 0; i < form->code_count; i++) {
        uint32_t count;
        const uint32_t *const operands = operands_at(plan, i, &count);
        const enum shader_op op = shader_op_at(plan, i);
        for (uint32_t o = 0; o < count; o++) {
            plan->uses[operands[o]]++;
            plan->last_use[operands[o]] = i;
        }
        const bool stores = op == SHADER_STORE && shader_changed(form, form->code[i]) == form->code[i];
        plan->has_effects = plan->has_effects || stores || op == SHADER_STORE8 || op == SHADER_STORE16 ||
                            op == SHADER_ATOMIC || op == SHADER_IMAGE_STORE || op == SHADER_IMAGE_ATOMIC ||
                            op == SHADER_BARRIER;
    }
}

// Runs -----------------------------------------------------------------------------------------------

static bool is_mathematics(enum shader_op op)
{
    return op >= SHADER_SIN && op <= SHADER_POW;
}

// Return about how many cycles the operands of an operation wait for its result.
static uint32_t cycles_of(enum shader_op op)
{
    switch (op) {
    case SHADER_FDIV: return 11;
    case SHADER_FSQRT: return 18;
    case SHADER_RSQRT: return 30;
    case SHADER_POW: return 90;
    case SHADER_SAMPLE: return 60;
    default: return is_mathematics(op) ? 45 : 4;
    }
}

// Return true for a function that one call computes for all groups: its constants stay in registers meanwhile.
static bool is_function_of_groups(const struct shader_plan *plan, uint32_t place)
{
    const struct shader_node *const node = &plan->form->nodes[plan->form->code[place]];
    const enum shader_op op = (enum shader_op)node->op;
    if (op != SHADER_EXP && op != SHADER_LOG && op != SHADER_EXP2 && op != SHADER_LOG2) {
        return false;
    }
    const enum shader_op from = (enum shader_op)plan->form->nodes[node->operands[0]].op;
    return plan->place[node->operands[0]] != SHADER_NONE && shader_op_kind_of(from) == SHADER_KIND_VALUE &&
           from != SHADER_PART && !is_uniform(plan, node->operands[0]);
}

// Return true where steps may stand in structure: all lanes of a call go through it round by round, or lanes part in an
// IF of a round.
static bool goes_together(const struct shader_plan *plan, uint32_t place)
{
    return shader_op_at(plan, place) == SHADER_IF || is_uniform(plan, plan->form->code[place]);
}

// Put steps in front of functions that would wait long in their run: outside of structure, and in loops that all lanes
// leave together. Groups whose lanes are all discarded would go through the steps behind, so such code has none.
static bool find_steps(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    uint32_t *const ready = shader_take(memory, form->node_count, sizeof *ready);
    uint32_t *const stack = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *stack);
    uint32_t depth = 0, first = 0, loop = SHADER_NONE, apart = 0;
    bool has_inner = false;
    for (uint32_t i = 0; i < form->code_count && !plan->loses_lanes; i++) {
        const enum shader_op op = shader_op_at(plan, i);
        if (shader_opens(op)) {
            stack[depth++] = loop;
            apart += apart > 0 || !goes_together(plan, i) ? 1 : 0;
            loop = op == SHADER_LOOP ? i : loop;
        } else if (shader_closes(op)) {
            loop = stack[--depth];
            apart -= apart > 0 ? 1 : 0;
        }
        if (plan->is_hoisted[form->code[i]]) {
            continue;
        }
        uint32_t count, start = 0;
        const uint32_t *const operands = operands_at(plan, i, &count);
        for (uint32_t o = 0; o < count; o++) {
            const uint32_t at = plan->place[operands[o]];
            const bool is_near = at != SHADER_NONE && at >= first && (loop == SHADER_NONE || at >= loop) &&
                                 !plan->is_hoisted[operands[o]];
            start = is_near && ready[operands[o]] > start ? ready[operands[o]] : start;
        }
        const bool may_stand = depth == 0 || (apart == 0 && loop != SHADER_NONE);
        const bool is_for_groups = is_function_of_groups(plan, i);
        if (may_stand && is_mathematics(op) && !is_uniform(plan, form->code[i]) &&
            start >= (is_for_groups ? WORTH_A_CALL : WORTH_A_STEP)) {
            plan->is_step[i] = plan->has_cuts = true;
            plan->is_for_groups[i] = is_for_groups;
            has_inner = has_inner || depth > 0;
            first = i;
            start = 0;
        }
        ready[form->code[i]] = start + cycles_of(op);
    }
    return has_inner;
}

bool shader_is_decided(const struct shader_plan *plan, uint32_t place)
{
    if (!plan->has_steps || place == 0 || place >= plan->form->code_count) {
        return false;
    }
    if (shader_op_at(plan, place) != SHADER_IF || !plan->structures[place].is_wide ||
        plan->structures[place].is_uniform) {
        return false;
    }
    const uint32_t condition = plan->form->nodes[plan->form->code[place]].operands[0];
    const uint32_t at = plan->place[condition];
    return at != SHADER_NONE && plan->run[at] != SHADER_NONE && plan->run[at] == plan->run[place - 1];
}

// Number the runs from a place to another. Return the number of the run that is open at the end.
static uint32_t number_runs(struct shader_plan *plan, uint32_t begin, uint32_t end, uint32_t run)
{
    for (uint32_t i = begin; i < end; i++) {
        const enum shader_op op = shader_op_at(plan, i);
        run += plan->is_step[i] ? 1 : 0;
        if (shader_is_cut(plan, i)) {
            plan->run[i] = op == SHADER_BARRIER ? SHADER_NONE : run + 1; // an atomic is a run of its own
            run += 2;
        } else if (shader_is_joint_in_order(plan, i)) {
            plan->run[i] = SHADER_NONE;
            run++;
        } else if (shader_is_wide(plan, i)) {
            const struct shader_structure *const structure = &plan->structures[i];
            plan->run[i] = SHADER_NONE;
            if (op == SHADER_LEAVE) {
                run++;
                continue;
            }
            const uint32_t middle =
                structure->otherwise == SHADER_NONE ? structure->end : structure->otherwise;
            run = number_runs(plan, i + 1, middle, run + 1) + 1;
            plan->run[middle] = plan->run[structure->end] = SHADER_NONE;
            run = middle == structure->end ? run : number_runs(plan, middle + 1, structure->end, run) + 1;
            i = structure->end;
        } else if (shader_opens(op)) {
            for (uint32_t k = i; k <= plan->structures[i].end; k++) {
                plan->run[k] = run;
            }
            i = plan->structures[i].end;
        } else {
            plan->run[i] = run;
            run += plan->is_for_groups[i] ? 1 : 0;
        }
    }
    return run;
}

// A home belongs to the run that has all of its places, unless a loop comes to the run again.
static void place_homes(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    bool *const is_seen = shader_take(memory, form->node_count, sizeof *is_seen);
    uint32_t wide_loops = 0;
    uint32_t *const stack = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *stack);
    uint32_t depth = 0;
    for (uint32_t i = 0; i < form->code_count; i++) {
        const enum shader_op op = shader_op_at(plan, i);
        uint32_t count;
        const uint32_t *const operands = operands_at(plan, i, &count);
        for (uint32_t o = 0; o < count; o++) {
            const uint32_t home = operands[o];
            if (form->nodes[home].op != SHADER_HOME || plan->is_joint[home]) {
                continue;
            }
            const bool is_alone = (!is_seen[home] || plan->home_run[home] == plan->run[i]) && wide_loops == 0;
            plan->home_run[home] = is_alone ? plan->run[i] : SHADER_NONE;
            is_seen[home] = true;
        }
        if (shader_opens(op)) {
            stack[depth++] = i;
            wide_loops += op == SHADER_LOOP && plan->structures[i].is_wide ? 1 : 0;
        } else if (shader_closes(op)) {
            depth--;
            wide_loops -= op == SHADER_END_LOOP && plan->structures[stack[depth]].is_wide ? 1 : 0;
        }
    }
    for (uint32_t value = form->node_count; value-- > 0;) {
        if (!is_seen[value]) {
            continue;
        }
        const uint32_t run = plan->home_run[value];
        plan->is_kept[value] = run == SHADER_NONE;
        if (run != SHADER_NONE) {
            plan->next_home[value] = plan->first_home[run];
            plan->first_home[run] = value + 1;
        }
    }
}

static void find_kept(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    for (uint32_t i = 0; i < form->code_count; i++) {
        uint32_t count;
        const uint32_t *const operands = operands_at(plan, i, &count);
        for (uint32_t o = 0; o < count; o++) {
            const uint32_t at = plan->place[operands[o]];
            if (at != SHADER_NONE && !plan->is_hoisted[operands[o]] && !plan->is_joint[operands[o]] &&
                plan->run[at] != plan->run[i] && !shader_is_decided(plan, i)) {
                plan->is_kept[operands[o]] = true;
            }
        }
    }
    place_homes(memory, plan);
}

bool shader_is_resource_home(const struct shader_plan *plan, uint32_t value)
{
    const struct shader_node *const node = &plan->form->nodes[value];
    if (node->op != SHADER_HOME || !plan->is_hoisted[node->operands[0]]) {
        return false;
    }
    const uint16_t op = plan->form->nodes[node->operands[0]].op;
    return op == SHADER_BUFFER || op == SHADER_PUSH || op == SHADER_WORKGROUP;
}

uint32_t shader_resource_of(const struct shader_plan *plan, uint32_t value)
{
    return shader_is_resource_home(plan, value) ? plan->form->nodes[value].operands[0] : value;
}

// What is computed once ------------------------------------------------------------------------------

bool shader_is_constant_memory(const struct shader_plan *plan, uint32_t buffer)
{
    const struct shader_node *const node = shader_resource_node(plan->form, buffer);
    if (node->op == SHADER_PUSH || node->op == SHADER_TABLE) {
        return true;
    }
    return node->op == SHADER_BUFFER &&
           (!plan->has_effects ||
            (plan->form->resources[node->immediate].variable->storage == SPIRV_UNIFORM &&
             !plan->form->resources[node->immediate].type->is_buffer_block));
}

static void find_hoisted(struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    for (uint32_t i = 0; i < form->code_count; i++) {
        const uint32_t value = form->code[i];
        struct shader_node *const node = &form->nodes[value];
        const enum shader_op op = (enum shader_op)node->op;
        const enum shader_op_kind kind = shader_op_kind_of(op);
        bool is_once = is_uniform(plan, value) &&
                       (kind == SHADER_KIND_VALUE || op == SHADER_LENGTH || op == SHADER_COPY ||
                        (op == SHADER_LOAD && shader_is_constant_memory(plan, node->operands[0])));
        uint32_t count;
        const uint32_t *const operands = operands_at(plan, i, &count);
        for (uint32_t o = 0; o < count; o++) {
            is_once =
                is_once && (form->nodes[operands[o]].op == SHADER_CONSTANT ||
                            form->nodes[operands[o]].op == SHADER_TABLE || plan->is_hoisted[operands[o]]);
        }
        plan->is_hoisted[value] = is_once || op == SHADER_PUSH || op == SHADER_WORKGROUP;
    }
}

void shader_make_plan(struct shader_memory *memory, const struct shader_program *form, bool has_steps,
                      struct shader_plan *plan)
{
    const uint32_t nodes = form->node_count, places = form->code_count + 1;
    *plan = (struct shader_plan){.form = form,
                                 .has_steps = has_steps,
                                 .structures = shader_take(memory, places, sizeof *plan->structures),
                                 .place = shader_take(memory, nodes, sizeof(uint32_t)),
                                 .block = shader_take(memory, places, sizeof(uint32_t)),
                                 .run = shader_take(memory, places, sizeof(uint32_t)),
                                 .is_step = shader_take(memory, places, sizeof(bool)),
                                 .is_for_groups = shader_take(memory, places, sizeof(bool)),
                                 .uses = shader_take(memory, nodes, sizeof(uint32_t)),
                                 .last_use = shader_take(memory, nodes, sizeof(uint32_t)),
                                 .is_hoisted = shader_take(memory, nodes, sizeof(bool)),
                                 .is_joint = shader_take(memory, nodes, sizeof(bool)),
                                 .is_kept = shader_take(memory, nodes, sizeof(bool)),
                                 .home_run = shader_take(memory, nodes, sizeof(uint32_t))};
    for (uint32_t value = 0; value < nodes; value++) {
        plan->place[value] = SHADER_NONE;
    }
    count_uses(plan);
    find_structures(memory, plan);
    find_wide(memory, plan);
    find_together(memory, plan);
    find_losses(memory, plan);
    for (uint32_t i = 0; i < form->code_count; i++) {
        plan->has_cuts = plan->has_cuts || shader_is_cut(plan, i);
    }
    find_hoisted(plan);
    const bool meets = plan->has_cuts;
    // With steps each group would have the memory of the lanes to itself.
    if (has_steps && form->private_count == 0 && find_steps(memory, plan)) {
        find_structures(memory, plan);
        find_wide(memory, plan);
        find_together(memory, plan);
        find_losses(memory, plan);
    }
    plan->has_steps_alone = plan->has_cuts && !meets;
    if (has_steps && plan->has_cuts) {
        shader_find_joint(memory, plan);
    }
    const uint32_t last_run = number_runs(plan, 0, form->code_count, 0);
    plan->first_home = shader_take(memory, last_run + 1, sizeof(uint32_t));
    plan->next_home = shader_take(memory, nodes, sizeof(uint32_t));
    find_kept(memory, plan);
}
