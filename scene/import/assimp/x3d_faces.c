// SPDX-License-Identifier: MIT
// Faces of an X3D. assimp 5.2.5 leaves out quads, gives each point of a set one normal, one colour and one place in a
// texture, whatever their own indices say, and says nothing of creases. So each set is written as an IndexedFaceSet
// that counts all of them as its points, with a point for each corner where the set counts them otherwise. Behind the
// last point stands one more, which no face has: its normal says how smooth the set is. Lines of more than two points
// assimp takes for faces, so they are written in pieces of two.
#include "x3d_faces.h"

#include "import/builder/decimal.h"
#include "import/builder/import.h"
#include "x3d_set.h"

#include <assimp/mesh.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FACES "IndexedFaceSet"
#define LINES "IndexedLineSet"
#define LEFT  "QuadSet" // assimp passes over a set of this name

// The second and third number of the normal behind the last point.
#define MARK_Y "3.25e33"
#define MARK_Z "-1.75e33"

// Text that is written, up to a size.
struct out {
    struct scene_import *import;
    char *text;
    size_t size, capacity, most;
    bool is_full;
};

static void write_bytes(struct out *out, const char *text, size_t length)
{
    out->is_full = out->is_full || length > out->most - out->size;
    if (!out->is_full) {
        scene_import_reserve(out->import, &out->text, &out->capacity, out->size + length + 1, 1);
        memcpy(out->text + out->size, text, length);
        out->size += length;
    }
}

static void write_string(struct out *out, const char *text)
{
    write_bytes(out, text, strlen(text));
}

static void write_number(struct out *out, size_t number)
{
    char text[24];
    snprintf(text, sizeof text, "%zu ", number);
    write_string(out, text);
}

// Write the numbers of one corner or point, zeros where the list has none.
static void write_tuple(struct out *out, const struct scene_x3d_part *part, size_t width, size_t tuple)
{
    const bool is_there = part->property != NULL && tuple < part->numbers.count / width;
    for (size_t i = 0; i < width; i++) {
        const struct scene_collada_value number =
            is_there ? part->numbers.list[tuple * width + i] : (struct scene_collada_value){NULL, 0};
        if (is_there) {
            write_bytes(out, number.text, number.length);
        }
        write_string(out, is_there ? " " : "0 ");
    }
}

// Write what all points of a set have of one property, without that behind the last one.
static void write_tuples(struct out *out, const struct scene_x3d_set *set, enum scene_x3d_purpose purpose,
                         size_t width)
{
    const struct scene_x3d_part *const part = &set->parts[purpose];
    const size_t points = set->parts[SCENE_X3D_POINTS].numbers.count / 3;
    for (size_t i = 0; i < points && !set->is_parted && !out->is_full; i++) {
        write_tuple(out, part, width, i);
    }
    size_t face = 0;
    for (size_t i = 0; i < set->corners.count && set->is_parted && !out->is_full; i++) {
        const size_t corner = set->corners.list[i];
        if (corner == SIZE_MAX) {
            face++;
        } else {
            write_tuple(out, part, width, scene_x3d_tuple_of(set, part, corner, set->corners.faces[face]));
        }
    }
}

// Return the first number of the normal behind the last point: the crease angle in radians, −1 where the set has
// normals, −2 where it is open, and −3 where faces are smooth as far as they share points.
static double crease_of(const struct scene_x3d_set *set)
{
    double angle = 0;
    const struct scene_x3d_part *const normals = &set->parts[SCENE_X3D_NORMALS];
    if (normals->property != NULL && normals->numbers.count >= 3) {
        return -1;
    }
    if (normals->is_of_faces) {
        return 0;
    }
    if (!set->kind->has_crease_angle) {
        const bool shares_points = set->kind->index != NULL || set->kind->counts != NULL;
        return set->kind->make != NULL ? -2 : !shares_points ? 0 : set->is_parted ? -2 : -3;
    }
    const struct scene_collada_value value = scene_collada_attribute(set->tag, set->close, "creaseAngle");
    const char *const end = value.text + value.length;
    return value.text != NULL && scene_decimal_read(value.text, end, &angle) != NULL && angle > 0 ? angle : 0;
}

static void write_property(struct out *out, const struct scene_x3d_set *set, enum scene_x3d_purpose purpose)
{
    const struct scene_x3d_part *const part = &set->parts[purpose];
    const struct scene_x3d_property *const property =
        part->property != NULL ? part->property : scene_x3d_find_property("<Normal>");
    char mark[64];
    write_string(out, "<");
    write_string(out, property->written);
    write_string(out, " ");
    write_string(out, property->list);
    write_string(out, "='");
    write_tuples(out, set, purpose, property->width);
    if (purpose == SCENE_X3D_NORMALS) {
        snprintf(mark, sizeof mark, "%.9g " MARK_Y " " MARK_Z, crease_of(set));
        write_string(out, mark);
    } else {
        write_tuple(out, part, property->width, 0);
    }
    write_string(out, part->tag == NULL || part->close[-1] == '/' ? "'/>" : "'>");
}

