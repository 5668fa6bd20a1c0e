// SPDX-License-Identifier: MIT
// The fit of a model into the view.
//
// The fit is exact, not an iteration. For a fixed orientation each vertex bounds the eye's place by linear
// inequalities, and their extreme values over all vertices give the nearest eye in closed form.
#include <float.h>

#include "camera.h"
#include "camera_math.h"
#include "orbit.h"
#include "subject.h"

static const double pi = 3.14159265358979323846;
static const double fit_margin = 0.04; // part of the picture on each side

double scene_camera_default_yfov(void)
{
    return 30.0 * (pi / 180.0);
}

// Extreme values over all vertices, in camera axes (right, up, back).
struct fit {
    double tan_x, tan_y;
    bool turns;
    struct scene_turn turn; // line in camera axes; each vertex takes all places on its circle
    double x_plus, x_minus; // max of x + tan_x z, min of x − tan_x z
    double y_plus, y_minus;
    double z_min, z_max;
    uint64_t count;
};

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static void fit_vertex(struct fit *fit, const double p[3])
{
    fit->x_plus = larger(p[0] + fit->tan_x * p[2], fit->x_plus);
    fit->x_minus = smaller(p[0] - fit->tan_x * p[2], fit->x_minus);
    fit->y_plus = larger(p[1] + fit->tan_y * p[2], fit->y_plus);
    fit->y_minus = smaller(p[1] - fit->tan_y * p[2], fit->y_minus);
    fit->z_min = smaller(p[2], fit->z_min);
    fit->z_max = larger(p[2], fit->z_max);
    fit->count++;
}

static void fit_circle(struct fit *fit, const double p[3])
{
    const double values[5][3] = {
        {1, 0, fit->tan_x}, {1, 0, -fit->tan_x}, {0, 1, fit->tan_y}, {0, 1, -fit->tan_y}, {0, 0, 1}};
    double middle[5], reach[5];
    for (int i = 0; i < 5; i++) {
        scene_turn_range(&fit->turn, p, values[i], &middle[i], &reach[i]);
    }
    fit->x_plus = larger(middle[0] + reach[0], fit->x_plus);
    fit->x_minus = smaller(middle[1] - reach[1], fit->x_minus);
    fit->y_plus = larger(middle[2] + reach[2], fit->y_plus);
    fit->y_minus = smaller(middle[3] - reach[3], fit->y_minus);
    fit->z_min = smaller(middle[4] - reach[4], fit->z_min);
    fit->z_max = larger(middle[4] + reach[4], fit->z_max);
    fit->count++;
}

// Write the matrix of one instance from model space to camera axes, in double: 3 rows of 4.
static void instance_rows(const struct scene_instance *instance, const double axes[3][3], double rows[3][4])
{
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 4; c++) {
            rows[r][c] = 0.0;
            for (int k = 0; k < 3; k++) {
                rows[r][c] += axes[r][k] * (double)instance->world[4 * c + k];
            }
        }
    }
}

static bool is_framed(const struct scene_box *room, const struct scene_instance *instance, const float p[3])
{
    double place[3];
    scene_place_point(instance->world, p, place);
    return scene_box_has(room, place);
}

static void fit_model(const struct scene_model *model, const double axes[3][3], bool whole, struct fit *fit)
{
    const struct scene_subject subject = scene_subject_find(model);
    const struct scene_box room = scene_subject_room(model);
    const bool takes_all = whole || !model->is_framed;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *instance = &model->instances[i];
        const struct scene_mesh *mesh = &model->meshes[instance->mesh];
        double rows[3][4];
        if (instance->unseen || (!whole && !scene_subject_has(&subject, model, i))) {
            continue;
        }
        instance_rows(instance, axes, rows);
        // Vertices that no index uses are not part of the picture; the mesh's bounds leave them out.
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            const float *p = mesh->positions[v];
            bool used = true;
            double q[3];
            for (int r = 0; r < 3; r++) {
                used = used && p[r] >= mesh->bounds_min[r] && p[r] <= mesh->bounds_max[r];
                q[r] = rows[r][0] * (double)p[0] + rows[r][1] * (double)p[1] + rows[r][2] * (double)p[2] +
                       rows[r][3];
            }
            used = used && (takes_all || is_framed(&room, instance, p));
            if (used && scene_finite3(q) && fit->turns) {
                fit_circle(fit, q);
            } else if (used && scene_finite3(q)) {
                fit_vertex(fit, q);
            }
        }
    }
}

