// SPDX-License-Identifier: MIT
// The interpreter's lock is released while the library draws, so a second thread may come to a context meanwhile: it
// waits for a lock of the context's own. Objects are collected on any thread, and must not wait: what cannot be
// destroyed at once is put on a list, which the turn that is under way empties at its end.
#include "context_object.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct context {
    PyObject ob_base;
    rhw_context *handle;
    PyThread_type_lock lock;
    unsigned long holder; // the thread whose turn it is, or 0
    pid_t process;        // that made it: worker threads do not live on in a fork
    struct python_item *doomed;
    char misuse[512]; // what the library said first in this turn; "" for nothing
};

static PyTypeObject *context_type;

static void note_misuse(void *user, const char *message)
{
    struct context *context = user;
    if (!context->misuse[0]) {
        snprintf(context->misuse, sizeof context->misuse, "%s", message);
    }
}

static void destroy_item(rhw_context *context, struct python_item *item)
{
    switch (item->kind) {
    case PYTHON_ITEM_BUFFER: rhw_buffer_destroy(context, item->id.buffer); break;
    case PYTHON_ITEM_TEXTURE: rhw_texture_destroy(context, item->id.texture); break;
    case PYTHON_ITEM_SAMPLER: rhw_sampler_destroy(context, item->id.sampler); break;
    case PYTHON_ITEM_PIPELINE: rhw_pipeline_destroy(context, item->id.pipeline); break;
    case PYTHON_ITEM_SCENE: scene_destroy(item->id.scene); break;
    case PYTHON_ITEM_PASS:
        rhw_pass_cancel(item->recorder ? item->recorder : context, item->id.pass);
        if (item->recorder) {
            rhw_context_destroy(item->recorder);
        }
        break;
    case PYTHON_ITEM_RECORDING: rhw_recording_destroy(item->id.recording); break;
    }
    Py_XDECREF(item->kept);
    Py_XDECREF(item->panorama);
    free(item->block);
    free(item);
}

static void end_turn(struct context *context)
{
    while (context->doomed) {
        struct python_item *item = context->doomed;
        context->doomed = item->next;
        destroy_item(context->handle, item);
    }
    context->holder = 0;
    PyThread_release_lock(context->lock);
}

void python_context_destroy_item(PyObject *object, struct python_item *item)
{
    struct context *context = (struct context *)object;
    if (context->process != getpid()) {
        return; // the memory is the parent's affair
    }
    item->next = context->doomed;
    context->doomed = item;
    if (PyThread_acquire_lock(context->lock, NOWAIT_LOCK)) {
        end_turn(context);
    }
}

bool python_context_check(PyObject *context)
{
    if (Py_TYPE(context) == context_type) {
        return true;
    }
    PyErr_SetString(PyExc_TypeError, "context: must be an rhw.Context");
    return false;
}

rhw_context *python_context_enter(PyObject *object)
{
    struct context *context = (struct context *)object;
    const unsigned long self = PyThread_get_thread_ident();
    if (context->process != getpid()) {
        PyErr_SetString(
            PyExc_RuntimeError,
            "a context does not live on in a forked process: make another, or load the model again");
        return NULL;
    }
    if (context->holder == self) {
        PyErr_SetString(PyExc_RuntimeError, "the context is drawing already, below this call");
        return NULL;
    }
    if (!PyThread_acquire_lock(context->lock, NOWAIT_LOCK)) {
        Py_BEGIN_ALLOW_THREADS PyThread_acquire_lock(context->lock, WAIT_LOCK);
        Py_END_ALLOW_THREADS
    }
    context->holder = self;
    context->misuse[0] = 0;
    return context->handle;
}

bool python_context_leave(PyObject *object, enum rhw_result result)
{
    struct context *context = (struct context *)object;
    char misuse[sizeof context->misuse];
    strcpy(misuse, context->misuse);
    end_turn(context);
    if (PyErr_Occurred()) {
        return false;
    }
    if (misuse[0]) {
        PyErr_SetString(PyExc_ValueError, misuse);
    } else if (result != RHW_OK) {
        PyErr_SetString(result == RHW_ERROR_OUT_OF_MEMORY ? PyExc_MemoryError : python_error,
                        rhw_result_string(result));
    }
    return !misuse[0] && result == RHW_OK;
}

static void context_free(PyObject *self)
{
    struct context *context = (struct context *)self;
    if (context->handle && context->process == getpid()) {
        rhw_context_destroy(context->handle);
    }
    if (context->lock) {
        PyThread_free_lock(context->lock);
    }
    python_free(self);
}

static int find_isa(const char *name)
{
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (strcmp(rhw_isa_name((enum rhw_isa)isa), name) == 0) {
            return isa;
        }
    }
    return -1;
}

