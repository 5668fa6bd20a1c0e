// SPDX-License-Identifier: MIT
// Commands whose numbers are picked at random, most of which Vulkan forbids. Nothing crashes, and nothing is written
// where no object stands.
#include <stdlib.h>

#include "vulkan_hostile.h"

enum { SEEDS = 60, SUBMISSIONS = 6, COMMANDS = 40 };

// Return a number of things that are drawn or dispatched, which is small, since all of them take time.
static uint32_t few(struct hostile *h)
{
    return hostile_below(h, 30);
}

static VkBuffer any_buffer(struct hostile *h)
{
    return h->buffers[hostile_below(h, HOSTILE_BUFFERS)];
}

static VkImageSubresourceLayers any_part(struct hostile *h, uint32_t image)
{
    return (VkImageSubresourceLayers){hostile_below(h, 5) ? h->aspects[image] : hostile_below(h, 8),
                                      hostile_below(h, 5) ? 0 : hostile_any(h),
                                      hostile_below(h, 4) ? 0 : hostile_any(h),
                                      hostile_below(h, 4) ? 1 : hostile_any(h)};
}

static VkOffset3D any_offset(struct hostile *h)
{
    const bool is_zero = hostile_below(h, 2);
    return (VkOffset3D){is_zero ? 0 : (int32_t)hostile_any(h), is_zero ? 0 : (int32_t)hostile_any(h),
                        hostile_below(h, 3) ? 0 : (int32_t)hostile_any(h)};
}

static VkExtent3D any_extent(struct hostile *h)
{
    return (VkExtent3D){hostile_any(h), hostile_below(h, 3) ? 1 : hostile_any(h),
                        hostile_below(h, 3) ? 1 : hostile_any(h)};
}

static void copy_buffers(struct hostile *h, VkCommandBuffer commands)
{
    const VkBufferCopy copy = {hostile_size(h), hostile_size(h), hostile_size(h)};
    static const unsigned char data[400];
    switch (hostile_below(h, 4)) {
    case 0: vkCmdCopyBuffer(commands, any_buffer(h), any_buffer(h), 1, &copy); break;
    case 1:
        vkCmdUpdateBuffer(commands, any_buffer(h), hostile_size(h) / 4 * 4, 4 * hostile_below(h, 100), data);
        break;
    case 2:
        vkCmdFillBuffer(commands, any_buffer(h), hostile_size(h) / 4 * 4, hostile_size(h), hostile_any(h));
        break;
    default:
        vkCmdCopyQueryPoolResults(commands, h->pools[hostile_below(h, HOSTILE_POOLS)], hostile_any(h),
                                  hostile_any(h), any_buffer(h), hostile_size(h), hostile_size(h),
                                  hostile_below(h, 16) & ~2u); // nothing waits
        break;
    }
}

static void copy_images(struct hostile *h, VkCommandBuffer commands)
{
    const uint32_t from = hostile_below(h, HOSTILE_IMAGES), to = hostile_below(h, HOSTILE_IMAGES);
    const VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL;
    const VkBufferImageCopy with_buffer = {hostile_size(h),
                                           hostile_below(h, 2) ? 0 : hostile_any(h),
                                           hostile_below(h, 2) ? 0 : hostile_any(h),
                                           any_part(h, from),
                                           any_offset(h),
                                           any_extent(h)};
    const VkImageCopy copy = {any_part(h, from), any_offset(h), any_part(h, to), any_offset(h),
                              any_extent(h)};
    const VkImageBlit blit = {
        any_part(h, from), {any_offset(h), any_offset(h)}, any_part(h, to), {any_offset(h), any_offset(h)}};
    const VkImageResolve resolve = {any_part(h, from), any_offset(h), any_part(h, to), any_offset(h),
                                    any_extent(h)};
    switch (hostile_below(h, 5)) {
    case 0: vkCmdCopyBufferToImage(commands, any_buffer(h), h->images[from], layout, 1, &with_buffer); break;
    case 1: vkCmdCopyImageToBuffer(commands, h->images[from], layout, any_buffer(h), 1, &with_buffer); break;
    case 2: vkCmdCopyImage(commands, h->images[from], layout, h->images[to], layout, 1, &copy); break;
    case 3:
        vkCmdBlitImage(commands, h->images[from], layout, h->images[to], layout, 1, &blit,
                       (VkFilter)hostile_below(h, 2));
        break;
    default: vkCmdResolveImage(commands, h->images[from], layout, h->images[to], layout, 1, &resolve); break;
    }
}

