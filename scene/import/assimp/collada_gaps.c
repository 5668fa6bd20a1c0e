// SPDX-License-Identifier: MIT
// What assimp leaves out of Collada without a word. It reads the blend mode of a texture and loses it, takes the colour
// of transparency for a number, and knows neither hidden nodes nor effects that are programs.
#include "assimp.h"
#include "collada_far.h"
#include "collada_markup.h"

#include <string.h>

struct look {
    struct scene_import *import;
    const char *end;
    bool is_transparent, is_by_color, is_inverted; // within <transparent>: what `opaque` says of it
    bool has_common, has_program;                  // profiles of the effect
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
    } else if (strncmp(tag, "</transparent", strlen("</transparent")) == 0) {
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
    if (strncmp(tag, "</effect>", strlen("</effect>")) == 0 && look->has_program && !look->has_common) {
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
            return;
        }
        look_at_transparency(&look, tag, close);
        look_at_effect(&look, tag);
        look_at_extensions(&look, tag, close);
    }
}
