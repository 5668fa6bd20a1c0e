// SPDX-License-Identifier: MIT
// An import in a process of its own.
#ifndef SCENE_READER_PROCESS_H
#define SCENE_READER_PROCESS_H

#include "import/builder/import.h"

struct system_memory_file;

/// Run import->read in a child process, as scene_model_load does.
struct scene_model *scene_import_start(const struct scene_import *import,
                                       const struct scene_model_options *options, char *error,
                                       size_t error_size);
/// Make a model, in memory of its own, of what scene_blob_write wrote to the file. Return NULL with one line in `error`
/// if the file has anything else.
struct scene_model *scene_import_map(const struct system_memory_file *file, char *error, size_t error_size);

#endif
