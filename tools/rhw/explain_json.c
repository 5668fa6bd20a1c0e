// SPDX-License-Identifier: MIT
// The same for programs; see explain_write.h.
#include "exact_weights.h"
#include "explain_write.h"
#include "info_print.h"
#include "json.h"

#include <inttypes.h>
#include <stdio.h>

static void print_name(const char *name)
{
    printf(", ");
    cli_json_string(stdout, name);
    printf(": ");
}

// Seventeen digits, which give a double back.
static void print_doubles(const char *name, const double *numbers, int count)
{
    print_name(name);
    printf("[");
    for (int i = 0; i < count; i++) {
        printf("%s%.17g", i ? ", " : "", numbers[i]);
    }
    printf("]");
}

static void print_floats(const char *name, const float *numbers, int count)
{
    print_name(name);
    printf("[");
    for (int i = 0; i < count; i++) {
        printf(i ? ", " : "");
        cli_json_number(stdout, (double)numbers[i]);
    }
    printf("]");
}

static void print_exact(const struct cli_past_fragment *past, const struct cli_exact_weights *w)
{
    const struct rhw_explained_fragment *const f = &past->told;
    if (w->is_snapped) {
        printf(",\n   \"edges\": [%" PRId64 ", %" PRId64 ", %" PRId64 "], \"sum\": %" PRId64, w->edge[0],
               w->edge[1], w->edge[2], w->sum);
    }
    const double screen[3] = {mpq_get_d(w->screen[0]), mpq_get_d(w->screen[1]), mpq_get_d(w->screen[2])};
    const double space[3] = {mpq_get_d(w->space[0]), mpq_get_d(w->space[1]), mpq_get_d(w->space[2])};
    const double inverse_w = mpq_get_d(w->inverse_w);
    print_doubles("screen_exact", screen, 3);
    print_doubles("inverse_w_exact", &inverse_w, 1);
    print_doubles("space_exact", space, 3);
    printf(",\n   \"varyings\": [");
    for (int i = 0; i < f->component_count; i++) {
        char name[SCENE_COMPONENT_NAME];
        struct cli_three_ways ways;
        cli_exact_component(w, f, i, &ways);
        scene_component_name(&past->drawn.surface, i, name);
        printf("%s\n    {\"name\": ", i ? "," : "");
        cli_json_string(stdout, name);
        const float vertices[3] = {f->vertex_varyings[0][i], f->vertex_varyings[1][i],
                                   f->vertex_varyings[2][i]};
        print_floats("vertices", vertices, 3);
        printf(", \"naive\": ");
        cli_json_number(stdout, ways.naive);
        printf(", \"exact\": ");
        cli_json_number(stdout, ways.exact);
        printf(", \"pipeline\": ");
        cli_json_number(stdout, (double)ways.written);
        printf(", \"error_ulp\": ");
        cli_json_number(stdout, ways.error);
        printf("}");
    }
    printf("]");
}

// Of the finer level and, where the level has a fraction, of the next.
static void print_texels(const struct scene_texture_look *look)
{
    const int levels = look->level > (float)(int)look->level ? 2 : 1;
    printf(", \"texels\": [");
    for (int i = 0; i < 4 * levels; i++) {
        printf("%s[", i == 0 ? "[" : i % 4 == 0 ? "], [" : ", ");
        for (int c = 0; c < 4; c++) {
            printf(c ? ", " : "");
            cli_json_number(stdout, (double)look->texels[i / 4][i % 4][c]);
        }
        printf("]");
    }
    printf("]]");
}

static void print_textures(const struct cli_past_fragment *past, const struct scene_model *model)
{
    const struct scene_material *const material = cli_history_material(past, model);
    printf(",\n   \"textures\": [");
    for (int i = 0; i < past->look_count; i++) {
        const struct scene_texture_look *const look = &past->looks[i];
        printf("%s\n    {\"slot\": \"%s\", \"level\": ", i ? "," : "", scene_slot_name(look->slot));
        cli_json_number(stdout, (double)look->level);
        printf(", \"level_size\": [%d, %d]", look->width, look->height);
        printf(", \"base_size\": [%d, %d], \"lod\": ", look->base_width, look->base_height);
        cli_json_number(stdout, (double)look->lod);
        print_floats("uv", look->uv, 2);
        print_floats("uv_dx", look->step[0], 2);
        print_floats("uv_dy", look->step[1], 2);
        print_floats("place", look->place, 2);
        if (material) {
            const struct cli_texture_place place = cli_texture_place(look, &material->slots[look->slot]);
            printf(", \"address\": [\"%s\", \"%s\"]", cli_address_names[place.address[0]],
                   cli_address_names[place.address[1]]);
            print_doubles("inside", place.inside, 2);
            printf(", \"filter\": \"%s\"", cli_filter_names[place.filter]);
        }
        print_floats("texel", look->texel, 4);
        print_texels(look);
        printf("}");
    }
    printf("]");
}

