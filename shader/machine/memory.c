// SPDX-License-Identifier: MIT
// Buffers, push constants, memory of the workgroup, atomics. A load outside of memory gives 0, and a store there does
// nothing.
#include "generator.h"

// The number of a word whose place in bytes an instruction can hold.
enum { MAX_KNOWN_WORD = 1 << 28, MOST_WORDS = 4 };

// Bindings -------------------------------------------------------------------------------------------

bool shader_is_one(const struct shader_generator *g, uint32_t buffer)
{
    return g->plan.is_hoisted[buffer];
}

uint32_t shader_element_of(const struct shader_generator *g, uint32_t buffer)
{
    return g->plan.is_hoisted[buffer] ? g->form->nodes[buffer].operands[0] : buffer;
}

static struct x86_operand found_at(const struct shader_generator *g, uint32_t buffer, size_t member)
{
    return x86_at(X86_RSP, (int32_t)(g->values[buffer].offset + member));
}

struct shader_argument shader_found_argument(struct shader_generator *g, uint32_t buffer)
{
    return shader_is_one(g, buffer) ? shader_address_argument(found_at(g, buffer, 0))
                                    : shader_number_argument(0);
}

struct shader_argument shader_site_argument(struct shader_generator *g, uint32_t texture, uint32_t sampler,
                                            uint32_t flags, uint32_t width)
{
    struct shader_site site = {.flags = flags, .width = width};
    const struct shader_node *const node = shader_resource_node(g->form, texture);
    if (node->op == SHADER_BUFFER) {
        site.texture = g->stage->slots[node->immediate];
    }
    if (sampler != SHADER_NONE) {
        site.sampler = g->stage->slots[shader_resource_node(g->form, sampler)->immediate];
    }
    return shader_address_argument(shader_pool_bytes(&g->code, &site, sizeof site));
}

// Set an integer register to what all lanes of a value have.
static void put_scalar(struct shader_generator *g, uint32_t value, int reg)
{
    const struct shader_node *const node = &g->form->nodes[value];
    if (node->op == SHADER_CONSTANT) {
        shader_encode_number(&g->code, reg, node->immediate);
    } else if (g->values[value].reg >= 0) {
        shader_put(g, X86_VMOVD_STORE | X86_NARROW, g->values[value].reg, 0, x86_reg(reg));
    } else {
        shader_put(g, X86_MOV, reg, 0, shader_home_of(g, value));
    }
}

// Find the binding of a BUFFER that all lanes name.
static void find_binding(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    struct shader_machine_value *const v = &g->values[value];
    const bool is_words = g->form->resources[node->immediate].type->kind == SHADER_STRUCT;
    const bool is_number = g->form->nodes[node->operands[0]].op == SHADER_CONSTANT;
    v->home = SHADER_IN_FRAME;
    v->offset = shader_take_frame(g, sizeof(struct shader_found));
    shader_flush(g, 0); // the element is at home
    const struct shader_argument element =
        is_number ? shader_number_argument(g->form->nodes[node->operands[0]].immediate)
                  : (struct shader_argument){SHADER_BY_WORD, 0, shader_home_of(g, node->operands[0])};
    shader_invoke_plain(g, SHADER_CALL_FIND_WORDS, 4,
                        (struct shader_argument[]){shader_bound_argument(),
                                                   shader_site_argument(g, value, SHADER_NONE, is_words, 0),
                                                   element, shader_found_argument(g, value)});
}

// The memory of a workgroup is a binding and words too.
static void find_shared(struct shader_generator *g, uint32_t value)
{
    struct shader_machine_value *const v = &g->values[value];
    v->home = SHADER_IN_FRAME;
    v->offset = shader_take_frame(g, sizeof(struct shader_found_pair));
    shader_invoke_plain(g, SHADER_CALL_FIND_SHARED, 3,
                        (struct shader_argument[]){
                            shader_pointer_argument(x86_at(X86_R14, offsetof(struct rhw_workgroup, shared))),
                            shader_number_argument(g->form->workgroup_size),
                            shader_found_argument(g, value)});
}

// Words that all lanes name --------------------------------------------------------------------------

bool shader_put_index(struct shader_generator *g, uint32_t offset, uint32_t more, uint32_t *index)
{
    const struct shader_node *const node = &g->form->nodes[offset];
    if (node->op == SHADER_CONSTANT) {
        *index = (node->immediate + more) >> 2;
        return true;
    }
    put_scalar(g, offset, X86_RAX);
    if (more != 0) {
        shader_encode(&g->code, X86_ADD_I, 0, 0, x86_reg(X86_RAX), (int32_t)more);
    }
    shader_encode(&g->code, X86_SHR_I, 0, 0, x86_reg(X86_RAX), 2);
    return false;
}

