// SPDX-License-Identifier: MIT
// See assemble.h.
//
// Registers are given out in the order of the code: a value has one in its live range (live_range.h).
#include "assemble.h"

#include "live_range.h"
#include "pairs.h"

#define NONE SHADER_NEVER

struct assembler {
    struct shader_program *program;
    struct shader_bytecode *bytecode;
    const struct shader_live_range *ranges; // by value
    uint32_t *registers;                    // by value
    uint32_t *mask_registers;               // by value: the second register of REGION and LOOP
    struct shader_pairs pairs;
    struct shader_instruction *code;
    uint32_t count;
    size_t room;
    struct shader_operand_of *image_operands;
    uint32_t image_operand_count;
    size_t image_operand_room;
};

// Registers ------------------------------------------------------------------------------------------

struct free_registers {
    uint32_t *numbers;
    uint32_t count, next; // length of `numbers`, and the first register that was never given out
};

static uint32_t take_register(struct free_registers *registers)
{
    return registers->count > 0 ? registers->numbers[--registers->count] : registers->next++;
}

static bool is_placed(const struct shader_node *node)
{
    return node->op != SHADER_CONSTANT && node->op != SHADER_PRIVATE && node->op != SHADER_TABLE;
}

// Values whose range ends at each place, as lists.
struct endings {
    uint32_t *first, *next; // by place, by value; counted from 1
};

// Decide how many groups go through the shader at a time. Groups of a workgroup with barriers go together. Where the
// stack has no room for their registers, the library gives memory for each invocation.
static void settle_batch(struct assembler *assembler, uint32_t varying, uint32_t uniform)
{
    const struct shader_program *const program = assembler->program;
    struct shader_bytecode *const bytecode = assembler->bytecode;
    const uint32_t *const size = program->entry->local_size;
    const uint32_t groups = (size[0] * size[1] * size[2] + 7) / 8;
    const uint32_t vectors = varying * groups + uniform;
    if (program->has_barriers && vectors > SHADER_REGISTER_VECTORS) {
        bytecode->batch = groups;
        bytecode->invocation_size = (vectors + groups - 1) / groups * (uint32_t)sizeof(uint32_t);
        if (bytecode->invocation_size > RHW_MAX_INVOCATION_SIZE) {
            shader_refuse(program->module, program->entry->word,
                          "an invocation keeps %u bytes from barrier to barrier: more than %d",
                          (unsigned)bytecode->invocation_size, RHW_MAX_INVOCATION_SIZE);
        }
    } else if (varying + uniform > SHADER_REGISTER_VECTORS) {
        shader_refuse(program->module, program->entry->word, "the shader keeps more than %d values at a time",
                      SHADER_REGISTER_VECTORS);
    } else {
        const uint32_t most = program->has_barriers && groups > SHADER_BATCH ? groups : SHADER_BATCH;
        const uint32_t room = (SHADER_REGISTER_VECTORS - uniform) / varying;
        bytecode->batch = room < most ? room : most;
    }
    bytecode->workgroup_size = program->workgroup_size;
    bytecode->first_uniform = varying * bytecode->batch;
}

