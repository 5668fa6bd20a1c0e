// SPDX-License-Identifier: MIT
// Multisampling: coverage, depth and colour of every sample against exact arithmetic, where fragments take their values,
// sample masks, alpha to coverage, resolving, reading samples back, and what is refused.
#include "sample_rig.h"

#include <math.h>

static const float red[4] = {1, 0, 0, 1};

// Whether a point is inside a triangle of 1/256-pixel vertices, by the top-left rule; exact.
static bool covers(const int64_t x[3], const int64_t y[3], int64_t px, int64_t py)
{
    const int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    bool inside = area != 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int64_t sign = area < 0 ? -1 : 1, a = sign * (y[i] - y[j]), b = sign * (x[j] - x[i]);
        const int64_t e = a * (px - x[i]) + b * (py - y[i]);
        inside = inside && (e > 0 || (e == 0 && (a > 0 || (a == 0 && b > 0))));
    }
    return inside;
}

struct triangle {
    int64_t x[3], y[3];
    float depth;
};

static struct triangle random_triangle(uint64_t *random, int size)
{
    struct triangle t = {.depth = (float)rig_random_int(random, 1000) / 1024};
    const int x = rig_random_int(random, SIZE * 256), y = rig_random_int(random, SIZE * 256);
    for (int i = 0; i < 3; i++) {
        t.x[i] = x + rig_random_int(random, size) - size / 2;
        t.y[i] = y + rig_random_int(random, size) - size / 2;
    }
    return t;
}

static void draw_triangle(struct rig *rig, const struct triangle *t, float value)
{
    struct rig_vertex vertices[3];
    for (int i = 0; i < 3; i++) {
        rig_place(rig, (float)t->x[i] / 256, (float)t->y[i] / 256, t->depth, 1, vertices[i].position);
        memcpy(vertices[i].value, (const float[4]){value, 0, 0, 1}, sizeof vertices[i].value);
    }
    rig_draw(rig, vertices, 3);
}

// Vulkan 1.3, "Standard sample locations", in sixteenths of a pixel.
static void test_positions_are_the_standard_ones(void **state)
{
    (void)state;
    static const uint8_t positions[][16][2] = {
        {{8, 8}},
        {{12, 12}, {4, 4}},
        {{6, 2}, {14, 6}, {2, 10}, {10, 14}},
        {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}},
        {{9, 9},
         {7, 5},
         {5, 10},
         {12, 7},
         {3, 6},
         {10, 13},
         {13, 11},
         {11, 3},
         {6, 14},
         {8, 1},
         {4, 2},
         {2, 12},
         {0, 8},
         {15, 4},
         {14, 15},
         {1, 0}}};
    for (int i = 0; i < 5; i++) {
        for (int s = 0; s < 1 << i; s++) {
            float at[2];
            assert_true(rhw_sample_position(1 << i, s, at));
            assert_true(at[0] == (float)positions[i][s][0] / 16 && at[1] == (float)positions[i][s][1] / 16);
        }
        for (int s = -1; s <= 1 << i; s += 1 + (1 << i)) { // on both sides of those there are
            float at[2] = {0, 0};
            assert_false(rhw_sample_position(1 << i, s, at));
            assert_true(at[0] == 0.5f && at[1] == 0.5f);
        }
    }
}

// Every sample has the nearest triangle that covers it.
static void compare_samples(int samples, enum rhw_paths paths, int size, int count)
{
    struct rig rig;
    open_samples(&rig, samples, paths);
    static float color[16][PIXELS], depth[16][PIXELS];
    uint64_t random = (uint64_t)(samples + size);
    memset(color, 0, sizeof color);
    rig_begin(&rig);
    for (int i = 0; i < 16 * PIXELS; i++) {
        depth[i / PIXELS][i % PIXELS] = 1;
    }
    for (int n = 1; n <= count; n++) {
        const struct triangle t = random_triangle(&random, size);
        draw_triangle(&rig, &t, (float)n);
        for (int s = 0; s < samples; s++) {
            float at[2];
            assert_true(rhw_sample_position(samples, s, at));
            const int64_t ox = (int64_t)(at[0] * 256), oy = (int64_t)(at[1] * 256);
            for (int p = 0; p < PIXELS; p++) {
                if (t.depth < depth[s][p] && covers(t.x, t.y, p % SIZE * 256 + ox, p / SIZE * 256 + oy)) {
                    depth[s][p] = t.depth;
                    color[s][p] = (float)n;
                }
            }
        }
    }
    rig_end(&rig);
    for (int s = 0; s < samples; s++) {
        const float(*const pixels)[4] = read_color(&rig, s);
        assert_memory_equal(read_depth(&rig, s), depth[s], sizeof depth[s]);
        for (int p = 0; p < PIXELS; p++) {
            if (pixels[p][0] != color[s][p]) {
                fail_msg("%d samples, size %d: sample %d of pixel %d,%d is %g, not %g", samples, size, s,
                         p % SIZE, p / SIZE, (double)pixels[p][0], (double)color[s][p]);
            }
        }
    }
    rig_close(&rig);
}

