// SPDX-License-Identifier: MIT
// A frame as three.js draws one, shadow map first, whose allocations fail in turn: the call that fails says so, nothing
// crashes, and what there is can be destroyed (the address sanitizer tells what is not given back). The frame stands
// without the rig, which takes no failure.
#include <stdlib.h>
#include <string.h>

#include "quad_vert.h"
#include "scale_comp.h"
#include "scarce_malloc.h"
#include "viewed_frag.h"
#include "vulkan_rig.h"

enum { SIDE = 16, TEXELS = SIDE * SIDE, PUSH_SIZE = 36, MOST_THINGS = 64 };

struct frame {
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;
    VkFence fence;
    struct rig_thing things[MOST_THINGS];
    int thing_count;
    VkResult result; // the first failure
};

// Take notice of a result. Return true if the frame goes on.
static bool goes_on(struct frame *frame, VkResult result)
{
    assert_true(result == VK_SUCCESS || result == VK_ERROR_OUT_OF_HOST_MEMORY ||
                result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_INITIALIZATION_FAILED ||
                result == VK_ERROR_DEVICE_LOST);
    frame->result = result;
    return result == VK_SUCCESS;
}

static void keep(struct frame *frame, VkObjectType type, uint64_t handle)
{
    assert_true(frame->thing_count < MOST_THINGS);
    frame->things[frame->thing_count++] = (struct rig_thing){type, handle};
}

// Create something that is destroyed with the frame, if nothing has failed so far.
#define MAKE(TYPE, Name, info, handle)                                                                      \
    if (frame->result == VK_SUCCESS && goes_on(frame, vkCreate##Name(frame->device, info, NULL, handle))) { \
        keep(frame, VK_OBJECT_TYPE_##TYPE, (uint64_t) * (handle));                                          \
    }

static VkDeviceMemory make_memory(struct frame *frame, const VkMemoryRequirements *needs)
{
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = needs->size};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    if (goes_on(frame, vkAllocateMemory(frame->device, &info, NULL, &memory))) {
        keep(frame, VK_OBJECT_TYPE_DEVICE_MEMORY, (uint64_t)memory);
    }
    return memory;
}

// Make a buffer of 4 bytes a texel, and map it.
static VkBuffer make_buffer(struct frame *frame, void **bytes)
{
    const VkBufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                     .size = 4 * TEXELS,
                                     .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                              VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                              VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT};
    VkBuffer buffer = VK_NULL_HANDLE;
    MAKE(BUFFER, Buffer, &info, &buffer)
    if (frame->result == VK_SUCCESS) {
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(frame->device, buffer, &needs);
        VkDeviceMemory memory = make_memory(frame, &needs);
        if (frame->result == VK_SUCCESS &&
            goes_on(frame, vkBindBufferMemory(frame->device, buffer, memory, 0))) {
            goes_on(frame, vkMapMemory(frame->device, memory, 0, VK_WHOLE_SIZE, 0, bytes));
        }
    }
    return buffer;
}

static VkImageView make_image(struct frame *frame, VkFormat format, VkSampleCountFlagBits samples,
                              VkImage *image)
{
    const bool is_depth = format == VK_FORMAT_D32_SFLOAT;
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = format,
        .extent = {SIDE, SIDE, 1},
        .mipLevels = 1,
        .arrayLayers = 1,
        .samples = samples,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                 VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                 (VkImageUsageFlags)(is_depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                              : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)};
    *image = VK_NULL_HANDLE;
    MAKE(IMAGE, Image, &info, image)
    if (frame->result == VK_SUCCESS) {
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(frame->device, *image, &needs);
        VkDeviceMemory memory = make_memory(frame, &needs);
        if (frame->result == VK_SUCCESS) {
            goes_on(frame, vkBindImageMemory(frame->device, *image, memory, 0));
        }
    }
    const VkImageViewCreateInfo view_info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = *image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange = {.aspectMask = is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT,
                             .levelCount = 1,
                             .layerCount = 1}};
    VkImageView view = VK_NULL_HANDLE;
    MAKE(IMAGE_VIEW, ImageView, &view_info, &view)
    return view;
}

static VkShaderModule make_module(struct frame *frame, const uint32_t *words, size_t size)
{
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = words};
    VkShaderModule module = VK_NULL_HANDLE;
    MAKE(SHADER_MODULE, ShaderModule, &info, &module)
    return module;
}

