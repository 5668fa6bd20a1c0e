// SPDX-License-Identifier: MIT
// Ids, enums and definition structs. Zero is safe: a member of a `*_def` that is left zero has its default, or the call
// that takes the struct says what is missing. What zero would say elsewhere, a level 0 or no channel at all, is asked
// for by name. `*_def_default` gives the same values written out, with one colour target in pipelines. Of passes see
// pass_def.h.
#ifndef RHW_TYPES_H
#define RHW_TYPES_H

#include "base.h"

/// Everything belongs to one context. Different contexts may be used by different threads at once, one context by one
/// thread at a time: a call that meets another one, or comes from a shader function, is misuse and does nothing. A
/// shader function of one context may use another, as any code on that thread may: one call at a time.
typedef struct rhw_context rhw_context;

/// Value ids. A zeroed id is the null id; to destroy it does nothing. An id whose item was destroyed, or that another
/// context gave, is misuse. Equal ids, member by member, name the same item.
typedef struct rhw_buffer { uint32_t index, generation, context; } rhw_buffer;
typedef struct rhw_texture { uint32_t index, generation, context; } rhw_texture;
typedef struct rhw_sampler { uint32_t index, generation, context; } rhw_sampler;
typedef struct rhw_pipeline { uint32_t index, generation, context; } rhw_pipeline;
typedef struct rhw_pass { uint32_t index, generation, context; } rhw_pass;
typedef struct rhw_query { uint32_t index, generation, context; } rhw_query;

enum {
    RHW_MAX_TARGET_SIZE = 16384, ///< pixels, each way; beyond it integer edge functions could overflow
    RHW_MAX_THREADS = 64,
    RHW_MAX_COLOR_ATTACHMENTS = 8,
    RHW_MAX_VERTEX_BUFFERS = 16,
    RHW_MAX_ATTRIBUTES = 16,
    RHW_MAX_VARYINGS = 32,
    RHW_MAX_VARYING_COMPONENTS = 64,
    RHW_MAX_TEXTURES = 32,       ///< texture slots of a draw, for both functions
    RHW_MAX_SAMPLES = 16,        ///< of a pixel
    RHW_MAX_GROUPS = 16,         ///< groups of 8 lanes in one call of a shader function
    RHW_MAX_UNIFORM_SIZE = 1 << 20, ///< bytes
    RHW_MAX_CLIP_DISTANCES = 8,
    RHW_MAX_CULL_DISTANCES = 8,
    RHW_MAX_POINT_SIZE = 256,    ///< pixels; the least is 1
    RHW_MAX_LINE_WIDTH = 256,    ///< pixels; the least is 1
    RHW_MAX_LINE_STIPPLE_FACTOR = 256,
    RHW_MAX_STORAGE_BUFFERS = 16, ///< storage slots of a draw
    RHW_MAX_STORAGE_IMAGES = 16,  ///< image slots, of storage images and texel buffers
    RHW_MAX_TEXEL_BUFFER = 1 << 27, ///< texels of one
    RHW_MAX_FEEDBACK_TARGETS = 4, ///< of transform feedback
    RHW_MAX_FEEDBACK_OUTPUTS = 64,
    RHW_MAX_VIEWPORTS = 16       ///< of a pass, and scissors
};

/// Instruction sets the kernels are compiled for, slowest first. BASELINE is the specification: SSE2 on
/// x86-64, NEON on 64-bit ARM, what the compiler was given elsewhere. All draw the same bytes.
enum rhw_isa { RHW_ISA_BASELINE, RHW_ISA_AVX2, RHW_ISA_AVX512, RHW_ISA_COUNT };

/// The highest instruction set that a context may use; of those up to it, it takes the highest that the CPU has. BEST is
/// the one that measured fastest: AVX2 at most, as AVX-512 gains nothing to speak of yet (docs/performance.md).
/// rhw_isa_up_to gives the limit of an rhw_isa.
enum rhw_isa_limit { RHW_ISA_BEST, RHW_ISA_UP_TO_BASELINE, RHW_ISA_UP_TO_AVX2, RHW_ISA_UP_TO_AVX512 };

/// Which paths through the kernels a context takes. Special paths draw the bytes of the general path in less time; a
/// program that only wants its picture leaves them all on.
enum rhw_paths {
    RHW_PATHS_ALL,
    RHW_PATHS_IN_ORDER, ///< as ALL, but hidden opaque fragments are shaded in their turn too: for measuring
    RHW_PATHS_GENERAL   ///< the general path always: to learn how the kernels work, and to find which path is at fault
};

