// SPDX-License-Identifier: MIT
// EXR decoder; see image_load.h. Reads files of one flat part, in scan lines or tiles (level 0), whatever
// the compression. Every channel becomes a plane of 4-byte samples: half widens to float without loss.
#include "image_load_exr.h"

#include "message.h"
#include "rhw/types.h"

#include <errno.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct decoder {
    exr_context_t context;
    exr_decode_pipeline_t pipeline;
    bool started; // the pipeline
    struct cli_loaded_image *image;
    exr_attr_box2i_t window;
};

static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context, (void)code, (void)message; // the result code comes back to the caller as well
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
    if (list->num_channels < 1 || list->num_channels > CLI_IMAGE_CHANNELS_MAX) {
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

static bool make_planes(struct decoder *decoder, const char *path, const exr_attr_chlist_t *list)
{
    struct cli_loaded_image *image = decoder->image;
    image->width = decoder->window.max.x - decoder->window.min.x + 1;
    image->height = decoder->window.max.y - decoder->window.min.y + 1;
    const size_t plane = (size_t)image->width * (size_t)image->height * 4;
    image->channels = calloc((size_t)list->num_channels, sizeof *image->channels);
    if (!image->channels) {
        cli_error(path, "out of memory");
        return false;
    }
    if (!cli_image_allocate(image, path, (size_t)list->num_channels, plane)) {
        return false;
    }
    image->channel_count = list->num_channels;
    for (int i = 0; i < list->num_channels; i++) {
        struct cli_image_channel *channel = &image->channels[i];
        snprintf(channel->name, sizeof channel->name, "%s", list->entries[i].name.str);
        channel->type = list->entries[i].pixel_type == EXR_PIXEL_UINT ? CLI_SAMPLE_U32 : CLI_SAMPLE_FLOAT;
        channel->first = (const uint8_t *)image->memory + (size_t)i * plane;
        channel->pixel_stride = 4;
        channel->row_stride = 4 * (size_t)image->width;
    }
    return true;
}

// Decodes one chunk to pixels `x`, `y` of the planes and on.
static exr_result_t decode_chunk(struct decoder *decoder, const exr_chunk_info_t *info, int x, int y)
{
    struct cli_loaded_image *image = decoder->image;
    exr_decode_pipeline_t *pipeline = &decoder->pipeline;
    exr_result_t result = decoder->started ? exr_decoding_update(decoder->context, 0, info, pipeline)
                                           : exr_decoding_initialize(decoder->context, 0, info, pipeline);
    if (result) {
        return result;
    }
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *target = &pipeline->channels[i];
        const int channel = cli_image_find_channel(image, target->channel_name);
        if (channel < 0 || x + target->width > image->width || y + target->height > image->height) {
            return EXR_ERR_CORRUPT_CHUNK;
        }
        const size_t offset =
            ((size_t)channel * (size_t)image->height + (size_t)y) * (size_t)image->width + (size_t)x;
        target->user_data_type =
            image->channels[channel].type == CLI_SAMPLE_U32 ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT;
        target->user_bytes_per_element = 4;
        target->user_pixel_stride = 4;
        target->user_line_stride = 4 * image->width;
        target->decode_to_ptr = (uint8_t *)image->memory + 4 * offset;
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
    for (int y = 0; !result && y < decoder->image->height; y += rows) {
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
    for (int y = 0; !result && y < decoder->image->height; y += height) {
        for (int x = 0; !result && x < decoder->image->width; x += width) {
            exr_chunk_info_t info;
            result = exr_read_tile_chunk_info(decoder->context, 0, x / width, y / height, 0, 0, &info);
            if (!result) {
                result = decode_chunk(decoder, &info, x, y);
            }
        }
    }
    return result;
}

// EXR_ERR_SUCCESS, or what is wrong with the file; after *told has become true a line says it.
static exr_result_t decode(struct decoder *decoder, const char *path, const char **unsupported, bool *told)
{
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = ignore_message;
    initializer.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION | EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE;
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
    if (!make_planes(decoder, path, list)) {
        *told = true;
        return EXR_ERR_OUT_OF_MEMORY;
    }
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    result = exr_get_storage(decoder->context, 0, &storage);
    if (result) {
        return result;
    }
    return storage == EXR_STORAGE_TILED ? decode_tiles(decoder) : decode_scan_lines(decoder);
}

bool cli_image_load_exr(struct cli_loaded_image *image, const char *path)
{
    struct decoder decoder = {.image = image, .pipeline = EXR_DECODE_PIPELINE_INITIALIZER};
    const char *unsupported = NULL;
    bool told = false;
    const exr_result_t result = decode(&decoder, path, &unsupported, &told);
    if (decoder.started) {
        exr_decoding_destroy(decoder.context, &decoder.pipeline);
    }
    if (decoder.context) {
        exr_finish(&decoder.context);
    }
    if (unsupported) {
        cli_error(path, "%s", unsupported);
    } else if (result == EXR_ERR_OUT_OF_MEMORY && !told) {
        cli_error(path, "out of memory");
    } else if (result && !told) {
        cli_error(path, "not a valid EXR file: %s", exr_get_default_error_message(result));
    }
    return result == EXR_ERR_SUCCESS;
}
