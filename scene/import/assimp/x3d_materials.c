// SPDX-License-Identifier: MIT
// assimp 5.2.5 knows the material of X3D 3 alone. What one without light sends out, and the base colour of a physically
// based one, are written as its diffuse colour. A shininess that no file has tells the first from others. Textures in
// the fields of a material are written behind it, where assimp takes the one that is there for that of the colour.
#include "x3d_materials.h"

#include "collada_markup.h"
#include "import/builder/import.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct kind {
    const char *name;
    const char *color; // the attribute that has its colour
    float shininess;   // NAN if it is left as it is
    const char *told;  // what is lost; NULL if nothing is
} kinds[] = {
    {"Material", "diffuseColor", NAN, NULL},
    {"UnlitMaterial", "emissiveColor", SCENE_X3D_UNLIT, NULL},
    {"PhysicalMaterial", "baseColor", NAN,
     "physically based materials (X3D): drawn dull, in their base colour"},
};

static const char written[] = "diffuseColor";

// Write the tags of a texture in a field of a material as those of a comment, unless it is the colour's. `tag` is a
// start tag, or the end of the texture that was left out last.
static void write_texture(struct scene_import *import, struct scene_edits *edits,
                          struct scene_x3d_materials *materials, const char *text, char *tag, char *close)
{
    enum { LONGEST = 40 };
    static const char *const fields[] = {"diffuseTexture", "baseTexture", NULL, "texture"};
    const size_t at = (size_t)(tag - text), length = (size_t)(close - tag) + 1;
    if (tag[1] == '/') {
        scene_edits_add_string(import, edits, at, length, " -->");
        materials->left = NULL;
        return;
    }
    const struct scene_collada_value field = scene_collada_attribute(tag, close, "containerField");
    bool is_color = field.text == NULL;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0] && !is_color; i++) {
        const char *const name = fields[i] != NULL ? fields[i] : materials->is_unlit ? "emissiveTexture" : "";
        is_color = field.length == strlen(name) && memcmp(field.text, name, field.length) == 0;
    }
    if (is_color) {
        return;
    }
    scene_import_unsupported(
        import, "textures of the field %s (X3D): not used",
        scene_import_string(import, field.text, field.length < LONGEST ? field.length : LONGEST));
    scene_edits_add_string(import, edits, at, length, close[-1] == '/' ? "" : "<!-- ");
    if (close[-1] != '/') {
        materials->left = tag + 1;
        materials->left_length = strcspn(tag + 1, " \t\r\n>");
    }
}

// Return true for a tag of a texture that stands in a material, or for the end of one that was left out.
static bool is_texture(const struct scene_x3d_materials *materials, const char *tag)
{
    static const char *const nodes[] = {"ImageTexture", "PixelTexture", "MovieTexture", "MultiTexture"};
    if (materials->left != NULL) {
        return tag[1] == '/' && strncmp(tag + 2, materials->left, materials->left_length) == 0;
    }
    bool is_node = false;
    for (size_t i = 0; i < sizeof nodes / sizeof nodes[0] && materials->is_open; i++) {
        is_node = is_node || scene_collada_is_tag(tag, nodes[i]);
    }
    return is_node;
}

bool scene_assimp_write_material(struct scene_import *import, struct scene_edits *edits,
                                 struct scene_x3d_materials *materials, const char *text, char *tag,
                                 char *close)
{
    const bool is_end = tag[1] == '/';
    const struct kind *kind = NULL;
    if (is_texture(materials, tag)) {
        const size_t before = edits->count;
        write_texture(import, edits, materials, text, tag, close);
        return edits->count > before;
    }
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0] && kind == NULL; i++) {
        kind = scene_collada_is_tag(tag + is_end, kinds[i].name) ? &kinds[i] : NULL;
    }
    if (kind == NULL || (is_end && !materials->is_open)) {
        return false;
    }
    if (is_end) { // its start tag has ended it
        scene_edits_add_string(import, edits, (size_t)(tag - text), (size_t)(close - tag) + 1, "");
        materials->is_open = false;
        return true;
    }
    const struct scene_collada_value color = scene_collada_attribute(tag, close, kind->color);
    const bool is_used = scene_collada_attribute(tag, close, "USE").text != NULL;
    char name[128], more[64] = "";
    if (!is_used && !isnan(kind->shininess)) {
        snprintf(more, sizeof more, " shininess='%g'", (double)kind->shininess);
    }
    snprintf(name, sizeof name,
             is_used || color.text != NULL || kind == kinds ? "Material%s" : "Material%s %s='1 1 1'", more,
             written);
    scene_edits_add_string(import, edits, (size_t)(tag + 1 - text), strlen(kind->name), name);
    if (!is_used && color.text != NULL && kind != kinds) {
        const char *const attribute = scene_collada_name_end(color) - strlen(kind->color);
        scene_edits_add_string(import, edits, (size_t)(attribute - text), strlen(kind->color), written);
    }
    materials->is_open = close[-1] != '/';
    materials->is_unlit = !isnan(kind->shininess);
    if (materials->is_open) {
        scene_edits_add_string(import, edits, (size_t)(close - text), 0, "/");
    }
    if (kind->told != NULL) {
        scene_import_unsupported(import, "%s", kind->told);
    }
    return true;
}
