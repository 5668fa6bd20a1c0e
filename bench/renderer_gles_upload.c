// SPDX-License-Identifier: MIT
// The meshes, textures, programs and uniforms of a scene, for a Mesa driver; see renderer_gles.h.
#include "renderer_gles.h"

#include "scene_pbr.h"
#include "shaders_bench.h"
#include "shaders_glsl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Meshes and textures --------------------------------------------------------------------------------

static void make_buffer(const struct gles *gl, GLenum target, GLuint buffer, const void *data, size_t size)
{
    gl->bind_buffer(target, buffer);
    gl->buffer_data(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
}

// Attributes first .. end − 1 of the mesh, in the buffer that is bound.
static void point_attributes(const struct gles *gl, const struct bench_mesh *mesh, GLuint first, GLuint end,
                             size_t stride)
{
    const char *offset = NULL;
    for (GLuint a = first; a < end; a++) {
        if (mesh->has[a]) {
            gl->vertex_attrib_pointer(a, bench_attribute_components[a], GL_FLOAT, GL_FALSE, (GLsizei)stride,
                                      offset);
            gl->enable_vertex_attrib_array(a);
            gl->vertex_attrib_divisor(a, first ? 1 : 0);
            offset += (size_t)bench_attribute_components[a] * sizeof(float);
        }
    }
}

static void make_mesh(struct gles_state *s, uint32_t i)
{
    const struct gles *const gl = &s->gl;
    const struct bench_mesh *const mesh = &s->scene->meshes[i];
    const size_t stride = bench_mesh_stride(mesh) * sizeof(float),
                 instance_stride = bench_mesh_instance_stride(mesh) * sizeof(float);
    gl->bind_vertex_array(s->arrays[i]);
    make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, s->indices[i], mesh->indices,
                mesh->index_count * sizeof *mesh->indices);
    make_buffer(gl, GL_ARRAY_BUFFER, s->vertices[i], mesh->vertices, mesh->vertex_count * stride);
    point_attributes(gl, mesh, 0, BENCH_VERTEX_ATTRIBUTES, stride);
    if (mesh->instance_count) {
        make_buffer(gl, GL_ARRAY_BUFFER, s->instances[i], mesh->instances,
                    mesh->instance_count * instance_stride);
        point_attributes(gl, mesh, BENCH_VERTEX_ATTRIBUTES, BENCH_ATTRIBUTES, instance_stride);
    }
}

