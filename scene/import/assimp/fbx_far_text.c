// SPDX-License-Identifier: MIT
// FBX of text that stands far from the origin, as assimp is to read it.
#include "edits.h"
#include "fbx_far.h"
#include "import/builder/text_lines.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEEPEST = 64 };
enum { MOST_NAME = 512 }; // assimp drops names of more than a thousand bytes

struct text {
    struct scene_import *import;
    struct scene_assimp_exact *exact;
    const char *start, *end;
    struct scene_edits edits;
    enum scene_fbx_kind kinds[DEEPEST]; // the kinds of the records that are open
    unsigned depth;                     // number of these
    enum scene_fbx_kind kind;           // the kind of the record whose name was read last
    struct scene_word name; // the name of the geometry that is open; its start is NULL if it has no places
    // Of the model whose properties are open: where they begin, and where the numbers of each vector are.
    const char *properties;
    struct scene_fbx_transform transform;
    const char *vectors[SCENE_FBX_VECTORS][2];
    bool is_moved; // an animation moves the model
    bool is_odd;   // a vector is not as it should be
};

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static bool is_of_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static const char *skip_blanks(const struct text *text, const char *c)
{
    while (c < text->end && (is_blank(*c) || *c == ',')) {
        c++;
    }
    return c;
}

// Read a string in quotation marks from `c` on. Return where it ends. Return NULL if there is none.
static const char *read_string(const struct text *text, const char *c, struct scene_word *string)
{
    c = skip_blanks(text, c);
    if (c == text->end || *c != '"') {
        return NULL;
    }
    const char *const quote = memchr(c + 1, '"', (size_t)(text->end - c - 1));
    if (quote != NULL) {
        *string = (struct scene_word){c + 1, (size_t)(quote - c - 1)};
    }
    return quote == NULL ? NULL : quote + 1;
}

// Read a number from `c` on. Return where it ends. Return NULL if there is none.
static const char *read_number(const struct text *text, const char *c, double *number)
{
    return scene_number_read(skip_blanks(text, c), text->end, ", \t\r\n}\"", number);
}

static const char *read_geometry(struct text *text, const char *c)
{
    struct scene_word name, class;
    double id;
    text->name.start = NULL;
    const char *place = read_number(text, c, &id);
    place = place == NULL ? NULL : read_string(text, place, &name);
    place = place == NULL ? NULL : read_string(text, place, &class);
    if (place != NULL && name.length <= MOST_NAME && scene_fbx_has_places(class.start, class.length)) {
        text->name = name;
    }
    return place == NULL ? c : place;
}

static const char *read_model(struct text *text, const char *c)
{
    struct scene_word name;
    double id;
    const char *place = read_number(text, c, &id);
    place = place == NULL ? NULL : read_string(text, place, &name);
    text->is_moved = place != NULL && scene_fbx_is_moved(text->exact, name.start, name.length);
    return place == NULL ? c : place;
}

static void read_vector(struct text *text, enum scene_fbx_vector vector, const char *c)
{
    double *const numbers = text->transform.vectors[vector];
    const char *const first = skip_blanks(text, c), *place = first;
    for (int i = 0; i < 3 && place != NULL; i++) {
        place = read_number(text, place, &numbers[i]);
    }
    text->is_odd = text->is_odd || place == NULL;
    text->transform.is_given[vector] = true;
    text->vectors[vector][0] = first;
    text->vectors[vector][1] = place;
}

static const char *read_property(struct text *text, const char *c)
{
    struct scene_word strings[4]; // the name, the type, the label, the flags
    const char *place = c;
    for (int i = 0; i < 4 && place != NULL; i++) {
        place = read_string(text, place, &strings[i]);
    }
    if (place == NULL) {
        return c;
    }
    const enum scene_fbx_vector vector = scene_fbx_vector_of(strings[0].start, strings[0].length);
    if (vector < SCENE_FBX_VECTORS && scene_fbx_is_vector(strings[1].start, strings[1].length)) {
        text->is_odd = text->is_odd || text->transform.is_given[vector];
        read_vector(text, vector, place);
    } else if (scene_word_is(strings[0], "RotationOrder")) {
        text->is_odd = read_number(text, place, &text->transform.order) == NULL || text->is_odd;
    }
    return place;
}

static void replace_vector(struct text *text, const char *first, const char *last, const double numbers[3])
{
    char written[3 * 32] = "";
    for (int c = 0, length = 0; c < 3; c++) {
        length += (int)scene_assimp_write_number(written + length, numbers[c]);
        written[length++] = c < 2 ? ',' : 0;
    }
    scene_edits_add_string(text->import, &text->edits, (size_t)(first - text->start), (size_t)(last - first),
                           written);
}

// Write a property for a mark that has none.
static void add_mark(struct text *text, int matrix, const double mark[3])
{
    char written[192];
    snprintf(written, sizeof written, "\nP: \"%s\", \"Vector3D\", \"Vector\", \"\",%.0f,%.0f,%.0f\n",
             scene_fbx_vector_name(scene_fbx_mover_of(matrix)), mark[0], mark[1], mark[2]);
    scene_edits_add_string(text->import, &text->edits, (size_t)(text->properties - text->start), 0, written);
}

// Collect the changes that the properties of a model need, at their end.
static void end_properties(struct text *text)
{
    struct scene_fbx_marks marks = {.is_set = {false}};
    double numbers[3];
    if (!text->is_odd) {
        marks = scene_fbx_mark_model(text->import, text->exact, &text->transform, text->is_moved);
    }
    for (int i = 0; i < SCENE_FBX_VECTORS && !text->is_odd; i++) {
        if (text->transform.is_given[i] &&
            scene_fbx_marked_vector(text->import, text->exact, &marks, (enum scene_fbx_vector)i,
                                    text->transform.vectors[i], numbers)) {
            replace_vector(text, text->vectors[i][0], text->vectors[i][1], numbers);
        }
    }
    for (int i = 0; i < SCENE_FBX_MATRICES; i++) {
        if (marks.is_set[i] && !text->transform.is_given[scene_fbx_mover_of(i)]) {
            add_mark(text, i, marks.marks[i]);
        }
    }
}

