// SPDX-License-Identifier: MIT
// One stage while its code is generated, and what the files of the generator share.
//
// Code runs through the groups of a call, one after the other. Vector registers cache values; each value has a home, 32
// bytes of the stack frame or where the library put it. Integer registers:
//     rbx  the group, a struct rhw_vertex, rhw_fragment or rhw_invocations
//     r12  its inputs: attributes or varyings        r13  its outputs: varyings or colours
//     r14  struct rhw_workgroup                       r15  the group's record: what goes from run to run
//     rsp  struct shader_machine_frame, and homes behind it       rbp  the frame of the caller
#ifndef SHADER_GENERATOR_H
#define SHADER_GENERATOR_H

#include "calls.h"
#include "encoder.h"
#include "form/walk.h"
#include "form/group_samples.h"

enum { VECTOR = 32, REGISTERS = 16, NO_COMPONENT = 0xff, SHADER_ROUNDS_A_QUESTION = 256 };

// What lies at rsp.
struct shader_machine_frame {
    const struct rhw_shader_frame *bound;
    struct shader_together together;
    uint32_t count;  // groups of the call that are left
    uint32_t batch;  // as many groups go through the code together at most
    uint32_t left;   // groups of a run that are left; of a list: the number of the entry
    uint32_t rounds; // rounds of loops until the next question
    struct shader_request request;
};

// What home a value has.
enum shader_home_kind {
    SHADER_HOMELESS, // it gets one when it needs it
    SHADER_IN_FRAME,
    SHADER_IN_WINDOW, // in the frame too, for good
    SHADER_IN_RECORD,
    SHADER_IN_GROUP,
    SHADER_IN_INPUTS,
    SHADER_IN_POOL // a constant
};

struct shader_machine_value {
    int8_t reg;        // the register that has it, or −1
    uint8_t home;      // enum shader_home_kind
    bool is_stored;    // the home has what the register has
    bool is_kept;      // its home lies in the record
    uint32_t offset;   // place of the home
    uint32_t end;      // the last place that may read it; UINT32_MAX: some place of the next run or group
    uint32_t use;      // entry of its uses that comes next
    uint32_t next_end; // the next value with this end, counted from 1
};

// Homes in the frame that nobody has.
struct shader_free_list {
    uint32_t *offsets;
    size_t room, count;
};

// A place that jumps go to: what all that come there have in registers.
struct shader_edge {
    uint32_t label;
    bool is_used;
    uint32_t holds[REGISTERS];
};

// A loop over groups: what its code does without.
struct shader_groups {
    uint32_t again; // the label that it goes back to
    bool is_plain;  // it makes no call, so that integer registers stay
    bool is_bare;   // it needs the record of a group alone
    uint32_t lists; // the list that it writes, or 0
};

// Where the library has what a stage works on, in a group.
struct shader_layout {
    int32_t size, mask, inputs, outputs;
};

