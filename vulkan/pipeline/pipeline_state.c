// SPDX-License-Identifier: MIT
#include "pipeline_state.h"
#include "device/chain.h"
#include "pass/render_pass.h"
#include "pipeline_enums.h"
#include "resource/format.h"
#include "resource/sampler.h"
#include "src/driver.h"
#include <math.h>
#include <string.h>

// Vertex input ---------------------------------------------------------------------------------------

static const VkVertexInputBindingDescription *find_buffer(const VkPipelineVertexInputStateCreateInfo *input,
                                                          uint32_t number)
{
    for (uint32_t i = 0; i < input->vertexBindingDescriptionCount; i++) {
        if (input->pVertexBindingDescriptions[i].binding == number) {
            return &input->pVertexBindingDescriptions[i];
        }
    }
    return NULL;
}

static const VkVertexInputAttributeDescription *find_attribute(
    const VkPipelineVertexInputStateCreateInfo *input, uint32_t location)
{
    for (uint32_t i = 0; i < input->vertexAttributeDescriptionCount; i++) {
        const VkVertexInputAttributeDescription *const attribute = &input->pVertexAttributeDescriptions[i];
        if (attribute->location == location && attribute->binding < RHW_MAX_VERTEX_BUFFERS &&
            find_buffer(input, attribute->binding)) {
            return attribute;
        }
    }
    return NULL;
}

// Return how many instances read one element of a buffer; 0 means all.
static uint32_t divisor_of(const VkPipelineVertexInputStateCreateInfo *input, uint32_t buffer)
{
    const VkPipelineVertexInputDivisorStateCreateInfoEXT *const given = vulkan_chain_find(
        input->pNext, VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_DIVISOR_STATE_CREATE_INFO_EXT);
    for (uint32_t i = 0; given && i < given->vertexBindingDivisorCount; i++) {
        if (given->pVertexBindingDivisors[i].binding == buffer) {
            return given->pVertexBindingDivisors[i].divisor;
        }
    }
    return 1;
}

// In Vulkan all vertices read element 0 of a buffer with stride 0, and all instances too.
static struct rhw_vertex_layout layout_of(const VkPipelineVertexInputStateCreateInfo *input,
                                          const VkVertexInputBindingDescription *buffer)
{
    const bool by_instance = buffer->stride != 0 && buffer->inputRate == VK_VERTEX_INPUT_RATE_INSTANCE;
    const uint32_t divisor = by_instance ? divisor_of(input, buffer->binding) : 0;
    return (struct rhw_vertex_layout){.stride = buffer->stride,
                                      .constant = by_instance ? divisor == 0 : buffer->stride == 0,
                                      .per_instance = by_instance,
                                      .instance_step = divisor};
}

// Only attributes that the shader reads count: a draw need not bind the buffers of others. Locations between them take
// an attribute beside them, which nobody reads.
static void fill_vertex_input(VkPipeline pipeline, const VkPipelineVertexInputStateCreateInfo *input,
                              const struct rhw_shader_info *inputs)
{
    struct rhw_pipeline_def *const def = &pipeline->def;
    uint32_t present = 0, last = 0;
    for (uint32_t i = 0; i < inputs->input_count; i++) {
        const uint32_t location = inputs->inputs[i].location;
        const VkVertexInputAttributeDescription *const given = find_attribute(input, location);
        enum rhw_vertex_format format = RHW_VERTEX_FLOAT1;
        if (!given || location >= RHW_MAX_ATTRIBUTES || !vulkan_vertex_format(given->format, &format)) {
            continue;
        }
        def->attributes[location] =
            (struct rhw_attribute){.format = format, .buffer = (int)given->binding, .offset = given->offset};
        def->buffers[given->binding] = layout_of(input, find_buffer(input, given->binding));
        def->buffer_count =
            def->buffer_count > (int)given->binding ? def->buffer_count : (int)given->binding + 1;
        pipeline->vertex_buffers |= 1u << given->binding;
        present |= 1u << location;
        last = location > last ? location : last;
    }
    def->attribute_count = present != 0 ? (int)last + 1 : 0;
    for (uint32_t i = 0; i < (uint32_t)def->attribute_count; i++) {
        if (!(present >> i & 1)) {
            def->attributes[i] = def->attributes[last];
        }
    }
}

