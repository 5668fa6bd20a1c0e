// SPDX-License-Identifier: MIT
// See peer_gles.h. Four-channel float targets take the numbers of a fragment as they are.
#include "peer_gles.h"

#include "gles.h"

#include <stdlib.h>
#include <string.h>

enum { SMOOTH, FLAT, SPACE, SCREEN, NOPERSPECTIVE, TARGETS };
enum { WIDTH = 131, HEIGHT = 128 }; // the largest target of the families, each way

// One vertex of a triangle with vertices of its own; `name` tells the triangle.
struct peer_vertex {
    float position[4], value[SCENE_VALUES], name;
};

struct peer {
    struct gles gl;
    bool noperspective;
    float memory[TARGETS][WIDTH * HEIGHT][4], row[WIDTH][4];
    struct peer_vertex vertex[3 * SCENE_TRIANGLES];
    struct probe_image image;
};

static bool make_program(const struct peer *p)
{
    enum { PIECES = 7 };
    const struct gles *const gl = &p->gl;
    const char *const version = "#version 300 es\n", *const precise = "precision highp float;\n";
    const char *const extension =
        p->noperspective ? "#extension GL_NV_shader_noperspective_interpolation : require\n" : "";
    const char *const vertex[PIECES] = {
        version,
        extension,
        precise,
        "layout(location = 0) in vec4 position; layout(location = 1) in vec4 value; layout(location = 2) in "
        "float name;\n"
        "smooth out vec4 varying_smooth; flat out float varying_name;\n",
        p->noperspective ? "noperspective out vec4 varying_screen;\n" : "",
        "void main() { gl_Position = position; varying_smooth = value; varying_name = name;\n",
        p->noperspective ? "varying_screen = value; }" : "}",
    };
    const char *const fragment[PIECES] = {
        version,
        extension,
        precise,
        "smooth in vec4 varying_smooth; flat in float varying_name;\n"
        "layout(location = 0) out vec4 out_smooth; layout(location = 1) out vec4 out_name;\n"
        "layout(location = 2) out vec4 out_space; layout(location = 3) out vec4 out_screen;\n"
        "layout(location = 4) out vec4 out_noperspective;\n",
        p->noperspective ? "noperspective in vec4 varying_screen;\n" : "",
        "void main() { out_smooth = varying_smooth; out_name = vec4(0, 0, varying_name, 0);\n"
        "out_space = vec4(0, 0, 0, gl_FragCoord.w); out_screen = vec4(0, 0, 0, gl_FragCoord.z);\n",
        p->noperspective ? "out_noperspective = varying_screen; }" : "out_noperspective = vec4(0); }",
    };
    const GLuint program = gles_program(gl, vertex, fragment, PIECES, NULL, 0);
    gl->use_program(program);
    return program != 0;
}

