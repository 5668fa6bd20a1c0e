// SPDX-License-Identifier: MIT
// The angle from which a model shows best.
#include "orbit.h"

#include <string.h>

#include "camera_math.h"
#include "coverage.h"
#include "subject.h"

static const double degrees_per_radian = 180.0 / 3.14159265358979323846;

// A model is turned to the viewer where it would cover more than so many times as many pixels then, as the camera of a
// file gives way to a fitted one.
static const uint32_t largest_ratio = 16;

// A model faces one way where so much more of its area does than faces the other.
static const double least_way = 0.1;

void scene_orbit_axes(const struct scene_orbit *orbit, double right[3], double up[3], double back[3])
{
    double sin_a, cos_a, sin_e, cos_e;
    scene_sin_cos_degrees(orbit->azimuth, &sin_a, &cos_a);
    scene_sin_cos_degrees(orbit->elevation, &sin_e, &cos_e);
    // At ±90 degrees `back` is vertical; this `up` is right at every angle in between.
    const double upright_back[3] = {cos_e * sin_a, sin_e, cos_e * cos_a};
    const double upright_up[3] = {-sin_e * sin_a, cos_e, -sin_e * cos_a};
    for (int i = 0; i < 3; i++) {
        back[i] = upright_back[i];
        up[i] = upright_up[i];
    }
    scene_axis_turn(orbit->up, back);
    scene_axis_turn(orbit->up, up);
    scene_cross(up, back, right);
}

// The area vectors of a model's triangles, which are as long as two of them are large and point to where they face.
struct areas {
    double sum[3];
    double sizes[3];     // the sums of their components without signs
    double spread[3][3]; // the sum of each times itself, over its length
};

static void add_area(struct areas *areas, const struct scene_instance *instance, const double area[3])
{
    const double length = __builtin_sqrt(scene_dot(area, area));
    for (int i = 0; i < 3; i++) {
        areas->sum[i] += instance->mirrored ? -area[i] : area[i];
        areas->sizes[i] += area[i] < 0.0 ? -area[i] : area[i];
        for (int k = 0; k < 3 && length > 0.0; k++) {
            areas->spread[i][k] += area[i] * area[k] / length;
        }
    }
}

// With `one_sided`, triangles that are drawn from both sides do not count.
static struct areas sum_areas(const struct scene_model *model, bool one_sided)
{
    struct areas areas = {0};
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *instance = &model->instances[i];
        const struct scene_mesh *mesh = &model->meshes[instance->mesh];
        const bool counts = mesh->primitive == SCENE_PRIMITIVE_TRIANGLES &&
                            !(one_sided && model->materials[mesh->material].double_sided);
        for (uint32_t k = 0; k + 2 < mesh->index_count && counts; k += 3) {
            double p[3][3], area[3];
            for (int c = 0; c < 3; c++) {
                scene_place_point(instance->world, mesh->positions[mesh->indices[k + (uint32_t)c]], p[c]);
            }
            for (int c = 0; c < 3; c++) {
                p[1][c] -= p[0][c];
                p[2][c] -= p[0][c];
            }
            scene_cross(p[1], p[2], area);
            add_area(&areas, instance, area);
        }
    }
    return areas;
}

// Return the axis of the world that `axis`, counted with y up, becomes. Set `*against` to true if it points against the
// world's axis, and to false if not.
static int turned_axis(enum scene_axis up, int axis, bool *against)
{
    double v[3] = {axis == 0, axis == 1, axis == 2};
    scene_axis_turn(up, v);
    const int found = v[0] != 0.0 ? 0 : v[1] != 0.0 ? 1 : 2;
    *against = v[found] < 0.0;
    return found;
}

// Return true if a model that is flat along an axis, counted with y up, faces the far end of that axis. A plate, which
// faces both, does not: of its areas, rounding alone remains. What can be seen from above is not looked at from below.
static bool faces_back(const struct scene_model *model, enum scene_axis up, int axis)
{
    bool against;
    const int world = turned_axis(up, axis, &against);
    const struct areas areas = sum_areas(model, axis == 1);
    return (against ? -areas.sum[world] : areas.sum[world]) < -least_way * areas.sizes[world];
}

// Find the direction that most of the model's area faces or turns its back to: the eigenvector of the largest
// eigenvalue of the spread, which powers of the matrix come to consist of. Return false if there is no area.
static bool find_broadside(const struct areas *areas, double direction[3])
{
    enum { SQUARINGS = 12 };
    double m[3][3];
    memcpy(m, areas->spread, sizeof m);
    for (int round = 0; round <= SQUARINGS; round++) {
        const double trace = m[0][0] + m[1][1] + m[2][2];
        double next[3][3];
        if (!(trace > 0.0) || trace - trace != 0.0) {
            return false;
        }
        for (int i = 0; i < 9; i++) {
            m[i / 3][i % 3] /= trace;
        }
        for (int i = 0; i < 9 && round < SQUARINGS; i++) {
            const double column[3] = {m[0][i % 3], m[1][i % 3], m[2][i % 3]};
            next[i / 3][i % 3] = scene_dot(m[i / 3], column);
        }
        if (round < SQUARINGS) {
            memcpy(m, next, sizeof m);
        }
    }
    const int row = m[0][0] >= m[1][1] && m[0][0] >= m[2][2] ? 0 : m[1][1] >= m[2][2] ? 1 : 2;
    const double length = __builtin_sqrt(scene_dot(m[row], m[row]));
    for (int i = 0; i < 3; i++) {
        direction[i] = m[row][i] / length;
    }
    return length > 0.0;
}

