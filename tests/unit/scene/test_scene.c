// SPDX-License-Identifier: MIT
// The order of drawing, and small models whose pixels are known.
#include "patience.h"
#include "tiny_model.h"

#include <math.h>
#include <string.h>

#include "draw/explain_sample.h"
#include "draw/surface.h"
#include "draw/upload_image.h"

static struct scene_pictures draw_model(const struct scene_model *model, const struct scene_view *view)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    rhw_context *context;
    struct scene *scene;
    struct scene_pictures pictures;
    char error[200];
    assert_true(scene_view_check(view, error, sizeof error));
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    assert_int_equal(scene_create(context, model, &scene), RHW_OK);
    assert_int_equal(scene_draw(scene, view, &pictures, NULL), RHW_OK);
    scene_destroy(scene);
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

// Order ---------------------------------------------------------------------------------------------

static void test_order_of_drawing(void **state)
{
    (void)state;
    struct scene_surface_item items[] = {{0, true, 1.0}, {1, false, 9.0}, {2, true, 5.0},  {3, false, 2.0},
                                         {4, true, 5.0}, {5, false, 2.0}, {6, false, -1.0}};
    const uint32_t expected[] = {6, 3, 5, 1, 2, 4, 0};
    scene_surface_items_sort(items, 7);
    for (int i = 0; i < 7; i++) {
        assert_int_equal(items[i].instance, expected[i]);
    }
}

// Pictures ------------------------------------------------------------------------------------------

static void test_unlit_square(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.material.base_color[0] = 1.0f;
    t.material.base_color[1] = 0.5f; // 188 in sRGB
    t.material.base_color[2] = 0.0f;
    const struct scene_view view = tiny_view(&t, 8);
    struct scene_pictures pictures = draw_model(&t.model, &view);
    for (int y = 0; y < 8; y++) {
        for (int x = 0; x < 8; x++) {
            const bool inside = x >= 2 && x < 6 && y >= 2 && y < 6;
            const uint8_t *pixel = &pictures.color[4 * (8 * y + x)];
            inside ? assert_pixel(pixel, 255, 188, 0, 255) : assert_pixel(pixel, 10, 200, 30, 255);
        }
    }
    scene_pictures_free(&pictures);
}

// An edge through the middle of pixels is half square, half background, in linear light.
static void test_supersampling_averages_light(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    for (int side = 1; side <= 4; side++) {
        struct scene_view view = tiny_view(&t, 8);
        memset(view.background_color, 0, 3);
        view.supersample = side * side;
        view.camera.eye[0] = view.camera.target[0] = 0.25; // half a pixel to the left
        struct scene_pictures pictures = draw_model(&t.model, &view);
        // Samples within the square of 4.5 − 4 = half a pixel: 1 of 1 or 0 (edges on a centre go by the rule).
        const double share = side == 1 ? 1.0 : side == 2 ? 0.5 : side == 3 ? 2.0 / 3.0 : 0.5;
        const double s = 1.055 * pow(share, 1.0 / 2.4) - 0.055;
        const uint8_t *row = &pictures.color[4 * 8 * 4];
        tiny_assert_close(row[4 * 1], 255.0 * s, 0.6);
        tiny_assert_close(row[4 * 3], 255.0, 0.0);
        const double other = side == 1 ? 0.0 : side == 3 ? 1.0 / 3.0 : 0.5;
        tiny_assert_close(row[4 * 5], other == 0.0 ? 0.0 : 255.0 * (1.055 * pow(other, 1.0 / 2.4) - 0.055),
                          0.6);
        scene_pictures_free(&pictures);
    }
}

