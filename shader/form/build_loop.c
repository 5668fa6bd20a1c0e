// SPDX-License-Identifier: MIT
// Loops: a LOOP, or the rounds one behind the other where their number is known and that saves something (rounds.c).
#include "build_flow.h"

uint32_t shader_loop_merge(const struct shader_builder *builder, uint32_t label, uint32_t *next)
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

// Forget what changed since `mark` where lanes leave a construct early.
static void forget_if_left(struct shader_builder *builder, uint32_t region, size_t mark)
{
    if (builder->program->nodes[region].immediate != 0) {
        shader_forget_since(builder, mark);
    }
}

// Translate a block and what follows up to `stop`.
static void build_first(struct shader_builder *builder, uint32_t header, uint32_t stop)
{
    uint32_t unused[2];
    (void)shader_build_block(builder, header, &unused[0], &unused[1]);
    const uint32_t label = shader_build_end(builder, 0, stop);
    if (label != 0) {
        shader_build_from(builder, label, stop);
    }
}

// Translate a round of a loop: its header, then the rest up to the continue target, which lanes may come to early, then
// what stands between that and the branch back.
static void build_round(struct shader_builder *builder, uint32_t header, uint32_t next)
{
    struct shader_construct *const left = builder->constructs;
    const size_t mark = builder->facts.log_count;
    const uint32_t round = begin(builder, SHADER_REGION);
    struct shader_construct continued = {.merge = next, .region = round, .outer = left};
    builder->constructs = &continued;
    build_first(builder, header, next);
    builder->constructs = left;
    flow(builder, SHADER_END_REGION, 0);
    forget_if_left(builder, round, mark);
    shader_go_on_from(builder, next, header);
}

// Translate the blocks of the last round up to the test, which leaves.
static void build_last_round(struct shader_builder *builder, const struct shader_rounds *rounds)
{
    uint32_t label = rounds->header, unused[2];
    (void)shader_build_block(builder, label, &unused[0], &unused[1]);
    while ((shader_words(builder)[0] & 0xffff) == SPIRV_OP_Branch) {
        label = shader_operand(builder, 1);
        shader_set_phis(builder, label);
        (void)shader_build_block(builder, label, &unused[0], &unused[1]);
    }
    builder->block = rounds->from != UINT32_MAX ? rounds->from : label;
    shader_set_phis(builder, rounds->merge);
}

// Blocks are visited once a round.
static void build_rounds(struct shader_builder *builder, const struct shader_rounds *rounds)
{
    const uint32_t call = builder->call;
    const size_t mark = builder->facts.log_count;
    const uint32_t region = begin(builder, SHADER_REGION);
    struct shader_construct left = {.merge = rounds->merge, .region = region, .outer = builder->constructs};
    builder->constructs = &left;
    for (uint32_t i = 0; i <= rounds->count; i++) {
        builder->call = ++builder->calls;
        shader_learn(builder, rounds->home, shader_number(builder, rounds->start + i * rounds->step));
        if (i < rounds->count) {
            build_round(builder, rounds->header, rounds->next);
        } else {
            build_last_round(builder, rounds);
        }
    }
    builder->call = call;
    builder->constructs = left.outer;
    flow(builder, SHADER_END_REGION, 0);
    forget_if_left(builder, region, mark);
}

void shader_build_loop(struct shader_builder *builder, uint32_t header, uint32_t merge, uint32_t next)
{
    struct shader_rounds rounds = {.header = header, .merge = merge, .next = next};
    enter(builder);
    if (shader_count_rounds(builder, &rounds)) {
        build_rounds(builder, &rounds);
        builder->nesting--;
        return;
    }
    shader_forget_all(builder);
    const size_t mark = builder->facts.log_count;
    const uint32_t loop = begin(builder, SHADER_LOOP);
    struct shader_construct left = {.merge = merge, .region = loop, .outer = builder->constructs};
    builder->constructs = &left;
    if (next == header) {
        build_first(builder, header, header);
    } else {
        build_round(builder, header, next);
    }
    builder->constructs = left.outer;
    flow(builder, SHADER_END_LOOP, 0);
    shader_forget_since(builder, mark);
    builder->nesting--;
}
