// SPDX-License-Identifier: MIT
// Draws a frame with the library.
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "renderers.h"
#include "texel_pair.h"

struct here {
    rhw_context *context;
    const struct frame *frame;
    rhw_texture targets[FRAME_TARGETS], depth, textures[FRAME_TEXTURES], image;
    rhw_sampler samplers[FRAME_TEXTURES];
    rhw_buffer vertices, indices, instances, numbers;
    rhw_query queries[FRAME_DRAWS];
    rhw_pass pass;
    bool ok;
};

static unsigned char texels[FRAME_SIDE * FRAME_SIDE * 16];

static void keep(struct here *h, enum rhw_result result)
{
    h->ok = h->ok && result == RHW_OK;
}

// What every pair does with a vertex.
static void place(struct rhw_vertex1 *v)
{
    const float *const position = v->attribute[0], *const value = v->attribute[1],
                       *const instance = v->attribute[2];
    v->position[0] = position[0] + instance[0];
    v->position[1] = position[1] + instance[1];
    v->position[2] = position[2];
    v->position[3] = position[3];
    v->point_size = value[3];
    for (int c = 0; c < 4; c++) {
        v->varying[c] = v->varying[4 + c] = value[c];
        v->varying[8 + c] = instance[c];
    }
}

static rhw_buffer make_buffer(struct here *h, const void *data, size_t size)
{
    const struct rhw_buffer_def def = {.size = size ? size : 4, .data = size ? data : NULL};
    rhw_buffer buffer = {0};
    keep(h, rhw_buffer_create(h->context, &def, &buffer));
    return buffer;
}

static void make_texture(struct here *h, int i)
{
    const struct frame_texture *const from = &h->frame->textures[i];
    rhw_texture *const to = &h->textures[i];
    keep(h, rhw_texture_create(h->context, &from->def, to));
    keep(h, rhw_sampler_create(h->context, &from->sampler, &h->samplers[i]));
    for (int level = 0; h->ok && level < rhw_texture_mip_levels(h->context, *to); level++) {
        const int layers = from->def.kind == RHW_TEXTURE_3D ? rhw_texture_depth(h->context, *to, level)
                                                            : rhw_texture_layers(h->context, *to);
        for (int layer = 0; layer < layers; layer++) {
            frame_texels(from, level, layer, texels);
            keep(h, rhw_texture_write_layer(h->context, *to, level, layer, texels, 0));
        }
    }
}

static void make_resources(struct here *h)
{
    const struct frame *const f = h->frame;
    struct rhw_texture_def def = {.width = f->width, .height = f->height};
    for (int i = 0; i < f->target_count; i++) {
        def.format = f->formats[i];
        keep(h, rhw_texture_create(h->context, &def, &h->targets[i]));
    }
    for (int i = 0; i < f->texture_count; i++) {
        make_texture(h, i);
    }
    static const uint32_t zeros[FRAME_NUMBERS];
    h->vertices = make_buffer(h, f->vertices, (size_t)f->vertex_count * sizeof *f->vertices);
    h->indices = make_buffer(h, f->indices, (size_t)f->index_count * sizeof *f->indices);
    h->instances = make_buffer(h, f->instances, sizeof f->instances);
    h->numbers = make_buffer(h, zeros, sizeof zeros);
    if (f->extra == FRAME_IMAGE) {
        const struct rhw_texture_def image = {
            .format = RHW_FORMAT_R32_UINT, .width = FRAME_IMAGE_SIDE, .height = FRAME_IMAGE_SIDE};
        keep(h, rhw_texture_create(h->context, &image, &h->image));
        keep(h, rhw_texture_write(h->context, h->image, 0, zeros, 0));
    }
    for (int i = 0; f->extra == FRAME_OCCLUSION && i < f->draw_count; i++) {
        const struct rhw_query_def query = {.kind = RHW_QUERY_ANY_PASSED};
        keep(h, rhw_query_create(h->context, &query, &h->queries[i]));
    }
}

