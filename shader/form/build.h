// SPDX-License-Identifier: MIT
// What the files of the builder share: the values that ids stand for while a function is translated.
#ifndef SHADER_BUILD_H
#define SHADER_BUILD_H

#include "form.h"

// Where a pointer points to.
enum shader_place_kind {
    SHADER_PLACE_NONE,
    SHADER_PLACE_HOMES,     // a variable whose scalars are homes
    SHADER_PLACE_INPUT,     // scalars that are known values
    SHADER_PLACE_BUFFER,    // memory of a binding, or of push constants
    SHADER_PLACE_WORKGROUP, // words of the workgroup; these three have a word for each scalar
    SHADER_PLACE_PRIVATE,   // words of the lane
    SHADER_PLACE_TABLE,     // constants
    SHADER_PLACE_RESOURCE,  // an image or sampler
    SHADER_PLACE_TEXEL      // a texel of an image, for atomics
};

// An index of an access that is known when the shader runs.
struct shader_dynamic_index {
    uint32_t value;
    uint32_t count, stride; // elements that there are, and scalars of each
};

enum { SHADER_MAX_DYNAMIC = 4 };

struct shader_place {
    enum shader_place_kind kind;
    const struct shader_type *type; // what is pointed to
    // HOMES and INPUT: of the whole variable, and where the constant part of the access begins
    uint32_t *scalars;
    uint32_t scalar_count;
    uint32_t first;
    struct shader_dynamic_index dynamic[SHADER_MAX_DYNAMIC];
    uint32_t dynamic_count;
    // BUFFER, WORKGROUP, PRIVATE, TABLE and RESOURCE
    uint32_t buffer;                    // node
    uint32_t bytes;                     // constant part of the offset
    uint32_t offset;                    // value: the rest of it, or SHADER_NO_VALUE
    uint32_t strides;                   // or-ed strides of indices in `offset`
    const uint32_t *constants;          // numbers that a TABLE has
    const struct shader_member *matrix; // member whose matrices have the layout that counts here
    uint32_t row_stride;                // bytes from row to row of a column of such a matrix; 0: 4
    uint32_t resource;                  // number in the program, of what is no element yet
    bool is_array_of_resources;
    uint32_t coordinates[3]; // where a TEXEL is in its image, `buffer`
    bool is_read_only;       // nothing is stored there
};

#define SHADER_NO_VALUE UINT32_MAX

// What an id stands for.
struct shader_built {
    const struct shader_type *type; // NULL: nothing yet
    uint32_t *scalars;              // where the id is a value
    struct shader_place *place;     // where it is a pointer, image, sampler or sampled image
    struct shader_place *sampler;   // a sampled image has one too
    uint32_t *phi;                  // homes of an OpPhi
};

struct shader_construct {
    uint32_t merge;  // label that control flow goes to when it leaves
    uint32_t region; // REGION or LOOP that is left; 0: it is where control flow goes on by itself
    uint32_t fall;   // home: lanes that go to a later case of a switch; 0: it is no case
    struct shader_construct *outer;
};

// What is known of homes: the value that each holds in all active lanes. Facts of a branch end with it, so changes are
// logged.
struct shader_facts {
    uint32_t *known; // by home: a value, or SHADER_NO_VALUE
    size_t room;
    struct shader_fact_change *log;
    size_t log_count, log_room;
    uint32_t *homes; // may have a known value
    size_t home_count, home_room;
};

struct shader_fact_change {
    uint32_t home, before;
};

// The function that is being translated.
struct shader_frame {
    const struct shader_function *function;
    uint32_t region;  // what a return leaves, or 0
    uint32_t *result; // homes of what it returns
    uint32_t nesting; // where the function begins
    struct shader_frame *caller;
};

// What a variable of a function or of the module, or a parameter that points to one, is used for (usage.c).
struct shader_usage {
    bool is_indexed;   // by an index that is not constant
    bool is_changed;   // by something else than storing `constant`
    uint32_t constant; // id of the only constant that is stored to it, or 0
    uint32_t node;     // PRIVATE of the variable, or TABLE of what it holds or of the constant; 0: none yet
};

