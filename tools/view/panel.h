// SPDX-License-Identifier: MIT
// What stands over the picture: boxes of text.
#ifndef VIEW_PANEL_H
#define VIEW_PANEL_H

#include "window.h"

enum view_corner { VIEW_BOTTOM_LEFT, VIEW_BOTTOM_RIGHT, VIEW_TOP_LEFT, VIEW_TOP_RIGHT, VIEW_MIDDLE };

/// Lines of a text, from `first_line` on, as many as the window has room for; draws nothing where there are none.
void view_panel_draw(const struct view_window *window, enum view_corner corner, const char *text,
                     int first_line);
/// The window's part that a text takes in a corner.
SDL_Rect view_panel_place(const struct view_window *window, enum view_corner corner, const char *text);
/// Whether its lines have room, if need be in the smallest letters.
bool view_panel_fits(const struct view_window *window, const char *text);
/// How far a text can be scrolled: the most that `first_line` may be.
int view_panel_last(const struct view_window *window, const char *text);

#endif
