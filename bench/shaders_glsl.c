// SPDX-License-Identifier: MIT
// See shaders_glsl.h. The pieces are: version, what languages write in two ways, numbers of attributes, definitions of the
// shader, interface, the common functions, main.
#include "shaders_glsl.h"

#include <stdio.h>

#include "shaders_bench.h"

// What is written in two ways, beside the numbers of attributes: Vulkan wants a place for everything.
static const char vertex_language[] =
    "#ifdef GL_ES\n"
    "#define VARYING(n) out\n"
    "#define UNIFORM(n, name, count) uniform vec4 name[count]\n"
    "#define INSTANCE gl_InstanceID\n"
    "#define SCREEN\n"
    "#define TIMES_W(value) (value * gl_Position.w)\n"
    "#else\n"
    "#define VARYING(n) layout(location = n) out\n"
    "#define UNIFORM(n, name, count) layout(set = 0, binding = n) uniform block##n { vec4 name[count]; }\n"
    "#define INSTANCE gl_InstanceIndex\n"
    "#define SCREEN noperspective\n"
    "#define TIMES_W(value) (value)\n"
    "#endif\n";

static const char fragment_language[] =
    "#ifdef GL_ES\n"
    "#define VARYING(n) in\n"
    "#define UNIFORM(n, name, count) uniform vec4 name[count]\n"
    "#define TEXTURE(n) uniform\n"
    "#define SCREEN\n"
    "#define OVER_W(value) (value * gl_FragCoord.w)\n"
    "#else\n"
    "#define VARYING(n) layout(location = n) in\n"
    "#define UNIFORM(n, name, count) layout(set = 0, binding = n) uniform block##n { vec4 name[count]; }\n"
    "#define TEXTURE(n) layout(set = 1, binding = n) uniform\n"
    "#define SCREEN noperspective\n"
    "#define OVER_W(value) (value)\n"
    "#endif\n";

static const char usual[] = "#define UNIFORMS 11\n";

static const char vertex_head[] = "precision highp float;\n"
                                  "layout(location = POSITION) in vec3 position;\n"
                                  "#ifdef NORMAL\n"
                                  "layout(location = NORMAL) in vec3 normal;\n"
                                  "#endif\n"
                                  "#ifdef UV\n"
                                  "layout(location = UV) in vec2 uv;\n"
                                  "#endif\n"
                                  "#ifdef COLOR\n"
                                  "layout(location = COLOR) in vec4 color;\n"
                                  "#endif\n"
                                  "#ifdef PLACE\n"
                                  "layout(location = PLACE) in vec4 place;\n"
                                  "layout(location = TINT) in vec4 tint;\n"
                                  "#endif\n"
                                  "UNIFORM(0, u, UNIFORMS);\n";

static const char vertex_common[] =
    "void to_clip(vec3 p) { gl_Position = u[0] * p.x + u[1] * p.y + u[2] * p.z + u[3]; }\n"
    "void to_clip() { to_clip(position); }\n"
    "vec3 to_world(vec4 p) { return vec3(dot(u[4], p), dot(u[5], p), dot(u[6], p)); }\n"
    "vec3 turn(vec3 v) { return vec3(dot(u[4].xyz, v), dot(u[5].xyz, v), dot(u[6].xyz, v)); }\n";

static const char fragment_head[] = "precision highp float;\n"
                                    "precision highp sampler2D;\n"
                                    "UNIFORM(0, u, UNIFORMS);\n"
                                    "TEXTURE(0) sampler2D base;\n"
                                    "layout(location = 0) out vec4 target;\n";

// What is there already: OpenGL ES reads the target, Vulkan an input attachment.
static const char input_head[] =
    "precision highp float;\n"
    "UNIFORM(0, u, UNIFORMS);\n"
    "#ifdef GL_ES\n"
    "#define THERE target\n"
    "layout(location = 0) inout vec4 target;\n"
    "#else\n"
    "#define THERE subpassLoad(there)\n"
    "layout(location = 0) out vec4 target;\n"
    "layout(input_attachment_index = 0, set = 1, binding = 0) uniform subpassInput there;\n"
    "#endif\n";

// A power is written as its definition, which is one order of operations for everybody.
static const char fragment_common[] =
    "float power(float x, float y) { return exp2(y * log2(x)); }\n"
    "vec3 shade(vec3 normal, vec3 position, vec3 base_color) {\n"
    "    vec3 n = normalize(normal), v = normalize(u[7].xyz - position), h = normalize(v + u[8].xyz);\n"
    "    float n_dot_l = max(dot(n, u[8].xyz), 0.0), n_dot_h = max(dot(n, h), 0.0);\n"
    "    float gloss = u[10].x * power(n_dot_h, u[7].w);\n"
    "    return base_color * (u[8].w + (1.0 - u[8].w) * n_dot_l) + vec3(gloss);\n"
    "}\n";

