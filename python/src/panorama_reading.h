// SPDX-License-Identifier: MIT
// A panorama that is read on a thread of its own, which Ctrl-C leaves behind: decoders ask nobody whether to go on.
#ifndef PYTHON_PANORAMA_READING_H
#define PYTHON_PANORAMA_READING_H

#include "extension.h"

#include "draw/panorama.h"

/// Reads a panorama and looks for signals meanwhile, without the interpreter's lock. False with an exception.
bool python_panorama_load(const char *path, struct scene_panorama *panorama);

#endif
