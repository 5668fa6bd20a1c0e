// SPDX-License-Identifier: MIT
#include "archive.h"

#include <stdlib.h>
#include <string.h>

#include "name_forms.h"

void scene_import_enter_archive(struct scene_import *import, struct scene_zip *zip, const char *entry)
{
    if (import->archive != NULL) {
        return;
    }
    const char *const slash = strrchr(entry, '/');
    struct scene_import_archive *const archive = scene_import_allocate(import, 1, sizeof *archive);
    const size_t length = slash == NULL ? 0 : (size_t)(slash + 1 - entry);
    archive->zip = zip;
    archive->folder = scene_import_string(import, entry, length);
    import->archive = archive;
}

// Take the components . and .. out of a path, with what the latter are of. Leave out slashes before it.
static void simplify(char *path)
{
    char *out = path;
    for (const char *c = path; *c != 0;) {
        const size_t length = strcspn(c, "/");
        if (length == 2 && strncmp(c, "..", 2) == 0) {
            out -= out > path;
            while (out > path && out[-1] != '/') {
                out--;
            }
        } else if (length > 0 && !(length == 1 && *c == '.')) {
            memmove(out, c, length);
            out += length;
            *out = c[length];
            out += c[length] == '/';
        }
        c += length + (c[length] == '/');
    }
    *out = 0;
}

// Return a name in small letters, as the case of an entry's name is ignored.
static char *in_small_letters(struct scene_import *import, const char *name)
{
    const size_t length = strlen(name);
    char *const small = scene_import_allocate(import, length + 1, 1);
    for (size_t i = 0; i < length; i++) {
        small[i] = (char)(name[i] >= 'A' && name[i] <= 'Z' ? name[i] - 'A' + 'a' : name[i]);
    }
    return small;
}

// Return the bytes of an entry, which is read where it was not yet. Return NULL if there is none.
static void *read_entry(struct scene_import *import, const char *name, size_t *size)
{
    struct scene_import_archive *const archive = import->archive;
    char *const small = in_small_letters(import, name);
    const uint32_t hash = scene_hash_bytes(small, strlen(small));
    size_t place = SIZE_MAX;
    uint32_t i = scene_hash_next(&archive->names, hash, &place);
    while (i != UINT32_MAX && strcmp(archive->entries[i].name, small) != 0) {
        i = scene_hash_next(&archive->names, hash, &place);
    }
    if (i != UINT32_MAX) {
        free(small);
        *size = archive->entries[i].size;
        return archive->entries[i].bytes;
    }
    void *const bytes = scene_zip_read_all(archive->zip, name, size);
    if (bytes == NULL) {
        free(small);
        return NULL;
    }
    scene_import_reserve(import, &archive->entries, &archive->capacity, archive->count + 1,
                         sizeof *archive->entries);
    scene_hash_add(import, &archive->names, hash, (uint32_t)archive->count);
    archive->entries[archive->count++] = (struct scene_import_entry){small, bytes, *size};
    return bytes;
}

// Find a name in the folder of the model, and then its last component anywhere.
static void *find_form(struct scene_import *import, const char *name, size_t *size)
{
    const struct scene_import_archive *const archive = import->archive;
    const bool is_whole = name[0] == '/';
    const size_t folder = is_whole ? 0 : strlen(archive->folder);
    char *const path = scene_import_allocate(import, folder + strlen(name) + 2, 1);
    memcpy(path, archive->folder, folder);
    strcpy(path + folder, name);
    simplify(path);
    void *bytes = path[0] == 0 ? NULL : read_entry(import, path, size);
    const char *const slash = strrchr(path, '/'), *const file = slash == NULL ? path : slash + 1;
    if (bytes == NULL && file[0] != 0) {
        bytes = read_entry(import, file, size);
    }
    if (bytes == NULL && file[0] != 0) {
        char *const ending = scene_import_allocate(import, strlen(file) + 2, 1);
        ending[0] = '/';
        strcpy(ending + 1, file);
        const char *const moved = scene_zip_find_ending(archive->zip, ending);
        bytes = moved == NULL ? NULL : read_entry(import, moved, size);
        free(ending);
    }
    free(path);
    return bytes;
}

void *scene_import_find_entry(struct scene_import *import, const char *name, size_t *size)
{
    struct scene_name_forms forms = {0};
    void *bytes = NULL;
    if (import->archive == NULL) {
        return NULL;
    }
    scene_name_forms_add(import, &forms, strncmp(name, "file://", 7) == 0 ? name + 7 : name);
    for (size_t i = 0; i < forms.count && bytes == NULL; i++) {
        bytes = find_form(import, forms.names[i], size);
    }
    scene_name_forms_free(&forms);
    return bytes;
}
