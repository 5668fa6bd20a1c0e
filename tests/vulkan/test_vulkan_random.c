// SPDX-License-Identifier: MIT
// Pictures of rectangles, clears and state that are picked at random are the same however they are recorded: in the
// command buffer itself or in secondary ones, by draws that stand in a buffer, and with 4 samples that are resolved. The
// edges lie between pixels, so that all samples of a pixel have one colour.
#include <string.h>

#include "quad_vert.h"
#include "shade_frag.h"
#include "vulkan_picture.h"

enum { SEEDS = 24, STEPS = 24, PIPELINES = 5, SIZE = PICTURE_SIZE };

struct random_state {
    uint64_t bits;
};

static uint32_t below(struct random_state *random, uint32_t end)
{
    random->bits ^= random->bits << 13;
    random->bits ^= random->bits >> 7;
    random->bits ^= random->bits << 17;
    return (uint32_t)(random->bits >> 24) % end;
}

// A clear of a rectangle, or a draw.
struct step {
    bool clears;
    VkClearAttachment clear;
    VkClearRect rectangle;
    uint32_t pipeline, reference;
    VkRect2D scissor;
    float push[9];
    VkDrawIndirectCommand draw;
};

struct plan {
    VkPipelineDepthStencilStateCreateInfo depth[PIPELINES];
    VkPipelineColorBlendAttachmentState blend[PIPELINES];
    VkCullModeFlags cull[PIPELINES];
    struct step steps[STEPS];
};

// Compilers choose the order in which the elements of a list are computed, so each number is picked by itself: a seed is
// the same plan everywhere.
static VkStencilOpState pick_stencil(struct random_state *random)
{
    VkStencilOpState state = {.reference = 0};
    state.failOp = (VkStencilOp)below(random, 8);
    state.passOp = (VkStencilOp)below(random, 8);
    state.depthFailOp = (VkStencilOp)below(random, 8);
    state.compareOp = (VkCompareOp)below(random, 8);
    state.compareMask = below(random, 256);
    state.writeMask = below(random, 256);
    return state;
}

// Sums of bytes, and the larger or smaller of two, are no matter of rounding.
static VkPipelineColorBlendAttachmentState pick_blend(struct random_state *random)
{
    VkPipelineColorBlendAttachmentState state = {.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                 .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE};
    state.blendEnable = below(random, 3) == 0;
    state.srcColorBlendFactor = below(random, 2) ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO;
    state.dstColorBlendFactor = below(random, 2) ? VK_BLEND_FACTOR_ONE : VK_BLEND_FACTOR_ZERO;
    state.colorBlendOp = (VkBlendOp)below(random, 5);
    state.alphaBlendOp = (VkBlendOp)below(random, 5);
    state.colorWriteMask = below(random, 4) ? 15 : below(random, 16);
    return state;
}

static VkRect2D pick_rectangle(struct random_state *random)
{
    const uint32_t x = below(random, SIZE), y = below(random, SIZE);
    const uint32_t width = 1 + below(random, SIZE - x), height = 1 + below(random, SIZE - y);
    return (VkRect2D){{(int32_t)x, (int32_t)y}, {width, height}};
}

static void pick_clear(struct random_state *random, struct step *step)
{
    step->clears = true;
    step->rectangle = (VkClearRect){pick_rectangle(random), 0, 1};
    step->clear.aspectMask = (VkImageAspectFlags)(VK_IMAGE_ASPECT_COLOR_BIT << below(random, 3));
    if (step->clear.aspectMask == VK_IMAGE_ASPECT_COLOR_BIT) {
        for (int i = 0; i < 4; i++) {
            step->clear.clearValue.color.float32[i] = (float)below(random, 256) / 255;
        }
    } else {
        step->clear.clearValue.depthStencil.depth = (float)below(random, 17) / 16;
        step->clear.clearValue.depthStencil.stencil = below(random, 256);
    }
}

