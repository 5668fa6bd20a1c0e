// SPDX-License-Identifier: MIT
// Shaders that are translated when the program runs: SPIR-V 1.0 to 1.3, as glslang, Tint, Naga and DXC write it for
// Vulkan. The library rhw-shader has them. It needs librhw and libc alone, and no compiler.
//
// A shader is an entry point of a module with its specialization. A linked program is a vertex and a fragment shader
// that fit together, or a compute shader. It fills the struct that a pipeline or a dispatch takes. Neither needs a
// context: any thread may make and destroy them, and any number of pipelines and contexts may share them. The bytes
// that they draw are the same on every machine.
//
// A module that breaks a rule of SPIR-V which the translation relies on, or that asks for what is not supported, is
// refused with a message that names the instruction and its word. Accesses outside of buffers and images are harmless:
// reads give 0, and writes do nothing. Loops ask the program whether it gives the work up (rhw_context_set_goes_on). If
// it has set nothing there, a draw or a dispatch with a loop that never ends does not return.
#ifndef RHW_SPIRV_H
#define RHW_SPIRV_H

#include "bind.h"
#include "dispatch.h"

enum {
    RHW_SHADER_MAX_SETS = 8,        ///< descriptor sets, whose numbers begin at 0
    RHW_SHADER_MAX_RESOURCES = 256, ///< buffers, images and samplers that one shader names; an array is one
    RHW_SHADER_MAX_WORDS = 1 << 22, ///< words of a module
    RHW_SHADER_MAX_IDS = 1 << 20,   ///< ids of a module, its bound
    RHW_SHADER_MAX_VALUES =
        1 << 18, ///< operations on scalars of a shader, after its calls are put in their places
    RHW_SHADER_MAX_NESTING = 128,      ///< selections, loops and calls inside each other
    RHW_SHADER_MAX_MEMORY = 256 << 20, ///< bytes that a translation may take
    RHW_SHADER_DRAW_OFFSET = 256,      ///< bytes of push constants up to the numbers of the draw
    RHW_SHADER_MESSAGE = 256           ///< bytes of a message, with the 0 at its end
};

// Cache ----------------------------------------------------------------------------------------------

/// What was translated and linked, for whoever asks for the same again. A program that makes pipelines over and over
/// has one and names it in its definitions. Any number of threads may use one at the same time.
typedef struct rhw_shader_cache rhw_shader_cache;

/// Create a cache that keeps at most `bound` bytes. Where more come, what was asked for least recently goes. A shader
/// counts with its memory and its words, and again with every program that was linked of it. Return
/// RHW_ERROR_OUT_OF_MEMORY, with *cache NULL, on failure.
RHW_API enum rhw_result rhw_shader_cache_create(size_t bound, rhw_shader_cache **cache);
/// Destroy a cache, which may be NULL, when no thread uses it any more. What was made with it goes on.
RHW_API void rhw_shader_cache_destroy(rhw_shader_cache *cache);
/// Take everything out of a cache. What somebody still has goes on.
RHW_API void rhw_shader_cache_clear(rhw_shader_cache *cache);
/// Return the bytes that a cache keeps.
RHW_API size_t rhw_shader_cache_get_size(rhw_shader_cache *cache);

// Shaders --------------------------------------------------------------------------------------------

enum rhw_shader_stage { RHW_SHADER_VERTEX, RHW_SHADER_FRAGMENT, RHW_SHADER_COMPUTE, RHW_SHADER_STAGE_COUNT };

/// A value for a constant that the module lets its user choose (Vulkan 1.3 §10.8, "Specialization Constants").
struct rhw_shader_constant {
    uint32_t id;    ///< SpecId; an id that the module does not have is allowed
    uint32_t value; ///< bits of the number; of a truth, 0 or any other number
};

struct rhw_shader_def {
    enum rhw_shader_stage stage;
    const char *entry_point; ///< NULL means "main"
    const struct rhw_shader_constant *constants;
    uint32_t constant_count;
    /// A cache gives the shader again that it has of equal words, stage, entry point and constants. NULL: a new one.
    rhw_shader_cache *cache;
    uint32_t view_index; ///< value of ViewIndex, for a shader that draws one view of several (rhw_shader_info)
};

/// A translated shader.
typedef struct rhw_shader rhw_shader;

/// Translate an entry point of a module of `size` bytes. The words may be in either order of bytes, and are copied.
/// Return RHW_ERROR_MISUSE for a module or a definition that is refused, or RHW_ERROR_OUT_OF_MEMORY. On failure
/// *shader is NULL, and `message`, which has RHW_SHADER_MESSAGE bytes or is NULL, gets one line.
RHW_API enum rhw_result rhw_shader_create(const void *words, size_t size, const struct rhw_shader_def *def,
                                          rhw_shader **shader, char *message);
