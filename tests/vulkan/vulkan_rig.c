// SPDX-License-Identifier: MIT
#include "vulkan_rig.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void vulkan_check(VkResult result, const char *call, const char *file, int line)
{
    if (result != VK_SUCCESS) {
        fail_msg("%s:%d: %s gave %d", file, line, call, (int)result);
    }
}

// The device -----------------------------------------------------------------------------------------

static VKAPI_ATTR VkBool32 VKAPI_CALL hear_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                   VkDebugUtilsMessageTypeFlagsEXT type,
                                                   const VkDebugUtilsMessengerCallbackDataEXT *data,
                                                   void *user)
{
    (void)severity;
    (void)type;
    (void)user;
    fprintf(stderr, "%s\n", data->pMessage);
    exit(1); // the call came from the layer, from which a test cannot return
}

static void open_instance(struct rig *rig)
{
    static const char *const layers[] = {"VK_LAYER_KHRONOS_validation"};
    static const char *const extensions[] = {VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    const bool is_checked = getenv("RHW_TEST_VALIDATION") != NULL;
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_1};
    const VkDebugUtilsMessengerCreateInfoEXT messages = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity =
            VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = hear_message};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pNext = is_checked ? &messages : NULL,
                                       .pApplicationInfo = &application,
                                       .enabledLayerCount = is_checked,
                                       .ppEnabledLayerNames = layers,
                                       .enabledExtensionCount = is_checked,
                                       .ppEnabledExtensionNames = extensions};
    CHECK(vkCreateInstance(&info, NULL, &rig->instance));
    if (is_checked) {
        const PFN_vkCreateDebugUtilsMessengerEXT create =
            (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(rig->instance,
                                                                      "vkCreateDebugUtilsMessengerEXT");
        CHECK(create(rig->instance, &messages, NULL, &rig->messenger));
    }
}

static void begin_commands(struct rig *rig)
{
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    CHECK(vkBeginCommandBuffer(rig->commands, &begin));
}

// Features of extensions that Zink asks for, and extensions without any.
static const char *const extensions[] = {
    VK_KHR_CREATE_RENDERPASS_2_EXTENSION_NAME,   VK_KHR_DEPTH_STENCIL_RESOLVE_EXTENSION_NAME,
    VK_KHR_DYNAMIC_RENDERING_EXTENSION_NAME,     VK_KHR_IMAGE_FORMAT_LIST_EXTENSION_NAME,
    VK_KHR_IMAGELESS_FRAMEBUFFER_EXTENSION_NAME, VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME,
    VK_EXT_CUSTOM_BORDER_COLOR_EXTENSION_NAME,   VK_EXT_DEPTH_CLIP_ENABLE_EXTENSION_NAME,
    VK_EXT_INDEX_TYPE_UINT8_EXTENSION_NAME,      VK_EXT_LINE_RASTERIZATION_EXTENSION_NAME,
    VK_EXT_PROVOKING_VERTEX_EXTENSION_NAME,      VK_EXT_SCALAR_BLOCK_LAYOUT_EXTENSION_NAME,
    VK_EXT_TRANSFORM_FEEDBACK_EXTENSION_NAME,    VK_EXT_VERTEX_ATTRIBUTE_DIVISOR_EXTENSION_NAME,
    VK_EXT_BORDER_COLOR_SWIZZLE_EXTENSION_NAME};

// Ask the device for all features of these structs, and enable them.
struct features {
    VkPhysicalDeviceImagelessFramebufferFeatures imageless;
    VkPhysicalDeviceDynamicRenderingFeatures rendering;
    VkPhysicalDeviceTimelineSemaphoreFeatures timelines;
    VkPhysicalDeviceMultiviewFeatures views;
    VkPhysicalDeviceCustomBorderColorFeaturesEXT borders;
    VkPhysicalDeviceDepthClipEnableFeaturesEXT clip;
    VkPhysicalDeviceIndexTypeUint8FeaturesEXT indices;
    VkPhysicalDeviceLineRasterizationFeaturesEXT lines;
    VkPhysicalDeviceProvokingVertexFeaturesEXT provoking;
    VkPhysicalDeviceScalarBlockLayoutFeatures layouts;
    VkPhysicalDeviceVertexAttributeDivisorFeaturesEXT divisors;
    VkPhysicalDeviceTransformFeedbackFeaturesEXT feedback;
    VkPhysicalDeviceShaderDrawParametersFeatures numbers;
    VkPhysicalDeviceBorderColorSwizzleFeaturesEXT swizzles;
    VkPhysicalDeviceFeatures2 all;
};

