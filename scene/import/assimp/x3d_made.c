// SPDX-License-Identifier: MIT
// The numbers that geometry is made of, and those that it becomes.
#include "x3d_made.h"

#include "elementary.h"
#include "import/builder/decimal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double scene_x3d_number_of(char *tag, char *close, const char *name, double usual)
{
    const struct scene_collada_value value = scene_collada_attribute(tag, close, name);
    double number = usual;
    return value.text != NULL && scene_decimal_read(value.text, value.text + value.length, &number) != NULL
               ? number
               : usual;
}

double scene_x3d_crease_cosine(double angle)
{
    const double half_turn = 3.14159; // as files round it
    return angle >= half_turn ? -1 : angle > 0 ? scene_cos(angle) : 1;
}

bool scene_x3d_is_false(char *tag, char *close, const char *name)
{
    static const char word[] = "false";
    const struct scene_collada_value value = scene_collada_attribute(tag, close, name);
    return value.text != NULL && value.length == strlen(word) && memcmp(value.text, word, value.length) == 0;
}

double *scene_x3d_numbers_of(struct scene_import *import, char *tag, char *close, const char *name,
                             const char *usual, size_t *count)
{
    struct scene_collada_value text = scene_collada_attribute(tag, close, name);
    if (text.text == NULL) {
        text = (struct scene_collada_value){(char *)(uintptr_t)usual, strlen(usual)};
    }
    const struct scene_x3d_numbers numbers = scene_x3d_read_numbers(import, text);
    double *const list = scene_import_allocate(import, numbers.count + 1, sizeof *list);
    *count = numbers.count;
    for (size_t i = 0; i < numbers.count; i++) {
        const struct scene_collada_value number = numbers.list[i];
        const char *const end = number.text + number.length;
        if (scene_decimal_read(number.text, end, &list[i]) != end) {
            *count = 0;
        }
    }
    free(numbers.list);
    return list;
}

// Return the text of a list of numbers.
static char *write_numbers(struct scene_import *import, const float *numbers, size_t count)
{
    enum { LONGEST = 17 }; // a sign, 9 digits with a point, an exponent and a blank
    char *const text = scene_import_allocate(import, count + 1, LONGEST), *end = text;
    for (size_t i = 0; i < count; i++) {
        end += sprintf(end, "%.9g ", (double)numbers[i]);
    }
    return text;
}

struct scene_x3d_vertices scene_x3d_allocate_vertices(struct scene_import *import, size_t most)
{
    struct scene_x3d_vertices vertices;
    vertices.points = scene_import_allocate(import, most, sizeof *vertices.points);
    vertices.normals = scene_import_allocate(import, most, sizeof *vertices.normals);
    vertices.places = scene_import_allocate(import, most, sizeof *vertices.places);
    vertices.count = 0;
    return vertices;
}

void scene_x3d_write_vertices(struct scene_import *import, const struct scene_x3d_vertices *vertices,
                              bool has_normals, struct scene_x3d_made *made)
{
    const size_t count = vertices->count;
    made->lists[SCENE_X3D_POINTS] = write_numbers(import, vertices->points[0], 3 * count);
    made->lists[SCENE_X3D_NORMALS] =
        has_normals ? write_numbers(import, vertices->normals[0], 3 * count) : NULL;
    made->lists[SCENE_X3D_PLACES] = write_numbers(import, vertices->places[0], 2 * count);
    free(vertices->points);
    free(vertices->normals);
    free(vertices->places);
}

// Set the bounds of points. Return false if they are no numbers.
static bool find_bounds(const struct scene_x3d_numbers *points, double least[3], double size[3])
{
    double most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (size_t c = 0; c < 3; c++) {
        least[c] = HUGE_VAL;
        for (size_t i = c; i < points->count / 3 * 3; i += 3) {
            const struct scene_collada_value text = points->list[i];
            double number;
            if (scene_decimal_read(text.text, text.text + text.length, &number) == NULL) {
                return false;
            }
            least[c] = fmin(least[c], number);
            most[c] = fmax(most[c], number);
        }
        size[c] = most[c] - least[c];
    }
    return true;
}

// Return the longest dimension but one, which may be 3, the first of equal ones.
static size_t find_longest(const double size[3], size_t but)
{
    size_t longest = but == 0;
    for (size_t c = 0; c < 3; c++) {
        longest = c != but && size[c] > size[longest] ? c : longest;
    }
    return longest;
}

char *scene_x3d_make_places(struct scene_import *import, const struct scene_x3d_numbers *points)
{
    double least[3], size[3];
    if (!find_bounds(points, least, size)) {
        return NULL;
    }
    const size_t first = find_longest(size, 3), axes[2] = {first, find_longest(size, first)},
                 count = points->count / 3;
    if (!(size[first] > 0 && size[first] < 1e30)) {
        return NULL;
    }
    float(*const places)[2] = scene_import_allocate(import, count, sizeof *places);
    for (size_t i = 0; i < 2 * count; i++) {
        const struct scene_collada_value text = points->list[i / 2 * 3 + axes[i % 2]];
        double number = 0;
        scene_decimal_read(text.text, text.text + text.length, &number);
        places[i / 2][i % 2] = (float)((number - least[axes[i % 2]]) / size[first]);
    }
    char *const text = write_numbers(import, places[0], 2 * count);
    free(places);
    return text;
}

void scene_x3d_add_index(struct scene_x3d_made *made, size_t index)
{
    made->index.list[made->index.count++] = (int64_t)index;
}

void scene_x3d_end_face(struct scene_x3d_made *made)
{
    made->index.list[made->index.count++] = -1;
}
