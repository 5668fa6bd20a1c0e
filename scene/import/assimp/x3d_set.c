// SPDX-License-Identifier: MIT
// The nodes of X3D that have faces or lines, and how each counts what belongs to its corners.
#include "x3d_set.h"

#include "import/builder/import.h"

#include <stdlib.h>
#include <string.h>

static const struct scene_x3d_property properties[] = {
    {"Coordinate", "point", "Coordinate", SCENE_X3D_POINTS, 3},
    {"CoordinateDouble", "point", "Coordinate", SCENE_X3D_POINTS, 3},
    {"Normal", "vector", "Normal", SCENE_X3D_NORMALS, 3},
    {"Color", "color", "Color", SCENE_X3D_COLORS, 3},
    {"ColorRGBA", "color", "ColorRGBA", SCENE_X3D_COLORS, 4},
    {"TextureCoordinate", "point", "TextureCoordinate", SCENE_X3D_PLACES, 2},
};

static const char no_solid[] = "solids, rectangles and disks without faces (X3D): not drawn";

static const struct scene_x3d_kind kinds[] = {
    {"IndexedFaceSet", SCENE_X3D_POLYGONS, "coordIndex", NULL, true, NULL, NULL, false, false},
    {"IndexedTriangleSet", SCENE_X3D_TRIANGLES, "index", NULL, false, NULL, NULL, false, false},
    {"IndexedTriangleFanSet", SCENE_X3D_FANS, "index", NULL, false, NULL, NULL, false, false},
    {"IndexedTriangleStripSet", SCENE_X3D_STRIPS, "index", NULL, false, NULL, NULL, false, false},
    {"IndexedQuadSet", SCENE_X3D_QUADS, "index", NULL, false, NULL, NULL, false, false},
    {"TriangleSet", SCENE_X3D_TRIANGLES, NULL, NULL, false, NULL, NULL, false, false},
    {"TriangleFanSet", SCENE_X3D_FANS, NULL, "fanCount", false, NULL, NULL, false, false},
    {"TriangleStripSet", SCENE_X3D_STRIPS, NULL, "stripCount", false, NULL, NULL, false, false},
    {"QuadSet", SCENE_X3D_QUADS, NULL, NULL, false, NULL, NULL, false, false},
    {"ElevationGrid", SCENE_X3D_POLYGONS, NULL, NULL, true, scene_x3d_make_grid,
     "grids without faces or without all of their heights (X3D): not drawn", false, false},
    {"Extrusion", SCENE_X3D_POLYGONS, NULL, NULL, true, scene_x3d_make_extrusion,
     "extrusions without faces, or with very many (X3D): not drawn", false, false},
    {"Box", SCENE_X3D_POLYGONS, NULL, NULL, false, scene_x3d_make_box, no_solid, true, true},
    {"Sphere", SCENE_X3D_POLYGONS, NULL, NULL, false, scene_x3d_make_sphere, no_solid, true, true},
    {"Cone", SCENE_X3D_POLYGONS, NULL, NULL, false, scene_x3d_make_cone, no_solid, false, true},
    {"Cylinder", SCENE_X3D_POLYGONS, NULL, NULL, false, scene_x3d_make_cylinder, no_solid, true, true},
    {"Rectangle2D", SCENE_X3D_POLYGONS, NULL, NULL, false, scene_x3d_make_rectangle, no_solid, true, true},
    {"Disk2D", SCENE_X3D_POLYGONS, NULL, NULL, false, scene_x3d_make_disk, no_solid, false, true},
    {"IndexedLineSet", SCENE_X3D_LINES, "coordIndex", NULL, false, NULL, NULL, false, false},
    {"LineSet", SCENE_X3D_LINES, NULL, "vertexCount", false, NULL, NULL, false, false},
};

const struct scene_x3d_property *scene_x3d_find_property(const char *tag)
{
    for (size_t i = 0; i < sizeof properties / sizeof properties[0]; i++) {
        if (scene_collada_is_tag(tag, properties[i].name)) {
            return &properties[i];
        }
    }
    return NULL;
}

const struct scene_x3d_kind *scene_x3d_find_kind(const char *tag)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (scene_collada_is_tag(tag, kinds[i].name)) {
            return &kinds[i];
        }
    }
    return NULL;
}

unsigned scene_x3d_kind_bit(const struct scene_x3d_kind *kind)
{
    return 1u << (kind - kinds); // there are fewer than 32
}

bool scene_x3d_is_quads(const struct scene_x3d_kind *kind)
{
    return kind->order == SCENE_X3D_QUADS;
}

bool scene_x3d_is_lines(const struct scene_x3d_kind *kind)
{
    return kind->order == SCENE_X3D_LINES;
}