void shader_spread(struct shader_generator *g, uint32_t value)
{
    const int result = shader_result(g, value);
    shader_put(g, X86_VMOVD | X86_NARROW, result, 0, x86_reg(X86_RAX));
    shader_put(g, X86_VBROADCASTSS, result, 0, x86_reg(result));
}

static void load_push_word(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    uint32_t index = 0;
    const bool is_known = shader_put_index(g, node->operands[1], node->immediate, &index);
    shader_invoke_plain(
        g, SHADER_CALL_PUSH_WORD, 2,
        (struct shader_argument[]){shader_bound_argument(),
                                   is_known ? shader_number_argument(index)
                                            : (struct shader_argument){SHADER_BY_WORD, 0, x86_reg(X86_RAX)}});
    shader_spread(g, value);
}

// Load a word into a register from `words`, of which there are `count`.
static void load_word(struct shader_generator *g, uint32_t value, int result, struct x86_operand words,
                      struct x86_operand count)
{
    const struct shader_node *const node = &g->form->nodes[value];
    uint32_t index = 0;
    const bool is_known =
        shader_put_index(g, node->operands[1], node->immediate, &index) && index < MAX_KNOWN_WORD;
    const uint32_t end = shader_label_new(&g->code);
    shader_put(g, X86_VXORPS, result, result, x86_reg(result));
    if (is_known) {
        shader_encode(&g->code, X86_CMP_I, 0, 0, count, (int32_t)index);
        shader_encode_jump_if(&g->code, X86_BELOW_EQUAL, end);
    } else {
        if (g->form->nodes[node->operands[1]].op == SHADER_CONSTANT) {
            shader_encode_number(&g->code, X86_RAX, index);
        }
        shader_put(g, X86_CMP, X86_RAX, 0, count);
        shader_encode_jump_if(&g->code, X86_ABOVE_EQUAL, end);
    }
    shader_put(g, X86_MOV | X86_WIDE, X86_RCX, 0, words);
    shader_put(g, X86_VBROADCASTSS, result, 0,
               is_known ? x86_at(X86_RCX, (int32_t)(4 * index)) : x86_at_index(X86_RCX, X86_RAX, 2, 0));
    shader_label_place(&g->code, end);
}

// Return how many loads from a place on read words of one vector, whose first comes first.
static uint32_t run_at(const struct shader_generator *g, uint32_t place)
{
    const struct shader_program *const form = g->form;
    const struct shader_node *const first = &form->nodes[form->code[place]];
    const bool is_hoisted = g->plan.is_hoisted[form->code[place]],
               is_joint = g->plan.is_joint[form->code[place]];
    uint32_t count = 1;
    for (; count < MOST_WORDS && place + count < form->code_count; count++) {
        const uint32_t value = form->code[place + count];
        const struct shader_node *const node = &form->nodes[value];
        const uint32_t bytes = node->immediate - first->immediate;
        if (node->op != SHADER_LOAD || node->operands[0] != first->operands[0] ||
            node->operands[1] != first->operands[1] || bytes >= MOST_WORDS * 4 || bytes % 4 != 0 ||
            g->plan.is_hoisted[value] != is_hoisted || g->plan.is_joint[value] != is_joint) {
            break;
        }
    }
    return count;
}

// Load words of one vector, which mostly are all there.
static void load_words(struct shader_generator *g, struct x86_operand words, struct x86_operand count)
{
    const uint32_t *const values = &g->form->code[g->place];
    const struct shader_node *const nodes = g->form->nodes, *const first = &nodes[values[0]];
    const uint32_t run = run_at(g, g->place), end = shader_label_new(&g->code);
    uint32_t more[MOST_WORDS], last = 0, index = 0;
    int results[MOST_WORDS];
    for (uint32_t i = 0; i < run; i++) {
        more[i] = nodes[values[i]].immediate - first->immediate;
        last = more[i] / 4 > last ? more[i] / 4 : last;
        results[i] = shader_result(g, values[i]);
    }
    if (run > 1) {
        const uint32_t apart = shader_label_new(&g->code);
        if (shader_put_index(g, first->operands[1], first->immediate, &index)) {
            shader_encode_number(&g->code, X86_RAX, index);
        }
        shader_put(g, X86_LEA, X86_RCX, 0, x86_at(X86_RAX, (int32_t)last));
        shader_put(g, X86_CMP, X86_RCX, 0, count);
        shader_encode_jump_if(&g->code, X86_ABOVE_EQUAL, apart);
        shader_put(g, X86_MOV | X86_WIDE, X86_RCX, 0, words);
        for (uint32_t i = 0; i < run; i++) {
            shader_put(g, X86_VBROADCASTSS, results[i], 0,
                       x86_at_index(X86_RCX, X86_RAX, 2, (int32_t)more[i]));
        }
        shader_encode_jump(&g->code, end);
        shader_label_place(&g->code, apart);
    }
    for (uint32_t i = 0; i < run; i++) {
        load_word(g, values[i], results[i], words, count);
    }
    shader_label_place(&g->code, end);
}