static void clear(struct hostile *h, VkCommandBuffer commands)
{
    const uint32_t image = hostile_below(h, HOSTILE_IMAGES);
    const VkImageSubresourceRange range = {h->aspects[image], hostile_any(h), hostile_any(h), hostile_any(h),
                                           hostile_any(h)};
    const VkClearColorValue color = {
        .uint32 = {hostile_any(h), hostile_any(h), hostile_any(h), hostile_any(h)}};
    const VkClearDepthStencilValue depth = {0.5f, hostile_any(h)};
    const VkClearAttachment attachment = {hostile_below(h, 8), hostile_any(h), {.color = color}};
    const VkClearRect rect = {
        {{(int32_t)hostile_any(h), (int32_t)hostile_any(h)}, {hostile_any(h), hostile_any(h)}},
        hostile_below(h, 3) ? 0 : hostile_any(h),
        hostile_any(h)};
    if (h->is_in_pass) {
        vkCmdClearAttachments(commands, 1, &attachment, 1, &rect);
    } else if (hostile_below(h, 2)) {
        vkCmdClearColorImage(commands, h->images[image], VK_IMAGE_LAYOUT_GENERAL, &color, 1, &range);
    } else {
        vkCmdClearDepthStencilImage(commands, h->images[image], VK_IMAGE_LAYOUT_GENERAL, &depth, 1, &range);
    }
}

static void bind(struct hostile *h, VkCommandBuffer commands)
{
    const VkPipelineBindPoint point = (VkPipelineBindPoint)hostile_below(h, 2);
    const uint32_t offsets[8] = {
        hostile_any(h), hostile_any(h), 4 * hostile_below(h, 99), 4 * hostile_below(h, 99), 0, 0, 0, 0};
    const uint32_t push[32] = {hostile_any(h), hostile_any(h), hostile_any(h), hostile_any(h),
                               hostile_any(h), hostile_any(h), hostile_any(h), hostile_any(h)};
    const VkBuffer buffers[3] = {any_buffer(h), any_buffer(h), any_buffer(h)};
    const VkDeviceSize places[3] = {hostile_size(h), hostile_size(h), hostile_size(h)};
    const VkDeviceSize sizes[3] = {hostile_size(h), hostile_size(h), hostile_size(h)};
    const VkPipeline graphics = h->graphics[hostile_below(h, HOSTILE_GRAPHICS)];
    const uint32_t push_offset = 4 * hostile_below(h, 40);
    switch (hostile_below(h, 7)) {
    case 0:
        if (graphics) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, graphics);
        }
        break;
    case 1: vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, h->compute); break;
    case 2:
        vkCmdBindDescriptorSets(commands, point, h->layout, hostile_below(h, 5) ? 0 : hostile_any(h), 1,
                                &h->sets[hostile_below(h, HOSTILE_SETS)],
                                hostile_below(h, 3) ? HOSTILE_DYNAMIC : hostile_below(h, 8), offsets);
        break;
    case 3:
        vkCmdPushConstants(commands, h->layout, VK_SHADER_STAGE_ALL, hostile_below(h, 2) ? 0 : push_offset,
                           4 * hostile_below(h, 33), push);
        break;
    case 4: vkCmdBindVertexBuffers(commands, hostile_any(h), hostile_below(h, 4), buffers, places); break;
    case 5:
        vkCmdBindIndexBuffer(commands, any_buffer(h), hostile_size(h), (VkIndexType)hostile_below(h, 2));
        break;
    default: {
        const PFN_vkCmdBindTransformFeedbackBuffersEXT function =
            (PFN_vkCmdBindTransformFeedbackBuffersEXT)vkGetDeviceProcAddr(
                h->rig.device, "vkCmdBindTransformFeedbackBuffersEXT");
        function(commands, hostile_below(h, 6), hostile_below(h, 4), buffers, places,
                 hostile_below(h, 2) ? sizes : NULL);
        break;
    }
    }
}

static void set_state(struct hostile *h, VkCommandBuffer commands)
{
    const VkViewport viewports[2] = {{(float)(int32_t)hostile_any(h), (float)(int32_t)hostile_any(h),
                                      (float)hostile_any(h), (float)(int32_t)hostile_any(h), 0, 1},
                                     {0, 0, 16, 16, 0, 1}};
    const VkRect2D scissors[2] = {
        {{(int32_t)hostile_any(h), (int32_t)hostile_any(h)}, {hostile_any(h), hostile_any(h)}},
        {{0, 0}, {16, 16}}};
    const bool is_wild = hostile_below(h, 3) == 0;
    vkCmdSetViewport(commands, is_wild ? hostile_any(h) : 0, 1, &viewports[hostile_below(h, 3) > 0]);
    vkCmdSetScissor(commands, is_wild ? hostile_any(h) : 0, 1, &scissors[hostile_below(h, 3) > 0]);
    vkCmdSetStencilReference(commands, hostile_below(h, 4), hostile_any(h));
    vkCmdSetLineWidth(commands, (float)(int32_t)hostile_any(h));
}

