#version 450
// Loops that count: those of which the rounds are known and whose counter picks, and those that look like them.
layout(local_size_x = 32) in;
layout(std430, set = 0, binding = 0) readonly buffer Source { int source[]; };
layout(std430, set = 0, binding = 1) buffer Sink { int sink[]; };

int find(in int numbers[9], int wanted)
{
    for (int i = 0; i < 9; i++) {
        if (numbers[i] == wanted) {
            return i;
        }
    }
    return -1;
}

int turn(int sum, int by)
{
    if (sum > 1000) {
        return sum - 7 * by;
    }
    return 3 * sum + by;
}

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    const int given = source[i];
    int numbers[9], large[24];
    // Upwards and downwards, with steps, unsigned, and in each other.
    for (int k = 0; k < 9; k++) {
        numbers[k] = given * k + 3;
    }
    int sum = 0;
    for (int k = 8; k >= 0; k -= 2) {
        sum = sum * 7 + numbers[k];
    }
    for (uint k = 1u; k != 16u; k += 3u) {
        sum ^= numbers[k & 7u] << k;
    }
    sink[8 * i] = sum;
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x <= 2; x++) {
            numbers[3 * y + x] += 10 * numbers[3 * x + y];
        }
    }
    sink[8 * i + 1] = numbers[1] + 3 * numbers[3] + 5 * numbers[8];
    // Left early, by some lanes in some rounds, and gone on with early.
    int left = 0;
    for (int k = 0; k < 9; k++) {
        if (numbers[k] % 5 == 0) {
            continue;
        }
        left += numbers[k] + k;
        if (left > 200 * (given & 3)) {
            break;
        }
    }
    sink[8 * i + 2] = left;
    sink[8 * i + 3] = find(numbers, numbers[given % 9]);
    // What lies outside is not picked where it would be; the counter is changed by what it counts, and is read behind.
    int guarded = 0, k = 0;
    for (; k < 12; k++) {
        if (k < 9) {
            guarded += numbers[k];
        }
        guarded += given > 100 ? numbers[k] : k;
    }
    sink[8 * i + 4] = guarded + k;
    int skipped = 0;
    for (int j = 0; j < 9; j++) {
        skipped += numbers[j];
        if (given % 3 == 1) {
            j++;
        }
    }
    sink[8 * i + 5] = skipped;
    // Where a lane left is known behind, beside what the test leaves with.
    int place = 0;
    for (; place < 9; place++) {
        if (numbers[place] > 30 * given) {
            break;
        }
    }
    sink[8 * i + 5] += 1000 * place;
    // More rounds than are repeated, a bound that is not constant, and none at all.
    int many = 0;
    for (int j = 0; j < 100; j++) {
        large[j % 24] = j * given;
        many += large[(j * 5) % 24 <= j ? (j * 5) % 24 : j % 24];
    }
    for (int j = 0; j < given % 9; j++) {
        many -= numbers[j];
    }
    for (int j = 9; j < 9; j++) {
        many += numbers[j];
    }
    sink[8 * i + 6] = many;
    // At least once, with a test at the end.
    int j = 0, last = 0;
    do {
        last = last * 3 + numbers[j];
    } while (++j < 9);
    // Few rounds of a counter that is no index, with a function in them, and more rounds.
    int turned = given;
    for (int k = 0; k < 4; k++) {
        turned = turn(turned, k + given);
    }
    for (int k = 0; k < 5; k++) {
        turned ^= given + k;
    }
    sink[8 * i + 7] = last + turned;
}
