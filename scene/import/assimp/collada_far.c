// SPDX-License-Identifier: MIT
// Geometries of Collada that are far from their origin.
#include "collada_far.h"

#include <stdlib.h>
#include <string.h>

#include "collada_markup.h"
#include "import/builder/text_lines.h"

enum { MOST_NAME = 1024 }; // bytes of a name that assimp does not keep

static const char *skip_blanks(const char *text, const char *end)
{
    while (text < end && scene_collada_is_blank(*text)) {
        text++;
    }
    return text;
}

size_t scene_collada_numbers(const char **text, const char *end, double *numbers, const char *(*ends)[2],
                             size_t most)
{
    const char *c = skip_blanks(*text, end), *stop;
    size_t count = 0;
    while (count < most && (stop = scene_number_read(c, end, " \t\r\n", &numbers[count])) != NULL) {
        if (ends != NULL) {
            ends[count][0] = c;
            ends[count][1] = stop;
        }
        c = skip_blanks(stop, end);
        count++;
    }
    *text = c;
    return count;
}

// A geometry, as far as it was read. Its positions are those of the source that its vertices name.
struct geometry {
    struct scene_collada_value id, positions; // positions with its #
};

// An array of numbers and what is read of it.
struct array {
    struct scene_collada_value source, id; // id of the source that it is in, and its own
    char *text, *end;                      // where the numbers begin and end
    bool has_places;                       // the numbers are X, Y and Z in turn
};

static bool is_same(struct scene_collada_value a, struct scene_collada_value b)
{
    return a.length == b.length && a.length > 0 && memcmp(a.text, b.text, a.length) == 0;
}

static bool is_text(struct scene_collada_value value, const char *text)
{
    return value.length == strlen(text) && memcmp(value.text, text, value.length) == 0;
}

// Return true for #id.
static bool refers_to(struct scene_collada_value reference, struct scene_collada_value id)
{
    const bool has_mark = reference.length > 1 && reference.text[0] == '#';
    return has_mark && is_same((struct scene_collada_value){reference.text + 1, reference.length - 1}, id);
}

// Return true for an end tag of this name.
static bool is_end(const char *c, const char *name)
{
    return c[1] == '/' && strncmp(c + 2, name, strlen(name)) == 0;
}

static void read_input(struct geometry *geometry, char *tag, char *close)
{
    const struct scene_collada_value source = scene_collada_attribute(tag, close, "source");
    if (geometry->positions.length == 0 &&
        is_text(scene_collada_attribute(tag, close, "semantic"), "POSITION")) {
        geometry->positions = source;
    }
}

// Find the source of positions of the geometry that begins at `text`. Return where it ends. Return NULL where it
// does not.
static char *read_geometry(char *text, const char *end, struct geometry *geometry)
{
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, end);
        if (close == NULL || is_end(c, "geometry")) {
            return close == NULL ? NULL : c;
        }
        if (scene_collada_is_tag(c, "input")) {
            read_input(geometry, c, close);
        }
        c = close;
    }
    return NULL;
}

// Read an accessor from its start tag on. Return true if it takes three numbers a vertex from an array, X, Y and Z.
static bool read_accessor(char *tag, char *close, const char *end, const struct array *array)
{
    static const char *const names[] = {"X", "Y", "Z"};
    const struct scene_collada_value offset = scene_collada_attribute(tag, close, "offset");
    bool is_good = refers_to(scene_collada_attribute(tag, close, "source"), array->id) &&
                   is_text(scene_collada_attribute(tag, close, "stride"), "3") &&
                   (offset.text == NULL || is_text(offset, "0"));
    int params = 0;
    char *c = strchr(close, '<'), *last = c == NULL ? NULL : scene_collada_markup_end(c, end);
    while (last != NULL && (scene_collada_is_tag(c, "param") || is_end(c, "param") || c[1] == '!')) {
        if (scene_collada_is_tag(c, "param")) {
            is_good =
                is_good && params < 3 && is_text(scene_collada_attribute(c, last, "name"), names[params]);
            params++;
        }
        c = strchr(last, '<');
        last = c == NULL ? NULL : scene_collada_markup_end(c, end);
    }
    return is_good && params == 3;
}

