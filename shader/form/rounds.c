// SPDX-License-Identifier: MIT
// How often a loop goes round, where it counts from one constant to another. Its rounds are then translated one behind
// the other, so that what the counter picks of arrays is known: a component of an input or a home, no comparison with
// all there are and no memory of the lane. A few rounds of any loop save the masks of the loop. Other loops stay loops.
#include "build_flow.h"

enum {
    MAX_ROUNDS = 64,
    MAX_WORDS = 1 << 14, // words of all rounds of a shader, for each of the kinds of loops
    MAX_DEPTH = 4        // operations between the counter and an index, and blocks between header and test
};

// Bounds of loops whose counter picks nothing, which save their masks, and of those whose counter picks. Four rounds
// are the texels of a shadow's tap, or a scene's lights; longer loops would be much code for little.
static const struct {
    uint32_t rounds, words; // words: of all rounds of a loop
} bounds[2] = {{.rounds = 4, .words = 1 << 12}, {.rounds = MAX_ROUNDS, .words = MAX_WORDS}};

struct loop {
    struct shader_builder *builder;
    const struct shader_rounds *labels;
    uint32_t begin, end; // words: from the label of the header to that of the merge block
    uint32_t counter;    // id of a variable of the function or of a phi of the header
    uint32_t test;       // word of the branch that leaves
    uint32_t step;       // what the counter grows by
};

// Words of the module --------------------------------------------------------------------------------

// Return the instruction whose result an id is.
static const uint32_t *instruction_of(const struct loop *loop, uint32_t id)
{
    const struct shader_module *const module = loop->builder->module;
    return module->words + (id < module->bound ? module->ids[id].word : 0);
}

static uint32_t opcode_of(const struct loop *loop, uint32_t id)
{
    const struct shader_module *const module = loop->builder->module;
    return id < module->bound ? module->ids[id].opcode : 0;
}

static bool is_constant(const struct loop *loop, uint32_t id, uint32_t *bits)
{
    const uint32_t opcode = opcode_of(loop, id);
    if (opcode < SPIRV_OP_ConstantTrue || opcode > SPIRV_OP_SpecConstantOp) {
        return false;
    }
    const struct shader_constant *const constant = loop->builder->module->ids[id].data.as_constant;
    if (!constant || !constant->scalars) {
        return false;
    }
    *bits = constant->scalars[0];
    return constant->type->kind == SHADER_INT && constant->type->bits == 32;
}

// Return the word of the instruction that ends a block, or 0 where it does not end before the loop does.
static uint32_t end_of_block(const struct loop *loop, uint32_t label, bool *has_merge)
{
    const struct shader_module *const module = loop->builder->module;
    uint32_t word = label < module->bound ? loop->builder->label_words[label] : 0;
    if (word < loop->begin) {
        return 0;
    }
    *has_merge = false;
    for (; word < loop->end; word += module->words[word] >> 16) {
        const uint32_t opcode = module->words[word] & 0xffff;
        *has_merge = *has_merge || opcode == SPIRV_OP_SelectionMerge || opcode == SPIRV_OP_LoopMerge;
        if (opcode >= SPIRV_OP_Branch && opcode <= SPIRV_OP_Unreachable) {
            return word;
        }
    }
    return 0;
}

// The counter ----------------------------------------------------------------------------------------

// Return the variable that a value of the loop was loaded from, or the phi that it is, or 0.
static uint32_t counter_of(const struct loop *loop, uint32_t id)
{
    const uint32_t *const words = instruction_of(loop, id), *const first = loop->builder->module->words;
    if (opcode_of(loop, id) == SPIRV_OP_Load && words > first + loop->begin && words < first + loop->end) {
        const bool is_variable = opcode_of(loop, words[3]) == SPIRV_OP_Variable;
        return is_variable && instruction_of(loop, words[3])[3] == SPIRV_FUNCTION ? words[3] : 0;
    }
    return opcode_of(loop, id) == SPIRV_OP_Phi ? id : 0;
}

