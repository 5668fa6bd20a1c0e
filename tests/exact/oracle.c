// SPDX-License-Identifier: MIT
// See oracle.h. Clipping stands in oracle_clip.c.
#include "oracle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle_clip.h"

// Half a unit in the last place of 1, and what one rounding or one truncation of GMP's may cost at most.
static const double rounding = 0x1p-53;
static const double guard_band = 32768; // pixels from the target's origin

double oracle_ulp(double magnitude)
{
    int exponent;
    frexp(magnitude, &exponent);
    const int last = exponent - 24;
    return magnitude == 0 || last < -149 ? 0x1p-149 : ldexp(1, last);
}

void oracle_triangle_init(struct oracle_triangle *t)
{
    for (int i = 0; i < 3; i++) {
        mpz_inits(t->edge[i][0], t->edge[i][1], t->edge[i][2], t->w[i], t->z[i], NULL);
    }
    for (int i = 0; i < 4; i++) {
        mpz_init(t->temporary[i]);
    }
}

void oracle_triangle_clear(struct oracle_triangle *t)
{
    for (int i = 0; i < 3; i++) {
        mpz_clears(t->edge[i][0], t->edge[i][1], t->edge[i][2], t->w[i], t->z[i], NULL);
    }
    for (int i = 0; i < 4; i++) {
        mpz_clear(t->temporary[i]);
    }
}

void oracle_form_init(struct oracle_form *f)
{
    for (int i = 0; i < 3; i++) {
        mpz_inits(f->over[i], f->under[i], NULL);
    }
}

void oracle_form_clear(struct oracle_form *f)
{
    for (int i = 0; i < 3; i++) {
        mpz_clears(f->over[i], f->under[i], NULL);
    }
}

void oracle_sample_init(struct oracle_sample *s)
{
    mpz_inits(s->e[0], s->e[1], s->e[2], s->line[0], s->line[1], s->line[2], s->sum, NULL);
}

void oracle_sample_clear(struct oracle_sample *s)
{
    mpz_clears(s->e[0], s->e[1], s->e[2], s->line[0], s->line[1], s->line[2], s->sum, NULL);
}

// Writes v[i] = out[i]·2^exponent with one exponent for all and returns it.
static long to_integers(int count, const float *v, mpz_t *out)
{
    long lowest = 1000;
    for (int i = 0; i < count; i++) {
        int exponent;
        if (frexp((double)v[i], &exponent) != 0 && exponent - 24 < lowest) {
            lowest = exponent - 24;
        }
    }
    for (int i = 0; i < count; i++) {
        int exponent;
        const double fraction = frexp((double)v[i], &exponent);
        mpz_set_d(out[i], ldexp(fraction, 24));
        if (fraction != 0) {
            mpz_mul_2exp(out[i], out[i], (mp_bitcnt_t)(exponent - 24 - lowest));
        }
    }
    return lowest == 1000 ? 0 : lowest;
}

bool oracle_snap(const struct oracle_view *view, const float position[4], int32_t xy_24_8[2])
{
    const double w = (double)position[3];
    const double half_width = (double)view->width / 2, half_height = (double)view->height / 2;
    if (!(w > 0)) {
        return false;
    }
    const double x = (double)position[0] / w * half_width + ((double)view->x + half_width);
    const double y = ((double)view->y + half_height) - (double)position[1] / w * half_height;
    if (!(fabs(x) <= guard_band && fabs(y) <= guard_band)) {
        return false;
    }
    xy_24_8[0] = (int32_t)rint(x * 256);
    xy_24_8[1] = (int32_t)rint(y * 256);
    return true;
}

