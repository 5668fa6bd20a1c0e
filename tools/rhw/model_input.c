// SPDX-License-Identifier: MIT
// See model_input.h. Standard input goes into an anonymous file in memory, as readers want to know its size and read it
// more than once.
#include "model_input.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file.h"
#include "message.h"
#include "streams.h"

static bool write_all(int descriptor, const char *bytes, size_t size)
{
    while (size > 0) {
        const ssize_t step = write(descriptor, bytes, (unsigned)size); // of a small buffer
        if (step < 0 && errno == EINTR) {
            continue;
        }
        if (step <= 0) {
            return false;
        }
        bytes += step;
        size -= (size_t)step;
    }
    return true;
}

// Waits until there is something to read, its end too. False where nobody wants it any more.
static bool wait_for_input(bool (*goes_on)(void *user), void *user)
{
    enum { PATIENCE_MS = 50 };
    bool ready = false;
    while (goes_on && !ready && goes_on(user)) {
        ready = system_streams_have_input(PATIENCE_MS);
    }
    return !goes_on || ready;
}

// False with errno; 0: it was given up.
static bool copy_standard_input(int descriptor, bool (*goes_on)(void *user), void *user)
{
    char buffer[1 << 16];
    for (;;) {
        if (!wait_for_input(goes_on, user)) {
            errno = 0;
            return false;
        }
        const ssize_t count = read(STDIN_FILENO, buffer, sizeof buffer);
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0 || !write_all(descriptor, buffer, (size_t)count)) {
            return count == 0;
        }
    }
}

bool cli_model_input_open(struct cli_model_input *input, const char *argument, bool (*goes_on)(void *user),
                          void *user)
{
    *input = (struct cli_model_input){.name = argument, .argument = argument};
    if (strcmp(argument, "-") != 0) {
        return true;
    }
    input->name = "standard input";
    input->is_standard_input = true;
    if (!system_memory_file_open(&input->memory, "rhw-input") ||
        !copy_standard_input(fileno(input->memory.stream), goes_on, user)) {
        if (errno != 0) {
            cli_error(input->name, "cannot be read: %s", strerror(errno));
        }
        return false;
    }
    return true;
}

void cli_model_input_close(struct cli_model_input *input)
{
    system_memory_file_close(&input->memory);
}

// What to open.
static const char *path_of(const struct cli_model_input *input)
{
    return input->is_standard_input ? input->memory.path : input->argument;
}

// The folder that the model lies in, with nothing after its last slash.
static void folder_of(const struct cli_model_input *input, char folder[PATH_MAX])
{
    const char *const path = path_of(input), *const slash =
                                                 input->is_standard_input ? NULL : strrchr(path, '/');
    snprintf(folder, PATH_MAX, "%.*s", slash ? (int)(slash - path) + 1 : 1, slash ? path : ".");
}

struct scene_model *cli_model_input_load(const struct cli_model_input *input, const struct cli_budget *budget,
                                         struct scene_model_options options)
{
    char folder[PATH_MAX], error[512];
    struct stat status;
    if (!input->is_standard_input && stat(input->argument, &status) == 0 && S_ISDIR(status.st_mode)) {
        cli_error(input->name, "is a folder, and a model is wanted; rhw thumbs draws all models in a folder");
        return NULL;
    }
    folder_of(input, folder);
    // What standard input names is looked for in the current folder.
    options.name = input->is_standard_input ? "-" : NULL;
    options.memory = budget->memory;
    options.confine = !budget->is_confined ? NULL : budget->folder ? budget->folder : folder;
    cli_stage("reading", input->name);
    struct scene_model *model = scene_model_load(path_of(input), &options, error, sizeof error);
    cli_stage_end();
    if (model == NULL) {
        if (!options.goes_on || options.goes_on(options.user)) {
            cli_error(input->name, "%s", error);
        } // else who stopped it knows
        return NULL;
    }
    model->path = input->name;
    return model;
}

bool cli_model_input_is(const struct cli_model_input *input, const char *path)
{
    const bool same = system_file_is_same(path_of(input), path);
    if (same) {
        cli_error(path, "is the model itself; name another file for the picture");
    }
    return same;
}
