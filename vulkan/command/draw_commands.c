// SPDX-License-Identifier: MIT
// Draws. Each tells the pass of librhw what was bound since the last one, and opens the pass if there is none.
#include "pipeline/pipeline_state.h"
#include "shader_input.h"
#include <string.h>

// Telling --------------------------------------------------------------------------------------------

// Return whether the pipeline that was created for a variant draws into the targets of the pass.
static bool is_for_pass(const struct vulkan_variant *variant, bool fits, const struct vulkan_targets *targets)
{
    return variant->is_adapted ? !fits && vulkan_targets_are_equal(&variant->targets, targets) : fits;
}

// Create the pipeline of librhw for a view and the targets of the pass. Return false if that fails.
static bool create_pipeline(struct vulkan_replay *replay, VkPipeline pipeline, uint32_t view, bool fits)
{
    struct vulkan_variant *const variant = &pipeline->variants[view];
    struct rhw_pipeline_def def;
    vulkan_pipeline_definition(pipeline, view, &def);
    if (!fits) {
        vulkan_targets_adapt(&replay->pass.targets, &def);
        vulkan_log("a pipeline draws into other attachments than those that it was created for");
    }
    const enum rhw_result result = rhw_pipeline_create(replay->context, &def, &variant->pipeline);
    variant->is_adapted = !fits;
    variant->targets = replay->pass.targets;
    if (vulkan_replay_check(replay, result, "a graphics pipeline")) {
        return true;
    }
    if (fits) { // it could be made when it was checked
        replay->result = VK_ERROR_DEVICE_LOST;
    }
    return false;
}

// Create the pipeline of librhw for the pass that is open, if it is not there. Return NULL if that fails.
static const rhw_pipeline *find_pipeline(struct vulkan_replay *replay, VkPipeline pipeline)
{
    const uint32_t view = pipeline->variant_count > 1 ? replay->pass.view_index : 0;
    struct vulkan_variant *const variant = view < pipeline->variant_count ? &pipeline->variants[view] : NULL;
    if (!variant || !variant->program) {
        vulkan_log("draws are left out: their pipeline has no view %u", view);
        return NULL;
    }
    const struct vulkan_targets *const targets = &replay->pass.targets;
    const bool fits = vulkan_targets_fit(targets, &pipeline->def);
    if (variant->pipeline.generation != 0 && !is_for_pass(variant, fits, targets)) {
        rhw_pipeline_destroy(replay->context, variant->pipeline);
        variant->pipeline = (rhw_pipeline){0};
    }
    const bool is_there = variant->pipeline.generation != 0 || create_pipeline(replay, pipeline, view, fits);
    return is_there ? &variant->pipeline : NULL;
}

// Tell the pass of the pipeline. Return false if there is none for it.
static bool tell_pipeline(struct vulkan_replay *replay, VkPipeline pipeline)
{
    const rhw_pipeline *const id = find_pipeline(replay, pipeline);
    if (id) {
        rhw_pass_set_pipeline(replay->context, replay->pass.pass, *id);
        replay->bound.news &= ~(uint32_t)VULKAN_NEWS_PIPELINE;
    }
    return id;
}

static void tell_dynamic(struct vulkan_replay *replay, VkPipeline pipeline, bool is_new)
{
    struct vulkan_bound *const bound = &replay->bound;
    uint32_t parts = bound->news_dynamic & pipeline->dynamic;
    if (is_new) {
        vulkan_dynamic_copy(&bound->dynamic, &pipeline->state, VULKAN_DYNAMIC_ALL & ~pipeline->dynamic);
        parts = VULKAN_DYNAMIC_ALL;
    }
    if (!pipeline->has_depth_bias && (parts & VULKAN_DYNAMIC_DEPTH_BIAS)) {
        parts &= ~(uint32_t)VULKAN_DYNAMIC_DEPTH_BIAS;
        const struct rhw_depth_bias none = {.constant = 0};
        rhw_pass_set_depth_bias(replay->context, replay->pass.pass, &none);
    }
    if (!pipeline->has_line_stipple && (parts & VULKAN_DYNAMIC_LINE_STIPPLE)) {
        parts &= ~(uint32_t)VULKAN_DYNAMIC_LINE_STIPPLE;
        const struct rhw_line_stipple none = {.factor = 0};
        rhw_pass_set_line_stipple(replay->context, replay->pass.pass, &none);
    }
    vulkan_dynamic_apply(&bound->dynamic, parts, replay->context, replay->pass.pass);
    bound->news_dynamic &= ~parts;
}

