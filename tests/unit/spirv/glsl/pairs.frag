#version 450
// 81 pairs of a texture and a sampler, each with coordinates of its own.
layout(set = 0, binding = 0) uniform texture2D textures[9];
layout(set = 0, binding = 1) uniform sampler samplers[9];
layout(location = 0) in vec2 at;
layout(location = 0) out vec4 target;

#define ONE(t, s) texture(sampler2D(textures[t], samplers[s]), sin(at * (t * 9.0 + s + 1.0)))
#define ROW(t) (ONE(t, 0) + ONE(t, 1) + ONE(t, 2) + ONE(t, 3) + ONE(t, 4) + ONE(t, 5) + ONE(t, 6) + ONE(t, 7) + ONE(t, 8))

void main()
{
    target = ROW(0) + ROW(1) + ROW(2) + ROW(3) + ROW(4) + ROW(5) + ROW(6) + ROW(7) + ROW(8);
}
