// SPDX-License-Identifier: MIT
// Where the markup of a document ends, and what stands in a tag.
#include "collada_markup.h"

#include <string.h>

char *scene_collada_tag_end(char *tag, const char *end)
{
    char quote = 0;
    for (char *c = tag; c < end; c++) {
        if (quote != 0) {
            quote = *c == quote ? 0 : quote;
        } else if (*c == '"' || *c == '\'') {
            quote = *c;
        } else if (*c == '>') {
            return c;
        }
    }
    return NULL;
}

char *scene_collada_markup_end(char *start, const char *end)
{
    static const char *const ends[][2] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        if (strncmp(start, ends[i][0], strlen(ends[i][0])) == 0) {
            char *found = strstr(start, ends[i][1]);
            return found == NULL ? NULL : found + strlen(ends[i][1]) - 1;
        }
    }
    return scene_collada_tag_end(start, end);
}

bool scene_collada_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool scene_collada_is_tag(const char *tag, const char *name)
{
    const char after = strncmp(tag + 1, name, strlen(name)) == 0 ? tag[1 + strlen(name)] : 0;
    return scene_collada_is_blank(after) || after == '/' || after == '>';
}

bool scene_collada_is_end(const char *tag, const char *name)
{
    return tag[1] == '/' && scene_collada_is_tag(tag + 1, name);
}

struct scene_collada_value scene_collada_attribute(char *tag, char *close, const char *name)
{
    const size_t length = strlen(name);
    for (char *c = tag + 1; c < close; c++) {
        if (*c == '"' || *c == '\'') {
            char *const quote = memchr(c + 1, *c, (size_t)(close - c - 1));
            c = quote == NULL ? close : quote;
        } else if (scene_collada_is_blank(c[-1]) && strncmp(c, name, length) == 0) {
            char *value = c + length + strspn(c + length, " \t\r\n");
            value += *value == '=' ? 1 + strspn(value + 1, " \t\r\n") : 0;
            const bool is_quoted = value < close && (*value == '"' || *value == '\'');
            char *const quote = is_quoted ? memchr(value + 1, *value, (size_t)(close - value - 1)) : NULL;
            if (quote != NULL) {
                return (struct scene_collada_value){value + 1, (size_t)(quote - value - 1)};
            }
        }
    }
    return (struct scene_collada_value){0};
}

static const char *before_blanks(const char *text)
{
    while (scene_collada_is_blank(text[-1])) {
        text--;
    }
    return text;
}

const char *scene_collada_name_end(struct scene_collada_value value)
{
    const char *const equals = before_blanks(value.text - 1) - 1;
    return before_blanks(equals);
}
