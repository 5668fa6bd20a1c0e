// SPDX-License-Identifier: MIT
// What assimp leaves out of Collada without a word. It reads the blend mode of a texture and loses it, takes the colour
// of transparency for a number, and knows neither hidden nodes nor effects that are programs, nor geometries that are
// no meshes. Of these those are told that a node has: physics has some of its own.
#include "assimp.h"
#include "collada_far.h"
#include "collada_markup.h"
#include "import/builder/hash_table.h"

#include <stdlib.h>
#include <string.h>

// A geometry that assimp does not read.
struct geometry {
    struct scene_collada_value id;
    const char *what;
};

struct look {
    struct scene_import *import;
    const char *end;
    bool is_transparent, is_by_color, is_inverted; // within <transparent>: what `opaque` says of it
    bool has_common, has_program;                  // profiles of the effect
    struct scene_collada_value id;                 // names the geometry that was begun last
    struct geometry *geometries;
    size_t geometry_count, geometry_capacity;
    struct scene_hash_table places; // finds geometries by their ids
};

static bool is_value(struct scene_collada_value value, const char *text)
{
    return value.length == strlen(text) && memcmp(value.text, text, value.length) == 0;
}

// Return the text of an element, whose start tag ends at `close`, without blanks.
static struct scene_collada_value text_of(char *close)
{
    char *const text = close + 1 + strspn(close + 1, " \t\r\n");
    return (struct scene_collada_value){text, strcspn(text, " \t\r\n<")};
}

static void look_at_transparency(struct look *look, char *tag, char *close)
{
    double color[3] = {0, 0, 0};
    const char *text = close + 1;
    if (scene_collada_is_tag(tag, "transparent")) {
        const struct scene_collada_value mode = scene_collada_attribute(tag, close, "opaque");
        look->is_transparent = close[-1] != '/';
        look->is_by_color = is_value(mode, "RGB_ZERO") || is_value(mode, "RGB_ONE");
        look->is_inverted = is_value(mode, "RGB_ZERO") || is_value(mode, "A_ZERO");
    } else if (scene_collada_is_end(tag, "transparent")) {
        look->is_transparent = false;
    } else if (look->is_transparent && look->is_inverted && scene_collada_is_tag(tag, "texture")) {
        scene_import_unsupported(look->import, "inverted textures: drawn as they are");
    } else if (look->is_transparent && look->is_by_color && scene_collada_is_tag(tag, "color") &&
               scene_collada_numbers(&text, look->end, color, NULL, 3) == 3 &&
               (color[0] != color[1] || color[1] != color[2])) {
        scene_import_unsupported(look->import, "colours of transparency: not used");
    }
}

static void look_at_effect(struct look *look, const char *tag)
{
    static const char *const programs[] = {"profile_CG", "profile_GLSL", "profile_GLES", "profile_GLES2",
                                           "profile_BRIDGE"};
    if (scene_collada_is_tag(tag, "effect")) {
        look->has_common = look->has_program = false;
    }
    look->has_common = look->has_common || scene_collada_is_tag(tag, "profile_COMMON");
    for (size_t i = 0; i < sizeof programs / sizeof programs[0]; i++) {
        look->has_program = look->has_program || scene_collada_is_tag(tag, programs[i]);
    }
    if (scene_collada_is_end(tag, "effect") && look->has_program && !look->has_common) {
        scene_import_unsupported(look->import, "materials that are programs alone (Collada): drawn plain");
    }
}

static void look_at_extensions(struct look *look, const char *tag, char *close)
{
    enum { LONGEST = 20 };
    const struct scene_collada_value text = text_of(close);
    if (scene_collada_is_tag(tag, "blend_mode") && !is_value(text, "NONE") && !is_value(text, "MULTIPLY")) {
        scene_import_unsupported(
            look->import, "the blend mode %s of textures (Collada): not used",
            scene_import_string(look->import, text.text, text.length < LONGEST ? text.length : LONGEST));
    }
    if (scene_collada_is_tag(tag, "visibility") && (is_value(text, "0") || is_value(text, "false"))) {
        scene_import_unsupported(look->import, "hidden nodes: drawn");
    }
}

