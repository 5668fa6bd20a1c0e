// SPDX-License-Identifier: MIT
// Transforms of Collada nodes that assimp 5.2.5 does not know: a skew ends the process, and a lookat whose up leans is
// one to it. Both become matrices.
#include "assimp.h"
#include "collada_far.h"
#include "collada_markup.h"
#include "elementary.h"
#include "import/builder/vector.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_NUMBERS = 9 };

// Make a vector unit. Return false if it has no direction.
static bool make_unit(double vector[3])
{
    const double length = sqrt(scene_dot(vector, vector));
    for (int c = 0; c < 3; c++) {
        vector[c] /= length;
    }
    return length > 0 && length < 1e30;
}

// Write the rows of the matrix that stands at a place and looks at another, with −z. Numbers are both places, and up.
static bool look_at(const double numbers[MOST_NUMBERS], double rows[3][4])
{
    double back[3], up[3], right[3];
    for (int c = 0; c < 3; c++) {
        back[c] = numbers[c] - numbers[3 + c];
    }
    const bool has_back = make_unit(back);
    scene_cross(numbers + 6, back, right);
    const bool has_right = make_unit(right);
    scene_cross(back, right, up);
    for (int row = 0; row < 3; row++) {
        const double values[4] = {right[row], up[row], back[row], numbers[row]};
        memcpy(rows[row], values, sizeof values);
    }
    return has_back && has_right;
}

// Write the rows of a skew as RenderMan has it: what stands along one axis is moved along another until it leans by an
// angle in degrees. Numbers are the angle and both axes.
static bool skew(const double numbers[MOST_NUMBERS], double rows[3][4])
{
    double from[3] = {numbers[1], numbers[2], numbers[3]}, along[3] = {numbers[4], numbers[5], numbers[6]};
    double sine, cosine;
    const bool has_axes = make_unit(from) && make_unit(along);
    const double shared = scene_dot(from, along),
                 square = 1 - shared * shared; // 0 for axes that are one
    scene_sin_cos_degrees(numbers[0], &sine, &cosine);
    const double factor = sine / (sqrt(square) * cosine - shared * sine);
    bool is_good = has_axes && square > 1e-12;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            rows[row][column] =
                along[row] * factor * (from[column] - shared * along[column]) / square + (row == column);
            is_good = is_good && fabs(rows[row][column]) < 1e12;
        }
        rows[row][3] = 0;
    }
    return is_good;
}

// Write a matrix in the place of a transform from `tag` to behind its end tag.
static void write_matrix(struct scene_import *import, struct scene_edits *edits, size_t at, size_t length,
                         double rows[3][4])
{
    char text[3 * 4 * 32 + 64] = "<matrix>";
    for (int i = 0; i < 12; i++) {
        snprintf(text + strlen(text), 32, "%.17g ", rows[i / 4][i % 4]);
    }
    strcat(text, "0 0 0 1</matrix>");
    scene_edits_add_string(import, edits, at, length, text);
}

// Read as many numbers as a transform has, in the text from the end of its start tag on.
static bool read_numbers(const char *close, size_t count, double numbers[MOST_NUMBERS])
{
    const char *place = close + 1, *const behind = strchr(close, '<');
    return close[-1] != '/' && behind != NULL &&
           scene_collada_numbers(&place, behind, numbers, NULL, count) == count;
}

// Return the end tag of an element of numbers whose start tag ends at `close`. Return NULL if something else than
// comments is before it.
static char *find_end_tag(char *close, const char *end, const char *name)
{
    char *c = strchr(close + 1, '<');
    while (c != NULL && (c[1] == '!' || c[1] == '?')) {
        char *const last = scene_collada_markup_end(c, end);
        c = last != NULL ? strchr(last, '<') : NULL;
    }
    return c != NULL && c[1] == '/' && strncmp(c + 2, name, strlen(name)) == 0 ? c : NULL;
}

// Replace the transform whose start tag ends at `close`. A skew may not stay, as assimp ends the process there.
static void edit_transform(struct scene_import *import, struct scene_edits *edits, char *text,
                           const char *end, char *tag, char *close)
{
    const bool is_skew = scene_collada_is_tag(tag, "skew");
    char *const behind = close[-1] == '/' ? close : find_end_tag(close, end, is_skew ? "skew" : "lookat");
    char *const last = behind != NULL ? scene_collada_markup_end(behind, end) : NULL;
    double numbers[MOST_NUMBERS], rows[3][4];
    bool is_good = read_numbers(close, is_skew ? 7 : 9, numbers);
    is_good = is_good && (is_skew ? skew(numbers, rows) : look_at(numbers, rows));
    if (is_skew && !is_good) {
        static const double identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
        memcpy(rows, identity, sizeof identity);
        scene_import_warn(import,
                          "a skew of a node has no angle and two axes that it may be between: left out");
    }
    if (last != NULL && (is_good || is_skew)) {
        write_matrix(import, edits, (size_t)(tag - text), (size_t)(last + 1 - tag), rows);
    }
}

char *scene_assimp_write_matrices(struct scene_import *import, char *text, size_t *size)
{
    struct scene_edits edits = {.count = 0};
    const char *const end = text + *size;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            break;
        }
        if (scene_collada_is_tag(c, "lookat") || scene_collada_is_tag(c, "skew")) {
            edit_transform(import, &edits, text, end, c, close);
        }
        c = close;
    }
    char *const edited = edits.count > 0 ? scene_edits_apply(import, &edits, text, size) : NULL;
    if (edited != NULL) {
        free(text);
    }
    return edited != NULL ? edited : text;
}
