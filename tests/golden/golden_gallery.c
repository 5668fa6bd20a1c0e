// SPDX-License-Identifier: MIT
// Golden scenes of models, drawn as `rhw render` draws them: by the built-in shaders of scene/, with every output
// it has. The gallery is made here and has every kind of material, primitive and light; the others are real
// models, which models/ carries decoded.
#include "golden_model_file.h"
#include "golden_scenes.h"

#include "draw/draw.h"
#include "draw/panorama.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { IMAGE_COLORS, IMAGE_BUMPS, IMAGE_ROUGHNESS, IMAGE_GLOW, IMAGES, IMAGE_SIDE = 32 };
enum { MATERIALS = 12, BALL = 0, PLATE, LINES, POINTS, MESHES, GRID = 12 };

static const char *folder;

void golden_models_at(const char *path)
{
    folder = path;
}

// A ball as six curved faces with coordinates of their own; a plate is one flat face. Tangents follow u.
static void make_faces(struct scene_mesh *mesh, int faces)
{
    mesh->vertex_count = (uint32_t)(faces * (GRID + 1) * (GRID + 1));
    mesh->index_count = (uint32_t)(faces * GRID * GRID * 6);
    mesh->positions = golden_allocate(mesh->vertex_count, sizeof *mesh->positions);
    mesh->normals = golden_allocate(mesh->vertex_count, sizeof *mesh->normals);
    mesh->tangents = golden_allocate(mesh->vertex_count, sizeof *mesh->tangents);
    mesh->colors = golden_allocate(mesh->vertex_count, sizeof *mesh->colors);
    mesh->indices = golden_allocate(mesh->index_count, sizeof *mesh->indices);
    for (int set = 0; set < SCENE_UV_SETS; set++) {
        mesh->uvs[set] = golden_allocate(mesh->vertex_count, sizeof *mesh->uvs[set]);
    }
    uint32_t v = 0, i = 0;
    for (int face = 0; face < faces; face++) {
        const int axis = face / 2, along_u = (axis + 1) % 3, along_v = (axis + 2) % 3;
        const float side = face % 2 ? -1.0f : 1.0f;
        for (uint32_t at = 0; at < (GRID + 1) * (GRID + 1); at++, v++) {
            const float x = (float)(at % (GRID + 1)) / GRID * 2 - 1,
                        y = (float)(at / (GRID + 1)) / GRID * 2 - 1;
            float p[3];
            p[axis] = faces == 1 ? 0 : side;
            p[along_u] = x * side;
            p[along_v] = y;
            const float length = faces == 1 ? 1 : __builtin_sqrtf(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            float slope = 0, square = 0, tangent[3];
            for (int c = 0; c < 3; c++) {
                mesh->positions[v][c] = p[c] / length;
                mesh->normals[v][c] = faces == 1 ? (c == axis ? 1.0f : 0.0f) : p[c] / length;
            }
            slope = mesh->normals[v][along_u] * side;
            for (int c = 0; c < 3; c++) {
                tangent[c] = (c == along_u ? side : 0) - slope * mesh->normals[v][c];
                square += tangent[c] * tangent[c];
            }
            for (int c = 0; c < 3; c++) {
                mesh->tangents[v][c] = tangent[c] / __builtin_sqrtf(square);
                mesh->colors[v][c] = c == face % 3 ? 1.0f : 0.75f + 0.25f * x * y;
            }
            mesh->tangents[v][3] = -1;
            mesh->colors[v][3] = 1;
            mesh->uvs[0][v][0] = 0.5f + 0.5f * x;
            mesh->uvs[0][v][1] = 0.5f - 0.5f * y;
            mesh->uvs[1][v][0] = x;
            mesh->uvs[1][v][1] = y * 1.5f;
            if (at % (GRID + 1) < GRID && at / (GRID + 1) < GRID) {
                const uint32_t corner[6] = {v, v + 1, v + GRID + 1, v + GRID + 1, v + 1, v + GRID + 2};
                memcpy(mesh->indices + i, corner, sizeof corner);
                i += 6;
            }
        }
    }
}

// A spiral of points, as a chain of lines or one by one.
static void make_spiral(struct scene_mesh *mesh, enum scene_primitive primitive)
{
    enum { COUNT = 40 };
    mesh->primitive = primitive;
    mesh->vertex_count = COUNT;
    mesh->index_count = primitive == SCENE_PRIMITIVE_LINES ? 2 * (COUNT - 1) : COUNT;
    mesh->positions = golden_allocate(COUNT, sizeof *mesh->positions);
    mesh->colors = golden_allocate(COUNT, sizeof *mesh->colors);
    mesh->indices = golden_allocate(mesh->index_count, sizeof *mesh->indices);
    float x = 1, y = 0;
    for (uint32_t i = 0; i < COUNT; i++) {
        const float color[4] = {(float)i / COUNT, 0.2f, 1 - (float)i / COUNT, 1};
        const float position[3] = {x, (float)i / COUNT * 2 - 1, y};
        memcpy(mesh->positions[i], position, sizeof position);
        memcpy(mesh->colors[i], color, sizeof color);
        const float turned = x * 0.75f - y * 0.6f;
        y = x * 0.6f + y * 0.75f;
        x = turned;
    }
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        mesh->indices[i] = primitive == SCENE_PRIMITIVE_LINES ? (i + 1) / 2 : i;
    }
}

