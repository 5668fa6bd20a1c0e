// SPDX-License-Identifier: MIT
// Dispatches: what they read and write, from which workgroup on, and what stays whole at the ends of buffers.
#include <string.h>

#include "scale_comp.h"
#include "texels_comp.h"
#include "vulkan_rig.h"

enum { COMPUTE = VK_SHADER_STAGE_COMPUTE_BIT };

// Create the pipeline of scale.comp with specialization constants, or without.
static VkPipeline make_scale(struct rig *rig, VkPipelineLayout layout, const VkSpecializationInfo *constants)
{
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = rig_shader(rig, scale_comp, sizeof scale_comp),
                  .pName = "main",
                  .pSpecializationInfo = constants},
        .layout = layout};
    VkPipeline pipeline;
    CHECK(vkCreateComputePipelines(rig->device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    RIG_KEEP(rig, PIPELINE, pipeline);
    return pipeline;
}

static void offsets_and_constants_reach_the_shader(void **state)
{
    (void)state;
    static const VkDescriptorSetLayoutBinding bindings[] = {
        {3, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1, COMPUTE, NULL},
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC, 1, COMPUTE, NULL},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, COMPUTE, NULL}};
    static const VkSpecializationMapEntry entries[] = {{0, 4, 4}, {1, 0, 4}, {7, 8, 4}};
    static const uint32_t values[] = {4, 5, VK_TRUE}; // invocations of a workgroup, FACTOR, COUNTS
    const VkSpecializationInfo constants = {3, entries, sizeof values, values};
    uint32_t given[256], adds[256];
    struct rig rig;
    rig_open(&rig);
    for (uint32_t i = 0; i < 256; i++) {
        given[i] = i;
        adds[i] = 100 * i;
    }
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, bindings, 3);
    VkPipelineLayout layout = rig_layout(&rig, &set_layout, 1, 0);
    VkPipeline pipeline = make_scale(&rig, layout, &constants);
    const struct rig_buffer source = rig_buffer(&rig, sizeof given, given);
    const struct rig_buffer target = rig_buffer(&rig, 64 * sizeof(uint32_t), NULL);
    const struct rig_buffer add = rig_buffer(&rig, sizeof adds, adds);
    VkDescriptorSet set = rig_set(&rig, set_layout);
    // 6 words of the source may be read, and 10 of the target written, though 12 invocations reach further.
    rig_bind_buffer(&rig, set, 0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC, source.buffer, 256, 24);
    rig_bind_buffer(&rig, set, 1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, target.buffer, 0, 40);
    rig_bind_buffer(&rig, set, 3, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, add.buffer, 0, 4);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(rig.commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 2,
                            (const uint32_t[]){256, 512});
    vkCmdDispatch(rig.commands, 3, 1, 1);
    rig_run(&rig);
    const uint32_t *const made = target.bytes;
    for (uint32_t i = 0; i < 12; i++) {
        const uint32_t read = i < 6 ? 64 + 64 + i : 0; // both offsets are 64 words
        assert_int_equal(made[i], i < 10 ? read * 5 + 12800 + 6000 : 0);
    }
    rig_close(&rig);
}

static void dispatches_begin_where_they_are_told(void **state)
{
    (void)state;
    static const VkDescriptorSetLayoutBinding bindings[] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, COMPUTE, NULL},
        {1, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 1, COMPUTE, NULL},
        {2, VK_DESCRIPTOR_TYPE_STORAGE_TEXEL_BUFFER, 1, COMPUTE, NULL}};
    static const struct {
        uint8_t texels[256];
        uint32_t count[2];
        VkDispatchIndirectCommand dispatch;
    } words = {{1, 2, 3, 4}, {0, 0}, {2, 1, 1}};
    struct rig rig;
    rig_open(&rig);
    const struct rig_image image = rig_image(&rig, VK_FORMAT_R32_UINT, 8, 4, VK_SAMPLE_COUNT_1_BIT,
                                             VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    const uint32_t zeros[32] = {0};
    rig_write(&rig, &image, zeros, 4, VK_IMAGE_LAYOUT_GENERAL);
    const struct rig_buffer buffer = rig_buffer(&rig, sizeof words, &words);
    VkBufferView views[2];
    VkBufferViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                   .buffer = buffer.buffer,
                                   .format = VK_FORMAT_R8_UINT,
                                   .range = 4};
    CHECK(vkCreateBufferView(rig.device, &view, NULL, &views[0]));
    view.format = VK_FORMAT_R32_UINT;
    view.offset = 256;
    view.range = 8;
    CHECK(vkCreateBufferView(rig.device, &view, NULL, &views[1]));
    RIG_KEEP(&rig, BUFFER_VIEW, views[0]);
    RIG_KEEP(&rig, BUFFER_VIEW, views[1]);
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, bindings, 3);
    VkPipelineLayout layout = rig_layout(&rig, &set_layout, 1, 0);
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .flags = VK_PIPELINE_CREATE_DISPATCH_BASE,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = rig_shader(&rig, texels_comp, sizeof texels_comp),
                  .pName = "main"},
        .layout = layout};
    VkPipeline pipeline;
    CHECK(vkCreateComputePipelines(rig.device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    RIG_KEEP(&rig, PIPELINE, pipeline);
    VkDescriptorSet set = rig_set(&rig, set_layout);
    rig_bind_image(&rig, set, 0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, image.view, VK_NULL_HANDLE,
                   VK_IMAGE_LAYOUT_GENERAL);
    for (uint32_t i = 0; i < 2; i++) {
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = set,
                                            .dstBinding = 1 + i,
                                            .descriptorCount = 1,
                                            .descriptorType = bindings[1 + i].descriptorType,
                                            .pTexelBufferView = &views[i]};
        vkUpdateDescriptorSets(rig.device, 1, &write, 0, NULL);
    }
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(rig.commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, NULL);
    vkCmdDispatchIndirect(rig.commands, buffer.buffer, offsetof(__typeof__(words), dispatch));
    vkCmdDispatchBase(rig.commands, 2, 1, 0, 2, 9, 1); // 8 of the 9 rows lie outside of the image
    rig_barrier(&rig, &image, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    const uint32_t *const texels = rig_read(&rig, &image, 4).bytes;
    rig_run(&rig);
    for (uint32_t y = 0; y < 4; y++) {
        for (uint32_t x = 0; x < 8; x++) {
            const uint32_t texel = 1 + x % 2 + 2 * (y % 2) + 10 * (x / 2) + 100 * (y / 2) + 2000;
            const bool is_written = y < 2 ? x < 4 : x >= 4;
            assert_int_equal(texels[8 * y + x], is_written ? texel : 0);
        }
    }
    const uint32_t *const count = (const uint32_t *)((const uint8_t *)buffer.bytes + 256);
    assert_int_equal(count[0], 0);
    assert_int_equal(count[1], 4 * (2 + 18));
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(offsets_and_constants_reach_the_shader),
    cmocka_unit_test(dispatches_begin_where_they_are_told),
};

const struct unit_tests test_vulkan_compute = UNIT_TESTS(tests, NULL, NULL);
