// SPDX-License-Identifier: MIT
// Cameras: vectors to matrices, and the planes around a model.
#include "camera.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "camera_math.h"
#include "elementary.h"
#include "subject.h"

static const double pi = 3.14159265358979323846;

void scene_axis_turn(enum scene_axis up, double v[3])
{
    const double x = v[0], y = v[1], z = v[2];
    const double turned[6][3] = {[SCENE_AXIS_Y] = {x, y, z},        [SCENE_AXIS_Z] = {x, -z, y},
                                 [SCENE_AXIS_X] = {y, -x, z},       [SCENE_AXIS_MINUS_Y] = {-x, -y, z},
                                 [SCENE_AXIS_MINUS_Z] = {x, z, -y}, [SCENE_AXIS_MINUS_X] = {-y, x, z}};
    for (int i = 0; i < 3; i++) {
        v[i] = turned[up][i];
    }
}

// Make a vector unit. Return false if it has no direction.
static bool normalize(double a[3])
{
    double largest = 0.0;
    for (int i = 0; i < 3; i++) {
        const double magnitude = a[i] < 0.0 ? -a[i] : a[i];
        largest = magnitude > largest ? magnitude : largest;
    }
    if (!(largest > 0.0 && largest <= DBL_MAX)) {
        return false;
    }
    const double scaled[3] = {a[0] / largest, a[1] / largest, a[2] / largest};
    const double length = __builtin_sqrt(scene_dot(scaled, scaled));
    for (int i = 0; i < 3; i++) {
        a[i] = scaled[i] / length;
    }
    return true;
}

// Find the camera's right, up and backward directions, which are the rows of the view matrix.
static void camera_axes(const struct scene_camera *camera, double right[3], double up[3], double back[3])
{
    for (int i = 0; i < 3; i++) {
        back[i] = camera->eye[i] - camera->target[i];
    }
    if (!normalize(back)) {
        back[0] = back[1] = 0.0;
        back[2] = 1.0;
    }
    double wanted[3] = {camera->up[0], camera->up[1], camera->up[2]};
    scene_cross(wanted, back, right);
    const double nearly_parallel = 1e-12 * scene_dot(wanted, wanted);
    if (!normalize(wanted) || scene_dot(right, right) <= nearly_parallel || !normalize(right)) {
        // The camera looks along `up`, so the axis that is furthest from the view takes its place.
        const double other[3] = {0.0, back[1] * back[1] < 0.5 ? 1.0 : 0.0,
                                 back[1] * back[1] < 0.5 ? 0.0 : -1.0};
        scene_cross(other, back, right);
        normalize(right);
    }
    scene_cross(back, right, up);
}

struct range {
    double nearest, furthest;
};

// Extend a range of distances from the eye to a point, or to all places that it has while it turns.
static void extend_to_point(struct range *range, const double point[3], double eye, const double back[3],
                            const struct scene_turn *turn)
{
    double middle, reach = 0.0;
    if (!scene_finite3(point)) {
        return;
    }
    if (turn) {
        scene_turn_range(turn, point, back, &middle, &reach);
    } else {
        middle = scene_dot(back, point);
    }
    const double distance = eye - middle;
    range->nearest = distance - reach < range->nearest ? distance - reach : range->nearest;
    range->furthest = distance + reach > range->furthest ? distance + reach : range->furthest;
}

static void extend_to_box(struct range *range, const struct scene_box *box, double eye, const double back[3],
                          const struct scene_turn *turn)
{
    for (int i = 0; i < 8; i++) {
        double corner[3];
        scene_box_corner(box, i, corner);
        extend_to_point(range, corner, eye, back, turn);
    }
}

// Extend a range to the box of an instance, which need not lie along the axes of the world.
static void extend_to_instance(struct range *range, const struct scene_model *model, uint32_t number,
                               double eye, const double back[3], const struct scene_turn *turn)
{
    const struct scene_instance *const instance = &model->instances[number];
    const struct scene_mesh *const mesh = &model->meshes[instance->mesh];
    const struct scene_box box = scene_box_of(mesh->bounds_min, mesh->bounds_max);
    for (int i = 0; i < 8; i++) {
        double corner[3], place[3];
        scene_box_corner(&box, i, corner);
        scene_subject_place(instance, corner, place);
        extend_to_point(range, place, eye, back, turn);
    }
}

