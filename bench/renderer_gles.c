// SPDX-License-Identifier: MIT
// A Mesa driver under measurement, through OpenGL ES 3. It draws into a renderbuffer, which llvmpipe and
// softpipe keep as rows of RGBA8 in memory, as rhw does; glFinish waits until they stand there. What reading
// back costs on top (glReadPixels copies once more) is not counted.
#include "renderer.h"

#include "gles.h"
#include "scene_pbr.h"
#include "shaders_bench.h"
#include "shaders_glsl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct gles_shader {
    GLuint program;
    GLint uniforms;
};

struct gles_state {
    struct gles gl;
    const struct bench_scene *scene;
    int width, height;
    struct gles_shader shaders[BENCH_SHADERS];    // made when first needed, kept
    GLuint show_depth;                            // program of read_depth; 0: not made yet
    GLuint framebuffer, color, depth;             // a renderbuffer and a texture
    GLuint sampled, sampled_color, sampled_depth; // what is drawn into with several samples; else 0
    GLuint *arrays, *vertices, *indices;          // per mesh
    GLuint *textures;
    float *uniforms; // per draw, `uniform_count` floats
    uint32_t uniform_count;
};

// Scenes -------------------------------------------------------------------------------------------

static void make_mesh(struct gles_state *s, uint32_t i)
{
    static const GLint components[BENCH_ATTRIBUTES] = {3, 3, 2, 4, 4};
    const struct gles *const gl = &s->gl;
    const struct bench_mesh *const mesh = &s->scene->meshes[i];
    const size_t stride = bench_mesh_stride(mesh) * sizeof(float);
    gl->bind_vertex_array(s->arrays[i]);
    gl->bind_buffer(GL_ARRAY_BUFFER, s->vertices[i]);
    gl->buffer_data(GL_ARRAY_BUFFER, (GLsizeiptr)(mesh->vertex_count * stride), mesh->vertices,
                    GL_STATIC_DRAW);
    gl->bind_buffer(GL_ELEMENT_ARRAY_BUFFER, s->indices[i]);
    gl->buffer_data(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(mesh->index_count * sizeof *mesh->indices),
                    mesh->indices, GL_STATIC_DRAW);
    const char *offset = NULL;
    for (GLuint a = 0; a < BENCH_ATTRIBUTES; a++) {
        if (mesh->has[a]) {
            gl->vertex_attrib_pointer(a, components[a], GL_FLOAT, GL_FALSE, (GLsizei)stride, offset);
            gl->enable_vertex_attrib_array(a);
            offset += (size_t)components[a] * sizeof(float);
        }
    }
}

static void make_texture(struct gles_state *s, uint32_t i)
{
    const struct gles *const gl = &s->gl;
    const struct bench_texture *const texture = &s->scene->textures[i];
    if (!texture->texels[0]) {
        return; // of a slot that no draw reads
    }
    gl->bind_texture(GL_TEXTURE_2D, s->textures[i]);
    gl->tex_storage_2d(GL_TEXTURE_2D, texture->levels, texture->srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8,
                       texture->width, texture->height);
    for (int level = 0; level < texture->levels; level++) {
        const int width = texture->width >> level, height = texture->height >> level;
        gl->tex_sub_image_2d(GL_TEXTURE_2D, level, 0, 0, width ? width : 1, height ? height : 1, GL_RGBA,
                             GL_UNSIGNED_BYTE, texture->texels[level]);
    }
    gl->tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    gl->tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (s->scene->max_anisotropy > 1) { // GL_EXT_texture_filter_anisotropic
        const GLenum max_anisotropy = 0x84fe;
        gl->tex_parameter_i(GL_TEXTURE_2D, max_anisotropy, s->scene->max_anisotropy);
    }
}

static bool make_shader(struct gles_state *s, enum bench_shader shader)
{
    const char *vertex[BENCH_GLSL_PIECES], *fragment[BENCH_GLSL_PIECES];
    char log[200] = "does not link";
    struct gles_shader *const made = &s->shaders[shader];
    if (made->program) {
        return true;
    }
    bench_glsl(shader, vertex, fragment);
    made->program = gles_program(&s->gl, vertex, fragment, BENCH_GLSL_PIECES, log, sizeof log);
    if (!made->program) {
        fprintf(stderr, "%s: shader %d: %s\n", s->gl.name, (int)shader, log);
        return false;
    }
    made->uniforms = s->gl.get_uniform_location(made->program, "u");
    s->gl.use_program(made->program);
    for (int i = 0; i < BENCH_DRAW_TEXTURES; i++) {
        const char name[] = {'m', 'a', 'p', (char)('0' + i), '\0'};
        s->gl.uniform_1i(s->gl.get_uniform_location(made->program, name),
                         i); // −1, of what is not read, is ignored
    }
    return true;
}

