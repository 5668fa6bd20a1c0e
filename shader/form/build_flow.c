// SPDX-License-Identifier: MIT
// Control flow: blocks of SPIR-V, which name where they come together again, become nested IF, REGION and LOOP.
//
// A construct ends at its merge block. Where control flow comes to the label at which the innermost construct goes on,
// nothing is to be done; where it comes to the label of a construct further out, lanes leave that construct.
#include "build.h"

#include <string.h>

static void build_from(struct shader_builder *builder, uint32_t label, uint32_t stop);
static void go_on_from(struct shader_builder *builder, uint32_t label, uint32_t stop);
static bool comes_to(struct shader_builder *builder, uint32_t label, uint32_t stop);

static void enter(struct shader_builder *builder)
{
    if (++builder->nesting > SHADER_MAX_NESTING) {
        shader_build_refuse(builder, "control flow is nested more than %d deep", SHADER_MAX_NESTING);
    }
}

// Labels and constructs ------------------------------------------------------------------------------

static void flow(struct shader_builder *builder, enum shader_op op, uint32_t operand)
{
    (void)shader_emit_with(builder, op, 0, operand, 0, 0);
}

// Take active lanes out of a construct. The number 1 in its node tells that some leave it.
static void leave(struct shader_builder *builder, uint32_t region)
{
    builder->program->nodes[region].immediate = 1;
    flow(builder, SHADER_LEAVE, region);
}

static struct shader_construct *find_construct(struct shader_builder *builder, uint32_t label)
{
    struct shader_construct *construct = builder->constructs;
    while (construct && construct->merge != label) {
        construct = construct->outer;
        shader_spend(builder, 1);
    }
    return construct;
}

static uint32_t begin(struct shader_builder *builder, enum shader_op op)
{
    return shader_emit_with(builder, op, 0, 0, 0, 0);
}

// Instructions of a block that stand before its end --------------------------------------------------

// Return the homes of a phi, which are made where control flow first comes to it.
static uint32_t *phi_homes(struct shader_builder *builder, uint32_t id, const struct shader_type *type)
{
    struct shader_built *const built = &builder->built[id];
    if (!built->phi) {
        built->phi = shader_new_scalars(builder, type);
        for (uint32_t i = 0; i < type->scalars; i++) {
            built->phi[i] = shader_new_home(builder, 0);
        }
    }
    return built->phi;
}

// Give the phis of a block what they take from the block that control flow comes from. All are read before any is
// written, since one may be the operand of another.
static void set_phis(struct shader_builder *builder, uint32_t label)
{
    const uint32_t *const words = builder->module->words;
    const uint32_t from = builder->block, at = builder->word;
    if (label >= builder->module->bound || builder->label_words[label] == 0) {
        shader_build_refuse(builder, "id %u is no label", (unsigned)label);
    }
    uint32_t first = builder->label_words[label] + 2, word = first;
    size_t count = 0, room = 0;
    uint32_t *values = NULL;
    for (int writes = 0; writes < 2; writes++) {
        size_t next = 0;
        for (word = first; word < builder->module->word_count; word += words[word] >> 16) {
            const uint32_t opcode = words[word] & 0xffff;
            if (opcode == SPIRV_OP_Line || opcode == SPIRV_OP_NoLine) {
                continue;
            }
            if (opcode != SPIRV_OP_Phi) {
                break;
            }
            builder->word = word;
            const struct shader_type *const type = shader_result_type(builder);
            const uint32_t *const homes = phi_homes(builder, words[word + 2], type);
            uint32_t operand = 3;
            while (operand + 1 < shader_word_count(builder) && words[word + operand + 1] != from) {
                operand += 2;
            }
            shader_spend(builder, operand);
            if (operand + 1 >= shader_word_count(builder)) {
                shader_build_refuse(builder, "it has no value for control flow from block %u",
                                    (unsigned)from);
            }
            if (writes) {
                for (uint32_t i = 0; i < type->scalars; i++) {
                    shader_set_home(builder, homes[i], values[next++]);
                }
                continue;
            }
            if (shader_type_of_value(builder, words[word + operand]) != type) {
                shader_build_refuse(builder, "id %u is of another type", (unsigned)words[word + operand]);
            }
            const uint32_t *const scalars = shader_scalars(builder, words[word + operand]);
            for (uint32_t i = 0; i < type->scalars; i++) {
                if (count == room) {
                    values = shader_grow(builder->memory, values, &room, sizeof *values);
                }
                values[count++] = scalars[i];
            }
        }
    }
    builder->word = at;
}

