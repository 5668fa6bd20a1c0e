// SPDX-License-Identifier: MIT
// See print_code.h.
#include "print_code.h"

#include <stdio.h>
#include <string.h>

enum shape { RM, MR, RVM, MVR, RMV, RMI, MRI, RVMI, RVMR, VMI, M, MI, MN, ML, RMN, O };

static const struct {
    const char *name;
    bool is_vex;
    enum shape shape;
} instructions[X86_INSTRUCTIONS] = {
#define VEX(name, prefix, map, w, opcode, shape, digit) [X86_##name] = {#name, true, shape},
#define INT(name, prefix, map, opcode, shape, digit)    [X86_##name] = {#name, false, shape},
#include "instruction.inc"
#undef VEX
#undef INT
};

// Operands that are not as wide as the instruction, and names that are not those of the table. Kinds of registers: y
// and x are vectors of 256 and 128 bits, q, d, w and b integers of 64, 32, 16 and 8.
static const struct {
    const char *name;
    char reg, rm;
} specials[X86_INSTRUCTIONS] = {
    [X86_VMOVD] = {NULL, 0, 'd'},         [X86_VMOVD_STORE] = {NULL, 0, 'd'},
    [X86_VBROADCASTSS] = {NULL, 0, 'x'},  [X86_VPMOVZXBD] = {NULL, 0, 'x'},
    [X86_VPMOVZXWD] = {NULL, 0, 'x'},     [X86_VPMOVSXBD] = {NULL, 0, 'x'},
    [X86_VPMOVSXWD] = {NULL, 0, 'x'},     [X86_VEXTRACTI128] = {NULL, 0, 'x'},
    [X86_VINSERTI128] = {NULL, 0, 'x'},   [X86_VPEXTRD] = {NULL, 0, 'd'},
    [X86_VPINSRD] = {NULL, 0, 'd'},       [X86_VCVTPH2PS] = {NULL, 0, 'x'},
    [X86_VCVTPS2PH] = {NULL, 0, 'x'},     [X86_VMOVMSKPS] = {NULL, 'd', 0},
    [X86_MOV_STORE16] = {NULL, 'w', 'w'}, [X86_MOV_STORE8] = {NULL, 'b', 'b'},
    [X86_MOVZX8] = {"movzx", 0, 'b'},     [X86_MOVZX16] = {"movzx", 0, 'w'},
    [X86_MOVSX8] = {"movsx", 0, 'b'},     [X86_MOVSX16] = {"movsx", 0, 'w'},
    [X86_MOVSXD] = {NULL, 0, 'd'},        [X86_SET] = {NULL, 0, 'b'},
    [X86_LEA] = {NULL, 0, 'y'}, // its memory has no size
    [X86_CALL] = {NULL, 0, 'q'},          [X86_JMP] = {NULL, 0, 'q'},
    [X86_PUSH] = {NULL, 'q', 0},          [X86_POP] = {NULL, 'q', 0},
};

static const char *const conditions[] = {"o", "no", "b", "ae", "e", "ne", "be", "a",
                                         "s", "ns", "p", "np", "l", "ge", "le", "g"};

// Operands -------------------------------------------------------------------------------------------

enum { NAME = 8, OPERAND = 64 };

static const char *name_register(char kind, int number, char name[NAME])
{
    static const char *const low[] = {"ax", "cx", "dx", "bx", "sp", "bp", "si", "di"};
    const int n = number & 15;
    if (kind == 'x' || kind == 'y') {
        snprintf(name, NAME, "%cmm%d", kind, n);
    } else if (n >= 8) {
        snprintf(name, NAME, "r%d%s", n, kind == 'q' ? "" : kind == 'd' ? "d" : kind == 'w' ? "w" : "b");
    } else if (kind == 'b') {
        snprintf(name, NAME, "%.*sl", n < 4 ? 1 : 2, low[n]);
    } else {
        snprintf(name, NAME, "%s%s", kind == 'q' ? "r" : kind == 'd' ? "e" : "", low[n]);
    }
    return name;
}

static const char *size_of(char kind)
{
    return kind == 'q'   ? "qword ptr "
           : kind == 'd' ? "dword ptr "
           : kind == 'w' ? "word ptr "
           : kind == 'b' ? "byte ptr "
                         : "";
}

