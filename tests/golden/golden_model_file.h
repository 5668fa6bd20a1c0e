// SPDX-License-Identifier: MIT
// Models as golden scenes carry them: small files with everything decoded, so that no importer, image decoder or
// resampler of the platform stands between them and the pixels. golden_pack writes them, from any model.
//
// All numbers are little endian. The header: "RHWG", then counts of images, materials, meshes and instances.
//   image     width, height; RGB bytes
//   material  floats: base colour 4, metallic, roughness; image of the base colour or −1; alpha mode; cutoff as
//             float; 1 for double sided
//   mesh      material, vertices, indices, 1 with texture coordinates; floats: lower and upper bound of the
//             positions, of the coordinates; 16 bits of each position, between the bounds; 8 bits signed of each
//             normal; 16 bits of each coordinate; 16 bits of each index
//   instance  mesh, 16 floats of its matrix
#ifndef GOLDEN_MODEL_FILE_H
#define GOLDEN_MODEL_FILE_H

#include "model.h"

/// Ends the program where there is no such file. Lives until the program ends.
const struct scene_model *golden_model_file_read(const char *path);

/// Fills in what follows from the rest: bounds, counts of triangles, mirrored instances, names.
void golden_model_complete(struct scene_model *model);

/// `count` zeroed elements; ends the program where memory does.
void *golden_allocate(size_t count, size_t size);

#endif
