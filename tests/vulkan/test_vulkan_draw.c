// SPDX-License-Identifier: MIT
// Draws: vertices, indices, instances, and what the state of a pipeline does with them.
#include <rhw/rhw.h>
#include <rhw/spirv.h>
#include <string.h>

#include "half_vert.h"
#include "place_vert.h"
#include "quad_vert.h"
#include "shade_frag.h"
#include "vulkan_picture.h"

enum { RED = 0x40000000 + 0xff }; // the colour that a picture begins with

struct vertex {
    float x, y;
    uint8_t color[4];
};

static const struct vertex triangle[] = {
    {-0.9f, -0.8f, {255, 0, 0, 255}}, {0.7f, -0.3f, {0, 255, 0, 255}}, {-0.1f, 0.9f, {0, 0, 255, 255}}};
static const float matrix[16] = {0.9f, 0.1f, 0, 0, -0.2f, 1, 0, 0, 0, 0, 1, 0, 0.1f, 0, 0, 1.2f};

// What a push block of quad.vert has.
struct quad {
    float rectangle[4], color[4], depth;
};

// Attributes of struct vertex.
static void describe_vertices(struct picture_state *state)
{
    state->buffers[0] =
        (VkVertexInputBindingDescription){0, sizeof(struct vertex), VK_VERTEX_INPUT_RATE_VERTEX};
    state->attributes[0] = (VkVertexInputAttributeDescription){0, 0, VK_FORMAT_R32G32_SFLOAT, 0};
    state->attributes[1] =
        (VkVertexInputAttributeDescription){1, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(struct vertex, color)};
    state->input.vertexBindingDescriptionCount = 1;
    state->input.vertexAttributeDescriptionCount = 2;
}

// The triangle, drawn by librhw -----------------------------------------------------------------------

static rhw_shader *shader_of(enum rhw_shader_stage stage, const uint32_t *words, size_t size)
{
    rhw_shader *shader;
    assert_int_equal(rhw_shader_create(words, size, &(struct rhw_shader_def){.stage = stage}, &shader, NULL),
                     RHW_OK);
    return shader;
}

static void draw_by_librhw(uint8_t *texels)
{
    rhw_context *context;
    rhw_texture texture;
    rhw_pipeline pipeline;
    rhw_pass pass;
    struct rhw_context_def context_def = rhw_context_def_default();
    context_def.threads = 1;
    assert_int_equal(rhw_context_create(&context_def, &context), RHW_OK);
    rhw_shader *const vertex = shader_of(RHW_SHADER_VERTEX, place_vert, sizeof place_vert);
    rhw_shader *const fragment = shader_of(RHW_SHADER_FRAGMENT, shade_frag, sizeof shade_frag);
    rhw_shader_program *program;
    assert_int_equal(
        rhw_shader_program_create(&(struct rhw_shader_program_def){.vertex = vertex, .fragment = fragment},
                                  &program, NULL),
        RHW_OK);
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = *rhw_shader_program_get(program);
    def.attribute_count = 2;
    def.attributes[0].format = RHW_VERTEX_FLOAT2;
    def.attributes[1] =
        (struct rhw_attribute){.format = RHW_VERTEX_UNORM8X4, .offset = offsetof(struct vertex, color)};
    def.buffer_count = 1;
    def.buffers[0].stride = sizeof(struct vertex);
    assert_int_equal(rhw_pipeline_create(context, &def, &pipeline), RHW_OK);
    struct rhw_texture_def texture_def = rhw_texture_def_default();
    texture_def.width = texture_def.height = PICTURE_SIZE;
    assert_int_equal(rhw_texture_create(context, &texture_def, &texture), RHW_OK);
    struct rhw_pass_def pass_def = {.color_count = 1};
    pass_def.colors[0] =
        (struct rhw_color_attachment){.texture = texture, .load = RHW_LOAD_CLEAR, .clear = {0.25f, 0, 0, 1}};
    struct rhw_binding binding;
    assert_true(rhw_binding_of_memory((void *)matrix, sizeof matrix, true, &binding));
    const struct rhw_shader_frame frame = {.sets = {&binding}};
    const struct rhw_viewport viewport = {.y = PICTURE_SIZE, .width = PICTURE_SIZE, .height = -PICTURE_SIZE};
    assert_int_equal(rhw_pass_begin(context, &pass_def, &pass), RHW_OK);
    rhw_pass_set_viewport(context, pass, &viewport);
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_uniforms(context, pass, &frame, sizeof frame);
    rhw_pass_set_vertex_memory(context, pass, 0, triangle, sizeof triangle);
    rhw_pass_draw(context, pass, 0, 3, 0, 1);
    assert_int_equal(rhw_pass_end(context, pass, NULL), RHW_OK);
    assert_int_equal(rhw_texture_read(context, texture, 0, texels, 0), RHW_OK);
    rhw_context_destroy(context);
    rhw_shader_program_destroy(program);
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
}

