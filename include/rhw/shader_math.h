// SPDX-License-Identifier: MIT
// These are the elementary functions of 8 lanes. shader_one.h has them for one float. shader.h includes this header.
//
// rhw has its own functions because a C library may give other bits on the next machine. Each function uses IEEE
// operations in a fixed order, without contraction and without tables, so that every compiler and instruction set gives
// the same bits. The polynomials are minimax fits (Remez) for the interval that the reduction leaves.
//
// A stated error is a bound on what was measured against correctly rounded results: every float of the range where the
// function bends, and every 19th float elsewhere. Functions of two arguments were measured on 2 · 10^8 pairs, half of
// them random bits. tests/unit/shader/test_shader_math.c measures the errors again on samples. Denormal arguments and
// results are cases like any other. The sign and payload of a NaN result are unspecified.
#ifndef RHW_SHADER_MATH_H
#define RHW_SHADER_MATH_H

#include "shader_vector.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

// Helpers -------------------------------------------------------------------------------------------

// Inner steps use 8 doubles in two halves, because most instruction sets have no register for 8 doubles.
typedef double rhw_double4 __attribute__((vector_size(32)));
typedef double rhw_double2 __attribute__((vector_size(16)));
typedef float rhw_float2 __attribute__((vector_size(8)));
struct rhw_double8 {
    rhw_double4 low, high;
};

static inline struct rhw_double8 rhw_to_double(rhw_float a)
{
    struct rhw_double8 result;
#if defined(__AVX2__)
    result.low = (rhw_double4)_mm256_cvtps_pd(_mm256_castps256_ps128((__m256)a));
    result.high = (rhw_double4)_mm256_cvtps_pd(_mm256_extractf128_ps((__m256)a, 1));
#elif defined(__SSE2__)
    __m128 half[2];
    memcpy(half, &a, sizeof a);
    const __m128d quarter[4] = {_mm_cvtps_pd(half[0]), _mm_cvtps_pd(_mm_movehl_ps(half[0], half[0])),
                                _mm_cvtps_pd(half[1]), _mm_cvtps_pd(_mm_movehl_ps(half[1], half[1]))};
    memcpy(&result, quarter, sizeof result);
#else
    rhw_float2 quarter[4];
    rhw_double2 wide[4];
    memcpy(quarter, &a, sizeof a);
    for (int i = 0; i < 4; i++) {
        wide[i] = __builtin_convertvector(quarter[i], rhw_double2);
    }
    memcpy(&result, wide, sizeof result);
#endif
    return result;
}

static inline rhw_float rhw_from_double(struct rhw_double8 a)
{
#if defined(__AVX2__)
    const __m256 low = _mm256_castps128_ps256(_mm256_cvtpd_ps((__m256d)a.low));
    return (rhw_float)_mm256_insertf128_ps(low, _mm256_cvtpd_ps((__m256d)a.high), 1);
#elif defined(__SSE2__)
    __m128d quarter[4];
    memcpy(quarter, &a, sizeof a);
    __m128 half[2];
    for (int i = 0; i < 2; i++) {
        half[i] = _mm_movelh_ps(_mm_cvtpd_ps(quarter[2 * i]), _mm_cvtpd_ps(quarter[2 * i + 1]));
    }
    rhw_float result;
    memcpy(&result, half, sizeof result);
    return result;
#elif defined(__wasm_simd128__)
    v128_t quarter[4];
    memcpy(quarter, &a, sizeof a);
    for (int i = 0; i < 4; i++) {
        quarter[i] = wasm_f32x4_demote_f64x2_zero(quarter[i]);
    }
    const v128_t half[2] = {wasm_i64x2_shuffle(quarter[0], quarter[1], 0, 2),
                            wasm_i64x2_shuffle(quarter[2], quarter[3], 0, 2)};
    rhw_float result;
    memcpy(&result, half, sizeof result);
    return result;
#else
    rhw_float2 quarter[4];
    rhw_double2 wide[4];
    memcpy(wide, &a, sizeof a);
    for (int i = 0; i < 4; i++) {
        quarter[i] = __builtin_convertvector(wide[i], rhw_float2);
    }
    rhw_float result;
    memcpy(&result, quarter, sizeof result);
    return result;
#endif
}

