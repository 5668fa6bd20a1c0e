// SPDX-License-Identifier: MIT
// Plain numbers in the place of lanes, in C and in C++: the bits of rhw_splat, in every place. operands.sh compiles it
// as both and runs it. Each function stands here once.
#include <stdio.h>
#include <string.h>

#include <rhw/shader.h>
#include <rhw/shader_dual.h>

static int failures;

static void same(int line, rhw_float a, rhw_float b)
{
    if (memcmp(&a, &b, sizeof a) != 0) {
        printf("line %d: other bits\n", line);
        failures++;
    }
}

static void same_int(int line, rhw_int a, rhw_int b)
{
    if (memcmp(&a, &b, sizeof a) != 0) {
        printf("line %d: other bits\n", line);
        failures++;
    }
}

static void same_dual(int line, struct rhw_dual a, struct rhw_dual b)
{
    same(line, a.value, b.value);
    same(line, a.ddx, b.ddx);
    same(line, a.ddy, b.ddy);
}

static void same_dual1(int line, struct rhw_dual1 a, struct rhw_dual1 b)
{
    if (memcmp(&a, &b, sizeof a) != 0) {
        printf("line %d: other bits\n", line);
        failures++;
    }
}

static void numbers(rhw_float v, rhw_float w)
{
    const rhw_float half = rhw_splat(0.5f), zero = rhw_splat(0), one = rhw_splat(1);
    const rhw_int mask = rhw_less(v, 0.5f);
    same_int(__LINE__, mask, rhw_less(v, half));
    same_int(__LINE__, rhw_less(0.5f, v), rhw_less(half, v));
    same_int(__LINE__, rhw_less_equal(v, 0), rhw_less_equal(v, zero));
    same_int(__LINE__, rhw_equal(v, 1), rhw_equal(v, one));
    same_int(__LINE__, rhw_greater(v, 0.5f), rhw_less(half, v));
    same_int(__LINE__, rhw_greater_equal(0.5f, v), rhw_less_equal(v, half));
    same_int(__LINE__, rhw_not_equal(v, 1.0f), ~rhw_equal(v, one));
    same(__LINE__, rhw_select(mask, v, 0.0f), rhw_select(mask, v, zero));
    same(__LINE__, rhw_select(mask, 1.0f, w), rhw_select(mask, one, w));
    same(__LINE__, rhw_select(mask, 1.0f, 0.0f), rhw_select(mask, one, zero));
    same(__LINE__, rhw_min(v, 0.5f), rhw_min(v, half));
    same(__LINE__, rhw_max(0.0f, rhw_max(v, -1.0f)), rhw_max(zero, rhw_max(v, -one)));
    same(__LINE__, rhw_clamp(v, 0.0f, 1.0f), rhw_saturate(v));
    same(__LINE__, rhw_clamp(v, 0.0f, w), rhw_clamp(v, zero, w));
    same(__LINE__, rhw_copysign(1.0f, v), rhw_copysign(one, v));
    same(__LINE__, rhw_mix(v, w, 0.5f), rhw_mix(v, w, half));
    same(__LINE__, rhw_mix(0.0f, 1.0f, v), rhw_mix(zero, one, v));
    same(__LINE__, rhw_smoothstep(0.0f, 0.5f, v), rhw_smoothstep(zero, half, v));
    same(__LINE__, rhw_pow(v, 2.0f), rhw_pow(v, rhw_splat(2)));
    same(__LINE__, rhw_pow(2.0f, v), rhw_pow(rhw_splat(2), v));
    same(__LINE__, rhw_atan2(v, 1.0f), rhw_atan2(v, one));
    same_int(__LINE__, rhw_less(v, 1u), rhw_less(v, one));
    same_int(__LINE__, rhw_less(v, 1ll), rhw_less(v, one));
    same_int(__LINE__, rhw_less(v, 1.0), rhw_less(v, one));
}

