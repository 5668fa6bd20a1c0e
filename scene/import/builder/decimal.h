// SPDX-License-Identifier: MIT
// Decimal numbers of text formats, as the doubles that are nearest to them.
#ifndef SCENE_DECIMAL_H
#define SCENE_DECIMAL_H

#include <stdint.h>

/// Read the digits that stand at `text` as a whole number, the first 8 at most. Return how many there are. Nothing at
/// `end` or behind it is read.
unsigned scene_decimal_digits(const char *text, const char *end, uint32_t *value);
/// Read the number at `text`, such as -12.5e3. Return where it ends. Return NULL if there is none. Nothing at `end` or
/// behind it is read.
const char *scene_decimal_read(const char *text, const char *end, double *value);

#endif
