// SPDX-License-Identifier: MIT
// The ground that shows nothing but the shadow on it: below the subject, in colour alone, for every axis that may be up.
#include "tiny_model.h"

#include <math.h>
#include <string.h>

#include "draw/panorama.h"

enum { SIZE = 64 };

static void draw(const struct tiny *t, const struct scene_view *view, struct scene_pictures *pictures)
{
    const struct rhw_context_def def = rhw_context_def_default();
    rhw_context *context;
    struct scene *scene;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    assert_int_equal(scene_create(context, &t->model, &scene), RHW_OK);
    assert_int_equal(scene_draw(scene, view, pictures, NULL), RHW_OK);
    scene_destroy(scene);
    rhw_context_destroy(context);
}

// The upright square from in front and above; y is turned to what is up.
static struct scene_view make_view(struct tiny *t, enum scene_axis up)
{
    tiny_make(t);
    t->material.unlit = false;
    t->material.double_sided = true;
    t->model.up = up;
    for (int v = 0; v < 4; v++) {
        double p[3] = {(double)t->positions[v][0] * 0.5, (double)t->positions[v][1], 0}, n[3] = {0, 0, 1};
        scene_axis_turn(up, p);
        scene_axis_turn(up, n);
        for (int c = 0; c < 3; c++) {
            t->positions[v][c] = (float)p[c];
            t->normals[v][c] = (float)n[c];
        }
    }
    tiny_set_bounds(t);
    struct scene_view view = scene_view_default(&t->model);
    view.width = view.height = SIZE;
    view.up = up;
    view.ground = true;
    view.background = SCENE_BACKGROUND_TRANSPARENT;
    view.outputs = SCENE_OUTPUT_LINEAR | SCENE_OUTPUT_OBJECT | SCENE_OUTPUT_DEPTH;
    const struct scene_orbit orbit = {.azimuth = 0, .elevation = 35, .up = up};
    view.camera = scene_camera_fit(&t->model, orbit, 0.9, 1.0);
    return view;
}

// How much of the picture that no object covers is darkened, and the most.
static double shade_beside(const struct scene_pictures *p, double *most)
{
    double sum = 0.0;
    *most = 0.0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const double alpha = (double)p->linear[4 * i + 3];
        // Edges of the square itself are drawn with one sample: all or nothing.
        if (p->object[i] == 0) {
            assert_true(p->linear[4 * i] == 0.0f);
            sum += alpha;
            *most = alpha > *most ? alpha : *most;
        }
    }
    return sum / (SIZE * SIZE);
}

static void the_shadow_alone_shows(void **state)
{
    (void)state;
    double first = 0.0;
    for (int up = SCENE_AXIS_Y; up <= SCENE_AXIS_MINUS_X; up++) {
        struct tiny t;
        struct scene_view view = make_view(&t, (enum scene_axis)up);
        struct scene_pictures with, without, dark;
        double most, none;
        draw(&t, &view, &with);
        const double shade = shade_beside(&with, &most);
        assert_true(shade > 0.005 && most > 0.15 && most < 0.95);
        first = up == 0 ? shade : first;
        tiny_assert_close(shade, first, 1e-6);
        assert_true(with.linear[3] == 0.0f); // nothing far away
        view.ground = false;
        draw(&t, &view, &without);
        tiny_assert_close(shade_beside(&without, &none), 0.0, 0.0);
        assert_memory_equal(with.object, without.object, sizeof(uint32_t) * SIZE * SIZE);
        assert_memory_equal(with.depth, without.depth, sizeof(float) * SIZE * SIZE);
        // Without light that is missing somewhere nothing shows.
        view.ground = true;
        view.shadows = view.ambient_occlusion = false;
        draw(&t, &view, &dark);
        tiny_assert_close(shade_beside(&dark, &none), 0.0, 0.0);
        scene_pictures_free(&with);
        scene_pictures_free(&without);
        scene_pictures_free(&dark);
    }
}

static void from_below_there_is_none(void **state)
{
    (void)state;
    struct tiny t;
    struct scene_view view = make_view(&t, SCENE_AXIS_Y);
    const struct scene_orbit orbit = {.azimuth = 0, .elevation = -35, .up = SCENE_AXIS_Y};
    view.camera = scene_camera_fit(&t.model, orbit, 0.9, 1.0);
    struct scene_pictures pictures;
    double most;
    draw(&t, &view, &pictures);
    tiny_assert_close(shade_beside(&pictures, &most), 0.0, 0.0);
    scene_pictures_free(&pictures);
}

