// SPDX-License-Identifier: MIT
// Lines, words and numbers.
#include "text_lines.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "decimal.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == 0;
}

// Convert UTF-16 to UTF-8. A code that is no character becomes '?'.
static struct scene_text convert_wide(struct scene_import *import, const unsigned char *bytes, size_t size,
                                      bool big)
{
    char *out = scene_import_allocate(import, size / 2 + 1, 3), *next = out;
    for (size_t i = 2; i + 1 < size; i += 2) {
        const unsigned unit = big ? bytes[i] * 256u + bytes[i + 1] : bytes[i + 1] * 256u + bytes[i];
        if (unit < 0x80) {
            *next++ = (char)unit;
        } else if (unit < 0x800) {
            *next++ = (char)(0xc0 | unit >> 6);
            *next++ = (char)(0x80 | (unit & 63));
        } else if (unit < 0xd800 || unit > 0xdfff) {
            *next++ = (char)(0xe0 | unit >> 12);
            *next++ = (char)(0x80 | (unit >> 6 & 63));
            *next++ = (char)(0x80 | (unit & 63));
        } else {
            *next++ = '?';
        }
    }
    return (struct scene_text){out, next, 0};
}

size_t scene_text_marks(const void *text, size_t size)
{
    static const char mark[] = "\xef\xbb\xbf";
    const size_t length = strlen(mark);
    size_t marks = 0;
    while (size - marks >= length && memcmp((const char *)text + marks, mark, length) == 0) {
        marks += length;
    }
    return marks;
}

struct scene_text scene_text_open(struct scene_import *import, char *bytes, size_t size)
{
    const unsigned char *start = (const unsigned char *)bytes;
    if (size >= 2 && start[0] == 0xfe && start[1] == 0xff) {
        return convert_wide(import, start, size, true);
    }
    if (size >= 2 && start[0] == 0xff && start[1] == 0xfe) {
        return convert_wide(import, start, size, false);
    }
    return (struct scene_text){bytes + scene_text_marks(bytes, size), bytes + size, 0};
}

// Return the first LF or CR, or the end. Eight characters are looked at together: a byte of a word is 0 where it has
// what is looked for, and the lowest such byte is found by what borrows from it.
static char *find_line_end(char *c, char *end)
{
    const uint64_t ones = 0x0101010101010101u, tops = 0x8080808080808080u;
    while (end - c >= 8) {
        uint64_t word;
        memcpy(&word, c, sizeof word);
        const uint64_t feeds = word ^ ones * '\n', returns = word ^ ones * '\r';
        if ((((feeds - ones) & ~feeds) | ((returns - ones) & ~returns)) & tops) {
            break;
        }
        c += 8;
    }
    while (c < end && *c != '\n' && *c != '\r') {
        c++;
    }
    return c;
}

bool scene_text_line(struct scene_text *text, bool continued, struct scene_line *line)
{
    if (text->cursor == text->end) {
        return false;
    }
    char *start = text->cursor, *c = start;
    for (;; c++) {
        c = find_line_end(c, text->end);
        text->line++;
        const bool pair = c + 1 < text->end && c[0] == '\r' && c[1] == '\n';
        text->cursor = c < text->end ? c + 1 + pair : c;
        if (!continued || c == text->end || c == start || c[-1] != '\\') {
            break;
        }
        memset(c - 1, ' ', (size_t)(text->cursor - c) + 1);
        c = text->cursor - 1;
    }
    *line = (struct scene_line){start, c};
    return true;
}

bool scene_text_word(struct scene_line *line, struct scene_word *word)
{
    const char *c = line->cursor;
    while (c < line->end && is_blank(*c)) {
        c++;
    }
    word->start = c;
    while (c < line->end && !is_blank(*c)) {
        c++;
    }
    word->length = (size_t)(c - word->start);
    line->cursor = c;
    return word->length > 0;
}

