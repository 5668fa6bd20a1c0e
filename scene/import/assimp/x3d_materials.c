// SPDX-License-Identifier: MIT
// assimp 5.2.5 knows the material of X3D 3 alone. One without light has its colour in what it sends out, and the base
// colour of a physically based one is its diffuse colour.
#include "x3d_materials.h"

#include "collada_markup.h"
#include "import/builder/import.h"

#include <stdio.h>
#include <string.h>

static const struct kind {
    const char *name;
    const char *color,
        *written;     // the attribute that has its colour, 1 1 1 where it has none, and how it is written
    const char *more; // attributes
    const char *told; // what is lost; NULL if nothing is
} kinds[] = {
    {"UnlitMaterial", "emissiveColor", "emissiveColor", " diffuseColor='0 0 0' specularColor='0 0 0'", NULL},
    {"PhysicalMaterial", "baseColor", "diffuseColor", "",
     "physically based materials (X3D): drawn dull, in their base colour"},
};

bool scene_assimp_write_material(struct scene_import *import, struct scene_edits *edits, const char *text,
                                 char *tag, char *close)
{
    const bool is_end = tag[1] == '/';
    const struct kind *kind = NULL;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0] && kind == NULL; i++) {
        kind = scene_collada_is_tag(tag + is_end, kinds[i].name) ? &kinds[i] : NULL;
    }
    if (kind == NULL) {
        return false;
    }
    const struct scene_collada_value color = scene_collada_attribute(tag, close, kind->color);
    const bool is_used = is_end || scene_collada_attribute(tag, close, "USE").text != NULL;
    char name[128];
    snprintf(name, sizeof name, "Material%s%s%s%s", is_used ? "" : kind->more,
             is_used || color.text != NULL ? "" : " ", is_used || color.text != NULL ? "" : kind->written,
             is_used || color.text != NULL ? "" : "='1 1 1'");
    scene_edits_add_string(import, edits, (size_t)(tag + is_end + 1 - text), strlen(kind->name), name);
    if (!is_used && color.text != NULL && strcmp(kind->color, kind->written) != 0) {
        const char *const attribute = strstr(tag, kind->color);
        scene_edits_add_string(import, edits, (size_t)(attribute - text), strlen(kind->color), kind->written);
    }
    if (kind->told != NULL && !is_end) {
        scene_import_unsupported(import, "%s", kind->told);
    }
    return true;
}