/// Destroy a shader, which may be NULL, as often as it was created. Programs that were linked of it go on.
RHW_API void rhw_shader_destroy(rhw_shader *shader);

/// What rhw_shader_print shows of a translation.
enum rhw_shader_stop {
    RHW_SHADER_BUILT,    ///< the form as it is built: structured operations on scalars
    RHW_SHADER_PASSED,   ///< the form behind its passes, as back ends take it
    RHW_SHADER_ASSEMBLED ///< instructions of the interpreter, with their registers
};

/// Translate a shader as rhw_shader_create does up to where `stop` says, and give it to `write` as a text for people,
/// piece by piece. Lines of the source stand in it, if the module was compiled with them. The text has no format that
/// programs could rely on. Nothing is written of what is refused; results and `message` are those of rhw_shader_create.
RHW_API enum rhw_result rhw_shader_print(const void *words, size_t size, const struct rhw_shader_def *def,
                                         enum rhw_shader_stop stop,
                                         void (*write)(void *user, const char *text, size_t size), void *user,
                                         char *message);

// Reflection -----------------------------------------------------------------------------------------

/// What a binding of a set is to a shader (Vulkan 1.3 §14.1, "Descriptor Types").
enum rhw_shader_resource_kind {
    RHW_SHADER_UNIFORM_BUFFER,  ///< binding: rhw_binding_of_buffer, rhw_binding_of_memory
    RHW_SHADER_STORAGE_BUFFER,  ///< binding: rhw_binding_of_buffer, rhw_binding_of_memory
    RHW_SHADER_SAMPLED_TEXTURE, ///< combined image sampler: rhw_binding_of_texture with a sampler
    RHW_SHADER_TEXTURE,         ///< sampled image: rhw_binding_of_texture
    RHW_SHADER_SAMPLER,         ///< rhw_binding_of_sampler
    RHW_SHADER_STORAGE_IMAGE,   ///< rhw_binding_of_image
    RHW_SHADER_TEXEL_BUFFER,    ///< uniform or storage texel buffer: rhw_binding_of_texels
    /// rhw_binding_of_texture without a sampler, or with one. It is fetched at the fragment's pixel, in the fragment's
    /// layer where it has several: subpassLoad gives what the texture held when the pass began.
    RHW_SHADER_INPUT_ATTACHMENT,
};

/// What a type of a block is.
enum rhw_shader_type_kind {
    RHW_SHADER_FLOAT, ///< number, vector or matrix
    RHW_SHADER_INT,   ///< whole number with a sign, or a vector of them
    RHW_SHADER_UINT,  ///< whole number without a sign, or a vector of them; GLSL's bool, 0 or 1
    RHW_SHADER_ARRAY,
    RHW_SHADER_STRUCT
};

/// A type in the memory of a block, with the layout that the module gives it (std140 and std430 of GLSL among others).
struct rhw_shader_type {
    enum rhw_shader_type_kind kind;
    uint32_t bits;    ///< bits of a number: 8, 16 or 32
    uint32_t rows;    ///< rows of a matrix, components of a vector, or 1
    uint32_t columns; ///< columns of a matrix, or 1
    /// Rows of a matrix follow each other, and their components stand side by side; else its columns do.
    bool is_row_major;
    uint32_t stride; ///< bytes from column to column or row to row of a matrix, or from element to element
    uint32_t count;  ///< members of a struct, or elements of an array; 0: as many as the buffer has room for
    uint32_t size;   ///< bytes up to the last; without elements of an array that has no length
    const struct rhw_shader_type *element;   ///< type of an array's elements, or NULL
    const struct rhw_shader_member *members; ///< members of a struct, or NULL
    const char *name;                        ///< name of a struct in the module, or ""
};

struct rhw_shader_member {
    const char *name; ///< name in the module, or ""
    uint32_t offset;  ///< bytes from the begin of the struct
    const struct rhw_shader_type *type;
};

