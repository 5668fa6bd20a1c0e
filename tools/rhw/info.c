// SPDX-License-Identifier: MIT
// rhw info: what is in a model file, as the renderer will see it, and what of it will not be drawn.
#include "info_print.h"
#include "message.h"
#include "model_input.h"
#include "options.h"
#include "verbs.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

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

const char *const cli_primitive_names[] = {"triangles", "lines", "points"};
const char *const cli_image_type_names[] = {"RGBA8", "RGBA16", "RGBA32F"};
const char *const cli_alpha_names[] = {"opaque", "mask", "blend"};
const char *const cli_light_names[] = {"directional", "point", "spot"};
const char *const cli_slot_names[SCENE_SLOT_COUNT] = {
    [SCENE_SLOT_BASE_COLOR] = "base_color",
    [SCENE_SLOT_METALLIC_ROUGHNESS] = "metallic_roughness",
    [SCENE_SLOT_NORMAL] = "normal",
    [SCENE_SLOT_OCCLUSION] = "occlusion",
    [SCENE_SLOT_EMISSIVE] = "emissive",
    [SCENE_SLOT_CLEARCOAT] = "clearcoat",
    [SCENE_SLOT_CLEARCOAT_ROUGHNESS] = "clearcoat_roughness",
    [SCENE_SLOT_CLEARCOAT_NORMAL] = "clearcoat_normal",
    [SCENE_SLOT_SHEEN_COLOR] = "sheen_color",
    [SCENE_SLOT_SHEEN_ROUGHNESS] = "sheen_roughness",
    [SCENE_SLOT_SPECULAR] = "specular",
    [SCENE_SLOT_SPECULAR_COLOR] = "specular_color",
    [SCENE_SLOT_TRANSMISSION] = "transmission",
    [SCENE_SLOT_THICKNESS] = "thickness",
    [SCENE_SLOT_ANISOTROPY] = "anisotropy",
    [SCENE_SLOT_IRIDESCENCE] = "iridescence",
    [SCENE_SLOT_IRIDESCENCE_THICKNESS] = "iridescence_thickness",
    [SCENE_SLOT_GLOSS] = "specular_glossiness",
};

uint32_t cli_info_objects(const struct scene_model *model)
{
    uint32_t largest = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        largest = model->instances[i].object > largest ? model->instances[i].object : largest;
    }
    return largest;
}

uint32_t cli_info_elements(const struct scene_mesh *mesh)
{
    static const uint32_t corners[] = {3, 2, 1};
    return mesh->index_count / corners[mesh->primitive];
}

bool cli_info_draws_anything(const struct scene_model *model)
{
    return model->bounds_min[0] <= model->bounds_max[0];
}

uint64_t cli_info_mesh_bytes(const struct scene_model *model)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        const struct scene_mesh *const mesh = &model->meshes[i];
        const uint64_t vertex = 12u + (mesh->normals ? 12u : 0u) + (mesh->tangents ? 16u : 0u) +
                                (mesh->colors ? 16u : 0u) + (mesh->uvs[0] ? 8u : 0u) +
                                (mesh->uvs[1] ? 8u : 0u);
        sum += mesh->vertex_count * vertex + (uint64_t)mesh->index_count * sizeof *mesh->indices;
    }
    return sum;
}

uint64_t cli_info_texture_bytes(const struct scene_model *model)
{
    uint64_t sum = 0;
    for (uint32_t i = 0; i < model->image_count; i++) {
        const struct scene_image *const image = &model->images[i];
        const uint64_t texel = image->type == SCENE_IMAGE_RGBA8 ? 4 : 16;
        const uint64_t uses = (uint64_t)image->used_as_color + (uint64_t)image->used_as_data;
        sum += (uint64_t)image->width * image->height * texel * uses * 4 / 3; // a mip chain adds a third
    }
    return sum;
}

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
    if (cli_model_input_open(&input, parser.operands[0])) {
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
