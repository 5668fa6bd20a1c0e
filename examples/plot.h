// SPDX-License-Identifier: MIT
// Lines, dots and digits for the lessons that draw plots; every stroke is two triangles.
//
// Strokes are collected with plot_line and the rest, in pixels from the top left corner, and become one
// draw of a pass with plot_draw. Edges are as smooth as the target is supersampled.
#ifndef PLOT_H
#define PLOT_H

#include <rhw/rhw.h>

enum { PLOT_MAX_STROKES = 4096 };

struct plot_vertex {
    float x, y;
    float color[3]; ///< linear light
};

struct plot {
    int width, height; ///< pixels; the picture the strokes are placed in
    int strokes;       ///< further ones are left out when PLOT_MAX_STROKES is reached
    struct plot_vertex vertices[PLOT_MAX_STROKES * 6];
};

/// A straight stroke with square ends.
void plot_line(struct plot *plot, float x0, float y0, float x1, float y1, float width, const float color[3]);
void plot_rectangle(struct plot *plot, float x, float y, float width, float height, const float color[3]);
/// `text` from the digits, "./-= " and the letters w z x A B C; x, y is the lower left corner, `height` that of
/// a digit. Returns the x at which the text ends.
float plot_text(struct plot *plot, float x, float y, float height, const char *text, const float color[3]);

/// Records the strokes so far (at least one), over the viewport of the pass, and empties the plot.
void plot_draw(struct plot *plot, rhw_context *context, rhw_pass pass, enum rhw_format format);

#endif
