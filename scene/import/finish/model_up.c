// SPDX-License-Identifier: MIT
// Guesses what is up, by the rule of model_up.h.

#include "model_up.h"

#include <math.h>

#include "draw/camera/camera_math.h"
#include "draw/camera/subject.h"
#include "import/builder/numbers.h"
#include "symmetry.h"

static const double slab = 0.02; // part of the model's extent that is lowest
static const double least_share = 0.1, ratio = 8, flat = 0.06, thin = 0.2;
static const double feet_share = 0.4, feet_area = 0.05, nose_share = 0.25, feet_ratio = 2.5, mirrored = 0.8;
static const double at_ground = 0.01, at_middle = 0.1; // parts of a side

struct rectangle {
    double low[2], high[2];
};

static void extend(struct rectangle *r, double u, double v)
{
    r->low[0] = u < r->low[0] ? u : r->low[0];
    r->high[0] = u > r->high[0] ? u : r->high[0];
    r->low[1] = v < r->low[1] ? v : r->low[1];
    r->high[1] = v > r->high[1] ? v : r->high[1];
}

// Find how much of the model's rectangle across y, and across z, its lowest vertices cover: shares[1] and shares[2].
static void find_standing_shares(const struct scene_model *model, double shares[3])
{
    const struct scene_box frame = scene_subject_frame(model), room = scene_subject_room(model);
    struct rectangle lowest[3];
    double limits[3];
    for (int axis = 1; axis < 3; axis++) {
        limits[axis] = frame.low[axis] + slab * (frame.high[axis] - frame.low[axis]);
        lowest[axis] = (struct rectangle){{1e300, 1e300}, {-1e300, -1e300}};
    }
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *instance = &model->instances[i];
        const struct scene_mesh *mesh = &model->meshes[instance->mesh];
        const bool is_moved = !scene_import_is_identity(instance->world);
        for (uint32_t k = 0; k < mesh->vertex_count && !instance->unseen; k++) {
            const float *const from = mesh->positions[k];
            double p[3] = {(double)from[0], (double)from[1], (double)from[2]};
            if (is_moved) {
                scene_place_point(instance->world, from, p);
            }
            if ((p[1] <= limits[1] || p[2] <= limits[2]) && scene_box_has(&room, p)) {
                for (int axis = 1; axis < 3; axis++) {
                    if (p[axis] <= limits[axis]) {
                        extend(&lowest[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]);
                    }
                }
            }
        }
    }
    for (int axis = 1; axis < 3; axis++) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double width = frame.high[u] - frame.low[u], height = frame.high[v] - frame.low[v];
        const double covered =
            (lowest[axis].high[0] - lowest[axis].low[0]) * (lowest[axis].high[1] - lowest[axis].low[1]);
        shares[axis] = width > 0 && height > 0 && covered > 0 ? covered / (width * height) : 0;
    }
}

// Return how much of the model's rectangle across an axis the surface has that lies within its lowest vertices.
static double lowest_area(const struct scene_model *model, int axis)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const struct scene_box frame = scene_subject_frame(model);
    const double limit = frame.low[axis] + slab * (frame.high[axis] - frame.low[axis]);
    double area = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *instance = &model->instances[i];
        const struct scene_mesh *mesh = &model->meshes[instance->mesh];
        const bool counts = mesh->primitive == SCENE_PRIMITIVE_TRIANGLES && !instance->unseen;
        for (uint32_t k = 0; k + 3 <= mesh->index_count && counts; k += 3) {
            double p[3][3];
            for (uint32_t c = 0; c < 3; c++) {
                scene_place_point(instance->world, mesh->positions[mesh->indices[k + c]], p[c]);
            }
            if (p[0][axis] <= limit && p[1][axis] <= limit && p[2][axis] <= limit) {
                area += 0.5 * fabs((p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) -
                                   (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]));
            }
        }
    }
    return area / ((frame.high[u] - frame.low[u]) * (frame.high[v] - frame.low[v]));
}

// Return true if a model may be taken to stand on feet or wheels along z.
static bool may_have_feet(const double side[3])
{
    const double longest = fmax(side[0], fmax(side[1], side[2]));
    return side[1] > thin * longest && side[2] > thin * longest;
}

// Return true if a model lies on the plane z = 0, and the axes of x and y go through its middle.
static bool rests_on_ground(const struct scene_model *model)
{
    const struct scene_box frame = scene_subject_frame(model);
    bool rests = true;
    for (int i = 0; i < 3; i++) {
        const double side = frame.high[i] - frame.low[i], low = frame.low[i] + model->origin[i];
        rests = rests && (i == 2 ? fabs(low) < at_ground * side : fabs(low + 0.5 * side) < at_middle * side);
    }
    return rests;
}

// Return true if a model stands on feet or wheels along z, and along y on a nose or a side, by its shares along both,
// unless the place where it stands is as good as that. One of its halves is the mirror image of the other, and not the
// upper one of the lower one.
static bool stands_on_feet(struct scene_import *import, double as_y, double as_z)
{
    const bool stands_on_nose = as_y < nose_share && as_z > feet_ratio * as_y;
    double shares[3];
    if (as_z < feet_share || !(stands_on_nose || rests_on_ground(&import->model)) ||
        lowest_area(&import->model, 2) >= feet_area) {
        return false;
    }
    scene_symmetry_find(import, shares);
    return shares[2] < mirrored && (shares[0] >= mirrored || shares[1] >= mirrored);
}

// Return true if a model of these sides may be taken to stand along an axis. `is_agreed` is as in
// scene_model_guess_up.
static bool may_stand(const double side[3], int axis, bool is_agreed)
{
    double longest = side[0], shortest = side[0];
    for (int i = 1; i < 3; i++) {
        longest = side[i] > longest ? side[i] : longest;
        shortest = side[i] < shortest ? side[i] : shortest;
    }
    return side[axis] > flat * longest &&
           (!is_agreed || (side[axis] >= longest && shortest > thin * longest));
}

enum scene_axis scene_model_guess_up(struct scene_import *import, enum scene_axis usual)
{
    const struct scene_model *const model = &import->model;
    const bool is_agreed = import->up_is_agreed;
    const struct scene_box frame = scene_subject_frame(model);
    double side[3];
    for (int i = 0; i < 3; i++) {
        side[i] = frame.high[i] - frame.low[i];
    }
    const enum scene_axis other = usual == SCENE_AXIS_Y ? SCENE_AXIS_Z : SCENE_AXIS_Y;
    const int usual_axis = usual == SCENE_AXIS_Y ? 1 : 2, other_axis = 3 - usual_axis;
    const bool asks_for_feet = is_agreed && usual == SCENE_AXIS_Y && may_have_feet(side);
    const bool may = may_stand(side, other_axis, is_agreed);
    if (!may && !asks_for_feet) {
        return usual;
    }
    double shares[3];
    find_standing_shares(model, shares);
    const double as_usual = shares[usual_axis], as_other = shares[other_axis];
    if (asks_for_feet && stands_on_feet(import, as_usual, as_other)) {
        return SCENE_AXIS_Z;
    }
    return may && as_other >= least_share && as_other > ratio * as_usual ? other : usual;
}