// Set a pass of depth, or one of 4 samples that are resolved, with its framebuffer.
static VkRenderPass make_pass(struct frame *frame, const VkImageView *views, bool is_shadow,
                              VkFramebuffer *framebuffer)
{
    const VkImageLayout color_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    VkAttachmentDescription attachments[3];
    for (int i = 0; i < 3; i++) {
        attachments[i] = (VkAttachmentDescription){
            .format = is_shadow || i == 2 ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_R8G8B8A8_UNORM,
            .samples = is_shadow || i == 1 ? VK_SAMPLE_COUNT_1_BIT : VK_SAMPLE_COUNT_4_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = is_shadow || i == 1 ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE,
            .finalLayout = is_shadow ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                           : i == 1  ? VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL
                           : i == 2  ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                                     : color_layout};
    }
    const VkAttachmentReference color = {0, color_layout}, resolve = {1, color_layout};
    const VkAttachmentReference depth = {is_shadow ? 0 : 2, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkSubpassDescription subpass = {.colorAttachmentCount = !is_shadow,
                                          .pColorAttachments = &color,
                                          .pResolveAttachments = &resolve,
                                          .pDepthStencilAttachment = &depth};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .attachmentCount = is_shadow ? 1 : 3,
                                         .pAttachments = attachments,
                                         .subpassCount = 1,
                                         .pSubpasses = &subpass};
    VkRenderPass pass = VK_NULL_HANDLE;
    MAKE(RENDER_PASS, RenderPass, &info, &pass)
    const VkFramebufferCreateInfo framebuffer_info = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                                      .renderPass = pass,
                                                      .attachmentCount = is_shadow ? 1 : 3,
                                                      .pAttachments = views,
                                                      .width = SIDE,
                                                      .height = SIDE,
                                                      .layers = 1};
    *framebuffer = VK_NULL_HANDLE;
    MAKE(FRAMEBUFFER, Framebuffer, &framebuffer_info, framebuffer)
    return pass;
}

static VkPipeline make_pipeline(struct frame *frame, VkRenderPass pass, VkPipelineLayout layout,
                                VkShaderModule vertex, VkShaderModule fragment)
{
    const VkPipelineShaderStageCreateInfo stages[2] = {
        {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
         .stage = VK_SHADER_STAGE_VERTEX_BIT,
         .module = vertex,
         .pName = "main"},
        {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
         .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
         .module = fragment,
         .pName = "main"}};
    const bool is_shadow = fragment == VK_NULL_HANDLE;
    const VkPipelineVertexInputStateCreateInfo input = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkViewport viewport = {.width = SIDE, .height = SIDE, .maxDepth = 1};
    const VkRect2D all = {.extent = {SIDE, SIDE}};
    const VkPipelineViewportStateCreateInfo viewports = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .pViewports = &viewport,
        .scissorCount = 1,
        .pScissors = &all};
    const VkPipelineRasterizationStateCreateInfo rasterization = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = is_shadow ? VK_SAMPLE_COUNT_1_BIT : VK_SAMPLE_COUNT_4_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = VK_TRUE,
        .depthWriteEnable = VK_TRUE,
        .depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL};
    const VkPipelineColorBlendAttachmentState blend = {.colorWriteMask = 15};
    const VkPipelineColorBlendStateCreateInfo blends = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = !is_shadow,
        .pAttachments = &blend};
    const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .stageCount = is_shadow ? 1 : 2,
                                               .pStages = stages,
                                               .pVertexInputState = &input,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewports,
                                               .pRasterizationState = &rasterization,
                                               .pMultisampleState = &samples,
                                               .pDepthStencilState = &depth,
                                               .pColorBlendState = &blends,
                                               .layout = layout,
                                               .renderPass = pass};
    VkPipeline pipeline = VK_NULL_HANDLE;
    if (frame->result == VK_SUCCESS &&
        goes_on(frame, vkCreateGraphicsPipelines(frame->device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline))) {
        keep(frame, VK_OBJECT_TYPE_PIPELINE, (uint64_t)pipeline);
    }
    return pipeline;
}

