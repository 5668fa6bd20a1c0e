// SPDX-License-Identifier: MIT
// Render passes of several subpasses, which read what those before them drew.
#include <string.h>

#include "halve_frag.h"
#include "invert_frag.h"
#include "quad_vert.h"
#include "shade_frag.h"
#include "views_vert.h"
#include "vulkan_picture.h"

// Create a pass that draws into attachment 0, and then into attachment 1, which reads the first one.
static VkRenderPass make_pass(struct rig *rig)
{
    const VkAttachmentDescription first = {.format = VK_FORMAT_R8G8B8A8_UNORM,
                                           .samples = VK_SAMPLE_COUNT_1_BIT,
                                           .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                           .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                                           .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    VkAttachmentDescription attachments[2] = {first, first};
    attachments[1].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachments[1].finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    const VkAttachmentReference colors[2] = {{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
                                             {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}};
    const VkAttachmentReference input = {0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkSubpassDescription subpasses[2] = {{.colorAttachmentCount = 1, .pColorAttachments = &colors[0]},
                                               {.colorAttachmentCount = 1,
                                                .pColorAttachments = &colors[1],
                                                .inputAttachmentCount = 1,
                                                .pInputAttachments = &input}};
    const VkSubpassDependency dependencies[2] = {
        {.srcSubpass = 0,
         .dstSubpass = 1,
         .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
         .dstStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
         .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
         .dstAccessMask = VK_ACCESS_INPUT_ATTACHMENT_READ_BIT,
         .dependencyFlags = VK_DEPENDENCY_BY_REGION_BIT},
        {.srcSubpass = 1,
         .dstSubpass = VK_SUBPASS_EXTERNAL,
         .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
         .dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT,
         .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
         .dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT}};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .attachmentCount = 2,
                                         .pAttachments = attachments,
                                         .subpassCount = 2,
                                         .pSubpasses = subpasses,
                                         .dependencyCount = 2,
                                         .pDependencies = dependencies};
    VkRenderPass pass;
    CHECK(vkCreateRenderPass(rig->device, &info, NULL, &pass));
    RIG_KEEP(rig, RENDER_PASS, pass);
    return pass;
}

static void a_subpass_reads_what_the_one_before_drew(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    static const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, 1,
                                                         VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    VkRenderPass pass = make_pass(&rig);
    const struct rig_image first =
        rig_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, PICTURE_SIZE, PICTURE_SIZE, VK_SAMPLE_COUNT_1_BIT,
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT);
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, &binding, 1);
    VkPipelineLayout layout = rig_layout(&rig, &set_layout, 1, 36);
    VkDescriptorSet set = rig_set(&rig, set_layout);
    rig_bind_image(&rig, set, 0, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, first.view, VK_NULL_HANDLE,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    VkShaderModule quad = rig_shader(&rig, quad_vert, sizeof quad_vert);
    picture_state(&state, &picture, quad, rig_shader(&rig, shade_frag, sizeof shade_frag), layout);
    VkPipeline draws = picture_pipeline(&picture, &state, pass, 0);
    picture_state(&state, &picture, quad, rig_shader(&rig, invert_frag, sizeof invert_frag), layout);
    VkPipeline inverts = picture_pipeline(&picture, &state, pass, 1);
    const VkImageView views[2] = {first.view, picture.color.view};
    VkFramebuffer framebuffer = rig_framebuffer(&rig, pass, views, 2, PICTURE_SIZE);
    picture.pass = pass;
    picture.framebuffer = framebuffer;
    picture_begin(&picture);
    // The left half is drawn in the first subpass; the upper three quarters in the second one.
    const float left[9] = {-1, -1, 0, 1, 0.2f, 0.4f, 0.6f, 1, 0}, upper[4] = {-1, -1, 1, 0.5f};
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, draws);
    vkCmdPushConstants(rig.commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof left, left);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    vkCmdNextSubpass(rig.commands, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, inverts);
    vkCmdBindDescriptorSets(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, NULL);
    vkCmdPushConstants(rig.commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof upper, upper);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 10, 10), 0xcc9966ff);
    assert_int_equal(picture_texel(&picture, 50, 10), 0xbfffffff); // of the clear colour, 0.25, 0, 0
    // The second attachment is cleared to what the picture clears depth to, which is a red of 1.
    assert_int_equal(picture_texel(&picture, 10, 60), 0xff000000);
    rig_close(&rig);
}