struct scene_collada_value scene_x3d_list_of(const struct scene_x3d_names *lists, const char *text, char *tag,
                                             char *close, const struct scene_x3d_property *property)
{
    const struct scene_collada_value use = scene_collada_attribute(tag, close, "USE");
    struct scene_collada_value list = scene_collada_attribute(tag, close, property->list);
    if (use.text != NULL) {
        const struct scene_x3d_name *const used = scene_x3d_find_name(lists, use);
        list = used == NULL ? (struct scene_collada_value){NULL, 0}
                            : (struct scene_collada_value){(char *)(uintptr_t)(text + used->at), used->size};
    }
    // One that is used again was looked through when its name was kept.
    for (size_t i = 0; i < list.length && use.text == NULL; i++) {
        if (strchr("'\"<&", list.text[i]) != NULL) {
            return (struct scene_collada_value){NULL, 0};
        }
    }
    return list;
}

// Give a set what it is made of: points, and what else it does not have.
static void add_made(struct scene_import *import, struct scene_x3d_set *set)
{
    static const char *const names[SCENE_X3D_PURPOSES] = {[SCENE_X3D_POINTS] = "<Coordinate>",
                                                          [SCENE_X3D_NORMALS] = "<Normal>",
                                                          [SCENE_X3D_PLACES] = "<TextureCoordinate>"};
    if (!set->kind->make(import, set->tag, set->close, &set->made)) {
        return;
    }
    for (int i = 0; i < SCENE_X3D_PURPOSES; i++) {
        char *const list = set->made.lists[i];
        if (list != NULL && (i == SCENE_X3D_POINTS || set->parts[i].property == NULL)) {
            set->parts[i] = (struct scene_x3d_part){.property = scene_x3d_find_property(names[i]),
                                                    .list = {list, strlen(list)}};
        }
    }
}

// Give a set with a texture coordinates for it, if it has none.
static void add_places(struct scene_import *import, struct scene_x3d_set *set)
{
    struct scene_x3d_part *const part = &set->parts[SCENE_X3D_PLACES];
    if (!set->made.is_textured || part->property != NULL || scene_x3d_is_lines(set->kind)) {
        return;
    }
    char *const list = scene_x3d_make_places(import, &set->parts[SCENE_X3D_POINTS].numbers);
    if (list != NULL) {
        set->made.lists[SCENE_X3D_PLACES] = list;
        *part = (struct scene_x3d_part){.property = scene_x3d_find_property("<TextureCoordinate>"),
                                        .list = {list, strlen(list)}};
        part->numbers = scene_x3d_read_numbers(import, part->list);
    }
}

const char *scene_x3d_find_parts(const struct scene_x3d_names *lists, const char *text,
                                 struct scene_x3d_set *set, const char *end)
{
    const size_t length = strlen(set->kind->name);
    char *close = set->close;
    if (close[-1] == '/') {
        return set->kind->make != NULL ? close : NULL;
    }
    for (char *tag = strchr(close, '<'); tag != NULL; tag = strchr(close, '<')) {
        if (strncmp(tag + 1 + (tag[1] == '/'), set->kind->name, length) == 0) {
            return tag[1] == '/' ? tag : NULL;
        }
        close = scene_collada_markup_end(tag, end);
        if (close == NULL) {
            return NULL;
        }
        const struct scene_x3d_property *const property = scene_x3d_find_property(tag);
        if (property != NULL && set->parts[property->purpose].property == NULL) {
            set->parts[property->purpose] =
                (struct scene_x3d_part){.property = property,
                                        .tag = tag,
                                        .close = close,
                                        .list = scene_x3d_list_of(lists, text, tag, close, property)};
        }
    }
    return NULL;
}

// Return the indices of a set, or those that follow from its numbers of corners, or each number once.
static struct scene_x3d_indices read_index(struct scene_import *import, const struct scene_x3d_set *set,
                                           size_t points)
{
    if (set->kind->index != NULL) {
        return scene_x3d_read_indices(import,
                                      scene_collada_attribute(set->tag, set->close, set->kind->index));
    }
    const struct scene_collada_value counts =
        set->kind->counts == NULL ? (struct scene_collada_value){NULL, 0}
                                  : scene_collada_attribute(set->tag, set->close, set->kind->counts);
    return scene_x3d_count_up(import, counts, points);
}

size_t scene_x3d_tuple_of(const struct scene_x3d_set *set, const struct scene_x3d_part *part, size_t corner,
                          size_t face)
{
    if (part->is_of_faces) {
        return part->index.count == 0 ? face : scene_x3d_index_at(&part->index, face);
    }
    return scene_x3d_index_at(part->index.count == 0 ? &set->index : &part->index, corner);
}

