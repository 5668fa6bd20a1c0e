// SPDX-License-Identifier: MIT
// The command line of rhw render: its options, what they mean, and which of them exclude each other. All of
// it is checked before the model is opened, so that a mistake costs no time.
#include "options.h"
#include "output_file.h"
#include "render_job.h"
#include "render_look.h"

#include <stdio.h>
#include <string.h>

enum {
    OPTION_OUT = 'o',
    OPTION_SIZE = 's',
    OPTION_QUIET = 'q',
    OPTION_THREADS = 'j',
    OPTION_SAMPLES = 256,
    OPTION_SUPERSAMPLE,
    OPTION_CAMERA,
    OPTION_ORBIT,
    OPTION_VIEWS,
    OPTION_FIT,
    OPTION_UP,
    OPTION_VARIANT,
    OPTION_ANIMATION,
    OPTION_TIME,
    OPTION_ANIMATE,
    OPTION_TURNTABLE,
    OPTION_CAMERA_INDEX,
    OPTION_CAMERA_NAME,
    OPTION_FOVY,
    OPTION_OUTPUT,
    OPTION_BITS,
    OPTION_FORMAT,
    OPTION_ISA,
    OPTION_PATHS,
    OPTION_ZOOM,
    OPTION_MARGIN,
    OPTION_ORTHO,
    OPTION_PRINT_CAMERA,
    OPTION_QUALITY,
    OPTION_STATS,
    OPTION_LITERAL,
    OPTION_THUMB_MARK,
    OPTION_FRAGMENT_SHADER,
    OPTION_FRAGMENT_TEMPLATE,
    OPTION_STRICT
};