struct scene_word scene_text_rest(struct scene_line line)
{
    while (line.cursor < line.end && is_blank(*line.cursor)) {
        line.cursor++;
    }
    for (const char *c = line.cursor; c < line.end; c++) {
        if (*c == '#' && c > line.cursor && is_blank(c[-1]) && (c + 1 == line.end || is_blank(c[1]))) {
            line.end = c;
        }
    }
    while (line.end > line.cursor && is_blank(line.end[-1])) {
        line.end--;
    }
    return (struct scene_word){line.cursor, (size_t)(line.end - line.cursor)};
}

bool scene_word_is(struct scene_word word, const char *text)
{
    return strlen(text) == word.length && memcmp(word.start, text, word.length) == 0;
}

const char *scene_word_string(struct scene_import *import, struct scene_word word)
{
    return scene_import_string(import, word.start, word.length);
}

const char *scene_word_bytes(struct scene_import *import, struct scene_word word)
{
    return memcpy(scene_import_allocate(import, word.length + 1, 1), word.start, word.length);
}

// Numbers -------------------------------------------------------------------------------------------

static bool read_special(struct scene_word word, double *value, size_t *length)
{
    const size_t sign = word.length > 0 && (word.start[0] == '-' || word.start[0] == '+');
    const char *name = word.start + sign;
    if (word.length - sign < 3 || (strncasecmp(name, "nan", 3) != 0 && strncasecmp(name, "inf", 3) != 0)) {
        return false;
    }
    *value = strncasecmp(name, "nan", 3) == 0 ? (double)NAN
             : word.start[0] == '-'           ? -(double)INFINITY
                                              : (double)INFINITY;
    *length = word.length;
    return true;
}

bool scene_word_number(struct scene_word word, double *value, size_t *length)
{
    const char *const end = word.start + word.length, *const stop =
                                                          scene_decimal_read(word.start, end, value);
    if (stop == NULL) {
        return read_special(word, value, length);
    }
    // Old Microsoft libraries print a NaN as 1.#IND.
    const bool is_indefinite = stop < end && *stop == '#' &&
                               memchr(word.start, 'e', (size_t)(stop - word.start)) == NULL &&
                               memchr(word.start, 'E', (size_t)(stop - word.start)) == NULL;
    *value = is_indefinite ? (double)NAN : *value;
    *length = is_indefinite ? word.length : (size_t)(stop - word.start);
    return true;
}

const char *scene_number_read(const char *text, const char *end, const char *separators, double *value)
{
    enum { MOST = 64 }; // bytes of a word that are looked at for what has not digits alone
    const char *const stop = scene_decimal_read(text, end, value);
    if (stop != NULL && (stop == end || *stop != '#' || stop - text >= MOST)) {
        return stop;
    }
    struct scene_word word = {text, 0};
    while (word.length < MOST && text + word.length < end && strchr(separators, text[word.length]) == NULL) {
        word.length++;
    }
    size_t length;
    return scene_word_number(word, value, &length) ? text + length : NULL;
}

bool scene_text_double(struct scene_line *line, double *value)
{
    const char *start = line->cursor;
    while (start < line->end && is_blank(*start)) {
        start++;
    }
    const char *const stop = scene_decimal_read(start, line->end, value);
    if (stop != NULL && (stop == line->end || is_blank(*stop))) {
        line->cursor = stop;
        return true;
    }
    struct scene_line after = *line;
    struct scene_word word;
    size_t length;
    if (!scene_text_word(&after, &word) || !scene_word_number(word, value, &length)) {
        return false;
    }
    *line = after;
    return true;
}

int scene_text_doubles(struct scene_line *line, double *values, int most)
{
    int count = 0;
    while (count < most && scene_text_double(line, &values[count])) {
        count++;
    }
    return count;
}

int scene_text_numbers(struct scene_line *line, float *values, int most)
{
    double value;
    int count = 0;
    while (count < most && scene_text_double(line, &value)) {
        values[count++] = (float)value;
    }
    return count;
}
