// SPDX-License-Identifier: MIT
// 3MF packages that a test writes.
#ifndef TEST_PACKAGE_3MF_H
#define TEST_PACKAGE_3MF_H

#include <minizip/zip.h>

#include "model_files.h"

/// A mesh of four vertices, the corners of a square.
#define MESH(triangles)                                                                                  \
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"                 \
    "<vertex x=\"0\" y=\"1\" z=\"0\"/><vertex x=\"1\" y=\"1\" z=\"0\"/></vertices><triangles>" triangles \
    "</triangles></mesh>"

zipFile package_begin(const char *name);
void package_add(zipFile zip, const char *name, const void *bytes, size_t size);
void package_add_text(zipFile zip, const char *name, const char *text);
/// Adds the relationships that name 3D/3dmodel.model.
void package_add_relationships(zipFile zip);
/// Adds a model: its resources and the items of its build.
void package_add_model(zipFile zip, const char *part, const char *resources, const char *build);
void package_end(zipFile zip);

/// Writes a package with one model.
void package_write(const char *name, const char *resources, const char *build);
/// Writes one and loads it.
struct scene_model *package_load(const char *resources, const char *build);

const struct scene_mesh *mesh_of(const struct scene_model *model, uint32_t instance);

#endif