static void a_triangle_has_the_bytes_of_librhw(void **state)
{
    (void)state;
    struct rig rig;
    struct picture picture;
    struct picture_state pipeline_state;
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    const VkDescriptorSetLayoutBinding binding = {.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                                  .descriptorCount = 1,
                                                  .stageFlags = VK_SHADER_STAGE_VERTEX_BIT};
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, &binding, 1);
    VkPipelineLayout layout = rig_layout(&rig, &set_layout, 1, 0);
    picture_state(&pipeline_state, &picture, rig_shader(&rig, place_vert, sizeof place_vert),
                  rig_shader(&rig, shade_frag, sizeof shade_frag), layout);
    describe_vertices(&pipeline_state);
    VkPipeline pipeline = picture_pipeline(&picture, &pipeline_state, picture.pass, 0);
    const struct rig_buffer uniforms = rig_buffer(&rig, sizeof matrix, matrix);
    const struct rig_buffer vertices = rig_buffer(&rig, sizeof triangle, triangle);
    VkDescriptorSet set = rig_set(&rig, set_layout);
    rig_bind_buffer(&rig, set, 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, uniforms.buffer, 0, VK_WHOLE_SIZE);
    picture_begin(&picture);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdBindDescriptorSets(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &set, 0, NULL);
    vkCmdBindVertexBuffers(rig.commands, 0, 1, &vertices.buffer, &(VkDeviceSize){0});
    vkCmdDraw(rig.commands, 3, 1, 0, 0);
    picture_end(&picture);
    static uint8_t expected[4 * PICTURE_TEXELS];
    draw_by_librhw(expected);
    assert_memory_equal(picture.texels, expected, sizeof expected);
    assert_int_not_equal(picture_texel(&picture, 30, 30), RED);
    rig_close(&rig);
}

// Rectangles -----------------------------------------------------------------------------------------

// Open a rig with a picture, and fill the state of a pipeline that draws quads by push constants.
static void begin_quads(struct rig *rig, struct picture *picture, struct picture_state *state, bool has_depth,
                        VkSampleCountFlagBits samples)
{
    rig_open(rig);
    picture_init(picture, rig, has_depth, samples);
    picture_state(state, picture, rig_shader(rig, quad_vert, sizeof quad_vert),
                  rig_shader(rig, shade_frag, sizeof shade_frag),
                  rig_layout(rig, NULL, 0, sizeof(struct quad)));
}

// Push a rectangle in pixels.
static void push_quad(const struct picture_state *state, const struct picture *picture, int x0, int y0,
                      int x1, int y1, uint32_t color, float depth)
{
    const float scale = 2.0f / PICTURE_SIZE;
    const struct quad quad = {.rectangle = {(float)x0 * scale - 1, (float)y0 * scale - 1,
                                            (float)x1 * scale - 1, (float)y1 * scale - 1},
                              .color = {(float)(color >> 24) / 255, (float)(color >> 16 & 255) / 255,
                                        (float)(color >> 8 & 255) / 255, (float)(color & 255) / 255},
                              .depth = depth};
    vkCmdPushConstants(picture->rig->commands, state->layout, VK_SHADER_STAGE_ALL, 0, sizeof quad, &quad);
}

