// SPDX-License-Identifier: MIT
// Files that move, taken apart again: APNG into a PNG for each frame, which another decoder reads; WebP by libwebp. PNG
// beside those of libspng.
#include "moving_write.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <spng.h>
#include <webp/demux.h>

enum { WIDTH = 5, HEIGHT = 3, FRAMES = 4, MOST = 1 << 16 };

static const double rate = 29.97;

struct frame {
    int number, channels;
};

// Another value in every sample of every frame.
static void fill_row(const void *user, int y, void *row)
{
    const struct frame *const frame = user;
    uint8_t *const samples = row;
    for (int i = 0; i < WIDTH * frame->channels; i++) {
        samples[i] = (uint8_t)(frame->number * 61 + y * 23 + i * 7 + 1);
    }
}

static void set_frame(struct cli_raster *raster, const struct frame *frame)
{
    *raster = (struct cli_raster){.width = WIDTH,
                                  .height = HEIGHT,
                                  .channels = frame->channels,
                                  .bits = 8,
                                  .srgb = true,
                                  .row = fill_row,
                                  .user = frame};
}

static size_t make_movie(enum cli_picture_format format, int channels, int quality, uint8_t bytes[MOST])
{
    struct cli_output_file file = {.stream = tmpfile(), .path = "movie"};
    struct cli_moving movie;
    cli_moving_open(&movie, &file, format, FRAMES, rate, quality);
    assert_non_null(file.stream);
    for (int i = 0; i < FRAMES; i++) {
        const struct frame frame = {i, channels};
        struct cli_raster raster;
        set_frame(&raster, &frame);
        struct cli_moving_frame encoded;
        assert_true(cli_moving_encode(&movie, &raster, &encoded));
        assert_true(cli_moving_add(&movie, &raster, &encoded));
        cli_moving_forget(&encoded);
    }
    assert_true(cli_moving_finish(&movie));
    cli_moving_close(&movie);
    rewind(file.stream);
    const size_t size = fread(bytes, 1, MOST, file.stream);
    fclose(file.stream);
    return size;
}

static uint32_t load32(const uint8_t *b)
{
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static void store32(uint8_t *b, uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        b[i] = (uint8_t)(value >> (24 - 8 * i));
    }
}

// Bit by bit, as the specification defines it.
static uint32_t crc_of(const uint8_t *data, size_t size)
{
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < size * 8; i++) {
        const uint32_t bit = (crc ^ (uint32_t)data[i / 8] >> i % 8) & 1;
        crc = crc >> 1 ^ (bit ? 0xEDB88320u : 0);
    }
    return ~crc;
}

// A PNG that is put together from chunks.
struct png {
    uint8_t bytes[MOST];
    size_t size;
};

static void put_chunk(struct png *png, const char *type, const uint8_t *data, size_t size)
{
    uint8_t *const to = png->bytes + png->size;
    store32(to, (uint32_t)size);
    memcpy(to + 4, type, 4);
    memcpy(to + 8, data, size);
    store32(to + 8 + size, crc_of(to + 4, size + 4));
    png->size += size + 12;
}

static void check_picture(struct png *png, int number, int channels)
{
    const struct frame frame = {number, channels};
    put_chunk(png, "IEND", png->bytes, 0);
    spng_ctx *const context = spng_ctx_new(0);
    uint8_t pixels[HEIGHT][WIDTH * 4], expected[WIDTH * 4];
    const int format = channels == 4 ? SPNG_FMT_RGBA8 : SPNG_FMT_RGB8;
    const size_t row = (size_t)WIDTH * (size_t)channels;
    uint8_t packed[sizeof pixels];
    assert_int_equal(spng_set_png_buffer(context, png->bytes, png->size), 0);
    assert_int_equal(spng_decode_image(context, packed, row * HEIGHT, format, 0), 0);
    for (int y = 0; y < HEIGHT; y++) {
        fill_row(&frame, y, expected);
        assert_memory_equal(packed + (size_t)y * row, expected, row);
    }
    spng_ctx_free(context);
}

