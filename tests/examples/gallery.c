// SPDX-License-Identifier: MIT
// gallery COMMITTED DRAWN: whether two pictures, PNG or PPM, hold the same pixels. The pictures in examples/ are
// what the lessons draw today, on this machine too; files are not compared because zlib's output may change.
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <spng.h>

struct image {
    uint32_t width, height;
    uint8_t *rgb;
};

static bool read_png(FILE *file, struct image *image)
{
    struct spng_ihdr header;
    size_t size = 0;
    spng_ctx *png = spng_ctx_new(0);
    bool good = png && spng_set_png_file(png, file) == 0 && spng_get_ihdr(png, &header) == 0 &&
                spng_decoded_image_size(png, SPNG_FMT_RGB8, &size) == 0;
    if (good) {
        *image = (struct image){header.width, header.height, malloc(size)};
        good = image->rgb && spng_decode_image(png, image->rgb, size, SPNG_FMT_RGB8, 0) == 0;
    }
    spng_ctx_free(png);
    return good;
}

static bool read_ppm(FILE *file, struct image *image)
{
    if (fscanf(file, "P6 %u %u 255", &image->width, &image->height) != 2 || fgetc(file) == EOF ||
        image->width > 16384 || image->height > 16384) {
        return false;
    }
    const size_t size = (size_t)image->width * image->height * 3;
    image->rgb = malloc(size);
    return image->rgb && fread(image->rgb, 1, size, file) == size && fgetc(file) == EOF;
}

static bool read_image(const char *path, struct image *image)
{
    const char *suffix = strrchr(path, '.');
    FILE *file = fopen(path, "rb");
    const bool good = file && (suffix && strcmp(suffix, ".ppm") == 0 ? read_ppm : read_png)(file, image);
    if (file) {
        fclose(file);
    }
    if (!good) {
        fprintf(stderr, "%s: cannot be read\n", path);
    }
    return good;
}

static int compare(const struct image *a, const struct image *b)
{
    if (a->width != b->width || a->height != b->height) {
        fprintf(stderr, "%u x %u pixels against %u x %u\n", a->width, a->height, b->width, b->height);
        return 1;
    }
    size_t different = 0, first = 0;
    for (size_t i = (size_t)a->width * a->height; i-- > 0;) {
        if (memcmp(a->rgb + i * 3, b->rgb + i * 3, 3) != 0) {
            different++;
            first = i;
        }
    }
    if (different > 0) {
        fprintf(stderr, "%zu pixels differ, the first at %zu, %zu\n", different, first % a->width,
                first / a->width);
    }
    return different > 0;
}

int main(int argc, char **argv)
{
    struct image committed = {0}, drawn = {0};
    if (argc != 3) {
        fprintf(stderr, "usage: gallery COMMITTED DRAWN\n");
        return 2;
    }
    const bool good = read_image(argv[1], &committed) && read_image(argv[2], &drawn);
    const int status = good ? compare(&committed, &drawn) : 1;
    free(committed.rgb);
    free(drawn.rgb);
    return status;
}
