// SPDX-License-Identifier: MIT
// The vertex shader before --fragment-shader, as scene/draw/material_program.h has it. material.inc has its words.
#version 450
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 up;
layout(location = 2) in vec2 coordinates;
layout(location = 3) in vec4 tint;
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 uv;
layout(location = 3) out vec4 vertex_color;
layout(push_constant) uniform Place {
    mat4 clip;
    mat4 world;
    mat3 normals;
    vec4 rows[2];
};

void main()
{
    position = (world * vec4(place, 1.0)).xyz;
    normal = normalize(normals * up);
    uv = vec2(dot(rows[0].xyz, vec3(coordinates, 1.0)), dot(rows[1].xyz, vec3(coordinates, 1.0)));
    vertex_color = tint;
    gl_Position = clip * vec4(place, 1.0);
}
