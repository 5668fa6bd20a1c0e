// SPDX-License-Identifier: MIT
// An import under way: the model under construction, its memory, and the lines for the user. Every reader writes into
// it.
//
// All of an import runs in the child process that reader_process.c starts. A reader therefore never cleans up: the end
// of the process does. A reader that cannot go on calls scene_import_fail, which sends its line to the parent and
// leaves. Large temporary arrays are freed all the same, so that peak memory stays near the model's size.
#ifndef SCENE_IMPORT_H
#define SCENE_IMPORT_H

#include <stdio.h>

#include "model.h"

/// One source of pixels: a file or bytes in memory, and what is done to the pixels after decoding. The stand-in takes
/// the place of an image that has neither.
struct scene_import_source {
    const char *file;  ///< path to read, or NULL
    const void *bytes; ///< encoded image in memory, or NULL
    size_t size;
    const char *problem; ///< why there is neither a file nor bytes
    bool height;         ///< a height map, which becomes a normal map unless it already looks like one
    /// The image whose alpha or brightness becomes the alpha of this one. −1 if there is none.
    int32_t opacity_image;
    bool is_opacity;                ///< its own alpha, if it has one, is how opaque a material is
    bool is_opaque;                 ///< its alpha says nothing, and the material blends
    bool is_skin;                   ///< a game alone says what its alpha means
    bool white;                     ///< the colour becomes white, with opacity_image
    uint32_t raw_width, raw_height; ///< size of RGBA8 texels in `bytes`; 0 if `bytes` are encoded
    /// What shines through where the image is not opaque. NULL if nothing does.
    const struct scene_import_layer *layer;
    /// What the image is made from instead of a file. NULL if it has a file or bytes.
    const struct scene_import_channels *channels;
};

/// What lies below an image with alpha: another image at the same coordinates, and a colour below that.
struct scene_import_layer {
    int32_t image;  ///< index of an image added before; −1 if there is none
    float color[3]; ///< linear
};

/// Images that become the G and B of one image of a metallic and rough surface, and the channel of each, 0..3. The
/// index is −1 if there is none.
struct scene_import_channels {
    int32_t roughness, metallic;
    int roughness_channel, metallic_channel;
};

/// What floats cannot hold of the places of a model that stands far from the origin (place.h): a matrix for each
/// element of a list. A matrix of zeros says that the model's own floats are all that there is.
struct scene_import_exact {
    double (*matrices)[16];
    uint32_t count, capacity;
};

struct scene_import;
struct scene_import_archive;
struct scene_import_folder;
struct scene_import_piece;
struct scene_hash_table;
struct system_child;
/// Fill the model from what import->model.path or import->arrays name.
typedef void scene_import_reader(struct scene_import *import);

struct scene_import {
    scene_import_reader *read;
    /// Pass on the line that says why the import cannot go on, and end the process.
    void (*leave)(struct scene_import *import, const char *line);
    const struct scene_arrays *arrays; // NULL if a file is read
    // The arrays of the model grow in place. Their capacities are below.
    struct scene_model model;
    uint32_t mesh_capacity, material_capacity, image_capacity, instance_capacity, camera_capacity,
        light_capacity, warning_capacity, unsupported_capacity, source_capacity;
    struct scene_import_source *sources; // one for each image
    uint32_t source_count;
    struct scene_hash_table *image_names; // finds images by their names (phong.c)
    /// One matrix for each mesh, instance, camera and light. That of a mesh moves its positions to where the file has
    /// them.
    struct scene_import_exact exact_meshes, exact_instances, exact_cameras, exact_lights;
    const char *name;      // name of the options, or the path of the model
    const char *ending;    // ending of the name, without its point; "" if it has none
    const char *directory; // directory of the name, with a trailing slash; "" for the current one
    const char *variant;   // variant of the options
    const char *animation; // animation of the options
    /// With `takes_number`, the number of the animation that is shown, whatever the animations are called.
    uint32_t animation_number;
    bool takes_number;
    double time; // time of the options, with is_posed
    bool is_posed, without_images;
    uint32_t texture_side; // texture_side of the options
    // The folder of the options, resolved. NULL if nothing is out of bounds.
    const char *confine;
    struct scene_progress *progress;     // progress of the options
    const char *missing;                 // why scene_import_find_file returned NULL last
    struct scene_import_folder *folders; // folders whose names were read (folder.c)
    // The archive that the model is in (archive.c). NULL if it is a file of its own.
    struct scene_import_archive *archive;
    // model.up is what is usual in the format, and the model's shape decides.
    bool up_is_open;
    // With up_is_open: nearly all programs that write the format have what is usual.
    bool up_is_agreed;
    // Positions of meshes came from a library as floats, whatever the file has.
    bool has_floats_alone;
    // Nothing in the format says which side of a surface is the front.
    bool sides_are_open;
    // Smooth normals of meshes are made across edges up to an angle of this cosine, or the usual one (smooth.c).
    bool has_creases;
    double crease_cosine;
    // Faces that share no vertices are not smooth, wherever these stand.
    bool has_own_points;
    // Looks at corners that polygons took beyond what is usual, and polygons that became fans for it (polygon.c).
    uint64_t more_looks;
    uint32_t fan_count;
    // Pieces of meshes that are not in the model yet.
    struct scene_import_piece *pieces;
    size_t piece_count, piece_capacity;
    struct system_child *child; // child that reads; its reply is what the parent gets
};

