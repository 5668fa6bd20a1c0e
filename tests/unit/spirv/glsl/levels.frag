#version 450
#extension GL_ARB_sparse_texture_clamp : require
layout(set = 0, binding = 0) uniform sampler2D plane;
layout(set = 0, binding = 1) uniform sampler3D volume;
layout(set = 0, binding = 2) uniform sampler2DShadow shadow;
layout(push_constant) uniform Push { float scale; int which; };
layout(location = 0) in vec4 value;
layout(location = 0) out vec4 target;

#define PART(x, y) textureOffset(shadow, vec3(value.xy, 0.001), ivec2(x, y))
#define ROW(y) (PART(-1, y) + 2.0 * PART(0, y) + 4.0 * PART(1, y))

void main()
{
    switch (which) {
    case 0: target = texture(plane, value.xy); break;
    case 1: target = texture(plane, value.xy, 0.75); break;
    case 2: target = texture(volume, value.xyz); break;
    case 3: target = vec4(texture(shadow, vec3(value.xy, 0.001)), textureQueryLod(plane, value.xy), 1.0); break;
    case 4: target = textureOffset(plane, value.xy, ivec2(1, 2)); break;
    case 5: target = textureClampARB(plane, value.xy, 0.0); break;
    case 7: target = vec4(ROW(-1), ROW(0), ROW(1), PART(3, 0)); break;
    default: target = textureClampARB(plane, value.xy, 2.5); break;
    }
}
