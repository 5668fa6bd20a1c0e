// SPDX-License-Identifier: MIT
// What a shader that is run reads and writes.
#ifndef CLI_SHADER_RESOURCES_H
#define CLI_SHADER_RESOURCES_H

#include "shader_job.h"

#include <rhw/rhw.h>

struct cli_shader_resource {
    const struct rhw_shader_resource *what;
    void *memory; ///< of a buffer
    size_t size;
    rhw_texture texture; ///< of a texture or image
    int width, height;
};

struct cli_shader_resources {
    rhw_context *context;
    struct cli_shader_resource *list;
    int count;
    struct rhw_binding *sets[RHW_SHADER_MAX_SETS];
    void *push;
    size_t push_size;
    struct rhw_shader_frame frame; ///< of all these
};

/// Make what the shaders of a program name, as the command line says it or of zeros. Report what is wrong. Close it in
/// either case.
bool cli_shader_resources_open(struct cli_shader_resources *resources, rhw_context *context,
                               struct cli_shader_job *job, const struct cli_shader_file *files, int count,
                               const rhw_shader_program *program);
void cli_shader_resources_close(struct cli_shader_resources *resources);

/// Print or write what --result asks for.
bool cli_shader_resources_give(const struct cli_shader_resources *resources,
                               const struct cli_shader_job *job);

/// Write a texture of RGBA8_UNORM as a PNG file.
bool cli_shader_write_picture(rhw_context *context, rhw_texture texture, int width, int height, int channels,
                              const char *path);

#endif