// Edge values from snapped positions: below 2^50, so 64-bit integers are exact.
static bool set_snapped_edges(struct oracle_triangle *t)
{
    int64_t c[3][3];
    for (int i = 0; i < 3; i++) {
        const int32_t *const a = t->vertex_24_8[(i + 1) % 3], *const b = t->vertex_24_8[(i + 2) % 3];
        const int64_t dx = (int64_t)b[0] - a[0], dy = (int64_t)b[1] - a[1];
        c[i][0] = -dy * 256;
        c[i][1] = dx * 256;
        c[i][2] = dx * (128 - (int64_t)a[1]) - dy * (128 - (int64_t)a[0]);
    }
    const int64_t area = c[0][2] + c[1][2] + c[2][2];
    t->turn = area > 0 ? 1 : area < 0 ? -1 : 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            mpz_set_si(t->edge[i][j], c[i][j] * t->turn);
        }
    }
    return area != 0;
}

// The viewport in units of 2^-*unit pixel, chosen so that all four numbers and half a pixel are integers.
static void viewport_integers(const struct oracle_view *view, mpz_t rectangle[4], mp_bitcnt_t *unit)
{
    const float numbers[4] = {view->x, view->y, view->width, view->height};
    const long exponent = to_integers(4, numbers, rectangle);
    *unit = exponent < -1 ? (mp_bitcnt_t)-exponent : 1;
    for (int i = 0; i < 4 && exponent > -1; i++) {
        mpz_mul_2exp(rectangle[i], rectangle[i], (mp_bitcnt_t)(exponent + 1));
    }
}

// Edge values of the homogeneous triangle: e_i = (V_j × V_k)·S with V = (X, Y, W) and S the sample as a
// homogeneous point, S ∝ (h·(2x + right), −w·(2y + down), w·h) for pixel (x, y).
static bool set_homogeneous_edges(struct oracle_triangle *t)
{
    float flat[9];
    mpz_t v[9], rectangle[4], cross[3], right, down, det;
    for (int i = 0; i < 9; i++) {
        mpz_init(v[i]);
        flat[i] = t->position[i / 3][i % 3 == 2 ? 3 : i % 3];
    }
    for (int i = 0; i < 4; i++) {
        mpz_init(rectangle[i]);
    }
    mpz_inits(cross[0], cross[1], cross[2], right, down, det, NULL);
    to_integers(9, flat, v);
    mp_bitcnt_t unit;
    viewport_integers(&t->view, rectangle, &unit);
    mpz_setbit(right, unit); // 1 − 2·x − w, the doubled distance of pixel 0 from the viewport's centre
    mpz_submul_ui(right, rectangle[0], 2);
    mpz_sub(right, right, rectangle[2]);
    mpz_setbit(down, unit);
    mpz_submul_ui(down, rectangle[1], 2);
    mpz_sub(down, down, rectangle[3]);
    for (int i = 0; i < 3; i++) {
        mpz_t *const a = &v[3 * ((i + 1) % 3)], *const b = &v[3 * ((i + 2) % 3)];
        for (int k = 0; k < 3; k++) {
            mpz_mul(cross[k], a[(k + 1) % 3], b[(k + 2) % 3]);
            mpz_submul(cross[k], a[(k + 2) % 3], b[(k + 1) % 3]);
            if (i == 0) {
                mpz_addmul(det, cross[k], v[k]);
            }
        }
        mpz_mul(cross[0], cross[0], rectangle[3]);
        mpz_mul(cross[1], cross[1], rectangle[2]);
        mpz_neg(cross[1], cross[1]);
        mpz_mul(cross[2], cross[2], rectangle[2]);
        mpz_mul(cross[2], cross[2], rectangle[3]);
        mpz_mul_2exp(t->edge[i][0], cross[0], unit + 1);
        mpz_mul_2exp(t->edge[i][1], cross[1], unit + 1);
        mpz_set(t->edge[i][2], cross[2]);
        mpz_addmul(t->edge[i][2], cross[0], right);
        mpz_addmul(t->edge[i][2], cross[1], down);
    }
    t->turn = -mpz_sgn(det);
    for (int i = 0; i < 9; i++) {
        mpz_mul_si(t->edge[i / 3][i % 3], t->edge[i / 3][i % 3], -t->turn);
        mpz_clear(v[i]);
    }
    for (int i = 0; i < 4; i++) {
        mpz_clear(rectangle[i]);
    }
    mpz_clears(cross[0], cross[1], cross[2], right, down, det, NULL);
    return t->turn != 0;
}

