// SPDX-License-Identifier: MIT
// The format is that of G. Ward, "Real Pixels", Graphics Gems II, 1991, and of Radiance's color.c.
#include "radiance.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

struct reader {
    const unsigned char *at, *end;
};

// Read the line at the beginning, and put a zero after it. Return false if there is none.
static bool read_line(struct reader *reader, char *line, size_t size)
{
    const size_t left = (size_t)(reader->end - reader->at);
    const unsigned char *const newline = memchr(reader->at, '\n', left);
    if (newline == NULL) {
        return false;
    }
    const size_t length = (size_t)(newline - reader->at);
    const size_t kept = length < size - 1 ? length : size - 1;
    memcpy(line, reader->at, kept);
    line[kept] = 0;
    reader->at = newline + 1;
    return true;
}

static const char cut[] = "the Radiance HDR file ends too early",
                  bad_run[] = "damaged Radiance HDR: a run has no length, or "
                              "more than is left of its row";

// Skip one of the four channels of a row. Return NULL if its runs fit.
static const char *skip_channel(struct reader *reader, long width)
{
    for (long left = width; left > 0;) {
        if (reader->end - reader->at < 2) {
            return cut;
        }
        const bool repeats = *reader->at > 128;
        const long count = repeats ? *reader->at - 128 : *reader->at;
        if (count == 0 || count > left) {
            return bad_run;
        }
        if (!repeats && count > reader->end - reader->at - 1) {
            return cut;
        }
        reader->at += repeats ? 2 : 1 + count;
        left -= count;
    }
    return NULL;
}

const char *scene_radiance_problem(const unsigned char *bytes, size_t size)
{
    struct reader reader = {bytes, bytes + size};
    char line[128];
    do {
        if (!read_line(&reader, line, sizeof line)) {
            return NULL; // the file has no picture at all
        }
    } while (line[0] != 0);
    if (!read_line(&reader, line, sizeof line) || strncmp(line, "-Y ", 3) != 0) {
        return NULL;
    }
    char *rest;
    const long height = strtol(line + 3, &rest, 10);
    rest += strspn(rest, " ");
    const long width = strncmp(rest, "+X ", 3) == 0 ? strtol(rest + 3, NULL, 10) : 0;
    if (width < 8 || width >= 32768) {
        return NULL; // the file has no runs
    }
    for (long row = 0; row < height; row++) {
        const unsigned char *const at = reader.at;
        if (reader.end - at < 4) {
            return cut;
        }
        if (at[0] != 2 || at[1] != 2 || at[2] & 0x80) {
            return NULL; // pixels follow without runs
        }
        reader.at += 4;
        for (int channel = 0; channel < 4; channel++) {
            const char *const problem = skip_channel(&reader, width);
            if (problem != NULL) {
                return problem;
            }
        }
    }
    return NULL;
}
