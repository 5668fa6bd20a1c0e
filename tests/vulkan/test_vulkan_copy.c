// SPDX-License-Identifier: MIT
// Copies, clears, blits and resolves: images of several kinds and formats, against bytes that are computed here.
#include "vulkan_rig.h"

#include <string.h>

enum { SIDE = 8 };

static const VkImageUsageFlags both = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;

// Create an image that is only copied from and to, with memory of its own.
static VkImage make_image(struct rig *rig, VkImageType type, VkFormat format, VkExtent3D extent,
                          uint32_t levels, uint32_t layers)
{
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = type,
                                    .format = format,
                                    .extent = extent,
                                    .mipLevels = levels,
                                    .arrayLayers = layers,
                                    .samples = VK_SAMPLE_COUNT_1_BIT,
                                    .usage = both};
    VkImage image;
    CHECK(vkCreateImage(rig->device, &info, NULL, &image));
    rig_back(rig, image);
    return image;
}

// Let all of an image take part in copies, and let what was written before be seen.
static void settle(struct rig *rig, VkImage image, VkImageAspectFlags aspects, VkImageLayout from)
{
    const VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = VK_IMAGE_LAYOUT_GENERAL,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {aspects, 0, VK_REMAINING_MIP_LEVELS, 0, VK_REMAINING_ARRAY_LAYERS}};
    vkCmdPipelineBarrier(rig->commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
}

static void settle_color(struct rig *rig, VkImage image)
{
    settle(rig, image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_GENERAL);
}

static VkImage make_color(struct rig *rig, VkImageType type, VkFormat format, VkExtent3D extent,
                          uint32_t levels, uint32_t layers)
{
    const VkImage image = make_image(rig, type, format, extent, levels, layers);
    settle(rig, image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED);
    return image;
}

static VkBufferImageCopy region_of(VkImageAspectFlags aspect, uint32_t level, uint32_t layer, uint32_t layers,
                                   VkExtent3D extent)
{
    return (VkBufferImageCopy){.imageSubresource = {aspect, level, layer, layers}, .imageExtent = extent};
}

static void to_image(struct rig *rig, VkBuffer from, VkImage to, const VkBufferImageCopy *region)
{
    vkCmdCopyBufferToImage(rig->commands, from, to, VK_IMAGE_LAYOUT_GENERAL, 1, region);
}

static void to_buffer(struct rig *rig, VkImage from, VkBuffer to, const VkBufferImageCopy *region)
{
    vkCmdCopyImageToBuffer(rig->commands, from, VK_IMAGE_LAYOUT_GENERAL, to, 1, region);
}

static void fill_bytes(uint8_t *bytes, size_t size, unsigned seed)
{
    for (size_t i = 0; i < size; i++) {
        seed = seed * 1664525 + 1013904223;
        bytes[i] = (uint8_t)(seed >> 24);
    }
}

static void buffers_are_copied_filled_and_updated(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    uint8_t bytes[256], expected[256] = {0};
    fill_bytes(bytes, sizeof bytes, 1);
    const struct rig_buffer from = rig_buffer(&rig, sizeof bytes, bytes);
    const struct rig_buffer to = rig_buffer(&rig, sizeof bytes, NULL);
    const VkBufferCreateInfo endless = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                        .size = UINT64_MAX,
                                        .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer none;
    assert_int_equal(vkCreateBuffer(rig.device, &endless, NULL, &none), VK_ERROR_OUT_OF_DEVICE_MEMORY);
    const VkBufferCopy regions[2] = {{3, 10, 50}, {100, 96, 17}};
    vkCmdCopyBuffer(rig.commands, from.buffer, to.buffer, 2, regions);
    vkCmdUpdateBuffer(rig.commands, to.buffer, 128, 32, bytes + 200);
    vkCmdFillBuffer(rig.commands, to.buffer, 160, 20, 0x01020304);
    vkCmdFillBuffer(rig.commands, to.buffer, 236, VK_WHOLE_SIZE, 0xfffefdfc);
    rig_run(&rig);
    memcpy(expected + 10, bytes + 3, 50);
    memcpy(expected + 96, bytes + 100, 17);
    memcpy(expected + 128, bytes + 200, 32);
    for (int i = 0; i < 20; i++) {
        expected[160 + i] = (uint8_t)(4 - i % 4);
        expected[236 + i] = (uint8_t)(0xfc + i % 4);
    }
    assert_memory_equal(to.bytes, expected, sizeof expected);
    rig_close(&rig);
}

