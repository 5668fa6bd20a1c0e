// SPDX-License-Identifier: MIT
// A worked example, as a textbook would have it; see explain_write.h. The notation is that of docs/exactness.md.
#include "exact_weights.h"
#include "explain_write.h"
#include "info_print.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

static void print_triangle_name(FILE *out, const struct cli_past_fragment *past,
                                const struct scene_model *model)
{
    const char *const subject = cli_history_subject(past, model);
    if (past->drawn.instance == SCENE_DRAWN_BACKGROUND) {
        fprintf(out, "the background");
        return;
    }
    fprintf(out, "%s%striangle %" PRIu32 ", %s", subject, *subject ? ", " : "", past->told.primitive,
            past->told.front_facing ? "front" : "back");
}

static void print_color(FILE *out, const float color[4])
{
    fprintf(out, "(%.4g, %.4g, %.4g, %.4g)", (double)color[0], (double)color[1], (double)color[2],
            (double)color[3]);
}

// One line for each fragment.
static void print_history(FILE *out, const struct cli_explanation *e)
{
    const int count = e->history->count;
    const uint8_t *const c = cli_explained_color(e);
    fprintf(out,
            "%d fragment%s came here, in the order of drawing. Depth is reversed: 1 at the near plane, 0 at\n"
            "%s, and the greater one is seen. Triangles are counted from 0, those of `--output triangle`\n"
            "from 1. Colors are linear light, which the picture has in 8 bits of sRGB: #%02x%02x%02x%s.\n\n",
            count, count == 1 ? "" : "s", e->is_orthographic ? "the far one" : "infinity", c[0], c[1], c[2],
            e->side > 1      ? ", the mean of what is drawn for it"
            : e->samples > 1 ? ", the mean of the samples"
                             : "");
    if (count == 0) {
        fprintf(
            out,
            "It keeps what it was cleared to, (0, 0, 0, 0); a background of one color is laid under that.\n");
    }
    for (int i = 0; i < count; i++) {
        const struct cli_past_fragment *const past = &e->history->fragments[i];
        const struct rhw_explained_fragment *const f = &past->told;
        fprintf(out, "%3d. ", i + 1);
        print_triangle_name(out, past, e->model);
        if (past->drawn.instance != SCENE_DRAWN_BACKGROUND) {
            fprintf(out, ": depth %.9g, there is %.9g: ", (double)f->depth, (double)f->depth_before);
        } else {
            fprintf(out, ": ");
        }
        fprintf(out, "%s", cli_fate_name(f->fate));
        if (f->fate == RHW_FRAGMENT_WRITTEN) {
            fprintf(out, "\n     color ");
            print_color(out, f->color_before[0]);
            fprintf(out, i == 0 ? ", which it was cleared to, becomes " : " becomes ");
            print_color(out, f->color_after[0]);
            if (f->is_shaded) {
                fprintf(out, "; its shader gave ");
                print_color(out, f->output[0]);
            }
        }
        fprintf(out, "\n");
    }
}

static void print_vertices(FILE *out, const struct rhw_explained_fragment *f)
{
    fprintf(
        out,
        "    vertex            X             Y             Z             W   screen x, y in 1/256 pixel\n");
    for (int i = 0; i < 3; i++) {
        fprintf(out, "    %d     %13.9g %13.9g %13.9g %13.9g", i, (double)f->position[i][0],
                (double)f->position[i][1], (double)f->position[i][2], (double)f->position[i][3]);
        if (f->is_snapped) {
            fprintf(out, "   %" PRId32 ", %" PRId32 "  = (%.4f, %.4f)", f->x[i], f->y[i], f->x[i] / 256.0,
                    f->y[i] / 256.0);
        }
        fprintf(out, "\n");
    }
}

static void print_edges(FILE *out, const struct rhw_explained_fragment *f, const struct cli_exact_weights *w)
{
    double place[2];
    cli_explained_place(f, place);
    fprintf(out,
            "Values are taken at P = (%.6g, %.6g). The edge functions there, in 1/65536 pixel²; the one of\n"
            "vertex i belongs to the edge opposite to it, and all are above 0 inside:\n\n",
            place[0], place[1]);
    for (int i = 0; i < 3; i++) {
        fprintf(out, "    e_%d = %" PRId64 "\n", i, w->edge[i]);
    }
    fprintf(out, "    sum = %" PRId64 ", twice the triangle's area\n\n", w->sum);
    if (w->edge[0] < 0 || w->edge[1] < 0 || w->edge[2] < 0) {
        fprintf(out, "P lies outside: the triangle covers the sample, but not the middle of the pixel. What "
                     "follows goes\n"
                     "on beyond its edge.\n\n");
    }
    static const char names[3] = {'r', 's', 't'};
    fprintf(out, "On the screen P lies at\n\n");
    for (int i = 0; i < 3; i++) {
        fprintf(out, "    %c = e_%d / sum = %.17g      the pipeline has %.17g\n", names[i], i,
                mpq_get_d(w->screen[i]), f->screen[i]);
    }
}