// In white surroundings red, green and blue lights that change places take as much from the ground.
static void every_color_counts_alike(void **state)
{
    (void)state;
    static float texels[16 * 8][4];
    for (int i = 0; i < 16 * 8; i++) {
        texels[i][0] = texels[i][1] = texels[i][2] = 1.0f;
    }
    const struct scene_panorama panorama = {16, 8, texels};
    double first = 0.0;
    for (int c = 0; c < 3; c++) {
        struct tiny t;
        struct scene_view view = make_view(&t, SCENE_AXIS_Y);
        struct scene_model_light lights[3] = {
            {.direction = {0.6f, -0.8f, 0}}, {.direction = {0, -0.8f, 0.6f}}, {.direction = {0, -1, 0}}};
        for (int i = 0; i < 3; i++) {
            lights[i].name = "sun";
            lights[i].type = SCENE_LIGHT_DIRECTIONAL;
            lights[i].intensity = 3;
            lights[i].color[(c + i) % 3] = 1;
        }
        t.model.lights = lights;
        t.model.light_count = 3;
        view.panorama = &panorama;
        struct scene_pictures pictures;
        double most;
        draw(&t, &view, &pictures);
        const double shade = shade_beside(&pictures, &most);
        first = c == 0 ? shade : first;
        assert_true(shade > 0.001);
        tiny_assert_close(shade, first, 1e-7);
        scene_pictures_free(&pictures);
    }
}

// Whether no pixel around this one is of the square.
static bool is_off_the_square(const struct scene_pictures *p, int pixel)
{
    int covered = 0;
    for (int y = pixel / SIZE - 1; y <= pixel / SIZE + 1; y++) {
        for (int x = pixel % SIZE - 1; x <= pixel % SIZE + 1; x++) {
            covered += x >= 0 && y >= 0 && x < SIZE && y < SIZE && p->object[y * SIZE + x] != 0;
        }
    }
    return covered == 0;
}

// Put a pane before the square, twice as large and on the same ground, of a second material.
static void add_pane(struct tiny *t, struct scene_material materials[2], struct scene_mesh meshes[2])
{
    materials[0] = materials[1] = t->material;
    meshes[0] = meshes[1] = t->mesh;
    meshes[1].material = 1;
    t->model.materials = materials;
    t->model.meshes = meshes;
    t->model.material_count = t->model.mesh_count = t->model.instance_count = 2;
    struct scene_instance *pane = &t->instances[1];
    pane->mesh = 1;
    tiny_identity(pane->world);
    pane->world[0] = 4.0f;
    pane->world[5] = 2.0f;
    pane->world[13] = 1.0f;
    pane->world[14] = 0.75f;
    tiny_set_bounds(t);
}

// Lay a pane flat before the eye, so that all of the picture is seen through it.
static void lay_before(struct scene_instance *pane, struct scene_camera *camera)
{
    const float world[16] = {2, 0, 0, 0, 0, 0, -2, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    memcpy(pane->world, world, sizeof world);
    for (int c = 0; c < 3; c++) {
        pane->world[12 + c] = (float)camera->eye[c];
    }
    pane->world[13] -= 0.25f;
    camera->znear = 0.05;
}

// The ground and what lies on it are seen through a pane that bends nothing as they are without it.
static void check_pane(bool is_before_all, double tolerance)
{
    struct tiny t;
    struct scene_material materials[2];
    struct scene_mesh meshes[2];
    struct scene_view view = make_view(&t, SCENE_AXIS_Y);
    add_pane(&t, materials, meshes);
    view.camera =
        scene_camera_fit(&t.model, (struct scene_orbit){.elevation = 60, .up = SCENE_AXIS_Y}, 0.9, 1.0);
    if (is_before_all) {
        lay_before(&t.instances[1], &view.camera);
    }
    view.background = SCENE_BACKGROUND_COLOR;
    memset(view.background_color, 255, sizeof view.background_color);
    materials[1].alpha_mode = SCENE_ALPHA_MASK;
    materials[1].alpha_cutoff = 0.5f;
    materials[1].base_color[3] = 0.0f;
    struct scene_pictures bare, glazed;
    draw(&t, &view, &bare);
    materials[1].alpha_mode = SCENE_ALPHA_OPAQUE;
    materials[1].layers = (struct scene_layers){.used = true,
                                                .transmission = 1,
                                                .ior = 1,
                                                .attenuation_distance = INFINITY,
                                                .attenuation_color = {1, 1, 1}};
    draw(&t, &view, &glazed);
    int shaded = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (is_off_the_square(&bare, i) && glazed.object[i] == 2) {
            tiny_assert_close((double)glazed.linear[4 * i], 1.0 - (double)bare.linear[4 * i + 3], tolerance);
            shaded += bare.linear[4 * i + 3] > 0.1f;
        }
    }
    assert_true(shaded > 20);
    scene_pictures_free(&bare);
    scene_pictures_free(&glazed);
}

static void glass_shows_the_ground(void **state)
{
    (void)state;
    check_pane(false, 0.01);
    check_pane(true, 0.05); // the shadow map covers the pane too, and is coarser
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_shadow_alone_shows), cmocka_unit_test(every_color_counts_alike),
    cmocka_unit_test(glass_shows_the_ground), cmocka_unit_test(from_below_there_is_none)};

const struct unit_tests test_ground = UNIT_TESTS(tests, NULL, NULL);