// Return why nothing is read from a buffer.
static const char *why_nothing(VkBuffer buffer)
{
    return !buffer ? "no buffer is bound" : !buffer->bytes ? "it has no memory" : "they begin behind its end";
}

static void tell_vertices(struct vulkan_replay *replay, VkPipeline pipeline)
{
    struct vulkan_bound *const bound = &replay->bound;
    const uint32_t slots = bound->news_vertices & pipeline->vertex_buffers;
    for (int i = 0; i < RHW_MAX_VERTEX_BUFFERS; i++) {
        if (slots >> i & 1) {
            VkBuffer buffer = bound->vertices[i].buffer;
            const VkDeviceSize offset = bound->vertices[i].offset;
            const bool is_there = buffer && buffer->bytes && offset < buffer->size;
            if (!is_there) {
                vulkan_log("vertices from buffer %d are zeros: %s", i, why_nothing(buffer));
            }
            rhw_pass_set_vertex_memory(replay->context, replay->pass.pass, i,
                                       is_there ? buffer->bytes + offset : NULL,
                                       is_there ? (size_t)(buffer->size - offset) : 0);
        }
    }
    bound->news_vertices &= ~slots;
}

static void tell_indices(struct vulkan_replay *replay)
{
    struct vulkan_bound *const bound = &replay->bound;
    VkBuffer buffer = bound->indices;
    const bool is_there = buffer && buffer->bytes && bound->index_offset < buffer->size;
    if (!is_there) {
        vulkan_log("all indices are zeros: %s", why_nothing(buffer));
    }
    rhw_pass_set_index_memory(replay->context, replay->pass.pass,
                              is_there ? buffer->bytes + bound->index_offset : NULL,
                              bound->index_type == VK_INDEX_TYPE_UINT16      ? RHW_INDEX_UINT16
                              : bound->index_type == VK_INDEX_TYPE_UINT8_EXT ? RHW_INDEX_UINT8
                                                                             : RHW_INDEX_UINT32,
                              is_there ? (size_t)(buffer->size - bound->index_offset) : 0);
    bound->news &= ~(uint32_t)VULKAN_NEWS_INDICES;
}

// Return false without memory.
static bool tell_shaders(struct vulkan_replay *replay, VkPipeline pipeline, bool is_new)
{
    struct vulkan_bound *const bound = &replay->bound;
    // A pipeline that is new may use bindings of a set that were stale up to now.
    const uint32_t sets = (is_new ? ~0u : bound->news_sets) & pipeline->used_sets;
    const bool pushes = pipeline->push_size > 0 && (is_new || (bound->news & VULKAN_NEWS_PUSH));
    if (sets == 0 && !pushes && !is_new) {
        return true;
    }
    if (!vulkan_shader_input_sets(replay, &bound->graphics, sets, &bound->frame) ||
        (pushes && !vulkan_shader_input_push(replay, pipeline->push_size, &bound->frame))) {
        return false;
    }
    bound->frame.samples = replay->pass.samples;
    rhw_pass_set_uniforms(replay->context, replay->pass.pass, &bound->frame, sizeof bound->frame);
    bound->news_sets &= ~sets;
    bound->news &= ~(uint32_t)(pushes ? VULKAN_NEWS_PUSH : 0);
    return true;
}

