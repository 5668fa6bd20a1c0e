// SPDX-License-Identifier: MIT
// Object File Format, as Geomview's manual has it (http://www.geomview.org/docs/html/OFF.html), and as other programs
// write it: numbers that any white space separates, with comments, or binary. assimp's reader crashes on faces of
// several lines and knows no colours.
//
// Lines matter in two places alone. The colour of a face ends with its line. And where each vertex has a line of its
// own, the line tells whether its colour has three numbers or four, and whether there is one that the keyword is silent
// of.
#include "off.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/numbers.h"
#include "import/builder/origin.h"
#include "import/builder/phong.h"
#include "import/builder/pieces.h"
#include "import/builder/place.h"
#include "import/builder/polygon.h"
#include "import/builder/readers.h"
#include "import/builder/stored_colors.h"

enum { MOST_DIMENSIONS = 64, COLOR_NUMBERS = 4, PRIMITIVES = 3 };

// What is known of the colour of a face. It is 0 for a colour of whole numbers with alpha.
enum { COLOR_MISSING = 1, COLOR_REAL = 2, COLOR_WITHOUT_ALPHA = 4 };

// Faces of three corners and more, of two, and of one.
struct primitives {
    uint32_t *indices, *faces; // the face of each primitive
    size_t index_count, index_capacity, face_count, face_capacity;
};

struct off {
    struct scene_import *import;
    struct off_source source;
    struct off_layout layout;
    uint32_t vertex_count, face_count;
    struct scene_mesh mesh;
    double origin[3]; // what was subtracted from the positions
    struct primitives primitives[PRIMITIVES];
    float (*colors)[4];      // colour of each face; NULL if none has one
    unsigned char *knowns;   // what is known of it
    bool has_indexed_colors; // at least one colour is a place in Geomview's map of colours
    bool has_odd_colors;     // at least one has a number of numbers that no colour has
    bool translucent;
    uint32_t empty_faces;
    uint32_t *corners, *triangles;
    size_t corner_capacity, triangle_capacity;
};

// Head ----------------------------------------------------------------------------------------------

bool scene_import_is_off(const unsigned char *start, size_t size)
{
    const char *text = (const char *)start, *end = text + size;
    while (text < end && (*text == ' ' || *text == '\t' || *text == '\n' || *text == '\r' || *text == '#')) {
        text = *text == '#' ? memchr(text, '\n', (size_t)(end - text)) : text + 1;
        text = text != NULL ? text : end;
    }
    struct off_layout layout;
    const struct scene_word word = {text, (size_t)(end - text)};
    const size_t length = scene_off_keyword(word, &layout);
    const char next = length < word.length ? text[length] : '\n';
    return length > 0 && (next <= ' ' || (next >= '0' && next <= '9') || next == '#');
}

static void set_dimension(struct off *off)
{
    off->source.part = "dimension";
    const uint32_t dimension = scene_off_whole(&off->source);
    if (dimension < 1 || dimension > MOST_DIMENSIONS) {
        scene_import_fail(off->import, "has vertices of %u dimensions; 1 to %d can be read", dimension,
                          MOST_DIMENSIONS);
    }
    off->layout.dimension = (int)dimension;
}

// Read BINARY, if it follows the keyword. The data begin behind its line.
static void read_binary(struct off *off, bool dimension_follows)
{
    struct off_source *source = &off->source;
    const struct scene_line before = source->line;
    struct scene_word word;
    if (!scene_off_word_of_line(source, &word) || !scene_word_is(word, "BINARY")) {
        source->line = before;
        return;
    }
    source->binary = true;
    source->cursor = (const unsigned char *)source->text.cursor;
    source->end = (const unsigned char *)source->text.end;
    scene_off_find_order(source, &off->layout, dimension_follows);
}

// Read the keyword, which a file may lack.
static void read_keyword(struct off *off)
{
    struct off_source *source = &off->source;
    struct scene_word word;
    source->part = "head";
    if (!scene_off_word(source, &word)) {
        scene_import_fail(off->import, "is no OFF model: it is empty");
    }
    const char first = word.start[0];
    const size_t length = scene_off_keyword(word, &off->layout);
    if (length == 0 && (first < '0' || first > '9')) {
        scene_import_fail(off->import, "is no OFF model: it begins with \"%s\"",
                          scene_word_string(off->import, word));
    }
    // The counts may follow the keyword without a blank.
    source->line.cursor = word.start + length;
    if (length == 0) {
        off->layout = (struct off_layout){.dimension = 3};
    }
    const bool dimension_follows = off->layout.dimension == 0;
    read_binary(off, dimension_follows);
    if (dimension_follows) {
        set_dimension(off);
    }
    if (dimension_follows && !source->binary) {
        read_binary(off, false);
    }
}