// Plain vectors, const and not, on either side; both sides evaluated once.
static void vectors(rhw_float v, rhw_float w)
{
    static const float uniform[4] = {0.5f, -1.25f, 3, 0.1f};
    float own[4] = {2, 0.75f, -0.3f, 1};
    const rhw_float a[4] = {v, w, v - w, v + w};
    const rhw_float lanes[4] = {rhw_splat(0.5f), rhw_splat(-1.25f), rhw_splat(3), rhw_splat(0.1f)};
    const rhw_float own_lanes[4] = {rhw_splat(2), rhw_splat(0.75f), rhw_splat(-0.3f), rhw_splat(1)};
    same(__LINE__, rhw_dot2(a, uniform), rhw_dot2(a, lanes));
    same(__LINE__, rhw_dot2(own, a), rhw_dot2(own_lanes, a));
    same(__LINE__, rhw_dot3(a, uniform), rhw_dot3(a, lanes));
    same(__LINE__, rhw_dot3(uniform, a), rhw_dot3(lanes, a));
    same(__LINE__, rhw_dot3(own, a), rhw_dot3(own_lanes, a));
    same(__LINE__, rhw_dot3(&own[1], a), rhw_dot3(&own_lanes[1], a));
    same(__LINE__, rhw_dot4(a, own), rhw_dot4(a, own_lanes));
    same(__LINE__, rhw_dot4(uniform, a), rhw_dot4(lanes, a));
    const float *next = uniform;
    same(__LINE__, rhw_dot2(a, next++), rhw_dot2(a, lanes));
    same_int(__LINE__, rhw_splat_int((int)(next - uniform)), rhw_splat_int(1));
}

static void integers(rhw_int i)
{
    const rhw_int three = rhw_splat_int(3);
    same_int(__LINE__, rhw_less_int(i, 3), rhw_less_int(i, three));
    same_int(__LINE__, rhw_equal_int(3, i), rhw_equal_int(three, i));
    same_int(__LINE__, rhw_min_int(i, 3), rhw_min_int(i, three));
    same_int(__LINE__, rhw_max_int(3, i), rhw_max_int(three, i));
    same_int(__LINE__, rhw_divide_int(i, 3), rhw_divide_int(i, three));
    same_int(__LINE__, rhw_remainder_int(3, i), rhw_remainder_int(three, i));
    same_int(__LINE__, rhw_divide_uint(i, 3), rhw_divide_uint(i, three));
    same_int(__LINE__, rhw_divide_uint(i, 3u), rhw_divide_uint(i, three));
    same_int(__LINE__, rhw_remainder_uint(i, 3), rhw_remainder_uint(i, three));
    same(__LINE__, rhw_ldexp(2.0f, i), rhw_ldexp(rhw_splat(2), i));
    same(__LINE__, rhw_ldexp(rhw_splat(2), 3), rhw_ldexp(rhw_splat(2), three));
    same_int(__LINE__, rhw_select_int(rhw_less_int(i, 3), i, -1),
             rhw_select_int(rhw_less_int(i, three), i, rhw_splat_int(-1)));
}

static void duals(rhw_float v, rhw_float w)
{
    const struct rhw_dual a = rhw_dual_make(v, w, v - w), two = rhw_dual_constant(rhw_splat(2));
    const struct rhw_dual zero = rhw_dual_constant(rhw_splat(0)), lanes = rhw_dual_constant(w);
    const rhw_int mask = rhw_less(v, w);
    same_dual(__LINE__, rhw_dual_add(a, 2.0f), rhw_dual_add(a, two));
    same_dual(__LINE__, rhw_dual_sub(w, a), rhw_dual_sub(lanes, a));
    same_dual(__LINE__, rhw_dual_mul(2, a), rhw_dual_mul(two, a));
    same_dual(__LINE__, rhw_dual_div(a, w), rhw_dual_div(a, lanes));
    same_dual(__LINE__, rhw_dual_scale(a, 2.0f), rhw_dual_scale(a, rhw_splat(2)));
    same_dual(__LINE__, rhw_dual_offset(a, 2.0f), rhw_dual_offset(a, rhw_splat(2)));
    same_dual(__LINE__, rhw_dual_select(mask, a, 0.0f), rhw_dual_select(mask, a, zero));
    same_dual(__LINE__, rhw_dual_min(a, w), rhw_dual_min(a, lanes));
    same_dual(__LINE__, rhw_dual_max(a, 0.0f), rhw_dual_max(a, zero));
    same_dual(__LINE__, rhw_dual_clamp(a, 0.0f, 2.0f), rhw_dual_clamp(a, zero, two));
    same_dual(__LINE__, rhw_dual_mix(a, 2.0f, w), rhw_dual_mix(a, two, lanes));
    same_dual(__LINE__, rhw_dual_smoothstep(0.0f, 2.0f, a), rhw_dual_smoothstep(zero, two, a));
    same_dual(__LINE__, rhw_dual_pow(a, 2.0f), rhw_dual_pow(a, two));
    same_dual(__LINE__, rhw_dual_atan2(a, 2.0f), rhw_dual_atan2(a, two));
#ifdef __cplusplus
    same_dual(__LINE__, 2.0f * a + w / a - 1.0f,
              rhw_dual_sub(rhw_dual_add(rhw_dual_mul(two, a), rhw_dual_div(lanes, a)), 1.0f));
    same_dual(__LINE__, -a, rhw_dual_neg(a));
#endif
}

