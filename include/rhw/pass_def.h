// SPDX-License-Identifier: MIT
// These structs tell a pass what it works on: attachments, render area, clears, viewports, the commands of indirect
// draws and the targets of transform feedback.
#ifndef RHW_PASS_DEF_H
#define RHW_PASS_DEF_H

#include "types.h"

// Attachments ---------------------------------------------------------------------------------------

/// What an attachment holds when the pass begins.
enum rhw_load {
    /// Clear to the attachment's clear value, as CLEAR does. A depth attachment whose clear value is 0 is cleared to 1,
    /// so a zeroed definition clears depth to 1. If the first draw of the pass passes for greater depth then, nothing
    /// of it is seen, which a context that validates tells as misuse. To clear depth to 0, use CLEAR.
    RHW_LOAD_DEFAULT,
    RHW_LOAD_CLEAR,  ///< clear to the attachment's clear value
    RHW_LOAD_LOAD,   ///< keep what the texture holds
    RHW_LOAD_DISCARD ///< start with unspecified values
};

/// What becomes of an attachment when the pass ends.
enum rhw_store {
    RHW_STORE_STORE,  ///< write to the texture
    RHW_STORE_DISCARD ///< leave unspecified values in the texture
};

/// How the samples of a pixel become one texel. A resolve of an integer format takes the first sample, whatever the
/// mode. Stencil, though it is an integer, follows the mode.
enum rhw_resolve {
    RHW_RESOLVE_DEFAULT, ///< AVERAGE for colour, SAMPLE_ZERO for depth and stencil
    RHW_RESOLVE_AVERAGE, ///< the average; of sRGB formats the average of linear light
    RHW_RESOLVE_MIN,
    RHW_RESOLVE_MAX,
    RHW_RESOLVE_SAMPLE_ZERO,
    RHW_RESOLVE_NONE ///< rhw_depth_attachment.resolve keeps the depth, or the stencil, that it holds
};

struct rhw_color_attachment {
    /// The texture to draw into. In a multisampled pass it has either the samples of the pass, which are stored, or one
    /// sample, into which the samples of the pass are resolved. The null id leaves the attachment out; the other
    /// attachments keep their numbers (VK_ATTACHMENT_UNUSED; null in WebGPU's colorAttachments). Clears skip an
    /// attachment that is left out, and RHW_USE_COLOR_INPUT reads 0 from it. At least one attachment must have a
    /// texture.
    rhw_texture texture;
    /// A texture that the samples are resolved into besides, whether the samples are stored or discarded; or the null
    /// id.
    rhw_texture resolve;
    enum rhw_resolve resolve_mode;
    enum rhw_load load;
    enum rhw_store store;
    float clear[4];           ///< linear clear value; 0 for integer formats
    int32_t clear_integer[4]; ///< clear value of UINT and SINT formats, which take the low bits
    /// Mip level of `texture` and of `resolve`; default 0. A pass without a size takes the size of this level.
    int level;
    int layer; ///< first layer of an array, 6 × cube + face, or first slice of a 3D texture; default 0
    /// The number of layers, or of slices of a 3D texture, that the pass draws into, from `layer` on. The member
    /// `layer` of the vertex function selects one of them (Vulkan 1.3 §8.3, layers of a framebuffer). All attachments
    /// of a pass have the same number. 0 means 1.
    int layer_count;
};

