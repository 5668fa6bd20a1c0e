// SPDX-License-Identifier: MIT
// Coverage of every sample of a pixel, at 2, 4, 8 and 16 samples: random triangles of every family, and how often each
// sample was covered, by additive blending, against the oracle. Samples lie on the 24.8 grid, so that the oracle moves
// the triangle the other way, exactly, and asks for the centres of pixels.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "oracle.h"
#include "rhw/rhw.h"
#include "rhw/shader.h"
#include "scene.h"

enum { SEED = 1, SCENES = 30, MAX_SAMPLES = 16, MAX_PIXELS = 256 * 256 };

static void vertex_function(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int i = 0; i < 4; i++) {
            groups[g].position[i] = groups[g].attribute[0][i];
        }
    }
}

static void fragment_function(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int i = 0; i < 4; i++) {
            groups[g].color[0][i] = rhw_splat(1);
        }
    }
}

// Draws the scene into `target`, which counts the fragments of each sample.
static void draw(rhw_context *context, rhw_texture target, const struct scene *scene)
{
    const struct oracle_view *const view = &scene->view;
    struct rhw_buffer_def buffer = rhw_buffer_def_default();
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    struct rhw_pass_def pass_def = rhw_pass_def_default();
    const struct rhw_blend_component add = {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    rhw_buffer vertices;
    rhw_pipeline pipeline;
    rhw_pass pass;
    buffer.size = sizeof *scene->vertex * SCENE_VERTICES;
    assert_int_equal(rhw_buffer_create(context, &buffer, &vertices), RHW_OK);
    rhw_buffer_write(context, vertices, 0, scene->vertex,
                     sizeof *scene->vertex * (size_t)scene->vertex_count);
    def.program.vertex[RHW_ISA_BASELINE] = vertex_function;
    def.program.fragment[RHW_ISA_BASELINE] = fragment_function;
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct scene_vertex, position)};
    def.attribute_count = 1;
    def.buffers[0].stride = sizeof(struct scene_vertex);
    def.buffer_count = 1;
    def.topology = scene->topology;
    def.depth_range = view->minus_one_to_one ? RHW_DEPTH_MINUS_ONE_TO_ONE : RHW_DEPTH_ZERO_TO_ONE;
    def.target_count = 1;
    def.targets[0].format = RHW_FORMAT_R32_FLOAT;
    def.targets[0].blend = true;
    def.targets[0].color = def.targets[0].alpha = add;
    assert_int_equal(rhw_pipeline_create(context, &def, &pipeline), RHW_OK);
    pass_def.color_count = 1;
    pass_def.colors[0].texture = target;
    pass_def.colors[0].load = RHW_LOAD_CLEAR;
    memset(pass_def.colors[0].clear, 0, sizeof pass_def.colors[0].clear);
    assert_int_equal(rhw_pass_begin(context, &pass_def, &pass), RHW_OK);
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, vertices, 0);
    const struct rhw_viewport viewport = {view->x,      view->y,         view->width,
                                          view->height, view->depth_min, view->depth_max};
    rhw_pass_set_viewport(context, pass, &viewport);
    rhw_pass_draw(context, pass, 0, (uint32_t)scene->vertex_count, 0, 1);
    assert_int_equal(rhw_pass_end(context, pass, NULL), RHW_OK);
    rhw_pipeline_destroy(context, pipeline);
    rhw_buffer_destroy(context, vertices);
}

// Adds the pixels whose sample at (x, y), in 1/256 pixel from the centre, the triangle covers.
static void cover(struct oracle_triangle *t, int x, int y, float *count)
{
    int y0, y1;
    for (int i = 0; i < t->corner_count; i++) {
        t->corner_24_8[i][0] -= x;
        t->corner_24_8[i][1] -= y;
    }
    oracle_rows(t, &y0, &y1);
    for (int row = y0; row < y1; row++) {
        int run[ORACLE_CORNERS];
        const int ends = oracle_cover_row(t, row, run);
        for (int i = 0; i < ends; i += 2) {
            for (int column = run[i]; column < run[i + 1]; column++) {
                count[row * t->view.target_width + column]++;
            }
        }
    }
    for (int i = 0; i < t->corner_count; i++) {
        t->corner_24_8[i][0] += x;
        t->corner_24_8[i][1] += y;
    }
}

