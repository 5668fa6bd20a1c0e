// SPDX-License-Identifier: MIT
// Lines, words and numbers of text formats (OBJ, MTL, OFF, PLY), read from memory without copies.
#ifndef SCENE_TEXT_LINES_H
#define SCENE_TEXT_LINES_H

#include "import.h"

/// The text that is left to read. Lines end with LF, CR or both.
struct scene_text {
    char *cursor, *end;
    unsigned line; ///< number of the line read last, from 1
};

/// A line, or what is left of it.
struct scene_line {
    const char *cursor, *end;
};

/// A word of a line. It has no terminating 0.
struct scene_word {
    const char *start;
    size_t length;
};

/// Return the length of the byte order marks of UTF-8 that a text begins with. Programs put one before another.
size_t scene_text_marks(const void *text, size_t size);
/// Start at the beginning of bytes that stay where they are. Convert UTF-16 (by its mark) to UTF-8, and skip marks of
/// UTF-8.
struct scene_text scene_text_open(struct scene_import *import, char *bytes, size_t size);
/// Read the next line. Return false at the end. With `continued`, a backslash at its end joins the line after it.
bool scene_text_line(struct scene_text *text, bool continued, struct scene_line *line);
/// Read the next word of a line. Return false if there is none.
bool scene_text_word(struct scene_line *line, struct scene_word *word);
/// Return what is left of a line without blanks at its ends and without a comment, which is a # that stands alone and
/// what follows.
struct scene_word scene_text_rest(struct scene_line line);
bool scene_word_is(struct scene_word word, const char *text); ///< case matters
/// Read the number at the start of a word, and set `length` to its bytes. Return false if the word starts with none.
/// "nan" and "inf" in any spelling are numbers.
bool scene_word_number(struct scene_word word, double *value, size_t *length);
/// Read the number at the start of a word that ends at `end` or before one of `separators`, and return where it ends.
/// Return NULL if there is none. The time it takes is that of the number, however long the word is, so that text in
/// which numbers follow each other without separators is read in one pass.
const char *scene_number_read(const char *text, const char *end, const char *separators, double *value);
/// Read the number at the start of the next word of a line. Return false, and stay, if the word starts with none.
bool scene_text_double(struct scene_line *line, double *value);
/// Read up to `most` numbers from a line, and stop at a word that is none. Return how many were read.
int scene_text_numbers(struct scene_line *line, float *values, int most);
int scene_text_doubles(struct scene_line *line, double *values, int most);
const char *scene_word_string(struct scene_import *import, struct scene_word word);
/// Return the bytes of a word as they are, for names of files and what else is compared with bytes.
const char *scene_word_bytes(struct scene_import *import, struct scene_word word);

#endif
