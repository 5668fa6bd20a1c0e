// SPDX-License-Identifier: MIT
// The points of a grid stand in rows along x, at the heights that are listed.
#include "x3d_grid.h"

#include "import/builder/decimal.h"

#include <stdio.h>
#include <stdlib.h>

static double number_of(char *tag, char *close, const char *name, double usual)
{
    const struct scene_collada_value value = scene_collada_attribute(tag, close, name);
    double number = usual;
    return value.text != NULL && scene_decimal_read(value.text, value.text + value.length, &number) != NULL
               ? number
               : usual;
}

static size_t size_of(char *tag, char *close, const char *name)
{
    const double most = 1 << 24, number = number_of(tag, close, name, 0);
    return number >= 2 && number <= most ? (size_t)number : 0;
}

bool scene_x3d_read_grid(struct scene_import *import, char *tag, char *close, struct scene_x3d_grid *grid)
{
    enum { LONGEST = 32 }; // a number of 9 digits with its exponent and a blank
    const size_t columns = size_of(tag, close, "xDimension"), rows = size_of(tag, close, "zDimension");
    const double wide = number_of(tag, close, "xSpacing", 1), deep = number_of(tag, close, "zSpacing", 1);
    struct scene_x3d_numbers heights =
        scene_x3d_read_numbers(import, scene_collada_attribute(tag, close, "height"));
    size_t length = 0;
    bool is_whole = columns > 0 && rows > 0 && heights.count / columns >= rows;
    for (size_t i = 0; is_whole && i < columns * rows; i++) {
        const struct scene_collada_value height = heights.list[i];
        const char *const end = height.text + height.length;
        double number;
        is_whole = scene_decimal_read(height.text, end, &number) == end;
        length += height.length;
    }
    if (is_whole) {
        char *point = grid->points =
            scene_import_allocate_any(import, columns * rows + length / (2 * LONGEST) + 1, 2 * LONGEST + 1);
        char *place = grid->places = scene_import_allocate_any(import, columns * rows, 2 * LONGEST);
        for (size_t i = 0; i < columns * rows; i++) {
            const double x = (double)(i % columns), z = (double)(i / columns);
            point += sprintf(point, "%.9g %.*s %.9g ", x * wide, (int)heights.list[i].length,
                             heights.list[i].text, z * deep);
            place += sprintf(place, "%.9g %.9g ", x / (double)(columns - 1), z / (double)(rows - 1));
        }
        int64_t *index = grid->index.list =
            scene_import_allocate_any(import, 5 * (columns - 1) * (rows - 1), sizeof *index);
        for (size_t i = 0; i < columns * (rows - 1); i++) {
            if (i % columns + 1 < columns) {
                const size_t next = i + columns;
                const int64_t corners[5] = {(int64_t)next, (int64_t)next + 1, (int64_t)i + 1, (int64_t)i, -1};
                for (size_t k = 0; k < 5; k++) {
                    index[grid->index.count++] = corners[k];
                }
            }
        }
    }
    free(heights.list);
    return is_whole;
}
