// SPDX-License-Identifier: MIT
// Quads of an X3D, which assimp 5.2.5 leaves out. They are written as a set of faces, which says the same: with its
// name, and with indices that have a -1 behind each quad.
#include "x3d_quads.h"

#include "import/builder/import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FACES "IndexedFaceSet"

static const char blanks[] = ", \t\r\n";

// Return where the next number begins, or `end` where there is none. Set the end of it.
static const char *next_number(const char *text, const char *end, const char **number_end)
{
    while (text < end && strchr(blanks, *text) != NULL) {
        text++;
    }
    *number_end = text;
    while (*number_end < end && strchr(blanks, **number_end) == NULL) {
        (*number_end)++;
    }
    return text;
}

static size_t count_numbers(struct scene_collada_value value)
{
    const char *const end = value.text + value.length, *number_end;
    size_t count = 0;
    for (const char *number = next_number(value.text, end, &number_end); number < end;
         number = next_number(number_end, end, &number_end)) {
        count++;
    }
    return count;
}

// Return the name of a face set with the indices of quads: those that are given, or each number once.
static char *write_faces(struct scene_import *import, struct scene_collada_value index, size_t count)
{
    static const char head[] = FACES " coordIndex='";
    const size_t longest = 21; // a number of 64 bits has 20 digits, and a blank behind it
    const size_t room = index.text != NULL ? 2 * index.length : count * longest;
    char *const text = scene_import_allocate(import, sizeof head + room + count + 2, 1);
    const char *const end = index.text == NULL ? NULL : index.text + index.length, *number_end = index.text;
    char *out = text + snprintf(text, sizeof head, "%s", head);
    for (size_t i = 0; i < count - count % 4; i++) {
        if (index.text != NULL) {
            const char *const number = next_number(number_end, end, &number_end);
            memcpy(out, number, (size_t)(number_end - number));
            out += number_end - number;
        } else {
            out += snprintf(out, longest, "%zu", i);
        }
        memcpy(out, i % 4 == 3 ? " -1 " : " ", i % 4 == 3 ? 4 : 1);
        out += i % 4 == 3 ? 4 : 1;
    }
    memcpy(out, "'", 2);
    return text;
}

// Return how many points the node has whose first tag ends at `close`. Return 0 where they do not stand in it.
static size_t count_points(char *close, const char *end)
{
    static const char name[] = "QuadSet";
    for (char *tag = close[-1] == '/' ? NULL : strchr(close, '<');
         tag != NULL && strncmp(tag + 1 + (tag[1] == '/'), name, strlen(name)) != 0;
         tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, end);
        if (close == NULL) {
            return 0;
        }
        if (scene_collada_is_tag(tag, "Coordinate")) {
            const struct scene_collada_value points = scene_collada_attribute(tag, close, "point");
            return points.text == NULL ? 0 : count_numbers(points) / 3;
        }
    }
    return 0;
}

static void rename_tag(struct scene_import *import, struct scene_edits *edits, size_t at, const char *name)
{
    scene_edits_add_string(import, edits, at, strlen(name), FACES);
}

bool scene_assimp_write_quads(struct scene_import *import, struct scene_edits *edits, bool *is_open,
                              const char *text, char *tag, char *close, const char *end)
{
    static const char *const names[] = {"QuadSet", "IndexedQuadSet"};
    const bool is_end = tag[1] == '/';
    const size_t which = scene_collada_is_tag(tag + is_end, names[1]);
    if (which == 0 && !scene_collada_is_tag(tag + is_end, names[0])) {
        return false;
    }
    const size_t at = (size_t)(tag + is_end + 1 - text);
    if (is_end || scene_collada_attribute(tag, close, "USE").text != NULL) {
        if (!is_end || *is_open) {
            rename_tag(import, edits, at, names[which]);
        }
        return true;
    }
    const struct scene_collada_value index =
        which == 1 ? scene_collada_attribute(tag, close, "index") : (struct scene_collada_value){NULL, 0};
    const size_t count = which == 0           ? count_points(close, end)
                         : index.text == NULL ? 0
                                              : count_numbers(index);
    *is_open = count >= 4;
    if (!*is_open) {
        scene_import_unsupported(import, "quads: not drawn");
        return true;
    }
    char *const written = write_faces(import, index, count);
    scene_edits_add(import, edits, (struct scene_edit){at, strlen(names[which]), written, strlen(written)});
    return true;
}