static const struct cli_option options[] = {
    {"out", OPTION_OUT, "OUT",
     "the file to write: .png, .jpg, .webp, .exr or .ppm; '-' is standard\noutput; default: MODEL's name "
     "with .png in the current folder, unless there is\nsuch a file"},
    {"literal", OPTION_LITERAL, NULL, "braces in OUT stand for themselves (see below)"},
    {"size", OPTION_SIZE, "WxH", "pixels, each way 1..16384, or N for a square; default 1280x720"},
    {"samples", OPTION_SAMPLES, "N", "samples of each pixel, for smooth edges: 1, 2, 4, 8 or 16; default 4"},
    {"supersample", OPTION_SUPERSAMPLE, "N",
     "pixels drawn and shaded for each one of the picture, which smooths surfaces too and costs as many\n"
     "times as much: 1, 4, 9 or 16; default 1"},
    {"output", OPTION_OUTPUT, "LIST", "what to write, separated by commas; default color (see below)"},
    {"bits", OPTION_BITS, "N", "8 or 16 bits per sample of PNG and PPM; default: as the output needs"},
    {"format", OPTION_FORMAT, "NAME", "png, jpeg, webp, exr or ppm, whatever OUT ends in"},
    {"quality", OPTION_QUALITY, "N", "of JPEG, 1..100; default 92; of WebP, which is lossless without"},
    {"fit", OPTION_FIT, "[WHAT]",
     "fit the model into the picture, also when the file has cameras: its\nsubject (the default), without a "
     "ground "
     "that would make it a dot, or\nall"},
    {"up", OPTION_UP, "AXIS", "what is up: x, y, z, -x, -y or -z; default: as the file says (see below)"},
    {"zoom", OPTION_ZOOM, "FACTOR", "larger, or below 1 smaller, than it is fitted"},
    {"margin", OPTION_MARGIN, "PERCENT", "left free on each side of it; default 4"},
    {"ortho", OPTION_ORTHO, NULL, "fit it, or look with --camera, without perspective"},
    {"print-camera", OPTION_PRINT_CAMERA, NULL,
     "print the camera that was used as a --camera option to paste"},
    {"orbit", OPTION_ORBIT, "AZ[,EL]",
     "fit it from these angles in degrees: azimuth 0 is the front, 90 the\nright side; elevation 90 is "
     "straight from above, and 20 where it is left out; default:\n30,20, or a flat model from its front"},
    {"views", OPTION_VIEWS, "LIST",
     "fit it from each of front, back, left, right, top, bottom and iso, or all: in a\ngrid on one sheet of "
     "pictures "
     "of --size, or where OUT has a {view} a file for each"},
    {"camera", OPTION_CAMERA, "NUMBERS",
     "eye, target and up (three numbers each) and the vertical field of\nview in degrees, or with --ortho "
     "the height of what is seen, separated by commas;\nplaces are those of the file, also far from its "
     "origin"},
    {"camera-index", OPTION_CAMERA_INDEX, "N", "a camera of the file, counted from 0; see rhw info"},
    {"camera-name", OPTION_CAMERA_NAME, "NAME", "a camera of the file"},
    {"fovy", OPTION_FOVY, "DEGREES", "vertical field of view of a fitted camera; default 30"},
    {"interpolate", CLI_LOOK_INTERPOLATE, "HOW",
     "smooth (right in perspective) or noperspective (to see the error)"},
    {"wireframe", CLI_LOOK_WIREFRAME, "[KIND]",
     "edges over the shaded surface (over) or over a plain one (plain)"},
    {"background", CLI_LOOK_BACKGROUND, "COLOR",
     "rrggbb or rgb in hexadecimal, a name as white or skyblue, transparent,\nenvironment or default"},
    {"variant", OPTION_VARIANT, "NAME",
     "the materials of this name, of a glTF that offers a choice; see rhw info"},
    {"animation", OPTION_ANIMATION, "NAME",
     "which animation, by its name or number; default the first; see rhw info"},
    {"time", OPTION_TIME, "SECONDS", "draw the model as the animation has it then; default: at rest"},
    {"animate", OPTION_ANIMATE, "FPS",
     "draw all of the animation, so many pictures a second: into one .png or .webp\nthat moves, or where OUT "
     "has a "
     "{frame} a file for each"},
    {"turntable", OPTION_TURNTABLE, "N",
     "the same from N places around the model; with --animate while it moves"},
    {"lights", CLI_LOOK_LIGHTS, "WHICH",
     "file (default: those of the file, if any), default or none, which leaves the\nsurroundings"},
    {"shadows", CLI_LOOK_SHADOWS, "WHICH", "of the lights: on (the default) or off"},
    {"ground", CLI_LOOK_GROUND, NULL,
     "let the model cast a soft shadow on a ground that does not show otherwise"},
    {"ambient-occlusion", CLI_LOOK_AMBIENT_OCCLUSION, "WHICH",
     "darken where things stand close together: on (the default) or off"},
    {"environment", CLI_LOOK_ENVIRONMENT, "FILE",
     "light the model by a panorama (.hdr or .exr) instead of the studio;\n--background environment shows "
     "it"},
    {"environment-rotation", CLI_LOOK_ENVIRONMENT_ROTATION, "DEGREES", "turn it about what is up"},
    {"tone-map", CLI_LOOK_TONE_MAP, "NAME",
     "how light becomes colours: neutral (the default), aces, agx or none"},
    {"transparency", CLI_LOOK_TRANSPARENCY, "HOW",
     "sorted (the default: transparent surfaces by the middles of their triangles) or\nexact (in every "
     "sample by "
     "their depth there, which takes a pass for each layer)"},
    {"exposure", CLI_LOOK_EXPOSURE, "STOPS", "brighter by this many factors of two; -20..20"},
    {"fragment-shader", OPTION_FRAGMENT_SHADER, "FILE",
     "let a shader of your own, .frag (GLSL) or .spv (SPIR-V), shade the model instead of its materials"},
    {"fragment-shader-template", OPTION_FRAGMENT_TEMPLATE, NULL,
     "print such a shader, with all that it may read, to begin with"},
    {"threads", OPTION_THREADS, "N",
     "threads to use, 1..64; default: one for each core that the process may\nuse. The picture is the same"},
    {"isa", OPTION_ISA, "NAME",
     "instruction set: baseline, avx2 or avx512; default: avx2 where the CPU has\nit. The picture is the "
     "same"},
    {"paths", OPTION_PATHS, "WHICH",
     "all (the default), in-order (hidden fragments are shaded too) or general (no\nspecial path is taken). "
     "The "
     "picture is the same"},
    {"max-memory", CLI_BUDGET_MEMORY, "SIZE",
     "fail when more than this is needed, for example 512M or 2G; default: reading a model may take 3/4 "
     "of\nthe "
     "machine's memory, at most 16G"},
    {"max-time", CLI_BUDGET_TIME, "SECONDS",
     "fail when the whole of it takes longer, 0.1..86400; reading a model may always take\n60"},
    {"max-texture", CLI_BUDGET_TEXTURE, "N",
     "halve textures until they are no longer than this; default: 4 times the picture's longer side, "
     "at\nleast "
     "1024, or 16384 with a camera that is not fitted"},
    {"confine", CLI_BUDGET_CONFINE, "[DIR]",
     "read no file outside this folder that the model names; without DIR outside its\nown"},
    {"stats", OPTION_STATS, "[FILE]",
     "write the time of each stage, memory and counts as JSON, to standard output\nwithout FILE"},
    {"strict", OPTION_STRICT, NULL,
     "no picture where the file has something that is not drawn as it is meant, or next to\nnothing of it is "
     "seen"},
    {"quiet", OPTION_QUIET, NULL, "no warnings"},
    {"thumb-mark", OPTION_THUMB_MARK, "TEXT", NULL}, // of rhw thumbs, which starts this verb
};

