// SPDX-License-Identifier: MIT
// What a pass is told as structs: its attachments and render area, what it clears, viewports, commands of draws.
#ifndef RHW_PASS_DEF_H
#define RHW_PASS_DEF_H

#include "types.h"

/// DEFAULT clears as CLEAR does, but for a depth of 0, which it takes for 1: clear to depth 0 by CLEAR.
/// A first draw that asks for greater depth than such a 1 is misuse.
enum rhw_load { RHW_LOAD_DEFAULT, RHW_LOAD_CLEAR, RHW_LOAD_LOAD, RHW_LOAD_DISCARD };
enum rhw_store { RHW_STORE_STORE, RHW_STORE_DISCARD };

/// How the samples of a pixel become one texel. AVERAGE is in linear light for sRGB. Of integers but
/// stencil the first is taken, whatever the mode.
enum rhw_resolve {
    RHW_RESOLVE_DEFAULT, ///< AVERAGE for colour, SAMPLE_ZERO for depth and stencil
    RHW_RESOLVE_AVERAGE,
    RHW_RESOLVE_MIN,
    RHW_RESOLVE_MAX,
    RHW_RESOLVE_SAMPLE_ZERO,
    RHW_RESOLVE_NONE ///< of depth or stencil, of which rhw_depth_attachment.resolve keeps what it holds
};

struct rhw_color_attachment {
    /// In a multisampled pass: with the pass's samples, which are stored; or with one, into which they are resolved.
    /// Null: the attachment is left out and the others keep their numbers (VK_ATTACHMENT_UNUSED; null in WebGPU's
    /// colorAttachments); clears pass it by, and as an input it is 0. One is there at least.
    rhw_texture texture;
    rhw_texture resolve; ///< what samples that are stored, or discarded, are resolved into besides; may be null
    enum rhw_resolve resolve_mode;
    enum rhw_load load;
    enum rhw_store store;
    float clear[4];           ///< linear values; of integers: 0, see clear_integer
    int layer;                ///< of an array; 6 × cube + face; slice of a 3D texture. 0
    int32_t clear_integer[4]; ///< of UINT and SINT formats, which take the low bits
    int level; ///< of mip levels, its texture's and that of `resolve`; it gives a pass its size that names none. 0
    /// Layers, or slices of a 3D texture, from `layer` on that the pass draws into, each where the vertex function's
    /// `layer` says so (Vulkan 1.3 §8.3, layers of a framebuffer); every attachment has as many. 0: 1
    int layer_count;
};

/// Depth and stencil; what the texture's format has of them.
struct rhw_depth_attachment {
    bool enabled;
    rhw_texture texture; ///< may be null when loaded by CLEAR and stored by DISCARD: it then needs no memory
    enum rhw_format format; ///< without a texture; NONE: D32_FLOAT. With one: its own, or NONE
    enum rhw_load load;
    enum rhw_store store;
    float clear; ///< 0..1; see rhw_load
    enum rhw_load stencil_load;
    enum rhw_store stencil_store;
    uint8_t stencil_clear;
    enum rhw_resolve
        resolve_mode; ///< of depth, where `texture` has fewer samples than the pass, or `resolve` is set
    int layer, level; ///< as those of a colour attachment
    int layer_count;  ///< as that of a colour attachment; without a texture there are as many as colours have
    /// Depth, or stencil, is tested and never written: what the texture holds is loaded and stays as it is, and may be
    /// sampled in the same pass. Pipelines that write it are refused. Its load operation is DEFAULT or LOAD then, its
    /// store operation STORE, which stores nothing (WebGPU's depthReadOnly and stencilReadOnly;
    /// VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL).
    bool read_only, stencil_read_only;
    /// What samples that are stored, or discarded, are resolved into besides, depth and stencil each by its mode
    /// (VkSubpassDescriptionDepthStencilResolve); of the texture's format; may be null.
    rhw_texture resolve;
    enum rhw_resolve stencil_resolve_mode; ///< DEFAULT: that of depth, NONE too; AVERAGE is SAMPLE_ZERO
};

struct rhw_rect {
    int x, y, width, height;
}; ///< pixels

