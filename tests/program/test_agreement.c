// SPDX-License-Identifier: MIT
// rhw bench must notice when one renderer draws less, or something else, than the other.
#include "agreement.h"
#include "measure.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 90, PIXELS = WIDTH * HEIGHT };

static const struct bench_scene_entry *entry_of(const char *name)
{
    for (int i = 0; i < bench_scene_entry_count; i++) {
        if (strcmp(bench_scene_entries[i].name, name) == 0) {
            return &bench_scene_entries[i];
        }
    }
    fail_msg("no scene %s", name);
    return NULL;
}

// Draws the scene with a renderer, which is closed then; the caller frees the image.
static struct bench_image draw_with(struct bench_renderer *renderer, const struct bench_scene *scene)
{
    struct bench_image image = {.width = WIDTH, .height = HEIGHT};
    image.color = scene->has_color ? calloc(PIXELS, 4) : NULL;
    image.depth = scene->has_color ? NULL : calloc(PIXELS, sizeof *image.depth);
    if (!renderer->take(renderer, scene, WIDTH, HEIGHT)) {
        fail_msg("cannot take the scene: %s", renderer->why);
    }
    assert_true(renderer->frame(renderer));
    assert_true(renderer->read(renderer, &image));
    renderer->release(renderer);
    renderer->close(renderer);
    return image;
}

// Draws the scene with rhw; the caller frees the image.
static struct bench_image draw(const struct bench_scene *scene)
{
    struct bench_renderer renderer = {0};
    const char *why;
    assert_true(bench_open_rhw(&renderer, 1, RHW_ISA_COUNT, &why));
    return draw_with(&renderer, scene);
}

static void drop(struct bench_image *image)
{
    free(image->color);
    free(image->depth);
}

// Of `name`: the picture of the whole scene against that of the scene after `spoil`.
static struct bench_agreement against_spoiled(const char *name, void (*spoil)(struct bench_scene *scene))
{
    struct bench_scene scene;
    char why[128];
    assert_true(bench_scene_make(entry_of(name), &scene, WIDTH, HEIGHT, why, sizeof why));
    struct bench_image whole = draw(&scene), again = draw(&scene);
    const struct bench_agreement same = bench_agree(&whole, &again, &scene.tolerance);
    assert_true(same.agrees);
    assert_int_equal(same.coverage + same.outliers, 0);
    spoil(&scene);
    struct bench_image spoiled = draw(&scene);
    const struct bench_agreement result = bench_agree(&whole, &spoiled, &scene.tolerance);
    drop(&whole);
    drop(&again);
    drop(&spoiled);
    bench_scene_free(&scene);
    return result;
}

static void leave_out_triangles(struct bench_scene *scene)
{
    scene->meshes[0].index_count = scene->meshes[0].index_count / 2 / 3 * 3;
}

static void leave_out_last_draw(struct bench_scene *scene)
{
    scene->passes[0].draw_count--;
}

static void dim(struct bench_scene *scene)
{
    scene->draws[0].uniforms.ambient -= 0.03f;
}

static void use_one_mip_level_less(struct bench_scene *scene)
{
    for (int level = 0; level + 1 < scene->textures[0].levels; level++) {
        const int width = scene->textures[0].width >> level;
        memset(scene->textures[0].texels[level], 128, (size_t)width * (size_t)width * 4);
    }
}

// By the tolerance of trilinear pictures: the peer's way of anisotropic filtering is as far from rhw's as this.
static void filter_without_anisotropy(struct bench_scene *scene)
{
    scene->max_anisotropy = 0;
    scene->tolerance.color = 6;
}

static void ignore_shadows(struct bench_scene *scene)
{
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        if (scene->draws[i].stencil == BENCH_STENCIL_ZERO) {
            scene->draws[i].stencil = BENCH_STENCIL_OFF;
        }
    }
}

// Of the volumes alone.
static void leave_out_edges(struct bench_scene *scene)
{
    scene->meshes[2].index_count /= 4;
    scene->meshes[4].index_count /= 4;
}

static void leave_out_first_pass(struct bench_scene *scene)
{
    scene->passes[0].draw_count = 0;
}

static void leave_out_a_light(struct bench_scene *scene)
{
    memset(scene->shared[1], 0, sizeof scene->shared[1]);
}

