// SPDX-License-Identifier: MIT
// Four contexts in four threads: each draws its own scene with its own shapes, sizes, formats and textures, all at
// once; then the main thread draws the same scenes one after another. The bytes are equal. Then what belongs to one
// context is given to another, and a context that draws is called by a second thread: the assert hook tells each time,
// the call does nothing, and what is drawn afterwards is as before.
#include <pthread.h>
#include <semaphore.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "outside.h"

#include <rhw/shader.h>

enum { SCENES = 4, FRAMES = 24, POINTS = SCENES + 2, TILES = 8 };

struct complaints {
    int count;
    char last[512];
};

struct scene {
    int number, width, height;
    enum rhw_format format;
    struct complaints complaints;
    rhw_context *context;
    rhw_pipeline pipeline;
    rhw_buffer corners, indices;
    rhw_sampler sampler;
    rhw_texture tiles, picture;
};

static const char *const names[SCENES] = {"contexts.north", "contexts.east", "contexts.south",
                                          "contexts.west"};
static const float backdrop[4] = {0.2f, 0.4f, 0.6f, 1};
static const float tints[3][3] = {{1, 0.3f, 0.3f}, {0.3f, 1, 0.3f}, {0.3f, 0.3f, 1}};
static pthread_barrier_t all_are_here;

// Shaders -------------------------------------------------------------------------------------------

struct turn {
    float cosine, sine;
    float tint[3];
};

// A corner of a star: turned, and further away the higher it stands. Its middle is that of texel (0, 0).
static void place(struct rhw_vertex1 *v)
{
    const struct turn *const turn = v->uniforms;
    const float *const at = v->attribute[0];
    v->position[0] = turn->cosine * at[0] - turn->sine * at[1];
    v->position[1] = turn->sine * at[0] + turn->cosine * at[1];
    v->position[2] = 0;
    v->position[3] = 1.5f + 0.5f * v->position[1];
    v->varying[0] = 2 * at[0] + 0.5f / TILES;
    v->varying[1] = 2 * at[1] + 0.5f / TILES;
}

static void paint(struct rhw_fragment1 *f)
{
    const struct turn *const turn = f->uniforms;
    const float grad[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
    float texel[4];
    rhw_sample_grad1(f->textures, 0, f->varying, grad, texel);
    for (int c = 0; c < 3; c++) {
        f->color[0][c] = texel[c] * turn->tint[c];
    }
    f->color[0][3] = 0.75f;
}

// A fragment function that holds its draw up, once, until another thread has called the context it draws in.
struct meeting {
    struct scene *scene;
    sem_t drawing, called;
    atomic_flag held;
    enum rhw_result read;
};

static void paint_held(struct rhw_fragment1 *f)
{
    // `user` points at const, which a semaphore is not: hence a pointer to a pointer.
    struct meeting *const meeting = *(struct meeting *const *)f->user;
    if (!atomic_flag_test_and_set(&meeting->held)) {
        sem_post(&meeting->drawing);
        sem_wait(&meeting->called);
    }
    paint(f);
}

static void *intrude(void *argument)
{
    struct meeting *const meeting = argument;
    float nothing[4];
    sem_wait(&meeting->drawing);
    meeting->read = rhw_texture_read(meeting->scene->context, meeting->scene->picture, 0, nothing, 0);
    sem_post(&meeting->called);
    return NULL;
}

// Scenes --------------------------------------------------------------------------------------------

// The assert hook: called by the thread that called the library.
static void complain(void *user, const char *message)
{
    struct complaints *const complaints = user;
    snprintf(complaints->last, sizeof complaints->last, "%s", message);
    complaints->count++;
}

static rhw_pipeline make_pipeline(const struct scene *scene, rhw_fragment1_function *fragment,
                                  const void *user)
{
    const struct rhw_pipeline_def def = {
        .program = {.vertex1 = place,
                    .fragment1 = fragment,
                    .varyings = {{.components = 2, .derivatives = true}},
                    .varying_count = 1,
                    .uniform_size = sizeof(struct turn),
                    .user = user},
        .attributes = {{.format = RHW_VERTEX_FLOAT2}},
        .attribute_count = 1,
        .buffer_count = 1,
        .topology = RHW_TRIANGLE_FAN,
        .targets = {{.format = scene->format,
                     .blend = true,
                     .color = {RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD}}},
        .target_count = 1,
        .label = "star",
    };
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(scene->context, &def, &pipeline), "pipeline");
    return pipeline;
}

