// SPDX-License-Identifier: MIT
// Every instruction of the encoder, with registers and memory of every kind, has the bytes that an assembler (binutils)
// makes of the text that is printed for it. Each lies in a slot of 16 bytes, so that one that differs moves no other.
#include "machine/encoder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "machine/print_code.h"
#include "unit.h"

enum { SLOT = 16 };
// What an instruction does not have, and what the assembler has a shorter one for.
static const struct {
    enum { BOTH, FIRST, NARROW } width; // which of the two widths of an instruction there are
    bool no_memory, no_register;
} limits[X86_INSTRUCTIONS] = {
    [X86_VGATHERDPS] = {.no_register = true},
    [X86_VMOVD] = {.width = NARROW},
    [X86_VMOVD_STORE] = {.width = NARROW},
    [X86_VMOVMSKPS] = {.no_memory = true},
    [X86_VPSLLD_I] = {.no_memory = true},
    [X86_VPSRLD_I] = {.no_memory = true},
    [X86_VPSRAD_I] = {.no_memory = true},
    [X86_VZEROUPPER] = {.width = NARROW},
    [X86_MOV_I] = {.no_register = true}, // the assembler has a shorter one
    [X86_LEA] = {.no_register = true},
    [X86_CALL] = {.width = FIRST},
    [X86_PUSH] = {.width = FIRST},
    [X86_POP] = {.width = FIRST},
    [X86_RET] = {.width = FIRST},
};

static struct shader_encoder encoder;
static struct shader_memory memory;

static enum x86_shape shape_of(unsigned instruction)
{
    return (enum x86_shape)shader_encoding_of(instruction)->shape;
}

// Fill the slot before with returns, which are not recorded.
static void begin_slot(void)
{
    encoder.has_records = false;
    while (encoder.size % SLOT != 0) {
        shader_encode(&encoder, X86_RET, 0, 0, x86_reg(0), 0);
    }
    encoder.has_records = true;
}

static void add(unsigned instruction, unsigned flags, int reg, int source, struct x86_operand rm,
                int32_t immediate)
{
    const enum x86_shape shape = shape_of(instruction);
    const bool has_digit = shape >= X86_M && shape <= X86_ML;
    begin_slot();
    shader_encode(&encoder, instruction | flags, has_digit ? 0 : reg, source, rm, immediate);
}

// All of them ----------------------------------------------------------------------------------------

static int32_t immediate_of(enum x86_shape shape, int number)
{
    switch (shape) {
    case X86_RVMR: return (number * 3 + 2) & 15;
    case X86_MI:
    case X86_VMI: return 2 + number % 29;
    case X86_MN:
    case X86_RMN: return number % 2 == 0 ? -5 - number : 70000 + number;
    case X86_ML: return number % 2 == 0 ? 5 : -70000;
    default: return number % 8;
    }
}

static void add_registers(unsigned instruction, unsigned flags)
{
    const enum x86_shape shape = shape_of(instruction);
    for (int i = 0; i < 16; i++) {
        const int rm = (5 * i + 1) & 15;
        // The assembler has a shorter form for eax.
        if (rm != X86_RAX || (shape != X86_MN && shape != X86_ML)) {
            add(instruction, flags, i, (7 * i + 3) & 15, x86_reg(rm), immediate_of(shape, i));
        }
    }
}

