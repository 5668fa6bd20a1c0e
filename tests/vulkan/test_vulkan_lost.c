// SPDX-License-Identifier: MIT
// What goes wrong: a shader that never ends, and allocations that fail.
#include <stdlib.h>
#include <string.h>

#include "endless_work_comp.h"
#include "vulkan_rig.h"

static void a_device_is_lost_to_a_shader_that_never_ends(void **state)
{
    (void)state;
    static const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1,
                                                         VK_SHADER_STAGE_COMPUTE_BIT, NULL};
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer takes what was lost for pending
    }
    struct rig rig;
    assert_int_equal(setenv("RHW_VULKAN_TIMEOUT", "0.05", 1), 0);
    rig_open(&rig);
    assert_int_equal(unsetenv("RHW_VULKAN_TIMEOUT"), 0);
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, &binding, 1);
    VkPipelineLayout layout = rig_layout(&rig, &set_layout, 1, 0);
    VkDescriptorSet set = rig_set(&rig, set_layout);
    const struct rig_buffer words = rig_buffer(&rig, 80, NULL);
    rig_bind_buffer(&rig, set, 0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, words.buffer, 0, VK_WHOLE_SIZE);
    VkPipeline pipeline =
        rig_compute(&rig, layout, rig_shader(&rig, endless_work_comp, sizeof endless_work_comp));
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(rig.commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 1, &set, 0, NULL);
    vkCmdDispatch(rig.commands, 1, 1, 1);
    CHECK(vkEndCommandBuffer(rig.commands));
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &rig.commands};
    CHECK(vkQueueSubmit(rig.queue, 1, &submit, VK_NULL_HANDLE));
    assert_int_equal(vkQueueWaitIdle(rig.queue), VK_ERROR_DEVICE_LOST);
    assert_int_equal(vkQueueSubmit(rig.queue, 0, NULL, VK_NULL_HANDLE), VK_ERROR_DEVICE_LOST);
    rig.is_lost = true;
    rig_close(&rig);
}

// Allocations that may still succeed, and those that are not freed.
struct budget {
    int left, used;
};

static void *VKAPI_CALL take(void *user, size_t size, size_t alignment, VkSystemAllocationScope scope)
{
    (void)scope;
    struct budget *const budget = user;
    void *memory = NULL;
    if (budget->left == 0 || posix_memalign(&memory, alignment < 16 ? 16 : alignment, size) != 0) {
        return NULL;
    }
    budget->left--;
    budget->used++;
    return memory;
}

static void *VKAPI_CALL take_more(void *user, void *memory, size_t size, size_t alignment,
                                  VkSystemAllocationScope scope)
{
    // The size of what there is is not known; the loader and the driver never ask.
    (void)memory;
    return memory ? NULL : take(user, size, alignment, scope);
}

static void VKAPI_CALL give_back(void *user, void *memory)
{
    struct budget *const budget = user;
    budget->used -= memory != NULL;
    free(memory);
}

// Make a few things of a device until one cannot be had. Return whether all could.
static bool make_things(VkDevice device, const VkAllocationCallbacks *callbacks)
{
    const VkBufferCreateInfo buffer_info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 64, .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    const VkImageCreateInfo image_info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                          .imageType = VK_IMAGE_TYPE_2D,
                                          .format = VK_FORMAT_R8G8B8A8_UNORM,
                                          .extent = {4, 4, 1},
                                          .mipLevels = 1,
                                          .arrayLayers = 1,
                                          .samples = VK_SAMPLE_COUNT_1_BIT,
                                          .usage = VK_IMAGE_USAGE_SAMPLED_BIT};
    const VkSamplerCreateInfo sampler_info = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO};
    const VkFenceCreateInfo fence_info = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    const VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    VkBuffer buffer = VK_NULL_HANDLE;
    VkImage image = VK_NULL_HANDLE;
    VkSampler sampler = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    const VkResult results[] = {
        vkCreateBuffer(device, &buffer_info, callbacks, &buffer),
        vkCreateImage(device, &image_info, callbacks, &image),
        vkCreateSampler(device, &sampler_info, callbacks, &sampler),
        vkCreateFence(device, &fence_info, callbacks, &fence),
        vkCreateCommandPool(device, &pool_info, callbacks, &pool),
    };
    bool all = true;
    for (size_t i = 0; i < sizeof results / sizeof *results; i++) {
        assert_true(results[i] == VK_SUCCESS || results[i] == VK_ERROR_OUT_OF_HOST_MEMORY);
        all = all && results[i] == VK_SUCCESS;
    }
    if (pool) {
        const VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  .commandPool = pool,
                                                  .commandBufferCount = 2};
        const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        VkCommandBuffer commands[2];
        if (vkAllocateCommandBuffers(device, &info, commands) == VK_SUCCESS) {
            CHECK(vkBeginCommandBuffer(commands[0], &begin));
            vkCmdPushConstants(commands[0], VK_NULL_HANDLE, VK_SHADER_STAGE_ALL, 0, 4, &begin.flags);
            all = vkEndCommandBuffer(commands[0]) == VK_SUCCESS && all;
        } else {
            all = false;
        }
    }
    vkDestroyBuffer(device, buffer, callbacks);
    vkDestroyImage(device, image, callbacks);
    vkDestroySampler(device, sampler, callbacks);
    vkDestroyFence(device, fence, callbacks);
    vkDestroyCommandPool(device, pool, callbacks);
    return all;
}

static void allocations_that_fail_are_told(void **state)
{
    (void)state;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer does not look whether it has memory
    }
    struct rig rig;
    rig_open(&rig);
    int failures = 0;
    for (bool all = false; !all; failures++) {
        struct budget budget = {.left = failures};
        const VkAllocationCallbacks callbacks = {
            .pUserData = &budget, .pfnAllocation = take, .pfnReallocation = take_more, .pfnFree = give_back};
        all = make_things(rig.device, &callbacks);
        assert_int_equal(budget.used, 0);
    }
    assert_true(failures > 5);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_device_is_lost_to_a_shader_that_never_ends),
    cmocka_unit_test(allocations_that_fail_are_told),
};

const struct unit_tests test_vulkan_lost = UNIT_TESTS(tests, NULL, NULL);