static void give_registers(struct assembler *assembler)
{
    const struct shader_program *const program = assembler->program;
    struct shader_memory *const memory = program->memory;
    const uint32_t places = program->code_count + 1, nodes = program->node_count;
    struct endings begins = {shader_take(memory, places, sizeof(uint32_t)),
                             shader_take(memory, nodes, sizeof(uint32_t))};
    struct endings ends = {shader_take(memory, places, sizeof(uint32_t)),
                           shader_take(memory, nodes, sizeof(uint32_t))};
    struct free_registers varying = {shader_take(memory, 2 * nodes, sizeof(uint32_t)), 0,
                                     SHADER_FIXED_REGISTERS + program->private_count};
    struct free_registers uniform = {shader_take(memory, nodes, sizeof(uint32_t)), 0,
                                     assembler->bytecode->constant_count};
    for (uint32_t value = nodes; value-- > 0;) {
        const struct shader_live_range *const range = &assembler->ranges[value];
        if (range->end != NONE && is_placed(&program->nodes[value])) {
            begins.next[value] = begins.first[range->begin];
            begins.first[range->begin] = value + 1;
            ends.next[value] = ends.first[range->end];
            ends.first[range->end] = value + 1;
        }
    }
    for (uint32_t i = 0; i < program->code_count; i++) {
        // A result never shares a register with an operand of the same instruction: some are read while it is written.
        for (uint32_t v = begins.first[i]; v != 0; v = begins.next[v - 1]) {
            const struct shader_node *const node = &program->nodes[v - 1];
            const bool is_mask =
                node->op == SHADER_IF || node->op == SHADER_REGION || node->op == SHADER_LOOP;
            const bool is_uniform = (node->flags & SHADER_DYNAMICALLY_UNIFORM) && !is_mask;
            assembler->registers[v - 1] = take_register(is_uniform ? &uniform : &varying);
            if (node->op == SHADER_REGION || node->op == SHADER_LOOP) {
                assembler->mask_registers[v - 1] = take_register(&varying);
            }
        }
        for (uint32_t v = ends.first[i]; v != 0; v = ends.next[v - 1]) {
            const struct shader_node *const node = &program->nodes[v - 1];
            const bool is_mask =
                node->op == SHADER_IF || node->op == SHADER_REGION || node->op == SHADER_LOOP;
            struct free_registers *const registers =
                (node->flags & SHADER_DYNAMICALLY_UNIFORM) && !is_mask ? &uniform : &varying;
            registers->numbers[registers->count++] = assembler->registers[v - 1];
            if (node->op == SHADER_REGION || node->op == SHADER_LOOP) {
                varying.numbers[varying.count++] = assembler->mask_registers[v - 1];
            }
        }
    }
    settle_batch(assembler, varying.next, uniform.next);
}

// Instructions ---------------------------------------------------------------------------------------

static struct shader_operand_of varying_register(const struct assembler *assembler, uint32_t number)
{
    return (struct shader_operand_of){.vector = (number * assembler->bytecode->batch) & 0x7fffffff,
                                      .is_uniform = 0};
}

static struct shader_operand_of operand_of(const struct assembler *assembler, uint32_t value)
{
    const struct shader_node *const node = &assembler->program->nodes[value];
    if ((node->flags & SHADER_DYNAMICALLY_UNIFORM) == 0) {
        return varying_register(assembler, assembler->registers[value]);
    }
    return (struct shader_operand_of){
        .vector = (assembler->bytecode->first_uniform + assembler->registers[value]) & 0x7fffffff,
        .is_uniform = 1};
}

static struct shader_instruction *add(struct assembler *assembler, uint32_t op)
{
    if (assembler->count == assembler->room) {
        assembler->code = shader_grow(assembler->program->memory, assembler->code, &assembler->room,
                                      sizeof *assembler->code);
    }
    struct shader_instruction *const instruction = &assembler->code[assembler->count++];
    *instruction = (struct shader_instruction){.op = (uint8_t)op};
    return instruction;
}

static uint8_t kind_of(const struct shader_instruction *instruction)
{
    if (instruction->result.is_uniform) {
        return SHADER_ONCE;
    }
    return (uint8_t)((instruction->a.is_uniform ? SHADER_A_IS_ONE : 0) |
                     (instruction->b.is_uniform ? SHADER_B_IS_ONE : 0) |
                     (instruction->c.is_uniform ? SHADER_C_IS_ONE : 0));
}

// Homes that begin to live at a place get what they begin with.
static void fill_homes(struct assembler *assembler, const uint32_t *first, const uint32_t *next,
                       uint32_t place)
{
    for (uint32_t v = first[place]; v != 0; v = next[v - 1]) {
        struct shader_instruction *const fill = add(assembler, SHADER_FILL);
        fill->immediate = assembler->program->nodes[v - 1].immediate;
        fill->result = operand_of(assembler, v - 1);
        fill->kind = kind_of(fill);
    }
}

