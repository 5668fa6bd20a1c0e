// SPDX-License-Identifier: MIT
// Clipping in rational arithmetic. A point of the triangle is its three weights in space (a, b, c); a plane
// is the three distances of the vertices, so the distance of a point is a·d_A + b·d_B + c·d_C. Cutting one
// plane after the other (Sutherland and Hodgman 1974) then needs no geometry at all, and since nothing is
// ever rounded, the order of the planes does not matter.
#include "oracle_clip.h"

#include <math.h>

enum { PLANES = 6, SIDES_FIRST = 2 };

static const double guard_band = 32768; // pixels from the target's origin

struct polygon {
    int count;
    mpq_t weight[ORACLE_CORNERS][3];
};

// The exact value of a·x + b·y for doubles.
static void combine(mpq_t sum, double a, double x, double b, double y)
{
    mpq_t p, q;
    mpq_inits(p, q, NULL);
    mpq_set_d(p, a);
    mpq_set_d(q, x);
    mpq_mul(sum, p, q);
    mpq_set_d(p, b);
    mpq_set_d(q, y);
    mpq_mul(p, p, q);
    mpq_add(sum, sum, p);
    mpq_clears(p, q, NULL);
}

// Distance of a vertex from a plane, positive inside. The sums centre ± guard_band are exact in double: their
// terms are floats of at most 2^15.
static void plane_distance(mpq_t d, const struct oracle_view *v, const float position[4], int plane)
{
    const double x = (double)position[0], y = (double)position[1];
    const double z = (double)position[2], w = (double)position[3];
    const double half_width = (double)v->width / 2, half_height = (double)v->height / 2;
    const double centre_x = (double)v->x + half_width, centre_y = (double)v->y + half_height;
    switch (plane) {
    case 0: combine(d, 1, z, v->minus_one_to_one ? 1 : 0, w); break;
    case 1: combine(d, -1, z, 1, w); break;
    case 2: combine(d, half_width, x, guard_band + centre_x, w); break;
    case 3: combine(d, -half_width, x, guard_band - centre_x, w); break;
    case 4: combine(d, -half_height, y, guard_band + centre_y, w); break;
    default: combine(d, half_height, y, guard_band - centre_y, w); break;
    }
}

static void dot(mpq_t sum, mpq_t *const weight, mpq_t *const value)
{
    mpq_t p;
    mpq_init(p);
    mpq_mul(sum, weight[0], value[0]);
    mpq_mul(p, weight[1], value[1]);
    mpq_add(sum, sum, p);
    mpq_mul(p, weight[2], value[2]);
    mpq_add(sum, sum, p);
    mpq_clear(p);
}

// The point of the edge from a to b whose distance is 0: (d_b·a − d_a·b) / (d_b − d_a).
static void cut(mpq_t *out, mpq_t *const a, mpq_t *const b, const mpq_t d_a, const mpq_t d_b)
{
    mpq_t difference, p;
    mpq_inits(difference, p, NULL);
    mpq_sub(difference, d_b, d_a);
    for (int i = 0; i < 3; i++) {
        mpq_mul(out[i], d_b, a[i]);
        mpq_mul(p, d_a, b[i]);
        mpq_sub(out[i], out[i], p);
        mpq_div(out[i], out[i], difference);
    }
    mpq_clears(difference, p, NULL);
}

static void copy(mpq_t *out, mpq_t *const in)
{
    for (int i = 0; i < 3; i++) {
        mpq_set(out[i], in[i]);
    }
}

static void cut_polygon(struct polygon *out, struct polygon *in, mpq_t *const distance)
{
    mpq_t d[ORACLE_CORNERS];
    for (int i = 0; i < in->count; i++) {
        mpq_init(d[i]);
        dot(d[i], in->weight[i], distance);
    }
    out->count = 0;
    for (int i = 0; i < in->count; i++) {
        const int next = (i + 1) % in->count;
        const bool here = mpq_sgn(d[i]) >= 0, there = mpq_sgn(d[next]) >= 0;
        if (here) {
            copy(out->weight[out->count++], in->weight[i]);
        }
        // An edge that only touches the plane with one end has that end already.
        if (here != there && mpq_sgn(d[here ? i : next]) != 0) {
            cut(out->weight[out->count++], in->weight[i], in->weight[next], d[i], d[next]);
        }
    }
    for (int i = 0; i < in->count; i++) {
        mpq_clear(d[i]);
    }
}

// Rounds 256·q to the nearest integer, ties to even; *fraction receives the distance from the nearest tie.
static int32_t round_24_8(const mpq_t q, double *fraction)
{
    mpz_t numerator, below, rest;
    mpz_inits(numerator, below, rest, NULL);
    mpz_mul_2exp(numerator, mpq_numref(q), 9);
    mpz_fdiv_qr(below, rest, numerator, mpq_denref(q)); // in half units
    const long half_units = mpz_get_si(below);
    mpq_t part;
    mpq_init(part);
    mpq_set_num(part, rest);
    mpq_set_den(part, mpq_denref(q));
    mpq_canonicalize(part);
    const double over = mpq_get_d(part); // 0..1 half units beyond
    const long whole = half_units >= 0 ? half_units / 2 : -((1 - half_units) / 2);
    const bool odd_half = half_units != 2 * whole;
    *fraction = (odd_half ? over : 1 - over) / 2;
    const bool tie = odd_half && mpz_sgn(rest) == 0;
    const long up = !odd_half ? 0 : tie ? whole & 1 : 1;
    mpq_clear(part);
    mpz_clears(numerator, below, rest, NULL);
    return (int32_t)(whole + up);
}

