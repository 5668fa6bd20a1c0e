// SPDX-License-Identifier: MIT
// A program keeps copies of what it needs of its shaders, so that they end with the call that makes it. It belongs to
// no context: pipelines of any context are made of it, on any thread.
#include "program_object.h"

#include "program_info.h"

#include <stdlib.h>
#include <string.h>

enum { STAGES = RHW_SHADER_STAGE_COUNT };

struct program {
    PyObject ob_base;
    struct python_program data;
    PyObject *stages, *resources; // what Python is told
};

static PyTypeObject *program_type;

static const char *const stage_names[STAGES] = {"vertex", "fragment", "compute"};

static void program_free(PyObject *self)
{
    struct program *const program = (struct program *)self;
    rhw_shader_program_destroy(program->data.handle);
    free(program->data.resources);
    Py_XDECREF(program->stages);
    Py_XDECREF(program->resources);
    python_free(self);
}

const struct python_program *python_program_get(PyObject *object)
{
    if (Py_TYPE(object) != program_type) {
        PyErr_SetString(PyExc_TypeError, "program: must be a program");
        return NULL;
    }
    return &((struct program *)object)->data;
}

// Shaders --------------------------------------------------------------------------------------------

// ((id, bits), ...)
static struct rhw_shader_constant *read_constants(PyObject *tuple, uint32_t *count)
{
    if (!python_is_tuple(tuple, "constants")) {
        return NULL;
    }
    *count = (uint32_t)PyTuple_Size(tuple);
    struct rhw_shader_constant *const constants = calloc((size_t)*count + 1, sizeof *constants);
    if (!constants) {
        PyErr_NoMemory();
        return NULL;
    }
    for (uint32_t i = 0; i < *count; i++) {
        PyObject *const pair = PyTuple_GetItem(tuple, (Py_ssize_t)i);
        if (!python_is_tuple(pair, "constants") ||
            !PyArg_ParseTuple(pair, "II", &constants[i].id, &constants[i].value)) {
            free(constants);
            return NULL;
        }
    }
    return constants;
}

// False with an exception.
static bool create_shader(PyObject *bytes, struct rhw_shader_def *def, rhw_shader **shader)
{
    char message[RHW_SHADER_MESSAGE] = "";
    char *words;
    Py_ssize_t size;
    if (PyBytes_AsStringAndSize(bytes, &words, &size) < 0) {
        return false;
    }
    enum rhw_result result;
    Py_BEGIN_ALLOW_THREADS result = rhw_shader_create(words, (size_t)size, def, shader, message);
    Py_END_ALLOW_THREADS if (result == RHW_ERROR_MISUSE)
    {
        PyErr_Format(PyExc_ValueError, "%s: %s", stage_names[def->stage], message);
    }
    else if (result != RHW_OK)
    {
        PyErr_Format(PyExc_MemoryError, "%s: %s", stage_names[def->stage], message);
    }
    return result == RHW_OK;
}

static bool link_shaders(rhw_shader *const shaders[STAGES], rhw_shader_program **handle)
{
    char message[RHW_SHADER_MESSAGE] = "";
    const struct rhw_shader_program_def def = {.vertex = shaders[RHW_SHADER_VERTEX],
                                               .fragment = shaders[RHW_SHADER_FRAGMENT],
                                               .compute = shaders[RHW_SHADER_COMPUTE]};
    const enum rhw_result result = rhw_shader_program_create(&def, handle, message);
    if (result != RHW_OK) {
        PyErr_SetString(result == RHW_ERROR_MISUSE ? PyExc_ValueError : PyExc_MemoryError, message);
    }
    return result == RHW_OK;
}

// What is kept of them -------------------------------------------------------------------------------

static bool refuse_variable(const char *stage, const struct rhw_shader_variable *variable, const char *rule)
{
    PyErr_Format(PyExc_ValueError, "%s: %.60s at location %u: %s", stage,
                 variable->name[0] ? variable->name : "a variable", (unsigned)variable->location, rule);
    return false;
}

// A gap between locations reads what the first buffer has. Nobody looks at it.
static bool read_inputs(const struct rhw_shader_info *info, struct python_program *program)
{
    for (uint32_t i = 0; i < info->input_count; i++) {
        const struct rhw_shader_variable *const input = &info->inputs[i];
        if (input->location >= RHW_MAX_ATTRIBUTES || input->components - 1 > 3) {
            return refuse_variable("vertex", input, "locations of inputs are below 16");
        }
        if (input->component != 0 ||
            (i > 0 && (input->location == input[-1].location ||
                       (input->name[0] && strcmp(input->name, input[-1].name) == 0)))) {
            return refuse_variable("vertex", input,
                                   "an input is a number or vector at a location of its own");
        }
        const int first = input->is_integer ? RHW_VERTEX_UINT32X1 : RHW_VERTEX_FLOAT1;
        program->attributes[input->location] =
            (struct rhw_attribute){.format = (enum rhw_vertex_format)(first + (int)input->components - 1),
                                   .buffer = program->buffer_count++};
        program->attribute_count = (int)input->location + 1;
    }
    return true;
}

static bool read_outputs(const struct rhw_shader_info *info, struct python_program *program)
{
    for (uint32_t i = 0; i < info->output_count; i++) {
        const struct rhw_shader_variable *const output = &info->outputs[i];
        if (output->component != 0 || output->location != i || i >= RHW_MAX_COLOR_ATTACHMENTS) {
            return refuse_variable("fragment", output,
                                   "locations of outputs count from 0 to 7 without a gap");
        }
    }
    program->target_count = (int)info->output_count;
    return true;
}