static bool read_threads(PyObject *given, int *threads)
{
    PyObject *whole = PyNumber_Index(given);
    if (!whole) {
        PyErr_Clear();
        PyErr_SetString(PyExc_TypeError, "threads: must be a whole number");
        return false;
    }
    int overflow;
    const long number = PyLong_AsLongAndOverflow(whole, &overflow);
    const bool fits = !overflow && number >= 0 && number <= RHW_MAX_THREADS;
    if (fits) {
        *threads = (int)number;
    } else {
        PyErr_Format(PyExc_ValueError, "threads: must lie between 0 and %d, not %S", RHW_MAX_THREADS, whole);
    }
    Py_DECREF(whole);
    return fits;
}

static bool read_isa(PyObject *given, int *isa)
{
    PyObject *bytes = PyUnicode_Check(given) ? PyUnicode_AsUTF8String(given) : NULL;
    const char *const name = bytes ? PyBytes_AsString(bytes) : NULL;
    *isa = name ? find_isa(name) : -1;
    const bool there = *isa >= 0 && rhw_isa_supported((enum rhw_isa) * isa);
    if (!there) {
        PyErr_Clear(); // of a text that is none in UTF-8
        PyErr_Format(name ? PyExc_ValueError : PyExc_TypeError,
                     name ? "isa: this computer or this build has no %.99s"
                          : "isa: must be a str, of those that Context names",
                     name);
    }
    Py_XDECREF(bytes);
    return there;
}

static PyObject *context_make(PyTypeObject *type, PyObject *arguments, PyObject *keywords)
{
    static char *names[] = {"threads", "isa", NULL};
    PyObject *threads_given = NULL, *isa_given = NULL;
    int threads = 0, isa = RHW_ISA_COUNT;
    if (!PyArg_ParseTupleAndKeywords(arguments, keywords, "|OO:Context", names, &threads_given, &isa_given) ||
        (threads_given && !read_threads(threads_given, &threads)) ||
        (isa_given && isa_given != Py_None && !read_isa(isa_given, &isa))) {
        return NULL;
    }
    const allocfunc allocate = (allocfunc)(uintptr_t)PyType_GetSlot(type, Py_tp_alloc);
    struct context *context = (struct context *)allocate(type, 0);
    if (!context) {
        return NULL;
    }
    context->process = getpid();
    context->lock = PyThread_allocate_lock();
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.isa_limit = rhw_isa_up_to((enum rhw_isa)isa);
    def.assert_ = note_misuse;
    def.user = context;
    def.validate = RHW_VALIDATE_OFF; // the shaders are ours, or translated so that no access goes astray
    const enum rhw_result result =
        context->lock ? rhw_context_create(&def, &context->handle) : RHW_ERROR_OUT_OF_MEMORY;
    if (result != RHW_OK) {
        PyErr_SetString(python_error, rhw_result_string(result));
        Py_DECREF(context);
        return NULL;
    }
    return (PyObject *)context;
}

static PyObject *get_threads(PyObject *self, void *closure)
{
    (void)closure;
    return PyLong_FromLong(rhw_context_threads(((struct context *)self)->handle));
}

static PyObject *get_isa(PyObject *self, void *closure)
{
    (void)closure;
    return PyUnicode_FromString(rhw_isa_name(rhw_context_isa(((struct context *)self)->handle)));
}

int python_add_contexts(PyObject *module)
{
    static PyGetSetDef members[] = {
        {"threads", get_threads, NULL, "How many threads draw, the caller's among them.", NULL},
        {"isa", get_isa, NULL, "The instruction set: 'baseline', 'avx2' or 'avx512'.", NULL},
        {0}};
    static const char doc[] =
        "Context(threads=0, isa=None)\n--\n\n"
        "Threads that draw, and the memory of what is drawn.\n\n"
        "Nothing that is drawn depends on it. Every Python thread has one of its own that is made when it is "
        "first\n"
        "needed; make others to say how many threads draw.\n\n"
        "threads: 1 to 64, the caller's among them; 0: as many as the process has cores.\n"
        "isa: the highest instruction set, 'baseline', 'avx2' or 'avx512'; None: the one that measured "
        "best.\n\n"
        "Python threads that share a context take turns. In a process that was forked it does not live on.";
    static PyType_Slot slots[] = {{Py_tp_new, (void *)(uintptr_t)context_make},
                                  {Py_tp_dealloc, (void *)(uintptr_t)context_free},
                                  {Py_tp_getset, members},
                                  {Py_tp_doc, (void *)(uintptr_t)doc},
                                  {0, NULL}};
    static PyType_Spec spec = {.name = "rhw.Context",
                               .basicsize = sizeof(struct context),
                               .flags = Py_TPFLAGS_DEFAULT,
                               .slots = slots};
    context_type = python_add_type(module, "Context", &spec);
    return context_type ? 0 : -1;
}
