// SPDX-License-Identifier: MIT
// Pipelines and what they are made of: what is refused, what may be destroyed early, and allocations that fail.
#include <stdlib.h>
#include <string.h>

#include "coord_frag.h"
#include "place_vert.h"
#include "quad_vert.h"
#include "scale_comp.h"
#include "shade_frag.h"
#include "vulkan_picture.h"

enum { PUSH_SIZE = 36 };

// Push a rectangle of clip space, and draw it.
static void draw_quad(const struct rig *rig, VkPipelineLayout layout, const float values[9])
{
    vkCmdPushConstants(rig->commands, layout, VK_SHADER_STAGE_ALL, 0, PUSH_SIZE, values);
    vkCmdDraw(rig->commands, 6, 1, 0, 0);
}

static void what_a_pipeline_was_made_of_may_go(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    VkShaderModule modules[2];
    VkShaderModuleCreateInfo module = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                       .codeSize = sizeof quad_vert,
                                       .pCode = quad_vert};
    CHECK(vkCreateShaderModule(rig.device, &module, NULL, &modules[0]));
    module.codeSize = sizeof shade_frag;
    module.pCode = shade_frag;
    CHECK(vkCreateShaderModule(rig.device, &module, NULL, &modules[1]));
    VkPipelineLayout layout = rig_layout(&rig, NULL, 0, PUSH_SIZE);
    picture_state(&state, &picture, modules[0], modules[1], layout);
    VkPipeline pipeline = picture_pipeline(&picture, &state, picture.pass, 0);
    vkDestroyShaderModule(rig.device, modules[0], NULL);
    vkDestroyShaderModule(rig.device, modules[1], NULL);
    picture_begin(&picture);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    draw_quad(&rig, layout, (const float[9]){-1, -1, 1, 1, 0, 1, 0, 1});
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 30, 30), 0x00ff00ff);
    rig_close(&rig);
}

static void a_module_that_is_no_shader_is_refused(void **unused)
{
    (void)unused;
    struct rig rig;
    uint32_t words[sizeof scale_comp / sizeof *scale_comp];
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the fault, as it should
    }
    rig_open(&rig);
    memcpy(words, scale_comp, sizeof words);
    words[6] = 0x00ff00ff; // no instruction
    const VkDescriptorSetLayoutBinding bindings[] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL},
        {3, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL}};
    VkDescriptorSetLayout sets[2] = {rig_set_layout(&rig, bindings, 3), rig_set_layout(&rig, bindings, 2)};
    const VkComputePipelineCreateInfo good = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = rig_shader(&rig, scale_comp, sizeof scale_comp),
                  .pName = "main"},
        .layout = rig_layout(&rig, sets, 1, 0)};
    VkComputePipelineCreateInfo infos[4] = {good, good, good, good};
    infos[0].stage.module = rig_shader(&rig, words, sizeof words);
    infos[1].stage.pName = "nobody";
    infos[2].layout = rig_layout(&rig, &sets[1], 1, 0); // lacks a binding that the shader uses
    VkPipeline pipelines[4];
    assert_int_not_equal(vkCreateComputePipelines(rig.device, VK_NULL_HANDLE, 4, infos, NULL, pipelines),
                         VK_SUCCESS);
    assert_true(!pipelines[0] && !pipelines[1] && !pipelines[2]);
    assert_true(pipelines[3] != VK_NULL_HANDLE);
    RIG_KEEP(&rig, PIPELINE, pipelines[3]);
    rig_close(&rig);
}

// Samples --------------------------------------------------------------------------------------------

static void alpha_and_logic_reach_samples_and_bits(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_4_BIT);
    VkPipelineLayout layout = rig_layout(&rig, NULL, 0, PUSH_SIZE);
    picture_state(&state, &picture, rig_shader(&rig, quad_vert, sizeof quad_vert),
                  rig_shader(&rig, shade_frag, sizeof shade_frag), layout);
    state.samples.alphaToCoverageEnable = state.samples.alphaToOneEnable = VK_TRUE;
    VkPipeline covers = picture_pipeline(&picture, &state, picture.pass, 0);
    state.samples.alphaToCoverageEnable = state.samples.alphaToOneEnable = VK_FALSE;
    state.blends.logicOpEnable = VK_TRUE;
    state.blends.logicOp = VK_LOGIC_OP_XOR;
    VkPipeline inverts = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, covers);
    draw_quad(&rig, layout, (const float[9]){-1, -1, 0, 1, 0.75f, 1, 0, 0.5f}); // two of four samples
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, inverts);
    draw_quad(&rig, layout, (const float[9]){0, -1, 1, 1, 1, 1, 0, 0});
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 10, 30), 0x808000ff); // (191 + 64) / 2, rounded to even
    assert_int_equal(picture_texel(&picture, 50, 30), 0xbfff00ff);
    rig_close(&rig);
}

