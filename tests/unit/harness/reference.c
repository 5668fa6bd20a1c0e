// SPDX-License-Identifier: MIT
// Scalar model of coverage, weights and formats; see reference.h.
#include "reference.h"

#include <math.h>

// Twice the signed area of (vertex i+1, vertex i+2, p), all in 1/256 pixel: below 2^50.
static int64_t edge(const struct ref_triangle *t, int i, int64_t x_8, int64_t y_8)
{
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    return (t->x_8[k] - t->x_8[j]) * (y_8 - t->y_8[j]) - (t->y_8[k] - t->y_8[j]) * (x_8 - t->x_8[j]);
}

// The top-left rule says: a sample on an edge counts as if it lay an infinitesimal step to the right, and
// if that decides nothing, a still smaller step down. So the sign of an edge function that is zero there is
// the sign of its derivative by x, or else by y.
bool ref_covers(const struct ref_triangle *t, int pixel_x, int pixel_y)
{
    const int64_t x_8 = (int64_t)pixel_x * 256 + 128, y_8 = (int64_t)pixel_y * 256 + 128;
    const int64_t area = edge(t, 0, t->x_8[0], t->y_8[0]);
    if (area == 0) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        int64_t sign = edge(t, i, x_8, y_8);
        if (sign == 0) {
            sign = edge(t, i, x_8 + 1, y_8);
        }
        if (sign == 0) {
            sign = edge(t, i, x_8, y_8 + 1);
        }
        if ((sign > 0) != (area > 0)) {
            return false;
        }
    }
    return true;
}

struct ref_weights ref_weights_at(const struct ref_triangle *t, double x, double y)
{
    struct ref_weights weights = {.w = 0};
    double area = 0, reciprocal = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double xj = (double)t->x_8[j] / 256, yj = (double)t->y_8[j] / 256;
        const double xk = (double)t->x_8[k] / 256, yk = (double)t->y_8[k] / 256;
        weights.screen[i] = (xk - xj) * (y - yj) - (yk - yj) * (x - xj);
        area += weights.screen[i];
    }
    for (int i = 0; i < 3; i++) {
        weights.screen[i] /= area;
        reciprocal += weights.screen[i] / t->w[i];
    }
    weights.w = 1 / reciprocal;
    for (int i = 0; i < 3; i++) {
        weights.space[i] = weights.screen[i] * weights.w / t->w[i];
    }
    return weights;
}

// (x, y, 1) = λ·(a·A + b·B + c·C): Cramer's rule, where λ cancels because a + b + c = 1.
struct ref_weights ref_weights_homogeneous(const double v[3][3], double x, double y)
{
    struct ref_weights weights = {.w = 0};
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const double *p = v[(i + 1) % 3], *q = v[(i + 2) % 3];
        weights.space[i] =
            x * (p[1] * q[2] - p[2] * q[1]) + y * (p[2] * q[0] - p[0] * q[2]) + (p[0] * q[1] - p[1] * q[0]);
        sum += weights.space[i];
    }
    for (int i = 0; i < 3; i++) {
        weights.space[i] /= sum;
        weights.w += weights.space[i] * v[i][2];
    }
    for (int i = 0; i < 3; i++) {
        weights.screen[i] = weights.space[i] * v[i][2] / weights.w;
    }
    return weights;
}

double ref_mix(const double weights[3], const double values[3])
{
    return weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2];
}

// I = N/S with N = Σ e_i·I_i/W_i and S = Σ e_i/W_i, both linear on the screen: I' = (N' − I·S')/S.
double ref_derivative(const struct ref_triangle *t, double x, double y, const double values[3], int axis)
{
    double n = 0, s = 0, dn = 0, ds = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double xj = (double)t->x_8[j] / 256, yj = (double)t->y_8[j] / 256;
        const double dx = (double)(t->x_8[k] - t->x_8[j]) / 256, dy = (double)(t->y_8[k] - t->y_8[j]) / 256;
        const double e = (dx * (y - yj) - dy * (x - xj)) / t->w[i];
        const double de = (axis == 0 ? -dy : dx) / t->w[i];
        n += e * values[i];
        s += e;
        dn += de * values[i];
        ds += de;
    }
    return (dn - n / s * ds) / s;
}

double ref_srgb_encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

double ref_srgb_decode(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

double ref_half(uint16_t bits)
{
    const int exponent = (bits >> 10) & 31, mantissa = bits & 1023;
    const double sign = (bits >> 15) != 0 ? -1 : 1;
    if (exponent == 31) {
        return mantissa != 0 ? NAN : sign * INFINITY;
    }
    if (exponent == 0) {
        return sign * ldexp(mantissa, -24);
    }
    return sign * ldexp(1024 + mantissa, exponent - 25);
}
