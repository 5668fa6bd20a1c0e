// SPDX-License-Identifier: MIT
// EXR encoder; see image_write.h. Compression costs far more than everything else (some 20 float channels
// are 80 bytes per pixel), so threads take chunks of 16 rows each. A chunk waits for its turn before it is
// written: the file is the same whatever the number of threads.
#include "image_write.h"

#include "memory_file.h"
#include "message.h"

#include <errno.h>
#include <openexr.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

// Measured on all outputs of a 1280×960 picture of a machine: level 2 takes three quarters of the time of
// level 4, OpenEXR's default, for a file that is 2% larger; level 1 is no faster.
enum { ZIP_LEVEL = 2, THREADS_MAX = 64 };

struct encoder {
    exr_context_t context;
    struct cli_output_file *file;
    uint64_t position; // bytes, of the stream
    int width, height, rows_per_chunk;
    const struct cli_exr_channel *channels;
    int channel_count;
    const struct cli_exr_about *about; // or NULL
    exr_result_t (*write_chunk)(exr_encode_pipeline_t *pipeline);

    pthread_mutex_t mutex; // guards what follows
    pthread_cond_t turn;
    int next_to_take, next_to_write; // chunks
    exr_result_t result;             // the first failure
    int cause;                       // errno of a failed write, or 0
    bool gave_up;
};

static void ignore_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)context, (void)code, (void)message; // the result code comes back to the caller as well
}

// OpenEXRCore writes from front to back, and at the end once more into the table of chunk offsets.
static int64_t write_at(exr_const_context_t context, void *user, const void *data, uint64_t size,
                        uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    struct encoder *encoder = user;
    FILE *stream = encoder->file->stream;
    const bool placed = offset == encoder->position || fseeko(stream, (off_t)offset, SEEK_SET) == 0;
    if (!placed || fwrite(data, 1, size, stream) != size) {
        encoder->cause = errno;
        fail(context, EXR_ERR_WRITE_IO, "write failed");
        return -1;
    }
    encoder->position = offset + size;
    return (int64_t)size;
}

static exr_result_t wait_for_turn(exr_encode_pipeline_t *pipeline)
{
    struct encoder *encoder = pipeline->encoding_user_data;
    const int chunk = pipeline->chunk.start_y / encoder->rows_per_chunk;
    pthread_mutex_lock(&encoder->mutex);
    while (encoder->next_to_write != chunk && !encoder->result) {
        pthread_cond_wait(&encoder->turn, &encoder->mutex);
    }
    const exr_result_t result = encoder->result;
    pthread_mutex_unlock(&encoder->mutex);
    return result;
}

static exr_result_t write_in_turn(exr_encode_pipeline_t *pipeline)
{
    struct encoder *encoder = pipeline->encoding_user_data;
    const exr_result_t result = encoder->write_chunk(pipeline);
    pthread_mutex_lock(&encoder->mutex);
    encoder->next_to_write++;
    pthread_cond_broadcast(&encoder->turn);
    pthread_mutex_unlock(&encoder->mutex);
    return result;
}

static const struct cli_exr_channel *find_channel(const struct encoder *encoder, const char *name)
{
    for (int i = 0; i < encoder->channel_count; i++) {
        if (strcmp(encoder->channels[i].name, name) == 0) {
            return &encoder->channels[i];
        }
    }
    return NULL;
}

static exr_result_t prepare_chunk(struct encoder *encoder, exr_encode_pipeline_t *pipeline, int y, bool first)
{
    exr_chunk_info_t info;
    exr_result_t result = exr_write_scanline_chunk_info(encoder->context, 0, y, &info);
    if (!result && first) {
        result = exr_encoding_initialize(encoder->context, 0, &info, pipeline);
    } else if (!result) {
        result = exr_encoding_update(encoder->context, 0, &info, pipeline);
    }
    for (int i = 0; !result && i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *target = &pipeline->channels[i];
        const struct cli_exr_channel *source = find_channel(encoder, target->channel_name);
        target->user_pixel_stride = source->pixel_stride;
        target->user_line_stride = source->pixel_stride * encoder->width;
        target->encode_from_ptr =
            (const uint8_t *)source->first + (size_t)y * (size_t)target->user_line_stride;
    }
    if (!result && first) {
        result = exr_encoding_choose_default_routines(encoder->context, 0, pipeline);
        encoder->write_chunk = pipeline->write_fn; // the same for every thread
        pipeline->write_fn = write_in_turn;
        pipeline->yield_until_ready_fn = wait_for_turn;
        pipeline->encoding_user_data = encoder;
    }
    return result;
}