static void ask_features(VkPhysicalDevice physical, struct features *f)
{
    *f = (struct features){
        .imageless = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_IMAGELESS_FRAMEBUFFER_FEATURES},
        .rendering = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES,
                      .pNext = &f->imageless},
        .timelines = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES,
                      .pNext = &f->rendering},
        .views = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES, .pNext = &f->timelines},
        .borders = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CUSTOM_BORDER_COLOR_FEATURES_EXT,
                    .pNext = &f->views},
        .clip = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_CLIP_ENABLE_FEATURES_EXT,
                 .pNext = &f->borders},
        .indices = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_INDEX_TYPE_UINT8_FEATURES_EXT,
                    .pNext = &f->clip},
        .lines = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_LINE_RASTERIZATION_FEATURES_EXT,
                  .pNext = &f->indices},
        .provoking = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROVOKING_VERTEX_FEATURES_EXT,
                      .pNext = &f->lines},
        .layouts = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES,
                    .pNext = &f->provoking},
        .divisors = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VERTEX_ATTRIBUTE_DIVISOR_FEATURES_EXT,
                     .pNext = &f->layouts},
        .feedback = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TRANSFORM_FEEDBACK_FEATURES_EXT,
                     .pNext = &f->divisors},
        .numbers = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_DRAW_PARAMETERS_FEATURES,
                    .pNext = &f->feedback},
        .swizzles = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BORDER_COLOR_SWIZZLE_FEATURES_EXT,
                     .pNext = &f->numbers},
        .all = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &f->swizzles}};
    vkGetPhysicalDeviceFeatures2(physical, &f->all);
}

void rig_open(struct rig *rig)
{
    *rig = (struct rig){.instance = NULL};
    open_instance(rig);
    uint32_t count = 1;
    CHECK(vkEnumeratePhysicalDevices(rig->instance, &count, &rig->physical));
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, .queueCount = 1, .pQueuePriorities = &priority};
    struct features features;
    ask_features(rig->physical, &features);
    const VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                     .pNext = &features.all,
                                     .queueCreateInfoCount = 1,
                                     .pQueueCreateInfos = &queue,
                                     .enabledExtensionCount = sizeof extensions / sizeof *extensions,
                                     .ppEnabledExtensionNames = extensions};
    CHECK(vkCreateDevice(rig->physical, &info, NULL, &rig->device));
    vkGetDeviceQueue(rig->device, 0, 0, &rig->queue);
    const VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    CHECK(vkCreateCommandPool(rig->device, &pool, NULL, &rig->pool));
    const VkCommandBufferAllocateInfo buffer = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                .commandPool = rig->pool,
                                                .commandBufferCount = 1};
    CHECK(vkAllocateCommandBuffers(rig->device, &buffer, &rig->commands));
    begin_commands(rig);
}

void rig_keep(struct rig *rig, VkObjectType type, uint64_t handle)
{
    assert_true(rig->thing_count < RIG_MOST_THINGS);
    rig->things[rig->thing_count++] = (struct rig_thing){type, handle};
}

void rig_destroy(VkDevice device, const struct rig_thing *thing)
{
    switch (thing->type) {
#define DESTROY(type, name) \
    case VK_OBJECT_TYPE_##type: vkDestroy##name(device, (Vk##name)thing->handle, NULL); break;
        DESTROY(BUFFER, Buffer)
        DESTROY(BUFFER_VIEW, BufferView)
        DESTROY(IMAGE, Image)
        DESTROY(IMAGE_VIEW, ImageView)
        DESTROY(SAMPLER, Sampler)
        DESTROY(SHADER_MODULE, ShaderModule)
        DESTROY(DESCRIPTOR_SET_LAYOUT, DescriptorSetLayout)
        DESTROY(DESCRIPTOR_POOL, DescriptorPool)
        DESTROY(DESCRIPTOR_UPDATE_TEMPLATE, DescriptorUpdateTemplate)
        DESTROY(PIPELINE_LAYOUT, PipelineLayout)
        DESTROY(PIPELINE, Pipeline)
        DESTROY(PIPELINE_CACHE, PipelineCache)
        DESTROY(RENDER_PASS, RenderPass)
        DESTROY(FRAMEBUFFER, Framebuffer)
        DESTROY(COMMAND_POOL, CommandPool)
        DESTROY(FENCE, Fence)
        DESTROY(QUERY_POOL, QueryPool)
#undef DESTROY
    case VK_OBJECT_TYPE_DEVICE_MEMORY: vkFreeMemory(device, (VkDeviceMemory)thing->handle, NULL); break;
    default: fail_msg("a thing of type %d is not destroyed", (int)thing->type);
    }
}