// Create a pass whose only subpass draws into the attachment that it reads.
static VkRenderPass make_feedback_pass(struct rig *rig)
{
    const VkAttachmentDescription attachment = {.format = VK_FORMAT_R8G8B8A8_UNORM,
                                                .samples = VK_SAMPLE_COUNT_1_BIT,
                                                .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                                .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                                .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const VkAttachmentReference general = {0, VK_IMAGE_LAYOUT_GENERAL};
    const VkSubpassDescription subpass = {.colorAttachmentCount = 1,
                                          .pColorAttachments = &general,
                                          .inputAttachmentCount = 1,
                                          .pInputAttachments = &general};
    const VkSubpassDependency own = {.srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                     .dstStageMask = VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT,
                                     .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                     .dstAccessMask = VK_ACCESS_INPUT_ATTACHMENT_READ_BIT,
                                     .dependencyFlags = VK_DEPENDENCY_BY_REGION_BIT};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .attachmentCount = 1,
                                         .pAttachments = &attachment,
                                         .subpassCount = 1,
                                         .pSubpasses = &subpass,
                                         .dependencyCount = 1,
                                         .pDependencies = &own};
    VkRenderPass pass;
    CHECK(vkCreateRenderPass(rig->device, &info, NULL, &pass));
    RIG_KEEP(rig, RENDER_PASS, pass);
    return pass;
}

static void wait_for_colors(const struct rig *rig)
{
    const VkMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                     .dstAccessMask = VK_ACCESS_INPUT_ATTACHMENT_READ_BIT};
    vkCmdPipelineBarrier(rig->commands, VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                         VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT, VK_DEPENDENCY_BY_REGION_BIT, 1, &barrier, 0,
                         NULL, 0, NULL);
}

static void a_barrier_shows_what_the_subpass_drew(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    static const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, 1,
                                                         VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    picture.color =
        rig_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, PICTURE_SIZE, PICTURE_SIZE, VK_SAMPLE_COUNT_1_BIT,
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT |
                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    picture.pass = make_feedback_pass(&rig);
    picture.framebuffer = rig_framebuffer(&rig, picture.pass, &picture.color.view, 1, PICTURE_SIZE);
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, &binding, 1);
    VkPipelineLayout layout = rig_layout(&rig, &set_layout, 1, 36);
    VkDescriptorSet set = rig_set(&rig, set_layout);
    rig_bind_image(&rig, set, 0, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, picture.color.view, VK_NULL_HANDLE,
                   VK_IMAGE_LAYOUT_GENERAL);
    picture_state(&state, &picture, rig_shader(&rig, quad_vert, sizeof quad_vert),
                  rig_shader(&rig, halve_frag, sizeof halve_frag), layout);
    VkPipeline pipeline = picture_pipeline(&picture, &state, picture.pass, 0);
    const float all[9] = {-1, -1, 1, 1}, left[9] = {-1, -1, 0, 1};
    picture_begin(&picture); // 0.25 of red
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, NULL);
    vkCmdPushConstants(rig.commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof all, all);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    wait_for_colors(&rig);
    vkCmdPushConstants(rig.commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof left, left);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 50, 30), 0x200033ff);
    assert_int_equal(picture_texel(&picture, 10, 30), 0x10004cff); // 51 / 2 + 51 = 76.5, rounded to even
    rig_close(&rig);
}

// Create a pass that draws views 0 and 2 of an image with three layers.
static VkRenderPass make_view_pass(struct rig *rig)
{
    static const uint32_t mask = 5;
    const VkAttachmentDescription attachment = {.format = VK_FORMAT_R8G8B8A8_UNORM,
                                                .samples = VK_SAMPLE_COUNT_1_BIT,
                                                .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                                .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                                .initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                                .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const VkAttachmentReference color = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass = {.colorAttachmentCount = 1, .pColorAttachments = &color};
    const VkRenderPassMultiviewCreateInfo views = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO, .subpassCount = 1, .pViewMasks = &mask};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .pNext = &views,
                                         .attachmentCount = 1,
                                         .pAttachments = &attachment,
                                         .subpassCount = 1,
                                         .pSubpasses = &subpass};
    VkRenderPass pass;
    CHECK(vkCreateRenderPass(rig->device, &info, NULL, &pass));
    RIG_KEEP(rig, RENDER_PASS, pass);
    return pass;
}