// What stays the same over the frames of a scene.
static void set_frame_uniforms(const struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    const struct bench_frame_uniforms *const uniforms = &s->scene->surfaces->frame_uniforms;
    for (int i = BENCH_SHADER_PBR_BASE; i < BENCH_SHADERS; i++) {
        if (s->shaders[i].program) {
            gl->use_program(s->shaders[i].program);
            gl->uniform_4fv(gl->get_uniform_location(s->shaders[i].program, "f"),
                            sizeof *uniforms / (4 * sizeof(float)), uniforms->eye);
        }
    }
}

// GL's rows run from the bottom to the top, those of rhw from the top to the bottom. With y turned round they stand in
// memory alike, and what lies between two pixels goes to the same one.
static bool make_uniforms(struct gles_state *s)
{
    const struct bench_scene *const scene = s->scene;
    s->uniform_count =
        (scene->surfaces ? sizeof *scene->surfaces->uniforms : sizeof scene->draws->uniforms) / sizeof(float);
    s->uniforms = calloc((size_t)scene->draw_count + 1, s->uniform_count * sizeof(float));
    for (uint32_t i = 0; s->uniforms && i < scene->draw_count; i++) {
        float *const to = s->uniforms + (size_t)i * s->uniform_count;
        memcpy(to, scene->surfaces ? scene->surfaces->uniforms[i].clip : scene->draws[i].uniforms.clip,
               s->uniform_count * sizeof(float));
        for (int column = 0; column < 4; column++) {
            to[4 * column + 1] = -to[4 * column + 1];
        }
    }
    return s->uniforms != NULL;
}

static void attach_depth(struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    gl->gen_textures(1, &s->depth);
    gl->bind_texture(GL_TEXTURE_2D, s->depth);
    gl->tex_storage_2d(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, s->width, s->height);
    gl->tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl->framebuffer_texture_2d(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, s->depth, 0);
}

