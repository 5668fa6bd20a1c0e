// SPDX-License-Identifier: MIT
// Tests of the oracle itself, before anything is compared with it: cases worked out by hand, and the formulas
// of docs/exactness.md evaluated a second time, letter by letter, in rationals.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "oracle.h"
#include "random.h"

static const struct oracle_view small_view = {
    .target_width = 16, .target_height = 16, .width = 16, .height = 16, .depth_max = 1};

// The clip position that lands on (x, y), in 1/256 pixel, of a 16×16 target; exact for dyadic w.
static void place(float position[4], int x_24_8, int y_24_8, double z, double w)
{
    position[0] = (float)((x_24_8 / 2048.0 - 1) * w);
    position[1] = (float)((1 - y_24_8 / 2048.0) * w);
    position[2] = (float)(z * w);
    position[3] = (float)w;
}

static bool covered(const struct oracle_triangle *t, int x, int y)
{
    int at[ORACLE_CORNERS], y0, y1;
    oracle_rows(t, &y0, &y1);
    if (y < y0 || y >= y1) {
        return false;
    }
    const int count = oracle_cover_row(t, y, at);
    for (int i = 0; i < count; i += 2) {
        if (x >= at[i] && x < at[i + 1]) {
            return true;
        }
    }
    return false;
}

static int count_covered(const struct oracle_triangle *t)
{
    int count = 0;
    for (int y = 0; y < t->view.target_height; y++) {
        for (int x = 0; x < t->view.target_width; x++) {
            count += covered(t, x, y);
        }
    }
    return count;
}

static void set_corners(struct oracle_triangle *t, const int xy_24_8[3][2])
{
    float position[3][4];
    for (int i = 0; i < 3; i++) {
        place(position[i], xy_24_8[i][0], xy_24_8[i][1], 0.5, 1);
    }
    oracle_triangle_set(t, &small_view, (const float(*)[4])position);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(t->vertex_24_8[i][0], xy_24_8[i][0]);
        assert_int_equal(t->vertex_24_8[i][1], xy_24_8[i][1]);
    }
}

// A square whose corners are pixel centres owns its top and left edges only, however it is cut in two.
static void test_top_left_by_hand(void **state)
{
    (void)state;
    struct oracle_triangle a, b;
    oracle_triangle_init(&a);
    oracle_triangle_init(&b);
    const int low = 2 * 256 + 128, high = 6 * 256 + 128; // centres of pixels 2 and 6
    set_corners(&a, (const int[3][2]){{low, low}, {high, low}, {low, high}});
    set_corners(&b, (const int[3][2]){{high, low}, {high, high}, {low, high}});
    for (int y = 0; y < 16; y++) {
        for (int x = 0; x < 16; x++) {
            const bool inside = x >= 2 && x < 6 && y >= 2 && y < 6;
            assert_int_equal(covered(&a, x, y) + covered(&b, x, y), inside);
            // The diagonal x + y = 8 is a right edge of the first and a left edge of the second.
            assert_int_equal(covered(&a, x, y), inside && x + y < 8);
        }
    }
    // No area, no samples; a triangle of one sample.
    set_corners(&a, (const int[3][2]){{low, low}, {high, high}, {low + 256, low + 256}});
    assert_true(a.empty);
    set_corners(&a, (const int[3][2]){{low, low}, {low + 1, low}, {low, low + 1}});
    assert_int_equal(count_covered(&a), 1);
    set_corners(&a, (const int[3][2]){{low, low}, {low - 1, low}, {low, low - 1}});
    assert_int_equal(count_covered(&a), 0);
    oracle_triangle_clear(&a);
    oracle_triangle_clear(&b);
}

