// SPDX-License-Identifier: MIT
// Animations (§3.11): which ones there are, and where one of them has the nodes at a time. Values between two keys are
// computed in double, so that the pose is equal everywhere.
#include <stdlib.h>
#include <string.h>

#include "gltf.h"
#include "import/builder/numbers.h"
#include "import/builder/pose.h"

enum interpolation { STEP, LINEAR, CUBIC };
enum path { TRANSLATION, ROTATION, SCALE, WEIGHTS, PATHS };

// A sampler has `width` values for each key. A key of a cubic one has three times as many: in-tangent, value,
// out-tangent.
struct sampler {
    enum interpolation interpolation;
    const float *times, *values;
    uint32_t count;
    size_t width;
};

// Where a time lies among the keys. It is between `key` and the next one, at `part` of the way, which takes `seconds`.
struct moment {
    uint32_t key;
    double part, seconds;
};

static struct moment find_moment(const struct sampler *sampler, double time)
{
    const float *const times = sampler->times;
    const uint32_t last = sampler->count - 1;
    struct moment moment = {0, 0.0, 0.0};
    while (moment.key < last && (double)times[moment.key + 1] <= time) {
        moment.key++;
    }
    if (moment.key < last && time > (double)times[moment.key]) {
        moment.seconds = (double)times[moment.key + 1] - (double)times[moment.key];
        moment.part = (time - (double)times[moment.key]) / moment.seconds;
    }
    return moment;
}

// Return a value on a cubic Hermite spline with the tangents of the keys (§C.5).
static double hermite(const float *key, const float *next, size_t width, size_t c,
                      const struct moment *moment)
{
    const double t = moment->part, t2 = t * t, t3 = t2 * t, seconds = moment->seconds;
    return (2.0 * t3 - 3.0 * t2 + 1.0) * (double)key[width + c] +
           seconds * (t3 - 2.0 * t2 + t) * (double)key[2 * width + c] +
           (3.0 * t2 - 2.0 * t3) * (double)next[width + c] + seconds * (t3 - t2) * (double)next[c];
}

static void sample(const struct sampler *sampler, double time, bool is_rotation, double *result)
{
    const struct moment moment = find_moment(sampler, time);
    const size_t width = sampler->width, step = sampler->interpolation == CUBIC ? 3 * width : width;
    const float *const key = sampler->values + moment.key * step, *const next = key + step;
    if (!(moment.part > 0.0) || sampler->interpolation == STEP) {
        for (size_t c = 0; c < width; c++) {
            result[c] = (double)(sampler->interpolation == CUBIC ? key + width : key)[c];
        }
    } else if (sampler->interpolation == CUBIC) {
        for (size_t c = 0; c < width; c++) {
            result[c] = hermite(key, next, width, c, &moment);
        }
    } else if (is_rotation) {
        scene_import_slerp(key, next, moment.part, result);
    } else {
        for (size_t c = 0; c < width; c++) {
            result[c] = (double)key[c] + ((double)next[c] - (double)key[c]) * moment.part;
        }
    }
}

// Reading -------------------------------------------------------------------------------------------

struct channel {
    struct scene_gltf *gltf;
    const json_t *animation;
    long long animation_number, number;
};

_Noreturn static void refuse(const struct channel *channel, const char *problem)
{
    scene_import_fail(channel->gltf->import, "animations[%lld].channels[%lld]: %s", channel->animation_number,
                      channel->number, problem);
}

static struct sampler read_sampler(const struct channel *channel, const json_t *object, enum path path)
{
    struct scene_gltf *const gltf = channel->gltf;
    const json_t *const list = scene_gltf_array(gltf, channel->animation, "samplers");
    const int64_t index = scene_gltf_integer(gltf, object, "sampler", -1);
    const json_t *const source = index >= 0 ? json_array_get(list, (size_t)index) : NULL;
    if (!json_is_object(source)) {
        refuse(channel, "its sampler does not exist");
    }
    const char *const name = scene_gltf_text(gltf, source, "interpolation");
    struct sampler sampler = {.interpolation = name == NULL || strcmp(name, "LINEAR") == 0 ? LINEAR
                                               : strcmp(name, "STEP") == 0                 ? STEP
                                               : strcmp(name, "CUBICSPLINE") == 0          ? CUBIC
                                                                                           : LINEAR};
    static const int widths[PATHS] = {3, 4, 3, 1};
    uint32_t values = 0;
    sampler.times =
        scene_gltf_read_floats(gltf, scene_gltf_integer(gltf, source, "input", -1), 1, 1, &sampler.count);
    sampler.values = scene_gltf_read_floats(gltf, scene_gltf_integer(gltf, source, "output", -1),
                                            widths[path], widths[path], &values);
    const uint64_t per_key = (uint64_t)sampler.count * (sampler.interpolation == CUBIC ? 3 : 1);
    sampler.width = path == WEIGHTS ? (size_t)(values / per_key) : (size_t)widths[path];
    if (values != per_key * (path == WEIGHTS ? sampler.width : 1) || sampler.width == 0) {
        refuse(channel, "its sampler has another number of values than of keys");
    }
    for (uint32_t i = 0; i < sampler.count; i++) {
        if (!scene_import_finite(&sampler.times[i], 1) ||
            (i > 0 && sampler.times[i] < sampler.times[i - 1])) {
            refuse(channel, "the times of its keys do not rise");
        }
    }
    return sampler;
}

