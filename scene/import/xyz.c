// SPDX-License-Identifier: MIT
// Clouds of points as text: XYZ and ASC, and PTS, which says how many points follow. A line is a point: its position,
// then whatever the program had. No document says what, so the numbers themselves tell colours and normals apart.
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/numbers.h"
#include "import/builder/pieces.h"
#include "import/builder/phong.h"
#include "import/builder/place.h"
#include "import/builder/readers.h"
#include "import/builder/stored_colors.h"
#include "import/builder/text_lines.h"

enum { MOST_EXTRA = 7 }; // an intensity, a colour and a normal

struct cloud {
    struct scene_import *import;
    struct scene_text text;
    double (*positions)[3];
    float *extras; // what follows each position, extra_count numbers
    size_t count, capacity, extra_capacity;
    int extra_count; // −1 until a point is read
    bool has_more;   // a point has numbers after these
    double said;     // how many points the file says that it has; 0 if it says nothing
};

_Noreturn static void refuse(const struct cloud *cloud, const char *problem)
{
    scene_import_fail(cloud->import, "line %u: %s", cloud->text.line, problem);
}

// Lines ---------------------------------------------------------------------------------------------

// Make blanks of the commas and semicolons that separate numbers.
static void blank_separators(struct scene_text *text)
{
    for (char *c = text->cursor; c < text->end; c++) {
        *c = *c == ',' || *c == ';' ? ' ' : *c;
    }
}

// Read up to `most` numbers. Return how many there are, and set `rest` if something else follows.
static int read_numbers(struct scene_line line, double *values, int most, bool *rest)
{
    struct scene_word word;
    int count = 0;
    *rest = false;
    while (scene_text_word(&line, &word)) {
        double value = 0;
        size_t length = 0;
        *rest = !scene_word_number(word, &value, &length) || length != word.length;
        if (*rest) {
            break;
        }
        if (count < most) {
            values[count] = value;
        }
        count++;
    }
    return count;
}

static void add_point(struct cloud *cloud, const double *values, int count)
{
    if (cloud->extra_count < 0) {
        cloud->extra_count = count - 3 < MOST_EXTRA ? count - 3 : MOST_EXTRA;
    }
    if (count - 3 < cloud->extra_count) {
        refuse(cloud, "a point has fewer numbers than the first one");
    }
    cloud->has_more = cloud->has_more || count - 3 > cloud->extra_count;
    if (cloud->count >= UINT32_MAX) {
        refuse(cloud, "has too many points");
    }
    const size_t extra_count = (size_t)cloud->extra_count, first = cloud->count * extra_count;
    scene_import_reserve(cloud->import, &cloud->positions, &cloud->capacity, cloud->count + 1,
                         sizeof *cloud->positions);
    scene_import_reserve(cloud->import, &cloud->extras, &cloud->extra_capacity, first + extra_count,
                         sizeof *cloud->extras);
    memcpy(cloud->positions[cloud->count++], values, sizeof *cloud->positions);
    for (size_t i = 0; i < extra_count; i++) {
        cloud->extras[first + i] = (float)values[3 + i];
    }
}

// Chemistry's format of the same name: the number of atoms, a comment, and then an element before each position.
static bool is_atom(struct scene_line line)
{
    struct scene_word word;
    double values[3];
    bool rest;
    return scene_text_word(&line, &word) && word.length <= 3 && read_numbers(line, values, 3, &rest) >= 3;
}

static void read_line(struct cloud *cloud, struct scene_line line)
{
    double values[3 + MOST_EXTRA];
    struct scene_line words = line;
    struct scene_word word;
    bool rest;
    if (!scene_text_word(&words, &word) || *word.start == '#' || *word.start == '/' || *word.start == '%') {
        return;
    }
    const int count = read_numbers(line, values, 3 + MOST_EXTRA, &rest);
    if (count >= 3 && !rest) {
        add_point(cloud, values, count);
    } else if (count == 1 && !rest && values[0] >= 0) {
        cloud->said += values[0];
    } else if (is_atom(line)) {
        scene_import_fail(cloud->import, "lists atoms (XYZ of chemistry), which are not supported");
    } else if (cloud->count > 0) {
        refuse(cloud, "a point needs three numbers");
    }
}

// Meaning -------------------------------------------------------------------------------------------

// Return true if three columns are vectors of length 1 or 0, and not all of them whole numbers.
static bool are_normals(const struct cloud *cloud, int column)
{
    bool whole = true;
    for (size_t i = 0; i < cloud->count; i++) {
        const float *v = cloud->extras + i * (size_t)cloud->extra_count + column;
        const float square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        if (!(square == 0.0f || (square > 0.98f && square < 1.02f))) {
            return false;
        }
        for (int c = 0; c < 3; c++) {
            whole = whole && v[c] >= 0.0f && (v[c] == 0.0f || v[c] == 1.0f);
        }
    }
    return !whole;
}

