// SPDX-License-Identifier: MIT
// See scene_model.h. A file that this machine lacks is no failure of the benchmark: the scene is left out,
// with a line that says where it was looked for. Colours are drawn as the texels stand in the file, without
// conversion between sRGB and linear light: both renderers would do that alike, and the shading is no physics.
#include "scene_model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char bench_bunny_path[] = "/usr/share/glmark2/models/bunny.obj"; // Debian: glmark2-data

const char bench_sponza_path[] = "gltf/sponza/Sponza.gltf";

const struct scene_camera bench_sponza_camera = {
    .eye = {6.8, 2.2, -0.5},
    .target = {0.0, 3.2, -0.1},
    .up = {0.0, 1.0, 0.0},
    .yfov = 1.0,
    .znear = 0.1,
    .zfar = 50.0,
};

static void copy_vertices(const struct scene_mesh *from, const struct scene_material *material,
                          struct bench_mesh *to)
{
    const float *const t = material->slots[SCENE_SLOT_BASE_COLOR].transform;
    float *out = to->vertices;
    for (uint32_t v = 0; v < from->vertex_count; v++) {
        memcpy(out, from->positions[v], sizeof from->positions[v]);
        out += 3;
        if (to->has[BENCH_NORMAL]) {
            memcpy(out, from->normals[v], sizeof from->normals[v]);
            out += 3;
        }
        if (to->has[BENCH_UV]) {
            const float *const uv = from->uvs[0][v];
            *out++ = t[0] * uv[0] + t[1] * uv[1] + t[2];
            *out++ = t[3] * uv[0] + t[4] * uv[1] + t[5];
        }
    }
    memcpy(to->indices, from->indices, (size_t)from->index_count * sizeof *to->indices);
}

static bool make_texture(const struct scene_image *image, struct bench_texture *texture)
{
    if (image->type != SCENE_IMAGE_RGBA8 ||
        !bench_texture_allocate(texture, (int)image->width, (int)image->height)) {
        return false;
    }
    memcpy(texture->texels[0], image->texels, image->size);
    bench_texture_fill_mips(texture);
    return true;
}

static struct bench_draw make_draw(const struct scene_model *model, const struct scene_instance *instance,
                                   const struct scene_camera *camera, double aspect)
{
    const struct scene_material *const material = &model->materials[model->meshes[instance->mesh].material];
    const struct scene_texture_slot *const base = &material->slots[SCENE_SLOT_BASE_COLOR];
    double world[16];
    for (int i = 0; i < 16; i++) {
        world[i] = (double)instance->world[i];
    }
    struct bench_draw draw = {.shader = BENCH_SHADER_LIT,
                              .depth = BENCH_DEPTH_LESS,
                              .mesh = instance->mesh,
                              .cull_back = !material->double_sided,
                              .uniforms = bench_look(camera, aspect, world)};
    if (base->image >= 0 && model->meshes[instance->mesh].uvs[0]) {
        draw.texture_count = 1;
        draw.textures[0] = (uint32_t)base->image;
        draw.shader =
            material->alpha_mode == SCENE_ALPHA_MASK ? BENCH_SHADER_LIT_MASKED : BENCH_SHADER_LIT_TEXTURE;
    }
    draw.uniforms.cutoff = material->alpha_cutoff;
    return draw;
}

