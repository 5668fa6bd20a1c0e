// SPDX-License-Identifier: MIT
// What the page plays with: a few triangles in front of a camera, each drawn as if it were flat to the eye, correctly, or
// by way of the world, and every number of a pixel. A picture is what a list of these calls says, and nothing else: the
// page makes them from JavaScript, tests/web makes the same ones natively and compares bytes.
//
// One stage a module. Numbers are doubles where JavaScript gives them; what is no number counts as 0.
#ifndef STAGE_H
#define STAGE_H

#include <stdbool.h>
#include <stdint.h>

/// How the weights of a pixel are found.
enum stage_method {
    STAGE_NAIVE,   ///< r, s, t, the weights on the screen: wrong
    STAGE_CORRECT, ///< a, b, c, by the pipeline: smooth
    STAGE_WORLD, ///< a, b, c, in the fragment function: back through the inverse matrix to a point, and areas there
    STAGE_METHODS
};

/// What is done with what was interpolated.
enum stage_pattern {
    STAGE_COLORS,    ///< the vertices' colours
    STAGE_CHECKER,   ///< squares of 1/8 in u, v, in the vertices' colours
    STAGE_FLOOR,     ///< a grid of 8 x 8 fields, the diagonal u = v blue, u = 1 - v red
    STAGE_DEPTH,     ///< Z/W as grey
    STAGE_INVERSE_W, ///< 1/W over the largest of the triangle's as grey
    STAGE_UV,        ///< u red, v green
    STAGE_UV_OVER_W, ///< u/W red, v/W green, over the largest 1/W: what is linear on the screen
    STAGE_PATTERNS
};

enum { STAGE_MAX_SIZE = 4096, STAGE_MAX_TRIANGLES = 64 };

/// Begins; `threads` as rhw_context_def. False, with stage_error, when something fails; so do those below.
bool stage_open(int threads);
void stage_close(void);
/// One line on what failed last.
const char *stage_error(void);

/// The picture, 1..STAGE_MAX_SIZE pixels each way; `samples` 1, 2, 4, 8, 16 a pixel.
bool stage_resize(int width, int height, int samples);
/// `yfov` in degrees from bottom to top; the planes by their distance.
bool stage_camera(double eye_x, double eye_y, double eye_z, double target_x, double target_y, double target_z,
                  double yfov, double near, double far);
/// Forgets the triangles; the colour behind the next ones.
void stage_clear(double red, double green, double blue);
/// Corner 0, 1 or 2 of the triangles that follow, in the world.
bool stage_corner(int corner, double x, double y, double z, double red, double green, double blue, double u,
                  double v);
/// Adds a triangle of the corners as they are, seen in the columns `first`..`end` − 1 of the picture.
bool stage_triangle(int method, int pattern, int first, int end);
/// Draws. [height][width] RGBA, valid until the next call; NULL when it fails.
const uint8_t *stage_draw(void);

/// The clip coordinates of a point of the world, [4], as a vertex gets them: floats. Valid until the next call.
const double *stage_clip(double x, double y, double z);

/// The numbers of the fragment that is seen at the middle of a pixel, in the order of stage_number_names: NULL where none is. They
/// are the pipeline's own, and by way of the world the fragment function's: that pixel is drawn once more, with one sample,
/// and asked. What does not exist (edges of a triangle that cannot be snapped, a point of the world where another method
/// drew) is NaN. Valid until the next call.
const double *stage_explain(int x, int y);
/// "triangle,clipped,X_0,Y_0,..": names apart by commas.
const char *stage_number_names(void);

#endif