// The sample moved by (ε, ε²) in rationals, against strict edge functions.
static bool covered_by_rationals(const int v[3][2], int x, int y)
{
    mpq_t sample[2], e, p;
    mpq_inits(sample[0], sample[1], e, p, NULL);
    mpq_set_si(sample[0], 1, 1);
    mpq_div_2exp(sample[0], sample[0], 40);
    mpq_mul(sample[1], sample[0], sample[0]);
    mpq_set_si(p, x * 256 + 128, 1);
    mpq_add(sample[0], sample[0], p);
    mpq_set_si(p, y * 256 + 128, 1);
    mpq_add(sample[1], sample[1], p);
    int positive = 0, negative = 0;
    for (int i = 0; i < 3; i++) {
        const int *const a = v[i], *const b = v[(i + 1) % 3];
        // (b − a) × (sample − a)
        mpq_t q;
        mpq_init(q);
        mpq_set_si(p, a[1], 1);
        mpq_sub(e, sample[1], p);
        mpq_set_si(p, b[0] - a[0], 1);
        mpq_mul(e, e, p);
        mpq_set_si(p, a[0], 1);
        mpq_sub(q, sample[0], p);
        mpq_set_si(p, b[1] - a[1], 1);
        mpq_mul(q, q, p);
        mpq_sub(e, e, q);
        positive += mpq_sgn(e) > 0;
        negative += mpq_sgn(e) < 0;
        mpq_clear(q);
    }
    mpq_clears(sample[0], sample[1], e, p, NULL);
    return positive == 3 || negative == 3;
}

// Corners on a coarse grid that holds the pixel centres, so that ties are common.
static void test_coverage_against_rationals(void **state)
{
    (void)state;
    struct random r = random_start(1, 2, 3);
    struct oracle_triangle t;
    oracle_triangle_init(&t);
    for (int n = 0; n < 400; n++) {
        const int grid = n % 2 ? 64 : 1;
        int v[3][2];
        for (int i = 0; i < 6; i++) {
            v[i / 2][i % 2] = random_below(&r, 16 * 256 / grid) * grid;
        }
        set_corners(&t, (const int(*)[2])v);
        for (int y = 0; y < 16; y++) {
            for (int x = 0; x < 16; x++) {
                assert_int_equal(covered(&t, x, y), covered_by_rationals((const int(*)[2])v, x, y));
            }
        }
    }
    oracle_triangle_clear(&t);
}

static void form_value(mpq_t value, const struct oracle_form *f, const struct oracle_sample *s)
{
    mpz_t p;
    mpz_init(p);
    mpq_set_ui(value, 0, 1);
    mpz_set_ui(mpq_denref(value), 0);
    for (int i = 0; i < 3; i++) {
        mpz_mul(p, f->screen && s->linear ? s->line[i] : s->e[i], f->over[i]);
        mpz_add(mpq_numref(value), mpq_numref(value), p);
        mpz_mul(p, f->screen && s->linear ? s->line[i] : s->e[i], f->under[i]);
        mpz_add(mpq_denref(value), mpq_denref(value), p);
    }
    mpq_canonicalize(value);
    if (f->exponent < 0) {
        mpq_div_2exp(value, value, (mp_bitcnt_t)-f->exponent);
    } else {
        mpq_mul_2exp(value, value, (mp_bitcnt_t)f->exponent);
    }
    mpz_clear(p);
}

// What the contract says, in its own letters: r, s, t on the screen; a, b, c in space.
struct textbook {
    mpq_t screen[3], space[3], w[3], inverse_w;
};

static void textbook_init(struct textbook *b)
{
    for (int i = 0; i < 3; i++) {
        mpq_inits(b->screen[i], b->space[i], b->w[i], NULL);
    }
    mpq_init(b->inverse_w);
}

static void textbook_clear(struct textbook *b)
{
    for (int i = 0; i < 3; i++) {
        mpq_clears(b->screen[i], b->space[i], b->w[i], NULL);
    }
    mpq_clear(b->inverse_w);
}