static uint32_t index_count(const struct scene *scene)
{
    return (uint32_t)(2 + 2 * (3 + scene->number)); // the middle, and around it back to the first corner
}

static void make_scene(struct scene *scene, struct rhw_context_def def)
{
    const int n = scene->number;
    def.assert_ = complain;
    def.user = &scene->complaints;
    def.label = names[n];
    must(rhw_context_create(&def, &scene->context), names[n]);

    const uint32_t count = index_count(scene);
    float corners[1 + 2 * POINTS][2] = {{0}};
    uint8_t indices[2 + 2 * POINTS] = {0};
    for (uint32_t i = 1; i < count; i++) {
        const float radius = i % 2 ? 1 : 0.4f;
        indices[i] = (uint8_t)(i < count - 1 ? i : 1);
        rhw_sincos1(6.2831853f * (float)i / (float)(count - 2), &corners[indices[i]][1],
                    &corners[indices[i]][0]);
        corners[indices[i]][0] *= radius;
        corners[indices[i]][1] *= radius;
    }
    uint8_t texels[TILES * TILES][4];
    for (int i = 0; i < TILES * TILES; i++) {
        memset(texels[i], (i % TILES + i / TILES) % 2 ? 255 : 60 * n, 4);
    }
    scene->format = n % 2 ? RHW_FORMAT_RGBA8_SRGB : RHW_FORMAT_RGBA8_UNORM;
    scene->width = 201 + 40 * n;
    scene->height = 241 - 30 * n;
    const struct rhw_buffer_def corner_def = {.size = sizeof corners, .data = corners};
    const struct rhw_buffer_def index_def = {.size = count, .data = indices};
    const struct rhw_texture_def tile_def = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = TILES, .height = TILES, .mip_levels = RHW_MIP_LEVELS_ALL};
    const struct rhw_texture_def picture_def = {
        .format = scene->format, .width = scene->width, .height = scene->height};
    const struct rhw_sampler_def sampler_def = {.mag_filter = n < 2 ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR};
    must(rhw_buffer_create(scene->context, &corner_def, &scene->corners), "corners");
    must(rhw_buffer_create(scene->context, &index_def, &scene->indices), "indices");
    must(rhw_texture_create(scene->context, &tile_def, &scene->tiles), "tiles");
    must(rhw_texture_write(scene->context, scene->tiles, 0, texels, 0), "tiles");
    must(rhw_texture_generate_mips(scene->context, scene->tiles), "mips");
    must(rhw_texture_create(scene->context, &picture_def, &scene->picture), "picture");
    must(rhw_sampler_create(scene->context, &sampler_def, &scene->sampler), "sampler");
    scene->pipeline = make_pipeline(scene, paint, NULL);
}

static rhw_pass begin(const struct scene *scene, rhw_pipeline pipeline)
{
    struct rhw_pass_def def = {.colors = {{.texture = scene->picture}}, .color_count = 1, .label = "stars"};
    memcpy(def.colors[0].clear, backdrop, sizeof backdrop);
    rhw_pass pass;
    must(rhw_pass_begin(scene->context, &def, &pass), "begin");
    rhw_pass_set_pipeline(scene->context, pass, pipeline);
    rhw_pass_set_vertex_buffer(scene->context, pass, 0, scene->corners, 0);
    rhw_pass_set_index_buffer(scene->context, pass, scene->indices, RHW_INDEX_UINT8, 0);
    rhw_pass_set_texture(scene->context, pass, 0, scene->tiles, scene->sampler);
    return pass;
}

// Three stars, each turned a little further and blended over those before.
static void draw_stars(const struct scene *scene, rhw_pass pass, int frame)
{
    for (int i = 0; i < 3; i++) {
        struct turn turn = {.tint = {tints[i][0], tints[i][1], tints[i][2]}};
        rhw_sincos1(0.05f * (float)(frame + 5 * i), &turn.sine, &turn.cosine);
        rhw_pass_set_uniforms(scene->context, pass, &turn, sizeof turn);
        rhw_pass_draw_indexed(scene->context, pass, 0, index_count(scene), 0, 0, 1);
    }
}