/// Validation finds what is no misuse to the library and rarely meant: shader functions that read what their program
/// does not declare, discard or write depth without saying so, leave colours, positions or varyings unwritten, or
/// sample slots that do not exist or have no texture, or levels above 0 that nobody has written, or with a reference
/// where the sampler does not compare, or without one where it does, or work on the first of their groups alone; draws
/// that reach outside their buffers; odd index offsets; NaN to clear with. It is told as misuse: what a shader function
/// did when the pass ends, for its earliest draw, with the draw and a pixel. NaN in colours, writing targets that a
/// pipeline lacks, blend factors without blend, depth_read_only without depth_test and a depth texture that is not
/// enabled are warnings in the log. Pictures are the same, and take several times as long.
enum rhw_validation {
    RHW_VALIDATE_DEFAULT, ///< on where the context is created by a file compiled without optimization and NDEBUG
    RHW_VALIDATE_ON,
    RHW_VALIDATE_OFF
};

struct rhw_context_def {
    /// 1..64: the caller's thread and workers; 1 the caller's alone. 0: as many as whole cores' time the process may
    /// use, by affinity and the limits of control groups (1 where it may use one core and a half).
    int threads;
    enum rhw_isa_limit isa_limit; ///< RHW_ISA_BEST
    enum rhw_paths paths; ///< RHW_PATHS_ALL
    enum rhw_validation validate; ///< RHW_VALIDATE_DEFAULT
    size_t bin_memory; ///< bytes of binned geometry kept before a pass is flushed to its tiles; 0: 512 MiB
    struct rhw_allocator allocator; ///< zeroed: malloc, and the system's pages for large blocks
    rhw_log_function *log;          ///< NULL: silent, but warnings of a context that validates go to stderr
    rhw_assert_function *assert_;   ///< NULL: print and abort
    void *user;                     ///< first argument of log and assert_
    const char *label;              ///< as in every definition: a name for messages, or NULL. Its first 63 bytes are
                                    ///< copied
};

