// SPDX-License-Identifier: MIT
// Binary FBX that stands far from the origin, as assimp is to read it. Records are copied one by one, since each says
// where in the file it ends, and the arrays of far positions are written uncompressed.
#include "fbx_far.h"
#include "fbx_record.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { DEEPEST = 64 };
enum { DOUBLE = sizeof(double) + 1 };              // bytes of a double behind its type
static const size_t most_copied = (size_t)1 << 30; // bytes of a copy, beside 64 for each of the file
enum { MOST_NAME = 512 };                          // assimp drops names of more than a thousand bytes

// Kinds and names -----------------------------------------------------------------------------------

static bool is(const char *name, size_t length, const char *text)
{
    return length == strlen(text) && memcmp(name, text, length) == 0;
}

enum scene_fbx_kind scene_fbx_kind_of(enum scene_fbx_kind parent, const char *name, size_t length)
{
    static const struct {
        enum scene_fbx_kind parent, kind;
        const char *name;
    } kinds[] = {
        {SCENE_FBX_FILE, SCENE_FBX_OBJECTS, "Objects"},
        {SCENE_FBX_OBJECTS, SCENE_FBX_GEOMETRY, "Geometry"},
        {SCENE_FBX_OBJECTS, SCENE_FBX_MODEL, "Model"},
        {SCENE_FBX_GEOMETRY, SCENE_FBX_POSITIONS, "Vertices"},
        {SCENE_FBX_GEOMETRY, SCENE_FBX_POSITIONS, "Points"},
        {SCENE_FBX_MODEL, SCENE_FBX_PROPERTIES, "Properties70"},
        {SCENE_FBX_PROPERTIES, SCENE_FBX_PROPERTY, "P"},
        {SCENE_FBX_OBJECTS, SCENE_FBX_DEFORMER, "Deformer"},
        {SCENE_FBX_DEFORMER, SCENE_FBX_BIND, "Transform"},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (parent == kinds[i].parent && is(name, length, kinds[i].name)) {
            return kinds[i].kind;
        }
    }
    return SCENE_FBX_OTHER;
}

bool scene_fbx_is_vector(const char *type, size_t length)
{
    static const char *const types[] = {"Vector3D", "Vector", "Lcl Translation", "Lcl Rotation",
                                        "Lcl Scaling"};
    bool found = false;
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        found = found || is(type, length, types[i]);
    }
    return found;
}

// In bytes a name comes before its class, with two bytes between them, and in text behind it.
bool scene_fbx_is_moved(const struct scene_assimp_exact *exact, const char *name, size_t length)
{
    static const char class[] = "Model::";
    const char *const end = memchr(name, 0, length);
    const size_t skipped =
        length >= strlen(class) && memcmp(name, class, strlen(class)) == 0 ? strlen(class) : 0;
    length = end != NULL ? (size_t)(end - name) : length;
    return scene_assimp_may_move(exact, name + skipped, length - skipped);
}

struct scene_fbx_marks scene_fbx_mark_model(struct scene_import *import, struct scene_assimp_exact *exact,
                                            const struct scene_fbx_transform *transform, bool is_moved)
{
    struct scene_fbx_marks marks = {.is_moved = is_moved};
    for (int i = 0; i < SCENE_FBX_MATRICES && !is_moved; i++) {
        double matrix[16];
        marks.is_set[i] = scene_fbx_find_matrix(transform, i, matrix);
        if (marks.is_set[i]) {
            scene_assimp_mark_matrix(import, exact, SCENE_ASSIMP_NODES, matrix, marks.marks[i]);
        }
    }
    return marks;
}

bool scene_fbx_marked_vector(struct scene_import *import, struct scene_assimp_exact *exact,
                             const struct scene_fbx_marks *marks, enum scene_fbx_vector vector,
                             const double given[3], double numbers[3])
{
    const int matrix = scene_fbx_matrix_of(vector);
    const bool is_way = scene_fbx_is_way(vector);
    if (marks->is_moved && is_way && scene_assimp_is_way(given)) {
        scene_assimp_mark_way(import, exact, given, numbers);
        return true;
    }
    for (int c = 0; c < 3 && is_way && marks->is_set[matrix]; c++) {
        numbers[c] = vector == scene_fbx_mover_of(matrix) ? marks->marks[matrix][c] : 0;
    }
    return is_way && marks->is_set[matrix];
}