// Read the number of edges, which says nothing. Files that lack it go on with a line for each vertex.
static void read_edge_count(struct off *off)
{
    struct off_source *source = &off->source;
    struct scene_word word;
    if (source->binary) {
        scene_off_real(source);
        return;
    }
    if (!scene_off_word_of_line(source, &word) &&
        (scene_off_next_line_words(source) == 1 ||
         scene_off_words_per_line(source, off->vertex_count, off->face_count) < off->layout.dimension)) {
        scene_off_real(source);
    }
}

static void read_counts(struct off *off)
{
    off->source.part = "head";
    off->vertex_count = scene_off_whole(&off->source);
    off->face_count = scene_off_whole(&off->source);
    read_edge_count(off);
    const size_t left = off->source.binary ? (size_t)(off->source.end - off->source.cursor)
                                           : (size_t)(off->source.text.end - off->source.text.cursor);
    const uint64_t least = off->source.binary ? 4 : 2; // bytes of a number
    // The first number of a text may stand on the line of the counts.
    const uint64_t numbers = (uint64_t)off->vertex_count * (unsigned)off->layout.dimension + off->face_count;
    if (numbers * least > left + (size_t)(off->source.line.end - off->source.line.cursor) + 1) {
        scene_import_fail(off->import, "is cut: %u vertices and %u faces do not fit into it",
                          off->vertex_count, off->face_count);
    }
}

// Vertices ------------------------------------------------------------------------------------------

// Correct the layout by the lines of the vertices, if each vertex has one.
static void look_at_lines(struct off *off)
{
    struct off_layout *layout = &off->layout;
    struct off_source *source = &off->source;
    const int sure =
        layout->dimension + layout->has_w + (layout->has_normal ? 3 : 0) + (layout->has_uv ? 2 : 0);
    struct off_source ahead = *source;
    struct scene_word word;
    if (source->binary || scene_off_word_of_line(&ahead, &word) ||
        scene_off_next_line_words(source) == sure + layout->color_count) {
        return;
    }
    const int words = scene_off_words_per_line(source, off->vertex_count, off->face_count);
    if (words < sure) {
        return;
    }
    const int more = words - sure;
    layout->color_guessed = layout->color_count == 0;
    layout->color_count = more == 3 || more == 4 ? more : more > 4 && !layout->color_guessed ? 4 : 0;
    layout->ignored = more - layout->color_count;
    if (layout->ignored > 0) {
        scene_import_warn(off->import,
                          "%d numbers after each vertex, which OFF gives no meaning, are ignored",
                          layout->ignored);
    }
}

static void allocate_vertices(struct off *off)
{
    struct scene_mesh *mesh = &off->mesh;
    mesh->vertex_count = off->vertex_count;
    if (off->layout.has_normal) {
        mesh->normals = scene_import_allocate(off->import, off->vertex_count, sizeof *mesh->normals);
    }
    if (off->layout.color_count > 0) {
        mesh->colors = scene_import_allocate(off->import, off->vertex_count, sizeof *mesh->colors);
    }
    if (off->layout.has_uv) {
        mesh->uvs[0] = scene_import_allocate(off->import, off->vertex_count, sizeof *mesh->uvs[0]);
    }
}

// Read a position. A homogeneous coordinate divides the others; what it puts at infinity is left out later.
static void read_position(struct off *off, double position[3])
{
    const struct off_layout *layout = &off->layout;
    double w = 1, values[3] = {0, 0, 0};
    if (layout->has_w && layout->w_first) {
        w = scene_off_real(&off->source);
    }
    for (int c = 0; c < layout->dimension; c++) {
        const double value = scene_off_real(&off->source);
        if (c < 3) {
            values[c] = value;
        }
    }
    if (layout->has_w && !layout->w_first) {
        w = scene_off_real(&off->source);
    }
    for (int c = 0; c < 3; c++) {
        position[c] = w != 0 ? values[c] / w : (double)INFINITY;
    }
}

static void read_numbers(struct off *off, float *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        numbers[i] = (float)scene_off_real(&off->source);
    }
}