/// Texel formats. Channels stand in memory in the order of the name, little endian: Vulkan's formats of the same name,
/// and its A8B8G8R8 of 32 bits is RGBA8 here. UNORM is a part of 0..1, SNORM of −1..1 (the least code is −1, as the
/// one above it); floats are rounded to them to nearest, ties to even. UINT and SINT hand the integer's bits over in the
/// lanes, unconverted (rhw_bits), take its low bits, have no blending and are sampled with nearest filters.
enum rhw_format {
    RHW_FORMAT_NONE,
    RHW_FORMAT_R8_UNORM, RHW_FORMAT_RG8_UNORM, RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_BGRA8_UNORM, RHW_FORMAT_ABGR8_UNORM,
    // Colour channels stored with the sRGB transfer function, alpha linear.
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
    // Packed in a word of 16 or 32 bits, the first channel in the lowest bits: Vulkan's A2B10G10R10 and B10G11R11.
    RHW_FORMAT_RGB10A2_UNORM, RHW_FORMAT_RGB10A2_UINT,
    RHW_FORMAT_RG11B10_FLOAT, ///< no sign: what is below 0 becomes 0, finite values stay finite
    RHW_FORMAT_RGB9E5_FLOAT,  ///< one exponent for all, no sign; sampled only (Vulkan's E5B9G9R9)
    // Packed with the first channel in the highest bits, as in Vulkan and OpenGL.
    RHW_FORMAT_RGB565_UNORM, RHW_FORMAT_RGBA4_UNORM, RHW_FORMAT_BGRA4_UNORM,
    RHW_FORMAT_RGB5A1_UNORM, RHW_FORMAT_A1RGB5_UNORM,
    RHW_FORMAT_D32_FLOAT, ///< depth; the others of depth and stencil stand together below
    RHW_FORMAT_D16_UNORM,
    RHW_FORMAT_D24_UNORM,         ///< in the low 24 bits of 32; the others are 0
    RHW_FORMAT_D24_UNORM_S8_UINT, ///< depth as D24_UNORM, and beside it a plane of stencil, a byte each
    RHW_FORMAT_D32_FLOAT_S8_UINT, ///< depth as D32_FLOAT, and beside it a plane of stencil
    RHW_FORMAT_S8_UINT,           ///< stencil alone; sampled by a view of R8_UINT
    // Compressed formats, which stand last: textures that are sampled, never drawn into. rhw_texture_write takes blocks
    // and decodes them, so that their texels take the memory of rhw_format_decoded from then on.
    RHW_FORMAT_BC1_RGB_UNORM, RHW_FORMAT_BC1_RGB_SRGB, RHW_FORMAT_BC1_RGBA_UNORM, RHW_FORMAT_BC1_RGBA_SRGB,
    RHW_FORMAT_BC2_UNORM, RHW_FORMAT_BC2_SRGB, RHW_FORMAT_BC3_UNORM, RHW_FORMAT_BC3_SRGB,
    RHW_FORMAT_BC4_UNORM, RHW_FORMAT_BC4_SNORM, RHW_FORMAT_BC5_UNORM, RHW_FORMAT_BC5_SNORM,
    RHW_FORMAT_BC6H_UFLOAT, RHW_FORMAT_BC6H_SFLOAT, RHW_FORMAT_BC7_UNORM, RHW_FORMAT_BC7_SRGB,
    RHW_FORMAT_ETC2_RGB8_UNORM, RHW_FORMAT_ETC2_RGB8_SRGB, RHW_FORMAT_ETC2_RGB8A1_UNORM, RHW_FORMAT_ETC2_RGB8A1_SRGB,
    RHW_FORMAT_ETC2_RGBA8_UNORM, RHW_FORMAT_ETC2_RGBA8_SRGB,
    RHW_FORMAT_EAC_R11_UNORM, RHW_FORMAT_EAC_R11_SNORM, RHW_FORMAT_EAC_RG11_UNORM, RHW_FORMAT_EAC_RG11_SNORM,
    // ASTC of low dynamic range; what no such block can be is opaque magenta.
    RHW_FORMAT_ASTC_4X4_UNORM, RHW_FORMAT_ASTC_4X4_SRGB, RHW_FORMAT_ASTC_5X4_UNORM, RHW_FORMAT_ASTC_5X4_SRGB,
    RHW_FORMAT_ASTC_5X5_UNORM, RHW_FORMAT_ASTC_5X5_SRGB, RHW_FORMAT_ASTC_6X5_UNORM, RHW_FORMAT_ASTC_6X5_SRGB,
    RHW_FORMAT_ASTC_6X6_UNORM, RHW_FORMAT_ASTC_6X6_SRGB, RHW_FORMAT_ASTC_8X5_UNORM, RHW_FORMAT_ASTC_8X5_SRGB,
    RHW_FORMAT_ASTC_8X6_UNORM, RHW_FORMAT_ASTC_8X6_SRGB, RHW_FORMAT_ASTC_8X8_UNORM, RHW_FORMAT_ASTC_8X8_SRGB,
    RHW_FORMAT_ASTC_10X5_UNORM, RHW_FORMAT_ASTC_10X5_SRGB, RHW_FORMAT_ASTC_10X6_UNORM, RHW_FORMAT_ASTC_10X6_SRGB,
    RHW_FORMAT_ASTC_10X8_UNORM, RHW_FORMAT_ASTC_10X8_SRGB, RHW_FORMAT_ASTC_10X10_UNORM, RHW_FORMAT_ASTC_10X10_SRGB,
    RHW_FORMAT_ASTC_12X10_UNORM, RHW_FORMAT_ASTC_12X10_SRGB, RHW_FORMAT_ASTC_12X12_UNORM, RHW_FORMAT_ASTC_12X12_SRGB,
    RHW_FORMAT_COUNT
};

/// What textures of a format can be, or-ed.
enum rhw_format_feature {
    RHW_FEATURE_SAMPLED = 1,          ///< a texture that shaders fetch and sample
    RHW_FEATURE_FILTERED = 2,         ///< sampled with linear filters too, and rhw_texture_generate_mips works
    RHW_FEATURE_COLOR_ATTACHMENT = 4, ///< drawn into
    RHW_FEATURE_BLENDED = 8,          ///< blended into
    RHW_FEATURE_DEPTH_ATTACHMENT = 16, RHW_FEATURE_STENCIL_ATTACHMENT = 32,
    RHW_FEATURE_STORAGE_IMAGE = 64,   ///< see rhw_pass_set_storage_image
    RHW_FEATURE_STORAGE_ATOMIC = 128, ///< with atomics
    RHW_FEATURE_TEXEL_BUFFER = 256    ///< see rhw_pass_set_texel_buffer
};

