// SPDX-License-Identifier: MIT
// What must hold whatever the numbers are. No test here asks the oracle for a value: each compares pictures of
// the pipeline with each other or with the vertices, over random scenes of every family it makes sense for.
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "oracle.h"
#include "probe.h"
#include "random.h"
#include "scene.h"

enum { SEED = 7, MAX_PIXELS = 512 * 512 };

static struct probe *probe;
static struct scene scene, other;
static float saved_count[MAX_PIXELS];

// Fails with the words that show `exactness` where to look.
static void check(bool holds, const struct scene *s, int x, int y)
{
    if (!holds) {
        fail_msg("exactness --family %s --seed %d --index %d --at %d,%d", scene_family_name(s->family), SEED,
                 (int)s->index, x, y);
    }
}

static const struct probe_image *draw(const struct scene *s)
{
    const struct probe_image *const image = probe_draw(probe, s);
    assert_non_null(image);
    return image;
}

static bool cuts(enum family family)
{
    return (family >= FAMILY_NEAR_FAR && family <= FAMILY_HORIZON) || family == FAMILY_CUT_GRID;
}

static bool same_bits(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

// The triangle that owns a fragment, from what the fragment itself said.
static int triangle_at(const struct probe_image *image, int pixel)
{
    return (int)image->flat[pixel][2] - 1;
}

static const struct scene_vertex *vertex_of(const struct scene *s, int triangle, int corner)
{
    return &s->vertex[s->triangle[triangle][corner]];
}

// Signed area of a triangle of snapped vertices; false when one cannot be snapped.
static bool snapped_area(const struct scene *s, int triangle, int64_t *area)
{
    int32_t v[3][2];
    for (int i = 0; i < 3; i++) {
        if (!oracle_snap(&s->view, vertex_of(s, triangle, i)->position, v[i])) {
            return false;
        }
    }
    *area = (int64_t)(v[1][0] - v[0][0]) * (v[2][1] - v[0][1]) -
            (int64_t)(v[2][0] - v[0][0]) * (v[1][1] - v[0][1]);
    return true;
}

// All triangles of the mesh turn the same way on the screen: then none overlaps its neighbours.
static bool turns_one_way(const struct scene *s)
{
    bool positive = false, negative = false;
    for (int i = 0; i < s->triangle_count; i++) {
        int64_t area;
        if (!snapped_area(s, i, &area)) {
            return false;
        }
        positive = positive || area > 0;
        negative = negative || area < 0;
    }
    return positive != negative;
}

struct outline {
    int count;
    int32_t from[3 * SCENE_TRIANGLES][2], to[3 * SCENE_TRIANGLES][2];
};

// The edges of the mesh that no neighbour shares.
static void find_outline(const struct scene *s, struct outline *o)
{
    o->count = 0;
    for (int t = 0; t < s->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            int32_t from[2], to[2];
            oracle_snap(&s->view, vertex_of(s, t, i)->position, from);
            oracle_snap(&s->view, vertex_of(s, t, (i + 1) % 3)->position, to);
            int twin = 0;
            while (twin < o->count &&
                   (memcmp(o->from[twin], to, sizeof to) || memcmp(o->to[twin], from, sizeof from))) {
                twin++;
            }
            if (twin < o->count) {
                o->count--;
                memcpy(o->from[twin], o->from[o->count], sizeof from);
                memcpy(o->to[twin], o->to[o->count], sizeof to);
            } else {
                memcpy(o->from[o->count], from, sizeof from);
                memcpy(o->to[o->count], to, sizeof to);
                o->count++;
            }
        }
    }
}

// How often the outline winds around a sample; a sample on it counts as moved right and, less, down.
static int winding(const struct outline *o, int x, int y)
{
    const int64_t px = 256 * (int64_t)x + 128, py = 256 * (int64_t)y + 128;
    int number = 0;
    for (int i = 0; i < o->count; i++) {
        const int32_t *const a = o->from[i], *const b = o->to[i];
        if ((a[1] <= py) != (b[1] <= py)) {
            const int down = b[1] > a[1] ? 1 : -1;
            // Left of the sample, or through it: (b − a) × (p − a), for the edge taken downwards.
            const int64_t side = (b[0] - a[0]) * (py - a[1]) - (b[1] - a[1]) * (px - a[0]);
            number += side * down <= 0 ? down : 0;
        }
    }
    return abs(number);
}