// Every instance a draw, in the order of the file. Images that no base colour uses stay empty.
static bool make_scene(struct bench_scene *scene, const struct scene_model *model,
                       const struct scene_camera *camera, double aspect)
{
    scene->mesh_count = model->mesh_count;
    scene->texture_count = model->image_count;
    scene->draw_count = model->instance_count;
    scene->unit = BENCH_TRIANGLES;
    scene->work = (double)model->triangles_drawn;
    if (!bench_scene_allocate(scene)) {
        return false;
    }
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        scene->draws[i] = make_draw(model, &model->instances[i], camera, aspect);
        const uint32_t image = scene->draws[i].textures[0];
        if (scene->draws[i].texture_count && !scene->textures[image].texels[0] &&
            !make_texture(&model->images[image], &scene->textures[image])) {
            return false;
        }
    }
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        const struct scene_mesh *const source = &model->meshes[i];
        struct bench_mesh *const mesh = &scene->meshes[i];
        mesh->has[BENCH_POSITION] = true;
        mesh->has[BENCH_NORMAL] = scene->has_color;
        mesh->has[BENCH_UV] = scene->has_color && source->uvs[0] && model->image_count;
        if (!bench_mesh_allocate(mesh, source->vertex_count, source->index_count)) {
            return false;
        }
        copy_vertices(source, &model->materials[source->material], mesh);
    }
    return true;
}

// From the front, a little from above, as large as it fits; 29,000 triangles face the eye.
static bool make_bunny(struct bench_scene *scene, const struct scene_model *model, bool depth_only,
                       double aspect)
{
    const struct scene_camera camera =
        scene_camera_fit(model, (struct scene_orbit){.azimuth = 0.0, .elevation = 10.0}, 0.5, aspect);
    scene->has_color = !depth_only;
    scene->tolerance = (struct bench_tolerance){.outliers = 5e-5, .depth = 1e-3};
    if (!make_scene(scene, model, &camera, aspect)) {
        return false;
    }
    const float color[4] = {0.75f, 0.65f, 0.55f, 1.0f};
    memcpy(scene->draws[0].uniforms.color, color, sizeof color);
    scene->draws[0].cull_back = true; // as a scan is drawn; the format says nothing of sides
    if (depth_only) {
        scene->draws[0].shader = BENCH_SHADER_DEPTH;
    }
    return true;
}

static bool make_sponza(struct bench_scene *scene, const struct scene_model *model, double aspect)
{
    // Where a texel stands near the cutoff of the alpha test, either side of it is right.
    // One sample of four may lie on the other side of an edge.
    scene->tolerance = (struct bench_tolerance){.color = scene->samples > 1 ? 64 : 6, .outliers = 5e-4};
    return make_scene(scene, model, &bench_sponza_camera, aspect);
}

bool bench_model_find(const char *file, char *path, size_t size, char *why, size_t why_size)
{
    const char *const folder = getenv("RHW_MODELS");
    const bool absolute = file[0] == '/';
    if (absolute) {
        snprintf(path, size, "%s", file);
    } else {
        snprintf(path, size, "%s/%s", folder ? folder : "../shared/models", file);
    }
    if (access(path, R_OK) != 0) {
        snprintf(why, why_size, "there is no %.300s%s", path,
                 absolute ? "" : "; RHW_MODELS names the folder of models");
        return false;
    }
    return true;
}

struct scene_model *bench_model_load(const char *file, char *why, size_t why_size)
{
    char path[4096], error[256];
    if (!bench_model_find(file, path, sizeof path, why, why_size)) {
        return NULL;
    }
    struct scene_model *const model = scene_model_load(path, NULL, error, sizeof error);
    if (!model || model->instance_count == 0) {
        snprintf(why, why_size, "%.300s: %s", path, model ? "nothing to draw" : error);
        scene_model_free(model);
        return NULL;
    }
    return model;
}

bool bench_make_model(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size)
{
    const double aspect = (double)width / (double)height;
    const bool bunny = entry->variant <= BENCH_MODEL_BUNNY_DEPTH;
    scene->samples = entry->variant == BENCH_MODEL_SPONZA_SAMPLES ? 4 : 0;
    struct scene_model *const model =
        bench_model_load(bunny ? bench_bunny_path : bench_sponza_path, why, why_size);
    if (!model) {
        return false;
    }
    const bool made = bunny ? make_bunny(scene, model, entry->variant == BENCH_MODEL_BUNNY_DEPTH, aspect)
                            : make_sponza(scene, model, aspect);
    scene_model_free(model);
    return made;
}