static void clears_have_the_bits_of_the_format(void **state)
{
    (void)state;
    static const struct {
        VkFormat format;
        VkClearColorValue value;
        size_t size;
        uint8_t texel[16];
    } rows[] = {
        {VK_FORMAT_R8G8B8A8_UNORM, {.float32 = {1, 0.5f, 0, 0.25f}}, 4, {255, 128, 0, 64}},
        {VK_FORMAT_B8G8R8A8_UNORM, {.float32 = {1, 0.5f, 0, 0.25f}}, 4, {0, 128, 255, 64}},
        {VK_FORMAT_R8G8B8A8_SRGB, {.float32 = {1, 0, 0.2140411f, 1}}, 4, {255, 0, 127, 255}},
        {VK_FORMAT_R16_UINT, {.uint32 = {0x12345, 0, 0, 0}}, 2, {0x45, 0x23}},
        {VK_FORMAT_R8G8_SINT, {.int32 = {-2, 100, 0, 0}}, 2, {0xfe, 100}},
        {VK_FORMAT_R32_SFLOAT, {.float32 = {1, 0, 0, 0}}, 4, {0, 0, 0x80, 0x3f}},
        {VK_FORMAT_A2B10G10R10_UNORM_PACK32, {.float32 = {1, 0, 0, 1}}, 4, {0xff, 0x03, 0, 0xc0}},
        {VK_FORMAT_R5G6B5_UNORM_PACK16, {.float32 = {1, 0, 0, 1}}, 2, {0, 0xf8}},
        {VK_FORMAT_R16G16B16A16_SFLOAT, {.float32 = {1, 2, 0, -1}}, 8, {0, 0x3c, 0, 0x40, 0, 0, 0, 0xbc}},
    };
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    struct rig rig;
    rig_open(&rig);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const VkExtent3D extent = {SIDE, SIDE, 1};
        const VkImage image = make_color(&rig, VK_IMAGE_TYPE_2D, rows[i].format, extent, 1, 1);
        const struct rig_buffer texels = rig_buffer(&rig, SIDE * SIDE * rows[i].size, NULL);
        const VkBufferImageCopy region = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1, extent);
        vkCmdClearColorImage(rig.commands, image, VK_IMAGE_LAYOUT_GENERAL, &rows[i].value, 1, &all);
        settle_color(&rig, image);
        to_buffer(&rig, image, texels.buffer, &region);
        rig_run(&rig);
        for (int texel = 0; texel < SIDE * SIDE; texel++) {
            assert_memory_equal((uint8_t *)texels.bytes + (size_t)texel * rows[i].size, rows[i].texel,
                                rows[i].size);
        }
    }
    rig_close(&rig);
}

static void regions_keep_to_levels_and_layers(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    uint8_t bytes[3 * 4 * 4 * 4];
    fill_bytes(bytes, sizeof bytes, 2);
    const VkImage image =
        make_color(&rig, VK_IMAGE_TYPE_2D, VK_FORMAT_R8G8B8A8_UNORM, (VkExtent3D){SIDE, SIDE, 1}, 3, 4);
    const struct rig_buffer from = rig_buffer(&rig, sizeof bytes, bytes);
    const struct rig_buffer to = rig_buffer(&rig, 1024, NULL);
    // Level 1 has 4 × 4 texels: fill layers 1 to 3, and read 2 × 3 texels of layers 2 and 3 with gaps.
    const VkBufferImageCopy write = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 1, 1, 3, (VkExtent3D){4, 4, 1});
    to_image(&rig, from.buffer, image, &write);
    settle_color(&rig, image);
    VkBufferImageCopy read = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 1, 2, 2, (VkExtent3D){2, 3, 1});
    read.imageOffset = (VkOffset3D){1, 1, 0};
    read.bufferOffset = 8;
    read.bufferRowLength = 5;
    read.bufferImageHeight = 4;
    to_buffer(&rig, image, to.buffer, &read);
    rig_run(&rig);
    for (int layer = 0; layer < 2; layer++) {
        for (int y = 0; y < 3; y++) {
            assert_memory_equal((uint8_t *)to.bytes + 8 + (layer * 4 + y) * 5 * 4,
                                bytes + (((layer + 1) * 4 + 1 + y) * 4 + 1) * 4, 2 * 4);
        }
    }
    rig_close(&rig);
}