void scene_fbx_mark_bind(struct scene_import *import, struct scene_assimp_exact *exact, double matrix[16])
{
    scene_assimp_mark_matrix(import, exact, SCENE_ASSIMP_MATRIX, matrix, matrix + 12);
}

bool scene_fbx_has_places(const char *class, size_t length)
{
    return is(class, length, "Mesh") || is(class, length, "Line");
}

char *scene_fbx_mark_name(struct scene_import *import, size_t offset, const char *name, size_t *length)
{
    static const char class[] = "Geometry::", mark[] = SCENE_ASSIMP_NAME_MARK;
    const size_t before =
        *length >= strlen(class) && memcmp(name, class, strlen(class)) == 0 ? strlen(class) : 0;
    char number[64];
    const size_t added = (size_t)snprintf(number, sizeof number, "%s%zu%s", mark, offset, mark);
    char *const marked = scene_import_allocate(import, *length + added, 1);
    memcpy(marked, name, before);
    memcpy(marked + before, number, added);
    memcpy(marked + before + added, name + before, *length - before);
    *length += added;
    return marked;
}

// Reading -------------------------------------------------------------------------------------------

struct copy {
    struct scene_import *import;
    struct scene_assimp_exact *exact;
    struct scene_fbx_bytes file;
    size_t most;        // bytes that the copy may have
    unsigned char *out; // the copy
    size_t written, capacity;
    // The points of the geometry that is being copied are NULL if they stay as they are.
    double (*points)[3];
    size_t point_count, offset;
    // The model that is being copied has a transform and marks.
    struct scene_fbx_transform transform;
    struct scene_fbx_marks marks;
};

// Return the doubles of an array. Return NULL if the value at `place` is none, or is not as it should be.
static double *read_doubles(const struct copy *copy, size_t place, size_t limit, size_t *count)
{
    enum { LEAST = 1032 }; // zlib makes at most so many bytes of one
    const size_t end = scene_fbx_value_end(&copy->file, place, limit);
    if (end == 0 || copy->file.bytes[place] != 'd') {
        return NULL;
    }
    const unsigned char *const head = copy->file.bytes + place + 1;
    const uint64_t numbers = scene_fbx_number(head, 4), encoding = scene_fbx_number(head + 4, 4);
    const size_t stored = end - place - 13, size = (size_t)numbers * sizeof(double);
    if (encoding > 1 || (encoding == 0 && size != stored) || size / LEAST > stored) {
        return NULL;
    }
    double *const values = scene_import_allocate(copy->import, (size_t)numbers, sizeof *values);
    uLongf made = size;
    if (encoding == 0) {
        memcpy(values, head + 12, size);
    } else if (uncompress((Bytef *)values, &made, head + 12, stored) != Z_OK || made != size) {
        free(values);
        return NULL;
    }
    *count = (size_t)numbers;
    return values;
}

// Find the first record of a kind among those in another. Return false if there is none.
static bool find_child(const struct copy *copy, const struct scene_fbx_record *parent,
                       enum scene_fbx_kind parent_kind, enum scene_fbx_kind kind,
                       struct scene_fbx_record *child)
{
    bool is_found = false;
    for (size_t place = parent->children;
         !is_found && scene_fbx_read_record(&copy->file, place, (size_t)parent->end, child) &&
         child->end > place;
         place = (size_t)child->end) {
        is_found = scene_fbx_kind_of(parent_kind, (const char *)copy->file.bytes + child->name,
                                     child->name_length) == kind;
    }
    return is_found;
}

// Return where the numbers of a property begin, behind its name, its type, its label and its flags. Return 0 if it is
// too short for them.
static size_t find_numbers(const struct copy *copy, const struct scene_fbx_record *property)
{
    size_t place = property->values;
    for (int i = 0; i < 4 && place != 0; i++) {
        place = scene_fbx_value_end(&copy->file, place, property->children);
    }
    return place;
}

