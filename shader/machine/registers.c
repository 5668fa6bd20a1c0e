// SPDX-License-Identifier: MIT
// Vector registers as a cache of values. Where code comes together every value that lives has its home written, so
// that what is in a register on one way alone may be forgotten; what all ways have in one register stays there. The
// register whose value is read latest is given up first.
#include "generator.h"

enum { SOON = 24 }; // places

// Values ---------------------------------------------------------------------------------------------

void shader_registers_init(struct shader_generator *g)
{
    const uint32_t nodes = g->form->node_count;
    g->value_count = nodes;
    g->value_room = nodes;
    g->values = shader_take(g->memory, nodes, sizeof *g->values);
    for (uint32_t value = 0; value < nodes; value++) {
        g->values[value].reg = -1;
        g->values[value].is_kept = g->plan.is_kept[value];
        g->values[value].home =
            g->form->nodes[value].op == SHADER_CONSTANT ? SHADER_IN_POOL : SHADER_HOMELESS;
    }
    for (int r = 0; r < REGISTERS; r++) {
        g->holds[r] = SHADER_NONE;
    }
    shader_find_lifetimes(g);
}

uint32_t shader_new_value(struct shader_generator *g)
{
    if (g->value_count == g->value_room) {
        g->values = shader_grow(g->memory, g->values, &g->value_room, sizeof *g->values);
    }
    g->values[g->value_count] = (struct shader_machine_value){.reg = -1, .end = UINT32_MAX};
    return g->value_count++;
}

uint32_t shader_take_frame(struct shader_generator *g, uint32_t size)
{
    const uint32_t offset = g->frame_size;
    g->frame_size += (size + VECTOR - 1) / VECTOR * VECTOR;
    return offset;
}

uint32_t shader_take_record(struct shader_generator *g, uint32_t size)
{
    const uint32_t offset = g->record_size;
    g->record_size += (size + VECTOR - 1) / VECTOR * VECTOR;
    return offset;
}

static void add_free(struct shader_generator *g, struct shader_free_list *list, uint32_t offset)
{
    if (list->count == list->room) {
        list->offsets = shader_grow(g->memory, list->offsets, &list->room, sizeof *list->offsets);
    }
    list->offsets[list->count++] = offset;
}

void shader_take_block(struct shader_generator *g, uint32_t value)
{
    struct shader_machine_value *const v = &g->values[value];
    v->home = v->is_kept ? SHADER_IN_RECORD : SHADER_IN_FRAME;
    v->offset = v->is_kept            ? shader_take_record(g, 4 * VECTOR)
                : g->blocks.count > 0 ? g->blocks.offsets[--g->blocks.count]
                                      : shader_take_frame(g, 4 * VECTOR);
}

static void free_value(struct shader_generator *g, uint32_t value)
{
    struct shader_machine_value *const v = &g->values[value];
    if (v->reg >= 0) {
        g->holds[v->reg] = SHADER_NONE;
        v->reg = -1;
    }
    const uint16_t op = value < g->form->node_count ? g->form->nodes[value].op : SHADER_OP_COUNT;
    if (v->home == SHADER_IN_FRAME && op != SHADER_PART) {
        add_free(g, op == SHADER_SAMPLE ? &g->blocks : &g->homes, v->offset);
    }
    v->home = SHADER_HOMELESS;
}

void shader_drop_value(struct shader_generator *g, uint32_t value)
{
    free_value(g, value);
}

void shader_end_place(struct shader_generator *g)
{
    shader_unlock(g);
    for (uint32_t value = g->first_end[g->place]; value != 0; value = g->values[value - 1].next_end) {
        free_value(g, value - 1);
    }
}

struct x86_operand shader_home_of(struct shader_generator *g, uint32_t value)
{
    struct shader_machine_value *const v = &g->values[value];
    switch ((enum shader_home_kind)v->home) {
    case SHADER_HOMELESS:
        if (v->is_kept) {
            v->home = SHADER_IN_RECORD;
            v->offset = shader_take_record(g, VECTOR);
            return x86_at(X86_R15, (int32_t)v->offset);
        }
        v->home = SHADER_IN_FRAME;
        v->offset = g->homes.count > 0 ? g->homes.offsets[--g->homes.count] : shader_take_frame(g, VECTOR);
        return x86_at(X86_RSP, (int32_t)v->offset);
    case SHADER_IN_FRAME:
    case SHADER_IN_WINDOW: return x86_at(X86_RSP, (int32_t)v->offset);
    case SHADER_IN_RECORD: return x86_at(X86_R15, (int32_t)v->offset);
    case SHADER_IN_GROUP: return x86_at(X86_RBX, (int32_t)v->offset);
    case SHADER_IN_INPUTS: return x86_at(X86_R12, (int32_t)v->offset);
    case SHADER_IN_POOL: break;
    }
    return shader_pool_splat(&g->code, g->form->nodes[value].immediate);
}

