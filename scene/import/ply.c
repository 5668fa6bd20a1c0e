// SPDX-License-Identifier: MIT
// The Stanford polygon format, which scans of a million triangles come in. It is read in one pass, several times faster
// than through assimp, whose reader also crashes on files that only begin with an odd byte.
//
// Here are the order of a read, and the meshes that the data become.
#include "ply.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/find_file.h"
#include "import/builder/numbers.h"
#include "import/builder/origin.h"
#include "import/builder/phong.h"
#include "import/builder/pieces.h"
#include "import/builder/place.h"
#include "import/builder/readers.h"
#include "import/builder/stored_colors.h"
#include "import/builder/text_lines.h"
#include "import/builder/vertices.h"

enum { MOST_COPIES = 64 };

static bool has_magic(const unsigned char *start, size_t size)
{
    const size_t mark = scene_text_marks(start, size);
    const unsigned char *word = start + mark;
    return size >= mark + 4 && memcmp(word, "ply", 3) == 0 && (word[3] == '\n' || word[3] == '\r');
}

bool scene_import_is_ply(const char *path, const unsigned char *start, size_t size)
{
    const char *dot = strrchr(path, '.');
    return has_magic(start, size) || (dot != NULL && strcasecmp(dot, ".ply") == 0);
}

// Return true if a name has a word in it, in any case. No letters stand beside a word, unless an underscore ends it.
static bool has_word(struct scene_word name, const char *word)
{
    const size_t length = strlen(word);
    for (size_t i = 0; i + length <= name.length; i++) {
        const bool begins = i == 0 || !isalpha((unsigned char)name.start[i - 1]);
        const bool ends = word[length - 1] == '_' || i + length == name.length ||
                          !isalpha((unsigned char)name.start[i + length]);
        if (begins && ends && strncasecmp(name.start + i, word, length) == 0) {
            return true;
        }
    }
    return false;
}

void scene_ply_tell_of_property(struct ply *ply, struct scene_word name)
{
    static const struct {
        const char *word, *what;
    } looks[] = {
        {"ambient_", "ambient colours"},
        {"specular_", "specular colours"},
        {"material_index", "materials of faces"},
        {"material_indices", "materials of faces"},
        {"red", NULL},
        {"green", NULL},
        {"blue", NULL},
        {"rgb", NULL},
        {"rgba", NULL},
        {"color", NULL},
        {"colour", NULL},
        {"alpha", NULL},
        {"normal", NULL},
        {"texture", NULL},
        {"texcoord", NULL},
    };
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; i++) {
        if (has_word(name, looks[i].word)) {
            if (looks[i].what != NULL) {
                scene_import_unsupported(ply->import, "%s (PLY): not drawn", looks[i].what);
            } else {
                scene_import_unsupported(ply->import, "property \"%s\" (PLY): not drawn",
                                         scene_word_string(ply->import, name));
            }
            return;
        }
    }
}

// Elements ------------------------------------------------------------------------------------------

// Refuse a count that the rest of the file cannot hold, before memory is asked for it.
static void check_size(struct ply *ply, const struct element *element)
{
    const char *cursor = ply->encoding == ASCII ? ply->text.cursor : (const char *)ply->cursor;
    const size_t left = (size_t)((const char *)ply->end - cursor);
    size_t least = 0;
    for (int i = 0; i < element->property_count; i++) {
        const struct property *property = &element->properties[i];
        const enum type first = property->count_type != TYPE_NONE ? property->count_type : property->type;
        least += ply->encoding == ASCII
                     ? 2
                     : scene_ply_type_size(first); // a number takes at least a digit and a blank
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
        scene_ply_read_vertices(ply, element);
    } else if (scene_word_is(element->name, "face")) {
        scene_ply_read_faces(ply, element);
    } else if (scene_word_is(element->name, "tristrips")) {
        scene_ply_read_strips(ply, element);
    } else if (scene_word_is(element->name, "edge")) {
        scene_ply_read_edges(ply, element);
    } else {
        if (element->count > 0) {
            scene_import_unsupported(ply->import, "element \"%s\" (PLY): not drawn",
                                     scene_word_string(ply->import, element->name));
        }
        for (ply->row = 0; ply->row < element->count; ply->row++) {
            for (int i = 0; i < element->property_count; i++) {
                scene_ply_skip(ply, &element->properties[i]);
            }
        }
    }
}

// Where the data is read.
struct place {
    const unsigned char *cursor;
    struct scene_text text;
    struct scene_line line;
};

static struct place place_of(const struct ply *ply)
{
    return (struct place){ply->cursor, ply->text, ply->line};
}

static void go_to(struct ply *ply, const struct place *place)
{
    ply->cursor = place->cursor;
    ply->text = place->text;
    ply->line = place->line;
}

