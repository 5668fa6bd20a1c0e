// SPDX-License-Identifier: MIT
// Every instruction of the encoder, with registers and memory of every kind, has the bytes that the assembler of the system
// (binutils) gives it. Each lies in a slot of 16 bytes of its own, so that one that differs moves no other.
#include "machine/encoder.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit.h"

enum { SLOT = 16, MOST_LINES = 1 << 15, LINE = 96 };
enum shape { RM, MR, RVM, MVR, RMV, RMI, MRI, RVMI, RVMR, VMI, M, MI, MN, ML, RMN, O };
enum width { BOTH, ALONE, NARROW, WIDE }; // which of the two widths of an instruction there are

static const struct {
    const char *name;
    bool is_vex;
    enum shape shape;
} instructions[X86_INSTRUCTIONS] = {
#define VEX(name, prefix, map, w, opcode, shape, digit) [X86_##name] = {#name, true, shape},
#define INT(name, prefix, map, opcode, shape, digit)    [X86_##name] = {#name, false, shape},
#include "machine/instruction.inc"
#undef VEX
#undef INT
};

// What is not as the name and the shape say. Kinds of registers: y and x are vectors of 256 and 128 bits, q, d, w and b
// integers of 64, 32, 16 and 8.
static const struct {
    const char *mnemonic;
    char reg, rm;
    enum width width;
    bool no_memory, no_register;
} specials[X86_INSTRUCTIONS] = {
    [X86_VMOVD] = {.rm = 'd', .width = NARROW},
    [X86_VMOVD_STORE] = {.rm = 'd', .width = NARROW},
    [X86_VBROADCASTSS] = {.rm = 'x'},
    [X86_VBROADCASTF128] = {.width = ALONE, .no_register = true},
    [X86_VPMOVZXBD] = {.rm = 'x'},
    [X86_VPMOVZXWD] = {.rm = 'x'},
    [X86_VPMOVSXBD] = {.rm = 'x'},
    [X86_VPMOVSXWD] = {.rm = 'x'},
    [X86_VPMASKMOVD] = {.no_register = true},
    [X86_VPMASKMOVD_STORE] = {.no_register = true},
    [X86_VGATHERDPS] = {.no_register = true},
    [X86_VPGATHERDD] = {.no_register = true},
    [X86_VPERMD] = {.width = ALONE},
    [X86_VPERMQ] = {.width = ALONE},
    [X86_VPERM2F128] = {.width = ALONE},
    [X86_VEXTRACTI128] = {.rm = 'x', .width = ALONE},
    [X86_VINSERTI128] = {.rm = 'x', .width = ALONE},
    [X86_VPEXTRD] = {.rm = 'd', .width = NARROW},
    [X86_VPINSRD] = {.rm = 'd', .width = NARROW},
    [X86_VCVTPH2PS] = {.rm = 'x'},
    [X86_VCVTPS2PH] = {.rm = 'x'},
    [X86_VMOVMSKPS] = {.reg = 'd', .no_memory = true},
    [X86_VPSLLD_I] = {.no_memory = true},
    [X86_VPSRLD_I] = {.no_memory = true},
    [X86_VPSRAD_I] = {.no_memory = true},
    [X86_VPSLLQ_I] = {.no_memory = true},
    [X86_VPSRLQ_I] = {.no_memory = true},
    [X86_MOV_STORE16] = {.reg = 'w', .rm = 'w', .width = ALONE},
    [X86_MOV_STORE8] = {.reg = 'b', .rm = 'b', .width = ALONE},
    [X86_MOV_I] = {.no_register = true}, // the assembler has a shorter one
    [X86_MOVZX8] = {.mnemonic = "movzx", .rm = 'b'},
    [X86_MOVZX16] = {.mnemonic = "movzx", .rm = 'w'},
    [X86_MOVSX8] = {.mnemonic = "movsx", .rm = 'b'},
    [X86_MOVSX16] = {.mnemonic = "movsx", .rm = 'w'},
    [X86_MOVSXD] = {.rm = 'd', .width = WIDE},
    [X86_LEA] = {.no_register = true},
    [X86_XCHG] = {.no_register = true}, // its operands may be exchanged
    [X86_CMOV] = {.mnemonic = "cmova"},
    [X86_SET] = {.mnemonic = "seta", .rm = 'b', .width = ALONE},
    [X86_CALL] = {.rm = 'q', .width = ALONE},
    [X86_JMP] = {.rm = 'q', .width = ALONE},
    [X86_PUSH] = {.reg = 'q', .width = ALONE},
    [X86_POP] = {.reg = 'q', .width = ALONE},
};

