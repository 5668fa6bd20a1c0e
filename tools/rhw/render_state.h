// SPDX-License-Identifier: MIT
// What the files of rhw render share while it works.
#ifndef CLI_RENDER_STATE_H
#define CLI_RENDER_STATE_H

#include "model_input.h"
#include "output_file.h"
#include "panorama_load.h"
#include "render_job.h"

struct render {
    struct cli_render_job job;
    struct cli_model_input input;
    struct scene_progress *progress; // of the import, as in struct scene_model_options
    /// Asked while a model or standard input is read and all the while that a picture is drawn; false: it is given up,
    /// without a report. NULL: nobody is asked.
    bool (*goes_on)(void *user);
    void *user;
    struct scene_model *model;
    struct scene_panorama panorama;    // with job.environment
    struct rhw_shader_program *shader; // with job.fragment_shader
    const struct rhw_program *program; // that is in it
    rhw_context *context;
    struct scene *scene;
    struct scene_view view;
    struct scene_pictures pictures;
    struct scene_draw_stats stats;
    struct cli_render_times times;
    char out[4096];                // job.out with names in place
    char *paths[CLI_OUTPUT_KINDS]; // NULL: not written
    struct cli_output_file files[CLI_OUTPUT_KINDS];
    int file_count;        // open ones
    bool distrusts_camera; // the file's first camera gave way to the fit
};

double cli_milliseconds(void);

// render.c

/// Asks the machine for what the job wants. Reports failure.
bool cli_render_prepare(struct render *render);
/// Gives that back, when its models are forgotten.
void cli_render_release(struct render *render);
/// Reads the model and sets the view; a cli_status. Nothing is uploaded yet.
int cli_render_open(struct render *render, const char *path);
/// The first half of it: standard input to its end, where the path is "-". Reports failure.
bool cli_render_take_input(struct render *render, const char *path);
/// And the second.
int cli_render_read(struct render *render);
/// Frees what is of one model alone.
void cli_render_forget_model(struct render *render);

// render_draw.c

/// Warns of what the model has and is not drawn as it is meant. False after a message: nothing can be drawn, or with
/// --strict not all of it.
bool cli_render_accept(const struct render *render);
/// False after a message: the job asks for a view that cannot be.
bool cli_render_set_view(struct render *render);
/// Makes the context and the scene. Reports failure.
bool cli_render_open_scene(struct render *render);
/// Draws the view. Reports failure.
bool cli_render_draw(struct render *render);
/// Draws the view, or where the file's own camera sees nothing, one that is fitted. Reports failure.
bool cli_render_draw_seen(struct render *render);

// render_frames.c: all pictures of a model that moves, with the camera that is set for its first. Reports failure; the
// scene is gone then.
bool cli_render_frames(struct render *render);

// render_files.c

/// Whether OUT stands for a file for each view.
bool cli_render_has_file_per_view(const struct cli_render_job *job);
/// Reports what would keep any of the files from being written.
bool cli_render_files_check(struct render *render);
/// Sets the paths of the next picture, that of a view or frame, counted from 0; −1: there are none. Reports failure.
bool cli_render_files_plan(struct render *render, int number);
/// Sets the path of the picture of one output, as it stands there. Reports failure.
bool cli_render_files_name(struct render *render, const char *path);
/// One output of what is drawn as a raster.
void cli_render_rasterize(const struct render *render, enum scene_output_kind kind,
                          struct cli_output_raster *output);
/// Writes the pictures into all of them or none. Reports failure.
bool cli_render_files_write(struct render *render);
void cli_render_files_forget(struct render *render);

#endif
