// SPDX-License-Identifier: MIT
// See scene_pbr.h. Mip chains are made by rhw, so that both renderers filter the same texels: of colours it
// averages light, of other textures numbers.
#include "scene_pbr.h"

#include "rhw/rhw.h"
#include "scene_model.h"
#include "shadow.h"
#include "surface.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char helmet_path[] = "gltf/DamagedHelmet.glb"; // in the folder of models

// Textures ------------------------------------------------------------------------------------------

static bool fill_levels(rhw_context *context, const struct scene_image *image, struct bench_texture *texture)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    rhw_texture made;
    def.width = texture->width;
    def.height = texture->height;
    def.mip_levels = texture->levels;
    def.format = texture->format == BENCH_SRGB8_ALPHA8 ? RHW_FORMAT_RGBA8_SRGB : RHW_FORMAT_RGBA8_UNORM;
    if (rhw_texture_create(context, &def, &made) != RHW_OK) {
        return false;
    }
    rhw_texture_write(context, made, 0, image->texels, 0);
    const bool works = rhw_texture_generate_mips(context, made) == RHW_OK;
    for (int level = 0; works && level < texture->levels; level++) {
        rhw_texture_read(context, made, level, texture->texels[level], 0);
    }
    rhw_texture_destroy(context, made);
    return works;
}

// Image i is texture 2 i where it is read as colour and 2 i + 1 where it is not.
static bool make_textures(struct bench_scene *scene, const struct scene_model *model)
{
    struct rhw_context_def def = rhw_context_def_default();
    rhw_context *context;
    def.threads = 1;
    bool works = rhw_context_create(&def, &context) == RHW_OK;
    for (uint32_t i = 0; works && i < 2 * model->image_count; i++) {
        const struct scene_image *const image = &model->images[i / 2];
        struct bench_texture *const texture = &scene->textures[i];
        texture->format = i % 2 == 0 ? BENCH_SRGB8_ALPHA8 : BENCH_RGBA8;
        if (i % 2 == 0 ? image->used_as_color : image->used_as_data) {
            works = image->type == SCENE_IMAGE_RGBA8 &&
                    bench_texture_allocate(texture, (int)image->width, (int)image->height) &&
                    fill_levels(context, image, texture);
        }
    }
    rhw_context_destroy(context);
    return works;
}

// Meshes --------------------------------------------------------------------------------------------

static float *append(float *to, const float *values, size_t count)
{
    memcpy(to, values, count * sizeof *to);
    return to + count;
}

// All alike, so that every shader finds what it reads; zeros where the model has nothing.
static bool make_mesh(const struct scene_mesh *from, struct bench_mesh *to)
{
    static const float none[4] = {0};
    to->has[BENCH_POSITION] = to->has[BENCH_NORMAL] = to->has[BENCH_UV] = to->has[BENCH_TANGENT] = true;
    if (!bench_mesh_allocate(to, from->vertex_count, from->index_count)) {
        return false;
    }
    float *out = to->vertices;
    for (uint32_t v = 0; v < from->vertex_count; v++) {
        out = append(out, from->positions[v], 3);
        out = append(out, from->normals[v], 3);
        out = append(out, from->uvs[0] ? from->uvs[0][v] : none, 2);
        out = append(out, from->tangents ? from->tangents[v] : none, 4);
    }
    memcpy(to->indices, from->indices, (size_t)from->index_count * sizeof *to->indices);
    return true;
}

// Draws ---------------------------------------------------------------------------------------------

// The variant for exactly the textures of a material; BENCH_SHADERS where there is none, and for a mirrored
// instance, whose triangles turn the other way.
static enum bench_shader find_shader(const struct scene_instance *instance,
                                     const struct scene_material *material, int *texture_count)
{
    unsigned slots = 0;
    if (instance->mirrored) {
        return BENCH_SHADERS;
    }
    if (material->alpha_mode == SCENE_ALPHA_BLEND) {
        *texture_count = 0;
        return material->double_sided && material->slots[0].image < 0 ? BENCH_SHADER_PBR_HAIR : BENCH_SHADERS;
    }
    for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
        slots |= material->slots[s].image >= 0 ? 1u << s : 0;
    }
    const bool opaque = material->alpha_mode == SCENE_ALPHA_OPAQUE && !material->double_sided;
    const bool masked = material->alpha_mode == SCENE_ALPHA_MASK && material->double_sided;
    *texture_count = slots == 1 ? 1 : slots == 7 ? 3 : 5;
    if (opaque && slots == 31) {
        return BENCH_SHADER_PBR_FULL;
    }
    if ((opaque || masked) && slots == 7) {
        return masked ? BENCH_SHADER_PBR_MASKED : BENCH_SHADER_PBR_MAPPED;
    }
    return opaque && slots == 1 ? BENCH_SHADER_PBR_BASE : BENCH_SHADERS;
}

