// SPDX-License-Identifier: MIT
// A chain of rings that lies in a circle. Vertices are made of their index: a ring has STEPS x STEPS quadrangles, two
// triangles each, and an instance is a ring.
#version 450

layout(push_constant) uniform Scene
{
    vec4 eye;
    uint rings;
    uint steps;
};

layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
layout(location = 2) flat out vec3 color;

const float TURN = 6.2831853;
const uvec2 corners[6] = uvec2[](uvec2(0, 0), uvec2(1, 0), uvec2(1, 1), uvec2(0, 0), uvec2(1, 1), uvec2(0, 1));

void main()
{
    const uint quad = uint(gl_VertexIndex) / 6u;
    const uvec2 step = uvec2(quad % steps, quad / steps) + corners[gl_VertexIndex % 6];
    const vec2 angle = vec2(step) * TURN / float(steps);
    const float at = float(gl_InstanceIndex) * TURN / float(rings);

    // A ring in its own plane, along x, then turned about x by a quarter for every other one, then put into the circle.
    const vec3 center = vec3(cos(angle.x) * 0.40, sin(angle.x) * 0.26, 0.0);
    const vec3 outward = normalize(vec3(cos(angle.x) * 0.26, sin(angle.x) * 0.40, 0.0));
    normal = outward * cos(angle.y) + vec3(0.0, 0.0, sin(angle.y));
    place = center + 0.075 * normal;
    const float lean = (gl_InstanceIndex % 2 == 0 ? 0.125 : 0.375) * TURN;
    const mat3 turn = mat3(1, 0, 0, 0, cos(lean), sin(lean), 0, -sin(lean), cos(lean));
    const mat3 along = mat3(-sin(at), cos(at), 0, cos(at), sin(at), 0, 0, 0, -1);
    normal = along * turn * normal;
    place = along * turn * place + vec3(cos(at), sin(at), 0) * 0.083 * float(rings);
    color = 0.55 + 0.45 * cos(at + vec3(0.0, 2.1, 4.2));

    // The eye looks at the origin, with z up, and what is near hangs lower: the picture's centre is a little below the
    // origin. Depths from 1 to 11 are seen.
    const vec3 back = normalize(eye.xyz), right = normalize(cross(vec3(0, 0, 1), back)), up = cross(back, right);
    const vec3 seen = vec3(dot(place, right), dot(place, up), dot(eye.xyz - place, back));
    gl_Position = vec4(seen.x * 2.025, -seen.y * 2.7 - 0.17 * seen.z, (seen.z - 1.0) * 1.1, seen.z);
}