static void fill_assembly(struct rhw_pipeline_def *def,
                          const VkPipelineInputAssemblyStateCreateInfo *assembly)
{
    def->topology = vulkan_topology(assembly->topology);
    def->primitive_restart = assembly->primitiveRestartEnable;
}

// Rasterization --------------------------------------------------------------------------------------

static void fill_viewports(VkPipeline pipeline, const VkPipelineViewportStateCreateInfo *given)
{
    if (given->pViewports && !(pipeline->dynamic & VULKAN_DYNAMIC_VIEWPORT)) {
        vulkan_dynamic_set_viewports(&pipeline->state, 0, given->viewportCount, given->pViewports);
    }
    if (given->pScissors && !(pipeline->dynamic & VULKAN_DYNAMIC_SCISSOR)) {
        vulkan_dynamic_set_scissors(&pipeline->state, 0, given->scissorCount, given->pScissors);
    }
}

static void fill_lines(VkPipeline pipeline, const VkPipelineRasterizationLineStateCreateInfoEXT *given)
{
    struct rhw_pipeline_def *const def = &pipeline->def;
    switch (given->lineRasterizationMode) {
    case VK_LINE_RASTERIZATION_MODE_BRESENHAM_EXT: def->line_mode = RHW_LINE_BRESENHAM; break;
    case VK_LINE_RASTERIZATION_MODE_RECTANGULAR_SMOOTH_EXT:
        def->line_mode = RHW_LINE_RECTANGULAR_SMOOTH;
        break;
    default: def->line_mode = RHW_LINE_RECTANGULAR; break;
    }
    pipeline->has_line_stipple = given->stippledLineEnable;
    vulkan_dynamic_set_line_stipple(&pipeline->state, given->lineStippleFactor, given->lineStipplePattern);
}

// Set what extensions add.
static void fill_more_rasterization(VkPipeline pipeline, const void *chain)
{
    struct rhw_pipeline_def *const def = &pipeline->def;
    const VkPipelineRasterizationDepthClipStateCreateInfoEXT *const clip =
        vulkan_chain_find(chain, VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_DEPTH_CLIP_STATE_CREATE_INFO_EXT);
    const VkPipelineRasterizationProvokingVertexStateCreateInfoEXT *const provoking = vulkan_chain_find(
        chain, VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT);
    const VkPipelineRasterizationLineStateCreateInfoEXT *const lines =
        vulkan_chain_find(chain, VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_LINE_STATE_CREATE_INFO_EXT);
    if (clip) {
        def->depth_clip_disabled = !clip->depthClipEnable;
    }
    if (provoking && provoking->provokingVertexMode == VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT) {
        def->provoking = RHW_PROVOKING_LAST;
    }
    if (lines) {
        fill_lines(pipeline, lines);
    }
}

static void fill_rasterization(VkPipeline pipeline, const VkPipelineRasterizationStateCreateInfo *given)
{
    struct rhw_pipeline_def *const def = &pipeline->def;
    def->depth_clip_disabled = def->depth_clamp = given->depthClampEnable;
    def->rasterizer_discard = given->rasterizerDiscardEnable;
    def->polygon_mode = given->polygonMode == VK_POLYGON_MODE_LINE    ? RHW_POLYGON_LINE
                        : given->polygonMode == VK_POLYGON_MODE_POINT ? RHW_POLYGON_POINT
                                                                      : RHW_POLYGON_FILL;
    const bool front = given->cullMode & VK_CULL_MODE_FRONT_BIT,
               back = given->cullMode & VK_CULL_MODE_BACK_BIT;
    def->cull = front && back ? RHW_CULL_BOTH : front ? RHW_CULL_FRONT : back ? RHW_CULL_BACK : RHW_CULL_NONE;
    def->front = given->frontFace == VK_FRONT_FACE_CLOCKWISE ? RHW_CLOCKWISE : RHW_COUNTER_CLOCKWISE;
    vulkan_dynamic_set_line_width(&pipeline->state, given->lineWidth);
    pipeline->has_depth_bias = given->depthBiasEnable;
    vulkan_dynamic_set_depth_bias(&pipeline->state, given->depthBiasConstantFactor, given->depthBiasClamp,
                                  given->depthBiasSlopeFactor);
    fill_more_rasterization(pipeline, given->pNext);
}