static void layers_become_slices(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    uint8_t bytes[4 * SIDE * SIDE * 2];
    fill_bytes(bytes, sizeof bytes, 3);
    const VkExtent3D flat = {SIDE, SIDE, 1}, deep = {SIDE, SIDE, 4};
    const VkImage layers = make_color(&rig, VK_IMAGE_TYPE_2D, VK_FORMAT_R8G8_UNORM, flat, 1, 4);
    const VkImage slices = make_color(&rig, VK_IMAGE_TYPE_3D, VK_FORMAT_R16_UINT, deep, 1, 1);
    const struct rig_buffer from = rig_buffer(&rig, sizeof bytes, bytes);
    const struct rig_buffer to = rig_buffer(&rig, sizeof bytes, NULL);
    const VkBufferImageCopy write = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 4, flat);
    const VkBufferImageCopy read = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1, deep);
    const VkImageCopy copy = {.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 4},
                              .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                              .extent = deep};
    to_image(&rig, from.buffer, layers, &write);
    settle_color(&rig, layers);
    vkCmdCopyImage(rig.commands, layers, VK_IMAGE_LAYOUT_GENERAL, slices, VK_IMAGE_LAYOUT_GENERAL, 1, &copy);
    settle_color(&rig, slices);
    to_buffer(&rig, slices, to.buffer, &read);
    rig_run(&rig);
    assert_memory_equal(to.bytes, bytes, sizeof bytes);
    rig_close(&rig);
}

static void blocks_stay_as_they_are(void **state)
{
    (void)state;
    enum { BLOCKS = 2 * 3 }; // of an image of 8 × 12 texels
    struct rig rig;
    rig_open(&rig);
    uint8_t bytes[BLOCKS * 8];
    fill_bytes(bytes, sizeof bytes, 4);
    const VkExtent3D extent = {8, 12, 1}, blocks = {2, 3, 1};
    const VkFormat format = VK_FORMAT_BC1_RGB_UNORM_BLOCK;
    const VkImage first = make_color(&rig, VK_IMAGE_TYPE_2D, format, extent, 1, 1);
    const VkImage second = make_color(&rig, VK_IMAGE_TYPE_2D, format, extent, 1, 1);
    const VkImage words = make_color(&rig, VK_IMAGE_TYPE_2D, VK_FORMAT_R32G32_UINT, blocks, 1, 1);
    const struct rig_buffer from = rig_buffer(&rig, sizeof bytes, bytes);
    const struct rig_buffer to = rig_buffer(&rig, sizeof bytes, NULL);
    const VkBufferImageCopy region = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1, extent);
    VkImageCopy copy = {.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                        .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                        .extent = extent};
    to_image(&rig, from.buffer, first, &region);
    settle_color(&rig, first);
    vkCmdCopyImage(rig.commands, first, VK_IMAGE_LAYOUT_GENERAL, words, VK_IMAGE_LAYOUT_GENERAL, 1, &copy);
    settle_color(&rig, words);
    copy.extent = blocks;
    vkCmdCopyImage(rig.commands, words, VK_IMAGE_LAYOUT_GENERAL, second, VK_IMAGE_LAYOUT_GENERAL, 1, &copy);
    settle_color(&rig, second);
    to_buffer(&rig, second, to.buffer, &region);
    rig_run(&rig);
    assert_memory_equal(to.bytes, bytes, sizeof bytes);
    rig_close(&rig);
}