// A triangle without area has no weights. When it is cut, its corners are snapped one by one and may span some
// area all the same, which nobody else fills: it then has the values of its vertex with the largest W.
static void set_one_vertex_edges(struct oracle_triangle *t)
{
    int nearest = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            mpz_set_ui(t->edge[i][j], 0);
        }
        nearest = t->position[i][3] > t->position[nearest][3] ? i : nearest;
    }
    mpz_set_ui(t->edge[nearest][2], 1);
}

// Comparisons of floats are exact.
static bool in_depth_range(const struct oracle_triangle *t)
{
    for (int i = 0; i < 3; i++) {
        const float z = t->position[i][2], w = t->position[i][3];
        if (!(z <= w && z >= (t->view.minus_one_to_one ? -w : 0))) {
            return false;
        }
    }
    return true;
}

void oracle_triangle_set(struct oracle_triangle *t, const struct oracle_view *view,
                         const float position[3][4])
{
    t->view = *view;
    t->empty = t->clipped = t->ambiguous = false;
    t->snapped = true;
    t->turn = t->corner_count = 0;
    float w[3], z[3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            t->position[i][k] = position[i][k];
            if (!isfinite(position[i][k])) {
                t->empty = true;
                return;
            }
        }
        t->snapped = oracle_snap(view, position[i], t->vertex_24_8[i]) && t->snapped;
        z[i] = position[i][2];
        w[i] = position[i][3];
    }
    t->w_exponent = to_integers(3, w, t->w);
    t->z_exponent = to_integers(3, z, t->z);
    const bool has_area = t->snapped ? set_snapped_edges(t) : set_homogeneous_edges(t);
    if (t->snapped && in_depth_range(t)) {
        t->corner_count = has_area ? 3 : 0;
        memcpy(t->corner_24_8, t->vertex_24_8, sizeof t->vertex_24_8);
    } else {
        oracle_clip(t);
    }
    t->empty = t->corner_count < 3;
    if (!has_area) {
        set_one_vertex_edges(t);
    }
}

void oracle_triangle_set_snapped(struct oracle_triangle *t, const struct oracle_view *view,
                                 const int32_t corner_24_8[3][2], const float position[3][4])
{
    float w[3], z[3];
    t->view = *view;
    t->empty = t->clipped = t->ambiguous = false;
    t->snapped = true;
    t->corner_count = 3;
    memcpy(t->position, position, sizeof t->position);
    memcpy(t->vertex_24_8, corner_24_8, sizeof t->vertex_24_8);
    memcpy(t->corner_24_8, corner_24_8, sizeof t->vertex_24_8);
    for (int i = 0; i < 3; i++) {
        z[i] = position[i][2];
        w[i] = position[i][3];
    }
    t->w_exponent = to_integers(3, w, t->w);
    t->z_exponent = to_integers(3, z, t->z);
    set_snapped_edges(t);
}

// Takes over[], under[] and exponent and fills in the doubles beside them.
static void finish_form(struct oracle_form *f)
{
    for (int i = 0; i < 3; i++) {
        f->over_d[i] = ldexp(mpz_get_d(f->over[i]), (int)f->exponent);
        f->under_d[i] = mpz_get_d(f->under[i]);
    }
}

static double largest(const float value[3])
{
    return fmax(fmax(fabs((double)value[0]), fabs((double)value[1])), fabs((double)value[2]));
}

// under_i = w_j·w_k, the same as 1/W_i up to a common factor.
static void set_inverse_w(mpz_t under, const struct oracle_triangle *t, int i)
{
    mpz_mul(under, t->w[(i + 1) % 3], t->w[(i + 2) % 3]);
}

