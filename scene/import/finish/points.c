// SPDX-License-Identifier: MIT
// Clouds of points become surfaces to the eye. Points become discs as large as the points are apart. A cloud without
// colours gets colours by height, without which nothing but its outline is seen.
#include "points.h"

#include <stdlib.h>
#include <string.h>

#include "draw/camera/camera_math.h"
#include "draw/camera/subject.h"
#include "import/builder/numbers.h"

// Fewer points than LEAST_POINTS are drawn as single points. Discs of radius_per_spacing spacings overlap, even where
// points are a little farther apart than elsewhere. No disc is larger than most_of_cloud of the cloud.
enum { LEAST_POINTS = 64, FINEST_GRID = 512, LEAST_GRID = 64, POINTS_PER_CELL = 4 };
static const float radius_per_spacing = 1.2f, most_of_cloud = 0.03f;

// Count the cells of a grid over the mesh that hold a point. `bits` has room for all cells.
static size_t count_cells(const struct scene_mesh *mesh, const float low[3], float cell, int cells,
                          uint64_t *bits)
{
    const size_t all = (size_t)cells * (size_t)cells * (size_t)cells;
    memset(bits, 0, (all + 63) / 64 * sizeof *bits);
    size_t occupied = 0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        size_t place = 0;
        for (int c = 0; c < 3; c++) {
            const float at = (mesh->positions[i][c] - low[c]) / cell, last = (float)(cells - 1);
            place = place * (size_t)cells + (size_t)(at > 0 ? at < last ? at : last : 0);
        }
        const uint64_t bit = (uint64_t)1 << place % 64;
        occupied += (bits[place / 64] & bit) == 0;
        bits[place / 64] |= bit;
    }
    return occupied;
}

// Find how far the points of a surface are apart. The finest grid whose cells hold several points each covers the
// surface as scales do, and tells its area.
static float find_spacing(struct scene_import *import, const struct scene_mesh *mesh, const float low[3],
                          float extent)
{
    int finest = FINEST_GRID;
    while (finest > LEAST_GRID && (uint32_t)finest / 2 >= mesh->vertex_count) {
        // With fewer points than cells along a side, no cell holds several.
        finest /= 2;
    }
    uint64_t *bits =
        scene_import_allocate(import, (size_t)finest * (size_t)finest * (size_t)finest / 64, sizeof *bits);
    float spacing = 0;
    for (int cells = finest; cells > 0 && spacing == 0; cells /= 2) {
        const float cell = extent / (float)cells;
        const size_t occupied = count_cells(mesh, low, cell, cells, bits);
        if (occupied * POINTS_PER_CELL <= mesh->vertex_count) {
            spacing = cell * __builtin_sqrtf((float)occupied / (float)mesh->vertex_count);
        }
    }
    free(bits);
    return spacing;
}

// Find the bounds of the points of a mesh that lie within the model's frame.
static void find_bounds(const struct scene_model *model, const struct scene_mesh *mesh, const float world[16],
                        float low[3], float high[3])
{
    memcpy(low, mesh->bounds_min, 3 * sizeof *low);
    memcpy(high, mesh->bounds_max, 3 * sizeof *high);
    const struct scene_box room = scene_subject_room(model);
    bool is_first = true;
    for (uint32_t i = 0; i < mesh->vertex_count && model->is_framed; i++) {
        double place[3];
        scene_place_point(world, mesh->positions[i], place);
        const bool inside = scene_box_has(&room, place);
        for (int c = 0; c < 3 && inside; c++) {
            const float at = mesh->positions[i][c];
            low[c] = is_first || at < low[c] ? at : low[c];
            high[c] = is_first || at > high[c] ? at : high[c];
        }
        is_first = is_first && !inside;
    }
}