// Return the home of the counter, or SHADER_NO_VALUE where it is no number of 32 bits.
static uint32_t home_of(const struct loop *loop)
{
    const struct shader_built *const built = &loop->builder->built[loop->counter];
    if (opcode_of(loop, loop->counter) == SPIRV_OP_Phi) {
        const struct shader_module *const module = loop->builder->module;
        const struct shader_type *const type =
            shader_value_type(module, module->ids[loop->counter].word, loop->counter);
        return built->phi && type->kind == SHADER_INT && type->bits == 32 ? built->phi[0] : SHADER_NO_VALUE;
    }
    const struct shader_place *const place = built->place;
    const bool is_number = place && place->kind == SHADER_PLACE_HOMES && place->type->kind == SHADER_INT;
    return is_number && place->type->bits == 32 ? place->scalars[0] : SHADER_NO_VALUE;
}

// Set what a value adds to the counter.
static bool find_step(struct loop *loop, uint32_t id)
{
    const uint32_t *const words = instruction_of(loop, id), opcode = opcode_of(loop, id);
    if (opcode == SPIRV_OP_ISub && counter_of(loop, words[3]) == loop->counter &&
        is_constant(loop, words[4], &loop->step)) {
        loop->step = 0 - loop->step;
        return true;
    }
    for (int i = 3; i < 5 && opcode == SPIRV_OP_IAdd; i++) {
        if (counter_of(loop, words[i]) == loop->counter && is_constant(loop, words[7 - i], &loop->step)) {
            return true;
        }
    }
    return false;
}

// Return whether a variable has another name in its function.
static bool has_alias(const struct loop *loop)
{
    const struct shader_function *const function = loop->builder->frame->function;
    const uint32_t *const words = loop->builder->module->words;
    shader_spend(loop->builder, function->end - function->word);
    for (uint32_t word = function->word; word < function->end; word += words[word] >> 16) {
        const uint32_t opcode = words[word] & 0xffff;
        const bool makes_name = opcode == SPIRV_OP_CopyObject || opcode == SPIRV_OP_AccessChain ||
                                opcode == SPIRV_OP_InBoundsAccessChain;
        if (makes_name && words[word + 3] == loop->counter) {
            return true;
        }
    }
    return false;
}

// Return what a variable is set to in the continue block, or 0 where another instruction than this one changes it.
static uint32_t stored_value(const struct loop *loop, uint32_t last)
{
    const uint32_t *const words = loop->builder->module->words;
    const uint32_t next = loop->builder->label_words[loop->labels->next];
    uint32_t value = 0;
    for (uint32_t word = loop->begin; word < loop->end; word += words[word] >> 16) {
        const uint32_t opcode = words[word] & 0xffff, count = words[word] >> 16;
        bool is_named = false;
        for (uint32_t i = 1; i < count; i++) {
            is_named = is_named || words[word + i] == loop->counter;
        }
        if (!is_named || (opcode == SPIRV_OP_Load && words[word + 3] == loop->counter)) {
            continue;
        }
        const bool is_set = opcode == SPIRV_OP_Store && words[word + 1] == loop->counter;
        if (!is_set || value != 0 || word < next || word > last) {
            return 0;
        }
        value = words[word + 2];
    }
    return value;
}

// Return what a phi of the header is from the second round on, or 0.
static uint32_t value_of_phi(const struct loop *loop)
{
    const uint32_t *const words = instruction_of(loop, loop->counter), count = words[0] >> 16;
    const struct shader_builder *const builder = loop->builder;
    bool has_merge;
    const uint32_t header = builder->label_words[loop->labels->header];
    if (words < builder->module->words + header ||
        words > builder->module->words + end_of_block(loop, loop->labels->header, &has_merge)) {
        return 0;
    }
    for (uint32_t i = 3; i + 1 < count; i += 2) {
        if (words[i + 1] == loop->labels->next) {
            return words[i];
        }
    }
    return 0;
}