static void fill_multisampling(VkPipeline pipeline, const VkPipelineMultisampleStateCreateInfo *given)
{
    struct rhw_pipeline_def *const def = &pipeline->def;
    const bool has_fragment = def->program.fragment[RHW_ISA_BASELINE] != NULL;
    const uint32_t samples = (uint32_t)given->rasterizationSamples;
    pipeline->samples = samples >= 1 && samples <= RHW_MAX_SAMPLES ? samples : 1;
    def->alpha_to_coverage = given->alphaToCoverageEnable && has_fragment;
    def->alpha_to_one = given->alphaToOneEnable;
    if (given->pSampleMask) {
        const uint32_t all = (1u << pipeline->samples) - 1;
        def->sample_mask = given->pSampleMask[0] & all;
        def->rasterizer_discard = def->rasterizer_discard || def->sample_mask == 0; // nothing is covered
    }
    if (given->sampleShadingEnable && has_fragment && pipeline->samples > 1 &&
        given->minSampleShading * (float)pipeline->samples > 1) {
        pipeline->shades_samples = true;
    }
}

// Depth and stencil ----------------------------------------------------------------------------------

static struct rhw_stencil_face stencil_face(const VkStencilOpState *given)
{
    return (struct rhw_stencil_face){.compares = true,
                                     .compare = vulkan_compare(given->compareOp),
                                     .fail = vulkan_stencil_operation(given->failOp),
                                     .depth_fail = vulkan_stencil_operation(given->depthFailOp),
                                     .pass = vulkan_stencil_operation(given->passOp)};
}

// Tests of what the attachment does not have pass.
static void fill_depth_stencil(VkPipeline pipeline, const VkPipelineDepthStencilStateCreateInfo *given,
                               VkImageAspectFlags aspects)
{
    struct rhw_pipeline_def *const def = &pipeline->def;
    const bool has_depth = aspects & VK_IMAGE_ASPECT_DEPTH_BIT;
    def->depth_test = given->depthTestEnable && has_depth;
    def->depth_compare = vulkan_compare(given->depthCompareOp);
    def->depth_read_only = !given->depthWriteEnable;
    def->depth_bounds_test = given->depthBoundsTestEnable && has_depth;
    def->stencil_test = given->stencilTestEnable && (aspects & VK_IMAGE_ASPECT_STENCIL_BIT);
    def->stencil_front = stencil_face(&given->front);
    def->stencil_back = stencil_face(&given->back);
    vulkan_dynamic_set_depth_bounds(&pipeline->state, given->minDepthBounds, given->maxDepthBounds);
    const VkStencilOpState *const faces[2] = {&given->front, &given->back};
    for (int i = 0; i < 2; i++) {
        const VkStencilFaceFlags face = i == 0 ? VK_STENCIL_FACE_FRONT_BIT : VK_STENCIL_FACE_BACK_BIT;
        vulkan_dynamic_set_compare_mask(&pipeline->state, face, faces[i]->compareMask);
        vulkan_dynamic_set_write_mask(&pipeline->state, face, faces[i]->writeMask);
        vulkan_dynamic_set_reference(&pipeline->state, face, faces[i]->reference);
    }
}

// Targets --------------------------------------------------------------------------------------------