// Inside its outline a mesh covers every sample exactly once, outside not at all. Meshes that overlap
// themselves are covered as often as the outline winds.
static void test_shared_edges_cover_once(void **state)
{
    (void)state;
    static struct outline outline;
    int meshes = 0;
    for (int family = FAMILY_FAN; family <= FAMILY_GRID; family++) {
        for (uint64_t index = 0; index < 60; index++) {
            scene_make(&scene, (enum family)family, SEED, index);
            if (index % 8 == 7 || !turns_one_way(&scene)) {
                continue;
            }
            meshes++;
            find_outline(&scene, &outline);
            const struct probe_image *const image = draw(&scene);
            for (int i = 0; i < image->width * image->height; i++) {
                const int x = i % image->width, y = i / image->width;
                check(image->count[i] == (float)winding(&outline, x, y), &scene, x, y);
            }
        }
    }
    assert_true(meshes > 60);
}

// Pixels from the centre of pixel (x, y) to the nearest edge of what clipping leaves of a triangle.
static double edge_distance(const struct oracle_triangle *t, int x, int y)
{
    double nearest = DBL_MAX;
    for (int i = 0; i < t->corner_count; i++) {
        const int32_t *const a = t->corner_24_8[i], *const b = t->corner_24_8[(i + 1) % t->corner_count];
        const double dx = b[0] - a[0], dy = b[1] - a[1], px = 256 * x + 128 - a[0], py = 256 * y + 128 - a[1];
        const double length = dx * dx + dy * dy, along = length > 0 ? (px * dx + py * dy) / length : 0;
        const double clamped = along < 0 ? 0 : along > 1 ? 1 : along;
        nearest = fmin(nearest, hypot(px - clamped * dx, py - clamped * dy) / 256);
    }
    return nearest;
}

// A floor that the planes cut, as a grid and as two triangles with the same outline: the grid must cover what
// the two triangles cover, once, up to the rounding of the corners along the outline.
static void make_floor(struct scene *s, struct random *r, int cells)
{
    const double height = random_scale(r, -5, 0), extent = random_scale(r, 2, 8),
                 turn = random_between(r, 0, 6.28);
    const double near = random_scale(r, -8, -3), tilt = random_between(r, -0.3, 0.3);
    struct random jitter = random_start(r->state, 1, 2);
    struct scene_vertex corner[17 * 17];
    memset(corner, 0, sizeof corner);
    for (int i = 0; i < (cells + 1) * (cells + 1); i++) {
        const int column = i % (cells + 1), row = i / (cells + 1);
        const bool rim = column == 0 || row == 0 || column == cells || row == cells;
        const double wobble_u = rim ? 0 : random_between(&jitter, -0.3, 0.3);
        const double wobble_v = rim ? 0 : random_between(&jitter, -0.3, 0.3);
        const double u = ((column + wobble_u) / cells - 0.5) * extent,
                     v = ((row + wobble_v) / cells - 0.5) * extent;
        const double x = u * cos(turn) - v * sin(turn), depth = u * sin(turn) + v * cos(turn);
        corner[i].position[0] = (float)x;
        corner[i].position[1] = (float)(-height + tilt * x);
        corner[i].position[2] = (float)(depth - near);
        corner[i].position[3] = (float)depth;
    }
    s->vertex_count = s->triangle_count = 0;
    for (int row = 0; row < cells; row++) {
        for (int column = 0; column < cells; column++) {
            static const int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}};
            for (int i = 0; i < 6; i++) {
                s->vertex[s->vertex_count] = corner[(row + order[i][1]) * (cells + 1) + column + order[i][0]];
                s->triangle[s->triangle_count + i / 3][i % 3] = s->vertex_count++;
            }
            s->triangle_count += 2;
        }
    }
}

