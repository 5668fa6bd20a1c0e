// SPDX-License-Identifier: MIT
// Strays become fewer the farther they are, so that no gap is before them, as there is before a speck. Their number
// tells them: a cloud that is whole becomes hardly shorter where a few of its points are left out.
#include "cloud_frame.h"

#include "draw/camera/camera_math.h"

// A cloud whose strays are a thousand times as far away as it is long is all in a few of the bins, into which the next
// round looks.
enum { BINS = 1024, ROUNDS = 4 };
// Two of 1000 are less than two points of a smaller cloud, whose one stray the search for specks finds.
enum { LEAST = 1000 };
// More points may be a part of what is shown, such as a mast or a wire, and points that are left out for a picture in
// which the others are hardly larger are missed.
static const double stray_share = 0.002, shorter = 0.6;

struct counts {
    uint64_t bins[3][BINS], all;
};

static bool is_cloud(const struct scene_model *model)
{
    bool is_points = model->instance_count > 0;
    for (uint32_t i = 0; i < model->instance_count && is_points; i++) {
        is_points = model->meshes[model->instances[i].mesh].primitive == SCENE_PRIMITIVE_POINTS;
    }
    return is_points;
}

static int bin_of(const struct scene_box *frame, int axis, double at)
{
    const double side = frame->high[axis] - frame->low[axis];
    const double place = side > 0 ? (at - frame->low[axis]) / side * BINS : 0;
    return place > 0 ? place < BINS ? (int)place : BINS - 1 : 0;
}

// Count the points in a frame, and find the bounds of those that are in `kept` too.
static struct scene_box look(const struct scene_model *model, const struct scene_box *frame,
                             const struct scene_box *kept, struct counts *counts)
{
    struct scene_box bounds = scene_box_empty();
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *const instance = &model->instances[i];
        const struct scene_mesh *const mesh = &model->meshes[instance->mesh];
        for (uint32_t k = 0; k < mesh->index_count && !instance->unseen; k++) {
            double place[3];
            scene_place_point(instance->world, mesh->positions[mesh->indices[k]], place);
            if (!scene_box_has(frame, place)) {
                continue;
            }
            counts->all++;
            for (int c = 0; c < 3; c++) {
                counts->bins[c][bin_of(frame, c, place[c])]++;
            }
            if (scene_box_has(kept, place)) {
                scene_box_extend_to(&bounds, place);
            }
        }
    }
    return bounds;
}

// Return a frame without the bins at its ends in which few points are.
static struct scene_box without_ends(const struct scene_box *frame, const struct counts *counts)
{
    const uint64_t few = (uint64_t)(stray_share * (double)counts->all);
    struct scene_box kept = *frame;
    for (int c = 0; c < 3; c++) {
        const uint64_t *const bins = counts->bins[c];
        const double side = frame->high[c] - frame->low[c];
        int first = 0, last = BINS - 1;
        for (uint64_t sum = bins[first]; sum <= few && first < last; sum += bins[first]) {
            first++;
        }
        for (uint64_t sum = bins[last]; sum <= few && last > first; sum += bins[last]) {
            last--;
        }
        kept.low[c] = frame->low[c] + side * first / BINS;
        kept.high[c] = frame->low[c] + side * (last + 1) / BINS;
    }
    return kept;
}

bool scene_cloud_frame_trim(const struct scene_model *model, struct scene_box *frame)
{
    bool is_trimmed = false;
    for (int round = 0; round < ROUNDS && is_cloud(model); round++) {
        struct counts counts = {.all = 0}, again = {.all = 0};
        look(model, frame, frame, &counts);
        if (counts.all < LEAST) {
            break;
        }
        const struct scene_box kept = without_ends(frame, &counts);
        const struct scene_box bounds = look(model, frame, &kept, &again);
        if (!(bounds.low[0] <= bounds.high[0]) ||
            scene_box_longest(&bounds) >= shorter * scene_box_longest(frame)) {
            break;
        }
        *frame = bounds;
        is_trimmed = true;
    }
    return is_trimmed;
}
