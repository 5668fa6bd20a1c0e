// SPDX-License-Identifier: MIT
// The parts of the glTF 2.0 reader. It stands beside assimp's because assimp 5.2.5 loses what a correct picture
// needs: RGB vertex colours arrive with alpha 0, texture coordinates in 8 or 16 bit as NaN or rubbish, texture
// transforms folded into another convention; skins and morph weights are left to the caller. Paragraph numbers
// are those of the glTF 2.0 specification.
#ifndef SCENE_IMPORT_GLTF_H
#define SCENE_IMPORT_GLTF_H

#include <jansson.h>

#include "import/builder/import.h"

struct scene_gltf_buffer {
    const unsigned char *bytes; // NULL: not loaded yet
    size_t size;
};

/// What decompression left in the place of a buffer view, or of an accessor's data.
struct scene_gltf_decoded {
    const unsigned char *bytes; // NULL: nothing
    size_t size, stride;
    uint32_t count; // of an accessor: its elements
    int type;       // of an accessor: its componentType
};

struct scene_gltf_node {
    float world[16];
    uint32_t parent; // UINT32_MAX: a root
    bool placed;     // `world` is set
    bool in_scene, visited;
    const float *translation, *rotation, *scale,
        *weights; // where an animation has them; NULL: the node's own
    size_t weight_count;
};

/// The meshes that one glTF mesh became, one per primitive.
struct scene_gltf_meshes {
    uint32_t first, count;
    bool made;
    bool in_world; // skinned: the vertices need no matrix any more
};

struct scene_gltf {
    struct scene_import *import;
    json_t *root;
    const unsigned char *binary; // BIN chunk of a GLB
    size_t binary_size;
    struct scene_gltf_buffer *buffers;
    struct scene_gltf_decoded *views, *accessors;
    struct scene_gltf_node *nodes;
    struct scene_gltf_meshes *meshes;
    int32_t *materials; // model index by glTF index; −1: not made yet
    int32_t *images;    // the same
    int32_t default_material;
    int64_t variant; // of KHR_materials_variants; −1: none is wanted
};

// Reading JSON. What is absent gives the fallback; what has the wrong type fails the import by name.
json_t *scene_gltf_object(struct scene_gltf *gltf, const json_t *object, const char *key);   ///< or NULL
json_t *scene_gltf_array(struct scene_gltf *gltf, const json_t *object, const char *key);    ///< or NULL
const char *scene_gltf_text(struct scene_gltf *gltf, const json_t *object, const char *key); ///< or NULL
bool scene_gltf_flag(struct scene_gltf *gltf, const json_t *object, const char *key, bool fallback);
double scene_gltf_number(struct scene_gltf *gltf, const json_t *object, const char *key, double fallback);
/// A whole number of 0 .. 2^53, or `fallback` (which may be −1).
int64_t scene_gltf_integer(struct scene_gltf *gltf, const json_t *object, const char *key, int64_t fallback);
/// Exactly `count` numbers; false when the key is absent.
bool scene_gltf_floats(struct scene_gltf *gltf, const json_t *object, const char *key, float *values,
                       size_t count);
json_t *scene_gltf_extension(struct scene_gltf *gltf, const json_t *object, const char *name); ///< or NULL
/// Tells which extensions of an object are not drawn; files use some that they do not list.
void scene_gltf_note_extensions(struct scene_gltf *gltf, const json_t *object);
/// Fails the import where a file requires an extension that is not known, and tells of those it uses.
void scene_gltf_check_extensions(struct scene_gltf *gltf);
/// Name of an object as the model keeps it; "" where it has none.
const char *scene_gltf_name(struct scene_gltf *gltf, const json_t *object);
/// How many elements a top-level array has, and one of them. An index that does not exist fails the import.
size_t scene_gltf_count(struct scene_gltf *gltf, const char *list);
json_t *scene_gltf_item(struct scene_gltf *gltf, const char *list, int64_t index);

/// The bytes of a data URI, or NULL when it is none that can be read.
unsigned char *scene_gltf_data_uri(struct scene_gltf *gltf, const char *uri, size_t *size);
/// The bytes that "buffer", "byteOffset" and "byteLength" of an object name; `what` names it in messages.
const unsigned char *scene_gltf_range(struct scene_gltf *gltf, const json_t *object, const char *what,
                                      size_t *size);
/// Bytes of a buffer view, decompressed where EXT_meshopt_compression says so. `stride` 0: none is given.
const unsigned char *scene_gltf_view(struct scene_gltf *gltf, int64_t index, size_t *size, size_t *stride);
/// All elements of an accessor as floats, `width` per element. The accessor has `least` to `width` components;
/// components it lacks are 1.
float *scene_gltf_read_floats(struct scene_gltf *gltf, int64_t accessor, int least, int width,
                              uint32_t *count);
/// All elements of a scalar accessor of unsigned integers, or of a VEC4 of them with `width` 4.
uint32_t *scene_gltf_read_integers(struct scene_gltf *gltf, int64_t accessor, int width, uint32_t *count);

/// Decompresses a buffer view (EXT_meshopt_compression).
struct scene_gltf_decoded scene_gltf_meshopt(struct scene_gltf *gltf, int64_t view, const json_t *extension);
/// Decompresses a primitive (KHR_draco_mesh_compression) into the places of its accessors.
void scene_gltf_draco(struct scene_gltf *gltf, const json_t *primitive, const json_t *extension,
                      const char *what);

/// Where a textureInfo object says that an image is read; NULL: nowhere.
void scene_gltf_slot(struct scene_gltf *gltf, const json_t *info, struct scene_texture_slot *slot);
/// `value` within both; NaN: least.
float scene_gltf_limited(double value, double least, double most);
/// Limits a factor of colour and alpha to 0..10⁶ and 0..1.
void scene_gltf_limit_color(float color[4]);
/// What the extensions of a material say, after its base has been read.
void scene_gltf_layers(struct scene_gltf *gltf, const json_t *object, struct scene_material *material);
/// Model index of a material; −1 gives the default material.
uint32_t scene_gltf_material(struct scene_gltf *gltf, int64_t index);
/// The meshes of a node that stands there.
struct scene_gltf_meshes scene_gltf_mesh(struct scene_gltf *gltf, const json_t *node,
                                         const struct scene_gltf_node *place);
/// Lists the animations in the model, and sets what the one that is wanted says of the nodes.
void scene_gltf_animate(struct scene_gltf *gltf);
/// Places all nodes, then adds the instances, cameras and lights of the scene.
void scene_gltf_scene(struct scene_gltf *gltf);

#endif
