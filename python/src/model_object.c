// SPDX-License-Identifier: MIT
// Models: read from a file, or described to Python as dictionaries whose arrays stand on the model's own memory. What
// is made from arrays stands in model_make.c.
#include "memory_object.h"
#include "model_make.h"
#include "model_object.h"
#include "model_bytes.h"

#include "draw/camera/subject.h"
#include "draw/shading/color.h"

#include <stdlib.h>

struct model {
    PyObject ob_base;
    struct scene_model *model;
};

static PyTypeObject *model_type;

const struct scene_model *python_model_get(PyObject *object)
{
    if (Py_TYPE(object) == model_type) {
        return ((struct model *)object)->model;
    }
    PyErr_SetString(PyExc_TypeError, "model: must be a model");
    return NULL;
}

static void model_free(PyObject *self)
{
    scene_model_free(((struct model *)self)->model);
    python_free(self);
}

PyObject *python_model_take(struct scene_model *loaded)
{
    struct model *model = PyObject_New(struct model, model_type);
    if (model) {
        model->model = loaded;
    } else {
        scene_model_free(loaded);
    }
    return (PyObject *)model;
}

// Reading -------------------------------------------------------------------------------------------

static PyObject *load(PyObject *module, PyObject *arguments)
{
    (void)module;
    struct scene_model_options options = {.goes_on = python_work_goes_on};
    PyObject *path, *confine;
    int is_posed;
    unsigned long long memory;
    if (!PyArg_ParseTuple(arguments, "O!zpzdOIKI:load", &PyBytes_Type, &path, &options.variant, &is_posed,
                          &options.animation, &options.time, &confine, &options.seconds, &memory,
                          &options.texture_side)) {
        return NULL;
    }
    char *name, *folder = NULL;
    if (PyBytes_AsStringAndSize(path, &name, NULL) < 0 ||
        (confine != Py_None && PyBytes_AsStringAndSize(confine, &folder, NULL) < 0)) {
        return NULL; // a path has no zero byte
    }
    options.is_posed = is_posed != 0;
    options.confine = folder;
    options.memory = (size_t)memory;
    char error[512];
    struct python_work work = python_work_begin();
    options.user = &work;
    struct scene_model *model = scene_model_load(name, &options, error, sizeof error);
    PyEval_RestoreThread(work.state);
    if (PyErr_Occurred()) { // a signal's handler ended the import, perhaps when it was done
        scene_model_free(model);
        return NULL;
    }
    if (!model) {
        PyErr_Format(python_error, "%s: %s", name, error);
        return NULL;
    }
    return python_model_take(model);
}

// Bytes for other processes, as pickle has them.
static PyObject *to_bytes(PyObject *module, PyObject *self)
{
    (void)module;
    const struct scene_model *const model = python_model_get(self);
    if (!model) {
        return NULL;
    }
    size_t size = 0;
    PyThreadState *const state = PyEval_SaveThread();
    void *const bytes = scene_model_write(model, &size);
    PyEval_RestoreThread(state);
    PyObject *const object = bytes ? PyBytes_FromStringAndSize(bytes, (Py_ssize_t)size) : PyErr_NoMemory();
    free(bytes);
    return object;
}

static PyObject *from_bytes(PyObject *module, PyObject *object)
{
    (void)module;
    char *bytes, error[512];
    Py_ssize_t size;
    if (PyBytes_AsStringAndSize(object, &bytes, &size) < 0) {
        return NULL;
    }
    PyThreadState *const state = PyEval_SaveThread();
    struct scene_model *const model = scene_model_read(bytes, (size_t)size, error, sizeof error);
    PyEval_RestoreThread(state);
    if (!model) {
        PyErr_Format(PyExc_ValueError, "model: %s", error);
        return NULL;
    }
    return python_model_take(model);
}

// Describing ----------------------------------------------------------------------------------------

static PyObject *array_of(PyObject *model, const void *data, const char *type, uint32_t rows, int columns)
{
    if (!data) {
        Py_INCREF(Py_None);
        return Py_None;
    }
    return python_memory_of(model, data,
                            (struct python_shape){type, columns ? 2 : 1, {(Py_ssize_t)rows, columns}});
}