// The caller's thread asks the file; the others end when that gave up. Chunks that were taken are written.
static int take_chunk(struct encoder *encoder, bool is_caller)
{
    const bool gives_up = is_caller && !cli_output_file_goes_on(encoder->file);
    pthread_mutex_lock(&encoder->mutex);
    encoder->gave_up |= gives_up;
    const bool left = !encoder->result && !encoder->gave_up &&
                      encoder->next_to_take * encoder->rows_per_chunk < encoder->height;
    const int chunk = left ? encoder->next_to_take++ : -1;
    pthread_mutex_unlock(&encoder->mutex);
    return chunk;
}

static void encode_chunks(struct encoder *encoder, bool is_caller)
{
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t result = EXR_ERR_SUCCESS;
    bool first = true;
    for (int chunk; !result && (chunk = take_chunk(encoder, is_caller)) >= 0; first = false) {
        result = prepare_chunk(encoder, &pipeline, chunk * encoder->rows_per_chunk, first);
        if (!result) {
            result = exr_encoding_run(encoder->context, 0, &pipeline);
        }
    }
    if (result) {
        pthread_mutex_lock(&encoder->mutex);
        encoder->result = encoder->result ? encoder->result : result;
        pthread_cond_broadcast(&encoder->turn);
        pthread_mutex_unlock(&encoder->mutex);
    }
    if (!first) {
        exr_encoding_destroy(encoder->context, &pipeline);
    }
}

static void *help(void *encoder)
{
    encode_chunks(encoder, false);
    return NULL;
}

// The file's matrices are for row vectors and row major: the same order.
static exr_result_t set_matrix(const struct encoder *encoder, int part, const char *name,
                               const double matrix[16])
{
    exr_attr_m44f_t value;
    for (int i = 0; i < 16; i++) {
        value.m[i] = (float)matrix[i];
    }
    return exr_attr_set_m44f(encoder->context, part, name, &value);
}

static exr_result_t set_origin(const struct encoder *encoder, int part)
{
    const struct cli_exr_about *const about = encoder->about;
    const exr_attr_v3d_t origin = {.x = about->origin[0], .y = about->origin[1], .z = about->origin[2]};
    return exr_attr_set_v3d(encoder->context, part, "origin", &origin);
}

// Write the camera for the coordinates of the file and, far from its origin, for what is counted from the model's.
static exr_result_t set_camera(const struct encoder *encoder, int part)
{
    const struct cli_exr_about *const about = encoder->about;
    exr_result_t result = set_matrix(encoder, part, "worldToCamera", about->world_to_camera);
    if (!result) {
        result = set_matrix(encoder, part, "worldToNDC", about->world_to_ndc);
    }
    if (!result && about->is_far) {
        result = set_matrix(encoder, part, "originToCamera", about->origin_to_camera);
    }
    if (!result && about->is_far) {
        result = set_matrix(encoder, part, "originToNDC", about->origin_to_ndc);
    }
    return result;
}

static exr_result_t set_about(const struct encoder *encoder, int part)
{
    const struct cli_exr_about *const about = encoder->about;
    exr_result_t result = about->has_camera ? set_camera(encoder, part) : EXR_ERR_SUCCESS;
    if (!result && about->is_far) {
        result = set_origin(encoder, part);
    }
    if (!result && about->object_count > 0) {
        result = exr_attr_set_string_vector(encoder->context, part, "objectNames", about->object_count,
                                            about->objects);
    }
    return result;
}

