// SPDX-License-Identifier: MIT
// Light from the sky and from a lamp, with a highlight.
#version 450

layout(push_constant) uniform Scene
{
    vec4 eye;
};

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in vec3 color;
layout(location = 0) out vec4 result;

void main()
{
    const vec3 n = normalize(normal), to_eye = normalize(eye.xyz - place);
    const vec3 to_lamp = normalize(vec3(1.0, -1.5, 2.5) - place);
    const float diffuse = max(dot(n, to_lamp), 0.0);
    const float shine = pow(max(dot(n, normalize(to_lamp + to_eye)), 0.0), 60.0);
    const vec3 sky = mix(vec3(0.10, 0.09, 0.12), vec3(0.30, 0.33, 0.38), 0.5 + 0.5 * n.z);
    result = vec4(color * (sky + 0.8 * diffuse) + 0.6 * shine, 1.0);
}