static void depth_and_stencil_are_copied_apart(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    uint8_t stencil[SIDE * SIDE];
    fill_bytes(stencil, sizeof stencil, 5);
    const VkExtent3D extent = {SIDE, SIDE, 1};
    const VkImageAspectFlags aspects = VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    const VkImage image = make_image(&rig, VK_IMAGE_TYPE_2D, VK_FORMAT_D32_SFLOAT_S8_UINT, extent, 1, 1);
    settle(&rig, image, aspects, VK_IMAGE_LAYOUT_UNDEFINED);
    const struct rig_buffer from = rig_buffer(&rig, sizeof stencil, stencil);
    const struct rig_buffer depths = rig_buffer(&rig, SIDE * SIDE * sizeof(float), NULL);
    const struct rig_buffer stencils = rig_buffer(&rig, sizeof stencil, NULL);
    const VkImageSubresourceRange all = {aspects, 0, 1, 0, 1};
    vkCmdClearDepthStencilImage(rig.commands, image, VK_IMAGE_LAYOUT_GENERAL,
                                &(VkClearDepthStencilValue){0.5f, 7}, 1, &all);
    settle(&rig, image, aspects, VK_IMAGE_LAYOUT_GENERAL);
    VkBufferImageCopy region = region_of(VK_IMAGE_ASPECT_STENCIL_BIT, 0, 0, 1, (VkExtent3D){SIDE, 1, 1});
    region.imageOffset.y = 2;
    to_image(&rig, from.buffer, image, &region);
    settle(&rig, image, aspects, VK_IMAGE_LAYOUT_GENERAL);
    region = region_of(VK_IMAGE_ASPECT_STENCIL_BIT, 0, 0, 1, extent);
    to_buffer(&rig, image, stencils.buffer, &region);
    region.imageSubresource.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
    to_buffer(&rig, image, depths.buffer, &region);
    rig_run(&rig);
    const uint8_t *const read = stencils.bytes;
    for (int i = 0; i < SIDE * SIDE; i++) {
        assert_int_equal(read[i], i / SIDE == 2 ? stencil[i % SIDE] : 7);
        assert_float_equal(((const float *)depths.bytes)[i], 0.5f, 0);
    }
    rig_close(&rig);
}

static void a_blit_scales_and_mirrors(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const uint8_t texels[4] = {0, 80, 160, 240}; // two columns, two rows
    const VkExtent3D small = {2, 2, 1}, large = {4, 4, 1};
    const VkImage from_image = make_color(&rig, VK_IMAGE_TYPE_2D, VK_FORMAT_R8_UNORM, small, 1, 1);
    const VkImage to_image_ = make_color(&rig, VK_IMAGE_TYPE_2D, VK_FORMAT_R32_SFLOAT, large, 1, 1);
    const struct rig_buffer from = rig_buffer(&rig, sizeof texels, texels);
    const struct rig_buffer to = rig_buffer(&rig, 16 * sizeof(float), NULL);
    const VkBufferImageCopy write = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1, small);
    const VkBufferImageCopy read = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1, large);
    const VkImageBlit blit = {.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                              .srcOffsets = {{0, 0, 0}, {2, 2, 1}},
                              .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                              .dstOffsets = {{4, 0, 0}, {0, 4, 1}}};
    to_image(&rig, from.buffer, from_image, &write);
    settle_color(&rig, from_image);
    vkCmdBlitImage(rig.commands, from_image, VK_IMAGE_LAYOUT_GENERAL, to_image_, VK_IMAGE_LAYOUT_GENERAL, 1,
                   &blit, VK_FILTER_NEAREST);
    settle_color(&rig, to_image_);
    to_buffer(&rig, to_image_, to.buffer, &read);
    rig_run(&rig);
    for (int i = 0; i < 16; i++) {
        const int x = 1 - i % 4 / 2, y = i / 4 / 2;
        assert_float_equal(((const float *)to.bytes)[i], (float)texels[2 * y + x] / 255, 1e-6f);
    }
    rig_close(&rig);
}