static void test_cut_edges_cover_once(void **state)
{
    (void)state;
    struct oracle_triangle half[2];
    oracle_triangle_init(&half[0]);
    oracle_triangle_init(&half[1]);
    int covered = 0;
    for (uint64_t index = 0; index < 150; index++) {
        scene_make(&scene, FAMILY_CUT_GRID, SEED, 0);
        scene.index = index;
        struct random r = random_start(SEED, FAMILY_CUT_GRID, index), same = r;
        make_floor(&scene, &r, 1);
        for (int t = 0; t < 2; t++) {
            float position[3][4];
            for (int i = 0; i < 3; i++) {
                memcpy(position[i], vertex_of(&scene, t, i)->position, sizeof position[i]);
            }
            oracle_triangle_set(&half[t], &scene.view, (const float(*)[4])position);
        }
        const struct probe_image *image = draw(&scene);
        const int pixels = image->width * image->height;
        memcpy(saved_count, image->count, (size_t)pixels * sizeof *saved_count);
        make_floor(&scene, &same, 12);
        image = draw(&scene);
        for (int i = 0; i < pixels; i++) {
            const int x = i % image->width, y = i / image->width;
            check(image->count[i] <= 1, &scene, x, y);
            if (image->count[i] != saved_count[i]) {
                check(edge_distance(&half[0], x, y) < 1.0 / 64 || edge_distance(&half[1], x, y) < 1.0 / 64,
                      &scene, x, y);
            }
            covered += image->count[i] != 0;
        }
    }
    assert_true(covered > 100000);
    oracle_triangle_clear(&half[0]);
    oracle_triangle_clear(&half[1]);
}

// Equal at the three vertices: bit-equal at every sample, cut or not; −0 too.
static void test_constants_survive(void **state)
{
    (void)state;
    int checked = 0;
    for (int family = 0; family < FAMILY_COUNT; family++) {
        for (uint64_t index = 0; index < 40; index++) {
            scene_make(&scene, (enum family)family, SEED, index);
            scene.kind[0] = VALUE_CONSTANT;
            for (int i = 0; i < scene.vertex_count; i++) {
                scene.vertex[i].value[0] = -0.0F;
            }
            const struct probe_image *const image = draw(&scene);
            for (int k = 0; k < SCENE_VALUES; k++) {
                for (int i = 0; i < image->width * image->height && scene.kind[k] == VALUE_CONSTANT; i++) {
                    if (image->count[i] != 0) {
                        const int x = i % image->width, y = i / image->width;
                        check(same_bits(image->smooth[i][k], scene.vertex[0].value[k]), &scene, x, y);
                        check(same_bits(image->noperspective[i][k], scene.vertex[0].value[k]), &scene, x, y);
                        check(image->ddx[i][k] == 0 && image->ddy[i][k] == 0, &scene, x, y);
                        checked++;
                    }
                }
            }
        }
    }
    assert_true(checked > 100000);
}

static bool same_pixel(const struct probe_image *a, int i, const struct probe_image *b, int k)
{
    return a->count[i] == b->count[k] && same_bits(a->depth[i], b->depth[k]) &&
           !memcmp(a->smooth[i], b->smooth[k], sizeof *a->smooth) &&
           !memcmp(a->noperspective[i], b->noperspective[k], sizeof *a->noperspective) &&
           !memcmp(a->flat[i], b->flat[k], sizeof *a->flat) &&
           !memcmp(a->space[i], b->space[k], sizeof *a->space) &&
           !memcmp(a->screen[i], b->screen[k], sizeof *a->screen) &&
           !memcmp(a->ddx[i], b->ddx[k], sizeof *a->ddx) && !memcmp(a->ddy[i], b->ddy[k], sizeof *a->ddy);
}