static void apply_channel(const struct channel *channel, const json_t *object, double time)
{
    static const char *const names[PATHS] = {"translation", "rotation", "scale", "weights"};
    struct scene_gltf *const gltf = channel->gltf;
    const json_t *const target = scene_gltf_object(gltf, object, "target");
    const char *const name = target != NULL ? scene_gltf_text(gltf, target, "path") : NULL;
    const int64_t index = target != NULL ? scene_gltf_integer(gltf, target, "node", -1) : -1;
    int path = 0;
    while (path < PATHS && (name == NULL || strcmp(name, names[path]) != 0)) {
        path++;
    }
    // The target is KHR_animation_pointer's, or nothing that there is.
    if (path == PATHS || index < 0) {
        scene_import_unsupported(gltf->import, "animations of \"%s\": left as at rest",
                                 name != NULL ? name : "nothing");
        return;
    }
    const json_t *const node = scene_gltf_item(gltf, "nodes", index);
    if (path != WEIGHTS && json_object_get(node, "matrix") != NULL) {
        refuse(channel, "moves a node that has a matrix");
    }
    const struct sampler sampler = read_sampler(channel, object, (enum path)path);
    double *const values = scene_import_allocate(gltf->import, sampler.width, sizeof *values);
    sample(&sampler, time, path == ROTATION, values);
    struct scene_gltf_node *const place = &gltf->nodes[index];
    const double **const slots[PATHS] = {&place->translation, &place->rotation, &place->scale,
                                         &place->weights};
    *slots[path] = values;
    place->weight_count = path == WEIGHTS ? sampler.width : place->weight_count;
    free((void *)sampler.times);
    free((void *)sampler.values);
}

// Return the time of the last key of all, by what the accessors say of themselves.
static float duration(struct scene_gltf *gltf, const json_t *animation)
{
    double longest = 0.0;
    size_t i;
    json_t *sampler;
    json_array_foreach(scene_gltf_array(gltf, animation, "samplers"), i, sampler)
    {
        const int64_t input = scene_gltf_integer(gltf, sampler, "input", -1);
        if (input < 0 || (uint64_t)input >= scene_gltf_count(gltf, "accessors")) {
            continue; // the fault is told when the animation is played
        }
        const json_t *const most = scene_gltf_array(gltf, scene_gltf_item(gltf, "accessors", input), "max");
        const double time = json_number_value(json_array_get(most, 0));
        longest = time > longest ? time : longest;
    }
    return (float)longest;
}

static void list_animations(struct scene_gltf *gltf)
{
    struct scene_model *const model = &gltf->import->model;
    const size_t count = scene_gltf_count(gltf, "animations");
    model->animations = scene_import_allocate(gltf->import, count, sizeof *model->animations);
    model->animation_count = (uint32_t)count;
    for (size_t i = 0; i < count; i++) {
        const json_t *const animation = scene_gltf_item(gltf, "animations", (int64_t)i);
        model->animations[i] = (struct scene_model_animation){
            .name = scene_gltf_name(gltf, animation),
            .seconds = duration(gltf, animation),
            .channel_count = (uint32_t)json_array_size(scene_gltf_array(gltf, animation, "channels"))};
    }
}

void scene_gltf_animate(struct scene_gltf *gltf)
{
    struct scene_import *const import = gltf->import;
    list_animations(gltf);
    const uint32_t count = import->model.animation_count;
    if (!import->is_posed) {
        if (count > 0) {
            scene_import_unsupported(import, "%u animation%s: drawn at rest", count, count == 1 ? "" : "s");
        }
        return;
    }
    if (count == 0) {
        return; // finish.c tells it, as for other formats
    }
    const int64_t index = scene_import_find_animation(import);
    if (index < 0) {
        scene_import_fail(import, "has no animation '%s'; rhw info lists those that it has",
                          import->animation);
    }
    struct channel channel = {gltf, scene_gltf_item(gltf, "animations", index), index, 0};
    size_t i;
    json_t *object;
    json_array_foreach(scene_gltf_array(gltf, channel.animation, "channels"), i, object)
    {
        channel.number = (long long)i;
        apply_channel(&channel, object, import->time);
    }
}
