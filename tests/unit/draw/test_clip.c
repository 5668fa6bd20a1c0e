// SPDX-License-Identifier: MIT
// Clipping: near and far planes, the guard band, vertices at and behind the eye. Inside the view nothing
// shows of it: values are those of the whole triangle under every qualifier, and a surface without holes
// stays one. Vertices that are not finite are dropped and counted.
#include "harness.h"
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 128 };

struct camera {
    double near, far, focal; ///< X = focal·x, W = −z
};

static const struct camera eye = {0.25, 100, 1.25};

// Clip coordinates of a point in camera space (y up, looking down −z).
static void project(const struct camera *camera, const double point[3], float clip[4])
{
    const double w = -point[2];
    clip[0] = (float)(camera->focal * point[0]);
    clip[1] = (float)(camera->focal * point[1]);
    clip[2] = (float)((w - camera->near) * camera->far / (camera->far - camera->near));
    clip[3] = (float)w;
}

// Homogeneous screen vertex (x·W, y·W, W in pixels) of a clip position.
static void to_screen(const float clip[4], double screen[3])
{
    screen[0] = ((double)clip[0] + (double)clip[3]) * 0.5 * SIZE;
    screen[1] = ((double)clip[3] - (double)clip[1]) * 0.5 * SIZE;
    screen[2] = (double)clip[3];
}

static void set_counting(struct rig *rig)
{
    rig_set_target(rig, 0, RHW_FORMAT_R32_FLOAT);
    rig->pipeline.targets[0].blend = true;
    rig->pipeline.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
}

static void mixed_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 3; c++) {
            groups[g].color[0][c] = groups[g].varying[c];
        }
        groups[g].color[0][3] = rhw_splat(1);
    }
}

static void open_mixed(struct rig *rig)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_depth(rig);
    rig->pipeline.depth_compare = RHW_COMPARE_ALWAYS;
    rig_set_program(rig, rig_vertex_pass, mixed_fragment);
    rig->pipeline.program.varyings[0] = (struct rhw_varying){.components = 1};
    rig->pipeline.program.varyings[1] = (struct rhw_varying){.components = 1, .qualifier = RHW_NOPERSPECTIVE};
    rig->pipeline.program.varyings[2] = (struct rhw_varying){.components = 2, .qualifier = RHW_FLAT};
    rig->pipeline.program.varying_count = 3;
}

// Pixels whose truth lies this close to a plane or an edge may go either way: the cut is snapped to 1/256.
static bool is_clear_of_edges(const double screen[3][3], const double x, const double y, bool *inside)
{
    const double step = 2.0 / 256;
    for (int k = 0; k < 5; k++) {
        const double dx = (k == 1) * step - (k == 2) * step, dy = (k == 3) * step - (k == 4) * step;
        const struct ref_weights w = ref_weights_homogeneous(screen, x + dx, y + dy);
        const double least = fmin(w.space[0], fmin(w.space[1], w.space[2]));
        const bool in = least > 0 && w.w > 0;
        if (k == 0) {
            *inside = in;
        } else if (in != *inside) {
            return false;
        }
    }
    return true;
}

struct clip_row {
    struct rig_vertex vertices[3];
    double screen[3][3], values[3][3], depth[3];
};

static struct clip_row random_row(uint64_t *random, double low_z, double high_z, double spread)
{
    struct clip_row row;
    memset(&row, 0, sizeof row);
    for (int i = 0; i < 3; i++) {
        const double point[3] = {(double)rig_random_float(random, -1, 1) * spread,
                                 (double)rig_random_float(random, -1, 1) * spread,
                                 (double)rig_random_float(random, (float)low_z, (float)high_z)};
        project(&eye, point, row.vertices[i].position);
        to_screen(row.vertices[i].position, row.screen[i]);
        for (int c = 0; c < 3; c++) {
            row.vertices[i].value[c] = rig_random_float(random, 1, 2);
            row.values[c][i] = (double)row.vertices[i].value[c];
        }
        row.depth[i] = (double)row.vertices[i].position[2];
    }
    return row;
}