static void write_start(struct out *out, const struct scene_x3d_set *set)
{
    const struct scene_collada_value name = scene_collada_attribute(set->tag, set->close, "DEF");
    size_t written = 0;
    write_string(out, scene_x3d_is_lines(set->kind) ? "<" LINES : "<" FACES);
    if (name.text != NULL) {
        write_string(out, " DEF=");
        write_bytes(out, name.text - 1, name.length + 2);
    }
    write_string(out, " coordIndex='");
    for (size_t i = 0; i < set->corners.count && !out->is_full; i++) {
        const size_t corner = set->corners.list[i];
        if (corner == SIZE_MAX) {
            write_string(out, "-1 ");
        } else {
            write_number(out, set->is_parted ? written++ : scene_x3d_index_at(&set->index, corner));
        }
    }
    write_string(out, "'>");
    for (int i = 0; i < SCENE_X3D_PURPOSES; i++) {
        const struct scene_x3d_part *const part = &set->parts[i];
        const bool is_made = i == SCENE_X3D_NORMALS ? !scene_x3d_is_lines(set->kind) : part->property != NULL;
        if (part->tag == NULL && is_made) {
            write_property(out, set, (enum scene_x3d_purpose)i);
        }
    }
    if (set->close[-1] == '/') {
        write_string(out, "</" FACES ">");
    }
}

// Write the tag of a part that is not used, and its end, as those of a node that assimp passes over.
static void leave_out_part(struct scene_import *import, struct scene_edits *edits, const char *text,
                           const struct scene_x3d_set *set, const struct scene_x3d_part *part,
                           const char *end)
{
    const size_t length = strlen(part->property->name);
    scene_edits_add_string(import, edits, (size_t)(part->tag + 1 - text), length, LEFT);
    char *close = part->close, *tag = close[-1] == '/' ? NULL : strchr(close, '<');
    while (tag != NULL && !scene_collada_is_end(tag, part->property->name)) {
        close = scene_collada_is_end(tag, set->kind->name) ? NULL : scene_collada_markup_end(tag, end);
        tag = close == NULL ? NULL : strchr(close, '<');
    }
    if (tag != NULL) {
        scene_edits_add_string(import, edits, (size_t)(tag + 2 - text), length, LEFT);
    }
}

// A normal that is lacking is made, and its tag says how.
static bool is_left(const struct scene_x3d_part *part)
{
    return part->is_lacking && part->property->purpose != SCENE_X3D_NORMALS;
}

// Return how many bytes of sets are still written. Solids, of which a file may have thousands, have more.
static size_t room_for(const struct scene_x3d_faces *faces, const struct scene_x3d_kind *kind)
{
    const size_t largest = faces->room->largest + (kind->is_solid ? (size_t)1 << 25 : 0);
    return faces->room->written < largest ? largest - faces->room->written : 0;
}

// Write a set and what belongs to its corners. Return false if all would become too large.
static bool write_set(struct scene_import *import, struct scene_edits *edits, struct scene_x3d_faces *faces,
                      const char *text, const struct scene_x3d_set *set, const char *end)
{
    struct out outs[1 + SCENE_X3D_PURPOSES] = {{.import = import}};
    size_t room = room_for(faces, set->kind);
    bool is_full = false;
    for (int i = 0; i < 1 + SCENE_X3D_PURPOSES && !is_full; i++) {
        struct out *const out = &outs[i];
        *out = (struct out){.import = import, .most = room};
        if (i == 0) {
            write_start(out, set);
        } else if (set->parts[i - 1].tag != NULL && !is_left(&set->parts[i - 1])) {
            write_property(out, set, (enum scene_x3d_purpose)(i - 1));
        }
        is_full = out->is_full;
        room -= out->size;
    }
    for (int i = 0; i < 1 + SCENE_X3D_PURPOSES; i++) {
        const char *const tag = i == 0 ? set->tag : set->parts[i - 1].tag;
        const char *const close = i == 0 ? set->close : set->parts[i - 1].close;
        if (is_full) {
            free(outs[i].text);
        } else if (outs[i].text != NULL) {
            faces->room->written += outs[i].size;
            scene_edits_add(import, edits,
                            (struct scene_edit){(size_t)(tag - text), (size_t)(close - tag) + 1, outs[i].text,
                                                outs[i].size});
        } else if (i > 0 && is_left(&set->parts[i - 1])) {
            leave_out_part(import, edits, text, set, &set->parts[i - 1], end);
        }
    }
    return !is_full;
}