// Return the square root of 2 doubles, correctly rounded. C's sqrt may set errno, so it is not called where an
// instruction does.
static inline rhw_double2 rhw_sqrt_double2(rhw_double2 a)
{
#if defined(__SSE2__)
    return (rhw_double2)_mm_sqrt_pd((__m128d)a);
#elif defined(__aarch64__)
    return (rhw_double2)vsqrtq_f64((float64x2_t)a);
#elif defined(__wasm_simd128__)
    return (rhw_double2)wasm_f64x2_sqrt((v128_t)a);
#else
    return (rhw_double2){__builtin_sqrt(a[0]), __builtin_sqrt(a[1])};
#endif
}

// Return the square root of 4 doubles, correctly rounded.
static inline rhw_double4 rhw_sqrt_double(rhw_double4 a)
{
#if defined(__AVX2__)
    return (rhw_double4)_mm256_sqrt_pd((__m256d)a);
#else
    rhw_double2 half[2];
    memcpy(half, &a, sizeof a);
    half[0] = rhw_sqrt_double2(half[0]);
    half[1] = rhw_sqrt_double2(half[1]);
    memcpy(&a, half, sizeof a);
    return a;
#endif
}

/// Return infinity in all lanes.
static inline rhw_float rhw_infinity(void)
{
    return (rhw_float)rhw_splat_int(0x7f800000);
}

/// Return a quiet NaN in all lanes.
static inline rhw_float rhw_nan(void)
{
    return (rhw_float)rhw_splat_int(0x7fc00000);
}

// Return 2^n, for −126 ≤ n ≤ 127.
static inline rhw_float rhw_power_of_two(rhw_int n)
{
    return (rhw_float)((n + 127) << 23);
}

// Return a · 2^n for −300 < n < 250, rounded once. The first factor keeps the product normal.
static inline rhw_float rhw_scale_exp2(rhw_float a, rhw_int n)
{
    const rhw_int first = n >> 1;
    return a * rhw_power_of_two(first) * rhw_power_of_two(n - first);
}

// Return 2^f for |f| ≤ 0.501.
static inline rhw_float rhw_exp2_fraction(rhw_float f)
{
    const rhw_float square = f * f;
    const rhw_float upper =
        (0.00961800385f * f + 0.055503279f) + square * (0.000154763024f * f + 0.00134002347f);
    const rhw_float q = 0.693147182f + f * (0.240226507f + f * upper);
    return 1.0f + f * q;
}

// Exponential and logarithm -------------------------------------------------------------------------

/// Return 2^a. The largest error is 1.25 ULP.
static inline rhw_float rhw_exp2(rhw_float a)
{
    // Beyond these bounds the result is infinity or 0.
    const rhw_float x = rhw_clamp(a, rhw_splat(-151.0f), rhw_splat(129.0f));
    const rhw_float n = rhw_round(x);
    const rhw_float result = rhw_scale_exp2(rhw_exp2_fraction(x - n), rhw_int_from_float_unchecked(n));
    return rhw_select(rhw_equal(a, a), result, a);
}

/// Return e^a. The largest error is 1.05 ULP.
static inline rhw_float rhw_exp(rhw_float a)
{
    const rhw_float x = rhw_clamp(a, rhw_splat(-105.0f), rhw_splat(90.0f));
    const rhw_float n = rhw_round(x * 1.44269502f);
    // ln 2 has two parts. The first part has 11 significant bits and n has 8, so their product is exact.
    const rhw_float r = (x - n * 0.693115234375f) - n * 3.19461849e-05f;
    rhw_float q = r * 0.00139505987f + 0.00836889632f;
    q = q * r + 0.0416662022f;
    q = q * r + 0.166665182f;
    q = q * r + 0.5f;
    const rhw_float result = rhw_scale_exp2(1.0f + (r + r * r * q), rhw_int_from_float_unchecked(n));
    return rhw_select(rhw_equal(a, a), result, a);
}

// Split a finite a > 0 into m · 2^e with sqrt(1/2) ≤ m < sqrt(2). Return m.
static inline rhw_float rhw_split_exponent(rhw_float a, rhw_float *e)
{
    const rhw_int tiny = rhw_less(a, rhw_splat(1.17549435e-38f)); // a is denormal
    const rhw_uint pattern = (rhw_uint)rhw_select(tiny, a * 8388608.0f, a);
    const rhw_int bits = (rhw_int)(pattern - 0x3f3504f3u); // bits of sqrt(1/2); a negative `a` wraps
    *e = rhw_float_from_int((bits >> 23) + (tiny & -23));
    return (rhw_float)((bits & 0x7fffff) + 0x3f3504f3);
}