static void swap_faces(struct bench_scene *scene)
{
    scene->passes[0].face = 1;
    scene->passes[1].face = 0;
}

static void leave_out_instances(struct bench_scene *scene)
{
    scene->meshes[0].instance_count -= scene->meshes[0].instance_count / 50;
}

static void test_missing_triangles_are_noticed(void **state)
{
    (void)state;
    const struct bench_agreement color = against_spoiled("sphere_10k", leave_out_triangles);
    assert_false(color.agrees);
    assert_true(color.coverage > PIXELS / 10);
    const struct bench_agreement depth = against_spoiled("sphere_1m_depth", leave_out_triangles);
    assert_false(depth.agrees);
    assert_true(depth.coverage > PIXELS / 10);
}

static void test_a_missing_layer_is_noticed(void **state)
{
    (void)state;
    assert_false(against_spoiled("fill_flat", leave_out_last_draw).agrees);
    assert_false(against_spoiled("fill_blend", leave_out_last_draw).agrees);
    assert_false(against_spoiled("fill_tex", leave_out_last_draw).agrees);
    assert_false(against_spoiled("fill_aniso", leave_out_last_draw).agrees);
    assert_false(against_spoiled("overdraw", leave_out_last_draw).agrees);
}

static void test_other_colors_are_noticed(void **state)
{
    (void)state;
    assert_false(against_spoiled("sphere_10k", dim).agrees);
    assert_false(against_spoiled("fill_tex", use_one_mip_level_less).agrees);
    assert_false(against_spoiled("fill_aniso", filter_without_anisotropy).agrees);
}

static void test_missing_passes_are_noticed(void **state)
{
    (void)state;
    assert_false(against_spoiled("shadow_volumes", ignore_shadows).agrees);
    assert_false(against_spoiled("shadow_volumes", leave_out_edges).agrees);
    assert_false(against_spoiled("shadow_map", leave_out_first_pass).agrees);
    assert_false(against_spoiled("reflection", leave_out_first_pass).agrees);
    assert_false(against_spoiled("reflection", swap_faces).agrees);
    assert_false(against_spoiled("deferred", leave_out_first_pass).agrees);
    assert_false(against_spoiled("deferred", leave_out_a_light).agrees);
}

static void test_missing_lines_points_and_instances_are_noticed(void **state)
{
    (void)state;
    assert_false(against_spoiled("lines_1m", leave_out_triangles).agrees);
    assert_false(against_spoiled("points_1m", leave_out_triangles).agrees);
    assert_false(against_spoiled("particles", leave_out_instances).agrees);
}

// Of `name`: what translated shaders draw against what those in C draw.
static struct bench_agreement against_translated(const char *name, enum bench_translation translation)
{
    struct bench_scene scene;
    struct bench_renderer renderer = {0};
    char why[128];
    const char *why_not;
    if (!bench_open_translated(&renderer, translation, 1, RHW_ISA_COUNT, &why_not)) {
        skip(); // the build has no glslangValidator, or no emitted C
    }
    assert_true(bench_scene_make(entry_of(name), &scene, WIDTH, HEIGHT, why, sizeof why));
    struct bench_image translated = draw_with(&renderer, &scene), compiled = draw(&scene);
    const struct bench_agreement result = bench_agree(&compiled, &translated, &scene.tolerance);
    drop(&translated);
    drop(&compiled);
    bench_scene_free(&scene);
    return result;
}

// Each shader that a scene without a file has, once.
static void check_same_bytes(enum bench_translation translation)
{
    static const char *const names[] = {
        "fill_flat",         "fill_literal",        "fill_color",         "fill_blend",
        "fill_tex",          "fill_aniso",          "sphere_10k",         "sphere_82k_flat",
        "sphere_1m_tex",     "shadow_volumes",      "shadow_map",         "reflection",
        "deferred",          "particles",           "transmission",       "cliffs_coord_slopes_fill",
        "cliffs_coord_mesh", "cliffs_slopes_mesh",  "cliffs_screen_mesh", "cliffs_discard_mesh",
        "cliffs_move_fill",  "cliffs_sample4_fill", "cliffs_many_mesh"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!against_translated(names[i], translation).is_equal) {
            fail_msg("%s is not equal", names[i]);
        }
    }
}

static void test_interpreted_shaders_draw_the_same_bytes(void **state)
{
    (void)state;
    check_same_bytes(BENCH_INTERPRETER);
}