static void test_every_sample_is_exact(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS; i++) {
        for (int general = 0; general < 2; general++) {
            const enum rhw_paths paths = general ? RHW_PATHS_GENERAL : RHW_PATHS_ALL;
            compare_samples(counts[i], paths, 100 * 256, 30);
            compare_samples(counts[i], paths, 20 * 256, 60);
            compare_samples(counts[i], paths, 2 * 256, 200);
        }
    }
}

// Without a depth test the last triangle is seen: tiles draw backwards. One call of the fragment function gives a
// fragment's colour to all its samples.
static void test_fragments_are_shaded_once(void **state)
{
    (void)state;
    struct rig rig;
    open_samples(&rig, 4, RHW_PATHS_ALL);
    rig.pipeline.depth_test = false;
    struct rig_vertex all[6];
    rig_begin(&rig);
    for (int i = 0; i < 3; i++) {
        rig_cover(&rig, 0.5f, (const float[4]){(float)i, 0, 0, 1}, all);
        rig_draw(&rig, all, 6);
    }
    rig_end(&rig);
    // Pixels on the diagonal are shaded for both triangles.
    assert_true(rig.stats.fragments_shaded >= PIXELS && rig.stats.fragments_shaded <= PIXELS + 2 * SIZE);
    for (int s = 0; s < 4; s++) {
        for (int p = 0; p < PIXELS; p++) {
            assert_true(read_color(&rig, s)[p][0] == 2);
        }
    }
    rig_close(&rig);
}

static void test_resolve_on_store(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS; i++) {
        for (int kept = 0; kept < 2; kept++) { // samples in a texture of their own
            struct rig rig;
            rig_open(&rig, SIZE, SIZE);
            const rhw_texture one = rig.pass.colors[0].texture;
            rig.pass.samples = counts[i];
            if (kept) {
                rig.pass.colors[0].texture = make_texture(&rig, RHW_FORMAT_RGBA32_FLOAT, counts[i]);
                rig.pass.colors[0].resolve = one;
            }
            struct rig_vertex half[6];
            rig_rectangle(&rig, 8, 8, 40.5f, 40.25f, 0.5f, red, half);
            rig_draw_once(&rig, half, 6);
            const float(*const pixels)[4] = (const float(*)[4])rig_read(&rig, one);
            for (int p = 0; p < PIXELS; p++) {
                int covered = 0;
                for (int s = 0; s < counts[i]; s++) {
                    float at[2];
                    rhw_sample_position(counts[i], s, at);
                    const float x = (float)(p % SIZE) + at[0], y = (float)(p / SIZE) + at[1];
                    covered += x >= 8 && y >= 8 && x < 40.5f && y < 40.25f;
                }
                assert_true(pixels[p][0] == (float)covered / (float)counts[i]);
            }
            if (kept) {
                rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
                rig.pass.colors[0].texture = one;
            }
            rig_close(&rig);
        }
    }
}

// In waves samples are kept between them; an sRGB target averages light.
static void test_resolve_in_waves(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int waves = 0; waves < 2; waves++) {
        struct rig rig;
        rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .bin_memory = waves ? 1 : 0});
        rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_SRGB);
        rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD};
        rig.pipeline.depth_test = true;
        rig.pass.samples = 8;
        uint64_t random = 12;
        rig_begin(&rig);
        for (int i = 0; i < 50; i++) {
            const struct triangle t = random_triangle(&random, 30 * 256);
            draw_triangle(&rig, &t, (float)i / 50);
        }
        rig_end(&rig);
        assert_true((rig.stats.flushes > 0) == (waves != 0));
        hash[waves] = rig_hash(&rig, 0);
        rig_close(&rig);
    }
    assert_true(hash[0] == hash[1]);
}

