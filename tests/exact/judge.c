// SPDX-License-Identifier: MIT
// See judge.h.
#include "judge.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle.h"

enum { MAX_PIXELS = 256 * 256 };

// Doubles decide when their proven bound is below this many ULP; the integers otherwise.
static const double doubt = 0x1p-16;
static const double largest_value = 0x1p126;

struct judge {
    const struct scene *scene;
    struct oracle_triangle triangle[SCENE_TRIANGLES];
    int initialized; // triangles
    bool ambiguous;
    int16_t owner[MAX_PIXELS]; // the last triangle that covers a pixel, or −1
    int16_t count[MAX_PIXELS];
    struct oracle_form smooth[SCENE_VALUES], noperspective[SCENE_VALUES], depth, inverse_w, space[3],
        screen[3];
    struct oracle_sample sample;
};

static const char *const quantity_names[QUANTITY_COUNT] = {
    "smooth",
    "noperspective",
    "depth",
    "1/W",
    "a,b,c",
    "r,s,t",
    "derivative",
    "at samples",
    "at centroids",
    "depth at samples",
    "interpolate_at",
    "point coordinate",
    "along lines",
    "along Bresenham lines",
    "depth of points, lines",
};

static const char *const equality_names[EQUALITY_COUNT] = {
    "coverage",
    "order",
    "flat",
    "constant",
    "facing",
    "depth buffer",
    "place in the pixel",
    "coverage of points or lines",
};

const char *judge_quantity_name(enum quantity quantity)
{
    return quantity_names[quantity];
}

const char *judge_equality_name(enum equality equality)
{
    return equality_names[equality];
}

typedef void form_function(struct oracle_form *form);

static void each_form(struct judge *j, form_function *function)
{
    for (int i = 0; i < SCENE_VALUES; i++) {
        function(&j->smooth[i]);
        function(&j->noperspective[i]);
    }
    for (int i = 0; i < 3; i++) {
        function(&j->space[i]);
        function(&j->screen[i]);
    }
    function(&j->depth);
    function(&j->inverse_w);
}

struct judge *judge_create(void)
{
    struct judge *const j = calloc(1, sizeof *j);
    if (j) {
        each_form(j, oracle_form_init);
        oracle_sample_init(&j->sample);
    }
    return j;
}

void judge_destroy(struct judge *j)
{
    if (j) {
        each_form(j, oracle_form_clear);
        oracle_sample_clear(&j->sample);
        for (int i = 0; i < j->initialized; i++) {
            oracle_triangle_clear(&j->triangle[i]);
        }
        free(j);
    }
}

static void cover(struct judge *j, int number)
{
    const struct oracle_triangle *const t = &j->triangle[number];
    const int width = t->view.target_width;
    int y0, y1;
    oracle_rows(t, &y0, &y1);
    for (int y = y0; y < y1; y++) {
        int run[ORACLE_CORNERS];
        const int ends = oracle_cover_row(t, y, run);
        for (int i = 0; i < ends; i += 2) {
            for (int x = run[i]; x < run[i + 1]; x++) {
                j->owner[y * width + x] = (int16_t)number;
                j->count[y * width + x]++;
            }
        }
    }
}

void judge_prepare(struct judge *j, const struct scene *scene)
{
    const struct oracle_view *const view = &scene->view;
    const size_t pixels = (size_t)view->target_width * (size_t)view->target_height;
    j->scene = scene;
    j->ambiguous = false;
    memset(j->count, 0, pixels * sizeof *j->count);
    memset(j->owner, -1, pixels * sizeof *j->owner);
    for (int i = 0; i < scene->triangle_count; i++) {
        if (i == j->initialized) {
            oracle_triangle_init(&j->triangle[j->initialized++]);
        }
        float position[3][4];
        for (int k = 0; k < 3; k++) {
            memcpy(position[k], scene->vertex[scene->triangle[i][k]].position, sizeof position[k]);
        }
        oracle_triangle_set(&j->triangle[i], view, (const float(*)[4])position);
        j->ambiguous = j->ambiguous || j->triangle[i].ambiguous;
        cover(j, i);
    }
}

