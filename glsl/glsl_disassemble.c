// SPDX-License-Identifier: MIT
// SPIRV-Tools come with glslang, which checks its own code by them, and have a C interface.
#include <spirv-tools/libspirv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "glsl.h"

char *glsl_disassemble(const uint32_t *words, size_t size, char *message, size_t message_size)
{
    const uint32_t options = SPV_BINARY_TO_TEXT_OPTION_INDENT | SPV_BINARY_TO_TEXT_OPTION_FRIENDLY_NAMES;
    spv_text text = NULL;
    spv_diagnostic diagnostic = NULL;
    char *copy = NULL;
    const spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_1);
    if (context != NULL &&
        spvBinaryToText(context, words, size / sizeof *words, options, &text, &diagnostic) == SPV_SUCCESS) {
        copy = malloc(text->length + 1);
    }
    if (copy != NULL) {
        memcpy(copy, text->str, text->length);
        copy[text->length] = 0;
    } else if (diagnostic != NULL) {
        snprintf(message, message_size, "word %zu: %s", diagnostic->position.index, diagnostic->error);
    } else {
        snprintf(message, message_size, "memory is out");
    }
    spvTextDestroy(text);
    spvDiagnosticDestroy(diagnostic);
    spvContextDestroy(context);
    return copy;
}
