// SPDX-License-Identifier: MIT
// The Stanford polygon format, which scans of a million triangles come in. It is read in one pass, several times faster
// than through assimp, whose reader also crashes on files that only begin with an odd byte.
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/find_file.h"
#include "import/builder/import.h"
#include "import/builder/numbers.h"
#include "import/builder/phong.h"
#include "import/builder/polygon.h"
#include "import/builder/readers.h"
#include "import/builder/text_lines.h"
#include "import/builder/vertices.h"

enum type {
    TYPE_NONE,
    TYPE_INT8,
    TYPE_UINT8,
    TYPE_INT16,
    TYPE_UINT16,
    TYPE_INT32,
    TYPE_UINT32,
    TYPE_FLOAT,
    TYPE_DOUBLE
};

enum encoding { ASCII, LITTLE_ENDIAN_BINARY, BIG_ENDIAN_BINARY };

// What a property of a vertex is for.
enum target { X, Y, Z, NX, NY, NZ, U, V, RED, GREEN, BLUE, ALPHA, TARGETS, UNUSED = TARGETS };

enum { MOST_ELEMENTS = 32, MOST_PROPERTIES = 256 };

struct property {
    struct scene_word name;
    enum type type, count_type; // count_type is NONE where the property is no list
};

struct element {
    struct scene_word name;
    int64_t count;
    struct property *properties;
    int property_count;
};

struct ply {
    struct scene_import *import;
    enum encoding encoding;
    struct element elements[MOST_ELEMENTS];
    int element_count;
    struct scene_word texture; // name in "comment TextureFile"
    const unsigned char *cursor, *end;
    struct scene_text text; // lines of ASCII data
    struct scene_line line;
    const struct element *element; // element being read, for messages
    int64_t row;
    struct scene_mesh mesh;
    size_t index_capacity;
    size_t index_count;
    uint32_t *edges;
    size_t edge_capacity, edge_count;
    float (*wedges)[2]; // texture coordinates of each corner; NULL if there are none
    size_t wedge_capacity;
};

// Header --------------------------------------------------------------------------------------------

static bool has_magic(const unsigned char *start, size_t size)
{
    return size >= 4 && memcmp(start, "ply", 3) == 0 && (start[3] == '\n' || start[3] == '\r');
}

bool scene_import_is_ply(const char *path, const unsigned char *start, size_t size)
{
    const char *dot = strrchr(path, '.');
    return has_magic(start, size) || (dot != NULL && strcasecmp(dot, ".ply") == 0);
}

static enum type parse_type(struct scene_word word)
{
    static const struct {
        const char *name;
        enum type type;
    } names[] = {
        {"char", TYPE_INT8},   {"uchar", TYPE_UINT8},   {"short", TYPE_INT16},   {"ushort", TYPE_UINT16},
        {"int", TYPE_INT32},   {"uint", TYPE_UINT32},   {"float", TYPE_FLOAT},   {"double", TYPE_DOUBLE},
        {"int8", TYPE_INT8},   {"uint8", TYPE_UINT8},   {"int16", TYPE_INT16},   {"uint16", TYPE_UINT16},
        {"int32", TYPE_INT32}, {"uint32", TYPE_UINT32}, {"float32", TYPE_FLOAT}, {"float64", TYPE_DOUBLE},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (scene_word_is(word, names[i].name)) {
            return names[i].type;
        }
    }
    return TYPE_NONE;
}

