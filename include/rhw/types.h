// SPDX-License-Identifier: MIT
// This header has the ids, enums and definition structs. A zeroed member of a `*_def` has its default, or the call that
// takes the struct says that the member is missing. Where zero could also be a value, for example a level 0 or no
// channel at all, a named constant asks for the value. `*_def_default` returns the defaults written out, with one
// colour target in a pipeline. pass_def.h has the definitions of passes, stats.h those of queries.
#ifndef RHW_TYPES_H
#define RHW_TYPES_H

#include "base.h"

// Ids and limits ------------------------------------------------------------------------------------

/// Buffers, textures, samplers, pipelines, passes and queries belong to one context. Several threads may use different
/// contexts at once, but one thread at a time may use a context. A call that meets another call of the same context, or
/// that comes from a shader function, is misuse and does nothing. A shader function of one context may use another
/// context, one call at a time, as other code on that thread may.
typedef struct rhw_context rhw_context;

/// An id names a thing in a context. A zeroed id is the null id. To destroy the null id does nothing. It is misuse to
/// use an id whose thing was destroyed, or an id of another context. Ids name the same thing if all their members are
/// equal.
typedef struct rhw_buffer { uint32_t index, generation, context; } rhw_buffer;
typedef struct rhw_texture { uint32_t index, generation, context; } rhw_texture;
typedef struct rhw_sampler { uint32_t index, generation, context; } rhw_sampler;
typedef struct rhw_pipeline { uint32_t index, generation, context; } rhw_pipeline;
typedef struct rhw_pass { uint32_t index, generation, context; } rhw_pass;
typedef struct rhw_query { uint32_t index, generation, context; } rhw_query;

enum {
    RHW_MAX_THREADS = 64,
    RHW_MAX_TARGET_SIZE = 16384,     ///< pixels in each direction; integer edge functions could overflow beyond it
    RHW_MAX_COLOR_ATTACHMENTS = 8,
    RHW_MAX_SAMPLES = 16,            ///< samples of a pixel
    RHW_MAX_VIEWPORTS = 16,          ///< viewports of a pass, and scissors of a pass
    RHW_MAX_TEXTURE_DEPTH = 2048,    ///< slices of a 3D texture
    RHW_MAX_TEXTURE_LAYERS = 2048,   ///< layers of an array; a cube has six
    RHW_MAX_VERTEX_BUFFERS = 16,
    RHW_MAX_ATTRIBUTES = 16,
    RHW_MAX_VARYINGS = 64,
    RHW_MAX_VARYING_COMPONENTS = 128, ///< floats of all varyings of a program together
    RHW_MAX_CLIP_DISTANCES = 8,
    RHW_MAX_CULL_DISTANCES = 8,
    RHW_MAX_GROUPS = 16,             ///< groups of 8 lanes in one call of a shader function
    RHW_MAX_UNIFORM_SIZE = 1 << 20,  ///< bytes
    RHW_MAX_TEXTURES = 32,           ///< texture slots of a draw, which both functions share
    RHW_MAX_STORAGE_BUFFERS = 16,    ///< storage slots of a draw
    RHW_MAX_STORAGE_IMAGES = 16,     ///< image slots of a draw, for storage images and texel buffers
    RHW_MAX_TEXEL_BUFFER = 1 << 27,  ///< texels of a texel buffer
    RHW_MAX_FEEDBACK_TARGETS = 4,    ///< targets of transform feedback
    RHW_MAX_FEEDBACK_OUTPUTS = 64,   ///< outputs of transform feedback
    RHW_MAX_POINT_SIZE = 256,        ///< pixels; the least size is 1
    RHW_MAX_LINE_WIDTH = 256,        ///< pixels; the least width is 1
    RHW_MAX_LINE_STIPPLE_FACTOR = 256
};

// Contexts ------------------------------------------------------------------------------------------

/// The kernels are compiled for these instruction sets, slowest first. All of them draw the same bytes. BASELINE is the
/// specification: SSE2 on x86-64, NEON on 64-bit ARM, elsewhere what the compiler was told to use. AVX2 is with FMA.
enum rhw_isa { RHW_ISA_BASELINE, RHW_ISA_AVX2, RHW_ISA_AVX512, RHW_ISA_COUNT };

/// The highest instruction set that a context may use. The context takes the highest one up to it that the CPU has.
/// BEST is the limit that measured fastest: AVX2, because AVX-512 gains nothing to speak of yet (docs/performance.md).
/// rhw_isa_up_to gives the limit for an rhw_isa.
enum rhw_isa_limit { RHW_ISA_BEST, RHW_ISA_UP_TO_BASELINE, RHW_ISA_UP_TO_AVX2, RHW_ISA_UP_TO_AVX512 };

/// The paths through the kernels that a context takes. Special paths draw the bytes of the general path in less time. A
/// program that only wants its picture takes ALL.
enum rhw_paths {
    RHW_PATHS_ALL,
    RHW_PATHS_IN_ORDER, ///< all paths, but hidden opaque fragments are shaded in their turn too; for measuring
    RHW_PATHS_GENERAL   ///< the general path alone; for study of the kernels, and to find which path has a fault
};

/// A context that validates finds what the library accepts and a program rarely means. It draws the same pictures and
/// takes several times as long. It reports these as misuse:
///
/// - A shader function reads what its program does not declare, or discards or writes depth without saying so.
/// - A shader function leaves colours, positions or varyings unwritten, or works on the first of its groups alone.
/// - A shader function samples a slot that does not exist or has no texture, or a level above 0 that was never written.
/// - A shader function samples with a reference where the sampler does not compare, or without one where it does.
/// - A draw reaches outside of its buffers.
/// - A pass reads memory of the program that it also writes, or writes it in two ways.
/// - An index offset is odd.
/// - A clear value is NaN.
///
/// The context reports what a shader function did when the pass ends, for the earliest draw that did it, with the draw
/// and a pixel. It logs these as warnings: NaN in colours, writes to targets that a pipeline lacks, blend factors
/// without blend, depth_read_only without depth_test, a depth attachment with a texture that is not enabled, and
/// attributes that end behind the stride of their buffer.
enum rhw_validation {
    RHW_VALIDATE_DEFAULT, ///< on if the file that creates the context has neither optimization nor NDEBUG
    RHW_VALIDATE_ON,
    RHW_VALIDATE_OFF
};

struct rhw_context_def {
    /// The number of threads that draw, 1..64: the caller's thread and worker threads. 1 means the caller's thread
    /// alone. 0 takes as many threads as the process may use whole cores' time, by affinity and by the limits of
    /// control groups. A process that may use one core and a half gets 1.
    int threads;
    enum rhw_isa_limit isa_limit;   ///< default RHW_ISA_BEST
    enum rhw_paths paths;           ///< default RHW_PATHS_ALL
    enum rhw_validation validate;   ///< default RHW_VALIDATE_DEFAULT
    /// The bytes of binned geometry that a pass may keep before it is flushed to its tiles; 0 means 512 MiB.
    size_t bin_memory;
    struct rhw_allocator allocator; ///< zeroed: malloc, and pages of the system for large blocks
    rhw_log_function *log;          ///< NULL: silent; a context that validates prints warnings to stderr
    rhw_assert_function *assert_;   ///< NULL: print to stderr and abort
    void *user;                     ///< first argument of `log` and `assert_`
    /// A name in messages, or NULL. The library copies its first 63 bytes, as it does with every label.
    const char *label;
};

