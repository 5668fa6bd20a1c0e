// SPDX-License-Identifier: MIT
// Models from arrays, which rhw/model.py has brought into shape. The tuples are
//
//     mesh      (name, corners, smooth, material, vertices, normals, uv, colors, faces), arrays or None
//     material  (name, (r, g, b, a), (r, g, b) emissive, metallic, roughness, alpha mode, cutoff, unlit,
//               double sided, image)
//     image     (name, texels)
//     instance  (name, mesh, world), column major
//
// and they hold their arrays, and the bytes of names, while the model is made.
#include "model_make.h"

#include "memory_object.h"
#include "model_arrays.h"

#include <stdlib.h>
#include <string.h>

// Whether there are `count` rows of so many columns, or no array at all.
static bool has_rows(const struct python_array *array, const char *name, Py_ssize_t count, Py_ssize_t columns)
{
    if (array->is_none ||
        (array->dimensions == 2 && array->extent[0] == count && array->extent[1] == columns)) {
        return true;
    }
    PyErr_Format(PyExc_ValueError, "%s: must have the shape (%zd, %zd)", name, count, columns);
    return false;
}

static bool read_mesh(PyObject *tuple, void *element)
{
    struct scene_array_mesh *mesh = element;
    PyObject *objects[5];
    struct python_array vertices, normals, uv, colors, faces;
    int corners, smooth;
    if (!PyArg_ParseTuple(tuple, "sipIOOOOO", &mesh->name, &corners, &smooth, &mesh->material, &objects[0],
                          &objects[1], &objects[2], &objects[3], &objects[4]) ||
        !python_array_read(objects[0], "vertices", "<f8", &vertices) ||
        !python_array_read_optional(objects[1], "normals", "<f4", &normals) ||
        !python_array_read_optional(objects[2], "uv", "<f4", &uv) ||
        !python_array_read_optional(objects[3], "colors", "<f4", &colors) ||
        !python_array_read_optional(objects[4], "faces", "<u4", &faces)) {
        return false;
    }
    const Py_ssize_t count = vertices.extent[0];
    if (!has_rows(&vertices, "vertices", count, 3) || !has_rows(&normals, "normals", count, 3) ||
        !has_rows(&uv, "uv", count, 2) || !has_rows(&colors, "colors", count, 4)) {
        return false;
    }
    if (count < 1 || count > INT32_MAX || faces.count > INT32_MAX) {
        PyErr_SetString(PyExc_ValueError, "vertices, faces: none, or more than 2147483647");
        return false;
    }
    if (corners < 1 || corners > 3 || (faces.is_none ? count : faces.count) % corners != 0) {
        PyErr_SetString(PyExc_ValueError, "faces: must have 1, 2 or 3 corners each");
        return false;
    }
    mesh->primitive = corners == 3   ? SCENE_PRIMITIVE_TRIANGLES
                      : corners == 2 ? SCENE_PRIMITIVE_LINES
                                     : SCENE_PRIMITIVE_POINTS;
    mesh->shading = smooth ? SCENE_ARRAYS_SMOOTH : SCENE_ARRAYS_FLAT;
    mesh->positions = vertices.data;
    mesh->normals = normals.data;
    mesh->uvs = uv.data;
    mesh->colors = colors.data;
    mesh->indices = faces.data;
    mesh->vertex_count = (uint32_t)count;
    mesh->index_count = (uint32_t)faces.count;
    return true;
}

static bool read_material(PyObject *tuple, void *element)
{
    struct scene_array_material *m = element;
    int mode, unlit, double_sided;
    if (!PyArg_ParseTuple(tuple, "s(ffff)(fff)ffifppi", &m->name, &m->base_color[0], &m->base_color[1],
                          &m->base_color[2], &m->base_color[3], &m->emissive[0], &m->emissive[1],
                          &m->emissive[2], &m->metallic, &m->roughness, &mode, &m->alpha_cutoff, &unlit,
                          &double_sided, &m->image) ||
        !python_is_choice(mode, SCENE_ALPHA_OPAQUE, SCENE_ALPHA_BLEND, "alpha")) {
        return false;
    }
    m->alpha_mode = (enum scene_alpha_mode)mode;
    m->unlit = unlit != 0;
    m->double_sided = double_sided != 0;
    return true;
}