void oracle_form_smooth(struct oracle_form *f, const struct oracle_triangle *t, const float value[3])
{
    f->exponent = to_integers(3, value, f->over);
    f->screen = false;
    for (int i = 0; i < 3; i++) {
        if (t->snapped) {
            set_inverse_w(f->under[i], t, i);
            mpz_mul(f->over[i], f->over[i], f->under[i]);
        } else {
            mpz_set_ui(f->under[i], 1);
        }
    }
    f->vertex_max = largest(value);
    finish_form(f);
}

void oracle_form_noperspective(struct oracle_form *f, const struct oracle_triangle *t, const float value[3])
{
    f->exponent = to_integers(3, value, f->over);
    f->screen = !t->snapped;
    for (int i = 0; i < 3; i++) {
        if (t->snapped) {
            mpz_set_ui(f->under[i], 1);
        } else {
            mpz_set(f->under[i], t->w[i]);
            mpz_mul(f->over[i], f->over[i], f->under[i]);
        }
    }
    f->vertex_max = largest(value);
    finish_form(f);
}

// Turns a form of z into one of base + range·z; base and range stand in temporary[0] and [1], in units of
// 2^unit.
static void map_range(struct oracle_form *f, struct oracle_triangle *t, long unit)
{
    mpz_t *const temporary = t->temporary;
    const mp_bitcnt_t shift = (mp_bitcnt_t)labs(f->exponent);
    for (int i = 0; i < 3; i++) {
        mpz_mul(temporary[2], temporary[0], f->under[i]);
        mpz_mul(temporary[3], temporary[1], f->over[i]);
        const int coarse = f->exponent < 0 ? 2 : 3;
        mpz_mul_2exp(temporary[coarse], temporary[coarse], shift);
        mpz_add(f->over[i], temporary[2], temporary[3]);
    }
    f->exponent = unit + (f->exponent < 0 ? f->exponent : 0);
}

// The largest depth that the vertices span as far as they are in view. Behind the eye depth runs through
// infinity, so that the visible part may reach either end of the range.
static double largest_depth(const struct oracle_triangle *t)
{
    const double low = (double)t->view.depth_min, high = (double)t->view.depth_max;
    double max = 0;
    for (int i = 0; i < 3; i++) {
        const double w = (double)t->position[i][3];
        if (!(w > 0)) {
            return fmax(low, high);
        }
        double z = (double)t->position[i][2] / w;
        z = t->view.minus_one_to_one ? (z + 1) / 2 : z;
        z = z < 0 ? 0 : z > 1 ? 1 : z;
        max = fmax(max, low + (high - low) * z);
    }
    return max;
}

void oracle_form_depth(struct oracle_form *f, struct oracle_triangle *t)
{
    f->exponent = t->z_exponent - t->w_exponent;
    f->screen = !t->snapped;
    for (int i = 0; i < 3; i++) {
        if (t->snapped) {
            set_inverse_w(f->over[i], t, i);
            mpz_mul(f->over[i], f->over[i], t->z[i]);
            set_inverse_w(f->under[i], t, 0);
            mpz_mul(f->under[i], f->under[i], t->w[0]);
        } else {
            mpz_set(f->over[i], t->z[i]);
            mpz_set(f->under[i], t->w[i]);
        }
    }
    if (t->view.minus_one_to_one) { // (1 + z) / 2
        mpz_set_ui(t->temporary[0], 1);
        mpz_set_ui(t->temporary[1], 1);
        map_range(f, t, -1);
    }
    const float ends[2] = {t->view.depth_min, t->view.depth_max};
    const long unit = to_integers(2, ends, t->temporary);
    mpz_sub(t->temporary[1], t->temporary[1], t->temporary[0]);
    map_range(f, t, unit);
    f->vertex_max = largest_depth(t);
    finish_form(f);
}

