// SPDX-License-Identifier: MIT
// The layers of materials: each formula against its specification in double, and squares whose colour can be worked out.
#include "tiny_model.h"

#include <math.h>
#include <string.h>

#include "draw/shading/shade_layers.h"

static const double pi = 3.14159265358979323846;

// Formulas ------------------------------------------------------------------------------------------

static double charlie(double roughness, double n_dot_h)
{
    const double inverse = 1.0 / (roughness * roughness);
    return (2.0 + inverse) * pow(1.0 - n_dot_h * n_dot_h, 0.5 * inverse) / (2.0 * pi);
}

static void test_sheen(void **state)
{
    (void)state;
    for (double roughness = 0.1; roughness < 1.01; roughness += 0.1) {
        for (int i = 0; i < 30; i++) {
            const double nl = 0.05 + 0.03 * i, nv = 0.95 - 0.02 * i, nh = 0.1 + 0.028 * i;
            const double expected = charlie(roughness, nh) / (4.0 * (nl + nv - nl * nv));
            const rhw_float got = scene_sheen(rhw_splat((float)roughness), rhw_splat((float)nl),
                                              rhw_splat((float)nv), rhw_splat((float)nh));
            tiny_assert_close((double)got[4], expected, 1e-6 + 2e-4 * expected);
        }
    }
}

// What white sheen reflects of even light, by a sum over the hemisphere.
static double albedo(double roughness, double nv)
{
    enum { ROWS = 120, COLUMNS = 60 };
    double sum = 0.0;
    for (int i = 0; i < ROWS; i++) {
        const double nl = (i + 0.5) / ROWS, sl = sqrt(1.0 - nl * nl);
        for (int j = 0; j < COLUMNS; j++) {
            const double phi = pi * (j + 0.5) / COLUMNS, x = sl * cos(phi) + sqrt(1.0 - nv * nv),
                         y = sl * sin(phi);
            const double nh = (nl + nv) / sqrt(x * x + y * y + (nl + nv) * (nl + nv));
            sum += charlie(roughness, nh) * nl / (4.0 * (nl + nv - nl * nv));
        }
    }
    return fmin(2.0 * pi * sum / (ROWS * COLUMNS), 1.0);
}

static void test_sheen_albedo(void **state)
{
    (void)state;
    for (double roughness = 0.35; roughness < 1.0; roughness += 0.13) {
        for (double nv = 0.04; nv < 1.0; nv += 0.13) {
            const rhw_float got = scene_sheen_albedo(rhw_splat((float)roughness), rhw_splat((float)nv));
            tiny_assert_close((double)got[1], albedo(roughness, nv), 0.05);
        }
    }
    assert_true(scene_sheen_albedo(rhw_splat(0.01f), rhw_splat(0.0f))[0] <= 1.0f);
    assert_true(scene_sheen_albedo(rhw_splat(1.0f), rhw_splat(1.0f))[0] > 0.1f);
}

// A film of no thickness is none, one of the same index as air too; a film of 400 nm has the colours of the specification.
static void test_film(void **state)
{
    (void)state;
    const rhw_float f0[3] = {rhw_splat(0.04f), rhw_splat(0.3f), rhw_splat(0.9f)};
    rhw_float fresnel[3];
    for (double cosine = 0.8; cosine < 1.0; cosine += 0.05) { // at a slant its Schlick terms add up
        const rhw_float c = rhw_splat((float)cosine);
        scene_film_fresnel(1.3f, rhw_splat(0.0f), c, f0, fresnel);
        for (int i = 0; i < 3; i++) {
            const double base = (double)f0[i][0], expected = base + (1.0 - base) * pow(1.0 - cosine, 5.0);
            tiny_assert_close((double)fresnel[i][2], expected, 0.015);
        }
    }
    double least = 1.0, most = 0.0;
    for (float thickness = 100.0f; thickness < 800.0f; thickness += 10.0f) {
        scene_film_fresnel(1.8f, rhw_splat(thickness), rhw_splat(0.9f), f0, fresnel);
        least = fmin(least, (double)fresnel[0][0]);
        most = fmax(most, (double)fresnel[0][0]);
    }
    assert_true(least < 0.08 && most > 0.2);
    for (float f = 0.02f; f < 0.95f; f += 0.1f) {
        const rhw_float back = scene_schlick_to_f0(
            scene_schlick(rhw_splat(f), rhw_splat(1.0f), rhw_splat(0.4f)), rhw_splat(0.4f));
        tiny_assert_close((double)back[0], (double)f, 1e-5);
    }
}