// Two glass panes: what is behind shows through what is before, whatever the order in the file.
static void test_blending_is_sorted(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.model.instance_count = 2;
    t.material.alpha_mode = SCENE_ALPHA_BLEND;
    t.material.base_color[3] = 0.5f;
    // One mesh, so colour comes from the vertices of two meshes that share the rest.
    struct scene_mesh meshes[2] = {t.mesh, t.mesh};
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
    struct scene_view view = tiny_view(&t, 8);
    view.outputs |= SCENE_OUTPUT_LINEAR;
    for (int nearer = 0; nearer < 2; nearer++) {
        t.instances[nearer].world[14] = 1.0f;
        t.instances[1 - nearer].world[14] = -1.0f;
        struct scene_pictures pictures = draw_model(&t.model, &view);
        const uint8_t *pixel = &pictures.color[4 * (8 * 4 + 4)];
        const float *linear = &pictures.linear[4 * (8 * 4 + 4)];
        const double front = nearer == 0 ? 0.5 : 0.25;
        tiny_assert_close((double)linear[0], front, 1e-6);
        tiny_assert_close((double)linear[2], 0.75 - front, 1e-6);
        tiny_assert_close((double)linear[3], 0.75, 1e-6);
        assert_true(nearer == 0 ? pixel[0] > pixel[2] : pixel[2] > pixel[0]);
        scene_pictures_free(&pictures);
    }
}

static void count_fragment(void *user, const struct rhw_explained_fragment *fragment,
                           const struct scene_drawn *drawn, int first_row)
{
    (void)fragment;
    (void)drawn;
    (void)first_row;
    (*(int *)user)++;
}

// Colours of each depth are what they are alone where both are wanted. The history of a sample is told once.
static void check_depths(const struct tiny *t, struct scene_view view)
{
    int told[4] = {0};
    struct scene_explain explain = {.x = 32, .y = 32, .fragment = count_fragment};
    view.explain = &explain;
    const uint32_t outputs[4] = {SCENE_OUTPUT_COLOR, SCENE_OUTPUT_DISPLAY, SCENE_OUTPUT_LINEAR,
                                 SCENE_OUTPUT_COLOR | SCENE_OUTPUT_DISPLAY | SCENE_OUTPUT_LINEAR};
    struct scene_pictures p[4];
    for (int i = 0; i < 4; i++) {
        explain.user = &told[i];
        view.outputs = outputs[i];
        p[i] = tiny_draw(t, &view);
        assert_int_equal(told[i], told[0]);
    }
    assert_true(told[0] > 0 || view.transparency == SCENE_TRANSPARENCY_EXACT);
    assert_memory_equal(p[3].color, p[0].color, 64 * 64 * 4);
    assert_memory_equal(p[3].display, p[1].display, 64 * 64 * 4 * sizeof(float));
    assert_memory_equal(p[3].linear, p[2].linear, 64 * 64 * 4 * sizeof(float));
    for (int i = 0; i < 4; i++) {
        scene_pictures_free(&p[i]);
    }
}

// The default background, which is dithered in colours of 8 bits, is behind a plain surface, behind layers of blended ones
// and behind glass.
static void test_colors_of_each_depth_stand_alone(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = tiny_view(&t, 64);
    view.background = SCENE_BACKGROUND_DEFAULT;
    view.camera.ymag = 4.0;
    check_depths(&t, view);
    t.material.alpha_mode = SCENE_ALPHA_BLEND;
    t.material.base_color[3] = 0.5f;
    view.transparency = SCENE_TRANSPARENCY_EXACT;
    view.samples = 4;
    check_depths(&t, view);
    view.transparency = SCENE_TRANSPARENCY_SORTED;
    t.material.alpha_mode = SCENE_ALPHA_OPAQUE;
    t.material.unlit = false;
    t.material.layers = (struct scene_layers){.used = true,
                                              .transmission = 1,
                                              .ior = 1,
                                              .attenuation_distance = INFINITY,
                                              .attenuation_color = {1, 1, 1}};
    check_depths(&t, view);
}

// The positions are those of the near picture, counted from a place a billion further along x, and nothing is where
// nothing is there.
static void check_far_positions(const struct scene_pictures *near, const struct scene_pictures *far)
{
    assert_true(fabs(far->origin[0] - 1e9) < 100.0);
    for (int i = 0; i < near->width * near->height; i++) {
        const float *const expected = &near->position[4 * i], *const got = &far->position[4 * i];
        const double x = expected[3] > 0.0f ? (double)expected[0] + 1e9 - far->origin[0] : 0.0;
        assert_true(fabs((double)got[0] - x) < 1e-6 && got[3] == expected[3]);
    }
}