static const struct geometry *find_geometry(const struct look *look, struct scene_collada_value id)
{
    size_t place = SIZE_MAX;
    const uint32_t hash = scene_hash_bytes(id.text, id.length);
    for (uint32_t i = scene_hash_next(&look->places, hash, &place); i != UINT32_MAX;
         i = scene_hash_next(&look->places, hash, &place)) {
        const struct geometry *const geometry = &look->geometries[i];
        if (geometry->id.length == id.length && memcmp(geometry->id.text, id.text, id.length) == 0) {
            return geometry;
        }
    }
    return NULL;
}

// Note a geometry by a tag in it that says what it is. Of those with one id the first is meant.
static void look_at_geometry(struct look *look, char *tag, char *close)
{
    static const char *const kinds[][2] = {{"spline", "curves"},
                                           {"nurbs", "NURBS"},
                                           {"nurbs_surface", "NURBS"},
                                           {"brep", "boundary representations"},
                                           {"convex_mesh", "convex hulls of meshes"}};
    const char *what = NULL;
    if (scene_collada_is_tag(tag, "geometry")) {
        look->id = scene_collada_attribute(tag, close, "id");
    }
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0] && what == NULL; i++) {
        what = scene_collada_is_tag(tag, kinds[i][0]) ? kinds[i][1] : NULL;
    }
    const bool is_convex_mesh = scene_collada_is_tag(tag, "convex_mesh");
    if (what == NULL || look->id.text == NULL || find_geometry(look, look->id) != NULL ||
        (is_convex_mesh && scene_collada_attribute(tag, close, "convex_hull_of").text == NULL)) {
        return;
    }
    scene_import_reserve(look->import, &look->geometries, &look->geometry_capacity, look->geometry_count + 1,
                         sizeof *look->geometries);
    scene_hash_add(look->import, &look->places, scene_hash_bytes(look->id.text, look->id.length),
                   (uint32_t)look->geometry_count);
    look->geometries[look->geometry_count++] = (struct geometry){look->id, what};
}

// Tell of a geometry that a node has, if assimp does not read it.
static void look_at_instance(const struct look *look, struct scene_collada_value url)
{
    const struct geometry *const geometry =
        url.length > 1 && url.text[0] == '#'
            ? find_geometry(look, (struct scene_collada_value){url.text + 1, url.length - 1})
            : NULL;
    if (geometry != NULL) {
        scene_import_unsupported(look->import, "%s: not drawn", geometry->what);
    }
}

// Look for the geometries that nodes have.
static void look_at_nodes(const struct look *look, char *text)
{
    static const char physics[] = "</library_physics_models";
    bool is_physics = false;
    char *close;
    for (char *tag = strchr(text, '<'); tag != NULL && look->geometry_count > 0; tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, look->end);
        if (close == NULL) {
            return;
        }
        is_physics = (is_physics || (scene_collada_is_tag(tag, physics + 2) && close[-1] != '/')) &&
                     strncmp(tag, physics, strlen(physics)) != 0;
        if (!is_physics && scene_collada_is_tag(tag, "instance_geometry")) {
            look_at_instance(look, scene_collada_attribute(tag, close, "url"));
        }
    }
}

void scene_assimp_look_at_collada(struct scene_import *import, char *text, size_t size)
{
    struct look look = {.import = import, .end = text + size};
    if (strstr(text, "<COLLADA") == NULL) {
        return;
    }
    char *close;
    for (char *tag = strchr(text, '<'); tag != NULL; tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, look.end);
        if (close == NULL) {
            break;
        }
        look_at_transparency(&look, tag, close);
        look_at_effect(&look, tag);
        look_at_extensions(&look, tag, close);
        look_at_geometry(&look, tag, close);
    }
    look_at_nodes(&look, text);
    free(look.geometries);
    free(look.places.entries);
}
