// SPDX-License-Identifier: MIT
// The outputs of a model in Python: the rows of scene/draw/output_table.h but those of the work.
#ifndef PYTHON_PICTURE_FIELDS_H
#define PYTHON_PICTURE_FIELDS_H

#include "draw/output_table.h"
#include "extension.h"

/// Whether Python has the output.
bool python_has_output(int kind);
/// The type of its elements, as in __array_interface__.
const char *python_output_type(int kind);
/// Adds the rows to the module, as `outputs`: (name, bit, place among the outputs of the program or -1, type, channels,
/// channels of an EXR, meaning). -1 with an exception.
int python_add_outputs(PyObject *module);

#endif