static char lines[MOST_LINES][LINE];
static uint8_t lengths[MOST_LINES];
static int line_count;
static struct shader_encoder encoder;
static struct shader_memory memory;

// Texts ----------------------------------------------------------------------------------------------

static const char *register_name(char kind, int number, char name[8])
{
    static const char *const low[] = {"ax", "cx", "dx", "bx", "sp", "bp", "si", "di"};
    if (kind == 'x' || kind == 'y') {
        snprintf(name, 8, "%cmm%d", kind, number & 15);
    } else if (number >= 8) {
        snprintf(name, 8, "r%d%s", number & 15,
                 kind == 'q'   ? ""
                 : kind == 'd' ? "d"
                 : kind == 'w' ? "w"
                               : "b");
    } else if (kind == 'b') {
        snprintf(name, 8, "%.*sl", number < 4 ? 1 : 2, low[number]);
    } else {
        snprintf(name, 8, "%s%s", kind == 'q' ? "r" : kind == 'd' ? "e" : "", low[number]);
    }
    return name;
}

static void operand_text(struct x86_operand operand, char kind, char index_kind, char text[64])
{
    char base[8], index[8];
    if (operand.reg >= 0) {
        register_name(kind, operand.reg, text);
        return;
    }
    const char *const size = kind == 'q'   ? "qword ptr "
                             : kind == 'd' ? "dword ptr "
                             : kind == 'w' ? "word ptr "
                             : kind == 'b' ? "byte ptr "
                                           : "";
    if (operand.base < 0) {
        snprintf(text, 64, "%s[rip + pool + %d]", size, 32 * operand.offset);
    } else if (operand.index >= 0) {
        snprintf(text, 64, "%s[%s + %s*%d + %d]", size, register_name('q', operand.base, base),
                 register_name(index_kind, operand.index, index), 1 << operand.shift, (int)operand.offset);
    } else {
        snprintf(text, 64, "%s[%s + %d]", size, register_name('q', operand.base, base), (int)operand.offset);
    }
}

static const char *mnemonic_of(unsigned instruction, char text[32])
{
    if (specials[instruction].mnemonic) {
        return specials[instruction].mnemonic;
    }
    int length = 0;
    for (const char *c = instructions[instruction].name; *c != '\0' && *c != '_'; c++) {
        text[length++] = (char)tolower((unsigned char)*c);
    }
    text[length] = '\0';
    return text;
}

// One instruction ------------------------------------------------------------------------------------

static void begin_slot(void)
{
    assert_in_range(line_count, 0, MOST_LINES - 1);
    shader_encode_alignment(&encoder, SLOT);
    assert_int_equal(encoder.size, (size_t)line_count * SLOT);
}

static void end_slot(void)
{
    const size_t length = encoder.size - (size_t)line_count * SLOT;
    assert_in_range(length, 1, SLOT - 1);
    lengths[line_count++] = (uint8_t)length;
}

