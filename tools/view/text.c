// SPDX-License-Identifier: MIT
// See text.h.
#include "text.h"

#include <stdbool.h>
#include <string.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion" // of a header that is not ours
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb_easy_font.h>
#pragma GCC diagnostic pop

enum {
    COLUMN = 6,        // pixels from column to column, about what a letter takes
    LETTER_QUADS = 16, // more than any letter has
    TOP = 2            // pixels above the letters
};

// As stb_easy_font writes them.
struct corner {
    float x, y, z;
    unsigned char color[4];
};

static void draw_letter(SDL_Renderer *renderer, int x, int y, int scale, char letter)
{
    char text[2] = {letter, 0};
    struct corner corners[LETTER_QUADS][4];
    SDL_Rect rectangles[LETTER_QUADS];
    const int count = stb_easy_font_print(0, 0, text, NULL, corners, (int)sizeof corners);
    for (int i = 0; i < count; i++) {
        const struct corner *const from = &corners[i][0], *const to = &corners[i][2];
        rectangles[i] = (SDL_Rect){.x = x + scale * (int)from->x,
                                   .y = y + scale * ((int)from->y + TOP),
                                   .w = scale * (int)(to->x - from->x),
                                   .h = scale * (int)(to->y - from->y)};
    }
    SDL_RenderFillRects(renderer, rectangles, count);
}

static int letter_width(char letter)
{
    char text[2] = {letter, 0};
    return stb_easy_font_width(text);
}

// Draws it, where there is a renderer, and returns where it ends.
static int walk(SDL_Renderer *renderer, int x, int y, int scale, const char *line, size_t length)
{
    int at = 0; // before it is enlarged
    for (size_t i = 0; i < length; i++) {
        if ((line[i] & 0xC0) == 0x80) {
            continue; // of a character whose first byte was drawn
        }
        const bool printable = line[i] >= ' ' && line[i] <= '~';
        const bool squared = i + 1 < length && memcmp(&line[i], "\u00b2", 2) == 0;
        const char letter = printable ? line[i] : squared ? '2' : '?';
        const bool in_column = i >= 2 && letter != ' ' && line[i - 1] == ' ' && line[i - 2] == ' ';
        if (in_column && at < COLUMN * (int)i) {
            at = COLUMN * (int)i;
        }
        if (renderer && letter != ' ') {
            draw_letter(renderer, x + scale * at, squared ? y - 2 * scale : y, scale, letter);
        }
        at += letter_width(letter);
    }
    return scale * at;
}

void view_text_draw(SDL_Renderer *renderer, int x, int y, int scale, const char *line, size_t length)
{
    walk(renderer, x, y, scale, line, length);
}

int view_text_width(int scale, const char *line, size_t length)
{
    return walk(NULL, 0, 0, scale, line, length);
}