// The continue block has to be one block that goes back, and to change the counter by a constant.
static bool counts_evenly(struct loop *loop)
{
    const uint32_t *const words = loop->builder->module->words;
    bool has_merge;
    const uint32_t last = end_of_block(loop, loop->labels->next, &has_merge);
    if (last == 0 || has_merge || (words[last] & 0xffff) != SPIRV_OP_Branch ||
        words[last + 1] != loop->labels->header) {
        return false;
    }
    const bool is_phi = opcode_of(loop, loop->counter) == SPIRV_OP_Phi;
    const uint32_t value = is_phi ? value_of_phi(loop) : stored_value(loop, last);
    return value != 0 && find_step(loop, value);
}

// Return whether a value follows from the counter and constants, as an index does.
static bool follows(const struct loop *loop, uint32_t id, int depth)
{
    const uint32_t *const words = instruction_of(loop, id), opcode = opcode_of(loop, id);
    if (counter_of(loop, id) == loop->counter) {
        return true;
    }
    switch (opcode) {
    case SPIRV_OP_IAdd:
    case SPIRV_OP_ISub:
    case SPIRV_OP_IMul:
    case SPIRV_OP_UDiv:
    case SPIRV_OP_UMod:
    case SPIRV_OP_Bitcast:
    case SPIRV_OP_ShiftLeftLogical:
    case SPIRV_OP_ShiftRightLogical:
    case SPIRV_OP_BitwiseAnd:
    case SPIRV_OP_BitwiseXor:
    case SPIRV_OP_ExtInst: break; // min and clamp keep an index in its bounds
    default: return false;
    }
    const uint32_t first = opcode == SPIRV_OP_ExtInst ? 5 : 3;
    shader_spend(loop->builder, 1);
    for (uint32_t i = first; i < words[0] >> 16 && i < first + 3 && depth < MAX_DEPTH; i++) {
        if (follows(loop, words[i], depth + 1)) {
            return true;
        }
    }
    return false;
}

// Return whether the counter picks from what a lane has for itself.
static bool picks(const struct loop *loop)
{
    const struct shader_module *const module = loop->builder->module;
    for (uint32_t word = loop->begin; word < loop->end; word += module->words[word] >> 16) {
        const uint32_t *const words = module->words + word, opcode = words[0] & 0xffff;
        if (opcode == SPIRV_OP_VectorExtractDynamic && follows(loop, words[4], 0)) {
            return true;
        }
        if (opcode != SPIRV_OP_AccessChain && opcode != SPIRV_OP_InBoundsAccessChain) {
            continue;
        }
        const struct shader_type *const type = shader_type_of_id(module, word, words[1]);
        const bool is_own = type->storage == SPIRV_INPUT || type->storage == SPIRV_OUTPUT ||
                            type->storage == SPIRV_FUNCTION || type->storage == SPIRV_PRIVATE;
        for (uint32_t i = 4; i < words[0] >> 16 && is_own; i++) {
            if (follows(loop, words[i], 0)) {
                return true;
            }
        }
    }
    return false;
}

// The body -------------------------------------------------------------------------------------------

// Return whether a branch goes to a block between header and merge block, or to the merge block. Note one that goes
// there and is not the test's.
static bool stays(const struct loop *loop, uint32_t label, uint32_t word, bool *leaves_early)
{
    const uint32_t at = label < loop->builder->module->bound ? loop->builder->label_words[label] : 0;
    if (label == loop->labels->merge) {
        const uint32_t from = loop->labels->from;
        const bool is_test =
            word == loop->test || (from != UINT32_MAX && word == loop->builder->label_words[from] + 2);
        *leaves_early = *leaves_early || !is_test;
        return true;
    }
    return at >= loop->begin && at < loop->end;
}

// Return whether all blocks stand between header and merge block, to which control flow goes from them.
static bool is_closed(const struct loop *loop, bool *leaves_early)
{
    const uint32_t *const words = loop->builder->module->words;
    bool is_inside = true;
    for (uint32_t word = loop->begin; word < loop->end && is_inside; word += words[word] >> 16) {
        const uint32_t opcode = words[word] & 0xffff, count = words[word] >> 16;
        const bool is_switch = opcode == SPIRV_OP_Switch;
        const uint32_t end = opcode == SPIRV_OP_Branch ? 2 : opcode == SPIRV_OP_BranchConditional ? 4 : count;
        if (opcode != SPIRV_OP_Branch && opcode != SPIRV_OP_BranchConditional && !is_switch) {
            continue;
        }
        for (uint32_t i = opcode == SPIRV_OP_Branch ? 1 : 2; i < end; i += is_switch ? 2 : 1) {
            is_inside = is_inside && stays(loop, words[word + i], word, leaves_early);
        }
    }
    return is_inside;
}

