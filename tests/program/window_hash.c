// SPDX-License-Identifier: MIT
// What a window has shown, as examples/embedding/window.c says it: size and FNV-1a of the pixels of a BMP file that
// SDL's dummy driver has saved.
// usage: window_hash FILE.bmp
#include <stdio.h>

#include <SDL.h>

#include "picture_hash.h"

int main(int argc, char **argv)
{
    SDL_Surface *const saved = argc == 2 ? SDL_LoadBMP(argv[1]) : NULL;
    SDL_Surface *const picture = saved ? SDL_ConvertSurfaceFormat(saved, SDL_PIXELFORMAT_RGBA32, 0) : NULL;
    if (!picture || picture->pitch != picture->w * 4) {
        fprintf(stderr, "window_hash: %s\n", SDL_GetError());
        return 1;
    }
    unsigned char *const pixels = picture->pixels;
    const size_t size = (size_t)picture->w * (size_t)picture->h * 4;
    for (size_t i = 3; i < size; i += 4) {
        pixels[i] = 255; // a window has no alpha
    }
    printf("%d x %d %016llx\n", picture->w, picture->h, (unsigned long long)hash_bytes(pixels, size));
    return 0;
}