static void read_vertices(struct off *off)
{
    const struct off_layout *layout = &off->layout;
    struct scene_mesh *mesh = &off->mesh;
    double(*positions)[3] = scene_import_allocate(off->import, off->vertex_count, sizeof *positions);
    off->source.part = "vertex";
    off->source.count = off->vertex_count;
    for (uint32_t i = 0; i < off->vertex_count; i++) {
        off->source.index = i;
        read_position(off, positions[i]);
        if (layout->has_normal) {
            read_numbers(off, mesh->normals[i], 3);
        }
        if (layout->color_count > 0) {
            mesh->colors[i][3] = 1;
            read_numbers(off, mesh->colors[i], layout->color_count);
        }
        if (layout->has_uv) {
            read_numbers(off, mesh->uvs[0][i], 2);
            mesh->uvs[0][i][1] = 1 - mesh->uvs[0][i][1]; // the format's v points up
        }
        for (int k = 0; k < layout->ignored; k++) {
            scene_off_real(&off->source);
        }
    }
    mesh->vertex_count = off->vertex_count;
    scene_import_keep_exact(off->import, mesh, (const double(*)[3])positions);
    mesh->positions = scene_import_settle(off->import, positions, off->vertex_count, off->origin);
}

// Make the colours of vertices linear. Three numbers that the keyword is silent of, and of which some are negative, are
// normals.
static void use_vertex_colors(struct off *off)
{
    struct scene_mesh *mesh = &off->mesh;
    bool negative = false;
    for (uint32_t i = 0; i < off->vertex_count && off->layout.color_guessed; i++) {
        const float *color = mesh->colors[i];
        negative = negative || color[0] < 0 || color[1] < 0 || color[2] < 0;
    }
    if (!negative) {
        const float(*colors)[4] = (const float(*)[4])mesh->colors;
        off->translucent = scene_import_decode_colors(mesh->colors, off->vertex_count,
                                                      scene_import_color_scale(colors, off->vertex_count));
        return;
    }
    const bool are_normals = off->layout.color_count == 3 && mesh->normals == NULL;
    scene_import_warn(off->import, "numbers after each vertex, which its keyword does not tell of, are %s",
                      are_normals ? "taken for normals" : "ignored");
    if (are_normals) {
        mesh->normals = scene_import_allocate(off->import, off->vertex_count, sizeof *mesh->normals);
        for (uint32_t i = 0; i < off->vertex_count; i++) {
            memcpy(mesh->normals[i], mesh->colors[i], sizeof mesh->normals[i]);
        }
    }
    free(mesh->colors);
    mesh->colors = NULL;
}

// Faces ---------------------------------------------------------------------------------------------

static bool is_real(struct scene_word word)
{
    bool found = false;
    for (size_t i = 0; i < word.length; i++) {
        found = found || word.start[i] == '.' || word.start[i] == 'e' || word.start[i] == 'E';
    }
    return found;
}

static void store_color(struct off *off, uint32_t face, const float numbers[COLOR_NUMBERS], int count,
                        bool real)
{
    if (count == 0) {
        return;
    }
    if (count != 3 && count != 4) {
        off->has_indexed_colors = off->has_indexed_colors || count == 1;
        off->has_odd_colors = off->has_odd_colors || count != 1;
        return;
    }
    if (off->colors == NULL) {
        off->colors = scene_import_allocate(off->import, off->face_count, sizeof *off->colors);
        off->knowns = scene_import_allocate(off->import, off->face_count, sizeof *off->knowns);
        memset(off->knowns, COLOR_MISSING, off->face_count);
    }
    const bool bytes = numbers[0] >= 2 || numbers[1] >= 2 || numbers[2] >= 2;
    memcpy(off->colors[face], numbers, (size_t)count * sizeof *numbers);
    off->knowns[face] =
        (unsigned char)((real && !bytes ? COLOR_REAL : 0) | (count == 3 ? COLOR_WITHOUT_ALPHA : 0));
}

// Read the colour of a face: what is left of its line, or as many numbers as binary data say.
static void read_color(struct off *off, uint32_t face)
{
    struct off_source *source = &off->source;
    float numbers[COLOR_NUMBERS] = {0};
    int count = 0;
    bool real = source->binary;
    struct scene_word word;
    if (source->binary) {
        const uint32_t said = source->counts_colors ? scene_off_whole(source) : 0;
        for (uint32_t i = 0; i < said; i++, count = count <= COLOR_NUMBERS ? count + 1 : count) {
            const float number = (float)scene_off_real(source);
            numbers[i < COLOR_NUMBERS ? i : 0] = number;
        }
    }
    while (!source->binary && scene_off_word_of_line(source, &word)) {
        const float number = (float)scene_off_value(source, word);
        numbers[count < COLOR_NUMBERS ? count : 0] = number;
        real = real || is_real(word);
        count = count <= COLOR_NUMBERS ? count + 1 : count;
    }
    store_color(off, face, numbers, count, real);
}

