// SPDX-License-Identifier: MIT
// Cameras, order of drawing and reflection formulas against double precision, and small models whose
// pixels are known.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "draw.h"
#include "light.h"
#include "shaders_pbr.h"
#include "surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static void assert_close(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) {
        fail_msg("%.9g instead of %.9g (tolerance %g)", value, expected, tolerance);
    }
}

// A model of one mesh -------------------------------------------------------------------------------

struct tiny {
    struct rhw_model model;
    struct rhw_mesh mesh;
    struct rhw_material material;
    struct rhw_instance instances[2];
    struct rhw_model_light light;
    struct rhw_image image;
    uint8_t texels[4][4];
    float positions[4][3], normals[4][3], tangents[4][4], uvs[4][2], colors[4][4];
    uint32_t indices[6];
};

static void identity(float m[16])
{
    memset(m, 0, 16 * sizeof *m);
    m[0] = m[5] = m[10] = m[15] = 1.0f;
}

static void set_bounds(struct tiny *t)
{
    for (int i = 0; i < 3; i++) {
        t->mesh.bounds_min[i] = t->mesh.bounds_max[i] = t->positions[0][i];
        for (int v = 1; v < 4; v++) {
            t->mesh.bounds_min[i] = fminf(t->mesh.bounds_min[i], t->positions[v][i]);
            t->mesh.bounds_max[i] = fmaxf(t->mesh.bounds_max[i], t->positions[v][i]);
        }
        t->model.bounds_min[i] = t->mesh.bounds_min[i];
        t->model.bounds_max[i] = t->mesh.bounds_max[i];
    }
}

// The square −1..1 in the plane z = 0 that faces +Z, white, unlit; texture coordinates 0..1 from its top left.
static void make_tiny(struct tiny *t)
{
    memset(t, 0, sizeof *t);
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    static const uint32_t order[6] = {0, 1, 2, 0, 2, 3};
    for (int v = 0; v < 4; v++) {
        t->positions[v][0] = corners[v][0];
        t->positions[v][1] = corners[v][1];
        t->normals[v][2] = 1.0f;
        t->tangents[v][0] = t->tangents[v][3] = 1.0f;
        t->uvs[v][0] = corners[v][0] * 0.5f + 0.5f;
        t->uvs[v][1] = 0.5f - corners[v][1] * 0.5f;
    }
    memcpy(t->indices, order, sizeof order);
    t->mesh = (struct rhw_mesh){.name = "square",
                                .vertex_count = 4,
                                .index_count = 6,
                                .indices = t->indices,
                                .positions = t->positions,
                                .normals = t->normals,
                                .uvs = {t->uvs, NULL}};
    t->material = (struct rhw_material){.name = "m",
                                        .base_color = {1, 1, 1, 1},
                                        .roughness = 1,
                                        .normal_scale = 1,
                                        .occlusion_strength = 1,
                                        .alpha_cutoff = 0.5f,
                                        .unlit = true};
    for (int s = 0; s < RHW_SLOT_COUNT; s++) {
        t->material.slots[s] = (struct rhw_texture_slot){.image = -1, .transform = {1, 0, 0, 0, 1, 0}};
    }
    for (uint32_t i = 0; i < 2; i++) {
        t->instances[i] = (struct rhw_instance){.name = "n", .object = i + 1};
        identity(t->instances[i].world);
    }
    t->image = (struct rhw_image){.name = "i",
                                  .width = 2,
                                  .height = 2,
                                  .used_as_color = true,
                                  .used_as_data = true,
                                  .size = sizeof t->texels,
                                  .texels = t->texels};
    t->model = (struct rhw_model){.path = "tiny",
                                  .format = "none",
                                  .mesh_count = 1,
                                  .material_count = 1,
                                  .image_count = 1,
                                  .instance_count = 1,
                                  .meshes = &t->mesh,
                                  .materials = &t->material,
                                  .images = &t->image,
                                  .instances = t->instances,
                                  .lights = &t->light};
    set_bounds(t);
}

// Orthographic, so that the square −1..1 is the middle half of an 8×8 picture: pixels 2..5.
static struct rhw_view tiny_view(const struct tiny *t, int size)
{
    struct rhw_view view = rhw_view_default(&t->model);
    view.width = view.height = size;
    view.camera = (struct rhw_camera){
        .eye = {0, 0, 5}, .up = {0, 1, 0}, .orthographic = true, .ymag = 2.0, .znear = 1.0, .zfar = 9.0};
    view.background = RHW_BACKGROUND_COLOR;
    view.background_color[0] = 10;
    view.background_color[1] = 200;
    view.background_color[2] = 30;
    return view;
}

static struct rhw_pictures draw_model(const struct rhw_model *model, const struct rhw_view *view)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    rhw_context *context;
    struct rhw_scene *scene;
    struct rhw_pictures pictures;
    char error[200];
    assert_true(rhw_view_check(view, error, sizeof error));
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    assert_int_equal(rhw_scene_create(context, model, &scene), RHW_OK);
    assert_int_equal(rhw_scene_draw(scene, view, &pictures, NULL), RHW_OK);
    rhw_scene_destroy(scene);
    rhw_context_destroy(context);
    return pictures;
}

static void assert_pixel(const uint8_t *pixel, int r, int g, int b, int a)
{
    const int expected[4] = {r, g, b, a};
    for (int c = 0; c < 4; c++) {
        if (pixel[c] != expected[c]) {
            fail_msg("pixel %d %d %d %d instead of %d %d %d %d", pixel[0], pixel[1], pixel[2], pixel[3], r, g,
                     b, a);
        }
    }
}

// Camera --------------------------------------------------------------------------------------------

