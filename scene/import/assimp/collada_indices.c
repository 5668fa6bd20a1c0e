// SPDX-License-Identifier: MIT
// Indices of Collada for assimp. assimp 5.2.5 reads the list of a <p> for ever where it meets what is no whole number,
// and takes a negative one, or one beyond 31 bits, for another. Blanks replace the list from there on, and assimp then
// refuses a mesh that has fewer indices than it counts.
#include "assimp.h"
#include "collada_markup.h"
#include "import/builder/import.h"

#include <string.h>

static const char left_out[] = ", which is no index: left out with all that follow";

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

// Return the first character of a list that belongs to no index. Return `end` where there is none.
static char *find_stranger(char *list, char *end)
{
    uint64_t number = 0;
    for (char *c = list; c < end; c++) {
        const bool is_sign = *c == '+' && c + 1 < end && is_digit(c[1]);
        number = is_digit(*c) ? 10 * number + (uint64_t)(*c - '0') : 0;
        if ((!is_digit(*c) && !is_sign && !scene_collada_is_blank(*c)) || number > INT32_MAX) {
            return c;
        }
    }
    return end;
}

static void check_list(struct scene_import *import, char *list, char *end)
{
    char *const stranger = find_stranger(list, end);
    if (stranger == end) {
        return;
    }
    char *word = stranger;
    while (word > list && !scene_collada_is_blank(word[-1])) {
        word--;
    }
    const size_t length = (size_t)(end - word), blank = strcspn(word, " \t\r\n<"), most = 20;
    const size_t shown = blank < length ? blank : length;
    scene_import_warn(import, "a <p> has \"%.*s\"%s", (int)(shown < most ? shown : most), word, left_out);
    memset(word, ' ', length);
}

void scene_assimp_refuse_indices(struct scene_import *import)
{
    for (uint32_t i = 0; i < import->model.warning_count; i++) {
        const char *const line = import->model.warnings[i], *const end = strstr(line, left_out);
        if (end != NULL && end[strlen(left_out)] == 0) {
            scene_import_fail(import, "cannot be read: %.*s, which is no index", (int)(end - line), line);
        }
    }
}

void scene_assimp_check_indices(struct scene_import *import, char *text, size_t size)
{
    const char *const end = text + size;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            return;
        }
        char *const next = strchr(close, '<');
        if (scene_collada_is_tag(c, "p") && close[-1] != '/' && next != NULL) {
            check_list(import, close + 1, next);
        }
        c = close;
    }
}
