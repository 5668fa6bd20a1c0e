// SPDX-License-Identifier: MIT
// GLSL 4.50 and ESSL 3.10 texts for Vulkan 1.1 become SPIR-V 1.3. A build without glslang has the same functions, and
// refuses every text in one line. Any thread may compile, and several at a time. Each text is compiled in a process of
// its own, which may crash or take too long.
#ifndef GLSL_GLSL_H
#define GLSL_GLSL_H

#include <rhw/spirv.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    GLSL_MAX_INCLUDE_DEPTH = 32,   ///< files that include each other
    GLSL_MAX_TEXT_SIZE = 16 << 20, ///< bytes of a text, and of a file that is included
    GLSL_MAX_CODE_SIZE = 256 << 20 ///< bytes of a module
};

/// A macro that a text may use, as `#define name value` before its first line.
struct glsl_macro {
    const char *name;
    const char *value; ///< NULL: nothing, as for `#define name`
};

/// What an include is to become.
struct glsl_include {
    const char *header;   ///< what stands between quotes or angle brackets
    const char *includer; ///< name of the text or file that has the line
    bool is_system;       ///< between angle brackets
    char *name;           ///< result: name of the file, for messages, by malloc
    char *text;           ///< result: its bytes, by malloc; glsl_compile frees both
    size_t size;          ///< result: how many bytes
};

struct glsl_options {
    const struct glsl_macro *macros;
    uint32_t macro_count;
    /// Fill the results of an include. Return NULL, or what is wrong: it lives until the next call. It runs in the
    /// process that compiles, so what it changes is lost. NULL: a text that includes is refused.
    const char *(*include)(void *user, struct glsl_include *include);
    void *user;
    /// A text that is none for Vulkan is taken as OpenGL has it: uniforms that are in no block go to a block
    /// `gl_DefaultUniformBlock` of set 0, and what has no binding or location gets the next free one. glsl_place and
    /// glsl_match put things where their names belong.
    bool is_relaxed;
    /// The code knows its text and the lines that instructions come from, for rhw_shader_print.
    bool has_lines;
    const char
        *before; ///< GLSL that stands before the first line of the text, and is no line of it; NULL: none
};

/// A compiled text.
struct glsl_code {
    uint32_t *words; ///< NULL: there was an error
    size_t size;     ///< bytes
    char *log;       ///< errors and then warnings, a line each; "" if there is none
    char *files;     ///< names of the files that were included, a line each
    bool is_relaxed; ///< it is as OpenGL has it, because it is none for Vulkan
};

/// Return whether this build can compile.
bool glsl_is_there(void);

/// Compile a text of `size` bytes. `name` is what messages call it, and the file that includes are relative to. A text
/// without #version is GLSL 4.50. Return false on an error, and put the first one into `message`, in one line that
/// names file and line. The code is given back by glsl_code_free in either case.
bool glsl_compile(enum rhw_shader_stage stage, const char *text, size_t size, const char *name,
                  const struct glsl_options *options, struct glsl_code *code, char *message,
                  size_t message_size);

/// Give the instructions of a module as a text, by malloc, as spirv-dis writes it. Return NULL, with one line in
/// `message`, for what is no module.
char *glsl_disassemble(const uint32_t *words, size_t size, char *message, size_t message_size);

void glsl_code_free(struct glsl_code *code);

/// Folders for glsl_include_file.
struct glsl_folders {
    const char *const *folders;
    uint32_t count;
};

/// glsl_options.include, whose user is a const struct glsl_folders: a file relative to that which includes it, unless
/// in angle brackets, then in each of the folders.
const char *glsl_include_file(void *user, struct glsl_include *include);

#ifdef __cplusplus
}
#endif

#endif