static void draw_frames(const struct scene *scene)
{
    for (int frame = 0; frame < FRAMES; frame++) {
        const rhw_pass pass = begin(scene, scene->pipeline);
        draw_stars(scene, pass, frame);
        must(rhw_pass_end(scene->context, pass, NULL), "end");
    }
}

struct painter {
    struct scene scene;
    struct rhw_context_def def;
};

// Creates the context and draws; the main thread reads the picture when this one has ended.
static void *run(void *argument)
{
    struct painter *const painter = argument;
    pthread_barrier_wait(&all_are_here);
    make_scene(&painter->scene, painter->def);
    pthread_barrier_wait(&all_are_here);
    draw_frames(&painter->scene);
    return NULL;
}

// Checks --------------------------------------------------------------------------------------------

static void start_thread(pthread_t *thread, void *(*function)(void *), void *argument)
{
    must(pthread_create(thread, NULL, function, argument) == 0 ? RHW_OK : RHW_ERROR_THREAD, "thread");
}

static bool looks_like(const struct scene *scene, const void *expected)
{
    const size_t size = (size_t)scene->width * (size_t)scene->height * 4;
    void *const texels = malloc(size);
    must(texels ? rhw_texture_read(scene->context, scene->picture, 0, texels, 0) : RHW_ERROR_OUT_OF_MEMORY,
         "read");
    const bool same = memcmp(texels, expected, size) == 0;
    free(texels);
    return same;
}

// The middle: three stars over the backdrop, each 3/4 of what is seen there, with the light of texel (0, 0).
static void check_middle(const struct scene *scene, uint8_t (*pixels)[4])
{
    const uint8_t *const pixel = pixels[scene->height / 2 * scene->width + scene->width / 2];
    for (int c = 0; c < 3; c++) {
        float value = backdrop[c];
        for (int i = 0; i < 3; i++) {
            value = value / 4 + 0.75f * tints[i][c] * (float)(60 * scene->number) / 255;
        }
        if (scene->format == RHW_FORMAT_RGBA8_SRGB) {
            value = 1.055f * rhw_pow1(value, 1 / 2.4f) - 0.055f;
        }
        check(rhw_abs1((float)pixel[c] - 255 * value) < 2, "three stars are blended in the middle");
    }
}

// Whether the hook was called once since the last time, by `function` and because of `why`.
static void told(struct scene *scene, const char *function, const char *why)
{
    const struct complaints *const complaints = &scene->complaints;
    check(complaints->count == 1 && strstr(complaints->last, function) && strstr(complaints->last, why),
          function);
    scene->complaints = (struct complaints){0};
}

// Everything of `theirs` in calls of `mine`, the last of them within a pass that is drawn all the same.
static void check_foreign_ids(struct scene *mine, const struct scene *theirs)
{
    static const char why[] = "belongs to another context";
    rhw_context *const context = mine->context;
    uint8_t bytes[TILES * TILES * 4] = {0};
    const struct rhw_pass_def def = {.colors = {{.texture = theirs->picture}}, .color_count = 1};
    rhw_pass pass;
    check(rhw_texture_width(context, theirs->picture, 0) == 0, "no width");
    told(mine, "rhw_texture_width", why);
    check(rhw_buffer_write(context, theirs->corners, 0, bytes, 8) == RHW_ERROR_MISUSE, "no write");
    told(mine, "rhw_buffer_write", why);
    check(rhw_texture_write(context, theirs->tiles, 0, bytes, 0) == RHW_ERROR_MISUSE, "no write");
    told(mine, "rhw_texture_write", why);
    check(rhw_texture_read(context, theirs->tiles, 0, bytes, 0) == RHW_ERROR_MISUSE, "no read");
    told(mine, "rhw_texture_read", why);
    check(rhw_pass_begin(context, &def, &pass) == RHW_ERROR_MISUSE, "no pass");
    told(mine, "rhw_pass_begin", why);
    rhw_buffer_destroy(context, theirs->corners);
    told(mine, "rhw_buffer_destroy", why);
    rhw_texture_destroy(context, theirs->tiles);
    told(mine, "rhw_texture_destroy", why);
    rhw_sampler_destroy(context, theirs->sampler);
    told(mine, "rhw_sampler_destroy", why);
    rhw_pipeline_destroy(context, theirs->pipeline);
    told(mine, "rhw_pipeline_destroy", why);

    // Both record now. What is misuse leaves the state of the pass.
    const rhw_pass my_pass = begin(mine, mine->pipeline), their_pass = begin(theirs, theirs->pipeline);
    rhw_pass_set_pipeline(context, my_pass, theirs->pipeline);
    told(mine, "rhw_pass_set_pipeline", why);
    rhw_pass_set_vertex_buffer(context, my_pass, 0, theirs->corners, 0);
    told(mine, "rhw_pass_set_vertex_buffer", why);
    rhw_pass_set_index_buffer(context, my_pass, theirs->indices, RHW_INDEX_UINT8, 0);
    told(mine, "rhw_pass_set_index_buffer", why);
    rhw_pass_set_texture(context, my_pass, 0, mine->tiles, theirs->sampler);
    told(mine, "rhw_pass_set_texture", why);
    rhw_pass_draw(context, their_pass, 0, 3, 0, 1);
    told(mine, "rhw_pass_draw", why);
    check(rhw_pass_end(context, their_pass, NULL) == RHW_ERROR_MISUSE, "no end");
    told(mine, "rhw_pass_end", why);
    draw_stars(mine, my_pass, FRAMES - 1);
    draw_stars(theirs, their_pass, FRAMES - 1);
    check(rhw_pass_end(context, my_pass, NULL) == RHW_ERROR_MISUSE, "the end tells of the misuse again");
    check(rhw_pass_end(theirs->context, their_pass, NULL) == RHW_OK, "the others' pass is well");
    check(mine->complaints.count == 0 && theirs->complaints.count == 0, "nothing else was told");
}

