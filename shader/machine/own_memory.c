// SPDX-License-Identifier: MIT
// The lane's own memory, in which a word is a vector, and tables of constants.
#include "generator.h"

static struct x86_operand own_at(const struct shader_generator *g, uint32_t word)
{
    return x86_at(g->plan.has_cuts ? X86_R15 : X86_RSP, (int32_t)(g->own + word * VECTOR));
}

// Words that all lanes name are vectors. Put one into `reg`, or from there, where it is.
static void access_own_vector(struct shader_generator *g, const struct shader_node *node, uint32_t more,
                              int reg, int mask, int old)
{
    uint32_t index = 0;
    const uint32_t end = shader_label_new(&g->code);
    struct x86_operand at;
    if (shader_put_index(g, node->operands[1], more, &index)) {
        if (index >= g->form->private_count) {
            shader_label_place(&g->code, end);
            return;
        }
        at = own_at(g, index);
    } else {
        shader_encode(&g->code, X86_CMP_I, 0, 0, x86_reg(X86_RAX), (int32_t)g->form->private_count);
        shader_encode_jump_if(&g->code, X86_ABOVE_EQUAL, end);
        shader_encode(&g->code, X86_SHL_I, 0, 0, x86_reg(X86_RAX), 5);
        shader_put(g, X86_LEA | X86_WIDE, X86_RCX, 0, own_at(g, 0));
        at = x86_at_index(X86_RCX, X86_RAX, 0, 0);
    }
    if (old < 0) {
        shader_put(g, X86_VMOVUPS, reg, 0, at);
    } else {
        shader_put(g, X86_VMOVUPS, old, 0, at);
        shader_encode(&g->code, X86_VBLENDVPS, old, old, x86_reg(reg), mask);
        shader_put(g, X86_VMOVUPS_STORE, old, 0, at);
    }
    shader_label_place(&g->code, end);
}

// Broadcast the word of the table that all lanes name.
static void load_constant(struct shader_generator *g, uint32_t value, uint32_t more)
{
    uint32_t index = 0;
    const int result = shader_temporary(g);
    const uint32_t end = shader_label_new(&g->code);
    if (shader_put_index(g, g->form->nodes[value].operands[1], more, &index)) {
        shader_encode_number(&g->code, X86_RAX, index);
    }
    shader_put(g, X86_VXORPS, result, result, x86_reg(result));
    shader_encode(&g->code, X86_CMP_I, 0, 0, x86_reg(X86_RAX), (int32_t)g->form->table_count);
    shader_encode_jump_if(&g->code, X86_ABOVE_EQUAL, end);
    shader_encode_number(&g->code, X86_RCX, (uint64_t)(uintptr_t)g->form->table);
    shader_put(g, X86_VBROADCASTSS, result, 0, x86_at_index(X86_RCX, X86_RAX, 2, 0));
    shader_label_place(&g->code, end);
    shader_assign(g, value, result);
}

// Load the words that lanes name, each its own.
static void gather(struct shader_generator *g, uint32_t value, uint32_t more, bool is_private)
{
    const uint32_t index = shader_index_of(g, g->form->nodes[value].operands[1], more);
    const int at = g->values[index].reg, inside = shader_temporary(g), result = shader_temporary(g);
    shader_put(g, X86_VMOVUPS, inside, 0,
               shader_pool_splat(&g->code, is_private ? g->form->private_count : g->form->table_count));
    shader_put(g, X86_VPCMPGTD, inside, inside, x86_reg(at));
    if (is_private) {
        shader_encode(&g->code, X86_VPSLLD_I, at, 0, x86_reg(at), 3);
        shader_put(g, X86_VPADDD, at, at, shader_lane_numbers(g));
        shader_put(g, X86_LEA | X86_WIDE, X86_RAX, 0, own_at(g, 0));
    } else {
        shader_encode_number(&g->code, X86_RAX, (uint64_t)(uintptr_t)g->form->table);
    }
    shader_put_gather(g, result, at, inside);
    shader_drop_value(g, index);
    shader_assign(g, value, result);
}

void shader_load_own(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value], *const from =
                                                                       &g->form->nodes[node->operands[0]];
    const bool is_private = from->op == SHADER_PRIVATE;
    const bool is_alike = shader_is_shared(g->form, node->operands[1]);
    const uint32_t more = node->immediate + 4 * from->immediate;
    if (is_alike && is_private) {
        const int result = shader_temporary(g);
        shader_put(g, X86_VXORPS, result, result, x86_reg(result));
        access_own_vector(g, node, more, result, -1, -1);
        shader_assign(g, value, result);
        return;
    }
    if (is_alike) {
        load_constant(g, value, more);
        return;
    }
    gather(g, value, more, is_private);
}

void shader_store_own(struct shader_generator *g, const struct shader_node *node)
{
    const bool is_alike = shader_is_shared(g->form, node->operands[1]);
    const uint32_t more = node->immediate + 4 * g->form->nodes[node->operands[0]].immediate;
    if (is_alike) {
        const int from = shader_in_register(g, node->operands[2]), mask = shader_in_register(g, g->mask);
        access_own_vector(g, node, more, from, mask, shader_temporary(g));
        return;
    }
    const uint32_t index = shader_index_of(g, node->operands[1], more);
    const struct shader_invocation call = {
        .which = SHADER_CALL_OWN_STORE,
        .argument_count = 2,
        .arguments = {shader_address_argument(own_at(g, 0)), shader_number_argument(g->form->private_count)},
        .vector_count = 3,
        .vectors = {index, node->operands[2], g->mask},
        .result = SHADER_NONE};
    shader_invoke(g, &call);
    shader_drop_value(g, index);
}
