// SPDX-License-Identifier: MIT
// See vulkan_peer.h.
#include "vulkan_peer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <vulkan/vulkan.h>

struct vulkan_peer {
    VkInstance instance;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    uint32_t family, memory_type;
    VkCommandPool commands;
    VkDescriptorPool descriptors;
    char name[VK_MAX_PHYSICAL_DEVICE_NAME_SIZE + 64];
};

// What one dispatch makes and destroys.
struct dispatch_objects {
    VkShaderModule module;
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline pipeline;
    VkDescriptorSet set;
    VkBuffer buffers[PEER_BUFFERS];
    VkDeviceMemory memory[PEER_BUFFERS];
    VkCommandBuffer command;
};

// Opening --------------------------------------------------------------------------------------------

static bool find_device(struct vulkan_peer *peer)
{
    VkPhysicalDevice devices[16];
    uint32_t count = 16;
    if (vkEnumeratePhysicalDevices(peer->instance, &count, devices) < 0) {
        return false;
    }
    for (uint32_t i = 0; i < count; i++) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(devices[i], &properties);
        if (properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU) {
            peer->physical = devices[i];
            snprintf(peer->name, sizeof peer->name, "%s, driver %u.%u.%u", properties.deviceName,
                     VK_VERSION_MAJOR(properties.driverVersion), VK_VERSION_MINOR(properties.driverVersion),
                     VK_VERSION_PATCH(properties.driverVersion));
            return true;
        }
    }
    return false;
}

static bool find_memory_type(struct vulkan_peer *peer)
{
    const VkMemoryPropertyFlags wanted =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkPhysicalDeviceMemoryProperties properties;
    vkGetPhysicalDeviceMemoryProperties(peer->physical, &properties);
    for (uint32_t i = 0; i < properties.memoryTypeCount; i++) {
        if ((properties.memoryTypes[i].propertyFlags & wanted) == wanted) {
            peer->memory_type = i;
            return true;
        }
    }
    return false;
}

static bool find_family(struct vulkan_peer *peer)
{
    VkQueueFamilyProperties families[16];
    uint32_t count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(peer->physical, &count, families);
    for (uint32_t i = 0; i < count; i++) {
        if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) {
            peer->family = i;
            return true;
        }
    }
    return false;
}

static bool make_device(struct vulkan_peer *peer)
{
    const float priority = 1;
    const VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                           .queueFamilyIndex = peer->family,
                                           .queueCount = 1,
                                           .pQueuePriorities = &priority};
    const VkPhysicalDeviceFeatures features = {.robustBufferAccess = VK_TRUE};
    const VkDeviceCreateInfo device = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queue,
                                       .pEnabledFeatures = &features};
    const VkCommandPoolCreateInfo commands = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                              .queueFamilyIndex = peer->family};
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, PEER_BUFFERS};
    const VkDescriptorPoolCreateInfo descriptors = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                                    .maxSets = 1,
                                                    .poolSizeCount = 1,
                                                    .pPoolSizes = &size};
    if (vkCreateDevice(peer->physical, &device, NULL, &peer->device) != VK_SUCCESS) {
        return false;
    }
    vkGetDeviceQueue(peer->device, peer->family, 0, &peer->queue);
    return vkCreateCommandPool(peer->device, &commands, NULL, &peer->commands) == VK_SUCCESS &&
           vkCreateDescriptorPool(peer->device, &descriptors, NULL, &peer->descriptors) == VK_SUCCESS;
}

struct vulkan_peer *vulkan_peer_open(void)
{
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_1};
    const VkInstanceCreateInfo instance = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                           .pApplicationInfo = &application};
    struct vulkan_peer *const peer = calloc(1, sizeof *peer);
    if (peer && vkCreateInstance(&instance, NULL, &peer->instance) == VK_SUCCESS && find_device(peer) &&
        find_memory_type(peer) && find_family(peer) && make_device(peer)) {
        return peer;
    }
    vulkan_peer_close(peer);
    return NULL;
}