static rhw_pipeline make_pipeline(struct here *h, const struct frame_draw *draw)
{
    const struct shader_pair *const shaders = draw->shaders;
    struct rhw_pipeline_def def = draw->state;
    def.program = (struct rhw_program){
        .vertex1 = shaders->vertex1 ? shaders->vertex1 : place,
        .fragment1 = shaders->fragment1,
        .varyings = {{.components = 4, .derivatives = shaders->derivatives, .sampling = shaders->sampling},
                     {.components = 4, .qualifier = RHW_FLAT},
                     {.components = 4, .qualifier = RHW_FLAT}},
        .varying_count = 3,
        .uses = shaders->uses,
        .writes_point_size = shaders->writes_point_size,
        .uniform_size = sizeof draw->uniforms,
        .vertex_effects = shaders->vertex_effects,
        .early_fragment_tests = shaders->early_tests,
    };
    const struct rhw_attribute attributes[] = {
        {RHW_VERTEX_FLOAT4, 0, offsetof(struct frame_vertex, position)},
        {RHW_VERTEX_FLOAT4, 0, offsetof(struct frame_vertex, value)},
        {RHW_VERTEX_FLOAT4, 1, 0},
    };
    memcpy(def.attributes, attributes, sizeof attributes);
    def.attribute_count = 3;
    def.buffers[1] =
        (struct rhw_vertex_layout){.per_instance = true, .instance_step = (uint32_t)draw->instance_step};
    def.buffer_count = 2;
    if (h->frame->extra == FRAME_FEEDBACK) {
        def.feedback_outputs[0] = (struct rhw_feedback_output){.source = RHW_FEEDBACK_POSITION};
        def.feedback_outputs[1] = (struct rhw_feedback_output){.source = RHW_FEEDBACK_VARYING, .offset = 16};
        def.feedback_output_count = 2;
    }
    rhw_pipeline pipeline = {0};
    keep(h, rhw_pipeline_create(h->context, &def, &pipeline));
    return pipeline;
}

static void draw_one(struct here *h, int index)
{
    const struct frame_draw *const d = &h->frame->draws[index];
    const struct rhw_viewport whole = {.width = (float)h->frame->width, .height = (float)h->frame->height};
    const struct rhw_rect all = {0, 0, h->frame->width, h->frame->height};
    const rhw_pipeline pipeline = make_pipeline(h, d);
    if (!h->ok) {
        return;
    }
    rhw_pass_set_pipeline(h->context, h->pass, pipeline);
    rhw_pass_set_viewport(h->context, h->pass, d->viewport.width > 0 ? &d->viewport : &whole);
    rhw_pass_set_scissor(h->context, h->pass, d->scissor.width > 0 ? &d->scissor : &all);
    rhw_pass_set_stencil_reference(h->context, h->pass, d->reference_front, d->reference_back);
    rhw_pass_set_blend_constant(h->context, h->pass, d->blend_constant);
    rhw_pass_set_uniforms(h->context, h->pass, d->uniforms, sizeof d->uniforms);
    if (h->frame->extra == FRAME_OCCLUSION) {
        rhw_pass_begin_query(h->context, h->pass, h->queries[index]);
    }
    if (d->indexed) {
        rhw_pass_draw_indexed(h->context, h->pass, (uint32_t)d->first, (uint32_t)d->count, 0, 0,
                              (uint32_t)d->instances);
    } else {
        rhw_pass_draw(h->context, h->pass, (uint32_t)d->first, (uint32_t)d->count, 0, (uint32_t)d->instances);
    }
    if (h->frame->extra == FRAME_OCCLUSION) {
        rhw_pass_end_query(h->context, h->pass, h->queries[index]);
    }
    rhw_pipeline_destroy(h->context, pipeline);
}

static void begin(struct here *h)
{
    const struct frame *const f = h->frame;
    struct rhw_pass_def def = {.color_count = f->target_count, .samples = f->samples};
    for (int i = 0; i < f->target_count; i++) {
        struct rhw_color_attachment *const color = &def.colors[i];
        if (f->left_out >> i & 1) {
            struct rhw_clear_value value = {.depth = 0};
            memcpy(value.color, f->clear[i], sizeof value.color);
            keep(h, rhw_texture_clear(h->context, h->targets[i], NULL, &value));
            continue;
        }
        *color = (struct rhw_color_attachment){.texture = h->targets[i]};
        memcpy(color->clear, f->clear[i], sizeof color->clear);
        memcpy(color->clear_integer, f->clear_integer[i], sizeof color->clear_integer);
    }
    def.depth = (struct rhw_depth_attachment){
        .enabled = f->depth_format != RHW_FORMAT_NONE,
        .format = f->depth_format,
        .load = RHW_LOAD_CLEAR,
        .store = RHW_STORE_DISCARD,
        .clear = f->depth_clear,
        .stencil_load = RHW_LOAD_CLEAR,
        .stencil_store = RHW_STORE_DISCARD,
        .stencil_clear = f->stencil_clear,
    };
    keep(h, rhw_pass_begin(h->context, &def, &h->pass));
}