// Words of each lane ---------------------------------------------------------------------------------

uint32_t shader_index_of(struct shader_generator *g, uint32_t offset, uint32_t more)
{
    const struct shader_node *const node = &g->form->nodes[offset];
    const uint32_t index = shader_new_value(g);
    const int reg = shader_temporary(g);
    if (node->op == SHADER_CONSTANT) {
        shader_put(g, X86_VBROADCASTSS, reg, 0, shader_pool_scalar(&g->code, (node->immediate + more) >> 2));
    } else if (more != 0) {
        const int from = shader_in_register(g, offset);
        shader_put(g, X86_VPADDD, reg, from, shader_pool_splat(&g->code, more));
        shader_encode(&g->code, X86_VPSRLD_I, reg, 0, x86_reg(reg), 2);
    } else {
        const int from = shader_in_register(g, offset);
        shader_encode(&g->code, X86_VPSRLD_I, reg, 0, x86_reg(from), 2);
    }
    shader_assign(g, index, reg);
    g->values[index].end = g->place; // whoever is called gets it in a register
    return index;
}

static void load_lanes(struct shader_generator *g, uint32_t value, uint32_t buffer)
{
    const struct shader_node *const node = &g->form->nodes[value];
    const uint32_t index = shader_index_of(g, node->operands[1], node->immediate);
    struct shader_invocation call = {.result = value};
    if (g->form->nodes[buffer].op == SHADER_PUSH) {
        call.which = SHADER_CALL_PUSH;
        call.arguments[call.argument_count++] = shader_bound_argument();
        call.vectors[call.vector_count++] = index;
    } else if (shader_is_one(g, buffer)) {
        call.which = SHADER_CALL_LOAD_WORDS;
        call.arguments[call.argument_count++] = shader_found_argument(g, buffer);
        call.vectors[call.vector_count++] = index;
        call.vectors[call.vector_count++] = g->mask;
    } else {
        call.which = SHADER_LOAD;
        call.argument_count = 3;
        call.arguments[0] = shader_bound_argument();
        call.arguments[1] = shader_site_argument(g, buffer, SHADER_NONE, shader_is_shared(g->form, value), 0);
        call.arguments[2] = shader_found_argument(g, buffer);
        call.vector_count = 3;
        call.vectors[0] = shader_element_of(g, buffer);
        call.vectors[1] = index;
        call.vectors[2] = g->mask;
    }
    shader_invoke(g, &call);
    shader_drop_value(g, index);
}

static void load(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    const uint16_t op = g->form->nodes[node->operands[0]].op;
    if (op == SHADER_PRIVATE || op == SHADER_TABLE) {
        shader_load_own(g, value);
        return;
    }
    const bool is_alike = shader_is_shared(g->form, value);
    const uint32_t buffer = shader_resource_of(&g->plan, node->operands[0]);
    if (!is_alike || !shader_is_one(g, buffer)) {
        load_lanes(g, value, buffer);
    } else if (g->form->nodes[buffer].op == SHADER_PUSH) {
        load_push_word(g, value);
    } else if (g->values[value].reg < 0 && g->values[value].home == SHADER_HOMELESS) {
        const struct x86_operand words = found_at(g, buffer, offsetof(struct shader_found, words)),
                                 count = found_at(g, buffer, offsetof(struct shader_found, count));
        load_words(g, words, count);
    } // a word that has a place came with one before it
}

static void store_lanes(struct shader_generator *g, const struct shader_node *node)
{
    const uint32_t buffer = shader_resource_of(&g->plan, node->operands[0]);
    const bool is_part = node->op != SHADER_STORE;
    const uint32_t index =
        is_part ? node->operands[1] : shader_index_of(g, node->operands[1], node->immediate);
    struct shader_invocation call = {
        .which = node->op, .argument_count = 3, .vector_count = 4, .result = SHADER_NONE};
    call.arguments[0] = shader_bound_argument();
    call.arguments[1] =
        shader_site_argument(g, buffer, SHADER_NONE, node->immediate, node->op == SHADER_STORE8 ? 8 : 16);
    call.arguments[2] = shader_found_argument(g, buffer);
    call.vectors[0] = shader_element_of(g, buffer);
    call.vectors[1] = index;
    call.vectors[2] = node->operands[2];
    call.vectors[3] = g->mask;
    if (g->form->nodes[buffer].op == SHADER_WORKGROUP) {
        call.vectors[0] = index; // it has no element
    }
    if (g->form->nodes[buffer].op == SHADER_WORKGROUP && !is_part) {
        call = (struct shader_invocation){
            .which = SHADER_CALL_SHARE,
            .argument_count = 2,
            .arguments = {shader_pointer_argument(x86_at(X86_R14, offsetof(struct rhw_workgroup, shared))),
                          shader_number_argument(g->form->workgroup_size)},
            .vector_count = 3,
            .vectors = {index, node->operands[2], g->mask},
            .result = SHADER_NONE};
    }
    shader_invoke(g, &call);
    if (!is_part) {
        shader_drop_value(g, index);
    }
}