static const struct scene_vertex *vertex_of(const struct judge *j, int triangle, int corner)
{
    return &j->scene->vertex[j->scene->triangle[triangle][corner]];
}

static void set_forms(struct judge *j, int triangle)
{
    struct oracle_triangle *const t = &j->triangle[triangle];
    for (int i = 0; i < SCENE_VALUES; i++) {
        float value[3];
        for (int k = 0; k < 3; k++) {
            value[k] = vertex_of(j, triangle, k)->value[i];
        }
        oracle_form_smooth(&j->smooth[i], t, value);
        oracle_form_noperspective(&j->noperspective[i], t, value);
    }
    for (int i = 0; i < 3; i++) {
        const float corner[3] = {i == 0, i == 1, i == 2};
        oracle_form_smooth(&j->space[i], t, corner);
        oracle_form_noperspective(&j->screen[i], t, corner);
    }
    oracle_form_depth(&j->depth, t);
    oracle_form_inverse_w(&j->inverse_w, t);
}

static struct tally_place place_of(const struct judge *j, int triangle, int x, int y, int component)
{
    const struct scene *const s = j->scene;
    return (struct tally_place){(int)s->family, triangle, x, y, component, s->seed, s->index};
}

static void unequal(const struct judge *j, struct judge_results *r, enum equality what, int triangle, int x,
                    int y)
{
    if (r->unequal[what]++ == 0) {
        r->unequal_at[what] = place_of(j, triangle, x, y, 0);
    }
}

static void compare_coverage(const struct judge *j, const struct probe_image *image, struct judge_results *r)
{
    for (int i = 0; i < image->width * image->height; i++) {
        const int x = i % image->width, y = i / image->width;
        if (image->count[i] != (float)j->count[i]) {
            unequal(j, r, EQUAL_COVERAGE, j->owner[i], x, y);
        } else if (image->flat[i][2] != (float)(j->owner[i] + 1)) {
            unequal(j, r, EQUAL_OWNER, j->owner[i], x, y);
        }
    }
}