// Formats -------------------------------------------------------------------------------------------

/// A texel format. Channels stand in memory in the order of the name, little endian, as in Vulkan's format of the same
/// name; RGBA8 is Vulkan's A8B8G8R8 of 32 bits. UNORM is a part of 0..1 and SNORM a part of −1..1; the least code of
/// SNORM is −1, as the next one is. Floats are rounded to UNORM and SNORM to nearest, ties to even. UINT and SINT give
/// the integer's bits in the lanes, unconverted (rhw_bits_from_float), and take the low bits of the lanes. They have no
/// blending and are sampled with nearest filters.
enum rhw_format {
    RHW_FORMAT_NONE,
    RHW_FORMAT_R8_UNORM, RHW_FORMAT_RG8_UNORM, RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_BGRA8_UNORM, RHW_FORMAT_ABGR8_UNORM,
    // SRGB formats store colour with the sRGB transfer function and alpha linearly.
    RHW_FORMAT_R8_SRGB, RHW_FORMAT_RG8_SRGB, RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_BGRA8_SRGB, RHW_FORMAT_ABGR8_SRGB,
    RHW_FORMAT_R8_SNORM, RHW_FORMAT_RG8_SNORM, RHW_FORMAT_RGBA8_SNORM,
    RHW_FORMAT_R8_UINT, RHW_FORMAT_RG8_UINT, RHW_FORMAT_RGBA8_UINT,
    RHW_FORMAT_R8_SINT, RHW_FORMAT_RG8_SINT, RHW_FORMAT_RGBA8_SINT,
    RHW_FORMAT_R16_UNORM, RHW_FORMAT_RG16_UNORM, RHW_FORMAT_RGBA16_UNORM,
    RHW_FORMAT_R16_SNORM, RHW_FORMAT_RG16_SNORM, RHW_FORMAT_RGBA16_SNORM,
    RHW_FORMAT_R16_UINT, RHW_FORMAT_RG16_UINT, RHW_FORMAT_RGBA16_UINT,
    RHW_FORMAT_R16_SINT, RHW_FORMAT_RG16_SINT, RHW_FORMAT_RGBA16_SINT,
    RHW_FORMAT_R16_FLOAT, RHW_FORMAT_RG16_FLOAT, RHW_FORMAT_RGBA16_FLOAT,
    RHW_FORMAT_R32_UINT, RHW_FORMAT_RG32_UINT, RHW_FORMAT_RGBA32_UINT,
    RHW_FORMAT_R32_SINT, RHW_FORMAT_RG32_SINT, RHW_FORMAT_RGBA32_SINT,
    RHW_FORMAT_R32_FLOAT, RHW_FORMAT_RG32_FLOAT, RHW_FORMAT_RGBA32_FLOAT,
    // These formats are packed in a word of 16 or 32 bits with the first channel in the lowest bits. RGB10A2 is
    // Vulkan's A2B10G10R10, and RG11B10 is Vulkan's B10G11R11.
    RHW_FORMAT_RGB10A2_UNORM, RHW_FORMAT_RGB10A2_UINT,
    RHW_FORMAT_RG11B10_FLOAT, ///< floats without a sign: a negative value becomes 0, a finite value stays finite
    RHW_FORMAT_RGB9E5_FLOAT,  ///< floats without a sign that share an exponent; only sampled (Vulkan's E5B9G9R9)
    // These formats are packed in 16 bits with the first channel in the highest bits, as in Vulkan and OpenGL.
    RHW_FORMAT_RGB565_UNORM, RHW_FORMAT_RGBA4_UNORM, RHW_FORMAT_BGRA4_UNORM,
    RHW_FORMAT_RGB5A1_UNORM, RHW_FORMAT_A1RGB5_UNORM,
    // These are the formats of depth and stencil.
    RHW_FORMAT_D32_FLOAT,
    RHW_FORMAT_D16_UNORM,
    RHW_FORMAT_D24_UNORM,         ///< depth in the low 24 bits of 32; the other bits are 0
    RHW_FORMAT_D24_UNORM_S8_UINT, ///< depth as in D24_UNORM, and beside it a plane of stencil, one byte per texel
    RHW_FORMAT_D32_FLOAT_S8_UINT, ///< depth as in D32_FLOAT, and beside it a plane of stencil, one byte per texel
    RHW_FORMAT_S8_UINT,           ///< stencil alone; sampled through a view of R8_UINT
    // Compressed formats stand last. Textures of these formats are sampled and never drawn into. rhw_texture_write
    // takes blocks and decodes them; from then on the texels take the memory of rhw_format_decoded.
    RHW_FORMAT_BC1_RGB_UNORM, RHW_FORMAT_BC1_RGB_SRGB, RHW_FORMAT_BC1_RGBA_UNORM, RHW_FORMAT_BC1_RGBA_SRGB,
    RHW_FORMAT_BC2_UNORM, RHW_FORMAT_BC2_SRGB, RHW_FORMAT_BC3_UNORM, RHW_FORMAT_BC3_SRGB,
    RHW_FORMAT_BC4_UNORM, RHW_FORMAT_BC4_SNORM, RHW_FORMAT_BC5_UNORM, RHW_FORMAT_BC5_SNORM,
    RHW_FORMAT_BC6H_UFLOAT, RHW_FORMAT_BC6H_SFLOAT, RHW_FORMAT_BC7_UNORM, RHW_FORMAT_BC7_SRGB,
    RHW_FORMAT_ETC2_RGB8_UNORM, RHW_FORMAT_ETC2_RGB8_SRGB, RHW_FORMAT_ETC2_RGB8A1_UNORM, RHW_FORMAT_ETC2_RGB8A1_SRGB,
    RHW_FORMAT_ETC2_RGBA8_UNORM, RHW_FORMAT_ETC2_RGBA8_SRGB,
    RHW_FORMAT_EAC_R11_UNORM, RHW_FORMAT_EAC_R11_SNORM, RHW_FORMAT_EAC_RG11_UNORM, RHW_FORMAT_EAC_RG11_SNORM,
    // ASTC formats have low dynamic range. A block that they cannot have is opaque magenta.
    RHW_FORMAT_ASTC_4X4_UNORM, RHW_FORMAT_ASTC_4X4_SRGB, RHW_FORMAT_ASTC_5X4_UNORM, RHW_FORMAT_ASTC_5X4_SRGB,
    RHW_FORMAT_ASTC_5X5_UNORM, RHW_FORMAT_ASTC_5X5_SRGB, RHW_FORMAT_ASTC_6X5_UNORM, RHW_FORMAT_ASTC_6X5_SRGB,
    RHW_FORMAT_ASTC_6X6_UNORM, RHW_FORMAT_ASTC_6X6_SRGB, RHW_FORMAT_ASTC_8X5_UNORM, RHW_FORMAT_ASTC_8X5_SRGB,
    RHW_FORMAT_ASTC_8X6_UNORM, RHW_FORMAT_ASTC_8X6_SRGB, RHW_FORMAT_ASTC_8X8_UNORM, RHW_FORMAT_ASTC_8X8_SRGB,
    RHW_FORMAT_ASTC_10X5_UNORM, RHW_FORMAT_ASTC_10X5_SRGB, RHW_FORMAT_ASTC_10X6_UNORM, RHW_FORMAT_ASTC_10X6_SRGB,
    RHW_FORMAT_ASTC_10X8_UNORM, RHW_FORMAT_ASTC_10X8_SRGB, RHW_FORMAT_ASTC_10X10_UNORM, RHW_FORMAT_ASTC_10X10_SRGB,
    RHW_FORMAT_ASTC_12X10_UNORM, RHW_FORMAT_ASTC_12X10_SRGB, RHW_FORMAT_ASTC_12X12_UNORM, RHW_FORMAT_ASTC_12X12_SRGB,
    RHW_FORMAT_COUNT
};