static void draw_quad(const struct picture_state *state, const struct picture *picture, int x0, int y0,
                      int x1, int y1, uint32_t color, float depth)
{
    push_quad(state, picture, x0, y0, x1, y1, color, depth);
    vkCmdDraw(picture->rig->commands, 6, 1, 0, 0);
}

static void bind(const struct rig *rig, VkPipeline pipeline)
{
    vkCmdBindPipeline(rig->commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
}

static void push_constants_change_from_draw_to_draw(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    begin_quads(&rig, &picture, &state, false, VK_SAMPLE_COUNT_1_BIT);
    VkPipeline pipeline = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    bind(&rig, pipeline);
    draw_quad(&state, &picture, 0, 0, 10, 20, 0x11223344, 0);
    draw_quad(&state, &picture, 5, 0, 20, 10, 0x55667788, 0);
    // A part of the block: the rest stays as it was.
    const float green[4] = {0, 1, 0, 1};
    vkCmdPushConstants(rig.commands, state.layout, VK_SHADER_STAGE_ALL, offsetof(struct quad, color),
                       sizeof green, green);
    vkCmdDraw(rig.commands, 6, 1, 0, 2); // instance 2: 8 pixels further right
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 4, 19), 0x11223344);
    assert_int_equal(picture_texel(&picture, 5, 9), 0x55667788);
    assert_int_equal(picture_texel(&picture, 12, 9), 0x55667788);
    assert_int_equal(picture_texel(&picture, 13, 9), 0x00ff00ff);
    assert_int_equal(picture_texel(&picture, 27, 0), 0x00ff00ff);
    assert_int_equal(picture_texel(&picture, 28, 0), RED);
    assert_int_equal(picture_texel(&picture, 10, 10), RED);
    rig_close(&rig);
}

static void depth_hides_what_is_behind(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    begin_quads(&rig, &picture, &state, true, VK_SAMPLE_COUNT_1_BIT);
    state.depth.depthTestEnable = state.depth.depthWriteEnable = VK_TRUE;
    state.depth.depthCompareOp = VK_COMPARE_OP_LESS;
    VkPipeline writes = picture_pipeline(&picture, &state, picture.pass, 0);
    state.depth.depthWriteEnable = VK_FALSE;
    state.depth.depthCompareOp = VK_COMPARE_OP_GREATER;
    VkPipeline reads = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    bind(&rig, writes);
    draw_quad(&state, &picture, 0, 0, 20, 20, 0x010101ff, 0.5f);
    draw_quad(&state, &picture, 10, 0, 30, 20, 0x020202ff, 0.75f);
    draw_quad(&state, &picture, 0, 10, 20, 30, 0x030303ff, 0.25f);
    bind(&rig, reads);
    draw_quad(&state, &picture, 0, 0, 64, 64, 0x040404ff, 0.6f); // where depth is 0.5 or 0.25
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 5, 5), 0x040404ff);
    assert_int_equal(picture_texel(&picture, 25, 5), 0x020202ff);
    assert_int_equal(picture_texel(&picture, 15, 15), 0x040404ff);
    assert_int_equal(picture_texel(&picture, 40, 40), RED);
    rig_close(&rig);
}