static bool same_bits(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

// One fragment being compared.
struct fragment {
    struct judge *judge;
    const struct judge_mode *mode;
    struct judge_results *results;
    const struct oracle_triangle *triangle;
    struct tally_place at;
    int pixel;
    bool whole; // no plane of the view cuts the triangle
};

static double error_of(const struct fragment *f, const struct oracle_form *form, double got, double unit)
{
    const struct oracle_sample *const s = &f->judge->sample;
    double slack;
    const double error = oracle_error_fast(form, s, got, unit, &slack);
    return f->mode->integers || !(slack < doubt) ? oracle_error(form, s, got, unit) : error;
}

// Negative: nothing is promised for such values, and nothing was measured.
static double value_error(const struct fragment *f, bool screen, const struct oracle_form *form, float got)
{
    // On the screen, where W changes sign, a value is no mean of the vertex values: it exceeds them as far as
    // the weights exceed 1, and so does the scale of the error.
    const bool mean = f->triangle->snapped || !screen;
    const double scale =
        form->vertex_max * (mean ? 1 : fmax(1, oracle_largest_weight(form, &f->judge->sample)));
    return scale > largest_value ? -1 : error_of(f, form, (double)got, oracle_ulp(scale));
}

static void measure(const struct fragment *f, struct tally *tally, double error, int component)
{
    if (error >= 0 || isnan(error)) {
        struct tally_place at = f->at;
        at.component = component;
        tally_add(tally, error, &at);
    }
}

static void compare_values(const struct fragment *f, const struct probe_image *image)
{
    struct judge *const j = f->judge;
    const probe_pixel *const images[2] = {image->smooth, image->noperspective};
    for (int q = 0; q < 2; q++) {
        const struct oracle_form *const forms = q == 0 ? j->smooth : j->noperspective;
        if (q == 1 && f->mode->peer && !f->whole) {
            continue;
        }
        for (int i = 0; i < SCENE_VALUES && images[q]; i++) {
            const float got = images[q][f->pixel][i];
            if (j->scene->kind[i] == VALUE_CONSTANT) {
                if (!same_bits(got, vertex_of(j, f->at.triangle, 0)->value[i])) {
                    unequal(j, f->results, EQUAL_CONSTANT, f->at.triangle, f->at.x, f->at.y);
                }
                continue;
            }
            const double error = value_error(f, q == 1, &forms[i], got);
            measure(f, &f->results->kind[j->scene->kind[i]][q], error, i);
            if (j->scene->kind[i] <= VALUE_OPPOSITE) {
                measure(f, &f->results->quantity[f->at.family][QUANTITY_SMOOTH + q], error, i);
            }
        }
    }
}

static void compare_weights(const struct fragment *f, const struct probe_image *image)
{
    struct judge *const j = f->judge;
    struct tally *const tallies = f->results->quantity[f->at.family];
    for (int i = 0; i < 3; i++) {
        measure(f, &tallies[QUANTITY_SPACE], value_error(f, false, &j->space[i], image->space[f->pixel][i]),
                i);
        measure(f, &tallies[QUANTITY_SCREEN], value_error(f, true, &j->screen[i], image->screen[f->pixel][i]),
                i);
    }
}

static void compare_depth(const struct fragment *f, const struct probe_image *image)
{
    struct judge *const j = f->judge;
    const struct oracle_view *const v = &j->scene->view;
    const float low = fminf(v->depth_min, v->depth_max), high = fmaxf(v->depth_min, v->depth_max);
    const float got = image->screen[f->pixel][3];
    if (image->depth && !same_bits(got, image->depth[f->pixel])) {
        unequal(j, f->results, EQUAL_DEPTH, f->at.triangle, f->at.x, f->at.y);
    }
    // The truth is clamped to the viewport's range too: a value at an end of the range is right for
    // everything beyond it.
    const double unit = oracle_ulp(j->depth.vertex_max);
    double error = error_of(f, &j->depth, (double)got, unit);
    if (got == low || got == high) {
        const double truth = oracle_value(&j->depth, &j->sample);
        error = (got == low && truth < (double)low) || (got == high && truth > (double)high) ? 0 : error;
    }
    tally_add(&f->results->quantity[f->at.family][QUANTITY_DEPTH], error, &f->at);
    const double least = oracle_least_inverse_w(f->triangle),
                 inverse_w = oracle_value(&j->inverse_w, &j->sample);
    const double got_w = (double)image->space[f->pixel][3];
    const double w_unit = oracle_ulp(fmax(j->inverse_w.vertex_max, fabs(inverse_w)));
    const double w_error = j->sample.linear && inverse_w < least ? fabs(got_w - least) / w_unit
                                                                 : error_of(f, &j->inverse_w, got_w, w_unit);
    tally_add(&f->results->quantity[f->at.family][QUANTITY_INVERSE_W], w_error, &f->at);
}

static void compare_derivatives(const struct fragment *f, const struct probe_image *image)
{
    struct judge *const j = f->judge;
    for (int i = 0; i < SCENE_VALUES; i++) {
        for (int axis = 0; axis < 2; axis++) {
            double size;
            const double truth = oracle_derivative(&j->smooth[i], f->triangle, &j->sample, axis, &size);
            const double got = (double)(axis == 0 ? image->ddx : image->ddy)[f->pixel][i];
            struct tally_place at = f->at;
            at.component = 2 * i + axis;
            if (size < 0x1p127) { // beyond that a float cannot say it
                tally_add(&f->results->quantity[f->at.family][QUANTITY_DERIVATIVE],
                          fabs(got - truth) / oracle_ulp(size), &at);
            }
        }
    }
}

static void compare_equal(const struct fragment *f, const struct probe_image *image)
{
    struct judge *const j = f->judge;
    const float *const got = image->flat[f->pixel];
    const struct scene_vertex *const provoking = vertex_of(j, f->at.triangle, 0);
    if (!same_bits(got[0], provoking->flat[0]) || !same_bits(got[1], provoking->flat[1])) {
        unequal(j, f->results, EQUAL_FLAT, f->at.triangle, f->at.x, f->at.y);
    }
    // A cut polygon may turn over when it is snapped, so only a whole triangle has one right answer.
    if (!f->triangle->clipped && got[3] != (f->triangle->turn < 0 ? 1.0F : 2.0F)) {
        unequal(j, f->results, EQUAL_FACING, f->at.triangle, f->at.x, f->at.y);
    }
}

static void compare_fragment(struct fragment *f, const struct probe_image *image)
{
    struct judge *const j = f->judge;
    f->results->fragments++;
    f->results->outside += !j->sample.inside;
    f->results->family_fragments[f->at.family]++;
    compare_values(f, image);
    if (image->space && image->screen) {
        compare_depth(f, image);
    }
    if (f->mode->peer) {
        return;
    }
    compare_equal(f, image);
    compare_weights(f, image);
    if (j->sample.inside && (f->at.x * 5 + f->at.y * 3) % f->mode->derivative_stride == 0) {
        compare_derivatives(f, image);
    }
}

// −W <= X, Y, Z <= W at every vertex: peers have OpenGL's depth convention.
static bool inside_view(const struct oracle_triangle *t)
{
    bool inside = true;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            inside = inside && fabsf(t->position[i][k]) <= t->position[i][3];
        }
    }
    return inside;
}

