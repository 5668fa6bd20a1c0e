#version 450
#extension GL_EXT_spirv_intrinsics : require
// Instructions on numbers, also those that no GLSL function is translated to: 64 words for each invocation.
layout(local_size_x = 16) in;
struct Given { ivec4 i; vec4 f; };
layout(std430, set = 0, binding = 0) readonly buffer Source { Given given[]; };
layout(std430, set = 0, binding = 1) buffer Sink { uint sink[][64]; };
layout(constant_id = 0) const int SIX = 6;
layout(constant_id = 1) const bool YES = false;
const int FOLDED = (SIX * 7 - 2) / 3 % 8 + (SIX << 2) + (YES ? 100 : 1000) + int(SIX > 5) + (~SIX & 0xff);

spirv_instruction(id = 138) int s_rem(int a, int b);
spirv_instruction(id = 139) int s_mod(int a, int b);
spirv_instruction(id = 140) float f_rem(float a, float b);
spirv_instruction(id = 141) float f_mod(float a, float b);
spirv_instruction(id = 116) float quantize(float a);
spirv_instruction(id = 83) vec4 copy(vec4 a);
spirv_instruction(id = 181) bool unordered_equal(float a, float b);
spirv_instruction(id = 182) bool ordered_not_equal(float a, float b);
spirv_instruction(id = 183) bool unordered_not_equal(float a, float b);
spirv_instruction(id = 185) bool unordered_less(float a, float b);
spirv_instruction(id = 187) bool unordered_greater(float a, float b);
spirv_instruction(id = 189) bool unordered_less_equal(float a, float b);
spirv_instruction(id = 191) bool unordered_greater_equal(float a, float b);
spirv_instruction(id = 63) void copy_memory(spirv_by_reference vec4 to, spirv_by_reference vec4 from);
spirv_instruction(id = 77) float vector_extract(vec4 a, int index);
spirv_instruction(id = 78) vec4 vector_insert(vec4 a, float part, int index);
spirv_instruction(set = "GLSL.std.450", id = 35) float modf_stored(float a, spirv_by_reference float whole);
spirv_instruction(set = "GLSL.std.450", id = 51) float frexp_stored(float a, spirv_by_reference int exponent);
spirv_instruction(set = "GLSL.std.450", id = 79) float n_min(float a, float b);
spirv_instruction(set = "GLSL.std.450", id = 80) float n_max(float a, float b);
spirv_instruction(set = "GLSL.std.450", id = 81) float n_clamp(float a, float b, float c);

uint at = 0;
void put(uint value) { sink[gl_GlobalInvocationID.x][at++] = value; }
void put(int value) { put(uint(value)); }
void put(float value) { put(floatBitsToUint(value)); }
void put(bool value) { put(value ? 1u : 0u); }

void whole_numbers(ivec4 i)
{
    put(s_rem(i.x, i.y));
    put(s_mod(i.x, i.y));
    put(bitfieldInsert(i.x, i.y, i.z & 15, i.w & 15));
    put(bitfieldExtract(i.x, i.z & 15, i.w & 15));
    put(bitfieldExtract(uint(i.x), i.z & 15, i.w & 15));
    put(bitfieldReverse(i.x));
    put(bitCount(i.x));
    put(findLSB(i.x));
    put(findMSB(i.x));
    put(findMSB(uint(i.x)));
    uint carry, borrow, high, low;
    put(uaddCarry(uint(i.x), uint(i.y), carry));
    put(carry);
    put(usubBorrow(uint(i.x), uint(i.y), borrow));
    put(borrow);
    umulExtended(uint(i.x), uint(i.y), high, low);
    put(high ^ low);
    int signed_high, signed_low;
    imulExtended(i.x, i.y, signed_high, signed_low);
    put(signed_high ^ signed_low);
    put(uint(i.x) / uint(i.y) ^ uint(i.x) % uint(i.y));
    put(i.x << (i.z & 31));
    put(i.x >> (i.z & 31));
    put(uint(i.x) >> (i.z & 31));
    put(abs(i.x) ^ sign(i.y) ^ min(i.x, i.y) ^ max(i.z, i.w));
    put(any(lessThan(i, ivec4(0))));
    put(all(greaterThanEqual(i.xyz, i.yzw)));
    put(FOLDED);
}

void floats(vec4 f, ivec4 i)
{
    put(f_rem(f.x, f.y));
    put(f_mod(f.x, f.y));
    put(quantize(f.x));
    float whole;
    put(modf_stored(f.x, whole));
    put(whole);
    int exponent;
    put(frexp_stored(f.x, exponent));
    put(exponent);
    float nan = f.w * 0.0 / 0.0;
    uint tests = 0;
    tests |= unordered_equal(f.x, nan) ? 1u : 0u;
    tests |= ordered_not_equal(f.x, nan) ? 2u : 0u;
    tests |= unordered_not_equal(f.x, nan) ? 4u : 0u;
    tests |= unordered_less(f.x, nan) ? 8u : 0u;
    tests |= unordered_greater(f.x, f.y) ? 16u : 0u;
    tests |= unordered_less_equal(f.x, f.y) ? 32u : 0u;
    tests |= unordered_greater_equal(f.x, f.x) ? 64u : 0u;
    tests |= isnan(nan) ? 128u : 0u;
    tests |= isinf(f.x / 0.0) ? 256u : 0u;
    tests |= isnan(f.x) || isinf(f.x) ? 512u : 0u;
    put(tests);
    put(n_min(nan, f.x));
    put(n_max(f.y, nan));
    put(n_clamp(f.x, -1.0, 1.0));
    put(int(f.x));
    put(uint(abs(f.x)));
    put(float(i.x));
    put(float(uint(i.x)));
}

vec4 changed(inout vec4 v, in int index)
{
    v[index] = 9.0;
    return v.wzyx;
}

void composites(vec4 f, ivec4 i)
{
    vec4 v = copy(f), other = changed(v, i.z & 3), third;
    copy_memory(third, v);
    put(dot(third, vec4(1.0, 2.0, 4.0, 8.0)) + other.y);
    put(vector_extract(f, i.w & 3));
    put(dot(vector_insert(f, -1.0, i.w & 3), vec4(1.0, 2.0, 4.0, 8.0)));
    mat3 m = mat3(f.xyz, f.yzw, vec3(1.0, 2.0, f.x));
    put(determinant(m));
    mat3 inverted = inverse(m) * m;
    put(inverted[0][0] + inverted[1][1] + inverted[2][2] + inverted[0][1] + inverted[2][0]);
    mat2x3 outer = outerProduct(f.xyz, f.zw);
    put(outer[0][2] + 2.0 * outer[1][0]);
    mat3x2 turned = transpose(outer);
    put(turned[2][1] * (f.xy * outer[0].xy).x + (turned * f.xyz).y + (f.xyz * outer).x);
    put((matrixCompMult(m, m) + m * 2.0)[1][2]);
    Given first = given[0], second = given[1], picked = i.x > 0 ? first : second;
    put(picked.i.y);
    put(mix(f, f.wzyx, greaterThan(f, vec4(0.0))).x);
}

void main()
{
    Given own = given[gl_GlobalInvocationID.x];
    whole_numbers(own.i);
    floats(own.f, own.i);
    composites(own.f, own.i);
}