static void print_kinds(int first, int end)
{
    for (int kind = first; kind < end; kind++) {
        printf("  %-10s%s\n", scene_outputs[kind].word, scene_outputs[kind].shown);
    }
}

static void print_outputs(void)
{
    puts("Outputs, and what they are in PNG and PPM (data is black where nothing is):");
    print_kinds(0, SCENE_KIND_OVERDRAW);
    puts("  all       all of these\n"
         "and of the work (dark to light is none to the most, which the file's comment tells):");
    print_kinds(SCENE_KIND_OVERDRAW, CLI_OUTPUT_KINDS);
}

static const char notes[] =
    "The ranges behind depth, distance and position stand in the PNG file as a comment.\n\n"
    "With several outputs in PNG or PPM, color takes the name OUT and the others get theirs before the "
    "ending:\n"
    "out.depth.png. Where OUT has a {}, the name of the output takes its place. Several models need an OUT "
    "with "
    "{name},\n"
    "which stands for a model's name without its ending: rhw render *.glb -o out/{name}.png. With --literal "
    "nothing in\n"
    "OUT stands for anything. An EXR holds all outputs in one file as numbers without any mapping: R G B A\n"
    "(light before tone mapping, premultiplied, without background), depth.Z, distance.Z, normal.XYZA,\n"
    "position.XYZA, uv.UV, object.id, triangle.id (integers, 0 is nothing), bary.abc.\n\n"
    "What is up matters to a fitted camera and to the sky. glTF has y; 3MF, AMF, Blender, COB, HMP and SMD "
    "z; FBX says it;\nSTL, XYZ, PTS and ASC have z, OBJ, PLY, OFF and XGL y, unless the model stands on "
    "another side, which --stats tells.\nNumbers stay those of the file.\n\n"
    "MODEL may be '-', standard input; files that it names are looked for in the current folder.\n\n"
    "Without --fit, --orbit or --camera the file's first camera is taken; where there is none, or the "
    "model is nothing but\n"
    "a dot in it, the model is fitted into the picture.\n"
    "A file appears whole or not at all.\n\n"
    "Exit status: 0, 1 when the work failed, 2 for a wrong command line.";

static const struct cli_verb verb = {
    .name = "render",
    .operands = "MODEL... [-o OUT]",
    .summary = "Draws model files (glTF, OBJ, PLY, STL, FBX, 3DS, Collada and more) and writes the picture.",
    .options = options,
    .option_count = (int)(sizeof options / sizeof *options),
    .print_table = print_outputs,
    .notes = notes,
};

static bool choose_camera(struct cli_render_job *job, enum cli_camera_choice choice, const char *option)
{
    // Which fit as well.
    const bool turns = choice == CLI_CAMERA_ORBIT || choice == CLI_CAMERA_VIEWS;
    const bool refines = job->camera == CLI_CAMERA_FIT && turns;
    if (job->camera != CLI_CAMERA_AUTO && job->camera != choice && !refines) {
        cli_error(option, "cannot be together with %s", job->camera_option);
        return false;
    }
    job->camera = choice;
    job->camera_option = option;
    return true;
}

// `bad`: where an unknown name begins.
static void refuse_output(const char *bad)
{
    char list[128] = "";
    for (int kind = 0; kind < CLI_OUTPUT_KINDS; kind++) {
        strcat(list, scene_outputs[kind].word);
        strcat(list, ", ");
    }
    cli_error("--output", "'%.*s' is no output; there are %sall", (int)strcspn(bad, ","), bad, list);
}

