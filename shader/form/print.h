// SPDX-License-Identifier: MIT
// The form as a text that can be read beside the source.
#ifndef SHADER_PRINT_H
#define SHADER_PRINT_H

#include <stdio.h>

#include "form.h"

// Print the code line by line: v is a value, h a home, # an immediate.
void shader_print(FILE *stream, const struct shader_program *program);

#endif
