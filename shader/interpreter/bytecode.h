// SPDX-License-Identifier: MIT
// What the interpreter executes: instructions on registers, for up to 16 groups of 8 lanes at a time, so that the cost
// of finding out what to do is shared by 128 lanes.
//
// A register is a vector for each group of the batch, or one vector for all where the value is uniform. Registers lie
// behind one another in one array; an operand names the first vector, and whether there is one for each group.
#ifndef SHADER_BYTECODE_H
#define SHADER_BYTECODE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "form/linked_stage.h"

enum {
    SHADER_BATCH = 16,              // most groups at a time; a workgroup with barriers has all of its own
    SHADER_REGISTER_VECTORS = 4096, // on the stack, where they take 128 KB
    SHADER_INPUT_NUMBERS = 400,
    SHADER_NO_RESOURCE = 0xffff, // push constants
    SHADER_SHARED = 0xfffe       // the memory of the workgroup
};

struct shader_operand_of {
    uint32_t vector : 31;
    uint32_t is_uniform : 1;
};

// Instructions are those of the form, and these.
enum shader_extra_op {
    SHADER_END = 200,   // the shader ends
    SHADER_FILL,        // a register with the immediate
    SHADER_MUL_ADD,     // a · b + c, of floats and rounded twice, as a product and a sum
    SHADER_MUL_SUB,     // a · b − c
    SHADER_SUB_MUL,     // c − a · b
    SHADER_IMIN,        // the lesser of a and b, which are signed
    SHADER_IMAX,        // the greater
    SHADER_JUMP_UNLESS, // where `a`, which is uniform, is false
    SHADER_JUMP,
    SHADER_LOAD_PRIVATE,
    SHADER_STORE_PRIVATE,
    SHADER_LOAD_TABLE,
    SHADER_COUNT_OPS
};

// Arithmetic has functions for the operands that have one vector for all groups: or-ed bits.
enum shader_kind {
    SHADER_A_IS_ONE = 1,
    SHADER_B_IS_ONE = 2,
    SHADER_C_IS_ONE = 4,
    SHADER_ONCE = 8, // one vector is computed; no other bit is set
    SHADER_KINDS
};

struct shader_instruction {
    uint8_t op;
    uint8_t kind;      // enum shader_kind
    uint16_t resource; // what LOAD, STORE and LENGTH access; SHADER_NO_RESOURCE: push constants
    // The node's. Structure has the instruction to jump to, and NEEDS_GRADIENT the sampler's resource.
    uint32_t immediate;
    // Where no lane is active behind an END, it goes to c.vector if that is not 0.
    struct shader_operand_of result, a, b, c;
};

// Registers that every program has.
enum { SHADER_ACTIVE, SHADER_ALIVE, SHADER_KILLED, SHADER_FIXED_REGISTERS };

struct shader_bytecode {
    const struct shader_instruction *code;
    uint32_t code_count;
    const uint32_t *constants; // values of the first uniform registers
    uint32_t constant_count;
    uint32_t first_uniform; // vector
    uint32_t private_count; // registers behind the fixed ones that are memory of the lanes
    const uint32_t *table;  // constants that indices pick from
    uint32_t table_count;
    uint32_t batch;           // groups at a time
    uint32_t workgroup_size;  // bytes of memory that a workgroup has
    uint32_t invocation_size; // bytes of an invocation that hold its registers; 0: the stack has room for all
    const struct shader_slot *slots; // by resource; a program gives them
    uint32_t target_count;
    // Component of the program's varyings for an input's number (enum shader_input); 0xff: there is none.
    uint8_t component_of[SHADER_INPUT_NUMBERS];
    // SAMPLE and IMAGE_STORE have SHADER_IMAGE_OPERANDS of them from the number in b.vector on. c.vector is the
    // resource of the sampler.
    const struct shader_operand_of *image_operands;
    bool is_linear[SHADER_INPUT_NUMBERS]; // by the same numbers: the input is flat or noperspective
    uint8_t w_component;                  // component that holds W of the position; 0xff: there is none
};

// What the functions of a pipeline get as `user`.
struct shader_stages {
    const struct shader_bytecode *vertex, *fragment, *compute;
};

#endif
