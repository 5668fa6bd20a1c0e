// SPDX-License-Identifier: MIT
// Stands in for peer_gles.c where the EGL and GLES headers are not installed.
#include "peer_gles.h"

struct peer *peer_open(const char *driver, const char **why)
{
    (void)driver;
    *why = "built without the EGL and GLES headers";
    return 0;
}

void peer_close(struct peer *peer)
{
    (void)peer;
}

const char *peer_name(const struct peer *peer)
{
    (void)peer;
    return "";
}

bool peer_can_draw(const struct scene *scene)
{
    (void)scene;
    return false;
}

const struct probe_image *peer_draw(struct peer *peer, const struct scene *scene)
{
    (void)peer;
    (void)scene;
    return 0;
}
