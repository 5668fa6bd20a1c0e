// SPDX-License-Identifier: MIT
// Model files that a test writes to a directory of its own and loads.
#ifndef TEST_MODEL_FILES_H
#define TEST_MODEL_FILES_H

#include "unit.h"

#include "model.h"

/// cmocka group setup and teardown: makes and removes the directory.
int make_directory(void **state);
int remove_directory(void **state);

/// Path of a file in the directory; valid until the next call.
const char *path_of(const char *name);
void write_bytes(const char *name, const void *bytes, size_t size);
void write_text(const char *name, const char *text);
/// Removes a folder in the directory, with what is in it.
void remove_folder(const char *name);
/// Loads a file that must load; a test fails with the importer's line.
struct scene_model *load(const char *name);
struct scene_model *load_text(const char *name, const char *text);
/// Loads a file that must not load and checks that the line holds `cause`.
void expect_refused(const char *name, const char *cause);
/// Check that two models have meshes with the same bytes.
void assert_same_meshes(const struct scene_model *one, const struct scene_model *other);
bool has_warning(const struct scene_model *model, const char *part);
bool is_unsupported(const struct scene_model *model, const char *part);

/// Writes the bytes that the text in base64 stands for, as many as it returns.
size_t read_base64(const char *text, uint8_t *bytes);
/// Bytes as a data URI; valid until the next call but three.
const char *data_uri(const void *bytes, size_t size);
/// Writes a file from a printf format.
void write_format(const char *name, const char *format, ...) __attribute__((format(printf, 2, 3)));

void assert_floats(const float *values, const float *expected, int count, float tolerance);

#endif