static void open_record(struct text *text, const char *c)
{
    if (text->kind == SCENE_FBX_PROPERTIES) {
        text->properties = c + 1;
        text->transform = scene_fbx_transform_default();
        text->is_odd = false;
    }
    text->kinds[text->depth++] = text->kind;
    text->kind = SCENE_FBX_OTHER;
}

static void close_record(struct text *text)
{
    if (text->depth > 0 && text->kinds[--text->depth] == SCENE_FBX_PROPERTIES) {
        end_properties(text);
    }
}

static double *read_doubles(const struct text *text, const char **c, size_t *count)
{
    double *numbers = NULL, number;
    size_t capacity = 0;
    *count = 0;
    for (const char *place = read_number(text, *c, &number); place != NULL;
         place = read_number(text, place, &number)) {
        scene_import_reserve(text->import, &numbers, &capacity, *count + 1, sizeof *numbers);
        numbers[(*count)++] = number;
        *c = place;
    }
    return numbers;
}

static void mark_name(struct text *text, const double offset[3])
{
    size_t length = text->name.length;
    const size_t number = scene_assimp_keep_offset(text->import, text->exact, offset);
    char *const name = scene_fbx_mark_name(text->import, number, text->name.start, &length);
    scene_edits_add(
        text->import, &text->edits,
        (struct scene_edit){(size_t)(text->name.start - text->start), text->name.length, name, length});
}

// Read the numbers of an array of positions.
static const char *read_positions(struct text *text, const char *c)
{
    const char *const first = skip_blanks(text, c), *last = first;
    size_t count;
    double offset[3];
    double(*const points)[3] = (void *)read_doubles(text, &last, &count);
    if (text->name.start != NULL && count > 0 && count % 3 == 0 &&
        scene_assimp_find_offset(text->import, (const double(*)[3])points, count / 3, offset)) {
        scene_assimp_edit_points(text->import, &text->edits, (size_t)(first - text->start),
                                 (size_t)(last - first), ',', (const double(*)[3])points, count / 3, offset);
        mark_name(text, offset);
    }
    text->name.start = NULL; // the first array alone counts
    free(points);
    return last;
}

// Read the matrix of a bone, which gets a mark.
static const char *read_bind(struct text *text, const char *c)
{
    const char *const first = skip_blanks(text, c), *last = first;
    size_t count;
    double *const matrix = read_doubles(text, &last, &count);
    if (count == 16) {
        char written[16 * 32];
        size_t length = 0;
        scene_fbx_mark_bind(text->import, text->exact, matrix);
        for (size_t i = 0; i < count; i++) {
            length += scene_assimp_write_number(written + length, matrix[i]);
            written[length++] = i + 1 < count ? ',' : 0;
        }
        scene_edits_add_string(text->import, &text->edits, (size_t)(first - text->start),
                               (size_t)(last - first), written);
    }
    free(matrix);
    return last;
}

// Read what follows the name of a record, as far as it is of interest.
static const char *read_values(struct text *text, const char *name, size_t length, const char *c)
{
    const enum scene_fbx_kind parent = text->depth == 0 ? SCENE_FBX_FILE : text->kinds[text->depth - 1];
    if (parent == SCENE_FBX_POSITIONS && length == 1 && *name == 'a') {
        return read_positions(text, c);
    }
    if (parent == SCENE_FBX_BIND && length == 1 && *name == 'a') {
        return read_bind(text, c);
    }
    text->kind = scene_fbx_kind_of(parent, name, length);
    return text->kind == SCENE_FBX_GEOMETRY   ? read_geometry(text, c)
           : text->kind == SCENE_FBX_MODEL    ? read_model(text, c)
           : text->kind == SCENE_FBX_PROPERTY ? read_property(text, c)
                                              : c;
}

// Read on from `c`: a comment, a string, a brace, a word or a single byte. Return where it ends. Return NULL if records
// are nested too deeply.
static const char *read_on(struct text *text, const char *c)
{
    struct scene_word string;
    const char *end = c;
    if (*c == ';') {
        end = memchr(c, '\n', (size_t)(text->end - c));
        return end == NULL ? text->end : end;
    }
    if (*c == '"') {
        end = read_string(text, c, &string);
        return end == NULL ? text->end : end;
    }
    if (*c == '{' && text->depth == DEEPEST) {
        return NULL;
    }
    if (*c == '{') {
        open_record(text, c);
    } else if (*c == '}') {
        close_record(text);
    }
    while (end < text->end && is_of_word(*end)) {
        end++;
    }
    return end == c                         ? c + 1
           : end < text->end && *end == ':' ? read_values(text, c, (size_t)(end - c), end + 1)
                                            : end;
}

char *scene_assimp_rewrite_fbx_text(struct scene_import *import, struct scene_assimp_exact *exact,
                                    const char *bytes, size_t *size)
{
    struct text text = {
        .import = import, .exact = exact, .start = bytes, .end = bytes + *size, .kind = SCENE_FBX_OTHER};
    if (strstr(bytes, "FBXHeaderExtension") == NULL) {
        return NULL;
    }
    const char *c = bytes;
    while (c != NULL && c < text.end) {
        c = read_on(&text, c);
    }
    char *const edited = scene_edits_apply(import, &text.edits, bytes, size);
    if (c == NULL) {
        free(edited);
        return NULL;
    }
    return edited;
}
