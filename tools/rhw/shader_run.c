// SPDX-License-Identifier: MIT
// rhw shader --run: one draw on all of a picture, or one dispatch.
#include "shader_resources.h"

#include <string.h>

#include <rhw/shader_vector.h>

static void report_misuse(void *user, const char *message)
{
    cli_error(user, "%s", message);
}

static bool draw(rhw_context *context, const struct cli_shader_resources *resources,
                 const struct cli_shader_job *job, const rhw_shader_program *program, rhw_texture target)
{
    struct rhw_pipeline_def pipeline_def = rhw_pipeline_def_default();
    struct rhw_pass_def pass_def = rhw_pass_def_default();
    rhw_pipeline pipeline;
    rhw_pass pass;
    pipeline_def.program = *rhw_shader_program_get(program);
    pass_def.colors[0].texture = target;
    if (rhw_pipeline_create(context, &pipeline_def, &pipeline) != RHW_OK ||
        rhw_pass_begin(context, &pass_def, &pass) != RHW_OK) {
        return false;
    }
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_uniforms(context, pass, &resources->frame, sizeof resources->frame);
    rhw_pass_draw(context, pass, 0, 3, 0, 1);
    return rhw_pass_end(context, pass, NULL) == RHW_OK &&
           (!job->out || cli_shader_write_picture(context, target, job->width, job->height, 3, job->out));
}

static bool draw_picture(rhw_context *context, const struct cli_shader_resources *resources,
                         const struct cli_shader_job *job, const rhw_shader_program *program)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    rhw_texture target;
    def.width = job->width;
    def.height = job->height;
    if (rhw_texture_create(context, &def, &target) != RHW_OK) {
        cli_error("--size", "there is no memory for a picture of %dx%d", def.width, def.height);
        return false;
    }
    return draw(context, resources, job, program, target);
}

static bool dispatch(rhw_context *context, const struct cli_shader_resources *resources,
                     const struct cli_shader_job *job, const rhw_shader_program *program)
{
    const struct rhw_dispatch_def def = {.program = *rhw_shader_program_get_compute(program),
                                         .uniforms = &resources->frame,
                                         .uniform_bytes = sizeof resources->frame};
    return rhw_dispatch(context, &def, (uint32_t)job->groups[0], (uint32_t)job->groups[1],
                        (uint32_t)job->groups[2]) == RHW_OK;
}

static bool writes_integers(const struct cli_shader_file *files, int count)
{
    for (int i = 0; i < count; i++) {
        const struct rhw_shader_info *const info = rhw_shader_get_info(files[i].shader);
        if (info->stage == RHW_SHADER_FRAGMENT && info->output_count > 0 && info->outputs[0].is_integer) {
            return true;
        }
    }
    return false;
}

bool cli_shader_check_run(const struct cli_shader_job *job, const struct cli_shader_file *files, int count)
{
    const bool computes = files[0].stage == RHW_SHADER_COMPUTE;
    if (count == 1 && files[0].stage == RHW_SHADER_VERTEX) {
        cli_error(files[0].path, "a vertex shader runs with a fragment shader beside it");
    } else if (computes && job->out) {
        cli_error(job->out, "a compute shader has no picture; --result writes what it computes");
    } else if (computes && job->results.count == 0) {
        cli_error("--run", "of a compute shader needs --result SET:BINDING=f32, i32, u32 or FILE");
    } else if (!computes && !job->out && job->results.count == 0) {
        cli_error("--run", "of a fragment shader needs -o PICTURE.png");
    } else if (!computes && writes_integers(files, count)) {
        cli_error("--run",
                  "draws colours, which are floats, and the first output of the fragment shader is of "
                  "whole numbers");
    } else {
        return true;
    }
    return false;
}

bool cli_shader_run(struct cli_shader_job *job, const struct cli_shader_file *files, int count,
                    const rhw_shader_program *program)
{
    enum { DEFAULT_SIDE = 512 };
    struct rhw_context_def def = rhw_context_def_default();
    struct cli_shader_resources resources = {0};
    rhw_context *context;
    job->width = job->width ? job->width : DEFAULT_SIDE;
    job->height = job->height ? job->height : DEFAULT_SIDE;
    def.threads = job->threads;
    def.assert_ = report_misuse;
    def.user = (void *)files[0].path;
    if (rhw_context_create(&def, &context) != RHW_OK) {
        cli_error(files[0].path, "out of memory");
        return false;
    }
    bool done = cli_shader_resources_open(&resources, context, job, files, count, program);
    if (done) {
        done = files[0].stage == RHW_SHADER_COMPUTE ? dispatch(context, &resources, job, program)
                                                    : draw_picture(context, &resources, job, program);
    }
    done = done && cli_shader_resources_give(&resources, job);
    cli_shader_resources_close(&resources);
    rhw_context_destroy(context);
    return done;
}
