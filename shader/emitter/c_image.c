// SPDX-License-Identifier: MIT
// Images: a request is written out, and given to the function of rhw/shader_binding.h that does what is asked.
#include "c_emit.h"

// What is asked, as the text of arguments.
struct request {
    const uint32_t *operands;
    uint32_t flags, value, spatial;
};

static uint32_t sampler_of(const struct shader_emitter *emitter, const struct request *request)
{
    return request->flags & SHADER_IMAGE_HAS_SAMPLER
               ? shader_resource_of(&emitter->plan, request->operands[SHADER_IMAGE_SAMPLER])
               : SHADER_NONE;
}

static const char *list_of(struct shader_emitter *emitter, const uint32_t *values, uint32_t count,
                           bool as_float)
{
    const char *text = "";
    for (uint32_t i = 0; i < count; i++) {
        text = shader_format(emitter->memory, "%s%s%s", text, i > 0 ? ", " : "",
                             shader_c_argument(emitter, values[i], as_float));
    }
    return text;
}

// Write the coordinates. There are always 4, because the texture that is bound may be of a kind with more than the
// shader gives.
static void write_coordinates(struct shader_emitter *emitter, const struct request *request, bool as_float)
{
    const uint32_t count = request->spatial + (request->flags & SHADER_IMAGE_IS_ARRAYED ? 1 : 0);
    shader_text_line(
        emitter->out, "const %s at%u[4] = {%s};", as_float ? "rhw_float" : "rhw_int",
        (unsigned)request->value,
        list_of(emitter, &request->operands[SHADER_IMAGE_COORDINATES], count < 4 ? count : 4, as_float));
}

// Write an operand that a request points to. Return what points to it.
static const char *write_pointed(struct shader_emitter *emitter, const struct request *request,
                                 const char *name, enum shader_image_operand operand, bool as_float)
{
    shader_text_line(emitter->out, "const %s %s%u = %s;", as_float ? "rhw_float" : "rhw_int", name,
                     (unsigned)request->value,
                     shader_c_argument(emitter, request->operands[operand], as_float));
    return shader_format(emitter->memory, "&%s%u", name, (unsigned)request->value);
}

// Write a struct rhw_sample_request.
static void write_sample_request(struct shader_emitter *emitter, const struct request *request)
{
    struct shader_memory *const memory = emitter->memory;
    const uint32_t *const operands = request->operands;
    const uint32_t flags = request->flags, spatial = request->spatial;
    const unsigned value = request->value;
    write_coordinates(emitter, request, true);
    const char *fields = shader_format(memory, ".coordinates = at%u", value);
    if (flags & SHADER_IMAGE_HAS_GRADIENT) {
        shader_text_line(emitter->out, "const rhw_float gradient%u[6] = {%s, %s};", value,
                         list_of(emitter, &operands[SHADER_IMAGE_DX], spatial, true),
                         list_of(emitter, &operands[SHADER_IMAGE_DY], spatial, true));
        fields = shader_format(memory, "%s, .gradient = gradient%u", fields, value);
    }
    if (flags & SHADER_IMAGE_HAS_LOD) {
        fields = shader_format(memory, "%s, .lod = %s", fields,
                               write_pointed(emitter, request, "lod", SHADER_IMAGE_LOD, true));
    }
    if (flags & SHADER_IMAGE_HAS_REFERENCE) {
        fields = shader_format(memory, "%s, .reference = %s", fields,
                               write_pointed(emitter, request, "reference", SHADER_IMAGE_REFERENCE, true));
    }
    if (flags & SHADER_IMAGE_HAS_OFFSET) {
        shader_text_line(emitter->out, "const rhw_int offset%u[3] = {%s};", value,
                         list_of(emitter, &operands[SHADER_IMAGE_OFFSET], spatial, false));
        fields = shader_format(memory, "%s, .offset = offset%u", fields, value);
    }
    if (flags & SHADER_IMAGE_HAS_BIAS) {
        fields = shader_format(memory, "%s, .bias = %s", fields,
                               write_pointed(emitter, request, "bias", SHADER_IMAGE_BIAS, true));
    }
    if (flags & SHADER_IMAGE_HAS_LEAST_LOD) {
        (void)write_pointed(emitter, request, "least", SHADER_IMAGE_LEAST_LOD, true);
    }
    shader_text_line(emitter->out, "const struct rhw_sample_request request%u = {%s};", value, fields);
}