static bool read_image(PyObject *tuple, void *element)
{
    struct scene_array_image *image = element;
    PyObject *object;
    struct python_array texels;
    if (!PyArg_ParseTuple(tuple, "sO", &image->name, &object) ||
        !python_array_read(object, "texture", "|u1", &texels)) {
        return false;
    }
    if (texels.dimensions != 3 || texels.extent[2] != 4 || texels.count == 0 ||
        texels.extent[0] > RHW_MAX_TARGET_SIZE || texels.extent[1] > RHW_MAX_TARGET_SIZE) {
        PyErr_Format(PyExc_ValueError, "texture: must have 1 to %d rows and columns of 4 bytes",
                     RHW_MAX_TARGET_SIZE);
        return false;
    }
    image->texels = texels.data;
    image->height = (uint32_t)texels.extent[0];
    image->width = (uint32_t)texels.extent[1];
    return true;
}

static bool read_instance(PyObject *tuple, void *element)
{
    struct scene_array_instance *instance = element;
    PyObject *object;
    struct python_array world;
    if (!PyArg_ParseTuple(tuple, "sIO", &instance->name, &instance->mesh, &object) ||
        !python_array_read(object, "world", "<f8", &world) || !has_rows(&world, "world", 4, 4)) {
        return false;
    }
    memcpy(instance->world, world.data, sizeof instance->world);
    return true;
}

// One of the four kinds of elements that models are made of.
struct kind {
    const char *name;
    size_t size;
    bool (*read)(PyObject *tuple, void *element);
    uint32_t *count;
};

// An array of what the tuples say; NULL with an exception.
static void *read_all(PyObject *tuples, const struct kind *kind)
{
    const Py_ssize_t length = PyTuple_Size(tuples);
    if (length > INT32_MAX) {
        PyErr_Format(PyExc_ValueError, "%s: more than 2147483647", kind->name);
        return NULL;
    }
    char *elements = calloc((size_t)length + 1, kind->size);
    if (!elements) {
        return PyErr_NoMemory();
    }
    for (Py_ssize_t i = 0; i < length; i++) {
        PyObject *const tuple = PyTuple_GetItem(tuples, i);
        if (!python_is_tuple(tuple, kind->name) || !kind->read(tuple, elements + (size_t)i * kind->size)) {
            free(elements);
            return NULL;
        }
    }
    *kind->count = (uint32_t)length;
    return elements;
}

static PyObject *make_from(const struct scene_arrays *arrays)
{
    char error[512];
    struct python_work work = python_work_begin();
    const struct scene_model_options options = {.goes_on = python_work_goes_on, .user = &work};
    struct scene_model *model = scene_model_make(arrays, &options, error, sizeof error);
    PyEval_RestoreThread(work.state);
    if (PyErr_Occurred()) { // a signal's handler ended the import, perhaps when it was done
        scene_model_free(model);
        return NULL;
    }
    if (!model) {
        PyErr_Format(PyExc_ValueError, "%s: %s", arrays->name, error);
        return NULL;
    }
    return python_model_take(model);
}

PyObject *python_model_make(PyObject *module, PyObject *arguments)
{
    (void)module;
    struct scene_arrays arrays = {0};
    const struct kind kinds[] = {
        {"meshes", sizeof *arrays.meshes, read_mesh, &arrays.mesh_count},
        {"materials", sizeof *arrays.materials, read_material, &arrays.material_count},
        {"images", sizeof *arrays.images, read_image, &arrays.image_count},
        {"instances", sizeof *arrays.instances, read_instance, &arrays.instance_count}};
    enum { KINDS = sizeof kinds / sizeof *kinds };
    PyObject *tuples[KINDS];
    void *elements[KINDS] = {0};
    int up, count = 0;
    if (!PyArg_ParseTuple(arguments, "siO!O!O!O!:make", &arrays.name, &up, &PyTuple_Type, &tuples[0],
                          &PyTuple_Type, &tuples[1], &PyTuple_Type, &tuples[2], &PyTuple_Type, &tuples[3]) ||
        !python_is_choice(up, SCENE_AXIS_Y, SCENE_AXIS_MINUS_X, "up")) {
        return NULL;
    }
    arrays.up = (enum scene_axis)up;
    while (count < KINDS && (elements[count] = read_all(tuples[count], &kinds[count]))) {
        count++;
    }
    arrays.meshes = elements[0];
    arrays.materials = elements[1];
    arrays.images = elements[2];
    arrays.instances = elements[3];
    PyObject *model = count == KINDS ? make_from(&arrays) : NULL;
    for (int i = 0; i < KINDS; i++) {
        free(elements[i]);
    }
    return model;
}
