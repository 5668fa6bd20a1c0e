// SPDX-License-Identifier: MIT
// rhw info: what is in a model file, as the renderer will see it, and what of it will not be drawn.
#include "info_layers.h"
#include "json.h"
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

static const char *const primitive_names[] = {"triangles", "lines", "points"};
static const char *const image_type_names[] = {"RGBA8", "RGBA16", "RGBA32F"};
static const char *const alpha_names[] = {"opaque", "mask", "blend"};
static const char *const light_names[] = {"directional", "point", "spot"};
static const char *const slot_names[SCENE_SLOT_COUNT] = {
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
static const uint32_t corners[] = {3, 2, 1};

static uint32_t object_count(const struct scene_model *model)
{
    uint32_t largest = 0;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        largest = model->instances[i].object > largest ? model->instances[i].object : largest;
    }
    return largest;
}

static bool anything_drawn(const struct scene_model *model)
{
    return model->bounds_min[0] <= model->bounds_max[0];
}

static const char *use_of(const struct scene_image *image)
{
    return image->used_as_color && image->used_as_data ? "color and data"
           : image->used_as_color                      ? "color"
           : image->used_as_data                       ? "data"
                                                       : "not used";
}

// Text ----------------------------------------------------------------------------------------------

static void print_meshes(const struct scene_model *model)
{
    printf("\nmeshes: %" PRIu32 "\n", model->mesh_count);
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        const struct scene_mesh *mesh = &model->meshes[i];
        printf("  %3" PRIu32 "  %" PRIu32 " %s, %" PRIu32 " vertices, material %" PRIu32 "%s%s%s%s%s", i,
               mesh->index_count / corners[mesh->primitive], primitive_names[mesh->primitive],
               mesh->vertex_count, mesh->material, mesh->normals != NULL ? ", normals" : "",
               mesh->tangents != NULL ? ", tangents" : "", mesh->uvs[0] != NULL ? ", uv 0" : "",
               mesh->uvs[1] != NULL ? ", uv 1" : "", mesh->colors != NULL ? ", colors" : "");
        printf(mesh->name[0] != 0 ? "  \"%s\"\n" : "%s\n", mesh->name);
    }
}

static void print_layer(const char *name, const float *values, int count)
{
    printf(", %s", name);
    for (int i = 0; i < count; i++) {
        printf(" %.3g", (double)values[i]);
    }
}

static void print_materials(const struct scene_model *model)
{
    printf("\nmaterials: %" PRIu32 "\n", model->material_count);
    for (uint32_t i = 0; i < model->material_count; i++) {
        const struct scene_material *material = &model->materials[i];
        const float *color = material->base_color, *glow = material->emissive;
        printf("  %3" PRIu32 "  base %.3g %.3g %.3g %.3g, metallic %.3g, roughness %.3g", i, (double)color[0],
               (double)color[1], (double)color[2], (double)color[3], (double)material->metallic,
               (double)material->roughness);
        if (glow[0] > 0 || glow[1] > 0 || glow[2] > 0) {
            printf(", emissive %.3g %.3g %.3g", (double)glow[0], (double)glow[1], (double)glow[2]);
        }
        if (material->alpha_mode == SCENE_ALPHA_MASK) {
            printf(", mask below %.3g", (double)material->alpha_cutoff);
        }
        if (material->alpha_mode == SCENE_ALPHA_BLEND) {
            printf(", blend");
        }
        printf("%s%s", material->unlit ? ", unlit" : "", material->double_sided ? ", double-sided" : "");
        cli_info_layers(&material->layers, print_layer);
        for (int k = 0; k < SCENE_SLOT_COUNT; k++) {
            if (material->slots[k].image >= 0) {
                printf(", %s image %" PRId32, slot_names[k], material->slots[k].image);
            }
        }
        printf(material->name[0] != 0 ? "  \"%s\"\n" : "%s\n", material->name);
    }
}

static void print_images(const struct scene_model *model)
{
    if (model->image_count > 0) {
        printf("\nimages: %" PRIu32 "\n", model->image_count);
    }
    for (uint32_t i = 0; i < model->image_count; i++) {
        const struct scene_image *image = &model->images[i];
        printf("  %3" PRIu32 "  %" PRIu32 "x%" PRIu32 " %s%s, %s%s  \"%s\"\n", i, image->width, image->height,
               image_type_names[image->type], image->has_alpha ? " with alpha" : "", use_of(image),
               image->missing ? ", missing" : "", image->name);
    }
}