void rig_close(struct rig *rig)
{
    assert_int_equal(vkDeviceWaitIdle(rig->device), rig->is_lost ? VK_ERROR_DEVICE_LOST : VK_SUCCESS);
    vkDestroyCommandPool(rig->device, rig->pool, NULL);
    while (rig->thing_count > 0) {
        rig_destroy(rig->device, &rig->things[--rig->thing_count]);
    }
    vkDestroyDevice(rig->device, NULL);
    if (rig->messenger) {
        const PFN_vkDestroyDebugUtilsMessengerEXT end =
            (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(rig->instance,
                                                                       "vkDestroyDebugUtilsMessengerEXT");
        end(rig->instance, rig->messenger, NULL);
    }
    vkDestroyInstance(rig->instance, NULL);
}

void rig_run(struct rig *rig)
{
    // What the commands write is read by the program next.
    const VkMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                     .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
                                     .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
    vkCmdPipelineBarrier(rig->commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &barrier, 0, NULL, 0, NULL);
    CHECK(vkEndCommandBuffer(rig->commands));
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &rig->commands};
    CHECK(vkQueueSubmit(rig->queue, 1, &submit, VK_NULL_HANDLE));
    CHECK(vkQueueWaitIdle(rig->queue));
    CHECK(vkResetCommandPool(rig->device, rig->pool, 0));
    begin_commands(rig);
}

// Memory ---------------------------------------------------------------------------------------------

static VkDeviceMemory allocate(struct rig *rig, const VkMemoryRequirements *needs, bool is_mapped)
{
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(rig->physical, &properties);
    const VkMemoryPropertyFlags wanted =
        is_mapped ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0;
    uint32_t type = 0;
    while (!(needs->memoryTypeBits >> type & 1) ||
           (properties.memoryTypes[type].propertyFlags & wanted) != wanted) {
        type++;
        assert_true(type < properties.memoryTypeCount);
    }
    const VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                       .allocationSize = needs->size,
                                       .memoryTypeIndex = type};
    VkDeviceMemory memory;
    CHECK(vkAllocateMemory(rig->device, &info, NULL, &memory));
    RIG_KEEP(rig, DEVICE_MEMORY, memory);
    return memory;
}

struct rig_buffer rig_buffer(struct rig *rig, VkDeviceSize size, const void *data)
{
    struct rig_buffer made = {.size = size};
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size,
        .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                 VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_TEXEL_BUFFER_BIT |
                 VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                 VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
                 VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFORM_FEEDBACK_BUFFER_BIT_EXT |
                 VK_BUFFER_USAGE_TRANSFORM_FEEDBACK_COUNTER_BUFFER_BIT_EXT};
    VkMemoryRequirements needs;
    CHECK(vkCreateBuffer(rig->device, &info, NULL, &made.buffer));
    vkGetBufferMemoryRequirements(rig->device, made.buffer, &needs);
    VkDeviceMemory memory = allocate(rig, &needs, true);
    RIG_KEEP(rig, BUFFER, made.buffer);
    CHECK(vkBindBufferMemory(rig->device, made.buffer, memory, 0));
    CHECK(vkMapMemory(rig->device, memory, 0, VK_WHOLE_SIZE, 0, &made.bytes));
    if (data) {
        memcpy(made.bytes, data, (size_t)size);
    } else {
        memset(made.bytes, 0, (size_t)size);
    }
    return made;
}

static VkImageAspectFlags aspect_of(VkFormat format)
{
    return format == VK_FORMAT_S8_UINT                                       ? VK_IMAGE_ASPECT_STENCIL_BIT
           : format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM ? VK_IMAGE_ASPECT_DEPTH_BIT
           : format == VK_FORMAT_D32_SFLOAT_S8_UINT || format == VK_FORMAT_D24_UNORM_S8_UINT
               ? VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT
               : VK_IMAGE_ASPECT_COLOR_BIT;
}