// Structure that is open.
struct open_structure {
    uint32_t value;   // node
    uint32_t begin;   // instruction
    uint32_t to_else; // instruction of ELSE, or NONE
    bool loses_lanes; // lanes leave for what lies around it, or are discarded
    uint32_t exits;   // last instruction that comes here where no lane is active, plus 1; they form a list
};

struct structures {
    struct open_structure stack[SHADER_MAX_DEPTH + 1]; // the first is the whole shader
    uint32_t depth;
};

// Lanes leave all structure inside of `until`, or of the shader.
static void lose_lanes(struct structures *structures, uint32_t until)
{
    for (uint32_t d = structures->depth; d > 0 && structures->stack[d].value != until; d--) {
        structures->stack[d].loses_lanes = true;
    }
}

// Instructions that wait for the place to go to without an active lane go to `at`.
static void set_exits(struct assembler *assembler, struct open_structure *structure, uint32_t at)
{
    while (structure->exits != 0) {
        struct shader_operand_of *const exit = &assembler->code[structure->exits - 1].c;
        structure->exits = exit->vector;
        exit->vector = at & 0x7fffffff;
    }
}

static void open_structure(struct assembler *assembler, uint32_t value, struct structures *structures)
{
    const struct shader_node *const node = &assembler->program->nodes[value];
    const bool jumps = shader_is_jump(assembler->program, value);
    struct shader_instruction *const instruction = add(assembler, jumps ? SHADER_JUMP_UNLESS : node->op);
    if (!jumps) {
        instruction->result = varying_register(assembler, assembler->registers[value]);
    }
    if (node->op == SHADER_IF) {
        instruction->a = operand_of(assembler, node->operands[0]);
    } else {
        instruction->b = varying_register(assembler, assembler->mask_registers[value]);
    }
    structures->stack[++structures->depth] =
        (struct open_structure){.value = value, .begin = assembler->count - 1, .to_else = NONE};
}

static void add_else(struct assembler *assembler, struct open_structure *open)
{
    const bool jumps = shader_is_jump(assembler->program, open->value);
    const uint32_t at = assembler->count;
    struct shader_instruction *const instruction = add(assembler, jumps ? SHADER_JUMP : SHADER_ELSE);
    if (!jumps) {
        instruction->result = varying_register(assembler, assembler->registers[open->value]);
        instruction->a = operand_of(assembler, assembler->program->nodes[open->value].operands[0]);
    }
    assembler->code[open->begin].immediate = jumps ? at + 1 : at;
    set_exits(assembler, open, at);
    open->to_else = at;
}

static void close_structure(struct assembler *assembler, uint16_t op, struct structures *structures)
{
    struct open_structure *const open = &structures->stack[structures->depth--];
    const uint32_t at = assembler->count;
    set_exits(assembler, open, at);
    if (op == SHADER_END_IF) {
        assembler->code[open->to_else == NONE ? open->begin : open->to_else].immediate = at;
    }
    if (shader_is_jump(assembler->program, open->value)) {
        return;
    }
    struct shader_instruction *const instruction = add(assembler, op);
    instruction->result = varying_register(assembler, assembler->registers[open->value]);
    if (op != SHADER_END_IF) {
        instruction->b = varying_register(assembler, assembler->mask_registers[open->value]);
        instruction->immediate = open->begin + 1; // END_LOOP goes back there
    }
    if (open->loses_lanes) {
        struct open_structure *const outer = &structures->stack[structures->depth];
        instruction->c.vector = outer->exits & 0x7fffffff;
        outer->exits = at + 1;
    }
}

