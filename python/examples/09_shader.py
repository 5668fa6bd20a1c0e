# SPDX-License-Identifier: MIT
"""A map in three GLSL texts: one computes the land, two draw it with lines of equal height.

usage: 09_shader.py OUT.png
"""

import sys

import numpy as np

import rhw
from rhw.pipeline import Buffer, Pass, Pipeline, Program, Texture

N, SIZE = 512, (640, 420)

LAND = """
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) buffer Corners { vec4 corners[]; };
layout(push_constant) uniform Push { int n; };

float hash(vec2 cell)
{
    uvec2 u = uvec2(ivec2(cell)) * uvec2(1597334677u, 3812015801u);
    return float((u.x ^ u.y) * 1597334677u) * (1.0 / 4294967295.0);
}

float noise(vec2 at)
{
    vec2 cell = floor(at), part = fract(at), w = part * part * (3.0 - 2.0 * part);
    return mix(mix(hash(cell), hash(cell + vec2(1, 0)), w.x),
               mix(hash(cell + vec2(0, 1)), hash(cell + vec2(1, 1)), w.x), w.y);
}

void main()
{
    vec2 at = vec2(gl_GlobalInvocationID.xy) / float(n - 1);
    float height = 0.0, weight = 0.5;
    for (float scale = 4.0; scale < 200.0; scale *= 2.03, weight *= 0.45) {
        height += weight * noise(scale * at + scale);
    }
    corners[gl_GlobalInvocationID.y * n + gl_GlobalInvocationID.x] = vec4(2.0 * at - 1.0, height, 1.0);
}
"""

VERTEX = """
layout(location = 0) in vec4 corner;
layout(location = 0) out vec3 place;
layout(push_constant) uniform Push { mat4 matrix; };

void main()
{
    place = vec3(corner.xy, max(corner.z, 0.38)); // the sea is level
    gl_Position = matrix * vec4(place.xy, 0.9 * place.z, 1.0);
}
"""

FRAGMENT = """
layout(location = 0) in vec3 place;
layout(location = 0) out vec4 color;
layout(binding = 0) uniform Look { vec3 sun; float step; };

void main()
{
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    normal *= sign(normal.z);
    vec3 land = mix(vec3(0.10, 0.19, 0.05), vec3(0.55, 0.47, 0.36), smoothstep(0.42, 0.56, place.z));
    land = mix(land, vec3(0.9), smoothstep(0.60, 0.66, place.z));
    land = place.z > 0.38 ? land : vec3(0.02, 0.09, 0.17);
    float line = abs(fract(place.z / step - 0.5) - 0.5) * step / fwidth(place.z);
    land *= place.z > 0.38 ? mix(0.45, 1.0, clamp(line, 0.0, 1.0)) : 1.0;
    color = vec4(land * (0.25 + 1.1 * max(dot(normal, normalize(sun)), 0.0)), 1.0);
}
"""


def look(eye, target, lens):
    """World to clip space: a camera at `eye`, z up, whose pictures show `lens` times the distance, half up and half down."""
    back = (eye - target) / np.linalg.norm(eye - target)
    right = np.cross([0, 0, 1], back) / np.linalg.norm(np.cross([0, 0, 1], back))
    view, projection = np.eye(4), np.zeros((4, 4))
    view[:3, :3] = right, np.cross(back, right), back
    view[:3, 3] = -view[:3, :3] @ eye
    near, far = 0.1, 10.0
    projection[0, 0], projection[1, 1] = SIZE[1] / SIZE[0] / lens, 1 / lens
    projection[2, 2:] = far / (near - far), near * far / (near - far)
    projection[3, 2] = -1
    return projection @ view


corners = Buffer((N * N, 4), np.float32)
Program(compute=LAND).dispatch((N // 8, N // 8), {"corners": corners, "n": N})

a = (np.arange(N - 1)[:, None] * N + np.arange(N - 1)).ravel()
faces = Buffer(np.concatenate([np.stack([a, a + 1, a + N], 1), np.stack([a + 1, a + N + 1, a + N], 1)]), np.uint32)
targets = {"color": Texture(SIZE)}
pipeline = Pipeline(targets, program=Program(vertex=VERTEX, fragment=FRAGMENT))
values = {"matrix": look(np.array([0.3, -2.0, 1.9]), np.array([0.03, -0.19, 0.3]), 0.47), "sun": (-0.7, 0.3, 0.6), "step": 0.02}
with Pass(targets, depth=True, clear={"color": (0.8, 0.86, 0.9, 1)}, samples=4) as draw:
    draw(pipeline, {"corner": corners}, faces, values)
rhw.write_png(sys.argv[1], targets["color"].array)
print(f"{draw.stats['triangles_in']} triangles")
