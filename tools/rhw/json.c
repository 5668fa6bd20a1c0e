// SPDX-License-Identifier: MIT
// JSON strings and numbers; see json.h.
#include "json.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

// Bytes of the well-formed UTF-8 sequence at `text` (RFC 3629 §4), or 0.
static int utf8_length(const unsigned char *text)
{
    const unsigned char first = text[0];
    const int length = first < 0x80   ? 1
                       : first < 0xC2 ? 0
                       : first < 0xE0 ? 2
                       : first < 0xF0 ? 3
                       : first < 0xF5 ? 4
                                      : 0;
    for (int i = 1; i < length; i++) {
        if ((text[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    const bool overlong = (first == 0xE0 && text[1] < 0xA0) || (first == 0xF0 && text[1] < 0x90);
    const bool surrogate = first == 0xED && text[1] > 0x9F;
    const bool too_large = first == 0xF4 && text[1] > 0x8F;
    return overlong || surrogate || too_large ? 0 : length;
}

void cli_json_string(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        const int length = utf8_length(c);
        if (length == 0) {
            fputs("\\ufffd", stream);
        } else if (*c == '"' || *c == '\\') {
            fprintf(stream, "\\%c", *c);
        } else if (*c < 0x20 || *c == 0x7F) {
            fprintf(stream, "\\u%04x", *c);
        } else {
            fwrite(c, 1, (size_t)length, stream);
        }
        c += length ? length : 1;
    }
    fputc('"', stream);
}

void cli_json_double(FILE *stream, double number)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, number);
        if (strtod(text, NULL) == number) {
            break;
        }
    }
    fputs(isfinite(number) ? text : "null", stream);
}

void cli_json_number(FILE *stream, double number)
{
    if (isfinite(number)) {
        fprintf(stream, "%.9g", number);
    } else {
        fputs("null", stream);
    }
}
