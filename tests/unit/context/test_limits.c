// SPDX-License-Identifier: MIT
// Limits: member by member against what Vulkan 1.0 requires, and some of them drawn with.
#include "harness.h"

#include <string.h>

// Beside the table "Required Limits" --------------------------------------------------------------------

struct required {
    const char *name;
    double ours, least;
};

static void expect_at_least(const struct required *rows, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        print_message("%-42s %12g, required %g\n", rows[i].name, rows[i].ours, rows[i].least);
        assert_true(rows[i].ours >= rows[i].least);
    }
}

// By hand from Vulkan 1.0, table "Required Limits", and VK_EXT_transform_feedback. Not here, as there is nothing of theirs: memory, descriptor sets,
// tessellation and geometry.
static void test_what_vulkan_requires(void **state)
{
    (void)state;
    const struct rhw_limits l = rhw_limits_get();
    // A stride is a multiple of 4, and so is the largest one.
    assert_true(l.max_transform_feedback_buffer_data_stride == 0xfffffffc);
    const struct required rows[] = {
        {"maxImageDimension1D", l.max_image_dimension_1d, 4096},
        {"maxImageDimension2D", l.max_image_dimension_2d, 4096},
        {"maxImageDimension3D", l.max_image_dimension_3d, 256},
        {"maxImageDimensionCube", l.max_image_dimension_cube, 4096},
        {"maxImageArrayLayers", l.max_image_array_layers, 256},
        {"maxFramebufferLayers", l.max_framebuffer_layers, 256},
        {"maxViewports", l.max_viewports, 16},
        {"maxSamplerAllocationCount", l.max_sampler_allocation_count, 4000},
        {"maxUniformBufferRange", l.max_uniform_buffer_range, 16384},
        {"maxPerStageDescriptorUniformBuffers of it", l.max_uniform_buffer_range, 12 * 16384},
        {"maxPushConstantsSize of it", l.max_uniform_buffer_range, 128 + 12 * 16384},
        {"maxPerStageDescriptorSamplers of both", l.max_per_stage_descriptor_samplers, 2 * 16},
        {"maxPerStageDescriptorSampledImages of both", l.max_per_stage_descriptor_sampled_images, 2 * 16},
        {"maxPerStageDescriptorStorageBuffers", l.max_per_stage_descriptor_storage_buffers, 4},
        {"maxPerStageDescriptorStorageImages", l.max_per_stage_descriptor_storage_images, 4},
        {"maxPerStageDescriptorInputAttachments", l.max_per_stage_descriptor_input_attachments, 4},
        {"maxFragmentCombinedOutputResources", l.max_fragment_combined_output_resources, 4},
        {"maxStorageBufferRange", l.max_storage_buffer_range, 134217728},
        {"maxTexelBufferElements", l.max_texel_buffer_elements, 65536},
        {"minMemoryMapAlignment", l.min_memory_map_alignment, 64},
        {"maxComputeSharedMemorySize", l.max_compute_shared_memory_size, 16384},
        {"maxComputeWorkGroupCount[0]", l.max_compute_work_group_count[0], 65535},
        {"maxComputeWorkGroupCount[1]", l.max_compute_work_group_count[1], 65535},
        {"maxComputeWorkGroupCount[2]", l.max_compute_work_group_count[2], 65535},
        {"maxComputeWorkGroupInvocations", l.max_compute_work_group_invocations, 256}, // WebGPU; Vulkan: 128
        {"maxComputeWorkGroupSize[0]", l.max_compute_work_group_size[0], 256},
        {"maxComputeWorkGroupSize[1]", l.max_compute_work_group_size[1], 256},
        {"maxComputeWorkGroupSize[2]", l.max_compute_work_group_size[2], 64},
        {"-minInterpolationOffset", -(double)l.min_interpolation_offset, 0.5},
        {"maxInterpolationOffset", (double)l.max_interpolation_offset, 0.5},
        {"subPixelInterpolationOffsetBits", l.sub_pixel_interpolation_offset_bits, 4},
        {"sampledImageIntegerSampleCounts", l.sampled_image_integer_sample_counts, 1},
        {"-minStorageBufferOffsetAlignment", -(double)l.min_storage_buffer_offset_alignment, -256},
        {"-minTexelBufferOffsetAlignment", -(double)l.min_texel_buffer_offset_alignment, -256},
        {"storageImageSampleCounts", l.storage_image_sample_counts, 1},
        {"maxVertexInputAttributes", l.max_vertex_input_attributes, 16},
        {"maxVertexInputBindings", l.max_vertex_input_bindings, 16},
        {"maxVertexInputAttributeOffset", l.max_vertex_input_attribute_offset, 2047},
        {"maxVertexInputBindingStride", l.max_vertex_input_binding_stride, 2048},
        {"maxDrawIndexedIndexValue", l.max_draw_indexed_index_value, 4294967295.0}, // fullDrawIndexUint32
        {"maxDrawIndirectCount", l.max_draw_indirect_count, 65535},                 // multiDrawIndirect
        {"maxVertexOutputComponents", l.max_vertex_output_components, 64},
        {"maxFragmentInputComponents", l.max_fragment_input_components, 64},
        {"maxClipDistances", l.max_clip_distances, 8},
        {"maxCullDistances", l.max_cull_distances, 8},
        {"maxCombinedClipAndCullDistances", l.max_combined_clip_and_cull_distances, 8},
        {"maxFramebufferWidth", l.max_framebuffer_width, 4096},
        {"maxFramebufferHeight", l.max_framebuffer_height, 4096},
        {"maxColorAttachments", l.max_color_attachments, 4},
        {"maxFragmentOutputAttachments", l.max_fragment_output_attachments, 4},
        {"maxFragmentDualSrcAttachments", l.max_fragment_dual_src_attachments, 1},
        {"maxFragmentCombinedOutputResources", l.max_fragment_combined_output_resources, 4},
        {"maxSampleMaskWords", l.max_sample_mask_words, 1},
        {"subPixelPrecisionBits", l.sub_pixel_precision_bits, 4},
        {"maxViewportDimensions[0]", l.max_viewport_dimensions[0], l.max_framebuffer_width},
        {"maxViewportDimensions[1]", l.max_viewport_dimensions[1], l.max_framebuffer_height},
        {"-viewportBoundsRange[0]", -(double)l.viewport_bounds_range[0], 2.0 * l.max_viewport_dimensions[0]},
        {"viewportBoundsRange[1]", (double)l.viewport_bounds_range[1],
         2.0 * l.max_viewport_dimensions[0] - 1},
        {"viewportSubPixelBits", l.viewport_sub_pixel_bits, 0},
        {"-pointSizeRange[0]", -(double)l.point_size_range[0], -1},
        {"pointSizeRange[1]", (double)l.point_size_range[1], 64},
        {"-pointSizeGranularity", -(double)l.point_size_granularity, -1},
        {"-lineWidthRange[0]", -(double)l.line_width_range[0], -1},
        {"lineWidthRange[1]", (double)l.line_width_range[1], 8},
        {"-lineWidthGranularity", -(double)l.line_width_granularity, -1},
        {"subTexelPrecisionBits", l.sub_texel_precision_bits, 4},
        {"mipmapPrecisionBits", l.mipmap_precision_bits, 4},
        {"maxSamplerLodBias", (double)l.max_sampler_lod_bias, 2},
        {"maxSamplerAnisotropy", (double)l.max_sampler_anisotropy, 16},
        {"-minTexelOffset", -(double)l.min_texel_offset, 8},
        {"maxTexelOffset", l.max_texel_offset, 7},
        {"-minTexelGatherOffset", -(double)l.min_texel_gather_offset, 8},
        {"maxTexelGatherOffset", l.max_texel_gather_offset, 7},
        {"maxTransformFeedbackStreams", l.max_transform_feedback_streams, 1},
        {"maxTransformFeedbackBuffers", l.max_transform_feedback_buffers, 1},
        {"maxTransformFeedbackBufferSize", (double)l.max_transform_feedback_buffer_size, 134217728},
        {"maxTransformFeedbackStreamDataSize", l.max_transform_feedback_stream_data_size, 512},
        {"maxTransformFeedbackBufferDataSize", l.max_transform_feedback_buffer_data_size, 512},
        {"maxTransformFeedbackBufferDataStride", l.max_transform_feedback_buffer_data_stride, 512},
        {"timestampPeriod", (double)l.timestamp_period, 1},
    };
    expect_at_least(rows, sizeof rows / sizeof *rows);
    const uint32_t counts[] = {
        l.framebuffer_color_sample_counts,    l.framebuffer_depth_sample_counts,
        l.framebuffer_stencil_sample_counts,  l.framebuffer_no_attachments_sample_counts,
        l.sampled_image_color_sample_counts,  l.sampled_image_depth_sample_counts,
        l.sampled_image_stencil_sample_counts};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        assert_int_equal(counts[i] & (1 | 4), 1 | 4);
    }
    assert_true(l.standard_sample_locations);
}

