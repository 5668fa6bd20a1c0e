// SPDX-License-Identifier: MIT
#include "vulkan_hostile.h"

#include <string.h>

#include "kept_vert.h"
#include "quad_vert.h"
#include "reach_comp.h"
#include "shade_frag.h"
#include "stand_vert.h"

enum { GUARD = 256 }; // bytes on both sides of an object

// Numbers --------------------------------------------------------------------------------------------

uint32_t hostile_below(struct hostile *h, uint32_t end)
{
    h->random ^= h->random << 13;
    h->random ^= h->random >> 7;
    h->random ^= h->random << 17;
    const uint32_t number = (uint32_t)(h->random >> 24) % end;
    h->trace = (h->trace ^ number ^ (uint64_t)end << 32) * UINT64_C(0x100000001b3); // FNV's prime
    return number;
}

uint32_t hostile_any(struct hostile *h)
{
    static const uint32_t ends[] = {0x100, 0x10000, 0x80000000, 0};
    if (hostile_below(h, 3)) {
        return hostile_below(h, 20);
    }
    const uint32_t end = ends[hostile_below(h, 4)];
    return end + hostile_below(h, 9) - 4;
}

void hostile_fill(struct hostile *h, uint32_t *numbers, int count)
{
    for (int i = 0; i < count; i++) {
        numbers[i] = hostile_any(h);
    }
}

VkRect2D hostile_rectangle(struct hostile *h)
{
    uint32_t n[4];
    hostile_fill(h, n, 4);
    return (VkRect2D){{(int32_t)n[0], (int32_t)n[1]}, {n[2], n[3]}};
}

VkDeviceSize hostile_size(struct hostile *h)
{
    const uint32_t kind = hostile_below(h, 8);
    return kind == 0   ? VK_WHOLE_SIZE - hostile_below(h, 40)
           : kind == 1 ? (VkDeviceSize)hostile_any(h) << 32
           : kind == 2 ? hostile_any(h)
                       : (VkDeviceSize)4 * hostile_below(h, 80);
}

// Objects --------------------------------------------------------------------------------------------

// Allocate memory with bytes of 0x5a on both sides. Return where the object begins, which has `size` bytes.
static VkDeviceMemory guard(struct hostile *h, VkDeviceSize size)
{
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = size + 2 * GUARD};
    VkDeviceMemory memory;
    void *bytes;
    CHECK(vkAllocateMemory(h->rig.device, &info, NULL, &memory));
    RIG_KEEP(&h->rig, DEVICE_MEMORY, memory);
    CHECK(vkMapMemory(h->rig.device, memory, 0, VK_WHOLE_SIZE, 0, &bytes));
    memset(bytes, 0x5a, GUARD);
    memset((unsigned char *)bytes + GUARD + size, 0x5a, GUARD);
    h->guarded[h->guarded_count] = bytes;
    h->sizes[h->guarded_count++] = (size_t)size;
    return memory;
}

void hostile_check(const struct hostile *h)
{
    for (int i = 0; i < h->guarded_count; i++) {
        for (size_t b = 0; b < GUARD; b++) {
            assert_int_equal(h->guarded[i][b], 0x5a);
            assert_int_equal(h->guarded[i][GUARD + h->sizes[i] + b], 0x5a);
        }
    }
}

static void make_buffers(struct hostile *h)
{
    static const VkDeviceSize sizes[HOSTILE_BUFFERS] = {4, 64, 256, 1000, 4096, 256};
    for (int i = 0; i < HOSTILE_BUFFERS; i++) {
        const VkBufferCreateInfo info = {
            .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = sizes[i], .usage = 0x1fff};
        CHECK(vkCreateBuffer(h->rig.device, &info, NULL, &h->buffers[i]));
        RIG_KEEP(&h->rig, BUFFER, h->buffers[i]);
        if (i + 1 < HOSTILE_BUFFERS) {
            CHECK(vkBindBufferMemory(h->rig.device, h->buffers[i], guard(h, sizes[i]), GUARD));
        }
    }
    const VkBufferViewCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                         .buffer = h->buffers[2],
                                         .format = VK_FORMAT_R32_UINT,
                                         .range = VK_WHOLE_SIZE};
    CHECK(vkCreateBufferView(h->rig.device, &info, NULL, &h->texels));
    RIG_KEEP(&h->rig, BUFFER_VIEW, h->texels);
}

