// SPDX-License-Identifier: MIT
// Passes and pipelines that do not agree, which Vulkan forbids and other drivers draw. Each is told by a line.
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "quad_vert.h"
#include "shade_frag.h"
#include "vulkan_pass.h"
#include "vulkan_picture.h"

static const uint32_t green = 0xff00ff00, none = 0; // texels as they stand in memory

// A pass that is described, one attachment after the other, and a pipeline for another pass.
struct misuse {
    struct rig rig;
    struct picture picture; // whose state the pipelines begin with
    struct picture_state state;
    struct rig_image images[3];
    VkAttachmentDescription2 attachments[3];
    VkAttachmentReference2 references[3];
    uint32_t count;
    bool clears;       // instead of drawing
    VkBuffer commands; // that draws are read from, or none
    VkDeviceSize offset;
    int error; // descriptor of stderr, in whose place a file stands
};

static const char log_path[] = "test_vulkan_misuse.log";

// Let the driver write what it tells to a file.
static void begin_log(struct misuse *m)
{
    const int file = open(log_path, O_RDWR | O_CREAT | O_TRUNC, 0600);
    assert_true(file >= 0 && setenv("RHW_VULKAN_LOG", "1", 1) == 0);
    m->error = dup(STDERR_FILENO);
    assert_true(m->error >= 0 && dup2(file, STDERR_FILENO) >= 0);
    close(file);
}

// Read what the driver has told so far.
static void read_log(char *text, size_t size)
{
    FILE *const file = fopen(log_path, "r");
    assert_non_null(file);
    text[fread(text, 1, size - 1, file)] = 0;
    fclose(file);
}

// Want a line that has this part.
static void end_misuse(struct misuse *m, const char *part)
{
    char text[4096];
    rig_close(&m->rig);
    assert_true(dup2(m->error, STDERR_FILENO) >= 0 && unsetenv("RHW_VULKAN_LOG") == 0);
    close(m->error);
    read_log(text, sizeof text);
    remove(log_path);
    assert_non_null(strstr(text, part));
}

static void begin_misuse(struct misuse *m)
{
    *m = (struct misuse){.count = 0};
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the misuse
    }
    rig_open(&m->rig);
    begin_log(m);
    m->picture = (struct picture){.rig = &m->rig, .sample_count = VK_SAMPLE_COUNT_1_BIT};
    picture_state(&m->state, &m->picture, rig_shader(&m->rig, quad_vert, sizeof quad_vert),
                  rig_shader(&m->rig, shade_frag, sizeof shade_frag), rig_layout(&m->rig, NULL, 0, 36));
}

