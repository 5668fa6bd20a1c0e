#version 450
layout(set = 0, binding = 0) uniform sampler2D maps[18];
layout(location = 0) in vec4 value;
layout(location = 0) out vec4 target;

#define MAP(i) texture(maps[i], value.xy)
#define OTHER(i) texture(maps[i], value.zw)

void main()
{
    vec4 a = MAP(0) + 2.0 * MAP(1) + 4.0 * MAP(2) + 8.0 * MAP(3) + 16.0 * MAP(4) + 32.0 * MAP(5);
    vec4 b = OTHER(0) + 2.0 * OTHER(2) + 4.0 * OTHER(3);
    if (a.y < 6.0) {
        discard;
    }
    vec4 c = MAP(7) + 2.0 * MAP(8) + 4.0 * MAP(9) + 8.0 * MAP(10) + 16.0 * MAP(11) + 32.0 * MAP(12);
    vec4 d = OTHER(13) + 2.0 * OTHER(14) + 4.0 * OTHER(15) + 8.0 * OTHER(16) + 16.0 * MAP(17);
    target = a + 0.5 * b + 0.25 * c + 0.125 * d;
}
