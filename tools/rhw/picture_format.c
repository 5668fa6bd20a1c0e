// SPDX-License-Identifier: MIT
// The format that a file's name asks for; see image_write.h.
#include "image_write.h"

#include <string.h>
#include <strings.h>

enum cli_picture_format cli_picture_format_of(const char *path)
{
    static const struct {
        const char *ending;
        enum cli_picture_format format;
    } endings[] = {{".png", CLI_PICTURE_PNG},  {".apng", CLI_PICTURE_PNG}, {".exr", CLI_PICTURE_EXR},
                   {".ppm", CLI_PICTURE_PPM},  {".jpg", CLI_PICTURE_JPEG}, {".jpeg", CLI_PICTURE_JPEG},
                   {".webp", CLI_PICTURE_WEBP}};
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        const size_t size = strlen(endings[i].ending);
        if (length > size && strcasecmp(path + length - size, endings[i].ending) == 0) {
            return endings[i].format;
        }
    }
    return CLI_PICTURE_UNKNOWN;
}
