// SPDX-License-Identifier: MIT
// Reading a model file in an instance of the module that does nothing else; the part of import_process.c's child.
#include "import.h"
#include "import_blob.h"
#include "web_module.h"

#include <emscripten.h>
#include <stdarg.h>
#include <stdlib.h>

enum { EXIT_MODEL = 0, EXIT_MESSAGE = 3 };

_Noreturn static void end_with(FILE *reply, int status)
{
    fclose(reply);
    exit(status);
}

_Noreturn void scene_import_fail(struct scene_import *import, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(import->reply, format, arguments);
    va_end(arguments);
    end_with(import->reply, EXIT_MESSAGE);
}

EMSCRIPTEN_KEEPALIVE int web_read(char *words, size_t size)
{
    struct cli_render_job job;
    FILE *const reply = fopen(WEB_REPLY, "wb");
    web_messages_clear();
    if (!reply || !web_job_parse(&job, words, size)) {
        return EXIT_MESSAGE; // web_messages has it
    }
    struct scene_import import = {.read = scene_import_read,
                                  .model.path = job.model_path,
                                  .model.unit = "",
                                  .name = job.model_path,
                                  .variant = job.variant,
                                  .texture_side = job.budget.texture,
                                  .animation = job.animation,
                                  .time = job.time,
                                  .is_posed = job.is_posed,
                                  .reply = reply};
    scene_import_run(&import);
    if (!scene_blob_write(&import.model, reply)) {
        scene_import_fail(&import, "there is not enough memory for the model");
    }
    end_with(reply, EXIT_MODEL);
}
