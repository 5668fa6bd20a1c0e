// SPDX-License-Identifier: MIT
// Skins of models for games. Their files name one that the game has elsewhere, or none, as the game chooses it. It lies
// beside them: one folder above by the name itself, called as the model is, or skin, or as the only image there or one
// folder above. Where the file does not name it and it is not called skin, it is of a format that rhw does not write,
// so that no picture of a model becomes its skin.
#include "skins.h"

#include "import/builder/find_file.h"
#include "import/builder/folder.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

bool scene_assimp_has_skins(const struct scene_import *import)
{
    static const char *const endings[] = {"md2", "md3", "mdc"};
    bool has = false;
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++) {
        has = has || strcasecmp(import->ending, endings[i]) == 0;
    }
    return has;
}

// Return the path of the folder of a model, or of the one above it, which ends with a slash.
static char *folder_path(struct scene_import *import, bool is_above)
{
    static const char above[] = "../";
    const char *const folder = import->directory[0] != 0 ? import->directory : "./";
    char *const path = scene_import_allocate(import, strlen(folder) + sizeof above, 1);
    return strcat(strcpy(path, folder), is_above ? above : "");
}

// Find the file of the last component of a name one folder above.
static const char *find_above(struct scene_import *import, const char *name)
{
    const char *component = name;
    for (const char *at = name; *at != 0; at++) {
        component = *at == '/' || *at == '\\' ? at + 1 : component;
    }
    char *const above = scene_import_allocate(import, strlen(component) + 4, 1);
    strcat(strcpy(above, "../"), component);
    const char *const file = scene_import_find_file(import, above);
    free(above);
    return file;
}

// Tell of an image that is called as the model is and is not taken.
static void tell_of_picture(struct scene_import *import, const char *folder, const char *stem)
{
    const char *const picture = scene_folder_own_image(import, folder, stem, true);
    if (picture != NULL) {
        scene_import_warn(import,
                          "\"%s\" may be a picture of the model; a skin is taken if it is called skin",
                          picture + strlen(folder));
    }
}

bool scene_assimp_find_skin(struct scene_import *import, const char *name, struct scene_import_source *source)
{
    const char *const slash = strrchr(import->name, '/'),
                      *const file = slash == NULL ? import->name : slash + 1, *const dot = strrchr(file, '.');
    char *const stem = scene_import_allocate(import, strlen(file) + 1, 1);
    memcpy(stem, file, dot == NULL ? 0 : (size_t)(dot - file));
    char *const folders[] = {folder_path(import, false), folder_path(import, true)};
    source->file = name == NULL ? NULL : find_above(import, name);
    source->file =
        source->file != NULL ? source->file : scene_folder_own_image(import, folders[0], stem, false);
    static const char *const names[] = {"skin.png", "../skin.png"};
    const bool is_skin = strcasecmp(stem, "skin") == 0; // a picture of this model is called skin too
    for (size_t i = 0; i < sizeof names / sizeof names[0] && source->file == NULL && !is_skin; i++) {
        scene_import_find_image(import, NULL, names[i], source);
    }
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        source->file = source->file != NULL ? source->file : scene_folder_only_image(import, folders[i]);
    }
    if (source->file == NULL) {
        tell_of_picture(import, folders[0], stem);
    }
    free(folders[0]);
    free(folders[1]);
    free(stem);
    return source->file != NULL;
}
