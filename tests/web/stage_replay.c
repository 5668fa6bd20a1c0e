// SPDX-License-Identifier: MIT
// Draws natively what a stage of the page was told (Stage.script of web/page/stage.js), and tells the numbers of a pixel.
//   stage_replay SCRIPT PIXELS X Y    writes RGBA to PIXELS, prints the numbers' bits, 16 hexadecimal digits a line
#include "stage.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_NUMBERS = 16 };

static int width, height;

// One call. Returns whether there is one of that name and the stage took it.
static bool call(const char *name, const double *n)
{
    if (strcmp(name, "resize") == 0) {
        width = (int)n[0];
        height = (int)n[1];
        return stage_resize(width, height, (int)n[2]);
    }
    if (strcmp(name, "camera") == 0) {
        return stage_camera(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]);
    }
    if (strcmp(name, "clear") == 0) {
        stage_clear(n[0], n[1], n[2]);
        return true;
    }
    if (strcmp(name, "corner") == 0) {
        return stage_corner((int)n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]);
    }
    return strcmp(name, "triangle") == 0 && stage_triangle((int)n[0], (int)n[1], (int)n[2], (int)n[3]);
}

static bool replay(FILE *script)
{
    char line[512];
    while (fgets(line, sizeof line, script)) {
        double numbers[MOST_NUMBERS] = {0};
        char *next = line + strcspn(line, " \n");
        if (*next != '\0') {
            *next++ = '\0';
        }
        for (int i = 0; i < MOST_NUMBERS && *next != '\0'; i++) {
            numbers[i] = strtod(next, &next);
            next += strspn(next, " \n");
        }
        if (!call(line, numbers)) {
            fprintf(stderr, "stage_replay: %s: %s\n", line, stage_error());
            return false;
        }
    }
    return true;
}

static bool write_pixels(const char *path)
{
    FILE *const file = fopen(path, "wb");
    const size_t size = (size_t)width * (size_t)height * 4;
    const uint8_t *const pixels = stage_draw();
    const bool written = file && pixels && fwrite(pixels, 1, size, file) == size;
    return (!file || fclose(file) == 0) && written;
}

int main(int argc, char **argv)
{
    FILE *const script = argc == 5 ? fopen(argv[1], "r") : NULL;
    if (!script || !stage_open(1) || !replay(script) || !write_pixels(argv[2])) {
        fprintf(stderr, "stage_replay: SCRIPT PIXELS X Y\n");
        return 1;
    }
    fclose(script);
    const double *const numbers = stage_explain(atoi(argv[3]), atoi(argv[4]));
    int count = 1;
    for (const char *names = stage_number_names(); *names; names++) {
        count += *names == ',';
    }
    for (int i = 0; numbers && i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        printf("%016" PRIx64 "\n", bits);
    }
    stage_close();
    return 0;
}