// Write what the operation needs before it is called.
static void write_request(struct shader_emitter *emitter, const struct request *request)
{
    switch ((enum shader_image_operation)(request->flags & 15)) {
    case SHADER_DO_SAMPLE:
    case SHADER_DO_GATHER:
    case SHADER_DO_QUERY_LOD: write_sample_request(emitter, request); return;
    case SHADER_DO_FETCH:
        write_coordinates(emitter, request, false);
        if (request->flags & SHADER_IMAGE_HAS_SAMPLE) {
            (void)write_pointed(emitter, request, "sample", SHADER_IMAGE_SAMPLE, false);
        } else if (request->flags & SHADER_IMAGE_HAS_LOD) {
            (void)write_pointed(emitter, request, "lod", SHADER_IMAGE_LOD, false);
        }
        return;
    case SHADER_DO_LOAD: write_coordinates(emitter, request, false); return;
    case SHADER_DO_SIZE:
        if (request->flags & SHADER_IMAGE_HAS_LOD) {
            (void)write_pointed(emitter, request, "lod", SHADER_IMAGE_LOD, false);
        }
        return;
    default: return;
    }
}

// Write the call that fills `texel`.
static void write_call(struct shader_emitter *emitter, const struct request *request, const char *binding,
                       const char *texel)
{
    struct shader_text *const out = emitter->out;
    const unsigned value = request->value;
    const unsigned channel = request->flags >> SHADER_IMAGE_CHANNEL_SHIFT & 3;
    const char *const lod =
        request->flags & SHADER_IMAGE_HAS_LOD ? shader_format(emitter->memory, "&lod%u", value) : "NULL";
    switch ((enum shader_image_operation)(request->flags & 15)) {
    case SHADER_DO_SAMPLE:
        if (request->flags & SHADER_IMAGE_HAS_LEAST_LOD) {
            shader_text_line(out, "rhw_spirv_sample_above(%s, &request%u, least%u, %s);", binding, value,
                             value, texel);
            return;
        }
        shader_text_line(out, "rhw_binding_sample(%s, &request%u, %s);", binding, value, texel);
        return;
    case SHADER_DO_GATHER:
        shader_text_line(out, "rhw_binding_sample_gather(%s, &request%u, %u, %s);", binding, value, channel,
                         texel);
        return;
    case SHADER_DO_QUERY_LOD:
        shader_text_line(out, "rhw_binding_sample_query_lod(%s, &request%u, %s);", binding, value, texel);
        return;
    case SHADER_DO_FETCH:
        if (request->flags & SHADER_IMAGE_HAS_SAMPLE) {
            shader_text_line(out, "rhw_binding_sample_fetch_sample(%s, at%u, &sample%u, %s);", binding, value,
                             value, texel);
        } else {
            shader_text_line(out, "rhw_binding_sample_fetch(%s, at%u, %s, %s);", binding, value, lod, texel);
        }
        return;
    case SHADER_DO_LOAD:
        shader_text_line(out, "rhw_binding_image_load(%s, at%u, %s);", binding, value, texel);
        return;
    case SHADER_DO_SIZE: shader_text_line(out, "rhw_spirv_size(%s, %s, %s);", binding, lod, texel); return;
    case SHADER_DO_IMAGE_SIZE: shader_text_line(out, "rhw_spirv_image_size(%s, %s);", binding, texel); return;
    case SHADER_DO_LEVELS:
        shader_text_line(out, "%s[0] = rhw_spirv_count(rhw_binding_sample_levels(%s));", texel, binding);
        return;
    case SHADER_DO_SAMPLES:
        shader_text_line(out, "%s[0] = rhw_spirv_count(rhw_binding_sample_samples(%s));", texel, binding);
        return;
    }
}

