// SPDX-License-Identifier: MIT
// Passes over the form. Each keeps its meaning.
#ifndef SHADER_PASS_H
#define SHADER_PASS_H

#include "form.h"

// gradient.c. Compute what gradients of samples alone need where the texture and the sampler that are bound need them.
void shader_ask_for_gradients(struct shader_program *program);
// keep.c. Give a home to every value that is read behind the IF, REGION or LOOP in which it is computed: lanes that
// were not active there, or have left a loop before its last round, read what they last computed, or 0.
void shader_keep_values(struct shader_program *program);
// simplify.c. Replace operations by others that cost less and have the same bits.
void shader_simplify(struct shader_program *program);
// common.c. Compute values once that are computed twice from the same operands.
void shader_share_values(struct shader_program *program);
// copies.c. Read homes and values themselves instead of copies that hold the same wherever they are read.
void shader_forward_copies(struct shader_program *program);
// dead.c. Take out what nothing reads, and structure that holds nothing.
void shader_remove_dead(struct shader_program *program);
// derivative.c. Replace DDX and DDY.
void shader_build_derivatives(struct shader_program *program);
// uniform.c. Mark values that are the same in all lanes of a call.
void shader_mark_uniform(struct shader_program *program);
// dynamic.c. Mark values that are the same in all lanes that are active, as the counters of loops are.
void shader_mark_dynamically_uniform(struct shader_program *program);

// uniform.c. Return whether a value depends on the lane whatever its operands are.
bool shader_is_varying(enum shader_op op);

// All of them, in the order that back ends expect.
void shader_run_passes(struct shader_program *program);

#endif
