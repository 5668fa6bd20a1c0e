// SPDX-License-Identifier: MIT
// See eye.h.
#include "eye.h"

#include "draw/camera/subject.h"
#include "elementary.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double degree = 3.14159265358979323846 / 180.0;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double product[3])
{
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        product[c] = a[d] * b[e] - a[e] * b[d];
    }
}

static void normalize(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int c = 0; c < 3 && length > 0.0; c++) {
        v[c] /= length;
    }
}

static void add(double point[3], const double way[3], double times)
{
    for (int c = 0; c < 3; c++) {
        point[c] += times * way[c];
    }
}

// Unit vectors to the right of what is seen, upwards and ahead; the distance of the target.
static double axes_of(const struct view_eye *eye, double axes[3][3])
{
    for (int c = 0; c < 3; c++) {
        axes[2][c] = eye->target[c] - eye->eye[c];
    }
    const double distance = sqrt(dot(axes[2], axes[2]));
    normalize(axes[2]);
    cross(axes[2], eye->up, axes[0]);
    normalize(axes[0]);
    cross(axes[0], axes[2], axes[1]);
    return distance;
}

static double half_height(const struct view_eye *eye, double distance)
{
    return eye->orthographic ? 0.5 * eye->height : distance * scene_tan(0.5 * eye->fovy * degree);
}

static double to_digits(double number, int digits)
{
    char text[32];
    snprintf(text, sizeof text, "%.*g", digits, number);
    return strtod(text, NULL);
}

static void round_all(struct view_eye *eye)
{
    const int digits = scene_camera_digits(eye->eye, eye->target);
    for (int c = 0; c < 3; c++) {
        eye->eye[c] = to_digits(eye->eye[c], digits);
        eye->target[c] = to_digits(eye->target[c], digits);
        eye->up[c] = to_digits(eye->up[c], 9);
    }
    eye->fovy = to_digits(eye->fovy, 9);
    eye->height = to_digits(eye->height, 9);
}

// Without perspective nobody sees from where: as far back as the model is large, so that nothing of it comes to lie
// behind the eye when that turns around it. An eye that stands within the model stays, since it cuts that open.
static void step_back(struct view_eye *eye, const double ahead[3], const struct scene_model *model)
{
    const struct scene_box frame = scene_subject_frame(model);
    double nearest = 0.0, size2 = 0.0;
    for (int c = 0; c < 3; c++) {
        const double low = frame.low[c], high = frame.high[c];
        const double own = eye->eye[c] - model->origin[c];
        nearest += ((ahead[c] > 0.0 ? low : high) - own) * ahead[c];
        size2 += (high - low) * (high - low);
    }
    if (nearest >= 0.0) {
        add(eye->eye, ahead, -sqrt(size2));
    }
}

void view_eye_set(struct view_eye *eye, const struct scene_camera *camera, const struct scene_model *model)
{
    double axes[3][3], center[3], size[3];
    *eye = (struct view_eye){
        .orthographic = camera->orthographic, .fovy = camera->yfov / degree, .height = 2.0 * camera->ymag};
    memcpy(eye->eye, camera->eye, sizeof eye->eye);
    memcpy(eye->target, camera->target, sizeof eye->target);
    memcpy(eye->up, camera->up, sizeof eye->up);
    axes_of(eye, axes);
    memcpy(eye->up, axes[1], sizeof eye->up);
    const struct scene_box frame = scene_subject_frame(model);
    for (int c = 0; c < 3; c++) {
        const double low = frame.low[c], high = frame.high[c];
        center[c] = 0.5 * (low + high) - (camera->eye[c] - model->origin[c]);
        size[c] = high - low;
    }
    const double ahead = dot(center, axes[2]), least = 0.05 * sqrt(dot(size, size));
    const double distance = ahead > least ? ahead : least > 0.0 ? least : 1.0;
    memcpy(eye->target, eye->eye, sizeof eye->target);
    add(eye->target, axes[2], distance);
    if (eye->orthographic) {
        step_back(eye, axes[2], model);
    }
    round_all(eye);
}