static void print_space(FILE *out, const struct rhw_explained_fragment *f, const struct cli_exact_weights *w,
                        const char *const formulas[3])
{
    fprintf(out, "So in space P lies at\n\n");
    for (int i = 0; i < 3; i++) {
        fprintf(out, "    %s = %.9g", formulas[i], mpq_get_d(w->space[i]));
        if (i > 0) {
            fprintf(out, "      the pipeline has %.9g\n", (double)f->weights[i]);
        } else {
            fprintf(out, "      the pipeline leaves it out: a = 1 - b - c\n");
        }
    }
}

static void print_perspective(FILE *out, const struct rhw_explained_fragment *f,
                              const struct cli_exact_weights *w)
{
    fprintf(
        out,
        "\nSeen in perspective the triangle is not flat to the eye: what is linear on the screen is 1/W.\n\n"
        "    1/W_P = r/W_0 + s/W_1 + t/W_2\n"
        "          = %.9g/%.9g + %.9g/%.9g + %.9g/%.9g\n"
        "          = %.17g      the pipeline has %.17g\n"
        "      W_P = %.9g\n\n",
        mpq_get_d(w->screen[0]), (double)f->position[0][3], mpq_get_d(w->screen[1]),
        (double)f->position[1][3], mpq_get_d(w->screen[2]), (double)f->position[2][3],
        mpq_get_d(w->inverse_w), f->inverse_w, 1.0 / f->inverse_w);
    print_space(out, f, w, (const char *const[3]){"a = r W_P/W_0", "b = s W_P/W_1", "c = t W_P/W_2"});
    if (f->component_count > 0 && f->qualifiers[0] == RHW_NOPERSPECTIVE) {
        fprintf(out, "\nThis picture's varyings are noperspective: they take r, s, t, and nothing of 1/W.\n");
    }
}

static void print_parallel(FILE *out, const struct rhw_explained_fragment *f,
                           const struct cli_exact_weights *w)
{
    fprintf(out,
            "\nWithout perspective every W is 1, so that a, b, c are r, s, t: what is linear in space is "
            "linear on the\nscreen.\n\n");
    print_space(out, f, w, (const char *const[3]){"a = r", "b = s", "c = t"});
}

static void print_components(FILE *out, const struct cli_explanation *e, const struct cli_past_fragment *past,
                             const struct cli_exact_weights *w)
{
    static const char *const qualifiers[] = {"a I_0 + b I_1 + c I_2", "r I_0 + s I_1 + t I_2", "flat"};
    const struct rhw_explained_fragment *const f = &past->told;
    double worst = 0.0;
    fprintf(out,
            "\nEvery varying three ways. Naive is r I_0 + s I_1 + t I_2, %s;\n"
            "exact is %s in rational arithmetic; the error is that of the pipeline, in ULP of the\n"
            "largest of the three vertex values.\n\n",
            e->is_orthographic ? "which is right without perspective"
                               : "as if the triangle were flat to the eye",
            f->component_count > 0 ? qualifiers[f->qualifiers[0]] : "the formula");
    fprintf(out, "    %-24s %13s %13s %13s   %15s %15s %15s  %6s\n", "", "I_0", "I_1", "I_2", "naive",
            "exact", "pipeline", "error");
    for (int i = 0; i < f->component_count; i++) {
        char name[SCENE_COMPONENT_NAME];
        struct cli_three_ways ways;
        cli_exact_component(w, f, i, &ways);
        scene_component_name(&past->drawn.surface, i, name);
        fprintf(out, "    %-24s %13.9g %13.9g %13.9g   %15.9g %15.9g %15.9g  %6.2f\n", name,
                (double)f->vertex_varyings[0][i], (double)f->vertex_varyings[1][i],
                (double)f->vertex_varyings[2][i], ways.naive, ways.exact, (double)ways.written, ways.error);
        worst = ways.error > worst ? ways.error : worst;
    }
    fprintf(out, "\nThe largest error is %.2f ULP; rhw promises 8 (docs/exactness.md).\n", worst);
}