// Return whether what stands behind the loop uses a value of its blocks, which lanes that left early have of another
// round than others. What phis of the merge block take is set in the round in which a lane leaves.
static bool is_read_behind(const struct loop *loop)
{
    const struct shader_module *const module = loop->builder->module;
    const uint32_t *const words = module->words, end = loop->builder->frame->function->end;
    uint32_t word = loop->end + 2;
    shader_spend(loop->builder, end - loop->end);
    while (word < end && (words[word] & 0xffff) == SPIRV_OP_Phi) {
        word += words[word] >> 16;
    }
    for (; word < end; word += words[word] >> 16) {
        for (uint32_t i = 1; i < words[word] >> 16; i++) {
            const uint32_t id = words[word + i];
            const uint32_t at = id < module->bound ? module->ids[id].word : 0;
            if (at >= loop->begin && at < loop->end) {
                return true;
            }
        }
    }
    return false;
}

// Return about how much words are translated to: how many there are, and the numbers of values that they make or store.
// Functions that they call count too.
static uint64_t cost_of(const struct loop *loop, uint32_t begin, uint32_t end, int depth)
{
    const struct shader_module *const module = loop->builder->module;
    uint64_t cost = end - begin;
    shader_spend(loop->builder, end - begin);
    for (uint32_t word = begin; word < end && cost < MAX_WORDS; word += module->words[word] >> 16) {
        const uint32_t *const words = module->words + word, count = words[0] >> 16;
        if ((words[0] & 0xffff) == SPIRV_OP_FunctionCall) {
            const struct shader_function *const function =
                count > 3 && words[3] < module->bound && module->ids[words[3]].opcode == SPIRV_OP_Function
                    ? module->ids[words[3]].data.as_function
                    : NULL;
            cost += function && depth < MAX_DEPTH ? cost_of(loop, function->word, function->end, depth + 1)
                                                  : MAX_WORDS;
            continue;
        }
        const uint32_t id = (words[0] & 0xffff) == SPIRV_OP_Store ? words[2] : count > 2 ? words[2] : 0;
        const uint32_t type = id < module->bound ? module->ids[id].type : 0;
        cost += type != 0 ? shader_type_of_id(module, word, type)->scalars : 0;
    }
    return cost;
}

// The test -------------------------------------------------------------------------------------------

// Find the branch that leaves: the header ends with it, or a block that always follows.
static bool find_test(struct loop *loop)
{
    const uint32_t *const words = loop->builder->module->words;
    uint32_t label = loop->labels->header;
    for (int blocks = 0; blocks < MAX_DEPTH; blocks++) {
        bool has_merge;
        const uint32_t end = end_of_block(loop, label, &has_merge);
        const uint32_t opcode = end != 0 ? words[end] & 0xffff : 0;
        if (opcode == SPIRV_OP_BranchConditional) {
            loop->test = end;
            return true;
        }
        if (opcode != SPIRV_OP_Branch || (has_merge && label != loop->labels->header) ||
            words[end + 1] == loop->labels->next) {
            return false;
        }
        label = words[end + 1];
    }
    return false;
}

// Return the label of the block from which control flow goes to the merge block when it takes a way of the test: the
// way's own block where that does nothing else, 0 where it goes elsewhere.
static uint32_t leaves_from(const struct loop *loop, uint32_t label)
{
    const uint32_t *const words = loop->builder->module->words;
    bool has_merge;
    if (label == loop->labels->merge) {
        return UINT32_MAX;
    }
    const uint32_t end = end_of_block(loop, label, &has_merge);
    const bool is_empty = end != 0 && end == loop->builder->label_words[label] + 2;
    return is_empty && (words[end] & 0xffff) == SPIRV_OP_Branch && words[end + 1] == loop->labels->merge
               ? label
               : 0;
}

