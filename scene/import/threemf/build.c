// SPDX-License-Identifier: MIT
// The build of a 3MF: its objects become meshes, one for each material, and get their places.
#include <stdlib.h>
#include <string.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/normals.h"
#include "import/builder/pieces.h"
#include "import/builder/place.h"
#include "threemf.h"

enum { DEEPEST = 64, MOST_INSTANCES = 1 << 20 };

// The triangles of a cluster of an object that share a material. Every corner is a vertex of its own.
struct patch {
    uint32_t material, cluster;
    float (*positions)[3], (*colors)[4], (*uvs)[2];
    size_t count, capacity, color_capacity, uv_capacity;
};

struct patches {
    struct patch *items;
    size_t count, capacity;
    uint32_t cluster; // cluster of the triangle that is being added
};

static struct patch *find_patch(struct scene_import *import, struct patches *patches, uint32_t material)
{
    for (size_t i = patches->count; i > 0; i--) {
        if (patches->items[i - 1].material == material && patches->items[i - 1].cluster == patches->cluster) {
            return &patches->items[i - 1];
        }
    }
    scene_import_reserve(import, &patches->items, &patches->capacity, patches->count + 1,
                         sizeof *patches->items);
    patches->items[patches->count] = (struct patch){.material = material, .cluster = patches->cluster};
    return &patches->items[patches->count++];
}

// Add a triangle whose material is that of `paint`.
static void add_piece(struct scene_3mf *file, struct patches *patches,
                      const struct scene_3mf_corner corners[3], const struct scene_3mf_paint *paint)
{
    struct scene_import *import = file->import;
    bool blended = false;
    for (int k = 0; k < 3; k++) {
        blended = blended || corners[k].color[3] < 1;
    }
    struct patch *patch = find_patch(import, patches, scene_3mf_material(file, paint, blended));
    const size_t first = patch->count;
    scene_import_reserve(import, &patch->positions, &patch->capacity, first + 3, sizeof *patch->positions);
    scene_import_reserve(import, &patch->colors, &patch->color_capacity, first + 3, sizeof *patch->colors);
    scene_import_reserve(import, &patch->uvs, &patch->uv_capacity, first + 3, sizeof *patch->uvs);
    for (int k = 0; k < 3; k++) {
        memcpy(patch->positions[patch->count], corners[k].position, sizeof *patch->positions);
        memcpy(patch->colors[patch->count], corners[k].color, sizeof *patch->colors);
        memcpy(patch->uvs[patch->count++], corners[k].uv, sizeof *patch->uvs);
    }
}

// Add a triangle, cut where a painting cuts the triangles beside it.
static void add_beside(struct scene_3mf *file, struct patches *patches,
                       const struct scene_3mf_corner corners[3], const struct scene_3mf_paint *paint,
                       int depth)
{
    for (int k = 0; k < 3 && depth < DEEPEST; k++) {
        const struct scene_3mf_corner *a = &corners[k], *b = &corners[(k + 1) % 3],
                                      *c = &corners[(k + 2) % 3];
        if (scene_3mf_has_edge(file, a->position, b->position)) {
            const struct scene_3mf_corner middle = scene_3mf_middle(a, b);
            add_beside(file, patches, (const struct scene_3mf_corner[3]){*a, middle, *c}, paint, depth + 1);
            add_beside(file, patches, (const struct scene_3mf_corner[3]){middle, *b, *c}, paint, depth + 1);
            return;
        }
    }
    add_piece(file, patches, corners, paint);
}

// CAD programs export opaque parts with an alpha of 00.
static void show_invisible(struct scene_3mf *file, const struct scene_3mf_object *object,
                           struct scene_3mf_corner *corners, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (corners[i].color[3] > 0) {
            return;
        }
    }
    scene_import_warn(file->import, "object %u has a wholly transparent colour: drawn opaque", object->id);
    for (size_t i = 0; i < count; i++) {
        corners[i].color[3] = 1;
    }
}

// Add a triangle in the pieces that a slicer painted.
static void add_pieces(struct scene_3mf *file, const struct scene_3mf_object *object, struct patches *patches,
                       const struct scene_3mf_paint *paint)
{
    for (size_t i = 0; i < file->pieces.count; i++) {
        struct scene_3mf_piece *piece = &file->pieces.items[i];
        const struct scene_3mf_paint own =
            piece->filament == 0 ? *paint : scene_3mf_filament_paint(file, piece->filament);
        for (int k = 0; k < 3 && piece->filament > 0; k++) {
            memcpy(piece->corners[k].color, own.color, sizeof own.color);
            memcpy(piece->corners[k].uv, own.uv, sizeof own.uv);
        }
        show_invisible(file, object, piece->corners, 3);
        add_beside(file, patches, piece->corners, &own, 0);
    }
}

