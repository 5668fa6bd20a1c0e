// SPDX-License-Identifier: MIT
// Instances to draws: their order, their pipelines, and how they are recorded.
#include "surface.h"

#include "draw/camera/camera_math.h"
#include "light.h"
#include "material_program.h"
#include "surface_layout.h"

#include <stdlib.h>
#include <string.h>

// View ----------------------------------------------------------------------------------------------

void scene_frame_look(struct scene_frame *frame, const struct scene_camera *camera, double aspect,
                      const struct scene_lighting *lighting, double view_projection[16])
{
    double matrix[16], projection[16];
    scene_camera_view(camera, matrix);
    scene_camera_projection(camera, aspect, projection);
    for (int c = 0; c < 4; c++) {
        projection[4 * c + 2] = projection[4 * c + 3] - projection[4 * c + 2];
    }
    scene_matrix_multiply(projection, matrix, view_projection);
    for (int i = 0; i < 3; i++) {
        frame->eye[i] = (float)camera->eye[i];
        frame->forward[i] = (float)-matrix[4 * i + 2];
    }
    for (int i = 0; i < 16; i++) {
        frame->view_projection[i] = (float)view_projection[i];
    }
    // All that is seen lies between a depth of znear and, without a limit, many powers of two more.
    frame->unit = scene_unit_for(0x1p30 * camera->znear);
    frame->linear_slot = -1;
    frame->orthographic = camera->orthographic;
    frame->light_count = (int32_t)lighting->count;
    frame->lights = lighting->lights;
    frame->environment = lighting->environment;
}

// Order ---------------------------------------------------------------------------------------------

static int compare_items(const void *left, const void *right)
{
    const struct scene_surface_item *a = left, *b = right;
    if (a->blended != b->blended) {
        return a->blended ? 1 : -1;
    }
    if (a->distance < b->distance || a->distance > b->distance) {
        const int nearer = a->distance < b->distance ? -1 : 1;
        return a->blended ? -nearer : nearer;
    }
    return a->instance < b->instance ? -1 : a->instance > b->instance;
}

void scene_surface_items_sort(struct scene_surface_item *items, size_t count)
{
    qsort(items, count, sizeof *items, compare_items);
}

// Along the view, of the middle of the instance's box. Lower is nearer; for an orthographic camera too.
static double item_distance(const struct scene_frame *frame, const struct scene_instance *instance,
                            const struct scene_mesh *mesh)
{
    double distance = 0.0;
    for (int r = 0; r < 3; r++) {
        double place = (double)instance->world[12 + r] - (double)frame->eye[r];
        for (int c = 0; c < 3; c++) {
            const double middle = 0.5 * ((double)mesh->bounds_min[c] + (double)mesh->bounds_max[c]);
            place += (double)instance->world[4 * c + r] * middle;
        }
        distance += place * (double)frame->forward[r];
    }
    // A box whose bounds overflow has no middle; NaN would leave the order to the sort's whim.
    return distance - distance == 0.0 ? distance : 0.0;
}

size_t scene_surface_items_list(const struct scene_model *model, const struct scene_frame *frame, bool blends,
                                struct scene_surface_item *items)
{
    size_t count = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        const struct scene_mesh *mesh = &model->meshes[model->instances[i].mesh];
        if (mesh->vertex_count == 0 || mesh->index_count == 0) {
            continue;
        }
        const bool blend = model->materials[mesh->material].alpha_mode == SCENE_ALPHA_BLEND;
        items[count++] =
            (struct scene_surface_item){.instance = i,
                                        .blended = blends && blend,
                                        .distance = item_distance(frame, &model->instances[i], mesh)};
    }
    scene_surface_items_sort(items, count);
    return count;
}

// Pipelines -----------------------------------------------------------------------------------------

