// SPDX-License-Identifier: MIT
#include "archive.h"

#include <stdlib.h>
#include <string.h>

#include "name_forms.h"

void scene_import_enter_archive(struct scene_import *import, struct scene_zip *zip, const char *entry)
{
    const char *const slash = strrchr(entry, '/');
    struct scene_import_archive *const archive = scene_import_allocate(import, 1, sizeof *archive);
    *archive = (struct scene_import_archive){
        zip, scene_import_string(import, entry, slash == NULL ? 0 : (size_t)(slash + 1 - entry))};
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
    void *bytes = path[0] == 0 ? NULL : scene_zip_read_all(archive->zip, path, size);
    const char *const slash = strrchr(path, '/'), *const file = slash == NULL ? path : slash + 1;
    if (bytes == NULL && file[0] != 0) {
        bytes = scene_zip_read_all(archive->zip, file, size);
    }
    if (bytes == NULL && file[0] != 0) {
        char *const ending = scene_import_allocate(import, strlen(file) + 2, 1);
        ending[0] = '/';
        strcpy(ending + 1, file);
        const char *const moved = scene_zip_find_ending(archive->zip, ending);
        bytes = moved == NULL ? NULL : scene_zip_read_all(archive->zip, moved, size);
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
