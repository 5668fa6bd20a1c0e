// SPDX-License-Identifier: MIT
#include "material_program.h"

#include "rhw/bind.h"
#include "rhw/spirv.h"

#include <stdlib.h>
#include <string.h>

enum { OWN_BUFFER, DEFAULTS_BUFFER };

// What the frame of a draw points to until its pass has run.
struct scene_program_item {
    struct rhw_binding bindings[SCENE_PROGRAM_BINDINGS];
    struct scene_program_block block;
    struct scene_program_place place;
};

static const struct {
    float normal[4], uv[4], color[4];
} defaults = {{0.0f, 0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f, 1.0f}};

static const struct {
    enum rhw_vertex_format format;
    uint32_t offset;
} absent[SCENE_PROGRAM_ATTRIBUTES] = {
    [SCENE_PROGRAM_NORMAL] = {RHW_VERTEX_FLOAT3, 0},
    [SCENE_PROGRAM_UV] = {RHW_VERTEX_FLOAT2, sizeof defaults.normal},
    [SCENE_PROGRAM_COLOR] = {RHW_VERTEX_FLOAT4, sizeof defaults.normal + sizeof defaults.uv}};

// What does not depend on the model.
static enum rhw_result make_defaults(rhw_context *context, struct scene_program_draws *draws)
{
    struct rhw_buffer_def buffer = rhw_buffer_def_default();
    buffer.size = sizeof defaults;
    buffer.data = &defaults;
    struct rhw_texture_def texture = rhw_texture_def_default();
    texture.format = RHW_FORMAT_RGBA8_UNORM;
    texture.width = texture.height = 1;
    const struct rhw_sampler_def sampler = rhw_sampler_def_default();
    const uint8_t white[4] = {255, 255, 255, 255};
    enum rhw_result result = rhw_buffer_create(context, &buffer, &draws->defaults);
    if (result == RHW_OK) {
        result = rhw_texture_create(context, &texture, &draws->white);
    }
    if (result == RHW_OK) {
        result = rhw_texture_write(context, draws->white, 0, white, sizeof white);
    }
    return result == RHW_OK ? rhw_sampler_create(context, &sampler, &draws->sampler) : result;
}

enum rhw_result scene_program_prepare(struct scene_program_draws *draws, const struct scene_upload *upload,
                                      const struct rhw_program *program)
{
    draws->program = program;
    if (program && upload->model->instance_count > draws->count) {
        free(draws->items);
        draws->count = upload->model->instance_count;
        draws->items = calloc(draws->count, sizeof *draws->items);
        draws->count = draws->items ? draws->count : 0;
        if (!draws->items) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
    }
    return program && !draws->sampler.generation ? make_defaults(upload->context, draws) : RHW_OK;
}

void scene_program_destroy(rhw_context *context, struct scene_program_draws *draws)
{
    rhw_sampler_destroy(context, draws->sampler);
    rhw_texture_destroy(context, draws->white);
    rhw_buffer_destroy(context, draws->defaults);
    free(draws->items);
    *draws = (struct scene_program_draws){0};
}

// Layout --------------------------------------------------------------------------------------------

static const struct scene_material *material_of(const struct scene_upload *upload, uint32_t instance)
{
    return &upload->model->materials[upload->model->meshes[upload->model->instances[instance].mesh].material];
}

static const struct scene_texture_slot *base_color_of(const struct scene_material *material)
{
    return &material->slots[SCENE_SLOT_BASE_COLOR];
}

bool scene_program_lay_out(const struct scene_upload *upload, const struct scene_surface_pass *def,
                           uint32_t instance, struct scene_surface_key *key)
{
    const struct scene_uploaded_mesh *const mesh = &upload->meshes[upload->model->instances[instance].mesh];
    const struct scene_material *const material = material_of(upload, instance);
    const bool is_color = !def->data_outputs && !def->shadow && !def->frame->plain;
    if (!def->program || !def->program->program || !is_color || mesh->kind != SCENE_VERTEX_SURFACE ||
        material->is_ground || scene_material_transmits(material)) {
        return false;
    }
    const struct scene_texture_slot *const base = base_color_of(material);
    const int own[SCENE_PROGRAM_ATTRIBUTES] = {[SCENE_PROGRAM_NORMAL] = mesh->normal,
                                               [SCENE_PROGRAM_UV] =
                                                   mesh->uv[base->image >= 0 ? base->uv_set : 0],
                                               [SCENE_PROGRAM_COLOR] = mesh->color};
    key->program = 1;
    key->fragment = SCENE_FRAGMENT_NONE;
    key->varying_count = key->stream_count = 0;
    key->attribute_count = SCENE_PROGRAM_ATTRIBUTES;
    for (int i = 0; i < SCENE_PROGRAM_ATTRIBUTES; i++) {
        const bool is_absent = own[i] < 0;
        const struct rhw_attribute *const attribute = is_absent ? NULL : &mesh->attributes[own[i]];
        key->absent |= is_absent ? 1 << i : 0;
        key->attributes[i][0] = (int32_t)(is_absent ? absent[i].format : attribute->format);
        key->attributes[i][1] = (int32_t)(is_absent ? absent[i].offset : attribute->offset);
    }
    return true;
}

