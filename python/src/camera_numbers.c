// SPDX-License-Identifier: MIT
#include "camera_numbers.h"

#include "draw/camera/camera_frame.h"
#include "elementary.h"
#include "memory_object.h"
#include "model_object.h"

#include <stdlib.h>
#include <string.h>

static const double degree = 3.14159265358979323846 / 180.0;

bool python_camera_read(PyObject *tuple, struct scene_camera *c)
{
    int orthographic;
    *c = (struct scene_camera){0};
    if (!python_is_tuple(tuple, "camera") ||
        !PyArg_ParseTuple(tuple, "(ddd)(ddd)(ddd)pddddd(dd):camera", &c->eye[0], &c->eye[1], &c->eye[2],
                          &c->target[0], &c->target[1], &c->target[2], &c->up[0], &c->up[1], &c->up[2],
                          &orthographic, &c->yfov, &c->ymag, &c->znear, &c->zfar, &c->stretch, &c->shift[0],
                          &c->shift[1])) {
        return false;
    }
    c->orthographic = orthographic != 0;
    return true;
}

static PyObject *camera_tuple(const struct scene_camera *c)
{
    return Py_BuildValue("((ddd)(ddd)(ddd)Nddddd(dd))", c->eye[0], c->eye[1], c->eye[2], c->target[0],
                         c->target[1], c->target[2], c->up[0], c->up[1], c->up[2],
                         PyBool_FromLong(c->orthographic), c->yfov, c->ymag, c->znear, c->zfar, c->stretch,
                         c->shift[0], c->shift[1]);
}

// (model, aspect, (azimuth, elevation) or None, up or −1, whole, fovy in degrees, orthographic, zoom, margin)
static PyObject *camera_fit(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *object, *angles;
    double aspect, fovy;
    int up, whole, orthographic;
    struct scene_framing framing = {0};
    if (!PyArg_ParseTuple(arguments, "OdOipdpdd:camera_fit", &object, &aspect, &angles, &up, &whole, &fovy,
                          &orthographic, &framing.zoom, &framing.margin)) {
        return NULL;
    }
    const struct scene_model *model = python_model_get(object);
    if (!model || (up >= 0 && !python_is_choice(up, SCENE_AXIS_Y, SCENE_AXIS_MINUS_X, "up"))) {
        return NULL;
    }
    const enum scene_axis axis = up < 0 ? model->up : (enum scene_axis)up;
    if (angles == Py_None) {
        framing.orbit = scene_camera_default_orbit(model, axis);
    } else if (!python_is_tuple(angles, "orbit") ||
               !PyArg_ParseTuple(angles, "dd:orbit", &framing.orbit.azimuth, &framing.orbit.elevation)) {
        return NULL;
    } else {
        framing.orbit.azimuth += scene_camera_front(model);
    }
    framing.orbit.up = axis;
    framing.orbit.whole = whole != 0;
    framing.yfov = fovy * degree;
    framing.orthographic = orthographic != 0;
    const struct scene_camera camera = scene_camera_frame(model, &framing, aspect);
    return camera_tuple(&camera);
}

// (model, aspect, index), which the model has
static PyObject *camera_of_file(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *object;
    double aspect;
    unsigned index;
    const struct scene_model *model;
    if (!PyArg_ParseTuple(arguments, "OdI:camera_of_file", &object, &aspect, &index) ||
        !(model = python_model_get(object))) {
        return NULL;
    }
    if (index >= model->camera_count) {
        PyErr_SetString(PyExc_IndexError, "camera: the model has no such camera");
        return NULL;
    }
    const struct scene_camera camera = scene_camera_from_model(model, &model->cameras[index], aspect);
    return camera_tuple(&camera);
}

// (model, eye, target, up, fovy in degrees)
static PyObject *camera_look(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *object;
    double eye[3], target[3], up[3], fovy;
    const struct scene_model *model;
    if (!PyArg_ParseTuple(arguments, "O(ddd)(ddd)(ddd)d:camera_look", &object, &eye[0], &eye[1], &eye[2],
                          &target[0], &target[1], &target[2], &up[0], &up[1], &up[2], &fovy) ||
        !(model = python_model_get(object))) {
        return NULL;
    }
    struct scene_camera camera;
    char error[256];
    if (!scene_camera_look(&camera, model, eye, target, up, fovy * degree, error, sizeof error)) {
        PyErr_SetString(PyExc_ValueError, error);
        return NULL;
    }
    return camera_tuple(&camera);
}

// (model, camera): with near and far planes around the model
static PyObject *camera_enclose(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *object, *tuple;
    struct scene_camera camera;
    const struct scene_model *model;
    if (!PyArg_ParseTuple(arguments, "OO:camera_enclose", &object, &tuple) ||
        !(model = python_model_get(object)) || !python_camera_read(tuple, &camera)) {
        return NULL;
    }
    scene_camera_enclose(&camera, model);
    return camera_tuple(&camera);
}