// Compares every pixel that is clear of edges and planes with the homogeneous triangle.
static int check_row(struct rig *rig, const struct clip_row *row, double relative)
{
    rig_draw_once(rig, row->vertices, 3);
    static float depth[SIZE * SIZE];
    memcpy(depth, rig_read_depth(rig), sizeof depth);
    const float(*pixels)[4] = rig_read_float4(rig);
    int compared = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double x = i % SIZE + 0.5, y = i / SIZE + 0.5;
        bool inside;
        if (!is_clear_of_edges(row->screen, x, y, &inside)) {
            continue;
        }
        const struct ref_weights w = ref_weights_homogeneous(row->screen, x, y);
        const double z = ref_mix(w.space, row->depth) / w.w;
        if (inside && (fabs(z) < 1e-3 || fabs(z - 1) < 1e-3)) {
            continue;
        }
        const bool visible = inside && z > 0 && z < 1;
        if ((pixels[i][3] != 0) != visible) {
            fail_msg("pixel %d,%d is %s", i % SIZE, i / SIZE, visible ? "missing" : "too much");
        }
        if (!visible) {
            continue;
        }
        compared++;
        const double expected[3] = {ref_mix(w.space, row->values[0]), ref_mix(w.screen, row->values[1]),
                                    row->values[2][0]};
        // A screen-linear value is extrapolated beyond its vertices where W changes sign.
        const double reach = 1 + fabs(w.screen[0]) + fabs(w.screen[1]) + fabs(w.screen[2]);
        for (int c = 0; c < 3; c++) {
            const double allowed = c == 2 ? 0 : relative * (c == 1 ? reach : 1) * 2;
            if (!(fabs((double)pixels[i][c] - expected[c]) <= allowed)) {
                fail_msg("pixel %d,%d value %d: %.9g, not %.12g", i % SIZE, i / SIZE, c, (double)pixels[i][c],
                         expected[c]);
            }
        }
        if (!(fabs((double)depth[i] - z) <= relative * reach)) {
            fail_msg("pixel %d,%d depth: %.9g, not %.12g", i % SIZE, i / SIZE, (double)depth[i], z);
        }
    }
    return compared;
}

// A vertex at or behind the eye cannot be snapped: the truth is the homogeneous triangle and the bound 8 ULP.
static void test_values_of_triangles_with_vertices_behind_the_eye(void **state)
{
    (void)state;
    struct rig rig;
    open_mixed(&rig);
    uint64_t random = 22;
    int compared = 0;
    for (int n = 0; n < 400; n++) {
        struct clip_row row = random_row(&random, -6, 3, 4);
        const bool some_behind = row.screen[0][2] <= 0 || row.screen[1][2] <= 0 || row.screen[2][2] <= 0;
        if (some_behind) {
            compared += check_row(&rig, &row, 8 * rig_ulp(1));
        }
    }
    assert_true(compared > 100000);
    rig_close(&rig);
}

// All vertices before the eye, some before the near or behind the far plane. Snapping moves them by 1/512
// pixel, which the truth does not know: positions are put on the raster first.
static void test_values_of_triangles_across_near_and_far(void **state)
{
    (void)state;
    struct rig rig;
    open_mixed(&rig);
    uint64_t random = 23;
    int compared = 0;
    for (int n = 0; n < 400; n++) {
        struct clip_row row = random_row(&random, -150, -0.01, 60);
        for (int i = 0; i < 3; i++) {
            float *p = row.vertices[i].position;
            const float w = ldexpf(1, rig_random_int(&random, 14) - 6);
            rig_place(&rig, (float)(rig_random_int(&random, 3 * SIZE * 256) - SIZE * 256) / 256,
                      (float)(rig_random_int(&random, 3 * SIZE * 256) - SIZE * 256) / 256, 0, w, p);
            p[2] = (float)(((double)w - eye.near) * eye.far / (eye.far - eye.near));
            to_screen(p, row.screen[i]);
            row.depth[i] = (double)p[2];
        }
        compared += check_row(&rig, &row, 8 * rig_ulp(1));
    }
    assert_true(compared > 100000);
    rig_close(&rig);
}