struct shader_generator {
    struct shader_memory *memory;
    struct shader_encoder code;
    const struct shader_linked_stage *stage;
    enum rhw_shader_stage kind;
    const struct shader_program *form;
    struct shader_plan plan;
    // Values: the nodes, and behind them masks.
    struct shader_machine_value *values;
    size_t value_room;
    uint32_t value_count;
    uint32_t *first_use, *uses;            // by node: where its uses begin; places
    uint32_t *first_end;                   // by place: the first value that ends there, counted from 1
    uint32_t holds[REGISTERS];             // values; SHADER_NONE: none
    uint32_t allowed, locked;              // sets of registers
    uint32_t place;                        // where the node stands whose code is written
    bool is_once;                          // code that runs once a call is written
    struct shader_free_list homes, blocks; // homes of one vector, and of 4
    uint32_t frame_size, record_size;      // bytes
    uint32_t own;                          // offset of the lanes' memory, in the frame or record
    // Structure
    struct shader_walk walk;
    uint32_t mask, alive;        // values: active lanes, and those that have not left
    uint32_t block_mask;         // the mask with which the block began
    uint32_t run_mask;           // the mask with which the run began
    uint32_t inside;             // mask of the wide IF behind the run, if that computes it; or SHADER_NONE
    uint32_t divergence;         // structures around this place whose lanes go different ways
    uint32_t loop_depth;         // loops of the run around this place
    bool is_dead;                // no lane comes to this place
    bool is_gone;                // code does not come to this place
    struct shader_edge *loop;    // the begin of the innermost loop of the run, or NULL
    struct shader_groups groups; // the loop over groups around this place
    uint32_t list; // the groups that code goes through: an offset in the frame, or 0, all of them
    uint32_t *lists,
        list_depth;         // by wide IFs around whose lanes part: the list of one; and the number of these
    uint32_t group_pointer; // place of a pointer to the group in its record
    uint32_t exit;          // label of the end of the function
    struct shader_edge *group_begin, *group_end; // where the code of a group begins and ends
    struct shader_edge **ends;                   // by place of structure: where it ends
    uint32_t *left;   // by place of structure: the lanes that have left, or those that were alive before
    bool has_records; // r15 is the group's
    struct shader_group_sample samples[SHADER_MAX_GROUP_SAMPLES];
    uint32_t sample_count, table;      // the table of their bindings is an offset in the frame
    struct shader_machine_pair *pairs; // textures and samplers that are put together once a call
    size_t pair_room;
    uint32_t pair_count;
};

struct shader_machine_pair {
    uint32_t texture, sampler, offset;
};

// lifetimes.c --------------------------------------------------------------------------------------

// Find where each value is read, and where it ends.
void shader_find_lifetimes(struct shader_generator *g);

// registers.c --------------------------------------------------------------------------------------

void shader_registers_init(struct shader_generator *g);
uint32_t shader_new_value(struct shader_generator *g);
// A mask is not needed any more.
void shader_drop_value(struct shader_generator *g, uint32_t value);
// Take bytes of the frame or of the record for good. Return the offset.
uint32_t shader_take_frame(struct shader_generator *g, uint32_t size);
uint32_t shader_take_record(struct shader_generator *g, uint32_t size);
// Give a SAMPLE its home of 4 vectors.
void shader_take_block(struct shader_generator *g, uint32_t value);
struct x86_operand shader_home_of(struct shader_generator *g, uint32_t value);
// A register, locked until shader_unlock, that has nothing in it.
int shader_temporary(struct shader_generator *g);
// A register that has the value, locked until shader_unlock.
int shader_in_register(struct shader_generator *g, uint32_t value);
// The value in a register or at its home.
struct x86_operand shader_anywhere(struct shader_generator *g, uint32_t value);
// Nobody reads the operands of this node any more that end with it: their registers are free for its result.
void shader_end_operands(struct shader_generator *g);
// A register for what a node gives.
int shader_result(struct shader_generator *g, uint32_t value);
// A register has a value from now on.
void shader_assign(struct shader_generator *g, uint32_t value, int reg);
void shader_unlock(struct shader_generator *g);
// The node at the place is done: values that end here are gone.
void shader_end_place(struct shader_generator *g);
// Write to their homes what lives at a place or behind, and is in registers alone.
void shader_flush(struct shader_generator *g, uint32_t place);
void shader_forget_registers(struct shader_generator *g);
struct shader_edge *shader_new_edge(struct shader_generator *g);
void shader_edge_jump(struct shader_generator *g, struct shader_edge *edge, uint32_t place);
void shader_edge_jump_if(struct shader_generator *g, enum x86_condition condition, struct shader_edge *edge,
                         uint32_t place);
// Code goes on here from all that jump to the edge, and from before unless that is dead.
void shader_edge_place(struct shader_generator *g, struct shader_edge *edge, uint32_t place, bool is_dead);
// A loop begins, or goes back to its begin by a jump that follows. It ends at a place.
void shader_loop_begin(struct shader_generator *g, struct shader_edge *edge, uint32_t end);
void shader_loop_again(struct shader_generator *g, struct shader_edge *edge);

// select.c -------------------------------------------------------------------------------------------

