// SPDX-License-Identifier: MIT
// See stage.h. What is to be drawn is kept, so that a pixel can be asked about later.
#include "stage.h"

#include "draw/camera/camera.h"
#include "rhw/rhw.h"
#include "stage_explain.h"
#include "stage_matrix.h"
#include "stage_shaders.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct corner {
    double world[3];
    struct stage_vertex vertex;
};

struct triangle {
    struct corner corners[3];
    enum stage_method method;
    enum stage_pattern pattern;
    int first, end; // columns
};

static struct {
    rhw_context *context;
    rhw_texture target;
    rhw_buffer vertices;
    rhw_pipeline pipelines[2][2]; // smooth? knows its place?
    int width, height, samples;
    double clip_from_world[16];
    float near;
    float clear[4];
    struct corner corners[3];
    struct triangle triangles[STAGE_MAX_TRIANGLES];
    int triangle_count;
    uint8_t *pixels;
    double clip[4];
    double numbers[STAGE_MAX_NUMBERS];
    double *world; // of the numbers, those by way of the world
    bool has_numbers;
    enum stage_method method; // of the fragment that has them
    char error[160];
} stage;

static bool fail(const char *what, enum rhw_result result)
{
    snprintf(stage.error, sizeof stage.error, "%s: %s", what, rhw_result_string(result));
    return false;
}

static bool refuse(const char *rule)
{
    snprintf(stage.error, sizeof stage.error, "%s", rule);
    return false;
}

const char *stage_error(void)
{
    return stage.error;
}

// Beginning ------------------------------------------------------------------------------------------

static enum rhw_result make_pipeline(bool smooth, bool placed)
{
    const enum rhw_qualifier qualifier = smooth ? RHW_SMOOTH : RHW_NOPERSPECTIVE;
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){
        .vertex = RHW_ISA_TABLE(stage_place),
        .fragment = RHW_ISA_TABLE(stage_paint),
        .varyings = {{.components = 2, .qualifier = qualifier, .derivatives = true},
                     {.components = 3, .qualifier = qualifier}},
        .varying_count = 2,
        .uses = placed ? RHW_USE_COORD : 0,
        .uniform_size = sizeof(struct stage_uniforms),
    };
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct stage_vertex, clip)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT2, 0, offsetof(struct stage_vertex, uv)};
    def.attributes[2] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct stage_vertex, color)};
    def.attribute_count = 3;
    def.buffers[0].stride = sizeof(struct stage_vertex);
    def.buffer_count = 1;
    def.depth_test = true;
    def.depth_compare = RHW_COMPARE_LESS_EQUAL;
    return rhw_pipeline_create(stage.context, &def, &stage.pipelines[smooth][placed]);
}

static enum rhw_result make_vertices(void)
{
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = sizeof(struct stage_vertex) * 3 * STAGE_MAX_TRIANGLES;
    return rhw_buffer_create(stage.context, &def, &stage.vertices);
}

bool stage_open(int threads)
{
    stage_close();
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    enum rhw_result result = rhw_context_create(&def, &stage.context);
    for (int i = 0; i < 4 && result == RHW_OK; i++) {
        result = make_pipeline((i & 1) != 0, (i & 2) != 0);
    }
    result = result != RHW_OK ? result : make_vertices();
    if (result != RHW_OK) {
        stage_close();
        return fail("the stage", result);
    }
    return true;
}

void stage_close(void)
{
    free(stage.pixels);
    if (stage.context) {
        rhw_context_destroy(stage.context);
    }
    memset(&stage, 0, sizeof stage);
}

// What is to be drawn --------------------------------------------------------------------------------