static void blending_weighs_both_colours(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    begin_quads(&rig, &picture, &state, false, VK_SAMPLE_COUNT_1_BIT);
    state.blend[0] =
        (VkPipelineColorBlendAttachmentState){.blendEnable = VK_TRUE,
                                              .srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA,
                                              .dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                              .srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO,
                                              .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .colorWriteMask = 15};
    VkPipeline over = picture_pipeline(&picture, &state, picture.pass, 0);
    state.blend[0].srcColorBlendFactor = VK_BLEND_FACTOR_CONSTANT_COLOR;
    state.blend[0].dstColorBlendFactor = VK_BLEND_FACTOR_ZERO;
    state.blend[0].colorBlendOp = VK_BLEND_OP_ADD;
    state.blend[0].colorWriteMask = VK_COLOR_COMPONENT_G_BIT;
    state.dynamic[2] = VK_DYNAMIC_STATE_BLEND_CONSTANTS;
    state.dynamics.dynamicStateCount = 3;
    VkPipeline constant = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    bind(&rig, over);
    draw_quad(&state, &picture, 0, 0, 32, 32, 0x00ff0033, 0); // alpha 1/5
    bind(&rig, constant);
    vkCmdSetBlendConstants(rig.commands, (const float[4]){1, 0.2f, 1, 1});
    draw_quad(&state, &picture, 32, 0, 64, 32, 0xffffffff, 0);
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 5, 5), 0x333300ff); // 0.25 · 0.8, 0.2
    assert_int_equal(picture_texel(&picture, 40, 5), RED + 0x330000);
    rig_close(&rig);
}

static void sides_are_told_by_the_order_on_the_screen(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    begin_quads(&rig, &picture, &state, false, VK_SAMPLE_COUNT_1_BIT);
    // The first triangle goes right, then down: clockwise on the screen.
    state.rasterization.cullMode = VK_CULL_MODE_BACK_BIT;
    state.rasterization.frontFace = VK_FRONT_FACE_CLOCKWISE;
    VkPipeline shown = picture_pipeline(&picture, &state, picture.pass, 0);
    state.rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    VkPipeline hidden = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    bind(&rig, shown);
    draw_quad(&state, &picture, 0, 0, 10, 10, 0x010101ff, 0);
    bind(&rig, hidden);
    draw_quad(&state, &picture, 10, 0, 20, 10, 0x020202ff, 0);
    // A viewport of negative height turns the picture over, and the sides with it.
    const VkViewport turned = {
        .y = PICTURE_SIZE, .width = PICTURE_SIZE, .height = -PICTURE_SIZE, .maxDepth = 1};
    vkCmdSetViewport(rig.commands, 0, 1, &turned);
    draw_quad(&state, &picture, 20, 0, 30, 10, 0x030303ff, 0);
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 5, 5), 0x010101ff);
    assert_int_equal(picture_texel(&picture, 15, 5), RED);
    assert_int_equal(picture_texel(&picture, 25, 58), 0x030303ff);
    rig_close(&rig);
}

static void dynamic_state_is_that_of_the_last_command(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    begin_quads(&rig, &picture, &state, true, VK_SAMPLE_COUNT_1_BIT);
    const VkStencilOpState replaces = {.passOp = VK_STENCIL_OP_REPLACE,
                                       .compareOp = VK_COMPARE_OP_ALWAYS,
                                       .compareMask = 255,
                                       .writeMask = 255};
    state.depth.stencilTestEnable = VK_TRUE;
    state.depth.front = state.depth.back = replaces;
    state.dynamic[2] = VK_DYNAMIC_STATE_STENCIL_REFERENCE;
    state.dynamic[3] = VK_DYNAMIC_STATE_STENCIL_WRITE_MASK;
    state.dynamics.dynamicStateCount = 4;
    VkPipeline writes = picture_pipeline(&picture, &state, picture.pass, 0);
    state.depth.front.compareOp = state.depth.back.compareOp = VK_COMPARE_OP_EQUAL;
    state.depth.front.passOp = state.depth.back.passOp = VK_STENCIL_OP_KEEP;
    state.depth.front.reference = state.depth.back.reference = 5;
    state.dynamics.dynamicStateCount = 2;
    VkPipeline tests = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    bind(&rig, writes);
    vkCmdSetStencilReference(rig.commands, VK_STENCIL_FACE_FRONT_AND_BACK, 7);
    vkCmdSetStencilWriteMask(rig.commands, VK_STENCIL_FACE_FRONT_AND_BACK, 5);
    draw_quad(&state, &picture, 0, 0, 10, 10, 0x010101ff, 0); // 5
    vkCmdSetStencilWriteMask(rig.commands, VK_STENCIL_FACE_FRONT_AND_BACK, 255);
    const VkRect2D narrow = {{10, 0}, {5, 64}};
    vkCmdSetScissor(rig.commands, 0, 1, &narrow);
    draw_quad(&state, &picture, 10, 0, 20, 10, 0x020202ff, 0); // 7, within the scissor
    const VkRect2D whole = {{0, 0}, {64, 64}};
    vkCmdSetScissor(rig.commands, 0, 1, &whole);
    bind(&rig, tests);
    draw_quad(&state, &picture, 0, 5, 64, 64, 0x030303ff, 0);
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 5, 2), 0x010101ff);
    assert_int_equal(picture_texel(&picture, 5, 8), 0x030303ff);
    assert_int_equal(picture_texel(&picture, 12, 8), 0x020202ff);
    assert_int_equal(picture_texel(&picture, 17, 8), RED);
    assert_int_equal(picture_texel(&picture, 30, 30), RED);
    rig_close(&rig);
}