// Open the pass and tell it what is bound. Return false if nothing can be drawn.
static bool begin_draw(struct vulkan_replay *replay, bool is_indexed)
{
    struct vulkan_bound *const bound = &replay->bound;
    VkPipeline pipeline = bound->graphics.pipeline;
    if (!pipeline || !replay->pass.render_pass) {
        vulkan_log("a draw is left out: %s",
                   replay->pass.render_pass ? "no pipeline is bound" : "no render pass has begun");
        return false;
    }
    if (!vulkan_pass_open(replay, pipeline->samples)) {
        return false;
    }
    if (!bound->is_told) {
        bound->is_told = true;
        bound->news = VULKAN_NEWS_ALL;
        bound->news_sets = bound->news_vertices = ~0u;
    }
    const bool is_new = bound->news & VULKAN_NEWS_PIPELINE;
    if (is_new && !tell_pipeline(replay, pipeline)) {
        return false;
    }
    tell_dynamic(replay, pipeline, is_new);
    tell_vertices(replay, pipeline);
    if (is_indexed && (bound->news & VULKAN_NEWS_INDICES)) {
        tell_indices(replay);
    }
    if (!tell_shaders(replay, pipeline, is_new)) {
        return false;
    }
    vulkan_feedback_resume(replay);
    return true;
}

// Direct draws ---------------------------------------------------------------------------------------

struct draw {
    struct vulkan_command command;
    VkDrawIndirectCommand draw;
};

// Tell shaders that read them a draw's base vertex, first instance and number. Return false without memory.
static bool tell_numbers(struct vulkan_replay *replay, uint32_t vertex, uint32_t instance, uint32_t number)
{
    struct vulkan_bound *const bound = &replay->bound;
    if (!bound->graphics.pipeline->reads_draw) {
        return true;
    }
    if (!vulkan_shader_input_draw(replay, (const uint32_t[3]){vertex, instance, number}, &bound->frame)) {
        return false;
    }
    rhw_pass_set_uniforms(replay->context, replay->pass.pass, &bound->frame, sizeof bound->frame);
    return true;
}

static void draw(struct vulkan_replay *replay, const VkDrawIndirectCommand *draw, uint32_t number)
{
    if (!tell_numbers(replay, draw->firstVertex, draw->firstInstance, number)) {
        return;
    }
    rhw_pass_draw(replay->context, replay->pass.pass, draw->firstVertex, draw->vertexCount,
                  draw->firstInstance, draw->instanceCount);
}

static void replay_draw(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    if (begin_draw(replay, false)) {
        draw(replay, &((const struct draw *)command)->draw, 0);
    }
}

void vkCmdDraw(VkCommandBuffer buffer, uint32_t count, uint32_t instances, uint32_t first,
               uint32_t first_instance)
{
    struct draw *const record = vulkan_record(buffer, sizeof *record, replay_draw);
    if (record) {
        record->draw = (VkDrawIndirectCommand){count, instances, first, first_instance};
    }
}

struct draw_indexed {
    struct vulkan_command command;
    VkDrawIndexedIndirectCommand draw;
};

static void draw_indexed(struct vulkan_replay *replay, const VkDrawIndexedIndirectCommand *draw,
                         uint32_t number)
{
    if (!tell_numbers(replay, (uint32_t)draw->vertexOffset, draw->firstInstance, number)) {
        return;
    }
    rhw_pass_draw_indexed(replay->context, replay->pass.pass, draw->firstIndex, draw->indexCount,
                          draw->vertexOffset, draw->firstInstance, draw->instanceCount);
}

static void replay_draw_indexed(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    if (begin_draw(replay, true)) {
        draw_indexed(replay, &((const struct draw_indexed *)command)->draw, 0);
    }
}

void vkCmdDrawIndexed(VkCommandBuffer buffer, uint32_t count, uint32_t instances, uint32_t first,
                      int32_t vertex_offset, uint32_t first_instance)
{
    struct draw_indexed *const record = vulkan_record(buffer, sizeof *record, replay_draw_indexed);
    if (record) {
        record->draw = (VkDrawIndexedIndirectCommand){count, instances, first, vertex_offset, first_instance};
    }
}

// Indirect draws -------------------------------------------------------------------------------------

struct draw_indirect {
    struct vulkan_command command;
    VkBuffer buffer;
    VkDeviceSize offset;
    uint32_t count, stride;
};

// Return the place of a command of `size` bytes, or NULL if it does not lie within its buffer. A sum is made where it
// is known to stay below the buffer's size, so that none wraps around to bytes in front of the offset.
static const void *find_command(const struct draw_indirect *record, uint32_t index, size_t size)
{
    const VkDeviceSize room = record->buffer->bytes ? record->buffer->size : 0;
    const VkDeviceSize step = (VkDeviceSize)index * record->stride; // two factors of 32 bits
    const VkDeviceSize left = record->offset < room ? room - record->offset : 0;
    if (step > left || size > left - step) {
        vulkan_log("indirect draws are left out: number %u, %llu bytes behind %llu, is not within the %llu "
                   "of its buffer",
                   index, (unsigned long long)step, (unsigned long long)record->offset,
                   (unsigned long long)room);
        return NULL;
    }
    return record->buffer->bytes + record->offset + step;
}