bool stage_resize(int width, int height, int samples)
{
    const bool known = samples == 1 || samples == 2 || samples == 4 || samples == 8 || samples == 16;
    if (!stage.context || width < 1 || height < 1 || width > STAGE_MAX_SIZE || height > STAGE_MAX_SIZE ||
        !known) {
        return refuse("a picture is 1 to 4096 pixels wide and high, of 1, 2, 4, 8 or 16 samples");
    }
    stage.samples = samples;
    if (width == stage.width && height == stage.height) {
        return true;
    }
    uint8_t *const pixels = malloc((size_t)width * (size_t)height * 4);
    struct rhw_texture_def def = rhw_texture_def_default();
    def.width = width;
    def.height = height;
    rhw_texture target;
    const enum rhw_result result =
        pixels ? rhw_texture_create(stage.context, &def, &target) : RHW_ERROR_OUT_OF_MEMORY;
    if (result != RHW_OK) {
        free(pixels);
        return fail("the picture", result);
    }
    if (stage.pixels) {
        rhw_texture_destroy(stage.context, stage.target);
        free(stage.pixels);
    }
    stage.pixels = pixels;
    stage.target = target;
    stage.width = width;
    stage.height = height;
    return true;
}

bool stage_camera(double eye_x, double eye_y, double eye_z, double target_x, double target_y, double target_z,
                  double yfov, double near, double far)
{
    const bool apart = eye_x != target_x || eye_y != target_y || eye_z != target_z;
    if (!stage.pixels || !(near > 0 && far > near && yfov > 0 && yfov < 180) || !apart) {
        return refuse(
            "a camera looks elsewhere than where it is, at 0 to 180 degrees, from near to far, after "
            "the picture has its size");
    }
    const struct scene_camera camera = {.eye = {eye_x, eye_y, eye_z},
                                        .target = {target_x, target_y, target_z},
                                        .up = {0, 1, 0},
                                        .yfov = yfov * (3.14159265358979323846 / 180),
                                        .znear = near,
                                        .zfar = far};
    stage.near = (float)near;
    double view[16], projection[16];
    scene_camera_view(&camera, view);
    scene_camera_projection(&camera, (double)stage.width / stage.height, projection);
    scene_matrix_multiply(projection, view, stage.clip_from_world);
    return true;
}

void stage_clear(double red, double green, double blue)
{
    stage.triangle_count = 0;
    stage.clear[0] = (float)red;
    stage.clear[1] = (float)green;
    stage.clear[2] = (float)blue;
    stage.clear[3] = 1;
}

static void clip_of(const double world[3], float clip[4])
{
    const double *const m = stage.clip_from_world;
    for (int i = 0; i < 4; i++) {
        clip[i] = (float)(m[i] * world[0] + m[4 + i] * world[1] + m[8 + i] * world[2] + m[12 + i]);
    }
}

bool stage_corner(int corner, double x, double y, double z, double red, double green, double blue, double u,
                  double v)
{
    if (corner < 0 || corner > 2) {
        return refuse("a triangle has the corners 0, 1 and 2");
    }
    struct corner *const c = &stage.corners[corner];
    *c = (struct corner){{x, y, z},
                         {.uv = {(float)u, (float)v}, .color = {(float)red, (float)green, (float)blue}}};
    clip_of(c->world, c->vertex.clip);
    return true;
}

bool stage_triangle(int method, int pattern, int first, int end)
{
    if (method < 0 || method >= STAGE_METHODS || pattern < 0 || pattern >= STAGE_PATTERNS ||
        stage.triangle_count == STAGE_MAX_TRIANGLES) {
        return refuse("a stage has three methods, seven patterns and 64 triangles");
    }
    struct triangle *const triangle = &stage.triangles[stage.triangle_count++];
    memcpy(triangle->corners, stage.corners, sizeof triangle->corners);
    triangle->method = (enum stage_method)method;
    triangle->pattern = (enum stage_pattern)pattern;
    triangle->first = first < 0 ? 0 : first;
    triangle->end = end > stage.width ? stage.width : end;
    triangle->end = triangle->end < triangle->first ? triangle->first : triangle->end;
    return true;
}