static inline void shader_put(struct shader_generator *g, unsigned instruction, int reg, int source,
                              struct x86_operand rm)
{
    shader_encode(&g->code, instruction, reg, source, rm, 0);
}

// Write arithmetic. Return false where the node is something else.
bool shader_select_arithmetic(struct shader_generator *g, uint32_t value);
// Return true for arithmetic that is one fast instruction.
bool shader_is_instruction(const struct shader_generator *g, uint32_t value);
// Return true for what makes no call and needs the record of its group alone, but for its operands.
bool shader_is_bare(const struct shader_generator *g, uint32_t value);

// Load the words at rax + 4 × index, of lanes that are in a mask, which is lost. Others get 0.
static inline void shader_put_gather(struct shader_generator *g, int result, int index, int mask)
{
    shader_put(g, X86_VXORPS, result, result, x86_reg(result));
    shader_put(g, X86_VGATHERDPS, result, mask, x86_at_index(X86_RAX, index, 2, 0));
}

// machine.c: the function that an operation calls, an enum shader_op or shader_call. NULL: there is none.
shader_call_function *shader_machine_function(unsigned which);

// invoke.c -------------------------------------------------------------------------------------------

// What an integer register receives.
struct shader_argument {
    enum {
        SHADER_BY_NUMBER,
        SHADER_BY_ADDRESS,
        SHADER_BY_WORD,
        SHADER_BY_POINTER
    } kind; // what an operand is or has
    uint64_t number;
    struct x86_operand at;
};

enum { SHADER_MAX_ARGUMENTS = 6, SHADER_MAX_VECTORS = 7 };

struct shader_invocation {
    unsigned which; // enum shader_op or shader_call
    int argument_count, vector_count;
    struct shader_argument arguments[SHADER_MAX_ARGUMENTS];
    uint32_t vectors[SHADER_MAX_VECTORS]; // values
    uint32_t result;                      // SHADER_NONE: none, or it is in eax
};

void shader_invoke(struct shader_generator *g, const struct shader_invocation *invocation);
// Call a function that takes no vectors and returns none.
void shader_invoke_plain(struct shader_generator *g, unsigned which, int argument_count,
                         const struct shader_argument *arguments);
// Call where code seldom comes: `reg` receives the result, and other registers stay as they are.
void shader_invoke_aside(struct shader_generator *g, const struct shader_invocation *invocation, int reg);
struct shader_argument shader_number_argument(uint64_t number);
struct shader_argument shader_address_argument(struct x86_operand at);
struct shader_argument shader_pointer_argument(struct x86_operand at);
struct shader_argument shader_bound_argument(void);

// memory.c, image.c ----------------------------------------------------------------------------------

bool shader_select_input(struct shader_generator *g, uint32_t value);
bool shader_select_memory(struct shader_generator *g, uint32_t value);
bool shader_select_image(struct shader_generator *g, uint32_t value);
bool shader_is_one(const struct shader_generator *g, uint32_t buffer);
// The binding that all lanes name, as an argument, or NULL.
struct shader_argument shader_found_argument(struct shader_generator *g, uint32_t buffer);
struct shader_argument shader_site_argument(struct shader_generator *g, uint32_t texture, uint32_t sampler,
                                            uint32_t flags, uint32_t width);
// Set eax to the number of the word at an offset of bytes. Return true where it is known, in *index.
bool shader_put_index(struct shader_generator *g, uint32_t offset, uint32_t more, uint32_t *index);
// The numbers of the lanes as an operand.
struct x86_operand shader_lane_numbers(struct shader_generator *g);
// Give a value of its own to the number of the word that each lane names.
uint32_t shader_index_of(struct shader_generator *g, uint32_t offset, uint32_t more);
// A value is what eax has, in all lanes.
void shader_spread(struct shader_generator *g, uint32_t value);
uint32_t shader_element_of(const struct shader_generator *g, uint32_t buffer);
// own_memory.c: load and store words of the lanes, and load constants of tables.
void shader_load_own(struct shader_generator *g, uint32_t value);
void shader_store_own(struct shader_generator *g, const struct shader_node *node);
// Put textures and samplers together, once a call.
void shader_pair_once(struct shader_generator *g);

