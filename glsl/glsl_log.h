// SPDX-License-Identifier: MIT
// What glslang tells, as lines that rhw writes.
#ifndef GLSL_GLSL_LOG_H
#define GLSL_GLSL_LOG_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Return the lines of a log of glslang by malloc, errors before warnings, each "NAME:LINE: what is wrong" and
/// warnings with "warning: " before what is wrong. Lines that only count errors are left out. NULL: memory is out.
char *glsl_log_lines(const char *log, const char *name);

/// Put the first line of a text into `message`.
void glsl_log_first(const char *lines, char *message, size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
