// SPDX-License-Identifier: MIT
// A scene whose context has no memory left, once, wherever that happens: it says so, and gives back what it has.
#include "tiny_model.h"

#include <stdlib.h>
#include <string.h>

struct meter {
    int calls, blocks;
    int fail_at;    // the call that gets NULL; -1: none
    size_t largest; // the largest block that was asked for
};

// A block stands behind the address that malloc gave.
static void *take(void *user, size_t size, size_t alignment)
{
    struct meter *const meter = user;
    meter->largest = size > meter->largest ? size : meter->largest;
    if (meter->calls++ == meter->fail_at) {
        return NULL;
    }
    const size_t step = alignment < sizeof(void *) ? sizeof(void *) : alignment;
    void *const whole = malloc(size + 2 * step);
    if (whole == NULL) {
        return NULL;
    }
    meter->blocks++;
    void **const block = (void **)(((uintptr_t)whole + 2 * step - 1) / step * step);
    block[-1] = whole;
    return block;
}

static void give(void *user, void *memory, size_t size)
{
    (void)size;
    struct meter *const meter = user;
    if (memory != NULL) {
        meter->blocks--;
        free(((void **)memory)[-1]);
    }
}

// Two panes before each other, each with a mesh, a material and an image of its own.
struct panes {
    struct tiny t;
    struct scene_mesh meshes[2];
    struct scene_material materials[2];
    struct scene_image images[2];
};

static void make_panes(struct panes *p)
{
    tiny_make(&p->t);
    memset(p->t.texels, 200, sizeof p->t.texels);
    for (int i = 0; i < 2; i++) {
        p->meshes[i] = p->t.mesh;
        p->meshes[i].material = (uint32_t)i;
        p->images[i] = p->t.image;
        p->materials[i] = p->t.material;
        p->materials[i].alpha_mode = SCENE_ALPHA_BLEND;
        p->materials[i].unlit = i == 0;
        p->materials[i].slots[SCENE_SLOT_BASE_COLOR].image = i;
        p->t.instances[i].mesh = (uint32_t)i;
        p->t.instances[i].world[14] = (float)i - 0.5f;
    }
    p->t.model.meshes = p->meshes;
    p->t.model.materials = p->materials;
    p->t.model.images = p->images;
    p->t.model.mesh_count = p->t.model.material_count = p->t.model.image_count = p->t.model.instance_count =
        2;
}

static enum rhw_result draw(const struct panes *panes, struct meter *meter, struct scene_pictures *pictures)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.allocator = (struct rhw_allocator){take, give, meter};
    rhw_context *context;
    struct scene *scene;
    enum rhw_result result = rhw_context_create(&def, &context);
    if (result == RHW_OK) {
        result = scene_create(context, &panes->t.model, &scene);
        if (result == RHW_OK) {
            const struct scene_view view = tiny_view(&panes->t, 8);
            result = scene_draw(scene, &view, pictures, NULL);
            scene_destroy(scene);
        }
        rhw_context_destroy(context);
    }
    assert_int_equal(meter->blocks, 0);
    return result;
}

static void test_memory_runs_out(void **state)
{
    (void)state;
    struct panes panes;
    struct scene_pictures whole, pictures;
    struct meter meter = {.fail_at = -1};
    make_panes(&panes);
    assert_int_equal(draw(&panes, &meter, &whole), RHW_OK);
    assert_true(meter.calls > 20);
    for (int i = 0; i < meter.calls; i++) {
        struct meter scarce = {.fail_at = i};
        const enum rhw_result result = draw(&panes, &scarce, &pictures);
        if (result == RHW_OK) {
            fail_msg("allocation %d of %d failed and nobody said so", i, meter.calls);
        }
        assert_int_equal(result, RHW_ERROR_OUT_OF_MEMORY);
    }
    scene_pictures_free(&whole);
}

// What colours of both depths are drawn into is kept from draw to draw.
static void test_targets_are_kept(void **state)
{
    enum { SIDE = 256 };
    (void)state;
    for (int is_exact = 0; is_exact < 2; is_exact++) {
        struct panes panes;
        struct meter meter = {.fail_at = -1};
        make_panes(&panes);
        struct scene_view view = tiny_view(&panes.t, SIDE);
        view.outputs = SCENE_OUTPUT_COLOR | SCENE_OUTPUT_DISPLAY;
        view.transparency = is_exact ? SCENE_TRANSPARENCY_EXACT : SCENE_TRANSPARENCY_SORTED;
        view.samples = 4;
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = 1;
        def.allocator = (struct rhw_allocator){take, give, &meter};
        rhw_context *context;
        struct scene *scene;
        assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
        assert_int_equal(scene_create(context, &panes.t.model, &scene), RHW_OK);
        for (int repeat = 0; repeat < 2; repeat++) {
            struct scene_pictures pictures;
            meter.largest = 0;
            meter.calls = 0;
            assert_int_equal(scene_draw(scene, &view, &pictures, NULL), RHW_OK);
            assert_true(repeat == 0 || meter.largest < (size_t)4 * SIDE * SIDE);
            scene_pictures_free(&pictures);
        }
        scene_destroy(scene);
        rhw_context_destroy(context);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_memory_runs_out),
    cmocka_unit_test(test_targets_are_kept),
};

const struct unit_tests test_scarce_memory = UNIT_TESTS(tests, NULL, NULL);
