#version 450
#extension GL_EXT_spirv_intrinsics : require
// The functions of GLSL.std.450, each by its number: operands in, bits of the results out. Where GIVEN holds, the operands
// are constants of the translation.
layout(local_size_x = 64) in;
layout(constant_id = 0) const int WHICH = 0;
layout(constant_id = 1) const bool GIVEN = false;
layout(constant_id = 2) const float A = 0.0;
layout(constant_id = 3) const float B = 0.0;
layout(constant_id = 4) const float C = 0.0;
layout(set = 0, binding = 0) readonly buffer Operands { vec4 operands[]; };
layout(set = 0, binding = 1) writeonly buffer Results { uvec4 results[]; };

spirv_instruction(set = "GLSL.std.450", id = 79) float numberMin(float x, float y);
spirv_instruction(set = "GLSL.std.450", id = 80) float numberMax(float x, float y);
spirv_instruction(set = "GLSL.std.450", id = 81) float numberClamp(float x, float low, float high);

uvec4 bits(float r) { return uvec4(floatBitsToUint(r), 0, 0, 0); }
uvec4 bits(vec2 r) { return uvec4(floatBitsToUint(r), 0, 0); }
uvec4 bits(vec3 r) { return uvec4(floatBitsToUint(r), 0); }
uvec4 bits(vec4 r) { return floatBitsToUint(r); }

uvec4 math(float x, float y)
{
    switch (WHICH) {
    case 0: return bits(sin(x));
    case 1: return bits(cos(x));
    case 2: return bits(tan(x));
    case 3: return bits(asin(x));
    case 4: return bits(acos(x));
    case 5: return bits(atan(x));
    case 6: return bits(sinh(x));
    case 7: return bits(cosh(x));
    case 8: return bits(tanh(x));
    case 9: return bits(asinh(x));
    case 10: return bits(acosh(x));
    case 11: return bits(atanh(x));
    case 12: return bits(exp(x));
    case 13: return bits(log(x));
    case 14: return bits(exp2(x));
    case 15: return bits(log2(x));
    case 16: return bits(sqrt(x));
    case 17: return bits(inversesqrt(x));
    case 18: return bits(atan(x, y));
    default: return bits(pow(x, y));
    }
}

uvec4 plain(float x, float y, float z)
{
    float whole;
    int exponent;
    switch (WHICH) {
    case 20: return bits(roundEven(x));
    case 21: return bits(trunc(x));
    case 22: return bits(floor(x));
    case 23: return bits(ceil(x));
    case 24: return bits(fract(x));
    case 25: return bits(abs(x));
    case 26: return bits(sign(x));
    case 27: return bits(min(x, y));
    case 28: return bits(max(x, y));
    case 29: return bits(clamp(x, y, z));
    case 30: return bits(mix(x, y, z));
    case 31: return bits(step(x, y));
    case 32: return bits(smoothstep(x, y, z));
    case 33: return bits(fma(x, y, z));
    case 34: return bits(ldexp(x, int(y)));
    case 35: x = frexp(x, exponent); return uvec4(floatBitsToUint(x), exponent, 0, 0);
    case 36: x = modf(x, whole); return bits(vec2(x, whole));
    case 37: return bits(mod(x, y));
    case 38: return bits(mix(x, y, z > 0.5));
    case 39: return uvec4(isnan(x), isinf(x), x == y, x != y);
    case 40: return bits(radians(x));
    case 41: return bits(degrees(x));
    case 42: return bits(numberMin(x, y));
    case 43: return bits(numberMax(x, y));
    case 44: return bits(numberClamp(x, y, z));
    case 48: return bits(vec2(sin(x), cos(x)));
    case 49: return bits(vec2(cos(x), sin(x)));
    case 45: return uvec4(x < y, x <= y, x > y, x >= y);
    default: return uvec4(int(x), uint(x), floatBitsToUint(float(floatBitsToInt(x))), floatBitsToUint(float(floatBitsToUint(x))));
    }
}

uvec4 vectors(vec3 v)
{
    vec3 other = v.zxy;
    switch (WHICH) {
    case 50: return bits(length(v));
    case 51: return bits(distance(v, other));
    case 52: return bits(normalize(v));
    case 53: return bits(cross(v, other));
    case 54: return bits(faceforward(v, other, v.yzx));
    case 55: return bits(reflect(v, other));
    case 56: return bits(refract(v, other, v.x));
    case 57: return bits(dot(v, other));
    case 58: return uvec4(packUnorm4x8(v.xyzx), packSnorm4x8(v.xyzx), packUnorm2x16(v.xy), packSnorm2x16(v.xy));
    case 59: return bits(unpackUnorm4x8(floatBitsToUint(v.x)));
    case 60: return bits(unpackSnorm4x8(floatBitsToUint(v.x)));
    case 61: return bits(vec4(unpackUnorm2x16(floatBitsToUint(v.x)), unpackSnorm2x16(floatBitsToUint(v.y))));
    case 62: return bits(vec4(unpackHalf2x16(packHalf2x16(v.xy)), unpackHalf2x16(floatBitsToUint(v.z))));
    default: return bits(vec2(determinant(mat2(v.xy, v.zx)), inverse(mat2(v.xy, v.zx))[1].x));
    }
}

uvec4 whole(int x, int y, int z)
{
    uvec2 carry = uvec2(x, y), low = uvec2(y, z);
    uint more;
    int high, product;
    switch (WHICH) {
    case 70: return uvec4(findMSB(x), findLSB(x), findMSB(uint(x)), bitCount(x));
    case 71: return uvec4(bitfieldReverse(x), abs(x), sign(x), -x);
    case 72: return uvec4(bitfieldExtract(x, y & 15, z & 15), bitfieldExtract(uint(x), y & 15, z & 15),
                          bitfieldInsert(x, y, z & 15, y & 15), 0);
    case 73: return uvec4(min(x, y), max(x, y), clamp(x, min(y, z), max(y, z)), min(uint(x), uint(y)));
    case 74: return y == 0 ? uvec4(0) : uvec4(x / y, uint(x) / uint(y), uint(x) % uint(y), x - x / y * y);
    case 75: return uvec4(x << (y & 31), x >> (y & 31), uint(x) >> (y & 31), x ^ ~y);
    case 76: return uvec4(uaddCarry(uint(x), uint(y), more), more, usubBorrow(uint(x), uint(y), carry.x), carry.x);
    case 77:
        imulExtended(x, y, high, product);
        umulExtended(uint(x), uint(y), low.x, low.y);
        return uvec4(high, product, low);
    default: return uvec4(x < y, uint(x) < uint(y), x >= y, uint(x) >= uint(y));
    }
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    vec3 v;
    if (GIVEN) {
        v = vec3(A, B, C);
    } else {
        v = operands[i].xyz;
    }
    if (WHICH < 20) {
        results[i] = math(v.x, v.y);
    } else if (WHICH < 50) {
        results[i] = plain(v.x, v.y, v.z);
    } else if (WHICH < 70) {
        results[i] = vectors(v);
    } else {
        ivec3 n = floatBitsToInt(v);
        results[i] = whole(n.x, n.y, n.z);
    }
}