static void samples_are_resolved(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    begin_quads(&rig, &picture, &state, false, VK_SAMPLE_COUNT_4_BIT);
    const VkSampleMask half = 3;
    VkPipeline whole = picture_pipeline(&picture, &state, picture.pass, 0);
    state.samples.pSampleMask = &half;
    VkPipeline masked = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    bind(&rig, whole);
    draw_quad(&state, &picture, 0, 0, 10, 10, 0x80ff00ff, 0);
    bind(&rig, masked);
    draw_quad(&state, &picture, 10, 0, 20, 10, 0x40ff00ff, 0);
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 5, 5), 0x80ff00ff);
    assert_int_equal(picture_texel(&picture, 15, 5), 0x408000ff); // the mean of two samples and two of red
    assert_int_equal(picture_texel(&picture, 25, 5), RED);
    rig_close(&rig);
}

static void draws_may_come_from_buffers(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    static const struct {
        uint32_t unused;
        VkDrawIndirectCommand draws[2];
        VkDrawIndexedIndirectCommand indexed;
        uint16_t indices[8];
    } given = {.draws = {{6, 1, 0, 0}, {6, 1, 0, 4}},
               .indexed = {6, 1, 2, 6, 8},
               .indices = {9, 9, 0, 1, 2, 3, 4, 5}}; // vertex 6 + i is vertex i
    begin_quads(&rig, &picture, &state, false, VK_SAMPLE_COUNT_1_BIT);
    VkPipeline pipeline = picture_pipeline(&picture, &state, picture.pass, 0);
    const struct rig_buffer buffer = rig_buffer(&rig, sizeof given, &given);
    picture_begin(&picture);
    bind(&rig, pipeline);
    vkCmdBindIndexBuffer(rig.commands, buffer.buffer,
                         (VkDeviceSize)((const char *)given.indices - (const char *)&given),
                         VK_INDEX_TYPE_UINT16);
    push_quad(&state, &picture, 0, 0, 10, 10, 0x010203ff, 0);
    vkCmdDrawIndirect(rig.commands, buffer.buffer, 4, 2, sizeof *given.draws);
    push_quad(&state, &picture, 0, 20, 10, 30, 0x040506ff, 0);
    vkCmdDrawIndexedIndirect(rig.commands, buffer.buffer, 4 + sizeof given.draws, 1, sizeof given.indexed);
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 5, 5), 0x010203ff);
    assert_int_equal(picture_texel(&picture, 12, 5), RED);
    assert_int_equal(picture_texel(&picture, 20, 5), 0x010203ff);
    assert_int_equal(picture_texel(&picture, 31, 25), RED);
    assert_int_equal(picture_texel(&picture, 35, 25), 0x040506ff);
    assert_int_equal(picture_texel(&picture, 5, 25), RED);
    rig_close(&rig);
}

