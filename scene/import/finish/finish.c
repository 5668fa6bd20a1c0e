// SPDX-License-Identifier: MIT
// The end of an import: images are decoded, totals are made, and what cannot be drawn is left out.
#include "finish.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "decode_images.h"
#include "draw/camera/subject.h"
#include "frame.h"
#include "import/builder/bounds.h"
#include "import/builder/normals.h"
#include "import/builder/numbers.h"
#include "import/builder/pieces.h"
#include "locate.h"
#include "model_up.h"
#include "points.h"
#include "start_lamp.h"

static void extend(float least[3], float most[3], const float point[3])
{
    for (int c = 0; c < 3; c++) {
        least[c] = point[c] < least[c] ? point[c] : least[c];
        most[c] = point[c] > most[c] ? point[c] : most[c];
    }
}

static void empty_bounds(float least[3], float most[3])
{
    for (int c = 0; c < 3; c++) {
        least[c] = 3.4028234663852886e38f;
        most[c] = -3.4028234663852886e38f;
    }
}

// Find the bounds of an instance in the world. Return false if a point leaves the range of floats.
static bool bound_instance(const struct scene_mesh *mesh, const float world[16], float least[3],
                           float most[3])
{
    const bool is_moved = !scene_import_is_identity(world);
    empty_bounds(least, most);
    for (uint32_t i = 0; i < mesh->vertex_count && is_moved; i++) {
        float point[3];
        scene_import_transform(world, mesh->positions[i], point);
        extend(least, most, point);
    }
    for (int c = 0; c < 3 && !is_moved; c++) {
        least[c] = mesh->bounds_min[c] + 0.0f; // a matrix makes 0 of −0
        most[c] = mesh->bounds_max[c] + 0.0f;
    }
    const float size[3] = {most[0] - least[0], most[1] - least[1], most[2] - least[2]};
    return scene_import_finite(world, 16) && scene_import_finite(least, 3) && scene_import_finite(most, 3) &&
           scene_import_finite(size, 3);
}

// Return true if an instance of the mesh stands so far from the origin that floats have steps for its size. The size is
// that of the turned mesh, since floats lose it in the bounds of what is very far.
static bool is_remote(const struct scene_instance *instance, const struct scene_mesh *mesh)
{
    double distance = 0, size = 0;
    for (int c = 0; c < 3; c++) {
        double along = 0;
        for (int k = 0; k < 3; k++) {
            const double extent = (double)mesh->bounds_max[k] - (double)mesh->bounds_min[k];
            along += fabs((double)instance->world[4 * k + c]) * extent;
        }
        distance = fmax(distance, fabs(instance->place[c]));
        size = fmax(size, along);
    }
    return size > 0 && distance > SCENE_REMOTE * size;
}

static void keep_drawable_instances(struct scene_import *import)
{
    struct scene_model *model = &import->model;
    double(*const exact)[16] = import->exact_instances.matrices;
    uint32_t kept = 0;
    empty_bounds(model->bounds_min, model->bounds_max);
    model->triangles_drawn = 0;
    model->is_scattered = false;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        struct scene_instance *instance = &model->instances[i];
        const struct scene_mesh *mesh = &model->meshes[instance->mesh];
        float least[3], most[3];
        if (mesh->index_count == 0) {
            continue;
        }
        if (!bound_instance(mesh, instance->world, least, most)) {
            scene_import_warn(import, "node \"%s\" is left out: its place in the world is not finite",
                              instance->name);
            continue;
        }
        extend(model->bounds_min, model->bounds_max, least);
        extend(model->bounds_min, model->bounds_max, most);
        instance->mirrored = scene_import_determinant(instance->world) < 0;
        if (mesh->primitive == SCENE_PRIMITIVE_TRIANGLES) {
            model->triangles_drawn += mesh->index_count / 3;
        }
        model->is_scattered = model->is_scattered || is_remote(instance, mesh);
        memmove(exact[kept], exact[i], sizeof *exact);
        model->instances[kept++] = *instance;
    }
    model->instance_count = kept;
}

