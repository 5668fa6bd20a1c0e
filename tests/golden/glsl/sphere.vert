#version 450
// A sphere of quads, made of the numbers of its vertices.
layout(push_constant) uniform view { mat4 clip; };
layout(location = 0) out vec3 normal;
layout(location = 1) out vec2 uv;
layout(location = 2) flat out int quad;
const int COLUMNS = 36, ROWS = 18;
const int right[6] = int[6](0, 0, 1, 1, 0, 1), down[6] = int[6](0, 1, 0, 0, 1, 1);

void main()
{
    const int corner = gl_VertexIndex % 6;
    quad = gl_VertexIndex / 6;
    uv = vec2(quad % COLUMNS + right[corner], quad / COLUMNS + down[corner]) / vec2(COLUMNS, ROWS);
    const float around = 6.2831853 * uv.x, from_pole = 3.1415927 * uv.y;
    normal = vec3(sin(from_pole) * cos(around), cos(from_pole), sin(from_pole) * sin(around));
    gl_Position = clip * vec4(normal, 1.0);
}
