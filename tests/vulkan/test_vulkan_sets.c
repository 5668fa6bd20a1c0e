// SPDX-License-Identifier: MIT
// Descriptor sets: what shaders find in them, and how they are written.
#include <stdlib.h>
#include <string.h>

#include "quad_vert.h"
#include "sampled_frag.h"
#include "vulkan_picture.h"

enum { PARTS = 3 };

// A picture whose quads sample what sets have.
struct sampling {
    struct rig rig;
    struct picture picture;
    struct picture_state state;
    VkDescriptorSetLayout layouts[2];
    VkSampler linear, nearest;
    struct rig_image whole, parts[PARTS];
    VkPipeline pipeline;
};

static VkSampler make_sampler(struct rig *rig, VkFilter filter)
{
    const VkSamplerCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                      .magFilter = filter,
                                      .minFilter = filter,
                                      .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                      .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
    VkSampler sampler;
    CHECK(vkCreateSampler(rig->device, &info, NULL, &sampler));
    RIG_KEEP(rig, SAMPLER, sampler);
    return sampler;
}

static struct rig_image make_texture(struct rig *rig, uint32_t width, const void *texels)
{
    const struct rig_image image = rig_image(rig, VK_FORMAT_R8G8B8A8_UNORM, width, 1, VK_SAMPLE_COUNT_1_BIT,
                                             VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    rig_write(rig, &image, texels, 4, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    return image;
}

static void begin_sampling(struct sampling *s)
{
    static const uint8_t texels[4][2][4] = {{{0, 0, 0, 255}, {200, 100, 50, 255}},
                                            {{1, 0, 0, 255}, {11, 0, 0, 255}},
                                            {{2, 0, 0, 255}, {22, 0, 0, 255}},
                                            {{3, 0, 0, 255}, {33, 0, 0, 255}}};
    rig_open(&s->rig);
    picture_init(&s->picture, &s->rig, false, VK_SAMPLE_COUNT_1_BIT);
    s->linear = make_sampler(&s->rig, VK_FILTER_LINEAR);
    s->nearest = make_sampler(&s->rig, VK_FILTER_NEAREST);
    s->whole = make_texture(&s->rig, 2, texels[0]);
    for (int i = 0; i < PARTS; i++) {
        s->parts[i] = make_texture(&s->rig, 2, texels[1 + i]);
    }
    const VkDescriptorSetLayoutBinding images[] = {
        {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, PARTS, VK_SHADER_STAGE_FRAGMENT_BIT, NULL},
        {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, NULL}};
    const VkDescriptorSetLayoutBinding samplers = {2, VK_DESCRIPTOR_TYPE_SAMPLER, 1,
                                                   VK_SHADER_STAGE_FRAGMENT_BIT, &s->nearest};
    s->layouts[0] = rig_set_layout(&s->rig, images, 2);
    s->layouts[1] = rig_set_layout(&s->rig, &samplers, 1);
    picture_state(&s->state, &s->picture, rig_shader(&s->rig, quad_vert, sizeof quad_vert),
                  rig_shader(&s->rig, sampled_frag, sizeof sampled_frag),
                  rig_layout(&s->rig, s->layouts, 2, 36));
    s->pipeline = picture_pipeline(&s->picture, &s->state, s->picture.pass, 0);
}

// Draw columns that sample `which` at x = 1/4, 1/2 and 3/4, from a column of 8 pixels on.
static void draw_samples(const struct sampling *s, const VkDescriptorSet sets[2], int column, int which)
{
    vkCmdBindPipeline(s->rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, s->pipeline);
    vkCmdBindDescriptorSets(s->rig.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, s->state.layout, 0, 2, sets, 0,
                            NULL);
    for (int i = 0; i < 3; i++) {
        const float x = (float)(column + i) / 4 - 1;
        const float push[9] = {x, -1, x + 0.25f, 1, 0.25f * (float)(i + 1), 0.5f, 0, (float)which / 255, 0};
        vkCmdPushConstants(s->rig.commands, s->state.layout, VK_SHADER_STAGE_ALL, 0, sizeof push, push);
        vkCmdDraw(s->rig.commands, 6, 1, 0, 0);
    }
}

static void expect_columns(const struct sampling *s, int column, const uint32_t texels[3])
{
    for (int i = 0; i < 3; i++) {
        assert_int_equal(picture_texel(&s->picture, 8 * (column + i) + 4, 30), texels[i]);
    }
}

static void images_are_sampled_with_their_samplers(void **state)
{
    (void)state;
    struct sampling s;
    begin_sampling(&s);
    const VkDescriptorSet sets[2] = {rig_set(&s.rig, s.layouts[0]), rig_set(&s.rig, s.layouts[1])};
    rig_bind_image(&s.rig, sets[0], 0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, s.whole.view, s.linear,
                   VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    VkDescriptorImageInfo infos[PARTS];
    for (int i = 0; i < PARTS; i++) {
        infos[i] = (VkDescriptorImageInfo){.imageView = s.parts[i].view,
                                           .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    }
    const VkWriteDescriptorSet write = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                        .dstSet = sets[0],
                                        .dstBinding = 1,
                                        .descriptorCount = PARTS,
                                        .descriptorType = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE,
                                        .pImageInfo = infos};
    vkUpdateDescriptorSets(s.rig.device, 1, &write, 0, NULL);
    picture_begin(&s.picture);
    draw_samples(&s, sets, 0, 3);
    draw_samples(&s, sets, 3, 2);
    picture_end(&s.picture);
    expect_columns(&s, 0, (const uint32_t[]){0x000000ff, 0x643219ff, 0xc86432ff});
    expect_columns(&s, 3, (const uint32_t[]){0x030000ff, 0x210000ff, 0x210000ff});
    rig_close(&s.rig);
}

// The bytes that a template reads.
struct template_part {
    uint32_t unused[3];
    VkDescriptorImageInfo info;
};
struct template_data {
    VkDescriptorImageInfo whole;
    struct template_part parts[PARTS];
};

static VkDescriptorUpdateTemplate make_template(struct sampling *s)
{
    const VkDescriptorUpdateTemplateEntry entries[] = {
        {0, 0, 1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, offsetof(struct template_data, whole), 0},
        {1, 0, PARTS, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, offsetof(struct template_data, parts[0].info),
         sizeof(struct template_part)}};
    const VkDescriptorUpdateTemplateCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_UPDATE_TEMPLATE_CREATE_INFO,
        .descriptorUpdateEntryCount = 2,
        .pDescriptorUpdateEntries = entries,
        .templateType = VK_DESCRIPTOR_UPDATE_TEMPLATE_TYPE_DESCRIPTOR_SET,
        .descriptorSetLayout = s->layouts[0]};
    VkDescriptorUpdateTemplate made;
    CHECK(vkCreateDescriptorUpdateTemplate(s->rig.device, &info, NULL, &made));
    RIG_KEEP(&s->rig, DESCRIPTOR_UPDATE_TEMPLATE, made);
    return made;
}

static void templates_and_copies_write_sets(void **state)
{
    (void)state;
    struct sampling s;
    struct template_data data;
    begin_sampling(&s);
    const VkDescriptorSet first[2] = {rig_set(&s.rig, s.layouts[0]), rig_set(&s.rig, s.layouts[1])};
    const VkDescriptorSet second[2] = {rig_set(&s.rig, s.layouts[0]), first[1]};
    const VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    data.whole = (VkDescriptorImageInfo){s.nearest, s.whole.view, layout};
    for (int i = 0; i < PARTS; i++) {
        data.parts[i].info = (VkDescriptorImageInfo){VK_NULL_HANDLE, s.parts[i].view, layout};
    }
    vkUpdateDescriptorSetWithTemplate(s.rig.device, first[0], make_template(&s), &data);
    const VkCopyDescriptorSet copies[] = {
        {VK_STRUCTURE_TYPE_COPY_DESCRIPTOR_SET, NULL, first[0], 0, 0, second[0], 0, 0, 1},
        {VK_STRUCTURE_TYPE_COPY_DESCRIPTOR_SET, NULL, first[0], 1, 1, second[0], 1, 0, 2},
        {VK_STRUCTURE_TYPE_COPY_DESCRIPTOR_SET, NULL, first[0], 1, 0, second[0], 1, 2, 1}};
    vkUpdateDescriptorSets(s.rig.device, 0, NULL, 3, copies);
    picture_begin(&s.picture);
    draw_samples(&s, first, 0, 1);
    draw_samples(&s, second, 3, 1);
    draw_samples(&s, second, 5, 3);
    picture_end(&s.picture);
    expect_columns(&s, 0, (const uint32_t[]){0x020000ff, 0x160000ff, 0x160000ff});
    expect_columns(&s, 3, (const uint32_t[]){0x030000ff, 0x210000ff, 0x000000ff});
    expect_columns(&s, 5, (const uint32_t[]){0x000000ff, 0xc86432ff, 0xc86432ff});
    rig_close(&s.rig);
}

static void a_pool_gives_what_it_promises(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig);
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2,
                                                  VK_SHADER_STAGE_COMPUTE_BIT, NULL};
    VkDescriptorSetLayout layouts[3] = {rig_set_layout(&rig, &binding, 1)};
    layouts[1] = layouts[2] = layouts[0];
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 5};
    const VkDescriptorPoolCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                                             .maxSets = 8,
                                             .poolSizeCount = 1,
                                             .pPoolSizes = &size};
    VkDescriptorSetAllocateInfo allocate = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                            .descriptorSetCount = 3,
                                            .pSetLayouts = layouts};
    VkDescriptorSet sets[3];
    CHECK(vkCreateDescriptorPool(rig.device, &info, NULL, &allocate.descriptorPool));
    RIG_KEEP(&rig, DESCRIPTOR_POOL, allocate.descriptorPool);
    assert_int_equal(vkAllocateDescriptorSets(rig.device, &allocate, sets), VK_ERROR_OUT_OF_POOL_MEMORY);
    assert_true(sets[0] == VK_NULL_HANDLE && sets[2] == VK_NULL_HANDLE);
    allocate.descriptorSetCount = 2;
    CHECK(vkAllocateDescriptorSets(rig.device, &allocate, sets));
    CHECK(vkFreeDescriptorSets(rig.device, allocate.descriptorPool, 1, sets));
    allocate.descriptorSetCount = 1;
    CHECK(vkAllocateDescriptorSets(rig.device, &allocate, sets));
    assert_int_equal(vkAllocateDescriptorSets(rig.device, &allocate, &sets[2]), VK_ERROR_OUT_OF_POOL_MEMORY);
    CHECK(vkResetDescriptorPool(rig.device, allocate.descriptorPool, 0));
    allocate.descriptorSetCount = 2;
    CHECK(vkAllocateDescriptorSets(rig.device, &allocate, sets));
    rig_close(&rig);
}

