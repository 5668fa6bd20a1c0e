// SPDX-License-Identifier: MIT
// Files that an X3D shows (Inline). assimp 5.2.5 crashes where one is not there, or shows the other one in turn, and
// looks for its textures beside the outer file. So each becomes a group of what it has.
#include "assimp.h"
#include "collada_markup.h"
#include "file.h"
#include "import/builder/find_file.h"
#include "import/builder/name_forms.h"
#include "x3d_document.h"
#include "x3d_groups.h"
#include "x3d_made.h"

#include <stdlib.h>
#include <string.h>

// Return true if a file is the document, or one that shows it. Set how many there are.
static bool is_open(const struct scene_x3d_document *document, const char *path, size_t *depth)
{
    char *const resolved = system_file_resolve(path);
    bool is_same = false;
    *depth = 0;
    for (; document != NULL && resolved != NULL && !is_same; document = document->outer) {
        char *const other = system_file_resolve(document->path);
        is_same = other != NULL && strcmp(other, resolved) == 0;
        ++*depth;
        free(other);
    }
    free(resolved);
    return is_same;
}

// Return the folder of a file as it is seen from that of the model.
static const char *folder_of(struct scene_import *import, const char *path)
{
    const char *const own = import->directory[0] != 0 ? import->directory : "./";
    const char *const from = strncmp(path, own, strlen(own)) == 0 ? path + strlen(own) : path;
    const char *const slash = strrchr(from, '/');
    return slash == NULL ? "" : scene_import_string(import, from, (size_t)(slash + 1 - from));
}

// Return what a scene has. Its text is NULL where there is none, or where its end is not there, which is set.
static struct scene_collada_value find_scene(char *text, size_t size, bool *is_cut)
{
    char *close, *scene = NULL;
    for (char *tag = strchr(text, '<'); tag != NULL; tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, text + size);
        if (close == NULL) {
            break;
        }
        const bool is_scene = scene == NULL && scene_collada_is_tag(tag, "Scene");
        if (is_scene) {
            scene = close + 1;
        }
        if (is_scene && close[-1] == '/') {
            return (struct scene_collada_value){scene, 0};
        }
        if (scene != NULL && scene_collada_is_end(tag, "Scene")) {
            return (struct scene_collada_value){scene, (size_t)(tag - scene)};
        }
    }
    *is_cut = scene != NULL;
    return (struct scene_collada_value){NULL, 0};
}

// Return the text of the file that a tag shows, and what of it is its scene. Return NULL if it is not shown, which is
// told.
static char *read_shown(struct scene_import *import, const struct scene_x3d_document *document, char *tag,
                        char *close, struct scene_collada_value *scene)
{
    enum { DEEPEST = 32, LEAST = 4096 };
    if (scene_x3d_is_false(tag, close, "load")) {
        scene_import_unsupported(import, "files that are loaded later (X3D): not drawn");
        return NULL;
    }
    char *const address = scene_x3d_choose_address(import, document, tag, close, "x3d");
    const char *const path = address == NULL ? NULL : scene_import_find_file(import, address);
    if (address != NULL) {
        scene_name_decode_percent(address); // for messages
    }
    const char *const name = address == NULL ? "" : scene_import_string(import, address, strlen(address));
    free(address);
    size_t depth, size;
    if (path == NULL) {
        scene_import_warn(import, "file \"%s\", which it shows: %s; not drawn", name,
                          address == NULL ? "has no name" : import->missing);
        return NULL;
    }
    if (is_open(document, path, &depth)) {
        scene_import_unsupported(import, "files that show each other (X3D): not drawn again");
        return NULL;
    }
    struct scene_x3d_room *const room = document->room;
    const struct scene_x3d_document shown = {path, folder_of(import, path), document, room};
    const bool is_room = depth < DEEPEST && room->shown >= LEAST && room->read > 0;
    room->shown -= is_room ? LEAST : 0;
    const size_t before = room->shown;
    char *const text = is_room ? scene_x3d_read_document(import, &shown, &size) : NULL;
    bool is_cut = false;
    *scene = text == NULL ? (struct scene_collada_value){NULL, 0} : find_scene(text, size, &is_cut);
    // What it shows itself has been counted. What stands around its scene is read and made as well.
    const size_t whole = text == NULL ? 0 : size, counted = before - room->shown,
                 more = whole > counted ? whole - counted : 0;
    room->read -= whole < room->read ? whole : room->read;
    if (is_room && scene->text == NULL) {
        scene_import_warn(import, "file \"%s\", which it shows: %s; not drawn", name,
                          is_cut ? "is cut before the end of its scene" : "is no X3D in XML");
    } else if (!is_room || more > room->shown) {
        scene_import_unsupported(import, "files that are shown (X3D): not all drawn");
        *scene = (struct scene_collada_value){NULL, 0};
    } else {
        room->shown -= more;
        scene_assimp_find_gaps_within(import, path);
    }
    if (scene->text == NULL) {
        free(text);
        return NULL;
    }
    return text;
}

bool scene_x3d_write_inline(struct scene_import *import, struct scene_edits *edits,
                            const struct scene_x3d_document *document, const char *text, char *tag,
                            char *close)
{
    static const char start[] = "<Group>" SCENE_X3D_FILLER, end[] = "</Group>";
    const size_t at = (size_t)(tag - text), length = (size_t)(close - tag) + 1;
    if (scene_collada_is_end(tag, "Inline")) {
        scene_edits_add_string(import, edits, at, length, end);
        return true;
    }
    if (!scene_collada_is_tag(tag, "Inline")) {
        return false;
    }
    struct scene_collada_value scene = {NULL, 0};
    char *const shown = read_shown(import, document, tag, close, &scene);
    char *const group = scene_import_allocate(import, sizeof start + scene.length + sizeof end, 1);
    strcpy(group, start);
    memcpy(group + strlen(start), scene.text != NULL ? scene.text : "", scene.length);
    strcpy(group + strlen(start) + scene.length, close[-1] == '/' ? end : "");
    scene_edits_add(import, edits,
                    (struct scene_edit){at, length, group,
                                        strlen(start) + scene.length + (close[-1] == '/' ? strlen(end) : 0)});
    free(shown);
    return true;
}
