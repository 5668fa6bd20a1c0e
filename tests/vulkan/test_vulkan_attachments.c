// SPDX-License-Identifier: MIT
// What render passes do with their attachments beside drawing: many of them, areas, and none.
#include <stdlib.h>

#include "quad_vert.h"
#include "shade_frag.h"
#include "two_sources_frag.h"
#include "vulkan_pass.h"
#include "vulkan_picture.h"

static void a_pass_has_any_number_of_attachments_and_inputs(void **state)
{
    (void)state;
    enum { INPUTS = 12, COUNT = 80 };
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // Vulkan clears no attachment whose first use is as an input
    }
    struct rig rig;
    rig_open(&rig);
    const struct rig_image first = pass_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    const struct rig_image input = pass_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    const struct rig_image last = pass_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    VkAttachmentDescription2 attachments[COUNT];
    VkImageView views[COUNT];
    VkClearValue clears[COUNT] = {0};
    for (int i = 0; i < COUNT; i++) {
        attachments[i] = pass_attachment(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT,
                                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        attachments[i].flags = VK_ATTACHMENT_DESCRIPTION_MAY_ALIAS_BIT;
        views[i] = first.view;
    }
    VkAttachmentReference2 inputs[INPUTS];
    for (int i = 0; i < INPUTS; i++) {
        inputs[i] = pass_reference(VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_ASPECT_COLOR_BIT);
    }
    inputs[INPUTS - 1].attachment = 70;
    views[70] = input.view;
    views[COUNT - 1] = last.view;
    clears[70].color.float32[0] = 1;
    clears[COUNT - 1].color.float32[1] = 1;
    const VkAttachmentReference2 color =
        pass_reference(COUNT - 1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_COLOR_BIT);
    const VkRenderPass pass = pass_create(&rig, attachments, COUNT,
                                          (VkSubpassDescription2){.inputAttachmentCount = INPUTS,
                                                                  .pInputAttachments = inputs,
                                                                  .colorAttachmentCount = 1,
                                                                  .pColorAttachments = &color});
    pass_begin(&rig, NULL, pass, rig_framebuffer(&rig, pass, views, COUNT, PASS_SIDE), clears, COUNT);
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
        attachments[i] = pass_attachment(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT,
                                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        images[i] = pass_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
        views[i] = images[i].view;
        colors[i] = pass_reference(i, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_COLOR_BIT);
    }
    const VkRenderPass pass =
        pass_create(&rig, attachments, 2,
                    (VkSubpassDescription2){.colorAttachmentCount = 2, .pColorAttachments = colors});
    VkPipelineLayout layout = rig_layout(&rig, NULL, 0, 36);
    picture_state(&state, &picture, rig_shader(&rig, quad_vert, sizeof quad_vert),
                  rig_shader(&rig, two_sources_frag, sizeof two_sources_frag), layout);
    state.blend[0].blendEnable = VK_TRUE;
    state.blend[0].srcColorBlendFactor = state.blend[0].srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    state.blend[0].dstColorBlendFactor = state.blend[0].dstAlphaBlendFactor = VK_BLEND_FACTOR_SRC1_COLOR;
    state.blends.attachmentCount = 2; // the second one writes no channel
    VkPipeline pipeline = picture_pipeline(&picture, &state, pass, 0);
    const VkViewport viewport = {.width = PASS_SIDE, .height = PASS_SIDE, .maxDepth = 1};
    const VkRect2D area = {.extent = {PASS_SIDE, PASS_SIDE}};
    const float push[9] = {-1, -1, 1, 1, 0.2f, 0.4f, 0, 0, 0.5f};
    pass_begin(&rig, NULL, pass, rig_framebuffer(&rig, pass, views, 2, PASS_SIDE), clears, 2);
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
    VkAttachmentDescription2 attachment = pass_attachment(VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT,
                                                          VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    attachment.initialLayout = VK_IMAGE_LAYOUT_GENERAL;
    const VkAttachmentReference2 color =
        pass_reference(0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_COLOR_BIT);
    return pass_create(rig, &attachment, 1,
                       (VkSubpassDescription2){.colorAttachmentCount = 1, .pColorAttachments = &color});
}

static void a_device_of_a_group_has_a_render_area(void **state)
{
    (void)state;
    static const uint32_t zeros[PASS_TEXELS] = {0};
    struct rig rig;
    rig_open(&rig);
    const struct rig_image image = pass_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    const VkRenderPass pass = make_clear_pass(&rig);
    const VkRect2D left = {{0, 0}, {PASS_SIDE / 2, PASS_SIDE}};
    const VkDeviceGroupRenderPassBeginInfo group = {.sType =
                                                        VK_STRUCTURE_TYPE_DEVICE_GROUP_RENDER_PASS_BEGIN_INFO,
                                                    .deviceMask = 1,
                                                    .deviceRenderAreaCount = 1,
                                                    .pDeviceRenderAreas = &left};
    const VkClearValue white = {.color = {.float32 = {1, 1, 1, 1}}};
    rig_write(&rig, &image, zeros, 4, VK_IMAGE_LAYOUT_GENERAL);
    pass_begin(&rig, &group, pass, rig_framebuffer(&rig, pass, &image.view, 1, PASS_SIDE), &white, 1);
    vkCmdEndRenderPass(rig.commands);
    const struct rig_buffer read = rig_read(&rig, &image, 4);
    rig_run(&rig);
    for (int i = 0; i < PASS_TEXELS; i++) {
        assert_int_equal(((const uint32_t *)read.bytes)[i], i % PASS_SIDE < PASS_SIDE / 2 ? UINT32_MAX : 0);
    }
    rig_close(&rig);
}

static void a_subpass_too_many_is_the_last_one(void **state)
{
    (void)state;
    static const uint32_t zeros[PASS_TEXELS] = {0};
    struct rig rig;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the misuse
    }
    rig_open(&rig);
    const struct rig_image image = pass_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT);
    const VkRenderPass pass = make_clear_pass(&rig);
    const VkClearValue white = {.color = {.float32 = {1, 1, 1, 1}}};
    const VkClearAttachment black = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT};
    const VkClearRect all = {{{0, 0}, {PASS_SIDE, PASS_SIDE}}, 0, 1};
    rig_write(&rig, &image, zeros, 4, VK_IMAGE_LAYOUT_GENERAL);
    pass_begin(&rig, NULL, pass, rig_framebuffer(&rig, pass, &image.view, 1, PASS_SIDE), &white, 1);
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
    static const uint32_t zeros[PASS_TEXELS] = {0};
    struct rig rig;
    rig_open(&rig);
    const VkRenderPass pass = make_clear_pass(&rig);
    const VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;
    const VkFramebufferAttachmentImageInfo image_info = {
        .sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_ATTACHMENT_IMAGE_INFO,
        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT |
                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .width = PASS_SIDE,
        .height = PASS_SIDE,
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
                                          .width = PASS_SIDE,
                                          .height = PASS_SIDE,
                                          .layers = 1};
    VkFramebuffer framebuffer;
    CHECK(vkCreateFramebuffer(rig.device, &info, NULL, &framebuffer));
    RIG_KEEP(&rig, FRAMEBUFFER, framebuffer);
    struct rig_buffer read[2];
    for (int i = 0; i < 2; i++) {
        const struct rig_image image = pass_image(&rig, format, VK_SAMPLE_COUNT_1_BIT);
        const VkRenderPassAttachmentBeginInfo attachments = {
            .sType = VK_STRUCTURE_TYPE_RENDER_PASS_ATTACHMENT_BEGIN_INFO,
            .attachmentCount = 1,
            .pAttachments = &image.view};
        const VkClearValue color = {.color = {.float32 = {(float)i, 0, 0, 1}}};
        rig_write(&rig, &image, zeros, 4, VK_IMAGE_LAYOUT_GENERAL);
        pass_begin(&rig, &attachments, pass, framebuffer, &color, 1);
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
    const VkAttachmentReference2 none = pass_reference(
        VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_ASPECT_COLOR_BIT);
    const VkRenderPass pass = pass_create(
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
    const VkClearRect all = {{{0, 0}, {PASS_SIDE, PASS_SIDE}}, 0, 1};
    const VkViewport viewport = {.width = PASS_SIDE, .height = PASS_SIDE, .maxDepth = 1};
    const float push[9] = {-1, -1, 1, 1, 0, 1, 0, 1, 0.5f};
    pass_begin(&rig, NULL, pass, rig_framebuffer(&rig, pass, NULL, 0, PASS_SIDE), NULL, 0);
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
    assert_int_equal(count, 4 * PASS_TEXELS);
    vkDestroyQueryPool(rig.device, pool, NULL);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_pass_has_any_number_of_attachments_and_inputs),
    cmocka_unit_test(a_second_source_leaves_other_attachments),
    cmocka_unit_test(a_device_of_a_group_has_a_render_area),
    cmocka_unit_test(a_subpass_too_many_is_the_last_one),
    cmocka_unit_test(a_framebuffer_may_be_imageless),
    cmocka_unit_test(a_subpass_without_attachments_has_the_samples_of_its_pipelines),
};

const struct unit_tests test_vulkan_attachments = UNIT_TESTS(tests, NULL, NULL);
