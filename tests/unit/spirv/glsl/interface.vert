#version 450
#extension GL_ARB_shader_viewport_layer_array : require
// Attributes of integers and floats, and varyings of every kind: blocks, arrays, structs, matrices, components.
layout(location = 0) in vec4 position;
layout(location = 1) in ivec2 whole;
layout(location = 2) in uint positive;
layout(location = 3) in mat2 matrix; // two locations
layout(location = 5) in float values[2];

struct Pair { vec2 a; float b[2]; };
layout(location = 0) flat out ivec3 flat_whole;
layout(location = 1, component = 0) out vec2 first;
layout(location = 1, component = 2) noperspective out float second;
layout(location = 1, component = 3) flat out uint third;
layout(location = 2) out Pair pair; // three locations
layout(location = 5) out Block { vec4 plain; flat uvec2 numbers; layout(location = 9) vec3 behind; } block;
layout(location = 10) out mat2x3 turned; // two locations
layout(location = 12) out float list[3];
out gl_PerVertex { vec4 gl_Position; float gl_PointSize; float gl_ClipDistance[2]; float gl_CullDistance[1]; };

void main()
{
    gl_Position = position;
    gl_PointSize = 3.0;
    gl_ClipDistance[0] = position.w;
    gl_CullDistance[0] = 2.0 * position.w;
    gl_Layer = gl_ViewportIndex = 0;
    gl_ClipDistance[1] = position.x + 100.0;
    flat_whole = ivec3(whole, -int(positive));
    first = position.xy;
    second = position.x;
    third = positive;
    pair.a = matrix[0];
    pair.b[0] = matrix[1].x;
    pair.b[1] = values[1];
    block.plain = vec4(position.xy, matrix[1].y, values[0]);
    block.numbers = uvec2(positive, uint(gl_InstanceIndex));
    block.behind = vec3(1.0, position.y, 3.0);
    turned = mat2x3(position.xyz, vec3(matrix[0], 7.0));
    for (int i = 0; i < 3; i++) {
        list[i] = float(i) * position.y;
    }
}
