// SPDX-License-Identifier: MIT
// A folder is read once and its names are kept, sorted, so that of several that match it is always the same that is
// taken, and a model with many names costs no more than its folders.
#include "folder.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "confine.h"

// Limits that no honest model reaches. What is beyond them is found by its exact name alone.
enum { MOST_FOLDERS = 1024, MOST_NAMES = 1 << 17 };

struct scene_import_folder {
    struct scene_import_folder *next;
    const char *path;
    char **names;
    size_t count, capacity;
};

static int compare_names(const void *a, const void *b)
{
    char *const *const first = a, *const *const second = b;
    return strcmp(*first, *second);
}

static char *copy(struct scene_import *import, const char *text)
{
    const size_t size = strlen(text) + 1;
    return memcpy(scene_import_allocate(import, size, 1), text, size);
}

static void read_names(struct scene_import *import, struct scene_import_folder *folder)
{
    DIR *const directory = opendir(folder->path);
    if (directory == NULL) {
        return;
    }
    for (const struct dirent *entry = readdir(directory); entry != NULL && folder->count < MOST_NAMES;
         entry = readdir(directory)) {
        scene_import_reserve(import, &folder->names, &folder->capacity, folder->count + 1,
                             sizeof *folder->names);
        folder->names[folder->count++] = copy(import, entry->d_name);
    }
    closedir(directory);
    if (folder->count > 0) {
        qsort(folder->names, folder->count, sizeof *folder->names, compare_names);
    }
}

// Return the folder at a path, which has no names if there is none. Return NULL if there were too many.
static const struct scene_import_folder *open_folder(struct scene_import *import, const char *path)
{
    int count = 0;
    for (const struct scene_import_folder *known = import->folders; known != NULL; known = known->next) {
        if (strcmp(known->path, path) == 0) {
            return known;
        }
        count++;
    }
    if (count == MOST_FOLDERS) {
        return NULL;
    }
    struct scene_import_folder *const folder = scene_import_allocate(import, 1, sizeof *folder);
    folder->path = copy(import, path);
    folder->next = import->folders;
    import->folders = folder;
    read_names(import, folder);
    return folder;
}

// Return the folder that holds the last component of `path`.
static const struct scene_import_folder *folder_of(struct scene_import *import, char *path, char *component)
{
    if (component == path) {
        return open_folder(import, ".");
    }
    if (component - 1 == path) {
        return open_folder(import, "/");
    }
    component[-1] = 0;
    const struct scene_import_folder *const folder = open_folder(import, path);
    component[-1] = '/';
    return folder;
}

// Return true if the last component of `path` is in its folder. Replace it by a name that differs in case alone if it
// is not. A folder whose names cannot be read is asked for the one.
static bool match_case(struct scene_import *import, char *path, char *component)
{
    const struct scene_import_folder *const folder = folder_of(import, path, component);
    if (folder == NULL || folder->count == 0) {
        return access(path, F_OK) == 0;
    }
    char *const name = component;
    if (bsearch(&name, folder->names, folder->count, sizeof *folder->names, compare_names) != NULL) {
        return true;
    }
    const char *other = NULL;
    for (size_t i = 0; i < folder->count && other == NULL; i++) {
        other = strcasecmp(folder->names[i], component) == 0 ? folder->names[i] : NULL;
    }
    if (other != NULL) {
        memcpy(component, other, strlen(component)); // they are of one length
    }
    return other != NULL;
}

// Endings of images: those that can be read, the likeliest first, and behind them those of older programs.
static const char *const endings[] = {
    "png", "jpg", "jpeg", "tga", "dds", "tif", "tiff", "bmp", "webp", "ktx2", "psd", "gif", "avif", "hdr",
    "exr", "jpe", "jfif", "ppm", "pgm", "pnm", "dib",  "sgi", "rgb",  "rgba", "bw",  "iff", "pcx",  "pic",
    "pct", "jp2", "pict", "rle", "icb", "vda", "jps",  "cel", "vtf",  "blp",  "tx",  "svg",
};
enum { ENDINGS = sizeof endings / sizeof endings[0], READ_ENDINGS = 25 };

// Return the number of the ending of a name. Return ENDINGS if it is none of an image.
static int ending_of(const char *name)
{
    const char *const dot = strrchr(name, '.');
    int ending = 0;
    while (ending < ENDINGS && (dot == NULL || strcasecmp(dot + 1, endings[ending]) != 0)) {
        ending++;
    }
    return ending;
}

// Replace the last component of `path` by an image in its folder that is called as it is up to the ending.
static bool match_ending(struct scene_import *import, char *path, char *component)
{
    const struct scene_import_folder *const folder = folder_of(import, path, component);
    const size_t length =
        ending_of(component) < ENDINGS ? (size_t)(strrchr(component, '.') - component) : strlen(component);
    const char *found = NULL;
    int least = READ_ENDINGS;
    for (size_t i = 0; folder != NULL && i < folder->count; i++) {
        const char *const name = folder->names[i];
        if (strncasecmp(name, component, length) != 0 || name[length] != '.' ||
            strchr(name + length + 1, '.') != NULL) {
            continue;
        }
        const int ending = ending_of(name);
        if (ending < least) {
            found = name;
            least = ending;
        }
    }
    if (found != NULL) {
        strcpy(component, found);
    }
    return found != NULL;
}

// Make `path` exist up to the end of its last component.
static bool match(struct scene_import *import, char *path, char *component, bool any_ending)
{
    const bool is_special = component[0] == 0 || strcmp(component, ".") == 0 || strcmp(component, "..") == 0;
    if (any_ending) {
        return !is_special && match_ending(import, path, component);
    }
    return is_special || match_case(import, path, component);
}

bool scene_folder_find(struct scene_import *import, char *path, size_t known, bool any_ending)
{
    for (char *component = path + known; component != NULL;) {
        char *const slash = strchr(component, '/');
        if (slash != NULL) {
            *slash = 0;
        }
        const bool there = match(import, path, component, any_ending && slash == NULL);
        if (slash != NULL) {
            *slash = '/';
        }
        if (!there) {
            return false;
        }
        component = slash == NULL ? NULL : slash + 1;
    }
    return scene_import_is_file(import, path);
}

const char *scene_folder_only_image(struct scene_import *import, const char *path)
{
    const size_t length = strlen(path);
    char *const copied = scene_import_allocate(import, length + 256 + 1, 1);
    strcpy(copied, path);
    const struct scene_import_folder *const folder = folder_of(import, copied, copied + length);
    const char *only = NULL;
    size_t count = 0;
    for (size_t i = 0; folder != NULL && i < folder->count; i++) {
        const char *const name = folder->names[i];
        if (ending_of(name) < READ_ENDINGS && strlen(name) < 256) {
            strcpy(copied + length, name);
            const bool is_file = scene_import_is_file(import, copied);
            only = is_file ? name : only;
            count += is_file;
        }
    }
    if (count == 1) {
        strcpy(copied + length, only);
        return copied;
    }
    free(copied);
    return NULL;
}
