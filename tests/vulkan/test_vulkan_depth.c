// SPDX-License-Identifier: MIT
// Attachments of depth and stencil, of which a pass may use one aspect alone.
#include <stdlib.h>

#include "quad_vert.h"
#include "shade_frag.h"
#include "vulkan_pass.h"
#include "vulkan_picture.h"

// Record a copy of one aspect of an image in layout TRANSFER_SRC_OPTIMAL.
static struct rig_buffer read_aspect(struct rig *rig, const struct rig_image *image,
                                     VkImageAspectFlags aspect)
{
    const struct rig_buffer buffer = rig_buffer(rig, 4 * PASS_TEXELS, NULL);
    const VkBufferImageCopy copy = {.imageSubresource = {.aspectMask = aspect, .layerCount = 1},
                                    .imageExtent = {PASS_SIDE, PASS_SIDE, 1}};
    vkCmdCopyImageToBuffer(rig->commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer,
                           1, &copy);
    return buffer;
}

// Resolve depth of 0.5 and stencil of 7, of 4 samples, into a format, whose own clear values are 0.25 and 9.
static void resolve_into(struct rig *rig, VkFormat from, VkFormat to, VkResolveModeFlagBits depth_mode,
                         VkResolveModeFlagBits stencil_mode, struct rig_buffer read[2])
{
    const bool has_depth = to != VK_FORMAT_S8_UINT, has_stencil = to == VK_FORMAT_S8_UINT || to == from;
    const VkImageAspectFlags aspects[2] = {VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_ASPECT_STENCIL_BIT};
    const struct rig_image many = pass_image(rig, from, VK_SAMPLE_COUNT_4_BIT);
    const struct rig_image one = pass_image(rig, to, VK_SAMPLE_COUNT_1_BIT);
    const VkAttachmentDescription2 attachments[2] = {
        pass_attachment(from, VK_SAMPLE_COUNT_4_BIT, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL),
        pass_attachment(to, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)};
    const VkAttachmentReference2 depth =
        pass_reference(0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, aspects[0] | aspects[1]);
    const VkAttachmentReference2 target =
        pass_reference(1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, aspects[0] | aspects[1]);
    const VkSubpassDescriptionDepthStencilResolve resolve = {
        .sType = VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE,
        .depthResolveMode = depth_mode,
        .stencilResolveMode = stencil_mode,
        .pDepthStencilResolveAttachment = &target};
    const VkRenderPass pass = pass_create(
        rig, attachments, 2, (VkSubpassDescription2){.pNext = &resolve, .pDepthStencilAttachment = &depth});
    const VkImageView views[2] = {many.view, one.view};
    const VkClearValue clears[2] = {{.depthStencil = {0.5f, 7}}, {.depthStencil = {0.25f, 9}}};
    pass_begin(rig, NULL, pass, rig_framebuffer(rig, pass, views, 2, PASS_SIDE), clears, 2);
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
    for (int i = 0; i < PASS_TEXELS; i++) {
        assert_true(((const float *)buffer->bytes)[i] == depth);
    }
}

static void expect_bytes(const struct rig_buffer *buffer, int byte)
{
    for (int i = 0; i < PASS_TEXELS; i++) {
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
    const struct rig_image many = pass_image(&rig, both, VK_SAMPLE_COUNT_4_BIT);
    const struct rig_image one = pass_image(&rig, both, VK_SAMPLE_COUNT_1_BIT);
    const VkAttachmentDescription2 filled = pass_attachment(both, VK_SAMPLE_COUNT_1_BIT, drawn);
    const VkAttachmentReference2 depth =
        pass_reference(0, drawn, VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT);
    const VkRenderPass pass =
        pass_create(&rig, &filled, 1, (VkSubpassDescription2){.pDepthStencilAttachment = &depth});
    const VkClearValue before = {.depthStencil = {0.25f, 9}}, after = {.depthStencil = {0.5f, 7}};
    pass_begin(&rig, NULL, pass, rig_framebuffer(&rig, pass, &one.view, 1, PASS_SIDE), &before, 1);
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
                                  .renderArea = {.extent = {PASS_SIDE, PASS_SIDE}},
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
    const struct rig_image image = pass_image(&rig, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_1_BIT);
    const VkAttachmentDescription2 attachment =
        pass_attachment(image.format, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const VkAttachmentReference2 depth =
        pass_reference(0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_DEPTH_BIT);
    const VkRenderPass pass =
        pass_create(&rig, &attachment, 1, (VkSubpassDescription2){.pDepthStencilAttachment = &depth});
    const VkClearValue far = {.depthStencil = {1, 0}};
    const VkClearAttachment near = {
        .aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT,
        .clearValue = {.depthStencil = {0.25f, 3}},
    };
    const VkClearRect all = {{{0, 0}, {PASS_SIDE, PASS_SIDE}}, 0, 1};
    pass_begin(&rig, NULL, pass, rig_framebuffer(&rig, pass, &image.view, 1, PASS_SIDE), &far, 1);
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

static void an_image_of_one_dimension_has_depth(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_1D,
                                    .format = VK_FORMAT_D32_SFLOAT,
                                    .extent = {PASS_TEXELS, 1, 1},
                                    .mipLevels = 1,
                                    .arrayLayers = 1,
                                    .samples = VK_SAMPLE_COUNT_1_BIT,
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                             VK_IMAGE_USAGE_TRANSFER_DST_BIT};
    VkImageFormatProperties properties;
    CHECK(vkGetPhysicalDeviceImageFormatProperties(rig.physical, info.format, info.imageType, info.tiling,
                                                   info.usage, 0, &properties));
    assert_int_equal(properties.maxExtent.height, 1);
    struct rig_image image = {.format = info.format, .width = PASS_TEXELS, .height = 1, .layers = 1};
    CHECK(vkCreateImage(rig.device, &info, NULL, &image.image));
    rig_back(&rig, image.image);
    const VkClearDepthStencilValue half = {.depth = 0.5f};
    const VkImageSubresourceRange all = {
        .aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .levelCount = 1, .layerCount = 1};
    const VkImageLayout layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    rig_barrier(&rig, &image, VK_IMAGE_LAYOUT_UNDEFINED, layout);
    vkCmdClearDepthStencilImage(rig.commands, image.image, layout, &half, 1, &all);
    rig_barrier(&rig, &image, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const struct rig_buffer read = rig_read(&rig, &image, 4);
    rig_run(&rig);
    expect_depth(&read, 0.5f);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(one_aspect_is_resolved_alone),
    cmocka_unit_test(a_rendering_resolves_one_aspect),
    cmocka_unit_test(a_clear_of_what_is_not_there_does_nothing),
    cmocka_unit_test(tests_of_an_aspect_that_is_not_rendered_pass),
    cmocka_unit_test(an_image_of_one_dimension_has_depth),
};

const struct unit_tests test_vulkan_depth = UNIT_TESTS(tests, NULL, NULL);
