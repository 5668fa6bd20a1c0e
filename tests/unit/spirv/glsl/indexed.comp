#version 450
// Arrays that indices pick from which are known only when the shader runs.
layout(local_size_x = 32) in;
layout(std430, set = 0, binding = 0) readonly buffer Source { int source[]; };
layout(std430, set = 0, binding = 1) buffer Sink { int sink[]; };

const int squares[40] = int[](0, 1, 4, 9, 16, 25, 36, 49, 64, 81, 100, 121, 144, 169, 196, 225, 256, 289, 324, 361,
    400, 441, 484, 529, 576, 625, 676, 729, 784, 841, 900, 961, 1024, 1089, 1156, 1225, 1296, 1369, 1444, 1521);
struct Pair { ivec2 a; float b[3]; };
shared int together[32];
shared Pair pairs[32];
int global_array[100];
Pair global_pairs[10];

void fill(inout int numbers[100], int from)
{
    for (int i = 0; i < 100; i++) {
        numbers[i] = (i * from) ^ i;
    }
}

int sum(in int numbers[100], int first, int step)
{
    int result = 0;
    for (int i = first; i < 100; i += step) {
        result += numbers[i];
    }
    return result;
}

void main()
{
    const uint lane = gl_LocalInvocationID.x, i = gl_GlobalInvocationID.x;
    const int given = source[i];
    // A large array of a function, given to functions.
    int numbers[100];
    fill(numbers, given);
    numbers[given * 2] = -5;
    sink[8 * i] = sum(numbers, given, 3);
    // Constants, and a small array.
    int small[4] = int[](given, 2, 3, 5);
    small[given & 3] += 100;
    sink[8 * i + 1] = squares[given] + small[0] * 1000 + small[(given + 1) & 3];
    // Arrays of the module.
    for (int k = 0; k < 100; k++) {
        global_array[(k * given) % 100] += k;
    }
    sink[8 * i + 2] = global_array[given];
    global_pairs[given % 10].b[given % 3] = 0.5;
    global_pairs[given % 10].a = ivec2(given, 3);
    sink[8 * i + 3] = global_pairs[3].a.x * 10 + int(2.0 * global_pairs[given % 10].b[(given + 1) % 3] +
        16.0 * global_pairs[given % 10].b[given % 3]);
    // Memory of the workgroup.
    together[lane] = given * given;
    pairs[lane].a[given & 1] = int(lane);
    pairs[lane].b[given % 3] = float(given);
    barrier();
    sink[8 * i + 4] = together[31 - lane];
    Pair other = pairs[(lane + 5) % 32];
    sink[8 * i + 5] = other.a.x * 100 + other.a.y * 10 + int(other.b[0] + other.b[1] + other.b[2]);
    // Matrices and vectors by column and row.
    mat4 m = mat4(1.0);
    m[given & 3][(given + 1) & 3] = 7.0;
    vec4 column = m[given & 3];
    sink[8 * i + 6] = int(column[(given + 1) & 3] * 10.0 + column[given & 3]);
    int nested[3][4][5];
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 4; b++) {
            for (int c = 0; c < 5; c++) {
                nested[a][b][c] = 100 * a + 10 * b + c;
            }
        }
    }
    sink[8 * i + 7] = nested[given % 3][given % 4][given % 5];
}
