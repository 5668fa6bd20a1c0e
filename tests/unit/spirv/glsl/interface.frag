#version 450
struct Pair { vec2 a; float b[2]; };
layout(location = 0) flat in ivec3 flat_whole;
layout(location = 1, component = 0) in vec2 first;
layout(location = 1, component = 2) noperspective in float second;
layout(location = 1, component = 3) flat in uint third;
layout(location = 2) in Pair pair;
layout(location = 5) in Block { vec4 plain; flat uvec2 numbers; layout(location = 9) vec3 behind; } block;
layout(location = 10) in mat2x3 turned;
layout(location = 12) in float list[3];
in float gl_ClipDistance[2];
in float gl_CullDistance[1];

layout(location = 0) out vec4 smooth_values;
layout(location = 1) out vec4 flat_values;
layout(location = 2) out vec4 more;
layout(location = 3) out vec4 last;
layout(location = 4) out vec4 built_in;

void main()
{
    smooth_values = vec4(first, second, gl_ClipDistance[1]);
    flat_values = vec4(flat_whole, third);
    more = vec4(pair.a.y, pair.b[1], block.plain.z + block.plain.w, block.behind.y);
    built_in = vec4(gl_PrimitiveID, gl_Layer + gl_ViewportIndex, gl_FrontFacing, gl_CullDistance[0]);
    last = vec4(block.numbers, turned[1].y + turned[0].x, list[int(gl_FragCoord.x) % 3]);
}