// (model, camera, aspect): what this camera of the file sees, as `rhw render` judges it: "enough", "next to nothing" or
// "nothing"
static PyObject *camera_sight(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *object, *tuple;
    double aspect;
    struct scene_camera camera;
    const struct scene_model *model;
    if (!PyArg_ParseTuple(arguments, "OOd:camera_sight", &object, &tuple, &aspect) ||
        !(model = python_model_get(object)) || !python_camera_read(tuple, &camera)) {
        return NULL;
    }
    static const char *const words[] = {[SCENE_SIGHT_ENOUGH] = "enough",
                                        [SCENE_SIGHT_NEXT_TO_NOTHING] = "next to nothing",
                                        [SCENE_SIGHT_NOTHING] = "nothing"};
    return PyUnicode_FromString(words[scene_camera_sight(model, &camera, aspect)]);
}

// (model, camera, aspect): whether this camera, which was asked for, sees next to nothing
static PyObject *camera_shows_a_dot(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *object, *tuple;
    double aspect;
    struct scene_camera camera;
    const struct scene_model *model;
    if (!PyArg_ParseTuple(arguments, "OOd:camera_shows_a_dot", &object, &tuple, &aspect) ||
        !(model = python_model_get(object)) || !python_camera_read(tuple, &camera)) {
        return NULL;
    }
    return PyBool_FromLong(scene_camera_shows_a_dot(model, &camera, aspect));
}

// (camera, aspect): world to camera and camera to clip space, doubles, column major
static PyObject *camera_matrices(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *tuple;
    double aspect;
    struct scene_camera camera;
    if (!PyArg_ParseTuple(arguments, "Od:camera_matrices", &tuple, &aspect) ||
        !python_camera_read(tuple, &camera)) {
        return NULL;
    }
    double(*matrices)[16] = malloc(2 * sizeof *matrices);
    if (!matrices) {
        return PyErr_NoMemory();
    }
    scene_camera_view(&camera, matrices[0]);
    scene_camera_projection(&camera, aspect, matrices[1]);
    return python_memory_take(matrices, (struct python_shape){"<f8", 3, {2, 4, 4}});
}

// (height, fy): the angle in radians from the bottom to the top of a picture of so many rows. Python's own arc
// tangent is the C library's, which differs from machine to machine.
static PyObject *lens_angle(PyObject *module, PyObject *arguments)
{
    (void)module;
    int height;
    double fy;
    if (!PyArg_ParseTuple(arguments, "id:lens_angle", &height, &fy)) {
        return NULL;
    }
    return PyFloat_FromDouble(2.0 * scene_atan(height / (2.0 * fy)));
}

// (degrees): sine and cosine, the same on every machine too
static PyObject *sin_cos_degrees(PyObject *module, PyObject *argument)
{
    (void)module;
    const double degrees = PyFloat_AsDouble(argument);
    if (degrees == -1.0 && PyErr_Occurred()) {
        return NULL;
    }
    double sine, cosine;
    scene_sin_cos_degrees(degrees, &sine, &cosine);
    return Py_BuildValue("(dd)", sine, cosine);
}

// (up, (x, y, z)): a direction of a world with y up, as it is where another axis is up
static PyObject *axis_turn(PyObject *module, PyObject *arguments)
{
    (void)module;
    int up;
    double v[3];
    if (!PyArg_ParseTuple(arguments, "i(ddd):axis_turn", &up, &v[0], &v[1], &v[2]) ||
        !python_is_choice(up, SCENE_AXIS_Y, SCENE_AXIS_MINUS_X, "up")) {
        return NULL;
    }
    scene_axis_turn((enum scene_axis)up, v);
    return Py_BuildValue("(ddd)", v[0], v[1], v[2]);
}

PyMethodDef python_camera_functions[] = {{"camera_fit", camera_fit, METH_VARARGS, NULL},
                                         {"camera_of_file", camera_of_file, METH_VARARGS, NULL},
                                         {"camera_look", camera_look, METH_VARARGS, NULL},
                                         {"camera_enclose", camera_enclose, METH_VARARGS, NULL},
                                         {"camera_sight", camera_sight, METH_VARARGS, NULL},
                                         {"camera_shows_a_dot", camera_shows_a_dot, METH_VARARGS, NULL},
                                         {"camera_matrices", camera_matrices, METH_VARARGS, NULL},
                                         {"lens_angle", lens_angle, METH_VARARGS, NULL},
                                         {"sin_cos_degrees", sin_cos_degrees, METH_O, NULL},
                                         {"axis_turn", axis_turn, METH_VARARGS, NULL},
                                         {0}};
