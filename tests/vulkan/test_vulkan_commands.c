// SPDX-License-Identifier: MIT
// Commands beside draws: queries, secondary command buffers, clears of attachments, events, timelines and renderings.
#include <string.h>
#include <time.h>

#include "quad_vert.h"
#include "shade_frag.h"
#include "vulkan_picture.h"

#include <limits.h>

// What quad.vert takes.
struct push {
    float rectangle[4], color[4], depth;
};

static const struct push left_half = {{-1, -1, 0, 1}, {0, 1, 0, 1}, 0.5f};

struct drawing {
    struct rig rig;
    struct picture picture;
    VkPipelineLayout layout;
    VkPipeline pipeline;
};

static void drawing_open(struct drawing *drawing)
{
    struct picture_state state;
    struct rig *const rig = &drawing->rig;
    rig_open(rig);
    picture_init(&drawing->picture, rig, false, VK_SAMPLE_COUNT_1_BIT);
    drawing->layout = rig_layout(rig, NULL, 0, sizeof(struct push));
    picture_state(&state, &drawing->picture, rig_shader(rig, quad_vert, sizeof quad_vert),
                  rig_shader(rig, shade_frag, sizeof shade_frag), drawing->layout);
    drawing->pipeline = picture_pipeline(&drawing->picture, &state, drawing->picture.pass, 0);
}

static void draw_half(const struct drawing *drawing, VkCommandBuffer commands)
{
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, drawing->pipeline);
    vkCmdPushConstants(commands, drawing->layout, VK_SHADER_STAGE_ALL, 0, sizeof left_half, &left_half);
    vkCmdDraw(commands, 6, 1, 0, 0);
}

static VkQueryPool make_queries(const struct drawing *drawing, VkQueryType type, uint32_t count)
{
    const VkQueryPoolCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = type, .queryCount = count};
    VkQueryPool pool;
    CHECK(vkCreateQueryPool(drawing->rig.device, &info, NULL, &pool));
    vkCmdResetQueryPool(drawing->rig.commands, pool, 0, count);
    return pool;
}

