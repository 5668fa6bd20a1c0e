// SPDX-License-Identifier: MIT
// Skins of models for games. Their files name one that the game has elsewhere, or none, as the game chooses it. It lies
// beside them: called as the model is, or skin, or as the only image there or one folder above.
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

// Return the path of the only image in a folder, or NULL.
static const char *find_only(struct scene_import *import, const char *above)
{
    const char *const folder = import->directory[0] != 0 ? import->directory : "./";
    const size_t room = strlen(folder) + strlen(above) + 1;
    char *const path = scene_import_allocate(import, room, 1);
    strcat(strcpy(path, folder), above);
    const char *const found = scene_folder_only_image(import, path);
    free(path);
    return found;
}

bool scene_assimp_find_skin(struct scene_import *import, struct scene_import_source *source)
{
    const char *const slash = strrchr(import->name, '/'),
                      *const file = slash == NULL ? import->name : slash + 1, *const dot = strrchr(file, '.');
    char own[256];
    snprintf(own, sizeof own, "%.*s.png", dot == NULL ? 0 : (int)(dot - file), file);
    const char *const names[] = {own, "skin.png", "../skin.png"};
    for (size_t i = 0; i < sizeof names / sizeof names[0] && source->file == NULL; i++) {
        scene_import_find_image(import, NULL, names[i], source);
    }
    static const char *const folders[] = {"", "../"};
    for (size_t i = 0; i < sizeof folders / sizeof folders[0] && source->file == NULL; i++) {
        source->file = find_only(import, folders[i]);
    }
    return source->file != NULL;
}
