// SPDX-License-Identifier: MIT
// rhw info for people; see info_print.h.
#include "info_layers.h"
#include "info_print.h"
#include "render_job.h"

#include <inttypes.h>
#include <stdio.h>

static const char *use_of(const struct scene_image *image)
{
    return image->used_as_color && image->used_as_data ? "color and data"
           : image->used_as_color                      ? "color"
           : image->used_as_data                       ? "data"
                                                       : "not used";
}

static void print_meshes(const struct scene_model *model)
{
    printf("\nmeshes: %" PRIu32 "\n", model->mesh_count);
    for (uint32_t i = 0; i < model->mesh_count; i++) {
        const struct scene_mesh *mesh = &model->meshes[i];
        printf("  %3" PRIu32 "  %" PRIu32 " %s, %" PRIu32 " vertices, material %" PRIu32 "%s%s%s%s%s", i,
               cli_info_elements(mesh), cli_primitive_names[mesh->primitive], mesh->vertex_count,
               mesh->material, mesh->normals != NULL ? ", normals" : "",
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

// How its texels are read, where that is not linear and repeating.
static void print_sampler(const struct scene_texture_slot *slot)
{
    const bool near = slot->mag_filter == RHW_FILTER_NEAREST, far = slot->min_filter == RHW_FILTER_NEAREST;
    const bool alike = slot->address_u == slot->address_v;
    char apart[48];
    snprintf(apart, sizeof apart, "u %s, v %s", cli_address_names[slot->address_u],
             cli_address_names[slot->address_v]);
    const char *const words[] = {near && far ? "nearest"
                                 : near      ? "nearest when enlarged"
                                 : far       ? "nearest when reduced"
                                             : NULL,
                                 slot->mip_filter == RHW_MIP_FILTER_NONE      ? "no mip levels"
                                 : slot->mip_filter == RHW_MIP_FILTER_NEAREST ? "nearest mip level"
                                                                              : NULL,
                                 !alike                                  ? apart
                                 : slot->address_u != RHW_ADDRESS_REPEAT ? cli_address_names[slot->address_u]
                                                                         : NULL};
    const char *before = " (";
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (words[i]) {
            printf("%s%s", before, words[i]);
            before = ", ";
        }
    }
    printf("%s", before[0] == ',' ? ")" : "");
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
                printf(", %s image %" PRId32, cli_slot_names[k], material->slots[k].image);
                print_sampler(&material->slots[k]);
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
               cli_image_type_names[image->type], image->has_alpha ? " with alpha" : "", use_of(image),
               image->missing ? ", missing" : "", image->name);
    }
}

// Print a place in the coordinates of the file, with so many digits, or with all that a place far from the origin has.
static void print_place(const struct scene_model *model, const float place[3], int digits)
{
    for (int c = 0; c < 3; c++) {
        printf(" %.*g", cli_info_digits(model, digits), (double)place[c] + model->origin[c]);
    }
}

static void print_camera_place(const struct scene_model *model, const struct scene_model_camera *camera)
{
    double place[3];
    const bool is_far = cli_info_find_place(model, camera->world + 12, camera->place, place);
    for (int c = 0; c < 3; c++) {
        printf(" %.*g", is_far ? 15 : 4, place[c]);
    }
}

static void print_cameras_and_lights(const struct scene_model *model)
{
    if (model->camera_count > 0) {
        printf("\ncameras: %" PRIu32 "\n", model->camera_count);
    }
    for (uint32_t i = 0; i < model->camera_count; i++) {
        const struct scene_model_camera *camera = &model->cameras[i];
        printf("  %3" PRIu32 "  at", i);
        print_camera_place(model, camera);
        printf(", ");
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
               cli_light_names[light->type], (double)light->color[0], (double)light->color[1],
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

static void print_animations(const struct scene_model *model)
{
    if (model->animation_count > 0) {
        printf("\nanimations: %" PRIu32 "\n", model->animation_count);
    }
    for (uint32_t i = 0; i < model->animation_count; i++) {
        const struct scene_model_animation *animation = &model->animations[i];
        printf("  %3" PRIu32 "  %.4g s, %" PRIu32 " channels  \"%s\"\n", i, (double)animation->seconds,
               animation->channel_count, animation->name);
    }
}

static void print_extensions(const struct scene_model *model)
{
    if (model->extension_count > 0) {
        printf("\nextensions: %" PRIu32 "\n", model->extension_count);
    }
    for (uint32_t i = 0; i < model->extension_count; i++) {
        const struct scene_model_extension *extension = &model->extensions[i];
        printf("  %s: %s%s\n", extension->name, extension->is_required ? "required, " : "",
               extension->is_drawn ? "drawn" : "ignored");
    }
}

static double mebibytes(uint64_t bytes)
{
    return (double)bytes / 1048576.0;
}

void cli_info_print_text(const struct scene_model *model)
{
    const float *least = model->bounds_min, *most = model->bounds_max;
    printf("%s: %s\n\n", model->path, model->format);
    printf("triangles: %" PRIu64 " drawn, %" PRIu64 " stored\n", model->triangles_drawn,
           model->triangles_stored);
    printf("objects:   %" PRIu32 " (%" PRIu32 " draws)\n", cli_info_objects(model), model->instance_count);
    if (cli_info_draws_anything(model)) {
        printf("bounds:   ");
        print_place(model, least, 6);
        printf(" to");
        print_place(model, most, 6);
        printf("\n");
        printf("size:      %.6g x %.6g x %.6g\n", (double)most[0] - (double)least[0],
               (double)most[1] - (double)least[1], (double)most[2] - (double)least[2]);
        if (model->is_framed) {
            printf("framed:   ");
            print_place(model, model->frame_min, 6);
            printf(" to");
            print_place(model, model->frame_max, 6);
            printf("\n");
        }
    } else {
        printf("bounds:    none, there is nothing to draw\n");
    }
    if (model->unit[0] != 0) {
        printf("unit:      %s\n", model->unit);
    }
    printf("up:        %s, %s\n", cli_axis_names[model->up],
           model->up_guessed ? "by its shape" : "by its format");
    printf("memory:    %.1f MiB of meshes, %.1f MiB of textures\n", mebibytes(cli_info_mesh_bytes(model)),
           mebibytes(cli_info_texture_bytes(model)));
    print_meshes(model);
    print_materials(model);
    print_images(model);
    print_cameras_and_lights(model);
    print_animations(model);
    print_extensions(model);
    print_lines("variants", model->variants, model->variant_count);
    print_lines("warnings", model->warnings, model->warning_count);
    print_lines("not supported", model->unsupported, model->unsupported_count);
}
