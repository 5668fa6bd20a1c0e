// SPDX-License-Identifier: MIT
// rhw info: what is in a model file, as the renderer will see it, and what of it will not be drawn.
#include "info_print.h"
#include "message.h"
#include "model_input.h"
#include "options.h"
#include "verbs.h"

enum { OPTION_JSON = 256 };

static const struct cli_option options[] = {
    {"json", OPTION_JSON, NULL, "print everything as JSON"},
};

static const char notes[] =
    "Triangles are counted as stored in the meshes and as drawn, where a mesh may stand in several places.\n"
    "Bounds are those of everything drawn, in the world.\n\n"
    "Exit status: 0, 1 when the file cannot be read, 2 for a wrong command line.";

static const struct cli_verb verb = {
    .name = "info",
    .operands = "MODEL",
    .summary = "Tells what is in a model file ('-': standard input) and what of it is not drawn.",
    .options = options,
    .option_count = (int)(sizeof options / sizeof *options),
    .notes = notes,
};

int cli_info(int argc, char **argv)
{
    struct cli_parser parser;
    bool json = false;
    cli_parser_start(&parser, &verb, argc, argv);
    int id;
    while ((id = cli_parser_next(&parser)) > 0) {
        json = json || id == OPTION_JSON;
    }
    if (id == CLI_OPTION_STOP) {
        return parser.status;
    }
    if (!cli_parser_operands(&parser, 1, 1)) {
        return CLI_USAGE;
    }

    struct cli_model_input input;
    struct scene_model *model = NULL;
    if (cli_model_input_open(&input, parser.operands[0], NULL, NULL)) {
        const struct cli_budget unlimited = {0};
        model = cli_model_input_load(&input, &unlimited, (struct scene_model_options){0});
    }
    cli_model_input_close(&input);
    if (model == NULL) {
        return CLI_FAILED;
    }
    if (json) {
        cli_info_print_json(model);
    } else {
        cli_info_print_text(model);
    }
    scene_model_free(model);
    return CLI_OK; // main sees whether stdout took it
}
