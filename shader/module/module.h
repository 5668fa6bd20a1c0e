// SPDX-License-Identifier: MIT
// A SPIR-V module as the builder reads it: its words, what each id stands for, types with their layout, constants with
// their values after specialization, and its entry points.
//
// The reader checks the words once: every instruction is known and has the operands that its grammar asks for, every
// id is defined once and is of the kind that its user needs. What is not checked here the builder checks where it
// relies on it. A module that breaks a rule ends reading through shader_refuse.
#ifndef SHADER_MODULE_H
#define SHADER_MODULE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "memory.h"
#include "spirv.h"

enum {
    SHADER_MAX_WORDS = 1 << 22,
    SHADER_MAX_IDS = 1 << 20,
    SHADER_MAX_ENTRY_POINTS = 256,
    SHADER_MAX_SCALARS = 1 << 14,      // scalars of a type
    SHADER_MAX_TYPE_BYTES = INT32_MAX, // bytes of a type in memory
    SHADER_MAX_TYPE_DEPTH = 32,
    SHADER_MAX_INVOCATIONS = 1024, // invocations of a workgroup
    SHADER_LEAST_HALF = 0x38800000 // bits of the least positive float that is a normal half
};

enum shader_type_kind {
    SHADER_VOID,
    SHADER_BOOL,
    SHADER_INT,
    SHADER_FLOAT,
    SHADER_VECTOR,
    SHADER_MATRIX,
    SHADER_IMAGE,
    SHADER_SAMPLER,
    SHADER_SAMPLED_IMAGE,
    SHADER_ARRAY,
    SHADER_RUNTIME_ARRAY,
    SHADER_STRUCT,
    SHADER_POINTER,
    SHADER_FUNCTION
};

struct shader_image_type {
    enum spirv_dim dim;
    bool is_depth, is_arrayed, is_multisampled, is_storage;
    uint32_t format; // "Image Format" of SPIR-V; 0: unknown
};

// How a fragment shader's input comes from vertices. Without any: smooth, at the centre of the pixel.
enum shader_interpolation {
    SHADER_FLAT = 1,
    SHADER_NOPERSPECTIVE = 2,
    SHADER_AT_CENTROID = 4,
    SHADER_AT_SAMPLE = 8
};

struct shader_member {
    const struct shader_type *type;
    uint32_t first;         // scalar of the structure that is the first of the member
    uint32_t offset;        // bytes, in memory that has a layout
    uint32_t matrix_stride; // bytes; 0 where the member has no matrix
    bool is_row_major;
    int built_in; // −1: none
    int location; // −1: none
    int component;
    uint8_t interpolation; // or-ed enum shader_interpolation
};

struct shader_type {
    enum shader_type_kind kind;
    uint32_t id;
    int bits;       // INT: 8, 16 or 32. FLOAT: 16 or 32. Those below 32 are types of memory alone
    bool is_signed; // INT
    // VECTOR, MATRIX (its columns), ARRAY and RUNTIME_ARRAY, SAMPLED_IMAGE (its image), IMAGE (what sampling gives),
    // POINTER (what it points to), FUNCTION (what it returns).
    const struct shader_type *element;
    uint32_t count;  // how many elements, members or parameters
    uint32_t stride; // bytes from element to element of an array; 0: it has no layout
    const struct shader_member *members;
    const struct shader_type *const *parameters; // FUNCTION
    struct shader_image_type image;
    enum spirv_storage_class storage; // POINTER
    bool is_block, is_buffer_block;   // STRUCT
    // Scalars of 32 bits that a value of this type is made of; 0 where there are no such values.
    uint32_t scalars;
    bool is_empty; // STRUCT without members and what is made of such alone: there are values, of no scalars
    // Bytes in memory up to the last scalar, or to the begin of an array without length. Those of a matrix follow from
    // the member that it is part of (shader_member_bytes); here they are 0.
    uint32_t bytes;
    int depth; // how deep composites nest
};

struct shader_constant {
    const struct shader_type *type;
    const uint32_t *scalars;
    bool is_undefined;
};

struct shader_variable {
    const struct shader_type *type; // what the variable holds, not the pointer
    enum spirv_storage_class storage;
    const struct shader_constant *initial; // NULL: none
    uint32_t id;
    int set, binding;                                           // −1: none
    int location, component, index, built_in, input_attachment; // −1: none
    uint8_t interpolation;                                      // or-ed enum shader_interpolation
    bool is_not_readable, is_not_writable;
};

struct shader_function {
    uint32_t id;
    uint32_t word, end; // where its OpFunction is, and behind its OpFunctionEnd
    const struct shader_type *type;
};