#define SLOPES "vec4 slopes() { vec2 c = varying_color.rg; return vec4(dFdx(c), dFdy(c)).xzyw; }\n"

static const char color_vertex[] = "VARYING(0) vec4 varying_color;\n"
                                   "void main() { to_clip(); varying_color = color; }\n";

static const struct {
    const char *vertex, *fragment;
} mains[BENCH_SHADERS] = {
    [BENCH_SHADER_FLAT] = {"void main() { to_clip(); }\n", "void main() { target = u[9]; }\n"},
    [BENCH_SHADER_LITERAL] = {"void main() { to_clip(); }\n",
                              "void main() { target = vec4(0.85, 0.2, 0.15, 1.0); }\n"},
    [BENCH_SHADER_COLOR] = {color_vertex, "VARYING(0) vec4 varying_color;\n"
                                          "void main() { target = varying_color; }\n"},
    [BENCH_SHADER_TEXTURE] = {"VARYING(0) vec2 varying_uv;\n"
                              "void main() { to_clip(); varying_uv = uv; }\n",
                              "VARYING(0) vec2 varying_uv;\n"
                              "void main() { target = texture(base, varying_uv); }\n"},
    [BENCH_SHADER_LIT] =
        {"VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
         "void main() { to_clip(); varying_normal = turn(normal);\n"
         "varying_position = to_world(vec4(position, 1.0)); }\n",
         "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
         "void main() { target = vec4(shade(varying_normal, varying_position, u[9].rgb), 1.0); }\n"},
    [BENCH_SHADER_LIT_POINT] =
        {"VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
         "void main() { to_clip(); gl_PointSize = 1.0; varying_normal = turn(normal);\n"
         "varying_position = to_world(vec4(position, 1.0)); }\n",
         "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
         "void main() { target = vec4(shade(varying_normal, varying_position, u[9].rgb), 1.0); }\n"},
    [BENCH_SHADER_LIT_FLAT] =
        {"VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
         "flat VARYING(2) vec3 flat_color; flat VARYING(3) int instance;\n"
         "void main() { to_clip(); varying_normal = turn(normal);\n"
         "varying_position = to_world(vec4(position, 1.0)); flat_color = u[9].rgb; instance = INSTANCE; "
         "}\n",
         "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position;\n"
         "flat VARYING(2) vec3 flat_color; flat VARYING(3) int instance;\n"
         "void main() { vec3 base_color = flat_color * (float(instance) + 1.0);\n"
         "target = vec4(shade(varying_normal, varying_position, base_color), 1.0); }\n"},
    [BENCH_SHADER_LIT_TEXTURE] =
        {"VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position; VARYING(2) vec2 varying_uv;\n"
         "void main() { to_clip(); varying_normal = turn(normal);\n"
         "varying_position = to_world(vec4(position, 1.0)); varying_uv = uv; }\n",
         "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position; VARYING(2) vec2 varying_uv;\n"
         "void main() { vec3 texel = texture(base, varying_uv).rgb;\n"
         "target = vec4(shade(varying_normal, varying_position, texel * u[9].rgb), 1.0); }\n"},
    [BENCH_SHADER_LIT_MASKED] =
        {"VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position; VARYING(2) vec2 varying_uv;\n"
         "void main() { to_clip(); varying_normal = turn(normal);\n"
         "varying_position = to_world(vec4(position, 1.0)); varying_uv = uv; }\n",
         "VARYING(0) vec3 varying_normal; VARYING(1) vec3 varying_position; VARYING(2) vec2 varying_uv;\n"
         "void main() { vec4 texel = texture(base, varying_uv); if (texel.a < u[10].y) discard;\n"
         "target = vec4(shade(varying_normal, varying_position, texel.rgb * u[9].rgb), 1.0); }\n"},
    [BENCH_SHADER_PARTICLE] =
        {"VARYING(0) vec2 corner; flat VARYING(1) vec4 flat_tint;\n"
         "void main() { corner = position.xy; flat_tint = tint;\n"
         "to_clip(place.xyz + (u[4].xyz * corner.x + u[5].xyz * corner.y) * place.w); }\n",
         "VARYING(0) vec2 corner; flat VARYING(1) vec4 flat_tint;\n"
         "void main() { target = vec4(flat_tint.rgb, flat_tint.a * max(1.0 - dot(corner, corner), 0.0)); "
         "}\n"},
    [BENCH_SHADER_VOLUME] =
        {"void main() { to_clip(dot(normal, u[9].xyz) > 0.0 ? position + u[9].xyz : position); }\n",
         "void main() { }\n"},
    [BENCH_SHADER_DEPTH] = {"void main() { to_clip(); }\n", "void main() { }\n"},
    // Times W and over W: GL_NV_shader_noperspective_interpolation is not everywhere, and with Mesa 25.0.7 llvmpipe loses
    // clipped triangles of it.
    [BENCH_SHADER_SCREEN] = {"SCREEN VARYING(0) vec4 varying_color;\n"
                             "void main() { to_clip(); varying_color = TIMES_W(color); }\n",
                             "SCREEN VARYING(0) vec4 varying_color;\n"
                             "void main() { target = OVER_W(varying_color); }\n"},
    [BENCH_SHADER_COORD] = {color_vertex, "VARYING(0) vec4 varying_color;\n"
                                          "void main() { target = varying_color + gl_FragCoord * u[9]; }\n"},
    [BENCH_SHADER_SLOPES] = {color_vertex, "VARYING(0) vec4 varying_color;\n" SLOPES
                                           "void main() { target = varying_color + slopes() * u[10].y; }\n"},
    [BENCH_SHADER_COORD_SLOPES] =
        {color_vertex,
         "VARYING(0) vec4 varying_color;\n" SLOPES
         "void main() { target = varying_color + gl_FragCoord * u[9] + slopes() * u[10].y; }\n"},
    [BENCH_SHADER_DISCARD] =
        {color_vertex, "VARYING(0) vec4 varying_color;\n"
                       "void main() { if (varying_color.r < u[10].y) discard; target = varying_color; }\n"},
    [BENCH_SHADER_MOVE] =
        {color_vertex, "VARYING(0) vec4 varying_color;\n"
                       "void main() { target = varying_color; gl_FragDepth = varying_color.a * u[9].a; }\n"},
    [BENCH_SHADER_MANY] = {"VARYING(0) vec4 parts[16];\n"
                           "void main() { to_clip();\n"
                           "for (int i = 0; i < 16; i++) parts[i] = color * ((float(i) + 0.5) / 37.0); }\n",
                           "VARYING(0) vec4 parts[16];\n"
                           "void main() { vec4 sum = parts[0] * parts[0];\n"
                           "for (int i = 1; i < 16; i++) sum += parts[i] * parts[i];\n"
                           "target = sum; }\n"},
    [BENCH_SHADER_SAMPLE] = {"sample VARYING(0) vec4 varying_color;\n"
                             "void main() { to_clip(); varying_color = color; }\n",
                             "sample VARYING(0) vec4 varying_color;\n"
                             "void main() { target = varying_color; }\n"},
    [BENCH_SHADER_INPUT] = {color_vertex,
                            "VARYING(0) vec4 varying_color;\n"
                            "void main() { target = mix(THERE, varying_color, varying_color.a); }\n"},
};

