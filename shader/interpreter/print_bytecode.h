// SPDX-License-Identifier: MIT
// The interpreter's instructions as a text.
#ifndef SHADER_PRINT_BYTECODE_H
#define SHADER_PRINT_BYTECODE_H

#include "bytecode.h"
#include "form/print.h"

// Print the constants and the instructions, a line each. An r is a register that has a vector for each group of 8
// lanes, a u one that has a vector for all of them. Names are those of the form that the instructions were made of.
void shader_print_bytecode(const struct shader_sink *sink, const struct shader_program *program,
                           const struct shader_bytecode *bytecode);

#endif
