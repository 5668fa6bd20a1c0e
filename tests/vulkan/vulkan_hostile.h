// SPDX-License-Identifier: MIT
// Objects of every kind, each in memory of its own between bytes that keep their values, and numbers picked at random of
// which many are too large.
#ifndef TEST_VULKAN_HOSTILE_H
#define TEST_VULKAN_HOSTILE_H

#include "vulkan_picture.h"

enum {
    HOSTILE_BUFFERS = 6,
    HOSTILE_IMAGES = 12,
    HOSTILE_VIEWS = 24,
    HOSTILE_SETS = 4,
    HOSTILE_GRAPHICS = 5,
    HOSTILE_PASSES = 6,
    HOSTILE_POOLS = 3,
    HOSTILE_DYNAMIC = 5 ///< dynamic offsets of a set
};

struct hostile {
    uint64_t random;
    uint64_t trace; // hash of all numbers so far, each with what it is picked below
    struct rig rig;
    struct picture picture;
    VkBuffer buffers[HOSTILE_BUFFERS]; // the last one has no memory
    VkImage images[HOSTILE_IMAGES];    // the last one has no memory
    VkImageAspectFlags aspects[HOSTILE_IMAGES];
    VkImageView views[HOSTILE_VIEWS];
    VkSampler sampler;
    VkBufferView texels;
    VkDescriptorSet sets[HOSTILE_SETS];
    VkPipelineLayout layout;
    VkPipeline compute, graphics[HOSTILE_GRAPHICS];
    VkRenderPass passes[HOSTILE_PASSES];
    VkFramebuffer framebuffers[HOSTILE_PASSES];
    VkQueryPool pools[HOSTILE_POOLS];
    unsigned char *guarded[HOSTILE_BUFFERS + HOSTILE_IMAGES];
    size_t sizes[HOSTILE_BUFFERS + HOSTILE_IMAGES];
    int guarded_count;
    bool is_in_pass;
};

// Make the objects that follow from a seed.
void hostile_open(struct hostile *h, uint64_t seed);

// Want the bytes around all objects to be what they were.
void hostile_check(const struct hostile *h);

// Return a number below `end`. Compilers choose the order in which arguments and elements of a list are computed, so no
// two calls stand in one list: a seed gives the same commands everywhere.
uint32_t hostile_below(struct hostile *h, uint32_t end);

// Return a number that is mostly small, and at times near the ends of 8, 16, 31 or 32 bits.
uint32_t hostile_any(struct hostile *h);

// Set numbers to what hostile_any gives.
void hostile_fill(struct hostile *h, uint32_t *numbers, int count);

// Return a rectangle of four of these numbers.
VkRect2D hostile_rectangle(struct hostile *h);

// Return a number of bytes, at times of 64 bits.
VkDeviceSize hostile_size(struct hostile *h);

// Write some of the descriptors of a set, at times more of them than there are.
void hostile_write_set(struct hostile *h);

#endif
