// SPDX-License-Identifier: MIT
// See window.h.
#include "window.h"

#include "message.h"
#include "streams.h"

#include <math.h>
#include <string.h>

static bool report(const char *what)
{
    cli_error("view", "%s: %s", what, SDL_GetError());
    return false;
}

// Whether SDL fell back to a driver that nobody sees, and which nobody named.
static bool is_unseen(void)
{
    const char *const driver = SDL_GetCurrentVideoDriver();
    return !SDL_getenv("SDL_VIDEODRIVER") &&
           (strcmp(driver, "offscreen") == 0 || strcmp(driver, "dummy") == 0);
}

bool view_window_open(struct view_window *window, int width, int height, bool is_fullscreen)
{
    *window = (struct view_window){.is_fullscreen = is_fullscreen};
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "linear");
    SDL_SetHint(SDL_HINT_VIDEO_X11_NET_WM_BYPASS_COMPOSITOR, "0");
    const int silenced = system_streams_silence(); // Wayland's library tells what it tries and has not
    const bool has_video = SDL_Init(SDL_INIT_VIDEO) == 0;
    system_streams_restore(silenced);
    if (!has_video) {
        return report("there is no display to open a window on");
    }
    if (is_unseen()) {
        SDL_SetError("neither X11 nor Wayland is to be had");
        return report("there is no display to open a window on");
    }
    const Uint32 flags =
        SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI | (is_fullscreen ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
    window->window =
        SDL_CreateWindow("rhw", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, width, height, flags);
    window->renderer = window->window ? SDL_CreateRenderer(window->window, -1, SDL_RENDERER_SOFTWARE) : NULL;
    if (!window->renderer) {
        return report("no window can be opened");
    }
    SDL_SetWindowMinimumSize(window->window, 160, 120);
    view_window_measure(window);
    window->place = (SDL_Rect){0, 0, window->width, window->height};
    return true;
}

void view_window_close(struct view_window *window)
{
    if (window->texture) {
        SDL_DestroyTexture(window->texture);
    }
    if (window->renderer) {
        SDL_DestroyRenderer(window->renderer);
    }
    if (window->window) {
        SDL_DestroyWindow(window->window);
    }
    SDL_Quit();
}

bool view_window_measure(struct view_window *window)
{
    const int width = window->width, height = window->height;
    SDL_GetRendererOutputSize(window->renderer, &window->width, &window->height);
    return width != window->width || height != window->height;
}

void view_window_pixel(const struct view_window *window, int x, int y, int *pixel_x, int *pixel_y)
{
    int width, height;
    SDL_GetWindowSize(window->window, &width, &height);
    const SDL_Rect *const place = &window->place;
    const double right = width > 0 ? ((double)x + 0.5) * window->width / width - place->x : 0.0,
                 down = height > 0 ? ((double)y + 0.5) * window->height / height - place->y : 0.0;
    *pixel_x = (int)floor(right * window->width / place->w);
    *pixel_y = (int)floor(down * window->height / place->h);
}

// Letters grow with the window, from 900×500 pixels on.
int view_window_text_scale(const struct view_window *window)
{
    const int wide = 1 + (window->width + 700) / 1600, high = 1 + (window->height + 350) / 850;
    return wide < high ? wide : high;
}

void view_window_toggle_fullscreen(struct view_window *window)
{
    window->is_fullscreen = !window->is_fullscreen;
    SDL_SetWindowFullscreen(window->window, window->is_fullscreen ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
}

bool view_window_set_picture(struct view_window *window, const struct view_picture *picture)
{
    if (!window->texture || window->picture_width != picture->width ||
        window->picture_height != picture->height) {
        if (window->texture) {
            SDL_DestroyTexture(window->texture);
        }
        // RGBA32 is R, G, B, A in memory on every machine.
        window->texture = SDL_CreateTexture(window->renderer, SDL_PIXELFORMAT_RGBA32,
                                            SDL_TEXTUREACCESS_STREAMING, picture->width, picture->height);
        window->picture_width = picture->width;
        window->picture_height = picture->height;
    }
    if (!window->texture ||
        SDL_UpdateTexture(window->texture, NULL, picture->pixels, picture->width * 4) != 0) {
        return report("the picture cannot be shown");
    }
    return true;
}

void view_window_draw_picture(const struct view_window *window)
{
    SDL_SetRenderDrawColor(window->renderer, 44, 46, 50, SDL_ALPHA_OPAQUE);
    SDL_RenderClear(window->renderer);
    if (window->texture) {
        SDL_RenderCopy(window->renderer, window->texture, NULL, &window->place);
    }
}