static void write_operand(const struct shader_encoder *encoder, struct x86_operand operand, char kind,
                          char index_kind, char text[OPERAND])
{
    char base[NAME], index[NAME];
    if (operand.reg >= 0) {
        name_register(kind, operand.reg, text);
        return;
    }
    int length = snprintf(text, OPERAND, "%s[", size_of(kind));
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
static int write_name(const struct shader_record *record, char text[SHADER_INSTRUCTION_TEXT])
{
    const unsigned number = record->instruction & 0xff;
    const char *const special = specials[number].name, *const name =
                                                           special ? special : instructions[number].name;
    const char *const lock = record->instruction & X86_LOCK ? "lock " : "";
    const char *const condition =
        number == X86_CMOV || number == X86_SET ? conditions[record->instruction >> X86_IF_SHIFT] : "";
    const int begin = snprintf(text, SHADER_INSTRUCTION_TEXT, "%s", lock);
    const int length = begin + snprintf(text + begin, (size_t)(SHADER_INSTRUCTION_TEXT - begin), "%.*s%s ",
                                        (int)strcspn(name, "_"), name, condition);
    for (int i = begin; i < length; i++) {
        text[i] = (char)(text[i] >= 'A' && text[i] <= 'Z' ? text[i] - 'A' + 'a' : text[i]);
    }
    return length;
}

// Write an instruction of the table: what it changes comes first.
static void write_row(const struct shader_encoder *encoder, const struct shader_record *record,
                      char text[SHADER_INSTRUCTION_TEXT])
{
    const unsigned number = record->instruction & 0xff;
    const bool is_vex = instructions[number].is_vex;
    const enum shape shape = instructions[number].shape;
    const char kind = is_vex ? (record->instruction & X86_NARROW ? 'x' : 'y')
                             : (char)(record->instruction & X86_WIDE ? 'q' : 'd');
    const char reg_kind = specials[number].reg ? specials[number].reg : kind;
    const bool is_wide = record->instruction & X86_WIDE && is_vex;
    const char rm_kind = is_wide ? 'q' : specials[number].rm ? specials[number].rm : kind;
    char r[NAME], v[NAME], m[OPERAND];
    name_register(reg_kind, record->reg, r);
    name_register(kind, record->source, v);
    write_operand(encoder, record->rm, rm_kind, shape == RMV ? kind : 'q', m);
    const int length = write_name(record, text), immediate = (int)record->immediate;
    char *const operands = text + length;
    const size_t room = (size_t)(SHADER_INSTRUCTION_TEXT - length);
    switch (shape) {
    case RM: snprintf(operands, room, "%s, %s", r, m); break;
    case MR: snprintf(operands, room, "%s, %s", m, r); break;
    case RVM: snprintf(operands, room, "%s, %s, %s", r, v, m); break;
    case MVR: snprintf(operands, room, "%s, %s, %s", m, v, r); break;
    case RMV: snprintf(operands, room, "%s, %s, %s", r, m, v); break;
    case RMI:
    case VMI:
    case RMN: snprintf(operands, room, "%s, %s, %d", r, m, immediate); break;
    case MRI: snprintf(operands, room, "%s, %s, %d", m, r, immediate); break;
    case RVMI: snprintf(operands, room, "%s, %s, %s, %d", r, v, m, immediate); break;
    case RVMR: snprintf(operands, room, "%s, %s, %s, %cmm%d", r, v, m, kind, immediate); break;
    case M: snprintf(operands, room, "%s", m); break;
    case MI:
    case MN:
    case ML: snprintf(operands, room, "%s, %d", m, immediate); break;
    case O: snprintf(operands, room, "%s", r); break;
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
        snprintf(text, room, "j%s L%d", record->reg < 0 ? "mp" : conditions[record->reg & 15],
                 (int)record->immediate);
        break;
    case X86_NUMBER:
        name_register(high != 0 ? 'q' : 'd', record->reg, name);
        snprintf(text, room, high != 0 ? "movabs %s, 0x%x%08x" : "mov %s, %u", name,
                 (unsigned)(high != 0 ? high : low), (unsigned)low);
        break;
    case X86_VZEROUPPER: snprintf(text, room, "vzeroupper"); break;
    case X86_RETURN: snprintf(text, room, "ret"); break;
    case X86_NOPS: snprintf(text, room, ".balign %d", (int)record->immediate); break;
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