static void test_resolve_modes(void **state)
{
    (void)state;
    const float expected[] = {0.5f, 0.5f, 0, 1, 0}; // by enum rhw_resolve
    for (int mode = 0; mode < 5; mode++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        rig_set_depth(&rig);
        rig.pass.samples = 2; // at 0.75, 0.75 and at 0.25, 0.25
        rig.pass.colors[0].resolve_mode = (enum rhw_resolve)mode;
        rig.pass.depth.resolve_mode = (enum rhw_resolve)mode;
        rig.pass.depth.clear = 0.75f;
        struct rig_vertex quad[6];
        rig_rectangle(&rig, 0, 0, 10.5f, 10, 0.25f, red, quad);
        rig_draw_once(&rig, quad, 6);
        const float depths[] = {0.75f, 0.5f, 0.25f, 0.75f, 0.75f};
        assert_true(rig_read_float4(&rig)[10][0] == expected[mode]);
        assert_true(rig_read_depth(&rig)[10] == depths[mode]);
        assert_true(rig_read_float4(&rig)[9][0] == 1 && rig_read_depth(&rig)[9] == 0.25f);
        rig_close(&rig);
    }
}

// What was resolved is loaded into every sample; samples that were stored are loaded as they were.
static void test_loading(void **state)
{
    (void)state;
    for (int kept = 0; kept < 2; kept++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        const rhw_texture one = rig.pass.colors[0].texture;
        rig.pass.samples = 4;
        if (kept) {
            rig.pass.colors[0].texture = make_texture(&rig, RHW_FORMAT_RGBA32_FLOAT, 4);
            rig.pass.colors[0].resolve = one;
        }
        struct rig_vertex quad[6];
        rig_rectangle(&rig, 0, 0, 10.5f, 10, 0.25f, red, quad);
        rig_draw_once(&rig, quad, 6);
        rig.pass.colors[0].load = RHW_LOAD_LOAD;
        for (int again = 0; again < 2; again++) { // without a triangle, and with one
            rig_begin(&rig);
            rig_rectangle(&rig, 20, 20, 30, 30, 0.25f, red, quad);
            if (again) {
                rig_draw(&rig, quad, 6);
            }
            rig_end(&rig);
            const float(*const pixels)[4] = (const float(*)[4])rig_read(&rig, one);
            assert_true(pixels[10][0] == 0.5f && pixels[9][0] == 1 && pixels[11][0] == 0);
            assert_true(pixels[25 * SIZE + 25][0] == (again ? 1.0f : 0.0f));
        }
        if (kept) {
            rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
            rig.pass.colors[0].texture = one;
        }
        rig_close(&rig);
    }
}

// A ramp of 1 a pixel along x and of 100 along y, over what is right of x = 20.5: one triangle, so that no edge but that
// crosses pixels.
static void draw_ramp(struct rig *rig)
{
    const float corners[3][2] = {{20.5f, -200}, {20.5f, 300}, {600, 50}};
    struct rig_vertex vertices[3];
    for (int i = 0; i < 3; i++) {
        rig_place(rig, corners[i][0], corners[i][1], 0.5f, 1, vertices[i].position);
        memcpy(vertices[i].value, (const float[4]){corners[i][0], corners[i][1] * 100, 0, 1},
               sizeof vertices[i].value);
    }
    rig_draw(rig, vertices, 3);
}

