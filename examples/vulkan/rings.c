// SPDX-License-Identifier: MIT
// A whole program of Vulkan 1.1 without a window: it draws a chain of rings into an image of 4 samples with a depth
// buffer, resolves it, reads it back and writes a PPM file. It runs on whatever driver the loader gives, and names it.
// usage: rings [FILE.ppm]
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

#include "rings_frag.h"
#include "rings_vert.h"

enum { WIDTH = 640, HEIGHT = 480, RINGS = 16, STEPS = 64, ATTACHMENTS = 3, NO_DRIVER = 77 };

static const VkFormat COLOR = VK_FORMAT_R8G8B8A8_SRGB, DEPTH = VK_FORMAT_D32_SFLOAT;
static const VkShaderStageFlags SCENE_STAGES = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

// What the shaders call Scene.
struct scene {
    float eye[4];
    uint32_t rings, steps;
};

static VkPhysicalDevice physical;
static VkDevice device;
static VkQueue queue;

// End the program where a call fails, and print the call.
#define MUST(call) must(call, #call)
static void must(VkResult result, const char *call)
{
    if (result != VK_SUCCESS) {
        fprintf(stderr, "rings: %d from %.60s\n", (int)result, call);
        exit(EXIT_FAILURE);
    }
}

// Open the first device. Its first queue family with graphics has number *family.
static VkInstance open_device(uint32_t *family)
{
    const VkApplicationInfo application = {VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_1};
    const VkInstanceCreateInfo info = {VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pApplicationInfo = &application};
    VkInstance instance;
    uint32_t count = 1;
    if (vkCreateInstance(&info, NULL, &instance) != VK_SUCCESS ||
        vkEnumeratePhysicalDevices(instance, &count, &physical) < 0 || count == 0) {
        fprintf(stderr, "rings: there is no Vulkan driver\n");
        exit(NO_DRIVER);
    }
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    printf("%s\n", properties.deviceName);

    VkQueueFamilyProperties families[16];
    count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    for (*family = 0; *family + 1 < count && !(families[*family].queueFlags & VK_QUEUE_GRAPHICS_BIT);
         ++*family) {
    }
    const float priority = 1;
    const VkDeviceQueueCreateInfo queues = {
        VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, NULL, 0, *family, 1, &priority};
    const VkDeviceCreateInfo device_info = {VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, .queueCreateInfoCount = 1,
                                            .pQueueCreateInfos = &queues};
    MUST(vkCreateDevice(physical, &device_info, NULL, &device));
    vkGetDeviceQueue(device, *family, 0, &queue);
    return instance;
}

// Allocate memory of a type that is among those of the requirements and has the properties.
static VkDeviceMemory allocate(VkMemoryRequirements needs, VkMemoryPropertyFlags wanted)
{
    VkPhysicalDeviceMemoryProperties types;
    VkDeviceMemory memory;
    VkMemoryAllocateInfo info = {VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, .allocationSize = needs.size};
    vkGetPhysicalDeviceMemoryProperties(physical, &types);
    while (info.memoryTypeIndex < types.memoryTypeCount &&
           (!(needs.memoryTypeBits >> info.memoryTypeIndex & 1) ||
            (types.memoryTypes[info.memoryTypeIndex].propertyFlags & wanted) != wanted)) {
        info.memoryTypeIndex++;
    }
    MUST(vkAllocateMemory(device, &info, NULL, &memory));
    return memory;
}

struct target {
    VkImage image;
    VkDeviceMemory memory;
    VkImageView view;
};

static struct target make_target(VkFormat format, VkSampleCountFlagBits samples, VkImageUsageFlags usage,
                                 VkImageAspectFlags aspect)
{
    struct target target;
    VkMemoryRequirements needs;
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_2D,
                                    .format = format,
                                    .extent = {WIDTH, HEIGHT, 1},
                                    .mipLevels = 1,
                                    .arrayLayers = 1,
                                    .samples = samples,
                                    .usage = usage};
    MUST(vkCreateImage(device, &info, NULL, &target.image));
    vkGetImageMemoryRequirements(device, target.image, &needs);
    target.memory = allocate(needs, 0);
    MUST(vkBindImageMemory(device, target.image, target.memory, 0));
    const VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = target.image,
                                        .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                        .format = format,
                                        .subresourceRange = {aspect, 0, 1, 0, 1}};
    MUST(vkCreateImageView(device, &view, NULL, &target.view));
    return target;
}