// Solves p[0]·x + p[1]·y + p[2]·z = right for columns p, by Cramer's rule.
static void solve(mpq_t *x, mpq_t (*p)[3], mpq_t *right)
{
    mpq_t det[4], product, saved;
    mpq_inits(product, saved, NULL);
    for (int k = 0; k < 4; k++) { // k < 3: column k replaced by the right side
        mpq_init(det[k]);
        for (int i = 0; i < 3; i++) {
            for (int swap = 0; swap < 2; swap++) {
                const int row[3] = {i, swap ? (i + 2) % 3 : (i + 1) % 3, swap ? (i + 1) % 3 : (i + 2) % 3};
                mpq_set_si(product, swap ? -1 : 1, 1);
                for (int column = 0; column < 3; column++) {
                    mpq_mul(product, product, column == k ? right[row[column]] : p[column][row[column]]);
                }
                mpq_add(det[k], det[k], product);
            }
        }
    }
    for (int k = 0; k < 3; k++) {
        mpq_div(x[k], det[k], det[3]);
        mpq_clear(det[k]);
    }
    mpq_clears(det[3], product, saved, NULL);
}

// Weights at pixel (x, y): for a snapped triangle r, s, t solve Σ r·(x_i, y_i, 1) = (x, y, 1) on the screen
// and a = r·W_P/W_A; else a, b, c solve Σ a·(X_i, Y_i, W_i) ∝ (x_ndc, y_ndc, 1) and r = a·W_A/W_P.
static void textbook_weights(struct textbook *b, const struct oracle_triangle *t, int x, int y)
{
    mpq_t column[3][3], right[3], p;
    mpq_init(p);
    for (int i = 0; i < 3; i++) {
        mpq_inits(column[i][0], column[i][1], column[i][2], right[i], NULL);
        mpq_set_d(b->w[i], (double)t->position[i][3]);
    }
    mpq_set_si(right[2], 1, 1);
    if (t->snapped) {
        mpq_set_d(right[0], x + 0.5);
        mpq_set_d(right[1], y + 0.5);
        for (int i = 0; i < 3; i++) {
            mpq_set_si(column[i][0], t->vertex_24_8[i][0], 256);
            mpq_set_si(column[i][1], t->vertex_24_8[i][1], 256);
            mpq_set_si(column[i][2], 1, 1);
            mpq_canonicalize(column[i][0]);
            mpq_canonicalize(column[i][1]);
        }
        solve(b->screen, column, right);
        mpq_set_ui(b->inverse_w, 0, 1);
        for (int i = 0; i < 3; i++) {
            mpq_div(b->space[i], b->screen[i], b->w[i]);
            mpq_add(b->inverse_w, b->inverse_w, b->space[i]);
        }
        for (int i = 0; i < 3; i++) {
            mpq_div(b->space[i], b->space[i], b->inverse_w);
        }
    } else {
        const struct oracle_view *const v = &t->view;
        mpq_set_d(right[0], x + 0.5 - (double)v->x - (double)v->width / 2);
        mpq_set_d(p, (double)v->width / 2);
        mpq_div(right[0], right[0], p);
        mpq_set_d(right[1], (double)v->y + (double)v->height / 2 - y - 0.5);
        mpq_set_d(p, (double)v->height / 2);
        mpq_div(right[1], right[1], p);
        for (int i = 0; i < 3; i++) {
            mpq_set_d(column[i][0], (double)t->position[i][0]);
            mpq_set_d(column[i][1], (double)t->position[i][1]);
            mpq_set_d(column[i][2], (double)t->position[i][3]);
        }
        // The solution is (a, b, c)/W_P, whose sum is 1/W_P.
        solve(b->space, column, right);
        mpq_set_ui(b->inverse_w, 0, 1);
        for (int i = 0; i < 3; i++) {
            mpq_add(b->inverse_w, b->inverse_w, b->space[i]);
            mpq_mul(b->screen[i], b->space[i], b->w[i]);
        }
        for (int i = 0; i < 3; i++) {
            mpq_div(b->space[i], b->space[i], b->inverse_w);
        }
    }
    for (int i = 0; i < 3; i++) {
        mpq_clears(column[i][0], column[i][1], column[i][2], right[i], NULL);
    }
    mpq_clear(p);
}