static void project(const double m[16], const double p[3], double ndc[3])
{
    double clip[4];
    for (int r = 0; r < 4; r++) {
        clip[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
    }
    for (int i = 0; i < 3; i++) {
        ndc[i] = clip[i] / clip[3];
    }
}

static void view_projection(const struct rhw_camera *camera, double aspect, double m[16])
{
    double view[16], projection[16];
    rhw_camera_view(camera, view);
    rhw_camera_projection(camera, aspect, projection);
    rhw_matrix_multiply(projection, view, m);
}

// Whatever the angle and the aspect, all vertices lie within the margin, and some touch it unless the
// camera would come nearer than a fifth of the model's length along the view.
static void test_fit_touches_the_margin(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.positions[0][2] = 3.0f;
    t.positions[2][2] = -7.0f;
    t.positions[3][0] = 20.0f;
    set_bounds(&t);
    t.instances[0].world[12] = 1000.0f;
    t.instances[0].world[5] = 2.0f;
    for (double azimuth = -200.0; azimuth < 400.0; azimuth += 37.0) {
        for (double elevation = -90.0; elevation <= 90.0; elevation += 22.5) {
            for (double aspect = 0.25; aspect <= 4.0; aspect *= 2.0) {
                const struct rhw_orbit orbit = {azimuth, elevation};
                const struct rhw_camera camera = rhw_camera_fit(&t.model, orbit, 0.6, aspect);
                double m[16], view[16], widest = 0.0, nearest = INFINITY, furthest = 0.0;
                view_projection(&camera, aspect, m);
                rhw_camera_view(&camera, view);
                for (int v = 0; v < 4; v++) {
                    const double p[3] = {(double)t.positions[v][0] + 1000.0, 2.0 * (double)t.positions[v][1],
                                         (double)t.positions[v][2]};
                    double ndc[3];
                    project(m, p, ndc);
                    widest = fmax(widest, fmax(fabs(ndc[0]), fabs(ndc[1])));
                    assert_true(ndc[2] > 0.0 && ndc[2] < 1.0);
                    const double z = -(view[2] * p[0] + view[6] * p[1] + view[10] * p[2] + view[14]);
                    nearest = fmin(nearest, z);
                    furthest = fmax(furthest, z);
                }
                const double least = 0.2 * (furthest - nearest);
                assert_true(widest < 0.92 + 1e-9 && nearest > least - 1e-9);
                if (nearest > least + 1e-9) {
                    assert_close(widest, 0.92, 1e-9);
                }
            }
        }
    }
}

static void test_fit_angles(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    const double cases[][5] = {
        {0, 0, 0, 0, 1},    {90, 0, 1, 0, 0},
        {180, 0, 0, 0, -1}, {-90, 0, -1, 0, 0},
        {0, 90, 0, 1, 0},   {30, 20, 0.469846310392954, 0.342020143325669, 0.813797681349374}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct rhw_orbit orbit = {cases[i][0], cases[i][1]};
        const struct rhw_camera camera = rhw_camera_fit(&t.model, orbit, 0.5, 1.0);
        double back[3], length = 0.0;
        for (int c = 0; c < 3; c++) {
            back[c] = camera.eye[c] - camera.target[c];
            length += back[c] * back[c];
        }
        for (int c = 0; c < 3; c++) {
            assert_close(back[c] / sqrt(length), cases[i][2 + c], 1e-12);
        }
    }
}

// A point, a line seen end on and nothing at all still give a camera that can draw.
static void test_fit_of_degenerate_models(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    for (int what = 0; what < 3; what++) {
        for (int v = 0; v < 4; v++) {
            t.positions[v][0] = t.positions[v][1] = what == 2 ? 1e6f : 0.0f;
            t.positions[v][2] = what == 1 ? (float)v : 0.0f;
        }
        set_bounds(&t);
        struct rhw_view view = tiny_view(&t, 8);
        view.camera = rhw_camera_fit(&t.model, (struct rhw_orbit){0, 0}, 0.5, 1.0);
        char error[200];
        assert_true(rhw_view_check(&view, error, sizeof error));
        assert_true(view.camera.eye[2] > (double)t.positions[3][2]);
    }
    t.model.instance_count = 0;
    const struct rhw_camera camera = rhw_camera_fit(&t.model, (struct rhw_orbit){0, 0}, 0.5, 1.0);
    assert_true(camera.znear > 0.0 && camera.zfar > camera.znear);
}

static void test_default_orbit_faces_flat_models(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    assert_close(rhw_camera_default_orbit(&t.model).azimuth, 0.0, 0.0);
    assert_close(rhw_camera_default_orbit(&t.model).elevation, 0.0, 0.0);
    t.indices[1] = 2;
    t.indices[2] = 1;
    t.indices[4] = 3;
    t.indices[5] = 2;
    assert_close(rhw_camera_default_orbit(&t.model).azimuth, 180.0, 0.0);
}

static void test_look_refuses_what_is_no_camera(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    struct rhw_camera camera;
    char error[200];
    const double eye[3] = {1, 2, 3}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0}, zero[3] = {0, 0, 0};
    const double bad[3] = {0, NAN, 0};
    assert_true(rhw_camera_look(&camera, &t.model, eye, target, up, 0.7, error, sizeof error));
    assert_false(rhw_camera_look(&camera, &t.model, eye, eye, up, 0.7, error, sizeof error));
    assert_false(rhw_camera_look(&camera, &t.model, eye, target, zero, 0.7, error, sizeof error));
    assert_false(rhw_camera_look(&camera, &t.model, bad, target, up, 0.7, error, sizeof error));
    assert_false(rhw_camera_look(&camera, &t.model, eye, target, up, 0.0, error, sizeof error));
    assert_false(rhw_camera_look(&camera, &t.model, eye, target, up, pi, error, sizeof error));
    assert_non_null(strstr(error, "179 degrees"));
    // Looking along `up` is allowed: the rows of the view matrix are still perpendicular and of length 1.
    assert_true(rhw_camera_look(&camera, &t.model, eye, target, eye, 0.7, error, sizeof error));
    double m[16];
    rhw_camera_view(&camera, m);
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            const double product = m[a] * m[b] + m[4 + a] * m[4 + b] + m[8 + a] * m[8 + b];
            assert_close(product, a == b, 1e-12);
        }
    }
}

