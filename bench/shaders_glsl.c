// SPDX-License-Identifier: MIT
// See shaders_glsl.h. The pieces are: version and number of uniforms, interface, the common functions, main.
#include "shaders_glsl.h"

static const char version[] = "#version 300 es\n#define UNIFORMS 11\n";

static const char vertex_head[] = "precision highp float;\n"
                                  "layout(location = 0) in vec3 position;\n"
                                  "layout(location = 1) in vec3 normal;\n"
                                  "layout(location = 2) in vec2 uv;\n"
                                  "layout(location = 3) in vec4 color;\n"
                                  "layout(location = 5) in vec4 place;\n"
                                  "layout(location = 6) in vec4 tint;\n"
                                  "uniform vec4 u[UNIFORMS];\n";

static const char vertex_common[] =
    "void to_clip(vec3 p) { gl_Position = u[0] * p.x + u[1] * p.y + u[2] * p.z + u[3]; }\n"
    "void to_clip() { to_clip(position); }\n"
    "vec3 to_world(vec4 p) { return vec3(dot(u[4], p), dot(u[5], p), dot(u[6], p)); }\n";

static const char fragment_head[] = "precision highp float;\n"
                                    "precision highp sampler2D;\n"
                                    "uniform vec4 u[UNIFORMS];\n"
                                    "uniform sampler2D base;\n"
                                    "layout(location = 0) out vec4 target;\n";

static const char input_head[] = "precision highp float;\n"
                                 "uniform vec4 u[UNIFORMS];\n"
                                 "layout(location = 0) inout vec4 target;\n";

static const char fragment_common[] =
    "vec3 shade(vec3 normal, vec3 position, vec3 base_color) {\n"
    "    vec3 n = normalize(normal), v = normalize(u[7].xyz - position), h = normalize(v + u[8].xyz);\n"
    "    float n_dot_l = max(dot(n, u[8].xyz), 0.0), n_dot_h = max(dot(n, h), 0.0);\n"
    "    float gloss = u[10].x * pow(n_dot_h, u[7].w);\n"
    "    return base_color * (u[8].w + (1.0 - u[8].w) * n_dot_l) + vec3(gloss);\n"
    "}\n";

#define SLOPES "vec4 slopes() { vec2 c = varying_color.rg; return vec4(dFdx(c), dFdy(c)).xzyw; }\n"

static const char color_vertex[] = "out vec4 varying_color;\n"
                                   "void main() { to_clip(); varying_color = color; }\n";