static void warn_of_missing_uvs(struct scene_import *import)
{
    for (uint32_t i = 0; i < import->model.mesh_count; i++) {
        const struct scene_mesh *mesh = &import->model.meshes[i];
        const struct scene_material *material = &import->model.materials[mesh->material];
        for (int k = 0; k < SCENE_SLOT_COUNT; k++) {
            if (material->slots[k].image >= 0 && mesh->uvs[material->slots[k].uv_set] == NULL) {
                scene_import_warn(import,
                                  "mesh \"%s\" lacks the texture coordinates its material \"%s\" reads",
                                  mesh->name, material->name);
            }
        }
    }
}

// Warn of a model without area. Its picture would be empty, and nothing would say why.
static void warn_of_no_area(struct scene_import *import)
{
    struct scene_model *model = &import->model;
    bool *is_asked = scene_import_allocate(import, model->mesh_count, sizeof *is_asked);
    bool has_area = model->instance_count == 0;
    for (uint32_t i = 0; i < model->instance_count && !has_area; i++) {
        const uint32_t index = model->instances[i].mesh;
        const struct scene_mesh *mesh = &model->meshes[index];
        has_area =
            !is_asked[index] && (mesh->primitive != SCENE_PRIMITIVE_TRIANGLES || scene_import_has_area(mesh));
        is_asked[index] = true;
    }
    free(is_asked);
    model->lacks_area = !has_area;
    if (model->lacks_area) {
        scene_import_warn(import, "none of its triangles has an area: there is nothing to see");
    }
}

static void warn_of_fans(struct scene_import *import)
{
    if (import->fan_count > 0) {
        scene_import_warn(import, "its polygons take too long to cut: a part of %u of them is a fan",
                          import->fan_count);
    }
}

static void find_frame(struct scene_import *import)
{
    struct scene_seen_mesh *seen = scene_seen_find(import);
    scene_seen_mark(&import->model, seen);
    scene_frame_find(import, seen);
    scene_seen_free(seen, &import->model);
}

// Let a model that has its frame far from the origin, as one beside a speck at 0 can have, be counted from there.
static void locate_frame(struct scene_import *import)
{
    const struct scene_box frame = scene_subject_frame(&import->model);
    double middle[3], size = 0, distance = 0;
    for (int c = 0; c < 3; c++) {
        const double here = 0.5 * frame.low[c] + 0.5 * frame.high[c];
        middle[c] = here + import->model.origin[c];
        distance = fmax(distance, fabs(here));
        size = fmax(size, frame.high[c] - frame.low[c]);
    }
    if (import->model.is_framed && size > 0 && distance > SCENE_REMOTE * size) {
        scene_import_locate_near(import, middle, size);
        keep_drawable_instances(import);
        import->model.is_framed = false;
        find_frame(import);
    }
}

// Where floats hold all places well enough, they are all that counts.
static void forget_exact_places(struct scene_model *model)
{
    for (uint32_t i = 0; i < model->instance_count; i++) {
        memset(model->instances[i].place, 0, sizeof model->instances[i].place);
    }
    for (uint32_t i = 0; i < model->camera_count; i++) {
        memset(model->cameras[i].place, 0, sizeof model->cameras[i].place);
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        memset(model->lights[i].place, 0, sizeof model->lights[i].place);
    }
}

static void mark_image_uses(struct scene_model *model)
{
    for (uint32_t i = 0; i < model->image_count; i++) {
        model->images[i].used_as_color = model->images[i].used_as_data = false;
    }
    for (uint32_t i = 0; i < model->material_count; i++) {
        for (int k = 0; k < SCENE_SLOT_COUNT; k++) {
            const int32_t image = model->materials[i].slots[k].image;
            if (image >= 0 && scene_slot_is_color((enum scene_slot)k)) {
                model->images[image].used_as_color = true;
            } else if (image >= 0) {
                model->images[image].used_as_data = true;
            }
        }
    }
}

static void set_directory(struct scene_import *import)
{
    const char *slash = strrchr(import->name, '/');
    const size_t length = slash == NULL ? 0 : (size_t)(slash - import->name) + 1;
    char *directory = scene_import_allocate(import, length + 1, 1);
    memcpy(directory, import->name, length);
    import->directory = directory;
}