static const char *version_of(enum bench_glsl_language language, enum bench_shader shader)
{
    if (language == BENCH_GLSL_VULKAN) {
        return "#version 450\n";
    }
    switch (shader) {
    case BENCH_SHADER_SAMPLE: return "#version 320 es\n";
    case BENCH_SHADER_INPUT: return "#version 300 es\n#extension GL_EXT_shader_framebuffer_fetch : require\n";
    default: return "#version 300 es\n";
    }
}

// For OpenGL ES an attribute has the number of its enum bench_attribute, and all of them are declared. For Vulkan it has
// its number among those that the shader reads.
static const char *attributes_of(enum bench_glsl_language language, enum bench_shader shader)
{
    static const char *const names[BENCH_ATTRIBUTES] = {"POSITION", "NORMAL", "UV",  "COLOR",
                                                        "TANGENT",  "PLACE",  "TINT"};
    static char texts[2][BENCH_SHADERS][128];
    char *const text = texts[language == BENCH_GLSL_VULKAN][shader];
    int length = 0, number = 0;
    for (int a = 0; a < BENCH_ATTRIBUTES; a++) {
        const bool is_read = (bench_shader_attributes[shader] >> a & 1) != 0;
        if (is_read || language == BENCH_GLSL_ES) {
            length += snprintf(text + length, sizeof texts[0][0] - (size_t)length, "#define %s %d\n",
                               names[a], language == BENCH_GLSL_ES ? a : number);
        }
        number += is_read ? 1 : 0;
    }
    return text;
}

void bench_glsl(enum bench_glsl_language language, enum bench_shader shader,
                const char *vertex[BENCH_GLSL_PIECES], const char *fragment[BENCH_GLSL_PIECES])
{
    vertex[0] = fragment[0] = version_of(language, shader);
    vertex[1] = vertex_language;
    fragment[1] = fragment_language;
    vertex[2] = attributes_of(language, shader);
    fragment[2] = "";
    if (shader >= BENCH_SHADER_PBR_BASE) {
        bench_glsl_pbr(shader, vertex, fragment);
        return;
    }
    vertex[4] = vertex_head;
    vertex[5] = vertex_common;
    fragment[4] = fragment_head;
    fragment[5] = fragment_common;
    if (shader >= BENCH_SHADER_SHADOWED) {
        bench_glsl_passes(shader, vertex, fragment);
        return;
    }
    vertex[3] = fragment[3] = usual;
    if (shader == BENCH_SHADER_INPUT) {
        fragment[4] = input_head;
    }
    vertex[6] = mains[shader].vertex;
    fragment[6] = mains[shader].fragment;
}
