// SPDX-License-Identifier: MIT
// Lines, words and numbers of text formats (OBJ, MTL, PLY), read from memory without copies.
#ifndef SCENE_TEXT_LINES_H
#define SCENE_TEXT_LINES_H

#include "import.h"

/// What is left to read. Lines end with LF, CR or both.
struct scene_text {
    char *cursor, *end;
    unsigned line; ///< number of the line read last, from 1
};

/// A line or what is left of it.
struct scene_line {
    const char *cursor, *end;
};

/// A word of a line; not terminated.
struct scene_word {
    const char *start;
    size_t length;
};

/// Starts at the beginning of bytes that stay where they are; converts UTF-16 (by its mark) to UTF-8 and skips
/// the mark of UTF-8.
struct scene_text scene_text_open(struct scene_import *import, char *bytes, size_t size);
/// The next line; false at the end. With `continued`, a backslash at its end joins the line after it.
bool scene_text_line(struct scene_text *text, bool continued, struct scene_line *line);
/// The next word of a line; false when there is none.
bool scene_text_word(struct scene_line *line, struct scene_word *word);
/// What is left of a line without blanks at its ends and without a comment: a # that stands alone and what follows.
struct scene_word scene_text_rest(struct scene_line line);
bool scene_word_is(struct scene_word word, const char *text); ///< case matters
/// The number at the start of a word; `length` bytes of it were read. False: it starts with none. "nan" and
/// "inf" in any spelling are numbers.
bool scene_word_number(struct scene_word word, double *value, size_t *length);
/// Reads up to `most` numbers from a line, and stops at what is none. Returns how many.
int scene_text_numbers(struct scene_line *line, float *values, int most);
const char *scene_word_string(struct scene_import *import, struct scene_word word);

#endif
