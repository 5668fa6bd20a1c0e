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

static bool is_right(enum view_corner corner)
{
    return corner == VIEW_TOP_RIGHT || corner == VIEW_BOTTOM_RIGHT;
}

// Of the letters of so many lines.
static SDL_Rect place_of(const struct view_window *window, enum view_corner corner, const char *text,
                         int count)
{
    const int scale = scale_of(window, text), edge = scale * (MARGIN + BORDER);
    const int width = scale * widest_line(text), height = count * scale * VIEW_TEXT_LINE;
    const int right = window->width - edge - width, bottom = window->height - edge - height;
    const bool is_top = corner == VIEW_TOP_LEFT || corner == VIEW_TOP_RIGHT;
    SDL_Rect place = {edge, is_top ? edge : bottom, width, height};
    if (corner == VIEW_MIDDLE) {
        place.x = window->width > width ? (window->width - width) / 2 : edge;
        place.y = (window->height - height) / 2;
    } else if (is_right(corner) && right > edge) {
        place.x = right;
    }
    return place;
}

// What lies under them.
static SDL_Rect box_of(SDL_Rect letters, int scale)
{
    const int margin = scale * MARGIN;
    return (SDL_Rect){letters.x - margin, letters.y - margin, letters.w + 2 * margin, letters.h + 2 * margin};
}

SDL_Rect view_panel_place(const struct view_window *window, enum view_corner corner, const char *text)
{
    return box_of(place_of(window, corner, text, line_count(text)), scale_of(window, text));
}

void view_panel_draw(const struct view_window *window, enum view_corner corner, const char *text,
                     int first_line)
{
    const int scale = scale_of(window, text), left_over = line_count(text) - first_line,
              most = room(window, scale), count = left_over < most ? left_over : most;
    if (count <= 0) {
        return;
    }
    const SDL_Rect letters = place_of(window, corner, text, count), box = box_of(letters, scale);
    SDL_SetRenderDrawBlendMode(window->renderer, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(window->renderer, 20, 22, 26, 216);
    SDL_RenderFillRect(window->renderer, &box);
    SDL_SetRenderDrawColor(window->renderer, 236, 238, 242, SDL_ALPHA_OPAQUE);
    const char *line = text;
    for (int i = 0; i < first_line; i++) {
        line = next_line(line);
    }
    for (int i = 0; i < count; i++, line = next_line(line)) {
        view_text_draw(window->renderer, letters.x, letters.y + i * scale * VIEW_TEXT_LINE, scale, line,
                       strcspn(line, "\n"));
    }
}
