// SPDX-License-Identifier: MIT
// See stage_matrix.h. Gauss and Jordan's way, with the largest pivot of each column.
#include "stage_matrix.h"

#include <math.h>
#include <string.h>

enum { ROWS = 4, WIDTH = 8 }; // the matrix and, beside it, what becomes its inverse

static void swap_rows(double rows[ROWS][WIDTH], int i, int j)
{
    double row[WIDTH];
    memcpy(row, rows[i], sizeof row);
    memcpy(rows[i], rows[j], sizeof row);
    memcpy(rows[j], row, sizeof row);
}

static int pivot_of(double rows[ROWS][WIDTH], int column)
{
    int pivot = column;
    for (int row = column + 1; row < ROWS; row++) {
        pivot = fabs(rows[row][column]) > fabs(rows[pivot][column]) ? row : pivot;
    }
    return pivot;
}

// Makes the column that of the unit matrix.
static void eliminate(double rows[ROWS][WIDTH], int column)
{
    const double scale = 1.0 / rows[column][column];
    for (int k = 0; k < WIDTH; k++) {
        rows[column][k] *= scale;
    }
    for (int row = 0; row < ROWS; row++) {
        const double factor = row == column ? 0.0 : rows[row][column];
        for (int k = 0; k < WIDTH; k++) {
            rows[row][k] -= factor * rows[column][k];
        }
    }
}

bool stage_matrix_invert(const double matrix[16], double inverse[16])
{
    double rows[ROWS][WIDTH];
    for (int row = 0; row < ROWS; row++) {
        for (int k = 0; k < ROWS; k++) {
            rows[row][k] = matrix[4 * k + row];
            rows[row][ROWS + k] = k == row;
        }
    }
    for (int column = 0; column < ROWS; column++) {
        swap_rows(rows, column, pivot_of(rows, column));
        if (!(fabs(rows[column][column]) > 0.0)) {
            return false;
        }
        eliminate(rows, column);
    }
    for (int i = 0; i < 16; i++) {
        inverse[i] = rows[i % 4][ROWS + i / 4];
    }
    return true;
}