// What the oracle counts at each sample, one image after the other; false when the scene has a corner on a rounding tie.
static bool expect(const struct scene *scene, int samples, float *count)
{
    const size_t pixels = (size_t)scene->view.target_width * (size_t)scene->view.target_height;
    struct oracle_triangle t;
    bool ambiguous = false;
    memset(count, 0, pixels * (size_t)samples * sizeof *count);
    oracle_triangle_init(&t);
    for (int i = 0; i < scene->triangle_count; i++) {
        float position[3][4];
        for (int k = 0; k < 3; k++) {
            memcpy(position[k], scene->vertex[scene->triangle[i][k]].position, sizeof position[k]);
        }
        oracle_triangle_set(&t, &scene->view, (const float(*)[4])position);
        ambiguous = ambiguous || t.ambiguous;
        for (int s = 0; s < samples; s++) {
            float at[2];
            assert_true(rhw_sample_position(samples, s, at));
            cover(&t, (int)(at[0] * 256) - 128, (int)(at[1] * 256) - 128, count + (size_t)s * pixels);
        }
    }
    oracle_triangle_clear(&t);
    return !ambiguous;
}

// Returns how many covered samples were compared.
static uint64_t compare(rhw_context *context, const struct scene *scene, int samples, float *expected,
                        float *got)
{
    uint64_t covered = 0;
    const int width = scene->view.target_width, height = scene->view.target_height;
    struct rhw_texture_def def = rhw_texture_def_default();
    rhw_texture target;
    if (!expect(scene, samples, expected)) {
        return 0;
    }
    def.width = width;
    def.height = height;
    def.mip_levels = 1;
    def.samples = samples;
    def.format = RHW_FORMAT_R32_FLOAT;
    assert_int_equal(rhw_texture_create(context, &def, &target), RHW_OK);
    draw(context, target, scene);
    for (int s = 0; s < samples; s++) {
        const float *const truth = expected + (size_t)s * (size_t)width * (size_t)height;
        assert_int_equal(rhw_texture_read_sample(context, target, s, got, 0), RHW_OK);
        for (int i = 0; i < width * height; i++) {
            covered += truth[i] > 0;
            if (got[i] != truth[i]) {
                fail_msg("%s, seed %d, index %d: sample %d of %d at %d,%d is covered %g times, not %g",
                         scene_family_name(scene->family), SEED, (int)scene->index, s, samples, i % width,
                         i / width, (double)got[i], (double)truth[i]);
            }
        }
    }
    rhw_texture_destroy(context, target);
    return covered;
}

static void test_every_sample(void **state)
{
    struct rhw_context_def def = rhw_context_def_default();
    struct scene *const scene = malloc(sizeof *scene);
    float *const expected = malloc(sizeof *expected * MAX_SAMPLES * MAX_PIXELS);
    float *const got = malloc(sizeof *got * MAX_PIXELS);
    rhw_context *context;
    uint64_t covered[MAX_SAMPLES + 1] = {0};
    (void)state;
    def.threads = 1;
    assert_true(scene && expected && got);
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    for (int family = 0; family < FAMILY_COUNT; family++) {
        for (int index = 0; index < SCENES; index++) {
            scene_make(scene, (enum family)family, SEED, (uint64_t)index);
            for (int samples = 2; samples <= MAX_SAMPLES; samples *= 2) {
                covered[samples] += compare(context, scene, samples, expected, got);
            }
        }
    }
    for (int samples = 2; samples <= MAX_SAMPLES; samples *= 2) {
        printf("%d samples: %llu covered samples as the oracle has them\n", samples,
               (unsigned long long)covered[samples]);
        assert_true(covered[samples] > 1000000);
    }
    rhw_context_destroy(context);
    free(got);
    free(expected);
    free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_sample)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
