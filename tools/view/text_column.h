// SPDX-License-Identifier: MIT
// A long text in a part of the window: lines that are too wide for it are broken between words, and it scrolls.
#ifndef VIEW_TEXT_COLUMN_H
#define VIEW_TEXT_COLUMN_H

#include <SDL.h>

struct view_text_column {
    SDL_Rect box; ///< pixels of the window
    int scale;    ///< of the letters
};

/// The widest line, in pixels of scale 1.
int view_text_column_natural_width(const char *text);
/// How far the text can be scrolled: the most that `first_line` may be.
int view_text_column_last(const struct view_text_column *column, const char *text);
/// Its lines from `first_line` on, as many as there is room for, in the renderer's colour.
void view_text_column_draw(SDL_Renderer *renderer, const struct view_text_column *column, const char *text,
                           int first_line);
/// A bar on the right that tells which part of the text that is; none where it is all.
void view_text_column_draw_bar(SDL_Renderer *renderer, const struct view_text_column *column,
                               const char *text, int first_line);

#endif