static void add_structure(struct assembler *assembler, uint32_t value, struct structures *structures)
{
    const struct shader_node *const node = &assembler->program->nodes[value];
    if (node->op == SHADER_LEAVE) {
        struct shader_instruction *const leave = add(assembler, SHADER_LEAVE);
        leave->result = varying_register(assembler, assembler->mask_registers[node->operands[0]]);
        lose_lanes(structures, node->operands[0]);
    } else if (shader_opens(node->op)) {
        open_structure(assembler, value, structures);
    } else if (node->op == SHADER_ELSE) {
        add_else(assembler, &structures->stack[structures->depth]);
    } else {
        close_structure(assembler, node->op, structures);
    }
}

// Return the resource that a BUFFER node is an element of.
static uint16_t resource_of(const struct assembler *assembler, uint32_t value)
{
    const struct shader_node *const buffer = shader_resource_node(assembler->program, value);
    return buffer->op == SHADER_PUSH        ? SHADER_NO_RESOURCE
           : buffer->op == SHADER_WORKGROUP ? SHADER_SHARED
                                            : (uint16_t)buffer->immediate;
}

// Operations whose operands are a list: images and atomics.
static void add_listed(struct assembler *assembler, uint32_t value)
{
    struct shader_node *const node = &assembler->program->nodes[value];
    struct shader_instruction *const instruction = add(assembler, node->op);
    uint32_t count;
    const uint32_t *const operands = shader_operands(assembler->program, node, &count);
    instruction->immediate = node->immediate;
    instruction->resource = resource_of(assembler, operands[SHADER_IMAGE_TEXTURE]);
    instruction->b.vector = assembler->image_operand_count & 0x7fffffff;
    if (node->op == SHADER_ATOMIC || node->op == SHADER_IMAGE_ATOMIC) {
        instruction->result = operand_of(assembler, value);
        instruction->kind = kind_of(instruction);
    } else if (node->immediate & SHADER_IMAGE_HAS_SAMPLER) {
        instruction->c.vector = resource_of(assembler, operands[SHADER_IMAGE_SAMPLER]);
    }
    for (uint32_t i = 0; i < count; i++) {
        if (assembler->image_operand_count == assembler->image_operand_room) {
            assembler->image_operands =
                shader_grow(assembler->program->memory, assembler->image_operands,
                            &assembler->image_operand_room, sizeof *assembler->image_operands);
        }
        assembler->image_operands[assembler->image_operand_count++] = operand_of(assembler, operands[i]);
    }
}

// A LOAD or STORE of a PRIVATE or TABLE, whose words begin behind those of others.
static void add_own_access(struct assembler *assembler, uint32_t value)
{
    const struct shader_node *const node = &assembler->program->nodes[value];
    const struct shader_node *const memory = &assembler->program->nodes[node->operands[0]];
    const bool loads = node->op == SHADER_LOAD, is_private = memory->op == SHADER_PRIVATE;
    struct shader_instruction *const instruction = add(assembler, !loads       ? SHADER_STORE_PRIVATE
                                                                  : is_private ? SHADER_LOAD_PRIVATE
                                                                               : SHADER_LOAD_TABLE);
    instruction->immediate = node->immediate + 4 * memory->immediate;
    instruction->b = operand_of(assembler, node->operands[1]);
    if (loads) {
        instruction->result = operand_of(assembler, value);
        instruction->kind = kind_of(instruction);
    } else {
        instruction->c = operand_of(assembler, node->operands[2]);
    }
}