static void queries_count_samples_and_time(void **state)
{
    (void)state;
    struct drawing drawing;
    drawing_open(&drawing);
    struct rig *const rig = &drawing.rig;
    VkQueryPool samples = make_queries(&drawing, VK_QUERY_TYPE_OCCLUSION, 3);
    VkQueryPool times = make_queries(&drawing, VK_QUERY_TYPE_TIMESTAMP, 4);
    const struct rig_buffer copied = rig_buffer(rig, 2 * sizeof(uint64_t), NULL);
    uint64_t counts[2][2], at[4];
    vkCmdWriteTimestamp(rig->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, times, 0);
    picture_begin(&drawing.picture);
    vkCmdBeginQuery(rig->commands, samples, 0, VK_QUERY_CONTROL_PRECISE_BIT);
    draw_half(&drawing, rig->commands);
    vkCmdEndQuery(rig->commands, samples, 0);
    vkCmdWriteTimestamp(rig->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, times, 1);
    vkCmdWriteTimestamp(rig->commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, times, 2);
    vkCmdBeginQuery(rig->commands, samples, 1, 0);
    vkCmdEndQuery(rig->commands, samples, 1);
    picture_end(&drawing.picture);
    vkCmdCopyQueryPoolResults(rig->commands, samples, 0, 2, copied.buffer, 0, sizeof(uint64_t),
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT);
    vkCmdWriteTimestamp(rig->commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, times, 3);
    rig_run(rig);
    CHECK(vkGetQueryPoolResults(rig->device, samples, 0, 2, sizeof counts, counts, sizeof counts[0],
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WITH_AVAILABILITY_BIT));
    assert_int_equal(counts[0][0], PICTURE_TEXELS / 2);
    assert_int_equal(counts[1][0], 0);
    assert_true(counts[0][1] == 1 && counts[1][1] == 1);
    assert_memory_equal(copied.bytes, ((uint64_t[2]){PICTURE_TEXELS / 2, 0}), 2 * sizeof(uint64_t));
    assert_int_equal(vkGetQueryPoolResults(rig->device, samples, 2, 1, sizeof counts, counts,
                                           sizeof counts[0], VK_QUERY_RESULT_64_BIT),
                     VK_NOT_READY);
    CHECK(vkGetQueryPoolResults(rig->device, times, 0, 4, sizeof at, at, sizeof at[0],
                                VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
    assert_true(at[0] < at[1] && at[1] <= at[2] && at[2] < at[3]);
    vkDestroyQueryPool(rig->device, samples, NULL);
    vkDestroyQueryPool(rig->device, times, NULL);
    rig_close(rig);
}

static void attachments_are_cleared_between_draws(void **state)
{
    (void)state;
    struct drawing drawing;
    drawing_open(&drawing);
    const VkClearAttachment blue = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
                                    .clearValue = {.color = {.float32 = {0, 0, 1, 1}}}};
    const VkClearRect rects[2] = {{{{4, 4}, {8, 8}}, 0, 1}, {{{40, 0}, {8, 8}}, 0, 1}};
    picture_begin(&drawing.picture);
    draw_half(&drawing, drawing.rig.commands);
    vkCmdClearAttachments(drawing.rig.commands, 1, &blue, 2, rects);
    picture_end(&drawing.picture);
    assert_int_equal(picture_texel(&drawing.picture, 3, 4), 0x00ff00ff);
    assert_int_equal(picture_texel(&drawing.picture, 4, 4), 0x0000ffff);
    assert_int_equal(picture_texel(&drawing.picture, 11, 11), 0x0000ffff);
    assert_int_equal(picture_texel(&drawing.picture, 12, 11), 0x00ff00ff);
    assert_int_equal(picture_texel(&drawing.picture, 40, 7), 0x0000ffff);
    assert_int_equal(picture_texel(&drawing.picture, 40, 8), 0x400000ff);
    rig_close(&drawing.rig);
}

// A secondary command buffer draws twice, each time that the primary one is submitted.
static void secondary_buffers_draw_in_a_pass(void **state)
{
    (void)state;
    struct drawing drawing;
    drawing_open(&drawing);
    struct rig *const rig = &drawing.rig;
    const VkCommandBufferAllocateInfo allocate = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  .commandPool = rig->pool,
                                                  .level = VK_COMMAND_BUFFER_LEVEL_SECONDARY,
                                                  .commandBufferCount = 1};
    const VkCommandBufferInheritanceInfo inherits = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO, .renderPass = drawing.picture.pass};
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_RENDER_PASS_CONTINUE_BIT |
                                                     VK_COMMAND_BUFFER_USAGE_SIMULTANEOUS_USE_BIT,
                                            .pInheritanceInfo = &inherits};
    const VkRect2D area = {.extent = {PICTURE_SIZE, PICTURE_SIZE}};
    const VkViewport viewport = {.width = PICTURE_SIZE, .height = PICTURE_SIZE, .maxDepth = 1};
    const VkClearValue clears[2] = {{.color = {.float32 = {0, 0, 0, 1}}}};
    const VkRenderPassBeginInfo pass = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                        .renderPass = drawing.picture.pass,
                                        .framebuffer = drawing.picture.framebuffer,
                                        .renderArea = area,
                                        .clearValueCount = 2,
                                        .pClearValues = clears};
    VkCommandBuffer secondary;
    CHECK(vkAllocateCommandBuffers(rig->device, &allocate, &secondary));
    CHECK(vkBeginCommandBuffer(secondary, &begin));
    vkCmdSetViewport(secondary, 0, 1, &viewport);
    vkCmdSetScissor(secondary, 0, 1, &area);
    draw_half(&drawing, secondary);
    CHECK(vkEndCommandBuffer(secondary));
    vkCmdBeginRenderPass(rig->commands, &pass, VK_SUBPASS_CONTENTS_SECONDARY_COMMAND_BUFFERS);
    vkCmdExecuteCommands(rig->commands, 1, &secondary);
    picture_end(&drawing.picture);
    assert_int_equal(picture_texel(&drawing.picture, 0, 0), 0x00ff00ff);
    assert_int_equal(picture_texel(&drawing.picture, 32, 0), 0x000000ff);
    rig_close(rig);
}

// The commands wait for an event that the program sets after it has submitted them.
static void events_are_waited_for(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const VkEventCreateInfo info = {.sType = VK_STRUCTURE_TYPE_EVENT_CREATE_INFO};
    const VkFenceCreateInfo fence_info = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &rig.commands};
    const struct rig_buffer buffer = rig_buffer(&rig, 4, NULL);
    VkEvent event;
    VkFence fence;
    CHECK(vkCreateEvent(rig.device, &info, NULL, &event));
    CHECK(vkCreateFence(rig.device, &fence_info, NULL, &fence));
    assert_int_equal(vkGetEventStatus(rig.device, event), VK_EVENT_RESET);
    vkCmdWaitEvents(rig.commands, 1, &event, VK_PIPELINE_STAGE_HOST_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0,
                    NULL, 0, NULL, 0, NULL);
    vkCmdFillBuffer(rig.commands, buffer.buffer, 0, 4, 7);
    CHECK(vkEndCommandBuffer(rig.commands));
    CHECK(vkQueueSubmit(rig.queue, 1, &submit, fence));
    assert_int_equal(vkWaitForFences(rig.device, 1, &fence, VK_TRUE, 1000000), VK_TIMEOUT);
    assert_int_equal(vkGetFenceStatus(rig.device, fence), VK_NOT_READY);
    CHECK(vkSetEvent(rig.device, event));
    CHECK(vkWaitForFences(rig.device, 1, &fence, VK_TRUE, UINT64_MAX));
    assert_int_equal(*(const uint32_t *)buffer.bytes, 7);
    vkDestroyEvent(rig.device, event, NULL);
    vkDestroyFence(rig.device, fence, NULL);
    rig_close(&rig);
}

