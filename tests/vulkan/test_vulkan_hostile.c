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
    const VkImageAspectFlags aspects = hostile_below(h, 5) ? h->aspects[image] : hostile_below(h, 8);
    const uint32_t level = hostile_below(h, 5) ? 0 : hostile_any(h);
    const uint32_t layer = hostile_below(h, 4) ? 0 : hostile_any(h);
    const uint32_t count = hostile_below(h, 4) ? 1 : hostile_any(h);
    return (VkImageSubresourceLayers){aspects, level, layer, count};
}

static VkOffset3D any_offset(struct hostile *h)
{
    const bool is_zero = hostile_below(h, 2);
    const uint32_t x = is_zero ? 0 : hostile_any(h), y = is_zero ? 0 : hostile_any(h);
    const uint32_t z = hostile_below(h, 3) ? 0 : hostile_any(h);
    return (VkOffset3D){(int32_t)x, (int32_t)y, (int32_t)z};
}

static VkExtent3D any_extent(struct hostile *h)
{
    const uint32_t width = hostile_any(h);
    const uint32_t height = hostile_below(h, 3) ? 1 : hostile_any(h);
    const uint32_t depth = hostile_below(h, 3) ? 1 : hostile_any(h);
    return (VkExtent3D){width, height, depth};
}

static void copy_buffers(struct hostile *h, VkCommandBuffer commands)
{
    static const unsigned char data[400];
    const VkDeviceSize from = hostile_size(h), to = hostile_size(h), size = hostile_size(h);
    const uint32_t first = hostile_any(h), count = hostile_any(h), small = hostile_below(h, 100);
    const VkQueryPool pool = h->pools[hostile_below(h, HOSTILE_POOLS)];
    const VkBuffer source = any_buffer(h), target = any_buffer(h);
    const VkBufferCopy copy = {from, to, size};
    const VkQueryResultFlags flags = hostile_below(h, 16) & ~2u; // nothing waits
    switch (hostile_below(h, 4)) {
    case 0: vkCmdCopyBuffer(commands, source, target, 1, &copy); break;
    case 1: vkCmdUpdateBuffer(commands, target, to / 4 * 4, 4 * small, data); break;
    case 2: vkCmdFillBuffer(commands, target, to / 4 * 4, size, first); break;
    default: vkCmdCopyQueryPoolResults(commands, pool, first, count, target, to, size, flags); break;
    }
}

static void copy_images(struct hostile *h, VkCommandBuffer commands)
{
    const uint32_t from = hostile_below(h, HOSTILE_IMAGES), to = hostile_below(h, HOSTILE_IMAGES);
    const VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL;
    const VkImageSubresourceLayers source = any_part(h, from), target = any_part(h, to);
    const VkOffset3D begin = any_offset(h), end = any_offset(h);
    const VkOffset3D target_begin = any_offset(h), target_end = any_offset(h);
    const VkExtent3D extent = any_extent(h);
    const VkDeviceSize place = hostile_size(h);
    const uint32_t length = hostile_below(h, 2) ? 0 : hostile_any(h);
    const uint32_t height = hostile_below(h, 2) ? 0 : hostile_any(h);
    const VkBuffer buffer = any_buffer(h);
    const VkFilter filter = (VkFilter)hostile_below(h, 2);
    const VkBufferImageCopy with_buffer = {place, length, height, source, begin, extent};
    const VkImageCopy copy = {source, begin, target, target_begin, extent};
    const VkImageBlit blit = {source, {begin, end}, target, {target_begin, target_end}};
    const VkImageResolve resolve = {source, begin, target, target_begin, extent};
    switch (hostile_below(h, 5)) {
    case 0: vkCmdCopyBufferToImage(commands, buffer, h->images[from], layout, 1, &with_buffer); break;
    case 1: vkCmdCopyImageToBuffer(commands, h->images[from], layout, buffer, 1, &with_buffer); break;
    case 2: vkCmdCopyImage(commands, h->images[from], layout, h->images[to], layout, 1, &copy); break;
    case 3: vkCmdBlitImage(commands, h->images[from], layout, h->images[to], layout, 1, &blit, filter); break;
    default: vkCmdResolveImage(commands, h->images[from], layout, h->images[to], layout, 1, &resolve); break;
    }
}

