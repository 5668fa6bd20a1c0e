// SPDX-License-Identifier: MIT
// Loops over groups: over all that go through the code together, or over a list of those that have an active lane.
// Integer registers that no call is in the way of hold what such a loop counts:
//     r8   groups that are left, or of a list the number of the entry     r9   bytes of a record
//     r10  entries of the list that the loop writes
#include "generator.h"

enum { ENTRY = sizeof(void *), ENTRY_SHIFT = 3 };

static int32_t entries_of(uint32_t list)
{
    return (int32_t)(list + sizeof(uint64_t));
}

static struct x86_operand count_of(uint32_t list)
{
    return x86_at(X86_RSP, (int32_t)list);
}

static void put_pointer(struct shader_generator *g, int reg, struct x86_operand at)
{
    shader_put(g, X86_MOV | X86_WIDE, reg, 0, at);
}

// Lists ----------------------------------------------------------------------------------------------

static uint32_t list_at(struct shader_generator *g, uint32_t depth)
{
    if (g->lists[depth] == 0) {
        g->lists[depth] = shader_take_frame(g, (uint32_t)sizeof(uint64_t) + g->stage->batch * ENTRY);
    }
    return g->lists[depth];
}

uint32_t shader_next_list(struct shader_generator *g)
{
    return list_at(g, g->list_depth + 1);
}

uint32_t shader_list_of_all(struct shader_generator *g)
{
    return list_at(g, 0);
}

void shader_list_group(struct shader_generator *g, int mask)
{
    const struct x86_operand count = count_of(g->groups.lists);
    if (!g->groups.is_plain) {
        shader_put(g, X86_MOV, X86_R10, 0, count);
    }
    shader_put(g, X86_MOV_STORE | X86_WIDE, X86_R15, 0,
               x86_at_index(X86_RSP, X86_R10, ENTRY_SHIFT, entries_of(g->groups.lists)));
    if (mask >= 0) {
        shader_put(g, X86_VMOVMSKPS, X86_RAX, 0, x86_reg(mask));
    } else {
        shader_encode_number(&g->code, X86_RAX, 1);
    }
    // 1 more, minus the carry of a comparison with no lane
    shader_encode(&g->code, X86_CMP_I, 0, 0, x86_reg(X86_RAX), 1);
    shader_encode(&g->code, X86_SBB_I, 0, 0, g->groups.is_plain ? x86_reg(X86_R10) : count, -1);
}

void shader_test_list(struct shader_generator *g)
{
    shader_encode(&g->code, X86_CMP_I, 0, 0, count_of(shader_next_list(g)), 0);
}

void shader_enter_list(struct shader_generator *g)
{
    g->list = shader_next_list(g);
    g->list_depth++;
}

void shader_leave_list(struct shader_generator *g)
{
    g->list_depth--;
    g->list = g->list_depth > 0 ? g->lists[g->list_depth] : 0;
}

void shader_put_first_listed(struct shader_generator *g)
{
    put_pointer(g, X86_R15, x86_at(X86_RSP, entries_of(shader_next_list(g))));
    put_pointer(g, X86_RBX, x86_at(X86_R15, (int32_t)g->group_pointer));
}

void shader_call_for_groups(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    const uint32_t list = g->list > 0 ? g->list : shader_list_of_all(g);
    const unsigned which = node->op == SHADER_EXP    ? SHADER_CALL_EXP_OF_GROUPS
                           : node->op == SHADER_LOG  ? SHADER_CALL_LOG_OF_GROUPS
                           : node->op == SHADER_EXP2 ? SHADER_CALL_EXP2_OF_GROUPS
                                                     : SHADER_CALL_LOG2_OF_GROUPS;
    const struct shader_argument count = {SHADER_BY_WORD, 0, count_of(list)};
    (void)shader_home_of(g, value);
    shader_invoke_plain(
        g, which, 4,
        (struct shader_argument[]){shader_address_argument(x86_at(X86_RSP, entries_of(list))), count,
                                   shader_number_argument(g->values[value].offset),
                                   shader_number_argument(g->values[node->operands[0]].offset)});
}

// Loops ----------------------------------------------------------------------------------------------