static uint32_t cluster_of(const struct scene_3mf_object *object, uint32_t vertex)
{
    return object->clusters.of_point == NULL ? 0 : object->clusters.of_point[vertex];
}

static void add_triangle(struct scene_3mf *file, const struct scene_3mf_object *object, uint32_t filament,
                         struct patches *patches, const struct scene_3mf_triangle *triangle)
{
    const uint32_t pid = triangle->pid != 0 ? triangle->pid : object->pid;
    const struct scene_3mf_group *group = pid == 0 ? NULL : scene_3mf_find_group(file, object->part, pid);
    struct scene_3mf_paint paints[3];
    struct scene_3mf_corner corners[3];
    patches->cluster = cluster_of(object, triangle->vertices[0]);
    for (int k = 0; k < 3; k++) {
        paints[k] =
            scene_3mf_find_paint(file, group, triangle->pid != 0 ? triangle->properties[k] : object->pindex);
        if (!paints[k].described) {
            paints[k] = scene_3mf_filament_paint(file, filament);
        }
        memcpy(corners[k].position, object->positions[triangle->vertices[k]], sizeof corners[k].position);
        memcpy(corners[k].color, paints[k].color, sizeof corners[k].color);
        memcpy(corners[k].uv, paints[k].uv, sizeof corners[k].uv);
    }
    if (triangle->painting > 0) {
        if (scene_3mf_cut(file, file->paintings[triangle->painting - 1], corners)) {
            add_pieces(file, object, patches, &paints[0]);
            return;
        }
        scene_import_warn(file->import, "object %u has a triangle whose painting is damaged: left out",
                          object->id);
    }
    show_invisible(file, object, corners, 3);
    add_beside(file, patches, corners, &paints[0], 0);
}

// Find the edges of an object that paintings cut.
static void find_cuts(struct scene_3mf *file, const struct scene_3mf_object *object)
{
    for (size_t i = 0; i < object->triangle_count; i++) {
        const struct scene_3mf_triangle *triangle = &object->triangles[i];
        struct scene_3mf_corner corners[3] = {{.uv = {0}}};
        for (int k = 0; k < 3 && triangle->painting > 0; k++) {
            memcpy(corners[k].position, object->positions[triangle->vertices[k]], sizeof corners[k].position);
        }
        if (triangle->painting > 0) {
            scene_3mf_find_cuts(file, file->paintings[triangle->painting - 1], corners);
        }
    }
}

static void add_mesh(struct scene_3mf *file, const struct scene_3mf_object *object, struct patch *patch)
{
    struct scene_import *import = file->import;
    if (patch->count > UINT32_MAX) {
        scene_import_fail(import, "has too many triangles");
    }
    const struct scene_material *material = &import->model.materials[patch->material];
    struct scene_mesh *mesh = scene_import_add_mesh(import);
    scene_import_place_mesh(import, object->origins[patch->cluster]);
    mesh->name = object->name;
    mesh->material = patch->material;
    mesh->vertex_count = mesh->index_count = (uint32_t)patch->count;
    mesh->positions = patch->positions;
    mesh->colors = patch->colors;
    mesh->uvs[0] = patch->uvs;
    if (material->slots[SCENE_SLOT_BASE_COLOR].image < 0) {
        free(patch->uvs);
        mesh->uvs[0] = NULL;
    }
    mesh->indices = scene_import_allocate(import, patch->count, sizeof *mesh->indices);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = i;
    }
    scene_import_complete_mesh(import, import->model.mesh_count - 1, SCENE_IMPORT_SMOOTH, true);
}

