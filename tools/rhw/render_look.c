// SPDX-License-Identifier: MIT
#include "render_look.h"

#include "options.h"

#include <string.h>

static bool parse_background(struct cli_render_job *job, const char *argument)
{
    job->background = SCENE_BACKGROUND_COLOR;
    if (strcmp(argument, "transparent") == 0) {
        job->background = SCENE_BACKGROUND_TRANSPARENT;
    } else if (strcmp(argument, "environment") == 0) {
        job->background = SCENE_BACKGROUND_PANORAMA;
    } else if (strcmp(argument, "default") == 0) {
        job->background = SCENE_BACKGROUND_DEFAULT;
    } else if (!cli_parse_color(argument, job->background_color)) {
        cli_error("--background",
                  "'%s' is not a colour (rrggbb, rgb or a name as red), transparent, environment or default",
                  argument);
        return false;
    }
    return true;
}

static bool parse_switch(const char *option, const char *argument, bool *on)
{
    static const char *const names[] = {"on", "off"};
    const int choice = cli_choose(option, argument, names, 2);
    *on = choice == 0;
    return choice >= 0;
}

bool cli_parse_look(struct cli_render_job *job, int id, const char *argument)
{
    static const char *const
        qualifiers[] = {"smooth", "noperspective"},
        *const wireframes[] = {"over", "plain"}, *const lights[] = {"file", "default", "none"},
        *const transparencies[] = {"sorted", "exact"}, *const tones[] = {"neutral", "aces", "agx", "none"};
    int choice;
    switch (id) {
    case CLI_LOOK_INTERPOLATE:
        choice = cli_choose("--interpolate", argument, qualifiers, 2);
        job->interpolate = choice == 1 ? RHW_NOPERSPECTIVE : RHW_SMOOTH;
        return choice >= 0;
    case CLI_LOOK_WIREFRAME:
        choice = argument ? cli_choose("--wireframe", argument, wireframes, 2) : 0;
        job->wireframe = choice == 1 ? SCENE_WIREFRAME_PLAIN : SCENE_WIREFRAME_OVER;
        return choice >= 0;
    case CLI_LOOK_LIGHTS:
        choice = cli_choose("--lights", argument, lights, 3);
        job->default_lights = choice > 0;
        job->no_lights = choice == 2;
        return choice >= 0;
    case CLI_LOOK_TRANSPARENCY:
        choice = cli_choose("--transparency", argument, transparencies, 2);
        job->transparency = (enum scene_transparency)choice;
        return choice >= 0;
    case CLI_LOOK_GROUND: job->ground = true; return true;
    case CLI_LOOK_SHADOWS: return parse_switch("--shadows", argument, &job->shadows);
    case CLI_LOOK_AMBIENT_OCCLUSION:
        return parse_switch("--ambient-occlusion", argument, &job->ambient_occlusion);
    case CLI_LOOK_ENVIRONMENT: job->environment = argument; return true;
    case CLI_LOOK_ENVIRONMENT_ROTATION:
        if (cli_parse_float(argument, &job->environment_rotation)) {
            return true;
        }
        cli_error("--environment-rotation", "'%s' is not a number of degrees", argument);
        return false;
    case CLI_LOOK_TONE_MAP:
        choice = cli_choose("--tone-map", argument, tones, 4);
        job->tone = (enum scene_tone)choice;
        return choice >= 0;
    case CLI_LOOK_EXPOSURE:
        if (cli_parse_float(argument, &job->exposure) && job->exposure >= -20.0f && job->exposure <= 20.0f) {
            return true;
        }
        cli_error("--exposure", "'%s' is not a number of -20 to 20", argument);
        return false;
    default: return parse_background(job, argument);
    }
}
