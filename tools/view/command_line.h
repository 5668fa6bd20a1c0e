// SPDX-License-Identifier: MIT
// The command line of rhw render that draws what a job says.
#ifndef VIEW_COMMAND_LINE_H
#define VIEW_COMMAND_LINE_H

#include "render_job.h"

/// For a shell, without an end of line; free it. NULL without memory. Of what rhw view can show: one model, a camera of
/// ten numbers, one output.
char *view_command_line(const struct cli_render_job *job);

#endif
