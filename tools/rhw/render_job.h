// SPDX-License-Identifier: MIT
// What one `rhw render` is asked to do, as its command line says; and what it measured while doing it.
#ifndef CLI_RENDER_JOB_H
#define CLI_RENDER_JOB_H

#include "budget.h"
#include "options.h"
#include "outputs.h"
#include "views.h"

enum cli_camera_choice {
    CLI_CAMERA_AUTO,  ///< the file's first camera, or else fitted
    CLI_CAMERA_FIT,   ///< fitted from the default angle
    CLI_CAMERA_ORBIT, ///< fitted from a given angle
    CLI_CAMERA_VIEWS, ///< fitted from each of several angles
    CLI_CAMERA_LOOK,  ///< eye, target, up, fovy or with `orthographic` the height of what is seen
    CLI_CAMERA_INDEX, ///< a camera of the file
    CLI_CAMERA_NAME
};

struct cli_render_job {
    const char *const *model_paths;
    int model_count;
    const char *model_path; ///< of model_paths, the one whose turn it is
    const char *out;        ///< {name} stands for that model's, {view} for the view's, {} for the output's
    bool is_literal;        ///< nothing in `out` stands for anything
    char own_out[512];      ///< where `out` points when it was not given
    const char *variant;    ///< of the materials; NULL: none
    bool is_posed;          ///< as an animation has it at `time`
    const char *animation;  ///< its name or number; NULL: the first
    double time;            ///< seconds
    bool has_time;
    double rate;   ///< pictures per second of it; 0: it is not played
    int turntable; ///< pictures of a whole turn; 0: none
    enum cli_picture_format format;
    int width, height, samples, supersample;
    enum cli_camera_choice camera;
    const char *camera_option; ///< the option that chose it, for messages
    struct scene_orbit orbit;  ///< with ORBIT; with VIEWS that of the view whose turn it is
    int views[CLI_VIEWS], view_count;
    bool fit_all, has_up;
    enum scene_axis up; ///< with has_up; else the model's
    double look[10];
    int camera_index;
    const char *camera_name;
    double zoom;   ///< of a fitted camera
    double margin; ///< part of the picture, on each side of a fitted model; negative: the default
    bool orthographic, print_camera;
    float fovy; ///< degrees, of a fitted camera; 0: default
    enum rhw_qualifier interpolate;
    enum scene_wireframe wireframe;
    enum scene_background background;
    uint8_t background_color[3];
    bool default_lights, no_lights, shadows, ground, ambient_occlusion, quiet;
    bool offers_time; // who asked has a --time
    float exposure;
    const char *environment; ///< a file; NULL: the studio
    float environment_rotation;
    enum scene_tone tone;
    enum scene_transparency transparency;
    unsigned kinds;         ///< set of 1 << enum scene_output_kind
    int bits;               ///< 0: as the output wants
    int quality;            ///< of JPEG and WebP; 0: the default
    const char *thumb_mark; ///< kept in a PNG, thumb_mark.h; NULL: none
    int threads;
    enum rhw_isa isa; ///< RHW_ISA_COUNT: the best
    enum rhw_paths paths;
    bool stats;
    const char *stats_path; ///< "-": standard output
    struct cli_budget budget;
    bool strict;                 ///< what the file has and is not drawn is an error
    const char *fragment_shader; ///< a file that shades instead of materials; NULL: none
    bool wants_template;         ///< of such a file, and nothing else
};

enum { CLI_AXES = SCENE_AXIS_MINUS_X + 1 };

extern const char *const cli_axis_names[CLI_AXES]; ///< of enum scene_axis

/// Whether OUT has the word, in its braces, and it stands for something.
bool cli_out_has(const struct cli_render_job *job, const char *word);

/// What --fit fits: all, or the subject, which it is without an argument, NULL. Reports what is wrong with it.
bool cli_parse_fit(const char *argument, bool *fit_all);

struct cli_render_times {
    double import_ms, encode_ms, total_ms;
};

/// A verb that draws one model as rhw render would, and so has its options beside those of its own.
struct cli_render_asked {
    const struct cli_verb *verb; ///< what it has beyond rhw render; ids are CLI_ASKED_OPTION and up
    bool (*take)(void *user, int id, const char *argument); ///< an option of its own; reports what is wrong
    void *user;
};

enum { CLI_ASKED_OPTION = 900 };

/// Fills the job from the command line of `asked`; NULL: of rhw render itself, which takes several models. True to go
/// on; else `*status` is what to return, CLI_OK after the help was printed.
bool cli_render_job_parse(struct cli_render_job *job, const struct cli_render_asked *asked, int argc,
                          char **argv, int *status);
/// Whether there are several pictures that follow one another.
static inline bool cli_render_moves(const struct cli_render_job *job)
{
    return job->rate > 0.0 || job->turntable > 0;
}
/// Fills in what follows from the options that were given; reports those that exclude each other.
bool cli_render_job_complete(struct cli_render_job *job);

/// Writes what --stats promises. Reports failure.
bool cli_render_report(const struct cli_render_job *job, const struct scene_model *model,
                       const struct scene_draw_stats *stats, const struct cli_render_times *times);

#endif
