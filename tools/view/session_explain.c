// SPDX-License-Identifier: MIT
// How a pixel came to be, beside the picture: a column of text, or below it in a tall window. The picture is made
// smaller rather than covered, with the pixel marked, and what lies around it stands enlarged in the room that is left.
#include "explain_draw.h"
#include "session.h"
#include "text.h"
#include "text_column.h"

#include <stdlib.h>
#include <string.h>

enum {
    MARGIN = 6,         // around the text, and the pixels enlarged; times the scale
    AROUND = 10,        // pixels that are seen each way of the one explained
    LEAST_ENLARGED = 5, // pixels wide, or they are left out
    ARM = 9,            // of the mark; times the scale, as the next
    GAP = 4             // from the pixel to it
};

static const char footer[] = "Esc: close   wheel, Up, Down: scroll";
static const char late_footer[] = "This was of an earlier picture.   Esc: close";

static const SDL_Color ground = {27, 29, 33, 255}, ink = {236, 238, 242, 255},
                       soft_ink = {150, 156, 166, 255}, light = {255, 255, 255, 255}, dark = {0, 0, 0, 255};

struct layout {
    SDL_Rect picture; // where all that is not text has room
    SDL_Rect panel;
    struct view_text_column column; // in it
    int footer_y;
};

static void set_color(SDL_Renderer *renderer, SDL_Color color)
{
    SDL_SetRenderDrawColor(renderer, color.r, color.g, color.b, color.a);
}

// Letters as large as the text has room for unbroken, in the part of the window that it may take.
static int choose_scale(const struct view_session *s, int most_width)
{
    const int natural = view_text_column_natural_width(s->explanation.text) + 2 * MARGIN;
    const int wanted = view_window_text_scale(&s->window), fit = most_width / natural;
    const int scale = wanted < fit ? wanted : fit;
    return scale > 1 ? scale : 1;
}

static struct layout lay_out(const struct view_session *s)
{
    const int width = s->window.width, height = s->window.height;
    const bool is_tall = height > width;
    const int most = is_tall ? width : width * 31 / 50, scale = choose_scale(s, most);
    const int natural = scale * (view_text_column_natural_width(s->explanation.text) + 2 * MARGIN);
    const int wide = natural < most ? natural : most;
    struct layout l = {.column.scale = scale};
    if (is_tall) {
        const int high = height * 11 / 20;
        l.panel = (SDL_Rect){0, height - high, width, high};
        l.picture = (SDL_Rect){0, 0, width, height - high};
    } else {
        l.panel = (SDL_Rect){width - wide, 0, wide, height};
        l.picture = (SDL_Rect){0, 0, width - wide, height};
    }
    const int margin = scale * MARGIN, line = scale * VIEW_TEXT_LINE;
    l.column.box = (SDL_Rect){l.panel.x + margin, l.panel.y + margin, l.panel.w - 2 * margin,
                              l.panel.h - 2 * margin - 2 * line};
    l.footer_y = l.panel.y + l.panel.h - margin - line;
    return l;
}

// What is open --------------------------------------------------------------------------------------

void view_session_explain(struct view_session *s, int x, int y)
{
    s->plays = false; // what is explained stands still
    const struct view_order order = view_session_order(s);
    if (cli_explain_check(&order.job, x, y, 0)) {
        view_painter_send(s->painter, VIEW_ERRAND_EXPLAIN, &order, x, y);
    }
}

void view_session_close_explanation(struct view_session *s)
{
    free(s->explanation.text);
    s->explanation.text = NULL;
}

void view_session_open_explanation(struct view_session *s, const struct view_answer *answer)
{
    view_session_close_explanation(s);
    s->explanation = (struct view_explanation){
        .text = answer->text, .x = answer->x, .y = answer->y, .version = answer->version};
}

// As large as it can be with all of it in the box, at its left or top end.
static SDL_Rect fit_into(SDL_Rect box, int width, int height)
{
    const bool is_flat = (int64_t)width * box.h >= (int64_t)height * box.w;
    SDL_Rect place = {box.x, box.y, box.w, box.h};
    if (is_flat) {
        place.h = (int)((int64_t)box.w * height / width);
    } else {
        place.w = (int)((int64_t)box.h * width / height);
    }
    place.w = place.w > 1 ? place.w : 1;
    place.h = place.h > 1 ? place.h : 1;
    return place;
}

// What the picture leaves of its part, below it or beside it.
static SDL_Rect left_over(SDL_Rect part, SDL_Rect place)
{
    const bool is_below = place.w >= part.w;
    return is_below ? (SDL_Rect){part.x, place.y + place.h, part.w, part.y + part.h - place.y - place.h}
                    : (SDL_Rect){place.x + place.w, part.y, part.x + part.w - place.x - place.w, part.h};
}