static void weighted(mpq_t sum, mpq_t weight[3], const float value[3])
{
    mpq_t p;
    mpq_init(p);
    mpq_set_ui(sum, 0, 1);
    for (int i = 0; i < 3; i++) {
        mpq_set_d(p, (double)value[i]);
        mpq_mul(p, p, weight[i]);
        mpq_add(sum, sum, p);
    }
    mpq_clear(p);
}

// Z/W as the vertices carry it, through the view's range.
static void textbook_depth(mpq_t depth, struct textbook *b, const struct oracle_triangle *t)
{
    const struct oracle_view *const v = &t->view;
    mpq_t p, q;
    mpq_inits(p, q, NULL);
    mpq_set_ui(depth, 0, 1);
    for (int i = 0; i < 3; i++) { // r·Z/W; a·Z/W_P where that is not defined
        mpq_set_d(p, (double)t->position[i][2]);
        if (t->snapped) {
            mpq_mul(p, p, b->screen[i]);
            mpq_div(p, p, b->w[i]);
        } else {
            mpq_mul(p, p, b->space[i]);
            mpq_mul(p, p, b->inverse_w);
        }
        mpq_add(depth, depth, p);
    }
    if (v->minus_one_to_one) {
        mpq_set_ui(p, 1, 1);
        mpq_add(depth, depth, p);
        mpq_div_2exp(depth, depth, 1);
    }
    mpq_set_d(p, (double)v->depth_min);
    mpq_set_d(q, (double)v->depth_max);
    mpq_sub(q, q, p);
    mpq_mul(depth, depth, q);
    mpq_add(depth, depth, p);
    mpq_clears(p, q, NULL);
}

static void check_values(struct oracle_triangle *t, const float value[3], struct random *r)
{
    struct oracle_form f;
    struct oracle_sample s;
    struct textbook b;
    mpq_t got, expected;
    mpq_inits(got, expected, NULL);
    oracle_form_init(&f);
    oracle_sample_init(&s);
    textbook_init(&b);
    t->clipped = false; // so that samples off the triangle, whose values are defined too, can be compared
    for (int n = 0; n < 4; n++) {
        const int x = random_below(r, 16), y = random_below(r, 16);
        oracle_sample_at(&s, t, x, y);
        textbook_weights(&b, t, x, y);
        oracle_form_smooth(&f, t, value);
        form_value(got, &f, &s);
        weighted(expected, b.space, value);
        assert_true(mpq_equal(got, expected));
        // One float further than the truth is 1 ULP off, more or less its own rounding.
        const float rounded = (float)mpq_get_d(expected);
        const double unit = oracle_ulp(fabs((double)rounded)), off = (double)rounded + 16 * unit;
        assert_true(fabs(oracle_error(&f, &s, off, unit) - 16) <= 1);
        double slack;
        const double fast = oracle_error_fast(&f, &s, off, unit, &slack);
        assert_true(fabs(oracle_error(&f, &s, off, unit) - fast) <= slack);
        assert_true(fabs(oracle_value(&f, &s) - mpq_get_d(expected)) <= 0x1p-50 * fabs(mpq_get_d(expected)));
        oracle_form_noperspective(&f, t, value);
        form_value(got, &f, &s);
        weighted(expected, b.screen, value);
        assert_true(mpq_equal(got, expected));
        oracle_form_inverse_w(&f, t);
        form_value(got, &f, &s);
        assert_true(mpq_equal(got, b.inverse_w));
        oracle_form_depth(&f, t);
        form_value(got, &f, &s);
        textbook_depth(expected, &b, t);
        assert_true(mpq_equal(got, expected));
        oracle_sample_right(&s, t);
        form_value(got, &f, &s);
        textbook_weights(&b, t, x + 1, y);
        textbook_depth(expected, &b, t);
        assert_true(mpq_equal(got, expected));
    }
    textbook_clear(&b);
    oracle_sample_clear(&s);
    oracle_form_clear(&f);
    mpq_clears(got, expected, NULL);
}

