// SPDX-License-Identifier: MIT
// One struct holds the limits of the library. Its members have the names and meanings of members of
// VkPhysicalDeviceLimits (Vulkan 1.3, "Limits"). Each limit is at least what Vulkan 1.0 requires, unless its comment
// says otherwise.
#ifndef RHW_LIMITS_H
#define RHW_LIMITS_H

#include "base.h"

/// rhw_limits_get returns these limits.
struct rhw_limits {
    // Textures. Dimensions are texels in each direction. A cube counts as six layers.
    uint32_t max_image_dimension_1d, max_image_dimension_2d, max_image_dimension_3d, max_image_dimension_cube;
    uint32_t max_image_array_layers;
    uint32_t max_sampler_allocation_count;

    /// A draw has one block of uniforms of this many bytes. Vulkan has 12 uniform buffers for a stage; a program lays
    /// 12 of 65536 bytes out in the one block.
    uint32_t max_uniform_buffer_range;
    /// Both functions of a program share these slots. There are as many as Vulkan has for both stages together.
    uint32_t max_per_stage_descriptor_samplers, max_per_stage_descriptor_sampled_images;

    // Vertex input. Offsets and strides are in bytes.
    uint32_t max_vertex_input_attributes, max_vertex_input_bindings;
    uint32_t max_vertex_input_attribute_offset, max_vertex_input_binding_stride;
    uint32_t max_draw_indexed_index_value, max_draw_indirect_count;

    // Values that go from the vertex function to the fragment function. Components are floats. Positions, point sizes
    // and clip and cull distances do not count as components.
    uint32_t max_vertex_output_components, max_fragment_input_components;
    uint32_t max_clip_distances, max_cull_distances, max_combined_clip_and_cull_distances;

    // Attachments. Sample counts are or-ed numbers of samples.
    uint32_t max_framebuffer_width, max_framebuffer_height;
    uint32_t max_color_attachments, max_fragment_output_attachments, max_fragment_dual_src_attachments;
    uint32_t framebuffer_color_sample_counts;
    uint32_t framebuffer_depth_sample_counts, framebuffer_stencil_sample_counts;
    uint32_t framebuffer_no_attachments_sample_counts;
    uint32_t max_sample_mask_words;

    // Rasterization. Sizes are in pixels. Precisions are bits behind the binary point.
    uint32_t sub_pixel_precision_bits;
    uint32_t max_framebuffer_layers, max_viewports;
    uint32_t max_viewport_dimensions[2];
    float viewport_bounds_range[2]; ///< least and greatest coordinate of a viewport's corners
    uint32_t viewport_sub_pixel_bits;
    float point_size_range[2], point_size_granularity;
    float line_width_range[2], line_width_granularity;
    bool standard_sample_locations;
    /// Offsets in pixels that rhw_interpolate_at takes. The function takes any offset. Within this range floats have at
    /// least sub_pixel_interpolation_offset_bits bits behind the point.
    float min_interpolation_offset, max_interpolation_offset;
    uint32_t sub_pixel_interpolation_offset_bits;

    // Samplers. Weights of a filter have at least 15 bits. They have fewer where a float coordinate of 0..1 has no more
    // bits to give.
    uint32_t sub_texel_precision_bits, mipmap_precision_bits;
    float max_sampler_lod_bias;
    float max_sampler_anisotropy;
    int32_t min_texel_offset, min_texel_gather_offset;
    uint32_t max_texel_offset, max_texel_gather_offset;

    // Transform feedback (VkPhysicalDeviceTransformFeedbackPropertiesEXT). Sizes and strides are in bytes.
    uint32_t max_transform_feedback_streams, max_transform_feedback_buffers;
    uint64_t max_transform_feedback_buffer_size;
    uint32_t max_transform_feedback_stream_data_size, max_transform_feedback_buffer_data_size;
    uint32_t max_transform_feedback_buffer_data_stride;

    // Storage. Both functions of a program share the slots. Ranges and alignments are in bytes.
    uint32_t max_per_stage_descriptor_storage_buffers, max_per_stage_descriptor_storage_images;
    uint32_t max_per_stage_descriptor_input_attachments; ///< all colour targets, depth and stencil
    uint32_t max_fragment_combined_output_resources;
    uint32_t max_storage_buffer_range, max_texel_buffer_elements;
    uint32_t min_memory_map_alignment; ///< alignment of rhw_buffer_map's address less its offset
    uint32_t min_storage_buffer_offset_alignment, min_texel_buffer_offset_alignment;

    // Dispatches. Sizes are invocations; shared memory is in bytes. All slots are those of draws.
    uint32_t max_compute_shared_memory_size, max_compute_work_group_invocations;
    uint32_t max_compute_work_group_count[3], max_compute_work_group_size[3];

    // Sample counts of textures that rhw_sample_fetch_sample reads. It reads stencil through a view of R8_UINT.
    uint32_t sampled_image_color_sample_counts, sampled_image_integer_sample_counts;
    uint32_t sampled_image_depth_sample_counts, sampled_image_stencil_sample_counts;
    uint32_t storage_image_sample_counts;

    float timestamp_period; ///< nanoseconds of one step of rhw_query_counts.timestamp_ns
};

#endif
