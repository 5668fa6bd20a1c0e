// SPDX-License-Identifier: MIT
// See gles.h. The display is Mesa's surfaceless one: it asks for no display server and no device node.
#include "gles.h"

#include <EGL/eglext.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool load(struct gles *gl, PFNEGLGETPROCADDRESSPROC find)
{
    const struct {
        const char *name;
        void *at;
    } names[] = {
        {"glGetString", &gl->get_string},
        {"glGetError", &gl->get_error},
        {"glCreateShader", &gl->create_shader},
        {"glDeleteShader", &gl->delete_shader},
        {"glShaderSource", &gl->shader_source},
        {"glCompileShader", &gl->compile_shader},
        {"glGetShaderiv", &gl->get_shader_iv},
        {"glGetShaderInfoLog", &gl->get_shader_info_log},
        {"glCreateProgram", &gl->create_program},
        {"glDeleteProgram", &gl->delete_program},
        {"glAttachShader", &gl->attach_shader},
        {"glLinkProgram", &gl->link_program},
        {"glGetProgramiv", &gl->get_program_iv},
        {"glUseProgram", &gl->use_program},
        {"glGetUniformLocation", &gl->get_uniform_location},
        {"glUniform1i", &gl->uniform_1i},
        {"glUniform4fv", &gl->uniform_4fv},
        {"glGenVertexArrays", &gl->gen_vertex_arrays},
        {"glBindVertexArray", &gl->bind_vertex_array},
        {"glDeleteVertexArrays", &gl->delete_vertex_arrays},
        {"glGenBuffers", &gl->gen_buffers},
        {"glBindBuffer", &gl->bind_buffer},
        {"glBufferData", &gl->buffer_data},
        {"glBufferSubData", &gl->buffer_sub_data},
        {"glDeleteBuffers", &gl->delete_buffers},
        {"glVertexAttribPointer", &gl->vertex_attrib_pointer},
        {"glEnableVertexAttribArray", &gl->enable_vertex_attrib_array},
        {"glVertexAttribDivisor", &gl->vertex_attrib_divisor},
        {"glGenTextures", &gl->gen_textures},
        {"glBindTexture", &gl->bind_texture},
        {"glActiveTexture", &gl->active_texture},
        {"glGenerateMipmap", &gl->generate_mipmap},
        {"glTexStorage2D", &gl->tex_storage_2d},
        {"glTexSubImage2D", &gl->tex_sub_image_2d},
        {"glCompressedTexImage2D", &gl->compressed_tex_image_2d},
        {"glTexParameteri", &gl->tex_parameter_i},
        {"glDeleteTextures", &gl->delete_textures},
        {"glGenFramebuffers", &gl->gen_framebuffers},
        {"glBindFramebuffer", &gl->bind_framebuffer},
        {"glFramebufferTexture2D", &gl->framebuffer_texture_2d},
        {"glDeleteFramebuffers", &gl->delete_framebuffers},
        {"glInvalidateFramebuffer", &gl->invalidate_framebuffer},
        {"glGenRenderbuffers", &gl->gen_renderbuffers},
        {"glBindRenderbuffer", &gl->bind_renderbuffer},
        {"glRenderbufferStorage", &gl->renderbuffer_storage},
        {"glRenderbufferStorageMultisample", &gl->renderbuffer_storage_multisample},
        {"glBlitFramebuffer", &gl->blit_framebuffer},
        {"glFramebufferRenderbuffer", &gl->framebuffer_renderbuffer},
        {"glDeleteRenderbuffers", &gl->delete_renderbuffers},
        {"glCheckFramebufferStatus", &gl->check_framebuffer_status},
        {"glDrawBuffers", &gl->draw_buffers},
        {"glReadBuffer", &gl->read_buffer},
        {"glReadPixels", &gl->read_pixels},
        {"glScissor", &gl->scissor},
        {"glViewport", &gl->viewport},
        {"glDepthRangef", &gl->depth_range_f},
        {"glClearColor", &gl->clear_color},
        {"glClear", &gl->clear},
        {"glEnable", &gl->enable},
        {"glDisable", &gl->disable},
        {"glDepthFunc", &gl->depth_func},
        {"glDepthMask", &gl->depth_mask},
        {"glColorMask", &gl->color_mask},
        {"glStencilFunc", &gl->stencil_func},
        {"glStencilOpSeparate", &gl->stencil_op_separate},
        {"glFrontFace", &gl->front_face},
        {"glBlendFunc", &gl->blend_func},
        {"glDrawArrays", &gl->draw_arrays},
        {"glDrawElements", &gl->draw_elements},
        {"glDrawElementsInstanced", &gl->draw_elements_instanced},
        {"glFinish", &gl->finish},
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

static bool open_context(struct gles *gl, PFNEGLGETPROCADDRESSPROC *find)
{
    PFNEGLGETPLATFORMDISPLAYPROC get_platform_display;
    PFNEGLINITIALIZEPROC initialize;
    PFNEGLBINDAPIPROC bind_api;
    PFNEGLCHOOSECONFIGPROC choose_config;
    PFNEGLCREATECONTEXTPROC create_context;
    PFNEGLMAKECURRENTPROC make_current;
    if (!find_symbol(gl->library, "eglGetProcAddress", find) ||
        !find_symbol(gl->library, "eglGetPlatformDisplay", &get_platform_display) ||
        !find_symbol(gl->library, "eglInitialize", &initialize) ||
        !find_symbol(gl->library, "eglBindAPI", &bind_api) ||
        !find_symbol(gl->library, "eglChooseConfig", &choose_config) ||
        !find_symbol(gl->library, "eglCreateContext", &create_context) ||
        !find_symbol(gl->library, "eglMakeCurrent", &make_current) ||
        !find_symbol(gl->library, "eglTerminate", &gl->terminate)) {
        return false;
    }
    const EGLint config_want[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
    const EGLint context_want[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    EGLConfig config;
    EGLint count = 0;
    gl->display = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (gl->display == EGL_NO_DISPLAY || !initialize(gl->display, NULL, NULL) ||
        !bind_api(EGL_OPENGL_ES_API) || !choose_config(gl->display, config_want, &config, 1, &count) ||
        count == 0) {
        return false;
    }
    const EGLContext context = create_context(gl->display, config, EGL_NO_CONTEXT, context_want);
    return context != EGL_NO_CONTEXT && make_current(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
}

bool gles_open(struct gles *gl, const char *driver, const char **why)
{
    PFNEGLGETPROCADDRESSPROC find;
    memset(gl, 0, sizeof *gl);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", driver, 1);
    gl->library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!gl->library) {
        *why = "no libEGL.so.1";
        return false;
    }
    if (!open_context(gl, &find)) {
        *why = "EGL gives no context without a window";
        gles_close(gl);
        return false;
    }
    if (load(gl, find)) {
        snprintf(gl->name, sizeof gl->name, "%s, %s", (const char *)gl->get_string(GL_RENDERER),
                 (const char *)gl->get_string(GL_VERSION));
        if (strstr(gl->name, driver)) {
            return true;
        }
    }
    *why = "no such driver";
    gles_close(gl);
    return false;
}

void gles_close(struct gles *gl)
{
    if (gl->terminate && gl->display) {
        gl->terminate(gl->display);
    }
    if (gl->library) {
        dlclose(gl->library);
    }
    memset(gl, 0, sizeof *gl);
}

bool gles_find(const struct gles *gl, const char *name, void *function)
{
    PFNEGLGETPROCADDRESSPROC find;
    if (!find_symbol(gl->library, "eglGetProcAddress", &find)) {
        return false;
    }
    const __eglMustCastToProperFunctionPointerType found = find(name);
    memcpy(function, &found, sizeof found);
    return found != NULL;
}

static GLuint compile(const struct gles *gl, GLenum type, const char *const *pieces, int count, char *log,
                      GLsizei log_size)
{
    GLint ok = 0;
    const GLuint shader = gl->create_shader(type);
    gl->shader_source(shader, count, pieces, NULL);
    gl->compile_shader(shader);
    gl->get_shader_iv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) {
        return shader;
    }
    if (log) {
        gl->get_shader_info_log(shader, log_size, NULL, log);
    }
    gl->delete_shader(shader);
    return 0;
}

GLuint gles_program(const struct gles *gl, const char *const *vertex, const char *const *fragment, int count,
                    char *log, GLsizei log_size)
{
    const GLuint vertex_shader = compile(gl, GL_VERTEX_SHADER, vertex, count, log, log_size);
    const GLuint fragment_shader =
        vertex_shader ? compile(gl, GL_FRAGMENT_SHADER, fragment, count, log, log_size) : 0;
    GLuint program = 0;
    if (fragment_shader) {
        GLint ok = 0;
        program = gl->create_program();
        gl->attach_shader(program, vertex_shader);
        gl->attach_shader(program, fragment_shader);
        gl->link_program(program);
        gl->get_program_iv(program, GL_LINK_STATUS, &ok);
        if (!ok) {
            gl->delete_program(program);
            program = 0;
        }
    }
    gl->delete_shader(vertex_shader); // the program keeps them; 0 is ignored
    gl->delete_shader(fragment_shader);
    return program;
}