static void fill_blend(struct rhw_color_target *target, const VkPipelineColorBlendAttachmentState *given)
{
    target->write_mask = given->colorWriteMask & 15 ? given->colorWriteMask & 15 : RHW_WRITE_NONE;
    target->blend = given->blendEnable && (rhw_format_features(target->format) & RHW_FEATURE_BLENDED);
    if (target->blend) {
        target->color =
            (struct rhw_blend_component){.src = vulkan_blend_factor(given->srcColorBlendFactor),
                                         .dst = vulkan_blend_factor(given->dstColorBlendFactor),
                                         .operation = vulkan_blend_operation(given->colorBlendOp)};
        target->alpha =
            (struct rhw_blend_component){.src = vulkan_blend_factor(given->srcAlphaBlendFactor),
                                         .dst = vulkan_blend_factor(given->dstAlphaBlendFactor),
                                         .operation = vulkan_blend_operation(given->alphaBlendOp)};
    }
}

static bool is_second(enum rhw_blend_factor factor)
{
    return factor >= RHW_BLEND_SRC1 && factor <= RHW_BLEND_ONE_MINUS_SRC1_ALPHA;
}

static bool reads_second(const struct rhw_color_target *target)
{
    return target->blend && (is_second(target->color.src) || is_second(target->color.dst) ||
                             is_second(target->alpha.src) || is_second(target->alpha.dst));
}

// Attachments that are left out at the end do not count, as in passes.
static void fill_targets(VkPipeline pipeline, const VkPipelineColorBlendStateCreateInfo *given,
                         const VkFormat *formats, uint32_t count)
{
    struct rhw_pipeline_def *const def = &pipeline->def;
    for (uint32_t i = 0; i < count && i < RHW_MAX_COLOR_ATTACHMENTS; i++) {
        const enum rhw_format format =
            formats[i] == VK_FORMAT_UNDEFINED ? RHW_FORMAT_NONE : vulkan_format(formats[i]);
        if (format == RHW_FORMAT_NONE) {
            continue;
        }
        struct rhw_color_target *const target = &def->targets[i];
        *target = (struct rhw_color_target){.format = format, .write_mask = RHW_WRITE_NONE};
        if (given && i < given->attachmentCount && def->program.fragment[RHW_ISA_BASELINE]) {
            fill_blend(target, &given->pAttachments[i]);
        }
        def->target_count = (int)i + 1;
    }
    if (reads_second(&def->targets[0])) {
        // Shaders with a second source write no other target (Vulkan 1.3, maxFragmentDualSrcAttachments).
        for (int i = 1; i < def->target_count; i++) {
            def->targets[i].write_mask = RHW_WRITE_NONE;
        }
    }
    if (given) {
        def->logic = given->logicOpEnable ? vulkan_logic(given->logicOp) : RHW_LOGIC_OFF;
        for (int i = 0; i < 4; i++) {
            pipeline->state.blend_constant[i] = given->blendConstants[i];
        }
    }
}

static VkImageAspectFlags aspects_of(VkFormat format)
{
    return format == VK_FORMAT_UNDEFINED ? 0 : vulkan_format_aspects(format);
}