static void put_inputs(struct shader_generator *g)
{
    if (g->kind != RHW_SHADER_COMPUTE) {
        put_pointer(g, X86_R12, x86_at(X86_RBX, shader_layout_of(g)->inputs));
        put_pointer(g, X86_R13, x86_at(X86_RBX, shader_layout_of(g)->outputs));
    }
}

static void open_all(struct shader_generator *g)
{
    const struct shader_groups *const groups = &g->groups;
    const int count = groups->is_plain ? X86_R8 : X86_RAX;
    if (!groups->is_bare) {
        put_pointer(g, X86_RBX, SHADER_FRAME(together.groups));
    }
    if (g->has_records) {
        put_pointer(g, X86_R15, SHADER_FRAME(together.records));
    }
    shader_put(g, X86_MOV, count, 0, SHADER_FRAME(together.here));
    if (groups->is_plain) {
        put_pointer(g, X86_R9, SHADER_FRAME(together.record_size));
    } else {
        shader_put(g, X86_MOV_STORE, count, 0, SHADER_FRAME(left));
    }
    shader_label_place(&g->code, groups->again);
}

static void close_all(struct shader_generator *g)
{
    const struct shader_groups *const groups = &g->groups;
    if (!groups->is_bare) {
        shader_encode(&g->code, X86_ADD_I | X86_WIDE, 0, 0, x86_reg(X86_RBX), shader_layout_of(g)->size);
    }
    if (g->has_records) {
        shader_put(g, X86_ADD | X86_WIDE, X86_R15, 0,
                   groups->is_plain ? x86_reg(X86_R9) : SHADER_FRAME(together.record_size));
    }
    shader_encode(&g->code, X86_SUB_I, 0, 0, groups->is_plain ? x86_reg(X86_R8) : SHADER_FRAME(left), 1);
}

static void open_listed(struct shader_generator *g)
{
    const struct shader_groups *const groups = &g->groups;
    const int entry = groups->is_plain ? X86_R8 : X86_RAX;
    if (groups->is_plain) {
        shader_encode_number(&g->code, entry, 0);
        shader_label_place(&g->code, groups->again);
    } else {
        shader_encode(&g->code, X86_MOV_I, 0, 0, SHADER_FRAME(left), 0);
        shader_label_place(&g->code, groups->again);
        shader_put(g, X86_MOV, entry, 0, SHADER_FRAME(left));
    }
    put_pointer(g, X86_R15, x86_at_index(X86_RSP, entry, ENTRY_SHIFT, entries_of(g->list)));
    if (!groups->is_bare) {
        put_pointer(g, X86_RBX, x86_at(X86_R15, (int32_t)g->group_pointer));
    }
}

static void close_listed(struct shader_generator *g)
{
    const bool is_plain = g->groups.is_plain;
    const int entry = is_plain ? X86_R8 : X86_RAX;
    shader_encode(&g->code, X86_ADD_I, 0, 0, is_plain ? x86_reg(X86_R8) : SHADER_FRAME(left), 1);
    if (!is_plain) {
        shader_put(g, X86_MOV, entry, 0, SHADER_FRAME(left));
    }
    shader_put(g, X86_CMP, entry, 0, count_of(g->list));
}

void shader_open_groups(struct shader_generator *g, const struct shader_groups *groups)
{
    g->groups = *groups;
    g->groups.again = shader_label_new(&g->code);
    if (groups->lists > 0 && groups->is_plain) {
        shader_encode_number(&g->code, X86_R10, 0);
    } else if (groups->lists > 0) {
        shader_encode(&g->code, X86_MOV_I, 0, 0, count_of(groups->lists), 0);
    }
    if (g->list > 0) {
        open_listed(g);
    } else {
        open_all(g);
    }
    if (!groups->is_bare) {
        put_inputs(g);
    }
    g->group_end = shader_new_edge(g);
}

void shader_close_groups(struct shader_generator *g)
{
    if (g->list > 0) {
        close_listed(g);
    } else {
        close_all(g);
    }
    shader_encode_jump_if(&g->code, X86_NOT_EQUAL, g->groups.again);
    if (g->groups.lists > 0 && g->groups.is_plain) {
        shader_put(g, X86_MOV_STORE, X86_R10, 0, count_of(g->groups.lists));
    }
}
