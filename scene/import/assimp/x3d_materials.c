// SPDX-License-Identifier: MIT
// assimp 5.2.5 knows the material of X3D 3 alone. What one without light sends out, and the base colour of a physically
// based one, are written as its diffuse colour. A shininess that no file has tells the first from others.
#include "x3d_materials.h"

#include "collada_markup.h"
#include "import/builder/import.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct kind {
    const char *name;
    const char *color; // the attribute that has its colour, 1 1 1 where it has none
    float shininess;   // NAN if it is left as it is
    const char *told;  // what is lost; NULL if nothing is
} kinds[] = {
    {"UnlitMaterial", "emissiveColor", SCENE_X3D_UNLIT, NULL},
    {"PhysicalMaterial", "baseColor", NAN,
     "physically based materials (X3D): drawn dull, in their base colour"},
};

static const char written[] = "diffuseColor";

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
    char name[128], more[64] = "";
    if (!is_used && !isnan(kind->shininess)) {
        snprintf(more, sizeof more, " shininess='%g'", (double)kind->shininess);
    }
    snprintf(name, sizeof name, is_used || color.text != NULL ? "Material%s" : "Material%s %s='1 1 1'", more,
             written);
    scene_edits_add_string(import, edits, (size_t)(tag + is_end + 1 - text), strlen(kind->name), name);
    if (!is_used && color.text != NULL) {
        const char *const attribute = scene_collada_name_end(color) - strlen(kind->color);
        scene_edits_add_string(import, edits, (size_t)(attribute - text), strlen(kind->color), written);
    }
    if (kind->told != NULL && !is_end) {
        scene_import_unsupported(import, "%s", kind->told);
    }
    return true;
}