static int64_t microseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * INT64_C(1000000) + now.tv_nsec / 1000;
}

// A program that asks without a pause whether something is done leaves its core to the threads that do it. Ways to ask
// that do not wait are asked for a tenth of a second each, which is time for a hundred thousand answers.
static void answers_come_slowly_while_work_is_under_way(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const VkSemaphoreTypeCreateInfo type = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                            .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE};
    const VkSemaphoreCreateInfo semaphore_info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO,
                                                  .pNext = &type};
    const VkEventCreateInfo event_info = {.sType = VK_STRUCTURE_TYPE_EVENT_CREATE_INFO};
    const VkFenceCreateInfo fence_info = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    const PFN_vkGetSemaphoreCounterValueKHR get =
        (PFN_vkGetSemaphoreCounterValueKHR)vkGetDeviceProcAddr(rig.device, "vkGetSemaphoreCounterValueKHR");
    VkSemaphore semaphore;
    VkEvent event;
    VkFence fence;
    uint64_t value = 1;
    CHECK(vkCreateSemaphore(rig.device, &semaphore_info, NULL, &semaphore));
    CHECK(vkCreateEvent(rig.device, &event_info, NULL, &event));
    CHECK(vkCreateFence(rig.device, &fence_info, NULL, &fence));
    vkCmdWaitEvents(rig.commands, 1, &event, VK_PIPELINE_STAGE_HOST_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0,
                    NULL, 0, NULL, 0, NULL);
    CHECK(vkEndCommandBuffer(rig.commands));
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &rig.commands};
    CHECK(vkQueueSubmit(rig.queue, 1, &submit, fence));
    for (int way = 0; way < 4; way++) {
        int answers = 0;
        const bool is_polite = way == 1; // a wait without time does not wait
        for (const int64_t end = microseconds() + 100000; microseconds() < end; answers++) {
            switch (way) {
            case 0: assert_int_equal(vkGetFenceStatus(rig.device, fence), VK_NOT_READY); break;
            case 1: assert_int_equal(vkWaitForFences(rig.device, 1, &fence, VK_TRUE, 0), VK_TIMEOUT); break;
            case 2: assert_int_equal(vkGetEventStatus(rig.device, event), VK_EVENT_RESET); break;
            case 3: CHECK(get(rig.device, semaphore, &value)); break;
            }
        }
        assert_in_range(answers, is_polite ? 3000 : 1, is_polite ? INT_MAX : 2000);
    }
    assert_int_equal(value, 0);
    CHECK(vkSetEvent(rig.device, event));
    CHECK(vkWaitForFences(rig.device, 1, &fence, VK_TRUE, UINT64_MAX));
    CHECK(vkGetFenceStatus(rig.device, fence));
    vkDestroySemaphore(rig.device, semaphore, NULL);
    vkDestroyEvent(rig.device, event, NULL);
    vkDestroyFence(rig.device, fence, NULL);
    rig_close(&rig);
}

