// SPDX-License-Identifier: MIT
// A model that is near is left as its reader made it, by floats.
#include "locate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "import/builder/bounds.h"
#include "import/builder/origin.h"
#include "import/builder/pieces.h"
#include "import/builder/place.h"

enum { SAMPLE = 4096 }; // vertices of the model that are looked at

static bool is_given(const double matrix[16])
{
    return matrix[15] != 0;
}

// Find the matrix from the positions of an instance's mesh to the coordinates of the file.
static void find_place(const struct scene_import *import, uint32_t number, double matrix[16])
{
    const struct scene_instance *const instance = &import->model.instances[number];
    const double *const given = import->exact_instances.matrices[number];
    for (int i = 0; i < 16; i++) {
        matrix[i] = given[i];
    }
    scene_import_add_offset(matrix, import->exact_meshes.matrices[instance->mesh] + 12);
}

static void sample_instance(const struct scene_import *import, uint32_t number, uint64_t step,
                            uint64_t *skipped, double (*points)[3], size_t *count)
{
    const struct scene_mesh *const mesh = &import->model.meshes[import->model.instances[number].mesh];
    double matrix[16];
    find_place(import, number, matrix);
    for (uint64_t v = *skipped; v < mesh->vertex_count && *count < SAMPLE; v += step) {
        scene_import_transform_floats(matrix, mesh->positions[v], points[(*count)++]);
    }
    const uint64_t left = mesh->vertex_count > *skipped ? mesh->vertex_count - *skipped : 0;
    *skipped = left > 0 ? (step - left % step) % step : *skipped - mesh->vertex_count;
}

static struct scene_import_spread find_spread(struct scene_import *import)
{
    const struct scene_model *const model = &import->model;
    double(*const points)[3] = scene_import_allocate(import, SAMPLE, sizeof *points);
    uint64_t all = 0, skipped = 0;
    size_t count = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        all += model->meshes[model->instances[i].mesh].vertex_count;
    }
    for (uint32_t i = 0; i < model->instance_count; i++) {
        sample_instance(import, i, all / SAMPLE + 1, &skipped, points, &count);
    }
    const struct scene_import_spread spread =
        scene_import_spread_find(import, (const double(*)[3])points, count);
    free(points);
    return spread;
}

// Return the longest side of the box around all vertices of a mesh.
static double longest_side(const struct scene_mesh *mesh)
{
    float low[3], high[3];
    double longest = 0;
    scene_import_bound((const float(*)[3])mesh->positions, mesh->vertex_count, low, high);
    for (int c = 0; c < 3; c++) {
        longest = fmax(longest, (double)high[c] - (double)low[c]);
    }
    return longest;
}

// Return true if a mesh stands so many of its own sizes from its origin that pictures of it alone would show the steps
// of floats.
static bool is_remote(const struct scene_mesh *mesh)
{
    double distance = 0;
    for (int c = 0; c < 3 && mesh->vertex_count > 0; c++) {
        distance = fmax(distance, fabs((double)mesh->positions[0][c]));
    }
    const double size = distance > 0 ? longest_side(mesh) : 0;
    return size > 0 && distance > SCENE_REMOTE * size;
}

// Return true if an instance brings its mesh a long way, measured in sizes of the model. A shader would lose what the
// floats of the mesh have.
static bool moves_far(const struct scene_import *import, uint32_t number, double size)
{
    const struct scene_mesh *const mesh = &import->model.meshes[import->model.instances[number].mesh];
    double matrix[16], square = 0;
    find_place(import, number, matrix);
    for (int row = 0; row < 3 && mesh->vertex_count > 0; row++) {
        const float *const p = mesh->positions[0];
        const double way =
            matrix[row] * (double)p[0] + matrix[4 + row] * (double)p[1] + matrix[8 + row] * (double)p[2];
        square += way * way;
    }
    return size > 0 && square > (SCENE_IMPORT_FAR * size) * (SCENE_IMPORT_FAR * size);
}

// Count the positions of a mesh from a place among them, if that is far from the mesh's own origin. They are floats, so
// that nothing is lost of them.
static void settle_mesh(struct scene_import *import, uint32_t number)
{
    struct scene_mesh *const mesh = &import->model.meshes[number];
    double(*const points)[3] = scene_import_allocate(import, mesh->vertex_count, sizeof *points);
    double offset[3];
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        for (int c = 0; c < 3; c++) {
            points[v][c] = (double)mesh->positions[v][c];
        }
    }
    free(mesh->positions);
    mesh->positions = scene_import_settle(import, points, mesh->vertex_count, offset);
    for (int c = 0; c < 3; c++) {
        import->exact_meshes.matrices[number][12 + c] += offset[c];
    }
}

