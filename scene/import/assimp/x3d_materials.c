// SPDX-License-Identifier: MIT
// assimp 5.2.5 knows the material of X3D 3 alone. What one without light sends out, and the base colour of a physically
// based one, are written as its diffuse colour. A shininess that no file has tells the first from others. Textures in
// the fields of a material are written behind it, where assimp takes the one that is there for that of the colour.
#include "x3d_materials.h"

#include "collada_markup.h"
#include "elementary.h"
#include "import/builder/import.h"
#include "x3d_made.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
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

// Return the end tag of the element whose start tag ends at `close`. Return NULL if it has none.
static char *find_end(char *close, const char *end, const char *name)
{
    size_t open = 1;
    for (char *tag = strchr(close, '<'); tag != NULL; tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, end);
        if (close == NULL) {
            return NULL;
        }
        open -= scene_collada_is_end(tag, name);
        open += scene_collada_is_tag(tag, name) && close[-1] != '/';
        if (open == 0) {
            return tag;
        }
    }
    return NULL;
}

// Return true if a texture in a material is that of its colour.
static bool is_of_color(const struct scene_x3d_materials *materials, struct scene_collada_value field)
{
    static const char *const fields[] = {"diffuseTexture", "baseTexture", NULL, "texture"};
    bool is_color = field.text == NULL;
    for (size_t i = 0; i < sizeof fields / sizeof fields[0] && !is_color; i++) {
        const char *const name = fields[i] != NULL ? fields[i] : materials->is_unlit ? "emissiveTexture" : "";
        is_color = field.length == strlen(name) && memcmp(field.text, name, field.length) == 0;
    }
    return is_color;
}

// Leave out a texture in a field of a material, unless it is the colour's, and move `close` to before its end tag.
static bool leave_texture(struct scene_import *import, struct scene_edits *edits,
                          struct scene_x3d_materials *materials, const struct scene_x3d_tag *texture,
                          const char *name)
{
    enum { LONGEST = 40 };
    char *const close = *texture->close;
    const struct scene_collada_value field = scene_collada_attribute(texture->tag, close, "containerField");
    if (is_of_color(materials, field) || materials->is_cut) {
        return false;
    }
    const char *last = close;
    if (close[-1] != '/') {
        char *const end = find_end(close, texture->end, name);
        last = end == NULL ? NULL : scene_collada_markup_end(end, texture->end);
        if (last == NULL) {
            materials->is_cut = true;
            return false;
        }
        *texture->close = end - 1;
    }
    scene_import_unsupported(
        import, "textures of the field %s (X3D): not used",
        scene_import_string(import, field.text, field.length < LONGEST ? field.length : LONGEST));
    scene_edits_add_string(import, edits, (size_t)(texture->tag - texture->text),
                           (size_t)(last - texture->tag) + 1, "");
    return true;
}

// Return the name of a texture that begins with this tag, or NULL.
static const char *find_texture(const char *tag)
{
    static const char *const nodes[] = {"ImageTexture", "PixelTexture", "MovieTexture", "MultiTexture"};
    for (size_t i = 0; i < sizeof nodes / sizeof nodes[0]; i++) {
        if (scene_collada_is_tag(tag, nodes[i])) {
            return nodes[i];
        }
    }
    return NULL;
}

void scene_x3d_write_appearance(struct scene_import *import, struct scene_edits *edits,
                                struct scene_x3d_materials *materials, const char *text, char *tag,
                                char *close)
{
    if (scene_collada_is_tag(tag, "Shape")) {
        materials->lacks_appearance =
            close[-1] != '/' && scene_collada_attribute(tag, close, "USE").text == NULL;
    } else if (scene_collada_is_tag(tag, "Appearance")) {
        materials->lacks_appearance = false;
    } else if (materials->lacks_appearance && scene_collada_is_end(tag, "Shape")) {
        scene_edits_add_string(import, edits, (size_t)(tag - text), 0, "<Appearance/>");
        materials->lacks_appearance = false;
    }
}

bool scene_assimp_write_material(struct scene_import *import, struct scene_edits *edits,
                                 struct scene_x3d_materials *materials, const struct scene_x3d_tag *found)
{
    const char *const text = found->text;
    char *const tag = found->tag, *const close = *found->close;
    const bool is_end = tag[1] == '/';
    const struct kind *kind = NULL;
    const char *const texture = materials->is_open ? find_texture(tag) : NULL;
    if (texture != NULL) {
        return leave_texture(import, edits, materials, found, texture);
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

static void read_pair(struct scene_import *import, char *tag, char *close, const char *name, double usual,
                      double pair[2])
{
    size_t count;
    double *const numbers = scene_x3d_numbers_of(import, tag, close, name, "", &count);
    pair[0] = count >= 2 ? numbers[0] : usual;
    pair[1] = count >= 2 ? numbers[1] : usual;
    free(numbers);
}

void scene_x3d_write_texture_transform(struct scene_import *import, struct scene_edits *edits,
                                       const char *text, char *tag, char *close)
{
    if (!scene_collada_is_tag(tag, "TextureTransform") ||
        scene_collada_attribute(tag, close, "USE").text != NULL) {
        return;
    }
    const struct scene_collada_value name = scene_collada_attribute(tag, close, "DEF");
    const double turn = scene_x3d_number_of(tag, close, "rotation", 0), c = scene_cos(turn),
                 s = scene_sin(turn);
    double center[2], move[2], scale[2];
    read_pair(import, tag, close, "center", 0, center);
    read_pair(import, tag, close, "translation", 0, move);
    read_pair(import, tag, close, "scale", 1, scale);
    // What the standard has is scale · turn · (place + move + center) − center.
    const double u = move[0] + center[0], v = move[1] + center[1];
    char *const tag_text = scene_import_allocate(import, name.length + 256, 1);
    snprintf(tag_text, name.length + 256,
             "<TextureTransform%s%.*s translation='%.9g %.9g' scale='%.9g %.9g' rotation='%.9g'%s>",
             name.text == NULL ? "" : " DEF=", (int)(name.text == NULL ? 0 : name.length + 2),
             name.text == NULL ? "" : name.text - 1, scale[0] * (c * u - s * v) - center[0],
             scale[1] * (s * u + c * v) - center[1], scale[0], scale[1], turn, close[-1] == '/' ? "/" : "");
    scene_edits_add_string(import, edits, (size_t)(tag - text), (size_t)(close - tag) + 1, tag_text);
    free(tag_text);
}
