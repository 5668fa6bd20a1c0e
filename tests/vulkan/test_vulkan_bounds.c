// SPDX-License-Identifier: MIT
// Commands that name more than there is write nothing outside of it.
#include <stdlib.h>
#include <string.h>

#include "vulkan_rig.h"

// Two buffers and an image in one memory, one behind the other; the last buffer holds ones, and nothing else is 1.
struct neighbours {
    VkDeviceMemory memory;
    VkBuffer first, last;
    VkImage image;
    VkDeviceSize image_size;
    unsigned char *bytes; // of the last buffer
};

static VkBuffer make_neighbour(struct rig *rig, VkDeviceMemory memory, VkDeviceSize offset)
{
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                     .size = 64,
                                     .usage =
                                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer buffer;
    CHECK(vkCreateBuffer(rig->device, &info, NULL, &buffer));
    RIG_KEEP(rig, BUFFER, buffer);
    CHECK(vkBindBufferMemory(rig->device, buffer, memory, offset));
    return buffer;
}

static void make_neighbours(struct rig *rig, struct neighbours *made)
{
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_2D,
                                    .format = VK_FORMAT_BC4_UNORM_BLOCK,
                                    .extent = {8, 8, 1},
                                    .mipLevels = 1,
                                    .arrayLayers = 1,
                                    .samples = VK_SAMPLE_COUNT_1_BIT,
                                    .usage =
                                        VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
    VkMemoryRequirements needs;
    CHECK(vkCreateImage(rig->device, &info, NULL, &made->image));
    vkGetImageMemoryRequirements(rig->device, made->image, &needs);
    made->image_size = (needs.size + 63) / 64 * 64;
    const VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                             .allocationSize = made->image_size + 192};
    void *bytes;
    CHECK(vkAllocateMemory(rig->device, &allocation, NULL, &made->memory));
    RIG_KEEP(rig, DEVICE_MEMORY, made->memory);
    RIG_KEEP(rig, IMAGE, made->image);
    CHECK(vkBindImageMemory(rig->device, made->image, made->memory, 64));
    made->first = make_neighbour(rig, made->memory, 0);
    made->last = make_neighbour(rig, made->memory, made->image_size + 64);
    CHECK(vkMapMemory(rig->device, made->memory, 0, VK_WHOLE_SIZE, 0, &bytes));
    made->bytes = (unsigned char *)bytes + made->image_size + 64;
    memset(made->bytes, 1, 64);
}

static void nothing_is_written_outside(void **state)
{
    (void)state;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the misuse
    }
    struct rig rig;
    struct neighbours made;
    rig_open(&rig);
    make_neighbours(&rig, &made);
    const VkBuffer after = make_neighbour(&rig, made.memory, made.image_size + 128);
    const struct rig_buffer zeros = rig_buffer(&rig, 4096, NULL);
    VkCommandBuffer commands = rig.commands;
    const VkBufferCopy copy = {0, 0, 4096}, far = {0, 1 << 20, 64};
    vkCmdCopyBuffer(commands, zeros.buffer, made.first, 1, &copy);
    vkCmdCopyBuffer(commands, zeros.buffer, made.first, 1, &far);
    vkCmdUpdateBuffer(commands, made.first, 32, 4096, zeros.bytes);
    vkCmdFillBuffer(commands, made.first, 0, 4096, 0);
    const struct rig_image image = {.image = made.image, .layers = 1};
    rig_barrier(&rig, &image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    // More rows than the image has, a level that it does not have, and more bytes than the buffer has
    VkBufferImageCopy rows = {.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                              .imageExtent = {8, 4 * (uint32_t)made.image_size, 1}};
    vkCmdCopyBufferToImage(commands, zeros.buffer, made.image, VK_IMAGE_LAYOUT_GENERAL, 1, &rows);
    rows.imageExtent.height = 8;
    rows.imageSubresource.mipLevel = 9;
    vkCmdCopyBufferToImage(commands, zeros.buffer, made.image, VK_IMAGE_LAYOUT_GENERAL, 1, &rows);
    rows.imageSubresource.mipLevel = 0;
    rows.bufferRowLength = 4 * (uint32_t)made.image_size;
    vkCmdCopyImageToBuffer(commands, made.image, VK_IMAGE_LAYOUT_GENERAL, made.first, 1, &rows);
    const VkImageCopy below = {.srcSubresource = rows.imageSubresource,
                               .dstSubresource = rows.imageSubresource,
                               .dstOffset = {0, 4 * (int)(made.image_size / 16), 0},
                               .extent = {8, 8, 1}};
    vkCmdCopyImage(commands, made.image, VK_IMAGE_LAYOUT_GENERAL, made.image, VK_IMAGE_LAYOUT_GENERAL, 1,
                   &below);
    const VkQueryPoolCreateInfo info = {.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                        .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                        .queryCount = 2};
    VkQueryPool pool;
    CHECK(vkCreateQueryPool(rig.device, &info, NULL, &pool));
    vkCmdResetQueryPool(commands, pool, 1, 1000);
    vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool, 1000);
    vkCmdCopyQueryPoolResults(commands, pool, 0, 2, made.first, 0, made.image_size + 64,
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_PARTIAL_BIT);
    // This stride leads to the bytes before those that it counts from.
    vkCmdCopyQueryPoolResults(commands, pool, 0, 2, after, 0, (VkDeviceSize)-8,
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_PARTIAL_BIT);
    rig_run(&rig);
    vkDestroyQueryPool(rig.device, pool, NULL);
    for (int i = 0; i < 64; i++) {
        assert_int_equal(made.bytes[i], 1);
    }
    // What does not fit into its memory is not bound to it.
    const VkBufferCreateInfo large = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                      .size = 1 << 20,
                                      .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer buffer;
    CHECK(vkCreateBuffer(rig.device, &large, NULL, &buffer));
    assert_int_equal(vkBindBufferMemory(rig.device, buffer, made.memory, 0), VK_ERROR_OUT_OF_DEVICE_MEMORY);
    vkDestroyBuffer(rig.device, buffer, NULL);
    rig_close(&rig);
}

