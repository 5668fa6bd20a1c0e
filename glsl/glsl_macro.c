// SPDX-License-Identifier: MIT
#include "glsl_macro.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_name(const char *name)
{
    if (!is_letter(name[0]) || strncmp(name, "GL_", 3) == 0 || strstr(name, "__") != NULL) {
        return false;
    }
    for (const char *c = name; *c != 0; c++) {
        if (!is_letter(*c) && !(*c >= '0' && *c <= '9')) {
            return false;
        }
    }
    return true;
}

bool glsl_macros_check(const struct glsl_options *options, char *message, size_t message_size)
{
    for (uint32_t i = 0; i < options->macro_count; i++) {
        const struct glsl_macro *const macro = &options->macros[i];
        if (!is_name(macro->name)) {
            snprintf(
                message, message_size,
                "'%s' cannot be defined: a macro's name has letters, digits and single underscores, and does "
                "not begin with a digit or GL_",
                macro->name);
            return false;
        }
        if (macro->value != NULL && strpbrk(macro->value, "\r\n\\") != NULL) {
            snprintf(message, message_size, "the value of '%s' has a line break or a backslash", macro->name);
            return false;
        }
    }
    return true;
}

char *glsl_macros_print(const struct glsl_options *options)
{
    static const char start[] = "#extension GL_GOOGLE_include_directive : enable\n";
    size_t size = sizeof start;
    for (uint32_t i = 0; i < options->macro_count; i++) {
        const char *const value = options->macros[i].value;
        size += strlen("#define  \n") + strlen(options->macros[i].name) + (value != NULL ? strlen(value) : 0);
    }
    const char *const before = options->before != NULL ? options->before : "";
    size += strlen(before) + 1;
    char *const text = malloc(size);
    if (text == NULL) {
        return NULL;
    }
    size_t length = (size_t)snprintf(text, size, "%s", start);
    for (uint32_t i = 0; i < options->macro_count; i++) {
        const char *const value = options->macros[i].value;
        length += (size_t)snprintf(text + length, size - length, "#define %s %s\n", options->macros[i].name,
                                   value != NULL ? value : "");
    }
    snprintf(text + length, size - length, "%s\n", before);
    return text;
}
