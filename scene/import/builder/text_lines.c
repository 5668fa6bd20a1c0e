// SPDX-License-Identifier: MIT
// Lines, words and numbers. Large scans come as text, so numbers are read without strtod where plain arithmetic is
// exact, and nothing depends on the locale.
#include "text_lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == 0;
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
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

struct scene_text scene_text_open(struct scene_import *import, char *bytes, size_t size)
{
    const unsigned char *start = (const unsigned char *)bytes;
    if (size >= 2 && start[0] == 0xfe && start[1] == 0xff) {
        return convert_wide(import, start, size, true);
    }
    if (size >= 2 && start[0] == 0xff && start[1] == 0xfe) {
        return convert_wide(import, start, size, false);
    }
    if (size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0) {
        return (struct scene_text){bytes + 3, bytes + size, 0};
    }
    return (struct scene_text){bytes, bytes + size, 0};
}

bool scene_text_line(struct scene_text *text, bool continued, struct scene_line *line)
{
    if (text->cursor == text->end) {
        return false;
    }
    char *start = text->cursor, *c = start;
    for (;; c++) {
        while (c < text->end && *c != '\n' && *c != '\r') {
            c++;
        }
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

// Return value · 10^exponent for a number that plain arithmetic does not give exactly. `digits` has no exponent part.
static double convert_slowly(const char *digits, size_t length, int exponent)
{
    char text[128];
    const size_t kept = length < 100 ? length : 100;
    memcpy(text, digits, kept);
    snprintf(text + kept, sizeof text - kept, "e%d", exponent);
    return strtod(text, NULL);
}

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

// Read "e-12" at `c`. Return where it ends, which is `c` when there is no exponent.
static const char *read_exponent(const char *c, const char *end, int *exponent)
{
    *exponent = 0;
    if (c == end || (*c != 'e' && *c != 'E')) {
        return c;
    }
    const char *digit = c + 1;
    const bool negative = digit < end && *digit == '-';
    digit += digit < end && (*digit == '-' || *digit == '+');
    for (; digit < end && is_digit(*digit); c = ++digit) {
        *exponent = *exponent < 100000 ? *exponent * 10 + (*digit - '0') : *exponent;
    }
    *exponent = negative ? -*exponent : *exponent;
    return c;
}

bool scene_word_number(struct scene_word word, double *value, size_t *length)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    const char *c = word.start, *end = word.start + word.length;
    const bool negative = c < end && *c == '-';
    if (c < end && (*c == '-' || *c == '+')) {
        c++;
    }
    const char *digits = c;
    uint64_t mantissa = 0;
    int count = 0, exponent = 0, scale = 0;
    bool point = false;
    for (; c < end && (is_digit(*c) || (*c == '.' && !point)); c++) {
        point = point || *c == '.';
        if (*c == '.') {
            continue;
        }
        mantissa = count < 18 ? mantissa * 10 + (uint64_t)(*c - '0') : mantissa; // stays below 10^18
        count++;
        scale -= point;
    }
    if (count == 0) {
        return read_special(word, value, length);
    }
    const size_t digit_length = (size_t)(c - digits);
    const bool indefinite = c < end && *c == '#'; // old Microsoft libraries print a NaN as 1.#IND
    c = read_exponent(c, end, &exponent);
    const int power = exponent + scale;
    // Both factors are exact, and IEEE rounds their product or quotient once.
    if (mantissa <= (uint64_t)1 << 53 && count <= 18 && power >= -22 && power <= 22) {
        *value = power < 0 ? (double)mantissa / powers[-power] : (double)mantissa * powers[power];
    } else {
        *value = convert_slowly(digits, digit_length, exponent);
    }
    *value = indefinite ? (double)NAN : negative ? -*value : *value;
    *length = indefinite ? word.length : (size_t)(c - word.start);
    return true;
}

int scene_text_doubles(struct scene_line *line, double *values, int most)
{
    for (int count = 0; count < most; count++) {
        const struct scene_line before = *line;
        struct scene_word word;
        size_t length = 0;
        if (!scene_text_word(line, &word) || !scene_word_number(word, &values[count], &length)) {
            *line = before;
            return count;
        }
    }
    return most;
}

int scene_text_numbers(struct scene_line *line, float *values, int most)
{
    double value;
    int count = 0;
    while (count < most && scene_text_doubles(line, &value, 1) == 1) {
        values[count++] = (float)value;
    }
    return count;
}