static void write_sample(struct shader_emitter *emitter, uint32_t value)
{
    struct shader_node *const node = &emitter->form->nodes[value];
    uint32_t count;
    const struct request request = {.operands = shader_operands(emitter->form, node, &count),
                                    .flags = node->immediate,
                                    .value = value,
                                    .spatial = node->immediate >> SHADER_IMAGE_SPATIAL_SHIFT & 3};
    const uint32_t texture = shader_resource_of(&emitter->plan, request.operands[SHADER_IMAGE_TEXTURE]);
    const uint32_t sampler = sampler_of(emitter, &request);
    const bool is_one = shader_c_is_one_binding(emitter, texture) &&
                        (sampler == SHADER_NONE || shader_c_is_one_binding(emitter, sampler));
    const char *const texels = shader_format(emitter->memory, "texel%u", (unsigned)value);
    const char *lanes;
    write_request(emitter, &request);
    if (is_one && request.flags == (SHADER_DO_FETCH | 2 << SHADER_IMAGE_SPATIAL_SHIFT)) {
        shader_text_line(emitter->out, "rhw_float %s[4];", texels);
        shader_text_line(emitter->out, "rhw_spirv_fetch(binding%u, &%s, at%u, %s);", (unsigned)texture,
                         shader_c_plane(emitter, texture), (unsigned)value, texels);
        return;
    }
    shader_text_line(emitter->out, "rhw_float %s[4]%s;", texels,
                     is_one ? "" : " = {rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f)}");
    const char *const binding = shader_c_begin_bindings(emitter, texture, sampler, &lanes);
    if (is_one) {
        write_call(emitter, &request, binding, texels);
    } else {
        shader_text_line(emitter->out, "rhw_float texel[4];");
        write_call(emitter, &request, binding, "texel");
        shader_text_line(emitter->out, "rhw_spirv_take(%s, texel, %s);", lanes, texels);
    }
    shader_c_end_bindings(emitter, texture, sampler);
}

static void write_image_store(struct shader_emitter *emitter, uint32_t value)
{
    struct shader_node *const node = &emitter->form->nodes[value];
    uint32_t count;
    const struct request request = {.operands = shader_operands(emitter->form, node, &count),
                                    .flags = node->immediate,
                                    .value = value,
                                    .spatial = node->immediate >> SHADER_IMAGE_SPATIAL_SHIFT & 3};
    const uint32_t texture = shader_resource_of(&emitter->plan, request.operands[SHADER_IMAGE_TEXTURE]);
    const uint32_t sampler = sampler_of(emitter, &request);
    const char *lanes;
    write_coordinates(emitter, &request, false);
    shader_text_line(emitter->out, "const rhw_float texel%u[4] = {%s};", (unsigned)value,
                     list_of(emitter, &request.operands[SHADER_IMAGE_TEXEL], 4, true));
    const char *const binding = shader_c_begin_bindings(emitter, texture, sampler, &lanes);
    shader_text_line(emitter->out, "rhw_binding_image_store(%s, at%u, &%s, texel%u);", binding,
                     (unsigned)value, lanes, (unsigned)value);
    shader_c_end_bindings(emitter, texture, sampler);
}

bool shader_c_write_image(struct shader_emitter *emitter, uint32_t place)
{
    const uint32_t value = emitter->form->code[place];
    const struct shader_node *const node = &emitter->form->nodes[value];
    switch ((enum shader_op)node->op) {
    case SHADER_SAMPLE:
        if (!shader_c_write_group_sample(emitter, value)) {
            write_sample(emitter, value);
        }
        return true;
    case SHADER_PART:
        shader_c_define(emitter, value,
                        shader_format(emitter->memory, "texel%u[%u]", (unsigned)node->operands[0],
                                      (unsigned)node->immediate),
                        "");
        return true;
    case SHADER_IMAGE_STORE: write_image_store(emitter, value); return true;
    case SHADER_NEEDS_GRADIENT:
        shader_c_define(
            emitter, value,
            shader_format(emitter->memory,
                          "rhw_splat_int(-rhw_binding_sample_needs_gradient(binding%u, binding%u))",
                          (unsigned)node->operands[0], (unsigned)node->operands[1]),
            "");
        return true;
    default: return false;
    }
}