static void make_images(struct scene_image *images)
{
    static const enum scene_image_type types[IMAGES] = {SCENE_IMAGE_RGBA8, SCENE_IMAGE_RGBA8,
                                                        SCENE_IMAGE_RGBA16, SCENE_IMAGE_RGBA32F};
    static const size_t sizes[] = {
        [SCENE_IMAGE_RGBA8] = 4, [SCENE_IMAGE_RGBA16] = 8, [SCENE_IMAGE_RGBA32F] = 16};
    for (int i = 0; i < IMAGES; i++) {
        images[i] =
            (struct scene_image){.name = "", .type = types[i], .width = IMAGE_SIDE, .height = IMAGE_SIDE};
        images[i].used_as_color = i == IMAGE_COLORS || i == IMAGE_GLOW;
        images[i].used_as_data = i == IMAGE_BUMPS || i == IMAGE_ROUGHNESS;
        images[i].has_alpha = i == IMAGE_COLORS;
        images[i].size = IMAGE_SIDE * IMAGE_SIDE * sizes[types[i]];
        images[i].texels = golden_allocate(images[i].size, 1);
    }
    for (int i = 0; i < IMAGE_SIDE * IMAGE_SIDE; i++) {
        const int x = i % IMAGE_SIDE, y = i / IMAGE_SIDE;
        const bool dark = (x / 4 + y / 4) % 2;
        unsigned char *const color = (unsigned char *)images[IMAGE_COLORS].texels + 4 * i;
        unsigned char *const bump = (unsigned char *)images[IMAGE_BUMPS].texels + 4 * i;
        uint16_t *const rough = (uint16_t *)images[IMAGE_ROUGHNESS].texels + 4 * i;
        float *const glow = (float *)images[IMAGE_GLOW].texels + 4 * i;
        for (int c = 0; c < 3; c++) {
            color[c] = (unsigned char)(dark ? 40 + 60 * c : 250 - (c == 1 ? 4 * x : 3 * y));
            rough[c] = (uint16_t)(c == 1 ? 2000 * x : c == 2 ? (y / 8 % 2) * 65535 : 65535 - 1500 * y);
            glow[c] = x % 8 == 3 ? 1.5f * (float)c : 0.0f;
        }
        color[3] = (unsigned char)(255 * (x / 4 % 4) / 3);
        bump[0] = (unsigned char)(x % 8 < 4 ? 96 : 160);
        bump[1] = (unsigned char)(y % 8 < 4 ? 96 : 160);
        bump[2] = 240;
        bump[3] = 255;
        rough[3] = 65535;
        glow[3] = 1;
    }
}

static void bind(struct scene_material *material, enum scene_slot slot, int image)
{
    material->slots[slot].image = image;
}

