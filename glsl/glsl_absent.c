// SPDX-License-Identifier: MIT
// A build without glslang compiles no text.
#include <stdio.h>
#include <stdlib.h>

#include "glsl.h"

bool glsl_is_there(void)
{
    return false;
}

bool glsl_compile(enum rhw_shader_stage stage, const char *text, size_t size, const char *name,
                  const struct glsl_options *options, struct glsl_code *code, char *message,
                  size_t message_size)
{
    (void)stage;
    (void)text;
    (void)size;
    (void)options;
    *code = (struct glsl_code){0};
    snprintf(message, message_size, "%s: this rhw was built without glslang, so it reads SPIR-V alone", name);
    return false;
}

char *glsl_disassemble(const uint32_t *words, size_t size, char *message, size_t message_size)
{
    (void)words;
    (void)size;
    snprintf(message, message_size, "this rhw was built without SPIRV-Tools; spirv-dis prints a module");
    return NULL;
}

void glsl_code_free(struct glsl_code *code)
{
    free(code->log);
    free(code->files);
    *code = (struct glsl_code){0};
}