// The images.
static const struct {
    VkFormat format;
    VkImageType type;
    VkExtent3D extent;
    uint32_t levels, layers, samples;
} kinds[HOSTILE_IMAGES] = {
    {VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_TYPE_2D, {16, 16, 1}, 1, 1, 1},
    {VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_TYPE_2D, {16, 9, 1}, 3, 6, 1},
    {VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_TYPE_2D, {16, 16, 1}, 1, 1, 4},
    {VK_FORMAT_D32_SFLOAT_S8_UINT, VK_IMAGE_TYPE_2D, {16, 16, 1}, 1, 2, 1},
    {VK_FORMAT_D32_SFLOAT_S8_UINT, VK_IMAGE_TYPE_2D, {16, 16, 1}, 1, 1, 4},
    {VK_FORMAT_D16_UNORM, VK_IMAGE_TYPE_2D, {5, 7, 1}, 2, 1, 1},
    {VK_FORMAT_R32_UINT, VK_IMAGE_TYPE_3D, {5, 6, 7}, 2, 1, 1},
    {VK_FORMAT_R16_SFLOAT, VK_IMAGE_TYPE_1D, {33, 1, 1}, 2, 3, 1},
    {VK_FORMAT_BC1_RGBA_UNORM_BLOCK, VK_IMAGE_TYPE_2D, {17, 10, 1}, 2, 2, 1},
    {VK_FORMAT_BC7_UNORM_BLOCK, VK_IMAGE_TYPE_2D, {8, 8, 1}, 1, 1, 1},
    {VK_FORMAT_R32G32B32A32_UINT, VK_IMAGE_TYPE_2D, {4, 4, 1}, 1, 1, 1},
    {VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_TYPE_2D, {16, 16, 1}, 1, 1, 1},
};

static void make_image(struct hostile *h, int i)
{
    const bool is_depth =
        kinds[i].format == VK_FORMAT_D32_SFLOAT_S8_UINT || kinds[i].format == VK_FORMAT_D16_UNORM;
    const bool is_compressed = kinds[i].format >= VK_FORMAT_BC1_RGB_UNORM_BLOCK;
    const VkImageUsageFlags target =
        is_depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = kinds[i].type,
        .format = kinds[i].format,
        .extent = kinds[i].extent,
        .mipLevels = kinds[i].levels,
        .arrayLayers = kinds[i].layers,
        .samples = (VkSampleCountFlagBits)kinds[i].samples,
        .usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                 VK_IMAGE_USAGE_SAMPLED_BIT | (is_compressed ? 0 : target) |
                 (is_depth || is_compressed || kinds[i].samples > 1 ? 0 : VK_IMAGE_USAGE_STORAGE_BIT)};
    VkMemoryRequirements needs;
    CHECK(vkCreateImage(h->rig.device, &info, NULL, &h->images[i]));
    vkGetImageMemoryRequirements(h->rig.device, h->images[i], &needs);
    if (i + 1 < HOSTILE_IMAGES) {
        CHECK(vkBindImageMemory(h->rig.device, h->images[i], guard(h, needs.size), GUARD));
    }
    RIG_KEEP(&h->rig, IMAGE, h->images[i]);
    h->aspects[i] =
        is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

// Views of any part of any image, in any format.
static void make_views(struct hostile *h)
{
    for (int i = 0; i < HOSTILE_VIEWS; i++) {
        const uint32_t image = i < HOSTILE_IMAGES ? (uint32_t)i : hostile_below(h, HOSTILE_IMAGES);
        const bool is_wild = i >= HOSTILE_IMAGES;
        VkImageViewCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                      .image = h->images[image],
                                      .viewType = (VkImageViewType)kinds[image].type,
                                      .format = kinds[image].format,
                                      .subresourceRange = {h->aspects[image], 0, 1, 0, 1}};
        info.components.r = (VkComponentSwizzle)hostile_below(h, 7);
        if (is_wild) {
            info.viewType = (VkImageViewType)hostile_below(h, 7);
            info.subresourceRange.baseMipLevel = hostile_below(h, 4);
            info.subresourceRange.levelCount = hostile_any(h);
            info.subresourceRange.baseArrayLayer = hostile_below(h, 4);
            info.subresourceRange.layerCount = hostile_any(h);
        }
        if (is_wild && hostile_below(h, 3) == 0) {
            info.format = kinds[hostile_below(h, HOSTILE_IMAGES)].format;
        }
        CHECK(vkCreateImageView(h->rig.device, &info, NULL, &h->views[i]));
        RIG_KEEP(&h->rig, IMAGE_VIEW, h->views[i]);
    }
}

static const VkDescriptorSetLayoutBinding bindings[] = {
    {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC, 3, VK_SHADER_STAGE_ALL, NULL},
    {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_ALL, NULL},
    {2, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 2, VK_SHADER_STAGE_ALL, NULL},
    {3, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2, VK_SHADER_STAGE_ALL, NULL},
    {4, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, 1, VK_SHADER_STAGE_ALL, NULL},
};

enum { BINDINGS = sizeof bindings / sizeof *bindings };

