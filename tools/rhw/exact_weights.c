// SPDX-License-Identifier: MIT
// See exact_weights.h.
#include "exact_weights.h"

#include <math.h>

// The pixel's place in 1/256, which place[] is a multiple of.
static int32_t place_of(int32_t sample, float place)
{
    return (sample & ~0xff) + (int32_t)(place * 256.0f);
}

static int64_t edge_of(const struct rhw_explained_fragment *f, int i, int32_t x, int32_t y)
{
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const int64_t a = (int64_t)f->y[j] - f->y[k], b = (int64_t)f->x[k] - f->x[j];
    return a * (x - f->x[j]) + b * (y - f->y[j]);
}

// In halves: GMP takes longs, which have 32 bits on some systems.
static void set_integer(mpz_t z, int64_t value)
{
    mpz_set_si(z, (long)(value >> 32));
    mpz_mul_2exp(z, z, 32);
    mpz_add_ui(z, z, (unsigned long)(value & UINT32_MAX));
}

static void set_ratio(mpq_t q, int64_t numerator, int64_t denominator)
{
    set_integer(mpq_numref(q), numerator);
    set_integer(mpq_denref(q), denominator);
    mpq_canonicalize(q);
}

void cli_exact_weights_free(struct cli_exact_weights *w)
{
    for (int i = 0; i < 3; i++) {
        mpq_clear(w->screen[i]);
        mpq_clear(w->space[i]);
    }
    mpq_clear(w->inverse_w);
}

static void init(struct cli_exact_weights *w)
{
    mpq_init(w->inverse_w);
    for (int i = 0; i < 3; i++) {
        mpq_init(w->screen[i]);
        mpq_init(w->space[i]);
    }
}

// r, s, t by areas; a, b, c from them: DESIGN's formulas.
static bool set_snapped(struct cli_exact_weights *w, const struct rhw_explained_fragment *f, int32_t x,
                        int32_t y)
{
    for (int i = 0; i < 3; i++) {
        w->edge[i] = edge_of(f, i, x, y);
        w->sum += w->edge[i];
    }
    if (w->sum == 0) {
        return false;
    }
    const int sign = w->sum < 0 ? -1 : 1; // the other way round on the screen
    w->sum *= sign;
    mpq_t over_w;
    mpq_init(over_w);
    for (int i = 0; i < 3; i++) {
        w->edge[i] *= sign;
        set_ratio(w->screen[i], w->edge[i], w->sum);
        mpq_set_d(over_w, (double)f->position[i][3]);
        mpq_div(w->space[i], w->screen[i], over_w);
        mpq_add(w->inverse_w, w->inverse_w, w->space[i]);
    }
    for (int i = 0; i < 3 && mpq_sgn(w->inverse_w) != 0; i++) {
        mpq_div(w->space[i], w->space[i], w->inverse_w);
    }
    mpq_clear(over_w);
    return true;
}

// A vertex less P: X/W and Y/W in pixels from P, times W. `scale` and `middle` are those of the viewport.
static void from_point(mpq_t difference, float value, float w, const mpq_t scale, const mpq_t middle)
{
    mpq_t along;
    mpq_init(along);
    mpq_set_d(difference, (double)value);
    mpq_mul(difference, difference, scale);
    mpq_set_d(along, (double)w);
    mpq_mul(along, along, middle);
    mpq_add(difference, difference, along);
    mpq_clear(along);
}

// Where a vertex lies nowhere on the screen: P is the mixture of the vertices whose X and Y, seen from P, vanish, so
// a : b : c are the 2 x 2 determinants of the other two vertices; r, s, t = a W_A/W_P, ...
static bool set_homogeneous(struct cli_exact_weights *w, const struct rhw_explained_fragment *f,
                            const mpq_t scale[2], const mpq_t middle[2])
{
    mpq_t at[3][2], sum, term;
    mpq_init(sum);
    mpq_init(term);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) {
            mpq_init(at[i][k]);
            from_point(at[i][k], f->position[i][k], f->position[i][3], scale[k], middle[k]);
        }
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        mpq_mul(w->space[i], at[j][0], at[k][1]);
        mpq_mul(term, at[j][1], at[k][0]);
        mpq_sub(w->space[i], w->space[i], term);
        mpq_add(sum, sum, w->space[i]);
    }
    const bool has_area = mpq_sgn(sum) != 0;
    for (int i = 0; i < 3 && has_area; i++) {
        mpq_div(w->space[i], w->space[i], sum);
        mpq_set_d(term, (double)f->position[i][3]);
        mpq_mul(w->screen[i], w->space[i], term);
        mpq_add(w->inverse_w, w->inverse_w, w->screen[i]); // W_P first
    }
    const bool is_seen = has_area && mpq_sgn(w->inverse_w) != 0;
    if (is_seen) {
        mpq_inv(w->inverse_w, w->inverse_w);
    }
    for (int i = 0; i < 3; i++) {
        mpq_mul(w->screen[i], w->screen[i], w->inverse_w);
        mpq_clear(at[i][0]);
        mpq_clear(at[i][1]);
    }
    mpq_clear(sum);
    mpq_clear(term);
    return is_seen;
}