// Return the formats of the subpass, or those of dynamic rendering. Set *aspects to what there is of depth and stencil.
static uint32_t find_formats(const VkGraphicsPipelineCreateInfo *info, VkFormat *colors,
                             VkImageAspectFlags *aspects)
{
    uint32_t count = 0;
    *aspects = 0;
    if (info->renderPass) {
        const struct vulkan_subpass *const subpass = &info->renderPass->subpasses[info->subpass];
        for (; count < subpass->color_count; count++) {
            colors[count] = vulkan_render_pass_format(info->renderPass, subpass->colors[count]);
        }
        *aspects = aspects_of(vulkan_render_pass_format(info->renderPass, subpass->depth));
        return count;
    }
    const VkPipelineRenderingCreateInfo *const rendering =
        vulkan_chain_find(info->pNext, VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
    if (rendering) {
        for (; count < rendering->colorAttachmentCount && count < RHW_MAX_COLOR_ATTACHMENTS; count++) {
            colors[count] = rendering->pColorAttachmentFormats[count];
        }
        *aspects = (aspects_of(rendering->depthAttachmentFormat) & VK_IMAGE_ASPECT_DEPTH_BIT) |
                   (aspects_of(rendering->stencilAttachmentFormat) & VK_IMAGE_ASPECT_STENCIL_BIT);
    }
    return count;
}

void vulkan_pipeline_state_fill(VkPipeline pipeline, const VkGraphicsPipelineCreateInfo *info,
                                const struct rhw_shader_info *inputs)
{
    VkFormat colors[RHW_MAX_COLOR_ATTACHMENTS];
    VkImageAspectFlags aspects;
    const uint32_t color_count = find_formats(info, colors, &aspects);
    for (uint32_t i = 0; info->pDynamicState && i < info->pDynamicState->dynamicStateCount; i++) {
        pipeline->dynamic |= vulkan_dynamic_of(info->pDynamicState->pDynamicStates[i]);
    }
    pipeline->def.program = *rhw_shader_program_get(pipeline->variants[0].program);
    pipeline->samples = 1;
    pipeline->state.line_width = 1;
    pipeline->state.depth_bounds[1] = 1;
    fill_vertex_input(pipeline, info->pVertexInputState, inputs);
    fill_assembly(&pipeline->def, info->pInputAssemblyState);
    fill_rasterization(pipeline, info->pRasterizationState);
    // What stands behind rasterization is not looked at where it is off.
    const bool is_drawn = !info->pRasterizationState->rasterizerDiscardEnable;
    if (is_drawn && info->pViewportState) {
        fill_viewports(pipeline, info->pViewportState);
    }
    if (is_drawn && info->pMultisampleState) {
        fill_multisampling(pipeline, info->pMultisampleState);
    }
    if (is_drawn && aspects != 0 && info->pDepthStencilState) {
        fill_depth_stencil(pipeline, info->pDepthStencilState, aspects);
    }
    fill_targets(pipeline, is_drawn ? info->pColorBlendState : NULL, colors, color_count);
}

// Let the fragment function be called for every sample, with the values there.
static void shade_samples(struct rhw_program *program)
{
    for (int i = 0; i < program->varying_count; i++) {
        program->varyings[i].sampling = RHW_SAMPLING_SAMPLE;
    }
    program->uses |= RHW_USE_SAMPLE;
}

static void set_feedback(const struct rhw_shader_feedback *feedback, struct rhw_pipeline_def *def)
{
    memcpy(def->feedback_outputs, feedback->outputs, sizeof def->feedback_outputs);
    memcpy(def->feedback_strides, feedback->strides, sizeof def->feedback_strides);
    def->feedback_output_count = feedback->output_count;
}

void vulkan_pipeline_definition(VkPipeline pipeline, uint32_t variant, struct rhw_pipeline_def *def)
{
    *def = pipeline->def;
    def->program = *rhw_shader_program_get(pipeline->variants[variant].program);
    set_feedback(rhw_shader_program_get_feedback(pipeline->variants[variant].program), def);
    if (pipeline->shades_samples) {
        shade_samples(&def->program);
    }
}

static void tell(void *user, const char *message)
{
    (void)user;
    vulkan_log("%s", message);
}

VkResult vulkan_pipeline_state_check(VkPipeline pipeline)
{
    bool is_good = true;
    for (uint32_t v = 0; is_good && v < pipeline->variant_count; v++) {
        if (pipeline->variants[v].program) {
            struct rhw_pipeline_def def;
            vulkan_pipeline_definition(pipeline, v, &def);
            is_good = rhw_driver_pipeline_check(&def, tell);
        }
    }
    return is_good ? VK_SUCCESS : VK_ERROR_UNKNOWN;
}
