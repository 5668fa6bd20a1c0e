// SPDX-License-Identifier: MIT
// What all groups share in wide structure, and is computed once for all of them, between runs: the counter of a loop,
// and what a round loads by it.
#include "plan.h"

// After so many rounds what is still open counts as not joint, as in uniform.c.
enum { MAX_ROUNDS = 32 };

static bool is_uniform(const struct shader_plan *plan, uint32_t value)
{
    return (plan->form->nodes[value].flags & SHADER_UNIFORM) != 0;
}

static bool is_once(const struct shader_plan *plan, uint32_t value)
{
    const uint16_t op = plan->form->nodes[value].op;
    return op == SHADER_CONSTANT || op == SHADER_TABLE || plan->is_hoisted[value] || plan->is_joint[value];
}

bool shader_is_joint_in_order(const struct shader_plan *plan, uint32_t place)
{
    const uint32_t value = plan->form->code[place];
    const struct shader_node *const node = &plan->form->nodes[value];
    return plan->is_joint[value] &&
           (node->op == SHADER_SET ||
            (node->op == SHADER_LOAD && !shader_is_constant_memory(plan, node->operands[0])));
}

// Begin with all that may be joint: what all lanes of a call share, outside of narrow structure.
static void find_joint_candidates(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    uint32_t *const stack = shader_take(memory, SHADER_MAX_DEPTH + 2, sizeof *stack);
    uint32_t depth = 0;
    for (uint32_t value = 0; value < form->node_count; value++) {
        plan->is_joint[value] = form->nodes[value].op == SHADER_HOME && is_uniform(plan, value) &&
                                !shader_is_resource_home(plan, value);
    }
    for (uint32_t i = 0; i < form->code_count; i++) {
        const uint32_t value = form->code[i];
        const enum shader_op op = shader_op_at(plan, i);
        const bool is_among_groups = depth == 0 || plan->structures[stack[depth - 1]].is_wide;
        if (op == SHADER_SET && !is_among_groups) {
            plan->is_joint[form->nodes[value].operands[0]] = false;
        }
        plan->is_joint[value] =
            is_among_groups && is_uniform(plan, value) && !plan->is_hoisted[value] && op != SHADER_BUFFER &&
            op != SHADER_NEEDS_GRADIENT &&
            (op == SHADER_LOAD || op == SHADER_COPY || shader_op_kind_of(op) == SHADER_KIND_VALUE);
        if (shader_opens(op)) {
            stack[depth++] = i;
        } else if (shader_closes(op)) {
            depth--;
        }
    }
}

// Take away what does not follow from joint values alone. Return false where nothing was left to take.
static bool drop_joint(struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    bool changed = false;
    for (uint32_t i = 0; i < form->code_count; i++) {
        uint32_t count;
        const uint32_t *const operands = shader_operands(form, &form->nodes[form->code[i]], &count);
        const bool sets = shader_op_at(plan, i) == SHADER_SET;
        const uint32_t value = sets ? operands[0] : form->code[i];
        bool is_joint = plan->is_joint[value];
        for (uint32_t o = sets ? 1 : 0; o < count && is_joint; o++) {
            is_joint = is_once(plan, shader_resource_of(plan, operands[o]));
        }
        changed = changed || is_joint != plan->is_joint[value];
        plan->is_joint[value] = is_joint;
    }
    return changed;
}

void shader_find_joint(struct shader_memory *memory, struct shader_plan *plan)
{
    const struct shader_program *const form = plan->form;
    int round = 0;
    find_joint_candidates(memory, plan);
    while (round < MAX_ROUNDS && drop_joint(plan)) {
        round++;
    }
    for (uint32_t value = 0; round == MAX_ROUNDS && value < form->node_count; value++) {
        plan->is_joint[value] = false;
    }
    for (uint32_t i = 0; i < form->code_count; i++) {
        const struct shader_node *const node = &form->nodes[form->code[i]];
        if (node->op == SHADER_SET) {
            plan->is_joint[form->code[i]] = plan->is_joint[node->operands[0]];
        }
    }
}