static void duals_one_at_a_time(float v, float w)
{
    const struct rhw_dual1 a = rhw_dual_make1(v, w, v - w), two = rhw_dual_constant1(2);
    const struct rhw_dual1 zero = rhw_dual_constant1(0);
    same_dual1(__LINE__, rhw_dual_add1(a, 2.0f), rhw_dual_add1(a, two));
    same_dual1(__LINE__, rhw_dual_sub1(2.0f, a), rhw_dual_sub1(two, a));
    same_dual1(__LINE__, rhw_dual_mul1(a, 2), rhw_dual_mul1(a, two));
    same_dual1(__LINE__, rhw_dual_div1(a, 2.0f), rhw_dual_div1(a, two));
    same_dual1(__LINE__, rhw_dual_select1(v < w, a, 0.0f), rhw_dual_select1(v < w, a, zero));
    same_dual1(__LINE__, rhw_dual_min1(a, 2.0f), rhw_dual_min1(a, two));
    same_dual1(__LINE__, rhw_dual_max1(a, 0.0f), rhw_dual_max1(a, zero));
    same_dual1(__LINE__, rhw_dual_clamp1(a, 0.0f, 2.0f), rhw_dual_clamp1(a, zero, two));
    same_dual1(__LINE__, rhw_dual_mix1(a, 2.0f, 0.0f), rhw_dual_mix1(a, two, zero));
    same_dual1(__LINE__, rhw_dual_smoothstep1(0.0f, 2.0f, a), rhw_dual_smoothstep1(zero, two, a));
    same_dual1(__LINE__, rhw_dual_pow1(a, 2.0f), rhw_dual_pow1(a, two));
    same_dual1(__LINE__, rhw_dual_atan2_1(a, 2.0f), rhw_dual_atan2_1(a, two));
#ifdef __cplusplus
    same_dual1(__LINE__, (2.0f * a - 1) / a + a,
               rhw_dual_add1(rhw_dual_div1(rhw_dual_sub1(rhw_dual_mul1(two, a), 1), a), a));
    same_dual1(__LINE__, -a, rhw_dual_neg1(a));
#endif
}

struct surface {
    rhw_float normal[3], uv[2], height;
};

struct surface1 {
    float normal[3], uv[2], height;
};

static const struct rhw_varying varyings[2][3] = {
    {RHW_VARYING(struct surface, normal, RHW_SMOOTH, false),
     RHW_VARYING(struct surface, uv, RHW_SMOOTH, true), RHW_VARYING(struct surface, height, RHW_FLAT, false)},
    {RHW_VARYING1(struct surface1, normal, RHW_SMOOTH, false),
     RHW_VARYING1(struct surface1, uv, RHW_SMOOTH, true),
     RHW_VARYING1(struct surface1, height, RHW_FLAT, false)},
};

static void members(void)
{
    static const int components[3] = {3, 2, 1}, offsets[3] = {0, 3, 5};
    static const char *const names[3] = {"normal", "uv", "height"};
    rhw_float component[6];
    struct surface *const out = RHW_VARYINGS_OUT(struct surface, component);
    const struct surface *const in = RHW_VARYINGS(struct surface, component);
    for (int i = 0; i < 6; i++) {
        component[i] = rhw_splat((float)i);
    }
    out->height += out->normal[1] * in->uv[1];
    same(__LINE__, component[5], rhw_splat(9));
    for (int i = 0; i < 6; i++) {
        const struct rhw_varying *const varying = &varyings[i / 3][i % 3];
        if (varying->components != components[i % 3] || varying->offset != offsets[i % 3] ||
            varying->struct_components != 6 || strcmp(varying->name, names[i % 3]) != 0 ||
            varying->derivatives != (i % 3 == 1) ||
            varying->qualifier != (i % 3 == 2 ? RHW_FLAT : RHW_SMOOTH)) {
            printf("RHW_VARYING of %s is wrong\n", names[i % 3]);
            failures++;
        }
    }
}

int main(void)
{
    const rhw_float v = {-2.0f, -0.0f, 0.0f, 0.25f, 0.5f, 1.0f, 3.0f, 1e9f};
    const rhw_float w = {1.0f, 2.0f, -1.0f, 0.75f, 0.5f, -8.0f, 1e-9f, 0.1f};
    const rhw_int i = {-5, 0, 3, 4, 1, 2, 2147483647, 3};
    numbers(v, w);
    vectors(v, w);
    integers(i);
    duals(rhw_abs(v) + 0.25f, w);
    duals_one_at_a_time(0.75f, -3.0f);
    members();
    return failures != 0;
}