static void draw_all(struct here *h)
{
    const struct frame *const f = h->frame;
    begin(h);
    if (!h->ok) {
        return;
    }
    rhw_pass_set_vertex_buffer(h->context, h->pass, 0, h->vertices, 0);
    rhw_pass_set_vertex_buffer(h->context, h->pass, 1, h->instances, 0);
    rhw_pass_set_index_buffer(h->context, h->pass, h->indices, RHW_INDEX_UINT16, 0);
    for (int i = 0; i < f->texture_count; i++) {
        rhw_pass_set_texture(h->context, h->pass, i, h->textures[i], h->samplers[i]);
    }
    if (f->extra == FRAME_IMAGE) {
        rhw_pass_set_storage_image(h->context, h->pass, 0, h->image, 0);
    }
    if (f->extra == FRAME_STORAGE) {
        rhw_pass_set_storage_buffer(h->context, h->pass, 0, h->numbers, 0, 0);
    }
    for (int i = 0; i < f->draw_count; i++) {
        if (f->extra == FRAME_FEEDBACK && i == 0) { // the pipeline is set before it begins
            const rhw_pipeline pipeline = make_pipeline(h, &f->draws[0]);
            const struct rhw_feedback_target target = {.buffer = h->numbers};
            rhw_pass_set_pipeline(h->context, h->pass, pipeline);
            rhw_pass_set_uniforms(h->context, h->pass, f->draws[0].uniforms, sizeof f->draws[0].uniforms);
            rhw_pass_begin_transform_feedback(h->context, h->pass, &target, 1);
            rhw_pass_draw(h->context, h->pass, (uint32_t)f->draws[0].first, (uint32_t)f->draws[0].count, 0,
                          (uint32_t)f->draws[0].instances);
            rhw_pass_end_transform_feedback(h->context, h->pass, NULL);
            rhw_pipeline_destroy(h->context, pipeline);
        } else {
            draw_one(h, i);
        }
    }
    keep(h, rhw_pass_end(h->context, h->pass, NULL));
}

static void read_numbers(struct here *h, struct drawn *drawn)
{
    static uint32_t words[FRAME_NUMBERS];
    if (h->frame->extra == FRAME_OCCLUSION) {
        for (int i = 0; i < h->frame->draw_count; i++) {
            struct rhw_query_counts counts = {0};
            keep(h, rhw_query_read(h->context, h->queries[i], &counts));
            drawn->numbers[i] = counts.any_passed;
        }
        return;
    }
    keep(h, h->frame->extra == FRAME_IMAGE ? rhw_texture_read(h->context, h->image, 0, words, 0)
                                           : rhw_buffer_read(h->context, h->numbers, 0, words, sizeof words));
    for (int i = 0; i < FRAME_NUMBERS; i++) {
        float number;
        memcpy(&number, &words[i], sizeof number);
        drawn->numbers[i] = h->frame->extra == FRAME_FEEDBACK ? (double)number : (double)words[i];
    }
}

static void read_targets(struct here *h, struct drawn *drawn)
{
    const struct frame *const f = h->frame;
    for (int i = 0; h->ok && i < f->target_count; i++) {
        const struct texel_pair *const pair = texel_pair_find(f->formats[i]);
        keep(h, rhw_texture_read(h->context, h->targets[i], 0, texels, 0));
        for (int at = 0; at < f->width * f->height; at++) {
            texel_decode(pair, texels + rhw_format_size(pair->format) * (size_t)at, drawn->targets[i][at]);
        }
    }
}

static void blit(struct here *h)
{
    const int *const a = h->frame->blit_from, *const b = h->frame->blit_to;
    const struct rhw_blit_region from = {.x0 = a[0], .y0 = a[1], .x1 = a[2], .y1 = a[3]};
    const struct rhw_blit_region to = {.x0 = b[0], .y0 = b[1], .x1 = b[2], .y1 = b[3]};
    keep(h, rhw_texture_blit(h->context, h->targets[0], &from, h->targets[1], &to, h->frame->blit_filter));
}

static void release(struct here *h)
{
    for (int i = 0; i < FRAME_TARGETS; i++) {
        rhw_texture_destroy(h->context, h->targets[i]);
    }
    rhw_texture_destroy(h->context, h->image);
    for (int i = 0; i < FRAME_TEXTURES; i++) {
        rhw_texture_destroy(h->context, h->textures[i]);
        rhw_sampler_destroy(h->context, h->samplers[i]);
    }
    for (int i = 0; i < FRAME_DRAWS; i++) {
        rhw_query_destroy(h->context, h->queries[i]);
    }
    rhw_buffer_destroy(h->context, h->vertices);
    rhw_buffer_destroy(h->context, h->indices);
    rhw_buffer_destroy(h->context, h->instances);
    rhw_buffer_destroy(h->context, h->numbers);
}

bool draw_here(rhw_context *context, const struct frame *frame, struct drawn *drawn)
{
    struct here h = {.context = context, .frame = frame, .ok = true};
    make_resources(&h);
    draw_all(&h);
    if (h.ok && frame->extra == FRAME_BLIT) {
        blit(&h);
    }
    if (h.ok) {
        read_targets(&h, drawn);
        read_numbers(&h, drawn);
    }
    release(&h);
    return h.ok;
}
