// SPDX-License-Identifier: MIT
// Collada for assimp. White space at the ends of a text is to be collapsed (XML Schema 4.3.6), but assimp 5.2.5 refuses
// a file for a blank before a colour. The blanks are moved into the tags before and behind, where XML allows them, so
// that nothing else of the file moves. Convex meshes, which it does not know, get the name of other meshes: they have
// the same parts.
#include "assimp.h"
#include "collada_markup.h"

#include <stdlib.h>
#include <string.h>

// Move the blanks at both ends of the text between the tag that ends at `before` and the end tag from `after` on.
static void move_blanks(char *before, char *after, const char *end)
{
    char *first = before + 1, *last = after;
    while (scene_collada_is_blank(*first)) {
        first++;
    }
    while (scene_collada_is_blank(last[-1])) {
        last--;
    }
    char *close = scene_collada_tag_end(after, end);
    if (first >= last || close == NULL) {
        return; // there are blanks alone
    }
    memset(before, ' ', (size_t)(first - 1 - before));
    first[-1] = '>';
    memmove(last, after, (size_t)(close - after));
    memset(last + (close - after), ' ', (size_t)(after - last));
}

void scene_assimp_collapse_texts(char *text, size_t size)
{
    const char *const end = text + size;
    char *before = NULL; // the end of a start tag, which texts stand behind
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(c, '<')) {
        const bool is_start = c[1] != '/' && c[1] != '!' && c[1] != '?';
        if (before != NULL && c[1] == '/') {
            move_blanks(before, c, end);
            c = strchr(before, '<'); // the end tag may begin earlier by now
        }
        char *close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            return;
        }
        before = is_start && close[-1] != '/' ? close : NULL;
        c = close;
    }
}

// Write the name of a mesh over that of a convex mesh, which is longer.
static void write_name(char *name)
{
    static const char convex[] = "convex_mesh", mesh[] = "mesh       ";
    _Static_assert(sizeof convex == sizeof mesh, "nothing else of the file moves");
    memcpy(name, mesh, sizeof mesh - 1);
}

void scene_assimp_rename_convex(char *text, size_t size)
{
    const char *const end = text + size;
    bool is_renamed = false;
    char *close;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(close, '<')) {
        close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            return;
        }
        if (scene_collada_is_tag(c, "convex_mesh")) {
            is_renamed = scene_collada_attribute(c, close, "convex_hull_of").text == NULL;
            if (is_renamed) {
                write_name(c + 1);
            }
        } else if (is_renamed && scene_collada_is_tag(c + 1, "convex_mesh")) {
            write_name(c + 2);
        }
    }
}