// What is drawn with ------------------------------------------------------------------------------------

// Position from attribute 0, which has x alone; the colour is the sum of all, each times its number.
static void add_attributes(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_float sum = rhw_splat(0);
        for (int i = 0; i < RHW_MAX_ATTRIBUTES; i++) {
            sum += groups[g].attribute[i][0] * (float)(i + 1);
        }
        const rhw_int corner = groups[g].vertex_index;
        groups[g].position[0] =
            rhw_select(rhw_equal_int(corner, rhw_splat_int(1)), rhw_splat(3), rhw_splat(-1));
        groups[g].position[1] =
            rhw_select(rhw_equal_int(corner, rhw_splat_int(2)), rhw_splat(3), rhw_splat(-1));
        groups[g].position[2] = rhw_splat(0.5f);
        groups[g].position[3] = rhw_splat(1);
        for (int c = 0; c < 4; c++) {
            groups[g].varying[c] = sum;
        }
    }
}

static void test_vertex_buffers(void **state)
{
    (void)state;
    struct rig rig;
    const int count = (int)rhw_limits_get().max_vertex_input_bindings;
    rig_open(&rig, 8, 8);
    rig_set_program(&rig, add_attributes, rig_fragment_pass);
    rig.pipeline.attribute_count = rig.pipeline.buffer_count = count;
    for (int i = 0; i < count; i++) {
        rig.pipeline.attributes[i] = (struct rhw_attribute){RHW_VERTEX_FLOAT1, count - 1 - i, 0};
        rig.pipeline.buffers[i].stride = sizeof(float);
    }
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    float expected = 0;
    for (int i = 0; i < count; i++) {
        const float value[3] = {(float)(1 << i), (float)(1 << i), (float)(1 << i)};
        rig_use_vertices(&rig, i, value, sizeof value);
        expected += (float)((1 << i) * (count - i));
    }
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    rig_end(&rig);
    for (int i = 0; i < 64; i++) {
        assert_true(rig_read_float4(&rig)[i][0] == expected);
    }
    rig_close(&rig);
}