static struct bench_surface_uniforms make_uniforms(const struct scene_instance *instance,
                                                   const struct scene_material *material,
                                                   const struct scene_camera *camera, double aspect)
{
    double world[16], normal[9];
    for (int i = 0; i < 16; i++) {
        world[i] = (double)instance->world[i];
    }
    const struct bench_uniforms look = bench_look(camera, aspect, world);
    struct bench_surface_uniforms u = {.cutoff = material->alpha_cutoff,
                                       .metallic = material->metallic,
                                       .roughness = material->roughness,
                                       .normal_scale = material->normal_scale,
                                       .occlusion_strength = material->occlusion_strength};
    memcpy(u.clip, look.clip, sizeof u.clip);
    memcpy(u.world, look.world, sizeof u.world);
    memcpy(u.color, material->base_color, sizeof u.color);
    memcpy(u.emissive, material->emissive, sizeof u.emissive);
    scene_matrix_normal(world, normal);
    for (int i = 0; i < 9; i++) {
        u.normal[i / 3 * 4 + i % 3] = (float)normal[i];
    }
    return u;
}

// What a draw is for: to be seen, or to cast a shadow, which is drawn for every item first.
static void make_shadowed(struct bench_scene *scene, uint32_t i, uint32_t items)
{
    double light[16];
    struct bench_draw *const seen = &scene->draws[items + i], *const cast = &scene->draws[i];
    struct bench_surface_uniforms *const uniforms = scene->surfaces->uniforms;
    const bool masked = cast->shader == BENCH_SHADER_PBR_MASKED;
    *seen = *cast;
    uniforms[items + i] = uniforms[i];
    seen->shader += BENCH_SHADER_PBR_BASE_SHADOWED - BENCH_SHADER_PBR_BASE;
    seen->textures[seen->texture_count++] = scene->texture_count - 1;
    cast->shader = masked ? BENCH_SHADER_PBR_CAST_MASKED : BENCH_SHADER_PBR_CAST;
    cast->texture_count = masked;
    // Depth that grows with distance, from -1 to 1.
    scene_shadow_projection(&scene->surfaces->map, light);
    const float *const world = uniforms[i].world;
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            double sum = column == 3 ? light[12 + row] : 0.0;
            double w = column == 3 ? light[15] : 0.0;
            for (int k = 0; k < 3; k++) {
                sum += light[4 * k + row] * (double)world[4 * k + column];
                w += light[4 * k + 3] * (double)world[4 * k + column];
            }
            uniforms[i].clip[4 * column + row] = (float)(row == 2 ? w - 2.0 * sum : sum);
        }
    }
}

// In the order in which rhw draws them.
static bool make_draws(struct bench_scene *scene, const struct scene_camera *camera, double aspect)
{
    const struct scene_model *const model = scene->surfaces->model;
    struct scene_surface_item *const items = malloc(((size_t)model->instance_count + 1) * sizeof *items);
    scene->surfaces->uniforms =
        calloc(2 * (size_t)model->instance_count + 1, sizeof *scene->surfaces->uniforms);
    bool works = items && scene->surfaces->uniforms;
    const bool shadowed = scene->surfaces->is_shadowed;
    const uint32_t count =
        works ? (uint32_t)scene_surface_items_list(model, &scene->surfaces->frame, true, items) : 0;
    scene->draw_count = shadowed ? 2 * count : count;
    scene->passes[0].draw_count = scene->passes[shadowed].draw_count = count;
    scene->passes[shadowed].first_draw = shadowed ? count : 0;
    for (uint32_t i = 0; works && i < count; i++) {
        const struct scene_instance *const instance = &model->instances[items[i].instance];
        const struct scene_material *const material =
            &model->materials[model->meshes[instance->mesh].material];
        struct bench_draw *const draw = &scene->draws[i];
        draw->shader = find_shader(instance, material, &draw->texture_count);
        draw->mesh = instance->mesh;
        const bool blends = material->alpha_mode == SCENE_ALPHA_BLEND;
        draw->depth = blends ? BENCH_DEPTH_TEST : BENCH_DEPTH_LESS;
        draw->blend = blends ? BENCH_BLEND_PREMULTIPLIED : BENCH_BLEND_OFF;
        draw->cull_back = !material->double_sided;
        for (int s = 0; s < draw->texture_count; s++) {
            const bool as_color = scene_slot_is_color((enum scene_slot)s);
            draw->textures[s] = 2 * (uint32_t)material->slots[s].image + (as_color ? 0 : 1);
        }
        scene->surfaces->uniforms[i] = make_uniforms(instance, material, camera, aspect);
        works = draw->shader != BENCH_SHADERS;
        if (works && shadowed) {
            make_shadowed(scene, i, count);
        }
    }
    free(items);
    return works;
}

