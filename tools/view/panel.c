// SPDX-License-Identifier: MIT
// See panel.h.
#include "panel.h"

#include "text.h"

#include <string.h>

enum { MARGIN = 5, BORDER = 4 }; // around the text, around the box; times the scale

static const char *next_line(const char *line)
{
    const char *const end = strchr(line, '\n');
    return end ? end + 1 : line + strlen(line);
}

static int line_count(const char *text)
{
    int count = 0;
    for (const char *line = text; *line; line = next_line(line)) {
        count++;
    }
    return count;
}

static int widest_line(const char *text)
{
    int widest = 0;
    for (const char *line = text; *line; line = next_line(line)) {
        const int width = view_text_width(1, line, strcspn(line, "\n"));
        widest = width > widest ? width : widest;
    }
    return widest;
}

// As the window has them, as long as the lines have room.
static int scale_of(const struct view_window *window, const char *text)
{
    const int most = view_window_text_scale(window),
              fit = window->width / (widest_line(text) + 2 * (MARGIN + BORDER));
    const int scale = most < fit ? most : fit;
    return scale > 1 ? scale : 1;
}

bool view_panel_fits(const struct view_window *window, const char *text)
{
    return widest_line(text) + 2 * (MARGIN + BORDER) <= window->width;
}

// How many lines there is room for.
static int room(const struct view_window *window, int scale)
{
    const int lines = (window->height - 2 * scale * (MARGIN + BORDER)) / (scale * VIEW_TEXT_LINE);
    return lines > 1 ? lines : 1;
}

int view_panel_last(const struct view_window *window, const char *text)
{
    const int over = line_count(text) - room(window, scale_of(window, text));
    return over > 0 ? over : 0;
}

void view_panel_draw(const struct view_window *window, enum view_corner corner, const char *text,
                     int first_line)
{
    const int scale = scale_of(window, text), edge = scale * (MARGIN + BORDER),
              width = scale * widest_line(text);
    const int left_over = line_count(text) - first_line, most = room(window, scale),
              count = left_over < most ? left_over : most;
    if (count <= 0) {
        return;
    }
    const int height = count * scale * VIEW_TEXT_LINE;
    const int left = corner == VIEW_MIDDLE && window->width > width ? (window->width - width) / 2 : edge;
    const int top = corner == VIEW_TOP_LEFT      ? edge
                    : corner == VIEW_BOTTOM_LEFT ? window->height - edge - height
                                                 : (window->height - height) / 2;
    SDL_SetRenderDrawBlendMode(window->renderer, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(window->renderer, 20, 22, 26, 216);
    SDL_RenderFillRect(window->renderer,
                       &(SDL_Rect){left - scale * MARGIN, top - scale * MARGIN, width + 2 * scale * MARGIN,
                                   height + 2 * scale * MARGIN});
    SDL_SetRenderDrawColor(window->renderer, 236, 238, 242, SDL_ALPHA_OPAQUE);
    const char *line = text;
    for (int i = 0; i < first_line; i++) {
        line = next_line(line);
    }
    for (int i = 0; i < count; i++, line = next_line(line)) {
        view_text_draw(window->renderer, left, top + i * scale * VIEW_TEXT_LINE, scale, line,
                       strcspn(line, "\n"));
    }
}