// The same picture with every order of the vertices and both windings: clipping must not depend on it.
static void test_vertex_order_does_not_change_what_is_covered(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    uint64_t random = 24;
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}, {1, 0, 2}, {0, 2, 1}};
    for (int n = 0; n < 200; n++) {
        const struct clip_row row = random_row(&random, -6, 3, 5);
        static float first[SIZE * SIZE][4];
        for (int o = 0; o < 6; o++) {
            struct rig_vertex vertices[3];
            for (int i = 0; i < 3; i++) {
                vertices[i] = row.vertices[orders[o][i]];
                memcpy(vertices[i].value, (const float[4]){1, 2, 3, 4}, sizeof vertices[i].value);
            }
            rig_draw_once(&rig, vertices, 3);
            if (o == 0) {
                memcpy(first, rig_read_float4(&rig), sizeof first);
            } else {
                assert_memory_equal(first, rig_read_float4(&rig), sizeof first);
            }
        }
    }
    rig_close(&rig);
}

static double volume(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// A sphere around the eye whose radius changes from corner to corner: every ray from the eye meets it once,
// so every pixel must be drawn exactly once, through all the planes its triangles cross.
static void check_sphere(double nearest, double farthest, uint64_t seed, enum rhw_depth_range range)
{
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    set_counting(&rig);
    rig.pipeline.depth_range = range;
    uint64_t random = seed;
    enum { ROWS = 11, COLUMNS = 17 };
    static double points[ROWS + 1][COLUMNS][3];
    const double turn = (double)rig_random_float(&random, 0, 6);
    for (int j = 0; j <= ROWS; j++) {
        for (int i = 0; i < COLUMNS; i++) {
            const bool pole = j == 0 || j == ROWS;
            const double u = (i + (pole ? 0 : (double)rig_random_float(&random, -0.2f, 0.2f))) *
                             6.283185307179586 / COLUMNS;
            const double v =
                (j + (pole ? 0 : (double)rig_random_float(&random, -0.2f, 0.2f))) * 3.141592653589793 / ROWS;
            const double radius =
                pole ? farthest : nearest * pow(farthest / nearest, (double)rig_random_float(&random, 0, 1));
            const double s[3] = {pole ? 0 : sin(v) * cos(u), pole ? (j ? -1 : 1) : cos(v),
                                 pole ? 0 : sin(v) * sin(u)};
            // Poles lie off the view's axis, so that the eye looks at an ordinary part.
            points[j][i][0] = radius * (s[0] * cos(turn) - s[1] * sin(turn));
            points[j][i][1] = radius * (s[0] * sin(turn) + s[1] * cos(turn));
            points[j][i][2] = radius * s[2];
        }
    }
    static struct rig_vertex vertices[ROWS * COLUMNS * 6];
    int count = 0;
    for (int j = 0; j < ROWS; j++) {
        for (int i = 0; i < COLUMNS; i++) {
            const double *q[4] = {points[j][i], points[j][(i + 1) % COLUMNS], points[j + 1][i],
                                  points[j + 1][(i + 1) % COLUMNS]};
            const int corners[6] = {0, 1, 2, 2, 1, 3};
            // The model itself must be without folds, else a second layer would be right.
            assert_true(j == 0 || volume(q[0], q[1], q[2]) > 0);
            assert_true(j == ROWS - 1 || volume(q[2], q[1], q[3]) > 0);
            for (int k = 0; k < 6; k++) {
                project(&eye, q[corners[k]], vertices[count].position);
                // Z is of no interest: half way between the planes for every W.
                const float w = vertices[count].position[3];
                vertices[count].position[2] = range == RHW_DEPTH_ZERO_TO_ONE ? w * 0.5f : 0;
                memcpy(vertices[count].value, (const float[4]){1, 1, 1, 1}, sizeof vertices->value);
                count++;
            }
        }
    }
    rig_draw_once(&rig, vertices, count);
    const float *counts = rig_read(&rig, rig.pass.colors[0].texture);
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (counts[i] != 1) {
            fail_msg("seed %d: pixel %d,%d is drawn %g times", (int)seed, i % SIZE, i / SIZE,
                     (double)counts[i]);
        }
    }
    rig_close(&rig);
}