// Put a resource among those of the program. Return its place, or −1 with an exception.
static int place_resource(const struct rhw_shader_resource *resource, struct python_program *program)
{
    struct python_program_resource *const mine = program->resources;
    uint32_t place = 0;
    while (place < program->resource_count &&
           (mine[place].set != resource->set || mine[place].binding != resource->binding)) {
        place++;
    }
    if (place == program->resource_count) {
        mine[program->resource_count++] = (struct python_program_resource){
            resource->kind, resource->set, resource->binding, resource->count, resource->is_read_only};
        return (int)place;
    }
    if (mine[place].kind != resource->kind || mine[place].count != resource->count) {
        PyErr_Format(PyExc_ValueError, "set %u, binding %u: the stages say that it is different things",
                     (unsigned)resource->set, (unsigned)resource->binding);
        return -1;
    }
    mine[place].is_read_only = mine[place].is_read_only && resource->is_read_only;
    return (int)place;
}

// Add (place, resource) of each resource of a stage to a list.
static bool read_resources(const struct rhw_shader_info *info, struct program *program, PyObject *told)
{
    for (uint32_t i = 0; i < info->resource_count; i++) {
        const int place = place_resource(&info->resources[i], &program->data);
        PyObject *const resource = place < 0 ? NULL : python_program_resource(&info->resources[i], told);
        PyObject *const pair = resource ? Py_BuildValue("(iN)", place, resource) : NULL;
        const bool is_added = pair && PyList_Append(program->resources, pair) == 0;
        Py_XDECREF(pair);
        if (!is_added) {
            return false;
        }
    }
    return true;
}

static bool read_infos(rhw_shader *const shaders[STAGES], struct program *program, PyObject *told)
{
    uint32_t room = 1;
    for (int s = 0; s < STAGES; s++) {
        room += shaders[s] ? rhw_shader_get_info(shaders[s])->resource_count : 0;
    }
    program->data.resources = calloc(room, sizeof *program->data.resources);
    if (!program->data.resources) {
        return PyErr_NoMemory() != NULL;
    }
    for (int s = 0; s < STAGES; s++) {
        const struct rhw_shader_info *const info = shaders[s] ? rhw_shader_get_info(shaders[s]) : NULL;
        PyObject *const stage = info ? python_program_stage(info, told) : NULL;
        const bool is_read = !info || (stage && PyList_Append(program->stages, stage) == 0 &&
                                       read_resources(info, program, told) &&
                                       (s != RHW_SHADER_VERTEX || read_inputs(info, &program->data)) &&
                                       (s != RHW_SHADER_FRAGMENT || read_outputs(info, &program->data)));
        Py_XDECREF(stage);
        if (!is_read) {
            return false;
        }
    }
    program->data.is_compute = shaders[RHW_SHADER_COMPUTE] != NULL;
    program->data.has_fragment = shaders[RHW_SHADER_FRAGMENT] != NULL;
    return true;
}

static bool fill(struct program *program, PyObject *const modules[STAGES], PyObject *constants)
{
    rhw_shader *shaders[STAGES] = {NULL};
    struct rhw_shader_def def = {.stage = RHW_SHADER_VERTEX};
    struct rhw_shader_constant *const values = read_constants(constants, &def.constant_count);
    bool is_good = values != NULL;
    def.constants = values;
    for (int s = 0; s < STAGES && is_good; s++) {
        def.stage = (enum rhw_shader_stage)s;
        is_good = modules[s] == Py_None || create_shader(modules[s], &def, &shaders[s]);
    }
    PyObject *const told = is_good ? PyDict_New() : NULL;
    is_good = told && link_shaders(shaders, &program->data.handle) && read_infos(shaders, program, told);
    Py_XDECREF(told);
    for (int s = 0; s < STAGES; s++) {
        rhw_shader_destroy(shaders[s]);
    }
    free(values);
    return is_good;
}

// (vertex or None, fragment or None, compute or None, constants): SPIR-V as bytes
static PyObject *program_make(PyTypeObject *type, PyObject *arguments, PyObject *keywords)
{
    (void)keywords;
    PyObject *modules[STAGES], *constants;
    if (!PyArg_ParseTuple(arguments, "OOOO:Program", &modules[0], &modules[1], &modules[2], &constants)) {
        return NULL;
    }
    const allocfunc allocate = (allocfunc)(uintptr_t)PyType_GetSlot(type, Py_tp_alloc);
    struct program *const program = (struct program *)allocate(type, 0);
    if (program) {
        program->stages = PyList_New(0);
        program->resources = PyList_New(0);
        if (!program->stages || !program->resources || !fill(program, modules, constants)) {
            Py_DECREF((PyObject *)program);
            return NULL;
        }
    }
    return (PyObject *)program;
}

static PyObject *get_stages(PyObject *self, void *closure)
{
    (void)closure;
    return PyList_AsTuple(((struct program *)self)->stages);
}

static PyObject *get_resources(PyObject *self, void *closure)
{
    (void)closure;
    return PyList_AsTuple(((struct program *)self)->resources);
}

int python_add_programs(PyObject *module)
{
    static PyGetSetDef members[] = {
        {"stages", get_stages, NULL, NULL, NULL}, {"resources", get_resources, NULL, NULL, NULL}, {0}};
    static PyType_Slot slots[] = {{Py_tp_new, (void *)(uintptr_t)program_make},
                                  {Py_tp_dealloc, (void *)(uintptr_t)program_free},
                                  {Py_tp_getset, members},
                                  {0, NULL}};
    static PyType_Spec spec = {.name = "rhw._rhw.Program",
                               .basicsize = sizeof(struct program),
                               .flags = Py_TPFLAGS_DEFAULT,
                               .slots = slots};
    program_type = python_add_type(module, "Program", &spec);
    return program_type ? 0 : -1;
}