// Add the beams of a cluster.
static void add_beams_of(struct scene_import *import, const struct scene_3mf_object *object, uint32_t cluster,
                         uint32_t material, const float color[4])
{
    size_t count = 0;
    for (size_t i = 0; i < object->beam_count; i++) {
        count += cluster_of(object, object->beams[i / 2 * 2]) == cluster;
    }
    if (count == 0) {
        return;
    }
    struct scene_mesh beams = {.name = object->name,
                               .primitive = SCENE_PRIMITIVE_LINES,
                               .material = material,
                               .positions = scene_import_allocate(import, count, sizeof *beams.positions),
                               .colors = scene_import_allocate(import, count, sizeof *beams.colors),
                               .indices = scene_import_allocate(import, count, sizeof *beams.indices)};
    for (size_t i = 0; i < object->beam_count; i++) {
        if (cluster_of(object, object->beams[i / 2 * 2]) == cluster) {
            const uint32_t end = beams.vertex_count++;
            beams.indices[beams.index_count++] = end;
            memcpy(beams.positions[end], object->positions[object->beams[i]], sizeof *beams.positions);
            memcpy(beams.colors[end], color, sizeof *beams.colors);
        }
    }
    *scene_import_add_mesh(import) = beams;
    scene_import_place_mesh(import, object->origins[cluster]);
    scene_import_complete_mesh(import, import->model.mesh_count - 1, SCENE_IMPORT_SMOOTH, true);
}

static void add_beams(struct scene_3mf *file, const struct scene_3mf_object *object, uint32_t filament)
{
    struct scene_import *import = file->import;
    if (object->beam_count > UINT32_MAX) {
        scene_import_fail(import, "has too many beams");
    }
    const struct scene_3mf_group *group =
        object->pid == 0 ? NULL : scene_3mf_find_group(file, object->part, object->pid);
    struct scene_3mf_paint paint = scene_3mf_find_paint(file, group, object->pindex);
    if (!paint.described) {
        paint = scene_3mf_filament_paint(file, filament);
    }
    struct scene_3mf_corner corner;
    memcpy(corner.color, paint.color, sizeof corner.color);
    show_invisible(file, object, &corner, 1);
    const uint32_t material = scene_3mf_material(file, &paint, corner.color[3] < 1);
    for (uint32_t i = 0; i < object->clusters.count; i++) {
        add_beams_of(import, object, i, material, corner.color);
    }
}

// Return true if an object is the one that the volumes of a setting are of.
static bool is_item_of(const struct scene_3mf_object *object, const struct scene_3mf_setting *setting)
{
    return object->part == 0 && object->id == setting->object;
}

static void add_triangles(struct scene_3mf *file, const struct scene_3mf_object *object,
                          const struct scene_3mf_setting *setting, struct patches *patches)
{
    const bool is_item = is_item_of(object, setting);
    find_cuts(file, object);
    for (size_t i = 0; i < object->triangle_count; i++) {
        const struct scene_3mf_volume *volume =
            is_item ? scene_3mf_find_volume(file, object->id, SCENE_3MF_TRIANGLES, (uint32_t)i) : NULL;
        if (volume != NULL && scene_3mf_leave_out(file, volume->role)) {
            continue;
        }
        const uint32_t filament =
            volume != NULL && volume->filament > 0 ? volume->filament : setting->filament;
        add_triangle(file, object, filament, patches, &object->triangles[i]);
    }
    scene_3mf_clear_edges(file);
}

// Make floats of the positions of an object. Parts of it that are far from each other count from places of their own.
static void settle(struct scene_import *import, struct scene_3mf_object *object)
{
    const struct scene_import_points points = {.exact = (const double(*)[3])object->read_positions,
                                               .count = object->position_count};
    const struct scene_import_elements lists[] = {
        {.corners = object->triangles,
         .count = object->triangle_count,
         .stride = sizeof(uint32_t),
         .step = sizeof *object->triangles,
         .each = 3},
        {.corners = object->beams, .count = object->beam_count / 2, .stride = sizeof(uint32_t), .each = 2}};
    object->clusters = scene_import_clusters_find(import, &points, lists, 2);
    object->origins = scene_import_allocate(import, object->clusters.count, sizeof *object->origins);
    object->positions = scene_import_settle_clusters(import, object->read_positions, object->position_count,
                                                     &object->clusters, object->origins);
    object->read_positions = NULL;
}

