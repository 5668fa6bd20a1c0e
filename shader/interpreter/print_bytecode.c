// SPDX-License-Identifier: MIT
// See print_bytecode.h.
#include "print_bytecode.h"

#include <string.h>

struct printer {
    const struct shader_sink *sink;
    const struct shader_program *program;
    const struct shader_bytecode *bytecode;
};

static void print_operand(const struct printer *printer, struct shader_operand_of operand,
                          enum shader_number_style style)
{
    const struct shader_bytecode *const bytecode = printer->bytecode;
    if (!operand.is_uniform) {
        shader_sink_print(printer->sink, " r%u", (unsigned)(operand.vector / bytecode->batch));
        return;
    }
    const uint32_t number = operand.vector - bytecode->first_uniform;
    if (number < bytecode->constant_count) {
        shader_sink_print(printer->sink, " ");
        shader_print_number(printer->sink, bytecode->constants[number], style);
    } else {
        shader_sink_print(printer->sink, " u%u", (unsigned)number);
    }
}

static void print_register(const struct printer *printer, struct shader_operand_of operand)
{
    print_operand(printer, operand, SHADER_NUMBER_INT);
}

// What the instructions that the form does not have are called, and how many registers they read.
static const struct {
    const char *name;
    int operands;
} extra_ops[SHADER_COUNT_OPS - SHADER_END] = {
    [SHADER_END - SHADER_END] = {"END", 0},
    [SHADER_FILL - SHADER_END] = {"FILL", 0},
    [SHADER_MUL_ADD - SHADER_END] = {"MUL_ADD", 3},
    [SHADER_MUL_SUB - SHADER_END] = {"MUL_SUB", 3},
    [SHADER_SUB_MUL - SHADER_END] = {"SUB_MUL", 3},
    [SHADER_IMIN - SHADER_END] = {"IMIN", 2},
    [SHADER_IMAX - SHADER_END] = {"IMAX", 2},
    [SHADER_JUMP_UNLESS - SHADER_END] = {"JUMP_UNLESS", 1},
    [SHADER_JUMP - SHADER_END] = {"JUMP", 0},
    [SHADER_LOAD_PRIVATE - SHADER_END] = {"LOAD_PRIVATE", 2},
    [SHADER_STORE_PRIVATE - SHADER_END] = {"STORE_PRIVATE", 3},
    [SHADER_LOAD_TABLE - SHADER_END] = {"LOAD_TABLE", 2},
};

static void print_operation_name(const struct printer *printer, uint32_t op)
{
    const char *const name =
        op >= SHADER_END ? extra_ops[op - SHADER_END].name : shader_op_name((enum shader_op)op);
    char small[32];
    size_t length = 0;
    for (const char *c = name; *c != '\0' && length + 1 < sizeof small; c++) {
        small[length++] = (char)(*c >= 'A' && *c <= 'Z' ? *c - 'A' + 'a' : *c);
    }
    small[length] = '\0';
    shader_sink_print(printer->sink, "%-18s", small);
}

static void print_resource(const struct printer *printer, uint32_t resource)
{
    if (resource == SHADER_NO_RESOURCE) {
        shader_sink_print(printer->sink, " push constants");
    } else if (resource == SHADER_SHARED) {
        shader_sink_print(printer->sink, " shared");
    } else {
        shader_sink_print(printer->sink, " ");
        shader_print_resource(printer->sink, printer->program, resource);
    }
}

// Structure keeps masks in registers, and goes to an instruction.
static void print_structure(const struct printer *printer, const struct shader_instruction *instruction)
{
    const uint32_t op = instruction->op;
    if (op == SHADER_IF || op == SHADER_ELSE) {
        print_register(printer, instruction->a);
    }
    shader_sink_print(printer->sink, " mask");
    print_register(printer, instruction->result);
    if (op == SHADER_REGION || op == SHADER_LOOP || op == SHADER_END_REGION || op == SHADER_END_LOOP) {
        print_register(printer, instruction->b);
    }
    if (op == SHADER_IF || op == SHADER_ELSE || op == SHADER_END_LOOP) {
        shader_sink_print(printer->sink, " to %u", (unsigned)instruction->immediate);
    }
    if (instruction->c.vector != 0) {
        shader_sink_print(printer->sink, ", without lanes to %u", (unsigned)instruction->c.vector);
    }
}

static bool reaches_memory(uint32_t op)
{
    return op == SHADER_LOAD || op == SHADER_STORE || op == SHADER_STORE8 || op == SHADER_STORE16 ||
           op == SHADER_LENGTH || op == SHADER_NEEDS_GRADIENT;
}