// The direction ahead, turned; stops short of looking straight up or down, where right and left would change places.
static void turn(double axes[3][3], const double vertical[3], double right, double up, double turned[3])
{
    const double most = 89.5 * degree;
    const double *const ahead = axes[2];
    double side[3], level[3];
    cross(ahead, vertical, side);
    if (dot(side, side) < 1e-12) {
        memcpy(side, axes[0], sizeof side);
    }
    normalize(side);
    cross(vertical, side, level); // ahead, without its part upwards
    const double sine = dot(ahead, vertical);
    const double rises = asin(sine > 1.0 ? 1.0 : sine < -1.0 ? -1.0 : sine) + up;
    const double elevation = rises > most ? most : rises < -most ? -most : rises;
    for (int c = 0; c < 3; c++) {
        turned[c] = (level[c] * scene_cos(right) + side[c] * scene_sin(right)) * scene_cos(elevation) +
                    vertical[c] * scene_sin(elevation);
    }
}

void view_eye_orbit(struct view_eye *eye, const double vertical[3], double right, double up)
{
    double axes[3][3], ahead[3];
    const double distance = axes_of(eye, axes);
    turn(axes, vertical, right, up, ahead);
    memcpy(eye->eye, eye->target, sizeof eye->eye);
    memcpy(eye->up, vertical, sizeof eye->up);
    add(eye->eye, ahead, -distance);
    round_all(eye);
}

void view_eye_turn(struct view_eye *eye, const double vertical[3], double right, double up)
{
    double axes[3][3], ahead[3];
    const double distance = axes_of(eye, axes);
    turn(axes, vertical, right, up, ahead);
    memcpy(eye->target, eye->eye, sizeof eye->target);
    memcpy(eye->up, vertical, sizeof eye->up);
    add(eye->target, ahead, distance);
    round_all(eye);
}

static void move(struct view_eye *eye, double axes[3][3], double right, double up, double ahead)
{
    const double way[3] = {right, up, ahead};
    for (int i = 0; i < 3; i++) {
        add(eye->eye, axes[i], way[i]);
        add(eye->target, axes[i], way[i]);
    }
}

void view_eye_pan(struct view_eye *eye, double right, double up)
{
    double axes[3][3];
    const double height = 2.0 * half_height(eye, axes_of(eye, axes));
    move(eye, axes, -right * height, -up * height, 0.0);
    round_all(eye);
}

void view_eye_zoom(struct view_eye *eye, double right, double up, double factor)
{
    double axes[3][3];
    const double distance = axes_of(eye, axes), half = half_height(eye, distance);
    move(eye, axes, right * half * (1.0 - factor), up * half * (1.0 - factor), 0.0);
    if (eye->orthographic) {
        eye->height *= factor;
    } else {
        memcpy(eye->eye, eye->target, sizeof eye->eye);
        add(eye->eye, axes[2], -distance * factor);
    }
    round_all(eye);
}

void view_eye_fly(struct view_eye *eye, const double way[3])
{
    double axes[3][3];
    const double distance = axes_of(eye, axes);
    move(eye, axes, way[0], way[1], eye->orthographic ? 0.0 : way[2]);
    eye->height *= scene_exp(-way[2] / distance);
    round_all(eye);
}

void view_eye_fit(struct view_eye *eye, const double middle[3], double radius, double aspect)
{
    double axes[3][3];
    const double before = axes_of(eye, axes), half = 0.5 * eye->fovy * degree,
                 across = scene_atan(scene_tan(half) * aspect);
    memcpy(eye->target, middle, sizeof eye->target);
    memcpy(eye->eye, middle, sizeof eye->eye);
    if (eye->orthographic) {
        eye->height = 2.0 * radius / (aspect < 1.0 ? aspect : 1.0);
        add(eye->eye, axes[2], -(before > 2.0 * radius ? before : 2.0 * radius));
    } else {
        add(eye->eye, axes[2], -radius / scene_sin(across < half ? across : half));
    }
    round_all(eye);
}

double view_eye_scale(const struct view_eye *eye)
{
    double axes[3][3];
    const double distance = axes_of(eye, axes);
    return eye->orthographic ? eye->height : distance;
}

void view_eye_numbers(const struct view_eye *eye, double numbers[10])
{
    memcpy(numbers, eye->eye, sizeof eye->eye);
    memcpy(numbers + 3, eye->target, sizeof eye->target);
    memcpy(numbers + 6, eye->up, sizeof eye->up);
    numbers[9] = eye->orthographic ? eye->height : eye->fovy;
}