// How much of texel i of the four around a place is read; `part`: how far that lies to the right of and below the
// first.
static double share_of(int i, const double part[2], enum rhw_filter filter)
{
    double share = 1.0;
    for (int k = 0; k < 2; k++) {
        const double next = filter == RHW_FILTER_LINEAR ? part[k] : part[k] >= 0.5 ? 1.0 : 0.0;
        share *= (i >> k & 1) != 0 ? next : 1.0 - next;
    }
    return share;
}

// The four texels around the place in a level: each with its share where they are mixed, else the nearest. `nearest`:
// why.
static void print_texels(FILE *out, const struct scene_texture_look *look, int next, enum rhw_filter filter,
                         const char *nearest)
{
    const float side[2] = {(float)look->width, (float)look->height};
    double part[2];
    for (int i = 0; i < 2; i++) {
        const double half = next && side[i] > 1.0f ? floor((double)side[i] / 2.0) : (double)side[i];
        const double place = (double)look->uv[i] * half - 0.5;
        part[i] = place - floor(place);
    }
    fprintf(out, "    %20s level %d%s%s:\n", "", (int)look->level + next,
            filter == RHW_FILTER_LINEAR ? "" : ", the nearest texel, as ",
            filter == RHW_FILTER_LINEAR ? "" : nearest);
    for (int i = 0; i < 4; i++) {
        const double share = share_of(i, part, filter);
        if (filter == RHW_FILTER_LINEAR || share > 0.0) {
            fprintf(out, "    %20s   %.4f of ", "", share);
            print_color(out, look->texels[next][i]);
            fprintf(out, "\n");
        }
    }
}

// Of a place beyond the edge: what the address modes make of it.
static void print_inside(FILE *out, const struct cli_texture_place *place)
{
    static const char *const words[] = {[RHW_ADDRESS_REPEAT] = "repeats",
                                        [RHW_ADDRESS_MIRROR] = "is mirrored",
                                        [RHW_ADDRESS_CLAMP] = "stays at the edge",
                                        [RHW_ADDRESS_MIRROR_ONCE] = "is mirrored once"};
    if (place->is_border) {
        fprintf(out, "\n    %20s beyond the edge, where the border's color is read", "");
        return;
    }
    if (!place->is_beyond[0] && !place->is_beyond[1]) {
        return;
    }
    fprintf(out, "\n    %20s that is (%.3f, %.3f), as", "", place->inside[0], place->inside[1]);
    for (int i = 0; i < 2; i++) {
        if (place->is_beyond[i]) {
            fprintf(out, "%s %c %s", i == 1 && place->is_beyond[0] ? " and" : "", "uv"[i],
                    words[place->address[i]]);
        }
    }
}

// Why it is that level: Vulkan 1.3, Scale Factor, Level of Detail and Image Level Selection.
static void print_steps(FILE *out, const struct scene_texture_look *look)
{
    double texels[2];
    for (int i = 0; i < 2; i++) {
        const double u = (double)look->step[i][0] * look->base_width;
        const double v = (double)look->step[i][1] * look->base_height;
        texels[i] = sqrt(u * u + v * v);
    }
    fprintf(out,
            "\n    %20s to the pixel on the right u, v go (%.5g, %.5g), to the one below (%.5g, %.5g):\n"
            "    %20s %.4g and %.4g texels of %dx%d; log2 of the larger is %.4g",
            "", (double)look->step[0][0], (double)look->step[0][1], (double)look->step[1][0],
            (double)look->step[1][1], "", texels[0], texels[1], look->base_width, look->base_height,
            (double)look->lod);
}

