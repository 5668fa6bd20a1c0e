// SPDX-License-Identifier: MIT
// One scene, one image: the same bytes at every thread count, on every instruction set, with bins of every
// size, and again in the next run. The scene has what could tell them apart: blending in submission order,
// depth, discard, textures with derivatives, clipping, many small and some large triangles, instances.
#include "harness.h"
#include "isa_shaders.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 233, HEIGHT = 171, SMALL = 4000, LARGE = 40 };

struct scene {
    struct rig_vertex small[3 * SMALL], large[3 * LARGE];
    rhw_texture image;
    rhw_sampler sampler;
};

static void make_triangles(struct rig_vertex *vertices, int count, float extent, uint64_t *random)
{
    for (int i = 0; i < count; i++) {
        const float w = rig_random_float(random, 0.5f, 8);
        const float x = rig_random_float(random, -1.1f, 1.1f), y = rig_random_float(random, -1.1f, 1.1f);
        const float z = rig_random_float(random, -0.05f, 1.05f);
        for (int k = 0; k < 3; k++) {
            float *p = vertices[3 * i + k].position, *v = vertices[3 * i + k].value;
            // Some corners of the large ones lie behind the eye.
            const float corner_w = extent > 1 ? w - rig_random_float(random, 0, 6) : w;
            p[0] = (x + rig_random_float(random, -extent, extent)) * corner_w;
            p[1] = (y + rig_random_float(random, -extent, extent)) * corner_w;
            p[2] = z * corner_w;
            p[3] = corner_w;
            for (int c = 0; c < 4; c++) {
                v[c] = rig_random_float(random, 0, 1);
            }
        }
    }
}

static void texture_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        const rhw_float uv[2] = {f->varying[0] * 3.0f, f->varying[1] * 5.0f};
        const rhw_float grad[4] = {f->ddx[0] * 3.0f, f->ddx[1] * 5.0f, f->ddy[0] * 3.0f, f->ddy[1] * 5.0f};
        rhw_sample_grad(f->textures, 0, uv, grad, f->color[0]);
        f->mask &= f->color[0][1] > 0.25f;
        f->color[0][3] = rhw_splat(0.75f);
    }
}

// Discards in a checkerboard and writes depth.
static void depth_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        const rhw_int x = __builtin_convertvector(groups[g].coord[0], rhw_int);
        const rhw_int y = __builtin_convertvector(groups[g].coord[1], rhw_int);
        groups[g].mask &= ((x ^ y) & 4) == 0;
        groups[g].depth = groups[g].depth * 0.875f + groups[g].varying[2] * 0.125f;
    }
}

static void make_scene(struct rig *rig, struct scene *scene)
{
    uint64_t random = 50;
    make_triangles(scene->small, SMALL, 0.03f, &random);
    make_triangles(scene->large, LARGE, 1.5f, &random);
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_SRGB;
    def.width = 37;
    def.height = 64;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    assert_int_equal(rhw_texture_create(rig->context, &def, &scene->image), RHW_OK);
    unsigned char texels[37 * 64 * 4];
    for (size_t i = 0; i < sizeof texels; i++) {
        texels[i] = (unsigned char)rig_random(&random);
    }
    rhw_texture_write(rig->context, scene->image, 0, texels, 0);
    rhw_texture_generate_mips(rig->context, scene->image);
    const struct rhw_sampler_def sampler = rhw_sampler_def_default();
    assert_int_equal(rhw_sampler_create(rig->context, &sampler, &scene->sampler), RHW_OK);
}

static void draw_scene(struct rig *rig, const struct scene *scene)
{
    const struct rhw_blend_component over = {RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA,
                                             RHW_BLEND_ADD};
    struct rhw_program *program = &rig->pipeline.program;
    program->varyings[0].derivatives = true;
    rig->pass.colors[0].clear[2] = 0.25f;
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 0, scene->image, scene->sampler);
    isa_shaders_fill(program);
    program->uses = 0;
    rig->pipeline.targets[0].blend = false;
    rig->pipeline.depth_read_only = false;
    rig_draw(rig, scene->small, 3 * SMALL);
    memset(program->vertex, 0, sizeof program->vertex);
    memset(program->fragment, 0, sizeof program->fragment);
    rig_set_program(rig, rig_vertex_pass, depth_fragment);
    program->uses = RHW_USE_COORD | RHW_USE_DISCARD | RHW_USE_DEPTH;
    rig_draw(rig, scene->large, 3 * LARGE);
    rig_set_program(rig, rig_vertex_pass, texture_fragment);
    program->uses = RHW_USE_DISCARD;
    rig->pipeline.targets[0].blend = true;
    rig->pipeline.targets[0].color = rig->pipeline.targets[0].alpha = over;
    rig->pipeline.depth_read_only = true;
    rig_draw(rig, scene->large, 3 * LARGE);
    isa_shaders_fill(program);
    program->uses = 0;
    rig->pipeline.depth_compare = RHW_COMPARE_LESS_EQUAL;
    rig_use_pipeline(rig);
    rhw_pass_draw(rig->context, rig->recording, 0, 3 * LARGE, 0, 3);
    rig_end(rig);
    rig->pipeline.depth_compare = RHW_COMPARE_LESS;
}

