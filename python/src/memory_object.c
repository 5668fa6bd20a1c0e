// SPDX-License-Identifier: MIT
#include "memory_object.h"

#include "picture_memory.h"

#include <stdlib.h>

struct memory {
    PyObject ob_base;
    void *data;
    PyObject *owner; // of the memory; NULL: this object
    void *block;     // that it is freed by
    bool is_picture; // the block is of a picture
    struct python_shape shape;
};

static PyTypeObject *memory_type;

static PyObject *shape_tuple(const struct python_shape *shape)
{
    PyObject *tuple = PyTuple_New(shape->dimensions);
    for (int i = 0; tuple && i < shape->dimensions; i++) {
        PyObject *extent = PyLong_FromSsize_t(shape->extent[i]);
        if (!extent) {
            Py_DECREF(tuple);
            return NULL;
        }
        PyTuple_SetItem(tuple, i, extent);
    }
    return tuple;
}

static PyObject *array_interface(PyObject *self, void *closure)
{
    (void)closure;
    const struct memory *memory = (struct memory *)self;
    PyObject *shape = shape_tuple(&memory->shape);
    PyObject *address = PyLong_FromVoidPtr(memory->data);
    PyObject *read_only = PyBool_FromLong(memory->owner != NULL);
    if (!shape || !address || !read_only) {
        Py_XDECREF(shape);
        Py_XDECREF(address);
        Py_XDECREF(read_only);
        return NULL;
    }
    return Py_BuildValue("{s:i,s:s,s:N,s:(NN)}", "version", 3, "typestr", memory->shape.type, "shape", shape,
                         "data", address, read_only);
}

static size_t bytes_of(const struct python_shape *shape)
{
    size_t bytes = (size_t)(shape->type[2] - '0');
    for (int i = 0; i < shape->dimensions; i++) {
        bytes *= (size_t)shape->extent[i];
    }
    return bytes;
}

static void free_block(struct memory *memory)
{
    if (memory->is_picture) {
        python_picture_release(memory->block, bytes_of(&memory->shape));
    } else {
        free(memory->block);
    }
}

static void memory_free(PyObject *self)
{
    struct memory *memory = (struct memory *)self;
    if (memory->owner) {
        Py_DECREF(memory->owner);
    } else {
        free_block(memory);
    }
    python_free(self);
}

static PyObject *make(PyObject *owner, void *block, void *data, struct python_shape shape)
{
    struct memory *memory = PyObject_New(struct memory, memory_type);
    if (!memory) {
        free(block);
        return NULL;
    }
    Py_XINCREF(owner);
    memory->owner = owner;
    memory->block = block;
    memory->is_picture = false;
    memory->data = data;
    memory->shape = shape;
    return (PyObject *)memory;
}

PyObject *python_memory_take(void *data, struct python_shape shape)
{
    return data ? make(NULL, data, data, shape) : PyErr_NoMemory();
}

PyObject *python_memory_take_picture(void *data, struct python_shape shape)
{
    PyObject *memory = python_memory_take(data, shape);
    if (memory) {
        ((struct memory *)memory)->is_picture = true;
    }
    return memory;
}

PyObject *python_memory_of(PyObject *owner, const void *data, struct python_shape shape)
{
    return make(owner, NULL, (void *)(uintptr_t)data, shape);
}

// By calloc, whose large blocks are pages that are not there until they are touched.
PyObject *python_memory_aligned(size_t size, void **data)
{
    const size_t most = (size_t)PY_SSIZE_T_MAX - RHW_MEMORY_ALIGNMENT;
    unsigned char *block = size <= most ? calloc(1, size + RHW_MEMORY_ALIGNMENT) : NULL;
    if (!block) {
        return PyErr_NoMemory();
    }
    *data = block + (RHW_MEMORY_ALIGNMENT - (uintptr_t)block % RHW_MEMORY_ALIGNMENT);
    return make(NULL, block, *data, (struct python_shape){"|u1", 1, {(Py_ssize_t)size}});
}

// Arrays passed in ----------------------------------------------------------------------------------

static bool refuse(const char *name, const char *rule)
{
    PyErr_Format(PyExc_TypeError, "%s: must be %s", name, rule);
    return false;
}