static void test_projection_against_formulas(void **state)
{
    (void)state;
    struct rhw_camera camera = {.eye = {0, 0, 10}, .up = {0, 1, 0}, .yfov = 1.1, .znear = 2.0, .zfar = 50.0};
    double m[16], ndc[3];
    view_projection(&camera, 1.5, m);
    const double near_top[3] = {2.0 * tan(0.55) * 1.5, 2.0 * tan(0.55), 8.0}, far_middle[3] = {0, 0, -40};
    project(m, near_top, ndc);
    assert_close(ndc[0], 1.0, 1e-12);
    assert_close(ndc[1], 1.0, 1e-12);
    assert_close(ndc[2], 0.0, 1e-12);
    project(m, far_middle, ndc);
    assert_close(ndc[2], 1.0, 1e-12);
    camera.zfar = 0.0;
    view_projection(&camera, 1.5, m);
    const double very_far[3] = {0, 0, -1e12};
    project(m, very_far, ndc);
    assert_close(ndc[2], 1.0, 1e-11);
}

// A camera whose frame is wider than the picture keeps its width.
static void test_file_camera_in_a_narrow_picture(void **state)
{
    (void)state;
    struct rhw_model_camera source = {.yfov = 0.8f, .aspect = 2.0f, .znear = 0.1f, .zfar = 100.0f};
    identity(source.world);
    for (double aspect = 0.01; aspect < 2.0; aspect *= 1.7) {
        const struct rhw_camera camera = rhw_camera_from_model(&source, aspect);
        assert_close(tan(camera.yfov / 2.0) * aspect, tan((double)source.yfov / 2.0) * 2.0, 1e-9);
    }
    assert_close(rhw_camera_from_model(&source, 3.0).yfov, (double)source.yfov, 0.0);
    source.orthographic = true;
    source.xmag = 3.0f;
    source.ymag = 1.0f;
    assert_close(rhw_camera_from_model(&source, 1.0).ymag, 3.0, 0.0);
    assert_close(rhw_camera_from_model(&source, 6.0).ymag, 1.0, 0.0);
}

// A normal stays perpendicular to what lies in the surface, and on its outer side, under any matrix.
static void test_normal_matrix(void **state)
{
    (void)state;
    const double matrices[3][16] = {{2, 0, 0, 0, 0, 5, 0, 0, 0, 0, 0.1, 0, 3, 4, 5, 1},
                                    {1, 2, 3, 0, -4, 1, 0.5, 0, 0.2, 0.3, 7, 0, 0, 0, 0, 1},
                                    {-1, 0, 0, 0, 0, 3, 1, 0, 0, 0, 2, 0, 0, 0, 0, 1}};
    const double tangents[2][3] = {{1, 2, -1}, {0, 1, 3}}, normal[3] = {7, -3, 1}; // perpendicular to both
    for (int k = 0; k < 3; k++) {
        const double *m = matrices[k];
        double n[9], turned[3], outward = 0.0;
        rhw_matrix_normal(m, n);
        for (int r = 0; r < 3; r++) {
            turned[r] = n[r] * normal[0] + n[3 + r] * normal[1] + n[6 + r] * normal[2];
            outward += turned[r] * (m[r] * normal[0] + m[4 + r] * normal[1] + m[8 + r] * normal[2]);
        }
        for (int t = 0; t < 2; t++) {
            double product = 0.0;
            for (int r = 0; r < 3; r++) {
                product += turned[r] *
                           (m[r] * tangents[t][0] + m[4 + r] * tangents[t][1] + m[8 + r] * tangents[t][2]);
            }
            assert_close(product, 0.0, 1e-9);
        }
        assert_true(outward > 0.0);
    }
}

// Order ---------------------------------------------------------------------------------------------

static void test_order_of_drawing(void **state)
{
    (void)state;
    struct rhw_surface_item items[] = {{0, true, 1.0}, {1, false, 9.0}, {2, true, 5.0},  {3, false, 2.0},
                                       {4, true, 5.0}, {5, false, 2.0}, {6, false, -1.0}};
    const uint32_t expected[] = {6, 3, 5, 1, 2, 4, 0};
    rhw_surface_items_sort(items, 7);
    for (int i = 0; i < 7; i++) {
        assert_int_equal(items[i].instance, expected[i]);
    }
}

// Formulas ------------------------------------------------------------------------------------------