// Return the sampler of a SAMPLE or IMAGE_STORE, or SHADER_NONE.
uint32_t shader_sampler_of(const struct shader_generator *g, const struct shader_node *node,
                           const uint32_t *operands);
// Return true if all lanes name one texture and one sampler.
bool shader_is_one_image(const struct shader_generator *g, uint32_t texture, uint32_t sampler);
// The binding that all lanes name, as an argument.
struct shader_argument shader_one_image(struct shader_generator *g, uint32_t texture, uint32_t sampler);

// group_samples.c ------------------------------------------------------------------------------------

// Find samples that are done for all groups, and give them places in the records.
void shader_take_group_samples(struct shader_generator *g);
// Put their bindings into a table, once a call.
void shader_list_group_samples(struct shader_generator *g);
// Sample for all groups that go through the code together.
void shader_sample_groups(struct shader_generator *g);

// flow.c ---------------------------------------------------------------------------------------------

void shader_generate_node(struct shader_generator *g, uint32_t place);
// Functions of struct shader_walk, for narrow structure.
void shader_generate_structure(void *user, uint32_t place);
void shader_skip_rest(void *user, uint32_t structure);
// Set the flag of zero where a mask has no lane.
void shader_test_mask(struct shader_generator *g, uint32_t mask);
// Return a new mask of the lanes of `mask` that are in another value too, or that are not.
uint32_t shader_and_mask(struct shader_generator *g, uint32_t mask, uint32_t other, bool is_not);
// Where a loop has gone round often, leave the function if the work is given up.
void shader_generate_giving_up(struct shader_generator *g, const struct shader_edge *edge);
// Set flags by a truth that all lanes of the call share: zero where it is false.
void shader_test_alike(struct shader_generator *g, uint32_t truth);

// wide.c ---------------------------------------------------------------------------------------------

// Write the whole code, loops over groups with it.
void shader_generate_code(struct shader_generator *g);

// groups.c -------------------------------------------------------------------------------------------

// Begin and end a loop over the groups that go through the code together, or over those of the list that was entered.
void shader_open_groups(struct shader_generator *g, const struct shader_groups *groups);
void shader_close_groups(struct shader_generator *g);
// Return the list of an IF that begins here: an offset in the frame, where the number of entries stands before them.
uint32_t shader_next_list(struct shader_generator *g);
uint32_t shader_list_of_all(struct shader_generator *g);
// In a loop that writes a list: put the group there if it has a lane in a mask, which is in a register, or in any case
// if that is −1. Nobody can tell before which groups have one, so there is no jump.
void shader_list_group(struct shader_generator *g, int mask);
// Set the flag of zero where the list that was written has no group.
void shader_test_list(struct shader_generator *g);
// What follows goes through the groups of the list that was written, until that is left.
void shader_enter_list(struct shader_generator *g);
void shader_leave_list(struct shader_generator *g);
// Compute one function for all groups.
void shader_call_for_groups(struct shader_generator *g, uint32_t value);
// Let registers point to the first group of the list that was written.
void shader_put_first_listed(struct shader_generator *g);

// stage.c --------------------------------------------------------------------------------------------

const struct shader_layout *shader_layout_of(const struct shader_generator *g);
// Set the memory of the lanes of a group to 0.
void shader_clear_own(struct shader_generator *g);

struct shader_generated {
    struct shader_encoder code;
    size_t entry; // where the function begins
};

// Generate the code of a stage, by the first so many registers, at most 16. Return false where it needs more of the
// stack than it may take.
bool shader_generate(struct shader_memory *memory, const struct shader_linked_stage *stage,
                     enum rhw_shader_stage kind, int registers, bool has_records,
                     struct shader_generated *made);

// A member of struct shader_machine_frame as an operand.
#define SHADER_FRAME(member) x86_at(X86_RSP, (int32_t)offsetof(struct shader_machine_frame, member))

#endif