// Put the near and far planes around the model's boxes. Something behind the eye puts the near plane at a small part of
// the distance of the far one. The drawing code reverses depth, so the ratio costs no precision. `turn` is NULL if the
// model stands still.
static void enclose(struct scene_camera *camera, const struct scene_model *model,
                    const struct scene_turn *turn)
{
    double axes[3][3];
    camera_axes(camera, axes[0], axes[1], axes[2]);
    const struct scene_camera own = scene_camera_from_origin(camera, model->origin);
    const double eye = scene_dot(axes[2], own.eye);
    const struct scene_box frame = scene_subject_frame(model);
    struct range all = {DBL_MAX, -DBL_MAX}, framed = {DBL_MAX, -DBL_MAX};
    double ahead = DBL_MAX; // the nearest instance that is wholly before the eye
    extend_to_box(&framed, &frame, eye, axes[2], turn);
    for (uint32_t i = 0; i < model->instance_count; i++) {
        struct range one = {DBL_MAX, -DBL_MAX};
        extend_to_instance(&one, model, i, eye, axes[2], turn);
        all.nearest = one.nearest < all.nearest ? one.nearest : all.nearest;
        all.furthest = one.furthest > all.furthest ? one.furthest : all.furthest;
        ahead = one.nearest > 0.0 && one.nearest < ahead ? one.nearest : ahead;
    }
    const double fallback = 1.0;
    camera->zfar = all.furthest > 0.0 ? all.furthest * 1.001 : fallback;
    double closest = camera->zfar / 8192.0;
    if (model->is_scattered && ahead * 0.999 < closest) {
        closest = ahead * 0.999;
    }
    if (model->is_framed && framed.nearest > 0.0 && framed.nearest * 0.999 < closest) {
        closest = framed.nearest * 0.999; // what is far away must not cut the frame
    }
    camera->znear =
        all.nearest * 0.999 > closest && all.nearest <= all.furthest ? all.nearest * 0.999 : closest;
}

void scene_camera_enclose(struct scene_camera *camera, const struct scene_model *model)
{
    enclose(camera, model, NULL);
}

void scene_camera_enclose_turn(struct scene_camera *camera, const struct scene_model *model,
                               const struct scene_orbit *orbit)
{
    struct scene_turn turn = {.axis = {0.0, 1.0, 0.0}};
    for (int i = 0; i < 3; i++) {
        turn.center[i] = orbit->turn_center[i] - model->origin[i];
    }
    scene_axis_turn(orbit->up, turn.axis);
    enclose(camera, model, &turn);
}

// Return true if two vectors are parallel within a millionth of a radian or so. Right and left would be rounding alone
// there.
static bool is_parallel(const double a[3], const double b[3])
{
    double product[3];
    scene_cross(a, b, product);
    return !(scene_dot(product, product) > 1e-12 * scene_dot(a, a) * scene_dot(b, b));
}

// Place a camera whose lens is set already. `bad_lens` says why the lens cannot be, or is NULL if it can.
static bool look(struct scene_camera *camera, const struct scene_model *model, const double eye[3],
                 const double target[3], const double up[3], const char *bad_lens, char *error,
                 size_t error_size)
{
    const double direction[3] = {target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]};
    const char *cause = bad_lens;
    if (!scene_finite3(eye) || !scene_finite3(target) || !scene_finite3(up)) {
        cause = "every number must be finite";
    } else if (!(scene_dot(direction, direction) > 0.0) || !scene_finite3(direction)) {
        cause = "eye and target must be different points";
    } else if (!(scene_dot(up, up) > 0.0)) {
        cause = "up must not be zero";
    } else if (is_parallel(direction, up)) {
        cause = "up must not be parallel to the view";
    }
    if (cause) {
        snprintf(error, error_size, "not a camera: %s", cause);
        return false;
    }
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = eye[i];
        camera->target[i] = target[i];
        camera->up[i] = up[i];
    }
    scene_camera_enclose(camera, model);
    return true;
}

bool scene_camera_look(struct scene_camera *camera, const struct scene_model *model, const double eye[3],
                       const double target[3], const double up[3], double yfov, char *error,
                       size_t error_size)
{
    const bool has_angle = yfov >= 0.01 * (pi / 180.0) && yfov <= 179.0 * (pi / 180.0);
    *camera = (struct scene_camera){.yfov = yfov};
    return look(camera, model, eye, target, up,
                has_angle ? NULL : "the field of view must lie between 0.01 and 179 degrees", error,
                error_size);
}

bool scene_camera_look_orthographic(struct scene_camera *camera, const struct scene_model *model,
                                    const double eye[3], const double target[3], const double up[3],
                                    double height, char *error, size_t error_size)
{
    const bool has_height = height > 0.0 && height <= DBL_MAX;
    *camera = (struct scene_camera){.orthographic = true, .ymag = 0.5 * height};
    return look(camera, model, eye, target, up,
                has_height ? NULL : "the height of what is seen must be above 0", error, error_size);
}

