// SPDX-License-Identifier: MIT
#include "folder.h"

#include "message.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

// Windows finds no folder whose name ends with a slash.
static bool is_there(const char *path, size_t length)
{
    struct stat status;
    char bare[4096];
    while (length > 1 && path[length - 1] == '/') {
        length--;
    }
    return length < sizeof bare && snprintf(bare, sizeof bare, "%.*s", (int)length, path) >= 0 &&
           stat(bare, &status) == 0 && S_ISDIR(status.st_mode);
}

bool cli_is_folder(const char *path)
{
    const size_t length = strlen(path);
    const bool is_named = length > 0 && path[length - 1] == '/';
    const bool exists = strcmp(path, "-") != 0 && is_there(path, length);
    if (is_named || exists) {
        cli_error(path, "%s a folder; name a file in it", exists ? "is" : "is named as");
    }
    return is_named || exists;
}
