// SPDX-License-Identifier: MIT
// The triangle of the fragment that is seen, as an SVG: on the left the pixels around the place with its edges over
// them, on the right all of it, cut by the place into the three triangles whose areas are r, s and t; see
// explain_write.h.
#include "exact_weights.h"
#include "explain_write.h"
#include "message.h"
#include "output_file.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PANEL = 440, LEFT = 30, RIGHT = 520, TOP = 70, WIDTH = RIGHT + PANEL + 30, HEIGHT = 660, AROUND = 4 };
enum { LABEL = 120, LINE = 20 }; // width and height of a label

static const char *const colors[3] = {"#d1495b", "#2a9d8f", "#3d5a98"}; // of vertices 0, 1, 2

// From the screen, in pixels that are drawn, to a panel.
struct panel_map {
    double scale, x, y; // what lies at the panel's left and top
    int left;
};

static double to_x(const struct panel_map *map, double x)
{
    return map->left + (x - map->x) * map->scale;
}

static double to_y(const struct panel_map *map, double y)
{
    return TOP + (y - map->y) * map->scale;
}

static void draw_pixels(FILE *out, const struct cli_explanation *e, const struct panel_map *map)
{
    const double left = (double)e->x * e->side, top = (double)e->y * e->side, size = map->scale * e->side;
    for (int y = e->y - AROUND; y <= e->y + AROUND; y++) {
        for (int x = e->x - AROUND; x <= e->x + AROUND; x++) {
            if (x < 0 || y < 0 || x >= e->width || y >= e->height) {
                continue;
            }
            const uint8_t *const c = e->picture + 4 * ((size_t)y * (size_t)e->width + (size_t)x);
            fprintf(out,
                    "<rect x='%.2f' y='%.2f' width='%.2f' height='%.2f' fill='#%02x%02x%02x' stroke='#888' "
                    "stroke-width='0.5'/>\n",
                    to_x(map, (double)x * e->side), to_y(map, (double)y * e->side), size, size, c[0], c[1],
                    c[2]);
        }
    }
    fprintf(
        out,
        "<rect x='%.2f' y='%.2f' width='%.2f' height='%.2f' fill='none' stroke='#fff' stroke-width='4'/>\n"
        "<rect x='%.2f' y='%.2f' width='%.2f' height='%.2f' fill='none' stroke='#000' stroke-width='1.5'/>\n",
        to_x(map, left), to_y(map, top), size, size, to_x(map, left), to_y(map, top), size, size);
}

static void draw_outline(FILE *out, const struct rhw_explained_fragment *f, const struct panel_map *map)
{
    fprintf(out, "<polygon fill='none' stroke='#fff' stroke-width='4' points='");
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < 3; i++) {
            fprintf(out, "%.2f,%.2f ", to_x(map, f->x[i] / 256.0), to_y(map, f->y[i] / 256.0));
        }
        fprintf(out, pass ? "'/>\n" : "'/>\n<polygon fill='none' stroke='#000' stroke-width='1.5' points='");
    }
}

static void draw_place(FILE *out, const struct panel_map *map, double x, double y)
{
    fprintf(out, "<circle cx='%.2f' cy='%.2f' r='5' fill='#fff' stroke='#000' stroke-width='2'/>\n",
            to_x(map, x), to_y(map, y));
}

// The triangle opposite to a vertex has that vertex's share of the area.
static void draw_shares(FILE *out, const struct rhw_explained_fragment *f, const struct panel_map *map,
                        double x, double y)
{
    static const char names[3] = {'r', 's', 't'};
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double corner[3][2] = {
            {x, y}, {f->x[j] / 256.0, f->y[j] / 256.0}, {f->x[k] / 256.0, f->y[k] / 256.0}};
        double middle[2] = {0, 0};
        fprintf(out, "<polygon fill='%s' fill-opacity='0.55' stroke='#fff' points='", colors[i]);
        for (int n = 0; n < 3; n++) {
            fprintf(out, "%.2f,%.2f ", to_x(map, corner[n][0]), to_y(map, corner[n][1]));
            middle[0] += corner[n][0] / 3;
            middle[1] += corner[n][1] / 3;
        }
        fprintf(out, "'/>\n<text x='%.2f' y='%.2f' text-anchor='middle' font-style='italic'>%c</text>\n",
                to_x(map, middle[0]), to_y(map, middle[1]) + 5, names[i]);
    }
}