// Make a set that has a view with a sampler, and the layout of pipelines with it.
static VkDescriptorSet make_set(struct frame *frame, VkImageView view, VkPipelineLayout *layout)
{
    const VkSamplerCreateInfo sampler_info = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                              .magFilter = VK_FILTER_LINEAR};
    VkSampler sampler = VK_NULL_HANDLE;
    MAKE(SAMPLER, Sampler, &sampler_info, &sampler)
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                                  VK_SHADER_STAGE_FRAGMENT_BIT, NULL};
    const VkDescriptorSetLayoutCreateInfo set_info = {.sType =
                                                          VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                      .bindingCount = 1,
                                                      .pBindings = &binding};
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    MAKE(DESCRIPTOR_SET_LAYOUT, DescriptorSetLayout, &set_info, &set_layout)
    const VkPushConstantRange range = {.stageFlags = VK_SHADER_STAGE_VERTEX_BIT, .size = PUSH_SIZE};
    const VkPipelineLayoutCreateInfo layout_info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                    .setLayoutCount = 1,
                                                    .pSetLayouts = &set_layout,
                                                    .pushConstantRangeCount = 1,
                                                    .pPushConstantRanges = &range};
    *layout = VK_NULL_HANDLE;
    MAKE(PIPELINE_LAYOUT, PipelineLayout, &layout_info, layout)
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    const VkDescriptorPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                                  .maxSets = 1,
                                                  .poolSizeCount = 1,
                                                  .pPoolSizes = &size};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    MAKE(DESCRIPTOR_POOL, DescriptorPool, &pool_info, &pool)
    const VkDescriptorSetAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                              .descriptorPool = pool,
                                              .descriptorSetCount = 1,
                                              .pSetLayouts = &set_layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    if (frame->result == VK_SUCCESS && goes_on(frame, vkAllocateDescriptorSets(frame->device, &info, &set))) {
        const VkDescriptorImageInfo image = {sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
        const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                            .dstSet = set,
                                            .descriptorCount = 1,
                                            .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                            .pImageInfo = &image};
        vkUpdateDescriptorSets(frame->device, 1, &write, 0, NULL);
    }
    return set;
}

static void begin_frame(struct frame *frame)
{
    const VkCommandPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    MAKE(COMMAND_POOL, CommandPool, &pool_info, &frame->pool)
    const VkFenceCreateInfo fence_info = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    MAKE(FENCE, Fence, &fence_info, &frame->fence)
    const VkCommandBufferAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                              .commandPool = frame->pool,
                                              .commandBufferCount = 1};
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    if (frame->result == VK_SUCCESS &&
        goes_on(frame, vkAllocateCommandBuffers(frame->device, &info, &frame->commands))) {
        goes_on(frame, vkBeginCommandBuffer(frame->commands, &begin));
    }
}

// Record a pass that draws one quad.
static void draw_pass(struct frame *frame, VkRenderPass pass, VkFramebuffer framebuffer, VkPipeline pipeline,
                      VkPipelineLayout layout, VkDescriptorSet set)
{
    const VkClearValue clears[3] = {
        {.depthStencil = {1, 0}}, {.depthStencil = {1, 0}}, {.depthStencil = {1, 0}}};
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .renderPass = pass,
                                         .framebuffer = framebuffer,
                                         .renderArea = {.extent = {SIDE, SIDE}},
                                         .clearValueCount = 3,
                                         .pClearValues = clears};
    const float push[PUSH_SIZE / sizeof(float)] = {-1, -1, 1, 1, 0.5f, 0.5f, 0, 1, 0.5f};
    VkCommandBuffer commands = frame->commands;
    vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, NULL);
    vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, push);
    vkCmdDraw(commands, 6, 1, 0, 0);
    vkCmdEndRenderPass(commands);
}

static void submit_frame(struct frame *frame)
{
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &frame->commands};
    if (goes_on(frame, vkEndCommandBuffer(frame->commands)) &&
        goes_on(frame, vkQueueSubmit(frame->queue, 1, &submit, frame->fence))) {
        goes_on(frame, vkWaitForFences(frame->device, 1, &frame->fence, VK_TRUE, UINT64_MAX));
    }
}

