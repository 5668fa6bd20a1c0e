#version 450
// Matrices in buffers: by columns and by rows, with an index that is known only when the shader runs.
layout(local_size_x_id = 3, local_size_y_id = 4) in;
struct Inner { mat3x2 m[2]; };
layout(std140, set = 0, binding = 0) uniform Columns { mat4x3 a; mat2 b[3]; Inner inner; } columns;
layout(std140, row_major, set = 0, binding = 1) uniform Rows { mat4x3 a; mat2 b[3]; Inner inner; } rows;
layout(std430, row_major, set = 0, binding = 2) buffer Sink { mat4x3 whole; mat2 parts[3]; vec4 results[]; } sink;

void main()
{
    const int i = int(gl_LocalInvocationIndex);
    const int k = i % 4, r = i % 3, c = i % 2;
    sink.results[4 * i] = vec4(columns.a[k], columns.a[k][r]);
    sink.results[4 * i + 1] = vec4(rows.a[k], rows.a[k][r]);
    sink.results[4 * i + 2] = vec4(columns.b[r][c], rows.b[r][c]);
    sink.results[4 * i + 3] = vec4(columns.inner.m[c][r], rows.inner.m[c][r]);
    if (i == 0) {
        sink.whole = columns.a;
        sink.parts = rows.b;
        sink.parts[1][1] = vec2(gl_WorkGroupSize.xy);
    }
}
