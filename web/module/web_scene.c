// SPDX-License-Identifier: MIT
// A model that JavaScript holds, and the pictures of it: rhw render, explain and info without files.
#include "explain_draw.h"
#include "fragment_program.h"
#include "import/blob.h"
#include "info_print.h"
#include "message.h"
#include "web_module.h"

#include <emscripten.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct web_scene {
    struct render render;
    void *bytes; // the model stands on them
    char *name;
    void *words; // SPIR-V of the shader that shades instead of materials; NULL: none
    size_t words_size;
    double view[WEB_VIEW_NUMBERS];
};

// Take a shader away. Pipelines of it go with what is drawn.
static void drop_shader(struct web_scene *scene)
{
    struct render *const render = &scene->render;
    scene_destroy(render->scene);
    rhw_shader_program_destroy(render->shader);
    free(scene->words);
    render->scene = NULL;
    render->shader = NULL;
    scene->words = NULL;
    scene->words_size = 0;
}

EMSCRIPTEN_KEEPALIVE void web_scene_close(struct web_scene *scene)
{
    scene_pictures_free(&scene->render.pictures);
    drop_shader(scene);
    rhw_context_destroy(scene->render.context);
    web_free(scene->bytes);
    free(scene->name);
    free(scene);
}

static bool open_model(struct web_scene *scene, size_t size, char *words, size_t words_size)
{
    struct render *const render = &scene->render;
    if (!web_job_parse(&render->job, words, words_size)) {
        return false;
    }
    scene->name = strdup(render->job.model_path);
    render->model = scene_blob_read(scene->bytes, size);
    if (!scene->name || !render->model) {
        cli_error(render->job.model_path, "import sent a damaged model");
        return false;
    }
    render->model->path = scene->name;
    render->job.model_path = scene->name;
    return cli_render_accept(render);
}

EMSCRIPTEN_KEEPALIVE struct web_scene *web_scene_open(void *bytes, size_t size, char *words,
                                                      size_t words_size)
{
    web_messages_clear();
    struct web_scene *const scene = calloc(1, sizeof *scene);
    if (!scene) {
        web_free(bytes);
        cli_error("render", "out of memory");
        return NULL;
    }
    scene->bytes = bytes;
    if (!open_model(scene, size, words, words_size)) {
        web_scene_close(scene);
        return NULL;
    }
    return scene;
}

static bool look(struct web_scene *scene, char *words, size_t size)
{
    web_messages_clear();
    if (!web_job_parse(&scene->render.job, words, size)) {
        return false;
    }
    scene->render.job.model_path = scene->name;
    return cli_render_set_view(&scene->render);
}

// Of the caller's thread: pthreads are never asked.
EM_JS(int, ask_whether_it_goes_on, (void), { return !Module['goesOn'] || Module['goesOn'](); })

static bool goes_on(void *user)
{
    (void)user;
    return ask_whether_it_goes_on() != 0;
}

// The context stays for good: its threads have all workers that there are.
static bool open_scene(struct web_scene *scene)
{
    struct render *const render = &scene->render;
    if (render->scene) {
        return true;
    }
    if (!render->context) {
        return cli_render_open_scene(render);
    }
    const enum rhw_result result = scene_create(render->context, render->model, &render->scene);
    if (result != RHW_OK) {
        cli_error(render->job.model_path, "%s", rhw_result_string(result));
    }
    return result == RHW_OK;
}

// Make the program of a shader. Return NULL after a message.
static rhw_shader_program *create_program(const void *words, size_t size)
{
    static const char name[] = "fragmentShader";
    const struct rhw_shader_def def = {.stage = RHW_SHADER_FRAGMENT};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    if (rhw_shader_create(words, size, &def, &shader, message) != RHW_OK) {
        cli_error(name, "%s", message);
        return NULL;
    }
    rhw_shader_program *const program = cli_fragment_program_create(name, shader, false);
    rhw_shader_destroy(shader);
    return program;
}

EMSCRIPTEN_KEEPALIVE bool web_scene_shade(struct web_scene *scene, const void *words, size_t size)
{
    web_messages_clear();
    if (size == scene->words_size && (size == 0 || memcmp(words, scene->words, size) == 0)) {
        return true;
    }
    drop_shader(scene);
    if (size == 0) {
        return true;
    }
    scene->render.shader = create_program(words, size);
    scene->words = scene->render.shader ? malloc(size) : NULL;
    if (!scene->words) {
        if (scene->render.shader) {
            cli_error("fragmentShader", "out of memory");
        }
        drop_shader(scene);
        return false;
    }
    memcpy(scene->words, words, size);
    scene->words_size = size;
    return true;
}