// Return the meshes of an object, which are made when it is placed for the first time. Where a slicer says something of
// parts, they are made again for each colour and item.
static struct scene_3mf_shape find_shape(struct scene_3mf *file, struct scene_3mf_object *object,
                                         const struct scene_3mf_setting *setting)
{
    // Parts are those of an item; a component is the same in each.
    struct scene_3mf_setting key = {0};
    if (file->volume_count > 0) {
        key.object = is_item_of(object, setting) ? setting->object : 0;
        key.filament = setting->filament;
    }
    for (size_t i = object->shape_count; i > 0; i--) {
        const struct scene_3mf_shape *shape = &object->shapes[i - 1];
        if (shape->setting.object == key.object && shape->setting.filament == key.filament) {
            return *shape;
        }
    }
    if (object->read_positions != NULL) {
        settle(file->import, object);
    }
    struct patches patches = {0};
    struct scene_3mf_shape shape = {key, file->import->model.mesh_count, 0}; // meshes of beams come first
    add_triangles(file, object, setting, &patches);
    if (object->beam_count > 0) {
        add_beams(file, object, setting->filament);
    }
    if (file->volume_count == 0) {
        free(object->triangles);
        free(object->beams);
        free(object->positions);
    }
    for (size_t i = 0; i < patches.count; i++) {
        add_mesh(file, object, &patches.items[i]);
    }
    free(patches.items);
    shape.mesh_count = file->import->model.mesh_count - shape.first_mesh;
    scene_import_reserve(file->import, &object->shapes, &object->shape_capacity, object->shape_count + 1,
                         sizeof *object->shapes);
    object->shapes[object->shape_count++] = shape;
    return shape;
}

// Places --------------------------------------------------------------------------------------------

static struct scene_3mf_object *find_object(const struct scene_3mf *file, uint32_t part, uint32_t id)
{
    size_t low = 0, high = file->object_count;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        const struct scene_3mf_object *object = &file->objects[middle];
        if (object->part < part || (object->part == part && object->id < id)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    struct scene_3mf_object *object = &file->objects[low];
    return low < file->object_count && object->part == part && object->id == id ? object : NULL;
}

static void place(struct scene_3mf *file, const struct scene_3mf_component *component,
                  const struct scene_import_place *parent, struct scene_3mf_setting setting, uint32_t number,
                  int depth)
{
    struct scene_import *import = file->import;
    struct scene_3mf_object *object = find_object(file, component->part, component->id);
    if (object == NULL) {
        scene_import_warn(import, "object %u, which is to be built, is not there: left out", component->id);
        return;
    }
    if (depth > DEEPEST) {
        scene_import_fail(import, "object %u: its components are nested too deeply or in a circle",
                          component->id);
    }
    const struct scene_3mf_volume *volume =
        scene_3mf_find_volume(file, setting.object, SCENE_3MF_COMPONENT, component->id);
    if (scene_3mf_leave_out(file, volume != NULL && volume->role != SCENE_3MF_PRINTED ? volume->role
                                                                                      : object->role)) {
        return;
    }
    setting.filament = volume != NULL && volume->filament > 0 ? volume->filament : setting.filament;
    const struct scene_3mf_shape shape = find_shape(file, object, &setting);
    const struct scene_import_place world = scene_import_place_multiply(parent, &component->transform);
    for (uint32_t i = 0; i < shape.mesh_count; i++) {
        struct scene_instance *instance = scene_import_add_instance(import);
        instance->name = object->name;
        instance->mesh = shape.first_mesh + i;
        instance->object = number;
        scene_import_place_instance(import, &world);
    }
    for (size_t i = 0; i < object->component_count; i++) {
        if (++file->placed > MOST_INSTANCES) {
            scene_import_fail(import, "its components stand for more than %d objects", MOST_INSTANCES);
        }
        place(file, &file->components[object->first_component + i], &world, setting, number, depth + 1);
    }
}

// Place an object that is not a component of another.
static void place_item(struct scene_3mf *file, const struct scene_3mf_component *item, uint32_t number)
{
    const struct scene_import_place identity = scene_import_place_identity();
    const uint32_t object = item->part == 0 ? item->id : 0;
    const struct scene_3mf_volume *whole = scene_3mf_find_volume(file, object, SCENE_3MF_WHOLE, 0);
    struct scene_3mf_setting setting = {.object = object, .filament = whole != NULL ? whole->filament : 0};
    if (setting.filament == 0 && file->filament_count > 0) {
        setting.filament = 1;
    }
    place(file, item, &identity, setting, number, 0);
}

void scene_3mf_build(struct scene_3mf *file)
{
    for (size_t i = 0; i < file->item_count; i++) {
        place_item(file, &file->items[i], (uint32_t)i + 1);
    }
    if (file->item_count > 0 || file->object_count == 0) {
        return;
    }
    scene_import_warn(file->import, "its build lists nothing: every object is drawn");
    for (size_t i = 0; i < file->object_count; i++) {
        const struct scene_3mf_component item = {file->objects[i].part, file->objects[i].id,
                                                 scene_import_place_identity()};
        if (file->objects[i].component_count == 0) {
            place_item(file, &item, (uint32_t)i + 1);
        }
    }
}
