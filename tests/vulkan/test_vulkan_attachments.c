// SPDX-License-Identifier: MIT
// What render passes do with their attachments beside drawing: aspects, resolves, loads and areas.
#include <stdlib.h>
#include <string.h>

#include "quad_vert.h"
#include "shade_frag.h"
#include "two_sources_frag.h"
#include "vulkan_picture.h"

enum { SIDE = 8, TEXELS = SIDE * SIDE };

static struct rig_image make_image(struct rig *rig, VkFormat format, VkSampleCountFlagBits samples)
{
    const bool is_color = format == VK_FORMAT_R8G8B8A8_UNORM;
    return rig_image(rig, format, SIDE, SIDE, samples,
                     (VkImageUsageFlags)(is_color ? VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                        VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT
                                                  : VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT) |
                         VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
}

// Record a copy of one aspect of an image in layout TRANSFER_SRC_OPTIMAL.
static struct rig_buffer read_aspect(struct rig *rig, const struct rig_image *image,
                                     VkImageAspectFlags aspect)
{
    const struct rig_buffer buffer = rig_buffer(rig, 4 * TEXELS, NULL);
    const VkBufferImageCopy copy = {.imageSubresource = {.aspectMask = aspect, .layerCount = 1},
                                    .imageExtent = {SIDE, SIDE, 1}};
    vkCmdCopyImageToBuffer(rig->commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer,
                           1, &copy);
    return buffer;
}

static VkAttachmentDescription2 describe(VkFormat format, VkSampleCountFlagBits samples, VkImageLayout last)
{
    return (VkAttachmentDescription2){.sType = VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2,
                                      .format = format,
                                      .samples = samples,
                                      .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                      .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                      .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                      .stencilStoreOp = VK_ATTACHMENT_STORE_OP_STORE,
                                      .finalLayout = last};
}

static VkAttachmentReference2 refer(uint32_t number, VkImageLayout layout, VkImageAspectFlags aspects)
{
    return (VkAttachmentReference2){.sType = VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2,
                                    .attachment = number,
                                    .layout = layout,
                                    .aspectMask = aspects};
}

// Create a pass of one subpass, after which everything waits.
static VkRenderPass make_pass(struct rig *rig, const VkAttachmentDescription2 *attachments, uint32_t count,
                              VkSubpassDescription2 subpass)
{
    const PFN_vkCreateRenderPass2KHR create =
        (PFN_vkCreateRenderPass2KHR)vkGetDeviceProcAddr(rig->device, "vkCreateRenderPass2KHR");
    const VkSubpassDependency2 end = {.sType = VK_STRUCTURE_TYPE_SUBPASS_DEPENDENCY_2,
                                      .srcSubpass = 0,
                                      .dstSubpass = VK_SUBPASS_EXTERNAL,
                                      .srcStageMask = VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT,
                                      .dstStageMask = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                      .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                                      .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT};
    subpass.sType = VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2;
    const VkRenderPassCreateInfo2 info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2,
                                          .attachmentCount = count,
                                          .pAttachments = attachments,
                                          .subpassCount = 1,
                                          .pSubpasses = &subpass,
                                          .dependencyCount = 1,
                                          .pDependencies = &end};
    VkRenderPass pass;
    CHECK(create(rig->device, &info, NULL, &pass));
    RIG_KEEP(rig, RENDER_PASS, pass);
    return pass;
}

static void begin_pass(struct rig *rig, const void *next, VkRenderPass pass, VkFramebuffer framebuffer,
                       const VkClearValue *clears, uint32_t count)
{
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .pNext = next,
                                         .renderPass = pass,
                                         .framebuffer = framebuffer,
                                         .renderArea = {.extent = {SIDE, SIDE}},
                                         .clearValueCount = count,
                                         .pClearValues = clears};
    vkCmdBeginRenderPass(rig->commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
}

// Depth and stencil ----------------------------------------------------------------------------------

