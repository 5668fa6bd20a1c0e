// SPDX-License-Identifier: MIT
// A Mesa driver under measurement, through OpenGL ES 3. It draws into a renderbuffer, which llvmpipe and
// softpipe keep as rows of RGBA8 in memory, as rhw does; glFinish waits until they stand there. What reading
// back costs on top (glReadPixels copies once more) is not counted.
#include "renderer_gles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// State ----------------------------------------------------------------------------------------------

static void switch_on(const struct gles *gl, bool on, GLenum what)
{
    (on ? gl->enable : gl->disable)(what);
}

static void set_depth(const struct gles *gl, const struct bench_draw *draw)
{
    switch_on(gl, draw->depth != BENCH_DEPTH_OFF, GL_DEPTH_TEST);
    gl->depth_func(draw->depth == BENCH_DEPTH_EQUAL ? GL_EQUAL : GL_LESS);
    gl->depth_mask(draw->depth <= BENCH_DEPTH_LESS);
}

static void set_blend(const struct gles *gl, const struct bench_draw *draw)
{
    switch_on(gl, draw->blend != BENCH_BLEND_OFF, GL_BLEND);
    gl->blend_func(draw->blend == BENCH_BLEND_OVER ? GL_SRC_ALPHA : GL_ONE,
                   draw->blend == BENCH_BLEND_ADD ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
}

static void set_stencil(const struct gles *gl, const struct bench_draw *draw)
{
    const GLboolean colors = draw->stencil != BENCH_STENCIL_COUNT;
    switch_on(gl, draw->stencil != BENCH_STENCIL_OFF, GL_STENCIL_TEST);
    gl->color_mask(colors, colors, colors, colors);
    gl->stencil_func(draw->stencil == BENCH_STENCIL_ZERO ? GL_EQUAL : GL_ALWAYS, 0, 0xff);
    gl->stencil_op_separate(GL_FRONT, GL_KEEP, colors ? GL_KEEP : GL_DECR_WRAP, GL_KEEP);
    gl->stencil_op_separate(GL_BACK, GL_KEEP, colors ? GL_KEEP : GL_INCR_WRAP, GL_KEEP);
}

// What differs from the draw before; NULL: everything.
static void set_state(const struct gles *gl, const struct bench_draw *draw, const struct bench_draw *before)
{
    if (!before || draw->depth != before->depth) {
        set_depth(gl, draw);
    }
    if (!before || draw->blend != before->blend) {
        set_blend(gl, draw);
    }
    if (!before || draw->stencil != before->stencil) {
        set_stencil(gl, draw);
    }
    switch_on(gl, draw->cull_back, GL_CULL_FACE);
    if (!before || draw->has_scissor != before->has_scissor) {
        switch_on(gl, draw->has_scissor, GL_SCISSOR_TEST);
    }
    if (draw->has_scissor) {
        gl->scissor(draw->scissor[0], draw->scissor[1], draw->scissor[2], draw->scissor[3]);
    }
}

// Frames ---------------------------------------------------------------------------------------------

static void draw_mesh(const struct gles_state *s, uint32_t number)
{
    static const GLenum topologies[] = {
        [BENCH_TRIANGLE_LIST] = GL_TRIANGLES, [BENCH_LINE_LIST] = GL_LINES, [BENCH_POINT_LIST] = GL_POINTS};
    const struct gles *const gl = &s->gl;
    const struct bench_mesh *const mesh = &s->scene->meshes[number];
    const GLenum topology = topologies[mesh->topology];
    gl->bind_vertex_array(s->arrays[number]);
    if (mesh->instance_count) {
        gl->draw_elements_instanced(topology, (GLsizei)mesh->index_count, GL_UNSIGNED_INT, NULL,
                                    (GLsizei)mesh->instance_count);
    } else {
        gl->draw_elements(topology, (GLsizei)mesh->index_count, GL_UNSIGNED_INT, NULL);
    }
}

static void draw(const struct gles_state *s, uint32_t i)
{
    const struct gles *const gl = &s->gl;
    const struct bench_scene *const scene = s->scene;
    const struct bench_draw *const draw = &scene->draws[i];
    const struct gles_shader *const shader = &s->shaders[draw->shader];
    gl->use_program(shader->program);
    gl->uniform_4fv(shader->uniforms, (GLsizei)((s->uniform_offsets[i + 1] - s->uniform_offsets[i]) / 4),
                    s->uniforms + s->uniform_offsets[i]);
    for (int t = draw->texture_count - 1; t >= 0; t--) { // unit 0 last: it stays the active one
        gl->active_texture(GL_TEXTURE0 + (GLenum)t);
        gl->bind_texture(scene->textures[draw->textures[t]].cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D,
                         s->textures[draw->textures[t]]);
    }
    if (scene->writes_between) {
        const struct bench_mesh *const mesh = &scene->meshes[draw->mesh];
        gl->bind_buffer(GL_ARRAY_BUFFER, s->vertices[draw->mesh]);
        gl->buffer_sub_data(GL_ARRAY_BUFFER, 0,
                            (GLsizeiptr)(bench_mesh_stride(mesh) * sizeof *mesh->vertices), mesh->vertices);
    }
    draw_mesh(s, draw->mesh);
}

// The masks of the last draw hold for clearing too.
static void clear(const struct gles *gl, const struct bench_pass *pass)
{
    gl->disable(GL_SCISSOR_TEST);
    gl->depth_mask(GL_TRUE);
    gl->color_mask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->clear_color(pass->clear[0], pass->clear[1], pass->clear[2], pass->clear[3]);
    gl->clear((pass->color_count ? GL_COLOR_BUFFER_BIT : 0) | GL_DEPTH_BUFFER_BIT |
              (pass->depth == BENCH_PASS_DEPTH_STENCIL ? GL_STENCIL_BUFFER_BIT : 0));
}

static void run_pass(const struct gles_state *s, uint32_t number)
{
    static const GLenum thrown_away[] = {GL_DEPTH_ATTACHMENT, GL_STENCIL_ATTACHMENT};
    const struct gles *const gl = &s->gl;
    const struct bench_scene *const scene = s->scene;
    const struct bench_pass *const pass = &scene->passes[number];
    const bool sampled = s->sampled && number + 1 == scene->pass_count;
    gl->bind_framebuffer(GL_FRAMEBUFFER, sampled ? s->sampled : s->targets[number].framebuffer);
    gl->viewport(0, 0, s->targets[number].width, s->targets[number].height);
    clear(gl, pass);
    for (uint32_t i = 0; i < pass->draw_count; i++) {
        const struct bench_draw *const item = &scene->draws[pass->first_draw + i];
        set_state(gl, item, i ? item - 1 : NULL);
        draw(s, pass->first_draw + i);
    }
    if (pass->depth == BENCH_PASS_DEPTH || pass->depth == BENCH_PASS_DEPTH_STENCIL) {
        gl->invalidate_framebuffer(GL_FRAMEBUFFER, pass->depth == BENCH_PASS_DEPTH ? 1 : 2, thrown_away);
    }
    if (sampled) {
        gles_resolve(s);
    }
    if (pass->makes_levels) {
        gl->active_texture(GL_TEXTURE0);
        gl->bind_texture(GL_TEXTURE_2D, s->textures[pass->colors[0]]);
        gl->generate_mipmap(GL_TEXTURE_2D);
    }
}

static bool frame(struct bench_renderer *renderer)
{
    const struct gles_state *const s = renderer->state;
    for (uint32_t i = 0; i < s->scene->pass_count; i++) {
        run_pass(s, i);
    }
    s->gl.finish();
    return s->gl.get_error() == GL_NO_ERROR;
}

static bool read_image(struct bench_renderer *renderer, struct bench_image *image)
{
    struct gles_state *const s = renderer->state;
    return (!image->color || gles_read_color(s, image->color)) &&
           (!image->depth || gles_read_depth(s, image->depth));
}

// Scenes ---------------------------------------------------------------------------------------------

static bool take(struct bench_renderer *renderer, const struct bench_scene *scene, int width, int height)
{
    struct gles_state *const s = renderer->state;
    s->scene = scene;
    s->width = width;
    s->height = height;
    if (!gles_upload(s)) {
        while (s->gl.get_error() != GL_NO_ERROR) {
        }
        return false;
    }
    s->gl.front_face(GL_CW); // y is turned round
    s->gl.disable(GL_DITHER);
    return s->gl.get_error() == GL_NO_ERROR;
}

static void release(struct bench_renderer *renderer)
{
    gles_drop(renderer->state);
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
