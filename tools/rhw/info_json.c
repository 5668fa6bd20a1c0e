// SPDX-License-Identifier: MIT
// rhw info for programs; see info_print.h.
#include "info_layers.h"
#include "info_print.h"
#include "json.h"
#include "render_job.h"

#include <inttypes.h>
#include <stdio.h>

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

static void json_place(const struct scene_model *model, const float floats[3], const double exact[3])
{
    double place[3];
    const bool is_far = cli_info_find_place(model, floats, exact, place);
    for (int c = 0; c < 3; c++) {
        printf(c > 0 ? ", " : "");
        (is_far ? cli_json_double : cli_json_number)(stdout, place[c]);
    }
}

// Write the matrix of a camera, whose last column is a place.
static void json_world(const struct scene_model *model, const struct scene_model_camera *camera)
{
    printf(", \"world\": [");
    for (int i = 0; i < 12; i++) {
        cli_json_number(stdout, (double)camera->world[i]);
        printf(", ");
    }
    json_place(model, camera->world + 12, camera->place);
    printf(", ");
    cli_json_number(stdout, (double)camera->world[15]);
    printf("]");
}

// Write a corner of a box, in the coordinates of the file.
static void json_corner(const struct scene_model *model, const char *key, const float corner[3])
{
    printf(", \"%s\": [", key);
    for (int c = 0; c < 3; c++) {
        printf(c > 0 ? ", " : "");
        if (scene_origin_is_far(model->origin)) {
            printf("%.*g", cli_info_digits(model, 9), (double)corner[c] + model->origin[c]);
        } else {
            cli_json_number(stdout, (double)corner[c]);
        }
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
               cli_primitive_names[mesh->primitive], cli_info_elements(mesh), mesh->vertex_count,
               mesh->material);
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

static void json_sampler(const char *name, const struct scene_texture_slot *slot)
{
    printf(
        ", \"%s_sampler\": {\"min\": \"%s\", \"mag\": \"%s\", \"mip\": \"%s\", \"u\": \"%s\", \"v\": \"%s\"}",
        name, cli_filter_names[slot->min_filter], cli_filter_names[slot->mag_filter],
        cli_mip_filter_names[slot->mip_filter], cli_address_names[slot->address_u],
        cli_address_names[slot->address_v]);
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
        printf(", \"alpha_mode\": \"%s\"", cli_alpha_names[material->alpha_mode]);
        json_float("alpha_cutoff", material->alpha_cutoff);
        json_flag("unlit", material->unlit);
        json_flag("double_sided", material->double_sided);
        cli_info_layers(&material->layers, json_layer);
        for (int k = 0; k < SCENE_SLOT_COUNT; k++) {
            if (material->slots[k].image >= 0) {
                printf(", \"%s_image\": %" PRId32, cli_slot_names[k], material->slots[k].image);
                json_sampler(cli_slot_names[k], &material->slots[k]);
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
               image->height, cli_image_type_names[image->type]);
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
        json_world(model, camera);
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
        printf(", \"type\": \"%s\"", cli_light_names[light->type]);
        printf(", \"position\": [");
        json_place(model, light->position, light->place);
        printf("]");
        json_floats("direction", light->direction, 3);
        json_floats("color", light->color, 3);
        json_float("intensity", light->intensity);
        json_float("range", light->range);
        printf("}");
    }
    printf("]");
}

static void json_animations(const struct scene_model *model)
{
    printf(",\n  \"animations\": [");
    for (uint32_t i = 0; i < model->animation_count; i++) {
        json_next(i);
        json_named(model->animations[i].name);
        json_float("seconds", model->animations[i].seconds);
        printf(", \"channels\": %" PRIu32 "}", model->animations[i].channel_count);
    }
    printf("]");
}

static void json_extensions(const struct scene_model *model)
{
    printf(",\n  \"extensions\": [");
    for (uint32_t i = 0; i < model->extension_count; i++) {
        json_next(i);
        json_named(model->extensions[i].name);
        json_flag("required", model->extensions[i].is_required);
        json_flag("drawn", model->extensions[i].is_drawn);
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

static void json_box(const struct scene_model *model, const char *key, const float low[3],
                     const float high[3])
{
    printf(",\n  \"%s\": ", key);
    if (cli_info_draws_anything(model)) {
        printf("{\"empty\": false");
        json_corner(model, "min", low);
        json_corner(model, "max", high);
        printf("}");
    } else {
        printf("{\"empty\": true}");
    }
}

void cli_info_print_json(const struct scene_model *model)
{
    printf("{\n  \"file\": ");
    cli_json_string(stdout, model->path);
    printf(",\n  \"format\": ");
    cli_json_string(stdout, model->format);
    printf(",\n  \"triangles_drawn\": %" PRIu64 ",\n  \"triangles_stored\": %" PRIu64
           ",\n  \"objects\": %" PRIu32 ",\n  \"draws\": %" PRIu32,
           model->triangles_drawn, model->triangles_stored, cli_info_objects(model), model->instance_count);
    // Numbers of double have all their digits, as the origin is to be subtracted from what is large.
    printf(",\n  \"origin\": [%.17g, %.17g, %.17g]", model->origin[0], model->origin[1], model->origin[2]);
    const bool is_framed = model->is_framed;
    json_box(model, "bounds", model->bounds_min, model->bounds_max);
    json_box(model, "frame", is_framed ? model->frame_min : model->bounds_min,
             is_framed ? model->frame_max : model->bounds_max);
    printf(",\n  \"unit\": ");
    cli_json_string(stdout, model->unit);
    printf(",\n  \"up\": \"%s\",\n  \"up_from\": \"%s\",\n  \"mesh_bytes\": %" PRIu64
           ",\n  \"texture_bytes\": %" PRIu64,
           cli_axis_names[model->up], model->up_guessed ? "shape" : "format", cli_info_mesh_bytes(model),
           cli_info_texture_bytes(model));
    json_meshes(model);
    json_materials(model);
    json_images(model);
    json_cameras(model);
    json_lights(model);
    json_animations(model);
    json_extensions(model);
    json_lines("variants", model->variants, model->variant_count);
    json_lines("warnings", model->warnings, model->warning_count);
    json_lines("unsupported", model->unsupported, model->unsupported_count);
    printf("\n}\n");
}