static void last_uniform(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const float *const uniforms = groups[g].uniforms;
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(uniforms[RHW_MAX_UNIFORM_SIZE / sizeof(float) - 4 + (size_t)c]);
        }
    }
}

static void test_uniforms(void **state)
{
    (void)state;
    static float block[RHW_MAX_UNIFORM_SIZE / sizeof(float)];
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open(&rig, 8, 8);
    assert_int_equal(sizeof block, rhw_limits_get().max_uniform_buffer_range);
    for (size_t i = 0; i < sizeof block / sizeof *block; i++) {
        block[i] = (float)i;
    }
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_set_program(&rig, rig_vertex_pass, last_uniform);
    rig.pipeline.program.uniform_size = sizeof block;
    rig_begin(&rig);
    rhw_pass_set_uniforms(rig.context, rig.recording, block, sizeof block);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    assert_memory_equal(rig_read_float4(&rig)[63], block + sizeof block / sizeof *block - 4, 16);
    rig_close(&rig);
}

// A target that is as wide as may be, and viewports at the ends of their range: the last pixels are drawn.
static void test_sizes(void **state)
{
    (void)state;
    const struct rhw_limits limits = rhw_limits_get();
    const int size = (int)limits.max_framebuffer_width;
    const float low = limits.viewport_bounds_range[0], high = limits.viewport_bounds_range[1];
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open(&rig, size, 2);
    rig_cover(&rig, 0.5f, (const float[4]){1, 2, 3, 4}, vertices);
    rig_begin(&rig);
    rig_draw(&rig, vertices, 6);
    const struct rhw_viewport ends[2] = {
        {low, low, (float)size, (float)size, 0, 1},
        {high - (float)size, high - (float)size, (float)size, (float)size, 0, 1}};
    for (int i = 0; i < 2; i++) { // neither shows anything
        rhw_pass_set_viewport(rig.context, rig.recording, &ends[i]);
        rig_draw(&rig, vertices, 6);
    }
    rhw_pass_set_viewport(rig.context, rig.recording, &(struct rhw_viewport){low - 1, 0, 8, 8, 0, 1});
    rig_expect_misuse(&rig, "each is within ±32768");
    rig_end(&rig);
    const float(*const seen)[4] = rig_read_float4(&rig);
    for (int i = 0; i < 2 * size; i++) {
        assert_memory_equal(seen[i], ((const float[4]){1, 2, 3, 4}), 16);
    }
    rig_close(&rig);
}