static void add_memory(unsigned instruction, unsigned flags)
{
    static const int32_t offsets[] = {0, 4, 127, 128, -128, -129, 1 << 20};
    const enum x86_shape shape = shape_of(instruction);
    for (int base = 0; base < 16; base++) {
        for (int i = 0; i < 3; i++) {
            const int32_t offset = offsets[(base * 3 + i) % 7];
            const int reg = (3 * base + 5 * i) & 15, source = (reg + 1) & 15,
                      other = (reg + 2 + base % 2) & 15,
                      index = other == X86_RSP && shape != X86_RXV ? X86_R12 : other;
            const struct x86_operand rm = i != 1 || shape == X86_RXV
                                              ? x86_at_index(base, index, (unsigned)(base + i) % 4, offset)
                                              : x86_at(base, offset);
            add(instruction, flags, reg, source, rm, immediate_of(shape, base + i));
        }
    }
    if (shape == X86_RXV) {
        return; // an index belongs to it
    }
    add(instruction, flags, 9, 10, x86_at(X86_RBP, 0), immediate_of(shape, 1));
    add(instruction, flags, 1, 2, x86_at(X86_R13, 0), immediate_of(shape, 2));
    add(instruction, flags, 9, 10, shader_pool_splat(&encoder, instruction), immediate_of(shape, 1));
    add(instruction, flags, 1, 2, shader_pool_splat(&encoder, instruction), immediate_of(shape, 2));
}

static void add_all(unsigned instruction)
{
    const unsigned flag = shader_encoding_of(instruction)->is_vex ? X86_NARROW : X86_WIDE;
    for (int i = 0; i < 2; i++) {
        const unsigned flags = i == 0 ? 0 : flag;
        if (limits[instruction].width != (i == 0 ? NARROW : FIRST)) {
            if (shape_of(instruction) == X86_NO_OPERANDS) {
                add(instruction, flags, 0, 0, x86_reg(0), 0);
            } else if (!limits[instruction].no_register) {
                add_registers(instruction, flags);
            }
            if (!limits[instruction].no_memory && shape_of(instruction) < X86_O) {
                add_memory(instruction, flags);
            }
        }
    }
}

// Add what is no row of the table: jumps to the first slot, to themselves, and behind the last one.
static void add_others(void)
{
    static const uint64_t numbers[] = {0, 5, UINT32_MAX, 1ull << 32, UINT64_MAX};
    const uint32_t first = 0, last = shader_label_new(&encoder), here = shader_label_new(&encoder);
    for (int i = 0; i < 10; i++) {
        begin_slot();
        shader_encode_number(&encoder, (3 * i + 1) & 15, numbers[i / 2]);
    }
    for (unsigned i = X86_ABOVE_EQUAL; i <= X86_BELOW_EQUAL; i++) {
        begin_slot();
        shader_encode_jump_if(&encoder, (enum x86_condition)i, i % 2 ? first : last);
    }
    begin_slot();
    shader_label_place(&encoder, here);
    shader_encode_jump_if(&encoder, X86_NOT_EQUAL, here);
    begin_slot();
    shader_encode_jump(&encoder, here);
    begin_slot();
    shader_encode_jump(&encoder, last);
    // Too far for a jump of two bytes, which the encoder does not take forward.
    for (int i = 0; i < 128 / SLOT; i++) {
        add(X86_RET, 0, 0, 0, x86_reg(0), 0);
    }
    begin_slot();
    shader_label_place(&encoder, last);
    shader_encoder_finish(&encoder);
}

__attribute__((noinline)) static void add_everything(void)
{
    shader_encoder_init(&encoder, &memory);
    encoder.has_records = true;
    shader_label_place(&encoder, shader_label_new(&encoder));
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

// Registers alone may be written in two ways. Return which one the encoder takes, as the assembler is told.
static const char *form_of(uint32_t instruction)
{
    if ((instruction & 0xff) >= X86_INSTRUCTIONS) {
        return "";
    }
    switch (shape_of(instruction)) {
    case X86_MR: return "{store} ";
    case X86_RM:
    case X86_RVM:
    case X86_RVMI: return "{load} ";
    default: return "";
    }
}

static void write_text(void)
{
    char path[64], text[SHADER_INSTRUCTION_TEXT];
    snprintf(path, sizeof path, "%s/t.s", folder);
    FILE *const file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, ".intel_syntax noprefix\n.text\n");
    for (uint32_t i = 0; i < encoder.record_count; i++) {
        const struct shader_record *const record = &encoder.records[i];
        shader_write_instruction(&encoder, record, text);
        fprintf(file, ".balign %d, 0xcc\n%s%s\n", SLOT, form_of(record->instruction), text);
    }
    fprintf(file, ".balign 32, 0xcc\npool:\n.skip %zu\n", encoder.size - encoder.pool);
    assert_int_equal(fclose(file), 0);
}