// Return `result` for 0 < a < infinity, and the special value of the logarithm for another a.
static inline rhw_float rhw_log_special(rhw_float a, rhw_float result)
{
    const rhw_int positive = rhw_less(rhw_splat(0.0f), a);
    const rhw_float other = rhw_select(rhw_equal(a, rhw_splat(0.0f)), -rhw_infinity(), rhw_nan());
    result = rhw_select(rhw_equal(a, rhw_infinity()), a, result);
    return rhw_select(positive, result, other);
}

/// Return the logarithm of a to base 2. 0 gives −infinity, and a negative a gives NaN. The largest error is 1.25 ULP.
static inline rhw_float rhw_log2(rhw_float a)
{
    rhw_float e;
    const rhw_float f = rhw_split_exponent(a, &e) - 1.0f;
    rhw_float q = f * -0.112882487f + 0.187608078f;
    q = q * f - 0.190549925f;
    q = q * f + 0.20433718f;
    q = q * f - 0.239650175f;
    q = q * f + 0.288582474f;
    q = q * f - 0.36069563f;
    q = q * f + 0.480897993f;
    q = q * f - 0.721347392f;
    // f · log2(e) is most of the result. It is formed as the exact product of two upper halves, and the rest.
    const rhw_float upper = (rhw_float)((rhw_int)f & -4096);
    const rhw_float rest = (f - upper) * 1.4423828125f + f * 0.000312228389f;
    return rhw_log_special(a, e + (upper * 1.4423828125f + (rest + f * f * q)));
}

/// Return the natural logarithm of a. 0 gives −infinity, and a negative a gives NaN. The largest error is 0.95 ULP.
static inline rhw_float rhw_log(rhw_float a)
{
    rhw_float e;
    const rhw_float f = rhw_split_exponent(a, &e) - 1.0f;
    rhw_float q = f * -0.0786522627f + 0.128790736f;
    q = q * f - 0.131253272f;
    q = q * f + 0.14181444f;
    q = q * f - 0.166249692f;
    q = q * f + 0.200022817f;
    q = q * f - 0.250007957f;
    q = q * f + 0.333333164f;
    const rhw_float square = f * f;
    const rhw_float small = e * 3.19461849e-05f + (square * f * q - 0.5f * square);
    return rhw_log_special(a, e * 0.693115234375f + (f + small));
}

// Return log2(m · 2^e) in double for one half of the lanes. rhw_split_exponent gives m and e.
static inline rhw_double4 rhw_log2_double(rhw_double4 m, rhw_double4 e)
{
    // log2(m) is 2/ln2 · atanh(s) with s = (m − 1)/(m + 1).
    const rhw_double4 s = (m - 1.0) / (m + 1.0);
    const rhw_double4 z = s * s;
    const rhw_double4 square = z * z;
    const rhw_double4 q =
        (z * 0.57707795328895595 + 0.96179669405739665) +
        square * ((z * 0.31993509897601885 + 0.41220839314282687) + square * 0.28253534687468967);
    return e + s * (2.8853900817779268 + z * q);
}

// Return a^b for finite a > 0 and finite b.
static inline rhw_float rhw_pow_positive(rhw_float a, rhw_float b)
{
    // b · log2(a) is formed in double, because its fraction must keep 24 bits beside an integer part of 8 bits.
    rhw_float e;
    const struct rhw_double8 m = rhw_to_double(rhw_split_exponent(a, &e));
    const struct rhw_double8 exponent = rhw_to_double(e);
    const struct rhw_double8 power = rhw_to_double(b);
    struct rhw_double8 product;
    product.low = power.low * rhw_log2_double(m.low, exponent.low);
    product.high = power.high * rhw_log2_double(m.high, exponent.high);
    const rhw_float coarse = rhw_clamp(rhw_from_double(product), rhw_splat(-151.0f), rhw_splat(129.0f));
    const rhw_float n = rhw_round(coarse);
    const struct rhw_double8 whole = rhw_to_double(n);
    product.low -= whole.low;
    product.high -= whole.high;
    const rhw_float half = rhw_splat(0.501f); // clamps the fraction of a product that was clamped
    const rhw_float f = rhw_clamp(rhw_from_double(product), -half, half);
    return rhw_scale_exp2(rhw_exp2_fraction(f), rhw_int_from_float_unchecked(n));
}