static void test_no_cracks_around_the_eye(void **state)
{
    (void)state;
    for (uint64_t seed = 100; seed < 140; seed++) {
        check_sphere(1, 1, seed, RHW_DEPTH_ZERO_TO_ONE);
        check_sphere(0.001, 1000, seed, RHW_DEPTH_ZERO_TO_ONE); // far beyond the guard band
        check_sphere(0.5, 50, seed, RHW_DEPTH_MINUS_ONE_TO_ONE);
    }
}

// A plane through near, far and the eye's own plane, made of random triangles: every pixel at most once, and
// exactly once where the plane lies well between near and far.
static void test_no_cracks_across_near_and_far(void **state)
{
    (void)state;
    enum { CELLS = 12 };
    uint64_t random = 25;
    for (int n = 0; n < 40; n++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        set_counting(&rig);
        const double height = (double)rig_random_float(&random, 0.1f, 2),
                     roll = (double)rig_random_float(&random, 0, 6);
        const struct camera camera = {0.25, 20, 1.25};
        static double points[CELLS + 1][CELLS + 1][3];
        for (int j = 0; j <= CELLS; j++) {
            for (int i = 0; i <= CELLS; i++) {
                const double jx = (double)rig_random_float(&random, -0.25f, 0.25f);
                const double jz = (double)rig_random_float(&random, -0.25f, 0.25f);
                const double x = (i + jx - CELLS * 0.5) * 40, z = (j + jz - CELLS * 0.5) * 40;
                points[j][i][0] = x * cos(roll) + height * sin(roll);
                points[j][i][1] = x * sin(roll) - height * cos(roll);
                points[j][i][2] = z;
            }
        }
        static struct rig_vertex vertices[CELLS * CELLS * 6];
        int count = 0;
        for (int j = 0; j < CELLS; j++) {
            for (int i = 0; i < CELLS; i++) {
                const int corners[6][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 0}, {0, 1}, {1, 1}};
                for (int k = 0; k < 6; k++, count++) {
                    project(&camera, points[j + corners[k][0]][i + corners[k][1]], vertices[count].position);
                    memcpy(vertices[count].value, (const float[4]){1, 1, 1, 1}, sizeof vertices->value);
                }
            }
        }
        rig_draw_once(&rig, vertices, count);
        const float *counts = rig_read(&rig, rig.pass.colors[0].texture);
        int once = 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            // The ray through the pixel meets the plane at W = height / (down component of the ray).
            const double rx = ((i % SIZE + 0.5) / (SIZE / 2) - 1) / camera.focal;
            const double ry = (1 - (i / SIZE + 0.5) / (SIZE / 2)) / camera.focal;
            const double down = rx * sin(roll) - ry * cos(roll), w = down > 0 ? height / down : 1e9;
            const bool surely = w > camera.near * 1.05 && w < camera.far * 0.95;
            const bool surely_not = w < camera.near * 0.95 || w > camera.far * 1.05;
            if (counts[i] > 1 || (surely && counts[i] != 1) || (surely_not && counts[i] != 0)) {
                fail_msg("plane %d: pixel %d,%d (W %.3g) is drawn %g times", n, i % SIZE, i / SIZE, w,
                         (double)counts[i]);
            }
            once += counts[i] == 1;
        }
        assert_true(once > 1000);
        assert_true(rig.stats.triangles_clipped > 0);
        rig_close(&rig);
    }
}

