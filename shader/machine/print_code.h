// SPDX-License-Identifier: MIT
// Machine code as a text, made of what the encoder was asked for.
#ifndef SHADER_PRINT_CODE_H
#define SHADER_PRINT_CODE_H

#include "encoder.h"
#include "form/print.h"

enum { SHADER_INSTRUCTION_TEXT = 128 };

// Write an instruction in Intel's syntax, as an assembler reads it behind ".intel_syntax noprefix": jumps go to labels
// L0, L1, …, and constants lie at distances from the label `pool`.
void shader_write_instruction(const struct shader_encoder *encoder, const struct shader_record *record,
                              char text[SHADER_INSTRUCTION_TEXT]);

// Print code that is finished and was recorded: places, bytes and instructions. Beside the first instruction of a node
// stands the node, as the form is printed, and before it the line of the source, if the module knows it.
void shader_print_code(const struct shader_sink *sink, const struct shader_program *program,
                       const struct shader_encoder *encoder);

#endif