// Registers ------------------------------------------------------------------------------------------

// Return the place from g->place + `more` on that reads a value next.
static uint32_t next_use(const struct shader_generator *g, uint32_t value, uint32_t more)
{
    struct shader_machine_value *const v = &g->values[value];
    if (value >= g->form->node_count) {
        return g->place + SOON; // a mask
    }
    const uint32_t first = g->first_use[value], end = g->first_use[value + 1];
    v->use = v->use < first ? first : v->use;
    while (v->use < end && g->uses[v->use] < g->place) {
        v->use++;
    }
    uint32_t use = v->use;
    while (use < end && g->uses[use] < g->place + more) {
        use++;
    }
    return use < end ? g->uses[use] : v->end;
}

static bool lives_at(const struct shader_generator *g, uint32_t value, uint32_t place)
{
    return g->values[value].end >= place;
}

static void store(struct shader_generator *g, uint32_t value)
{
    struct shader_machine_value *const v = &g->values[value];
    if (!v->is_stored) {
        shader_put(g, X86_VMOVUPS_STORE, v->reg, 0, shader_home_of(g, value));
        v->is_stored = true;
    }
}

// Take the value out of a register.
static void vacate(struct shader_generator *g, int reg)
{
    const uint32_t value = g->holds[reg];
    if (value == SHADER_NONE) {
        return;
    }
    if (lives_at(g, value, g->place)) {
        store(g, value);
    }
    g->values[value].reg = -1;
    g->holds[reg] = SHADER_NONE;
}

static bool is_free(const struct shader_generator *g, int reg)
{
    return (g->allowed & ~g->locked) >> reg & 1 &&
           (g->holds[reg] == SHADER_NONE || !lives_at(g, g->holds[reg], g->place));
}

static int free_register(const struct shader_generator *g)
{
    for (int r = 0; r < REGISTERS; r++) {
        if (is_free(g, r)) {
            return r;
        }
    }
    return -1;
}

int shader_temporary(struct shader_generator *g)
{
    int best = free_register(g);
    if (best >= 0) {
        vacate(g, best);
    } else {
        uint64_t latest = 0;
        for (int r = 0; r < REGISTERS; r++) {
            if (((g->allowed & ~g->locked) >> r & 1) == 0) {
                continue;
            }
            const struct shader_machine_value *const v = &g->values[g->holds[r]];
            // What has to be stored first counts as if it were read a little earlier.
            const uint64_t use = 2 * (uint64_t)next_use(g, g->holds[r], 0) + (v->is_stored ? 9 : 1);
            if (use > latest) {
                latest = use;
                best = r;
            }
        }
        vacate(g, best);
    }
    g->locked |= 1u << best;
    return best;
}

void shader_assign(struct shader_generator *g, uint32_t value, int reg)
{
    struct shader_machine_value *const v = &g->values[value];
    if (v->reg >= 0 && v->reg != reg) {
        g->holds[v->reg] = SHADER_NONE;
    }
    v->reg = (int8_t)reg;
    v->is_stored = false;
    g->holds[reg] = value;
}

int shader_in_register(struct shader_generator *g, uint32_t value)
{
    if (g->values[value].reg >= 0) {
        g->locked |= 1u << g->values[value].reg;
        return g->values[value].reg;
    }
    const int reg = shader_temporary(g);
    shader_put(g, X86_VMOVUPS, reg, 0, shader_home_of(g, value));
    shader_assign(g, value, reg);
    g->values[value].is_stored = true;
    return reg;
}

struct x86_operand shader_anywhere(struct shader_generator *g, uint32_t value)
{
    const struct shader_machine_value *const v = &g->values[value];
    if (v->reg >= 0) {
        g->locked |= 1u << v->reg;
        return x86_reg(v->reg);
    }
    // What is read again soon is worth a register that is free.
    const uint32_t next = next_use(g, value, 1);
    if (next > g->place && next - g->place < SOON && free_register(g) >= 0) {
        return x86_reg(shader_in_register(g, value));
    }
    return shader_home_of(g, value);
}

void shader_end_operands(struct shader_generator *g)
{
    for (int r = 0; r < REGISTERS; r++) {
        const uint32_t value = g->holds[r];
        if (value != SHADER_NONE && g->values[value].end == g->place && value != g->form->code[g->place]) {
            g->values[value].reg = -1;
            g->values[value].is_stored = true;
            g->holds[r] = SHADER_NONE;
            g->locked &= ~(1u << r);
        }
    }
}

int shader_result(struct shader_generator *g, uint32_t value)
{
    const int reg = shader_temporary(g);
    shader_assign(g, value, reg);
    return reg;
}

void shader_unlock(struct shader_generator *g)
{
    g->locked = 0;
}