void oracle_form_inverse_w(struct oracle_form *f, const struct oracle_triangle *t)
{
    f->exponent = -t->w_exponent;
    f->screen = !t->snapped;
    f->vertex_max = 0;
    for (int i = 0; i < 3; i++) {
        if (t->snapped) {
            set_inverse_w(f->over[i], t, i);
            set_inverse_w(f->under[i], t, 0);
            mpz_mul(f->under[i], f->under[i], t->w[0]);
        } else {
            mpz_set_ui(f->over[i], 1);
            mpz_set(f->under[i], t->w[i]);
        }
        if (t->position[i][3] > 0) {
            f->vertex_max = fmax(f->vertex_max, 1 / (double)t->position[i][3]);
        }
    }
    finish_form(f);
}

void oracle_rows(const struct oracle_triangle *t, int *y0, int *y1)
{
    const struct oracle_view *const v = &t->view;
    *y0 = *y1 = 0;
    if (t->empty) {
        return;
    }
    int32_t top = INT32_MAX, bottom = INT32_MIN;
    for (int i = 0; i < t->corner_count; i++) {
        const int32_t y = t->corner_24_8[i][1];
        top = y < top ? y : top;
        bottom = y > bottom ? y : bottom;
    }
    const int view_top = (int)v->y > 0 ? (int)v->y : 0;
    const int view_bottom =
        v->y + v->height < (float)v->target_height ? (int)(v->y + v->height) : v->target_height;
    *y0 = (top >> 8) > view_top ? top >> 8 : view_top;
    *y1 = (bottom >> 8) + 1 < view_bottom ? (bottom >> 8) + 1 : view_bottom;
    *y1 = *y1 < *y0 ? *y0 : *y1;
}

int oracle_cover_row(const struct oracle_triangle *t, int y, int x[ORACLE_CORNERS])
{
    const struct oracle_view *const v = &t->view;
    const int64_t left = (int)v->x > 0 ? (int)v->x : 0;
    const int64_t right = v->x + v->width < (float)v->target_width ? (int)(v->x + v->width) : v->target_width;
    const int64_t row = 256 * (int64_t)y + 128;
    int count = 0;
    for (int i = 0; i < t->corner_count; i++) {
        const int32_t *a = t->corner_24_8[i], *b = t->corner_24_8[(i + 1) % t->corner_count];
        if ((a[1] <= row) == (b[1] <= row)) {
            continue; // the row, moved down by an infinitesimal amount, does not cross this edge
        }
        if (a[1] > b[1]) {
            const int32_t *const swap = a;
            a = b;
            b = swap;
        }
        // First pixel whose centre 256·x + 128 is at or right of the crossing a.x + (row − a.y)·dx/dy:
        // below 2^24·2^25 + 2^24·2^25, no overflow. Rounded up.
        const int64_t dx = (int64_t)b[0] - a[0], dy = (int64_t)b[1] - a[1];
        const int64_t numerator = (a[0] - (int64_t)128) * dy + (row - a[1]) * dx, denominator = 256 * dy;
        const int64_t quotient = numerator / denominator;
        int64_t first = quotient + (quotient * denominator < numerator);
        first = first < left ? left : first > right ? right : first;
        int at = count++;
        for (; at > 0 && x[at - 1] > (int)first; at--) {
            x[at] = x[at - 1];
        }
        x[at] = (int)first;
    }
    return count;
}