static void build_phi(struct shader_builder *builder)
{
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t *const homes = phi_homes(builder, shader_operand(builder, 2), type);
    uint32_t *const scalars = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        scalars[i] = shader_get_home(builder, homes[i]);
    }
    shader_define(builder, scalars);
}

static void build_call(struct shader_builder *builder)
{
    const uint32_t id = shader_operand(builder, 3), at = builder->word;
    if (id >= builder->module->bound || builder->module->ids[id].opcode != SPIRV_OP_Function) {
        shader_build_refuse(builder, "id %u is no function", (unsigned)id);
    }
    const struct shader_function *const function = builder->module->ids[id].data.as_function;
    if (shader_word_count(builder) - 4 != function->type->count ||
        shader_result_type(builder) != function->type->element) {
        shader_build_refuse(builder, "function %u takes and returns something else", (unsigned)id);
    }
    for (const struct shader_frame *frame = builder->frame; frame; frame = frame->caller) {
        if (frame->function == function) {
            shader_build_refuse(builder, "function %u calls itself", (unsigned)id);
        }
    }
    uint32_t word = function->word + 5;
    const uint32_t *const words = builder->module->words;
    for (uint32_t i = 0; i < function->type->count; i++, word += words[word] >> 16) {
        while ((words[word] & 0xffff) == SPIRV_OP_Line || (words[word] & 0xffff) == SPIRV_OP_NoLine) {
            word += words[word] >> 16;
        }
        if ((words[word] & 0xffff) != SPIRV_OP_FunctionParameter) {
            shader_build_refuse(builder, "function %u has too few parameters", (unsigned)id);
        }
        const uint32_t argument = shader_operand(builder, 4 + i);
        const struct shader_type *const type = shader_type_of_value(builder, argument);
        if (type != function->type->parameters[i] ||
            type != shader_type_of_id(builder->module, at, words[word + 1])) {
            shader_build_refuse(builder, "argument %u is of another type", (unsigned)i);
        }
        builder->built[words[word + 2]] = builder->built[argument];
    }
    const uint32_t *const homes = shader_build_function(builder, function);
    builder->word = at;
    if (homes) {
        const struct shader_type *const type = function->type->element;
        uint32_t *const scalars = shader_new_scalars(builder, type);
        for (uint32_t i = 0; i < type->scalars; i++) {
            scalars[i] = shader_get_home(builder, homes[i]);
        }
        shader_define(builder, scalars);
    }
}

static void build_instruction(struct shader_builder *builder, uint32_t opcode)
{
    switch (opcode) {
    case SPIRV_OP_Nop:
    case SPIRV_OP_Line:
    case SPIRV_OP_NoLine:
    case SPIRV_OP_Undef: return;
    case SPIRV_OP_Phi: build_phi(builder); return;
    case SPIRV_OP_FunctionCall: build_call(builder); return;
    case SPIRV_OP_Variable:
        shader_build_variable(builder, builder->module->ids[shader_operand(builder, 2)].data.as_variable);
        return;
    case SPIRV_OP_ExtInst:
        if (shader_operand(builder, 3) == builder->module->glsl_import && builder->module->glsl_import != 0) {
            shader_build_glsl(builder);
        } // Others are NonSemantic and say nothing to a machine.
        return;
    default: break;
    }
    if (!shader_build_conversion(builder, opcode) && !shader_build_arithmetic(builder, opcode) &&
        !shader_build_composite(builder, opcode) && !shader_build_memory(builder, opcode) &&
        !shader_build_image(builder, opcode) && !shader_build_subgroup(builder, opcode)) {
        shader_build_refuse(builder, "the instruction is not supported here");
    }
}