// A square in a scattered model, a billion away from the origin, is drawn as one at the origin is, again and in another
// pose.
static void test_far_parts_in_each_pose(void **state)
{
    (void)state;
    struct tiny near, far;
    tiny_make(&near);
    tiny_make(&far);
    far.model.instance_count = 2;
    far.model.is_scattered = true;
    far.model.bounds_max[0] = 1e9f;
    near.instances[0].world[12] = 0.25f;
    far.instances[1].world[12] = 1e9f;
    far.instances[1].place[0] = 1e9 + 0.25;
    struct scene_view view = tiny_view(&near, 32);
    view.outputs = SCENE_OUTPUT_COLOR | SCENE_OUTPUT_POSITION;
    struct scene_view far_view = view;
    far_view.camera.eye[0] = far_view.camera.target[0] = 1e9;
    const struct rhw_context_def def = rhw_context_def_default();
    rhw_context *context;
    struct scene *scene;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    assert_int_equal(scene_create(context, &far.model, &scene), RHW_OK);
    for (int pose = 0; pose < 3; pose++) {
        near.instances[0].world[0] = far.instances[1].world[0] = 1.0f - 0.25f * (float)pose;
        assert_int_equal(scene_set_pose(scene, &far.model), RHW_OK);
        struct scene_pictures expected = tiny_draw(&near, &view), pictures;
        for (int repeat = 0; repeat < 2; repeat++) {
            assert_int_equal(scene_draw(scene, &far_view, &pictures, NULL), RHW_OK);
            assert_memory_equal(pictures.color, expected.color, 32 * 32 * 4);
            check_far_positions(&expected, &pictures);
            scene_pictures_free(&pictures);
        }
        scene_pictures_free(&expected);
    }
    scene_destroy(scene);
    rhw_context_destroy(context);
}

static void test_transparent_background_keeps_color_straight(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.material.alpha_mode = SCENE_ALPHA_BLEND;
    t.material.base_color[1] = 0.5f;
    t.material.base_color[3] = 0.125f;
    struct scene_view view = tiny_view(&t, 8);
    view.background = SCENE_BACKGROUND_TRANSPARENT;
    for (int samples = 1; samples <= 4; samples += 3) {
        view.supersample = samples;
        struct scene_pictures pictures = draw_model(&t.model, &view);
        assert_pixel(&pictures.color[4 * (8 * 4 + 4)], 255, 188, 255, 32);
        assert_pixel(&pictures.color[0], 0, 0, 0, 0);
        scene_pictures_free(&pictures);
    }
}