static void draw(struct hostile *h, VkCommandBuffer commands)
{
    const uint32_t first = hostile_any(h), instance = hostile_any(h);
    switch (hostile_below(h, 6)) {
    case 0:
    case 1: vkCmdDraw(commands, few(h), few(h) / 4, first, instance); break;
    case 2: vkCmdDrawIndexed(commands, few(h), few(h) / 4, first, (int32_t)hostile_any(h), instance); break;
    case 3: vkCmdDrawIndirect(commands, h->buffers[5], hostile_size(h), few(h), hostile_any(h)); break;
    default:
        vkCmdDrawIndexedIndirect(commands, h->buffers[0], hostile_size(h), few(h), hostile_any(h));
        break;
    }
}

static void dispatch(struct hostile *h, VkCommandBuffer commands)
{
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, h->compute);
    if (hostile_below(h, 4)) {
        vkCmdDispatch(commands, 1 + hostile_below(h, 3), hostile_below(h, 3), hostile_below(h, 2));
    } else {
        vkCmdDispatchIndirect(commands, h->buffers[0], hostile_size(h)); // 4 bytes are no 3 numbers
    }
}

static void query(struct hostile *h, VkCommandBuffer commands)
{
    const VkQueryPool pool = h->pools[hostile_below(h, HOSTILE_POOLS)];
    const uint32_t index = hostile_below(h, 4) ? hostile_below(h, 4) : hostile_any(h);
    switch (hostile_below(h, 4)) {
    case 0: vkCmdBeginQuery(commands, pool, index, 0); break;
    case 1: vkCmdEndQuery(commands, pool, index); break;
    case 2: vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, index); break;
    default: vkCmdResetQueryPool(commands, pool, index, hostile_any(h)); break;
    }
}

static void change_pass(struct hostile *h, VkCommandBuffer commands)
{
    const uint32_t pass = hostile_below(h, HOSTILE_PASSES);
    const VkClearValue clears[2] = {{.color = {.uint32 = {hostile_any(h), hostile_any(h)}}},
                                    {.depthStencil = {1, hostile_any(h)}}};
    const VkRect2D whole = {{0, 0}, {16, 16}};
    const VkRect2D wild = {{(int32_t)hostile_any(h), (int32_t)hostile_any(h)},
                           {hostile_any(h), hostile_any(h)}};
    if (!h->is_in_pass) {
        const VkRenderPassBeginInfo begin = {
            .sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
            .renderPass = h->passes[pass],
            .framebuffer = h->framebuffers[hostile_below(h, 3) ? pass : hostile_below(h, HOSTILE_PASSES)],
            .renderArea = hostile_below(h, 3) ? whole : wild,
            .clearValueCount = hostile_below(h, 3),
            .pClearValues = clears};
        vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
        h->is_in_pass = true;
    } else if (hostile_below(h, 2)) {
        vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
    } else {
        vkCmdEndRenderPass(commands);
        h->is_in_pass = false;
    }
}

static void record(struct hostile *h, VkCommandBuffer commands)
{
    switch (hostile_below(h, 12)) {
    case 0: copy_buffers(h, commands); break;
    case 1:
    case 2: copy_images(h, commands); break;
    case 3: clear(h, commands); break;
    case 4:
    case 5: bind(h, commands); break;
    case 6: set_state(h, commands); break;
    case 7:
    case 8: draw(h, commands); break;
    case 9: dispatch(h, commands); break;
    case 10: query(h, commands); break;
    default: change_pass(h, commands); break;
    }
}

static void nothing_is_harmed(void **state)
{
    (void)state;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the misuse
    }
    // A search for more of them begins at another seed and takes longer.
    const char *const first = getenv("RHW_TEST_SEED"), *const count = getenv("RHW_TEST_SEEDS");
    const uint64_t begin = first ? strtoull(first, NULL, 10) : 0;
    const uint64_t end = begin + (count ? strtoull(count, NULL, 10) : SEEDS);
    for (uint64_t seed = begin; seed < end; seed++) {
        struct hostile h;
        if (count) {
            print_message("seed %llu\n", (unsigned long long)seed);
        }
        hostile_open(&h, seed);
        for (int s = 0; s < SUBMISSIONS; s++) {
            for (int c = 0; c < COMMANDS; c++) {
                record(&h, h.rig.commands);
            }
            if (h.is_in_pass) {
                vkCmdEndRenderPass(h.rig.commands);
                h.is_in_pass = false;
            }
            rig_run(&h.rig);
            hostile_write_set(&h);
        }
        hostile_check(&h);
        rig_close(&h.rig);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(nothing_is_harmed),
};

const struct unit_tests test_vulkan_hostile = UNIT_TESTS(tests, NULL, NULL);