// A framebuffer of several samples, which frames draw into and resolve.
static bool make_samples(struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    const GLsizei samples = s->scene->samples;
    gl->gen_framebuffers(1, &s->sampled);
    gl->bind_framebuffer(GL_FRAMEBUFFER, s->sampled);
    gl->gen_renderbuffers(1, &s->sampled_color);
    gl->bind_renderbuffer(GL_RENDERBUFFER, s->sampled_color);
    gl->renderbuffer_storage_multisample(GL_RENDERBUFFER, samples, GL_RGBA8, s->width, s->height);
    gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, s->sampled_color);
    gl->gen_renderbuffers(1, &s->sampled_depth);
    gl->bind_renderbuffer(GL_RENDERBUFFER, s->sampled_depth);
    gl->renderbuffer_storage_multisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT32F, s->width,
                                         s->height);
    gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, s->sampled_depth);
    return gl->check_framebuffer_status(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

static void resolve_samples(const struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    gl->bind_framebuffer(GL_READ_FRAMEBUFFER, s->sampled);
    gl->bind_framebuffer(GL_DRAW_FRAMEBUFFER, s->framebuffer);
    gl->blit_framebuffer(0, 0, s->width, s->height, 0, 0, s->width, s->height, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
    gl->bind_framebuffer(GL_READ_FRAMEBUFFER, s->framebuffer);
}

static bool make_targets(struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    gl->gen_framebuffers(1, &s->framebuffer);
    gl->bind_framebuffer(GL_FRAMEBUFFER, s->framebuffer);
    if (s->scene->has_color) {
        gl->gen_renderbuffers(1, &s->color);
        gl->bind_renderbuffer(GL_RENDERBUFFER, s->color);
        gl->renderbuffer_storage(GL_RENDERBUFFER, s->scene->surfaces ? GL_SRGB8_ALPHA8 : GL_RGBA8, s->width,
                                 s->height);
        gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, s->color);
    }
    // Without depth llvmpipe drops what an opaque triangle hides in a tile of 64×64, and would draw one of 8 floors.
    if (!s->scene->without_depth) {
        attach_depth(s);
    }
    const GLenum target = s->scene->has_color ? GL_COLOR_ATTACHMENT0 : GL_NONE;
    gl->draw_buffers(1, &target);
    return gl->check_framebuffer_status(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE &&
           (s->scene->samples <= 1 || make_samples(s));
}

// State that no draw of the scene changes.
static void set_state(const struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    const struct bench_scene *const scene = s->scene;
    (scene->depth_test ? gl->enable : gl->disable)(GL_DEPTH_TEST);
    (scene->blends ? gl->enable : gl->disable)(GL_BLEND);
    gl->blend_func(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    gl->depth_func(GL_LESS);
    gl->front_face(GL_CW); // y is turned round, see make_uniforms
    gl->disable(GL_DITHER);
    gl->viewport(0, 0, s->width, s->height);
    gl->clear_color(scene->clear[0], scene->clear[1], scene->clear[2], scene->clear[3]);
}

static bool take(struct bench_renderer *renderer, const struct bench_scene *scene, int width, int height)
{
    struct gles_state *const s = renderer->state;
    const struct gles *const gl = &s->gl;
    s->scene = scene;
    s->width = width;
    s->height = height;
    s->arrays = calloc((size_t)scene->mesh_count + 1, sizeof *s->arrays);
    s->vertices = calloc((size_t)scene->mesh_count + 1, sizeof *s->vertices);
    s->indices = calloc((size_t)scene->mesh_count + 1, sizeof *s->indices);
    s->textures = calloc((size_t)scene->texture_count + 1, sizeof *s->textures);
    if (!s->arrays || !s->vertices || !s->indices || !s->textures || !make_uniforms(s) || !make_targets(s)) {
        return false;
    }
    gl->gen_vertex_arrays((GLsizei)scene->mesh_count, s->arrays);
    gl->gen_buffers((GLsizei)scene->mesh_count, s->vertices);
    gl->gen_buffers((GLsizei)scene->mesh_count, s->indices);
    gl->gen_textures((GLsizei)scene->texture_count, s->textures);
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        make_mesh(s, i);
    }
    for (uint32_t i = 0; i < scene->texture_count; i++) {
        make_texture(s, i);
    }
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        if (!make_shader(s, scene->draws[i].shader)) {
            return false;
        }
    }
    if (scene->surfaces) {
        set_frame_uniforms(s);
    }
    set_state(s);
    return gl->get_error() == GL_NO_ERROR;
}

static void release(struct bench_renderer *renderer)
{
    struct gles_state *const s = renderer->state;
    const struct gles *const gl = &s->gl;
    if (s->arrays && s->vertices && s->indices && s->textures) {
        gl->delete_vertex_arrays((GLsizei)s->scene->mesh_count, s->arrays); // 0 is ignored
        gl->delete_buffers((GLsizei)s->scene->mesh_count, s->vertices);
        gl->delete_buffers((GLsizei)s->scene->mesh_count, s->indices);
        gl->delete_textures((GLsizei)s->scene->texture_count, s->textures);
    }
    gl->delete_framebuffers(1, &s->framebuffer);
    gl->delete_renderbuffers(1, &s->color);
    gl->delete_textures(1, &s->depth);
    gl->delete_framebuffers(1, &s->sampled); // 0 is ignored
    gl->delete_renderbuffers(1, &s->sampled_color);
    gl->delete_renderbuffers(1, &s->sampled_depth);
    free(s->arrays);
    free(s->vertices);
    free(s->indices);
    free(s->textures);
    free(s->uniforms);
    s->arrays = s->vertices = s->indices = s->textures = NULL;
    s->uniforms = NULL;
    s->framebuffer = s->color = s->depth = s->sampled = s->sampled_color = s->sampled_depth = 0;
}

// Frames -------------------------------------------------------------------------------------------

static bool frame(struct bench_renderer *renderer)
{
    const struct gles_state *const s = renderer->state;
    const struct gles *const gl = &s->gl;
    const struct bench_scene *const scene = s->scene;
    const GLenum depth = GL_DEPTH_ATTACHMENT;
    if (s->sampled) {
        gl->bind_framebuffer(GL_FRAMEBUFFER, s->sampled);
    }
    gl->clear((scene->has_color ? GL_COLOR_BUFFER_BIT : 0) | GL_DEPTH_BUFFER_BIT);
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        const struct bench_draw *const draw = &scene->draws[i];
        gl->use_program(s->shaders[draw->shader].program);
        gl->uniform_4fv(s->shaders[draw->shader].uniforms, (GLsizei)s->uniform_count / 4,
                        s->uniforms + (size_t)i * s->uniform_count);
        gl->bind_vertex_array(s->arrays[draw->mesh]);
        for (int t = draw->texture_count - 1; t >= 0; t--) { // unit 0 last: it stays the active one
            gl->active_texture(GL_TEXTURE0 + (GLenum)t);
            gl->bind_texture(GL_TEXTURE_2D, s->textures[draw->textures[t]]);
        }
        (draw->cull_back ? gl->enable : gl->disable)(GL_CULL_FACE);
        const struct bench_mesh *const mesh = &scene->meshes[draw->mesh];
        gl->draw_elements(mesh->points ? GL_POINTS : GL_TRIANGLES, (GLsizei)mesh->index_count,
                          GL_UNSIGNED_INT, NULL);
    }
    if (scene->has_color && !scene->without_depth) {
        gl->invalidate_framebuffer(GL_FRAMEBUFFER, 1, &depth);
    }
    if (s->sampled) {
        resolve_samples(s);
    }
    gl->finish();
    return gl->get_error() == GL_NO_ERROR;
}

