// SPDX-License-Identifier: MIT
// Files of one flat part are read, in scan lines or tiles (level 0), whatever the compression. Every channel becomes a
// plane of 4-byte samples: half widens to float without loss.
#include "exr.h"

#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A file in memory.
struct source {
    const unsigned char *bytes;
    size_t size;
};

struct decoder {
    exr_context_t context;
    exr_decode_pipeline_t pipeline;
    bool started;                // the pipeline
    const struct source *source; // NULL for a file on disk
    bool colors_alone;           // the channels R, G, B, A and Y are wanted, not all
    scene_exr_allocate *allocate;
    void *user; // what `allocate` is called with
    struct scene_exr *exr;
    exr_attr_box2i_t window;
};

static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context, (void)code, (void)message; // the result code comes back to the caller as well
}

static int64_t read_source(exr_const_context_t context, void *user, void *buffer, uint64_t size,
                           uint64_t offset, exr_stream_error_func_ptr_t report)
{
    (void)context, (void)report;
    const struct source *const source = user;
    const uint64_t left = offset < source->size ? source->size - offset : 0, got = size < left ? size : left;
    if (got > 0) {
        memcpy(buffer, source->bytes + offset, (size_t)got);
    }
    return (int64_t)got;
}

static int64_t size_of_source(exr_const_context_t context, void *user)
{
    (void)context;
    const struct source *const source = user;
    return (int64_t)source->size;
}

static const char *find_unsupported(const struct decoder *decoder, const exr_attr_chlist_t *list)
{
    int parts = 0;
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    exr_get_count(decoder->context, &parts);
    exr_get_storage(decoder->context, 0, &storage);
    if (parts != 1) {
        return "EXR files of several parts are not read";
    }
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED) {
        return "deep EXR files are not read";
    }
    if (list->num_channels < 1 || list->num_channels > SCENE_EXR_CHANNELS_MAX) {
        return "EXR files have 1 to 128 channels";
    }
    for (int i = 0; i < list->num_channels; i++) {
        if (list->entries[i].x_sampling != 1 || list->entries[i].y_sampling != 1) {
            return "subsampled EXR channels are not read";
        }
    }
    const int64_t width = (int64_t)decoder->window.max.x - decoder->window.min.x + 1;
    const int64_t height = (int64_t)decoder->window.max.y - decoder->window.min.y + 1;
    if (width < 1 || height < 1 || width > RHW_MAX_TARGET_SIZE || height > RHW_MAX_TARGET_SIZE) {
        return "larger than 16384 pixels";
    }
    return NULL;
}

static bool is_wanted(const struct decoder *decoder, const char *name)
{
    return !decoder->colors_alone || (strlen(name) == 1 && strchr("RGBAY", name[0]) != NULL);
}

static bool make_planes(struct decoder *decoder, const exr_attr_chlist_t *list)
{
    struct scene_exr *exr = decoder->exr;
    exr->width = decoder->window.max.x - decoder->window.min.x + 1;
    exr->height = decoder->window.max.y - decoder->window.min.y + 1;
    const size_t plane = (size_t)exr->width * (size_t)exr->height * 4;
    size_t wanted = 0;
    for (int i = 0; i < list->num_channels; i++) {
        wanted += is_wanted(decoder, list->entries[i].name.str);
    }
    exr->channels = calloc((size_t)list->num_channels, sizeof *exr->channels);
    // Chunks may be missing from the file, so the memory is zeroed.
    exr->memory = exr->channels ? decoder->allocate(decoder->user, wanted > 0 ? wanted : 1, plane) : NULL;
    if (!exr->memory) {
        return false;
    }
    exr->channel_count = list->num_channels;
    const uint8_t *next = exr->memory;
    for (int i = 0; i < list->num_channels; i++) {
        struct scene_exr_channel *channel = &exr->channels[i];
        snprintf(channel->name, sizeof channel->name, "%s", list->entries[i].name.str);
        channel->is_integer = list->entries[i].pixel_type == EXR_PIXEL_UINT;
        if (is_wanted(decoder, list->entries[i].name.str)) {
            channel->plane = next;
            next += plane;
        }
    }
    return true;
}