static void print_light(const struct scene_light_looks *looks)
{
    if (!looks->is_lit) {
        printf(",\n   \"light\": null");
        return;
    }
    printf(",\n   \"light\": {\"normal_mapped\": %s", looks->is_mapped ? "true" : "false");
    print_floats("normal", looks->normal, 3);
    print_floats("sum", looks->sum, 3);
    printf(", \"ambient_open\": ");
    cli_json_number(stdout, looks->has_occlusion ? (double)looks->around : 1.0);
    printf(", \"lights\": [");
    for (int i = 0; i < looks->count; i++) {
        const struct scene_light_look *const light = &looks->lights[i];
        printf("%s\n    {\"type\": \"%s\", \"n_dot_l\": ", i ? "," : "", cli_light_names[light->type]);
        cli_json_number(stdout, (double)light->n_dot_l);
        print_floats("direction", light->direction, 3);
        printf(", \"has_shadows\": %s, \"open\": ", light->has_shadows ? "true" : "false");
        cli_json_number(stdout, (double)light->open);
        print_floats("facing", light->facing, 3);
        print_floats("arrives", light->arrives, 3);
        printf("}");
    }
    printf("]}");
}

static void print_fragment(const struct cli_explanation *e, const struct cli_past_fragment *past)
{
    static const char *const fates[] = {"failed_early", "discarded", "failed_late", "written"};
    const struct rhw_explained_fragment *const f = &past->told;
    struct cli_exact_weights weights;
    printf("{\"draw\": %" PRIu32 ", \"instance\": %d, \"node\": ", f->draw, past->drawn.instance);
    cli_json_string(stdout, cli_history_subject(past, e->model));
    printf(", \"triangle\": %" PRIu32 ", \"front_facing\": %s, \"fate\": \"%s\", \"covered\": %" PRIu32
           ",\n   \"depth\": ",
           f->primitive, f->front_facing ? "true" : "false", fates[f->fate], f->covered);
    cli_json_number(stdout, (double)f->depth);
    print_floats("depth_before_after", (const float[]){f->depth_before, f->depth_after}, 2);
    print_floats("color_before", f->color_before[0], 4);
    print_floats("color_after", f->color_after[0], 4);
    if (f->is_shaded) {
        print_floats("output", f->output[0], 4);
    }
    printf(",\n   \"clip\": [");
    for (int i = 0; i < 3; i++) {
        printf("%s[", i ? ", " : "");
        for (int c = 0; c < 4; c++) {
            printf(c ? ", " : "");
            cli_json_number(stdout, (double)f->position[i][c]);
        }
        printf("]");
    }
    printf("], \"clipped\": %s", f->is_clipped ? "true" : "false");
    if (f->is_snapped) {
        printf(", \"snapped\": [[%d, %d], [%d, %d], [%d, %d]]", f->x[0], f->y[0], f->x[1], f->y[1], f->x[2],
               f->y[2]);
    }
    printf(", \"sample\": [%d, %d]", f->sample_x, f->sample_y);
    if (f->is_shaded) {
        double at[2];
        cli_explained_place(f, at);
        print_doubles("at", at, 2);
        print_doubles("screen", f->screen, 3);
        print_doubles("inverse_w", &f->inverse_w, 1);
        print_floats("space", f->weights, 3);
    }
    print_textures(past, e->model);
    print_light(&past->light);
    if (past->drawn.instance != SCENE_DRAWN_BACKGROUND &&
        cli_exact_weights_set(&weights, f, e->drawn_width, e->drawn_height)) {
        print_exact(past, &weights);
        cli_exact_weights_free(&weights);
    }
    printf("}");
}

void cli_explain_json(const struct cli_explanation *e)
{
    const uint8_t *const c = cli_explained_color(e);
    printf("{\"model\": ");
    cli_json_string(stdout, e->model_path);
    printf(", \"size\": [%d, %d], \"pixel\": [%d, %d], \"sample\": %d, \"samples\": %d, "
           "\"orthographic\": %s,\n",
           e->width, e->height, e->x, e->y, e->sample, e->samples, e->is_orthographic ? "true" : "false");
    if (scene_origin_is_far(e->origin)) {
        const double *const origin = e->origin;
        printf(" \"origin\": [%.17g, %.17g, %.17g],\n", origin[0], origin[1], origin[2]);
    }
    if (e->side > 1) {
        printf(" \"drawn_size\": [%d, %d], \"drawn_pixel\": [%d, %d],\n", e->drawn_width, e->drawn_height,
               e->drawn_x, e->drawn_y);
    }
    printf(" \"color\": \"#%02x%02x%02x\",\n \"fragments\": [", c[0], c[1], c[2]);
    for (int i = 0; i < e->history->count; i++) {
        printf("%s\n  ", i ? "," : "");
        print_fragment(e, &e->history->fragments[i]);
    }
    printf("]");
    if (!cli_history_seen(e->history) && e->has_nearest) {
        printf(",\n \"nearest\": [%d, %d]", e->nearest_x, e->nearest_y);
    }
    printf("}\n");
}
