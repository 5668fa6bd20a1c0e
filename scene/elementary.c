// SPDX-License-Identifier: MIT
// Sine and cosine come from their series on an eighth of a turn, the exponential from its series between two powers of
// two. Their inverses begin with the library's floats and take one step of Newton's, which doubles the digits.
#include "elementary.h"

#include <float.h>
#include <math.h>
#include <stdint.h>

#include <rhw/shader.h>

static const double pi = 3.14159265358979323846;

// Return the sine for |x| <= pi/4 + a little, by Taylor's series. The first term left out is below 2^-57.
static double sin_small(double x)
{
    const double s = x * x;
    double sum = 1.0;
    for (int n = 17; n >= 3; n -= 2) {
        sum = 1.0 - sum * s / (double)(n * (n - 1));
    }
    return x * sum;
}

static double cos_small(double x)
{
    const double s = x * x;
    double sum = 1.0;
    for (int n = 18; n >= 2; n -= 2) {
        sum = 1.0 - sum * s / (double)(n * (n - 1));
    }
    return sum;
}

// Set the sine and cosine of `quarter` quarter turns and `rest` radians.
static void sin_cos_quarter(int64_t quarter, double rest, double *sine, double *cosine)
{
    const double s = sin_small(rest), c = cos_small(rest);
    const double sines[4] = {s, c, -s, -c};
    *sine = sines[quarter & 3];
    *cosine = sines[(quarter + 1) & 3];
}

void scene_sin_cos_degrees(double degrees, double *sine, double *cosine)
{
    if (!(fabs(degrees) <= DBL_MAX)) {
        *sine = *cosine = (double)NAN;
        return;
    }
    // These are more quarters than an integer need hold. The remainder is exact.
    if (fabs(degrees) >= 0x1p31) {
        degrees = fmod(degrees, 360.0);
    }
    const int64_t quarter = (int64_t)(degrees / 90.0 + (degrees < 0.0 ? -0.5 : 0.5));
    sin_cos_quarter(quarter, (degrees - 90.0 * (double)quarter) * (pi / 180.0), sine, cosine);
}

static void sin_cos(double angle, double *sine, double *cosine)
{
    // π/2 in three parts. The first two parts have 33 bits and a count of quarters below 10^6 has 20, so their products
    // are exact.
    static const double part[3] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
    if (!(fabs(angle) <= DBL_MAX)) {
        *sine = *cosine = (double)NAN;
        return;
    }
    const double near = fabs(angle) <= 1e6 ? angle : fmod(angle, 2 * pi);
    const int64_t quarter = (int64_t)(near * (2 / pi) + (near < 0 ? -0.5 : 0.5));
    const double count = (double)quarter;
    sin_cos_quarter(quarter, ((near - count * part[0]) - count * part[1]) - count * part[2], sine, cosine);
}

double scene_sin(double angle)
{
    double sine, cosine;
    sin_cos(angle, &sine, &cosine);
    return sine;
}

double scene_cos(double angle)
{
    double sine, cosine;
    sin_cos(angle, &sine, &cosine);
    return cosine;
}

double scene_tan(double angle)
{
    double sine, cosine;
    sin_cos(angle, &sine, &cosine);
    return sine / cosine;
}

double scene_atan(double a)
{
    if (!(fabs(a) < 1e18)) {
        return a < 0 ? -pi / 2 : a > 0 ? pi / 2 : a; // NaN stays NaN
    }
    const double first = (double)rhw_atan1((float)a);
    const double s = sin_small(first / 2), c = cos_small(first / 2);
    const double sine = 2 * s * c, cosine = (c - s) * (c + s);
    // The correction is the tangent of the difference, which is below 2^-22.
    return first + (a * cosine - sine) / (cosine + a * sine);
}

double scene_exp(double a)
{
    // ln 2 in two parts. The first part has 33 bits, so its product with a power below 2^11 is exact.
    static const double part[2] = {0x1.62e42fefp-1, 0x1.473de6af278edp-34};
    if (!(a > -745.2)) {
        return a < 0 ? 0 : a; // NaN stays NaN
    }
    if (a > 709.8) {
        return (double)INFINITY;
    }
    const int power = (int)(a / (part[0] + part[1]) + (a < 0 ? -0.5 : 0.5));
    const double x = (a - power * part[0]) - power * part[1];
    double sum = 1;
    // |x| <= 0.35, so the first term left out is below 2^-62.
    for (int n = 14; n >= 1; n--) {
        sum = 1 + sum * x / n;
    }
    return ldexp(sum, power);
}

double scene_log(double a)
{
    if (!(a > 0 && a <= DBL_MAX)) {
        return a == 0 ? -(double)INFINITY : a < 0 ? (double)NAN : a;
    }
    int power;
    double mantissa = frexp(a, &power);
    // The logarithm of 1 has to be that of a mantissa of 1.
    if (mantissa < 0.70710678118654752) {
        mantissa *= 2;
        power--;
    }
    const double first = (double)rhw_log1((float)mantissa);
    const double rest = mantissa * scene_exp(-first) - 1; // the rest is below 2^-22
    return (power * 0x1.62e42fefp-1 + first) + (power * 0x1.473de6af278edp-34 + rest - rest * rest / 2);
}

double scene_pow(double a, double b)
{
    if (b == 0 || a == 1) {
        // C's pow gives 1 too, even where the other argument is infinite or NaN, and for 0^0.
        return 1;
    }
    return scene_exp(b * scene_log(a));
}