static bool are_colors(const struct cloud *cloud, int column)
{
    for (size_t i = 0; i < cloud->count; i++) {
        for (int c = 0; c < 3; c++) {
            const float value = cloud->extras[i * (size_t)cloud->extra_count + (size_t)(column + c)];
            if (!(value >= 0.0f && value <= 65535.0f)) {
                return false;
            }
        }
    }
    return true;
}

static void set_colors(const struct cloud *cloud, int column, struct scene_mesh *mesh)
{
    mesh->colors = scene_import_allocate(cloud->import, cloud->count, sizeof *mesh->colors);
    for (size_t i = 0; i < cloud->count; i++) {
        memcpy(mesh->colors[i], cloud->extras + i * (size_t)cloud->extra_count + column, 3 * sizeof(float));
        mesh->colors[i][3] = 1.0f;
    }
    struct scene_color_scale scale = scene_import_color_scale((const float(*)[4])mesh->colors, cloud->count);
    scale.alpha = 1.0f;
    scene_import_decode_colors(mesh->colors, cloud->count, scale);
}

static void set_normals(const struct cloud *cloud, int column, struct scene_mesh *mesh)
{
    mesh->normals = scene_import_allocate(cloud->import, cloud->count, sizeof *mesh->normals);
    for (size_t i = 0; i < cloud->count; i++) {
        memcpy(mesh->normals[i], cloud->extras + i * (size_t)cloud->extra_count + column, 3 * sizeof(float));
    }
}

// Return true if a column is an alpha that is opaque everywhere.
static bool is_opaque(const struct cloud *cloud, int column)
{
    bool opaque = true;
    for (size_t i = 0; i < cloud->count; i++) {
        const float value = cloud->extras[i * (size_t)cloud->extra_count + (size_t)column];
        opaque = opaque && (value == 255.0f || value == 1.0f);
    }
    return opaque;
}

// Find colours and normals among the columns behind the positions, and tell of those that are neither. Colours come
// last or in front of normals; PTS has an intensity before them.
static void find_meaning(const struct cloud *cloud, struct scene_mesh *mesh)
{
    const bool has_intensity = strcasecmp(cloud->import->ending, "pts") == 0 && cloud->extra_count >= 4;
    int column = has_intensity ? 1 : 0;
    for (; column + 3 <= cloud->extra_count; column += 3) {
        if (mesh->normals == NULL && are_normals(cloud, column)) {
            set_normals(cloud, column, mesh);
        } else if (mesh->colors == NULL && are_colors(cloud, column)) {
            set_colors(cloud, column, mesh);
        } else {
            break;
        }
    }
    if (mesh->colors != NULL && column + 1 == cloud->extra_count && is_opaque(cloud, column)) {
        column++;
    }
    if (has_intensity || cloud->has_more || column < cloud->extra_count) {
        scene_import_unsupported(cloud->import,
                                 "numbers of points that are neither colours nor normals: not drawn");
    }
}

static void add_cloud(struct cloud *cloud)
{
    struct scene_import *import = cloud->import;
    struct scene_mesh mesh = {.name = "", .primitive = SCENE_PRIMITIVE_POINTS};
    mesh.vertex_count = mesh.index_count = (uint32_t)cloud->count;
    double origin[3];
    mesh.indices = scene_import_allocate(import, cloud->count, sizeof *mesh.indices);
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        mesh.indices[i] = i;
    }
    scene_import_settle_mesh(import, &mesh, cloud->positions, origin);
    find_meaning(cloud, &mesh);
    free(cloud->extras);
    struct scene_phong phong = scene_phong_default();
    phong.colored = mesh.colors != NULL;
    mesh.material = scene_phong_add(import, &phong);
    *scene_import_add_mesh(import) = mesh;
    scene_import_place_mesh(import, origin);
    struct scene_instance *instance = scene_import_add_instance(import);
    instance->mesh = import->model.mesh_count - 1;
    instance->object = 1;
    scene_import_identity(instance->world);
    scene_import_complete_mesh(import, instance->mesh, SCENE_IMPORT_SMOOTH, false);
}

void scene_import_xyz(struct scene_import *import)
{
    struct cloud cloud = {.import = import, .extra_count = -1};
    const char *problem = NULL;
    size_t size = 0;
    char *bytes = scene_import_read_file(import, import->model.path, &size, &problem);
    if (bytes == NULL) {
        scene_import_fail(import, "cannot be read: %s", problem);
    }
    import->model.format = strcasecmp(import->ending, "pts") == 0 ? "points (PTS)" : "points (XYZ)";
    // Scans of the ground have heights in z.
    import->model.up = SCENE_AXIS_Z;
    import->up_is_open = true;
    cloud.text = scene_text_open(import, bytes, size);
    blank_separators(&cloud.text);
    struct scene_line line;
    while (scene_text_line(&cloud.text, false, &line)) {
        read_line(&cloud, line);
    }
    free(bytes);
    if (cloud.count == 0) {
        scene_import_fail(import, "is no cloud of points: no line has three numbers");
    }
    if (cloud.said > (double)cloud.count) {
        scene_import_fail(import, "is cut: it has %zu of %.0f points", cloud.count, cloud.said);
    }
    add_cloud(&cloud);
}