static void test_where_values_are_taken(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS; i++) {
        for (int sampling = RHW_SAMPLING_CENTER; sampling <= RHW_SAMPLING_SAMPLE; sampling++) {
            struct rig rig;
            open_samples(&rig, counts[i], RHW_PATHS_ALL);
            rig.pipeline.program.varyings[0].sampling = (enum rhw_sampling)sampling;
            rig_begin(&rig);
            draw_ramp(&rig);
            rig_end(&rig);
            float first[2] = {-1, -1}; // of the samples that lie right of the edge in pixel 20
            for (int s = counts[i] - 1; s >= 0; s--) {
                float at[2];
                rhw_sample_position(counts[i], s, at);
                if (at[0] >= 0.5f) {
                    memcpy(first, at, sizeof first);
                }
            }
            for (int s = 0; s < counts[i]; s++) {
                float at[2];
                rhw_sample_position(counts[i], s, at);
                for (int x = 20; x < 40; x++) {
                    const float *const pixel = read_color(&rig, s)[7 * SIZE + x];
                    if (x == 20 && at[0] < 0.5f) {
                        assert_true(pixel[3] == 0); // not covered
                        continue;
                    }
                    const bool in_part = x == 20 && sampling == RHW_SAMPLING_CENTROID;
                    const float *const where = sampling == RHW_SAMPLING_SAMPLE ? at
                                               : in_part                       ? first
                                                                               : (const float[]){0.5f, 0.5f};
                    assert_true(fabsf(pixel[0] - ((float)x + where[0])) < 2e-4f);
                    assert_true(fabsf(pixel[1] - (7 + where[1]) * 100) < 2e-2f);
                }
            }
            rig_close(&rig);
        }
    }
}

static void twice_vertex(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].varying[4 + c] = groups[g].varying[c];
        }
    }
}

// Places at the centroid, at the centre, by an offset from either, and by coordinates.
static void twice_fragment(struct rhw_fragment *groups, int count)
{
    static const float half[2] = {0.5f, -0.25f};
    const rhw_float offset[2] = {rhw_splat(half[0]), rhw_splat(half[1])};
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        f->color[0][0] = f->varying[0];
        f->color[0][1] = f->varying[4];
        f->color[0][2] = rhw_interpolate_at(f, 4, 7, offset);
        f->color[0][3] = f->coord[3] + f->coord[2];
    }
}

// Centroids of one varying leave another one, its derivatives and coordinates at the centre. In perspective 1/w is a
// ramp of 0.01 a pixel from 0.2 on, depth half of that, and a value the place over w.
static void test_centroids_beside_centers(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS * 2; i++) {
        struct rig rig;
        open_samples(&rig, counts[i / 2], i % 2 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL);
        rig_set_program(&rig, twice_vertex, twice_fragment);
        rig.pipeline.program.uses = RHW_USE_COORD;
        rig.pipeline.program.varyings[0].sampling = RHW_SAMPLING_CENTROID;
        rig.pipeline.program.varyings[1] = (struct rhw_varying){.components = 4, .derivatives = true};
        rig.pipeline.program.varying_count = 2;
        const float corners[3][2] = {{20.5f, -20}, {20.5f, 90}, {70, 35}};
        struct rig_vertex vertices[3];
        for (int k = 0; k < 3; k++) {
            const float x = corners[k][0], w = 1 / (0.2f + 0.01f * x);
            rig_place(&rig, x, corners[k][1], 0.5f / w, w, vertices[k].position);
            memcpy(vertices[k].value, (const float[4]){x * w, 0, 0, w}, sizeof vertices[k].value);
        }
        rig_draw_once(&rig, vertices, 3);
        float first = 0; // of the samples that lie right of the edge in pixel 20
        for (int s = counts[i / 2] - 1; s >= 0; s--) {
            float at[2];
            rhw_sample_position(counts[i / 2], s, at);
            first = at[0] >= 0.5f ? at[0] : first;
        }
        for (int s = 0; s < counts[i / 2]; s++) {
            const float *const row = read_color(&rig, s)[35 * SIZE];
            float at[2];
            rhw_sample_position(counts[i / 2], s, at);
            for (int x = at[0] < 0.5f ? 21 : 20; x < 60; x++) {
                const float place = (float)x + (x == 20 ? first : 0.5f), center = (float)x + 0.5f;
                const float *const pixel = row + 4 * (ptrdiff_t)x;
                assert_true(fabsf(pixel[0] - place / (0.2f + 0.01f * place)) < 1e-4f);
                assert_true(fabsf(pixel[1] - center / (0.2f + 0.01f * center)) < 1e-4f);
                assert_true(fabsf(pixel[2] - (center + 0.5f) / (0.205f + 0.01f * center)) < 1e-3f);
                assert_true(fabsf(pixel[3] - 1.5f * (0.2f + 0.01f * center)) < 1e-6f);
            }
        }
        rig_close(&rig);
    }
}

