// SPDX-License-Identifier: MIT
// Runs an import in a child process of its own and takes the finished model from it.
//
// Model files come from anywhere, and the libraries that read them are large: a file may make them crash,
// hang or ask for all memory. None of that can reach the caller: the child has options on time and memory,
// and what comes back is bytes that are checked from end to end. They travel in an anonymous memory file,
// which the parent maps and uses in place.
#define _GNU_SOURCE // memfd_create
#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "import.h"
#include "import_blob.h"
#include "sanitizer.h"

enum {
    DEFAULT_SECONDS = 60,
    WALL_FACTOR = 5, // the wall clock may run this many times longer: a loaded machine is no hang
    EXIT_MODEL = 0,  // the reply holds a model
    EXIT_MESSAGE = 3 // the reply holds one line
};

// Child ---------------------------------------------------------------------------------------------

_Noreturn void scene_import_fail(struct scene_import *import, const char *format, ...)
{
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    // A name from the file may hold anything; the line must stay one line.
    for (char *c = line; *c != 0; c++) {
        if ((unsigned char)*c < 32 || *c == 127) {
            *c = '?';
        }
    }
    fputs(line, import->reply);
    fflush(import->reply);
    _exit(EXIT_MESSAGE);
}

// A soft limit never above the hard one that we were started with.
// What is wanted, or what is allowed already where that is less.
static rlim_t soft_limit(rlim_t wanted, const struct rlimit *limit)
{
    rlim_t least = wanted;
    least = limit->rlim_max != RLIM_INFINITY && limit->rlim_max < least ? limit->rlim_max : least;
    return limit->rlim_cur != RLIM_INFINITY && limit->rlim_cur < least ? limit->rlim_cur : least;
}

static void limit_core(void)
{
    const struct rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
}

static void limit_time(unsigned seconds)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_CPU, &limit) == 0) {
        limit.rlim_cur = soft_limit(seconds, &limit);
        setrlimit(RLIMIT_CPU, &limit);
    }
    alarm(seconds * WALL_FACTOR);
}

static void limit_memory(size_t bytes)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) == 0) {
        limit.rlim_cur = soft_limit(bytes, &limit);
        setrlimit(RLIMIT_AS, &limit);
    }
}

static size_t default_memory(void)
{
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGE_SIZE);
    const size_t most = (size_t)16 << 30;
    if (pages <= 0 || page <= 0) {
        return most;
    }
    const size_t share = (size_t)pages / 4 * 3 * (size_t)page;
    return share < most ? share : most;
}

static void restrict_child(const struct scene_model_options *options)
{
    const unsigned seconds = options->seconds > 0 ? options->seconds : DEFAULT_SECONDS;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    limit_core();
    if (!SCENE_SANITIZED) {
        limit_memory(options->memory > 0 ? options->memory : default_memory());
    }
    setlocale(LC_ALL, "C"); // numbers in files have points
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    static const int deadly[] = {SIGXCPU, SIGALRM, SIGABRT, SIGTERM, SIGINT};
    for (size_t i = 0; i < sizeof deadly / sizeof deadly[0]; i++) {
        signal(deadly[i], SIG_DFL);
    }
    limit_time(seconds);
}

// What the libraries print is not part of our one line. Under a sanitizer its report must be seen.
static void silence(void)
{
    const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (null < 0) {
        return;
    }
    dup2(null, STDIN_FILENO);
    dup2(null, STDOUT_FILENO);
    if (!SCENE_SANITIZED) {
        dup2(null, STDERR_FILENO);
    }
}