static void normalize3(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int c = 0; c < 3; c++) {
        v[c] /= length;
    }
}

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// glTF 2.0, appendix B.3, as it stands there: the half vector made, every term by itself.
static double brdf(const double n[3], const double v[3], const double l[3], double base, double metallic,
                   double roughness)
{
    double h[3] = {l[0] + v[0], l[1] + v[1], l[2] + v[2]};
    normalize3(h);
    const double a2 = pow(roughness, 4.0), nl = fmax(dot3(n, l), 0.0), nv = dot3(n, v), nh = dot3(n, h);
    const double d = a2 / (pi * pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
    const double g =
        2.0 * nl / (nl + sqrt(a2 + (1.0 - a2) * nl * nl)) * 2.0 * nv / (nv + sqrt(a2 + (1.0 - a2) * nv * nv));
    const double f0 = 0.04 * (1.0 - metallic) + base * metallic;
    const double f = f0 + (1.0 - f0) * pow(1.0 - dot3(v, h), 5.0);
    return nl <= 0.0 ? 0.0 : nl * ((1.0 - f) * base * (1.0 - metallic) / pi + f * d * g / (4.0 * nl * nv));
}

static void test_reflection_against_gltf_appendix_b(void **state)
{
    (void)state;
    const double lights[][3] = {
        {0, 0, 1}, {1, 0.2, 0.7}, {-0.9, 0.1, 0.2}, {0.1, -0.3, 0.95}, {0.2, 0.1, -1}};
    const double views[][3] = {{0, 0, 1}, {-1, -0.2, 0.7}, {0.3, 0.8, 0.1}};
    const double materials[][3] = {{0.8, 0.0, 0.5}, {0.8, 1.0, 0.3}, {0.2, 0.5, 1.0}, {0.9, 1.0, 0.05}};
    const double normal[3] = {0, 0, 1};
    for (size_t i = 0; i < 5 * 3 * 4; i++) {
        double l[3], v[3];
        memcpy(l, lights[i % 5], sizeof l);
        memcpy(v, views[i / 5 % 3], sizeof v);
        normalize3(l);
        normalize3(v);
        const double *m = materials[i / 15];
        struct rhw_reflector reflector;
        rhw_float base[3], to_light[3], irradiance[3], sum[3];
        for (int c = 0; c < 3; c++) {
            reflector.normal[c] = rhw_splat((float)normal[c]);
            reflector.view[c] = rhw_splat((float)v[c]);
            to_light[c] = rhw_splat((float)l[c]);
            base[c] = rhw_splat((float)m[0]);
            irradiance[c] = rhw_splat((float)(c + 1));
            sum[c] = rhw_splat((float)c);
        }
        rhw_reflector_set(&reflector, base, rhw_splat((float)m[1]), rhw_splat((float)m[2]));
        rhw_reflect_light(&reflector, to_light, irradiance, 0.0f, sum);
        const double expected = brdf(normal, v, l, m[0], m[1], m[2]);
        for (int c = 0; c < 3; c++) {
            // The peak of a mirror is 1 / α⁴ high: there 1 − (n·h)² has few of its bits left.
            const double tolerance = m[2] < 0.1 ? 1e-2 : 1e-4;
            assert_close((double)sum[c][3], c + (c + 1) * expected, 1e-5 + tolerance * (c + 1) * expected);
        }
    }
}

// The published code of Khronos PBR Neutral, in double.
static void neutral(double c[3])
{
    const double start = 0.8 - 0.04, desaturation = 0.15;
    const double x = fmin(c[0], fmin(c[1], c[2]));
    const double offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    for (int i = 0; i < 3; i++) {
        c[i] -= offset;
    }
    const double peak = fmax(c[0], fmax(c[1], c[2]));
    if (peak < start) {
        return;
    }
    const double d = 1.0 - start, new_peak = 1.0 - d * d / (peak + d - start);
    const double g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    for (int i = 0; i < 3; i++) {
        c[i] = c[i] * new_peak / peak * (1.0 - g) + new_peak * g;
    }
}

static void test_tone_map_against_its_definition(void **state)
{
    (void)state;
    const double values[] = {0.0, 0.01, 0.05, 0.08, 0.2, 0.5, 0.76, 0.8, 0.81, 1.0, 2.0, 30.0, 1e4};
    for (size_t i = 0; i < 13 * 13 * 13; i++) {
        double expected[3] = {values[i % 13], values[i / 13 % 13], values[i / 169]};
        rhw_float color[3];
        for (int c = 0; c < 3; c++) {
            color[c] = rhw_splat(0.25f); // other lanes: dark
            color[c][5] = (float)expected[c];
        }
        neutral(expected);
        rhw_tone_map(color);
        for (int c = 0; c < 3; c++) {
            assert_close((double)color[c][5], expected[c], 3e-6);
            assert_close((double)color[c][0], 0.21, 1e-7);
        }
    }
}

// Radiance of the surroundings' soft boxes in one direction.
static double lobes_at(const struct rhw_environment *e, const double d[3])
{
    double sum = 0.0;
    for (int i = 0; i < RHW_LOBES; i++) {
        const double axis[3] = {(double)e->lobe_direction[i][0], (double)e->lobe_direction[i][1],
                                (double)e->lobe_direction[i][2]};
        sum += (double)e->lobe_color[i][0] * exp((double)e->sharpness * (dot3(axis, d) - 1.0));
    }
    return sum;
}

// The closed form of the diffuse light of the soft boxes against a sum over the sphere. Order 2 of the
// harmonics is all there is to a cosine lobe but a few percent.
static void test_environment_irradiance(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    struct rhw_lighting lighting;
    const struct rhw_view view = tiny_view(&t, 8);
    assert_true(rhw_lighting_create(&lighting, &t.model, &view.camera, false, 0.0));
    struct rhw_environment e = lighting.environment;
    for (int c = 0; c < 3; c++) {
        e.sky[c] = e.ground[c] = 0.0f;
    }
    const double normals[][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {-1, 1, 1}, {0, -1, 0}};
    for (int k = 0; k < 5; k++) {
        double n[3] = {normals[k][0], normals[k][1], normals[k][2]}, sum = 0.0;
        normalize3(n);
        const int rows = 200, columns = 400;
        for (int i = 0; i < rows * columns; i++) {
            const double z = 1.0 - 2.0 * (i / columns + 0.5) / rows, phi = 2.0 * pi * (i % columns) / columns;
            const double d[3] = {sqrt(1.0 - z * z) * cos(phi), sqrt(1.0 - z * z) * sin(phi), z};
            sum += fmax(dot3(n, d), 0.0) * lobes_at(&e, d) * 4.0 * pi / (rows * columns);
        }
        rhw_float normal[3], irradiance[3];
        for (int c = 0; c < 3; c++) {
            normal[c] = rhw_splat((float)n[c]);
        }
        rhw_environment_diffuse(&e, normal, irradiance);
        assert_close((double)irradiance[0][2], sum / pi, 0.03);
    }
    rhw_lighting_destroy(&lighting);
}

// A mirror shows the soft boxes themselves; a rough surface shows less contrast.
static void test_environment_reflection(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    struct rhw_lighting lighting;
    const struct rhw_view view = tiny_view(&t, 8);
    assert_true(rhw_lighting_create(&lighting, &t.model, &view.camera, false, 1.0));
    const struct rhw_environment *e = &lighting.environment;
    rhw_float direction[3], sharp[3], rough[3];
    const double axis[3] = {(double)e->lobe_direction[0][0], (double)e->lobe_direction[0][1],
                            (double)e->lobe_direction[0][2]};
    for (int c = 0; c < 3; c++) {
        direction[c] = rhw_splat((float)axis[c]);
    }
    rhw_environment_reflection(e, direction, rhw_splat(0.0f), sharp);
    rhw_environment_reflection(e, direction, rhw_splat(1.0f), rough);
    const double height = axis[1];
    const double above = 0.5 + 0.5 * height / sqrt(height * height + 0.03);
    const double sky = (double)e->ground[0] + (double)(e->sky[0] - e->ground[0]) * above;
    assert_close((double)sharp[0][7], sky + lobes_at(e, axis), 1e-4);
    assert_true(rough[0][7] < 0.5f * sharp[0][7]);
    rhw_lighting_destroy(&lighting);
}

// A file's light, whatever its unit's size, lights a white surface in the middle to about white.
static void test_exposure_follows_the_lights(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.light = (struct rhw_model_light){.type = RHW_LIGHT_POINT, .position = {0, 0, 10}, .color = {1, 1, 1}};
    t.model.light_count = 1;
    const struct rhw_view view = tiny_view(&t, 8);
    for (float intensity = 0.01f; intensity < 1e7f; intensity *= 100.0f) {
        t.light.intensity = intensity;
        struct rhw_lighting lighting;
        assert_true(rhw_lighting_create(&lighting, &t.model, &view.camera, false, 0.0));
        const rhw_float middle[3] = {rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f)};
        rhw_float to_light[3], irradiance[3];
        rhw_light_at(&lighting.lights[0], middle, to_light, irradiance);
        assert_close((double)irradiance[1][0], 0.9 * pi, 1e-4);
        assert_close((double)to_light[2][0], 1.0, 1e-6);
        rhw_lighting_destroy(&lighting);
    }
}