static void every_view_is_drawn_with_its_number(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    const struct rig_image image =
        rig_layers(&rig, VK_FORMAT_R8G8B8A8_UNORM, PICTURE_SIZE, PICTURE_SIZE, 3,
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                       VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    static const uint32_t texels[3 * PICTURE_TEXELS] = {0};
    rig_write(&rig, &image, texels, 4, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    picture.pass = make_view_pass(&rig);
    picture.framebuffer = rig_framebuffer(&rig, picture.pass, &image.view, 1, PICTURE_SIZE);
    picture_state(&state, &picture, rig_shader(&rig, views_vert, sizeof views_vert),
                  rig_shader(&rig, shade_frag, sizeof shade_frag), rig_layout(&rig, NULL, 0, 0));
    VkPipeline pipeline = picture_pipeline(&picture, &state, picture.pass, 0);
    const VkQueryPoolCreateInfo queries = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                           .queryType = VK_QUERY_TYPE_OCCLUSION,
                                           .queryCount = 2};
    VkQueryPool pool;
    CHECK(vkCreateQueryPool(rig.device, &queries, NULL, &pool));
    vkCmdResetQueryPool(rig.commands, pool, 0, 2);
    picture_begin(&picture);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBeginQuery(rig.commands, pool, 0, VK_QUERY_CONTROL_PRECISE_BIT);
    vkCmdDraw(rig.commands, 3, 1, 0, 0);
    vkCmdEndQuery(rig.commands, pool, 0);
    picture.color = image;
    picture_end(&picture);
    const int layer = PICTURE_SIZE; // rows
    assert_int_equal(picture_texel(&picture, 30, 30), 0x000000ff);
    assert_int_equal(picture_texel(&picture, 30, layer + 30), 0);
    assert_int_equal(picture_texel(&picture, 30, 2 * layer + 30), 0x00ff00ff);
    uint64_t counts[2]; // of views 0 and 2, in queries that follow each other
    CHECK(vkGetQueryPoolResults(rig.device, pool, 0, 2, sizeof counts, counts, sizeof counts[0],
                                VK_QUERY_RESULT_64_BIT));
    assert_true(counts[0] > 0 && counts[1] == counts[0]);
    vkDestroyQueryPool(rig.device, pool, NULL);
    rig_close(&rig);
}

// Create a pass that reads attachment 0 and draws into attachment 1, views 0 and 2 of images with three layers.
static VkRenderPass make_view_reading_pass(struct rig *rig)
{
    static const uint32_t mask = 5;
    const VkAttachmentDescription attachments[2] = {
        {.format = VK_FORMAT_R8G8B8A8_UNORM,
         .samples = VK_SAMPLE_COUNT_1_BIT,
         .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
         .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
         .initialLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
         .finalLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
        {.format = VK_FORMAT_R8G8B8A8_UNORM,
         .samples = VK_SAMPLE_COUNT_1_BIT,
         .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
         .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
         .finalLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL}};
    const VkAttachmentReference input = {0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL},
                                color = {1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass = {.colorAttachmentCount = 1,
                                          .pColorAttachments = &color,
                                          .inputAttachmentCount = 1,
                                          .pInputAttachments = &input};
    const VkRenderPassMultiviewCreateInfo views = {
        .sType = VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO, .subpassCount = 1, .pViewMasks = &mask};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .pNext = &views,
                                         .attachmentCount = 2,
                                         .pAttachments = attachments,
                                         .subpassCount = 1,
                                         .pSubpasses = &subpass};
    VkRenderPass pass;
    CHECK(vkCreateRenderPass(rig->device, &info, NULL, &pass));
    RIG_KEEP(rig, RENDER_PASS, pass);
    return pass;
}

static void every_view_reads_its_own_layer(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    static const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, 1,
                                                         VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    const struct rig_image given =
        rig_layers(&rig, VK_FORMAT_R8G8B8A8_UNORM, PICTURE_SIZE, PICTURE_SIZE, 3,
                   VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    const struct rig_image image =
        rig_layers(&rig, VK_FORMAT_R8G8B8A8_UNORM, PICTURE_SIZE, PICTURE_SIZE, 3,
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    static uint32_t texels[3 * PICTURE_TEXELS]; // ABGR: red of layer 0, green of layer 1, blue of layer 2
    for (int i = 0; i < 3 * PICTURE_TEXELS; i++) {
        texels[i] = 0xff000000 | UINT32_C(0xff) << 8 * (i / PICTURE_TEXELS);
    }
    rig_write(&rig, &given, texels, 4, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    picture.pass = make_view_reading_pass(&rig);
    const VkImageView views[2] = {given.view, image.view};
    picture.framebuffer = rig_framebuffer(&rig, picture.pass, views, 2, PICTURE_SIZE);
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, &binding, 1);
    VkPipelineLayout layout = rig_layout(&rig, &set_layout, 1, 36);
    VkDescriptorSet set = rig_set(&rig, set_layout);
    rig_bind_image(&rig, set, 0, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT, given.view, VK_NULL_HANDLE,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    picture_state(&state, &picture, rig_shader(&rig, quad_vert, sizeof quad_vert),
                  rig_shader(&rig, invert_frag, sizeof invert_frag), layout);
    VkPipeline pipeline = picture_pipeline(&picture, &state, picture.pass, 0);
    const float all[9] = {-1, -1, 1, 1};
    picture_begin(&picture);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, NULL);
    vkCmdPushConstants(rig.commands, layout, VK_SHADER_STAGE_ALL, 0, sizeof all, all);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    picture.color = image;
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 30, 30), 0x00ffffff);
    assert_int_equal(picture_texel(&picture, 30, 2 * PICTURE_SIZE + 30), 0xffff00ff);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_subpass_reads_what_the_one_before_drew),
    cmocka_unit_test(a_barrier_shows_what_the_subpass_drew),
    cmocka_unit_test(every_view_is_drawn_with_its_number),
    cmocka_unit_test(every_view_reads_its_own_layer),
};

const struct unit_tests test_vulkan_subpasses = UNIT_TESTS(tests, NULL, NULL);