/// Gives or-ed rhw_format_feature; 0 for what is no format.
RHW_API uint32_t rhw_format_features(enum rhw_format format);

/// Bytes per texel; of depth where there is a plane of stencil too; 0 for compressed formats.
RHW_API size_t rhw_format_size(enum rhw_format format);
/// Texels of a block, each way, and its bytes. The blocks of a format that is not compressed are its texels.
RHW_API int rhw_format_block_width(enum rhw_format format);
RHW_API int rhw_format_block_height(enum rhw_format format);
RHW_API size_t rhw_format_block_bytes(enum rhw_format format);
/// What texels of a compressed format are decoded to, and rhw_texture_read gives: RGBA8_UNORM or RGBA8_SRGB; floats for
/// BC4, BC5 and EAC, halves for BC6H. Other formats are their own.
RHW_API enum rhw_format rhw_format_decoded(enum rhw_format format);

enum {
    RHW_MEMORY_ALIGNMENT = 64, ///< bytes, of memory that buffers and textures stand on, and of rows of texels
    RHW_MEMORY_PADDING = 64    ///< bytes behind a buffer or texture, which kernels may load as parts of vectors
};

struct rhw_buffer_def {
    size_t size;      ///< bytes, at least 1
    const void *data; ///< bytes that are copied; NULL: zeros, or what `memory` holds
    /// Memory of the program that the bytes stand on, aligned to RHW_MEMORY_ALIGNMENT; or NULL for memory of the
    /// library. The program owns the memory, keeps it as long as the buffer, and may read and write it while no pass is
    /// recorded.
    void *memory;
    /// Bytes of `memory`, at least size + RHW_MEMORY_PADDING. The library zeroes and owns what lies behind the buffer's
    /// bytes.
    size_t memory_size;
    const char *label; ///< name in messages, or NULL
};

enum { RHW_MIP_LEVELS_ALL = -1 };

enum {
    RHW_MAX_TEXTURE_DEPTH = 2048, ///< slices of a 3D texture
    RHW_MAX_TEXTURE_LAYERS = 2048 ///< of an array; six for each of its cubes
};

/// CUBE: six square layers for the faces +x, −x, +y, −y, +z, −z, laid out as Vulkan 1.3 has them
/// ("Cube Map Face Selection").
enum rhw_texture_kind { RHW_TEXTURE_2D, RHW_TEXTURE_1D, RHW_TEXTURE_3D, RHW_TEXTURE_CUBE };

/// A texture: sampled, drawn into, or both, in one pass of different levels and layers (view.h). Zeroed when created.
/// It takes the bytes of its texels (of a compressed format: as they are decoded), rows rounded up to 64; a 2D texture
/// of RGBA8_SRGB texels that a pass samples takes 8 bytes a texel more from then on. A texture that is no plain 2D one
/// has fewer than 2^31 texels, all levels and rounded rows together.
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
    /// Bytes between rows, a multiple of RHW_MEMORY_ALIGNMENT, of a texture with one level. 0 means the bytes of a row,
    /// rounded up to RHW_MEMORY_ALIGNMENT.
    size_t row_pitch;
    const char *label;  ///< name in messages, or NULL
};

enum rhw_filter { RHW_FILTER_LINEAR, RHW_FILTER_NEAREST };
enum rhw_mip_filter { RHW_MIP_FILTER_LINEAR, RHW_MIP_FILTER_NEAREST, RHW_MIP_FILTER_NONE };
/// MIRROR_ONCE: the texture and its mirror image beside 0, then the edge (VK_SAMPLER_ADDRESS_MODE_MIRROR_CLAMP_TO_EDGE).
enum rhw_address {
    RHW_ADDRESS_REPEAT, RHW_ADDRESS_MIRROR, RHW_ADDRESS_CLAMP, RHW_ADDRESS_BORDER, RHW_ADDRESS_MIRROR_ONCE
};

enum rhw_compare {
    RHW_COMPARE_LESS, RHW_COMPARE_NEVER, RHW_COMPARE_EQUAL, RHW_COMPARE_LESS_EQUAL,
    RHW_COMPARE_GREATER, RHW_COMPARE_NOT_EQUAL, RHW_COMPARE_GREATER_EQUAL, RHW_COMPARE_ALWAYS
};