static void *VKAPI_CALL count_one(void *user, size_t size, size_t alignment, VkSystemAllocationScope scope)
{
    (void)scope;
    ++*(int *)user;
    void *memory = NULL;
    return posix_memalign(&memory, alignment < 16 ? 16 : alignment, size) == 0 ? memory : NULL;
}

static void *VKAPI_CALL count_again(void *user, void *memory, size_t size, size_t alignment,
                                    VkSystemAllocationScope scope)
{
    // The size of what there is is not known; the loader and the driver never ask.
    return memory ? NULL : count_one(user, size, alignment, scope);
}

static void VKAPI_CALL count_off(void *user, void *memory)
{
    *(int *)user -= memory != NULL;
    free(memory);
}

// A program may end its callbacks with the layouts that it created by them, while sets of the layouts go on.
static void layouts_leave_nothing_to_their_callbacks(void **state)
{
    (void)state;
    static const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1,
                                                         VK_SHADER_STAGE_COMPUTE_BIT, NULL};
    struct rig rig;
    int count = 0;
    const VkAllocationCallbacks callbacks = {.pUserData = &count,
                                             .pfnAllocation = count_one,
                                             .pfnReallocation = count_again,
                                             .pfnFree = count_off};
    const VkDescriptorSetLayoutCreateInfo info = {.sType =
                                                      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                  .bindingCount = 1,
                                                  .pBindings = &binding};
    rig_open(&rig);
    VkDescriptorSetLayout layout;
    VkPipelineLayout pipeline_layout;
    CHECK(vkCreateDescriptorSetLayout(rig.device, &info, &callbacks, &layout));
    const VkPipelineLayoutCreateInfo pipeline_info = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO, .setLayoutCount = 1, .pSetLayouts = &layout};
    CHECK(vkCreatePipelineLayout(rig.device, &pipeline_info, &callbacks, &pipeline_layout));
    (void)rig_set(&rig, layout);
    vkDestroyDescriptorSetLayout(rig.device, layout, &callbacks);
    assert_int_equal(count, 0);
    vkDestroyPipelineLayout(rig.device, pipeline_layout, &callbacks);
    assert_int_equal(count, 0);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(images_are_sampled_with_their_samplers),
    cmocka_unit_test(templates_and_copies_write_sets),
    cmocka_unit_test(a_pool_gives_what_it_promises),
    cmocka_unit_test(layouts_leave_nothing_to_their_callbacks),
};

const struct unit_tests test_vulkan_sets = UNIT_TESTS(tests, NULL, NULL);
