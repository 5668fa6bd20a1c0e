#version 450
// Control flow of every kind, in lanes that go different ways: 11 numbers of each invocation.
layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer Source { int source[]; };
layout(std430, set = 0, binding = 1) buffer Sink { int sink[][11]; };

int at = 0;
void put(int value) { sink[gl_GlobalInvocationID.x][at++] = value; }

int collatz(int n)
{
    int steps = 0;
    while (n != 1 && steps < 200) {
        n = (n & 1) == 0 ? n / 2 : 3 * n + 1;
        steps++;
    }
    return steps;
}

int find(int x)
{
    for (int i = 0; i < 40; i++) {
        if (source[i] == x) return i;
        if (source[i] > 38) continue;
        if (i == x + 5) break;
    }
    return -1;
}

int fall(int x)
{
    int r = 0;
    switch (x % 9) {
    case 0: r += 1;
    case 1: r += 10; break;
    case 2: for (int i = 0; i < x; i++) { if (i == 7) break; r += i; }
    case 3: r += 100; if (x > 20) break; r += 1000;
    default: r += 5; break;
    case 5: return -x;
    case 6: case 7: r = 77;
    }
    return r;
}

int nested(int x)
{
    int sum = 0;
    for (int i = 0; i < 10; i++) {
        for (int j = 0; j < 10; j++) {
            if (j == x % 7) continue;
            if (i * j > x) break;
            switch (j & 3) {
            case 0: continue;
            case 1: sum += 2; break;
            default: sum += i;
            }
            sum ^= j;
        }
        if (sum > 300) return sum;
    }
    return sum + 1000;
}

int at_least_once(int x)
{
    int k = 0;
    do {
        k += 3;
        if (k == x) break;
        if (k % 2 == 0) continue;
        k++;
    } while (k < x);
    return k;
}

bool is_even_behind(inout int c) { c++; return c % 2 == 0; }

int lazy(int x)
{
    int c = x;
    if (is_even_behind(c) && is_even_behind(c) || is_even_behind(c)) c += 100;
    return c;
}

void several(in int a, out int b, inout int c)
{
    b = a + c;
    c = b * 2;
    if (a > 20) return;
    c = -c;
}

int early(int x)
{
    if (x < 10) return 1;
    if (x < 20) { if (x % 2 == 0) return 2; }
    else return 3;
    return 4;
}

void main()
{
    int x = source[gl_GlobalInvocationID.x], b, c = x, sum = 0;
    put(collatz(x + 1));
    put(find(x));
    put(fall(x));
    put(nested(x));
    put(at_least_once(x));
    put(lazy(x));
    several(x, b, c);
    put(b);
    put(c);
    put(early(x));
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            if (i == 1 && x > 3) { sum += 7; break; }
            if (x == 5) break;
            sum += i * j;
        }
    }
    put(sum);
    for (int i = x; ; i += 3) {
        if (i > 50) { sum += 1000; break; }
        sum += i;
        if (sum > 400) return; // the last number stays what it was
    }
    put(sum);
}
