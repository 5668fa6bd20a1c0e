// SPDX-License-Identifier: MIT
// Several pictures of one model from set directions, each for itself or all on one sheet.
#ifndef CLI_VIEWS_H
#define CLI_VIEWS_H

#include "draw/draw.h"

enum { CLI_VIEWS = 7 };

/// "front", "back", ...
const char *cli_view_name(int view);
struct scene_orbit cli_view_orbit(int view);

/// "front,top" or "all"; false after a line that names the unknown one, or one that stands there twice.
bool cli_views_parse(const char *list, int views[CLI_VIEWS], int *count);

/// How the pictures of a sheet stand, 1..CLI_VIEWS of them: with as few places empty as 4 columns allow, then as square
/// as can be, but never taller than broad.
void cli_sheet_grid(int count, int *columns, int *rows);
/// Makes the sheet's pictures, those that `cell` has, for a grid of such cells, all of them empty. False: no memory,
/// and nothing is left behind.
bool cli_sheet_create(struct scene_pictures *sheet, const struct scene_pictures *cell, int columns, int rows);
/// Puts `cell` at one of the places, counted along the rows.
void cli_sheet_place(struct scene_pictures *sheet, const struct scene_pictures *cell, int place);
/// Continues the background on the left of `cell` over the places from that one on.
void cli_sheet_end(struct scene_pictures *sheet, const struct scene_pictures *cell, int place);

#endif
