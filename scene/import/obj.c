// SPDX-License-Identifier: MIT
// Wavefront OBJ. assimp 5.2.5 refuses valid files (numbers such as ".5", UTF-16, extensions in the material library),
// so this format, the most common of all, is read here.
//
// Faces collect in parts. There is one part for each object or group, material, smoothing group and kind of corner. A
// part becomes a mesh, and the meshes of one object share an object id.
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "import/builder/find_file.h"
#include "import/builder/readers.h"
#include "import/builder/stored_colors.h"
#include "obj.h"

static const uint32_t none = SCENE_OBJ_NONE;
// Stands for white until it is known whether 1 or 255 is. No file has it, as colours are not below 0.
static const float white = -1;

static bool ends_within_line(const struct obj *obj)
{
    return obj->text.end[-1] != '\n' && obj->text.end[-1] != '\r';
}

_Noreturn static void refuse(struct obj *obj, const char *problem)
{
    const bool last = obj->text.cursor == obj->text.end && ends_within_line(obj);
    scene_import_fail(obj->import, "line %u%s: %s", obj->text.line,
                      last ? ", where the file ends or is cut" : "", problem);
}

// Vertices ------------------------------------------------------------------------------------------

void scene_obj_add_position(struct obj *obj, const double *values, int count)
{
    if (obj->position_count >= INT_MAX) {
        refuse(obj, "has too many vertices");
    }
    obj->has_odd_numbers = obj->has_odd_numbers || count == 5;
    const size_t index = obj->position_count++;
    scene_import_reserve(obj->import, &obj->read_positions, &obj->position_capacity, index + 1,
                         sizeof *obj->read_positions);
    memcpy(obj->read_positions[index], values, sizeof obj->read_positions[index]);
    if (count < 6 && !obj->colored) {
        return;
    }
    scene_import_reserve(obj->import, &obj->colors, &obj->color_capacity, obj->position_capacity,
                         sizeof *obj->colors);
    // Vertices before the first one with a colour are white.
    for (size_t i = obj->colored ? index : 0; i <= index; i++) {
        obj->colors[i][0] = obj->colors[i][1] = obj->colors[i][2] = white;
        obj->colors[i][3] = 1;
    }
    obj->colored = true;
    for (int c = 0; c < 3 && count >= 6; c++) {
        obj->colors[index][c] = (float)values[count - 3 + c];
    }
}

static void read_position(struct obj *obj, struct scene_line line)
{
    double values[SCENE_OBJ_NUMBERS];
    const int count = scene_text_doubles(&line, values, SCENE_OBJ_NUMBERS);
    if (count < 3) {
        refuse(obj, "a vertex needs three numbers");
    }
    scene_obj_add_position(obj, values, count);
}

void scene_obj_add_uv(struct obj *obj, const double *values, int count)
{
    scene_import_reserve(obj->import, &obj->uvs, &obj->uv_capacity, obj->uv_count + 1, sizeof *obj->uvs);
    float *const uv = obj->uvs[obj->uv_count++];
    uv[0] = (float)values[0];
    uv[1] = 1 - (count > 1 ? (float)values[1] : 0); // the format's v points up
    obj->has_third_uv = obj->has_third_uv || (count > 2 && values[2] != 0);
}

static void read_uv(struct obj *obj, struct scene_line line)
{
    double values[3];
    const int count = scene_text_doubles(&line, values, 3);
    if (count < 1) {
        refuse(obj, "a texture coordinate needs a number");
    }
    scene_obj_add_uv(obj, values, count);
}

void scene_obj_add_normal(struct obj *obj, const double values[3])
{
    scene_import_reserve(obj->import, &obj->normals, &obj->normal_capacity, obj->normal_count + 1,
                         sizeof *obj->normals);
    float *const normal = obj->normals[obj->normal_count++];
    for (int c = 0; c < 3; c++) {
        normal[c] = (float)values[c];
    }
}

static void read_normal(struct obj *obj, struct scene_line line)
{
    double values[3];
    if (scene_text_doubles(&line, values, 3) < 3) {
        refuse(obj, "a normal needs three numbers");
    }
    scene_obj_add_normal(obj, values);
}

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : 0;
}

// Read a comment that begins with #MRGB: ZBrush writes there the colours of the vertices, in their order, each as four
// bytes, which are a mask, red, green and blue.
static void read_paint(struct obj *obj, struct scene_line line)
{
    enum { DIGITS = 8 };
    struct scene_word word;
    while (scene_text_word(&line, &word)) {
        for (size_t at = 0; at + DIGITS <= word.length; at += DIGITS) {
            scene_import_reserve(obj->import, &obj->painted, &obj->painted_capacity, obj->painted_count + 1,
                                 sizeof *obj->painted);
            float *color = obj->painted[obj->painted_count++];
            for (size_t c = 0; c < 3; c++) {
                const char *digits = word.start + at + 2 + 2 * c;
                color[c] = (float)(16 * hex_digit(digits[0]) + hex_digit(digits[1]));
            }
            color[3] = 1;
        }
    }
}