// What an id stands for.
struct shader_id {
    uint32_t word; // its instruction; 0: the id is not defined
    uint32_t type; // id of the type of its value; 0: it has none
    uint16_t opcode;
    uint32_t decorations; // first of the module's, counted from 1
    union {
        const struct shader_type *as_type;
        const struct shader_constant *as_constant;
        struct shader_variable *as_variable;
        const struct shader_function *as_function;
    } data;
};

struct shader_decoration {
    uint32_t next;   // counted from 1
    uint32_t word;   // its instruction
    uint32_t number; // enum spirv_decoration
    int member;      // −1: of the whole
    uint32_t value;  // its first literal, or 0
};

struct shader_entry_point {
    enum spirv_execution_model model;
    uint32_t function, word;
    const char *name;
    const uint32_t *interface;
    uint32_t interface_count;
    uint32_t local_size[3];
    uint32_t size_word; // word of an OpExecutionModeId that gives the size; 0: there is none
    bool has_early_tests, replaces_depth;
    int depth_change; // 1: greater, −1: less, 0: any
};

struct shader_module {
    struct shader_memory *memory;
    const uint32_t *words;
    uint32_t word_count, bound;
    struct shader_id *ids;
    struct shader_decoration *decorations;
    uint32_t decoration_count;
    struct shader_entry_point *entry_points;
    uint32_t entry_point_count;
    struct shader_variable **variables; // the module's, without those of functions
    uint32_t variable_count;
    struct shader_function *functions;
    uint32_t function_count;
    const char **names;      // by id, or NULL where OpName gives none
    uint32_t glsl_import;    // id of GLSL.std.450, or 0
    uint32_t workgroup_size; // id of the constant that is WorkgroupSize, or 0
    // Where reading stands, for messages.
    uint32_t at;
};

struct shader_specialization {
    uint32_t constant_id, value;
};

// Read a module. `words` must stay; they are in the order of bytes of this machine. The memory owns what is made, and
// takes the message where reading ends early.
struct shader_module *shader_module_read(struct shader_memory *memory, const uint32_t *words,
                                         size_t word_count,
                                         const struct shader_specialization *specialization, size_t count);

// Return the name of an instruction, or "an unknown instruction".
const char *shader_instruction_name(uint32_t opcode);
// Return the operands of an instruction by the letters of script/spirv-grammar, or NULL where it is not known.
const char *shader_instruction_operands(uint32_t opcode);

// End reading: the instruction at `word` breaks a rule.
_Noreturn void shader_refuse(const struct shader_module *module, uint32_t word, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Return the type, constant or variable that an id stands for. `word` is the instruction that uses it.
const struct shader_type *shader_type_of_id(const struct shader_module *module, uint32_t word, uint32_t id);
const struct shader_constant *shader_constant_of_id(const struct shader_module *module, uint32_t word,
                                                    uint32_t id);
// Return the type of the value that an id stands for.
const struct shader_type *shader_value_type(const struct shader_module *module, uint32_t word, uint32_t id);
// Return the decoration of an id or of its member (−1: of the whole), or NULL.
const struct shader_decoration *shader_find_decoration(const struct shader_module *module, uint32_t id,
                                                       int member, enum spirv_decoration number);

// What the files of the reader share -----------------------------------------------------------------

// module_instruction.c. Refuse the instruction at `word` if its words are not those that the letters ask for.
void shader_check_words(const struct shader_module *module, uint32_t word, const char *operands);
// module_type.c. Make the type that the instruction at `word` declares.
void shader_read_type(struct shader_module *module, uint32_t word);
// Return the bytes of a member in memory up to its last scalar.
uint64_t shader_member_bytes(const struct shader_member *member);
// module_constant.c. Make the constant that the instruction at `word` declares.
void shader_read_constant(struct shader_module *module, uint32_t word,
                          const struct shader_specialization *specialization, size_t count);
// module_variable.c. Make the variable that the instruction at `word` declares.
struct shader_variable *shader_read_variable(struct shader_module *module, uint32_t word);
// module_entry.c
void shader_read_entry_point(struct shader_module *module, uint32_t word);
void shader_read_execution_mode(struct shader_module *module, uint32_t word);
// Give the compute entry points their sizes, when all constants are known.
void shader_settle_sizes(const struct shader_module *module);

// module_number.c. The 32 bits that stand for a number of a type: those of an integer of 8 or 16 bits are extended, by
// its sign where it has one, and a float of 16 bits is the float of 32 bits that equals it.
uint32_t shader_extend(const struct shader_type *type, uint32_t bits);
uint32_t shader_half_from_float(uint32_t bits); // rounded to nearest even
uint32_t shader_float_from_half(uint32_t bits);

#endif
