// SPDX-License-Identifier: MIT
// See peer_program.h. What the driver refuses it says on stderr.
#include "peer_program.h"

#include <stdio.h>

enum { LOG = 1024 };

static const char prelude[] =
    "#version 320 es\nprecision highp float; precision highp int;\n"
    "precision highp sampler2D; precision highp sampler3D; precision highp samplerCube;\n"
    "precision highp sampler2DArray; precision highp samplerCubeArray; precision highp sampler2DShadow;\n"
    "precision highp usampler2D; precision highp isampler2D; precision highp usampler3D;\n"
    "precision highp usampler2DArray; precision highp samplerCubeShadow; precision highp "
    "sampler2DArrayShadow; precision highp samplerCubeArrayShadow;\n"
    "uniform vec4 uniforms[4];\n";

static GLuint compile(const struct gles *gl, GLenum type, const char *const *pieces, GLsizei count)
{
    char log[LOG] = "";
    GLint ok = 0;
    const GLuint shader = gl->create_shader(type);
    gl->shader_source(shader, count, pieces, NULL);
    gl->compile_shader(shader);
    gl->get_shader_iv(shader, GL_COMPILE_STATUS, &ok);
    if (!ok) {
        gl->get_shader_info_log(shader, LOG, NULL, log);
        fprintf(stderr, "%s\n%s\n", pieces[count - 1], log);
    }
    return shader;
}

// Linked for transform feedback too, which draws without it do not notice.
static GLuint make_program(const struct gles *gl, const struct peer_functions *more,
                           const struct shader_pair *shaders)
{
    static const char *const kept[] = {"gl_Position", "values"};
    const char *const sampling = shaders->sampling == RHW_SAMPLING_CENTROID ? "centroid "
                                 : shaders->sampling == RHW_SAMPLING_SAMPLE ? "sample "
                                                                            : "";
    const char *const vertex[] = {
        prelude,
        sampling,
        "out vec4 values; flat out vec4 flat_values, instance_values;\n"
        "layout(location = 0) in vec4 position; layout(location = 1) in vec4 value;\n"
        "layout(location = 2) in vec4 instance;\n"
        "void main() { gl_Position = position + vec4(instance.xy, 0, 0); gl_PointSize = value.w;\n"
        "values = flat_values = value; instance_values = instance;\n",
        shaders->vertex ? shaders->vertex : "",
        "gl_Position.y = -gl_Position.y; }",
    };
    const char *const fragment[] = {prelude, shaders->early_tests ? "layout(early_fragment_tests) in;\n" : "",
                                    sampling, "in vec4 values; flat in vec4 flat_values, instance_values;\n",
                                    shaders->fragment};
    const GLuint vertex_shader = compile(gl, GL_VERTEX_SHADER, vertex, sizeof vertex / sizeof *vertex);
    const GLuint fragment_shader =
        compile(gl, GL_FRAGMENT_SHADER, fragment, sizeof fragment / sizeof *fragment);
    const GLuint program = gl->create_program();
    gl->attach_shader(program, vertex_shader);
    gl->attach_shader(program, fragment_shader);
    more->transform_feedback_varyings(program, 2, kept, GL_INTERLEAVED_ATTRIBS);
    gl->link_program(program);
    gl->delete_shader(vertex_shader); // the program keeps them
    gl->delete_shader(fragment_shader);
    GLint ok = 0;
    gl->get_program_iv(program, GL_LINK_STATUS, &ok);
    if (!ok) {
        char log[LOG] = "";
        more->get_program_info_log(program, LOG, NULL, log);
        fprintf(stderr, "%s\n", log);
    }
    return program;
}

GLuint peer_program_find(const struct gles *gl, const struct peer_functions *more,
                         struct peer_programs *programs, const struct shader_pair *shaders)
{
    for (int i = 0; i < programs->count; i++) {
        if (programs->shaders[i] == shaders) {
            return programs->names[i];
        }
    }
    if (programs->count == PEER_PROGRAMS) {
        return 0;
    }
    programs->shaders[programs->count] = shaders;
    programs->names[programs->count] = make_program(gl, more, shaders);
    return programs->names[programs->count++];
}
