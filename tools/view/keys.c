// SPDX-License-Identifier: MIT
// See keys.h.
#include "keys.h"

#include <stdio.h>

const struct view_key view_keys[] = {
    {0, VIEW_NOTHING, 0, "drag", "orbit"},
    {0, VIEW_NOTHING, 0, "right drag, Shift drag", "pan"},
    {0, VIEW_NOTHING, 0, "middle drag, Ctrl drag", "look around"},
    {0, VIEW_NOTHING, 0, "wheel", "zoom to the pointer"},
    {0, VIEW_NOTHING, 0, "W A S D Q E", "fly; with Shift faster, dragging looks around"},
    {0, VIEW_NOTHING, 0, "click", "explain the pixel"},
    {SDLK_f, VIEW_FIT, 0, "F", "fit the model into the window"},
    {SDLK_r, VIEW_RESET, 0, "R", "the view and the pose of the beginning"},
    {SDLK_1, VIEW_OUTPUT, CLI_KIND_COLOR, "1", "color"},
    {SDLK_2, VIEW_OUTPUT, CLI_KIND_NORMAL, "2", "normal"},
    {SDLK_3, VIEW_OUTPUT, CLI_KIND_DEPTH, "3", "depth"},
    {SDLK_4, VIEW_OUTPUT, CLI_KIND_UV, "4", "texture coordinates"},
    {SDLK_5, VIEW_OUTPUT, CLI_KIND_OBJECT, "5", "objects"},
    {SDLK_6, VIEW_OUTPUT, CLI_KIND_TRIANGLE, "6", "triangles"},
    {SDLK_7, VIEW_OUTPUT, CLI_KIND_BARY, "7", "barycentric weights"},
    {SDLK_o, VIEW_NEXT_OUTPUT, 0, "O", "next output, of all that there are; with Shift the last one"},
    {SDLK_x, VIEW_WIREFRAME, 0, "X", "wireframe: none, over the surface, plain"},
    {SDLK_p, VIEW_INTERPOLATE, 0, "P", "smooth or noperspective"},
    {SDLK_m, VIEW_SAMPLES, 0, "M", "samples: 1, 2, 4, 8, 16"},
    {SDLK_l, VIEW_LIGHTS, 0, "L", "lights: of the file, default, none"},
    {SDLK_k, VIEW_SHADOWS, 0, "K", "shadows and ambient occlusion"},
    {SDLK_b, VIEW_BACKGROUND, 0, "B", "background: default, white, black, transparent"},
    {SDLK_t, VIEW_THREADS, 0, "T", "threads: all, 1, 2, 4 .."},
    {SDLK_i, VIEW_ISA, 0, "I", "instruction set"},
    {SDLK_SPACE, VIEW_PLAY, 0, "Space", "play the animation, or pause"},
    {SDLK_COMMA, VIEW_STEP, -1, ", .", "a thirtieth of a second back, ahead"},
    {SDLK_PERIOD, VIEW_STEP, 1, NULL, NULL},
    {SDLK_n, VIEW_ANIMATION, 0, "N", "next animation"},
    {SDLK_c, VIEW_COPY, 0, "C", "the rhw render that draws this, to the clipboard and standard output"},
    {SDLK_F12, VIEW_SAVE, 0, "F12", "save the picture in the current folder"},
    {SDLK_TAB, VIEW_INFO, 0, "Tab", "show or hide the line below"},
    {SDLK_h, VIEW_HELP, 0, "H, F1", "this help"},
    {SDLK_F1, VIEW_HELP, 0, NULL, NULL},
    {SDLK_F11, VIEW_FULLSCREEN, 0, "F11", "fill the screen"},
    {SDLK_ESCAPE, VIEW_LEAVE, 0, "Esc", "close what is open, then the window"},
};

const int view_key_count = sizeof view_keys / sizeof *view_keys;

const struct view_key *view_key_find(SDL_Keycode code)
{
    for (int i = 0; i < view_key_count; i++) {
        if (view_keys[i].code && view_keys[i].code == code) {
            return &view_keys[i];
        }
    }
    return NULL;
}

void view_keys_print(FILE *out)
{
    for (int i = 0; i < view_key_count; i++) {
        if (view_keys[i].name) {
            fprintf(out, "  %-24s %s\n", view_keys[i].name, view_keys[i].help);
        }
    }
}