// Find the positions of a geometry. They are kept where they are far.
static void find_points(struct copy *copy, const struct scene_fbx_record *geometry)
{
    size_t name_length, class_length;
    const size_t name_at = scene_fbx_value_end(&copy->file, geometry->values, geometry->children);
    const size_t name = scene_fbx_string_at(&copy->file, name_at, geometry->children, &name_length);
    const size_t class_at =
        name == 0 ? 0
                  : scene_fbx_string_at(&copy->file, name + name_length, geometry->children, &class_length);
    struct scene_fbx_record record;
    if (name_at == 0 || name == 0 || name_length > MOST_NAME || class_at == 0 ||
        !scene_fbx_has_places((const char *)copy->file.bytes + class_at, class_length)) {
        return;
    }
    const bool is_found = find_child(copy, geometry, SCENE_FBX_GEOMETRY, SCENE_FBX_POSITIONS, &record);
    size_t count = 0;
    double(*const points)[3] =
        is_found ? (void *)read_doubles(copy, record.values, record.children, &count) : NULL;
    double offset[3];
    copy->point_count = count / 3;
    if (points == NULL || count % 3 != 0 ||
        !scene_assimp_find_offset(copy->import, (const double(*)[3])points, copy->point_count, offset)) {
        free(points);
        return;
    }
    for (size_t i = 0; i < copy->point_count; i++) {
        for (int c = 0; c < 3; c++) {
            points[i][c] -= offset[c];
        }
    }
    copy->points = points;
    copy->offset = scene_assimp_keep_offset(copy->import, copy->exact, offset);
}

// A property of a model.
struct property {
    enum scene_fbx_vector vector; // SCENE_FBX_VECTORS if it is none
    double numbers[3];
};

// Read a property. Return false if it is not as it should be.
static bool read_property(const struct copy *copy, const struct scene_fbx_record *record,
                          struct property *property)
{
    size_t length, type_length;
    const size_t name = scene_fbx_string_at(&copy->file, record->values, record->children, &length);
    const size_t type =
        name == 0 ? 0 : scene_fbx_string_at(&copy->file, name + length, record->children, &type_length);
    property->vector =
        name == 0 ? SCENE_FBX_VECTORS : scene_fbx_vector_of((const char *)copy->file.bytes + name, length);
    if (property->vector == SCENE_FBX_VECTORS || type == 0 ||
        !scene_fbx_is_vector((const char *)copy->file.bytes + type, type_length)) {
        property->vector = SCENE_FBX_VECTORS;
        return true;
    }
    const size_t place = find_numbers(copy, record);
    bool is_good = place != 0 && record->children - place == 3 * DOUBLE;
    for (size_t c = 0; c < 3 && is_good; c++) {
        is_good = copy->file.bytes[place + c * DOUBLE] == 'D';
        memcpy(&property->numbers[c], copy->file.bytes + place + c * DOUBLE + 1, sizeof property->numbers[c]);
    }
    return is_good;
}

// Return the whole number that the property RotationOrder of a model has. Return -1 if the record is another property.
static double read_order(const struct copy *copy, const struct scene_fbx_record *record)
{
    size_t length;
    const size_t name = scene_fbx_string_at(&copy->file, record->values, record->children, &length);
    if (name == 0 || !is((const char *)copy->file.bytes + name, length, "RotationOrder")) {
        return -1;
    }
    const size_t place = find_numbers(copy, record);
    const bool is_number = place != 0 && record->children - place == 5 && copy->file.bytes[place] == 'I';
    return is_number ? (double)scene_fbx_number(copy->file.bytes + place + 1, 4) : -1;
}

// Find the transform of a model, and the marks that it needs. It needs none if a vector of it is not as it should be.
static void find_transform(struct copy *copy, const struct scene_fbx_record *model)
{
    struct scene_fbx_record list = {.end = 0}, record;
    struct property property;
    bool is_good = true;
    copy->marks = (struct scene_fbx_marks){.is_set = {false}};
    copy->transform = scene_fbx_transform_default();
    const bool is_found = find_child(copy, model, SCENE_FBX_MODEL, SCENE_FBX_PROPERTIES, &list);
    size_t place = is_found ? list.children : (size_t)list.end;
    while (is_found && scene_fbx_read_record(&copy->file, place, (size_t)list.end, &record) &&
           record.end > place) {
        is_good = is_good && read_property(copy, &record, &property);
        if (is_good && property.vector < SCENE_FBX_VECTORS) {
            memcpy(copy->transform.vectors[property.vector], property.numbers, sizeof property.numbers);
            copy->transform.is_given[property.vector] = true;
        }
        const double order = read_order(copy, &record);
        copy->transform.order = order >= 0 ? order : copy->transform.order;
        place = (size_t)record.end;
    }
    size_t length;
    const size_t name_at = scene_fbx_value_end(&copy->file, model->values, model->children);
    const size_t name = scene_fbx_string_at(&copy->file, name_at, model->children, &length);
    if (is_found && is_good && name_at != 0 && name != 0) {
        copy->marks = scene_fbx_mark_model(
            copy->import, copy->exact, &copy->transform,
            scene_fbx_is_moved(copy->exact, (const char *)copy->file.bytes + name, length));
    }
}