// A timeline is waited for by what is submitted, and by the program; the program signals it too.
static void timelines_count(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const VkSemaphoreTypeCreateInfo type = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO,
                                            .semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE,
                                            .initialValue = 3};
    const VkSemaphoreCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, .pNext = &type};
    const struct rig_buffer buffer = rig_buffer(&rig, 4, NULL);
    const uint64_t five = 5, six = 6;
    uint64_t value = 0;
    VkSemaphore semaphore;
    const PFN_vkGetSemaphoreCounterValueKHR get =
        (PFN_vkGetSemaphoreCounterValueKHR)vkGetDeviceProcAddr(rig.device, "vkGetSemaphoreCounterValueKHR");
    const PFN_vkWaitSemaphoresKHR wait_for =
        (PFN_vkWaitSemaphoresKHR)vkGetDeviceProcAddr(rig.device, "vkWaitSemaphoresKHR");
    const PFN_vkSignalSemaphoreKHR signal_to =
        (PFN_vkSignalSemaphoreKHR)vkGetDeviceProcAddr(rig.device, "vkSignalSemaphoreKHR");
    CHECK(vkCreateSemaphore(rig.device, &info, NULL, &semaphore));
    const VkTimelineSemaphoreSubmitInfo values = {.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO,
                                                  .waitSemaphoreValueCount = 1,
                                                  .pWaitSemaphoreValues = &five,
                                                  .signalSemaphoreValueCount = 1,
                                                  .pSignalSemaphoreValues = &six};
    const VkPipelineStageFlags stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .pNext = &values,
                                 .waitSemaphoreCount = 1,
                                 .pWaitSemaphores = &semaphore,
                                 .pWaitDstStageMask = &stages,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &rig.commands,
                                 .signalSemaphoreCount = 1,
                                 .pSignalSemaphores = &semaphore};
    const VkSemaphoreWaitInfo wait = {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO,
                                      .semaphoreCount = 1,
                                      .pSemaphores = &semaphore,
                                      .pValues = &six};
    vkCmdFillBuffer(rig.commands, buffer.buffer, 0, 4, 9);
    CHECK(vkEndCommandBuffer(rig.commands));
    CHECK(vkQueueSubmit(rig.queue, 1, &submit, VK_NULL_HANDLE));
    assert_int_equal(wait_for(rig.device, &wait, 1000000), VK_TIMEOUT);
    CHECK(get(rig.device, semaphore, &value));
    assert_int_equal(value, 3);
    assert_int_equal(*(const uint32_t *)buffer.bytes, 0);
    CHECK(signal_to(rig.device, &(VkSemaphoreSignalInfo){.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO,
                                                         .semaphore = semaphore,
                                                         .value = five}));
    CHECK(wait_for(rig.device, &wait, UINT64_MAX));
    CHECK(get(rig.device, semaphore, &value));
    assert_int_equal(value, 6);
    assert_int_equal(*(const uint32_t *)buffer.bytes, 9);
    CHECK(vkDeviceWaitIdle(rig.device));
    vkDestroySemaphore(rig.device, semaphore, NULL);
    rig_close(&rig);
}

// Four samples are cleared, in two renderings that are one, and resolved at the end of the second.
static void renderings_need_no_render_pass(void **state)
{
    (void)state;
    enum { SIDE = 8 };
    struct rig rig;
    rig_open(&rig);
    const PFN_vkCmdBeginRenderingKHR begin =
        (PFN_vkCmdBeginRenderingKHR)vkGetDeviceProcAddr(rig.device, "vkCmdBeginRenderingKHR");
    const PFN_vkCmdEndRenderingKHR end =
        (PFN_vkCmdEndRenderingKHR)vkGetDeviceProcAddr(rig.device, "vkCmdEndRenderingKHR");
    const VkImageUsageFlags usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    const struct rig_image many =
        rig_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, SIDE, SIDE, VK_SAMPLE_COUNT_4_BIT, usage);
    const struct rig_image one =
        rig_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, SIDE, SIDE, VK_SAMPLE_COUNT_1_BIT, usage);
    VkRenderingAttachmentInfo color = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                       .imageView = many.view,
                                       .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                       .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                       .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                       .clearValue = {.color = {.float32 = {0, 1, 0, 1}}}};
    const VkRenderingInfo info = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                  .renderArea = {.extent = {SIDE, SIDE}},
                                  .layerCount = 1,
                                  .colorAttachmentCount = 1,
                                  .pColorAttachments = &color};
    const VkClearAttachment blue = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
                                    .clearValue = {.color = {.float32 = {0, 0, 1, 1}}}};
    const VkClearRect left = {{{0, 0}, {2, SIDE}}, 0, 1};
    rig_barrier(&rig, &many, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    rig_barrier(&rig, &one, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    begin(rig.commands, &info);
    end(rig.commands);
    rig_barrier(&rig, &many, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
    color.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = one.view;
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    begin(rig.commands, &info);
    vkCmdClearAttachments(rig.commands, 1, &blue, 1, &left);
    end(rig.commands);
    rig_barrier(&rig, &one, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const struct rig_buffer texels = rig_read(&rig, &one, 4);
    rig_run(&rig);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const uint8_t green_or_blue[4] = {0, i % SIDE < 2 ? 0 : 255, i % SIDE < 2 ? 255 : 0, 255};
        assert_memory_equal((const uint8_t *)texels.bytes + 4 * i, green_or_blue, 4);
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(queries_count_samples_and_time),
    cmocka_unit_test(attachments_are_cleared_between_draws),
    cmocka_unit_test(secondary_buffers_draw_in_a_pass),
    cmocka_unit_test(events_are_waited_for),
    cmocka_unit_test(answers_come_slowly_while_work_is_under_way),
    cmocka_unit_test(timelines_count),
    cmocka_unit_test(renderings_need_no_render_pass),
};

const struct unit_tests test_vulkan_commands = UNIT_TESTS(tests, NULL, NULL);