// A pass that draws with 4 samples and a depth buffer, keeps neither, and resolves into an image that is copied next.
static VkRenderPass make_pass(void)
{
    const VkAttachmentLoadOp no_load = VK_ATTACHMENT_LOAD_OP_DONT_CARE, cleared = VK_ATTACHMENT_LOAD_OP_CLEAR;
    const VkAttachmentStoreOp no_store = VK_ATTACHMENT_STORE_OP_DONT_CARE,
                              stored = VK_ATTACHMENT_STORE_OP_STORE;
    const VkImageLayout color_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                        depth_layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    const VkAttachmentDescription attachments[ATTACHMENTS] = {
        {0, COLOR, VK_SAMPLE_COUNT_4_BIT, cleared, no_store, no_load, no_store, 0, color_layout},
        {0, DEPTH, VK_SAMPLE_COUNT_4_BIT, cleared, no_store, no_load, no_store, 0, depth_layout},
        {0, COLOR, VK_SAMPLE_COUNT_1_BIT, no_load, stored, no_load, no_store, 0,
         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL},
    };
    const VkSubpassDescription subpass = {.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                          .colorAttachmentCount = 1,
                                          .pColorAttachments = &(VkAttachmentReference){0, color_layout},
                                          .pResolveAttachments = &(VkAttachmentReference){2, color_layout},
                                          .pDepthStencilAttachment =
                                              &(VkAttachmentReference){1, depth_layout}};
    const VkSubpassDependency to_copy = {.dstSubpass = VK_SUBPASS_EXTERNAL,
                                         .srcStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT,
                                         .dstStageMask = VK_PIPELINE_STAGE_TRANSFER_BIT,
                                         .srcAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
                                         .dstAccessMask = VK_ACCESS_TRANSFER_READ_BIT};
    const VkRenderPassCreateInfo info = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                         .attachmentCount = ATTACHMENTS,
                                         .pAttachments = attachments,
                                         .subpassCount = 1,
                                         .pSubpasses = &subpass,
                                         .dependencyCount = 1,
                                         .pDependencies = &to_copy};
    VkRenderPass pass;
    MUST(vkCreateRenderPass(device, &info, NULL, &pass));
    return pass;
}

static VkPipelineShaderStageCreateInfo make_stage(VkShaderStageFlagBits stage, const uint32_t *words,
                                                  size_t size)
{
    const VkShaderModuleCreateInfo info = {VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size,
                                           .pCode = words};
    VkShaderModule module;
    MUST(vkCreateShaderModule(device, &info, NULL, &module));
    return (VkPipelineShaderStageCreateInfo){
        VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, NULL, 0, stage, module, "main", NULL};
}

static VkPipeline make_pipeline(VkRenderPass pass, VkPipelineLayout layout)
{
    const VkPipelineShaderStageCreateInfo stages[] = {
        make_stage(VK_SHADER_STAGE_VERTEX_BIT, rings_vert, sizeof rings_vert),
        make_stage(VK_SHADER_STAGE_FRAGMENT_BIT, rings_frag, sizeof rings_frag)};
    const VkPipelineVertexInputStateCreateInfo vertices = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkViewport viewport = {0, 0, WIDTH, HEIGHT, 0, 1};
    const VkRect2D scissor = {{0, 0}, {WIDTH, HEIGHT}};
    const VkPipelineViewportStateCreateInfo viewports = {
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, NULL, 0, 1, &viewport, 1, &scissor};
    const VkPipelineRasterizationStateCreateInfo raster = {
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples = {
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_4_BIT};
    const VkPipelineDepthStencilStateCreateInfo depth = {
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO, .depthTestEnable = VK_TRUE,
        .depthWriteEnable = VK_TRUE, .depthCompareOp = VK_COMPARE_OP_LESS};
    const VkPipelineColorBlendAttachmentState opaque = {.colorWriteMask = 15};
    const VkPipelineColorBlendStateCreateInfo blend = {
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO, .attachmentCount = 1,
        .pAttachments = &opaque};
    const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .stageCount = 2,
                                               .pStages = stages,
                                               .pVertexInputState = &vertices,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewports,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &samples,
                                               .pDepthStencilState = &depth,
                                               .pColorBlendState = &blend,
                                               .layout = layout,
                                               .renderPass = pass};
    VkPipeline pipeline;
    MUST(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    vkDestroyShaderModule(device, stages[0].module, NULL);
    vkDestroyShaderModule(device, stages[1].module, NULL);
    return pipeline;
}

static void draw(VkCommandBuffer commands, VkRenderPass pass, VkFramebuffer framebuffer,
                 VkPipelineLayout layout, VkPipeline pipeline)
{
    const VkClearValue clear[ATTACHMENTS] = {{.color = {.float32 = {0.02f, 0.02f, 0.03f, 1}}},
                                             {.depthStencil = {.depth = 1}}};
    const struct scene scene = {{0, -3.1f, 3.3f, 1}, RINGS, STEPS};
    const VkRect2D area = {{0, 0}, {WIDTH, HEIGHT}};
    const VkRenderPassBeginInfo info = {
        VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO, NULL, pass, framebuffer, area, ATTACHMENTS, clear};
    vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       sizeof scene, &scene);
    vkCmdDraw(commands, STEPS * STEPS * 6, RINGS, 0, 0);
    vkCmdEndRenderPass(commands);
}