// Moving the viewport by whole pixels moves the picture and changes no bit of any number in it, across tiles
// and blocks. Both pictures stand in the same large target at a time.
static void test_translation_changes_nothing(void **state)
{
    (void)state;
    struct probe *const second = probe_create(1, RHW_ISA_COUNT);
    assert_non_null(second);
    int checked = 0;
    for (int family = 0; family < FAMILY_COUNT; family++) {
        for (uint64_t index = 0; index < 24 && !cuts((enum family)family) && family != FAMILY_LARGE;
             index++) {
            struct random r = random_start(SEED, 99, index);
            scene_make(&scene, (enum family)family, SEED, index);
            const int width = scene.view.target_width, height = scene.view.target_height;
            scene.view.target_width = scene.view.target_height = 448;
            other = scene;
            const int dx = random_below(&r, 300), dy = random_below(&r, 300);
            other.view.x += (float)dx;
            other.view.y += (float)dy;
            const struct probe_image *const a = draw(&scene);
            const struct probe_image *const b = probe_draw(second, &other);
            assert_non_null(b);
            for (int y = 0; y < height; y++) {
                for (int x = 0; x < width; x++) {
                    const int from = y * a->width + x, to = (y + dy) * b->width + x + dx;
                    check(same_pixel(a, from, b, to), &scene, x, y);
                    checked += a->count[from] != 0;
                }
            }
        }
    }
    assert_true(checked > 100000);
    probe_destroy(second);
}

static bool near_to(float a, float b, double vertex_max)
{
    return fabs((double)a - (double)b) <= 8 * oracle_ulp(vertex_max);
}

// Smooth and noperspective values of both pictures are the same to within the bound, flat ones to the bit.
static bool values_agree(const struct probe_image *a, const struct probe_image *b, int pixel)
{
    const int t = triangle_at(a, pixel);
    if (memcmp(a->flat[pixel], b->flat[pixel], 2 * sizeof(float)) != 0) {
        return false;
    }
    for (int k = 0; k < SCENE_VALUES; k++) {
        double max = 0;
        for (int i = 0; i < 3; i++) {
            max = fmax(max, fabs((double)vertex_of(&scene, t, i)->value[k]));
        }
        if (!near_to(a->smooth[pixel][k], b->smooth[pixel][k], max) ||
            !near_to(a->noperspective[pixel][k], b->noperspective[pixel][k], max)) {
            return false;
        }
    }
    return true;
}

// A triangle between near and far, and the same one with its Z stretched so that both planes cut it: where both
// are covered, attributes agree and depth is the stretched depth, to within the bound.
static void test_clipping_does_not_show(void **state)
{
    (void)state;
    struct probe *const second = probe_create(1, RHW_ISA_COUNT);
    assert_non_null(second);
    int both = 0, cut_away = 0;
    for (int family = 0; family < FAMILY_COUNT; family++) {
        for (uint64_t index = 0; index < 40 && !cuts((enum family)family); index++) {
            scene_make(&scene, (enum family)family, SEED, index);
            scene.view.depth_min = 0;
            scene.view.depth_max = 1;
            scene.view.minus_one_to_one = false;
            for (int i = 0; i < scene.vertex_count;
                 i++) { // depths 1/4, 1/2, 3/4 that stretch to −1/2, 1/2, 3/2
                const float w = scene.vertex[i].position[3];
                scene.vertex[i].position[2] = w * (0.25F + 0.25F * (float)(i % 3));
            }
            other = scene;
            for (int i = 0; i < other.vertex_count; i++) {
                const float w = scene.vertex[i].position[3];
                other.vertex[i].position[2] = w * (-0.5F + (float)(i % 3));
            }
            const struct probe_image *const whole = draw(&scene);
            const struct probe_image *const cut = probe_draw(second, &other);
            assert_non_null(cut);
            for (int i = 0; i < whole->width * whole->height; i++) {
                const int x = i % whole->width, y = i / whole->width;
                cut_away += whole->count[i] > cut->count[i];
                if (whole->count[i] != 1 || cut->count[i] != 1 || whole->flat[i][2] != cut->flat[i][2]) {
                    continue;
                }
                both++;
                check(values_agree(whole, cut, i), &scene, x, y);
                const double stretched = ((double)whole->depth[i] - 0.25) * 4 - 0.5;
                const double inside = stretched < 0 ? 0 : stretched > 1 ? 1 : stretched;
                check(fabs((double)cut->depth[i] - inside) <= 8 * 0x1p-23, &scene, x, y);
            }
        }
    }
    assert_true(both > 100000 && cut_away > 10000);
    probe_destroy(second);
}