static void test_values_against_textbook(void **state)
{
    (void)state;
    struct random r = random_start(4, 5, 6);
    struct oracle_triangle t;
    oracle_triangle_init(&t);
    int snapped = 0, homogeneous = 0;
    for (int n = 0; n < 3000; n++) {
        struct oracle_view view = small_view;
        view.x = (float)random_below(&r, 3) - 1;
        view.width = n % 3 ? 16 : 17.25F;
        view.height = n % 5 ? 16 : 15.5F;
        view.minus_one_to_one = n & 1;
        view.depth_min = n % 4 ? 0 : 0.75F;
        view.depth_max = n % 7 ? 1 : 0.3F;
        float position[3][4], value[3];
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 4; k++) {
                position[i][k] = (float)(random_sign(&r) * random_scale(&r, -20, 20));
            }
            position[i][3] = n & 2 || random_chance(&r, 0.5) ? fabsf(position[i][3]) : position[i][3];
            value[i] = (float)(random_sign(&r) * random_scale(&r, -130, 100));
        }
        oracle_triangle_set(&t, &view, (const float(*)[4])position);
        if (t.turn == 0) {
            continue;
        }
        snapped += t.snapped;
        homogeneous += !t.snapped;
        check_values(&t, value, &r);
    }
    assert_true(snapped > 50 && homogeneous > 200);
    oracle_triangle_clear(&t);
}

// The plane Z = 0 cuts both edges of this triangle in their middle: what is left is its lower half.
static void test_clip_by_hand(void **state)
{
    (void)state;
    struct oracle_triangle t;
    oracle_triangle_init(&t);
    const float near_cut[3][4] = {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {0, 1, -0.5F, 1}};
    oracle_triangle_set(&t, &small_view, near_cut);
    assert_true(t.clipped && t.snapped && !t.ambiguous);
    assert_int_equal(t.corner_count, 4);
    const int32_t expected[4][2] = {{0, 4096}, {4096, 4096}, {3072, 2048}, {1024, 2048}};
    assert_memory_equal(t.corner_24_8, expected, sizeof expected);
    // W changes sign along both edges; Z = 0 where W = 0.5 there: (0, -1, 0, 0.5) + half of the others.
    const float behind[3][4] = {{-1, -1, 0.5F, 1}, {1, -1, 0.5F, 1}, {0, 1, -0.5F, 0}};
    oracle_triangle_set(&t, &small_view, behind);
    assert_true(t.clipped && !t.snapped);
    assert_int_equal(t.corner_count, 4);
    const int32_t cut[4][2] = {{0, 4096}, {4096, 4096}, {4096, 2048}, {0, 2048}};
    assert_memory_equal(t.corner_24_8, cut, sizeof cut);
    const float outside[3][4] = {{-1, -1, 2, 1}, {1, -1, 2, 1}, {0, 1, 2, 1}};
    oracle_triangle_set(&t, &small_view, outside);
    assert_true(t.empty);
    const float infinite[3][4] = {{-1, -1, 0, 1}, {1, INFINITY, 0, 1}, {0, 1, 0, 1}};
    oracle_triangle_set(&t, &small_view, infinite);
    assert_true(t.empty);
    oracle_triangle_clear(&t);
}

// Distance in pixels from the centre of pixel (x, y) to the nearest polygon edge.
static double edge_distance(const struct oracle_triangle *t, int x, int y)
{
    double nearest = (double)INFINITY;
    for (int i = 0; i < t->corner_count; i++) {
        const int32_t *const a = t->corner_24_8[i], *const b = t->corner_24_8[(i + 1) % t->corner_count];
        const double dx = b[0] - a[0], dy = b[1] - a[1], px = 256 * x + 128 - a[0], py = 256 * y + 128 - a[1];
        const double length = dx * dx + dy * dy, along = length > 0 ? (px * dx + py * dy) / length : 0;
        const double clamped = along < 0 ? 0 : along > 1 ? 1 : along;
        nearest = fmin(nearest, hypot(px - clamped * dx, py - clamped * dy) / 256);
    }
    return nearest;
}