struct outcome {
    uint64_t colors[2], depth;
    struct rhw_stats stats;
};

static struct outcome run(const struct rhw_context_def *def, int passes)
{
    static struct scene scene;
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, def);
    rig_set_depth(&rig);
    make_scene(&rig, &scene);
    struct outcome outcome = {0};
    for (int i = 0; i < passes; i++) {
        const enum rhw_format formats[2] = {RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_RGBA8_SRGB};
        for (int f = 0; f < 2; f++) {
            rig_set_target(&rig, 0, formats[f]);
            draw_scene(&rig, &scene);
            const uint64_t hash = rig_hash(&rig, 0);
            assert_true(i == 0 || hash == outcome.colors[f]);
            outcome.colors[f] = hash;
        }
        const float *depth = rig_read_depth(&rig);
        outcome.depth = rig_hash_bytes(1, depth, WIDTH * HEIGHT * sizeof *depth);
    }
    outcome.stats = rig.stats;
    rig_close(&rig);
    return outcome;
}

static void expect_same(const struct outcome *a, const struct outcome *b, const char *what, int value)
{
    if (a->colors[0] != b->colors[0] || a->colors[1] != b->colors[1] || a->depth != b->depth) {
        fail_msg("%s %d draws other bytes", what, value);
    }
    assert_int_equal(a->stats.triangles_in, b->stats.triangles_in);
    assert_int_equal(a->stats.triangles_dropped, b->stats.triangles_dropped);
    assert_int_equal(a->stats.triangles_clipped, b->stats.triangles_clipped);
    assert_int_equal(a->stats.triangles_culled, b->stats.triangles_culled);
    assert_int_equal(a->stats.triangles_rasterized, b->stats.triangles_rasterized);
    assert_int_equal(a->stats.fragments_shaded, b->stats.fragments_shaded);
}

static struct outcome baseline(void)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.isa_limit = RHW_ISA_UP_TO_BASELINE;
    const struct outcome outcome = run(&def, 1);
    // The scene does what it is for.
    assert_true(outcome.stats.triangles_clipped > 20);
    assert_true(outcome.stats.triangles_culled > 100);
    assert_true(outcome.stats.fragments_shaded > WIDTH * HEIGHT * 2);
    return outcome;
}

static void test_thread_counts(void **state)
{
    (void)state;
    const struct outcome expected = baseline();
    for (int threads = 1; threads <= 16; threads++) {
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = threads;
        const struct outcome outcome = run(&def, threads < 4 ? 2 : 1);
        assert_int_equal(outcome.stats.threads, threads);
        expect_same(&outcome, &expected, "thread count", threads);
    }
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = RHW_MAX_THREADS;
    const struct outcome outcome = run(&def, 1);
    expect_same(&outcome, &expected, "thread count", RHW_MAX_THREADS);
}

static void test_instruction_sets(void **state)
{
    (void)state;
    const struct outcome expected = baseline();
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        if (!rhw_isa_supported((enum rhw_isa)isa)) {
            continue;
        }
        struct rhw_context_def def = rhw_context_def_default();
        def.isa_limit = rhw_isa_up_to((enum rhw_isa)isa);
        def.threads = 2;
        const struct outcome outcome = run(&def, 1);
        assert_int_equal(outcome.stats.isa, isa);
        expect_same(&outcome, &expected, "instruction set", isa);
    }
}

static void test_a_flush_of_the_bins_does_not_show(void **state)
{
    (void)state;
    const struct outcome expected = baseline();
    const size_t sizes[] = {1, 1 << 16, 1 << 18, 1 << 20, (size_t)1 << 30};
    for (int i = 0; i < 5; i++) {
        for (int threads = 1; threads <= 3; threads += 2) {
            struct rhw_context_def def = rhw_context_def_default();
            def.bin_memory = sizes[i];
            def.threads = threads;
            const struct outcome outcome = run(&def, 1);
            expect_same(&outcome, &expected, "bin memory", (int)sizes[i]);
            if (i == 0) {
                assert_true(outcome.stats.flushes > 0);
            }
            if (i == 4) {
                assert_int_equal(outcome.stats.flushes, 0);
            }
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_thread_counts),
    cmocka_unit_test(test_instruction_sets),
    cmocka_unit_test(test_a_flush_of_the_bins_does_not_show),
};

const struct unit_tests test_determinism = UNIT_TESTS(tests, NULL, NULL);
