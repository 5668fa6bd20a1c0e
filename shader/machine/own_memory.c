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

static struct shader_argument table_argument(const struct shader_generator *g)
{
    return shader_number_argument((uint64_t)(uintptr_t)g->form->table);
}

void shader_load_own(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value], *const from =
                                                                       &g->form->nodes[node->operands[0]];
    const bool is_private = from->op == SHADER_PRIVATE;
    const bool is_alike = (g->form->nodes[node->operands[1]].flags & SHADER_UNIFORM) != 0;
    const uint32_t more = node->immediate + 4 * from->immediate;
    if (is_alike && is_private) {
        const int result = shader_temporary(g);
        shader_put(g, X86_VXORPS, result, result, x86_reg(result));
        access_own_vector(g, node, more, result, -1, -1);
        shader_assign(g, value, result);
        return;
    }
    struct shader_invocation call = {
        .which = is_private ? SHADER_CALL_OWN : SHADER_TABLE, .argument_count = 2, .result = value};
    call.arguments[0] = is_private ? shader_address_argument(own_at(g, 0)) : table_argument(g);
    call.arguments[1] = shader_number_argument(is_private ? g->form->private_count : g->form->table_count);
    call.vectors[call.vector_count++] = shader_index_of(g, node->operands[1], more);
    shader_invoke(g, &call);
    shader_drop_value(g, call.vectors[0]);
}

void shader_store_own(struct shader_generator *g, const struct shader_node *node)
{
    const bool is_alike = (g->form->nodes[node->operands[1]].flags & SHADER_UNIFORM) != 0;
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