static struct rhw_pipeline_def pipeline_def(const struct scene_surface_key *key)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    scene_program_surface(&def.program, (enum scene_vertex_kind)key->vertex,
                          (enum scene_fragment_kind)key->fragment);
    def.program.uses = (uint32_t)key->uses;
    def.program.varying_count = key->varying_count;
    for (int i = 0; i < key->varying_count; i++) {
        def.program.varyings[i] =
            (struct rhw_varying){.components = key->varyings[i],
                                 .qualifier = (enum rhw_qualifier)key->interpolate,
                                 .derivatives = i >= key->varying_count - key->stream_count ||
                                                (key->position_derivatives && i + 1 == key->position_number)};
    }
    def.attribute_count = key->attribute_count;
    for (int i = 0; i < key->attribute_count; i++) {
        def.attributes[i].format = (enum rhw_vertex_format)key->attributes[i][0];
        def.attributes[i].buffer = 0;
        def.attributes[i].offset = (uint32_t)key->attributes[i][1];
    }
    def.buffer_count = 1;
    def.buffers[0].stride = (uint32_t)key->stride;
    def.cull = (enum rhw_cull)key->cull;
    def.front = (enum rhw_winding)key->front;
    def.depth_test = !key->counts;
    // It is drawn before all else, and reaches beyond the planes that enclose the model.
    def.depth_clip_disabled = key->ground != 0;
    def.depth_compare = key->ground ? RHW_COMPARE_GREATER_EQUAL
                        : key->peel ? RHW_COMPARE_LESS
                                    : RHW_COMPARE_GREATER;
    def.depth_read_only = key->blend != 0;
    def.target_count = key->format_count;
    for (int i = 0; i < key->format_count; i++) {
        struct rhw_color_target *target = &def.targets[i];
        target->format = (enum rhw_format)key->formats[i];
        target->blend = key->blend || key->counts;
        // The shader's colours are premultiplied.
        const struct rhw_blend_component over = {RHW_BLEND_ONE, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
        const struct rhw_blend_component sum = {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
        if (target->blend) {
            target->color = target->alpha = key->counts ? sum : over;
        }
    }
    return def;
}

static enum rhw_result find_pipeline(rhw_context *context, struct scene_surface_pipelines *pipelines,
                                     const struct scene_surface_key *key, const struct rhw_program *program,
                                     rhw_pipeline *pipeline)
{
    for (uint32_t i = 0; i < pipelines->count; i++) {
        if (memcmp(&pipelines->keys[i], key, sizeof *key) == 0) {
            *pipeline = pipelines->ids[i];
            return RHW_OK;
        }
    }
    if (pipelines->count == pipelines->capacity) {
        const uint32_t capacity = pipelines->capacity ? 2 * pipelines->capacity : 16;
        struct scene_surface_key *keys = realloc(pipelines->keys, capacity * sizeof *keys);
        pipelines->keys = keys ? keys : pipelines->keys;
        rhw_pipeline *ids = keys ? realloc(pipelines->ids, capacity * sizeof *ids) : NULL;
        pipelines->ids = ids ? ids : pipelines->ids;
        if (!keys || !ids) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
        pipelines->capacity = capacity;
    }
    struct rhw_pipeline_def def = pipeline_def(key);
    if (key->program) {
        scene_program_describe(key, program, &def);
    }
    const enum rhw_result result = rhw_pipeline_create(context, &def, pipeline);
    if (result == RHW_OK) {
        pipelines->keys[pipelines->count] = *key;
        pipelines->ids[pipelines->count++] = *pipeline;
    }
    return result;
}

void scene_surface_pipelines_destroy(rhw_context *context, struct scene_surface_pipelines *pipelines)
{
    for (uint32_t i = 0; i < pipelines->count; i++) {
        rhw_pipeline_destroy(context, pipelines->ids[i]);
    }
    free(pipelines->keys);
    free(pipelines->ids);
    *pipelines = (struct scene_surface_pipelines){0};
}

// Recording -----------------------------------------------------------------------------------------

// Set what the built-in shaders read.
static void bind_material(const struct scene_upload *upload, const struct scene_surface_pass *def,
                          rhw_pass pass, uint32_t mesh, const struct scene_surface *surface)
{
    rhw_context *context = upload->context;
    const struct scene_uploaded_material *material = &upload->materials[upload->model->meshes[mesh].material];
    rhw_pass_set_uniforms(context, pass, surface, sizeof *surface);
    for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
        if (surface->slot_varying[s] >= 0) {
            rhw_pass_set_texture(context, pass, surface->slot_unit[s], material->slots[s].texture,
                                 material->slots[s].sampler);
        }
    }
    if (surface->layers && def->backdrop.generation) {
        rhw_pass_set_texture(context, pass, SCENE_SLOT_BACKDROP, def->backdrop, def->backdrop_sampler);
    }
    if (def->environment.generation) {
        rhw_pass_set_texture(context, pass, SCENE_SLOT_ENVIRONMENT, def->environment,
                             def->environment_sampler);
    }
    if (def->frame->peel_samples > 0) {
        rhw_pass_set_texture(context, pass, surface->peel_unit, def->peeled, def->peeled_sampler);
    }
}