// Slices of a buffer stand 2^31 rows of 2^31 texels apart, whose bytes are 0 in 64 bits. The second one is not there.
static void slices_stand_far_apart(void **state)
{
    (void)state;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the misuse
    }
    struct rig rig;
    rig_open(&rig);
    const uint32_t ones[4] = {0x01010101, 0x01010101, 0x01010101, 0x01010101};
    const struct rig_buffer buffer = rig_buffer(&rig, sizeof ones, ones);
    const struct rig_image image =
        rig_layers(&rig, VK_FORMAT_R8G8B8A8_UNORM, 2, 1, 2,
                   VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    rig_barrier(&rig, &image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    const VkBufferImageCopy region = {.bufferRowLength = 1u << 31,
                                      .bufferImageHeight = 1u << 31,
                                      .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 2},
                                      .imageExtent = {2, 1, 1}};
    vkCmdCopyBufferToImage(rig.commands, buffer.buffer, image.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                           &region);
    rig_barrier(&rig, &image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const struct rig_buffer read = rig_read(&rig, &image, 4);
    rig_run(&rig);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(((const uint32_t *)read.bytes)[i], 0);
    }
    rig_close(&rig);
}

// A region names one aspect. One that names both is no region of stencil, of 1 byte a texel, but one of depth.
static void two_aspects_have_no_room(void **state)
{
    (void)state;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the misuse
    }
    struct rig rig;
    struct neighbours made;
    rig_open(&rig);
    make_neighbours(&rig, &made);
    const struct rig_image image =
        rig_image(&rig, VK_FORMAT_D32_SFLOAT_S8_UINT, 1, 1, VK_SAMPLE_COUNT_1_BIT,
                  VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    const VkImageAspectFlags both = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    const VkClearDepthStencilValue one = {1, 0};
    const VkImageSubresourceRange range = {both, 0, 1, 0, 1};
    rig_barrier(&rig, &image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    vkCmdClearDepthStencilImage(rig.commands, image.image, VK_IMAGE_LAYOUT_GENERAL, &one, 1, &range);
    const VkBufferImageCopy end = {
        .bufferOffset = 62, .imageSubresource = {both, 0, 0, 1}, .imageExtent = {1, 1, 1}};
    vkCmdCopyImageToBuffer(rig.commands, image.image, VK_IMAGE_LAYOUT_GENERAL, made.last, 1, &end);
    rig_run(&rig);
    assert_int_equal(made.bytes[64], 0);
    assert_int_equal(made.bytes[65], 0);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(nothing_is_written_outside),
    cmocka_unit_test(slices_stand_far_apart),
    cmocka_unit_test(two_aspects_have_no_room),
};

const struct unit_tests test_vulkan_bounds = UNIT_TESTS(tests, NULL, NULL);
