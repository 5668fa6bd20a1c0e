// SPDX-License-Identifier: MIT
// See scene_pbr.h. Mip chains are made by rhw, so that both renderers filter the same texels: of colours it
// averages light, of other textures numbers.
#include "scene_pbr.h"

#include "rhw/rhw.h"
#include "elementary.h"
#include "scene_model.h"
#include "scene_pbr_made.h"
#include "draw/shadow.h"
#include "draw/surface.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    if (scene_material_transmits(material)) {
        *texture_count = 0;
        return BENCH_SHADER_PBR_GLASS;
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
    if (scene_material_transmits(material)) { // and the world does not stretch it
        const struct scene_layers *const layers = &material->layers;
        for (int c = 0; c < 3; c++) {
            u.attenuation[c] = (float)(scene_log((double)layers->attenuation_color[c]) / scene_log(2.0) /
                                       (double)layers->attenuation_distance);
        }
        u.thickness = layers->thickness;
        u.ior = layers->ior;
        u.transmission = layers->transmission;
    }
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
    const bool masked = seen->shader == BENCH_SHADER_PBR_MASKED;
    *cast = *seen;
    uniforms[i] = uniforms[items + i];
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

// What is seen through glass, which is drawn first too, as light.
static void make_seen_through(struct bench_scene *scene, const struct bench_draw *seen)
{
    const uint32_t number = scene->passes[0].draw_count++;
    struct bench_draw *const draw = &scene->draws[number];
    *draw = *seen;
    draw->shader = draw->shader == BENCH_SHADER_PBR_BASE ? BENCH_SHADER_PBR_BASE_LINEAR : BENCH_SHADERS;
    scene->surfaces->uniforms[number] = scene->surfaces->uniforms[seen - scene->draws];
}

static void make_draw(struct bench_draw *draw, const struct scene_instance *instance,
                      const struct scene_material *material)
{
    const bool blends = material->alpha_mode == SCENE_ALPHA_BLEND;
    draw->shader = find_shader(instance, material, &draw->texture_count);
    draw->mesh = instance->mesh;
    draw->depth = blends ? BENCH_DEPTH_TEST : BENCH_DEPTH_LESS;
    draw->blend = blends ? BENCH_BLEND_PREMULTIPLIED : BENCH_BLEND_OFF;
    draw->cull_back = !material->double_sided;
    for (int s = 0; s < draw->texture_count; s++) {
        const bool as_color = scene_slot_is_color((enum scene_slot)s);
        draw->textures[s] = 2 * (uint32_t)material->slots[s].image + (as_color ? 0 : 1);
    }
}

