// SPDX-License-Identifier: MIT
// Runs an import in a child of its own and takes the finished model from it.
//
// Model files come from anywhere, and the libraries that read them are large: a file may make them crash, hang or ask
// for all memory. None of that can reach the caller. The child has limits of time and memory, and the bytes that come
// back are checked from end to end. They travel in an anonymous memory file, which the parent maps and uses in place.
// Where the system copies no processes (child.h) the child is a thread.
#include "reader_process.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "child.h"
#include "file.h"
#include "import/finish/finish.h"
#include "kind.h"
#include "blob.h"
#include "machine.h"
#include "memory_file.h"

enum {
    DEFAULT_SECONDS = 60,
    // The wall clock may run this many times longer than the CPU's: a loaded machine is no hang.
    WALL_FACTOR = 5,
    EXIT_MODEL = 0,  // the reply holds a model
    EXIT_MESSAGE = 3 // the reply holds one line
};

// Child ---------------------------------------------------------------------------------------------

static void leave(struct scene_import *import, const char *line)
{
    scene_import_clear_reply(import);
    // A name from the file may hold anything, and the line must stay one line.
    for (const char *c = line; *c != 0; c++) {
        fputc((unsigned char)*c < 32 || *c == 127 ? '?' : *c, import->child->reply);
    }
    system_child_leave(import->child, EXIT_MESSAGE);
}

static size_t default_memory(void)
{
    const size_t share = system_machine_memory() / 4 * 3, most = (size_t)16 << 30;
    return share > 0 && share < most ? share : most;
}

// What the child is told. All of it is the child's own (child.h), but for arrays and the progress.
struct order {
    struct scene_import start;
    struct scene_model_options options;
    char *strings[5]; // strings that `start` and `options` point to
};

static void release_order(void *user)
{
    struct order *const order = user;
    for (size_t i = 0; i < sizeof order->strings / sizeof order->strings[0]; i++) {
        free(order->strings[i]);
    }
    free(order);
}

static bool own(const char **text, char **copy)
{
    if (*text != NULL) {
        *text = *copy = strdup(*text);
        return *copy != NULL;
    }
    return true;
}

// Return NULL if there is not enough memory.
static struct order *make_order(const struct scene_import *import, const struct scene_model_options *options)
{
    struct order *const order = malloc(sizeof *order);
    if (order == NULL) {
        return NULL;
    }
    *order = (struct order){.start = *import, .options = *options};
    const char **const texts[] = {&order->start.model.path, &order->options.name, &order->options.variant,
                                  &order->options.animation, &order->options.confine};
    bool enough = true;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        enough = own(texts[i], &order->strings[i]) && enough;
    }
    if (!enough) {
        release_order(order);
        return NULL;
    }
    return order;
}

static int run_child(void *user, struct system_child *child)
{
    const struct order *const order = user;
    const struct scene_model_options *const options = &order->options;
    struct scene_import import = order->start;
    import.leave = leave;
    import.model.unit = "";
    import.name = options->name != NULL ? options->name : import.model.path;
    import.variant = options->variant;
    import.texture_side = options->texture_side;
    import.animation = options->animation;
    import.time = options->time;
    import.is_posed = options->is_posed;
    import.without_images = options->without_images;
    import.progress = options->progress;
    import.child = child;
    if (options->confine != NULL && (import.confine = system_file_resolve(options->confine)) == NULL) {
        scene_import_fail(&import, "the folder %s, which it may read: %s", options->confine, strerror(errno));
    }
    scene_import_run(&import);
    if (!scene_blob_write(&import.model, child->reply)) {
        scene_import_fail(&import, "there is not enough memory for the model");
    }
    return EXIT_MODEL;
}

// Parent --------------------------------------------------------------------------------------------

static bool refuse(char *error, size_t error_size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static bool refuse(char *error, size_t error_size, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error, error_size, format, arguments);
    va_end(arguments);
    return false;
}

static bool file_acceptable(const char *path, char *error, size_t error_size)
{
    struct stat status;
    if (stat(path, &status) != 0) {
        return refuse(error, error_size, "cannot be opened: %s", strerror(errno));
    }
    if (S_ISDIR(status.st_mode)) {
        return refuse(error, error_size, "is a folder");
    }
    if (!S_ISREG(status.st_mode)) {
        return refuse(error, error_size, "is not a regular file");
    }
    if (status.st_size == 0) {
        return refuse(error, error_size, "the file is empty");
    }
    if (access(path, R_OK) != 0) {
        return refuse(error, error_size, "cannot be opened: %s", strerror(errno));
    }
    return true;
}

