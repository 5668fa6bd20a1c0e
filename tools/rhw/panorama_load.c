// SPDX-License-Identifier: MIT
#include "panorama_load.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image_load.h"
#include "import/builder/import.h"
#include "import/image/read.h"
#include "import/image/signature.h"
#include "message.h"

static const float most_light = 60000.0f;

static bool allocate(struct scene_panorama *p, const char *path)
{
    p->texels = malloc((size_t)p->width * (size_t)p->height * sizeof *p->texels);
    if (p->texels == NULL) {
        cli_error(path, "out of memory");
    }
    return p->texels != NULL;
}

void cli_panorama_clean(struct scene_panorama *p)
{
    for (size_t i = 0; i < (size_t)p->width * (size_t)p->height; i++) {
        for (int c = 0; c < 3; c++) {
            const float light = p->texels[i][c];
            p->texels[i][c] = light > most_light ? most_light : light > 0.0f ? light : 0.0f; // NaN: 0
        }
        p->texels[i][3] = 1.0f;
    }
}

static void *read_all(FILE *stream, size_t *size)
{
    unsigned char *bytes = NULL;
    size_t room = 0, got = 1;
    for (*size = 0; got > 0; *size += got) {
        if (*size == room) {
            room = room ? 2 * room : 1 << 20;
            unsigned char *larger = realloc(bytes, room);
            if (larger == NULL) {
                free(bytes);
                return NULL;
            }
            bytes = larger;
        }
        got = fread(bytes + *size, 1, room - *size, stream);
    }
    return bytes;
}

static const char not_of_light[] =
    "an environment must be a Radiance HDR or an OpenEXR picture, or a TIFF, DDS or KTX2 of "
    "floats";

// Load what textures of floats are read from.
static bool load_image(struct scene_panorama *p, const char *path, FILE *stream)
{
    size_t size;
    struct scene_image image = {0};
    void *bytes = read_all(stream, &size);
    const char *problem = bytes ? scene_image_decode(bytes, size, &image) : "out of memory";
    free(bytes);
    if (problem == NULL && image.type != SCENE_IMAGE_RGBA32F) {
        free(image.texels);
        problem = not_of_light;
    }
    if (problem != NULL) {
        cli_error(path, "%s", problem);
        return false;
    }
    *p = (struct scene_panorama){(int)image.width, (int)image.height, image.texels};
    return true;
}

static bool load_exr(struct scene_panorama *p, const char *path)
{
    static const char *const names[3] = {"R", "G", "B"};
    struct cli_loaded_image image;
    int channels[3];
    if (!cli_image_load(&image, path, CLI_IMAGE_MOST)) {
        return false;
    }
    *p = (struct scene_panorama){image.width, image.height, NULL};
    double *row = malloc((size_t)image.width * sizeof *row);
    bool ok = row != NULL && allocate(p, path);
    for (int c = 0; c < 3 && ok; c++) {
        channels[c] = cli_image_find_channel(&image, names[c]);
        if (channels[c] < 0) {
            cli_error(path, "an environment must have the channels R, G and B");
            ok = false;
        }
        for (int y = 0; y < image.height && ok; y++) {
            cli_image_row(&image, channels[c], y, row);
            for (int x = 0; x < image.width; x++) {
                p->texels[(size_t)y * (size_t)image.width + (size_t)x][c] = (float)row[x];
            }
        }
    }
    free(row);
    cli_image_unload(&image);
    if (!ok) {
        free(p->texels);
        p->texels = NULL;
    }
    return ok;
}

// Load a file that begins with `size` bytes at `start`, and zeros.
static bool load_kind(struct scene_panorama *p, const char *path, FILE *stream, const char *start,
                      size_t size)
{
    const char *refusal = NULL;
    const enum scene_image_format format = scene_image_format((const unsigned char *)start, size, &refusal);
    if (format == SCENE_FORMAT_EXR) {
        return load_exr(p, path);
    }
    if (memcmp(start, "#?", 2) == 0 || format == SCENE_FORMAT_TIFF || format == SCENE_FORMAT_DDS ||
        format == SCENE_FORMAT_KTX2) {
        rewind(stream);
        return load_image(p, path, stream);
    }
    cli_error(path, "%s", not_of_light);
    return false;
}

bool cli_panorama_load(struct scene_panorama *panorama, const char *path)
{
    enum { LOOKED_AT = 1024 }; // a pointer of Git LFS is shorter
    char start[LOOKED_AT + 1] = "";
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) {
        cli_error(path, "cannot be opened: %s", strerror(errno));
        return false;
    }
    bool loaded = false;
    const size_t got = fread(start, 1, LOOKED_AT, stream);
    const char *pointer = scene_import_pointer_problem(start, got);
    if (ferror(stream)) {
        cli_error(path, "%s", strerror(errno));
    } else if (got == 0) {
        cli_error(path, "the file is empty");
    } else if (pointer != NULL) {
        cli_error(path, "%s", pointer);
    } else {
        loaded = load_kind(panorama, path, stream, start, got);
    }
    fclose(stream);
    if (loaded) {
        cli_panorama_clean(panorama);
    }
    return loaded;
}
