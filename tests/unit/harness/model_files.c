// SPDX-License-Identifier: MIT
#include "model_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <dirent.h>
#include <unistd.h>

static char directory[64];

int make_directory(void **state)
{
    (void)state;
    strcpy(directory, "/tmp/rhw-test-XXXXXX");
    return mkdtemp(directory) == NULL ? -1 : 0;
}

// Remove a file, or a folder with what is in it.
static int remove_path(const char *path)
{
    if (unlink(path) == 0) {
        return 0;
    }
    DIR *const listing = opendir(path);
    if (listing == NULL) {
        return -1;
    }
    for (const struct dirent *entry = readdir(listing); entry != NULL; entry = readdir(listing)) {
        char inner[1024];
        snprintf(inner, sizeof inner, "%s/%s", path, entry->d_name);
        if (entry->d_name[0] != '.') {
            remove_path(inner);
        }
    }
    closedir(listing);
    return rmdir(path);
}

int remove_directory(void **state)
{
    (void)state;
    return remove_path(directory);
}

void remove_folder(const char *name)
{
    assert_int_equal(remove_path(path_of(name)), 0);
}

const char *path_of(const char *name)
{
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return path;
}

void write_bytes(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(path_of(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void write_text(const char *name, const char *text)
{
    write_bytes(name, text, strlen(text));
}

void write_format(const char *name, const char *format, ...)
{
    FILE *file = fopen(path_of(name), "wb");
    assert_non_null(file);
    va_list arguments;
    va_start(arguments, format);
    assert_true(vfprintf(file, format, arguments) > 0);
    va_end(arguments);
    assert_int_equal(fclose(file), 0);
}

struct scene_model *load(const char *name)
{
    char error[512] = "";
    struct scene_model *model = scene_model_load(path_of(name), NULL, error, sizeof error);
    if (model == NULL) {
        fail_msg("%s: %s", name, error);
    }
    return model;
}

struct scene_model *load_text(const char *name, const char *text)
{
    write_text(name, text);
    return load(name);
}

void expect_refused(const char *name, const char *cause)
{
    char error[512] = "";
    struct scene_model *model = scene_model_load(path_of(name), NULL, error, sizeof error);
    if (model != NULL) {
        fail_msg("%s was accepted; expected: %s", name, cause);
    }
    if (strstr(error, cause) == NULL) {
        fail_msg("%s: \"%s\" does not hold \"%s\"", name, error, cause);
    }
    if (strchr(error, '\n') != NULL) {
        fail_msg("%s: more than one line: %s", name, error);
    }
}

static void assert_same_arrays(const void *one, const void *other, size_t size)
{
    assert_int_equal(one != NULL, other != NULL);
    if (one != NULL && size > 0) {
        assert_memory_equal(one, other, size);
    }
}

void assert_same_meshes(const struct scene_model *one, const struct scene_model *other)
{
    assert_int_equal(one->mesh_count, other->mesh_count);
    for (uint32_t i = 0; i < one->mesh_count; i++) {
        const struct scene_mesh *const a = &one->meshes[i], *const b = &other->meshes[i];
        const size_t count = a->vertex_count;
        assert_int_equal(a->vertex_count, b->vertex_count);
        assert_int_equal(a->index_count, b->index_count);
        assert_same_arrays(a->indices, b->indices, a->index_count * sizeof *a->indices);
        assert_same_arrays(a->positions, b->positions, count * sizeof *a->positions);
        assert_same_arrays(a->normals, b->normals, count * sizeof *a->normals);
        assert_same_arrays(a->uvs[0], b->uvs[0], count * sizeof *a->uvs[0]);
        assert_same_arrays(a->colors, b->colors, count * sizeof *a->colors);
    }
}

bool has_warning(const struct scene_model *model, const char *part)
{
    for (uint32_t i = 0; i < model->warning_count; i++) {
        if (strstr(model->warnings[i], part) != NULL) {
            return true;
        }
    }
    return false;
}

bool is_unsupported(const struct scene_model *model, const char *part)
{
    for (uint32_t i = 0; i < model->unsupported_count; i++) {
        if (strstr(model->unsupported[i], part) != NULL) {
            return true;
        }
    }
    return false;
}

size_t read_base64(const char *text, uint8_t *bytes)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    uint32_t word = 0;
    size_t size = 0;
    for (size_t i = 0; text[i] != 0 && text[i] != '='; i++) {
        word = word << 6 | (uint32_t)(strchr(digits, text[i]) - digits);
        if (i % 4 != 0) {
            bytes[size++] = (uint8_t)(word >> (6 - 2 * (i % 4)));
        }
    }
    return size;
}

const char *data_uri(const void *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static char texts[4][16384];
    static int next;
    char *text = texts[next++ % 4], *out = text;
    const unsigned char *in = bytes;
    assert_true(size * 4 / 3 + 64 < sizeof texts[0]);
    out += sprintf(out, "data:application/octet-stream;base64,");
    for (size_t i = 0; i < size; i += 3) {
        const unsigned a = in[i], b = i + 1 < size ? in[i + 1] : 0, c = i + 2 < size ? in[i + 2] : 0;
        *out++ = digits[a >> 2];
        *out++ = digits[(a & 3) << 4 | b >> 4];
        *out++ = i + 1 < size ? digits[(b & 15) << 2 | c >> 6] : '=';
        *out++ = i + 2 < size ? digits[c & 63] : '=';
    }
    *out = 0;
    return text;
}

void assert_floats(const float *values, const float *expected, int count, float tolerance)
{
    for (int i = 0; i < count; i++) {
        if (!(fabsf(values[i] - expected[i]) <= tolerance)) {
            fail_msg("value %d is %.9g, not %.9g", i, (double)values[i], (double)expected[i]);
        }
    }
}
