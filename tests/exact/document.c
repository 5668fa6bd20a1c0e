// SPDX-License-Identifier: MIT
// See document.h.
#include "document.h"

#include <stdlib.h>
#include <string.h>

// The whole file with a terminating zero, or NULL.
static char *read_all(const char *path)
{
    FILE *const in = fopen(path, "rb");
    char *text = NULL;
    if (in && fseek(in, 0, SEEK_END) == 0) {
        const long size = ftell(in);
        rewind(in);
        text = size >= 0 ? malloc((size_t)size + 1) : NULL;
        if (text && fread(text, 1, (size_t)size, in) == (size_t)size) {
            text[size] = 0;
        } else {
            free(text);
            text = NULL;
        }
    }
    if (in) {
        fclose(in);
    }
    return text;
}

bool document_replace(const char *path, const char *begin, const char *end, document_print *print,
                      const void *argument)
{
    char *const text = read_all(path);
    const char *const from = text ? strstr(text, begin) : NULL;
    const char *const to = from ? strstr(from, end) : NULL;
    char beside[4096];
    bool ok = false;
    if (!to || snprintf(beside, sizeof beside, "%s.new", path) >= (int)sizeof beside) {
        fprintf(stderr, "%s: cannot be read or lacks the line %s", path, begin);
        free(text);
        return false;
    }
    FILE *const out = fopen(beside, "wb");
    if (out) {
        fwrite(text, 1, (size_t)(from - text) + strlen(begin), out);
        print(out, argument);
        fputs(to, out);
        ok = !ferror(out);
        ok = fclose(out) == 0 && ok && rename(beside, path) == 0;
    }
    if (!ok) {
        fprintf(stderr, "%s: cannot be written\n", path);
        remove(beside);
    }
    free(text);
    return ok;
}