/// What a texture of a format can be used for.
enum rhw_format_feature {
    RHW_FEATURE_SAMPLED = 1,              ///< shaders fetch and sample it
    RHW_FEATURE_FILTERED = 2,             ///< linear filters sample it, and rhw_texture_generate_mips works
    RHW_FEATURE_COLOR_ATTACHMENT = 4,     ///< passes draw into it
    RHW_FEATURE_BLENDED = 8,              ///< pipelines blend into it
    RHW_FEATURE_DEPTH_ATTACHMENT = 16,
    RHW_FEATURE_STENCIL_ATTACHMENT = 32,
    RHW_FEATURE_STORAGE_IMAGE = 64,       ///< rhw_pass_set_storage_image takes it
    RHW_FEATURE_STORAGE_ATOMIC = 128,     ///< rhw_image_atomic changes its texels
    RHW_FEATURE_TEXEL_BUFFER = 256        ///< rhw_pass_set_texel_buffer takes it
};

/// Return the or-ed rhw_format_feature of a format, or 0 if `format` is no format.
RHW_API uint32_t rhw_format_features(enum rhw_format format);

/// Return the bytes of a texel. If the format has depth and a plane of stencil, return the bytes of depth. If it is
/// compressed, return 0.
RHW_API size_t rhw_format_size(enum rhw_format format);

/// Return the width of a block in texels. It is 1 if the format is not compressed: a block is a texel then.
RHW_API int rhw_format_block_width(enum rhw_format format);

/// Return the height of a block in texels. It is 1 if the format is not compressed.
RHW_API int rhw_format_block_height(enum rhw_format format);

/// Return the bytes of a block.
RHW_API size_t rhw_format_block_bytes(enum rhw_format format);

/// Return the format that texels of a compressed format are decoded to, and in which rhw_texture_read gives them. It is
/// RGBA8_UNORM or RGBA8_SRGB; floats for BC4, BC5 and EAC; 16-bit floats for BC6H. Return `format` itself if it is not
/// compressed.
RHW_API enum rhw_format rhw_format_decoded(enum rhw_format format);

// Buffers -------------------------------------------------------------------------------------------

enum {
    RHW_MEMORY_ALIGNMENT = 64, ///< bytes; alignment of the memory of buffers and textures, and of rows of texels
    RHW_MEMORY_PADDING = 64    ///< bytes behind a texture, which kernels may load as parts of vectors
};

struct rhw_buffer_def {
    size_t size;      ///< bytes, at least 1
    const void *data; ///< bytes that are copied; NULL: zeros, or what `memory` holds
    /// Memory of the program that the bytes stand on, aligned to RHW_MEMORY_ALIGNMENT; or NULL for memory of the
    /// library. The program owns the memory, keeps it as long as the buffer, and may read and write it while no pass is
    /// recorded.
    void *memory;
    /// Bytes of `memory`, at least `size`. The library neither reads nor writes what lies behind the buffer's `size`
    /// bytes.
    size_t memory_size;
    const char *label; ///< name in messages, or NULL
};

// Textures ------------------------------------------------------------------------------------------

enum { RHW_MIP_LEVELS_ALL = -1 }; ///< value of rhw_texture_def.mip_levels: the chain down to a single texel

/// The kind of a texture. A CUBE has six square layers for the faces +x, −x, +y, −y, +z, −z, laid out as in Vulkan 1.3,
/// "Cube Map Face Selection".
enum rhw_texture_kind { RHW_TEXTURE_2D, RHW_TEXTURE_1D, RHW_TEXTURE_3D, RHW_TEXTURE_CUBE };

/// A texture is sampled, drawn into, or both. One pass may do both with different levels and layers (view.h). Texels
/// are 0 when the texture is created. A texture takes the bytes of its texels, decoded if the format is compressed,
/// with rows rounded up to 64 bytes. A 2D texture of RGBA8_SRGB takes 8 bytes more for each texel from the first pass
/// on that samples it. All levels and rounded rows of a texture that is no plain 2D texture have fewer than 2^31 texels
/// together.
struct rhw_texture_def {
    enum rhw_texture_kind kind; ///< default 2D
    enum rhw_format format;     ///< required
    int width, height; ///< texels, 1..RHW_MAX_TARGET_SIZE; equal for CUBE; the height of a 1D texture is 0 or 1
    int depth;         ///< slices of a 3D texture, 1..RHW_MAX_TEXTURE_DEPTH; 0 or 1 for other kinds
    /// The layers of an array, or the cubes of an array of cubes, from 1 on. 0 means that the texture is no array. A 3D
    /// texture has no layers.
    int layers;
    int mip_levels;    ///< number of levels; 0 means 1; RHW_MIP_LEVELS_ALL means all down to a single texel
    /// Samples of each texel; 0 means 1. A texture with 2, 4, 8 or 16 samples is a 2D target with one level, which
    /// shaders read by rhw_sample_fetch_sample alone.
    int samples;
    /// Memory of the program that the texels stand on, laid out as rhw_texture_query_layout says; or NULL for memory of
    /// the library. The texels are what the memory holds. The program owns the memory, keeps it as long as the texture
    /// and its views, and may read and write it while no pass is recorded.
    void *memory;
    size_t memory_size; ///< bytes of `memory`, at least the bytes of the layout
    /// If true, the program tells by rhw_texture_changed what it writes to `memory`, and the library relies on it. If
    /// false, every pass that uses the texture looks at all texels anew: it decodes an sRGB texture again and clears
    /// tiles that may be clear. Without `memory` it is false.
    bool memory_is_told;
    /// Bytes between rows, a multiple of RHW_MEMORY_ALIGNMENT, of a texture with one level. 0 means the bytes of a row,
    /// rounded up to RHW_MEMORY_ALIGNMENT.
    size_t row_pitch;
    const char *label;  ///< name in messages, or NULL
};

