#version 450
struct Light {
    vec3 color;
    float power;
};
layout(set = 0, binding = 0, std140) uniform Scene {
    mat4 view;
    layout(row_major) mat3x2 turn;
    vec3 eye;
    float time;
    Light lights[3];
    uint flags[2];
} scene;
layout(set = 0, binding = 1, std430) readonly buffer Weights {
    int count;
    float weights[];
};
layout(set = 1, binding = 0, std430) buffer Sink { ivec2 seen[]; } sink;
layout(push_constant) uniform Push { layout(offset = 16) vec2 shift; } push;
layout(set = 1, binding = 1) uniform usampler2DArray layers;
layout(location = 0) out vec4 color;

void main()
{
    sink.seen[0] = ivec2(count, texelFetch(layers, ivec3(0), 0).x);
    color = scene.view[0] + vec4(scene.turn[0], push.shift) + vec4(scene.eye, scene.time) +
            vec4(scene.lights[1].color * scene.lights[1].power, scene.flags[0]) * weights[0];
}