// A 2×2 image on the square: its texels in place, also under a transform, masked by alpha.
static void test_texture_transform_and_mask(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    static const uint8_t texels[4][4] = {
        {255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {9, 9, 9, 100}};
    memcpy(t.texels, texels, sizeof texels);
    struct scene_texture_slot *slot = &t.material.slots[SCENE_SLOT_BASE_COLOR];
    slot->image = 0;
    slot->mip_filter = RHW_MIP_FILTER_NONE;
    slot->min_filter = slot->mag_filter = RHW_FILTER_NEAREST;
    t.material.alpha_mode = SCENE_ALPHA_MASK;
    const struct scene_view view = tiny_view(&t, 8);
    struct scene_pictures pictures = draw_model(&t.model, &view);
    assert_pixel(&pictures.color[4 * (8 * 2 + 2)], 255, 0, 0, 255);
    assert_pixel(&pictures.color[4 * (8 * 2 + 5)], 0, 255, 0, 255);
    assert_pixel(&pictures.color[4 * (8 * 5 + 2)], 0, 0, 255, 255);
    assert_pixel(&pictures.color[4 * (8 * 5 + 5)], 10, 200, 30, 255); // alpha 100 is below the cutoff
    scene_pictures_free(&pictures);
    const float turned[6] = {0, 1, 0, 1, 0, 0}; // u and v change places
    memcpy(slot->transform, turned, sizeof turned);
    pictures = draw_model(&t.model, &view);
    assert_pixel(&pictures.color[4 * (8 * 2 + 5)], 0, 0, 255, 255);
    assert_pixel(&pictures.color[4 * (8 * 5 + 2)], 0, 255, 0, 255);
    scene_pictures_free(&pictures);
    // Outside of a decal, which is as large as the square's lower right quarter, its border shows.
    const struct scene_texture_slot decal = {.transform = {2, 0, -1, 0, 2, -1},
                                             .min_filter = RHW_FILTER_NEAREST,
                                             .mag_filter = RHW_FILTER_NEAREST,
                                             .mip_filter = RHW_MIP_FILTER_NONE,
                                             .address_u = RHW_ADDRESS_BORDER,
                                             .address_v = RHW_ADDRESS_BORDER,
                                             .border = {1, 0, 1, 1}};
    *slot = decal;
    pictures = draw_model(&t.model, &view);
    assert_pixel(&pictures.color[4 * (8 * 2 + 2)], 255, 0, 255, 255);
    assert_pixel(&pictures.color[4 * (8 * 4 + 3)], 255, 0, 255, 255);
    assert_pixel(&pictures.color[4 * (8 * 4 + 4)], 255, 0, 0, 255);
    scene_pictures_free(&pictures);
}

enum { SIDE = 8 };

struct images_of_noise {
    uint8_t texels[2][SIDE * SIDE][4];
    struct scene_image images[2];
};

// The square with images of occlusion and roughness that are alike but for their texels. It shows the middle of the images
// alone, where no address mode shows.
static void make_combined(struct tiny *t, struct images_of_noise *noise)
{
    tiny_make(t);
    for (uint32_t i = 0, random = 5; i < sizeof noise->texels; i++) {
        random = random * 1664525u + 1013904223u;
        noise->texels[i / sizeof *noise->texels][i / 4 % (SIDE * SIDE)][i % 4] = (uint8_t)(random >> 24);
    }
    for (int i = 0; i < 2; i++) {
        noise->images[i] = t->image;
        noise->images[i].width = noise->images[i].height = SIDE;
        noise->images[i].size = sizeof noise->texels[i];
        noise->images[i].texels = noise->texels[i];
    }
    t->model.images = noise->images;
    t->model.image_count = 2;
    t->material.unlit = false;
    const float transform[6] = {0.5f, 0, 0.25f, 0, 0.5f, 0.25f};
    for (int s = SCENE_SLOT_METALLIC_ROUGHNESS; s <= SCENE_SLOT_OCCLUSION; s += 2) {
        struct scene_texture_slot *const slot = &t->material.slots[s];
        slot->image = s == SCENE_SLOT_OCCLUSION;
        slot->mip_filter = RHW_MIP_FILTER_LINEAR;
        slot->min_filter = slot->mag_filter = RHW_FILTER_LINEAR;
        memcpy(slot->transform, transform, sizeof transform);
    }
}

// Occlusion and roughness in two images of one size at one place become one texture; what must not be combined, because
// it is read differently, gives the same picture where the difference does not matter.
static void test_occlusion_and_roughness_are_combined(void **state)
{
    (void)state;
    struct images_of_noise noise;
    struct tiny t;
    make_combined(&t, &noise);
    const struct scene_view view = tiny_view(&t, 32), far = tiny_view(&t, 5);
    assert_int_equal(scene_occlusion_of(&t.model, &t.material), SCENE_OCCLUSION_COMBINED);
    struct scene_pictures combined = draw_model(&t.model, &view), far_combined = draw_model(&t.model, &far);
    t.material.slots[SCENE_SLOT_OCCLUSION].address_u = RHW_ADDRESS_MIRROR;
    assert_int_equal(scene_occlusion_of(&t.model, &t.material), SCENE_OCCLUSION_APART);
    struct scene_pictures far_apart = draw_model(&t.model, &far);
    assert_memory_equal(far_combined.color, far_apart.color, 4 * 5 * 5);
    scene_pictures_free(&far_combined);
    scene_pictures_free(&far_apart);
    struct scene_pictures apart = draw_model(&t.model, &view);
    assert_memory_equal(combined.color, apart.color, 4 * 32 * 32);
    t.material.slots[SCENE_SLOT_OCCLUSION].image = -1;
    struct scene_pictures without = draw_model(&t.model, &view);
    assert_memory_not_equal(combined.color, without.color, 4 * 32 * 32);
    scene_pictures_free(&combined);
    scene_pictures_free(&apart);
    scene_pictures_free(&without);
    t.material.slots[SCENE_SLOT_OCCLUSION] = t.material.slots[SCENE_SLOT_METALLIC_ROUGHNESS];
    assert_int_equal(scene_occlusion_of(&t.model, &t.material), SCENE_OCCLUSION_SHARED);
    t.material.slots[SCENE_SLOT_OCCLUSION].image = 1;
    noise.images[1].width = SIDE / 2;
    assert_int_equal(scene_occlusion_of(&t.model, &t.material), SCENE_OCCLUSION_APART);
}

// Materials that combine the same images, one with mipmaps and one without, have textures of their own: the square in
// front looks as it does alone, whichever material comes first.
static void test_combined_with_and_without_mips(void **state)
{
    (void)state;
    struct images_of_noise noise;
    struct tiny t;
    make_combined(&t, &noise);
    struct scene_material materials[2];
    struct scene_mesh meshes[2] = {t.mesh, t.mesh};
    meshes[1].material = 1;
    t.instances[1].mesh = 1;
    t.model.meshes = meshes;
    const struct scene_view view = tiny_view(&t, 5);
    struct scene_pictures pictures[2];
    for (int plain = 0; plain < 2; plain++) {
        for (int m = 0; m < 2; m++) {
            materials[m] = t.material;
            const enum rhw_mip_filter filter = m == plain ? RHW_MIP_FILTER_NONE : RHW_MIP_FILTER_LINEAR;
            materials[m].slots[SCENE_SLOT_METALLIC_ROUGHNESS].mip_filter = filter;
            materials[m].slots[SCENE_SLOT_OCCLUSION].mip_filter = filter;
        }
        for (int front = 0; front < 2; front++) {
            t.model.instance_count = t.model.mesh_count = t.model.material_count = 2;
            t.model.materials = materials;
            t.instances[front].world[14] = 0.5f;
            t.instances[1 - front].world[14] = -0.5f;
            pictures[0] = draw_model(&t.model, &view);
            t.model.instance_count = t.model.mesh_count = t.model.material_count = 1;
            t.model.materials = &materials[front];
            pictures[1] = draw_model(&t.model, &view);
            assert_memory_equal(pictures[0].color, pictures[1].color, 4 * 5 * 5);
            scene_pictures_free(&pictures[0]);
            scene_pictures_free(&pictures[1]);
        }
    }
}

// One-sided surfaces vanish from behind, also when a mirroring matrix turns their winding.
static void test_culling_and_mirroring(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    for (int flags = 0; flags < 8; flags++) {
        const bool behind = flags & 1, mirrored = flags & 2;
        t.material.double_sided = flags & 4;
        t.instances[0].world[0] = mirrored ? -1.0f : 1.0f;
        t.instances[0].mirrored = mirrored;
        struct scene_view view = tiny_view(&t, 8);
        view.camera.eye[2] = behind ? -5.0 : 5.0;
        struct scene_pictures pictures = draw_model(&t.model, &view);
        const bool visible = !behind || t.material.double_sided;
        const uint8_t *pixel = &pictures.color[4 * (8 * 4 + 4)];
        visible ? assert_pixel(pixel, 255, 255, 255, 255) : assert_pixel(pixel, 10, 200, 30, 255);
        scene_pictures_free(&pictures);
    }
}

// Every data output at a pixel whose answer follows from the geometry alone.
static void test_data_outputs(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.material.double_sided = true;
    t.model.instance_count = 2;
    t.instances[1].world[12] = 40.0f; // out of view, but it counts triangles before nothing
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct scene_view view = tiny_view(&t, 8);
        view.outputs = SCENE_OUTPUT_ALL & ~(SCENE_OUTPUT_COLOR | SCENE_OUTPUT_LINEAR);
        view.supersample = 4;      // has no say in data
        view.camera.eye[2] = -5.0; // from behind
        if (!orthographic) {
            view.camera.orthographic = false;
            view.camera.yfov = 2.0 * atan(2.0 / 5.0);
        }
        struct scene_pictures p = draw_model(&t.model, &view);
        assert_null(p.color);
        const int i = 8 * 3 + 2; // the camera's right is −x: pixel centre (1.5/2, 0.25)
        tiny_assert_close((double)p.position[4 * i], 0.75, 1e-6);
        tiny_assert_close((double)p.position[4 * i + 1], 0.25, 1e-6);
        tiny_assert_close((double)p.position[4 * i + 2], 0.0, 1e-6);
        tiny_assert_close((double)p.uv[4 * i], 0.875, 1e-6);
        tiny_assert_close((double)p.uv[4 * i + 1], 0.375, 1e-6);
        tiny_assert_close((double)p.distance[i], 5.0, 1e-5);
        // d = f (z − n) / (z (f − n)) with n 1, f 9, z 5; orthographic (z − n) / (f − n).
        tiny_assert_close((double)p.depth[i], orthographic ? 0.5 : 0.9, 1e-6);
        tiny_assert_close((double)p.normal[4 * i + 2], -1.0, 1e-6); // turned to the viewer
        assert_int_equal(p.object[i], 1);
        assert_int_equal(p.triangle[i], 1); // x > y: below the diagonal
        assert_int_equal(p.triangle[8 * 2 + 4], 2);
        // Weights of (−1,−1), (1,−1), (1,1) at (0.75, 0.25).
        tiny_assert_close((double)p.barycentric[4 * i], 0.125, 1e-6);
        tiny_assert_close((double)p.barycentric[4 * i + 1], 0.25, 1e-6);
        tiny_assert_close((double)p.barycentric[4 * i + 2], 0.625, 1e-6);
        tiny_assert_close((double)p.barycentric[4 * i + 3], 1.0, 0.0);
        assert_true(isinf(p.distance[0]) && p.depth[0] == 1.0f && p.object[0] == 0 && p.triangle[0] == 0);
        assert_true(p.normal[2] == 0.0f && p.position[3] == 0.0f && p.uv[3] == 0.0f);
        scene_pictures_free(&p);
    }
}

