// SPDX-License-Identifier: MIT
// See x3d_names.h.
#include "x3d_names.h"

#include "import/builder/import.h"

#include <stdlib.h>
#include <string.h>

const struct scene_x3d_name *scene_x3d_find_name(const struct scene_x3d_names *names,
                                                 struct scene_collada_value name)
{
    size_t place = SIZE_MAX;
    const uint32_t hash = scene_hash_bytes(name.text, name.length);
    for (uint32_t i = scene_hash_next(&names->places, hash, &place); i != UINT32_MAX;
         i = scene_hash_next(&names->places, hash, &place)) {
        if (names->names[i].name.length == name.length &&
            memcmp(names->names[i].name.text, name.text, name.length) == 0) {
            return &names->names[i];
        }
    }
    return NULL;
}

void scene_x3d_add_name(struct scene_import *import, struct scene_x3d_names *names,
                        struct scene_x3d_name node)
{
    if (node.name.text == NULL || scene_x3d_find_name(names, node.name) != NULL) {
        return;
    }
    scene_import_reserve(import, &names->names, &names->capacity, names->count + 1, sizeof *names->names);
    scene_hash_add(import, &names->places, scene_hash_bytes(node.name.text, node.name.length),
                   (uint32_t)names->count);
    names->names[names->count++] = node;
}

void scene_x3d_free_names(struct scene_x3d_names *names)
{
    free(names->names);
    free(names->places.entries);
}