void scene_program_describe(const struct scene_surface_key *key, const struct rhw_program *program,
                            struct rhw_pipeline_def *def)
{
    const struct rhw_blend_component over = {RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA,
                                             RHW_BLEND_ADD};
    def->program = *program;
    for (int i = 0; i < key->attribute_count; i++) {
        def->attributes[i].buffer = key->absent >> i & 1 ? DEFAULTS_BUFFER : OWN_BUFFER;
    }
    def->buffer_count = 2;
    def->buffers[DEFAULTS_BUFFER] = (struct rhw_vertex_layout){.constant = true};
    // The colours of the program are not premultiplied, and count as opaque where their material is.
    def->alpha_to_one = !key->blend;
    for (int i = 0; i < def->target_count; i++) {
        def->targets[i].color = over;
        def->targets[i].alpha = (struct rhw_blend_component){RHW_BLEND_ONE, over.dst, RHW_BLEND_ADD};
    }
}

// What a draw has -----------------------------------------------------------------------------------

static void set_block(struct scene_program_block *block, const struct scene_frame *frame,
                      const struct scene_surface *surface)
{
    const bool has_light = frame->light_count > 0;
    const struct scene_shader_light *const light = frame->lights;
    const bool is_far = !has_light || light->type == SCENE_LIGHT_DIRECTIONAL;
    *block = (struct scene_program_block){.alpha_cutoff = surface->alpha_cutoff,
                                          .metallic = surface->metallic,
                                          .roughness = surface->roughness};
    for (int c = 0; c < 3; c++) {
        block->camera[c] = frame->orthographic ? -frame->forward[c] : frame->eye[c];
        block->light[c] = !has_light ? -frame->forward[c] : is_far ? light->direction[c] : light->position[c];
        block->light_color[c] = has_light ? light->color[c] : 0.0f;
        block->emissive[c] = surface->emissive[c];
    }
    block->camera[3] = frame->orthographic ? 0.0f : 1.0f;
    block->light[3] = is_far ? 0.0f : 1.0f;
    memcpy(block->base_color, surface->base_color, sizeof block->base_color);
}

static void set_place(struct scene_program_place *place, const struct scene_surface *surface,
                      const struct scene_instance *instance, const struct scene_texture_slot *base)
{
    static const float identity[6] = {1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f};
    const float *const transform = base->image >= 0 ? base->transform : identity;
    *place = (struct scene_program_place){.clip = {0.0f}};
    memcpy(place->clip, surface->clip, sizeof place->clip);
    memcpy(place->world, instance->world, sizeof place->world);
    for (int c = 0; c < 3; c++) {
        memcpy(&place->normal[4 * c], &surface->normal[3 * c], 3 * sizeof(float));
    }
    for (int r = 0; r < 2; r++) {
        memcpy(place->uv[r], &transform[3 * r], 3 * sizeof(float));
    }
}

enum rhw_result scene_program_bind(const struct scene_upload *upload, const struct scene_surface_pass *def,
                                   rhw_pass pass, uint32_t instance, const struct scene_surface *surface)
{
    const struct scene_program_draws *const draws = def->program;
    const uint32_t mesh = upload->model->instances[instance].mesh;
    const struct scene_uploaded_slot *const base =
        &upload->materials[upload->model->meshes[mesh].material].slots[SCENE_SLOT_BASE_COLOR];
    const bool is_textured = base->texture.generation != 0;
    struct scene_program_item *const item = &draws->items[instance];
    set_block(&item->block, def->frame, surface);
    set_place(&item->place, surface, &upload->model->instances[instance],
              base_color_of(material_of(upload, instance)));
    (void)rhw_binding_of_memory(&item->block, sizeof item->block, true, &item->bindings[SCENE_PROGRAM_BLOCK]);
    const enum rhw_result result = rhw_binding_of_texture(
        upload->context, is_textured ? base->texture : draws->white,
        is_textured ? base->sampler : draws->sampler, &item->bindings[SCENE_PROGRAM_BASE_COLOR]);
    const struct rhw_shader_frame frame = {
        .sets = {item->bindings}, .push_constants = &item->place, .push_size = sizeof item->place};
    rhw_pass_set_vertex_buffer(upload->context, pass, DEFAULTS_BUFFER, draws->defaults, 0);
    rhw_pass_set_uniforms(upload->context, pass, &frame, sizeof frame);
    return result;
}
