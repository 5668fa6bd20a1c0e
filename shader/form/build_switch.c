// SPDX-License-Identifier: MIT
// A switch: a REGION with an IF for each case, in an order in which each goes only to later ones.
#include "build_flow.h"

struct switch_case {
    uint32_t label;
    uint32_t match; // truth: the selector is one of its values
};

enum { MAX_CASES = 4096, MAX_PATH = 128 };

// The blocks that the default of a switch leads to without a condition.
struct default_path {
    uint32_t labels[MAX_PATH];
    uint32_t count;
};

// Return the label at which control flow goes on behind a block, be it the merge block of what the block begins, or 0.
static uint32_t label_behind(struct shader_builder *builder, uint32_t label)
{
    const struct shader_module *const module = builder->module;
    uint32_t word = label < module->bound ? builder->label_words[label] : 0;
    for (; word != 0 && word < module->word_count; word += module->words[word] >> 16) {
        const uint32_t opcode = module->words[word] & 0xffff;
        shader_spend(builder, module->words[word] >> 16);
        if (opcode == SPIRV_OP_LoopMerge || opcode == SPIRV_OP_SelectionMerge || opcode == SPIRV_OP_Branch) {
            return module->words[word + 1];
        }
        if (opcode >= SPIRV_OP_BranchConditional && opcode <= SPIRV_OP_Unreachable) {
            break;
        }
    }
    return 0;
}

static void follow_default(struct shader_builder *builder, uint32_t label, uint32_t merge,
                           struct default_path *path)
{
    path->count = 0;
    for (label = label_behind(builder, label); label != 0 && label != merge && path->count < MAX_PATH;
         label = label_behind(builder, label)) {
        path->labels[path->count++] = label;
    }
}

// Return true if the default of a switch falls into a case.
static bool falls_into(const struct default_path *path, uint32_t label)
{
    for (uint32_t i = 0; i < path->count; i++) {
        if (path->labels[i] == label) {
            return true;
        }
    }
    return false;
}

static bool has_phis(const struct shader_builder *builder, uint32_t label)
{
    const uint32_t word = label < builder->module->bound ? builder->label_words[label] : 0;
    return word != 0 && word + 2 < builder->module->word_count &&
           (builder->module->words[word + 2] & 0xffff) == SPIRV_OP_Phi;
}

// List the cases in an order in which each goes only to later ones. Return how many there are.
static uint32_t list_cases(struct shader_builder *builder, uint32_t selector, uint32_t merge,
                           struct switch_case *cases)
{
    const uint32_t words = shader_word_count(builder), otherwise = shader_operand(builder, 2);
    uint32_t count = 0, any = shader_number(builder, 0);
    bool has_default = otherwise == merge && !has_phis(builder, merge);
    struct default_path path = {.count = 0};
    if (!has_default) {
        follow_default(builder, otherwise, merge, &path);
    }
    for (uint32_t i = 3; i + 1 < words; i += 2) {
        const uint32_t label = shader_operand(builder, i + 1);
        const uint32_t match = shader_emit(builder, SHADER_IEQUAL, selector,
                                           shader_number(builder, shader_operand(builder, i)), 0);
        any = shader_emit(builder, SHADER_OR, any, match, 0);
        uint32_t same = 0;
        while (same < count && cases[same].label != label) {
            same++;
        }
        if (count > MAX_CASES) {
            shader_build_refuse(builder, "a switch has at most %d cases", MAX_CASES);
        }
        if (same < count) {
            cases[same].match = shader_emit(builder, SHADER_OR, cases[same].match, match, 0);
            continue;
        }
        if (!has_default && label != otherwise && falls_into(&path, label)) {
            cases[count++] = (struct switch_case){otherwise, SHADER_NO_VALUE};
            has_default = true;
        }
        cases[count++] = (struct switch_case){label, match};
        has_default = has_default || label == otherwise;
    }
    if (!has_default) {
        cases[count++] = (struct switch_case){otherwise, SHADER_NO_VALUE};
    }
    const uint32_t none = shader_emit(builder, SHADER_NOT, any, 0, 0);
    for (uint32_t i = 0; i < count; i++) {
        if (cases[i].label == otherwise) {
            cases[i].match = cases[i].match == SHADER_NO_VALUE
                                 ? none
                                 : shader_emit(builder, SHADER_OR, cases[i].match, none, 0);
        }
    }
    return count;
}

// Phis of a case take what the block of the switch gives them in lanes that the selector brings there. Those that fall
// into it come with what they have by then.
static void set_phis_of_case(struct shader_builder *builder, const struct switch_case *to)
{
    if (has_phis(builder, to->label)) {
        const size_t mark = builder->facts.log_count;
        flow(builder, SHADER_IF, to->match);
        shader_set_phis(builder, to->label);
        flow(builder, SHADER_END_IF, 0);
        shader_forget_since(builder, mark);
    }
}

// Lanes that are to run a case stand in a home of its own; a case that falls into another adds its lanes there.
void shader_build_switch(struct shader_builder *builder, uint32_t merge)
{
    const uint32_t id = shader_operand(builder, 1);
    const struct shader_type *const type = shader_type_of_value(builder, id);
    if (type->kind != SHADER_INT) {
        shader_build_refuse(builder, "id %u is no integer", (unsigned)id);
    }
    const uint32_t words = shader_word_count(builder);
    struct switch_case *const cases = shader_take(builder->memory, words / 2 + 2, sizeof *cases);
    struct shader_construct *const targets = shader_take(builder->memory, words / 2 + 2, sizeof *targets);
    uint32_t *const runs = shader_take(builder->memory, words / 2 + 2, sizeof *runs);
    const uint32_t count = list_cases(builder, shader_scalars(builder, id)[0], merge, cases);
    enter(builder);
    const uint32_t region = begin(builder, SHADER_REGION);
    const size_t mark = builder->facts.log_count;
    struct shader_construct construct = {.merge = merge, .region = region, .outer = builder->constructs};
    builder->constructs = &construct;
    for (uint32_t i = 0; i < count; i++) {
        runs[i] = shader_new_home(builder, 0);
        shader_set_home(builder, runs[i], cases[i].match);
        set_phis_of_case(builder, &cases[i]);
    }
    for (uint32_t i = 0; i < count; i++) {
        const size_t inner = builder->facts.log_count;
        const uint32_t ran = shader_get_home(builder, runs[i]);
        uint32_t bits;
        if (shader_is_number(builder, ran, &bits) && bits == 0) {
            continue; // no lane comes to this case
        }
        flow(builder, SHADER_IF, ran);
        const uint32_t body = begin(builder, SHADER_REGION);
        // What is behind can be fallen into.
        for (uint32_t t = count; t-- > i + 1;) {
            targets[t] = (struct shader_construct){
                .merge = cases[t].label, .region = body, .fall = runs[t], .outer = builder->constructs};
            builder->constructs = &targets[t];
        }
        if (shader_comes_to(builder, cases[i].label, merge)) {
            shader_go_on_from(builder, cases[i].label, merge);
        }
        leave(builder, region);
        builder->constructs = &construct;
        flow(builder, SHADER_END_REGION, 0);
        flow(builder, SHADER_END_IF, 0);
        shader_forget_since(builder, inner);
    }
    builder->constructs = construct.outer;
    flow(builder, SHADER_END_REGION, 0);
    shader_forget_since(builder, mark);
    builder->nesting--;
}
