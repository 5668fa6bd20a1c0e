// SPDX-License-Identifier: MIT
#include "shader_input.h"
#include <string.h>

// Return the bindings of a set, in a copy where it has dynamic offsets, or NULL without memory.
static const struct rhw_binding *bindings_of(struct vulkan_replay *replay, VkDescriptorSet set,
                                             const uint32_t *offsets)
{
    if (set->layout->dynamic_count == 0) {
        return set->bindings;
    }
    struct rhw_binding *const copy =
        vulkan_replay_allocate(replay, set->layout->size * sizeof *set->bindings);
    if (copy) {
        vulkan_descriptor_set_offset(set, offsets, copy);
    }
    return copy;
}

// A set that has fewer bindings than the pipeline counts on has another layout, which Vulkan forbids.
static bool fits(VkPipeline pipeline, uint32_t number, VkDescriptorSet set)
{
    VkDescriptorSetLayout layout =
        number < pipeline->layout->set_count ? pipeline->layout->sets[number] : NULL;
    return set && layout && (set->layout == layout || set->layout->size >= layout->size);
}

bool vulkan_shader_input_sets(struct vulkan_replay *replay, const struct vulkan_bound_point *point,
                              uint32_t sets, struct rhw_shader_frame *frame)
{
    VkPipeline pipeline = point->pipeline;
    for (uint32_t i = 0; i < pipeline->used_count; i++) {
        const struct vulkan_used_binding *const used = &pipeline->used[i];
        VkDescriptorSet set = point->sets[used->set];
        if ((sets >> used->set & 1) && fits(pipeline, used->set, set) &&
            !vulkan_descriptor_set_freshen(replay->queue, set, used->first, used->count)) {
            (void)vulkan_replay_check(replay, RHW_ERROR_OUT_OF_MEMORY, "descriptors of a set");
            return false;
        }
    }
    for (uint32_t s = 0; s < VULKAN_MAX_SETS; s++) {
        if (!(sets >> s & 1)) {
            continue;
        }
        frame->sets[s] = NULL;
        if (fits(pipeline, s, point->sets[s])) {
            frame->sets[s] = bindings_of(replay, point->sets[s], point->offsets[s]);
            if (!frame->sets[s]) {
                return false;
            }
        } else {
            vulkan_log("shaders read nothing from set %u: %s", s,
                       point->sets[s] ? "it has fewer bindings than the pipeline's layout" : "none is bound");
        }
    }
    return true;
}

bool vulkan_shader_input_draw(struct vulkan_replay *replay, const uint32_t numbers[3],
                              struct rhw_shader_frame *frame)
{
    enum { SIZE = RHW_SHADER_DRAW_OFFSET + 3 * sizeof(uint32_t) };
    unsigned char *const copy = vulkan_replay_allocate(replay, SIZE);
    if (!copy) {
        return false;
    }
    memcpy(copy, replay->bound.push_constants, VULKAN_MAX_PUSH_SIZE);
    memcpy(copy + RHW_SHADER_DRAW_OFFSET, numbers, 3 * sizeof(uint32_t));
    frame->push_constants = copy;
    frame->push_size = SIZE;
    return true;
}

bool vulkan_shader_input_push(struct vulkan_replay *replay, uint32_t size, struct rhw_shader_frame *frame)
{
    frame->push_size = size < VULKAN_MAX_PUSH_SIZE ? size : VULKAN_MAX_PUSH_SIZE;
    if (frame->push_size == 0) {
        return true;
    }
    void *const copy = vulkan_replay_allocate(replay, frame->push_size);
    if (copy) {
        memcpy(copy, replay->bound.push_constants, frame->push_size);
    }
    frame->push_constants = copy;
    return copy;
}