// A flat normal map with its tangents changes nothing; a leaning one leans the normal towards the tangent,
// in a mirrored instance towards the mirrored one.
static void test_normal_map(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.material.unlit = false;
    t.material.slots[SCENE_SLOT_NORMAL].image = 0;
    t.mesh.tangents = t.tangents;
    for (int k = 0; k < 4; k++) {
        const uint8_t lean[4] = {218, 182, 218, 255}; // 2 c / 255 − 1: 0.7098, 0.4275, 0.7098
        memcpy(t.texels[k], lean, sizeof lean);
    }
    struct scene_view view = tiny_view(&t, 8);
    view.outputs = SCENE_OUTPUT_NORMAL;
    const double length = sqrt(2.0 * 0.70980392 * 0.70980392 + 0.42745098 * 0.42745098);
    for (int mirrored = 0; mirrored < 2; mirrored++) {
        t.instances[0].world[0] = mirrored ? -1.0f : 1.0f;
        t.instances[0].mirrored = mirrored;
        struct scene_pictures p = draw_model(&t.model, &view);
        const float *n = &p.normal[4 * (8 * 4 + 4)];
        tiny_assert_close((double)n[0], (mirrored ? -1.0 : 1.0) * 0.70980392 / length, 1e-5);
        tiny_assert_close((double)n[1], 0.42745098 / length, 1e-5); // the bitangent is not mirrored in x
        tiny_assert_close((double)n[2], 0.70980392 / length, 1e-5);
        scene_pictures_free(&p);
    }
}