// Writing -------------------------------------------------------------------------------------------

static void put(struct copy *copy, const void *bytes, size_t size)
{
    scene_import_reserve(copy->import, &copy->out, &copy->capacity, copy->written + size, 1);
    memcpy(copy->out + copy->written, bytes, size);
    copy->written += size;
}

static void put_file(struct copy *copy, size_t place, size_t end)
{
    put(copy, copy->file.bytes + place, end - place);
}

static void set_number(struct copy *copy, size_t place, uint64_t number, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        copy->out[place + i] = (unsigned char)(number >> 8 * i);
    }
}

static void put_number(struct copy *copy, uint64_t number)
{
    static const unsigned char zeros[4] = {0};
    put(copy, zeros, sizeof zeros);
    set_number(copy, copy->written - sizeof zeros, number, sizeof zeros);
}

// Copy the values of a geometry with far positions, which gets a mark in its name.
static void put_geometry(struct copy *copy, const struct scene_fbx_record *record)
{
    size_t length;
    const size_t name_at = scene_fbx_value_end(&copy->file, record->values, record->children);
    const size_t name = scene_fbx_string_at(&copy->file, name_at, record->children, &length),
                 end = name + length;
    char *const marked =
        scene_fbx_mark_name(copy->import, copy->offset, (const char *)copy->file.bytes + name, &length);
    put_file(copy, record->values, name_at + 1);
    put_number(copy, length);
    put(copy, marked, length);
    put_file(copy, end, record->children);
    free(marked);
}

// Write an array of doubles in the place of the first value of a record.
static void put_doubles(struct copy *copy, const struct scene_fbx_record *record, const double *values,
                        size_t count)
{
    put(copy, "d", 1);
    put_number(copy, count);
    put_number(copy, 0);
    put_number(copy, count * sizeof *values);
    put(copy, values, count * sizeof *values);
    put_file(copy, scene_fbx_value_end(&copy->file, record->values, record->children), record->children);
}

static void put_positions(struct copy *copy, const struct scene_fbx_record *record)
{
    put_doubles(copy, record, copy->points[0], 3 * copy->point_count);
    free(copy->points);
    copy->points = NULL;
}

// Copy the matrix of a bone, with a mark.
static void put_bind(struct copy *copy, const struct scene_fbx_record *record)
{
    size_t count = 0;
    double *const matrix = read_doubles(copy, record->values, record->children, &count);
    if (count == 16) {
        scene_fbx_mark_bind(copy->import, copy->exact, matrix);
        put_doubles(copy, record, matrix, count);
    } else {
        put_file(copy, record->values, record->children);
    }
    free(matrix);
}

// Copy a property. The three doubles of a vector may become others.
static void put_property(struct copy *copy, const struct scene_fbx_record *record)
{
    struct property property;
    double numbers[3];
    put_file(copy, record->values, record->children);
    if (read_property(copy, record, &property) && property.vector < SCENE_FBX_VECTORS &&
        scene_fbx_marked_vector(copy->import, copy->exact, &copy->marks, property.vector, property.numbers,
                                numbers)) {
        for (size_t c = 0; c < 3; c++) {
            memcpy(copy->out + copy->written - (3 - c) * DOUBLE + 1, &numbers[c], sizeof numbers[c]);
        }
    }
}

static void put_string(struct copy *copy, const char *text)
{
    put(copy, "S", 1);
    put_number(copy, strlen(text));
    put(copy, text, strlen(text));
}