static void set_radius(struct scene_import *import, struct scene_mesh *mesh, const float world[16])
{
    float low[3], high[3], extent = 0;
    find_bounds(&import->model, mesh, world, low, high);
    for (int c = 0; c < 3; c++) {
        const float side = high[c] - low[c];
        extent = side > extent ? side : extent;
    }
    if (!(extent > 1e-30f && extent < 1e30f)) {
        return;
    }
    const float radius = radius_per_spacing * find_spacing(import, mesh, low, extent);
    mesh->point_radius = radius < most_of_cloud * extent ? radius : most_of_cloud * extent;
}

// Colours -------------------------------------------------------------------------------------------

// Set a colour from dark blue through green to yellow, ever brighter. It is in sRGB.
static void height_color(float height, float (*stops)[3], float color[4])
{
    const float place = height > 0 ? (height < 1 ? height * 4 : 4) : 0;
    const int below = place < 4 ? (int)place : 3;
    for (int c = 0; c < 3; c++) {
        color[c] = stops[below][c] + (stops[below + 1][c] - stops[below][c]) * (place - (float)below);
    }
    color[3] = 1;
}

// Set colours by height in the world, where the mesh has an extent.
static void set_colors(struct scene_import *import, struct scene_mesh *mesh, const float world[16])
{
    static const float encoded[5][3] = {{0.27f, 0.00f, 0.33f},
                                        {0.23f, 0.32f, 0.55f},
                                        {0.13f, 0.57f, 0.55f},
                                        {0.37f, 0.79f, 0.38f},
                                        {0.99f, 0.91f, 0.15f}};
    static const int axes[] = {[SCENE_AXIS_Y] = 1,       [SCENE_AXIS_Z] = 2,       [SCENE_AXIS_X] = 0,
                               [SCENE_AXIS_MINUS_Y] = 1, [SCENE_AXIS_MINUS_Z] = 2, [SCENE_AXIS_MINUS_X] = 0};
    const int axis = axes[import->model.up];
    const bool down = import->model.up >= SCENE_AXIS_MINUS_Y;
    float stops[5][3];
    for (int i = 0; i < 15; i++) {
        stops[i / 3][i % 3] = scene_import_from_srgb(encoded[i / 3][i % 3]);
    }
    const struct scene_box frame = scene_subject_frame(&import->model);
    const float low = (float)frame.low[axis], high = (float)frame.high[axis];
    if (!(high > low)) {
        return;
    }
    mesh->colors = scene_import_allocate(import, mesh->vertex_count, sizeof *mesh->colors);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        float point[3];
        scene_import_transform(world, mesh->positions[i], point);
        const float height = (point[axis] - low) / (high - low);
        height_color(down ? 1 - height : height, stops, mesh->colors[i]);
    }
}

// Return true if nobody has said what colour the material has.
static bool is_plain(const struct scene_material *material)
{
    const float *color = material->base_color;
    return color[0] == color[1] && color[1] == color[2] && color[3] == 1 &&
           material->slots[SCENE_SLOT_BASE_COLOR].image < 0;
}

static uint32_t white_material(struct scene_import *import, uint32_t source)
{
    const struct scene_material material = import->model.materials[source];
    struct scene_material *copy = scene_import_add_material(import);
    *copy = material;
    copy->base_color[0] = copy->base_color[1] = copy->base_color[2] = 1;
    return import->model.material_count - 1;
}

void scene_import_dress_points(struct scene_import *import)
{
    struct scene_model *model = &import->model;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *instance = &model->instances[i];
        struct scene_mesh *mesh = &model->meshes[instance->mesh];
        if (mesh->primitive != SCENE_PRIMITIVE_POINTS || mesh->vertex_count < LEAST_POINTS ||
            mesh->point_radius > 0) {
            continue; // an instance before may have dressed it
        }
        set_radius(import, mesh, instance->world);
        if (mesh->colors == NULL && is_plain(&model->materials[mesh->material])) {
            set_colors(import, mesh, instance->world);
            mesh->material = mesh->colors != NULL ? white_material(import, mesh->material) : mesh->material;
        }
    }
}
