// SPDX-License-Identifier: MIT
// See print_code.h.
#include "print_code.h"

#include <stdio.h>
#include <string.h>

// Operands that are not as wide as the instruction. Kinds of registers: y and x are vectors of 256 and 128 bits, q and
// d integers of 64 and 32.
static const struct {
    char reg, rm;
} widths[X86_INSTRUCTIONS] = {
    [X86_VMOVD] = {0, 'd'},     [X86_VMOVD_STORE] = {0, 'd'}, [X86_VBROADCASTSS] = {0, 'x'},
    [X86_VMOVMSKPS] = {'d', 0}, [X86_LEA] = {0, 'y'}, // its memory has no size
    [X86_CALL] = {0, 'q'},      [X86_PUSH] = {'q', 0},        [X86_POP] = {'q', 0},
};

static const char *const conditions[] = {
    [X86_ABOVE_EQUAL] = "ae", [X86_EQUAL] = "e", [X86_NOT_EQUAL] = "ne", [X86_BELOW_EQUAL] = "be"};

// Operands -------------------------------------------------------------------------------------------

enum { NAME = 8, OPERAND = 64 };

static const char *name_register(char kind, int number, char name[NAME])
{
    static const char *const low[] = {"ax", "cx", "dx", "bx", "sp", "bp", "si", "di"};
    const int n = number & 15;
    if (kind == 'x' || kind == 'y') {
        snprintf(name, NAME, "%cmm%d", kind, n);
    } else if (n >= 8) {
        snprintf(name, NAME, "r%d%s", n, kind == 'q' ? "" : "d");
    } else {
        snprintf(name, NAME, "%c%s", kind == 'q' ? 'r' : 'e', low[n]);
    }
    return name;
}

static void write_operand(const struct shader_encoder *encoder, struct x86_operand operand, char kind,
                          char index_kind, char text[OPERAND])
{
    char base[NAME], index[NAME];
    if (operand.reg >= 0) {
        name_register(kind, operand.reg, text);
        return;
    }
    const char *const size = kind == 'q' ? "qword ptr " : kind == 'd' ? "dword ptr " : "";
    int length = snprintf(text, OPERAND, "%s[", size);
    if (operand.base < 0) {
        snprintf(text + length, OPERAND - (size_t)length, "rip + pool + %u]",
                 (unsigned)(encoder->constants[operand.offset].place - encoder->pool));
        return;
    }
    length += snprintf(text + length, OPERAND - (size_t)length, "%s", name_register('q', operand.base, base));
    if (operand.index >= 0) {
        length += snprintf(text + length, OPERAND - (size_t)length, " + %s*%d",
                           name_register(index_kind, operand.index, index), 1 << operand.shift);
    }
    const char *const sign = operand.offset < 0 ? "-" : "+";
    const unsigned amount = operand.offset < 0 ? 0u - (unsigned)operand.offset : (unsigned)operand.offset;
    if (amount != 0) {
        length += snprintf(text + length, OPERAND - (size_t)length, " %s %u", sign, amount);
    }
    snprintf(text + length, OPERAND - (size_t)length, "]");
}

// Instructions ---------------------------------------------------------------------------------------

// Write the name up to what tells forms apart, in small letters.
static int write_name(const char *name, char text[SHADER_INSTRUCTION_TEXT])
{
    int length = 0;
    for (; name[length] != '\0' && name[length] != '_'; length++) {
        const bool is_letter = name[length] >= 'A';
        text[length] = (char)(is_letter ? name[length] - 'A' + 'a' : name[length]);
    }
    text[length] = '\0';
    return length;
}

