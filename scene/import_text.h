// SPDX-License-Identifier: MIT
// Lines, words and numbers of text formats (OBJ, MTL, PLY), read from memory without copies.
#ifndef RHW_SCENE_IMPORT_TEXT_H
#define RHW_SCENE_IMPORT_TEXT_H

#include "import.h"

/// What is left to read. Lines end with LF, CR or both.
struct rhw_text {
    char *cursor, *end;
    unsigned line; ///< number of the line read last, from 1
};

/// A line or what is left of it.
struct rhw_line {
    const char *cursor, *end;
};

/// A word of a line; not terminated.
struct rhw_word {
    const char *start;
    size_t length;
};

/// Starts at the beginning of bytes that stay where they are; converts UTF-16 (by its mark) to UTF-8 and skips
/// the mark of UTF-8.
struct rhw_text rhw_text_open(struct rhw_import *import, char *bytes, size_t size);
/// The next line; false at the end. With `continued`, a backslash at its end joins the line after it.
bool rhw_text_line(struct rhw_text *text, bool continued, struct rhw_line *line);
/// The next word of a line; false when there is none.
bool rhw_text_word(struct rhw_line *line, struct rhw_word *word);
/// What is left of a line without blanks at its ends.
struct rhw_word rhw_text_rest(struct rhw_line line);
bool rhw_word_is(struct rhw_word word, const char *text); ///< case matters
/// The number at the start of a word; `length` bytes of it were read. False: it starts with none. "nan" and
/// "inf" in any spelling are numbers.
bool rhw_word_number(struct rhw_word word, double *value, size_t *length);
/// Reads up to `most` numbers from a line, and stops at what is none. Returns how many.
int rhw_text_numbers(struct rhw_line *line, float *values, int most);
const char *rhw_word_string(struct rhw_import *import, struct rhw_word word);

#endif