double scene_camera_fit_margin(void)
{
    return fit_margin;
}

struct scene_camera scene_camera_fit(const struct scene_model *model, struct scene_orbit orbit, double yfov,
                                     double aspect)
{
    struct scene_camera camera = {.yfov = yfov};
    double right[3], up[3], back[3];
    scene_orbit_axes(&orbit, right, up, back);
    const double axes[3][3] = {
        {right[0], right[1], right[2]}, {up[0], up[1], up[2]}, {back[0], back[1], back[2]}};

    const double tan_y = scene_tangent_of_half(yfov) * (1.0 - 2.0 * fit_margin);
    struct fit fit = {.tan_x = tan_y * aspect,
                      .tan_y = tan_y,
                      .x_plus = -DBL_MAX,
                      .x_minus = DBL_MAX,
                      .y_plus = -DBL_MAX,
                      .y_minus = DBL_MAX,
                      .z_min = DBL_MAX,
                      .z_max = -DBL_MAX,
                      .turns = orbit.turns};
    double vertical[3] = {0.0, 1.0, 0.0}, center[3];
    scene_axis_turn(orbit.up, vertical);
    for (int i = 0; i < 3; i++) {
        center[i] = orbit.turn_center[i] - model->origin[i];
    }
    for (int i = 0; i < 3; i++) {
        fit.turn.center[i] = scene_dot(axes[i], center);
        fit.turn.axis[i] = scene_dot(axes[i], vertical);
    }
    fit_model(model, axes, orbit.whole, &fit);
    double place[3] = {0.0, 0.0, 4.0}, distance = 4.0; // `place` is in camera axes
    if (fit.count > 0) {
        // For every vertex x − e_x <= tan_x (e_z − z) holds, and its mirror image, so x_plus − tan_x e_z <= e_x <=
        // x_minus + tan_x e_z. The eye takes the smallest e_z that leaves an e_x.
        const double z_x = (fit.x_plus - fit.x_minus) / (2.0 * fit.tan_x);
        const double z_y = (fit.y_plus - fit.y_minus) / (2.0 * fit.tan_y);
        place[0] = 0.5 * (fit.x_plus + fit.x_minus);
        place[1] = 0.5 * (fit.y_plus + fit.y_minus);
        place[2] = z_x > z_y ? z_x : z_y;
        // All of a long model may lie in the picture as seen from its own near end, so the eye stays off by a fifth of
        // its length. A single point has no length, so the eye steps back far enough for floats to tell.
        double scale = 0.0;
        for (int i = 0; i < 3; i++) {
            const double magnitude = place[i] < 0.0 ? -place[i] : place[i];
            scale = magnitude > scale ? magnitude : scale;
        }
        const double length = fit.z_max - fit.z_min;
        const double least = length > 1e-5 * scale ? 0.2 * length : scale > 0.0 ? 0.1 * scale : 4.0;
        distance = place[2] - fit.z_max;
        if (distance < least && (length > 1e-5 * scale || distance <= 1e-5 * scale)) {
            distance = least;
            place[2] = fit.z_max + distance;
        }
    }
    for (int i = 0; i < 3; i++) {
        camera.eye[i] = right[i] * place[0] + up[i] * place[1] + back[i] * place[2] + model->origin[i];
        camera.target[i] = camera.eye[i] - back[i] * distance;
        camera.up[i] = up[i];
    }
    if (orbit.turns) {
        scene_camera_enclose_turn(&camera, model, &orbit);
    } else {
        scene_camera_enclose(&camera, model);
    }
    return camera;
}