static void skip_element(struct ply *ply, const struct element *element)
{
    ply->element = element;
    check_size(ply, element);
    for (ply->row = 0; ply->row < element->count && element->property_count > 0; ply->row++) {
        for (int i = 0; i < element->property_count; i++) {
            scene_ply_skip(ply, &element->properties[i]);
        }
    }
}

// Read all elements, the vertices first, which faces refer to. Elements may stand in any order.
static void read_elements(struct ply *ply)
{
    int vertices = 0;
    while (vertices < ply->element_count && !scene_word_is(ply->elements[vertices].name, "vertex")) {
        vertices++;
    }
    if (vertices == ply->element_count) {
        scene_import_fail(ply->import, "has no vertices");
    }
    const struct place start = place_of(ply);
    for (int i = 0; i < vertices; i++) {
        skip_element(ply, &ply->elements[i]);
    }
    read_element(ply, &ply->elements[vertices]);
    const struct place behind = place_of(ply);
    go_to(ply, &start);
    for (int i = 0; i < vertices; i++) {
        read_element(ply, &ply->elements[i]);
    }
    go_to(ply, &behind);
    for (int i = vertices + 1; i < ply->element_count; i++) {
        read_element(ply, &ply->elements[i]);
    }
}

// Look at all faces for what stands in their rows. Two elements may have faces.
static void find_rows(struct ply *ply)
{
    bool numbered = false;
    for (int i = 0; i < ply->element_count; i++) {
        const struct element *element = &ply->elements[i];
        struct ply_colors found = {.present = false};
        if (!scene_word_is(element->name, "face") && !scene_word_is(element->name, "tristrips")) {
            continue;
        }
        scene_ply_find_colors(element, &found);
        const enum type alpha = ply->face_colors.alpha_type;
        if (found.present) {
            found.alpha_type = found.alpha_type == TYPE_NONE ? alpha : found.alpha_type;
            ply->face_colors = found;
        }
        for (int k = 0; k < element->property_count; k++) {
            numbered = numbered || scene_word_is(element->properties[k].name, "texnumber");
            if (!scene_ply_reads_of_face(&element->properties[k])) {
                scene_ply_tell_of_property(ply, element->properties[k].name);
            }
        }
    }
    if (ply->texture_count > 1 && !numbered) {
        scene_import_unsupported(ply->import,
                                 "textures after the first (PLY): no face has the number of one");
        ply->texture_count = 1;
    }
    ply->has_rows = ply->face_colors.present || ply->texture_count > 1;
}

// Meshes --------------------------------------------------------------------------------------------

// Return the name of a texture's file in the bytes of the model's. MeshLab writes <this> in it for the name of the
// model without its ending.
static const char *texture_file(struct ply *ply, struct scene_word name)
{
    static const char mark[] = "<this>";
    const char *const text = scene_word_bytes(ply->import, name), *const path = ply->import->model.path;
    const char *const place = strstr(text, mark);
    if (place == NULL) {
        return text;
    }
    const char *const slash = strrchr(path, '/'), *const file = slash == NULL ? path : slash + 1;
    const char *const dot = strrchr(file, '.'), *const rest = place + strlen(mark);
    const size_t stem = dot == NULL ? strlen(file) : (size_t)(dot - file), before = (size_t)(place - text);
    char *const whole = scene_import_allocate(ply->import, before + stem + strlen(rest) + 1, 1);
    memcpy(whole, text, before);
    memcpy(whole + before, file, stem);
    memcpy(whole + before + stem, rest, strlen(rest));
    return whole;
}

// Add a material with the texture of this number, if there is one, for a mesh whose attributes are complete.
static uint32_t add_material(struct ply *ply, const struct scene_mesh *mesh, int texture, bool translucent)
{
    struct scene_phong phong = scene_phong_default();
    phong.colored = mesh->colors != NULL;
    if (texture >= 0 && texture < ply->texture_count && mesh->uvs[0] != NULL) {
        const char *const file = texture_file(ply, ply->textures[texture]);
        phong.color.name = scene_import_string(ply->import, file, strlen(file));
        scene_import_find_image(ply->import, NULL, file, &phong.color.source);
    }
    const uint32_t material = scene_phong_add(ply->import, &phong);
    if (translucent) {
        ply->import->model.materials[material].alpha_mode = SCENE_ALPHA_BLEND;
    }
    return material;
}

static void add_mesh(struct ply *ply, const struct scene_mesh *mesh, bool join, uint32_t *polygons)
{
    *scene_import_add_mesh(ply->import) = *mesh;
    scene_import_place_mesh(ply->import, ply->origin);
    struct scene_instance *instance = scene_import_add_instance(ply->import);
    instance->mesh = ply->import->model.mesh_count - 1;
    instance->object = instance->mesh + 1;
    scene_import_identity(instance->world);
    scene_import_complete_polygons(ply->import, instance->mesh, SCENE_IMPORT_SMOOTH, join, polygons);
}