/// What the reply begins with while a library reads the file: a line of it follows.
#define SCENE_IMPORT_ENTERED "reader: "

/// Give one line to import->leave, which ends the process. Only the thread that reads may call it, and only while no
/// helper runs.
_Noreturn void scene_import_fail(struct scene_import *import, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/// Add a line to the warnings of the model, or to what is not supported, unless it is there already.
void scene_import_warn(struct scene_import *import, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void scene_import_unsupported(struct scene_import *import, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// Say that a library begins to read the file, for the line about a crash in it. With NULL, say that it has ended.
/// `more` is what may be the cause, or "".
void scene_import_enter(struct scene_import *import, const char *library, const char *more);

/// Take back all that the reply has.
void scene_import_clear_reply(struct scene_import *import);

/// Return zeroed memory for `count` elements of `size` bytes, never NULL. Fail the import if there is none.
void *scene_import_allocate(struct scene_import *import, size_t count, size_t size);
/// Return memory like scene_import_allocate that holds anything. It is for large arrays of which all is written.
void *scene_import_allocate_any(struct scene_import *import, size_t count, size_t size);
/// Make room for `needed` elements in a growing array. New elements are not zeroed.
void scene_import_reserve(struct scene_import *import, void *array, size_t *capacity, size_t needed,
                          size_t size);
/// Return a copy of at most `length` bytes as one line of valid UTF-8. Bytes that are neither become '?'.
const char *scene_import_string(struct scene_import *import, const char *text, size_t length);
/// Return the whole of a regular file. Return NULL, with a reason in `problem`, if it cannot be read. Fail the import
/// if there is no memory for it.
void *scene_import_read_file(struct scene_import *import, const char *path, size_t *size,
                             const char **problem);
/// Return the whole of a regular file, for helpers, which may not fail the import. Return NULL, with a reason in
/// `problem`, if it cannot be read. The reason is scene_import_no_memory where memory is missing.
void *scene_import_read_bytes(const char *path, size_t *size, const char **problem);
extern const char scene_import_no_memory[];
/// Return what is wrong with a file that Git LFS or git-annex put in the place of a large one. Return NULL if it is no
/// such file. A 0 follows the bytes.
const char *scene_import_pointer_problem(const void *bytes, size_t size);

// Add an element to the model. The pointer is valid until the next element of its kind is added.
struct scene_mesh *scene_import_add_mesh(struct scene_import *import);
/// The material has glTF's defaults and no textures.
struct scene_material *scene_import_add_material(struct scene_import *import);
struct scene_instance *scene_import_add_instance(struct scene_import *import);
struct scene_model_camera *scene_import_add_camera(struct scene_import *import);
struct scene_model_light *scene_import_add_light(struct scene_import *import);
/// Add an image to be decoded at the end of the import. Return its index.
int32_t scene_import_add_image(struct scene_import *import, const char *name,
                               const struct scene_import_source *source);
struct scene_texture_slot scene_import_slot_default(void);

#endif
