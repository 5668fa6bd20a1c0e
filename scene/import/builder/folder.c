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
    bool is_looked_through; // for its only image
    const char *only;       // NULL if there is none, or more
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
static struct scene_import_folder *open_folder(struct scene_import *import, const char *path)
{
    int count = 0;
    for (struct scene_import_folder *known = import->folders; known != NULL; known = known->next) {
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
static struct scene_import_folder *folder_of(struct scene_import *import, char *path, char *component)
{
    if (component == path) {
        return open_folder(import, ".");
    }
    if (component - 1 == path) {
        return open_folder(import, "/");
    }
    component[-1] = 0;
    struct scene_import_folder *const folder = open_folder(import, path);
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

// Return the number of the ending of an image that may be taken though nothing names it. Return ENDINGS for other
// names, and for images of formats that rhw writes: one may be a picture of the model, drawn by an earlier run.
static int loose_ending_of(const char *name)
{
    static const char *const written[] = {"png", "jpg", "jpeg", "webp", "exr", "ppm"};
    const int ending = ending_of(name);
    bool is_loose = ending < READ_ENDINGS;
    for (size_t i = 0; i < sizeof written / sizeof written[0] && is_loose; i++) {
        is_loose = strcmp(endings[ending], written[i]) != 0;
    }
    return is_loose ? ending : ENDINGS;
}

// Return the path of a name in the folder at `path` if it is a file, or NULL.
static const char *file_in(struct scene_import *import, const char *path, const char *name)
{
    char *const file = scene_import_allocate(import, strlen(path) + strlen(name) + 1, 1);
    strcat(strcpy(file, path), name);
    if (scene_import_is_file(import, file)) {
        return file;
    }
    free(file);
    return NULL;
}

// Return the folder at a path that ends with a slash.
static struct scene_import_folder *folder_at(struct scene_import *import, const char *path)
{
    char *const copied = copy(import, path);
    struct scene_import_folder *const folder = folder_of(import, copied, copied + strlen(copied));
    free(copied);
    return folder;
}

const char *scene_folder_own_image(struct scene_import *import, const char *path, const char *stem,
                                   bool if_written)
{
    const struct scene_import_folder *const folder = folder_at(import, path);
    const size_t length = strlen(stem);
    const char *found = NULL;
    int least = ENDINGS;
    for (size_t i = 0; folder != NULL && i < folder->count; i++) {
        const char *const name = folder->names[i];
        const int ending = if_written ? ending_of(name) : loose_ending_of(name);
        if (strncasecmp(name, stem, length) == 0 && strrchr(name, '.') == name + length && ending < least) {
            found = name;
            least = ending;
        }
    }
    return found == NULL ? NULL : file_in(import, path, found);
}

const char *scene_folder_only_image(struct scene_import *import, const char *path)
{
    struct scene_import_folder *const folder = folder_at(import, path);
    if (folder == NULL || folder->is_looked_through) {
        return folder == NULL ? NULL : folder->only;
    }
    int count = 0;
    for (size_t i = 0; i < folder->count && count < 2; i++) {
        const char *const file =
            loose_ending_of(folder->names[i]) < ENDINGS ? file_in(import, path, folder->names[i]) : NULL;
        count += file != NULL;
        folder->only = count == 1 && file != NULL ? file : folder->only;
    }
    folder->only = count == 1 ? folder->only : NULL;
    folder->is_looked_through = true;
    return folder->only;
}
