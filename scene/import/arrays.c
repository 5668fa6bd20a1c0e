// SPDX-License-Identifier: MIT
// Reads a model from arrays. The child process sees the parent's memory as it was when it was forked, so nothing
// travels to it. The model that it makes of the arrays comes back as every model does.
#include "model_arrays.h"

#include <string.h>

#include "import/builder/complete_mesh.h"
#include "import/builder/import.h"
#include "import/builder/pieces.h"
#include "import/builder/place.h"
#include "reader_process.h"

static void *copy(struct scene_import *import, const void *array, size_t count, size_t size)
{
    if (array == NULL) {
        return NULL;
    }
    void *copied = scene_import_allocate(import, count, size);
    memcpy(copied, array, count * size);
    return copied;
}

static const char *copy_name(struct scene_import *import, const char *name)
{
    return scene_import_string(import, name, strlen(name));
}

static void read_image(struct scene_import *import, const struct scene_array_image *image)
{
    const struct scene_import_source source = {.bytes = image->texels,
                                               .size = (size_t)image->width * image->height *
                                                       sizeof *image->texels,
                                               .raw_width = image->width,
                                               .raw_height = image->height,
                                               .opacity_image = -1};
    scene_import_add_image(import, copy_name(import, image->name), &source);
}

static void read_material(struct scene_import *import, const struct scene_array_material *from)
{
    struct scene_material *material = scene_import_add_material(import);
    material->name = copy_name(import, from->name);
    memcpy(material->base_color, from->base_color, sizeof material->base_color);
    memcpy(material->emissive, from->emissive, sizeof material->emissive);
    material->metallic = from->metallic;
    material->roughness = from->roughness;
    material->alpha_mode = from->alpha_mode;
    material->alpha_cutoff = from->alpha_cutoff;
    material->unlit = from->unlit;
    material->double_sided = from->double_sided;
    if (from->image >= (int32_t)import->arrays->image_count) {
        scene_import_fail(import, "material \"%s\" has image %d of %u", material->name, from->image,
                          import->arrays->image_count);
    }
    material->slots[SCENE_SLOT_BASE_COLOR].image = from->image;
}

static void read_indices(struct scene_import *import, const struct scene_array_mesh *from,
                         struct scene_mesh *mesh)
{
    mesh->index_count = from->indices != NULL ? from->index_count : from->vertex_count;
    mesh->indices = scene_import_allocate(import, mesh->index_count, sizeof *mesh->indices);
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = from->indices != NULL ? from->indices[i] : i;
        if (mesh->indices[i] >= mesh->vertex_count) {
            scene_import_fail(import, "mesh \"%s\" has index %u of %u vertices", mesh->name, mesh->indices[i],
                              mesh->vertex_count);
        }
    }
}

static void read_mesh(struct scene_import *import, const struct scene_array_mesh *from)
{
    struct scene_mesh *mesh = scene_import_add_mesh(import);
    double origin[3];
    mesh->name = copy_name(import, from->name);
    mesh->primitive = from->primitive;
    mesh->material = from->material;
    mesh->vertex_count = from->vertex_count;
    if (mesh->material >= import->arrays->material_count) {
        scene_import_fail(import, "mesh \"%s\" has material %u of %u", mesh->name, mesh->material,
                          import->arrays->material_count);
    }
    mesh->normals = copy(import, from->normals, mesh->vertex_count, sizeof *from->normals);
    mesh->uvs[0] = copy(import, from->uvs, mesh->vertex_count, sizeof *from->uvs);
    mesh->colors = copy(import, from->colors, mesh->vertex_count, sizeof *from->colors);
    read_indices(import, from, mesh);
    scene_import_settle_mesh(
        import, mesh, copy(import, from->positions, mesh->vertex_count, sizeof *from->positions), origin);
    scene_import_place_mesh(import, origin);
    scene_import_complete_mesh(import, import->model.mesh_count - 1,
                               from->shading == SCENE_ARRAYS_FLAT ? SCENE_IMPORT_FLAT : SCENE_IMPORT_SMOOTH,
                               false);
}

static void read_instance(struct scene_import *import, const struct scene_array_instance *from)
{
    if (from->mesh >= import->arrays->mesh_count) {
        scene_import_fail(import, "instance \"%s\" has mesh %u of %u", from->name, from->mesh,
                          import->arrays->mesh_count);
    }
    struct scene_instance *instance = scene_import_add_instance(import);
    instance->name = copy_name(import, from->name);
    instance->mesh = from->mesh;
    instance->object = import->model.instance_count;
    struct scene_import_place place;
    for (int i = 0; i < 16; i++) {
        place.exact[i] = from->world[i];
        place.world[i] = (float)from->world[i];
    }
    scene_import_place_instance(import, &place);
}

static void read_arrays(struct scene_import *import)
{
    const struct scene_arrays *arrays = import->arrays;
    import->model.format = "arrays";
    import->model.up = arrays->up;
    for (uint32_t i = 0; i < arrays->image_count; i++) {
        read_image(import, &arrays->images[i]);
    }
    for (uint32_t i = 0; i < arrays->material_count; i++) {
        read_material(import, &arrays->materials[i]);
    }
    for (uint32_t i = 0; i < arrays->mesh_count; i++) {
        read_mesh(import, &arrays->meshes[i]);
    }
    for (uint32_t i = 0; i < arrays->instance_count; i++) {
        read_instance(import, &arrays->instances[i]);
    }
}

struct scene_model *scene_model_make(const struct scene_arrays *arrays,
                                     const struct scene_model_options *options, char *error,
                                     size_t error_size)
{
    const struct scene_import import = {.read = read_arrays, .arrays = arrays, .model.path = arrays->name};
    return scene_import_start(&import, options, error, error_size);
}