static bool write_ppm(const char *name, const unsigned char *rgba)
{
    static unsigned char rgb[WIDTH * HEIGHT * 3];
    FILE *const file = fopen(name, "wb");
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        memcpy(&rgb[3 * i], &rgba[4 * i], 3);
    }
    const bool written =
        file && fprintf(file, "P6\n%d %d\n255\n", WIDTH, HEIGHT) > 0 && fwrite(rgb, sizeof rgb, 1, file) == 1;
    return file && fclose(file) == 0 && written;
}

int main(int argc, char **argv)
{
    uint32_t family;
    const VkInstance instance = open_device(&family);
    const struct target targets[ATTACHMENTS] = {
        make_target(COLOR, VK_SAMPLE_COUNT_4_BIT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                    VK_IMAGE_ASPECT_COLOR_BIT),
        make_target(DEPTH, VK_SAMPLE_COUNT_4_BIT, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                    VK_IMAGE_ASPECT_DEPTH_BIT),
        make_target(COLOR, VK_SAMPLE_COUNT_1_BIT,
                    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                    VK_IMAGE_ASPECT_COLOR_BIT)};
    const VkRenderPass pass = make_pass();
    const VkImageView views[ATTACHMENTS] = {targets[0].view, targets[1].view, targets[2].view};
    const VkFramebufferCreateInfo framebuffer_info = {
        VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO, NULL, 0, pass, ATTACHMENTS, views, WIDTH, HEIGHT, 1};
    VkFramebuffer framebuffer;
    MUST(vkCreateFramebuffer(device, &framebuffer_info, NULL, &framebuffer));
    const VkPushConstantRange range = {SCENE_STAGES, 0, sizeof(struct scene)};
    const VkPipelineLayoutCreateInfo layout_info = {VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                    .pushConstantRangeCount = 1,
                                                    .pPushConstantRanges = &range};
    VkPipelineLayout layout;
    MUST(vkCreatePipelineLayout(device, &layout_info, NULL, &layout));
    const VkPipeline pipeline = make_pipeline(pass, layout);

    // A buffer that the picture is copied into, and that the program reads.
    const VkBufferCreateInfo buffer_info = {VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = WIDTH * HEIGHT * 4,
                                            .usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT};
    VkBuffer buffer;
    MUST(vkCreateBuffer(device, &buffer_info, NULL, &buffer));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(device, buffer, &needs);
    const VkDeviceMemory memory =
        allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    MUST(vkBindBufferMemory(device, buffer, memory, 0));

    const VkCommandPoolCreateInfo pool_info = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                               .queueFamilyIndex = family};
    VkCommandPool pool;
    MUST(vkCreateCommandPool(device, &pool_info, NULL, &pool));
    const VkCommandBufferAllocateInfo commands_info = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                       .commandPool = pool, .commandBufferCount = 1};
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VkCommandBuffer commands;
    MUST(vkAllocateCommandBuffers(device, &commands_info, &commands));
    MUST(vkBeginCommandBuffer(commands, &begin));
    draw(commands, pass, framebuffer, layout, pipeline);
    const VkBufferImageCopy region = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                      .imageExtent = {WIDTH, HEIGHT, 1}};
    vkCmdCopyImageToBuffer(commands, targets[2].image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer, 1,
                           &region);
    const VkMemoryBarrier to_host = {VK_STRUCTURE_TYPE_MEMORY_BARRIER, NULL, VK_ACCESS_TRANSFER_WRITE_BIT,
                                     VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host,
                         0, NULL, 0, NULL);
    MUST(vkEndCommandBuffer(commands));
    const VkSubmitInfo submit = {VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1,
                                 .pCommandBuffers = &commands};
    MUST(vkQueueSubmit(queue, 1, &submit, VK_NULL_HANDLE));
    MUST(vkQueueWaitIdle(queue));

    void *pixels;
    MUST(vkMapMemory(device, memory, 0, VK_WHOLE_SIZE, 0, &pixels));
    const char *const name = argc > 1 ? argv[1] : "rings.ppm";
    const bool written = write_ppm(name, pixels);
    if (!written) {
        perror(name);
    }

    vkDestroyCommandPool(device, pool, NULL);
    vkDestroyBuffer(device, buffer, NULL);
    vkFreeMemory(device, memory, NULL);
    vkDestroyPipeline(device, pipeline, NULL);
    vkDestroyPipelineLayout(device, layout, NULL);
    vkDestroyFramebuffer(device, framebuffer, NULL);
    vkDestroyRenderPass(device, pass, NULL);
    for (int i = 0; i < ATTACHMENTS; i++) {
        vkDestroyImageView(device, targets[i].view, NULL);
        vkDestroyImage(device, targets[i].image, NULL);
        vkFreeMemory(device, targets[i].memory, NULL);
    }
    vkDestroyDevice(device, NULL);
    vkDestroyInstance(instance, NULL);
    return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