// Add an instruction as bytes and as a text in Intel's syntax: the destination comes first.
static void add(unsigned instruction, unsigned flags, int reg, int source, struct x86_operand rm,
                int32_t immediate)
{
    const enum shape shape = instructions[instruction].shape;
    const bool is_vex = instructions[instruction].is_vex;
    const char kind = is_vex ? (flags & X86_NARROW ? 'x' : 'y') : flags & X86_WIDE ? 'q' : 'd';
    const char reg_kind = specials[instruction].reg ? specials[instruction].reg : kind;
    const char rm_kind = specials[instruction].rm ? specials[instruction].rm : kind;
    const bool is_gather = shape == RMV, has_own_size = is_vex && rm_kind != 'd';
    char r[8], v[8], m[64], name[32];
    register_name(reg_kind, reg, r);
    register_name(kind, source, v);
    operand_text(rm, rm.reg < 0 && has_own_size ? 'y' : rm_kind, is_gather ? kind : 'q', m);
    const char *const lock = flags & X86_LOCK ? "lock " : "";
    const char *const form = shape == MR                                    ? "{store} "
                             : shape == RM || shape == RVM || shape == RVMI ? "{load} "
                                                                            : "";
    char *const line = lines[line_count];
    const int length = snprintf(line, LINE, "%s%s%s ", lock, form, mnemonic_of(instruction, name));
    char *const operands = line + length;
    const size_t room = LINE - (size_t)length;
    switch (shape) {
    case RM: snprintf(operands, room, "%s, %s", r, m); break;
    case MR: snprintf(operands, room, "%s, %s", m, r); break;
    case RVM: snprintf(operands, room, "%s, %s, %s", r, v, m); break;
    case MVR: snprintf(operands, room, "%s, %s, %s", m, v, r); break;
    case RMV: snprintf(operands, room, "%s, %s, %s", r, m, v); break;
    case RMI:
    case VMI:
    case RMN: snprintf(operands, room, "%s, %s, %d", r, m, (int)immediate); break;
    case MRI: snprintf(operands, room, "%s, %s, %d", m, r, (int)immediate); break;
    case RVMI: snprintf(operands, room, "%s, %s, %s, %d", r, v, m, (int)immediate); break;
    case RVMR: snprintf(operands, room, "%s, %s, %s, %cmm%d", r, v, m, kind, (int)immediate); break;
    case M: snprintf(operands, room, "%s", m); break;
    case MI:
    case MN:
    case ML: snprintf(operands, room, "%s, %d", m, (int)immediate); break;
    case O: snprintf(operands, room, "%s", r); break;
    }
    const bool has_digit = shape == M || shape == MI || shape == MN || shape == ML;
    const unsigned condition =
        instruction == X86_CMOV || instruction == X86_SET ? X86_IF((unsigned)X86_ABOVE) : 0;
    begin_slot();
    shader_encode(&encoder, instruction | flags | condition, has_digit ? 0 : reg, source, rm, immediate);
    end_slot();
}

// All of them ----------------------------------------------------------------------------------------

static int32_t immediate_of(enum shape shape, int number)
{
    switch (shape) {
    case RVMR: return (number * 3 + 2) & 15;
    case MI:
    case VMI: return 2 + number % 29;
    case MN:
    case RMN: return number % 2 == 0 ? -5 - number : 70000 + number;
    case ML: return number % 2 == 0 ? 5 : -70000;
    default: return number % 8;
    }
}

static void add_registers(unsigned instruction, unsigned flags)
{
    const enum shape shape = instructions[instruction].shape;
    for (int i = 0; i < 16; i++) {
        const int rm = (5 * i + 1) & 15;
        // The assembler has a shorter form for eax.
        if (rm != X86_RAX || (shape != MN && shape != ML)) {
            add(instruction, flags, i, (7 * i + 3) & 15, x86_reg(rm), immediate_of(shape, i));
        }
    }
}