// Resolve depth of 0.5 and stencil of 7, of 4 samples, into a format, whose own clear values are 0.25 and 9.
static void resolve_into(struct rig *rig, VkFormat from, VkFormat to, VkResolveModeFlagBits depth_mode,
                         VkResolveModeFlagBits stencil_mode, struct rig_buffer read[2])
{
    const bool has_depth = to != VK_FORMAT_S8_UINT, has_stencil = to == VK_FORMAT_S8_UINT || to == from;
    const VkImageAspectFlags aspects[2] = {VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_ASPECT_STENCIL_BIT};
    const struct rig_image many = make_image(rig, from, VK_SAMPLE_COUNT_4_BIT);
    const struct rig_image one = make_image(rig, to, VK_SAMPLE_COUNT_1_BIT);
    const VkAttachmentDescription2 attachments[2] = {
        describe(from, VK_SAMPLE_COUNT_4_BIT, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
        describe(to, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)};
    const VkAttachmentReference2 depth =
        refer(0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, aspects[0] | aspects[1]);
    const VkAttachmentReference2 target =
        refer(1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, aspects[0] | aspects[1]);
    const VkSubpassDescriptionDepthStencilResolve resolve = {
        .sType = VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE,
        .depthResolveMode = depth_mode,
        .stencilResolveMode = stencil_mode,
        .pDepthStencilResolveAttachment = &target};
    const VkRenderPass pass = make_pass(
        rig, attachments, 2, (VkSubpassDescription2){.pNext = &resolve, .pDepthStencilAttachment = &depth});
    const VkImageView views[2] = {many.view, one.view};
    const VkClearValue clears[2] = {{.depthStencil = {0.5f, 7}}, {.depthStencil = {0.25f, 9}}};
    begin_pass(rig, NULL, pass, rig_framebuffer(rig, pass, views, 2, SIDE), clears, 2);
    vkCmdEndRenderPass(rig->commands);
    if (has_depth) {
        read[0] = read_aspect(rig, &one, aspects[0]);
    }
    if (has_stencil) {
        read[1] = read_aspect(rig, &one, aspects[1]);
    }
    rig_run(rig);
}

static void expect_depth(const struct rig_buffer *buffer, float depth)
{
    for (int i = 0; i < TEXELS; i++) {
        assert_true(((const float *)buffer->bytes)[i] == depth);
    }
}

static void expect_bytes(const struct rig_buffer *buffer, int byte)
{
    for (int i = 0; i < TEXELS; i++) {
        assert_int_equal(((const uint8_t *)buffer->bytes)[i], byte);
    }
}

// A rendering that clears both aspects of 4 samples and resolves depth alone leaves the stencil of 9 that is there.
static void a_rendering_resolves_one_aspect(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const VkFormat both = VK_FORMAT_D32_SFLOAT_S8_UINT;
    const VkImageLayout drawn = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const struct rig_image many = make_image(&rig, both, VK_SAMPLE_COUNT_4_BIT);
    const struct rig_image one = make_image(&rig, both, VK_SAMPLE_COUNT_1_BIT);
    const VkAttachmentDescription2 filled = describe(both, VK_SAMPLE_COUNT_1_BIT, drawn);
    const VkAttachmentReference2 depth =
        refer(0, drawn, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT);
    const VkRenderPass pass =
        make_pass(&rig, &filled, 1, (VkSubpassDescription2){.pDepthStencilAttachment = &depth});
    const VkClearValue before = {.depthStencil = {0.25f, 9}}, after = {.depthStencil = {0.5f, 7}};
    begin_pass(&rig, NULL, pass, rig_framebuffer(&rig, pass, &one.view, 1, SIDE), &before, 1);
    vkCmdEndRenderPass(rig.commands);
    VkRenderingAttachmentInfo aspects[2];
    for (int i = 0; i < 2; i++) {
        aspects[i] = (VkRenderingAttachmentInfo){.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                                 .imageView = many.view,
                                                 .imageLayout = drawn,
                                                 .resolveMode = i == 0 ? VK_RESOLVE_MODE_SAMPLE_ZERO_BIT
                                                                       : VK_RESOLVE_MODE_NONE,
                                                 .resolveImageView = i == 0 ? one.view : VK_NULL_HANDLE,
                                                 .resolveImageLayout = drawn,
                                                 .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                                 .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                                 .clearValue = after};
    }
    const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {.extent = {SIDE, SIDE}},
                                  .layerCount = 1,
                                  .pDepthAttachment = &aspects[0],
                                  .pStencilAttachment = &aspects[1]};
    rig_barrier(&rig, &many, VK_IMAGE_LAYOUT_UNDEFINED, drawn);
    ((PFN_vkCmdBeginRenderingKHR)vkGetDeviceProcAddr(rig.device, "vkCmdBeginRenderingKHR"))(rig.commands,
                                                                                            &info);
    ((PFN_vkCmdEndRenderingKHR)vkGetDeviceProcAddr(rig.device, "vkCmdEndRenderingKHR"))(rig.commands);
    rig_barrier(&rig, &one, drawn, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const struct rig_buffer read[2] = {read_aspect(&rig, &one, VK_IMAGE_ASPECT_DEPTH_BIT),
                                       read_aspect(&rig, &one, VK_IMAGE_ASPECT_STENCIL_BIT)};
    rig_run(&rig);
    expect_depth(&read[0], 0.5f);
    expect_bytes(&read[1], 9);
    rig_close(&rig);
}

static void one_aspect_is_resolved_alone(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_buffer read[2];
    rig_open(&rig);
    const VkFormat both = VK_FORMAT_D32_SFLOAT_S8_UINT;
    const VkResolveModeFlagBits zero = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT, none = VK_RESOLVE_MODE_NONE;
    resolve_into(&rig, both, VK_FORMAT_D32_SFLOAT, VK_RESOLVE_MODE_MAX_BIT, none, read);
    expect_depth(&read[0], 0.5f);
    resolve_into(&rig, both, VK_FORMAT_S8_UINT, none, VK_RESOLVE_MODE_MIN_BIT, read);
    expect_bytes(&read[1], 7);
    resolve_into(&rig, both, both, zero, zero, read);
    expect_depth(&read[0], 0.5f);
    expect_bytes(&read[1], 7);
    // What is not resolved is loaded, which clears it here.
    resolve_into(&rig, both, both, zero, none, read);
    expect_depth(&read[0], 0.5f);
    expect_bytes(&read[1], 9);
    resolve_into(&rig, both, both, none, zero, read);
    expect_depth(&read[0], 0.25f);
    expect_bytes(&read[1], 7);
    rig_close(&rig);
}

static void a_clear_of_what_is_not_there_does_nothing(void **state)
{
    (void)state;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // Vulkan wants the aspect to be there
    }
    struct rig rig;
    rig_open(&rig);
    const struct rig_image image = make_image(&rig, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_1_BIT);
    const VkAttachmentDescription2 attachment =
        describe(image.format, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkAttachmentReference2 depth =
        refer(0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_DEPTH_BIT);
    const VkRenderPass pass =
        make_pass(&rig, &attachment, 1, (VkSubpassDescription2){.pDepthStencilAttachment = &depth});
    const VkClearValue far = {.depthStencil = {1, 0}};
    const VkClearAttachment near = {
        .aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT,
        .clearValue = {.depthStencil = {0.25f, 3}},
    };
    const VkClearRect all = {{{0, 0}, {SIDE, SIDE}}, 0, 1};
    begin_pass(&rig, NULL, pass, rig_framebuffer(&rig, pass, &image.view, 1, SIDE), &far, 1);
    vkCmdClearAttachments(rig.commands, 1, &near, 1, &all);
    vkCmdEndRenderPass(rig.commands);
    const struct rig_buffer read = read_aspect(&rig, &image, VK_IMAGE_ASPECT_DEPTH_BIT);
    rig_run(&rig);
    expect_depth(&read, 0.25f);
    rig_close(&rig);
}

// Draw a quad at depth 0.5 by a pipeline whose tests of depth and stencil never pass, in a rendering that has one of
// the two aspects, and return the colours.
static uint32_t draw_with_aspect(bool has_depth)
{
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    rig_open(&rig);
    picture_init(&picture, &rig, true, VK_SAMPLE_COUNT_1_BIT);
    VkPipelineLayout layout = rig_layout(&rig, NULL, 0, 36);
    picture_state(&state, &picture, rig_shader(&rig, quad_vert, sizeof quad_vert),
                  rig_shader(&rig, shade_frag, sizeof shade_frag), layout);
    state.depth.depthTestEnable = state.depth.stencilTestEnable = VK_TRUE;
    state.depth.depthCompareOp = has_depth ? VK_COMPARE_OP_ALWAYS : VK_COMPARE_OP_NEVER;
    state.depth.front.compareOp = has_depth ? VK_COMPARE_OP_NEVER : VK_COMPARE_OP_ALWAYS;
    state.depth.back.compareOp = state.depth.front.compareOp;
    const VkFormat color_format = VK_FORMAT_R8G8B8A8_UNORM;
    const VkPipelineRenderingCreateInfo formats = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = 1,
        .pColorAttachmentFormats = &color_format,
        .depthAttachmentFormat = has_depth ? VK_FORMAT_D32_SFLOAT_S8_UINT : VK_FORMAT_UNDEFINED,
        .stencilAttachmentFormat = has_depth ? VK_FORMAT_UNDEFINED : VK_FORMAT_D32_SFLOAT_S8_UINT};
    state.next = &formats;
    VkPipeline pipeline = picture_pipeline(&picture, &state, VK_NULL_HANDLE, 0);
    const VkRenderingAttachmentInfo color = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = picture.color.view,
                                             .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingAttachmentInfo aspect = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                              .imageView = picture.depth.view,
                                              .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
                                              .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                              .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE};
    const VkRect2D area = {.extent = {PICTURE_SIZE, PICTURE_SIZE}};
    const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = area,
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color,
                                  .pDepthAttachment = has_depth ? &aspect : NULL,
                                  .pStencilAttachment = has_depth ? NULL : &aspect};
    const VkViewport viewport = {.width = PICTURE_SIZE, .height = PICTURE_SIZE, .maxDepth = 1};
    const float push[9] = {-1, -1, 1, 1, 0, 1, 0, 1, 0.5f};
    rig_barrier(&rig, &picture.color, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    rig_barrier(&rig, &picture.depth, VK_IMAGE_LAYOUT_UNDEFINED,
                VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    ((PFN_vkCmdBeginRenderingKHR)vkGetDeviceProcAddr(rig.device, "vkCmdBeginRenderingKHR"))(rig.commands,
                                                                                            &info);
    vkCmdSetViewport(rig.commands, 0, 1, &viewport);
    vkCmdSetScissor(rig.commands, 0, 1, &area);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdPushConstants(rig.commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof push, push);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    ((PFN_vkCmdEndRenderingKHR)vkGetDeviceProcAddr(rig.device, "vkCmdEndRenderingKHR"))(rig.commands);
    rig_barrier(&rig, &picture.color, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    picture.texels = rig_read(&rig, &picture.color, 4).bytes;
    rig_run(&rig);
    const uint32_t texel = picture_texel(&picture, 30, 30);
    rig_close(&rig);
    return texel;
}

static void tests_of_an_aspect_that_is_not_rendered_pass(void **state)
{
    (void)state;
    assert_int_equal(draw_with_aspect(true), 0x00ff00ff);
    assert_int_equal(draw_with_aspect(false), 0x00ff00ff);
}

// Many attachments -----------------------------------------------------------------------------------

static void a_pass_has_any_number_of_attachments_and_inputs(void **state)
{
    (void)state;
    enum { INPUTS = 12, COUNT = 80 };
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // Vulkan clears no attachment whose first use is as an input
    }
    struct rig rig;
    rig_open(&rig);
    const struct rig_image first = make_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    const struct rig_image input = make_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    const struct rig_image last = make_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    VkAttachmentDescription2 attachments[COUNT];
    VkImageView views[COUNT];
    VkClearValue clears[COUNT] = {0};
    for (int i = 0; i < COUNT; i++) {
        attachments[i] =
            describe(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        attachments[i].flags = VK_ATTACHMENT_DESCRIPTION_MAY_ALIAS_BIT;
        views[i] = first.view;
    }
    VkAttachmentReference2 inputs[INPUTS];
    for (int i = 0; i < INPUTS; i++) {
        inputs[i] = refer(VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_ASPECT_COLOR_BIT);
    }
    inputs[INPUTS - 1].attachment = 70;
    views[70] = input.view;
    views[COUNT - 1] = last.view;
    clears[70].color.float32[0] = 1;
    clears[COUNT - 1].color.float32[1] = 1;
    const VkAttachmentReference2 color =
        refer(COUNT - 1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_COLOR_BIT);
    const VkRenderPass pass = make_pass(&rig, attachments, COUNT,
                                        (VkSubpassDescription2){.inputAttachmentCount = INPUTS,
                                                                .pInputAttachments = inputs,
                                                                .colorAttachmentCount = 1,
                                                                .pColorAttachments = &color});
    begin_pass(&rig, NULL, pass, rig_framebuffer(&rig, pass, views, COUNT, SIDE), clears, COUNT);
    vkCmdEndRenderPass(rig.commands);
    const struct rig_buffer red = rig_read(&rig, &input, 4), green = rig_read(&rig, &last, 4);
    rig_run(&rig);
    assert_memory_equal(red.bytes, ((const uint8_t[]){255, 0, 0, 0}), 4);
    assert_memory_equal(green.bytes, ((const uint8_t[]){0, 255, 0, 0}), 4);
    rig_close(&rig);
}

// A shader with two sources of blending draws into one attachment, and a pass may have more.
static void a_second_source_leaves_other_attachments(void **unused)
{
    (void)unused;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer takes the second source for another attachment
    }
    struct rig rig;
    struct picture picture = {.rig = &rig, .sample_count = VK_SAMPLE_COUNT_1_BIT};
    struct picture_state state;
    rig_open(&rig);
    VkAttachmentDescription2 attachments[2];
    struct rig_image images[2];
    VkImageView views[2];
    VkAttachmentReference2 colors[2];
    VkClearValue clears[2] = {{.color = {.float32 = {1, 1, 1, 1}}}, {.color = {.float32 = {0, 1, 0, 1}}}};
    for (uint32_t i = 0; i < 2; i++) {
        attachments[i] =
            describe(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        images[i] = make_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
        views[i] = images[i].view;
        colors[i] = refer(i, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_COLOR_BIT);
    }
    const VkRenderPass pass =
        make_pass(&rig, attachments, 2,
                  (VkSubpassDescription2){.colorAttachmentCount = 2, .pColorAttachments = colors});
    VkPipelineLayout layout = rig_layout(&rig, NULL, 0, 36);
    picture_state(&state, &picture, rig_shader(&rig, quad_vert, sizeof quad_vert),
                  rig_shader(&rig, two_sources_frag, sizeof two_sources_frag), layout);
    state.blend[0].blendEnable = VK_TRUE;
    state.blend[0].srcColorBlendFactor = state.blend[0].srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    state.blend[0].dstColorBlendFactor = state.blend[0].dstAlphaBlendFactor = VK_BLEND_FACTOR_SRC1_COLOR;
    state.blends.attachmentCount = 2; // the second one writes no channel
    VkPipeline pipeline = picture_pipeline(&picture, &state, pass, 0);
    const VkViewport viewport = {.width = SIDE, .height = SIDE, .maxDepth = 1};
    const VkRect2D area = {.extent = {SIDE, SIDE}};
    const float push[9] = {-1, -1, 1, 1, 0.2f, 0.4f, 0, 0, 0.5f};
    begin_pass(&rig, NULL, pass, rig_framebuffer(&rig, pass, views, 2, SIDE), clears, 2);
    vkCmdSetViewport(rig.commands, 0, 1, &viewport);
    vkCmdSetScissor(rig.commands, 0, 1, &area);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdPushConstants(rig.commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof push, push);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    vkCmdEndRenderPass(rig.commands);
    const struct rig_buffer first = rig_read(&rig, &images[0], 4), second = rig_read(&rig, &images[1], 4);
    rig_run(&rig);
    assert_memory_equal(first.bytes, ((const uint8_t[]){115, 166, 64, 64}), 4); // 51 + 255 / 4, …
    assert_memory_equal(second.bytes, ((const uint8_t[]){0, 255, 0, 255}), 4);
    rig_close(&rig);
}

// Create a pass that clears one attachment of colours, which was in layout GENERAL.
static VkRenderPass make_clear_pass(struct rig *rig)
{
    VkAttachmentDescription2 attachment =
        describe(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    attachment.initialLayout = VK_IMAGE_LAYOUT_GENERAL;
    const VkAttachmentReference2 color =
        refer(0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_COLOR_BIT);
    return make_pass(rig, &attachment, 1,
                     (VkSubpassDescription2){.colorAttachmentCount = 1, .pColorAttachments = &color});
}

static void a_device_of_a_group_has_a_render_area(void **state)
{
    (void)state;
    static const uint32_t zeros[TEXELS] = {0};
    struct rig rig;
    rig_open(&rig);
    const struct rig_image image = make_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    const VkRenderPass pass = make_clear_pass(&rig);
    const VkRect2D left = {{0, 0}, {SIDE / 2, SIDE}};
    const VkDeviceGroupRenderPassBeginInfo group = {.sType =
                                                        VK_STRUCTURE_TYPE_DEVICE_GROUP_RENDER_PASS_BEGIN_INFO,
                                                    .deviceMask = 1,
                                                    .deviceRenderAreaCount = 1,
                                                    .pDeviceRenderAreas = &left};
    const VkClearValue white = {.color = {.float32 = {1, 1, 1, 1}}};
    rig_write(&rig, &image, zeros, 4, VK_IMAGE_LAYOUT_GENERAL);
    begin_pass(&rig, &group, pass, rig_framebuffer(&rig, pass, &image.view, 1, SIDE), &white, 1);
    vkCmdEndRenderPass(rig.commands);
    const struct rig_buffer read = rig_read(&rig, &image, 4);
    rig_run(&rig);
    for (int i = 0; i < TEXELS; i++) {
        assert_int_equal(((const uint32_t *)read.bytes)[i], i % SIDE < SIDE / 2 ? UINT32_MAX : 0);
    }
    rig_close(&rig);
}

static void a_subpass_too_many_is_the_last_one(void **state)
{
    (void)state;
    static const uint32_t zeros[TEXELS] = {0};
    struct rig rig;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the misuse
    }
    rig_open(&rig);
    const struct rig_image image = make_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    const VkRenderPass pass = make_clear_pass(&rig);
    const VkClearValue white = {.color = {.float32 = {1, 1, 1, 1}}};
    const VkClearAttachment black = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT};
    const VkClearRect all = {{{0, 0}, {SIDE, SIDE}}, 0, 1};
    rig_write(&rig, &image, zeros, 4, VK_IMAGE_LAYOUT_GENERAL);
    begin_pass(&rig, NULL, pass, rig_framebuffer(&rig, pass, &image.view, 1, SIDE), &white, 1);
    for (int i = 0; i < 9; i++) {
        vkCmdNextSubpass(rig.commands, VK_SUBPASS_CONTENTS_INLINE);
    }
    vkCmdClearAttachments(rig.commands, 1, &black, 1, &all);
    vkCmdEndRenderPass(rig.commands);
    const struct rig_buffer read = rig_read(&rig, &image, 4);
    rig_run(&rig);
    assert_int_equal(((const uint32_t *)read.bytes)[0], 0);
    rig_close(&rig);
}

static void a_framebuffer_may_be_imageless(void **state)
{
    (void)state;
    static const uint32_t zeros[TEXELS] = {0};
    struct rig rig;
    rig_open(&rig);
    const VkRenderPass pass = make_clear_pass(&rig);
    const VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    const VkFramebufferAttachmentImageInfo image_info = {
        .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_ATTACHMENT_IMAGE_INFO,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT |
                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .width = SIDE,
        .height = SIDE,
        .layerCount = 1,
        .viewFormatCount = 1,
        .pViewFormats = &format};
    const VkFramebufferAttachmentsCreateInfo images = {
        .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_ATTACHMENTS_CREATE_INFO,
        .attachmentImageInfoCount = 1,
        .pAttachmentImageInfos = &image_info};
    const VkFramebufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                          .pNext = &images,
                                          .flags = VK_FRAMEBUFFER_CREATE_IMAGELESS_BIT,
                                          .renderPass = pass,
                                          .attachmentCount = 1,
                                          .width = SIDE,
                                          .height = SIDE,
                                          .layers = 1};
    VkFramebuffer framebuffer;
    CHECK(vkCreateFramebuffer(rig.device, &info, NULL, &framebuffer));
    RIG_KEEP(&rig, FRAMEBUFFER, framebuffer);
    struct rig_buffer read[2];
    for (int i = 0; i < 2; i++) {
        const struct rig_image image = make_image(&rig, format, VK_SAMPLE_COUNT_1_BIT);
        const VkRenderPassAttachmentBeginInfo attachments = {
            .sType = VK_STRUCTURE_TYPE_RENDER_PASS_ATTACHMENT_BEGIN_INFO,
            .attachmentCount = 1,
            .pAttachments = &image.view};
        const VkClearValue color = {.color = {.float32 = {(float)i, 0, 0, 1}}};
        rig_write(&rig, &image, zeros, 4, VK_IMAGE_LAYOUT_GENERAL);
        begin_pass(&rig, &attachments, pass, framebuffer, &color, 1);
        vkCmdEndRenderPass(rig.commands);
        read[i] = rig_read(&rig, &image, 4);
    }
    rig_run(&rig);
    assert_memory_equal(read[0].bytes, ((const uint8_t[]){0, 0, 0, 255}), 4);
    assert_memory_equal(read[1].bytes, ((const uint8_t[]){255, 0, 0, 255}), 4);
    rig_close(&rig);
}