// Projects one corner and snaps it. `size` is the sum of all terms that an implementation has to add up to
// get there, in 1/256 pixel: its rounding errors grow with that, and a corner that lies nearer to a tie than
// such an error may fairly be snapped either way.
static bool snap_corner(struct oracle_triangle *t, int32_t out[2], mpq_t *const weight)
{
    const struct oracle_view *const v = &t->view;
    mpq_t coordinate[4][3], sum[4], half, centre, position;
    double magnitude[4] = {0, 0, 0, 0};
    for (int k = 0; k < 4; k++) {
        mpq_init(sum[k]);
        for (int i = 0; i < 3; i++) {
            mpq_init(coordinate[k][i]);
            mpq_set_d(coordinate[k][i], (double)t->position[i][k]);
            magnitude[k] += mpq_sgn(weight[i]) == 0 ? 0 : fabs((double)t->position[i][k]);
        }
        dot(sum[k], weight, coordinate[k]);
    }
    mpq_inits(half, centre, position, NULL);
    const bool finite = mpq_sgn(sum[3]) > 0;
    for (int axis = 0; axis < 2 && finite; axis++) {
        const double extent = axis == 0 ? (double)v->width : -(double)v->height;
        mpq_set_d(half, extent / 2);
        mpq_set_d(centre, (axis == 0 ? (double)v->x : (double)v->y) + fabs(extent) / 2);
        mpq_div(position, sum[axis], sum[3]);
        mpq_mul(position, position, half);
        const double reach = fabs(mpq_get_d(position)) + 2 * fabs(mpq_get_d(centre));
        mpq_add(position, position, centre);
        double tie;
        out[axis] = round_24_8(position, &tie);
        const double size = 256 * (magnitude[axis] * fabs(extent) + reach * magnitude[3]) / mpq_get_d(sum[3]);
        t->ambiguous = t->ambiguous || tie < 0x1p-50 * size;
    }
    for (int k = 0; k < 4; k++) {
        mpq_clears(sum[k], coordinate[k][0], coordinate[k][1], coordinate[k][2], NULL);
    }
    mpq_clears(half, centre, position, NULL);
    return finite;
}

// The vertex that a corner is, or −1.
static int corner_vertex(mpq_t *const weight)
{
    for (int i = 0; i < 3; i++) {
        if (mpq_sgn(weight[(i + 1) % 3]) == 0 && mpq_sgn(weight[(i + 2) % 3]) == 0) {
            return i;
        }
    }
    return -1;
}

static void snap_polygon(struct oracle_triangle *t, struct polygon *p)
{
    t->corner_count = p->count;
    for (int i = 0; i < p->count; i++) {
        int32_t *const out = t->corner_24_8[i];
        const int vertex = corner_vertex(p->weight[i]);
        if (vertex >= 0 && oracle_snap(&t->view, t->position[vertex], out)) {
            continue;
        }
        if (!snap_corner(t, out, p->weight[i])) {
            t->corner_count = 0;
            t->ambiguous = true;
            return;
        }
    }
}

void oracle_clip(struct oracle_triangle *t)
{
    struct polygon polygon[2];
    mpq_t distance[3];
    mpq_inits(distance[0], distance[1], distance[2], NULL);
    for (int p = 0; p < 2; p++) {
        for (int i = 0; i < ORACLE_CORNERS; i++) {
            mpq_inits(polygon[p].weight[i][0], polygon[p].weight[i][1], polygon[p].weight[i][2], NULL);
        }
    }
    polygon[0].count = 3;
    for (int i = 0; i < 3; i++) {
        mpq_set_ui(polygon[0].weight[i][i], 1, 1);
    }
    int now = 0;
    for (int plane = 0; plane < PLANES; plane++) {
        bool outside = false;
        for (int i = 0; i < 3; i++) {
            plane_distance(distance[i], &t->view, t->position[i], plane);
            outside = outside || mpq_sgn(distance[i]) < 0;
        }
        // A snapped triangle is inside the guard band by definition, whatever the last bit says.
        if (outside && !(t->snapped && plane >= SIDES_FIRST)) {
            t->clipped = true;
            cut_polygon(&polygon[1 - now], &polygon[now], distance);
            now = 1 - now;
        }
    }
    snap_polygon(t, &polygon[now]);
    for (int p = 0; p < 2; p++) {
        for (int i = 0; i < ORACLE_CORNERS; i++) {
            mpq_clears(polygon[p].weight[i][0], polygon[p].weight[i][1], polygon[p].weight[i][2], NULL);
        }
    }
    mpq_clears(distance[0], distance[1], distance[2], NULL);
}
