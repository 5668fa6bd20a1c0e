// SPDX-License-Identifier: MIT
// Cameras: angles to vectors, vectors to matrices, and the fit of a model into the view.
//
// The fit is exact, not an iteration: for a fixed orientation each vertex bounds the eye's place by linear
// inequalities, and their extreme values over all vertices give the nearest eye in closed form.
#include "camera.h"

#include <float.h>
#include <stdio.h>

#include "elementary.h"

static const double pi = 3.14159265358979323846;
static const double fit_margin = 0.04; // of the picture, on each side

static double tangent_of_half(double angle)
{
    double s, c;
    scene_sin_cos_degrees(angle * (90.0 / pi), &s, &c);
    return s / c;
}

static double square_root(double a)
{
    return __builtin_sqrt(a);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double result[3])
{
    result[0] = a[1] * b[2] - a[2] * b[1];
    result[1] = a[2] * b[0] - a[0] * b[2];
    result[2] = a[0] * b[1] - a[1] * b[0];
}

// False where there is no direction.
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
    const double length = square_root(dot(scaled, scaled));
    for (int i = 0; i < 3; i++) {
        a[i] = scaled[i] / length;
    }
    return true;
}

static bool finite3(const double a[3])
{
    return a[0] - a[0] == 0.0 && a[1] - a[1] == 0.0 && a[2] - a[2] == 0.0;
}

// Right, up and backward: the rows of the view matrix.
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
    cross(wanted, back, right);
    const double nearly_parallel = 1e-12 * dot(wanted, wanted);
    if (!normalize(wanted) || dot(right, right) <= nearly_parallel || !normalize(right)) {
        // Looking along `up`: take the axis that is furthest from the view instead.
        const double other[3] = {0.0, back[1] * back[1] < 0.5 ? 1.0 : 0.0,
                                 back[1] * back[1] < 0.5 ? 0.0 : -1.0};
        cross(other, back, right);
        normalize(right);
    }
    cross(back, right, up);
}

double scene_camera_default_yfov(void)
{
    return 30.0 * (pi / 180.0);
}

static void transform_point(const float m[16], const float p[3], double result[3])
{
    for (int i = 0; i < 3; i++) {
        result[i] = (double)m[i] * (double)p[0] + (double)m[4 + i] * (double)p[1] +
                    (double)m[8 + i] * (double)p[2] + (double)m[12 + i];
    }
}

// The component along `axis` of the sum of all triangles' area vectors: which way a flat model faces.
static double facing(const struct scene_model *model, int axis)
{
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double sum = 0.0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *instance = &model->instances[i];
        const struct scene_mesh *mesh = &model->meshes[instance->mesh];
        if (mesh->primitive != SCENE_PRIMITIVE_TRIANGLES) {
            continue;
        }
        double part = 0.0;
        for (uint32_t k = 0; k + 2 < mesh->index_count; k += 3) {
            double p[3][3];
            for (int c = 0; c < 3; c++) {
                transform_point(instance->world, mesh->positions[mesh->indices[k + (uint32_t)c]], p[c]);
            }
            part += (p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) - (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]);
        }
        sum += instance->mirrored ? -part : part;
    }
    return sum;
}

struct scene_orbit scene_camera_default_orbit(const struct scene_model *model)
{
    const double flat = 0.06;
    double extent[3], largest = 0.0;
    for (int i = 0; i < 3; i++) {
        extent[i] = (double)model->bounds_max[i] - (double)model->bounds_min[i];
        largest = extent[i] > largest ? extent[i] : largest;
    }
    struct scene_orbit orbit = {30.0, 20.0};
    if (extent[2] <= flat * largest) {
        orbit = (struct scene_orbit){facing(model, 2) < 0.0 ? 180.0 : 0.0, 0.0};
    } else if (extent[0] <= flat * largest) {
        orbit = (struct scene_orbit){facing(model, 0) < 0.0 ? -90.0 : 90.0, 0.0};
    } else if (extent[1] <= flat * largest) {
        orbit.elevation = facing(model, 1) < 0.0 ? -40.0 : 40.0;
    }
    return orbit;
}

// Extreme values over all vertices, in camera axes (right, up, back).
struct fit {
    double tan_x, tan_y;
    double x_plus, x_minus; // max of x + tan_x z, min of x − tan_x z
    double y_plus, y_minus;
    double z_min, z_max;
    uint64_t count;
};