static void print_cameras_and_lights(const struct scene_model *model)
{
    if (model->camera_count > 0) {
        printf("\ncameras: %" PRIu32 "\n", model->camera_count);
    }
    for (uint32_t i = 0; i < model->camera_count; i++) {
        const struct scene_model_camera *camera = &model->cameras[i];
        const float *eye = camera->world + 12;
        printf("  %3" PRIu32 "  at %.4g %.4g %.4g, ", i, (double)eye[0], (double)eye[1], (double)eye[2]);
        if (camera->orthographic) {
            printf("orthographic %.4g x %.4g", 2 * (double)camera->xmag, 2 * (double)camera->ymag);
        } else {
            printf("perspective, fovy %.4g degrees", (double)camera->yfov * 57.29577951308232);
        }
        printf(", near %.4g, far %.4g  \"%s\"\n", (double)camera->znear, (double)camera->zfar, camera->name);
    }
    if (model->light_count > 0) {
        printf("\nlights: %" PRIu32 "\n", model->light_count);
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        const struct scene_model_light *light = &model->lights[i];
        printf("  %3" PRIu32 "  %s, color %.3g %.3g %.3g, intensity %.4g  \"%s\"\n", i,
               light_names[light->type], (double)light->color[0], (double)light->color[1],
               (double)light->color[2], (double)light->intensity, light->name);
    }
}

static void print_lines(const char *title, const char **lines, uint32_t count)
{
    if (count > 0) {
        printf("\n%s:\n", title);
    }
    for (uint32_t i = 0; i < count; i++) {
        printf("  %s\n", lines[i]);
    }
}

static void print_text(const struct scene_model *model)
{
    const float *least = model->bounds_min, *most = model->bounds_max;
    printf("%s: %s\n\n", model->path, model->format);
    printf("triangles: %" PRIu64 " drawn, %" PRIu64 " stored\n", model->triangles_drawn,
           model->triangles_stored);
    printf("objects:   %" PRIu32 " (%" PRIu32 " draws)\n", object_count(model), model->instance_count);
    if (anything_drawn(model)) {
        printf("bounds:    %.6g %.6g %.6g to %.6g %.6g %.6g\n", (double)least[0], (double)least[1],
               (double)least[2], (double)most[0], (double)most[1], (double)most[2]);
    } else {
        printf("bounds:    none, there is nothing to draw\n");
    }
    print_meshes(model);
    print_materials(model);
    print_images(model);
    print_cameras_and_lights(model);
    print_lines("variants", model->variants, model->variant_count);
    print_lines("warnings", model->warnings, model->warning_count);
    print_lines("not supported", model->unsupported, model->unsupported_count);
}

// JSON ----------------------------------------------------------------------------------------------

// Elements of an array are separated by commas; `index` is that of the element that follows.
static void json_next(uint32_t index)
{
    printf("%s\n    ", index > 0 ? "," : "");
}

static void json_named(const char *name)
{
    printf("{\"name\": ");
    cli_json_string(stdout, name);
}

static void json_floats(const char *key, const float *values, int count)
{
    printf(", \"%s\": [", key);
    for (int i = 0; i < count; i++) {
        printf(i > 0 ? ", " : "");
        cli_json_number(stdout, (double)values[i]);
    }
    printf("]");
}

static void json_float(const char *key, float value)
{
    printf(", \"%s\": ", key);
    cli_json_number(stdout, (double)value);
}

static void json_flag(const char *key, bool value)
{
    printf(", \"%s\": %s", key, value ? "true" : "false");
}

static void json_meshes(const struct scene_model *model)
{
    printf(",\n  \"meshes\": [");
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        const struct scene_mesh *mesh = &model->meshes[i];
        json_next(i);
        json_named(mesh->name);
        printf(", \"primitive\": \"%s\", \"count\": %" PRIu32 ", \"vertices\": %" PRIu32
               ", \"material\": %" PRIu32,
               primitive_names[mesh->primitive], mesh->index_count / corners[mesh->primitive],
               mesh->vertex_count, mesh->material);
        json_flag("normals", mesh->normals != NULL);
        json_flag("tangents", mesh->tangents != NULL);
        json_flag("uv0", mesh->uvs[0] != NULL);
        json_flag("uv1", mesh->uvs[1] != NULL);
        json_flag("colors", mesh->colors != NULL);
        printf("}");
    }
    printf("]");
}

static void json_layer(const char *name, const float *values, int count)
{
    if (count == 1) {
        json_float(name, *values);
    } else {
        json_floats(name, values, count);
    }
}

