#version 450
// The vertex shader of lesson 20: a tube along a knot, of which every vertex is computed from its number.
layout(set = 0, binding = 0) uniform Scene {
    mat4 to_clip;
    vec4 eye, sun;
};
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;

const int ALONG = 320, AROUND = 24; // faces of the tube
const float TURN = 6.2831853, RADIUS = 0.27;

// The knot goes around the ring twice while it winds about it three times.
vec3 knot(float t)
{
    float ring = 1.0 + 0.42 * cos(3.0 * t);
    return vec3(ring * cos(2.0 * t), 0.5 * sin(3.0 * t), ring * sin(2.0 * t));
}

void main()
{
    int face = gl_VertexIndex / 6, corner = gl_VertexIndex % 6; // two triangles are a face
    int along = face / AROUND + (0x32 >> corner & 1), around = face % AROUND + (0x2c >> corner & 1);
    float t = TURN * float(along) / float(ALONG), angle = TURN * float(around) / float(AROUND);
    vec3 ahead = normalize(knot(t + 0.01) - knot(t - 0.01));
    vec3 side = normalize(cross(ahead, vec3(0.0, 1.0, 0.0)));
    normal = cos(angle) * side + sin(angle) * cross(side, ahead);
    place = knot(t) + RADIUS * normal;
    gl_Position = to_clip * vec4(place, 1.0);
}