static void make_materials(struct scene_material *materials)
{
    for (int m = 0; m < MATERIALS; m++) {
        materials[m] =
            (struct scene_material){.name = "",
                                    .base_color = {0.9f, 0.6f - 0.04f * (float)m, 0.1f * (float)m, 1},
                                    .metallic = (float)(m % 3) * 0.5f,
                                    .roughness = 0.15f + 0.07f * (float)m,
                                    .normal_scale = 1,
                                    .occlusion_strength = 0.75f,
                                    .alpha_cutoff = 0.5f};
        for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
            // Coordinates turned, scaled and moved; another address and filter for each.
            materials[m].slots[s] =
                (struct scene_texture_slot){.image = -1,
                                            .uv_set = (uint32_t)(m % SCENE_UV_SETS),
                                            .transform = {m % 2 ? 0.8f : 1, m % 2 ? 0.6f : 0, 0.1f,
                                                          m % 2 ? -0.6f : 0, m % 2 ? 0.8f : 1, 0},
                                            .address_u = (enum rhw_address)(m % 3),
                                            .address_v = (enum rhw_address)((m + 1) % 3),
                                            .min_filter = m % 2 ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR,
                                            .mag_filter = RHW_FILTER_LINEAR,
                                            .mip_filter = (enum rhw_mip_filter)(RHW_MIP_FILTER_NONE - m % 3)};
        }
    }
    bind(&materials[3], SCENE_SLOT_BASE_COLOR, IMAGE_COLORS);
    bind(&materials[4], SCENE_SLOT_BASE_COLOR, IMAGE_COLORS);
    bind(&materials[4], SCENE_SLOT_NORMAL, IMAGE_BUMPS);
    bind(&materials[5], SCENE_SLOT_NORMAL, IMAGE_BUMPS);
    bind(&materials[5], SCENE_SLOT_METALLIC_ROUGHNESS, IMAGE_ROUGHNESS);
    bind(&materials[5], SCENE_SLOT_OCCLUSION, IMAGE_ROUGHNESS);
    bind(&materials[6], SCENE_SLOT_EMISSIVE, IMAGE_GLOW);
    materials[6].emissive[0] = materials[6].emissive[2] = 0.8f;
    materials[7].unlit = true;
    bind(&materials[7], SCENE_SLOT_BASE_COLOR, IMAGE_COLORS);
    materials[8].alpha_mode = SCENE_ALPHA_MASK;
    materials[8].double_sided = true;
    bind(&materials[8], SCENE_SLOT_BASE_COLOR, IMAGE_COLORS);
    materials[9].alpha_mode = SCENE_ALPHA_BLEND;
    materials[9].base_color[3] = 0.6f;
    materials[10].alpha_mode = SCENE_ALPHA_BLEND;
    bind(&materials[10], SCENE_SLOT_BASE_COLOR, IMAGE_COLORS);
    materials[11].unlit = true;
}

static void place(struct scene_instance *instance, uint32_t mesh, int column, int row, float scale)
{
    *instance = (struct scene_instance){.mesh = mesh};
    // Turned by the angle whose sine is 0.6; every third is mirrored.
    const float mirror = (column + row) % 3 == 2 ? -scale : scale;
    const float world[16] = {0.8f * mirror,
                             0,
                             -0.6f * mirror,
                             0,
                             0,
                             scale,
                             0,
                             0,
                             0.6f * scale,
                             0,
                             0.8f * scale,
                             0,
                             2.2f * (float)column,
                             -2.2f * (float)row,
                             0.3f * (float)row,
                             1};
    memcpy(instance->world, world, sizeof world);
}

static void make_lights(struct scene_model *model)
{
    static const struct scene_model_light lights[] = {
        {"", SCENE_LIGHT_DIRECTIONAL, {0}, {-0.48f, -0.6f, -0.64f}, {1, 0.95f, 0.9f}, 2, 0, 0, 0, {0}},
        {"", SCENE_LIGHT_POINT, {1, -1, 3}, {0, 0, -1}, {0.3f, 0.6f, 1}, 40, 9, 0, 0, {0}},
        {"", SCENE_LIGHT_SPOT, {6, 2, 5}, {0, -0.6f, -0.8f}, {1, 0.4f, 0.3f}, 90, 0, 0.95f, 0.8f, {0}},
    };
    model->light_count = 3;
    model->lights = golden_allocate(3, sizeof *lights);
    memcpy(model->lights, lights, sizeof lights);
}