_Noreturn static void run_child(const struct scene_import *start, const struct scene_model_options *options,
                                int descriptor)
{
    struct scene_import import = *start;
    import.model.unit = "";
    import.name = options->name != NULL ? options->name : import.model.path;
    import.variant = options->variant;
    import.texture_side = options->texture_side;
    import.animation = options->animation;
    import.time = options->time;
    import.is_posed = options->is_posed;
    import.without_images = options->without_images;
    import.progress = options->progress;
    import.reply = fdopen(descriptor, "wb");
    if (import.reply == NULL) {
        abort();
    }
    restrict_child(options);
    silence();
    if (options->confine != NULL && (import.confine = realpath(options->confine, NULL)) == NULL) {
        scene_import_fail(&import, "the folder %s, which it may read: %s", options->confine, strerror(errno));
    }
    scene_import_run(&import);
    if (!scene_blob_write(&import.model, import.reply)) {
        rewind(import.reply);
        if (ftruncate(descriptor, 0) != 0) {
            abort();
        }
        scene_import_fail(&import, "there is not enough memory for the model");
    }
    _exit(EXIT_MODEL);
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
        return refuse(error, error_size, "is a directory");
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

// Whether the child said that it finished; else `error` says how it ended.
static bool child_finished(int status, int descriptor, const struct scene_model_options *options, char *error,
                           size_t error_size)
{
    if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_MODEL) {
        return true;
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_MESSAGE) {
        char line[512];
        const ssize_t length = pread(descriptor, line, sizeof line - 1, 0);
        line[length > 0 ? length : 0] = 0;
        return refuse(error, error_size, "%s",
                      line[0] != 0
                          ? line
                          : "what was read could not be passed on; is there a limit on the size of files?");
    }
    const unsigned seconds = options->seconds > 0 ? options->seconds : DEFAULT_SECONDS;
    if (WIFSIGNALED(status)) {
        const int number = WTERMSIG(status);
        if (number == SIGXCPU) {
            return refuse(error, error_size, "import took more than %u s of processor time", seconds);
        }
        if (number == SIGALRM) {
            return refuse(error, error_size, "import took more than %u s", seconds * WALL_FACTOR);
        }
        if (number == SIGKILL) {
            return refuse(error, error_size, "import was killed (signal 9), perhaps for want of memory");
        }
        return refuse(error, error_size, "import crashed (signal %d)", number);
    }
    return refuse(error, error_size, "import crashed (exit status %d)", WEXITSTATUS(status));
}

static struct scene_model *map_model(int descriptor, char *error, size_t error_size)
{
    struct stat status;
    if (fstat(descriptor, &status) != 0 || status.st_size < (off_t)sizeof(struct scene_model)) {
        refuse(error, error_size, "import sent no model");
        return NULL;
    }
    const size_t size = (size_t)status.st_size;
    void *mapping = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE, descriptor, 0);
    if (mapping == MAP_FAILED) {
        refuse(error, error_size, "there is not enough memory for the model");
        return NULL;
    }
    struct scene_model *model = scene_blob_read(mapping, size);
    if (model == NULL) {
        munmap(mapping, size);
        refuse(error, error_size, "import sent a damaged model");
        return NULL;
    }
    model->size = size;
    return model;
}

// A small part of a second: who waits and asks is not to take the child's processor, nor to add to its time.
static void rest(void)
{
    const struct timespec pause = {.tv_nsec = 2000000};
    nanosleep(&pause, NULL);
}

// The file that the child writes to. It must not stand where a closed standard output stood, which the child silences.
static int make_reply(void)
{
    const int made = memfd_create("rhw-model", MFD_CLOEXEC);
    if (made < 0 || made > STDERR_FILENO) {
        return made;
    }
    const int moved = fcntl(made, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(made);
    return moved;
}

// Waits for the child to end; kills it where nobody wants it any more. False with a line in `error`.
static bool wait_for_child(pid_t child, const struct scene_model_options *options, int *status, char *error,
                           size_t error_size)
{
    bool goes_on = true;
    for (;;) {
        const pid_t waited = waitpid(child, status, options->goes_on != NULL && goes_on ? WNOHANG : 0);
        if (waited == child) {
            return goes_on || refuse(error, error_size, "import was given up");
        }
        if (waited < 0 && errno != EINTR) {
            return refuse(error, error_size, "import could not start: %s", strerror(errno));
        }
        if (waited == 0) {
            rest();
            goes_on = options->goes_on(options->user);
            if (!goes_on) {
                kill(child, SIGKILL);
            }
        }
    }
}

struct scene_model *scene_import_start(const struct scene_import *import,
                                       const struct scene_model_options *options, char *error,
                                       size_t error_size)
{
    const int descriptor = make_reply();
    if (descriptor < 0) {
        refuse(error, error_size, "import could not start: %s", strerror(errno));
        return NULL;
    }
    const pid_t child = fork();
    if (child == 0) {
        run_child(import, options, descriptor);
    }
    int status = 0;
    struct scene_model *model = NULL;
    if (child < 0) {
        refuse(error, error_size, "import could not start: %s", strerror(errno));
    } else if (wait_for_child(child, options, &status, error, error_size) &&
               child_finished(status, descriptor, options, error, error_size)) {
        model = map_model(descriptor, error, error_size);
    }
    close(descriptor);
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
        munmap(model, model->size); // the model stands at the start of its mapping
    }
}