static void add_memory(unsigned instruction, unsigned flags)
{
    static const int32_t offsets[] = {0, 4, 127, 128, -128, -129, 1 << 20};
    const enum shape shape = instructions[instruction].shape;
    for (int base = 0; base < 16; base++) {
        for (int i = 0; i < 3; i++) {
            const int32_t offset = offsets[(base * 3 + i) % 7];
            const int reg = (3 * base + 5 * i) & 15, source = (reg + 1) & 15,
                      vector = (reg + 2 + base % 2) & 15;
            const int index = shape == RMV ? vector : vector == X86_RSP ? X86_R12 : vector;
            const struct x86_operand rm = shape == RMV || i != 1
                                              ? x86_at_index(base, index, (unsigned)(base + i) % 4, offset)
                                              : x86_at(base, offset);
            add(instruction, flags, reg, source, rm, immediate_of(shape, base + i));
        }
    }
    if (shape != RMV) {
        add(instruction, flags, 9, 10, x86_at(X86_RBP, 0), immediate_of(shape, 1));
        add(instruction, flags, 1, 2, x86_at(X86_R13, 0), immediate_of(shape, 2));
        add(instruction, flags, 9, 10, shader_pool_splat(&encoder, instruction), immediate_of(shape, 1));
        add(instruction, flags, 1, 2, shader_pool_splat(&encoder, instruction), immediate_of(shape, 2));
    }
}

static void add_all(unsigned instruction)
{
    const enum width width = specials[instruction].width;
    const unsigned flag = instructions[instruction].is_vex ? X86_NARROW : X86_WIDE;
    for (int i = 0; i < 2; i++) {
        const unsigned flags = i == 0 ? 0 : flag;
        if (width == (i == 0 ? ALONE : flag == X86_NARROW ? NARROW : WIDE) || width == BOTH) {
            if (!specials[instruction].no_register) {
                add_registers(instruction, flags);
            }
            if (!specials[instruction].no_memory && instructions[instruction].shape != O) {
                add_memory(instruction, flags);
            }
            if (instruction == X86_XADD || instruction == X86_CMPXCHG) {
                add(instruction, flags | X86_LOCK, X86_R9, 0, x86_at(X86_RDI, 8), 0);
            }
        }
    }
}

// Add what is no row of the table. Jumps go to the first slot, and behind the last one.
static void add_others(void)
{
    static const uint64_t numbers[] = {0, 5, UINT32_MAX, 1ull << 32, UINT64_MAX};
    static const char *const conditions[] = {"o", "no", "b", "ae", "e", "ne", "be", "a",
                                             "s", "ns", "p", "np", "l", "ge", "le", "g"};
    const uint32_t first = 0, last = shader_label_new(&encoder);
    for (int i = 0; i < 10; i++) {
        const int reg = (3 * i + 1) & 15;
        char name[8];
        snprintf(lines[line_count], LINE, "%s %s, %llu", numbers[i / 2] > UINT32_MAX ? "movabs" : "mov",
                 register_name(numbers[i / 2] > UINT32_MAX ? 'q' : 'd', reg, name),
                 (unsigned long long)numbers[i / 2]);
        begin_slot();
        shader_encode_number(&encoder, reg, numbers[i / 2]);
        end_slot();
    }
    for (unsigned i = 0; i < 16; i++) {
        snprintf(lines[line_count], LINE, "j%s %s", conditions[i], i % 2 ? "first" : "last");
        begin_slot();
        shader_encode_jump_if(&encoder, (enum x86_condition)i, i % 2 ? first : last);
        end_slot();
    }
    const uint32_t here = shader_label_new(&encoder);
    shader_encode_alignment(&encoder, SLOT);
    shader_label_place(&encoder, here);
    snprintf(lines[line_count], LINE, "here: jne here");
    begin_slot();
    shader_encode_jump_if(&encoder, X86_NOT_EQUAL, here);
    end_slot();
    snprintf(lines[line_count], LINE, "jmp here");
    begin_slot();
    shader_encode_jump(&encoder, here);
    end_slot();
    snprintf(lines[line_count], LINE, "jmp last");
    begin_slot();
    shader_encode_jump(&encoder, last);
    end_slot();
    snprintf(lines[line_count], LINE, "vzeroupper");
    begin_slot();
    shader_encode_vzeroupper(&encoder);
    end_slot();
    snprintf(lines[line_count], LINE, "ret");
    begin_slot();
    shader_encode_return(&encoder);
    end_slot();
    // Too far for a jump of two bytes, which the encoder does not take forward.
    for (int i = 0; i < 128 / SLOT; i++) {
        begin_slot();
        shader_encode_return(&encoder);
        snprintf(lines[line_count], LINE, "ret");
        end_slot();
    }
    shader_encode_alignment(&encoder, SLOT);
    shader_label_place(&encoder, last);
    shader_encoder_finish(&encoder);
}

