// SPDX-License-Identifier: MIT
// Gives the program hostile files and holds it to its promises: exit status 0 or 1, within a time limit, on
// stderr warnings and at most one error line (exactly one when it fails), no file left beside what was asked
// for, and that one whole. Deterministic: the same seed makes the same files.
//
//   fuzz RHW replay PATH...                    every file below PATH as it is, images on a square as well
//   fuzz RHW mutate COUNT SEED PATH...         COUNT mutations of the files below PATH
//
// A file that breaks a promise is kept beside the working directory as crasher-N.EXT.
#define _GNU_SOURCE // memmem
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum {
    MAX_FILES = 4096,
    MAX_SEED_SIZE = 65536, // bytes; larger files are no seeds, a mutation of them says no more
    TIME_LIMIT = 30        // seconds of wall time; a sanitizer slows everything down
};

struct file {
    char path[1024];
    unsigned char *data; // seeds only
    size_t size;
};

struct fuzz {
    const char *rhw;
    char folder[64]; // everything happens in here
    struct file files[MAX_FILES];
    int file_count, runs, failures;
};

static uint64_t random_state;

static uint32_t pick(uint32_t count)
{
    uint64_t z = (random_state += UINT64_C(0x9e3779b97f4a7c15));
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (uint32_t)((z ^ (z >> 31)) % count);
}

static _Noreturn void die(const char *what, const char *name)
{
    fprintf(stderr, "fuzz: %s %s: %s\n", what, name, strerror(errno));
    exit(2);
}

static const char *extension(const char *path)
{
    const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
    return dot != NULL && (slash == NULL || dot > slash) ? dot : "";
}

static bool ends_in(const char *path, const char *const endings[])
{
    bool found = false;
    for (int i = 0; endings[i] != NULL; i++) {
        found = found || strcmp(extension(path), endings[i]) == 0;
    }
    return found;
}

static bool is_image(const char *path)
{
    static const char *const endings[] = {".png", ".ktx2", ".webp", ".dds", ".tif", ".gif", ".avif", ".jpg",
                                          ".sgi", ".rgb",  ".ppm",  ".pgm", ".tga", ".bmp", ".psd",  NULL};
    return ends_in(path, endings);
}

static bool is_panorama(const char *path)
{
    static const char *const endings[] = {".hdr", ".exr", NULL};
    return ends_in(path, endings);
}

static int compare_files(const void *a, const void *b)
{
    return strcmp(((const struct file *)a)->path, ((const struct file *)b)->path);
}

static void collect(struct fuzz *fuzz, const char *path)
{
    struct stat status;
    if (stat(path, &status) != 0) {
        die("cannot read", path);
    }
    if (S_ISREG(status.st_mode) && fuzz->file_count < MAX_FILES) {
        struct file *file = &fuzz->files[fuzz->file_count++];
        if (realpath(path, file->path) == NULL) {
            die("cannot resolve", path);
        }
        return;
    }
    DIR *folder = S_ISDIR(status.st_mode) ? opendir(path) : NULL;
    for (struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;) {
        char below[1024];
        if (entry->d_name[0] == '.' ||
            snprintf(below, sizeof below, "%s/%s", path, entry->d_name) >= (int)sizeof below) {
            continue;
        }
        collect(fuzz, below);
    }
    if (folder != NULL) {
        closedir(folder);
    }
}

static unsigned char *load(const char *path, size_t *size)
{
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) {
        die("cannot open", path);
    }
    unsigned char *data = NULL;
    size_t used = 0, room = 0;
    for (size_t got = 1; got > 0; used += got) {
        if (room - used < 65536) {
            data = realloc(data, room += 1 << 20);
        }
        got = fread(data + used, 1, room - used, stream);
    }
    fclose(stream);
    *size = used;
    return data;
}

static void save(const char *path, const void *data, size_t size)
{
    FILE *stream = fopen(path, "wb");
    if (stream == NULL || fwrite(data, 1, size, stream) != size || fclose(stream) != 0) {
        die("cannot write", path);
    }
}

