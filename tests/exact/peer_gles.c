// SPDX-License-Identifier: MIT
// See peer_gles.h. EGL and GLES are opened at run time, without a display server, so that the tests neither
// need nor link them. Four-channel float targets take the numbers of a fragment as they are.
#include "peer_gles.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SMOOTH, FLAT, SPACE, SCREEN, NOPERSPECTIVE, TARGETS };
enum { WIDTH = 131, HEIGHT = 128 }; // the largest target of the families, each way

// One vertex of a triangle with vertices of its own; `name` tells the triangle.
struct peer_vertex {
    float position[4], value[SCENE_VALUES], name;
};

struct gl {
    PFNGLGETSTRINGPROC get_string;
    PFNGLGETERRORPROC get_error;
    PFNGLCREATESHADERPROC create_shader;
    PFNGLSHADERSOURCEPROC shader_source;
    PFNGLCOMPILESHADERPROC compile_shader;
    PFNGLGETSHADERIVPROC get_shader_iv;
    PFNGLCREATEPROGRAMPROC create_program;
    PFNGLATTACHSHADERPROC attach_shader;
    PFNGLLINKPROGRAMPROC link_program;
    PFNGLGETPROGRAMIVPROC get_program_iv;
    PFNGLUSEPROGRAMPROC use_program;
    PFNGLGENBUFFERSPROC gen_buffers;
    PFNGLBINDBUFFERPROC bind_buffer;
    PFNGLBUFFERDATAPROC buffer_data;
    PFNGLVERTEXATTRIBPOINTERPROC vertex_attrib_pointer;
    PFNGLENABLEVERTEXATTRIBARRAYPROC enable_vertex_attrib_array;
    PFNGLGENFRAMEBUFFERSPROC gen_framebuffers;
    PFNGLBINDFRAMEBUFFERPROC bind_framebuffer;
    PFNGLGENRENDERBUFFERSPROC gen_renderbuffers;
    PFNGLBINDRENDERBUFFERPROC bind_renderbuffer;
    PFNGLRENDERBUFFERSTORAGEPROC renderbuffer_storage;
    PFNGLFRAMEBUFFERRENDERBUFFERPROC framebuffer_renderbuffer;
    PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer_status;
    PFNGLDRAWBUFFERSPROC draw_buffers;
    PFNGLREADBUFFERPROC read_buffer;
    PFNGLREADPIXELSPROC read_pixels;
    PFNGLVIEWPORTPROC viewport;
    PFNGLDEPTHRANGEFPROC depth_range_f;
    PFNGLCLEARCOLORPROC clear_color;
    PFNGLCLEARPROC clear;
    PFNGLDISABLEPROC disable;
    PFNGLDRAWARRAYSPROC draw_arrays;
};

struct peer {
    void *library;
    PFNEGLTERMINATEPROC terminate;
    EGLDisplay display;
    struct gl gl;
    bool noperspective;
    char name[256];
    float memory[TARGETS][WIDTH * HEIGHT][4], row[WIDTH][4];
    struct peer_vertex vertex[3 * SCENE_TRIANGLES];
    struct probe_image image;
};

static bool load(struct gl *gl, PFNEGLGETPROCADDRESSPROC find)
{
    const struct {
        const char *name;
        void *at;
    } names[] = {
        {"glGetString", &gl->get_string},
        {"glGetError", &gl->get_error},
        {"glCreateShader", &gl->create_shader},
        {"glShaderSource", &gl->shader_source},
        {"glCompileShader", &gl->compile_shader},
        {"glGetShaderiv", &gl->get_shader_iv},
        {"glCreateProgram", &gl->create_program},
        {"glAttachShader", &gl->attach_shader},
        {"glLinkProgram", &gl->link_program},
        {"glGetProgramiv", &gl->get_program_iv},
        {"glUseProgram", &gl->use_program},
        {"glGenBuffers", &gl->gen_buffers},
        {"glBindBuffer", &gl->bind_buffer},
        {"glBufferData", &gl->buffer_data},
        {"glVertexAttribPointer", &gl->vertex_attrib_pointer},
        {"glEnableVertexAttribArray", &gl->enable_vertex_attrib_array},
        {"glGenFramebuffers", &gl->gen_framebuffers},
        {"glBindFramebuffer", &gl->bind_framebuffer},
        {"glGenRenderbuffers", &gl->gen_renderbuffers},
        {"glBindRenderbuffer", &gl->bind_renderbuffer},
        {"glRenderbufferStorage", &gl->renderbuffer_storage},
        {"glFramebufferRenderbuffer", &gl->framebuffer_renderbuffer},
        {"glCheckFramebufferStatus", &gl->check_framebuffer_status},
        {"glDrawBuffers", &gl->draw_buffers},
        {"glReadBuffer", &gl->read_buffer},
        {"glReadPixels", &gl->read_pixels},
        {"glViewport", &gl->viewport},
        {"glDepthRangef", &gl->depth_range_f},
        {"glClearColor", &gl->clear_color},
        {"glClear", &gl->clear},
        {"glDisable", &gl->disable},
        {"glDrawArrays", &gl->draw_arrays},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const __eglMustCastToProperFunctionPointerType function = find(names[i].name);
        if (!function) {
            return false;
        }
        memcpy(names[i].at, &function, sizeof function);
    }
    return true;
}

