// SPDX-License-Identifier: MIT
// See subject.h.
#include "subject.h"

#include "camera_math.h"

static const double thinnest = 0.02, largest_ratio = 100;

struct scene_box scene_subject_frame(const struct scene_model *model)
{
    const float *low = model->is_framed ? model->frame_min : model->bounds_min;
    const float *high = model->is_framed ? model->frame_max : model->bounds_max;
    return scene_box_of(low, high);
}

struct scene_box scene_subject_room(const struct scene_model *model)
{
    const struct scene_box frame = scene_subject_frame(model);
    return scene_box_grown(&frame, model->is_framed ? 1e-4 * scene_box_longest(&frame) : 1e300);
}

void scene_subject_place(const struct scene_instance *instance, const double point[3], double place[3])
{
    const float *const world = instance->world;
    double moved[3];
    scene_exact_place(world + 12, instance->place, moved);
    for (int c = 0; c < 3; c++) {
        place[c] = (double)world[c] * point[0] + (double)world[4 + c] * point[1] +
                   (double)world[8 + c] * point[2] + moved[c];
    }
}

struct scene_box scene_subject_box(const struct scene_model *model, uint32_t number)
{
    const struct scene_instance *instance = &model->instances[number];
    const struct scene_mesh *mesh = &model->meshes[instance->mesh];
    const struct scene_box own = scene_box_of(mesh->bounds_min, mesh->bounds_max);
    struct scene_box box = scene_box_empty();
    for (int corner = 0; corner < 8; corner++) {
        double p[3], q[3];
        scene_box_corner(&own, corner, p);
        scene_subject_place(instance, p, q);
        scene_box_extend_to(&box, q);
    }
    return box;
}

int scene_subject_thin_axis(const struct scene_model *model, uint32_t instance, struct scene_box *box)
{
    *box = scene_subject_box(model, instance);
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

static double area_along(const struct scene_box *box, int axis)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return (box->high[u] - box->low[u]) * (box->high[v] - box->low[v]);
}

bool scene_subject_is_ground(const struct scene_box *box, int axis, const struct scene_box *other)
{
    return axis >= 0 && area_along(box, axis) > largest_ratio * area_along(other, axis);
}

// Cut a box to the frame. Return false if nothing is left.
static bool cut_to_frame(const struct scene_model *model, struct scene_box *box)
{
    const struct scene_box frame = scene_subject_frame(model);
    bool is_left = true;
    for (int i = 0; i < 3 && model->is_framed; i++) {
        box->low[i] = box->low[i] > frame.low[i] ? box->low[i] : frame.low[i];
        box->high[i] = box->high[i] < frame.high[i] ? box->high[i] : frame.high[i];
        is_left = is_left && box->low[i] <= box->high[i];
    }
    return is_left;
}

struct scene_subject scene_subject_find(const struct scene_model *model)
{
    struct scene_subject subject = {scene_subject_frame(model), true};
    for (uint32_t i = 0; i < model->instance_count; i++) {
        struct scene_box box;
        if (model->instances[i].unseen || scene_subject_thin_axis(model, i, &box) >= 0 ||
            !cut_to_frame(model, &box)) {
            continue;
        }
        if (subject.is_all) {
            subject.box = scene_box_empty();
        }
        scene_box_extend(&subject.box, &box);
        subject.is_all = false;
    }
    return subject;
}

bool scene_subject_has(const struct scene_subject *subject, const struct scene_model *model,
                       uint32_t instance)
{
    struct scene_box box;
    const int axis = scene_subject_thin_axis(model, instance, &box);
    return !model->instances[instance].unseen &&
           (subject->is_all || !scene_subject_is_ground(&box, axis, &subject->box));
}