static PyObject *describe_mesh(PyObject *self, const void *element)
{
    const struct scene_mesh *const mesh = element;
    static const int corners[] = {3, 2, 1}; // of enum scene_primitive
    const uint32_t n = mesh->vertex_count;
    const int size = corners[mesh->primitive];
    return Py_BuildValue(
        "{s:s,s:i,s:I,s:N,s:N,s:N,s:N,s:N,s:N,s:N}", "name", mesh->name, "corners", size, "material",
        mesh->material, "faces",
        array_of(self, mesh->indices, "<u4", mesh->index_count / (uint32_t)size, size), "vertices",
        array_of(self, mesh->positions, "<f4", n, 3), "normals", array_of(self, mesh->normals, "<f4", n, 3),
        "tangents", array_of(self, mesh->tangents, "<f4", n, 4), "uv",
        array_of(self, mesh->uvs[0], "<f4", n, 2), "uv2", array_of(self, mesh->uvs[1], "<f4", n, 2), "colors",
        array_of(self, mesh->colors, "<f4", n, 4));
}

static PyObject *describe_material(PyObject *self, const void *element)
{
    const struct scene_material *const m = element;
    static const char *const modes[] = {"opaque", "mask", "blend"};
    static const char *const slots[SCENE_BASE_SLOTS] = {"base_color", "metallic_roughness", "normal",
                                                        "occlusion", "emissive"};
    (void)self;
    PyObject *textures = PyDict_New();
    for (int i = 0; textures && i < SCENE_BASE_SLOTS; i++) {
        PyObject *image = m->slots[i].image < 0 ? NULL : PyLong_FromLong(m->slots[i].image);
        if (image) {
            PyDict_SetItemString(textures, slots[i], image);
            Py_DECREF(image);
        }
    }
    return Py_BuildValue("{s:s,s:(ffff),s:f,s:f,s:(fff),s:s,s:f,s:N,s:N,s:N}", "name", m->name, "base_color",
                         m->base_color[0], m->base_color[1], m->base_color[2], m->base_color[3], "metallic",
                         m->metallic, "roughness", m->roughness, "emissive", m->emissive[0], m->emissive[1],
                         m->emissive[2], "alpha_mode", modes[m->alpha_mode], "alpha_cutoff", m->alpha_cutoff,
                         "unlit", PyBool_FromLong(m->unlit), "double_sided", PyBool_FromLong(m->double_sided),
                         "textures", textures);
}

static PyObject *describe_image(PyObject *self, const void *element)
{
    const struct scene_image *const image = element;
    static const char *const types[] = {"|u1", "<u2", "<f4"}; // of enum scene_image_type
    const struct python_shape shape = {
        types[image->type], 3, {(Py_ssize_t)image->height, (Py_ssize_t)image->width, 4}};
    return Py_BuildValue("{s:s,s:N,s:N}", "name", image->name, "missing", PyBool_FromLong(image->missing),
                         "texels", python_memory_of(self, image->texels, shape));
}

static PyObject *matrix_of(PyObject *model, const float *matrix)
{
    return python_memory_of(model, matrix, (struct python_shape){"<f4", 2, {4, 4}});
}

static PyObject *describe_instance(PyObject *self, const void *element)
{
    const struct scene_instance *const instance = element;
    const double *const place = instance->place;
    return Py_BuildValue("{s:s,s:I,s:I,s:N,s:(ddd)}", "name", instance->name, "mesh", instance->mesh,
                         "object", instance->object, "world", matrix_of(self, instance->world), "place",
                         place[0], place[1], place[2]);
}

static PyObject *describe_camera(PyObject *self, const void *element)
{
    const struct scene_model_camera *const c = element;
    return Py_BuildValue("{s:s,s:(ddd),s:N,s:N,s:f,s:f,s:f,s:f,s:f,s:f}", "name", c->name, "place",
                         c->place[0], c->place[1], c->place[2], "world", matrix_of(self, c->world),
                         "orthographic", PyBool_FromLong(c->orthographic), "yfov", c->yfov, "aspect",
                         c->aspect, "xmag", c->xmag, "ymag", c->ymag, "znear", c->znear, "zfar", c->zfar);
}

static PyObject *describe_light(PyObject *self, const void *element)
{
    const struct scene_model_light *const light = element;
    static const char *const types[] = {"directional", "point", "spot"};
    double place[3];
    (void)self;
    scene_exact_place(light->position, light->place, place);
    return Py_BuildValue("{s:s,s:s,s:(ddd),s:(fff),s:(fff),s:f,s:f,s:f,s:f}", "name", light->name, "type",
                         types[light->type], "position", place[0], place[1], place[2], "direction",
                         light->direction[0], light->direction[1], light->direction[2], "color",
                         light->color[0], light->color[1], light->color[2], "intensity", light->intensity,
                         "range", light->range, "inner_cos", light->inner_cos, "outer_cos", light->outer_cos);
}

