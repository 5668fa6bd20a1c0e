// SPDX-License-Identifier: MIT
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "glsl.h"

static const char out_of_memory[] = "memory is out";
static const char missing[] = "there is no such file";

// Return FOLDER/NAME by malloc, where the folder is the first `length` bytes.
static char *join(const char *folder, size_t length, const char *name)
{
    const size_t size = length + strlen(name) + 2;
    char *const path = malloc(size);
    if (path != NULL) {
        const bool has_slash = length == 0 || folder[length - 1] == '/';
        snprintf(path, size, "%.*s%s%s", (int)length, folder, has_slash ? "" : "/", name);
    }
    return path;
}

// Return how many bytes of a path are its folder, with the slash.
static size_t folder_length(const char *path)
{
    size_t length = strlen(path);
    while (length > 0 && path[length - 1] != '/') {
        length--;
    }
    return length;
}

// Read an open file. Return NULL, or what is wrong.
static const char *read_all(FILE *file, struct glsl_include *include)
{
    size_t room = 1 << 14;
    char *text = malloc(room);
    size_t size = 0;
    while (text != NULL) {
        size += fread(text + size, 1, room - size, file);
        if (size < room || size > GLSL_MAX_TEXT_SIZE) {
            break;
        }
        room *= 2;
        char *const larger = realloc(text, room);
        if (larger == NULL) {
            free(text);
        }
        text = larger;
    }
    const char *const problem = text == NULL                ? out_of_memory
                                : ferror(file)              ? "the file cannot be read"
                                : size > GLSL_MAX_TEXT_SIZE ? "the file is larger than 16 MiB"
                                                            : NULL;
    if (problem != NULL) {
        free(text);
        return problem;
    }
    include->text = text;
    include->size = size;
    return NULL;
}

// Open and read a path, which include->name gets. *is_there tells whether there is a file.
static const char *read_path(char *path, struct glsl_include *include, bool *is_there)
{
    *is_there = true;
    if (path == NULL) {
        return out_of_memory;
    }
    struct stat status;
    const bool is_other = stat(path, &status) == 0 && !S_ISREG(status.st_mode); // a pipe would be waited for
    FILE *const file = is_other ? NULL : fopen(path, "rb");
    if (file == NULL) {
        *is_there = is_other || (errno != ENOENT && errno != ENOTDIR);
        free(path);
        return is_other ? "it is no regular file" : "the file cannot be opened";
    }
    const char *const problem = read_all(file, include);
    fclose(file);
    if (problem != NULL) {
        free(path);
        return problem;
    }
    include->name = path;
    return NULL;
}

const char *glsl_include_file(void *user, struct glsl_include *include)
{
    const struct glsl_folders *const folders = user;
    const char *problem = missing;
    bool is_there = false;
    if (include->header[0] == '/') {
        problem = read_path(join("", 0, include->header), include, &is_there);
    } else {
        if (!include->is_system) {
            const char *const includer = include->includer;
            problem = read_path(join(includer, folder_length(includer), include->header), include, &is_there);
        }
        for (uint32_t i = 0; i < folders->count && problem != NULL && !is_there; i++) {
            const char *const folder = folders->folders[i];
            problem = read_path(join(folder, strlen(folder), include->header), include, &is_there);
        }
    }
    return problem != NULL && !is_there ? missing : problem;
}