static const struct {
    const char *vertex, *fragment;
} mains[BENCH_SHADERS] = {
    [BENCH_SHADER_FLAT] = {"void main() { to_clip(); }\n", "void main() { target = u[9]; }\n"},
    [BENCH_SHADER_LITERAL] = {"void main() { to_clip(); }\n",
                              "void main() { target = vec4(0.85, 0.2, 0.15, 1.0); }\n"},
    [BENCH_SHADER_COLOR] = {color_vertex, "in vec4 varying_color;\n"
                                          "void main() { target = varying_color; }\n"},
    [BENCH_SHADER_TEXTURE] = {"out vec2 varying_uv;\n"
                              "void main() { to_clip(); varying_uv = uv; }\n",
                              "in vec2 varying_uv;\n"
                              "void main() { target = texture(base, varying_uv); }\n"},
    [BENCH_SHADER_LIT] =
        {"out vec3 varying_normal, varying_position;\n"
         "void main() { to_clip(); varying_normal = to_world(vec4(normal, 0.0));\n"
         "varying_position = to_world(vec4(position, 1.0)); }\n",
         "in vec3 varying_normal, varying_position;\n"
         "void main() { target = vec4(shade(varying_normal, varying_position, u[9].rgb), 1.0); }\n"},
    [BENCH_SHADER_LIT_POINT] =
        {"out vec3 varying_normal, varying_position;\n"
         "void main() { to_clip(); gl_PointSize = 1.0; varying_normal = to_world(vec4(normal, 0.0));\n"
         "varying_position = to_world(vec4(position, 1.0)); }\n",
         "in vec3 varying_normal, varying_position;\n"
         "void main() { target = vec4(shade(varying_normal, varying_position, u[9].rgb), 1.0); }\n"},
    [BENCH_SHADER_LIT_FLAT] =
        {"out vec3 varying_normal, varying_position; flat out vec3 flat_color; flat out int instance;\n"
         "void main() { to_clip(); varying_normal = to_world(vec4(normal, 0.0));\n"
         "varying_position = to_world(vec4(position, 1.0)); flat_color = u[9].rgb; instance = gl_InstanceID; "
         "}\n",
         "in vec3 varying_normal, varying_position; flat in vec3 flat_color; flat in int instance;\n"
         "void main() { vec3 base_color = flat_color * (float(instance) + 1.0);\n"
         "target = vec4(shade(varying_normal, varying_position, base_color), 1.0); }\n"},
    [BENCH_SHADER_LIT_TEXTURE] =
        {"out vec3 varying_normal, varying_position; out vec2 varying_uv;\n"
         "void main() { to_clip(); varying_normal = to_world(vec4(normal, 0.0));\n"
         "varying_position = to_world(vec4(position, 1.0)); varying_uv = uv; }\n",
         "in vec3 varying_normal, varying_position; in vec2 varying_uv;\n"
         "void main() { vec3 texel = texture(base, varying_uv).rgb;\n"
         "target = vec4(shade(varying_normal, varying_position, texel * u[9].rgb), 1.0); }\n"},
    [BENCH_SHADER_LIT_MASKED] =
        {"out vec3 varying_normal, varying_position; out vec2 varying_uv;\n"
         "void main() { to_clip(); varying_normal = to_world(vec4(normal, 0.0));\n"
         "varying_position = to_world(vec4(position, 1.0)); varying_uv = uv; }\n",
         "in vec3 varying_normal, varying_position; in vec2 varying_uv;\n"
         "void main() { vec4 texel = texture(base, varying_uv); if (texel.a < u[10].y) discard;\n"
         "target = vec4(shade(varying_normal, varying_position, texel.rgb * u[9].rgb), 1.0); }\n"},
    [BENCH_SHADER_PARTICLE] =
        {"out vec2 corner; flat out vec4 flat_tint;\n"
         "void main() { corner = position.xy; flat_tint = tint;\n"
         "to_clip(place.xyz + (u[4].xyz * corner.x + u[5].xyz * corner.y) * place.w); }\n",
         "in vec2 corner; flat in vec4 flat_tint;\n"
         "void main() { target = vec4(flat_tint.rgb, flat_tint.a * max(1.0 - dot(corner, corner), 0.0)); "
         "}\n"},
    [BENCH_SHADER_VOLUME] =
        {"void main() { to_clip(dot(normal, u[9].xyz) > 0.0 ? position + u[9].xyz : position); }\n",
         "void main() { }\n"},
    [BENCH_SHADER_DEPTH] = {"void main() { to_clip(); }\n", "void main() { }\n"},
    // Times W and over W: GL_NV_shader_noperspective_interpolation is not everywhere, and with Mesa 25.0.7 llvmpipe loses
    // clipped triangles of it.
    [BENCH_SHADER_SCREEN] = {"out vec4 varying_color;\n"
                             "void main() { to_clip(); varying_color = color * gl_Position.w; }\n",
                             "in vec4 varying_color;\n"
                             "void main() { target = varying_color * gl_FragCoord.w; }\n"},
    [BENCH_SHADER_COORD] = {color_vertex, "in vec4 varying_color;\n"
                                          "void main() { target = varying_color + gl_FragCoord * u[9]; }\n"},
    [BENCH_SHADER_SLOPES] = {color_vertex, "in vec4 varying_color;\n" SLOPES
                                           "void main() { target = varying_color + slopes() * u[10].y; }\n"},
    [BENCH_SHADER_COORD_SLOPES] =
        {color_vertex,
         "in vec4 varying_color;\n" SLOPES
         "void main() { target = varying_color + gl_FragCoord * u[9] + slopes() * u[10].y; }\n"},
    [BENCH_SHADER_DISCARD] =
        {color_vertex, "in vec4 varying_color;\n"
                       "void main() { if (varying_color.r < u[10].y) discard; target = varying_color; }\n"},
    [BENCH_SHADER_MOVE] =
        {color_vertex, "in vec4 varying_color;\n"
                       "void main() { target = varying_color; gl_FragDepth = varying_color.a * u[9].a; }\n"},
    [BENCH_SHADER_SAMPLE] = {"sample out vec4 varying_color;\n"
                             "void main() { to_clip(); varying_color = color; }\n",
                             "sample in vec4 varying_color;\n"
                             "void main() { target = varying_color; }\n"},
    [BENCH_SHADER_INPUT] = {color_vertex,
                            "in vec4 varying_color;\n"
                            "void main() { target = mix(target, varying_color, varying_color.a); }\n"},
};

// The first piece: what the shader needs beside GLSL ES 3.00.
static const char *version_of(enum bench_shader shader)
{
    switch (shader) {
    case BENCH_SHADER_SAMPLE: return "#version 320 es\n#define UNIFORMS 11\n";
    case BENCH_SHADER_INPUT:
        return "#version 300 es\n#extension GL_EXT_shader_framebuffer_fetch : require\n#define UNIFORMS 11\n";
    default: return version;
    }
}

void bench_glsl(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                const char *fragment[BENCH_GLSL_PIECES])
{
    if (shader >= BENCH_SHADER_PBR_BASE) {
        bench_glsl_pbr(shader, vertex, fragment);
        return;
    }
    vertex[1] = vertex_head;
    vertex[2] = vertex_common;
    fragment[1] = fragment_head;
    fragment[2] = fragment_common;
    if (shader >= BENCH_SHADER_SHADOWED) {
        bench_glsl_passes(shader, vertex, fragment);
        return;
    }
    vertex[0] = fragment[0] = version_of(shader);
    if (shader == BENCH_SHADER_INPUT) {
        fragment[1] = input_head;
    }
    vertex[3] = mains[shader].vertex;
    fragment[3] = mains[shader].fragment;
}