static void set_filter(const struct gles_state *s, GLenum kind, enum bench_filter filter)
{
    const struct gles *const gl = &s->gl;
    const GLint near = filter == BENCH_FETCH ? GL_NEAREST : GL_LINEAR;
    gl->tex_parameter_i(kind, GL_TEXTURE_MIN_FILTER, filter <= BENCH_LEVELS ? GL_LINEAR_MIPMAP_LINEAR : near);
    gl->tex_parameter_i(kind, GL_TEXTURE_MAG_FILTER, near);
    if (filter != BENCH_TRILINEAR) {
        gl->tex_parameter_i(kind, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl->tex_parameter_i(kind, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    }
    if (filter == BENCH_COMPARE) {
        gl->tex_parameter_i(kind, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        gl->tex_parameter_i(kind, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    if (filter == BENCH_TRILINEAR && s->scene->max_anisotropy > 1) { // GL_EXT_texture_filter_anisotropic
        const GLenum max_anisotropy = 0x84fe;
        gl->tex_parameter_i(kind, max_anisotropy, s->scene->max_anisotropy);
    }
}

static void make_texture(struct gles_state *s, uint32_t i)
{
    static const GLenum formats[] = {[BENCH_RGBA8] = GL_RGBA8,
                                     [BENCH_SRGB8_ALPHA8] = GL_SRGB8_ALPHA8,
                                     [BENCH_RGBA16F] = GL_RGBA16F,
                                     [BENCH_R32F] = GL_R32F,
                                     [BENCH_D32F] = GL_DEPTH_COMPONENT32F};
    const struct gles *const gl = &s->gl;
    const struct bench_texture *const texture = &s->scene->textures[i];
    const GLenum kind = texture->cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D;
    if (!texture->target && !texture->texels[0]) {
        return; // of a slot that no draw reads
    }
    gl->bind_texture(kind, s->textures[i]);
    gl->tex_storage_2d(kind, texture->levels, formats[texture->format], texture->width, texture->height);
    for (int level = 0; level < texture->levels && !texture->target; level++) {
        const int width = texture->width >> level, height = texture->height >> level;
        gl->tex_sub_image_2d(GL_TEXTURE_2D, level, 0, 0, width ? width : 1, height ? height : 1, GL_RGBA,
                             GL_UNSIGNED_BYTE, texture->texels[level]);
    }
    set_filter(s, kind, texture->filter);
}

// Shaders --------------------------------------------------------------------------------------------

static bool make_shader(struct gles_state *s, enum bench_shader shader)
{
    const char *vertex[BENCH_GLSL_PIECES], *fragment[BENCH_GLSL_PIECES];
    char log[200] = "does not link";
    struct gles_shader *const made = &s->shaders[shader];
    if (made->program) {
        return true;
    }
    bench_glsl(BENCH_GLSL_ES, shader, vertex, fragment);
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
// memory alike: what lies between two pixels goes to the same one, and texels are found where rhw finds them.
static bool make_uniforms(struct gles_state *s)
{
    const struct bench_scene *const scene = s->scene;
    const size_t most =
        scene->surfaces ? sizeof *scene->surfaces->uniforms / sizeof(float) : BENCH_UNIFORMS_MAX;
    s->uniforms = calloc((size_t)scene->draw_count + 1, most * sizeof *s->uniforms);
    s->uniform_offsets = calloc((size_t)scene->draw_count + 1, sizeof *s->uniform_offsets);
    for (uint32_t i = 0; s->uniforms && s->uniform_offsets && i < scene->draw_count; i++) {
        float *const to = s->uniforms + s->uniform_offsets[i];
        size_t count = most;
        if (scene->surfaces) {
            memcpy(to, &scene->surfaces->uniforms[i], count * sizeof *to);
        } else {
            count = bench_uniforms_copy(scene, &scene->draws[i], to);
        }
        for (int column = 0; column < 4; column++) {
            to[4 * column + 1] = -to[4 * column + 1];
        }
        s->uniform_offsets[i + 1] = s->uniform_offsets[i] + count;
    }
    return s->uniforms && s->uniform_offsets;
}

bool gles_upload(struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    const struct bench_scene *const scene = s->scene;
    s->arrays = calloc((size_t)scene->mesh_count + 1, sizeof *s->arrays);
    s->vertices = calloc((size_t)scene->mesh_count + 1, sizeof *s->vertices);
    s->indices = calloc((size_t)scene->mesh_count + 1, sizeof *s->indices);
    s->instances = calloc((size_t)scene->mesh_count + 1, sizeof *s->instances);
    s->textures = calloc((size_t)scene->texture_count + 1, sizeof *s->textures);
    if (!s->arrays || !s->vertices || !s->indices || !s->instances || !s->textures || !make_uniforms(s)) {
        return false;
    }
    gl->gen_vertex_arrays((GLsizei)scene->mesh_count, s->arrays);
    gl->gen_buffers((GLsizei)scene->mesh_count, s->vertices);
    gl->gen_buffers((GLsizei)scene->mesh_count, s->indices);
    gl->gen_buffers((GLsizei)scene->mesh_count, s->instances);
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
    return gles_targets_make(s);
}

void gles_drop(struct gles_state *s)
{
    const struct gles *const gl = &s->gl;
    gles_targets_drop(s);
    if (s->arrays && s->vertices && s->indices && s->instances && s->textures) {
        gl->delete_vertex_arrays((GLsizei)s->scene->mesh_count, s->arrays); // 0 is ignored
        gl->delete_buffers((GLsizei)s->scene->mesh_count, s->vertices);
        gl->delete_buffers((GLsizei)s->scene->mesh_count, s->indices);
        gl->delete_buffers((GLsizei)s->scene->mesh_count, s->instances);
        gl->delete_textures((GLsizei)s->scene->texture_count, s->textures);
    }
    free(s->arrays);
    free(s->vertices);
    free(s->indices);
    free(s->instances);
    free(s->textures);
    free(s->uniforms);
    free(s->uniform_offsets);
    s->arrays = s->vertices = s->indices = s->instances = s->textures = NULL;
    s->uniforms = NULL;
    s->uniform_offsets = NULL;
}