// Print the name that the immediate stands for, or its number. Return whether that was all there is to say.
static void print_immediate(const struct printer *printer, const struct shader_instruction *instruction)
{
    switch (instruction->op) {
    case SHADER_INPUT:
    case SHADER_INPUT_DX:
    case SHADER_INPUT_DY:
    case SHADER_INPUT_BESIDE:
    case SHADER_INPUT_BELOW:
    case SHADER_INPUT_AT:
        shader_sink_print(printer->sink, " ");
        shader_print_input(printer->sink, printer->program, instruction->immediate);
        return;
    case SHADER_BUILT_IN:
        shader_sink_print(printer->sink, " ");
        shader_print_built_in(printer->sink, instruction->immediate);
        return;
    case SHADER_OUTPUT:
        shader_sink_print(printer->sink, " ");
        shader_print_output(printer->sink, printer->program, instruction->immediate);
        return;
    case SHADER_BUFFER: print_resource(printer, instruction->immediate); return;
    default:
        if (instruction->immediate != 0) {
            shader_sink_print(printer->sink, " #%u", (unsigned)instruction->immediate);
        }
    }
}

// Return what an instruction takes a constant operand for.
static enum shader_number_style style_of(uint32_t op, int operand)
{
    switch (op) {
    case SHADER_MUL_ADD:
    case SHADER_MUL_SUB:
    case SHADER_SUB_MUL: return SHADER_NUMBER_FLOAT;
    case SHADER_IMIN:
    case SHADER_IMAX:
    case SHADER_LOAD_PRIVATE:
    case SHADER_LOAD_TABLE: return SHADER_NUMBER_INT;
    case SHADER_STORE_PRIVATE: return operand == 2 ? SHADER_NUMBER_EITHER : SHADER_NUMBER_INT;
    default: return shader_print_style((enum shader_op)op, operand);
    }
}

static void print_operands(const struct printer *printer, const struct shader_instruction *instruction)
{
    const uint32_t op = instruction->op;
    const struct shader_operand_of operands[] = {instruction->a, instruction->b, instruction->c};
    // What is stored to is no operand of the instruction, and that of a SET stands in its first.
    const bool is_own = op == SHADER_LOAD_PRIVATE || op == SHADER_STORE_PRIVATE || op == SHADER_LOAD_TABLE;
    const int first = reaches_memory(op) || is_own || op == SHADER_BUFFER ? 1 : 0;
    const int count = op == SHADER_SET   ? 1
                      : op >= SHADER_END ? extra_ops[op - SHADER_END].operands
                                         : shader_op_operands((enum shader_op)op);
    for (int o = first; o < count; o++) {
        print_operand(printer, operands[o], style_of(op, o));
    }
}

static void print_instruction(const struct printer *printer, uint32_t number)
{
    const struct shader_instruction *const instruction = &printer->bytecode->code[number];
    const uint32_t op = instruction->op;
    shader_sink_print(printer->sink, "%5u  ", (unsigned)number);
    print_operation_name(printer, op);
    if (op == SHADER_END) {
        return;
    }
    if (op == SHADER_FILL) {
        print_register(printer, instruction->result);
        shader_sink_print(printer->sink, " ");
        shader_print_number(printer->sink, instruction->immediate, SHADER_NUMBER_EITHER);
        return;
    }
    if (op == SHADER_JUMP || op == SHADER_JUMP_UNLESS) {
        if (op == SHADER_JUMP_UNLESS) {
            print_register(printer, instruction->a);
        }
        shader_sink_print(printer->sink, " to %u", (unsigned)instruction->immediate);
        return;
    }
    const enum shader_op_kind kind =
        op >= SHADER_END ? SHADER_KIND_VALUE : shader_op_kind_of((enum shader_op)op);
    if (kind == SHADER_KIND_FLOW) {
        print_structure(printer, instruction);
        return;
    }
    if (op == SHADER_SET || (kind != SHADER_KIND_EFFECT && op != SHADER_STORE_PRIVATE)) {
        print_register(printer, instruction->result);
    }
    print_immediate(printer, instruction);
    const bool is_listed = op < SHADER_END && shader_op_has_list((enum shader_op)op);
    if (is_listed || reaches_memory(op)) {
        print_resource(printer, instruction->resource);
    }
    if (is_listed) {
        shader_sink_print(printer->sink, " operands %u", (unsigned)instruction->b.vector);
    } else {
        print_operands(printer, instruction);
    }
}

void shader_print_bytecode(const struct shader_sink *sink, const struct shader_program *program,
                           const struct shader_bytecode *bytecode)
{
    const struct printer printer = {.sink = sink, .program = program, .bytecode = bytecode};
    shader_sink_print(sink, "; %u instructions, %u groups of 8 lanes at a time\n",
                      (unsigned)bytecode->code_count, (unsigned)bytecode->batch);
    for (uint32_t i = 0; i < bytecode->code_count; i++) {
        print_instruction(&printer, i);
        shader_sink_print(sink, "\n");
    }
}