// Write a property for a mark that has none.
static void put_mark(struct copy *copy, int matrix)
{
    static const unsigned char zeros[25] = {0};
    const char *const name = scene_fbx_vector_name(scene_fbx_mover_of(matrix));
    const size_t start = copy->written, head = scene_fbx_head(&copy->file);
    put(copy, zeros, head);
    copy->out[start + head - 1] = 1;
    put(copy, "P", 1);
    put_string(copy, name);
    put_string(copy, "Vector3D");
    put_string(copy, "Vector");
    put_string(copy, "");
    for (int c = 0; c < 3; c++) {
        put(copy, "D", 1);
        put(copy, &copy->marks.marks[matrix][c], sizeof(double));
    }
    set_number(copy, start, copy->written, copy->file.word);
    set_number(copy, start + copy->file.word, 7, copy->file.word);
    set_number(copy, start + 2 * copy->file.word, copy->written - start - head - 1, copy->file.word);
}

static void put_values(struct copy *copy, enum scene_fbx_kind kind, const struct scene_fbx_record *record)
{
    if (kind == SCENE_FBX_GEOMETRY && copy->points != NULL) {
        put_geometry(copy, record);
    } else if (kind == SCENE_FBX_POSITIONS && copy->points != NULL) {
        put_positions(copy, record);
    } else if (kind == SCENE_FBX_PROPERTY) {
        put_property(copy, record);
    } else if (kind == SCENE_FBX_BIND) {
        put_bind(copy, record);
    } else {
        put_file(copy, record->values, record->children);
    }
}

// Copy the record at `place` with what is in it. Return where the file goes on. Return 0 if it is not as it should be.
static size_t copy_record(struct copy *copy, size_t place, size_t limit, enum scene_fbx_kind parent,
                          unsigned depth)
{
    struct scene_fbx_record record;
    if (depth > DEEPEST || !scene_fbx_read_record(&copy->file, place, limit, &record)) {
        return 0;
    }
    const size_t start = copy->written, head = scene_fbx_head(&copy->file);
    put_file(copy, place, record.values);
    if (record.end == 0) {
        return record.values;
    }
    const enum scene_fbx_kind kind =
        scene_fbx_kind_of(parent, (const char *)copy->file.bytes + record.name, record.name_length);
    if (kind == SCENE_FBX_GEOMETRY) {
        find_points(copy, &record);
    } else if (kind == SCENE_FBX_MODEL) {
        find_transform(copy, &record);
    }
    put_values(copy, kind, &record);
    set_number(copy, start + 2 * copy->file.word, copy->written - start - head - record.name_length,
               copy->file.word);
    for (int i = 0; i < SCENE_FBX_MATRICES && kind == SCENE_FBX_PROPERTIES; i++) {
        if (copy->marks.is_set[i] && !copy->transform.is_given[scene_fbx_mover_of(i)]) {
            put_mark(copy, i);
        }
    }
    size_t child = record.children;
    while (child != 0 && child < record.end) {
        child = copy_record(copy, child, (size_t)record.end, kind, depth + 1);
    }
    set_number(copy, start, copy->written, copy->file.word);
    const bool is_small = copy->written < copy->most && (copy->file.word == 8 || copy->written <= UINT32_MAX);
    return child == record.end && is_small && (kind != SCENE_FBX_GEOMETRY || copy->points == NULL)
               ? (size_t)record.end
               : 0;
}

char *scene_assimp_rewrite_fbx(struct scene_import *import, struct scene_assimp_exact *exact,
                               const char *bytes, size_t *size)
{
    struct copy copy = {.import = import, .exact = exact, .most = most_copied + 64 * *size};
    struct scene_fbx_record record;
    if (!scene_fbx_is_binary(bytes, *size, &copy.file)) {
        return NULL;
    }
    put_file(&copy, 0, SCENE_FBX_HEADER);
    size_t place = SCENE_FBX_HEADER;
    bool is_good = scene_fbx_read_record(&copy.file, place, *size, &record);
    while (is_good && record.end != 0) {
        place = copy_record(&copy, place, *size, SCENE_FBX_FILE, 0);
        is_good = place != 0 && scene_fbx_read_record(&copy.file, place, *size, &record);
    }
    if (!is_good) {
        free(copy.points);
        free(copy.out);
        return NULL;
    }
    put_file(&copy, place, *size);
    *size = copy.written;
    put(&copy, "", 1);
    return (char *)copy.out;
}