static bool parse_isa(struct cli_render_job *job, const char *argument)
{
    const char *names[RHW_ISA_COUNT];
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        names[isa] = rhw_isa_name((enum rhw_isa)isa);
    }
    const int isa = cli_choose("--isa", argument, names, RHW_ISA_COUNT);
    if (isa < 0) {
        return false;
    }
    job->isa = (enum rhw_isa)isa;
    return true;
}

static bool parse_paths(struct cli_render_job *job, const char *argument)
{
    static const char *const names[] = {
        [RHW_PATHS_ALL] = "all", [RHW_PATHS_IN_ORDER] = "in-order", [RHW_PATHS_GENERAL] = "general"};
    const int paths =
        cli_choose("--paths", argument, (const char *const *)names, sizeof names / sizeof *names);
    if (paths < 0) {
        return false;
    }
    job->paths = (enum rhw_paths)paths;
    return true;
}

bool cli_parse_fit(const char *argument, bool *fit_all)
{
    static const char *const names[] = {"subject", "all"};
    const int what = argument ? cli_choose("--fit", argument, names, 2) : 0;
    *fit_all = what == 1;
    return what >= 0;
}

static bool parse_fit(struct cli_render_job *job, const char *argument)
{
    const bool turned = job->camera == CLI_CAMERA_ORBIT || job->camera == CLI_CAMERA_VIEWS;
    // --orbit and --views fit as well
    return cli_parse_fit(argument, &job->fit_all) && (turned || choose_camera(job, CLI_CAMERA_FIT, "--fit"));
}

const char *const cli_axis_names[CLI_AXES] = {
    [SCENE_AXIS_Y] = "y",        [SCENE_AXIS_Z] = "z",        [SCENE_AXIS_X] = "x",
    [SCENE_AXIS_MINUS_Y] = "-y", [SCENE_AXIS_MINUS_Z] = "-z", [SCENE_AXIS_MINUS_X] = "-x"};

// A plus is allowed, as modellers write it. The list of a message is in the order of the help.
static bool parse_up(struct cli_render_job *job, const char *argument)
{
    static const enum scene_axis axes[CLI_AXES] = {
        SCENE_AXIS_X, SCENE_AXIS_Y, SCENE_AXIS_Z, SCENE_AXIS_MINUS_X, SCENE_AXIS_MINUS_Y, SCENE_AXIS_MINUS_Z};
    const char *names[CLI_AXES];
    for (int i = 0; i < CLI_AXES; i++) {
        names[i] = cli_axis_names[axes[i]];
    }
    const bool has_plus = argument[0] == '+' && cli_parse_name(argument + 1, names, 3) >= 0;
    const int up = cli_choose("--up", argument + has_plus, names, CLI_AXES);
    job->up = axes[up >= 0 ? up : 0];
    job->has_up = true;
    return up >= 0;
}

static bool parse_camera_option(struct cli_render_job *job, int id, const char *argument)
{
    double angles[2] = {0.0, 20.0};
    int count;
    switch (id) {
    case OPTION_CAMERA:
        if (cli_parse_numbers(argument, 10, 10, job->look, &count)) {
            return choose_camera(job, CLI_CAMERA_LOOK, "--camera");
        }
        cli_error(
            "--camera",
            "'%s' is not ten numbers: eye, target, up (x,y,z each) and fovy in degrees, or with --ortho the "
            "height of what is seen",
            argument);
        return false;
    case OPTION_ORBIT:
        if (!cli_parse_numbers(argument, 1, 2, angles, &count)) {
            cli_error("--orbit", "'%s' is not one or two angles in degrees: azimuth,elevation", argument);
            return false;
        }
        job->orbit = (struct scene_orbit){.azimuth = angles[0], .elevation = angles[1]};
        return choose_camera(job, CLI_CAMERA_ORBIT, "--orbit");
    case OPTION_VIEWS:
        return cli_views_parse(argument, job->views, &job->view_count) &&
               choose_camera(job, CLI_CAMERA_VIEWS, "--views");
    case OPTION_CAMERA_INDEX:
        if (cli_parse_int(argument, 0, 1 << 20, &job->camera_index)) {
            return choose_camera(job, CLI_CAMERA_INDEX, "--camera-index");
        }
        cli_error("--camera-index", "'%s' is not a number from 0", argument);
        return false;
    case OPTION_CAMERA_NAME:
        job->camera_name = argument;
        return choose_camera(job, CLI_CAMERA_NAME, "--camera-name");
    case OPTION_ZOOM:
        if (cli_parse_numbers(argument, 1, 1, &job->zoom, &count) && job->zoom >= 0.01 &&
            job->zoom <= 100.0) {
            return true;
        }
        cli_error("--zoom", "'%s' is not a factor of 0.01 to 100", argument);
        return false;
    case OPTION_MARGIN:
        if (cli_parse_numbers(argument, 1, 1, &job->margin, &count) && job->margin >= 0.0 &&
            job->margin <= 45.0) {
            job->margin /= 100.0;
            return true;
        }
        cli_error("--margin", "'%s' is not a percentage of 0 to 45", argument);
        return false;
    case OPTION_ORTHO: job->orthographic = true; return true;
    case OPTION_PRINT_CAMERA: job->print_camera = true; return true;
    case OPTION_FOVY:
        if (cli_parse_float(argument, &job->fovy) && job->fovy >= 0.01f && job->fovy <= 179.0f) {
            return true;
        }
        cli_error("--fovy", "'%s' is not an angle of 0.01 to 179 degrees", argument);
        return false;
    default: return parse_fit(job, argument);
    }
}