__attribute__((noinline)) static void add_everything(void)
{
    shader_encoder_init(&encoder, &memory);
    shader_label_place(&encoder, shader_label_new(&encoder));
    line_count = 0;
    for (unsigned i = 0; i < X86_INSTRUCTIONS; i++) {
        add_all(i);
    }
    add_others();
}

// The assembler --------------------------------------------------------------------------------------

static char folder[] = "/tmp/rhw_encoder_XXXXXX";

static bool run(const char *format)
{
    char command[256];
    snprintf(command, sizeof command, format, folder, folder, folder);
    return system(command) == 0;
}

static void write_text(void)
{
    char path[64];
    snprintf(path, sizeof path, "%s/t.s", folder);
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, ".intel_syntax noprefix\n.text\nfirst:\n");
    for (int i = 0; i < line_count; i++) {
        fprintf(file, "%s\n.balign 16, 0xcc\n", lines[i]);
    }
    fprintf(file, "last:\n.balign 32, 0xcc\npool:\n.skip %d\n", 32 * X86_INSTRUCTIONS);
    assert_int_equal(fclose(file), 0);
}

static void compare(void)
{
    char path[64];
    snprintf(path, sizeof path, "%s/t.bin", folder);
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    int failed = 0;
    for (int i = 0; i < line_count; i++) {
        uint8_t slot[SLOT];
        assert_int_equal(fread(slot, 1, SLOT, file), SLOT);
        const uint8_t *const own = encoder.bytes + (size_t)i * SLOT;
        const int length = lengths[i];
        if (memcmp(own, slot, (size_t)length) != 0 || slot[length] != 0xcc) {
            print_error("%s\n  encoder  ", lines[i]);
            for (int b = 0; b < SLOT - 1; b++) {
                print_error(b < length ? " %02x" : "", own[b]);
            }
            print_error("\n  assembler");
            for (int b = 0; b < SLOT - 1; b++) {
                print_error(" %02x", slot[b]);
            }
            print_error("\n");
            failed++;
        }
    }
    fclose(file);
    if (failed > 0) {
        fail_msg("%d of %d instructions differ", failed, line_count);
    }
}

static void test_instructions_are_those_of_the_assembler(void **state)
{
    (void)state;
    if (!run("echo vzeroupper | as --64 -o %s/t.o - 2>/dev/null")) {
        print_message("there is no assembler for x86-64 here\n");
        skip();
    }
    shader_memory_init(&memory, (size_t)1 << 26);
    if (setjmp(memory.end) != 0) {
        fail_msg("%s", memory.message);
    }
    add_everything();
    write_text();
    assert_true(run("as --64 -o %s/t.o %s/t.s"));
    assert_true(run("objcopy -O binary -j .text %s/t.o %s/t.bin"));
    compare();
    shader_memory_free(&memory);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) == NULL ? -1 : 0;
}

static int remove_folder(void **state)
{
    (void)state;
    return run("rm -rf %s") ? 0 : -1;
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_instructions_are_those_of_the_assembler),
};

const struct unit_tests test_encoder = UNIT_TESTS(tests, make_folder, remove_folder);
