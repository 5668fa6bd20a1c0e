// SPDX-License-Identifier: MIT
// A picture that a test draws: colour, and if it is asked for depth and stencil, more samples that are resolved, and the
// state of a pipeline that draws into it, which a test changes before it creates one.
#ifndef TEST_VULKAN_PICTURE_H
#define TEST_VULKAN_PICTURE_H

#include "vulkan_rig.h"

enum { PICTURE_SIZE = 64, PICTURE_TEXELS = PICTURE_SIZE * PICTURE_SIZE };

struct picture {
    struct rig *rig;
    struct rig_image color; ///< R8G8B8A8_UNORM, one sample
    struct rig_image depth; ///< D32_SFLOAT_S8_UINT
    struct rig_image samples;
    VkSampleCountFlagBits sample_count;
    bool has_depth;
    VkRenderPass pass;
    VkFramebuffer framebuffer;
    const uint8_t *texels; ///< RGBA, of picture_end
};

// Make a picture of RGBA8.
void picture_init(struct picture *picture, struct rig *rig, bool has_depth, VkSampleCountFlagBits samples);

// Begin the pass, which clears colour to a quarter of red, depth to 1 and stencil to 0; and set the viewport and the
// scissor to all of it.
void picture_begin(struct picture *picture);

// End the pass, run the commands and read the colours. A test calls it once.
void picture_end(struct picture *picture);

// Return a texel as 0xRRGGBBAA.
uint32_t picture_texel(const struct picture *picture, int x, int y);

struct picture_state {
    const void *next; ///< pNext of the pipeline
    VkPipelineShaderStageCreateInfo stages[2];
    VkVertexInputBindingDescription buffers[4];
    VkVertexInputAttributeDescription attributes[4];
    VkPipelineVertexInputStateCreateInfo input;
    VkPipelineInputAssemblyStateCreateInfo assembly;
    VkPipelineViewportStateCreateInfo viewports;
    VkPipelineRasterizationStateCreateInfo rasterization;
    VkPipelineMultisampleStateCreateInfo samples;
    VkPipelineDepthStencilStateCreateInfo depth;
    VkPipelineColorBlendAttachmentState blend[2]; ///< the first one writes all channels, the second none
    VkPipelineColorBlendStateCreateInfo blends;
    VkDynamicState dynamic[9];
    VkPipelineDynamicStateCreateInfo dynamics;
    VkPipelineLayout layout;
};

// Fill the state: triangles that replace what is there, viewport and scissor by commands. The shaders are modules.
void picture_state(struct picture_state *state, const struct picture *picture, VkShaderModule vertex,
                   VkShaderModule fragment, VkPipelineLayout layout);

// Create a pipeline for a subpass, which may fail. The caller destroys it.
VkResult picture_try_pipeline(const struct picture *picture, struct picture_state *state, VkRenderPass pass,
                              uint32_t subpass, VkPipeline *pipeline);

// Create a pipeline for a subpass.
VkPipeline picture_pipeline(const struct picture *picture, struct picture_state *state, VkRenderPass pass,
                            uint32_t subpass);

#endif