static void test_w_of_zero_and_less_is_ordinary(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    const float rows[][3][4] = {
        {{0, 0, 0, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}},                 // all at the eye
        {{-1, -1, 0.5f, -1}, {3, -1, 0.5f, -1}, {-1, 3, 0.5f, -1}}, // all behind it
        {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}},
        {{-1, -1, -0.5f, -1}, {3, -1, -0.5f, -1}, {-1, 3, -0.5f, -1}}, // behind, with Z/W in range
        {{0, 0, -1, 0}, {1, 1, 1, 0}, {1, 0, 1, -0.0f}},
    };
    for (size_t n = 0; n < sizeof rows / sizeof *rows; n++) {
        struct rig_vertex vertices[3] = {0};
        for (int i = 0; i < 3; i++) {
            memcpy(vertices[i].position, rows[n][i], sizeof rows[n][i]);
        }
        rig_draw_once(&rig, vertices, 3);
        assert_int_equal(rig.stats.triangles_in, 1);
        assert_int_equal(rig.stats.triangles_dropped, 0);
        assert_int_equal(rig.stats.triangles_culled, 1);
        assert_int_equal(rig.stats.fragments_shaded, 0);
    }
    // A corner infinitely far up (W = 0) over the lower border of the view: a strip without end that fills it.
    const struct rig_vertex strip[3] = {
        {{0, 1, 0, 0}, {1, 1, 1, 1}}, {{-4, -4, 2, 4}, {1, 1, 1, 1}}, {{4, -4, 2, 4}, {1, 1, 1, 1}}};
    rig_draw_once(&rig, strip, 3);
    assert_int_equal(rig.stats.fragments_shaded, SIZE * SIZE);
    assert_int_equal(rig.stats.triangles_clipped, 1);
    rig_close(&rig);
}

static void test_positions_that_are_not_finite_are_dropped(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    struct rig_vertex all[6];
    const float values[] = {NAN, -NAN, INFINITY, -INFINITY};
    for (int v = 0; v < 4; v++) {
        for (int vertex = 0; vertex < 3; vertex++) {
            for (int c = 0; c < 4; c++) {
                rig_cover(&rig, 0.5f, (const float[4]){1, 1, 1, 1}, all);
                all[vertex].position[c] = values[v];
                rig_draw_once(&rig, all, 6);
                assert_int_equal(rig.stats.triangles_in, 2);
                assert_int_equal(rig.stats.triangles_dropped, 1);
                assert_int_equal(rig.stats.triangles_rasterized, 1);
                // The second triangle is whole.
                const float(*pixels)[4] = rig_read_float4(&rig);
                assert_true(pixels[SIZE - 1][0] == 1 && pixels[(SIZE - 1) * SIZE][0] == 0);
            }
        }
    }
    rig_close(&rig);
}

// The largest finite coordinates overflow in any product of floats; they are still no reason to crash or to
// draw outside the triangle.
static void test_huge_and_tiny_coordinates(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    const float scales[] = {3e38f, 1e30f, 1e20f, 1e-20f, 1e-30f, 1e-38f, 1e-44f};
    for (size_t n = 0; n < sizeof scales / sizeof *scales; n++) {
        const float s = scales[n];
        const struct rig_vertex triangle[3] = {
            {{-s, -s, 0, s}, {1, 1, 1, 1}}, {{s, -s, 0, s}, {1, 1, 1, 1}}, {{-s, s, 0, s}, {1, 1, 1, 1}}};
        rig_draw_once(&rig, triangle, 3);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                if (x != y) {
                    assert_true((pixels[y * SIZE + x][0] == 1) == (x < y));
                }
            }
        }
    }
    uint64_t random = 26;
    for (int n = 0; n < 2000; n++) {
        struct rig_vertex vertices[3] = {0};
        for (int i = 0; i < 12; i++) {
            const float magnitude =
                ldexpf(rig_random_float(&random, -1, 1), rig_random_int(&random, 270) - 145);
            vertices[i / 4].position[i % 4] = rig_random_int(&random, 8) ? magnitude : 0;
        }
        rig_draw_once(&rig, vertices, 3);
        assert_int_equal(rig.stats.triangles_in, rig.stats.triangles_dropped + rig.stats.triangles_culled +
                                                     rig.stats.triangles_rasterized);
    }
    rig_close(&rig);
}