/// Without attachments, for effects and queries alone, a pass says its size, samples and layers itself.
struct rhw_pass_def {
    /// Pixels of the pass, from the top left of its attachments, which are at least as large: what lies beyond is
    /// neither loaded, cleared, drawn nor stored (Vulkan 1.3, VkFramebufferCreateInfo). 0: the first attachment's, and
    /// the others'.
    int width, height;
    struct rhw_color_attachment colors[RHW_MAX_COLOR_ATTACHMENTS];
    int color_count;
    struct rhw_depth_attachment depth;
    int samples;       ///< of each pixel: 0: as many as the first attachment's texture has; 1, 2, 4, 8, 16
    const char *label; ///< for messages
    int layers;        ///< of a pass without attachments; others have those of the first. 0: 1
    /// The pixels that are loaded, cleared, drawn, stored and resolved, within the pass: the others of its attachments
    /// stay as they are (Vulkan 1.3 §8.8, renderArea; there the program stays inside, here every scissor is cut to it).
    /// All 0: the whole pass.
    struct rhw_rect render_area;
};

/// What rhw_pass_clear_attachments clears, and to what.
struct rhw_clear {
    uint32_t colors; ///< bit i: colour attachment i of the pass
    bool depth, stencil;
    float color[RHW_MAX_COLOR_ATTACHMENTS][4];           ///< linear values, of formats that are no integers
    int32_t color_integer[RHW_MAX_COLOR_ATTACHMENTS][4]; ///< of UINT and SINT formats, within their range
    float depth_value;                                   ///< 0..1
    uint8_t stencil_value;
    const struct rhw_rect *rects; ///< within the pass's render area; read during the call
    int rect_count;               ///< 0: everything
    int layer, layer_count;       ///< of the pass's; 0: all from `layer` on
};

/// What rhw_pass_draw_indirect reads from a buffer; the members mean what those parameters of rhw_pass_draw do
/// (VkDrawIndirectCommand).
struct rhw_draw_command {
    uint32_t count, instances, first, first_instance;
};

/// The same for rhw_pass_draw_indexed_indirect (VkDrawIndexedIndirectCommand).
struct rhw_draw_indexed_command {
    uint32_t count, instances, first;
    int32_t base_vertex;
    uint32_t first_instance;
};

/// Where draws find their commands.
struct rhw_draw_commands {
    rhw_buffer buffer;
    size_t offset;           ///< bytes to the first command; a multiple of 4
    uint32_t stride;         ///< bytes from one to the next, a multiple of 4; 0: one behind the other
    uint32_t count;          ///< commands; with `count_buffer` the most
    rhw_buffer count_buffer; ///< where a uint32_t says how many there are; null: `count`
    size_t count_offset;     ///< bytes to it; a multiple of 4
};

/// Where a pass writes what pipelines list as feedback_outputs. Of memory that is not written the bytes stay.
struct rhw_feedback_target {
    rhw_buffer buffer; ///< null where no output names this target
    size_t offset;     ///< bytes to the first vertex, a multiple of 4
    size_t size;       ///< bytes that may be written; 0: up to the end of the buffer
};

/// Where rhw_pass_draw_indirect_byte_count finds its number of vertices, and the rest of what it draws.
struct rhw_draw_byte_count {
    rhw_buffer buffer;       ///< where a uint32_t, the counter, says how many bytes there are
    size_t offset;           ///< bytes to it; a multiple of 4
    uint32_t counter_offset; ///< bytes of these that are no vertices
    uint32_t stride;         ///< bytes of a vertex, at least 1
    uint32_t first_instance, instances;
};

/// Where −1..1 in x and y goes. Triangles and lines are cut off at its edges; a point is kept or left out by its centre, and
/// one near an edge reaches beyond (Vulkan 1.3 §27.4): rhw_pass_set_scissor cuts that too. Positions are rounded to 1/256
/// pixel after x and y were added, so that a viewport moved by whole pixels need not draw the same bytes to the last bit.
/// With a negative height y is the lower edge and y + height the upper one, and Y of clip space points down, as
/// Vulkan's does with a positive height (VK_KHR_maintenance1): Vulkan's x, y, width, height is x, y + height, width,
/// −height here. Facing is that on the screen, and so turns over. A height of 0 shows nothing but points.
struct rhw_viewport {
    float x, y;   ///< pixels from the top left; corners within ±2·RHW_MAX_TARGET_SIZE
    float width;  ///< above 0, at most RHW_MAX_TARGET_SIZE
    float height; ///< within ±RHW_MAX_TARGET_SIZE
    float depth_min,
        depth_max; ///< 0..1; depth_min > depth_max reverses. Both 0: 0 and 1; for nothing but depth 0
                   ///< depth_max is −1, which counts as 0
};

RHW_API struct rhw_pass_def rhw_pass_def_default(void); ///< clears to 0 and depth 1, keeps both

#endif