// Samplers ------------------------------------------------------------------------------------------

enum rhw_filter { RHW_FILTER_LINEAR, RHW_FILTER_NEAREST };
enum rhw_mip_filter { RHW_MIP_FILTER_LINEAR, RHW_MIP_FILTER_NEAREST, RHW_MIP_FILTER_NONE };

enum rhw_address {
    RHW_ADDRESS_REPEAT, RHW_ADDRESS_MIRROR, RHW_ADDRESS_CLAMP, RHW_ADDRESS_BORDER,
    /// The texture, its mirror image on the other side of 0, and beyond them the edge
    /// (VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE).
    RHW_ADDRESS_MIRROR_ONCE
};

enum rhw_compare {
    RHW_COMPARE_LESS, RHW_COMPARE_NEVER, RHW_COMPARE_EQUAL, RHW_COMPARE_LESS_EQUAL,
    RHW_COMPARE_GREATER, RHW_COMPARE_NOT_EQUAL, RHW_COMPARE_GREATER_EQUAL, RHW_COMPARE_ALWAYS
};

/// A filter makes one of these of the texels whose weight is above 0: their weighted average, or their least or
/// greatest value in each channel (Vulkan 1.3, VkSamplerReductionMode).
enum rhw_reduction { RHW_REDUCTION_AVERAGE, RHW_REDUCTION_MIN, RHW_REDUCTION_MAX };

struct rhw_sampler_def {
    enum rhw_filter min_filter, mag_filter; ///< default LINEAR
    enum rhw_mip_filter mip_filter;         ///< default LINEAR, which is trilinear where the texture has levels
    enum rhw_address address_u, address_v;  ///< default REPEAT
    enum rhw_address address_w;             ///< default REPEAT; for 3D textures. A cube has no edges and no addresses
    /// The colour of RHW_ADDRESS_BORDER in linear values; default 0, 0, 0, 0. Channels that a format lacks stay 0, 0,
    /// 0, 1.
    float border[4];
    int32_t border_integer[4]; ///< border of UINT and SINT formats, bit for bit; default 0, 0, 0, 0
    float lod_bias, lod_min;   ///< levels; default 0
    /// The highest level of detail; 0 means no limit. There is nothing above level 0, so any negative number limits to
    /// 0.
    float lod_max;
    /// The greatest number of samples along the longer axis of a gradient's footprint, at the level of detail of the
    /// shorter axis (Vulkan 1.3, "Scale Factor Operation" and "Texel Anisotropic Filtering"). 0 and 1 switch it off; 16
    /// is the most.
    float max_anisotropy;
    enum rhw_reduction reduction; ///< default AVERAGE
    /// If true, a texel becomes 1 if `reference compare texel` holds for its first channel, and 0 if not, before texels
    /// are filtered (Vulkan 1.3 §16.3.4). A linear filter then gives the part of the footprint that passes, which
    /// shadow maps want. See rhw_sample_compare_grad.
    bool compares;
    enum rhw_compare compare; ///< default LESS
    /// If true, coordinates are in texels of level 0. The filters must be equal, the addresses CLAMP or BORDER; there
    /// is no level but 0, no comparison and no anisotropy. The texture must be 1D or 2D and no array
    /// (VkSamplerCreateInfo, unnormalizedCoordinates).
    bool unnormalized;
    const char *label; ///< name in messages, or NULL
};

// Vertex input --------------------------------------------------------------------------------------

/// A vertex format says how an attribute stands in a buffer. FLOAT, HALF, UNORM and SNORM mean what they mean in texel
/// formats. USCALED and SSCALED give the value of an integer as a float. UINT and SINT give the integer's bits in the
/// lanes (rhw_bits_from_float). FLOAT64 gives the bits of both words of every number, the low word first. Three or four
/// 64-bit numbers are two attributes.
enum rhw_vertex_format {
    RHW_VERTEX_FLOAT1, RHW_VERTEX_FLOAT2, RHW_VERTEX_FLOAT3, RHW_VERTEX_FLOAT4,
    RHW_VERTEX_HALF1, RHW_VERTEX_HALF2, RHW_VERTEX_HALF3, RHW_VERTEX_HALF4,
    RHW_VERTEX_UNORM8X1, RHW_VERTEX_UNORM8X2, RHW_VERTEX_UNORM8X3, RHW_VERTEX_UNORM8X4,
    RHW_VERTEX_SNORM8X1, RHW_VERTEX_SNORM8X2, RHW_VERTEX_SNORM8X3, RHW_VERTEX_SNORM8X4,
    RHW_VERTEX_USCALED8X1, RHW_VERTEX_USCALED8X2, RHW_VERTEX_USCALED8X3, RHW_VERTEX_USCALED8X4,
    RHW_VERTEX_SSCALED8X1, RHW_VERTEX_SSCALED8X2, RHW_VERTEX_SSCALED8X3, RHW_VERTEX_SSCALED8X4,
    RHW_VERTEX_UINT8X1, RHW_VERTEX_UINT8X2, RHW_VERTEX_UINT8X3, RHW_VERTEX_UINT8X4,
    RHW_VERTEX_SINT8X1, RHW_VERTEX_SINT8X2, RHW_VERTEX_SINT8X3, RHW_VERTEX_SINT8X4,
    RHW_VERTEX_UNORM16X1, RHW_VERTEX_UNORM16X2, RHW_VERTEX_UNORM16X3, RHW_VERTEX_UNORM16X4,
    RHW_VERTEX_SNORM16X1, RHW_VERTEX_SNORM16X2, RHW_VERTEX_SNORM16X3, RHW_VERTEX_SNORM16X4,
    RHW_VERTEX_USCALED16X1, RHW_VERTEX_USCALED16X2, RHW_VERTEX_USCALED16X3, RHW_VERTEX_USCALED16X4,
    RHW_VERTEX_SSCALED16X1, RHW_VERTEX_SSCALED16X2, RHW_VERTEX_SSCALED16X3, RHW_VERTEX_SSCALED16X4,
    RHW_VERTEX_UINT16X1, RHW_VERTEX_UINT16X2, RHW_VERTEX_UINT16X3, RHW_VERTEX_UINT16X4,
    RHW_VERTEX_SINT16X1, RHW_VERTEX_SINT16X2, RHW_VERTEX_SINT16X3, RHW_VERTEX_SINT16X4,
    RHW_VERTEX_UINT32X1, RHW_VERTEX_UINT32X2, RHW_VERTEX_UINT32X3, RHW_VERTEX_UINT32X4,
    RHW_VERTEX_SINT32X1, RHW_VERTEX_SINT32X2, RHW_VERTEX_SINT32X3, RHW_VERTEX_SINT32X4,
    RHW_VERTEX_FLOAT64X1, RHW_VERTEX_FLOAT64X2,
    // These formats are words with x in the lowest 10 bits and w in the highest 2 bits (Vulkan's A2B10G10R10).
    RHW_VERTEX_UNORM10_10_10_2, RHW_VERTEX_SNORM10_10_10_2, RHW_VERTEX_USCALED10_10_10_2,
    RHW_VERTEX_SSCALED10_10_10_2, RHW_VERTEX_UINT10_10_10_2, RHW_VERTEX_SINT10_10_10_2,
    RHW_VERTEX_UNORM8X4_BGRA, ///< bytes z, y, x, w
    // These have z in the lowest 10 bits and x above y (Vulkan's A2R10G10B10).
    RHW_VERTEX_UNORM10_10_10_2_BGRA, RHW_VERTEX_SNORM10_10_10_2_BGRA, RHW_VERTEX_USCALED10_10_10_2_BGRA,
    RHW_VERTEX_SSCALED10_10_10_2_BGRA, RHW_VERTEX_UINT10_10_10_2_BGRA, RHW_VERTEX_SINT10_10_10_2_BGRA,
    RHW_VERTEX_FORMAT_COUNT
};

