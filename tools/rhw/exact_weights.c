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

bool cli_exact_weights_set(struct cli_exact_weights *w, const struct rhw_explained_fragment *f)
{
    if (!f->is_snapped || !f->is_shaded) {
        return false;
    }
    const int32_t x = place_of(f->sample_x, f->place[0]), y = place_of(f->sample_y, f->place[1]);
    w->sum = 0;
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
    mpq_init(w->inverse_w);
    for (int i = 0; i < 3; i++) {
        w->edge[i] *= sign;
        mpq_init(w->screen[i]);
        mpq_init(w->space[i]);
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

void cli_exact_weights_free(struct cli_exact_weights *w)
{
    for (int i = 0; i < 3; i++) {
        mpq_clear(w->screen[i]);
        mpq_clear(w->space[i]);
    }
    mpq_clear(w->inverse_w);
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
    mpq_clear(value);
    mpq_clear(difference);
}