static void clear(struct hostile *h, VkCommandBuffer commands)
{
    const uint32_t image = hostile_below(h, HOSTILE_IMAGES);
    uint32_t n[12];
    hostile_fill(h, n, 12);
    const VkImageSubresourceRange range = {h->aspects[image], n[0], n[1], n[2], n[3]};
    const VkClearColorValue color = {.uint32 = {n[4], n[5], n[6], n[7]}};
    const VkClearDepthStencilValue depth = {0.5f, n[8]};
    const VkImageAspectFlags aspects = hostile_below(h, 8);
    const VkClearAttachment attachment = {aspects, n[9], {.color = color}};
    const VkRect2D area = hostile_rectangle(h);
    const VkClearRect rect = {area, hostile_below(h, 3) ? 0 : n[10], n[11]};
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
    uint32_t offsets[8] = {0}, push[32] = {0};
    hostile_fill(h, offsets, 2);
    hostile_fill(h, push, 8);
    VkBuffer buffers[3];
    VkDeviceSize places[3], sizes[3];
    for (int i = 0; i < 3; i++) {
        buffers[i] = any_buffer(h);
        places[i] = hostile_size(h);
        sizes[i] = hostile_size(h);
    }
    offsets[2] = 4 * hostile_below(h, 99);
    offsets[3] = 4 * hostile_below(h, 99);
    const VkPipeline graphics = h->graphics[hostile_below(h, HOSTILE_GRAPHICS)];
    const VkDescriptorSet set = h->sets[hostile_below(h, HOSTILE_SETS)];
    const uint32_t dynamics = hostile_below(h, 3) ? HOSTILE_DYNAMIC : hostile_below(h, 8);
    const uint32_t push_offset = hostile_below(h, 2) ? 0 : 4 * hostile_below(h, 40);
    const uint32_t push_size = 4 * hostile_below(h, 33);
    const uint32_t first = hostile_any(h), first_of_few = hostile_below(h, 6), count = hostile_below(h, 4);
    const VkIndexType type = (VkIndexType)hostile_below(h, 2);
    const bool has_sizes = hostile_below(h, 2);
    const bool is_first_set = hostile_below(h, 5);
    switch (hostile_below(h, 7)) {
    case 0:
        if (graphics) {
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, graphics);
        }
        break;
    case 1: vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, h->compute); break;
    case 2:
        vkCmdBindDescriptorSets(commands, point, h->layout, is_first_set ? 0 : first, 1, &set, dynamics,
                                offsets);
        break;
    case 3: vkCmdPushConstants(commands, h->layout, VK_SHADER_STAGE_ALL, push_offset, push_size, push); break;
    case 4: vkCmdBindVertexBuffers(commands, first, count, buffers, places); break;
    case 5: vkCmdBindIndexBuffer(commands, buffers[0], places[0], type); break;
    default: {
        const PFN_vkCmdBindTransformFeedbackBuffersEXT function =
            (PFN_vkCmdBindTransformFeedbackBuffersEXT)vkGetDeviceProcAddr(
                h->rig.device, "vkCmdBindTransformFeedbackBuffersEXT");
        function(commands, first_of_few, count, buffers, places, has_sizes ? sizes : NULL);
        break;
    }
    }
}

static void set_state(struct hostile *h, VkCommandBuffer commands)
{
    uint32_t n[8];
    hostile_fill(h, n, 8);
    const VkViewport viewports[2] = {
        {(float)(int32_t)n[0], (float)(int32_t)n[1], (float)n[2], (float)(int32_t)n[3], 0, 1},
        {0, 0, 16, 16, 0, 1}};
    const VkRect2D area = hostile_rectangle(h);
    const VkRect2D scissors[2] = {area, {{0, 0}, {16, 16}}};
    const bool is_wild = hostile_below(h, 3) == 0;
    const VkStencilFaceFlags faces = hostile_below(h, 4);
    vkCmdSetViewport(commands, is_wild ? n[4] : 0, 1, &viewports[hostile_below(h, 3) > 0]);
    vkCmdSetScissor(commands, is_wild ? n[5] : 0, 1, &scissors[hostile_below(h, 3) > 0]);
    vkCmdSetStencilReference(commands, faces, n[6]);
    vkCmdSetLineWidth(commands, (float)(int32_t)n[7]);
}

static void draw(struct hostile *h, VkCommandBuffer commands)
{
    const uint32_t first = hostile_any(h), instance = hostile_any(h), other = hostile_any(h);
    const uint32_t count = few(h), instances = few(h) / 4;
    const VkDeviceSize offset = hostile_size(h);
    switch (hostile_below(h, 6)) {
    case 0:
    case 1: vkCmdDraw(commands, count, instances, first, instance); break;
    case 2: vkCmdDrawIndexed(commands, count, instances, first, (int32_t)other, instance); break;
    case 3: vkCmdDrawIndirect(commands, h->buffers[5], offset, count, other); break;
    default: vkCmdDrawIndexedIndirect(commands, h->buffers[0], offset, count, other); break;
    }
}

static void dispatch(struct hostile *h, VkCommandBuffer commands)
{
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, h->compute);
    if (hostile_below(h, 4)) {
        const uint32_t x = 1 + hostile_below(h, 3), y = hostile_below(h, 3), z = hostile_below(h, 2);
        vkCmdDispatch(commands, x, y, z);
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
    uint32_t n[3];
    hostile_fill(h, n, 3);
    const VkClearValue clears[2] = {{.color = {.uint32 = {n[0], n[1]}}}, {.depthStencil = {1, n[2]}}};
    const VkRect2D whole = {{0, 0}, {16, 16}};
    const VkRect2D wild = hostile_rectangle(h);
    const uint32_t other = hostile_below(h, 3) ? pass : hostile_below(h, HOSTILE_PASSES);
    const bool is_whole = hostile_below(h, 3);
    const uint32_t clear_count = hostile_below(h, 3);
    if (!h->is_in_pass) {
        const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                             .renderPass = h->passes[pass],
                                             .framebuffer = h->framebuffers[other],
                                             .renderArea = is_whole ? whole : wild,
                                             .clearValueCount = clear_count,
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
    uint64_t trace = 0;
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
        trace ^= h.trace;
    }
    if (!first && !count) { // what another compiler picked, too
        assert_int_equal(trace, UINT64_C(0x22ccfcb107d15831));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(nothing_is_harmed),
};

const struct unit_tests test_vulkan_hostile = UNIT_TESTS(tests, NULL, NULL);
