// SPDX-License-Identifier: MIT
// See scene_model.h. A file that this machine lacks is no failure of the benchmark: the scene is left out,
// with a line that says where it was looked for.
#include "scene_model.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char bunny_path[] = "/usr/share/glmark2/models/bunny.obj"; // Debian: glmark2-data

static void copy_vertices(const struct rhw_mesh *from, struct bench_mesh *to)
{
    float *out = to->vertices;
    for (uint32_t v = 0; v < from->vertex_count; v++) {
        memcpy(out, from->positions[v], sizeof from->positions[v]);
        out += 3;
        if (to->has[BENCH_NORMAL]) {
            memcpy(out, from->normals[v], sizeof from->normals[v]);
            out += 3;
        }
        if (to->has[BENCH_UV]) {
            memcpy(out, from->uvs[0] ? from->uvs[0][v] : (const float[2]){0}, 2 * sizeof *out);
            out += 2;
        }
    }
    memcpy(to->indices, from->indices, (size_t)from->index_count * sizeof *to->indices);
}

// The file's one mesh, from the front, a little from above.
static bool make_bunny(struct bench_scene *scene, const struct rhw_model *model, bool depth_only,
                       double aspect)
{
    const struct rhw_mesh *const source = &model->meshes[0];
    const struct rhw_camera camera =
        rhw_camera_fit(model, (struct rhw_orbit){.azimuth = 0.0, .elevation = 10.0}, 0.5, aspect);
    scene->mesh_count = scene->draw_count = 1;
    scene->depth_test = true;
    scene->has_color = !depth_only;
    scene->unit = BENCH_TRIANGLES;
    scene->work = source->index_count / 3;
    scene->tolerance = (struct bench_tolerance){
        .color = 2,
        .outliers = 0.002,
        .depth = 1e-5,
        .reason = "vertices that fall between two subpixel positions are snapped to either",
    };
    if (!bench_scene_allocate(scene)) {
        return false;
    }
    struct bench_mesh *const mesh = &scene->meshes[0];
    mesh->has[BENCH_POSITION] = true;
    mesh->has[BENCH_NORMAL] = !depth_only;
    if (!bench_mesh_allocate(mesh, source->vertex_count, source->index_count)) {
        return false;
    }
    copy_vertices(source, mesh);
    double world[16];
    for (int i = 0; i < 16; i++) {
        world[i] = (double)model->instances[0].world[i];
    }
    scene->draws[0] = (struct bench_draw){.shader = depth_only ? BENCH_SHADER_DEPTH : BENCH_SHADER_LIT,
                                          .texture = -1,
                                          .cull_back = true,
                                          .uniforms = bench_look(&camera, aspect, world)};
    const float color[4] = {0.75f, 0.65f, 0.55f, 1.0f};
    memcpy(scene->draws[0].uniforms.color, color, sizeof color);
    return true;
}

bool bench_make_model(const struct bench_scene_entry *entry, struct bench_scene *scene, int width, int height,
                      char *why, size_t why_size)
{
    char error[256];
    if (access(bunny_path, R_OK) != 0) {
        snprintf(why, why_size, "there is no %s", bunny_path);
        return false;
    }
    struct rhw_model *const model = rhw_model_load(bunny_path, NULL, error, sizeof error);
    if (!model || model->instance_count == 0) {
        snprintf(why, why_size, "%s: %s", bunny_path, model ? "nothing to draw" : error);
        rhw_model_free(model);
        return false;
    }
    const bool made =
        make_bunny(scene, model, entry->variant == BENCH_MODEL_BUNNY_DEPTH, (double)width / (double)height);
    rhw_model_free(model);
    return made;
}
