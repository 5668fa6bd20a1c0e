// SPDX-License-Identifier: MIT
// One stage while its text is written, and what the files of the emitter share.
#ifndef SHADER_C_EMIT_H
#define SHADER_C_EMIT_H

#include "form/group_samples.h"
#include "form/walk.h"
#include "c_text.h"
#include "emitter.h"

struct shader_c_pair {
    uint32_t texture, sampler; // BUFFER nodes; without a sampler a plane is found
};

struct shader_emitter {
    struct shader_memory *memory;
    const struct shader_c_program *program;
    const struct shader_linked_stage *stage;
    enum rhw_shader_stage kind;
    const struct shader_program *form;
    struct shader_plan plan;
    struct shader_walk walk;
    struct shader_text arrays; // declarations of what has an element for each group
    struct shader_text once;   // what is computed once a call
    struct shader_text body;   // what is computed for each group
    struct shader_text *out;   // the one that is written to
    bool *is_float;            // by value: it is declared as a float
    const char **inlined;      // by value: the expression that stands where the value is read, or NULL
    uint32_t mask, masks;      // number of the mask of active lanes, and how many there are
    uint32_t divergence;       // structures around this place whose lanes go different ways
    const char *group;         // the element that counts of what has one for each group
    bool is_dead;              // no lane comes to this place
    bool counts_rounds;        // rounds of loops are counted
    uint32_t run;              // number of the one that is open or comes next
    uint32_t wide_mask;        // number of the mask with which the run began
    uint32_t *loops;           // places of the LOOPs that are loops of C, from the outermost
    uint32_t loop_depth;
    bool *is_label_used; // by place of structure: something jumps to its end
    bool has_batches;    // as many groups as GROUPS go through the code together
    struct shader_group_sample samples[SHADER_MAX_GROUP_SAMPLES];
    uint32_t sample_count;
    // Textures and samplers that are put together once a call.
    struct shader_c_pair *pairs;
    size_t pair_count, pair_room;
};

// c_value.c. Find which values are declared as floats: what may be either is one if something takes it as one, or if it
// comes from one.
void shader_c_find_types(struct shader_emitter *emitter);
// Return an operand as an expression that is a name, a literal or in brackets.
const char *shader_c_operand(struct shader_emitter *emitter, uint32_t value, bool as_float);
// Return an operand as an argument of a function: of literals, 8 equal lanes.
const char *shader_c_argument(struct shader_emitter *emitter, uint32_t value, bool as_float);
// Return the name of a value that is declared.
const char *shader_c_name(struct shader_emitter *emitter, uint32_t value);
// Return a number as 8 equal lanes.
const char *shader_c_number(struct shader_emitter *emitter, uint32_t bits, bool as_float);
bool shader_c_is_number(const struct shader_emitter *emitter, uint32_t value, uint32_t *bits);
// Declare a value with an expression that is of its type.
void shader_c_define(struct shader_emitter *emitter, uint32_t value, const char *expression,
                     const char *comment);
// Write a node that is neither structure nor an access to memory or images.
void shader_c_write_value(struct shader_emitter *emitter, uint32_t place);

// c_input.c. Write an input or output. Return false where the node is neither.
bool shader_c_write_input(struct shader_emitter *emitter, uint32_t place);

// c_memory.c. Write loads, stores, atomics. Return false where the node is none of these.
bool shader_c_write_access(struct shader_emitter *emitter, uint32_t place);
// Write what is reached through a binding: begin a loop over the bindings that lanes name where they name several.
// Return the binding that is named; shader_c_end_bindings ends the loop. *lanes is the mask that counts.
const char *shader_c_begin_bindings(struct shader_emitter *emitter, uint32_t texture, uint32_t sampler,
                                    const char **lanes);
void shader_c_end_bindings(struct shader_emitter *emitter, uint32_t texture, uint32_t sampler);
// Return the name of the plane that a texture lies in, which all lanes name. It is found once a call.
const char *shader_c_plane(struct shader_emitter *emitter, uint32_t texture);
// Return true if a BUFFER is one binding for all lanes of a call.
bool shader_c_is_one_binding(const struct shader_emitter *emitter, uint32_t buffer);

// c_image.c. Write SAMPLE, PART or IMAGE_STORE. Return false where the node is none of these.
bool shader_c_write_image(struct shader_emitter *emitter, uint32_t place);

// c_group_samples.c. Find samples that are done for all groups before their code begins.
void shader_c_find_group_samples(struct shader_emitter *emitter);
// Write the table of their bindings, once a call, and room for their texels.
void shader_c_list_group_samples(struct shader_emitter *emitter);
// Write what samples for all groups that go through the code together.
void shader_c_sample_groups(const struct shader_emitter *emitter, struct shader_text *out);
// Write where a SAMPLE finds its texels. Return false where it has to wait for its group.
bool shader_c_write_group_sample(struct shader_emitter *emitter, uint32_t value);

// c_flow.c. Functions of struct shader_walk, for narrow structure.
void shader_c_write_node(void *user, uint32_t place);
void shader_c_write_structure(void *user, uint32_t place);
void shader_c_skip_rest(void *user, uint32_t structure);
uint32_t shader_c_new_mask(struct shader_emitter *emitter);
void shader_c_line_of_mask(struct shader_emitter *emitter, uint32_t mask, const char *expression);
// Jump to the end of structure, and write the label there if something does.
void shader_c_jump_to_end(struct shader_emitter *emitter, uint32_t structure);
void shader_c_write_label(struct shader_emitter *emitter, uint32_t structure);
// Leave the function where a loop has gone round often and the work is given up.
void shader_c_write_giving_up(struct shader_emitter *emitter);

// c_wide.c. Write the whole code into the body, loops over groups with it.
void shader_c_write_code(struct shader_emitter *emitter);

// c_stage.c. What stands around the code: the lines that begin and end a loop over groups.
void shader_c_open_groups(struct shader_emitter *emitter);
void shader_c_write_stage(struct shader_memory *memory, const struct shader_c_program *program,
                          enum rhw_shader_stage kind, struct shader_text *file);

#endif
