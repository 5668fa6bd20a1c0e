// SPDX-License-Identifier: MIT
// See keys.h.
#include "keys.h"

#include <stdio.h>

enum { PAGE = 16, ALL = 1 << 20 }; // lines

const struct view_key view_keys[] = {
    {0, VIEW_NOTHING, 0, "drag", "orbit"},
    {0, VIEW_NOTHING, 0, "right drag", "pan; so does Shift drag"},
    {0, VIEW_NOTHING, 0, "middle drag", "look around; so does Ctrl drag"},
    {0, VIEW_NOTHING, 0, "wheel", "zoom to the pointer; scroll text"},
    {0, VIEW_NOTHING, 0, "W A S D Q E", "fly; faster with Shift"},
    {0, VIEW_NOTHING, 0, "click", "explain the pixel"},
    {SDLK_f, VIEW_FIT, 0, "F", "fit the model into the window"},
    {SDLK_r, VIEW_RESET, 0, "R", "view and pose of the beginning"},
    {SDLK_SPACE, VIEW_PLAY, 0, "Space", "play the animation, or pause"},
    {SDLK_COMMA, VIEW_STEP, -1, ", .", "1/30 s back, 1/30 s ahead"},
    {SDLK_PERIOD, VIEW_STEP, 1, NULL, NULL},
    {SDLK_n, VIEW_ANIMATION, 0, "N", "next animation"},
    {SDLK_c, VIEW_COPY, 0, "C", "copy the rhw render of this"},
    {SDLK_F12, VIEW_SAVE, 0, "F12", "save the picture"},
    {SDLK_TAB, VIEW_INFO, 0, "Tab", "the line below, or not"},
    {SDLK_h, VIEW_HELP, 0, "H, F1", "this help, or not"},
    {SDLK_F1, VIEW_HELP, 0, NULL, NULL},
    {SDLK_F11, VIEW_FULLSCREEN, 0, "F11", "fill the screen, or not"},
    {SDLK_UP, VIEW_SCROLL, -1, "Up Down", "scroll text; Page and End too"},
    {SDLK_DOWN, VIEW_SCROLL, 1, NULL, NULL},
    {SDLK_PAGEUP, VIEW_SCROLL, -PAGE, NULL, NULL},
    {SDLK_PAGEDOWN, VIEW_SCROLL, PAGE, NULL, NULL},
    {SDLK_HOME, VIEW_SCROLL, -ALL, NULL, NULL},
    {SDLK_END, VIEW_SCROLL, ALL, NULL, NULL},
    {SDLK_ESCAPE, VIEW_LEAVE, 0, "Esc", "close what is open, or the window"},
    {SDLK_1, VIEW_OUTPUT, SCENE_KIND_COLOR, "1", "color"},
    {SDLK_2, VIEW_OUTPUT, SCENE_KIND_NORMAL, "2", "normals"},
    {SDLK_3, VIEW_OUTPUT, SCENE_KIND_DEPTH, "3", "depth"},
    {SDLK_4, VIEW_OUTPUT, SCENE_KIND_UV, "4", "texture coordinates"},
    {SDLK_5, VIEW_OUTPUT, SCENE_KIND_OBJECT, "5", "objects"},
    {SDLK_6, VIEW_OUTPUT, SCENE_KIND_TRIANGLE, "6", "triangles"},
    {SDLK_7, VIEW_OUTPUT, SCENE_KIND_BARYCENTRIC, "7", "barycentric weights"},
    {SDLK_8, VIEW_OUTPUT, SCENE_KIND_OVERDRAW, "8", "overdraw"},
    {SDLK_9, VIEW_OUTPUT, SCENE_KIND_TILES, "9", "triangles of each tile"},
    {SDLK_0, VIEW_OUTPUT, SCENE_KIND_PLAN, "0", "plan against hidden surfaces"},
    {SDLK_o, VIEW_NEXT_OUTPUT, 0, "O", "next output of all there are"},
    {SDLK_x, VIEW_WIREFRAME, 0, "X", "wireframe: none, over, plain"},
    {SDLK_p, VIEW_INTERPOLATE, 0, "P", "smooth or noperspective"},
    {SDLK_m, VIEW_SAMPLES, 0, "M", "samples: 1, 2, 4, 8, 16"},
    {SDLK_l, VIEW_LIGHTS, 0, "L", "lights: file, default, none"},
    {SDLK_k, VIEW_SHADOWS, 0, "K", "shadows and occlusion, or none"},
    {SDLK_b, VIEW_BACKGROUND, 0, "B", "background"},
    {SDLK_t, VIEW_THREADS, 0, "T", "threads: all, 1, 2, 4 .."},
    {SDLK_i, VIEW_ISA, 0, "I", "instruction set"},
    {0, VIEW_NOTHING, 0, "Shift", "with O, X, M, B: the other way"},
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

// The next line of the help, from `*at` on; NULL behind the last.
static const struct view_key *next_line(int *at, int end)
{
    while (*at < end && !view_keys[*at].name) {
        ++*at;
    }
    return *at < end ? &view_keys[(*at)++] : NULL;
}

void view_keys_print(FILE *out)
{
    int at = 0;
    for (const struct view_key *key = next_line(&at, view_key_count); key;
         key = next_line(&at, view_key_count)) {
        fprintf(out, "  %-12s %s\n", key->name, key->help);
    }
}

void view_keys_print_beside(FILE *out)
{
    int middle = 0; // what is seen stands on the right
    while (view_keys[middle].action != VIEW_OUTPUT) {
        middle++;
    }
    int left_at = 0, right_at = middle;
    for (;;) {
        const struct view_key *const left = next_line(&left_at, middle), *const right = next_line(
                                                                             &right_at, view_key_count);
        if (!left && !right) {
            return;
        }
        fprintf(out, "%-12s  %-34s  %-8s  %s\n", left ? left->name : "", left ? left->help : "",
                right ? right->name : "", right ? right->help : "");
    }
}