void shader_flush(struct shader_generator *g, uint32_t place)
{
    for (int r = 0; r < REGISTERS; r++) {
        if (g->holds[r] != SHADER_NONE && lives_at(g, g->holds[r], place)) {
            store(g, g->holds[r]);
        }
    }
}

void shader_forget_registers(struct shader_generator *g)
{
    for (int r = 0; r < REGISTERS; r++) {
        if (g->holds[r] != SHADER_NONE) {
            g->values[g->holds[r]].reg = -1;
            g->holds[r] = SHADER_NONE;
        }
    }
}

// Where code comes together --------------------------------------------------------------------------

struct shader_edge *shader_new_edge(struct shader_generator *g)
{
    struct shader_edge *const edge = shader_take(g->memory, 1, sizeof *edge);
    edge->label = shader_label_new(&g->code);
    for (int r = 0; r < REGISTERS; r++) {
        edge->holds[r] = SHADER_NONE;
    }
    return edge;
}

static void come_to(struct shader_generator *g, struct shader_edge *edge, uint32_t place)
{
    shader_flush(g, place);
    for (int r = 0; r < REGISTERS; r++) {
        edge->holds[r] = !edge->is_used || edge->holds[r] == g->holds[r] ? g->holds[r] : SHADER_NONE;
    }
    edge->is_used = true;
}

void shader_edge_jump(struct shader_generator *g, struct shader_edge *edge, uint32_t place)
{
    come_to(g, edge, place);
    shader_encode_jump(&g->code, edge->label);
}

void shader_edge_jump_if(struct shader_generator *g, enum x86_condition condition, struct shader_edge *edge,
                         uint32_t place)
{
    come_to(g, edge, place); // moves change no flags
    shader_encode_jump_if(&g->code, condition, edge->label);
}

static void hold(struct shader_generator *g, const uint32_t *holds, uint32_t place)
{
    shader_forget_registers(g);
    for (int r = 0; r < REGISTERS; r++) {
        if (holds[r] != SHADER_NONE && lives_at(g, holds[r], place)) {
            g->holds[r] = holds[r];
            g->values[holds[r]].reg = (int8_t)r;
            g->values[holds[r]].is_stored = true;
        }
    }
}

// Load what all others that come to an edge have in a register, if it is read soon or the loop around begins with it.
// Code that makes calls has lost much, where code beside it that is left out has lost nothing.
static void restore(struct shader_generator *g, const struct shader_edge *edge, uint32_t place)
{
    shader_flush(g, place);
    for (int r = 0; r < REGISTERS; r++) {
        const uint32_t value = edge->is_used ? edge->holds[r] : SHADER_NONE;
        if (value == SHADER_NONE || g->holds[r] == value || !lives_at(g, value, place)) {
            continue;
        }
        struct shader_machine_value *const v = &g->values[value];
        const bool is_looped = g->loop && g->loop->holds[r] == value;
        if (v->home == SHADER_HOMELESS || !(is_looped || next_use(g, value, 0) < g->place + SOON)) {
            continue;
        }
        vacate(g, r);
        shader_put(g, X86_VMOVUPS, r, 0, v->reg >= 0 ? x86_reg(v->reg) : shader_home_of(g, value));
        shader_assign(g, value, r);
        v->is_stored = true;
    }
}

void shader_edge_place(struct shader_generator *g, struct shader_edge *edge, uint32_t place, bool is_dead)
{
    if (!is_dead) {
        restore(g, edge, place);
        come_to(g, edge, place);
    }
    shader_label_place(&g->code, edge->label);
    hold(g, edge->holds, place);
}

// Return true for a place in an IF of the loop that begins here to which not every round comes.
static bool is_seldom(const struct shader_generator *g, uint32_t place)
{
    for (uint32_t i = g->place + 1; i < place; i++) {
        const struct shader_structure *const structure = &g->plan.structures[i];
        if (shader_op_at(&g->plan, i) == SHADER_IF && !structure->is_uniform && structure->end > place) {
            return true;
        }
    }
    return false;
}

void shader_loop_begin(struct shader_generator *g, struct shader_edge *edge, uint32_t end)
{
    shader_flush(g, g->place);
    for (int r = 0; r < REGISTERS; r++) {
        const uint32_t value = g->holds[r];
        const uint32_t use = value != SHADER_NONE ? next_use(g, value, 0) : UINT32_MAX;
        edge->holds[r] = use <= end && lives_at(g, value, end) && !is_seldom(g, use) ? value : SHADER_NONE;
    }
    edge->is_used = true;
    hold(g, edge->holds, g->place);
    shader_label_place(&g->code, edge->label);
}

void shader_loop_again(struct shader_generator *g, struct shader_edge *edge)
{
    for (int r = 0; r < REGISTERS; r++) {
        const uint32_t value = edge->holds[r];
        if (value != SHADER_NONE && g->values[value].reg != r) {
            shader_put(g, X86_VMOVUPS, r, 0, shader_home_of(g, value));
        }
    }
}