// Draw a shadow map, and a picture that samples it. Return the bytes of the picture, if nothing failed.
static const uint8_t *draw_frame(struct frame *frame)
{
    void *bytes = NULL;
    VkImage shadow, many, color, depth;
    VkFramebuffer framebuffers[2];
    VkPipelineLayout layout;
    begin_frame(frame);
    VkBuffer read = make_buffer(frame, &bytes);
    const VkImageView map = make_image(frame, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_1_BIT, &shadow);
    VkImageView views[3];
    views[0] = make_image(frame, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_4_BIT, &many);
    views[1] = make_image(frame, VK_FORMAT_R8G8B8A8_UNORM, VK_SAMPLE_COUNT_1_BIT, &color);
    views[2] = make_image(frame, VK_FORMAT_D32_SFLOAT, VK_SAMPLE_COUNT_4_BIT, &depth);
    VkDescriptorSet set = make_set(frame, map, &layout);
    VkShaderModule vertex = make_module(frame, quad_vert, sizeof quad_vert);
    VkShaderModule fragment = make_module(frame, viewed_frag, sizeof viewed_frag);
    VkRenderPass shadows = make_pass(frame, &map, true, &framebuffers[0]);
    VkRenderPass main = make_pass(frame, views, false, &framebuffers[1]);
    VkPipeline casts = make_pipeline(frame, shadows, layout, vertex, VK_NULL_HANDLE);
    VkPipeline draws = make_pipeline(frame, main, layout, vertex, fragment);
    if (frame->result != VK_SUCCESS) {
        return NULL;
    }
    draw_pass(frame, shadows, framebuffers[0], casts, layout, set);
    draw_pass(frame, main, framebuffers[1], draws, layout, set);
    const VkBufferImageCopy copy = {
        .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
        .imageExtent = {SIDE, SIDE, 1}};
    vkCmdCopyImageToBuffer(frame->commands, color, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, read, 1, &copy);
    submit_frame(frame);
    return frame->result == VK_SUCCESS ? bytes : NULL;
}

static void open_frame(struct frame *frame, VkInstance instance)
{
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
    const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                     .queueCreateInfoCount = 1,
                                     .pQueueCreateInfos = &queue};
    uint32_t count = 1;
    *frame = (struct frame){.result = VK_SUCCESS};
    CHECK(vkEnumeratePhysicalDevices(instance, &count, &frame->physical));
    if (goes_on(frame, vkCreateDevice(frame->physical, &info, NULL, &frame->device))) {
        vkGetDeviceQueue(frame->device, 0, 0, &frame->queue);
    }
}

static void close_frame(struct frame *frame)
{
    if (frame->device) {
        (void)vkDeviceWaitIdle(frame->device);
        while (frame->thing_count > 0) {
            rig_destroy(frame->device, &frame->things[--frame->thing_count]);
        }
        vkDestroyDevice(frame->device, NULL);
    }
}

static VkInstance open_instance(void)
{
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    VkInstance instance;
    assert_int_equal(setenv("RHW_VULKAN_THREADS", "1", 1), 0);
    CHECK(vkCreateInstance(&info, NULL, &instance));
    return instance;
}

// Draw a frame with allocation `fail_at` failing, and return how many there were. -1: none fails.
static int try_frame(VkInstance instance, int fail_at, bool stays, VkResult *result)
{
    struct frame frame;
    scarce_malloc_begin(fail_at, stays);
    open_frame(&frame, instance);
    const uint8_t *const texels = frame.result == VK_SUCCESS ? draw_frame(&frame) : NULL;
    *result = frame.result;
    if (texels) {
        const uint8_t gray[4] = {128, 0, 0, 255}; // the depth of what casts the shadow
        assert_memory_equal(texels, gray, sizeof gray);
    }
    close_frame(&frame);
    return scarce_malloc_end();
}

static void a_frame_survives_any_allocation_that_fails(void **state)
{
    (void)state;
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer and what it allocates are not looked at
    }
    VkInstance instance = open_instance();
    VkResult result;
    const int count = try_frame(instance, -1, false, &result);
    assert_int_equal(result, VK_SUCCESS);
    assert_true(count > 50);
    int failures = 0;
    for (int i = 0; i < 2 * count; i++) {
        try_frame(instance, i / 2, i % 2, &result);
        failures += result != VK_SUCCESS;
    }
    assert_true(failures > count);
    vkDestroyInstance(instance, NULL);
    assert_int_equal(unsetenv("RHW_VULKAN_THREADS"), 0);
}

// The second pipeline of a shader takes few allocations.
static void a_shader_is_translated_once(void **state)
{
    (void)state;
    struct rig rig;
    static const VkDescriptorSetLayoutBinding bindings[] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL},
        {3, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL}};
    rig_open(&rig);
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, bindings, 3);
    VkPipelineLayout layout = rig_layout(&rig, &set_layout, 1, 0);
    int counts[2];
    for (int i = 0; i < 2; i++) {
        scarce_malloc_begin(-1, false);
        rig_compute(&rig, layout, rig_shader(&rig, scale_comp, sizeof scale_comp));
        counts[i] = scarce_malloc_end();
    }
    assert_true(counts[0] > 2 * counts[1] && counts[1] < 10);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_frame_survives_any_allocation_that_fails),
    cmocka_unit_test(a_shader_is_translated_once),
};

const struct unit_tests test_vulkan_scarce = UNIT_TESTS(tests, NULL, NULL);