static void pick_draw(struct random_state *random, struct step *step)
{
    const VkRect2D whole = {.extent = {SIZE, SIZE}};
    step->pipeline = below(random, PIPELINES);
    step->reference = below(random, 256);
    step->scissor = below(random, 3) ? whole : pick_rectangle(random);
    for (int i = 0; i < 4; i++) { // edges on every other pixel, in any order
        step->push[i] = (float)below(random, 33) / 16 - 1;
        step->push[4 + i] = (float)below(random, 256) / 255;
    }
    step->push[8] = (float)below(random, 17) / 16;
    step->draw.vertexCount = 6 * below(random, 3);
    step->draw.instanceCount = below(random, 4);
    step->draw.firstVertex = 6 * below(random, 3);
    step->draw.firstInstance = below(random, 2);
}

static void pick_plan(uint64_t seed, struct plan *plan)
{
    struct random_state random = {seed * UINT64_C(0x9e3779b97f4a7c15)};
    memset(plan, 0, sizeof *plan);
    for (int i = 0; i < PIPELINES; i++) {
        VkPipelineDepthStencilStateCreateInfo *const depth = &plan->depth[i];
        depth->sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
        depth->depthTestEnable = below(&random, 2);
        depth->depthWriteEnable = below(&random, 2);
        depth->depthCompareOp = (VkCompareOp)below(&random, 8);
        depth->stencilTestEnable = below(&random, 2);
        depth->front = pick_stencil(&random);
        depth->back = pick_stencil(&random);
        plan->blend[i] = pick_blend(&random);
        plan->cull[i] = below(&random, 3) ? VK_CULL_MODE_NONE : below(&random, 3);
    }
    for (int i = 0; i < STEPS; i++) {
        if (below(&random, 6) == 0) {
            pick_clear(&random, &plan->steps[i]);
        } else {
            pick_draw(&random, &plan->steps[i]);
        }
    }
}

// How a plan is recorded.
enum way { INLINE, SECONDARY, INDIRECT, SAMPLES, WAYS };

struct drawing {
    struct rig rig;
    struct picture picture;
    VkPipelineLayout layout;
    VkPipeline pipelines[PIPELINES];
    struct rig_buffer draws; // of all steps
};

static void open_drawing(struct drawing *d, const struct plan *plan, enum way way)
{
    struct picture_state state;
    rig_open(&d->rig);
    picture_init(&d->picture, &d->rig, true, way == SAMPLES ? VK_SAMPLE_COUNT_4_BIT : VK_SAMPLE_COUNT_1_BIT);
    d->layout = rig_layout(&d->rig, NULL, 0, 36);
    picture_state(&state, &d->picture, rig_shader(&d->rig, quad_vert, sizeof quad_vert),
                  rig_shader(&d->rig, shade_frag, sizeof shade_frag), d->layout);
    state.dynamic[state.dynamics.dynamicStateCount++] = VK_DYNAMIC_STATE_STENCIL_REFERENCE;
    for (int i = 0; i < PIPELINES; i++) {
        state.depth = plan->depth[i];
        state.blend[0] = plan->blend[i];
        state.rasterization.cullMode = plan->cull[i];
        d->pipelines[i] = picture_pipeline(&d->picture, &state, d->picture.pass, 0);
    }
    d->draws = rig_buffer(&d->rig, STEPS * sizeof(VkDrawIndirectCommand), NULL);
    for (int i = 0; i < STEPS; i++) {
        ((VkDrawIndirectCommand *)d->draws.bytes)[i] = plan->steps[i].draw;
    }
}

