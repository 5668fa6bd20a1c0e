// SPDX-License-Identifier: MIT
// From the form to instructions with registers.
#ifndef SHADER_ASSEMBLE_H
#define SHADER_ASSEMBLE_H

#include "bytecode.h"
#include "form/form.h"

// The result lies in the memory of the program.
struct shader_bytecode *shader_assemble(struct shader_program *program);

#endif