static void test_generated_shaders_draw_the_same_bytes(void **state)
{
    (void)state;
    check_same_bytes(BENCH_MACHINE);
}

static void test_emitted_shaders_draw_the_same_bytes(void **state)
{
    (void)state;
    check_same_bytes(BENCH_EMITTED);
}

// The shader in C sorts and adds up in another order.
static void test_translated_shaders_agree_where_formulas_have_another_order(void **state)
{
    (void)state;
    assert_true(against_translated("hair", BENCH_INTERPRETER).agrees);
}

static void test_what_is_tolerated_is_exactly_what_is_stated(void **state)
{
    (void)state;
    uint8_t a[PIXELS * 4], b[PIXELS * 4];
    const struct bench_image left = {.width = WIDTH, .height = HEIGHT, .color = a};
    const struct bench_image right = {.width = WIDTH, .height = HEIGHT, .color = b};
    memset(a, 100, sizeof a);
    memset(b, 101, sizeof b);
    const struct bench_tolerance none = {0}, wide = {.color = 3, .outliers = 2.0 / PIXELS};
    assert_true(bench_agree(&left, &right, &none).agrees); // 1/255
    b[4] = 102;
    assert_false(bench_agree(&left, &right, &none).agrees);
    b[5] = b[6] = 103;
    assert_true(bench_agree(&left, &right, &wide).agrees);
    b[9] = 104; // one outlier
    b[15] = 0;  // and one that is not covered: two
    const struct bench_agreement two = bench_agree(&left, &right, &wide);
    assert_int_equal(two.outliers, 1);
    assert_int_equal(two.coverage, 1);
    assert_int_equal(two.color, 4);
    assert_true(two.agrees);
    b[16] = 96;
    assert_false(bench_agree(&left, &right, &wide).agrees);
    const struct bench_tolerance rough = {.alpha = 50};
    memcpy(b, a, sizeof b);
    b[3] = 150;
    assert_true(bench_agree(&left, &right, &rough).agrees);
    b[4] = 102;
    assert_false(bench_agree(&left, &right, &rough).agrees);
}

static void test_depths_that_are_no_numbers_differ(void **state)
{
    (void)state;
    float a[PIXELS] = {0}, b[PIXELS] = {0};
    const struct bench_image left = {.width = WIDTH, .height = HEIGHT, .depth = a};
    const struct bench_image right = {.width = WIDTH, .height = HEIGHT, .depth = b};
    const struct bench_tolerance tolerance = {.depth = 1e-3};
    b[7] = 0.0009f;
    assert_true(bench_agree(&left, &right, &tolerance).agrees);
    b[7] = 0.0011f;
    assert_false(bench_agree(&left, &right, &tolerance).agrees);
    b[7] = 0.0f / 0.0f;
    assert_false(bench_agree(&left, &right, &tolerance).agrees);
}

static void test_median(void **state)
{
    (void)state;
    double odd[5] = {5, 1, 4, 2, 3}, even[4] = {4, 1, 3, 2}, one[1] = {7};
    const struct bench_time a = bench_time_of(odd, 5), b = bench_time_of(even, 4), c = bench_time_of(one, 1);
    assert_true(a.median == 3 && a.least == 1 && a.most == 5);
    assert_true(b.median == 2 && b.least == 1 && b.most == 4);
    assert_true(c.median == 7 && c.least == 7 && c.most == 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_missing_triangles_are_noticed),
        cmocka_unit_test(test_a_missing_layer_is_noticed),
        cmocka_unit_test(test_other_colors_are_noticed),
        cmocka_unit_test(test_missing_passes_are_noticed),
        cmocka_unit_test(test_missing_lines_points_and_instances_are_noticed),
        cmocka_unit_test(test_interpreted_shaders_draw_the_same_bytes),
        cmocka_unit_test(test_generated_shaders_draw_the_same_bytes),
        cmocka_unit_test(test_emitted_shaders_draw_the_same_bytes),
        cmocka_unit_test(test_translated_shaders_agree_where_formulas_have_another_order),
        cmocka_unit_test(test_what_is_tolerated_is_exactly_what_is_stated),
        cmocka_unit_test(test_depths_that_are_no_numbers_differ),
        cmocka_unit_test(test_median),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