// Snapping may move the polygon of a cut triangle over samples that are off the triangle itself, by less than
// 1/256 pixel. There the triangle's border goes on: an edge value below 0 counts as 0, or values would leave the
// range of the vertices. Should the border be at or behind the eye there, what is linear on the screen goes on
// being linear instead: with a vertex behind the eye it has no range to leave.
static void finish_sample(struct oracle_sample *s, const struct oracle_triangle *t)
{
    s->inside = true;
    for (int i = 0; i < 3; i++) {
        const bool off = mpz_sgn(s->line[i]) < 0;
        s->inside = s->inside && !off;
        mpz_set(s->e[i], s->line[i]);
        if (off && t->clipped) {
            mpz_set_ui(s->e[i], 0);
        }
        s->e_d[i] = mpz_get_d(s->e[i]);
        s->line_d[i] = mpz_get_d(s->line[i]);
    }
    s->linear = false;
    if (!s->inside && !t->snapped) { // W of the border is Σ e_i·W_i / Σ e_i
        mpz_set_ui(s->sum, 0);
        for (int i = 0; i < 3; i++) {
            mpz_addmul(s->sum, s->e[i], t->w[i]);
        }
        s->linear = mpz_sgn(s->sum) <= 0;
    }
}

void oracle_sample_at(struct oracle_sample *s, const struct oracle_triangle *t, int x, int y)
{
    for (int i = 0; i < 3; i++) {
        mpz_mul_si(s->line[i], t->edge[i][1], y);
        mpz_add(s->line[i], s->line[i], t->edge[i][2]);
        if (x >= 0) {
            mpz_addmul_ui(s->line[i], t->edge[i][0], (unsigned long)x);
        }
    }
    finish_sample(s, t);
}

void oracle_sample_beside(struct oracle_sample *s, const struct oracle_triangle *t, int x, int y,
                          const int by_24_8[2])
{
    mpz_t term;
    mpz_init(term);
    const long at[2] = {256 * (long)x + by_24_8[0], 256 * (long)y + by_24_8[1]};
    for (int i = 0; i < 3; i++) {
        mpz_mul_2exp(s->line[i], t->edge[i][2], 8);
        for (int axis = 0; axis < 2; axis++) {
            mpz_mul_si(term, t->edge[i][axis], at[axis]);
            mpz_add(s->line[i], s->line[i], term);
        }
    }
    mpz_clear(term);
    finish_sample(s, t);
}

void oracle_sample_right(struct oracle_sample *s, const struct oracle_triangle *t)
{
    for (int i = 0; i < 3; i++) {
        mpz_add(s->line[i], s->line[i], t->edge[i][0]);
    }
    finish_sample(s, t);
}

// Both sums of the form, exactly.
static void sums(const struct oracle_form *f, const struct oracle_sample *s, mpz_t over, mpz_t under)
{
    mpz_set_ui(over, 0);
    mpz_set_ui(under, 0);
    for (int i = 0; i < 3; i++) {
        mpz_srcptr e = f->screen && s->linear ? s->line[i] : s->e[i];
        mpz_addmul(over, e, f->over[i]);
        mpz_addmul(under, e, f->under[i]);
    }
}

// a / b, correct to three roundings whatever their size.
static double quotient(const mpz_t a, const mpz_t b, long exponent)
{
    long a_exponent, b_exponent;
    const double x = mpz_get_d_2exp(&a_exponent, a), y = mpz_get_d_2exp(&b_exponent, b);
    const long total = a_exponent - b_exponent + exponent;
    return ldexp(x / y, total > 5000 ? 5000 : total < -5000 ? -5000 : (int)total);
}

double oracle_least_inverse_w(const struct oracle_triangle *t)
{
    double w = 0;
    for (int i = 0; i < 3; i++) {
        w = fmax(w, (double)t->position[i][3]);
    }
    return 1 / w;
}

double oracle_value(const struct oracle_form *f, const struct oracle_sample *s)
{
    mpz_t over, under;
    mpz_inits(over, under, NULL);
    sums(f, s, over, under);
    const double value = mpz_sgn(under) == 0 ? (double)NAN : quotient(over, under, f->exponent);
    mpz_clears(over, under, NULL);
    return value;
}