static void length(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    const uint32_t buffer = shader_resource_of(&g->plan, node->operands[0]);
    if (!shader_is_one(g, buffer)) {
        const struct shader_invocation call = {
            .which = SHADER_LENGTH,
            .argument_count = 3,
            .arguments = {shader_bound_argument(),
                          shader_site_argument(g, buffer, SHADER_NONE, shader_is_shared(g->form, value), 0),
                          shader_found_argument(g, buffer)},
            .vector_count = 2,
            .vectors = {shader_element_of(g, buffer), g->mask},
            .result = value};
        shader_invoke(g, &call);
        return;
    }
    const uint32_t fits = shader_label_new(&g->code);
    shader_put(g, X86_MOV, X86_RAX, 0, found_at(g, buffer, offsetof(struct shader_found, count)));
    shader_encode(&g->code, X86_CMP_I, 0, 0, x86_reg(X86_RAX), INT32_MAX / 2);
    shader_encode_jump_if(&g->code, X86_BELOW_EQUAL, fits);
    shader_encode_number(&g->code, X86_RAX, INT32_MAX / 2);
    shader_label_place(&g->code, fits);
    shader_encode(&g->code, X86_SHL_I, 0, 0, x86_reg(X86_RAX), 2);
    shader_spread(g, value);
}

// Of a word of a buffer, or of a texel.
static void atomic(struct shader_generator *g, uint32_t value)
{
    struct shader_node *const node = &g->form->nodes[value];
    const bool is_image = node->op == SHADER_IMAGE_ATOMIC;
    uint32_t count;
    const uint32_t *const operands = shader_operands(g->form, node, &count);
    const uint32_t buffer = shader_resource_of(&g->plan, operands[SHADER_ATOMIC_BUFFER]);
    const uint32_t index = is_image ? SHADER_NONE : shader_index_of(g, operands[SHADER_ATOMIC_OFFSET], 0);
    struct shader_invocation call = {.which = node->op, .argument_count = 3, .result = value};
    call.arguments[0] = shader_bound_argument();
    call.arguments[1] = shader_site_argument(g, buffer, SHADER_NONE, node->immediate, 0);
    call.arguments[2] = shader_found_argument(g, buffer);
    const uint32_t first = is_image ? SHADER_IMAGE_ATOMIC_COORDINATES : SHADER_ATOMIC_VALUE;
    const bool has_element = g->form->nodes[buffer].op != SHADER_WORKGROUP;
    call.vectors[call.vector_count++] = has_element ? shader_element_of(g, buffer) : g->mask;
    if (!is_image) {
        call.vectors[call.vector_count++] = index;
    }
    for (uint32_t o = first; o < (is_image ? SHADER_IMAGE_ATOMIC_OPERANDS : SHADER_ATOMIC_OPERANDS); o++) {
        call.vectors[call.vector_count++] = operands[o];
    }
    call.vectors[call.vector_count++] = g->mask;
    shader_invoke(g, &call);
    if (!is_image) {
        shader_drop_value(g, index);
    }
}

bool shader_select_memory(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    switch ((enum shader_op)node->op) {
    case SHADER_BUFFER:
        if (!g->plan.is_hoisted[value]) {
            return false; // lanes name their own elements, which it copies
        }
        find_binding(g, value);
        return true;
    case SHADER_PUSH: return true;
    case SHADER_WORKGROUP: find_shared(g, value); return true;
    case SHADER_LOAD: load(g, value); return true;
    case SHADER_STORE:
        if (g->form->nodes[node->operands[0]].op == SHADER_PRIVATE) {
            shader_store_own(g, node);
        } else {
            store_lanes(g, node);
        }
        return true;
    case SHADER_STORE8:
    case SHADER_STORE16: store_lanes(g, node); return true;
    case SHADER_LENGTH: length(g, value); return true;
    case SHADER_ATOMIC:
    case SHADER_IMAGE_ATOMIC: atomic(g, value); return true;
    default: return false;
    }
}