const double *stage_clip(double x, double y, double z)
{
    float clip[4];
    clip_of((double[3]){x, y, z}, clip);
    for (int i = 0; i < 4; i++) {
        stage.clip[i] = (double)clip[i];
    }
    return stage.clip;
}

// Drawing --------------------------------------------------------------------------------------------

// From (column, row, depth, 1) to the world, up to a factor: the viewport's way back, then the camera's.
static void world_from_screen(float rows[4][4])
{
    const double w = 2.0 / stage.width, h = -2.0 / stage.height;
    const double clip_from_screen[16] = {w, 0, 0, 0, 0, h, 0, 0, 0, 0, 1, 0, -1, 1, 0, 1};
    double world_from_clip[16], product[16];
    if (!stage_matrix_invert(stage.clip_from_world, world_from_clip)) {
        return;
    }
    scene_matrix_multiply(world_from_clip, clip_from_screen, product);
    for (int i = 0; i < 16; i++) {
        rows[i % 4][i / 4] = (float)product[i];
    }
}

// Corners behind the eye have a 1/W below 0; of what is seen none is above 1/near, W being the distance.
static float largest_inverse_w(const struct triangle *triangle)
{
    float smallest = triangle->corners[0].vertex.clip[3];
    for (int i = 1; i < 3; i++) {
        const float w = triangle->corners[i].vertex.clip[3];
        smallest = w < smallest ? w : smallest;
    }
    return 1 / (smallest > stage.near ? smallest : stage.near);
}

static void set_uniforms(const struct triangle *triangle, enum stage_told told,
                         struct stage_uniforms *uniforms)
{
    memset(uniforms, 0, sizeof *uniforms);
    uniforms->by_world = triangle->method == STAGE_WORLD;
    uniforms->told = uniforms->by_world ? (int32_t)told : STAGE_TOLD_COLOR;
    uniforms->pattern = (int32_t)triangle->pattern;
    uniforms->largest_inverse_w = largest_inverse_w(triangle);
    if (uniforms->by_world) {
        world_from_screen(uniforms->world_from_screen);
    }
    for (int i = 0; i < 3; i++) {
        const struct corner *const corner = &triangle->corners[i];
        for (int k = 0; k < 3; k++) {
            uniforms->corner[i][k] = (float)corner->world[k];
        }
        memcpy(uniforms->corner_uv[i], corner->vertex.uv, sizeof corner->vertex.uv);
        memcpy(uniforms->corner_color[i], corner->vertex.color, sizeof corner->vertex.color);
    }
}

static rhw_pipeline pipeline_of(const struct triangle *triangle)
{
    const bool placed = triangle->method == STAGE_WORLD || triangle->pattern == STAGE_DEPTH ||
                        triangle->pattern == STAGE_INVERSE_W || triangle->pattern == STAGE_UV_OVER_W;
    return stage.pipelines[triangle->method != STAGE_NAIVE][placed];
}

// What is asked of a pixel.
struct question {
    struct rhw_explain explain;
    enum stage_told told;
};

// Of the columns that a triangle is seen in all rows, or the pixel that is asked about.
static struct rhw_rect part_of(const struct triangle *triangle, const struct question *question)
{
    const int first = triangle->first, width = triangle->end - first;
    if (!question) {
        return (struct rhw_rect){first, 0, width, stage.height};
    }
    const int x = question->explain.x, y = question->explain.y;
    const bool inside = x >= first && x < triangle->end;
    return (struct rhw_rect){x, y, inside, inside};
}

static void draw_triangle(rhw_pass pass, int number, const struct question *question)
{
    const struct triangle *const triangle = &stage.triangles[number];
    const struct rhw_rect part = part_of(triangle, question);
    struct stage_uniforms uniforms;
    set_uniforms(triangle, question ? question->told : STAGE_TOLD_COLOR, &uniforms);
    rhw_pass_set_pipeline(stage.context, pass, pipeline_of(triangle));
    rhw_pass_set_scissor(stage.context, pass, &part);
    rhw_pass_set_uniforms(stage.context, pass, &uniforms, sizeof uniforms);
    rhw_pass_draw(stage.context, pass, 3 * (uint32_t)number, 3, 0, 1);
}

