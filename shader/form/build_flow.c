// SPDX-License-Identifier: MIT
// Control flow: blocks of SPIR-V, which name where they come together again, become nested IF, REGION and LOOP.
//
// A construct ends at its merge block. Where control flow comes to the label at which the innermost construct goes on,
// nothing is to be done; where it comes to the label of a construct further out, lanes leave that construct.
#include "build_flow.h"

// Labels and constructs ------------------------------------------------------------------------------

static struct shader_construct *find_construct(struct shader_builder *builder, uint32_t label)
{
    struct shader_construct *construct = builder->constructs;
    while (construct && construct->merge != label) {
        construct = construct->outer;
        shader_spend(builder, 1);
    }
    return construct;
}

// Instructions of a block that stand before its end --------------------------------------------------

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
    case SPIRV_OP_Phi: shader_build_phi(builder); return;
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
        shader_build_from(builder, bits ? if_true : if_false, stop);
        builder->nesting--;
        return;
    }
    const size_t mark = builder->facts.log_count;
    flow(builder, SHADER_IF, condition);
    shader_build_from(builder, if_true, stop);
    shader_rewind_facts(builder, mark);
    flow(builder, SHADER_ELSE, 0);
    builder->block = block;
    shader_build_from(builder, if_false, stop);
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

uint32_t shader_build_block(struct shader_builder *builder, uint32_t label, uint32_t *merge, uint32_t *next)
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

uint32_t shader_build_end(struct shader_builder *builder, uint32_t merge, uint32_t stop)
{
    const uint32_t opcode = shader_words(builder)[0] & 0xffff;
    switch (opcode) {
    case SPIRV_OP_Branch: return shader_operand(builder, 1);
    case SPIRV_OP_BranchConditional: build_branch(builder, merge, stop); return merge;
    case SPIRV_OP_Switch:
        if (merge == 0) {
            shader_build_refuse(builder, "a switch needs a merge block");
        }
        shader_build_switch(builder, merge);
        return merge;
    case SPIRV_OP_Kill: (void)shader_emit_with(builder, SHADER_DISCARD, 0, 0, 0, 0); return 0;
    case SPIRV_OP_Return: build_return(builder, false); return 0;
    case SPIRV_OP_ReturnValue: build_return(builder, true); return 0;
    case SPIRV_OP_Unreachable: return 0;
    default: shader_build_refuse(builder, "the instruction is not supported here");
    }
}

bool shader_comes_to(struct shader_builder *builder, uint32_t label, uint32_t stop)
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

// Control flow goes to a label from the block under way. Return what shader_comes_to returns.
static bool goes_to(struct shader_builder *builder, uint32_t label, uint32_t stop)
{
    shader_set_phis(builder, label);
    return shader_comes_to(builder, label, stop);
}

void shader_go_on_from(struct shader_builder *builder, uint32_t label, uint32_t stop)
{
    for (;;) {
        uint32_t merge, next;
        const uint32_t behind_loop = shader_loop_merge(builder, label, &next);
        if (behind_loop != 0) {
            shader_build_loop(builder, label, behind_loop, next);
            label = behind_loop;
            if (label == stop) {
                return;
            }
            continue;
        }
        builder->word = shader_build_block(builder, label, &merge, &next);
        const bool branches = (shader_words(builder)[0] & 0xffff) == SPIRV_OP_Branch;
        label = shader_build_end(builder, merge, stop);
        if (label == 0 || (branches ? !goes_to(builder, label, stop) : label == stop)) {
            return;
        }
    }
}

void shader_build_from(struct shader_builder *builder, uint32_t label, uint32_t stop)
{
    if (goes_to(builder, label, stop)) {
        shader_go_on_from(builder, label, stop);
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
    shader_go_on_from(builder, words[word + 1], 0);
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
