// SPDX-License-Identifier: MIT
#include "thumb_name.h"

#include "message.h"
#include "model.h"

#include <stddef.h>
#include <string.h>
#include <strings.h>

// Signatures of PGP end in .asc, so that a cloud of points that does is left out.
bool cli_thumb_is_model(const char *name)
{
    static const char *const endings[] = {
        "glb",     "gltf", "vrm",   "obj",  "ply",     "stl",   "3mf",  "fbx", "dae",  "3ds",   "off",
        "amf",     "ac",   "acc",   "ase",  "b3d",     "blend", "bvh",  "cob", "coff", "cnoff", "dxf",
        "hmp",     "ifc",  "iqm",   "irr",  "irrmesh", "lwo",   "lws",  "lxo", "m3d",  "md2",   "md3",
        "md5mesh", "mdc",  "mdl",   "ms3d", "nff",     "noff",  "ogex", "pmx", "pts",  "q3o",   "q3s",
        "sib",     "smd",  "stoff", "uc",   "x",       "x3d",   "xgl",  "xyz", "zae",  "zgl"};
    const char *const dot = strrchr(name, '.');
    if (strcmp(name, "configure.ac") == 0) {
        return false; // a script of autoconf, and no model of AC3D
    }
    for (size_t i = 0; dot && dot > name && i < sizeof endings / sizeof *endings; i++) {
        if (strcasecmp(dot + 1, endings[i]) == 0) {
            return true;
        }
    }
    return false;
}

void cli_thumb_count_unread(struct cli_thumb_unread *unread, const char *name)
{
    const char *const format = scene_model_unread_format(name);
    int i = 0;
    while (format && i < unread->count && strcmp(unread->formats[i].format, format) != 0) {
        i++;
    }
    if (!format || i == (int)(sizeof unread->formats / sizeof *unread->formats)) {
        return;
    }
    unread->formats[i].format = format;
    unread->formats[i].files++;
    unread->count = i == unread->count ? i + 1 : unread->count;
}

void cli_thumb_tell_unread(const struct cli_thumb_unread *unread, const char *folder)
{
    for (int i = 0; i < unread->count; i++) {
        const int files = unread->formats[i].files;
        cli_warning(folder, "%d file%s left out: %s, which is not supported", files, files == 1 ? "" : "s",
                    unread->formats[i].format);
    }
}
