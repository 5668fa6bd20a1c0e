// SPDX-License-Identifier: MIT
// The parts of the glTF 2.0 reader. It stands beside assimp's because assimp 5.2.5 loses what a correct picture needs.
// RGB vertex colours arrive with alpha 0, texture coordinates in 8 or 16 bit arrive as NaN or rubbish, and texture
// transforms arrive folded into another convention. Skins and morph weights are left to the caller. Paragraph numbers
// are those of the glTF 2.0 specification.
#ifndef SCENE_IMPORT_GLTF_H
#define SCENE_IMPORT_GLTF_H

#include <jansson.h>

#include "import/builder/place.h"

struct scene_gltf_buffer {
    const unsigned char *bytes; // NULL if not loaded yet
    size_t size;
};

/// What decompression left in the place of a buffer view, or of an accessor's data.
struct scene_gltf_decoded {
    const unsigned char *bytes; // NULL if nothing was decompressed
    size_t size, stride;
    uint32_t count; // number of elements, for an accessor
    int type;       // componentType, for an accessor
};

struct scene_gltf_node {
    struct scene_import_place world;
    uint32_t place;  ///< where it stands among the children of its parent
    uint32_t parent; // UINT32_MAX for a root
    bool placed;     // `world` is set
    bool in_scene, visited;
    // Values that an animation gives the node. NULL where the node's own hold.
    const double *translation, *rotation, *scale, *weights;
    size_t weight_count;
};

/// The meshes that one glTF mesh became, one for each primitive.
struct scene_gltf_meshes {
    uint32_t first, count;
    bool made;
    bool in_world; // the vertices need no matrix any more, as they are skinned
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
    int32_t *materials; // index in the model by index in the glTF; −1 if not made yet
    int32_t *images;    // index in the model by index in the glTF; −1 if not added yet
    int32_t default_material;
    int64_t variant; // number of the variant of KHR_materials_variants; −1 if none is wanted
};

// Read values of the JSON. A value that is absent gives the fallback, or NULL where the function has none. A value of
// the wrong type fails the import by its name.
json_t *scene_gltf_object(struct scene_gltf *gltf, const json_t *object, const char *key);
json_t *scene_gltf_array(struct scene_gltf *gltf, const json_t *object, const char *key);
const char *scene_gltf_text(struct scene_gltf *gltf, const json_t *object, const char *key);
bool scene_gltf_flag(struct scene_gltf *gltf, const json_t *object, const char *key, bool fallback);
double scene_gltf_number(struct scene_gltf *gltf, const json_t *object, const char *key, double fallback);
/// Read a whole number of 0 .. 2^53, or `fallback`, which may be −1.
int64_t scene_gltf_integer(struct scene_gltf *gltf, const json_t *object, const char *key, int64_t fallback);
/// Read exactly `count` numbers, 16 at most. Return false if the key is absent.
bool scene_gltf_numbers(struct scene_gltf *gltf, const json_t *object, const char *key, double *values,
                        size_t count);
bool scene_gltf_floats(struct scene_gltf *gltf, const json_t *object, const char *key, float *values,
                       size_t count);
/// Return the extension of this name that the object has. Return NULL if it has none.
json_t *scene_gltf_extension(struct scene_gltf *gltf, const json_t *object, const char *name);
/// Tell which extensions of an object are not drawn. Files use some that they do not list.
void scene_gltf_note_extensions(struct scene_gltf *gltf, const json_t *object);
/// Fail the import if the file requires an extension that is not known. Tell of unknown extensions that it uses.
void scene_gltf_check_extensions(struct scene_gltf *gltf);
/// Tell of properties whose names are nearly those of glTF.
void scene_gltf_tell_misspelt(struct scene_gltf *gltf);
/// Return the name of an object as the model keeps it. Return "" if it has none.
const char *scene_gltf_name(struct scene_gltf *gltf, const json_t *object);
/// Return how many elements a top-level array has, or return one of them. An index that does not exist fails the
/// import.
size_t scene_gltf_count(struct scene_gltf *gltf, const char *list);
json_t *scene_gltf_item(struct scene_gltf *gltf, const char *list, int64_t index);

/// Return the bytes that "buffer", "byteOffset" and "byteLength" of an object name. `what` names the object in
/// messages.
const unsigned char *scene_gltf_range(struct scene_gltf *gltf, const json_t *object, const char *what,
                                      size_t *size);
/// Return the bytes of a buffer view, decompressed where EXT_meshopt_compression says so. `stride` is 0 if the view
/// gives none.
const unsigned char *scene_gltf_view(struct scene_gltf *gltf, int64_t index, size_t *size, size_t *stride);
/// Read all elements of an accessor as floats, `width` for each element. The accessor has `least` to `width`
/// components. Components that it lacks are 1.
float *scene_gltf_read_floats(struct scene_gltf *gltf, int64_t accessor, int least, int width,
                              uint32_t *count);
/// Read all elements of a scalar accessor of unsigned integers, or of a VEC4 of them with `width` 4.
uint32_t *scene_gltf_read_integers(struct scene_gltf *gltf, int64_t accessor, int width, uint32_t *count);

/// Decompress a buffer view (EXT_meshopt_compression).
struct scene_gltf_decoded scene_gltf_meshopt(struct scene_gltf *gltf, int64_t view, const json_t *extension);
/// Decompress a primitive (KHR_draco_mesh_compression) into the places of its accessors.
void scene_gltf_draco(struct scene_gltf *gltf, const json_t *primitive, const json_t *extension,
                      const char *what);

/// Set where a textureInfo object says that an image is read. A NULL object leaves the slot alone.
void scene_gltf_slot(struct scene_gltf *gltf, const json_t *info, struct scene_texture_slot *slot);
/// Return `value` limited to least..most. NaN gives `least`.
float scene_gltf_limited(double value, double least, double most);
/// Limit the colour of a factor to 0..10⁶ and its alpha to 0..1.
void scene_gltf_limit_color(float color[4]);
/// Set what the extensions of a material say, after its base has been read.
void scene_gltf_layers(struct scene_gltf *gltf, const json_t *object, struct scene_material *material);
/// Return the index that a material has in the model. An index of −1 gives the default material.
uint32_t scene_gltf_material(struct scene_gltf *gltf, int64_t index);
/// Return the meshes of a node that stands at `place`.
struct scene_gltf_meshes scene_gltf_mesh(struct scene_gltf *gltf, const json_t *node,
                                         const struct scene_gltf_node *place);
/// List the animations in the model, and set what the animation that is wanted says of the nodes.
void scene_gltf_animate(struct scene_gltf *gltf);
/// Place all nodes, and add the instances, cameras and lights of the scene.
void scene_gltf_scene(struct scene_gltf *gltf);

#endif