static const struct scene_exr_channel *find_channel(const struct scene_exr *exr, const char *name)
{
    for (int i = 0; i < exr->channel_count; i++) {
        if (strcmp(exr->channels[i].name, name) == 0) {
            return &exr->channels[i];
        }
    }
    return NULL;
}

// Decode one chunk to pixels `x`, `y` of the planes and on.
static exr_result_t decode_chunk(struct decoder *decoder, const exr_chunk_info_t *info, int x, int y)
{
    struct scene_exr *exr = decoder->exr;
    exr_decode_pipeline_t *pipeline = &decoder->pipeline;
    exr_result_t result = decoder->started ? exr_decoding_update(decoder->context, 0, info, pipeline)
                                           : exr_decoding_initialize(decoder->context, 0, info, pipeline);
    if (result) {
        return result;
    }
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *target = &pipeline->channels[i];
        const struct scene_exr_channel *channel = find_channel(exr, target->channel_name);
        if (channel == NULL || x + target->width > exr->width || y + target->height > exr->height) {
            return EXR_ERR_CORRUPT_CHUNK;
        }
        if (channel->plane == NULL) {
            target->decode_to_ptr = NULL;
            continue;
        }
        const size_t plane = (size_t)(channel->plane - (const uint8_t *)exr->memory);
        const size_t offset = (size_t)y * (size_t)exr->width + (size_t)x;
        target->user_data_type = channel->is_integer ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        target->user_bytes_per_element = 4;
        target->user_pixel_stride = 4;
        target->user_line_stride = 4 * exr->width;
        target->decode_to_ptr = (uint8_t *)exr->memory + plane + 4 * offset;
    }
    if (!decoder->started) {
        result = exr_decoding_choose_default_routines(decoder->context, 0, pipeline);
    }
    decoder->started = true;
    return result ? result : exr_decoding_run(decoder->context, 0, pipeline);
}

static exr_result_t decode_scan_lines(struct decoder *decoder)
{
    int rows = 1;
    exr_result_t result = exr_get_scanlines_per_chunk(decoder->context, 0, &rows);
    for (int y = 0; !result && y < decoder->exr->height; y += rows) {
        exr_chunk_info_t info;
        result = exr_read_scanline_chunk_info(decoder->context, 0, decoder->window.min.y + y, &info);
        if (!result) {
            result = decode_chunk(decoder, &info, 0, y);
        }
    }
    return result;
}

static exr_result_t decode_tiles(struct decoder *decoder)
{
    int width = 0, height = 0;
    exr_result_t result = exr_get_tile_sizes(decoder->context, 0, 0, 0, &width, &height);
    if (!result && (width < 1 || height < 1)) {
        result = EXR_ERR_INVALID_ATTR;
    }
    for (int y = 0; !result && y < decoder->exr->height; y += height) {
        for (int x = 0; !result && x < decoder->exr->width; x += width) {
            exr_chunk_info_t info;
            result = exr_read_tile_chunk_info(decoder->context, 0, x / width, y / height, 0, 0, &info);
            if (!result) {
                result = decode_chunk(decoder, &info, x, y);
            }
        }
    }
    return result;
}

static exr_result_t decode(struct decoder *decoder, const char *path, const char **unsupported)
{
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = ignore_message;
    initializer.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION | EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE;
    if (decoder->source != NULL) {
        initializer.user_data = (void *)(uintptr_t)decoder->source; // it is only read
        initializer.read_fn = read_source;
        initializer.size_fn = size_of_source;
    }
    exr_result_t result = exr_start_read(&decoder->context, path, &initializer);
    const exr_attr_chlist_t *list = NULL;
    if (!result) {
        result = exr_get_data_window(decoder->context, 0, &decoder->window);
    }
    if (!result) {
        result = exr_get_channels(decoder->context, 0, &list);
    }
    if (result) {
        return result;
    }
    *unsupported = find_unsupported(decoder, list);
    if (*unsupported) {
        return EXR_ERR_FEATURE_NOT_IMPLEMENTED;
    }
    if (!make_planes(decoder, list)) {
        return EXR_ERR_OUT_OF_MEMORY;
    }
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    result = exr_get_storage(decoder->context, 0, &storage);
    if (result) {
        return result;
    }
    return storage == EXR_STORAGE_TILED ? decode_tiles(decoder) : decode_scan_lines(decoder);
}

