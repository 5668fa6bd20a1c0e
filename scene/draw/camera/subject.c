// SPDX-License-Identifier: MIT
// See subject.h.
#include "subject.h"

#include "camera_math.h"

static const double thinnest = 0.02, largest_ratio = 100;

struct box {
    double low[3], high[3];
};

// Return the box around the corners of the mesh's own box, in the world.
static struct box find_box(const struct scene_model *model, uint32_t number)
{
    const struct scene_instance *instance = &model->instances[number];
    const struct scene_mesh *mesh = &model->meshes[instance->mesh];
    struct box box = {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
    for (int corner = 0; corner < 8; corner++) {
        const float p[3] = {(corner & 1 ? mesh->bounds_max : mesh->bounds_min)[0],
                            (corner & 2 ? mesh->bounds_max : mesh->bounds_min)[1],
                            (corner & 4 ? mesh->bounds_max : mesh->bounds_min)[2]};
        double q[3];
        scene_place_point(instance->world, p, q);
        for (int i = 0; i < 3; i++) {
            box.low[i] = q[i] < box.low[i] ? q[i] : box.low[i];
            box.high[i] = q[i] > box.high[i] ? q[i] : box.high[i];
        }
    }
    return box;
}

// Return the axis in which a box is thin. Return −1 if there is none.
static int thin_axis(const struct box *box)
{
    double longest = 0;
    int thinnest_axis = 0;
    for (int i = 0; i < 3; i++) {
        const double side = box->high[i] - box->low[i];
        longest = side > longest ? side : longest;
        if (side < box->high[thinnest_axis] - box->low[thinnest_axis]) {
            thinnest_axis = i;
        }
    }
    return box->high[thinnest_axis] - box->low[thinnest_axis] < thinnest * longest ? thinnest_axis : -1;
}

static double area_along(const double low[3], const double high[3], int axis)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return (high[u] - low[u]) * (high[v] - low[v]);
}

struct scene_subject scene_subject_find(const struct scene_model *model)
{
    struct scene_subject subject = {{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}, true};
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct box box = find_box(model, i);
        if (thin_axis(&box) >= 0) {
            continue;
        }
        subject.is_all = false;
        for (int k = 0; k < 3; k++) {
            subject.low[k] = box.low[k] < subject.low[k] ? box.low[k] : subject.low[k];
            subject.high[k] = box.high[k] > subject.high[k] ? box.high[k] : subject.high[k];
        }
    }
    return subject;
}

bool scene_subject_has(const struct scene_subject *subject, const struct scene_model *model,
                       uint32_t instance)
{
    const struct box box = find_box(model, instance);
    const int axis = thin_axis(&box);
    return subject->is_all || axis < 0 ||
           area_along(box.low, box.high, axis) <=
               largest_ratio * area_along(subject->low, subject->high, axis);
}