void rig_back(struct rig *rig, VkImage image)
{
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(rig->device, image, &needs);
    VkDeviceMemory memory = allocate(rig, &needs, false);
    RIG_KEEP(rig, IMAGE, image);
    CHECK(vkBindImageMemory(rig->device, image, memory, 0));
}

VkFramebuffer rig_framebuffer(struct rig *rig, VkRenderPass pass, const VkImageView *views, uint32_t count,
                              uint32_t size)
{
    const VkFramebufferCreateInfo info = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                          .renderPass = pass,
                                          .attachmentCount = count,
                                          .pAttachments = views,
                                          .width = size,
                                          .height = size,
                                          .layers = 1};
    VkFramebuffer framebuffer;
    CHECK(vkCreateFramebuffer(rig->device, &info, NULL, &framebuffer));
    RIG_KEEP(rig, FRAMEBUFFER, framebuffer);
    return framebuffer;
}

static struct rig_image make_image(struct rig *rig, const VkImageCreateInfo *info, VkImageViewType type)
{
    struct rig_image made = {.format = info->format,
                             .width = info->extent.width,
                             .height = info->extent.height,
                             .layers = info->arrayLayers};
    CHECK(vkCreateImage(rig->device, info, NULL, &made.image));
    rig_back(rig, made.image);
    const VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = made.image,
                                        .viewType = type,
                                        .format = made.format,
                                        .subresourceRange = {.aspectMask = aspect_of(made.format),
                                                             .levelCount = 1,
                                                             .layerCount = made.layers}};
    CHECK(vkCreateImageView(rig->device, &view, NULL, &made.view));
    RIG_KEEP(rig, IMAGE_VIEW, made.view);
    return made;
}

struct rig_image rig_image(struct rig *rig, VkFormat format, uint32_t width, uint32_t height,
                           VkSampleCountFlagBits samples, VkImageUsageFlags usage)
{
    return make_image(rig,
                      &(VkImageCreateInfo){.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                           .imageType = VK_IMAGE_TYPE_2D,
                                           .format = format,
                                           .extent = {width, height, 1},
                                           .mipLevels = 1,
                                           .arrayLayers = 1,
                                           .samples = samples,
                                           .usage = usage},
                      VK_IMAGE_VIEW_TYPE_2D);
}

struct rig_image rig_layers(struct rig *rig, VkFormat format, uint32_t width, uint32_t height,
                            uint32_t layers, VkImageUsageFlags usage)
{
    return make_image(rig,
                      &(VkImageCreateInfo){.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                           .imageType = VK_IMAGE_TYPE_2D,
                                           .format = format,
                                           .extent = {width, height, 1},
                                           .mipLevels = 1,
                                           .arrayLayers = layers,
                                           .samples = VK_SAMPLE_COUNT_1_BIT,
                                           .usage = usage},
                      VK_IMAGE_VIEW_TYPE_2D_ARRAY);
}

// Transfer -------------------------------------------------------------------------------------------

void rig_barrier(struct rig *rig, const struct rig_image *image, VkImageLayout from, VkImageLayout to)
{
    const VkImageMemoryBarrier barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
        .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
        .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image->image,
        .subresourceRange = {
            .aspectMask = aspect_of(image->format), .levelCount = 1, .layerCount = image->layers}};
    vkCmdPipelineBarrier(rig->commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
}

static VkBufferImageCopy whole(const struct rig_image *image)
{
    return (VkBufferImageCopy){
        .imageSubresource = {.aspectMask = aspect_of(image->format) & ~(uint32_t)VK_IMAGE_ASPECT_STENCIL_BIT,
                             .layerCount = image->layers},
        .imageExtent = {image->width, image->height, 1}};
}

struct rig_buffer rig_read(struct rig *rig, const struct rig_image *image, size_t texel_size)
{
    const VkBufferImageCopy copy = whole(image);
    const struct rig_buffer buffer =
        rig_buffer(rig, (VkDeviceSize)image->width * image->height * image->layers * texel_size, NULL);
    vkCmdCopyImageToBuffer(rig->commands, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, buffer.buffer,
                           1, &copy);
    return buffer;
}