// Whether an edge of the triangle goes through a label of LABEL × LINE whose left and top are given.
static bool is_crossed(const struct rhw_explained_fragment *f, const struct panel_map *map, double left,
                       double top)
{
    enum { STEPS = 128 };
    for (int n = 0; n < 3 * STEPS; n++) {
        const int i = n / STEPS, j = (i + 1) % 3;
        const double part = (double)(n % STEPS) / STEPS;
        const double x = to_x(map, (f->x[i] + (f->x[j] - f->x[i]) * part) / 256.0) - left;
        const double y = to_y(map, (f->y[i] + (f->y[j] - f->y[i]) * part) / 256.0) - top;
        if (x >= 0 && x <= LABEL && y >= 0 && y <= LINE) {
            return true;
        }
    }
    return false;
}

// The places around a vertex, from the nearest on; all of them lie beside the other panel and under the heading.
enum { LABEL_SIDES = 2, LABEL_SHIFTS = 3, LABEL_PLACES = LABEL_SIDES * LABEL_SHIFTS * 4 };

static void place_around(const struct panel_map *map, double x, double y, int n, double place[2])
{
    enum { NEAR = 8 };
    const int is_below = n % LABEL_SIDES, shift = n / LABEL_SIDES % LABEL_SHIFTS;
    const double distance = NEAR * (1.0 + n / (LABEL_SIDES * LABEL_SHIFTS));
    const double left = x - LABEL * (shift == 0 ? 0.5 : shift == 1 ? 0.05 : 0.95);
    place[0] = fmin(fmax(left, map->left), map->left + PANEL - LABEL);
    place[1] = fmax(is_below ? y + distance : y - distance - LINE, TOP - LINE);
}

// Where the label of vertex i begins: as near as no edge crosses it, or else nearest.
static void place_label(const struct rhw_explained_fragment *f, const struct panel_map *map, int i,
                        double place[2])
{
    const double x = to_x(map, f->x[i] / 256.0), y = to_y(map, f->y[i] / 256.0);
    for (int n = 0; n < LABEL_PLACES; n++) {
        place_around(map, x, y, n, place);
        if (!is_crossed(f, map, place[0], place[1])) {
            return;
        }
    }
    place_around(map, x, y, 0, place);
}

static void draw_vertices(FILE *out, const struct rhw_explained_fragment *f, const struct panel_map *map)
{
    for (int i = 0; i < 3; i++) {
        double label[2];
        place_label(f, map, i, label);
        fprintf(out,
                "<circle cx='%.2f' cy='%.2f' r='5' fill='%s'/>\n"
                "<text x='%.2f' y='%.2f' text-anchor='middle' fill='%s' stroke='#fafaf8' stroke-width='4' "
                "paint-order='stroke'>%d, W = %.5g</text>\n",
                to_x(map, f->x[i] / 256.0), to_y(map, f->y[i] / 256.0), colors[i], label[0] + LABEL / 2.0,
                label[1] + LINE - 5, colors[i], i, (double)f->position[i][3]);
    }
}

static struct panel_map map_around(const struct cli_explanation *e)
{
    return (struct panel_map){PANEL / (2.0 * AROUND + 1.0) / e->side, (double)(e->x - AROUND) * e->side,
                              (double)(e->y - AROUND) * e->side, LEFT};
}

static struct panel_map map_of_all(const struct rhw_explained_fragment *f)
{
    double least[2] = {f->x[0] / 256.0, f->y[0] / 256.0}, most[2] = {least[0], least[1]};
    for (int i = 1; i < 3; i++) {
        const double place[2] = {f->x[i] / 256.0, f->y[i] / 256.0};
        for (int c = 0; c < 2; c++) {
            least[c] = place[c] < least[c] ? place[c] : least[c];
            most[c] = place[c] > most[c] ? place[c] : most[c];
        }
    }
    const double margin = 30.0, wide = most[0] - least[0], high = most[1] - least[1];
    const double scale = (PANEL - 2 * margin) / (wide > high ? wide : high);
    return (struct panel_map){scale, (least[0] + most[0]) / 2 - PANEL / 2.0 / scale,
                              (least[1] + most[1]) / 2 - PANEL / 2.0 / scale, RIGHT};
}

