// SPDX-License-Identifier: MIT
// Quads of an X3D, which assimp 5.2.5 leaves out. They are written as a set of faces, which says the same: with its
// name, and with indices that have a -1 behind each quad.
#include "x3d_quads.h"

#include "import/builder/import.h"

#include <stdio.h>
#include <string.h>

#define FACES       "IndexedFaceSet"
#define COORDINATES "Coordinate"

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

// A number of 64 bits has 20 digits, and a blank behind it.
enum { LONGEST = 21 };

// Return how many bytes the indices of a set have at most.
static size_t most_written(struct scene_collada_value index, size_t count)
{
    return (index.text != NULL ? 2 * index.length : LONGEST * count) + count;
}

// Return the name of a face set with the indices of quads: those that are given, or each number once.
static char *write_faces(struct scene_import *import, struct scene_collada_value index, size_t count)
{
    static const char head[] = FACES " coordIndex='";
    char *const text = scene_import_allocate(import, sizeof head + most_written(index, count) + 2, 1);
    const char *const end = index.text == NULL ? NULL : index.text + index.length, *number_end = index.text;
    char *out = text + snprintf(text, sizeof head, "%s", head);
    for (size_t i = 0; i < count - count % 4; i++) {
        if (index.text != NULL) {
            const char *const number = next_number(number_end, end, &number_end);
            memcpy(out, number, (size_t)(number_end - number));
            out += number_end - number;
        } else {
            out += snprintf(out, LONGEST, "%zu", i);
        }
        memcpy(out, i % 4 == 3 ? " -1 " : " ", i % 4 == 3 ? 4 : 1);
        out += i % 4 == 3 ? 4 : 1;
    }
    memcpy(out, "'", 2);
    return text;
}

// Return how many points a list has, or the list that it uses again. Return 0 where that is not known.
static size_t count_listed(const struct scene_x3d_quads *quads, char *tag, char *close)
{
    const struct scene_collada_value use = scene_collada_attribute(tag, close, "USE");
    const struct scene_collada_value points = scene_collada_attribute(tag, close, "point");
    const struct scene_x3d_name *const used =
        use.text == NULL ? NULL : scene_x3d_find_name(&quads->names, use);
    return used != NULL ? used->size : points.text != NULL ? count_numbers(points) / 3 : 0;
}

// Return how many points the node has whose first tag ends at `close`. Return 0 where they are not known.
static size_t count_points(const struct scene_x3d_quads *quads, char *close, const char *end)
{
    static const char name[] = "QuadSet";
    for (char *tag = close[-1] == '/' ? NULL : strchr(close, '<');
         tag != NULL && strncmp(tag + 1 + (tag[1] == '/'), name, strlen(name)) != 0;
         tag = strchr(close, '<')) {
        close = scene_collada_markup_end(tag, end);
        if (close == NULL) {
            return 0;
        }
        if (scene_collada_is_tag(tag, COORDINATES)) {
            return count_listed(quads, tag, close);
        }
    }
    return 0;
}

// Return the first tag of a set as that of a set of faces. Return NULL if it cannot be written so.
static char *write_start(struct scene_import *import, struct scene_x3d_quads *quads, bool has_index,
                         char *tag, char *close, const char *end)
{
    const struct scene_collada_value use = scene_collada_attribute(tag, close, "USE");
    if (use.text != NULL) {
        const struct scene_x3d_name *const used = scene_x3d_find_name(&quads->names, use);
        return used != NULL && used->size == 0 ? strcpy(scene_import_allocate(import, sizeof FACES, 1), FACES)
                                               : NULL;
    }
    const struct scene_collada_value index =
        has_index ? scene_collada_attribute(tag, close, "index") : (struct scene_collada_value){NULL, 0};
    const size_t count = !has_index           ? count_points(quads, close, end)
                         : index.text == NULL ? 0
                                              : count_numbers(index);
    if (count < 4 || quads->written > quads->largest ||
        most_written(index, count) > quads->largest - quads->written) {
        return NULL;
    }
    scene_x3d_add_name(import, &quads->names,
                       (struct scene_x3d_name){.name = scene_collada_attribute(tag, close, "DEF")});
    return write_faces(import, index, count);
}

bool scene_assimp_write_quads(struct scene_import *import, struct scene_edits *edits,
                              struct scene_x3d_quads *quads, const char *text, char *tag, char *close,
                              const char *end)
{
    static const char *const names[] = {"QuadSet", "IndexedQuadSet"};
    const bool is_end = tag[1] == '/';
    const size_t which = scene_collada_is_tag(tag + is_end, names[1]);
    if (scene_collada_is_tag(tag, COORDINATES)) {
        const struct scene_collada_value name = scene_collada_attribute(tag, close, "DEF");
        const size_t points = name.text == NULL ? 0 : count_listed(quads, tag, close);
        if (points > 0) {
            scene_x3d_add_name(import, &quads->names, (struct scene_x3d_name){.name = name, .size = points});
        }
    }
    if (which == 0 && !scene_collada_is_tag(tag + is_end, names[0])) {
        return false;
    }
    const size_t at = (size_t)(tag + is_end + 1 - text);
    if (is_end) {
        if (quads->is_open) {
            scene_edits_add_string(import, edits, at, strlen(names[which]), FACES);
        }
        return true;
    }
    char *const written = write_start(import, quads, which == 1, tag, close, end);
    quads->is_open = close[-1] == '/' ? quads->is_open : written != NULL;
    if (written == NULL) {
        scene_import_unsupported(import, "quads: not drawn");
    } else {
        quads->written += strlen(written);
        scene_edits_add(import, edits,
                        (struct scene_edit){at, strlen(names[which]), written, strlen(written)});
    }
    return true;
}