double oracle_error(const struct oracle_form *f, const struct oracle_sample *s, double got, double unit)
{
    mpz_t over, under, scaled;
    double error = (double)NAN;
    mpz_inits(over, under, scaled, NULL);
    sums(f, s, over, under);
    if (mpz_sgn(under) != 0 && isfinite(got)) {
        // got·under − over·2^exponent in the finer of the two units.
        int exponent;
        mpz_set_d(scaled, ldexp(frexp(got, &exponent), 53));
        const long unit_exponent = exponent - 53, shift = unit_exponent - f->exponent;
        mpz_mul(scaled, scaled, under);
        mpz_mul_2exp(shift > 0 ? scaled : over, shift > 0 ? scaled : over, (mp_bitcnt_t)labs(shift));
        mpz_sub(scaled, scaled, over);
        int log2_unit;
        frexp(unit, &log2_unit);
        error = fabs(quotient(scaled, under, (shift > 0 ? f->exponent : unit_exponent) - (log2_unit - 1)));
    } else if (mpz_sgn(under) != 0) {
        error = (double)INFINITY;
    }
    mpz_clears(over, under, scaled, NULL);
    return error;
}

double oracle_error_fast(const struct oracle_form *f, const struct oracle_sample *s, double got, double unit,
                         double *slack)
{
    double over = 0, under = 0, over_size = 0, under_size = 0;
    const double *const e = f->screen && s->linear ? s->line_d : s->e_d;
    for (int i = 0; i < 3; i++) {
        const double n = e[i] * f->over_d[i], d = e[i] * f->under_d[i];
        over += n;
        under += d;
        over_size += fabs(n);
        under_size += fabs(d);
    }
    // Each product carries two truncations of GMP's (2 roundings each) and its own rounding, each sum two
    // more: less than 8 roundings of the sum of magnitudes. The division and the subtraction add theirs.
    const double value = over / under;
    const double over_slack = 8 * rounding * over_size, under_slack = 8 * rounding * under_size;
    const double room = fabs(under) - under_slack;
    *slack = room > 0 ? ((over_slack + fabs(value) * under_slack) / room + 4 * rounding * fabs(value)) *
                            1.001 / unit
                      : (double)INFINITY;
    return fabs(got - value) / unit;
}

double oracle_largest_weight(const struct oracle_form *f, const struct oracle_sample *s)
{
    double largest_term = 0, under = 0;
    const double *const e = f->screen && s->linear ? s->line_d : s->e_d;
    for (int i = 0; i < 3; i++) {
        const double term = e[i] * f->under_d[i];
        largest_term = fmax(largest_term, fabs(term));
        under += term;
    }
    return largest_term / fabs(under);
}

double oracle_derivative(const struct oracle_form *f, const struct oracle_triangle *t,
                         const struct oracle_sample *s, int axis, double *size)
{
    mpz_t over, under, over_step, under_step, square, top;
    mpz_inits(over, under, over_step, under_step, square, top, NULL);
    struct oracle_sample step;
    oracle_sample_init(&step);
    for (int i = 0; i < 3; i++) {
        mpz_set(step.e[i], t->edge[i][axis]);
        mpz_set(step.line[i], t->edge[i][axis]);
    }
    sums(f, s, over, under);
    sums(f, &step, over_step, under_step);
    mpz_mul(square, under, under);
    // weight_i' = (e_i'·under − e_i·under')·under_i / under²; with over_i in place of under_i their sum is
    // the value's derivative.
    *size = 0;
    for (int i = 0; i < 3; i++) {
        mpz_mul(top, step.e[i], under);
        mpz_submul(top, s->e[i], under_step);
        mpz_mul(top, top, f->under[i]);
        *size = fmax(*size, fabs(quotient(top, square, 0)));
    }
    *size *= f->vertex_max;
    mpz_mul(top, over_step, under);
    mpz_submul(top, over, under_step);
    const double derivative = quotient(top, square, f->exponent);
    mpz_clears(over, under, over_step, under_step, square, top, NULL);
    oracle_sample_clear(&step);
    return derivative;
}