static void fit_vertex(struct fit *fit, const double p[3])
{
    const double values[4] = {p[0] + fit->tan_x * p[2], p[0] - fit->tan_x * p[2], p[1] + fit->tan_y * p[2],
                              p[1] - fit->tan_y * p[2]};
    fit->x_plus = values[0] > fit->x_plus ? values[0] : fit->x_plus;
    fit->x_minus = values[1] < fit->x_minus ? values[1] : fit->x_minus;
    fit->y_plus = values[2] > fit->y_plus ? values[2] : fit->y_plus;
    fit->y_minus = values[3] < fit->y_minus ? values[3] : fit->y_minus;
    fit->z_min = p[2] < fit->z_min ? p[2] : fit->z_min;
    fit->z_max = p[2] > fit->z_max ? p[2] : fit->z_max;
    fit->count++;
}

// Model space to camera axes for one instance, in double: 3 rows of 4.
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

static void fit_model(const struct scene_model *model, const double axes[3][3], struct fit *fit)
{
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_instance *instance = &model->instances[i];
        const struct scene_mesh *mesh = &model->meshes[instance->mesh];
        double rows[3][4];
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
            if (used && finite3(q)) {
                fit_vertex(fit, q);
            }
        }
    }
}

// Near and far planes around the model's boxes. Something behind the eye puts the near plane at a small
// part of the far one; the drawing code reverses depth, so the ratio costs no precision.
static void fit_planes(struct scene_camera *camera, const struct scene_model *model)
{
    double axes[3][3];
    camera_axes(camera, axes[0], axes[1], axes[2]);
    const double eye = dot(axes[2], camera->eye);
    double nearest = DBL_MAX, furthest = -DBL_MAX;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_mesh *mesh = &model->meshes[model->instances[i].mesh];
        for (int corner = 0; corner < 8; corner++) {
            const float p[3] = {(corner & 1 ? mesh->bounds_max : mesh->bounds_min)[0],
                                (corner & 2 ? mesh->bounds_max : mesh->bounds_min)[1],
                                (corner & 4 ? mesh->bounds_max : mesh->bounds_min)[2]};
            double q[3];
            transform_point(model->instances[i].world, p, q);
            const double distance = eye - dot(axes[2], q);
            if (finite3(q)) {
                nearest = distance < nearest ? distance : nearest;
                furthest = distance > furthest ? distance : furthest;
            }
        }
    }
    const double fallback = 1.0;
    camera->zfar = furthest > 0.0 ? furthest * 1.001 : fallback;
    const double closest = camera->zfar / 8192.0;
    camera->znear = nearest * 0.999 > closest && nearest <= furthest ? nearest * 0.999 : closest;
}

struct scene_camera scene_camera_fit(const struct scene_model *model, struct scene_orbit orbit, double yfov,
                                     double aspect)
{
    double sin_a, cos_a, sin_e, cos_e;
    scene_sin_cos_degrees(orbit.azimuth, &sin_a, &cos_a);
    scene_sin_cos_degrees(orbit.elevation, &sin_e, &cos_e);
    struct scene_camera camera = {.yfov = yfov};
    // At ±90 degrees `back` is vertical; this `up` is right at every angle in between.
    const double back[3] = {cos_e * sin_a, sin_e, cos_e * cos_a};
    const double up[3] = {-sin_e * sin_a, cos_e, -sin_e * cos_a};
    double right[3];
    cross(up, back, right);
    const double axes[3][3] = {
        {right[0], right[1], right[2]}, {up[0], up[1], up[2]}, {back[0], back[1], back[2]}};

    const double tan_y = tangent_of_half(yfov) * (1.0 - 2.0 * fit_margin);
    struct fit fit = {.tan_x = tan_y * aspect,
                      .tan_y = tan_y,
                      .x_plus = -DBL_MAX,
                      .x_minus = DBL_MAX,
                      .y_plus = -DBL_MAX,
                      .y_minus = DBL_MAX,
                      .z_min = DBL_MAX,
                      .z_max = -DBL_MAX};
    fit_model(model, axes, &fit);
    double place[3] = {0.0, 0.0, 4.0}, distance = 4.0; // in camera axes
    if (fit.count > 0) {
        // x − e_x <= tan_x (e_z − z) and its mirror image, for every vertex:
        // x_plus − tan_x e_z <= e_x <= x_minus + tan_x e_z; the smallest e_z that leaves an e_x.
        const double z_x = (fit.x_plus - fit.x_minus) / (2.0 * fit.tan_x);
        const double z_y = (fit.y_plus - fit.y_minus) / (2.0 * fit.tan_y);
        place[0] = 0.5 * (fit.x_plus + fit.x_minus);
        place[1] = 0.5 * (fit.y_plus + fit.y_minus);
        place[2] = z_x > z_y ? z_x : z_y;
        // All of a long model may lie in the picture as seen from its own near end: stay off by a fifth of its
        // length. A single point has no length: step back far enough for floats to tell.
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
        camera.eye[i] = right[i] * place[0] + up[i] * place[1] + back[i] * place[2];
        camera.target[i] = camera.eye[i] - back[i] * distance;
        camera.up[i] = up[i];
    }
    fit_planes(&camera, model);
    return camera;
}