static bool make_targets(const struct peer *p)
{
    const struct gles *const gl = &p->gl;
    GLuint framebuffer, buffer, color[TARGETS];
    GLenum attachment[TARGETS];
    gl->gen_framebuffers(1, &framebuffer);
    gl->bind_framebuffer(GL_FRAMEBUFFER, framebuffer);
    gl->gen_renderbuffers(TARGETS, color);
    for (int i = 0; i < TARGETS; i++) {
        attachment[i] = GL_COLOR_ATTACHMENT0 + (GLenum)i;
        gl->bind_renderbuffer(GL_RENDERBUFFER, color[i]);
        gl->renderbuffer_storage(GL_RENDERBUFFER, GL_RGBA32F, WIDTH, HEIGHT);
        gl->framebuffer_renderbuffer(GL_FRAMEBUFFER, attachment[i], GL_RENDERBUFFER, color[i]);
    }
    gl->draw_buffers(TARGETS, attachment);
    gl->gen_buffers(1, &buffer);
    gl->bind_buffer(GL_ARRAY_BUFFER, buffer);
    const struct peer_vertex *const start = NULL;
    const GLsizei stride = sizeof *start;
    gl->vertex_attrib_pointer(0, 4, GL_FLOAT, GL_FALSE, stride,
                              (const void *)offsetof(struct peer_vertex, position));
    gl->vertex_attrib_pointer(1, SCENE_VALUES, GL_FLOAT, GL_FALSE, stride,
                              (const void *)offsetof(struct peer_vertex, value));
    gl->vertex_attrib_pointer(2, 1, GL_FLOAT, GL_FALSE, stride,
                              (const void *)offsetof(struct peer_vertex, name));
    for (GLuint i = 0; i < 3; i++) {
        gl->enable_vertex_attrib_array(i);
    }
    gl->disable(GL_DEPTH_TEST);
    gl->disable(GL_CULL_FACE);
    gl->disable(GL_DITHER);
    return gl->check_framebuffer_status(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE &&
           gl->get_error() == GL_NO_ERROR;
}

struct peer *peer_open(const char *driver, const char **why)
{
    struct peer *const p = calloc(1, sizeof *p);
    *why = "out of memory";
    if (!p || !gles_open(&p->gl, driver, why)) {
        free(p);
        return NULL;
    }
    const char *const extensions = (const char *)p->gl.get_string(GL_EXTENSIONS);
    p->noperspective = extensions && strstr(extensions, "GL_NV_shader_noperspective_interpolation");
    if (make_program(p) && make_targets(p)) {
        return p;
    }
    *why = "it lacks float targets";
    peer_close(p);
    return NULL;
}

void peer_close(struct peer *p)
{
    if (p) {
        gles_close(&p->gl);
    }
    free(p);
}

const char *peer_name(const struct peer *p)
{
    return p->gl.name;
}

bool peer_can_draw(const struct scene *scene)
{
    const struct oracle_view *const v = &scene->view;
    return v->minus_one_to_one && v->target_width <= WIDTH && v->target_height <= HEIGHT;
}

// Rows come bottom up.
static void read_target(struct peer *p, int target, int width, int height)
{
    float(*const pixels)[4] = p->memory[target];
    p->gl.read_buffer(GL_COLOR_ATTACHMENT0 + (GLenum)target);
    p->gl.read_pixels(0, 0, width, height, GL_RGBA, GL_FLOAT, pixels);
    for (int y = 0; y < height / 2; y++) {
        float(*const a)[4] = pixels + y * width, (*const b)[4] = pixels + (height - 1 - y) * width;
        const size_t size = (size_t)width * sizeof *a;
        memcpy(p->row, a, size);
        memcpy(a, b, size);
        memcpy(b, p->row, size);
    }
}

const struct probe_image *peer_draw(struct peer *p, const struct scene *scene)
{
    const struct gles *const gl = &p->gl;
    const struct oracle_view *const v = &scene->view;
    for (int t = 0; t < scene->triangle_count; t++) {
        for (int i = 0; i < 3; i++) {
            const struct scene_vertex *const from = &scene->vertex[scene->triangle[t][i]];
            struct peer_vertex *const to = &p->vertex[3 * t + i];
            memcpy(to->position, from->position, sizeof to->position);
            memcpy(to->value, from->value, sizeof to->value);
            to->name = (float)(t + 1);
        }
    }
    gl->buffer_data(GL_ARRAY_BUFFER, (GLsizeiptr)(3 * (size_t)scene->triangle_count * sizeof *p->vertex),
                    p->vertex, GL_STREAM_DRAW);
    gl->viewport((GLint)v->x, v->target_height - (GLint)(v->y + v->height), (GLsizei)v->width,
                 (GLsizei)v->height);
    gl->depth_range_f(v->depth_min, v->depth_max);
    gl->clear_color(0, 0, 0, 0);
    gl->clear(GL_COLOR_BUFFER_BIT);
    gl->draw_arrays(GL_TRIANGLES, 0, 3 * scene->triangle_count);
    for (int i = 0; i < (p->noperspective ? TARGETS : NOPERSPECTIVE); i++) {
        read_target(p, i, v->target_width, v->target_height);
    }
    if (gl->get_error() != GL_NO_ERROR) {
        return NULL;
    }
    p->image = (struct probe_image){
        .width = v->target_width,
        .height = v->target_height,
        .smooth = (const probe_pixel *)p->memory[SMOOTH],
        .flat = (const probe_pixel *)p->memory[FLAT],
        .space = (const probe_pixel *)p->memory[SPACE],
        .screen = (const probe_pixel *)p->memory[SCREEN],
        .noperspective = p->noperspective ? (const probe_pixel *)p->memory[NOPERSPECTIVE] : NULL,
    };
    return &p->image;
}