static void print_bytes(const char *title, const uint8_t *bytes, int length)
{
    print_error("  %-9s", title);
    for (int i = 0; i < length; i++) {
        print_error(" %02x", bytes[i]);
    }
    print_error("\n");
}

// Return whether the slot of an instruction is as the assembler fills it, which puts 0xcc where returns are.
static bool compare_slot(const struct shader_record *record, FILE *file)
{
    uint8_t slot[SLOT];
    char text[SHADER_INSTRUCTION_TEXT];
    const uint8_t *const own = encoder.bytes + record->place;
    int length = SLOT;
    assert_int_equal(fseek(file, (long)record->place, SEEK_SET), 0);
    assert_int_equal(fread(slot, 1, SLOT, file), SLOT);
    while (length > 1 && slot[length - 1] == 0xcc && own[length - 1] == 0xc3) {
        length--;
    }
    if (memcmp(own, slot, (size_t)length) == 0) {
        return true;
    }
    shader_write_instruction(&encoder, record, text);
    print_error("%s\n", text);
    print_bytes("encoder", own, SLOT);
    print_bytes("assembler", slot, SLOT);
    return false;
}

static void compare(void)
{
    char path[64];
    int count = 0, failed = 0;
    snprintf(path, sizeof path, "%s/t.bin", folder);
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    for (uint32_t i = 0; i < encoder.record_count; i++) {
        const struct shader_record *const record = &encoder.records[i];
        if (record->instruction != X86_LABEL) {
            assert_int_equal(record->place % SLOT, 0);
            failed += compare_slot(record, file) ? 0 : 1;
            count++;
        }
    }
    fclose(file);
    if (failed > 0) {
        fail_msg("%d of %d instructions differ", failed, count);
    }
    assert_in_range(count, 6000, 7500);
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

static void test_each_constant_is_there_once(void **state)
{
    (void)state;
    static const uint64_t pointer = 0x123456789abcdef0;
    shader_memory_init(&memory, (size_t)1 << 20);
    if (setjmp(memory.end) != 0) {
        fail_msg("%s", memory.message);
    }
    shader_encoder_init(&encoder, &memory);
    assert_int_equal(shader_pool_scalar(&encoder, 7).offset, 0);
    assert_int_equal(shader_pool_bytes(&encoder, &pointer, sizeof pointer).offset, 1);
    assert_int_equal(shader_pool_splat(&encoder, 7).offset, 2);
    assert_int_equal(shader_pool_scalar(&encoder, 7).offset, 0);
    assert_int_equal(shader_pool_splat(&encoder, 7).offset, 2);
    for (uint32_t i = 0; i < 1000; i++) { // many share a chain
        assert_int_equal(shader_pool_scalar(&encoder, 8 + i).offset, 3 + i);
    }
    for (uint32_t i = 0; i < 1000; i++) {
        assert_int_equal(shader_pool_scalar(&encoder, 8 + i).offset, 3 + i);
    }
    shader_encode(&encoder, X86_RET, 0, 0, x86_reg(0), 0);
    assert_int_equal(shader_encoder_finish(&encoder), 1);
    assert_int_equal(encoder.size, 32 + 32 + 8 + 4 * 1001);
    for (uint32_t i = 0; i < encoder.constant_count; i++) {
        const struct shader_pool_constant *const constant = &encoder.constants[i];
        assert_int_equal(constant->place % constant->size, 0);
        assert_memory_equal(encoder.bytes + constant->place, constant->words, constant->size);
    }
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
    cmocka_unit_test(test_each_constant_is_there_once),
};

const struct unit_tests test_encoder = UNIT_TESTS(tests, make_folder, remove_folder);
