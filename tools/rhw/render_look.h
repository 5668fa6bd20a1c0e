// SPDX-License-Identifier: MIT
// Options of rhw render that say how a picture looks: its lights, its background, its lines.
#ifndef CLI_RENDER_LOOK_H
#define CLI_RENDER_LOOK_H

#include "render_job.h"

enum cli_look_option {
    CLI_LOOK_INTERPOLATE = 512, ///< beyond the other options of the verb
    CLI_LOOK_WIREFRAME,
    CLI_LOOK_BACKGROUND,
    CLI_LOOK_LIGHTS,
    CLI_LOOK_SHADOWS,
    CLI_LOOK_AMBIENT_OCCLUSION,
    CLI_LOOK_EXPOSURE,
    CLI_LOOK_ENVIRONMENT,
    CLI_LOOK_ENVIRONMENT_ROTATION,
    CLI_LOOK_TONE_MAP,
    CLI_LOOK_TRANSPARENCY,
    CLI_LOOK_GROUND
};

/// Sets what one of them says. False after a message.
bool cli_parse_look(struct cli_render_job *job, int id, const char *argument);

#endif