// The largest textures of each kind, as flat as may be.
static void test_textures(void **state)
{
    (void)state;
    const struct rhw_limits l = rhw_limits_get();
    const int d1 = (int)l.max_image_dimension_1d, d2 = (int)l.max_image_dimension_2d,
              d3 = (int)l.max_image_dimension_3d, layers = (int)l.max_image_array_layers;
    const struct rhw_texture_def defs[] = {
        {.width = d1, .kind = RHW_TEXTURE_1D},
        {.width = d1, .kind = RHW_TEXTURE_1D, .layers = layers},
        {.width = 1, .height = d2},
        {.width = d2, .height = 1},
        {.width = 1, .height = 1, .layers = layers},
        {.width = d3, .height = 1, .kind = RHW_TEXTURE_3D, .depth = d3},
        {.width = 1, .height = d3, .kind = RHW_TEXTURE_3D, .depth = d3},
    };
    struct rig rig;
    rig_open(&rig, 8, 8);
    for (size_t i = 0; i < sizeof defs / sizeof *defs; i++) {
        struct rhw_texture_def def = defs[i];
        rhw_texture texture;
        def.format = RHW_FORMAT_R8_UNORM;
        assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// Slot i has i + 1: the sum by a fetch from each, and by rhw_sample_groups from all at once.
static void sum_slots(struct rhw_fragment *groups, int count)
{
    rhw_float texels[RHW_MAX_GROUPS][RHW_MAX_TEXTURES][4];
    rhw_sample_groups(groups, count, UINT32_MAX, 0, texels[0], RHW_MAX_TEXTURES);
    for (int g = 0; g < count; g++) {
        const rhw_int zero[2] = {rhw_splat_int(0), rhw_splat_int(0)};
        rhw_float fetched = rhw_splat(0), sampled = rhw_splat(0);
        for (int i = 0; i < RHW_MAX_TEXTURES; i++) {
            rhw_float texel[4];
            rhw_sample_fetch(groups[g].bindings, i, zero, NULL, texel);
            fetched += texel[0];
            sampled += texels[g][i][0];
        }
        groups[g].color[0][0] = fetched;
        groups[g].color[0][1] = sampled;
        groups[g].color[0][2] = texels[g][RHW_MAX_TEXTURES - 1][0];
        groups[g].color[0][3] = rhw_splat(1);
    }
}

static void sum_slots1(struct rhw_fragment1 *f)
{
    float texels[RHW_MAX_TEXTURES][4];
    const int32_t zero[2] = {0, 0};
    rhw_sample_groups1(f, UINT32_MAX, 0, texels);
    f->color[0][0] = f->color[0][1] = 0;
    for (int i = 0; i < RHW_MAX_TEXTURES; i++) {
        float texel[4];
        rhw_sample_fetch1(f->bindings, i, zero, 0, texel);
        f->color[0][0] += texel[0];
        f->color[0][1] += texels[i][0];
    }
    f->color[0][2] = texels[RHW_MAX_TEXTURES - 1][0];
    f->color[0][3] = 1;
}

static void test_texture_slots(void **state)
{
    (void)state;
    const int count = (int)rhw_limits_get().max_per_stage_descriptor_sampled_images;
    assert_int_equal(count, 32);
    for (int n = 0; n < 4; n++) { // single floats, and textures of 8 bits that share their footprints
        struct rig rig;
        rhw_sampler sampler;
        rhw_texture textures[RHW_MAX_TEXTURES];
        struct rig_vertex vertices[6];
        rig_open(&rig, 16, 16);
        assert_int_equal(rhw_sampler_create(rig.context, &(struct rhw_sampler_def){.label = NULL}, &sampler),
                         RHW_OK);
        rig_set_program(&rig, rig_vertex_pass, sum_slots);
        if (n & 1) {
            memset(rig.pipeline.program.fragment, 0, sizeof rig.pipeline.program.fragment);
            rig.pipeline.program.fragment1 = sum_slots1;
        }
        rig.pipeline.program.varyings[0].derivatives = true;
        rig_cover(&rig, 0.5f, (const float[4]){0.5f, 0.5f}, vertices);
        const bool is_float = n < 2;
        rig_begin(&rig);
        for (int i = 0; i < count; i++) {
            const struct rhw_texture_def def = {
                .format = is_float ? RHW_FORMAT_R32_FLOAT : RHW_FORMAT_RGBA8_UNORM, .width = 1, .height = 1};
            const float value = (float)(i + 1);
            const unsigned char bytes[4] = {i < 31 ? 0 : 255, 0, 0, 0};
            assert_int_equal(rhw_texture_create(rig.context, &def, &textures[i]), RHW_OK);
            assert_int_equal(
                rhw_texture_write(rig.context, textures[i], 0, is_float ? (const void *)&value : bytes, 0),
                RHW_OK);
            rhw_pass_set_texture(rig.context, rig.recording, i, textures[i], sampler);
        }
        rig_draw(&rig, vertices, 6);
        rig_end(&rig);
        const float sum = is_float ? 32 * 33 / 2 : 1, last = is_float ? 32 : 1;
        assert_memory_equal(rig_read_float4(&rig)[77], ((const float[4]){sum, sum, last, 1}), 16);
        for (int i = 0; i < count; i++) {
            rhw_texture_destroy(rig.context, textures[i]);
        }
        rhw_sampler_destroy(rig.context, sampler);
        rig_close(&rig);
    }
}

static void read_sample(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int at[2] = {rhw_splat_int(3), rhw_splat_int(5)};
        const int last = rhw_sample_samples(groups[g].bindings, 0) - 1;
        const rhw_int sample = rhw_splat_int(last);
        rhw_float texel[4];
        rhw_sample_fetch_sample(groups[g].bindings, 0, at, &sample, texel);
        groups[g].color[0][0] = texel[0];
        groups[g].color[0][1] = rhw_float_from_int(rhw_bits_from_float(texel[0]));
        groups[g].color[0][2] = rhw_splat((float)last);
        groups[g].color[0][3] = rhw_splat(1);
    }
}

static rhw_texture make_multisampled(const struct rig *rig, enum rhw_format format, int samples)
{
    rhw_texture texture;
    const struct rhw_texture_def def = {.format = format, .width = 8, .height = 8, .samples = samples};
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static void expect_sample(struct rig *rig, rhw_texture texture, rhw_sampler sampler, bool is_bits,
                          float expected, int samples)
{
    struct rig_vertex vertices[6];
    rig_cover(rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 0, texture, sampler);
    rig_draw(rig, vertices, 6);
    rig_end(rig);
    const float *const pixel = rig_read_float4(rig)[9];
    assert_true(pixel[is_bits] == expected && pixel[2] == (float)(samples - 1));
}

static void expect_sampled_counts(int samples)
{
    struct rig rig;
    rhw_sampler sampler;
    rhw_texture stencil;
    rig_open(&rig, 8, 8);
    rhw_sampler_create(
        rig.context,
        &(struct rhw_sampler_def){.min_filter = RHW_FILTER_NEAREST, .mag_filter = RHW_FILTER_NEAREST},
        &sampler);
    const rhw_texture color = make_multisampled(&rig, RHW_FORMAT_RGBA16_FLOAT, samples),
                      integer = make_multisampled(&rig, RHW_FORMAT_R32_UINT, samples),
                      depth = make_multisampled(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT, samples);
    const struct rhw_pass_def def = {
        .color_count = 2,
        .colors = {{.texture = color, .load = RHW_LOAD_CLEAR, .clear = {0.25f}},
                   {.texture = integer, .load = RHW_LOAD_CLEAR, .clear_integer = {1234567}}},
        .depth = {.enabled = true,
                  .texture = depth,
                  .load = RHW_LOAD_CLEAR,
                  .clear = 0.125f,
                  .stencil_load = RHW_LOAD_CLEAR,
                  .stencil_clear = 77}};
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(rig.context, &def, &pass), RHW_OK);
    assert_int_equal(rhw_pass_end(rig.context, pass, NULL), RHW_OK);
    const struct rhw_texture_view_def view = {.texture = depth, .format = RHW_FORMAT_R8_UINT};
    assert_int_equal(rhw_texture_view_create(rig.context, &view, &stencil), RHW_OK);
    rig_set_program(&rig, rig_vertex_pass, read_sample);
    expect_sample(&rig, color, sampler, false, 0.25f, samples);
    expect_sample(&rig, integer, sampler, true, 1234567, samples);
    expect_sample(&rig, depth, sampler, false, 0.125f, samples);
    expect_sample(&rig, stencil, sampler, true, 77, samples);
    const rhw_texture textures[] = {stencil, color, integer, depth};
    for (int i = 0; i < 4; i++) {
        rhw_texture_destroy(rig.context, textures[i]);
    }
    rhw_sampler_destroy(rig.context, sampler);
    rig_close(&rig);
}

static void expect_samples_without_attachments(int samples)
{
    struct rig rig;
    struct rig_vertex vertices[6];
    rhw_query query;
    struct rhw_query_counts counts;
    rig_open(&rig, 8, 8);
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig.pass.colors[0].texture = (rhw_texture){0};
    rig.pass.color_count = rig.pipeline.target_count = 0;
    rig.pass.width = rig.pass.height = 8;
    rig.pass.samples = samples;
    assert_int_equal(
        rhw_query_create(rig.context, &(struct rhw_query_def){.kind = RHW_QUERY_OCCLUSION}, &query), RHW_OK);
    rig_begin(&rig);
    rhw_pass_begin_query(rig.context, rig.recording, query);
    rig_draw(&rig, vertices, 6);
    rhw_pass_end_query(rig.context, rig.recording, query);
    rig_end(&rig);
    assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_OK);
    assert_int_equal(counts.samples_passed, 64 * samples);
    rhw_query_destroy(rig.context, query);
    rig_close(&rig);
}