// The vertices that are copied: those of some corners, or the first ones where `corners` is NULL.
struct chosen {
    const uint32_t *corners;
    uint32_t count;
};

static void *copy_array(struct ply *ply, const void *array, size_t size, struct chosen chosen)
{
    if (array == NULL) {
        return NULL;
    }
    char *const copy = scene_import_allocate_any(ply->import, chosen.count, size);
    for (uint32_t i = 0; i < chosen.count; i++) {
        const size_t from = chosen.corners == NULL ? i : chosen.corners[i];
        memcpy(copy + i * size, (const char *)array + from * size, size);
    }
    return copy;
}

// Return a mesh with copies of vertices and without indices.
static struct scene_mesh copy_vertices(struct ply *ply, struct chosen chosen)
{
    const struct scene_mesh *mesh = &ply->mesh;
    return (struct scene_mesh){
        .name = "",
        .vertex_count = chosen.count,
        .positions = copy_array(ply, mesh->positions, sizeof *mesh->positions, chosen),
        .exact = copy_array(ply, mesh->exact, sizeof *mesh->exact, chosen),
        .normals = copy_array(ply, mesh->normals, sizeof *mesh->normals, chosen),
        .uvs = {copy_array(ply, mesh->uvs[0], sizeof *mesh->uvs[0], chosen)},
        .colors = copy_array(ply, mesh->colors, sizeof *mesh->colors, chosen),
    };
}

static void add_lines(struct ply *ply)
{
    struct scene_mesh lines = copy_vertices(ply, (struct chosen){NULL, ply->mesh.vertex_count});
    if (ply->edge_count > UINT32_MAX) {
        scene_import_fail(ply->import, "has too many edges");
    }
    lines.primitive = SCENE_PRIMITIVE_LINES;
    lines.indices = ply->edges;
    lines.index_count = (uint32_t)ply->edge_count;
    bool translucent = ply->translucent;
    if (ply->edge_colors.present) {
        translucent = scene_ply_decode_colors(&ply->edge_colors);
        scene_import_color_primitives(ply->import, &lines, (const float(*)[4])ply->edge_colors.rows, NULL);
    }
    lines.material = add_material(ply, &lines, -1, translucent);
    add_mesh(ply, &lines, false, NULL);
}

// Give each corner its own vertex, because texture coordinates belong to it.
static void place_wedges(struct ply *ply)
{
    struct scene_mesh *mesh = &ply->mesh;
    scene_import_gather_vertices(ply->import, mesh, mesh->indices, mesh->index_count);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = i;
    }
    mesh->uvs[0] = ply->wedges;
}

static void color_faces(struct ply *ply)
{
    struct scene_mesh *mesh = &ply->mesh;
    if (mesh->colors != NULL) {
        scene_import_unsupported(ply->import,
                                 "colours of faces (PLY): not drawn, as its vertices have colours");
        return;
    }
    ply->translucent = scene_ply_decode_colors(&ply->face_colors);
    scene_import_color_primitives(ply->import, mesh, (const float(*)[4])ply->face_colors.rows, ply->rows);
}

// Return true if the texture of a triangle has this number, or if the triangle has no texture and it is −1.
static bool has_texture(const struct ply *ply, uint32_t triangle, int texture)
{
    return ply->face_textures[ply->rows[triangle]] == texture;
}

// Add the triangles whose texture has this number, or has none if it is −1. With `join`, corners have vertices of their
// own, and only those of the triangles are copied.
static void add_textured(struct ply *ply, int texture, bool join)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < ply->mesh.index_count; i += 3) {
        count += has_texture(ply, i / 3, texture) ? 3 : 0;
    }
    if (count == 0) {
        return;
    }
    uint32_t *const indices = scene_import_allocate(ply->import, count, sizeof *indices), *next = indices;
    uint32_t *const polygons = ply->polygons.of_triangle == NULL
                                   ? NULL
                                   : scene_import_allocate(ply->import, count / 3, sizeof *polygons);
    for (uint32_t i = 0; i < ply->mesh.index_count; i += 3) {
        if (has_texture(ply, i / 3, texture)) {
            if (polygons != NULL) {
                polygons[(next - indices) / 3] = ply->polygons.of_triangle[i / 3];
            }
            memcpy(next, ply->mesh.indices + i, 3 * sizeof *next);
            next += 3;
        }
    }
    const struct chosen corners = {indices, count}, all = {NULL, ply->mesh.vertex_count};
    struct scene_mesh part = copy_vertices(ply, join ? corners : all);
    for (uint32_t i = 0; i < count && join; i++) {
        indices[i] = i;
    }
    part.indices = indices;
    part.index_count = count;
    part.material = add_material(ply, &part, texture, ply->translucent);
    add_mesh(ply, &part, join, polygons);
    free(polygons);
}