// A function of the EGL library itself.
static bool find_symbol(void *library, const char *name, void *function)
{
    void *const symbol = dlsym(library, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}

static bool open_context(struct peer *p, PFNEGLGETPROCADDRESSPROC *find)
{
    PFNEGLGETPLATFORMDISPLAYPROC get_platform_display;
    PFNEGLINITIALIZEPROC initialize;
    PFNEGLBINDAPIPROC bind_api;
    PFNEGLCHOOSECONFIGPROC choose_config;
    PFNEGLCREATECONTEXTPROC create_context;
    PFNEGLMAKECURRENTPROC make_current;
    if (!find_symbol(p->library, "eglGetProcAddress", find) ||
        !find_symbol(p->library, "eglGetPlatformDisplay", &get_platform_display) ||
        !find_symbol(p->library, "eglInitialize", &initialize) ||
        !find_symbol(p->library, "eglBindAPI", &bind_api) ||
        !find_symbol(p->library, "eglChooseConfig", &choose_config) ||
        !find_symbol(p->library, "eglCreateContext", &create_context) ||
        !find_symbol(p->library, "eglMakeCurrent", &make_current) ||
        !find_symbol(p->library, "eglTerminate", &p->terminate)) {
        return false;
    }
    const EGLint config_want[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    const EGLint context_want[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    p->display = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (p->display == EGL_NO_DISPLAY || !initialize(p->display, NULL, NULL) || !bind_api(EGL_OPENGL_ES_API) ||
        !choose_config(p->display, config_want, &config, 1, &count) || count == 0) {
        return false;
    }
    const EGLContext context = create_context(p->display, config, EGL_NO_CONTEXT, context_want);
    return context != EGL_NO_CONTEXT && make_current(p->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

static GLuint compile(const struct gl *gl, GLenum type, const char *const *lines, int count)
{
    GLint ok = 0;
    const GLuint shader = gl->create_shader(type);
    gl->shader_source(shader, count, lines, NULL);
    gl->compile_shader(shader);
    gl->get_shader_iv(shader, GL_COMPILE_STATUS, &ok);
    return ok ? shader : 0;
}

static bool make_program(const struct peer *p)
{
    const struct gl *const gl = &p->gl;
    const char *const version = "#version 300 es\n", *const precise = "precision highp float;\n";
    const char *const extension =
        p->noperspective ? "#extension GL_NV_shader_noperspective_interpolation : require\n" : "";
    const char *const vertex[] = {
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
    const char *const fragment[] = {
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
    const GLuint program = gl->create_program();
    const GLuint vertex_shader = compile(gl, GL_VERTEX_SHADER, vertex, sizeof vertex / sizeof *vertex);
    const GLuint fragment_shader =
        compile(gl, GL_FRAGMENT_SHADER, fragment, sizeof fragment / sizeof *fragment);
    GLint ok = 0;
    if (vertex_shader && fragment_shader) {
        gl->attach_shader(program, vertex_shader);
        gl->attach_shader(program, fragment_shader);
        gl->link_program(program);
        gl->get_program_iv(program, GL_LINK_STATUS, &ok);
    }
    gl->use_program(ok ? program : 0);
    return ok;
}

static bool make_targets(const struct peer *p)
{
    const struct gl *const gl = &p->gl;
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
    PFNEGLGETPROCADDRESSPROC find;
    *why = "out of memory";
    if (!p) {
        return NULL;
    }
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", driver, 1);
    p->library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!p->library || !open_context(p, &find)) {
        *why = p->library ? "EGL gives no context without a window" : "no libEGL.so.1";
        peer_close(p);
        return NULL;
    }
    if (load(&p->gl, find)) {
        const char *const extensions = (const char *)p->gl.get_string(GL_EXTENSIONS);
        p->noperspective = extensions && strstr(extensions, "GL_NV_shader_noperspective_interpolation");
        snprintf(p->name, sizeof p->name, "%s, %s", (const char *)p->gl.get_string(GL_RENDERER),
                 (const char *)p->gl.get_string(GL_VERSION));
        if (make_program(p) && make_targets(p) && strstr(p->name, driver)) {
            return p;
        }
    }
    *why = "no such driver, or it lacks float targets";
    peer_close(p);
    return NULL;
}

void peer_close(struct peer *p)
{
    if (p && p->terminate && p->display) {
        p->terminate(p->display);
    }
    if (p && p->library) {
        dlclose(p->library);
    }
    free(p);
}

const char *peer_name(const struct peer *p)
{
    return p->name;
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
    const struct gl *const gl = &p->gl;
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