// Use the painted colours, if each vertex has one and none of its own.
static void use_paint(struct obj *obj)
{
    const struct scene_color_scale bytes = {255, 1};
    if (obj->painted_count == 0) {
        return;
    }
    if (obj->colored || obj->painted_count != obj->position_count) {
        scene_import_unsupported(
            obj->import, "%zu colours in comments (#MRGB): not drawn, as %s", obj->painted_count,
            obj->colored ? "its vertices have colours" : "it has another number of vertices");
        return;
    }
    scene_import_decode_colors(obj->painted, obj->painted_count, bytes);
    obj->colors = obj->painted;
    obj->colored = true;
}

// Elements ------------------------------------------------------------------------------------------

// Read a one-based or, if negative, backward index at `*c`. Return false where there is none. The index is `none` if it
// is 0. Whether it lies beyond the end is known when the whole file is read.
static bool read_index(struct obj *obj, const char **c, const char *end, size_t count, uint32_t *index)
{
    const bool negative = *c < end && **c == '-';
    const char *digit = *c + negative;
    int64_t value = 0;
    if (digit == end || *digit < '0' || *digit > '9') {
        return false;
    }
    for (; digit < end && *digit >= '0' && *digit <= '9'; digit++) {
        value = value < INT_MAX ? value * 10 + (*digit - '0') : value;
    }
    *c = digit;
    if (value == 0) {
        *index = none;
        return true;
    }
    if (negative && (uint64_t)value > count) {
        refuse(obj, "an index reaches back before the first vertex");
    }
    *index = (uint32_t)(negative ? (int64_t)count - value : value - 1 < INT_MAX ? value - 1 : INT_MAX);
    return true;
}

// Read a corner, which is p, p/t, p//n or p/t/n.
static struct corner read_corner(struct obj *obj, struct scene_word word)
{
    struct corner corner = {none, none, none};
    const char *c = word.start, *end = word.start + word.length;
    bool good = read_index(obj, &c, end, obj->position_count, &corner.position);
    if (good && c < end && *c == '/') {
        c++;
        const bool is_there = read_index(obj, &c, end, obj->uv_count, &corner.uv);
        obj->has_zero_others = obj->has_zero_others || (is_there && corner.uv == none);
        if (c < end && *c == '/') {
            c++;
            const bool has_normal = read_index(obj, &c, end, obj->normal_count, &corner.normal);
            obj->has_zero_others = obj->has_zero_others || (has_normal && corner.normal == none);
        }
    }
    if (!good || c != end) {
        refuse(obj, "a corner must be p, p/t, p//n or p/t/n");
    }
    return corner;
}

static bool same_key(const struct part_key *a, const struct part_key *b)
{
    return a->object == b->object && a->material == b->material && a->smoothing == b->smoothing &&
           a->primitive == b->primitive && a->has_uv == b->has_uv && a->has_normal == b->has_normal;
}

static uint32_t hash_key(const struct part_key *key)
{
    const uint64_t words[] = {key->object, key->material, (uint64_t)key->smoothing,
                              (uint64_t)key->primitive << 2 | (uint64_t)key->has_uv << 1 | key->has_normal};
    return scene_hash_bytes(words, sizeof words);
}

static struct part *find_part(struct obj *obj, const struct part_key *key)
{
    if (obj->part < obj->part_count && same_key(&obj->parts[obj->part].key, key)) {
        return &obj->parts[obj->part]; // most faces follow one of their own part
    }
    const uint32_t hash = hash_key(key);
    size_t place = SIZE_MAX;
    uint32_t found = scene_hash_next(&obj->part_table, hash, &place);
    while (found != none && !same_key(&obj->parts[found].key, key)) {
        found = scene_hash_next(&obj->part_table, hash, &place);
    }
    if (found == none) {
        if (obj->part_count >= INT_MAX) {
            refuse(obj, "has too many parts");
        }
        scene_import_reserve(obj->import, &obj->parts, &obj->part_capacity, obj->part_count + 1,
                             sizeof *obj->parts);
        found = (uint32_t)obj->part_count++;
        obj->parts[found] = (struct part){.key = *key};
        scene_hash_add(obj->import, &obj->part_table, hash, found);
    }
    obj->part = found;
    return &obj->parts[found];
}