// Write an instruction of the table: what it changes comes first.
static void write_row(const struct shader_encoder *encoder, const struct shader_record *record,
                      char text[SHADER_INSTRUCTION_TEXT])
{
    const unsigned number = record->instruction & 0xff;
    const struct x86_encoding *const encoding = shader_encoding_of(number);
    const char kind = encoding->is_vex ? (record->instruction & X86_NARROW ? 'x' : 'y')
                                       : (char)(record->instruction & X86_WIDE ? 'q' : 'd');
    char r[NAME], v[NAME], m[OPERAND];
    name_register(widths[number].reg ? widths[number].reg : kind, record->reg, r);
    name_register(kind, record->source, v);
    write_operand(encoder, record->rm, widths[number].rm ? widths[number].rm : kind,
                  encoding->shape == X86_RXV ? kind : 'q', m);
    const int length = write_name(encoding->name, text), immediate = (int)record->immediate;
    char *const operands = text + length;
    const size_t room = (size_t)(SHADER_INSTRUCTION_TEXT - length);
    switch ((enum x86_shape)encoding->shape) {
    case X86_RM: snprintf(operands, room, " %s, %s", r, m); break;
    case X86_MR: snprintf(operands, room, " %s, %s", m, r); break;
    case X86_RVM: snprintf(operands, room, " %s, %s, %s", r, v, m); break;
    case X86_RXV: snprintf(operands, room, " %s, %s, %s", r, m, v); break;
    case X86_RMI:
    case X86_VMI:
    case X86_RMN: snprintf(operands, room, " %s, %s, %d", r, m, immediate); break;
    case X86_RVMI: snprintf(operands, room, " %s, %s, %s, %d", r, v, m, immediate); break;
    case X86_RVMR: snprintf(operands, room, " %s, %s, %s, %cmm%d", r, v, m, kind, immediate); break;
    case X86_M: snprintf(operands, room, " %s", m); break;
    case X86_MI:
    case X86_MN:
    case X86_ML: snprintf(operands, room, " %s, %d", m, immediate); break;
    case X86_O: snprintf(operands, room, " %s", r); break;
    case X86_NO_OPERANDS: break;
    }
}

void shader_write_instruction(const struct shader_encoder *encoder, const struct shader_record *record,
                              char text[SHADER_INSTRUCTION_TEXT])
{
    const size_t room = SHADER_INSTRUCTION_TEXT;
    const uint32_t low = (uint32_t)record->rm.offset, high = (uint32_t)record->immediate;
    char name[NAME];
    switch (record->instruction) {
    case X86_JUMP:
        snprintf(text, room, "j%s L%d", record->reg < 0 ? "mp" : conditions[record->reg],
                 (int)record->immediate);
        break;
    case X86_NUMBER:
        name_register(high != 0 ? 'q' : 'd', record->reg, name);
        snprintf(text, room, high != 0 ? "movabs %s, 0x%x%08x" : "mov %s, %u", name,
                 (unsigned)(high != 0 ? high : low), (unsigned)low);
        break;
    case X86_LABEL: snprintf(text, room, "L%d:", (int)record->immediate); break;
    default: write_row(encoder, record, text);
    }
}

// The whole ------------------------------------------------------------------------------------------

enum { LONGEST = 15, BYTES_COLUMN = 20, TEXT_COLUMN = 48 };

// Print a line. If it is the first one of a node, fill it up to the column where the node follows.
static void print_record(const struct shader_sink *sink, const struct shader_encoder *encoder,
                         const struct shader_record *record, uint32_t end, bool is_first)
{
    char text[SHADER_INSTRUCTION_TEXT], bytes[2 * LONGEST + 1] = "";
    shader_write_instruction(encoder, record, text);
    if (record->instruction == X86_LABEL) {
        shader_sink_print(sink, "%s", text);
        return;
    }
    for (uint32_t i = 0; i < LONGEST && record->place + i < end; i++) {
        snprintf(bytes + 2 * (size_t)i, 3, "%02x", encoder->bytes[record->place + i]);
    }
    shader_sink_print(sink, "%6x  %-*s  %s", (unsigned)record->place, BYTES_COLUMN, bytes, text);
    const int length = (int)strlen(text);
    if (is_first) {
        shader_sink_print(sink, "%*s ; ", length < TEXT_COLUMN ? TEXT_COLUMN - length : 0, "");
    }
}

void shader_print_code(const struct shader_sink *sink, const struct shader_program *program,
                       const struct shader_encoder *encoder)
{
    struct shader_source_lines *const lines = shader_find_source_lines(encoder->memory, program->module);
    uint32_t mark = 0;
    shader_sink_print(sink, "; %u bytes of code, %u of constants\n", (unsigned)encoder->code_size,
                      (unsigned)(encoder->size - encoder->pool));
    for (uint32_t i = 0; i < encoder->record_count; i++) {
        const struct shader_record *const record = &encoder->records[i];
        const uint32_t end = i + 1 < encoder->record_count ? record[1].place : encoder->code_size;
        uint32_t node = 0;
        while (mark < encoder->mark_count && encoder->marks[mark].place <= record->place &&
               record->instruction != X86_LABEL) {
            node = encoder->marks[mark++].node;
        }
        if (lines && node != 0) {
            shader_print_source_line(sink, lines, program->origins[node], 0);
        }
        print_record(sink, encoder, record, end, node != 0);
        if (node != 0) {
            shader_print_node(sink, program, node);
        }
        shader_sink_print(sink, "\n");
    }
}
