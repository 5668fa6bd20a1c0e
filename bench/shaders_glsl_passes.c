// SPDX-License-Identifier: MIT
// The GLSL form of the shaders that read what earlier passes drew; see shaders_glsl.h. `u` goes on behind u[10] with the
// scene's shared uniforms.
#include "shaders_glsl.h"

static const char lit_vertex[] = "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
                                 "void main() { to_clip(); varying_normal = turn(normal);\n"
                                 "varying_position = to_world(vec4(position, 1.0)); }\n";

static const char ray_vertex[] = "VARYING(0) vec3 ray;\n"
                                 "void main() { to_clip(); ray = normal; }\n";

static const char shadowed_vertex[] =
    "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position; VARYING(2) vec3 varying_map;\n"
    "void main() { to_clip(); varying_normal = turn(normal);\n"
    "varying_position = to_world(vec4(position, 1.0)); vec4 p = vec4(varying_position, 1.0);\n"
    "varying_map = vec3(dot(u[11], p), dot(u[12], p), dot(u[13], p)); }\n";

static const char shadowed_fragment[] =
    "precision highp sampler2DShadow;\n"
    "TEXTURE(0) sampler2DShadow map0;\n"
    "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position; VARYING(2) vec3 varying_map;\n"
    "#define PART(x, y) textureLodOffset(map0, at, 0.0, ivec2(x, y))\n"
    "void main() {\n"
    "    vec3 at = vec3(varying_map.xy, min(varying_map.z, 1.0));\n"
    "    float lit = PART(-1, -1) + PART(0, -1) + PART(1, -1) + PART(-1, 0) + PART(0, 0) + PART(1, 0) +\n"
    "                PART(-1, 1) + PART(0, 1) + PART(1, 1);\n"
    "    lit *= 1.0 / 9.0;\n"
    "    vec3 n = normalize(varying_normal), v = normalize(u[7].xyz - varying_position);\n"
    "    vec3 h = normalize(v + u[8].xyz);\n"
    "    float n_dot_l = max(dot(n, u[8].xyz), 0.0), n_dot_h = max(dot(n, h), 0.0);\n"
    "    float gloss = u[10].x * power(n_dot_h, u[7].w) * lit;\n"
    "    target = vec4(u[9].rgb * (u[8].w + (1.0 - u[8].w) * n_dot_l * lit) + vec3(gloss), 1.0);\n"
    "}\n";

static const char reflect_fragment[] =
    "TEXTURE(0) samplerCube map0;\n"
    "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
    "void main() {\n"
    "    vec3 direction = reflect(varying_position - u[7].xyz, normalize(varying_normal));\n"
    "    target = vec4(u[9].rgb * textureLod(map0, direction, 0.0).rgb, 1.0);\n"
    "}\n";

static const char surface_fragment[] = "layout(location = 1) out vec4 target1;\n"
                                       "layout(location = 2) out float target2;\n"
                                       "layout(location = 3) out vec4 target3;\n"
                                       "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
                                       "void main() {\n"
                                       "    target = u[9];\n"
                                       "    target1 = vec4(normalize(varying_normal), 0.0);\n"
                                       "    target2 = 1.0 / gl_FragCoord.w;\n"
                                       "    target3 = vec4(u[10].x, u[7].w * (1.0 / 256.0), u[8].w, 1.0);\n"
                                       "}\n";

static const char lights_fragment[] =
    "TEXTURE(0) sampler2D map0; TEXTURE(1) sampler2D map1; TEXTURE(2) sampler2D map2; TEXTURE(3) sampler2D "
    "map3;\n"
    "VARYING(0) vec3 ray;\n"
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
    "            float gloss = material.x * power(n_dot_h, 256.0 * material.y);\n"
    "            sum += u[12 + 2 * i].rgb * (left * left) * (albedo * n_dot_l + vec3(gloss));\n"
    "        }\n"
    "    }\n"
    "    target = vec4(sum, 1.0);\n"
    "}\n";

_Static_assert(BENCH_LIGHTS == 32, "LIGHTS and UNIFORMS of the shader");

static const struct {
    const char *head, *vertex, *fragment;
} sources[BENCH_SHADERS] = {
    [BENCH_SHADER_SHADOWED] = {"#define UNIFORMS 15\n", shadowed_vertex, shadowed_fragment},
    [BENCH_SHADER_REFLECT] = {"#define UNIFORMS 11\n", lit_vertex, reflect_fragment},
    [BENCH_SHADER_SURFACE] = {"#define UNIFORMS 11\n", lit_vertex, surface_fragment},
    [BENCH_SHADER_LIGHTS] = {"#define UNIFORMS 75\n#define LIGHTS 32\n", ray_vertex, lights_fragment},
};

void bench_glsl_passes(enum bench_shader shader, const char *vertex[BENCH_GLSL_PIECES],
                       const char *fragment[BENCH_GLSL_PIECES])
{
    vertex[3] = fragment[3] = sources[shader].head;
    vertex[6] = sources[shader].vertex;
    fragment[6] = sources[shader].fragment;
}