void vulkan_peer_close(struct vulkan_peer *peer)
{
    if (peer && peer->device) {
        vkDestroyDescriptorPool(peer->device, peer->descriptors, NULL);
        vkDestroyCommandPool(peer->device, peer->commands, NULL);
        vkDestroyDevice(peer->device, NULL);
    }
    if (peer && peer->instance) {
        vkDestroyInstance(peer->instance, NULL);
    }
    free(peer);
}

const char *vulkan_peer_name(const struct vulkan_peer *peer)
{
    return peer->name;
}

// Dispatches -----------------------------------------------------------------------------------------

static bool make_pipeline(struct vulkan_peer *peer, const struct peer_dispatch *dispatch,
                          struct dispatch_objects *objects)
{
    VkDescriptorSetLayoutBinding bindings[PEER_BUFFERS];
    VkSpecializationMapEntry entries[PEER_CONSTANTS];
    uint32_t values[PEER_CONSTANTS];
    for (int b = 0; b < dispatch->buffer_count; b++) {
        bindings[b] = (VkDescriptorSetLayoutBinding){.binding = (uint32_t)b,
                                                     .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                                     .descriptorCount = 1,
                                                     .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT};
    }
    for (uint32_t c = 0; c < dispatch->constant_count; c++) {
        values[c] = dispatch->constants[c].value;
        entries[c] =
            (VkSpecializationMapEntry){dispatch->constants[c].id, c * sizeof *values, sizeof *values};
    }
    const VkShaderModuleCreateInfo module = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                             .codeSize = dispatch->size,
                                             .pCode = dispatch->words};
    const VkDescriptorSetLayoutCreateInfo set_layout = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = (uint32_t)dispatch->buffer_count,
        .pBindings = bindings};
    const VkSpecializationInfo constants = {dispatch->constant_count, entries, sizeof values, values};
    if (vkCreateShaderModule(peer->device, &module, NULL, &objects->module) != VK_SUCCESS ||
        vkCreateDescriptorSetLayout(peer->device, &set_layout, NULL, &objects->set_layout) != VK_SUCCESS) {
        return false;
    }
    const VkPipelineLayoutCreateInfo layout = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                               .setLayoutCount = 1,
                                               .pSetLayouts = &objects->set_layout};
    if (vkCreatePipelineLayout(peer->device, &layout, NULL, &objects->layout) != VK_SUCCESS) {
        return false;
    }
    const VkComputePipelineCreateInfo pipeline = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = objects->module,
                  .pName = "main",
                  .pSpecializationInfo = &constants},
        .layout = objects->layout};
    return vkCreateComputePipelines(peer->device, VK_NULL_HANDLE, 1, &pipeline, NULL, &objects->pipeline) ==
           VK_SUCCESS;
}

// Make a buffer that holds the bytes, and put it into the set.
static bool make_buffer(struct vulkan_peer *peer, const struct peer_dispatch *dispatch, int b,
                        struct dispatch_objects *objects)
{
    const struct peer_buffer *const from = &dispatch->buffers[b];
    const VkBufferCreateInfo buffer = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                       .size = from->size,
                                       .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
    VkMemoryRequirements needs;
    void *bytes;
    if (vkCreateBuffer(peer->device, &buffer, NULL, &objects->buffers[b]) != VK_SUCCESS) {
        return false;
    }
    vkGetBufferMemoryRequirements(peer->device, objects->buffers[b], &needs);
    const VkMemoryAllocateInfo memory = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                         .allocationSize = needs.size,
                                         .memoryTypeIndex = peer->memory_type};
    if (vkAllocateMemory(peer->device, &memory, NULL, &objects->memory[b]) != VK_SUCCESS ||
        vkBindBufferMemory(peer->device, objects->buffers[b], objects->memory[b], 0) != VK_SUCCESS ||
        vkMapMemory(peer->device, objects->memory[b], 0, VK_WHOLE_SIZE, 0, &bytes) != VK_SUCCESS) {
        return false;
    }
    memcpy(bytes, from->bytes, from->size);
    vkUnmapMemory(peer->device, objects->memory[b]);
    const VkDescriptorBufferInfo info = {objects->buffers[b], 0, VK_WHOLE_SIZE};
    const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                        .dstSet = objects->set,
                                        .dstBinding = (uint32_t)b,
                                        .descriptorCount = 1,
                                        .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                                        .pBufferInfo = &info};
    vkUpdateDescriptorSets(peer->device, 1, &write, 0, NULL);
    return true;
}