void scene_obj_add_element(struct obj *obj, enum scene_primitive primitive, const struct corner *corners,
                           uint32_t count)
{
    struct part_key key = {
        (uint32_t)obj->object_count - 1, obj->material, SMOOTHING_NOT_SAID, primitive, true, true};
    for (uint32_t i = 0; i < count; i++) {
        key.has_uv = key.has_uv && corners[i].uv != none;
        key.has_normal = key.has_normal && corners[i].normal != none;
    }
    if (primitive == SCENE_PRIMITIVE_TRIANGLES && !key.has_normal) {
        key.smoothing = obj->smoothing;
    }
    struct part *part = find_part(obj, &key);
    if (part->corner_count + count > UINT32_MAX) {
        refuse(obj, "has too many faces");
    }
    const size_t total = part->corner_count + count;
    scene_import_reserve(obj->import, &part->corners, &part->corner_capacity, total, sizeof *part->corners);
    scene_import_reserve(obj->import, &part->sizes, &part->size_capacity, part->size_count + 1,
                         sizeof *part->sizes);
    memcpy(part->corners + part->corner_count, corners, count * sizeof *corners);
    part->corner_count = total;
    part->sizes[part->size_count++] = count;
}

static void read_element(struct obj *obj, enum scene_primitive primitive, struct scene_line line)
{
    struct scene_word word;
    uint32_t count = 0;
    bool has_zero = false;
    while (scene_text_word(&line, &word) && word.start[0] != '#') {
        scene_import_reserve(obj->import, &obj->polygon, &obj->polygon_capacity, count + (size_t)1,
                             sizeof *obj->polygon);
        obj->polygon[count] = read_corner(obj, word);
        has_zero = has_zero || obj->polygon[count++].position == none;
    }
    if (has_zero) {
        obj->zero_elements++;
        return;
    }
    if (primitive == SCENE_PRIMITIVE_TRIANGLES && count >= 3) {
        scene_obj_add_element(obj, primitive, obj->polygon, count);
    } else if (primitive == SCENE_PRIMITIVE_TRIANGLES) {
        obj->small_faces++;
    }
    obj->small_lines += primitive == SCENE_PRIMITIVE_LINES && count < 2;
    for (uint32_t i = 1; primitive == SCENE_PRIMITIVE_LINES && i < count; i++) {
        scene_obj_add_element(obj, primitive, obj->polygon + i - 1, 2);
    }
    for (uint32_t i = 0; primitive == SCENE_PRIMITIVE_POINTS && i < count; i++) {
        scene_obj_add_element(obj, primitive, obj->polygon + i, 1);
    }
}

// State ---------------------------------------------------------------------------------------------

static void start_object(struct obj *obj, const char *name)
{
    const bool empty = obj->object_count > 0 && obj->part_count == obj->first_part;
    if (obj->object_count > 0 && strcmp(obj->objects[obj->object_count - 1], name) == 0) {
        return;
    }
    if (!empty) {
        if (obj->object_count >= INT_MAX) {
            refuse(obj, "has too many objects");
        }
        obj->object_count++;
        scene_import_reserve(obj->import, &obj->objects, &obj->object_capacity, obj->object_count,
                             sizeof *obj->objects);
    }
    obj->objects[obj->object_count - 1] = name;
    obj->first_part = obj->part_count;
}

// Move a backslash in front of a blank out of the way, so that the blank is part of the name, which is to be freed.
static char *library_name(struct obj *obj, struct scene_word word)
{
    char *name = scene_import_allocate(obj->import, word.length + 1, 1), *out = name;
    for (size_t i = 0; i < word.length; i++) {
        if (word.start[i] != '\\' || i + 1 == word.length || word.start[i + 1] != ' ') {
            *out++ = word.start[i];
        }
    }
    return name;
}

// Read a library. If it is not there, read the one that is called as the model is: who renames one file renames both.
static bool read_library(struct obj *obj, const char *name)
{
    const char *slash = strrchr(obj->import->name, '/'),
               *file = slash == NULL ? obj->import->name : slash + 1;
    const char *dot = strrchr(file, '.');
    char own[256];
    snprintf(own, sizeof own, "%.*s.mtl", (int)(dot == NULL ? strlen(file) : (size_t)(dot - file)), file);
    if (scene_import_find_file(obj->import, name) != NULL ||
        scene_import_find_file(obj->import, own) == NULL) {
        return scene_mtl_read(obj->import, &obj->mtl, name);
    }
    scene_import_warn(obj->import, "material library \"%s\" is not there; \"%s\" is read", name, own);
    return scene_mtl_read(obj->import, &obj->mtl, own);
}