// What hides samples of a fragment, drawn before it or after, does not move its centroid: in pixel 30 the ramp covers
// every sample, and those left of the middle are seen.
static void test_centroids_of_what_is_half_hidden(void **state)
{
    (void)state;
    enum { NO_DEPTH, HIDDEN_LATER, HIDDEN_BEFORE, HIDINGS };
    for (int i = 0; i < HIDINGS * 2; i++) {
        const int hiding = i / 2;
        struct rig rig;
        open_samples(&rig, 4, i % 2 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL);
        rig.pipeline.program.varyings[0].sampling = RHW_SAMPLING_CENTROID;
        rig.pipeline.depth_test = hiding != NO_DEPTH;
        const struct triangle cover = {
            {30 * 256 + 128, 30 * 256 + 128, 600 * 256}, {-51200, 76800, 12800}, 0.25f};
        rig_begin(&rig);
        if (hiding == HIDDEN_BEFORE) {
            draw_triangle(&rig, &cover, 7);
        }
        draw_ramp(&rig);
        if (hiding != HIDDEN_BEFORE) {
            draw_triangle(&rig, &cover, 7);
        }
        rig_end(&rig);
        for (int s = 0; s < 4; s++) {
            float at[2];
            rhw_sample_position(4, s, at);
            const float *const pixel = read_color(&rig, s)[7 * SIZE + 30];
            assert_true(fabsf(pixel[0] - (at[0] < 0.5f ? 30.5f : 7)) < 2e-4f);
        }
        rig_close(&rig);
    }
}

static void sample_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        f->color[0][0] = rhw_float_from_int(f->sample_id);
        f->color[0][1] = f->sample_position[0];
        f->color[0][2] = f->coord[1] - rhw_floor(f->coord[1]);
        f->color[0][3] = rhw_float_from_int(f->sample_mask);
    }
}

static void test_sample_inputs(void **state)
{
    (void)state;
    struct rig rig;
    open_samples(&rig, 8, RHW_PATHS_ALL);
    rig_set_program(&rig, rig_vertex_pass, sample_fragment);
    rig.pipeline.program.uses = RHW_USE_SAMPLE | RHW_USE_COORD | RHW_USE_SAMPLE_MASK;
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, red, all);
    rig_draw_once(&rig, all, 6);
    for (int s = 0; s < 8; s++) {
        float at[2];
        rhw_sample_position(8, s, at);
        const float *const pixel = read_color(&rig, s)[9];
        assert_true(pixel[0] == (float)s && pixel[1] == at[0] && pixel[2] == at[1]);
        assert_true(pixel[3] == (float)(1 << s));
    }
    rig_close(&rig);
}

static void masking_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].sample_mask &= rhw_splat_int(5);
    }
}

static void test_sample_masks(void **state)
{
    (void)state;
    for (int by_function = 0; by_function < 2; by_function++) {
        for (int late = 0; late < 2; late++) {
            struct rig rig;
            open_samples(&rig, 4, RHW_PATHS_ALL);
            rig.pipeline.sample_mask = by_function ? 0 : 5;
            rig.pipeline.depth_test = late;
            if (by_function) {
                rig_set_program(&rig, rig_vertex_pass, masking_fragment);
                rig.pipeline.program.uses = RHW_USE_SAMPLE_MASK;
            }
            struct rig_vertex all[6];
            rig_cover(&rig, 0.5f, red, all);
            rig_draw_once(&rig, all, 6);
            for (int s = 0; s < 4; s++) {
                const bool drawn = 5 >> s & 1;
                assert_true(read_color(&rig, s)[100][0] == (drawn ? 1.0f : 0.0f));
                assert_true(read_depth(&rig, s)[100] == (drawn && late ? 0.5f : 1.0f));
            }
            rig_close(&rig);
        }
    }
}

static void test_alpha_to_coverage(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS; i++) {
        struct rig rig;
        open_samples(&rig, counts[i], RHW_PATHS_ALL);
        rig.pipeline.alpha_to_coverage = rig.pipeline.alpha_to_one = true;
        for (int k = 0; k <= counts[i]; k++) {
            struct rig_vertex all[6];
            rig_cover(&rig, 0.5f, (const float[4]){1, 0, 0, ((float)k + 0.3f) / (float)counts[i]}, all);
            rig_draw_once(&rig, all, 6);
            for (int s = 0; s < counts[i]; s++) {
                const float *const pixel = read_color(&rig, s)[100];
                assert_true(pixel[0] == (s < k ? 1.0f : 0.0f) && pixel[3] == pixel[0]);
                assert_true(read_depth(&rig, s)[100] == (s < k ? 0.5f : 1.0f));
            }
        }
        rig_close(&rig);
    }
}

