// SPDX-License-Identifier: MIT
// Rules of make, which build systems read to know when a file has to be made anew.
#include "shader_job.h"

#include <stdlib.h>
#include <string.h>

// Write the name of a file, which no 0 ends, as make reads it. Return where it ends.
static char *quote(char *out, const char *name, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (name[i] == '$') {
            *out++ = '$';
        } else if (name[i] == ' ' || name[i] == '#' || name[i] == '\\') {
            *out++ = '\\';
        }
        *out++ = name[i];
    }
    return out;
}

// Write what a file is made of behind `out`. Return where it ends.
static char *add_file(char *out, const struct cli_shader_file *file)
{
    *out++ = ' ';
    out = quote(out, file->path, strlen(file->path));
    for (const char *line = file->included ? file->included : ""; *line;) {
        const size_t length = strcspn(line, "\n");
        *out++ = ' ';
        out = quote(out, line, length);
        line += length + (line[length] == '\n');
    }
    return out;
}

bool cli_shader_write_depfile(const char *path, const char *target, const struct cli_shader_file *files,
                              int count)
{
    size_t room = 2 * strlen(target) + 2;
    for (int i = 0; i < count; i++) {
        room += 2 * strlen(files[i].path) + 1 + (files[i].included ? 2 * strlen(files[i].included) : 0);
    }
    char *const text = malloc(room);
    if (!text) {
        cli_error(path, "out of memory");
        return false;
    }
    char *end = quote(text, target, strlen(target));
    *end++ = ':';
    for (int i = 0; i < count; i++) {
        end = add_file(end, &files[i]);
    }
    *end++ = '\n';
    const bool written = cli_shader_write_bytes(path, text, (size_t)(end - text));
    free(text);
    return written;
}