static void add_triangles(struct ply *ply)
{
    struct scene_mesh *mesh = &ply->mesh;
    // A copy of all vertices for each texture would be much where there are many.
    const bool join = ply->wedges != NULL || ply->face_colors.present || ply->texture_count > MOST_COPIES;
    mesh->primitive = SCENE_PRIMITIVE_TRIANGLES;
    mesh->index_count = (uint32_t)ply->index_count;
    if (ply->wedges != NULL) {
        place_wedges(ply);
    }
    if (ply->face_colors.present) {
        color_faces(ply);
    }
    if (ply->texture_count <= 1) {
        mesh->material = add_material(ply, mesh, 0, ply->translucent);
        add_mesh(ply, mesh, join, ply->polygons.of_triangle);
        return;
    }
    for (int texture = -1; texture < ply->texture_count; texture++) {
        add_textured(ply, texture, join);
    }
}

static void add_points(struct ply *ply)
{
    struct scene_mesh *mesh = &ply->mesh;
    mesh->primitive = SCENE_PRIMITIVE_POINTS;
    mesh->index_count = mesh->vertex_count;
    mesh->indices = scene_import_allocate_any(ply->import, mesh->vertex_count, sizeof *mesh->indices);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        mesh->indices[i] = i;
    }
    const struct scene_import_elements list = scene_import_elements_of(mesh);
    scene_import_check_exact(ply->import, mesh, &list, 1);
    mesh->material = add_material(ply, mesh, 0, ply->translucent);
    add_mesh(ply, mesh, false, NULL);
}

static struct scene_import_elements list_of(const uint32_t *corners, size_t count, uint32_t each)
{
    return (struct scene_import_elements){
        .corners = corners, .count = count / each, .stride = sizeof *corners, .each = each};
}

static void add_meshes(struct ply *ply)
{
    const struct scene_import_elements lists[] = {list_of(ply->mesh.indices, ply->index_count, 3),
                                                  list_of(ply->edges, ply->edge_count, 2)};
    if (ply->index_count > 0 || ply->edge_count > 0) {
        scene_import_check_exact(ply->import, &ply->mesh, lists, 2);
    }
    if (ply->edge_count > 0) {
        add_lines(ply);
    }
    if (ply->index_count > 0) {
        add_triangles(ply);
    } else if (ply->edge_count == 0) {
        add_points(ply);
    }
}

// Entry ---------------------------------------------------------------------------------------------

// Refuse clouds of soft ellipsoids. Scans come as such clouds in PLY as well; drawn as points they would be no picture
// of anything.
static void refuse_gaussians(const struct ply *ply)
{
    static const char *const names[] = {"f_dc_0",          "opacity",         "scale_0",      "rot_0",
                                        "packed_position", "packed_rotation", "packed_scale", "packed_color"};
    enum { PLAIN = 0x0f, PACKED = 0xf0 };
    unsigned found = 0;
    for (int i = 0; i < ply->element_count; i++) {
        for (int k = 0; k < ply->elements[i].property_count; k++) {
            for (int n = 0; n < 8; n++) {
                found |= scene_word_is(ply->elements[i].properties[k].name, names[n]) ? 1u << n : 0;
            }
        }
    }
    if ((found & PLAIN) == PLAIN || (found & PACKED) == PACKED) {
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
    scene_ply_read_header(&ply);
    refuse_gaussians(&ply);
    find_rows(&ply);
    ply.cursor = (const unsigned char *)ply.text.cursor;
    ply.line = (struct scene_line){ply.text.cursor, ply.text.cursor};
    read_elements(&ply);
    if (ply.mesh.positions == NULL) {
        scene_import_fail(import, "has no vertices");
    }
    if (ply.vertex_colors.present) {
        ply.translucent = scene_ply_decode_colors(&ply.vertex_colors);
        ply.mesh.colors = ply.vertex_colors.rows;
    }
    if (ply.small_faces > 0) {
        scene_import_warn(import, "%u faces of fewer than three corners are left out", ply.small_faces);
    }
    if (ply.stray_textures > 0) {
        scene_import_unsupported(import, "textures of %u faces (PLY): the file has none of their numbers",
                                 ply.stray_textures);
    }
    // Memory of the file serves the meshes. The names of textures are all that they still need of it.
    for (int i = 0; i < ply.texture_count; i++) {
        ply.textures[i].start = scene_word_bytes(import, ply.textures[i]);
    }
    free(bytes);
    add_meshes(&ply);
}