void hostile_write_set(struct hostile *h)
{
    const VkDescriptorSetLayoutBinding *const binding = &bindings[hostile_below(h, BINDINGS)];
    VkDescriptorBufferInfo buffers[3];
    VkDescriptorImageInfo images[3];
    VkBufferView views[3];
    for (int i = 0; i < 3; i++) {
        const VkBuffer buffer = h->buffers[hostile_below(h, HOSTILE_BUFFERS)];
        const VkDeviceSize offset = hostile_size(h), size = hostile_size(h);
        buffers[i] = (VkDescriptorBufferInfo){buffer, offset, size};
        images[i] = (VkDescriptorImageInfo){h->sampler, h->views[hostile_below(h, HOSTILE_VIEWS)],
                                            VK_IMAGE_LAYOUT_GENERAL};
        views[i] = h->texels;
    }
    VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                  .dstBinding = binding->binding,
                                  .pBufferInfo = buffers,
                                  .pImageInfo = images,
                                  .pTexelBufferView = views};
    write.dstSet = h->sets[hostile_below(h, HOSTILE_SETS)];
    write.dstArrayElement = hostile_below(h, 6) ? hostile_below(h, binding->descriptorCount) : hostile_any(h);
    write.descriptorCount = 1 + hostile_below(h, 3);
    write.descriptorType =
        hostile_below(h, 9) ? binding->descriptorType : (VkDescriptorType)hostile_below(h, 11);
    VkCopyDescriptorSet copy = {.sType = VK_STRUCTURE_TYPE_COPY_DESCRIPTOR_SET};
    copy.srcSet = h->sets[hostile_below(h, HOSTILE_SETS)];
    copy.srcBinding = hostile_below(h, 6);
    copy.srcArrayElement = hostile_below(h, 4);
    copy.dstSet = h->sets[hostile_below(h, HOSTILE_SETS)];
    copy.dstBinding = hostile_below(h, 6);
    copy.dstArrayElement = hostile_below(h, 4);
    copy.descriptorCount = hostile_any(h);
    vkUpdateDescriptorSets(h->rig.device, 1, &write, hostile_below(h, 4) == 0, &copy);
}

static void make_sets(struct hostile *h)
{
    const VkSamplerCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                      .magFilter = VK_FILTER_LINEAR,
                                      .mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                      .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER,
                                      .maxLod = 9};
    CHECK(vkCreateSampler(h->rig.device, &info, NULL, &h->sampler));
    RIG_KEEP(&h->rig, SAMPLER, h->sampler);
    const VkDescriptorSetLayout layout = rig_set_layout(&h->rig, bindings, BINDINGS);
    h->layout = rig_layout(&h->rig, &layout, 1, 128);
    for (int i = 0; i < HOSTILE_SETS; i++) {
        h->sets[i] = rig_set(&h->rig, layout);
    }
    for (int i = 0; i < 8 * HOSTILE_SETS; i++) {
        hostile_write_set(h);
    }
    h->compute = rig_compute(&h->rig, h->layout, rig_shader(&h->rig, reach_comp, sizeof reach_comp));
}

// Passes of two subpasses, of any two attachments, in framebuffers of any two views.
static void make_pass(struct hostile *h, int i)
{
    VkAttachmentDescription attachments[2];
    VkImageView views[2];
    for (int a = 0; a < 2; a++) {
        const uint32_t image = hostile_below(h, HOSTILE_IMAGES);
        attachments[a] = (VkAttachmentDescription){.format = kinds[image].format,
                                                   .samples = (VkSampleCountFlagBits)kinds[image].samples,
                                                   .finalLayout = VK_IMAGE_LAYOUT_GENERAL};
        attachments[a].loadOp = (VkAttachmentLoadOp)hostile_below(h, 3);
        attachments[a].storeOp = (VkAttachmentStoreOp)hostile_below(h, 2);
        attachments[a].stencilLoadOp = (VkAttachmentLoadOp)hostile_below(h, 3);
        views[a] = h->views[hostile_below(h, 3) ? image : hostile_below(h, HOSTILE_VIEWS)];
    }
    const VkAttachmentReference one = {hostile_below(h, 2), VK_IMAGE_LAYOUT_GENERAL};
    const VkAttachmentReference other = {hostile_below(h, 3) ? 1 - one.attachment : VK_ATTACHMENT_UNUSED,
                                         VK_IMAGE_LAYOUT_GENERAL};
    const bool resolves = hostile_below(h, 2);
    const uint32_t input_count = hostile_below(h, 2);
    const VkSubpassDescription subpasses[2] = {
        {.colorAttachmentCount = 1, .pColorAttachments = &one, .pDepthStencilAttachment = &other},
        {.colorAttachmentCount = 1,
         .pColorAttachments = &other,
         .pResolveAttachments = resolves ? &one : NULL,
         .inputAttachmentCount = input_count,
         .pInputAttachments = &one}};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .attachmentCount = 2,
                                         .pAttachments = attachments,
                                         .subpassCount = 2,
                                         .pSubpasses = subpasses};
    CHECK(vkCreateRenderPass(h->rig.device, &info, NULL, &h->passes[i]));
    RIG_KEEP(&h->rig, RENDER_PASS, h->passes[i]);
    VkFramebufferCreateInfo frame = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                     .renderPass = h->passes[i],
                                     .attachmentCount = 2,
                                     .pAttachments = views};
    frame.width = hostile_below(h, 4) ? 16 : hostile_any(h);
    frame.height = hostile_below(h, 4) ? 16 : hostile_any(h);
    frame.layers = hostile_below(h, 4) ? 1 : hostile_any(h);
    CHECK(vkCreateFramebuffer(h->rig.device, &frame, NULL, &h->framebuffers[i]));
    RIG_KEEP(&h->rig, FRAMEBUFFER, h->framebuffers[i]);
}