static void check_apng(const uint8_t *bytes, size_t size, int channels)
{
    static struct png png;
    uint32_t next = 0; // of the numbers in fcTL and fdAT
    int frame = -1;
    bool has_control = false;
    const size_t header = 8 + 12 + 13; // the signature and IHDR
    assert_memory_equal(bytes, "\x89PNG\r\n\x1a\n", 8);
    for (size_t at = 8; at < size;) {
        const uint32_t length = load32(bytes + at);
        const uint8_t *const type = bytes + at + 4, *const data = type + 4;
        assert_int_equal(load32(data + length), crc_of(type, length + 4));
        if (memcmp(type, "acTL", 4) == 0) {
            assert_int_equal(frame, -1); // before all data
            assert_int_equal(load32(data), FRAMES);
            assert_int_equal(load32(data + 4), 0);
            has_control = true;
        } else if (memcmp(type, "fcTL", 4) == 0) {
            if (frame >= 0) {
                check_picture(&png, frame, channels);
            }
            frame++;
            const uint8_t expected[22] = {0, 0, 0, WIDTH, 0, 0, 0, HEIGHT, 0,         0,
                                          0, 0, 0, 0,     0, 0, 0, 100,    2997 >> 8, 2997 & 255};
            assert_int_equal(length, 26);
            assert_int_equal(load32(data), next++);
            assert_memory_equal(data + 4, expected, sizeof expected);
            memcpy(png.bytes, bytes, header);
            png.size = header;
        } else if (memcmp(type, "IDAT", 4) == 0) {
            assert_int_equal(frame, 0);
            put_chunk(&png, "IDAT", data, length);
        } else if (memcmp(type, "fdAT", 4) == 0) {
            assert_true(frame > 0);
            assert_int_equal(load32(data), next++);
            put_chunk(&png, "IDAT", data + 4, length - 4);
        } else if (memcmp(type, "IEND", 4) == 0) {
            assert_int_equal(at + 12, size);
        }
        at += length + 12;
    }
    check_picture(&png, frame, channels);
    assert_true(has_control);
    assert_int_equal(frame, FRAMES - 1);
}

static void test_apng(void **state)
{
    (void)state;
    static uint8_t bytes[MOST];
    for (int channels = 3; channels <= 4; channels++) {
        check_apng(bytes, make_movie(CLI_PICTURE_PNG, channels, 0, bytes), channels);
    }
}

// The end of each frame in milliseconds.
static const int ends[FRAMES] = {33, 67, 100, 133};

static void test_webp(void **state)
{
    (void)state;
    static uint8_t bytes[MOST];
    for (int channels = 3; channels <= 4; channels++) {
        const WebPData data = {bytes, make_movie(CLI_PICTURE_WEBP, channels, 0, bytes)};
        WebPAnimDecoder *const decoder = WebPAnimDecoderNew(&data, NULL);
        WebPAnimInfo info;
        assert_non_null(decoder);
        assert_true(WebPAnimDecoderGetInfo(decoder, &info));
        assert_int_equal(info.frame_count, FRAMES);
        assert_int_equal(info.loop_count, 0);
        for (int frame = 0; frame < FRAMES; frame++) {
            const struct frame made = {frame, channels};
            uint8_t *pixels, expected[WIDTH * 4];
            int time;
            assert_true(WebPAnimDecoderGetNext(decoder, &pixels, &time));
            assert_int_equal(time, ends[frame]);
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                fill_row(&made, i / WIDTH, expected);
                assert_memory_equal(pixels + (size_t)i * 4, expected + i % WIDTH * channels,
                                    (size_t)channels);
            }
        }
        WebPAnimDecoderDelete(decoder);
    }
}