static void numbers_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = (rhw_float)rhw_splat_int(7 + c);
            groups[g].color[1][c] = rhw_splat(0.25f);
        }
    }
}

// Integers of target 0 are no alpha: they drop no sample and stay. Where it has floats, its alpha alone becomes 1.
static void test_alpha_of_targets(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        const bool is_integer = i % 2 == 0;
        struct rig rig;
        open_samples(&rig, 4, RHW_PATHS_ALL);
        rig.pipeline.alpha_to_one = true;
        rig.pipeline.alpha_to_coverage = is_integer;
        const enum rhw_format formats[2] = {is_integer ? RHW_FORMAT_RGBA32_UINT : RHW_FORMAT_RGBA32_FLOAT,
                                            RHW_FORMAT_RGBA32_FLOAT};
        for (int t = 0; t < 2; t++) {
            rig_set_target(&rig, t, formats[t]);
            rhw_texture_destroy(rig.context, rig.pass.colors[t].texture);
            rig.pass.colors[t].texture = make_texture(&rig, formats[t], 4);
        }
        rig_set_program(&rig, rig_vertex_pass, numbers_fragment);
        if (i >= 2) { // the function is called once for all
            rig.pipeline.program.varyings[0] = (struct rhw_varying){.components = 0};
            rig.pipeline.program.varying_count = 0;
        }
        struct rig_vertex all[6];
        rig_cover(&rig, 0.5f, (const float[4]){0}, all);
        rig_draw_once(&rig, all, 6);
        for (int s = 0; s < 4; s++) {
            uint32_t texel[2][4];
            static float texels[2][SIZE * SIZE][4];
            for (int t = 0; t < 2; t++) {
                rhw_texture_read_sample(rig.context, rig.pass.colors[t].texture, s, texels[t], 0);
                memcpy(texel[t], texels[t][100], sizeof texel[t]);
            }
            assert_true(texel[0][0] == 7 && texel[0][2] == 9);
            assert_int_equal(texel[0][3], is_integer ? 10 : 0x3f800000);
            assert_true(texels[1][100][0] == 0.25f && texels[1][100][3] == 0.25f);
        }
        rig_close(&rig);
    }
}

// A fragment that discards leaves no sample; what it keeps is tested sample by sample.
static void discarding_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].mask &= rhw_less(groups[g].coord[0], 30);
    }
}

static void test_early_and_late_agree(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int late = 0; late < 2; late++) {
        struct rig rig;
        open_samples(&rig, 4, RHW_PATHS_ALL);
        struct rig_vertex slope[6];
        rig_cover(&rig, 0.5f, red, slope);
        rig.pipeline.program.uses = late ? RHW_USE_DISCARD | RHW_USE_COORD : 0;
        rig_set_program(&rig, rig_vertex_pass, late ? discarding_fragment : rig_fragment_pass);
        const struct rhw_rect left = {0, 0, 30, SIZE};
        rig_begin(&rig);
        rhw_pass_set_scissor(rig.context, rig.recording, &left);
        for (int i = 0; i < 3; i++) { // three slopes that cross each other
            for (int v = 0; v < 6; v++) {
                slope[v].position[2] = 0.5f + slope[v].position[0] * (0.1f + 0.07f * (float)i) +
                                       slope[v].position[1] * (0.02f * (float)i);
                slope[v].value[0] = (float)i;
            }
            rig_draw(&rig, slope, 6);
        }
        rig_end(&rig);
        hash[late] = 0;
        for (int s = 0; s < 4; s++) {
            hash[late] = rig_hash_bytes(hash[late], read_color(&rig, s), PIXELS * 16);
            hash[late] = rig_hash_bytes(hash[late], read_depth(&rig, s), PIXELS * 4);
        }
        rig_close(&rig);
    }
    assert_true(hash[0] == hash[1]);
}

