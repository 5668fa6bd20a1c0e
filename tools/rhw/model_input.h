// SPDX-License-Identifier: MIT
// The model that a command line names: a file, or "-", standard input, which is read to its end first.
#ifndef CLI_MODEL_INPUT_H
#define CLI_MODEL_INPUT_H

#include <stdbool.h>

#include "budget.h"
#include "memory_file.h"
#include "model.h"

/// May be copied; one of the copies is closed.
struct cli_model_input {
    const char *name;     ///< for messages
    const char *argument; ///< of the command line
    bool is_standard_input;
    struct system_memory_file memory; ///< what standard input gave
};

/// `goes_on` is asked several times a second while standard input is read; false gives it up, without a report. NULL:
/// nobody is asked. Reports failure.
bool cli_model_input_open(struct cli_model_input *input, const char *argument, bool (*goes_on)(void *user),
                          void *user);
void cli_model_input_close(struct cli_model_input *input);
/// scene_model_load within a budget; options->name, ->memory and ->confine are set here. Reports failure.
struct scene_model *cli_model_input_load(const struct cli_model_input *input, const struct cli_budget *budget,
                                         struct scene_model_options options);
/// Whether `path` is the file of the model; it would be replaced by a picture. Reports it.
bool cli_model_input_is(const struct cli_model_input *input, const char *path);

#endif
