// SPDX-License-Identifier: MIT
// The command line of rhw view: what is drawn is said by the options of rhw render, which reads them.
#ifndef VIEW_JOB_H
#define VIEW_JOB_H

#include "render_job.h"

enum {
    VIEW_TEXTURE_SIDE = RHW_MAX_TARGET_SIZE
}; ///< of textures, which are not reduced: one may come near to them

struct view_job {
    struct cli_render_job render;
    bool is_fullscreen;
    char **argv; ///< what `render` points into; free it
};

/// True to go on; else `*status` is what to return.
bool view_job_parse(struct view_job *job, int argc, char **argv, int *status);

#endif
