// SPDX-License-Identifier: MIT
// What the keys do. One table has them for who presses them, for the help in the window and for --help.
#ifndef VIEW_KEYS_H
#define VIEW_KEYS_H

#include "outputs.h"

#include <SDL.h>
#include <stdio.h>

enum view_action {
    VIEW_NOTHING, ///< a line of the help alone
    VIEW_OUTPUT,  ///< its number is the argument
    VIEW_NEXT_OUTPUT,
    VIEW_WIREFRAME,
    VIEW_INTERPOLATE,
    VIEW_SAMPLES,
    VIEW_SHADOWS,
    VIEW_LIGHTS,
    VIEW_BACKGROUND,
    VIEW_THREADS,
    VIEW_ISA,
    VIEW_FIT,
    VIEW_RESET,
    VIEW_PLAY,
    VIEW_STEP,
    VIEW_ANIMATION,
    VIEW_COPY,
    VIEW_SAVE,
    VIEW_INFO,
    VIEW_HELP,
    VIEW_FULLSCREEN,
    VIEW_SCROLL, ///< by as many lines as the argument says
    VIEW_LEAVE
};

struct view_key {
    SDL_Keycode code; ///< 0: none
    enum view_action action;
    int argument;
    const char *name; ///< NULL: a second key for what the line before says
    const char *help;
};

extern const struct view_key view_keys[];
extern const int view_key_count;

/// NULL: it does nothing.
const struct view_key *view_key_find(SDL_Keycode code);
/// A line for each.
void view_keys_print(FILE *out);
/// Two in a line.
void view_keys_print_beside(FILE *out);

#endif
