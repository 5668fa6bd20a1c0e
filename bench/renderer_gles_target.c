// SPDX-License-Identifier: MIT
// What the passes of a scene draw into, and reading the picture; see renderer_gles.h.
#include "renderer_gles.h"

#include <stdlib.h>

// The picture's depth, a texture where it is read back. A depth buffer that nobody reads is a renderbuffer.
static GLuint make_depth_texture(const struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    GLuint texture;
    gl->gen_textures(1, &texture);
    gl->bind_texture(GL_TEXTURE_2D, texture);
    gl->tex_storage_2d(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, s->width, s->height);
    gl->tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl->tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return texture;
}

static GLuint make_renderbuffer(const struct gles *gl, GLenum format, int samples, int width, int height)
{
    GLuint buffer;
    gl->gen_renderbuffers(1, &buffer);
    gl->bind_renderbuffer(GL_RENDERBUFFER, buffer);
    if (samples > 1) {
        gl->renderbuffer_storage_multisample(GL_RENDERBUFFER, samples, format, width, height);
    } else {
        gl->renderbuffer_storage(GL_RENDERBUFFER, format, width, height);
    }
    return buffer;
}

// The format of the picture. Those of 16 bits and the order blue, green, red are extensions. Formats with a sign have
// none, as Mesa does not read them back.
static GLenum picture_format(const struct bench_scene *scene)
{
    static const GLenum formats[BENCH_FORMATS] = {
        [BENCH_RGBA8] = GL_RGBA8,     [BENCH_RGBA16F] = GL_RGBA16F,
        [BENCH_R32F] = GL_R32F,       [BENCH_R8] = GL_R8,
        [BENCH_RG8] = GL_RG8,         [BENCH_BGRA8] = 0x93a1,
        [BENCH_R16] = 0x822a,         [BENCH_RG16] = 0x822c,
        [BENCH_RGBA16] = 0x805b,      [BENCH_RGB10A2] = GL_RGB10_A2,
        [BENCH_RGB565] = GL_RGB565,   [BENCH_R16F] = GL_R16F,
        [BENCH_RG16F] = GL_RG16F,     [BENCH_RG32F] = GL_RG32F,
        [BENCH_RGBA32F] = GL_RGBA32F, [BENCH_RG11B10F] = GL_R11F_G11F_B10F,
        [BENCH_RGBA4] = GL_RGBA4,     [BENCH_RGB5A1] = GL_RGB5_A1};
    return scene->surfaces ? GL_SRGB8_ALPHA8 : formats[scene->picture];
}