// A spot light is whole inside its inner cone, gone outside the outer one, and ends at its range.
static void test_spot_and_range(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.light = (struct rhw_model_light){.type = RHW_LIGHT_SPOT,
                                       .position = {0, 0, 4},
                                       .direction = {0, 0, -1},
                                       .color = {1, 1, 1},
                                       .intensity = 5,
                                       .range = 8,
                                       .inner_cos = 0.95f,
                                       .outer_cos = 0.8f};
    t.model.light_count = 1;
    const struct rhw_view view = tiny_view(&t, 8);
    struct rhw_lighting lighting;
    assert_true(rhw_lighting_create(&lighting, &t.model, &view.camera, false, 0.0));
    const double scale = (double)lighting.lights[0].color[0];
    const double points[][3] = {{0, 0, 0}, {0.5, 0, 0}, {2.0, 0, 0}, {4, 0, 0}, {0, 0, -3.9}, {0, 0, -5}};
    for (int i = 0; i < 6; i++) {
        rhw_float p[3], to_light[3], irradiance[3];
        for (int c = 0; c < 3; c++) {
            p[c] = rhw_splat((float)points[i][c]);
        }
        rhw_light_at(&lighting.lights[0], p, to_light, irradiance);
        const double dx = points[i][0], dz = 4.0 - points[i][2], d2 = dx * dx + dz * dz;
        const double cone = fmin(fmax((dz / sqrt(d2) - 0.8) / (0.95 - 0.8), 0.0), 1.0);
        const double window = fmin(fmax(1.0 - pow(d2 / 64.0, 2.0), 0.0), 1.0);
        assert_close((double)irradiance[0][0], scale * cone * cone * window / d2, 1e-4 * scale);
    }
    rhw_lighting_destroy(&lighting);
}

// Pictures ------------------------------------------------------------------------------------------

static void test_unlit_square(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.material.base_color[0] = 1.0f;
    t.material.base_color[1] = 0.5f; // 188 in sRGB
    t.material.base_color[2] = 0.0f;
    const struct rhw_view view = tiny_view(&t, 8);
    struct rhw_pictures pictures = draw_model(&t.model, &view);
    for (int y = 0; y < 8; y++) {
        for (int x = 0; x < 8; x++) {
            const bool inside = x >= 2 && x < 6 && y >= 2 && y < 6;
            const uint8_t *pixel = &pictures.color[4 * (8 * y + x)];
            inside ? assert_pixel(pixel, 255, 188, 0, 255) : assert_pixel(pixel, 10, 200, 30, 255);
        }
    }
    rhw_pictures_free(&pictures);
}

// An edge through the middle of pixels is half square, half background, in linear light.
static void test_supersampling_averages_light(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    for (int side = 1; side <= 4; side++) {
        struct rhw_view view = tiny_view(&t, 8);
        memset(view.background_color, 0, 3);
        view.samples = side * side;
        view.camera.eye[0] = view.camera.target[0] = 0.25; // half a pixel to the left
        struct rhw_pictures pictures = draw_model(&t.model, &view);
        // Samples within the square of 4.5 − 4 = half a pixel: 1 of 1 or 0 (edges on a centre go by the rule).
        const double share = side == 1 ? 1.0 : side == 2 ? 0.5 : side == 3 ? 2.0 / 3.0 : 0.5;
        const double s = 1.055 * pow(share, 1.0 / 2.4) - 0.055;
        const uint8_t *row = &pictures.color[4 * 8 * 4];
        assert_close(row[4 * 1], 255.0 * s, 0.6);
        assert_close(row[4 * 3], 255.0, 0.0);
        const double other = side == 1 ? 0.0 : side == 3 ? 1.0 / 3.0 : 0.5;
        assert_close(row[4 * 5], other == 0.0 ? 0.0 : 255.0 * (1.055 * pow(other, 1.0 / 2.4) - 0.055), 0.6);
        rhw_pictures_free(&pictures);
    }
}

