// SPDX-License-Identifier: MIT
// What the library can do at most, as one struct. Members have the names of VkPhysicalDeviceLimits (Vulkan 1.3,
// "Limits") and mean what they mean there; each is at least what Vulkan 1.0 requires unless its comment says otherwise.
#ifndef RHW_LIMITS_H
#define RHW_LIMITS_H

#include "base.h"

struct rhw_limits {
    // Textures: texels, each way; layers, six for each cube.
    uint32_t max_image_dimension_1d, max_image_dimension_2d, max_image_dimension_3d, max_image_dimension_cube;
    uint32_t max_image_array_layers;
    uint32_t max_sampler_allocation_count;

    /// Bytes of the one block of uniforms that a draw has. Where Vulkan has 12 uniform buffers for a stage, a program
    /// lays them out in it: 12 of 65536 bytes fit.
    uint32_t max_uniform_buffer_range;
    /// Slots that both functions of a program share: as many as Vulkan has for the two together.
    uint32_t max_per_stage_descriptor_samplers, max_per_stage_descriptor_sampled_images;

    // Vertex input; offsets and strides in bytes.
    uint32_t max_vertex_input_attributes, max_vertex_input_bindings;
    uint32_t max_vertex_input_attribute_offset, max_vertex_input_binding_stride;
    uint32_t max_draw_indexed_index_value, max_draw_indirect_count;

    // Between the functions: floats. Positions, sizes and distances are not among them.
    uint32_t max_vertex_output_components, max_fragment_input_components;
    uint32_t max_clip_distances, max_cull_distances, max_combined_clip_and_cull_distances;

    // Targets.
    uint32_t max_framebuffer_width, max_framebuffer_height;
    uint32_t max_color_attachments, max_fragment_output_attachments, max_fragment_dual_src_attachments;
    uint32_t framebuffer_color_sample_counts; ///< or-ed numbers of samples
    uint32_t framebuffer_depth_sample_counts, framebuffer_stencil_sample_counts;
    uint32_t framebuffer_no_attachments_sample_counts;
    uint32_t max_sample_mask_words;

    // Rasterization: pixels, and bits behind the point.
    uint32_t sub_pixel_precision_bits;
    uint32_t max_framebuffer_layers, max_viewports;
    uint32_t max_viewport_dimensions[2];
    float viewport_bounds_range[2]; ///< of corners
    uint32_t viewport_sub_pixel_bits;
    float point_size_range[2], point_size_granularity;
    float line_width_range[2], line_width_granularity;
    bool standard_sample_locations;
    /// Pixels, of rhw_interpolate_at, which takes any; so far floats have those bits behind the point, nearer more.
    float min_interpolation_offset, max_interpolation_offset;
    uint32_t sub_pixel_interpolation_offset_bits;

    // Samplers. Weights have 15 bits at least; those of coordinates fewer where a float of 0..1 leaves no more.
    uint32_t sub_texel_precision_bits, mipmap_precision_bits;
    float max_sampler_lod_bias;
    float max_sampler_anisotropy;
    int32_t min_texel_offset, min_texel_gather_offset;
    uint32_t max_texel_offset, max_texel_gather_offset;

    // Transform feedback (VkPhysicalDeviceTransformFeedbackPropertiesEXT), bytes.
    uint32_t max_transform_feedback_streams, max_transform_feedback_buffers;
    uint64_t max_transform_feedback_buffer_size;
    uint32_t max_transform_feedback_stream_data_size, max_transform_feedback_buffer_data_size;
    uint32_t max_transform_feedback_buffer_data_stride;
    // Storage. Slots are shared by both functions of a program; offsets in bytes.
    uint32_t max_per_stage_descriptor_storage_buffers, max_per_stage_descriptor_storage_images;
    uint32_t max_per_stage_descriptor_input_attachments; ///< every colour target, depth and stencil
    uint32_t max_fragment_combined_output_resources;
    uint32_t max_storage_buffer_range, max_texel_buffer_elements;
    uint32_t min_memory_map_alignment; ///< of what rhw_buffer_map gives, less its offset
    uint32_t min_storage_buffer_offset_alignment, min_texel_buffer_offset_alignment;
    // By rhw_sample_fetch_sample; stencil by a view of R8_UINT.
    uint32_t sampled_image_color_sample_counts, sampled_image_integer_sample_counts;
    uint32_t sampled_image_depth_sample_counts, sampled_image_stencil_sample_counts;
    uint32_t storage_image_sample_counts;

    float timestamp_period; ///< nanoseconds of a step of rhw_query_counts.timestamp_ns
};

#endif
