// SPDX-License-Identifier: MIT
#include "confine.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "file.h"

bool scene_import_within(const struct scene_import *import, const char *path)
{
    if (import->confine == NULL) {
        return true;
    }
    char *const resolved = system_file_resolve(path); // a resolved path has no links that lead elsewhere
    const size_t length = strlen(import->confine);
    const bool is_root = length > 0 && import->confine[length - 1] == '/';
    const bool within = resolved != NULL && strncmp(resolved, import->confine, length) == 0 &&
                        (is_root || resolved[length] == '/');
    free(resolved);
    return within;
}

bool scene_import_is_file(struct scene_import *import, const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0 || S_ISDIR(status.st_mode) || !scene_import_within(import, path)) {
        return false;
    }
    if (!S_ISREG(status.st_mode)) {
        import->missing = "is not a regular file";
    }
    return S_ISREG(status.st_mode);
}

// Return true if the component before `end`, which is behind its slash, is a name that ".." takes back. `start` is then
// where it begins.
static bool find_parent(const char *path, const char *end, size_t *start)
{
    size_t at = (size_t)(end - path);
    at -= at > 0;
    const size_t stop = at;
    while (at > 0 && path[at - 1] != '/') {
        at--;
    }
    *start = at;
    return stop > at && !(stop - at == 2 && memcmp(path + at, "..", 2) == 0);
}

void scene_import_drop_detours(char *path)
{
    char *out = path;
    for (const char *in = path; *in != 0;) {
        const size_t length = strcspn(in, "/"), step = length + (in[length] == '/');
        const bool is_nothing = (length == 0 && out != path) || (length == 1 && *in == '.');
        size_t parent;
        if (length == 2 && memcmp(in, "..", 2) == 0 && find_parent(path, out, &parent)) {
            out = path + parent;
        } else if (!is_nothing) {
            memmove(out, in, step);
            out += step;
        }
        in += step;
    }
    *out = 0;
}