static void make_pipelines(struct hostile *h)
{
    h->picture = (struct picture){.rig = &h->rig, .sample_count = VK_SAMPLE_COUNT_1_BIT};
    const VkShaderModule quad = rig_shader(&h->rig, quad_vert, sizeof quad_vert);
    const VkShaderModule stand = rig_shader(&h->rig, stand_vert, sizeof stand_vert);
    const VkShaderModule kept = rig_shader(&h->rig, kept_vert, sizeof kept_vert);
    const VkShaderModule shade = rig_shader(&h->rig, shade_frag, sizeof shade_frag);
    for (int i = 0; i < HOSTILE_GRAPHICS; i++) {
        struct picture_state state;
        picture_state(&state, &h->picture, i % 3 == 0 ? quad : i % 3 == 1 ? stand : kept, shade, h->layout);
        state.buffers[0].binding = hostile_below(h, 16);
        state.buffers[0].stride = hostile_any(h) % 2049;
        state.buffers[0].inputRate = (VkVertexInputRate)hostile_below(h, 2);
        for (uint32_t a = 0; a < 2; a++) {
            state.attributes[a] = (VkVertexInputAttributeDescription){
                a, state.buffers[0].binding, VK_FORMAT_R32G32B32A32_SFLOAT, hostile_any(h) % 2048};
        }
        state.input.vertexBindingDescriptionCount = 1;
        state.input.vertexAttributeDescriptionCount = 2;
        state.assembly.topology = (VkPrimitiveTopology)hostile_below(h, 6);
        state.samples.rasterizationSamples =
            hostile_below(h, 2) ? VK_SAMPLE_COUNT_1_BIT : VK_SAMPLE_COUNT_4_BIT;
        state.depth.depthTestEnable = hostile_below(h, 2);
        state.depth.depthWriteEnable = hostile_below(h, 2);
        state.depth.stencilTestEnable = hostile_below(h, 2);
        state.blend[0].blendEnable = hostile_below(h, 2);
        // One that is refused is not drawn with.
        const VkRenderPass pass = h->passes[hostile_below(h, HOSTILE_PASSES)];
        if (picture_try_pipeline(&h->picture, &state, pass, hostile_below(h, 2), &h->graphics[i]) ==
            VK_SUCCESS) {
            RIG_KEEP(&h->rig, PIPELINE, h->graphics[i]);
        } else {
            h->graphics[i] = VK_NULL_HANDLE;
        }
    }
}

void hostile_open(struct hostile *h, uint64_t seed)
{
    static const VkQueryType types[HOSTILE_POOLS] = {VK_QUERY_TYPE_OCCLUSION, VK_QUERY_TYPE_TIMESTAMP,
                                                     VK_QUERY_TYPE_TRANSFORM_FEEDBACK_STREAM_EXT};
    *h = (struct hostile){.random = (seed + 1) * UINT64_C(0x9e3779b97f4a7c15)};
    rig_open(&h->rig);
    make_buffers(h);
    for (int i = 0; i < HOSTILE_IMAGES; i++) {
        make_image(h, i);
    }
    make_views(h);
    make_sets(h);
    for (int i = 0; i < HOSTILE_PASSES; i++) {
        make_pass(h, i);
    }
    make_pipelines(h);
    for (int i = 0; i < HOSTILE_POOLS; i++) {
        const VkQueryPoolCreateInfo info = {
            .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO, .queryType = types[i], .queryCount = 4};
        CHECK(vkCreateQueryPool(h->rig.device, &info, NULL, &h->pools[i]));
        RIG_KEEP(&h->rig, QUERY_POOL, h->pools[i]);
    }
}