struct shader_builder {
    const struct shader_module *module;
    const struct shader_entry_point *entry;
    struct shader_program *program;
    struct shader_memory *memory;
    struct shader_built *built; // by id
    struct shader_usage *usage; // by id
    bool *is_in_interface;      // by id: the entry point names the variable
    struct shader_facts facts;
    uint32_t *label_words; // by id: the word of its OpLabel
    uint32_t *visited;     // by id of a label: number of the call that translated it
    uint32_t call, calls;  // number of the call under way, and how many there were
    uint32_t nesting;
    uint32_t effort;      // words that were looked at
    uint32_t repeated[2]; // words of rounds one behind the other, of loops without an index and with one
    uint32_t block;       // label of the block that is being translated
    uint32_t word;        // instruction that is being translated
    struct shader_frame *frame;
    struct shader_construct *constructs;
    uint32_t *output_homes; // by enum shader_output, or SHADER_NO_VALUE
    unsigned second_target; // what stands in the place of target 1 (build_interface.c)
    bool is_integer[(SHADER_OUT_COUNT - SHADER_OUT_VARYING) / 4]; // by location of outputs: whole numbers
};

// build.c ------------------------------------------------------------------------------------------

_Noreturn void shader_build_refuse(const struct shader_builder *builder, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Return the words of the instruction that is translated.
const uint32_t *shader_words(const struct shader_builder *builder);
uint32_t shader_word_count(const struct shader_builder *builder);
// Return an operand word; refuse where it is missing.
uint32_t shader_operand(const struct shader_builder *builder, uint32_t index);

// Put a node at the end of the code, and return its value. Operations on constants are folded.
uint32_t shader_emit(struct shader_builder *builder, enum shader_op op, uint32_t a, uint32_t b, uint32_t c);
uint32_t shader_emit_with(struct shader_builder *builder, enum shader_op op, uint32_t immediate, uint32_t a,
                          uint32_t b, uint32_t c);
uint32_t shader_number(struct shader_builder *builder, uint32_t bits);
uint32_t shader_number_float(struct shader_builder *builder, float value);
bool shader_is_number(const struct shader_builder *builder, uint32_t value, uint32_t *bits);

uint32_t shader_new_home(struct shader_builder *builder, uint32_t initial);
void shader_set_home(struct shader_builder *builder, uint32_t home, uint32_t value);
uint32_t shader_get_home(struct shader_builder *builder, uint32_t home);
// facts.c. Note what a home holds now.
void shader_learn(struct shader_builder *builder, uint32_t home, uint32_t value);
void shader_add_facts_of_home(struct shader_builder *builder, uint32_t home);
// Forget what every home holds: it may be set on another way to here.
void shader_forget_all(struct shader_builder *builder);
// Return to what was known when the log had `mark` entries. The entries behind stay where they are until they are
// forgotten: what changed in a branch is not known behind it.
void shader_rewind_facts(struct shader_builder *builder, size_t mark);
// Forget what changed since the log had `mark` entries.
void shader_forget_since(struct shader_builder *builder, size_t mark);

// Return the scalars of the value of an id.
const uint32_t *shader_scalars(struct shader_builder *builder, uint32_t id);
const struct shader_type *shader_type_of_value(struct shader_builder *builder, uint32_t id);
struct shader_place *shader_place_of(struct shader_builder *builder, uint32_t id);
// Give the result of the instruction its scalars, which are copied. There are as many as its type has.
void shader_define(struct shader_builder *builder, const uint32_t *scalars);
// Give the result, which is one scalar, its value.
void shader_define_scalar(struct shader_builder *builder, uint32_t scalar);
void shader_define_place(struct shader_builder *builder, const struct shader_place *place);
const struct shader_type *shader_result_type(const struct shader_builder *builder);
uint32_t *shader_new_scalars(struct shader_builder *builder, const struct shader_type *type);

// Note that `words` more words are looked at. Calls that are put in their places repeat words without end, so there is
// a bound on all of them.
void shader_spend(struct shader_builder *builder, uint32_t words);

// signature.c. Refuse the instruction if its result or an operand, of which the first stands at `first`, is not of the
// type that the letters ask for (signature.c tells which).
void shader_check_signature(struct shader_builder *builder, const char *letters, uint32_t first);
// Check the operands of an instruction whose result has a type of its own.
void shader_check_types(struct shader_builder *builder, const struct shader_type *result, const char *letters,
                        uint32_t first);
// Refuse an instruction of arithmetic whose operands are not of the types that it asks for.
void shader_check_operands(struct shader_builder *builder, uint32_t opcode);

// Return the type of a scalar, of the components of a vector or a matrix, or NULL.
const struct shader_type *shader_scalar_type(const struct shader_type *type);

// usage.c. Find what variables are used for.
void shader_find_usage(struct shader_builder *builder);

// build_flow.c. Translate a function that has its parameters. Return the homes of what it returns, or NULL.
uint32_t *shader_build_function(struct shader_builder *builder, const struct shader_function *function);
// build_arithmetic.c. Return component i of an operand; one scalar stands for all where the others are vectors.
uint32_t shader_component(struct shader_builder *builder, uint32_t operand, uint32_t i);
// build_arithmetic.c, build_matrix.c, build_composite.c, build_glsl.c, build_image.c, build_memory.c, build_narrow.c,
// build_subgroup.c. Return false where the file does not have the instruction.
bool shader_build_arithmetic(struct shader_builder *builder, uint32_t opcode);
bool shader_build_matrix(struct shader_builder *builder, uint32_t opcode);
bool shader_build_composite(struct shader_builder *builder, uint32_t opcode);
void shader_build_glsl(struct shader_builder *builder);
bool shader_build_memory(struct shader_builder *builder, uint32_t opcode);
bool shader_build_image(struct shader_builder *builder, uint32_t opcode);
bool shader_build_conversion(struct shader_builder *builder, uint32_t opcode);
// build_interpolation.c. Return false where the instruction of GLSL.std.450 is none of its.
bool shader_build_interpolation(struct shader_builder *builder, uint32_t instruction);
bool shader_build_subgroup(struct shader_builder *builder, uint32_t opcode);
// build_subgroup.c. Return a component of a built-in of subgroups, or SHADER_NO_VALUE where `number` is another one.
uint32_t shader_subgroup_built_in(struct shader_builder *builder, int number, uint32_t component);
// build_variable.c. Make the place of a variable.
void shader_build_variable(struct shader_builder *builder, const struct shader_variable *variable);
// build_chain.c. Scalars of a type in memory that has a word for each, where arrays may be larger than values.
uint64_t shader_packed_scalars(const struct shader_type *type);
bool shader_is_packed(const struct shader_place *place);
bool shader_is_in_memory(const struct shader_place *place);
// Step to an element of an array, matrix or vector, or to a member of a structure.
void shader_step(struct shader_builder *builder, struct shader_place *place, uint32_t index);
void shader_build_access_chain(struct shader_builder *builder);
// build_narrow.c. Load and store numbers of 8 and 16 bits in memory, whose offset in bytes is that of the place.
uint32_t shader_load_narrow(struct shader_builder *builder, const struct shader_place *place,
                            uint32_t offset);
void shader_store_narrow(struct shader_builder *builder, const struct shader_place *place, uint32_t offset,
                         uint32_t value);
// build_memory.c. Read and write all scalars of a place, in order.
void shader_read_place(struct shader_builder *builder, const struct shader_place *place, uint32_t *scalars);
void shader_write_place(struct shader_builder *builder, const struct shader_place *place,
                        const uint32_t *scalars);
// Store the scalars of a value of a type where an id points to.
void shader_store(struct shader_builder *builder, uint32_t pointer, const struct shader_type *type,
                  const uint32_t *scalars);
// build_interface.c. Make the place of an input or output, and write outputs at the end.
void shader_build_interface_variable(struct shader_builder *builder, const struct shader_variable *variable,
                                     struct shader_place *place);
void shader_write_outputs(struct shader_builder *builder);

#endif
