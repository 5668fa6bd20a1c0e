// SPDX-License-Identifier: MIT
// The GLSL form of the shaders that read what earlier passes drew; see shaders_glsl.h. `u` goes on behind u[10] with the
// scene's shared uniforms.
#include "shaders_glsl.h"

static const char lit_vertex[] = "out vec3 varying_normal, varying_position;\n"
                                 "void main() { to_clip(); varying_normal = to_world(vec4(normal, 0.0));\n"
                                 "varying_position = to_world(vec4(position, 1.0)); }\n";

static const char ray_vertex[] = "out vec3 ray;\n"
                                 "void main() { to_clip(); ray = normal; }\n";

static const char shadowed_vertex[] =
    "out vec3 varying_normal, varying_position, varying_map;\n"
    "void main() { to_clip(); varying_normal = to_world(vec4(normal, 0.0));\n"
    "varying_position = to_world(vec4(position, 1.0)); vec4 p = vec4(varying_position, 1.0);\n"
    "varying_map = vec3(dot(u[11], p), dot(u[12], p), dot(u[13], p)); }\n";

static const char shadowed_fragment[] =
    "uniform highp sampler2DShadow map0;\n"
    "in vec3 varying_normal, varying_position, varying_map;\n"
    "void main() {\n"
    "    float lit = 0.0;\n"
    "    vec3 at = vec3(varying_map.xy, min(varying_map.z, 1.0));\n"
    "    for (int y = -1; y <= 1; y++)\n"
    "        for (int x = -1; x <= 1; x++)\n"
    "            lit += textureLod(map0, at + vec3(float(x), float(y), 0.0) * u[14].x, 0.0);\n"
    "    lit *= 1.0 / 9.0;\n"
    "    vec3 n = normalize(varying_normal), v = normalize(u[7].xyz - varying_position);\n"
    "    vec3 h = normalize(v + u[8].xyz);\n"
    "    float n_dot_l = max(dot(n, u[8].xyz), 0.0), n_dot_h = max(dot(n, h), 0.0);\n"
    "    float gloss = u[10].x * pow(n_dot_h, u[7].w) * lit;\n"
    "    target = vec4(u[9].rgb * (u[8].w + (1.0 - u[8].w) * n_dot_l * lit) + vec3(gloss), 1.0);\n"
    "}\n";

static const char reflect_fragment[] =
    "uniform samplerCube map0;\n"
    "in vec3 varying_normal, varying_position;\n"
    "void main() {\n"
    "    vec3 direction = reflect(varying_position - u[7].xyz, normalize(varying_normal));\n"
    "    target = vec4(u[9].rgb * textureLod(map0, direction, 0.0).rgb, 1.0);\n"
    "}\n";

static const char surface_fragment[] = "layout(location = 1) out vec4 target1;\n"
                                       "layout(location = 2) out float target2;\n"
                                       "layout(location = 3) out vec4 target3;\n"
                                       "in vec3 varying_normal, varying_position;\n"
                                       "void main() {\n"
                                       "    target = u[9];\n"
                                       "    target1 = vec4(normalize(varying_normal), 0.0);\n"
                                       "    target2 = 1.0 / gl_FragCoord.w;\n"
                                       "    target3 = vec4(u[10].x, u[7].w * (1.0 / 256.0), u[8].w, 1.0);\n"
                                       "}\n";

static const char lights_fragment[] =
    "uniform sampler2D map0, map1, map2, map3;\n"
    "in vec3 ray;\n"
    "void main() {\n"
    "    ivec2 at = ivec2(gl_FragCoord.xy);\n"
    "    vec3 albedo = texelFetch(map0, at, 0).rgb, n = normalize(texelFetch(map1, at, 0).xyz);\n"
    "    float distance = texelFetch(map2, at, 0).x;\n"
    "    vec4 material = texelFetch(map3, at, 0);\n"
    "    vec3 p = u[7].xyz + ray * distance, v = normalize(-ray);\n"
    "    vec3 sum = albedo * material.z;\n"
    "    for (int i = 0; i < LIGHTS; i++) {\n"
    "        vec4 place = u[11 + 2 * i];\n"
    "        vec3 l = place.xyz - p;\n"
    "        float left = max(1.0 - dot(l, l) * place.w, 0.0);\n"
    "        if (left > 0.0) {\n"
    "            l = normalize(l);\n"
    "            vec3 h = normalize(l + v);\n"
    "            float n_dot_l = max(dot(n, l), 0.0), n_dot_h = max(dot(n, h), 0.0);\n"
    "            float gloss = material.x * pow(n_dot_h, 256.0 * material.y);\n"
    "            sum += u[12 + 2 * i].rgb * (left * left) * (albedo * n_dot_l + vec3(gloss));\n"
    "        }\n"
    "    }\n"
    "    target = vec4(sum, 1.0);\n"
    "}\n";

_Static_assert(BENCH_LIGHTS == 32, "LIGHTS and UNIFORMS of the shader");

static const struct {
    const char *head, *vertex, *fragment;
} sources[BENCH_SHADERS] = {
    [BENCH_SHADER_SHADOWED] = {"#version 300 es\n#define UNIFORMS 15\n", shadowed_vertex, shadowed_fragment},
    [BENCH_SHADER_REFLECT] = {"#version 300 es\n#define UNIFORMS 11\n", lit_vertex, reflect_fragment},
    [BENCH_SHADER_SURFACE] = {"#version 300 es\n#define UNIFORMS 11\n", lit_vertex, surface_fragment},
    [BENCH_SHADER_LIGHTS] = {"#version 300 es\n#define UNIFORMS 75\n#define LIGHTS 32\n", ray_vertex,
                             lights_fragment},
};

void bench_glsl_passes(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                       const char *fragment[BENCH_GLSL_PIECES])
{
    vertex[0] = fragment[0] = sources[shader].head;
    vertex[3] = sources[shader].vertex;
    fragment[3] = sources[shader].fragment;
}