/// What a filter makes of the texels that have a weight above 0: their weighted average, or channel by channel the least or
/// the greatest (Vulkan 1.3, VkSamplerReductionMode).
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

/// How attributes stand in buffers. FLOAT, HALF, UNORM and SNORM are what texel formats of these names are; USCALED and
/// SSCALED the integer's value as a float. UINT and SINT arrive as the integer's bits in the lanes (rhw_bits_from_float),
/// as with texels; so do the two words of every FLOAT64, the low one first: three or four of them are two attributes.
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
    /// A word: x in the lowest 10 bits, w in the highest 2 (Vulkan's A2B10G10R10).
    RHW_VERTEX_UNORM10_10_10_2, RHW_VERTEX_SNORM10_10_10_2, RHW_VERTEX_USCALED10_10_10_2,
    RHW_VERTEX_SSCALED10_10_10_2, RHW_VERTEX_UINT10_10_10_2, RHW_VERTEX_SINT10_10_10_2,
    RHW_VERTEX_UNORM8X4_BGRA, ///< bytes z, y, x, w
    RHW_VERTEX_FORMAT_COUNT
};

/// Bytes one value takes.
RHW_API size_t rhw_vertex_format_size(enum rhw_vertex_format format);

/// Attribute i of `rhw_pipeline_def.attributes` arrives in the vertex function as `attribute[i]`;
/// components the format lacks are 0, 0, 0, 1, of UINT and SINT the integer 1. FLOAT formats arrive bit for bit, so that
/// they may carry integers.
struct rhw_attribute {
    enum rhw_vertex_format format;
    int buffer;      ///< index into rhw_pipeline_def.buffers
    uint32_t offset; ///< bytes from the start of the element; no alignment is asked
};

struct rhw_vertex_layout {
    uint32_t stride;   ///< bytes; 0: up to the end of the last of its attributes, as tightly packed elements have it
    bool per_instance; ///< step with the instances of a draw instead of its vertices
    /// With per_instance: instances that read the same element, counted from first_instance of the draw; 0: 1
    /// (Vulkan, VK_EXT_vertex_attribute_divisor: element firstInstance + ⌊(instance − firstInstance) / step⌋). For one
    /// element for all, see `constant`.
    uint32_t instance_step;
    bool constant;     ///< every vertex of every instance reads the first element; no stride then
};

/// FLAT takes the value of the provoking vertex bit for bit: an integer id travels as rhw_float_from_bits(id), and the
/// fragment function has it back by rhw_bits_from_float, or writes it to an R32_UINT target as it is.
enum rhw_qualifier { RHW_SMOOTH, RHW_NOPERSPECTIVE, RHW_FLAT };

/// Where in its pixel a fragment of a multisampled pass takes its values (Vulkan 1.3 §28.3): at the centre, also where the
/// triangle leaves that out; at the first sample that the triangle covers, unless it covers all; or at every sample, for
/// each of which the fragment function is then called. What one varying asks for holds for all of a program.
enum rhw_sampling { RHW_SAMPLING_CENTER, RHW_SAMPLING_CENTROID, RHW_SAMPLING_SAMPLE };

/// One value that flows from the vertex to the fragment function. Components of all varyings stand one
/// after the other in `varying[]` on both sides.
struct rhw_varying {
    int components; ///< 1..4
    enum rhw_qualifier qualifier;
    bool derivatives; ///< ask for d/dx and d/dy per pixel of these components
    /// Set by RHW_VARYING (shader_varying.h) where a struct describes the varyings, and checked by rhw_pipeline_create;
    /// all zero without one.
    const char *name;           ///< of the struct's member
    uint16_t offset;            ///< of that member, in components
    uint16_t struct_components; ///< of the whole struct
    enum rhw_sampling sampling; ///< CENTER
};

