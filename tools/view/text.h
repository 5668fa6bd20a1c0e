// SPDX-License-Identifier: MIT
// Letters over a picture: those of stb_easy_font, which are made of rectangles, enlarged by whole numbers so that they
// stay sharp. No font has to be installed.
#ifndef VIEW_TEXT_H
#define VIEW_TEXT_H

#include <SDL.h>

enum { VIEW_TEXT_LINE = 13 }; ///< height of a line, times the scale

/// Draws one line from (x, y), its top left, in the renderer's colour. A word behind several spaces begins no further
/// left than its column, so that tables stay in order. Control characters and what is not ASCII are drawn as '?'.
void view_text_draw(SDL_Renderer *renderer, int x, int y, int scale, const char *line, size_t length);
/// Pixels that it takes from left to right.
int view_text_width(int scale, const char *line, size_t length);

#endif