// Return a^b. `result` is |a|^b where rhw_pow_positive is defined, and any value elsewhere.
static inline rhw_float rhw_pow_special(rhw_float a, rhw_float b, rhw_float result)
{
    const rhw_float zero = rhw_splat(0.0f), one = rhw_splat(1.0f), magnitude = rhw_abs(a);
    // If |a| is 0 or infinity, the sign of b decides whether the result is 0 or infinity.
    const rhw_int large = rhw_less(one, magnitude), grows = rhw_equal_int(large, rhw_less(zero, b));
    const rhw_int extreme = rhw_equal(magnitude, zero) | rhw_equal(magnitude, rhw_infinity());
    const rhw_int edge = extreme | rhw_equal(rhw_abs(b), rhw_infinity());
    result = rhw_select(edge, rhw_select(grows, rhw_infinity(), zero), result);
    // The result takes the sign of a negative base if b is odd.
    const rhw_int is_whole = rhw_equal(rhw_floor(b), b);
    const rhw_int odd = is_whole & ~rhw_equal(rhw_floor(0.5f * b), 0.5f * b);
    result = (rhw_float)((rhw_int)result ^ ((rhw_int)a & odd & INT32_MIN));
    const rhw_int negative = rhw_less(a, zero) & ~extreme;
    result = rhw_select(negative & ~is_whole, rhw_nan(), result);
    result = rhw_select(rhw_equal(a, a) & rhw_equal(b, b), result, rhw_nan());
    const rhw_int unity = rhw_equal(magnitude, one) & rhw_equal(rhw_abs(b), rhw_infinity());
    return rhw_select(rhw_equal(b, zero) | rhw_equal(a, one) | unity, one, result);
}

/// Return a^b with the special cases of C's pow. A negative a with a b that is not whole gives NaN. Anything to the 0
/// is 1, and 1 to anything is 1, NaN included. The largest error found is 1.4 ULP.
static inline rhw_float rhw_pow(rhw_float a, rhw_float b)
{
    const rhw_float result = rhw_pow_positive(rhw_abs(a), b);
    // Shading mostly has 0 <= a and 0 < b, both finite. The bits tell; they exclude an a of −0.
    const rhw_int end = rhw_splat_int(0x7f800000), bits = (rhw_int)a;
    const rhw_int usual = ~(bits >> 31) & rhw_less_int(bits, end) &
                          rhw_less_int(rhw_splat_int(0), (rhw_int)b) & rhw_less_int((rhw_int)b, end);
    if (rhw_all(usual)) {
        return (rhw_float)((rhw_int)result & ~rhw_equal_int(bits, rhw_splat_int(0)));
    }
    return rhw_pow_special(a, b, result);
}

// Trigonometry --------------------------------------------------------------------------------------

// Reduce one |a| ≥ 2^15 by multiples of π/2, after M. Payne and R. Hanek (1983). Only the bits of 2/π that matter
// modulo 4 are multiplied. Return NaN if a is not finite.
static inline float rhw_reduce_large(float a, int32_t *quadrant)
{
    // The words have 2/π from the binary point on, after 32 zeros.
    static const uint32_t words[8] = {0,          0xa2f9836e, 0x4e441529, 0xfc2757d1,
                                      0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab};
    uint32_t bits;
    memcpy(&bits, &a, sizeof bits);
    const int exponent = (int)(bits >> 23 & 0xff) - 127;
    *quadrant = 0;
    if (exponent == 128) {
        return a - a;
    }
    // |a| is m · 2^(exponent − 23). The window starts at the bit whose product is worth 2.
    const uint64_t m = (bits & 0x7fffff) | 0x800000;
    const int start = exponent - 25 + 32;
    const uint32_t *const word = words + start / 32;
    const int shift = start % 32;
    uint64_t window[3];
    for (int i = 0; i < 3; i++) {
        window[i] = ((uint64_t)word[i] << 32 | word[i + 1]) >> (32 - shift) & 0xffffffffu;
    }
    // `turns` is a number of turns, modulo 1, in units of 2^-64. The quadrant is the nearest quarter turn.
    const uint64_t turns = (m * window[0] << 32) + m * window[1] + (m * window[2] >> 32);
    const uint64_t nearest = (turns + ((uint64_t)1 << 61)) >> 62;
    const int64_t rest = (int64_t)(turns - (nearest << 62));
    const float r = (float)((double)rest * 3.4061215800304866e-19); // the factor is π/2 · 2^-62
    *quadrant = bits >> 31 ? -(int32_t)nearest : (int32_t)nearest;
    return bits >> 31 ? -r : r;
}