static bool compare(uint32_t opcode, uint32_t a, uint32_t b)
{
    const int32_t s = (int32_t)a, t = (int32_t)b;
    switch (opcode) {
    case SPIRV_OP_IEqual: return a == b;
    case SPIRV_OP_INotEqual: return a != b;
    case SPIRV_OP_UGreaterThan: return a > b;
    case SPIRV_OP_SGreaterThan: return s > t;
    case SPIRV_OP_UGreaterThanEqual: return a >= b;
    case SPIRV_OP_SGreaterThanEqual: return s >= t;
    case SPIRV_OP_ULessThan: return a < b;
    case SPIRV_OP_SLessThan: return s < t;
    case SPIRV_OP_ULessThanEqual: return a <= b;
    default: return s <= t;
    }
}

// Count the rounds in which the condition is not the one that leaves. Return false where there are too many.
static bool count(struct loop *loop, uint32_t condition, bool leaves, struct shader_rounds *rounds)
{
    const uint32_t *words = instruction_of(loop, condition);
    uint32_t opcode = opcode_of(loop, condition), bound, value;
    for (int i = 0; i < MAX_DEPTH && opcode == SPIRV_OP_LogicalNot; i++) {
        condition = words[3];
        words = instruction_of(loop, condition);
        opcode = opcode_of(loop, condition);
        leaves = !leaves;
    }
    if (opcode < SPIRV_OP_IEqual || opcode > SPIRV_OP_SLessThanEqual) {
        return false;
    }
    const bool is_second = is_constant(loop, words[3], &bound);
    if (!is_second && !is_constant(loop, words[4], &bound)) {
        return false;
    }
    loop->counter = counter_of(loop, words[is_second ? 4 : 3]);
    const uint32_t home = loop->counter != 0 ? home_of(loop) : SHADER_NO_VALUE;
    const uint32_t known = home != SHADER_NO_VALUE ? loop->builder->facts.known[home] : SHADER_NO_VALUE;
    if (known == SHADER_NO_VALUE || !shader_is_number(loop->builder, known, &value) || !counts_evenly(loop)) {
        return false;
    }
    *rounds = (struct shader_rounds){rounds->header, rounds->merge,  rounds->next,
                                     .home = home,   .start = value, .step = loop->step};
    while (compare(opcode, is_second ? bound : value, is_second ? value : bound) != leaves) {
        value += loop->step;
        if (++rounds->count > MAX_ROUNDS) {
            return false;
        }
    }
    return true;
}

bool shader_count_rounds(struct shader_builder *builder, struct shader_rounds *rounds)
{
    const uint32_t bound = builder->module->bound;
    if (rounds->merge >= bound || rounds->next >= bound || rounds->next == rounds->header) {
        return false;
    }
    struct loop loop = {.builder = builder,
                        .labels = rounds,
                        .begin = builder->label_words[rounds->header],
                        .end = builder->label_words[rounds->merge]};
    if (loop.end > builder->frame->function->end || loop.begin >= loop.end) {
        return false;
    }
    shader_spend(builder, loop.end - loop.begin);
    if (!find_test(&loop)) {
        return false;
    }
    const uint32_t *const words = builder->module->words + loop.test;
    const uint32_t if_true = leaves_from(&loop, words[2]), if_false = leaves_from(&loop, words[3]);
    if ((if_true == 0) == (if_false == 0) || !count(&loop, words[1], if_true != 0, rounds)) {
        return false;
    }
    rounds->from = if_true != 0 ? if_true : if_false;
    bool leaves_early = false;
    const bool has_index = picks(&loop);
    if (rounds->count > bounds[has_index].rounds || !is_closed(&loop, &leaves_early)) {
        return false;
    }
    // What looks at all of the function comes last: few loops get here, since their words are counted.
    const uint64_t cost = cost_of(&loop, loop.begin, loop.end, 0) * (rounds->count + 1);
    if (cost > bounds[has_index].words || cost > MAX_WORDS - builder->repeated[has_index] ||
        has_alias(&loop) || (leaves_early && is_read_behind(&loop))) {
        return false;
    }
    builder->repeated[has_index] += (uint32_t)cost;
    return true;
}
