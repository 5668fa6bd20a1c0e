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

enum {
    LONGEST = 4096, // bytes of a path; no system opens longer ones
    DEEPEST = 32    // parts at the end of a path of another machine that are looked for beside the model
};

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

// A file that may not be read counts as none, so that a model cannot be used to ask what else there is.
static bool is_file(const struct scene_import *import, const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode) && scene_import_within(import, path);
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

// Take "name/.." out of a path: whether there is a folder of that name is nothing a confined model may ask.
static void drop_detours(char *path)
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
static bool exists_in_some_case(const struct scene_import *import, char *path, size_t known)
{
    if (is_file(import, path)) {
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
    return is_file(import, path);
}

// Return the path of a file, in some case of its components, below `directory` and `folder`. Return NULL if there is
// none.
static const char *find_below(struct scene_import *import, const char *directory, const char *folder,
                              const char *name)
{
    char *base = join(import, directory, folder), *path = join(import, base, name);
    free(base);
    if (exists_in_some_case(import, path, strlen(directory))) {
        return path;
    }
    free(path);
    return NULL;
}

// Return the file that a path of another machine means, on which the model was made. As much of the path's end as
// stands beside the model is meant, or the file alone in one of the folders that archives of models have.
static const char *find_moved(struct scene_import *import, const char *directory, const char *name)
{
    static const char *const folders[] = {"textures/", "texture/",     "tex/",        "maps/",
                                          "images/",   "../textures/", "../texture/", "../images/"};
    size_t deeper = 0;
    for (const char *c = name; *c != 0; c++) {
        deeper += *c == '/';
    }
    const char *file = name, *path = NULL;
    for (const char *slash = strchr(name, '/'); slash != NULL && path == NULL;
         slash = strchr(slash + 1, '/')) {
        file = slash + 1;
        if (--deeper < DEEPEST && *file != '/') {
            path = find_below(import, directory, "", file);
        }
    }
    for (size_t i = 0; i < sizeof folders / sizeof folders[0] && path == NULL; i++) {
        path = find_below(import, directory, folders[i], file);
    }
    return path;
}

// Return the file of one form of a name, relative or not. Return NULL if there is none.
static const char *find_plainly(struct scene_import *import, const char *directory, const char *name)
{
    char *path = join(import, name[0] == '/' ? "" : directory, name);
    if (is_file(import, path)) {
        return path;
    }
    free(path);
    return NULL;
}

static void turn_slashes(char *name)
{
    for (char *c = name; *c != 0; c++) {
        *c = *c == '\\' ? '/' : *c;
    }
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
    const char *directory = import->directory[0] != 0 ? import->directory : "./", *path = NULL;
    char *plain = join(import, "", name), *decoded = join(import, "", name);
    decode_percent(decoded);
    for (int round = 0; round < 2 && path == NULL; round++) {
        char *const names[] = {plain, decoded};
        for (int i = 0; i < 2 && path == NULL; i++) {
            if (import->confine != NULL) {
                drop_detours(names[i]);
            }
            path = find_plainly(import, directory, names[i]);
        }
        turn_slashes(plain);
        turn_slashes(decoded);
    }
    if (path == NULL && import->confine != NULL) {
        drop_detours(decoded);
    }
    path = path != NULL ? path : find_below(import, directory, "", decoded);
    path = path != NULL ? path : find_moved(import, directory, decoded);
    free(plain);
    free(decoded);
    return path;
}

const char *scene_import_find_file(struct scene_import *import, const char *name)
{
    if (strlen(name) >= LONGEST) {
        import->missing = "the name is longer than that of a file can be";
        return NULL;
    }
    import->missing = import->confine != NULL ? "is not a file of the folder that may be read (--confine)"
                                              : "No such file or directory";
    return find_anywhere(import, name);
}