// Every number of samples: drawn into, then read by a shader function, of colour, integers, depth and stencil; and a
// pass without attachments, whose samples a query counts.
static void test_sample_counts(void **state)
{
    (void)state;
    const struct rhw_limits l = rhw_limits_get();
    const uint32_t sampled = l.sampled_image_color_sample_counts;
    assert_int_equal(l.sampled_image_integer_sample_counts, sampled);
    assert_int_equal(l.sampled_image_depth_sample_counts, sampled);
    assert_int_equal(l.sampled_image_stencil_sample_counts, sampled);
    for (int samples = 1; samples <= RHW_MAX_SAMPLES; samples *= 2) {
        assert_true(sampled & (uint32_t)samples);
        if (samples > 1) { // those of one are fetched without a sample's number
            expect_sampled_counts(samples);
        }
        assert_true(l.framebuffer_no_attachments_sample_counts & (uint32_t)samples);
        expect_samples_without_attachments(samples);
    }
}

static void test_mapped_memory(void **state)
{
    (void)state;
    const uintptr_t alignment = rhw_limits_get().min_memory_map_alignment;
    static const size_t offsets[] = {0, 1, 63, 64, 1000};
    struct rig rig;
    rig_open(&rig, 8, 8);
    for (size_t i = 0; i < 2 * sizeof offsets / sizeof *offsets; i++) {
        static _Alignas(RHW_MEMORY_ALIGNMENT) unsigned char memory[1024 + RHW_MEMORY_PADDING];
        rhw_buffer buffer;
        const struct rhw_buffer_def def = {
            .size = 1024, .memory = i % 2 ? memory : NULL, .memory_size = i % 2 ? sizeof memory : 0};
        const size_t offset = offsets[i / 2];
        void *at = NULL;
        assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
        assert_int_equal(rhw_buffer_map(rig.context, buffer, offset, 0, RHW_MAP_READ, &at), RHW_OK);
        assert_true(((uintptr_t)at - offset) % alignment == 0);
        rhw_buffer_unmap(rig.context, buffer);
        rhw_buffer_destroy(rig.context, buffer);
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_what_vulkan_requires),
    cmocka_unit_test(test_vertex_buffers),
    cmocka_unit_test(test_uniforms),
    cmocka_unit_test(test_sizes),
    cmocka_unit_test(test_textures),
    cmocka_unit_test(test_texture_slots),
    cmocka_unit_test(test_sample_counts),
    cmocka_unit_test(test_mapped_memory),
};

const struct unit_tests test_limits = UNIT_TESTS(tests, NULL, NULL);
