// SPDX-License-Identifier: MIT
// Writes instructions of x86-64 with AVX2 into a buffer that grows. instruction.inc lists them; its shapes say which
// operands an instruction has. Constants lie in a pool behind the code, each once. Labels are places of the code that
// jumps go to, before or after they are placed.
#ifndef SHADER_ENCODER_H
#define SHADER_ENCODER_H

#include <stdint.h>

#include "module/memory.h"

enum x86_instruction {
#define VEX(name, prefix, map, opcode, shape, digit) X86_##name,
#define INT(name, opcode, shape, digit)              X86_##name,
#include "instruction.inc"
#undef VEX
#undef INT
    X86_INSTRUCTIONS,
    // What has a function of its own is no row of the table. Records have these numbers for it:
    X86_JUMP = X86_INSTRUCTIONS, // to the label `immediate`; reg: the condition, or -1
    X86_NUMBER,                  // reg := offset and immediate, the lower and the upper half
    X86_LABEL,                   // `immediate` is placed
    // Or-ed to an instruction:
    X86_NARROW = 1 << 8, // vectors of 128 bits
    X86_WIDE = 1 << 9    // integers of 64 bits
};

// Which operands an instruction has: see shader_encode. X86_O stands in the opcode.
enum x86_shape {
    X86_RM,
    X86_MR,
    X86_VMI, // from here to RVMR with an immediate
    X86_RMI,
    X86_RVMI, // from here to RXV with a source
    X86_RVMR,
    X86_RVM,
    X86_RXV,
    X86_M,
    X86_MI,
    X86_MN,
    X86_ML,
    X86_RMN,
    X86_O,
    X86_NO_OPERANDS
};

// A row of instruction.inc.
struct x86_encoding {
    const char *name;
    bool is_vex;
    uint8_t prefix, map, opcode, shape, digit;
};

// Integer registers. Vector registers are numbers from 0 to 15.
enum x86_register {
    X86_RAX,
    X86_RCX,
    X86_RDX,
    X86_RBX,
    X86_RSP,
    X86_RBP,
    X86_RSI,
    X86_RDI,
    X86_R8,
    X86_R9,
    X86_R10,
    X86_R11,
    X86_R12,
    X86_R13,
    X86_R14,
    X86_R15
};

enum x86_condition { X86_ABOVE_EQUAL = 3, X86_EQUAL, X86_NOT_EQUAL, X86_BELOW_EQUAL };

// Immediates of VCMPPS, which are false where an operand is no number, and signal on no quiet one.
enum x86_predicate { X86_EQ_O = 0x00, X86_LT_O = 0x11, X86_LE_O = 0x12, X86_GE_O = 0x1d };

// Immediates of VROUNDPS; 8 keeps the flag of inexact results as it is.
enum x86_rounding { X86_ROUND_EVEN = 8, X86_ROUND_DOWN = 9, X86_ROUND_UP = 10, X86_ROUND_ZERO = 11 };

// A register, or memory at base + (index << shift) + offset.
struct x86_operand {
    int8_t reg;   // -1: memory
    int8_t base;  // -1: the constant of the number `offset`
    int8_t index; // an integer register other than rsp, or a vector; -1: none
    uint8_t shift;
    int32_t offset; // bytes
};

// An instruction as it was asked for.
struct shader_record {
    uint32_t place;
    uint32_t instruction; // with its flags
    int8_t reg, source;
    struct x86_operand rm;
    int32_t immediate;
};

struct shader_encoder {
    struct shader_memory *memory;
    bool has_records; // what is appended is recorded, too, for print_code.h
    uint8_t *bytes;
    size_t size, room;
    uint32_t *labels; // places, by label; UINT32_MAX before they are known
    uint32_t label_count;
    size_t label_room;
    struct shader_fix *fixes; // displacements to fill in
    uint32_t fix_count;
    size_t fix_room;
    struct shader_pool_constant *constants;
    uint32_t constant_count;
    size_t constant_room;
    uint32_t constant_heads[256]; // chains of constants with one hash: number + 1
    uint32_t code_size, pool;     // where instructions end, and where the pool begins
    struct shader_code_mark *marks;
    uint32_t mark_count;
    size_t mark_room;
    struct shader_record *records;
    uint32_t record_count;
    size_t record_room;
};

// A constant of the pool.
struct shader_pool_constant {
    uint32_t words[8];
    uint32_t size, place, next;
};

// From `place` on, code comes from a node of the form.
struct shader_code_mark {
    uint32_t place, node;
};

static inline struct x86_operand x86_reg(int reg)
{
    return (struct x86_operand){(int8_t)reg, -1, -1, 0, 0};
}

static inline struct x86_operand x86_at(int base, int32_t offset)
{
    return (struct x86_operand){-1, (int8_t)base, -1, 0, offset};
}

static inline struct x86_operand x86_at_index(int base, int index, unsigned shift, int32_t offset)
{
    return (struct x86_operand){-1, (int8_t)base, (int8_t)index, (uint8_t)shift, offset};
}

// Begin. What the encoder takes lies in the memory, which ends the translation where it is short.
void shader_encoder_init(struct shader_encoder *encoder, struct shader_memory *memory);

const struct x86_encoding *shader_encoding_of(uint32_t instruction);

// Append an instruction, with flags or-ed to its number, by the operands of its shape:
//     RM, RMI, RMN   reg := rm, immediate                 MR            rm := reg
//     RVM, RVMI      reg := source, rm, immediate         VMI           reg := rm, immediate
//     RVMR           as RVM; the immediate is a register  M, MI, MN, ML rm := rm, immediate; reg is 0
//     RXV            as RVM, of memory whose index is a vector; the three registers differ
//     O              reg alone
// TEST, CMP and VTESTPS change flags alone. An immediate has 8 bits (I), 32 (L), or as many as it takes (N).
void shader_encode(struct shader_encoder *encoder, unsigned instruction, int reg, int source,
                   struct x86_operand rm, int32_t immediate);

// Set an integer register to a number.
void shader_encode_number(struct shader_encoder *encoder, int reg, uint64_t number);

// Make a label, place it here, and jump to it.
uint32_t shader_label_new(struct shader_encoder *encoder);
void shader_label_place(struct shader_encoder *encoder, uint32_t label);
void shader_encode_jump(struct shader_encoder *encoder, uint32_t label);
void shader_encode_jump_if(struct shader_encoder *encoder, enum x86_condition condition, uint32_t label);

// Put a constant of 4, 8 or 32 bytes into the pool, if it is not there. Return it as an operand.
struct x86_operand shader_pool_bytes(struct shader_encoder *encoder, const void *bytes, unsigned size);
// A number for VBROADCASTSS, and the number in 8 lanes.
struct x86_operand shader_pool_scalar(struct shader_encoder *encoder, uint32_t bits);
struct x86_operand shader_pool_splat(struct shader_encoder *encoder, uint32_t bits);

// Say that what is appended from here on comes from a node.
void shader_encode_mark(struct shader_encoder *encoder, uint32_t node);

// Append the pool and fill in every displacement. All labels that are jumped to have been placed. The code may then be
// moved to any multiple of 32 bytes: it refers to itself by distances alone. Return the bytes of the instructions; the
// pool follows them, and `size` is the whole.
size_t shader_encoder_finish(struct shader_encoder *encoder);

#endif