// Runs the program in the working folder; its output goes to files there. Returns the exit status, or
// 128 + the signal, or −1 when it had to be stopped.
static int run(const struct fuzz *fuzz, const char *const arguments[])
{
    const pid_t child = fork();
    if (child < 0) {
        die("cannot fork for", fuzz->rhw);
    }
    if (child == 0) {
        // A group of its own: where it has to be stopped, its children are stopped with it.
        setpgid(0, 0);
        const int in = open("/dev/null", O_RDONLY),
                  out = open("../stdout", O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int err = open("../stderr", O_WRONLY | O_CREAT | O_TRUNC, 0600);
        if (in < 0 || out < 0 || err < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0) {
            _exit(125);
        }
        execv(fuzz->rhw, (char *const *)(uintptr_t)arguments);
        _exit(126);
    }
    setpgid(child, child);
    const struct timespec tick = {0, 2000000};
    struct timespec start, now;
    clock_gettime(CLOCK_MONOTONIC, &start);
    int status;
    while (waitpid(child, &status, WNOHANG) == 0) {
        clock_gettime(CLOCK_MONOTONIC, &now);
        if (now.tv_sec - start.tv_sec > TIME_LIMIT) {
            kill(-child, SIGKILL);
            waitpid(child, &status, 0);
            return -1;
        }
        nanosleep(&tick, NULL);
    }
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

// Whether a sanitizer ended the program where assimp asked for more memory than there is, which assimp bears elsewhere.
static bool is_out_of_memory(const unsigned char *text, size_t size)
{
    static const char report[] = "ERROR: AddressSanitizer: allocator is out of memory";
    return memmem(text, size, report, sizeof report - 1) != NULL &&
           memmem(text, size, "libassimp", 9) != NULL;
}

// Whether stderr is as promised for that exit status; *problem says what is not.
static bool check_messages(int status, char *problem, size_t size)
{
    size_t used;
    unsigned char *text = load("../stderr", &used);
    int errors = 0;
    bool fine = true;
    for (size_t at = 0; at < used && fine;) {
        const unsigned char *end = memchr(text + at, '\n', used - at);
        const size_t length = end != NULL ? (size_t)(end - text) - at : used - at;
        char line[512];
        snprintf(line, sizeof line, "%.*s", (int)(length < 500 ? length : 500), (const char *)text + at);
        if (strncmp(line, "rhw: ", 5) != 0 || end == NULL) {
            snprintf(problem, size, "stderr has the line \"%s\"", line);
            fine = false;
        }
        errors += strstr(line, ": warning: ") == NULL;
        at += length + 1;
    }
    const bool is_refused = is_out_of_memory(text, used);
    if (fine && errors != status) {
        snprintf(problem, size, "%d error lines with exit status %d", errors, status);
        fine = false;
    }
    free(text);
    return fine || is_refused;
}

static bool is_whole_png(const char *path)
{
    static const unsigned char magic[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static const unsigned char tail[8] = {'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    size_t size;
    unsigned char *data = load(path, &size);
    const bool whole = size > 64 && memcmp(data, magic, 8) == 0 && memcmp(data + size - 8, tail, 8) == 0;
    free(data);
    return whole;
}

// The working folder may hold the picture, if there is to be one, and nothing else.
static bool check_files(bool picture, char *problem, size_t size)
{
    DIR *folder = opendir(".");
    bool fine = true, found = false;
    for (struct dirent *entry; (entry = readdir(folder)) != NULL && fine;) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) {
            continue;
        }
        found = strcmp(entry->d_name, "out.png") == 0;
        fine = found && picture && is_whole_png("out.png");
        if (!fine) {
            snprintf(problem, size, "%s is left behind%s", entry->d_name, picture ? ", or not whole" : "");
        }
    }
    closedir(folder);
    if (fine && picture && !found) {
        snprintf(problem, size, "there is no picture");
        fine = false;
    }
    unlink("out.png");
    return fine;
}

// One run of one verb. What is named in `problem` is what was promised and not kept.
static bool check_run(struct fuzz *fuzz, const char *const arguments[], bool render, char *problem,
                      size_t size)
{
    fuzz->runs++;
    const int status = run(fuzz, arguments);
    if (status == -1) {
        snprintf(problem, size, "it takes longer than %d s", TIME_LIMIT);
    } else if (status > 1) {
        snprintf(problem, size, status > 128 ? "signal %d" : "exit status %d",
                 status > 128 ? status - 128 : status);
    }
    if (status != 0 && status != 1) {
        unlink("out.png");
        return false;
    }
    return check_messages(status, problem, size) && check_files(render && status == 0, problem, size);
}

// Whether the text of a model speaks of animations, which are then played.
static bool is_animated(const char *model)
{
    size_t size;
    unsigned char *data = load(model, &size);
    const char *const words[] = {"\"animations\"", "AnimationSet", "AnimationStack"};
    bool found = false;
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        found = found || memmem(data, size, words[i], strlen(words[i])) != NULL;
    }
    free(data);
    return found;
}

// Both verbs on one file, `rhw render` with one more option where that is not NULL, and where the file is animated also at
// a moment. False when a promise was broken.
static bool check_model(struct fuzz *fuzz, const char *model, const char *name, const char *option)
{
    const char *const info[] = {fuzz->rhw, "info", model, NULL};
    const char *render[] = {fuzz->rhw, "render",    model, "-o", "out.png", "--size",
                            "32x32",   "--threads", "2",   NULL, NULL,      NULL};
    char problem[1024] = "";
    render[9] = option;
    bool fine = check_run(fuzz, info, false, problem, sizeof problem) &&
                check_run(fuzz, render, true, problem, sizeof problem);
    if (fine && is_animated(model)) {
        render[9] = "--time=1.5";
        fine = check_run(fuzz, render, true, problem, sizeof problem);
    }
    if (fine) {
        return true;
    }
    fuzz->failures++;
    printf("%s: %s\n", name, problem);
    return false;
}

// The picture beside itself: `rhw compare` has decoders of its own.
static bool check_compare(struct fuzz *fuzz, const char *picture)
{
    const char *const compare[] = {fuzz->rhw, "compare", picture, picture, "--max-memory=512M", NULL};
    char problem[1024] = "";
    if (check_run(fuzz, compare, false, problem, sizeof problem)) {
        return true;
    }
    fuzz->failures++;
    printf("%s: compared: %s\n", picture, problem);
    return false;
}

// A square that wears the image, whose bytes tell what it is: hostile images reach the program as textures.
static bool check_image(struct fuzz *fuzz, const char *image)
{
    char material[1200];
    const int length = snprintf(material, sizeof material, "newmtl m\nmap_Kd image.png\n");
    static const char square[] =
        "mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
        "vt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n";
    size_t size;
    unsigned char *data = load(image, &size);
    save("../image.png", data, size);
    save("../square.mtl", material, (size_t)length);
    save("../square.obj", square, sizeof square - 1);
    free(data);
    const bool fine = check_model(fuzz, "../square.obj", image, NULL) &&
                      check_model(fuzz, "../square.obj", image, "--max-texture=3") &&
                      check_compare(fuzz, image);
    unlink("../image.png");
    unlink("../square.mtl");
    unlink("../square.obj");
    return fine;
}

// A square in the light of the panorama, and one that wears it.
static bool check_panorama(struct fuzz *fuzz, const char *panorama)
{
    static const char square[] = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
    char option[1200];
    snprintf(option, sizeof option, "--environment=%s", panorama);
    save("../square.obj", square, sizeof square - 1);
    const bool fine = check_model(fuzz, "../square.obj", panorama, option) && check_compare(fuzz, panorama);
    unlink("../square.obj");
    return fine && check_image(fuzz, panorama);
}

static void replay(struct fuzz *fuzz)
{
    for (int i = 0; i < fuzz->file_count; i++) {
        check_model(fuzz, fuzz->files[i].path, fuzz->files[i].path, NULL);
        if (is_panorama(fuzz->files[i].path)) {
            check_panorama(fuzz, fuzz->files[i].path);
        }
        if (is_image(fuzz->files[i].path)) {
            check_image(fuzz, fuzz->files[i].path);
        }
    }
}

// Mutations -----------------------------------------------------------------------------------------

static void flip_bytes(unsigned char *data, size_t size)
{
    for (uint32_t n = 1 + pick(8); n > 0 && size > 0; n--) {
        const uint32_t at =
            pick((uint32_t)size); // picked first: compilers choose the order within an assignment
        data[at] ^= (unsigned char)(1u << pick(8));
    }
}

// Values that sit on the edges of what readers check.
static void plant_integer(unsigned char *data, size_t size)
{
    static const uint32_t values[] = {0,          1,          0x7f,       0xff,       0x7fff,
                                      0xffff,     0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff,
                                      0x7f800000, 0x7fc00000, 0x00000100, 0x3fffffff, 0x55555556};
    const uint32_t value = values[pick(sizeof values / sizeof *values)];
    const size_t width = (size_t)1 << pick(3);
    if (size >= width) {
        memcpy(data + pick((uint32_t)(size - width + 1)), &value, width);
    }
}

// Replaces the number that stands at or after some place of a text by another one of any length.
static size_t plant_number(unsigned char *data, size_t size, size_t room)
{
    static const char *const numbers[] = {
        "-1",    "0",          "1e39",       "-1e39",        "nan",
        "inf",   "4294967295", "2147483648", "65536",        "18446744073709551616",
        "1e-46", "0.1.2",      "--3",        "999999999999", "",
        "[]",    "\"a\"",      "null"};
    size_t at = size > 0 ? pick((uint32_t)size) : 0;
    while (at < size && !isdigit(data[at])) {
        at++;
    }
    size_t end = at;
    while (end < size && (isdigit(data[end]) || data[end] == '.')) {
        end++;
    }
    const char *number = numbers[pick(sizeof numbers / sizeof *numbers)];
    const size_t length = strlen(number);
    if (at == size || size - (end - at) + length > room) {
        return size;
    }
    memmove(data + at + length, data + end, size - end);
    memcpy(data + at, number, length);
    return size - (end - at) + length;
}

static size_t cut_out(unsigned char *data, size_t size)
{
    const size_t at = pick((uint32_t)size + 1), length = pick((uint32_t)(size - at) + 1);
    memmove(data + at, data + at + length, size - at - length);
    return size - length;
}

static size_t repeat_part(unsigned char *data, size_t size, size_t room)
{
    const size_t at = pick((uint32_t)size + 1), length = pick((uint32_t)(size - at) + 1);
    if (size + length > room) {
        return size;
    }
    memmove(data + at + length, data + at, size - at);
    return size + length;
}

// The rest of another seed from the same place on.
static size_t splice_other(unsigned char *data, size_t size, const struct file *other, size_t room)
{
    const size_t at = pick((uint32_t)size + 1);
    if (at >= other->size) {
        return at;
    }
    const size_t length = other->size - at < room - at ? other->size - at : room - at;
    memcpy(data + at, other->data + at, length);
    return at + length;
}

static size_t mutate(const struct fuzz *fuzz, unsigned char *data, size_t size, size_t room)
{
    for (uint32_t n = 1 + pick(4); n > 0; n--) {
        switch (pick(7)) {
        case 0: flip_bytes(data, size); break;
        case 1: plant_integer(data, size); break;
        case 2:
        case 3: size = plant_number(data, size, room); break;
        case 4: size = cut_out(data, size); break;
        case 5: size = repeat_part(data, size, room); break;
        default: size = splice_other(data, size, &fuzz->files[pick((uint32_t)fuzz->file_count)], room);
        }
    }
    return size;
}

static void drop_large_files(struct fuzz *fuzz)
{
    int kept = 0;
    for (int i = 0; i < fuzz->file_count; i++) {
        struct file *file = &fuzz->files[i];
        file->data = load(file->path, &file->size);
        if (file->size <= MAX_SEED_SIZE && file->size > 0) {
            fuzz->files[kept++] = *file;
        } else {
            free(file->data);
        }
    }
    fuzz->file_count = kept;
}

// Files of X3D show others, which lie beside the mutated one, or are taken away at the end.
static void lay_shown_files(const struct fuzz *fuzz, bool is_end)
{
    for (int i = 0; i < fuzz->file_count; i++) {
        const struct file *file = &fuzz->files[i];
        char path[1100];
        snprintf(path, sizeof path, "..%s", strrchr(file->path, '/'));
        if (strcmp(extension(file->path), ".x3d") == 0 && is_end) {
            unlink(path);
        } else if (strcmp(extension(file->path), ".x3d") == 0) {
            save(path, file->data, file->size);
        }
    }
}

static void fuzz_models(struct fuzz *fuzz, int count)
{
    drop_large_files(fuzz);
    lay_shown_files(fuzz, false);
    if (fuzz->file_count == 0) {
        fprintf(stderr, "fuzz: no seeds\n");
        exit(2);
    }
    static unsigned char data[4 * MAX_SEED_SIZE];
    for (int i = 0; i < count; i++) {
        const struct file *seed = &fuzz->files[pick((uint32_t)fuzz->file_count)];
        memcpy(data, seed->data, seed->size);
        const size_t size = mutate(fuzz, data, seed->size, sizeof data);
        char path[64], kept[80];
        snprintf(path, sizeof path, "../model%.16s", extension(seed->path));
        save(path, data, size);
        const bool fine = is_image(path)      ? check_image(fuzz, path)
                          : is_panorama(path) ? check_panorama(fuzz, path)
                                              : check_model(fuzz, path, seed->path, NULL);
        if (!fine) {
            snprintf(kept, sizeof kept, "../../crasher-%d%.16s", i, extension(seed->path));
            save(kept, data, size);
            printf("  kept as %s\n", kept + 6);
        }
        unlink(path);
    }
    lay_shown_files(fuzz, true);
}

int main(int argc, char **argv)
{
    static struct fuzz fuzz;
    static char rhw[4096];
    const bool mutates = argc > 5 && strcmp(argv[2], "mutate") == 0;
    if (!mutates && !(argc > 3 && strcmp(argv[2], "replay") == 0)) {
        fprintf(stderr, "usage: fuzz RHW replay PATH...\n       fuzz RHW mutate COUNT SEED PATH...\n");
        return 2;
    }
    if (realpath(argv[1], rhw) == NULL) {
        die("cannot resolve", argv[1]);
    }
    fuzz.rhw = rhw;
    for (int i = mutates ? 5 : 3; i < argc; i++) {
        collect(&fuzz, argv[i]);
    }
    qsort(fuzz.files, (size_t)fuzz.file_count, sizeof *fuzz.files, compare_files);
    snprintf(fuzz.folder, sizeof fuzz.folder, "fuzz-XXXXXX");
    if (mkdtemp(fuzz.folder) == NULL || chdir(fuzz.folder) != 0 || mkdir("work", 0700) != 0 ||
        chdir("work") != 0) {
        die("cannot make", fuzz.folder);
    }
    if (mutates) {
        random_state = strtoull(argv[4], NULL, 0);
        fuzz_models(&fuzz, atoi(argv[3]));
    } else {
        replay(&fuzz);
    }
    unlink("../stdout");
    unlink("../stderr");
    if (chdir("..") != 0 || rmdir("work") != 0 || chdir("..") != 0 || rmdir(fuzz.folder) != 0) {
        printf("the working folder %s is not empty\n", fuzz.folder);
        fuzz.failures++;
    }
    printf("%d files, %d runs, %d failed\n", fuzz.file_count, fuzz.runs, fuzz.failures);
    return fuzz.failures != 0 || fuzz.runs == 0;
}
