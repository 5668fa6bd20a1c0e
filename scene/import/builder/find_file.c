// SPDX-License-Identifier: MIT
// The file that a model means by a name, either as it is written or as people move files about, and whether it may be
// read.
#include "find_file.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file.h"

static bool is_file(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

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

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

static void decode_percent(char *text)
{
    char *out = text;
    for (const char *in = text; *in != 0; out++) {
        const int high = in[0] == '%' ? hex_digit(in[1]) : -1, low = high >= 0 ? hex_digit(in[2]) : -1;
        *out = low > 0 || high > 0 ? (char)(high * 16 + low) : *in;
        in += low > 0 || high > 0 ? 3 : 1;
    }
    *out = 0;
}

static char *join(struct scene_import *import, const char *directory, const char *name)
{
    const size_t length = strlen(directory) + strlen(name) + 1;
    char *path = scene_import_allocate(import, length, 1);
    snprintf(path, length, "%s%s", directory, name);
    return path;
}

// Replace the last component of `path` by an entry of its directory that differs in case alone.
static bool match_case(char *path, const char *component)
{
    const size_t length = strlen(component);
    path[component - path - 1] = 0;
    DIR *directory = opendir(component - 1 == path ? "/" : path);
    path[component - path - 1] = '/';
    if (directory == NULL) {
        return false;
    }
    bool found = false;
    for (const struct dirent *entry = readdir(directory); entry != NULL && !found;
         entry = readdir(directory)) {
        if (strlen(entry->d_name) == length && strcasecmp(entry->d_name, component) == 0) {
            memcpy(path + (component - path), entry->d_name, length);
            found = true;
        }
    }
    closedir(directory);
    return found;
}

// Return true if `path` is a file, or becomes one when the case of its components changes. Its first `known` bytes, the
// directory of the model, stay.
static bool exists_in_some_case(char *path, size_t known)
{
    if (is_file(path)) {
        return true;
    }
    for (char *component = path + known; component != NULL && *component != 0;) {
        char *slash = strchr(component, '/');
        if (slash != NULL) {
            *slash = 0;
        }
        const bool dots = strcmp(component, ".") == 0 || strcmp(component, "..") == 0 || *component == 0;
        const bool there = dots || access(path, F_OK) == 0 || match_case(path, component);
        if (slash != NULL) {
            *slash = '/';
        }
        if (!there) {
            return false;
        }
        component = slash == NULL ? NULL : slash + 1;
    }
    return is_file(path);
}

// Return the file that a path of another machine means, on which the model was made. As much of the path's end as
// stands beside the model is meant, or the file alone in one of the folders that archives of models have.
static const char *find_moved(struct scene_import *import, const char *directory, const char *name)
{
    static const char *const folders[] = {"textures/", "texture/",     "tex/",        "maps/",
                                          "images/",   "../textures/", "../texture/", "../images/"};
    const char *file = name;
    for (const char *slash = strchr(name, '/'); slash != NULL; slash = strchr(slash + 1, '/')) {
        file = slash + 1;
        char *path = join(import, directory, file);
        if (exists_in_some_case(path, strlen(directory))) {
            return path;
        }
    }
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        char *path = join(import, join(import, directory, folders[i]), file);
        if (exists_in_some_case(path, strlen(directory))) {
            return path;
        }
    }
    return NULL;
}

static const char *find_anywhere(struct scene_import *import, const char *name)
{
    if (strncmp(name, "file://", 7) == 0) {
        name += 7;
    }
    // Blender begins paths relative to the model like this.
    if (strncmp(name, "//", 2) == 0) {
        name += 2;
    }
    const char *directory = import->directory[0] != 0 ? import->directory : "./";
    char *plain = join(import, "", name), *decoded = join(import, "", name);
    decode_percent(decoded);
    for (int round = 0; round < 2; round++) {
        char *const names[] = {plain, decoded};
        for (int i = 0; i < 2; i++) {
            char *path = names[i][0] == '/' ? names[i] : join(import, directory, names[i]);
            if (is_file(path)) {
                return path;
            }
        }
        for (int i = 0; i < 2; i++) {
            for (char *c = names[i]; *c != 0; c++) {
                *c = *c == '\\' ? '/' : *c;
            }
        }
    }
    char *path = join(import, directory, decoded);
    if (exists_in_some_case(path, strlen(directory))) {
        return path;
    }
    return find_moved(import, directory, decoded);
}

const char *scene_import_find_file(struct scene_import *import, const char *name)
{
    const char *path = find_anywhere(import, name);
    import->missing = "No such file or directory";
    if (path != NULL && !scene_import_within(import, path)) {
        import->missing = "lies outside the folder that may be read (--confine)";
        path = NULL;
    }
    return path;
}
