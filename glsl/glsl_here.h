// SPDX-License-Identifier: MIT
// The compiler in this process.
#ifndef GLSL_GLSL_HERE_H
#define GLSL_GLSL_HERE_H

#include "glsl.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Make the tables of glslang that all texts share, once. Return false if there is no memory for them.
bool glsl_prepare(void);

/// Compile as glsl_compile does, but in this process, which a text may crash. The options are not NULL.
bool glsl_compile_here(enum rhw_shader_stage stage, const char *text, size_t size, const char *name,
                       const struct glsl_options *options, struct glsl_code *code, char *message,
                       size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