// Lines are 1.5 pixels wide, points discs of 4.5, wherever they are.
static void test_lines_and_points(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    uint32_t ends[2] = {0, 1};
    t.mesh.normals = NULL;
    t.mesh.indices = ends;
    t.positions[0][0] = -1.0f;
    t.positions[0][1] = 0.0f;
    t.positions[1][0] = 1.0f;
    t.positions[1][1] = 0.0f;
    tiny_set_bounds(&t);
    t.mesh.index_count = 2;
    t.mesh.primitive = SCENE_PRIMITIVE_LINES;
    const struct scene_view view = tiny_view(&t, 64);
    for (int points = 0; points < 2; points++) {
        t.mesh.primitive = points ? SCENE_PRIMITIVE_POINTS : SCENE_PRIMITIVE_LINES;
        struct scene_pictures p = draw_model(&t.model, &view);
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
        scene_pictures_free(&p);
    }
}

// Points of a cloud are discs of a size in the world: here 16 pixels are a unit, and the model is drawn half as large.
static void test_point_radius(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    uint32_t ends[2] = {0, 1};
    t.mesh.normals = NULL;
    t.mesh.indices = ends;
    t.mesh.index_count = 2;
    t.mesh.primitive = SCENE_PRIMITIVE_POINTS;
    t.positions[0][0] = -1.0f;
    t.positions[0][1] = 0.0f;
    t.positions[1][0] = 1.0f;
    t.positions[1][1] = 0.0f;
    tiny_set_bounds(&t);
    for (int i = 0; i < 3; i++) {
        t.instances[0].world[5 * i] = 0.5f;
    }
    const struct scene_view view = tiny_view(&t, 64);
    static const struct {
        float radius;
        int pixels;
    } cases[] = {{0.5f, 52}, {0.01f, 4}, {0.0f, 16}}; // centres within 4 of a pixel corner; 1; 2.25
    for (int i = 0; i < 3; i++) {
        t.mesh.point_radius = cases[i].radius;
        struct scene_pictures p = draw_model(&t.model, &view);
        int lit = 0;
        for (int k = 0; k < 64 * 64; k++) {
            lit += p.color[4 * k] == 255;
        }
        assert_int_equal(lit, 2 * cases[i].pixels);
        scene_pictures_free(&p);
    }
}

