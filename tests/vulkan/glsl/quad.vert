#version 450
// Two triangles of a rectangle of clip space, by the number of the vertex; 1/8 further right with each instance.
layout(push_constant) uniform Push { vec4 rectangle; vec4 color; float depth; };
layout(location = 0) out vec4 shade;
void main()
{
    const vec2 corners[6] = vec2[6](vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(0, 1), vec2(1, 0), vec2(1, 1));
    const vec2 corner = corners[gl_VertexIndex % 6];
    gl_Position = vec4(mix(rectangle.xy, rectangle.zw, corner) + vec2(0.125 * gl_InstanceIndex, 0), depth, 1);
    shade = color;
}
