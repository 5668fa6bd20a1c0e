// SPDX-License-Identifier: MIT
// Calls from generated code. The function that is called may change every vector register, so what lives on goes home
// first; operands go to where the ABI wants them.
#include "generator.h"

#include <string.h>

struct shader_argument shader_number_argument(uint64_t number)
{
    return (struct shader_argument){SHADER_BY_NUMBER, number, x86_reg(0)};
}

struct shader_argument shader_address_argument(struct x86_operand at)
{
    return (struct shader_argument){SHADER_BY_ADDRESS, 0, at};
}

struct shader_argument shader_pointer_argument(struct x86_operand at)
{
    return (struct shader_argument){SHADER_BY_POINTER, 0, at};
}

struct shader_argument shader_bound_argument(void)
{
    return shader_pointer_argument(SHADER_FRAME(bound));
}

// Where each operand is, and which have arrived.
struct moves {
    int count;
    int from[SHADER_MAX_VECTORS]; // registers; −1: it comes from memory
    bool is_done[SHADER_MAX_VECTORS];
};

static bool is_awaited(const struct moves *moves, int reg, int except)
{
    for (int i = 0; i < moves->count; i++) {
        if (i != except && !moves->is_done[i] && moves->from[i] == reg) {
            return true;
        }
    }
    return false;
}

// Move operands from register to register: first what nobody waits for. Of a circle one goes to the last register,
// which is no operand's.
static void move_registers(struct shader_generator *g, struct moves *moves)
{
    for (int left = moves->count; left > 0;) {
        int stuck = -1, before = left;
        for (int i = 0; i < moves->count; i++) {
            if (moves->is_done[i]) {
                continue;
            }
            if (moves->from[i] >= 0 && is_awaited(moves, i, i)) {
                stuck = i;
                continue;
            }
            if (moves->from[i] < 0) {
                continue;
            }
            if (moves->from[i] != i) {
                shader_put(g, X86_VMOVAPS, i, 0, x86_reg(moves->from[i]));
            }
            moves->is_done[i] = true;
            left--;
        }
        if (left == before && stuck < 0) {
            return; // the others come from memory
        }
        if (left == before) {
            // Whoever waits for register `stuck` reads a copy of it.
            shader_put(g, X86_VMOVAPS, REGISTERS - 1, 0, x86_reg(stuck));
            for (int i = 0; i < moves->count; i++) {
                moves->from[i] =
                    !moves->is_done[i] && moves->from[i] == stuck ? REGISTERS - 1 : moves->from[i];
            }
        }
    }
}

static void put_vectors(struct shader_generator *g, const struct shader_invocation *invocation)
{
    struct moves moves = {.count = invocation->vector_count};
    for (int i = 0; i < moves.count; i++) {
        moves.from[i] = g->values[invocation->vectors[i]].reg;
        if (moves.from[i] < 0) {
            (void)shader_home_of(g, invocation->vectors[i]);
        }
    }
    move_registers(g, &moves);
    for (int i = 0; i < moves.count; i++) {
        if (moves.from[i] < 0) {
            shader_put(g, X86_VMOVUPS, i, 0, shader_home_of(g, invocation->vectors[i]));
        }
    }
}

static void put_arguments(struct shader_generator *g, const struct shader_invocation *invocation)
{
    static const int registers[SHADER_MAX_ARGUMENTS] = {X86_RDI, X86_RSI, X86_RDX, X86_RCX, X86_R8, X86_R9};
    for (int i = 0; i < invocation->argument_count; i++) {
        const struct shader_argument *const argument = &invocation->arguments[i];
        switch (argument->kind) {
        case SHADER_BY_NUMBER: shader_encode_number(&g->code, registers[i], argument->number); break;
        case SHADER_BY_ADDRESS: shader_put(g, X86_LEA | X86_WIDE, registers[i], 0, argument->at); break;
        case SHADER_BY_POINTER: shader_put(g, X86_MOV | X86_WIDE, registers[i], 0, argument->at); break;
        case SHADER_BY_WORD: shader_put(g, X86_MOV, registers[i], 0, argument->at); break;
        }
    }
}

static void put_call(struct shader_generator *g, const struct shader_invocation *invocation)
{
    shader_call_function *const function = shader_machine_function(invocation->which);
    put_vectors(g, invocation);
    put_arguments(g, invocation);
    shader_put(g, X86_CALL, 0, 0, shader_pool_bytes(&g->code, &function, sizeof function));
}

void shader_invoke_aside(struct shader_generator *g, const struct shader_invocation *invocation, int reg)
{
    for (int r = 0; r < REGISTERS; r++) {
        if (g->holds[r] != SHADER_NONE && !g->values[g->holds[r]].is_stored) {
            shader_put(g, X86_VMOVUPS_STORE, r, 0, shader_home_of(g, g->holds[r]));
        }
    }
    put_call(g, invocation);
    shader_put(g, X86_VMOVAPS, reg, 0, x86_reg(0));
    for (int r = 0; r < REGISTERS; r++) {
        if (g->holds[r] != SHADER_NONE) {
            shader_put(g, X86_VMOVUPS, r, 0, shader_home_of(g, g->holds[r]));
        }
    }
}

void shader_invoke(struct shader_generator *g, const struct shader_invocation *invocation)
{
    shader_flush(g, g->place + 1);
    put_call(g, invocation);
    shader_forget_registers(g);
    if (invocation->result != SHADER_NONE) {
        shader_assign(g, invocation->result, 0);
        g->locked |= 1;
    }
}

void shader_invoke_plain(struct shader_generator *g, unsigned which, int argument_count,
                         const struct shader_argument *arguments)
{
    struct shader_invocation invocation = {
        .which = which, .argument_count = argument_count, .result = SHADER_NONE};
    memcpy(invocation.arguments, arguments, (size_t)argument_count * sizeof *arguments);
    shader_invoke(g, &invocation);
}