static void samples_are_shaded_one_by_one(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_4_BIT);
    VkPipelineLayout layout = rig_layout(&rig, NULL, 0, PUSH_SIZE);
    picture_state(&state, &picture, rig_shader(&rig, quad_vert, sizeof quad_vert),
                  rig_shader(&rig, coord_frag, sizeof coord_frag), layout);
    VkPipeline once = picture_pipeline(&picture, &state, picture.pass, 0);
    state.samples.sampleShadingEnable = VK_TRUE;
    state.samples.minSampleShading = 1;
    VkPipeline each = picture_pipeline(&picture, &state, picture.pass, 0);
    picture_begin(&picture);
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, once);
    draw_quad(&rig, layout, (const float[9]){-1, -1, 0, 1, 1, 1, 1, 1});
    vkCmdBindPipeline(rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, each);
    draw_quad(&rig, layout, (const float[9]){0, -1, 1, 1, 1, 1, 1, 1});
    picture_end(&picture);
    assert_int_equal(picture_texel(&picture, 10, 30), 0xffffffff);
    assert_int_equal(picture_texel(&picture, 50, 30), 0x80ffffff); // two of four lie right of the centre
    rig_close(&rig);
}

// Allocations ----------------------------------------------------------------------------------------

// The allocations that are left before one fails.
static int left;

static void *VKAPI_PTR allocate(void *user, size_t size, size_t alignment, VkSystemAllocationScope scope)
{
    (void)user;
    (void)scope;
    return left-- > 0 ? aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment) : NULL;
}

static void *VKAPI_PTR reallocate(void *user, void *old, size_t size, size_t alignment,
                                  VkSystemAllocationScope scope)
{
    (void)user;
    (void)old;
    (void)size;
    (void)alignment;
    (void)scope;
    return NULL;
}

static void VKAPI_PTR release(void *user, void *memory)
{
    (void)user;
    free(memory);
}

static const VkAllocationCallbacks callbacks = {
    .pfnAllocation = allocate, .pfnReallocation = reallocate, .pfnFree = release};

// Try a call with none, one … allocations until it succeeds. The last value of the call is that of `result`.
#define TRY(call, handle)                                          \
    for (int most = 0, tries = 0; tries == 0; most++) {            \
        left = most;                                               \
        const VkResult result = call;                              \
        tries = result == VK_SUCCESS;                              \
        if (!tries) {                                              \
            assert_int_equal(result, VK_ERROR_OUT_OF_HOST_MEMORY); \
            assert_true((handle) == VK_NULL_HANDLE);               \
        }                                                          \
        assert_true(tries ? most > 0 : most < 100);                \
    }

