// SPDX-License-Identifier: MIT
// Stands in for renderer_gles.c where the EGL and GLES headers are not installed.
#include "renderer.h"

bool bench_open_gles(struct bench_renderer *renderer, const char *driver, const char **why)
{
    (void)renderer, (void)driver;
    *why = "built without the EGL and GLES headers";
    return false;
}
