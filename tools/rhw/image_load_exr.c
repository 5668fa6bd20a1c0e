// SPDX-License-Identifier: MIT
// The channels of an EXR file, which import/image/exr.h reads, as those of a picture.
#include "image_load_exr.h"

#include <stdlib.h>
#include <string.h>

#include "import/image/exr.h"
#include "message.h"

_Static_assert((int)SCENE_EXR_CHANNELS_MAX == (int)CLI_IMAGE_CHANNELS_MAX &&
                   (int)SCENE_EXR_NAME_MAX == (int)CLI_CHANNEL_NAME_MAX,
               "a picture takes all channels");

static bool take_channels(struct cli_loaded_image *image, const struct scene_exr *exr)
{
    image->channels = calloc((size_t)exr->channel_count, sizeof *image->channels);
    if (image->channels == NULL) {
        return false;
    }
    image->width = exr->width;
    image->height = exr->height;
    image->channel_count = exr->channel_count;
    for (int i = 0; i < exr->channel_count; i++) {
        struct cli_image_channel *const channel = &image->channels[i];
        memcpy(channel->name, exr->channels[i].name, sizeof channel->name);
        channel->type = exr->channels[i].is_integer ? CLI_SAMPLE_U32 : CLI_SAMPLE_FLOAT;
        channel->first = exr->channels[i].plane;
        channel->pixel_stride = 4;
        channel->row_stride = 4 * (size_t)exr->width;
    }
    return true;
}

// The picture whose memory is allocated.
struct memory {
    struct cli_loaded_image *image;
    const char *path;
    bool told; // a line says why there is none
};

static void *allocate(void *user, size_t count, size_t size)
{
    struct memory *const memory = user;
    memory->told = !cli_image_allocate(memory->image, memory->path, count, size);
    return memory->image->memory;
}

bool cli_image_load_exr(struct cli_loaded_image *image, const char *path)
{
    struct scene_exr exr;
    struct memory memory = {image, path, false};
    const char *detail = NULL, *problem = scene_exr_read_file(path, allocate, &memory, &exr, &detail);
    if (problem == scene_exr_no_memory || (problem == NULL && !take_channels(image, &exr))) {
        problem = "out of memory";
    }
    exr.memory = NULL; // the picture has it
    scene_exr_free(&exr);
    if (memory.told) {
        return false;
    }
    if (detail != NULL) {
        cli_error(path, "%s: %s", problem, detail);
    } else if (problem != NULL) {
        cli_error(path, "%s", problem);
    }
    return problem == NULL;
}