// The clipped polygon against the definition: a sample is inside when its point of the plane has weights
// >= 0 and 0 <= Z <= W. Snapping may move an edge by less than 1/256 pixel.
static void test_clip_against_definition(void **state)
{
    (void)state;
    struct random r = random_start(7, 8, 9);
    struct oracle_triangle t;
    struct textbook b;
    oracle_triangle_init(&t);
    textbook_init(&b);
    mpq_t z, one;
    mpq_inits(z, one, NULL);
    mpq_set_ui(one, 1, 1);
    int clipped = 0, inside_count = 0;
    for (int n = 0; n < 4000; n++) {
        float position[3][4];
        for (int i = 0; i < 3; i++) {
            const double w = random_between(&r, -0.5, 1.5), reach = n % 5 == 0 ? 1e5 : 3;
            position[i][0] = (float)random_between(&r, -reach, reach);
            position[i][1] = (float)random_between(&r, -reach, reach);
            position[i][2] = (float)random_between(&r, -0.5, 1.5);
            position[i][3] = (float)w;
        }
        oracle_triangle_set(&t, &small_view, (const float(*)[4])position);
        if (t.turn == 0) {
            continue;
        }
        clipped += t.clipped && !t.empty;
        for (int k = 0; k < 8; k++) {
            const int x = random_below(&r, 16), y = random_below(&r, 16);
            textbook_weights(&b, &t, x, y);
            textbook_depth(z, &b, &t);
            bool inside = mpq_sgn(b.inverse_w) > 0 && mpq_sgn(z) >= 0 && mpq_cmp(z, one) <= 0;
            for (int i = 0; i < 3; i++) {
                inside = inside && mpq_sgn(b.space[i]) >= 0;
            }
            if (t.empty || edge_distance(&t, x, y) > 1.0 / 128) {
                assert_int_equal(!t.empty && covered(&t, x, y), inside);
                inside_count += inside;
            }
        }
    }
    assert_true(clipped > 500 && inside_count > 1000);
    mpq_clears(z, one, NULL);
    textbook_clear(&b);
    oracle_triangle_clear(&t);
}

// Against the secant over 2^-30 pixel, taken in rationals.
static void test_derivative_against_secant(void **state)
{
    (void)state;
    struct random r = random_start(10, 11, 12);
    struct oracle_triangle t;
    struct oracle_form f;
    struct oracle_sample s, near;
    mpq_t here, there;
    oracle_triangle_init(&t);
    oracle_form_init(&f);
    oracle_sample_init(&s);
    oracle_sample_init(&near);
    mpq_inits(here, there, NULL);
    for (int n = 0; n < 500; n++) {
        float position[3][4], value[3];
        for (int i = 0; i < 3; i++) {
            place(position[i], random_below(&r, 4096), random_below(&r, 4096), 0.5, random_scale(&r, 0, 4));
            value[i] = (float)random_between(&r, -1, 1);
        }
        oracle_triangle_set(&t, &small_view, (const float(*)[4])position);
        if (t.empty) {
            continue;
        }
        const int axis = n & 1;
        oracle_form_smooth(&f, &t, value);
        oracle_sample_at(&s, &t, 8, 8);
        if (mpz_sgn(s.e[0]) < 0 || mpz_sgn(s.e[1]) < 0 || mpz_sgn(s.e[2]) < 0) {
            continue;
        }
        double size;
        const double derivative = oracle_derivative(&f, &t, &s, axis, &size);
        for (int i = 0; i < 3; i++) { // e·2^30 + step: the ratio does not mind the factor
            mpz_mul_2exp(near.e[i], s.e[i], 30);
            mpz_add(near.e[i], near.e[i], t.edge[i][axis]);
        }
        form_value(here, &f, &s);
        form_value(there, &f, &near);
        mpq_sub(there, there, here);
        const double secant = mpq_get_d(there) * 0x1p30;
        assert_true(fabs(derivative) <= 3 * size);
        assert_true(fabs(derivative - secant) <= 1e-5 * size);
    }
    mpq_clears(here, there, NULL);
    oracle_sample_clear(&near);
    oracle_sample_clear(&s);
    oracle_form_clear(&f);
    oracle_triangle_clear(&t);
}

