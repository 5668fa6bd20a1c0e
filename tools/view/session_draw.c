// SPDX-License-Identifier: MIT
// What stands in the window: the picture, and over it what there is to say; see session.h.
#include "growing.h"
#include "keys.h"
#include "panel.h"
#include "session.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NOTICE_SHOWN_MS = 6000, PATIENCE_MS = 400 };

static void append(char *line, size_t size, const char *text)
{
    const size_t used = strlen(line);
    snprintf(line + used, size - used, "%s", text);
}

// How many cells of the picture have something of the model under a part of the window.
static int count_covered(const struct view_session *s, SDL_Rect part)
{
    const SDL_Rect picture = s->window.place;
    int count = 0;
    for (int y = 0; y < VIEW_CELLS; y++) {
        for (int x = 0; x < VIEW_CELLS; x++) {
            const int left = picture.x + x * picture.w / VIEW_CELLS,
                      top = picture.y + y * picture.h / VIEW_CELLS;
            const SDL_Rect cell = {left, top, picture.x + (x + 1) * picture.w / VIEW_CELLS - left,
                                   picture.y + (y + 1) * picture.h / VIEW_CELLS - top};
            count += (s->shown.covered[y] >> x & 1) != 0 && SDL_HasIntersection(&cell, &part);
        }
    }
    return count;
}

// The corner where the text hides least of the model. It stays where it is as long as no other is better.
static enum view_corner free_corner(const struct view_session *s, const char *text)
{
    static const enum view_corner corners[] = {VIEW_BOTTOM_LEFT, VIEW_BOTTOM_RIGHT, VIEW_TOP_LEFT,
                                               VIEW_TOP_RIGHT};
    enum view_corner best = s->info_corner;
    int least = count_covered(s, view_panel_place(&s->window, best, text));
    for (size_t i = 0; i < sizeof corners / sizeof *corners && least > 0; i++) {
        const int covered = count_covered(s, view_panel_place(&s->window, corners[i], text));
        best = covered < least ? corners[i] : best;
        least = covered < least ? covered : least;
    }
    return best;
}

// What is seen, and below it what that takes: short lines, as models leave more room beside them than below.
static void draw_info(struct view_session *s)
{
    static const char *const wires[] = {"", ", wireframe", ", plain wireframe"};
    const struct view_picture *const shown = &s->shown;
    const enum scene_output_kind kind = (enum scene_output_kind)__builtin_ctz(s->job.kinds);
    char line[400], more[96];
    if (shown->width == 0) {
        return;
    }
    const double rate = shown->ms > 0.0 ? (double)shown->triangles / shown->ms * 1e-3 : 0.0;
    snprintf(line, sizeof line, "%s%s%s\n%dx%d%s  %d sample%s\n%.1f ms  %.2f M triangles/s\n%d thread%s  %s",
             scene_outputs[kind].word, kind == SCENE_KIND_COLOR ? wires[s->job.wireframe] : "",
             s->job.interpolate == RHW_NOPERSPECTIVE ? ", noperspective" : "", shown->width, shown->height,
             shown->is_coarse ? " coarse" : "", shown->is_coarse ? 1 : s->job.samples,
             shown->is_coarse || s->job.samples == 1 ? "" : "s", shown->ms, rate, shown->threads,
             shown->threads == 1 ? "" : "s", rhw_isa_name(shown->isa));
    if (s->job.is_posed) {
        snprintf(more, sizeof more, "\n%s %.2f of %.2f s", s->plays ? "plays" : "at", s->job.time,
                 s->duration);
        append(line, sizeof line, more);
    }
    double ms;
    const char *const doing = view_painter_doing(s->painter, &ms);
    if (doing && ms > PATIENCE_MS) {
        snprintf(more, sizeof more, "\n%s: %.1f s", doing, ms / 1e3);
        append(line, sizeof line, more);
    }
    append(line, sizeof line, "  H: help");
    s->info_corner = free_corner(s, line);
    view_panel_draw(&s->window, s->info_corner, line, 0);
}

static bool print_help(char *text, size_t size, bool in_one_column)
{
    struct system_growing help;
    if (!system_growing_open(&help)) {
        return false;
    }
    if (in_one_column) {
        fputs("Up, Down, wheel: scroll\n", help.stream);
        view_keys_print(help.stream);
    } else {
        view_keys_print_beside(help.stream);
    }
    if (!system_growing_close(&help)) {
        return false;
    }
    snprintf(text, size, "%s", help.bytes);
    free(help.bytes);
    return true;
}

static void draw_help(struct view_session *s)
{
    char text[4096];
    const bool is_there = print_help(text, sizeof text, false);
    if (is_there && (view_panel_fits(&s->window, text) || print_help(text, sizeof text, true))) {
        const int last = view_panel_last(&s->window, text);
        s->help_line = s->help_line < 0 ? 0 : s->help_line > last ? last : s->help_line;
        view_panel_draw(&s->window, VIEW_MIDDLE, text, s->help_line);
    }
}

// What was said last, for a while. True where there is something.
static bool draw_notice(struct view_session *s)
{
    char line[sizeof s->notice];
    pthread_mutex_lock(&s->notice_lock);
    const bool is_new =
        s->notice[0] && (cli_milliseconds() - s->noticed_at < NOTICE_SHOWN_MS || s->has_failed);
    memcpy(line, s->notice, sizeof line);
    pthread_mutex_unlock(&s->notice_lock);
    if (is_new) {
        view_panel_draw(&s->window, VIEW_TOP_LEFT, line, 0);
    }
    return is_new;
}

// What is being read or prepared; in the middle as long as there is nothing else to see. True where there is something.
static bool draw_progress(struct view_session *s)
{
    char line[512] = "";
    double ms;
    const char *const doing = view_painter_doing(s->painter, &ms);
    if (s->loader) {
        view_loader_describe(s->loader, line, sizeof line);
    } else if (doing && s->shown.width == 0) {
        snprintf(line, sizeof line, "%s: %.1f s", doing, ms / 1e3);
    } else if (s->has_failed) {
        snprintf(line, sizeof line, "Drag a model file into this window");
    }
    view_panel_draw(&s->window, s->shown.width == 0 ? VIEW_MIDDLE : VIEW_TOP_LEFT, line, 0);
    return line[0] || doing;
}

bool view_session_draw(struct view_session *s)
{
    view_session_place_picture(s);
    view_window_draw_picture(&s->window);
    if (s->explanation.text) {
        view_session_draw_explanation(s);
    } else if (s->shows_info && !s->shows_help) {
        draw_info(s);
    }
    const bool works = draw_progress(s), tells = !s->loader && draw_notice(s);
    if (s->shows_help) {
        draw_help(s);
    }
    SDL_RenderPresent(s->window.renderer);
    return works || tells;
}