/// A buffer, image or sampler that a shader names and uses.
struct rhw_shader_resource {
    enum rhw_shader_resource_kind kind;
    uint32_t set, binding;
    uint32_t
        count; ///< elements of an array; 1 where there is none; 0 if the layout of the program says how many
    const char *name; ///< name in the module, or "" if the module has none; lives as long as the shader
    uint32_t size; ///< bytes of a buffer up to its last member, or of the part before a member without length
    bool is_read_only; ///< no code of the shader writes to it
    // Members that an image of any kind has
    enum rhw_texture_kind texture_kind;
    bool is_array, is_multisampled;
    bool is_integer; ///< its texels are whole numbers
    bool is_signed;  ///< these numbers have a sign
    bool is_depth;   ///< the module says that it holds depths, which a sampler compares: GLSL's shadow
    uint32_t
        format; ///< number of the texels' format (SPIR-V 1.3 §3.11, "Image Format"); 0: the module names none
    /// Struct of a buffer, NULL of what is none. It lives as long as the shader.
    const struct rhw_shader_type *type;
};

/// A scalar, vector or column that a shader reads from the stage before, or gives to the one after.
struct rhw_shader_variable {
    /// A vertex shader's input has the number of the attribute here, a fragment shader's output that of the target.
    uint32_t location;
    uint32_t component;  ///< first of the components, 0..3
    uint32_t components; ///< how many, 1..4
    uint32_t index; ///< 1: a fragment shader writes the second source of blending; 0: it is anything else
    bool is_integer, is_signed; ///< whole numbers, and whether they have a sign
    const char *name;           ///< name in the module, or ""; lives as long as the shader
};

/// A constant that the module lets its user choose, a number or a truth. The shader need not use it.
struct rhw_shader_constant_info {
    uint32_t id;                    ///< SpecId, for struct rhw_shader_constant
    enum rhw_shader_type_kind kind; ///< RHW_SHADER_FLOAT, RHW_SHADER_INT or RHW_SHADER_UINT
    bool is_bool;                   ///< it is a truth, 0 or 1, of the kind RHW_SHADER_UINT
    uint32_t bits;                  ///< bits of the number: 8, 16 or 32
    uint32_t value;                 ///< bits of the number that it has where nobody chooses
    const char *name;               ///< name in the module, or ""; lives as long as the shader
};

struct rhw_shader_info {
    enum rhw_shader_stage stage;
    const struct rhw_shader_resource *resources; ///< by set and binding
    uint32_t resource_count;
    const struct rhw_shader_variable *inputs,
        *outputs; ///< by location and component, built-in variables left out
    uint32_t input_count, output_count;
    const struct rhw_shader_constant_info *constants; ///< all of the module, by id
    uint32_t constant_count;
    uint32_t push_size;                      ///< bytes of the block of push constants; 0: none is used
    const struct rhw_shader_type *push_type; ///< struct of the push constants; NULL if there are none
    uint32_t size[3];                        ///< invocations of a workgroup in each direction; of compute
    uint32_t shared_size;                    ///< bytes that they share
    bool reads_view_index;                   ///< with another rhw_shader_def.view_index it is another shader
    bool reads_draw;                         ///< it asks for numbers of the draw: see struct rhw_shader_frame
};

/// Return what a shader is. It lives as long as the shader.
RHW_API const struct rhw_shader_info *rhw_shader_get_info(const rhw_shader *shader);

// Linking --------------------------------------------------------------------------------------------

/// How many bindings of a set have a number (Vulkan 1.3 §14.2.1, "Descriptor Set Layout").
struct rhw_shader_layout {
    uint32_t set, binding;
    uint32_t count;
};

struct rhw_shader_program_def {
    const rhw_shader *vertex, *fragment; ///< fragment: NULL draws depth only
    const rhw_shader *compute;           ///< alone
    /// What the sets have, in any order; programs of one layout share their sets. NULL means what the shaders name,
    /// where a binding that both name has the larger count.
    const struct rhw_shader_layout *layout;
    uint32_t layout_count;
    /// A cache gives the program again that it has of the same shaders, which come from it as well, and of an equal
    /// layout. NULL: a new one.
    rhw_shader_cache *cache;
    /// False: machine code is generated of each stage where processor, system and shader allow it and the environment
    /// does not say RHW_JIT=0. True: the interpreter executes the program. Both give the same bytes.
    bool is_interpreted;
};

/// Shaders that fit together.
typedef struct rhw_shader_program rhw_shader_program;

/// Link shaders. They may be destroyed afterwards. Return RHW_ERROR_MISUSE where they do not fit, with one line as
/// rhw_shader_create does, or RHW_ERROR_OUT_OF_MEMORY; *program is NULL then.
RHW_API enum rhw_result rhw_shader_program_create(const struct rhw_shader_program_def *def,
                                                  rhw_shader_program **program, char *message);
/// Destroy a program, which may be NULL, as often as it was created. The last time, no pipeline of it exists any more,
/// and no dispatch of it is under way.
RHW_API void rhw_shader_program_destroy(rhw_shader_program *program);