// Split a into quadrant · π/2 + r with |r| ≤ 0.787. Return r.
static inline rhw_float rhw_reduce(rhw_float a, rhw_int *quadrant)
{
    const rhw_int large = ~rhw_less(rhw_abs(a), rhw_splat(32768.0f));
    const rhw_float x = (rhw_float)((rhw_int)a & ~large);
    const rhw_float n = rhw_round(x * 0.636619747f);
    // π/2 has two parts in double. The first part has 33 bits, so its product with an n of 15 bits is exact.
    struct rhw_double8 r = rhw_to_double(x);
    const struct rhw_double8 count = rhw_to_double(n);
    r.low = (r.low - count.low * 1.5707963267341256) - count.low * 6.077100506506192e-11;
    r.high = (r.high - count.high * 1.5707963267341256) - count.high * 6.077100506506192e-11;
    *quadrant = rhw_int_from_float_unchecked(n);
    rhw_float rest = rhw_from_double(r);
    if (rhw_any(large)) {
        for (int i = 0; i < RHW_LANES; i++) {
            if (large[i]) {
                int32_t nearest;
                rest[i] = rhw_reduce_large(a[i], &nearest);
                (*quadrant)[i] = nearest;
            }
        }
    }
    // The subtraction in double would turn −0 into 0. A small argument is its own remainder.
    return rhw_select(rhw_less(rhw_abs(a), rhw_splat(0.7f)), a, rest);
}

// Return the sine of r for |r| ≤ 0.787.
static inline rhw_float rhw_sin_core(rhw_float r)
{
    const rhw_float z = r * r;
    const rhw_float result = r + r * z * (-0.166666552f + z * (0.008332178f + z * -0.000195173197f));
    return rhw_copysign(result, r); // keeps −0, because −0 + 0 is 0
}

// Return the cosine of r for |r| ≤ 0.787.
static inline rhw_float rhw_cos_core(rhw_float r)
{
    const rhw_float z = r * r;
    return 1.0f - (0.5f * z - z * z * (0.0416666456f + z * (-0.00138873688f + z * 2.44385556e-05f)));
}

/// Set `*sine` and `*cosine` to the sine and cosine of a, which is in radians. Both together take little more time than
/// one. Accuracy and special cases are those of rhw_sin and rhw_cos.
static inline void rhw_sincos(rhw_float a, rhw_float *sine, rhw_float *cosine)
{
    rhw_int quadrant;
    const rhw_float r = rhw_reduce(a, &quadrant);
    const rhw_float s = rhw_sin_core(r), c = rhw_cos_core(r);
    const rhw_int swap = -(quadrant & 1);
    *sine = (rhw_float)((rhw_int)rhw_select(swap, c, s) ^ ((quadrant & 2) << 30));
    *cosine = (rhw_float)((rhw_int)rhw_select(swap, s, c) ^ (((quadrant + 1) & 2) << 30));
}

/// Return the sine of a, which is in radians. A finite a is reduced exactly. Infinity gives NaN. The largest error is
/// 1.6 ULP.
static inline rhw_float rhw_sin(rhw_float a)
{
    rhw_float sine, cosine;
    rhw_sincos(a, &sine, &cosine);
    return sine;
}

/// Return the cosine of a, which is in radians. A finite a is reduced exactly. Infinity gives NaN. The largest error is
/// 1.6 ULP.
static inline rhw_float rhw_cos(rhw_float a)
{
    rhw_float sine, cosine;
    rhw_sincos(a, &sine, &cosine);
    return cosine;
}

/// Return the tangent of a, which is in radians. A finite a is reduced exactly. Infinity gives NaN. The largest error
/// is 3.6 ULP.
static inline rhw_float rhw_tan(rhw_float a)
{
    rhw_float sine, cosine;
    rhw_sincos(a, &sine, &cosine);
    return sine / cosine;
}