static size_t type_size(enum type type)
{
    static const size_t sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

_Noreturn static void refuse_header(struct ply *ply, unsigned line, const char *problem)
{
    scene_import_fail(ply->import, "line %u of the PLY header: %s", line, problem);
}

static void parse_element(struct ply *ply, struct scene_line line, unsigned number)
{
    struct scene_word word;
    double count = 0;
    size_t length = 0;
    if (ply->element_count == MOST_ELEMENTS) {
        refuse_header(ply, number, "has too many elements");
    }
    struct element *element = &ply->elements[ply->element_count++];
    if (!scene_text_word(&line, &element->name) || !scene_text_word(&line, &word) ||
        !scene_word_number(word, &count, &length) || !(count >= 0 && count < UINT32_MAX) ||
        count != floor(count)) {
        refuse_header(ply, number, "an element needs a name and a count");
    }
    element->count = (int64_t)count;
    element->properties = scene_import_allocate(ply->import, MOST_PROPERTIES, sizeof *element->properties);
}

static void parse_property(struct ply *ply, struct scene_line line, unsigned number)
{
    struct scene_word word;
    struct property property = {.count_type = TYPE_NONE};
    if (ply->element_count == 0 || ply->elements[ply->element_count - 1].property_count == MOST_PROPERTIES) {
        refuse_header(ply, number, "has a property without an element, or too many");
    }
    struct element *element = &ply->elements[ply->element_count - 1];
    bool good = scene_text_word(&line, &word);
    const bool list = good && scene_word_is(word, "list");
    if (list) {
        good = scene_text_word(&line, &word);
        property.count_type = good ? parse_type(word) : TYPE_NONE;
        good = property.count_type != TYPE_NONE && property.count_type < TYPE_FLOAT &&
               scene_text_word(&line, &word);
    }
    property.type = good ? parse_type(word) : TYPE_NONE;
    if (property.type == TYPE_NONE || !scene_text_word(&line, &property.name)) {
        refuse_header(ply, number, "a property needs a type and a name");
    }
    element->properties[element->property_count++] = property;
}

static void parse_format(struct ply *ply, struct scene_line line, unsigned number)
{
    struct scene_word word;
    scene_text_word(&line, &word);
    if (scene_word_is(word, "ascii")) {
        ply->encoding = ASCII;
    } else if (scene_word_is(word, "binary_little_endian")) {
        ply->encoding = LITTLE_ENDIAN_BINARY;
    } else if (scene_word_is(word, "binary_big_endian")) {
        ply->encoding = BIG_ENDIAN_BINARY;
    } else {
        refuse_header(ply, number, "the format must be ascii, binary_little_endian or binary_big_endian");
    }
}

static void parse_header(struct ply *ply, struct scene_text *text)
{
    struct scene_line line;
    struct scene_word word;
    while (scene_text_line(text, false, &line)) {
        if (!scene_text_word(&line, &word)) {
            continue;
        }
        if (scene_word_is(word, "end_header")) {
            return;
        }
        if (scene_word_is(word, "format")) {
            parse_format(ply, line, text->line);
        } else if (scene_word_is(word, "element")) {
            parse_element(ply, line, text->line);
        } else if (scene_word_is(word, "property")) {
            parse_property(ply, line, text->line);
        } else if (scene_word_is(word, "comment")) {
            if (scene_text_word(&line, &word) && scene_word_is(word, "TextureFile") &&
                ply->texture.length == 0) {
                ply->texture = scene_text_rest(line);
            }
        } // "ply", "obj_info" and words that exporters have invented say nothing
    }
    scene_import_fail(ply->import, "the PLY header has no end_header");
}

// Numbers -------------------------------------------------------------------------------------------

_Noreturn static void end_of_file(struct ply *ply)
{
    const char *name = scene_word_string(ply->import, ply->element->name);
    scene_import_fail(ply->import, "is truncated: it ends in %s %lld of %lld", name, (long long)ply->row,
                      (long long)ply->element->count);
}

static double read_ascii(struct ply *ply)
{
    struct scene_word word;
    double value = 0;
    size_t length = 0;
    while (!scene_text_word(&ply->line, &word)) {
        if (!scene_text_line(&ply->text, false, &ply->line)) {
            end_of_file(ply);
        }
    }
    if (!scene_word_number(word, &value, &length)) {
        scene_import_fail(ply->import, "line %u: \"%s\" is not a number", ply->text.line,
                          scene_word_string(ply->import, word));
    }
    return value;
}

static double read_binary(struct ply *ply, enum type type)
{
    const size_t size = type_size(type);
    unsigned char bytes[8] = {0};
    if ((size_t)(ply->end - ply->cursor) < size) {
        end_of_file(ply);
    }
    if (ply->encoding == BIG_ENDIAN_BINARY) {
        for (size_t i = 0; i < size; i++) {
            bytes[size - 1 - i] = ply->cursor[i];
        }
    } else {
        memcpy(bytes, ply->cursor, size);
    }
    ply->cursor += size;
    uint16_t word;
    uint32_t integer;
    float single;
    double value;
    switch (type) {
    case TYPE_INT8: return (int8_t)bytes[0];
    case TYPE_UINT8: return bytes[0];
    case TYPE_INT16: memcpy(&word, bytes, sizeof word); return (int16_t)word;
    case TYPE_UINT16: memcpy(&word, bytes, sizeof word); return word;
    case TYPE_INT32: memcpy(&integer, bytes, sizeof integer); return (int32_t)integer;
    case TYPE_UINT32: memcpy(&integer, bytes, sizeof integer); return integer;
    case TYPE_FLOAT: memcpy(&single, bytes, sizeof single); return (double)single;
    default: memcpy(&value, bytes, sizeof value); return value;
    }
}

static double read_number(struct ply *ply, enum type type)
{
    return ply->encoding == ASCII ? read_ascii(ply) : read_binary(ply, type);
}

// Return how many elements the list that follows has.
static int64_t read_count(struct ply *ply, const struct property *property)
{
    const double count = read_number(ply, property->count_type);
    if (!(count >= 0 && count < UINT32_MAX)) {
        scene_import_fail(ply->import, "%s %lld has a list of no valid length",
                          scene_word_string(ply->import, ply->element->name), (long long)ply->row);
    }
    return (int64_t)count;
}

static void skip_property(struct ply *ply, const struct property *property)
{
    const int64_t count = property->count_type == TYPE_NONE ? 1 : read_count(ply, property);
    for (int64_t i = 0; i < count; i++) {
        read_number(ply, property->type);
    }
}

// Vertices ------------------------------------------------------------------------------------------

static enum target target_of(struct scene_word name)
{
    static const struct {
        const char *name;
        enum target target;
    } names[] = {
        {"x", X},
        {"y", Y},
        {"z", Z},
        {"nx", NX},
        {"ny", NY},
        {"nz", NZ},
        {"u", U},
        {"v", V},
        {"s", U},
        {"t", V},
        {"texture_u", U},
        {"texture_v", V},
        {"red", RED},
        {"green", GREEN},
        {"blue", BLUE},
        {"alpha", ALPHA},
        {"r", RED},
        {"g", GREEN},
        {"b", BLUE},
        {"a", ALPHA},
        {"diffuse_red", RED},
        {"diffuse_green", GREEN},
        {"diffuse_blue", BLUE},
        {"diffuse_alpha", ALPHA},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        if (scene_word_is(name, names[i].name)) {
            return names[i].target;
        }
    }
    return UNUSED;
}

// Return what a colour of this type is multiplied by. Integers are fractions of their largest value.
static double color_scale(enum type type)
{
    return type == TYPE_UINT8 ? 1.0 / 255 : type == TYPE_UINT16 ? 1.0 / 65535 : 1;
}

static void allocate_vertices(struct ply *ply, const bool present[TARGETS], uint32_t count)
{
    struct scene_mesh *mesh = &ply->mesh;
    if (!present[X] || !present[Y] || !present[Z]) {
        scene_import_fail(ply->import, "its vertices have no positions");
    }
    mesh->vertex_count = count;
    mesh->positions = scene_import_allocate(ply->import, count, sizeof *mesh->positions);
    if (present[NX] && present[NY] && present[NZ]) {
        mesh->normals = scene_import_allocate(ply->import, count, sizeof *mesh->normals);
    }
    if (present[U] && present[V]) {
        mesh->uvs[0] = scene_import_allocate(ply->import, count, sizeof *mesh->uvs[0]);
    }
    if (present[RED] && present[GREEN] && present[BLUE]) {
        mesh->colors = scene_import_allocate(ply->import, count, sizeof *mesh->colors);
    }
}

static void store_vertex(struct scene_mesh *mesh, uint32_t i, const float values[TARGETS],
                         const float linear[256])
{
    memcpy(mesh->positions[i], values + X, sizeof mesh->positions[i]);
    if (mesh->normals != NULL) {
        memcpy(mesh->normals[i], values + NX, sizeof mesh->normals[i]);
    }
    if (mesh->uvs[0] != NULL) {
        mesh->uvs[0][i][0] = values[U];
        mesh->uvs[0][i][1] = 1 - values[V]; // the format's v points up
    }
    for (int c = 0; c < 3 && mesh->colors != NULL; c++) {
        const float value = values[RED + c], byte = value * 255;
        const bool exact = byte >= 0 && byte <= 255 && byte == __builtin_rintf(byte);
        mesh->colors[i][c] = exact ? linear[(int)byte] : scene_import_from_srgb(value);
    }
    if (mesh->colors != NULL) {
        mesh->colors[i][3] = values[ALPHA];
    }
}

static void read_vertices(struct ply *ply, const struct element *element)
{
    enum target targets[MOST_PROPERTIES];
    double scales[MOST_PROPERTIES];
    bool present[TARGETS + 1] = {false};
    float values[TARGETS + 1] = {[ALPHA] = 1}, linear[256];
    for (int i = 0; i < element->property_count; i++) {
        const struct property *property = &element->properties[i];
        targets[i] = property->count_type != TYPE_NONE ? UNUSED : target_of(property->name);
        scales[i] = targets[i] >= RED && targets[i] <= ALPHA ? color_scale(property->type) : 1;
        present[targets[i]] = true;
    }
    for (int i = 0; i < 256; i++) {
        linear[i] = scene_import_from_srgb((float)i / 255);
    }
    if (ply->mesh.positions != NULL) {
        scene_import_fail(ply->import, "has two lists of vertices");
    }
    allocate_vertices(ply, present, (uint32_t)element->count);
    for (ply->row = 0; ply->row < element->count; ply->row++) {
        for (int i = 0; i < element->property_count; i++) {
            if (targets[i] == UNUSED) {
                skip_property(ply, &element->properties[i]);
            } else {
                values[targets[i]] = (float)(read_number(ply, element->properties[i].type) * scales[i]);
            }
        }
        store_vertex(&ply->mesh, (uint32_t)ply->row, values, linear);
    }
}

// Faces ---------------------------------------------------------------------------------------------

static uint32_t checked_index(struct ply *ply, double index)
{
    if (!(index >= 0 && index < (double)ply->mesh.vertex_count)) {
        scene_import_fail(ply->import, "%s %lld refers to vertex %.0f of %u",
                          scene_word_string(ply->import, ply->element->name), (long long)ply->row, index,
                          ply->mesh.vertex_count);
    }
    return (uint32_t)index;
}

static void reserve_indices(struct ply *ply, size_t more)
{
    if (ply->index_count + more > UINT32_MAX) {
        scene_import_fail(ply->import, "has too many faces");
    }
    const size_t total = ply->index_count + more;
    scene_import_reserve(ply->import, &ply->mesh.indices, &ply->index_capacity, total,
                         sizeof *ply->mesh.indices);
}

// One polygon of the file, and texture coordinates of its corners.
struct face {
    uint32_t *corners;
    size_t corner_capacity;
    uint32_t *triangles;
    size_t triangle_capacity;
    float *wedges; // u, v, u, v, ...
    size_t wedge_capacity;
    int64_t count, wedge_count;
};

static void add_face(struct ply *ply, struct face *face)
{
    if (face->count < 3) {
        return;
    }
    const uint32_t count = (uint32_t)face->count;
    const size_t corners = 3 * (size_t)(count - 2);
    scene_import_reserve(ply->import, &face->triangles, &face->triangle_capacity, corners,
                         sizeof *face->triangles);
    scene_import_triangulate((const float(*)[3])ply->mesh.positions, face->corners, count, face->triangles);
    reserve_indices(ply, corners);
    const bool wedged = face->wedge_count >= 2 * face->count;
    if (wedged || ply->wedges != NULL) {
        const size_t before = ply->wedge_capacity;
        const size_t total = ply->index_count + corners;
        scene_import_reserve(ply->import, &ply->wedges, &ply->wedge_capacity, total, sizeof *ply->wedges);
        memset(ply->wedges + before, 0, (ply->wedge_capacity - before) * sizeof *ply->wedges);
    }
    for (size_t i = 0; i < corners; i++) {
        const uint32_t corner = face->triangles[i];
        if (wedged) {
            ply->wedges[ply->index_count][0] = face->wedges[2 * corner];
            ply->wedges[ply->index_count][1] = 1 - face->wedges[2 * corner + 1];
        }
        ply->mesh.indices[ply->index_count++] = face->corners[corner];
    }
}

static bool is_index_list(const struct property *property)
{
    return property->count_type != TYPE_NONE &&
           (scene_word_is(property->name, "vertex_indices") || scene_word_is(property->name, "vertex_index"));
}

// Read the corners of a polygon. Room is made as the numbers come: a count alone must not ask for memory.
static void read_corners(struct ply *ply, const struct property *property, struct face *face)
{
    face->count = read_count(ply, property);
    for (int64_t k = 0; k < face->count; k++) {
        scene_import_reserve(ply->import, &face->corners, &face->corner_capacity, (size_t)k + 1,
                             sizeof *face->corners);
        face->corners[k] = checked_index(ply, read_number(ply, property->type));
    }
}

static void read_wedges(struct ply *ply, const struct property *property, struct face *face)
{
    face->wedge_count = read_count(ply, property);
    for (int64_t k = 0; k < face->wedge_count; k++) {
        scene_import_reserve(ply->import, &face->wedges, &face->wedge_capacity, (size_t)k + 1,
                             sizeof *face->wedges);
        face->wedges[k] = (float)read_number(ply, property->type);
    }
}

static void read_faces(struct ply *ply, const struct element *element)
{
    struct face face = {.count = 0};
    for (ply->row = 0; ply->row < element->count; ply->row++) {
        face.count = face.wedge_count = 0;
        for (int i = 0; i < element->property_count; i++) {
            const struct property *property = &element->properties[i];
            if (is_index_list(property)) {
                read_corners(ply, property, &face);
            } else if (property->count_type != TYPE_NONE && scene_word_is(property->name, "texcoord")) {
                read_wedges(ply, property, &face);
            } else {
                skip_property(ply, property);
            }
        }
        add_face(ply, &face);
    }
    free(face.corners);
    free(face.triangles);
    free(face.wedges);
}

// Read triangle strips, in which −1 starts a new one.
static void read_strips(struct ply *ply, const struct element *element)
{
    for (ply->row = 0; ply->row < element->count; ply->row++) {
        for (int i = 0; i < element->property_count; i++) {
            const struct property *property = &element->properties[i];
            if (!is_index_list(property)) {
                skip_property(ply, property);
                continue;
            }
            const int64_t count = read_count(ply, property);
            uint32_t last[2] = {0, 0};
            int64_t length = 0;
            for (int64_t k = 0; k < count; k++) {
                const double value = read_number(ply, property->type);
                if (value == -1) {
                    length = 0;
                    continue;
                }
                const uint32_t index = checked_index(ply, value);
                if (length >= 2) {
                    reserve_indices(ply, 3);
                    uint32_t *out = ply->mesh.indices + ply->index_count;
                    out[0] = last[length % 2];
                    out[1] = last[1 - length % 2];
                    out[2] = index;
                    ply->index_count += 3;
                }
                last[0] = last[1];
                last[1] = index;
                length++;
            }
        }
    }
}

static void read_edges(struct ply *ply, const struct element *element)
{
    for (ply->row = 0; ply->row < element->count; ply->row++) {
        double ends[2] = {-1, -1};
        for (int i = 0; i < element->property_count; i++) {
            const struct property *property = &element->properties[i];
            const int end = scene_word_is(property->name, "vertex1")   ? 0
                            : scene_word_is(property->name, "vertex2") ? 1
                                                                       : -1;
            if (end >= 0 && property->count_type == TYPE_NONE) {
                ends[end] = read_number(ply, property->type);
            } else {
                skip_property(ply, property);
            }
        }
        scene_import_reserve(ply->import, &ply->edges, &ply->edge_capacity, ply->edge_count + 2,
                             sizeof *ply->edges);
        ply->edges[ply->edge_count++] = checked_index(ply, ends[0]);
        ply->edges[ply->edge_count++] = checked_index(ply, ends[1]);
    }
}

// Entry ---------------------------------------------------------------------------------------------

// Refuse a count that the rest of the file cannot hold, before memory is asked for it.
static void check_size(struct ply *ply, const struct element *element)
{
    const char *cursor = ply->encoding == ASCII ? ply->text.cursor : (const char *)ply->cursor;
    const size_t left = (size_t)((const char *)ply->end - cursor);
    size_t least = 0;
    for (int i = 0; i < element->property_count; i++) {
        const struct property *property = &element->properties[i];
        const enum type first = property->count_type != TYPE_NONE ? property->count_type : property->type;
        least += ply->encoding == ASCII ? 2 : type_size(first); // a number takes at least a digit and a blank
    }
    if (least > 0 && element->count > 0 && (uint64_t)(element->count - 1) > left / least) {
        scene_import_fail(ply->import, "is truncated: %lld times %s do not fit into what follows the header",
                          (long long)element->count, scene_word_string(ply->import, element->name));
    }
}

static void read_element(struct ply *ply, const struct element *element)
{
    ply->element = element;
    check_size(ply, element);
    if (element->property_count == 0) {
        return;
    }
    if (scene_word_is(element->name, "vertex")) {
        read_vertices(ply, element);
    } else if (scene_word_is(element->name, "face")) {
        read_faces(ply, element);
    } else if (scene_word_is(element->name, "tristrips")) {
        read_strips(ply, element);
    } else if (scene_word_is(element->name, "edge")) {
        read_edges(ply, element);
    } else {
        for (ply->row = 0; ply->row < element->count; ply->row++) {
            for (int i = 0; i < element->property_count; i++) {
                skip_property(ply, &element->properties[i]);
            }
        }
    }
}

static uint32_t add_material(struct ply *ply)
{
    struct scene_phong phong = scene_phong_default();
    phong.colored = ply->mesh.colors != NULL;
    if (ply->texture.length > 0 && (ply->mesh.uvs[0] != NULL || ply->wedges != NULL)) {
        phong.color.name = scene_word_string(ply->import, ply->texture);
        scene_import_find_image(ply->import, NULL, scene_word_bytes(ply->import, ply->texture),
                                &phong.color.source);
    }
    return scene_phong_add(ply->import, &phong);
}

static void add_mesh(struct ply *ply, const struct scene_mesh *mesh, bool join)
{
    *scene_import_add_mesh(ply->import) = *mesh;
    struct scene_instance *instance = scene_import_add_instance(ply->import);
    instance->mesh = ply->import->model.mesh_count - 1;
    instance->object = instance->mesh + 1;
    scene_import_identity(instance->world);
    scene_import_complete_mesh(ply->import, instance->mesh, SCENE_IMPORT_SMOOTH, join);
}

// Return a mesh with copies of the vertices, for another kind of primitive.
static struct scene_mesh copy_vertices(struct ply *ply)
{
    const struct scene_mesh *mesh = &ply->mesh;
    struct scene_mesh copy = {.name = "", .material = mesh->material, .vertex_count = mesh->vertex_count};
    copy.positions = scene_import_allocate(ply->import, mesh->vertex_count, sizeof *copy.positions);
    memcpy(copy.positions, mesh->positions, mesh->vertex_count * sizeof *copy.positions);
    if (mesh->colors != NULL) {
        copy.colors = scene_import_allocate(ply->import, mesh->vertex_count, sizeof *copy.colors);
        memcpy(copy.colors, mesh->colors, mesh->vertex_count * sizeof *copy.colors);
    }
    return copy;
}

static void add_lines(struct ply *ply)
{
    struct scene_mesh lines = copy_vertices(ply);
    if (ply->edge_count > UINT32_MAX) {
        scene_import_fail(ply->import, "has too many edges");
    }
    lines.primitive = SCENE_PRIMITIVE_LINES;
    lines.indices = ply->edges;
    lines.index_count = (uint32_t)ply->edge_count;
    add_mesh(ply, &lines, false);
}

static void add_triangles(struct ply *ply)
{
    struct scene_mesh *mesh = &ply->mesh;
    mesh->primitive = SCENE_PRIMITIVE_TRIANGLES;
    mesh->index_count = (uint32_t)ply->index_count;
    // Texture coordinates belong to corners, so every corner gets its own vertex.
    if (ply->wedges != NULL) {
        scene_import_gather_vertices(ply->import, mesh, mesh->indices, mesh->index_count);
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            mesh->indices[i] = i;
        }
        mesh->uvs[0] = ply->wedges;
    }
    add_mesh(ply, mesh, ply->wedges != NULL);
}