// In the order in which rhw draws them. Those of the picture come after those of the pass before it.
static bool make_draws(struct bench_scene *scene, const struct scene_camera *camera, double aspect)
{
    const struct scene_model *const model = scene->surfaces->model;
    struct scene_surface_item *const items = malloc(((size_t)model->instance_count + 1) * sizeof *items);
    scene->surfaces->uniforms =
        calloc(2 * (size_t)model->instance_count + 1, sizeof *scene->surfaces->uniforms);
    bool works = items && scene->surfaces->uniforms;
    const bool shadowed = scene->surfaces->is_shadowed, glass = scene->surfaces->is_glass;
    const uint32_t count =
        works ? (uint32_t)scene_surface_items_list(model, &scene->surfaces->frame, true, items) : 0;
    const uint32_t first = shadowed || glass ? count : 0;
    scene->draw_count = first + count;
    scene->passes[0].draw_count = shadowed ? count : 0;
    for (uint32_t i = 0; works && i < count; i++) {
        const struct scene_instance *const instance = &model->instances[items[i].instance];
        const struct scene_material *const material =
            &model->materials[model->meshes[instance->mesh].material];
        struct bench_draw *const draw = &scene->draws[first + i];
        make_draw(draw, instance, material);
        scene->surfaces->uniforms[first + i] = make_uniforms(instance, material, camera, aspect);
        works = draw->shader != BENCH_SHADERS;
        if (works && shadowed) {
            make_shadowed(scene, i, count);
        } else if (works && glass && draw->shader != BENCH_SHADER_PBR_GLASS) {
            make_seen_through(scene, draw);
        } else if (draw->shader == BENCH_SHADER_PBR_GLASS) {
            draw->textures[draw->texture_count++] = scene->texture_count - 1;
        }
    }
    struct bench_pass *const picture = &scene->passes[scene->pass_count - 1];
    picture->first_draw = first;
    picture->draw_count = count;
    // All of them are there for each renderer to make a program of, drawn or not.
    for (uint32_t i = scene->passes[0].draw_count; glass && i < first; i++) {
        scene->draws[i] = scene->draws[first];
        scene->surfaces->uniforms[i] = scene->surfaces->uniforms[first];
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
    append(f.view_projection, frame->view_projection, 16);
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
static bool look(const struct bench_scene *scene, const struct scene_camera *camera, double aspect)
{
    struct bench_surfaces *const surfaces = scene->surfaces;
    if (!scene_lighting_create(&surfaces->lighting, surfaces->model, camera, SCENE_AXIS_Y, true, 0.0)) {
        return false;
    }
    scene_frame_look(&surfaces->frame, camera, aspect, &surfaces->lighting, surfaces->view_projection);
    surfaces->frame.samples = 1.0f;
    if (surfaces->is_glass) {
        surfaces->frame.backdrop_levels = (float)(scene->textures[scene->texture_count - 1].levels - 1);
    }
    surfaces->frame_uniforms = make_frame_uniforms(&surfaces->frame);
    surfaces->frame_uniforms.backdrop_levels = surfaces->frame.backdrop_levels;
    if (surfaces->is_shadowed) {
        cast_shadows(surfaces, camera);
    }
    if (surfaces->is_glass) {
        surfaces->light_frame = surfaces->frame;
        surfaces->light_frame.display_slot = -1;
        surfaces->light_frame.linear_slot = 0;
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

// The power of two that is nearest to a side of the picture: of odd sides each API makes levels in its own way.
static int power_of_two(int side)
{
    int power = 1;
    while (3 * power < 2 * side) {
        power *= 2;
    }
    return power;
}

// A chain down to one texel.
static struct bench_texture seen_through(int width, int height)
{
    const int side[2] = {power_of_two(width), power_of_two(height)};
    int levels = 1;
    while ((side[0] > side[1] ? side[0] : side[1]) >> levels > 0) {
        levels++;
    }
    return (struct bench_texture){.width = side[0],
                                  .height = side[1],
                                  .levels = levels,
                                  .format = BENCH_RGBA16F,
                                  .filter = BENCH_LEVELS,
                                  .target = true};
}

static void make_passes(struct bench_scene *scene, int width, int height)
{
    const int map = (int)scene->texture_count - 1; // or what is seen through glass
    const struct bench_surfaces *const surfaces = scene->surfaces;
    scene->passes[scene->pass_count - 1] =
        (struct bench_pass){.color_count = 1, .colors = {BENCH_PICTURE}, .depth = BENCH_PASS_DEPTH};
    if (surfaces->is_glass) {
        scene->passes[0] = (struct bench_pass){
            .color_count = 1, .colors = {map}, .depth = BENCH_PASS_DEPTH, .makes_levels = true};
        scene->textures[map] = seen_through(width, height);
    }
    if (surfaces->is_shadowed) {
        scene->passes[0] = (struct bench_pass){.depth = BENCH_PASS_DEPTH_KEPT, .depth_texture = map};
        scene->textures[map] = (struct bench_texture){.width = SCENE_SHADOW_SIZE,
                                                      .height = SCENE_SHADOW_SIZE,
                                                      .levels = 1,
                                                      .format = BENCH_D32F,
                                                      .filter = BENCH_FETCH,
                                                      .target = true};
    }
}

static struct scene_model *load_model(const struct bench_scene_entry *entry, char *why, size_t why_size)
{
    switch (entry->variant) {
    case BENCH_PBR_HAIR: return bench_make_hair(why, why_size);
    case BENCH_PBR_GLASS: return bench_make_glass(why, why_size);
    case BENCH_PBR_HELMET:
    case BENCH_PBR_HELMET_SHADOWED: return bench_model_load(helmet_path, why, why_size);
    default: return bench_model_load(bench_sponza_path, why, why_size);
    }
}

bool bench_make_pbr(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                    char *why, size_t why_size)
{
    const bool shadowed =
        entry->variant == BENCH_PBR_HELMET_SHADOWED || entry->variant == BENCH_PBR_SPONZA_SHADOWED;
    const bool sponza = entry->variant == BENCH_PBR_SPONZA || entry->variant == BENCH_PBR_SPONZA_SHADOWED;
    const bool glass = entry->variant == BENCH_PBR_GLASS, before = shadowed || glass;
    const double aspect = (double)width / (double)height;
    scene->surfaces = calloc(1, sizeof *scene->surfaces);
    struct scene_model *const model = scene->surfaces ? load_model(entry, why, why_size) : NULL;
    if (!model) {
        return false;
    }
    scene->surfaces->model = model;
    const struct scene_camera camera =
        sponza ? bench_sponza_camera
               : scene_camera_fit(model, scene_camera_default_orbit(model, SCENE_AXIS_Y),
                                  scene_camera_default_yfov(), aspect);
    scene->mesh_count = model->mesh_count;
    scene->texture_count = 2 * model->image_count + before;
    scene->draw_count = model->instance_count * (before ? 2 : 1);
    scene->pass_count = before ? 2 : 1;
    scene->surfaces->is_shadowed = shadowed;
    scene->surfaces->is_glass = glass;
    scene->unit = BENCH_TRIANGLES;
    scene->work = (double)model->triangles_drawn;
    // Quads of pixels give the peer its derivatives, which at edges are of no surface: there its penumbras differ.
    scene->tolerance = (struct bench_tolerance){.color = 6, .outliers = shadowed ? 5e-3 : 5e-4};
    bool works = bench_scene_allocate(scene);
    if (works) {
        make_passes(scene, width, height);
    }
    works =
        works && look(scene, &camera, aspect) && sort_blended(scene->surfaces) && make_textures(scene, model);
    for (uint32_t i = 0; works && i < scene->mesh_count; i++) {
        works = make_mesh(&model->meshes[i], &scene->meshes[i]);
    }
    if (works && !make_draws(scene, &camera, aspect)) {
        snprintf(why, why_size, "a material or an instance that no shader of the scene is for");
        return false;
    }
    return works;
}