// Between the smallest and the largest vertex value, up to the bound. Smooth values also where the triangle is
// cut; on the screen a vertex behind the eye has a weight of any size, so there is no range to stay in.
static void test_values_stay_in_range(void **state)
{
    (void)state;
    int checked = 0;
    for (int family = 0; family < FAMILY_COUNT; family++) {
        for (uint64_t index = 0; index < 40; index++) {
            scene_make(&scene, (enum family)family, SEED, index);
            const struct probe_image *const image = draw(&scene);
            for (int i = 0; i < image->width * image->height; i++) {
                const int x = i % image->width, y = i / image->width, t = triangle_at(image, i);
                for (int k = 0; k < SCENE_VALUES && t >= 0; k++) {
                    const float a = vertex_of(&scene, t, 0)->value[k], b = vertex_of(&scene, t, 1)->value[k];
                    const float c = vertex_of(&scene, t, 2)->value[k];
                    const double low = (double)fminf(a, fminf(b, c)), high = (double)fmaxf(a, fmaxf(b, c));
                    const double room = 8 * oracle_ulp(fmax(fabs(low), fabs(high)));
                    const double smooth = (double)image->smooth[i][k],
                                 flat = (double)image->noperspective[i][k];
                    check(smooth >= low - room && smooth <= high + room, &scene, x, y);
                    check(cuts((enum family)family) || (flat >= low - room && flat <= high + room), &scene, x,
                          y);
                    checked++;
                }
            }
        }
    }
    assert_true(checked > 100000);
}

// Any order of the vertices covers the same samples, cut or not.
static void test_vertex_order(void **state)
{
    (void)state;
    static const int order[5][3] = {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    int covered = 0;
    for (int family = 0; family < FAMILY_COUNT; family++) {
        for (uint64_t index = 0; index < 20; index++) {
            scene_make(&scene, (enum family)family, SEED, index);
            if (scene.topology != RHW_TRIANGLE_LIST) {
                continue;
            }
            const struct probe_image *image = draw(&scene);
            const int pixels = image->width * image->height;
            memcpy(saved_count, image->count, (size_t)pixels * sizeof *saved_count);
            for (int o = 0; o < 5; o++) {
                other = scene;
                for (int i = 0; i < scene.vertex_count; i++) {
                    other.vertex[i] = scene.vertex[i - i % 3 + order[o][i % 3]];
                }
                image = draw(&other);
                for (int i = 0; i < pixels; i++) {
                    check(image->count[i] == saved_count[i], &scene, i % image->width, i / image->width);
                    covered += image->count[i] != 0;
                }
            }
        }
    }
    assert_true(covered > 100000);
}

// Every instruction set and number of threads gives the same bytes.
static void test_same_bytes(void **state)
{
    (void)state;
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (!rhw_isa_supported((enum rhw_isa)isa)) {
            continue;
        }
        struct probe *const second = probe_create(1 + isa, (enum rhw_isa)isa);
        assert_non_null(second);
        for (int family = 0; family < FAMILY_COUNT; family++) {
            for (uint64_t index = 0; index < 12; index++) {
                scene_make(&scene, (enum family)family, SEED, index);
                const struct probe_image *const a = draw(&scene), *const b = probe_draw(second, &scene);
                assert_non_null(b);
                for (int i = 0; i < a->width * a->height; i++) {
                    check(same_pixel(a, i, b, i), &scene, i % a->width, i / a->width);
                }
            }
        }
        probe_destroy(second);
    }
}

static int create_probe(void **state)
{
    (void)state;
    probe = probe_create(2, RHW_ISA_BASELINE);
    return probe ? 0 : -1;
}

static int destroy_probe(void **state)
{
    (void)state;
    probe_destroy(probe);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_shared_edges_cover_once),
        cmocka_unit_test(test_cut_edges_cover_once),
        cmocka_unit_test(test_constants_survive),
        cmocka_unit_test(test_translation_changes_nothing),
        cmocka_unit_test(test_clipping_does_not_show),
        cmocka_unit_test(test_values_stay_in_range),
        cmocka_unit_test(test_vertex_order),
        cmocka_unit_test(test_same_bytes),
    };
    return cmocka_run_group_tests_name("properties", tests, create_probe, destroy_probe);
}