enum rhw_topology {
    RHW_TRIANGLE_LIST,
    RHW_TRIANGLE_STRIP, ///< the order of odd triangles keeps the winding and the provoking vertex: FIRST i, i+2,
                        ///< i+1; LAST i+1, i, i+2
    RHW_TRIANGLE_FAN,   ///< provoking FIRST: vertices i+1, i+2, 0; LAST: 0, i+1, i+2
    RHW_POINT_LIST,     ///< squares, see rhw_program.writes_point_size
    RHW_LINE_LIST,      ///< see rhw_pipeline_def.line_width
    RHW_LINE_STRIP,
    // With vertices beside those that are drawn, which nothing looks at (Vulkan 1.3 §21.1.7 .. §21.1.10):
    RHW_LINE_LIST_ADJACENCY,     ///< line i has vertices 4i+1, 4i+2
    RHW_LINE_STRIP_ADJACENCY,    ///< i+1, i+2
    RHW_TRIANGLE_LIST_ADJACENCY, ///< 6i, 6i+2, 6i+4
    RHW_TRIANGLE_STRIP_ADJACENCY, ///< the strip of the even vertices
    RHW_LINE_LOOP ///< a strip and the line from its last vertex to its first (OpenGL ES 3.2 §10.1.3)
};
/// What is drawn of a triangle that is not culled: all of it, its edges as lines, or its corners as points (Vulkan 1.3
/// §28.10.2). Facing and flat values are those of the triangle.
enum rhw_polygon_mode { RHW_POLYGON_FILL, RHW_POLYGON_LINE, RHW_POLYGON_POINT };
enum rhw_index_type { RHW_INDEX_UINT8, RHW_INDEX_UINT16, RHW_INDEX_UINT32 };
/// Which pixels a filled triangle covers, all their samples (VK_EXT_conservative_rasterization): by samples; those whose
/// square it touches, or lies next to; those whose square it contains. Exact for the snapped triangle; one without area
/// covers none. Values are taken at the centre as ever, which may lie outside of the triangle. Points and lines are drawn as
/// without it.
enum rhw_conservative { RHW_CONSERVATIVE_OFF, RHW_CONSERVATIVE_OVERESTIMATE, RHW_CONSERVATIVE_UNDERESTIMATE };
/// RECTANGULAR: what lies within half the width of a line, between its ends. BRESENHAM: by the diamond-exit rule one pixel
/// of each column, or row, that it passes, or as many as the width rounded; all samples of a pixel (Vulkan 1.3 §28.10.1).
/// RECTANGULAR_SMOOTH: every pixel that the rectangle touches, all its samples; the alpha of colour 0 is multiplied by the
/// area of the pixel that it covers, after the fragment function, but for integers (Vulkan 1.3 §28.10, smooth lines;
/// VK_EXT_line_rasterization). That of other colours stays, also where target 0 is left out. The area is right to
/// 2^−16; what covers less than that is not drawn. Where two lines meet each blends what it covers. A stipple draws the
/// pixels whose centre lies in a piece that it draws.
enum rhw_line_mode { RHW_LINE_RECTANGULAR, RHW_LINE_BRESENHAM, RHW_LINE_RECTANGULAR_SMOOTH };
/// Which parts of a line are drawn (Vulkan 1.3 §28.10, Line Stipple; VK_EXT_line_rasterization): those where bit
/// ⌊s / factor⌋ mod 16 of the pattern is 1, the lowest being bit 0. Of a Bresenham line s counts its columns, or rows, of
/// pixels from the beginning; of a rectangular one it is the distance of a sample from the beginning along the line, in
/// pixels, rounded to 1/256. Every line of a list and every edge of a triangle begins with s = 0, a line of a strip where the
/// one before it ended: with all its columns, or with its length rounded to 1/256 pixel, seen or not. What a plane leaves
/// of a line that it cuts has the s of that line's beginning where its own is; a line with an end that cannot be snapped
/// (W <= 0, or beyond the guard band) adds nothing to s. In a strip that names several viewports the first measures.
struct rhw_line_stipple {
    int factor; ///< 1..256; 0: no stipple
    uint16_t pattern;
};
/// Of triangles; points and lines have no side. BOTH leaves nothing to rasterize of them.
enum rhw_cull { RHW_CULL_NONE, RHW_CULL_FRONT, RHW_CULL_BACK, RHW_CULL_BOTH };
enum rhw_winding { RHW_COUNTER_CLOCKWISE, RHW_CLOCKWISE }; ///< as seen on the screen, y up
enum rhw_blend_factor {
    RHW_BLEND_DEFAULT, ///< ONE as src, ZERO as dst: the source replaces
    RHW_BLEND_ZERO, RHW_BLEND_ONE,
    RHW_BLEND_SRC, RHW_BLEND_ONE_MINUS_SRC, RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA,
    RHW_BLEND_DST, RHW_BLEND_ONE_MINUS_DST, RHW_BLEND_DST_ALPHA, RHW_BLEND_ONE_MINUS_DST_ALPHA,
    RHW_BLEND_SRC_ALPHA_SATURATED, RHW_BLEND_CONSTANT, RHW_BLEND_ONE_MINUS_CONSTANT,
    RHW_BLEND_CONSTANT_ALPHA, RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA,
    /// Dual-source blending: the second source is color[1] of the fragment function; the pipeline has one target then
    /// (Vulkan 1.3 §29.1.2, maxFragmentDualSrcAttachments 1).
    RHW_BLEND_SRC1, RHW_BLEND_ONE_MINUS_SRC1, RHW_BLEND_SRC1_ALPHA, RHW_BLEND_ONE_MINUS_SRC1_ALPHA
};
enum rhw_blend_operation {
    RHW_BLEND_ADD, RHW_BLEND_SUBTRACT, RHW_BLEND_REVERSE_SUBTRACT, RHW_BLEND_MIN, RHW_BLEND_MAX
};

