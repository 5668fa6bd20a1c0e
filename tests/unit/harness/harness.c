// SPDX-License-Identifier: MIT
// Context, attachments and drawing for the unit tests; see harness.h.
#include "harness.h"

#include "isa_shaders.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void rig_misuse(void *user, const char *message)
{
    struct rig *rig = user;
    rig->misuses++;
    rig->misused = true;
    snprintf(rig->message, sizeof rig->message, "%s", message);
}

void rig_expect_misuse(struct rig *rig, const char *part)
{
    if (rig->misuses != 1) {
        fail_msg("%d misuses reported where 1 was made (%s)", rig->misuses, part);
    }
    if (strstr(rig->message, part) == NULL) {
        fail_msg("the message \"%s\" does not name %s", rig->message, part);
    }
    rig->misuses = 0;
}

static void expect_ok(const struct rig *rig, enum rhw_result result)
{
    if (result != RHW_OK) {
        fail_msg("%s: %s", rhw_result_string(result), rig->message);
    }
}

void rig_vertex_pass(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].position[c] = groups[g].attribute[0][c];
            groups[g].varying[c] = groups[g].attribute[1][c];
        }
    }
}

void rig_fragment_pass(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].varying[c];
        }
    }
}

void rig_set_program(struct rig *rig, rhw_vertex_function *vertex, rhw_fragment_function *fragment)
{
    rig->pipeline.program.vertex[RHW_ISA_BASELINE] = vertex;
    rig->pipeline.program.fragment[RHW_ISA_BASELINE] = fragment;
}

void isa_shaders_fill(struct rhw_program *program)
{
    static rhw_vertex_function *const vertex[RHW_ISA_COUNT] = RHW_ISA_TABLE(isa_shader_vertex);
    static rhw_fragment_function *const fragment[RHW_ISA_COUNT] = RHW_ISA_TABLE(isa_shader_fragment);
    memcpy(program->vertex, vertex, sizeof vertex);
    memcpy(program->fragment, fragment, sizeof fragment);
}

static void set_default_pipeline(struct rig *rig)
{
    struct rhw_pipeline_def *def = &rig->pipeline;
    *def = rhw_pipeline_def_default();
    rig_set_program(rig, rig_vertex_pass, rig_fragment_pass);
    def->program.varyings[0] = (struct rhw_varying){.components = 4, .qualifier = RHW_SMOOTH};
    def->program.varying_count = 1;
    def->attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct rig_vertex, position)};
    def->attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct rig_vertex, value)};
    def->attribute_count = 2;
    def->buffers[0].stride = sizeof(struct rig_vertex);
    def->buffer_count = 1;
}

void rig_open_with(struct rig *rig, int width, int height, const struct rhw_context_def *context_def)
{
    *rig = (struct rig){.width = width, .height = height};
    struct rhw_context_def def = *context_def;
    def.assert_ = rig_misuse;
    def.user = rig;
    expect_ok(rig, rhw_context_create(&def, &rig->context));
    set_default_pipeline(rig);
    rig->pass = rhw_pass_def_default();
    rig->pass.color_count = 0;
    rig->pass.depth.enabled = false;
    rig->pipeline.target_count = 0;
    rig_set_target(rig, 0, RHW_FORMAT_RGBA32_FLOAT);
}

void rig_open(struct rig *rig, int width, int height)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    rig_open_with(rig, width, height, &def);
}

static void destroy_objects(struct rig *rig)
{
    for (int i = 0; i < rig->objects.buffer_count; i++) {
        rhw_buffer_destroy(rig->context, rig->objects.buffers[i]);
    }
    for (int i = 0; i < rig->objects.pipeline_count; i++) {
        rhw_pipeline_destroy(rig->context, rig->objects.pipelines[i]);
    }
    rig->objects.buffer_count = rig->objects.pipeline_count = 0;
}

void rig_close(struct rig *rig)
{
    if (rig->misuses != 0) {
        fail_msg("misuse reported: %s", rig->message);
    }
    destroy_objects(rig);
    rhw_context_destroy(rig->context);
    free(rig->objects.buffers);
    free(rig->objects.pipelines);
    free(rig->pixels);
    *rig = (struct rig){0};
}

static rhw_texture create_target(struct rig *rig, enum rhw_format format)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = rig->width;
    def.height = rig->height;
    rhw_texture texture;
    expect_ok(rig, rhw_texture_create(rig->context, &def, &texture));
    return texture;
}

void rig_set_target(struct rig *rig, int index, enum rhw_format format)
{
    struct rhw_color_attachment *attachment = &rig->pass.colors[index];
    if (index < rig->pass.color_count) {
        rhw_texture_destroy(rig->context, attachment->texture);
    } else {
        rig->pass.color_count = index + 1;
    }
    *attachment = (struct rhw_color_attachment){.texture = create_target(rig, format)};
    if (index >= rig->pipeline.target_count) {
        rig->pipeline.target_count = index + 1;
    }
    rig->pipeline.targets[index] = rhw_pipeline_def_default().targets[0];
    rig->pipeline.targets[index].format = format;
}

void rig_set_depth(struct rig *rig)
{
    rig->pass.depth = (struct rhw_depth_attachment){.enabled = true,
                                                    .texture = create_target(rig, RHW_FORMAT_D32_FLOAT),
                                                    .load = RHW_LOAD_CLEAR,
                                                    .clear = 1};
    rig->pipeline.depth_test = true;
}

void rig_begin(struct rig *rig)
{
    expect_ok(rig, rhw_pass_begin(rig->context, &rig->pass, &rig->recording));
    rig->misused = false;
}