static void write_numbers(FILE *out, const struct cli_explanation *e, const struct rhw_explained_fragment *f,
                          const struct cli_exact_weights *w)
{
    static const char *const screen = "rst", *const space = "abc";
    for (int i = 0; i < 3; i++) {
        fprintf(out,
                "<text y='%d' fill='%s'><tspan x='%d'>e_%d = %" PRId64
                "</tspan><tspan x='%d'>%c = %.9f</tspan>"
                "<tspan x='%d'>%c = %c W/W_%d = %.9f</tspan></text>\n",
                TOP + PANEL + 40 + 24 * i, colors[i], LEFT, i, w->edge[i], LEFT + 220, screen[i],
                mpq_get_d(w->screen[i]), LEFT + 400, space[i], screen[i], i, mpq_get_d(w->space[i]));
    }
    if (e->is_orthographic) {
        fprintf(out, "<text x='%d' y='%d'>Without perspective every W is 1: a, b, c are r, s, t</text>\n",
                LEFT, TOP + PANEL + 40 + 24 * 3);
        return;
    }
    fprintf(out, "<text x='%d' y='%d'>1/W = r/W_0 + s/W_1 + t/W_2 = %.9g, so W = %.9g</text>\n", LEFT,
            TOP + PANEL + 40 + 24 * 3, mpq_get_d(w->inverse_w), 1.0 / f->inverse_w);
}

static bool write_svg(FILE *out, const struct cli_explanation *e, const struct rhw_explained_fragment *f,
                      const struct cli_exact_weights *w)
{
    double place[2];
    cli_explained_place(f, place);
    const struct panel_map around = map_around(e), all = map_of_all(f);
    fprintf(
        out,
        "<svg xmlns='http://www.w3.org/2000/svg' width='%d' height='%d' viewBox='0 0 %d %d' "
        "font-family='sans-serif' font-size='15'>\n<rect width='100%%' height='100%%' fill='#fafaf8'/>\n"
        "<text x='%d' y='42'>The pixels around (%d, %d) of %dx%d</text>\n"
        "<text x='%d' y='42'>The triangle on the screen: areas are r, s, t</text>\n"
        "<clipPath id='c'><rect x='%d' y='%d' width='%d' height='%d'/></clipPath>\n<g clip-path='url(#c)'>\n",
        WIDTH, HEIGHT, WIDTH, HEIGHT, LEFT, e->x, e->y, e->width, e->height, RIGHT, LEFT, TOP, PANEL, PANEL);
    draw_pixels(out, e, &around);
    draw_outline(out, f, &around);
    fprintf(out, "</g>\n");
    draw_place(out, &around, place[0], place[1]);
    draw_shares(out, f, &all, place[0], place[1]);
    draw_place(out, &all, place[0], place[1]);
    draw_vertices(out, f, &all);
    write_numbers(out, e, f, w);
    return fprintf(out, "</svg>\n") > 0;
}

bool cli_explain_picture(const struct cli_explanation *e, const char *path)
{
    const struct cli_past_fragment *const seen = cli_history_seen(e->history);
    struct cli_exact_weights weights;
    struct cli_output_file file;
    if (!seen || !seen->told.is_snapped ||
        !cli_exact_weights_set(&weights, &seen->told, e->drawn_width, e->drawn_height)) {
        cli_error(path, seen ? "not drawn: a vertex of the triangle lies nowhere on the screen"
                             : "not drawn: nothing of the model is seen there");
        return false;
    }
    errno = 0;
    bool written = cli_output_file_open(&file, path);
    if (written) {
        written = write_svg(file.stream, e, &seen->told, &weights) && cli_output_file_finish(&file) &&
                  cli_output_file_commit(&file);
        if (!written) {
            cli_output_file_discard(&file);
        }
    }
    cli_exact_weights_free(&weights);
    return written;
}