// View ----------------------------------------------------------------------------------------------

static struct bench_frame_uniforms make_frame_uniforms(const struct scene_frame *frame)
{
    const struct scene_environment *const e = &frame->environment;
    const struct scene_shader_light *const light = &frame->lights[0];
    struct bench_frame_uniforms f = {.light_size = light->size, .sharpness = e->sharpness};
    append(f.eye, frame->eye, 3);
    append(f.light, light->direction, 3);
    append(f.light_color, light->color, 3);
    append(f.up, e->up, 3);
    append(f.sky, e->sky, 3);
    append(f.ground, e->ground, 3);
    append(f.diffuse, e->diffuse, 3);
    for (int i = 0; i < SCENE_LOBES; i++) {
        append(f.lobe_direction[i], e->lobe_direction[i], 3);
        append(f.lobe_color[i], e->lobe_color[i], 3);
    }
    return f;
}

static void cast_shadows(struct bench_surfaces *surfaces, const struct scene_camera *camera)
{
    struct scene_shader_light *const light = &surfaces->lighting.lights[0];
    struct scene_shadow_map *const map = &surfaces->map;
    struct bench_frame_uniforms *const f = &surfaces->frame_uniforms;
    *map = scene_shadow_cover(surfaces->model, light, camera->up);
    light->maps = map;
    light->map_count = 1;
    surfaces->light_frame = surfaces->frame;
    surfaces->light_frame.orthographic = 1;
    for (int c = 0; c < 3; c++) {
        surfaces->light_frame.forward[c] = -light->direction[c];
        surfaces->light_frame.eye[c] = light->direction[c] * map->range;
    }
    memcpy(f->map_rows, map->rows, sizeof f->map_rows);
    f->map_size = (float)map->size;
    f->unit = map->unit;
    f->range = map->range;
    f->softness = map->softness;
}

// The studio's light, whatever the file has: one directional light is what the GLSL knows.
static bool look(struct bench_surfaces *surfaces, const struct scene_camera *camera, double aspect)
{
    if (!scene_lighting_create(&surfaces->lighting, surfaces->model, camera, SCENE_AXIS_Y, true, 0.0)) {
        return false;
    }
    scene_frame_look(&surfaces->frame, camera, aspect, &surfaces->lighting, surfaces->view_projection);
    surfaces->frame.samples = 1.0f;
    surfaces->frame_uniforms = make_frame_uniforms(&surfaces->frame);
    if (surfaces->is_shadowed) {
        cast_shadows(surfaces, camera);
    }
    return true;
}

void bench_surfaces_free(struct bench_surfaces *surfaces)
{
    if (surfaces) {
        scene_lighting_destroy(&surfaces->lighting);
        scene_model_free(surfaces->model);
        free(surfaces->uniforms);
        free(surfaces);
    }
}

// Strands of 8 pieces that hang from a ball, written to a file, which is read as any other.
static bool write_hair(const char *folder, char path[64])
{
    enum { STRANDS = 10000, PIECES = 8 };
    char library[64];
    snprintf(path, 64, "%s/hair.obj", folder);
    snprintf(library, sizeof library, "%s/hair.mtl", folder);
    FILE *const materials = fopen(library, "w"), *const model = fopen(path, "w");
    if (materials) {
        fputs("newmtl hair\nKd 0.45 0.27 0.12\nd 0.35\nPr 0.5\n", materials);
        fclose(materials);
    }
    if (!model) {
        return false;
    }
    fputs("mtllib hair.mtl\nusemtl hair\n", model);
    uint32_t random = 1;
    for (int i = 0; i < STRANDS; i++) {
        double at[3];
        for (int c = 0; c < 3; c++) {
            random = random * 1664525u + 1013904223u;
            at[c] = (double)(random >> 8) / 0x1p23 - 1.0;
        }
        const double length = __builtin_sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]) + 1e-3;
        for (int k = 0; k <= PIECES; k++) { // outwards, then down
            const double t = (double)k / PIECES, width = 0.012 * (1.0 - 0.8 * t);
            const double out = 1.0 + 0.45 * t;
            const double p[3] = {at[0] / length * out, at[1] / length * out - 0.8 * t * t,
                                 at[2] / length * out};
            fprintf(model, "v %.6f %.6f %.6f\nv %.6f %.6f %.6f\n", p[0] - width, p[1], p[2] + width,
                    p[0] + width, p[1], p[2] - width);
            if (k > 0) {
                fputs("f -4 -3 -1 -2\n", model);
            }
        }
    }
    return fclose(model) == 0;
}