// Ends of blocks -------------------------------------------------------------------------------------

// Translate both ways, each until it comes to `stop`.
static void build_if(struct shader_builder *builder, uint32_t condition, uint32_t if_true, uint32_t if_false,
                     uint32_t stop)
{
    const uint32_t block = builder->block;
    uint32_t bits;
    enter(builder);
    if (shader_is_number(builder, condition, &bits)) {
        build_from(builder, bits ? if_true : if_false, stop);
        builder->nesting--;
        return;
    }
    const size_t mark = builder->facts.log_count;
    flow(builder, SHADER_IF, condition);
    build_from(builder, if_true, stop);
    shader_rewind_facts(builder, mark);
    flow(builder, SHADER_ELSE, 0);
    builder->block = block;
    build_from(builder, if_false, stop);
    flow(builder, SHADER_END_IF, 0);
    shader_forget_since(builder, mark);
    builder->nesting--;
}

static uint32_t condition_of(struct shader_builder *builder, uint32_t id)
{
    if (shader_type_of_value(builder, id)->kind != SHADER_BOOL) {
        shader_build_refuse(builder, "id %u is no bool", (unsigned)id);
    }
    return shader_scalars(builder, id)[0];
}

static void build_branch(struct shader_builder *builder, uint32_t merge, uint32_t stop)
{
    const uint32_t condition = condition_of(builder, shader_operand(builder, 1));
    const uint32_t if_true = shader_operand(builder, 2), if_false = shader_operand(builder, 3);
    if (merge == 0) {
        build_if(builder, condition, if_true, if_false, stop);
        return;
    }
    struct shader_construct construct = {.merge = merge, .outer = builder->constructs};
    builder->constructs = &construct;
    build_if(builder, condition, if_true, if_false, merge);
    builder->constructs = construct.outer;
}

// A switch. A case may go to one that stands behind it.
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
        set_phis(builder, to->label);
        flow(builder, SHADER_END_IF, 0);
        shader_forget_since(builder, mark);
    }
}

