// SPDX-License-Identifier: MIT
// The picture is read row by row into a canvas that is transparent where the picture is not.
#include "gif.h"

#include <gif_lib.h>
#include <stdlib.h>
#include <string.h>

static const char damaged[] = "damaged GIF";

// The file in memory.
struct source {
    const unsigned char *bytes;
    size_t size, at;
};

static int read_source(GifFileType *gif, GifByteType *buffer, int count)
{
    struct source *const source = gif->UserData;
    const size_t left = source->size - source->at;
    const size_t got = count < 0 ? 0 : left < (size_t)count ? left : (size_t)count;
    if (got > 0) {
        memcpy(buffer, source->bytes + source->at, got);
        source->at += got;
    }
    return (int)got;
}

bool scene_gif_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    if (size < 10) {
        return false;
    }
    *width = bytes[6] | (uint32_t)bytes[7] << 8;
    *height = bytes[8] | (uint32_t)bytes[9] << 8;
    return true;
}

// Read an extension. Set the number of the colour that is transparent, if the extension says it.
static bool read_extension(GifFileType *gif, int *transparent)
{
    int code = 0;
    GifByteType *block = NULL; // its first byte is the number of those behind it
    GraphicsControlBlock control;
    bool fine = DGifGetExtension(gif, &code, &block) == GIF_OK;
    while (fine && block != NULL) {
        if (code == GRAPHICS_EXT_FUNC_CODE &&
            DGifExtensionToGCB((size_t)block[0], block + 1, &control) == GIF_OK) {
            *transparent = control.TransparentColor;
        }
        fine = DGifGetExtensionNext(gif, &block) == GIF_OK;
    }
    return fine;
}

// Go to the first picture.
static bool find_picture(GifFileType *gif, int *transparent)
{
    GifRecordType type = UNDEFINED_RECORD_TYPE;
    while (DGifGetRecordType(gif, &type) == GIF_OK && type == EXTENSION_RECORD_TYPE) {
        if (!read_extension(gif, transparent)) {
            return false;
        }
    }
    return type == IMAGE_DESC_RECORD_TYPE && DGifGetImageDesc(gif) == GIF_OK;
}

// Write a row of numbers of colours.
static bool put_row(const GifPixelType *row, int count, const ColorMapObject *colors, int transparent,
                    uint8_t (*texels)[4])
{
    for (int x = 0; x < count; x++) {
        if (row[x] >= colors->ColorCount) {
            return false;
        }
        const GifColorType color = colors->Colors[row[x]];
        const uint8_t alpha = row[x] == transparent ? 0 : UINT8_MAX;
        const uint8_t texel[4] = {color.Red, color.Green, color.Blue, alpha};
        memcpy(texels[x], texel, sizeof texel);
    }
    return true;
}

static const char *read_picture(GifFileType *gif, int transparent, struct scene_image *image)
{
    // Interlaced rows come in four turns (GIF89a, appendix E). Others come in one.
    static const int starts[5] = {0, 4, 2, 1, 0}, steps[5] = {8, 8, 4, 2, 1};
    const GifImageDesc *const place = &gif->Image;
    const ColorMapObject *const colors = place->ColorMap != NULL ? place->ColorMap : gif->SColorMap;
    if (colors == NULL || place->Left < 0 || place->Top < 0 || place->Width < 1 || place->Height < 1 ||
        place->Left + place->Width > (int)image->width || place->Top + place->Height > (int)image->height) {
        return damaged;
    }
    GifPixelType *const row = malloc((size_t)place->Width);
    const char *problem = row == NULL ? "outofmem" : NULL;
    const int first = place->Interlace ? 0 : 4, last = place->Interlace ? 3 : 4;
    uint8_t(*const texels)[4] = image->texels;
    for (int turn = first; turn <= last; turn++) {
        for (int y = starts[turn]; y < place->Height && problem == NULL; y += steps[turn]) {
            const size_t texel = (size_t)(place->Top + y) * image->width + (size_t)place->Left;
            if (DGifGetLine(gif, row, place->Width) != GIF_OK ||
                !put_row(row, place->Width, colors, transparent, texels + texel)) {
                problem = damaged;
            }
        }
    }
    free(row);
    return problem;
}

static const char *decode(GifFileType *gif, struct scene_image *image)
{
    int transparent = NO_TRANSPARENT_COLOR;
    if (!find_picture(gif, &transparent)) {
        return damaged;
    }
    image->type = SCENE_IMAGE_RGBA8;
    image->width = (uint32_t)gif->SWidth;
    image->height = (uint32_t)gif->SHeight;
    image->size = (size_t)image->width * image->height * 4;
    image->texels = calloc(image->size, 1);
    if (image->texels == NULL) {
        return "outofmem";
    }
    const char *const problem = read_picture(gif, transparent, image);
    if (problem != NULL) {
        free(image->texels);
    }
    return problem;
}

const char *scene_image_decode_gif(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct source source = {bytes, size, 0};
    int error = 0;
    GifFileType *const gif = DGifOpen(&source, read_source, &error);
    if (gif == NULL) {
        return error == D_GIF_ERR_NOT_ENOUGH_MEM ? "outofmem" : damaged;
    }
    struct scene_image made = *image;
    const char *const problem = decode(gif, &made);
    DGifCloseFile(gif, &error);
    if (problem == NULL) {
        *image = made;
    }
    return problem;
}
