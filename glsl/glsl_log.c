// SPDX-License-Identifier: MIT
#include "glsl_log.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char error_mark[] = "ERROR: ";
static const char warning_mark[] = "WARNING: ";

// A line of glslang's log that is worth telling.
struct line {
    const char *text;
    size_t length;
    bool is_warning;
};

static bool has(const struct line *line, const char *part)
{
    const size_t length = strlen(part);
    for (size_t i = 0; i + length <= line->length; i++) {
        if (memcmp(line->text + i, part, length) == 0) {
            return true;
        }
    }
    return false;
}

static bool skip(struct line *line, const char *mark)
{
    const size_t length = strlen(mark);
    if (line->length < length || memcmp(line->text, mark, length) != 0) {
        return false;
    }
    line->text += length;
    line->length -= length;
    return true;
}

// Take the next line of *log. Return false at its end.
static bool next_line(const char **log, struct line *line)
{
    while (**log != 0) {
        const size_t whole = strcspn(*log, "\r\n");
        *line = (struct line){.text = *log, .length = whole};
        *log += whole;
        *log += strspn(*log, "\r\n");
        line->is_warning = skip(line, warning_mark);
        if (!line->is_warning) {
            skip(line, error_mark);
        }
        while (line->length > 0 && line->text[line->length - 1] == ' ') {
            line->length--;
        }
        if (line->length > 0 && !has(line, "compilation terminated") && !has(line, "No code generated")) {
            return true;
        }
    }
    return false;
}

// Return how many bytes of the line are its place: "NAME:LINE:" and the space behind it. 0: it has none.
static size_t place_of(const struct line *line)
{
    for (size_t i = 0; i < line->length; i++) {
        if (line->text[i] != ':') {
            continue;
        }
        size_t end = i + 1;
        while (end < line->length && line->text[end] >= '0' && line->text[end] <= '9') {
            end++;
        }
        if (end > i + 1 && end + 1 < line->length && line->text[end] == ':' && line->text[end + 1] == ' ') {
            return end + 2;
        }
    }
    return 0;
}

// Print a line where `text` is not NULL. Return its length.
static size_t print(char *text, size_t room, const struct line *line, const char *name)
{
    size_t place = place_of(line);
    const size_t end = place;
    // A message about no word in particular begins with two quotes.
    static const char no_word[] = "'' : ";
    if (place > 0 && line->length - place >= sizeof no_word &&
        memcmp(line->text + place, no_word, sizeof no_word - 1) == 0) {
        place += sizeof no_word - 1;
        place += strspn(line->text + place, " ");
    }
    const char *const kind = line->is_warning ? "warning: " : "";
    const int rest = (int)(line->length - place);
    const int length =
        place > 0 ? snprintf(text, room, "%.*s%s%.*s\n", (int)end, line->text, kind, rest, line->text + place)
                  : snprintf(text, room, "%s: %s%.*s\n", name, kind, rest, line->text);
    return (size_t)length;
}

// Print the lines that are warnings or are not, each once behind another. Return their length.
static size_t print_kind(char *text, size_t room, const char *log, const char *name, bool is_warning)
{
    size_t length = 0;
    struct line line;
    while (next_line(&log, &line)) {
        if (line.is_warning == is_warning) {
            length +=
                print(text != NULL ? text + length : NULL, text != NULL ? room - length : 0, &line, name);
        }
    }
    return length;
}

char *glsl_log_lines(const char *log, const char *name)
{
    const size_t errors = print_kind(NULL, 0, log, name, false);
    const size_t warnings = print_kind(NULL, 0, log, name, true);
    char *const text = malloc(errors + warnings + 1);
    if (text != NULL) {
        text[0] = 0;
        print_kind(text, errors + 1, log, name, false);
        print_kind(text + errors, warnings + 1, log, name, true);
    }
    return text;
}

void glsl_log_first(const char *lines, char *message, size_t message_size)
{
    snprintf(message, message_size, "%.*s", (int)strcspn(lines, "\n"), lines);
}