// Lanes that are to run a case stand in a home of its own; a case that falls into another adds its lanes there.
static void build_switch(struct shader_builder *builder, uint32_t merge)
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
        if (comes_to(builder, cases[i].label, merge)) {
            go_on_from(builder, cases[i].label, merge);
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

static void build_return(struct shader_builder *builder, bool has_value)
{
    const struct shader_frame *const frame = builder->frame;
    if (!has_value && frame->result) {
        shader_build_refuse(builder, "function %u returns a value", (unsigned)frame->function->id);
    }
    if (has_value) {
        const uint32_t id = shader_operand(builder, 1);
        const struct shader_type *const type = frame->function->type->element;
        if (shader_type_of_value(builder, id) != type) {
            shader_build_refuse(builder, "id %u is not of the type that the function returns", (unsigned)id);
        }
        const uint32_t *const scalars = shader_scalars(builder, id);
        for (uint32_t i = 0; i < type->scalars; i++) {
            shader_set_home(builder, frame->result[i], scalars[i]);
        }
    }
    if (builder->nesting != frame->nesting) {
        leave(builder, frame->region);
    }
}

// Blocks ---------------------------------------------------------------------------------------------

// Translate a block up to its end. Return the word of the instruction that ends it.
static uint32_t build_block(struct shader_builder *builder, uint32_t label, uint32_t *merge, uint32_t *next)
{
    const struct shader_module *const module = builder->module;
    const struct shader_function *const function = builder->frame->function;
    uint32_t word = label < module->bound ? builder->label_words[label] : 0;
    if (word <= function->word || word >= function->end) {
        shader_build_refuse(builder, "id %u is no label of the function", (unsigned)label);
    }
    if (builder->visited[label] == builder->call) {
        builder->word = word;
        shader_build_refuse(builder, "control flow comes to block %u on ways that do not nest",
                            (unsigned)label);
    }
    builder->visited[label] = builder->call;
    builder->block = label;
    *merge = *next = 0;
    bool may_have_phis = true;
    for (word += 2; word < function->end; word += module->words[word] >> 16) {
        const uint32_t opcode = module->words[word] & 0xffff;
        builder->word = word;
        shader_spend(builder, module->words[word] >> 16);
        if (opcode == SPIRV_OP_Phi && !may_have_phis) {
            shader_build_refuse(builder, "it stands behind other instructions of its block");
        }
        may_have_phis =
            may_have_phis && (opcode == SPIRV_OP_Phi || opcode == SPIRV_OP_Line || opcode == SPIRV_OP_NoLine);
        if (opcode == SPIRV_OP_Label || opcode == SPIRV_OP_FunctionEnd) {
            shader_build_refuse(builder, "block %u has no branch or return at its end", (unsigned)label);
        }
        if (opcode == SPIRV_OP_SelectionMerge) {
            *merge = module->words[word + 1];
        } else if (opcode == SPIRV_OP_LoopMerge) {
            *merge = module->words[word + 1];
            *next = module->words[word + 2];
        } else if (opcode >= SPIRV_OP_Branch && opcode <= SPIRV_OP_Unreachable) {
            return word;
        } else {
            build_instruction(builder, opcode);
        }
    }
    shader_build_refuse(builder, "the function ends within block %u", (unsigned)label);
}

// Translate what a block ends with. Return the label at which control flow goes on in the same construct, or 0.
static uint32_t build_end(struct shader_builder *builder, uint32_t merge, uint32_t stop)
{
    const uint32_t opcode = shader_words(builder)[0] & 0xffff;
    switch (opcode) {
    case SPIRV_OP_Branch: return shader_operand(builder, 1);
    case SPIRV_OP_BranchConditional: build_branch(builder, merge, stop); return merge;
    case SPIRV_OP_Switch:
        if (merge == 0) {
            shader_build_refuse(builder, "a switch needs a merge block");
        }
        build_switch(builder, merge);
        return merge;
    case SPIRV_OP_Kill: (void)shader_emit_with(builder, SHADER_DISCARD, 0, 0, 0, 0); return 0;
    case SPIRV_OP_Return: build_return(builder, false); return 0;
    case SPIRV_OP_ReturnValue: build_return(builder, true); return 0;
    case SPIRV_OP_Unreachable: return 0;
    default: shader_build_refuse(builder, "the instruction is not supported here");
    }
}

// Translate a loop. Its header comes first in every round, then the rest up to the continue target, which lanes may
// come to early, then what stands between that and the branch back.
static void build_loop(struct shader_builder *builder, uint32_t header, uint32_t merge, uint32_t next)
{
    enter(builder);
    shader_forget_all(builder);
    const size_t mark = builder->facts.log_count;
    const uint32_t loop = begin(builder, SHADER_LOOP);
    struct shader_construct left = {.merge = merge, .region = loop, .outer = builder->constructs};
    builder->constructs = &left;
    uint32_t unused[2];
    if (next == header) {
        (void)build_block(builder, header, &unused[0], &unused[1]);
        const uint32_t label = build_end(builder, 0, header);
        if (label != 0) {
            build_from(builder, label, header);
        }
    } else {
        const uint32_t round = begin(builder, SHADER_REGION);
        struct shader_construct continued = {.merge = next, .region = round, .outer = &left};
        builder->constructs = &continued;
        (void)build_block(builder, header, &unused[0], &unused[1]);
        const uint32_t label = build_end(builder, 0, next);
        if (label != 0) {
            build_from(builder, label, next);
        }
        builder->constructs = &left;
        flow(builder, SHADER_END_REGION, 0);
        shader_forget_since(builder, mark);
        go_on_from(builder, next, header);
    }
    builder->constructs = left.outer;
    flow(builder, SHADER_END_LOOP, 0);
    shader_forget_since(builder, mark);
    builder->nesting--;
}

// Return the merge block of the loop that a block begins, or 0.
static uint32_t loop_merge(const struct shader_builder *builder, uint32_t label, uint32_t *next)
{
    const struct shader_module *const module = builder->module;
    uint32_t word = label < module->bound ? builder->label_words[label] : 0;
    for (; word != 0 && word < module->word_count; word += module->words[word] >> 16) {
        const uint32_t opcode = module->words[word] & 0xffff;
        if (opcode == SPIRV_OP_LoopMerge) {
            *next = module->words[word + 2];
            return module->words[word + 1];
        }
        if (opcode >= SPIRV_OP_Branch && opcode <= SPIRV_OP_Unreachable) {
            break;
        }
    }
    return 0;
}

// Control flow has come to a label. Return true if it goes on there in the same construct, and false if the label is
// `stop`, or control flow leaves a construct for it.
static bool comes_to(struct shader_builder *builder, uint32_t label, uint32_t stop)
{
    if (label == stop) {
        return false;
    }
    const struct shader_construct *const construct = find_construct(builder, label);
    if (!construct) {
        return true;
    }
    if (construct->region == 0) {
        shader_build_refuse(
            builder, "control flow leaves a construct for block %u, which is not allowed to be left for",
            (unsigned)label);
    }
    if (construct->fall != 0) {
        shader_set_home(builder, construct->fall, shader_number(builder, UINT32_MAX));
    }
    leave(builder, construct->region);
    return false;
}

// Control flow goes to a label from the block under way. Return what comes_to returns.
static bool goes_to(struct shader_builder *builder, uint32_t label, uint32_t stop)
{
    set_phis(builder, label);
    return comes_to(builder, label, stop);
}

// Translate from a label on, which control flow has come to, until it comes to `stop`.
static void go_on_from(struct shader_builder *builder, uint32_t label, uint32_t stop)
{
    for (;;) {
        uint32_t merge, next;
        const uint32_t behind_loop = loop_merge(builder, label, &next);
        if (behind_loop != 0) {
            build_loop(builder, label, behind_loop, next);
            label = behind_loop;
            if (label == stop) {
                return;
            }
            continue;
        }
        builder->word = build_block(builder, label, &merge, &next);
        const bool branches = (shader_words(builder)[0] & 0xffff) == SPIRV_OP_Branch;
        label = build_end(builder, merge, stop);
        if (label == 0 || (branches ? !goes_to(builder, label, stop) : label == stop)) {
            return;
        }
    }
}

// Translate from a label on, to which control flow goes from the block under way.
static void build_from(struct shader_builder *builder, uint32_t label, uint32_t stop)
{
    if (goes_to(builder, label, stop)) {
        go_on_from(builder, label, stop);
    }
}

uint32_t *shader_build_function(struct shader_builder *builder, const struct shader_function *function)
{
    const uint32_t call = builder->call, block = builder->block;
    struct shader_construct *const constructs = builder->constructs;
    const struct shader_type *const type = function->type->element;
    struct shader_frame frame = {.function = function, .caller = builder->frame};
    enter(builder);
    frame.nesting = builder->nesting;
    if (type->kind != SHADER_VOID) {
        frame.result = shader_new_scalars(builder, type);
        for (uint32_t i = 0; i < type->scalars; i++) {
            frame.result[i] = shader_new_home(builder, 0);
        }
    }
    frame.region = begin(builder, SHADER_REGION);
    const size_t mark = builder->facts.log_count;
    builder->frame = &frame;
    builder->constructs = NULL;
    builder->call = ++builder->calls;
    const uint32_t *const words = builder->module->words;
    uint32_t word = function->word;
    while (word < function->end && (words[word] & 0xffff) != SPIRV_OP_Label) {
        word += words[word] >> 16;
    }
    if (word >= function->end) {
        shader_build_refuse(builder, "function %u has no blocks", (unsigned)function->id);
    }
    go_on_from(builder, words[word + 1], 0);
    flow(builder, SHADER_END_REGION, 0);
    if (builder->program->nodes[frame.region].immediate != 0) {
        shader_forget_since(builder, mark);
    }
    builder->call = call;
    builder->block = block;
    builder->constructs = constructs;
    builder->frame = frame.caller;
    builder->nesting--;
    return frame.result;
}