static void add_attachment(struct misuse *m, struct rig_image image, VkImageLayout layout)
{
    const uint32_t i = m->count++;
    const bool is_color = image.format == VK_FORMAT_R8G8B8A8_UNORM;
    m->images[i] = image;
    m->attachments[i] =
        pass_attachment(image.format, VK_SAMPLE_COUNT_1_BIT, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    m->references[i] =
        pass_reference(i, layout, is_color ? VK_IMAGE_ASPECT_COLOR_BIT : VK_IMAGE_ASPECT_DEPTH_BIT);
}

static void add_color(struct misuse *m)
{
    add_attachment(m, pass_image(&m->rig, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT),
                   VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

static void add_depth(struct misuse *m, VkImageLayout layout)
{
    add_attachment(m, pass_image(&m->rig, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_1_BIT), layout);
}

// Create a pass of the first `colors` attachments, and of the next one as depth where there is one.
static VkRenderPass create_pass(struct misuse *m, uint32_t colors)
{
    return pass_create(&m->rig, m->attachments, m->count,
                       (VkSubpassDescription2){.colorAttachmentCount = colors,
                                               .pColorAttachments = m->references,
                                               .pDepthStencilAttachment =
                                                   colors < m->count ? &m->references[colors] : NULL});
}

// Clear the first attachment to green, in more layers than it has.
static void clear_all(const struct misuse *m, uint32_t side)
{
    const VkClearAttachment green_color = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
                                           .clearValue = {.color = {.float32 = {0, 1, 0, 1}}}};
    const VkClearRect rectangle = {.rect = {.extent = {2 * side, side}}, .layerCount = 2};
    vkCmdClearAttachments(m->rig.commands, 1, &green_color, 1, &rectangle);
}

// Draw a green quad at a depth of 0.5 into a pass that cleared colours to 0 and depth to 1, and run. The buffers have
// what the attachments became.
static void draw(struct misuse *m, VkRenderPass pass, VkPipeline pipeline, uint32_t side,
                 struct rig_buffer read[3])
{
    struct rig *const rig = &m->rig;
    VkImageView views[3];
    VkClearValue clears[3] = {0};
    for (uint32_t i = 0; i < m->count; i++) {
        views[i] = m->images[i].view;
        clears[i].depthStencil.depth = m->images[i].format == VK_FORMAT_D32_SFLOAT ? 1 : 0;
    }
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .renderPass = pass,
                                         .framebuffer = rig_framebuffer(rig, pass, views, m->count, side),
                                         .renderArea = {.extent = {2 * side, side}},
                                         .clearValueCount = m->count,
                                         .pClearValues = clears};
    const VkViewport viewport = {.width = PASS_SIDE, .height = PASS_SIDE, .maxDepth = 1};
    const VkRect2D all = {.extent = {PASS_SIDE, PASS_SIDE}};
    const float push[9] = {-1, -1, 1, 1, 0, 1, 0, 1, 0.5f};
    vkCmdBeginRenderPass(rig->commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdSetViewport(rig->commands, 0, 1, &viewport);
    vkCmdSetScissor(rig->commands, 0, 1, &all);
    vkCmdBindPipeline(rig->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdPushConstants(rig->commands, m->state.layout, VK_SHADER_STAGE_ALL, 0, sizeof push, push);
    if (m->clears) {
        clear_all(m, side);
    } else if (m->commands) {
        vkCmdDrawIndirect(rig->commands, m->commands, m->offset, 3, sizeof(VkDrawIndirectCommand));
    } else {
        vkCmdDraw(rig->commands, 6, 1, 0, 0);
    }
    vkCmdEndRenderPass(rig->commands);
    for (uint32_t i = 0; i < m->count; i++) {
        read[i] = rig_read(rig, &m->images[i], 4);
    }
    rig_run(rig);
}

static void expect_colors(const struct rig_buffer *buffer, uint32_t color)
{
    for (int i = 0; i < PASS_TEXELS; i++) {
        assert_int_equal(((const uint32_t *)buffer->bytes)[i], color);
    }
}

// The framebuffer is larger than what is attached, and the render area larger than the framebuffer.
static void a_pass_is_as_large_as_its_attachments(void **state)
{
    (void)state;
    for (int clears = 0; clears < 2; clears++) {
        struct misuse m;
        struct rig_buffer read[3];
        begin_misuse(&m);
        m.clears = clears;
        add_color(&m);
        const VkRenderPass pass = create_pass(&m, 1);
        draw(&m, pass, picture_pipeline(&m.picture, &m.state, pass, 0), 3 * PASS_SIDE, read);
        expect_colors(&read[0], green);
        end_misuse(&m, clears ? "a clear of attachments is cut" : "is cut to an attachment");
    }
}

static void an_image_is_attached_once(void **state)
{
    (void)state;
    struct misuse m;
    struct rig_buffer read[3];
    begin_misuse(&m);
    add_color(&m);
    add_attachment(&m, m.images[0], VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    m.state.blends.attachmentCount = 2;
    const VkRenderPass pass = create_pass(&m, 2);
    draw(&m, pass, picture_pipeline(&m.picture, &m.state, pass, 0), PASS_SIDE, read);
    expect_colors(&read[0], green);
    end_misuse(&m, "another one has the same texels");
}

// Draw with one pipeline into passes of more and of fewer colours than it is made for, in turns.
static void a_pipeline_draws_into_the_colors_that_are_there(void **state)
{
    (void)state;
    struct misuse m;
    struct rig_buffer read[3];
    begin_misuse(&m);
    m.state.blend[1].colorWriteMask = 15;
    for (uint32_t i = 0; i < 3; i++) {
        add_color(&m);
    }
    const VkRenderPass three = create_pass(&m, 3);
    m.count = 2;
    m.state.blends.attachmentCount = 2;
    const VkRenderPass two = create_pass(&m, 2);
    VkPipeline pipeline = picture_pipeline(&m.picture, &m.state, two, 0);
    m.count = 1;
    const VkRenderPass one = create_pass(&m, 1);
    for (int round = 0; round < 2; round++) {
        m.count = 1;
        draw(&m, one, pipeline, PASS_SIDE, read);
        expect_colors(&read[0], green);
        m.count = 3;
        draw(&m, three, pipeline, PASS_SIDE, read);
        expect_colors(&read[0], green);
        expect_colors(&read[2], none);
        m.count = 2;
        draw(&m, two, pipeline, PASS_SIDE, read);
        expect_colors(&read[0], green);
    }
    end_misuse(&m, "into other attachments");
}

// Return what colour a pipeline with a test of depth that passes draws where the pass has depth in a layout, or none if
// that is UNDEFINED.
static uint32_t draw_with_depth(VkImageLayout layout, VkImageLayout drawn)
{
    struct misuse m;
    struct rig_buffer read[3];
    begin_misuse(&m);
    m.state.depth.depthTestEnable = m.state.depth.depthWriteEnable = VK_TRUE;
    m.state.depth.depthCompareOp = VK_COMPARE_OP_GREATER;
    add_color(&m);
    add_depth(&m, layout);
    VkPipeline pipeline = picture_pipeline(&m.picture, &m.state, create_pass(&m, 1), 0);
    m.count = drawn == VK_IMAGE_LAYOUT_UNDEFINED ? 1 : 2;
    m.references[1].layout = drawn;
    m.attachments[1].loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    draw(&m, create_pass(&m, 1), pipeline, PASS_SIDE, read);
    const uint32_t color = *(const uint32_t *)read[0].bytes;
    const float depth = m.count > 1 ? *(const float *)read[1].bytes : 0;
    assert_true(depth == 0); // new memory, which nothing was to write
    end_misuse(&m, "into other attachments");
    return color;
}

static void a_pipeline_writes_no_depth_that_is_not_to_be_written(void **state)
{
    (void)state;
    const VkImageLayout written = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    assert_int_equal(draw_with_depth(written, VK_IMAGE_LAYOUT_UNDEFINED), green);
    assert_int_equal(draw_with_depth(written, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL), green);
}

// Return the colour that draws of a buffer with two commands leave, the first of nothing and the second of the quad.
static uint32_t draw_indirect(VkDeviceSize offset, const char *told)
{
    static const VkDrawIndirectCommand given[2] = {{0, 1, 0, 0}, {6, 1, 0, 0}};
    struct misuse m;
    struct rig_buffer read[3];
    begin_misuse(&m);
    add_color(&m);
    m.commands = rig_buffer(&m.rig, sizeof given, given).buffer;
    m.offset = offset;
    const VkRenderPass pass = create_pass(&m, 1);
    draw(&m, pass, picture_pipeline(&m.picture, &m.state, pass, 0), PASS_SIDE, read);
    const uint32_t color = *(const uint32_t *)read[0].bytes;
    expect_colors(&read[0], color);
    end_misuse(&m, told);
    return color;
}

static void an_indirect_draw_lies_in_its_buffer(void **state)
{
    (void)state;
    const VkDeviceSize stride = sizeof(VkDrawIndirectCommand);
    assert_int_equal(draw_indirect(0, "number 2, 32 bytes behind 0, is not within the 32"), green);
    assert_int_equal(draw_indirect(stride, "number 1, 16 bytes behind 16"), green);
    assert_int_equal(draw_indirect(2 * stride, "number 0, 0 bytes behind 32"), none);
    // Offset and stride come to places in the buffer where they are added in 64 bits.
    assert_int_equal(draw_indirect(0 - stride, "number 0, 0 bytes behind 18446744073709551600"), none);
}

// Commands that have nothing to do, for what they need is not there.
static void what_is_left_out_is_told(void **state)
{
    (void)state;
    struct misuse m;
    begin_misuse(&m);
    add_color(&m);
    const struct rig *const rig = &m.rig;
    const VkRenderPass pass = create_pass(&m, 1);
    const struct rig_buffer small = rig_buffer(&m.rig, 16, NULL);
    const PFN_vkCmdDrawIndirectByteCountEXT draw_counted =
        (PFN_vkCmdDrawIndirectByteCountEXT)vkGetDeviceProcAddr(rig->device, "vkCmdDrawIndirectByteCountEXT");
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .renderPass = pass,
                                         .framebuffer =
                                             rig_framebuffer(&m.rig, pass, &m.images[0].view, 1, PASS_SIDE),
                                         .renderArea = {.extent = {PASS_SIDE, PASS_SIDE}}};
    const VkBufferCopy region = {.srcOffset = 8, .size = 16};
    VkBufferImageCopy texels = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                .imageExtent = {PASS_SIDE, PASS_SIDE, 1}};
    vkCmdCopyBuffer(rig->commands, small.buffer, small.buffer, 1, &region);
    vkCmdCopyBufferToImage(rig->commands, small.buffer, m.images[0].image, VK_IMAGE_LAYOUT_GENERAL, 1,
                           &texels);
    texels.imageExtent.width = 0;
    vkCmdCopyImageToBuffer(rig->commands, m.images[0].image, VK_IMAGE_LAYOUT_GENERAL, small.buffer, 1,
                           &texels);
    const VkClearColorValue black = {.float32 = {0}};
    const VkImageSubresourceRange beyond = {VK_IMAGE_ASPECT_COLOR_BIT, 5, VK_REMAINING_MIP_LEVELS, 0, 1};
    vkCmdClearColorImage(rig->commands, m.images[0].image, VK_IMAGE_LAYOUT_GENERAL, &black, 1, &beyond);
    vkCmdEndRenderPass(rig->commands);
    vkCmdDispatch(rig->commands, 1, 1, 1);
    vkCmdDispatchIndirect(rig->commands, small.buffer, 8);
    vkCmdDraw(rig->commands, 3, 1, 0, 0);
    vkCmdBeginRenderPass(rig->commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdDraw(rig->commands, 3, 1, 0, 0);
    vkCmdBindPipeline(rig->commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                      picture_pipeline(&m.picture, &m.state, pass, 0));
    vkCmdDrawIndexed(rig->commands, 3, 1, 0, 0, 0);
    vkCmdDrawIndirect(rig->commands, small.buffer, 8, 1, 0);
    draw_counted(rig->commands, 1, 0, small.buffer, 0, 0, 0);
    draw_counted(rig->commands, 1, 0, small.buffer, 16, 0, 4);
    vkCmdEndRenderPass(rig->commands);
    rig_run(&m.rig);
    static const char *const parts[] = {
        "vkCmdCopyBuffer: 8 bytes of 16 lie within the buffers",
        "outside of its buffer",
        "vkCmdCopyImageToBuffer: a region without texels",
        "clear: a range without texels",
        "a render pass is ended that has not begun",
        "a dispatch is left out: no pipeline is bound",
        "an indirect dispatch at 8 is left out",
        "a draw is left out: no render pass has begun",
        "a draw is left out: no pipeline is bound",
        "all indices are zeros: no buffer is bound",
        "indirect draws are left out: number 0, 0 bytes behind 8, is not within the 16",
        "a draw is left out, whose vertices have a stride of 0",
        "a draw is left out, whose counter lies behind its buffer"};
    char text[4096];
    read_log(text, sizeof text);
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        assert_non_null(strstr(text, parts[i]));
    }
    end_misuse(&m, parts[0]);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_pass_is_as_large_as_its_attachments),
    cmocka_unit_test(an_image_is_attached_once),
    cmocka_unit_test(a_pipeline_draws_into_the_colors_that_are_there),
    cmocka_unit_test(a_pipeline_writes_no_depth_that_is_not_to_be_written),
    cmocka_unit_test(an_indirect_draw_lies_in_its_buffer),
    cmocka_unit_test(what_is_left_out_is_told),
};

const struct unit_tests test_vulkan_misuse = UNIT_TESTS(tests, NULL, NULL);