// A line that begins before the camera and ends behind it leaves the picture on the side it heads for.
static void test_line_through_the_near_plane(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    uint32_t ends[2] = {0, 1};
    t.mesh.normals = NULL;
    t.mesh.primitive = SCENE_PRIMITIVE_LINES;
    t.mesh.indices = ends;
    t.mesh.index_count = 2;
    memset(t.positions[0], 0, sizeof t.positions[0]);
    t.positions[1][0] = 2.0f;
    t.positions[1][1] = 0.0f;
    t.positions[1][2] = 20.0f;
    tiny_set_bounds(&t);
    struct scene_view view = tiny_view(&t, 64);
    view.camera =
        (struct scene_camera){.eye = {0, 0, 5}, .up = {0, 1, 0}, .yfov = 1.0, .znear = 0.1, .zfar = 50.0};
    for (int swapped = 0; swapped < 2; swapped++) {
        ends[0] = (uint32_t)swapped;
        ends[1] = (uint32_t)(1 - swapped);
        struct scene_pictures p = draw_model(&t.model, &view);
        for (int x = 0; x < 64; x++) {
            const bool white = p.color[4 * (64 * 32 + x)] == 255;
            assert_true(white == (x >= 31)); // the end's cap reaches 0.75 to the left of the middle
            assert_true(p.color[4 * (64 * 20 + x)] != 255);
        }
        scene_pictures_free(&p);
    }
}

static void test_wireframe_marks_edges(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = tiny_view(&t, 64);
    view.wireframe = SCENE_WIREFRAME_PLAIN;
    struct scene_pictures p = draw_model(&t.model, &view);
    const uint8_t *edge = &p.color[4 * (64 * 40 + 16)], *inside = &p.color[4 * (64 * 26 + 22)];
    const uint8_t *diagonal = &p.color[4 * (64 * 31 + 32)];
    assert_pixel(inside, 226, 226, 226, 255);
    assert_true(edge[0] < 170);
    assert_true(diagonal[0] < 60);
    scene_pictures_free(&p);
}

// The same bytes for one thread and baseline as for many and the best.
static void test_pictures_do_not_depend_on_the_machine(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.material.unlit = false;
    t.material.metallic = 0.4f;
    t.material.roughness = 0.3f;
    struct scene_view view = tiny_view(&t, 200);
    view.camera = scene_camera_fit(&t.model, (struct scene_orbit){.azimuth = 35, .elevation = 15}, 0.6, 1.0);
    view.background = SCENE_BACKGROUND_DEFAULT;
    view.supersample = 4;
    struct scene_pictures first = draw_model(&t.model, &view);
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (!rhw_isa_supported((enum rhw_isa)isa)) {
            continue;
        }
        struct rhw_context_def def = rhw_context_def_default();
        def.threads = isa + 1;
        def.isa_limit = rhw_isa_up_to((enum rhw_isa)isa);
        rhw_context *context;
        struct scene *scene;
        struct scene_pictures again;
        assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
        assert_int_equal(scene_create(context, &t.model, &scene), RHW_OK);
        for (int repeat = 0; repeat < 2; repeat++) {
            assert_int_equal(scene_draw(scene, &view, &again, NULL), RHW_OK);
            assert_memory_equal(first.color, again.color, 200 * 200 * 4);
            scene_pictures_free(&again);
        }
        scene_destroy(scene);
        rhw_context_destroy(context);
    }
    scene_pictures_free(&first);
}