static enum rhw_result record_instance(const struct scene_upload *upload,
                                       struct scene_surface_pipelines *pipelines,
                                       const struct scene_surface_pass *def, rhw_pass pass, uint32_t instance)
{
    rhw_context *context = upload->context;
    struct scene_surface surface;
    struct scene_surface_key key;
    scene_surface_lay_out(upload, def, instance, &surface, &key);
    const uint32_t mesh_index = upload->model->instances[instance].mesh;
    const struct scene_uploaded_mesh *mesh = &upload->meshes[mesh_index];
    rhw_pass_set_vertex_buffer(context, pass, 0, mesh->vertices, 0);
    rhw_pass_set_index_buffer(context, pass, mesh->indices, RHW_INDEX_UINT32, 0);
    enum rhw_result result = RHW_OK;
    if (scene_program_lay_out(upload, def, instance, &key)) {
        result = scene_program_bind(upload, def, pass, instance, &surface);
    } else {
        bind_material(upload, def, pass, mesh_index, &surface);
    }
    const rhw_buffer sorted = key.blend ? scene_triangle_order_of(def->order, instance) : (rhw_buffer){0};
    if (sorted.generation) {
        rhw_pass_set_index_buffer(context, pass, sorted, RHW_INDEX_UINT32, 0);
    }
    // A blended surface with two sides shows its far side through the near one: far side first.
    const bool twice = key.blend && !sorted.generation && key.cull == RHW_CULL_NONE && surface.is_triangle;
    for (int side = twice ? 0 : 1; side < 2 && result == RHW_OK; side++) {
        if (twice) {
            key.cull = side == 0 ? RHW_CULL_FRONT : RHW_CULL_BACK;
        }
        rhw_pipeline pipeline;
        result =
            find_pipeline(context, pipelines, &key, def->program ? def->program->program : NULL, &pipeline);
        if (result != RHW_OK) {
            return result;
        }
        rhw_pass_set_pipeline(context, pass, pipeline);
        rhw_pass_draw_indexed(context, pass, 0, mesh->index_count, 0, 0, 1);
        if (def->log && !scene_draw_log_add(def->log, (int32_t)instance, &surface)) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
    }
    return result;
}

// Whether a pass draws what is blended or not, and what light passes through or not.
static bool is_of_part(const struct scene_surface_pass *def, enum scene_vertex_kind kind, bool blended,
                       bool transmits)
{
    const bool is_surface = kind == SCENE_VERTEX_SURFACE;
    if (def->part == SCENE_SURFACES_GLASS) {
        return transmits && is_surface;
    }
    if ((def->part == SCENE_SURFACES_OPAQUE && blended) ||
        ((def->part == SCENE_SURFACES_PEELED || def->part == SCENE_SURFACES_BLENDED) && !blended)) {
        return false;
    }
    // Lines and points cast no shadow: they have no extent in the world.
    return !(def->shadow && !is_surface) && !((def->shadow || def->solid) && transmits);
}

enum rhw_result scene_surfaces_record(const struct scene_upload *upload,
                                      struct scene_surface_pipelines *pipelines,
                                      const struct scene_surface_pass *def, rhw_pass pass)
{
    const struct scene_model *model = upload->model;
    struct scene_surface_item *items = malloc(((size_t)model->instance_count + 1) * sizeof *items);
    if (!items) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    const bool blends = !def->data_outputs && !def->shadow && !def->frame->plain;
    const size_t count = scene_surface_items_list(model, def->frame, blends, items);
    enum rhw_result result = RHW_OK;
    for (size_t i = 0; i < count && result == RHW_OK; i++) {
        const uint32_t mesh = model->instances[items[i].instance].mesh;
        const bool transmits = scene_material_transmits(&model->materials[model->meshes[mesh].material]);
        if (is_of_part(def, upload->meshes[mesh].kind, items[i].blended, transmits)) {
            result = record_instance(upload, pipelines, def, pass, items[i].instance);
        }
    }
    free(items);
    return result;
}