/// Return the bytes of one value.
RHW_API size_t rhw_vertex_format_size(enum rhw_vertex_format format);

/// Attribute i of `rhw_pipeline_def.attributes` arrives in the vertex function as `attribute[i]`. Components that the
/// format lacks are 0, 0, 0, 1; the 1 of UINT and SINT is the integer. FLOAT formats arrive bit for bit, so they may
/// carry integers.
struct rhw_attribute {
    enum rhw_vertex_format format;
    int buffer;      ///< index into rhw_pipeline_def.buffers
    /// Bytes from the start of the element. No alignment is asked. The attribute may end behind its element, as Vulkan
    /// allows; a context that validates logs a warning then.
    uint32_t offset;
};

/// A vertex layout says how the elements of a vertex buffer follow each other.
struct rhw_vertex_layout {
    /// Bytes from one element to the next. 0 means up to the end of the last attribute in this buffer, as in tightly
    /// packed elements.
    uint32_t stride;
    bool per_instance; ///< step with the instances of a draw instead of its vertices
    /// With per_instance, the number of instances that read the same element, counted from first_instance of the draw;
    /// 0 means 1. Instance i reads element firstInstance + ⌊(i − firstInstance) / step⌋
    /// (VK_EXT_vertex_attribute_divisor). It is 0 with `constant`.
    uint32_t instance_step;
    /// Every vertex of every instance reads element 0, as a stride of 0 means in Vulkan; `stride` is 0 then. With
    /// per_instance, every instance of a draw reads element first_instance, as a divisor of 0 means in Vulkan.
    bool constant;
};

// Varyings ------------------------------------------------------------------------------------------

/// How a varying is interpolated. FLAT takes the value of the provoking vertex bit for bit. So an integer id travels as
/// rhw_float_from_bits(id), and the fragment function reads it by rhw_bits_from_float, or writes it to an R32_UINT
/// target as it is.
enum rhw_qualifier { RHW_SMOOTH, RHW_NOPERSPECTIVE, RHW_FLAT };

/// The place in its pixel where a fragment of a multisampled pass takes a varying (Vulkan 1.3 §28.3). Depth,
/// coordinates and barycentric weights are those of the centre. If one varying asks for SAMPLE, or the fragment
/// function is called for each sample for another reason, everything is taken at the sample.
enum rhw_sampling {
    RHW_SAMPLING_CENTER,   ///< the pixel's centre, also where the triangle does not cover the centre
    RHW_SAMPLING_CENTROID, ///< the first sample that the triangle covers, or the centre if it covers all samples
    RHW_SAMPLING_SAMPLE    ///< every sample; the fragment function is called for each sample
};

/// A varying is a value that flows from the vertex function to the fragment function. The components of all varyings
/// stand one after the other in `varying[]` of both functions.
struct rhw_varying {
    int components; ///< 1..4
    enum rhw_qualifier qualifier;
    bool derivatives; ///< whether d/dx and d/dy per pixel of the components are asked for
    /// RHW_VARYING (shader_varying.h) sets the next three members where a struct describes the varyings, and
    /// rhw_pipeline_create checks them. They are 0 without a struct.
    const char *name;           ///< name of the struct's member
    uint16_t offset;            ///< offset of the member, in components
    uint16_t struct_components; ///< size of the whole struct, in components
    enum rhw_sampling sampling; ///< default CENTER
};

// Primitives ----------------------------------------------------------------------------------------

/// How vertices become primitives. Adjacency topologies have vertices beside those that are drawn; nothing reads them
/// (Vulkan 1.3 §21.1.7 to §21.1.10).
enum rhw_topology {
    RHW_TRIANGLE_LIST,
    /// An odd triangle i keeps the winding and the provoking vertex by its order: i, i+2, i+1 with provoking FIRST, and
    /// i+1, i, i+2 with LAST.
    RHW_TRIANGLE_STRIP,
    RHW_TRIANGLE_FAN, ///< triangle i has vertices i+1, i+2, 0 with provoking FIRST, and 0, i+1, i+2 with LAST
    RHW_POINT_LIST,   ///< points are squares, see rhw_program.writes_point_size
    RHW_LINE_LIST,    ///< lines have the width rhw_pipeline_def.line_width
    RHW_LINE_STRIP,
    RHW_LINE_LIST_ADJACENCY,      ///< line i has vertices 4i+1, 4i+2
    RHW_LINE_STRIP_ADJACENCY,     ///< line i has vertices i+1, i+2
    RHW_TRIANGLE_LIST_ADJACENCY,  ///< triangle i has vertices 6i, 6i+2, 6i+4
    RHW_TRIANGLE_STRIP_ADJACENCY, ///< a triangle strip of the even vertices
    RHW_LINE_LOOP ///< a line strip and the line from its last vertex to its first (OpenGL ES 3.2 §10.1.3)
};

enum rhw_index_type { RHW_INDEX_UINT8, RHW_INDEX_UINT16, RHW_INDEX_UINT32 };

/// The vertex of a primitive that flat varyings take their value from.
enum rhw_provoking { RHW_PROVOKING_FIRST, RHW_PROVOKING_LAST };

/// The source of floats that transform feedback keeps of a vertex.
enum rhw_feedback_source {
    RHW_FEEDBACK_POSITION, ///< clip coordinates
    RHW_FEEDBACK_VARYING, RHW_FEEDBACK_POINT_SIZE, RHW_FEEDBACK_CLIP_DISTANCES, RHW_FEEDBACK_CULL_DISTANCES
};

/// Floats of a vertex that transform feedback writes to a target (VK_EXT_transform_feedback; SPIR-V decorations
/// XfbBuffer, XfbStride and Offset).
struct rhw_feedback_output {
    enum rhw_feedback_source source; ///< default POSITION
    int index;                       ///< number of the varying, if the source is VARYING
    int first_component, component_count; ///< 0 and 0 mean all components
    int target;                      ///< 0..RHW_MAX_FEEDBACK_TARGETS − 1
    uint32_t offset;                 ///< bytes from the start of a vertex, a multiple of 4
};

