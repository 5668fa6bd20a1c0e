// SPDX-License-Identifier: MIT
// A device of Vulkan with one queue, and the few things that every test does with it. What is made is destroyed with
// the rig. A call that fails, and a message of the validation layer, fail the test.
#ifndef TEST_VULKAN_RIG_H
#define TEST_VULKAN_RIG_H

#include <stdbool.h>
#include <vulkan/vulkan.h>

#include "unit.h"

#define CHECK(call) vulkan_check(call, #call, __FILE__, __LINE__)

void vulkan_check(VkResult result, const char *call, const char *file, int line);

enum { RIG_MOST_THINGS = 128 };

struct rig_thing {
    VkObjectType type;
    uint64_t handle;
};

struct rig {
    VkInstance instance;
    VkDebugUtilsMessengerEXT messenger;
    VkPhysicalDevice physical;
    VkDevice device;
    VkQueue queue;
    VkCommandPool pool;
    VkCommandBuffer commands;                 ///< is recorded from rig_open, and from rig_run, on
    struct rig_thing things[RIG_MOST_THINGS]; ///< destroyed in the opposite order
    int thing_count;
    bool is_lost; ///< the device is lost on purpose
};

void rig_open(struct rig *rig);
void rig_close(struct rig *rig);

// Run the commands, wait for them, and begin anew.
void rig_run(struct rig *rig);

struct rig_buffer {
    VkBuffer buffer;
    void *bytes; ///< mapped
    VkDeviceSize size;
};

// Create a buffer for everything. `data` may be NULL, which leaves zeros.
struct rig_buffer rig_buffer(struct rig *rig, VkDeviceSize size, const void *data);

struct rig_image {
    VkImage image;
    VkImageView view;
    VkFormat format;
    uint32_t width, height, layers;
};

struct rig_image rig_image(struct rig *rig, VkFormat format, uint32_t width, uint32_t height,
                           VkSampleCountFlagBits samples, VkImageUsageFlags usage);

// Create an image with layers, and a view that has all of them.
struct rig_image rig_layers(struct rig *rig, VkFormat format, uint32_t width, uint32_t height,
                            uint32_t layers, VkImageUsageFlags usage);

// Give an image memory of its own, and destroy both with the rig.
void rig_back(struct rig *rig, VkImage image);

// Create a framebuffer of views.
VkFramebuffer rig_framebuffer(struct rig *rig, VkRenderPass pass, const VkImageView *views, uint32_t count,
                              uint32_t size);

// Let an image go from one layout to another.
void rig_barrier(struct rig *rig, const struct rig_image *image, VkImageLayout from, VkImageLayout to);

// Record a copy of the texels to a buffer that is made for them. The image is in TRANSFER_SRC_OPTIMAL.
struct rig_buffer rig_read(struct rig *rig, const struct rig_image *image, size_t texel_size);

// Record a copy of texels to an image, which goes from UNDEFINED to `layout`.
void rig_write(struct rig *rig, const struct rig_image *image, const void *texels, size_t texel_size,
               VkImageLayout layout);

// Create things that need no more than these.
VkShaderModule rig_shader(struct rig *rig, const uint32_t *words, size_t size);
VkDescriptorSetLayout rig_set_layout(struct rig *rig, const VkDescriptorSetLayoutBinding *bindings,
                                     uint32_t count);
VkPipelineLayout rig_layout(struct rig *rig, const VkDescriptorSetLayout *sets, uint32_t count,
                            uint32_t push_size);
// Create a set with a pool of its own.
VkDescriptorSet rig_set(struct rig *rig, VkDescriptorSetLayout layout);
VkPipeline rig_compute(struct rig *rig, VkPipelineLayout layout, VkShaderModule module);

// Write a buffer, or an image with a sampler, either of which may be null, to a binding.
void rig_bind_buffer(struct rig *rig, VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
                     VkBuffer buffer, VkDeviceSize offset, VkDeviceSize range);
void rig_bind_image(struct rig *rig, VkDescriptorSet set, uint32_t binding, VkDescriptorType type,
                    VkImageView view, VkSampler sampler, VkImageLayout layout);

// Destroy a handle with the rig. It is cast to 64 bits.
void rig_keep(struct rig *rig, VkObjectType type, uint64_t handle);
void rig_destroy(VkDevice device, const struct rig_thing *thing);
#define RIG_KEEP(rig, type, handle) rig_keep(rig, VK_OBJECT_TYPE_##type, (uint64_t)(handle))

#endif
