// SPDX-License-Identifier: MIT
// Views in formats of their own, and samplers, as shaders see them.
#include <stdlib.h>
#include <string.h>

#include "quad_vert.h"
#include "viewed_frag.h"
#include "viewed_uint_frag.h"
#include "vulkan_picture.h"

enum { SIDE = 4 }; // texels of an image

// A picture that samples a view at its middle.
struct viewing {
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    VkDescriptorSet set;
    VkPipeline pipeline;
    float at; // where the view is sampled, along both axes; not within 0..1 it is the border
    VkBorderColor border;
};

static void begin_viewing(struct viewing *v, const uint32_t *fragment, size_t size)
{
    static const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                                         VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    rig_open(&v->rig);
    picture_init(&v->picture, &v->rig, false, VK_SAMPLE_COUNT_1_BIT);
    VkDescriptorSetLayout layout = rig_set_layout(&v->rig, &binding, 1);
    v->set = rig_set(&v->rig, layout);
    picture_state(&v->state, &v->picture, rig_shader(&v->rig, quad_vert, sizeof quad_vert),
                  rig_shader(&v->rig, fragment, size), rig_layout(&v->rig, &layout, 1, 36));
    v->pipeline = picture_pipeline(&v->picture, &v->state, v->picture.pass, 0);
    v->at = 0.5f;
    v->border = VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE;
}

// Create an image whose views may have other formats.
static VkImage create_image(struct rig *rig, VkFormat format, VkImageCreateFlags flags, VkExtent3D extent,
                            uint32_t levels, uint32_t layers)
{
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .flags = VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT | flags,
                                    .imageType = VK_IMAGE_TYPE_2D,
                                    .format = format,
                                    .extent = extent,
                                    .mipLevels = levels,
                                    .arrayLayers = layers,
                                    .samples = VK_SAMPLE_COUNT_1_BIT,
                                    .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT};
    VkImage image;
    CHECK(vkCreateImage(rig->device, &info, NULL, &image));
    return image;
}

// Return an image of one level in memory of its own.
static VkImage make_image(struct rig *rig, VkFormat format)
{
    VkImage image = create_image(rig, format, 0, (VkExtent3D){SIDE, SIDE, 1}, 1, 1);
    rig_back(rig, image);
    return image;
}

// Bind a view of a level and layer of an image with a sampler of nearest texels.
static void bind_part(struct viewing *v, VkImage image, VkFormat format, uint32_t level, uint32_t layer,
                      float anisotropy)
{
    struct rig *const rig = &v->rig;
    const VkImageViewCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = image,
                                        .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                        .format = format,
                                        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, level, 1, layer, 1}};
    const VkSamplerCreateInfo sampler_info = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                              .magFilter = VK_FILTER_NEAREST,
                                              .minFilter = VK_FILTER_NEAREST,
                                              .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER,
                                              .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER,
                                              .borderColor = v->border,
                                              .anisotropyEnable = anisotropy > 1,
                                              .maxAnisotropy = anisotropy};
    VkImageView view;
    VkSampler sampler;
    CHECK(vkCreateImageView(rig->device, &info, NULL, &view));
    RIG_KEEP(rig, IMAGE_VIEW, view);
    CHECK(vkCreateSampler(rig->device, &sampler_info, NULL, &sampler));
    RIG_KEEP(rig, SAMPLER, sampler);
    rig_bind_image(rig, v->set, 0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, view, sampler,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

static void bind_view(struct viewing *v, VkImage image, VkFormat format, float anisotropy)
{
    bind_part(v, image, format, 0, 0, anisotropy);
}

// Let all levels and layers of an image go from one layout to another.
static void change_layout(struct viewing *v, VkImage image, VkImageLayout from, VkImageLayout to)
{
    const VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS, 0,
                             VK_REMAINING_ARRAY_LAYERS}};
    vkCmdPipelineBarrier(v->rig.commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
}

