// SPDX-License-Identifier: MIT
// See kernel_random.h.
#include "kernel_random.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"

// Steele, Lea, Flood 2014, Fast Splittable Pseudorandom Number Generators: SplitMix64.
uint64_t random_bits(struct kernel_random *random)
{
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

struct kernel_random kernel_random_start(const char *name, uint64_t seed)
{
    struct kernel_random random = {0xcbf29ce484222325u}; // FNV-1a of the name
    for (; *name; name++) {
        random.state = (random.state ^ (unsigned char)*name) * 0x100000001b3u;
    }
    random.state ^= random_bits(&(struct kernel_random){seed});
    return random;
}

static int below(struct kernel_random *random, int n)
{
    return (int)(random_bits(random) % (uint64_t)n);
}

bool random_one_in(struct kernel_random *random, int n)
{
    return below(random, n) == 0;
}

// Integers ------------------------------------------------------------------------------------------

static int64_t any_int(struct kernel_random *random, int64_t low, int64_t high)
{
    const uint64_t count = (uint64_t)high - (uint64_t)low + 1;
    return (int64_t)((uint64_t)low + (count ? random_bits(random) % count : random_bits(random)));
}

int64_t random_int(struct kernel_random *random, int64_t low, int64_t high)
{
    int64_t value;
    switch (below(random, 8)) {
    case 0: value = random_one_in(random, 2) ? low : high; break;
    case 1: value = random_one_in(random, 2) ? low + (low < high) : high - (low < high); break;
    case 2: value = 0; break;
    case 3: value = (int64_t)1 << below(random, 62); break;
    case 4: value = ((int64_t)1 << below(random, 62)) + below(random, 3) - 1; break;
    case 5: value = -((int64_t)1 << below(random, 62)) + below(random, 3) - 1; break;
    default: value = any_int(random, low, high); break;
    }
    return value < low || value > high ? any_int(random, low, high) : value;
}

void random_ints(struct kernel_random *random, int32_t *values, int count, int32_t low, int32_t high)
{
    for (int i = 0; i < count; i++) {
        values[i] = (int32_t)random_int(random, low, high);
    }
}

// Floats --------------------------------------------------------------------------------------------

static float float_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static double double_of_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// −1 .. 1
static double unit(struct kernel_random *random)
{
    return (double)(int64_t)random_bits(random) * 0x1p-63;
}

float random_float(struct kernel_random *random)
{
    static const float special[] = {0.0f,
                                    -0.0f,
                                    INFINITY,
                                    -INFINITY,
                                    NAN,
                                    0x1p-149f,
                                    -0x1p-149f,
                                    0x1.fffffcp-127f,
                                    0x1p-126f,
                                    0x1.fffffep127f,
                                    -0x1.fffffep127f,
                                    0x1.fffffep-1f,
                                    1.0f,
                                    0x1.000002p0f,
                                    -1.0f,
                                    0.5f,
                                    0x1p23f,
                                    -0x1p23f,
                                    0x1p24f,
                                    0x1p31f,
                                    -0x1p31f,
                                    0x1.fffffep30f,
                                    0x1p32f,
                                    65504.0f,
                                    65520.0f,
                                    0x1p-24f,
                                    0x1p-25f,
                                    255.0f,
                                    255.5f,
                                    256.0f};
    switch (below(random, 8)) {
    case 0: return special[below(random, (int)(sizeof special / sizeof *special))];
    case 1: return float_of_bits((uint32_t)random_bits(random)); // any bits
    case 2: return (float)any_int(random, -1024, 1024) * 0.5f;   // ties of rounding to integers
    case 3: return (float)any_int(random, -65536, 65536) / 256.0f;
    case 4: return (float)(unit(random) * 255.0);
    case 5: return (float)ldexp(unit(random), below(random, 64) - 32);
    default: return (float)unit(random);
    }
}

float random_finite(struct kernel_random *random)
{
    float value;
    do {
        value = random_float(random);
    } while (!isfinite(value));
    return value;
}

float random_float_in(struct kernel_random *random, float low, float high)
{
    switch (below(random, 8)) {
    case 0: return low;
    case 1: return high;
    case 2: return nextafterf(low, high);
    case 3: return nextafterf(high, low);
    case 4: {
        const float value = random_float(random);
        if (value >= low && value <= high) {
            return value;
        }
        break;
    }
    default: break;
    }
    const float value = (float)((double)low + ((double)high - (double)low) * fabs(unit(random)));
    return value < low ? low : value > high ? high : value;
}

void random_floats(struct kernel_random *random, float *values, int count)
{
    for (int i = 0; i < count; i++) {
        values[i] = random_float(random);
    }
}

double random_double(struct kernel_random *random)
{
    switch (below(random, 6)) {
    case 0: return (double)random_float(random);
    case 1: return double_of_bits(random_bits(random));
    case 2: // beside a float, or beside the middle of two: what rounding to float gets wrong
        return nextafter((double)random_float(random) + below(random, 2) * 0x1p-24, unit(random));
    case 3: return (double)any_int(random, -4096, 4096) * 0.5;
    default: return ldexp(unit(random), below(random, 400) - 200);
    }
}

double random_finite_double(struct kernel_random *random, int limit)
{
    if (random_one_in(random, 8)) {
        return random_one_in(random, 2) ? 0.0 : -0.0;
    }
    const double significand = random_one_in(random, 4) ? 1.0 : 0.5 + 0.5 * fabs(unit(random));
    return ldexp(random_one_in(random, 2) ? significand : -significand, below(random, 2 * limit) - limit + 1);
}

void random_doubles(struct kernel_random *random, double *values, int count)
{
    for (int i = 0; i < count; i++) {
        values[i] = random_double(random);
    }
}

// Geometry ------------------------------------------------------------------------------------------

enum { GUARD_24_8 = RHW_GUARD_BAND * RHW_SUBPIXEL };

static int32_t within_guard_band(int64_t position)
{
    return (int32_t)(position < -GUARD_24_8 ? -GUARD_24_8 : position > GUARD_24_8 ? GUARD_24_8 : position);
}

void random_triangle(struct kernel_random *random, int32_t x, int32_t y, int32_t xs[3], int32_t ys[3])
{
    static const int reaches[] = {
        16, RHW_SUBPIXEL, 8 * RHW_SUBPIXEL, 64 * RHW_SUBPIXEL, 1024 * RHW_SUBPIXEL, 2 * GUARD_24_8};
    const int reach = reaches[below(random, (int)(sizeof reaches / sizeof *reaches))];
    for (int i = 0; i < 3; i++) {
        xs[i] = within_guard_band(x + any_int(random, -reach, reach));
        ys[i] = within_guard_band(y + any_int(random, -reach, reach));
    }
    switch (below(random, 6)) {
    case 0: // a sliver: the third vertex lies beside the middle of the others
        xs[2] = within_guard_band((xs[0] + xs[1]) / 2 + any_int(random, -1, 1));
        ys[2] = within_guard_band((ys[0] + ys[1]) / 2 + any_int(random, -1, 1));
        break;
    case 1: // vertices at pixel centres, and edges along rows and columns of them
        for (int i = 0; i < 3; i++) {
            xs[i] = within_guard_band((xs[i] & ~(RHW_SUBPIXEL - 1)) + RHW_SUBPIXEL / 2);
            ys[i] = within_guard_band((ys[i] & ~(RHW_SUBPIXEL - 1)) + RHW_SUBPIXEL / 2);
        }
        ys[1] = ys[0];
        xs[2] = random_one_in(random, 2) ? xs[1] : xs[2];
        break;
    case 2: // one vertex at an end of the guard band
        xs[0] = random_one_in(random, 2) ? -GUARD_24_8 : GUARD_24_8;
        ys[0] = random_one_in(random, 2) ? -GUARD_24_8 : GUARD_24_8;
        break;
    default: break;
    }
}

void random_clip_position(struct kernel_random *random, float position[4])
{
    const int exponent = random_one_in(random, 4) ? below(random, 250) - 125 : below(random, 20) - 10;
    const float w = (float)ldexp(0.5 + 0.5 * fabs(unit(random)), exponent);
    for (int i = 0; i < 3; i++) {
        switch (below(random, 6)) {
        case 0: position[i] = random_one_in(random, 2) ? w : -w; break;
        case 1: position[i] = nextafterf(random_one_in(random, 2) ? w : -w, random_finite(random)); break;
        case 2: position[i] = random_float(random); break;
        default: position[i] = (float)(unit(random) * 1.5) * w; break;
        }
    }
    position[3] = w;
    if (random_one_in(random, 4)) {
        position[3] = random_one_in(random, 2) ? -w : random_float(random);
    }
}