// Rasterization -------------------------------------------------------------------------------------

/// The range of depth in clip space that the viewport maps to depth_min..depth_max.
enum rhw_depth_range { RHW_DEPTH_ZERO_TO_ONE, RHW_DEPTH_MINUS_ONE_TO_ONE };

/// What is drawn of a triangle that is not culled: all of it, its edges as lines, or its corners as points (Vulkan 1.3
/// §28.10.2). Facing and flat values are those of the triangle.
enum rhw_polygon_mode { RHW_POLYGON_FILL, RHW_POLYGON_LINE, RHW_POLYGON_POINT };

/// The triangles that are not drawn. Points and lines have no side and are always drawn. BOTH draws no triangle.
enum rhw_cull { RHW_CULL_NONE, RHW_CULL_FRONT, RHW_CULL_BACK, RHW_CULL_BOTH };

/// The order of vertices, as seen on the screen with y up, that makes a triangle face the front.
enum rhw_winding { RHW_COUNTER_CLOCKWISE, RHW_CLOCKWISE };

/// Which pixels a filled triangle covers, with all their samples (VK_EXT_conservative_rasterization). The test is exact
/// for the snapped triangle; a triangle without area covers no pixel. Values are taken at the pixel's centre, which may
/// lie outside of the triangle. Points and lines are drawn as with OFF.
enum rhw_conservative {
    RHW_CONSERVATIVE_OFF,          ///< the triangle covers samples
    RHW_CONSERVATIVE_OVERESTIMATE, ///< the triangle covers pixels whose square it touches or lies next to
    RHW_CONSERVATIVE_UNDERESTIMATE ///< the triangle covers pixels whose square it contains
};

/// How a line becomes pixels (Vulkan 1.3 §28.10; VK_EXT_line_rasterization).
enum rhw_line_mode {
    RHW_LINE_RECTANGULAR, ///< a line covers what lies between its ends, within half its width
    /// A line covers, by the diamond-exit rule, one pixel of each column or row that it passes, or as many pixels as
    /// its rounded width. It covers all samples of a pixel (Vulkan 1.3 §28.10.1).
    RHW_LINE_BRESENHAM,
    /// A line covers every pixel that its rectangle touches, with all samples. After the fragment function, the alpha
    /// of colour 0 is multiplied by the area of the pixel that the rectangle covers, but not in an integer format
    /// (Vulkan 1.3 §28.10, smooth lines). The alpha of other colours stays, also if target 0 is left out. The area is
    /// right to 2^−16; a pixel with less than that is not drawn. Where two lines meet, each line blends what it covers.
    /// A stipple draws the pixels whose centre lies in a piece that the stipple draws.
    RHW_LINE_RECTANGULAR_SMOOTH
};

/// A stipple draws the parts of a line where bit ⌊s / factor⌋ mod 16 of the pattern is 1, with bit 0 as the lowest bit
/// (Vulkan 1.3 §28.10, Line Stipple; VK_EXT_line_rasterization). Of a Bresenham line, s counts its columns or rows of
/// pixels from the beginning. Of a rectangular line, s is the distance of a sample from the beginning along the line,
/// in pixels, rounded to 1/256.
///
/// Every line of a list, and every edge of a triangle, begins with s = 0. A line of a strip begins with the s that the
/// line before it ended with: after all columns of that line, or after its length rounded to 1/256 pixel, whether it is
/// seen or not. If a plane cuts a line, the rest of the line has the s of the whole line. A line with an end that
/// cannot be snapped (W <= 0, or beyond the guard band) adds nothing to s. In a strip that names several viewports,
/// lengths are measured in the first one.
struct rhw_line_stipple {
    int factor; ///< 1..256; 0 means no stipple
    uint16_t pattern;
};

/// A depth bias is added to the depth of a triangle's fragments, to hold shadows and decals off their surfaces (Vulkan
/// 1.3 §26.11.4). The bias is slope · m + constant · r. m is the greater of |∂z/∂x| and |∂z/∂y| per pixel. r is the
/// step of the format: 2^-16 for D16, 2^-24 for D24, and 2^(e − 23) for D32_FLOAT, where e is the exponent of the
/// triangle's largest depth. A zeroed struct adds nothing.
struct rhw_depth_bias {
    float constant, slope; ///< finite
    float clamp;           ///< above 0: the greatest bias; below 0: the least bias; 0: no limit
};

// Depth and stencil tests ---------------------------------------------------------------------------

/// What a stencil test does to the stencil value (Vulkan 1.3 §27.13).
enum rhw_stencil_operation {
    RHW_STENCIL_KEEP, RHW_STENCIL_ZERO,
    RHW_STENCIL_REPLACE, ///< write the reference
    RHW_STENCIL_INCREMENT_CLAMP, RHW_STENCIL_DECREMENT_CLAMP, RHW_STENCIL_INVERT,
    RHW_STENCIL_INCREMENT_WRAP, RHW_STENCIL_DECREMENT_WRAP
};

enum { RHW_STENCIL_NO_BITS = 256 }; ///< value of read_mask and write_mask: no bits

/// The stencil test of the triangles that face one way. A fragment passes if `(reference & read_mask) compare (stencil
/// & read_mask)`. The operation writes the bits of its result where write_mask has bits.
struct rhw_stencil_face {
    bool compares;            ///< false: every fragment passes
    enum rhw_compare compare; ///< default LESS; read if compares is true
    enum rhw_stencil_operation fail;       ///< operation where the stencil test fails; default KEEP
    enum rhw_stencil_operation depth_fail; ///< operation where only the depth test fails; default KEEP
    enum rhw_stencil_operation pass;       ///< operation where both pass, or depth is not tested; default KEEP
    uint16_t read_mask, write_mask;        ///< 1..255; 0 means all bits; RHW_STENCIL_NO_BITS alone means none
};

/// The bits of the stencil value that tests read and operations write, for front and back faces. 0 means no bits.
struct rhw_stencil_masks {
    uint8_t read_front, read_back, write_front, write_back;
};

// Targets and blending ------------------------------------------------------------------------------

enum rhw_blend_factor {
    RHW_BLEND_DEFAULT, ///< ONE for src and ZERO for dst: the source replaces the destination
    RHW_BLEND_ZERO, RHW_BLEND_ONE,
    RHW_BLEND_SRC, RHW_BLEND_ONE_MINUS_SRC, RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA,
    RHW_BLEND_DST, RHW_BLEND_ONE_MINUS_DST, RHW_BLEND_DST_ALPHA, RHW_BLEND_ONE_MINUS_DST_ALPHA,
    RHW_BLEND_SRC_ALPHA_SATURATED, RHW_BLEND_CONSTANT, RHW_BLEND_ONE_MINUS_CONSTANT,
    RHW_BLEND_CONSTANT_ALPHA, RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA,
    // The SRC1 factors are dual-source blending. The second source is color[1] of the fragment function, and the
    // pipeline writes target 0 alone (Vulkan 1.3 §29.1.2, maxFragmentDualSrcAttachments 1).
    RHW_BLEND_SRC1, RHW_BLEND_ONE_MINUS_SRC1, RHW_BLEND_SRC1_ALPHA, RHW_BLEND_ONE_MINUS_SRC1_ALPHA
};
enum rhw_blend_operation {
    RHW_BLEND_ADD, RHW_BLEND_SUBTRACT, RHW_BLEND_REVERSE_SUBTRACT, RHW_BLEND_MIN, RHW_BLEND_MAX
};

