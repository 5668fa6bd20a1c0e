// SPDX-License-Identifier: MIT
// See process.h.
#include "process.h"

#include "file.h"
#include "rhw/rhw.h"
#include "subprocess.h"

#include <stdio.h>
#include <unistd.h>

bool bench_can_start_itself(void)
{
    return system_subprocess_can_restart();
}

bool bench_render_process(const char *model, int width, int height, int threads, enum rhw_isa isa)
{
    char folder[512], path[600], size[32], count[16];
    if (!system_folder_make_unnamed(folder, sizeof folder)) {
        return false;
    }
    snprintf(path, sizeof path, "%s/picture.png", folder);
    snprintf(size, sizeof size, "%dx%d", width, height);
    snprintf(count, sizeof count, "%d", threads);
    const char *const arguments[] = {
        "rhw",   "render",          model,     "-o", path, "--size", size, "--threads", count,
        "--isa", rhw_isa_name(isa), "--quiet", NULL};
    const int status = system_subprocess_restart(arguments);
    unlink(path);
    rmdir(folder);
    return status == 0;
}