static void print_texture(FILE *out, const struct scene_texture_look *look, const struct scene_model *model,
                          const struct scene_material *material)
{
    struct cli_texture_place place = {.filter = RHW_FILTER_LINEAR};
    const char *nearest = "the file says";
    fprintf(out, "    %-20s level %.4g; level %d has %dx%d texels, and the place is (%.3f, %.3f)",
            scene_slot_name(look->slot), (double)look->level, (int)look->level, look->width, look->height,
            (double)look->place[0], (double)look->place[1]);
    if (material) {
        const struct scene_texture_slot *const slot = &material->slots[look->slot];
        place = cli_texture_place(look, slot);
        print_inside(out, &place);
        nearest = model->images[slot->image].missing ? "it stands in for a file that is missing" : nearest;
    }
    print_steps(out, look);
    fprintf(out, "\n    %20s gives ", "");
    print_color(out, look->texel);
    fprintf(out, "\n");
    print_texels(out, look, 0, place.filter, nearest);
    if (look->level > floorf(look->level)) {
        print_texels(out, look, 1, place.filter, nearest);
    }
}

static void print_textures(FILE *out, const struct cli_past_fragment *past, const struct scene_model *model)
{
    const struct scene_material *const material = cli_history_material(past, model);
    if (past->look_count > 0) {
        fprintf(out, "\nIts textures there. The level follows from how far u and v go from pixel to pixel; "
                     "the place in\n"
                     "it is u and v times its size, less half a texel. Of the four texels around it, in this "
                     "level and,\n"
                     "by its fraction, in the next, this is read:\n\n");
    }
    for (int i = 0; i < past->look_count; i++) {
        print_texture(out, &past->looks[i], model, material);
    }
}

static void print_triple(FILE *out, const float v[3])
{
    fprintf(out, "(%.4g, %.4g, %.4g)", (double)v[0], (double)v[1], (double)v[2]);
}

static void print_light(FILE *out, int number, const struct scene_light_look *light)
{
    fprintf(out, "    light %d, %-12s l is ", number, cli_light_names[light->type]);
    print_triple(out, light->direction);
    fprintf(out, ", n·l %.4g: ", (double)light->n_dot_l);
    if (light->n_dot_l <= 0.0f) {
        fprintf(out, "the surface faces away from it\n");
        return;
    }
    if (light->has_shadows) {
        fprintf(out, "%.4g %% of it is in shadow, so of ", 100.0 * (1.0 - (double)light->open));
    } else {
        fprintf(out, "without shadows, of ");
    }
    print_triple(out, light->facing);
    fprintf(out, " arrives ");
    print_triple(out, light->arrives);
    fprintf(out, "\n");
}

static void print_occlusion(FILE *out, const char *indent, const struct scene_light_looks *looks)
{
    if (looks->has_occlusion) {
        fprintf(out, ",\n%sof which ambient occlusion leaves %.4g %%", indent, 100.0 * (double)looks->around);
    }
}

static void print_lights(FILE *out, const struct scene_light_looks *looks)
{
    if (!looks->is_lit) {
        return;
    }
    fprintf(out, "\nThe light there. The unit normal n%s is ",
            looks->is_mapped ? ", which the normal map has turned," : "");
    print_triple(out, looks->normal);
    if (looks->count == 0) {
        fprintf(out, ". No light is set;\nwhat there is comes from all around");
        print_occlusion(out, "", looks);
        fprintf(out, ".\n");
        return;
    }
    fprintf(out,
            ". From a\nlight in direction l arrives n·l of what a white surface that faces it sends on, less "
            "what is in shadow:\n\n");
    for (int i = 0; i < looks->count; i++) {
        print_light(out, i + 1, &looks->lights[i]);
    }
    if (looks->left_out > 0) {
        fprintf(out, "    and %d more\n", looks->left_out);
    }
    fprintf(out, "    together ");
    print_triple(out, looks->sum);
    fprintf(out, ", beside what comes from all around");
    print_occlusion(out, "    ", looks);
    fprintf(out, "\n");
}

// From there on it is the shader and the target.
static void print_color_made(FILE *out, const struct cli_past_fragment *past)
{
    const struct rhw_explained_fragment *const f = &past->told;
    fprintf(out, "\nOf these values, light and shadow the shader makes ");
    print_color(out, f->output[0]);
    if (f->output[0][3] < 1.0f) {
        fprintf(out, ", which lies over ");
        print_color(out, f->color_before[0]);
    }
    fprintf(out, ".\nRounded to the format of the samples that is ");
    print_color(out, f->color_after[0]);
    fprintf(out, ".\n");
}