// Write texels or blocks of one part of an image that is in TRANSFER_DST_OPTIMAL.
static void write_part(struct viewing *v, VkImage image, uint32_t level, uint32_t layer, VkExtent3D extent,
                       const void *bytes, size_t size)
{
    const struct rig_buffer buffer = rig_buffer(&v->rig, size, bytes);
    const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, layer, 1},
                                    .imageExtent = extent};
    vkCmdCopyBufferToImage(v->rig.commands, buffer.buffer, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                           &copy);
}

// Draw what is bound, and return the colour.
static uint32_t draw(struct viewing *v)
{
    struct rig *const rig = &v->rig;
    const float push[9] = {-1, -1, 1, 1, v->at, v->at};
    picture_begin(&v->picture);
    vkCmdBindPipeline(rig->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, v->pipeline);
    vkCmdBindDescriptorSets(rig->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, v->state.layout, 0, 1, &v->set, 0,
                            NULL);
    vkCmdPushConstants(rig->commands, v->state.layout, VK_SHADER_STAGE_ALL, 0, sizeof push, push);
    vkCmdDraw(rig->commands, 6, 1, 0, 0);
    picture_end(&v->picture);
    return picture_texel(&v->picture, 30, 30);
}

// Write all texels or blocks of an image, draw, and return the colour.
static uint32_t draw_view(struct viewing *v, VkImage image, const void *bytes, size_t size)
{
    const VkImageLayout written = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    change_layout(v, image, VK_IMAGE_LAYOUT_UNDEFINED, written);
    write_part(v, image, 0, 0, (VkExtent3D){SIDE, SIDE, 1}, bytes, size);
    change_layout(v, image, written, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    return draw(v);
}

static void blocks_are_read_with_either_sign(void **state)
{
    (void)state;
    static const VkFormat formats[][2] = {{VK_FORMAT_BC4_UNORM_BLOCK, VK_FORMAT_BC4_SNORM_BLOCK},
                                          {VK_FORMAT_BC4_SNORM_BLOCK, VK_FORMAT_BC4_UNORM_BLOCK}};
    static const uint8_t blocks[2][8] = {{64, 64}, {32, 32}};
    static const uint32_t reds[2][2] = {{129, 64}, {64, 32}}; // of 64 / 127 and 32 / 127, or of 255
    for (int i = 0; i < 2; i++) {
        struct viewing v;
        begin_viewing(&v, viewed_frag, sizeof viewed_frag);
        VkImage image = make_image(&v.rig, formats[i][0]);
        bind_view(&v, image, formats[i][1], 1);
        assert_int_equal(draw_view(&v, image, blocks[0], sizeof blocks[0]), reds[i][0] << 24 | 0xff);
        assert_int_equal(draw_view(&v, image, blocks[1], sizeof blocks[1]), reds[i][1] << 24 | 0xff);
        rig_close(&v.rig);
    }
}

// Each level and layer of an image has blocks of one value, 4 + 8 · level + 16 · layer.
static void each_level_and_layer_has_either_sign(void **state)
{
    (void)state;
    enum { LEVELS = 3, LAYERS = 2, WHOLE = 4 * SIDE, BLOCKS = 16 };
    const VkImageLayout written = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    struct viewing v;
    begin_viewing(&v, viewed_frag, sizeof viewed_frag);
    VkImage image =
        create_image(&v.rig, VK_FORMAT_BC4_UNORM_BLOCK, 0, (VkExtent3D){WHOLE, WHOLE, 1}, LEVELS, LAYERS);
    rig_back(&v.rig, image);
    change_layout(&v, image, VK_IMAGE_LAYOUT_UNDEFINED, written);
    for (uint32_t i = 0; i < LEVELS * LAYERS; i++) {
        const uint32_t level = i % LEVELS, layer = i / LEVELS;
        uint8_t blocks[BLOCKS][8] = {{0}};
        for (int b = 0; b < BLOCKS; b++) {
            blocks[b][0] = blocks[b][1] = (uint8_t)(4 + 8 * level + 16 * layer);
        }
        write_part(&v, image, level, layer, (VkExtent3D){WHOLE >> level, WHOLE >> level, 1}, blocks,
                   sizeof blocks >> 2 * level);
    }
    change_layout(&v, image, written, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    for (uint32_t i = 0; i < 2 * LEVELS * LAYERS; i++) {
        const uint32_t level = i / 2 % LEVELS, layer = i / 2 / LEVELS, byte = 4 + 8 * level + 16 * layer;
        const bool has_sign = i % 2;
        bind_part(&v, image, has_sign ? VK_FORMAT_BC4_SNORM_BLOCK : VK_FORMAT_BC4_UNORM_BLOCK, level, layer,
                  1);
        const uint32_t red = has_sign ? (byte * 510 + 127) / 254 : byte; // of byte / 127, or of byte / 255
        assert_int_equal(draw(&v), red << 24 | 0xff);
    }
    rig_close(&v.rig);
}

// Create two images that share all of their memory.
static void create_aliases(struct rig *rig, const VkExtent3D extents[2], VkImage images[2])
{
    VkMemoryRequirements needs[2];
    VkDeviceMemory memory;
    for (int i = 0; i < 2; i++) {
        images[i] = create_image(rig, VK_FORMAT_BC4_UNORM_BLOCK, VK_IMAGE_CREATE_ALIAS_BIT, extents[i], 1, 1);
        RIG_KEEP(rig, IMAGE, images[i]);
        vkGetImageMemoryRequirements(rig->device, images[i], &needs[i]);
    }
    assert_int_equal(needs[0].size, needs[1].size);
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = needs[0].size,
                                       .memoryTypeIndex = (uint32_t)__builtin_ctz(needs[0].memoryTypeBits)};
    CHECK(vkAllocateMemory(rig->device, &info, NULL, &memory));
    RIG_KEEP(rig, DEVICE_MEMORY, memory);
    for (int i = 0; i < 2; i++) {
        CHECK(vkBindImageMemory(rig->device, images[i], memory, 0));
    }
}

// One of two aliases is viewed with the other sign. What is written by the other one is seen.
static void aliases_have_either_sign(void **state)
{
    (void)state;
    static const uint8_t blocks[2][8] = {{64, 64}, {32, 32}};
    static const uint32_t reds[2] = {129, 64}; // of 64 / 127 and 32 / 127
    static const VkExtent3D extents[2] = {{SIDE, SIDE, 1}, {SIDE, SIDE, 1}};
    struct viewing v;
    VkImage images[2];
    begin_viewing(&v, viewed_frag, sizeof viewed_frag);
    create_aliases(&v.rig, extents, images);
    bind_view(&v, images[0], VK_FORMAT_BC4_SNORM_BLOCK, 1);
    assert_int_equal(draw_view(&v, images[0], blocks[0], sizeof blocks[0]), reds[0] << 24 | 0xff);
    const VkImageLayout written = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    change_layout(&v, images[1], VK_IMAGE_LAYOUT_UNDEFINED, written);
    write_part(&v, images[1], 0, 0, extents[1], blocks[1], sizeof blocks[1]);
    change_layout(&v, images[1], written, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    assert_int_equal(draw(&v), reds[1] << 24 | 0xff);
    rig_close(&v.rig);
}

// Images of different shapes take turns in the same memory, each viewed with the other sign. What is written by one is
// nothing to the other.
static void shapes_that_share_memory_have_either_sign(void **state)
{
    (void)state;
    enum { LESS = 64, MORE = 128, BLOCKS = LESS * MORE / 16 };
    static const uint32_t reds[2] = {129, 64}; // of 64 / 127 and 32 / 127
    static const VkExtent3D extents[2] = {{MORE, LESS, 1}, {LESS, MORE, 1}};
    const VkImageLayout written = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    struct viewing v;
    VkImage images[2];
    begin_viewing(&v, viewed_frag, sizeof viewed_frag);
    create_aliases(&v.rig, extents, images);
    for (int turn = 0; turn < 4; turn++) {
        const int i = turn % 2, value = turn / 2;
        uint8_t blocks[BLOCKS][8] = {{0}};
        for (int b = 0; b < BLOCKS; b++) {
            blocks[b][0] = blocks[b][1] = value == 0 ? 64 : 32;
        }
        bind_view(&v, images[i], VK_FORMAT_BC4_SNORM_BLOCK, 1);
        change_layout(&v, images[i], VK_IMAGE_LAYOUT_UNDEFINED, written);
        write_part(&v, images[i], 0, 0, extents[i], blocks, sizeof blocks);
        change_layout(&v, images[i], written, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        assert_int_equal(draw(&v), reds[value] << 24 | 0xff);
    }
    rig_close(&v.rig);
}

// A border has no more channels than the format of the view.
static void borders_lack_what_blocks_lack(void **state)
{
    (void)state;
    static const struct {
        VkFormat format;
        VkBorderColor border;
        uint32_t color;
    } cases[] = {
        {VK_FORMAT_BC4_UNORM_BLOCK, VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE, 0xff0000ff},
        {VK_FORMAT_BC5_UNORM_BLOCK, VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE, 0xffff00ff},
        {VK_FORMAT_EAC_R11G11_UNORM_BLOCK, VK_BORDER_COLOR_FLOAT_OPAQUE_WHITE, 0xffff00ff},
        {VK_FORMAT_ETC2_R8G8B8_UNORM_BLOCK, VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK, 0x000000ff},
        {VK_FORMAT_ETC2_R8G8B8A8_UNORM_BLOCK, VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK, 0x00000000},
    };
    static const uint8_t block[16] = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct viewing v;
        begin_viewing(&v, viewed_frag, sizeof viewed_frag);
        v.at = 1.5f;
        v.border = cases[i].border;
        VkImage image = make_image(&v.rig, cases[i].format);
        bind_view(&v, image, cases[i].format, 1);
        assert_int_equal(draw_view(&v, image, block, sizeof block), cases[i].color);
        rig_close(&v.rig);
    }
}

static void a_view_that_cannot_be_is_empty(void **state)
{
    (void)state;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the misuse
    }
    static uint32_t texels[SIDE * SIDE];
    memset(texels, 0xff, sizeof texels);
    struct viewing v;
    begin_viewing(&v, viewed_frag, sizeof viewed_frag);
    VkImage image = make_image(&v.rig, VK_FORMAT_R8G8B8A8_UNORM);
    bind_view(&v, image, VK_FORMAT_R16G16B16A16_SFLOAT, 1);
    assert_int_equal(draw_view(&v, image, texels, sizeof texels), 0x000000ff);
    rig_close(&v.rig); // the device is not lost
}

static void nearest_integers_have_no_anisotropy(void **state)
{
    (void)state;
    uint8_t texels[SIDE * SIDE];
    memset(texels, 200, sizeof texels);
    struct viewing v;
    begin_viewing(&v, viewed_uint_frag, sizeof viewed_uint_frag);
    VkImage image = make_image(&v.rig, VK_FORMAT_R8_UINT);
    bind_view(&v, image, VK_FORMAT_R8_UINT, 8);
    assert_int_equal(draw_view(&v, image, texels, sizeof texels), 0xc8c8c8ff);
    rig_close(&v.rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(blocks_are_read_with_either_sign),
    cmocka_unit_test(each_level_and_layer_has_either_sign),
    cmocka_unit_test(aliases_have_either_sign),
    cmocka_unit_test(shapes_that_share_memory_have_either_sign),
    cmocka_unit_test(borders_lack_what_blocks_lack),
    cmocka_unit_test(a_view_that_cannot_be_is_empty),
    cmocka_unit_test(nearest_integers_have_no_anisotropy),
};

const struct unit_tests test_vulkan_views = UNIT_TESTS(tests, NULL, NULL);