// Blending over what samples have, in blocks where they agree and where they do not.
static void test_blending(void **state)
{
    (void)state;
    struct rig rig;
    open_samples(&rig, 4, RHW_PATHS_ALL);
    rig.pipeline.depth_test = false;
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color = rig.pipeline.targets[0].alpha =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    static float sum[4][PIXELS];
    memset(sum, 0, sizeof sum);
    uint64_t random = 77;
    rig_begin(&rig);
    for (int n = 0; n < 40; n++) {
        const struct triangle t = random_triangle(&random, n % 2 ? 40 * 256 : 4 * 256);
        draw_triangle(&rig, &t, 1);
        for (int p = 0; p < 4 * PIXELS; p++) {
            float at[2];
            const int s = p / PIXELS, pixel = p % PIXELS;
            rhw_sample_position(4, s, at);
            sum[s][pixel] += (float)covers(t.x, t.y, pixel % SIZE * 256 + (int64_t)(at[0] * 256),
                                           pixel / SIZE * 256 + (int64_t)(at[1] * 256));
        }
    }
    rig_end(&rig);
    for (int s = 0; s < 4; s++) {
        for (int p = 0; p < PIXELS; p++) {
            assert_true(read_color(&rig, s)[p][0] == sum[s][p]);
        }
    }
    rig_close(&rig);
}

static void test_stencil_by_sample(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig.pass.samples = 4;
    rig.pass.depth = (struct rhw_depth_attachment){
        .enabled = true, .format = RHW_FORMAT_S8_UINT, .stencil_store = RHW_STORE_DISCARD};
    rig.pipeline.stencil_test = true;
    rig.pipeline.stencil_front.pass = RHW_STENCIL_INVERT;
    rig.pipeline.targets[0].write_mask = RHW_WRITE_NONE;
    struct rig_vertex quad[6];
    rig_begin(&rig);
    rig_rectangle(&rig, 0, 0, 10.5f, SIZE, 0.5f, red, quad);
    rig_draw(&rig, quad, 6);
    rig.pipeline.targets[0].write_mask = 0;
    rig.pipeline.stencil_front =
        (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_NOT_EQUAL};
    rig_cover(&rig, 0.5f, red, quad);
    rig_draw(&rig, quad, 6);
    rig_end(&rig);
    for (int x = 0; x < 20; x++) {
        assert_true(rig_read_float4(&rig)[x][0] == (x < 10 ? 1.0f : x == 10 ? 0.5f : 0.0f));
    }
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rhw_texture texture;
    struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = SIZE, .height = SIZE, .samples = 3};
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "samples is 3");
    def.samples = 4;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "has one level");
    texture = make_texture(&rig, RHW_FORMAT_RGBA32_FLOAT, 4);
    static float pixels[PIXELS][4];
    assert_int_equal(rhw_texture_read(rig.context, texture, 0, pixels, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_texture_read_sample");
    assert_int_equal(rhw_texture_read_sample(rig.context, texture, 4, pixels, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "has samples 0..3");
    rhw_pass pass;
    rig.pass.samples = 8;
    const rhw_texture one = rig.pass.colors[0].texture;
    rig.pass.colors[0].texture = texture;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "which has 4 samples; the pass has 8");
    rig.pass.samples = 5;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "samples is 5");
    rig.pass.samples = 4;
    rig.pass.colors[0].texture = one;
    rig.pass.colors[0].resolve = texture;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].resolve is set");
    rhw_texture_destroy(rig.context, texture);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_positions_are_the_standard_ones),
    cmocka_unit_test(test_every_sample_is_exact),
    cmocka_unit_test(test_fragments_are_shaded_once),
    cmocka_unit_test(test_resolve_on_store),
    cmocka_unit_test(test_resolve_in_waves),
    cmocka_unit_test(test_resolve_modes),
    cmocka_unit_test(test_loading),
    cmocka_unit_test(test_where_values_are_taken),
    cmocka_unit_test(test_centroids_beside_centers),
    cmocka_unit_test(test_centroids_of_what_is_half_hidden),
    cmocka_unit_test(test_sample_inputs),
    cmocka_unit_test(test_sample_masks),
    cmocka_unit_test(test_alpha_to_coverage),
    cmocka_unit_test(test_alpha_of_targets),
    cmocka_unit_test(test_early_and_late_agree),
    cmocka_unit_test(test_blending),
    cmocka_unit_test(test_stencil_by_sample),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_multisample = UNIT_TESTS(tests, NULL, NULL);