// Without attachments --------------------------------------------------------------------------------

// A clear of an attachment that is not used does not decide how many samples the draw behind it has.
static void a_subpass_without_attachments_has_the_samples_of_its_pipelines(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture = {.rig = &rig, .sample_count = VK_SAMPLE_COUNT_4_BIT};
    struct picture_state state;
    rig_open(&rig);
    const VkAttachmentReference2 none =
        refer(VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_COLOR_BIT);
    const VkRenderPass pass = make_pass(
        &rig, NULL, 0, (VkSubpassDescription2){.colorAttachmentCount = 1, .pColorAttachments = &none});
    VkPipelineLayout layout = rig_layout(&rig, NULL, 0, 36);
    picture_state(&state, &picture, rig_shader(&rig, quad_vert, sizeof quad_vert),
                  rig_shader(&rig, shade_frag, sizeof shade_frag), layout);
    VkPipeline pipeline = picture_pipeline(&picture, &state, pass, 0);
    const VkQueryPoolCreateInfo queries = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                           .queryType = VK_QUERY_TYPE_OCCLUSION,
                                           .queryCount = 1};
    VkQueryPool pool;
    CHECK(vkCreateQueryPool(rig.device, &queries, NULL, &pool));
    vkCmdResetQueryPool(rig.commands, pool, 0, 1);
    const VkClearAttachment clear = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT};
    const VkClearRect all = {{{0, 0}, {SIDE, SIDE}}, 0, 1};
    const VkViewport viewport = {.width = SIDE, .height = SIDE, .maxDepth = 1};
    const float push[9] = {-1, -1, 1, 1, 0, 1, 0, 1, 0.5f};
    begin_pass(&rig, NULL, pass, rig_framebuffer(&rig, pass, NULL, 0, SIDE), NULL, 0);
    vkCmdClearAttachments(rig.commands, 1, &clear, 1, &all);
    vkCmdSetViewport(rig.commands, 0, 1, &viewport);
    vkCmdSetScissor(rig.commands, 0, 1, &all.rect);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdPushConstants(rig.commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof push, push);
    vkCmdBeginQuery(rig.commands, pool, 0, VK_QUERY_CONTROL_PRECISE_BIT);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    vkCmdEndQuery(rig.commands, pool, 0);
    vkCmdEndRenderPass(rig.commands);
    rig_run(&rig);
    uint64_t count = 0;
    CHECK(vkGetQueryPoolResults(rig.device, pool, 0, 1, sizeof count, &count, sizeof count,
                                VK_QUERY_RESULT_64_BIT));
    assert_int_equal(count, 4 * TEXELS);
    vkDestroyQueryPool(rig.device, pool, NULL);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(one_aspect_is_resolved_alone),
    cmocka_unit_test(a_rendering_resolves_one_aspect),
    cmocka_unit_test(a_clear_of_what_is_not_there_does_nothing),
    cmocka_unit_test(tests_of_an_aspect_that_is_not_rendered_pass),
    cmocka_unit_test(a_pass_has_any_number_of_attachments_and_inputs),
    cmocka_unit_test(a_second_source_leaves_other_attachments),
    cmocka_unit_test(a_device_of_a_group_has_a_render_area),
    cmocka_unit_test(a_subpass_too_many_is_the_last_one),
    cmocka_unit_test(a_framebuffer_may_be_imageless),
    cmocka_unit_test(a_subpass_without_attachments_has_the_samples_of_its_pipelines),
};

const struct unit_tests test_vulkan_attachments = UNIT_TESTS(tests, NULL, NULL);