// GLES gives no depth to a program, but it lets a shader sample it.
static bool read_depth(struct gles_state *s, float *depth)
{
    static const char vertex[] = "#version 300 es\n"
                                 "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0,\n"
                                 "    gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }\n";
    static const char fragment[] = "#version 300 es\n"
                                   "precision highp float; precision highp sampler2D;\n"
                                   "uniform sampler2D base; layout(location = 0) out vec4 target;\n"
                                   "void main() { target = texelFetch(base, ivec2(gl_FragCoord.xy), 0); }\n";
    const struct gles *const gl = &s->gl;
    const char *const sources[2] = {vertex, fragment};
    const size_t count = (size_t)s->width * (size_t)s->height;
    float *const pixels = malloc((count + 1) * 4 * sizeof *pixels);
    GLuint framebuffer, array, target;
    if (!s->show_depth) {
        s->show_depth = gles_program(gl, &sources[0], &sources[1], 1, NULL, 0);
    }
    if (!pixels || !s->show_depth) {
        free(pixels);
        return false;
    }
    gl->gen_framebuffers(1, &framebuffer);
    gl->bind_framebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->gen_renderbuffers(1, &target);
    gl->bind_renderbuffer(GL_RENDERBUFFER, target);
    gl->renderbuffer_storage(GL_RENDERBUFFER, GL_RGBA32F, s->width, s->height);
    gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target);
    gl->gen_vertex_arrays(1, &array);
    gl->bind_vertex_array(array);
    gl->bind_texture(GL_TEXTURE_2D, s->depth);
    gl->use_program(s->show_depth);
    gl->disable(GL_DEPTH_TEST);
    gl->disable(GL_CULL_FACE);
    gl->draw_arrays(GL_TRIANGLES, 0, 3);
    gl->read_pixels(0, 0, s->width, s->height, GL_RGBA, GL_FLOAT, pixels);
    for (size_t i = 0; i < count; i++) {
        depth[i] = pixels[4 * i];
    }
    free(pixels);
    gl->delete_vertex_arrays(1, &array);
    gl->delete_framebuffers(1, &framebuffer);
    gl->delete_renderbuffers(1, &target);
    gl->bind_framebuffer(GL_FRAMEBUFFER, s->framebuffer);
    set_state(s);
    return gl->get_error() == GL_NO_ERROR;
}

static bool read_color(struct gles_state *s, uint8_t *color)
{
    s->gl.read_pixels(0, 0, s->width, s->height, GL_RGBA, GL_UNSIGNED_BYTE, color);
    return s->gl.get_error() == GL_NO_ERROR;
}

static bool read_image(struct bench_renderer *renderer, struct bench_image *image)
{
    struct gles_state *const s = renderer->state;
    return (!image->color || read_color(s, image->color)) && (!image->depth || read_depth(s, image->depth));
}

static void close_gles(struct bench_renderer *renderer)
{
    struct gles_state *const s = renderer->state;
    gles_close(&s->gl);
    free(s);
    *renderer = (struct bench_renderer){0};
}

bool bench_open_gles(struct bench_renderer *renderer, const char *driver, const char **why)
{
    struct gles_state *const s = calloc(1, sizeof *s);
    *why = "out of memory";
    if (!s || !gles_open(&s->gl, driver, why)) {
        free(s);
        return false;
    }
    *renderer = (struct bench_renderer){
        .state = s, .take = take, .frame = frame, .read = read_image, .release = release, .close = close_gles};
    snprintf(renderer->name, sizeof renderer->name, "%.150s", s->gl.name);
    return true;
}
