// SPDX-License-Identifier: MIT
// Operations on constants. Only those are folded that every back end computes alike from the definition of the
// operation; functions of shader_math.h are left to the back ends.
#include "form.h"

#include <math.h>
#include <string.h>

static float as_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t as_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static uint32_t truth(bool value)
{
    return value ? UINT32_MAX : 0;
}

// These are functions of the maths library where the compiler has no instruction for them, and none is linked.
static float trunc_of(float a)
{
    const bool has_fraction = a > -0x1p23f && a < 0x1p23f;
    return has_fraction ? copysignf((float)(int32_t)a, a) : a;
}

static float floor_of(float a)
{
    const float whole = trunc_of(a);
    return whole > a ? whole - 1.0f : whole;
}

static float ceil_of(float a)
{
    const float whole = trunc_of(a);
    return whole < a ? whole + 1.0f : whole;
}

static bool fold_float(enum shader_op op, float a, float b, uint32_t *result)
{
    switch (op) {
    case SHADER_FADD: *result = as_bits(a + b); break;
    case SHADER_FSUB: *result = as_bits(a - b); break;
    case SHADER_FMUL: *result = as_bits(a * b); break;
    case SHADER_FDIV: *result = as_bits(a / b); break;
    case SHADER_FMIN: *result = as_bits(a < b ? a : b); break;
    case SHADER_FMAX: *result = as_bits(a > b ? a : b); break;
    case SHADER_FSQRT: *result = as_bits(sqrtf(a)); break;
    case SHADER_FLOOR: *result = as_bits(floor_of(a)); break;
    case SHADER_CEIL: *result = as_bits(ceil_of(a)); break;
    case SHADER_TRUNC: *result = as_bits(trunc_of(a)); break;
    default: return false;
    }
    // Which NaN comes of an operation differs from machine to machine.
    return !isnan(as_float(*result));
}

static bool fold_truth(enum shader_op op, const uint32_t v[3], uint32_t *result)
{
    const float a = as_float(v[0]), b = as_float(v[1]);
    switch (op) {
    case SHADER_FEQUAL: *result = truth(a == b); return true;
    case SHADER_FLESS: *result = truth(a < b); return true;
    case SHADER_FLESS_EQUAL: *result = truth(a <= b); return true;
    case SHADER_IEQUAL: *result = truth(v[0] == v[1]); return true;
    case SHADER_ILESS: *result = truth((int32_t)v[0] < (int32_t)v[1]); return true;
    case SHADER_ULESS: *result = truth(v[0] < v[1]); return true;
    default: return false;
    }
}

bool shader_fold(enum shader_op op, const uint32_t v[3], uint32_t *result)
{
    const int32_t a = (int32_t)v[0];
    switch (op) {
    case SHADER_IADD: *result = v[0] + v[1]; return true;
    case SHADER_ISUB: *result = v[0] - v[1]; return true;
    case SHADER_IMUL: *result = v[0] * v[1]; return true;
    case SHADER_AND: *result = v[0] & v[1]; return true;
    case SHADER_OR: *result = v[0] | v[1]; return true;
    case SHADER_XOR: *result = v[0] ^ v[1]; return true;
    case SHADER_NOT: *result = ~v[0]; return true;
    case SHADER_SHIFT_LEFT: *result = v[0] << (v[1] & 31); return true;
    case SHADER_SHIFT_RIGHT: *result = v[0] >> (v[1] & 31); return true;
    case SHADER_SHIFT_RIGHT_SIGNED: *result = (uint32_t)(a >> (v[1] & 31)); return true;
    case SHADER_SELECT: *result = v[0] ? v[1] : v[2]; return true;
    case SHADER_FLOAT_FROM_INT: *result = as_bits((float)a); return true;
    case SHADER_FLOAT_FROM_UINT: *result = as_bits((float)v[0]); return true;
    case SHADER_INT_FROM_FLOAT:
        if (!(fabsf(as_float(v[0])) < 0x1p31f)) {
            return false;
        }
        *result = (uint32_t)(int32_t)as_float(v[0]);
        return true;
    default: break;
    }
    return fold_truth(op, v, result) || fold_float(op, as_float(v[0]), as_float(v[1]), result);
}