// Return true if nothing of what was read can be seen, by what is known before images are decoded.
static bool shows_nothing(struct scene_import *import)
{
    struct scene_seen_mesh *seen = scene_seen_find(import);
    const bool shows = scene_seen_mark(&import->model, seen);
    scene_seen_free(seen, &import->model);
    return import->model.instance_count > 0 && !shows;
}

static void read_model(struct scene_import *import)
{
    import->read(import);
    scene_import_place_pieces(import);
}

// Read the model as an animation has it. Return true if something is seen.
static bool read_moment(struct scene_import *import, uint32_t animation, double time)
{
    import->is_posed = true;
    import->takes_number = true;
    import->animation_number = animation;
    import->time = time;
    read_model(import);
    return !shows_nothing(import);
}

// Free the largest part of a model that was read for nothing.
static void free_meshes(struct scene_import *import)
{
    for (uint32_t i = 0; i < import->model.mesh_count; i++) {
        struct scene_mesh *const mesh = &import->model.meshes[i];
        void *const arrays[] = {mesh->indices, mesh->positions, mesh->normals, mesh->tangents, mesh->colors};
        for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) {
            free(arrays[k]);
        }
        for (int k = 0; k < SCENE_UV_SETS; k++) {
            free(mesh->uvs[k]);
        }
    }
    free(import->model.meshes);
}

// Read the model. Where it shows nothing at rest, as some that grow or appear do, read it as its first animation has it
// at the beginning, or else in the middle or at the end. An animation that shows nothing gives way to the next.
static void read_what_shows(struct scene_import *import)
{
    enum { ANIMATIONS = 4, MOMENTS = 3 };
    const struct scene_import start = *import;
    read_model(import);
    if (import->is_posed || import->model.animation_count == 0 || !shows_nothing(import)) {
        return;
    }
    const struct scene_import rest = *import;
    for (uint32_t i = 0; i < MOMENTS * ANIMATIONS && i / MOMENTS < rest.model.animation_count; i++) {
        const struct scene_model_animation *animation = &rest.model.animations[i / MOMENTS];
        const double time = 0.5 * (double)(i % MOMENTS) * (double)animation->seconds;
        *import = start;
        if (read_moment(import, i / MOMENTS, time)) {
            scene_import_warn(import,
                              "nothing is seen at rest: drawn as animation %u \"%s\" has it at %.3g s",
                              i / MOMENTS, animation->name, time);
            return;
        }
        free_meshes(import);
    }
    *import = rest;
}

void scene_import_run(struct scene_import *import)
{
    struct scene_model *model = &import->model;
    set_directory(import);
    read_what_shows(import);
    warn_of_fans(import);
    if (import->variant != NULL && model->variant_count == 0) {
        scene_import_fail(import, "has no variants of its materials");
    }
    if (import->is_posed && model->animation_count == 0) {
        scene_import_fail(import, "has no animations that can be played");
    }
    mark_image_uses(model);
    scene_import_decode_images(import);
    // An image that is missing is not used.
    mark_image_uses(model);
    warn_of_missing_uvs(import);
    scene_import_locate(import);
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        struct scene_mesh *const mesh = &model->meshes[i];
        scene_import_bound((const float(*)[3])mesh->positions, mesh->vertex_count, mesh->bounds_min,
                           mesh->bounds_max);
        if (model->meshes[i].primitive == SCENE_PRIMITIVE_TRIANGLES) {
            model->triangles_stored += model->meshes[i].index_count / 3;
        }
    }
    keep_drawable_instances(import);
    warn_of_no_area(import);
    find_frame(import);
    locate_frame(import);
    scene_import_drop_start_lamp(import);
    if (!model->is_scattered) {
        forget_exact_places(model);
    }
    if (import->up_is_open) {
        const enum scene_axis usual = model->up;
        model->up = scene_model_guess_up(import, usual);
        model->up_guessed = model->up != usual;
    }
    scene_import_dress_points(import);
}
