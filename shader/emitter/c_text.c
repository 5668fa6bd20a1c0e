// SPDX-License-Identifier: MIT
// See c_text.h.
#include "c_text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { INDENT = 4 };

static const char *format_list(struct shader_memory *memory, const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    const int length = vsnprintf(NULL, 0, format, again);
    va_end(again);
    char *const bytes = shader_take(memory, (size_t)length + 1, 1);
    vsnprintf(bytes, (size_t)length + 1, format, arguments);
    return bytes;
}

const char *shader_format(struct shader_memory *memory, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const char *const bytes = format_list(memory, format, arguments);
    va_end(arguments);
    return bytes;
}

const char *shader_c_clean(struct shader_memory *memory, const char *name)
{
    const size_t length = name ? strlen(name) : 0;
    char *const clean = shader_take(memory, length + 1, 1);
    for (size_t i = 0; i < length; i++) {
        const unsigned char c = (unsigned char)name[i];
        clean[i] = c >= ' ' && c < 0x7f && c != '\\' && c != '*' && c != '?' ? (char)c : '_';
    }
    return clean;
}

static void add_bytes(struct shader_text *text, const char *bytes, size_t count)
{
    while (text->count + count + 1 > text->room) {
        text->bytes = shader_grow(text->memory, text->bytes, &text->room, 1);
    }
    memcpy(text->bytes + text->count, bytes, count);
    text->count += count;
    text->bytes[text->count] = '\0';
}

void shader_text_add(struct shader_text *text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const char *const bytes = format_list(text->memory, format, arguments);
    va_end(arguments);
    add_bytes(text, bytes, strlen(bytes));
}

void shader_text_line(struct shader_text *text, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const char *const bytes = format_list(text->memory, format, arguments);
    va_end(arguments);
    const size_t length = strlen(bytes);
    text->depth -= bytes[0] == '}' ? 1 : 0;
    for (int i = 0; i < text->depth * INDENT && length > 0; i++) {
        add_bytes(text, " ", 1);
    }
    add_bytes(text, bytes, length);
    add_bytes(text, "\n", 1);
    text->depth += length > 0 && bytes[length - 1] == '{' ? 1 : 0;
}

const char *shader_text_bytes(const struct shader_text *text)
{
    return text->bytes ? text->bytes : "";
}