const char scene_exr_no_memory[] = "outofmem"; // the words of stb_image
static const char invalid[] = "not a valid EXR file";

static const char *read_exr(struct decoder *decoder, const char *path, const char **detail)
{
    const char *unsupported = NULL;
    decoder->pipeline = (exr_decode_pipeline_t)EXR_DECODE_PIPELINE_INITIALIZER;
    *decoder->exr = (struct scene_exr){0};
    const exr_result_t result = decode(decoder, path, &unsupported);
    if (decoder->started) {
        exr_decoding_destroy(decoder->context, &decoder->pipeline);
    }
    if (decoder->context) {
        exr_finish(&decoder->context);
    }
    if (unsupported != NULL || result == EXR_ERR_SUCCESS) {
        return unsupported;
    }
    if (result == EXR_ERR_OUT_OF_MEMORY) {
        return scene_exr_no_memory;
    }
    *detail = exr_get_default_error_message(result);
    return invalid;
}

const char *scene_exr_read_file(const char *path, scene_exr_allocate *allocate, void *user,
                                struct scene_exr *exr, const char **detail)
{
    struct decoder decoder = {.allocate = allocate, .user = user, .exr = exr};
    return read_exr(&decoder, path, detail);
}

void scene_exr_free(struct scene_exr *exr)
{
    free(exr->channels);
    free(exr->memory);
    *exr = (struct scene_exr){0};
}

// Write a channel of all texels. One that the file has not is `otherwise` everywhere.
static void put_channel(const struct scene_exr *exr, const struct scene_exr_channel *channel, float otherwise,
                        float *texels)
{
    const size_t count = (size_t)exr->width * (size_t)exr->height;
    for (size_t i = 0; i < count; i++) {
        float value = otherwise;
        if (channel != NULL && channel->is_integer) {
            uint32_t integer;
            memcpy(&integer, channel->plane + 4 * i, sizeof integer);
            value = (float)integer;
        } else if (channel != NULL) {
            memcpy(&value, channel->plane + 4 * i, sizeof value);
        }
        texels[4 * i] = value;
    }
}

static const char *put_colors(const struct scene_exr *exr, struct scene_image *image)
{
    static const char *const names[4] = {"R", "G", "B", "A"};
    const struct scene_exr_channel *const grey = find_channel(exr, "Y"), *channels[4];
    bool colored = false;
    for (int c = 0; c < 4; c++) {
        channels[c] = find_channel(exr, names[c]);
        colored = colored || (c < 3 && channels[c] != NULL);
    }
    if (!colored && grey == NULL) {
        return "an EXR file without the channels R, G and B, or Y";
    }
    image->type = SCENE_IMAGE_RGBA32F;
    image->width = (uint32_t)exr->width;
    image->height = (uint32_t)exr->height;
    image->size = (size_t)image->width * image->height * 4 * sizeof(float);
    image->texels = malloc(image->size);
    if (image->texels == NULL) {
        return scene_exr_no_memory;
    }
    for (int c = 0; c < 4; c++) {
        put_channel(exr, c < 3 && !colored ? grey : channels[c], c == 3 ? 1 : 0, (float *)image->texels + c);
    }
    return NULL;
}

static void *allocate_plainly(void *user, size_t count, size_t size)
{
    (void)user;
    return calloc(count, size);
}

const char *scene_image_decode_exr(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    const struct source source = {bytes, size};
    struct scene_exr exr;
    struct decoder decoder = {
        .source = &source, .colors_alone = true, .allocate = allocate_plainly, .exr = &exr};
    struct scene_image made = *image;
    const char *detail = NULL, *problem = read_exr(&decoder, "texture", &detail);
    if (problem == NULL) {
        problem = put_colors(&exr, &made);
    }
    scene_exr_free(&exr);
    if (problem == NULL) {
        *image = made;
    }
    return problem;
}
