// SPDX-License-Identifier: MIT
// The lines before a text: macros, and what else a caller puts there.
#ifndef GLSL_GLSL_MACRO_H
#define GLSL_GLSL_MACRO_H

#include "glsl.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Return whether macros can be defined by a line each. Put what is wrong into `message` otherwise.
bool glsl_macros_check(const struct glsl_options *options, char *message, size_t message_size);

/// Return the lines that go before a text, by malloc. NULL: memory is out.
char *glsl_macros_print(const struct glsl_options *options);

#ifdef __cplusplus
}
#endif

#endif
