// SPDX-License-Identifier: MIT
// See text_column.h.
#include "text_column.h"

#include "text.h"

#include <stdbool.h>
#include <string.h>

enum {
    HANG =
        12, // pixels that what is broken off stands further right than its line; times the scale, as the next
    BAR = 3,       // width of the bar,
    BAR_SPACE = 4, // and of what is left free beside it
    LEAST_BAR = 8  // its height
};

// A line of the window, which is part of a line of the text.
struct piece {
    const char *text;
    size_t length;
    int indent; // pixels
};

static int width_for_text(const struct view_text_column *column)
{
    return column->box.w - column->scale * (BAR + BAR_SPACE);
}

// How much of a line there is room for, to the end of a word where one ends.
static size_t fitting(const char *line, size_t length, int scale, int width)
{
    if (view_text_width(scale, line, length) <= width) {
        return length;
    }
    size_t fits = 1, over = length; // a letter stands there however narrow the box is
    while (over - fits > 1) {
        const size_t middle = (fits + over) / 2;
        *(view_text_width(scale, line, middle) <= width ? &fits : &over) = middle;
    }
    for (size_t i = fits; i > 0; i--) {
        if (line[i] == ' ' && line[i - 1] != ' ' && strspn(line, " ") < i) {
            return i;
        }
    }
    return fits;
}

// How far a text has been gone through.
struct place {
    const char *next;
    int indent; // of the rest of a line that was broken; 0: a line begins
};

// False behind the last.
static bool next_piece(const struct view_text_column *column, struct place *at, struct piece *piece)
{
    const char *const line = at->next;
    if (!*line) {
        return false;
    }
    const size_t length = strcspn(line, "\n");
    const size_t fits = fitting(line, length, column->scale, width_for_text(column) - at->indent);
    *piece = (struct piece){line, fits, at->indent};
    const size_t spaces = fits < length ? strspn(line + fits, " ") : 0;
    at->next = line + fits + spaces;
    if (fits + spaces < length) {
        at->indent = at->indent > 0
                         ? at->indent
                         : view_text_width(column->scale, line, strspn(line, " ")) + column->scale * HANG;
    } else {
        at->next += *at->next == '\n';
        at->indent = 0;
    }
    return true;
}

int view_text_column_natural_width(const char *text)
{
    int widest = 0;
    for (const char *line = text; *line;) {
        const size_t length = strcspn(line, "\n");
        const int width = view_text_width(1, line, length);
        widest = width > widest ? width : widest;
        line += line[length] ? length + 1 : length;
    }
    return widest + BAR + BAR_SPACE;
}

static int count_lines(const struct view_text_column *column, const char *text)
{
    struct piece piece;
    struct place at = {.next = text};
    int count = 0;
    while (next_piece(column, &at, &piece)) {
        count++;
    }
    return count;
}

static int room(const struct view_text_column *column)
{
    const int lines = column->box.h / (column->scale * VIEW_TEXT_LINE);
    return lines > 1 ? lines : 1;
}

int view_text_column_last(const struct view_text_column *column, const char *text)
{
    const int over = count_lines(column, text) - room(column);
    return over > 0 ? over : 0;
}

void view_text_column_draw(SDL_Renderer *renderer, const struct view_text_column *column, const char *text,
                           int first_line)
{
    const int step = column->scale * VIEW_TEXT_LINE, end = first_line + room(column);
    struct piece piece;
    struct place at = {.next = text};
    for (int line = 0; line < end && next_piece(column, &at, &piece); line++) {
        if (line >= first_line) {
            view_text_draw(renderer, column->box.x + piece.indent, column->box.y + (line - first_line) * step,
                           column->scale, piece.text, piece.length);
        }
    }
}

void view_text_column_draw_bar(SDL_Renderer *renderer, const struct view_text_column *column,
                               const char *text, int first_line)
{
    const int shown = room(column), count = count_lines(column, text);
    if (count <= shown) {
        return;
    }
    const int height = column->box.h, least = column->scale * LEAST_BAR,
              part = (int)((int64_t)height * shown / count), length = part > least ? part : least;
    const int top = (int)((int64_t)(height - length) * first_line / (count - shown));
    SDL_RenderFillRect(renderer, &(SDL_Rect){.x = column->box.x + column->box.w - column->scale * BAR,
                                             .y = column->box.y + top,
                                             .w = column->scale * BAR,
                                             .h = length});
}
