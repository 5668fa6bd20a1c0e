// SPDX-License-Identifier: MIT
// Shapes of an X3D that stand for others where something collides with them, and are not seen. assimp 5.2.5 draws them,
// so they get into a switch that shows nothing. They stay in the file, as they may be used again.
#include "assimp.h"
#include "collada_markup.h"
#include "edits.h"

#include <stdlib.h>
#include <string.h>

// An element that is open.
struct element {
    size_t at;
    bool is_proxy;
};

static bool is_proxy(char *tag, char *close)
{
    static const char proxy[] = "proxy";
    const struct scene_collada_value field = scene_collada_attribute(tag, close, "containerField");
    return field.length == strlen(proxy) && memcmp(field.text, proxy, strlen(proxy)) == 0;
}

// Hide an element, from its first < to its last >, which take part in no other change.
static void hide(struct scene_import *import, struct scene_edits *edits, size_t first, size_t last)
{
    scene_edits_add_string(import, edits, first, 1, "<Switch whichChoice=\"-1\"><");
    scene_edits_add_string(import, edits, last, 1, "></Switch>");
}

char *scene_assimp_hide_proxies(struct scene_import *import, char *text, size_t *size)
{
    struct scene_edits edits = {0};
    struct element *open = NULL;
    size_t count = 0, capacity = 0;
    char *close;
    for (char *tag = strchr(text, '<'); tag != NULL; tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, text + *size);
        if (close == NULL) {
            break;
        }
        const size_t last = (size_t)(close - text);
        if (tag[1] == '/' && count > 0 && open[--count].is_proxy) {
            hide(import, &edits, open[count].at, last);
        } else if (tag[1] != '/' && tag[1] != '!' && tag[1] != '?') {
            const struct element element = {(size_t)(tag - text), is_proxy(tag, close)};
            if (close[-1] != '/') {
                scene_import_reserve(import, &open, &capacity, count + 1, sizeof *open);
                open[count++] = element;
            } else if (element.is_proxy) {
                hide(import, &edits, element.at, last);
            }
        }
    }
    free(open);
    char *const written = edits.count == 0 ? NULL : scene_edits_apply(import, &edits, text, size);
    if (written == NULL) {
        return text;
    }
    free(text);
    return written;
}
