// SPDX-License-Identifier: MIT
// The build of a 3MF: its objects become meshes, one for each material, and get their places.
#include <stdlib.h>
#include <string.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/normals.h"
#include "import/builder/origin.h"
#include "import/builder/place.h"
#include "threemf.h"

enum { DEEPEST = 64, MOST_INSTANCES = 1 << 20 };

// The triangles of an object that share a material. Every corner is a vertex of its own.
struct patch {
    uint32_t material;
    float (*positions)[3], (*colors)[4], (*uvs)[2];
    size_t count, capacity, color_capacity, uv_capacity;
};

struct patches {
    struct patch *items;
    size_t count, capacity;
};

static struct patch *find_patch(struct scene_import *import, struct patches *patches, uint32_t material)
{
    for (size_t i = patches->count; i > 0; i--) {
        if (patches->items[i - 1].material == material) {
            return &patches->items[i - 1];
        }
    }
    scene_import_reserve(import, &patches->items, &patches->capacity, patches->count + 1,
                         sizeof *patches->items);
    patches->items[patches->count] = (struct patch){.material = material};
    return &patches->items[patches->count++];
}

static void add_triangle(struct scene_3mf *file, const struct scene_3mf_object *object,
                         struct patches *patches, const struct scene_3mf_triangle *triangle)
{
    struct scene_import *import = file->import;
    const uint32_t pid = triangle->pid != 0 ? triangle->pid : object->pid;
    const struct scene_3mf_group *group = pid == 0 ? NULL : scene_3mf_find_group(file, object->part, pid);
    struct scene_3mf_paint paints[3];
    bool blended = false;
    for (int k = 0; k < 3; k++) {
        paints[k] =
            scene_3mf_find_paint(file, group, triangle->pid != 0 ? triangle->properties[k] : object->pindex);
        blended = blended || paints[k].color[3] < 1;
    }
    struct patch *patch = find_patch(import, patches, scene_3mf_material(file, &paints[0], blended));
    const size_t first = patch->count;
    scene_import_reserve(import, &patch->positions, &patch->capacity, first + 3, sizeof *patch->positions);
    scene_import_reserve(import, &patch->colors, &patch->color_capacity, first + 3, sizeof *patch->colors);
    scene_import_reserve(import, &patch->uvs, &patch->uv_capacity, first + 3, sizeof *patch->uvs);
    for (int k = 0; k < 3; k++) {
        memcpy(patch->positions[patch->count], object->positions[triangle->vertices[k]],
               sizeof *patch->positions);
        memcpy(patch->colors[patch->count], paints[k].color, sizeof *patch->colors);
        memcpy(patch->uvs[patch->count++], paints[k].uv, sizeof *patch->uvs);
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
    scene_import_place_mesh(import, object->origin);
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

static void add_beams(struct scene_3mf *file, const struct scene_3mf_object *object)
{
    struct scene_import *import = file->import;
    if (object->beam_count > UINT32_MAX) {
        scene_import_fail(import, "has too many beams");
    }
    const struct scene_3mf_group *group =
        object->pid == 0 ? NULL : scene_3mf_find_group(file, object->part, object->pid);
    const struct scene_3mf_paint paint = scene_3mf_find_paint(file, group, object->pindex);
    const uint32_t material = scene_3mf_material(file, &paint, paint.color[3] < 1);
    struct scene_mesh *mesh = scene_import_add_mesh(import);
    scene_import_place_mesh(import, object->origin);
    mesh->name = object->name;
    mesh->primitive = SCENE_PRIMITIVE_LINES;
    mesh->material = material;
    mesh->vertex_count = mesh->index_count = (uint32_t)object->beam_count;
    mesh->positions = scene_import_allocate(import, object->beam_count, sizeof *mesh->positions);
    mesh->colors = scene_import_allocate(import, object->beam_count, sizeof *mesh->colors);
    mesh->indices = scene_import_allocate(import, object->beam_count, sizeof *mesh->indices);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = i;
        memcpy(mesh->positions[i], object->positions[object->beams[i]], sizeof mesh->positions[i]);
        memcpy(mesh->colors[i], paint.color, sizeof mesh->colors[i]);
    }
    scene_import_complete_mesh(import, import->model.mesh_count - 1, SCENE_IMPORT_SMOOTH, true);
}

static void make_meshes(struct scene_3mf *file, struct scene_3mf_object *object)
{
    struct patches patches = {0};
    object->made = true;
    object->first_mesh = file->import->model.mesh_count; // meshes of beams come first
    object->positions =
        scene_import_settle(file->import, object->read_positions, object->position_count, object->origin);
    for (size_t i = 0; i < object->triangle_count; i++) {
        add_triangle(file, object, &patches, &object->triangles[i]);
    }
    if (object->beam_count > 0) {
        add_beams(file, object);
    }
    free(object->triangles);
    free(object->beams);
    free(object->positions);
    for (size_t i = 0; i < patches.count; i++) {
        add_mesh(file, object, &patches.items[i]);
    }
    free(patches.items);
    object->mesh_count = file->import->model.mesh_count - object->first_mesh;
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
                  const struct scene_import_place *parent, uint32_t number, int depth)
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
    if (!object->made) {
        make_meshes(file, object);
    }
    const struct scene_import_place world = scene_import_place_multiply(parent, &component->transform);
    for (uint32_t i = 0; i < object->mesh_count; i++) {
        struct scene_instance *instance = scene_import_add_instance(import);
        instance->name = object->name;
        instance->mesh = object->first_mesh + i;
        instance->object = number;
        scene_import_place_instance(import, &world);
    }
    for (size_t i = 0; i < object->component_count; i++) {
        if (++file->placed > MOST_INSTANCES) {
            scene_import_fail(import, "its components stand for more than %d objects", MOST_INSTANCES);
        }
        place(file, &file->components[object->first_component + i], &world, number, depth + 1);
    }
}

void scene_3mf_build(struct scene_3mf *file)
{
    const struct scene_import_place identity = scene_import_place_identity();
    for (size_t i = 0; i < file->item_count; i++) {
        place(file, &file->items[i], &identity, (uint32_t)i + 1, 0);
    }
    if (file->item_count > 0 || file->object_count == 0) {
        return;
    }
    scene_import_warn(file->import, "its build lists nothing: every object is drawn");
    for (size_t i = 0; i < file->object_count; i++) {
        const struct scene_3mf_component item = {file->objects[i].part, file->objects[i].id, identity};
        if (file->objects[i].component_count == 0) {
            place(file, &item, &identity, (uint32_t)i + 1, 0);
        }
    }
}