static bool ends_in_mtl(struct scene_word word)
{
    static const char ending[] = ".mtl";
    const size_t length = strlen(ending);
    return word.length > length && strncasecmp(word.start + word.length - length, ending, length) == 0;
}

static bool has_library(struct obj *obj, struct scene_word name)
{
    char *const file = library_name(obj, name);
    const bool is_there = scene_import_find_file(obj->import, file) != NULL;
    free(file);
    return is_there;
}

// Let a name go on over blanks to the next word that ends in .mtl, unless there is a library of its own name, or one of
// the last word's name and none of the whole. Each word looks ahead, so it does so for a few words alone.
static void join_words(struct obj *obj, struct scene_word *name, struct scene_line *line)
{
    enum { MOST_WORDS = 64, LONGEST = 1024 };
    struct scene_line ahead = *line;
    struct scene_word last = *name, whole = *name;
    for (int i = 1; i < MOST_WORDS && whole.length < LONGEST && !ends_in_mtl(last); i++) {
        if (!scene_text_word(&ahead, &last)) {
            break;
        }
        whole.length = (size_t)(last.start + last.length - name->start);
    }
    if (whole.length > name->length && whole.length <= LONGEST && ends_in_mtl(last) &&
        !has_library(obj, *name) && (has_library(obj, whole) || !has_library(obj, last))) {
        *name = whole;
        *line = ahead;
    }
}

// Read what follows mtllib: one name, maybe with blanks in it, or several names.
static void read_libraries(struct obj *obj, struct scene_line line)
{
    char *const whole = library_name(obj, scene_text_rest(line));
    struct scene_word name, more;
    const bool is_one = scene_import_find_file(obj->import, whole) != NULL;
    if (is_one) {
        obj->libraries_complete = scene_mtl_read(obj->import, &obj->mtl, whole) && obj->libraries_complete;
    }
    free(whole);
    if (is_one) {
        return;
    }
    while (scene_text_word(&line, &name)) {
        while (name.start[name.length - 1] == '\\' && scene_text_word(&line, &more)) {
            name.length = (size_t)(more.start + more.length - name.start);
        }
        join_words(obj, &name, &line);
        char *const file = library_name(obj, name);
        const bool found = read_library(obj, file);
        free(file);
        obj->libraries_complete = obj->libraries_complete && found;
    }
}

static void read_material(struct obj *obj, struct scene_line line)
{
    const char *name = scene_word_bytes(obj->import, scene_text_rest(line));
    const size_t known = obj->mtl.count;
    obj->material = scene_mtl_find(obj->import, &obj->mtl, name);
    if (obj->mtl.count > known && obj->libraries_complete) {
        scene_import_warn(obj->import, "material \"%s\" is in no library", name);
    }
}

static void read_smoothing(struct obj *obj, struct scene_line line)
{
    float group = 0;
    const bool number = scene_text_numbers(&line, &group, 1) == 1;
    obj->smoothing = number && group >= 0 && group < 1e9f ? (int)group : SMOOTHING_OFF;
}

static void read_line(struct obj *obj, struct scene_word key, struct scene_line line)
{
    if (scene_word_is(key, "v")) {
        read_position(obj, line);
    } else if (scene_word_is(key, "vt")) {
        read_uv(obj, line);
    } else if (scene_word_is(key, "vn")) {
        read_normal(obj, line);
    } else if (scene_word_is(key, "f") || scene_word_is(key, "fo")) {
        read_element(obj, SCENE_PRIMITIVE_TRIANGLES, line);
    } else if (scene_word_is(key, "l")) {
        read_element(obj, SCENE_PRIMITIVE_LINES, line);
    } else if (scene_word_is(key, "p")) {
        read_element(obj, SCENE_PRIMITIVE_POINTS, line);
    } else if (scene_word_is(key, "o") || scene_word_is(key, "g")) {
        start_object(obj, scene_word_string(obj->import, scene_text_rest(line)));
    } else if (scene_word_is(key, "usemtl")) {
        read_material(obj, line);
    } else if (scene_word_is(key, "mtllib")) {
        read_libraries(obj, line);
    } else if (scene_word_is(key, "s")) {
        read_smoothing(obj, line);
    } else {
        scene_obj_tell_of_statement(obj, key, line);
    }
}

// Make a cloud of points of a file that has vertices alone.
static void add_all_points(struct obj *obj)
{
    for (size_t i = 0; i < obj->position_count; i++) {
        scene_obj_add_element(obj, SCENE_PRIMITIVE_POINTS, &(struct corner){(uint32_t)i, none, none}, 1);
    }
}

