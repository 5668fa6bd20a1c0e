// SPDX-License-Identifier: MIT
// What variables are used for, found in one walk over the words before anything is translated. A pointer that was made
// of another by an access chain counts for the variable that it goes back to, or for the parameter of a function.
#include "build.h"

struct passed { // what a call gives to a pointer parameter
    uint32_t parameter, variable;
};

struct walk {
    struct shader_builder *builder;
    const struct shader_module *module;
    struct shader_usage *usage;
    uint32_t *root; // by id: variable or parameter that a pointer goes back to, or 0
    struct passed *passed;
    size_t passed_count, passed_room;
};

static bool is_constant(const struct walk *walk, uint32_t id)
{
    const uint16_t opcode = walk->module->ids[id].opcode;
    return (opcode >= SPIRV_OP_ConstantTrue && opcode <= SPIRV_OP_SpecConstantOp) || opcode == SPIRV_OP_Undef;
}

static void walk_chain(struct walk *walk, const uint32_t *words, uint32_t count)
{
    const uint32_t root = walk->root[words[3]];
    walk->root[words[2]] = root;
    for (uint32_t i = 4; i < count && root != 0; i++) {
        walk->usage[root].is_indexed = walk->usage[root].is_indexed || !is_constant(walk, words[i]);
    }
}

static void walk_store(const struct walk *walk, uint32_t pointer, uint32_t value)
{
    const uint32_t root = walk->root[pointer];
    struct shader_usage *const usage = &walk->usage[root];
    if (root == 0) {
        return;
    }
    if (root == pointer && is_constant(walk, value) && (usage->constant == 0 || usage->constant == value)) {
        usage->constant = value;
    } else {
        usage->is_changed = true;
    }
}

// An instruction that may write through each of its operands from `first` on.
static void walk_changes(const struct walk *walk, const uint32_t *words, uint32_t first, uint32_t count)
{
    for (uint32_t i = first; i < count; i++) {
        const uint32_t root = words[i] < walk->module->bound ? walk->root[words[i]] : 0;
        if (root != 0) {
            walk->usage[root].is_changed = true;
        }
    }
}

static void walk_call(struct walk *walk, const uint32_t *words, uint32_t count)
{
    const struct shader_module *const module = walk->module;
    const struct shader_id *const called = &module->ids[words[3]];
    walk_changes(walk, words, 4, count);
    uint32_t word = called->opcode == SPIRV_OP_Function ? called->word : module->word_count;
    for (uint32_t i = 4; i < count && word < module->word_count;) {
        const uint32_t opcode = module->words[word] & 0xffff;
        if (opcode == SPIRV_OP_Label || opcode == SPIRV_OP_FunctionEnd) {
            return;
        }
        if (opcode == SPIRV_OP_FunctionParameter) {
            if (walk->root[words[i]] != 0) {
                if (walk->passed_count == walk->passed_room) {
                    walk->passed = shader_grow(walk->builder->memory, walk->passed, &walk->passed_room,
                                               sizeof *walk->passed);
                }
                walk->passed[walk->passed_count++] =
                    (struct passed){module->words[word + 2], walk->root[words[i]]};
            }
            i++;
        }
        word += module->words[word] >> 16;
    }
}

static void walk_instruction(struct walk *walk, const uint32_t *words)
{
    const uint32_t count = words[0] >> 16;
    switch (words[0] & 0xffff) {
    case SPIRV_OP_Variable:
        walk->root[words[2]] = words[3] == SPIRV_FUNCTION || words[3] == SPIRV_PRIVATE ? words[2] : 0;
        return;
    case SPIRV_OP_FunctionParameter: walk->root[words[2]] = words[2]; return;
    case SPIRV_OP_AccessChain:
    case SPIRV_OP_InBoundsAccessChain: walk_chain(walk, words, count); return;
    case SPIRV_OP_CopyObject: walk->root[words[2]] = walk->root[words[3]]; return;
    case SPIRV_OP_Store: walk_store(walk, words[1], words[2]); return;
    case SPIRV_OP_CopyMemory: walk_changes(walk, words, 1, 2); return;
    case SPIRV_OP_FunctionCall: walk_call(walk, words, count); return;
    case SPIRV_OP_ExtInst: walk_changes(walk, words, 5, count); return;
    default: return;
    }
}

void shader_find_usage(struct shader_builder *builder)
{
    const struct shader_module *const module = builder->module;
    struct walk walk = {.builder = builder,
                        .module = module,
                        .usage = builder->usage,
                        .root = shader_take(builder->memory, module->bound, sizeof(uint32_t))};
    for (uint32_t word = SPIRV_HEADER_WORDS; word < module->word_count; word += module->words[word] >> 16) {
        walk_instruction(&walk, module->words + word);
    }
    // What a parameter is used for, its variable is. Calls nest no deeper than control flow does.
    bool is_new = true;
    for (int round = 0; is_new && round < SHADER_MAX_NESTING; round++) {
        is_new = false;
        for (size_t i = 0; i < walk.passed_count; i++) {
            const struct shader_usage *const from = &walk.usage[walk.passed[i].parameter];
            struct shader_usage *const to = &walk.usage[walk.passed[i].variable];
            is_new = is_new || (from->is_indexed && !to->is_indexed);
            to->is_indexed = to->is_indexed || from->is_indexed;
        }
    }
}