// A framebuffer of several samples, which frames draw into and resolve.
static bool make_samples(struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    const int samples = s->scene->samples;
    gl->gen_framebuffers(1, &s->sampled);
    gl->bind_framebuffer(GL_FRAMEBUFFER, s->sampled);
    s->sampled_color = make_renderbuffer(gl, GL_RGBA8, samples, s->width, s->height);
    gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, s->sampled_color);
    s->sampled_depth = make_renderbuffer(gl, GL_DEPTH_COMPONENT32F, samples, s->width, s->height);
    gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, s->sampled_depth);
    return gl->check_framebuffer_status(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void gles_resolve(const struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    const GLuint picture = s->targets[s->scene->pass_count - 1].framebuffer;
    gl->bind_framebuffer(GL_READ_FRAMEBUFFER, s->sampled);
    gl->bind_framebuffer(GL_DRAW_FRAMEBUFFER, picture);
    gl->blit_framebuffer(0, 0, s->width, s->height, 0, 0, s->width, s->height, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
    gl->bind_framebuffer(GL_READ_FRAMEBUFFER, picture);
}

static void attach_colors(const struct gles_state *s, const struct bench_pass *pass)
{
    const struct gles *const gl = &s->gl;
    GLenum buffers[BENCH_PASS_COLORS] = {GL_NONE};
    for (int i = 0; i < pass->color_count; i++) {
        const GLenum attachment = buffers[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
        if (pass->colors[i] == BENCH_PICTURE) {
            gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, s->color);
        } else {
            const bool cube = s->scene->textures[pass->colors[i]].cube;
            gl->framebuffer_texture_2d(GL_FRAMEBUFFER, attachment,
                                       cube ? GL_TEXTURE_CUBE_MAP_POSITIVE_X + (GLenum)pass->face
                                            : GL_TEXTURE_2D,
                                       s->textures[pass->colors[i]], 0);
        }
    }
    gl->draw_buffers(pass->color_count ? pass->color_count : 1, buffers);
}

// `before`: the target of the pass before, or NULL.
static void attach_depth(const struct gles_state *s, const struct bench_pass *pass,
                         struct gles_target *target, const struct gles_target *before)
{
    const struct gles *const gl = &s->gl;
    const bool stencil = pass->depth == BENCH_PASS_DEPTH_STENCIL;
    const GLenum attachment = stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    if (pass->depth == BENCH_PASS_NO_DEPTH) {
        return;
    }
    if (pass->depth == BENCH_PASS_DEPTH_KEPT) {
        gl->framebuffer_texture_2d(
            GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D,
            pass->depth_texture == BENCH_PICTURE ? s->depth : s->textures[pass->depth_texture], 0);
        return;
    }
    if (before && before->depth && pass[-1].depth == pass->depth && before->width == target->width &&
        before->height == target->height) {
        target->depth = before->depth;
    } else {
        target->depth = make_renderbuffer(gl, stencil ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT32F, 0,
                                          target->width, target->height);
    }
    gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, target->depth);
}

bool gles_targets_make(struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    const struct bench_scene *const scene = s->scene;
    bool complete = true;
    if (scene->has_color) {
        s->color = make_renderbuffer(gl, picture_format(scene), 0, s->width, s->height);
    } else {
        s->depth = make_depth_texture(s);
    }
    s->targets = calloc(scene->pass_count, sizeof *s->targets);
    for (uint32_t i = 0; s->targets && i < scene->pass_count; i++) {
        struct gles_target *const target = &s->targets[i];
        target->width = s->width;
        target->height = s->height;
        bench_pass_size(scene, &scene->passes[i], &target->width, &target->height);
        gl->gen_framebuffers(1, &target->framebuffer);
        gl->bind_framebuffer(GL_FRAMEBUFFER, target->framebuffer);
        attach_colors(s, &scene->passes[i]);
        attach_depth(s, &scene->passes[i], target, i ? target - 1 : NULL);
        complete = complete && gl->check_framebuffer_status(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    }
    return s->targets && complete && (scene->samples <= 1 || make_samples(s));
}

void gles_targets_drop(struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    for (uint32_t i = 0; s->targets && i < s->scene->pass_count; i++) {
        gl->delete_framebuffers(1, &s->targets[i].framebuffer);
        if (i == 0 || s->targets[i].depth != s->targets[i - 1].depth) {
            gl->delete_renderbuffers(1, &s->targets[i].depth); // 0 is ignored
        }
    }
    gl->delete_renderbuffers(1, &s->color);
    gl->delete_textures(1, &s->depth);
    gl->delete_framebuffers(1, &s->sampled);
    gl->delete_renderbuffers(1, &s->sampled_color);
    gl->delete_renderbuffers(1, &s->sampled_depth);
    free(s->targets);
    s->targets = NULL;
    s->color = s->depth = s->sampled = s->sampled_color = s->sampled_depth = 0;
}

// GLES gives no depth to a program, but it lets a shader sample it.
bool gles_read_depth(struct gles_state *s, float *depth)
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
    return gl->get_error() == GL_NO_ERROR;
}

// Floats are read as such and rounded here.
static bool read_floats(const struct gles_state *s, uint8_t *color)
{
    const size_t count = 4 * (size_t)s->width * (size_t)s->height;
    float *const pixels = malloc(count * sizeof *pixels);
    if (!pixels) {
        return false;
    }
    s->gl.read_pixels(0, 0, s->width, s->height, GL_RGBA, GL_FLOAT, pixels);
    for (size_t i = 0; i < count; i++) {
        const float value = pixels[i] > 0.0f ? pixels[i] < 1.0f ? pixels[i] : 1.0f : 0.0f;
        color[i] = (uint8_t)(value * 255.0f + 0.5f);
    }
    free(pixels);
    return s->gl.get_error() == GL_NO_ERROR;
}

static bool is_float(enum bench_format format)
{
    return format == BENCH_RGBA16F || format == BENCH_R32F || format >= BENCH_R16F;
}

// Channels of 16 bits are read as such, and rounded to 8.
static bool read_shorts(const struct gles_state *s, uint8_t *color)
{
    const size_t count = 4 * (size_t)s->width * (size_t)s->height;
    uint16_t *const pixels = malloc(count * sizeof *pixels);
    if (!pixels) {
        return false;
    }
    s->gl.read_pixels(0, 0, s->width, s->height, GL_RGBA, GL_UNSIGNED_SHORT, pixels);
    for (size_t i = 0; i < count; i++) {
        color[i] = (uint8_t)((pixels[i] * 255u + 32767u) / 65535u);
    }
    free(pixels);
    return s->gl.get_error() == GL_NO_ERROR;
}

bool gles_read_color(const struct gles_state *s, uint8_t *color)
{
    const enum bench_format format = s->scene->picture;
    if (is_float(format)) {
        return read_floats(s, color);
    }
    if (format == BENCH_R16 || format == BENCH_RG16 || format == BENCH_RGBA16) {
        return read_shorts(s, color);
    }
    s->gl.read_pixels(0, 0, s->width, s->height, GL_RGBA, GL_UNSIGNED_BYTE, color);
    return s->gl.get_error() == GL_NO_ERROR;
}
