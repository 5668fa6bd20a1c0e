// SPDX-License-Identifier: MIT
// glslang computes constant expressions by the elementary functions of the C library, which may differ in the last bit
// from machine to machine. The copies of its archives that the build makes call these instead (objcopy --redefine-sym),
// so that a constant expression has the value that a shader of rhw computes, everywhere.
#include <rhw/shader.h>

double glsl_sin(double a);
double glsl_cos(double a);
double glsl_tan(double a);
double glsl_asin(double a);
double glsl_acos(double a);
double glsl_atan(double a);
double glsl_atan2(double y, double x);
double glsl_exp(double a);
double glsl_exp2(double a);
double glsl_log(double a);
double glsl_log2(double a);
double glsl_pow(double a, double b);

double glsl_sin(double a)
{
    return (double)rhw_sin1((float)a);
}

double glsl_cos(double a)
{
    return (double)rhw_cos1((float)a);
}

double glsl_tan(double a)
{
    return (double)rhw_tan1((float)a);
}

double glsl_asin(double a)
{
    return (double)rhw_asin1((float)a);
}

double glsl_acos(double a)
{
    return (double)rhw_acos1((float)a);
}

double glsl_atan(double a)
{
    return (double)rhw_atan1((float)a);
}

double glsl_atan2(double y, double x)
{
    return (double)rhw_atan2_1((float)y, (float)x);
}

double glsl_exp(double a)
{
    return (double)rhw_exp1((float)a);
}

double glsl_exp2(double a)
{
    return (double)rhw_exp2_1((float)a);
}

double glsl_log(double a)
{
    return (double)rhw_log1((float)a);
}

double glsl_log2(double a)
{
    return (double)rhw_log2_1((float)a);
}

double glsl_pow(double a, double b)
{
    return (double)rhw_pow1((float)a, (float)b);
}