EMSCRIPTEN_KEEPALIVE bool web_scene_look(struct web_scene *scene, char *words, size_t size)
{
    return look(scene, words, size);
}

EMSCRIPTEN_KEEPALIVE bool web_scene_render(struct web_scene *scene, char *words, size_t size,
                                           uint32_t outputs)
{
    if (!look(scene, words, size)) {
        return false;
    }
    // The words ask for every output, some of which a shader does not have.
    scene->render.view.program = scene->render.shader ? rhw_shader_program_get(scene->render.shader) : NULL;
    scene->render.view.outputs = outputs;
    scene->render.view.goes_on = goes_on;
    char error[256];
    if (!scene_view_check(&scene->render.view, error, sizeof error)) {
        cli_error("render", "%s", error);
        return false;
    }
    return open_scene(scene) && cli_render_draw_seen(&scene->render);
}

EMSCRIPTEN_KEEPALIVE const void *web_scene_picture(const struct web_scene *scene, uint32_t output)
{
    const struct scene_pictures *const pictures = &scene->render.pictures;
    const void *picture = NULL;
    for (int kind = 0; kind < SCENE_KIND_COUNT; kind++) {
        if (scene_outputs[kind].output == (enum scene_output)output) {
            picture = scene_picture_get(pictures, (enum scene_output_kind)kind);
        }
    }
    return picture;
}

EMSCRIPTEN_KEEPALIVE const char *web_outputs(void)
{
    static char lines[1024];
    size_t used = 0;
    for (int i = 0; i < SCENE_KIND_DISPLAY; i++) { // which alone the package does not have
        const enum scene_output_kind kind = (enum scene_output_kind)i;
        used += (size_t)snprintf(lines + used, sizeof lines - used, "%s %d %d %d\n", scene_outputs[kind].name,
                                 (int)scene_outputs[kind].output, (int)scene_output_element(kind),
                                 scene_output_channels(kind));
    }
    return lines;
}

EMSCRIPTEN_KEEPALIVE const double *web_scene_view(struct web_scene *scene)
{
    static const double degree = 3.14159265358979323846 / 180.0;
    const struct scene_view *const view = &scene->render.view;
    const struct scene_camera *const c = &view->camera;
    // Before anything is drawn there is no picture.
    const struct scene_pictures *const pictures = &scene->render.pictures;
    const double *const origin = pictures->width > 0 ? pictures->origin : scene->render.model->origin;
    const double numbers[WEB_VIEW_NUMBERS] = {
        view->width,  view->height, c->eye[0], c->eye[1], c->eye[2],       c->target[0],     c->target[1],
        c->target[2], c->up[0],     c->up[1],  c->up[2],  c->orthographic, c->yfov / degree, c->ymag,
        c->znear,     c->zfar,      origin[0], origin[1], origin[2]};
    memcpy(scene->view, numbers, sizeof numbers);
    return scene->view;
}

EMSCRIPTEN_KEEPALIVE int web_scene_threads(const struct web_scene *scene)
{
    return scene->render.stats.pipeline.threads;
}

EMSCRIPTEN_KEEPALIVE bool web_scene_explain(struct web_scene *scene, char *words, size_t size, int x, int y,
                                            int sample)
{
    struct cli_history history;
    struct cli_explanation explanation;
    if (!look(scene, words, size) || !cli_explain_check(&scene->render.job, x, y, sample)) {
        return false;
    }
    scene->render.view.outputs = SCENE_OUTPUT_COLOR;
    if (!open_scene(scene) || !cli_explain_draw(&scene->render, x, y, sample, &history, &explanation)) {
        return false;
    }
    cli_explain_json(&explanation);
    puts("\f");
    cli_explain_text(stdout, &explanation);
    fflush(stdout);
    cli_history_free(&history);
    return true;
}

EMSCRIPTEN_KEEPALIVE void web_scene_info(const struct web_scene *scene)
{
    cli_info_print_json(scene->render.model);
    fflush(stdout);
}
