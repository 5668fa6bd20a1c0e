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
layout(set = 1, binding = 2, rg16i) uniform iimage2D store;
layout(constant_id = 7) const float SCALE = 0.5;
layout(constant_id = 2) const bool IS_ON = true;
layout(constant_id = 5) const int MOST = -3; // nobody uses it
layout(location = 0) out vec4 color;

void main()
{
    imageStore(store, ivec2(0), ivec4(1));
    sink.seen[0] = ivec2(count, texelFetch(layers, ivec3(0), 0).x);
    color = scene.view[0] + vec4(scene.turn[0], push.shift) + vec4(scene.eye, scene.time) +
            vec4(scene.lights[1].color * scene.lights[1].power, scene.flags[0]) * weights[0] * (IS_ON ? SCALE : 1.0);
}