// No element has more than 8 bytes: a product of extents that is larger fits no memory.
static const Py_ssize_t most_elements = PY_SSIZE_T_MAX / 8;

static bool read_shape(PyObject *shape, const char *name, struct python_array *array)
{
    const Py_ssize_t dimensions = shape && PyTuple_Check(shape) ? PyTuple_Size(shape) : -1;
    if (dimensions < 0 || dimensions > PYTHON_MAX_DIMENSIONS) {
        return refuse(name, "an array of at most five dimensions");
    }
    array->dimensions = (int)dimensions;
    array->count = 1;
    for (int i = 0; i < array->dimensions; i++) {
        array->extent[i] = PyLong_AsSsize_t(PyTuple_GetItem(shape, i));
        if (array->extent[i] < 0) {
            return PyErr_Occurred() ? false : refuse(name, "an array");
        }
        if (array->extent[i] > 0 && array->count > most_elements / array->extent[i]) {
            return refuse(name, "an array that fits the memory");
        }
        array->count *= array->extent[i];
    }
    return true;
}

// The dictionary's members are borrowed.
static bool read_interface(PyObject *interface, const char *name, const char *type,
                           struct python_array *array)
{
    if (!PyDict_Check(interface)) {
        return refuse(name, "an array");
    }
    PyObject *typestr = PyDict_GetItemString(interface, "typestr");
    PyObject *strides = PyDict_GetItemString(interface, "strides");
    PyObject *data = PyDict_GetItemString(interface, "data");
    if (!typestr || !PyUnicode_Check(typestr) || PyUnicode_CompareWithASCIIString(typestr, type) != 0) {
        PyErr_Format(PyExc_TypeError, "%s: its elements must be %s, not %S", name, type,
                     typestr ? typestr : Py_None);
        return false;
    }
    if ((strides && strides != Py_None) || !data || !PyTuple_Check(data) || PyTuple_Size(data) != 2) {
        return refuse(name, "an array whose elements lie one behind the other");
    }
    array->data = PyLong_AsVoidPtr(PyTuple_GetItem(data, 0));
    array->is_read_only = PyObject_IsTrue(PyTuple_GetItem(data, 1)) != 0;
    if (PyErr_Occurred() || !read_shape(PyDict_GetItemString(interface, "shape"), name, array)) {
        return false;
    }
    const uintptr_t element = (uintptr_t)(type[2] - '0'); // bytes: "<f4"
    return (array->data && (uintptr_t)array->data % element == 0) || array->count == 0
               ? true
               : refuse(name, "an array whose elements lie where their type may lie");
}

bool python_array_read(PyObject *object, const char *name, const char *type, struct python_array *array)
{
    *array = (struct python_array){0};
    PyObject *interface = PyObject_GetAttrString(object, "__array_interface__");
    if (!interface) {
        PyErr_Clear();
        return refuse(name, "an array");
    }
    const bool read = read_interface(interface, name, type, array);
    Py_DECREF(interface);
    return read;
}

bool python_array_read_optional(PyObject *object, const char *name, const char *type,
                                struct python_array *array)
{
    *array = (struct python_array){.is_none = true};
    return object == Py_None || python_array_read(object, name, type, array);
}

int python_add_memory(PyObject *module)
{
    static PyGetSetDef members[] = {{"__array_interface__", array_interface, NULL, NULL, NULL}, {0}};
    static PyType_Slot slots[] = {{Py_tp_dealloc, (void *)(uintptr_t)memory_free},
                                  {Py_tp_new, (void *)(uintptr_t)python_refuse_new},
                                  {Py_tp_getset, members},
                                  {Py_tp_doc, (void *)(uintptr_t) "Memory that NumPy arrays stand on."},
                                  {0, NULL}};
    static PyType_Spec spec = {.name = "rhw._rhw.Memory",
                               .basicsize = sizeof(struct memory),
                               .flags = Py_TPFLAGS_DEFAULT,
                               .slots = slots};
    memory_type = python_add_type(module, "Memory", &spec);
    return memory_type ? 0 : -1;
}