// Let the model's origin be that of a mesh among its vertices. The instances of such a mesh then have a matrix without
// a movement, as in the file.
static void choose_origin(struct scene_import *import, const double middle[3], double size)
{
    double *const origin = import->model.origin;
    memcpy(origin, middle, 3 * sizeof *origin);
    for (uint32_t i = 0; i < import->model.instance_count; i++) {
        double matrix[16];
        bool is_among = true;
        find_place(import, i, matrix);
        for (int c = 0; c < 3; c++) {
            const double distance = matrix[12 + c] - middle[c];
            is_among = is_among && distance <= 2 * size && distance >= -2 * size;
        }
        if (is_among) {
            memcpy(origin, matrix + 12, 3 * sizeof *origin);
            return;
        }
    }
}

// Say exactly where an instance stands. Its floats follow where `moves` is set.
static void place_instance(struct scene_import *import, uint32_t number, bool moves)
{
    struct scene_instance *const instance = &import->model.instances[number];
    double matrix[16];
    find_place(import, number, matrix);
    for (int c = 0; c < 3; c++) {
        matrix[12 + c] -= import->model.origin[c];
        instance->place[c] = matrix[12 + c];
    }
    for (int i = 0; i < 16 && moves; i++) {
        instance->world[i] = (float)matrix[i];
    }
}

static void place_cameras_and_lights(struct scene_import *import, bool moves)
{
    struct scene_model *const model = &import->model;
    for (uint32_t i = 0; i < model->camera_count; i++) {
        const double *const exact = import->exact_cameras.matrices[i];
        struct scene_model_camera *const camera = &model->cameras[i];
        for (int k = 0; k < 16 && moves; k++) {
            camera->world[k] = (float)(exact[k] - (k >= 12 && k < 15 ? model->origin[k - 12] : 0));
        }
        for (int c = 0; c < 3; c++) {
            camera->place[c] = exact[12 + c] - model->origin[c];
        }
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        const double *const exact = import->exact_lights.matrices[i];
        struct scene_model_light *const light = &model->lights[i];
        for (int c = 0; c < 3; c++) {
            light->place[c] = exact[12 + c] - model->origin[c];
            light->position[c] = moves ? (float)light->place[c] : light->position[c];
        }
    }
}

// Count all places from the model's origin. Without `moves` the floats stay that have lost nothing.
static void count_from_origin(struct scene_import *import, bool moves)
{
    struct scene_model *const model = &import->model;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const double *const moved = import->exact_meshes.matrices[model->instances[i].mesh] + 12;
        place_instance(import, i, moves || scene_origin_is_far(moved));
    }
    place_cameras_and_lights(import, moves);
}

// Give each instance the matrix that its floats are made from. Readers that have no more than floats give none.
static void give_matrices(struct scene_import *import)
{
    for (uint32_t i = 0; i < import->model.instance_count; i++) {
        double *const given = import->exact_instances.matrices[i];
        for (int k = 0; k < 16 && !is_given(given); k++) {
            given[k] = (double)import->model.instances[i].world[k];
        }
    }
}

// Warn of a model that a library gave as floats, of its nodes or its vertices, and that is far in steps of these.
static void warn_of_floats(struct scene_import *import, const struct scene_import_spread *spread)
{
    bool is_far = spread->is_far;
    double distance = spread->distance;
    for (uint32_t i = 0; i < import->model.mesh_count; i++) {
        for (int c = 0; c < 3; c++) {
            const double moved = fabs(import->exact_meshes.matrices[i][12 + c]);
            is_far = is_far || moved > 0;
            distance = fmax(distance, moved);
        }
    }
    int exponent;
    frexp(distance, &exponent); // floats have 24 bits
    if (import->has_floats_alone && is_far) {
        scene_import_warn(import,
                          "stands far from the origin, where its format is read as floats: places are "
                          "up to %.2g apart",
                          ldexp(1.0, exponent - 24));
    }
}

// Cut meshes that floats brought parts far from each other in.
static void cut_meshes(struct scene_import *import)
{
    for (uint32_t i = 0, count = import->model.mesh_count; i < count; i++) {
        scene_import_cut_floats(import, i);
    }
    scene_import_place_pieces(import);
}

void scene_import_locate(struct scene_import *import)
{
    struct scene_model *const model = &import->model;
    give_matrices(import);
    cut_meshes(import);
    const struct scene_import_spread spread = find_spread(import);
    bool *const moves = scene_import_allocate(import, model->mesh_count, sizeof *moves);
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const uint32_t mesh = model->instances[i].mesh;
        moves[mesh] = moves[mesh] || moves_far(import, i, spread.size);
    }
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        if (moves[i] || is_remote(&model->meshes[i])) {
            settle_mesh(import, i);
        }
    }
    free(moves);
    warn_of_floats(import, &spread);
    if (spread.is_far) {
        choose_origin(import, spread.middle, spread.size);
    }
    count_from_origin(import, spread.is_far);
}

void scene_import_locate_near(struct scene_import *import, const double middle[3], double size)
{
    choose_origin(import, middle, size);
    count_from_origin(import, true);
}
