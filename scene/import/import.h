// SPDX-License-Identifier: MIT
// What the readers of model files share: the model under construction and the tools to build it.
//
// All of it runs in the child process that import_process.c starts. A reader therefore never cleans up: the
// end of the process does. What cannot go on calls scene_import_fail, which sends its line to the parent and
// leaves. Large temporary arrays are freed all the same, so that peak memory stays near the model's size.
#ifndef SCENE_IMPORT_H
#define SCENE_IMPORT_H

#include <stdio.h>

#include "model.h"

/// One pixel source: a file or bytes in memory, and what is done to the pixels after decoding.
struct scene_import_source {
    const char *file;  ///< path to read, or NULL
    const void *bytes; ///< encoded image in memory, or NULL; neither: the stand-in
    size_t size;
    const char *problem;            ///< why there is neither
    bool height;                    ///< a height map: becomes a normal map unless it already looks like one
    int32_t opacity_image;          ///< image whose alpha or brightness becomes the alpha of this one; −1
    bool white;                     ///< with opacity_image: the colour becomes white
    uint32_t raw_width, raw_height; ///< not 0: `bytes` are RGBA8 texels already
    const struct scene_import_layer
        *layer; ///< what shines through where the image is not opaque; NULL: nothing
    const struct scene_import_channels
        *channels; ///< what the image is made from, instead of a file; NULL: nothing
};

/// What lies below an image with alpha: another image at the same coordinates, and a colour below that.
struct scene_import_layer {
    int32_t image;  ///< added before; −1: none
    float color[3]; ///< linear
};

/// Images that become one of a metallic and rough surface, G and B; −1: none. And the channel of each, 0..3.
struct scene_import_channels {
    int32_t roughness, metallic;
    int roughness_channel, metallic_channel;
};

struct scene_import;
struct system_child;
/// Fills the model from what import->model.path or import->arrays name.
typedef void scene_import_reader(struct scene_import *import);

struct scene_import {
    scene_import_reader *read;
    const struct scene_arrays *arrays; // NULL: a file is read
    struct scene_model model;          // arrays grow in place; capacities below
    uint32_t mesh_capacity, material_capacity, image_capacity, instance_capacity, camera_capacity,
        light_capacity, warning_capacity, unsupported_capacity, source_capacity;
    struct scene_import_source *sources; // one per image
    uint32_t source_count;
    const char *name;      // of the options; else the path of the model
    const char *ending;    // of the name, without its point; "" where it has none
    const char *directory; // of the name, with a trailing slash; "" for the current one
    const char *variant;   // of the options
    const char *animation; // of the options
    double time;           // of the options, with is_posed
    bool is_posed, without_images;
    uint32_t texture_side;           // of the options
    const char *confine;             // of the options, resolved; NULL: nothing is out of bounds
    struct scene_progress *progress; // of the options
    const char *missing;             // why scene_import_find_file gave NULL last
    bool up_is_open;                 // model.up is what is usual in the format; the model's shape decides
    bool sides_are_open;             // nothing in the format says which side of a surface is the front
    struct system_child *child;      // that reads; its reply is what the parent gets
};