static void test_clipped_triangles_keep_the_winding(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    uint64_t random = 27;
    for (int n = 0; n < 300; n++) {
        const struct clip_row row = random_row(&random, -6, 3, 4);
        uint64_t hash[3];
        rig_begin(&rig);
        rig_draw(&rig, row.vertices, 3);
        rig_end(&rig);
        hash[0] = rig_hash(&rig, 0);
        const uint64_t shaded = rig.stats.fragments_shaded;
        uint64_t sum = 0;
        for (int cull = RHW_CULL_FRONT; cull <= RHW_CULL_BACK; cull++) {
            rig.pipeline.cull = (enum rhw_cull)cull;
            rig_draw_once(&rig, row.vertices, 3);
            sum += rig.stats.fragments_shaded;
            hash[cull] = rig_hash(&rig, 0);
        }
        rig.pipeline.cull = RHW_CULL_NONE;
        // One side sees all of it, the other nothing; which one is the sign of det(X, Y, W).
        assert_int_equal(sum, shaded);
        if (shaded == 0) {
            continue;
        }
        double det = 0;
        for (int i = 0; i < 3; i++) {
            const float *a = row.vertices[i].position, *b = row.vertices[(i + 1) % 3].position,
                        *c = row.vertices[(i + 2) % 3].position;
            det += (double)a[3] * ((double)b[0] * (double)c[1] - (double)b[1] * (double)c[0]);
        }
        assert_true(hash[0] == hash[det > 0 ? RHW_CULL_BACK : RHW_CULL_FRONT]);
    }
    rig_close(&rig);
}

// A sliver that the near plane of Z from 0 cuts.
static void make_sliver(uint64_t *random, struct rig_vertex vertices[3])
{
    memset(vertices, 0, 3 * sizeof *vertices);
    const float t = rig_random_float(random, 0.1f, 0.9f),
                breadth = ldexpf(rig_random_float(random, -1, 1), -5 - rig_random_int(random, 6));
    float *const a = vertices[0].position, *const b = vertices[1].position, *const c = vertices[2].position;
    for (int i = 0; i < 4; i++) {
        a[i] = rig_random_float(random, i == 3 ? 0.5f : -3, i == 3 ? 4 : 3);
        b[i] = rig_random_float(random, i == 3 ? 0.5f : -3, i == 3 ? 4 : 3);
        c[i] = a[i] + t * (b[i] - a[i]) + breadth * rig_random_float(random, -1, 1);
    }
    a[2] = -rig_random_float(random, 0.1f, 8);
}