void rig_expect_refused_pass(struct rig *rig, const char *part)
{
    assert_int_equal(rhw_pass_begin(rig->context, &rig->pass, &rig->recording), RHW_ERROR_MISUSE);
    rig_expect_misuse(rig, part);
}

void rig_use_pipeline(struct rig *rig)
{
    struct rig_objects *objects = &rig->objects;
    const size_t size = sizeof(rhw_pipeline) * (size_t)(objects->pipeline_count + 1);
    objects->pipelines = realloc(objects->pipelines, size);
    rhw_pipeline *pipeline = &objects->pipelines[objects->pipeline_count++];
    expect_ok(rig, rhw_pipeline_create(rig->context, &rig->pipeline, pipeline));
    rhw_pass_set_pipeline(rig->context, rig->recording, *pipeline);
}

static rhw_buffer create_buffer(struct rig *rig, const void *data, size_t size)
{
    struct rig_objects *objects = &rig->objects;
    const size_t bytes = sizeof(rhw_buffer) * (size_t)(objects->buffer_count + 1);
    objects->buffers = realloc(objects->buffers, bytes);
    rhw_buffer *buffer = &objects->buffers[objects->buffer_count++];
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = size;
    def.data = data;
    expect_ok(rig, rhw_buffer_create(rig->context, &def, buffer));
    return *buffer;
}

void rig_use_vertices(struct rig *rig, int slot, const void *data, size_t size)
{
    rhw_pass_set_vertex_buffer(rig->context, rig->recording, slot, create_buffer(rig, data, size), 0);
}

void rig_use_indices(struct rig *rig, enum rhw_index_type type, const void *data, size_t size)
{
    rhw_pass_set_index_buffer(rig->context, rig->recording, create_buffer(rig, data, size), type, 0);
}

void rig_draw(struct rig *rig, const struct rig_vertex *vertices, int count)
{
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, sizeof *vertices * (size_t)count);
    rhw_pass_draw(rig->context, rig->recording, 0, (uint32_t)count, 0, 1);
}

void rig_end(struct rig *rig)
{
    const enum rhw_result result = rhw_pass_end(rig->context, rig->recording, &rig->stats);
    expect_ok(rig, rig->misused && result == RHW_ERROR_MISUSE ? RHW_OK : result);
    assert_int_equal(result, rig->misused ? RHW_ERROR_MISUSE : RHW_OK);
    destroy_objects(rig);
}

void rig_draw_once(struct rig *rig, const struct rig_vertex *vertices, int count)
{
    rig_begin(rig);
    rig_draw(rig, vertices, count);
    rig_end(rig);
}

const void *rig_read(struct rig *rig, rhw_texture texture)
{
    const size_t texel = rhw_format_size(rhw_format_decoded(rhw_texture_format(rig->context, texture)));
    free(rig->pixels);
    rig->pixels = malloc(texel * (size_t)rig->width * (size_t)rig->height);
    assert_non_null(rig->pixels);
    rhw_texture_read(rig->context, texture, 0, rig->pixels, 0);
    return rig->pixels;
}

const float (*rig_read_float4(struct rig *rig))[4]
{
    const rhw_texture texture = rig->pass.colors[0].texture;
    assert_int_equal(rhw_texture_format(rig->context, texture), RHW_FORMAT_RGBA32_FLOAT);
    rig_read(rig, texture);
    return rig->pixels;
}

const float *rig_read_depth(struct rig *rig)
{
    return rig_read(rig, rig->pass.depth.texture);
}

uint64_t rig_hash_bytes(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

uint64_t rig_hash(struct rig *rig, int index)
{
    const rhw_texture texture = rig->pass.colors[index].texture;
    const size_t texel = rhw_format_size(rhw_format_decoded(rhw_texture_format(rig->context, texture)));
    const void *pixels = rig_read(rig, texture);
    return rig_hash_bytes(UINT64_C(0xcbf29ce484222325), pixels,
                          texel * (size_t)rig->width * (size_t)rig->height);
}

void rig_place(const struct rig *rig, float x, float y, float depth, float w, float position[4])
{
    const double width = rig->width, height = rig->height;
    position[0] = (float)((2.0 * (double)x / width - 1.0) * (double)w);
    position[1] = (float)((1.0 - 2.0 * (double)y / height) * (double)w);
    position[2] = depth * w;
    position[3] = w;
}

void rig_rectangle(const struct rig *rig, float x0, float y0, float x1, float y1, float depth,
                   const float value[4], struct rig_vertex vertices[6])
{
    const float corners[6][2] = {{x0, y1}, {x1, y1}, {x0, y0}, {x0, y0}, {x1, y1}, {x1, y0}};
    for (int i = 0; i < 6; i++) {
        rig_place(rig, corners[i][0], corners[i][1], depth, 1, vertices[i].position);
        memcpy(vertices[i].value, value, sizeof vertices[i].value);
    }
}

void rig_cover(const struct rig *rig, float depth, const float value[4], struct rig_vertex vertices[6])
{
    rig_rectangle(rig, 0, 0, (float)rig->width, (float)rig->height, depth, value, vertices);
}

uint64_t rig_random(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

float rig_random_float(uint64_t *state, float low, float high)
{
    return low + (high - low) * ((float)(rig_random(state) >> 40) / 16777216.0f);
}

int rig_random_int(uint64_t *state, int count)
{
    return (int)(rig_random(state) % (uint64_t)count);
}

double rig_ulp(double value)
{
    const float magnitude = fabsf((float)value);
    return (double)nextafterf(magnitude, INFINITY) - (double)magnitude;
}
