// SPDX-License-Identifier: MIT
// See lesson.h.
#include "lesson.h"

#include <math.h>

struct ref_triangle lesson_triangle(const float clip[3][4], const struct rhw_viewport *viewport)
{
    struct ref_triangle triangle;
    for (int i = 0; i < 3; i++) {
        const double w = (double)clip[i][3];
        const double x = (double)viewport->x + (1 + (double)clip[i][0] / w) / 2 * (double)viewport->width;
        const double y = (double)viewport->y + (1 - (double)clip[i][1] / w) / 2 * (double)viewport->height;
        triangle.x_8[i] = (int64_t)rint(x * 256);
        triangle.y_8[i] = (int64_t)rint(y * 256);
        triangle.w[i] = w;
        triangle.depth[i] = (double)clip[i][2] / w;
    }
    return triangle;
}

void lesson_near(const char *what, int column, int row, float value, double truth, double largest)
{
    int exponent;
    frexp(largest, &exponent);
    const double ulp = ldexp(1, exponent - 24);
    const double difference = fabs((double)value - truth);
    if (!(difference <= 8 * ulp)) {
        fail_msg("%s at %d, %d is %.9g, but the formula gives %.9g: %g ULP apart", what, column, row,
                 (double)value, truth, difference / ulp);
    }
}

void lesson_close(double value, double truth, double tolerance)
{
    if (!(fabs(value - truth) <= tolerance)) {
        fail_msg("%.17g is not within %g of %.17g", value, tolerance, truth);
    }
}

bool lesson_covered(const struct ref_triangle *triangle, int column, int row, bool drawn)
{
    const bool covered = ref_covers(triangle, column, row);
    if (covered != drawn) {
        fail_msg("pixel %d, %d is %s", column, row,
                 drawn ? "drawn, but not covered" : "covered, but not drawn");
    }
    return covered;
}

struct ref_weights lesson_weights(const struct ref_triangle *triangle, int column, int row)
{
    return ref_weights_at(triangle, column + 0.5, row + 0.5);
}

double lesson_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void scale_to_one(double v[3])
{
    const double length = sqrt(lesson_dot(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
}

void lesson_ray(const float eye[3], const float target[3], float zoom, int size, double column, double row,
                double direction[3])
{
    double ahead[3], right[3] = {0}, up[3];
    for (int k = 0; k < 3; k++) {
        ahead[k] = (double)target[k] - (double)eye[k];
    }
    scale_to_one(ahead);
    right[0] = -ahead[2], right[2] = ahead[0];
    scale_to_one(right);
    up[0] = right[1] * ahead[2] - right[2] * ahead[1];
    up[1] = right[2] * ahead[0] - right[0] * ahead[2];
    up[2] = right[0] * ahead[1] - right[1] * ahead[0];
    const double x = (2 * column / size - 1) / (double)zoom, y = (1 - 2 * row / size) / (double)zoom;
    for (int k = 0; k < 3; k++) {
        direction[k] = ahead[k] + x * right[k] + y * up[k];
    }
    scale_to_one(direction);
}

void lesson_run(void **state)
{
    (void)state;
    char name[] = "lesson", directory[] = ".";
    char *arguments[] = {name, directory, NULL};
    assert_int_equal(lesson_main(2, arguments), 0);
}