static PyObject *describe_animation(PyObject *self, const void *element)
{
    const struct scene_model_animation *const animation = element;
    (void)self;
    return Py_BuildValue("{s:s,s:f}", "name", animation->name, "seconds", animation->seconds);
}

static PyObject *describe_line(PyObject *self, const void *element)
{
    (void)self;
    return PyUnicode_FromString(*(const char *const *)element);
}

typedef PyObject *describe_function(PyObject *self, const void *element);

// What the model has of one kind, as a tuple.
static PyObject *describe_all(PyObject *self, const void *elements, uint32_t count, size_t size,
                              describe_function *describe)
{
    PyObject *tuple = PyTuple_New((Py_ssize_t)count);
    for (uint32_t i = 0; tuple && i < count; i++) {
        PyObject *item = describe(self, (const char *)elements + i * size);
        if (!item) {
            Py_DECREF(tuple);
            return NULL;
        }
        PyTuple_SetItem(tuple, (Py_ssize_t)i, item);
    }
    return tuple;
}

#define ALL(name) m->name##s, m->name##_count, sizeof *m->name##s

static PyObject *describe(PyObject *module, PyObject *self)
{
    (void)module;
    const struct scene_model *m = python_model_get(self);
    if (!m) {
        return NULL;
    }
    const struct scene_box frame = scene_subject_frame(m);
    return Py_BuildValue(
        "{s:s,s:s,s:s,s:i,s:(ddd),s:(fff),s:(fff),s:(ddd),s:(ddd),s:N,s:N,s:N,s:N,s:N,s:N,s:N,s:N,s:N,s:N}",
        "path", m->path, "format", m->format, "unit", m->unit, "up", (int)m->up, "origin", m->origin[0],
        m->origin[1], m->origin[2], "bounds_min", m->bounds_min[0], m->bounds_min[1], m->bounds_min[2],
        "bounds_max", m->bounds_max[0], m->bounds_max[1], m->bounds_max[2], "frame_min", frame.low[0],
        frame.low[1], frame.low[2], "frame_max", frame.high[0], frame.high[1], frame.high[2], "meshes",
        describe_all(self, m->meshes, m->mesh_count, sizeof *m->meshes, describe_mesh), "materials",
        describe_all(self, ALL(material), describe_material), "images",
        describe_all(self, ALL(image), describe_image), "nodes",
        describe_all(self, ALL(instance), describe_instance), "cameras",
        describe_all(self, ALL(camera), describe_camera), "lights",
        describe_all(self, ALL(light), describe_light), "animations",
        describe_all(self, ALL(animation), describe_animation), "variants",
        describe_all(self, ALL(variant), describe_line), "warnings",
        describe_all(self, ALL(warning), describe_line), "unsupported",
        describe_all(self, m->unsupported, m->unsupported_count, sizeof *m->unsupported, describe_line));
}

// The light of each of the 256 codes of sRGB.
static PyObject *srgb_light(PyObject *module, PyObject *nothing)
{
    (void)module;
    (void)nothing;
    float *light = malloc(256 * sizeof *light);
    for (int code = 0; light && code < 256; code++) {
        light[code] = scene_color_decode((uint8_t)code);
    }
    return python_memory_take(light, (struct python_shape){"<f4", 1, {256}});
}

PyMethodDef python_model_functions[] = {{"load", load, METH_VARARGS, NULL},
                                        {"make", python_model_make, METH_VARARGS, NULL},
                                        {"to_bytes", to_bytes, METH_O, NULL},
                                        {"from_bytes", from_bytes, METH_O, NULL},
                                        {"describe", describe, METH_O, NULL},
                                        {"srgb_light", srgb_light, METH_NOARGS, NULL},
                                        {0}};

int python_add_models(PyObject *module)
{
    static PyType_Slot slots[] = {{Py_tp_dealloc, (void *)(uintptr_t)model_free},
                                  {Py_tp_new, (void *)(uintptr_t)python_refuse_new},
                                  {0, NULL}};
    static PyType_Spec spec = {.name = "rhw._rhw.Model",
                               .basicsize = sizeof(struct model),
                               .flags = Py_TPFLAGS_DEFAULT,
                               .slots = slots};
    model_type = python_add_type(module, "Model", &spec);
    return model_type ? 0 : -1;
}