static bool make_set(struct vulkan_peer *peer, const struct peer_dispatch *dispatch,
                     struct dispatch_objects *objects)
{
    const VkDescriptorSetAllocateInfo set = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                             .descriptorPool = peer->descriptors,
                                             .descriptorSetCount = 1,
                                             .pSetLayouts = &objects->set_layout};
    bool is_made = vkResetDescriptorPool(peer->device, peer->descriptors, 0) == VK_SUCCESS &&
                   vkAllocateDescriptorSets(peer->device, &set, &objects->set) == VK_SUCCESS;
    for (int b = 0; is_made && b < dispatch->buffer_count; b++) {
        is_made = make_buffer(peer, dispatch, b, objects);
    }
    return is_made;
}

static bool run(struct vulkan_peer *peer, const struct peer_dispatch *dispatch,
                struct dispatch_objects *objects)
{
    const VkCommandBufferAllocateInfo allocate = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  .commandPool = peer->commands,
                                                  .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                                  .commandBufferCount = 1};
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    if (vkAllocateCommandBuffers(peer->device, &allocate, &objects->command) != VK_SUCCESS ||
        vkBeginCommandBuffer(objects->command, &begin) != VK_SUCCESS) {
        return false;
    }
    vkCmdBindPipeline(objects->command, VK_PIPELINE_BIND_POINT_COMPUTE, objects->pipeline);
    vkCmdBindDescriptorSets(objects->command, VK_PIPELINE_BIND_POINT_COMPUTE, objects->layout, 0, 1,
                            &objects->set, 0, NULL);
    vkCmdDispatch(objects->command, dispatch->groups, 1, 1);
    const VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                 .commandBufferCount = 1,
                                 .pCommandBuffers = &objects->command};
    return vkEndCommandBuffer(objects->command) == VK_SUCCESS &&
           vkQueueSubmit(peer->queue, 1, &submit, VK_NULL_HANDLE) == VK_SUCCESS &&
           vkQueueWaitIdle(peer->queue) == VK_SUCCESS;
}

static bool read_back(struct vulkan_peer *peer, const struct peer_dispatch *dispatch,
                      const struct dispatch_objects *objects)
{
    for (int b = 0; b < dispatch->buffer_count; b++) {
        void *bytes;
        if (vkMapMemory(peer->device, objects->memory[b], 0, VK_WHOLE_SIZE, 0, &bytes) != VK_SUCCESS) {
            return false;
        }
        memcpy(dispatch->buffers[b].bytes, bytes, dispatch->buffers[b].size);
        vkUnmapMemory(peer->device, objects->memory[b]);
    }
    return true;
}

bool vulkan_peer_dispatch(struct vulkan_peer *peer, const struct peer_dispatch *dispatch)
{
    struct dispatch_objects objects = {.module = VK_NULL_HANDLE};
    const bool is_done = make_pipeline(peer, dispatch, &objects) && make_set(peer, dispatch, &objects) &&
                         run(peer, dispatch, &objects) && read_back(peer, dispatch, &objects);
    if (objects.command) {
        vkFreeCommandBuffers(peer->device, peer->commands, 1, &objects.command);
    }
    for (int b = 0; b < PEER_BUFFERS; b++) {
        vkDestroyBuffer(peer->device, objects.buffers[b], NULL);
        vkFreeMemory(peer->device, objects.memory[b], NULL);
    }
    vkDestroyPipeline(peer->device, objects.pipeline, NULL);
    vkDestroyPipelineLayout(peer->device, objects.layout, NULL);
    vkDestroyDescriptorSetLayout(peer->device, objects.set_layout, NULL);
    vkDestroyShaderModule(peer->device, objects.module, NULL);
    return is_done;
}