// The viewport's map from X/W and Y/W to pixels, with P as the origin; y runs down.
static bool set_by_viewport(struct cli_exact_weights *w, const struct rhw_explained_fragment *f, int32_t x,
                            int32_t y, int width, int height)
{
    mpq_t scale[2], middle[2];
    for (int k = 0; k < 2; k++) { // one by one, as mini-gmp has it
        mpq_init(scale[k]);
        mpq_init(middle[k]);
    }
    set_ratio(scale[0], width, 2);
    set_ratio(scale[1], -height, 2);
    set_ratio(middle[0], (int64_t)width * 128 - x, 256);
    set_ratio(middle[1], (int64_t)height * 128 - y, 256);
    const bool set = set_homogeneous(w, f, (const mpq_t *)scale, (const mpq_t *)middle);
    for (int k = 0; k < 2; k++) {
        mpq_clear(scale[k]);
        mpq_clear(middle[k]);
    }
    return set;
}

bool cli_exact_weights_set(struct cli_exact_weights *w, const struct rhw_explained_fragment *f, int width,
                           int height)
{
    if (!f->is_shaded) {
        return false;
    }
    const int32_t x = place_of(f->sample_x, f->place[0]), y = place_of(f->sample_y, f->place[1]);
    *w = (struct cli_exact_weights){.is_snapped = f->is_snapped};
    init(w);
    const bool set = f->is_snapped ? set_snapped(w, f, x, y) : set_by_viewport(w, f, x, y, width, height);
    if (!set) {
        cli_exact_weights_free(w);
    }
    return set;
}

static void weigh(mpq_t sum, const mpq_t weights[3], const struct rhw_explained_fragment *f, int component)
{
    mpq_t term;
    mpq_init(term);
    mpq_set_si(sum, 0, 1);
    for (int i = 0; i < 3; i++) {
        mpq_set_d(term, (double)f->vertex_varyings[i][component]);
        mpq_mul(term, term, weights[i]);
        mpq_add(sum, sum, term);
    }
    mpq_clear(term);
}

// Of the largest vertex value.
static double ulp_of(const struct rhw_explained_fragment *f, int component)
{
    float largest = 0;
    for (int i = 0; i < 3; i++) {
        largest = fmaxf(largest, fabsf(f->vertex_varyings[i][component]));
    }
    return (double)nextafterf(largest, INFINITY) - (double)largest;
}

static double largest_weight(const struct cli_exact_weights *w)
{
    double largest = 0.0;
    for (int i = 0; i < 3; i++) {
        largest = fmax(largest, fabs(mpq_get_d(w->screen[i])));
    }
    return largest;
}

void cli_exact_component(const struct cli_exact_weights *w, const struct rhw_explained_fragment *f,
                         int component, struct cli_three_ways *ways)
{
    mpq_t value, difference;
    ways->written = f->varyings[component];
    const float sum = f->vertex_varyings[0][component] + f->vertex_varyings[1][component] +
                      f->vertex_varyings[2][component] + ways->written;
    if (!isfinite(sum)) { // no rational
        ways->naive = ways->exact = ways->error = (double)NAN;
        return;
    }
    mpq_init(value);
    mpq_init(difference);
    weigh(value, w->screen, f, component);
    ways->naive = mpq_get_d(value);
    if (f->qualifiers[component] == RHW_SMOOTH) {
        weigh(value, w->space, f, component);
    } else if (f->qualifiers[component] == RHW_FLAT) {
        mpq_set_d(value, (double)ways->written); // the provoking vertex's, as it is
    }
    ways->exact = mpq_get_d(value);
    mpq_set_d(difference, (double)ways->written);
    mpq_sub(difference, difference, value);
    mpq_abs(difference, difference);
    ways->error = mpq_get_d(difference) / ulp_of(f, component);
    if (!w->is_snapped && f->qualifiers[component] == RHW_NOPERSPECTIVE) {
        ways->error /= fmax(1.0, largest_weight(w));
    }
    mpq_clear(value);
    mpq_clear(difference);
}