static bool is_lacking(const struct scene_x3d_set *set, const struct scene_x3d_part *part)
{
    const size_t tuples = part->numbers.count / part->property->width;
    bool is_whole = true;
    size_t face = 0;
    for (size_t i = 0; i < set->corners.count && is_whole; i++) {
        const size_t corner = set->corners.list[i];
        face += corner == SIZE_MAX;
        is_whole =
            corner == SIZE_MAX || scene_x3d_tuple_of(set, part, corner, set->corners.faces[face]) < tuples;
    }
    return !is_whole;
}

// Read how a set counts what belongs to its corners.
static void read_ways(struct scene_import *import, struct scene_x3d_set *set)
{
    static const char *const indices[SCENE_X3D_PURPOSES] = {[SCENE_X3D_NORMALS] = "normalIndex",
                                                            [SCENE_X3D_COLORS] = "colorIndex",
                                                            [SCENE_X3D_PLACES] = "texCoordIndex"};
    static const char *const flags[SCENE_X3D_PURPOSES] = {
        [SCENE_X3D_NORMALS] = "normalPerVertex", [SCENE_X3D_COLORS] = "colorPerVertex"};
    const size_t points = set->parts[SCENE_X3D_POINTS].numbers.count / 3;
    // One of many sets that use a list may have few of its points.
    set->is_parted = set->corners.count - set->corners.face_count < points;
    for (int i = SCENE_X3D_NORMALS; i < SCENE_X3D_PURPOSES; i++) {
        struct scene_x3d_part *const part = &set->parts[i];
        part->is_of_faces = flags[i] != NULL && scene_x3d_is_false(set->tag, set->close, flags[i]);
        if (part->property == NULL) {
            continue;
        }
        if (part->tag != NULL && set->kind->index != NULL &&
            (set->kind->order == SCENE_X3D_POLYGONS || scene_x3d_is_lines(set->kind))) {
            part->index =
                scene_x3d_read_indices(import, scene_collada_attribute(set->tag, set->close, indices[i]));
        }
        if (!part->is_of_faces && scene_x3d_same_indices(&part->index, &set->index)) {
            part->index.count = 0;
        }
        part->is_lacking = is_lacking(set, part);
        if (part->is_lacking) {
            part->numbers.count = 0;
            scene_import_unsupported(
                import, "normals, colours and texture coordinates that some corners lack (X3D): not used");
            continue;
        }
        set->is_parted = set->is_parted || part->is_of_faces || part->index.count > 0 ||
                         part->numbers.count / part->property->width != points;
    }
}

// Tell of corners that are too few for a face. A set of quads that has no other is told as a whole.
static void tell_short(struct scene_import *import, const struct scene_x3d_set *set,
                       enum scene_x3d_found found)
{
    const bool is_quads = scene_x3d_is_quads(set->kind);
    if (set->corners.has_short && !(is_quads && found != SCENE_X3D_FACES)) {
        scene_import_unsupported(import, is_quads ? "quads of fewer than four corners (X3D): left out"
                                         : scene_x3d_is_lines(set->kind)
                                             ? "lines of one point (X3D): left out"
                                             : "faces of fewer than three corners (X3D): left out");
    }
}

enum scene_x3d_found scene_x3d_read_set(struct scene_import *import, struct scene_x3d_set *set)
{
    if (set->kind->make != NULL) {
        add_made(import, set);
    }
    if (set->parts[SCENE_X3D_POINTS].list.text == NULL) {
        return SCENE_X3D_NOTHING;
    }
    for (int i = 0; i < SCENE_X3D_PURPOSES; i++) {
        set->parts[i].numbers = scene_x3d_read_numbers(import, set->parts[i].list);
    }
    add_places(import, set);
    const size_t points = set->parts[SCENE_X3D_POINTS].numbers.count / 3;
    const bool is_turned = scene_x3d_is_false(set->tag, set->close, "ccw");
    set->index = set->kind->make != NULL ? set->made.index : read_index(import, set, points);
    const enum scene_x3d_found found =
        scene_x3d_find_corners(import, &set->index, set->kind->order, is_turned, points, &set->corners);
    tell_short(import, set, found);
    if (found == SCENE_X3D_FACES) {
        read_ways(import, set);
    }
    return found;
}

void scene_x3d_free_set(const struct scene_x3d_set *set)
{
    for (int i = 0; i < SCENE_X3D_PURPOSES; i++) {
        free(set->parts[i].numbers.list);
        free(set->parts[i].index.list);
        free(set->made.lists[i]);
    }
    free(set->kind->make != NULL ? set->made.index.list : set->index.list);
    free(set->corners.list);
    free(set->corners.faces);
}