static void compare_triangle(struct judge *j, int number, const struct probe_image *image,
                             const struct judge_mode *mode, struct judge_results *r)
{
    struct oracle_triangle *const t = &j->triangle[number];
    int y0, y1;
    oracle_rows(t, &y0, &y1);
    bool ready = false;
    struct fragment f = {.judge = j, .mode = mode, .results = r, .triangle = t, .whole = inside_view(t)};
    for (int y = y0; y < y1; y++) {
        int run[ORACLE_CORNERS];
        const int ends = oracle_cover_row(t, y, run);
        for (int i = 0; i < ends; i += 2) {
            for (int x = run[i], at = -1; x < run[i + 1]; x++) {
                f.pixel = y * image->width + x;
                if (j->owner[f.pixel] != number || image->flat[f.pixel][2] != (float)(number + 1)) {
                    continue; // drawn over, or reported as uncovered already
                }
                if (!ready) {
                    set_forms(j, number);
                    ready = true;
                }
                if (at == x - 1 && at >= 0) {
                    oracle_sample_right(&j->sample, t);
                } else {
                    oracle_sample_at(&j->sample, t, x, y);
                }
                at = x;
                f.at = place_of(j, number, x, y, 0);
                compare_fragment(&f, image);
            }
        }
    }
}

void judge_compare(struct judge *j, const struct probe_image *image, const struct judge_mode *mode,
                   struct judge_results *r)
{
    if (j->ambiguous) {
        r->ambiguous++;
        return;
    }
    r->scenes++;
    if (!mode->peer) {
        compare_coverage(j, image, r);
    }
    for (int i = 0; i < j->scene->triangle_count; i++) {
        const struct oracle_triangle *const t = &j->triangle[i];
        if (t->empty || (mode->peer && t->snapped && !scene_on_grid(j->scene, i))) {
            continue;
        }
        r->triangles++;
        compare_triangle(j, i, image, mode, r);
    }
}

