// SPDX-License-Identifier: MIT
#include "folder.h"

#include "message.h"

#include <string.h>
#include <sys/stat.h>

bool cli_is_folder(const char *path)
{
    struct stat status;
    const size_t length = strlen(path);
    const bool is_named = length > 0 && path[length - 1] == '/';
    const bool is_there = strcmp(path, "-") != 0 && stat(path, &status) == 0 && S_ISDIR(status.st_mode);
    if (is_named || is_there) {
        cli_error(path, "%s a folder; name a file in it", is_there ? "is" : "is named as");
    }
    return is_named || is_there;
}