static void vertices_outside_of_their_buffer_are_0(void **unused)
{
    (void)unused;
    // The first triangle covers the picture. Of the second one, two vertices lie behind the buffer; so do those that
    // indices name which are not there.
    static const struct vertex vertices[] = {{-1, -1, {255, 255, 255, 255}},
                                             {3, -1, {255, 255, 255, 255}},
                                             {-1, 3, {255, 255, 255, 255}},
                                             {-1, -1, {1, 2, 3, 255}}};
    static const uint32_t indices[] = {3, 4, 0xffffffff};
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    const VkDescriptorSetLayoutBinding binding = {.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                                  .descriptorCount = 1,
                                                  .stageFlags = VK_SHADER_STAGE_VERTEX_BIT};
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, &binding, 1);
    picture_state(&state, &picture, rig_shader(&rig, place_vert, sizeof place_vert),
                  rig_shader(&rig, shade_frag, sizeof shade_frag), rig_layout(&rig, &set_layout, 1, 0));
    describe_vertices(&state);
    VkPipeline pipeline = picture_pipeline(&picture, &state, picture.pass, 0);
    const struct rig_buffer buffer = rig_buffer(&rig, sizeof vertices, vertices);
    const struct rig_buffer index_buffer = rig_buffer(&rig, sizeof indices, indices);
    const struct rig_buffer uniforms = rig_buffer(&rig, sizeof identity, identity);
    VkDescriptorSet set = rig_set(&rig, set_layout);
    rig_bind_buffer(&rig, set, 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, uniforms.buffer, 0, VK_WHOLE_SIZE);
    picture_begin(&picture);
    bind(&rig, pipeline);
    vkCmdBindDescriptorSets(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, state.layout, 0, 1, &set, 0, NULL);
    vkCmdBindVertexBuffers(rig.commands, 0, 1, &buffer.buffer, &(VkDeviceSize){0});
    vkCmdBindIndexBuffer(rig.commands, index_buffer.buffer, 0, VK_INDEX_TYPE_UINT32);
    vkCmdDraw(rig.commands, 6, 1, 0, 0);
    vkCmdDraw(rig.commands, 3, 1, 0x7fffffff, 0);
    vkCmdDrawIndexed(rig.commands, 3, 1, 0, 0, 0);
    vkCmdDrawIndexed(rig.commands, 3, 1, 0, -100, 0);
    picture_end(&picture);
    for (int i = 0; i < PICTURE_SIZE; i++) {
        assert_int_equal(picture_texel(&picture, i, i), 0xffffffff); // what is 0 twice has no area
    }
    rig_close(&rig);
}

static void what_a_vertex_shader_does_not_store_is_0(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    picture_state(&state, &picture, rig_shader(&rig, half_vert, sizeof half_vert),
                  rig_shader(&rig, shade_frag, sizeof shade_frag), rig_layout(&rig, NULL, 0, 0));
    VkPipeline pipeline = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    bind(&rig, pipeline);
    vkCmdDraw(rig.commands, 3, 1, 0, 0);
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 5, 60), 0x00ff0000);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_triangle_has_the_bytes_of_librhw),
    cmocka_unit_test(push_constants_change_from_draw_to_draw),
    cmocka_unit_test(depth_hides_what_is_behind),
    cmocka_unit_test(blending_weighs_both_colours),
    cmocka_unit_test(sides_are_told_by_the_order_on_the_screen),
    cmocka_unit_test(dynamic_state_is_that_of_the_last_command),
    cmocka_unit_test(samples_are_resolved),
    cmocka_unit_test(draws_may_come_from_buffers),
    cmocka_unit_test(vertices_outside_of_their_buffer_are_0),
    cmocka_unit_test(what_a_vertex_shader_does_not_store_is_0),
};

const struct unit_tests test_vulkan_draw = UNIT_TESTS(tests, NULL, NULL);
