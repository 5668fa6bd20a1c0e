// SPDX-License-Identifier: MIT
// Texts that grow in the memory of a translation.
#ifndef SHADER_C_TEXT_H
#define SHADER_C_TEXT_H

#include "module/memory.h"

struct shader_text {
    struct shader_memory *memory;
    char *bytes; // `count` of them and a 0, or NULL
    size_t count, room;
    int depth; // open braces
};

// Return a text of its own.
const char *shader_format(struct shader_memory *memory, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Return a name of a module as it may stand in a comment: bytes that could end the comment are taken out. NULL gives
// "".
const char *shader_c_clean(struct shader_memory *memory, const char *name);
// Add to the end of the text.
void shader_text_add(struct shader_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
// Add a line, which begins where its depth says. A brace at its end opens a block, one at its begin closes a block.
void shader_text_line(struct shader_text *text, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
const char *shader_text_bytes(const struct shader_text *text);

#endif