static void json_materials(const struct scene_model *model)
{
    printf(",\n  \"materials\": [");
    for (uint32_t i = 0; i < model->material_count; i++) {
        const struct scene_material *material = &model->materials[i];
        json_next(i);
        json_named(material->name);
        json_floats("base_color", material->base_color, 4);
        json_float("metallic", material->metallic);
        json_float("roughness", material->roughness);
        json_floats("emissive", material->emissive, 3);
        printf(", \"alpha_mode\": \"%s\"", alpha_names[material->alpha_mode]);
        json_float("alpha_cutoff", material->alpha_cutoff);
        json_flag("unlit", material->unlit);
        json_flag("double_sided", material->double_sided);
        cli_info_layers(&material->layers, json_layer);
        for (int k = 0; k < SCENE_SLOT_COUNT; k++) {
            if (material->slots[k].image >= 0) {
                printf(", \"%s_image\": %" PRId32, slot_names[k], material->slots[k].image);
            }
        }
        printf("}");
    }
    printf("]");
}

static void json_images(const struct scene_model *model)
{
    printf(",\n  \"images\": [");
    for (uint32_t i = 0; i < model->image_count; i++) {
        const struct scene_image *image = &model->images[i];
        json_next(i);
        json_named(image->name);
        printf(", \"width\": %" PRIu32 ", \"height\": %" PRIu32 ", \"type\": \"%s\"", image->width,
               image->height, image_type_names[image->type]);
        json_flag("alpha", image->has_alpha);
        json_flag("missing", image->missing);
        json_flag("color", image->used_as_color);
        json_flag("data", image->used_as_data);
        printf("}");
    }
    printf("]");
}

static void json_cameras(const struct scene_model *model)
{
    printf(",\n  \"cameras\": [");
    for (uint32_t i = 0; i < model->camera_count; i++) {
        const struct scene_model_camera *camera = &model->cameras[i];
        json_next(i);
        json_named(camera->name);
        printf(", \"type\": \"%s\"", camera->orthographic ? "orthographic" : "perspective");
        if (camera->orthographic) {
            json_float("xmag", camera->xmag);
            json_float("ymag", camera->ymag);
        } else {
            json_float("fovy_degrees", (float)((double)camera->yfov * 57.29577951308232));
        }
        json_float("near", camera->znear);
        json_float("far", camera->zfar);
        json_floats("world", camera->world, 16);
        printf("}");
    }
    printf("]");
}

static void json_lights(const struct scene_model *model)
{
    printf(",\n  \"lights\": [");
    for (uint32_t i = 0; i < model->light_count; i++) {
        const struct scene_model_light *light = &model->lights[i];
        json_next(i);
        json_named(light->name);
        printf(", \"type\": \"%s\"", light_names[light->type]);
        json_floats("position", light->position, 3);
        json_floats("direction", light->direction, 3);
        json_floats("color", light->color, 3);
        json_float("intensity", light->intensity);
        json_float("range", light->range);
        printf("}");
    }
    printf("]");
}

static void json_lines(const char *key, const char **lines, uint32_t count)
{
    printf(",\n  \"%s\": [", key);
    for (uint32_t i = 0; i < count; i++) {
        json_next(i);
        cli_json_string(stdout, lines[i]);
    }
    printf("]");
}

static void print_json(const struct scene_model *model)
{
    printf("{\n  \"file\": ");
    cli_json_string(stdout, model->path);
    printf(",\n  \"format\": ");
    cli_json_string(stdout, model->format);
    printf(",\n  \"triangles_drawn\": %" PRIu64 ",\n  \"triangles_stored\": %" PRIu64
           ",\n  \"objects\": %" PRIu32 ",\n  \"draws\": %" PRIu32,
           model->triangles_drawn, model->triangles_stored, object_count(model), model->instance_count);
    printf(",\n  \"bounds\": ");
    if (anything_drawn(model)) {
        printf("{\"empty\": false");
        json_floats("min", model->bounds_min, 3);
        json_floats("max", model->bounds_max, 3);
        printf("}");
    } else {
        printf("{\"empty\": true}");
    }
    json_meshes(model);
    json_materials(model);
    json_images(model);
    json_cameras(model);
    json_lights(model);
    json_lines("variants", model->variants, model->variant_count);
    json_lines("warnings", model->warnings, model->warning_count);
    json_lines("unsupported", model->unsupported, model->unsupported_count);
    printf("\n}\n");
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
        print_json(model);
    } else {
        print_text(model);
    }
    scene_model_free(model);
    return CLI_OK; // main sees whether stdout took it
}