static void replay_draw_indirect(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct draw_indirect *const record = (const struct draw_indirect *)command;
    VkDrawIndirectCommand read;
    if (!begin_draw(replay, false)) {
        return;
    }
    for (uint32_t i = 0; i < record->count; i++) {
        const void *const place = find_command(record, i, sizeof read);
        if (!place) {
            return; // the next command would lie further behind
        }
        memcpy(&read, place, sizeof read);
        draw(replay, &read, i);
    }
}

static void replay_draw_indexed_indirect(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct draw_indirect *const record = (const struct draw_indirect *)command;
    VkDrawIndexedIndirectCommand read;
    if (!begin_draw(replay, true)) {
        return;
    }
    for (uint32_t i = 0; i < record->count; i++) {
        const void *const place = find_command(record, i, sizeof read);
        if (!place) {
            return; // the next command would lie further behind
        }
        memcpy(&read, place, sizeof read);
        draw_indexed(replay, &read, i);
    }
}

static void record_indirect(VkCommandBuffer buffer, vulkan_replay_function *replay, VkBuffer commands,
                            VkDeviceSize offset, uint32_t count, uint32_t stride)
{
    struct draw_indirect *const record = vulkan_record(buffer, sizeof *record, replay);
    if (record) {
        record->buffer = commands;
        record->offset = offset;
        record->count = count;
        record->stride = stride;
    }
}

// A draw of as many vertices as transform feedback has written: a counter says how many bytes.
struct draw_counted {
    struct vulkan_command command;
    VkBuffer buffer;
    VkDeviceSize offset;
    uint32_t counter_offset, stride;
    uint32_t instances, first_instance;
};

static void replay_draw_counted(struct vulkan_replay *replay, const struct vulkan_command *command)
{
    const struct draw_counted *const record = (const struct draw_counted *)command;
    uint32_t bytes;
    if (vulkan_buffer_range(record->buffer, record->offset, VK_WHOLE_SIZE) < sizeof bytes) {
        vulkan_log("vkCmdDrawIndirectByteCountEXT: a draw is left out, whose counter lies behind its buffer");
        return;
    }
    if (record->stride == 0) {
        vulkan_log("vkCmdDrawIndirectByteCountEXT: a draw is left out, whose vertices have a stride of 0");
        return;
    }
    memcpy(&bytes, record->buffer->bytes + record->offset, sizeof bytes);
    const uint32_t left = bytes > record->counter_offset ? bytes - record->counter_offset : 0;
    const VkDrawIndirectCommand counted = {left / record->stride, record->instances, 0,
                                           record->first_instance};
    if (begin_draw(replay, false)) {
        draw(replay, &counted, 0);
    }
}

void vkCmdDrawIndirectByteCountEXT(VkCommandBuffer buffer, uint32_t instances, uint32_t first_instance,
                                   VkBuffer counter, VkDeviceSize offset, uint32_t counter_offset,
                                   uint32_t stride)
{
    struct draw_counted *const record = vulkan_record(buffer, sizeof *record, replay_draw_counted);
    if (record) {
        record->buffer = counter;
        record->offset = offset;
        record->counter_offset = counter_offset;
        record->stride = stride;
        record->instances = instances;
        record->first_instance = first_instance;
    }
}

void vkCmdDrawIndirect(VkCommandBuffer buffer, VkBuffer commands, VkDeviceSize offset, uint32_t count,
                       uint32_t stride)
{
    record_indirect(buffer, replay_draw_indirect, commands, offset, count, stride);
}

void vkCmdDrawIndexedIndirect(VkCommandBuffer buffer, VkBuffer commands, VkDeviceSize offset, uint32_t count,
                              uint32_t stride)
{
    record_indirect(buffer, replay_draw_indexed_indirect, commands, offset, count, stride);
}