static void add_node(struct assembler *assembler, uint32_t value)
{
    const struct shader_node *const node = &assembler->program->nodes[value];
    const enum shader_op op = (enum shader_op)node->op;
    if (shader_op_has_list(op)) {
        add_listed(assembler, value);
        return;
    }
    if ((op == SHADER_LOAD || op == SHADER_STORE) &&
        !is_placed(&assembler->program->nodes[node->operands[0]])) {
        add_own_access(assembler, value);
        return;
    }
    uint32_t paired[3];
    const uint32_t pair = shader_pair_at(&assembler->pairs, assembler->program, value, paired);
    struct shader_instruction *const instruction = add(assembler, pair ? pair : node->op);
    struct shader_operand_of operands[3] = {{0, 0}, {0, 0}, {0, 0}};
    for (int o = 0; o < (pair ? shader_pair_operands(pair) : shader_op_operands(op)); o++) {
        operands[o] = operand_of(assembler, pair ? paired[o] : node->operands[o]);
    }
    instruction->immediate = node->immediate;
    if (op == SHADER_LOAD || op == SHADER_STORE || op == SHADER_STORE8 || op == SHADER_STORE16 ||
        op == SHADER_LENGTH || op == SHADER_NEEDS_GRADIENT) {
        instruction->resource = resource_of(assembler, node->operands[0]);
    }
    if (op == SHADER_NEEDS_GRADIENT) {
        instruction->immediate = resource_of(assembler, node->operands[1]);
    }
    instruction->a = operands[0];
    instruction->b = operands[1];
    instruction->c = operands[2];
    if (op == SHADER_SET) {
        instruction->result = operands[0];
        instruction->a = operands[1];
        instruction->kind = kind_of(instruction);
    } else if (shader_op_kind_of(op) != SHADER_KIND_EFFECT) {
        instruction->result = operand_of(assembler, value);
        instruction->kind = kind_of(instruction);
    }
}

static void add_code(struct assembler *assembler)
{
    const struct shader_program *const program = assembler->program;
    struct structures structures = {.depth = 0};
    uint32_t *const first = shader_take(program->memory, program->code_count + 1, sizeof *first);
    uint32_t *const next = shader_take(program->memory, program->node_count, sizeof *next);
    for (uint32_t value = 0; value < program->node_count; value++) {
        const struct shader_live_range *const range = &assembler->ranges[value];
        if (program->nodes[value].op == SHADER_HOME && range->end != NONE) {
            next[value] = first[range->begin];
            first[range->begin] = value + 1;
        }
    }
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        fill_homes(assembler, first, next, i);
        if (shader_op_kind_of((enum shader_op)program->nodes[value].op) == SHADER_KIND_FLOW) {
            add_structure(assembler, value, &structures);
        } else if (!assembler->pairs.is_taken[value]) {
            add_node(assembler, value);
            if (program->nodes[value].op == SHADER_DISCARD) {
                lose_lanes(&structures, NONE);
            }
        }
    }
    set_exits(assembler, &structures.stack[0], assembler->count);
    (void)add(assembler, SHADER_END);
}

// Constants that are read get the first uniform registers.
static void number_constants(struct assembler *assembler)
{
    const struct shader_program *const program = assembler->program;
    uint32_t *const constants = shader_take(program->memory, program->node_count, sizeof *constants);
    uint32_t count = 0;
    for (uint32_t value = 0; value < program->node_count; value++) {
        if (program->nodes[value].op == SHADER_CONSTANT && assembler->ranges[value].end != NONE) {
            assembler->registers[value] = count;
            constants[count++] = program->nodes[value].immediate;
        }
    }
    assembler->bytecode->constants = constants;
    assembler->bytecode->constant_count = count;
}

struct shader_bytecode *shader_assemble(struct shader_program *program)
{
    struct shader_memory *const memory = program->memory;
    struct shader_bytecode *const bytecode = shader_take(memory, 1, sizeof *bytecode);
    struct assembler assembler = {.program = program,
                                  .bytecode = bytecode,
                                  .registers = shader_take(memory, program->node_count, sizeof(uint32_t)),
                                  .mask_registers =
                                      shader_take(memory, program->node_count, sizeof(uint32_t))};
    shader_find_pairs(program, &assembler.pairs);
    assembler.ranges = shader_find_live_ranges(program, &assembler.pairs);
    number_constants(&assembler);
    give_registers(&assembler);
    add_code(&assembler);
    bytecode->code = assembler.code;
    bytecode->code_count = assembler.count;
    bytecode->private_count = program->private_count;
    bytecode->table = program->table;
    bytecode->table_count = program->table_count;
    bytecode->image_operands = assembler.image_operands;
    return bytecode;
}