/// The blend equation: src factor × source, operation, dst factor × destination.
struct rhw_blend_component {
    enum rhw_blend_factor src, dst;
    enum rhw_blend_operation operation;
};

enum rhw_write_mask {
    RHW_WRITE_RED = 1,
    RHW_WRITE_GREEN = 2,
    RHW_WRITE_BLUE = 4,
    RHW_WRITE_ALPHA = 8,
    RHW_WRITE_NONE = 16 ///< no channel; not or-ed with others
};

/// A logic operation on the bits of source and destination, in targets of integers, UNORM and SNORM. Targets of floats
/// and sRGB take the source unchanged (Vulkan 1.3 §29.2). No target is blended meanwhile. The write mask holds.
enum rhw_logic {
    RHW_LOGIC_OFF,
    RHW_LOGIC_CLEAR, RHW_LOGIC_AND, RHW_LOGIC_AND_REVERSE, RHW_LOGIC_COPY, RHW_LOGIC_AND_INVERTED, RHW_LOGIC_NO_OP,
    RHW_LOGIC_XOR, RHW_LOGIC_OR, RHW_LOGIC_NOR, RHW_LOGIC_EQUIVALENT, RHW_LOGIC_INVERT, RHW_LOGIC_OR_REVERSE,
    RHW_LOGIC_COPY_INVERTED, RHW_LOGIC_OR_INVERTED, RHW_LOGIC_NAND, RHW_LOGIC_SET
};

/// A colour target of a pipeline. A UNORM or sRGB target clamps the source to 0..1 before it blends, and a SNORM target
/// clamps it to −1..1. An sRGB target blends in linear light: it decodes the destination and encodes the result.
struct rhw_color_target {
    enum rhw_format format; ///< format of the attachment; NONE if the pass leaves the attachment out
    bool blend;             ///< false: the source replaces the destination
    /// The blend equations of colour and of alpha. Each has its own defaults: if only `color` is set, alpha is
    /// replaced.
    struct rhw_blend_component color, alpha;
    uint8_t write_mask;     ///< or-ed rhw_write_mask; 0 means all channels
};

// Programs ------------------------------------------------------------------------------------------

/// A program lists in `uses` what its fragment function does beyond reading varyings and writing colours. The library
/// fills the members of a fragment that the program asks for, and only those.
enum rhw_fragment_use {
    // These bits say what the fragment function receives.
    RHW_USE_COORD = 1 << 0,                   ///< coord: x, y, z and 1/w
    RHW_USE_FACING = 1 << 1,                  ///< front_facing
    RHW_USE_IDS = 1 << 2,                     ///< primitive, instance and draw
    RHW_USE_LAYER = 1 << 3,                   ///< layer and viewport_index
    RHW_USE_POINT_COORD = 1 << 4,             ///< point_coord
    RHW_USE_BARYCENTRIC = 1 << 5,             ///< barycentric (with perspective) and barycentric_noperspective
    RHW_USE_BARYCENTRIC_DERIVATIVES = 1 << 6, ///< barycentric_ddx and barycentric_ddy
    RHW_USE_FULLY_COVERED = 1 << 7,           ///< fully_covered
    RHW_USE_SAMPLE = 1 << 8,                  ///< sample_id and sample_position; the function is called per sample
    /// The function finds in `color` what the targets hold at the fragment's pixel, decoded: the result of all
    /// primitives that came before it, in their order (Vulkan 1.3, "Input Attachment Interface";
    /// VK_EXT_rasterization_order_attachment_access). In a multisampled pass the function is called for every sample.
    RHW_USE_COLOR_INPUT = 1 << 9,
    /// The function finds in `depth_input` what the depth attachment holds. Depth and stencil are tested after the
    /// function.
    RHW_USE_DEPTH_INPUT = 1 << 10,
    /// The function finds in `stencil_input` what the stencil attachment holds. Depth and stencil are tested after the
    /// function.
    RHW_USE_STENCIL_INPUT = 1 << 11,

    // This bit says what the fragment function both receives and changes.
    RHW_USE_SAMPLE_MASK = 1 << 12,            ///< sample_mask

    // These bits say what the fragment function does.
    RHW_USE_DISCARD = 1 << 13,                ///< it may clear lanes of `mask`
    RHW_USE_DEPTH = 1 << 14,                  ///< it writes `depth`
    RHW_USE_EFFECTS = 1 << 15                 ///< it writes storage or changes it by atomics; see early_fragment_tests
};

struct rhw_vertex;
struct rhw_fragment;
struct rhw_vertex1;
struct rhw_fragment1;

/// A shader function works on `count` groups of 8 lanes, 1..RHW_MAX_GROUPS, that stand one after the other. What it
/// writes must follow from the members of its groups, its uniforms, its textures and `user` alone. The library calls it
/// on any thread, in any order. It may call it more than once for a vertex that several triangles share, and for
/// vertices of the buffers that no triangle names. It may leave a fragment out that an opaque fragment hides, and may
/// call the function once for a whole draw if nothing that the function receives differs. docs/shaders.md says how
/// often the library calls a function that is declared to have effects (shader_storage.h).
typedef void rhw_vertex_function(struct rhw_vertex *groups, int count);
typedef void rhw_fragment_function(struct rhw_fragment *groups, int count);

/// A one-at-a-time function works on one vertex or one fragment, in the same pipeline. It uses plain floats and is
/// slower.
typedef void rhw_vertex1_function(struct rhw_vertex1 *vertex);
typedef void rhw_fragment1_function(struct rhw_fragment1 *fragment);

/// A program is a vertex function, a fragment function and what flows between them.
struct rhw_program {
    /// The functions on 8 lanes, by instruction set. Entry 0 (baseline) is enough. The same source compiled for other
    /// instruction sets may stand beside it; the context takes the best entry at or below its own instruction set. The
    /// fragment function may be NULL, which draws depth only. Every target must have the write mask RHW_WRITE_NONE
    /// then.
    rhw_vertex_function *vertex[RHW_ISA_COUNT];
    rhw_fragment_function *fragment[RHW_ISA_COUNT];
    rhw_vertex1_function *vertex1;     ///< used if every entry of `vertex` is NULL
    rhw_fragment1_function *fragment1; ///< used if every entry of `fragment` is NULL

