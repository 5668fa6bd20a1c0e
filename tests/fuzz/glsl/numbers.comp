#version 450
layout(local_size_x = 8) in;
layout(set = 0, binding = 0) buffer Numbers { vec4 f[8]; ivec4 n[8]; uvec4 u[8]; };

void main()
{
    uint i = gl_LocalInvocationIndex;
    vec4 x = f[i];
    ivec4 k = n[i];
    uvec4 w = u[i];
    ivec4 e;
    vec4 whole;
    x = frexp(x, e) + modf(x, whole) + ldexp(x, k) + clamp(whole, vec4(0.0), vec4(1.0));
    x = sin(x) + pow(abs(x), vec4(0.5)) + atan(x, whole) + inversesqrt(x) + smoothstep(0.0, 1.0, x);
    x.xyz = cross(x.xyz, whole.xyz) + normalize(x.xyz) + reflect(x.xyz, whole.xyz) + refract(x.xyz, whole.xyz, 0.5);
    x.x += determinant(mat3(x.xyz, x.yzw, whole.xyz)) + inverse(mat2(x))[0].x + length(x) + distance(x, whole);
    k = bitfieldInsert(k, e, 3, 5) + bitfieldExtract(k, 4, 6) + findMSB(k) + findLSB(w) + bitCount(w);
    k = k / e + k % 7 + abs(k) * sign(e) + min(k, e) + ivec4(x);
    uvec4 carry, low;
    w = uaddCarry(w, uvec4(k), carry);
    umulExtended(w, carry, carry, low);
    w.x += packHalf2x16(x.xy) ^ packUnorm4x8(x) ^ packSnorm2x16(x.zw);
    w.yz = uvec2(unpackSnorm4x8(w.x).xy * 100.0);
    bvec4 less = lessThan(x, whole);
    f[i] = mix(x, whole, less);
    n[i] = any(less) ? k : ivec4(isnan(x)) + ivec4(all(less));
    u[i] = (w << 3u) | (low >> 2u) | bitfieldReverse(w);
}