static void add_face(struct off *off, uint32_t face, uint32_t count)
{
    const enum scene_primitive primitive = count >= 3   ? SCENE_PRIMITIVE_TRIANGLES
                                           : count == 2 ? SCENE_PRIMITIVE_LINES
                                                        : SCENE_PRIMITIVE_POINTS;
    struct primitives *list = &off->primitives[primitive];
    const uint32_t pieces = count >= 3 ? count - 2 : 1;
    const size_t more = count >= 3 ? 3 * (size_t)pieces : count;
    if (list->index_count + more > UINT32_MAX) {
        scene_import_fail(off->import, "has too many faces");
    }
    scene_import_reserve(off->import, &list->indices, &list->index_capacity, list->index_count + more,
                         sizeof *list->indices);
    scene_import_reserve(off->import, &list->faces, &list->face_capacity, list->face_count + pieces,
                         sizeof *list->faces);
    scene_import_reserve(off->import, &off->triangles, &off->triangle_capacity, more, sizeof *off->triangles);
    for (uint32_t i = 0; i < 2; i++) {
        off->triangles[i] = i;
    }
    if (count >= 3) {
        scene_import_triangulate(off->import, &off->mesh, off->corners, count, off->triangles);
    }
    for (size_t i = 0; i < more; i++) {
        list->indices[list->index_count++] = off->corners[off->triangles[i]];
    }
    for (uint32_t i = 0; i < pieces; i++) {
        list->faces[list->face_count++] = face;
    }
}

static void read_faces(struct off *off)
{
    off->source.part = "face";
    off->source.count = off->face_count;
    for (uint32_t i = 0; i < off->face_count; i++) {
        off->source.index = i;
        const uint32_t count = scene_off_whole(&off->source);
        for (uint32_t k = 0; k < count; k++) {
            const uint32_t corner = scene_off_whole(&off->source);
            if (corner >= off->vertex_count) {
                scene_import_fail(off->import, "face %u of %u refers to vertex %u; it has %u, from 0 on",
                                  i + 1, off->face_count, corner, off->vertex_count);
            }
            scene_import_reserve(off->import, &off->corners, &off->corner_capacity, (size_t)k + 1,
                                 sizeof *off->corners);
            off->corners[k] = corner;
        }
        read_color(off, i);
        if (count > 0) {
            add_face(off, i, count);
        }
        off->empty_faces += count == 0;
    }
}

// Bring the colours of all faces to one scale and make them linear. Whole numbers may mean 0 to 255 or 0 to 1; their
// largest tells. Numbers with a point are of 0 to 1. Faces without a colour among others with one are grey, by the
// manual.
static void use_face_colors(struct off *off)
{
    const float grey = 0.666f;
    const struct scene_color_scale scale =
        scene_import_color_scale((const float(*)[4])off->colors, off->face_count);
    for (uint32_t i = 0; i < off->face_count; i++) {
        float *color = off->colors[i];
        for (int c = 0; c < 3; c++) {
            color[c] = off->knowns[i] & COLOR_MISSING ? grey * scale.color
                       : off->knowns[i] & COLOR_REAL  ? color[c] * scale.color
                                                      : color[c];
        }
        if (off->knowns[i] & (COLOR_MISSING | COLOR_WITHOUT_ALPHA)) {
            color[3] = scale.alpha;
        } else if (off->knowns[i] & COLOR_REAL) {
            color[3] *= scale.alpha;
        }
    }
    off->translucent = scene_import_decode_colors(off->colors, off->face_count, scale);
}

static void tell_of_colors(struct off *off)
{
    if (off->has_indexed_colors) {
        scene_import_unsupported(off->import,
                                 "colours of faces by their number in Geomview's map: not drawn");
    }
    if (off->has_odd_colors) {
        scene_import_warn(off->import, "colours of faces that have neither 3 nor 4 numbers are ignored");
    }
    if (off->colors != NULL && off->mesh.colors != NULL) {
        scene_import_unsupported(off->import,
                                 "colours of faces (OFF): not drawn, as its vertices have colours");
    }
}

// Meshes --------------------------------------------------------------------------------------------

static void *copy_array(struct off *off, const void *array, size_t size)
{
    return array == NULL ? NULL
                         : memcpy(scene_import_allocate(off->import, off->vertex_count, size), array,
                                  off->vertex_count * size);
}