// A layer or two for each material, some with textures.
static void make_layers(struct scene_material *materials)
{
    for (int m = 0; m < MATERIALS; m++) {
        materials[m].unlit = false;
        materials[m].alpha_mode = m == 9 ? SCENE_ALPHA_BLEND : SCENE_ALPHA_OPAQUE;
        struct scene_layers *l = &materials[m].layers;
        *l = (struct scene_layers){.used = true,
                                   .clearcoat = m % 5 == 0 ? 0.9f : 0.0f,
                                   .clearcoat_roughness = 0.1f,
                                   .clearcoat_normal_scale = 1,
                                   .specular = 1.0f - 0.05f * (float)m,
                                   .specular_color = {1, 0.9f, 1.2f},
                                   .ior = 1.2f + 0.1f * (float)m,
                                   .sheen_roughness = 0.4f,
                                   .thickness = 1.2f,
                                   .attenuation_distance = 1,
                                   .attenuation_color = {0.9f, 0.5f, 0.3f},
                                   .anisotropy_direction = {0.6f, 0.8f},
                                   .iridescence_ior = 1.4f,
                                   .iridescence_thickness = {100, 500},
                                   .gloss_specular = {0.5f, 0.3f, 0.2f},
                                   .glossiness = 0.8f};
        l->transmission = m % 3 == 1 ? 0.95f : 0.0f;
        l->dispersion = m == 7 ? 4.0f : 0.0f;
        l->anisotropy = m == 5 || m == 6 ? 0.8f : 0.0f;
        l->iridescence = m == 2 || m == 8 ? 1.0f : 0.0f;
        l->sheen_color[0] = l->sheen_color[1] = m == 3 || m == 11 ? 0.8f : 0.0f;
        l->glossy = m == 11;
        materials[m].roughness = 0.03f * (float)m;
        materials[m].metallic = m == 5 || m == 2 ? 1.0f : 0.0f;
    }
    bind(&materials[0], SCENE_SLOT_CLEARCOAT_NORMAL, IMAGE_BUMPS);
    bind(&materials[4], SCENE_SLOT_THICKNESS, IMAGE_ROUGHNESS);
    bind(&materials[5], SCENE_SLOT_ANISOTROPY, IMAGE_BUMPS);
    bind(&materials[8], SCENE_SLOT_IRIDESCENCE_THICKNESS, IMAGE_ROUGHNESS);
    bind(&materials[10], SCENE_SLOT_TRANSMISSION, IMAGE_ROUGHNESS);
    bind(&materials[11], SCENE_SLOT_GLOSS, IMAGE_COLORS);
}

// A sky over a ground, with a window and a sun.
static const struct scene_panorama *make_panorama(void)
{
    enum { WIDTH = 64, HEIGHT = 32 };
    static float texels[WIDTH * HEIGHT][4];
    static const struct scene_panorama panorama = {WIDTH, HEIGHT, texels};
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH, y = i / WIDTH;
        const bool window = x / 6 == 7 && y / 5 == 2, sun = x / 2 == 25 && y / 2 == 4;
        for (int c = 0; c < 3; c++) {
            const float sky = y < HEIGHT / 2 ? 0.5f + 0.03f * (float)(y * c) : 0.3f - 0.05f * (float)c;
            texels[i][c] = sun ? 900.0f : window ? 6.0f : sky;
        }
        texels[i][3] = 1;
    }
    return &panorama;
}

static const struct scene_model *make_gallery(bool layered)
{
    struct scene_model *const model = golden_allocate(1, sizeof *model);
    enum { COPIES = MATERIALS + 3 };
    model->image_count = IMAGES;
    model->material_count = MATERIALS;
    model->mesh_count = COPIES;
    model->instance_count = COPIES;
    model->images = golden_allocate(IMAGES, sizeof *model->images);
    model->materials = golden_allocate(MATERIALS, sizeof *model->materials);
    model->meshes = golden_allocate(COPIES, sizeof *model->meshes);
    model->instances = golden_allocate(COPIES, sizeof *model->instances);
    make_images(model->images);
    make_materials(model->materials);
    if (layered) {
        make_layers(model->materials);
    }
    struct scene_mesh shapes[MESHES] = {{.name = ""}, {.name = ""}, {.name = ""}, {.name = ""}};
    make_faces(&shapes[BALL], 6);
    make_faces(&shapes[PLATE], 1);
    make_spiral(&shapes[LINES], SCENE_PRIMITIVE_LINES);
    make_spiral(&shapes[POINTS], SCENE_PRIMITIVE_POINTS);
    for (int i = 0; i < COPIES; i++) {
        static const int extra[3] = {PLATE, LINES, POINTS};
        const int shape = i < MATERIALS ? BALL : extra[i - MATERIALS];
        model->meshes[i] = shapes[shape];
        model->meshes[i].material = (uint32_t)(i < MATERIALS ? i : shape == PLATE ? 8 : 11);
        if (i % 4 != 1 && shape == BALL) {
            model->meshes[i].colors = NULL; // they colour every fourth ball
        }
        place(&model->instances[i], (uint32_t)i, i % 5, i / 5, 1);
    }
    make_lights(model);
    golden_model_complete(model);
    return model;
}

// A camera of the file: in front of the middle, a little turned.
static struct scene_model_camera file_camera(bool orthographic)
{
    struct scene_model_camera camera = {.name = "", .orthographic = orthographic};
    camera.aspect = 2;
    camera.xmag = 6;
    camera.ymag = 4;
    camera.znear = 0.5f;
    camera.zfar = 40;
    const float world[16] = {0.8f, 0, -0.6f, 0, 0, 1, 0, 0, 0.6f, 0, 0.8f, 0, 14, -1.5f, 12, 1};
    memcpy(camera.world, world, sizeof world);
    return camera;
}