// Warn of a file that was cut. The format has no end mark. A cut file ends within a line, as few whole files do, and
// has vertices that no face has come to.
static void warn_of_cut(struct obj *obj)
{
    if (!ends_within_line(obj)) {
        return;
    }
    bool *used = scene_import_allocate(obj->import, obj->position_count, sizeof *used);
    size_t left = obj->position_count;
    for (size_t i = 0; i < obj->part_count; i++) {
        for (size_t k = 0; k < obj->parts[i].corner_count; k++) {
            const uint32_t position = obj->parts[i].corners[k].position;
            if (position < obj->position_count && !used[position]) {
                used[position] = true;
                left--;
            }
        }
    }
    free(used);
    if (left > 0) {
        scene_import_warn(obj->import,
                          "may be cut: it ends within line %u, and %zu of its %zu vertices are in no face",
                          obj->text.line, left, obj->position_count);
    }
}

// Make the colours linear. Some programs write 0 to 255. A vertex without a colour among others with one is white.
static void decode_colors(struct obj *obj)
{
    const size_t count = obj->colored ? obj->position_count : 0;
    const struct scene_color_scale scale = scene_import_color_scale((const float(*)[4])obj->colors, count);
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            obj->colors[i][c] = obj->colors[i][c] == white ? scale.color : obj->colors[i][c];
        }
    }
    scene_import_decode_colors(obj->colors, count, scale);
}

// Take z for up if a comment names a program that has z up and writes its numbers as they are.
static void read_comment(struct obj *obj, struct scene_line line)
{
    static const char *const upright[] = {"FreeCAD", "OpenSCAD", "Max2Obj"};
    struct scene_word word;
    while (scene_text_word(&line, &word)) {
        for (size_t i = 0; i < sizeof upright / sizeof *upright; i++) {
            if (scene_word_is(word, upright[i])) {
                obj->import->model.up = SCENE_AXIS_Z;
                obj->import->up_is_open = false;
            }
        }
    }
}

// Tell of elements that are left out, and of numbers that mean nothing.
static void tell_of_elements(const struct obj *obj)
{
    if (obj->small_faces > 0) {
        scene_import_warn(obj->import, "%u faces of fewer than three corners are left out", obj->small_faces);
    }
    if (obj->small_lines > 0) {
        scene_import_warn(obj->import, "%u lines of fewer than two corners are left out", obj->small_lines);
    }
    if (obj->zero_elements > 0) {
        scene_import_warn(
            obj->import,
            "faces, lines and points with an index of 0 are left out, %u of them; indices start at 1",
            obj->zero_elements);
    }
    if (obj->has_zero_others) {
        scene_import_warn(obj->import, "texture coordinates and normals with an index of 0 are left out");
    }
    if (obj->has_third_uv) {
        scene_import_unsupported(obj->import, "texture coordinates of three numbers: the third is not used");
    }
    if (obj->has_odd_numbers) {
        scene_import_warn(obj->import,
                          "two numbers behind a vertex, which OBJ gives no meaning, are ignored");
    }
}

void scene_import_obj(struct scene_import *import)
{
    struct obj obj = {.import = import,
                      .smoothing = SMOOTHING_NOT_SAID,
                      .libraries_complete = true,
                      .unknown = {.format = "OBJ"}};
    const char *problem = NULL;
    size_t size = 0;
    char *bytes = scene_import_read_file(import, import->model.path, &size, &problem);
    if (bytes == NULL) {
        scene_import_fail(import, "cannot be read: %s", problem);
    }
    import->model.format = "Wavefront OBJ";
    import->up_is_open = import->up_is_agreed = true;
    obj.text = scene_text_open(import, bytes, size);
    obj.material = scene_mtl_find(import, &obj.mtl, "");
    start_object(&obj, "");
    struct scene_line line;
    struct scene_word key;
    for (;;) {
        scene_obj_read_plain(&obj);
        if (!scene_text_line(&obj.text, true, &line)) {
            break;
        }
        if (scene_text_word(&line, &key) && key.start[0] != '#') {
            read_line(&obj, key, line);
        } else if (obj.position_count == 0) {
            read_comment(&obj, line);
        } else if (scene_word_is(key, "#MRGB")) {
            read_paint(&obj, line);
        }
    }
    if (obj.position_count == 0) {
        scene_import_fail(import, "is no OBJ model: it has no vertices");
    }
    tell_of_elements(&obj);
    warn_of_cut(&obj);
    free(bytes);
    if (obj.part_count == 0) {
        add_all_points(&obj);
    }
    decode_colors(&obj);
    use_paint(&obj);
    scene_obj_add_parts(&obj);
}