// With two equal widths it is GGX with height-correlated shadowing.
static void test_anisotropic_ggx(void **state)
{
    (void)state;
    const double alpha = 0.3, v[3] = {0.48, 0.36, 0.8}, l[3] = {-0.6, 0.0, 0.8};
    double h[3] = {v[0] + l[0], v[1] + l[1], v[2] + l[2]};
    const double length = sqrt(h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    struct scene_layered m = {.alpha = rhw_splat((float)alpha), .alpha_t = rhw_splat((float)alpha)};
    rhw_float light[3], half[3];
    for (int c = 0; c < 3; c++) {
        m.view[c] = rhw_splat((float)v[c]);
        m.tangent[c] = rhw_splat(c == 0 ? 1.0f : 0.0f);
        m.bitangent[c] = rhw_splat(c == 1 ? 1.0f : 0.0f);
        light[c] = rhw_splat((float)l[c]);
        half[c] = rhw_splat((float)(h[c] / length));
    }
    m.n_dot_v = rhw_splat(0.8f);
    const double nh = h[2] / length, a2 = alpha * alpha, base = nh * nh * (a2 - 1.0) + 1.0;
    const double lambda = 0.8 * sqrt(0.64 * (1.0 - a2) + a2);
    const double expected = a2 / (pi * base * base) * 0.5 / (2.0 * lambda);
    const rhw_float got = scene_anisotropic_ggx(&m, light, half, rhw_splat(0.8f), rhw_splat((float)nh));
    tiny_assert_close((double)got[6], expected, 1e-4 * expected);
    // Brushed along the tangent the highlight is longer that way.
    m.alpha_t = rhw_splat(0.9f);
    const rhw_float wide = scene_anisotropic_ggx(&m, light, half, rhw_splat(0.8f), rhw_splat((float)nh));
    assert_true(wide[0] < got[0]);
}

// Squares -------------------------------------------------------------------------------------------

static struct scene_layers plain_layers(void)
{
    return (struct scene_layers){.used = true,
                                 .clearcoat_normal_scale = 1,
                                 .specular = 1,
                                 .specular_color = {1, 1, 1},
                                 .ior = 1.5f,
                                 .attenuation_distance = INFINITY,
                                 .attenuation_color = {1, 1, 1},
                                 .anisotropy_direction = {1, 0},
                                 .iridescence_ior = 1.3f,
                                 .iridescence_thickness = {100, 400},
                                 .gloss_specular = {1, 1, 1},
                                 .glossiness = 1};
}

static struct scene_view light_view(struct tiny *t)
{
    t->material.unlit = false;
    struct scene_view view = tiny_view(t, 8);
    view.outputs = SCENE_OUTPUT_LINEAR;
    return view;
}

// Light of the middle pixel.
static void draw_light(const struct tiny *t, const struct scene_view *view, double light[3])
{
    const struct rhw_context_def def = rhw_context_def_default();
    rhw_context *context;
    struct scene *scene;
    struct scene_pictures pictures;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    assert_int_equal(scene_create(context, &t->model, &scene), RHW_OK);
    assert_int_equal(scene_draw(scene, view, &pictures, NULL), RHW_OK);
    for (int c = 0; c < 3; c++) {
        light[c] = (double)pictures.linear[4 * (4 * 8 + 4) + c];
    }
    scene_pictures_free(&pictures);
    scene_destroy(scene);
    rhw_context_destroy(context);
}

static void test_layers_that_add_nothing(void **state)
{
    (void)state;
    for (int m = 0; m < 4; m++) {
        struct tiny t;
        tiny_make(&t);
        const struct scene_view view = light_view(&t);
        t.material.metallic = (float)(m & 1);
        t.material.roughness = m & 2 ? 0.3f : 0.8f;
        t.material.base_color[1] = 0.4f;
        double without[3], with[3];
        draw_light(&t, &view, without);
        t.material.layers = plain_layers();
        draw_light(&t, &view, with);
        for (int c = 0; c < 3; c++) {
            tiny_assert_close(with[c], without[c], 1e-4);
        }
    }
}

// Each layer must show, and in the right direction.
static void test_every_layer_shows(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.mesh.tangents = t.tangents;
    struct scene_view view = light_view(&t);
    t.material.base_color[0] = t.material.base_color[1] = t.material.base_color[2] = 0.2f;
    t.material.roughness = 0.9f;
    double plain[3], got[3];
    t.material.layers = plain_layers();
    draw_light(&t, &view, plain);

    t.material.layers.sheen_color[0] = 1;
    t.material.layers.sheen_roughness = 0.8f;
    draw_light(&t, &view, got);
    assert_true(got[0] > plain[0] + 0.02 && got[1] < plain[1]); // red fibres over what is darker below

    t.material.layers = plain_layers();
    t.material.layers.specular = 0;
    draw_light(&t, &view, got);
    assert_true(got[0] < plain[0] - 0.005);

    t.material.layers = plain_layers();
    t.material.layers.ior = 3;
    draw_light(&t, &view, got);
    assert_true(got[0] > plain[0] + 0.02);
    t.material.layers.specular_color[2] = 0;
    draw_light(&t, &view, got);
    assert_true(got[2] < got[0] - 0.05);

    t.material.layers = plain_layers();
    t.material.layers.iridescence = 1;
    t.material.layers.iridescence_thickness[1] = 450;
    draw_light(&t, &view, got);
    assert_true(fabs(got[0] - got[2]) > 0.005);

    t.material.metallic = 1;
    t.material.roughness = 0.3f;
    t.material.layers = plain_layers();
    draw_light(&t, &view, plain);
    t.material.layers.anisotropy = 1;
    draw_light(&t, &view, got);
    assert_true(fabs(got[0] - plain[0]) > 0.001);
}

// Images of colours are decoded from sRGB, in which 188 is 0.502886: they give what the colour gives.
static void test_images_of_colors(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    const struct scene_view view = light_view(&t);
    memset(t.texels, 188, sizeof t.texels);
    t.material.base_color[0] = t.material.base_color[1] = t.material.base_color[2] = 0.2f;
    t.material.layers = plain_layers();
    t.material.layers.ior = 3;
    t.material.layers.sheen_roughness = 0.8f;
    for (int sheen = 0; sheen < 2; sheen++) {
        float *const color = sheen ? t.material.layers.sheen_color : t.material.layers.specular_color;
        int32_t *const image =
            &t.material.slots[sheen ? SCENE_SLOT_SHEEN_COLOR : SCENE_SLOT_SPECULAR_COLOR].image;
        double by_image[3], by_color[3];
        color[0] = color[1] = color[2] = 1;
        *image = 0;
        draw_light(&t, &view, by_image);
        color[0] = color[1] = color[2] = 0.502886f;
        *image = -1;
        draw_light(&t, &view, by_color);
        for (int c = 0; c < 3; c++) {
            tiny_assert_close(by_image[c], by_color[c], 1e-5);
        }
    }
}

// A coat mirrors 4 % head on and dims what is below by as much: with the surroundings black but for a lamp beside the
// mirror's direction, dimming alone is left.
static void test_coat_dims(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = light_view(&t);
    view.camera.eye[2] = 8;
    view.camera.zfar = 20;
    t.material.roughness = 1;
    t.material.emissive[1] = 1000;
    t.material.layers = plain_layers();
    double plain[3], coated[3];
    draw_light(&t, &view, plain);
    t.material.layers.clearcoat = 1;
    t.material.layers.clearcoat_roughness = 0.1f;
    draw_light(&t, &view, coated);
    tiny_assert_close(coated[1] / plain[1], 0.96, 1e-3);
    assert_true(coated[0] > 0.96 * plain[0]);
}

// Glass with the index of air mirrors nothing head on: the background shows through, times the colour, less what the
// volume absorbs.
static void test_transmission(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = light_view(&t);
    view.default_lights = true;
    memcpy(view.background_color, (const uint8_t[]){255, 255, 255}, 3);
    t.material.roughness = 0;
    t.material.base_color[1] = 0.5f;
    t.material.layers = plain_layers();
    t.material.layers.transmission = 1;
    t.material.layers.ior = 1;
    t.material.layers.specular = 0;
    double light[3];
    draw_light(&t, &view, light);
    tiny_assert_close(light[0], 1.0, 0.01);
    tiny_assert_close(light[1], 0.5, 0.01);
    t.material.layers.thickness = 2;
    t.material.layers.attenuation_distance = 1;
    t.material.layers.attenuation_color[0] = 0.5f;
    t.material.layers.attenuation_color[2] = 0.1f;
    draw_light(&t, &view, light);
    tiny_assert_close(light[0], 0.25, 0.005);
    tiny_assert_close(light[1], 0.5, 0.005);
    tiny_assert_close(light[2], 0.01, 0.005);
    // On a transparent background the surroundings show instead.
    view.background = SCENE_BACKGROUND_TRANSPARENT;
    draw_light(&t, &view, light);
    assert_true(light[1] > 0.02);
    // Dispersion without measure bends no colour as if it were slower than light in a vacuum.
    t.material.layers.ior = 1.6f;
    t.material.layers.dispersion = 100;
    for (int v = 0; v < 4; v++) {
        t.normals[v][0] = 0.995f;
        t.normals[v][2] = 0.1f;
    }
    draw_light(&t, &view, light);
    for (int c = 0; c < 3; c++) {
        assert_true(light[c] >= 0 && light[c] < 10);
    }
}

// Glass that has no own light: its colour alone, with the index of air.
static void make_glass(struct scene_material *material)
{
    material->roughness = 0;
    material->layers = plain_layers();
    material->layers.transmission = 1;
    material->layers.ior = 1;
    material->layers.specular = 0;
}

static void set_distance(struct scene_instance *instance, float z)
{
    tiny_identity(instance->world);
    instance->world[14] = z;
}

// A pane is seen through another, whichever the file has first, and through both sides of itself. A volume, whose
// thickness is that of its whole, is not.
static void test_glass_behind_glass(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = light_view(&t);
    view.default_lights = true;
    memcpy(view.background_color, (const uint8_t[]){255, 255, 255}, 3);
    make_glass(&t.material);
    t.material.base_color[1] = 0.5f;
    t.model.instance_count = 2;
    double light[3];
    for (int first = 0; first < 2; first++) {
        set_distance(&t.instances[first], -1.0f);
        set_distance(&t.instances[1 - first], 0.0f);
        draw_light(&t, &view, light);
        tiny_assert_close(light[0], 1.0, 0.01);
        tiny_assert_close(light[1], 0.25, 0.01);
    }
    // The farther pane shows its back.
    t.instances[1].world[0] = t.instances[1].world[10] = -1.0f;
    draw_light(&t, &view, light);
    tiny_assert_close(light[1], 0.5, 0.01);
    t.material.double_sided = true;
    draw_light(&t, &view, light);
    tiny_assert_close(light[1], 0.25, 0.01);
    t.material.layers.thickness = 1;
    t.material.layers.attenuation_distance = 1e30f;
    draw_light(&t, &view, light);
    tiny_assert_close(light[1], 0.5, 0.01);
}

// What is blended shows through glass that is before it, and counts once where it is before the glass.
static void test_blended_beside_glass(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = light_view(&t);
    view.default_lights = true;
    memcpy(view.background_color, (const uint8_t[]){255, 255, 255}, 3);
    make_glass(&t.material);
    struct scene_material materials[2] = {t.material, t.material};
    materials[1].layers.used = false;
    materials[1].unlit = true;
    materials[1].alpha_mode = SCENE_ALPHA_BLEND;
    memcpy(materials[1].base_color, (const float[]){1, 0, 0, 0.5f}, sizeof materials[1].base_color);
    struct scene_mesh meshes[2] = {t.mesh, t.mesh};
    meshes[1].material = 1;
    t.model.meshes = meshes;
    t.model.materials = materials;
    t.model.mesh_count = t.model.material_count = 2;
    t.model.instance_count = 2;
    t.instances[1].mesh = 1;
    for (int before = 0; before < 2; before++) {
        set_distance(&t.instances[1], before ? 1.0f : -1.0f);
        double light[3];
        draw_light(&t, &view, light);
        tiny_assert_close(light[0], 1.0, 0.01);
        tiny_assert_close(light[1], 0.5, 0.01);
    }
    // Neither is what has layers, but lets no light through.
    set_distance(&t.instances[1], -1.0f);
    materials[1].unlit = false;
    materials[1].alpha_mode = SCENE_ALPHA_OPAQUE;
    materials[1].layers = plain_layers();
    materials[1].layers.clearcoat = 1;
    double light[3];
    draw_light(&t, &view, light);
    assert_true(light[0] > 0.2 && light[1] < 0.2);
}

// A slab bends what is behind it aside: behind a square that is tilted the edge of another moves.
static void test_refraction(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = light_view(&t);
    memcpy(view.background_color, (const uint8_t[]){0, 0, 0}, 3);
    t.material.roughness = 0;
    t.material.layers = plain_layers();
    t.material.layers.transmission = 1;
    t.material.layers.specular = 0;
    // A second material, white and unlit, on a second mesh: the left half.
    struct scene_material materials[2] = {t.material, t.material};
    materials[1].layers.used = false;
    materials[1].unlit = true;
    float positions[4][3];
    memcpy(positions, t.positions, sizeof positions);
    for (int v = 0; v < 4; v++) {
        positions[v][0] = positions[v][0] * 2 - 2.0f;
        positions[v][1] *= 3;
        positions[v][2] = -3;
    }
    struct scene_mesh meshes[2] = {t.mesh, t.mesh};
    meshes[1].positions = positions;
    meshes[1].material = 1;
    t.model.meshes = meshes;
    t.model.materials = materials;
    t.model.mesh_count = t.model.material_count = 2;
    t.model.instance_count = 2;
    t.instances[1].mesh = 1;
    // The slab's normals lean to the right: rays that enter are bent to the left.
    for (int v = 0; v < 4; v++) {
        t.normals[v][0] = 0.6f;
        t.normals[v][2] = 0.8f;
    }
    for (int thick = 0; thick < 2; thick++) {
        materials[0].layers.thickness = thick ? 2.0f : 0.0f;
        double light[3];
        draw_light(&t, &view, light);
        // The middle pixel lies just right of the edge: through a thin wall it is black.
        assert_true(thick ? light[0] > 0.5 : light[0] < 0.2);
    }
}

// The old model: specular colour and glossiness; a mirror of its colour where the diffuse colour is black.
static void test_gloss(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = light_view(&t);
    t.material.layers = plain_layers();
    t.material.base_color[0] = 0.9f;
    t.material.base_color[1] = 0.6f;
    t.material.base_color[2] = 0.3f;
    t.material.metallic = 1;
    t.material.roughness = 0.4f;
    double metal[3], gloss[3];
    draw_light(&t, &view, metal);
    t.material.layers.glossy = true;
    for (int c = 0; c < 3; c++) {
        t.material.layers.gloss_specular[c] = t.material.base_color[c];
        t.material.base_color[c] = 0;
    }
    t.material.layers.glossiness = 0.6f;
    draw_light(&t, &view, gloss);
    for (int c = 0; c < 3; c++) {
        tiny_assert_close(gloss[c], metal[c], 1e-4);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_sheen),
    cmocka_unit_test(test_sheen_albedo),
    cmocka_unit_test(test_film),
    cmocka_unit_test(test_anisotropic_ggx),
    cmocka_unit_test(test_layers_that_add_nothing),
    cmocka_unit_test(test_every_layer_shows),
    cmocka_unit_test(test_images_of_colors),
    cmocka_unit_test(test_coat_dims),
    cmocka_unit_test(test_transmission),
    cmocka_unit_test(test_glass_behind_glass),
    cmocka_unit_test(test_blended_beside_glass),
    cmocka_unit_test(test_refraction),
    cmocka_unit_test(test_gloss),
};

const struct unit_tests test_layers = UNIT_TESTS(tests, NULL, NULL);
