// SPDX-License-Identifier: MIT
// The form as a text that can be read beside the source.
#include "print.h"

#include <string.h>

static void print_value(FILE *stream, const struct shader_program *program, uint32_t value)
{
    const struct shader_node *const node = &program->nodes[value];
    if (node->op != SHADER_CONSTANT) {
        fprintf(stream, " %c%u", node->op == SHADER_HOME ? 'h' : 'v', (unsigned)value);
        return;
    }
    float number;
    memcpy(&number, &node->immediate, sizeof number);
    const uint32_t exponent = node->immediate >> 23 & 0xff;
    if (exponent > 0x60 && exponent < 0x9f) { // more likely a float than a whole number
        fprintf(stream, " %.9g", (double)number);
    } else {
        fprintf(stream, " %d", (int)node->immediate);
    }
}

static bool shows_immediate(enum shader_op op)
{
    switch (op) {
    case SHADER_INPUT:
    case SHADER_INPUT_DX:
    case SHADER_INPUT_DY:
    case SHADER_INPUT_BESIDE:
    case SHADER_INPUT_BELOW:
    case SHADER_BUILT_IN:
    case SHADER_OUTPUT:
    case SHADER_BUFFER:
    case SHADER_LOAD:
    case SHADER_STORE:
    case SHADER_PART: return true;
    default: return false;
    }
}

static void print_name(FILE *stream, enum shader_op op)
{
    for (const char *c = shader_op_name(op); *c != '\0'; c++) {
        fputc(*c >= 'A' && *c <= 'Z' ? *c - 'A' + 'a' : *c, stream);
    }
}

void shader_print(FILE *stream, const struct shader_program *program)
{
    int depth = 0;
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        const struct shader_node *const node = &program->nodes[value];
        const enum shader_op op = (enum shader_op)node->op;
        const bool closes =
            op == SHADER_ELSE || op == SHADER_END_IF || op == SHADER_END_REGION || op == SHADER_END_LOOP;
        const bool opens = op == SHADER_ELSE || op == SHADER_IF || op == SHADER_REGION || op == SHADER_LOOP;
        depth -= closes ? 1 : 0;
        fprintf(stream, "%*s", 4 * depth, "");
        if (shader_op_has_result(op) || op == SHADER_REGION || op == SHADER_LOOP) {
            fprintf(stream, "v%u = ", (unsigned)value);
        }
        print_name(stream, op);
        if (shows_immediate(op)) {
            fprintf(stream, " #%u", (unsigned)node->immediate);
        }
        for (int o = 0; o < shader_op_operands(op); o++) {
            print_value(stream, program, node->operands[o]);
        }
        fputs(node->flags & SHADER_UNIFORM ? "  ; uniform\n" : "\n", stream);
        depth += opens ? 1 : 0;
    }
}