/// The attachment of depth, of stencil, or of both, as the texture's format has them.
struct rhw_depth_attachment {
    bool enabled;
    /// The texture; or the null id if the pass loads by CLEAR or DEFAULT and stores by DISCARD. An attachment without a
    /// texture needs no memory.
    rhw_texture texture;
    /// The format of an attachment without a texture; RHW_FORMAT_NONE means D32_FLOAT. With a texture it is the
    /// texture's format or RHW_FORMAT_NONE.
    enum rhw_format format;
    enum rhw_load load;
    enum rhw_store store;
    float clear; ///< clear value of depth, 0..1; see RHW_LOAD_DEFAULT
    enum rhw_load stencil_load;
    enum rhw_store stencil_store;
    uint8_t stencil_clear;
    int level; ///< mip level; default 0
    int layer; ///< first layer, as in struct rhw_color_attachment
    /// The number of layers, as in struct rhw_color_attachment. An attachment without a texture has as many layers as
    /// the colour attachments.
    int layer_count;
    /// If read_only is true, the pass tests depth and never writes it; stencil_read_only says so of stencil. The
    /// texture's values are loaded, stay as they are, and may be sampled in the same pass. The pass refuses pipelines
    /// that write them. The load operation is DEFAULT or LOAD then, and the store operation is STORE, which writes
    /// nothing (WebGPU, depthReadOnly and stencilReadOnly; VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL).
    bool read_only, stencil_read_only;
    /// A texture that the samples are resolved into besides, whether they are stored or discarded; or the null id. It
    /// has the same format, or that of one aspect, which alone is resolved then: D24_UNORM or S8_UINT for
    /// D24_UNORM_S8_UINT. Depth and stencil have a mode each (VkSubpassDescriptionDepthStencilResolve).
    rhw_texture resolve;
    /// How depth is resolved, if `texture` has fewer samples than the pass or `resolve` is set.
    enum rhw_resolve resolve_mode;
    /// How stencil is resolved. DEFAULT takes the mode of depth, NONE included. AVERAGE takes the first sample.
    enum rhw_resolve stencil_resolve_mode;
};

/// A rectangle of pixels.
struct rhw_rect {
    int x, y, width, height;
};

/// The definition of a pass. A pass without attachments serves effects and queries; it must set its size, and it may
/// set its samples and layers.
struct rhw_pass_def {
    /// Size of the pass in pixels, from the top left of its attachments. Attachments must be at least as large. The
    /// pass neither loads, clears, draws nor stores what lies beyond its size (Vulkan 1.3, VkFramebufferCreateInfo). If
    /// it is 0, the pass has the size of the first attachment, and the other attachments must have that size too.
    int width, height;
    struct rhw_color_attachment colors[RHW_MAX_COLOR_ATTACHMENTS];
    int color_count;
    struct rhw_depth_attachment depth;
    /// Samples of each pixel: 1, 2, 4, 8 or 16. 0 takes the samples of the first attachment's texture.
    int samples;
    /// Layers of a pass without attachments; 0 means 1. A pass with attachments has the layers of its first attachment.
    int layers;
    /// The pixels that the pass loads, clears, draws, stores and resolves, within its size. All other pixels of the
    /// attachments stay as they are. Every scissor is cut to the render area (Vulkan 1.3 §8.8, renderArea, where the
    /// program must stay inside). If all members are 0, the render area is the whole pass.
    struct rhw_rect render_area;
    const char *label; ///< name in messages, or NULL
};

/// rhw_pass_clear_attachments clears these attachments to these values.
struct rhw_clear {
    uint32_t colors; ///< bit i selects colour attachment i of the pass
    bool depth, stencil;
    float color[RHW_MAX_COLOR_ATTACHMENTS][4]; ///< linear values for formats that are no integers
    int32_t color_integer[RHW_MAX_COLOR_ATTACHMENTS]
                         [4]; ///< values for UINT and SINT formats, within the format's range
    float depth_value;        ///< 0..1
    uint8_t stencil_value;
    const struct rhw_rect *rects; ///< rectangles within the pass's render area; read during the call
    int rect_count;               ///< 0 clears everything
    int layer;                    ///< first layer of the pass
    int layer_count;              ///< number of layers; 0 takes all from `layer` on
};

// Commands of indirect draws ------------------------------------------------------------------------