static void add_points(struct ply *ply)
{
    struct scene_mesh *mesh = &ply->mesh;
    mesh->primitive = SCENE_PRIMITIVE_POINTS;
    mesh->index_count = mesh->vertex_count;
    mesh->indices = scene_import_allocate(ply->import, mesh->vertex_count, sizeof *mesh->indices);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        mesh->indices[i] = i;
    }
    add_mesh(ply, mesh, false);
}

// Refuse clouds of soft ellipsoids. Scans come as such clouds in PLY as well; drawn as points they would be no picture
// of anything.
static void refuse_gaussians(const struct ply *ply)
{
    static const char *const names[] = {"f_dc_0", "opacity", "scale_0", "rot_0"};
    unsigned found = 0;
    for (int i = 0; i < ply->element_count; i++) {
        for (int k = 0; k < ply->elements[i].property_count; k++) {
            for (int n = 0; n < 4; n++) {
                found |= scene_word_is(ply->elements[i].properties[k].name, names[n]) ? 1u << n : 0;
            }
        }
    }
    if (found == 15) {
        scene_import_fail(ply->import, "holds Gaussian splats, which are not supported");
    }
}

void scene_import_ply(struct scene_import *import)
{
    struct ply ply = {.import = import, .mesh = {.name = ""}};
    const char *problem = NULL;
    size_t size = 0;
    char *bytes = scene_import_read_file(import, import->model.path, &size, &problem);
    if (bytes == NULL) {
        scene_import_fail(import, "cannot be read: %s", problem);
    }
    if (!has_magic((const unsigned char *)bytes, size)) {
        scene_import_fail(import, "is no PLY file: it does not begin with \"ply\"");
    }
    import->model.format = "PLY";
    import->up_is_open = true;
    ply.text = (struct scene_text){bytes, bytes + size, 0};
    ply.end = (const unsigned char *)bytes + size;
    parse_header(&ply, &ply.text);
    refuse_gaussians(&ply);
    ply.cursor = (const unsigned char *)ply.text.cursor;
    ply.line = (struct scene_line){ply.text.cursor, ply.text.cursor};
    for (int i = 0; i < ply.element_count; i++) {
        read_element(&ply, &ply.elements[i]);
    }
    if (ply.mesh.positions == NULL) {
        scene_import_fail(import, "has no vertices");
    }
    ply.mesh.material = add_material(&ply);
    free(bytes);
    if (ply.edge_count > 0) {
        add_lines(&ply);
    }
    if (ply.index_count > 0) {
        add_triangles(&ply);
    } else if (ply.edge_count == 0) {
        add_points(&ply);
    }
}