static void add_mesh(struct off *off, enum scene_primitive primitive)
{
    const struct primitives *list = &off->primitives[primitive];
    const struct scene_mesh *source = &off->mesh;
    const bool face_colors = off->colors != NULL && source->colors == NULL && list->face_count > 0;
    struct scene_mesh mesh = {
        .name = "",
        .primitive = primitive,
        .vertex_count = off->vertex_count,
        .index_count = (uint32_t)list->index_count,
        .indices = list->indices,
        .positions = copy_array(off, source->positions, sizeof *source->positions),
        .exact = copy_array(off, source->exact, sizeof *source->exact),
        .normals = copy_array(off, source->normals, sizeof *source->normals),
        .uvs = {copy_array(off, source->uvs[0], sizeof *source->uvs[0])},
        .colors = copy_array(off, source->colors, sizeof *source->colors),
    };
    if (face_colors) {
        scene_import_color_primitives(off->import, &mesh, (const float(*)[4])off->colors, list->faces);
    }
    struct scene_phong phong = scene_phong_default();
    phong.colored = mesh.colors != NULL;
    mesh.material = scene_phong_add(off->import, &phong);
    if (off->translucent) {
        off->import->model.materials[mesh.material].alpha_mode = SCENE_ALPHA_BLEND;
    }
    *scene_import_add_mesh(off->import) = mesh;
    scene_import_place_mesh(off->import, off->origin);
    struct scene_instance *instance = scene_import_add_instance(off->import);
    instance->name = "";
    instance->mesh = off->import->model.mesh_count - 1;
    instance->object = instance->mesh + 1;
    scene_import_identity(instance->world);
    scene_import_complete_polygons(off->import, instance->mesh, SCENE_IMPORT_SMOOTH, face_colors,
                                   primitive == SCENE_PRIMITIVE_TRIANGLES ? list->faces : NULL);
}

static void check_exact(struct off *off)
{
    struct scene_import_elements lists[PRIMITIVES];
    for (int i = 0; i < PRIMITIVES; i++) {
        const struct primitives *list = &off->primitives[i];
        lists[i] = scene_import_elements_of(&(struct scene_mesh){.primitive = (enum scene_primitive)i,
                                                                 .index_count = (uint32_t)list->index_count,
                                                                 .indices = list->indices});
    }
    scene_import_check_exact(off->import, &off->mesh, lists, PRIMITIVES);
}

// Add what the faces have become. Vertices without faces are a cloud of points.
static void add_meshes(struct off *off)
{
    struct primitives *points = &off->primitives[SCENE_PRIMITIVE_POINTS];
    bool any = false;
    for (int i = 0; i < PRIMITIVES; i++) {
        any = any || off->primitives[i].index_count > 0;
    }
    if (!any) {
        points->index_count = off->vertex_count;
        points->indices = scene_import_allocate(off->import, off->vertex_count, sizeof *points->indices);
        for (uint32_t i = 0; i < off->vertex_count; i++) {
            points->indices[i] = i;
        }
    }
    check_exact(off);
    for (int i = 0; i < PRIMITIVES; i++) {
        if (off->primitives[i].index_count > 0) {
            add_mesh(off, (enum scene_primitive)i);
        }
    }
}

static void tell_of_rest(struct off *off)
{
    struct scene_word word;
    if (off->empty_faces > 0) {
        scene_import_warn(off->import, "%u faces without corners are left out", off->empty_faces);
    }
    if (off->layout.dimension > 3) {
        scene_import_unsupported(off->import, "dimensions after the third: not drawn, of %d",
                                 off->layout.dimension);
    }
    const struct off_source *source = &off->source;
    if (source->binary ? source->cursor != source->end : scene_off_word(&off->source, &word)) {
        scene_import_warn(off->import, "what follows its last face is ignored");
    }
}

void scene_import_off(struct scene_import *import)
{
    struct off off = {.import = import, .mesh = {.name = ""}, .source = {.import = import}};
    const char *problem = NULL;
    size_t size = 0;
    char *bytes = scene_import_read_file(import, import->model.path, &size, &problem);
    if (bytes == NULL) {
        scene_import_fail(import, "cannot be read: %s", problem);
    }
    import->model.format = "Object File Format (OFF)";
    import->up_is_open = true;
    off.source.text = scene_text_open(import, bytes, size);
    off.source.line = (struct scene_line){off.source.text.cursor, off.source.text.cursor};
    read_keyword(&off);
    read_counts(&off);
    if (off.vertex_count == 0) {
        scene_import_fail(import, "is no OFF model: it has no vertices");
    }
    look_at_lines(&off);
    allocate_vertices(&off);
    read_vertices(&off);
    if (off.mesh.colors != NULL) {
        use_vertex_colors(&off);
    }
    read_faces(&off);
    tell_of_colors(&off);
    tell_of_rest(&off);
    free(bytes);
    if (off.colors != NULL && off.mesh.colors == NULL) {
        use_face_colors(&off);
    }
    add_meshes(&off);
}