static void samples_are_averaged(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const VkImageUsageFlags target = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | both;
    const struct rig_image many =
        rig_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, SIDE, SIDE, VK_SAMPLE_COUNT_4_BIT, target);
    const struct rig_image one =
        rig_image(&rig, VK_FORMAT_R8G8B8A8_UNORM, SIDE, SIDE, VK_SAMPLE_COUNT_1_BIT, target);
    const VkImageSubresourceRange all = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    const VkImageResolve resolve = {.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                    .extent = {SIDE, SIDE, 1}};
    rig_barrier(&rig, &many, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    rig_barrier(&rig, &one, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdClearColorImage(rig.commands, many.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                         &(VkClearColorValue){.float32 = {0.2f, 0.4f, 0.6f, 1}}, 1, &all);
    rig_barrier(&rig, &many, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    vkCmdResolveImage(rig.commands, many.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, one.image,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &resolve);
    rig_barrier(&rig, &one, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const struct rig_buffer texels = rig_read(&rig, &one, 4);
    rig_run(&rig);
    for (int i = 0; i < SIDE * SIDE; i++) {
        assert_memory_equal((uint8_t *)texels.bytes + 4 * i, ((uint8_t[4]){51, 102, 153, 255}), 4);
    }
    rig_close(&rig);
}

static void linear_images_are_written_by_the_program(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_2D,
                                    .format = VK_FORMAT_R8G8B8A8_UNORM,
                                    .extent = {5, 3, 1},
                                    .mipLevels = 1,
                                    .arrayLayers = 1,
                                    .samples = VK_SAMPLE_COUNT_1_BIT,
                                    .tiling = VK_IMAGE_TILING_LINEAR,
                                    .usage = both,
                                    .initialLayout = VK_IMAGE_LAYOUT_PREINITIALIZED};
    VkImage image;
    VkDeviceMemory memory;
    VkMemoryRequirements needs;
    CHECK(vkCreateImage(rig.device, &info, NULL, &image));
    vkGetImageMemoryRequirements(rig.device, image, &needs);
    const VkMemoryAllocateInfo memory_info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                              .allocationSize = needs.size};
    CHECK(vkAllocateMemory(rig.device, &memory_info, NULL, &memory));
    rig_keep(&rig, VK_OBJECT_TYPE_DEVICE_MEMORY, (uint64_t)memory);
    rig_keep(&rig, VK_OBJECT_TYPE_IMAGE, (uint64_t)image);
    CHECK(vkBindImageMemory(rig.device, image, memory, 0));
    VkSubresourceLayout layout;
    vkGetImageSubresourceLayout(rig.device, image, &(VkImageSubresource){VK_IMAGE_ASPECT_COLOR_BIT, 0, 0},
                                &layout);
    uint8_t *bytes, texels[3 * 5 * 4];
    fill_bytes(texels, sizeof texels, 6);
    CHECK(vkMapMemory(rig.device, memory, 0, VK_WHOLE_SIZE, 0, (void **)&bytes));
    for (size_t y = 0; y < 3; y++) {
        memcpy(bytes + layout.offset + y * layout.rowPitch, texels + y * 20, 20);
    }
    settle(&rig, image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_PREINITIALIZED);
    const struct rig_buffer to = rig_buffer(&rig, sizeof texels, NULL);
    const VkBufferImageCopy read = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1, (VkExtent3D){5, 3, 1});
    to_buffer(&rig, image, to.buffer, &read);
    rig_run(&rig);
    assert_memory_equal(to.bytes, texels, sizeof texels);
    rig_close(&rig);
}