// Find the array of a geometry's positions between two places.
static struct array find_array(const struct geometry *geometry, char *text, const char *end)
{
    struct array array = {.text = NULL};
    for (char *c = strchr(text, '<'); c != NULL && c < end; c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            break;
        }
        if (scene_collada_is_tag(c, "source")) {
            array = (struct array){.source = scene_collada_attribute(c, close, "id")};
        } else if (scene_collada_is_tag(c, "float_array") && close[-1] != '/' && array.text == NULL) {
            array.id = scene_collada_attribute(c, close, "id");
            array.text = close + 1;
            array.end = strchr(close, '<');
        } else if (scene_collada_is_tag(c, "accessor") && close[-1] != '/' && array.text != NULL) {
            array.has_places = read_accessor(c, close, end, &array);
        }
        if (is_end(c, "source") && refers_to(geometry->positions, array.source)) {
            array.has_places = array.has_places && array.end[1] == '/';
            return array;
        }
        c = close;
    }
    return (struct array){.text = NULL};
}

static void edit_geometry(struct scene_import *import, struct scene_assimp_exact *exact,
                          const struct geometry *geometry, const struct array *array, const char *start,
                          struct scene_edits *edits)
{
    // A number and a blank take two bytes.
    const size_t most = array->has_places ? (size_t)(array->end - array->text) / 2 + 2 : 0;
    double *const numbers = scene_import_allocate(import, most, sizeof *numbers);
    const char *last = array->text;
    const size_t count = scene_collada_numbers(&last, array->end, numbers, NULL, most);
    const double(*const points)[3] = (const double(*)[3])numbers;
    double offset[3] = {0, 0, 0};
    const bool is_far = array->has_places && last == array->end && count % 3 == 0 &&
                        scene_assimp_find_offset(import, points, count / 3, offset);
    if (scene_assimp_name_offset(import, exact, geometry->id.text, geometry->id.length,
                                 is_far ? offset : (const double[]){0, 0, 0}) &&
        is_far) {
        scene_assimp_edit_points(import, edits, (size_t)(array->text - start),
                                 (size_t)(array->end - array->text), ' ', points, count / 3, offset);
    }
    free(numbers);
}

void scene_collada_edit_geometries(struct scene_import *import, struct scene_assimp_exact *exact, char *text,
                                   size_t size, struct scene_edits *edits)
{
    const char *const end = text + size;
    for (char *c = strchr(text, '<'); c != NULL; c = strchr(c, '<')) {
        char *close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            return;
        }
        if (scene_collada_is_tag(c, "geometry") && close[-1] != '/') {
            struct geometry geometry = {.id = scene_collada_attribute(c, close, "id")};
            char *const last = read_geometry(close, end, &geometry);
            if (last == NULL) {
                return;
            }
            const struct array array = find_array(&geometry, close, last);
            // A name with an entity is another one to assimp, and a long one is none.
            if (geometry.id.length > 0 && geometry.id.length < MOST_NAME &&
                memchr(geometry.id.text, '&', geometry.id.length) == NULL) {
                edit_geometry(import, exact, &geometry, &array, text, edits);
            }
            close = last;
        }
        c = close;
    }
}

double scene_collada_unit(char *text, const char *end)
{
    double unit = 0;
    for (char *c = strchr(text, '<'); c != NULL && !is_end(c, "asset"); c = strchr(c, '<')) {
        char *const close = scene_collada_markup_end(c, end);
        if (close == NULL) {
            return 0;
        }
        if (scene_collada_is_tag(c, "unit")) {
            const struct scene_collada_value meter = scene_collada_attribute(c, close, "meter");
            const char *number = meter.text;
            unit =
                number != NULL && scene_collada_numbers(&number, number + meter.length, &unit, NULL, 1) == 1
                    ? unit
                    : 0;
        }
        c = close;
    }
    return unit;
}

char *scene_assimp_rewrite_collada(struct scene_import *import, struct scene_assimp_exact *exact, char *bytes,
                                   size_t *size)
{
    struct scene_edits edits = {.count = 0};
    exact->rounds_movements = true;
    exact->unit = scene_collada_unit(bytes, bytes + *size);
    scene_collada_edit_geometries(import, exact, bytes, *size, &edits);
    scene_collada_edit_nodes(import, exact, bytes, *size, &edits);
    return scene_edits_apply(import, &edits, bytes, size);
}