// Read the one line that the child wrote.
static bool take_message(FILE *reply, char *error, size_t error_size)
{
    char line[512];
    rewind(reply);
    line[fread(line, 1, sizeof line - 1, reply)] = 0;
    return refuse(
        error, error_size, "%s",
        line[0] != 0 ? line : "what was read could not be passed on; is there a limit on the size of files?");
}

// Say how the child crashed, by the number of a signal or of a status. Where a library did, the child has said so
// before.
static bool tell_crash(const struct system_child_result *result, const char *kind, char *error,
                       size_t error_size)
{
    static const char mark[] = SCENE_IMPORT_ENTERED;
    const size_t length = sizeof mark - 1;
    char line[512] = "";
    FILE *const reply = result->reply.stream;
    rewind(reply);
    line[fread(line, 1, sizeof line - 1, reply)] = 0;
    return strncmp(line, mark, length) == 0
               ? refuse(error, error_size, "%s (%s %d)", line + length, kind, result->number)
               : refuse(error, error_size, "import crashed (%s %d)", kind, result->number);
}

// Return true if the child said that it finished. Return false, with how it ended in `error`, if not.
static bool child_finished(const struct system_child_result *result, unsigned seconds, char *error,
                           size_t error_size)
{
    switch (result->end) {
    case SYSTEM_CHILD_CPU_TIME:
        return refuse(error, error_size, "import took more than %u s of processor time", seconds);
    case SYSTEM_CHILD_WALL_TIME:
        return refuse(error, error_size, "import took more than %u s", seconds * WALL_FACTOR);
    case SYSTEM_CHILD_KILLED:
        return refuse(error, error_size, "import was killed (signal %d), perhaps for want of memory",
                      result->number);
    case SYSTEM_CHILD_SIGNAL: return tell_crash(result, "signal", error, error_size);
    case SYSTEM_CHILD_GIVEN_UP: return refuse(error, error_size, "import was given up");
    case SYSTEM_CHILD_NOT_STARTED:
        return refuse(error, error_size, "import could not start: %s", strerror(result->number));
    case SYSTEM_CHILD_LEFT: break;
    }
    if (result->number == EXIT_MESSAGE) {
        return take_message(result->reply.stream, error, error_size);
    }
    return result->number == EXIT_MODEL || tell_crash(result, "exit status", error, error_size);
}

struct scene_model *scene_import_map(const struct system_memory_file *file, char *error, size_t error_size)
{
    struct stat status;
    if (fstat(fileno(file->stream), &status) != 0 || status.st_size < (off_t)sizeof(struct scene_model)) {
        refuse(error, error_size, "no model was sent");
        return NULL;
    }
    size_t size;
    void *const mapping = system_memory_file_map(file, &size);
    if (mapping == NULL) {
        refuse(error, error_size, "there is not enough memory for the model");
        return NULL;
    }
    struct scene_model *model = scene_blob_read(mapping, size);
    if (model == NULL) {
        system_memory_file_unmap(mapping, size);
        refuse(error, error_size, "the model was damaged on its way");
        return NULL;
    }
    model->size = size;
    return model;
}

struct scene_model *scene_import_start(const struct scene_import *import,
                                       const struct scene_model_options *options, char *error,
                                       size_t error_size)
{
    const unsigned seconds = options->seconds > 0 ? options->seconds : DEFAULT_SECONDS;
    struct order *const order = make_order(import, options);
    if (order == NULL) {
        refuse(error, error_size, "import could not start: %s", strerror(ENOMEM));
        return NULL;
    }
    const struct system_child_work work = {.run = run_child,
                                           .user = order,
                                           .release = release_order,
                                           .is_borrowing = import->arrays || options->progress,
                                           .cpu_seconds = seconds,
                                           .wall_seconds = seconds * WALL_FACTOR,
                                           .memory = options->memory > 0 ? options->memory : default_memory(),
                                           .goes_on = options->goes_on,
                                           .goes_on_user = options->user};
    struct system_child_result result = system_child_run(&work);
    struct scene_model *model = NULL;
    if (child_finished(&result, seconds, error, error_size)) {
        model = scene_import_map(&result.reply, error, error_size);
    }
    system_memory_file_close(&result.reply);
    return model;
}

struct scene_model *scene_model_load(const char *path, const struct scene_model_options *options, char *error,
                                     size_t error_size)
{
    static const struct scene_model_options defaults = {0};
    if (!file_acceptable(path, error, error_size)) {
        return NULL;
    }
    const struct scene_import import = {.read = scene_import_read, .model.path = path};
    return scene_import_start(&import, options != NULL ? options : &defaults, error, error_size);
}

void scene_model_free(struct scene_model *model)
{
    if (model != NULL) {
        system_memory_file_unmap(model, model->size); // the model stands at the start of its mapping
    }
}