void rig_write(struct rig *rig, const struct rig_image *image, const void *texels, size_t texel_size,
               VkImageLayout layout)
{
    const VkBufferImageCopy copy = whole(image);
    const struct rig_buffer buffer =
        rig_buffer(rig, (VkDeviceSize)image->width * image->height * image->layers * texel_size, texels);
    rig_barrier(rig, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
    vkCmdCopyBufferToImage(rig->commands, buffer.buffer, image->image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                           1, &copy);
    rig_barrier(rig, image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, layout);
}

// Pipelines and sets ---------------------------------------------------------------------------------

VkShaderModule rig_shader(struct rig *rig, const uint32_t *words, size_t size)
{
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = size, .pCode = words};
    VkShaderModule module;
    CHECK(vkCreateShaderModule(rig->device, &info, NULL, &module));
    RIG_KEEP(rig, SHADER_MODULE, module);
    return module;
}

VkDescriptorSetLayout rig_set_layout(struct rig *rig, const VkDescriptorSetLayoutBinding *bindings,
                                     uint32_t count)
{
    const VkDescriptorSetLayoutCreateInfo info = {.sType =
                                                      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                  .bindingCount = count,
                                                  .pBindings = bindings};
    VkDescriptorSetLayout layout;
    CHECK(vkCreateDescriptorSetLayout(rig->device, &info, NULL, &layout));
    RIG_KEEP(rig, DESCRIPTOR_SET_LAYOUT, layout);
    return layout;
}

VkPipelineLayout rig_layout(struct rig *rig, const VkDescriptorSetLayout *sets, uint32_t count,
                            uint32_t push_size)
{
    const VkPushConstantRange range = {.stageFlags = VK_SHADER_STAGE_ALL, .size = push_size};
    const VkPipelineLayoutCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                             .setLayoutCount = count,
                                             .pSetLayouts = sets,
                                             .pushConstantRangeCount = push_size > 0,
                                             .pPushConstantRanges = &range};
    VkPipelineLayout layout;
    CHECK(vkCreatePipelineLayout(rig->device, &info, NULL, &layout));
    RIG_KEEP(rig, PIPELINE_LAYOUT, layout);
    return layout;
}

VkDescriptorSet rig_set(struct rig *rig, VkDescriptorSetLayout layout)
{
    enum { TYPES = VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT + 1 };
    VkDescriptorPoolSize sizes[TYPES];
    for (int i = 0; i < TYPES; i++) {
        sizes[i] = (VkDescriptorPoolSize){(VkDescriptorType)i, 8};
    }
    const VkDescriptorPoolCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = 1,
                                             .poolSizeCount = TYPES,
                                             .pPoolSizes = sizes};
    VkDescriptorPool pool;
    CHECK(vkCreateDescriptorPool(rig->device, &info, NULL, &pool));
    RIG_KEEP(rig, DESCRIPTOR_POOL, pool);
    const VkDescriptorSetAllocateInfo allocate_info = {.sType =
                                                           VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                       .descriptorPool = pool,
                                                       .descriptorSetCount = 1,
                                                       .pSetLayouts = &layout};
    VkDescriptorSet set;
    CHECK(vkAllocateDescriptorSets(rig->device, &allocate_info, &set));
    return set;
}

VkPipeline rig_compute(struct rig *rig, VkPipelineLayout layout, VkShaderModule module)
{
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main"},
        .layout = layout};
    VkPipeline pipeline;
    CHECK(vkCreateComputePipelines(rig->device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
    RIG_KEEP(rig, PIPELINE, pipeline);
    return pipeline;
}

void rig_bind_buffer(struct rig *rig, VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
                     VkBuffer buffer, VkDeviceSize offset, VkDeviceSize range)
{
    const VkDescriptorBufferInfo info = {buffer, offset, range};
    const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                        .dstSet = set,
                                        .dstBinding = binding,
                                        .descriptorCount = 1,
                                        .descriptorType = type,
                                        .pBufferInfo = &info};
    vkUpdateDescriptorSets(rig->device, 1, &write, 0, NULL);
}

void rig_bind_image(struct rig *rig, VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
                    VkImageView view, VkSampler sampler, VkImageLayout layout)
{
    const VkDescriptorImageInfo info = {sampler, view, layout};
    const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                        .dstSet = set,
                                        .dstBinding = binding,
                                        .descriptorCount = 1,
                                        .descriptorType = type,
                                        .pImageInfo = &info};
    vkUpdateDescriptorSets(rig->device, 1, &write, 0, NULL);
}