static bool parse_picture_option(struct cli_render_job *job, int id, const char *argument)
{
    static const char *const formats[] = {"png", "exr", "ppm", "jpeg", "webp"};
    const char *bad;
    int format;
    switch (id) {
    case OPTION_SIZE:
        if (cli_parse_size(argument, &job->width, &job->height)) {
            return true;
        }
        cli_error("--size", "'%s' is not WxH or one number, each 1..%d", argument, RHW_MAX_TARGET_SIZE);
        return false;
    case OPTION_SAMPLES:
        if (cli_parse_int(argument, 1, 16, &job->samples) && (job->samples & (job->samples - 1)) == 0) {
            return true;
        }
        cli_error("--samples", "'%s' is not 1, 2, 4, 8 or 16", argument);
        return false;
    case OPTION_SUPERSAMPLE:
        if (cli_parse_int(argument, 1, 16, &job->supersample) &&
            (job->supersample == 1 || job->supersample == 4 || job->supersample == 9 ||
             job->supersample == 16)) {
            return true;
        }
        cli_error("--supersample", "'%s' is not 1, 4, 9 or 16", argument);
        return false;
    case OPTION_OUTPUT:
        if (cli_outputs_parse(argument, &job->kinds, &bad)) {
            return true;
        }
        refuse_output(bad);
        return false;
    case OPTION_BITS:
        if (cli_parse_int(argument, 8, 16, &job->bits) && (job->bits == 8 || job->bits == 16)) {
            return true;
        }
        cli_error("--bits", "'%s' is not 8 or 16", argument);
        return false;
    case OPTION_QUALITY:
        if (cli_parse_int(argument, 1, 100, &job->quality)) {
            return true;
        }
        cli_error("--quality", "'%s' is not a number of 1 to 100", argument);
        return false;
    default:
        format = cli_choose("--format", argument, formats, 5);
        job->format = (enum cli_picture_format)format;
        return format >= 0;
    }
}

static bool parse_movement_option(struct cli_render_job *job, int id, const char *argument)
{
    int count;
    switch (id) {
    case OPTION_ANIMATION:
        job->is_posed = true;
        job->animation = argument;
        return true;
    case OPTION_TIME:
        job->is_posed = true;
        job->has_time = true;
        if (cli_parse_numbers(argument, 1, 1, &job->time, &count)) {
            return true;
        }
        cli_error("--time", "'%s' is not a number of seconds", argument);
        return false;
    case OPTION_ANIMATE:
        if (cli_parse_numbers(argument, 1, 1, &job->rate, &count) && job->rate >= 0.1 && job->rate <= 240.0) {
            return true;
        }
        cli_error("--animate", "'%s' is not a number of pictures a second, 0.1 to 240", argument);
        return false;
    default:
        if (cli_parse_int(argument, 2, 10000, &job->turntable)) {
            return true;
        }
        cli_error("--turntable", "'%s' is not a number of 2 to 10000", argument);
        return false;
    }
}