struct rhw_blend_component {
    enum rhw_blend_factor src, dst;
    enum rhw_blend_operation operation;
};

enum rhw_write_mask {
    RHW_WRITE_RED = 1,
    RHW_WRITE_GREEN = 2,
    RHW_WRITE_BLUE = 4,
    RHW_WRITE_ALPHA = 8,
    RHW_WRITE_NONE = 16 ///< stands alone
};

/// What happens to the bits of source and destination instead of blending, in targets of integers, UNORM and SNORM; those
/// of floats and sRGB take the source as it is (Vulkan 1.3 §29.2). The write mask holds.
enum rhw_logic {
    RHW_LOGIC_OFF,
    RHW_LOGIC_CLEAR, RHW_LOGIC_AND, RHW_LOGIC_AND_REVERSE, RHW_LOGIC_COPY, RHW_LOGIC_AND_INVERTED, RHW_LOGIC_NO_OP,
    RHW_LOGIC_XOR, RHW_LOGIC_OR, RHW_LOGIC_NOR, RHW_LOGIC_EQUIVALENT, RHW_LOGIC_INVERT, RHW_LOGIC_OR_REVERSE,
    RHW_LOGIC_COPY_INVERTED, RHW_LOGIC_OR_INVERTED, RHW_LOGIC_NAND, RHW_LOGIC_SET
};

/// UNORM and sRGB targets clamp the source to 0..1 before blending, SNORM to −1..1; sRGB targets blend in linear
/// light (the destination is decoded, the result encoded).
struct rhw_color_target {
    enum rhw_format format; ///< the attachment's; NONE where the pass leaves that out: the output goes nowhere
    bool blend;                              ///< false: the source replaces
    /// src × srcFactor op dst × dstFactor. Each has its own defaults: with `color` alone set, alpha replaces.
    struct rhw_blend_component color, alpha;
    uint8_t write_mask;                      ///< or-ed rhw_write_mask; 0: all channels
};

/// What a stencil test does to the stencil value (Vulkan 1.3 §27.13).
enum rhw_stencil_operation {
    RHW_STENCIL_KEEP, RHW_STENCIL_ZERO, RHW_STENCIL_REPLACE, ///< by the reference
    RHW_STENCIL_INCREMENT_CLAMP, RHW_STENCIL_DECREMENT_CLAMP, RHW_STENCIL_INVERT,
    RHW_STENCIL_INCREMENT_WRAP, RHW_STENCIL_DECREMENT_WRAP
};

enum { RHW_STENCIL_NO_BITS = 256 }; ///< a mask of nothing

/// The stencil test for the triangles that face one way. A fragment passes where `(reference & read_mask) compare
/// (stencil & read_mask)`; the result of the operation is written where write_mask has bits.
struct rhw_stencil_face {
    bool compares;            ///< false: every fragment passes
    enum rhw_compare compare; ///< LESS, where it compares
    enum rhw_stencil_operation fail;       ///< where the stencil test fails. KEEP
    enum rhw_stencil_operation depth_fail; ///< where that passes and the depth test fails. KEEP
    enum rhw_stencil_operation pass;       ///< where both pass, or depth is not tested. KEEP
    uint16_t read_mask, write_mask;        ///< 1..255; 0: all bits; RHW_STENCIL_NO_BITS alone: none
};

