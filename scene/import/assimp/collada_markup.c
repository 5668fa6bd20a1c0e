// SPDX-License-Identifier: MIT
// Where the markup of a document ends.
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