/// Return the angle of the point (x, y) in radians, −π..π, with the special cases of C's atan2 for zeros and
/// infinities. The largest error found is 2 ULP.
static inline rhw_float rhw_atan2(rhw_float y, rhw_float x)
{
    const rhw_float zero = rhw_splat(0.0f), one = rhw_splat(1.0f);
    const rhw_float ax = rhw_abs(x), ay = rhw_abs(y);
    const rhw_int steep = rhw_less(ax, ay);
    rhw_float small = rhw_select(steep, ax, ay), large = rhw_select(steep, ay, ax);
    // Take a quarter of both, so that their sum stays finite. What `small` loses is far below an ULP of the angle.
    const rhw_int huge = rhw_less(rhw_splat(8.5e37f), large);
    small = rhw_select(huge, 0.25f * small, small);
    large = rhw_select(huge, 0.25f * large, large);
    const rhw_int both_infinite = rhw_equal(small, rhw_infinity());
    small = rhw_select(both_infinite, one, small);
    large = rhw_select(both_infinite | rhw_equal(large, zero), one, large);
    // Above tan(π/8), atan(t) is π/4 + atan((t − 1)/(t + 1)).
    const rhw_int middle = rhw_less(0.414213562f * large, small);
    const rhw_float t = rhw_select(middle, small - large, small) / rhw_select(middle, small + large, large);
    const rhw_float z = t * t;
    rhw_float q = z * -0.0608425736f + 0.105963752f;
    q = q * z - 0.142439097f;
    q = q * z + 0.199984938f;
    q = q * z - 0.333333164f;
    const rhw_float bent = t * z * q;
    // Each constant is two floats. The smaller float is added to the small term.
    rhw_float angle = rhw_select(middle, 0.785398185f + (t + (bent - 2.1855695e-8f)), t + bent);
    angle = rhw_select(steep, 1.57079637f - (angle + 4.371139e-8f), angle);
    const rhw_int left = (rhw_int)x >> 31; // includes −0
    angle = rhw_select(left, 3.14159274f - (angle + 8.742278e-8f), angle);
    angle = (rhw_float)((rhw_int)angle ^ ((rhw_int)y & INT32_MIN));
    return rhw_select(rhw_equal(x, x) & rhw_equal(y, y), angle, rhw_nan());
}

/// Return the arc tangent of a in radians. The largest error is 2 ULP.
static inline rhw_float rhw_atan(rhw_float a)
{
    return rhw_atan2(a, rhw_splat(1.0f));
}

// Return asin(s) − s for 0 ≤ s ≤ 1/2, where z is s².
static inline rhw_float rhw_asin_rest(rhw_float s, rhw_float z)
{
    rhw_float q = z * 0.037569508f + 0.0144005837f;
    q = q * z + 0.0318178125f;
    q = q * z + 0.0445157476f;
    q = q * z + 0.0750051066f;
    q = q * z + 0.166666597f;
    return s * z * q;
}

/// Return the arc sine of a in radians. An a beyond −1..1 gives NaN. The largest error is 1.7 ULP.
static inline rhw_float rhw_asin(rhw_float a)
{
    const rhw_float magnitude = rhw_abs(a);
    const rhw_int outer = rhw_less(rhw_splat(0.5f), magnitude);
    // asin(x) is π/2 − 2 asin(sqrt((1 − x)/2)).
    const rhw_float z = rhw_select(outer, 0.5f * (1.0f - magnitude), magnitude * magnitude);
    const rhw_float s = rhw_select(outer, rhw_sqrt(z), magnitude);
    const rhw_float rest = rhw_asin_rest(s, z);
    const rhw_float outer_angle = 1.57079637f - (2.0f * s + (2.0f * rest + 4.371139e-8f));
    return rhw_copysign(rhw_select(outer, outer_angle, s + rest), a);
}

/// Return the arc cosine of a in radians. An a beyond −1..1 gives NaN. The largest error is 1.1 ULP.
static inline rhw_float rhw_acos(rhw_float a)
{
    const rhw_float magnitude = rhw_abs(a);
    const rhw_int outer = rhw_less(rhw_splat(0.5f), magnitude);
    const rhw_float z = rhw_select(outer, 0.5f * (1.0f - magnitude), magnitude * magnitude);
    const rhw_float s = rhw_select(outer, rhw_sqrt(z), magnitude);
    const rhw_float rest = rhw_asin_rest(s, z);
    const rhw_float twice = 2.0f * (s + rest);
    const rhw_int left = (rhw_int)a >> 31;
    const rhw_float outer_angle = rhw_select(left, 3.14159274f - (twice + 8.742278e-8f), twice);
    const rhw_float signed_s = rhw_copysign(s, a), signed_rest = rhw_copysign(rest, a);
    const rhw_float inner_angle = 1.57079637f - (signed_s + (signed_rest + 4.371139e-8f));
    return rhw_select(outer, outer_angle, inner_angle);
}

RHW_QUIET_END

#endif

#endif