static enum rhw_result write_vertices(void)
{
    struct stage_vertex vertices[3 * STAGE_MAX_TRIANGLES];
    for (int i = 0; i < 3 * stage.triangle_count; i++) {
        vertices[i] = stage.triangles[i / 3].corners[i % 3].vertex;
    }
    return stage.triangle_count == 0
               ? RHW_OK
               : rhw_buffer_write(stage.context, stage.vertices, 0, vertices,
                                  sizeof vertices[0] * 3 * (size_t)stage.triangle_count);
}

static bool draw_pass(int samples, const struct question *question)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.colors[0].texture = stage.target;
    memcpy(def.colors[0].clear, stage.clear, sizeof stage.clear);
    def.depth.enabled = true;
    def.depth.store = RHW_STORE_DISCARD;
    def.samples = samples;
    if (question) {
        def.render_area = (struct rhw_rect){question->explain.x, question->explain.y, 1, 1};
    }
    rhw_pass pass;
    enum rhw_result result = write_vertices();
    result = result != RHW_OK ? result : rhw_pass_begin(stage.context, &def, &pass);
    if (result != RHW_OK) {
        return fail("the picture", result);
    }
    if (question) {
        rhw_pass_explain(stage.context, pass, &question->explain);
    }
    rhw_pass_set_pipeline(stage.context, pass, stage.pipelines[0][0]);
    rhw_pass_set_vertex_buffer(stage.context, pass, 0, stage.vertices, 0);
    for (int i = 0; i < stage.triangle_count; i++) {
        draw_triangle(pass, i, question);
    }
    result = rhw_pass_end(stage.context, pass, NULL);
    return result == RHW_OK || fail("the picture", result);
}

const uint8_t *stage_draw(void)
{
    if (!stage.pixels) {
        refuse("the picture has no size yet");
        return NULL;
    }
    if (!draw_pass(stage.samples, NULL)) {
        return NULL;
    }
    const enum rhw_result result = rhw_texture_read(stage.context, stage.target, 0, stage.pixels, 0);
    if (result != RHW_OK) {
        fail("the picture", result);
        return NULL;
    }
    return stage.pixels;
}

// The fragment that is seen is the last one that was written.
static void note(void *user, const struct rhw_explained_fragment *fragment)
{
    const struct question *const question = user;
    if (fragment->fate != RHW_FRAGMENT_WRITTEN || !fragment->is_shaded) {
        return;
    }
    if (question->told == STAGE_TOLD_COLOR) {
        stage.method = stage.triangles[fragment->draw].method;
        stage.world = stage.numbers + stage_explain_numbers(fragment, (int)stage.method, stage.numbers);
        stage.has_numbers = true;
    } else {
        stage_explain_told(fragment, (int)question->told, stage.world);
    }
}

static bool ask(int x, int y, enum stage_told told)
{
    struct question question = {.explain = {.x = x, .y = y, .fragment = note}, .told = told};
    question.explain.user = &question;
    return draw_pass(1, &question);
}

const double *stage_explain(int x, int y)
{
    if (!stage.pixels || x < 0 || y < 0 || x >= stage.width || y >= stage.height) {
        refuse("there is no such pixel");
        return NULL;
    }
    stage.has_numbers = false;
    bool told = ask(x, y, STAGE_TOLD_COLOR) && stage.has_numbers;
    for (int i = STAGE_TOLD_COLOR + 1; i < STAGE_TOLD && told && stage.method == STAGE_WORLD; i++) {
        told = ask(x, y, (enum stage_told)i);
    }
    return told ? stage.numbers : NULL;
}