// Two glass panes: what is behind shows through what is before, whatever the order in the file.
static void test_blending_is_sorted(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.model.instance_count = 2;
    t.material.alpha_mode = RHW_ALPHA_BLEND;
    t.material.base_color[3] = 0.5f;
    // One mesh, so colour comes from the vertices of two meshes that share the rest.
    struct rhw_mesh meshes[2] = {t.mesh, t.mesh};
    float red[4][4], blue[4][4];
    for (int v = 0; v < 4; v++) {
        const float r[4] = {1, 0, 0, 1}, b[4] = {0, 0, 1, 1};
        memcpy(red[v], r, sizeof r);
        memcpy(blue[v], b, sizeof b);
    }
    meshes[0].colors = red;
    meshes[1].colors = blue;
    t.model.meshes = meshes;
    t.model.mesh_count = 2;
    t.instances[1].mesh = 1;
    struct rhw_view view = tiny_view(&t, 8);
    view.outputs |= RHW_OUTPUT_LINEAR;
    for (int nearer = 0; nearer < 2; nearer++) {
        t.instances[nearer].world[14] = 1.0f;
        t.instances[1 - nearer].world[14] = -1.0f;
        struct rhw_pictures pictures = draw_model(&t.model, &view);
        const uint8_t *pixel = &pictures.color[4 * (8 * 4 + 4)];
        const float *linear = &pictures.linear[4 * (8 * 4 + 4)];
        const double front = nearer == 0 ? 0.5 : 0.25;
        assert_close((double)linear[0], front, 1e-6);
        assert_close((double)linear[2], 0.75 - front, 1e-6);
        assert_close((double)linear[3], 0.75, 1e-6);
        assert_true(nearer == 0 ? pixel[0] > pixel[2] : pixel[2] > pixel[0]);
        rhw_pictures_free(&pictures);
    }
}

static void test_transparent_background_keeps_color_straight(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.material.alpha_mode = RHW_ALPHA_BLEND;
    t.material.base_color[1] = 0.5f;
    t.material.base_color[3] = 0.125f;
    struct rhw_view view = tiny_view(&t, 8);
    view.background = RHW_BACKGROUND_TRANSPARENT;
    for (int samples = 1; samples <= 4; samples += 3) {
        view.samples = samples;
        struct rhw_pictures pictures = draw_model(&t.model, &view);
        assert_pixel(&pictures.color[4 * (8 * 4 + 4)], 255, 188, 255, 32);
        assert_pixel(&pictures.color[0], 0, 0, 0, 0);
        rhw_pictures_free(&pictures);
    }
}

// A 2×2 image on the square: its texels in place, also under a transform, masked by alpha.
static void test_texture_transform_and_mask(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    static const uint8_t texels[4][4] = {
        {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {9, 9, 9, 100}};
    memcpy(t.texels, texels, sizeof texels);
    struct rhw_texture_slot *slot = &t.material.slots[RHW_SLOT_BASE_COLOR];
    slot->image = 0;
    slot->mip_filter = RHW_MIP_FILTER_NONE;
    slot->min_filter = slot->mag_filter = RHW_FILTER_NEAREST;
    t.material.alpha_mode = RHW_ALPHA_MASK;
    const struct rhw_view view = tiny_view(&t, 8);
    struct rhw_pictures pictures = draw_model(&t.model, &view);
    assert_pixel(&pictures.color[4 * (8 * 2 + 2)], 255, 0, 0, 255);
    assert_pixel(&pictures.color[4 * (8 * 2 + 5)], 0, 255, 0, 255);
    assert_pixel(&pictures.color[4 * (8 * 5 + 2)], 0, 0, 255, 255);
    assert_pixel(&pictures.color[4 * (8 * 5 + 5)], 10, 200, 30, 255); // alpha 100 is below the cutoff
    rhw_pictures_free(&pictures);
    const float turned[6] = {0, 1, 0, 1, 0, 0}; // u and v change places
    memcpy(slot->transform, turned, sizeof turned);
    pictures = draw_model(&t.model, &view);
    assert_pixel(&pictures.color[4 * (8 * 2 + 5)], 0, 0, 255, 255);
    assert_pixel(&pictures.color[4 * (8 * 5 + 2)], 0, 255, 0, 255);
    rhw_pictures_free(&pictures);
}

// One-sided surfaces vanish from behind, also when a mirroring matrix turns their winding.
static void test_culling_and_mirroring(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    for (int flags = 0; flags < 8; flags++) {
        const bool behind = flags & 1, mirrored = flags & 2;
        t.material.double_sided = flags & 4;
        t.instances[0].world[0] = mirrored ? -1.0f : 1.0f;
        t.instances[0].mirrored = mirrored;
        struct rhw_view view = tiny_view(&t, 8);
        view.camera.eye[2] = behind ? -5.0 : 5.0;
        struct rhw_pictures pictures = draw_model(&t.model, &view);
        const bool visible = !behind || t.material.double_sided;
        const uint8_t *pixel = &pictures.color[4 * (8 * 4 + 4)];
        visible ? assert_pixel(pixel, 255, 255, 255, 255) : assert_pixel(pixel, 10, 200, 30, 255);
        rhw_pictures_free(&pictures);
    }
}

// Every data output at a pixel whose answer follows from the geometry alone.
static void test_data_outputs(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.material.double_sided = true;
    t.model.instance_count = 2;
    t.instances[1].world[12] = 40.0f; // out of view, but it counts triangles before nothing
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct rhw_view view = tiny_view(&t, 8);
        view.outputs = RHW_OUTPUT_ALL & ~(RHW_OUTPUT_COLOR | RHW_OUTPUT_LINEAR);
        view.samples = 4;          // has no say in data
        view.camera.eye[2] = -5.0; // from behind
        if (!orthographic) {
            view.camera.orthographic = false;
            view.camera.yfov = 2.0 * atan(2.0 / 5.0);
        }
        struct rhw_pictures p = draw_model(&t.model, &view);
        assert_null(p.color);
        const int i = 8 * 3 + 2; // the camera's right is −x: pixel centre (1.5/2, 0.25)
        assert_close((double)p.position[4 * i], 0.75, 1e-6);
        assert_close((double)p.position[4 * i + 1], 0.25, 1e-6);
        assert_close((double)p.position[4 * i + 2], 0.0, 1e-6);
        assert_close((double)p.uv[4 * i], 0.875, 1e-6);
        assert_close((double)p.uv[4 * i + 1], 0.375, 1e-6);
        assert_close((double)p.distance[i], 5.0, 1e-5);
        // d = f (z − n) / (z (f − n)) with n 1, f 9, z 5; orthographic (z − n) / (f − n).
        assert_close((double)p.depth[i], orthographic ? 0.5 : 0.9, 1e-6);
        assert_close((double)p.normal[4 * i + 2], -1.0, 1e-6); // turned to the viewer
        assert_int_equal(p.object[i], 1);
        assert_int_equal(p.triangle[i], 1); // x > y: below the diagonal
        assert_int_equal(p.triangle[8 * 2 + 4], 2);
        // Weights of (−1,−1), (1,−1), (1,1) at (0.75, 0.25).
        assert_close((double)p.barycentric[4 * i], 0.125, 1e-6);
        assert_close((double)p.barycentric[4 * i + 1], 0.25, 1e-6);
        assert_close((double)p.barycentric[4 * i + 2], 0.625, 1e-6);
        assert_close((double)p.barycentric[4 * i + 3], 1.0, 0.0);
        assert_true(isinf(p.distance[0]) && p.depth[0] == 1.0f && p.object[0] == 0 && p.triangle[0] == 0);
        assert_true(p.normal[2] == 0.0f && p.position[3] == 0.0f && p.uv[3] == 0.0f);
        rhw_pictures_free(&p);
    }
}

