// SPDX-License-Identifier: MIT
// A model in a context's memory, which draws its pictures.
#include "camera_numbers.h"
#include "context_object.h"
#include "memory_object.h"
#include "model_object.h"
#include "panorama_object.h"
#include "picture_fields.h"
#include "picture_memory.h"

#include <stdlib.h>

struct scene_object {
    PyObject ob_base;
    PyObject *context, *model; // keeps them alive
    const struct scene_model *source;
    struct python_item *item;
};

static PyTypeObject *scene_type;

static void scene_free(PyObject *self)
{
    struct scene_object *scene = (struct scene_object *)self;
    if (scene->item) {
        python_context_destroy_item(scene->context, scene->item);
    }
    Py_XDECREF(scene->context);
    Py_XDECREF(scene->model);
    python_free(self);
}

static PyObject *scene_make(PyTypeObject *type, PyObject *arguments, PyObject *keywords)
{
    (void)keywords;
    PyObject *context, *model;
    if (!PyArg_ParseTuple(arguments, "OO:Scene", &context, &model) || !python_context_check(context)) {
        return NULL;
    }
    const struct scene_model *source = python_model_get(model);
    const allocfunc allocate = (allocfunc)(uintptr_t)PyType_GetSlot(type, Py_tp_alloc);
    struct scene_object *scene = source ? (struct scene_object *)allocate(type, 0) : NULL;
    if (!scene) {
        return NULL;
    }
    Py_INCREF(context);
    Py_INCREF(model);
    scene->context = context;
    scene->model = model;
    scene->source = source;
    struct python_item *item = calloc(1, sizeof *item);
    rhw_context *handle = item ? python_context_enter(context) : NULL;
    if (!handle) {
        free(item);
        Py_DECREF(scene);
        return PyErr_Occurred() ? NULL : PyErr_NoMemory();
    }
    item->kind = PYTHON_ITEM_SCENE;
    Py_INCREF(model);
    item->kept = model; // also where the scene's end has to wait
    struct python_work work = python_work_begin();
    rhw_context_set_goes_on(handle, python_work_goes_on, &work);
    const enum rhw_result result = scene_create(handle, source, &item->id.scene);
    rhw_context_set_goes_on(handle, NULL, NULL);
    PyEval_RestoreThread(work.state);
    const bool left = python_context_leave(context, result);
    if (result == RHW_OK) {
        scene->item = item;
    } else {
        Py_DECREF(model);
        free(item);
    }
    if (!left) {
        Py_DECREF(scene);
        return NULL;
    }
    return (PyObject *)scene;
}

// Adds one picture to the dictionary, which owns it then.
static bool add_picture(PyObject *dictionary, struct scene_pictures *pictures, enum scene_output_kind kind)
{
    void *const picture = scene_picture_get(pictures, kind);
    if (!picture) {
        return true;
    }
    const int channels = scene_output_channels(kind);
    const struct python_shape shape = {
        python_output_type(kind), channels > 1 ? 3 : 2, {pictures->height, pictures->width, channels}};
    PyObject *memory = python_memory_take_picture(picture, shape);
    scene_picture_set(pictures, kind, NULL);
    const bool added = memory && PyDict_SetItemString(dictionary, scene_outputs[kind].name, memory) == 0;
    Py_XDECREF(memory);
    return added;
}

static PyObject *pictures_dictionary(struct scene_pictures *pictures)
{
    PyObject *dictionary = PyDict_New();
    bool added = dictionary != NULL;
    for (int kind = 0; added && kind < SCENE_KIND_COUNT; kind++) {
        added = add_picture(dictionary, pictures, (enum scene_output_kind)kind);
    }
    scene_pictures_free(pictures);
    if (!added) {
        Py_XDECREF(dictionary);
        return NULL;
    }
    return dictionary;
}