// Return the orbit that looks at the side that most of a model's area shows: the one that it faces or, where it faces
// both, the upper one. `model` has area.
static struct scene_orbit turn_to(const struct areas *areas, const double direction[3], enum scene_axis up)
{
    double v[3], size = 0.0;
    for (int i = 0; i < 3; i++) {
        double axis[3] = {i == 0, i == 1, i == 2};
        scene_axis_turn(up, axis);
        v[i] = scene_dot(axis, direction);
        size += areas->sizes[i];
    }
    const double way = scene_dot(areas->sum, direction), none = 1e-6;
    const bool is_upper = v[1] > none || (v[1] >= -none && (v[2] > none || (v[2] >= -none && v[0] > 0.0)));
    if (way < -least_way * size || (way <= least_way * size && !is_upper)) {
        v[0] = -v[0];
        v[1] = -v[1];
        v[2] = -v[2];
    }
    const double level = __builtin_sqrt(v[0] * v[0] + v[2] * v[2]);
    const bool is_level = level > none;
    const double half_turn = v[2] < 0.0 ? 180.0 : 0.0; // an arc tangent does not tell front from back
    struct scene_orbit orbit = {.elevation = v[1] < 0.0 ? -90.0 : 90.0, .up = up};
    if (is_level) {
        orbit.elevation = degrees_per_radian * scene_atan(v[1] / level);
        orbit.azimuth = v[2] < 0.0 || v[2] > 0.0 ? half_turn + degrees_per_radian * scene_atan(v[0] / v[2])
                        : v[0] < 0.0             ? -90.0
                                                 : 90.0;
    }
    return orbit;
}

// Return how many cells of a square grid a model covers that is looked at from an orbit, at most `enough`. The frame
// has the same size from everywhere.
static uint32_t count_cells(const struct scene_model *model, const struct scene_orbit *orbit, uint32_t enough)
{
    const struct scene_box frame = scene_subject_frame(model);
    struct scene_camera camera = {.orthographic = true};
    double right[3], back[3], diagonal[3];
    for (int i = 0; i < 3; i++) {
        diagonal[i] = frame.high[i] - frame.low[i];
    }
    camera.ymag = 0.5 * __builtin_sqrt(scene_dot(diagonal, diagonal));
    camera.znear = camera.ymag;
    camera.zfar = 3.0 * camera.ymag;
    scene_orbit_axes(orbit, right, camera.up, back);
    for (int i = 0; i < 3; i++) {
        camera.target[i] = 0.5 * (frame.low[i] + frame.high[i]) + model->origin[i];
        camera.eye[i] = camera.target[i] + 2.0 * camera.ymag * back[i];
    }
    return camera.ymag > 0.0 ? scene_coverage_count(model, &camera, 1.0, enough) : 0;
}

// Return an orbit, or where next to nothing of the model is seen from there and more can be, one from which it is.
static struct scene_orbit turn_from_edge(const struct scene_model *model, struct scene_orbit orbit)
{
    const uint32_t ample = scene_coverage_cells(1.0) / largest_ratio + 1;
    const uint32_t covered = count_cells(model, &orbit, ample);
    double direction[3];
    if (covered >= ample) {
        return orbit;
    }
    const struct areas areas = sum_areas(model, false);
    if (!find_broadside(&areas, direction)) {
        return orbit;
    }
    const struct scene_orbit turned = turn_to(&areas, direction, orbit.up);
    const uint32_t much = covered * largest_ratio + 1;
    return count_cells(model, &turned, much) >= much ? turned : orbit;
}

double scene_camera_front(const struct scene_model *model)
{
    return model->faces_back ? 180.0 : 0.0;
}

struct scene_orbit scene_camera_default_orbit(const struct scene_model *model, enum scene_axis up)
{
    const double flat = 0.06;
    const struct scene_box frame = scene_subject_frame(model);
    double extent[3], largest = 0.0;
    for (int i = 0; i < 3; i++) {
        bool against;
        const int world = turned_axis(up, i, &against);
        extent[i] = frame.high[world] - frame.low[world];
        largest = extent[i] > largest ? extent[i] : largest;
    }
    struct scene_orbit orbit = {.azimuth = scene_camera_front(model) + 30.0, .elevation = 20.0, .up = up};
    if (extent[2] <= flat * largest) {
        orbit.azimuth = faces_back(model, up, 2) ? 180.0 : 0.0;
        orbit.elevation = 0.0;
    } else if (extent[0] <= flat * largest) {
        orbit.azimuth = faces_back(model, up, 0) ? -90.0 : 90.0;
        orbit.elevation = 0.0;
    } else if (extent[1] <= flat * largest) {
        orbit.elevation = faces_back(model, up, 1) ? -40.0 : 40.0;
    }
    return turn_from_edge(model, orbit);
}
