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
    if (!array->data ||
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
        !python_array_read(objects[0], "vertices", "<f4", &vertices) ||
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
    if (count > INT32_MAX || faces.count > INT32_MAX) {
        PyErr_SetString(PyExc_ValueError, "vertices, faces: more than 2147483647");
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
                          &double_sided, &m->image)) {
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
        !python_array_read(object, "world", "<f4", &world) || !has_rows(&world, "world", 4, 4)) {
        return false;
    }
    memcpy(instance->world, world.data, sizeof instance->world);
    return true;
}

// An array of what the tuples say; NULL with an exception.
static void *read_all(PyObject *tuples, size_t size, bool (*read)(PyObject *, void *), uint32_t *count)
{
    const Py_ssize_t length = PyTuple_Size(tuples);
    char *elements = length < 0 ? NULL : calloc((size_t)length + 1, size);
    if (!elements) {
        return PyErr_Occurred() ? NULL : PyErr_NoMemory();
    }
    for (Py_ssize_t i = 0; i < length; i++) {
        if (!read(PyTuple_GetItem(tuples, i), elements + (size_t)i * size)) {
            free(elements);
            return NULL;
        }
    }
    *count = (uint32_t)length;
    return elements;
}

static PyObject *make_from(const struct scene_arrays *arrays)
{
    char error[512];
    struct python_work work = {PyEval_SaveThread()};
    const struct scene_model_options options = {.goes_on = python_work_goes_on, .user = &work};
    struct scene_model *model = scene_model_make(arrays, &options, error, sizeof error);
    PyEval_RestoreThread(work.state);
    if (PyErr_Occurred()) {
        return NULL; // a signal's handler ended the import
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
    PyObject *meshes, *materials, *images, *instances;
    int up;
    if (!PyArg_ParseTuple(arguments, "siOOOO:make", &arrays.name, &up, &meshes, &materials, &images,
                          &instances)) {
        return NULL;
    }
    arrays.up = (enum scene_axis)up;
    void *const read[] = {
        read_all(meshes, sizeof *arrays.meshes, read_mesh, &arrays.mesh_count),
        read_all(materials, sizeof *arrays.materials, read_material, &arrays.material_count),
        read_all(images, sizeof *arrays.images, read_image, &arrays.image_count),
        read_all(instances, sizeof *arrays.instances, read_instance, &arrays.instance_count)};
    arrays.meshes = read[0];
    arrays.materials = read[1];
    arrays.images = read[2];
    arrays.instances = read[3];
    PyObject *model = read[0] && read[1] && read[2] && read[3] ? make_from(&arrays) : NULL;
    for (int i = 0; i < 4; i++) {
        free(read[i]);
    }
    return model;
}