// Tell of a set that is not drawn, and write it as one that assimp passes over.
static const char *leave_out(struct scene_import *import, struct scene_edits *edits,
                             struct scene_x3d_faces *faces, size_t at, const struct scene_x3d_set *set)
{
    const struct scene_collada_value name = scene_collada_attribute(set->tag, set->close, "DEF");
    scene_x3d_add_name(import, &faces->sets, (struct scene_x3d_name){.name = name, .size = 0});
    scene_edits_add_string(import, edits, at, strlen(set->kind->name), LEFT);
    return LEFT;
}

// Write the tag of a set that is used again.
static const char *write_use(struct scene_import *import, struct scene_edits *edits,
                             const struct scene_x3d_faces *faces, size_t at, const struct scene_x3d_set *set,
                             struct scene_collada_value use)
{
    const struct scene_x3d_name *const used = scene_x3d_find_name(&faces->sets, use);
    if (used == NULL && scene_x3d_is_quads(set->kind)) {
        scene_import_unsupported(import, "quads: not drawn");
    }
    if (used == NULL) {
        return NULL;
    }
    const char *const written = used->size == 0 ? LEFT : scene_x3d_is_lines(set->kind) ? LINES : FACES;
    scene_edits_add_string(import, edits, at, strlen(set->kind->name), written);
    return written;
}

// Write the first tag of a set. Return what its end is called then, or NULL if it keeps its name.
static const char *write_first(struct scene_import *import, struct scene_edits *edits,
                               struct scene_x3d_faces *faces, const char *text, struct scene_x3d_set *set,
                               const char *end)
{
    const size_t at = (size_t)(set->tag + 1 - text);
    const struct scene_collada_value use = scene_collada_attribute(set->tag, set->close, "USE");
    if (use.text != NULL) {
        return write_use(import, edits, faces, at, set, use);
    }
    const char *const set_end = scene_x3d_find_parts(&faces->lists, text, set, end);
    const bool is_room = room_for(faces, set->kind) > 0 && faces->room->read < faces->room->most_read &&
                         (faces->room->full & scene_x3d_kind_bit(set->kind)) == 0;
    const enum scene_x3d_found found =
        set_end == NULL || !is_room ? SCENE_X3D_NOTHING : scene_x3d_read_set(import, set);
    for (int i = 0; i < SCENE_X3D_PURPOSES; i++) {
        faces->room->read += set->parts[i].list.length;
    }
    if (found == SCENE_X3D_FACES && write_set(import, edits, faces, text, set, end)) {
        const struct scene_collada_value name = scene_collada_attribute(set->tag, set->close, "DEF");
        faces->end = (size_t)(set_end - text);
        scene_x3d_add_name(import, &faces->sets, (struct scene_x3d_name){.name = name, .size = 1});
        return scene_x3d_is_lines(set->kind) ? LINES : FACES;
    }
    const bool is_full = found == SCENE_X3D_FACES || (set_end != NULL && !is_room);
    if (is_full && set->kind->make != NULL) {
        faces->room->full |= scene_x3d_kind_bit(set->kind);
    }
    if (set->kind->is_solid && is_full) {
        scene_import_unsupported(import, "solids, rectangles and disks after very many (X3D): textures drawn "
                                         "otherwise, cones upside down, disks with ten corners");
        return NULL;
    }
    if (scene_x3d_is_quads(set->kind)) {
        scene_import_unsupported(import, "quads: not drawn");
    } else if (set->kind->make != NULL) {
        scene_import_unsupported(import, "%s",
                                 is_full ? "grids and extrusions after very large ones (X3D): not drawn"
                                         : set->kind->told);
    } else if (found == SCENE_X3D_FACES || (!is_room && set->parts[SCENE_X3D_POINTS].list.text != NULL)) {
        scene_import_unsupported(import, "sets of points that many use (X3D): not all drawn");
    } else if (set->parts[SCENE_X3D_POINTS].property != NULL &&
               set->parts[SCENE_X3D_POINTS].list.text == NULL) {
        scene_import_unsupported(import, "sets of points that are not there (X3D): not drawn");
    } else if (set->kind->index != NULL && set->parts[SCENE_X3D_POINTS].property != NULL &&
               scene_collada_attribute(set->tag, set->close, set->kind->index).text == NULL) {
        scene_import_unsupported(import, "sets of faces or lines without indices (X3D): not drawn");
    }
    return leave_out(import, edits, faces, at, set);
}