void judge_merge(struct judge_results *into, const struct judge_results *from)
{
    into->scenes += from->scenes;
    into->triangles += from->triangles;
    into->fragments += from->fragments;
    into->ambiguous += from->ambiguous;
    into->outside += from->outside;
    for (int i = 0; i < EQUALITY_COUNT; i++) {
        if (into->unequal[i] == 0) {
            into->unequal_at[i] = from->unequal_at[i];
        }
        into->unequal[i] += from->unequal[i];
    }
    for (int f = 0; f < FAMILY_COUNT; f++) {
        into->family_fragments[f] += from->family_fragments[f];
        for (int q = 0; q < QUANTITY_COUNT; q++) {
            tally_merge(&into->quantity[f][q], &from->quantity[f][q]);
        }
    }
    for (int k = 0; k < VALUE_KINDS; k++) {
        tally_merge(&into->kind[k][0], &from->kind[k][0]);
        tally_merge(&into->kind[k][1], &from->kind[k][1]);
    }
}

static void explain_value(const char *name, const struct oracle_form *form, const struct oracle_sample *s,
                          float got)
{
    const double truth = oracle_value(form, s), unit = oracle_ulp(form->vertex_max);
    printf("  %-14s expected %.17g got %.9g: %.4f ULP of %.9g\n", name, truth, (double)got,
           oracle_error(form, s, (double)got, unit), form->vertex_max);
}

void judge_explain(struct judge *j, const struct probe_image *image, int x, int y)
{
    const int pixel = y * image->width + x, triangle = j->owner[pixel];
    printf("pixel (%d, %d): oracle counts %d, last triangle %d; drawn %g times, last triangle %g\n", x, y,
           j->count[pixel], triangle, image->count ? (double)image->count[pixel] : 1,
           (double)image->flat[pixel][2] - 1);
    for (int n = 0; n < j->scene->triangle_count; n++) {
        struct oracle_triangle *const t = &j->triangle[n];
        if (n != triangle && n != (int)image->flat[pixel][2] - 1) {
            continue;
        }
        printf("triangle %d: %s%s%s%s\n", n, t->snapped ? "snapped" : "homogeneous",
               t->clipped ? ", clipped" : "", t->empty ? ", empty" : "", t->ambiguous ? ", ambiguous" : "");
        for (int i = 0; i < 3; i++) {
            const struct scene_vertex *const v = vertex_of(j, n, i);
            printf("  vertex %a %a %a %a", (double)v->position[0], (double)v->position[1],
                   (double)v->position[2], (double)v->position[3]);
            if (t->snapped) {
                printf("  at %d/256, %d/256", t->vertex_24_8[i][0], t->vertex_24_8[i][1]);
            }
            printf("\n");
        }
        for (int i = 0; i < t->corner_count && t->clipped; i++) {
            printf("  corner %d/256, %d/256\n", t->corner_24_8[i][0], t->corner_24_8[i][1]);
        }
        if (n != triangle) {
            continue;
        }
        set_forms(j, n);
        oracle_sample_at(&j->sample, t, x, y);
        explain_value("1/W", &j->inverse_w, &j->sample, image->space ? image->space[pixel][3] : 0);
        explain_value("depth", &j->depth, &j->sample, image->screen ? image->screen[pixel][3] : 0);
        for (int i = 0; i < 3; i++) {
            explain_value("space weight", &j->space[i], &j->sample,
                          image->space ? image->space[pixel][i] : 0);
            explain_value("screen weight", &j->screen[i], &j->sample,
                          image->screen ? image->screen[pixel][i] : 0);
        }
        for (int i = 0; i < SCENE_VALUES; i++) {
            printf("  %s values %.9g %.9g %.9g\n", scene_kind_name(j->scene->kind[i]),
                   (double)vertex_of(j, n, 0)->value[i], (double)vertex_of(j, n, 1)->value[i],
                   (double)vertex_of(j, n, 2)->value[i]);
            explain_value("smooth", &j->smooth[i], &j->sample, image->smooth[pixel][i]);
            if (image->noperspective) {
                explain_value("noperspective", &j->noperspective[i], &j->sample,
                              image->noperspective[pixel][i]);
            }
        }
    }
}