static void give(struct golden_images *images, enum rhw_format format, const struct scene_pictures *pictures,
                 void *pixels)
{
    if (pixels == NULL) {
        return;
    }
    const size_t size = rhw_format_size(format) * (size_t)pictures->width * (size_t)pictures->height;
    void *const copy = golden_allocate(size, 1);
    memcpy(copy, pixels, size);
    golden_give(images, format, pictures->width, pictures->height, copy);
}

static void draw_model(rhw_context *context, const struct scene_model *model, const struct scene_view *view,
                       struct golden_images *images)
{
    char error[256];
    if (!scene_view_check(view, error, sizeof error)) {
        fprintf(stderr, "golden: %s\n", error);
        exit(2);
    }
    struct scene *scene;
    struct scene_pictures p;
    golden_check(scene_create(context, model, &scene), "model");
    golden_check(scene_draw(scene, view, &p, NULL), "model");
    give(images, RHW_FORMAT_RGBA8_SRGB, &p, p.color);
    float *const wide[] = {p.linear, p.display, p.normal, p.position, p.uv, p.barycentric};
    for (int i = 0; i < 6; i++) {
        give(images, RHW_FORMAT_RGBA32_FLOAT, &p, wide[i]);
    }
    give(images, RHW_FORMAT_R32_FLOAT, &p, p.depth);
    give(images, RHW_FORMAT_R32_FLOAT, &p, p.distance);
    give(images, RHW_FORMAT_R32_UINT, &p, p.object);
    give(images, RHW_FORMAT_R32_UINT, &p, p.triangle);
    scene_pictures_free(&p);
    scene_destroy(scene);
}

void golden_gallery_draw(rhw_context *context, int number, struct golden_images *images)
{
    static const struct scene_model *models[2];
    const bool layered = number == 4;
    if (models[layered] == NULL) {
        models[layered] = make_gallery(layered);
    }
    const struct scene_model *const model = models[layered];
    struct scene_view view = scene_view_default(model);
    view.width = number == 3 ? 120 : 200;
    view.height = number == 3 ? 160 : 130;
    view.outputs =
        number % 2 ? SCENE_OUTPUT_COLOR | SCENE_OUTPUT_LINEAR | SCENE_OUTPUT_DISPLAY : SCENE_OUTPUT_ALL;
    static const int supersample[] = {4, 1, 1, 9, 1, 1};
    view.supersample = supersample[number];
    const double aspect = (double)view.width / view.height;
    struct scene_model_camera camera = file_camera(number == 2);
    camera.yfov = 0.25f; // the narrower picture takes a taller angle
    view.camera =
        number < 2 || number > 3
            ? scene_camera_fit(model, (struct scene_orbit){.azimuth = 25, .elevation = 15}, 0.5, aspect)
            : scene_camera_from_model(model, &camera, aspect);
    if (number == 1) {
        view.default_lights = true;
        view.wireframe = SCENE_WIREFRAME_OVER;
        view.background = SCENE_BACKGROUND_TRANSPARENT;
    } else if (number == 2) {
        view.exposure = -0.7;
        view.background = SCENE_BACKGROUND_COLOR;
        memcpy(view.background_color, (const uint8_t[]){70, 20, 40}, 3);
    } else if (number == 3) {
        view.interpolate = RHW_NOPERSPECTIVE;
        view.wireframe = SCENE_WIREFRAME_PLAIN;
    } else if (layered) {
        view.samples = 4;
        view.default_lights = true;
        view.panorama = make_panorama();
        view.panorama_rotation = 130;
        view.background = SCENE_BACKGROUND_PANORAMA;
        view.tone = SCENE_TONE_ACES;
    } else if (number == 5) {
        view.samples = 4;
        view.transparency = SCENE_TRANSPARENCY_EXACT;
    }
    draw_model(context, model, &view, images);
}

void golden_model_draw(rhw_context *context, int number, struct golden_images *images)
{
    static const char *const names[] = {"spot", "spider"};
    static const struct scene_model *models[2];
    if (models[number] == NULL) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s.rhwg", folder, names[number]);
        models[number] = golden_model_file_read(path);
    }
    struct scene_view view = scene_view_default(models[number]);
    view.width = 160;
    view.height = 120;
    view.supersample = 4;
    view.outputs = SCENE_OUTPUT_ALL;
    view.camera = scene_camera_fit(models[number],
                                   (struct scene_orbit){.azimuth = number == 0 ? 215 : 30, .elevation = 20},
                                   0.5, 160.0 / 120);
    draw_model(context, models[number], &view, images);
}