bool scene_camera_look(struct scene_camera *camera, const struct scene_model *model, const double eye[3],
                       const double target[3], const double up[3], double yfov, char *error,
                       size_t error_size)
{
    const double direction[3] = {target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]};
    const char *cause = NULL;
    if (!finite3(eye) || !finite3(target) || !finite3(up)) {
        cause = "every number must be finite";
    } else if (!(dot(direction, direction) > 0.0) || !finite3(direction)) {
        cause = "eye and target must be different points";
    } else if (!(dot(up, up) > 0.0)) {
        cause = "up must not be zero";
    } else if (!(yfov >= 0.01 * (pi / 180.0) && yfov <= 179.0 * (pi / 180.0))) {
        cause = "the field of view must lie between 0.01 and 179 degrees";
    }
    if (cause) {
        snprintf(error, error_size, "not a camera: %s", cause);
        return false;
    }
    *camera = (struct scene_camera){.yfov = yfov};
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = eye[i];
        camera->target[i] = target[i];
        camera->up[i] = up[i];
    }
    fit_planes(camera, model);
    return true;
}

struct scene_camera scene_camera_from_model(const struct scene_model_camera *source, double aspect)
{
    struct scene_camera camera = {.orthographic = source->orthographic};
    for (int i = 0; i < 3; i++) {
        camera.eye[i] = (double)source->world[12 + i];
        camera.up[i] = (double)source->world[4 + i];
        camera.target[i] = camera.eye[i] - (double)source->world[8 + i];
    }
    if (source->orthographic) {
        const double from_width = (double)source->xmag / aspect;
        camera.ymag = from_width > (double)source->ymag ? from_width : (double)source->ymag;
    } else {
        camera.yfov = (double)source->yfov;
        if ((double)source->aspect > aspect) {
            // A narrower picture than the camera's: keep its width by a taller angle. The arc tangent by
            // iteration: (w c − s) / (c + w s) is the tangent t of what is missing, t / (1 + 0.28 t²) within
            // 0.005 of its angle.
            const double wanted = tangent_of_half(camera.yfov) * (double)source->aspect / aspect;
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
        matrix[12 + r] = -dot(axes[r], camera->eye);
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
    if (camera->orthographic) {
        matrix[0] = 1.0 / (camera->ymag * aspect);
        matrix[5] = 1.0 / camera->ymag;
        matrix[10] = 1.0 / (n - f);
        matrix[14] = n / (n - f);
        matrix[15] = 1.0;
        return;
    }
    const double scale = 1.0 / tangent_of_half(camera->yfov);
    matrix[0] = scale / aspect;
    matrix[5] = scale;
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

// Columns of the cofactor matrix are cross products of the matrix's columns; the sign of the determinant
// turns it into a positive multiple of the transposed inverse.
void scene_matrix_normal(const double matrix[16], double normal[9])
{
    for (int c = 0; c < 3; c++) {
        cross(&matrix[4 * ((c + 1) % 3)], &matrix[4 * ((c + 2) % 3)], &normal[3 * c]);
    }
    if (dot(matrix, normal) < 0.0) {
        for (int i = 0; i < 9; i++) {
            normal[i] = -normal[i];
        }
    }
}
