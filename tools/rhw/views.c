// SPDX-License-Identifier: MIT
// See views.h. A sheet is made of every output alike: what is empty in it is what the outputs have where nothing is.
#include "views.h"

#include "message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    double azimuth, elevation;
} directions[CLI_VIEWS] = {
    {"front", 0, 0},
    {"back", 180, 0},
    {"left", -90, 0},
    {"right", 90, 0},
    {"top", 0, 90},
    {"bottom", 0, -90},
    {"iso", 45, 35.264389682754654}, // down the diagonal of a cube
};

const char *cli_view_name(int view)
{
    return directions[view].name;
}

struct scene_orbit cli_view_orbit(int view)
{
    return (struct scene_orbit){.azimuth = directions[view].azimuth, .elevation = directions[view].elevation};
}

static int find_view(const char *name, size_t length)
{
    int found = -1;
    for (int i = 0; i < CLI_VIEWS; i++) {
        if (strlen(directions[i].name) == length && memcmp(directions[i].name, name, length) == 0) {
            found = i;
        }
    }
    return found;
}

bool cli_views_parse(const char *list, int views[CLI_VIEWS], int *count)
{
    *count = 0;
    if (strcmp(list, "all") == 0) {
        for (*count = 0; *count < CLI_VIEWS; ++*count) {
            views[*count] = *count;
        }
        return true;
    }
    unsigned seen = 0;
    for (const char *name = list;; name++) {
        const size_t length = strcspn(name, ",");
        const int view = find_view(name, length);
        if (view < 0 || seen >> view & 1) {
            cli_error("--views",
                      view < 0
                          ? "'%.*s' is no view; there are front, back, left, right, top, bottom, iso, all"
                          : "'%.*s' stands there twice",
                      (int)length, name);
            return false;
        }
        seen |= 1u << view;
        views[(*count)++] = view;
        name += length;
        if (!*name) {
            return true;
        }
    }
}

void cli_sheet_grid(int count, int *columns, int *rows)
{
    enum { MOST_COLUMNS = 4 };
    int least = 0;
    for (int across = 1; across <= MOST_COLUMNS; across++) {
        const int down = (count + across - 1) / across, empty = across * down - count;
        if (across >= down && (least == 0 || empty < least - 1)) {
            least = empty + 1;
            *columns = across;
            *rows = down;
        }
    }
}

static size_t pixel_size(int kind)
{
    return rhw_format_size(scene_outputs[kind].format);
}

static void *get(const struct scene_pictures *pictures, int kind)
{
    return scene_picture_get(pictures, (enum scene_output_kind)kind);
}

// Memory of a sheet where nothing is yet.
static void *make_empty(int kind, size_t pixels)
{
    char *const picture = calloc(pixels, pixel_size(kind));
    const float empty = scene_outputs[kind].empty;
    for (size_t i = 0; i < pixels && picture && empty > 0.0f; i++) {
        memcpy(picture + i * sizeof empty, &empty, sizeof empty);
    }
    return picture;
}

bool cli_sheet_create(struct scene_pictures *sheet, const struct scene_pictures *cell, int columns, int rows)
{
    *sheet = (struct scene_pictures){.width = cell->width * columns, .height = cell->height * rows};
    memcpy(sheet->origin, cell->origin, sizeof sheet->origin);
    const size_t pixels = (size_t)sheet->width * (size_t)sheet->height;
    bool complete = true;
    for (int kind = 0; kind < SCENE_KIND_COUNT && complete; kind++) {
        if (get(cell, kind)) {
            void *const picture = make_empty(kind, pixels);
            scene_picture_set(sheet, (enum scene_output_kind)kind, picture);
            complete = picture != NULL;
        }
    }
    if (!complete) {
        scene_pictures_free(sheet);
    }
    return complete;
}

// Where row `y` of a place begins.
static size_t start_of(const struct scene_pictures *sheet, const struct scene_pictures *cell, int place,
                       int y)
{
    const int columns = sheet->width / cell->width;
    const size_t row = (size_t)(place / columns) * (size_t)cell->height + (size_t)y;
    return row * (size_t)sheet->width + (size_t)(place % columns) * (size_t)cell->width;
}

// Count a row of positions from the origin of the sheet.
static void move_row(const struct scene_pictures *sheet, const struct scene_pictures *cell, float *row)
{
    for (int i = 0; i < 4 * cell->width; i++) {
        const int c = i % 4;
        row[i] += c < 3 && row[i - c + 3] > 0.0f ? (float)(cell->origin[c] - sheet->origin[c]) : 0.0f;
    }
}

void cli_sheet_place(struct scene_pictures *sheet, const struct scene_pictures *cell, int place)
{
    for (int kind = 0; kind < SCENE_KIND_COUNT; kind++) {
        const char *const from = get(cell, kind);
        const size_t pixel = pixel_size(kind), row = (size_t)cell->width * pixel;
        for (int y = 0; y < cell->height && from; y++) {
            void *const to = (char *)get(sheet, kind) + start_of(sheet, cell, place, y) * pixel;
            memcpy(to, from + (size_t)y * row, row);
            if (kind == SCENE_KIND_POSITION) {
                move_row(sheet, cell, to);
            }
        }
    }
}

void cli_sheet_end(struct scene_pictures *sheet, const struct scene_pictures *cell, int place)
{
    const int places = sheet->width / cell->width * (sheet->height / cell->height);
    for (; place < places; place++) {
        for (int y = 0; y < cell->height; y++) {
            const size_t first = (size_t)y * (size_t)cell->width * 4;
            for (int x = 0; x < cell->width; x++) {
                const size_t at = (start_of(sheet, cell, place, y) + (size_t)x) * 4;
                if (sheet->color) {
                    memcpy(&sheet->color[at], &cell->color[first], 4);
                }
                if (sheet->display) {
                    memcpy(&sheet->display[at], &cell->display[first], 4 * sizeof *sheet->display);
                }
            }
        }
    }
}