// Size, camera and outputs, and then what rhw/_look.py has of a view. False with an exception.
static bool read_view(const struct scene_object *scene, PyObject *arguments, struct scene_view *view,
                      PyObject **panorama)
{
    PyObject *camera;
    int interpolate, wireframe, background, lights, shadows, ground, occlusion, transparency, tone, up;
    char error[256];
    *view = (struct scene_view){.goes_on = python_work_goes_on, .allocate = python_picture_allocate};
    if (!PyArg_ParseTuple(arguments, "(ii)OIiiiiii(bbb)ipppiidOd:draw", &view->width, &view->height, &camera,
                          &view->outputs, &view->samples, &view->supersample, &up, &interpolate, &wireframe,
                          &background, &view->background_color[0], &view->background_color[1],
                          &view->background_color[2], &lights, &shadows, &ground, &occlusion, &transparency,
                          &tone, &view->exposure, panorama, &view->panorama_rotation) ||
        (*panorama != Py_None && !(view->panorama = python_panorama_get(*panorama))) ||
        !python_camera_read(camera, &view->camera) ||
        (up >= 0 && !python_is_choice(up, SCENE_AXIS_Y, SCENE_AXIS_MINUS_X, "up")) ||
        !python_is_choice(wireframe, SCENE_WIREFRAME_NONE, SCENE_WIREFRAME_PLAIN, "wireframe") ||
        !python_is_choice(background, SCENE_BACKGROUND_DEFAULT, SCENE_BACKGROUND_TRANSPARENT, "background") ||
        !python_is_choice(lights, 0, 2, "lights") ||
        !python_is_choice(tone, SCENE_TONE_NEUTRAL, SCENE_TONE_NONE, "tone")) {
        return false;
    }
    view->up = up < 0 ? scene->source->up : (enum scene_axis)up;
    view->interpolate = (enum rhw_qualifier)interpolate;
    view->wireframe = (enum scene_wireframe)wireframe;
    view->background = (enum scene_background)background;
    view->default_lights = lights > 0;
    view->no_lights = lights == 2;
    view->shadows = shadows != 0;
    view->ground = ground != 0;
    view->ambient_occlusion = occlusion != 0;
    view->transparency = (enum scene_transparency)transparency;
    view->tone = (enum scene_tone)tone;
    if (!scene_view_check(view, error, sizeof error)) {
        PyErr_SetString(PyExc_ValueError, error);
        return false;
    }
    return true;
}

// While the scene has what it made of a panorama, no other one may get its address. A draw that failed before it made
// light has left it with the older one, one that failed meanwhile with none.
static void keep_panorama(struct python_item *item, PyObject *panorama, const struct scene_view *view)
{
    const struct scene_panorama *const lit = scene_lit_by(item->id.scene);
    if (lit && lit != view->panorama) {
        return;
    }
    PyObject *const older = item->panorama;
    item->panorama = lit ? panorama : NULL;
    Py_XINCREF(item->panorama);
    Py_XDECREF(older);
}

// Returns (pictures, triangles that were rasterized).
static PyObject *draw(PyObject *self, PyObject *arguments)
{
    struct scene_object *scene = (struct scene_object *)self;
    struct scene_view view;
    PyObject *panorama;
    if (!read_view(scene, arguments, &view, &panorama) || !python_context_enter(scene->context)) {
        return NULL;
    }
    struct scene_pictures pictures;
    struct scene_draw_stats stats;
    struct python_work work = python_work_begin();
    view.user = &work;
    const enum rhw_result result = scene_draw(scene->item->id.scene, &view, &pictures, &stats);
    PyEval_RestoreThread(work.state);
    keep_panorama(scene->item, panorama, &view);
    if (!python_context_leave(scene->context, result)) {
        scene_pictures_free(&pictures);
        return NULL;
    }
    PyObject *dictionary = pictures_dictionary(&pictures);
    if (!dictionary) {
        return NULL;
    }
    return Py_BuildValue("(NK)", dictionary, (unsigned long long)stats.pipeline.triangles_rasterized);
}

int python_add_scenes(PyObject *module)
{
    static PyMethodDef methods[] = {{"draw", draw, METH_VARARGS, NULL}, {0}};
    static PyType_Slot slots[] = {{Py_tp_new, (void *)(uintptr_t)scene_make},
                                  {Py_tp_dealloc, (void *)(uintptr_t)scene_free},
                                  {Py_tp_methods, methods},
                                  {0, NULL}};
    static PyType_Spec spec = {.name = "rhw._rhw.Scene",
                               .basicsize = sizeof(struct scene_object),
                               .flags = Py_TPFLAGS_DEFAULT,
                               .slots = slots};
    scene_type = python_add_type(module, "Scene", &spec);
    return scene_type ? 0 : -1;
}