// Without a division of areas: a vertex behind the eye has none on the screen.
static void print_homogeneous(FILE *out, const struct rhw_explained_fragment *f,
                              const struct cli_exact_weights *w)
{
    static const char space[] = "abc", screen[] = "rst";
    double place[2];
    cli_explained_place(f, place);
    fprintf(
        out,
        "A vertex lies behind the eye or too far away to be snapped. P = (%.6g, %.6g) is still a mixture of\n"
        "the vertices, and seen from P the X and Y of the mixture are 0; that leaves one a : b : c:\n\n",
        place[0], place[1]);
    for (int i = 0; i < 3; i++) {
        fprintf(out, "    %c = %.9g      the pipeline has %.9g\n", space[i], mpq_get_d(w->space[i]),
                (double)f->weights[i]);
    }
    fprintf(out,
            "\n    W_P = a W_0 + b W_1 + c W_2\n"
            "    1/W_P = %.17g      the pipeline has %.17g\n\n"
            "and its weights on the screen, which may be of any size and sign:\n\n",
            mpq_get_d(w->inverse_w), f->inverse_w);
    for (int i = 0; i < 3; i++) {
        fprintf(out, "    %c = %c W_%d/W_P = %.17g      the pipeline has %.17g\n", screen[i], space[i], i,
                mpq_get_d(w->screen[i]), f->screen[i]);
    }
}

static void print_derivation(FILE *out, const struct cli_explanation *e, const struct cli_past_fragment *past)
{
    const struct rhw_explained_fragment *const f = &past->told;
    struct cli_exact_weights weights;
    fprintf(out, "\nWhat is seen: ");
    print_triangle_name(out, past, e->model);
    fprintf(out, ".\nIts vertices in homogeneous clip coordinates, and where they were snapped to:\n\n");
    print_vertices(out, f);
    if (f->is_clipped) {
        fprintf(out,
                "\nThe triangle is clipped: what it covers is the polygon that the view leaves of it.\n");
    }
    fprintf(out, "\n");
    if (!cli_exact_weights_set(&weights, f, e->drawn_width, e->drawn_height)) {
        fprintf(out, "It has no area.\n");
        return;
    }
    if (weights.is_snapped) {
        print_edges(out, f, &weights);
        if (e->is_orthographic) {
            print_parallel(out, f, &weights);
        } else {
            print_perspective(out, f, &weights);
        }
    } else {
        print_homogeneous(out, f, &weights);
    }
    fprintf(out,
            "\nDepth is linear on the screen. It is tested at the sample S = (%.6g, %.6g): Z_S/W_S = %.9g. "
            "The output\n"
            "depth is 1 - Z/W, in the middle of the pixel.\n",
            f->sample_x / 256.0, f->sample_y / 256.0, (double)f->depth);
    print_components(out, e, past, &weights);
    if (scene_origin_is_far(e->origin)) {
        const double *const origin = e->origin;
        fprintf(
            out,
            "\nThe model is far from the origin of its file: positions count from (%.15g, %.15g, %.15g).\n",
            origin[0], origin[1], origin[2]);
    }
    print_textures(out, past, e->model);
    print_lights(out, &past->light);
    print_color_made(out, past);
    cli_exact_weights_free(&weights);
}

static void print_nothing(FILE *out, const struct cli_explanation *e)
{
    fprintf(out, "\nNothing of the model is seen here");
    if (e->has_nearest) {
        fprintf(out, "; the nearest pixel that shows it is (%d, %d)", e->nearest_x, e->nearest_y);
    }
    fprintf(out, ".\n");
}

static void print_sample(FILE *out, const struct cli_explanation *e)
{
    if (e->samples > 1) {
        fprintf(out, ", sample %d of %d", e->sample, e->samples);
    }
}

void cli_explain_text(FILE *out, const struct cli_explanation *e)
{
    const uint8_t *const c = cli_explained_color(e);
    fprintf(out, "%s: pixel (%d, %d) of %dx%d", e->model_path, e->x, e->y, e->width, e->height);
    if (e->side == 1) {
        print_sample(out, e);
    }
    fprintf(out, ", is #%02x%02x%02x in the picture.\n", c[0], c[1], c[2]);
    if (e->side > 1) {
        fprintf(out, "It is the mean of %dx%d pixels. This is about (%d, %d) of %dx%d that are drawn",
                e->side, e->side, e->drawn_x, e->drawn_y, e->drawn_width, e->drawn_height);
        print_sample(out, e);
        fprintf(out, ".\n");
    }
    print_history(out, e);
    const struct cli_past_fragment *const seen = cli_history_seen(e->history);
    if (seen) {
        print_derivation(out, e, seen);
    } else {
        print_nothing(out, e);
    }
}