static struct scene_model *make_hair(char *why, size_t why_size)
{
    char folder[] = "/tmp/rhw-hair-XXXXXX", path[64], library[64];
    struct scene_model *model = NULL;
    if (!mkdtemp(folder)) {
        snprintf(why, why_size, "no folder can be made in /tmp");
        return NULL;
    }
    if (write_hair(folder, path)) {
        model = scene_model_load(path, NULL, why, why_size);
    }
    snprintf(library, sizeof library, "%s/hair.mtl", folder);
    unlink(path);
    unlink(library);
    rmdir(folder);
    return model;
}

// The file's order becomes that from back to front, which both draw.
static bool sort_blended(struct bench_surfaces *surfaces)
{
    const struct scene_model *const model = surfaces->model;
    bool sorted = true;
    for (uint32_t i = 0; i < model->instance_count && sorted; i++) {
        struct scene_mesh *const mesh = &model->meshes[model->instances[i].mesh];
        if (model->materials[mesh->material].alpha_mode == SCENE_ALPHA_BLEND) {
            uint32_t *const order = malloc((size_t)mesh->index_count * sizeof *order);
            sorted = order && scene_triangle_order_sort(mesh, model->instances[i].world,
                                                        surfaces->frame.forward, order);
            if (sorted) {
                memcpy(mesh->indices, order, (size_t)mesh->index_count * sizeof *order);
            }
            free(order);
        }
    }
    return sorted;
}

static void make_passes(struct bench_scene *scene)
{
    const int map = (int)scene->texture_count - 1;
    const bool shadowed = scene->surfaces->is_shadowed;
    scene->passes[shadowed] =
        (struct bench_pass){.color_count = 1, .colors = {BENCH_PICTURE}, .depth = BENCH_PASS_DEPTH};
    if (shadowed) {
        scene->passes[0] = (struct bench_pass){.depth = BENCH_PASS_DEPTH_KEPT, .depth_texture = map};
        scene->textures[map] = (struct bench_texture){.width = SCENE_SHADOW_SIZE,
                                                      .height = SCENE_SHADOW_SIZE,
                                                      .levels = 1,
                                                      .format = BENCH_D32F,
                                                      .filter = BENCH_FETCH,
                                                      .target = true};
    }
}

bool bench_make_pbr(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                    char *why, size_t why_size)
{
    const bool helmet = entry->variant == BENCH_PBR_HELMET || entry->variant == BENCH_PBR_HELMET_SHADOWED;
    const bool hair = entry->variant == BENCH_PBR_HAIR;
    const bool shadowed = entry->variant >= BENCH_PBR_HELMET_SHADOWED && !hair;
    const double aspect = (double)width / (double)height;
    scene->surfaces = calloc(1, sizeof *scene->surfaces);
    struct scene_model *const model =
        !scene->surfaces ? NULL
        : hair           ? make_hair(why, why_size)
                         : bench_model_load(helmet ? helmet_path : bench_sponza_path, why, why_size);
    if (!model) {
        return false;
    }
    scene->surfaces->model = model;
    const struct scene_camera camera =
        helmet || hair ? scene_camera_fit(model, scene_camera_default_orbit(model, SCENE_AXIS_Y),
                                          scene_camera_default_yfov(), aspect)
                       : bench_sponza_camera;
    scene->mesh_count = model->mesh_count;
    scene->texture_count = 2 * model->image_count + shadowed;
    scene->draw_count = model->instance_count * (shadowed ? 2 : 1);
    scene->pass_count = shadowed ? 2 : 1;
    scene->surfaces->is_shadowed = shadowed;
    scene->unit = BENCH_TRIANGLES;
    scene->work = (double)model->triangles_drawn;
    // Quads of pixels give the peer its derivatives, which at edges are of no surface: there its penumbras differ.
    scene->tolerance = (struct bench_tolerance){.color = 6, .outliers = shadowed ? 5e-3 : 5e-4};
    bool works = bench_scene_allocate(scene);
    if (works) {
        make_passes(scene);
    }
    works = works && look(scene->surfaces, &camera, aspect) && sort_blended(scene->surfaces) &&
            make_textures(scene, model);
    for (uint32_t i = 0; works && i < scene->mesh_count; i++) {
        works = make_mesh(&model->meshes[i], &scene->meshes[i]);
    }
    if (works && !make_draws(scene, &camera, aspect)) {
        snprintf(why, why_size, "a material or an instance that no shader of the scene is for");
        return false;
    }
    return works;
}