// Twice the area on the screen of the snapped vertices, in 1/65536 square pixels; y points down.
static int64_t snapped_area(const struct rig_vertex vertices[3])
{
    int64_t x[3], y[3];
    for (int i = 0; i < 3; i++) {
        const double w = (double)vertices[i].position[3];
        x[i] = (int64_t)nearbyint(((double)vertices[i].position[0] / w + 1) * SIZE / 2 * 256);
        y[i] = (int64_t)nearbyint((1 - (double)vertices[i].position[1] / w) * SIZE / 2 * 256);
    }
    return (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
}

// What is left of a sliver may cross itself and seem to turn the other way: the triangle itself is asked.
static void test_clipped_slivers_keep_the_winding(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    uint64_t random = 29;
    int drawn = 0;
    for (int n = 0; n < 8000; n++) {
        struct rig_vertex vertices[3];
        make_sliver(&random, vertices);
        const int64_t area = snapped_area(vertices);
        if (area == 0) {
            continue;
        }
        rig.pipeline.cull = RHW_CULL_NONE;
        rig_draw_once(&rig, vertices, 3);
        const uint64_t shaded = rig.stats.fragments_shaded;
        rig.pipeline.cull = area < 0 ? RHW_CULL_BACK : RHW_CULL_FRONT;
        rig_draw_once(&rig, vertices, 3);
        assert_int_equal(rig.stats.fragments_shaded, shaded);
        drawn += shaded != 0;
    }
    assert_true(drawn > 1000);
    rig_close(&rig);
}

// Draws a triangle with Z from −W and tells whether a pixel is covered.
static bool covers(const struct rig_vertex sliver[3], struct rhw_viewport viewport, enum rhw_cull cull, int x,
                   int y)
{
    struct rig rig;
    rig_open(&rig, 131, 117);
    rig.pipeline.depth_range = RHW_DEPTH_MINUS_ONE_TO_ONE;
    rig.pipeline.cull = cull;
    rig_begin(&rig);
    rhw_pass_set_viewport(rig.context, rig.recording, &viewport);
    rig_draw(&rig, sliver, 3);
    rig_end(&rig);
    const bool covered = rig_read_float4(&rig)[y * 131 + x][0] == 1;
    rig_close(&rig);
    return covered;
}

// What the near plane leaves of this sliver is a quad that crosses itself once its corners are snapped, and whose
// halves have areas of opposite sign that add up to 0. (Found by script/exactness: near_far, seed 1, index 55759.)
static void test_a_polygon_that_crosses_itself(void **state)
{
    (void)state;
    static const struct rig_vertex sliver[3] = {
        {{0x1.161cf4p-1f, 0x1.b75c6ep-2f, -0x1.c2fde8p+11f, 0x1.baa02ep-1f}, {1, 1, 1, 1}},
        {{0x1.b27422p+0f, 0x1.06a594p+1f, -0x1.e506dcp+0f, 0x1.2bae9ap+1f}, {1, 1, 1, 1}},
        {{-0x1.71fe02p+2f, -0x1.e67618p+1f, -0x1.016ea6p+2f, 0x1.052f18p+2f}, {1, 1, 1, 1}}};
    const struct rhw_viewport viewport = {37, 19, 86, 92, 0, 1};
    assert_true(covers(sliver, viewport, RHW_CULL_NONE, 40, 88));
    assert_true(covers(sliver, viewport, RHW_CULL_BACK, 40, 88)); // it turns counter-clockwise
    assert_false(covers(sliver, viewport, RHW_CULL_FRONT, 40, 88));
}

// The snapped vertices of this one lie on a line, and its polygon has an area. (cut_sliver, seed 1, index 20449.)
static void test_a_polygon_of_a_triangle_without_area(void **state)
{
    (void)state;
    static const struct rig_vertex sliver[3] = {
        {{0x1.ab5a12p+0f, -0x1.1075e6p+1f, -0x1.6be288p+1f, 0x1.24cb92p+1f}, {1, 1, 1, 1}},
        {{0x1.897dd6p+1f, 0x1.e79a88p+0f, 0x1.0774fcp+2f, 0x1.d140dcp+1f}, {1, 1, 1, 1}},
        {{0x1.c047c2p+1f, 0x1.910d88p+1f, 0x1.8f1906p+2f, 0x1.02e39cp+2f}, {1, 1, 1, 1}}};
    const struct rhw_viewport viewport = {0, 0, 131, 117, 0, 1};
    assert_true(covers(sliver, viewport, RHW_CULL_NONE, 119, 43));
    // It has the values of the vertex with the largest W, which is the last one here, wherever that stands.
    for (int first = 0; first < 3; first++) {
        struct rig_vertex turned[3];
        for (int i = 0; i < 3; i++) {
            const int from = (first + i) % 3;
            turned[i] = sliver[from];
            turned[i].value[0] = from == 2 ? 1 : 0;
        }
        assert_true(covers(turned, viewport, RHW_CULL_NONE, 119, 43));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_values_of_triangles_with_vertices_behind_the_eye),
    cmocka_unit_test(test_values_of_triangles_across_near_and_far),
    cmocka_unit_test(test_vertex_order_does_not_change_what_is_covered),
    cmocka_unit_test(test_no_cracks_around_the_eye),
    cmocka_unit_test(test_no_cracks_across_near_and_far),
    cmocka_unit_test(test_w_of_zero_and_less_is_ordinary),
    cmocka_unit_test(test_positions_that_are_not_finite_are_dropped),
    cmocka_unit_test(test_huge_and_tiny_coordinates),
    cmocka_unit_test(test_clipped_triangles_keep_the_winding),
    cmocka_unit_test(test_clipped_slivers_keep_the_winding),
    cmocka_unit_test(test_a_polygon_that_crosses_itself),
    cmocka_unit_test(test_a_polygon_of_a_triangle_without_area),
};

const struct unit_tests test_clip = UNIT_TESTS(tests, NULL, NULL);