static void allocations_that_fail_are_told(void **unused)
{
    (void)unused;
    struct rig rig;
    rig_open(&rig);
    VkDevice device = rig.device;
    const VkDescriptorSetLayoutBinding bindings[] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL},
        {3, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL}};
    const VkDescriptorSetLayoutCreateInfo set_info = {.sType =
                                                          VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                      .bindingCount = 3,
                                                      .pBindings = bindings};
    VkDescriptorSetLayout set_layout = VK_NULL_HANDLE;
    CHECK(vkCreateDescriptorSetLayout(device, &set_info, NULL, &set_layout));
    const VkPipelineLayoutCreateInfo layout_info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                    .setLayoutCount = 1,
                                                    .pSetLayouts = &set_layout};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    CHECK(vkCreatePipelineLayout(device, &layout_info, NULL, &layout));
    const VkDescriptorPoolSize sizes[] = {{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 8},
                                          {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 4}};
    const VkDescriptorPoolCreateInfo pool_info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                                  .maxSets = 4,
                                                  .poolSizeCount = 2,
                                                  .pPoolSizes = sizes};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    TRY(vkCreateDescriptorPool(device, &pool_info, &callbacks, &pool), pool)
    const VkDescriptorSetLayout layouts[2] = {set_layout, set_layout};
    const VkDescriptorSetAllocateInfo allocate_info = {.sType =
                                                           VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                                       .descriptorPool = pool,
                                                       .descriptorSetCount = 2,
                                                       .pSetLayouts = layouts};
    VkDescriptorSet sets[2] = {VK_NULL_HANDLE};
    TRY(vkAllocateDescriptorSets(device, &allocate_info, sets), sets[0])
    const VkShaderModuleCreateInfo module_info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                                  .codeSize = sizeof scale_comp,
                                                  .pCode = scale_comp};
    VkShaderModule module = VK_NULL_HANDLE;
    TRY(vkCreateShaderModule(device, &module_info, &callbacks, &module), module)
    const VkComputePipelineCreateInfo pipeline_info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                  .module = module,
                  .pName = "main"},
        .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    TRY(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &pipeline_info, &callbacks, &pipeline), pipeline)
    vkDestroyPipelineLayout(device, layout, NULL);
    vkDestroyDescriptorPool(device, pool, &callbacks);
    vkDestroyDescriptorSetLayout(device, set_layout, NULL);
    vkDestroyPipeline(device, pipeline, &callbacks);
    vkDestroyShaderModule(device, module, &callbacks);
    rig_close(&rig);
}

static void a_pipeline_that_librhw_refuses_is_an_error(void **unused)
{
    (void)unused;
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    static const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1,
                                                         VK_SHADER_STAGE_VERTEX_BIT, NULL};
    if (getenv("RHW_TEST_VALIDATION")) {
        skip(); // the layer tells the fault, as it should
    }
    rig_open(&rig);
    picture_init(&picture, &rig, false, VK_SAMPLE_COUNT_1_BIT);
    VkDescriptorSetLayout set_layout = rig_set_layout(&rig, &binding, 1);
    picture_state(&state, &picture, rig_shader(&rig, place_vert, sizeof place_vert),
                  rig_shader(&rig, shade_frag, sizeof shade_frag), rig_layout(&rig, &set_layout, 1, 0));
    state.attributes[0] = (VkVertexInputAttributeDescription){
        .format = VK_FORMAT_R32G32_SFLOAT,
        .offset = UINT32_MAX}; // of a stride of 0, which has no room for it
    state.input.vertexBindingDescriptionCount = state.input.vertexAttributeDescriptionCount = 1;
    VkPipeline pipeline = (VkPipeline)1;
    assert_int_equal(picture_try_pipeline(&picture, &state, picture.pass, 0, &pipeline), VK_ERROR_UNKNOWN);
    assert_true(pipeline == VK_NULL_HANDLE);
    rig_close(&rig);
}

static void a_pipeline_cache_has_a_header(void **unused)
{
    (void)unused;
    struct rig rig;
    rig_open(&rig);
    const VkPipelineCacheCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
    VkPipelineCache cache;
    VkPipelineCacheHeaderVersionOne header;
    VkPhysicalDeviceProperties properties;
    size_t size = 0;
    CHECK(vkCreatePipelineCache(rig.device, &info, NULL, &cache));
    RIG_KEEP(&rig, PIPELINE_CACHE, cache);
    CHECK(vkGetPipelineCacheData(rig.device, cache, &size, NULL));
    assert_true(size >= sizeof header);
    size = sizeof header;
    (void)vkGetPipelineCacheData(rig.device, cache, &size, &header);
    vkGetPhysicalDeviceProperties(rig.physical, &properties);
    assert_int_equal(header.headerSize, sizeof header);
    assert_int_equal(header.vendorID, properties.vendorID);
    assert_memory_equal(header.pipelineCacheUUID, properties.pipelineCacheUUID, VK_UUID_SIZE);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_a_pipeline_was_made_of_may_go),
    cmocka_unit_test(a_module_that_is_no_shader_is_refused),
    cmocka_unit_test(alpha_and_logic_reach_samples_and_bits),
    cmocka_unit_test(samples_are_shaded_one_by_one),
    cmocka_unit_test(allocations_that_fail_are_told),
    cmocka_unit_test(a_pipeline_that_librhw_refuses_is_an_error),
    cmocka_unit_test(a_pipeline_cache_has_a_header),
};

const struct unit_tests test_vulkan_pipelines = UNIT_TESTS(tests, NULL, NULL);
