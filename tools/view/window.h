// SPDX-License-Identifier: MIT
// The window: SDL2 without OpenGL, so that a computer without a graphics card shows the same.
#ifndef VIEW_WINDOW_H
#define VIEW_WINDOW_H

#include "painter.h"

#include <SDL.h>

struct view_window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture; ///< the picture; NULL: there is none yet
    int picture_width, picture_height;
    int width, height; ///< pixels of the window
    SDL_Rect place;    ///< of those, where the picture stands
    bool is_fullscreen;
};

/// Reports failure.
bool view_window_open(struct view_window *window, int width, int height, bool is_fullscreen);
void view_window_close(struct view_window *window);
/// Asks how large the window is now; true where that has changed.
bool view_window_measure(struct view_window *window);
/// How many times letters are enlarged in a window as large.
int view_window_text_scale(const struct view_window *window);
/// From a place of the mouse to a pixel of a picture as large as the window, wherever it stands in it; it may lie
/// outside. On displays with more pixels than points these differ.
void view_window_pixel(const struct view_window *window, int x, int y, int *pixel_x, int *pixel_y);
void view_window_toggle_fullscreen(struct view_window *window);
/// Takes the pixels of a picture; reports failure.
bool view_window_set_picture(struct view_window *window, const struct view_picture *picture);
/// Draws the picture into its place, enlarged where it is coarser. What goes over it is drawn next, and shown by
/// SDL_RenderPresent.
void view_window_draw_picture(const struct view_window *window);

#endif
