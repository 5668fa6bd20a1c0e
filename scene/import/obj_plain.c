// SPDX-License-Identifier: MIT
// The plain lines of an OBJ file: vertices and faces without a word that is unusual. Nearly all lines are plain. They
// are read in one pass, without a look for their ends or for words first. A line that is not plain is left to obj.c as
// it was.
#include "import/builder/decimal.h"
#include "obj.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static const char *skip_blanks(const char *c, const char *end)
{
    while (c < end && is_blank(*c)) {
        c++;
    }
    return c;
}

// Return where the next line begins, behind the LF, CR or both at `c`. Return NULL if another character stands there.
static const char *next_line(const char *c, const char *end)
{
    if (c == end || (*c != '\n' && *c != '\r')) {
        return NULL;
    }
    return c + 1 + (*c == '\r' && c + 1 < end && c[1] == '\n');
}

static void go_to(struct obj *obj, const char *line)
{
    obj->text.cursor += line - obj->text.cursor;
    obj->text.line++;
}

// Read the numbers of a line whose key ends at `c`. Return how many there are. Return 0 if there are fewer than `least`
// or the line is not plain.
static int read_numbers(struct obj *obj, const char *c, int least, double values[SCENE_OBJ_NUMBERS])
{
    const char *const end = obj->text.end;
    for (int count = 0;; count++) {
        const char *const word = skip_blanks(c, end), *const next = next_line(word, end);
        if (next != NULL && count >= least) {
            go_to(obj, next);
            return count;
        }
        c = word > c && count < SCENE_OBJ_NUMBERS ? scene_decimal_read(word, end, &values[count]) : NULL;
        if (c == NULL) {
            return 0;
        }
    }
}

// Read an index at `c`, from one or, if negative, backward. Return where it ends. Return NULL if it is not plain.
static const char *read_index(const char *c, const char *end, size_t count, uint32_t *index)
{
    const bool is_negative = c < end && *c == '-';
    uint32_t value;
    const unsigned digits = scene_decimal_digits(c + is_negative, end, &value);
    if (digits == 0 || digits == 8 || value == 0 || (is_negative && value > count)) {
        return NULL;
    }
    *index = is_negative ? (uint32_t)count - value : value - 1;
    return c + is_negative + digits;
}

// Read a corner at `c`, which is p, p/t, p//n or p/t/n. Return where it ends. Return NULL if it is not plain.
static const char *read_corner(const struct obj *obj, const char *c, struct corner *corner)
{
    const char *const end = obj->text.end;
    *corner = (struct corner){SCENE_OBJ_NONE, SCENE_OBJ_NONE, SCENE_OBJ_NONE};
    c = read_index(c, end, obj->position_count, &corner->position);
    if (c == NULL || c == end || *c != '/') {
        return c;
    }
    c++;
    if (c < end && *c != '/') {
        c = read_index(c, end, obj->uv_count, &corner->uv);
    }
    return c == NULL || c == end || *c != '/' ? c
                                              : read_index(c + 1, end, obj->normal_count, &corner->normal);
}

// Read a face of a few corners, whose key ends at `c`. Return false if the line is not plain.
static bool read_face(struct obj *obj, const char *c)
{
    enum { MOST_CORNERS = 8 };
    const char *const end = obj->text.end;
    struct corner corners[MOST_CORNERS];
    for (uint32_t count = 0;; count++) {
        const char *const word = skip_blanks(c, end), *const next = next_line(word, end);
        if (next != NULL && count >= 3) {
            go_to(obj, next);
            scene_obj_add_element(obj, SCENE_PRIMITIVE_TRIANGLES, corners, count);
            return true;
        }
        c = word > c && count < MOST_CORNERS ? read_corner(obj, word, &corners[count]) : NULL;
        if (c == NULL) {
            return false;
        }
    }
}

// Read the line at `c`, at which some bytes stand. Return false if it is not plain.
static bool read_line(struct obj *obj, const char *c)
{
    double values[SCENE_OBJ_NUMBERS];
    int count;
    if (c[0] == 'f' && is_blank(c[1])) {
        return read_face(obj, c + 1);
    }
    if (c[0] != 'v') {
        return false;
    }
    if (is_blank(c[1])) {
        count = read_numbers(obj, c + 1, 3, values);
        if (count > 0) {
            scene_obj_add_position(obj, values, count);
        }
    } else if (c[1] == 't') {
        count = read_numbers(obj, c + 2, 1, values);
        if (count > 0) {
            scene_obj_add_uv(obj, values, count);
        }
    } else {
        count = c[1] == 'n' ? read_numbers(obj, c + 2, 3, values) : 0;
        if (count > 0) {
            scene_obj_add_normal(obj, values);
        }
    }
    return count > 0;
}

void scene_obj_read_plain(struct obj *obj)
{
    while (obj->text.end - obj->text.cursor > 2 && read_line(obj, obj->text.cursor)) {
    }
}