static bool parse_option(struct cli_render_job *job, int id, const char *argument)
{
    switch (id) {
    case OPTION_ANIMATION:
    case OPTION_TIME:
    case OPTION_ANIMATE:
    case OPTION_TURNTABLE: return parse_movement_option(job, id, argument);
    case OPTION_OUT: job->out = argument; return true;
    case OPTION_QUIET: job->quiet = true; return true;
    case OPTION_STRICT: job->strict = true; return true;
    case OPTION_FRAGMENT_SHADER: job->fragment_shader = argument; return true;
    case OPTION_FRAGMENT_TEMPLATE: job->wants_template = true; return true;
    case OPTION_VARIANT: job->variant = argument; return true;
    case OPTION_STATS:
        job->stats = true;
        job->stats_path = argument ? argument : "-";
        return true;
    case OPTION_LITERAL: job->is_literal = true; return true;
    case OPTION_THUMB_MARK:
        job->thumb_mark = argument;
        if (!*argument) {
            cli_error("--thumb-mark", "needs a TEXT, and '' is none");
        }
        return *argument != '\0';
    case OPTION_ISA: return parse_isa(job, argument);
    case OPTION_UP: return parse_up(job, argument);
    case OPTION_PATHS: return parse_paths(job, argument);
    case OPTION_THREADS:
        if (cli_parse_int(argument, 1, RHW_MAX_THREADS, &job->threads)) {
            return true;
        }
        cli_error("--threads", "'%s' is not a number of 1 to %d", argument, RHW_MAX_THREADS);
        return false;
    case OPTION_CAMERA:
    case OPTION_ORBIT:
    case OPTION_VIEWS:
    case OPTION_FIT:
    case OPTION_CAMERA_INDEX:
    case OPTION_CAMERA_NAME:
    case OPTION_ZOOM:
    case OPTION_MARGIN:
    case OPTION_ORTHO:
    case OPTION_PRINT_CAMERA:
    case OPTION_FOVY: return parse_camera_option(job, id, argument);
    default:
        if (id >= CLI_BUDGET_MEMORY) {
            return cli_parse_budget(&job->budget, id, argument);
        }
        return id >= CLI_LOOK_INTERPOLATE ? cli_parse_look(job, id, argument)
                                          : parse_picture_option(job, id, argument);
    }
}

// The options are ours and those of `asked`, the messages and the help speak of the verb that was typed.
static void start_parser(struct cli_parser *parser, struct cli_verb *spoken,
                         struct cli_option all[CLI_OPTIONS_MAX], const struct cli_render_asked *asked,
                         int argc, char **argv)
{
    *spoken = verb;
    if (asked) {
        const int own = asked->verb->option_count;
        memcpy(all, asked->verb->options, (size_t)own * sizeof *all);
        memcpy(all + own, options, sizeof options);
        spoken->name = asked->verb->name;
        spoken->operands = asked->verb->operands;
        spoken->options = all;
        spoken->option_count = own + verb.option_count;
    }
    cli_parser_start(parser, spoken, argc, argv);
    parser->helped = asked ? asked->verb : spoken;
}

bool cli_render_job_parse(struct cli_render_job *job, const struct cli_render_asked *asked, int argc,
                          char **argv, int *status)
{
    *job = (struct cli_render_job){.shadows = true,
                                   .ambient_occlusion = true,
                                   .format = CLI_PICTURE_UNKNOWN,
                                   .width = 1280,
                                   .height = 720,
                                   .samples = 4,
                                   .zoom = 1.0,
                                   .margin = -1.0,
                                   .supersample = 1,
                                   .interpolate = RHW_SMOOTH,
                                   .kinds = 1u << SCENE_KIND_COLOR,
                                   .isa = RHW_ISA_COUNT};
    struct cli_option all[CLI_OPTIONS_MAX];
    struct cli_verb spoken;
    struct cli_parser parser;
    start_parser(&parser, &spoken, all, asked, argc, argv);
    *status = CLI_USAGE;
    int id;
    while ((id = cli_parser_next(&parser)) > 0) {
        if (asked && id >= CLI_ASKED_OPTION ? !asked->take(asked->user, id, parser.argument)
                                            : !parse_option(job, id, parser.argument)) {
            return false;
        }
    }
    if (id == CLI_OPTION_STOP) {
        *status = parser.status;
        return false;
    }
    if (job->wants_template) {
        if (asked) {
            cli_error("--fragment-shader-template", "is an option of rhw render");
        }
        *status = asked ? CLI_USAGE : CLI_OK;
        return false;
    }
    if (!cli_parser_operands(&parser, 1, asked ? 1 : argc)) {
        return false;
    }
    job->model_paths = (const char *const *)parser.operands;
    job->model_count = parser.operand_count;
    job->model_path = job->model_paths[0];
    return cli_render_job_complete(job);
}