/// Return what rhw_pipeline_def.program takes. Attribute i is location i, uniforms are a struct rhw_shader_frame.
/// Unless feedback keeps outputs, a location may be several varyings, and a constant point size of 1 is not written.
RHW_API const struct rhw_program *rhw_shader_program_get(const rhw_shader_program *program);
/// What transform feedback keeps of a program's vertices: SPIR-V's XfbBuffer, XfbStride and Offset, in the words of
/// rhw_pipeline_def.feedback_outputs and feedback_strides.
struct rhw_shader_feedback {
    struct rhw_feedback_output outputs[RHW_MAX_FEEDBACK_OUTPUTS];
    int output_count; ///< 0: the vertex shader names none
    uint32_t strides[RHW_MAX_FEEDBACK_TARGETS];
};

/// Return what transform feedback keeps. It lives as long as the program.
RHW_API const struct rhw_shader_feedback *rhw_shader_program_get_feedback(const rhw_shader_program *program);
/// Return what rhw_dispatch_def.program takes. The uniforms of the dispatch are a struct rhw_shader_frame.
RHW_API const struct rhw_compute_program *rhw_shader_program_get_compute(const rhw_shader_program *program);

/// Return true if contexts whose instruction set is AVX2 or better run a stage of the program as generated machine
/// code, and false if the interpreter executes it everywhere.
RHW_API bool rhw_shader_program_is_generated(const rhw_shader_program *program, enum rhw_shader_stage stage);

/// Return the place of a binding in the array of its set: that of the first element. −1: the set does not have it.
RHW_API int rhw_shader_program_find(const rhw_shader_program *program, uint32_t set, uint32_t binding);
/// Return how many elements the array of a set has.
RHW_API uint32_t rhw_shader_program_set_size(const rhw_shader_program *program, uint32_t set);

// C --------------------------------------------------------------------------------------------------

/// What a program written as C is called.
struct rhw_shader_c_def {
    const char *name;   ///< begins the names of all that it defines; an identifier of C
    const char *source; ///< what it was made of, for the comment at its top; NULL says nothing
};

/// Give the machine code of a stage of a program to `write` as a text for people, piece by piece: instructions of
/// x86-64 with AVX2, beside what they are made of and lines of the source, if the module was compiled with them. The
/// first line says if the interpreter executes the stage here instead. The text has no format that programs could rely
/// on. Results and `message` are those of rhw_shader_create; a stage that the program does not have is
/// RHW_ERROR_MISUSE.
RHW_API enum rhw_result rhw_shader_program_print_code(
    const rhw_shader_program *program, enum rhw_shader_stage stage,
    void (*write)(void *user, const char *text, size_t size), void *user, char *message);

/// Write a program as C for rhw_add_shaders, which compiles it once per instruction set. It draws the same bytes as the
/// interpreter, and needs librhw alone. The file defines
///
///     const struct rhw_program NAME_program;               // or const struct rhw_compute_program
///     const struct rhw_shader_layout NAME_layout[COUNT];   // what the sets have, if they have something
///
/// and whoever uses them declares them. Uniforms and sets are those of the program. `*text` ends with a 0, and is freed
/// by rhw_shader_free_text. Return RHW_ERROR_MISUSE, with one line as rhw_shader_create does, or
/// RHW_ERROR_OUT_OF_MEMORY; *text is NULL then.
RHW_API enum rhw_result rhw_shader_program_emit_c(const rhw_shader_program *program,
                                                  const struct rhw_shader_c_def *def, char **text,
                                                  char *message);
/// Free a text, which may be NULL.
RHW_API void rhw_shader_free_text(char *text);

// Drawing --------------------------------------------------------------------------------------------

/// What a draw or dispatch gives its shaders. The memory that it points to lives, unchanged, until the pass or the
/// dispatch has run.
struct rhw_shader_frame {
    /// Sets. Bindings of a set lie behind one another in the order of their numbers, arrays with all their elements
    /// (rhw_shader_program_find). A set may be NULL, and a binding empty: they read as 0.
    const struct rhw_binding *sets[RHW_SHADER_MAX_SETS];
    /// Push constants. For a shader that reads the draw (SPIR-V's BaseVertex, BaseInstance and DrawIndex), its base
    /// vertex, first instance and number stand behind them, 4 bytes each from RHW_SHADER_DRAW_OFFSET on.
    const void *push_constants;
    uint32_t push_size; ///< bytes at `push_constants`
    uint32_t samples; ///< samples of a pixel, for interpolateAtSample; 0 makes every sample the pixel's centre
};

#endif