struct scene_camera scene_camera_from_origin(const struct scene_camera *camera, const double origin[3])
{
    struct scene_camera moved = *camera;
    for (int i = 0; i < 3; i++) {
        moved.eye[i] -= origin[i];
        moved.target[i] -= origin[i];
    }
    return moved;
}

struct scene_camera scene_camera_from_model(const struct scene_model *model,
                                            const struct scene_model_camera *source, double aspect)
{
    struct scene_camera camera = {.orthographic = source->orthographic};
    double place[3];
    scene_exact_place(source->world + 12, source->place, place);
    for (int i = 0; i < 3; i++) {
        camera.eye[i] = place[i] + model->origin[i];
        camera.up[i] = (double)source->world[4 + i];
        camera.target[i] = camera.eye[i] - (double)source->world[8 + i];
    }
    if (source->orthographic) {
        const double from_width = (double)source->xmag / aspect;
        camera.ymag = from_width > (double)source->ymag ? from_width : (double)source->ymag;
    } else {
        camera.yfov = (double)source->yfov;
        if ((double)source->aspect > aspect) {
            // The picture is narrower than the camera's, so a taller angle keeps its width. The arc tangent is found by
            // iteration: (w c − s) / (c + w s) is the tangent t of the angle that is missing, and t / (1 + 0.28 t²) is
            // within 0.005 of that angle.
            const double wanted = scene_tangent_of_half(camera.yfov) * (double)source->aspect / aspect;
            double degrees = camera.yfov * (90.0 / pi);
            for (int i = 0; i < 40; i++) {
                double s, c;
                scene_sin_cos_degrees(degrees, &s, &c);
                const double t = (wanted * c - s) / (c + wanted * s);
                degrees += t / (1.0 + 0.28 * t * t) * (180.0 / pi);
            }
            camera.yfov = degrees * (pi / 90.0);
        }
    }
    camera.znear = (double)source->znear;
    camera.zfar = (double)source->zfar;
    return camera;
}

void scene_camera_view(const struct scene_camera *camera, double matrix[16])
{
    double axes[3][3];
    camera_axes(camera, axes[0], axes[1], axes[2]);
    for (int r = 0; r < 3; r++) {
        for (int c = 0; c < 3; c++) {
            matrix[4 * c + r] = axes[r][c];
        }
        matrix[12 + r] = -scene_dot(axes[r], camera->eye);
        matrix[4 * r + 3] = 0.0;
    }
    matrix[15] = 1.0;
}

void scene_camera_projection(const struct scene_camera *camera, double aspect, double matrix[16])
{
    for (int i = 0; i < 16; i++) {
        matrix[i] = 0.0;
    }
    const double n = camera->znear, f = camera->zfar;
    const double stretch = camera->stretch > 0.0 ? camera->stretch : 1.0;
    if (camera->orthographic) {
        matrix[0] = stretch / (camera->ymag * aspect);
        matrix[5] = 1.0 / camera->ymag;
        matrix[10] = 1.0 / (n - f);
        matrix[12] = camera->shift[0];
        matrix[13] = camera->shift[1];
        matrix[14] = n / (n - f);
        matrix[15] = 1.0;
        return;
    }
    const double scale = 1.0 / scene_tangent_of_half(camera->yfov);
    matrix[0] = scale * stretch / aspect;
    matrix[5] = scale;
    matrix[8] = 0.0 - camera->shift[0]; // the difference is no negative zero
    matrix[9] = 0.0 - camera->shift[1];
    matrix[10] = f == 0.0 ? -1.0 : f / (n - f);
    matrix[14] = f == 0.0 ? -n : n * f / (n - f);
    matrix[11] = -1.0;
}

void scene_matrix_multiply(const double a[16], const double b[16], double product[16])
{
    for (int c = 0; c < 4; c++) {
        for (int r = 0; r < 4; r++) {
            product[4 * c + r] = a[r] * b[4 * c] + a[4 + r] * b[4 * c + 1] + a[8 + r] * b[4 * c + 2] +
                                 a[12 + r] * b[4 * c + 3];
        }
    }
}

// The columns of the cofactor matrix are cross products of the matrix's columns. The sign of the determinant turns it
// into a positive multiple of the transposed inverse.
void scene_matrix_normal(const double matrix[16], double normal[9])
{
    for (int c = 0; c < 3; c++) {
        scene_cross(&matrix[4 * ((c + 1) % 3)], &matrix[4 * ((c + 2) % 3)], &normal[3 * c]);
    }
    if (scene_dot(matrix, normal) < 0.0) {
        for (int i = 0; i < 9; i++) {
            normal[i] = -normal[i];
        }
    }
}
