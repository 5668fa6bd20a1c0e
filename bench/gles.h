// SPDX-License-Identifier: MIT
// OpenGL ES 3 of this machine, opened at run time and without a window, so that a program neither needs nor
// links it. What the benchmark and the exactness measurement draw with as their peer.
#ifndef BENCH_GLES_H
#define BENCH_GLES_H

#include <EGL/egl.h>
#include <GLES3/gl3.h>
#include <stdbool.h>

struct gles {
    PFNGLGETSTRINGPROC get_string;
    PFNGLGETERRORPROC get_error;
    PFNGLCREATESHADERPROC create_shader;
    PFNGLDELETESHADERPROC delete_shader;
    PFNGLSHADERSOURCEPROC shader_source;
    PFNGLCOMPILESHADERPROC compile_shader;
    PFNGLGETSHADERIVPROC get_shader_iv;
    PFNGLGETSHADERINFOLOGPROC get_shader_info_log;
    PFNGLCREATEPROGRAMPROC create_program;
    PFNGLDELETEPROGRAMPROC delete_program;
    PFNGLATTACHSHADERPROC attach_shader;
    PFNGLLINKPROGRAMPROC link_program;
    PFNGLGETPROGRAMIVPROC get_program_iv;
    PFNGLUSEPROGRAMPROC use_program;
    PFNGLGETUNIFORMLOCATIONPROC get_uniform_location;
    PFNGLUNIFORM1IPROC uniform_1i;
    PFNGLUNIFORM4FVPROC uniform_4fv;
    PFNGLGENVERTEXARRAYSPROC gen_vertex_arrays;
    PFNGLBINDVERTEXARRAYPROC bind_vertex_array;
    PFNGLDELETEVERTEXARRAYSPROC delete_vertex_arrays;
    PFNGLGENBUFFERSPROC gen_buffers;
    PFNGLBINDBUFFERPROC bind_buffer;
    PFNGLBUFFERDATAPROC buffer_data;
    PFNGLBUFFERSUBDATAPROC buffer_sub_data;
    PFNGLDELETEBUFFERSPROC delete_buffers;
    PFNGLVERTEXATTRIBPOINTERPROC vertex_attrib_pointer;
    PFNGLENABLEVERTEXATTRIBARRAYPROC enable_vertex_attrib_array;
    PFNGLVERTEXATTRIBDIVISORPROC vertex_attrib_divisor;
    PFNGLGENTEXTURESPROC gen_textures;
    PFNGLBINDTEXTUREPROC bind_texture;
    PFNGLACTIVETEXTUREPROC active_texture;
    PFNGLTEXSTORAGE2DPROC tex_storage_2d;
    PFNGLGENERATEMIPMAPPROC generate_mipmap;
    PFNGLTEXSUBIMAGE2DPROC tex_sub_image_2d;
    PFNGLCOMPRESSEDTEXIMAGE2DPROC compressed_tex_image_2d;
    PFNGLTEXPARAMETERIPROC tex_parameter_i;
    PFNGLDELETETEXTURESPROC delete_textures;
    PFNGLGENFRAMEBUFFERSPROC gen_framebuffers;
    PFNGLBINDFRAMEBUFFERPROC bind_framebuffer;
    PFNGLFRAMEBUFFERTEXTURE2DPROC framebuffer_texture_2d;
    PFNGLDELETEFRAMEBUFFERSPROC delete_framebuffers;
    PFNGLINVALIDATEFRAMEBUFFERPROC invalidate_framebuffer;
    PFNGLGENRENDERBUFFERSPROC gen_renderbuffers;
    PFNGLBINDRENDERBUFFERPROC bind_renderbuffer;
    PFNGLRENDERBUFFERSTORAGEPROC renderbuffer_storage;
    PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC renderbuffer_storage_multisample;
    PFNGLBLITFRAMEBUFFERPROC blit_framebuffer;
    PFNGLFRAMEBUFFERRENDERBUFFERPROC framebuffer_renderbuffer;
    PFNGLDELETERENDERBUFFERSPROC delete_renderbuffers;
    PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer_status;
    PFNGLDRAWBUFFERSPROC draw_buffers;
    PFNGLREADBUFFERPROC read_buffer;
    PFNGLREADPIXELSPROC read_pixels;
    PFNGLSCISSORPROC scissor;
    PFNGLVIEWPORTPROC viewport;
    PFNGLDEPTHRANGEFPROC depth_range_f;
    PFNGLCLEARCOLORPROC clear_color;
    PFNGLCLEARPROC clear;
    PFNGLENABLEPROC enable;
    PFNGLDISABLEPROC disable;
    PFNGLDEPTHFUNCPROC depth_func;
    PFNGLDEPTHMASKPROC depth_mask;
    PFNGLCOLORMASKPROC color_mask;
    PFNGLSTENCILFUNCPROC stencil_func;
    PFNGLSTENCILOPSEPARATEPROC stencil_op_separate;
    PFNGLFRONTFACEPROC front_face;
    PFNGLBLENDFUNCPROC blend_func;
    PFNGLDRAWARRAYSPROC draw_arrays;
    PFNGLDRAWELEMENTSPROC draw_elements;
    PFNGLDRAWELEMENTSINSTANCEDPROC draw_elements_instanced;
    PFNGLFINISHPROC finish;
    char name[256]; // GL_RENDERER and GL_VERSION
    // ---
    void *library;
    PFNEGLTERMINATEPROC terminate;
    EGLDisplay display;
};

// Opens the Mesa driver `driver` ("llvmpipe", "softpipe") and makes its context current on the calling
// thread. False, with the reason in *why, when this machine has none; nothing is then open. One at a time in
// a process.
bool gles_open(struct gles *gl, const char *driver, const char **why);
void gles_close(struct gles *gl);
// Another function of OpenGL ES, by name, into the pointer to it at `function`; false where there is none.
bool gles_find(const struct gles *gl, const char *name, void *function);
// Compiles and links two shaders, each given as `count` pieces. 0 when the driver refuses; `log` (may be NULL)
// then holds its first words.
GLuint gles_program(const struct gles *gl, const char *const *vertex, const char *const *fragment, int count,
                    char *log, GLsizei log_size);

#endif