// A flat normal map with its tangents changes nothing; a leaning one leans the normal towards the tangent,
// in a mirrored instance towards the mirrored one.
static void test_normal_map(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.material.unlit = false;
    t.material.slots[RHW_SLOT_NORMAL].image = 0;
    t.mesh.tangents = t.tangents;
    for (int k = 0; k < 4; k++) {
        const uint8_t lean[4] = {218, 182, 218, 255}; // 2 c / 255 − 1: 0.7098, 0.4275, 0.7098
        memcpy(t.texels[k], lean, sizeof lean);
    }
    struct rhw_view view = tiny_view(&t, 8);
    view.outputs = RHW_OUTPUT_NORMAL;
    const double length = sqrt(2.0 * 0.70980392 * 0.70980392 + 0.42745098 * 0.42745098);
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        t.instances[0].world[0] = mirrored ? -1.0f : 1.0f;
        t.instances[0].mirrored = mirrored;
        struct rhw_pictures p = draw_model(&t.model, &view);
        const float *n = &p.normal[4 * (8 * 4 + 4)];
        assert_close((double)n[0], (mirrored ? -1.0 : 1.0) * 0.70980392 / length, 1e-5);
        assert_close((double)n[1], 0.42745098 / length, 1e-5); // the bitangent is not mirrored in x
        assert_close((double)n[2], 0.70980392 / length, 1e-5);
        rhw_pictures_free(&p);
    }
}

// Lines are 1.5 pixels wide, points discs of 4.5, wherever they are.
static void test_lines_and_points(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    uint32_t ends[2] = {0, 1};
    t.mesh.normals = NULL;
    t.mesh.indices = ends;
    t.positions[0][0] = -1.0f;
    t.positions[0][1] = 0.0f;
    t.positions[1][0] = 1.0f;
    t.positions[1][1] = 0.0f;
    set_bounds(&t);
    t.mesh.index_count = 2;
    t.mesh.primitive = RHW_PRIMITIVE_LINES;
    const struct rhw_view view = tiny_view(&t, 64);
    for (int points = 0; points < 2; points++) {
        t.mesh.primitive = points ? RHW_PRIMITIVE_POINTS : RHW_PRIMITIVE_LINES;
        struct rhw_pictures p = draw_model(&t.model, &view);
        int lit = 0, middle = 0;
        for (int i = 0; i < 64 * 64; i++) {
            const bool white = p.color[4 * i] == 255;
            lit += white;
            middle += white && i % 64 == 32;
        }
        if (points) {
            assert_int_equal(lit, 2 * 16); // centres within 2.25 of a pixel corner
            assert_int_equal(middle, 0);
        } else {
            assert_int_equal(middle, 2); // rows at ±0.5 from the line
            assert_int_equal(lit, 2 * (32 + 2));
        }
        rhw_pictures_free(&p);
    }
}

