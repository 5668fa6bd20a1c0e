// SPDX-License-Identifier: MIT
// The pictures of a draw by their names in Python.
#ifndef PYTHON_PICTURE_FIELDS_H
#define PYTHON_PICTURE_FIELDS_H

#include "draw/draw.h"

enum { PYTHON_PICTURES = 11 };

struct python_picture_field {
    const char *name;
    enum scene_output output;
    void **texels;    ///< the member of the pictures
    const char *type; ///< of the elements, as in __array_interface__
    int channels;
};

void python_picture_fields(struct scene_pictures *pictures,
                           struct python_picture_field fields[PYTHON_PICTURES]);

#endif