// Two images stand on one memory. One that comes back from UNDEFINED is cleared all over, though it was before.
static void images_may_share_memory(void **state)
{
    (void)state;
    enum { SIZE = 128, TEXELS = SIZE * SIZE };
    struct rig rig;
    rig_open(&rig);
    VkImage images[2];
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkExtent3D extent = {SIZE, SIZE, 1};
    for (int i = 0; i < 2; i++) {
        const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                        .flags = VK_IMAGE_CREATE_ALIAS_BIT,
                                        .imageType = VK_IMAGE_TYPE_2D,
                                        .format = VK_FORMAT_R8G8B8A8_UNORM,
                                        .extent = extent,
                                        .mipLevels = 1,
                                        .arrayLayers = 1,
                                        .samples = VK_SAMPLE_COUNT_1_BIT,
                                        .usage = both | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
        VkMemoryRequirements needs;
        CHECK(vkCreateImage(rig.device, &info, NULL, &images[i]));
        vkGetImageMemoryRequirements(rig.device, images[i], &needs);
        if (i == 0) {
            const VkMemoryAllocateInfo memory_info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                                      .allocationSize = needs.size};
            CHECK(vkAllocateMemory(rig.device, &memory_info, NULL, &memory));
            RIG_KEEP(&rig, DEVICE_MEMORY, memory);
        }
        RIG_KEEP(&rig, IMAGE, images[i]);
        CHECK(vkBindImageMemory(rig.device, images[i], memory, 0));
    }
    const VkImageViewCreateInfo view_info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                             .image = images[0],
                                             .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                             .format = VK_FORMAT_R8G8B8A8_UNORM,
                                             .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
    VkImageView view;
    CHECK(vkCreateImageView(rig.device, &view_info, NULL, &view));
    RIG_KEEP(&rig, IMAGE_VIEW, view);
    const PFN_vkCmdBeginRenderingKHR begin =
        (PFN_vkCmdBeginRenderingKHR)vkGetDeviceProcAddr(rig.device, "vkCmdBeginRenderingKHR");
    const PFN_vkCmdEndRenderingKHR end =
        (PFN_vkCmdEndRenderingKHR)vkGetDeviceProcAddr(rig.device, "vkCmdEndRenderingKHR");
    const VkRenderingAttachmentInfo color = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = view,
                                             .imageLayout = VK_IMAGE_LAYOUT_GENERAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                             .clearValue = {.color = {.float32 = {0, 1, 0, 1}}}};
    const VkRenderingInfo clear = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                   .renderArea = {.extent = {SIZE, SIZE}},
                                   .layerCount = 1,
                                   .colorAttachmentCount = 1,
                                   .pColorAttachments = &color};
    const VkClearColorValue blue = {.float32 = {0, 0, 1, 1}};
    for (int i = 0; i < 3; i++) {
        settle(&rig, images[i % 2], VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED);
        if (i % 2 == 0) {
            begin(rig.commands, &clear);
            end(rig.commands);
        } else {
            vkCmdClearColorImage(rig.commands, images[1], VK_IMAGE_LAYOUT_GENERAL, &blue, 1,
                                 &view_info.subresourceRange);
        }
    }
    settle_color(&rig, images[0]);
    const struct rig_buffer texels = rig_buffer(&rig, TEXELS * 4, NULL);
    const VkBufferImageCopy read = region_of(VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1, extent);
    to_buffer(&rig, images[0], texels.buffer, &read);
    rig_run(&rig);
    for (int i = 0; i < TEXELS; i++) {
        assert_int_equal(((const uint32_t *)texels.bytes)[i], 0xff00ff00u);
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(buffers_are_copied_filled_and_updated),
    cmocka_unit_test(clears_have_the_bits_of_the_format),
    cmocka_unit_test(regions_keep_to_levels_and_layers),
    cmocka_unit_test(layers_become_slices),
    cmocka_unit_test(blocks_stay_as_they_are),
    cmocka_unit_test(depth_and_stencil_are_copied_apart),
    cmocka_unit_test(a_blit_scales_and_mirrors),
    cmocka_unit_test(samples_are_averaged),
    cmocka_unit_test(linear_images_are_written_by_the_program),
    cmocka_unit_test(images_may_share_memory),
};

const struct unit_tests test_vulkan_copy = UNIT_TESTS(tests, NULL, NULL);