// A texture whose texels differ from those of its image is made in bands: the program is asked before each, and its
// first no ends it all.
static void test_images_given_up(void **state)
{
    (void)state;
    enum { IMAGE_SIDE = 512 };
    static uint16_t texels[IMAGE_SIDE * IMAGE_SIDE][4];
    struct tiny t;
    tiny_make(&t);
    t.image = (struct scene_image){.width = IMAGE_SIDE, .height = IMAGE_SIDE, .texels = texels};
    t.image.type = SCENE_IMAGE_RGBA16;
    t.image.size = sizeof texels;
    t.model.image_count = 1;
    t.model.images = &t.image;
    t.material.slots[SCENE_SLOT_BASE_COLOR].image = 0;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    rhw_context *context;
    struct scene *scene;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    struct patience patience = {.left = 1 << 30};
    rhw_context_set_goes_on(context, goes_on, &patience);
    assert_int_equal(scene_create(context, &t.model, &scene), RHW_OK);
    scene_destroy(scene);
    const int all = patience.asked;
    assert_true(all >= 4); // bands of 65536 texels and a row
    for (int left = 0; left < all; left++) {
        patience = (struct patience){.left = left};
        assert_int_equal(scene_create(context, &t.model, &scene), RHW_ERROR_GIVEN_UP);
        assert_int_equal(patience.asked, left + 1);
    }
    rhw_context_destroy(context);
}

static void test_view_rules(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    char error[200];
    const struct scene_view good = tiny_view(&t, 64);
    assert_true(scene_view_check(&good, error, sizeof error));
    struct scene_view view = good;
    view.supersample = 8;
    assert_false(scene_view_check(&view, error, sizeof error));
    assert_non_null(strstr(error, "1, 4, 9 or 16"));
    view.supersample = 16;
    view.width = 4097;
    assert_false(scene_view_check(&view, error, sizeof error));
    assert_non_null(strstr(error, "16384"));
    view.width = 4096;
    assert_true(scene_view_check(&view, error, sizeof error));
    view.width = 0;
    assert_false(scene_view_check(&view, error, sizeof error));
    view = good;
    view.outputs = 0;
    assert_false(scene_view_check(&view, error, sizeof error));
    view = good;
    view.exposure = NAN;
    assert_false(scene_view_check(&view, error, sizeof error));
    view = good;
    view.camera.zfar = view.camera.znear;
    assert_false(scene_view_check(&view, error, sizeof error));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_order_of_drawing),
    cmocka_unit_test(test_unlit_square),
    cmocka_unit_test(test_supersampling_averages_light),
    cmocka_unit_test(test_blending_is_sorted),
    cmocka_unit_test(test_colors_of_each_depth_stand_alone),
    cmocka_unit_test(test_far_parts_in_each_pose),
    cmocka_unit_test(test_transparent_background_keeps_color_straight),
    cmocka_unit_test(test_texture_transform_and_mask),
    cmocka_unit_test(test_occlusion_and_roughness_are_combined),
    cmocka_unit_test(test_combined_with_and_without_mips),
    cmocka_unit_test(test_culling_and_mirroring),
    cmocka_unit_test(test_data_outputs),
    cmocka_unit_test(test_normal_map),
    cmocka_unit_test(test_lines_and_points),
    cmocka_unit_test(test_point_radius),
    cmocka_unit_test(test_line_through_the_near_plane),
    cmocka_unit_test(test_wireframe_marks_edges),
    cmocka_unit_test(test_pictures_do_not_depend_on_the_machine),
    cmocka_unit_test(test_images_given_up),
    cmocka_unit_test(test_view_rules),
};

const struct unit_tests test_scene = UNIT_TESTS(tests, NULL, NULL);