// With a quality it is lossy: another file, which decodes to something near.
static void test_lossy_webp(void **state)
{
    (void)state;
    static uint8_t bytes[MOST];
    const WebPData data = {bytes, make_movie(CLI_PICTURE_WEBP, 3, 50, bytes)};
    WebPDemuxer *const demuxer = WebPDemux(&data);
    WebPIterator frame;
    assert_non_null(demuxer);
    assert_true(WebPDemuxGetFrame(demuxer, 1, &frame));
    WebPBitstreamFeatures features;
    assert_int_equal(WebPGetFeatures(frame.fragment.bytes, frame.fragment.size, &features), VP8_STATUS_OK);
    assert_int_equal(features.format, 1); // lossy
    WebPDemuxReleaseIterator(&frame);
    WebPDemuxDelete(demuxer);
}

// Samples that pack somewhat.
static void fill_wave(const void *user, int y, void *row)
{
    const struct cli_raster *const raster = user;
    uint8_t *const bytes = row;
    for (int i = 0; i < raster->width * raster->channels * raster->bits / 8; i++) {
        bytes[i] = (uint8_t)(i * i / 64 + y * (i % 5));
    }
}

// Encode a raster by libspng alone. Return the bytes, to be freed.
static uint8_t *encode_by_spng(const struct cli_raster *raster, size_t *size)
{
    struct spng_ihdr header = {.width = (uint32_t)raster->width,
                               .height = (uint32_t)raster->height,
                               .bit_depth = (uint8_t)raster->bits,
                               .color_type = raster->channels == 1   ? SPNG_COLOR_TYPE_GRAYSCALE
                                             : raster->channels == 3 ? SPNG_COLOR_TYPE_TRUECOLOR
                                                                     : SPNG_COLOR_TYPE_TRUECOLOR_ALPHA};
    const size_t row = (size_t)raster->width * (size_t)raster->channels * (size_t)raster->bits / 8;
    uint8_t *const pixels = malloc(row * (size_t)raster->height);
    for (int y = 0; y < raster->height; y++) {
        fill_wave(raster, y, pixels + (size_t)y * row);
    }
    spng_ctx *const context = spng_ctx_new(SPNG_CTX_ENCODER);
    int error = 0;
    assert_int_equal(spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1), 0);
    assert_int_equal(spng_set_ihdr(context, &header), 0);
    assert_int_equal(spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, 2), 0);
    assert_int_equal(spng_set_option(context, SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_UP), 0);
    assert_int_equal(
        spng_encode_image(context, pixels, row * (size_t)raster->height, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE),
        0);
    uint8_t *const bytes = spng_get_png_buffer(context, size, &error);
    assert_non_null(bytes);
    spng_ctx_free(context);
    free(pixels);
    return bytes;
}

// The rows that are filtered and compressed here are those of libspng.
static void test_png(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1, 1}, {33, 17}, {1500, 40}, {7, 3000}}, channels[] = {1, 3, 4};
    for (int i = 0; i < 24; i++) {
        struct cli_raster raster = {.width = sizes[i % 4][0],
                                    .height = sizes[i % 4][1],
                                    .channels = channels[i / 4 % 3],
                                    .bits = i / 12 == 0 ? 8 : 16,
                                    .row = fill_wave};
        raster.user = &raster;
        struct cli_output_file file = {.stream = tmpfile(), .path = "picture"};
        assert_non_null(file.stream);
        assert_true(cli_png_write(&file, &raster));
        size_t size = 0;
        uint8_t *const expected = encode_by_spng(&raster, &size);
        uint8_t *const written = malloc(size + 1);
        rewind(file.stream);
        assert_int_equal(fread(written, 1, size + 1, file.stream), size);
        assert_memory_equal(written, expected, size);
        fclose(file.stream);
        free(written);
        free(expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_png), cmocka_unit_test(test_apng),
                                       cmocka_unit_test(test_webp), cmocka_unit_test(test_lossy_webp)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
