// SPDX-License-Identifier: MIT
#include "vulkan_picture.h"

enum { COLOR, DEPTH, SAMPLES }; // attachments

static void create_pass(struct picture *picture)
{
    const bool resolves = picture->sample_count != VK_SAMPLE_COUNT_1_BIT;
    const VkAttachmentDescription color = {.format = VK_FORMAT_R8G8B8A8_UNORM,
                                           .samples = VK_SAMPLE_COUNT_1_BIT,
                                           .loadOp = resolves ? VK_ATTACHMENT_LOAD_OP_DONT_CARE
                                                              : VK_ATTACHMENT_LOAD_OP_CLEAR,
                                           .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                           .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const VkAttachmentDescription depth = {.format = VK_FORMAT_D32_SFLOAT_S8_UINT,
                                           .samples = picture->sample_count,
                                           .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                           .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                           .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                           .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                           .finalLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    VkAttachmentDescription samples = color;
    samples.samples = picture->sample_count;
    samples.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    samples.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    samples.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    const VkAttachmentDescription attachments[] = {[COLOR] = color, [DEPTH] = depth, [SAMPLES] = samples};
    const VkAttachmentReference target = {resolves ? SAMPLES : COLOR,
                                          VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference resolve = {COLOR, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference depth_reference = {picture->has_depth ? DEPTH : VK_ATTACHMENT_UNUSED,
                                                   VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass = {.colorAttachmentCount = 1,
                                          .pColorAttachments = &target,
                                          .pResolveAttachments = resolves ? &resolve : NULL,
                                          .pDepthStencilAttachment = &depth_reference};
    const VkSubpassDependency end = {.srcSubpass = 0,
                                     .dstSubpass = VK_SUBPASS_EXTERNAL,
                                     .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                     .dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT,
                                     .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                     .dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .attachmentCount = resolves ? 3 : 2,
                                         .pAttachments = attachments,
                                         .subpassCount = 1,
                                         .pSubpasses = &subpass,
                                         .dependencyCount = 1,
                                         .pDependencies = &end};
    CHECK(vkCreateRenderPass(picture->rig->device, &info, NULL, &picture->pass));
    RIG_KEEP(picture->rig, RENDER_PASS, picture->pass);
}

void picture_init(struct picture *picture, struct rig *rig, bool has_depth, VkSampleCountFlagBits samples)
{
    *picture = (struct picture){.rig = rig, .has_depth = has_depth, .sample_count = samples};
    picture->color =
        rig_image(rig, VK_FORMAT_R8G8B8A8_UNORM, PICTURE_SIZE, PICTURE_SIZE, VK_SAMPLE_COUNT_1_BIT,
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    picture->depth = rig_image(rig, VK_FORMAT_D32_SFLOAT_S8_UINT, PICTURE_SIZE, PICTURE_SIZE, samples,
                               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    if (samples != VK_SAMPLE_COUNT_1_BIT) {
        picture->samples = rig_image(rig, VK_FORMAT_R8G8B8A8_UNORM, PICTURE_SIZE, PICTURE_SIZE, samples,
                                     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
    }
    create_pass(picture);
    const VkImageView views[] = {
        [COLOR] = picture->color.view, [DEPTH] = picture->depth.view, [SAMPLES] = picture->samples.view};
    picture->framebuffer =
        rig_framebuffer(rig, picture->pass, views, samples != VK_SAMPLE_COUNT_1_BIT ? 3 : 2, PICTURE_SIZE);
}

void picture_begin(struct picture *picture)
{
    const VkClearValue red = {.color = {.float32 = {0.25f, 0, 0, 1}}};
    // A depth of 1 and a stencil of 0, or a red of 1 where that attachment has colours.
    const VkClearValue far = {.color = {.float32 = {1, 0, 0, 0}}};
    const VkClearValue clears[] = {[COLOR] = red, [DEPTH] = far, [SAMPLES] = red};
    const VkRect2D area = {.extent = {PICTURE_SIZE, PICTURE_SIZE}};
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .renderPass = picture->pass,
                                         .framebuffer = picture->framebuffer,
                                         .renderArea = area,
                                         .clearValueCount = 3,
                                         .pClearValues = clears};
    const VkViewport viewport = {.width = PICTURE_SIZE, .height = PICTURE_SIZE, .maxDepth = 1};
    vkCmdBeginRenderPass(picture->rig->commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdSetViewport(picture->rig->commands, 0, 1, &viewport);
    vkCmdSetScissor(picture->rig->commands, 0, 1, &area);
}

void picture_end(struct picture *picture)
{
    vkCmdEndRenderPass(picture->rig->commands);
    picture->texels = rig_read(picture->rig, &picture->color, 4).bytes;
    rig_run(picture->rig);
}

uint32_t picture_texel(const struct picture *picture, int x, int y)
{
    const uint8_t *const texel = &picture->texels[4 * (y * PICTURE_SIZE + x)];
    return (uint32_t)texel[0] << 24 | (uint32_t)texel[1] << 16 | (uint32_t)texel[2] << 8 | texel[3];
}

void picture_state(struct picture_state *state, const struct picture *picture, VkShaderModule vertex,
                   VkShaderModule fragment, VkPipelineLayout layout)
{
    const VkPipelineShaderStageCreateInfo stage = {.sType =
                                                       VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                                   .stage = VK_SHADER_STAGE_VERTEX_BIT,
                                                   .module = vertex,
                                                   .pName = "main"};
    *state = (struct picture_state){
        .stages = {stage, stage},
        .input = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO},
        .assembly = {.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
                     .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST},
        .viewports = {.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
                      .viewportCount = 1,
                      .scissorCount = 1},
        .rasterization = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
                          .lineWidth = 1},
        .samples = {.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                    .rasterizationSamples = picture->sample_count},
        .depth = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO},
        .blend = {{.colorWriteMask = 15}},
        .blends = {.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = 1},
        .dynamic = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR},
        .dynamics = {.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO, .dynamicStateCount = 2},
        .layout = layout};
    state->stages[1].stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    state->stages[1].module = fragment;
}

VkResult picture_try_pipeline(const struct picture *picture, struct picture_state *state, VkRenderPass pass,
                              uint32_t subpass, VkPipeline *pipeline)
{
    state->input.pVertexBindingDescriptions = state->buffers;
    state->input.pVertexAttributeDescriptions = state->attributes;
    state->blends.pAttachments = state->blend;
    state->dynamics.pDynamicStates = state->dynamic;
    const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .pNext = state->next,
                                               .stageCount = state->stages[1].module ? 2 : 1,
                                               .pStages = state->stages,
                                               .pVertexInputState = &state->input,
                                               .pInputAssemblyState = &state->assembly,
                                               .pViewportState = &state->viewports,
                                               .pRasterizationState = &state->rasterization,
                                               .pMultisampleState = &state->samples,
                                               .pDepthStencilState = &state->depth,
                                               .pColorBlendState = &state->blends,
                                               .pDynamicState = &state->dynamics,
                                               .layout = state->layout,
                                               .renderPass = pass,
                                               .subpass = subpass};
    return vkCreateGraphicsPipelines(picture->rig->device, VK_NULL_HANDLE, 1, &info, NULL, pipeline);
}

VkPipeline picture_pipeline(const struct picture *picture, struct picture_state *state, VkRenderPass pass,
                            uint32_t subpass)
{
    VkPipeline pipeline;
    CHECK(picture_try_pipeline(picture, state, pass, subpass, &pipeline));
    RIG_KEEP(picture->rig, PIPELINE, pipeline);
    return pipeline;
}