/// Sends one line to the parent and ends the process. Only the thread that reads may call it, and only while no helper runs.
_Noreturn void scene_import_fail(struct scene_import *import, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/// Adds a line to the warnings / the unsupported things of the model, once.
void scene_import_warn(struct scene_import *import, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void scene_import_unsupported(struct scene_import *import, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// Zeroed memory for `count` elements of `size` bytes; fails the import when there is none. Never NULL.
void *scene_import_allocate(struct scene_import *import, size_t count, size_t size);
/// Makes room for `needed` elements in a growing array; what is new is not zeroed.
void scene_import_reserve(struct scene_import *import, void *array, size_t *capacity, size_t needed,
                          size_t size);
/// A copy of at most `length` bytes as one line of valid UTF-8: what is neither becomes '?'.
const char *scene_import_string(struct scene_import *import, const char *text, size_t length);
/// The whole of a regular file, or NULL with a reason in `problem`; fails the import where there is no memory for it.
void *scene_import_read_file(struct scene_import *import, const char *path, size_t *size,
                             const char **problem);
/// The same for helpers: where there is no memory, that is the reason, scene_import_no_memory.
void *scene_import_read_bytes(const char *path, size_t *size, const char **problem);
extern const char scene_import_no_memory[];

// Adding to the model. The pointer is valid until the next addition of the same kind.
struct scene_mesh *scene_import_add_mesh(struct scene_import *import);
struct scene_material *scene_import_add_material(
    struct scene_import *import); ///< glTF's defaults, no textures
struct scene_instance *scene_import_add_instance(struct scene_import *import);
struct scene_model_camera *scene_import_add_camera(struct scene_import *import);
struct scene_model_light *scene_import_add_light(struct scene_import *import);
/// Adds an image to be decoded at the end of the import; returns its index.
int32_t scene_import_add_image(struct scene_import *import, const char *name,
                               const struct scene_import_source *source);
struct scene_texture_slot scene_import_slot_default(void);
/// Makes 8 bits of 16; false for images of floats.
bool scene_import_make_rgba8(struct scene_import *import, struct scene_image *image);
/// Makes an image of others that are decoded; false where none could be read.
bool scene_import_join_channels(struct scene_import *import, struct scene_image *image,
                                const struct scene_import_channels *channels);
/// Lays an image over what its source says lies below; it is opaque then.
void scene_import_lay_image(struct scene_import *import, struct scene_image *image,
                            const struct scene_import_layer *layer);

/// Reads import->model.path by the reader it is for (import/kind.c).
void scene_import_read(struct scene_import *import);
/// Runs a reader in a child process (import_process.c), as scene_model_load does.
struct scene_model *scene_import_start(const struct scene_import *import,
                                       const struct scene_model_options *options, char *error,
                                       size_t error_size);

// The readers.
bool scene_import_is_gltf(const char *path, const unsigned char *start, size_t size);
void scene_import_gltf(struct scene_import *import);
void scene_import_obj(struct scene_import *import);
bool scene_import_is_ply(const char *path, const unsigned char *start, size_t size);
void scene_import_ply(struct scene_import *import);
void scene_import_3mf(struct scene_import *import);
void scene_import_stl(struct scene_import *import);
/// Fails the import where an FBX is cut; assimp reads it.
void scene_import_check_fbx(struct scene_import *import);
void scene_import_assimp(struct scene_import *import);

/// Reads import->model.path completely. What comes out may be sent to the parent.
void scene_import_run(struct scene_import *import);

// Files (import_file.c).

/// Finds the file a model means by `name` (relative, percent-encoded, with backslashes, in other case);
/// NULL when there is none that may be read, and import->missing says why.
const char *scene_import_find_file(struct scene_import *import, const char *name);
/// Whether import->confine lets the file be read.
bool scene_import_within(const struct scene_import *import, const char *path);

// Textures (import_texture.c).

/// Decodes all images; what cannot be decoded becomes the stand-in, with a warning.
void scene_import_decode_images(struct scene_import *import);

// Meshes (import_mesh.c, import/normals.c).

/// What a file without normals means.
enum scene_import_normals {
    SCENE_IMPORT_FLAT,  ///< glTF 2.0 §3.7.2.1: one per face
    SCENE_IMPORT_SMOOTH ///< smooth, except across creases
};

/// Completes a mesh whose arrays hold what the file had: drops what is not finite and vertices nobody uses,
/// joins equal vertices if asked, makes normals and, where the material's normal map needs them, tangents.
void scene_import_complete_mesh(struct scene_import *import, uint32_t mesh, enum scene_import_normals normals,
                                bool join);
/// Gives every corner of the triangles the vertex `source[corner]`, and each such vertex its own copy.
void scene_import_gather_vertices(struct scene_import *import, struct scene_mesh *mesh,
                                  const uint32_t *source, uint32_t count);
/// `group[v]` = the lowest vertex whose position equals that of v.
uint32_t *scene_import_weld_positions(struct scene_import *import, const struct scene_mesh *mesh);
void scene_import_make_normals(struct scene_import *import, struct scene_mesh *mesh,
                               enum scene_import_normals kind);
/// Turns normals, and tangents with them, of the triangles that have normals on the side from which their corners run
/// clockwise: a surface is shaded by the side that is seen, and which that is the corners say. A vertex of such triangles
/// and of others becomes two.
void scene_import_turn_normals(struct scene_import *import, struct scene_mesh *mesh);
/// Whether some triangle of a mesh of triangles has an area.
bool scene_import_has_area(const struct scene_mesh *mesh);
void scene_import_make_tangents(struct scene_import *import, struct scene_mesh *mesh,
                                const struct scene_texture_slot *slot);

/// Cuts a polygon of 3 or more corners (indices of positions) into count − 2 triangles: places in `corners`.
void scene_import_triangulate(const float (*positions)[3], const uint32_t *corners, uint32_t count,
                              uint32_t *triangles);

/// Gives clouds of points a size and, where they have none, colours by height; last, when it is known what is up.
void scene_import_dress_points(struct scene_import *import);

// Poses (import_pose.c).

/// The number of the model's animation that is wanted, by its name, or its number where none has that name; −1: there is
/// none.
int64_t scene_import_find_animation(const struct scene_import *import);
/// Spherical linear interpolation the short way (glTF 2.0 §C.4); not made unit.
void scene_import_slerp(const float from[4], const float to[4], double part, float result[4]);
/// Scaled, then turned by a quaternion of any length, then moved.
void scene_import_compose(const float translation[3], const float rotation[4], const float scale[3],
                          float matrix[16]);

// Small mathematics (import_math.c). Matrices column major.
void scene_import_identity(float matrix[16]);
void scene_import_multiply(const float a[16], const float b[16], float product[16]); ///< may alias
void scene_import_transform(const float matrix[16], const float point[3], float result[3]);
float scene_import_determinant(const float matrix[16]); ///< of the upper 3×3
/// Decodes the sRGB transfer function.
float scene_import_from_srgb(float value);
bool scene_import_finite(const float *values, size_t count);

#endif
