// SPDX-License-Identifier: MIT
// The indices of an ASE, the text of 3ds Max. assimp 5.2.5 reads beside its arrays where a face refers to a vertex, a
// texture coordinate or a colour that is not there.
#include "assimp.h"
#include "import/builder/text_lines.h"

#include <strings.h>

// What faces refer to: how many there are, and the greatest index of a face.
struct list {
    const char *name;
    double count, worst, face;
    unsigned line;
};

enum { VERTICES, COORDINATES, COLORS, LISTS };

// Refuse the file if a face refers to what is not there.
static void check(struct scene_import *import, const struct list *list)
{
    if (list->line > 0 && !(list->worst >= 0 && list->worst < list->count)) {
        scene_import_fail(import, "line %u: face %.0f refers to %s %.0f; the mesh has %.0f, counted from 0",
                          list->line, list->face, list->name, list->worst, list->count);
    }
}

static void begin(struct scene_import *import, struct list *list)
{
    check(import, list);
    *list = (struct list){.name = list->name};
}

static bool is_worse(const struct list *list, double index)
{
    const bool is_good = list->worst >= 0;
    return is_good && (index > list->worst || !(index >= 0) || list->line == 0);
}

// Read the corners of a face: its number, and three numbers behind it, of which those of vertices have letters.
static void read_face(struct list *list, struct scene_line line, unsigned number)
{
    struct scene_word word;
    double face = 0, index;
    size_t length;
    if (!scene_text_word(&line, &word) || !scene_word_number(word, &face, &length)) {
        return;
    }
    for (int corners = 0; corners < 3 && scene_text_word(&line, &word);) {
        const bool is_letter = *word.start >= 'A' && *word.start <= 'C';
        const struct scene_word digits =
            is_letter && word.length > 2 ? (struct scene_word){word.start + 2, word.length - 2} : word;
        if (!scene_word_number(digits, &index, &length)) {
            continue; // a letter that stands alone
        }
        corners++;
        if (is_worse(list, index)) {
            list->worst = index;
            list->face = face;
            list->line = number;
        }
    }
}

static void read_line(struct scene_import *import, struct list lists[LISTS], struct scene_word word,
                      struct scene_line line, unsigned number)
{
    static const char *const counts[LISTS] = {"*MESH_NUMVERTEX", "*MESH_NUMTVERTEX", "*MESH_NUMCVERTEX"},
                             *const faces[LISTS] = {"*MESH_FACE", "*MESH_TFACE", "*MESH_CFACE"};
    const bool is_mesh = scene_word_is(word, "*MESH");
    if (is_mesh || scene_word_is(word, "*MESH_MAPPINGCHANNEL")) {
        for (int i = is_mesh ? VERTICES : COORDINATES; i <= (is_mesh ? COLORS : COORDINATES); i++) {
            begin(import, &lists[i]);
        }
    }
    for (int i = 0; i < LISTS; i++) {
        if (scene_word_is(word, counts[i])) {
            scene_text_double(&line, &lists[i].count);
        } else if (scene_word_is(word, faces[i])) {
            read_face(&lists[i], line, number);
        }
    }
}

void scene_assimp_look_at_ase(struct scene_import *import, char *bytes, size_t size)
{
    struct scene_text text = scene_text_open(import, bytes, size);
    struct list lists[LISTS] = {{.name = "vertex"}, {.name = "texture coordinate"}, {.name = "colour"}};
    struct scene_line line;
    struct scene_word word;
    if (strcasecmp(import->ending, "ase") != 0 && strcasecmp(import->ending, "ask") != 0) {
        return;
    }
    while (scene_text_line(&text, false, &line)) {
        if (scene_text_word(&line, &word) && *word.start == '*') {
            read_line(import, lists, word, line, text.line);
        }
    }
    for (int i = 0; i < LISTS; i++) {
        check(import, &lists[i]);
    }
}