void view_session_place_picture(struct view_session *s)
{
    struct view_window *const window = &s->window;
    window->place = (SDL_Rect){0, 0, window->width, window->height};
    if (s->explanation.text) {
        window->place = fit_into(lay_out(s).picture, window->width, window->height);
    }
}

// Over the picture ----------------------------------------------------------------------------------

static void outline(SDL_Renderer *renderer, SDL_Rect box, int thickness, SDL_Color color)
{
    set_color(renderer, color);
    for (int i = 1; i <= thickness; i++) {
        SDL_RenderDrawRect(renderer, &(SDL_Rect){box.x - i, box.y - i, box.w + 2 * i, box.h + 2 * i});
    }
}

// Four arms around the pixel, light on dark, which are seen on any picture.
static void draw_mark(const struct view_session *s, int scale)
{
    const SDL_Rect *const place = &s->window.place;
    const int x = place->x + (int)((2 * (int64_t)s->explanation.x + 1) * place->w / (2 * s->window.width)),
              y = place->y + (int)((2 * (int64_t)s->explanation.y + 1) * place->h / (2 * s->window.height));
    const int half = scale > 1 ? scale / 2 : 0, gap = scale * GAP, arm = scale * ARM;
    for (int pass = 0; pass < 2; pass++) {
        const int more = pass == 0, thick = 2 * (half + more) + 1, length = arm + 2 * more;
        const SDL_Rect arms[4] = {{x - gap - arm - more, y - half - more, length, thick},
                                  {x + gap + 1 - more, y - half - more, length, thick},
                                  {x - half - more, y - gap - arm - more, thick, length},
                                  {x - half - more, y + gap + 1 - more, thick, length}};
        set_color(s->window.renderer, pass == 0 ? dark : light);
        SDL_RenderFillRects(s->window.renderer, arms, 4);
    }
}

// The pixels around it, each as a square.
static void draw_around(const struct view_session *s, SDL_Rect room, int scale)
{
    enum { ACROSS = 2 * AROUND + 1 };
    SDL_Renderer *const renderer = s->window.renderer;
    const int margin = 2 * scale * MARGIN;
    const int side = (room.w < room.h ? room.w : room.h) - margin, cell = side / ACROSS;
    if (cell < LEAST_ENLARGED) {
        return;
    }
    const int x = s->explanation.x - AROUND, y = s->explanation.y - AROUND, all = cell * ACROSS,
              left = room.x + (room.w - all) / 2, top = room.y + (room.h - all) / 2;
    const SDL_Rect picture = {0, 0, s->window.picture_width, s->window.picture_height};
    SDL_Rect from;
    if (!SDL_IntersectRect(&(SDL_Rect){x, y, ACROSS, ACROSS}, &picture, &from)) {
        return;
    }
    const SDL_Rect to = {left + (from.x - x) * cell, top + (from.y - y) * cell, from.w * cell, from.h * cell};
    SDL_SetTextureScaleMode(s->window.texture, SDL_ScaleModeNearest);
    SDL_RenderCopy(renderer, s->window.texture, &from, &to);
    SDL_SetTextureScaleMode(s->window.texture, SDL_ScaleModeLinear);
    const SDL_Rect middle = {left + AROUND * cell, top + AROUND * cell, cell, cell};
    outline(renderer, middle, 1, light);
    outline(renderer, (SDL_Rect){middle.x - 1, middle.y - 1, middle.w + 2, middle.h + 2}, 1, dark);
}

void view_session_draw_explanation(struct view_session *s)
{
    struct view_explanation *const e = &s->explanation;
    SDL_Renderer *const renderer = s->window.renderer;
    const struct layout l = lay_out(s);
    const int last = view_text_column_last(&l.column, e->text), margin = l.column.scale * MARGIN;
    const bool is_of_this = e->version == s->shown.version;
    e->line = e->line < 0 ? 0 : e->line > last ? last : e->line;
    if (is_of_this) {
        draw_mark(s, l.column.scale);
    }
    if (is_of_this && !s->shown.is_coarse && s->shown.width == s->window.width) {
        draw_around(s, left_over(l.picture, s->window.place), l.column.scale);
    }
    set_color(renderer, ground);
    SDL_RenderFillRect(renderer, &l.panel);
    set_color(renderer, ink);
    view_text_column_draw(renderer, &l.column, e->text, e->line);
    set_color(renderer, soft_ink);
    view_text_column_draw_bar(renderer, &l.column, e->text, e->line);
    const char *const line = is_of_this ? footer : late_footer;
    view_text_draw(renderer, l.panel.x + margin, l.footer_y, l.column.scale, line, strlen(line));
}