// A line that begins before the camera and ends behind it leaves the picture on the side it heads for.
static void test_line_through_the_near_plane(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    uint32_t ends[2] = {0, 1};
    t.mesh.normals = NULL;
    t.mesh.primitive = RHW_PRIMITIVE_LINES;
    t.mesh.indices = ends;
    t.mesh.index_count = 2;
    memset(t.positions[0], 0, sizeof t.positions[0]);
    t.positions[1][0] = 2.0f;
    t.positions[1][1] = 0.0f;
    t.positions[1][2] = 20.0f;
    set_bounds(&t);
    struct rhw_view view = tiny_view(&t, 64);
    view.camera =
        (struct rhw_camera){.eye = {0, 0, 5}, .up = {0, 1, 0}, .yfov = 1.0, .znear = 0.1, .zfar = 50.0};
    for (int swapped = 0; swapped < 2; swapped++) {
        ends[0] = (uint32_t)swapped;
        ends[1] = (uint32_t)(1 - swapped);
        struct rhw_pictures p = draw_model(&t.model, &view);
        for (int x = 0; x < 64; x++) {
            const bool white = p.color[4 * (64 * 32 + x)] == 255;
            assert_true(white == (x >= 31)); // the end's cap reaches 0.75 to the left of the middle
            assert_true(p.color[4 * (64 * 20 + x)] != 255);
        }
        rhw_pictures_free(&p);
    }
}

static void test_wireframe_marks_edges(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    struct rhw_view view = tiny_view(&t, 64);
    view.wireframe = RHW_WIREFRAME_PLAIN;
    struct rhw_pictures p = draw_model(&t.model, &view);
    const uint8_t *edge = &p.color[4 * (64 * 40 + 16)], *inside = &p.color[4 * (64 * 26 + 22)];
    const uint8_t *diagonal = &p.color[4 * (64 * 31 + 32)];
    assert_pixel(inside, 226, 226, 226, 255);
    assert_true(edge[0] < 170);
    assert_true(diagonal[0] < 60);
    rhw_pictures_free(&p);
}

// The same bytes for one thread and baseline as for many and the best.
static void test_pictures_do_not_depend_on_the_machine(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    t.material.unlit = false;
    t.material.metallic = 0.4f;
    t.material.roughness = 0.3f;
    struct rhw_view view = tiny_view(&t, 200);
    view.camera = rhw_camera_fit(&t.model, (struct rhw_orbit){35, 15}, 0.6, 1.0);
    view.background = RHW_BACKGROUND_DEFAULT;
    view.samples = 4;
    struct rhw_pictures first = draw_model(&t.model, &view);
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (!rhw_isa_supported((enum rhw_isa)isa)) {
            continue;
        }
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = isa + 1;
        def.isa = (enum rhw_isa)isa;
        rhw_context *context;
        struct rhw_scene *scene;
        struct rhw_pictures again;
        assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
        assert_int_equal(rhw_scene_create(context, &t.model, &scene), RHW_OK);
        for (int repeat = 0; repeat < 2; repeat++) {
            assert_int_equal(rhw_scene_draw(scene, &view, &again, NULL), RHW_OK);
            assert_memory_equal(first.color, again.color, 200 * 200 * 4);
            rhw_pictures_free(&again);
        }
        rhw_scene_destroy(scene);
        rhw_context_destroy(context);
    }
    rhw_pictures_free(&first);
}

static void test_view_rules(void **state)
{
    (void)state;
    struct tiny t;
    make_tiny(&t);
    char error[200];
    const struct rhw_view good = tiny_view(&t, 64);
    assert_true(rhw_view_check(&good, error, sizeof error));
    struct rhw_view view = good;
    view.samples = 8;
    assert_false(rhw_view_check(&view, error, sizeof error));
    assert_non_null(strstr(error, "1, 4, 9 or 16"));
    view.samples = 16;
    view.width = 4097;
    assert_false(rhw_view_check(&view, error, sizeof error));
    assert_non_null(strstr(error, "16384"));
    view.width = 4096;
    assert_true(rhw_view_check(&view, error, sizeof error));
    view.width = 0;
    assert_false(rhw_view_check(&view, error, sizeof error));
    view = good;
    view.outputs = 0;
    assert_false(rhw_view_check(&view, error, sizeof error));
    view = good;
    view.exposure = NAN;
    assert_false(rhw_view_check(&view, error, sizeof error));
    view = good;
    view.camera.zfar = view.camera.znear;
    assert_false(rhw_view_check(&view, error, sizeof error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fit_touches_the_margin),
        cmocka_unit_test(test_fit_angles),
        cmocka_unit_test(test_fit_of_degenerate_models),
        cmocka_unit_test(test_default_orbit_faces_flat_models),
        cmocka_unit_test(test_look_refuses_what_is_no_camera),
        cmocka_unit_test(test_projection_against_formulas),
        cmocka_unit_test(test_file_camera_in_a_narrow_picture),
        cmocka_unit_test(test_normal_matrix),
        cmocka_unit_test(test_order_of_drawing),
        cmocka_unit_test(test_reflection_against_gltf_appendix_b),
        cmocka_unit_test(test_tone_map_against_its_definition),
        cmocka_unit_test(test_environment_irradiance),
        cmocka_unit_test(test_environment_reflection),
        cmocka_unit_test(test_exposure_follows_the_lights),
        cmocka_unit_test(test_spot_and_range),
        cmocka_unit_test(test_unlit_square),
        cmocka_unit_test(test_supersampling_averages_light),
        cmocka_unit_test(test_blending_is_sorted),
        cmocka_unit_test(test_transparent_background_keeps_color_straight),
        cmocka_unit_test(test_texture_transform_and_mask),
        cmocka_unit_test(test_culling_and_mirroring),
        cmocka_unit_test(test_data_outputs),
        cmocka_unit_test(test_normal_map),
        cmocka_unit_test(test_lines_and_points),
        cmocka_unit_test(test_line_through_the_near_plane),
        cmocka_unit_test(test_wireframe_marks_edges),
        cmocka_unit_test(test_pictures_do_not_depend_on_the_machine),
        cmocka_unit_test(test_view_rules),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
