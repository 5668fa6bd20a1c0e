// SPDX-License-Identifier: MIT
// The limits as a struct. The library's own constants are the source.
#include <float.h>

#include "base/constants.h"
#include "rhw/rhw.h"
#include "rhw/shader.h"

enum { SAMPLE_COUNTS = 1 | 2 | 4 | 8 | 16 };
_Static_assert(2 * RHW_MAX_SAMPLES - 1 == SAMPLE_COUNTS, "all powers of two up to the most");

struct rhw_limits rhw_limits_get(void)
{
    const float granularity = 1.0f / RHW_SUBPIXEL;
    return (struct rhw_limits){
        .max_image_dimension_1d = RHW_MAX_TARGET_SIZE,
        .max_image_dimension_2d = RHW_MAX_TARGET_SIZE,
        .max_image_dimension_3d = RHW_MAX_TEXTURE_DEPTH,
        .max_image_dimension_cube = RHW_MAX_TARGET_SIZE,
        .max_image_array_layers = RHW_MAX_TEXTURE_LAYERS,
        .max_sampler_allocation_count = 1u << 27, // items of a pool
        .max_uniform_buffer_range = RHW_MAX_UNIFORM_SIZE,
        .max_per_stage_descriptor_samplers = RHW_MAX_TEXTURES,
        .max_per_stage_descriptor_sampled_images = RHW_MAX_TEXTURES,
        .max_vertex_input_attributes = RHW_MAX_ATTRIBUTES,
        .max_vertex_input_bindings = RHW_MAX_VERTEX_BUFFERS,
        .max_vertex_input_attribute_offset =
            UINT32_MAX - 16, // with an attribute of at most 16 bytes behind it
        .max_vertex_input_binding_stride = UINT32_MAX,
        .max_draw_indexed_index_value = UINT32_MAX,
        .max_draw_indirect_count = UINT32_MAX,
        .max_vertex_output_components = RHW_MAX_VARYING_COMPONENTS,
        .max_fragment_input_components = RHW_MAX_VARYING_COMPONENTS,
        .max_clip_distances = RHW_MAX_CLIP_DISTANCES,
        .max_cull_distances = RHW_MAX_CULL_DISTANCES,
        .max_combined_clip_and_cull_distances = RHW_MAX_CLIP_DISTANCES + RHW_MAX_CULL_DISTANCES,
        .max_framebuffer_width = RHW_MAX_TARGET_SIZE,
        .max_framebuffer_height = RHW_MAX_TARGET_SIZE,
        .max_color_attachments = RHW_MAX_COLOR_ATTACHMENTS,
        .max_fragment_output_attachments = RHW_MAX_COLOR_ATTACHMENTS,
        .max_fragment_dual_src_attachments = 1,
        .framebuffer_color_sample_counts = SAMPLE_COUNTS,
        .framebuffer_depth_sample_counts = SAMPLE_COUNTS,
        .framebuffer_stencil_sample_counts = SAMPLE_COUNTS,
        .framebuffer_no_attachments_sample_counts = SAMPLE_COUNTS,
        .max_sample_mask_words = 1,
        .sub_pixel_precision_bits = RHW_SUBPIXEL_BITS,
        .max_framebuffer_layers = RHW_MAX_TEXTURE_LAYERS,
        .max_viewports = RHW_MAX_VIEWPORTS,
        .max_viewport_dimensions = {RHW_MAX_TARGET_SIZE, RHW_MAX_TARGET_SIZE},
        .viewport_bounds_range = {-2 * RHW_MAX_TARGET_SIZE, 2 * RHW_MAX_TARGET_SIZE},
        .viewport_sub_pixel_bits = RHW_SUBPIXEL_BITS,
        .point_size_range = {1, RHW_MAX_POINT_SIZE},
        .point_size_granularity = granularity,
        .line_width_range = {1, RHW_MAX_LINE_WIDTH},
        .line_width_granularity = granularity,
        .standard_sample_locations = true,
        .min_interpolation_offset = -RHW_MAX_TARGET_SIZE,
        .max_interpolation_offset = RHW_MAX_TARGET_SIZE,
        .sub_pixel_interpolation_offset_bits = 10, // floats from 8192 on have 10 bits of fraction
        .sub_texel_precision_bits = 8,
        .mipmap_precision_bits = 8,
        .max_sampler_lod_bias = FLT_MAX,
        .max_sampler_anisotropy = 16,
        .min_texel_offset = -32768,
        .min_texel_gather_offset = -32768,
        .max_texel_offset = 32767,
        .max_texel_gather_offset = 32767,
        .max_transform_feedback_streams = 1,
        .max_transform_feedback_buffers = RHW_MAX_FEEDBACK_TARGETS,
        .max_transform_feedback_buffer_size = SIZE_MAX / 2,
        .max_transform_feedback_stream_data_size = RHW_MAX_VARYING_COMPONENTS * sizeof(float),
        .max_transform_feedback_buffer_data_size = RHW_MAX_VARYING_COMPONENTS * sizeof(float),
        .max_transform_feedback_buffer_data_stride = UINT32_MAX - 3, // multiple of 4
        .max_per_stage_descriptor_storage_buffers = RHW_MAX_STORAGE_BUFFERS,
        .max_per_stage_descriptor_storage_images = RHW_MAX_STORAGE_IMAGES,
        .max_per_stage_descriptor_input_attachments = RHW_MAX_COLOR_ATTACHMENTS + 2,
        .max_fragment_combined_output_resources =
            RHW_MAX_COLOR_ATTACHMENTS + RHW_MAX_STORAGE_BUFFERS + RHW_MAX_STORAGE_IMAGES,
        .max_storage_buffer_range = UINT32_MAX,
        .max_texel_buffer_elements = RHW_MAX_TEXEL_BUFFER,
        .min_memory_map_alignment = RHW_MEMORY_ALIGNMENT,
        .min_storage_buffer_offset_alignment = 4,
        .min_texel_buffer_offset_alignment = 16,
        .max_compute_shared_memory_size = RHW_MAX_SHARED_SIZE,
        .max_compute_work_group_invocations = RHW_MAX_WORKGROUP_INVOCATIONS,
        .max_compute_work_group_count = {RHW_MAX_WORKGROUP_COUNT, RHW_MAX_WORKGROUP_COUNT,
                                         RHW_MAX_WORKGROUP_COUNT},
        .max_compute_work_group_size = {RHW_MAX_WORKGROUP_INVOCATIONS, RHW_MAX_WORKGROUP_INVOCATIONS,
                                        RHW_MAX_WORKGROUP_INVOCATIONS},
        .sampled_image_color_sample_counts = SAMPLE_COUNTS,
        .sampled_image_integer_sample_counts = SAMPLE_COUNTS,
        .sampled_image_depth_sample_counts = SAMPLE_COUNTS,
        .sampled_image_stencil_sample_counts = SAMPLE_COUNTS,
        .storage_image_sample_counts = 1,
        .timestamp_period = 1,
    };
}
