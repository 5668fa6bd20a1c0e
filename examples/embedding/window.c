// SPDX-License-Identifier: MIT
// A window with a turning cube, by SDL2 and no other graphics library. Escape or Q closes it, its edges can be dragged.
// usage: window [--frames N]: closes after N frames, and prints a number made of the last
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <SDL.h>

#include "cube.h"
#include "picture_hash.h"
#include "target.h"

enum { FRAME_MS = 16 };

static bool quit_asked(void)
{
    SDL_Event event;
    bool quit = false;
    while (SDL_PollEvent(&event)) {
        const bool key = event.type == SDL_KEYDOWN;
        quit = quit || event.type == SDL_QUIT ||
               (key && (event.key.keysym.sym == SDLK_ESCAPE || event.key.keysym.sym == SDLK_q));
    }
    return quit;
}

// The window, and what stands between it and the renderer: both pictures have its size.
struct screen {
    SDL_Window *window;
    SDL_Surface *picture;
    struct target target;
};

static bool screen_fit(struct screen *screen, rhw_context *context)
{
    int width, height;
    SDL_GetWindowSize(screen->window, &width, &height);
    if (target_fit(context, &screen->target, width, height) != RHW_OK) {
        return SDL_OutOfMemory() == 0;
    }
    width = screen->target.width;
    height = screen->target.height;
    if (screen->picture && screen->picture->w == width && screen->picture->h == height) {
        return true;
    }
    SDL_FreeSurface(screen->picture);
    // RGBA32 is R, G, B, A in memory on every machine, as RGBA8_SRGB is.
    screen->picture = SDL_CreateRGBSurfaceWithFormat(0, width, height, 32, SDL_PIXELFORMAT_RGBA32);
    return screen->picture && SDL_SetSurfaceBlendMode(screen->picture, SDL_BLENDMODE_NONE) == 0;
}

static bool screen_show(struct screen *screen, rhw_context *context)
{
    SDL_Surface *const picture = screen->picture;
    rhw_texture_read(context, screen->target.texture, 0, picture->pixels, (size_t)picture->pitch);
    // Asked for in every frame, since a window that has changed its size has a new one.
    SDL_Surface *const surface = SDL_GetWindowSurface(screen->window);
    return surface && SDL_BlitSurface(picture, NULL, surface, NULL) == 0 &&
           SDL_UpdateWindowSurface(screen->window) == 0;
}

// Draws until the user has enough, or `frames` are drawn.
static bool run(struct screen *screen, rhw_context *context, rhw_pipeline pipeline, long frames)
{
    for (long frame = 0; !quit_asked() && (frames == 0 || frame < frames); frame++) {
        const Uint32 started = SDL_GetTicks();
        if (!screen_fit(screen, context)) {
            return false;
        }
        if (cube_draw(context, pipeline, screen->target.texture, (float)frame * 0.015f) != RHW_OK) {
            return SDL_OutOfMemory() == 0;
        }
        if (!screen_show(screen, context)) {
            return false;
        }
        const Uint32 spent = SDL_GetTicks() - started;
        SDL_Delay(spent < FRAME_MS ? FRAME_MS - spent : 0);
    }
    if (frames > 0) {
        printf("%d x %d %016llx\n", screen->target.width, screen->target.height,
               (unsigned long long)hash_picture(context, screen->target.texture));
    }
    return true;
}

int main(int argc, char **argv)
{
    const long frames = argc == 3 && strcmp(argv[1], "--frames") == 0 ? strtol(argv[2], NULL, 10) : 0;
    if (argc > 1 && frames < 1) {
        fprintf(stderr, "usage: window [--frames N]\n");
        return 2;
    }
    struct screen screen = {0};
    const struct rhw_context_def def = {0};
    rhw_context *context = NULL;
    rhw_pipeline pipeline;
    bool good = SDL_Init(SDL_INIT_VIDEO) == 0;
    if (good) {
        screen.window = SDL_CreateWindow("rhw", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, 640, 480,
                                         SDL_WINDOW_RESIZABLE);
        good = screen.window != NULL;
    }
    if (good &&
        (rhw_context_create(&def, &context) != RHW_OK || cube_pipeline(context, &pipeline) != RHW_OK)) {
        good = SDL_OutOfMemory() == 0;
    }
    good = good && run(&screen, context, pipeline, frames);
    if (!good) {
        fprintf(stderr, "window: %s\n", SDL_GetError());
    }
    rhw_context_destroy(context);
    SDL_FreeSurface(screen.picture);
    if (screen.window) {
        SDL_DestroyWindow(screen.window);
    }
    SDL_Quit();
    return good ? 0 : 1;
}