    struct rhw_varying varyings[RHW_MAX_VARYINGS];
    int varying_count;
    uint32_t uniform_size; ///< bytes that the functions read at `uniforms`, 0..RHW_MAX_UNIFORM_SIZE
    /// All functions receive this pointer as `user`. It serves closures and generated code that need more than
    /// uniforms. The library neither copies nor reads what it points to. That must live, unchanged, from
    /// rhw_pipeline_create to rhw_pipeline_destroy; the functions read it on any thread. The default is NULL.
    const void *user;

    // What the vertex function does
    /// The vertex function writes `point_size`, the side of the square that a point covers, in pixels. Sizes are
    /// clamped to 1..RHW_MAX_POINT_SIZE and rounded to 1/256 pixel. If it is false, the size is 1.
    bool writes_point_size;
    /// The vertex function writes `viewport_index`, or `layer`: the viewport and scissor that a primitive takes, and
    /// the layer of the attachments that it is drawn into. The provoking vertex decides
    /// (VK_EXT_shader_viewport_index_layer). A primitive is not drawn if its viewport is not in 0..RHW_MAX_VIEWPORTS −
    /// 1 or its layer is none of the pass. If it is false, the number is 0.
    bool writes_viewport_index, writes_layer;
    /// The number of distances that the vertex function writes, 0..8 of each. A primitive is cut off where a clip
    /// distance, interpolated over the primitive, is below 0. A primitive is not drawn if all its vertices have the
    /// same cull distance below 0 (Vulkan 1.3 §27.4). A point is drawn if none of its distances is below 0.
    int clip_distance_count, cull_distance_count;
    /// The vertex function writes to storage, or changes it by atomics. The library then calls it once for each vertex
    /// of each instance that a primitive names.
    bool vertex_effects;
    /// Either function uses what atomics on storage return, or exchanges words that others use, so that the order in
    /// which functions are called would show in what they write. A pass with a draw of this program then runs on the
    /// thread that ends it, in one order, and writes the same bytes in every context; it takes no notice of bin_memory.
    /// Leave it false if any order will do, for example in lists that are sorted when they are read.
    bool uses_atomic_results;

    // What the fragment function does
    uint32_t uses; ///< or-ed rhw_fragment_use
    /// If true, depth bounds, stencil and depth are tested and written before the fragment function, which is called
    /// for the fragments that pass. What the function discards, or writes as depth, does not change that (Vulkan 1.3
    /// §28.1.2, EarlyFragmentTests). If false, a function with RHW_USE_EFFECTS, RHW_USE_DEPTH_INPUT or
    /// RHW_USE_STENCIL_INPUT is called for every fragment, and the tests come after it.
    bool early_fragment_tests;
};

// Pipelines -----------------------------------------------------------------------------------------

/// The definition of a pipeline. Its members follow the way of a vertex through the pipeline.
struct rhw_pipeline_def {
    struct rhw_program program;

    // Vertex input
    struct rhw_attribute attributes[RHW_MAX_ATTRIBUTES];
    int attribute_count;
    struct rhw_vertex_layout buffers[RHW_MAX_VERTEX_BUFFERS];
    int buffer_count;

    // Primitive assembly
    enum rhw_topology topology;   ///< default TRIANGLE_LIST
    /// The largest index of the index type starts a new strip, fan or list. An unfinished primitive before it is not
    /// drawn.
    bool primitive_restart;
    enum rhw_provoking provoking; ///< default FIRST

    // Transform feedback (rhw_pass_begin_transform_feedback)
    struct rhw_feedback_output feedback_outputs[RHW_MAX_FEEDBACK_OUTPUTS];
    int feedback_output_count;
    /// Bytes from one vertex to the next in each target, a multiple of 4. 0 means up to the end of the last output.
    uint32_t feedback_strides[RHW_MAX_FEEDBACK_TARGETS];

    // Viewport and rasterization
    enum rhw_depth_range depth_range; ///< default ZERO_TO_ONE
    /// If true, triangles are not cut where they leave the view volume in front and behind (Vulkan, depthClipEnable
    /// false). Their depth is clamped to 0..1, or with depth_clamp to the viewport's range.
    bool depth_clip_disabled;
    bool depth_clamp;                   ///< clamp depth, bias included, to the viewport's range instead of to 0..1
    bool rasterizer_discard;            ///< end primitives before they are rasterized, so that nothing is drawn
    enum rhw_polygon_mode polygon_mode; ///< default FILL
    enum rhw_cull cull;                 ///< default NONE
    enum rhw_winding front;             ///< default COUNTER_CLOCKWISE
    enum rhw_conservative conservative; ///< default OFF
    enum rhw_line_mode line_mode;       ///< mode of lines, and of triangles drawn as lines; default RECTANGULAR
    float line_width; ///< pixels, 1..RHW_MAX_LINE_WIDTH; 0 means 1; see rhw_pass_set_line_width
    /// The stipple of lines, and of triangles drawn as lines; default none. See rhw_pass_set_line_stipple.
    struct rhw_line_stipple line_stipple;
    struct rhw_depth_bias depth_bias;   ///< default none; see rhw_pass_set_depth_bias

    // Multisampling
    /// The samples that may be covered, one bit for each sample (Vulkan 1.3 §27.1, §28.9). A pass with one sample has
    /// bit 0. 0 means all samples.
    uint32_t sample_mask;
    /// If true, the alpha of color[0] says how many samples of a fragment are kept: the first round(alpha · samples)
    /// samples of the pass. It does nothing if target 0 has an integer format (Vulkan 1.3 §28.9).
    bool alpha_to_coverage;
    /// If true, the alpha of target 0 becomes 1 after alpha_to_coverage. It does nothing if target 0 has an integer
    /// format.
    bool alpha_to_one;

    // Depth
    bool depth_test;                ///< false: depth is neither tested nor written and needs no attachment
    enum rhw_compare depth_compare; ///< default LESS
    bool depth_read_only;           ///< false: a fragment that passes the test writes its depth
    /// If true, a fragment passes if the attachment's depth lies within the bounds of rhw_pass_set_depth_bounds.
    bool depth_bounds_test;

    // Stencil
    bool stencil_test;              ///< if true, the pass must have a stencil attachment
    struct rhw_stencil_face stencil_front, stencil_back; ///< tests of front and back faces

    // Targets
    struct rhw_color_target targets[RHW_MAX_COLOR_ATTACHMENTS];
    int target_count;
    enum rhw_logic logic; ///< default OFF; with another operation no target is blended

    const char *label; ///< name in messages, or NULL
};

// Defaults ------------------------------------------------------------------------------------------

RHW_API struct rhw_context_def rhw_context_def_default(void);
RHW_API struct rhw_buffer_def rhw_buffer_def_default(void);

/// Return the definition of a texture in RGBA8_UNORM with one level. The caller sets its size.
RHW_API struct rhw_texture_def rhw_texture_def_default(void);
RHW_API struct rhw_sampler_def rhw_sampler_def_default(void);

/// Return the definition of a pipeline with one RGBA8_UNORM target and without a depth test. The caller sets the
/// program.
RHW_API struct rhw_pipeline_def rhw_pipeline_def_default(void);

#endif