// Beside a pixel's centre a triangle has what its copy, placed as far the other way, has at the centre.
static void test_beside_is_the_triangle_moved(void **state)
{
    (void)state;
    struct random r = random_start(13, 14, 15);
    struct oracle_triangle t, moved;
    struct oracle_form f, moved_f;
    struct oracle_sample s, at;
    oracle_triangle_init(&t);
    oracle_triangle_init(&moved);
    oracle_form_init(&f);
    oracle_form_init(&moved_f);
    oracle_sample_init(&s);
    oracle_sample_init(&at);
    for (int n = 0; n < 200; n++) {
        const int by[2] = {random_below(&r, 257) - 128, random_below(&r, 257) - 128};
        float position[3][4], value[3];
        int32_t corner[3][2];
        for (int i = 0; i < 3; i++) {
            const int x = 128 + random_below(&r, 3840), y = 128 + random_below(&r, 3840);
            place(position[i], x, y, 0.5, random_scale(&r, 0, 4));
            value[i] = (float)random_between(&r, -1, 1);
            corner[i][0] = x - by[0];
            corner[i][1] = y - by[1];
        }
        oracle_triangle_set(&t, &small_view, (const float(*)[4])position);
        if (t.empty) {
            continue;
        }
        oracle_triangle_set_snapped(&moved, &small_view, (const int32_t(*)[2])corner,
                                    (const float(*)[4])position);
        oracle_form_smooth(&f, &t, value);
        oracle_form_smooth(&moved_f, &moved, value);
        oracle_sample_beside(&s, &t, n % 16, n / 16, by);
        oracle_sample_at(&at, &moved, n % 16, n / 16);
        assert_true(s.inside == at.inside);
        assert_true(oracle_value(&f, &s) == oracle_value(&moved_f, &at));
        assert_true(oracle_error(&moved_f, &at, oracle_value(&f, &s), oracle_ulp(1)) < 1e-6);
    }
    oracle_sample_clear(&at);
    oracle_sample_clear(&s);
    oracle_form_clear(&moved_f);
    oracle_form_clear(&f);
    oracle_triangle_clear(&moved);
    oracle_triangle_clear(&t);
}

static void test_ulp(void **state)
{
    (void)state;
    const float magnitudes[] = {1, 1.5F, 0.99999994F, 1e6F, 3e38F, 0x1p-126F, 0x1p-140F, 0x1p-149F};
    for (size_t i = 0; i < sizeof magnitudes / sizeof *magnitudes; i++) {
        const double next = (double)nextafterf(magnitudes[i], (float)INFINITY);
        if (isfinite(next)) {
            assert_true(oracle_ulp((double)magnitudes[i]) == next - (double)magnitudes[i]);
        }
    }
    assert_true(oracle_ulp(0) == 0x1p-149);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ulp),
        cmocka_unit_test(test_top_left_by_hand),
        cmocka_unit_test(test_coverage_against_rationals),
        cmocka_unit_test(test_values_against_textbook),
        cmocka_unit_test(test_clip_by_hand),
        cmocka_unit_test(test_clip_against_definition),
        cmocka_unit_test(test_derivative_against_secant),
        cmocka_unit_test(test_beside_is_the_triangle_moved),
    };
    return cmocka_run_group_tests_name("oracle", tests, NULL, NULL);
}