/// rhw_pass_draw_indirect reads this struct from a buffer. The members mean what the parameters of rhw_pass_draw with
/// the same names mean (VkDrawIndirectCommand).
struct rhw_draw_command {
    uint32_t count, instances, first, first_instance;
};

/// rhw_pass_draw_indexed_indirect reads this struct from a buffer. The members mean what the parameters of
/// rhw_pass_draw_indexed with the same names mean (VkDrawIndexedIndirectCommand).
struct rhw_draw_indexed_command {
    uint32_t count, instances, first;
    int32_t base_vertex;
    uint32_t first_instance;
};

/// The place where indirect draws find their commands.
struct rhw_draw_commands {
    rhw_buffer buffer;
    size_t offset;   ///< bytes to the first command, a multiple of 4
    uint32_t stride; ///< bytes from one command to the next, a multiple of 4; 0 means tightly packed
    uint32_t count;  ///< number of commands, or the greatest number with `count_buffer`
    rhw_buffer
        count_buffer;    ///< buffer with a uint32_t that is the number of commands; the null id takes `count`
    size_t count_offset; ///< bytes to the uint32_t in `count_buffer`, a multiple of 4
};

/// The place where rhw_pass_draw_indirect_byte_count finds its number of vertices, and the rest of the draw.
struct rhw_draw_byte_count {
    rhw_buffer buffer;       ///< buffer with a uint32_t, the counter, which is a number of bytes
    size_t offset;           ///< bytes to the counter, a multiple of 4
    uint32_t counter_offset; ///< number of the counted bytes that are no vertices
    uint32_t stride;         ///< bytes of a vertex, at least 1
    uint32_t first_instance, instances;
};

// Transform feedback --------------------------------------------------------------------------------

/// A range of a buffer, or of memory of the program, that a pass writes the feedback_outputs of pipelines to. Bytes
/// that no output writes stay as they are.
struct rhw_feedback_target {
    rhw_buffer buffer; ///< buffer; or the null id with `memory`, and if no output names this target
    size_t offset;     ///< bytes to the first vertex, a multiple of 4
    /// Bytes that may be written from `offset` on. 0 takes all up to the end of the buffer; with `memory` it is misuse.
    size_t size;
    /// Memory of the program to write to in place of a buffer, at an address that is a multiple of 4; or NULL. The
    /// library keeps no record of it. The memory must stay until the pass has ended, and nothing else may read or write
    /// the bytes until then.
    void *memory;
};

// Viewports -----------------------------------------------------------------------------------------

/// A viewport maps x and y from −1..1 to pixels. Triangles and lines are clipped at its edges. A point is kept or
/// dropped by its centre, so a point near an edge reaches beyond the viewport (Vulkan 1.3 §27.4); rhw_pass_set_scissor
/// cuts it off. Positions are rounded to 1/256 pixel after x and y are added, so a viewport that is moved by whole
/// pixels need not draw the same bytes to the last bit.
///
/// If the height is negative, y is the lower edge, y + height is the upper edge, and Y of clip space points down, as
/// Vulkan's Y does with a positive height (VK_KHR_maintenance1). So Vulkan's x, y, width, height is x, y + height,
/// width, −height here. Facing is decided on the screen and turns over too. A viewport of height 0 shows only points.
struct rhw_viewport {
    float x, y;   ///< pixels from the top left; all corners lie within ±2·RHW_MAX_TARGET_SIZE
    float width;  ///< pixels, above 0 and at most RHW_MAX_TARGET_SIZE
    float height; ///< pixels, within ±RHW_MAX_TARGET_SIZE
    /// The range of depth, each 0..1. A depth_min above depth_max reverses depth. If both are 0, the range is 0..1. For
    /// a range that is depth 0 alone, set depth_max to −1, which counts as 0.
    float depth_min, depth_max;
};

/// Return a definition that clears colours to 0 and depth to 1, and stores both.
RHW_API struct rhw_pass_def rhw_pass_def_default(void);

#endif
