// SPDX-License-Identifier: MIT
// Reading a model file in an instance of the module that does nothing else; the part of the child of reader_process.c.
#include "import/blob.h"
#include "import/finish/finish.h"
#include "import/kind.h"
#include "message.h"
#include "message_line.h"
#include "web_module.h"

#include <emscripten.h>
#include <stdio.h>
#include <stdlib.h>

enum { EXIT_MODEL = 0, EXIT_MESSAGE = 3 };

// The message does not go into the file, which may have part of a model, or no room.
static void leave(struct scene_import *import, const char *line)
{
    cli_error(import->name, "%s", line);
    exit(EXIT_MESSAGE);
}

EMSCRIPTEN_KEEPALIVE int web_read(char *words, size_t size)
{
    struct cli_render_job job;
    FILE *const reply = fopen(WEB_REPLY, "wb");
    web_messages_clear();
    if (!reply || !web_job_parse(&job, words, size)) {
        return EXIT_MESSAGE;
    }
    struct scene_import import = {.read = scene_import_read,
                                  .leave = leave,
                                  .model.path = job.model_path,
                                  .model.unit = "",
                                  .name = job.model_path,
                                  .variant = job.variant,
                                  .texture_side = job.budget.texture,
                                  .animation = job.animation,
                                  .time = job.time,
                                  .is_posed = job.is_posed};
    scene_import_run(&import);
    const bool written = scene_blob_write(&import.model, reply);
    if (fclose(reply) != 0 || !written) {
        scene_import_fail(&import, "there is not enough memory for the model");
    }
    exit(EXIT_MODEL);
}