/// Bits of the stencil that tests look at and operations change, by facing; 0: none.
struct rhw_stencil_masks {
    uint8_t read_front, read_back, write_front, write_back;
};

/// What is added to the depth of a triangle's fragments, to hold shadows and decals off their surfaces (Vulkan 1.3
/// §26.11.4): slope · m + constant · r, where m is the greater of |∂z/∂x| and |∂z/∂y| per pixel, and r the step of the
/// format: 2^-16 and 2^-24 for D16 and D24, 2^(e − 23) for D32_FLOAT, e being the exponent of the triangle's largest
/// depth. All zero: nothing.
struct rhw_depth_bias {
    float constant, slope; ///< finite
    float clamp;           ///< above 0: the sum is at most this; below: at least; 0: no limit
};

enum rhw_depth_range { RHW_DEPTH_ZERO_TO_ONE, RHW_DEPTH_MINUS_ONE_TO_ONE };
enum rhw_provoking { RHW_PROVOKING_FIRST, RHW_PROVOKING_LAST };

/// Builtins a fragment function reads or writes beyond its varyings; only those asked for are filled.
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
/// writes must follow from what it reads there, its uniforms, its textures and `user` alone: it is called on any
/// thread, in any order, more than once for a vertex that several triangles share, for vertices of the buffers that no
/// triangle names, not at all for a fragment that an opaque one hides, and once for a whole draw when it receives
/// nothing that differs. One that is declared to have effects (shader_storage.h) is called as often as docs/shaders.md
/// promises.
typedef void rhw_vertex_function(struct rhw_vertex *groups, int count);
typedef void rhw_fragment_function(struct rhw_fragment *groups, int count);
/// The one-at-a-time form: same pipeline, plain floats, slower.
typedef void rhw_vertex1_function(struct rhw_vertex1 *vertex);
typedef void rhw_fragment1_function(struct rhw_fragment1 *fragment);

/// A vertex function, a fragment function and what flows between them. Index 0 (baseline) is enough; the
/// same source compiled for other instruction sets may stand beside it, and the context takes the best
/// entry at or below its own. The fragment function may be NULL, for depth only: every target then has the write mask
/// RHW_WRITE_NONE.
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

    // What the fragment function does
    uint32_t uses; ///< or-ed rhw_fragment_use
    /// If true, depth bounds, stencil and depth are tested and written before the fragment function, which is called
    /// for the fragments that pass. What the function discards, or writes as depth, does not change that (Vulkan 1.3
    /// §28.1.2, EarlyFragmentTests). If false, a function with RHW_USE_EFFECTS, RHW_USE_DEPTH_INPUT or
    /// RHW_USE_STENCIL_INPUT is called for every fragment, and the tests come after it.
    bool early_fragment_tests;
};

/// What transform feedback can keep of a vertex.
enum rhw_feedback_source {
    RHW_FEEDBACK_POSITION, ///< clip coordinates
    RHW_FEEDBACK_VARYING, RHW_FEEDBACK_POINT_SIZE, RHW_FEEDBACK_CLIP_DISTANCES, RHW_FEEDBACK_CULL_DISTANCES
};

/// Floats of a vertex that go to a target (VK_EXT_transform_feedback: the decorations XfbBuffer, XfbStride and Offset).
struct rhw_feedback_output {
    enum rhw_feedback_source source; ///< POSITION
    int index;                       ///< of a varying
    int first_component, component_count; ///< 0, 0: all there are
    int target;                      ///< 0..RHW_MAX_FEEDBACK_TARGETS − 1
    uint32_t offset;                 ///< bytes from the start of a vertex; a multiple of 4
};

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
    enum rhw_logic logic; ///< default OFF; with another operation no target may blend

    const char *label; ///< name in messages, or NULL
};

RHW_API struct rhw_context_def rhw_context_def_default(void);
RHW_API struct rhw_buffer_def rhw_buffer_def_default(void);
RHW_API struct rhw_texture_def rhw_texture_def_default(void); ///< RGBA8_UNORM, 1 level
RHW_API struct rhw_sampler_def rhw_sampler_def_default(void);
RHW_API struct rhw_pipeline_def rhw_pipeline_def_default(void); ///< one RGBA8_UNORM target, depth test off

#endif