// Keep the list of a property by its name. Write one that is used again in full, as that of a set that was written is
// no longer there by its name.
static void write_list(struct scene_import *import, struct scene_edits *edits, struct scene_x3d_faces *faces,
                       const char *text, char *tag, char *close, const struct scene_x3d_property *property)
{
    const struct scene_collada_value name = scene_collada_attribute(tag, close, "DEF");
    const struct scene_collada_value use = scene_collada_attribute(tag, close, "USE");
    const struct scene_collada_value list = scene_x3d_list_of(&faces->lists, text, tag, close, property);
    if (list.text == NULL) {
        return;
    }
    if (name.text != NULL) {
        scene_x3d_add_name(import, &faces->lists,
                           (struct scene_x3d_name){name, (size_t)(list.text - text), list.length});
    }
    const size_t room =
        faces->room->written < faces->room->largest ? faces->room->largest - faces->room->written : 0;
    if (use.text != NULL && (size_t)(tag - text) > faces->end && list.length <= room) {
        struct out out = {.import = import, .most = SIZE_MAX};
        write_string(&out, property->list);
        write_string(&out, "='");
        write_bytes(&out, list.text, list.length);
        write_string(&out, "'");
        const char *const first = scene_collada_name_end(use) - strlen("USE");
        scene_edits_add(import, edits,
                        (struct scene_edit){(size_t)(first - text),
                                            (size_t)(use.text + use.length + 1 - first), out.text, out.size});
        faces->room->written += out.size;
    }
}

// Return true if the shape that begins at `shape` has a texture.
static bool has_texture(const char *shape)
{
    for (const char *tag = strchr(shape + 1, '<');
         tag != NULL && !scene_collada_is_tag(tag + (tag[1] == '/'), "Shape"); tag = strchr(tag + 1, '<')) {
        if (scene_collada_is_tag(tag, "ImageTexture")) {
            return true;
        }
    }
    return false;
}

bool scene_assimp_write_faces(struct scene_import *import, struct scene_edits *edits,
                              struct scene_x3d_faces *faces, const char *text, char *tag, char *close,
                              const char *end)
{
    const bool is_end = tag[1] == '/';
    const struct scene_x3d_property *const property = is_end ? NULL : scene_x3d_find_property(tag);
    const struct scene_x3d_kind *const kind = scene_x3d_find_kind(tag + is_end);
    if (property != NULL) {
        write_list(import, edits, faces, text, tag, close, property);
    }
    if (scene_collada_is_tag(tag, "Shape")) {
        faces->is_textured = has_texture(tag);
    }
    if (kind == NULL || (kind->is_for_textures && !faces->is_textured)) {
        return property != NULL;
    }
    if (is_end) {
        if (faces->open > 0 && --faces->open == 0 && faces->end_name != NULL) {
            scene_edits_add_string(import, edits, (size_t)(tag + 2 - text), strlen(kind->name),
                                   faces->end_name);
        }
        return true;
    }
    struct scene_x3d_set set = {
        .kind = kind, .tag = tag, .close = close, .made = {.is_textured = faces->is_textured}};
    const char *const end_name = faces->open == 0 ? write_first(import, edits, faces, text, &set, end) : NULL;
    if (close[-1] != '/' && faces->open++ == 0) {
        faces->end_name = end_name;
    }
    scene_x3d_free_set(&set);
    return true;
}

bool scene_x3d_normals_of(const struct aiMesh *mesh, enum scene_x3d_normals *normals, double *cosine)
{
    if (mesh->mNormals == NULL || mesh->mNumVertices == 0) {
        return false;
    }
    const struct aiVector3D *const mark = &mesh->mNormals[mesh->mNumVertices - 1];
    const float y = strtof(MARK_Y, NULL), z = strtof(MARK_Z, NULL);
    if (memcmp(&mark->y, &y, sizeof y) != 0 || memcmp(&mark->z, &z, sizeof z) != 0) {
        return false;
    }
    const double angle = (double)mark->x;
    *normals = angle >= 0     ? SCENE_X3D_CREASED
               : angle > -1.5 ? SCENE_X3D_GIVEN
               : angle > -2.5 ? SCENE_X3D_OPEN
                              : SCENE_X3D_SHARED;
    *cosine = *normals == SCENE_X3D_SHARED ? -1 : scene_x3d_crease_cosine(angle);
    return true;
}

void scene_x3d_free_faces(struct scene_x3d_faces *faces)
{
    scene_x3d_free_names(&faces->lists);
    scene_x3d_free_names(&faces->sets);
}
