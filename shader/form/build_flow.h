// SPDX-License-Identifier: MIT
// What the files that translate control flow share.
#ifndef SHADER_BUILD_FLOW_H
#define SHADER_BUILD_FLOW_H

#include "build.h"

static inline void enter(struct shader_builder *builder)
{
    if (++builder->nesting > SHADER_MAX_NESTING) {
        shader_build_refuse(builder, "control flow is nested more than %d deep", SHADER_MAX_NESTING);
    }
}

static inline void flow(struct shader_builder *builder, enum shader_op op, uint32_t operand)
{
    (void)shader_emit_with(builder, op, 0, operand, 0, 0);
}

// Take active lanes out of a construct. The number 1 in its node tells that some leave it.
static inline void leave(struct shader_builder *builder, uint32_t region)
{
    builder->program->nodes[region].immediate = 1;
    flow(builder, SHADER_LEAVE, region);
}

static inline uint32_t begin(struct shader_builder *builder, enum shader_op op)
{
    return shader_emit_with(builder, op, 0, 0, 0, 0);
}

// A loop whose rounds are counted when the shader is translated.
struct shader_rounds {
    uint32_t header, merge, next; // labels
    uint32_t count;               // rounds that are whole; the next one leaves at the test
    uint32_t from;              // label of an empty block between the test and the merge block, or UINT32_MAX
    uint32_t home, start, step; // the counter: its home, what it begins with and grows by
};

// build_flow.c. Control flow has come to a label. Return true if it goes on there in the same construct, and false if
// the label is `stop`, or control flow leaves a construct for it.
bool shader_comes_to(struct shader_builder *builder, uint32_t label, uint32_t stop);
// Translate from a label on, which control flow has come to, until it comes to `stop`.
void shader_go_on_from(struct shader_builder *builder, uint32_t label, uint32_t stop);
// Translate from a label on, to which control flow goes from the block under way.
void shader_build_from(struct shader_builder *builder, uint32_t label, uint32_t stop);
// Translate a block up to its end. Return the word of the instruction that ends it.
uint32_t shader_build_block(struct shader_builder *builder, uint32_t label, uint32_t *merge, uint32_t *next);
// Translate what a block ends with. Return the label at which control flow goes on in the same construct, or 0.
uint32_t shader_build_end(struct shader_builder *builder, uint32_t merge, uint32_t stop);
// build_loop.c. Return the merge block of the loop that a block begins, or 0.
uint32_t shader_loop_merge(const struct shader_builder *builder, uint32_t label, uint32_t *next);
void shader_build_loop(struct shader_builder *builder, uint32_t header, uint32_t merge, uint32_t next);
// rounds.c. Set how many rounds a loop with these labels makes, and return whether they are to stand one behind the
// other.
bool shader_count_rounds(struct shader_builder *builder, struct shader_rounds *rounds);
// build_phi.c. Give the phis of a block what they take from the block that control flow comes from.
void shader_set_phis(struct shader_builder *builder, uint32_t label);
void shader_build_phi(struct shader_builder *builder);
// build_switch.c. Translate a switch, which ends a block, with its cases.
void shader_build_switch(struct shader_builder *builder, uint32_t merge);

#endif
