#version 450
#extension GL_EXT_scalar_block_layout : require
// Members and elements that follow each other without room between them.
layout(local_size_x = 1) in;
struct Part { vec3 a; float b; vec2 c[3]; vec3 d[2]; };
layout(scalar, set = 0, binding = 0) uniform Given { float first; Part part; mat3 matrix; };
layout(scalar, set = 0, binding = 1) buffer Made { vec2 sums; vec3 last; };
void main()
{
    sums = vec2(part.a.z + part.b, part.c[2].y + part.d[1].x);
    last = matrix[2] + first;
}
