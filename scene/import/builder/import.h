// SPDX-License-Identifier: MIT
// An import under way: the model under construction, its memory, and the lines for the user. Every reader writes into
// it.
//
// All of it runs in the child process that reader_process.c starts. A reader therefore never cleans up: the
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
    /// Passes on the line that says why the import cannot go on, and ends the process.
    void (*leave)(struct scene_import *import, const char *line);
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

/// Gives one line to import->leave, which ends the process. Only the thread that reads may call it, and only while no
/// helper runs.
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

#endif
