// SPDX-License-Identifier: MIT
// Addresses of an X3D. A list of them is of strings in quotation marks, as in url='"wall.png" "http://…/wall.png"', of
// which assimp 5.2.5 refuses one, and makes one of several. It gets the one that is there, as it is found from the
// folder of the model.
#include "collada_markup.h"
#include "import/builder/find_file.h"
#include "x3d_document.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

// Pass quotation marks, which may be written as &quot;. Return their length, or 0 where there are none.
static size_t quote_at(const char *text, const char *end)
{
    static const char entity[] = "&quot;";
    const bool is_entity =
        (size_t)(end - text) >= strlen(entity) && memcmp(text, entity, strlen(entity)) == 0;
    return is_entity ? strlen(entity) : text < end && *text == '"' ? 1 : 0;
}

// Find the next string in quotation marks from `text` on. Return what follows it, or NULL where there is none.
static const char *next_string(const char *text, const char *end, struct scene_collada_value *string)
{
    while (text < end && quote_at(text, end) == 0) {
        text++;
    }
    if (text == end) {
        return NULL;
    }
    text += quote_at(text, end);
    string->text = (char *)(uintptr_t)text;
    while (text < end && quote_at(text, end) == 0) {
        text++;
    }
    string->length = (size_t)(text - string->text);
    return text == end ? NULL : text + quote_at(text, end);
}

// Return true for a name in a folder, which is no address of another place.
static bool is_relative(struct scene_collada_value string)
{
    return string.length > 0 && strchr("/\\", string.text[0]) == NULL &&
           memchr(string.text, ':', string.length) == NULL;
}

// Write a character, as a code if it is one of `coded`. Return where the next one goes.
static char *write_character(char *end, char c, const char *coded)
{
    const bool is_coded = strchr(coded, c) != NULL;
    *end = c;
    return end + (is_coded ? sprintf(end, "%%%02X", (unsigned)c) : 1);
}

// Return a string as it is seen from the folder of the model, with %20 for its blanks, which assimp leaves out, and
// codes for what names may have and attributes may not.
static char *locate(struct scene_import *import, const char *folder, struct scene_collada_value string)
{
    static const char entity[] = "&amp;";
    const size_t length = strlen(entity), most = strlen(folder) + string.length;
    char *const located = scene_import_allocate(import, 3 * most + 1, 1), *end = located;
    for (const char *c = is_relative(string) ? folder : ""; *c != 0; c++) {
        end = write_character(end, *c, " %&<>'\"");
    }
    for (size_t i = 0; i < string.length; i++) {
        const bool is_entity = string.length - i >= length && memcmp(string.text + i, entity, length) == 0;
        end = write_character(end, string.text[i], is_entity ? "&" : " ");
        i += is_entity ? length - 1 : 0;
    }
    *end = 0;
    return located;
}

static bool has_ending(const char *path, const char *ending)
{
    const char *const dot = strrchr(path, '.');
    return dot != NULL && strcasecmp(dot + 1, ending) == 0;
}

char *scene_x3d_choose_address(struct scene_import *import, const struct scene_x3d_document *document,
                               char *tag, char *close, const char *ending)
{
    enum { MOST = 16 };
    const struct scene_collada_value url = scene_collada_attribute(tag, close, "url");
    const char *place = url.text, *const end = url.text + url.length;
    struct scene_collada_value string;
    char *chosen = NULL;
    bool is_there = false;
    for (int i = 0; i < MOST && !is_there && place != NULL; i++) {
        place = next_string(place, end, &string);
        if (place == NULL && (i > 0 || url.length == 0)) {
            break;
        }
        char *const address = locate(import, document->folder, place == NULL ? url : string);
        const char *const path = scene_import_find_file(import, address);
        is_there = path != NULL && (ending == NULL || has_ending(path, ending));
        if (chosen == NULL || is_there) {
            free(chosen);
            chosen = address;
        } else {
            free(address);
        }
    }
    return chosen;
}

void scene_x3d_write_address(struct scene_import *import, struct scene_edits *edits,
                             const struct scene_x3d_document *document, const char *text, char *tag,
                             char *close)
{
    static const char *const nodes[] = {"ImageTexture", "MovieTexture", "AudioClip"};
    for (size_t i = 0; i < sizeof nodes / sizeof nodes[0]; i++) {
        char *const address = scene_collada_is_tag(tag, nodes[i])
                                  ? scene_x3d_choose_address(import, document, tag, close, NULL)
                                  : NULL;
        if (address != NULL) {
            const struct scene_collada_value url = scene_collada_attribute(tag, close, "url");
            scene_edits_add_string(import, edits, (size_t)(url.text - text), url.length, address);
            free(address);
        }
    }
}