// A second thread calls the context while this one draws.
static void check_intruder(struct scene *scene)
{
    struct meeting meeting = {.scene = scene, .held = ATOMIC_FLAG_INIT}, *const user = &meeting;
    sem_init(&meeting.drawing, 0, 0);
    sem_init(&meeting.called, 0, 0);
    const rhw_pipeline held = make_pipeline(scene, paint_held, &user);
    const rhw_pass pass = begin(scene, held);
    draw_stars(scene, pass, FRAMES - 1);
    pthread_t thread;
    start_thread(&thread, intrude, &meeting);
    check(rhw_pass_end(scene->context, pass, NULL) == RHW_ERROR_MISUSE, "the pass was disturbed");
    pthread_join(thread, NULL);
    rhw_pipeline_destroy(scene->context, held);
    sem_destroy(&meeting.drawing);
    sem_destroy(&meeting.called);
    check(meeting.read == RHW_ERROR_MISUSE, "the intruder reads nothing");
    told(scene, "rhw_texture_read", "called while rhw_pass_end is under way");
}

int main(void)
{
    const struct rhw_context_def def = outside_context_def();
    static struct painter together[SCENES];
    static struct scene alone[SCENES];
    void *pictures[SCENES];
    pthread_t threads[SCENES];
    pthread_barrier_init(&all_are_here, NULL, SCENES);
    for (int i = 0; i < SCENES; i++) {
        together[i] = (struct painter){{.number = i}, def};
        start_thread(&threads[i], run, &together[i]);
    }
    for (int i = 0; i < SCENES; i++) {
        pthread_join(threads[i], NULL);
        const struct scene *const scene = &together[i].scene;
        pictures[i] = outside_show(scene->context, names[i], scene->picture);
        check_middle(scene, pictures[i]);
        check(scene->complaints.count == 0, "no misuse while four contexts draw");
        rhw_context_destroy(scene->context);
    }
    for (int i = 0; i < SCENES; i++) {
        alone[i].number = i;
        make_scene(&alone[i], def);
        draw_frames(&alone[i]);
        check(looks_like(&alone[i], pictures[i]), "a scene is the same, drawn alone or beside three others");
    }
    for (int i = 0; i < SCENES; i++) {
        const int other = (i + 1) % SCENES;
        check_foreign_ids(&alone[i], &alone[other]);
        check(looks_like(&alone[i], pictures[i]), "foreign ids change nothing");
        check(looks_like(&alone[other], pictures[other]), "nor in the context they come from");
        check_intruder(&alone[i]);
        check(looks_like(&alone[i], pictures[i]), "an intruder changes nothing");
    }
    for (int i = 0; i < SCENES; i++) {
        rhw_context_destroy(alone[i].context);
        free(pictures[i]);
    }
    pthread_barrier_destroy(&all_are_here);
    return outside_status();
}
