// SPDX-License-Identifier: MIT
// What rhw shader is asked for, and the shaders it works on.
#ifndef CLI_SHADER_JOB_H
#define CLI_SHADER_JOB_H

#include "budget.h"
#include "options.h"
#include "output_file.h"
#include "shader_main_image.h"

#include <glsl.h>
#include <rhw/spirv.h>

enum { CLI_SHADER_FILES = 2, CLI_SHADER_LIST = 64 };

enum cli_shader_print {
    CLI_SHADER_NOTHING = -1,
    CLI_SHADER_INFO,
    CLI_SHADER_SPIRV,
    CLI_SHADER_FORM,
    CLI_SHADER_BYTECODE,
    CLI_SHADER_CODE
};

/// What an option says about a resource, "SET:BINDING=VALUE" or "NAME=VALUE".
struct cli_shader_binding {
    const char *option;   ///< for messages, "--buffer"
    const char *argument; ///< as it was given
    char name[64];        ///< "" where there are numbers
    uint32_t set, binding;
    const char *value;
    bool is_used;
};

struct cli_shader_bindings {
    struct cli_shader_binding list[CLI_SHADER_LIST];
    int count;
};

/// A number for a constant that the module lets its user choose, "ID=NUMBER".
struct cli_shader_constant {
    const char *argument;
    uint32_t id;
    double number;
    bool is_used;
};

struct cli_shader_job {
    const char *out; ///< NULL: none
    enum cli_shader_print print;
    const char *depfile; ///< NULL: none
    bool is_strict, is_relaxed, has_step, is_before_passes, json, all_errors, runs;
    bool shades_models;      ///< it is for rhw render
    const char *entry_point; ///< NULL: "main", or the only one
    struct glsl_macro macros[CLI_SHADER_LIST];
    int macro_count;
    const char *folders[CLI_SHADER_LIST];
    int folder_count;
    struct cli_shader_constant constants[CLI_SHADER_LIST];
    int constant_count;
    // Of --run
    int width, height;
    double time, mouse[2];
    int groups[3];
    const char *push;
    struct cli_shader_bindings buffers, textures, results;
    int threads;
    struct cli_budget budget;
};

/// A file of the command line. It is zeroed at first.
struct cli_shader_file {
    const char *path;
    bool is_text;
    enum rhw_shader_stage stage;
    char *entry_point;
    uint32_t *words;
    size_t size; ///< bytes
    rhw_shader *shader;
    bool is_relaxed; ///< the text is as OpenGL has it (glsl_options)
    char *included;  ///< names of files, a line each; NULL: the file is no text
    struct cli_shader_main_image main_image;
};

extern const char *const cli_shader_stage_names[RHW_SHADER_STAGE_COUNT];

// shader_source.c. Read and compile a file. Report what is wrong, and warnings of the compiler. The file is closed in
// either case.
bool cli_shader_file_open(struct cli_shader_file *file, const char *path, const struct cli_shader_job *job);
/// Translate the words of a file, and report what is wrong.
bool cli_shader_file_translate(struct cli_shader_file *file, struct cli_shader_job *job);
void cli_shader_file_close(struct cli_shader_file *file);
/// Write a file. Report failure.
bool cli_shader_write_bytes(const char *path, const void *bytes, size_t size);
struct rhw_shader_def cli_shader_file_def(const struct cli_shader_file *file);
/// Read all bytes of a file, by malloc, with a 0 behind them. Report what is wrong; `most` is the largest size.
char *cli_shader_read(const char *path, size_t most, size_t *size);

// shader_link.c. Fit texts together by names, if one of them is none for Vulkan (glsl_match). They are not translated
// yet. Report what does not fit.
bool cli_shader_match(const struct cli_shader_file *files, int count);
/// Link the shaders of files, a fragment shader alone with one that covers the picture if it
// `needs_program`; else *linked is NULL. Report what does not fit.
bool cli_shader_link(const struct cli_shader_file *files, int count, bool needs_program,
                     rhw_shader_program **linked);

// shader_depfile.c. Write a rule of make that says what a file was made of. Report failure.
bool cli_shader_write_depfile(const char *path, const char *target, const struct cli_shader_file *files,
                              int count);

// shader_table.c. Print what shaders are.
void cli_shader_print_table(const struct cli_shader_file *file);
/// Return false for a block that ends with an array without length.
bool cli_shader_has_length(const struct rhw_shader_type *type);
void cli_shader_print_json(const struct cli_shader_file *files, int count);

/// Return whether an option is about a resource.
bool cli_shader_binding_is(const struct cli_shader_binding *binding,
                           const struct rhw_shader_resource *resource);

// shader_run.c. Report what the command line lacks to run such shaders.
bool cli_shader_check_run(const struct cli_shader_job *job, const struct cli_shader_file *files, int count);
// Draw or dispatch. Report what is wrong.
bool cli_shader_run(struct cli_shader_job *job, const struct cli_shader_file *files, int count,
                    const rhw_shader_program *program);

#endif
