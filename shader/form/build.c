// SPDX-License-Identifier: MIT
// Translation of an entry point: values, homes, and what all files of the builder need.
#include "build.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    MAX_EFFORT = 1 << 25 // words: a fraction of a second
};

// Instructions ---------------------------------------------------------------------------------------

void shader_build_refuse(const struct shader_builder *builder, const char *format, ...)
{
    char message[SHADER_MESSAGE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    shader_refuse(builder->module, builder->word, "%s", message);
}

const uint32_t *shader_words(const struct shader_builder *builder)
{
    return builder->module->words + builder->word;
}

uint32_t shader_word_count(const struct shader_builder *builder)
{
    return builder->module->words[builder->word] >> 16;
}

uint32_t shader_operand(const struct shader_builder *builder, uint32_t index)
{
    if (index >= shader_word_count(builder)) {
        shader_build_refuse(builder, "an operand is missing");
    }
    return shader_words(builder)[index];
}

void shader_spend(struct shader_builder *builder, uint32_t words)
{
    if (words > MAX_EFFORT - builder->effort) {
        shader_build_refuse(builder,
                            "the shader has too many instructions, of its calls in their places too");
    }
    builder->effort += words;
}

const struct shader_type *shader_result_type(const struct shader_builder *builder)
{
    return shader_type_of_id(builder->module, builder->word, shader_words(builder)[1]);
}

// Nodes ----------------------------------------------------------------------------------------------

uint32_t shader_number(struct shader_builder *builder, uint32_t bits)
{
    return shader_add_constant(builder->program, bits);
}

uint32_t shader_number_float(struct shader_builder *builder, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return shader_number(builder, bits);
}

bool shader_is_number(const struct shader_builder *builder, uint32_t value, uint32_t *bits)
{
    const struct shader_node *const node = &builder->program->nodes[value];
    *bits = node->immediate;
    return node->op == SHADER_CONSTANT;
}

static void append(struct shader_program *program, uint32_t node)
{
    if (program->code_count == program->code_room) {
        program->code =
            shader_grow(program->memory, program->code, &program->code_room, sizeof *program->code);
    }
    program->code[program->code_count++] = node;
}

uint32_t shader_emit_with(struct shader_builder *builder, enum shader_op op, uint32_t immediate, uint32_t a,
                          uint32_t b, uint32_t c)
{
    const uint32_t node = shader_add_node(builder->program, op, immediate, a, b, c);
    builder->program->origins[node] = builder->word;
    append(builder->program, node);
    return node;
}

uint32_t shader_emit(struct shader_builder *builder, enum shader_op op, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t operands[3] = {a, b, c};
    const int count = shader_op_operands(op);
    uint32_t bits[3] = {0, 0, 0}, folded;
    bool known = shader_op_kind_of(op) == SHADER_KIND_VALUE;
    for (int i = 0; known && i < count; i++) {
        known = shader_is_number(builder, operands[i], &bits[i]);
    }
    if (known && shader_fold(op, bits, &folded)) {
        return shader_number(builder, folded);
    }
    return shader_emit_with(builder, op, 0, a, b, c);
}

// Homes ----------------------------------------------------------------------------------------------

uint32_t shader_new_home(struct shader_builder *builder, uint32_t initial)
{
    const uint32_t home = shader_add_node(builder->program, SHADER_HOME, initial, 0, 0, 0);
    builder->program->origins[home] = builder->word;
    shader_add_facts_of_home(builder, home);
    return home;
}

void shader_set_home(struct shader_builder *builder, uint32_t home, uint32_t value)
{
    shader_emit(builder, SHADER_SET, home, value, 0);
    shader_learn(builder, home, value);
}

uint32_t shader_get_home(struct shader_builder *builder, uint32_t home)
{
    if (builder->facts.known[home] == SHADER_NO_VALUE) {
        shader_learn(builder, home, shader_emit(builder, SHADER_COPY, home, 0, 0));
    }
    return builder->facts.known[home];
}

// Ids ------------------------------------------------------------------------------------------------

uint32_t *shader_new_scalars(struct shader_builder *builder, const struct shader_type *type)
{
    if (type->scalars == 0 && !type->is_empty) {
        shader_build_refuse(builder, "there are no values of the type of id %u", (unsigned)type->id);
    }
    return shader_take(builder->memory, type->scalars, sizeof(uint32_t));
}

// A constant gets its scalars where it is first used.
static void build_constant(struct shader_builder *builder, uint32_t id)
{
    const struct shader_constant *const constant = shader_constant_of_id(builder->module, builder->word, id);
    struct shader_built *const built = &builder->built[id];
    built->scalars = shader_new_scalars(builder, constant->type);
    for (uint32_t i = 0; i < constant->type->scalars; i++) {
        built->scalars[i] = shader_number(builder, constant->scalars[i]);
    }
    built->type = constant->type;
}

static struct shader_built *find_built(struct shader_builder *builder, uint32_t id)
{
    if (id == 0 || id >= builder->module->bound) {
        shader_build_refuse(builder, "%u is no id", (unsigned)id);
    }
    struct shader_built *const built = &builder->built[id];
    const uint16_t opcode = builder->module->ids[id].opcode;
    const bool is_constant =
        (opcode >= SPIRV_OP_ConstantTrue && opcode <= SPIRV_OP_SpecConstantOp) || opcode == SPIRV_OP_Undef;
    if (!built->type && is_constant) {
        build_constant(builder, id);
    }
    if (!built->type) {
        shader_build_refuse(builder, "id %u has no value here", (unsigned)id);
    }
    return built;
}

const uint32_t *shader_scalars(struct shader_builder *builder, uint32_t id)
{
    const struct shader_built *const built = find_built(builder, id);
    if (!built->scalars) {
        shader_build_refuse(builder, "id %u is no number and no composite of numbers", (unsigned)id);
    }
    return built->scalars;
}

const struct shader_type *shader_type_of_value(struct shader_builder *builder, uint32_t id)
{
    return find_built(builder, id)->type;
}

struct shader_place *shader_place_of(struct shader_builder *builder, uint32_t id)
{
    const struct shader_built *const built = find_built(builder, id);
    if (!built->place) {
        shader_build_refuse(builder, "id %u is no pointer and no resource", (unsigned)id);
    }
    return built->place;
}

void shader_define(struct shader_builder *builder, const uint32_t *scalars)
{
    const struct shader_type *const type = shader_result_type(builder);
    struct shader_built *const built = &builder->built[shader_operand(builder, 2)];
    uint32_t *const copy = shader_new_scalars(builder, type);
    memcpy(copy, scalars, type->scalars * sizeof *copy);
    built->type = type;
    built->scalars = copy;
    built->place = NULL;
}

void shader_define_scalar(struct shader_builder *builder, uint32_t scalar)
{
    if (shader_result_type(builder)->scalars != 1) {
        shader_build_refuse(builder, "the result is one scalar");
    }
    shader_define(builder, &scalar);
}

void shader_define_place(struct shader_builder *builder, const struct shader_place *place)
{
    struct shader_built *const built = &builder->built[shader_operand(builder, 2)];
    built->place = shader_take(builder->memory, 1, sizeof *place);
    *built->place = *place;
    built->type = shader_result_type(builder);
    built->scalars = NULL;
}

// The entry point ------------------------------------------------------------------------------------

static void find_labels(struct shader_builder *builder)
{
    const struct shader_module *const module = builder->module;
    for (uint32_t id = 1; id < module->bound; id++) {
        if (module->ids[id].opcode == SPIRV_OP_Label) {
            builder->label_words[id] = module->ids[id].word;
        }
    }
}

struct shader_program *shader_build(const struct shader_module *module,
                                    const struct shader_entry_point *entry, uint32_t view_index)
{
    struct shader_memory *const memory = module->memory;
    struct shader_program *const program = shader_take(memory, 1, sizeof *program);
    struct shader_builder *const builder = shader_take(memory, 1, sizeof *builder);
    *program =
        (struct shader_program){.memory = memory, .module = module, .entry = entry, .view_index = view_index};
    *builder =
        (struct shader_builder){.module = module,
                                .entry = entry,
                                .program = program,
                                .memory = memory,
                                .word = entry->word,
                                .built = shader_take(memory, module->bound, sizeof(struct shader_built)),
                                .usage = shader_take(memory, module->bound, sizeof(struct shader_usage)),
                                .is_in_interface = shader_take(memory, module->bound, sizeof(bool)),
                                .label_words = shader_take(memory, module->bound, sizeof(uint32_t)),
                                .visited = shader_take(memory, module->bound, sizeof(uint32_t)),
                                .output_homes = shader_take(memory, SHADER_OUT_COUNT, sizeof(uint32_t))};
    memset(builder->output_homes, 0xff, SHADER_OUT_COUNT * sizeof(uint32_t));
    (void)shader_number(builder, 0); // node 0 means that an operand is not there
    find_labels(builder);
    shader_find_usage(builder);
    for (uint32_t i = 0; i < entry->interface_count; i++) {
        builder->is_in_interface[entry->interface[i]] = true;
    }
    if (entry->function >= module->bound || module->ids[entry->function].opcode != SPIRV_OP_Function) {
        shader_build_refuse(builder, "id %u is no function", (unsigned)entry->function);
    }
    for (uint32_t i = 0; i < module->variable_count; i++) {
        builder->word = module->ids[module->variables[i]->id].word;
        shader_build_variable(builder, module->variables[i]);
    }
    const struct shader_function *const function = module->ids[entry->function].data.as_function;
    builder->word = function->word;
    if (function->type->count != 0 || function->type->element->kind != SHADER_VOID) {
        shader_build_refuse(builder, "an entry point takes and returns nothing");
    }
    (void)shader_build_function(builder, function);
    shader_write_outputs(builder);
    return program;
}