static void record(const struct drawing *d, const struct plan *plan, enum way way, VkCommandBuffer commands,
                   int first, int end)
{
    const VkViewport viewport = {.width = SIZE, .height = SIZE, .maxDepth = 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    for (int i = first; i < end; i++) {
        const struct step *const step = &plan->steps[i];
        const VkDrawIndirectCommand *const draw = &step->draw;
        if (step->clears) {
            vkCmdClearAttachments(commands, 1, &step->clear, 1, &step->rectangle);
            continue;
        }
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, d->pipelines[step->pipeline]);
        vkCmdSetScissor(commands, 0, 1, &step->scissor);
        vkCmdSetStencilReference(commands, VK_STENCIL_FACE_FRONT_AND_BACK, step->reference);
        vkCmdPushConstants(commands, d->layout, VK_SHADER_STAGE_ALL, 0, sizeof step->push, step->push);
        if (way == INDIRECT) {
            vkCmdDrawIndirect(commands, d->draws.buffer, (VkDeviceSize)i * sizeof *draw, 1, 0);
        } else {
            vkCmdDraw(commands, draw->vertexCount, draw->instanceCount, draw->firstVertex,
                      draw->firstInstance);
        }
    }
}

// Record both halves of the steps in secondary command buffers.
static void record_secondary(struct drawing *d, const struct plan *plan)
{
    const VkCommandBufferAllocateInfo allocate = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  .commandPool = d->rig.pool,
                                                  .level = VK_COMMAND_BUFFER_LEVEL_SECONDARY,
                                                  .commandBufferCount = 2};
    const VkCommandBufferInheritanceInfo inherited = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_INHERITANCE_INFO, .renderPass = d->picture.pass};
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_RENDER_PASS_CONTINUE_BIT,
                                            .pInheritanceInfo = &inherited};
    VkCommandBuffer halves[2];
    CHECK(vkAllocateCommandBuffers(d->rig.device, &allocate, halves));
    for (int i = 0; i < 2; i++) {
        CHECK(vkBeginCommandBuffer(halves[i], &begin));
        record(d, plan, SECONDARY, halves[i], i * STEPS / 2, (i + 1) * STEPS / 2);
        CHECK(vkEndCommandBuffer(halves[i]));
    }
    vkCmdExecuteCommands(d->rig.commands, 2, halves);
}

static void draw_plan(const struct plan *plan, enum way way, uint8_t texels[4 * PICTURE_TEXELS])
{
    struct drawing d;
    open_drawing(&d, plan, way);
    const VkClearValue red = {.color = {.float32 = {0.25f, 0, 0, 1}}}, far = {.depthStencil = {1, 0}};
    const VkClearValue clears[] = {red, far, red};
    const VkRenderPassBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                         .renderPass = d.picture.pass,
                                         .framebuffer = d.picture.framebuffer,
                                         .renderArea = {.extent = {SIZE, SIZE}},
                                         .clearValueCount = 3,
                                         .pClearValues = clears};
    const bool is_secondary = way == SECONDARY;
    vkCmdBeginRenderPass(d.rig.commands, &begin,
                         is_secondary ? VK_SUBPASS_CONTENTS_SECONDARY_COMMAND_BUFFERS
                                      : VK_SUBPASS_CONTENTS_INLINE);
    if (is_secondary) {
        record_secondary(&d, plan);
    } else {
        record(&d, plan, way, d.rig.commands, 0, STEPS);
    }
    picture_end(&d.picture);
    memcpy(texels, d.picture.texels, 4 * PICTURE_TEXELS);
    rig_close(&d.rig);
}

static void all_ways_draw_one_picture(void **state)
{
    (void)state;
    static uint8_t pictures[WAYS][4 * PICTURE_TEXELS];
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        struct plan plan;
        pick_plan(seed, &plan);
        for (int way = 0; way < WAYS; way++) {
            draw_plan(&plan, (enum way)way, pictures[way]);
            if (memcmp(pictures[way], pictures[INLINE], sizeof pictures[way]) != 0) {
                fail_msg("seed %d, way %d: another picture", (int)seed, way);
            }
        }
    }
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(all_ways_draw_one_picture)};

const struct unit_tests test_vulkan_random = UNIT_TESTS(tests, NULL, NULL);