static exr_result_t write_header(struct encoder *encoder)
{
    int part;
    exr_result_t result = exr_add_part(encoder->context, "", EXR_STORAGE_SCANLINE, &part);
    if (!result) {
        result = exr_initialize_required_attr_simple(encoder->context, part, encoder->width, encoder->height,
                                                     EXR_COMPRESSION_ZIP);
    }
    if (!result) {
        result = exr_set_zip_compression_level(encoder->context, part, ZIP_LEVEL);
    }
    for (int i = 0; !result && i < encoder->channel_count; i++) {
        const struct cli_exr_channel *channel = &encoder->channels[i];
        result = exr_add_channel(encoder->context, part, channel->name,
                                 channel->integer ? EXR_PIXEL_UINT : EXR_PIXEL_FLOAT,
                                 EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    }
    if (!result) {
        result = set_about(encoder, part);
    }
    if (!result) {
        result = exr_write_header(encoder->context);
    }
    if (!result) {
        result = exr_get_scanlines_per_chunk(encoder->context, part, &encoder->rows_per_chunk);
    }
    return result;
}

// Threads that cannot be had are done without: this one does all the work in the end.
static void encode_on_threads(struct encoder *encoder, int threads)
{
    pthread_t workers[THREADS_MAX];
    int started = 0;
    while (started < threads - 1 && started < THREADS_MAX &&
           pthread_create(&workers[started], NULL, help, encoder) == 0) {
        started++;
    }
    encode_chunks(encoder, true);
    for (int i = 0; i < started; i++) {
        pthread_join(workers[i], NULL);
    }
}

static bool encode(struct cli_output_file *file, struct encoder *encoder, int threads)
{
    encoder->file = file;
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    initializer.error_handler_fn = ignore_message;
    initializer.user_data = encoder;
    initializer.write_fn = write_at;
    encoder->result = exr_start_write(&encoder->context, file->path, EXR_WRITE_FILE_DIRECTLY, &initializer);
    if (!encoder->result) {
        encoder->result = write_header(encoder);
    }
    if (!encoder->result) {
        encode_on_threads(encoder, threads);
    }
    if (encoder->context) {
        const exr_result_t finished = exr_finish(&encoder->context);
        encoder->result = encoder->result ? encoder->result : finished;
    }
    if (encoder->result && !encoder->gave_up) {
        cli_error(file->path, "cannot be written: %s",
                  encoder->cause ? strerror(encoder->cause) : exr_get_default_error_message(encoder->result));
    }
    return encoder->result == EXR_ERR_SUCCESS && !encoder->gave_up;
}

static bool copy(FILE *from, struct cli_output_file *to)
{
    char buffer[1 << 16];
    size_t count = 1;
    bool copied = fflush(from) == 0 && fseek(from, 0, SEEK_SET) == 0;
    while (copied && cli_output_file_goes_on(to) && (count = fread(buffer, 1, sizeof buffer, from)) > 0) {
        copied = fwrite(buffer, 1, count, to->stream) == count;
    }
    if (!copied || ferror(from)) {
        cli_error(to->path, "cannot be written: %s", strerror(errno));
        return false;
    }
    return count == 0;
}

bool cli_exr_write(struct cli_output_file *file, int width, int height,
                   const struct cli_exr_channel *channels, int channel_count,
                   const struct cli_exr_about *about, int threads)
{
    struct encoder encoder = {.width = width,
                              .height = height,
                              .channels = channels,
                              .channel_count = channel_count,
                              .about = about,
                              .mutex = PTHREAD_MUTEX_INITIALIZER,
                              .turn = PTHREAD_COND_INITIALIZER};
    if (file->seekable) {
        return encode(file, &encoder, threads);
    }
    // The table of its chunks stands at the front of an EXR: a pipe gets it from a file in memory.
    struct system_memory_file seekable;
    if (!system_memory_file_open(&seekable, "rhw-exr")) {
        cli_error(file->path, "cannot be written: %s", strerror(errno));
        return false;
    }
    struct cli_output_file memory = {.stream = seekable.stream,
                                     .path = file->path,
                                     .seekable = true,
                                     .goes_on = file->goes_on,
                                     .user = file->user};
    const bool written = encode(&memory, &encoder, threads) && copy(memory.stream, file);
    system_memory_file_close(&seekable);
    return written;
}
